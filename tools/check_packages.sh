#!/usr/bin/env bash
# Do the packages in build/packages work on a bare Debian 12 machine, as what they are for: tools/check_packages.sh [tarball] [wheel] [deb] [deb-dev] [sdist] [notebooks]
# Each is installed in a minimal root, does a real run whose numbers are those of this build, and is removed with nothing left.
set -euo pipefail
cd "$(dirname "$0")/.."
{ # read as a whole before it runs: an edit meanwhile does no harm
. tools/bare_root.sh
version=$(cat VERSION)
made=build/packages
wanted=${*:-tarball wheel deb deb-dev sdist notebooks}
install() { within "apt-get install -y -qq --no-install-recommends $*" > "$work/log" 2>&1 || fail "apt-get install $* failed"; }
laid() { # the files of the root but ours, the notes of apt and the loader, and what groups that dependencies make and unmake leave (etc/gshadow-)
    find "$root" -xdev \( -path "$root/var/lib/apt" -o -path "$root/var/cache" -o -path "$root/var/log" -o -path "$root/var/lib/dpkg" \
        -o -path "$root/given" -o -path "$root/etc/ld.so.cache" -o -path "$root/run" -o -path "$root/etc/*shadow-" -o -path "$root/etc/group-" -o -path "$root/etc/passwd-" \
        -o -path "$root/proc" -o -path "$root/dev" \) -prune -o -print | sort
}
same_as_before() { # WHAT: the root holds the files that it held
    laid | diff "$work/before" - > "$work/log" || fail "$1 leaves files behind, or took some away"
}
clear_home() { find "$root/tmp" -mindepth 1 -delete; } # runs, and caches that fontconfig and pip keep for a user
mkdir -p "$root/given/build"
cp -r data examples "$root/given"
within "apt-get update -qq" > "$work/log" 2>&1 || fail "apt-get update"

# The same run here, by the release build: its tables, charts and states are compared byte for byte.
tools/build.sh release clast_cli > "$work/log" 2>&1 || fail "the release build"
build/release/clast aggregate examples/27sk21.yaml --set repeats=1 -o "$work/here" --quiet > /dev/null
compare() { # WHAT FOLDER
    for file in history.csv structure.csv state.h5 history.svg aggregate.stl; do
        cmp "$work/here/$file" "$root$2/$file" > "$work/log" 2>&1 || fail "$1: $file of a run is not that of this build"
    done
    [ -s "$root$2/report.html" ] && [ -s "$root$2/picture.png" ] || fail "$1: a run without its report or picture"
}
job='cd /given && rm -rf /tmp/run && clast aggregate examples/27sk21.yaml --set repeats=1 -o /tmp/run --quiet > /dev/null'

for package in $wanted; do
    case $package in
    tarball)
        laid > "$work/before"
        name=clast-$version-linux-x86_64
        tar -xzf "$made/$name.tar.gz" -C "$root/opt"
        user "PATH=/opt/$name/bin:\$PATH; $job" > "$work/log" 2>&1 || fail "tarball: the run failed"
        [ ! -s "$work/log" ] || fail "tarball: the run has messages"
        compare tarball /tmp/run
        user "cd /given && /opt/$name/bin/clast pack examples/u1.yaml --set mass=0.02kg -o /tmp/bed --quiet && /opt/$name/bin/clast render /tmp/bed -o /tmp/bed.png --quiet" \
            > "$work/log" 2>&1 || fail "tarball: pack or render failed"
        rm -rf "$root/opt/$name"; clear_home
        same_as_before tarball
        say "the tarball runs without any package, numbers and charts are this build's"
        ;;
    wheel)
        install python3 python3-pip python3-numpy
        laid > "$work/before"
        wheel=$(cd "$made" && ls clast-"$version"-py3-none-manylinux_*.whl)
        cp "$made/$wheel" "$root/given/build"
        cp tools/check_wheel.py "$root/given"
        user "mkdir /tmp/home; export HOME=/tmp/home PIP_BREAK_SYSTEM_PACKAGES=1; pip install --quiet --no-index --user /given/build/$wheel" > "$work/log" 2>&1 ||
            fail "wheel: pip install failed"
        user "export HOME=/tmp/home PYTHONDONTWRITEBYTECODE=1; cd /tmp && python3 -W error /given/check_wheel.py /given" > "$work/log" 2>&1 || fail "wheel: python3 failed"
        compare wheel /tmp/python_run
        user "PATH=/tmp/home/.local/bin:\$PATH; $job" > "$work/log" 2>&1 || fail "wheel: its command failed"
        compare "wheel's command" /tmp/run
        user "export HOME=/tmp/home PIP_BREAK_SYSTEM_PACKAGES=1; pip uninstall --quiet --yes clast" > "$work/log" 2>&1 || fail "wheel: pip uninstall failed"
        left=$(find "$root/tmp/home" -name '*clast*')
        [ -z "$left" ] || fail "wheel: pip leaves $left"
        clear_home
        same_as_before wheel
        say "$wheel works with python3 and numpy alone"
        ;;
    sdist)
        install gcc libc6-dev cmake ninja-build pkg-config libqhull-dev librandom123-dev liblapacke-dev liblapack-dev libblas-dev libhdf5-dev libyaml-dev \
            libjansson-dev libcairo2-dev libpng-dev zlib1g-dev fonts-dejavu-core python3 python3-pip python3-numpy
        laid > "$work/before"
        tools/dist.sh > "$work/log"
        cp "build/clast-$version.tar.gz" tools/check_wheel.py "$root/given"
        user "mkdir /tmp/home; export HOME=/tmp/home PIP_BREAK_SYSTEM_PACKAGES=1; pip install --quiet --no-index --user /given/clast-$version.tar.gz" > "$work/log" 2>&1 ||
            fail "sdist: pip install failed"
        user "export HOME=/tmp/home PYTHONDONTWRITEBYTECODE=1; cd /tmp && python3 -W error /given/check_wheel.py /given" > "$work/log" 2>&1 || fail "sdist: python3 failed"
        compare sdist /tmp/python_run
        user "PATH=/tmp/home/.local/bin:\$PATH; $job" > "$work/log" 2>&1 || fail "sdist: its command failed"
        compare "sdist's command" /tmp/run
        clear_home
        same_as_before sdist
        say "pip builds and installs the source release"
        ;;
    notebooks)
        install python3 python3-pip python3-numpy jupyter-nbconvert python3-ipykernel python3-matplotlib
        wheel=$(cd "$made" && ls clast-"$version"-py3-none-manylinux_*.whl)
        cp "$made/$wheel" "$root/given/build"
        mkdir -p "$root/given/tests/python"
        cp tests/python/test_notebooks.py "$root/given/tests/python"
        home="mkdir -p /tmp/home; export HOME=/tmp/home PIP_BREAK_SYSTEM_PACKAGES=1 PATH=/tmp/home/.local/bin:\$PATH"
        user "$home; pip install --quiet --no-index --user /given/build/$wheel" > "$work/log" 2>&1 || fail "notebooks: pip install failed"
        user "$home; cd /tmp && python3 /given/tests/python/test_notebooks.py" > "$work/log" 2>&1 || fail "notebooks: a notebook failed"
        grep -q '^OK$' "$work/log" || fail "notebooks: not all were run"
        clear_home
        say "the notebooks run from the wheel, and print what is stored in them"
        ;;
    deb | deb-dev)
        names="clast libclast${version%.*} libclast-view${version%.*} python3-clast"
        [ "$package" = deb ] || names="$names libclast-dev"
        [ "$package" = deb ] || install gcc libc6-dev pkg-config
        laid > "$work/before"
        within "dpkg -l" > "$work/packages"
        files=
        for name in $names; do
            cp "$made/${name}_"*.deb "$root/given/build"
            files="$files $(cd "$made" && ls "./${name}_"*.deb)"
        done
        cp tools/check_wheel.py "$root/given"
        within "cd /given/build && apt-get install -y -qq --no-install-recommends $files" > "$work/log" 2>&1 || fail "$package: apt-get install failed"
        user "$job" > "$work/log" 2>&1 || fail "$package: the run failed"
        compare "$package" /tmp/run
        user "export PYTHONDONTWRITEBYTECODE=1; cd /tmp && python3 -W error /given/check_wheel.py /given" > "$work/log" 2>&1 || fail "$package: python3 failed"
        compare "$package's Python" /tmp/python_run
        if [ "$package" = deb-dev ]; then
            user "cd /given && cc -std=c17 examples/measure_grain.c -o /tmp/a.out \$(pkg-config --cflags --libs clast) -lm && /tmp/a.out" \
                > "$work/log" 2>&1 || fail "deb-dev: a C program failed"
            ! user "ldd /tmp/a.out" | grep cairo || fail "deb-dev: the core loads cairo"
        fi
        clear_home
        within "apt-get purge -y -qq --autoremove -o APT::AutoRemove::SuggestsImportant=0 -o APT::AutoRemove::RecommendsImportant=0 $names" > "$work/log" 2>&1 || fail "$package: apt-get purge failed"
        within "dpkg -l" | diff "$work/packages" - > "$work/log" || fail "$package: other packages stay or went"
        same_as_before "$package"
        say "$names work, and go without a trace"
        ;;
    esac
done
exit 0
}
