#!/usr/bin/env bash
# The shared libraries export clast_* and nothing else, but what the core shares with the view of the same release alone (clx_*, under the
# version name CLAST_PRIVATE_...); every CLAST_API declaration is exported by one library. Sonames and the interface's version name are of VERSION's
# MAJOR.MINOR, as a minor release may break the interface. The core loads no cairo and no libpng. Nothing fuses
# a product and a sum: its bytes would be other ones than those of machines that cannot.
set -eu
export LC_ALL=C
cd "$(dirname "$0")/.."
build=${1:-build/release}
symbols() { nm -D "$@" | awk '{print $NF}' | grep -v '^CLAST_' | sort; } # with their versions
plain() { { sed 's/@.*//' | grep '^clast_' || true; } | sort; }
declared() { grep -hozP 'CLAST_API[^;({]*?\b(clast_\w+)(?=\s*[\(\[;])' "$@" | tr '\0' '\n' | grep -oP 'clast_\w+$' | sort -u; }
version=$(cat VERSION)
for library in "$build"/libclast.so "$build"/libclast_*.so; do
    [ ! -e "$library" ] || readelf -d "$library" | grep -qF "[$(basename "$library").${version%.*}]" ||
        { echo "$library: its soname is not $(basename "$library").${version%.*}"; exit 1; }
done
core=$(symbols --defined-only "$build/libclast.so")
shared=$(printf '%s\n' "$core" | grep "^clx_.*@@CLAST_PRIVATE_$version\$" || true)
stray=$(printf '%s\n' "$core" | grep -v "^clast_.*@@CLAST_${version%.*}\$" | grep -v "^clx_.*@@CLAST_PRIVATE_$version\$" || true)
exported=$(printf '%s\n' "$core" | plain)
view=
if [ -e "$build/libclast_view.so" ]; then
    view=$(symbols --defined-only "$build/libclast_view.so")
    stray=$stray$(printf '%s\n' "$view" | grep -v '^clast_' || true)
    unused=$(comm -23 <(printf '%s\n' "$shared" | sed 's/@.*//' | sort) <(symbols --undefined-only "$build/libclast_view.so" | sed 's/@.*//' | sort))
    [ -z "$unused" ] || { echo "shared with the view, which does not call it: $unused"; exit 1; }
    twice=$(comm -12 <(printf '%s\n' "$exported") <(printf '%s\n' "$view" | plain))
    [ -z "$twice" ] || { echo "exported by the core and by the view: $twice"; exit 1; }
fi
if [ -e "$build/libclast_mpi.so" ]; then
    mpi=$(symbols --defined-only "$build/libclast_mpi.so")
    stray=$stray$(printf '%s\n' "$mpi" | grep -v '^clast_' || true)
    missing=$(comm -23 <(declared include/clast/mpi.h) <(printf '%s\n' "$mpi" | plain))
    [ -z "$missing" ] || { echo "declared in mpi.h but not exported by libclast_mpi.so: $missing"; exit 1; }
fi
[ -z "$stray" ] || { echo "exported but not clast_*: $stray"; exit 1; }
if [ -n "$view" ]; then
    missing=$(comm -23 <(declared $(ls include/clast/*.h | grep -v '/mpi\.h$')) <(printf '%s\n' "$exported" "$view" | plain))
    [ -z "$missing" ] || { echo "declared CLAST_API but not exported: $missing"; exit 1; }
fi
! ldd "$build/libclast.so" | grep -E 'cairo|libpng|libX11' || { echo "the core loads a library of pictures (above)"; exit 1; }
fused=$(set -o pipefail; objdump -d --no-show-raw-insn "$build"/libclast*.so | awk '/^[0-9a-f]+ <.*>:/{f=$2} /[ \t](v?fn?m(add|sub)|fml[as])/{print f}' | sort -u)
[ -z "$fused" ] || { echo "multiplies and adds in one rounding: $fused"; exit 1; }
echo "symbols: core $(printf '%s\n' "$exported" | wc -l), view $(printf '%s' "$view" | plain | wc -l) exported, all clast_*, all declared ones" \
    "present; $(printf '%s' "$shared" | grep -c . || true) shared by core and view; the core loads $(ldd "$build/libclast.so" | wc -l) libraries," \
    "the view $(ldd "$build/libclast_view.so" 2> /dev/null | wc -l)"
