"""Particles that stick, settle and cluster: grains, aggregates, packings and clouds. Lengths are SI, or texts with a unit."""
from ._beds import Porosity, Spheres
from ._boxes import Spectrum
from ._clouds import Agglomeration, Cloud, Decomposition
from ._core import Error, Key, keys
from ._functions import (agglomerate, aggregate, box_model, decompose, evolve, export, fill, fit, grain_statistics, mesh_check,
                         mesh_convert, mesh_form, mesh_hull, mesh_repair, mesh_simplify, mesh_synthesize, pack, porosity, predict,
                         predict_beds, render, report, shape, shapes, study)
from ._grains import Grains, GrainStatistics
from ._html import View
from ._mesh import Mesh, MeshCheck, Shape
from ._models import Fit, Model, Prediction
from ._runs import Assembly, Result, Run, open
from ._sizes import Grading
from ._studies import Study
from ._surfaces import SurfaceResult
from ._tables import Table, read_table
from ._views import Picture
from ._bindings import VERSION as __version__

__all__ = ["Agglomeration", "Assembly", "Cloud", "Decomposition", "Error", "Fit", "Grading", "GrainStatistics", "Grains", "Key", "Mesh",
           "MeshCheck", "Model", "Picture", "Porosity", "Prediction", "Result", "Run", "Shape", "Spectrum", "Spheres", "Study",
           "SurfaceResult", "Table", "View", "__version__", "agglomerate", "aggregate", "box_model", "decompose", "evolve", "export", "fill",
           "fit", "grain_statistics", "keys", "mesh_check", "mesh_convert", "mesh_form", "mesh_hull", "mesh_repair", "mesh_simplify",
           "mesh_synthesize", "open", "pack", "porosity", "predict", "predict_beds", "read_table", "render", "report", "shape", "shapes",
           "study"]
