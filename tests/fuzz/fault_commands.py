#!/usr/bin/env python3
"""Every command that writes, with each of its disk operations failing in turn, and killed at random moments.

    tests/fuzz/fault_commands.py [--clast build/release/clast] [--each N] [--kills N] [--only WORD] [--jobs N]

A case begins with an older result in the output's place. Whatever fails, the code is 0 (then the new result is whole) or
4 (one line on stderr); the old result is there byte by byte, or the new one is whole (or all but its page, and says so); no temporary file is left; inputs
are as they were; and the same command works afterwards. --each limits the operations tried of each command and mode
(evenly spread; 0: all; -1: none). A kill (SIGKILL) may leave temporary files and a run beside the old one (out.new); resumed
where it can be, that run ends in the same bytes as one that nobody killed.
"""
import argparse
import concurrent.futures
import errno
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
MODES = [("once", errno.ENOSPC), ("on", errno.ENOSPC), ("once", errno.EIO), ("once", errno.EROFS), ("short", errno.ENOSPC)]
BOX = ["--domain", "box:0,0,0,1,1,1"]
BED = ["--curve", "6 mm", "--mass", "12g", "--width", "30mm", "--height", "0.1m", "--shaking-time", "0.01s"]
FALL = ["evolve", "--domain", "box:0,0,0,1mm,1mm,5mm", "--particles", "100", "--curve", "20um", "--duration", "0.2s", "--rows", "3", "--keep", "2"]
GROW = ["aggregate", "--core", "sphere", "--core-size", "200um", "--coat", "sphere", "--size", "60um", "--no-picture"]
# name, words of the old result, words of the new one, outputs, files that tell the new result (None: all)
CASES = [
    ("convert", "mesh convert g.ply -o out.obj", "mesh convert h.ply -o out.obj", None),
    ("repair", "mesh repair g.ply -o out.stl", "mesh repair h.ply -o out.stl", None),
    ("simplify", "mesh simplify g.ply --faces 60 -o out.ply", "mesh simplify h.ply --faces 60 -o out.ply", None),
    ("hull", "mesh hull g.ply -o out.ply", "mesh hull h.ply -o out.ply", None),
    ("form", "mesh form g.ply --flatness 0.6 --elongation 0.7 -o out.ply", "mesh form h.ply --flatness 0.6 --elongation 0.7 -o out.ply", None),
    ("synthesize", "mesh synthesize -o out.ply", "mesh synthesize --seed 2 -o out.ply", None),
    ("shape", "shape g.ply -o out.csv", "shape h.ply -o out.csv", None),
    ("fill", "fill g.ply --spheres 5 -o out.csv --history out2.csv", "fill h.ply --spheres 5 -o out.csv --history out2.csv", None),
    ("grading", "grading c.csv --sample 10 -o out.csv --chart out.svg", "grading c.csv --sample 20 -o out.csv --chart out.svg", None),
    ("export", "export bed -o out.vtu", "export bed2 -o out.vtu", None),
    ("export-3mf", "export bed -o out.3mf", "export bed2 -o out.3mf", None),
    ("render", "render g.ply --width 64 --height 64 -o out.png", "render h.ply --width 64 --height 64 -o out.png", None),
    ("report", "report bed -o out.html", "report bed2 -o out.html", None),
    ("statistics", "shape t.csv --resamples 5 --statistics out --force", "shape t2.csv --resamples 5 --statistics out --force", ["statistics.csv"]),
    ("decompose", ["decompose", "p.csv", *BOX, "-o", "out", "--force"], ["decompose", "q.csv", *BOX, "-o", "out", "--force"], ["cells.csv"]),
    ("agglomerate", ["agglomerate", "p.csv", *BOX, "--constant", "0.01", "-o", "out", "--force"],
     ["agglomerate", "q.csv", *BOX, "--constant", "0.01", "-o", "out", "--force"], None),
    ("porosity", "porosity bed -o out --force", "porosity bed2 -o out --force", ["profile.csv"]),
    ("predict", "predict t.csv -o out --force", "predict t2.csv -o out --force", ["prediction.csv"]),
    ("fit", "fit t.csv -o out --force", "fit t2.csv -o out --force", None),
    ("pack", ["pack", *BED, "-o", "out", "--force"], ["pack", *BED, "--seed", "2", "-o", "out", "--force"], ["state.h5", "grains.csv"]),
    ("evolve", [*FALL, "-o", "out", "--force"], [*FALL, "--seed", "2", "-o", "out", "--force"], ["deposit.csv", "events.csv"]),
    ("aggregate", [*GROW, "--replicate", "8", "-o", "out", "--force"],
     [*GROW, "--replicate", "12", "--seed", "2", "--repeats", "2", "-o", "out", "--force"], ["history.csv"]),
]
KILLED = {"pack": ["pack", *BED, "--seed", "2", "--checkpoint-time", "0.02s", "-o", "out", "--force"],
          "aggregate": [*GROW, "--replicate", "60", "--seed", "2", "--repeats", "3", "--rays", "40", "-o", "out", "--force"]}


def words_of(words):
    return words.split() if isinstance(words, str) else [str(w) for w in words]


def contents(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file() and not p.is_symlink()}


class Bench:
    """A folder of inputs, copied for each try."""

    def __init__(self, clast):
        self.clast = str(pathlib.Path(clast).resolve())
        self.home = tempfile.TemporaryDirectory(prefix="clast-faults-")
        self.shim = pathlib.Path(self.home.name) / "fault_files.so"
        subprocess.run([os.environ.get("CC", "cc"), "-O1", "-fPIC", "-shared", "-o", self.shim,
                        ROOT / "tests/fuzz/fault_files.c", "-ldl"], check=True)
        self.inputs = pathlib.Path(self.home.name) / "inputs"
        self.inputs.mkdir()
        data = ROOT / "data"
        for k, name in enumerate(("g.ply", "h.ply")):
            shutil.copy(data / f"standin63/grain0{k}.ply", self.inputs / name)
        for name, source in (("p.csv", "points_u3_n50.csv"), ("q.csv", "points_b3_n500.csv")):
            shutil.copy(data / "d2sd" / source, self.inputs / name)
        (self.inputs / "c.csv").write_text("size_mm,passing_%\n1,0\n2,30\n4,80\n8,100\n")
        rows = [(0.5 + 0.011 * k, 0.9 - 0.013 * ((7 * k) % 30)) for k in range(30)]
        for name, cut in (("t.csv", 30), ("t2.csv", 25)):
            (self.inputs / name).write_text("flatness,elongation,porosity\n" + "".join(
                f"{f:.6g},{e:.6g},{0.278 + 0.019 / (f * e) + 0.014 / e:.6g}\n" for f, e in rows[:cut]))
        for name, seed in (("bed", 1), ("bed2", 2)):
            done = self.run(["pack", *BED, "--seed", seed, "-o", name], self.inputs)
            if done.returncode != 0:
                sys.exit(f"fault_commands: {done.stderr}")
        self.given = contents(self.inputs)
        self.old, self.new = {}, {}

    def run(self, words, cwd, **fault):
        """The command with threads of its own, and the fault if one is given."""
        env = {**os.environ, **{f"CLAST_FAULT_{k.upper()}": str(v) for k, v in fault.items()}}
        if fault:
            env.update(LD_PRELOAD=str(self.shim), CLAST_FAULT_FOLDER=str(cwd))
        return subprocess.run([self.clast, *map(str, words), "-q", "-j", "1"], cwd=cwd, env=env, capture_output=True,
                              text=True, timeout=300, check=False)

    def place(self, base):
        """A fresh copy of a folder, under a name that no other try has."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.home.name))
        shutil.rmtree(folder)
        shutil.copytree(base, folder)
        return folder

    def prepare(self, name, old, new):
        """The folder with the old result, and the whole new one."""
        folder = self.place(self.inputs)
        done = self.run(words_of(old), folder)
        after = self.place(folder)
        again = self.run(words_of(new), after)
        if done.returncode not in (0, 1) or again.returncode not in (0, 1):
            sys.exit(f"fault_commands: {name}: {done.stderr}{again.stderr}")
        self.old[name] = folder
        self.new[name] = self.results(after)

    def results(self, folder):
        return {k: v for k, v in contents(folder).items() if k.startswith("out")}


def is_new(results, new, telling):
    """Whether the new result is whole: its names, and the bytes of the files that hold no times."""
    if set(results) != set(new):
        return False
    volatile = ("manifest.json", "summary.json", ".html")
    return all(results[k] == new[k] for k in new
               if (telling is None and not k.endswith(volatile) and "times" not in k) or (telling and k.split("/")[-1] in telling))


def fault_of(bench, name, telling, folder, done):
    """What is wrong after a failed operation, or None."""
    results = bench.results(folder)
    old = bench.results(bench.old[name])
    beside = {k: v for k, v in results.items() if k.startswith("out.new")}
    results = {k: v for k, v in results.items() if k not in beside}
    if {k: v for k, v in contents(folder).items() if not k.startswith("out") and "/.clast-" not in "/" + k} != bench.given:
        return "an input has changed"
    left = [k for k in contents(folder) if ".clast-" in k or k.endswith(".part")]
    if left:
        return f"{left[0]} is left"
    if done.returncode not in (0, 1, 4):
        return f"code {done.returncode}: {done.stderr[-300:]}"
    if done.returncode == 4 and (done.stderr.count("\n") != 1 or not done.stderr.startswith("clast ")):
        return f"not one line: {done.stderr[-300:]!r}"
    if "holds the whole run but no report.html" in done.stderr:  # told with the command that makes it
        results["out/report.html"] = bench.new[name]["out/report.html"]
    whole = is_new(results, bench.new[name], telling)
    files = [k for k in old if "/" not in k]
    mixed = files and all(results.get(k) in (old[k], bench.new[name].get(k)) for k in files)  # each file by itself
    if done.returncode != 4 and not whole:
        return "code 0 without the whole new result"
    if not whole and results != old and not mixed:
        changed = sorted(k for k in set(old) | set(results) if old.get(k) != results.get(k))
        return f"neither the old nor the new result: {changed[:4]}"
    return None


def works_again(bench, words, folder, new, telling):
    """None when the command, or the resume that it asks for, now gives the new result."""
    again = bench.run(words, folder)
    if again.returncode == 2 and "--resume out.new" in again.stderr:
        again = bench.run([words[0], "--resume", "out.new"], folder)
    results = bench.results(folder)
    if again.returncode not in (0, 1):
        return f"afterwards it does not work: {again.returncode} {again.stderr[-300:]}"
    if not is_new(results, new, telling):
        return f"afterwards other results: {sorted(k for k in set(new) | set(results) if results.get(k) != new.get(k))[:5]}"
    return None


def one_fault(bench, name, new, telling, at, mode, number):
    folder = bench.place(bench.old[name])
    try:
        done = bench.run(words_of(new), folder, at=at, mode=mode, errno=number)
        fault = fault_of(bench, name, telling, folder, done)
        if fault is None and done.returncode == 4:
            fault = works_again(bench, words_of(new), folder, bench.new[name], telling)
        return fault and f"{name}: operation {at}, {mode} {errno.errorcode[number]}: {fault}"
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def faults(bench, each, only, jobs):
    """(tries, what was wrong) over all commands, modes and operations."""
    tries, bad = 0, []
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for name, old, new, telling in CASES:
            if only and only != name:
                continue
            bench.prepare(name, old, new)
            folder, count = bench.place(bench.old[name]), pathlib.Path(bench.home.name) / "count"
            bench.run(words_of(new), folder, count=count)
            n = int(count.read_text())
            picked = range(1, n + 1) if each == 0 or n <= each else sorted({1 + i * (n - 1) // (each - 1) for i in range(each)})
            todo = [(at, mode, number) for mode, number in MODES for at in picked]
            found = [f for f in pool.map(lambda t: one_fault(bench, name, new, telling, *t), todo) if f]
            tries += len(todo)
            bad += found
            print(f"faults: {name}: {n} operations, {len(todo)} tries, {len(found)} bad", flush=True)
            for line in found[:6]:
                print("  " + line, flush=True)
    return tries, bad


def after_kill(bench, name, words, folder, which):
    """What is wrong after a kill, or None. An old run that a whole new one is about to replace is marked (.replaced)."""
    results = {f: v for f, v in bench.results(folder).items()
               if not f.startswith("out.new") and "/.clast-" not in f and f != "out/.replaced"}
    telling = ["state.h5"] if name == "pack" else ["history.csv"]
    if not is_new(results, bench.new[name], telling) and results != bench.results(bench.old[name]):
        return f"{name} {which}: neither the old nor the new result: {sorted(results)[:5]}"
    if (folder / "out.new").exists():
        done = bench.run([words[0], "--resume", "out.new"], folder)
        if done.returncode == 0 and not is_new(bench.results(folder), bench.new[name], telling):
            return f"{name} {which}: resumed, other bytes"
        if done.returncode not in (0, 2, 3):
            return f"{name} {which}: resume: {done.returncode} {done.stderr}"
    done = bench.run(words, folder)
    return None if done.returncode == 0 else f"{name} {which}: afterwards {done.returncode} {done.stderr}"


def one_kill(bench, name, words, seconds, k):
    """What is wrong after a kill at a random moment, or None."""
    folder = bench.place(bench.old[name])
    try:
        with subprocess.Popen([bench.clast, *words, "-q", "-j", "1"], cwd=folder, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as process:
            time.sleep(random.Random(k).random() * seconds)
            process.send_signal(signal.SIGKILL)
        return after_kill(bench, name, words, folder, f"at moment {k}")
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def one_kill_before(bench, name, words, at):
    """The same for a kill before operation `at`."""
    folder = bench.place(bench.old[name])
    try:
        bench.run(words, folder, at=at, mode="kill")
        return after_kill(bench, name, words, folder, f"before operation {at}")
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def kills(bench, n, jobs):
    """(tries, what was wrong) of kills of the long commands: n at random moments, and one before each operation on the disk
    (before n evenly spread ones where there are more)."""
    tries, bad = 0, []
    cases = {c[0]: c for c in CASES}
    for name, words in KILLED.items():
        words = words_of(words)
        bench.prepare(name, cases[name][1], words)
        began = time.monotonic()
        bench.run(words, bench.place(bench.old[name]))
        seconds = 1.1 * (time.monotonic() - began)
        count = pathlib.Path(bench.home.name) / "count"
        bench.run(words, bench.place(bench.old[name]), count=count, mode="kill")
        n_operation = int(count.read_text())
        each = n // len(KILLED)
        before = sorted({1 + i * (n_operation - 1) // max(1, min(each, n_operation) - 1) for i in range(min(each, n_operation))})
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            found = [f for f in pool.map(lambda k: one_kill(bench, name, words, seconds, k), range(each)) if f]
            found += [f for f in pool.map(lambda k: one_kill_before(bench, name, words, k), before) if f]
        print(f"kills: {name}: {each} within {seconds:.2f} s, {len(before)} before one of {n_operation} operations, {len(found)} bad",
              flush=True)
        for line in found[:6]:
            print("  " + line, flush=True)
        tries += each + len(before)
        bad += found
    return tries, bad


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--clast", default=str(ROOT / "build/release/clast"))
    parser.add_argument("--each", type=int, default=0)
    parser.add_argument("--kills", type=int, default=0)
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    a = parser.parse_args()
    bench = Bench(a.clast)
    tries, bad = (0, []) if a.each < 0 else faults(bench, a.each, a.only, a.jobs)
    killed, worse = kills(bench, a.kills, a.jobs) if a.kills else (0, [])
    print(f"faults: {tries} failed operations and {killed} kills, {len(bad) + len(worse)} bad")
    return 1 if bad or worse else 0


if __name__ == "__main__":
    sys.exit(main())
