"""CPU seconds of scenes of `clast bench` by clast.wasm under node beside the native command with one thread: speed.py [SCENE[:MORE]...]
A scene runs once and once with MORE repeats (default 2); the difference over MORE is a repeat's time, without start, compilation and preparation.
CLAST_WASM names another build folder, CLAST another command."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import jobs

SCENES = ("P1_POUR", "SK21:20", "EJ15T:10", "D6")
SCRIPT = pathlib.Path(__file__).with_name("run.mjs")


def spent(words, text, where):
    """User seconds of a process."""
    before = os.times().children_user
    done = subprocess.run(words, input=text, cwd=where, capture_output=True, text=True, check=True)
    if '"status":' in done.stdout and '"status":0' not in done.stdout:
        sys.exit(f"speed: {done.stdout[:600]}")
    return os.times().children_user - before


def measured(scene, more, native):
    needs = {str(p.relative_to(jobs.ROOT)): str(p) for p in (jobs.ROOT / "data/scarlet").rglob("*") if p.is_file()}

    def run(repeats):
        words = ["bench", scene, "--repeats", str(repeats), "-j", "1"]
        if native:
            return spent([jobs.CLAST, *words], "", jobs.ROOT)
        with tempfile.TemporaryDirectory() as folder:
            return spent(["node", SCRIPT, jobs.PACKAGE], json.dumps([{"words": words, "files": needs}]), folder)
    return (run(1 + more) - run(1)) / more


def main():
    for word in sys.argv[1:] or SCENES:
        scene, _, more = word.partition(":")
        here, there = (measured(scene, int(more or 2), native) for native in (True, False))
        print(f"{scene}: native {here:.3g} s, wasm {there:.3g} s, ratio {there / here:.2f}", flush=True)


if __name__ == "__main__":
    main()
