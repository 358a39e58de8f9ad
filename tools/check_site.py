#!/usr/bin/env python3
"""Every page of the built site as a reader sees it, in headless Chromium: tools/check_site.py [-j N] [--sample] [--only WORD] [--pictures FOLDER] [FOLDER]

Looked for on each page, at desktop width in light and dark and at 375 px: formulas left as TeX, messages on the console, anything that
fails to load or is fetched from elsewhere, a page wider than the screen, links inside the site that lead nowhere, a search that finds nothing; and what a reader
with a screen reader or weak eyes needs: language, one h1, headings in order, names of links, buttons, fields and pictures, ids that are
unique, contrast (4.5, large text 3). Where axe-core is at hand (AXE=FILE, or npm and a registry) its serious and critical findings count
too. --pictures writes what was seen as PNG. Needs chromium (tools/setup.sh site); it is spoken to over a pipe, Python's standard library suffices.
"""
import argparse
import base64
import concurrent.futures
import html
import json
import os
import pathlib
import queue
import re
import select
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent
AXE = "axe-core@4.14.1"
AXE_RUN = """axe.run(document, {resultTypes: ["violations"]ONLY}).then(r => r.violations
    .filter(v => ["serious", "critical"].includes(v.impact)).map(v => `${v.id}: ${v.nodes.length} of ${v.nodes[0].html.slice(0, 160)}`))"""
MADE_ALIKE = ("reference/c", "reference/commands")
LOOK = (ROOT / "tools/check_site.js").read_text()


class Browser:
    """One headless Chromium with one tab, by its debugging pipe."""

    def __init__(self):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_it, self.out = os.pipe()
        self.inp, from_it = os.pipe()

        def places():
            given, back = os.dup(to_it), os.dup(from_it)
            os.dup2(given, 3)
            os.dup2(back, 4)

        self.process = subprocess.Popen(
            ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--disable-extensions", "--hide-scrollbars", "--no-first-run",
             "--disable-component-update", "--disable-background-networking", "--allow-file-access-from-files",
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
            if not select.select([self.inp], [], [], 120)[0]:
                sys.exit("check_site: chromium does not answer")
            read = os.read(self.inp, 1 << 20)
            if not read:
                sys.exit("check_site: chromium ended")
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
                    sys.exit(f"check_site: {method}: {said['error']['message']}")
                return said["result"]
            self.events.append(said)

    def write_long(self, asked):
        rest = json.dumps(asked).encode() + b"\0"
        while rest:
            rest = rest[os.write(self.out, rest):]

    def value(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            sys.exit(f"check_site: {answer['exceptionDetails']['exception'].get('description')}")
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


def broken(page, site, links, ids):
    """Links inside the site that lead to no file or no place in it."""
    for link in links:
        parts = urllib.parse.urlsplit(link)
        if parts.scheme != "file":
            continue
        to = pathlib.Path(urllib.parse.unquote(parts.path))
        if not to.is_file():
            yield f"link to nothing: {link}"
        elif site not in to.parents:
            yield f"link out of the site: {link}"
        elif parts.fragment and to.suffix == ".html":
            if to not in ids:
                ids[to] = set(map(html.unescape, re.findall(r'\b(?:id|name)="([^"]+)"', to.read_text(encoding="utf-8"))))
            if urllib.parse.unquote(parts.fragment) not in ids[to]:
                yield f"link to no place of the page: {link}"


SETTLED = """new Promise(done => requestAnimationFrame(() => setTimeout(done, 200)))
    .then(() => Promise.race([Promise.allSettled(document.getAnimations().map(a => a.finished)), new Promise(done => setTimeout(done, 1000))]))
    .then(() => 0)"""  # the page's own answer to a new width, and colours that fade into others


def look(browser, page, site, axe, ids, pictures):
    faults = set()
    browser.screen(1280, 900, False)
    refused = browser.open(page.as_uri())
    if refused:
        return [f"does not load: {refused}"]
    for name, width, height, dark in (("light", 1280, 900, False), ("dark", 1280, 900, True), ("phone", 375, 812, False)):
        browser.screen(width, height, dark)
        browser.value(SETTLED)
        faults |= set(told(browser.events))
        seen = browser.value(f"({LOOK})()")
        faults |= {f"{name}: {fault}" for fault in seen["faults"]}
        if name == "light":
            faults |= set(broken(page, site, seen["links"], ids))
        if axe and name != "phone":
            browser.value("window.axe ? 0 : (window.eval(" + json.dumps(axe) + "), 0)")
            only = ", runOnly: {type: 'rule', values: ['color-contrast']}" if dark else ""
            found = browser.value(AXE_RUN.replace("ONLY", only))
            faults |= {f"{name}: axe {fault}" for fault in found}
        if pictures:
            browser.picture(pictures / f"{page.relative_to(site).as_posix().replace('/', '-')[:-5]}-{name}.png")
    return sorted(faults)


FOUND = """new Promise(done => {
    const until = Date.now() + 20000, count = () => document.querySelectorAll("#search-results li").length;
    const look = () => count() >= 5 || Date.now() > until ? done(count()) : setTimeout(look, 100);
    look();
})"""


def search_fault(browser, site):
    """What is wrong with the search for a word that many pages have, or None."""
    refused = browser.open((site / "search.html").as_uri() + "?q=porosity")
    if refused:
        return f"search.html: does not load: {refused}"
    return None if browser.value(FOUND) >= 5 else "search.html: a search for porosity finds less than 5 pages"


def sample(pages, site):
    """All pages but those of a template, of which the largest three stand for the others."""
    for folder in MADE_ALIKE:
        alike = sorted((p for p in pages if p.parent == site / folder), key=lambda p: p.stat().st_size)
        pages = [p for p in pages if p not in alike[:-3]]
    return pages


def main():
    asked = argparse.ArgumentParser()
    asked.add_argument("--pictures", type=pathlib.Path)
    asked.add_argument("--only", default="", help="pages with this in their path")
    asked.add_argument("--sample", action="store_true", help="of the pages that one template makes, the largest three only")
    asked.add_argument("-j", "--jobs", type=int, default=min(os.cpu_count() or 1, 4), help="browsers at a time")
    asked.add_argument("site", nargs="?", type=pathlib.Path, default=ROOT / "build/docs/html")
    asked = asked.parse_args()
    if not shutil.which("chromium"):
        print("site: no chromium here, pages not looked at (tools/setup.sh site)")
        return 0
    began, site = time.monotonic(), asked.site.resolve()
    pages = sorted(p for p in site.rglob("*.html") if "_static" not in p.parts and asked.only in str(p.relative_to(site)))
    n_page = len(pages)
    pages = sample(pages, site) if asked.sample else pages
    if not pages:
        sys.exit(f"site: {site} has no pages; run tools/docs.sh")
    if asked.pictures:
        asked.pictures.mkdir(parents=True, exist_ok=True)
    axe, ids, n_fault, free = axe_source(), {}, 0, queue.SimpleQueue()
    browsers = [Browser() for _ in range(min(asked.jobs, len(pages)))]
    for browser in browsers:
        free.put(browser)

    def faults_of(page):
        browser = free.get()
        try:
            return page, look(browser, page, site, axe, ids, asked.pictures)
        finally:
            free.put(browser)

    with concurrent.futures.ThreadPoolExecutor(len(browsers)) as pool:
        for page, found in pool.map(faults_of, pages):
            n_fault += len(found)
            for fault in found:
                print(f"{page.relative_to(site)}: {fault}", flush=True)
    unfound = None if asked.only else search_fault(browsers[0], site)
    if unfound:
        n_fault += 1
        print(unfound)
    for browser in browsers:
        browser.close()
    size = sum(p.stat().st_size for p in site.rglob("*") if p.is_file()) / 1e6
    with_axe = AXE if axe else "own rules only, no axe-core here"
    print(f"site: {len(pages)} of {n_page} pages, {size:.1f} MB, read in {time.monotonic() - began:.0f} s ({with_axe}), {n_fault} faults")
    return 1 if n_fault else 0


if __name__ == "__main__":
    sys.exit(main())
