"""CPU seconds of scenes of `clast bench` by clast.wasm under node beside the native command with one thread: speed.py [SCENE[:MORE]...]
A scene runs once and once with MORE repeats (default 2), natively and by wasm in turn, ROUNDS times; the difference of the least times over MORE is a
repeat's time, without start, compilation and preparation, and with little of what else the machine does. CLAST_WASM names another build folder, CLAST another command."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import jobs

SCENES = ("P1_POUR", "SK21:20", "EJ15T:10", "D6")
ROUNDS = 3
SCRIPT = pathlib.Path(__file__).with_name("run.mjs")


def spent(words, text, where):
    """User seconds of a process."""
    before = os.times().children_user
    done = subprocess.run(words, input=text, cwd=where, capture_output=True, text=True, check=True)
    if '"status":' in done.stdout and '"status":0' not in done.stdout:
        sys.exit(f"speed: {done.stdout[:600]}")
    return os.times().children_user - before


def run(scene, repeats, by_wasm):
    words = ["bench", scene, "--repeats", str(repeats), "-j", "1"]
    if not by_wasm:
        return spent([jobs.CLAST, *words], "", jobs.ROOT)
    needs = {str(p.relative_to(jobs.ROOT)): str(p) for p in (jobs.ROOT / "data/scarlet").rglob("*") if p.is_file()}
    with tempfile.TemporaryDirectory() as folder:
        return spent(["node", SCRIPT, jobs.PACKAGE], json.dumps([{"words": words, "files": needs}]), folder)


def measured(scene, more):
    """Seconds of a repeat, natively and by wasm."""
    least = {}
    for _ in range(ROUNDS):
        for by_wasm in (False, True):
            for repeats in (1, 1 + more):
                took = run(scene, repeats, by_wasm)
                least[by_wasm, repeats] = min(took, least.get((by_wasm, repeats), took))
    return [(least[by_wasm, 1 + more] - least[by_wasm, 1]) / more for by_wasm in (False, True)]


def main():
    for word in sys.argv[1:] or SCENES:
        scene, _, more = word.partition(":")
        native, wasm = measured(scene, int(more or 2))
        print(f"{scene}: native {native:.3g} s, wasm {wasm:.3g} s, ratio {wasm / native:.2f}", flush=True)


if __name__ == "__main__":
    main()
