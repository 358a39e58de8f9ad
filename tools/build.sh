#!/usr/bin/env bash
# Configures (once) and builds one preset: tools/build.sh dev|release|mpi|tsan|coverage|minimal|fuzz [target...]
set -eu
cd "$(dirname "$0")/.."
preset=$1; shift
[ -f "build/$preset/build.ninja" ] || cmake --preset "$preset" > "build-$preset.log" 2>&1 || { cat "build-$preset.log"; rm -f "build-$preset.log"; exit 1; }
rm -f "build-$preset.log"
cmake --build "build/$preset" ${@:+--target "$@"}
