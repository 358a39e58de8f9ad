#!/usr/bin/env bash
# clang-tidy over the library and the command, or over the files named: tools/check_tidy.sh [FILE...]
# A file whose preprocessed text was clean before is skipped (marks under $XDG_CACHE_HOME/clast-tidy).
set -eu
cd "$(dirname "$0")/.."
db=build/tidy/compile_commands.json
known() { for file in src/*/*.c cli/*.c; do case $file in src/mpi/*) ;; *) grep -q "/$file\"" $db || return 1 ;; esac; done; }
[ -f $db ] && [ $db -nt CMakeLists.txt ] && known ||
    cmake -S . -B build/tidy -G Ninja -DCMAKE_C_COMPILER=clang-14 -DCMAKE_C_COMPILER_LAUNCHER= \
        -DCLAST_ALLOC_INJECT=ON -DBUILD_TESTING=OFF -DCLAST_BENCH=OFF >/dev/null
export MARKS="${XDG_CACHE_HOME:-$HOME/.cache}/clast-tidy"
mkdir -p "$MARKS"
export FLAGS="-std=c17 -D_XOPEN_SOURCE=700 -DCLAST_ALLOC_INJECT=1 -Iinclude -Isrc -Ibuild/tidy/generated \
$(pkg-config --cflags cairo jansson yaml-0.1) $(pkg-config --cflags ompi-c 2>/dev/null) -I/usr/include/hdf5/serial"
files=(src/*/*.c cli/*.c)
grep -q /src/mpi/ $db || { echo "tidy: MPI is not installed, src/mpi is left out"; files=($(printf '%s\n' "${files[@]}" | grep -v ^src/mpi/)); }
[ $# -eq 0 ] || files=("$@")
check() {
    mark="$MARKS/$( (clang-14 $FLAGS -E -P "$1" 2>/dev/null; cat "$1" .clang-tidy) | sha256sum | cut -c1-40)"
    [ -f "$mark" ] && return 0
    if out=$(clang-tidy-14 --quiet -p build/tidy "$1" 2>/dev/null); then touch "$mark"; else printf '%s\n' "$out"; return 1; fi
}
export -f check
if printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -I{} bash -c 'check {}'; then echo "tidy: clean"; else echo "tidy: findings above"; exit 1; fi
