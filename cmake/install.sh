#!/bin/sh
# Installs the C library, its headers, the files for CMake and pkg-config, and the command:
#
#     install.sh PREFIX [FOLDER OF THE BUILT LIBRARIES]
#
# The folder is target/release unless given. DESTDIR is put before the prefix if set. What is put
# there is listed in share/bladesmith/manifest.txt, from which uninstall.sh removes it; an
# installation that is there already is removed first.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
prefix=${1:?usage: install.sh PREFIX [FOLDER OF THE BUILT LIBRARIES]}
built=${2:-$root/target/release}

case $prefix in
    /*) prefix=${prefix%/} ;;
    *) echo "install.sh: PREFIX must be an absolute path, not '$prefix'" >&2; exit 2 ;;
esac
for library in libbladesmith.so libbladesmith.a; do
    if [ ! -f "$built/$library" ]; then
        echo "install.sh: $built/$library is missing; build it with: make build" >&2
        exit 2
    fi
done

version=$(sed -n 's/^version = "\(.*\)"$/\1/p' "$root/Cargo.toml" | head -n 1)
abi=$(sed -n 's/^#define BLADESMITH_ABI_VERSION //p' "$root/include/bladesmith/bladesmith.h")
# What Rust's standard library needs of the system beside libc.
static_libs="-lgcc_s -lpthread -lm -ldl"
target=${DESTDIR:-}$prefix
manifest=share/bladesmith/manifest.txt

# folder PATH: makes a folder below the prefix and lists those that were not there.
folder() {
    [ -d "$target/$1" ] && return
    case $1 in */*) folder "${1%/*}" ;; esac
    install -d "$target/$1"
    echo "$1/" >>"$list"
}

# put MODE SOURCE PATH: copies a file to a path below the prefix.
put() {
    folder "${3%/*}"
    install -m "$1" "$2" "$target/$3"
    echo "$3" >>"$list"
}

# link TO PATH: a symbolic link at a path below the prefix.
link() {
    folder "${2%/*}"
    ln -sf "$1" "$target/$2"
    echo "$2" >>"$list"
}

# fill TEMPLATE PATH: puts the template with its @NAMES@ replaced.
fill() {
    sed -e "s|@VERSION@|$version|g" -e "s|@ABI_VERSION@|$abi|g" -e "s|@STATIC_LIBS@|$static_libs|g" \
        "$root/cmake/$1" >"$work/filled"
    put 644 "$work/filled" "$2"
}

if [ -f "$target/$manifest" ]; then
    "$root/cmake/uninstall.sh" "$prefix"
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
list=$work/manifest
install -d "$target"

for header in bladesmith.h bladesmith.hpp core.hpp results.hpp curve.hpp fillet.hpp section.hpp surface.hpp; do
    put 644 "$root/include/bladesmith/$header" "include/bladesmith/$header"
done
# Beside what debuggers need the archive holds bitcode for Rust's linker: three quarters of it.
for library in libbladesmith.so libbladesmith.a; do
    strip --strip-debug --remove-section=.llvmbc --remove-section=.llvmcmd -o "$work/$library" "$built/$library"
done
put 755 "$work/libbladesmith.so" "lib/libbladesmith.so.$abi"
link "libbladesmith.so.$abi" lib/libbladesmith.so
put 644 "$work/libbladesmith.a" lib/libbladesmith.a
fill bladesmithConfig.cmake.in lib/cmake/bladesmith/bladesmithConfig.cmake
fill bladesmithConfigVersion.cmake.in lib/cmake/bladesmith/bladesmithConfigVersion.cmake
for package in bladesmith bladesmith-static; do
    fill "$package.pc.in" "lib/pkgconfig/$package.pc"
done

find "$root/freecad_workbench/freecad" -type f ! -name '*.pyc' >"$work/sources"
sort "$work/sources" | while read -r source; do
    put 644 "$source" "share/bladesmith/${source#"$root/freecad_workbench/"}"
done
put 755 "$root/freecad_workbench/bladesmith" share/bladesmith/bladesmith
link ../share/bladesmith/bladesmith bin/bladesmith
echo "$manifest" >>"$list"
put 644 "$list" "$manifest"
