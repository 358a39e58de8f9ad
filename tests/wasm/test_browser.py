"""clast-live.html in headless Chromium, from disk: the golden scenes in its worker are those of the native command, and the room Split is used
as a person would use it."""
import base64
import hashlib
import io
import json
import pathlib
import shlex
import subprocess
import tempfile
import time
import zipfile

import jobs
import page

RUN = """(async () => {
  const run = ({words, files}) => new Promise((done) => {
    const id = `job${Math.random()}`;
    const hear = ({data}) => { if (data.id === id) { splitter.worker.removeEventListener('message', hear); done(data); } };
    splitter.worker.addEventListener('message', hear);
    splitter.worker.postMessage({id, words, files: Object.fromEntries(Object.entries(files).map(([n, t]) => [n, bytesOf(t)]))});
  });
  const hex = async (bytes) => [...new Uint8Array(await crypto.subtle.digest('SHA-256', bytes))].map((b) => b.toString(16).padStart(2, '0')).join('');
  const {result, fault} = await run(JOB);
  if (fault) throw new Error(fault);
  for (const name of Object.keys(result.files)) result.files[name] = await hex(result.files[name]);
  return JSON.stringify(result);
})()"""


class Split(page.Live):
    def split(self):
        self.click("#run")
        self.until("document.getElementById('state').textContent.startsWith('done') || document.getElementById('error').textContent !== ''", 60)

    def drop(self, name, content):
        word = base64.b64encode(content).decode()
        self.browser.value(f"take(new File([bytesOf('{word}')], {json.dumps(name)}))")

    def around(self):
        """The domain becomes the box around the points that the picture shows, as a reader may wish who knows it to be that."""
        self.set(domain=self.browser.value("document.getElementById('domain').placeholder").removeprefix("points: "))

    def test_scenes_are_equal_in_the_worker(self):
        for name, (words, files) in jobs.JOBS.items():
            with self.subTest(name):
                job = json.dumps({"words": words, "files": {n: base64.b64encode(p.read_bytes()).decode() for n, p in files.items()}})
                here, there = jobs.plain(jobs.native(words, files)), jobs.plain(json.loads(self.browser.value(RUN.replace("JOB", job))))
                self.assertEqual(here, there)

    def test_an_answer_belongs_to_its_points(self):
        """Points that came while others were split had the cells of those; a run that failed left the result of the one before."""
        self.click("[data-make=cluster]")
        self.split()
        self.set(**{"more": "--help"})
        self.split()
        self.assertIn("in a terminal: clast decompose", self.text("error"))
        self.assertTrue(self.browser.value("document.getElementById('result').hidden"))
        self.assertEqual(self.text("state"), "")
        self.set(**{"more": ""})
        self.browser.value("document.getElementById('run').click(), document.querySelector('[data-make=even]').click()")
        self.assertEqual(self.text("state"), "cancelled")
        self.until("splitter.isReady", 60)
        time.sleep(1)
        self.assertEqual(self.browser.value("[state.result, state.running, document.getElementById('result').hidden]"), [None, False, True])
        self.split()
        self.assertEqual(self.text("error"), "")

    def set(self, **values):
        for name, value in values.items():
            self.browser.value(f"(() => {{ const field = document.getElementById({json.dumps(name)}); field.value = {json.dumps(value)}; "
                               "field.dispatchEvent(new Event('change', {bubbles: true})); })()")

    def test_points_that_come_while_a_digest_is_computed(self):
        """The command and the digest of the points before were shown under new points, and the zip had neither."""
        self.browser.value("(() => { const real = digestOf; window.digestOf = async (bytes) => { window.digests = (window.digests ?? 0) + 1; "
                           "await new Promise((go) => { window.release = go; }); return real(bytes); }; })()")
        ways = {"made": "document.querySelector('[data-make=even]').click()", "dropped": "take(new File(['x,y\\n0.1,0.2\\n0.3,0.1\\n'], 'few.csv'))",
                "painted": "document.getElementById('paint').click()", "cancelled": "document.getElementById('cancel').click()"}
        for k, (name, way) in enumerate(ways.items()):
            with self.subTest(name):
                self.click("[data-make=cluster]")
                self.click("#run")
                self.until(f"window.digests === {k + 1}", 60)
                self.browser.value(f"(async () => {{ await ({way}); release(); await new Promise((go) => setTimeout(go, 200)); }})()")
                self.assertEqual(self.browser.value("[Boolean(state.result), state.running, document.getElementById('result').hidden]"), [False, False, True])
                self.until("splitter.isReady", 60)
        self.assertEqual(self.text("error"), "")

    def test_the_newest_points_count(self):
        """A file that takes long to be read replaced what was made after it was dropped."""
        self.browser.value("take({name: 'slow.csv', size: 9, arrayBuffer: () => new Promise((go) => { window.release = () => go(new TextEncoder().encode('x,y\\n1,2\\n3,4\\n')); })}), 0")
        self.click("[data-make=even]")
        self.browser.value("(async () => { release(); await new Promise((go) => setTimeout(go, 100)); })()")
        self.assertEqual(self.browser.value("state.name"), "even.csv")

    def test_options_and_points_are_undone(self):
        """Undo knew strokes alone."""
        self.click("[data-make=even]")
        self.click("[data-make=cube]")
        self.set(mesh="boxes")
        self.set(domain="box:0,0,0,1,1,2")
        said = []
        for _ in range(4):
            self.click("#undo")
            said.append(self.browser.value("[state.name, document.getElementById('mesh').value, document.getElementById('domain').value]"))
        self.assertEqual(said, [["cube.csv", "boxes", "box:0,0,0,1,1,1"], ["cube.csv", "", "box:0,0,0,1,1,1"], ["even.csv", "", "box:0,0,1,1"], [None, "", "box:0,0,1,1"]])
        self.assertTrue(self.browser.value("document.getElementById('undo').disabled && document.getElementById('run').disabled"))

    def test_a_cloud_is_split_and_the_command_repeats_it(self):
        self.click("[data-make=cluster]")
        self.split()
        self.assertEqual(self.text("error"), "")
        self.assertIn("rejects", self.text("tests"))
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "cluster.csv").write_text(self.browser.value("state.text"))
            words = self.text("command").split()
            self.assertEqual(words[0], "clast")
            subprocess.run([jobs.CLAST, *words[1:]], cwd=folder, check=True, capture_output=True, env=jobs.PLAIN)
            self.assertEqual(hashlib.sha256((folder / "cells/cells.csv").read_bytes()).hexdigest(), self.text("hash"))
        zipped = self.browser.value("zipOf({[state.name]: state.text, ...state.result.files}).arrayBuffer().then((b) => btoa(Array.from(new Uint8Array(b), (c) => String.fromCharCode(c)).join('')))")
        with zipfile.ZipFile(io.BytesIO(base64.b64decode(zipped))) as folder:
            self.assertIsNone(folder.testzip())
            self.assertEqual(hashlib.sha256(folder.read("cells/cells.csv")).hexdigest(), self.text("hash"))
        self.browser.value("pick(0)")
        self.assertIn("cell 0 of", self.text("picked"))

    def test_the_picture_shows_cells(self):
        self.click("[data-make=cluster]")
        count = ("(() => { const copy = new OffscreenCanvas(SIZE, SIZE).getContext('2d', {willReadFrequently: true}); copy.drawImage($('picture'), 0, 0); "
                 "return new Set(new Uint32Array(copy.getImageData(0, 0, SIZE, SIZE).data.buffer)).size; })()")
        before = self.browser.value(count)
        self.split()
        self.assertGreater(self.browser.value(count), before + 5)

    def test_refusals_are_the_commands_own_line(self):
        self.click("[data-make=even]")
        self.browser.value("document.getElementById('domain').value = 'box:0,0,0.5,1'")
        self.split()
        self.assertRegex(self.text("error"), "^clast decompose: .*points lie outside")
        self.browser.value("document.getElementById('domain').value = 'box:0,0,1,1'; document.getElementById('more').value = '--levle 2'")
        self.split()
        self.assertIn("did you mean --level", self.text("error"))

    def test_damaged_files_and_hostile_names_are_lines(self):
        for name, content in (("a.csv", b""), ("b.csv", b"\0\xff\xfe" * 400), ("c.csv", b"x,y\n1,nan\n"), ("<img src=x onerror=alert(1)>.csv", b"x,y\n1,1\n2\n"),
                              ("../../etc/passwd.csv", b"x,y\n1,2,\"\n"), ("--force.csv", b"x,y\n0.1,0.1\nq,2\n"), ("d.vtu", b"<VTKFile>")):
            with self.subTest(name):
                self.drop(name, content)
                self.until(f"state.text !== null && document.getElementById('given').textContent.length > 0 && state.name === {json.dumps(self.kept(name))}", 10)
                self.split()
                self.assertRegex(self.text("error"), "^clast decompose: ")
        self.assertEqual(self.browser.value("document.images.length"), 0)

    def test_cancel_ends_within_a_tenth_of_a_second(self):
        self.drop("big.csv", b"x,y,z\n" + b"\n".join(b"%.6f,%.6f,%.6f" % ((k * 0.754877) % 1, (k * 0.569840) % 1, (k * 0.324717) % 1) for k in range(300000)))
        self.until("state.name === 'big.csv'", 20)
        self.set(domain="box:0,0,0,1,1,1")
        self.click("#run")
        time.sleep(0.3)
        self.assertEqual(self.text("state"), "computing")
        self.assertEqual(self.at_once("cancel()", "document.getElementById('state').textContent"), "cancelled")
        self.assertEqual(self.text("state"), "ready")
        self.click("[data-make=even]")
        self.split()
        self.assertEqual(self.text("error"), "")

    def test_painting_and_undo(self):
        self.click("#paint")
        self.browser.value("state.strokes.push([]); for (let k = 0; k < 40; k += 1) spray({clientX: $('picture').getBoundingClientRect().left + 100 + 4 * k, clientY: $('picture').getBoundingClientRect().top + 150})")
        self.assertRegex(self.text("given"), r"^painted.csv: \d+ points in 2 dimensions")
        self.split()
        self.assertEqual(self.text("error"), "")
        self.click("#undo")
        self.assertEqual(self.text("given"), "no points yet")

    def test_an_address_holds_points_and_options(self):
        self.click("[data-make=gradient]")
        self.browser.value("document.getElementById('mesh').value = 'boxes'")
        word, text = self.browser.value("shared()"), self.browser.value("state.text")
        self.open(f"split={word}")
        self.assertEqual(self.browser.value("state.text"), text)
        self.split()
        self.assertIn("--mesh=boxes", self.text("command"))
        for damaged in ("AAAA", "eyJuYW1lIjoiYS5jc3YifQ"):  # the latter has a name alone, and `undefined` was its table
            self.open(f"split={damaged}")
            self.assertIn("damaged", self.text("error"))

    TABLES = {"bare.csv": b"100,250,0\n300,350,0\n400,150,0\n", "upper.csv": b"id,X,Y\n1,0.1,0.25\n2,0.3,0.35\n3,0.4,0.15\n", "quoted.csv": b'"x (mm)","y (mm)"\r\n1,2.5\r\n3,3.5\r\n4,1.5\r\n',
              "named.tsv": b"y_um\tx_um\n250\t100\n350\t300\n150\t400\n", "brackets.csv": b"X [um],Y [um]\n1,2.5\n3,3.5\n4,1.5\n", "semi.csv": b"x; y; z\n0.1; 0.25; 0.5\n0.3; 0.35; 0.6\n0.4; 0.15; 0.9\n"}

    def test_columns_that_the_picture_shows_are_those_that_clast_reads(self):
        """A table without header, with X, or with units in its names was drawn and then refused; a column z of zeros gave a domain that is none."""
        for name, content in self.TABLES.items():
            with self.subTest(name):
                self.drop(name, content)
                self.around()
                self.split()
                self.assertEqual(self.text("error"), "")
                self.assertEqual(self.browser.value("state.result.json.n"), 3)
                self.assertEqual(self.browser.value("JSON.stringify(domainBox().map((ends, a) => ends.map((v, e) => Math.abs(v / state.result.cells[`${'xy'[a]}_${e ? 'high' : 'low'}_m`][0] - 1) < 1e-9)))"),
                                 "[[true,true],[true,true]]")
                with page.Folder() as folder:
                    (folder / name).write_bytes(content)
                    self.native(folder, *shlex.split(self.text("command"))[1:])
                    self.assertEqual(hashlib.sha256((folder / "cells/cells.csv").read_bytes()).hexdigest(), self.text("hash"))

    def test_the_domain_is_never_guessed(self):
        """The box around the points was filled in: uniform points of a ball were split into cells."""
        rows = [[(k * step) % 2 - 1 for step in (1.6180339887, 0.7548776662, 1.2207440846)] for k in range(1, 1200)]
        self.drop("ball.csv", "\n".join(["x,y,z", *(",".join(f"{v:.6f}" for v in row) for row in rows if sum(v * v for v in row) < 1)]).encode())
        self.assertEqual(self.browser.value("['value', 'placeholder'].map((key) => document.getElementById('domain')[key])"), ["", "points: box:-1,-1,-1,1,1,1"])
        self.assertTrue(self.text("given").endswith("in 3 dimensions, its domain is to be given"))
        self.split()
        self.assertRegex(self.text("error"), "^clast decompose: give the domain, .* never guessed from the points")
        self.set(domain="sphere:1")
        self.split()
        self.assertEqual(self.text("error"), "")
        self.set(domain="")
        self.click("#undo")
        self.assertEqual(self.browser.value("document.getElementById('domain').value"), "sphere:1")

    def test_what_the_command_says_is_shown(self):
        """Its warnings, repeated places, evenness and pairs were dropped."""
        self.drop("few.csv", b"x,y\n0.1,0.1\n0.1,0.1\n0.4,0.3\n0.2,0.3\n0.7,0.6\n0.9,0.2\n0.3,0.8\n")
        self.set(domain="box:0,0,5000,5000")
        self.split()
        self.assertRegex(self.text("said"), "^clast decompose: warning: all points lie within .* are both in the same unit")
        self.assertRegex(self.text("said"), r"1 duplicates? \(coincident points")
        self.assertRegex(self.text("state"), "^done in .* s, with a warning of the command below$")
        lattice = "\n".join(f"{i + 0.5},{j + 0.5}" for i in range(12) for j in range(12))
        self.drop("lattice.csv", f"x,y\n{lattice}\n".encode())
        self.set(domain="box:0,0,12,12", more="--pairs")
        self.split()
        self.assertIn("regular", self.text("figures"))
        self.assertIn("pair integral by pairs", self.text("said"))
        with page.Folder() as folder:
            (folder / "lattice.csv").write_text(f"x,y\n{lattice}\n")
            self.assertEqual(self.native(folder, *shlex.split(self.text("command"))[1:]).strip(), self.text("said"))

    def test_a_table_of_another_alphabet_goes_to_clast_as_it_is(self):
        """The micro sign of Latin-1 became a letter that is no unit, and micrometres metres."""
        rows = b"\n100,200\n300,400\n600,200\n400,400\n200,900\n"
        content = "x_\u00b5m,y_\u00b5m".encode("latin-1") + rows
        self.drop("latin.csv", content)
        self.set(domain="box:100um,200um,600um,900um")
        self.split()
        self.assertIn("no column of numbers named 'x'", self.text("error"))
        self.assertNotIn("--columns", self.browser.value("commandOf(state.words)"))
        self.assertEqual(self.browser.value("base64Of(state.text)"), base64.b64encode(content).decode())
        self.drop("pixels.csv", b"x_px,y_px" + rows)
        self.set(domain="box:100,200,600,900")
        self.split()
        self.assertIn("no column of numbers named 'x'", self.text("error"))
        self.drop("utf8.csv", b"\xef\xbb\xbf" + "x_\u00b5m,y_\u00b5m".encode() + rows)
        self.around()
        self.split()
        self.assertEqual(self.text("error"), "")
        self.assertAlmostEqual(self.browser.value("state.result.json.domain_volume"), 3.5e-7, delta=1e-12)

    def test_tests_alone_have_no_cells(self):
        """They were told not to show all of their structure, with a bound that was none."""
        self.click("[data-make=even]")
        self.set(variant="test")
        self.split()
        self.assertRegex(self.text("figures"), "^1200points in 2 dimensionsuniformtests of uniformity$")
        self.assertEqual(self.text("legend"), "")
        self.assertIn("1200 points", self.browser.value("document.getElementById('picture').getAttribute('aria-label')"))
        self.browser.value("document.getElementById('picture').focus()")
        self.browser.call("Input.dispatchKeyEvent", type="keyDown", key="ArrowRight")

    def test_more_options_are_words_of_a_shell(self):
        """Words were cut at blanks and quotes stayed letters."""
        self.assertEqual(self.browser.value(r'''shellWords(String.raw`--wall 'lid plate.stl mm'  --a="b \"c" d\ e '' it"'"s`)'''),
                         ["--wall", "lid plate.stl mm", '--a=b "c', "d e", "", "it's"])
        self.drop("named.csv", b"a b,c\n0.1,0.2\n0.3,0.1\n")
        self.set(domain="box:0,0,1,1", more="--columns 'a b,c'")
        self.split()
        self.assertEqual(self.text("error"), "")
        with page.Folder() as folder:
            (folder / "named.csv").write_text("a b,c\n0.1,0.2\n0.3,0.1\n")
            self.native(folder, *shlex.split(self.text("command"))[1:])
            self.unzipped(folder)
            said = (folder / "command.txt").read_text()
            self.assertRegex(said, "^GLIBC_TUNABLES=[^ ]* clast decompose named.csv ")
            self.assertIn(hashlib.sha256((folder / "cells/cells.csv").read_bytes()).hexdigest(), said)

    def test_a_link_over_a_form_is_undone(self):
        """What had been typed could not be had back; a room's link went when another was looked at."""
        self.click("[data-make=gradient]")
        word = self.browser.value("shared()")
        self.browser.value("document.getElementById('beta_dt').value = '3'")
        self.browser.value(f"location.hash = 'split={word}', new Promise((go) => setTimeout(go, 200))")
        self.assertEqual(self.browser.value("document.getElementById('beta_dt').value"), "")
        self.click("#to-pour")
        self.click("#to-split")
        self.assertEqual(self.browser.value("location.hash"), f"#split={word}")
        self.click("#undo")
        self.assertEqual(self.browser.value("document.getElementById('beta_dt').value"), "3")

    def test_painting_goes_on_in_its_domain(self):
        """Each stroke set the unit square."""
        paint = "(() => { const box = $('picture').getBoundingClientRect(); state.strokes.push([]); for (let k = 0; k < 9; k += 1) spray({clientX: box.left + 0.8 * box.width, clientY: box.top + 0.2 * box.height}); })()"
        self.click("#paint")
        self.browser.value(paint)
        self.set(domain="box:0,0,2,2")
        self.browser.value(paint)
        self.assertEqual(self.browser.value("document.getElementById('domain').value"), "box:0,0,2,2")
        self.assertGreater(self.browser.value("Math.max(...state.columns[0])"), 1.2)

    def test_columns_that_may_be_anything_are_not_guessed(self):
        for content in (b"1,0.1,0.2,0.3\n2,0.3,0.4,0.2\n", b"id,radius,height\n1,0.1,0.2\n2,0.3,0.4\n"):
            self.drop("any.csv", content)
            self.around()
            self.split()
            self.assertIn("no column of numbers named 'x'; it has", self.text("error"))

    def test_points_in_one_place_have_no_box(self):
        """The box around them, of no size, was what the command refused, not what is wrong with them."""
        for content, said in ((b"x,y\n0.1,nan\n0.3,0.4\n", "point 1 has a coordinate that is not finite"), (b"x,y\n0.1,0.2\n", "")):
            self.drop("few.csv", content)
            self.assertTrue(self.text("given").endswith("in 2 dimensions, its domain is to be given"), self.text("given"))
            self.assertEqual(self.browser.value("document.getElementById('domain').placeholder"), "")
            self.set(domain="box:0,0,1,1")
            self.split()
            self.assertIn(said, self.text("error"))
            self.assertEqual(said == "", self.text("error") == "")

    def test_a_decimal_comma_is_told(self):
        """Its digits became columns, and the domain around them was what the command refused."""
        self.drop("comma.csv", b"x;y\n0,134;0,5\n0,2;0,1\n")
        self.set(domain="box:0,0,1,1")
        self.split()
        self.assertIn("a decimal comma?", self.text("error"))

    def test_cells_are_drawn_in_the_unit_that_is_typed(self):
        """Cells in metres were drawn beside points in micrometres: none was seen."""
        self.drop("drops.csv", b"x,y\n100,250\n300,350\n400,150\n900,450\n")
        for domain, more in (("box:0,0,1000,500", "--unit um"), ("box:0mm,0mm,1mm,500um", "--unit=um")):
            with self.subTest(domain):
                self.set(domain=domain, more=more)
                self.split()
                self.assertEqual(self.text("error"), "")
                box = "(() => { const s = scaleOf(); const { cells } = state.result; return [s.x(cells.x_low_m[0]), s.x(cells.x_high_m[0])].map(Math.round); })()"
                self.assertEqual(self.browser.value(box), [14, 626])

    def test_a_link_is_copied_and_the_result_stays(self):
        """The address that it set opened itself: the result went, and a run with it."""
        self.click("[data-make=cluster]")
        self.split()
        self.click("#share")
        time.sleep(0.3)
        self.assertFalse(self.browser.value("document.getElementById('result').hidden"))
        self.assertTrue(self.browser.value("location.hash.startsWith('#split=')"))

    def test_a_painted_cloud_opens_as_one(self):
        """Painting on in a cloud that a link had brought emptied it."""
        self.browser.value("take(new File(['x,y\\n0.1,0.2\\n0.3,0.1\\n'], 'painted.csv'))")
        self.open(f"split={self.browser.value('shared()')}")
        self.click("#paint")
        self.assertRegex(self.text("given"), "^painted.csv: 2 points in 2 dimensions")

    def test_painting_after_a_table_of_another_size(self):
        """The domain of the table before stayed, and no stroke fell into it."""
        self.drop("wide.csv", b"x,y\n100,200\n300,400\n500,100\n")
        self.click("#paint")
        self.browser.value("(() => { const box = $('picture').getBoundingClientRect(); state.strokes.push([]); for (let k = 0; k < 9; k += 1) spray({clientX: box.left + 200, clientY: box.top + 200}); })()")
        self.assertRegex(self.text("given"), r"^painted.csv: \d+ points")
        self.drop("few.csv", b"x,y\n0.1,0.2\n0.3,0.1\n")
        self.assertEqual(self.browser.value("document.getElementById('paint').getAttribute('aria-pressed')"), "false")

    def test_painting_by_keyboard(self):
        self.click("#paint")
        self.browser.value("document.getElementById('picture').focus()")
        for key in ("ArrowLeft", "ArrowUp", " ", "ArrowUp", " "):
            for kind in ("keyDown", "keyUp"):
                self.browser.call("Input.dispatchKeyEvent", type=kind, key=key)
        self.assertRegex(self.text("given"), r"^painted.csv: \d+ points")
        self.assertIn("Space paints", self.browser.value("document.getElementById('picture').getAttribute('aria-label')"))
        self.click("#undo")
        self.assertRegex(self.text("given"), r"^painted.csv: [1-6] points?")

    def test_what_is_no_table_leaves_the_points(self):
        self.click("[data-make=cluster]")
        self.split()
        self.drop("grain.stl", b"solid x\nendsolid x\n")
        self.assertEqual(self.text("error"), "grain.stl is a surface; the tabs Grow and Pour take it")
        self.assertFalse(self.browser.value("document.getElementById('result').hidden"))
        self.browser.value("rooms.split.take([new File(['x,y\\n1,2\\n3,4\\n'], 'one.csv'), new File(['x,y\\n'], 'two.csv')])")
        self.until("state.name === 'one.csv' && document.getElementById('error').textContent === 'one table at a time: two.csv is left out'", 5)

    def test_numbers_of_a_cell_go_with_it(self):
        self.click("[data-make=cluster]")
        self.split()
        self.browser.value("pick(0)")
        self.click("[data-make=even]")
        self.assertRegex(self.text("picked"), "^Point at a cell")
        self.assertEqual(self.text("state"), "")

    def test_a_million_points_are_drawn_at_once(self):
        """A rectangle for each took 40 s, again at every cell pointed at."""
        self.browser.value("(() => { const draw_ = draws(3); const rows = Array.from({length: 1e6}, () => `${draw_().toFixed(6)},${draw_().toFixed(6)}`); setPoints('m.csv', `x,y\\n${rows.join('\\n')}\\n`); })()")
        begun = self.browser.cpu()
        self.browser.value("draw(), new Promise((go) => requestAnimationFrame(() => setTimeout(go, 50)))")
        self.assertLess(self.browser.cpu() - begun, 3)
        dark = "[...$('picture').getContext('2d').getImageData(200, 200, 200, 200).data].filter((v, k) => k % 4 === 3 && v > 60).length"
        self.assertGreater(self.browser.value(dark), 35000)
        self.browser.value("window.drawn = 0, drawMany = ((real) => (...given) => { window.drawn += 1; real(...given); })(drawMany), 0")
        self.browser.value("state.result = {json: {n_cell: 1}, cells: {x_low_m: [0], x_high_m: [1], y_low_m: [0], y_high_m: [1], count: [1e6], density: [1e6], pair_integral: [5e11]}}, pick(0)")
        self.assertEqual(self.browser.value("window.drawn"), 0)

    def test_a_phone_scrolls_downwards_alone(self):
        """The digest was wider than the page, and on a small one the field of files."""
        self.click("[data-make=cluster]")
        self.split()
        for wide in (400, 320):
            self.browser.screen(wide, 800, False)
            self.assertEqual(self.browser.value("document.documentElement.scrollWidth"), wide)
        self.browser.screen(1280, 900, False)


if __name__ == "__main__":
    page.main()
