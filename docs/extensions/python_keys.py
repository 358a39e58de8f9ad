"""Python's docstrings as pages: keywords that are a command's keys lead to its page, where units and ranges stand in a table."""
import inspect


def shorten(app, what, name, obj, options, lines):
    for number, line in enumerate(lines):
        if line.startswith("Keywords ("):
            command = name.rsplit(".", 1)[-1]
            lines[number:] = [f"Keywords: :doc:`the keys of clast {command} <commands/{command}>`.", ""]
            break
    if inspect.isclass(obj):  # what dataclasses write for themselves says nothing that the signature does not
        lines[:] = [line for line in lines if not line.startswith(f"{obj.__name__}(")]


def setup(app):
    app.connect("autodoc-process-docstring", shorten)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
