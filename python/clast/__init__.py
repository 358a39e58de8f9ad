"""Particles that stick, settle and cluster: grains, aggregates, packings and clouds. Lengths are SI, or texts with a unit."""
from ._beds import Porosity, Spheres, fill, porosity
from ._commands import Assembly, Decomposition, Result, Run, aggregate, decompose, open, pack, read_table
from ._core import Error
from ._mesh import Mesh, MeshCheck, Shape, mesh_check, shape
from ._bindings import VERSION as __version__

__all__ = ["Assembly", "Decomposition", "Error", "Mesh", "MeshCheck", "Porosity", "Result", "Run", "Shape", "Spheres", "__version__",
           "aggregate", "decompose", "fill", "mesh_check", "open", "pack", "porosity", "read_table", "shape"]
