"""CLI: hostile clouds end in an answer or in one line, for decompose and agglomerate."""
import random
import unittest

from clitest import Case, clast

CUBE = "box:0,0,0,1,1,1"


class BadClouds(Case):
    def write(self, name, rows, header="x,y,z"):
        path = self.folder / name
        path.write_text(header + "\n" + "".join(",".join(map(repr, row)) + "\n" for row in rows))
        return path

    def test_degenerate_clouds_have_answers(self):
        random.seed(1)
        clouds = {"one": [[0.5, 0.5, 0.5]], "four": [[0.1 * k, 0.2, 0.3] for k in range(4)],
                  "equal": [[0.5, 0.25, 0.75]] * 60, "faces": [[float(random.randrange(2)) for _ in range(3)] for _ in range(80)],
                  "line": [[t, t, t] for t in (random.random() for _ in range(120))],
                  "plane": [[random.random(), random.random(), 0.5] for _ in range(120)]}
        for name, rows in clouds.items():
            path = self.write(name + ".csv", rows)
            for mesh in ("boxes", "components", "bins", "labels", "tree"):
                r = clast("decompose", path, "--domain", CUBE, "--mesh", mesh, "--json")
                self.assertEqual(r.code, 0, f"{name} {mesh}: {r.err}")
                self.assertEqual(r.json["n"], len(rows))
                if name in ("equal", "faces"):  # repeated points: words
                    self.assertIsNone(r.json["pair_integral"])
                else:
                    self.assertGreaterEqual(r.json["pair_integral"], 0.0)
                if len(rows) < 5:
                    self.assertEqual((r.json["tests"], r.json["n_cell"]), ([], 1))
            command = ("agglomerate", path, "--domain", CUBE, "--constant", "1e9", "--n-step", "1", "--json")
            if name in ("equal", "faces"):
                self.assert_fails(3, *command, says=[path.name, "snapshot 1: no number of events: so many points are duplicates (coincident points)"])
                continue
            r = clast(*command)
            self.assertEqual(r.code, 0, f"{name}: {r.err}")
            self.assertEqual(r.json["moments"]["M1"][-1], len(rows))

    def test_repeated_points_have_words_in_the_place_of_a_number(self):
        path = self.write("corners.csv", [[(0.1, 0.9)[k >> j & 1] for j in range(3)] for k in range(8)] * 10)
        for more in ((), ("--beta-dt", "1e-6")):
            r = clast("decompose", path, "--domain", "box:0,0,0,1,1,1", "--json", *more).json
            self.assertEqual((r["pair_integral"], r["pair_integral_low"], r["events"], r["resolved"]), (None, None, None, False))
            words = clast("decompose", path, "--domain", "box:0,0,0,1,1,1", *more).out
            self.assertIn("so many points are duplicates (coincident points), where no density is defined", words)
            self.assertNotIn("nan", words)

    def test_points_at_one_place_have_no_number_with_beta_dt_either(self):
        # without beta dt there was none; with it "events 150 [133.951, -]", a bound that "holds (97.5 %)"
        path = self.write("one_place.csv", [[0.5, 0.5, 0.5]] * 300)
        words = []
        for more in ((), ("--beta-dt", "1e-6")):
            r = clast("decompose", path, "--domain", CUBE, "--json", *more).json
            keys = [what + end for what in ("events", "pair_integral") for end in ("", "_low", "_high")] + ["n_capped", "smoothing_bias"]
            self.assertEqual({key: r[key] for key in keys}, dict.fromkeys(keys))
            self.assertFalse(r["resolved"])
            words.append(clast("decompose", path, "--domain", CUBE, *more).out.replace("number of events", "pair integral"))
        self.assertIn("no pair integral: so many points are duplicates (coincident points)", words[0])
        self.assertEqual(words[0], words[1])

    def test_copies_do_not_agglomerate(self):
        # each of 1000 points twice: copies got cells of their own, 1666 events where all 2000 in one cell have 20
        points = [[rng.random() for _ in range(3)] for rng in [random.Random(3)] for _ in range(1000)]
        command = ("--domain", CUBE, "--constant", "1e-5", "--n-step", "1", "--json")
        words = "no number of events: so many points are duplicates (coincident points), where no density is defined; leave copies out"
        once, twice = self.write("once.csv", points), self.write("twice.csv", [p for p in points for _ in range(2)])
        self.assertIn(words, clast("decompose", twice, "--domain", CUBE, "--beta-dt", "1e-5").out)
        self.assert_fails(3, "agglomerate", twice, *command, "-o", self.folder / "none", says=["twice.csv", f"snapshot 1: {words}"])
        self.assertFalse((self.folder / "none").exists())
        self.assertLess(clast("agglomerate", once, *command).json["events"][-1], 20)
        other = self.write("other.csv", [[rng.random() for _ in range(3)] for rng in [random.Random(4)] for _ in range(2000)])
        self.assert_fails(3, "agglomerate", other, twice, *command, "--rebuild", "always", says=[f"snapshot 2: {words}"])
        nine = self.write("nine.csv", [p for p in points[:200] for _ in range(9)])  # was "the points keep apart", and a lower bound
        self.assertIn(words, clast("decompose", nine, "--domain", CUBE, "--beta-dt", "1e-5").out)
        few = self.write("few.csv", points + points[:1])
        r = clast("agglomerate", few, *command)
        self.assertEqual((r.code, r.json["n_repeated"]), (0, 1))
        said = clast("agglomerate", few, *command[:-1]).out
        self.assertIn("warning: 1 particle is a duplicate (coincident points); each such pair counts as two particles that meet", said)
        self.assertNotIn("too few", said)

    def test_aggregates_may_meet_at_one_place(self):
        # centres of mass of a lattice's points are places of others
        lattice = self.write("lattice.csv", [[(i + 0.5) / 6, (j + 0.5) / 6] for i in range(6) for j in range(6)], "x,y")
        r = clast("agglomerate", lattice, "--domain", "box:0,0,1,1", "--constant", "1", "--duration", "1s", "--n-step", "50", "--json")
        self.assertEqual(r.code, 0, r.err)
        self.assertEqual((r.json["n_particle"][-1] < 4, r.json["moments"]["M1"][-1]), (True, 36))

    def test_long_boxes_score_like_cubes(self):
        random.seed(2)
        near = [[random.random() for _ in range(3)] for _ in range(200)]
        far = self.write("far.csv", [[1e9 * p[0], p[1], p[2]] for p in near])
        a = clast("decompose", self.write("near.csv", near), "--domain", CUBE, "--json").json
        b = clast("decompose", far, "--domain", "box:0,0,0,1e9,1,1", "--json").json
        self.assertEqual([t["reject"] for t in a["tests"]], [t["reject"] for t in b["tests"]])
        self.assertAlmostEqual(b["pair_integral"] * 1e9, a["pair_integral"], delta=1e-6 * a["pair_integral"])

    def test_values_that_cannot_be_are_named(self):
        for word in ("nan", "inf", "-inf"):
            path = self.folder / "bad.csv"
            path.write_text(f"x,y,z\n0.1,0.2,0.3\n0.1,{word},0.3\n")
            self.assert_fails(3, "decompose", path, "--domain", CUBE, says=["point 2", "not finite"])
            self.assert_fails(3, "agglomerate", path, "--domain", CUBE, says=["particle 2", "not finite in snapshot 1"])
            good = self.write("good.csv", [[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]])
            for rebuild in ("changed", "always", "never"):
                self.assert_fails(3, "agglomerate", good, path, "--domain", CUBE, "--rebuild", rebuild,
                                  says=["particle 2", "coordinate that is not finite in snapshot 2"])
            path.write_text(f"x,y,z,u,v,w\n0.1,0.2,0.3,{word},0,0\n")
            self.assert_fails(3, "agglomerate", path, "--domain", CUBE, "--velocity-columns", "u,v,w",
                              says=["particle 1", "velocity that is not finite"])
        path = self.folder / "hot.csv"
        path.write_text("x,y,z,T\n0.1,0.2,0.3,inf\n")
        self.assert_fails(3, "decompose", path, "--domain", CUBE, "--variable-column", "T", says=["variable of point 1"])
        path = self.write("weights.csv", [[0.5, 0.5, 0.5, -2.0]], "x,y,z,w")
        self.assert_fails(3, "decompose", path, "--domain", CUBE, "--weight-column", "w", says=["weight of point 1", "-2"])
        self.assert_fails(3, "agglomerate", path, "--domain", CUBE, "--weight-column", "w", says=["weight of particle 1", "-2"])
        small = self.write("r.csv", [[0.5, 0.5, 0.5, -1e-6]], "x,y,z,r")
        for command in ("decompose", "agglomerate"):
            self.assert_fails(3, command, small, "--domain", CUBE, "--radius-column", "r", says=["the radius of", "-1e-06"])
        words = self.folder / "words.csv"
        words.write_text("x,y,z\n0.1,abc,0.3\n")
        self.assert_fails(3, "decompose", words, "--domain", CUBE, says=["column 'y' is no column of numbers", "row 1 holds 'abc'"])
        for kernel in ("brownian", "shear_laminar", "settling", "inertial", "ballistic", "cloud_turbulence"):
            self.assert_fails(2, "agglomerate", path, "--domain", CUBE, "--kernel", kernel, "-o", self.folder / "none",
                              says=[f"kernel {kernel} needs radii"])
        self.assertFalse((self.folder / "none").exists())
        self.assert_fails(3, "decompose", path, "--domain", CUBE, "--columns", "x,y,w,z,x", says=["more than three"])
        self.assert_fails(2, "decompose", path, "--domain", CUBE, "--radius-column", "x", "--diameter-column", "y",
                          says=["not both"])

    def test_rows_of_several_times_are_no_cloud(self):
        """A history of 10 times was one cloud, of which particles met themselves: 113 times the events, "the lower bound alone holds"."""
        rng = random.Random(5)
        rows = [[rng.random() for _ in range(3)] for _ in range(60)]
        ask = ("--domain", CUBE)
        for name in ("time", "TIME", "Time (s)", "time_ms", "t", "T [s]", "t_s", "step", "TimeStep", "time_step", "iteration", "frame"):
            path = self.write("hist.csv", [[k % 3] + p for k, p in enumerate(rows)], f"{name},x,y,z")
            for command in (("decompose",), ("agglomerate", "--constant", "1e-9")):
                self.assert_fails(3, command[0], path, *ask, *command[1:], says=[f"hist.csv: column '{name}' holds 3 times", "give the rows of one time"])
        self.assert_fails(3, "evolve", "--points", path, *ask, says=["points: ", "column 'frame' holds 3 times"])
        many = self.write("many.csv", [[k, *rows[k % 60]] for k in range(1200)], "step,x,y,z")
        self.assert_fails(3, "decompose", many, *ask, says=["holds at least 1000 times"])
        for name, options in (("T", ()), ("T_C", ()), ("t_m", ()), ("timer", ()), ("time_constant", ()), ("time", ("--variable-column", "time"))):
            path = self.write("one.csv", [[k % 3] + p for k, p in enumerate(rows)], f"{name},x,y,z")
            self.assertEqual(clast("decompose", path, *ask, *options).code, 0, name)
        one = self.write("one.csv", [[0.5] + p for p in rows], "time,x,y,z")
        self.assertEqual(clast("decompose", one, *ask).code, 0)
        bodies = self.write("deposit.csv", [[k, k % 7] + p for k, p in enumerate(rows)], "node,time_s,x_m,y_m,z_m")
        self.assertEqual(clast("decompose", bodies, *ask).code, 0)

    def test_weights_that_no_option_names_are_told(self):
        """2000 parcels of weight 1000 gave a millionth of their events, with an interval and "resolved"."""
        rng = random.Random(6)
        rows = [[rng.random() for _ in range(3)] for _ in range(60)]
        line = "column '{0}' is not looked at: each row is one particle (--weight-column {0})"
        steps = ("agglomerate", "--constant", "1e-9")
        for name in ("weight", "stat_weight", "Statistical_Weight", "parcel_weight", "n_real", "multiplicity"):
            path = self.write("parcels.csv", [p + [1000] for p in rows], f"x,y,z,{name}")
            for command in (("decompose",), steps):
                r = clast(command[0], path, "--domain", CUBE, *command[1:])
                self.assertEqual((r.code, r.err.count(line.format(name)), r.err.count("\n")), (0, 1, 1), r.err)
                self.assertNotIn("not looked at", clast(command[0], path, "--domain", CUBE, "--weight-column", name, *command[1:]).err)
        ones = self.write("ones.csv", [p + [1, 1] for p in rows], "x,y,z,weight,monomers")
        self.assertEqual(clast("decompose", ones, "--domain", CUBE).err, "")
        left = self.write("particles.csv", [[k, *p, 1 + k % 3, 0, 1] for k, p in enumerate(rows)], "particle,x_m,y_m,z_m,monomers,cell,weight")
        line = "column 'monomers' is not looked at: each particle is one monomer (--monomers-column monomers)"
        self.assertIn(line, clast(steps[0], left, "--domain", CUBE, *steps[1:]).err)
        for options in ((*steps, "--monomers-column", "monomers"), ("decompose",)):
            self.assertEqual(clast(options[0], left, "--domain", CUBE, *options[1:]).err, "")
        self.assertEqual(clast(steps[0], ones, "--domain", CUBE, *steps[1:]).err, "")
        bodies = ("evolve", "--domain", CUBE, "--curve", "1um", "--kernel", "constant", "--constant", "0", "--duration", "1ms", "--rows", 1,
                  "--no-structure", "--points")  # said nothing
        parcels = self.write("parcels.csv", [p + [1000] for p in rows], "x,y,z,n_real")
        line = "clast evolve: warning: points: column 'n_real' is not looked at: each row is one particle (--weight: of all alike)\n"
        self.assertEqual(clast(*bodies, parcels).err, line)
        self.assertEqual(clast(*bodies, ones).err, "")
        for name in ("diameter_m", "Diameter (um)", "radius_mm", "volume_diameter_m"):  # bodies of 10 um, the curve's, said nothing
            sized = self.write("sized.csv", [[1e-9, *p] for p in rows], f"{name},x,y,z")
            line = f"points: column '{name}' is not looked at: sizes are those of the curve (--diameter-column: of diameters)\n"
            self.assertEqual(clast(*bodies, sized).err, f"clast evolve: warning: {line}")
        bodies = [word for word in bodies if word not in ("--curve", "1um")]
        self.assertEqual(clast(*bodies, sized, "--diameter-column", "volume_diameter_m").err, "")
        frames = self.folder / "two.xyz"
        frames.write_text(2 * (f"{len(rows)}\n\n" + "".join("A {} {} {}\n".format(*p) for p in rows)))
        self.assertEqual(clast(*bodies, frames).err, "clast evolve: warning: points: the first snapshot of 2 (--frame -1: the last)\n")

    def test_files_of_other_codes_say_so(self):
        """particles.geo was "not a text: byte 8 is 0", a positions file "has FoamFile (texts)"."""
        foam = "/*---------------------------------*- C++ -*----*/\nFoamFile\n{\n    version 2.0;\n    class Cloud<passiveParticle>;\n}\n(\n(0.1 0.2 0.3) 5\n)\n"
        for name, content, code in (("positions", foam.encode(), "OpenFOAM"), ("particles.case", b"FORMAT\ntype: ensight gold\n\nGEOMETRY\n", "EnSight"),
                                    ("particles.geo", b"C Binary".ljust(80, b"\0") + b"EnSight Geo".ljust(80, b"\0"), "EnSight")):
            path = self.folder / name
            path.write_bytes(content)
            self.assert_fails(3, "decompose", path, "--domain", CUBE, says=[f"{name} is a file of {code}, which is not read", ".csv"])


if __name__ == "__main__":
    unittest.main()
