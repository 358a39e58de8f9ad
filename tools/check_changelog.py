#!/usr/bin/env python3
"""Fails when a public header that changed since the last release is not named in CHANGELOG's Unreleased *Interface*.

The last release is the commit that brought CHANGELOG its newest section of a version; the file VERSION may name the next one.
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def git(*arguments):
    return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False).stdout


def changed_headers():
    version = re.search(r"^## (\d[\d.]*) \(", (ROOT / "CHANGELOG.md").read_text(), flags=re.M).group(1)
    release = git("log", "--reverse", "--format=%H", f"-S## {version} (", "--", "CHANGELOG.md").partition("\n")[0]
    if not release:
        return []
    return [pathlib.PurePath(name).name for name in git("diff", "--name-only", release, "HEAD", "--", "include/clast").split()]


def interface_text():
    unreleased = re.split(r"^## ", (ROOT / "CHANGELOG.md").read_text(), flags=re.M)[1]
    sections = re.split(r"^### ", unreleased, flags=re.M)
    return next((s for s in sections if s.startswith("Interface")), "")


def main():
    if not (ROOT / ".git").exists():
        print("changelog: no git clone, so it is not known which headers changed")
        return 0
    named = set(re.findall(r"[\w]+\.h", interface_text()))
    missing = [name for name in changed_headers() if name not in named and name != "clast.h"]
    if missing:
        print(f"CHANGELOG.md, Unreleased, Interface: name these changed headers: {', '.join(missing)}")
    return 1 if missing else 0


sys.exit(main())
