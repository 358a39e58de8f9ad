#!/usr/bin/env bash
# Installs what is missing on Debian 12 for one kind of work: tools/setup.sh GROUP (the groups are the names below).
# As root it installs; otherwise it lists the missing packages and stops. Needs no network when nothing is missing.
set -eu
group=${1:-build}
build=(gcc make cmake ninja-build pkg-config libc6-dev libqhull-dev librandom123-dev liblapacke-dev liblapack-dev
       libblas-dev libhdf5-dev libyaml-dev libjansson-dev libcairo2-dev libpng-dev libtiff-dev zlib1g-dev fonts-dejavu-core)
sundials=("${build[@]}" libsundials-dev)
mpi=("${build[@]}" libopenmpi-dev openmpi-bin libtrilinos-zoltan-dev)
mpich=("${mpi[@]}" mpich libmpich-dev)
dev=("${build[@]}" libcmocka-dev python3 python3-numpy)
clang=("${dev[@]}" clang-14 libclang-rt-14-dev)
afl=("${build[@]}" afl++)
paper=("${dev[@]}")
format=(git clang-format-14)
hooks=("${format[@]}" codespell python3)
python=("${dev[@]}" mypy python3-meshio python3-pandas)
notebook=("${dev[@]}" jupyter-nbconvert python3-ipykernel python3-matplotlib)
docs=("${build[@]}" doxygen python3 python3-numpy python3-sphinx python3-myst-parser python3-breathe furo python3-sphinx-inline-tabs python3-sphinx-copybutton
      nodejs katex)
web=(nodejs npm)
site=("${docs[@]}" "${web[@]}" chromium)
dist=(git python3)
bundle=("${sundials[@]}" git python3 patchelf)
deb=("${sundials[@]}" build-essential git python3 debhelper dh-python lintian)
i386=("${dev[@]}" curl)
[ "$(uname -m)" != x86_64 ] || i386+=(gcc-multilib) # Debian has it for few other machines
wasm=("${dev[@]}" emscripten nodejs curl chromium)
bare=(git mmdebstrap debian-archive-keyring)
saturne=("${mpi[@]}" python3 code-saturne code-saturne-include)
test=("${mpich[@]}" "${wasm[@]}" "${i386[@]}" "${sundials[@]}" "${bundle[@]}" "${deb[@]}" "${clang[@]}" "${hooks[@]}" "${site[@]}" "${python[@]}" "${notebook[@]}" g++ clang-tidy-14 ccache groff-base zsh locales admesh code-saturne-include)
groups="build sundials mpi mpich dev clang afl paper format hooks python notebook docs web site dist bundle deb i386 wasm bare saturne test"
case " $groups " in *" $group "*) ;; *) echo "usage: tools/setup.sh ${groups// /|}" >&2; exit 2 ;; esac
declare -n wanted=$group
if ! command -v dpkg-query >/dev/null; then
    echo "setup: not a Debian system; please install the equivalents of: ${wanted[*]}" >&2
    exit 0
fi
missing=()
for package in $(printf '%s\n' "${wanted[@]}" | sort -u); do
    [ "$package" = npm ] && command -v npm >/dev/null && continue # other packages of Node bring it, and conflict with this one
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep 'ok installed' > /dev/null || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0
if [ "$(id -u)" -ne 0 ]; then
    echo "setup: these packages are missing: ${missing[*]}" >&2
    echo "setup: run as root, or: sudo apt-get install ${missing[*]}" >&2
    exit 1
fi
echo "setup: installing ${#missing[@]} packages: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq && apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null ||
    { echo "setup: apt-get could not install them (its message is above)" >&2; exit 1; }
