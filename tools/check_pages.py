#!/usr/bin/env python3
"""Every page of docs/theory ends with when not to use its method, and every source that it names is an entry of its references.

usage: tools/check_pages.py [PAGE...]

A source is cited by its key, [Welzl1991] or [Cook1977, sec. 2] (in a table the bare key does), and listed under "## References" (or "## Sources") as
`- [Welzl1991] ...`; no key without an entry, no entry uncited, no author and year in prose instead of a key. A page that draws on
nothing published says so there, beginning with "None".

In all documents, headers, sources and notebooks a page that is named (docs/theory/dem.md) is there; in the documents also each file and each
function in back quotes.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
KEY = re.compile(r"\b([A-Z][A-Za-z]+(?:1[6-9]|20)\d\d[a-z]?)\b")
PROSE = re.compile(r"\b[A-Z][^\W\d_]+(?:'s)?(?: et al\.?)?,? \(?(?:1[89]|20)\d\d\)?(?![\d,.]*\d)")
NOT_AUTHORS = re.compile(r"\b(?:With|At|Of|In|Than|Beyond|Above|Below|To|From|Up)\b")


def section(text, title):
    """Text of a section to the next one of its level, or None."""
    found = re.search(rf"^## {title}\n(.*?)(?=^## |\Z)", text, re.M | re.S)
    return found.group(1) if found else None


def without_code(text):
    return re.sub(r"`[^`\n]*`|^```.*?^```", "", text, flags=re.M | re.S)


def faults_of(path):
    text = without_code(path.read_text(encoding="utf-8"))
    references = section(text, "(?:References|Sources)")
    limits = section(text, "When not to use this")
    faults = []
    if limits is None or len(limits.split()) < 20:
        faults.append("no section '## When not to use this' that says something")
    if references is None:
        return [*faults, "no section '## References'"]
    titles = re.findall(r"^## (.*)$", text, re.M)
    if titles[-2:-1] != ["When not to use this"]:
        faults.append("its last two sections are not 'When not to use this' and the references")
    body = text.replace(references, "")
    entries = re.findall(r"^- \[([^\]\n]+)\]", references, re.M)
    cited = set(KEY.findall(body))
    faults += [f"[{key}] is cited and not listed" for key in sorted(cited - set(entries))]
    faults += [f"[{key}] is listed and not cited" for key in sorted(set(entries) - cited)]
    faults += [f"[{key}] is listed twice" for key in sorted({key for key in entries if entries.count(key) > 1})]
    faults += [f"'{found.group(0)}' is cited in prose: give its key" for found in PROSE.finditer(body)
               if not NOT_AUTHORS.match(found.group(0))]
    if not entries and not references.strip().startswith("None"):
        faults.append("references without an entry `- [Key] ...`, which do not begin with 'None'")
    return faults


def texts(*patterns):
    for pattern in patterns:
        for path in sorted(ROOT.glob(pattern)):
            if "docs/reference" not in path.as_posix():
                yield path.relative_to(ROOT), path.read_text(encoding="utf-8")


def faults_of_names():
    """What documents and sources name and is not there. Decisions (docs/adr) tell of what was, and are left out."""
    known = set()
    for _, text in texts("include/clast/*.h", "src/*/*.[ch]", "cli/*.c"):
        known.update(re.findall(r"\bcl(?:ast|x)_[a-z0-9_]+", text))
    for path, text in texts("README.md", "docs/*.md", "docs/*/*.md", "include/clast/*.h", "src/*/*.[ch]", "cli/*.[ch]", "examples/notebooks/*.ipynb", "examples/**/*.yaml"):
        for name in sorted(set(re.findall(r"\bdocs/[a-z0-9_/-]+\.md\b", text))):
            if not (ROOT / name).exists():
                yield f"{path}: {name} is not there"
        if path.suffix != ".md" or path.match("docs/adr/*"):
            continue
        for name in sorted(set(re.findall(r"`(cl(?:ast|x)_[a-z0-9_]+)`", text)) - known):
            if not name.endswith("_"):
                yield f"{path}: {name} is no function, type or table"
        for name in sorted(set(re.findall(r"(?<![\w./-])(?:src|tests|tools|cli|bench|examples|data)/[a-z0-9_./-]+\.(?:c|h|py|sh|yaml|csv|md|def|js)\b", text))):
            if not (ROOT / name).exists():
                yield f"{path}: {name} is not there"


def main():
    pages = [pathlib.Path(p) for p in sys.argv[1:]] or sorted(p for p in (ROOT / "docs/theory").glob("*.md") if p.stem != "index")
    n_fault = 0
    for page in pages:
        for fault in faults_of(page):
            n_fault += 1
            print(f"{page.name}: {fault}")
    for fault in [] if sys.argv[1:] else faults_of_names():
        n_fault += 1
        print(fault)
    print(f"pages: {len(pages)} looked at, {n_fault} faults")
    return 1 if n_fault else 0


if __name__ == "__main__":
    sys.exit(main())
