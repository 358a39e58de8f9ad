#!/usr/bin/env python3
"""Every page of the built site as a reader sees it, in headless Chromium: tools/check_site.py [-j N] [--sample] [--only WORD] [--pictures FOLDER] [FOLDER]

Looked for on each page, at desktop width in light and dark and at 375 px: formulas left as TeX, messages on the console, anything that
fails to load or is fetched from elsewhere, a page wider than the screen, links inside the site that lead nowhere, a search that finds nothing; and what a reader
with a screen reader or weak eyes needs: language, one h1, headings in order, names of links, buttons, fields and pictures, ids that are
unique, contrast (4.5, large text 3). Where axe-core is at hand (AXE=FILE, or npm, of tools/setup.sh site, and a registry) its serious and critical findings count
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
import time
import urllib.parse

from browser import AXE, CHROMIUM, NEIGHBOURS, Browser, axe_source, told

ROOT = pathlib.Path(__file__).resolve().parent.parent
AXE_RUN = """axe.run(document, {resultTypes: ["violations"]ONLY}).then(r => r.violations
    .filter(v => ["serious", "critical"].includes(v.impact)).map(v => `${v.id}: ${v.nodes.length} of ${v.nodes[0].html.slice(0, 160)}`))"""
MADE_ALIKE = ("reference/c", "reference/commands")
LOOK = (ROOT / "tools/check_site.js").read_text()


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
    if not shutil.which(CHROMIUM):
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
    browsers = [Browser(("--disable-gpu", *NEIGHBOURS)) for _ in range(min(asked.jobs, len(pages)))]
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
