"""Particles that stick, settle and cluster: grains, aggregates, packings and clouds. Lengths are SI, or texts with a unit."""
from typing import Any, Callable

from ._beds import Porosity, Spheres, fill, porosity
from ._clouds import Agglomeration, Cloud, Decomposition, agglomerate, decompose
from ._core import Error, Key, document, keys
from ._growth import aggregate, pack
from ._html import View
from ._mesh import Mesh, MeshCheck, Shape, mesh_check, shape
from ._models import Fit, Model, Prediction, fit, predict, predict_beds
from ._runs import Assembly, Result, Run, export, open
from ._sizes import Grading
from ._studies import Study, study
from ._surfaces import SurfaceResult, mesh_convert, mesh_form, mesh_hull, mesh_repair, mesh_simplify, mesh_synthesize
from ._tables import Table, read_table
from ._views import Picture, render, report
from ._bindings import VERSION as __version__

__all__ = ["Agglomeration", "Assembly", "Cloud", "Decomposition", "Error", "Fit", "Grading", "Key", "Mesh", "MeshCheck", "Model", "Picture", "Porosity",
           "Prediction", "Result", "Run", "Shape", "Spheres", "Study", "SurfaceResult", "Table", "View", "__version__", "agglomerate", "aggregate",
           "decompose", "export", "fill", "fit", "keys", "mesh_check", "mesh_convert", "mesh_form", "mesh_hull", "mesh_repair",
           "mesh_simplify", "mesh_synthesize", "open", "pack", "porosity", "predict", "predict_beds", "read_table", "render", "report",
           "shape", "study"]

_commands: tuple[Callable[..., Any], ...] = (aggregate, agglomerate, decompose, fill, fit, mesh_repair, mesh_synthesize, pack, render, report,
                                        study)
for _command in _commands:
    document(_command)
