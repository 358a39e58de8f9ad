"""Particles that stick, settle and cluster: grains, aggregates, packings and clouds. Lengths are SI, or texts with a unit."""
from typing import Any, Callable

from ._beds import Porosity, Spheres, fill, porosity
from ._commands import Agglomeration, Assembly, Decomposition, Result, Run, agglomerate, aggregate, decompose, open, pack, read_table
from ._core import Error, Key, document, keys
from ._mesh import Mesh, MeshCheck, Shape, mesh_check, shape
from ._sizes import Grading, Prediction, predict
from ._views import Picture, render, report
from ._bindings import VERSION as __version__

__all__ = ["Agglomeration", "Assembly", "Decomposition", "Error", "Grading", "Key", "Mesh", "MeshCheck", "Picture", "Porosity", "Prediction", "Result",
           "Run", "Shape", "Spheres", "__version__", "agglomerate", "aggregate", "decompose", "fill", "keys", "mesh_check", "open", "pack", "porosity",
           "predict", "read_table", "render", "report", "shape"]

_commands: tuple[Callable[..., Any], ...] = (aggregate, agglomerate, decompose, fill, pack, render, report)
for _command in _commands:
    document(_command)
