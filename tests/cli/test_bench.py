"""clast bench: the scenes run, print their keys, and refuse what they must."""
import unittest

from clitest import ROOT, Case, clast


class Bench(Case):
    def test_a_rate_is_compared_with_its_twin(self):
        out = clast("bench", "READ_PLY", "--repeats", 1, "-j", 1, "--json")
        self.assertEqual(out.code, 0, out.err)
        (scene,) = out.json["scenes"]
        self.assertEqual((scene["name"], scene["unit"], scene["threads"]), ("READ_PLY", "MB/s", 1))
        self.assertEqual(scene["reference_is"], "copying the same bytes")
        self.assertGreater(scene["value"], 0.0)
        self.assertAlmostEqual(scene["ratio"], scene["value"] / scene["reference"], places=12)

    def test_a_time_is_compared_the_other_way_round(self):
        (scene,) = clast("bench", "FILL_ELLIPSE", "--repeats", 1, "--json", cwd=ROOT).json["scenes"]
        self.assertEqual((scene["reference"], scene["unit"]), (110.0, "s"))
        self.assertAlmostEqual(scene["ratio"] * scene["value"], 110.0, places=9)

    def test_the_list_holds_the_scenes_of_the_design(self):
        names = [line.split()[0] for line in clast("bench", "--list").out.splitlines()]
        for name in ("SK21", "EJ15T", "FILL", "FILL_T_REX", "FILL_SNOWFLAKE", "SHAPE", "D6", "D6BOX", "D7", "D7B", "EVOLVE5"):
            self.assertIn(name, names)

    def test_an_unknown_scene_is_refused(self):
        self.assert_fails(2, "bench", "SK22", says=("no scene is called SK22",))

    def test_absent_data_is_named(self):
        self.assert_fails(3, "bench", "FILL", "--data", "nowhere", "--json", says=("nowhere/stl/particle.stl",))

    def test_what_ran_before_a_failure_is_not_lost(self):
        """Minutes of scenes gave no line of JSON when a later one had no file."""
        out = clast("bench", "READ_PLY", "FILL", "--data", "nowhere", "--repeats", 1, "--json")
        self.assertEqual([out.code, *(s["name"] for s in out.json["scenes"])], [3, "READ_PLY"])
        self.assertIn("--data names SCARLET-1.0's folder", out.err)

    def test_an_installed_clast_runs_what_needs_no_files(self):
        """Ended at its first scene, SK21, with code 3."""
        out = clast("bench", "--repeats", 1, "--time-limit", "2s", cwd=self.folder)
        self.assertEqual((out.code, out.err.count("\n")), (143, 1), out.err)
        self.assertNotIn("SK21", out.out + out.err)
        self.assertEqual(clast("bench", "--repeats", 1, "--data", "nowhere").code, 3)


if __name__ == "__main__":
    unittest.main()
