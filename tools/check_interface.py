#!/usr/bin/env python3
"""Fails when a public function of include/clast is called by no command, example or test (the calls that tests/fuzz/make_calls.py makes count
for nothing), stands in its header without a comment, has a name that does not begin with a noun of its place (the header's, that of a
type it has to do with, or one of NOUNS), or has its arguments in another order than object, inputs, options, outputs: an object is the
first pointer, and what is changed in place (IN_PLACE); a configuration is an option. Fails too beyond MOST_HEADERS headers.
"""
import pathlib
import re
import sys

from headers import Headers

ROOT = pathlib.Path(__file__).resolve().parent.parent
NOUNS = {  # what a header is about beside its own noun, and no type is named after
    "field": "unit", "form": "reform", "grading": "phi", "harmonics": "synthesize", "machine": "memory parallel", "porosity": "fabric stress",
    "porosity_model": "mixture form_feature", "run_folder": "text sha256", "settling": "slip terminal", "state": "packing pvd",
    "statistics": "shapiro quantile", "status": "error text version source outputs",
}

IN_PLACE = {"config", "particles"}
OPTION = re.compile(r"_(?:config|options|params|policy)$|^clast_monitor$")
MOST_HEADERS = 37
ORDER = ("object", "input", "option", "output")


def strip_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def declarations(path):
    """(name, line, has a comment, types) of each: above it, above the lines it stands with, or behind it."""
    lines = path.read_text().split("\n")
    commented, i = False, 0
    while i < len(lines):
        commented = bool(lines[i].strip()) and (commented or lines[i].lstrip().startswith("///"))
        if re.match(r"(?:extern )?CLAST_API\b", lines[i]):
            first = i
            while ";" not in lines[i].split("//")[0]:
                i += 1
            text = "\n".join(lines[first:i + 1])
            code = strip_comments(text)
            name = re.search(r"\b(clast_\w+)\s*[(\[;]", code).group(1)
            yield name, first + 1, commented or "///<" in text, set(re.findall(r"\bclast_\w+", code)) - {name, "clast_status"}
        i += 1


def called():
    names = set()
    for folder in ("cli", "examples", "tests"):
        for path in (ROOT / folder).rglob("*"):
            if path.suffix in (".c", ".h", ".cpp") and not (path.parent.name == "fuzz" and path.name.startswith("calls")):
                names |= set(re.findall(r"\bclast_\w+\b", strip_comments(path.read_text())))
    return names


def has_noun(name, nouns):
    return any(name == noun or name.startswith((noun + "_", noun + "s_")) or noun.startswith(name + "_") for noun in nouns)


def part(argument, is_first):
    """Which of ORDER an argument is; is_first: behind objects alone."""
    is_pointer = argument.stars or argument.dims
    if argument.is_function or not is_pointer or argument.name == "context":
        return "option" if OPTION.search(argument.type) else "input"
    is_written = not argument.is_const or (argument.stars >= 2 and not argument.text.startswith(("const char *const *", "const char *const (*")))
    if is_first is None or (is_first and is_written and argument.name in IN_PLACE):
        return "object"
    return "output" if is_written else "option" if OPTION.search(argument.type) else "input"


def order_problems():
    for _, name, arguments in Headers(ROOT / "include").functions:
        parts = []
        for argument in arguments:
            parts.append(part(argument, None if not parts else set(parts) == {"object"}))
        if parts != sorted(parts, key=ORDER.index):
            yield f"{name}({', '.join(a.text for a in arguments)}): not in the order {', '.join(ORDER)} but {', '.join(parts)}"
        for k, argument in enumerate(arguments[1:], 1):
            is_made = any(one.type == argument.type and one.stars == 2 for one in arguments)
            is_object = argument.is_const and argument.stars == 1 and not is_made and name.startswith(argument.type + "_")
            if is_object and argument.type not in {one.type for one in arguments[:k]}:
                yield f"{name}({', '.join(a.text for a in arguments)}): the {argument.type} comes first"


def problems():
    n_header = len(list((ROOT / "include/clast").glob("*.h")))
    if n_header > MOST_HEADERS:
        yield f"include/clast: {n_header} headers, at most {MOST_HEADERS}: which two are one noun?"
    yield from order_problems()
    names, n_declared = called(), 0
    for path in sorted((ROOT / "include/clast").glob("*.h")):
        here = {f"clast_{noun}" for noun in [path.stem, path.stem.split("_")[0], *NOUNS.get(path.stem, "").split()]}
        here |= {one for pair in re.findall(r"\b(clast_\w+);|^struct (clast_\w+) [{]", path.read_text(), flags=re.M) for one in pair if one}  # its types
        for name, line, has_comment, types in declarations(path):
            n_declared += 1
            where = f"{path.relative_to(ROOT)}:{line}: {name}"
            if not has_comment:
                yield f"{where} has no comment"
            if not has_noun(name, here | types):
                yield f"{where} begins with no noun of {path.name} or of a type it has to do with"
            if name not in names:
                yield f"{where} is called by no command, example or test"
    print(f"interface: {n_declared} functions and tables")


def main():
    found = list(problems())
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
