"""Pictures and pages of runs."""
from __future__ import annotations

import ctypes
import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _bindings as c
from ._core import Config, Fixed, Monitor, Owner, Progress, call, check, encoded, output_path, refuse, refuse_idle, view
from ._runs import Assembly
from ._tables import Path


class Picture(Fixed):
    """A picture: `rgba` (height, width, 4) looks into the library's memory, to be written into; a notebook shows it."""

    _FIXED = ("rgba", "pixel_size")
    rgba: NDArray[np.uint8]
    pixel_size: float  #: in the grains' unit of length

    def __init__(self, owner: Owner) -> None:
        image = owner.struct
        self._owner = owner
        vars(self).update(rgba=view(owner, image.rgba, (image.height, image.width, 4), np.uint8), pixel_size=image.pixel_size)

    def write(self, path: Path) -> None:
        """Writes a PNG file, whole or not at all."""
        if not os.fsdecode(encoded("path", path)).lower().endswith(".png"):
            raise refuse(f"path: {os.fspath(path)}: a picture is written as .png")
        check(call("clast_image_write_png")(ctypes.byref(self._owner.struct), output_path("path", path)))

    def __repr__(self) -> str:
        return f"<clast.Picture of {self.rgba.shape[1]} x {self.rgba.shape[0]} pixels>"

    def _repr_png_(self) -> bytes:
        import tempfile
        with tempfile.TemporaryDirectory() as folder:
            self.write(os.path.join(folder, "picture.png"))
            with open(os.path.join(folder, "picture.png"), "rb") as file:
                return file.read()


def render(run: Path | Assembly, *, progress: Progress = None, **keys: Any) -> Picture:
    """Draws the grains of a run's folder, a state file or an assembly; keywords are the keys of `clast render` (width=640)."""
    grains = run if isinstance(run, Assembly) else Assembly.read(run)
    owner, monitor = Owner(c.clast_image(), "clast_image_free"), Monitor(progress)
    with Config(c.clast_render_config(), "clast_render_fields", keys) as config:
        refuse_idle(config.changed(), "clast_render_idle", ctypes.byref(config.struct))
        check(monitor.run(lambda m: call("clast_render_assembly")(ctypes.byref(grains._owner.struct), ctypes.byref(config.struct), m,
                                                                  ctypes.byref(owner.struct))))
    return Picture(owner)


def report(*runs: Path, output: Path, **keys: Any) -> None:
    """Writes one offline page of run folders; keywords are the keys of `clast report` (title="Ash", rows=50)."""
    if not runs:
        raise refuse("runs: none is given")
    names = (ctypes.c_char_p * len(runs))(*(encoded("run", run) for run in runs))
    place = output_path("output", output, *runs)
    with Config(c.clast_report_config(), "clast_report_fields", keys) as config:
        check(call("clast_report_write")(names, len(runs), place, ctypes.byref(config.struct)))
