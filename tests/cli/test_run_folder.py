"""CLI: every command takes its results' folder in one way, and every reader says what a run that has not ended is."""
import json
import os
import signal
import socket
import subprocess
import time
import unittest

from clitest import CLAST, ROOT, Case, clast

POINTS = ROOT / "data/d2sd/points_u3_n50.csv"
CUBE = ("--domain", "box:0,0,0,1,1,1")
PACK = ("pack", "--curve", "6 mm", "--mass", "12g", "--width", "40mm", "--height", "0.1m", "--shaking-time", "0.01s", "--quiet", "-j", "1")
GROW = ("aggregate", "--core", "sphere", "--core-size", "200um", "--coat", "sphere", "--size", "100um", "--quiet", "--no-picture")
SIZED = (*GROW[:-1], "--fit", "--fit-packing", "1deg:1:1", "--fit-packing", "90deg:2:2", "--fit-repeats", "2", "--fit-replicate-max", "2",
         "--observed-size", "300um", "--observed-size-error", "200um")


def contents(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


class RunFolder(Case):
    def setUp(self):
        super().setUp()
        self.beds = self.folder / "beds.csv"
        rows = [(0.5 + 0.011 * k, 0.9 - 0.013 * ((7 * k) % 30)) for k in range(30)]
        self.beds.write_text("flatness,elongation,porosity\n" +
                             "".join(f"{f:.6g},{e:.6g},{0.278 + 0.019 / (f * e) + 0.014 / e:.6g}\n" for f, e in rows))
        self.forms = self.folder / "forms.csv"
        self.forms.write_text("flatness,elongation\n" + "".join(f"{f:.6g},{e:.6g}\n" for f, e in rows))
        self.spheres = self.folder / "spheres.csv"
        self.spheres.write_text("x,y,z,radius\n" + "".join(f"{i}.5,{j}.5,{k}.5,0.5\n" for i in range(3) for j in range(3) for k in range(3)))
        self.bad = self.folder / "bad.csv"
        self.bad.write_text("x,y\n1,nonsense\n")

    def commands(self):
        """Name, words without the folder, the option that names it, words that fail."""
        bed = ("--bed", "periodic:0,0,3,3", "--layer", "0.1", "--cut", "0.9")
        return [("decompose", ("decompose", POINTS, *CUBE), "-o", ("decompose", self.bad, *CUBE)),
                ("agglomerate", ("agglomerate", POINTS, *CUBE, "--constant", "0.02"), "-o", ("agglomerate", self.bad, *CUBE)),
                ("predict", ("predict", self.forms), "-o", ("predict", self.bad)),
                ("fit", ("fit", self.beds), "-o", ("fit", self.bad)),
                ("shape", ("shape", self.forms, "--resamples", "20"), "--statistics", ("shape", self.bad)),
                ("porosity", ("porosity", self.spheres, *bed), "-o", ("porosity", self.bad, *bed)),
                ("aggregate", (*GROW, "--replicate", "2"), "-o", (*GROW, "--core", self.bad)),
                ("aggregate --fit", SIZED, "-o", (*SIZED, "--core", self.bad)),
                ("pack", (*PACK, "--max-steps", "200"), "-o", (*PACK, "--shapes", self.bad))]

    def test_a_run_is_whole_without_its_page(self):
        """A disk that was full at report.html, the last file, left a run that had failed at 99 % and could not go on."""
        fall = ("evolve", "--curve", "20um", "--particles", "20", "--domain", "box:0,0,0,0.1,0.1,0.1", "--kernel", "constant", "--constant", "1e-9",
                "--duration", "1s", "--no-structure", "--rows", "1")
        for words in ((*GROW, "--replicate", "2"), fall):
            run = self.folder / words[0]
            (run / "report.html").mkdir(parents=True)
            ended = clast(*words, "-o", run)
            self.assertEqual(ended.code, 4, ended.err)
            self.assertRegex(ended.err, f"holds the whole run but no report.html: .*; clast report {run} makes it")
            (run / "report.html").rmdir()
            self.assertEqual(json.loads((run / "manifest.json").read_text())["outcome"], "done")
            self.assertEqual(clast("report", run).code, 0)
            self.assertTrue((run / "report.html").is_file())

    def test_a_summary_goes_through_no_file_of_the_users(self):
        """It was written as summary.json.part, over a file of that name; what a kill left of it was taken for the user's for ever."""
        for name, words, option, _ in self.commands():
            with self.subTest(name):
                run = self.folder / name.replace(" ", "")
                run.mkdir()
                (run / "summary.json.part").write_text("mine")
                made = clast(*words, option, run)
                self.assertEqual(made.code, 0, made.err)
                self.assertEqual((run / "summary.json.part").read_text(), "mine")
                self.assertTrue((run / "summary.json").is_file())

    def test_a_run_is_refused_replaced_and_named(self):
        for name, words, option, fails in self.commands():
            with self.subTest(name):
                run = self.folder / name.replace(" ", "")
                made = clast(*words, option, run)
                self.assertEqual(made.code, 0, made.err)
                first = contents(run)
                manifest = json.loads(first["manifest.json"])
                self.assertEqual((manifest["outcome"], manifest["command"]), ("done", name.split()[0]))
                self.assertEqual(sorted(manifest["outputs"]), sorted({p.split("/")[0] for p in first}
                                                                     - {"report.html"}))  # reads what they are
                self.assertIsInstance(manifest["config"], dict)
                self.assertTrue(all(len(i["sha256"]) == 64 for i in manifest["inputs"]))
                self.assertIn("summary.json", first)
                # over the run: refused, also for another command; nothing changes
                self.assert_fails(2, *words, option, run, says=("holds a finished run", "--force"))
                self.assert_fails(2, "predict", self.forms, "-o", run, says=("holds a finished run", "--force"))
                self.assertEqual(contents(run), first)
                # forced and failing: the old run stands to the byte, nothing is left beside it
                (run / "notes.txt").write_text("mine")
                (run / ".hidden").write_text("mine, too")
                (run / "gone.csv").write_text("a\n1\n")
                self.assertNotIn(clast(*fails, "--force", option, run).code, (0, 1, 2))
                self.assertEqual(contents(run), {**first, "notes.txt": b"mine", ".hidden": b"mine, too", "gone.csv": b"a\n1\n"})
                # forced: a new run, the user's files stay
                again = clast(*words, "--force", option, run)
                self.assertEqual(again.code, 0, again.err)
                self.assertEqual(set(contents(run)), set(first) | {"notes.txt", ".hidden", "gone.csv"})
                self.assertFalse((self.folder / (run.name + ".new")).exists())
                manifest = json.loads((run / "manifest.json").read_text())
                self.assertNotIn("notes.txt", manifest["outputs"])
                # the page names where it came from
                page = self.folder / "page.html"
                self.assertEqual(clast("report", run, "-o", page).code, 0)
                self.assertNotIn("origin unknown", page.read_text())
                self.assertIn(manifest["inputs"][0]["sha256"] if manifest["inputs"] else name.split()[0], page.read_text())
                # forced by another command: no file of the old run is left
                other = clast("predict", self.forms, "--force", "-o", run)
                self.assertEqual(other.code, 0, other.err)
                self.assertEqual(set(contents(run)), {"prediction.csv", "summary.json", "manifest.json", "notes.txt", ".hidden", "gone.csv"})

    def test_folders_that_cannot_be_taken(self):
        words = ("predict", self.forms)
        (self.folder / "file").write_text("x")
        self.assert_fails(4, *words, "-o", self.folder / "file", says=("is a file",))
        self.assert_fails(4, *words, "-o", self.folder / "file/run", says=("cannot make folder", "file/run"))
        self.assertEqual(clast(*words, "-o", self.folder / "a/b/").code, 0)
        run = self.folder / "a/b"
        before = contents(run)
        # from inside the folder
        self.assert_fails(2, *words, "--force", "-o", ".", cwd=run, says=("from inside its folder",))
        self.assertEqual(contents(run), before)
        # a slash at the end, a link: the folder that is meant is replaced, the link stays
        (self.folder / "link").symlink_to(run)
        (run / "notes.txt").write_text("mine")
        for name in (str(run) + "//", self.folder / "link"):
            self.assertEqual(clast(*words, "--force", "-o", name).code, 0)
            self.assertEqual(set(contents(run)), set(before) | {"notes.txt"})
        self.assertTrue((self.folder / "link").is_symlink())
        self.assertEqual(sorted(p.name for p in (self.folder / "a").iterdir()), ["b"])
        # something else where the new run would be made
        (self.folder / "a/b.new").mkdir()
        (self.folder / "a/b.new/data.csv").write_text("mine")
        self.assert_fails(2, *words, "--force", "-o", run, says=("b.new is in the way",))
        self.assertEqual((self.folder / "a/b.new/data.csv").read_text(), "mine")
        # an input that would go with the old run
        (self.folder / "a/b.new/data.csv").unlink()
        (self.folder / "a/b.new").rmdir()
        fitted = self.folder / "fitted"
        self.assertEqual(clast("fit", self.beds, "-o", fitted).code, 0)
        self.assert_fails(2, *words, "--model", fitted / "model.json", "--force", "-o", fitted, says=("model.json", "folder of the input"))
        if os.geteuid() != 0:
            os.chmod(self.folder / "a", 0o555)
            self.addCleanup(os.chmod, self.folder / "a", 0o755)
            self.assert_fails(4, *words, "--force", "-o", run, says=("made beside it", "cannot be written into"))

    def test_a_pipe_has_no_digest(self):
        run = self.folder / "run"
        os.mkfifo(self.folder / "pipe")
        writer = subprocess.Popen(["cp", str(self.forms), str(self.folder / "pipe")])
        made = clast("predict", self.folder / "pipe", "-o", run)
        writer.wait()
        self.assertEqual(made.code, 0, made.err)
        self.assertEqual(json.loads((run / "manifest.json").read_text())["inputs"],
                         [{"role": "table", "path": str(self.folder / "pipe"), "bytes": None, "sha256": None}])

    def test_a_fit_of_a_pipe_ends(self):
        """It opened the pipe again for a digest and waited for ever; of /dev/stdin it kept that of nothing."""
        beds = "porosity,a\n" + "".join(f"{0.3 + 0.01 * k + 0.001 * (k % 3)},{k}\n" for k in range(12))
        (self.folder / "beds.csv").write_text(beds)
        os.mkfifo(self.folder / "pipe")
        with subprocess.Popen(["cp", str(self.folder / "beds.csv"), str(self.folder / "pipe")]):
            made = clast("fit", self.folder / "pipe", "-o", self.folder / "fit", timeout=60)
        self.assertEqual(made.code, 0, made.err)
        made = clast("fit", "/dev/stdin", "-o", self.folder / "again", stdin=beds)
        self.assertEqual(made.code, 0, made.err)
        for folder in ("fit", "again"):
            self.assertNotIn("e3b0c442", (self.folder / folder / "model.json").read_text())

    def test_of_runs_begun_at_once_one_takes_the_folder(self):
        """Of three of them two or three ended with 0, one in the other's place; of three with --force, all failed at times."""
        for number in range(10):
            run, force = self.folder / f"run{number}", ("--force",) * (number % 2)
            if force:
                self.assertEqual(clast("predict", self.forms, "-o", run).code, 0)
            runs = [subprocess.Popen([CLAST, "predict", str(self.forms), "-o", str(run), *force], stdout=subprocess.DEVNULL,
                                     stderr=subprocess.PIPE, text=True) for _ in range(3)]
            said = [r.communicate(timeout=60)[1] for r in runs]
            codes = sorted(r.returncode for r in runs)
            self.assertEqual(codes[0], 0, said)
            self.assertTrue(force or codes[1] in (2, 4), said)  # refused: it holds one, or one is going
            self.assertLessEqual(set(codes), {0, 2, 4}, said)
            self.assertEqual([p.name for p in run.glob(".*")], [], said)
            self.assertEqual(json.loads((run / "manifest.json").read_text())["outcome"], "done")

    def start(self, words, folder, until, sent=signal.SIGKILL):
        """Runs until a file of this pattern is there, then ends it by a signal."""
        process = subprocess.Popen([CLAST, *map(str, words), "-o", str(folder)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        for _ in range(20000):
            if list(self.folder.glob(until)) or process.poll() is not None:
                break
            time.sleep(0.002)
        process.send_signal(sent)
        said = process.communicate()[1]
        self.assertNotEqual(process.returncode, 0, "the run ended before it was stopped")
        return said

    def readers(self, run):
        out = self.folder / "out"
        return [("report", run), ("render", run, "-o", out.with_suffix(".png")), ("export", run, "-o", out.with_suffix(".csv")),
                ("porosity", run), ("predict", self.forms, "-o", run)]

    def test_an_interrupted_run_is_named_by_every_reader(self):
        grow = (*GROW, "--replicate", "20000", "--checkpoint-every", "50")
        for words, name in (((*PACK, "--checkpoint-time", "0s"), "pack"), (grow, "aggregate")):
            for sent in (signal.SIGKILL, signal.SIGTERM):
                with self.subTest(f"{name}, signal {sent}"):
                    run = self.folder / f"{name}-{sent}"
                    said = self.start(words, run, f"{run.name}/checkpoint-0*[1-9]*.h5", sent)
                    if sent == signal.SIGTERM:
                        self.assertRegex(said, rf"stopped at \d+ %, go on with clast {name} --resume {run}\n")
                    # the state that is not there yet: "No such file or directory"
                    states = [("porosity", run / "state.h5"), ("render", run / "state.h5", "-o", self.folder / "out.png")]
                    for reader in self.readers(run) + states:
                        code = 2 if reader[0] == "predict" else 3
                        found = self.assert_fails(code, *reader, says=("--resume",))
                        self.assertRegex(found.err, rf"{run}: stopped at \d+ %, go on with clast {name} --resume {run}")

    def test_a_run_under_way_is_named(self):
        run = self.folder / "run"
        process = subprocess.Popen([CLAST, *PACK, "--height", "1m", "--mass", "120g", "-o", str(run)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            while not list(run.glob("checkpoint-*")) and process.poll() is None:
                time.sleep(0.01)
            for reader in self.readers(run):
                self.assert_fails(4 if reader[0] == "predict" else 3, *reader, says=(f"{run}: still running",))
            who = f"process {process.pid} on {socket.gethostname()} since 20"
            for words in (("pack", "--resume", run), (*PACK, "-o", run), (*PACK, "--force", "-o", run)):
                self.assert_fails(4, *words, says=("still running", who))
        finally:
            process.kill()
            process.wait()

    def test_a_run_killed_before_its_first_checkpoint_is_begun_anew(self):
        """A queue's job said for ever that there was no checkpoint."""
        run = self.folder / "run"
        self.start((*GROW, "--replicate", "20000", "--checkpoint-every", "1000000"), run, f"{run.name}/manifest.json", signal.SIGKILL)
        self.assertEqual([path.name for path in run.iterdir() if path.name[0] != "."], ["manifest.json"])
        self.assert_fails(2, *PACK, "-o", run, says=("without a checkpoint",))  # of another command
        (run / "mine.csv").write_text("1\n")
        self.assert_fails(2, *GROW, "--replicate", "2", "-o", run, says=("without a checkpoint", "--force"))
        (run / "mine.csv").unlink()
        done = clast(*GROW, "--replicate", "2", "-o", run)
        self.assertEqual(done.code, 0, done.err)
        self.assertEqual(clast(*GROW, "--replicate", "2", "-o", self.folder / "other").code, 0)
        manifests = [json.loads((self.folder / name / "manifest.json").read_text()) for name in ("run", "other")]
        self.assertEqual(manifests[0]["outputs"], manifests[1]["outputs"])
        self.assert_fails(2, *GROW, "--replicate", "2", "-o", run, says=("holds a finished run",))

    def test_a_failed_run_is_named(self):
        run = self.folder / "run"
        run.mkdir()
        (run / "series.csv").mkdir()  # results cannot be written
        self.assert_fails(4, *PACK, "--max-steps", "100", "-o", run, says=("series.csv", f"--resume {run}"))
        for reader in self.readers(run):
            self.assert_fails(2 if reader[0] == "predict" else 3, *reader, says=(f"{run}: failed", f"go on with clast pack --resume {run}"))
        (run / "series.csv").rmdir()
        self.assertEqual(clast("pack", "--resume", run, "--quiet").code, 0)
        self.assertEqual(clast("report", run).code, 0)

    def test_a_forced_run_that_is_cut_off_leaves_the_old_one(self):
        whole, run = self.folder / "whole", self.folder / "run"
        self.assertEqual(clast(*PACK, "--checkpoint-time", "0s", "-o", whole).code, 0)
        self.assertEqual(clast(*GROW, "--replicate", "2", "-o", run).code, 0)
        (run / "notes.txt").write_text("mine")
        old = contents(run)
        for sent in (signal.SIGKILL, signal.SIGTERM):
            self.start((*PACK, "--checkpoint-time", "0s", "--force"), run, "run.new/checkpoint-0*[1-9]*.h5", sent)
            self.assertEqual(contents(run), old)
            self.assertEqual(clast("export", run, "-o", self.folder / "old.csv").code, 0)
            new = self.folder / "run.new"
            self.assert_fails(3, "report", new, says=(f"{new}: stopped at", f"--resume {new}", "takes the place of run"))
            self.assert_fails(2, *PACK, "--force", "-o", run, says=("run.new: stopped at", "--resume", "or remove"))
            if sent == signal.SIGKILL:
                subprocess.run(["rm", "-r", str(new)], check=True)
        done = clast("pack", "--resume", new, "--quiet")
        self.assertEqual(done.code, 0, done.err)
        self.assertFalse(new.exists())
        self.assertEqual(set(contents(run)), set(contents(whole)) | {"notes.txt"})
        for name in ("state.h5", "summary.json", "series.csv"):
            self.assertEqual((run / name).read_bytes(), (whole / name).read_bytes(), name)
        # a new run that fails on its way is removed
        before = contents(run)
        (self.folder / "limit").mkdir()
        failed = subprocess.run(["sh", "-c", 'ulimit -f 16; exec "$@"', "sh", CLAST, *PACK, "--max-steps", "50", "--force", "-o", run],
                                capture_output=True, text=True, check=False)
        self.assertEqual(failed.returncode, 4, failed.stderr)
        self.assertEqual(contents(run), before)

    def test_a_replacement_that_was_cut_off_is_completed(self):
        run, new = self.folder / "run", self.folder / "run.new"
        words = ("predict", self.forms, "--force", "-o", run)
        self.assertEqual(clast(*GROW, "-o", run).code, 0)
        (run / "notes.txt").write_text("mine")
        self.assertEqual(clast(*words).code, 0)
        # as if it had been killed after the exchange: the old run, marked, lies beside
        self.assertEqual(clast(*GROW, "-o", new).code, 0)
        (new / ".replaced").write_text("")
        (new / "mine.txt").write_text("mine")
        self.assertEqual(clast(*words).code, 0)
        self.assertEqual(set(contents(run)), {"prediction.csv", "summary.json", "manifest.json", "notes.txt", "mine.txt"})
        self.assertFalse(new.exists())
        # as if between two renames, where the disk cannot exchange
        (run / ".replaced").write_text("")
        run.rename(self.folder / "run.old")
        self.assertEqual(clast(*words).code, 0)
        self.assertEqual(set(contents(run)), {"prediction.csv", "summary.json", "manifest.json", "notes.txt", "mine.txt"})
        self.assertFalse((self.folder / "run.old").exists())

    def test_what_a_kill_leaves_of_a_replaced_run_is_removed(self):
        run, new = self.folder / "run", self.folder / "run.new"
        words = ("predict", self.forms, "--force", "-o", run)
        self.assertEqual(clast(*words[:2], "-o", run).code, 0)
        self.assertEqual(clast(*GROW, "-o", new).code, 0)
        for left in ([".replaced", "manifest.json", "history.csv"], [".replaced", "manifest.json"], [".replaced"], []):
            new.mkdir(exist_ok=True)
            (new / ".replaced").write_text("")
            for path in new.iterdir():
                if path.name not in left:
                    path.unlink()
            self.assertEqual(clast(*words).code, 0, left)
            self.assertFalse(new.exists())
            self.assertEqual(set(contents(run)), {"prediction.csv", "summary.json", "manifest.json"})
            self.assertEqual(clast(*GROW, "-o", new).code, 0)

    def test_kinds_without_grains_and_studies_are_named(self):
        run = self.folder / "run"
        self.assertEqual(clast("predict", self.forms, "-o", run).code, 0)
        for reader in self.readers(run)[1:4]:
            self.assert_fails(3, *reader, says=("clast predict", "no state.h5"))
        plan = self.folder / "plan.yaml"
        plan.write_text("run: predict\nargument: [%s]\nvary: [grading = U1 | U7]\n" % self.forms)
        study = self.folder / "study"
        made = clast("study", plan, "-o", study)
        self.assertEqual(made.code, 0, made.err)
        for reader in self.readers(study)[1:4]:
            self.assert_fails(3, *reader, says=("folder of a study", "runs/000001/out"))
        self.assert_fails(2, "predict", self.forms, "--force", "-o", study, says=("holds a study",))
        for folder in (study, study / "runs/000001/out"):
            self.assertEqual(clast("report", folder).code, 0)
        self.assert_fails(2, "study", plan, "-o", run, says=("holds a run", "another folder"))
        # a study that was stopped had a page like any other
        results = study / "results.csv"
        rows = [line.split(",") for line in results.read_text().splitlines()]
        self.assertNotIn("runs are done", (study / "report.html").read_text())
        rows[2] = [rows[2][0], rows[2][1]] + [""] * (len(rows[2]) - 2)
        results.write_text("".join(",".join(row) + "\n" for row in rows))
        self.assertEqual(clast("report", study).code, 0)
        self.assertIn("stopped: 1 of 2 runs are done", (study / "report.html").read_text())
        results.unlink()
        self.assert_fails(3, "report", study, says=(f"{study}: a study that has not ended", "clast study"))


if __name__ == "__main__":
    unittest.main()
