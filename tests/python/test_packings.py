"""Packings of other programs in Python: units, densities, snapshots, and what LAMMPS gets of them."""
import math
import os
import pathlib
import tempfile
import unittest
import warnings

import clast


def ball(diameter, density=2650.0):
    return math.pi / 6 * diameter ** 3 * density


class Packings(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return os.fspath(self.folder / name)

    def test_a_given_diameter_is_in_metres(self):
        start = self.write("c.csv", "x,y,z\n2,2,2\n6,2,2\n")
        bed = clast.pack(start=start, start_unit="mm", start_diameter="4mm", domain="box", width="40mm", height="50mm", max_steps=1)
        self.assertAlmostEqual(bed.mass / (2 * ball(4e-3)), 1.0, 12)
        with self.assertRaisesRegex(clast.Error, "start_diameter"):
            clast.pack(start=start, start_unit="mm", domain="box", width="40mm", height="50mm", max_steps=1)

    def test_a_unit_of_a_diameter_needs_one_of_the_file(self):
        """Lengths of a file without a unit are numbers of its own: "2mm" was 0.002 of them, a bead of a billionth of its volume."""
        path = self.write("bare.xyz", "2\nmm\nA 0 0 0\nB 2 0 0\n")
        for read in (lambda: clast.Assembly.read_spheres(path, diameter="2mm"), lambda: clast.export(path, self.folder / "o.csv", diameter="2mm"),
                     lambda: clast.porosity(path, diameter="2mm", bed="box:0,0,16,16")):
            with self.assertRaisesRegex(clast.Error, "^diameter: '2mm': the lengths have no unit"):
                read()
        self.assertFalse((self.folder / "o.csv").exists())
        for diameter in (2, "2"):
            self.assertAlmostEqual(clast.Assembly.read_spheres(path, diameter=diameter).volume / (2 * ball(2, 1)), 1.0, 12)
        in_mm = self.write("mm.csv", "x_mm,y_mm,z_mm\n0,0,0\n2,0,0\n")
        for diameter in (2e-3, "2mm"):
            self.assertAlmostEqual(clast.Assembly.read_spheres(in_mm, diameter=diameter).volume / (2 * ball(2e-3, 1)), 1.0, 12)
        with self.assertRaisesRegex(clast.Error, "^diameter: 2 has no unit"):
            clast.Assembly.read_spheres(in_mm, diameter="2")

    def test_ids_of_a_file_are_kept(self):
        path = self.write("in.csv", "id,x_mm,y_mm,z_mm,d_mm\n7,5,5,2,4\n3,9,5,2,4\n")
        grains = clast.Assembly.read_spheres(path)
        self.assertEqual(list(grains.table()["id"]), [7, 3])
        grains.write(self.folder / "out.dump")
        self.assertIn("\n7 1 0.005 ", (self.folder / "out.dump").read_text(encoding="utf-8"))
        told = clast.export(grains, self.folder / "out.voro")
        self.assertEqual((told["ids_kept"], told["id_offset"]), (True, 0))
        self.assertTrue((self.folder / "out.voro").read_text(encoding="utf-8").startswith("7 0.005 "))
        told = clast.export(self.write("new.csv", "x,y,z,d\n5,5,2,4\n"), self.folder / "new.voro")
        self.assertEqual((told["ids_kept"], told["id_offset"]), (False, 1))

    def test_the_last_snapshot_is_read_and_warned_of(self):
        one = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\nITEM: ATOMS id x y z radius\n1 2 2 {} 1\n"
        path = self.write("two.dump", "ITEM: UNITS\ncgs\n" + one.format(0, 8) + one.format(40, 1))
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            grains = clast.Assembly.read_spheres(path)
        self.assertIn("snapshot 2 of 2, TIMESTEP 40", str(told[-1].message))
        self.assertEqual((grains.unit, grains.positions[0][2]), ("m", 0.01))
        grains.write(self.folder / "out.dump")
        text = (self.folder / "out.dump").read_text(encoding="utf-8")
        self.assertIn("ITEM: TIMESTEP\n40\n", text)
        self.assertIn("BOX BOUNDS pp pp pp\n0 0.09\n", text)

    def test_no_density_is_invented(self):
        path = self.write("bare.csv", "x_mm,y_mm,z_mm,d_mm\n5,5,2,4\n")
        grains = clast.Assembly.read_spheres(path)
        self.assertNotIn("density_kg/m^3", grains.table().columns)
        for source in (path, grains):
            with self.assertRaisesRegex(clast.Error, "density"):
                clast.export(source, self.folder / "no.data")
            told = clast.export(source, self.folder / "yes.data", density="2.5g/cm3")
            self.assertEqual(told["format"], "data")
            self.assertIn("\n1 1 0.004 2500 ", (self.folder / "yes.data").read_text(encoding="utf-8"))
        with self.assertRaisesRegex(clast.Error, "density"):
            grains.write(self.folder / "no.data")
        grains.densities[:] = 2000
        grains.write(self.folder / "set.data")
        with self.assertRaisesRegex(clast.Error, "density.*own"):
            clast.export(self.folder / "set.data", self.folder / "no.data", density=2500)
        ids = self.write("ids.txt", "1 5 5 2\n2 5 15 2\n")
        self.assertEqual(clast.export(ids, self.folder / "ids.xyzd", diameter=4)["n_grain"], 2)
        with self.assertRaisesRegex(clast.Error, "^diameter does nothing with a run"):
            clast.export(grains, self.folder / "no.xyzd", diameter=4)

    def test_lammps_gets_step_and_period_of_a_run(self):
        bed = clast.pack(curve="4mm", mass="1g", domain="cell", width="16mm", height="20mm", floor=False, gravity=0, fluid_density=0,
                         stages=["hold until time 1s"], max_steps=7, output=self.folder / "run")
        for write in (lambda path: clast.export(bed.run, path), bed.run.grains.write):
            write(self.folder / "run.dump")
            text = (self.folder / "run.dump").read_text(encoding="utf-8")
            self.assertIn("ITEM: TIMESTEP\n7\n", text)
            self.assertIn("BOX BOUNDS pp pp pp\n-0.008 0.008\n", text)


if __name__ == "__main__":
    unittest.main()
