#!/usr/bin/env bash
# Does `make example-code-saturne` work on a new Debian 12 machine, as one target? In a minimal root of its own: the packages first, then
# the build and all parts of the example, whose seconds are told. Needs root, mount, chroot, and a package mirror; where one is
# missing it says so and skips. SATURNE_SECONDS: limit without the packages (default 300).
set -euo pipefail
cd "$(dirname "$0")/.."
{ # read as a whole before it runs: an edit meanwhile does no harm
[ -e .git ] || { echo "SKIPPED: the saturne machine was not tried: this is no git clone"; exit 0; }
. tools/bare_root.sh
within "apt-get update -qq && apt-get install -y -qq --no-install-recommends make" > "$work/log" 2>&1 || fail "make could not be installed"
git clone -q --no-hardlinks . "$root/clast"
within "cd /clast && tools/setup.sh saturne" > "$work/log" 2>&1 || fail "its packages could not be installed"
say "code_saturne and what clast needs are installed"

TIMEFORMAT='%R %U'
{ time within "cd /clast && make example-code-saturne" > "$work/log" 2>&1; } 2> "$work/time" || fail "make example-code-saturne failed"
load=$(cut -d' ' -f1 /proc/loadavg)
read -r seconds cpu < "$work/time"
for table in meshes.csv meshes.svg ranks.csv cost.csv growth.csv half_pipe_955.csv half_pipe_9580.csv; do
    [ -s "$root/clast/build/code_saturne/$table" ] || fail "$table is not there"
done
grep -E '^(==|[0-9]+ s$)|parcels|imbalance|particles,' "$work/log" || true
cp "$work/log" "${TMPDIR:-/tmp}/clast-saturne.log"
say "make example-code-saturne took ${seconds%.*} s (${cpu%.*} s of CPU), its packages apart"
if [ "${seconds%.*}" -gt "${SATURNE_SECONDS:-300}" ]; then
    awk "BEGIN {exit !($load > 2 * $(nproc))}" || fail "make example-code-saturne took more than ${SATURNE_SECONDS:-300} s"
    echo "saturne: that is more than ${SATURNE_SECONDS:-300} s, and says nothing: other work has the machine (load $load on $(nproc) cores)"
fi
exit 0
}
