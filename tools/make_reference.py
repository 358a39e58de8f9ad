#!/usr/bin/env python3
"""Writes the pages of the reference that are made, not written, into docs/reference: tools/make_reference.py [CLAST]

c/ has a page a public header, filled by Doxygen and Breathe; commands/ a page a command, from `clast describe --json` and
`--help-all`; files.md what runs write, by running them; python.md the docstrings of python/clast;
notebooks/ those of examples; verdicts.md the counts of docs/validation. A page that stays as it was is not
touched, so that Sphinx reads only what has changed.
"""
import collections
import csv
import json
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import reference_files  # noqa: E402 (beside this file)
import reference_notebooks  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
TO = ROOT / "docs/reference"
OPTION = re.compile(r"^  --(\[no-\])?([a-z][a-z0-9-]*) +(\S.*)?$")
LIMIT = 1e300  # a range that ends beyond is open


def first_sentence(header):
    """What a header's first comment says in its first sentence."""
    found = re.search(r"^///? ?(.*(?:\n///? ?\S.*)*)", header, re.M)
    words = re.sub(r"\n///? ?", " ", found[1]) if found else ""
    return re.split(r"(?<=[.?]) |:? {2,}|:$", words)[0]


def pages_of_headers(_clast):
    """(name, text) of a page for each public header, and of their index."""
    headers = {path.stem: path.read_text(encoding="utf-8") for path in sorted((ROOT / "include/clast").glob("*.h")) if path.stem != "clast"}
    rows = "\n".join(f"| [{name}.h]({name}.md) | {cell(first_sentence(text))} | {len(re.findall('^CLAST_API', text, re.M))} |" for name, text in headers.items())
    entries = "\n".join(headers)
    yield "c/index", (f"# C interface\n\nEvery public header; `clast/clast.h` includes all but `mpi.h`. How a program is built: [the C library](../../library.md).\n\n"
                      f"| header | what it has | functions and tables |\n| --- | --- | --- |\n{rows}\n\n```{{toctree}}\n:hidden:\n\n{entries}\n```\n")
    for name in headers:
        yield f"c/{name}", f"# {name}.h\n\n```{{doxygenfile}} {name}.h\n```\n"


def cell(text):
    """A text as a cell of a table: nothing in it is markup."""
    return re.sub(r"([\\`*_|<>\[\]{}$~#])", r"\\\1", text)


def number(value):
    return f"{value:.6g}"


def range_of(field):
    """Choices, or the range in SI, in words."""
    if field["choices"]:
        return " ".join(f"`{choice}`" for choice in field["choices"].split("|"))
    low, high = field["low"], field["high"]
    if field["type"] == "flag":
        return "on or off"
    if low is None or low <= -LIMIT and high >= LIMIT:
        return ""
    if high >= 1.8e19:
        return f"{number(low)} or more"
    return f"at most {number(high)}" if low <= -LIMIT else f"{number(low)} to {number(high)}"


def default_of(field, helped):
    """The default as people type it: that of the help, which has the unit."""
    found = re.search(r"\(default ([^)]*)\)", helped)
    if found:
        return found[1]
    return "off" if field["type"] == "flag" else "" if field["type"] in ("text", "texts", "numbers") else number(field["default"])


def help_of(clast, command):
    """(usage, examples, prose, [(group, [(option, text)])]) of a command's whole help."""
    text = subprocess.run([clast, *command.split(), "--help-all"], capture_output=True, text=True, check=True).stdout
    head, _, rest = text.partition("\nexamples:\n")
    examples, _, rest = rest.partition("\n\n")
    groups, prose = [], []
    lines = rest.split("\nof every command:")[0].splitlines()
    for line, after in zip(lines, [*lines[1:], ""]):
        option = OPTION.match(line)
        if option and groups:
            groups[-1][1].append([option[2], (option[3] or "").strip()])
        elif groups and groups[-1][1] and line.startswith("          "):
            groups[-1][1][-1][1] += " " + line.strip()
        elif line.endswith(":") and OPTION.match(after):
            groups.append((line[:-1], []))
        else:
            prose.append(line)
    return head.splitlines()[0], examples, "\n".join(prose).strip(), groups


def page_of_command(clast, command):
    usage, examples, prose, groups = help_of(clast, command["name"])
    fields = {field["name"]: field for field in command["fields"]}
    lines = [f"# clast {command['name']}", "", command["doc"][0].upper() + command["doc"][1:] + ("" if command["doc"].endswith("?") else "."), "",
             "```text", usage, "```", "", "```sh", *(line.strip() for line in examples.splitlines()), "```", ""]
    lines += ["```text", prose, "```", ""] if prose else []
    for title, options in groups:
        lines += [f"## {title[0].upper()}{title[1:]}", "", "| option | meaning | default | range (SI) |", "| --- | --- | --- | --- |"]
        for name, helped in options:
            field = fields.get(name.replace("-", "_"))
            if field is None:
                continue
            unit = "" if field["unit"] in ("-", "") else f" [{field['unit']}]"
            kind = {"texts": "; may be repeated", "numbers": "; may be repeated"}.get(field["type"], "")
            lines.append(f"| `--{name}` | {cell(field['doc'] + kind)} | {cell(default_of(field, helped))} | {range_of(field)}{cell(unit)} |")
        lines.append("")
    return "\n".join(lines)


def pages_of_commands(clast):
    """(name, text) of a page for each command, and of their index with what all share."""
    commands = json.loads(subprocess.run([clast, "describe", "--json"], capture_output=True, text=True, check=True).stdout)["commands"]
    names = [command["name"].replace(" ", "-") for command in commands]
    shared = subprocess.run([clast, "pack", "--help-all"], capture_output=True, text=True, check=True).stdout.split("\nof every command:\n")[1]
    rows = "\n".join(f"| [{command['name']}]({name}.md) | {cell(command['doc'])} | {len(command['fields'])} |" for command, name in zip(commands, names))
    entries = "\n".join(names)
    yield "commands/index", (f"# Commands and keys\n\nEvery option is a key of a YAML file with `_` for `-`. Ranges are in SI; a length or an angle is typed with its unit.\n\n"
                             f"| command | what it does | keys |\n| --- | --- | --- |\n{rows}\n\n## Of every command\n\n```text\n{shared.rstrip()}\n```\n\n"
                             f"```{{toctree}}\n:hidden:\n\n{entries}\n```\n")
    for command, name in zip(commands, names):
        yield f"commands/{name}", page_of_command(clast, command)


def page_of_python(_clast):
    yield "python", ("# Python interface\n\nWhat `import clast` gives; the keywords of each command are its [keys](commands/index.md). How it is used: [Python](../python.md).\n\n"
                     "```{eval-rst}\n.. automodule:: clast\n   :members:\n   :imported-members:\n   :undoc-members:\n```\n")


def page_of_files(clast):
    yield "files", reference_files.page(clast)


def pages_of_notebooks(_clast):
    yield from reference_notebooks.pages()


def verdicts(_clast):
    """A table of how many rows of each validation's CSV were judged, and how."""
    lines = ["| rows in | judged | pass | open | fail |", "| --- | --- | --- | --- | --- |"]
    for path in sorted((ROOT / "docs/validation").glob("*.csv")):
        with path.open(encoding="utf-8") as file:
            told = collections.Counter(row["verdict"].lower() for row in csv.DictReader(file) if "verdict" in row)
        n_judged = told["pass"] + told["open"] + told["fail"]
        if n_judged:
            lines.append(f"| `{path.name}` | {n_judged} | {told['pass']} | {told['open']} | {told['fail']} |")
    yield "verdicts", "\n".join(lines) + "\n"


def write_page(name, text):
    path = TO / f"{name}.md"
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
    return path


def main():
    clast = str(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/clast").resolve())
    made = {write_page(name, text) for make in (pages_of_headers, pages_of_commands, page_of_files, page_of_python, pages_of_notebooks, verdicts) for name, text in make(clast)}
    for path in TO.rglob("*.md"):
        if path not in made:
            path.unlink()
    print(f"reference: {len(made)} pages")


main()
