"""CLI: an open surface has one count of open edges, and every refusal prints the command that closes the file."""
import re
import shlex
import unittest

from clitest import ROOT, Case, clast, shared

CUBE = """OFF
8 11 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
3 0 2 1
3 0 3 2
3 4 5 6
3 4 6 7
3 0 1 5
3 0 5 4
3 1 2 6
3 1 6 5
3 2 3 7
3 2 7 6
3 3 0 4
"""


def commands(name, folder):
    """A use of the surface by each command that wants a solid."""
    points = folder / "points.csv"
    points.write_text("x,y,z\n" + "".join(f"{0.2 + 0.3 * (i % 3)},{0.2 + 0.3 * (i // 3 % 3)},{0.2 + 0.3 * (i // 9)}\n" for i in range(27)))
    return [("shape", name),
            ("fill", name, "--spheres", 2, "-q"),
            ("aggregate", "--core", name, "--core-size", "100um", "--unit", "um", "--coat", "sphere", "--size", "10um"),
            ("pack", "--shapes", name, "--no-hull", "--mass", "1e-4kg", "--max-steps", 1, "-q"),
            ("decompose", points, "--domain", f"mesh:{name}"),
            ("mesh", "simplify", name, "--faces", 1000, "-o", "simple.ply"),
            ("mesh", "form", name, "--unit-form", "-o", "form.ply")]


class OpenSurface(Case):
    def refused_alike(self, path):
        """Commands that refuse the file say the count of mesh check; their printed command lets them go on."""
        check = clast("mesh", "check", path, "--json", cwd=self.folder).json
        n_refused = 0
        for command in commands(path, self.folder):
            result = clast(*command, cwd=self.folder)
            if "open" not in result.err or "close it: " not in result.err:
                continue
            n_refused += 1
            self.assertEqual(result.code, 3, result.err)
            self.assertIn(f": {check['n_open_edge']} open edges", result.err)
            cure = result.err.split("close it: ")[1].strip()
            self.assertEqual(cure, check["repair"])
            closed = shlex.split(cure)[-1]
            if n_refused == 1:
                self.assertEqual(clast(*shlex.split(cure)[1:], cwd=self.folder).code, 0)
                self.assertEqual(clast("mesh", "check", closed, cwd=self.folder).code, 0)
            again = clast(*(str(part).replace(str(path), closed) for part in command), cwd=self.folder)
            self.assertNotIn("open edges", again.err)
            if "cuts itself" not in again.err and "convex" not in again.err and "not 1000" not in again.err:
                self.assertIn(again.code, (0, 1), (command, again.err))
        return check, n_refused

    def test_a_cube_without_a_facet(self):
        path = self.folder / "a cube's side.off"
        path.write_text(CUBE)
        check, n_refused = self.refused_alike(path)
        self.assertEqual((check["n_open_edge"], n_refused), (3, 7))

    def test_published_spheres_with_seams_and_holes(self):
        """76 open edges as the file has it, 12 after the weld that every command makes."""
        path = shared("scarlet/stl/sphere.stl")
        if path is None:
            return
        self.assertEqual(clast("mesh", "check", path, "--weld", "off", "--json").json["n_open_edge"], 76)
        check, n_refused = self.refused_alike(path)
        self.assertEqual(check["n_open_edge"], 12)
        self.assertGreaterEqual(n_refused, 5)
        words = clast("mesh", "check", path).out
        self.assertIn("12 open edges", words)
        self.assertIn("76 open edges as the file has it", words)
        self.assertIn(f"to close it: {check['repair']}", words)

    def test_seams_of_rounding_are_closed_by_the_weld_everywhere(self):
        path = ROOT / "data/scarlet/stl/ellipse.stl"
        check = clast("mesh", "check", path, "--json")
        self.assertEqual((check.code, check.json["n_open_edge"], check.json["n_merged"]), (0, 0, 8))
        self.assertEqual(check.json["faults"][0]["code"], "merged_vertices")
        for command in commands(path, self.folder):
            result = clast(*command, cwd=self.folder)
            self.assertNotRegex(result.err, re.compile("open edges[^ ]|close it"))
            self.assertIn(result.code, (0, 1, 5), result.err)

    def test_what_is_inside_out_is_not_taken_as_it_is(self):
        """--accept-faults was offered, and ended in "volume is -1.7e-13"."""
        path = self.folder / "turned.off"
        path.write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n")
        grow = ("aggregate", "--core", path, "--core-size", "100um", "--unit", "um", "--coat", "sphere", "--sizes", "10um")
        self.assert_fails(3, *grow, says=["1 part inside out; orient it outward: clast mesh repair"])
        self.assertNotIn("--accept-faults", clast(*grow).err)


if __name__ == "__main__":
    unittest.main()
