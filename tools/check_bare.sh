#!/usr/bin/env bash
# Does a new Debian 12 machine take the commit at hand? In a minimal root of its own: every make target without its packages and
# without root, make demo as root (its seconds, with the packages), and the source release beside an MPI runtime without headers.
# Needs root, mount and chroot, and a package mirror; where one is missing it says so and skips. DEMO_SECONDS: limit (default 180).
set -euo pipefail
cd "$(dirname "$0")/.."
{ # read as a whole before it runs: an edit meanwhile does no harm
[ -e .git ] || { echo "SKIPPED: the bare machine was not tried: this is no git clone"; exit 0; }
. tools/bare_root.sh

# What a newcomer brings: a clone and make.
install_began=$SECONDS
within "apt-get update -qq && apt-get install -y -qq --no-install-recommends make" > "$work/log" 2>&1 || fail "make could not be installed"
install_seconds=$((SECONDS - install_began))
git clone -q --no-hardlinks . "$root/clast"
chown -R 65534:65534 "$root/clast"

# Without root each target lists the packages and stops before it has made anything.
before=$(find "$root/clast" | sort | sha256sum)
targets=$(sed -n 's/^\.PHONY: //p' Makefile)
n_target=0
for target in $targets; do
    case $target in clean | bare | uninstall) continue ;; esac
    ! user "cd /clast && make $target" > "$work/log" 2>&1 || fail "make $target did not stop without its packages"
    grep -q 'packages are missing: ' "$work/log" && grep -q 'sudo apt-get install ' "$work/log" || fail "make $target does not name its packages"
    ! grep -qi 'not found\|no such file' "$work/log" || fail "make $target stumbles before it names its packages"
    n_target=$((n_target + 1))
done
[ "$before" = "$(find "$root/clast" | sort | sha256sum)" ] || fail "a target left files behind without its packages"
say "as a plain user $n_target make targets list their packages and stop"

demo_began=$SECONDS
TIMEFORMAT='%U'
{ time within "cd /clast && make demo" > "$work/log" 2>&1; } 2> "$work/cpu" || fail "make demo failed"
load=$(cut -d' ' -f1 /proc/loadavg)
demo_seconds=$((SECONDS - demo_began + install_seconds))
stray=$(within "dpkg-query -W -f '\${Package}\n'" | grep -E '^(libcmocka|clang|libclang|codespell|doxygen|sphinx|python3-(sphinx|myst|breathe)|afl|ccache$|git$|groff|mmdebstrap|mpi|openmpi)' || true)
[ -z "$stray" ] || fail "make demo installed $(echo $stray)"
say "make demo took $demo_seconds s ($(cat "$work/cpu") s of CPU), its packages included; no test, fuzz or document tool came with them"
if [ "$demo_seconds" -gt "${DEMO_SECONDS:-180}" ]; then
    share=$(awk "BEGIN {print $install_seconds + $(cat "$work/cpu") / $(nproc)}")
    awk "BEGIN {exit !($load > 1.5 * $(nproc) && $share < ${DEMO_SECONDS:-180})}" || fail "make demo took more than ${DEMO_SECONDS:-180} s"
    echo "bare: that is more than ${DEMO_SECONDS:-180} s beside other work (load $load on $(nproc) cores); its own is $share s"
fi

# The source release: the same bytes twice, built without git, beside an MPI runtime without headers.
release=$(tools/dist.sh | sed -n 's/^dist: \(.*\.tar\.gz\) .*/\1/p')
first=$(sha256sum < "$release")
tools/dist.sh > "$work/log"
[ "$first" = "$(sha256sum < "$release")" ] || fail "two releases of one commit differ"
tar -xzf "$release" -C "$root"
folder=/$(basename "$release" .tar.gz)
within "apt-get install -y -qq --no-install-recommends openmpi-bin libopenmpi3" > "$work/log" 2>&1 || fail "no MPI runtime could be installed"
printf '#!/bin/sh\nexec cc "$@" -O0\n' > "$root/usr/local/bin/hasty-cc" # the demo has compiled the same for speed
chmod +x "$root/usr/local/bin/hasty-cc"
within "cd $folder && CC=/usr/local/bin/hasty-cc make release" > "$work/log" 2>&1 || fail "the source release does not build"
for part in 'ranks: MPI is there without its headers' 'tests and benches: cmocka is not installed' 'the sectional solver: SUNDIALS is not installed'; do
    grep -q "^left out: $part" "$work/log" || fail "the release's build does not say that it leaves out $part"
done
within "cd $folder && tools/check_install.sh && python3 tools/check_layers.py && tools/check_size.sh && python3 tools/check_changelog.py" \
    > "$work/log" 2>&1 || fail "a check does not work in the source release"
while IFS=: read -r preset refusal; do
    ! within "cd $folder && tools/build.sh $preset" > "$work/log" 2>&1 < /dev/null || fail "the preset $preset was built without what it needs"
    grep -q "$refusal" "$work/log" || fail "the preset $preset does not say: $refusal"
done <<'END'
mpi:CLAST_MPI=ON, but MPI is there without its headers
dev:BUILD_TESTING=ON, but cmocka is not installed
END
say "$(basename "$release") builds and installs without git, beside an MPI runtime without headers"
exit 0
}
