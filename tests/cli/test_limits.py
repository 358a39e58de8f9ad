"""CLI: memory and time are bounded, and a signal ends every command at once."""
import gzip
import os
import pathlib
import signal
import subprocess
import time
import unittest

from clitest import CLAST, ROOT, Case, clast, preload


class Memory(Case):
    def bomb(self):
        """A megabyte that declares a billion voxels."""
        path = self.folder / "bomb.nrrd"
        with open(path, "wb") as file:
            file.write(b"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1000 1000 1000\nencoding: gzip\n\n")
            with gzip.GzipFile(fileobj=file, mode="wb", compresslevel=1) as packed:
                for _ in range(1000):
                    packed.write(bytes(1000000))
        return path

    def test_a_declared_size_is_refused_before_it_is_taken(self):
        began = time.monotonic()
        path = self.bomb()
        made = time.monotonic()
        self.assert_fails(4, "shape", path, "--max-memory", "1GB",
                          says=["bomb.nrrd", "4 GB of memory more are wanted", "the limit is 1 GB", "--max-memory"])
        self.assertLess(time.monotonic() - made, 5 + (made - began))

    def test_every_size_is_understood_or_refused(self):
        grain = ROOT / "data/standin63/grain00.ply"
        for size in ("8GB", "512 MiB", "50%", "0"):
            self.assertEqual(clast("shape", grain, "--max-memory", size).code, 0, size)
        for size, says in (("8", "8 has no unit"), ("x", "not a number"), ("-1GB", "-1GB"), ("", "empty value"), ("8m", "known here: B, kB")):
            self.assert_fails(2, "shape", grain, "--max-memory", size, says=["max-memory", says])

    def test_the_least_limit_of_the_control_groups_holds(self):
        """Those of a job under Slurm were not looked at: it set them on the job's group, not on the root."""
        source = """#include <dlfcn.h>
            #include <stdio.h>
            #include <stdlib.h>
            #include <string.h>
            static FILE *pass(const char *name, const char *path, const char *mode)
            {
                char other[4096];
                if (strcmp(path, "/proc/self/cgroup") == 0 || strncmp(path, "/sys/fs/cgroup", 14) == 0) {
                    snprintf(other, sizeof other, "%s%s", getenv("GROUPS_AT"), path);
                    path = other;
                }
                return ((FILE *(*)(const char *, const char *))dlsym(RTLD_NEXT, name))(path, mode);
            }
            FILE *fopen(const char *path, const char *mode) { return pass("fopen", path, mode); }
            FILE *fopen64(const char *path, const char *mode) { return pass("fopen64", path, mode); }"""
        env = preload(self.folder, source)
        none = "9223372036854771712"
        for number, (own, limits, says) in enumerate((
                ("0::/slurm/job_7/step_0\n", {"slurm/job_7/memory.max": "23000", "slurm/job_7/step_0/memory.max": "max"}, "23 kB"),
                ("0::/slurm/job_7/step_0\n", {"slurm/memory.max": "25000", "slurm/job_7/step_0/memory.max": "24000"}, "24 kB"),
                ("5:cpu:/a\n4:memory:/slurm/uid_0/job_7\n0::/b\n",
                 {"memory/slurm/uid_0/memory.limit_in_bytes": "26000", "memory/slurm/uid_0/job_7/memory.limit_in_bytes": none}, "26 kB"),
                ("0::/not/to/be/seen/here\n", {"memory.max": "27000"}, "27 kB"))):
            root = self.folder / str(number)
            for name, text in {"proc/self/cgroup": own, **{f"sys/fs/cgroup/{name}": f"{text}\n" for name, text in limits.items()}}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            self.assert_fails(4, "mesh", "check", ROOT / "data/standin63/grain00.ply", "--max-memory", "100%", env={**env, "GROUPS_AT": str(root)}, says=[f"the limit is {says}"])

    def test_a_small_limit_is_one_line(self):
        grain = ROOT / "data/standin63/grain00.ply"
        self.assert_fails(4, "mesh", "check", grain, "--max-memory", "20kB", says=["kB of memory more are wanted", "the limit is 20 kB", "--max-memory"])


def wait_for_work(process, seconds):
    """Until the process has had so much time of a processor: on a busy machine 2 s may be none."""
    ticks = seconds * os.sysconf("SC_CLK_TCK")
    while process.poll() is None:
        stat = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        if int(stat[11]) + int(stat[12]) >= ticks:
            return
        time.sleep(0.01)


class Signals(Case):
    def end(self, number, after, *words):
        """Code, stderr and seconds to the end of a command that gets a signal after `after` seconds of work."""
        with subprocess.Popen([CLAST, *map(str, words)], cwd=self.folder, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True) as process:
            wait_for_work(process, after)
            self.assertIsNone(process.poll(), "ended by itself")
            began = time.monotonic()
            process.send_signal(number)
            error = process.communicate()[1]
            return process.returncode, error, time.monotonic() - began

    def many_points(self):
        path = self.folder / "points.csv"
        with open(path, "w", encoding="ascii") as file:
            file.write("x,y,z\n")
            for i in range(400000):
                file.write(f"{i * 0.618034 % 1:.9f},{i * 0.754878 % 1:.9f},{i * 0.569840 % 1:.9f}\n")
        return path

    def test_a_reader_and_a_statistic_end_at_once(self):
        path = self.many_points()
        for number, code in ((signal.SIGTERM, 143), (signal.SIGINT, 130), (signal.SIGHUP, 129)):
            ended, error, seconds = self.end(number, 0.4, "decompose", path, "--domain", "box:0,0,0,1,1,1")
            self.assertEqual(ended, code, error)
            self.assertIn("clast decompose: ended by a signal", error)
            self.assertLess(seconds, 2.0)  # 0.5 s of a machine that does nothing else

    def test_what_was_there_before_stays(self):
        path = self.many_points()
        old = self.folder / "cells"
        done = clast("decompose", ROOT / "data/d2sd/points_u3_n50.csv", "--domain", "box:0,0,0,1,1,1", "-o", old)
        self.assertIn(done.code, (0, 1), done.err)
        before = {p.name: p.read_bytes() for p in old.iterdir()}
        self.end(signal.SIGTERM, 0.4, "decompose", path, "--domain", "box:0,0,0,1,1,1", "-o", old, "--force")
        self.assertEqual({p.name: p.read_bytes() for p in old.iterdir()}, before)
        left = [p.name for p in pathlib.Path(self.folder).rglob(".clast-*")]
        self.assertEqual(left, [])

    def test_a_loop_with_a_state_saves_it(self):
        ended, error, _ = self.end(signal.SIGTERM, 2.0, "pack", "--curve", "2 mm", "--mass", "50g", "--width", "40mm",
                                   "--height", "0.2m", "-o", "bed", "-j", "1")
        self.assertEqual(ended, 143, error)
        self.assertIn("go on with clast pack --resume bed", error)


if __name__ == "__main__":
    unittest.main()
