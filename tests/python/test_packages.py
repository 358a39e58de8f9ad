"""What makes the packages: a wheel with equal bytes and a true RECORD, and a list of parts that refuses what it does not know."""
import base64
import hashlib
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
sys.dont_write_bytecode = True
import wheel_backend  # noqa: E402


class Wheel(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        os.environ["SOURCE_DATE_EPOCH"] = "1795600000"
        self.addCleanup(os.environ.pop, "SOURCE_DATE_EPOCH")

    def made(self, name):
        out = self.folder / name
        out.mkdir()
        return out / wheel_backend.pack(out, "linux_x86_64", {"clast/libclast_view.so": b"\x7fELF", f"clast-{wheel_backend.VERSION}.data/scripts/clast": b"#!"})

    def test_equal_input_gives_equal_bytes(self):
        self.assertEqual(self.made("first").read_bytes(), self.made("second").read_bytes())

    def test_record_names_every_file_with_its_digest(self):
        with zipfile.ZipFile(self.made("wheel")) as wheel:
            record = wheel.read(f"{wheel_backend.INFO}/RECORD").decode().splitlines()
            self.assertEqual([line.split(",")[0] for line in record], wheel.namelist())
            for line in record[:-1]:
                name, digest, size = line.split(",")
                content = wheel.read(name)
                self.assertEqual(digest, "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode())
                self.assertEqual(int(size), len(content))
            self.assertEqual(wheel.getinfo("clast/libclast_view.so").external_attr >> 16, 0o100755)
            self.assertEqual(wheel.getinfo("clast/__init__.py").external_attr >> 16, 0o100644)

    def test_whole_package_is_inside(self):
        with zipfile.ZipFile(self.made("wheel")) as wheel:
            for path in (ROOT / "python/clast").glob("*.py"):
                self.assertIn(f"clast/{path.name}", wheel.namelist())

    def test_metadata_is_that_of_the_source_release(self):
        folder = self.folder / "metadata"
        folder.mkdir()
        info = wheel_backend.prepare_metadata_for_build_wheel(str(folder))
        self.assertEqual((folder / info / "METADATA").read_text(), wheel_backend.metadata())


class Parts(unittest.TestCase):
    def test_an_archive_that_is_not_listed_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            link_map = pathlib.Path(folder, "map")
            link_map.write_text("Archive member included\n\n/usr/lib/libjbig.a(jbig.o)\n  x.o (jbg_dec_init)\n")
            done = subprocess.run([ROOT / "tools/sbom.py", folder, ROOT / "README.md", "--map", link_map], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("/usr/lib/libjbig.a was linked, and is not in packaging/bundle/bundled.txt", done.stderr)


if __name__ == "__main__":
    unittest.main()
