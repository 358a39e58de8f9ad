#!/usr/bin/env python3
"""Wheels and the source release for pip, with Python's standard library alone.

As the backend of pyproject.toml (PEP 517) it builds both C libraries with the parts that are installed on the machine, for that machine:
`pip install .`. tools/wheel.sh calls it for the wheel that carries all its parts: tools/wheel_backend.py pack OUT TAG STAGE. `metadata` prints
the core metadata, which `make dist` puts into the source release as PKG-INFO. The same input and SOURCE_DATE_EPOCH give the same bytes.
"""
import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
VERSION = (ROOT / "VERSION").read_text().strip()
INFO = f"clast-{VERSION}.dist-info"
TOOLS = {"cmake": "cmake>=3.25", "ninja": "ninja"}


def metadata():
    head = f"""Metadata-Version: 2.1
Name: clast
Version: {VERSION}
Summary: Particles that stick, settle and cluster: virtual aggregates, packings of grains, clouds split into cells
License: BSD-3-Clause
Classifier: License :: OSI Approved :: BSD License
Classifier: Operating System :: POSIX :: Linux
Classifier: Programming Language :: C
Classifier: Programming Language :: Python :: 3
Classifier: Topic :: Scientific/Engineering :: Physics
Requires-Python: >=3.10
Requires-Dist: numpy>=1.21
Description-Content-Type: text/markdown
"""
    page = (ROOT / "docs/python.md").read_text()
    return head + "\n" + page


def epoch():
    """Of the files in a wheel; zip knows no time before 1980."""
    return max(int(os.environ.get("SOURCE_DATE_EPOCH") or (ROOT / "CMakeLists.txt").stat().st_mtime), 315532800)


def pack(out, tag, files):
    """The wheel of files, {name in the wheel: path or bytes}; returns its name."""
    files = dict(files)
    for path in sorted((ROOT / "python/clast").iterdir()):
        if path.suffix == ".py" or path.name == "py.typed":
            files[f"clast/{path.name}"] = path
    files[f"{INFO}/METADATA"] = metadata().encode()
    files[f"{INFO}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: clast {VERSION}\nRoot-Is-Purelib: false\nTag: py3-none-{tag}\n".encode()
    name = f"clast-{VERSION}-py3-none-{tag}.whl"
    record = []
    with zipfile.ZipFile(out / name, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as wheel:
        def write(at, content, mode):
            entry = zipfile.ZipInfo(at, time.gmtime(epoch())[:6])
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, content)

        for at in sorted(files, key=lambda at: (at.startswith(INFO), at)):
            content = files[at] if isinstance(files[at], bytes) else files[at].read_bytes()
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record.append(f"{at},sha256={digest},{len(content)}")
            write(at, content, 0o755 if at.endswith("/scripts/clast") or ".so" in at else 0o644)
        write(f"{INFO}/RECORD", "\n".join([*record, f"{INFO}/RECORD,,", ""]), 0o644)
    return name


def staged(folder):
    """The files below a folder that is laid out as the wheel is."""
    return {str(path.relative_to(folder)): path for path in sorted(folder.rglob("*")) if path.is_file()}


def run(*words):
    done = subprocess.run(words, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.stderr.write(done.stdout[-4000:])
        sys.exit(f"clast: {' '.join(words[:2])} failed (above); tools/setup.sh build installs what is missing on Debian 12")
    return done.stdout


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """PEP 517: libraries and command linked with what this machine has."""
    build, stage = ROOT / "build/wheel", ROOT / "build/wheel/stage"
    run("cmake", "--preset", "release", "-B", str(build), "-DBUILD_TESTING=OFF", "-DCLAST_BENCH=OFF", "-DCLAST_MPI=OFF", "-DCMAKE_INSTALL_LIBDIR=lib")
    run("cmake", "--build", str(build))
    shutil.rmtree(stage, ignore_errors=True)
    run("cmake", "--install", str(build), "--prefix", str(stage), "--strip")
    interface = VERSION.rpartition(".")[0]
    files = {f"clast/{soname}": stage / "lib" / soname for soname in (f"libclast.so.{interface}", f"libclast_view.so.{interface}")}
    files[f"clast-{VERSION}.data/scripts/clast"] = stage / "bin/clast"
    files[f"{INFO}/licenses/LICENSE"] = ROOT / "LICENSE"
    return pack(pathlib.Path(wheel_directory), f"linux_{os.uname().machine}", files)


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """PEP 517: without it pip builds the whole to read the name."""
    folder = pathlib.Path(metadata_directory, INFO)
    folder.mkdir()
    (folder / "METADATA").write_text(metadata())
    return INFO


def build_sdist(sdist_directory, config_settings=None):
    """PEP 517: the source release, which has PKG-INFO."""
    run("tools/dist.sh")
    name = f"clast-{VERSION}.tar.gz"
    shutil.copyfile(ROOT / "build" / name, pathlib.Path(sdist_directory, name))
    return name


def get_requires_for_build_wheel(config_settings=None):
    return [package for tool, package in TOOLS.items() if shutil.which(tool) is None]


def main(words):
    if words == ["metadata"]:
        print(metadata(), end="")
    elif len(words) == 4 and words[0] == "pack":
        print(pack(pathlib.Path(words[1]), words[2], staged(pathlib.Path(words[3]))))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
