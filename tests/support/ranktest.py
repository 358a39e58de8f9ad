"""Runs the built command over ranks for the tests in tests/mpi (CLAST_MPI and MPIEXEC name it and its launcher)."""
import fcntl
import os
import signal
import subprocess
import time

CLAST_MPI = os.environ["CLAST_MPI"]
MPIEXEC = os.environ["MPIEXEC"]
# Two cores are enough for four ranks; a container's root is no danger to anybody.
ENV = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
       "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none"}


def start(n, *arguments, partition="rcb"):
    return subprocess.Popen([MPIEXEC, "-n", str(n), CLAST_MPI, *map(str, arguments)], text=True,
                            env={**ENV, "CLAST_PARTITION": partition},
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)


def ranks(n, *arguments, seconds=120, partition="rcb"):
    """Runs `clast-mpi ARGUMENTS` on n ranks: (code, out, err). A run that hangs is killed, ranks and all."""
    process = start(n, *arguments, partition=partition)
    try:
        out, err = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        raise
    return process.returncode, out, err


def own_lines(err):
    """What clast said, without mpirun's own remarks."""
    return [line for line in err.splitlines() if line.startswith("clast")]


def wait_until_free(run):
    """Ranks outlive a killed one by a moment, and hold the folder's lock until then."""
    until = time.time() + 60
    folder = os.open(run, os.O_RDONLY)
    try:
        while time.time() < until:
            try:
                fcntl.flock(folder, fcntl.LOCK_SH | fcntl.LOCK_NB)
                return
            except BlockingIOError:
                time.sleep(0.05)
    finally:
        os.close(folder)
