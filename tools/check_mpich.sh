#!/usr/bin/env bash
# Tests of ranks once more with MPICH, which lies beside Open MPI on Debian (mpich, libmpich-dev): build/mpich. Skips where it is not installed.
# tools/check_mpich.sh [all]: some of each family, or all.
set -euo pipefail
cd "$(dirname "$0")/.."
if ! command -v mpicc.mpich >/dev/null || ! command -v mpiexec.mpich >/dev/null; then
    echo "SKIPPED LOUDLY: MPICH is not installed (mpich, libmpich-dev); the tests of ranks ran with Open MPI alone"
    exit 0
fi
log=$(mktemp); trap 'rm -f "$log"' EXIT
cmake --preset release -B build/mpich -DCLAST_MPI=ON -DMPI_C_COMPILER=mpicc.mpich -DMPIEXEC_EXECUTABLE="$(command -v mpiexec.mpich)" \
    >"$log" 2>&1 || { cat "$log"; exit 1; }
cmake --build build/mpich --target clast_cli clast_mpi_cli mpi_tests >"$log" 2>&1 || { cat "$log"; exit 1; }
ldd build/mpich/clast-mpi | grep 'libmpich[.]so' || { echo "check_mpich: build/mpich/clast-mpi does not load MPICH"; exit 1; }
if [ "${1:-}" = all ]; then exec ctest --test-dir build/mpich -L mpi --output-on-failure --no-tests=error; fi
ctest --test-dir build/mpich -L mpi -R test_comm_ --output-on-failure --no-tests=error
export PYTHONPATH=tests/support PYTHONDONTWRITEBYTECODE=1 CLAST=build/mpich/clast CLAST_MPI=build/mpich/clast-mpi MPIEXEC
MPIEXEC=$(command -v mpiexec.mpich)
python3 tests/mpi/test_cloud.py Cloud.test_any_ranks_and_any_order_are_the_same_bytes Cloud.test_files_are_the_same_bytes Cloud.test_rows_of_hdf5_are_shared_out
python3 tests/mpi/test_pack_ranks.py Beds.test_hulls_in_a_periodic_box Beds.test_files_and_checkpoints
python3 tests/mpi/test_faults.py Faults.test_a_rank_that_hangs Faults.test_a_launcher_of_another_mpi
