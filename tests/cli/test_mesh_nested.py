"""CLI: parts that lie in others: cavities and islands count once; a part in a solid, wound outward, would count twice."""
import math
import unittest

from clitest import ROOT, Case, clast

FACETS = ((0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3))


def boxes(path, *given):
    """OFF of cubes (edge, low corner, sign): wound outward with 1, inward with -1."""
    vertices = [(x, y, z) for edge, low, _ in given for x in (low, low + edge) for y in (low, low + edge) for z in (low, low + edge)]
    facets = [[8 * k + i for i in facet[::sign]] for k, (_, _, sign) in enumerate(given) for facet in FACETS]
    lines = [f"OFF\n{len(vertices)} {len(facets)} 0", *("{} {} {}".format(*v) for v in vertices), *("3 {} {} {}".format(*f) for f in facets)]
    path.write_text("\n".join(lines) + "\n")
    return path


def sphere(path, *given, n=24):
    """OFF of spheres (radius, sign) about the origin, n by 2n quadrangles cut in two."""
    vertices, facets = [], []
    for radius, sign in given:
        first = len(vertices)
        vertices += [(0, 0, radius)] + [(radius * math.sin(math.pi * i / n) * math.cos(math.pi * k / n),
                                         radius * math.sin(math.pi * i / n) * math.sin(math.pi * k / n), radius * math.cos(math.pi * i / n))
                                        for i in range(1, n) for k in range(2 * n)] + [(0, 0, -radius)]

        def at(i, k):
            return first + (0 if i == 0 else 1 + (n - 1) * 2 * n if i == n else 1 + (i - 1) * 2 * n + k % (2 * n))
        for i in range(n):
            for k in range(2 * n):
                facets += [t[::sign] for t in ((at(i, k), at(i + 1, k), at(i + 1, k + 1)), (at(i, k), at(i + 1, k + 1), at(i, k + 1)))
                           if len(set(t)) == 3]
    lines = [f"OFF\n{len(vertices)} {len(facets)} 0", *("{} {} {}".format(*v) for v in vertices), *("3 {} {} {}".format(*f) for f in facets)]
    path.write_text("\n".join(lines) + "\n")


def lenses(path, *lows, n=5000):
    """OFF of bipyramids of n sectors, from these heights up: the boxes of a quarter of their triangles meet."""
    vertices, facets = [], []
    for low in lows:
        first = len(vertices)
        vertices += [(math.cos(2 * math.pi * k / n), math.sin(2 * math.pi * k / n), low) for k in range(n)] + [(0, 0, low + 1), (0, 0, low - 1)]
        for k in range(n):
            here, after = first + k, first + (k + 1) % n
            facets += [(here, after, first + n), (after, here, first + n + 1)]
    lines = [f"OFF\n{len(vertices)} {len(facets)} 0", *("{} {} {}".format(*v) for v in vertices), *("3 {} {} {}".format(*f) for f in facets)]
    path.write_text("\n".join(lines) + "\n")
    return path


class Nested(Case):
    def setUp(self):
        super().setUp()
        self.doubled = boxes(self.folder / "doubled.off", (4, 0, 1), (2, 1, 1))
        self.cavity = boxes(self.folder / "cavity.off", (4, 0, 1), (2, 1, -1))
        self.island = boxes(self.folder / "island.off", (6, 0, 1), (4, 1, -1), (2, 2, 1))
        self.overlap = boxes(self.folder / "overlap.off", (2, 0, 1), (2, 1, 1))

    def checked(self, path):
        found = clast("mesh", "check", path, "--json").json
        return found["n_nested"], found["n_doubled"], {fault["code"]: fault["text"] for fault in found["faults"]}

    def test_an_island_in_a_cavity_counts_once(self):
        """It was said to count twice, as every outward part inside another; volume 216 - 64 + 8."""
        nested, doubled, faults = self.checked(self.island)
        self.assertEqual((nested, doubled, list(faults)), (2, 0, ["nested_parts"]))
        self.assertIn("1 wound inward (cavities), 1 outward in a cavity (islands)", faults["nested_parts"])
        self.assertEqual([part["winding"] for part in clast("mesh", "check", self.island, "--json").json["parts"]], [1, 0, 1])

    def test_a_part_that_counts_twice_is_told_with_its_cure(self):
        nested, doubled, faults = self.checked(self.doubled)
        self.assertEqual((nested, doubled, list(faults)), (1, 1, ["doubled_parts"]))
        self.assertIn("1 of 2 parts counts twice", faults["doubled_parts"])
        self.assertIn("`clast mesh repair` drops", faults["doubled_parts"])
        thrice = boxes(self.folder / "thrice.off", (6, 0, 1), (4, 1, 1), (2, 2, 1))
        self.assertEqual(self.checked(thrice)[:2], (2, 2))
        hollow = boxes(self.folder / "hollow.off", (6, 0, 1), (4, 1, -1), (2, 2, -1))
        self.assertEqual(self.checked(hollow)[:2], (2, 1))
        turned = boxes(self.folder / "turned.off", (4, 0, -1), (2, 1, 1))  # a cavity once it is turned over
        self.assertEqual(self.checked(turned)[1], 0)
        self.assertIn("1 wound inward (cavities), 0 outward", self.checked(turned)[2]["nested_parts"])
        self.assertEqual(self.checked(self.cavity)[:2], (1, 0))

    def test_repair_drops_what_bounds_nothing(self):
        out = self.folder / "out.off"
        for parts, volume, n_dropped in ((((4, 0, 1), (2, 1, 1)), 64, 1), (((6, 0, 1), (4, 1, 1), (2, 2, 1)), 216, 2),
                                         (((6, 0, 1), (4, 1, -1), (2, 2, -1)), 152, 1), (((6, 0, 1), (4, 1, 1), (2, 2, -1)), 216, 2),
                                         (((4, 0, 1), (4, 0, 1)), 64, 1), (((4, 0, 1), (2, 1, -1)), 56, 0), (((6, 0, 1), (4, 1, -1), (2, 2, 1)), 160, 0)):
            path = boxes(self.folder / "in.off", *parts)
            done = clast("mesh", "repair", path, "-o", out, "--json")
            self.assertEqual((done.code, done.json["volume"], done.json["changes"]["n_part_dropped"]), (0, volume, n_dropped), parts)
        words = clast("mesh", "repair", self.doubled, "-o", out).out
        self.assertIn("1 parts dropped that bound nothing", words)
        self.assertNotIn("nothing had to be changed", words)
        kept = clast("mesh", "repair", self.doubled, "--no-unite", "-o", out, "--json")
        self.assertEqual((kept.code, kept.json["volume"], kept.json["changes"]["n_part_dropped"]), (0, 72, 0))

    def test_the_largest_body_has_its_own_cavities_alone(self):
        """A hollow island left its cavity in the cavity (424 for 488); a thin shell won over the solid in it, as a ball of walls over a solid one."""
        out = self.folder / "out.off"
        for parts, volume in ((((10, 0, 1), (8, 1, -1), (6, 2, 1), (4, 3, -1)), 488), (((10, 0, 1), (9.8, 0.1, -1), (8, 1, 1)), 512),
                              (((5, 0, 1), (4.5, 0.25, -1), (4, 9, 1)), 64)):
            done = clast("mesh", "repair", boxes(self.folder / "in.off", *parts), "--keep", "largest", "-o", out, "--json")
            self.assertAlmostEqual(done.json["volume"], volume, places=9)
            self.assertEqual(done.code, 0)

    def test_a_body_that_its_cavity_takes_all_of_is_no_solid(self):
        """A cube and the same inside out: volume 0, "a solid"; an island that fills its cavity had a wall of area 12 around it."""
        both, out = boxes(self.folder / "both.off", (2, 0, 1), (2, 0, -1)), self.folder / "out.off"
        found = clast("mesh", "check", both, "--json")
        self.assertEqual((found.code, [one["code"] for one in found.json["faults"] if one["blocking"]]), (1, ["flat"]))
        self.assert_fails(3, "mesh", "repair", both, "-o", out, says=("nothing is left", "2 parts had no volume"))
        island = boxes(self.folder / "filled.off", (3, 0, 1), (1, 1, -1), (1, 1, 1))
        done = clast("mesh", "repair", island, "-o", out, "--json")
        self.assertEqual((done.code, done.json["n_part"], done.json["volume"], done.json["area"]), (0, 1, 27, 54))
        tiny = boxes(self.folder / "tiny.off", (1e-100, 0, 1))
        self.assertEqual(clast("mesh", "check", tiny).code, 1)
        self.assert_fails(3, "mesh", "hull", boxes(self.folder / "tiny.off", (1e-150, 0, 1)), "-o", out, says=("too small for a volume",))

    def test_a_cavity_whose_wall_lies_in_the_outer_one_stays_a_cavity(self):
        """A cube cut out of a corner was turned over: volume 28 for 26."""
        done = clast("mesh", "repair", boxes(self.folder / "corner.off", (3, 0, 1), (1, 0, -1)), "-o", self.folder / "out.off", "--json")
        self.assertEqual((done.code, done.json["volume"], done.json["changes"]["n_turned"]), (0, 26, 0))

    def test_repair_leaves_parts_that_cut_each_other(self):
        """A part that pokes out of another is not within it, whatever three of its triangles say."""
        bar = boxes(self.folder / "cut.off", (4, 0, 1), (2, 1, 1), (2, 3, 1))
        done = clast("mesh", "repair", bar, "-o", self.folder / "out.off", "--json")
        self.assertEqual((done.json["volume"], done.json["changes"]["n_part_dropped"]), (80, 0))
        self.assertNotIn("drops", self.checked(bar)[2]["doubled_parts"])

    def test_a_body_written_twice_with_the_same_vertices_is_told(self):
        """Volume 128 and convexity 2 without a word; `mesh repair`, whose word was asked for, dropped both copies."""
        path, out = boxes(self.folder / "twice.off", (4, 0, 1)), self.folder / "out.off"
        head, *rest = path.read_text().splitlines()[1:]
        path.write_text("\n".join(["OFF", "8 24 0", *rest, *rest[8:]]) + "\n")
        self.assertIn("12 superfluous triangles", self.checked(path)[2]["duplicate"])
        done = clast("mesh", "repair", path, "-o", out, "--json")
        self.assertEqual((done.code, done.json["volume"], done.json["changes"]["n_duplicate"]), (0, 64, 12), done.err)
        words = clast("shape", path).err
        self.assertIn("12 of its triangles repeat another with the same winding; its volume counts twice what they bound; drop them: clast mesh repair", words)
        self.assertEqual(words.count("\n"), 1)
        self.assert_fails(3, "aggregate", "--core", path, "--core-size", "100um", "--coat", "sphere", "--size", "20um", "--core-density",
                          "2500kg/m3", "-q", "-o", self.folder / "run", says=["12 of its triangles repeat another", "--accept-faults"])

    def test_several_bodies_in_a_file_are_told(self):
        """A crumb far off made a box of convexity 0.3, without a word."""
        crumb = boxes(self.folder / "crumb.off", (2, 0, 1), (0.1, 9, 1))
        for options in ((), ("--hull",)):
            result = clast("shape", crumb, *options)
            self.assertEqual((result.code, result.err.count("\n")), (0, 1), result.err)
            self.assertIn("crumb.off: 2 bodies that do not hang together, measured as one grain; clast mesh repair --keep largest", result.err)
        self.assertIn("2 bodies", clast("shape", crumb, "--json").json["warnings"][0]["text"])
        out = self.folder / "one.off"
        self.assertEqual(clast("mesh", "repair", crumb, "--keep", "largest", "-o", out).code, 0)
        self.assertEqual(clast("shape", out).err, "")

    def test_several_bodies_are_no_grain(self):
        """Density 766 and porosity 0.69 of two cubes five apart, as of one rigid grain; a body in a cavity stays where it is."""
        crumb = boxes(self.folder / "crumb.off", (2, 0, 1), (0.1, 9, 1))
        options = ("--core-size", "100um", "--size", "20um", "--core-density", "2500kg/m3", "-q", "-o", self.folder / "run")
        for core, coat in ((crumb, "sphere"), ("sphere", crumb)):
            self.assert_fails(3, "aggregate", "--core", core, "--coat", coat, *options,
                              says=["crumb.off: 2 bodies that do not hang together", "clast mesh repair --keep largest", "--accept-faults"])
        cloud = ("evolve", "--domain", "box:0,0,0,1cm,1cm,1cm", "--particles", 5, "--shapes", crumb, "--curve", "20um", "--duration", "1ms")
        self.assert_fails(3, *cloud, says=["2 bodies that do not hang together", "--accept-faults"])
        self.assertEqual(clast(*cloud, "--accept-faults").code, 0)
        self.assertEqual(clast("aggregate", "--core", crumb, "--coat", "sphere", "--accept-faults", *options).code, 0)

    def test_cuts_that_were_not_looked_for_are_told(self):
        """400 copies of a grain were a solid of density 223218, convexity 109, "bodies that do not hang together"."""
        dense, out = lenses(self.folder / "dense.off", 0, 0.1), self.folder / "out.ply"
        self.assertIs(clast("mesh", "check", dense, "--json").json["intersection_complete"], False)
        shape = clast("shape", dense)
        self.assertEqual((shape.code, shape.err.count("\n")), (0, 1), shape.err)
        self.assertIn("dense.off: whether it cuts itself was not looked for", shape.err)
        self.assert_fails(3, "aggregate", "--core", dense, "--core-size", "100um", "--coat", "sphere", "--size", "20um", "-q", "-o", self.folder / "run",
                          says=["whether it cuts itself was not looked for", "--accept-faults"])
        self.assertIn("the input may count volume twice", clast("mesh", "hull", dense, "-o", out).out)
        self.assertIn("was not looked for", clast("mesh", "form", dense, "--flatness", 0.6, "-o", out).err)

    def test_aggregates_refuse_it(self):
        """Core row: porosity -0.125, density 2812 of a material of 2500."""
        options = ("--core-size", "100um", "--coat", "sphere", "--size", "20um", "--core-density", "2500kg/m3", "-q")
        result = self.assert_fails(3, "aggregate", "--core", "doubled.off", *options, "-o", "run", cwd=self.folder,
                                   says=["core: doubled.off", "1 of its 2 parts counts twice", "clast mesh repair doubled.off -o doubled-closed.ply",
                                         "--accept-faults"])
        self.assertEqual(clast(*result.err.split("it: ")[1].split(", or")[0].split()[1:], cwd=self.folder).code, 0)
        self.assertEqual(clast("aggregate", "--core", "doubled-closed.ply", *options, "-o", "run", cwd=self.folder).code, 0)
        for name, more in (("island.off", ()), ("doubled.off", ("--accept-faults",))):
            done = clast("aggregate", "--core", name, *options, *more, "-o", f"run-{name}", cwd=self.folder)
            self.assertEqual(done.code, 0, done.err)

    def test_shape_tells_it(self):
        """convexity 1.125 and a hull of -11.111 % more than the surface, without a word."""
        for options in ((), ("--hull",)):
            result = clast("shape", self.doubled, *options)
            self.assertEqual((result.code, result.err.count("\n")), (0, 1), result.err)
            self.assertIn("clast shape: ", result.err)
            self.assertIn("doubled.off: 1 of its 2 parts counts twice in its volume", result.err)
            self.assertIn("clast mesh repair", result.err)
        result = clast("shape", self.overlap)
        self.assertIn("overlap.off: it cuts itself at 6 pairs of triangles; its volume counts overlaps twice", result.err)
        found = clast("shape", self.overlap, self.doubled, self.cavity, "--json")
        self.assertEqual([line["text"].split(":")[0] for line in found.json["warnings"]], [str(self.overlap), str(self.doubled)])
        self.assertEqual(found.json["left_out"], [])
        self.assertEqual(clast("shape", self.doubled, "-q").err, "")
        self.assertEqual(clast("shape", self.cavity).err, "")
        island = clast("shape", self.island).err  # counted once, but a body of its own
        self.assertEqual((island.count("\n"), "2 bodies that do not hang together" in island), (1, True), island)

    def test_closed_pores_are_no_form(self):
        """A ball with 2 % of pores had sphericity 0.88 and angularity 0.13: their walls counted, without a word."""
        names = [self.folder / name for name in ("ball.off", "hollow.off", "island.off")]
        sphere(names[0], (1.0, 1))
        sphere(names[1], (1.0, 1), (0.8, -1))
        sphere(names[2], (1.0, 1), (0.8, -1), (0.2, 1))
        ball, hollow, island = clast("shape", *names, "--json").json["grains"]
        for grain in (hollow, island):
            for key in ("area", "sphericity", "convexity", "roundness", "normal_roundness", "angularity", "feret_max"):
                self.assertAlmostEqual(grain[key], ball[key], 12, key)
            self.assertAlmostEqual(grain["volume"] + grain["pore_volume"], ball["volume"], places=12)
            self.assertGreater(grain["hull_volume_added"], 0.9)
        self.assertEqual((ball["pore_volume"], ball["pore_area"]), (0, 0))
        self.assertAlmostEqual(hollow["pore_volume"], 0.512 * ball["volume"], places=12)
        self.assertAlmostEqual(hollow["pore_area"], 0.64 * ball["area"], places=12)
        self.assertAlmostEqual(island["pore_volume"], (0.512 - 0.008) * ball["volume"], places=12)
        self.assertIn("closed pores", clast("shape", names[1]).out)
        self.assertNotIn("closed pores", clast("shape", names[0]).out)
        table = self.folder / "t.csv"
        self.assertEqual(clast("shape", names[1], "--unit", "mm", "-o", table).code, 0)
        self.assertIn("pore_volume_m3,pore_area_m2", table.read_text().splitlines()[0])

    def test_bodies_in_a_file_that_cuts_itself_are_told(self):
        """Two overlapping cubes and one 50 away: L = 59.7, with a line on the cuts alone."""
        path = boxes(self.folder / "far.off", (2, 0, 1), (2, 1, 1), (1, 50, 1))
        err = clast("shape", path).err
        self.assertIn("at least 2 bodies that do not hang together", err)
        self.assertIn("cuts itself at 6 pairs", err)
        self.assertNotIn("hang together", clast("shape", self.overlap).err)

    def test_a_weld_that_moves_vertices_is_told(self):
        """Volume 1 of a box with its lid a hundredth above it, without a word."""
        path = boxes(self.folder / "lid.off", (1, 0, 1))
        lines = path.read_text().split("\n")
        lines[1] = "12 12 0"
        lifted = [line[:-1] + "1.01" for line in lines[2:10] if line.endswith(" 1")]
        lid = [k for k, line in enumerate(lines) if line.startswith("3 ") and {int(i) for i in line.split()[1:]} <= {1, 3, 5, 7}]
        for k in lid:
            lines[k] = "3 " + " ".join(str({1: 8, 3: 9, 5: 10, 7: 11}[int(i)]) for i in lines[k].split()[1:])
        lines[10:10] = lifted
        path.write_text("\n".join(lines))
        result = clast("shape", path, "--json")
        self.assertEqual(result.code, 0, result.err)
        self.assertIn("4 vertices of open edges merged with others within 0.01 ", result.json["warnings"][0]["text"])

    def test_shape_looks_at_seams_as_it_measures_them(self):
        """Each facet has corners of its own: parts show only once they are merged."""
        vertices, facets = [], []
        lines = self.doubled.read_text().split("\n")[2:]
        points, faces = [one for one in lines if len(one.split()) == 3], [one.split()[1:] for one in lines if len(one.split()) == 4]
        for face in faces:
            facets.append(f"3 {len(vertices)} {len(vertices) + 1} {len(vertices) + 2}")
            vertices += [points[int(corner)] for corner in face]
        seams = self.folder / "seams.off"
        seams.write_text(f"OFF\n{len(vertices)} {len(facets)} 0\n" + "\n".join([*vertices, *facets]) + "\n")
        self.assertIn("1 of its 2 parts counts twice", clast("shape", seams).err)

    def test_fill_tells_it(self):
        result = clast("fill", self.doubled, "--spheres", 2)
        self.assertEqual(result.code, 0, result.err)
        self.assertIn("1 of its 2 parts counts twice", result.err)
        self.assertEqual(clast("fill", self.doubled, "--spheres", 2, "--json").json["n_doubled"], 1)
        self.assertEqual(clast("fill", self.island, "--spheres", 2).err, "")

    def test_commands_tell_repeated_facets(self):
        """A cube of facets written twice had a hull that added -1 and a half of its volume filled, without a word."""
        path, out = boxes(self.folder / "twice.off", (1, 0, 1)), self.folder / "out.ply"
        head, *rest = path.read_text().splitlines()[1:]
        path.write_text("\n".join(["OFF", "8 24 0", *rest, *rest[8:]]) + "\n")
        found = clast("mesh", "check", path, "--json").json
        self.assertEqual((found["n_repeated"], found["n_body"]), (12, 1))
        for command in (("fill", path, "--spheres", 2), ("mesh", "form", path, "--flatness", 0.6, "-o", out)):
            self.assertIn("12 of its triangles repeat another with the same winding", clast(*command).err)
        self.assertIn("counts volume twice", clast("mesh", "hull", path, "-o", out).out)

    def test_hull_and_form_tell_it(self):
        """The hull added -8 to a surface of volume 72."""
        out = self.folder / "out.ply"
        for path, why in ((self.doubled, "1 of its 2 parts counts twice"), (self.overlap, "cuts itself at 6 pairs")):
            words = clast("mesh", "hull", path, "-o", out)
            self.assertIn("what it adds is not known: the input counts volume twice", words.out)
            self.assertIsNone(clast("mesh", "hull", path, "-o", out, "--json").json["added_volume"])
            form = clast("mesh", "form", path, "--flatness", 0.6, "-o", out)
            self.assertEqual((form.code, form.err.count("\n")), (0, 1), form.err)
            self.assertIn(why, form.err)
            self.assertEqual(clast("mesh", "form", path, "--flatness", 0.6, "--hull", 50, "-o", out).err, "")
        self.assertIn("surface volume 160", clast("mesh", "hull", self.island, "-o", out).out)

    def test_a_simpler_surface_that_is_no_solid_any_more_is_told(self):
        """A cavity's wall was simplified through the outer one: written with code 0 and not a word."""
        solid, out = self.cavity, self.folder / "out.ply"
        result = clast("mesh", "simplify", solid, "--faces", 10, "-o", out)
        self.assertEqual((result.code, result.err.count("\n")), (1, 1), result.err)
        self.assertIn("is no solid any more: 1 part inside out", result.err)
        self.assertIn("--faces", result.err)
        self.assertEqual(clast("mesh", "check", out).code, 1)
        found = clast("mesh", "simplify", solid, "--faces", 10, "-o", out, "--json")
        self.assertEqual((found.code, found.json["is_solid"]), (1, False))

    def test_a_simpler_surface_that_cuts_itself_is_told(self):
        shell, out = self.folder / "shell.off", self.folder / "out.ply"
        sphere(shell, (1.0, 1), (0.9, -1))
        result = clast("mesh", "simplify", shell, "--faces", 60, "-o", out, "--json")
        self.assertEqual((result.code, result.json["is_solid"], result.err.count("\n")), (0, True, 1), result.err)
        self.assertGreater(result.json["n_intersection"], 0)
        self.assertIn(f"now it cuts itself at {result.json['n_intersection']} pairs of triangles", result.err)
        fine = clast("mesh", "simplify", shell, "--faces", 1000, "-o", out, "--json")
        self.assertEqual((fine.code, fine.err, fine.json["is_solid"], fine.json["n_intersection"]), (0, "", True, 0))

    def test_faults_before_simplifying_are_no_news(self):
        result = clast("mesh", "simplify", self.overlap, "--faces", 24, "-o", self.folder / "out.ply", "--json")
        self.assertEqual((result.code, result.err, result.json["n_intersection"]), (0, "", 6))

    def test_sound_surfaces_have_no_word(self):
        for name in ("standin63/grain00.ply", "scarlet/stl/27sk21_shape_fine.stl", "scarlet/stl/Menger2.stl"):
            self.assertEqual(clast("shape", ROOT / "data" / name).err, "", name)


def quads(path, n_vertex, *faces, turned=()):
    """OFF of quadrangles of a row of unit cubes (vertex 4 x + 2 y + z), each cut in two; those of `turned` again, turned over and cut otherwise."""
    lines = [f"3 {a} {b} {c}\n3 {a} {c} {d}" for a, b, c, d in faces] + [f"3 {c} {b} {a}\n3 {d} {c} {a}" for d, a, b, c in turned]
    vertices = [f"{i // 4} {i // 2 % 2} {i % 2}" for i in range(n_vertex)]
    path.write_text("\n".join([f"OFF\n{n_vertex} {2 * len(lines)} 0", *vertices, *lines]) + "\n")
    return path


def cube(x):
    """Quadrangles of the cube from x to x + 1, outward; the first is its low, the second its high side."""
    i = 4 * x
    return [(i, i + 1, i + 3, i + 2), (i + 4, i + 6, i + 7, i + 5), (i, i + 4, i + 5, i + 1), (i + 2, i + 3, i + 7, i + 6),
            (i, i + 2, i + 6, i + 4), (i + 1, i + 5, i + 7, i + 3)]


class TwoSided(Case):
    """Faces written on both sides: sheets without volume, walls."""

    def test_parts_without_volume_are_no_solid(self):
        """All six faces two-sided: repair made six sheets of it, and check called those a solid of volume 0."""
        both = quads(self.folder / "both.off", 8, *cube(0), turned=cube(0))
        self.assertEqual(clast("mesh", "check", both).code, 1)
        self.assert_fails(3, "mesh", "repair", both, "-o", self.folder / "o.ply", says=("nothing is left", "6 parts had no volume"))
        sheet = quads(self.folder / "sheet.off", 16, *cube(0), (12, 13, 15, 14), turned=[(12, 13, 15, 14)])
        found = clast("mesh", "check", sheet, "--json")
        self.assertEqual(found.code, 1)
        self.assertIn("1 of 2 parts has no volume", {fault["code"]: fault["text"] for fault in found.json["faults"]}["flat_parts"])
        self.assertIn("1 of its 2 parts has no volume (the two sides of a sheet)", clast("shape", sheet).err)
        self.assertIn("1 of its 2 parts has no volume (the two sides of a sheet)", clast("fill", sheet, "--spheres", 1).err)
        closed = self.folder / "closed.ply"
        self.assertEqual(clast("mesh", "repair", sheet, "-o", closed).code, 0)
        found = clast("mesh", "check", closed, "--json").json
        self.assertEqual((found["n_part"], found["volume"], found["hull_volume"]), (1, 1, 1))

    def test_a_face_of_two_sides_is_repaired_at_once(self):
        """The volume came out as 2/3, with windings mixed; repair of that was right."""
        for k in range(6):
            path = quads(self.folder / f"{k}.off", 8, *cube(0), turned=[cube(0)[k]])
            result = clast("mesh", "repair", path, "-o", self.folder / "o.ply", "--json")
            self.assertEqual((result.code, result.json["n_triangle"]), (0, 12), result.err)
            self.assertAlmostEqual(result.json["volume"], 1, places=12)

    def test_a_wall_inside_is_told_by_shape(self):
        """Area 12 for 10 and sphericity 0.64 for 0.77 came without a word."""
        wall = quads(self.folder / "wall.off", 12, *cube(0), *cube(1))
        result = clast("shape", wall)
        self.assertEqual(result.code, 0)
        self.assertIn("4 of its triangles are a wall inside it", result.err)
        self.assertIn("drop it: clast mesh repair", result.err)
        self.assertEqual(clast("shape", quads(self.folder / "one.off", 12, *cube(0)[:1], *cube(0)[2:], *cube(1)[1:])).err, "")

    def test_a_neck_of_one_edge_is_none(self):
        """aggregate took two cubes that share an edge as one rigid grain; of a common wall they are one."""
        grain = ("aggregate", "--unit", "um", "--coat", "sphere", "--size", "1um", "--core")
        other = [[{0: 6, 1: 7, 2: 8, 3: 9, 4: 10, 5: 11, 6: 12, 7: 13}[i] for i in face] for face in cube(0)]
        edge = quads(self.folder / "edge.off", 14, *cube(0), *other)
        lines = edge.read_text().split("\n")
        lines[10:16] = ["1 2 0", "1 2 1", "2 1 0", "2 1 1", "2 2 0", "2 2 1"]
        edge.write_text("\n".join(lines))
        self.assert_fails(3, *grain, edge, says=("2 bodies that do not hang together",))
        self.assertEqual(clast(*grain, quads(self.folder / "wall.off", 12, *cube(0), *cube(1))).code, 0)
        self.assertIn("2 bodies that do not hang together", clast("shape", edge).err)  # L of both, without a word
        self.assertIn("2 bodies that do not hang together", clast("mesh", "form", edge, "--flatness", 0.6, "-o", self.folder / "o.ply").err)
        found = clast("mesh", "check", edge, "--json").json
        self.assertEqual((found["n_part"], found["n_body"]), (1, 2))

    def test_a_body_too_small_for_a_volume_is_not_called_flat(self):
        tiny = boxes(self.folder / "tiny.off", (1e-120, 0, 1))
        self.assertIn("an extent of 1.73e-120 is too small for a volume", clast("mesh", "check", tiny).out)


if __name__ == "__main__":
    unittest.main()
