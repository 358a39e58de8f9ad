#!/usr/bin/env python3
"""Runs every shell block of the documents, in order, in a clean folder for each document: tools/check_docs_commands.py CLAST [FILE...]

CLAST is the built command, `clast` in the blocks. The folder holds copies of data/ and examples/, so paths are those of a clone's
root. A command must end with 0, or with the code that its comment states ("# exit code 1: ..."). A block that cannot run here says
why in its first line (```sh needs=WORD), WORD one of NEEDS; output is shown in ```text blocks, which are not run.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
NEEDS = {"cluster": "more than one machine or its queue", "install": "installs packages or builds: run by CI itself",
         "long": "more than a minute"}
FENCE = re.compile(r"^( *)(`{3,}|~{3,})[ ]*([^`]*)$")
SHELLS = ("sh", "bash", "shell", "console")


def documents():
    listed = subprocess.run([ROOT / "tools/list_files.sh", "*.md"], capture_output=True, text=True, check=True).stdout
    return [name for name in listed.split("\0") if name and name != "CHANGELOG.md" and not name.startswith("web/")]


def blocks(text):
    """(line of the fence, its words, the lines inside) of each fenced block."""
    fence, start, inside = None, 0, []
    for number, line in enumerate(text.splitlines(), 1):
        found = FENCE.match(line)
        if fence is None and found:
            fence, start, inside = found, number, []
        elif fence is not None and found and found[2].startswith(fence[2]) and not found[3]:
            yield start, fence[3].split(), inside
            fence = None
        elif fence is not None:
            inside.append(line[len(fence[1]):] if line.startswith(fence[1]) else line)


def is_whole(command):
    return not command.endswith("\\\n") and subprocess.run(["bash", "-nc", command], capture_output=True, check=False).returncode == 0


def commands(start, lines):
    """(line number, text) of each command of a block; one may go over several lines."""
    command, first = "", start + 1
    for number, line in enumerate(lines, start + 1):
        if not command:
            if not line.strip() or line.lstrip().startswith("#"):
                continue
            first = number
        command += line + "\n"
        if is_whole(command):
            yield first, command
            command = ""
    if command:
        yield first, command


def script(name, found):
    """One shell program of a block's commands, which stops at the first that ends otherwise than stated."""
    text = ""
    for number, command in found:
        stated = re.search(r"#.*\bexit code (\d+)", command)
        text += (f"{command}_code=$?\n[ $_code -eq {stated[1] if stated else 0} ] || "
                 f"{{ echo {shlex.quote(f'{name}:{number}: exit code')} $_code: {shlex.quote(command.strip())} >&2; exit 1; }}\n")
    return text


def run_document(name, environment):
    """(blocks run, blocks marked, faults)"""
    n_run, n_marked, faults = 0, 0, []
    with tempfile.TemporaryDirectory() as folder:
        for part in ("data", "examples"):
            shutil.copytree(ROOT / part, pathlib.Path(folder, part))
        for start, words, lines in blocks((ROOT / name).read_text()):
            if not words:
                faults.append(f"{name}:{start}: a block without a language (```sh is run, ```text is not)")
            if not words or words[0] not in SHELLS:
                continue
            marks = [word.removeprefix("needs=") for word in words[1:]]
            unknown = [mark for mark in marks if mark not in NEEDS]
            if unknown:
                faults.append(f"{name}:{start}: unknown mark {unknown[0]}, known are needs={'|'.join(NEEDS)}")
            elif marks:
                n_marked += 1
            else:
                n_run += 1
                faults += run_block(script(name, commands(start, lines)), folder, environment)
    return n_run, n_marked, faults


def run_block(text, folder, environment):
    try:
        done = subprocess.run(["bash", "-uc", text], cwd=folder, env=environment, capture_output=True, text=True, check=False, timeout=600)
    except subprocess.TimeoutExpired:
        return [f"a block took more than 600 s:\n{text}"]
    return [done.stderr[-2000:].rstrip()] if done.returncode else []


def main():
    if len(sys.argv) < 2 or not os.access(sys.argv[1], os.X_OK):
        sys.exit("usage: tools/check_docs_commands.py CLAST [FILE...]")
    began, n_run, n_marked, faults = time.monotonic(), 0, 0, []
    with tempfile.TemporaryDirectory() as found_first:
        os.symlink(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(found_first, "clast"))
        environment = {**os.environ, "PATH": f"{found_first}:{os.environ['PATH']}"}
        for name in sys.argv[2:] or documents():
            ran, marked, wrong = run_document(name, environment)
            n_run, n_marked, faults = n_run + ran, n_marked + marked, faults + wrong
    for fault in faults:
        print(fault)
    print(f"documents: {n_run} shell blocks run, {n_marked} marked as not for here, {len(faults)} faults, {time.monotonic() - began:.0f} s")
    return 1 if faults else 0


sys.exit(main())
