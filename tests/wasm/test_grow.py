"""The room Grow of clast-live.html: an aggregate grows before the eyes, and the command that the page names grows the same."""
import hashlib
import time

import jobs
import page

STL = sorted((jobs.ROOT / "data/shapes").rglob("*.stl"))


class Grow(page.Live):
    room, flags = "grow", page.browser.WEBGL

    def grow(self, **values):
        self.set(replicate="12", rays="2", orientations="2", **values)
        self.run_room()
        self.assertEqual(self.text("grow-error"), "")

    def test_the_command_grows_the_same_and_the_zip_is_a_run(self):
        self.browser.value("window.seen = []; rooms.grow.hear = function(name, bytes) { GrowRoom.prototype.hear.call(this, name, bytes); "
                           "if (name.endsWith('.h5')) seen.push(new State(bytes).table('history').n.length); }")
        self.grow()
        self.assertEqual(self.browser.value("seen.slice(0, 12)"), list(range(2, 14)))  # rows: the core's, then a grain each
        with page.Folder() as folder:
            self.command(folder)
            self.assertEqual(hashlib.sha256((folder / "aggregate/history.csv").read_bytes()).hexdigest(), self.text("grow-hash"))
            native = self.native(folder, "export", "aggregate", "-o", "native.csv") and (folder / "native.csv").read_bytes()
        with page.Folder() as folder:
            self.unzipped(folder)
            self.native(folder, "report", "aggregate", "-o", "page.html")
            self.same_colours(folder / "page.html")
            self.native(folder, "export", "aggregate", "-o", "zipped.csv")
            self.assertEqual((folder / "zipped.csv").read_bytes(), native)
            self.native(folder, "render", "aggregate", "-o", "picture.png")

    def test_the_scene_that_it_opens_with_is_that_of_its_command(self):
        """Two of 81 fall speeds differed by a bit from those of a terminal: log10 was not glibc's."""
        self.browser.open("about:blank")
        self.assertIsNone(self.browser.open(page.PAGE.as_uri()))
        self.until("!document.getElementById('grow-result').hidden && !rooms.grow.running", 120)
        self.assertEqual(self.text("grow-error"), "")
        with page.Folder() as folder:
            self.command(folder)
            self.assertEqual(hashlib.sha256((folder / "aggregate/history.csv").read_bytes()).hexdigest(), self.text("grow-hash"))
            self.assertEqual(len((folder / "aggregate/history.csv").read_text().splitlines()), 82)  # columns, the core and 80 particles

    def test_a_worker_that_ends_is_told(self):
        """One that Chromium did not start was 'undefined', and the room computed for ever."""
        ends = "(() => { rooms.grow.go(); const said = rooms.grow.$('state').textContent; rooms.grow.engine.worker.dispatchEvent(new ErrorEvent('error', GIVEN)); return said; })()"
        self.set(replicate="2", rays="1", orientations="1")
        self.assertEqual(self.browser.value(ends.replace("GIVEN", "{message: 'lost'}")), "computing")
        self.until("!rooms.grow.running", 10)
        self.assertEqual([self.text("grow-state"), self.text("grow-error")], ["", "the worker ended: lost"])
        self.until("rooms.grow.engine.isReady", 60)  # another has begun
        self.grow()
        self.browser.value("(() => { rooms.grow.engine.cancel(); rooms.grow.engine.worker.dispatchEvent(new Event('error')); })()")
        for _ in range(2):  # none has: each run says so
            self.assertEqual(self.text("grow-state"), "")
            self.assertRegex(self.text("grow-error"), "^the worker in which clast computes was not started")
            self.assertTrue(self.browser.value("document.getElementById('grow-run').disabled"))
            self.browser.value("rooms.grow.go()")
            self.until("!rooms.grow.running", 10)

    def test_it_is_rewound_with_its_numbers(self):
        self.grow()
        self.browser.value("(() => { const s = document.getElementById('grow-moment'); s.value = 3; s.dispatchEvent(new Event('input')); })()")
        self.assertRegex(self.text("grow-figures"), r"^4grains, with the core")
        self.assertEqual(self.text("grow-when"), "3 of 12 placed")
        self.assertIn("fall speed in air", self.text("grow-figures"))
        row = self.browser.value("rooms.grow.history['settling_velocity_m/s'][12]")
        end = self.browser.value("rooms.grow.result.json.settling_velocity")
        self.assertAlmostEqual(row / end, 1.0, delta=5e-3)

    def test_undo_and_a_link(self):
        self.grow(cone="20deg")
        digest = self.text("grow-hash")
        word = self.browser.value("packed(rooms.grow.snapshot())")
        self.set(cone="70deg")
        self.click("#grow-undo")
        self.assertEqual(self.browser.value("rooms.grow.value('cone')"), "20deg")
        self.open(f"grow={word}")
        self.assertEqual(self.browser.value("rooms.grow.value('cone')"), "20deg")
        self.run_room()
        self.assertEqual(self.text("grow-hash"), digest)
        self.open("grow=AAAA")
        self.assertIn("damaged", self.text("grow-error"))

    def test_several_files_are_picked(self):
        """The browser's list of them is empty once the field is; names that become the same are numbered."""
        with page.Folder() as folder:
            paths = [folder / name for name in ("one.csv", "two.csv", "sphere", "_sphere", " one.csv ")]
            for path in paths:
                path.write_text("size_um,count\n40,4\n60,3\n")
            self.pick(paths)
            self.until("rooms.grow.files.size === 5", 10)
            self.pick(paths[:1])
            time.sleep(0.3)
        self.assertEqual(self.text("grow-given"), "own files: one.csv, two.csv, _sphere, _sphere_2, one_2.csv")

    def test_a_refused_run_leaves_no_result(self):
        self.set(replicate="2", rays="1", orientations="1", core="sphere")
        self.grow()
        self.assertFalse(self.browser.value("document.getElementById('grow-result').hidden"))
        self.set(more="--no-such-option")
        self.run_room()
        self.assertRegex(self.text("grow-error"), "no-such-option")
        self.assertEqual(self.browser.value("[document.getElementById('grow-result').hidden, document.getElementById('grow-moment').disabled]"), [True, True])

    def test_the_first_picture_comes_by_itself(self):
        """The workers of the rooms that nobody looks at began before it."""
        self.browser.open("about:blank")
        self.assertIsNone(self.browser.open(page.PAGE.as_uri()))
        self.until("Boolean(rooms.grow.view?.renderer) && rooms.grow.view.renderer.info.render.frame > 0", 60)
        self.assertEqual(self.browser.value("[rooms.pour.engine.worker, rooms.split.engine.worker].map(Boolean)"), [False, False])
        self.click("#to-split")
        self.until("rooms.split.engine.isReady", 60)

    def test_a_button_that_rests_hands_the_focus_on(self):
        """The keyboard's focus fell to the page when Grow was pressed, and when Cancel was."""
        focus = "document.activeElement.id"

        def press(held=0):
            for kind, more in [("keyDown", {"text": "\r"}), *[("keyDown", {"text": "\r", "autoRepeat": True})] * held, ("keyUp", {})]:
                self.browser.call("Input.dispatchKeyEvent", type=kind, key="Enter", windowsVirtualKeyCode=13, **more)
        self.set(replicate="400", rays="64", orientations="32")
        self.browser.value("document.getElementById('grow-run').focus()")
        press(held=3)
        self.assertEqual((self.browser.value(focus), self.browser.value("Boolean(rooms.grow.running)")), ("grow-cancel", True))
        press()
        self.assertEqual(self.text("grow-state"), "cancelled")
        self.until("rooms.grow.engine.isReady", 30)
        self.assertEqual(self.browser.value(focus), "grow-run")
        self.browser.value("document.getElementById('grow-undo').focus()")
        while self.browser.value("!document.getElementById('grow-undo').disabled"):
            press()
        self.assertEqual(self.browser.value(focus), "grow-run")

    def test_the_view_follows_the_system_in_dark_and_light(self):
        self.set(replicate="2", rays="1", orientations="1")
        self.click("#grow-run")
        self.until("Boolean(rooms.grow.view?.renderer)", 60)
        for theme, is_dark in (("dark", True), ("light", False)):
            self.browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": theme}])
            self.until(f"rooms.grow.view.dark === {str(is_dark).lower()}", 5)

    def test_a_cancelled_run_shows_nothing_later(self):
        """Cancelled while its digest was computed, it was shown, and ended the run that had begun since."""
        self.set(replicate="2", rays="1", orientations="1")
        self.browser.value("(() => { const real = digestOf; window.digestOf = async (bytes) => { await new Promise((go) => { window.release = go; }); return real(bytes); }; })()")
        self.click("#grow-run")
        self.until("Boolean(window.release)", 60)
        self.browser.value("(async () => { rooms.grow.cancel(); release(); await new Promise((go) => setTimeout(go, 200)); })()")
        self.assertNotIn("done", self.text("grow-state"))
        self.assertTrue(self.browser.value("document.getElementById('grow-result').hidden"))

    def test_the_zip_has_the_inputs_of_its_run(self):
        """A file of the same name that was dropped after the run stood in its zip."""
        self.drop("core.stl", STL[0].read_bytes())
        self.set(replicate="2", rays="1", orientations="1")
        self.run_room()
        self.drop("core.stl", b"another")
        with page.Folder() as folder:
            self.unzipped(folder)
            self.assertEqual((folder / "core.stl").read_bytes(), STL[0].read_bytes())

    def test_cancel_ends_at_once(self):
        self.set(replicate="400", rays="64", orientations="32")
        self.click("#grow-run")
        self.until("Boolean(rooms.grow.history)", 60)  # it grows
        self.assertEqual(self.text("grow-state"), "computing")
        self.assertEqual(self.at_once("rooms.grow.cancel()", "document.getElementById('grow-state').textContent"), "cancelled")
        self.until("rooms.grow.engine.isReady", 30)
        self.grow()

    def test_a_surface_and_sizes_are_dropped(self):
        self.drop("my core.stl", STL[0].read_bytes())
        self.drop("sizes.csv", b"size_um,count\n40,4\n60,3\n")
        self.assertEqual(self.browser.value("[rooms.grow.value('core'), rooms.grow.value('sizes')].join()"), "my core.stl,sizes.csv")
        self.set(replicate="1")
        self.run_room()
        self.assertEqual(self.text("grow-error"), "")
        self.assertEqual(self.browser.value("rooms.grow.result.json.n_grain"), 8)

    def test_surfaces_say_their_own_units(self):
        """Every run had `--unit um`, which is refused beside a surface that clast has written in millimetres."""
        with page.Folder() as folder:
            for unit in ("mm", "cm"):
                self.native(folder, "mesh", "convert", jobs.GRAIN["grain01.ply"], "--unit", unit, "-o", f"in-{unit}.stl")
            self.drop("in-mm.stl", (folder / "in-mm.stl").read_bytes())
            self.drop("in-cm.stl", (folder / "in-cm.stl").read_bytes())
        self.browser.value("document.getElementById('grow-coat_in-mm.stl').click()")
        self.grow()
        with page.Folder() as folder:
            self.command(folder)
            self.assertEqual(hashlib.sha256((folder / "aggregate/history.csv").read_bytes()).hexdigest(), self.text("grow-hash"))

    def test_a_cluster_has_no_core(self):
        """Its figure was of grains `with the core`."""
        self.grow(core="-", more="--mode cluster")
        self.assertRegex(self.text("grow-figures"), "^12grains[^,]")

    def test_refusals_and_damaged_files_are_the_commands_own_line(self):
        self.set(cone="far")
        self.run_room()
        self.assertRegex(self.text("grow-error"), "^clast aggregate: .*cone")
        self.set(cone="20deg")
        for name, content in (("a.stl", b""), ("<img src=x onerror=alert(1)>.stl", b"solid x\nfacet"), ("../../up.stl", bytes(90)), ("--force.ply", b"ply\nformat"),
                              ("million.stl", bytes(80) + (1_000_000).to_bytes(4, "little")), ("scan.zip", b"PK\x03\x04" + bytes(40)), ("empty", b""),
                              ("..", b"\0\xff" * 200)):
            with self.subTest(name):
                self.drop(name, content)
                self.run_room()
                self.assertRegex(self.text("grow-error"), "^clast aggregate: ")
        self.assertEqual(self.browser.value("document.images.length"), 0)

    def test_files_named_as_what_objects_have(self):
        """`__proto__` was no file of the form, and `sphere` and `grain00.ply` were kept and never read."""
        stl = STL[0].read_bytes()
        kept = ["__proto__", "constructor", "toString", "<script>alert(1)</script>.stl".replace("/", "_"), "_sphere", "_grain00.ply", "_aggregate", "ellipsoid_1,2,3"]
        self.set(replicate="2", rays="1", orientations="1")
        for name, plain in zip(("__proto__", "constructor", "toString", "<script>alert(1)</script>.stl", "sphere", "grain00.ply", "aggregate", "ellipsoid:1,2,3"), kept):
            with self.subTest(name):
                self.drop(name, stl)
                self.assertEqual(self.browser.value("rooms.grow.value('core')"), plain)
        self.assertEqual(self.text("grow-given"), f"own files: {', '.join(kept)}")
        self.assertEqual(self.browser.value("document.querySelectorAll('main script').length"), 0)
        self.browser.value("(() => { const box = document.getElementById('grow-coat___proto__'); box.checked = true; box.dispatchEvent(new Event('change', {bubbles: true})); })()")
        word = self.browser.value("packed({values: rooms.grow.values(), files: Object.fromEntries([...rooms.grow.files].map(([n, b]) => [n, base64Of(b)]))})")
        for core in ("__proto__", "constructor"):
            with self.subTest(core):
                self.set(core=core)
                self.run_room()
                self.assertEqual(self.text("grow-error"), "")
                with page.Folder() as folder:
                    self.unzipped(folder)
                    self.assertEqual((folder / core).read_bytes(), stl)
                with page.Folder() as folder:
                    self.command(folder)
                    self.assertEqual(hashlib.sha256((folder / "aggregate/history.csv").read_bytes()).hexdigest(), self.text("grow-hash"))
        self.open(f"grow={word}")
        self.assertEqual(self.browser.value("[...rooms.grow.files.keys()]"), kept)

    def test_a_folder_and_a_large_file_are_lines(self):
        self.browser.value("rooms.grow.take([{name: 'scans', size: 4096, arrayBuffer: () => Promise.reject(new DOMException('x', 'NotFoundError'))}])")
        self.assertEqual(self.text("grow-error"), "scans cannot be read: a folder, or a file that is gone")
        self.browser.value("rooms.split.take([{name: 'scans.csv', size: 9e9}])")
        self.assertIn("scans.csv has 9000 MB; this page takes 64 MB a file", self.text("error"))

    def test_an_answer_that_the_page_cannot_show_is_told(self):
        self.set(more="--help")
        self.run_room(20)
        self.assertRegex(self.text("grow-error"), "cannot show what clast answered .* in a terminal: clast aggregate .*--help")
        self.set(more="")
        self.grow()

    def test_the_runs_own_figures(self):
        """Of three aggregates the mean stood beside the first, and neither was called so; a porosity below 0 was 0.0000."""
        self.grow(more="--repeats 3")
        self.assertIn("12 of 12 placed, the first of 3 aggregates", self.text("grow-when"))
        self.assertRegex(self.text("grow-numbers"), "^mean of 3 aggregates95 % interval of the mean")
        self.assertRegex(self.text("grow-numbers"), r"density[\d.]+ kg/m\u00b3[\d.]+ kg/m\u00b3 to [\d.]+ kg/m\u00b3")
        self.assertRegex(self.text("grow-said"), "^3 aggregates, intervals of the mean at level 0.95")
        self.set(more="")
        self.grow()
        self.browser.value("(() => { rooms.grow.history.porosity_surface_hull[12] = -0.0421; rooms.grow.show(12); })()")
        self.assertIn("-0.0421porosity in its surface hull", self.text("grow-figures"))

    def test_counts_of_a_table_are_grains(self):
        """Its lines were: 40,000 grains began without a word."""
        self.drop("bins.csv", b"size_um,count\n30,20000\n20,20000\n")
        self.set(replicate="1")
        self.run_room(20)
        self.assertRegex(self.text("grow-error"), "^about 40,000 grains are more")
        self.set(sizes="", more="--replicate 100000")
        self.run_room(20)
        self.assertRegex(self.text("grow-error"), "^about 100,000 grains are more")

    def test_a_refusal_stands_alone(self):
        """Figures, charts and the view of the run before stood beside it."""
        seen = "getComputedStyle(document.querySelector('#grow-figures')).visibility + getComputedStyle(document.querySelector('#grow-view')).visibility"
        self.grow()
        self.assertEqual(self.browser.value(seen), "visiblevisible")
        self.set(core_size="270")
        self.run_room()
        self.assertRegex(self.text("grow-error"), "^clast aggregate: ")
        self.assertEqual(self.browser.value(seen), "hiddenhidden")
        self.grow(core_size="270um")
        self.assertEqual(self.browser.value(seen), "visiblevisible")

    def test_more_options_reach_every_run(self):
        """A blank in a value, a run without a core and one without fall speeds could not be had."""
        for values in ({"more": "--core-density '2650 kg/m^3'"}, {"more": "--no-fall-speed"}, {"core": "-", "more": "--mode cluster"}):
            with self.subTest(values):
                self.grow(**values)
                with page.Folder() as folder:
                    self.command(folder)
                    self.assertEqual(hashlib.sha256((folder / "aggregate/history.csv").read_bytes()).hexdigest(), self.text("grow-hash"))
                    self.unzipped(folder)
                    self.assertIn(self.text("grow-hash"), (folder / "command.txt").read_text())

    def test_a_link_over_a_form_is_undone(self):
        word = self.browser.value("packed({values: {...rooms.grow.values(), replicate: '7'}, files: {}})")
        self.browser.value("rooms.grow.$('replicate').value = '99'")
        self.browser.value(f"location.hash = 'grow={word}', new Promise((go) => setTimeout(go, 200))")
        self.assertEqual(self.browser.value("rooms.grow.value('replicate')"), "7")
        self.click("#grow-undo")
        self.assertEqual(self.browser.value("rooms.grow.value('replicate')"), "99")

    def test_long_work_is_not_lost_without_a_question(self):
        leave = "(() => { const event = new Event('beforeunload', {cancelable: true}); window.dispatchEvent(event); return event.defaultPrevented; })()"
        self.grow()
        self.assertFalse(self.browser.value(leave))
        self.browser.value("rooms.grow.spent = 60")
        self.assertTrue(self.browser.value(leave))
        self.browser.value("rooms.grow.spent = 0")

    def test_a_scene_that_is_too_large_says_so(self):
        self.set(replicate="1000000")
        self.run_room()
        self.assertRegex(self.text("grow-error"), r"about 1,000,000 grains .* in a terminal: clast aggregate .*--replicate 1000000")

    def test_all_rooms_pass_axe(self):
        source = page.browser.axe_source()
        if source is None:
            self.skipTest("axe-core is not here and the registry is not reached")
        self.grow()
        for room in ("grow", "pour", "split"):
            for dark in (False, True):
                with self.subTest(room=room, dark=dark):
                    self.browser.screen(1280, 900, dark)
                    self.click(f"#to-{room}")
                    self.browser.value(f"(() => {{ {source}; return 1; }})()")
                    faults = self.browser.value("axe.run(document).then((r) => r.violations.filter((v) => ['serious', 'critical'].includes(v.impact))"
                                                ".map((v) => v.id + ': ' + v.nodes.map((n) => n.html).join(' | ').slice(0, 300)))")
                    self.assertEqual(faults, [])

    def test_memory_is_steady(self):
        self.set(replicate="12")
        used = []
        for _ in range(10):
            self.run_room()
            used.append(self.memory())
        self.assertLess(used[-1], 1.2 * used[2] + 4e6, used)


if __name__ == "__main__":
    page.main()
