#!/usr/bin/env python3
"""pack, aggregate and evolve do not go on with an input file that has changed: one line, nothing touched."""
import json
import os
import signal
import subprocess
import time
import unittest

from clitest import CLAST, Case, ROOT, clast

BED = ["pack", "--mass", "2g", "--domain", "box", "--width", "20mm", "--height", "60mm", "--fluid-density", "0", "--shaking-time", "0", "--quiet",
       "-j", "1"]
CLOUD = ["evolve", "--domain", "box:0,0,0,1mm,1mm,10mm", "--particles", "3000", "--duration", "1s", "--rows", "20", "--eddy-diffusivity", "1e-8",
         "--out-of-range", "extrapolate", "--seed", "3", "--checkpoint-time", "0s"]
PLATE = "OFF\n4 2 0\n-9 -9 {0}\n9 -9 {0}\n9 9 {0}\n-9 9 {0}\n3 0 1 2\n3 0 2 3\n"


class ResumeInputs(Case):
    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def refuses(self, command, run, path, text):
        """Changed, it is refused and the run is as it was; put back, it goes on."""
        old = path.read_bytes()
        before = {file.name: file.read_bytes() for file in run.iterdir() if file.is_file()}
        path.write_text(text, encoding="utf-8")
        self.assert_fails(3, command, "--resume", run, "-q",
                          says=(str(path), "is not the one that the checkpoint was made with", "put the old one back"))
        self.assertEqual({file.name: file.read_bytes() for file in run.iterdir() if file.is_file()}, before)
        path.write_bytes(old)

    def goes_on(self, command, run, *words):
        done = clast(command, "--resume", run, "-q", *words)
        self.assertEqual(done.code, 0, done.err)

    def stop(self, words, run):
        """Killed after its first checkpoint."""
        process = subprocess.Popen([CLAST, *map(str, words), "-q", "-o", str(run)], cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                   env=os.environ)
        limit = time.monotonic() + 60
        while not list(run.glob("checkpoint-*.h5")) and process.poll() is None and time.monotonic() < limit:
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)
        self.assertEqual(process.wait(60), -signal.SIGKILL, "it ended before it was stopped")

    def test_sizes_of_a_bed(self):
        run = self.folder / "run"
        sizes = self.write("sizes.csv", "diameter_mm,count\n3,50\n4,50\n")
        made = clast(*BED, "--curve", f"list:{sizes}", "--max-steps", 100, "-o", run)
        self.assertEqual(made.code, 0, made.err)
        self.refuses("pack", run, sizes, "diameter_mm,count\n2,50\n5,50\n")
        manifest = run / "manifest.json"  # what an older clast wrote, or nobody: nothing to compare with
        text = json.loads(manifest.read_text(encoding="utf-8"))
        self.goes_on("pack", run, "--max-steps", 120)
        sizes.write_text("diameter_mm,count\n3,50\n4,51\n", encoding="utf-8")
        text["inputs"] = []
        manifest.write_text(json.dumps(text), encoding="utf-8")
        self.goes_on("pack", run, "--max-steps", 140)
        self.refuses("pack", run, sizes, "diameter_mm,count\n3,50\n4,50\n")

    def test_walls_and_their_tables(self):
        run = self.folder / "run"
        plate = self.write("plate.off", PLATE.format(-8))
        motion = self.write("motion.csv", "time_s,z_m\n0,0\n1,-0.001\n")
        made = clast(*BED, "--curve", "4mm", "--lid", "--wall", f"plate {plate} mm", "--wall", f"lid table {motion}", "--max-steps", 100, "-o", run)
        self.assertEqual(made.code, 0, made.err)
        self.refuses("pack", run, plate, PLATE.format(-7))
        self.refuses("pack", run, motion, "time_s,z_m\n0,0\n1,-0.002\n")
        self.goes_on("pack", run, "--max-steps", 120)

    def test_a_start(self):
        run = self.folder / "run"
        row = "shape,x_m,y_m,z_m,qw,qx,qy,qz,scale,density_kg/m^3\n1-sphere,0,0,{},1,0,0,0,4e-3,2650\n"
        start = self.write("start.csv", row.format("5e-3"))
        made = clast("pack", "--start", start, "--shapes", "sphere", "--domain", "box", "--width", "40mm", "--fluid-density", 0, "--shaking-time", 0,
                     "--max-steps", 100, "-q", "-o", run)
        self.assertEqual(made.code, 0, made.err)
        self.refuses("pack", run, start, row.format("6e-3"))
        self.goes_on("pack", run, "--max-steps", 120)

    def test_sizes_of_an_aggregate(self):
        run = self.folder / "run"
        sizes = self.write("sizes.csv", "diameter_um,count\n8,100\n9,100\n")
        self.stop(["aggregate", "--core", "ellipsoid:3,2,1", "--core-size", "30um", "--coat", "ellipsoid:2,1.5,1", "--sizes",
                   sizes, "--replicate", 2, "--cone", "90deg", "--rays", 40, "--checkpoint-every", 3], run)
        self.refuses("aggregate", run, sizes, "diameter_um,count\n7,100\n9,100\n")

    def test_sizes_of_a_cloud(self):
        run = self.folder / "run"
        sizes = self.write("sizes.csv", "diameter_um,count\n40,50\n60,50\n")
        self.stop([*CLOUD, "--curve", f"list:{sizes}"], run)
        self.refuses("evolve", run, sizes, "diameter_um,count\n30,50\n60,50\n")


if __name__ == "__main__":
    unittest.main()
