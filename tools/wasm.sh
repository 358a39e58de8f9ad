#!/usr/bin/env bash
# clast for browsers and node: tools/wasm.sh -> build/wasm/npm, a package of clast.mjs, clast.d.ts and clast.wasm.
# CLAST names a native build of the same sources, whose `describe --json` gives the types of the options.
# Files are compiled by emcc's own clang with emcc's flags, without its Python program, which takes longer than most files.
set -eu
cd "$(dirname "$0")/.."
command -v emcc >/dev/null || { echo "wasm: emcc is not installed (tools/setup.sh wasm)" >&2; exit 1; }
tools/portable.sh wasm
prefix=$PWD/build/portable/wasm
export PKG_CONFIG_LIBDIR=$prefix/lib/pkgconfig
export NODE_PATH=/usr/share/nodejs # where Debian keeps what emcc asks node for, which a node of another origin does not look through
log=build/wasm.log
compile="$(command -v ccache || true) $(em-config LLVM_ROOT)/clang $(emcc --cflags | tail -1) -msimd128 <DEFINES> <INCLUDES> <FLAGS> -o <OBJECT> -c <SOURCE>"
{ [ -f build/wasm/build.ninja ] ||
    emcmake cmake -S . -B build/wasm -G Ninja "-DCMAKE_C_COMPILE_OBJECT=$compile" -DCMAKE_BUILD_TYPE=Release "-DCMAKE_C_FLAGS_RELEASE=-O3 -DNDEBUG" -DCLAST_VIEW=ON \
        -DCLAST_THREADS=OFF -DCLAST_HDF5=OFF -DCLAST_TIFF=OFF -DCLAST_SUNDIALS=OFF -DCLAST_MPI=OFF -DBUILD_TESTING=OFF -DCLAST_BENCH=OFF \
        -DCLAST_INSTALL=OFF "-DCMAKE_EXE_LINKER_FLAGS=-L$prefix/lib" -DZLIB_LIBRARY="$prefix/lib/libz.a" -DZLIB_INCLUDE_DIR="$prefix/include" -DRANDOM123_INCLUDE="$prefix/include"
  cmake --build build/wasm --target clast_cli; } > "$log" 2>&1 || { grep -E 'error|FAILED' "$log" | head -40; tail -5 "$log"; exit 1; }
python3 tools/make_wasm.py build/wasm "${CLAST:-build/release/clast}"
python3 tools/make_live.py build/wasm
