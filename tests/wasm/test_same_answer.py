"""clast.wasm gives what the native command gives: every number of --json to the last bit, tables to the byte, refusals to the letter."""
import json
import pathlib
import subprocess
import unittest

import jobs


def run(given):
    """What clast.wasm makes of command lines and files under node."""
    script = pathlib.Path(__file__).with_name("run.mjs")
    done = subprocess.run(["node", script, jobs.PACKAGE], input=json.dumps(given), stdout=subprocess.PIPE, text=True, check=True, timeout=600)
    return json.loads(done.stdout)


class SameAnswer(unittest.TestCase):
    maxDiff = 4000

    def test_every_scene_is_equal_under_node(self):
        given = [{"words": words, "files": {name: str(path) for name, path in files.items()}} for words, files in jobs.JOBS.values()]
        for (name, (words, files)), result in zip(jobs.JOBS.items(), run(given)):
            with self.subTest(name):
                here, there = jobs.plain(jobs.native(words, files)), jobs.plain(result)
                self.assertEqual(here, there)

    def test_what_one_process_tells(self):
        """No study, whose runs are processes; a bench told no memory and no processor time, which emscripten does not measure."""
        study, bench = run([{"words": words.split(), "files": {}} for words in ("study --run fill --seeds 2 -o s", "bench GROW3 --repeats 1 --json")])
        self.assertEqual((study["status"], study["stderr"]), (3, "clast study: a study starts processes, which WebAssembly has none of\n"))
        scene = json.loads(bench["stdout"])["scenes"][0]
        self.assertGreater(scene["peak_memory"], 1e6)
        self.assertGreater(min(scene["value"], scene["cpu_s"]), 0)

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
        messages, manifest = told["warned"]
        self.assertRegex("\n".join(messages), "^clast decompose: warning: all points lie within .* are both in the same unit")
        self.assertEqual((told["no"]["messages"], manifest["command_line"][0]), ([], "clast"))
        self.assertNotIn("cpu_s", manifest)
        self.assertGreater(manifest["peak_memory_bytes"], 1e6)
        print(f"two beds one after the other {told['one']:.1f} s, in two workers {told['many']:.1f} s")


if __name__ == "__main__":
    lacking = jobs.lacking("node")
    if lacking:
        print(f"SKIPPED LOUDLY: {lacking}")
        raise SystemExit(0)
    unittest.main()
