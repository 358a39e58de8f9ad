"""CLI: clast report writes one page that stands alone."""
import fcntl
import hashlib
import json
import os
import re
import tempfile
import unittest

from clitest import Case, clast

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../data")


def seen(page):
    """What a reader sees: no tags, no attributes, no styles, no data of the 3-D view, no command line or configuration."""
    page = re.sub(r"(?s)<(style|script|svg)\b.*?</\1>", "", page)
    return re.sub(r"<[^>]*>", " ", page[:page.find("<h3>Origin")]).replace("&nbsp;", " ")


class Report(Case):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.run_path = os.path.join(self.folder.name, "run")
        os.mkdir(self.run_path)
        self.put("summary.json", json.dumps({"n_grain": 7, "porosity": {"hull": 0.4321}, "odd_m": 2.5e-6}))

    def put(self, name, text):
        with open(os.path.join(self.run_path, name), "w", encoding="utf-8") as file:
            file.write(text)

    def page(self, path):
        with open(path, encoding="utf-8") as file:
            return file.read()

    def test_one_run_gets_its_page_inside(self):
        result = clast("report", self.run_path, "--json")
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(result.json, {"n_run": 1, "output": os.path.join(self.run_path, "report.html")})
        page = self.page(result.json["output"])
        self.assertIn(">0.4321<", page)
        self.assertIn("2.500", page)
        self.assertNotIn("<script", page)  # no state.h5, no 3-D view, no script

    def test_an_aggregate_comes_with_charts_and_page(self):
        grown = os.path.join(self.folder.name, "grown")
        result = clast("aggregate", "--core", "sphere", "--core-size", "100um", "--coat", "sphere", "--size", "30um",
                       "--n-particle", "5", "--replicate", "5", "-q", "--picture=false", "-o", grown)
        self.assertEqual(result.code, 0, result.err)
        for name in ["history", "diameter", "density", "sizes"]:
            self.assertIn("<svg", self.page(os.path.join(grown, name + ".svg")))
        page = self.page(os.path.join(grown, "report.html"))
        for part in ["Porosity while the aggregate grows", 'class="view-data"', '"n_grain": 6,', "half-angle"]:
            self.assertIn(part, page)

    def test_runs_side_by_side_grow_to_their_own_ends(self):
        # the chart ended with the shorter run, as the band of one run's repeats does
        runs = []
        for n, envelope in ((4, "surface_hull"), (24, "sphere_hull")):
            runs.append(os.path.join(self.folder.name, f"grown{n}"))
            result = clast("aggregate", "--core", "sphere", "--core-size", "100um", "--coat", "sphere", "--size", "30um", "--envelope", envelope,
                           "--n-particle", n, "--replicate", n, "-q", "--picture=false", "-o", runs[-1])
            self.assertEqual(result.code, 0, result.err)
        both = os.path.join(self.folder.name, "both.html")
        result = clast("report", *runs, "-o", both, "--no-view")
        self.assertEqual(result.code, 0, result.err)
        chart = self.page(both).split("first envelope of each run")[1].split("</figure>")[0]
        ends = [max(float(x) for x in re.findall("[ML] ([0-9.]+)", path)) for path in re.findall('<path style="fill:none[^>]* d="([^"]*L[^"]*L[^"]*)"', chart)]
        self.assertAlmostEqual((ends[0] - 50.3) / (ends[1] - 50.3), 4 / 24, delta=0.01)

    def test_every_row_has_a_label_and_a_unit(self):
        # rows were named "Words" and "N run", and the history said 0.00027 in a column size_m
        self.put("summary.json", json.dumps({
            "words": "reached", "n_run": 208, "max_overlap": 1.69e-19, "z_low": 0.005, "odd_thing_m": 2.5e-6,
            "stress": {"stress_xx": 2.5e6}, "edge": {"packing": "loosest", "replicate": None}, "observables": {"size": {"observed": 6.35e-4, "pull": 1.15}}}))
        self.put("history.csv", "n,size_m,overlap_m,lost,mass_kg,what_is_it\n0,0.00027,0,0,1.6e-8,1\n1,4e-5,1.7e-19,1,1.7e-8,2\n")
        self.assertEqual(clast("report", self.run_path).code, 0)
        page = self.page(os.path.join(self.run_path, "report.html"))
        for part in ["<th>Conclusion</th>", "<th>Runs</th>", "&lt; 0.001", "<th><code>odd_thing_m</code></th>", "<h4>Contact stress</h4>",
                     ">Grain size <small>(\u00b5m)</small></th>", ">270.0<", ">40.00<", ">16.00<", "<code>what_is_it</code>", ">yes<",
                     "Aggregate diameter", "Bed evaluated from", "<td>loosest</td>"]:
            self.assertIn(part, page)
        text = seen(page)
        for unit in [r"5\.000\s+mm", r"2\.500\s+MPa", r"635\.0\s+\u00b5m"]:
            self.assertRegex(text, unit)
        for bad in ["Words", "N run", "odd thing", "what is it", "By envelope"]:
            self.assertNotIn(bad, text)
        self.assertNotRegex(text, r"\d(\.\d+)?e-\d+")

    def test_lengths_without_a_unit_stay_so(self):
        # a packing without a unit was 20.08 m high on its page, its pores 58 mm wide
        balls = os.path.join(self.folder.name, "balls.csv")
        with open(balls, "w", encoding="utf-8") as file:
            file.write("x,y,z,radius\n" + "".join(f"{x}.5,{y}.5,{z}.5,0.5\n" for x in range(4) for y in range(4) for z in range(4)))
        grains = [os.path.join(DATA, f"standin63/grain0{k}.ply") for k in range(4)]
        for words in [["porosity", balls, "--bed", "periodic:0,0,0,4,4,4", "--gap", "1e-6", "--local", "--pores", "64"],
                      ["shape", *grains]]:
            with self.subTest(words[0]):
                out = os.path.join(self.folder.name, words[0])
                made = clast(*words, "--statistics" if words[0] == "shape" else "-o", out, "-q")
                self.assertEqual(made.code, 0, made.err)
                self.assertEqual(clast("report", out).code, 0)
                page = self.page(os.path.join(out, "report.html"))
                text = seen(page)
                self.assertNotRegex(text, r"\d\s+(?:[mnc\u00b5]?m)(?:\u00b2|\u00b3)?(?!\w)|\((?:1/)?[mnc\u00b5]?m(?:\u00b2|\u00b3)?\)|SI units")
                self.assertEqual(re.findall(r"<(?:th|h4|summary)[^>]*><code>([^<]*)", page), [])
                if words[0] == "shape":  # grains were points, the least and greatest of the data limits
                    self.assertRegex(text, r"Results\s+Grains\s+4\b")
                    card = text[text.index("Quantities"):text.index("Principal components")]
                    self.assertRegex(card, r"Quantity\s+Grains\s+Mean, Value")
                    self.assertRegex(card, r"Excess kurtosis\s+Least\s")
                for name in os.listdir(out):
                    if name.endswith(".csv"):
                        head = self.page(os.path.join(out, name)).splitlines()[0]
                        self.assertNotRegex(head, r"_(1/)?m[23]?\b", name)
                self.assertRegex(self.page(os.path.join(out, "summary.json")), r'"unit": "model"')
        self.assertRegex(seen(self.page(os.path.join(self.folder.name, "porosity/report.html"))), r"4\.000\s+model units")
        # with a unit the sizes have it
        out = os.path.join(self.folder.name, "si")
        self.assertEqual(clast("shape", *grains, "--unit", "mm", "--statistics", out, "-q").code, 0)
        self.assertTrue(self.page(os.path.join(out, "factors.csv")).splitlines()[0].endswith(",size_m"))
        self.assertTrue(self.page(os.path.join(out, "histogram_size.csv")).startswith("low_m,high_m,count,density_1/m,normal_1/m"))

    def test_means_of_runs_have_the_units_of_what_they_are_of(self):
        # "Bed evaluated to: mean 0.02042" had none, and a deviation of 0 Pa was "0 GPa"
        spread = {"mean": 0.0204, "deviation": 1.5e-5, "low": 0.0203, "high": 0.0205}
        self.put("summary.json", json.dumps({"n_run": 2, "z_high": spread, "stress": {"stress_xx": {**spread, "mean": 271.0, "deviation": 0.0}}}))
        self.put("means.csv", "quantity,unit,mean,deviation,low,high\nz_high,m,0.0204,1.5e-5,0.0203,0.0205\nstress_xx,Pa,271,0,270,272\n")
        self.assertEqual(clast("report", self.run_path).code, 0)
        page = self.page(os.path.join(self.run_path, "report.html"))
        text = seen(page)
        # a row's numbers have one unit: "20.40 mm, 15.00 \u00b5m" and "0 kg" beside "97.05 \u00b5g" were read wrongly
        self.assertRegex(text, r"Bed evaluated to\s+Mean\s+20\.40\s+mm\s+Standard deviation\s+0\.01500\s+mm")
        self.assertRegex(text, r"Quantity[^|]*Bed evaluated to\s+20\.40\s+mm\s+0\.01500\s+mm\s+20\.30\s+mm")
        self.assertNotIn("GPa", text)
        self.assertEqual(re.findall(r"<(?:th|h4|summary)[^>]*><code>([^<]*)", page), [])

    def test_no_page_of_a_command_has_a_key_for_a_label(self):
        packed = os.path.join(self.folder.name, "packed")
        cube = ["--domain", "box:0,0,0,1,1,1"]
        runs = [
            ["pack", "--domain", "periodic", "--width", "40mm", "--height", "0.1m", "--curve", "6 mm", "--mass", "10g", "--max-steps", "4000"],
            ["pack", "--curve", "4mm", "--mass", "2g", "--domain", "cell", "--width", "16mm", "--height", "16mm", "--floor=no", "--gravity", "0", "--fluid-density", "0",
             "--load-rate", "4/s", "--seed", "3", "--stages", "isotropic 20kPa until rest", "--max-steps", "600", "--energy"],
            ["pack", "--curve", "4mm", "--mass", "6g", "--width", "24mm", "--height", "80mm", "--fluid-density", "0", "--shaking-time", "0", "--shake-amplitude", "0"],
            ["porosity", os.path.join(self.folder.name, "2"), "--bed", "cylinder:11.5mm", "--pores", "20", "--chains", "--fields", "10mm"],
            ["porosity", packed, "--trim", "1mm", "--local", "--pores", "20"],
            ["decompose", os.path.join(DATA, "d2sd/points_b3_n500.csv"), *cube, "--beta-dt", "1e-6", "--sizes", "2"],
            ["decompose", os.path.join(DATA, "d2sd/points_s2_n500.csv"), "--domain", "box:0,0,1,1", "--pairs"],
            ["agglomerate", "--box-model", "--concentration", "1e12", "--constant", "1e-12", "--duration", "2s", "--n-step", "2", "--particles", "100"],
            ["agglomerate", os.path.join(DATA, "d2sd/points_u3_n50.csv"), *cube, "--constant", "0.02", "--duration", "2", "--n-step", "2"],
            ["evolve", "--domain", "box:0,0,0,1mm,1mm,5mm", "--particles", "300", "--curve", "lognormal:20um,8um,9um,50um", "--kernel", "settling",
             "--weight", "9", "--duration", "0.5s", "--rows", "5", "--keep", "2", "--out-of-range", "extrapolate"],
            ["aggregate", "--core", "sphere", "--core-size", "100um", "--coat", "sphere", "--size", "30um", "--n-particle", "5",
             "--replicate", "5", "--repeats", "2", "--picture=false", "--envelope", "surface_hull", "--envelope", "sphere_rays"],
        ]
        for k, words in enumerate(runs):
            with self.subTest(" ".join(words[:1])):
                run = packed if k == 0 else os.path.join(self.folder.name, str(k))
                made = clast(*words, "-q", "-o", run)
                self.assertEqual(made.code, 0, made.err)
                self.assertEqual(clast("report", run).code, 0)
                page = self.page(os.path.join(run, "report.html"))
                self.assertEqual(re.findall(r"<(?:th|h4|summary)[^>]*><code>([^<]*)", page), [])
                self.assertEqual(re.findall(r"<t[dh][^>]*><code>([a-z_0-9]+)</code>", page.split("Configuration")[0]), [])  # normal_1, width_m, ..
                text = seen(page)
                self.assertNotRegex(text, r"\d(\.\d+)?e-\d+|\b(nan|inf|true(?! surface)|false)\b")
                if "--load-rate" in words:
                    self.assertRegex(text, r"Stress, with that of motion\s+Fabric\s+xx\s+[-.\d]+\s+[kM]?Pa")
                    self.assertRegex(text, r"Cell along x\s+[.\d]+\s+mm")
                if "--bed" in words:
                    self.assertIn("Bulk porosity (of a part of the packing)", re.sub(r"\s+", " ", text))
                    self.assertRegex(text, r"Farthest that one is beyond them\s+\d+\.\d+\s+\S*m\s+Their solid beyond the sides\s+\d+\.\d+\s+\S*m\u00b3")
                if "--box-model" in words:  # they were "Particles placed" and bare numbers
                    self.assertRegex(text, r"Number density\s+3\s+1\s+1\.000\s\u00d7\s10\u00b9\u00b2\s+1/m\u00b3")
                    self.assertRegex(text, r"Collisions since the start that stuck\s+3\s+1\s+0\s+1/m\u00b3")
                    self.assertRegex(text, r"M0: particles\s+\(1/m\u00b3\)")
                    self.assertNotIn("Particles placed", text)
                if words[0] == "evolve":  # were "Points tested"
                    self.assertRegex(text, r"Times that cells were tested for uniformity\s+\d")

    def test_frames_are_the_views_moments(self):
        run = os.path.join(self.folder.name, "framed")
        made = clast("pack", "--curve", "6mm", "--mass", "2g", "--width", "30mm", "--height", "40mm", "--shaking-time", "0.01s", "--frame-time", "10ms", "-q", "-o", run)
        self.assertEqual(made.code, 0, made.err)
        with open(os.path.join(run, "frames.pvd"), encoding="utf-8") as file:
            listed = re.findall(r'timestep="([^"]*)"[^>]*file="([^"]*)"', file.read())
        self.assertEqual(clast("report", run).code, 0)
        view = json.loads(re.search(r'class="view-data">(.*?)</script>', self.page(os.path.join(run, "report.html")), re.S).group(1))
        self.assertEqual([frame["time"] for frame in view["frames"]["frame"]], [float(time) for time, _ in listed])
        self.assertEqual(view["frames"]["n_file"], len(listed))
        for _, name in listed:  # texts as clast 0.1.0 had them; the page is made of the same names
            path = os.path.join(run, name)
            with open(path, "rb") as file:
                old, n = re.subn(rb'<DataArray type="UInt8" (Name="(?:unit|shape_names)") NumberOfTuples="\d+" format="ascii">([\d ]+)</DataArray>',
                                 rb'<Array type="String" \1 NumberOfTuples="1" format="ascii">\2</Array>', file.read())
            self.assertEqual(n, 2)
            with open(path, "wb") as file:
                file.write(old)
        self.assertEqual(clast("report", run).code, 0)
        again = json.loads(re.search(r'class="view-data">(.*?)</script>', self.page(os.path.join(run, "report.html")), re.S).group(1))
        self.assertEqual(again["frames"], view["frames"])
        os.remove(os.path.join(run, listed[0][1]))  # to save room: the others are shown
        self.assertEqual(clast("report", run).code, 0)
        view = json.loads(re.search(r'class="view-data">(.*?)</script>', self.page(os.path.join(run, "report.html")), re.S).group(1))
        self.assertEqual(len(view["frames"]["frame"]), len(listed) - 1)
        os.truncate(os.path.join(run, listed[1][1]), 900)  # within the poses
        damaged = clast("report", run)
        self.assertEqual((damaged.code, damaged.err.count("\n")), (3, 1), damaged.err)
        with open(os.path.join(run, "frames.pvd"), "w", encoding="utf-8") as file:
            file.write('<DataSet timestep="0.1" part="0" file="frames/frame-../../secret.vtu"/>')
        outside = clast("report", run)
        self.assertEqual(outside.code, 3)
        self.assertIn("entry 1 is no frame of this run", outside.err)

    def test_wide_tables_stand_in_stripes(self):
        head = ",".join(["run", *(f"number_{k}" for k in range(23))])
        self.put("wide.csv", head + "\n" + "\n".join(",".join([f"r{i}", *(str(i * k) for k in range(23))]) for i in range(3)) + "\n")
        self.assertEqual(clast("report", self.run_path).code, 0)
        page = self.page(os.path.join(self.run_path, "report.html"))
        part = page[page.index("wide"):]
        tables = re.findall(r"<table>(.*?)</table>", part, re.S)[:3]
        self.assertEqual([t.count("<th") for t in tables], [9, 9, 8])
        self.assertEqual([t.count("r2</td>") for t in tables], [1, 1, 1])

    def test_folders_without_a_summary_have_pages_too(self):
        # fit, predict and study have tables and a manifest; their folders were "no run folder"
        beds = os.path.join(self.folder.name, "beds.csv")
        with open(beds, "w", encoding="utf-8") as file:
            file.write("flatness,elongation,porosity\n" + "".join(
                f"{0.4 + 0.01 * (k % 30)},{0.5 + 0.013 * (k * 7 % 29)},{0.36 + 0.001 * (k * 5 % 17)}\n" for k in range(40)))
        made = os.path.join(self.folder.name, "made")
        for words, parts in [(["predict", beds], ["<h1>made</h1>", "Standard error, of the model", "Within the model"]),
                             (["fit", beds], ["Terms of the model", "Flatness S/I, inverse"]),
                             (["study", "--run", "predict", "--argument", beds, "--vary", "seed=1|2"], ["Results of the runs", "clast study"])]:
            with self.subTest(words[0]):
                out = made + words[0]
                self.assertEqual(clast(*words, "-q", "-o", out).code, 0)
                self.assertEqual(clast("report", out, "--title", "made").code, 0)
                page = self.page(os.path.join(out, "report.html"))
                for part in [*parts[1:], "<h1>made</h1>"]:
                    self.assertIn(part, page)
                self.assertEqual(re.findall(r"<(?:th|h4|summary)[^>]*><code>([^<]*)", page), [])
                self.assertNotIn("origin unknown", page)
                self.assertNotRegex(seen(page), r"\d(\.\d+)?e-\d+|\b(nan|inf|true|false)\b")

    def side_by_side(self, *runs):
        """The table of several runs: heads, and a row of cells for each."""
        folders = []
        for k, (command, summary) in enumerate(runs):
            folder = os.path.join(self.folder.name, f"run{k}")
            os.mkdir(folder)
            for name, what in (("summary", summary), ("manifest", {"command": command})):
                with open(os.path.join(folder, f"{name}.json"), "w", encoding="utf-8") as file:
                    json.dump(what, file)
            folders.append(folder)
        out = os.path.join(self.folder.name, "all.html")
        self.assertEqual(clast("report", *folders, "-o", out).code, 0)
        page = self.page(out)
        part = page[page.index("Side by side"):page.index("</section>")]
        rows = [[re.sub(r"<[^>]+>", " ", cell).split() for cell in re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row, re.S)]
                for row in re.findall(r"<tr>(.*?)</tr>", part, re.S)]
        return [[" ".join(cell) for cell in row] for row in rows]

    def test_side_by_side_has_one_number_a_cell(self):
        """A history of 31 numbers filled a cell, two columns had one name, and runs without large figures an empty table."""
        rows = self.side_by_side(("decompose", {"n_cell": 127, "events": 0.5}), ("agglomerate", {"n_cell": [1, 1, 365, 470], "events": [0, 21, 42, 66]}))
        self.assertEqual(rows, [["Run", "Cells", "Agglomeration events", "Cells at the end", "Agglomeration events at the end"],
                                ["run0", "127", "0.5000", "\u2013", "\u2013"], ["run1", "\u2013", "\u2013", "470", "66"]])

    def test_side_by_side_has_no_two_columns_of_one_name(self):
        rows = self.side_by_side(("pack", {"porosity_bulk": 0.4284}), ("porosity", {"bulk": 0.4288}))
        self.assertEqual(rows[0], ["Run", "Bulk porosity by clast pack", "Bulk porosity by clast porosity"])

    def test_what_a_command_warned_of_is_said_beside_its_large_numbers(self):
        """549149 of unresolved points stood bare, in 1/m^d, beside 2-D numbers, and a porosity of a bed that still moved."""
        unresolved = {"pair_integral": 549149, "pair_integral_low": 394362, "pair_integral_high": None, "resolved": False}
        rows = self.side_by_side(("decompose", {**unresolved, "pair_integral_unit": "1/m^3"}),
                                 ("decompose", {**unresolved, "pair_integral_unit": "1/m^2", "resolved": True}),
                                 ("pack", {"porosity_bulk": 0.4703, "still_moving": True, "shaken_while_falling": False, "coordination": 2.0}))
        none = "\u2013"
        self.assertEqual(rows, [["Run", "Pair integral, events per beta dt", "Bulk porosity", "Coordination number"],
                                ["run0", "\u2265 394362 1/m\u00b3 not resolved", none, none], ["run1", "549149 1/m\u00b2", none, none],
                                ["run2", none, "0.4703 still moving", "2"]])
        self.put("summary.json", json.dumps({**unresolved, "pair_integral_unit": "1/m^3", "porosity_bulk": 0.47, "shaken_while_falling": True,
                                             "domain_volume": 2.5, "domain_volume_unit": "m^2", "unit": "m"}))
        self.assertEqual(clast("report", self.run_path).code, 0)
        page = re.sub(r"\s+", " ", seen(self.page(os.path.join(self.run_path, "report.html"))))
        for part in ("\u2265 394362 1/m\u00b3 Pair integral, events per beta dt (not resolved)", "Bulk porosity (shaken while grains fell)",
                     "Pair integral, lower end of the 95 % interval 394362 1/m\u00b3", "2.500 m\u00b2", "Unit of lengths in these results m"):
            self.assertIn(part, page)
        self.assertNotIn("1/m^d", page)

    def test_box_models_and_fits_have_figures_side_by_side(self):
        model = {"unit_n": "1/m^3", "n_particle": [4.0, 2.0], "events": [0.0, 2.0]}
        self.assertEqual([row[1] for row in self.side_by_side(("agglomerate", model), ("agglomerate", {**model, "n_particle": [4.0, 3.0]}))],
                         ["Number density at the end", "2.000 1/m\u00b3", "3.000 1/m\u00b3"])

    def test_a_page_of_fit_names_its_own_tables(self):
        """Models tried were "Rays times orientations", the step of the selection a "Time step"."""
        self.put("summary.json", json.dumps({"r2": 0.28, "n_bed": 16, "trials": [{"feature": "friction", "step": 1, "r2": 0.2}]}))
        self.put("manifest.json", json.dumps({"command": "fit"}))
        self.assertEqual(clast("report", self.run_path).code, 0)
        page = seen(self.page(os.path.join(self.run_path, "report.html")))
        for words in ("Models tried", "Features in the model", "R\u00b2"):
            self.assertIn(words, page)
        for words in ("Rays", "Time step"):
            self.assertNotIn(words, page)

    def test_a_users_own_columns_keep_their_names(self):
        """mass was "Mass (kg)", time "Simulated time (s)", length_m 0.89 "Length: 891.7 mm" and a "Quantity"."""
        beds = os.path.join(self.folder.name, "beds.csv")
        with open(beds, "w", encoding="utf-8") as file:
            file.write("porosity,mass,length_m,time,a,mean_flatness\n" + "".join(
                f"{0.36 + 0.001 * (k * 5 % 17)},{1.5 + k * 7 % 13},{0.1 + 0.013 * (k * 7 % 29)},{k * 3 % 11},{k * 11 % 23},{0.5 + 0.01 * (k * 13 % 19)}\n"
                for k in range(24)))
        out = os.path.join(self.folder.name, "model")
        made = clast("fit", beds, "--columns", "mass,length_m,time,a,mean_flatness", "--features", "columns", "-q", "-o", out)
        self.assertEqual(made.code, 0, made.err)
        self.assertEqual(clast("report", out).code, 0)
        page = self.page(os.path.join(out, "report.html"))
        tables = {name: part for part, name in re.findall(r"(?s)<summary>[^<]* <small>[^<]*rows?</small></summary>(.*?)<a href=\"(\w+).csv", page)}
        self.assertEqual(re.findall(r"<th[^>]*>(.*?)</th>", tables["features"]),
                         ["Row", "Porosity", "<code>mass</code>", "<code>length_m</code>", "<code>time</code>", "<code>a</code>", "Flatness S/I, mean"])
        first = re.findall(r'<td class="n">(.*?)</td>', tables["features"])
        self.assertEqual(first[:7], ["1", "0.3600", "1.500", "0.1000", "0", "0", "0.5000"])
        names = set(re.findall(r"<td>(.*?)</td>", tables["ranking"]))
        self.assertLessEqual({"<code>mass</code>", "<code>length_m</code>", "<code>time</code>", "<code>a</code>", "Flatness S/I, mean"}, names)
        self.assertIn("<td>Intercept</td>", tables["terms"])
        text = seen(page)
        for words in ("Mass", "(kg)", "Length", "Simulated", "Quantity", "SI units"):
            self.assertNotIn(words, text)

    def test_a_models_terms_have_the_units_of_their_features(self):
        """A unit was headed "Unit of lengths in these results", a coefficient in 1/m and the limits had none."""
        beds, out = os.path.join(self.folder.name, "beds.csv"), os.path.join(self.folder.name, "model")
        with open(beds, "w", encoding="utf-8") as file:
            file.write("d50,speed,clay,porosity\n" + "".join(
                f"{2 + 0.1 * (k * 5 % 17):.1f}mm,{k * 7 % 13}m/s,{0.01 * (k * 3 % 11)},{0.3 + 0.01 * (k * 5 % 17) + 0.002 * (k * 7 % 13)}\n" for k in range(24)))
        self.assertEqual(clast("fit", beds, "--use", "d50,speed,clay", "--n-permutation", 0, "-q", "-o", out).code, 0)
        self.assertEqual(clast("report", out).code, 0)
        page = self.page(os.path.join(out, "report.html"))
        text = re.sub(r"\s+", " ", seen(page))
        self.assertNotIn("Unit of lengths", text)
        self.assertEqual(text.count("Terms of the model"), 1)  # there was a list, too
        self.assertRegex(text, r"d50 100\.0 1/m [^a-z]*1/m .*? 2\.000 mm 3\.600 mm speed 0\.002000 s/m")
        self.assertRegex(text, r"Row Porosity d50 \(mm\) speed \(m/s\) clay 1 0\.3000 2\.000 0 0")

    def test_what_varied_in_a_study_keeps_its_name(self):
        """A column of texts was headed "Half-angle of the cone (\u00b0)" above "20 deg", one of numbers "Rays tried"."""
        out = os.path.join(self.folder.name, "many")
        made = clast("study", "--run", "aggregate", "--fix", "core=sphere", "--fix", "core_size=100um", "--fix", "coat=sphere", "--fix", "size=30um",
                     "--fix", "replicate=3", "--fix", "picture=false", "--vary", "cone=20 deg|40 deg", "--vary", "rays=1|2", "-q", "-o", out)
        self.assertEqual(made.code, 0, made.err)
        self.assertEqual(clast("report", out).code, 0)
        page = self.page(os.path.join(out, "report.html"))
        heads = re.findall(r"<th[^>]*>(.*?)</th>", page)
        self.assertNotIn("Half-angle", seen(page))
        self.assertNotIn("Rays tried", heads)
        for head in ("<code>cone</code>", "<code>rays</code>", "Run", "Seed", "Exit code", "Aggregate diameter <small>(\u00b5m)</small>"):
            self.assertIn(head, heads)

    def study_page(self, results, plan="run,mass,seed\n1,300mg,1\n2,300mg,1\n3,1,1\n4,1,1\n"):
        """What a reader sees of a study with these results."""
        if os.path.exists(os.path.join(self.run_path, "summary.json")):
            os.remove(os.path.join(self.run_path, "summary.json"))
        for name, text in (("study.json", "{}"), ("plan.csv", plan), ("results.csv", results)):
            self.put(name, text)
        self.assertEqual(clast("report", self.run_path).code, 0)
        return re.sub(r"\s+", " ", seen(self.page(os.path.join(self.run_path, "report.html"))))

    def test_a_studys_page_tells_what_became_of_its_runs(self):
        """Runs that failed were done, a study without one done had no word, one that another shard was at was stopped."""
        rest = "; the same clast study command goes on with the rest"
        again = "; the same clast study command tries them again"
        for codes, notes in (((0, 1), []), ((0, 137), ["1 of 2 runs failed (exit code 137)" + again]),
                             ((2, 137, 2, ""), ["3 of 4 runs failed (exit codes 2, 137)" + again, "stopped: 0 of 4 runs are done" + rest]),
                             ((5, 0), ["1 of 2 runs ended without converging (exit code 5)"]),
                             ((5, 0, ""), ["1 of 3 runs ended without converging (exit code 5)", "stopped: 1 of 3 runs are done" + rest]),
                             (("", ""), ["stopped: 0 of 2 runs are done" + rest])):
            with self.subTest(codes):
                text = self.study_page("run,mass,exit_code\n" + "".join(f"{k + 1},300mg,{code}\n" for k, code in enumerate(codes)))
                for note in notes:
                    self.assertIn(note, text)
                self.assertEqual(len(re.findall(r"\d of \d runs", text)), len(notes))
        self.assertIn("stopped: 0 of 2 runs are done" + rest, self.study_page("run,mass\n1,300mg\n2,300mg\n"))

        results = "run,mass,exit_code\n1,300mg,0\n2,300mg,\n3,1,137\n4,1,\n"
        os.mkdir(os.path.join(self.run_path, "runs"))
        with open(os.path.join(self.run_path, "runs/000004.lock"), "w", encoding="utf-8") as lock:
            self.assertIn("stopped: 1 of 4 runs", self.study_page(results))  # left by one that was killed
            fcntl.flock(lock, fcntl.LOCK_EX)
            text = self.study_page(results)
        self.assertIn("under way: 1 of 4 runs were done when results.csv was written", text)
        self.assertIn("1 of 4 runs failed (exit code 137) ", text)
        for words in ("stopped", "the same clast study"):
            self.assertNotIn(words, text)
        self.assertEqual(os.listdir(os.path.join(self.run_path, "runs")), ["000004.lock"])  # asked, not taken

    def test_what_came_of_a_varied_name_has_label_and_unit(self):
        """result.mass, beside a varied mass, was a bare key without a unit, and 300mg in SI units."""
        text = self.study_page("run,mass,seed,exit_code,result.mass\n1,300mg,1,0,3.552e-4\n2,200mg,1,0,2e-4\n3,1g,1,0,1e-3\n4,2g,1,0,2e-3\n")
        self.assertRegex(text, r"Run mass Seed Exit code Mass \(g\) 1 300mg 1 0 0\.3552 ")
        self.assertRegex(text, r"All rows of results\.csv ?, there in SI units but for what varied\.")
        self.assertRegex(self.study_page("run,seed,exit_code\n1,1,0\n", "run,seed\n1,1\n"), r"results\.csv ?, there in SI units\.")

    def test_runs_of_one_name_are_told_apart_by_their_paths(self):
        """clast report STUDY/runs/*/out: eight runs, all called out."""
        names = ["a/runs/000001/out", "a/runs/000002/out", "b"]
        folders = [os.path.join(self.folder.name, name) for name in names]
        for folder in folders:
            os.makedirs(folder)
            with open(os.path.join(folder, "summary.json"), "w", encoding="utf-8") as file:
                json.dump({"n_grain": 7, "porosity": 0.4}, file)
        out = os.path.join(self.folder.name, "all.html")
        for given, shown in ((folders, ["000001/out", "000002/out", "b"]), (folders[:1] * 2, ["out", "out"]),
                             ([folders[2], folders[0] + "/"], ["b", "out"])):
            with self.subTest(shown):
                self.assertEqual(clast("report", *given, "-o", out).code, 0)
                page = self.page(out)
                self.assertIn(f"<h1>{len(shown)} runs: {shown[0]} to {shown[-1]}</h1>", page)
                self.assertEqual(re.findall(r'<a href="#run-\d">([^<]*)', page), shown)
                self.assertEqual(re.findall(r'id="run-\d">\s*<h2>([^<]*)', page), shown)

    def test_a_studys_page_tells_the_versions_of_its_runs(self):
        beds = os.path.join(self.folder.name, "beds.csv")
        with open(beds, "w", encoding="utf-8") as file:
            file.write("flatness,elongation\n0.6,0.7\n0.5,0.8\n")
        version = clast("--version").out.split()[1]
        for command, argument in (("predict", beds), ("shape", os.path.join(DATA, "standin63/grain00.ply"))):
            with self.subTest(command):
                out = os.path.join(self.folder.name, command)
                vary = "seed=1|2|3" if command == "predict" else "axes=feret|fitted"
                made = clast("study", "--run", command, "--argument", argument, "--vary", vary, "-q", "-o", out)
                self.assertEqual(made.code, 0, made.err)
                self.assertEqual(clast("report", out).code, 0)
                page = self.page(os.path.join(out, "report.html"))
                self.assertIn(f"clast study \u00b7 version {version} \u00b7", page)
                self.assertIn(f"<th>Version of clast</th><td>{version}</td>", page)
                with open(argument, "rb") as file:  # what its runs read
                    self.assertIn(hashlib.sha256(file.read()).hexdigest(), page)
                study = os.path.join(out, "study.json")
                record = json.loads(self.page(study))
                record["clast_versions"] = ["9.8.7", version]
                with open(study, "w", encoding="utf-8") as file:
                    json.dump(record, file)
                if command == "predict":  # its runs have manifests, which tell more
                    manifest = os.path.join(out, "runs/000002/out/manifest.json")
                    text = self.page(manifest).replace(f'"clast_version": "{version}"', '"clast_version": "9.8.7"')
                    with open(manifest, "w", encoding="utf-8") as file:
                        file.write(text)
                self.assertEqual(clast("report", out).code, 0)
                page = self.page(os.path.join(out, "report.html"))
                several = f"{version} (2 runs), 9.8.7 (1 run)" if command == "predict" else f"9.8.7, {version}"
                self.assertIn(f"clast study \u00b7 version {several} \u00b7", page)
        del record["clast_versions"], record["inputs"]  # as an older clast had it
        with open(study, "w", encoding="utf-8") as file:
            json.dump(record, file)
        self.assertEqual(clast("report", out).code, 0)
        self.assertIn("clast study \u00b7 version not recorded \u00b7", self.page(os.path.join(out, "report.html")))

    def test_two_runs_need_a_name(self):
        self.assert_fails(2, "report", self.run_path, self.run_path, says=["-o NAME.html", "2 runs"])

    def test_pages_are_html(self):
        self.assert_fails(2, "report", self.run_path, "-o", os.path.join(self.folder.name, "a.pdf"), says=["a.pdf", "written as .html"])

    def test_a_level_bed_is_not_called_at_rest(self):
        """converged was "At rest by the rule: yes", above "Still moving at the end: yes"."""
        self.put("summary.json", json.dumps({"phase": "done", "converged": True, "still_moving": True}))
        self.assertEqual(clast("report", self.run_path).code, 0)
        page = re.sub(r"\s+", " ", seen(self.page(os.path.join(self.run_path, "report.html"))))
        self.assertIn("Ended by its rule yes", page)
        self.assertNotIn("At rest", page)

    def test_title_is_the_users(self):
        out = os.path.join(self.folder.name, "a.html")
        self.assertEqual(clast("report", self.run_path, self.run_path, "-o", out, "--title", "A & B").code, 0)
        self.assertIn("<h1>A &amp; B</h1>", self.page(out))

    def test_folder_without_summary_is_bad_input(self):
        os.remove(os.path.join(self.run_path, "summary.json"))
        self.assert_fails(3, "report", self.run_path, says=["has no summary.json"])

    def test_missing_folder_is_bad_input(self):
        self.assert_fails(3, "report", "no/such", says=["no/such"])

    def test_unwritable_output_leaves_no_file(self):
        self.assert_fails(4, "report", self.run_path, "-o", os.path.join(self.folder.name, "no/such/a.html"),
                          says=["no/such"])


if __name__ == "__main__":
    unittest.main()
