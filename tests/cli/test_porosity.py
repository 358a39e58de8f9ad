"""CLI: clast porosity on lattices and on other people's packings."""
import csv
import json
import os
import struct
import unittest

from clitest import Case, clast, shared


class Porosity(Case):
    def spheres(self, rows, name="spheres.csv"):
        path = self.folder / name
        with open(path, "w", newline="", encoding="ascii") as file:
            writer = csv.writer(file)
            writer.writerow(["x", "y", "z", "radius"])
            writer.writerows(rows)
        return path

    def lattice(self, n):
        cells = range(n)
        return self.spheres([(i + 0.5, j + 0.5, k + 0.5, 0.5) for i in cells for j in cells for k in cells])

    def test_cubic_lattice(self):
        path = self.lattice(5)
        found = clast("porosity", path, "--bed", "periodic:0,0,5,5", "--layer", 0.1, "--json", "-o", self.folder / "out")
        self.assertEqual(found.code, 0, found.err)
        result = found.json
        self.assertEqual(len(result["profile"]), 51)
        self.assertAlmostEqual(result["profile"][0]["z"], 0.05, 12)
        self.assertEqual(result["z_low"], 0)
        # whole layers hold pi / 6
        mean = sum(row["porosity"] for row in result["profile"][:50]) / 50
        self.assertAlmostEqual(mean, 1 - 3.141592653589793 / 6, 12)
        with open(self.folder / "out/profile.csv", encoding="ascii") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(float(rows[3]["porosity"]), result["profile"][3]["porosity"])
        self.assertIn("<svg", (self.folder / "out/profile.svg").read_text())

    def test_contacts_of_a_lattice(self):
        result = clast("porosity", self.lattice(4), "--bed", "box:0,0,4,4", "--layer", 0.1, "--gap", 1e-6, "--json").json
        self.assertAlmostEqual(result["coordination"], 2 * 3 * 4 * 4 * 3 / 64, 12)

    def test_local_porosity_of_a_lattice(self):
        path = self.lattice(5)
        found = clast("porosity", path, "--bed", "periodic:0,0,5,5", "--layer", 0.1, "--local", "--json")
        self.assertEqual(found.code, 0, found.err)
        self.assertEqual(found.json["n_local"], 75)  # all but the lowest and the highest layer
        self.assertAlmostEqual(found.json["local_mean"], 1 - 3.141592653589793 / 6, 12)
        self.assertAlmostEqual(found.json["local_deviation"], 0, 12)

    def test_voronoi_cells_of_others_fill_their_container(self):
        """voro++'s packing of 1000 unit spheres: cells add up to the container below the bed's top."""
        path = shared("packings/voro/pack_ten_cube.txt")
        if path is None:
            return
        rows = [line.split() for line in path.read_text().splitlines()]
        file = self.spheres([(x, y, z, 0.5) for _, x, y, z in rows])
        found = clast("porosity", file, "--bed", "box:-5,-5,5,5", "--layer", 0.1, "--cut", 0.9, "--local", "--json",
                      "-o", self.folder / "out")
        self.assertEqual(found.code, 0, found.err)
        with open(self.folder / "out/local.csv", encoding="ascii") as local:
            cells = list(csv.DictReader(local))
        total = sum(float(row["cell"]) for row in cells)
        self.assertAlmostEqual(total / (100 * found.json["top"]), 1, 9)

    def test_rings_and_pores(self):
        path = self.lattice(4)
        out = self.folder / "out"
        bed = ["--bed", "cylinder:2,2,2", "--layer", 0.1]
        found = clast("porosity", path, *bed, "--rings", 5, "--pores", 2000, "--json", "-o", out)
        self.assertEqual(found.code, 0, found.err)
        self.assertTrue(0 < found.json["pore_mean"] < 0.37)
        for name in ("radial.csv", "radial.svg", "pores.csv", "pores.svg", "profile.svg"):
            self.assertTrue((out / name).stat().st_size > 100, name)
        self.assert_fails(2, "porosity", path, "--bed", "box:0,0,4,4", "--layer", 0.1, "--rings", 5,
                          says=["cylindrical bed"])

    def test_slices_of_fine_grains(self):
        beds = []
        for i, size in enumerate((0.2, 0.1999)):
            beds.append(self.folder / f"{i}.csv")
            rows = [f"{x},{y},{z},{size}" for x in (0.1, 0.3) for y in (0.1, 0.3) for z in (0.1, 0.3)]
            beds[-1].write_text("\n".join(["x_mm,y_mm,z_mm,diameter_mm", *rows]) + "\n")
        bed, out = ("--bed", "box:0,0,0.4mm,0.4mm"), self.folder / "out"
        found = clast("porosity", beds[0], *bed, "--cut", 0.9, "--json")
        self.assertEqual(found.code, 0, found.err)
        self.assertAlmostEqual(found.json["profile"][1]["z"], 0.3e-4, 12)  # a tenth of 0.2 mm
        self.assertEqual(len(found.json["profile"]), 21)
        self.assertAlmostEqual(found.json["top"], 4e-4, delta=1e-5)
        several = clast("porosity", *beds, *bed, "-o", out)  # both in the slices of the first
        self.assertEqual(several.code, 0, several.err)
        rows = list(csv.DictReader((out / "mean_profile.csv").read_text().splitlines()))
        self.assertAlmostEqual(float(rows[1]["z_low_m"]), 2e-5, 15)

    def test_rings_of_grains_that_lie_alike(self):
        path = self.spheres([(0, 0, k + 0.5, 0.5) for k in range(200)])
        out = self.folder / "out"
        found = clast("porosity", path, "--bed", "cylinder:0.5", "--cut", 1, "--rings", 10, "-o", out)
        self.assertEqual(found.code, 0, found.err)
        for row in csv.DictReader((out / "radial.csv").read_text().splitlines()):
            low, high = float(row["r_low"]), float(row["r_high"])
            solid = 4 / 3 * (abs(0.25 - low**2) ** 1.5 - abs(0.25 - high**2) ** 1.5) / (high**2 - low**2)
            self.assertLess(abs(float(row["porosity"]) - (1 - solid)), 4 * float(row["porosity_error"]), row)

    def test_folder_says_what_it_holds_and_where_it_came_from(self):
        path, one, two = self.lattice(3), self.folder / "one", self.folder / "two"
        bed = ["--bed", "periodic:0,0,3,3", "--layer", 0.1]
        found = clast("porosity", path, *bed, "--json", "-o", one)
        self.assertEqual(found.code, 0, found.err)
        summary = json.loads((one / "summary.json").read_text())
        rows = found.json.pop("profile")
        self.assertEqual(len(rows), 31)
        self.assertEqual(summary, {k: v for k, v in found.json.items() if k != "profile"})
        manifest = json.loads((one / "manifest.json").read_text())
        self.assertEqual((manifest["command"], manifest["outcome"]), ("porosity", "done"))
        self.assertEqual((manifest["config"]["layer"], manifest["config"]["bed"]), ("0.1", "periodic:0,0,3,3"))
        self.assertEqual([(i["role"], i["path"]) for i in manifest["inputs"]], [("run", str(path))])
        report = clast("report", one, "-o", self.folder / "report.html")
        self.assertEqual(report.code, 0, report.err)
        self.assertIn("Bulk porosity", (self.folder / "report.html").read_text())
        # a summary is replaced, not written over: who holds the old one keeps it
        old = self.folder / "old.json"
        os.link(one / "summary.json", old)
        self.assertEqual(clast("porosity", path, *bed, "--cut", 0.4, "--force", "-o", one).code, 0)
        self.assertEqual(json.loads(old.read_text()), summary)
        self.assertNotEqual(json.loads((one / "summary.json").read_text()), summary)
        self.assertEqual([p.name for p in one.iterdir() if p.suffix == ".part"], [])
        # several runs have their mean; a container's file is an input
        # (one bed told twice counted as two realisations: a deviation of 0, an interval of no width)
        self.assert_fails(2, "porosity", path, path, *bed, says=["hold the same bytes", "one realisation"])
        other = self.folder / "other.csv"
        other.write_text(path.read_text() + "\n")
        found = clast("porosity", path, other, *bed, "--json", "-o", two)
        self.assertEqual(json.loads((two / "summary.json").read_text()), found.json)
        manifest = json.loads((two / "manifest.json").read_text())
        self.assertEqual([i["role"] for i in manifest["inputs"]], ["run", "run"])
        box = self.folder / "box.off"
        corners = [(x, y, z) for z in (0, 3) for y in (0, 3) for x in (0, 3)]
        faces = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7),
                 (1, 7, 5)]
        box.write_text("OFF\n8 12 0\n" + "".join("%g %g %g\n" % c for c in corners) + "".join("3 %d %d %d\n" % f for f in faces))
        found = clast("porosity", path, "--bed", f"mesh:{box},m", "--layer", 0.1, "--force", "--json", "-o", two)
        self.assertEqual(found.code, 0, found.err)
        manifest = json.loads((two / "manifest.json").read_text())
        self.assertEqual([(i["role"], i["path"]) for i in manifest["inputs"]], [("run", str(path)), ("bed", str(box))])
        # a container by clast says its unit; of several runs the one that is refused is named
        said = self.folder / "box.ply"
        self.assertEqual(clast("mesh", "convert", box, "--unit", "m", "-o", said).code, 0)
        again = clast("porosity", path, "--bed", f"mesh:{said}", "--layer", 0.1, "--json")
        self.assertEqual((again.code, again.json["bulk"]), (0, found.json["bulk"]))
        self.assert_fails(2, "porosity", path, "--bed", f"mesh:{said},mm", says=["box.ply says that it is in m, not in mm"])
        self.assert_fails(2, "porosity", path, "--bed", f"mesh:{box}", says=["box.off", "does not say its unit"])
        away = self.spheres([(20.0, 20.0, 20.0, 0.5)], "away.csv")
        self.assert_fails(3, "porosity", path, away, *bed, says=["away.csv: "])

    def test_every_number_of_several_runs_has_its_mean(self):
        runs = []
        for k, radius in enumerate((0.5, 0.48, 0.45)):
            rows = [(x + 0.5, y + 0.5, z + 0.5, radius) for z in range(4) for y in range(-3, 3) for x in range(-3, 3)]
            runs.append(self.spheres(rows, f"runs{k}.csv"))
        options = ["--bed", "cylinder:4.5", "--layer", 0.1, "--cut", 0.9, "--gap", 0.11, "--local", "--rings", 4, "--pores", 500, "--json"]
        alone = []
        for run in runs:
            found = clast("porosity", run, *options)
            self.assertEqual(found.code, 0, found.err)
            alone.append(found.json)
        folder = self.folder / "means"
        found = clast("porosity", *runs, *options, "-o", folder)
        self.assertEqual(found.code, 0, found.err)
        numbers = [k for k, v in alone[0].items() if isinstance(v, (int, float)) and not isinstance(v, bool)]
        self.assertLessEqual({"bulk", "local_mean", "local_deviation", "pore_mean", "coordination", "top"}, set(numbers))
        rows = list(csv.DictReader((folder / "means.csv").read_text().splitlines()))
        self.assertEqual(len({r["quantity"] for r in rows}), len(rows))
        rows = {r["quantity"]: r for r in rows}
        for group, keys in (("", numbers), ("fabric", list(alone[0]["fabric"]))):
            for key in keys:
                values = [(a[group] if group else a)[key] for a in alone]
                mean = sum(values) / 3
                half = 4.302652729911275 * (sum((v - mean) ** 2 for v in values) / 2 / 3) ** 0.5
                ours = (found.json[group] if group else found.json)[key]
                self.assertAlmostEqual(ours["mean"], mean, 9, key)
                self.assertAlmostEqual(ours["high"] - ours["mean"], half, 8, key)
                self.assertAlmostEqual(float(rows[key]["mean"]), mean, 9, key)
        self.assertEqual([r["bulk"] for r in found.json["runs"]], [a["bulk"] for a in alone])
        rings = list(csv.DictReader((folder / "mean_radial.csv").read_text().splitlines()))
        self.assertEqual(len(rings), 4)
        self.assertEqual([r["n"] for r in rings], ["3"] * 4)
        self.assertGreater(float(rings[1]["deviation"]), 0)
        self.assertGreater((folder / "mean_radial.svg").stat().st_size, 1000)
        run = self.folder / "bed"
        self.assertEqual(clast("pack", "--curve", "8 mm", "--mass", "12g", "--width", "40mm", "--height", "0.1m", "--max-steps", "30000",
                               "--domain", "box", "-o", run, "-q").code, 0)
        other = self.folder / "other"
        self.assertEqual(clast("pack", "--curve", "8 mm", "--mass", "12g", "--width", "40mm", "--height", "0.1m", "--max-steps", "30000",
                               "-o", other, "-q").code, 0)
        self.assert_fails(2, "porosity", run, other, "--cut", "0.9", says=("two kinds",))
        text = clast("porosity", *runs, *options[:-1])
        self.assertIn("local_mean", text.out)

    def test_a_runs_own_folder_is_left_alone(self):
        run = self.folder / "bed"
        made = clast("pack", "--curve", "6 mm", "--mass", "3g", "--width", "40mm", "--height", "0.1m", "--max-steps", 9000, "--quiet",
                     "-o", run)
        self.assertEqual(made.code, 0, made.err)
        before = {p.name: p.read_bytes() for p in run.iterdir()}
        for words in ((run,), (run / "state.h5",), (run, run)):
            self.assert_fails(2, "porosity", *words, "-o", run, says=(f"-o {run} is the", "input"))
        self.assert_fails(2, "porosity", "state.h5", "-o", ".", says=("folder of the input",), cwd=run)
        self.assertEqual(before, {p.name: p.read_bytes() for p in run.iterdir()})
        inside = clast("porosity", run, "--cut", "0.95", "-o", run / "porosity")
        self.assertEqual(inside.code, 0, inside.err)

    def test_bad_input(self):
        path = self.lattice(2)
        self.assert_fails(2, "porosity", path, says=["--bed"])
        self.assert_fails(2, "porosity", path, "--bed", "cylinder:0", says=["no area"])
        self.assert_fails(2, "porosity", path, "--bed", "pot:3", says=["cylinder:RADIUS"])
        self.assert_fails(3, "porosity", path, "--bed", "box:0,0,50,50", "--layer", 0.1, says=["no slice is denser"])
        self.assert_fails(3, "porosity", path, "--bed", "box:0,0,2,2", "--layer", 0.1, "--trim", 1, says=["leaves nothing"])
        self.assert_fails(3, "porosity", path, "--bed", "box:0,0,2,2", "--layer", 1e-9, says=["slices"])
        # a smaller bed than the grains lie in had a porosity of -1.13
        self.assert_fails(3, "porosity", path, "--bed", "box:0,0,1,1", "--layer", 0.1, says=["grains take 2.1", "times the volume of this bed"])
        self.assert_fails(3, "porosity", self.folder / "absent.csv", "--bed", "box:0,0,2,2", says=["absent.csv"])
        empty = self.folder / "empty.csv"
        empty.write_text("x,y,z,radius\n")
        self.assert_fails(3, "porosity", empty, "--bed", "box:0,0,2,2", says=["empty.csv"])

    def test_the_lengths_of_a_bed_are_in_the_unit_of_its_run(self):
        # --bed periodic:..,20 of a run in metres was 20 m high: porosity 0.998; 52mm around a packing without unit were 0.052 of its own
        metres = self.folder / "metres.csv"
        metres.write_text("x_mm,y_mm,z_mm,diameter_mm\n" + "".join(f"{2 * x + 1},{2 * y + 1},{2 * z + 1},2\n"
                                                                   for x in range(3) for y in range(3) for z in range(3)))
        for bed, says in [("cylinder:20", "20 has no unit; write 20mm"), ("box:0,0,6mm,6", "6 has no unit; write 6mm"),
                          ("periodic:0,0,0,6mm,6mm,20", "20 has no unit; write 20mm"), ("cylinder:5mm,-3,0", "-3 has no unit; write -3mm")]:
            self.assert_fails(2, "porosity", metres, "--bed", bed, says=["bed: " + says])
        wide = ("--bed", "cylinder:0.1m")
        self.assert_fails(3, "porosity", metres, *wide, "--layer", "50mm", says=["slices 50 mm high"])  # was 0.05
        self.assert_fails(3, "porosity", self.lattice(3), "--bed", "cylinder:50", "--layer", "2", says=["slices 2 high"])
        found = clast("porosity", metres, "--bed", "periodic:0,0,0,6mm,0.6cm,6mm", "--json")
        self.assertAlmostEqual(found.json["bulk"], 1 - 3.141592653589793 / 6, 12)
        self.assert_fails(2, "porosity", self.lattice(3), "--bed", "cylinder:52mm", says=["bed: ", "the lengths have no unit, so give a bare number"])

    def test_side_walls_are_told_and_left_out(self):
        """Ten unit balls across a lattice of eight: the rows at the walls of a box are empty."""
        path = self.lattice(8)
        bed = ["--bed", "box:-1,-1,9,9", "--layer", 0.1, "--cut", 0.9]
        plain = clast("porosity", path, *bed)
        self.assertIn("side walls          5 grain sizes (of 1 model units, mean by volume) from the axis, which loosen the bed", plain.out)
        found = clast("porosity", path, *bed, "--core", 2.5, "--json").json
        self.assertAlmostEqual(found["wall_ratio"], 5, 12)
        self.assertAlmostEqual(found["grain_size"], 1, 12)
        self.assertAlmostEqual(found["core"], 1 - 3.141592653589793 / 6, 1)
        self.assertAlmostEqual(found["bulk"] - found["core"], found["wall_share"], 12)
        self.assertTrue(0.15 < found["wall_share"] < 0.25)
        self.assertNotIn("core", clast("porosity", path, *bed, "--json").json)
        other = self.folder / "other.csv"
        other.write_text(path.read_text() + "\n")
        two = clast("porosity", path, other, *bed, "--core", 2.5, "-o", self.folder / "two")
        self.assertIn("wall_share", two.out)
        self.assertIn("core_depth,-,2.5", (self.folder / "two/means.csv").read_text())
        self.assert_fails(2, "porosity", path, *bed, "--core", 0.2, says=["half a grain size"])
        self.assert_fails(3, "porosity", path, *bed, "--core", 6, says=["core 6: it counts in full from half a grain size farther on, 6.5,"])
        endless = ["--bed", "periodic:0,0,8,8", "--layer", 0.1]
        self.assertIn("side walls          none: the bed is periodic", clast("porosity", path, *endless).out)
        self.assertNotIn("wall_ratio", clast("porosity", path, *endless, "--json").json)
        self.assert_fails(2, "porosity", path, *endless, "--core", 2, says=["no side walls"])

    def test_the_core_of_others_knows_no_container(self):
        """voro++'s unit spheres in a box and in a cylinder: bulks differ by 0.008, cores beyond 2.5 by less than 0.002."""
        names = (("pack_ten_cube.txt", "box:-5,-5,5,5"), ("pack_cylinder.txt", "cylinder:6"))
        paths = [shared("packings/voro/" + name) for name, _ in names]
        if None in paths:
            return
        box, round_ = [clast("porosity", path, "--columns", "id,x,y,z", "--diameter", 1, "--bed", bed, "--layer", 0.1, "--trim", 2,
                             "--core", 2.5, "--json").json for path, (_, bed) in zip(paths, names)]
        self.assertAlmostEqual(box["bulk"] - round_["bulk"], 0.0075, 3)
        self.assertLess(abs(box["core"] - round_["core"]), 0.002)
        self.assertAlmostEqual(round_["wall_share"], 0.0281, 3)

    def test_packings_of_other_programs(self):
        """FCC as voro++ text in a box that repeats in all three directions; spheres as diameters, in mm."""
        edge = 3 * 2 ** 0.5
        bed = f"periodic:0,0,0,{edge!r},{edge!r},{edge!r}"
        fcc = "data/packings/fcc-108.txt"
        found = clast("porosity", fcc, "--bed", bed, "--gap", 1e-9, "--local", "--pores", 1000, "--json")
        self.assertEqual(found.code, 0, found.err)
        close = 1 - 3.141592653589793 / (3 * 2 ** 0.5)
        self.assertAlmostEqual(found.json["bulk"], close, 12)
        self.assertAlmostEqual(found.json["local_mean"], close, 12)
        self.assertAlmostEqual(found.json["pore_porosity"], close, 1)
        self.assertEqual((found.json["coordination"], found.json["n_overlap"], found.json["n_local"]), (12, 0, 108))
        words = clast("porosity", fcc, "--bed", bed).out
        self.assertIn("periodic in all three directions", words)
        self.assertIn("overlaps            none", words)
        self.assert_fails(2, "porosity", fcc, "--bed", bed, "--trim", 0.1, says=["no ends to trim"])
        self.assert_fails(2, "porosity", fcc, "--bed", bed, "--floor", 1, says=["--floor"])
        file = self.folder / "beads.csv"
        file.write_text("id,x_mm,y_mm,z_mm,diameter_mm\n7,1,1,1,2\n9,2.9,1,1,2\n")
        found = clast("porosity", file, "--bed", "box:0,0,4mm,2mm", "--layer", "0.1mm", "--json")
        self.assertEqual((found.json["unit"], found.json["n_overlap"]), ("m", 1))
        self.assertAlmostEqual(found.json["max_overlap_share"], 0.1, 9)
        self.assertAlmostEqual(found.json["max_overlap"], 1e-4, 12)
        self.assertIn("1 pair of grains, the deepest by 10 %", clast("porosity", file, "--bed", "box:0,0,4mm,2mm").out)
        self.assert_fails(2, "porosity", self.lattice(2), "--columns", "x,y", "--bed", "box:0,0,2,2", says=["x, y and z"])

    def test_a_run_knows_its_contacts_and_its_floor(self):
        """--gap put two sets of contacts into one fabric table; --floor was passed over without a word."""
        bed = self.folder / "bed"
        found = clast("pack", "--curve", "4mm", "--mass", "0.5g", "--width", "30mm", "--height", "0.1m", "--shaking-time", "0s", "--max-steps", 2000, "-o", bed)
        self.assertEqual(found.code, 0, found.err)
        self.assert_fails(2, "porosity", bed, "--cut", 0.95, "--gap", "0.1mm", says=["knows its contacts", "--gap"])
        self.assert_fails(2, "porosity", bed, "--cut", 0.95, "--floor", "1mm", says=["--floor", "--bed"])
        self.assert_fails(2, "porosity", bed, "--cut", 0.95, "--bed", "cylinder:15mm", "--gap", "0.1mm", says=["knows its contacts"])
        self.assertEqual(clast("porosity", bed, "--cut", 0.95, "--bed", "cylinder:15mm", "--floor=-1mm", "--json").json["z_low"], -1e-3)

    def test_force_chains_of_a_bed_in_which_nothing_touches(self):
        """The chart ended the command with "chart axis 'x (mm)' has no finite value to show", its tables were not written."""
        bed, out = self.folder / "bed", self.folder / "out"
        made = clast("pack", "--curve", "4mm", "--mass", "1g", "--width", "20mm", "--height", "60mm", "--max-steps", 20, "--seed", 2, "-q", "-o", bed)
        self.assertEqual(made.code, 0, made.err)
        found = clast("porosity", bed, "--cut", 0.99, "--chains", "-o", out)
        self.assertEqual(found.code, 0, found.err)
        self.assertIn("force chains        none: no grain touches another or a wall, so there is no chains.svg", found.out)
        for name, is_there in [("chains.csv", True), ("chains.vtp", True), ("chains.svg", False), ("profile.csv", True), ("summary.json", True)]:
            self.assertEqual((out / name).exists(), is_there, name)
        self.assert_fails(2, "porosity", self.lattice(2), "--bed", "box:9,9,10,10", "--chains", says=["this bed knows none"])  # before it is measured

    def test_a_cell_carries_its_stress_through_its_borders(self):
        """Contacts across the border in z were left out of porosity's stress, and piled on the end slices; a sheared cell had a floor."""
        cell = ["--density", 2500, "--domain", "cell", "--no-floor", "--gravity", 0, "--fluid-density", 0, "-q"]
        start = self.folder / "cubic.csv"
        start.write_text("x_m,y_m,z_m,radius_m\n" + "".join(f"{4e-3 * i - 6e-3},{4e-3 * j - 6e-3},{4e-3 * k},2e-3\n"
                                                            for i in range(4) for j in range(4) for k in range(4)))
        runs = {"lattice": ["--start", start, "--width", "16mm", "--height", "16mm", "--friction", 0, "--stages", "isotropic 10kPa until rest"],
                "sheared": ["--curve", "uniform:3mm,5mm", "--width", "20mm", "--height", "20mm", "--mass", "2g", "--load-rate", 20,
                            "--stages", "isotropic 10kPa until rest", "--stages", "shear 5/s until strain 0.03"]}
        for name, words in runs.items():
            run, out = self.folder / name, self.folder / (name + "-porosity")
            found = clast("pack", *words, *cell, "-o", run)
            self.assertEqual(found.code, 0, found.err)
            with open(run / "load.csv", encoding="ascii") as file:
                load = {k: float(v or "nan") for k, v in list(csv.DictReader(file))[-1].items()}
            found = clast("porosity", run, "--local", "--chains", "--fields", "2mm", "--json", "-o", out)
            self.assertEqual(found.code, 0, found.err)
            self.assertAlmostEqual(found.json["bulk"], load["porosity"], 9)
            self.assertEqual(found.json["n_local"], found.json["n_grain"])
            for axes in ("xx", "yy", "zz", "xy", "xz", "yz"):
                self.assertAlmostEqual(found.json["stress"]["stress_" + axes] / load["pressure_Pa"],
                                       load[f"stress_{axes}_Pa"] / load["pressure_Pa"], 4, (name, axes))
            with open(out / "stress_profile.csv", encoding="ascii") as file:
                for row in csv.DictReader(file):
                    self.assertAlmostEqual(float(row["stress_zz_Pa"]) / load["stress_zz_Pa"], 1, 1, (name, row["z_low_m"]))
        # means of several runs have the units that reports give the same numbers: the mass in the fields had none
        means = self.folder / "means"
        self.assertEqual(clast("porosity", *(self.folder / name for name in runs), "--fields", "2mm", "-o", means).code, 0)
        units = {row["quantity"]: row["unit"] for row in csv.DictReader((means / "means.csv").read_text().splitlines())}
        self.assertEqual([units[key] for key in ("field_mass", "top", "solid", "bulk", "stress_xx", "pressure", "stress_ratio", "normal_1")],
                         ["kg", "m", "m^3", "-", "Pa", "Pa", "-", "-"])

    def test_what_a_smaller_bed_than_the_grains_holds(self):
        """Slices count grains whole: a window of a packing had the solid beyond its sides, 0.174 for 0.47, without a word."""
        path = self.lattice(5)
        more = ["--layer", 0.1, "--cut", 0.9]
        for bed, n in [("box:0.5,0.5,4.5,4.5", 80), ("cylinder:2.5,2.5,2.5", 60), ("box:10,0,15,5", 125)]:
            self.assert_fails(3, "porosity", path, "--bed", bed, *more, says=[f"--bed: {n} of 125 grains reach beyond its sides", "--pores"])
        text = clast("porosity", path, "--bed", "box:0.5,0.5,4.5,4.5", *more, "--pores", 20000)
        self.assertEqual(text.code, 0, text.err)
        self.assertIn("beyond the sides    80 grains, by up to 0.5 model units: a part of a packing; bulk and profile count what lies inside", text.out)
        found = clast("porosity", path, "--bed", "box:0.5,0.5,4.5,4.5", *more, "--pores", 20000, "--json").json
        self.assertAlmostEqual(found["max_beyond"], 0.5, 12)
        self.assertAlmostEqual(found["pore_porosity"], 1 - 3.141592653589793 / 6, 2)
        found = clast("porosity", path, "--bed", "box:0.04,0,5,5", *more, "--json").json
        self.assertEqual(found["n_beyond"], 25)
        self.assertAlmostEqual(found["max_beyond"], 0.04, 12)
        self.assertTrue(0 < found["solid_beyond"] < 0.01 * found["solid"])
        found = clast("porosity", path, "--bed", "box:0,0,5,5", *more, "--json").json
        self.assertEqual((found["n_beyond"], found["max_beyond"], found["solid_beyond"]), (0, 0, 0))
        self.assertNotIn("n_beyond", clast("porosity", path, "--bed", "periodic:0,0,5,5", *more, "--json").json)

    def test_a_window_is_measured_by_pores(self):
        """Refused as holding 2.05 times its room, or measured up to a top of the solid that it does not hold (12.05 for 10.20)."""
        path, close = self.lattice(6), 1 - 3.141592653589793 / 6
        for bed in ("box:1.5,1.5,4.5,4.5", "box:1,1,5,5", "cylinder:2,3,3"):
            words = ("porosity", path, "--bed", bed, "--layer", 0.1, "--cut", 1)
            self.assert_fails(3, *words, says=["--pores"])
            found = clast(*words, "--pores", 40000, "--json")
            self.assertEqual(found.code, 0, found.err)
            self.assertAlmostEqual(found.json["top"], 6, 12)
            self.assertAlmostEqual(found.json["bulk"], found.json["pore_porosity"], 2)
            if bed.startswith("box"):
                self.assertAlmostEqual(found.json["bulk"], close, 2)
        self.assert_fails(3, "porosity", path, "--bed", "box:0,0,1,1", "--layer", 0.1, says=["between z = 0 model units and 6"])

    def test_what_a_part_of_a_packing_is_told_to_have(self):
        """The last ring held all grains beyond (porosity -3.9), a grain had more solid than its cell, and a cut was told to be a wall."""
        path, out = self.lattice(8), self.folder / "out"
        words = ("porosity", path, "--bed", "cylinder:3,4,4", "--layer", 0.1, "--pores", 20000)
        text = clast(*words, "--rings", 4, "--local", "-o", out)
        self.assertEqual(text.code, 0, text.err)
        self.assertIn("side walls          none: the bed is a part of a packing", text.out)
        found = json.loads((out / "summary.json").read_text())
        self.assertIs(found["is_part"], True)
        self.assertNotIn("wall_ratio", found)
        rings = [float(row["porosity"]) for row in csv.DictReader((out / "radial.csv").read_text().splitlines())]
        mean = sum(n * (2 * k + 1) / 16 for k, n in enumerate(rings))
        self.assertAlmostEqual(mean, found["bulk"], 2)
        self.assertTrue(all(0.2 < n < 0.7 for n in rings), rings)
        cells = list(csv.DictReader((out / "local.csv").read_text().splitlines()))
        self.assertTrue({"", "0"} <= {row["porosity"] and row["border"] for row in cells})
        self.assertTrue(all(row["porosity"] == "" or float(row["porosity"]) > 0.3 for row in cells))
        self.assert_fails(2, *words, "--core", 1, says=["a part of a packing has no side walls"])
        self.assertIs(clast("porosity", path, "--bed", "box:0,0,8,8", "--layer", 0.1, "--json").json["is_part"], False)
        # nothing said so of several
        other = self.folder / "other.csv"
        other.write_text(path.read_text() + "\n")
        several = clast("porosity", path, other, *words[2:], "-o", self.folder / "two")
        self.assertIn("the beds are parts of packings", several.out)
        self.assertIs(json.loads((self.folder / "two/summary.json").read_text())["is_part"], True)
        self.assertEqual(clast("report", self.folder / "two").code, 0)
        self.assertIn("(of a part of the packing)", (self.folder / "two/report.html").read_text())
        small = self.spheres([(x + 0.5, y + 0.5, z + 0.5, 0.5) for x in range(2, 6) for y in range(2, 6) for z in range(8)], "small.csv")
        self.assert_fails(2, "porosity", path, small, "--bed", "box:2,2,6,6", "--layer", 0.1, "--pores", 100, says=["small.csv and is a part of the packing of"])

    def test_a_part_of_a_run_has_no_stress_and_ends_at_its_walls(self):
        """All contacts over the window's volume were 3.2 times the stress; a tenth of a square about a cylinder was pores without a word."""
        bed, out = self.folder / "bed", self.folder / "out"
        made = clast("pack", "--curve", "4mm", "--mass", "5g", "--width", "2cm", "--height", "4cm", "--shaking-time", 0, "--rule", "speed", "--initial-speed", 0.5,
                     "-o", bed, "-q")
        self.assertEqual(made.code, 0, made.err)
        words = ("porosity", bed, "--cut", 0.9)
        self.assertIn("stress", clast(*words, "--bed", "cylinder:10mm", "--json").json)
        text = clast(*words, "--bed", "box:-9mm,-9mm,9mm,9mm", "--pores", 500, "-o", out)
        self.assertEqual(text.code, 0, text.err)
        self.assertIn("no stress (--fields has it by place)", text.out)
        self.assertIn("outside             10.3 % of the bed lies outside the run's own", text.out)
        found = json.loads((out / "summary.json").read_text())
        self.assertAlmostEqual(found["bed_outside"], 0.1032, 3)
        self.assertNotIn("stress", found)
        self.assertFalse((out / "stress.csv").exists() or (out / "stress.svg").exists())
        self.assertNotIn("bed_outside", clast(*words, "--json").json)
        self.assertEqual(clast(*words, "--bed", "cylinder:10mm", "--json").json["bed_outside"], 0)

    def test_a_periodic_bed_repeats_as_its_grains_do(self):
        """A smaller period than the packing's had a porosity of 0.2772 for 0.4408, and no word but of the run's own contacts."""
        path = self.lattice(6)
        more = ["--layer", 0.1, "--cut", 0.9]
        for bed in ("periodic:0,0,5,5", "periodic:0,0,0,6,6,5", "periodic:0,0,0,6,6,5.5,2"):
            for pores in ([], ["--pores", 100]):
                self.assert_fails(3, "porosity", path, "--bed", bed, *more[:2], *pores, says=["--bed: its images lie on", "its period is not theirs"])
        big = self.lattice(22)  # one cell of a lattice had all pairs of all images looked at: minutes
        for bed in ("periodic:0,0,1,1", "periodic:0,0,0,1,1,1"):
            self.assert_fails(3, "porosity", big, "--bed", bed, *more[:2], says=["times the volume of one period", "the bed's period is not theirs"])
        path = self.lattice(6)
        for bed in ("periodic:0,0,6,6", "periodic:-1,2,5,8", "periodic:0,0,0,6,6,6,1"):
            self.assertEqual(clast("porosity", path, "--bed", bed, *more).code, 0, bed)
        # grains that overlap by themselves do so across the borders too
        thick = self.spheres([(i + 0.5, j + 0.5, k + 0.5, 0.6) for i in range(4) for j in range(4) for k in range(4)], "thick.csv")
        self.assertEqual(clast("porosity", thick, "--bed", "periodic:0,0,4,4", *more).code, 0)
        run = self.folder / "run"
        made = clast("pack", "--domain", "periodic", "--trim", 0, "--curve", "4mm", "--mass", "4g", "--width", "24mm", "--height", "3cm", "--shaking-time", 0,
                     "--rule", "speed", "--initial-speed", 0.5, "-o", run, "-q")
        self.assertEqual(made.code, 0, made.err)
        own = clast("porosity", run, "--cut", 0.9, "--json").json["bulk"]
        moved = clast("porosity", run, "--cut", 0.9, "--bed", "periodic:-3mm,-12mm,21mm,12mm", "--json")
        self.assertAlmostEqual(moved.json["bulk"], own, 12)
        for bed, says in (("periodic:-11.9mm,-12mm,11.9mm,12mm", "a period of 23.8 mm along x, where the run repeats after 24 mm"),
                          ("periodic:-12mm,-13mm,12mm,13mm", "a period of 26 mm along y"),
                          ("periodic:-12mm,-12mm,0mm,12mm,12mm,4mm", "its images lie on")):
            self.assert_fails(3, "porosity", run, "--cut", 0.9, "--bed", bed, says=[says])

    def test_a_sheared_box_needs_no_contacts(self):
        """Its seventh number was refused for every packing, though no contacts were asked for."""
        path = self.spheres([(i + 0.5 + 0.25 * k, j + 0.5, k + 0.5, 0.5) for i in range(4) for j in range(4) for k in range(4)])
        bed = ("--bed", "periodic:0,0,0,4,4,4,1", "--layer", 0.1)
        found = clast("porosity", path, *bed, "--local", "--pores", 5000, "--json")
        self.assertEqual(found.code, 0, found.err)
        for key, places in (("bulk", 12), ("local_mean", 12), ("pore_porosity", 1)):
            self.assertAlmostEqual(found.json[key], 1 - 3.141592653589793 / 6, places)
        self.assertNotIn("n_overlap", found.json)
        self.assertIn("overlaps            not searched for across the borders of a sheared box", clast("porosity", path, *bed).out)
        self.assert_fails(2, "porosity", path, *bed, "--gap", 1e-6, says=["sheared box", "leave out --gap"])
        self.assert_fails(2, "porosity", path, "--bed", "periodic:0", says=["periodic:X0,Y0,Z0,X1,Y1,Z1[,SHIFT]"])

    def test_a_cut_of_one_ends_with_the_highest_grain(self):
        """It ended at the end of the profile's empty slice, by the height of the slices: 0.56 and 0.48 of one bed."""
        path = self.lattice(5)
        for layer in (0.07, 0.1, 1, 3):
            for more in ([], ["--method", "spheres"]):
                found = clast("porosity", path, "--bed", "box:0,0,5,5", "--layer", layer, "--cut", 1, *more, "--json").json
                self.assertAlmostEqual(found["top"], 5, 12)
                self.assertAlmostEqual(found["bulk"], 1 - 3.141592653589793 / 6, 12)
        self.assertAlmostEqual(clast("porosity", path, "--bed", "box:0,0,5,5", "--layer", 3, "--cut", 1, "--at-slice", "--json").json["top"], 6, 12)

    def test_the_jammed_packing_as_it_is(self):
        path = shared("packings/rcp10000/packing.xyzd")
        if path is None:
            return
        bed = "periodic:0,0,0,20.0823593086113,20.0823593086113,20.0823593086113"
        found = clast("porosity", path, "--diameter", 1, "--bed", bed, "--gap", 1e-4, "--json")
        self.assertAlmostEqual(found.json["bulk"], 0.353520998, 8)
        self.assertAlmostEqual(found.json["coordination"], 5.9506, 12)
        self.assertEqual(found.json["n_overlap"], 0)
        self.assertAlmostEqual(clast("porosity", path, "--bed", bed, "--json").json["bulk"], 0.355088, 6)

    def test_random_close_packing_of_others(self):
        """10,000 spheres of a periodic cube: published porosity 0.353520964812133, diameter rescaled to contact."""
        path = shared("packings/rcp10000/packing.xyzd")
        if path is None:
            return
        edge = 20.0823593086113
        data = path.read_bytes()
        rows = [struct.unpack_from("<4d", data, 32 * i)[:3] for i in range(len(data) // 32)]
        # the cube repeats in z too: images above and below make the slab [0, edge] whole
        images = [(x, y, z + shift, 0.5) for x, y, z in rows for shift in (-edge, 0, edge)
                  if -0.5 < z + shift < edge + 0.5]
        file = self.spheres(images)
        layer = edge / 400
        found = clast("porosity", file, "--bed", f"periodic:0,0,{edge},{edge}", "--floor", repr(-10 * layer),
                      "--layer", repr(layer), "--cut", 0.9, "--json")
        self.assertEqual(found.code, 0, found.err)
        inside = [row["porosity"] for row in found.json["profile"][10:410]]
        self.assertAlmostEqual(sum(inside) / 400, 0.353520998, 9)


if __name__ == "__main__":
    unittest.main()
