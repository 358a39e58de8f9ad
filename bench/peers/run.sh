#!/usr/bin/env bash
# Peers beside ours: case S1 by LAMMPS from Debian's package and by clast, one core each, nanoseconds a grain-step.
#
#     bench/peers/run.sh [build/release/clast]
#
# Prints "program,scene,value,unit". A peer that is not installed is named and left out; with none the exit code is 77.
# E1's peer (superquadrics) is switched off in Debian's LIGGGHTS: its 2.5 us come from a build of the same release.
set -eu
cd "$(dirname "$0")"
clast=${1:-../../build/release/clast}
n_peer=0
peer() { # name, command
    command -v "$2" > /dev/null || { echo "run.sh: $1 is not installed ($2): left out (apt-get install $1)" >&2; return 0; }
    log=$(mktemp)
    OMP_NUM_THREADS=1 "$2" -log none -in s1.lammps > "$log" 2>&1 || { echo "run.sh: $2 failed:" >&2; tail -5 "$log" >&2; rm -f "$log"; return 1; }
    # "Loop time of T on P procs for S steps with N atoms", of the last run
    grep '^Loop time of' "$log" | tail -1 | awk -v p="$1" '{ printf "%s,S1,%.1f,ns/grain-step\n", p, 1e9 * $4 / ($9 * $12) }'
    rm -f "$log"
    n_peer=$((n_peer + 1))
}
peer lammps lmp
if [ -x "$clast" ]; then
    "$clast" bench S1 -j 1 --json | python3 -c 'import json, sys; print("clast,S1,%.1f,ns/grain-step" % json.load(sys.stdin)["scenes"][0]["value"])'
else
    echo "run.sh: no $clast: left out (make release)" >&2
fi
[ "$n_peer" -gt 0 ] || exit 77
