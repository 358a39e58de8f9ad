#!/usr/bin/env bash
# Configures and builds one preset: tools/build.sh dev|release|mpi|tsan|coverage|minimal|fuzz [target...]
# It is configured anew where packages were installed since, so that a part left out before comes in.
set -eu
cd "$(dirname "$0")/.."
preset=$1; shift
made=build/$preset/build.ninja; log=build-$preset.configure.log
if [ ! -f "$made" ] || [ /var/lib/dpkg/status -nt "$made" ]; then
    trap 'rm -f "$log"' EXIT
    cmake --preset "$preset" > "$log" 2>&1 || { cat "$log"; rm -f "$made"; exit 1; }
    sed -n 's/^-- left out/left out/p' "$log"
fi
exec 9> "build/$preset/.lock" # one at a time: two of them at work in one folder would spoil its log
! command -v flock > /dev/null || flock 9
cmake --build "build/$preset" ${@:+--target "$@"}
