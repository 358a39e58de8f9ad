"""CLI: clouds in any unit, file and place: decompose gives the answer of the same points in metres about the origin."""
import math
import random
import struct
import unittest

from clitest import ROOT, Case, clast

CSV = ROOT / "data/d2sd/points_b3_n500.csv"
ROWS = [[float(c) for c in line.split(",")] for line in CSV.read_text().split()[1:]]
CUBE = "box:0,0,0,1,1,1"
N = len(ROWS)
# what a file's format or place cannot change
SAME = ("n", "tests", "score", "passes", "n_cell", "pair_integral", "pair_integral_low", "domain_volume", "spacing")


def ply(kind):
    """Vertices with a list and a number before x, after an element that is not theirs."""
    order = {"binary_little_endian": "<", "binary_big_endian": ">"}.get(kind)
    head = (f"ply\nformat {kind} 1.0\ncomment drops\nelement box 1\nproperty list uchar float side\nelement vertex {N}\n"
            "property uchar red\nproperty double x\nproperty double y\nproperty list uchar int near\nproperty double z\n"
            "property float size\nend_header\n").encode()
    if order is None:
        return head + b"2 1 1\n" + "".join(f"7 {p[0]!r} {p[1]!r} 2 4 5 {p[2]!r} {k}\n" for k, p in enumerate(ROWS)).encode()
    rows = [struct.pack(order + "BddBiidf", 7, p[0], p[1], 2, 4, 5, p[2], k) for k, p in enumerate(ROWS)]
    return head + struct.pack(order + "Bff", 2, 1, 1) + b"".join(rows)


class CloudInputs(Case):
    def write(self, name, points, header="x,y,z\n", separator=","):
        path = self.folder / name
        path.write_text(header + "".join(separator.join(map(repr, p)) + "\n" for p in points))
        return path

    def answer(self, path, domain, *options):
        r = clast("decompose", path, "--domain", domain, "--json", *options)
        self.assertEqual(r.code, 0, f"{path} {domain}: {r.err}")
        return r.json

    def assert_same(self, got, wanted, places=9, keys=SAME):
        def flat(value):
            if isinstance(value, dict):
                return [x for v in value.values() for x in flat(v)]
            return [x for v in value for x in flat(v)] if isinstance(value, list) else [value]
        for key in keys:
            a, b = flat(got[key]), flat(wanted[key])
            self.assertEqual(len(a), len(b), key)
            for x, y in zip(a, b):
                if isinstance(y, float):
                    self.assertAlmostEqual(x, y, delta=10 ** -places * (1 + abs(y)), msg=key)
                else:
                    self.assertEqual(x, y, key)

    def test_temperatures_are_kelvin_or_celsius_by_their_name(self):
        random_at = random.Random(4)
        rows = [[random_at.random() for _ in range(3)] for _ in range(60)]
        events = {}
        for name, value in (("T_K", 293.15), ("T", 293.15), ("T_C", 20), ("T (degC)", 20), ("T_degC", 20), ("T [ degC ]", 20), ("T_C:0", 20), ("T_F", 68)):
            path = self.folder / "warm.csv"
            path.write_text(f"x,y,z,{name}\n" + "".join(f"{x},{y},{z},{value}\n" for x, y, z in rows))
            ask = ("agglomerate", path, "--domain", "box:0,0,0,1,1,1", "--columns", "x,y,z", "--kernel", "brownian", "--monomer-radius",
                   "1um", "--particle-density", "1000", "--temperature-column", name, "--duration", "1e16s", "--out-of-range", "extrapolate")
            if name == "T_F":
                self.assert_fails(2, *ask, says=("column 'T_F'", "unknown unit 'F'"))
                continue
            got = clast(*ask, "--json")
            self.assertEqual(got.code, 0, got.err)
            events[name] = got.json["events"][-1]
        self.assertEqual(len(set(events.values())), 1, events)
        self.assertGreater(events["T_K"], 0)

    def test_positions_and_domain_have_units(self):
        wanted = self.answer(CSV, CUBE)
        mm = self.write("mm.csv", [[1e3 * c for c in p] for p in ROWS])
        named = self.write("named.csv", [[1e3 * c for c in p] for p in ROWS], "x_mm,y_mm,z_mm\n")
        for path, domain, options in ((mm, "box:0,0,0,1000,1000,1000", ["--unit", "mm"]),
                                      (mm, "box:0,0,0,1m,1000mm,100cm", ["--unit", "mm"]),
                                      (mm, "box:0,0,0,1,1,1", ["--unit", "mm", "--domain-unit", "m"]),
                                      (named, CUBE, ["--columns", "x_mm,y_mm,z_mm"]),
                                      (named, "box:0,0,0,1e3mm,1m,1e6um", ["--columns", "x_mm,y_mm,z_mm"])):
            r = self.answer(path, domain, *options)
            self.assertEqual(r["domain"], CUBE)
            self.assert_same(r, wanted)
        self.assert_fails(2, "decompose", named, "--domain", CUBE, "--columns", "x_mm,y_mm,z_mm", "--unit", "um",
                          says=["column 'x_mm' is in mm by its name", "um"])
        self.assert_fails(2, "decompose", mm, "--domain", CUBE, "--unit", "kg", says=["kg"])
        self.assert_fails(2, "decompose", mm, "--domain", "box:0,0,0,1kg,1,1", says=["domain 'box:0,0,0,1kg,1,1'"])
        corner = self.write("um.csv", [[1e2 * c for c in p] for p in ROWS], "x_um,y_um,z_um\n")
        for command in (["decompose"], ["agglomerate", "--constant", "1e-3", "--n-step", "1"]):
            for domain, is_told in (("box:0,0,0,100,100,100", True), ("box:0,0,0,100um,100um,100um", False)):
                r = clast(*command, corner, "--columns", "x_um,y_um,z_um", "--domain", domain)
                self.assertEqual(("um, the domain is 100 m wide; are both in the same unit?" in r.err, "coincident points" in r.out), (is_told, False), r.err)
                self.assertEqual("< 1e-300  rejects" in r.out, is_told and command[0] == "decompose", r.out)
        ends = self.write("ends.csv", [[n, n, n] for n in range(100, 401)], "x_um,y_um,z_um\n") # to the last bit
        told = clast("decompose", ends, "--columns", "x_um,y_um,z_um", "--domain", "box:100um,100um,100um,400um,400um,400um")
        self.assertEqual(told.code, 0, told.err)
        # the opposite: coordinates in mm, taken as m, in a domain of mm
        for scale, unit in ((1.0, "mm"), (1e3, "um")):
            far = self.write("far.csv", [[scale * c for c in p] for p in ROWS])
            for command in (["decompose"], ["agglomerate", "--constant", "1e-3", "--n-step", "1"]):
                self.assert_fails(3, *command, far, "--domain", "box:0,0,0,1mm,1mm,1mm",
                                  says=["points lie outside the domain", f"in {unit} they would fit: --unit {unit}?"])
        near = clast("decompose", self.write("one.csv", ROWS + [[1.01, 0.5, 0.5]]), "--domain", CUBE)
        self.assertNotIn("--unit", near.err)
        agglomerate = ["--constant", "1e-3", "--n-step", "1", "--json"]
        a = clast("agglomerate", mm, "--domain", "box:0,0,0,1m,1m,1m", "--unit", "mm", *agglomerate)
        b = clast("agglomerate", CSV, "--domain", CUBE, *agglomerate)
        self.assertEqual((a.code, a.json["n_particle"]), (0, b.json["n_particle"]))

    def test_velocities_and_flow_have_the_units_of_their_names(self):
        """u_cm/s, G_1/min, eps_cm2/s3 were read as SI: 159, 82 and 6 particles were left for 300, 291 and 285."""
        rng = random.Random(2)
        rows = [[rng.random() for _ in range(3)] + [rng.gauss(0, 1) for _ in range(3)] for _ in range(300)]

        def left(head, columns, *options, fails=()):
            path = self.write("flow.csv", [row[:3] + list(columns(row)) for row in rows], f"x,y,z,{head}\n")
            ask = ("agglomerate", path, "--domain", CUBE, "--out-of-range", "extrapolate", "--monomer-radius", "1cm", *options)
            return self.assert_fails(fails[0], *ask, says=fails[1:]) if fails else clast(*ask, "--json").json["n_particle"][-1]

        ballistic, words = ("--kernel", "ballistic", "--velocity-columns"), [f"{a}_{{}},{b}_{{}},{c}_{{}}" for a, b, c in ["uvw"]][0]
        wanted = left("u,v,w", lambda row: row[3:], *ballistic, "u,v,w")
        self.assertLess(wanted, 290)
        for unit, scale in (("m/s", 1), ("cm/s", 100), ("mm/s", 1000)):
            head = words.replace("{}", unit)
            self.assertEqual(left(head, lambda row, k=scale: [k * v for v in row[3:]], *ballistic, head), wanted)
        # a unit that stands inside the name was known, and not used; one with a power was taken for SI
        for words in ("U (cm/s) {}", "U_cm/s:{}", "U_cm/s_{}", "Velocity {} [ cm s^-1 ]", "{} (cm s-1)", "{} (cm s\u207b\u00b9)", "U{} cm/s"):
            head = ",".join(words.replace("{}", str(k)) for k in range(3))
            self.assertEqual(left(head, lambda row: [100 * v for v in row[3:]], *ballistic, head), wanted, words)
        for words in ("{} (mean)", "U:{}", "velocity_{}", "U{}(t)", "U_t_{}"):  # which tell none
            head = ",".join(words.replace("{}", str(k)) for k in range(3))
            self.assertEqual(left(head, lambda row: row[3:], *ballistic, head), wanted, words)
        for name, unit in (("u_ft/s,v,w", "ft/s"), ("u (ft s-1),v,w", "ft s-1"), ("u [mm],v,w", "mm")):
            left(name, lambda row: row[3:], *ballistic, name, fails=(2, f"column '{name.split(',')[0]}'", f"unknown unit '{unit}'; known here: m/s"))
        left("U (cm/s) x,U (cm/s) y,w", lambda row: row[3:], *ballistic, "U (cm/s) x,U (cm/s) y,w", fails=(3, "is in cm/s by its name"))
        left("u_mm/s,v,w", lambda row: row[3:], *ballistic, "u_mm/s,v,w", fails=(3, "column 'u_mm/s' is in mm/s", "column 'w' says no unit"))
        for option, value, kernel, names in (
                ("--shear-column", 100, ("shear_laminar",), (("G", 1), ("G_1/min", 60), ("G (1/h)", 3600), ("G (1/min) mean", 60),
                                                                    ("G [min^-1]", 60))),
                ("--dissipation-column", 0.1, ("shear_turbulent", "--density", 1000), (("e", 1), ("eps_cm2/s3", 1e4), ("eps [mm^2/s^3]", 1e6))),
                ("--speed-rms-column", 1, ("inertial", "--particle-density", 1000), (("u", 1), ("urms_cm/s", 100)))):
            found = {left(name, lambda row, k=scale: [k * value], "--kernel", *kernel, option, name) for name, scale in names}
            self.assertEqual(len(found), 1, option)
            self.assertLess(found.pop(), 290)
        left("G_1/week", lambda row: [1.0], "--kernel", "shear_laminar", "--shear-column", "G_1/week",
             fails=(2, "column 'G_1/week'", "unknown unit '1/week'; known here: 1/s"))
        fixed = {left(f"c,{name}", lambda row, k=scale: [0, k], "--constant", 0.01, "--fixed-column", "c", "--fixed-volume-column", name)
                 for name, scale in (("v", 0.5), ("v_cm3", 5e5))}
        self.assertEqual(len(fixed), 1)

    def test_units_in_names_count_in_every_format(self):
        """d_mm was 8 m in VTK, PLY and dumps; a vector U_cm/s was in m/s, and x_mm of a PLY no coordinate."""
        rows = [[1e3 * c for c in p] + [8.0, 100.0 * k] for k, p in enumerate(ROWS)]
        n, lines = len(rows), "".join(" ".join(map(repr, row)) + "\n" for row in rows)
        names = ("x_mm", "y_mm", "z_mm", "d_mm", "u_cm/s")
        places = "".join(" ".join(map(repr, p)) + "\n" for p in ROWS)
        files = {
            "a.csv": ",".join(names) + "\n" + lines.replace(" ", ","),
            "a.ply": f"ply\nformat ascii 1.0\nelement vertex {n}\n" + "".join(f"property double {name}\n" for name in names) + "end_header\n" + lines,
            "a.dump": f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{n}\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS {' '.join(names)}\n" + lines,
            "a.vtk": f"# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS {n} double\n{places}POINT_DATA {n}\nSCALARS d_mm double 1\n"
                     "LOOKUP_TABLE default\n" + "8\n" * n + "VECTORS U_cm/s double\n" + "".join(f"{row[4]} 0 0\n" for row in rows)}
        found = set()
        for name, text in files.items():
            path, u = self.folder / name, ("U_cm/s_x", "U_cm/s_y", "U_cm/s_z") if name == "a.vtk" else ("u_cm/s",) * 3
            path.write_text(text)
            r = clast("agglomerate", path, "--domain", CUBE, "--diameter-column", "d_mm", "--kernel", "shear_laminar", "--shear", "5/s",
                      "--out-of-range", "extrapolate", "--duration", "100s", "--n-step", 1, "--json")
            self.assertEqual(r.code, 0, r.err)
            found.add(r.json["n_particle"][-1])
            r = clast("agglomerate", path, "--domain", CUBE, "--diameter-column", "d_mm", "--kernel", "ballistic", "--velocity-columns", ",".join(u),
                      "--out-of-range", "extrapolate", "--duration", "1e-9s", "--n-step", 1, "--json")
            self.assertEqual(r.code, 0, r.err)
        self.assertEqual(len(found), 1, found)

    def test_sizes_in_phi_are_lengths(self):
        """7 phi, 7.8 um, was a radius of 3.5 m."""
        found = set()
        for name, value in (("d", 2.0 ** -7 * 1e-3), ("diameter_phi", 7), ("d (phi)", 7), ("phi", 7)):
            path = self.write("phi.csv", [[*p, value] for p in ROWS], f"x,y,z,{name}\n")
            r = clast("agglomerate", path, "--domain", CUBE, "--diameter-column", name, "--kernel", "shear_laminar", "--shear", "1/s", "--out-of-range",
                      "extrapolate", "--duration", "2e10s", "--n-step", 1, "--json")
            self.assertEqual(r.code, 0, r.err)
            found.add((r.json["n_particle"][-1], r.json["volume_fraction"]))
        self.assertEqual(len(found), 1, found)

    def test_lengths_in_units_that_are_not_read_are_refused(self):
        """x [ft] and x (MM) were metres; --unit of x_rel/L was not asked."""
        for names in ("{} [ft]", "{} (inch)", "{} (MM)", "{} (millimeter)", "{}_ft", "{} ft", "{} (g)", "{}_rel/L"):
            head = ",".join(names.replace("{}", axis) for axis in "xyz")
            path = self.write("foreign.csv", ROWS, head + "\n")
            self.assert_fails(2, "decompose", path, "--domain", CUBE, "--columns", head, says=("unknown unit", "known here: m, cm"))
            self.assert_same(self.answer(path, CUBE, "--columns", head, "--unit", "m"), self.answer(CSV, CUBE))
        latin = self.folder / "latin.csv"
        latin.write_bytes("x_\u00b5m,y_\u00b5m,z_\u00b5m\n".encode("latin-1") + b"1,2,3\n")
        self.assert_fails(2, "decompose", latin, "--domain", CUBE, "--columns", "x_\udcb5m,y_\udcb5m,z_\udcb5m", says=("unknown unit",))
        for names, scale in (("{} [ mm ]", 1e3), ("{}_in", 1 / 0.0254), ("{}_mm:0", 1e3), ("{} (mean)", 1), ("{}_min", 1), ("{} [-]", 1), ("{}_t", 1)):
            head = ",".join(names.replace("{}", axis) for axis in "xyz")
            path = self.write("usual.csv", [[scale * v for v in p] for p in ROWS], head + "\n")
            self.assert_same(self.answer(path, CUBE, "--columns", head), self.answer(CSV, CUBE))

    def test_some_coordinates_with_a_unit_and_some_without_are_refused(self):
        """x_mm, y_mm beside z: z was taken as metres."""
        path = self.write("mixed.csv", [[1e3 * p[0], 1e3 * p[1], 1e3 * p[2]] for p in ROWS], "x_mm,y_mm,z\n")
        for command in (("decompose", path), ("agglomerate", path, "--constant", 1), ("evolve", "--points", path, "--curve", "20um")):
            self.assert_fails(3, *command, "--domain", CUBE, says=("is in mm by its name, column 'z' says no unit",))
        wanted = self.answer(CSV, CUBE)
        self.assert_same(self.answer(path, CUBE, "--unit", "mm", "--domain-unit", "m"), wanted)
        own = self.write("own.csv", [[1e3 * p[0], 1e2 * p[1], 1e6 * p[2]] for p in ROWS], "x_mm,y_cm,z_um\n")
        self.assert_same(self.answer(own, CUBE), wanted)

    def test_vertices_of_surfaces_are_no_particles(self):
        """50 bodies of a frame were 2100 particles, one a vertex; decompose's own cells were points. A field has a mesh's nodes."""
        cells = self.folder / "run/cells.vtu"
        self.assertEqual(clast("decompose", CSV, "--domain", CUBE, "-o", cells.parent).code, 0)
        self.assertEqual(self.answer(cells.parent / "points.vtp", CUBE)["n"], N)
        for path in (cells, ROOT / "data/standin63/grain00.ply"):
            for command in (("decompose", path), ("agglomerate", path, "--constant", 1), ("evolve", "--points", path, "--curve", "20um")):
                self.assert_fails(3, *command, "--domain", CUBE, says=("faces join its points", "particles.csv"))
        self.assert_fails(3, "evolve", "--field", cells, "--particles", 5, "--curve", "20um", "--domain", CUBE, says=("no column of numbers named 'u'",))

    def test_ply_and_xyz_hold_the_same_points(self):
        wanted = self.answer(CSV, CUBE)
        for kind in ("ascii", "binary_little_endian", "binary_big_endian"):
            path = self.folder / f"{kind}.ply"
            path.write_bytes(ply(kind))
            self.assert_same(self.answer(path, CUBE), wanted, 12)
            r = clast("decompose", path, "--domain", CUBE, "--weight-column", "red", "--json")
            self.assertEqual(r.code, 0, r.err)
            path.write_bytes(ply(kind)[:-2000])
            self.assert_fails(3, "decompose", path, "--domain", CUBE, says=[path.name])
        xyz = self.folder / "drops.xyz"
        text = f"{N}\nt = 0.5 s, 2 drops\n" + "".join(f"H {p[0]!r}\t{p[1]!r} {p[2]!r} {k}\n" for k, p in enumerate(ROWS))
        xyz.write_text(text)
        self.assert_same(self.answer(xyz, CUBE), wanted, 12)
        self.assert_same(self.answer(xyz, CUBE, "--columns", "x,y,z"), wanted, 12)
        xyz.write_text(text[:-2000])
        self.assert_fails(3, "decompose", xyz, "--domain", CUBE, says=["drops.xyz"])
        xyz.write_text(text.replace("H ", "H far ", 1).replace("far " + repr(ROWS[0][0]), "0.5", 1).replace(repr(ROWS[40][1]), "here", 1))
        self.assert_fails(3, "decompose", xyz, "--domain", CUBE, says=["drops.xyz:43", "column y", "'here'"])

    def test_units_of_a_dump_count(self):
        """ITEM: UNITS counts in packings; clouds of cgs were taken in metres."""
        wanted = self.answer(CSV, CUBE)
        velocity = ("--velocity-columns", "vx,vy,vz", "--radius-column", "radius", "--mass-column", "mass", "--kernel", "ballistic", "--duration", "1s", "--json")
        for word, metre, speed, kilogram in (("cgs", 1e-2, 1e-2, 1e-3), ("micro", 1e-6, 1, 1e-15), ("real", 1e-10, 1e5, 1e-3 / 6.02214076e23), ("si", 1, 1, 1)):
            rows = "".join(f"{k} {' '.join(repr(v / metre) for v in p)} {p[0] / speed!r} {p[1] / speed!r} {p[2] / speed!r} {1e-4 / metre!r} {4e-9 / kilogram!r}\n"
                           for k, p in enumerate(ROWS))
            dump = self.folder / f"{word}.dump"
            dump.write_text(f"ITEM: UNITS\n{word}\nITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n{N}\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
                            "ITEM: ATOMS id x y z vx vy vz radius mass\n" + rows)
            self.assert_same(self.answer(dump, CUBE), wanted, 9)
            if word == "cgs":
                self.assert_same(self.answer(dump, CUBE, "--unit", "cm", "--domain-unit", "m"), wanted, 9)
                self.assert_fails(2, "decompose", dump, "--domain", CUBE, "--unit", "mm", says=("cm", "mm"))
            run = clast("agglomerate", dump, "--domain", CUBE, *velocity)
            self.assertEqual(run.code, 0, run.err)
            if word == "cgs":
                first = run.json
            self.assert_same(run.json, first, 9, ("n_particle", "time", "moments"))

    def test_properties_of_an_extended_xyz_name_its_columns(self):
        """They were passed over: with a radius before the positions that was x."""
        xyz = self.folder / "ext.xyz"
        xyz.write_text(f"{N}\nProperties=species:S:1:radius:R:1:pos:R:3:id:I:1\n"
                       + "".join(f"H 0.5 {p[0]!r} {p[1]!r} {p[2]!r} {k}\n" for k, p in enumerate(ROWS)))
        self.assert_same(self.answer(xyz, CUBE), self.answer(CSV, CUBE), 12)
        r = clast("decompose", xyz, "--domain", CUBE, "--weight-column", "radius", "--json")
        self.assertEqual(r.code, 0, r.err)

    def test_a_file_without_a_header_has_numbered_columns(self):
        path = self.write("bare.xyz", ROWS, "", " ")
        self.assert_fails(3, "decompose", path, "--domain", CUBE,
                          says=["column_1, column_2, column_3", "no header", "--columns column_1,column_2,column_3"])
        self.assert_same(self.answer(path, CUBE, "--columns", "column_1,column_2,column_3"), self.answer(CSV, CUBE), 12)
        self.assertIn("column_1", clast("decompose", "--help-all").out)

    def test_errors_tell_row_column_and_a_guess(self):
        def fails(text, *says):
            path = self.folder / "bad.csv"
            path.write_text(text)
            self.assert_fails(3, "decompose", path, "--domain", CUBE, says=["bad.csv", *says])
        fails("x;y;z\n0,1;0,2;0,3\n", "column 'x'", "row 1 holds '0,1'", "decimal comma")
        fails("x,y,z\n0,1,0,2,0,3\n", ":2: 6 cells where the first row has 3", "decimal commas")
        fails("0,1 0,2 0,3\n0,4 0,7 0,6\n", "it has 0, 1 0 (texts)", "decimal commas? write 0.5, not 0,5")
        fails("1,5,2,5,3,5\n1,5,2,5,3,5\n", "it has column_1", "decimal commas? write 0.5, not 0,5")
        fails("x,y,z\n.1,.2,.3\n.1,oops,.3\n", "column 'y'", "row 2 holds 'oops'")
        fails("X,Y,Z\n.1,.2,.3\n", "it has X, Y, Z", "did you mean 'X'")
        fails("x|y|z\n.1|.2|.3\n", "it has x|y|z", "another delimiter")
        fails("a,b,c\n.1,.2,.3\n", "named 'x'", "it has a, b, c")

    def test_repeated_points_are_counted(self):
        path = self.write("twice.csv", ROWS + ROWS[:20] + ROWS[:3] + [[-0.0, 0.5, 0.5], [0.0, 0.5, 0.5]])
        self.assertEqual(self.answer(path, CUBE)["n_repeated"], 24)
        self.assertEqual(self.answer(CSV, CUBE)["n_repeated"], 0)
        self.assertIn("24 duplicates (coincident points", clast("decompose", path, "--domain", CUBE).out)
        self.assertNotIn("repeat", clast("decompose", CSV, "--domain", CUBE).out)

    def test_cylinders_and_spheres_lie_anywhere(self):
        random.seed(6)
        local = []
        while len(local) < 600:
            p = [random.gauss(0.2, 0.3), random.gauss(0.0, 0.4), random.random()]
            if math.hypot(p[0], p[1]) < 1:
                local.append(p)
        wanted = self.answer(self.write("z.csv", local), "cylinder:1,1")
        # along x, of a base at (5, -2, 7): its own x is y then, its own y is z
        moved = self.write("x.csv", [[5 + p[2], -2 + p[0], 7 + p[1]] for p in local])
        for domain in ("cylinder:5,-2,7,1,0,0,1,1", "cylinder:5000mm,-2,7,3,0,0,1,100cm"):
            r = self.answer(moved, domain)
            self.assertEqual(r["domain"], "cylinder:5,-2,7,1,0,0,1,1")
            self.assert_same(r, wanted)
            self.assertEqual(r["n_outside"], 0)
        same = self.answer(self.write("zz.csv", [[p[0] + 5, p[1] - 2, p[2] + 7] for p in local]), "cylinder:5,-2,7,0,0,1,1,1")
        self.assert_same(same, wanted)
        tilted = self.folder / "tilted"
        axis, side, third = (0.6, 0.0, 0.8), (0.8, 0.0, -0.6), (0.0, 1.0, 0.0)
        turned = [[1 + p[0] * side[k] + p[1] * third[k] + p[2] * axis[k] for k in range(3)] for p in local]
        r = self.answer(self.write("t.csv", turned), "cylinder:1,1,1,3,0,4,1,1", "-o", tilted)
        self.assertEqual((r["n"], r["n_outside"]), (600, 0))
        ball = []
        while len(ball) < 600:
            p = [random.gauss(0.3, 0.2), random.gauss(0.0, 0.3), random.gauss(0.0, 0.3)]
            if math.hypot(*p) < 1:
                ball.append(p)
        here = self.answer(self.write("ball.csv", ball), "sphere:1")
        there = self.answer(self.write("far.csv", [[p[0] + 2, p[1] - 3, p[2] + 4] for p in ball]), "sphere:2,-3,4,1")
        self.assert_same(there, here, 9)
        for bad in ("cylinder:0,0,0,0,0,0,1,1", "cylinder:0,0,0,1mm,0,0,1,1", "cylinder:1,1,1", "sphere:1,2", "sphere:0,0,0,-1",
                    "box:0,0,0,1,1", "sphere:0,0,0,1,"):
            self.assert_fails(2, "decompose", CSV, "--domain", bad, says=[f"domain '{bad}'", "cylinder:X,Y,Z,NX,NY,NZ,R,L"])


if __name__ == "__main__":
    unittest.main()
