"""Headless Chromium, spoken to over a pipe (Python's standard library suffices), and axe-core where it is at hand."""
import base64
import json
import os
import pathlib
import select
import shutil
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
AXE = "axe-core@4.14.1"
WEBGL = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")  # by the processor, whatever card is there
NO_WEBGL = ("--disable-gpu", "--disable-3d-apis")
NEIGHBOURS = ("--allow-file-access-from-files",)  # a page from disk reads the files beside it, which no reader's browser lets it: axe-core style sheets
CHROMIUM = os.environ.get("CHROMIUM", "chromium")  # another browser of its kind, such as chromium-headless-shell


class Browser:
    """One headless Chromium with one tab, by its debugging pipe; `flags`: how it draws."""

    def __init__(self, flags=("--disable-gpu",)):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_it, self.out = os.pipe()
        self.inp, from_it = os.pipe()

        def places():
            given, back = os.dup(to_it), os.dup(from_it)
            os.dup2(given, 3)
            os.dup2(back, 4)

        self.process = subprocess.Popen(
            [CHROMIUM, "--headless=new", "--no-sandbox", *flags, "--disable-dev-shm-usage", "--disable-extensions", "--hide-scrollbars", "--no-first-run",
             "--disable-component-update", "--disable-background-networking",
             f"--user-data-dir={self.profile.name}", "--remote-debugging-pipe", "about:blank"],
            preexec_fn=places, close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_it)
        os.close(from_it)
        self.buffer, self.number, self.session, self.events = b"", 0, None, []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def message(self):
        while b"\0" not in self.buffer:
            if not select.select([self.inp], [], [], 300)[0]:
                sys.exit("browser: chromium does not answer")
            read = os.read(self.inp, 1 << 20)
            if not read:
                sys.exit("browser: chromium ended")
            self.buffer += read
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **parameters):
        self.number += 1
        asked = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            asked["sessionId"] = self.session
        os.write(self.out, json.dumps(asked).encode() + b"\0") if len(json.dumps(asked)) < 60000 else self.write_long(asked)
        while True:
            said = self.message()
            if said.get("id") == self.number:
                if "error" in said:
                    sys.exit(f"browser: {method}: {said['error']['message']}")
                return said["result"]
            self.events.append(said)

    def write_long(self, asked):
        rest = json.dumps(asked).encode() + b"\0"
        while rest:
            rest = rest[os.write(self.out, rest):]

    def value(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            sys.exit(f"browser: {answer['exceptionDetails']['exception'].get('description')}")
        return answer["result"].get("value")

    def open(self, address):
        """Loads a page; the browser's word for why it cannot, or None."""
        self.events.clear()
        refused = self.call("Page.navigate", url=address).get("errorText")
        if refused:
            return refused
        while not any(e.get("method") == "Page.loadEventFired" for e in self.events):
            self.events.append(self.message())
        return None

    def screen(self, width, height, dark):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])

    def picture(self, path):
        shot = self.call("Page.captureScreenshot", format="png")
        path.write_bytes(base64.b64decode(shot["data"]))

    def family(self):
        """Its processes' numbers."""
        parent = {}
        for path in pathlib.Path("/proc").glob("[0-9]*/stat"):
            try:
                parent[int(path.parent.name)] = int(path.read_text().rsplit(")", 1)[1].split()[1])
            except OSError:
                continue  # it has just ended
        ours = {self.process.pid}
        while more := {child for child, of in parent.items() if of in ours} - ours:
            ours |= more
        return ours

    def cpu(self):
        """CPU seconds of all its processes: what a picture costs, however busy the machine is."""
        ticks = 0
        for number in self.family():
            try:
                ticks += sum(map(int, pathlib.Path(f"/proc/{number}/stat").read_text().rsplit(")", 1)[1].split()[11:13]))
            except OSError:
                continue
        return ticks / os.sysconf("SC_CLK_TCK")

    def memory(self):
        """Bytes that its processes hold, shared ones once."""
        held = 0
        for number in self.family():
            try:
                held += int(pathlib.Path(f"/proc/{number}/smaps_rollup").read_text().split("Pss:")[1].split()[0])
            except (OSError, IndexError):
                continue
        return held * 1024

    def close(self):
        self.process.terminate()
        self.process.wait(timeout=20)
        self.profile.cleanup()


def told(events):
    """What the page said or could not load, and what it asked of other machines."""
    for event in events:
        method, given = event.get("method"), event.get("params", {})
        if method == "Log.entryAdded":
            yield f"console: {given['entry']['text']} {given['entry'].get('url', '')}"
        elif method == "Runtime.consoleAPICalled":
            yield "console: " + " ".join(str(a.get("value", a.get("description"))) for a in given["args"])
        elif method == "Runtime.exceptionThrown":
            yield f"script: {given['exceptionDetails'].get('exception', {}).get('description', given['exceptionDetails']['text'])}"
        elif method == "Network.requestWillBeSent" and given["request"]["url"].split(":")[0] in ("http", "https", "ws", "wss"):
            yield f"fetched from elsewhere: {given['request']['url']}"


def axe_source():
    """axe-core's script, or None: AXE names its file, else npm fetches the pinned one."""
    if os.environ.get("AXE"):
        return pathlib.Path(os.environ["AXE"]).read_text()
    if not shutil.which("npm"):
        return None
    kept = ROOT / "build/docs/axe.min.js"
    kept.parent.mkdir(parents=True, exist_ok=True)
    if not kept.exists():
        with tempfile.TemporaryDirectory() as folder:
            try:
                subprocess.run(["npm", "pack", "--silent", AXE], cwd=folder, capture_output=True, timeout=60, check=True)
            except (subprocess.CalledProcessError, subprocess.TimeoutExpired):
                return None
            packed = list(pathlib.Path(folder).glob("*.tgz"))
            with tarfile.open(packed[0]) as pack:
                kept.write_bytes(pack.extractfile("package/axe.min.js").read())
    return kept.read_text()
