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
