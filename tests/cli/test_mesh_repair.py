"""CLI: clast mesh repair writes a solid and tells every change."""
import random
import unittest

from clitest import ROOT, Case, clast, shared

DATA = ROOT / "data"


class MeshRepair(Case):
    def test_cracked_ellipsoid_becomes_a_solid(self):
        out = self.folder / "out.stl"
        result = clast("mesh", "repair", DATA / "scarlet/stl/ellipse.stl", "-o", out, "--json")
        self.assertEqual(result.code, 0, result.err)
        self.assertTrue(result.json["closed"])
        self.assertEqual(result.json["changes"]["n_merged"], 8)
        again = clast("mesh", "check", out, "--json")
        self.assertEqual(again.code, 0)
        self.assertAlmostEqual(again.json["volume"], 4188.100549, places=5)

    def test_words_name_the_changes(self):
        result = clast("mesh", "repair", DATA / "broken-meshes/assimp/Spider_binary.stl", "-o", self.folder / "s.stl")
        self.assertEqual(result.code, 0, result.err)
        for text in ["56 triangles without area dropped", "6 holes filled", "triangles 1368 -> 1372", "a solid"]:
            self.assertIn(text, result.out)

    def test_steps_can_be_left_out(self):
        result = clast("mesh", "repair", DATA / "scarlet/stl/ellipse.stl", "-o", self.folder / "o.stl", "--weld", "off",
                       "--fill=false", "--json")
        self.assertEqual(result.code, 1)
        self.assertEqual(result.json["n_open_edge"], 32)

    def test_parted_bodies_in_stl_are_warned_about(self):
        """The file was "a solid: closed, oriented and manifold", code 0; `mesh check` of it: NOT a solid."""
        source, out = DATA / "broken-meshes/trimesh/shared.STL", self.folder / "o.stl"
        result = clast("mesh", "repair", source, "-o", out, "--json")
        self.assertIn("cannot keep 2 doubled vertices apart", result.err)
        self.assertEqual((result.code, result.json["manifold"]), (1, False))
        self.assertEqual(clast("mesh", "check", out).code, 1)
        self.assertEqual(clast("mesh", "repair", source, "-o", self.folder / "o.ply").code, 0)

    def test_a_wall_inside_a_solid_goes(self):
        """It was written twice, cut otherwise: area 12, "a solid" that cut itself."""
        vertices = [f"{x} {y} {z}" for x in (0, 1, 2, 3) for y in (0, 1) for z in (0, 1)]
        sides = [(0, 1, 3, 2), (12, 14, 15, 13)]
        for i in (0, 4, 8):
            sides += [(i, i + 4, i + 5, i + 1), (i + 2, i + 3, i + 7, i + 6), (i, i + 2, i + 6, i + 4), (i + 1, i + 5, i + 7, i + 3)]
        for walls in ([(4, 5, 7, 6)], [(6, 7, 5, 4)], [(4, 5, 7, 6), (8, 9, 11, 10)]):
            path, out = self.folder / "wall.off", self.folder / "o.ply"
            lines = [f"3 {a} {b} {c}\n3 {a} {c} {d}" for a, b, c, d in sides + walls]
            path.write_text("\n".join([f"OFF\n16 {2 * len(lines)} 0", *vertices, *lines]) + "\n")
            result = clast("mesh", "repair", path, "-o", out, "--json")
            found = result.json
            self.assertEqual((result.code, found["n_triangle"], found["area"], found["volume"]), (0, 28, 14, 3), walls)
            self.assertEqual((found["n_intersection"], found["changes"]["n_separated"]), (0, 0), walls)

    def test_block_turned_inside_out(self):
        path = shared("broken-meshes/admesh-block/normal-directions-good.stl")
        if path:
            result = clast("mesh", "repair", path, "-o", self.folder / "o.stl", "--json")
            self.assertAlmostEqual(result.json["volume"], 61.023745, places=6)
            self.assertEqual(result.json["changes"]["n_turned"], 12)

    def test_slivers_on_one_line_do_not_multiply(self):
        """300 triangles on a line but for rounding became 99138, and 600 took 6 s to check, 2500 minutes."""
        path = self.folder / "line.off"
        draw = random.Random(1)
        points = [(x, 2 * x, 3 * x) for x in (draw.random() for _ in range(3600))]
        for n in (300, 1200):
            path.write_text("\n".join([f"OFF\n{3 * n} {n} 0", *("{} {} {}".format(*p) for p in points[:3 * n]),
                                       *(f"3 {3 * t} {3 * t + 1} {3 * t + 2}" for t in range(n))]) + "\n")
            if n == 300:
                result = clast("mesh", "repair", path, "--no-loose", "--no-fill", "-o", self.folder / "o.ply", "--json")
                self.assertLessEqual(result.json["n_triangle"], 8 * n + 1000)
        first, second = (clast("mesh", "check", path, "--json", "-j", n).json for n in (1, 2))
        self.assertEqual((first, first["intersection_complete"]), (second, False))

    def test_options_of_steps_left_out_are_refused(self):
        """Each was taken, and the surface was that without it."""
        for options, says in ((("--weld-tolerance", 0.05), "--weld-tolerance does nothing without --weld within"),
                              (("--no-split", "--split-tolerance", 0.01), "--split-tolerance does nothing with --no-split"),
                              (("--no-fill", "--fill-size", 0.1), "--fill-size does nothing with --no-fill")):
            self.assert_fails(2, "mesh", "repair", DATA / "standin63/grain00.ply", "-o", self.folder / "o.ply", *options, says=(says,))

    def test_wrong_use_and_hopeless_input(self):
        self.assert_fails(2, "mesh", "repair", DATA / "scarlet/stl/ellipse.stl", says=["-o NAME.stl"])
        self.assert_fails(3, "mesh", "repair", DATA / "broken-meshes/trimesh/soup.stl", "-o", self.folder / "o.stl",
                          says=["nothing is left", "100 shared no edge"])
        self.assertFalse((self.folder / "o.stl").exists())


if __name__ == "__main__":
    unittest.main()
