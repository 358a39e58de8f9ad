"""CLI: clast mesh check says what is wrong, in words, numbers and exit codes."""
import math
import unittest

from clitest import ROOT, Case, clast, shared

DATA = ROOT / "data"
KEYS = ["file", "n_vertex", "n_triangle", "closed", "oriented", "manifold", "n_part", "euler", "volume", "area",
        "hull_volume", "n_open_edge", "n_degenerate", "faults"]


class MeshCheck(Case):
    def test_json_has_the_stable_keys(self):
        result = clast("mesh", "check", DATA / "scarlet/stl/27sk21_shape_fine.stl", "--json")
        self.assertEqual(result.code, 0)
        for key in KEYS:
            self.assertIn(key, result.json)
        self.assertEqual(result.json["n_triangle"], 650)
        self.assertEqual(result.json["faults"], [])
        self.assertAlmostEqual(result.json["volume"], 3903.69956, places=4)

    def test_open_surface_names_the_cure(self):
        result = clast("mesh", "check", DATA / "scarlet/stl/ellipse.stl", "--weld", "off", "--json")
        self.assertEqual(result.code, 1)
        self.assertEqual(result.err, "")
        self.assertFalse(result.json["closed"])
        self.assertEqual(result.json["n_open_edge"], 32)
        fault = result.json["faults"][0]
        self.assertEqual(fault["code"], "open_edges")
        self.assertIn("they close when vertices within", fault["text"])
        self.assertIn("clast mesh repair", fault["text"])

    def test_a_border_without_open_edges_is_no_hole(self):
        """A facet written twice: \"0 open edges in 1 loop ... `clast mesh repair` fills holes\"."""
        path = self.folder / "twice.off"
        path.write_text("OFF\n4 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 1 2 3\n")
        result = clast("mesh", "check", path, "--json")
        fault = result.json["faults"][0]
        self.assertEqual((result.code, result.json["n_open_edge"], fault["code"], fault["blocking"]), (1, 0, "odd_edges", True))
        self.assertIn("edges of three triangles, or another odd number, form 1 loop", fault["text"])
        self.assertNotIn("open edge", clast("mesh", "check", path).out)

    def test_weld_closes_what_its_tolerance_allows(self):
        result = clast("mesh", "check", DATA / "scarlet/stl/ellipse.stl", "--weld", "within", "--json")
        self.assertEqual(result.code, 0)
        self.assertTrue(result.json["closed"])
        self.assertEqual(result.json["n_merged"], 8)

    def test_seams_of_equal_vertices_are_no_holes(self):
        folder = DATA / "broken-meshes"
        result = clast("mesh", "check", folder / "trimesh/cube_blender_uv.ply", "--json")
        self.assertEqual((result.code, result.json["closed"], result.json["n_vertex"]), (0, True, 24))
        self.assertEqual(result.json["faults"][0]["code"], "equal_vertices")
        self.assertEqual(result.json["n_merged"], 16)
        # b, n of the data's README, counted after merging bit-equal vertices
        for name, n_open, n_over in [("draco/delim_test.ply", 4, 0), ("draco/non_manifold_wrap.obj", 8, 1),
                                     ("draco/test_nm.obj", 30, 0), ("trimesh/cubevt.obj", 0, 0)]:
            found = clast("mesh", "check", folder / name, "--weld", "within", "--weld-tolerance", 0, "--json").json
            self.assertEqual((found["n_open_edge"], found["n_nonmanifold_edge"]), (n_open, n_over), name)

    def test_words_hold_the_same_numbers(self):
        result = clast("mesh", "check", DATA / "scarlet/stl/ellipse.stl", "--weld", "off")
        self.assertEqual(result.code, 1)
        for text in ["NOT a solid", "closed NO", "triangles 9996", "FAULT open_edges: 32 open edges in 8 loops"]:
            self.assertIn(text, result.out)

    def test_a_unit_that_the_file_says_is_told(self):
        """"model units: the file's own" for a file of ours in mm."""
        path = self.folder / "grain.stl"
        clast("mesh", "convert", DATA / "standin63/grain00.ply", "--unit", "mm", "-o", path)
        self.assertIn("(lengths in mm)", clast("mesh", "check", path).out)
        self.assertEqual(clast("mesh", "check", path, "--json").json["unit"], "mm")
        repaired = clast("mesh", "repair", path, "-o", self.folder / "closed.stl")
        self.assertIn("grain.stl (lengths in mm):", repaired.out)
        self.assertNotIn("model units", repaired.out)
        self.assertEqual(clast("mesh", "check", DATA / "standin63/grain00.ply", "--json").json["unit"], "model")

    def test_a_surface_too_small_for_doubles_is_not_called_flat(self):
        """1e-160 across: "is flat: its 4 vertices lie in one plane"."""
        path = self.folder / "tiny.obj"
        path.write_text("v 0 0 0\nv 1e-160 0 0\nv 0 1e-160 0\nv 0 0 1e-160\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
        for command in (("shape",), ("mesh", "form", "-o", self.folder / "f.ply"), ("fill", "-o", self.folder / "f.csv")):
            self.assert_fails(3, *command[:2 if command[0] == "mesh" else 1], path, *command[2 if command[0] == "mesh" else 1:],
                              says=("tiny.obj", "an extent of 1.73e-160 is too small for a volume"))

    def test_pyramid_has_55_shells(self):
        path = shared("scarlet/stl/pyramid.stl")
        if path:
            self.assertEqual(clast("mesh", "check", path, "--json").json["n_part"], 55)

    def test_inside_out_is_not_oriented(self):
        path = shared("broken-meshes/admesh-block/normal-directions-good.stl")
        if path:
            result = clast("mesh", "check", path, "--json")
            self.assertEqual((result.code, result.json["closed"], result.json["oriented"]), (1, True, False))
            self.assertEqual(result.json["faults"][0]["code"], "inside_out")

    def test_a_fan_of_one_plane_is_searched(self):
        """Two caps of a cylinder with 1500 corners, aslant: a million pairs that share a corner, all of one plane by exact zeros."""
        n, tilt = 1500, 0.3
        corners = [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), z) for z in (0, 1) for i in range(n)]
        corners = [(x, math.cos(tilt) * y - math.sin(tilt) * z, math.sin(tilt) * y + math.cos(tilt) * z) for x, y, z in corners]
        faces = [range(n - 1, -1, -1), range(n, 2 * n), *((i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n))]
        path = self.folder / "cylinder.off"
        path.write_text("\n".join(["OFF", f"{2 * n} {n + 2} 0", *(" ".join(map(repr, c)) for c in corners),
                                   *(" ".join(map(str, (len(f), *f))) for f in faces)]) + "\n")
        found = clast("mesh", "check", path, "--json").json
        self.assertEqual((found["intersection_complete"], found["n_intersection"], found["faults"]), (True, 0, []))

    def test_no_triangles_is_an_answer(self):
        result = clast("mesh", "check", DATA / "broken-meshes/trimesh/empty.stl", "--json")
        self.assertEqual((result.code, result.json["closed"], result.json["n_triangle"]), (1, False, 0))

    def test_an_option_without_effect_is_refused(self):
        """The weld's tolerance was taken, and looked at by one weld alone."""
        for weld in ((), ("--weld", "off")):
            self.assert_fails(2, "mesh", "check", DATA / "standin63/grain00.ply", *weld, "--weld-tolerance", 0.05,
                              says=("--weld-tolerance does nothing without --weld within",))

    def test_unreadable_is_code_3(self):
        self.assert_fails(3, "mesh", "check", self.folder / "absent.stl", says=["absent.stl"])
        self.assert_fails(3, "mesh", "check", DATA / "broken-meshes/draco/inf_nan.obj", says=["inf_nan.obj"])


if __name__ == "__main__":
    unittest.main()
