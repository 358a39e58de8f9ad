#!/usr/bin/env bash
# Each public header compiles alone, and all of them together, as C99, C17, C++17 and C++20 by GCC and Clang, without a warning;
# in C++ inside extern "C" too. The declarations of each stand between CLAST_BEGIN and CLAST_END. So do code_saturne's user sources, as the
# solver compiles them. What is not here is named and left out.
set -eu
cd "$(dirname "$0")/.."
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
for path in include/clast/*.h; do
    name=$(basename "$path" .h)
    printf '#include <clast/%s.h>\n' "$name" > "$work/$name.c"
    cp "$work/$name.c" "$work/$name.cpp"
    printf 'extern "C" {\n#include <clast/%s.h>\n}\n' "$name" > "$work/$name-inside.cpp"
done
for path in include/clast/*.h; do
    [ "$path" = include/clast/clast.h ] || { grep -qx CLAST_BEGIN "$path" && [ "$(tail -1 "$path")" = CLAST_END ]; } ||
        { echo "headers: the declarations of $path do not stand between CLAST_BEGIN and CLAST_END: C++ could not link them"; exit 1; }
done
n=0
compile() { # COMPILER STANDARD FILE...
    if ! command -v "$1" > /dev/null; then
        echo "SKIPPED: $1 is not here, no header was compiled as $2 by it (tools/setup.sh test)"
        return
    fi
    "$1" "-std=$2" -Wall -Wextra -Wpedantic -Wundef -Werror -fsyntax-only -Iinclude "${@:3}" || { echo "headers: $1 -std=$2 fails (above)"; exit 1; }
    n=$((n + $# - 2))
}
for standard in c99 c17; do
    compile gcc "$standard" "$work"/*.c
    compile clang-14 "$standard" "$work"/*.c
done
for standard in c++17 c++20; do
    compile g++ "$standard" "$work"/*.cpp
    compile clang++-14 "$standard" "$work"/*.cpp
done
echo "headers: $(ls include/clast/*.h | wc -l) compile as C99, C17, C++17 and C++20 ($n compilations)"
solver=/usr/include/code_saturne
if [ -d "$solver" ] && command -v mpicc > /dev/null; then
    for ranks in '' -DHAVE_CLAST_MPI; do
        for path in examples/code_saturne/SRC/*.c; do
            mpicc -std=c99 -pedantic -Wall -Wextra -Wno-unused-parameter -Werror -fsyntax-only -DHAVE_CONFIG_H $ranks -Iinclude -isystem "$solver" "$path" ||
                { echo "headers: $path does not compile with code_saturne's (above)"; exit 1; }
        done
    done
    echo "headers: the user sources of examples/code_saturne compile"
else
    echo "SKIPPED: code_saturne's headers or mpicc are not here, its user sources were not compiled (tools/setup.sh test)"
fi
