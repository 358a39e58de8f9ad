#!/usr/bin/env python3
"""Whole commands on mutated inputs: no crash, no hang, no file lost, one line for what is refused.

    tests/fuzz/fuzz_commands.py --runs 1000 [--first K] [--clast build/release/clast] [--seconds S] [--jobs N]

Run k is the same on every machine: a command, its inputs and their mutations are drawn from the seed k. A run is bad
when a signal ends it, a sanitizer speaks, it takes over --limit seconds of a processor (30 times that by the clock) or
--memory bytes, its code is not one of 0 to 5 (or 143, where it drew a --time-limit), an error is not one last line, an
input has changed, or a temporary file is left. The folder of a bad run is kept under build/fuzz-commands/K with its
command line in `command`; `--first K --runs 1` repeats it.
"""
import argparse
import concurrent.futures
import hashlib
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
KEPT = ROOT / "build/fuzz-commands"
LEAKS = {"LSAN_OPTIONS": f"suppressions={ROOT}/tests/support/lsan.supp:print_suppressions=0"}
EXTREMES = ["0", "-1", "1", "2", "nan", "inf", "-inf", "1e-320", "1e-300", "1e-30", "1e-12", "1e-3", "1e3", "1e5", "1e6",
            "1e12", "1e15", "1e30", "1e200", "1e308", "-1e308", "2147483647", "-2147483648", "4294967296", "99999999999",
            "", "x", "0x10", "1e", "5mm", "1e-9m", "1e9m"]
FLOATS = [0.0, -0.0, 1.0, -1.0, float("nan"), float("inf"), 1e-45, 1e-38, 1e-30, 1e-10, 1e5, 1e6, 1e15, 3e38, -3e38]
NUMBER = re.compile(rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
WORK = ("repeats", "n-repeat", "n-permutation", "max-steps", "replicate", "max-memory")  # asks for work, and gets it


def mutate_number(random_, data):
    """One number of a text becomes an extreme one, or nearly itself."""
    found = list(NUMBER.finditer(data))
    if not found:
        return data
    at = random_.choice(found)
    new = random_.choice(EXTREMES).encode()
    if random_.random() < 0.3:
        try:
            new = repr(float(at.group()) * random_.choice([1 + 1e-15, 1e-8, -1.0, 1e4, 1e5, 1e6, 10.0])).encode()
        except ValueError:
            pass
    return data[: at.start()] + new + data[at.end() :]


def mutate_lines(random_, data):
    """Lines dropped, doubled, exchanged, or one repeated a thousand times."""
    lines = data.split(b"\n")
    i, j = random_.randrange(len(lines)), random_.randrange(len(lines))
    kind = random_.randrange(5)
    if kind == 0:
        del lines[i]
    elif kind == 1:
        lines.insert(j, lines[i])
    elif kind == 2:
        lines[i], lines[j] = lines[j], lines[i]
    elif kind == 3:
        lines[i : i + 1] = [lines[i]] * random_.choice([2, 50, 1000])
    else:
        lines = lines[:i]
    return b"\n".join(lines)


def mutate_bytes(random_, data):
    """Bits flipped, bytes set, cut, doubled or inserted."""
    data = bytearray(data)
    at = random_.randrange(len(data) + 1)
    n = random_.choice([1, 2, 4, 50, 400])
    kind = random_.randrange(5)
    if kind == 0 and at < len(data):
        data[at] ^= 1 << random_.randrange(8)
    elif kind == 1:
        data[at : at + n] = bytes(random_.randrange(256) for _ in range(n))
    elif kind == 2:
        del data[at:]
    elif kind == 3:
        data[at:at] = data[at : at + n]
    else:
        del data[at : at + n]
    return bytes(data)


def mutate_stl(random_, data):
    """Binary STL: a coordinate, a facet, or all corners of one vertex set far away."""
    data = bytearray(data)
    n = (len(data) - 84) // 50
    if n < 1:
        return bytes(data)
    facet, corner, axis = random_.randrange(n), random_.randrange(3), random_.randrange(3)
    at = 84 + 50 * facet + 12 * (corner + 1)
    kind = random_.randrange(4)
    if kind == 0:
        struct.pack_into("<f", data, at + 4 * axis, random_.choice(FLOATS))
    elif kind == 1:  # the surface stays closed
        old = bytes(data[at : at + 12])
        point = list(struct.unpack("<3f", old))
        point[axis] = max(-3e38, min(3e38, point[axis] * random_.choice([-1.0, 0.0, 2.0, 1e2, 1e4, 1e5, 1e6, 1e15])))
        new = struct.pack("<3f", *point)
        for f in range(n):
            for c in range(3):
                p = 84 + 50 * f + 12 * (c + 1)
                if data[p : p + 12] == old:
                    data[p : p + 12] = new
    elif kind == 2:
        del data[84 + 50 * facet : 84 + 50 * (facet + 1)]
        struct.pack_into("<I", data, 80, n - 1)
    else:
        data[84 + 50 * facet : 84 + 50 * (facet + 1)] = data[84 + 50 * random_.randrange(n) :][:50]
    return bytes(data)


def mutate(random_, name, data):
    kinds = [mutate_bytes]
    if b"\0" not in data[:512] or name.endswith((".csv", ".txt", ".yaml", ".obj", ".off")):
        kinds = [mutate_number] * 4 + [mutate_lines] * 2 + [mutate_bytes]
    elif name.endswith(".stl"):
        kinds = [mutate_stl] * 4 + [mutate_bytes]
    for _ in range(random_.choice([1, 1, 1, 2, 3, 8])):
        data = random_.choice(kinds)(random_, data)
    return data


def box_stl(edges):
    """A closed box as binary STL."""
    corner = [[edges[k] * (i >> k & 1) for k in range(3)] for i in range(8)]
    faces = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6),
             (1, 3, 5), (3, 7, 5)]
    facets = b"".join(struct.pack("<12fH", 0, 0, 0, *corner[a], *corner[b], *corner[c], 0) for a, b, c in faces)
    return bytes(80) + struct.pack("<I", len(faces)) + facets


class Seeds:
    """Small valid inputs by kind, made once: bundled data, and runs of the release's own commands."""

    def __init__(self, clast):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="clast-seeds-"))
        self.clast = clast
        data = ROOT / "data"
        self.make("box.stl", box_stl([1.0, 2.0, 3.0]))
        self.make("flat.stl", box_stl([1.0, 1.0, 0.01]))
        for k, out in enumerate(["a.stl", "b.obj", "c.ply", "d.off"]):
            self.run("mesh", "simplify", data / f"standin63/grain0{k}.ply", "--faces", "60", "-o", self.folder / out)
        points = (data / "d2sd/points_u3_n50.csv").read_bytes()
        self.make("points.csv", points)
        self.make("points2.csv", b"\n".join((data / "d2sd/points_b3_n500.csv").read_bytes().split(b"\n")[:200]) + b"\n")
        self.make("clump.csv", b"x,y,z,r\n0,0,0,1\n1.2,0,0,0.8\n0,1.1,0.1,0.6\n")
        self.make("spheres.csv", b"x,y,z,r\n" + b"".join(b"%d,%d,%d,0.5\n" % (i % 4, i // 4 % 4, i // 16)
                                                          for i in range(64)))
        self.make("sizes.csv", b"size_mm,count\n1,5\n2,3\n4,1\n")
        self.make("curve.csv", b"size_mm,passing_%\n1,0\n2,30\n4,80\n8,100\n")
        self.make("table.csv", b"flatness,elongation,porosity,name\n" + b"".join(
            b"%.2f,%.2f,%.3f,s%d\n" % (0.4 + 0.02 * i, 0.9 - 0.013 * i * (i % 3), 0.35 + 0.003 * i, i) for i in range(20)))
        self.make("volume.nrrd", self.volume())
        self.make("pack.yaml", b"shapes: [sphere]\ncurve: '4 mm'\nmass: 2g\nwidth: 30mm\nheight: 0.1m\nfriction: 0.4\n"
                               b"restitution: 0.3\nmax_steps: 30\nseed: 3\n")
        self.make("grow.yaml", b"core: sphere\ncore_size: 270um\ncoat: [sphere]\nsize: [30um]\nreplicate: [6]\nn_ray: 4\n"
                               b"n_orient: 2\nseed: 1\n")
        self.run("pack", "--curve", "4 mm", "--mass", "2g", "--width", "30mm", "--height", "0.1m", "--max-steps", "200",
                 "-o", self.folder / "bed")
        self.run("aggregate", "--core", "sphere", "--core-size", "270um", "--coat", "sphere", "--size", "30um",
                 "--replicate", "6", "-o", self.folder / "grown")

    @staticmethod
    def volume():
        n = 12
        cells = bytes(int((x - 5.5) ** 2 + (y - 5.5) ** 2 + (z - 5.5) ** 2 < 20)
                      for z in range(n) for y in range(n) for x in range(n))
        return b"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 12 12 12\nencoding: raw\nspacings: 1 1 1\n\n" + cells

    def make(self, name, data):
        (self.folder / name).write_bytes(data)

    def run(self, *words):
        done = subprocess.run([self.clast, *map(str, words), "-q"], capture_output=True, text=True, check=False)
        if done.returncode > 1:
            sys.exit(f"fuzz_commands: a seed cannot be made: {' '.join(map(str, words))}: {done.stderr}")


SURFACES = ["box.stl", "flat.stl", "a.stl", "b.obj", "c.ply", "d.off"]
SOLIDS = ["box.stl", "a.stl", "c.ply"]
POINTS = ["points.csv", "points2.csv"]
BOX = ["--domain", "box:0,0,0,1,1,1"]
TINY = ["--curve", "4 mm", "--mass", "2g", "--width", "30mm", "--height", "0.1m", "--max-steps", "30"]
FEW = ["--particles", "60", "--kernel", "constant", "--constant", "0.1", "--duration", "1s", "--rows", "2", "--curve", "1mm"]
# command, choices of its inputs (each mutated, or not), options
COMMANDS = [
    (["mesh", "check"], [SURFACES], []),
    (["mesh", "convert"], [SURFACES], ["-o", "out.obj"]),
    (["mesh", "repair"], [SURFACES], ["-o", "out.stl"]),
    (["mesh", "simplify"], [SURFACES], ["--faces", "20", "-o", "out.ply"]),
    (["mesh", "form"], [SURFACES], ["--flatness", "0.6", "--elongation", "0.7", "-o", "out.stl"]),
    (["shape"], [SURFACES + ["clump.csv", "volume.nrrd"]], []),
    (["shape"], [SURFACES, SURFACES], ["--statistics", "forms"]),
    (["fill"], [SOLIDS], ["--spheres", "10", "-o", "out.csv"]),
    (["fill"], [SOLIDS], ["--overlap", "--spheres", "10", "-o", "out.csv"]),
    (["aggregate", "--core-size", "270um", "--size", "90um", "--replicate", "4", "--rays", "4", "--core"],
     [SOLIDS + ["clump.csv"]], ["--coat", "sphere", "-o", "run"]),
    (["aggregate"], [["grow.yaml"]], ["-o", "run"]),
    (["pack", *TINY, "--shapes"], [SOLIDS + ["clump.csv"]], ["-o", "run"]),
    (["pack"], [["pack.yaml"]], ["--max-steps", "30", "-o", "run"]),
    (["pack", *TINY[2:], "--curve"], [["curve.csv"]], ["-o", "run"]),
    (["porosity"], [["spheres.csv"]], ["--bed", "box:-1,-1,4,4", "--floor", "0m"]),
    (["porosity"], [["bed"]], ["-o", "out"]),
    (["decompose"], [POINTS], [*BOX, "-o", "out"]),
    (["decompose"], [POINTS], ["--domain", "mesh:box.stl"]),
    (["agglomerate"], [POINTS], [*BOX, "--constant", "0.01", "-o", "out"]),
    (["evolve", *BOX, *FEW, "--shapes"], [SOLIDS], ["-o", "out"]),
    (["evolve", *BOX, *FEW[2:], "--points"], [["points.csv"]], ["--frames", "1", "-o", "out"]),
    (["grading"], [["curve.csv", "sizes.csv"]], ["--sample", "20"]),
    (["predict"], [["table.csv"]], []),
    (["fit"], [["table.csv"]], ["-o", "model"]),
    (["export"], [["bed", "grown"]], ["-o", "out.vtu"]),
    (["export"], [["bed", "grown"]], ["-o", "out.stl"]),
    (["report"], [["bed", "grown"]], ["-o", "out.html"]),
    (["render", "--width", "64", "--height", "48"], [["bed", "grown", "box.stl", "clump.csv"]], ["-o", "out.png"]),
]


def options_of(clast, command, known={}, lock=threading.Lock()):
    """The command's options that take numbers, with their units, from its own help."""
    key = " ".join(command)
    with lock:
        if key not in known:
            text = subprocess.run([clast, *command, "--help-all"], capture_output=True, text=True, check=False).stdout
            known[key] = [name for name in re.findall(r"^  --([a-z][a-z0-9-]+) ", text, re.M) if name not in WORK]
        return known[key]


def copy_input(random_, seeds, name, into, share):
    """A seed, mutated with probability `share`; of a run folder one of its files."""
    source, target = seeds.folder / name, into / name
    if target.exists():
        return target
    if source.is_dir():
        shutil.copytree(source, target)
        if random_.random() < share:
            victim = random_.choice(sorted(p for p in target.rglob("*") if p.is_file()))
            victim.write_bytes(mutate(random_, victim.name, victim.read_bytes()))
    else:
        data = source.read_bytes()
        target.write_bytes(mutate(random_, name, data) if random_.random() < share else data)
    return target


def draw(seeds, k, folder):
    """The words of run k; its inputs are written into the folder."""
    random_ = random.Random(k)
    command, inputs, options = COMMANDS[random_.randrange(len(COMMANDS))]
    words = list(command)
    share = 0.85
    for choices in inputs:
        words.append(copy_input(random_, seeds, random_.choice(choices), folder, share).name)
    words += options
    if "mesh:box.stl" in options:
        copy_input(random_, seeds, "box.stl", folder, share)
    verb = command[:2] if command[0] == "mesh" else command[:1]
    for _ in range(random_.choice([0, 0, 0, 1, 1, 2])):
        name = random_.choice(options_of(seeds.clast, verb))
        words += [f"--{name}={random_.choice(EXTREMES)}{random_.choice(['', '', 'm', 'deg', 's', 'kg'])}"]
    return words + ["-j", "1", "-q"]


def digest(folder):
    return {p.relative_to(folder): hashlib.sha256(p.read_bytes()).digest() for p in sorted(folder.rglob("*")) if p.is_file()}


def fault_of(done, error, peak, a, before, folder, has_limit):
    """What is wrong with a run, or None; `has_limit`: it was told --time-limit and may end by it."""
    if "Sanitizer" in error or "runtime error:" in error:
        return "a sanitizer speaks"
    if done is None:
        return f"no end after {a.limit:g} s"
    if not 0 <= done <= 5 and not (has_limit and done == 128 + signal.SIGTERM):
        return f"code {done}"
    if done > 1 and not error.rstrip("\n").split("\n")[-1].startswith("clast "):
        return f"code {done} without its one line"
    if peak > a.memory:
        return f"{peak / 1e9:.1f} GB of memory"
    after = digest(folder)
    for name, was in before.items():
        if after.get(name) != was:
            return f"input {name} has changed"
    left = [p for p in after if p.name.startswith(".clast-") or p.suffix in (".part", ".tmp")]
    return f"{left[0]} is left" if left else None


def run_one(seeds, k, a):
    """(k, words, fault, code) of one run."""
    with tempfile.TemporaryDirectory(prefix="clast-fuzz-") as scratch:
        folder = pathlib.Path(scratch)
        words = draw(seeds, k, folder)
        before = digest(folder)
        with open(folder.with_suffix(".err"), "w+b") as stderr:
            os.unlink(stderr.name)
            process = subprocess.Popen([a.clast, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                       stderr=stderr, env=os.environ | LEAKS)
            seconds = max(1, round(a.limit))
            resource.prlimit(process.pid, resource.RLIMIT_CPU, (seconds, seconds + 5))
            timer = threading.Timer(30 * a.limit, process.send_signal, [signal.SIGKILL])
            timer.start()
            _, state, usage = os.wait4(process.pid, 0)
            timer.cancel()
            process.returncode = 0  # taken by wait4
            stderr.seek(0)
            error = stderr.read().decode("utf-8", "replace")
        code = os.waitstatus_to_exitcode(state)
        is_late = code in (-signal.SIGXCPU, -signal.SIGKILL)
        fault = fault_of(None if is_late else code, error, 1024 * usage.ru_maxrss, a, before, folder,
                         any(word.startswith("--time-limit") for word in words))
        if fault is not None:
            kept = KEPT / str(k)
            shutil.rmtree(kept, ignore_errors=True)
            KEPT.mkdir(parents=True, exist_ok=True)
            shutil.copytree(folder, kept)
            (kept / "command").write_text(" ".join(["clast", *words]) + f"\n{fault}\n{error[-4000:]}")
        return k, words, fault, code


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0, help="seed of the first run")
    parser.add_argument("--seconds", type=float, default=1e9, help="begin no run after this time")
    parser.add_argument("--clast", default=str(ROOT / "build/release/clast"))
    parser.add_argument("--limit", type=float, default=10.0, help="seconds of a processor of one run")
    parser.add_argument("--memory", type=float, default=2e9, help="bytes of one run")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    a = parser.parse_args()
    a.clast = str(pathlib.Path(a.clast).resolve())
    seeds = Seeds(a.clast)
    began, n, codes, bad = time.monotonic(), 0, {}, []

    def run_until(k):
        return run_one(seeds, k, a) if time.monotonic() - began < a.seconds else (k, None, None, None)

    try:
        with concurrent.futures.ThreadPoolExecutor(a.jobs) as pool:
            for k, words, fault, code in pool.map(run_until, range(a.first, a.first + a.runs)):
                if words is None:
                    continue
                n += 1
                codes[code] = codes.get(code, 0) + 1
                if fault is not None:
                    bad.append(k)
                    print(f"fuzz_commands: run {k}: {fault}: clast {' '.join(words)}", flush=True)
    finally:
        shutil.rmtree(seeds.folder, ignore_errors=True)
    ends = ", ".join(f"{codes[c]} with {c}" for c in sorted(codes))
    print(f"fuzz: {n} commands in {time.monotonic() - began:.0f} s ended {ends}; {len(bad)} bad")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
