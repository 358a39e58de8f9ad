"""CLI: agglomerate evolves a cloud as its help says."""
import collections
import csv
import json
import math
import random
import re
import unittest

from clitest import ROOT, Case, clast

UNIFORM = ROOT / "data/d2sd/points_u3_n50.csv"
CUBE = "box:0,0,0,1,1,1"


def write(path, names, rows):
    path.write_text(",".join(names) + "\n" + "\n".join(",".join(repr(c) for c in row) for row in rows) + "\n")
    return path


def rows_of(path):
    with open(path, encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def states_of(n, rate, tau):
    """Mean number and sum of squares of n single particles that merge at rate(i, j) tau a pair: all partitions of n, by uniformisation."""
    states, flows = [(1,) * n], []
    for state in states:  # grows while it is read
        flow = {}
        for a in range(len(state)):
            for b in range(a):
                merged = tuple(sorted(state[:b] + state[b + 1:a] + state[a + 1:] + (state[a] + state[b],)))
                if merged not in states:
                    states.append(merged)
                flow[states.index(merged)] = flow.get(states.index(merged), 0) + rate(state[a], state[b])
        flows.append(flow)
    fastest = max(sum(flow.values()) for flow in flows) or 1
    chance, found, weight = [1.0] + [0.0] * (len(states) - 1), [0.0] * len(states), math.exp(-fastest * tau)
    for k in range(1, 200):
        found = [f + weight * c for f, c in zip(found, chance)]
        after = [c * (1 - sum(flow.values()) / fastest) for c, flow in zip(chance, flows)]
        for c, flow in zip(chance, flows):
            for to, speed in flow.items():
                after[to] += c * speed / fastest
        chance, weight = after, weight * fastest * tau / k
    return sum(f * len(s) for f, s in zip(found, states)), sum(f * sum(m * m for m in s) for f, s in zip(found, states))


class WithoutEffect(Case):
    def test_options_without_effect_are_refused(self):
        """Each was taken, and the numbers were those without it; --depth in 3-D was a factor on volumes that are known."""
        points = self.folder / "p.csv"
        points.write_text("x,y,z,r,G,T\n" + "".join(f"0.{k},0.{k},0.{k},1e-4,{k},300\n" for k in range(1, 9)))
        cloud = ("agglomerate", points, "--domain", CUBE)
        two = ("agglomerate", points, points, "--domain", CUBE)
        sheared = (*cloud, "--kernel", "shear_laminar", "--radius-column", "r")
        for words, option, value, says in (
                (cloud, "leap", 0.1, "without --collisions poisson"), (cloud, "rebuild", "always", "with one snapshot"),
                (cloud, "change-level", 0.2, "with one snapshot"), ((*two, "--rebuild", "never"), "change-level", 0.2, "with this --rebuild"),
                (cloud, "fixed-volume-column", "r", "without --fixed-column"), ((*sheared, "--shear-column", "G"), "shear", "3/s", "with --shear-column"),
                ((*cloud, "--kernel", "brownian", "--radius-column", "r", "--temperature-column", "T"), "temperature", "400K", "with --temperature-column"),
                ((*sheared, "--shear", "3/s"), "monomer-radius", "1mm", "with a column of radii"),
                (("agglomerate", "--box-model", "--concentration", "2"), "leap", 0.1, "without --collisions poisson")):
            with self.subTest(option):
                self.assert_fails(2, *words, f"--{option}", value, says=(f"--{option} does nothing {says}",))
        self.assert_fails(2, *cloud, "--self-collisions", says=("--self-collisions does nothing without --weight-column",))
        self.assert_fails(2, *cloud, "--depth", "2m", says=("--depth is the extent of dimensions that are missing: the domain has all 3",))


class Agglomerate(Case):
    def test_constant_kernel_follows_the_exact_death_process(self):
        """E N of the finite cloud: dN/dt = -K/2V E[N (N - 1)]; 50 particles, solved state by state."""
        rate, n0, runs = 0.02, 50, 300
        r = clast("agglomerate", UNIFORM, "--domain", CUBE, "--constant", rate, "--duration", "2", "--n-step", "2",
                  "--repeats", runs, "--json").json
        chance, dt = [0.0] * (n0 + 1), 1e-3
        chance[n0] = 1.0
        for _ in range(2000):
            flow = [0.5 * rate * n * (n - 1) * p * dt for n, p in enumerate(chance)]
            chance = [p - flow[n] + (flow[n + 1] if n < n0 else 0.0) for n, p in enumerate(chance)]
        mean = sum(n * p for n, p in enumerate(chance))
        sd = r["n_particle_sd"][-1]
        self.assertAlmostEqual(r["n_particle"][-1], mean, delta=4 * sd / math.sqrt(runs) + 2e-3 * mean)
        self.assertEqual(r["time"], [0.0, 1.0, 2.0])
        self.assertEqual(r["moments"]["M1"], [50.0] * 3)
        self.assertEqual(r["moments"]["M0"], r["n_particle"])
        self.assertAlmostEqual(r["events"][-1], n0 - r["n_particle"][-1], places=9)
        self.assertAlmostEqual(r["exact"]["n_particle"][-1], mean, delta=1e-3 * mean)  # it was that of infinitely many, 25

    def test_a_seed_beyond_the_integers_of_json_is_told_as_it_is(self):
        """The largest was -1 in --json and summary.json."""
        cloud = (UNIFORM, "--domain", CUBE, "-o", self.folder / "out", "--force", "--json", "--seed")
        for words in (("agglomerate", "--constant", "0.01"), ("decompose", "--sizes", 2)):
            for seed, told in ((2 ** 64 - 1, str(2 ** 64 - 1)), (2 ** 63 - 1, 2 ** 63 - 1)):
                done = clast(*words, *cloud, seed)
                self.assertEqual((done.code, done.json["seed"]), (0, told), done.err)

    def test_exact_numbers_are_those_of_so_many_particles(self):
        """One particle stays one (it was 0.995), two are 1 + exp(-t): against the chance of every state of the cloud, solved as a Markov chain."""
        rates = {"constant": lambda i, j: 1, "additive": lambda i, j: i + j, "product": lambda i, j: i * j}
        for kernel, rate in rates.items():
            for n in (1, 2, 6):
                with self.subTest(kernel, n=n):
                    points = self.folder / f"{n}.csv"
                    points.write_text("x,y,z\n" + "".join(f"0.{k + 1},0.{9 - k},0.5\n" for k in range(n)))
                    r = clast("agglomerate", points, "--domain", CUBE, "--kernel", kernel, f"--{kernel}", "0.02", "--alpha", "0.5", "--duration",
                              "20", "--n-step", "2", "--json").json
                    for row, time in enumerate(r["time"]):
                        number, square = states_of(n, rate, 0.5 * 0.02 * time)
                        self.assertAlmostEqual(r["exact"]["n_particle"][row], number, places=11)
                        self.assertAlmostEqual(r["exact"]["M2"][row], square, places=10)
        two = clast("agglomerate", self.folder / "2.csv", "--domain", CUBE, "--constant", "0.01", "--json").json
        self.assertAlmostEqual(two["exact"]["n_particle"][-1], 1 + math.exp(-0.01), places=12)

    def test_folder_holds_tables_summary_and_charts(self):
        r = clast("agglomerate", UNIFORM, "--domain", CUBE, "--constant", "0.02", "--fixed", "2", "-o",
                  self.folder / "run", "--json")
        self.assertEqual(r.code, 0, r.err)
        for name in ("moments.svg", "number.svg"):
            self.assertIn("<svg", (self.folder / "run" / name).read_text())
        self.assertEqual(json.loads((self.folder / "run/summary.json").read_text()), {k: v for k, v in r.json.items() if k != "wall_s"})
        particles, members = (rows_of(self.folder / f"run/{name}.csv") for name in ("particles", "members"))
        sizes = collections.Counter(row["aggregate"] for row in members)
        self.assertEqual([row["particle"] for row in members], list(range(50)))
        self.assertEqual({row["particle"]: row["monomers"] for row in particles}, sizes)
        self.assertEqual(len(sizes), r.json["n_particle"][-1])
        self.assertEqual(len(r.json["fixed"]["events"]), 11)

    def test_particles_that_are_left_go_on(self):
        """Merged ones were rows of 0 monomers, radius and weight at the place of their aggregate: decompose and evolve refused them, and a run
        without a column of monomers began with all 50."""
        run, again = self.folder / "run", self.folder / "again"
        r = clast("agglomerate", UNIFORM, "--domain", CUBE, "--constant", "0.5", "--n-step", "2", "-o", run, "--json").json
        left = int(r["n_particle"][-1])
        self.assertLess(left, 25)
        self.assertEqual(len(rows_of(run / "particles.csv")), left)
        self.assertEqual(clast("decompose", run / "particles.csv", "--domain", CUBE, "--json").json["n"], left)
        command = ("agglomerate", run / "particles.csv", "--domain", CUBE, "--constant", "0.5", "--n-step", "2", "--json")
        self.assertEqual(clast(*command).json["n_particle"][0], left)
        on = clast(*command, "--monomers-column", "monomers", "-o", again).json
        self.assertEqual([on["moments"][key][0] for key in ("M0", "M1", "M2", "M3")], [r["moments"][key][-1] for key in ("M0", "M1", "M2", "M3")])
        self.assertEqual(sum(row["monomers"] for row in rows_of(again / "particles.csv")), 50)

    def test_particles_that_are_left_bring_all_that_a_kernel_needs(self):
        rng = random.Random(1)
        file = write(self.folder / "p.csv", ["x", "y", "z", "u", "v", "w", "n"],
                     [[rng.random() for _ in range(6)] + [rng.randrange(1, 4)] for _ in range(60)])
        ballistic = ("--domain", CUBE, "--kernel", "ballistic", "--n-step", "1", "--json")
        r = clast("agglomerate", file, *ballistic, "--monomer-radius", "10cm", "--particle-density", "2650", "--velocity-columns", "u,v,w",
                  "--weight-column", "n", "-o", self.folder / "run")
        self.assertEqual(r.code, 0, r.err)
        self.assertEqual(clast("report", self.folder / "run").code, 0)
        page = (self.folder / "run/report.html").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r"<(?:th|h4|summary)[^>]*><code>([^<]*)", page), [])  # each column has words
        file = self.folder / "run/particles.csv"
        table = rows_of(file)
        self.assertEqual(list(table[0]), ["particle", "x_m", "y_m", "z_m", "monomers", "radius_m", "diameter_m", "mass_kg", "cell", "weight",
                                          "velocity_x_m/s", "velocity_y_m/s", "velocity_z_m/s"])
        self.assertLess(len(table), 60)
        for row in table:
            self.assertEqual(row["diameter_m"], 2 * row["radius_m"])
            self.assertGreater(min(row["radius_m"], row["weight"], row["mass_kg"], row["monomers"]), 0)
        on = clast("agglomerate", file, *ballistic, "--radius-column", "radius_m", "--mass-column", "mass_kg", "--weight-column", "weight",
                   "--monomers-column", "monomers", "--velocity-columns", "velocity_x_m/s,velocity_y_m/s,velocity_z_m/s")
        self.assertEqual(on.code, 0, on.err)
        self.assertAlmostEqual(on.json["moments"]["M1"][0], r.json["moments"]["M1"][-1], places=9)
        momentum = sum(row["weight"] * row["mass_kg"] * row["velocity_x_m/s"] for row in table)
        mass = 2650 * 4 / 3 * math.pi * 0.1**3
        self.assertAlmostEqual(momentum / mass, sum(row["n"] * row["u"] for row in rows_of(self.folder / "p.csv")), places=9)

    def test_model_rates_have_units(self):
        """constant: 1e6 mm^3/s of a file for evolve was an unknown unit here."""
        command = ("agglomerate", UNIFORM, "--domain", CUBE, "--json")
        for kernel, value in (("constant", 0.02), ("additive", 0.01), ("product", 0.003)):
            ask = (*command, "--kernel", kernel, f"--{kernel}")
            bare = clast(*ask, value)
            for text in (f"{value}m^3/s", f"{1e6 * value} cm^3/s"):
                r = clast(*ask, text)
                self.assertEqual(r.code, 0, r.err)
                self.assertEqual(r.json["n_particle"], bare.json["n_particle"])
            self.assertEqual(clast(*ask, f"{value}m^2/s").err,
                             f"clast agglomerate: {kernel}: is in m^2/s, in 3 dimensions it is in m^3/s\n")
            self.assert_fails(2, *ask, f"{value}m^3", says=[f"{kernel}: unknown unit 'm^3'", "m^3/s"])
        flat = ("agglomerate", ROOT / "data/d2sd/points_s2_n500.csv", "--domain", "box:0,0,1,1", "--constant")
        self.assertEqual(clast(*flat, "1e-4m^2/s").code, 0)
        self.assertEqual(clast(*flat, "1e-4m^3/s", "--depth", "1m").code, 0)
        self.assert_fails(2, *flat, "1e-4m^2/s", "--depth", "1m", says=["in m^2/s, in 3 dimensions"])
        box = ("agglomerate", "--box-model", "--concentration", "1e12/m^3", "--n-step", 2, "--constant")
        self.assertEqual(clast(*box, "1e-6cm^3/s").out, clast(*box, "1e-12").out)
        self.assert_fails(2, *box, "1e-6cm^2/s", says=["in m^2/s, in 3 dimensions"])

    def test_the_diameter_of_a_fractal_is_that_of_its_solid(self):
        """It was that of the collisions: evolve, which takes diameters of equal volume, read 13 times the mass."""
        for law in ("fractal-collision", "fractal-gyration"):
            run, on = self.folder / law, self.folder / f"{law}-on"
            r = clast("agglomerate", UNIFORM, "--domain", CUBE, "--constant", "0.5", "--radius-law", law, "--monomer-radius", "1um",
                      "--particle-density", "2000kg/m^3", "-o", run)
            self.assertEqual(r.code, 0, r.err)
            table = rows_of(run / "particles.csv")
            self.assertGreater(max(row["radius_m"] / row["diameter_m"] for row in table), 1)
            for row in table:
                self.assertAlmostEqual(row["mass_kg"], 2000 * math.pi / 6 * row["diameter_m"] ** 3, delta=1e-12 * row["mass_kg"])
            r = clast("evolve", "--points", run / "particles.csv", "--diameter-column", "diameter_m", "--density", "2000kg/m^3", "--domain", CUBE,
                      "--kernel", "constant", "--constant", 0, "--duration", "1ms", "--rows", 1, "-o", on)
            self.assertEqual((r.code, r.err), (0, ""))
            mass = sum(row["mass_kg"] for row in table)
            self.assertAlmostEqual(float((on / "balance.csv").read_text().splitlines()[1].split(",")[6]), mass, delta=1e-9 * mass)

    def test_parcels_that_come_apart_have_no_members_and_no_exact_numbers(self):
        """members.csv gave each parcel itself alone; the process of 800 particles was called exact for 8 parcels of 100."""
        rng, kernel = random.Random(1), ("--domain", CUBE, "--constant", 0.02, "--json", "--weight-column", "w")
        for weights, options, is_known, is_exact in (((1,), (), True, True), ((2,), (), True, False), ((2,), ("--self-collisions",), False, False),
                                                     ((1, 3), (), False, False)):
            rows, run = [[rng.random() for _ in range(3)] + [weights[k % len(weights)]] for k in range(20)], self.folder / "run"
            r = clast("agglomerate", write(self.folder / "p.csv", ["x", "y", "z", "w"], rows), *kernel, *options, "--force", "-o", run)
            self.assertEqual(r.code, 0, r.err)
            self.assertEqual(((run / "members.csv").exists(), "exact" in r.json), (is_known, is_exact), (weights, options))

    def test_parcels_that_are_left_go_on(self):
        """They came to lie on one another: 2000 at 578 places, a second run gave half of what should be left, and evolve refused the file."""
        rng, run, exact = random.Random(1), self.folder / "run", 1 / (1 / 5600 + 0.003)
        parcels = [[rng.random() for _ in range(3)] + [math.exp(rng.gauss(0, 1.5))] for _ in range(2000)]
        file = write(self.folder / "p.csv", ["x", "y", "z", "w"], [p[:3] + [p[3] * 5600 / sum(q[3] for q in parcels)] for p in parcels])
        kernel = ("--domain", CUBE, "--constant", 0.003, "--json", "--weight-column")
        self.assertEqual(clast("agglomerate", file, *kernel, "w", "-o", run).code, 0)
        table = rows_of(run / "particles.csv")
        self.assertEqual(len({(row["x_m"], row["y_m"], row["z_m"]) for row in table}), len(table))
        halves = [clast("agglomerate", run / "particles.csv", *kernel, "weight", "--monomers-column", "monomers", "--seed", s) for s in (1, 2, 3)]
        whole = [clast("agglomerate", file, *kernel, "w", "--duration", "2s", "--seed", s) for s in (1, 2, 3)]
        for r in halves + whole:
            self.assertAlmostEqual(r.json["n_particle"][-1], exact, delta=0.12 * exact)

    def test_cells_of_parcels_are_made_anew_as_their_particles_go(self):
        """Rows were counted, which stay while weights shrink: 400 were left where the density says 346, in the cells of the start."""
        rng, rows, n0, sd = random.Random(3), [], 3500.0, 0.1
        while len(rows) < 3000:
            x = [rng.gauss(0.5, sd) for _ in range(3)]
            if 0 < min(x) and max(x) < 1:
                rows.append(x + [math.exp(rng.gauss(0, 0.5))])
        scale, rate, step = n0 / sum(row[3] for row in rows), 6.5e-4, 1e-3
        file = write(self.folder / "p.csv", ["x", "y", "z", "w"], [row[:3] + [scale * row[3]] for row in rows])
        density = [(r, n0 / (2 * math.pi * sd * sd) ** 1.5 * math.exp(-r * r / (2 * sd * sd))) for r in (step * k for k in range(1, 800))]
        exact = sum(4 * math.pi * r * r * step * n / (1 + rate * n / 2) for r, n in density)
        r = clast("agglomerate", file, "--domain", CUBE, "--constant", rate, "--weight-column", "w", "--n-step", 20, "--json").json
        self.assertGreater(r["n_rebuilt"], 2)
        self.assertAlmostEqual(r["n_particle"][-1], exact, delta=0.14 * exact)

    def test_a_number_of_monomers_beyond_what_is_counted_names_the_limit(self):
        file = write(self.folder / "p.csv", ["x", "y", "z", "m"], [[0.1, 0.2, 0.3, 1], [0.4, 0.5, 0.6, 1e19]])
        self.assert_fails(3, "agglomerate", file, "--domain", CUBE, "--constant", 1, "--monomers-column", "m",
                          says=("particle 2 is 1e+19; it must be a whole number > 0 and below 2^52",))

    def test_pairs_that_cells_hide_collide_too(self):
        """A plume of 1000 points, whose cells miss a tenth of the pairs: as many more collisions as decompose adds events."""
        rng, rows = random.Random(6), []
        while len(rows) < 1000:
            z = rng.random()
            p = [rng.gauss(0.5, math.sqrt(2e-4 + 0.004 * z)), rng.gauss(0.5, math.sqrt(2e-4 + 0.004 * z)), z]
            if 0 <= min(p) and max(p) <= 1:
                rows.append(p)
        file = write(self.folder / "plume.csv", ["x", "y", "z"], rows)
        bias = clast("decompose", file, "--domain", CUBE, "--beta-dt", "1e-9", "--json").json["smoothing_bias"]
        self.assertLess(bias, -0.07)
        mean, error = [], []
        for options in ((), ("--no-extrapolate",)):
            r = clast("agglomerate", file, "--domain", CUBE, "--constant", "1e-6", "--duration", "1", "--n-step", "1", "--repeats", "150",
                      "--tests", "pearson", "--json", *options).json
            mean.append(r["events"][-1])
            error.append(r["n_particle_sd"][-1] / math.sqrt(150) / r["events"][-1])
        self.assertAlmostEqual(mean[0] / mean[1], 1 / (1 + bias), delta=4 * math.hypot(*error))
        self.assertLess(4 * math.hypot(*error), -0.7 * bias)

    def test_same_seed_gives_the_same_run_for_any_thread_count(self):
        runs = []
        for threads, seed in (("1", 3), ("4", 3), ("1", 4)):
            r = clast("agglomerate", UNIFORM, "--domain", CUBE, "--constant", "0.02", "-j", threads, "--seed", seed,
                      "--json").json
            del r["wall_s"]
            runs.append(r)
        self.assertEqual(runs[0], runs[1])
        self.assertNotEqual(runs[0], runs[2])

    def test_cells_take_the_mean_of_field_columns(self):
        """Two cells of a mesh by column; shear acts where it is, and nowhere else."""
        random.seed(2)
        rows = []
        for i in range(400):
            left = i % 2 == 0
            x = 0.5 * random.random() + (0.0 if left else 0.5)
            rows.append([x, random.random(), random.random(), 1e-2, 30.0 if left else 1e-9, 0 if left else 1, 0.5])
        file = write(self.folder / "p.csv", ["x", "y", "z", "r", "G", "cell", "volume"], rows)
        r = clast("agglomerate", file, "--domain", CUBE, "--kernel", "shear_laminar", "--radius-column", "r",
                  "--shear-column", "G", "--fixed-column", "cell", "--fixed-volume-column", "volume", "--duration", "10",
                  "--out-of-range", "extrapolate", "--json", "-o", self.folder / "run")
        self.assertEqual(r.code, 0, r.err)
        self.assertGreater(r.json["fixed"]["events"][-1], 20)
        self.assertGreaterEqual(r.json["fixed"]["n_particle"][-1], 200)

    def test_cells_of_particles_that_do_not_show_their_structure_are_told(self):
        even = [[(i % 40 + 0.5) / 40, (i // 40 + 0.5) / 40] for i in range(1600)]
        random.seed(7)
        drawn = [[random.random(), random.random()] for _ in range(1600)]
        for name, points, times in (("even", even, 1), ("drawn", drawn, 0)):
            file = write(self.folder / f"{name}.csv", ["x", "y"], points)
            options = (file, "--domain", "box:0,0,1,1", "--constant", "1e-6")
            self.assertEqual(clast("agglomerate", *options, "--json").json["n_unresolved"], times)
            said = "warning: in 1 of 1 snapshot the particles did not show their own structure"
            self.assertEqual(said in clast("agglomerate", *options).out, times == 1)

    def test_snapshots_move_particles_and_renew_cells_when_they_must(self):
        random.seed(5)
        here = [[random.random() for _ in range(2)] for _ in range(600)]
        near = [[min(1.0, x + 1e-4) for x in p] for p in here]
        far = [[0.3 * x for x in p] for p in here]
        files = [write(self.folder / f"{k}.csv", ["x", "y"], p) for k, p in enumerate((here, near, far))]
        r = clast("agglomerate", *files, "--domain", "box:0,0,1,1", "--constant", "1e-5", "--n-step", "2", "--json").json
        self.assertEqual(r["time"], [0, 0.5, 1, 1.5, 2, 2.5, 3])  # the last snapshot has its time too
        self.assertEqual(r["n_snapshot"], 3)
        said = clast("agglomerate", *files, "--domain", "box:0,0,1,1", "--constant", "1e-5", "--n-step", "2")
        self.assertIn("kernel constant, 3 snapshots, 1 s in each, 1 run", said.out)
        self.assertIn("three take three times it", " ".join(clast("agglomerate", "--help-all").out.split()))
        self.assertEqual(r["n_rebuilt"], 1)
        self.assertEqual(r["n_cell"][:5], [1] * 5)
        self.assertGreater(r["n_cell"][-1], 1)
        always = clast("agglomerate", *files, "--domain", "box:0,0,1,1", "--constant", "1e-5", "--rebuild", "always",
                       "--json").json
        self.assertEqual(always["n_rebuilt"], 2)
        short = write(self.folder / "short.csv", ["x", "y"], here[:5])
        self.assert_fails(3, "agglomerate", files[0], short, "--domain", "box:0,0,1,1", says=["snapshot 2 has 5"])

    def test_fewer_cells_than_before(self):
        """Particles that had merged kept the numbers of cells that were gone: "particle 58 lies in cell 321 of 1"."""
        random.seed(4)
        blob = [[0.3 + 0.3 * random.random() for _ in range(2)] for _ in range(400)]
        even = [[random.random() for _ in range(2)] for _ in range(400)]
        files = [write(self.folder / f"{k}.csv", ["x", "y"], p) for k, p in enumerate((blob, even))]
        r = clast("agglomerate", *files, "--domain", "box:0,0,1,1", "--constant", "2e-4", "--json")
        self.assertEqual(r.code, 0, r.err)
        self.assertGreater(r.json["n_cell"][10], 1)
        self.assertEqual(r.json["n_cell"][-1], 1)

    def test_a_cloud_with_sharp_edges_goes_on_to_the_end(self):
        """A fifth is left of a cube of even concentration: 0.87 of the events were drawn, as in cells where each was soon alone."""
        n, side, shares = 2000, 0.31, []
        for seed in range(4):
            random.seed(seed)
            low = [random.uniform(0, 1 - side) for _ in range(3)]
            file = write(self.folder / "cube.csv", ["x", "y", "z"], [[a + side * random.random() for a in low] for _ in range(n)])
            run = (file, "--domain", CUBE, "--constant", 2 * side ** 3 / n, "--duration", "4", "--n-step", "40", "--json")
            r = clast("agglomerate", *run).json
            self.assertGreater(r["n_rebuilt"], 0)
            shares.append((n - r["n_particle"][-1]) / (n - n / 5))
            if seed == 0:  # of one snapshot `never` has its sense, `always` has none
                self.assertGreater(clast("agglomerate", *run, "--rebuild", "never").json["n_particle"][-1], r["n_particle"][-1])
                self.assert_fails(2, "agglomerate", *run, "--rebuild", "always", says=("rebuild does nothing with one snapshot",))
        self.assertAlmostEqual(sum(shares) / 4, 1, delta=0.06)

    def test_what_is_left_lies_as_even_as_what_was_there(self):
        """Mass centres drew the survivors of a cell together: cells made anew took that for density, 278 left where 1771 are right."""
        draw = random.Random(7)
        points = [(draw.random() / 2 + (0.5 if k % 4 == 0 else 0.0), draw.random(), draw.random()) for k in range(12000)]
        path = write(self.folder / "two.csv", ("x", "y", "z"), points)
        right = sum(n / (1 + 0.002 * n) for n in (9000, 3000))  # 0.001 m^3/s for 2 s in halves of 0.5 m^3
        for steps in (8, 40):
            found = clast("agglomerate", path, "--domain", CUBE, "--constant", 0.001, "--duration", "2s", "--n-step", steps,
                          "-o", self.folder / f"run{steps}", "--json").json
            self.assertAlmostEqual(found["n_particle"][-1] / right, 1.0, delta=0.2)
            left = rows_of(self.folder / f"run{steps}/particles.csv")
            spread = math.sqrt(sum((row["y_m"] - 0.5) ** 2 for row in left) / len(left))
            self.assertAlmostEqual(spread / math.sqrt(1 / 12), 1.0, delta=4 / math.sqrt(len(left)))

    def test_each_snapshot_has_its_flow(self):
        """Temperature, shear, dissipation and turbulent velocity of the first snapshot held for all."""
        random.seed(5)
        places = [[random.random() * 1e-4 for _ in range(3)] for _ in range(300)]
        cold, hot = (write(self.folder / f"{t}.csv", ["x", "y", "z", "r", "T_K"], [[*p, 1e-6, t] for p in places]) for t in (300.0, 900.0))
        run = ("--domain", "box:0,0,0,100um,100um,100um", "--radius-column", "r", "--kernel", "brownian", "--temperature-column", "T_K",
               "--duration", "10", "--n-step", "1", "--repeats", "20", "--json")
        same, warmer = (clast("agglomerate", cold, later, *run).json["events"] for later in (cold, hot))
        self.assertEqual(same[1], warmer[1])
        self.assertAlmostEqual((warmer[2] - warmer[1]) / (same[2] - same[1]), 3, delta=0.6)
        bare = write(self.folder / "bare.csv", ["x", "y", "z", "r"], [[*p, 1e-6] for p in places])
        self.assert_fails(3, "agglomerate", cold, bare, *run, says=("bare.csv", "T_K"))
        bad = write(self.folder / "bad.csv", ["x", "y", "z", "r", "T_K"], [[*p, 1e-6, -1.0] for p in places])
        self.assert_fails(3, "agglomerate", cold, bad, *run, says=("the temperature of particle 1 in snapshot 2 is -1",))

    def test_particles_that_fill_the_domain_are_told(self):
        """Radii of 0.2 mm in a cube of 1 mm, 17 times its volume, ran without a word."""
        random.seed(6)
        for radius, share in ((2e-4, 16.755), (2e-6, 1.6755e-5)):
            file = write(self.folder / "p.csv", ["x", "y", "z", "r"], [[*(1e-3 * random.random() for _ in range(3)), radius] for _ in range(500)])
            r = clast("agglomerate", file, "--domain", "box:0,0,0,1mm,1mm,1mm", "--radius-column", "r", "--constant", "1e-15", "--json")
            self.assertAlmostEqual(r.json["volume_fraction"] / share, 1, delta=1e-3)
            self.assertEqual("warning: the particles fill 1.68e+03 % of the volume" in r.err, share > 1, r.err)

        for concentration, share in (("1e18", 33.51), ("1e12", 3.351e-5)):
            r = clast("agglomerate", "--box-model", "--concentration", concentration, "--kernel", "brownian", "--temperature", "300", "--viscosity", "1e-3",
                      "--monomer-radius", "2um", "--duration", "1e-9", "--particles", "1000", "--out-of-range", "extrapolate", "--json")
            self.assertAlmostEqual(r.json["volume_fraction"] / share, 1, delta=1e-3)
            self.assertEqual("warning: the particles fill 3.35e+03 % of the volume" in r.err, share > 1, r.err)

    def test_physical_kernels_name_what_is_missing(self):
        wanted = [(["--kernel", "brown"], "'brown'"), (["--kernel", "brownian"], "radius column or --monomer-radius"),
                  (["--kernel", "shear_laminar", "--monomer-radius", "1um"], "needs a shear > 0"),
                  (["--kernel", "settling", "--monomer-radius", "1um"], "mass column or --particle-density"),
                  (["--kernel", "ballistic", "--monomer-radius", "1um"], "velocity columns"),
                  (["--radius-law", "fractal"], "volume|fractal-collision|fractal-gyration"),
                  (["--radius-law", "fractal-gyration"], "fractal radii need --monomer-radius")]
        for options, words in wanted:
            self.assert_fails(2, "agglomerate", UNIFORM, "--domain", CUBE, *options, says=[words])
        self.assert_fails(2, "agglomerate", ROOT / "data/d2sd/points_u2_n50.csv", "--domain", "box:0,0,1,1", "--kernel",
                          "brownian", "--monomer-radius", "1um", says=["2 dimensions", "--depth"])
        self.assert_fails(3, "agglomerate", UNIFORM, "--domain", CUBE, "--radius-column", "r", says=["'r'"])
        bad = write(self.folder / "bad.csv", ["x", "y", "z", "r"], [[0.5, 0.5, 0.5, 1e-6], [0.1, 0.1, 0.1, -1e-6]])
        self.assert_fails(3, "agglomerate", bad, "--domain", CUBE, "--radius-column", "r", says=["particle 2", "-1e-06"])
        half = write(self.folder / "half.csv", ["x", "y", "z", "m"], [[0.5, 0.5, 0.5, 1.5]])
        self.assert_fails(3, "agglomerate", half, "--domain", CUBE, "--monomers-column", "m", says=["particle 1", "whole"])


if __name__ == "__main__":
    unittest.main()
