#!/usr/bin/env bash
# clang-tidy over the library and the command, or over the files named: tools/check_tidy.sh [FILE...]
# A file whose preprocessed text was clean before is skipped (marks under $XDG_CACHE_HOME/clast-tidy). The analyzer follows a function to
# TIDY_NODES states (default 25,000, a fifth of the time; 225,000 is its own default, for a release).
set -eu
cd "$(dirname "$0")/.."
db=build/tidy/compile_commands.json
known() { for file in src/*/*.c cli/*.c; do case $file in src/mpi/*) ;; *) grep -q "/$file\"" $db || return 1 ;; esac; done; }
[ -f $db ] && [ $db -nt CMakeLists.txt ] && known ||
    cmake -S . -B build/tidy -G Ninja -DCMAKE_C_COMPILER=clang-14 -DCMAKE_C_COMPILER_LAUNCHER= \
        -DCMAKE_BUILD_TYPE=None -DCLAST_ALLOC_INJECT=ON -DBUILD_TESTING=OFF -DCLAST_BENCH=OFF >/dev/null
export MARKS="${XDG_CACHE_HOME:-$HOME/.cache}/clast-tidy"
export TIDY_NODES=${TIDY_NODES:-25000}
mkdir -p "$MARKS"
export FLAGS="-std=c17 -D_XOPEN_SOURCE=700 -DCLAST_ALLOC_INJECT=1 -Iinclude -Isrc -Ibuild/tidy/generated \
$(pkg-config --cflags cairo jansson yaml-0.1) $(pkg-config --cflags ompi-c 2>/dev/null) -I/usr/include/hdf5/serial"
files=(src/*/*.c cli/*.c)
grep -q /src/mpi/ $db || { echo "tidy: MPI is not installed, src/mpi is left out"; files=($(printf '%s\n' "${files[@]}" | grep -v ^src/mpi/)); }
[ $# -eq 0 ] || files=("$@")
check() {
    mark="$MARKS/$( (clang-14 $FLAGS -E -P "$1" 2>/dev/null; cat "$1" .clang-tidy) | sha256sum | cut -c1-40)"
    [ -f "$mark" ] || [ -f "$mark-$TIDY_NODES" ] && return 0
    if out=$(clang-tidy-14 --quiet -p build/tidy --extra-arg=-Xclang --extra-arg=-analyzer-config --extra-arg=-Xclang \
        --extra-arg="max-nodes=$TIDY_NODES" "$1" 2>/dev/null); then
        if [ "$TIDY_NODES" -lt 225000 ]; then touch "$mark-$TIDY_NODES"; else touch "$mark"; fi
    else
        printf '%s\n' "$out"; return 1
    fi
}
export -f check
if printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -I{} bash -c 'check {}'; then echo "tidy: clean"; else echo "tidy: findings above"; exit 1; fi
