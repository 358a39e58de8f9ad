#!/usr/bin/env bash
# Runs every benchmark program of the release build: tools/bench.sh [NAME...]; figures are ratios within one run.
# The table goes to bench/results/<processor>.csv and to stdout; rows of programs that are not named stay. Programs that
# study an estimator (events, pairs, resolution, tests) have tables of their own and are run by themselves.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/build.sh release > build-bench.log 2>&1 || { tail -30 build-bench.log; exit 1; }
rm -f build-bench.log
machine=$(awk -F: '/model name/ {print $2; exit}' /proc/cpuinfo | tr -cs 'A-Za-z0-9' '-' | sed 's/^-//; s/-$//')
mkdir -p bench/results
out="bench/results/${machine:-unknown}.csv"
echo "program,scene,value,unit,reference,ratio" > "$out.new"
[ $# -eq 0 ] || [ ! -f "$out" ] || grep -v -E "^(program|$(IFS='|'; echo "$*"))," "$out" >> "$out.new" || true
for program in build/release/bench/bench_*; do
    [ -x "$program" ] && [ ! -d "$program" ] || continue
    name=$(basename "$program"); name=${name#bench_}
    [ $# -eq 0 ] || case " $* " in *" $name "*) ;; *) continue ;; esac
    grep -q 'scene,value,unit,reference,ratio' "bench/bench_$name.c" || continue
    "$program" | awk -F, -v name="$name" 'NF == 5 && $1 != "scene" {print name "," $0}' | tee -a "$out.new"
done
mv "$out.new" "$out"
echo "bench: $out"
