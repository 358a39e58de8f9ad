"""CLI: clast mesh repair writes a solid and tells every change."""
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
        source = DATA / "broken-meshes/trimesh/shared.STL"
        result = clast("mesh", "repair", source, "-o", self.folder / "o.stl", "--json")
        self.assertEqual(result.code, 0)
        self.assertIn("cannot keep 2 doubled vertices apart", result.err)

    def test_block_turned_inside_out(self):
        path = shared("broken-meshes/admesh-block/normal-directions-good.stl")
        if path:
            result = clast("mesh", "repair", path, "-o", self.folder / "o.stl", "--json")
            self.assertAlmostEqual(result.json["volume"], 61.023745, places=6)
            self.assertEqual(result.json["changes"]["n_turned"], 12)

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
