#!/usr/bin/env bash
# clang-tidy over the library and the command, two at a time; files whose text has not changed since a clean run are skipped.
set -eu
cd "$(dirname "$0")/.."
[ -f build/tidy/compile_commands.json ] || cmake -S . -B build/tidy -G Ninja -DCMAKE_C_COMPILER=clang-14 \
    -DCMAKE_C_COMPILER_LAUNCHER= -DCLAST_OPENMP=OFF -DCLAST_ALLOC_INJECT=ON -DBUILD_TESTING=OFF >/dev/null
mkdir -p build/tidy/clean
headers=$(cat include/clast/*.h src/*/*.h cli/*.h .clang-tidy | sha256sum | cut -c1-16)
check() {
    mark="build/tidy/clean/$(cat "$1" <(echo "$2 $1") | sha256sum | cut -c1-32)"
    [ -f "$mark" ] && return 0
    if out=$(clang-tidy-14 --quiet -p build/tidy "$1" 2>/dev/null); then touch "$mark"; else printf '%s\n' "$out"; return 1; fi
}
export -f check
if ls src/*/*.c cli/*.c | xargs -P "$(nproc)" -I{} bash -c 'check {} '"$headers"; then echo "tidy: clean"; else echo "tidy: findings above"; exit 1; fi
