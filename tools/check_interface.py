#!/usr/bin/env python3
"""Fails when a public function of include/clast is called by no command, example or test (the calls that tests/fuzz/make_calls.py makes count
for nothing), or stands in its header without a comment. OPEN lists those that are called by none yet: an entry that is called, or gone, fails too.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
OPEN = """
clast_aggregate_chart_title clast_aggregate_file clast_aggregate_n_file clast_aggregate_n_particle clast_assembly_printable_plan
clast_chart_histogram clast_chart_pca clast_chart_svg clast_chart_zingg clast_curve_read clast_dem_mean_height clast_dem_n_step
clast_dem_shape_measures clast_domain_sides clast_envelope_text clast_grading_densities clast_grading_draw_density
clast_manifest_output clast_manifest_progress clast_pack_achieved clast_pack_bed clast_pack_expected_steps clast_pack_file
clast_pack_n_file clast_pack_porosity clast_porosity_model_apply clast_porosity_model_values clast_range_check clast_state_table
"""


def strip_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def declarations(path):
    """(name, line, has a comment) of each: above it, above the lines it stands with, or behind it."""
    lines = path.read_text().split("\n")
    commented, i = False, 0
    while i < len(lines):
        commented = bool(lines[i].strip()) and (commented or lines[i].lstrip().startswith("///"))
        if re.match(r"(?:extern )?CLAST_API\b", lines[i]):
            first = i
            while ";" not in lines[i].split("//")[0]:
                i += 1
            text = "\n".join(lines[first:i + 1])
            name = re.search(r"\b(clast_\w+)\s*[(\[;]", strip_comments(text)).group(1)
            yield name, first + 1, commented or "///<" in text
        i += 1


def called():
    names = set()
    for folder in ("cli", "examples", "tests"):
        for path in (ROOT / folder).rglob("*"):
            if path.suffix in (".c", ".h", ".cpp") and not (path.parent.name == "fuzz" and path.name.startswith("calls")):
                names |= set(re.findall(r"\bclast_\w+\b", strip_comments(path.read_text())))
    return names


def problems():
    names, waiting, declared = called(), set(OPEN.split()), set()
    for path in sorted((ROOT / "include/clast").glob("*.h")):
        for name, line, has_comment in declarations(path):
            declared.add(name)
            where = f"{path.relative_to(ROOT)}:{line}: {name}"
            if not has_comment:
                yield f"{where} has no comment"
            if name not in names and name not in waiting:
                yield f"{where} is called by no command, example or test"
    for name in sorted(waiting & names | waiting - declared):
        yield f"tools/check_interface.py: {name} is not open any more"
    print(f"interface: {len(declared)} functions and tables, {len(waiting)} of them called by no command, example or test yet")


def main():
    found = list(problems())
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
