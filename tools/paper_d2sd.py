#!/usr/bin/env python3
"""D2SD beside the paper and the reference: size and power of the tests, bins and passes of the frame, errors of events.

    CLAST=build/release/clast tools/paper_d2sd.py [--samples 2000] [--power 400] [-o docs/validation/d2sd.md]

Every number comes from `clast decompose --json`. Standard library alone; seeds are fixed.
"""
import argparse
import json
import math
import os
import pathlib
import random
import subprocess
import tempfile

CLAST = os.environ.get("CLAST", "build/release/clast")
TESTS = ("symmetric", "centred", "star", "henze_zirkler", "pearson")


def box(d):
    return "box:" + ",".join(["0"] * d + ["1"] * d)


def decompose(points, folder, *options):
    path = pathlib.Path(folder) / "points.csv"
    path.write_text("xyz"[0] + "".join("," + c for c in "xyz"[1:len(points[0])]) + "\n"
                    + "\n".join(",".join(f"{c:.12g}" for c in p) for p in points) + "\n")
    done = subprocess.run([CLAST, "decompose", path, "--domain", box(len(points[0])), "--json", "-j", "1", *options],
                          capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def uniform(rng, n, d):
    return [[rng.random() for _ in range(d)] for _ in range(n)]


def blob(rng, centre, sd, d):
    while True:
        p = [rng.gauss(centre, sd) for _ in range(d)]
        if all(0 <= c <= 1 for c in p):
            return p


def frame(rng, n, _=2):
    out = []
    while len(out) < n:
        p = [rng.random(), rng.random()]
        if min(p[0], p[1], 1 - p[0], 1 - p[1]) <= 0.2:
            out.append(p)
    return out


def rates(make, samples, folder, rng):
    """Share of samples that each test, the vote of 2 and of 3 reject."""
    count = dict.fromkeys(TESTS + ("two", "three"), 0)
    for _ in range(samples):
        r = decompose(make(rng), folder, "--test-only")
        hits = [t["name"] for t in r["tests"] if t["reject"]]
        for name in hits:
            count[name] += 1
        count["two"] += len(hits) >= 2
        count["three"] += len(hits) >= 3
    return {name: c / samples for name, c in count.items()}


def table_size(samples, folder):
    lines = [f"## Size at 5 % ({samples} uniform samples; two standard errors {2 * math.sqrt(.0475 / samples):.3f})", "",
             "| n | d | " + " | ".join(TESTS) + " | 2 of 5 |", "| --- |" + " --- |" * 7]
    worst = 0.0
    for n in (50, 500):
        for d in (2, 3):
            r = rates(lambda g, n=n, d=d: uniform(g, n, d), samples, folder, random.Random(100 * n + d))
            worst = max(worst, max(abs(r[t] - 0.05) for t in TESTS))
            lines.append(f"| {n} | {d} | " + " | ".join(f"{r[t]:.3f}" for t in TESTS) + f" | {r['two']:.3f} |")
    return lines + ["", f"Wanted: 0.05 +- 0.015 for each test. Largest deviation {worst:.3f}.", ""]


def table_power(samples, folder):
    def two_blobs(g):
        return [blob(g, *((.35, .05) if g.random() < .5 else (.65, .08)), 2) if g.random() < .15
                else [g.random(), g.random()] for _ in range(500)]
    cases = [("15 % in two blobs", two_blobs, (.96, .71, .12, .98, .23, .96, .78)),
             ("frame w = .2", lambda g: frame(g, 500), (1, 1, .82, 1, .05, 1, 1)),
             ("density ~ x^0.2", lambda g: [[g.random() ** (1 / 1.2), g.random()] for _ in range(500)],
              (.24, .07, .60, .06, .04, .24, .04)),
             ("Beta(1.3, 1.3)^2", lambda g: [[g.betavariate(1.3, 1.3) for _ in range(2)] for _ in range(500)],
              (1, 1, .24, .04, .07, 1, .34))]
    lines = [f"## Power at 5 %, d = 2, n = 500 ({samples} samples; the reference's value in brackets)", "",
             "| alternative | " + " | ".join(TESTS) + " | 2 of 5 | 3 of 5 |", "| --- |" + " --- |" * 7]
    for name, make, reference in cases:
        r = rates(make, samples, folder, random.Random(7))
        cells = [f"{r[t]:.2f} ({v:g})" for t, v in zip(TESTS + ("two", "three"), reference)]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return lines + ["", "The reference's blobs have other centres (the paper prints none), so the first row agrees roughly only. Star",
                    "differs from the reference by 0.04 to 0.10 in three rows (standard error here 0.025, of the reference unknown);",
                    "the statistic itself equals the reference's on every shared sample to 1e-12. This stands open.", ""]


def table_frame(folder):
    printed = {500: ("5x5", 1), 1000: ("7x7", 2), 1500: ("8x8", 2), 2000: ("9x9", 1), 2500: ("9x9", 1), 3000: ("10x10", 1),
               3500: ("11x11", 2), 4000: ("11x11", 3), 4500: ("12x12", 2), 5000: ("12x12", 2)}
    lines = ["## Frame of width 0.2 (Table 5): 6 samples a row", "",
             "| n | bins here | bins printed | passes here (mean) | passes printed |", "| --- | --- | --- | --- | --- |"]
    same = 0
    for n, (bins, passes) in printed.items():
        rng, found, n_pass = random.Random(n), [], []
        for _ in range(6):
            r = decompose(frame(rng, n), folder)
            found.append("x".join(map(str, r["passes"][0]["bins"])) if r["passes"] else "none")
            n_pass.append(len(r["passes"]))
        common = max(set(found), key=found.count)
        same += common == bins
        lines.append(f"| {n} | {common} ({found.count(common)} of 6) | {bins} | {sum(n_pass) / 6:.1f} | {passes} |")
    return lines + ["", f"The commonest bins equal the printed ones for {same} of 10 n.", ""]


def table_uniform(folder):
    reference = {(10, "full"): 0, (100, "full"): 0, (1000, "full"): 0, (10000, "full"): .0021,
                 (10, "fast"): .36, (100, "fast"): .17, (1000, "fast"): .079, (10000, "fast"): .042}
    lines = ["## Uniform square (section 4.2.1): mean relative error of events by n^2 / V, 20 samples", "",
             "| n | variant | here | reference | fast, n (n - 1), bins here |", "| --- | --- | --- | --- | --- |"]
    for n in (10, 100, 1000, 10000):
        for variant in ("full", "fast"):
            rng, error, pairs = random.Random(n), [], []
            for _ in range(20):
                points = uniform(rng, n, 2)
                r = decompose(points, folder, "--variant", variant, "--events", "paper", "--beta-dt", "1e-9")
                error.append(abs(r["events"] / (1e-9 * n * n) - 1))
                if variant == "fast":
                    r = decompose(points, folder, "--variant", "fast", "--mesh", "bins", "--beta-dt", "1e-9")
                    pairs.append(abs(r["events"] / (.5e-9 * n * (n - 1)) - 1))
            last = f"{sum(pairs) / 20:.2g}" if pairs else "-"
            lines.append(f"| {n} | {variant} | {sum(error) / 20:.2g} | {reference[n, variant]:g} | {last} |")
    return lines + [""]


def table_cubes(folder):
    lines = ["## Cubes: relative error of events, default against the printed estimate", "",
             "| cloud | n | default (boxes, full) | tree | fast, n^2 / V as printed |", "| --- | --- | --- | --- | --- |"]
    sd, share = 0.06, 0.3
    mass = math.erf(0.5 / sd / math.sqrt(2)) ** 3
    dense = (math.erf(0.5 / sd) / (2 * sd * math.sqrt(math.pi))) ** 3 / mass ** 2
    truth = (1 - share) ** 2 + 2 * share * (1 - share) + share ** 2 * dense
    for name, make, integral in (("uniform", lambda g, n: uniform(g, n, 3), 1.0),
                                 ("30 % in a blob of sd 0.06", lambda g, n: [blob(g, .5, sd, 3) if g.random() < share
                                                                             else [g.random() for _ in range(3)]
                                                                             for _ in range(n)], truth)):
        for n in (1000, 10000, 100000):
            rng, cells = random.Random(n), []
            points = make(rng, n)
            for options in ((), ("--mesh", "tree"), ("--variant", "fast", "--events", "paper")):
                r = decompose(points, folder, "--beta-dt", "1e-15", *options)
                scale = 1e-15 * n * n if "paper" in options else .5e-15 * n * (n - 1)
                cells.append(f"{r['events'] / scale / integral - 1:+.4f}")
            lines.append(f"| {name} | {n} | " + " | ".join(cells) + " |")
    return lines + ["", "One sample each; the blob's own sampling error at 1e5 points is about 1 %. Below 2 % on uniform clouds by default;",
                    "on the blob at 1e5 points the tree is, joined boxes are not: they keep the noise of one point a bin, which the",
                    "command warns of.", ""]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--samples", type=int, default=2000)
    parser.add_argument("--power", type=int, default=400)
    parser.add_argument("-o", "--output", default="docs/validation/d2sd.md")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        lines = ["# D2SD: paper and reference beside ours", "",
                 "Made by `tools/paper_d2sd.py` (deviations are shown as they are; nothing was tuned). Reference: the prototype",
                 "whose numbers the specification lists. Paper: Martinez Rodriguez et al. 2021.", ""]
        lines += table_frame(folder) + table_uniform(folder) + table_cubes(folder)
        lines += table_size(args.samples, folder) + table_power(args.power, folder)
    pathlib.Path(args.output).write_text("\n".join(lines))


if __name__ == "__main__":
    main()
