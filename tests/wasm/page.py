"""clast-live.html opened in headless Chromium, from disk, and used as a person would."""
import base64
import io
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile

import jobs

sys.path.insert(0, str(jobs.ROOT / "tools"))
import browser  # noqa: E402

PAGE = jobs.PACKAGE.parent / "clast-live.html"


class Live(unittest.TestCase):
    """A test whose page says nothing on the console."""
    maxDiff = 4000
    room, flags = "split", ("--disable-gpu",)

    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser(cls.flags)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def setUp(self):
        self.open()

    def tearDown(self):
        self.assertEqual(list(browser.told(self.browser.events)), [])

    def open(self, fragment=None):
        self.browser.open("about:blank")
        self.assertIsNone(self.browser.open(f"{PAGE.as_uri()}#{fragment or self.room}"))
        self.until(f"rooms.{self.room}.engine.isReady", 60)

    def until(self, condition, seconds):
        end = time.monotonic() + seconds
        while not self.browser.value(condition):
            self.assertLess(time.monotonic(), end, f"{condition}: {self.browser.value('document.body.innerText')[:900]}")
            time.sleep(0.02)

    def text(self, name):
        return self.browser.value(f"document.getElementById('{name}').textContent")

    def click(self, selector):
        self.browser.value(f"document.querySelector({json.dumps(selector)}).click()")

    def set(self, **values):
        """Types into fields of the room, as far as the page can tell."""
        for name, value in values.items():
            self.browser.value(f"(() => {{ const field = document.getElementById({json.dumps(f'{self.room}-{name}')}); field.value = {json.dumps(value)}; "
                               "field.dispatchEvent(new Event('change', {bubbles: true})); })()")

    def drop(self, name, content):
        word = base64.b64encode(content).decode()
        self.browser.value(f"(async () => {{ const files = new DataTransfer(); files.items.add(new File([bytesOf('{word}')], {json.dumps(name)})); "
                           "document.dispatchEvent(new DragEvent('drop', {dataTransfer: files, bubbles: true})); await new Promise((go) => setTimeout(go, 60)); })()")

    def pick(self, paths):
        """Files chosen in the room's own dialogue."""
        root = self.browser.call("DOM.getDocument")["root"]["nodeId"]
        field = self.browser.call("DOM.querySelector", nodeId=root, selector=f"#{self.room}-file")["nodeId"]
        self.browser.call("DOM.setFileInputFiles", nodeId=field, files=[str(path) for path in paths])

    def run_room(self, seconds=120):
        self.click(f"#{self.room}-run")
        self.until(f"!rooms.{self.room}.running", seconds)

    @staticmethod
    def kept(name):
        return re.sub(r"^[-/\\]+|[/\\\0]", "_", name)

    def unzipped(self, folder):
        """The zip that the page gives, unpacked into a folder."""
        text = self.browser.value(f"zipOf(rooms.{self.room}.outFiles()).arrayBuffer().then((b) => base64Of(new Uint8Array(b)))")
        with zipfile.ZipFile(io.BytesIO(base64.b64decode(text))) as packed:
            self.assertIsNone(packed.testzip())
            packed.extractall(folder)

    def native(self, folder, *words, code=0):
        done = subprocess.run([jobs.CLAST, *map(str, words)], cwd=folder, capture_output=True, text=True, check=False, env=jobs.PLAIN, timeout=300)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout

    def command(self, folder, words=()):
        """The command that the page names, run natively in a folder with what it reads."""
        inputs = self.browser.value(f"JSON.stringify(Object.fromEntries(Object.entries(rooms.{self.room}.filesOf(rooms.{self.room}.words)).map(([n, b]) => [n, base64Of(b)])))")
        for name, content in json.loads(inputs).items():
            (pathlib.Path(folder) / name).write_bytes(base64.b64decode(content))
        said = shlex.split(self.text(f"{self.room}-command"))
        self.assertEqual(said[0], "clast")
        return self.native(folder, *said[1:], *words)

    def same_colours(self, report):
        """The view's colours, bars and their marks are those of the report of the same run; lengths within float32."""
        data = json.loads(re.search(r'class="view-data">(.*?)</script>', report.read_text(), re.S).group(1))
        here = json.loads(self.browser.value(f"JSON.stringify((({{bar, shape, shape_name, size, order}}) => ({{bar, shape, shape_name, size, order}}))(rooms.{self.room}.view.data))"))
        for key in ("bar", "shape", "shape_name"):
            self.assertEqual(here[key], data[key])
        for key in ("size", "order"):
            self.assertEqual([here[key][k] for k in ("title", "log")], [data[key][k] for k in ("title", "log")])
            self.assertEqual([text for _, text in here[key]["ticks"]], [text for _, text in data[key]["ticks"]])
            for mine, its in [(here[key][end], data[key][end]) for end in ("low", "high")] + [(a[0], b[0]) for a, b in zip(here[key]["ticks"], data[key]["ticks"])]:
                self.assertAlmostEqual(mine, its, delta=1e-5 * (1 + abs(its)))

    def at_once(self, action, told):
        """What the page tells in the same turn of its event loop as an action, whose CPU time is less than a tenth of a second: wall time is the machine's.
        Then nothing computes any more."""
        self.browser.call("Performance.enable")

        def cpu():
            return {one["name"]: one["value"] for one in self.browser.call("Performance.getMetrics")["metrics"]}["ThreadTime"]
        begun = cpu()
        said = self.browser.value(f"(() => {{ {action}; return {told}; }})()")
        self.assertLess(cpu() - begun, 0.1)
        self.until(f"rooms.{self.room}.engine.isReady", 60)
        time.sleep(3)  # the new worker is compiled
        begun = self.browser.cpu()
        time.sleep(2)
        self.assertLess(self.browser.cpu() - begun, 1.0)
        return said

    def memory(self):
        """Bytes of the page's heap that are in use."""
        self.browser.call("HeapProfiler.collectGarbage")
        return self.browser.call("Runtime.getHeapUsage")["usedSize"]


class Folder:
    """A folder for as long as it is used."""

    def __enter__(self):
        self.made = tempfile.TemporaryDirectory()
        return pathlib.Path(self.made.name)

    def __exit__(self, *_):
        self.made.cleanup()


def main():
    lacking = jobs.lacking(browser.CHROMIUM)
    if lacking:
        print(f"SKIPPED LOUDLY: {lacking}")
        raise SystemExit(0)
    unittest.main()
