#!/usr/bin/env bash
# What `make install` lays down works from where it lies: a program that finds clast by pkg-config and one that finds it by CMake
# build and run, shared and static, without LD_LIBRARY_PATH, as does one that has clast as
# a folder of its own; what links the core alone loads no cairo, what draws a chart needs the view; the installed command answers, its manual page formats and its bash completion completes.
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
#include <string.h>
int main(void)
{
    const double axes[3] = {3.0, 2.0, 1.0};
    clast_mesh mesh = {0};
    if (clast_mesh_ellipsoid(axes, 4, &mesh) != CLAST_OK) {
        puts(clast_error_detail());
        return 1;
    }
    if (strcmp(clast_version(), CLAST_VERSION_TEXT) != 0) {
        puts("headers and library are of two releases");
        return 1;
    }
    printf("%s %.3f\n", clast_version(), clast_mesh_volume(&mesh));
    clast_mesh_free(&mesh);
    return 0;
}
C
cat > "$work/user/chart.c" <<'C'
#include <clast/chart.h>
#include <stdio.h>
int main(void)
{
    const double x[3] = {1.0, 2.0, 3.0};
    unsigned char *svg = NULL;
    const clast_series line = {.kind = CLAST_SERIES_LINE, .x = x, .y = x, .n = 3};
    const clast_chart wanted = {.title = "user", .series = &line, .n_series = 1};
    size_t n_byte = 0;
    if (clast_chart_svg(&wanted, &svg, &n_byte) != CLAST_OK) {
        puts(clast_error_detail());
        return 1;
    }
    printf("%zu\n", n_byte);
    clast_chart_bytes_free(svg);
    return 0;
}
C
cat > "$work/user/CMakeLists.txt" <<'C'
cmake_minimum_required(VERSION 3.20)
project(user C)
find_package(clast 0.1 QUIET)
if(clast_FOUND)
  message(FATAL_ERROR "clast ${clast_VERSION} is taken for 0.1, whose interface is another")
endif()
find_package(clast QUIET COMPONENTS core)
if(clast_FOUND)
  message(FATAL_ERROR "COMPONENTS core, which is none, is found")
endif()
find_package(clast REQUIRED OPTIONAL_COMPONENTS core)
add_executable(user user.c)
target_link_libraries(user PRIVATE clast::clast)
find_package(clast REQUIRED COMPONENTS static)
add_executable(user_static user.c)
target_link_libraries(user_static PRIVATE clast::clast_static)
if(TARGET clast::view_static)
  message(FATAL_ERROR "clast::view_static without COMPONENTS view")
endif()
find_package(clast REQUIRED COMPONENTS view static)
add_executable(chart chart.c)
target_link_libraries(chart PRIVATE clast::view)
add_executable(chart_static chart.c)
target_link_libraries(chart_static PRIVATE clast::view_static)
C
# The documents' line: no LD_LIBRARY_PATH, and from C++ too.
export PKG_CONFIG_PATH=$lib/pkgconfig
user=$work/user/user.c
cc -std=c17 "$user" $(pkg-config --cflags --libs clast) -o "$work/by_pkg_config"
first=$("$work/by_pkg_config")
same() { # WHAT COMMAND...: it gives the answer of the first
    answer=$("${@:2}") && [ "$answer" = "$first" ] || { echo "$1 gives '$answer', pkg-config '$first'"; exit 1; }
}
for example in examples/*.c; do
    name=$(basename "$example" .c)
    cc -std=c17 "$example" $(pkg-config --cflags --libs clast) -lm -o "$work/$name"
    "$work/$name" > "$work/$name.txt" && [ -s "$work/$name.txt" ] || { echo "$example fails from the installed package"; exit 1; }
    ! ldd "$work/$name" | grep 'cairo\|libpng\|libX11' || { echo "$example links the core and loads a library of pictures (above)"; exit 1; }
done
chart=$work/user/chart.c
! cc -std=c17 "$chart" $(pkg-config --cflags --libs clast) -o "$work/chart" 2> "$work/log.chart" || { echo "a chart is drawn by the core alone"; exit 1; }
cc -std=c17 "$chart" $(pkg-config --cflags --libs clast_view) -o "$work/chart"
drawn=$("$work/chart")
if command -v g++ > /dev/null; then
    g++ -std=c++17 -x c++ "$user" -x none $(pkg-config --cflags --libs clast) -o "$work/by_cpp"
    same "C++" "$work/by_cpp"
    g++ -std=c++17 -ffp-contract=off examples/couple_flow.cpp $(pkg-config --cflags --libs clast) -o "$work/flow_cpp"
    "$work/flow_cpp" | cmp - "$work/couple_flow.txt" || { echo "examples/couple_flow.cpp gives another output than couple_flow.c"; exit 1; }
else
    echo "SKIPPED: g++ is not here, no C++ program was linked"
fi
# The archive, with the shared library out of sight.
mkdir "$work/hidden"; mv "$lib"/libclast*.so* "$work/hidden"
cc -std=c17 "$user" $(pkg-config --static --cflags --libs clast) -o "$work/by_archive"
same "pkg-config --static" "$work/by_archive"
! ldd "$work/by_archive" | grep 'cairo\|libpng' || { echo "libclast.a brings a library of pictures (above)"; exit 1; }
cc -std=c17 "$chart" $(pkg-config --static --cflags --libs clast_view) -o "$work/chart_archive"
[ "$("$work/chart_archive")" = "$drawn" ] || { echo "pkg-config --static clast_view draws another chart"; exit 1; }
mv "$work/hidden"/* "$lib"
cmake -S "$work/user" -B "$work/by_cmake" -DCMAKE_PREFIX_PATH="$prefix" >> "$work/log"
cmake --build "$work/by_cmake" >> "$work/log"
same "find_package" "$work/by_cmake/user"
same "find_package, static" "$work/by_cmake/user_static"
[ "$("$work/by_cmake/chart")" = "$drawn" ] && [ "$("$work/by_cmake/chart_static")" = "$drawn" ] ||
    { echo "find_package, view: another chart"; exit 1; }
! ldd "$work/by_cmake/user" | grep cairo || { echo "clast::clast brings cairo"; exit 1; }
! readelf -d "$work/by_cmake/user_static" "$work/by_cmake/chart_static" | grep libclast || { echo "clast::clast_static is linked to libclast.so"; exit 1; }

# As a part of another project: no test, command or tool is looked for, only the library is built. It lies in this folder, where the
# compiler's cache knows it again.
mkdir "$work/part"
part=$PWD/build/part; rm -rf "$part"
cat > "$work/part/CMakeLists.txt" <<C
cmake_minimum_required(VERSION 3.25)
project(part C)
add_subdirectory("$PWD" clast)
add_executable(user "$user")
target_link_libraries(user PRIVATE clast::clast)
add_executable(chart EXCLUDE_FROM_ALL "$chart")
target_link_libraries(chart PRIVATE clast::view)
enable_testing()
C
cmake -S "$work/part" -B "$part" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0 >> "$work/log"
! grep -qi 'cmocka\|python\|mpi_c' "$part/CMakeCache.txt" || { echo "add_subdirectory looks for test tools or MPI"; exit 1; }
cmake --build "$part" >> "$work/log"
same "add_subdirectory" "$part/user"
cmake --build "$part" --target chart >> "$work/log"
[ "$("$part/chart")" = "$drawn" ] || { echo "add_subdirectory, view: another chart"; exit 1; }
[ ! -e "$part/clast/clast" ] || { echo "add_subdirectory builds the command"; exit 1; }

# By CMake alone, with a library in a prefix of one's own: it is built for speed, and what is installed finds that library again; where parts
# are missing, one message names them all.
own=$work/own
mkdir -p "$own/lib/pkgconfig"
cp -L "$(pkg-config --variable=libdir jansson)/libjansson.so" "$own/lib/"
printf 'Name: jansson\nDescription: a copy\nVersion: 2.14\nLibs: -L%s/lib -ljansson\n' "$own" > "$own/lib/pkgconfig/jansson.pc"
PKG_CONFIG_PATH=$own/lib/pkgconfig cmake -S . -B "$work/plain" >> "$work/log"
grep -q '^CMAKE_BUILD_TYPE:STRING=Release$' "$work/plain/CMakeCache.txt" || { echo "cmake -S . -B FOLDER builds without optimisation"; exit 1; }
for made in libclast.so libclast_view.so bin/clast; do
    grep -A 12 "/$made" "$work/plain/cmake_install.cmake" | grep -q "NEW_RPATH.*$own/lib" || { echo "installed, $made does not look where its libraries are"; exit 1; }
done
! PKG_CONFIG_PATH='' PKG_CONFIG_LIBDIR=/none cmake -S . -B "$work/none" > "$work/log.none" 2>&1 || { echo "clast is configured without its libraries"; exit 1; }
grep -q 'jansson, yaml-0.1, qhull_r, lapacke' "$work/log.none" || { echo "cmake does not name all that is missing"; tail "$work/log.none"; exit 1; }

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
! command -v zsh > /dev/null || zsh -fn "$(find "$prefix" -name _clast)" || { echo "zsh cannot read its completion (above)"; exit 1; }
loaded=$(ldd "$work/decompose_cloud" | wc -l) drawing=$(ldd "$work/chart" | wc -l)
if [ "$build" = build/release ]; then
    make -s uninstall
    left=$(find "$prefix" ! -type d)
    [ -z "$left" ] || { echo "make uninstall leaves $left"; exit 1; }
fi
echo "installed: command, core and view by pkg-config, CMake and add_subdirectory, shared and static ($first), the examples, manual page," \
    "completion, uninstalled again; decompose_cloud loads $loaded libraries, a chart $drawing"
