"""The notebooks of examples/notebooks run, and print what is stored in them."""
import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import loud

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "examples/notebooks"
MISSING = [name for name in ("nbconvert", "ipykernel", "matplotlib") if importlib.util.find_spec(name) is None]


def words(path):
    """What each cell printed, and whether it drew; warnings, which name a file of the kernel's, are no part of it."""
    found = []
    for cell in json.loads(path.read_text())["cells"]:
        for out in cell.get("outputs", ()):
            if out.get("name") == "stderr":
                continue
            data = out.get("data", {})
            text = "" if "image/png" in data else "".join(out.get("text") or data.get("text/plain", ()))
            found.append((text, "image/png" in data))
    return found


@unittest.skipIf(MISSING, f"{loud.LEFT_OUT}{', '.join(MISSING)} not installed (tools/setup.sh notebook)")
class Notebooks(unittest.TestCase):
    maxDiff = None

    def run_one(self, name):
        with tempfile.TemporaryDirectory() as folder:
            # A kernel inherits these; a path of one's own keeps what the person's account has out of it.
            env = {**os.environ, "PYTHONPATH": str(ROOT / "python"), "JUPYTER_CONFIG_DIR": folder, "IPYTHONDIR": folder}
            done = subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--ExecutePreprocessor.timeout=500",
                                   f"--output-dir={folder}", "--output=out.ipynb", FOLDER / name], env=env, cwd=FOLDER, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True)
            self.assertEqual(done.returncode, 0, done.stdout[-3000:])
            stored, found = words(FOLDER / name), words(pathlib.Path(folder, "out.ipynb"))
            self.assertGreater(len(stored), 2, f"{name} has no outputs stored")
            self.assertIn(True, [drew for _, drew in stored])
            self.assertEqual(found, stored, f"{name}: run it anew: jupyter nbconvert --to notebook --execute --inplace "
                             f"--ExecutePreprocessor.record_timing=False examples/notebooks/{name}")

    def test_aggregates(self):
        self.run_one("aggregates.ipynb")

    def test_packings(self):
        self.run_one("packings.ipynb")

    def test_clouds(self):
        self.run_one("clouds.ipynb")

    def test_from_cloud_to_deposit(self):
        self.run_one("from_cloud_to_deposit.ipynb")

    def test_no_notebook_is_left_out(self):
        own = {name[5:] + ".ipynb" for name in dir(self) if name.startswith("test_")}
        self.assertEqual({path.name for path in FOLDER.glob("*.ipynb")} - own, set())


if __name__ == "__main__":
    loud.main()
