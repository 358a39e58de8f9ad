"""One function a command, every keyword with its type: written by tools/make_python.py, do not edit."""
from __future__ import annotations

from typing import Any, Literal

from . import _beds, _boxes, _clouds, _grains, _growth, _mesh, _models, _runs, _studies, _surfaces, _views
from ._beds import Porosity, Spheres
from ._boxes import Spectrum
from ._clouds import Agglomeration, Decomposition
from ._core import Progress, Quantities, Quantity, given, spelt
from ._grains import GrainStatistics, Grains
from ._mesh import Mesh, MeshCheck, Shape
from ._models import Fit, Model, Moments, Prediction
from ._runs import Assembly, Result
from ._studies import Study
from ._surfaces import Surface, SurfaceResult
from ._tables import Path, Table, Text, Texts
from ._views import Picture

__all__ = ["aggregate", "agglomerate", "box_model", "decompose", "evolve", "export", "fill", "fit", "mesh_check", "mesh_convert",
           "mesh_form", "mesh_hull", "mesh_repair", "mesh_simplify", "mesh_synthesize", "pack", "porosity", "predict",
           "predict_beds", "render", "report", "grain_statistics", "shape", "shapes", "study"]


@spelt
def aggregate(
        *,
        output: Path | None = None,
        progress: Progress = None,
        mode: Literal["core", "cluster"] | None = None,
        core: Text | None = None,
        core_size: Quantity | None = None,
        core_meaning: Literal["length", "volume", "mean_diameter"] | None = None,
        core_density: Quantity | None = None,
        coat: Texts | None = None,
        coat_weight: Quantities | None = None,
        class_limit: Quantities | None = None,
        coat_density: Quantities | None = None,
        core_spheres: Text | None = None,
        coat_spheres: Texts | None = None,
        fill_spheres: int | None = None,
        fill: Literal["largest", "random", "published"] | None = None,
        unit: Text | None = None,
        accept_faults: bool | None = None,
        sizes: Text | None = None,
        size_column: Text | None = None,
        size_unit: Text | None = None,
        size: Quantities | None = None,
        size_law: Literal["list", "uniform", "loguniform", "normal", "lognormal", "weibull"] | None = None,
        size_mean: Quantity | None = None,
        size_deviation: Quantity | None = None,
        size_shape: float | None = None,
        size_low: Quantity | None = None,
        size_high: Quantity | None = None,
        n_particle: int | None = None,
        size_draw: bool | None = None,
        size_by_mass: bool | None = None,
        replicate: int | None = None,
        size_meaning: Literal["length", "volume", "mean_diameter"] | None = None,
        order: Literal["given", "shuffled", "descending"] | None = None,
        cone: Quantity | None = None,
        rays: int | None = None,
        orientations: int | None = None,
        axis: Text | None = None,
        origin: Literal["auto", "core", "mass", "grain", "sphere"] | None = None,
        target: Literal["core", "mass"] | None = None,
        start: float | None = None,
        max_tries: int | None = None,
        approach: Literal["central", "ballistic", "diffusive"] | None = None,
        walk_step: float | None = None,
        contact: Literal["exact", "spheres", "march"] | None = None,
        flavour: Literal["release", "figures"] | None = None,
        march_coarse: float | None = None,
        march_fine: float | None = None,
        march_steps: int | None = None,
        march_vertices: int | None = None,
        envelope: Texts | None = None,
        envelope_every: int | None = None,
        solid_union: bool | None = None,
        fall_speed: bool | None = None,
        envelope_rays: int | None = None,
        envelope_length: Quantity | None = None,
        permeability: Literal["happel", "kozeny_carman"] | None = None,
        stop_mass: Quantity | None = None,
        stop_size: Quantity | None = None,
        stop_porosity: float | None = None,
        fit: bool | None = None,
        observed_size: Quantity | None = None,
        observed_size_error: Quantity | None = None,
        observed_density: Quantity | None = None,
        observed_density_error: Quantity | None = None,
        observed_velocity: Quantity | None = None,
        observed_velocity_error: Quantity | None = None,
        fit_packing: Texts | None = None,
        fit_repeats: int | None = None,
        fit_replicate_max: int | None = None,
        pick: Literal["random", "mass", "brownian"] | None = None,
        n_final: int | None = None,
        repeats: int | None = None,
        confidence: float | None = None,
        seed: int | None = None,
        checkpoint_every: int | None = None,
        picture: bool | None = None,
        printable: bool | None = None,
        neck: Quantity | None = None,
        spacing: Quantity | None = None,
        force: bool | None = None,
        resume: Text | None = None,
) -> Result:
    """Grows virtual aggregates grain by grain: aggregate(core="sphere", core_size=270e-6, coat="sphere", size="30um").

    With `output` the run's folder is written, checkpoints on the way; Ctrl-C then ends at one, and aggregate(resume="run") goes on.
    aggregate(resume="run", printable=True, spacing="5um") adds the printable body to a run that has ended, or makes another.
    fit=True finds what packing explains an observed size, density or settling velocity (`verdict`, `words`).

    Keywords (None: the default; a number is SI, a text has its unit):
        mode: grow on a core, or merge a population of grains cluster by cluster (core, cluster; default core)
        core: core: surface file, state.h5, sphere, or ellipsoid:a,b,c (no default)
        core_size: size of the core; 0: as its file says (m; 0 to 1e+06; default 0.0)
        core_meaning: what core_size measures, as size_meaning (length, volume, mean_diameter; default length)
        core_density: density of the core (kg/m^3; 1e-06 to 1e+06; default 2500.0)
        coat: coating shape: as core (no default)
        coat_weight: probability of each coating shape; none: all equal (at least 0; no default)
        class_limit: sizes up to the k-th limit take the k-th coating shape, larger ones the last (m; 0 to 1e+06; no default)
        coat_density: density: one for all shapes, or one each (kg/m^3; 1e-06 to 1e+06; default 2500)
        core_spheres: sphere composite of the core (CSV x,y,z,r); none: filled (no default)
        coat_spheres: sphere composite of each coating shape (no default)
        fill_spheres: spheres of each composite that is filled here (1 to 1e+06; default 100)
        fill: how it is filled (see clast fill) (largest, random, published; default largest)
        unit: length unit of surface files that do not say theirs (no default)
        accept_faults: use surfaces that are open, cross themselves or lie apart as they are (default False)
        sizes: CSV of sizes, of sizes with counts, or of bins low,high with counts (no default)
        size_column: its column; none: the one that is named a size, else the first that counts nothing (no default)
        size_unit: its unit, um, mm, m or phi; none: from the column's name (no default)
        size: a size, instead of a file (m; 1e-12 to 1e+06; no default)
        size_law: sizes from the list, or drawn from a law (list, uniform, loguniform, normal, lognormal, weibull; default list)
        size_mean: mean (normal), median (lognormal), scale (weibull) (m; 0 to 1e+06; default 0.0)
        size_deviation: standard deviation (normal); for lognormal and weibull see size_shape (m; 0 to 1e+06; default 0.0)
        size_shape: lognormal: standard deviation of ln size; weibull: exponent (0 to 100; default 0.0)
        size_low: smallest size of a law (m; 0 to 1e+06; default 0.0)
        size_high: greatest size of a law; 0: none (m; 0 to 1e+06; default 0.0)
        n_particle: particles to place, 0: the whole list; from a law or with size_draw: how many are drawn, replicate times (0 to 1e+08; default 0)
        size_draw: draw n_particle sizes from the histogram at random (default False)
        size_by_mass: rows of the histogram hold masses (a column mass, mass_g, weight ..), not numbers (default False)
        replicate: how often the list is used, or n_particle sizes are drawn (N_A of the paper) (1 to 1e+06; default 1)
        size_meaning: sizes are maximum lengths, volume-equivalent or (L I S)^(1/3) diameters, by the L, I, S that clast shape --axes fitted prints (length, volume, mean_diameter; default length)
        order: order of placement (given, shuffled, descending; default given)
        cone: half-angle of the cone of rays (rad; 0 to 3.14159; default 0.017453292519943295)
        rays: rays tried for each particle (N_r) (1 to 1e+06; default 1)
        orientations: orientations tried on each ray (N_o) (1 to 1e+06; default 1)
        axis: axis of the cone: random, or a fixed x,y,z (default random)
        origin: where rays start: core's centre, centre of mass, a random placed grain or sphere (auto, core, mass, grain, sphere; default auto)
        target: the kept trial ends nearest to the core's centre, or to the centre of mass (core, mass; default core)
        start: start, in particle sizes beyond the ray's last hit; 0: from outside of everything (0 to 1e+06; default 0.0)
        max_tries: new axes tried when every ray misses the aggregate (ballistic: 1000 lines for each) (1 to 1e+06; default 100)
        approach: how particles come: along rays to the origin (published), on lines over the cross-section, by random walk (central, ballistic, diffusive; default central)
        walk_step: diffusive: least step of the walk, in radii of the smallest released particle (0.0001 to 1; default 0.1)
        contact: first touch of: true surfaces, sphere composites, or the published march (exact, spheres, march; default exact)
        flavour: the published engine that march repeats (release, figures; default release)
        march_coarse: coarse step constant; 0: release 0.05, figures 0.01 (0 to 10; default 0.0)
        march_fine: fine step constant (1e-09 to 10; default 0.0005)
        march_steps: steps allowed to each move of the march (1 to 1e+09; default 1000)
        march_vertices: vertices that the march measures a length from (2 to 1e+09; default 1000)
        envelope: envelopes, the first gives d_agg: surface_hull, sphere_hull, sphere_rays, wrap, alpha, enclosing_sphere, gyration_sphere (default surface_hull)
        envelope_every: particles between two rows of porosity; alpha, wrap: seconds each (1 to 1e+09; default 1)
        solid_union: measure the volume of the union too, which takes sampling where grains overlap (default True)
        fall_speed: settling velocity in each row of porosity too, which takes the extent each time (default False)
        envelope_rays: rays of the published envelope (10 to 1e+08; default 10000)
        envelope_length: radius of the ball of the wrap and alpha envelopes, which need it (m; 0 to 1e+06; default 0.0)
        permeability: permeability by porosity and grain size, for the settling velocity that it allows (happel, kozeny_carman; default happel)
        stop_mass: stop when the aggregate weighs this; 0: never (kg; 0 to 1e+12; default 0.0)
        stop_size: stop when d_agg reaches this; 0: never (m; 0 to 1e+06; default 0.0)
        stop_porosity: stop when the porosity reaches this; 0: never (0 to 1; default 0.0)
        fit: find packing and replicate that explain the observed size, density or velocity (default False)
        observed_size: fit: observed D_agg; 0: not observed (m; 0 to 1e+06; default 0.0)
        observed_size_error: fit: its standard error (m; 0 to 1e+06; default 0.0)
        observed_density: fit: observed density; 0: not observed (kg/m^3; 0 to 1e+06; default 0.0)
        observed_density_error: fit: its standard error (kg/m^3; 0 to 1e+06; default 0.0)
        observed_velocity: fit: observed settling velocity; 0: not observed (m/s; 0 to 1e+06; default 0.0)
        observed_velocity_error: fit: its standard error (m/s; 0 to 1e+06; default 0.0)
        fit_packing: fit: a packing cone:rays:orientations to try; none: 1 to 64 trials (no default)
        fit_repeats: fit: aggregates grown at each packing and replicate (2 to 1000; default 3)
        fit_replicate_max: fit: greatest replicate tried (1 to 1e+06; default 32)
        pick: cluster mode: how two clusters are chosen (random, mass, brownian; default random)
        n_final: cluster mode: clusters left at the end (1 to 1e+08; default 1)
        repeats: independent aggregates (1 to 1e+06; default 1)
        confidence: level of the intervals over repeats (0.5 to 0.9999; default 0.95)
        seed: seed of every random number (at least 0; default 1)
        checkpoint_every: particles between two checkpoints (1 to 1e+09; default 200)
        picture: picture.png in the run folder (default True)
        printable: printable.3mf, printable.stl (mm): one closed surface around all grains and their necks (default False)
        neck: printable: thickness of the necks; 0: half the thinnest grain, 3 spacings at least (m; 0 to 1e+06; default 0.0)
        spacing: printable: spacing of the sampling grid; 0: a quarter neck, coarser where the file would pass 50 MB (m; 0 to 1e+06; default 0.0)
        force: replace an earlier run in the output folder, once the new one has succeeded (default False)
        resume: run folder to go on with; all other options come from it (no default)
    """
    return _growth.aggregate(**given(locals()))


@spelt
def agglomerate(
        *snapshots: Any,
        domain: str | None = None,
        radius: Any = None,
        mass: Any = None,
        weight: Any = None,
        velocity: Any = None,
        monomers: Any = None,
        speed_rms: Any = None,
        temperature: Any = None,
        shear: Any = None,
        dissipation: Any = None,
        progress: Progress = None,
        kernel: Text | None = None,
        duration: Quantity | None = None,
        n_step: int | None = None,
        repeats: int | None = None,
        collisions: Literal["next", "poisson"] | None = None,
        leap: float | None = None,
        block: int | None = None,
        self_collisions: bool | None = None,
        out_of_range: Literal["error", "extrapolate"] | None = None,
        alpha: float | None = None,
        sticking: Literal["constant", "viscous", "liquid", "contact"] | None = None,
        film_viscosity: Quantity | None = None,
        film_thickness: Quantity | None = None,
        asperity: Quantity | None = None,
        restitution: float | None = None,
        critical_stokes: float | None = None,
        stokes_exponent: float | None = None,
        adhesion: Quantity | None = None,
        young: Quantity | None = None,
        poisson: float | None = None,
        radius_law: Literal["volume", "fractal-collision", "fractal-gyration"] | None = None,
        monomer_radius: Quantity | None = None,
        fractal_dimension: float | None = None,
        fractal_prefactor: float | None = None,
        constant: Quantity | None = None,
        additive: Quantity | None = None,
        product: Quantity | None = None,
        viscosity: Quantity | None = None,
        density: Quantity | None = None,
        particle_density: Quantity | None = None,
        mean_free_path: Quantity | None = None,
        shear_constant: float | None = None,
        gravity: Quantity | None = None,
        efficiency: float | None = None,
        settling_law: Literal["standard", "stokes"] | None = None,
        rebuild: Literal["changed", "always", "never"] | None = None,
        change_level: float | None = None,
        fixed: int | None = None,
        depth: Quantity | None = None,
        outside: Literal["error", "drop"] | None = None,
        variant: Literal["full", "first", "fast", "test"] | None = None,
        mesh: Literal["boxes", "components", "bins", "labels", "tree", "auto"] | None = None,
        events: Literal["pairs", "paper"] | None = None,
        level: float | None = None,
        votes: int | None = None,
        tests: Text | None = None,
        statistic: Literal["A", "T"] | None = None,
        paper: bool | None = None,
        ghost_samples: int | None = None,
        crossfit: bool | None = None,
        lower: Literal["q20", "search", "joint"] | None = None,
        strict: bool | None = None,
        max_pass: int | None = None,
        beta_dt: Quantity | None = None,
        tree_level: float | None = None,
        tree_root_level: float | None = None,
        variable_tolerance: float | None = None,
        tree_least: int | None = None,
        tree_refine: bool | None = None,
        extrapolate: bool | None = None,
        pairs: bool | None = None,
        pairs_radius: Quantity | None = None,
        estimator: Literal["cells", "pairs", "auto"] | None = None,
        seed: int | None = None,
) -> Agglomeration:
    """Evolves a Cloud, or positions (n, 1 to 3) [m], one a snapshot: cells by decomposition, collisions in them by a kernel.

    radius, mass, weight, velocity and monomers are those of the first snapshot (a Cloud has its own velocities in each); speed_rms, temperature,
    shear and dissipation are numbers, texts with a unit ("300 K"), or arrays of one value a particle, of all snapshots (n,) or of each
    (snapshots, n). Keywords are the keys of `clast agglomerate` (kernel="constant", constant=1e-3,
    duration="10s", n_step=100, seed=1). Ctrl-C ends it between steps; nothing is kept.

    Keywords (None: the default; a number is SI, a text has its unit):
        domain: known domain: box:LOW..,HIGH.., cylinder:R,L or X,Y,Z,NX,NY,NZ,R,L (base, axis), half-pipe:R,L, sphere:R or X,Y,Z,R, mesh:FILE [m, or as 1mm] (no default)
        speed_rms: turbulent velocity of the fluid, one component (m/s; 0 to 1e+06; default 0.0)
        temperature: of the fluid (K; 0 to 100000; default 293.15)
        shear: shear rate G (1/s; 0 to 1e+12; default 0.0)
        dissipation: turbulent dissipation eps (m^2/s^3; 0 to 1e+12; default 0.0)
        kernel: collision kernel, or a sum: brownian+settling; see the table above (default constant)
        duration: time that passes; of several snapshots after each, the last too: three take three times it (s; at least 0; default 1.0)
        n_step: steps of that time (1 to 1e+06; default 10)
        repeats: independent realisations, over which results are averaged (1 to 1e+06; default 1)
        collisions: event by event, or a Poisson number of events a sub-step (next, poisson; default next)
        leap: collisions of the busiest particle in a sub-step of poisson (1e-06 to 1; default 0.01)
        block: kinds of particles above which a cell is partitioned at random into blocks; 0: never (0 to 1e+06; default 1024)
        self_collisions: the particles of one weighted parcel collide with each other too (default False)
        out_of_range: kernels and sticking beyond where they hold (the table above) (error, extrapolate; default error)
        alpha: share of collisions that stick; with another law of sticking a factor on it (0 to 1; default 1.0)
        sticking: share that sticks: alpha, or by the impact: a viscous film, wet ash, elastic contacts (constant, viscous, liquid, contact; default constant)
        film_viscosity: viscous, liquid: of the liquid on the particles (Pa s; 0 to 1e+12; default 0.0)
        film_thickness: viscous: h of the film (m; 0 to 1; default 0.0)
        asperity: viscous: height h_a of the roughness (m; 0 to 1; default 0.0)
        restitution: viscous: e of the dry solids (0 to 1; default 0.0)
        critical_stokes: liquid: St_cr, where half of the collisions stick (0 to 1e+12; default 1.3)
        stokes_exponent: liquid: q of 1 / (1 + (St / St_cr)^q) (0 to 100; default 0.8)
        adhesion: contact: work of adhesion of the surfaces (J/m^2; 0 to 1e+06; default 0.0)
        young: contact: Young's modulus of the particles (Pa; at least 0; default 0.0)
        poisson: contact: Poisson's ratio of the particles (-0.999 to 0.5; default 0.25)
        radius_law: collision radius of an aggregate: of the summed volume, a0 (i / k_f)^(1 / D_f), or from that law of the radius of gyration (volume, fractal-collision, fractal-gyration; default volume)
        monomer_radius: radius a0 of a monomer where no column gives radii (m; at least 0; default 0.0)
        fractal_dimension: D_f (1 to 3; default 1.8)
        fractal_prefactor: k_f (0.001 to 1000; default 1.0)
        constant: K of kernel constant [m^d/s] (m^d/s; at least 0; default 1e-06)
        additive: b of kernel additive [m^d/s] (m^d/s; at least 0; default 1e-06)
        product: c of kernel product [m^d/s] (m^d/s; at least 0; default 1e-06)
        viscosity: dynamic viscosity of the fluid (Pa s; 0 to 1e+06; default 0.001002)
        density: of the fluid (kg/m^3; 0 to 100000; default 998.2)
        particle_density: of the particles' solid (kg/m^3; 0 to 100000; default 0.0)
        mean_free_path: of a gas, for the slip correction; 0: none (m; 0 to 1; default 0.0)
        shear_constant: constant of shear_turbulent, 1.3 as often printed; 0: sqrt(8 pi/15) = 1.2944 (0 to 100; default 0.0)
        gravity: gravity g (m/s^2; 0 to 1e+06; default 9.80665)
        efficiency: collision efficiency E of settling; 0: by Stokes number and ratio of radii (0 to 1; default 0.0)
        settling_law: drag of settling spheres: the standard curve, or Stokes' (standard, stokes; default standard)
        rebuild: when cells are made anew: at snapshots of a changed cloud, at all of them, never; but for never also when 3/4 of the particles are left (changed, always, never; default changed)
        change_level: false alarms of the test that finds the cloud changed (1e-12 to 0.5; default 0.01)
        fixed: a regular mesh of this many cells an axis is evolved beside; 0: none (0 to 1000; default 0)
        depth: extent of the missing dimensions: a length in 2-D (a bare number: m), m^2 in 1-D (bare) (m; at least 0; default 0.0)
        outside: points outside the domain: refuse the file, or leave them out (error, drop; default error)
        variant: how far to go: tests and passes, first test and one pass, one pass, tests alone (full, first, fast, test; default full)
        mesh: what bins are joined into; tree splits by a chi-square test; auto: tree for the full variant, else boxes (boxes, components, bins, labels, tree, auto; default auto)
        events: n (n - 1) / 2 pairs, or n^2 as printed (pairs, paper; default pairs)
        level: level of each uniformity test (1e-06 to 0.5; default 0.05)
        votes: tests that must reject; where a single one votes, 2 is 1 (1 to 5; default 2)
        tests: tests that vote (default symmetric,centred,star,henze_zirkler,pearson)
        statistic: of the discrepancies: A_n as published, or Liang's stronger T (A, T; default A)
        paper: p-values, score (trapezoids) and events (n^2 / V) as printed, errors included (default False)
        ghost_samples: expected scores by so many ghost samples; 0: without sampling (0 to 65535; default 0)
        crossfit: events by cross-fitting too: cells of one half of the points, counts of the other half (default False)
        lower: lower threshold: the 20th percentile, or searched in [Q20, Q40) like the upper one, after it or jointly (q20, search, joint; default q20)
        strict: bins exactly at a threshold are ambient (the prose; the printed algorithm takes them) (default False)
        max_pass: passes at the most (1 to 64; default 10)
        beta_dt: collision kernel times time step [m^d]; 0: pair integral per beta dt [1/m^d] (m^d; at least 0; default 0.0)
        tree_level: level of the test in each tree cell (1e-09 to 0.5; default 0.01)
        tree_root_level: level of the test that splits the whole cloud into a tree: uniform clouds split by chance (1e-12 to 0.5; default 0.0001)
        variable_tolerance: standard deviation that a tree cell may keep of the variable (its column's unit) (at least 0; default 0.0)
        tree_least: points below which a tree cell is not split (2 to 1e+06; default 16)
        tree_refine: give each cell of a tree that was split as the blocks its last test looked at (default True)
        extrapolate: add the pairs that tree cells hide by being taken as uniform, from pairs at two sizes of cells (default True)
        pairs: count pairs by distance: g(r), and events by pairs beside those by cells (default False)
        pairs_radius: greatest distance of pairs (a bare number: m); 0: some 110 neighbours a point, three mean spacings in 3-D (m; at least 0; default 0.0)
        estimator: what events are counted by; auto: tree cells, and pairs by distance where cells do not resolve the cloud (cells, pairs, auto; default auto)
        seed: seed of every draw (ghost points, samples, collisions) (at least 0; default 1)
    """
    return _clouds.agglomerate(*snapshots, **given(locals(), 'snapshots'))


@spelt
def box_model(
        *,
        sizes: Any = None,
        seed: int | None = None,
        progress: Progress = None,
        solver: Literal["monte-carlo", "sectional"] | None = None,
        initial: Literal["mono", "exponential", "lognormal", "table"] | None = None,
        concentration: Quantity | None = None,
        initial_mean: float | None = None,
        initial_sd: float | None = None,
        particles: int | None = None,
        size_min: float | None = None,
        size_max: float | None = None,
        per_octave: int | None = None,
        breakage_rate: Quantity | None = None,
        breakage_exponent: float | None = None,
        fragments: Literal["power", "halves"] | None = None,
        fragment_exponent: float | None = None,
        source: Quantity | None = None,
        source_size: float | None = None,
        settling_depth: Quantity | None = None,
        tolerance: float | None = None,
        kernel: Text | None = None,
        duration: Quantity | None = None,
        n_step: int | None = None,
        repeats: int | None = None,
        collisions: Literal["next", "poisson"] | None = None,
        leap: float | None = None,
        block: int | None = None,
        out_of_range: Literal["error", "extrapolate"] | None = None,
        alpha: float | None = None,
        sticking: Literal["constant", "viscous", "liquid", "contact"] | None = None,
        film_viscosity: Quantity | None = None,
        film_thickness: Quantity | None = None,
        asperity: Quantity | None = None,
        restitution: float | None = None,
        critical_stokes: float | None = None,
        stokes_exponent: float | None = None,
        adhesion: Quantity | None = None,
        young: Quantity | None = None,
        poisson: float | None = None,
        radius_law: Literal["volume", "fractal-collision", "fractal-gyration"] | None = None,
        monomer_radius: Quantity | None = None,
        fractal_dimension: float | None = None,
        fractal_prefactor: float | None = None,
        constant: Quantity | None = None,
        additive: Quantity | None = None,
        product: Quantity | None = None,
        temperature: Quantity | None = None,
        viscosity: Quantity | None = None,
        density: Quantity | None = None,
        particle_density: Quantity | None = None,
        mean_free_path: Quantity | None = None,
        shear: Quantity | None = None,
        shear_constant: float | None = None,
        dissipation: Quantity | None = None,
        speed_rms: Quantity | None = None,
        gravity: Quantity | None = None,
        efficiency: float | None = None,
        settling_law: Literal["standard", "stokes"] | None = None,
) -> Spectrum:
    """Evolves the sizes of particles in a well-mixed box (`clast agglomerate --box-model`): box_model(concentration=1e12, kernel="constant").

    Monte Carlo, or solver="sectional" for breakage, sources and settling too. `sizes` is a table of the start, columns size (monomers) and
    number (1/m3; shares, where concentration is given), or the spectrum of a box, whose last time is taken: a file, a structured array, a
    DataFrame or a dictionary; it is initial="table".
    Ctrl-C ends it between steps.

    Keywords (None: the default; a number is SI, a text has its unit):
        seed: seed of every draw (ghost points, samples, collisions) (at least 0; default 1)
        solver: of a box: draws, or a sectional population balance (needs SUNDIALS) (monte-carlo, sectional; default monte-carlo)
        initial: sizes at the start of a box (mono, exponential, lognormal, table; default mono)
        concentration: particles a volume at the start of a box; of a table, whose numbers are then shares, or 0: their sum (1/m^3; at least 0; default 0.0)
        initial_mean: mean size at the start [monomers] (at least 1e-100; default 1.0)
        initial_sd: geometric standard deviation of a lognormal start (1.001 to 100; default 1.5)
        particles: particles of a Monte Carlo box (2 to 1e+07; default 10000)
        size_min: smallest size, which does not break [monomers]; 0: that of the start (which must then have others, or be single monomers, where particles break) (at least 0; default 0.0)
        size_max: largest size of the grid [monomers]; 0: 1e5 mean sizes of the start (at least 0; default 0.0)
        per_octave: sections of the grid that double the size (1 to 1000; default 16)
        breakage_rate: S1: a particle of x monomers breaks at S1 x^p (1/s; at least 0; default 0.0)
        breakage_exponent: p (-10 to 10; default 1.0)
        fragments: sizes v of the fragments of x: (c + 2)/x (v/x)^c, or two halves (power, halves; default power)
        fragment_exponent: c; 0: two fragments, uniform; monte-carlo: m fragments, 1/(m-1) - 1 (-0.99 to 100; default 0.0)
        source: particles that come in, a volume and time (1/(m^3 s); at least 0; default 0.0)
        source_size: their size [monomers] (at least 1e-100; default 1.0)
        settling_depth: particles leave at settling speed / this depth; 0: they stay (m; at least 0; default 0.0)
        tolerance: relative error of a step of the sectional solver (1e-12 to 0.01; default 1e-07)
        kernel: collision kernel, or a sum: brownian+settling; see the table above (default constant)
        duration: time that passes; of several snapshots after each, the last too: three take three times it (s; at least 0; default 1.0)
        n_step: steps of that time (1 to 1e+06; default 10)
        repeats: independent realisations, over which results are averaged (1 to 1e+06; default 1)
        collisions: event by event, or a Poisson number of events a sub-step (next, poisson; default next)
        leap: collisions of the busiest particle in a sub-step of poisson (1e-06 to 1; default 0.01)
        block: kinds of particles above which a cell is partitioned at random into blocks; 0: never (0 to 1e+06; default 1024)
        out_of_range: kernels and sticking beyond where they hold (the table above) (error, extrapolate; default error)
        alpha: share of collisions that stick; with another law of sticking a factor on it (0 to 1; default 1.0)
        sticking: share that sticks: alpha, or by the impact: a viscous film, wet ash, elastic contacts (constant, viscous, liquid, contact; default constant)
        film_viscosity: viscous, liquid: of the liquid on the particles (Pa s; 0 to 1e+12; default 0.0)
        film_thickness: viscous: h of the film (m; 0 to 1; default 0.0)
        asperity: viscous: height h_a of the roughness (m; 0 to 1; default 0.0)
        restitution: viscous: e of the dry solids (0 to 1; default 0.0)
        critical_stokes: liquid: St_cr, where half of the collisions stick (0 to 1e+12; default 1.3)
        stokes_exponent: liquid: q of 1 / (1 + (St / St_cr)^q) (0 to 100; default 0.8)
        adhesion: contact: work of adhesion of the surfaces (J/m^2; 0 to 1e+06; default 0.0)
        young: contact: Young's modulus of the particles (Pa; at least 0; default 0.0)
        poisson: contact: Poisson's ratio of the particles (-0.999 to 0.5; default 0.25)
        radius_law: collision radius of an aggregate: of the summed volume, a0 (i / k_f)^(1 / D_f), or from that law of the radius of gyration (volume, fractal-collision, fractal-gyration; default volume)
        monomer_radius: radius a0 of a monomer where no column gives radii (m; at least 0; default 0.0)
        fractal_dimension: D_f (1 to 3; default 1.8)
        fractal_prefactor: k_f (0.001 to 1000; default 1.0)
        constant: K of kernel constant [m^d/s] (m^d/s; at least 0; default 1e-06)
        additive: b of kernel additive [m^d/s] (m^d/s; at least 0; default 1e-06)
        product: c of kernel product [m^d/s] (m^d/s; at least 0; default 1e-06)
        temperature: of the fluid (K; 0 to 100000; default 293.15)
        viscosity: dynamic viscosity of the fluid (Pa s; 0 to 1e+06; default 0.001002)
        density: of the fluid (kg/m^3; 0 to 100000; default 998.2)
        particle_density: of the particles' solid (kg/m^3; 0 to 100000; default 0.0)
        mean_free_path: of a gas, for the slip correction; 0: none (m; 0 to 1; default 0.0)
        shear: shear rate G (1/s; 0 to 1e+12; default 0.0)
        shear_constant: constant of shear_turbulent, 1.3 as often printed; 0: sqrt(8 pi/15) = 1.2944 (0 to 100; default 0.0)
        dissipation: turbulent dissipation eps (m^2/s^3; 0 to 1e+12; default 0.0)
        speed_rms: turbulent velocity of the fluid, one component (m/s; 0 to 1e+06; default 0.0)
        gravity: gravity g (m/s^2; 0 to 1e+06; default 9.80665)
        efficiency: collision efficiency E of settling; 0: by Stokes number and ratio of radii (0 to 1; default 0.0)
        settling_law: drag of settling spheres: the standard curve, or Stokes' (standard, stokes; default standard)
    """
    return _boxes.box_model(**given(locals()))


@spelt
def decompose(
        positions: Any,
        *,
        domain: str | None = None,
        radius: Any = None,
        mass: Any = None,
        weight: Any = None,
        velocity: Any = None,
        variable: Any = None,
        test_only: bool = False,
        sizes: int = 0,
        regular: int = 0,
        outside: Literal["error", "drop"] | None = None,
        variant: Literal["full", "first", "fast", "test"] | None = None,
        mesh: Literal["boxes", "components", "bins", "labels", "tree", "auto"] | None = None,
        events: Literal["pairs", "paper"] | None = None,
        level: float | None = None,
        votes: int | None = None,
        tests: Text | None = None,
        statistic: Literal["A", "T"] | None = None,
        paper: bool | None = None,
        ghost_samples: int | None = None,
        crossfit: bool | None = None,
        lower: Literal["q20", "search", "joint"] | None = None,
        strict: bool | None = None,
        max_pass: int | None = None,
        beta_dt: Quantity | None = None,
        tree_level: float | None = None,
        tree_root_level: float | None = None,
        variable_tolerance: float | None = None,
        tree_least: int | None = None,
        tree_refine: bool | None = None,
        extrapolate: bool | None = None,
        pairs: bool | None = None,
        pairs_radius: Quantity | None = None,
        estimator: Literal["cells", "pairs", "auto"] | None = None,
        seed: int | None = None,
) -> Decomposition:
    """Splits a Cloud, or positions (n, 1 to 3) [m], into cells of uniform concentration and counts events.

    float64 arrays in C order are read where they lie, others are converted once. `domain` is that of the command
    ("box:0,0,0,1,1,1", "sphere:5mm"); its other keys follow as keywords (seed=1, beta_dt=1e-12, mesh="tree"). `test_only` runs the
    tests alone (`reject` says what they found); `sizes` gives the table of that name, what `clast decompose --sizes` writes.
    A call cannot be interrupted: Ctrl-C waits for its end.

    Keywords (None: the default; a number is SI, a text has its unit):
        domain: known domain: box:LOW..,HIGH.., cylinder:R,L or X,Y,Z,NX,NY,NZ,R,L (base, axis), half-pipe:R,L, sphere:R or X,Y,Z,R, mesh:FILE [m, or as 1mm] (no default)
        test_only: run the uniformity tests alone, exit code 1 when not uniform, 0 with fewer than 5 points (not tested) (default False)
        sizes: events of random parts of n, n/2, n/4 .. points, so many sizes, as a table and a chart; 0: none (0 to 40; default 0)
        regular: with --sizes: a regular mesh of so many cells an axis beside; 0: none (0 to 200; default 0)
        outside: points outside the domain: refuse the file, or leave them out (error, drop; default error)
        variant: how far to go: tests and passes, first test and one pass, one pass, tests alone (full, first, fast, test; default full)
        mesh: what bins are joined into; tree splits by a chi-square test; auto: tree for the full variant, else boxes (boxes, components, bins, labels, tree, auto; default auto)
        events: n (n - 1) / 2 pairs, or n^2 as printed (pairs, paper; default pairs)
        level: level of each uniformity test (1e-06 to 0.5; default 0.05)
        votes: tests that must reject; where a single one votes, 2 is 1 (1 to 5; default 2)
        tests: tests that vote (default symmetric,centred,star,henze_zirkler,pearson)
        statistic: of the discrepancies: A_n as published, or Liang's stronger T (A, T; default A)
        paper: p-values, score (trapezoids) and events (n^2 / V) as printed, errors included (default False)
        ghost_samples: expected scores by so many ghost samples; 0: without sampling (0 to 65535; default 0)
        crossfit: events by cross-fitting too: cells of one half of the points, counts of the other half (default False)
        lower: lower threshold: the 20th percentile, or searched in [Q20, Q40) like the upper one, after it or jointly (q20, search, joint; default q20)
        strict: bins exactly at a threshold are ambient (the prose; the printed algorithm takes them) (default False)
        max_pass: passes at the most (1 to 64; default 10)
        beta_dt: collision kernel times time step [m^d]; 0: pair integral per beta dt [1/m^d] (m^d; at least 0; default 0.0)
        tree_level: level of the test in each tree cell (1e-09 to 0.5; default 0.01)
        tree_root_level: level of the test that splits the whole cloud into a tree: uniform clouds split by chance (1e-12 to 0.5; default 0.0001)
        variable_tolerance: standard deviation that a tree cell may keep of the variable (its column's unit) (at least 0; default 0.0)
        tree_least: points below which a tree cell is not split (2 to 1e+06; default 16)
        tree_refine: give each cell of a tree that was split as the blocks its last test looked at (default True)
        extrapolate: add the pairs that tree cells hide by being taken as uniform, from pairs at two sizes of cells (default True)
        pairs: count pairs by distance: g(r), and events by pairs beside those by cells (default False)
        pairs_radius: greatest distance of pairs (a bare number: m); 0: some 110 neighbours a point, three mean spacings in 3-D (m; at least 0; default 0.0)
        estimator: what events are counted by; auto: tree cells, and pairs by distance where cells do not resolve the cloud (cells, pairs, auto; default auto)
        seed: seed of every draw (ghost points, samples, collisions) (at least 0; default 1)
    """
    return _clouds.decompose(**given(locals()))


@spelt
def evolve(
        *,
        output: Path | None = None,
        progress: Progress = None,
        shapes: Texts | None = None,
        shape_weight: Quantities | None = None,
        density: Quantities | None = None,
        unit: Text | None = None,
        accept_faults: bool | None = None,
        curve: Quantity | Text | None = None,
        particles: int | None = None,
        weight: float | None = None,
        release: Text | None = None,
        points: Text | None = None,
        columns: Texts | None = None,
        diameter_column: Text | None = None,
        frame: int | None = None,
        dataset: Text | None = None,
        domain: Text | None = None,
        floor: Literal["deposit", "reflect", "periodic"] | None = None,
        sides: Literal["deposit", "reflect", "periodic"] | None = None,
        open_top: bool | None = None,
        wind: Text | None = None,
        field: Text | None = None,
        field_columns: Text | None = None,
        wind_shear: Quantity | None = None,
        eddy_diffusivity: Quantity | None = None,
        brownian: bool | None = None,
        fall: Literal["form", "sphere", "stokes"] | None = None,
        temperature: Quantity | None = None,
        viscosity: Quantity | None = None,
        fluid_density: Quantity | None = None,
        mean_free_path: Quantity | None = None,
        gravity: Quantity | None = None,
        kernel: Text | None = None,
        shear: Quantity | None = None,
        dissipation: Quantity | None = None,
        speed_rms: Quantity | None = None,
        efficiency: float | None = None,
        constant: Quantity | None = None,
        additive: Quantity | None = None,
        product: Quantity | None = None,
        out_of_range: Literal["error", "extrapolate"] | None = None,
        collision_radius: Literal["gyration", "enclosing", "volume"] | None = None,
        even: Literal["tree", "boxes", "whole"] | None = None,
        change_level: float | None = None,
        alpha: float | None = None,
        sticking: Literal["constant", "viscous", "liquid", "contact"] | None = None,
        film_viscosity: Quantity | None = None,
        film_thickness: Quantity | None = None,
        asperity: Quantity | None = None,
        restitution: float | None = None,
        critical_stokes: float | None = None,
        stokes_exponent: float | None = None,
        adhesion: float | None = None,
        young: Quantity | None = None,
        poisson: float | None = None,
        structure: bool | None = None,
        meeting: Literal["auto", "ballistic", "diffusive", "central", "reaction"] | None = None,
        walk_step: float | None = None,
        max_tries: int | None = None,
        duration: Quantity | None = None,
        rows: int | None = None,
        step_error: float | None = None,
        time_step: Quantity | None = None,
        seed: int | None = None,
        keep: int | None = None,
        bed_width: Quantity | None = None,
        frames: int | None = None,
        checkpoint_time: Quantity | None = None,
        resume: Text | None = None,
        force: bool | None = None,
) -> Result:
    """Follows a cloud of true shapes to the floor: evolve(domain="box:0,0,0,1cm,1cm,1cm", particles=200, curve="20um", duration="1s").

    With `output` the run's folder is written, checkpoints on the way; Ctrl-C then ends at one, and evolve(resume="run") goes on.

    Keywords (None: the default; a number is SI, a text has its unit):
        shapes: shapes, drawn by weight: sphere, ellipsoid:a,b,c, a closed surface, or an aggregate (state.h5) (default sphere)
        shape_weight: probability of each shape; none: all equal (at least 0; no default)
        density: of the solid: one for all shapes, or one each (kg/m^3; 1e-06 to 1e+06; default 2500)
        unit: length unit of surface files; may be left out: sizes come from the curve (no default)
        accept_faults: use surfaces that are open, cross themselves or lie apart as they are (default False)
        curve: diameters of equal volume: one size, uniform:LOW,HIGH, lognormal:MEAN,DEVIATION[,LOW,HIGH], list:FILE, masses:FILE, a sieve curve's file, or a published case (default 10um)
        particles: particles at the start; 0: the rows of points (0 to 1e+07; default 0)
        weight: real particles W that each stands for, a whole number: the number density is particles x W / volume; rows in time and the summary have masses of all of them, tables of bodies and events the mass of one (at least 1; default 1.0)
        release: domain in which they start uniformly distributed (as domain), as far as it lies in that; a box in a box lies in it all; none: all of the domain (no default)
        points: file of positions x, y, z to start from instead (CSV, VTK, PLY, dump, HDF5) (no default)
        columns: its columns of coordinates, three; units in their names count (x_mm), else they are in m; x,y,z are found as x_m, y_m, z_m too (default x,y,z)
        diameter_column: its column of volume-equivalent diameters; none: the curve (no default)
        frame: its snapshot, of a LAMMPS dump or .xyz, from 0; -1: the last (-1e+12 to 1e+12; default 0)
        dataset: its array or folder, of an HDF5 file (no default)
        domain: box:LOW..,HIGH.., cylinder:X,Y,Z,NX,NY,NZ,R,L (base, axis), sphere:R, mesh:FILE; z is up (no default)
        floor: what is below: it stays there, comes back, or enters at the top (deposit, reflect, periodic; default deposit)
        sides: the same of the sides; periodic: a box alone (deposit, reflect, periodic; default periodic)
        open_top: what passes the top of a box is gone; else it comes back (default False)
        wind: velocity x,y,z of the fluid at z = 0 [m/s] (default 0,0,0)
        field: file of velocities on a regular grid (CSV x,y,z,u,v,w in m and m/s, VTK, HDF5, ...), added to the wind; beyond the grid those at its edge (no default)
        field_columns: its columns of velocities (default u,v,w)
        wind_shear: change of velocity x with z (1/s; -1e+09 to 1e+09; default 0.0)
        eddy_diffusivity: turbulent diffusivity, the same everywhere (m^2/s; 0 to 1e+06; default 0.0)
        brownian: particles diffuse by Brownian motion, as their envelopes' drag says (default True)
        fall: drag: of each body's own form, of the sphere of its envelope, or of that in creeping flow (form, sphere, stokes; default form)
        temperature: of the fluid (K; 0 to 100000; default 288.15)
        viscosity: of the fluid (default: air) (Pa s; 0 to 1e+06; default 1.7894e-05)
        fluid_density: of the fluid (default: air) (kg/m^3; 0 to 100000; default 1.225)
        mean_free_path: of a gas, for the slip correction; 0: none (m; 0 to 1; default 0.0)
        gravity: 0: nothing falls (m/s^2; 0 to 1e+06; default 9.80665)
        kernel: collision kernel, or a sum, as in clast agglomerate --help-all: constant, additive, product, brownian, shear_laminar, shear_turbulent, settling, inertial, ... (default brownian+settling)
        shear: shear rate that kernels use; 0: that of wind_shear (1/s; 0 to 1e+12; default 0.0)
        dissipation: turbulent dissipation (m^2/s^3; 0 to 1e+12; default 0.0)
        speed_rms: turbulent velocity, one component (m/s; 0 to 1e+06; default 0.0)
        efficiency: collision efficiency of settling; 0: by Stokes number and ratio of radii (0 to 1; default 0.0)
        constant: K of kernel constant (m^3/s; at least 0; default 1e-06)
        additive: b of kernel additive (m^3/s; at least 0; default 1e-06)
        product: c of kernel product (m^3/s; at least 0; default 1e-06)
        out_of_range: kernels and sticking beyond where they hold (error, extrapolate; default error)
        collision_radius: radius that kernels use: sqrt(5/3) R_g, of the enclosing sphere, of the solid's sphere (gyration, enclosing, volume; default gyration)
        even: where bodies count as uniformly distributed: cells that a test splits, boxes of bins, or the whole domain (tree, boxes, whole; default tree)
        change_level: false alarms of the test that finds the cells out of date (1e-12 to 0.5; default 0.01)
        alpha: share of collisions that stick; with another law of sticking a factor on it (0 to 1; default 1.0)
        sticking: share that sticks: alpha, or by the impact: a viscous film, wet ash, elastic contacts (constant, viscous, liquid, contact; default constant)
        film_viscosity: viscous, liquid: of the liquid on the particles (Pa s; 0 to 1e+12; default 0.0)
        film_thickness: viscous: h of the film (m; 0 to 1; default 0.0)
        asperity: viscous: height h_a of the roughness (m; 0 to 1; default 0.0)
        restitution: viscous: e of the dry solids (0 to 1; default 0.0)
        critical_stokes: liquid: St_cr, where half of the collisions stick (0 to 1e+12; default 1.3)
        stokes_exponent: liquid: q of 1 / (1 + (St / St_cr)^q) (0 to 100; default 0.8)
        adhesion: contact: work of adhesion of the surfaces [J/m^2] (0 to 1e+06; default 0.0)
        young: contact: Young's modulus of the particles (Pa; at least 0; default 0.0)
        poisson: contact: Poisson's ratio of the particles (-0.999 to 0.5; default 0.25)
        structure: aggregates keep their grains as they touch; no: drops that merge (default True)
        meeting: how the smaller of a pair comes: auto is diffusive for kernel brownian alone, else on lines over the cross-section; reaction: all contacts equally likely, as where few touches stick (auto, ballistic, diffusive, central, reaction; default auto)
        walk_step: diffusive: least step of the walk, in radii of the smallest released particle (0.0001 to 1; default 0.1)
        max_tries: paths or contacts tried before a pair is given up, in thousands; central lines: one by one (1 to 1e+06; default 100)
        duration: time that passes at most (s; at least 0; default 0.0)
        rows: rows of the tables over it (1 to 1e+06; default 50)
        step_error: share of a meeting, of the height passed up or down (of the width too, where sides are not periodic) and of the density that a field changes, that a step may hold; and the most collisions of a pair's kind in a sub-step (1e-06 to 0.5; default 0.05)
        time_step: longest step; 0: by step_error (s; at least 0; default 0.0)
        seed: of every draw (at least 0; default 1)
        keep: aggregates of most grains, each written as a state.h5 for clast pack --shapes (0 to 1e+06; default 20)
        bed_width: width of the column in deposit.h5 (that of its widest body at least; a periodic bed asks for 2.25 of them), where all bodies of the floor wait for clast pack --start, each above its position (modulo the width) and those that came before; 0: none (m; 0 to 1e+06; default 0.0)
        frames: a frame for ParaView at each so many rows; 0: none (0 to 1e+06; default 0)
        checkpoint_time: between checkpoints, of the clock (s; 0 to 1e+09; default 60.0)
        resume: run folder to go on with (no default)
        force: replace an earlier run in the output folder (default False)
    """
    return _growth.evolve(**given(locals()))


@spelt
def export(
        run: Path | Assembly,
        output: Path,
        *,
        level: int = 3,
        points: bool = False,
        colour: str = 'grain',
        table: str = '',
        unit: str = '',
        density: Quantity = 0.0,
        columns: str = '',
        diameter: Quantity = 0.0,
) -> dict[str, Any]:
    """Writes the grains of a run or of another program's file by the name's end, or one `table` of the run.

    Names end in .vtu, .stl, .obj, .ply, .3mf, .csv, .json, .dump or .data (LAMMPS), .txt (YADE), .voro, .xyzd or .conf. STL, OBJ and PLY
    name no unit: they are in mm unless `unit` says else. Returns format, unit and counts.

    Keywords (None: the default; a number is SI, a text has its unit):
        level: fineness of spheres and ellipsoids: 20 * 4^level triangles (0 to 7; default 3)
        points: VTU of a point a grain, with quaternion and scale, instead of surfaces (default False)
        colour: what colours the grains of a PLY (grain, order, size, shape; default grain)
        table: write this table of the run (.csv or .json) instead of its grains (no default)
        unit: length unit of the coordinates in .stl, .obj and .ply; none: mm, as 3MF has it (no default)
        density: of all grains of another program's file that gives none; 0: not known, left out (kg/m^3; 0 to 1e+06; default 0.0)
        columns: spheres of another program: what its columns are, all of them, such as id,x,y,z,d (- passes one over); none: by their names (no default)
        diameter: spheres of another program: diameter of all, instead of the file's; 0: the file's (default 0)
    """
    return _runs.export(**given(locals()))


@spelt
def fill(
        mesh: Mesh | Path,
        *,
        progress: Progress = None,
        spheres: int | None = None,
        strategy: Literal["largest", "random", "published"] | None = None,
        filled: float | None = None,
        volume_error: float | None = None,
        centroid_error: float | None = None,
        inertia_error: float | None = None,
        min_radius: float | None = None,
        min_share: float | None = None,
        tolerance: float | None = None,
        candidates: int | None = None,
        first_at_centre: bool | None = None,
        vertex_subset: bool | None = None,
        max_tries: int | None = None,
        outer: bool | None = None,
        shrink: float | None = None,
        overlap: bool | None = None,
        protrusion: float | None = None,
        allow_open: bool | None = None,
        seed: int | None = None,
) -> Spheres:
    """Fills a closed surface, or that of a file, with spheres.

    Keywords (None: the default; a number is SI, a text has its unit):
        spheres: most spheres; 0: 300, or 100000 when a bound is asked for (0 to 1e+07; default 0)
        strategy: how the next sphere is found (largest, random, published; default largest)
        filled: stop at this share of the volume; 0: not asked (0 to 0.999999; default 0.0)
        volume_error: stop at this error of the volume; 0: not asked (0 to 1e+06; default 0.0)
        centroid_error: stop at this error of the centroid; 0: not asked (0 to 1e+06; default 0.0)
        inertia_error: stop at this error of the inertia; 0: not asked (0 to 1e+06; default 0.0)
        min_radius: no smaller spheres, model units; 0: any (at least 0; default 0.0)
        min_share: largest, overlap: no sphere below this share of the first one's radius (0.0001 to 1; default 0.01)
        tolerance: largest: radius may be this share below the largest (1e-09 to 1; default 0.03)
        candidates: random, published: candidates for each sphere (N_iter) (1 to 1e+09; default 10)
        first_at_centre: random, published: first sphere at the mean of the corners (default True)
        vertex_subset: published: the released code's random third of the corners (default False)
        max_tries: random, published: points tried in vain before giving up (at least 1; default 1000000)
        outer: keep the outer spheres only (O_ext) (default False)
        shrink: outer: 0 convex hull of the centres .. 1 tightest boundary (0 to 1; default 0.5)
        overlap: spheres may overlap: a clump (default False)
        protrusion: overlap: share of its radius by which a sphere may poke out (0 to 0.9; default 0.0)
        allow_open: accept a surface with large holes; they are capped (default False)
        seed: seed of the random draws (at least 0; default 1)
    """
    return _beds.fill(**given(locals()))


@spelt
def fit(
        table: Any,
        *,
        features: str = 'auto',
        grains: Any = None,
        name: str = 'fitted',
        target: Text | None = None,
        columns: Text | None = None,
        group: Text | None = None,
        n_term: int | None = None,
        use: Text | None = None,
        correlation_limit: float | None = None,
        n_fold: int | None = None,
        n_repeat: int | None = None,
        score: Literal["mean", "median"] | None = None,
        validation: Literal["nested", "published"] | None = None,
        n_permutation: int | None = None,
        seed: int | None = None,
) -> Fit:
    """Fits a linear porosity model to a table of beds [Rettinger2022 sec. 6.3, 7.2].

    `table` has a row a bed (a file, a structured array, a DataFrame, a dictionary of columns); with `grains` a second table, or the
    folder of a study of `clast pack`, holds the grains of all beds, and a column of both (group="bed") names the bed.
    A call cannot be interrupted: Ctrl-C waits for its end.

    Keywords (None: the default; a number is SI, a text has its unit):
        features: features to choose from; form: 26 of each bed's one form; mixture: 104 of --grains; columns: the table's own; auto: mixture with --grains, else form where columns are named as a form's, else columns (auto, form, mixture, columns; default auto)
        grains: study folder, or table of all beds' grains, with a column that names the bed (--group) (no default)
        name: name of the model (default fitted)
        target: column with the measured porosity (default porosity)
        columns: columns of the form: flatness,elongation or L,I,S (else known by their names); with features columns: the candidates (no default)
        group: column that names the bed, in the table of beds and in that of the grains; it is no feature (default bed)
        n_term: features of the model (1 to 20; default 2)
        use: take these features (a,b,...) instead of selecting (no default)
        correlation_limit: remove features whose abs(r) to a chosen one is greater (0 to 1; default 0.8)
        n_fold: folds of the cross-validation (2 to 1e+06; default 10)
        n_repeat: cross-validations with other folds to average (1 to 10000; default 1)
        score: absolute error that decides: the mean (Tables 9, 10 of the paper) or the median (mean, median; default mean)
        validation: features for a held-out bed: selected anew without it (nested), or with it, as in the paper (published), which makes the errors too small (nested, published; default nested)
        n_permutation: permutations of the porosities among the beds for p-values (0: none) (0 to 1e+06; default 199)
        seed: random numbers of folds and permutations (at least 0; default 1)
    """
    return _models.fit(**given(locals()))


@spelt
def mesh_check(
        path: Path,
        *,
        weld: str = 'auto',
        weld_tolerance: float = 1e-06,
) -> MeshCheck:
    """What is this file's surface, and can it be trusted?

    Keywords (None: the default; a number is SI, a text has its unit):
        weld: merge near vertices first: those of open edges, as every command does that reads a surface; not at all; or all within weld_tolerance (auto, off, within; default auto)
        weld_tolerance: for weld within: times the extent (0 to 0.1; default 1e-06)
    """
    return _mesh.mesh_check(**given(locals()))


@spelt
def mesh_convert(
        surface: Surface,
        output: Path,
        *,
        unit: str = '',
        out_unit: str = '',
        scale: float = 1.0,
        name: str = '',
) -> SurfaceResult:
    """Writes a surface as STL, OBJ, PLY, OFF or 3MF by the name's end, in another unit if wanted; 3MF needs `unit`.

    Keywords (None: the default; a number is SI, a text has its unit):
        unit: length unit of the input's coordinates; that of its header when clast wrote one (no default)
        out_unit: unit of the output's coordinates; that of the input when not given (no default)
        scale: factor on all lengths (at least 1e-100; default 1.0)
        name: name of the part, written in an STL, OBJ or 3MF (no default)
    """
    return _surfaces.mesh_convert(**given(locals()))


@spelt
def mesh_form(
        surface: Surface,
        *,
        flatness: float = 0.0,
        elongation: float = 0.0,
        size: float | str = 0.0,
        unit_form: bool = False,
        hull: int = 0,
        output: Path | None = None,
) -> SurfaceResult:
    """A grain in its principal frame, stretched to S/I, I/L and sieve size (0: its own); hull > 0 takes the convex hull first.

    `before` is of the surface (numbers are NaN where it bounds no solid), `hull` of the hull that is stretched. A `size` may have a unit ("7mm")
    where the surface's file names its own.

    Keywords (None: the default; a number is SI, a text has its unit):
        flatness: wanted S/I; 0: the grain's own (0 to 1; default 0.0)
        elongation: wanted I/L; 0: the grain's own (0 to 1; default 0.0)
        size: wanted sieve size D = sqrt((S^2+I^2)/2) in the unit of the file, or with its own where the file has one; 0: the grain's own (default 0)
        unit_form: take all form off: L = I = S = 1 (default False)
        hull: take the convex hull first, with at most so many triangles; 0: the surface itself (0 to 1e+06; default 0)
    """
    return _surfaces.mesh_form(**given(locals()))


@spelt
def mesh_hull(
        surface: Surface,
        *,
        output: Path | None = None,
) -> SurfaceResult:
    """The convex hull of a surface or of points, and the volume that it adds.
    """
    return _surfaces.mesh_hull(**given(locals()))


@spelt
def mesh_repair(
        surface: Surface,
        *,
        output: Path | None = None,
        weld: Literal["auto", "off", "within"] | None = None,
        weld_tolerance: float | None = None,
        drop: bool | None = None,
        split: bool | None = None,
        split_tolerance: float | None = None,
        loose: bool | None = None,
        orient: bool | None = None,
        fill: bool | None = None,
        fill_size: float | None = None,
        separate: bool | None = None,
        unite: bool | None = None,
        keep: Literal["all", "largest"] | None = None,
) -> SurfaceResult:
    """Makes a surface closed, oriented and manifold where it can; reports each change, and in `check` what it is now.

    Keywords (None: the default; a number is SI, a text has its unit):
        weld: merge near vertices: the smallest distance that closes the surface, not at all, or within weld_tolerance (auto, off, within; default auto)
        weld_tolerance: for weld within: times the extent (0 to 0.1; default 1e-06)
        drop: drop triangles without area or that repeat others (default True)
        split: split edges at vertices that lie on them (T-junctions) (default True)
        split_tolerance: how far from the edge such a vertex may lie, times the extent (0 to 0.01; default 1e-06)
        loose: drop triangles that share no edge with others (default True)
        orient: orient neighbours consistently and closed parts outward (default True)
        fill: fill holes with the triangles of least area (default True)
        fill_size: largest hole to fill, times the extent (0 to 1; default 1.0)
        separate: give surfaces that touch in an edge or vertex their own vertices (default True)
        unite: drop nested parts that bound nothing: outward ones in a solid, inward ones outside of it (default True)
        keep: parts to keep: all, or the one of the largest volume with its cavities (all, largest; default all)
    """
    return _surfaces.mesh_repair(**given(locals()))


@spelt
def mesh_simplify(
        surface: Surface,
        faces: int = 300,
        *,
        output: Path | None = None,
) -> SurfaceResult:
    """Fewer triangles, same volume; reports how far the two surfaces are apart. Fewer than wanted where topology forbids (`reached`).

    Keywords (None: the default; a number is SI, a text has its unit):
        faces: number of triangles wanted (4 to 2e+09; default 300)
    """
    return _surfaces.mesh_simplify(**given(locals()))


@spelt
def mesh_synthesize(
        index: int = 0,
        *,
        output: Path | None = None,
        size: float | str = 1.0,
        unit: str = '',
        flatness: float | None = None,
        flatness_deviation: float | None = None,
        elongation: float | None = None,
        elongation_deviation: float | None = None,
        form_low: float | None = None,
        form_high: float | None = None,
        measure: Literal["amplitude", "normal_roundness", "angularity"] | None = None,
        rough: float | None = None,
        tolerance: float | None = None,
        decay: float | None = None,
        degrees: int | None = None,
        faces: int | None = None,
        seed: int | None = None,
) -> SurfaceResult:
    """A grain of a wanted form, size and roughness that nobody scanned: the one of this index and seed (`--count` makes 0, 1, 2 ...).

    Keywords (None: the default; a number is SI, a text has its unit):
        size: sieve size D = sqrt((S^2+I^2)/2), in --unit, or with its own where that is given (default 1)
        unit: of lengths (mm, um, ..), which PLY, OBJ and OFF hand on; none: model units (no default)
        flatness: S/I of the mass-equivalent ellipsoid, the mean when a deviation is given (0.001 to 1; default 0.647)
        flatness_deviation: of a normal law cut to form_low .. form_high (0 to 10; default 0.0)
        elongation: I/L, likewise (0.001 to 1; default 0.682)
        elongation_deviation: likewise (0 to 10; default 0.0)
        form_low: least flatness and elongation (0.001 to 1; default 0.1)
        form_high: greatest (0.001 to 1; default 1.0)
        measure: what `rough` is: the amplitude of ln r, or the finished grain's measured normal roundness or angularity (amplitude, normal_roundness, angularity; default angularity)
        rough: wanted roughness (0 to 1; default 0.075)
        tolerance: of the measured one (1e-06 to 1; default 0.001)
        decay: coefficients of degree n fall as n^-decay: larger is smoother (0 to 10; default 3.0)
        degrees: greatest degree of the spherical harmonics (3 to 64; default 12)
        faces: at most so many triangles (8 to 100000; default 300)
        seed: seed of form and roughness (at least 0; default 1)
    """
    return _surfaces.mesh_synthesize(**given(locals()))


@spelt
def pack(
        *,
        output: Path | None = None,
        progress: Progress = None,
        curve: Quantity | Text | None = None,
        spread: Literal["step", "linear", "means"] | None = None,
        count: Literal["mean", "exact"] | None = None,
        size_meaning: Literal["sieve", "volume"] | None = None,
        shapes: Texts | None = None,
        shape_weight: Quantities | None = None,
        unit: Text | None = None,
        hull: bool | None = None,
        faces: int | None = None,
        ellipsoids: bool | None = None,
        form_law: bool | None = None,
        flatness_mean: float | None = None,
        flatness_deviation: float | None = None,
        elongation_mean: float | None = None,
        elongation_deviation: float | None = None,
        density: Quantities | None = None,
        density_of: Literal["shape", "chance", "class", "list"] | None = None,
        density_weight: Quantities | None = None,
        mass: Quantity | None = None,
        seed: int | None = None,
        material: Texts | None = None,
        contacts: Texts | None = None,
        start: Text | None = None,
        start_unit: Text | None = None,
        start_columns: Text | None = None,
        start_diameter: Quantity | None = None,
        start_frame: int | None = None,
        container: Text | None = None,
        container_unit: Text | None = None,
        domain: Literal["cylinder", "periodic", "box", "open", "cell"] | None = None,
        width: Quantity | None = None,
        depth: Quantity | None = None,
        height: Quantity | None = None,
        floor: bool | None = None,
        lid: bool | None = None,
        law: Literal["linear", "hertz"] | None = None,
        contact_scheme: Literal["explicit", "exact"] | None = None,
        restitution: float | None = None,
        collision_time: Quantity | None = None,
        young: Quantity | None = None,
        poisson: float | None = None,
        friction: float | None = None,
        wall_friction: float | None = None,
        rolling_friction: float | None = None,
        rolling_model: Literal["torque", "spring"] | None = None,
        cohesion: Literal["none", "area", "dmt", "jkr"] | None = None,
        cohesion_energy: Quantity | None = None,
        surface_energy: Quantity | None = None,
        clip: bool | None = None,
        normal_torque: bool | None = None,
        gyroscopic: bool | None = None,
        clump_contacts: Literal["shared", "each"] | None = None,
        time_step: Quantity | None = None,
        gravity: Quantity | None = None,
        fluid_density: Quantity | None = None,
        fluid_viscosity: Quantity | None = None,
        sphere_drag: Literal["form", "standard"] | None = None,
        hindrance: bool | None = None,
        added_mass: float | None = None,
        wet_restitution: bool | None = None,
        rounding: Quantity | None = None,
        skin: float | None = None,
        verify: int | None = None,
        generator: Literal["cubic", "hcp", "shelf"] | None = None,
        spacing: Quantity | None = None,
        fill_low: float | None = None,
        fill_high: float | None = None,
        first_low: float | None = None,
        first_high: float | None = None,
        initial_speed: Quantity | None = None,
        random_turn: bool | None = None,
        shake_amplitude: Quantity | None = None,
        shake_period: Quantity | None = None,
        shaking_time: Quantity | None = None,
        shake_from_start: bool | None = None,
        damping: float | None = None,
        rule: Literal["height", "speed", "either"] | None = None,
        height_change: Quantity | None = None,
        check_time: Quantity | None = None,
        still_speed: Quantity | None = None,
        max_steps: int | None = None,
        max_damping_time: Quantity | None = None,
        wall: Texts | None = None,
        outlet: Texts | None = None,
        wall_forces: bool | None = None,
        stages: Texts | None = None,
        load_rate: Quantity | None = None,
        load_tolerance: float | None = None,
        load_rest: float | None = None,
        max_load_time: Quantity | None = None,
        energy: bool | None = None,
        layer: Quantity | None = None,
        cut: float | None = None,
        trim: Quantity | None = None,
        series_time: Quantity | None = None,
        frame_time: Quantity | None = None,
        checkpoint_time: Quantity | None = None,
        force: bool | None = None,
        resume: Text | None = None,
) -> Result:
    """Pours, shakes and damps a bed of grains: pack(curve="4mm", mass="2g", width="30mm", height=0.1, shaking_time=0).

    Keywords (None: the default; a number is SI, a text has its unit):
        curve: sizes: a published case (U1 U3 U5 U7 B30 B50 B70), a sieve curve's file, list:FILE (sizes, counts), masses:FILE (sizes, masses), uniform:LOW,HIGH, lognormal:MEAN,DEVIATION[,LOW,HIGH], or one size (default U1)
        spread: how sizes lie within a sieve class (step, linear, means; default step)
        count: grains of a class by its mean size (eq. 9), or by its mass (mean, exact; default mean)
        size_meaning: sizes are sieve sizes (eq. 1), or volume-equivalent (sieve, volume; default sieve)
        shapes: shapes, drawn by weight: sphere, ellipsoid:a,b,c, a surface (its convex hull), spheres of a clump (CSV x,y,z,radius or state.h5), or an aggregate (state.h5); only their form counts, and with density 0 an aggregate's own density (default sphere)
        shape_weight: probability of each shape; none: all equal (at least 0; no default)
        unit: length unit of surface files; may be left out, since sizes come from the curve (no default)
        hull: take the convex hull of every surface and report the volume it adds; no: refuse surfaces that are not convex (default True)
        faces: take hulls of at most so many triangles; 0: as many as they have (0 to 1e+06; default 0)
        ellipsoids: take the mass-equivalent ellipsoid of every surface and clump (default False)
        form_law: stretch every grain to a form drawn from normal laws of S/I and I/L (default False)
        flatness_mean: mean flatness S/I of form_law (0.001 to 1; default 0.647)
        flatness_deviation: its standard deviation (0 to 10; default 0.175)
        elongation_mean: mean elongation I/L of form_law (0.001 to 1; default 0.682)
        elongation_deviation: its standard deviation (0 to 10; default 0.139)
        density: density of the grains (rho_p), else 2650: one for all, or one for each shape (or as density_of says); 0: those of the aggregate's own parts, as its state.h5 has them; none beside a start, which has its own (kg/m^3; 0 to 1e+06; no default)
        density_of: density lists one for each shape, or several to draw from whatever a grain's shape, or one for each class of the sieve curve; list: column density of list:FILE or masses:FILE, in place of density (shape, chance, class, list; default shape)
        density_weight: probability of each density (by number of grains) with density_of: chance; none: all equal (at least 0; no default)
        mass: mass of the packing (m_tot) (kg; at least 1e-15; default 1.0)
        seed: seed of sizes, forms, orientations, velocities (at least 0; default 1)
        material: name of the grains' material, one for all shapes or one for each, for contacts (no default)
        contacts: what differs where two sides touch, later ones over earlier: two of grains, walls, materials, walls' names (floor, lid, sides, ..., of wall); then friction 0.2, rolling_friction, restitution 0.5, poisson, collision_time 100us (law linear), young 5MPa,200GPa (law hertz; one number, or one of either side) (no default)
        start: packing to begin with, in place of grains that are made: a run of clast (state.h5, or its export as CSV beside shapes), or spheres of another program (CSV, LAMMPS dump, YADE's x y z r, voro++, .xyz, .xyzd) (no default)
        start_unit: length unit of the start, where it does not say (a dump's ITEM: UNITS) (no default)
        start_columns: columns of its spheres in their order, all of them, - to pass one over: id,x,y,z,d (no default)
        start_diameter: of all its spheres; 0: as the file says (m; 0 to 1e+06; default 0.0)
        start_frame: snapshot of a LAMMPS dump or .xyz, from 0; negative: from the end (at least -9e+15; default -1)
        container: surface, closed or open, that holds the grains in place of domain, width, depth and height; grains are made inside of it (no default)
        container_unit: length unit of its coordinates, where its header does not say (clast's does) (no default)
        domain: container, its sides; cell: periodic in x, y and z (height); open: container alone (cylinder, periodic, box, open, cell; default cylinder)
        width: inside diameter of the cylinder, or width in x (L) (m; 1e-09 to 1e+06; default 0.104)
        depth: width in y; 0: as width (m; 0 to 1e+06; default 0.0)
        height: height of the lid and of generation (H) (m; 1e-09 to 1e+06; default 1.0)
        floor: plane at z = 0 (default True)
        lid: plane at z = height (default False)
        law: contact law (linear, hertz; default linear)
        contact_scheme: steps of spring and dashpot: explicit as published, or exact, which bear a twentieth of collision_time (and make beds denser by 0.004 there) (explicit, exact; default explicit)
        restitution: coefficient of restitution (e_n) (0.001 to 1; default 0.1)
        collision_time: duration of a collision (T_c), linear law (s; 1e-12 to 1000; default 0.0002)
        young: Young's modulus, hertz law (Pa; 1 to 1e+13; default 10000000.0)
        poisson: Poisson's ratio (nu_p) (0 to 0.5; default 0.22)
        friction: coefficient of friction between grains (mu_p) (0 to 100; default 0.5)
        wall_friction: the same at walls; -1: as between grains (-1 to 100; default -1.0)
        rolling_friction: rolling torque over R* abs(F_n) (0 to 100; default 0.0)
        rolling_model: rolling friction as a constant torque, or as a spring by which a grain rests on a slope (torque, spring; default torque)
        cohesion: attraction of touching grains: none, with the contact area, DMT's pull-off, or JKR's (its neck with law hertz) (none, area, dmt, jkr; default none)
        cohesion_energy: attraction per contact area, cohesion: area (J/m^3; 0 to 1e+12; default 0.0)
        surface_energy: work of adhesion, cohesion: dmt or jkr (J/m^2; 0 to 1e+06; default 0.0)
        clip: dashpots never pull (the reference program lets them) (default False)
        normal_torque: normal forces exert torques on grains too; off: eq. 5 as printed (default True)
        gyroscopic: keep angular momentum (eq. 3); off: as the reference program (default True)
        clump_contacts: spheres of two clumps that touch at once: share one contact's stiffness, or each its own (shared, each; default shared)
        time_step: time step (s; 1e-15 to 1000; default 5e-06)
        gravity: gravity along -z (m/s^2; 0 to 1e+06; default 9.81)
        fluid_density: density of the fluid around, for buoyancy (eq. 10) (kg/m^3; 0 to 1e+06; default 1000.0)
        fluid_viscosity: viscosity for drag and torque of a fluid at rest; 0: none, as published (Pa s; 0 to 1e+06; default 0.0)
        sphere_drag: drag of spheres: the law of all forms, or the standard curve of spheres (form, standard; default form)
        hindrance: drag grows with the grains around, by the porosity at its height (Di Felice) (default False)
        added_mass: fluid that a grain moves along, over its volume; 0.5 of a sphere (0 to 10; default 0.0)
        wet_restitution: restitution falls with the impact's Stokes number (Gondret) (default False)
        rounding: radius that edges of surfaces get; the surface shrinks so that its volume stays (m; 0 to 1e+06; default 0.0)
        skin: margin of neighbour lists over a grain's radius: speed only (0.001 to 10; default 0.1)
        verify: every so many steps contacts are compared with a search without warm start; 0: never (0 to 1e+09; default 0)
        generator: grains begin on a cubic lattice (published), a close-packed one (reference program), or in rows as dense as their spheres allow (cubic, hcp, shelf; default cubic)
        spacing: of that lattice (h_g); 0: the published one of the case, or what the grains need (m; 0 to 1e+06; default 0.0)
        fill_low: grains begin above this share of the height (0 to 1; default 0.6)
        fill_high: and below this (0 to 1; default 1.0)
        first_low: the same of the first fill; -1: as all (reference: 0.1) (-1 to 1; default -1.0)
        first_high: and below this (reference: 0.9) (-1 to 1; default -1.0)
        initial_speed: downwards (u_init); a tenth of it sideways at random (m/s; 0 to 1000; default 1.0)
        random_turn: grains begin with random orientations; off: as stored (reference program) (default True)
        shake_amplitude: of shaking in x (A_s); 0: none (m; 0 to 1000; default 0.0003)
        shake_period: of shaking (T_s) (s; 1e-09 to 1e+06; default 0.025)
        shaking_time: of shaking after the last grain was made (t_s) (s; 0 to 1e+06; default 1.0)
        shake_from_start: shake while grains are made, too (default True)
        damping: velocities keep this share a second at the end (c_d) (1e-300 to 1; default 0.001)
        rule: when the bed is at rest (height, speed, either; default height)
        height_change: of the mean height in check_time; for grains below 1 mm a hundredth of their size (m; 0 to 1e+06; default 1e-05)
        check_time: between two checks of it (s; 1e-12 to 1e+06; default 0.01)
        still_speed: of the fastest grain; for grains below 1 mm their size a second or less (m/s; 0 to 1e+06; default 0.001)
        max_steps: stop after so many time steps, finished or not; 0: never (at least 0; default 0)
        max_damping_time: give up when the bed is not at rest by then (s; 0 to 1e+09; default 20.0)
        wall: walls that move, are pressed or open: NAME FILE UNIT (a surface), or floor, lid, sides, left, right, front, back of the domain; then move X,Y,Zmm/s, vibrate X,Y,Zmm 20ms, axis X,Y,Z, about X,Y,Zmm, rotate 30rpm, swing 5deg 1s, table FILE, press X,Y,Z, area 1m^2 (no default)
        outlet: half-spaces whose grains leave and are counted: z<-10mm (no default)
        wall_forces: force and torque on all walls over time, also where none moves: walls.csv (default False)
        stages: stages that load a bed, one after the other; between walls: NAME (its motion runs), NAME=10kPa, NAME=5N, NAME=1mm/s (where it presses), open NAME, hold; then until rest, time T, stress P, way D or mass M. In domain cell: isotropic P, oedometer P, triaxial P RATE, shear RATE [P], hold, or x=, y=, z=, xz= (10kPa a pressure, 0.1/s a rate, above 0 pressing); then until rest, strain E, stress P or time T (no default)
        load_rate: rate of strain at which a pressure is approached, at most (1/s; 1e-09 to 1e+09; default 1.0)
        load_tolerance: share of a pressure within which it is reached (1e-09 to 1; default 0.01)
        load_rest: a loaded bed rests when the mean force on a grain over that of a contact is below this (1e-12 to 1; default 0.001)
        max_load_time: give up when a stage has not come to its end by then (s; 0 to 1e+09; default 20.0)
        energy: record the work of all forces by kind: load.csv, energy_book.svg (default False)
        layer: slices of the porosity profile (h_p); for grains below 1 mm a tenth of their size (m; 1e-12 to 1e+06; default 0.001)
        cut: the bed ends where the porosity is this (n cut-off) (0 to 1; default 0.5)
        trim: left out at both ends of the bed (h_pd); -1: 31.5 mm in the periodic box, else 0 (m; -1 to 1e+06; default -1.0)
        series_time: between rows of series.csv (s; 1e-12 to 1e+09; default 0.01)
        frame_time: between frames for ParaView; 0: none (s; 0 to 1e+09; default 0.0)
        checkpoint_time: between checkpoints, by the clock (s; 0 to 1e+09; default 120.0)
        force: replace an earlier run in the output folder, once the new one has succeeded (default False)
        resume: go on with the run in this folder (no default)
    """
    return _growth.pack(**given(locals()))


@spelt
def porosity(
        run: Path | Assembly,
        *,
        bed: str = '',
        floor: Quantity = 0.0,
        method: str = 'exact',
        layer: Quantity = 0.0,
        cut: float = 0.5,
        trim: Quantity = 0.0,
        at_slice: bool = False,
        core: float = 0.0,
        gap: Quantity = 0.0,
        local: bool = False,
        rings: int = 0,
        pores: int = 0,
        fields: Quantity = 0.0,
        chains: bool = False,
        columns: str = '',
        diameter: Quantity = 0.0,
) -> Porosity:
    """Profile and bulk porosity of a run's folder, a state file, spheres of another program, or an assembly.

    `bed` is what holds the grains ("cylinder:52mm"); a run of `clast pack` knows its own.

    Keywords (None: the default; a number is SI, a text has its unit):
        bed: container: cylinder:RADIUS[,X,Y], box:X0,Y0,X1,Y1, periodic:X0,Y0,X1,Y1 (x and y), periodic:X0,Y0,Z0,X1,Y1,Z1[,SHIFT] (all directions; images above lie farther along x by SHIFT) or mesh:FILE,UNIT (m where the grains' lengths have no unit); none: the run's (no default)
        floor: height of the bottom, with --bed (as 5mm) (default 0)
        method: what a grain fills: its true shape, or the sphere of its volume (published) (exact, spheres; default exact)
        layer: height of a slice (as 1mm); 0: 1 mm as published, or a tenth of the mean diameter where that is below 1 mm, or of a run without unit, whose lengths are bare numbers here too (default 0)
        cut: the bed ends where the porosity rises through this (n_cut) (0 to 1; default 0.5)
        trim: left out at both ends (h_pd; published for periodic beds: 31.5mm) (default 0)
        at_slice: end the bed with a slice, as the reference program; else between slices (default False)
        core: porosity without the side walls' share too: of what is farther from them than this many grain sizes (2 to 3 where the bed is wide enough); 0: not (0 to 1e+06; default 0.0)
        gap: grains this close touch (as 10um), where the run does not know its contacts (default 0)
        local: porosity around each grain too, by radical Voronoi cells of equal-volume spheres (default False)
        rings: porosity over the radius of a cylinder too, in this many rings (0 to 100000; default 0)
        pores: sizes of pores too, from this many quasi-random points of the bed (0 to 1e+08; default 0)
        fields: coarse-grained density, velocity and stress too (fields.vti, .csv), by a Gaussian this wide (its standard deviation, as 3mm), in cells as wide; 0: not (default 0)
        chains: force chains too (chains.vtp, .csv, .svg), of runs that know their forces (default False)
        columns: spheres: what the file's columns are, all of them, such as id,x,y,z,d (x, y, z, r or d; others and - are passed over); none: by their names (no default)
        diameter: spheres: diameter of all, instead of the file's; 0: the file's (default 0)
    """
    return _beds.porosity(**given(locals()))


@spelt
def predict(
        flatness: Moments | None = None,
        elongation: Moments | None = None,
        *,
        table: Any = None,
        model: Model | Fit | Path = 'auto',
        grading: str = 'U1',
        grains: int = 0,
        columns: str = '',
        resamples: int = 500,
        seed: int = 1,
) -> Prediction:
    """Porosity of a bed from its grains' form [Rettinger2022 eqs 17-19, 23, 24], or by a model of one's own.

    Either mean S/I and I/L, each a number, (mean, standard deviation) or "0.65+-0.17", and the number of `grains` behind them; or a
    `table` with a row a grain (a file, a structured array, a DataFrame, a dictionary of columns), with flatness and elongation or L, I
    and S. "auto" takes the model of a mixture where forms vary, else the one of a single form; `grading` names the size distribution.

    Keywords (None: the default; a number is SI, a text has its unit):
        flatness: mean S/I, or mean and standard deviation as in 0.65+-0.17 (no default)
        elongation: mean I/L, or mean and standard deviation (no default)
        model: auto, single, mixture, or a model file of clast fit; auto: mixture where the forms vary, else single (default auto)
        grading: published size distribution that the bed's resembles, up to scale (U1, U7, B50; default U1)
        grains: number of grains behind the means (0: unknown, no sampling error) (0 to 1e+12; default 0)
        columns: columns of the table: flatness,elongation or L,I,S (else known by their names) (no default)
        resamples: bootstrap resamples of the grains for the sampling error (0 to 1e+06; default 500)
        seed: random numbers (at least 0; default 1)
    """
    return _models.predict(**given(locals()))


@spelt
def predict_beds(
        table: Any,
        *,
        model: Model | Fit | Path = 'auto',
        grading: str = 'U1',
        columns: str = '',
) -> Table:
    """One porosity a row, each a bed of that one form (`clast predict --each`) or of the columns that a model of one's own takes.

    Columns row (from 1), porosity, standard_error, in_range; rows that cannot be used are missing. Porosity and
    standard_error are NaN where the model gives a porosity outside 0 to 1.

    Keywords (None: the default; a number is SI, a text has its unit):
        model: auto, single, mixture, or a model file of clast fit; auto: mixture where the forms vary, else single (default auto)
        grading: published size distribution that the bed's resembles, up to scale (U1, U7, B50; default U1)
        columns: columns of the table: flatness,elongation or L,I,S (else known by their names) (no default)
    """
    return _models.predict_beds(**given(locals()))


@spelt
def render(
        run: Path | Assembly,
        *,
        progress: Progress = None,
        width: int | None = None,
        height: int | None = None,
        samples: int | None = None,
        ambient_rays: int | None = None,
        projection: Literal["orthographic", "perspective"] | None = None,
        up: Literal["x", "y", "z"] | None = None,
        azimuth: Quantity | None = None,
        elevation: Quantity | None = None,
        field_of_view: Quantity | None = None,
        zoom: float | None = None,
        colour: Literal["auto", "single", "size", "order", "shape"] | None = None,
        tint: Text | None = None,
        scale: Literal["auto", "linear", "log"] | None = None,
        shading: Literal["smooth", "flat"] | None = None,
        background: Literal["white", "transparent", "black"] | None = None,
        ground: bool | None = None,
        cut: Literal["none", "x", "y", "z", "view"] | None = None,
        cut_position: float | None = None,
        colour_bar: bool | None = None,
        scale_bar: bool | None = None,
        unit: Text | None = None,
        sun_azimuth: Quantity | None = None,
        sun_elevation: Quantity | None = None,
        sun_radius: Quantity | None = None,
        ambient: float | None = None,
        seed: int | None = None,
) -> Picture:
    """Draws the grains of a run's folder, a state file or an assembly; keywords are the keys of `clast render` (width=640).

    Keywords (None: the default; a number is SI, a text has its unit):
        width: pixels (64 to 16384; default 1600)
        height: pixels (64 to 16384; default 1200)
        samples: camera rays a pixel (1 to 4096; default 16)
        ambient_rays: sky rays a camera ray (1 to 256; default 1)
        projection: how depth is shown (orthographic, perspective; default orthographic)
        up: axis that points up (x, y, z; default z)
        azimuth: of the viewer about the up axis (rad; -20 to 20; default -0.9599310885968813)
        elevation: of the viewer above the horizontal (rad; -1.5708 to 1.5708; default 0.4363323129985824)
        field_of_view: perspective: angle of the picture's height (rad; 0.01 to 2.5; default 0.4363323129985824)
        zoom: 1: everything just fits (0.001 to 1000; default 1.0)
        colour: what colours mean; auto: size where sizes differ (auto, single, size, order, shape; default auto)
        tint: single colour, #rrggbb (default #c9b79c)
        scale: of the colour bar; auto: log for sizes over a factor 4 (auto, linear, log; default auto)
        shading: smooth rounds facets that meet below 50 degrees (smooth, flat; default smooth)
        background: behind the grains (white, transparent, black; default white)
        ground: shadow on a plane under the grains (default False)
        cut: cut away the half nearer to the viewer: by a plane across this axis (none, x, y, z, view; default none)
        cut_position: position of the cut in the extent along its axis (0 to 1; default 0.5)
        colour_bar: legend of the colours (default True)
        scale_bar: bar of a round length, in perspective at the centre (default True)
        unit: unit of the coordinates where the input has none (um, mm, m) (no default)
        sun_azimuth: of the sun, to the right of the viewer (rad; -3.14159 to 3.14159; default -0.6981317007977318)
        sun_elevation: of the sun above the line of sight (rad; -1.5708 to 1.5708; default 0.7853981633974483)
        sun_radius: half-angle of the sun's disc: softness of shadows (rad; 0 to 1; default 0.05235987755982989)
        ambient: share of the light from the sky (0 to 1; default 0.45)
        seed: of the samples' shifts (at least 0; default 1)
    """
    return _views.render(**given(locals()))


@spelt
def report(
        *runs: Path,
        output: Path,
        title: Text | None = None,
        rows: int | None = None,
        view: bool | None = None,
        triangles: int | None = None,
        picture_mb: int | None = None,
) -> None:
    """Writes one offline page of run folders; keywords are the keys of `clast report` (title="Ash", rows=50).

    Keywords (None: the default; a number is SI, a text has its unit):
        title: title of the page; made from the runs' names when not given (no default)
        rows: rows shown of each table (1 to 1e+06; default 12)
        view: interactive 3-D view of each run with a state.h5 (default True)
        triangles: triangles of one 3-D view; grains are simplified to fit (1000 to 1e+08; default 400000)
        picture_mb: most megabytes of pictures of one run (0 to 10000; default 32)
    """
    return _views.report(*runs, **given(locals(), 'runs'))


@spelt
def grain_statistics(
        table: Any,
        *,
        columns: str = '',
        resamples: int = 2000,
        seed: int = 1,
) -> GrainStatistics:
    """Statistics of a table with a row a grain: a file, a structured array, a DataFrame, a dictionary of columns.

    Keywords (None: the default; a number is SI, a text has its unit):
        columns: table: columns of flatness,elongation or of L,I,S; none: by their names (no default)
        resamples: statistics: bootstrap resamples for the intervals (0 to 1e+06; default 2000)
        seed: statistics: random numbers of the resamples (at least 0; default 1)
    """
    return _grains.grain_statistics(**given(locals()))


@spelt
def shape(
        path: Path,
        *,
        axes: str = 'ellipsoid',
        hull: bool = False,
) -> Shape:
    """Size and form of a file's grain, lengths in the file's own unit.

    Keywords (None: the default; a number is SI, a text has its unit):
        axes: definition of L, I and S behind D and the form factors (ellipsoid, box, fitted, feret, principal; default ellipsoid)
        hull: measure the convex hull (as packings use it), not the surface (default False)
    """
    return _mesh.shape(**given(locals()))


@spelt
def shapes(
        *files: Path,
        axes: str = 'ellipsoid',
        hull: bool = False,
        unit: str = '',
        kind: str = 'auto',
        degree: int = -1,
        level: int = 5,
        spacing: float = 0.0,
        voxels: Any = None,
        voxel_type: str = 'u8',
        big_endian: bool = False,
        skip: int = 0,
        voxel_edge: Any = None,
        dataset: str = '',
        threshold: float | None = None,
        least_voxels: int = 1,
        columns: str = '',
        surfaces: Path | None = None,
        progress: Progress = None,
) -> Grains:
    """Measures every grain of many files, in parallel: surfaces, series of harmonics, volumes of labels or grey values, points, tables.

    What cannot be measured is listed in `faults` and warned of, the others are measured. `unit` is that of files that do not say theirs; where none says one,
    lengths are those of the files.
    Ctrl-C ends it between files; nothing is kept but surfaces written by then.

    Keywords (None: the default; a number is SI, a text has its unit):
        axes: definition of L, I and S behind D and the form factors (ellipsoid, box, fitted, feret, principal; default ellipsoid)
        hull: measure the convex hull (as packings use it), not the surface (default False)
        unit: unit of coordinates (mm, um, ...) in files that do not say theirs: results are then SI; none: model units (no default)
        kind: what files hold; auto: by name and content (auto, surface, series, voxels, points, table, clump; default auto)
        degree: series: terms up to this degree; -1: all (-1 to 256; default -1)
        level: series: surface of 20 x 4^level triangles for calipers and boxes (0 to 8; default 5)
        spacing: points: grid they were sampled on, in their unit, for a surface; 0: their convex hull (at least 0; default 0.0)
        voxels: volume without a header: its sizes NX,NY,NZ, x fastest (no default)
        voxel_type: type of its values (u8, i8, u16, i16, u32, i32, f32, f64; default u8)
        big_endian: its values have their high byte first (default False)
        skip: bytes before its values (0 to 2.14748e+09; default 0)
        voxel_edge: volume: edges of a voxel, A or A,B,C along x, y, z; none: the file's, or 1 (no default)
        dataset: volume in an HDF5 file: name of the array [z][y][x] (no default)
        threshold: volume: grains are the connected parts above this grey value, their surfaces its level (of a mask of two values: smoothed, as of labels); none: values are labels, 0 outside (no default)
        least_voxels: volume: grains of fewer voxels are left out (1 to 2.14748e+09; default 1)
        columns: table: columns of flatness,elongation or of L,I,S; none: by their names (no default)
        surfaces: write each grain's surface (or hull) as PLY into this folder (no default)
    """
    return _grains.shapes(*files, **given(locals(), 'files'))


@spelt
def study(
        *,
        output: Path,
        run: str,
        vary: Any = None,
        fix: Any = None,
        jobs: int = 0,
        progress: Progress = None,
        config: Text | None = None,
        argument: Texts | None = None,
        design: Literal["grid", "zip"] | None = None,
        table: Text | None = None,
        seeds: int | None = None,
        seed: int | None = None,
        keep: Texts | None = None,
        shard: Text | None = None,
) -> Study:
    """Runs a command for every combination of what varies: study(run="fill", argument="grain.stl", vary="spheres = 5|9", output="out").

    `vary` and `fix` are texts as in YAML, lists of them, or dictionaries of values as other calls take them: vary={"spheres": [5, 9]}.
    Runs are processes of the command `clast`, `jobs` at once (0: one a core). The same call goes on where it was stopped; runs that failed
    are tried again.

    Keywords (None: the default; a number is SI, a text has its unit):
        run: command to run: aggregate, decompose, fill, ... (no default)
        vary: key=a|b|c: values that the runs take (no default)
        fix: key=value that all runs share (no default)
        config: YAML configuration that all runs share (no default)
        argument: argument that all runs share, such as an input file (no default)
        design: values of several vary: all combinations, or first with first, second with second (grid, zip; default grid)
        table: CSV with a run a row, a key a column (no default)
        seeds: realisations of each (1 to 1e+06; default 1)
        seed: seed of the first realisation (-1: that of the configuration, or 1), then one more each (at least -1; default -1)
        keep: result to tabulate, a.b for b within a; none: every number but those of longer lists (no default)
        shard: K/N: do every N-th run from the K-th, for job arrays (no default)
    """
    return _studies.study(**given(locals()))
