#!/usr/bin/env bash
# Installs what is missing on Debian 12: tools/setup.sh build|mpi|test
# As root it installs; otherwise it lists the missing packages and stops. Needs no network when nothing is missing.
set -eu
group=${1:-build}
build=(gcc make cmake ninja-build pkg-config libc6-dev libqhull-dev librandom123-dev liblapacke-dev liblapack-dev
       libblas-dev libhdf5-dev libyaml-dev libjansson-dev libcairo2-dev zlib1g-dev fonts-dejavu-core python3)
test=(libcmocka-dev clang-14 libclang-rt-14-dev clang-format-14 clang-tidy-14 codespell doxygen
      python3-sphinx python3-myst-parser python3-breathe git ccache groff-base)
mpi=(libopenmpi-dev openmpi-bin)
case $group in
build) wanted=("${build[@]}") ;;
mpi) wanted=("${build[@]}" "${mpi[@]}") ;;
test) wanted=("${build[@]}" "${mpi[@]}" "${test[@]}") ;;
*) echo "usage: tools/setup.sh build|mpi|test" >&2; exit 2 ;;
esac
if ! command -v dpkg-query >/dev/null; then
    echo "setup: not a Debian system; please install the equivalents of: ${wanted[*]}" >&2
    exit 0
fi
missing=()
for package in "${wanted[@]}"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0
if [ "$(id -u)" -ne 0 ]; then
    echo "setup: these packages are missing: ${missing[*]}" >&2
    echo "setup: run as root, or: sudo apt-get install ${missing[*]}" >&2
    exit 1
fi
echo "setup: installing ${#missing[@]} packages: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
