#!/usr/bin/env bash
# What clast links as static libraries for a machine that Debian has no packages for: tools/portable.sh wasm|i386
# Fetches Debian's source packages once (their digests stand in tools/portable/sources.txt) and builds them into build/portable/MACHINE.
# Exit code 3: they cannot be fetched.
set -eu
cd "$(dirname "$0")/.."
machine=$1
prefix=$PWD/build/portable/$machine
sources=${CLAST_PORTABLE_SOURCES:-$PWD/build/portable/sources}
mirror=${CLAST_DEBIAN_MIRROR:-http://deb.debian.org/debian}
ccache=$(command -v ccache || true)
case $machine in
wasm) configure=(emcmake cmake "-DCMAKE_C_COMPILE_OBJECT=$ccache $(em-config LLVM_ROOT)/clang $(emcc --cflags | tail -1) <DEFINES> <INCLUDES> <FLAGS> -o <OBJECT> -c <SOURCE>") flags="-O2" ;;
i386) configure=(cmake "-DCMAKE_C_COMPILER_LAUNCHER=$ccache") flags="-O1 -m32 -msse2 -mfpmath=sse" ;;
*) echo "usage: tools/portable.sh wasm|i386" >&2; exit 2 ;;
esac
mark="$(find tools/portable -type f -print0 | sort -z | xargs -0 cat | sha256sum | cut -c1-16) $flags"
[ -f "$prefix/mark" ] && [ "$(cat "$prefix/mark")" = "$mark" ] && exit 0
mkdir -p "$sources"
exec 9> "$sources/.lock" && flock 9 # both machines may be made at once
while read -r name path digest members; do
    file=$sources/$(basename "$path")
    if ! echo "$digest  $file" | sha256sum -c --status 2>/dev/null; then
        curl -sSfL --connect-timeout 20 --retry 3 -o "$file.part" "$mirror/pool/$path" || { echo "portable: cannot fetch $mirror/pool/$path" >&2; exit 3; }
        echo "$digest  $file.part" | sha256sum -c --status || { echo "portable: $path is not the file whose digest is known" >&2; exit 1; }
        mv "$file.part" "$file"
    fi
    if [ ! -f "$sources/$name/.whole" ]; then
        rm -rf "${sources:?}/$name" && mkdir "$sources/$name"
        # shellcheck disable=SC2086
        tar -xf "$file" -C "$sources/$name" --strip-components=1 $members
        : > "$sources/$name/.whole"
    fi
done < tools/portable/sources.txt
exec 9>&-
rm -rf "$prefix"
build=build/portable/$machine-build
log=build/portable/$machine.log
{ "${configure[@]}" -S tools/portable -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" "-DCMAKE_C_FLAGS=$flags" \
    -DCMAKE_C_FLAGS_RELEASE=-DNDEBUG -DCLAST_SOURCES="$sources" -DCLAST_RANDOM123=/usr/include &&
    cmake --build "$build" && cmake --install "$build"; } > "$log" 2>&1 || { tail -40 "$log"; exit 1; }
echo "$mark" > "$prefix/mark"
