#!/bin/sh
# Removes what install.sh put below a prefix, and nothing else:
#
#     uninstall.sh PREFIX
#
# DESTDIR is put before the prefix if set. Folders go if install.sh made them and they are empty,
# but for what Python compiled there.
set -eu

prefix=${1:?usage: uninstall.sh PREFIX}
target=${DESTDIR:-}${prefix%/}
manifest=$target/share/bladesmith/manifest.txt

if [ ! -f "$manifest" ]; then
    echo "uninstall.sh: $manifest is missing: Bladesmith is not installed there, or not by 'make install'" >&2
    exit 2
fi

# Backwards: what is in a folder comes after it in the list.
sed '1!G;h;$!d' "$manifest" | while read -r path; do
    case $path in
        */)
            rm -rf "$target/${path}__pycache__"
            rmdir "$target/$path" 2>/dev/null || true
            ;;
        *) rm -f "$target/$path" ;;
    esac
done
