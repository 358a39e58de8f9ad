#!/usr/bin/env bash
# Fuzzes the built command by AFL++ on its reading paths, seconds for each: tools/afl.sh [SECONDS [TARGET...]]
# A target is a reading path below; without names all run, two at a time. Crashes and hangs fail the run and stay under
# build/afl-out/TARGET/default.
set -eu
cd "$(dirname "$0")/.."
export AFL_SECONDS=${1:-60}
[ $# -eq 0 ] || shift
tools/setup.sh afl
export AFL_QUIET=1
[ -f build/afl/build.ninja ] || cmake -S . -B build/afl -G Ninja -DCMAKE_C_COMPILER=afl-clang-fast -DCMAKE_C_COMPILER_LAUNCHER= \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE="-O2 -g" -DCLAST_THREADS=OFF -DCLAST_MPI=OFF -DBUILD_TESTING=OFF \
    -DCLAST_BENCH=OFF > build-afl.log 2>&1 || { cat build-afl.log; exit 1; }
rm -f build-afl.log
cmake --build build/afl --target clast_cli > build/afl/build.log 2>&1 || { tail -20 build/afl/build.log; echo "afl: build failed"; exit 1; }
# Nothing here must need a core dump handler, a fixed clock rate or a terminal; a run may take 2 s (a fill of a large seed).
export AFL_SKIP_CPUFREQ=1 AFL_I_DONT_CARE_ABOUT_MISSING_CRASHES=1 AFL_NO_UI=1 AFL_NO_AFFINITY=1 AFL_FAST_CAL=1

# What a target runs, with @@ for the file; seeds: at most 64 KB each.
command_of() {
    case $1 in
    stl | obj | ply | off) echo "mesh check @@.$1 --json" ;;
    shape) echo "shape @@.stl --json" ;;
    repair) echo "mesh repair @@.stl -o /dev/null --json" ;;
    points) echo "decompose @@.csv --json" ;;
    vtk) echo "decompose @@.vtk --json" ;;
    config) echo "aggregate @@.yaml --n-particle 1 --no-picture --json" ;;
    state) echo "porosity @@.h5 --json" ;;
    *) return 1 ;;
    esac
}
seeds_of() {
    case $1 in
    stl | obj | ply | off) find tests/fuzz/corpus/"$1" data -iname "*.$1" ;;
    shape | repair) find tests/fuzz/corpus/stl data -iname '*.stl' ;;
    points) find tests/fuzz/corpus/points tests/fuzz/corpus/curve data -name '*.csv' ;;
    vtk) find tests/fuzz/corpus/points -name '*.vt*' ;;
    config) find tests/fuzz/corpus/config examples -maxdepth 1 -name '*.yaml' ;;
    state) find tests/fuzz/corpus/state -type f; find build/afl-state -name '*.h5' ;;
    esac
}
# A finished run's state is the seed of the state reader.
make_state() {
    mkdir -p build/afl-state
    [ -f build/afl-state/run/state.h5 ] || build/afl/clast aggregate --core sphere --core-size 3um --coat sphere --size 1um \
        --replicate 4 --no-picture -q -o build/afl-state/run >/dev/null
}
field() { sed -n "s/^$2 *: //p" "build/afl-out/$1/default/fuzzer_stats"; }
one() {
    name=$1; in=build/afl-in/$name; out=build/afl-out/$name; words=$(command_of "$name") || { echo "afl: no target $name"; return 1; }
    rm -rf "$in" "$out"; mkdir -p "$in" "$out"
    n=0; for seed in $(seeds_of "$name"); do
        [ "$(stat -c %s "$seed")" -gt 65536 ] || { cp "$seed" "$in/$n-$(basename "$seed")"; n=$((n + 1)); }
    done
    [ "$n" -gt 0 ] || printf '0\n' > "$in/nothing"
    ending=$(sed 's/.*@@\(\.[a-z0-9]*\).*/\1/' <<< "$words")
    read -r -a argv <<< "${words/@@$ending/$out/input$ending}"
    # The file has the ending by which the command knows its format.
    timeout -s INT $((AFL_SECONDS + 60)) afl-fuzz -V "$AFL_SECONDS" -i "$in" -o "$out" -f "$out/input$ending" -m 1024 -t 2000+ \
        -- build/afl/clast "${argv[@]}" -j1 > "$out/log" 2>&1 || true
    [ -f "$out/default/fuzzer_stats" ] || { echo "afl: $name did not start"; tail -15 "$out/log"; return 1; }
    crashes=$(field "$name" saved_crashes); hangs=$(field "$name" saved_hangs)
    echo "afl: $name $(field "$name" execs_done) runs from $n seeds in $(field "$name" run_time) s, $(field "$name" corpus_count) paths, $crashes crashes, $hangs hangs"
    [ "$crashes" = 0 ] && [ "$hangs" = 0 ]
}
export -f one command_of seeds_of field
case " $* " in *" state "* | "  ") make_state ;; esac
printf '%s\n' ${@:-stl obj ply off shape repair points vtk config state} | xargs -P 2 -I{} bash -c 'one {}'
