#!/usr/bin/env python3
"""Recipes of packages name the release of the file VERSION, and no option that CMakeLists.txt does not have: tools/check_recipes.py"""
import ast
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
VERSIONS = {"CITATION.cff": r"^version: (\S+)", "packaging/debian/changelog": r"\Aclast \(([0-9.]+)-", "packaging/conda/meta.yaml": r'set version = "([^"]+)"',
            "packaging/spack/packages/clast/package.py": r'\bversion\("([^"]+)"', "python/clast/_bindings.py": r"^VERSION = '([^']+)'"}
RECIPES = ("packaging/debian/rules", "packaging/conda/build_library.sh", "tools/wheel_backend.py")


def main():
    cmake = (ROOT / "CMakeLists.txt").read_text()
    version = (ROOT / "VERSION").read_text().strip()
    options = set(re.findall(r"^ *(?:option|set)\((CLAST_\w+|BUILD_TESTING)", cmake + (ROOT / "cmake/Install.cmake").read_text(), re.M))
    faults = []
    for name, pattern in VERSIONS.items():
        found = re.search(pattern, (ROOT / name).read_text(), re.M)
        if found is None or found.group(1) != version:
            faults.append(f"{name}: version {found.group(1) if found else 'none'}, VERSION has {version}")
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
    print(f"recipes: {len(VERSIONS)} versions, {len(faults)} faults")
    return 1 if faults else 0


sys.exit(main())
