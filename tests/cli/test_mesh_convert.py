"""CLI: clast mesh convert, read back by programs that are not clast."""
import struct
import unittest
import xml.etree.ElementTree as xml
import zipfile

from clitest import ROOT, Case, clast

BROKEN = ROOT / "data/broken-meshes"


def read_stl(path):
    """Facets of a binary STL as lists of three points."""
    data = path.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    rows = [struct.unpack_from("<12fH", data, 84 + 50 * i) for i in range(count)]
    assert len(data) == 84 + 50 * count
    return data[:80], [[row[3:6], row[6:9], row[9:12]] for row in rows]


def volume(facets):
    total = 0.0
    for (ax, ay, az), (bx, by, bz), (cx, cy, cz) in facets:
        total += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return total / 6.0


def read_3mf(path):
    """Unit and facets of the one object of a 3MF; every part of the package must be well formed."""
    with zipfile.ZipFile(path) as package:
        assert package.testzip() is None
        trees = {name: xml.fromstring(package.read(name)) for name in package.namelist()}
    target = [e.get("Target") for e in trees["_rels/.rels"]][0].lstrip("/")
    model = trees[target]
    space = {"m": "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"}
    vertices = [tuple(float(v.get(k)) for k in "xyz") for v in model.iterfind(".//m:vertex", space)]
    facets = [[vertices[int(t.get(k))] for k in ("v1", "v2", "v3")] for t in model.iterfind(".//m:triangle", space)]
    item = model.find(".//m:item", space).get("objectid")
    assert item == model.find(".//m:object", space).get("id")
    return model.get("unit"), facets, model.find(".//m:object", space).get("name")


class Convert(Case):
    def test_json_tells_what_was_read_and_written(self):
        out = self.folder / "wall.stl"
        got = clast("mesh", "convert", BROKEN / "trimesh/wallhole.obj", "-o", out, "--json").json
        self.assertEqual((got["format"], got["n_vertex"], got["n_triangle"], got["warnings"]), ("obj", 92, 66, []))
        self.assertEqual((got["file"], got["output"]), (str(BROKEN / "trimesh/wallhole.obj"), str(out)))
        self.assertEqual(got["n_facet"], 13)
        header, facets = read_stl(out)
        self.assertTrue(header.startswith(b"clast "))
        self.assertAlmostEqual(volume(facets), 1066.666667, delta=1e-3)

    def test_warnings_are_in_the_json_and_on_stderr(self):
        donut = BROKEN / "numpy-stl/HalfDonut.stl"
        got = clast("mesh", "convert", donut, "-o", self.folder / "a.ply", "--json").json
        self.assertEqual(len(got["warnings"]), 1)
        self.assertIn("1 byte after the last", got["warnings"][0])
        plain = clast("mesh", "convert", donut, "-o", self.folder / "a.ply")
        self.assertIn("1 byte after the last", plain.err)
        self.assertIn("288 triangles", plain.out)

    def test_3mf_is_in_millimetres_with_every_triangle(self):
        out = self.folder / "cube.3mf"
        done = clast("mesh", "convert", BROKEN / "trimesh/unit_cube.STL", "-o", out, "--unit", "um", "--name", "a<b&\"c\"")
        self.assertEqual(done.code, 0, done.err)
        unit, facets, name = read_3mf(out)
        self.assertEqual((unit, len(facets), name), ("millimeter", 12, 'a<b&"c"'))
        self.assertAlmostEqual(volume(facets) / 1e-9, 1.0, delta=1e-12)
        # the scale was told beside --out-unit alone
        self.assertIn("cube.3mf: 3mf in mm, lengths times 0.001\n", done.out)
        told = clast("mesh", "convert", BROKEN / "trimesh/unit_cube.STL", "-o", out, "--unit", "um", "--json").json
        self.assertAlmostEqual(told["factor"], 1e-3, delta=1e-18)
        same = clast("mesh", "convert", BROKEN / "trimesh/unit_cube.STL", "-o", out, "--unit", "mm", "--out-unit", "mm")
        self.assertTrue(same.out.endswith("3mf in mm\n"), same.out)
        self.assert_fails(2, "mesh", "convert", BROKEN / "trimesh/unit_cube.STL", "-o", out, "--unit", "um", "--out-unit", "um", says=["millimetres"])

    def test_units_and_scale_multiply_lengths(self):
        out = self.folder / "cube.obj"
        got = clast("mesh", "convert", BROKEN / "trimesh/unit_cube.STL", "-o", out, "--unit", "mm", "--out-unit", "um",
                    "--scale", "2", "--json").json
        self.assertAlmostEqual(got["factor"], 2000.0, delta=1e-9)
        points = [line.split()[1:] for line in out.read_text().splitlines() if line.startswith("v ")]
        self.assertEqual({abs(round(float(x), 6)) for point in points for x in point}, {1000.0})

    def test_formats_chain_without_loss(self):
        first = self.folder / "a.ply"
        clast("mesh", "convert", BROKEN / "assimp/concave_polygon.obj", "-o", first)
        steps = ["b.obj", "c.off", "d.ply"]
        source = first
        for step in steps:
            done = clast("mesh", "convert", source, "-o", self.folder / step)
            self.assertEqual(done.code, 0, done.err)
            source = self.folder / step
        self.assertEqual(first.read_bytes(), source.read_bytes())

    def test_stl_far_from_the_origin_says_what_is_lost(self):
        far = self.folder / "far.off"
        far.write_text("OFF\n3 1 0\n1e6 0 0\n1000000.123 0 0\n1e6 1 0\n3 0 1 2\n")
        got = clast("mesh", "convert", far, "-o", self.folder / "far.stl", "--json").json
        self.assertIn("coordinates move by up to", got["warnings"][0])
        got = clast("mesh", "convert", far, "-o", self.folder / "far.ply", "--json").json
        self.assertEqual(got["warnings"], [])

    def test_names_that_are_not_utf8_still_give_json(self):
        name = (str(self.folder).encode() + b"/\xff.obj").decode("utf-8", "surrogateescape")
        with open(name, "w", encoding="ascii") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        got = clast("mesh", "convert", name, "-o", self.folder / "a.ply", "--json").json
        self.assertTrue(got["file"].endswith(r"/\xff.obj"), got["file"])

    def test_a_name_is_refused_where_the_format_has_none(self):
        """It was taken: the PLY and the OFF had the bytes of those without it."""
        cube = BROKEN / "trimesh/unit_cube.STL"
        for ending in ("ply", "off"):
            self.assert_fails(2, "mesh", "convert", cube, "--name", "die", "-o", self.folder / f"a.{ending}",
                              says=("--name does nothing with .ply and .off",))
        for ending in ("stl", "obj", "3mf"):
            self.assertEqual(clast("mesh", "convert", cube, "--unit", "mm", "--name", "die", "-o", self.folder / f"a.{ending}").code, 0)

    def test_the_unit_of_our_own_header_is_read(self):
        """shape --unit mm took a file of micrometres whose header says so: a volume 1e9 off, without a word."""
        cube, out = BROKEN / "trimesh/unit_cube.STL", self.folder / "o.ply"
        volume = clast("shape", cube, "--unit", "mm", "--json").json["grains"][0]["volume"]
        for ending in ("stl", "obj", "ply", "off"):
            path = self.folder / f"um.{ending}"
            self.assertEqual(clast("mesh", "convert", cube, "--unit", "mm", "--out-unit", "um", "-o", path).code, 0)
            found = clast("shape", path, "--json").json
            self.assertEqual(found["unit"], "m")
            self.assertAlmostEqual(found["grains"][0]["volume"] / volume, 1, places=6)
            self.assertEqual(clast("shape", path, "--unit", "um").code, 0)
            self.assert_fails(2, "shape", path, "--unit", "mm", says=("says its unit of length, 1e-06 m",))
            self.assert_fails(2, "mesh", "convert", path, "--unit", "mm", "-o", out, says=("it is in um, not in mm",))
            self.assert_fails(2, "aggregate", "--core", path, "--unit", "mm", "--coat", "sphere", "--size", "3um", "--replicate", 2,
                              says=("it is in um, not in mm",))
            self.assertEqual(clast("mesh", "convert", path, "--out-unit", "mm", "-o", out, "--json").json["factor"], 1e-6 / 1e-3)
            for command in (("repair",), ("hull",), ("form", "--flatness", 0.6), ("simplify", "--faces", 8)):
                self.assertIn(clast("mesh", command[0], path, *command[1:], "-o", out).code, (0, 5))
                self.assertIn(b", unit um\n", out.read_bytes()[:99])
        path.write_text(path.read_text().replace("# clast", "# clask"))
        self.assertEqual(clast("shape", path, "--json").json["unit"], "model")

    def test_bad_use_and_bad_input_are_one_line(self):
        cube = BROKEN / "trimesh/unit_cube.STL"
        self.assert_fails(2, "mesh", "convert", cube, says=["-o NAME.stl"])
        self.assert_fails(2, "mesh", "convert", cube, "-o", self.folder / "a.step", says=["a.step", ".3mf"])
        self.assert_fails(2, "mesh", "convert", cube, "-o", self.folder / "a.3mf", says=["--unit"])
        self.assert_fails(2, "mesh", "convert", cube, "-o", self.folder / "a.stl", "--unit", "ell", says=["ell", "um"])
        self.assert_fails(2, "mesh", "convert", cube, "-o", self.folder / "a.stl", "--out-unit", "um", says=["--unit"])
        self.assert_fails(2, "mesh", "convert", cube, "-o", self.folder / "a.stl", "--scale", "-1", says=["scale"])
        self.assert_fails(3, "mesh", "convert", BROKEN / "assimp/malformed.obj", "-o", self.folder / "a.stl",
                          says=["malformed.obj", "line 23", "12 of 8"])
        self.assert_fails(3, "mesh", "convert", BROKEN / "trimesh/obj_points.obj", "-o", self.folder / "a.stl",
                          says=["8 points and no triangles"])
        self.assert_fails(3, "mesh", "convert", self.folder / "none.stl", "-o", self.folder / "a.stl", says=["none.stl"])
        self.assert_fails(4, "mesh", "convert", cube, "-o", self.folder / "no/a.stl", says=["no folder"])
        # an STL of no triangles, with code 0
        self.assert_fails(3, "mesh", "convert", cube, "--scale", 1e-50, "-o", self.folder / "a.stl", says=["all 12 triangles have two corners that are one"])
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
