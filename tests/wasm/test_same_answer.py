"""clast.wasm gives what the native command gives: every number of --json to the last bit, tables to the byte, refusals to the letter."""
import json
import pathlib
import subprocess
import unittest

import jobs

CHARTS = (".svg",)  # text in the built-in strokes of cairo


class SameAnswer(unittest.TestCase):
    maxDiff = 4000

    def test_every_scene_is_equal_under_node(self):
        given = [{"words": words, "files": {name: str(path) for name, path in files.items()}} for words, files in jobs.JOBS.values()]
        script = pathlib.Path(__file__).with_name("run.mjs")
        done = subprocess.run(["node", script, jobs.PACKAGE], input=json.dumps(given), capture_output=True, text=True, check=False, timeout=600)
        self.assertEqual(done.returncode, 0, done.stderr)
        for (name, (words, files)), result in zip(jobs.JOBS.items(), json.loads(done.stdout)):
            with self.subTest(name):
                here, there = jobs.plain(jobs.native(words, files)), jobs.plain(result)
                self.assertEqual(sorted(here["files"]), sorted(there["files"]))
                for one in (here, there):
                    one["files"] = {path: digest for path, digest in one["files"].items() if not path.endswith(CHARTS)}
                self.assertEqual(here, there)

    def test_files_of_any_name(self):
        """A file `hasOwnProperty` ended the run by a fault, and `__proto__` was not found."""
        done = subprocess.run(["node", pathlib.Path(__file__).with_name("names.mjs"), jobs.PACKAGE], capture_output=True, text=True, check=False, timeout=600)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        self.assertEqual(told.pop("empty"), 0)
        self.assertEqual(len(told), 5)
        for name, found in told.items():
            with self.subTest(name):
                self.assertEqual(found, [0, 0, True, True, False])

    def test_workers_give_the_same_and_end_at_once(self):
        script = pathlib.Path(__file__).with_name("workers.mjs")
        done = subprocess.run(["node", script, jobs.PACKAGE, "2"], capture_output=True, text=True, check=False, timeout=600)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        self.assertTrue(told["same"])
        self.assertEqual((told["aborted"], told["refused"]), ("AbortError", "ClastError"))
        self.assertEqual(told["waiting"], [True, "AbortError", 0])
        self.assertEqual(told["files"][0], told["files"][1])
        self.assertIn("bed/summary.json true", told["files"][0])
        self.assertTrue(told["no"]["reject"], told["no"])
        print(f"two beds one after the other {told['one']:.1f} s, in two workers {told['many']:.1f} s")


if __name__ == "__main__":
    lacking = jobs.lacking("node")
    if lacking:
        print(f"SKIPPED LOUDLY: {lacking}")
        raise SystemExit(0)
    unittest.main()
