"""Runs the built command over ranks for the tests in tests/mpi (CLAST_MPI and MPIEXEC name it and its launcher)."""
import fcntl
import os
import pathlib
import signal
import subprocess
import time

CLAST_MPI = os.environ["CLAST_MPI"]
MPIEXEC = os.environ["MPIEXEC"]
# Two cores are enough for four ranks; a container's root is no danger to anybody.
ENV = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
       "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none"}


def start(n, *arguments, partition="rcb", timeout=None):
    """Begins `clast-mpi ARGUMENTS` on n ranks; timeout: CLAST_RANK_TIMEOUT."""
    env = {**ENV, "CLAST_PARTITION": partition, **({} if timeout is None else {"CLAST_RANK_TIMEOUT": str(timeout)})}
    return subprocess.Popen([MPIEXEC, "-n", str(n), CLAST_MPI, *map(str, arguments)], text=True, env=env,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)


def process_of_rank(process, rank):
    """The process id of a rank of a job that start() began, below its launcher and what that starts."""
    found = [process.pid]
    for pid in found:
        for task in pathlib.Path(f"/proc/{pid}/task").glob("*/children"):
            found += map(int, task.read_text().split())
    for pid in found[1:]:
        words = pathlib.Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
        named = [b"%s=%d" % (name, rank) for name in (b"OMPI_COMM_WORLD_RANK", b"PMI_RANK", b"PMIX_RANK")]
        if os.path.basename(CLAST_MPI) in pathlib.Path(f"/proc/{pid}/cmdline").read_text() and any(w in words for w in named):
            return pid
    raise LookupError(f"no rank {rank} among {found}")


def is_alive(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


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
