#!/usr/bin/env bash
# The core, the view, the command.
set -eux
cmake -S . -B build/conda -G Ninja ${CMAKE_ARGS:-} -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$PREFIX" -DCMAKE_INSTALL_LIBDIR=lib \
    -DBUILD_TESTING=OFF -DCLAST_BENCH=OFF -DCLAST_MPI=OFF -DCLAST_THREADS=ON -DCLAST_TIFF=ON -DCLAST_SUNDIALS=ON -DCLAST_PC_RPATH=OFF \
    -DRANDOM123_INCLUDE="$PWD/random123/include"
cmake --build build/conda
cmake --install build/conda
rm "$PREFIX"/lib/libclast.a "$PREFIX"/lib/libclast_view.a "$PREFIX"/lib/cmake/clast/*_staticTargets*.cmake
