#!/bin/sh
# Installs the C library, its header, and the files for CMake and pkg-config:
#
#     install.sh PREFIX [FOLDER OF THE BUILT LIBRARIES]
#
# The folder is target/release unless given. DESTDIR is put before the prefix if set.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
prefix=${1:?usage: install.sh PREFIX [FOLDER OF THE BUILT LIBRARIES]}
built=${2:-$root/target/release}
header=$root/include/bladesmith/bladesmith.h

case $prefix in
    /*) ;;
    *) echo "install.sh: PREFIX must be an absolute path, not '$prefix'" >&2; exit 2 ;;
esac
for library in libbladesmith.so libbladesmith.a; do
    if [ ! -f "$built/$library" ]; then
        echo "install.sh: $built/$library is missing; build it with: cargo build --release" >&2
        exit 2
    fi
done

version=$(sed -n 's/^version = "\(.*\)"$/\1/p' "$root/Cargo.toml" | head -n 1)
abi=$(sed -n 's/^#define BLADESMITH_ABI_VERSION //p' "$header")
# What Rust's standard library needs of the system beside libc.
static_libs="-lgcc_s -lpthread -lm -ldl"

lib=${DESTDIR:-}$prefix/lib
install -d "$lib/cmake/bladesmith" "$lib/pkgconfig" "${DESTDIR:-}$prefix/include/bladesmith"
install -m 644 "$header" "${DESTDIR:-}$prefix/include/bladesmith/"
install -m 755 "$built/libbladesmith.so" "$lib/libbladesmith.so.$abi"
ln -sf "libbladesmith.so.$abi" "$lib/libbladesmith.so"
install -m 644 "$built/libbladesmith.a" "$lib/"

# fill TEMPLATE TARGET: writes the template with its @NAMES@ replaced.
fill() {
    sed -e "s|@PREFIX@|$prefix|g" -e "s|@VERSION@|$version|g" -e "s|@ABI_VERSION@|$abi|g" \
        -e "s|@STATIC_LIBS@|$static_libs|g" "$root/cmake/$1" >"$2"
    chmod 644 "$2"
}
fill bladesmithConfig.cmake.in "$lib/cmake/bladesmith/bladesmithConfig.cmake"
fill bladesmithConfigVersion.cmake.in "$lib/cmake/bladesmith/bladesmithConfigVersion.cmake"
fill bladesmith.pc.in "$lib/pkgconfig/bladesmith.pc"
