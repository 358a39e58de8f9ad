#!/usr/bin/env bash
# Runs every libFuzzer target for a number of seconds, FUZZ_JOBS (one a core) at a time: tools/fuzz.sh [seconds]
# A new crash is kept under build/fuzz/crashes and fails the run.
set -eu
cd "$(dirname "$0")/.."
mkdir -p build
export FUZZ_SECONDS=${1:-60}
tools/build.sh fuzz fuzz_targets > build/fuzz.log 2>&1 || { tail -30 build/fuzz.log; echo "fuzz: build failed"; exit 1; }
mkdir -p build/fuzz/crashes
one() {
    name=$(basename "$1"); seeds="tests/fuzz/corpus/${name#fuzz_}"; work="build/fuzz/corpus/$name"
    mkdir -p "$work"
    if "$1" -max_total_time="$FUZZ_SECONDS" -rss_limit_mb=1024 -timeout=10 -max_len=65536 -print_final_stats=1 \
        -artifact_prefix="build/fuzz/crashes/$name-" "$work" $([ -d "$seeds" ] && echo "$seeds") > "build/fuzz/$name.log" 2>&1
    then echo "fuzz: $name $(awk '/number_of_executed_units/ {print $2}' "build/fuzz/$name.log") inputs in ${FUZZ_SECONDS} s, none bad"
    else echo "fuzz: $name FAILED"; tail -25 "build/fuzz/$name.log"; return 1; fi
}
export -f one
if [ -x build/release/clast ]; then # the smoke share of `make fuzz-commands`
    python3 tests/fuzz/fuzz_commands.py --runs 2000 --seconds "$FUZZ_SECONDS"
    [ "$(uname)" != Linux ] || python3 tests/fuzz/fault_commands.py --each 2 --kills 20 # of `make faults`
fi
# fuzz_calls keeps what the calls made, so it is run by hand, with -detect_leaks=0; property.test_calls runs the same calls apart
find build/fuzz/fuzz -maxdepth 1 -type f -executable -name 'fuzz_*' ! -name fuzz_calls | sort | xargs -r -P "${FUZZ_JOBS:-$(nproc)}" -I{} bash -c 'one {}'
