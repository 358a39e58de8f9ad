"""--time-limit, and the job scripts that rest on it (examples/slurm), with a queue that only writes down what it is asked."""
import os
import pathlib
import subprocess
import time
import unittest

from clitest import CLAST, ROOT, Case, clast

SLURM = ROOT / "examples/slurm"
BED = ["--curve", "U1", "--mass", "30g", "--width", "60mm", "--height", "0.3m", "--shaking-time", "0.1s"]


class TimeLimit(Case):
    def job(self, script, *arguments, limit, **env):
        """One job: its exit code, and what it asked of the queue."""
        tools = self.folder / "bin"
        asked = self.folder / "asked"
        if not tools.exists():
            tools.mkdir()
            (tools / "clast").symlink_to(pathlib.Path(CLAST).resolve())
            (tools / "scontrol").write_text(f'#!/bin/sh\necho "$@" >> {asked}\n', encoding="ascii")
            (tools / "scontrol").chmod(0o755)
        asked.unlink(missing_ok=True)
        done = subprocess.run(["bash", SLURM / script, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=300, check=False,
                              env=os.environ | {"PATH": f"{tools}:{os.environ['PATH']}", "CLAST_TIME_LIMIT": limit, "SLURM_CPUS_PER_TASK": "1"} | env)
        return done.returncode, asked.read_text().split() if asked.exists() else [], done.stderr

    def test_a_command_ends_itself_with_a_checkpoint(self):
        done = clast("pack", *BED, "-o", self.folder / "bed", "--time-limit", "0.4s", "-j", "1")
        self.assertEqual(done.code, 143, done.err)
        self.assertIn("go on with clast pack --resume", done.err)

    def test_a_command_without_a_state_says_why_it_ended(self):
        path = self.folder / "points.csv"
        path.write_text("x,y,z\n" + "".join(f"{i * 0.618034 % 1:.9f},{i * 0.754878 % 1:.9f},{i * 0.569840 % 1:.9f}\n" for i in range(300000)))
        done = clast("decompose", path, "--domain", "box:0,0,0,1,1,1", "--time-limit", "0.1s")
        self.assertEqual(done.code, 143, done.err)
        self.assertIn("clast decompose: ended by --time-limit; the files that it had finished are whole", done.err)

    def test_times_that_are_none(self):
        for text in ("soon", "5mm", "-3s", "0s", "1e9s"):
            self.assert_fails(2, "pack", *BED, "--time-limit", text, says=["--time-limit"])

    def test_a_job_goes_on_until_its_bed_is_done(self):
        config = self.folder / "bed.yaml"
        config.write_text("".join(f"{key[2:].replace('-', '_')}: {value}\n" for key, value in zip(BED[::2], BED[1::2])))
        begun = time.monotonic()
        self.assertEqual(clast("pack", config, "-o", self.folder / "whole", "-q", "-j", "1").code, 0)
        limit = f"{0.5 * (time.monotonic() - begun):.2f}s"  # of a machine of any speed
        for n in range(60):
            code, asked, error = self.job("run.sbatch", "pack", config, "bed", limit=limit, SLURM_JOB_ID="7")
            self.assertEqual(code, 0, error)
            if not asked:
                break
            self.assertEqual(asked, ["requeue", "7"])
        self.assertGreater(n, 0, "nothing had to go on")
        self.assertEqual((self.folder / "bed/state.h5").read_bytes(), (self.folder / "whole/state.h5").read_bytes())
        self.assertEqual(self.job("run.sbatch", "pack", config, "bed", limit="60s", SLURM_JOB_ID="7")[:2], (0, []))

    def test_the_tasks_of_an_array_do_a_study(self):
        study = self.folder / "study.yaml"
        study.write_text(f"run: fill\nargument: [{ROOT / 'data/scarlet/stl/27sk21_shape_fine.stl'}]\nvary: [spheres = 5 | 6 | 7 | 8]\n")
        for task in ("1", "2"):
            code, asked, error = self.job("study.sbatch", study, "many", limit="250s", SLURM_ARRAY_JOB_ID="9", SLURM_ARRAY_TASK_ID=task,
                                          SLURM_ARRAY_TASK_COUNT="2")
            self.assertEqual((code, asked), (0, []), error)
        self.assertEqual(len(list((self.folder / "many/runs").glob("00000[1-4]"))), 4)

    def test_a_job_killed_before_its_first_checkpoint_begins_anew(self):
        config = self.folder / "ball.yaml"
        config.write_text("core: sphere\ncore_size: 30um\ncoat: sphere\nsize: 8um\nrays: 10\npicture: false\nreplicate: 4\n")
        with subprocess.Popen([CLAST, "aggregate", config, "--replicate", "20000", "--checkpoint-every", "1000000", "-q", "-o", "ball"], cwd=self.folder) as job:
            while not (self.folder / "ball/manifest.json").exists() and job.poll() is None:
                time.sleep(0.01)
            job.kill()
        code, asked, error = self.job("run.sbatch", "aggregate", config, "ball", limit="250s", SLURM_JOB_ID="7")
        self.assertEqual((code, asked), (0, []), error)
        self.assertTrue((self.folder / "ball/summary.json").exists())

    def test_a_lost_rank_ends_the_job(self):
        """srun leaves the others waiting for it unless it is told."""
        for script in SLURM.glob("*.sbatch"):
            for line in script.read_text().splitlines():
                if line.startswith("srun "):
                    self.assertIn(" --kill-on-bad-exit=1 ", line, script)

    def test_scripts_are_scripts(self):
        for script in SLURM.glob("*.sbatch"):
            self.assertEqual(subprocess.run(["bash", "-n", script], check=False).returncode, 0, script)


if __name__ == "__main__":
    unittest.main()
