"""The room Pour of clast-live.html: a bed is poured in short runs and ends as the one that the named command pours at once."""
import json

import page

SMALL = {"size": "4mm", "mass": "2g", "width": "20mm", "height": "30mm", "shaking_time": "0.01s"}


class Pour(page.Live):
    room, flags = "pour", page.browser.WEBGL

    def same(self, code=0):
        """The command's state hash is the page's."""
        with page.Folder() as folder:
            self.assertEqual(json.loads(self.command(folder, ("--json",)))["state_hash"], self.text("pour-hash"))

    def test_a_bed_comes_to_rest_and_the_command_pours_the_same(self):
        self.set(**SMALL)
        self.run_room()
        self.assertEqual(self.text("pour-error"), "")
        self.assertRegex(self.text("pour-state"), "^the bed is (at rest|level)")
        self.assertGreater(self.browser.value("rooms.pour.frames.length"), 2, "pictures while it falls")
        self.same()
        porosity = self.browser.value("rooms.pour.result.json.porosity_bulk")
        with page.Folder() as folder:
            self.unzipped(folder)
            found = json.loads(self.native(folder, "porosity", "bed", "--json"))
            self.assertAlmostEqual(found["bulk"], porosity, delta=1e-12)
            self.native(folder, "report", "bed", "-o", "page.html")
            self.same_colours(folder / "page.html")

    def test_it_is_stopped_at_once_and_goes_on(self):
        self.set(**{**SMALL, "mass": "6g"})
        self.click("#pour-run")
        self.until("rooms.pour.result", 30)
        self.assertEqual(self.at_once("rooms.pour.cancel()", "document.getElementById('pour-state').textContent"), "stopped")
        self.assertIn("--max-steps", self.text("pour-command"))
        self.same()
        self.until("rooms.pour.engine.isReady", 30)
        self.click("#pour-goon")
        self.until("!rooms.pour.running", 120)
        self.assertEqual(self.text("pour-error"), "")
        self.assertNotIn("--max-steps", self.text("pour-command"))
        self.same()

    def test_a_limit_of_steps_is_a_whole_number(self):
        """A limit beyond that of the command was none."""
        for text, wanted in (("+300", True), ("3e2", True), ("300.", True), ("1e17", False), ("0x10", False), ("2.5", False), ("many", False)):
            with self.subTest(text):
                self.set(**SMALL, max_steps=text)
                self.run_room()
                self.assertEqual(self.text("pour-error") == "", wanted, self.text("pour-error"))
                self.assertEqual(self.browser.value("document.getElementById('pour-result').hidden"), not wanted)

    def test_step_by_step_and_back(self):
        self.set(**SMALL, pace="step")
        self.click("#pour-run")
        for k in (1, 2, 3):
            self.until(f"rooms.pour.result && rooms.pour.result.json.n_step === {200 * k} && Boolean(rooms.pour.proceed)", 30)
            self.click("#pour-step")
        self.until("rooms.pour.result.json.n_step === 800 && Boolean(rooms.pour.proceed)", 30)
        self.browser.value("rooms.pour.cancel()")
        self.until("!rooms.pour.running", 10)
        self.browser.value("(() => { const s = document.getElementById('pour-moment'); s.value = 1; s.dispatchEvent(new Event('input')); })()")
        self.assertEqual(self.text("pour-when"), "at 2 ms of the simulation")
        self.same()

    def test_a_limit_of_steps_among_more_options_counts_as_in_a_terminal(self):
        """It was overruled by each slice's own, and stayed in the command beside it."""
        for more, steps, n in (("--max-steps 700", "", 700), ("--energy --max_steps=900", "300", 900), ("--max-steps 1.5e3 --energy", "", 1500)):
            with self.subTest(more):
                self.set(**SMALL, max_steps=steps, more=more)
                self.run_room()
                self.assertEqual(self.text("pour-error"), "")
                self.assertEqual(self.browser.value("rooms.pour.result.json.n_step"), n)
                self.assertEqual(self.text("pour-command").count("max"), 1)
                self.assertIn(f"--max-steps {n}", self.text("pour-command"))
                self.same()
        self.drop("limit.yaml", b"max_steps: 800\n")
        for more, steps, n in (("--set max_steps=700", "", 700), ("--set=max-steps=900 --energy", "300", 900), ("limit.yaml", "", 800), ("limit.yaml", "500", 500)):
            with self.subTest(more):  # the bed came to rest, and its command stopped before
                self.set(**SMALL, max_steps=steps, more=more)
                self.run_room()
                self.assertEqual(self.text("pour-error"), "")
                self.assertEqual(self.browser.value("rooms.pour.result.json.n_step"), n)
                self.same()
        self.set(**SMALL, max_steps="0", more="limit.yaml")
        self.run_room()
        self.assertEqual(self.browser.value("rooms.pour.result.json.phase"), "done")
        self.same()
        for more, steps in (("--max-steps many", ""), ("", "many"), ("--max-steps", "5"), ("--max-steps -3", ""), ("", "2.5")):
            with self.subTest(more + steps):
                self.set(**SMALL, max_steps=steps, more=more)
                self.run_room()
                self.assertRegex(self.text("pour-error"), "^clast pack: .*max.steps")

    def test_forms_and_curves(self):
        for values in ({"curve": "uniform", "shape": "ellipsoid"}, {"curve": "lognormal", "shape": "grain31.ply", "spread": "10", "height": "60mm"}):
            with self.subTest(values):
                self.set(**{**SMALL, **values}, max_steps="3000")
                self.run_room()
                self.assertEqual(self.text("pour-error"), "")
                self.same()

    def test_a_sieve_curve_is_dropped_and_a_bad_one_is_refused(self):
        self.drop("curve.csv", b"size_mm,passing_percent\n2,0\n4,60\n5,100\n")
        self.assertEqual(self.browser.value("rooms.pour.value('curve')"), "curve.csv")
        self.set(**{k: v for k, v in SMALL.items() if k != "size"}, max_steps="400")
        self.run_room()
        self.assertEqual(self.text("pour-error"), "")
        for name, content in (("a.csv", b""), ("<b>.csv", b"\0\xff" * 50), ("--x.csv", b"size_mm,passing_percent\n2,nan\n")):
            with self.subTest(name):
                self.drop(name, content)
                self.run_room()
                self.assertRegex(self.text("pour-error"), "^clast pack: ")

    def test_the_view_says_how_many_grains_it_shows(self):
        """It went on saying how many there were in its first picture."""
        self.set(**SMALL, max_steps="2000", curve="uniform", shape="ellipsoid")
        self.run_room()
        n = self.browser.value("rooms.pour.result.json.n_grain")
        self.assertGreater(n, 1)
        self.assertIn(f"3-D view of {n} grains.", self.browser.value("document.querySelector('#pour-view .view-stage').getAttribute('aria-label')"))

    def test_undo_and_a_link(self):
        self.set(**SMALL, max_steps="600")
        self.run_room()
        digest, word = self.text("pour-hash"), self.browser.value("packed(rooms.pour.snapshot())")
        self.set(mass="9g")
        self.click("#pour-undo")
        self.assertEqual(self.browser.value("rooms.pour.value('mass')"), "2g")
        self.open(f"pour={word}")
        self.run_room()
        self.assertEqual(self.text("pour-hash"), digest)

    def test_what_the_command_warns_of_is_shown(self):
        self.set(**{**SMALL, "size": "10mm", "mass": "0.2g"}, max_steps="600")
        self.run_room()
        self.assertEqual(self.text("pour-error"), "")
        self.assertRegex(self.text("pour-said"), "warning +6.94 times the mass that was asked for")
        self.assertEqual(self.text("pour-state"), "stopped, with a warning of the command below")

    def test_a_published_curve_that_is_too_large_says_so(self):
        """How many grains it has was not known, and 224,000 began."""
        self.set(curve="U7", mass="100kg", width="500mm", height="2m")
        self.run_room()
        self.assertRegex(self.text("pour-error"), r"^about 220,000 grains .* in a terminal: clast pack ")

    def test_a_size_of_nothing_is_the_commands_own_line(self):
        """About \u221e grains were more than a page takes."""
        self.set(**{**SMALL, "size": "0mm"})
        self.run_room()
        self.assertRegex(self.text("pour-error"), "^clast pack: .* size of 0 mm")

    def test_a_configuration_is_no_shape(self):
        """It became the grains' form, and the form had to be set back."""
        self.drop("bed.yaml", b"friction: 0.3\n")
        self.assertEqual(self.browser.value("rooms.pour.value('shape')"), "sphere")
        self.assertRegex(self.text("pour-error"), "^bed.yaml is a configuration")
        self.set(**SMALL, friction="", max_steps="400", more="bed.yaml")
        self.run_room()
        self.assertEqual(self.text("pour-error"), "")
        self.same()

    def test_a_scene_that_is_too_large_says_so(self):
        self.set(size="1mm", mass="1kg")
        self.run_room()
        self.assertRegex(self.text("pour-error"), r"about 720,000 grains .* in a terminal: clast pack ")

    def test_memory_is_steady(self):
        self.set(**SMALL, max_steps="2000")
        used = []
        for _ in range(10):
            self.run_room()
            used.append(self.memory())
        self.assertLess(used[-1], 1.2 * used[2] + 4e6, used)


class WithoutWebGL(page.Live):
    room, flags = "pour", page.browser.NO_WEBGL

    def test_charts_and_tables_are_there(self):
        self.set(**SMALL, max_steps="3000")
        self.run_room()
        self.assertEqual(self.text("pour-error"), "")
        self.assertIn("WebGL", self.text("pour-view"))
        self.assertEqual(self.browser.value("document.querySelectorAll('#pour-level polyline').length"), 2)
        self.assertGreater(self.browser.value("document.querySelectorAll('#pour-numbers tr').length"), 5)


if __name__ == "__main__":
    page.main()
