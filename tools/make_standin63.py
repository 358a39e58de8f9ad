#!/usr/bin/env python3
"""Makes data/standin63: 63 convex grains that stand in for the unpublished Rhine gravel of Rettinger et al. 2022.

    tools/make_standin63.py FOLDER_OF_COEFFICIENTS OUT [CLAST]

FOLDER_OF_COEFFICIENTS holds the 49 stones of FDOT No. 57 as spherical harmonics (jwbullard/TSQUARE, examples/SHcoeffs/FDOT-57, MIT)
and their table fdot57-geom-A-to-H.dat. Each stone is sampled, its convex hull taken at 300 faces, and stretched along its principal
axes (`clast mesh form`), so that the 63 have the published means and deviations of flatness and elongation. See OUT/README.md.
Standard library only; takes about a minute.
"""
import csv
import json
import math
import operator
import pathlib
import statistics
import subprocess
import sys
import tempfile

N_POINT, N_GRAIN, N_FACE = 2500, 63, 300
# Rettinger et al. 2022, table 2 (first row) and section 2.3: means, deviations and correlation of FL and EL
WANTED = {"flatness": (0.647, 0.175), "elongation": (0.682, 0.139)}
WANTED_CORRELATION = -0.089
LOW, HIGH = 0.1, 1.0  # the paper's limits of both


def directions(n):
    """Unit directions on a golden spiral, evenly spread."""
    for k in range(n):
        z = 1 - (2 * k + 1) / n
        yield math.acos(z), math.pi * (1 + math.sqrt(5)) * k


def legendre(n_max, theta):
    """Associated Legendre functions, orthonormal with e^(i m phi) on the sphere, with the Condon-Shortley phase."""
    c, s = math.cos(theta), math.sin(theta)
    p = {(0, 0): math.sqrt(1 / (4 * math.pi))}
    for m in range(n_max + 1):
        if m > 0:
            p[m, m] = -math.sqrt((2 * m + 1) / (2 * m)) * s * p[m - 1, m - 1]
        for n in range(m + 1, n_max + 1):
            a = math.sqrt((4 * n * n - 1) / (n * n - m * m))
            b = math.sqrt(((n - 1) ** 2 - m * m) / (4 * (n - 1) ** 2 - 1))
            p[n, m] = a * (c * p[n - 1, m] - b * p.get((n - 2, m), 0.0))
    return p


def basis(n_max):
    """For each direction: the direction, and Re and Im of Y_nm, m >= 0, in order of n and m."""
    for theta, phi in directions(N_POINT):
        p = legendre(n_max, theta)
        row = []
        for n in range(n_max + 1):
            for m in range(n + 1):
                row += [p[n, m] * math.cos(m * phi), p[n, m] * math.sin(m * phi)]
        yield (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)), row


def read_stone(path, n_max, n_used):
    """Factors of the basis rows: r is real, so a(n,-m) = (-1)^m conj(a(n,m)) and m < 0 doubles m > 0."""
    a = {}
    for line in path.read_text(encoding="ascii").splitlines():
        n, m, re, im = line.split()
        a[int(n), int(m)] = (float(re), float(im))
    row = []
    for n in range(n_max + 1):
        for m in range(n + 1):
            re, im = a[n, m] if n <= n_used else (0.0, 0.0)
            twice = 1 if m == 0 else 2
            row += [twice * re, -twice * im]
    return row


def read_stones(folder):
    """Name and points of each stone, orders up to the table's Nnn only."""
    table = folder / "fdot57-geom-A-to-H.dat"
    rows = [line.split() for line in table.read_text(encoding="ascii").splitlines()]
    used = {row[0]: int(row[rows[0].index("Nnn")]) for row in rows[1:]}
    n_max = max(used.values())
    factors = {name: read_stone(folder / name, n_max, n) for name, n in used.items()}
    points = {name: [] for name in used}
    for direction, row in basis(n_max):
        for name, factor in factors.items():
            r = sum(map(operator.mul, factor, row))
            points[name].append([r * x for x in direction])
    return points


def write_points(path, points, mirrored):
    sign = -1 if mirrored else 1
    lines = [f"{sign * x!r} {y!r} {z!r}" for x, y, z in points]
    path.write_text(f"OFF\n{len(points)} 0 0\n" + "\n".join(lines) + "\n", encoding="ascii")


def form(clast, source, out, *options):
    done = subprocess.run([clast, "mesh", "form", source, "--hull", str(N_FACE), "-o", out, "--json", *options],
                          check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def normal_scores(mean, deviation, n):
    """n values with exactly this mean and (n-1) deviation: quantiles of a normal law cut to LOW .. HIGH."""
    law = statistics.NormalDist()

    def quantiles(mu, sigma):
        low, high = law.cdf((LOW - mu) / sigma), law.cdf((HIGH - mu) / sigma)
        return [mu + sigma * law.inv_cdf(low + (i + 0.5) / n * (high - low)) for i in range(n)]

    mu, sigma = mean, deviation
    for _ in range(200):
        values = quantiles(mu, sigma)
        mu += mean - statistics.fmean(values)
        sigma *= deviation / statistics.stdev(values)
    return quantiles(mu, sigma)


def ranks(values):
    order = sorted(range(len(values)), key=values.__getitem__)
    rank = [0] * len(values)
    for k, i in enumerate(order):
        rank[i] = k
    return rank


def assign(grains, own, targets):
    """Wanted flatness and elongation of each grain by rank: the flattest stone takes the flattest form, and so on."""
    return [[values[r] for r in ranks([own[name][k] for name, _ in grains])] for k, values in enumerate(targets)]


def choose(own):
    """All stones and the mirror images of 14; which ones, by swaps that bring the correlation to the paper's."""
    names = sorted(own)
    targets = [normal_scores(*WANTED[key], N_GRAIN) for key in WANTED]

    def attempt(twins):
        grains = [(name, False) for name in names] + [(name, True) for name in sorted(twins)]
        wanted = assign(grains, own, targets)
        return abs(statistics.correlation(*wanted) - WANTED_CORRELATION), grains, wanted

    twins = set(names[: N_GRAIN - len(names)])
    best = attempt(twins)
    for _ in range(10):
        for out in sorted(twins):
            for new in names:
                if new not in twins and best[0] > 5e-4:
                    tried = attempt(twins - {out} | {new})
                    if tried[0] < best[0]:
                        best, twins, out = tried, twins - {out} | {new}, new
    return best[1], best[2]


def measure_stones(clast, stones, scratch):
    own = {}
    for name, points in stones.items():
        write_points(scratch / "points.off", points, False)
        before = form(clast, scratch / "points.off", scratch / "hull.ply")["before"]
        own[name] = (before["flatness"], before["elongation"])
    return own


def make_grains(clast, stones, own, scratch, out):
    grains, wanted = choose(own)
    rows = []
    for k, ((name, mirrored), flatness, elongation) in enumerate(zip(grains, *wanted)):
        file = f"grain{k:02d}.ply"
        write_points(scratch / "points.off", stones[name], mirrored)
        done = form(clast, scratch / "points.off", out / file, "--flatness", repr(flatness), "--elongation",
                    repr(elongation), "--size", "1")
        rows.append({"file": file, "stone": name.removesuffix(".dat"), "mirrored": int(mirrored),
                     "own_flatness": own[name][0], "own_elongation": own[name][1], **done["after"],
                     "volume": done["volume"], "n_triangle": done["n_triangle"]})
    return rows


def tell(rows):
    sets = {key: [row[key] for row in rows] for key in ("flatness", "elongation", "volume", "n_triangle")}
    for key, values in sets.items():
        print(f"{key}: mean {statistics.fmean(values):.6f}, deviation {statistics.stdev(values):.6f}, "
              f"{min(values):.4f} to {max(values):.4f}")
    print(f"correlation of flatness and elongation {statistics.correlation(sets['flatness'], sets['elongation']):.4f}")
    for key, (mean, deviation) in WANTED.items():
        assert abs(statistics.fmean(sets[key]) - mean) < 1e-3 and abs(statistics.stdev(sets[key]) - deviation) < 1e-3, key


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    folder, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    clast = sys.argv[3] if len(sys.argv) > 3 else "build/release/clast"
    out.mkdir(parents=True, exist_ok=True)
    stones = read_stones(folder)
    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)
        own = measure_stones(clast, stones, scratch)
        rows = make_grains(clast, stones, own, scratch, out)
    with open(out / "grains.csv", "w", newline="", encoding="ascii") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    tell(rows)


if __name__ == "__main__":
    main()
