#!/usr/bin/env bash
# What `make install` lays down works from where it lies: a program that finds clast by pkg-config and one that finds it by CMake
# build and run, the installed command answers, its manual page formats and its bash completion completes.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
prefix=$work/usr
cmake --install "$build" --prefix "$prefix" > "$work/log"
lib=$(dirname "$(find "$prefix" -name libclast.so)")

mkdir "$work/user"
cat > "$work/user/user.c" <<'C'
#include <clast/clast.h>
#include <stdio.h>
int main(void)
{
    const double axes[3] = {3.0, 2.0, 1.0};
    clast_mesh mesh = {0};
    if (clast_mesh_ellipsoid(axes, 4, &mesh) != CLAST_OK) {
        puts(clast_error_detail());
        return 1;
    }
    printf("%s %.3f\n", clast_version(), clast_mesh_volume(&mesh));
    clast_mesh_free(&mesh);
    return 0;
}
C
cat > "$work/user/CMakeLists.txt" <<'C'
cmake_minimum_required(VERSION 3.20)
project(user C)
find_package(clast REQUIRED)
add_executable(user user.c)
target_link_libraries(user PRIVATE clast::clast)
C
cc -std=c17 "$work/user/user.c" -o "$work/by_pkg_config" \
    $(PKG_CONFIG_PATH="$lib/pkgconfig" pkg-config --cflags --libs clast)
cmake -S "$work/user" -B "$work/by_cmake" -DCMAKE_PREFIX_PATH="$prefix" >> "$work/log"
cmake --build "$work/by_cmake" >> "$work/log"
first=$(LD_LIBRARY_PATH="$lib" "$work/by_pkg_config")
second=$("$work/by_cmake/user")
[ "$first" = "$second" ] || { echo "two ways to link, two answers: '$first' and '$second'"; exit 1; }

version=$("$prefix/bin/clast" --version)
case $version in *"${first%% *}"*) ;; *) echo "the command is '$version', the library '$first'"; exit 1 ;; esac
page=$(find "$prefix" -name clast.1)
if command -v groff > /dev/null; then
    faults=$(groff -man -Tutf8 -ww "$page" 2>&1 > /dev/null) || true
    [ -z "$faults" ] || { printf 'manual page:\n%s\n' "$faults" | head -5; exit 1; }
else
    echo "SKIPPED: groff is not here, the manual page was not formatted"
fi
offered=$(bash -c '. "$1"; COMP_WORDS=(clast agg); COMP_CWORD=1; $(complete -p clast | sed "s/.*-F \([^ ]*\).*/\1/") clast agg clast
                   echo "${COMPREPLY[*]}"' bash "$(find "$prefix" -path '*bash-completion*' -type f)")
[ "$offered" = "agglomerate aggregate" ] || [ "$offered" = "aggregate agglomerate" ] ||
    { echo "bash completion of 'clast agg' offers '$offered'"; exit 1; }
echo "installed: command, library by pkg-config and by CMake ($first), manual page, completion"
