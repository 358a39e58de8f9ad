#!/usr/bin/env bash
# The unit tests in a 32-bit build (gcc -m32, SSE2 arithmetic): sizes, shifts and files where a pointer and a long have four bytes.
# tools/test_i386.sh [or-skip]: with or-skip it says so and passes where 32-bit programs cannot be made or run.
set -eu
cd "$(dirname "$0")/.."
if [ "${1:-}" = or-skip ]; then cannot() { echo "SKIPPED LOUDLY: $1: no unit test ran in 32 bits"; exit 0; }
else cannot() { echo "test-i386: $1" >&2; exit 1; }; fi
mkdir -p build
echo 'int main(void) { return 0; }' | gcc -m32 -x c - -o build/probe-i386 2>/dev/null || cannot "gcc -m32 does not link here (tools/setup.sh i386)"
build/probe-i386 2>/dev/null || cannot "the kernel here does not run 32-bit programs (gVisor and some containers do not)"
code=0
tools/portable.sh i386 || code=$?
[ "$code" != 3 ] || cannot "no sources of the libraries, and no way to fetch them"
[ "$code" = 0 ] || exit "$code"
prefix=$PWD/build/portable/i386
export PKG_CONFIG_LIBDIR=$prefix/lib/pkgconfig
log=build/i386.log
{ [ -f build/i386/build.ninja ] ||
    cmake -S . -B build/i386 -G Ninja -DCMAKE_BUILD_TYPE=Release "-DCMAKE_C_FLAGS=-m32 -msse2 -mfpmath=sse" "-DCMAKE_C_FLAGS_RELEASE=-O1" \
        -DCLAST_VIEW=ON -DCLAST_HDF5=OFF -DCLAST_TIFF=OFF -DCLAST_SUNDIALS=OFF -DCLAST_MPI=OFF -DCLAST_ALLOC_INJECT=ON -DBUILD_TESTING=ON \
        -DCLAST_BENCH=OFF -DZLIB_LIBRARY="$prefix/lib/libz.a" -DZLIB_INCLUDE_DIR="$prefix/include" -DRANDOM123_INCLUDE="$prefix/include"
  # shellcheck disable=SC2046
  cmake --build build/i386 --target clast_cli $(for f in tests/unit/test_*.c; do n=$(basename "$f" .c); ninja -C build/i386 -t query "unit_$n" >/dev/null 2>&1 && echo "unit_$n"; done)
} > "$log" 2>&1 || { grep -E 'error|FAILED' "$log" | head -40; tail -5 "$log"; exit 1; }
# what computes for long has nothing of its own in 32 bits
ctest --test-dir build/i386 -L unit -LE numbers -E '_ranks$|test_(collide|covariogram|envelope_necks|evolve_rates|structure|workspace)$' -j"${TEST_JOBS:-$(nproc)}" --output-on-failure --no-tests=error
