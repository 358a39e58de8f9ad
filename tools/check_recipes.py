#!/usr/bin/env python3
"""Headers, documents and recipes of packages name the release of the file VERSION and its sonames, and no option that CMakeLists.txt does not have:
tools/check_recipes.py"""
import ast
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
VERSIONS = {"CITATION.cff": r"^version: (\S+)", "packaging/debian/changelog": r"\Aclast \(([0-9.]+)-", "packaging/conda/meta.yaml": r'set version = "([^"]+)"',
            "packaging/spack/packages/clast/package.py": r'\bversion\("([^"]+)"', "python/clast/_bindings.py": r"^VERSION = '([^']+)'",
            "include/clast/status.h": r'^#define CLAST_VERSION_TEXT +"([^"]+)"', "docs/install.md": r"\bclast[-_](\d+[.]\d+[.]\d+)"}
SONAMES = {"packaging/debian/control": r"^Package: libclast(?:-view)?([0-9.]+)$", "docs/install.md": r"`libclast(?:-view)?([0-9.]+)`"}
RECIPES = ("packaging/debian/rules", "packaging/conda/build_library.sh", "tools/wheel_backend.py")


def main():
    cmake = (ROOT / "CMakeLists.txt").read_text()
    version = (ROOT / "VERSION").read_text().strip()
    options = set(re.findall(r"^ *(?:option|set)\((CLAST_\w+|BUILD_TESTING)", cmake + (ROOT / "cmake/Install.cmake").read_text(), re.M))
    faults = []
    interface = version.rpartition(".")[0]
    for names, wanted in ((VERSIONS, version), (SONAMES, interface)):
        for name, pattern in names.items():
            found = re.findall(pattern, (ROOT / name).read_text(), re.M) or ["none"]
            faults += [f"{name}: version {one}, VERSION has {wanted}" for one in found if one != wanted]
    numbers = re.findall(r"^#define CLAST_VERSION_(?:MAJOR|MINOR) (\d+)$", (ROOT / "include/clast/status.h").read_text(), re.M)
    if ".".join(numbers) != interface:
        faults.append(f"status.h: CLAST_VERSION_MAJOR, CLAST_VERSION_MINOR are {numbers}, VERSION has {interface}")
    for name in RECIPES:
        faults += [f"{name}: -D{option}, which CMakeLists.txt does not have"
                   for option in re.findall(r"-D(CLAST_\w+|BUILD_TESTING)", (ROOT / name).read_text()) if option not in options]
    spack = (ROOT / "packaging/spack/packages/clast/package.py").read_text()
    parts = re.search(r'parts = (\(.*\))', spack).group(1)
    for part in ast.literal_eval(parts):
        if f"CLAST_{part.upper()}" not in options:
            faults.append(f"package.py: the part {part}, for which CMakeLists.txt has no option")
        if f'variant("{part}"' not in spack:
            faults.append(f"package.py: the part {part} is no variant")
    ast.parse(spack)
    for fault in faults:
        print(fault)
    print(f"recipes: {len(VERSIONS) + len(SONAMES)} places of versions, {len(faults)} faults")
    return 1 if faults else 0


sys.exit(main())
