#!/usr/bin/env python3
"""What who installed the wheel does first, run by tools/check_packages.sh in the bare root: check_wheel.py FOLDER (with data/ and examples/)."""
import math
import os
import sys

import numpy as np

import clast

os.chdir(sys.argv[1])
grain = clast.Mesh.read("data/standin63/grain00.ply")
assert grain.shape().sieve_size > 0 and grain.volume > 0
assert clast.mesh_check("data/scarlet/stl/27sk21_shape_coarse.stl").closed
cloud = clast.decompose(np.random.default_rng(1).random((1000, 3)), domain="box:0,0,0,1,1,1")
assert math.isfinite(cloud.pair_integral) and cloud.n_cell >= 1
shapes = [f"data/scarlet/stl/27sk21_shape_{size}.stl" for size in ("fine", "coarse")]
run = clast.aggregate(core=shapes[1], core_size="270um", coat=shapes, class_limit=["63um"], unit="um", sizes="data/scarlet/27sk21_deq_um.csv", size_unit="um",
                      size_meaning="mean_diameter", order="shuffled", cone="1deg", rays=1, orientations=1, repeats=1, seed=1, output="/tmp/python_run")
assert run.n_grain == clast.open("/tmp/python_run").grains.positions.shape[0]
picture = clast.render("/tmp/python_run", width=320, height=240)
assert picture.rgba.shape == (240, 320, 4)
print(f"clast {clast.__version__}: {run.n_grain} grains, {run.density:.1f} kg/m3")
