"""CLI: clast export writes what other programs read, checked with readers of our own in Python's standard library."""
import base64
import csv
import json
import math
import struct
import unittest
import xml.etree.ElementTree
import zlib

from clitest import ROOT, Case, clast

STATE = ROOT / "data/state/schema1.h5"
FORMAT = {"Float64": "d", "Int64": "q", "Int32": "i", "UInt8": "B"}


def decode(array):
    """Numbers of a DataArray: base64 of the header, then base64 of zlib blocks."""
    text = array.text.strip()
    count = struct.unpack("<Q", base64.b64decode(text[:12])[:8])[0]
    size = 8 * (3 + count)
    coded = 4 * ((size + 2) // 3)
    head = struct.unpack(f"<{3 + count}Q", base64.b64decode(text[:coded])[:size])
    body, data, at = base64.b64decode(text[coded:]), b"", 0
    for n in head[3:]:
        data += zlib.decompress(body[at:at + n])
        at += n
    assert at == len(body)
    full = head[1] * count if head[2] == 0 else head[1] * (count - 1) + head[2]
    assert len(data) == (full if count else 0)
    letter = FORMAT[array.get("type")]
    return struct.unpack(f"<{len(data) // struct.calcsize(letter)}{letter}", data)


def read_vtu(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    assert root.get("type") == "UnstructuredGrid" and root.get("compressor") == "vtkZLibDataCompressor"
    piece = root.find("UnstructuredGrid/Piece")
    arrays = {a.get("Name"): decode(a) for a in piece.iter("DataArray")}
    return int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells")), arrays


class Export(Case):
    def export(self, name, *options):
        path = self.folder / name
        result = clast("export", STATE, "-o", path, *options, "--json")
        self.assertEqual(result.code, 0, result.err)
        return path, result.json

    def grains(self):
        path, _ = self.export("grains.csv")
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_csv_has_a_row_a_grain(self):
        rows = self.grains()
        self.assertEqual([row["id"] for row in rows], ["100", "101", "102", "103", "104", "105"])
        self.assertEqual(rows[0]["shape"], 'egg, "the" <first>')
        self.assertEqual([row["n_contact"] for row in rows], ["1", "2", "0", "1", "0", "0"])
        self.assertEqual(float(rows[1]["volume_mm3"]), 6.0 * 1.5**3)

    def test_vtu_surface_encloses_the_volumes(self):
        path, report = self.export("all.vtu", "--level", 5)
        n_point, n_cell, arrays = read_vtu(path)
        self.assertEqual((n_point, n_cell), (report["n_vertex"], report["n_triangle"]))
        self.assertEqual(len(arrays["Points"]), 3 * n_point)
        self.assertEqual(set(arrays["types"]), {5})
        self.assertEqual(arrays["offsets"], tuple(range(3, 3 * n_cell + 1, 3)))
        self.assertEqual(max(arrays["connectivity"]), n_point - 1)
        volume = {}
        for cell, grain in enumerate(arrays["grain"]):
            corner = arrays["connectivity"][3 * cell:3 * cell + 3]
            p, q, r = (arrays["Points"][3 * v:3 * v + 3] for v in corner)
            p, q, r = ((x - 10.0 * (grain - 100), y, z) for x, y, z in (p, q, r))
            six = (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2])
                   + p[2] * (q[0] * r[1] - q[1] * r[0]))
            volume[grain] = volume.get(grain, 0.0) + six / 6.0
        for order, row in enumerate(self.grains()):
            grain, cell = int(row["id"]), arrays["grain"].index(int(row["id"]))
            self.assertEqual(arrays["order"][cell], order)
            self.assertEqual(arrays["size"][cell], float(row["length_mm"]))
            if row["shape"] != "clump":  # whose spheres overlap
                self.assertAlmostEqual(volume[grain] / float(row["volume_mm3"]), 1.0, delta=2e-3)

    def test_vtu_points_hold_poses(self):
        path, report = self.export("points.vtu", "--points")
        n_point, n_cell, arrays = read_vtu(path)
        self.assertEqual((n_point, n_cell, report["n_triangle"]), (6, 6, 0))
        self.assertEqual(arrays["orientation_wxyz"][4:8], (0.5, -0.5, 0.5, 0.5))
        self.assertEqual(arrays["scale"], (1.0, 1.5, 2.0, 2.5, 3.0, 3.5))
        self.assertEqual(arrays["density"][5], 2005.0)
        self.assertEqual(arrays["shape"], (0, 1, 0, 2, 0, 1))
        self.assertEqual(arrays["Points"][3:6], (10.0, 0.125, -0.25))

    def test_surfaces_are_readable_by_mesh_check(self):
        for name in ("a.stl", "a.obj", "a.ply"):
            path, report = self.export(name, "--level", 1)
            checked = clast("mesh", "check", path, "--json").json
            self.assertEqual(checked["n_triangle"], report["n_triangle"], name)
            self.assertTrue(checked["closed"], name)

    def test_every_file_and_stdout_name_the_unit_of_lengths(self):
        """The state's grains are in mm; a surface read back in the unit that its file names has the same volume."""
        volumes = []
        for unit, factor in (("mm", 1.0), ("um", 1e3), ("m", 1e-3)):
            for name in ("a.stl", "a.obj", "a.ply"):
                path = self.folder / name
                result = clast("export", STATE, "-o", path, "--unit", unit)
                self.assertIn(f"lengths in {unit}", result.out)
                self.assertIn(f"unit {unit}".encode(), path.read_bytes()[:200])
                checked = clast("mesh", "check", path, "--json").json
                volumes.append(checked["volume"] / factor**3)
        for volume in volumes:
            self.assertAlmostEqual(volume / volumes[0], 1.0, delta=1e-6)
        self.assertEqual(self.export("b.stl")[1]["unit"], "mm")
        for name, unit in (("c.3mf", "mm"), ("c.vtu", "mm"), ("c.dump", "mm"), ("c.csv", "mm"), ("c.json", "mm")):
            result = clast("export", STATE, "-o", self.folder / name)
            self.assertIn(f"lengths in {unit}", result.out, name)
        root = xml.etree.ElementTree.parse(self.folder / "c.vtu").getroot()
        field = root.find("UnstructuredGrid/FieldData/DataArray[@Name='unit']")
        self.assertEqual(bytes(int(code) for code in field.text.split()), b"mm\0")
        self.assert_fails(2, "export", STATE, "-o", self.folder / "d.csv", "--unit", "um", says=["its unit is mm"])
        self.assert_fails(2, "export", STATE, "-o", self.folder / "d.stl", "--unit", "furlong", says=["furlong"])

    def test_what_a_file_holds_of_the_volume_is_told(self):
        """Meshes of spheres were 0.86 % low, dumps of scans 6 % heavy, and only a page of the documents said so."""
        spheres = self.folder / "s.xyzd"
        spheres.write_bytes(struct.pack("<8d", 0, 0, 0, 1, 1, 0, 0, 1))
        out = clast("export", spheres, "-o", self.folder / "s.stl")
        self.assertIn("facets of spheres and ellipsoids hold 0.86 % less volume", out.out)
        self.assertIn(b"grains", (self.folder / "s.stl").read_bytes()[:80])
        told = clast("export", spheres, "-o", self.folder / "s.3mf", "--json")
        if told.code == 0:
            self.assertAlmostEqual(told.json["facet_ratio"], 0.99139, delta=1e-5)
        clumps = self.folder / "c.txt"
        clumps.write_text("#format x_y_z_r_clumpId\n0 0 0 1 5\n1.2 0 0 1 5\n5 0 0 1 -1\n8 0 0 0.5 9\n8.5 0 0 0.5 9\n")
        out = clast("export", clumps, "-o", self.folder / "c.vtu")
        self.assertIn("facets of spheres and ellipsoids hold 0.86 % less volume", out.out)  # of the sphere alone
        self.assertIn("clumps are whole balls, one in another where they overlap: their facets hold 11 % more volume", out.out)
        told = clast("export", clumps, "-o", self.folder / "c.stl", "--json").json
        # two unions, of balls 1.2 and 1 radii apart: 1 - (4 + d)(2 - d)^2 / 32 of two balls
        unions = [2 * ball * (1 - (4 + d) * (2 - d) ** 2 / 32) for ball, d in ((1, 1.2), (0.125, 1))]
        self.assertAlmostEqual(told["clump_ratio"], 2 * 1.125 * 0.99139 / sum(unions), delta=1e-4)
        self.assertIsNone(clast("export", spheres, "-o", self.folder / "s.stl", "--json").json["clump_ratio"])
        mass = {row["id"]: float(row["mass_kg"]) for row in self.grains()}
        path, report = self.export("a.dump")
        self.assertGreater(report["ellipsoid_ratio"], 1.0)
        self.assertIsNone(report["facet_ratio"])
        lines = path.read_text(encoding="utf-8").splitlines()
        head = next(i for i, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
        names = lines[head].split()[2:]
        for line in lines[head + 1:]:
            row = dict(zip(names, map(float, line.split())))
            ball = 4 / 3 * math.pi * row["radius"] ** 3
            self.assertAlmostEqual(ball / (math.pi / 6 * row["shapex"] * row["shapey"] * row["shapez"]), 1.0, delta=1e-12)
            self.assertAlmostEqual(1e-9 * ball * row["density"] / mass[str(int(row["id"]) - 1)], 1.0, delta=1e-9)
        self.assertIn("of a density that gives each the mass and inertia", clast("export", STATE, "-o", self.folder / "a.data").out)

    def test_tables_of_the_run_are_written(self):
        path = self.folder / "history.csv"
        self.assertEqual(clast("export", STATE, "--table", "history", "-o", path).code, 0)
        self.assertEqual(path.read_text(encoding="utf-8"), 'porosity,shape\n0,""\n0.25,""\n0.5,"box, turned"\n')
        path = self.folder / "history.json"
        self.assertEqual(clast("export", STATE, "--table", "history", "-o", path).code, 0)
        self.assertEqual(json.loads(path.read_text(encoding="utf-8"))["columns"][0]["values"], [0, 0.25, 0.5])

    def test_a_folder_with_a_state_is_a_run(self):
        (self.folder / "state.h5").write_bytes(STATE.read_bytes())
        result = clast("export", self.folder, "-o", self.folder / "a.dump")
        self.assertEqual(result.code, 0, result.err)
        self.assertIn("dump of 6 grains", result.out)

    def test_wrong_uses_end_in_one_line(self):
        out = self.folder / "a.vtu"
        self.assert_fails(2, "export", STATE, says=["give -o"])
        self.assert_fails(2, "export", STATE, "-o", self.folder / "a.xyz", says=[".vtu"])
        self.assert_fails(2, "export", STATE, "-o", self.folder / "a.stl", "--points", says=["points"])
        self.assert_fails(2, "export", STATE, "-o", out, "--table", "history", says=[".csv or .json"])
        self.assert_fails(3, "export", self.folder / "absent", "-o", out, says=["cannot read"])
        self.assert_fails(3, "export", self.folder, "-o", out, says=["state.h5"])
        self.assert_fails(3, "export", ROOT / "LICENSE", "-o", out, says=["LICENSE:3: 6 cells"])  # a table of another program's, it seems
        text = self.folder / "text.h5"
        text.write_bytes((ROOT / "LICENSE").read_bytes())
        self.assert_fails(3, "export", text, "-o", out, says=["not an HDF5 file"])
        self.assert_fails(3, "export", STATE, "-o", self.folder / "t.csv", "--table", "none", says=["history"])
        self.assert_fails(4, "export", STATE, "-o", "/dev/full/a.vtu", says=["cannot write"])
        self.assert_fails(4, "export", STATE, "-o", self.folder / "absent/a.stl", says=["no folder"])
        self.assertFalse(out.exists())

    def test_damaged_state_is_refused_anywhere(self):
        whole = STATE.read_bytes()
        bad = self.folder / "bad.h5"
        for share in range(8):
            at = (2 * share + 1) * len(whole) // 16
            for damage in (whole[:at], whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1:]):
                bad.write_bytes(damage)
                self.assert_fails(3, "export", bad, "-o", self.folder / "a.csv", says=[str(bad)])
        self.assertFalse((self.folder / "a.csv").exists())

    def test_unwrapped_positions_of_a_dump_are_named(self):
        """They were "more than five columns without names of spheres"."""
        dump = self.folder / "unwrapped.dump"
        dump.write_text("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp ff\n0 4\n0 4\n0 4\nITEM: ATOMS id type xu yu zu radius\n"
                        "1 1 1 1 1 .5\n2 1 2 2 2 .5\n")
        self.assert_fails(3, "export", dump, "-o", self.folder / "o.csv", says=("of a dump x, y, z or xs, ys, zs are read", "--columns id,type,x,y,z,r"))
        self.assertEqual(clast("export", dump, "--columns", "id,type,x,y,z,r", "-o", self.folder / "o.csv").code, 0)

    def test_ids_of_another_programs_file_are_kept(self):
        """LAMMPS writes dumps unsorted: rows 7, 3, 5 came out as 1, 2, 3, so that a join by id met other grains."""
        head = ("ITEM: UNITS\nsi\nITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp pp ff\n-1 1\n-1 1\n0 2\n"
                "ITEM: ATOMS id type x y z radius density\n")
        (self.folder / "in.dump").write_text(head + "7 4 0 0 0.5 0.1 2650\n3 2 0.5 0 0.5 0.1 2600\n5 4 0 0.5 0.5 0.2 2500\n")
        (self.folder / "in.csv").write_text("id,x_m,y_m,z_m,r_m,density\n7,0,0,0.5,0.1,2650\n3,0.5,0,0.5,0.1,2600\n5,0,0.5,0.5,0.2,2500\n")
        for source in ("in.dump", "in.csv"):
            for name, first in (("o.dump", 9), ("o.data", None), ("o.voro", 0), ("o.csv", 1)):
                done = clast("export", source, "-o", name, cwd=self.folder)
                self.assertEqual(done.code, 0, done.err)
                self.assertNotIn("ids", done.out)
                text = (self.folder / name).read_text()
                lines = text.splitlines()[first:] if first is not None else text.split("Atoms # sphere\n\n")[1].splitlines()
                if name == "o.dump":
                    lines = text.split("ITEM: ATOMS")[1].splitlines()[1:]
                self.assertEqual([line.replace(",", " ").split()[0] for line in lines], ["7", "3", "5"], (source, name))
                if name != "o.csv":  # which says no radius
                    again = "again" + name[1:]
                    self.assertEqual(clast("export", name, "-o", again, *(["--columns", "id,x,y,z,r"] if name == "o.voro" else []),
                                           cwd=self.folder).code, 0)
                    self.assertEqual((self.folder / again).read_text().replace("lengths in model", "lengths in m"), text)
            report = clast("export", source, "-o", "o.dump", "--json", cwd=self.folder).json
            self.assertEqual((report["ids_kept"], report["id_offset"]), (True, 0))

    def test_new_ids_are_told_and_wrong_ones_refused(self):
        def export(text, name, *options, source="in.csv"):
            (self.folder / source).write_text(text)
            return clast("export", source, "-o", name, *options, cwd=self.folder)
        bare = "x,y,z,d\n0,0,0,1\n2,0,0,1\n"
        self.assertIn("ids are new: counted from 1 in the order of in.csv\n", export(bare, "o.dump").out)
        self.assertIn("ids are new: counted from 0 in the order of in.csv\n", export(bare, "o.csv").out)
        self.assertNotIn("ids", export(bare, "o.xyzd").out)  # holds none
        self.assertNotIn("ids", clast("export", STATE, "-o", self.folder / "o.csv").out)
        from_0 = "id,x,y,z,d\n1,0,0,0,1\n0,2,0,0,1\n"
        self.assertIn("ids are those of in.csv plus 1: LAMMPS and voro++ count from 1\n", export(from_0, "o.voro").out)
        self.assertEqual((self.folder / "o.voro").read_text(), "2 0 0 0 0.5\n1 2 0 0 0.5\n")
        for id_ in ("2.5", "-1", "1e17"):  # a column of something else
            self.assertIn("ids are new", export(f"id,x,y,z,d\n{id_},0,0,0,1\n2,2,0,0,1\n", "o.csv").out)
        dump = "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp ff\n-1 1\n-1 1\n0 2\nITEM: ATOMS id x y z radius\n"
        for source, text, line in (("in.csv", "id,x,y,z,d\n7,0,0,0,1\n7,2,0,0,1\n", "two rows have the id 7"),
                                   ("in.dump", dump + "7 0 0 0 1\n7 2 0 0 1\n", "two rows have the id 7"),
                                   ("in.dump", dump + "7 0 0 0 1\n2.5 2 0 0 1\n", "row 2 has the id 2.5")):
            done = export(text, "no.csv", source=source)
            self.assertEqual((done.code, line in done.err), (3, True), done.err)
        columns = "-,x,y,z,d"  # which leaves the ids out
        self.assertEqual(export("id,x,y,z,d\n7,0,0,0,1\n7,2,0,0,1\n", "o.csv", "--columns", columns).code, 0)

    def write_dump(self, columns, *rows, bounds="BOUNDS ff ff ff\n0 4\n0 4\n0 4"):
        (self.folder / "in.dump").write_text(f"ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX {bounds}\nITEM: ATOMS {columns}\n"
                                             + "".join(row + "\n" for row in rows))

    def read(self, source, *options):
        """id, position and radius of each grain that an export of it has."""
        done = clast("export", source, "-o", "read.csv", *options, cwd=self.folder)
        self.assertEqual(done.code, 0, done.err)
        with open(self.folder / "read.csv", newline="", encoding="utf-8") as file:
            return [tuple(float(value) for key, value in row.items() if key == "id" or key[:2] in ("x_", "y_", "z_")) + (float(row["length_model"]) / 2,)
                    for row in csv.DictReader(file)]

    def test_columns_name_all_columns_and_none_another(self):
        """x,y,z,r of a file id,x,y,z,r took ids as x and z as radii, exit code 0."""
        (self.folder / "named.csv").write_text("id,x,y,z,r\n3,1,2,3,.5\n9,2,4,6,.25\n")
        (self.folder / "turned.csv").write_text("r,x,y,z\n.5,1,2,3\n")
        (self.folder / "bare.txt").write_text("1 2 3 .5 7 8 9\n4 5 6 .5 7 8 9\n")
        out = self.folder / "no.csv"
        for name, columns, says in (("named.csv", "x,y,z,r", ("calls column 1 x, which is named id", "here are id, x, y, z, r")),
                                    ("turned.csv", "x,y,z,r", ("calls column 1 x, which is named r",)),
                                    ("named.csv", "id,x,y,z", ("names 4 of 5 columns (id, x, y, z, r)", "with - for one that is passed over")),
                                    ("bare.txt", "x,y,z,r", ("names 4 of 7 columns", "-"))):
            self.assert_fails(2, "export", self.folder / name, "--columns", columns, "-o", out, says=("--columns '" + columns, *says))
            self.assert_fails(2, "porosity", self.folder / name, "--columns", columns, "--bed", "box:0,0,9,9", says=("--columns '" + columns, *says))
            self.assert_fails(2, "pack", "--start", self.folder / name, "--start-unit", "mm", "--start-columns", columns,
                              says=("--start-columns '" + columns, *says))
        self.assertEqual(self.read("named.csv", "--columns", "-,x,y,z,d"), [(0, 1, 2, 3, 0.25), (1, 2, 4, 6, 0.125)])
        self.assertEqual(self.read("bare.txt", "--columns", "x,y,z,r,-,-,-"), [(0, 1, 2, 3, 0.5), (1, 4, 5, 6, 0.5)])
        (self.folder / "yade.txt").write_text("#format x_y_z_r_attrs\n1 2 3 .5 7 8 9\n")  # which names the rest at once
        self.assertEqual(self.read("yade.txt"), [(0, 1, 2, 3, 0.5)])

    def test_a_dump_of_repeated_ids_is_read_without_them(self):
        """There was no way: columns that left the ids out were read with them all the same."""
        self.write_dump("id type x y z radius", "7 1 1 1 1 .5", "7 2 2 2 2 .25")
        self.assert_fails(3, "export", self.folder / "in.dump", "-o", self.folder / "no.csv", says=("two rows have the id 7", "--columns with -"))
        self.assertEqual(self.read("in.dump", "--columns", "-,type,x,y,z,r"), [(0, 1, 1, 1, 0.5), (1, 2, 2, 2, 0.25)])
        self.write_dump("id type x y z shapex shapey shapez quatw quati quatj quatk", "7 1 1 1 1 1 .5 .5 1 0 0 0", "7 2 2 2 2 2 1 1 1 0 0 0")
        self.assertEqual(self.read("in.dump", "--columns", "-,type,x,y,z" + 7 * ",-"), [(0, 1, 1, 1, 0.5), (1, 2, 2, 2, 1)])

    def test_dumps_as_lammps_and_liggghts_write_them(self):
        """A tilted box's shares and LIGGGHTS's "id type type" were refused; types were x where a dump has no positions."""
        self.write_dump("id type xs ys zs radius", "2 1 .5 .5 .5 .25", "1 1 .25 0 0 .125", bounds="BOUNDS xy xz yz pp pp pp\n-1 3.5 .5\n0 3 1\n1 5 1")
        # a = (3, 0, 0), b = (.5, 2, 0), c = (1, 1, 4) from (-1, 0, 1)
        self.assertEqual(self.read("in.dump"), [(2, 1.25, 1.5, 3, 0.25), (1, -0.25, 0, 1, 0.125)])
        self.write_dump("id type type x y z ix iy iz vx vy vz radius", "1 1 1 1 2 3 0 0 0 9 9 9 .5")
        self.assertEqual(self.read("in.dump"), [(1, 1, 2, 3, 0.5)])
        self.write_dump("id typelabel x y z radius", "1 sand 1 2 3 .5")
        self.assertEqual(self.read("in.dump"), [(1, 1, 2, 3, 0.5)])
        for columns in ("id type vx vy vz", "id type xsu ysu zsu"):
            self.write_dump(columns, "1 1 .1 .1 .1", "2 1 .2 .2 .2")
            self.assert_fails(3, "export", self.folder / "in.dump", "-o", self.folder / "no.csv", says=("of a dump x, y, z or xs, ys, zs are read",))

    def test_properties_of_an_extended_xyz_name_its_columns(self):
        """They were passed over: a radius before the positions was x, and a charge behind them the radius."""
        wanted = [(8, 1, 2, 3, 0.5), (5, 4, 5, 6, 0.25)]
        for properties, rows in (("species:S:1:radius:R:1:pos:R:3:id:I:1", "Si .5 1 2 3 8\nO .25 4 5 6 5\n"),
                                 ("id:I:1:species:S:1:pos:R:3:velo:R:3:Radius:R:1", "8 Si 1 2 3 9 9 9 .5\n5 O 4 5 6 9 9 9 .25\n")):
            for comment in (f"Properties={properties}", f'Lattice="9 0 0 0 9 0 0 0 9" Properties="{properties}" pbc="T T F"'):
                (self.folder / "in.xyz").write_text(f"1\n{comment.replace(properties, 'species:S:1:pos:R:3:radius:R:1')}\nO 0 0 0 1\n\n2\n{comment}\n{rows}")
                self.assertEqual(self.read("in.xyz"), wanted, comment)
        (self.folder / "in.xyz").write_text("2\nProperties=species:S:1:pos:R:3:charge:R:1\nNa 1 2 3 4\nCl 4 5 6 7\n")
        self.assert_fails(3, "export", self.folder / "in.xyz", "-o", self.folder / "no.csv", says=("no column of numbers named radius", "--diameter"))
        self.assertEqual(self.read("in.xyz", "--diameter", "1"), [(0, 1, 2, 3, 0.5), (1, 4, 5, 6, 0.5)])
        for properties in ("species:S:1:pos:R", "species:S:1:pos:R:3:pos:R:3", "species:S:1:pos:R:3", "pos:R:99", "pos:R:x"):
            (self.folder / "in.xyz").write_text(f"1\nProperties={properties}\nNa 1 2 3 4\n")
            self.assert_fails(3, "export", self.folder / "in.xyz", "-o", self.folder / "no.csv", says=("in.xyz", "Properties"))

    def test_the_lattice_of_an_xyz_is_the_box(self):
        rows = "A 0 0 0 0.1\nB 0.5 0.5 0.5 0.2\n"
        for comment, box in (('Lattice="1 0 0 0 2 0 0 0 3" Properties=species:S:1:pos:R:3:radius:R:1', "pp pp pp\n0 1\n0 2\n0 3\n"),
                             ('Lattice="1 0 0 0 1 0 0 0 1" pbc="T F T" Origin="-1 0 0"', "pp ff pp\n-1 0\n0 1\n0 1\n"),
                             ("lattice='1 0 0 0 1 0 0.25 0 1'", "xy xz yz pp pp pp\n0 1.25 0\n0 1 0.25\n0 1 0\n"),
                             ('Lattice="1 1 0 0 1 0 0 0 1"', "ff ff ff\n-0.1 0.7\n-0.1 0.7\n-0.1 0.7\n"),  # a turned box is none of LAMMPS's
                             ("a comment", "ff ff ff\n-0.1 0.7\n-0.1 0.7\n-0.1 0.7\n")):
            (self.folder / "in.xyz").write_text(f"2\n{comment}\n{rows}")
            self.assertEqual(clast("export", "in.xyz", "-o", "o.dump", cwd=self.folder).code, 0)
            self.assertIn(f"BOX BOUNDS {box}", (self.folder / "o.dump").read_text(), comment)

    def test_lammps_gets_step_and_period_of_a_run(self):
        """TIMESTEP was 0, and the box of a periodic run that of its grains: another packing for who reads it as p p p."""
        cell = ["pack", "--domain", "cell", "--curve", "4mm", "--mass", "1g", "--width", "16mm", "--depth", "20mm", "--height", "20mm", "--floor=no", "--gravity", "0",
                "--fluid-density", "0", "-j", "1", "-q"]

        def bounds(run, ending):
            out = self.folder / f"out.{ending}"
            self.assertEqual(clast("export", run, "-o", out).code, 0)
            return out.read_text(encoding="utf-8").splitlines()

        run = self.folder / "still"
        self.assertEqual(clast(*cell, "--stages", "hold until time 1s", "--max-steps", "7", "-o", run).code, 0)
        data = bounds(run, "data")
        self.assertIn("-0.008 0.008 xlo xhi", data)
        self.assertIn("-0.01 0.01 ylo yhi", data)
        self.assertIn("0 0.02 zlo zhi", data)
        self.assertFalse([line for line in data if "xy xz yz" in line])
        self.assertIn("boundary p p p", data[0])
        dump = bounds(run, "dump")
        at = dump.index("ITEM: BOX BOUNDS pp pp pp")
        self.assertEqual(dump[at + 1:at + 4], ["-0.008 0.008", "-0.01 0.01", "0 0.02"])
        self.assertEqual(dump[dump.index("ITEM: TIMESTEP") + 1], "7")

        run = self.folder / "sheared"
        made = clast(*cell, "--stages", "shear 20/s until strain 0.1", "--json", "-o", run)
        self.assertEqual(made.code, 0, made.err)
        shift = made.json["cell"]["shear_strain"] * made.json["cell"]["height"]
        self.assertGreater(shift, 1e-3)
        data = bounds(run, "data")
        tilt = [line for line in data if "xy xz yz" in line]
        self.assertEqual(len(tilt), 1)
        numbers = [float(word) for word in tilt[0].split()[:3]]
        self.assertEqual((numbers[0], numbers[2]), (0, 0))
        self.assertAlmostEqual(numbers[1], shift, 12)
        self.assertIn("-0.008 0.008 xlo xhi", data)
        dump = bounds(run, "dump")
        at = dump.index("ITEM: BOX BOUNDS xy xz yz pp pp pp")
        row = [float(word) for word in dump[at + 1].split()]
        self.assertEqual(row[0], -0.008)
        self.assertAlmostEqual(row[1], 0.008 + shift, 12)  # as LAMMPS writes it: the bounds hold the tilt
        self.assertEqual(row[2], 0)
        self.assertAlmostEqual(float(dump[at + 2].split()[2]), shift, 12)
        self.assertEqual(dump[dump.index("ITEM: TIMESTEP") + 1], str(made.json["n_step"]))
        for ending in ("data", "dump"):  # and clast reads both again
            back = clast("export", self.folder / f"out.{ending}", "-o", self.folder / "back.xyzd")
            self.assertEqual(back.code, 0, back.err)

        run = self.folder / "periodic"
        self.assertEqual(clast("pack", "--domain", "periodic", "--curve", "4mm", "--mass", "1g", "--width", "20mm", "--height", "0.1m", "--max-steps", "9", "-q", "-o",
                               run).code, 0)
        data, dump = bounds(run, "data"), bounds(run, "dump")
        self.assertIn("boundary p p f", data[0])
        self.assertIn("-0.01 0.01 xlo xhi", data)
        self.assertIn("ITEM: BOX BOUNDS pp pp ff", dump)


if __name__ == "__main__":
    unittest.main()
