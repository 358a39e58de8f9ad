#!/usr/bin/env python3
"""A twin of the figures' engine of SCARLET-1.0 for EJ15 loose, written from the method's description alone (march, envelope by
10,000 rays, sizes, shuffling), in NumPy and with other random numbers: it shares no line with the library. It says what mean and
spread the published engine has, of which three seeds were run.

usage: tools/march_twin.py [SEEDS]     (needs numpy and scipy; about 5 s a seed)

Prints porosity and D_agg [um] of each seed, then mean, spread of one aggregate, and the chance that three seeds drawn from these
differ from their mean by as much as those three, and that they lie as near each other.
"""
import pathlib
import sys

import numpy as np
from scipy.spatial import ConvexHull

DATA = pathlib.Path(__file__).resolve().parent.parent / "data/scarlet"
COARSE, FINE = 0.01, 0.0005  # constants of the inward and the outward steps; the k-th step is k times as long
SEEDS_OF_ORIGINAL = np.array([167.0, 168.9, 167.7])  # D_agg [um]


def read_stl(path):
    raw = path.read_bytes()
    n = int.from_bytes(raw[80:84], "little")
    records = np.frombuffer(raw, dtype=np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]), count=n, offset=84)
    return records["v"].astype(float)


class Shape:
    def __init__(self, name):
        triangles = read_stl(DATA / f"stl/27sk21_shape_{name}.stl")
        spheres = np.loadtxt(DATA / f"27sk21_shape_{name}_spheres.csv", delimiter=",", skiprows=1)
        self.centre, self.radius = spheres[:, :3], spheres[:, 3]
        weight = self.radius ** 3
        self.centre = self.centre - (weight[:, None] * self.centre).sum(0) / weight.sum()
        self.volume = np.einsum("ij,ij->i", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])).sum() / 6
        self.soup = triangles.reshape(-1, 3)

    def length(self, rng):
        some = self.soup[rng.permutation(len(self.soup))[:1000]]
        return max(np.sqrt(((some - p) ** 2).sum(1).max()) for p in some)


def rotation(rng):
    phi, theta, psi = np.pi * rng.random(), np.pi * rng.random(), 2 * np.pi * rng.random()

    def about_z(a):
        return np.array([[np.cos(a), np.sin(a), 0], [-np.sin(a), np.cos(a), 0], [0, 0, 1]])

    about_x = np.array([[1, 0, 0], [0, np.cos(theta), np.sin(theta)], [0, -np.sin(theta), np.cos(theta)]])
    return about_z(psi) @ about_x @ about_z(phi)


def outermost(centre, radius, origin, direction):
    """Largest coordinate at which the line meets a sphere, or None."""
    to = centre - origin
    b = to @ direction
    c = radius ** 2 - ((to ** 2).sum(1) - b ** 2)
    return (b[c >= 0] + np.sqrt(c[c >= 0])).max() if (c >= 0).any() else None


def intersect(centre, radius, a, r):
    d = np.sqrt(((centre[:, None, :] - a[None, :, :]) ** 2).sum(2))
    return bool(((np.abs(radius[:, None] - r[None, :]) <= d) & (d <= radius[:, None] + r[None, :])).any())


def envelope(centre, radius, rng):
    c0 = (radius[:, None] ** 3 * centre).sum(0) / (radius ** 3).sum()
    u = rng.normal(size=(10000, 3))
    u /= np.linalg.norm(u, axis=1)[:, None]
    points = np.empty_like(u)
    for block in range(0, 10000, 500):
        v = u[block:block + 500]
        b = (centre - c0) @ v.T
        c = radius[:, None] ** 2 - (((centre - c0) ** 2).sum(1)[:, None] - b ** 2)
        s = np.where(c >= 0, b + np.sqrt(np.maximum(c, 0)), -np.inf).max(0)
        points[block:block + 500] = c0 + s[:, None] * v
        for k in np.flatnonzero(~np.isfinite(s)):  # a line that meets none moves to the nearest sphere
            o = centre[((centre - c0) ** 2).sum(1).argmin()]
            points[block + k] = o + outermost(centre, radius, o, v[k]) * v[k]
    return ConvexHull(points).volume


def aggregate(seed):
    rng = np.random.default_rng([seed, 2021])
    core, fine = Shape("coarse"), Shape("fine")
    sizes = np.loadtxt(DATA / "ej15_deq_um.csv", skiprows=1) * (1.2 * 2.6) ** (1 / 3)
    rng.shuffle(sizes)
    scale = 40 / core.length(rng)
    centre, radius, volume = core.centre * scale, core.radius * scale, core.volume * scale ** 3
    fine_length = fine.length(rng)
    for size in sizes:
        axis = rng.normal(size=3)
        axis /= np.linalg.norm(axis)
        # a ray in a cone of one degree about the axis
        cosine = 1 - rng.random() * (1 - np.cos(np.radians(1)))
        turn = 2 * np.pi * rng.random()
        side = np.cross(axis, [1, 0, 0] if abs(axis[0]) < 0.9 else [0, 1, 0])
        side /= np.linalg.norm(side)
        ray = cosine * axis + np.sqrt(1 - cosine ** 2) * (np.cos(turn) * side + np.sin(turn) * np.cross(axis, side))
        origin = np.zeros(3)
        far = outermost(centre, radius, origin, ray)
        if far is None:
            origin = centre[(centre ** 2).sum(1).argmin()]
            far = outermost(centre, radius, origin, ray)
        scale = size / fine_length
        body, r = scale * fine.centre @ rotation(rng).T, scale * fine.radius
        s, k = far + size, 0
        while not intersect(centre, radius, origin + s * ray + body, r) and k < 1000:
            k += 1
            s -= COARSE * size * k
        k = 0
        while intersect(centre, radius, origin + s * ray + body, r) and k < 1000:
            k += 1
            s += FINE * size * k
        centre, radius = np.vstack([centre, origin + s * ray + body]), np.concatenate([radius, r])
        volume += fine.volume * scale ** 3
    hull = envelope(centre, radius, rng)
    return 1 - volume / hull, (6 * hull / np.pi) ** (1 / 3)


def main():
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 60
    found = []
    for seed in range(n):
        found.append(aggregate(seed))
        print(f"{seed} {found[-1][0]:.4f} {found[-1][1]:.2f}", flush=True)
    found = np.array(found)
    mean, spread = found.mean(0), found.std(0, ddof=1)
    print(f"porosity {mean[0]:.4f} +- {spread[0]:.4f}, standard error {spread[0] / np.sqrt(n):.4f}")
    print(f"D_agg    {mean[1]:.2f} +- {spread[1]:.2f} um, standard error {spread[1] / np.sqrt(n):.2f}")
    three = np.random.default_rng(1).choice(found[:, 1], size=(100000, 3))
    off = abs(SEEDS_OF_ORIGINAL.mean() - mean[1])
    print(f"three seeds of these lie {off:.2f} um or more from the mean in {(abs(three.mean(1) - mean[1]) >= off).mean():.2f} of draws,"
          f" spread by no more than {SEEDS_OF_ORIGINAL.std(ddof=1):.2f} um in {(three.std(1, ddof=1) <= SEEDS_OF_ORIGINAL.std(ddof=1)).mean():.3f}")


if __name__ == "__main__":
    main()
