# Sourced by the tools that make packages: version, date and the bundled targets. Two packages of one commit have the same bytes.
cd "$(dirname "${BASH_SOURCE[0]}")/.."
version=$(cat VERSION)
if [ -z "${SOURCE_DATE_EPOCH:-}" ]; then # the commit's time, which an unpacked release has on its files
    SOURCE_DATE_EPOCH=$(if [ -e .git ]; then git log -1 --format=%ct; else stat -c %Y CMakeLists.txt; fi)
fi
export SOURCE_DATE_EPOCH LC_ALL=C
umask 022
made=$PWD/build/packages
bundle=$PWD/build/release/bundle
build_bundled() { # TARGET: a command or library with all inside but libc
    local log=build-bundle.log missing
    [ "$(uname -sm)" = "Linux x86_64" ] || { echo "packages: this is $(uname -sm); a bundled clast is linked on x86-64 Linux" >&2; exit 1; }
    tools/build.sh release "$1" > "$log" 2>&1 || {
        missing=$(cat build/release/generated/bundle_missing.txt 2> /dev/null || true)
        if [ -n "$missing" ]; then echo "packages: to bundle clast, this build lacks: ${missing//;/, }" >&2; else tail -30 "$log" >&2; fi
        rm -f "$log"; exit 1
    }
    rm -f "$log"
}
needs() { # FILE...: the libraries that they load, libc's own parts aside
    objdump -p "$@" | awk '$1 == "NEEDED" {print $2}' | grep -vxE "(libc|libm|ld-linux-x86-64).so.[0-9]" | sort -u | paste -sd' '
}
newest_libc() { objdump -T "$@" | grep -oE 'GLIBC_[0-9.]+' | sort -uV | tail -1 | sed 's/GLIBC_//'; }
