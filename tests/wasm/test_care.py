"""clast-live.html as a careful reader meets it: no serious finding of axe-core in light or dark, memory steady over ten runs, a picture like the one
that is kept (a tolerance for other graphics), files of hostile names and contents dropped on the page as a person drops them, nothing on the console."""
import base64
import hashlib
import json
import os
import pathlib
import re
import sys
import tempfile
import time
import unittest

import jobs

sys.path.insert(0, str(jobs.ROOT / "tools"))
import browser  # noqa: E402
import picture  # noqa: E402

PAGE = jobs.PACKAGE.parent / "clast-live.html"
KEPT = jobs.ROOT / "tests/view"
AXE_RUN = """axe.run(document).then(r => r.violations.filter(v => ["serious", "critical"].includes(v.impact))
    .map(v => `${v.id}: ${v.nodes.length} of ${v.nodes[0].html.slice(0, 160)}`))"""
HOSTILE = {
    "<img src=x onerror=alert(1)>.csv": b"x,y\n0.1,0.1\n0.2,0.9\n", "../../etc/passwd.csv": b"x,y\n1,2,\"\n", "--force.csv": b"x,y\n0.1,0.1\nq,2\n",
    "\u202egnp.csv": b"\0\xff\xfe" * 400, "a b'\"$(id).csv": b"x,y\n" + b"9" * 70000, "empty.csv": b"", "CON.vtu": b"<VTKFile type=\"PolyData\">",
    "bomb.ply": b"ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nend_header\n", "x" * 300 + ".csv": b"x,y\n1,nan\n",
    "__proto__": b"x,y\n0.1,0.1\n", "constructor.csv": b"x,y\n0.1,0.1\n0.4,0.3\n", "points.zip": b"PK\x03\x04" + bytes(60), "<script>alert(1)</script>.csv": b"x,y\n",
    "million.stl": bytes(80) + (1_000_000).to_bytes(4, "little"), "cells": b"x,y\n0.1,0.1\n0.4,0.3\n",
    "deep.h5": b"\x89HDF\r\n\x1a\n" + b"\xff" * 3000, "solid.stl": b"solid \xff\nfacet normal 0 0\n", "huge.stl": b"\0" * 80 + b"\xff\xff\xff\x7f",
}
DROP = """(() => { const data = new DataTransfer(); data.items.add(new File([Uint8Array.from(atob(BYTES), c => c.charCodeAt(0))], NAME));
    for (const kind of ['dragover', 'drop']) document.body.dispatchEvent(new DragEvent(kind, {dataTransfer: data, bubbles: true, cancelable: true})); })()"""


class Care(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser(browser.WEBGL)
        cls.axe = browser.axe_source()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def setUp(self):
        self.browser.screen(1280, 900, False)
        self.browser.open("about:blank")
        self.assertIsNone(self.browser.open(PAGE.as_uri() + "#split"))
        self.until("document.getElementById('state').textContent === 'ready'", 60)

    def tearDown(self):
        self.assertEqual(list(browser.told(self.browser.events)), [])

    def until(self, condition, seconds):
        end = time.monotonic() + seconds
        while not self.browser.value(condition):
            self.assertLess(time.monotonic(), end, f"{condition}: {self.browser.value('document.body.innerText')[:600]}")
            time.sleep(0.02)

    def split(self, kind="cluster"):
        self.browser.value(f"document.querySelector('[data-make={kind}]').click()")
        self.browser.value("document.getElementById('run').click()")
        self.until("document.getElementById('state').textContent.startsWith('done')", 60)

    def test_axe_finds_nothing_serious(self):
        if not self.axe:
            self.skipTest("no axe-core here")
        self.split()
        for dark in (False, True):
            self.browser.screen(1280, 900, dark)
            time.sleep(0.3)
            self.browser.value("window.axe ? 0 : (window.eval(" + json.dumps(self.axe) + "), 0)")
            self.assertEqual(self.browser.value(AXE_RUN), [], "dark" if dark else "light")

    def test_memory_is_steady_over_ten_runs(self):
        held = []
        for k in range(10):
            self.split(("cluster", "gradient")[k % 2])
            self.browser.call("HeapProfiler.collectGarbage")
            held.append(self.browser.memory())
        self.assertLess(max(held[6:]), 1.15 * max(held[2:5]) + 20e6, [round(h / 1e6) for h in held])

    def test_hostile_files_are_lines(self):
        for name, content in HOSTILE.items():
            with self.subTest(name):
                word = base64.b64encode(content).decode()
                self.browser.value(DROP.replace("BYTES", json.dumps(word)).replace("NAME", json.dumps(name)))
                time.sleep(0.3)
                if self.browser.value("!document.getElementById('run').disabled"):
                    self.browser.value("document.getElementById('error').textContent = ''; document.getElementById('run').click()")
                    self.until("document.getElementById('state').textContent !== 'computing'", 30)
                self.assertEqual(self.browser.value("document.images.length + document.querySelectorAll('main script, main iframe, main [onerror]').length"), 0)
        self.split()  # the page still works

    def test_the_picture_is_the_one_that_is_kept(self):
        self.split()
        data = base64.b64decode(self.browser.value("document.getElementById('picture').toDataURL('image/png').split(',')[1]"))
        if os.environ.get("CLAST_RENEW_PICTURES"):
            KEPT.joinpath("split.png").write_bytes(data)
        mean, far = picture.difference(data, KEPT.joinpath("split.png").read_bytes())
        self.assertLess(mean, 3)
        self.assertLess(far, 0.02)


class Old(unittest.TestCase):
    """Browsers that lack what the page stands on, and one that cannot read its script at all, are told so; nothing is on the console but that."""
    LINE = "This browser is too old for this page"

    def said(self, before, path=PAGE):
        one = browser.Browser(browser.WEBGL)
        self.addCleanup(one.close)
        one.call("Page.addScriptToEvaluateOnNewDocument", source=before)
        one.open(path.as_uri())
        time.sleep(1)
        lines = one.value("['grow-', 'pour-', ''].map((room) => document.getElementById(room + 'error').textContent + document.getElementById(room + 'state').textContent)")
        return lines, list(browser.told(one.events))

    def test_what_is_lacking_is_told(self):
        lacks = [f"delete window.{name}" for name in ("WebAssembly", "BigInt", "DecompressionStream")]
        for lack in [*lacks, "WebAssembly.validate = () => false"]:  # the last: no SIMD
            with self.subTest(lack):
                lines, told = self.said(lack)
                self.assertEqual([line.startswith(self.LINE) for line in lines], [True] * 3, lines)
                self.assertEqual(told, [])

    def test_the_word_of_it_stays(self):
        """A click emptied the line."""
        one = browser.Browser(browser.WEBGL)
        self.addCleanup(one.close)
        one.call("Page.addScriptToEvaluateOnNewDocument", source="delete window.DecompressionStream")
        one.open(PAGE.as_uri() + "#split")
        time.sleep(1)
        one.value("document.querySelector('[data-make=cluster]').click(), document.getElementById('grow-run').click()")
        for name in ("error", "grow-error"):
            self.assertTrue(one.value(f"document.getElementById('{name}').textContent").startswith(self.LINE))

    def test_a_script_that_cannot_be_read_is_told(self):
        text = PAGE.read_text()
        script = max(re.findall(r"<script>(.*?)</script>", text, re.S), key=len)
        newer = script + "\nlet x = 1 <=> 2;"
        digest = lambda s: base64.b64encode(hashlib.sha256(s.encode()).digest()).decode()
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "live.html"
            page.write_text(text.replace(script, newer).replace(digest(script), digest(newer)))
            lines, told = self.said("", page)
        self.assertEqual([line.startswith(self.LINE) for line in lines], [True] * 3, lines)
        self.assertEqual(len(told), 1, told)  # the browser's own word for the script


if __name__ == "__main__":
    lacking = jobs.lacking(browser.CHROMIUM)
    if lacking:
        print(f"SKIPPED LOUDLY: {lacking}")
        raise SystemExit(0)
    unittest.main()
