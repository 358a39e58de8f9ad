"""Python's docstrings as pages: keywords that are a command's keys lead to its page, where units and ranges stand in a table."""
import inspect

OTHER = {"predict_beds": "predict", "box_model": "agglomerate", "grain_statistics": "shape", "shapes": "shape"}  # functions named otherwise than their command
OWN = ("output", "progress", "resume")  # keywords of Python's own, which stay in the signature


def is_command(obj):
    return inspect.isfunction(obj) and "Keywords (" in (obj.__doc__ or "")


def shorten(app, what, name, obj, options, lines):
    for number, line in enumerate(lines):
        if is_command(obj) and line.startswith("Keywords ("):
            function = name.rsplit(".", 1)[-1]
            command = OTHER.get(function, function).replace("_", "-")
            lines[number:] = [f"Keywords: :doc:`the keys of clast {command.replace('-', ' ')} <commands/{command}>`.", ""]
            break
    if inspect.isclass(obj):  # what dataclasses write for themselves says nothing that the signature does not
        lines[:] = [line for line in lines if not line.startswith(f"{obj.__name__}(")]


def without_keys(app, what, name, obj, options, signature, returns):
    """The signature of a command with `**keys` for its keys."""
    if not is_command(obj):
        return None
    of = inspect.signature(obj)
    kept = [p for p in of.parameters.values() if p.kind is not p.KEYWORD_ONLY or p.name in OWN]
    if len(kept) == len(of.parameters):
        return None
    kept.append(inspect.Parameter("keys", inspect.Parameter.VAR_KEYWORD))
    return str(of.replace(parameters=kept, return_annotation=of.empty)).replace("'", ""), returns


def setup(app):
    app.connect("autodoc-process-docstring", shorten)
    app.connect("autodoc-process-signature", without_keys)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
