"""MPI: a rank that hangs, files that are lost, a full disk: the job ends in time with one line, leaves no process, and goes on."""
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import time
import unittest

import ranktest
from clitest import Case, clast
from ranktest import ENV, MPIEXEC, is_alive, own_lines, process_of_rank, start, wait_until_free

SPHERES = ("pack", "--curve", "4mm", "--width", "24mm", "--gravity", "400m/s^2", "--restitution", "0.3", "--first-low", "0.05",
           "--fill-low", "0.5", "-q", "--mass", "6g", "--height", "40mm", "--shaking-time", "9", "--max-steps", "60000")
CLAST_MPI = os.path.abspath(ranktest.CLAST_MPI)
LIMIT = 2  # s, of ranks that are not heard of
KILLING = 60  # s that a busy machine may take to come to the fault and to end the others


class Faults(Case):
    @classmethod
    def setUpClass(cls):
        cls.hash = clast(*SPHERES, "--json").json["state_hash"]

    def wait_for(self, run, n):
        """Until there are n checkpoints."""
        until = time.time() + 60
        while time.time() < until and len(list(run.glob("checkpoint*"))) < n:
            time.sleep(0.05)

    def begin(self, **more):
        """A bed on three ranks whose second checkpoint is there, and the processes of its ranks."""
        run = self.folder / "run"
        process = start(3, *SPHERES, "--checkpoint-time", 0, "-o", run, **more)
        self.wait_for(run, 2)
        return run, process, [process_of_rank(process, k) for k in range(3)]

    def end(self, process, pids, seconds):
        """Its remarks; it must end in time, and leave no process."""
        begun = time.time()
        _, err = process.communicate(timeout=seconds)
        while time.time() < begun + seconds and any(map(is_alive, pids)):
            time.sleep(0.05)
        self.assertEqual([pid for pid in pids if is_alive(pid)], [], err)
        self.assertNotEqual(process.returncode, 0, err)
        return err

    def goes_on(self, run):
        """To the state of a run that nothing befell; with other numbers of ranks: test_pack_ranks.py."""
        wait_until_free(run)
        again = clast("pack", "--resume", run, "--json", "-q")
        self.assertEqual(again.code, 0, again.err)
        self.assertEqual(again.json["state_hash"], self.hash)

    def test_a_rank_that_hangs(self):
        for rank in (2, 0):
            shutil.rmtree(self.folder / "run", ignore_errors=True)
            run, process, pids = self.begin(timeout=LIMIT)
            os.kill(pids[rank], signal.SIGSTOP)
            err = self.end(process, pids, LIMIT + KILLING)
            line = [l for l in own_lines(err) if "not heard of" in l]
            self.assertEqual(len(line), 1, err)
            self.assertIn(f"rank {rank} (process {pids[rank]} on ", line[0])
            self.assertIn(f"not heard of for {LIMIT} s", line[0])
            self.goes_on(run)

    def test_a_job_that_is_suspended_whole_goes_on(self):
        run, process, pids = self.begin(timeout=LIMIT)
        for pid in pids:
            os.kill(pid, signal.SIGSTOP)
        time.sleep(2 * LIMIT)
        before = set(run.glob("checkpoint*"))
        for pid in pids:
            os.kill(pid, signal.SIGCONT)
        until = time.time() + KILLING
        while time.time() < until and process.poll() is None and set(run.glob("checkpoint*")) == before:
            time.sleep(0.05)
        self.assertNotEqual(set(run.glob("checkpoint*")), before)
        process.send_signal(signal.SIGTERM)
        self.assertNotIn("not heard of", self.end(process, pids, KILLING))

    def test_a_killed_launcher_leaves_no_rank(self):
        run, process, pids = self.begin()
        process.kill()
        process.communicate()
        until = time.time() + KILLING
        while time.time() < until and any(map(is_alive, pids)):
            time.sleep(0.05)
        self.assertEqual([pid for pid in pids if is_alive(pid)], [])
        self.goes_on(run)

    def test_a_full_disk(self):
        run, process, pids = self.begin()
        resource.prlimit(pids[0], resource.RLIMIT_FSIZE, (8192, 8192))  # no file of rank 0 can be longer
        err = self.end(process, pids, KILLING)
        self.assertEqual(len(own_lines(err)), 1, err)
        self.assertRegex(own_lines(err)[0], r"clast pack: rank 0: cannot write .*checkpoint.*File too large")
        self.assertTrue(list(run.glob("checkpoint*")))
        self.goes_on(run)

    def test_a_checkpoint_that_is_lost(self):
        run, process, pids = self.begin()
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=60)
        wait_until_free(run)
        newest = max(run.glob("checkpoint*"), key=lambda path: path.stat().st_mtime_ns)
        newest.write_bytes(newest.read_bytes()[:4000])
        self.goes_on(run)

    def test_a_folder_that_is_lost(self):
        """Between two checkpoints it is made anew; while one is written the job ends with its line, and what was moved is whole."""
        run, process, pids = self.begin()
        elsewhere = self.folder / "elsewhere"
        os.rename(run, elsewhere)
        until = time.time() + KILLING
        while time.time() < until and process.poll() is None and not list(run.glob("checkpoint*")):
            time.sleep(0.05)
        is_anew = process.poll() is None
        if is_anew:
            process.send_signal(signal.SIGTERM)
        err = self.end(process, pids, KILLING)
        if not is_anew:
            self.assertEqual(len(own_lines(err)), 1, err)
            self.assertRegex(own_lines(err)[0], r"clast pack: rank 0: cannot (read|write) .*No such file")
        self.goes_on(run if is_anew else elsewhere)

    def test_a_file_that_one_machine_does_not_have(self):
        here, there = self.folder / "here", self.folder / "there"
        for folder in (here, there):
            folder.mkdir()
        (here / "points.csv").write_text("x,y,z\n" + "0.1,0.2,0.3\n" * 20)
        shutil.copy("data/scarlet/stl/27sk21_shape_fine.stl", here / "grain.stl")
        for words, name in ((("decompose", "points.csv", "--domain", "box:0,0,0,1,1,1"), "points.csv"),
                            (("pack", "--shapes", "grain.stl", "--hull", "--mass", "1g"), "grain.stl")):
            done = self.on_two_machines(here, there, *words)
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual(len(own_lines(done.stderr)), 1, done.stderr)
            self.assertRegex(own_lines(done.stderr)[0], rf"rank 1: .*{name}.*No such file")

    def on_two_machines(self, here, there, *words):
        """A rank in each of two folders, as on disks of their own."""
        rank = 'cd "$1"; shift; exec "$0" "$@"'
        job = [MPIEXEC]
        for number, folder in enumerate((here, there)):
            job += [":"] * number + ["-n", "1", "bash", "-c", rank, CLAST_MPI, str(folder), *map(str, words)]
        return subprocess.run(job, env=ENV, text=True, capture_output=True, timeout=60)

    def test_files_that_are_other_ones_on_one_machine(self):
        """The result was of neither, MPI's error, or the job hung."""
        here, there = self.folder / "here", self.folder / "there"
        stl = pathlib.Path("data/scarlet/stl")
        rows = [f"0.{3 * k % 997:03d},0.{7 * k % 991:03d},0.{11 * k % 983:03d}\n" for k in range(1, 2001)]
        for folder, fine, friction, n in ((here, "fine", 0.1, 2000), (there, "coarse", 0.5, 1500)):
            folder.mkdir()
            shutil.copy(stl / f"27sk21_shape_{fine}.stl", folder / "grain.stl")
            (folder / "bed.yaml").write_text(f"curve: 4mm\nwidth: 24mm\nheight: 40mm\nmass: 6g\nfriction: {friction}\n")
            (folder / "study.yaml").write_text(f"run: fill\nargument: [grain.stl]\nvary: [spheres = 5 | {n}]\n")
            (folder / "points.csv").write_text("x,y,z\n" + "".join(rows[:n]))
            (folder / "swapped.csv").write_text("x,y,z\n" + "".join(rows[:2000] if n == 2000 else rows[1::-1] + rows[2:]))
            (folder / "cell.stl").write_bytes((folder / "grain.stl").read_bytes())
        box = ("--domain", "box:0,0,0,1,1,1")
        core = ("--core", "grain.stl", "--coat", "sphere", "--size", "8um", "--replicate", "2", "--repeats", "2", "--unit", "um")
        for words, says in (
                (("pack", "bed.yaml", "--max-steps", "100"), "rank 1: reads another configuration than rank 0 (friction differs)"),
                (("pack", "--shapes", "grain.stl", "--hull", "--mass", "1g", "--max-steps", "9"), "rank 1: reads another grain.stl than rank 0"),
                (("aggregate", *core, "-o", self.folder / "grown"), "rank 1: reads another grain.stl than rank 0"),
                (("study", "study.yaml", "-o", self.folder / "many"), "rank 1: reads another configuration than rank 0 (vary differs)"),
                (("study", "--run", "fill", "--argument", "grain.stl", "--vary", "spheres=5|6", "-o", self.folder / "many"),
                 "rank 1: reads another grain.stl than rank 0"),
                (("decompose", "points.csv", *box, "--json"), "rank 1: reads another points.csv than rank 0"),
                (("decompose", "swapped.csv", *box, "-o", self.folder / "cells"), "rank 1: reads another swapped.csv than rank 0"),
                (("decompose", here / "points.csv", "--domain", "mesh:cell.stl", "--unit", "mm"), "rank 1: reads another cell.stl than rank 0")):
            with self.subTest(words[:3]):
                done = self.on_two_machines(here, there, *words, "-q")
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertEqual(len(own_lines(done.stderr)), 1, done.stderr)
                self.assertIn(says, own_lines(done.stderr)[0])
        self.assertEqual([path.name for path in self.folder.iterdir() if path not in (here, there)], [])

    def test_a_run_that_is_another_one_on_one_machine(self):
        """It hung."""
        here, there = self.folder / "here", self.folder / "there"
        for folder, steps in ((here, 200), (there, 300)):
            folder.mkdir()
            self.assertEqual(clast(*SPHERES[:-2], "--max-steps", steps, "-o", folder / "run").code, 0)
        done = self.on_two_machines(here, there, "pack", "--resume", "run", "-q")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(len(own_lines(done.stderr)), 1, done.stderr)
        self.assertIn("rank 1: finds run/state.h5 where rank 0 goes on from another checkpoint", own_lines(done.stderr)[0])

    def test_a_launcher_that_keeps_on_leaves_no_rank(self):
        """srun without --kill-on-bad-exit: rank 0 said which rank was lost and ended, the others waited for ever."""
        if "open" not in subprocess.run([MPIEXEC, "--version"], text=True, capture_output=True).stdout.lower():
            self.skipTest("SKIPPED LOUDLY: no Open MPI, whose launcher can be told to keep on")
        plan = self.folder / "study.yaml"
        plan.write_text("run: pack\nconfig: examples/u1.yaml\nfix: [mass=60g]\nseeds: 4\n")
        with subprocess.Popen([MPIEXEC, "--enable-recovery", "--mca", "orte_abort_on_non_zero_status", "0", "-n", "3", CLAST_MPI, "study", plan,
                               "-q", "-o", self.folder / "many", "--time-limit", "300s"], env={**ENV, "CLAST_RANK_TIMEOUT": str(LIMIT)},
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True) as process:
            runs = self.folder / "many/runs"
            while len(list(runs.glob("*.part/out/checkpoint-*"))) < 3 and process.poll() is None:
                time.sleep(0.05)
            pids = [process_of_rank(process, k) for k in range(3)]
            os.kill(pids[2], signal.SIGKILL)
            try:
                until = time.time() + KILLING
                while time.time() < until and any(map(is_alive, pids)):
                    time.sleep(0.05)
                self.assertEqual([pid for pid in pids if is_alive(pid)], [])
            finally:
                os.killpg(process.pid, signal.SIGKILL)
                for pid in filter(is_alive, pids):
                    os.kill(pid, signal.SIGKILL)
            _, err = process.communicate()
        self.assertIn("rank 2", err)

    def test_a_launcher_of_another_mpi(self):
        others = [path for path in map(shutil.which, ("mpiexec.openmpi", "mpiexec.mpich"))
                  if path and os.path.realpath(path) != os.path.realpath(MPIEXEC)]
        if not others:
            self.skipTest("SKIPPED LOUDLY: one MPI is installed; a launcher of another was not tried")
        done = subprocess.run([others[0], "-n", "2", CLAST_MPI, *SPHERES, "-o", self.folder / "run"], env=ENV, text=True,
                              capture_output=True, timeout=60)
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(len(own_lines(done.stderr)), 1, done.stderr)
        self.assertIn("its launcher began 2 processes, but each sees itself alone", done.stderr)
        self.assertFalse((self.folder / "run").exists())

    def test_a_time_limit_of_ranks_is_checked(self):
        for word in ("soon", "0.5", "-1", ""):
            process = start(2, "shape", "data/scarlet/stl/27sk21_shape_fine.stl", timeout=word)
            _, err = process.communicate(timeout=60)
            self.assertNotEqual(process.returncode, 0)
            self.assertEqual(len(own_lines(err)), 1, err)
            self.assertIn("CLAST_RANK_TIMEOUT", err)

    def test_ranks_of_a_machine_share_its_memory(self):
        """Each had the whole limit, by default 80 % of the machine's."""
        process = start(2, *SPHERES, "--max-memory", "20kB", "-o", self.folder / "run")
        _, err = process.communicate(timeout=60)
        self.assertNotEqual(process.returncode, 0)
        self.assertEqual(len(own_lines(err)), 1, err)
        self.assertIn("the limit is 10 kB", err)


if __name__ == "__main__":
    unittest.main()
