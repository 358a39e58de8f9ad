#!/usr/bin/env python3
"""Runs every shell and Python block of the documents, in order, in a clean folder for each document, as many documents at a time as
there are cores: tools/check_docs_commands.py CLAST [FILE...]

CLAST is the built command, `clast` in the blocks. The folder holds copies of data/ and examples/, so paths are those of a clone's
root. A command must end with 0, or with the code that its comment states ("# exit code 1: ..."). A block that cannot run here says
why in its first line (```sh needs=WORD), WORD one of NEEDS; output is shown in ```text blocks, which are not run. Each line of a
```text output block must be in what the block before it has printed ("..." stands for anything). The Python blocks of a document are
one program, which runs where libclast_view.so and NumPy are: beside CLAST, by PYTHON (/usr/bin/python3).
"""
import concurrent.futures
import json
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
PYTHON = os.environ.get("PYTHON", "/usr/bin/python3")
SHELLS = ("sh", "bash", "shell", "console")


def documents():
    """All of them but the gallery, whose blocks run when the site is built (tools/make_gallery.py)."""
    listed = subprocess.run([ROOT / "tools/list_files.sh", "*.md"], capture_output=True, text=True, check=True).stdout
    return [name for name in listed.split("\0") if name and name not in ("CHANGELOG.md", "docs/gallery.md") and not name.startswith("web/")]


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
    read = subprocess.run(["bash", "-nc", command], capture_output=True, check=False)
    return not command.endswith("\\\n") and read.returncode == 0 and b"here-document" not in read.stderr


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
    n_run, n_marked, faults, printed, python = 0, 0, [], "", None
    with tempfile.TemporaryDirectory() as folder:
        for part in ("data", "examples"):
            shutil.copytree(ROOT / part, pathlib.Path(folder, part))
        for start, words, lines in blocks((ROOT / name).read_text()):
            where = f"{name}:{start}"
            if not words:
                faults.append(f"{where}: a block without a language (```sh is run, ```text is not)")
                continue
            if words == ["text", "output"]:
                faults += [f"{where}: not printed by the block before: {line}" for line in lines if not is_printed(line, printed)]
            if words[0] not in (*SHELLS, "python"):
                continue
            marks = [word.removeprefix("needs=") for word in words[1:]]
            unknown = [mark for mark in marks if mark not in NEEDS]
            if unknown:
                faults.append(f"{where}: unknown mark {unknown[0]}, known are needs={'|'.join(NEEDS)}")
            elif marks or words[0] == "python" and "CLAST_LIBRARY" not in environment:
                n_marked += 1
            elif words[0] == "python":
                n_run += 1
                python = python or Python(folder, environment)
                printed, wrong = python.run("\n".join(lines))
                faults += [f"{where}: {fault}" for fault in wrong]
            else:
                n_run += 1
                printed, wrong = run_block(where, ["bash", "-uc", script(name, commands(start, lines))], folder, environment)
                faults += wrong
        if python:
            python.close()
    return n_run, n_marked, faults


class Python:
    """An interpreter that goes on from block to block."""

    LOOP = """
import contextlib, io, json, sys, traceback
names = {}
for line in sys.stdin:
    printed, fault = io.StringIO(), ""
    try:
        with contextlib.redirect_stdout(printed):
            exec(json.loads(line), names)
    except BaseException:
        fault = traceback.format_exc()
    print(json.dumps([printed.getvalue(), fault]), flush=True)
"""

    def __init__(self, folder, environment):
        self.process = subprocess.Popen([PYTHON, "-c", self.LOOP], cwd=folder, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def run(self, text):
        """(printed, faults)"""
        self.process.stdin.write(json.dumps(text) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        if not answer:
            return "", [f"Python ended: {text}"]
        printed, fault = json.loads(answer)
        return printed, [fault.rstrip()] if fault else []

    def close(self):
        self.process.stdin.close()
        self.process.wait(timeout=60)


def is_printed(line, printed):
    """Whether the parts of a line between "..." stand in this order in a line that was printed, spaces apart."""
    squeezed = [" ".join(part.split()) for part in line.split("...")]
    pattern = ".*".join(re.escape(part) for part in squeezed)
    return any(re.search(pattern, " ".join(told.split())) for told in printed.splitlines())


def run_block(where, program, folder, environment):
    """(stdout, faults)"""
    try:
        done = subprocess.run(program, cwd=folder, env=environment, capture_output=True, text=True, check=False, timeout=600)
    except subprocess.TimeoutExpired:
        return "", [f"{where}: the block took more than 600 s"]
    return done.stdout, [done.stderr[-2000:].rstrip()] if done.returncode else []


def main():
    if len(sys.argv) < 2 or not os.access(sys.argv[1], os.X_OK):
        sys.exit("usage: tools/check_docs_commands.py CLAST [FILE...]")
    began, n_run, n_marked, faults = time.monotonic(), 0, 0, []
    with tempfile.TemporaryDirectory() as found_first:
        os.symlink(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(found_first, "clast"))
        environment = {**os.environ, "PATH": f"{found_first}:{os.environ['PATH']}", "PYTHONPATH": str(ROOT / "python")}
        library = pathlib.Path(sys.argv[1]).resolve().parent / "libclast_view.so"
        if library.exists() and subprocess.run([PYTHON, "-c", "import numpy"], capture_output=True, check=False).returncode == 0:
            environment["CLAST_LIBRARY"] = str(library)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for ran, marked, wrong in pool.map(lambda name: run_document(name, environment), sys.argv[2:] or documents()):
                n_run, n_marked, faults = n_run + ran, n_marked + marked, faults + wrong
    for fault in faults:
        print(fault)
    print(f"documents: {n_run} blocks run, {n_marked} marked as not for here, {len(faults)} faults, {time.monotonic() - began:.0f} s")
    return 1 if faults else 0


sys.exit(main())
