"""A clast that is built without HDF5 refuses what needs it by one line, before it has written anything."""
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

    def test_a_run_folder_that_needs_states_is_refused_before_it_is_made(self):
        self.assert_fails(2, "aggregate", *MADE, "-o", self.folder / "run", says=(LINE, "CLAST_HDF5=ON"))
        self.assert_fails(2, "pack", "examples/u1.yaml", "--set", "mass=1g", "-o", self.folder / "bed", says=(LINE,))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_an_aggregate_in_memory_is_grown(self):
        result = clitest.clast("aggregate", *MADE, "--json")
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(result.json["n_grain"], 3)

    def test_files_of_hdf5_are_refused(self):
        path = self.folder / "x.h5"
        path.write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
        self.assert_fails(2, "decompose", path, "--domain", "box:0,0,0,1,1,1", says=(str(path), LINE))
        self.assert_fails(2, "export", path, "-o", self.folder / "x.vtu", says=(str(path), LINE))


if __name__ == "__main__":
    unittest.main()
