#!/usr/bin/env python3
"""Makes the pictures of docs/gallery.md by the commands under them: tools/make_gallery.py [CLAST]

The shell blocks run in order in an empty folder with data/ and examples/; a picture docs/reference/gallery/NAME that the page shows is
the file NAME there. Nothing is run where page and command are those of the pictures that lie there.
"""
import hashlib
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TO = ROOT / "docs/reference/gallery"
MOST_S = 60.0  # CPU of all


def main():
    clast = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/clast").resolve()
    page = (ROOT / "docs/gallery.md").read_text(encoding="utf-8")
    wanted = re.findall(r"\]\(reference/gallery/([^)]+)\)", page)
    made_by = hashlib.sha256(page.encode() + clast.read_bytes()).hexdigest()
    stamp = TO / "made-by"
    if stamp.exists() and stamp.read_text() == made_by and all((TO / name).exists() for name in wanted):
        return
    shutil.rmtree(TO, ignore_errors=True)
    TO.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as folder:
        for part in ("data", "examples"):
            os.symlink(ROOT / part, pathlib.Path(folder, part))
        os.mkdir(pathlib.Path(folder, ".bin"))
        os.symlink(clast, pathlib.Path(folder, ".bin/clast"))
        environment = {**os.environ, "PATH": f"{folder}/.bin:{os.environ['PATH']}"}
        for block in re.findall(r"^```sh\n(.*?)^```$", page, re.M | re.S):
            done = subprocess.run(["bash", "-euc", block], cwd=folder, env=environment, capture_output=True, text=True, check=False)
            if done.returncode:
                sys.exit(f"gallery: {block}{done.stderr}")
        for name in wanted:
            shutil.copyfile(pathlib.Path(folder, name), TO / name)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = used.ru_utime + used.ru_stime
    if seconds > MOST_S:
        sys.exit(f"gallery: {seconds:.0f} s of CPU, at most {MOST_S:.0f}: make a picture cheaper")
    stamp.write_text(made_by)
    print(f"gallery: {len(wanted)} pictures, {seconds:.0f} s of CPU")


main()
