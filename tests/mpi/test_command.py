"""MPI: `clast-mpi` gives the same bytes on 1, 2 and 4 ranks as `clast`, and fails and stops on all ranks."""
import csv
import os
import pathlib
import signal
import time
import unittest

from clitest import Case, clast
from ranktest import own_lines, process_of_rank, ranks, start, wait_until_free

SURFACE = "data/scarlet/stl/27sk21_shape_fine.stl"
SPHERES = ("aggregate", "--core", "sphere", "--core-size", "30um", "--coat", "sphere", "--size", "8um", "--rays", "10",
           "--no-picture", "--envelope", "sphere_hull", "-q")


class Ranks(Case):
    def files(self, folder):
        """Bytes of a run's files but those that name the command and the time, and a killed writer's leavings."""
        return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(pathlib.Path(folder).rglob("*"))
                if path.is_file() and path.name not in ("manifest.json", "report.html") and path.name[0] != "."}

    def study(self, folder, *more):
        plan = self.folder / "study.yaml"
        plan.write_text(f"run: fill\nargument: [{SURFACE}]\nvary: [spheres = 5 | 9 | 12, strategy = random | largest]\n")
        return ("study", plan, "-o", folder, "-q", *more)

    def test_a_study_is_the_same_table(self):
        alone = clast(*self.study(self.folder / "alone", "-j", 1), "--json")
        self.assertEqual(alone.code, 0, alone.err)
        for n in (1, 2, 4):
            code, out, err = ranks(n, *self.study(self.folder / str(n)))
            self.assertEqual(code, 0, err)
            self.assertEqual(out.count("6 runs: 6 done now"), 1)  # said once
            self.assertEqual((self.folder / str(n) / "results.csv").read_bytes(),
                             (self.folder / "alone/results.csv").read_bytes())

    def test_a_run_that_fails_is_named_and_tried_again(self):
        folder = self.folder / "out"
        wrong = self.folder / "wrong.stl"
        wrong.write_text("not yet a surface\n")
        arguments = ("study", "--run", "fill", "--vary", "spheres=5|6|7", "--argument", wrong, "-o", folder, "-q")
        code, _, err = ranks(2, *arguments)
        self.assertEqual(code, 1, err)
        with open(folder / "results.csv", newline="", encoding="utf-8") as file:
            self.assertEqual([row["exit_code"] for row in csv.DictReader(file)], ["3", "3", "3"])
        self.assertIn("wrong.stl", (folder / "runs/000002.part/messages.txt").read_text())
        wrong.write_bytes(pathlib.Path(SURFACE).read_bytes())
        code, out, err = ranks(2, *arguments)
        self.assertEqual(code, 0, err)
        self.assertIn("3 done now", out)

    def test_repeats_are_the_same_bytes(self):
        command = (*SPHERES, "--replicate", 30, "--repeats", 5, "--checkpoint-every", 10)
        alone = clast(*command, "-o", self.folder / "alone")
        self.assertEqual(alone.code, 0, alone.err)
        for n in (1, 2, 4):
            code, out, err = ranks(n, *command, "-o", self.folder / str(n))
            self.assertEqual(code, 0, err)
            self.assertEqual(out.replace(str(self.folder / str(n)), "RUN"), alone.out.replace(str(self.folder / "alone"), "RUN"))
            self.assertTrue(self.files(self.folder / str(n)) == self.files(self.folder / "alone"))

    def test_a_killed_job_goes_on(self):
        command = (*SPHERES, "--replicate", 60, "--rays", 1000, "--checkpoint-every", 5)
        begun = time.time()
        self.assertEqual(clast(*command, "--repeats", 4, "-o", self.folder / "short").code, 0)
        # mpirun takes 2 s to pass a signal on: work for 6 s at least, on a fast machine too
        command += ("--repeats", max(12, min(600, round(6 * 4 / (time.time() - begun)))))
        whole = clast(*command, "-o", self.folder / "whole")
        self.assertEqual(whole.code, 0, whole.err)
        for number, n in ((signal.SIGINT, 1), (signal.SIGKILL, 2)):
            run = self.folder / f"cut-{number}"
            process = start(4, *command, "-o", run)
            until = time.time() + 60
            while not list(run.glob("repeat-*/checkpoint-*.h5")) and time.time() < until and process.poll() is None:
                time.sleep(0.01)
            if number == signal.SIGKILL:
                os.killpg(process.pid, number)
            else:
                process.send_signal(number)
            process.communicate(timeout=60)
            wait_until_free(run)
            self.assertFalse((run / "summary.json").exists())
            code, _, err = ranks(n, "aggregate", "--resume", run, "-q")
            self.assertEqual(code, 0, err)
            self.assertTrue(self.files(run) == self.files(self.folder / "whole"))

    def test_a_signal_to_one_rank_is_the_code_of_all(self):
        """mpirun ended with 130, which no script asks for."""
        command = (*SPHERES, "--replicate", 60, "--rays", 1000, "--checkpoint-every", 5, "--repeats", 600)
        for rank in (1, 0):
            run = self.folder / f"cut-{rank}"
            process = start(2, *command, "-o", run)
            until = time.time() + 60
            while not list(run.glob("repeat-*/checkpoint-*.h5")) and time.time() < until and process.poll() is None:
                time.sleep(0.01)
            os.kill(process_of_rank(process, rank), signal.SIGTERM)
            _, err = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 143, err)

    def test_a_partition_that_is_not_known_is_named_once(self):
        """It said which words there are, not the one that it found; the library left no line."""
        code, _, err = ranks(2, "--version", partition="metis")
        self.assertEqual(code, 2)
        self.assertEqual(own_lines(err), ["clast-mpi: CLAST_PARTITION 'metis': rcb, hsfc (with Zoltan) or own"])

    def test_what_cannot_be_shared_says_so_once(self):
        for arguments, code, says in (
                (("mesh", "check", SURFACE), 2, "without mpirun"),
                (("aggregate", "--fit", "--core", "sphere"), 2, "--fit runs on one rank"),
                (("study", "--vry", "a=1"), 2, "did you mean --vary"),
                (("study", "--run", "fill", "--vary", "spheres=1|2"), 2, "-o FOLDER"),
                (("aggregate", self.folder / "absent.yaml"), 3, "absent.yaml"),
                (("aggregate", "--resume", self.folder), 3, "no checkpoint")):
            found, out, err = ranks(2, *arguments)
            self.assertEqual(found, code, err)
            self.assertEqual(out, "")
            self.assertEqual(len(own_lines(err)), 1, err)
            self.assertIn(says, own_lines(err)[0])


if __name__ == "__main__":
    unittest.main()
