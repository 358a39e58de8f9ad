"""A clast that is built without HDF5 keeps states in plain HDF5 files of its own writing and goes on with them; files of HDF5 are refused by one line."""
import subprocess
import unittest

import clitest

clitest.skips = False
LINE = "built without HDF5"
MADE = ("--core", "sphere", "--core-size", "270um", "--coat", "sphere", "--size", "30um", "--replicate", "2")


@unittest.skipIf(not clitest.WITHOUT_HDF5, "this clast has HDF5; `make minimal` builds one without")
class WithoutHdf5(clitest.Case):
    def test_nothing_of_hdf5_is_loaded(self):
        self.assertNotIn("hdf5", subprocess.run(["ldd", clitest.CLAST], capture_output=True, text=True, check=True).stdout)

    def test_a_run_has_a_state_that_other_commands_read(self):
        result = clitest.clast("aggregate", *MADE, "--picture=false", "-o", self.folder / "run")
        self.assertEqual(result.code, 0, result.err)
        result = clitest.clast("export", self.folder / "run", "-o", self.folder / "x.csv")
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(len((self.folder / "x.csv").read_text().splitlines()), 4)

    def test_a_bed_goes_on_from_its_state_in_the_same_bits(self):
        words = ("pack", "--curve", "4mm", "--mass", "1g", "--width", "20mm", "--height", "30mm", "--json")
        whole = clitest.clast(*words, "--max-steps", 600)
        self.assertEqual(clitest.clast(*words, "--max-steps", 200, "-o", self.folder / "bed").code, 0)
        again = clitest.clast("pack", "--resume", self.folder / "bed", "--max-steps", 600, "--json")
        self.assertEqual(again.code, 0, again.err)
        self.assertEqual(again.json["state_hash"], whole.json["state_hash"])

    def test_a_damaged_state_is_refused(self):
        self.assertEqual(clitest.clast("aggregate", *MADE, "--picture=false", "-o", self.folder / "run").code, 0)
        path = self.folder / "run/state.h5"
        whole = path.read_bytes()
        for at in range(0, len(whole), 997):
            path.write_bytes(whole[:at] + bytes([whole[at] ^ 4]) + whole[at + 1:])
            self.assert_fails(3, "export", path, "-o", self.folder / "x.csv", says=(str(path),))

    def test_an_aggregate_in_memory_is_grown(self):
        result = clitest.clast("aggregate", *MADE, "--json")
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(result.json["n_grain"], 3)

    def test_files_of_hdf5_are_refused(self):
        path = self.folder / "x.h5"
        path.write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
        self.assert_fails(2, "decompose", path, "--domain", "box:0,0,0,1,1,1", says=(str(path), LINE))
        self.assert_fails(3, "export", path, "-o", self.folder / "x.vtu", says=(str(path),))
        self.assert_fails(2, "export", "data/state/schema1.h5", "-o", self.folder / "x.vtu", says=("schema1.h5", LINE))


if __name__ == "__main__":
    unittest.main()
