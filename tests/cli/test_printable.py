"""CLI: what printers take: surfaces that an independent checker (ADMesh) finds nothing to correct in."""
import json
import re
import shutil
import subprocess
import unittest

from clitest import ROOT, Case, clast

DATA = ROOT / "data/scarlet"
ASH = ("aggregate", "--core", DATA / "stl/27sk21_shape_coarse.stl", "--core-size", "270um", "--coat",
       DATA / "stl/27sk21_shape_fine.stl", "--unit", "um", "--sizes", DATA / "27sk21_deq_um.csv", "--size-unit", "um",
       "--n-particle", 12, "--picture=false")


def admesh(path):
    """What ADMesh counted, or None after saying loudly that it is not installed."""
    if shutil.which("admesh") is None:
        print("SKIPPED LOUDLY: admesh is not here (tools/setup.sh test); no independent check of surfaces ran")
        return None
    out = subprocess.run(["admesh", path], text=True, capture_output=True, check=True).stdout
    names = ("Number of parts", "Degenerate facets", "Edges fixed", "Facets removed", "Facets added",
             "Facets reversed", "Backwards edges", "Normals fixed")
    found = {name: int(re.search(name + r"\s*:\s*(\d+)", out).group(1)) for name in names}
    found["disconnected"] = int(re.search(r"Total disconnected facets\s*:\s*(\d+)", out).group(1))
    return found


class Printable(Case):
    def assert_clean(self, path, n_part=1):
        found = admesh(path)
        if found is not None:
            self.assertEqual(found.pop("Number of parts"), n_part, path)
            self.assertEqual({name for name, n in found.items() if n != 0}, set(), (path, found))

    def test_a_run_has_surfaces_without_a_fault(self):
        """A step of 5 um on 270 um of ash left 1e-3 of the facets as slivers with other normals in single precision."""
        run = self.folder / "run"
        result = clast(*ASH, "--printable", "--spacing", "5um", "-o", run)
        self.assertEqual(result.code, 0, result.err)
        self.assert_clean(run / "printable.stl")
        self.assert_clean(run / "aggregate.stl", 13)
        for spacing in (5, 6):  # a later body's numbers take the place of the first's on the page
            page = re.sub("<[^>]*>", " ", (run / "report.html").read_text())
            self.assertRegex(page, rf"Printable body\s+Smallest feature[^S]*The grid resolves it[^S]*Share of [^S]*Spacing of the grid\s+{spacing}.000")
            self.assertEqual(clast("aggregate", "--resume", run, "--printable", "--spacing", "6um").code, 0)

    def test_the_size_of_the_file_follows_the_spacing_and_is_told(self):
        sizes = []
        for spacing in (12, 6):
            run = self.folder / f"run{spacing}"
            result = clast(*ASH, "--printable", "--spacing", f"{spacing}um", "-o", run)
            told = re.search(r"printable.stl: about (\d+) triangles, ([\d.]+) MB, at a spacing of (\d+) um", result.err)
            n = json.loads((run / "printable.json").read_text())["n_triangle"]
            self.assertLess(abs(int(told.group(1)) / n - 1), 0.25)
            self.assertEqual(told.group(3), str(spacing))
            sizes.append((run / "printable.stl").stat().st_size)
            self.assertLess(abs(float(told.group(2)) * 1e6 / sizes[-1] - 1), 0.25)
        self.assertLess(abs(sizes[1] / sizes[0] / 4 - 1), 0.15)

    def test_walls_that_the_grid_loses_are_told(self):
        """A comb of ten fins 1.5 um thick, a quarter of its volume, was "resolved" at 4 um: its ellipsoid is 66 um thick."""
        outline = [(0, 0), (100, 0)] + [(100 - 10 * k - x, y) for k in range(10) for x, y in ((0, 20), (0, 60), (1.5, 60), (1.5, 20))] + [(0, 20)]
        outline = [p for i, p in enumerate(outline) if p != outline[i - 1]]
        n = len(outline)
        quad = [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)]
        fins = [[outline.index((100 - 10 * k - x, y)) for x, y in ((0, 20), (0, 60), (1.5, 60), (1.5, 20))] for k in range(10)]
        feet = [i for i, p in enumerate(outline) if p[1] == 20]
        sides = [[fin[0], fin[1], fin[2], fin[3]] for fin in fins] + [[0, 1] + [i for i in feet]]
        faces = [[n + i for i in side] for side in sides] + [side[::-1] for side in sides] + quad
        comb = self.folder / "comb.off"
        comb.write_text(f"OFF\n{2 * n} {len(faces)} 0\n" + "".join(f"{x} {y} {z}\n" for z in (0, 60) for x, y in outline) +
                        "".join(f"{len(face)} {' '.join(map(str, face))}\n" for face in faces))
        self.assertEqual(clast("mesh", "check", comb).code, 0)
        run = self.folder / "run"
        made = clast("aggregate", "--core", comb, "--core-size", 0, "--coat", "sphere", "--size", "20um", "--replicate", 2, "--unit", "um", "--no-picture",
                     "--printable", "--spacing", "4um", "-o", run)
        self.assertEqual(made.code, 0, made.err)
        body = json.loads((run / "printable.json").read_text())
        self.assertFalse(body["resolved"])
        self.assertFalse(body["walls_measured"])
        self.assertAlmostEqual(body["lost"], 1 - body["volume"] / body["solid_volume"], places=12)
        self.assertIn("(walls of the grains not measured), not resolved: 17 % of the grains' volume is lost\n", made.out)
        self.assertIn("printable.stl: not resolved: 17 % of the grains' volume is lost, thin walls of them; take a finer --spacing", made.err)
        fine = clast("aggregate", "--resume", run, "--printable", "--spacing", "700nm")
        self.assertIn("smallest feature 10 um (walls of the grains not measured), resolved\n", fine.out)
        told = int(re.search(r"about (\d+) triangles", fine.err).group(1))  # by the surface of its ellipsoid: 0.45 of it
        self.assertLess(abs(told / json.loads((run / "printable.json").read_text())["n_triangle"] - 1), 0.25)

    def test_grains_that_overlap_lose_nothing(self):
        """Composites sink into each other: the union is smaller than the sum of the grains, and resolved."""
        run = self.folder / "run"
        made = clast("aggregate", "--core", "ellipsoid:3,2,1", "--core-size", "100um", "--coat", "ellipsoid:3,2,1", "--size", "60um", "--replicate", 20,
                     "--fill-spheres", 5, "--contact", "march", "--no-picture", "--printable", "--spacing", "1um", "-o", run)
        self.assertEqual(made.code, 0, made.err)
        body = json.loads((run / "printable.json").read_text())
        self.assertLess(body["volume"], 0.95 * body["solid_volume"])
        self.assertEqual((body["resolved"], body["lost"]), (True, 0.0))

    def test_closed_surfaces_stay_without_a_fault(self):
        ellipse, scan = DATA / "stl/ellipse.stl", DATA / "stl/particle.stl"
        for command in (("mesh", "repair", ellipse), ("mesh", "repair", scan), ("mesh", "hull", scan),
                        ("mesh", "simplify", scan, "--faces", 2000), ("mesh", "form", DATA / "stl/27sk21_shape_fine.stl", "--flatness", 0.5)):
            out = self.folder / "out.stl"
            result = clast(*command, "-o", out)
            self.assertEqual(result.code, 0, result.err)
            self.assert_clean(out)

    def test_facets_that_single_precision_folds_are_left_out(self):
        """A needle of 1e-9 at 1 to 2: two corners are one in 24 bits; the file stays closed."""
        needle = self.folder / "needle.off"
        needle.write_text("OFF\n5 6 0\n1 1 1\n2 1 1\n1.000000001 2 1\n1 2 1\n1 1 2\n"
                          "3 0 2 1\n3 0 3 2\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n")
        out = self.folder / "out.stl"
        self.assertEqual(clast("mesh", "check", needle).code, 0)
        result = clast("mesh", "convert", needle, "-o", out)
        self.assertEqual(result.code, 0, result.err)
        self.assertIn("2 triangles", result.err)
        check = clast("mesh", "check", out, "--json")
        self.assertEqual((check.code, check.json["n_triangle"]), (0, 4))
        self.assert_clean(out)


if __name__ == "__main__":
    unittest.main()
