"""Particles that stick, settle and cluster: grains, aggregates, packings and clouds. Lengths are SI, or texts with a unit."""
from ._beds import Porosity, Spheres, fill, porosity
from ._commands import Agglomeration, Assembly, Decomposition, Result, Run, agglomerate, aggregate, decompose, open, pack, read_table
from ._core import Error
from ._mesh import Mesh, MeshCheck, Shape, mesh_check, shape
from ._sizes import Grading, Prediction, predict
from ._views import Picture, render, report
from ._bindings import VERSION as __version__

__all__ = ["Agglomeration", "Assembly", "Decomposition", "Error", "Grading", "Mesh", "MeshCheck", "Picture", "Porosity", "Prediction", "Result",
           "Run", "Shape", "Spheres", "__version__", "agglomerate", "aggregate", "decompose", "fill", "mesh_check", "open", "pack", "porosity",
           "predict", "read_table", "render", "report", "shape"]
