"""Pages of the notebooks: their words, code and stored outputs, with the pictures beside (tests/python/test_notebooks.py keeps those true)."""
import base64
import json
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent
TO = ROOT / "docs/reference/notebooks"


def words_of(code):
    """What a chart shows, by the names of its axes."""
    axes = dict(re.findall(r"(xlabel|ylabel)(?:\(|=)f?\"([^\"]+)\"", code))
    return f"{axes['ylabel']} over {axes.get('xlabel', 'x')}" if "ylabel" in axes else "what the cell above draws"


def parts_of(cell, name, k_cell):
    """Markdown of a cell and of what it gave; pictures are written beside the page."""
    text = "".join(cell["source"])
    if cell["cell_type"] == "markdown":
        yield text
        return
    yield f"```python\n{text}\n```"
    for k, output in enumerate(cell.get("outputs", ())):
        data = output.get("data", {})
        if "image/png" in data:
            picture = TO / f"{name}-{k_cell}-{k}.png"
            picture.write_bytes(base64.b64decode("".join(data["image/png"])))
            yield f"![{words_of(text)}]({picture.name})"
        else:
            printed = "".join(output.get("text") or data.get("text/plain", ())).rstrip()
            if printed:
                yield f"```text\n{printed}\n```"


def pages():
    """(name, text) of a page a notebook, and of their index."""
    TO.mkdir(parents=True, exist_ok=True)
    rows, names = [], []
    for path in sorted((ROOT / "examples/notebooks").glob("*.ipynb")):
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        parts = [part for k, cell in enumerate(cells) for part in parts_of(cell, path.stem, k)]
        title = parts[0].splitlines()[0].lstrip("# ")
        rows.append(f"| [{title}]({path.stem}.md) | `examples/notebooks/{path.name}` |")
        names.append(path.stem)
        yield f"notebooks/{path.stem}", "\n\n".join(parts) + "\n"
    table, entries = "\n".join(rows), "\n".join(names)
    yield "notebooks/index", ("# Notebooks\n\nThe papers' main figures, and one line of thought through all three methods; each takes under a minute. Outputs are those stored in the "
                              f"notebook, which a test runs and compares.\n\n| notebook | file |\n| --- | --- |\n{table}\n\n```{{toctree}}\n:hidden:\n\n{entries}\n```\n")
