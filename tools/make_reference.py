#!/usr/bin/env python3
"""Writes the pages of the reference that are made, not written, into docs/reference: tools/make_reference.py

The C interface is one page a header, filled by Doxygen and Breathe; verdicts.md counts the judged rows of docs/validation. A page that stays as it was is not touched, so that Sphinx reads
only what has changed.
"""
import collections
import csv
import pathlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
TO = ROOT / "docs/reference"


def pages_of_headers():
    """(name, text) of a page for each public header, and of their index."""
    names = sorted(path.stem for path in (ROOT / "include/clast").glob("*.h") if path.stem != "clast")
    entries = "\n".join(names)
    yield "c/index", f"# C interface\n\nEvery public header; `clast/clast.h` includes them all.\n\n```{{toctree}}\n:maxdepth: 1\n\n{entries}\n```\n"
    for name in names:
        yield f"c/{name}", f"# {name}.h\n\n```{{doxygenfile}} {name}.h\n```\n"


def verdicts():
    """A table of how many rows of each validation's CSV were judged, and how."""
    lines = ["| rows in | judged | pass | open | fail |", "| --- | --- | --- | --- | --- |"]
    for path in sorted((ROOT / "docs/validation").glob("*.csv")):
        with path.open(encoding="utf-8") as file:
            told = collections.Counter(row["verdict"] for row in csv.DictReader(file) if row.get("verdict", "").lower() in ("pass", "open", "fail"))
        if told:
            lines.append(f"| `{path.name}` | {sum(told.values())} | {told['pass']} | {told['open']} | {told['fail'] + told['FAIL']} |")
    yield "verdicts", "\n".join(lines) + "\n"


def write_page(name, text):
    path = TO / f"{name}.md"
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
    return path


def main():
    made = {write_page(name, text) for make in (pages_of_headers, verdicts) for name, text in make()}
    for path in TO.rglob("*.md"):
        if path not in made:
            path.unlink()
    print(f"reference: {len(made)} pages")


main()
