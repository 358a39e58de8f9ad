#!/usr/bin/env bash
# The tests of ranks once more with MPICH, which lies beside Open MPI on Debian (mpich, libmpich-dev): build/mpich. Skips where it is not installed.
set -euo pipefail
cd "$(dirname "$0")/.."
if ! command -v mpicc.mpich >/dev/null || ! command -v mpiexec.mpich >/dev/null; then
    echo "SKIPPED LOUDLY: MPICH is not installed (mpich, libmpich-dev); the tests of ranks ran with Open MPI alone"
    exit 0
fi
log=$(mktemp); trap 'rm -f "$log"' EXIT
cmake --preset release -B build/mpich -DCLAST_MPI=ON -DMPI_C_COMPILER=mpicc.mpich -DMPIEXEC_EXECUTABLE="$(command -v mpiexec.mpich)" \
    >"$log" 2>&1 || { cat "$log"; exit 1; }
cmake --build build/mpich --target clast_cli clast_mpi_cli mpi_test_comm >"$log" 2>&1 || { cat "$log"; exit 1; }
ldd build/mpich/clast-mpi | grep -q 'libmpich[.]so' || { echo "check_mpich: build/mpich/clast-mpi does not load MPICH"; exit 1; }
ctest --test-dir build/mpich -L mpi --output-on-failure --no-tests=error
