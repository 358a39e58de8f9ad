"""Structs, named values, prototypes and keys of libclast: written by tools/make_python.py, do not edit."""
from __future__ import annotations

from ctypes import (POINTER, Structure, c_bool, c_char, c_char_p, c_double, c_float, c_int, c_int32, c_int64, c_size_t, c_uint8,
                    c_uint32, c_uint64, c_void_p)
from typing import Any

__all__ = ["FOLDERS", "KEYS", "PROTOTYPES", "SIZES", "STUDIED", "TABLES", "VALUES", "VERSION"]

_ = (c_char, c_float, c_uint32)

VERSION = '0.2.0'


class clast_population(Structure):
    """Particles that stick."""


class clast_collide_cells(Structure):
    """Cells of one step; borrowed."""


class clast_spectrum_config(Structure):
    """clast_spectrum_config."""


class clast_spectrum_start(Structure):
    """A start by a table; borrowed."""


class clast_agglomerate_given(Structure):
    """What particles come with, for clast_agglomerate_idle; {0} of a box."""


class clast_agglomerate_input(Structure):
    """What the particles bring."""


class clast_aggregate_input(Structure):
    """What an aggregation starts from; everything is borrowed for the life of the run."""


class clast_aggregate_saved(Structure):
    """What an aggregation had placed; everything is borrowed."""


class clast_interval(Structure):
    """Mean of repeated values, and the interval that holds the true mean at this level (Student's t)."""


class clast_fit_estimate(Structure):
    """A quantity under the posterior weights."""


class clast_aggregate_fit(Structure):
    """What packing and how many times the list of sizes explain an observation."""


class clast_assembly(Structure):
    """Placed shapes: what aggregates and packings end as."""


class clast_rigid_options(Structure):
    """clast_rigid_options."""


class clast_union_options(Structure):
    """How the volume of overlapping grains is found."""


class clast_union(Structure):
    """The space that the grains fill, and by how much they overlap."""


class clast_period(Structure):
    """A box that repeats: its corner and its periods in x, y and z, 0 for none [m]; all are finite, periods not negative (else CLAST_E_ARGUMENT)."""


class clast_overlaps(Structure):
    """How many grains overlap, and by how much."""


class clast_printable_config(Structure):
    """How an assembly becomes one body that can be printed."""


class clast_printable_report(Structure):
    """What was made."""


class clast_envelope(Structure):
    """A volume with its uncertainty."""


class clast_envelope_options(Structure):
    """clast_envelope_options."""


class clast_fractal(Structure):
    """A power law N = k (R / a)^D fitted to an assembly."""


class clast_extent(Structure):
    """How far an assembly reaches."""


class clast_series(Structure):
    """One set of values; arrays are borrowed."""


class clast_axis(Structure):
    """clast_axis."""


class clast_heat(Structure):
    """A rectangle of values for a heat map, row-major from low y; borrowed."""


class clast_note(Structure):
    """A word in the plot, centred at a point of the axes."""


class clast_chart(Structure):
    """clast_chart."""


class clast_cloud(Structure):
    """Points in one, two or three dimensions, with optional properties; arrays may be borrowed by the functions that read them."""


class clast_points_snapshot(Structure):
    """Which of a file's snapshots was read."""


class clast_points_options(Structure):
    """{0} is valid: the first snapshot."""


class clast_domain_map_functions(Structure):
    """A caller's map of a domain onto the unit cube."""


class clast_domain(Structure):
    """A known domain; never taken from the sample's own least and greatest coordinates."""


class clast_discrepancy(Structure):
    """Statistics of one discrepancy."""


class clast_henze_zirkler(Structure):
    """Henze and Zirkler's test of normality of the probit scores Phi^-1(u)."""


class clast_pearson(Structure):
    """Correlation of each pair of coordinates (01, 02, 12), Student's t, Bonferroni over the pairs."""


class clast_spacing(Structure):
    """Mean distance to the nearest neighbour, across periodic faces, over that of uniform points: > 1 is regular (a lattice: 2 in 2-D, 1.8 in 3-D), < 1 clustered or varying."""


class clast_boundary_score(Structure):
    """Distance-to-boundary score: mean absolute difference between the distribution of depths and its law."""


class clast_decompose_config(Structure):
    """clast_decompose_config."""


class clast_vote(Structure):
    """One of the five tests."""


class clast_uniformity(Structure):
    """All five, with the vote."""


class clast_uniformity_config(Structure):
    """How the tests vote."""


class clast_pass(Structure):
    """clast_pass."""


class clast_cells(Structure):
    """Cells."""


class clast_within_cells(Structure):
    """What pairs show within the cells, whose points the cells take as uniform."""


class clast_decompose_parts(Structure):
    """What clast_decompose_sizes makes."""


class clast_dem_config(Structure):
    """Physics of a run."""


class clast_dem_grain(Structure):
    """A grain to add: shape scaled, rotated, translated."""


class clast_dem_drive(Structure):
    """What acts on all grains for a while."""


class clast_dem_verification(Structure):
    """Remembered contacts beside cold ones (`verify`): pairs of bodies of which one at least is no sphere, touching or listed."""


class clast_dem_measures(Structure):
    """Sums over all grains."""


class clast_dem_energy(Structure):
    """Where the energy has gone since clast_dem_begin_energy [J]: put_in = what is held + what is lost + steps + rest."""


class clast_dem_wall_motion(Structure):
    """How a wall moves by itself, as a function of its own time t, which runs while it is driven (clast_dem_drive_wall): a point x0 goes to p + d(t) + R (x0 - p), R the rotation about `axis` by d = velocity t + amplitude sin(2 pi t / period) + table, angle = rate t + swing sin(2 pi t / period) + table."""


class clast_dem_wall(Structure):
    """A wall as it is now, and what grains do to it; in the order in which walls are numbered: floor, lid, left (low x), right, front (low y), back, or the cylinder, those that the domain has; then surfaces in the order in which they were added."""


class clast_dem_contact(Structure):
    """How two materials touch: what of the configuration may differ from pair to pair."""


class clast_dem_cell(Structure):
    """The periodic cell as it is now; zeros in other domains."""


class clast_dem_load(Structure):
    """What a bed carries."""


class clast_scene_bed(Structure):
    """Case P1 and its kin: grains of 63 gravel forms (152 points on a dented ellipsoid), D log-uniform in 5.6 to 8 mm, random form and orientation, on a loose lattice in a box of width x width, periodic in x and y, over a floor, in water; the published law and shaking act."""


class clast_evolve_input(Structure):
    """What an evolution starts from; everything is borrowed for its life."""


class clast_evolve_source(Structure):
    """What a configuration names, loaded."""


class clast_text_list(Structure):
    """clast_text_list."""


class clast_f64_list(Structure):
    """clast_f64_list."""


class clast_field(Structure):
    """clast_field."""


class clast_idle(Structure):
    """Fields that a run would not look at; a list of these ends with {0}."""


class clast_fill_config(Structure):
    """Settings; lengths in the unit of the mesh."""


class clast_fill_report(Structure):
    """What a sphere set is worth, all errors against the solid bounded by the mesh."""


class clast_form_factor_entry(Structure):
    """What is known about one form factor; static texts."""


class clast_form_law(Structure):
    """clast_form_law."""


class clast_form_law_moments(Structure):
    """Means and deviations after the cut, in closed form: what a packing really holds."""


class clast_left_out(Structure):
    """clast_left_out."""


class clast_form_set(Structure):
    """clast_form_set."""


class clast_sizes(Structure):
    """Sizes as they came: sizes or bins with counts."""


class clast_curve(Structure):
    """Sieve curve: the mass between neighbouring sieves."""


class clast_curve_case(Structure):
    """A published laboratory mixture of Rhine gravel."""


class clast_grading_sample(Structure):
    """Grains that were made; borrowed."""


class clast_grading_match(Structure):
    """Wanted against achieved, in a few numbers."""


class clast_grading_list(Structure):
    """What a grading's list held: how its rows are counted or weighed."""


class clast_axes(Structure):
    """L, I, S by one definition and their unit directions ([0] belongs to L)."""


class clast_grain(Structure):
    """Measures of a grain; plain numbers, nothing to free."""


class clast_grain_record(Structure):
    """clast_grain_record."""


class clast_grain_fault(Structure):
    """Why a grain is not there: one line for the person at the terminal."""


class clast_grains(Structure):
    """clast_grains."""


class clast_harmonics(Structure):
    """A star-shaped grain as a series of spherical harmonics about a point inside it: r(theta, phi) = sum_n sum_{0 <= m <= n} P_nm(cos theta) (a_nm cos m phi + b_nm sin m phi) P_nm: associated Legendre functions with the Condon-Shortley phase, normalised such that P_nm e^(i m phi) are orthonormal on the sphere."""


class clast_synthesize_config(Structure):
    """clast_synthesize_config."""


class clast_synthesize_report(Structure):
    """What came out, measured on the mesh."""


class clast_collider(Structure):
    """A particle or an aggregate as kernels see it."""


class clast_medium(Structure):
    """What the particles move in, and constants of the model kernels."""


class clast_kernel_info(Structure):
    """One row of the table that feeds --help, the documents and the checks."""


class clast_kernel_range(Structure):
    """One condition: `quantity` of a pair lies in [low, high]."""


class clast_range_use(Structure):
    """What was held against the table: particles, collisions or rates."""


class clast_range_report(Structure):
    """A run against the table."""


class clast_sticking(Structure):
    """A law and what it needs; the other members may be 0."""


class clast_impact(Structure):
    """Two particles that meet."""


class clast_site(Structure):
    """A piece of work that lies somewhere, for a partition."""


class clast_comm(Structure):
    """One rank's view of all."""


class clast_mesh(Structure):
    """A triangle surface: vertices in model units or metres, triangles counter-clockwise from outside."""


class clast_mass(Structure):
    """Volume, centroid and inertia of a closed surface at unit density."""


class clast_hit(Structure):
    """Where a ray meets a triangle."""


class clast_mesh_read_report(Structure):
    """What a reader found and what it left out."""


class clast_mesh_write_options(Structure):
    """clast_mesh_write_options."""


class clast_mesh_part(Structure):
    """A connected piece of a surface: triangles joined by shared edges."""


class clast_mesh_fault(Structure):
    """What is wrong, for the person at the terminal."""


class clast_mesh_check_result(Structure):
    """Findings of clast_mesh_check."""


class clast_mesh_repair_config(Structure):
    """Which steps clast_mesh_repair takes, in this order."""


class clast_mesh_repair_report(Structure):
    """What clast_mesh_repair changed."""


class clast_mesh_deviation(Structure):
    """How far two surfaces are apart."""


class clast_mesh_simplify_report(Structure):
    """What clast_mesh_simplify did."""


class clast_pack_config(Structure):
    """clast_pack_config."""


class clast_pack_wall(Structure):
    """A wall of option `wall`."""


class clast_pack_input(Structure):
    """What a packing is made of, loaded."""


class clast_pack_ranks(Structure):
    """A bed over ranks: what went between them."""


class clast_pack_hull(Structure):
    """What a packing ended as."""


class clast_pack_source(Structure):
    """What a configuration names, loaded."""


class clast_pairs_config(Structure):
    """clast_pairs_config."""


class clast_estimate(Structure):
    """A number with its 95 % interval."""


class clast_pair_integral(Structure):
    """Integral of f^2 over the domain, f the probability density of a point [1/m^d]: of n points drawn from f, n (n - 1) / 2 times it is the expected number of pairs per volume of encounter."""


class clast_bed(Structure):
    """The container that a porosity refers to; z points up."""


class clast_porosity_options(Structure):
    """clast_porosity_options."""


class clast_porosity_bulk(Structure):
    """clast_porosity_bulk."""


class clast_bed_walls(Structure):
    """Side walls beside the size of the grains: grains cannot lie as close at a wall, so a narrow bed is looser (docs/theory/porosity.md)."""


class clast_bed_beyond(Structure):
    """What reaches beyond the sides of a bed: slices count grains whole, so that a bed which is smaller than what holds them has too low a porosity."""


class clast_porosity_core(Structure):
    """clast_porosity_core."""


class clast_radial_options(Structure):
    """clast_radial_options."""


class clast_pore_options(Structure):
    """clast_pore_options."""


class clast_mean(Structure):
    """Mean of a few values and how well it is known."""


class clast_bed_known(Structure):
    """A bed that is measured, and what is known of it; all is borrowed, and may be NULL but for bed."""


class clast_bed_options(Structure):
    """What is measured beside profile, bulk, side walls, overlaps and fabric; 0: not."""


class clast_form_inputs(Structure):
    """What is known about the grains of a bed."""


class clast_model_term(Structure):
    """clast_model_term."""


class clast_model_range(Structure):
    """A range that the model's data covered."""


class clast_porosity_model(Structure):
    """porosity = intercept + sum coefficient feature."""


class clast_prediction(Structure):
    """clast_prediction."""


class clast_predict_given(Structure):
    """What a prediction is asked for with, of which some options look at none."""


class clast_porosity_fit_config(Structure):
    """clast_porosity_fit_config."""


class clast_fit_note(Structure):
    """A line that people should know of a fit, spelt as `clast fit` prints it on the error stream."""


class clast_image(Structure):
    """Pixels in memory, row by row from the top, straight (not premultiplied) sRGB and alpha."""


class clast_render_config(Structure):
    """What the picture shows; see clast_render_fields for ranges and defaults."""


class clast_report_config(Structure):
    """clast_report_config."""


class clast_fluid(Structure):
    """What a body falls through, and how it is pulled."""


class clast_drag(Structure):
    """Drag corrections of a body's form; 1 and 1 for a sphere."""


class clast_settling(Structure):
    """How a body settles."""


class clast_porous(Structure):
    """What air flows through."""


class clast_spheres(Structure):
    """Spheres in a shape's frame: a filling, a clump, or a sphere composite."""


class clast_part(Structure):
    """A convex part of a rigid grain, in the shape's frame."""


class clast_parts(Structure):
    """clast_parts."""


class clast_material(Structure):
    """What a shape's own material weighs."""


class clast_shape(Structure):
    """A kind of grain in its own frame: centroid at the origin, one shape shared by many grains."""


class clast_named_spheres(Structure):
    """Spheres with the name they are kept under."""


class clast_state(Structure):
    """What a state file holds; every part may be absent."""


class clast_packing_options(Structure):
    """How to read a packing of spheres; {0} guesses everything."""


class clast_packing_frame(Structure):
    """Step and box of a packing, as LAMMPS's files have them."""


class clast_packing_report(Structure):
    """What a packing's file gave beside its grains."""


class clast_export_options(Structure):
    """{0} is valid: format by extension, icospheres as they are (20 triangles), surfaces, by grain."""


class clast_export_report(Structure):
    """What was written."""


class clast_export_given(Structure):
    """What an export is asked for with, of which some options look at none."""


class clast_bootstrap(Structure):
    """How intervals are made: percentiles of statistics of n_resample samples drawn with replacement."""


class clast_sample_summary(Structure):
    """What one column is like."""


class clast_statistics(Structure):
    """Columns against columns, and the axes along which they vary."""


class clast_histogram(Structure):
    """Counts of a sample in equal bins, with the normal law of maximum likelihood beside them."""


class clast_grain_statistics(Structure):
    """clast_grain_statistics."""


class clast_monitor(Structure):
    """How long work talks to its caller: NULL, or callbacks."""


class clast_study_config(Structure):
    """clast_study_config."""


class clast_study_item(Structure):
    """One run as its worker gets it."""


class clast_study_worker(Structure):
    """Who runs."""


class clast_study_report(Structure):
    """clast_study_report."""


class clast_study_outcomes(Structure):
    """What became of the runs of a study."""


class clast_column(Structure):
    """A column: numbers or texts, with a unit ("m", "-", "kg/m^3")."""


class clast_table(Structure):
    """Named columns of one length: what every analysis returns, and what io, plot and fit take."""


class clast_csv_options(Structure):
    """How to read delimited text; {0} guesses everything."""


class clast_csv_report(Structure):
    """What the reader found."""


class clast_voxels(Structure):
    """A volume of labelled bricks: 0 is outside, every other number one grain (or phase)."""


class clast_voxel_label(Structure):
    """One label of a volume."""


class clast_volume(Structure):
    """Values at the centres of n[0] x n[1] x n[2] bricks."""


class clast_volume_options(Structure):
    """What the bytes themselves do not say."""


class clast_points(Structure):
    """Points in the caller's arrays."""


class clast_workspace_policy(Structure):
    """What calls are spared; by default nothing: each call gives what clast_decompose gives."""


class clast_workspace_calls(Structure):
    """What the calls did since the workspace was made."""


class clast_workspace_step(Structure):
    """What one time step of collisions needs beside particles and cells."""


class clast_collide_config(Structure):
    """How particles collide; start from clast_collide_config_default."""


class clast_spectrum(Structure):
    """clast_spectrum."""


class clast_agglomerate_config(Structure):
    """clast_agglomerate_config."""


class clast_agglomeration(Structure):
    """clast_agglomeration."""


class clast_aggregate_params(Structure):
    """clast_aggregate_params."""


class clast_aggregate_result(Structure):
    """An aggregate in numbers, SI."""


class clast_aggregate_config(Structure):
    """All of a run: how the aggregates grow, and the files that it reads and writes."""


class clast_aggregate_source(Structure):
    """Everything that a configuration names, loaded."""


class clast_aggregate_report(Structure):
    """Results of the repeats, in order."""


class clast_structure_options(Structure):
    """clast_structure_options."""


class clast_cloud_columns(Structure):
    """Which columns of a table hold what; an empty list, an empty text or NULL: nothing does."""


class clast_evolve_config(Structure):
    """clast_evolve_config."""


class clast_evolve_result(Structure):
    """An evolution in numbers, SI."""


class clast_grains_options(Structure):
    """clast_grains_options."""


class clast_pack_result(Structure):
    """clast_pack_result."""


class clast_pairs(Structure):
    """clast_pairs."""


class clast_pores(Structure):
    """clast_pores."""


class clast_bed_findings(Structure):
    """Tables without columns, NAN and an n of -1: not asked for, or not known."""


class clast_fit_data(Structure):
    """Beds with their candidate features."""


class clast_porosity_fit(Structure):
    """clast_porosity_fit."""


class clast_decomposition(Structure):
    """clast_decomposition."""


clast_population._fields_ = [
    ('n', c_int64),
    ('dimension', c_int32),
    ('x', POINTER(c_double)),
    ('monomers', POINTER(c_int64)),
    ('radius', POINTER(c_double)),
    ('mass', POINTER(c_double)),
    ('velocity', POINTER(c_double)),
    ('speed_rms', POINTER(c_double)),
    ('owner', POINTER(c_int64)),
    ('weight', POINTER(c_double)),
]
clast_collide_cells._fields_ = [
    ('n', c_int32),
    ('of_particle', POINTER(c_int32)),
    ('volume', POINTER(c_double)),
    ('medium', POINTER(clast_medium)),
    ('events', POINTER(c_double)),
    ('range', POINTER(clast_range_use)),
]
clast_spectrum_config._fields_ = [
    ('solver', c_int32),
    ('initial', c_int32),
    ('concentration', c_double),
    ('initial_mean', c_double),
    ('initial_sd', c_double),
    ('particles', c_int32),
    ('size_min', c_double),
    ('size_max', c_double),
    ('per_octave', c_int32),
    ('breakage_rate', c_double),
    ('breakage_exponent', c_double),
    ('fragments', c_int32),
    ('fragment_exponent', c_double),
    ('source', c_double),
    ('source_size', c_double),
    ('settling_depth', c_double),
    ('tolerance', c_double),
    ('duration', c_double),
    ('n_step', c_int32),
    ('repeats', c_int32),
]
clast_spectrum_start._fields_ = [
    ('n', c_int64),
    ('size', POINTER(c_double)),
    ('number', POINTER(c_double)),
]
clast_agglomerate_given._fields_ = [
    ('n_snapshot', c_int32),
    ('weight', c_bool),
    ('radius', c_bool),
    ('temperature', c_bool),
    ('shear', c_bool),
    ('dissipation', c_bool),
]
clast_agglomerate_input._fields_ = [
    ('snapshot', POINTER(clast_cloud)),
    ('n_snapshot', c_int64),
    ('monomers', POINTER(c_double)),
    ('speed_rms', POINTER(c_double)),
    ('temperature', POINTER(c_double)),
    ('shear', POINTER(c_double)),
    ('dissipation', POINTER(c_double)),
    ('fixed_cell', POINTER(c_double)),
    ('fixed_volume', POINTER(c_double)),
    ('domain', POINTER(clast_domain)),
]
clast_aggregate_input._fields_ = [
    ('core', POINTER(clast_assembly)),
    ('n_coat', c_int32),
    ('coat', POINTER(clast_assembly)),
    ('sizes', POINTER(clast_sizes)),
]
clast_aggregate_saved._fields_ = [
    ('repeat', c_int32),
    ('placed', POINTER(clast_assembly)),
    ('history', POINTER(clast_table)),
    ('members', POINTER(clast_table)),
]
clast_interval._fields_ = [
    ('n', c_int32),
    ('mean', c_double),
    ('deviation', c_double),
    ('low', c_double),
    ('high', c_double),
]
clast_fit_estimate._fields_ = [
    ('best', c_double),
    ('mean', c_double),
    ('deviation', c_double),
    ('low', c_double),
    ('high', c_double),
]
clast_aggregate_fit._fields_ = [
    ('cone', c_double),
    ('rays', c_int32),
    ('orientations', c_int32),
    ('replicate', c_int32),
    ('trials', clast_fit_estimate),
    ('n_replica', clast_fit_estimate),
    ('model', (clast_fit_estimate * 3)),
    ('porosity', clast_fit_estimate),
    ('observed', (c_double * 3)),
    ('error', (c_double * 3)),
    ('pull', (c_double * 3)),
    ('least', (c_double * 3)),
    ('most', (c_double * 3)),
    ('chi2', c_double),
    ('n_observed', c_int32),
    ('n_choice', c_int32),
    ('n_freedom', c_int32),
    ('p_value', c_double),
    ('verdict', c_int),
    ('packing_edge', c_int32),
    ('replicate_edge', c_int32),
    ('n_level', c_int32),
    ('cut_short', c_bool),
    ('n_run', c_int32),
    ('at_level', c_int32),
    ('words', (c_char * 1024)),
]
clast_assembly._fields_ = [
    ('n_shape', c_int32),
    ('shape', POINTER(clast_shape)),
    ('n_grain', c_int32),
    ('shape_id', POINTER(c_int32)),
    ('position', POINTER(c_double)),
    ('orientation', POINTER(c_double)),
    ('scale', POINTER(c_double)),
    ('density', POINTER(c_double)),
    ('id', POINTER(c_int64)),
    ('n_contact', c_int32),
    ('contact', POINTER(c_int32)),
    ('contact_point', POINTER(c_double)),
    ('unit', (c_char * 16)),
    ('grain_capacity', c_int32),
    ('contact_capacity', c_int32),
    ('no_density', c_bool),
    ('has_ids', c_bool),
]
clast_rigid_options._fields_ = [
    ('hull', c_bool),
    ('faces', c_int32),
]
clast_union_options._fields_ = [
    ('tolerance', c_double),
    ('n_sample', c_int64),
    ('seed', c_uint64),
    ('find_depth', c_bool),
]
clast_union._fields_ = [
    ('volume', c_double),
    ('error', c_double),
    ('sum', c_double),
    ('is_exact', c_bool),
    ('n_overlap', c_int32),
    ('max_overlap', c_double),
    ('max_overlap_share', c_double),
]
clast_period._fields_ = [
    ('low', (c_double * 3)),
    ('length', (c_double * 3)),
]
clast_overlaps._fields_ = [
    ('n', c_int32),
    ('depth', c_double),
    ('share', c_double),
]
clast_printable_config._fields_ = [
    ('neck', c_double),
    ('spacing', c_double),
    ('keep_voids', c_bool),
]
clast_printable_report._fields_ = [
    ('neck', c_double),
    ('spacing', c_double),
    ('smallest_feature', c_double),
    ('resolved', c_bool),
    ('n_part', c_int32),
    ('n_void', c_int32),
    ('void_volume', c_double),
    ('solid_volume', c_double),
    ('volume', c_double),
    ('n_triangle_expected', c_double),
    ('knows_walls', c_bool),
    ('lost', c_double),
]
clast_envelope._fields_ = [
    ('kind', c_int),
    ('volume', c_double),
    ('error', c_double),
    ('low', c_double),
    ('high', c_double),
]
clast_envelope_options._fields_ = [
    ('tolerance', c_double),
    ('n_ray', c_int32),
    ('seed', c_uint64),
    ('length', c_double),
    ('n_cell', c_int32),
]
clast_fractal._fields_ = [
    ('dimension', c_double),
    ('dimension_error', c_double),
    ('prefactor', c_double),
    ('prefactor_error', c_double),
    ('low', c_double),
    ('high', c_double),
    ('n', c_int32),
]
clast_extent._fields_ = [
    ('length', c_double),
    ('axis', ((c_double * 3) * 3)),
    ('width', (c_double * 3)),
]
clast_series._fields_ = [
    ('kind', c_int),
    ('label', c_char_p),
    ('x', POINTER(c_double)),
    ('y', POINTER(c_double)),
    ('low', POINTER(c_double)),
    ('high', POINTER(c_double)),
    ('value', POINTER(c_double)),
    ('n', c_int64),
    ('colour', c_int32),
    ('dashed', c_bool),
    ('width', c_double),
]
clast_axis._fields_ = [
    ('label', c_char_p),
    ('log', c_bool),
    ('low', c_double),
    ('high', c_double),
]
clast_heat._fields_ = [
    ('n_x', c_int32),
    ('n_y', c_int32),
    ('value', POINTER(c_double)),
    ('x_low', c_double),
    ('x_high', c_double),
    ('y_low', c_double),
    ('y_high', c_double),
    ('x_name', POINTER(c_char_p)),
    ('y_name', POINTER(c_char_p)),
    ('is_signed', c_bool),
    ('has_text', c_bool),
]
clast_note._fields_ = [
    ('x', c_double),
    ('y', c_double),
    ('text', c_char_p),
]
clast_chart._fields_ = [
    ('title', c_char_p),
    ('x', clast_axis),
    ('y', clast_axis),
    ('value_axis', clast_axis),
    ('series', POINTER(clast_series)),
    ('n_series', c_int32),
    ('heat', POINTER(clast_heat)),
    ('mark_y', POINTER(c_double)),
    ('mark_label', POINTER(c_char_p)),
    ('n_mark', c_int32),
    ('note', POINTER(clast_note)),
    ('n_note', c_int32),
    ('equal', c_bool),
    ('width', c_double),
    ('height', c_double),
]
clast_cloud._fields_ = [
    ('n', c_int64),
    ('dimension', c_int32),
    ('x', POINTER(c_double)),
    ('radius', POINTER(c_double)),
    ('mass', POINTER(c_double)),
    ('weight', POINTER(c_double)),
    ('velocity', POINTER(c_double)),
    ('variable', POINTER(c_double)),
    ('unread_weight', (c_char * 64)),
]
clast_points_snapshot._fields_ = [
    ('number', c_int64),
    ('n', c_int64),
    ('step', c_int64),
]
clast_points_options._fields_ = [
    ('dataset', c_char_p),
    ('frame', c_int64),
    ('snapshot', POINTER(clast_points_snapshot)),
]
clast_domain_map_functions._fields_ = [
    ('dimension', c_int32),
    ('volume', c_double),
    ('map', c_void_p),
    ('unmap', c_void_p),
    ('context', c_void_p),
]
clast_domain._fields_ = [
    ('kind', c_int),
    ('dimension', c_int32),
    ('low', (c_double * 3)),
    ('high', (c_double * 3)),
    ('radius', c_double),
    ('length', c_double),
    ('is_placed', c_bool),
    ('centre', (c_double * 3)),
    ('axes', ((c_double * 3) * 3)),
    ('user', clast_domain_map_functions),
    ('surface', c_void_p),
]
clast_discrepancy._fields_ = [
    ('U1', c_double),
    ('U2', c_double),
    ('D2', c_double),
    ('A', c_double),
    ('variance', c_double),
    ('A_standard', c_double),
    ('p', c_double),
    ('p_asymptotic', c_double),
    ('p_paper', c_double),
    ('T', c_double),
    ('p_T', c_double),
    ('M', c_double),
    ('xi', c_double),
    ('zeta2', c_double),
]
clast_henze_zirkler._fields_ = [
    ('beta', c_double),
    ('HZ', c_double),
    ('mean', c_double),
    ('variance', c_double),
    ('log_mean', c_double),
    ('log_sd', c_double),
    ('z', c_double),
    ('p', c_double),
    ('p_paper', c_double),
    ('centre', (c_double * 3)),
    ('covariance', ((c_double * 3) * 3)),
]
clast_pearson._fields_ = [
    ('n_pair', c_int32),
    ('r', (c_double * 3)),
    ('p', (c_double * 3)),
    ('p_bonferroni', c_double),
]
clast_spacing._fields_ = [
    ('ratio', c_double),
    ('z', c_double),
    ('p', c_double),
]
clast_boundary_score._fields_ = [
    ('score', c_double),
    ('ideal', c_double),
    ('trapezoid', c_double),
    ('projected', c_double),
    ('projected_axis', (c_double * 3)),
]
clast_decompose_config._fields_ = [
    ('domain', c_char_p),
    ('outside', c_int32),
    ('variant', c_int32),
    ('mesh', c_int32),
    ('events', c_int32),
    ('level', c_double),
    ('votes', c_int32),
    ('tests', c_char_p),
    ('statistic', c_int32),
    ('paper', c_bool),
    ('ghost_samples', c_int32),
    ('crossfit', c_bool),
    ('max_pass', c_int32),
    ('lower', c_int32),
    ('strict', c_bool),
    ('beta_dt', c_double),
    ('beta_dt_dimension', c_int32),
    ('tree_level', c_double),
    ('tree_root_level', c_double),
    ('variable_tolerance', c_double),
    ('tree_least', c_int32),
    ('tree_refine', c_bool),
    ('extrapolate', c_bool),
    ('pairs', c_bool),
    ('pairs_radius', c_double),
    ('estimator', c_int32),
    ('seed', c_uint64),
]
clast_vote._fields_ = [
    ('name', c_char_p),
    ('statistic', c_double),
    ('p', c_double),
    ('reject', c_bool),
    ('axis', (c_int32 * 2)),
]
clast_uniformity._fields_ = [
    ('n_test', c_int32),
    ('vote', (clast_vote * 5)),
    ('n_reject', c_int32),
    ('reject', c_bool),
    ('score', c_double),
    ('ideal', c_double),
]
clast_uniformity_config._fields_ = [
    ('level', c_double),
    ('votes', c_int32),
    ('left_out', c_uint32),
    ('liang', c_bool),
    ('paper', c_bool),
]
clast_pass._fields_ = [
    ('nb', (c_int32 * 3)),
    ('n_lambda', c_int32),
    ('lambda_count', c_int32),
    ('lambda', c_double),
    ('n_lower', c_int32),
    ('lower', c_double),
    ('score', c_double),
    ('ideal', c_double),
    ('fallback', c_bool),
]
clast_cells._fields_ = [
    ('n', c_int32),
    ('low', POINTER(c_double)),
    ('high', POINTER(c_double)),
    ('volume', POINTER(c_double)),
    ('count', POINTER(c_int64)),
    ('label', POINTER(c_uint8)),
    ('pass', POINTER(c_uint8)),
    ('weight', POINTER(c_double)),
    ('events', POINTER(c_double)),
    ('of_point', POINTER(c_int32)),
    ('is_box', c_bool),
    ('nb', (c_int32 * 3)),
    ('bin_count', POINTER(c_int32)),
    ('of_bin', POINTER(c_int32)),
    ('key', POINTER(c_uint64)),
    ('group', POINTER(c_int32)),
]
clast_within_cells._fields_ = [
    ('is_structured', c_bool),
    ('cell', c_double),
    ('even', c_double),
    ('radius', c_double),
    ('n_pair', c_int64),
    ('g', c_double),
    ('g_low', c_double),
    ('g_high', c_double),
    ('length', c_double),
]
clast_decompose_parts._fields_ = [
    ('n_size', c_int32),
    ('regular', c_int32),
]
clast_dem_config._fields_ = [
    ('law', c_int32),
    ('contact_scheme', c_int32),
    ('restitution', c_double),
    ('collision_time', c_double),
    ('poisson', c_double),
    ('young', c_double),
    ('friction', c_double),
    ('wall_friction', c_double),
    ('rolling_friction', c_double),
    ('rolling_model', c_int32),
    ('cohesion', c_int32),
    ('cohesion_energy', c_double),
    ('surface_energy', c_double),
    ('clip', c_bool),
    ('normal_torque', c_bool),
    ('gyroscopic', c_bool),
    ('clump_contacts', c_int32),
    ('time_step', c_double),
    ('gravity', c_double),
    ('fluid_density', c_double),
    ('fluid_viscosity', c_double),
    ('sphere_drag', c_int32),
    ('hindrance', c_bool),
    ('added_mass', c_double),
    ('wet_restitution', c_bool),
    ('domain', c_int32),
    ('width', c_double),
    ('depth', c_double),
    ('height', c_double),
    ('floor', c_bool),
    ('lid', c_bool),
    ('rounding', c_double),
    ('skin', c_double),
    ('verify', c_int32),
]
clast_dem_grain._fields_ = [
    ('shape', c_int32),
    ('scale', c_double),
    ('density', c_double),
    ('position', (c_double * 3)),
    ('orientation', (c_double * 4)),
    ('velocity', (c_double * 3)),
    ('angular_velocity', (c_double * 3)),
]
clast_dem_drive._fields_ = [
    ('shake_amplitude', c_double),
    ('shake_period', c_double),
    ('damping', c_double),
]
clast_dem_verification._fields_ = [
    ('n', c_int64),
    ('n_off', c_int64),
    ('n_bad', c_int64),
    ('worst', c_double),
]
clast_dem_measures._fields_ = [
    ('step', c_int64),
    ('time', c_double),
    ('n_grain', c_int32),
    ('mass', c_double),
    ('mean_height', c_double),
    ('top', c_double),
    ('max_speed', c_double),
    ('kinetic_energy', c_double),
    ('potential_energy', c_double),
    ('elastic_energy', c_double),
    ('momentum', (c_double * 3)),
    ('n_listed', c_int64),
    ('n_contact', c_int64),
    ('n_wall_contact', c_int64),
    ('max_overlap', c_double),
    ('coordination', c_double),
    ('n_refresh', c_int64),
    ('verified', clast_dem_verification),
]
clast_dem_energy._fields_ = [
    ('translation', c_double),
    ('rotation', c_double),
    ('normal_springs', c_double),
    ('tangential_springs', c_double),
    ('attraction', c_double),
    ('made', c_double),
    ('gravity', c_double),
    ('shaking', c_double),
    ('cell', c_double),
    ('walls', c_double),
    ('damping', (c_double * 2)),
    ('friction', (c_double * 2)),
    ('rolling', (c_double * 2)),
    ('fluid', c_double),
    ('calming', c_double),
    ('left', c_double),
    ('scheme', c_double),
    ('put_in', c_double),
    ('rest', c_double),
]
clast_dem_wall_motion._fields_ = [
    ('velocity', (c_double * 3)),
    ('amplitude', (c_double * 3)),
    ('period', c_double),
    ('axis', (c_double * 3)),
    ('pivot', (c_double * 3)),
    ('rate', c_double),
    ('swing', c_double),
    ('n', c_int32),
    ('time', POINTER(c_double)),
    ('place', POINTER(c_double)),
]
clast_dem_wall._fields_ = [
    ('is_open', c_bool),
    ('offset', (c_double * 3)),
    ('angle', c_double),
    ('velocity', (c_double * 3)),
    ('omega', (c_double * 3)),
    ('force', (c_double * 3)),
    ('torque', (c_double * 3)),
    ('impulse', (c_double * 3)),
    ('moment', (c_double * 3)),
    ('work', c_double),
    ('n_step', c_int64),
]
clast_dem_contact._fields_ = [
    ('friction', c_double),
    ('rolling_friction', c_double),
    ('restitution', c_double),
    ('collision_time', c_double),
    ('young', (c_double * 2)),
    ('poisson', (c_double * 2)),
]
clast_dem_cell._fields_ = [
    ('side', (c_double * 3)),
    ('rate', (c_double * 3)),
    ('shift', c_double),
    ('shear_rate', c_double),
    ('strain', (c_double * 3)),
    ('shear_strain', c_double),
]
clast_dem_load._fields_ = [
    ('volume', c_double),
    ('solid', c_double),
    ('stress', (c_double * 6)),
    ('kinetic_stress', (c_double * 6)),
    ('modulus', (c_double * 3)),
    ('shear_modulus', c_double),
    ('fabric', (c_double * 6)),
    ('n_contact', c_int64),
    ('n_force', c_int64),
    ('coordination', c_double),
    ('n_rattler', c_int32),
    ('coordination_held', c_double),
    ('unbalanced', c_double),
    ('force_mean', c_double),
    ('force_below', (c_double * 3)),
]
clast_scene_bed._fields_ = [
    ('n', c_int32),
    ('n_vert', c_int32),
    ('width', c_double),
    ('fall', c_double),
]
clast_evolve_input._fields_ = [
    ('n_shape', c_int32),
    ('shape', POINTER(clast_assembly)),
    ('grading', c_void_p),
    ('domain', POINTER(clast_domain)),
    ('release', POINTER(clast_domain)),
    ('points', POINTER(clast_cloud)),
    ('field', POINTER(clast_cloud)),
]
clast_evolve_source._fields_ = [
    ('shape', POINTER(clast_assembly)),
    ('n_shape', c_int32),
    ('grading', c_void_p),
    ('domain', clast_domain),
    ('release', clast_domain),
    ('points', clast_cloud),
    ('field', clast_cloud),
    ('input', clast_evolve_input),
    ('points_words', (c_char * 256)),
]
clast_text_list._fields_ = [
    ('n', c_int32),
    ('item', POINTER(c_char_p)),
]
clast_f64_list._fields_ = [
    ('n', c_int32),
    ('item', POINTER(c_double)),
]
clast_field._fields_ = [
    ('name', c_char_p),
    ('offset', c_size_t),
    ('type', c_int),
    ('value', c_double),
    ('low', c_double),
    ('high', c_double),
    ('unit', c_char_p),
    ('help', c_char_p),
    ('text', c_char_p),
    ('group', c_char_p),
    ('common', c_bool),
]
clast_idle._fields_ = [
    ('is_idle', c_bool),
    ('names', c_char_p),
    ('why', c_char_p),
]
clast_fill_config._fields_ = [
    ('spheres', c_int32),
    ('strategy', c_int32),
    ('filled', c_double),
    ('volume_error', c_double),
    ('centroid_error', c_double),
    ('inertia_error', c_double),
    ('min_radius', c_double),
    ('min_share', c_double),
    ('tolerance', c_double),
    ('candidates', c_int32),
    ('first_at_centre', c_bool),
    ('vertex_subset', c_bool),
    ('max_tries', c_int64),
    ('outer', c_bool),
    ('shrink', c_double),
    ('overlap', c_bool),
    ('protrusion', c_double),
    ('allow_open', c_bool),
    ('seed', c_uint64),
    ('name', c_char_p),
    ('history', c_char_p),
]
clast_fill_report._fields_ = [
    ('n_sphere', c_int32),
    ('n_placed', c_int32),
    ('end', c_int32),
    ('n_open_edge', c_int32),
    ('open_share', c_double),
    ('solid_volume', c_double),
    ('sphere_volume', c_double),
    ('filled_fraction', c_double),
    ('outside_fraction', c_double),
    ('volume_error', c_double),
    ('centroid_error', c_double),
    ('inertia_error', c_double),
    ('max_protrusion', c_double),
    ('n_protruding', c_int32),
    ('max_overlap', c_double),
    ('deviation_mean', c_double),
    ('deviation_max', c_double),
    ('radius_min', c_double),
    ('radius_median', c_double),
    ('radius_max', c_double),
    ('bound', c_double),
    ('n_tested', c_int64),
    ('wall_s', c_double),
]
clast_form_factor_entry._fields_ = [
    ('name', c_char_p),
    ('inverse', c_char_p),
    ('symbol', c_char_p),
    ('label', c_char_p),
    ('formula', c_char_p),
    ('low', c_double),
    ('high', c_double),
    ('source', c_char_p),
]
clast_form_law._fields_ = [
    ('flatness_mean', c_double),
    ('flatness_deviation', c_double),
    ('elongation_mean', c_double),
    ('elongation_deviation', c_double),
    ('low', c_double),
    ('high', c_double),
]
clast_form_law_moments._fields_ = [
    ('flatness_mean', c_double),
    ('flatness_deviation', c_double),
    ('elongation_mean', c_double),
    ('elongation_deviation', c_double),
]
clast_left_out._fields_ = [
    ('row', c_int64),
    ('fault', c_int),
]
clast_form_set._fields_ = [
    ('n', c_int64),
    ('row', POINTER(c_int64)),
    ('flatness', POINTER(c_double)),
    ('elongation', POINTER(c_double)),
    ('size', POINTER(c_double)),
    ('size_name', (c_char * 64)),
    ('size_unit', (c_char * 16)),
    ('is_sieve_size', c_bool),
    ('unread_count', (c_char * 64)),
    ('n_left_out', c_int64),
    ('left_out', POINTER(clast_left_out)),
]
clast_sizes._fields_ = [
    ('n', c_int64),
    ('low', POINTER(c_double)),
    ('high', POINTER(c_double)),
    ('count', POINTER(c_double)),
    ('density', POINTER(c_double)),
]
clast_curve._fields_ = [
    ('n_class', c_int32),
    ('sieve', POINTER(c_double)),
    ('mass', POINTER(c_double)),
]
clast_curve_case._fields_ = [
    ('name', c_char_p),
    ('mass', (c_double * 7)),
    ('porosity', c_double),
    ('deviation', c_double),
    ('spacing', c_double),
]
clast_grading_sample._fields_ = [
    ('n', c_int64),
    ('size', POINTER(c_double)),
    ('volume', POINTER(c_double)),
]
clast_grading_match._fields_ = [
    ('n', c_int64),
    ('distance_mass', c_double),
    ('distance_number', c_double),
    ('distance_curve', c_double),
    ('achieved_d10', c_double),
    ('achieved_d50', c_double),
    ('achieved_d90', c_double),
    ('wanted_d10', c_double),
    ('wanted_d50', c_double),
    ('wanted_d90', c_double),
]
clast_grading_list._fields_ = [
    ('n_row', c_int64),
    ('total', c_double),
    ('column', c_char_p),
    ('ignored', c_char_p),
    ('size', c_char_p),
]
clast_axes._fields_ = [
    ('lis', (c_double * 3)),
    ('direction', ((c_double * 3) * 3)),
]
clast_grain._fields_ = [
    ('volume', c_double),
    ('area', c_double),
    ('pore_volume', c_double),
    ('pore_area', c_double),
    ('centroid', (c_double * 3)),
    ('inertia', ((c_double * 3) * 3)),
    ('moments', (c_double * 3)),
    ('axes', (clast_axes * 5)),
    ('hull_volume', c_double),
    ('hull_area', c_double),
    ('longest', c_double),
    ('shortest', c_double),
    ('sphericity', c_double),
    ('convexity', c_double),
    ('roundness', c_double),
    ('roundness_deviation', c_double),
    ('n_outline', c_int32),
    ('normal_roundness', c_double),
    ('angularity', c_double),
    ('projected_mean', c_double),
    ('projected_least', c_double),
    ('projected_greatest', c_double),
    ('hull_volume_added', c_double),
]
clast_grain_record._fields_ = [
    ('name', c_char_p),
    ('kind', c_int),
    ('has_surface', c_bool),
    ('has_size', c_bool),
    ('n_voxel', c_int64),
    ('is_smoothed', c_bool),
    ('in_metres', c_bool),
    ('mixes_units', c_bool),
    ('unit_m', c_double),
    ('degree', c_int32),
    ('power_last', c_double),
    ('power_cut', c_double),
    ('grain', clast_grain),
]
clast_grain_fault._fields_ = [
    ('status', c_int),
    ('text', c_char_p),
]
clast_grains._fields_ = [
    ('n', c_int64),
    ('record', POINTER(clast_grain_record)),
    ('n_fault', c_int64),
    ('fault', POINTER(clast_grain_fault)),
    ('n_note', c_int64),
    ('note', POINTER(clast_grain_fault)),
]
clast_harmonics._fields_ = [
    ('degree', c_int32),
    ('coefficient', POINTER(c_double)),
]
clast_synthesize_config._fields_ = [
    ('form', clast_form_law),
    ('size', c_double),
    ('measure', c_int32),
    ('rough', c_double),
    ('tolerance', c_double),
    ('decay', c_double),
    ('degrees', c_int32),
    ('faces', c_int32),
    ('seed', c_uint64),
]
clast_synthesize_report._fields_ = [
    ('flatness', c_double),
    ('elongation', c_double),
    ('amplitude', c_double),
    ('normal_roundness', c_double),
    ('angularity', c_double),
    ('volume', c_double),
    ('n_triangle', c_int32),
]
clast_collider._fields_ = [
    ('monomers', c_double),
    ('radius', c_double),
    ('mass', c_double),
    ('velocity', (c_double * 3)),
    ('speed_rms', c_double),
    ('settling_speed', c_double),
]
clast_medium._fields_ = [
    ('temperature', c_double),
    ('viscosity', c_double),
    ('density', c_double),
    ('particle_density', c_double),
    ('mean_free_path', c_double),
    ('shear', c_double),
    ('dissipation', c_double),
    ('shear_constant', c_double),
    ('speed_rms', c_double),
    ('gravity', c_double),
    ('efficiency', c_double),
    ('constant', c_double),
    ('constant_d', c_int32),
    ('additive', c_double),
    ('additive_d', c_int32),
    ('product', c_double),
    ('product_d', c_int32),
    ('settling_law', c_int32),
]
clast_kernel_info._fields_ = [
    ('name', c_char_p),
    ('formula', c_char_p),
    ('source', c_char_p),
    ('needs', c_uint32),
    ('mechanisms', c_uint32),
    ('is_model', c_bool),
]
clast_kernel_range._fields_ = [
    ('owner', c_char_p),
    ('quantity', c_char_p),
    ('low', c_double),
    ('high', c_double),
    ('source', c_char_p),
    ('instead', c_char_p),
]
clast_range_use._fields_ = [
    ('n', c_double),
    ('outside', c_double),
    ('row', c_int32),
    ('value', c_double),
    ('excess', c_double),
]
clast_range_report._fields_ = [
    ('start', clast_range_use),
    ('collisions', clast_range_use),
    ('time', c_double),
]
clast_sticking._fields_ = [
    ('law', c_int32),
    ('film_viscosity', c_double),
    ('film_thickness', c_double),
    ('asperity', c_double),
    ('restitution', c_double),
    ('critical_stokes', c_double),
    ('stokes_exponent', c_double),
    ('adhesion', c_double),
    ('young', c_double),
    ('poisson', c_double),
]
clast_impact._fields_ = [
    ('speed', c_double),
    ('radius', (c_double * 2)),
    ('mass', (c_double * 2)),
    ('curvature', (c_double * 2)),
]
clast_site._fields_ = [
    ('position', (c_double * 3)),
    ('cost', c_double),
    ('number', c_int32),
]
clast_comm._fields_ = [
    ('rank', c_int32),
    ('n_rank', c_int32),
    ('send', c_void_p),
    ('take', c_void_p),
    ('least', c_void_p),
    ('broadcast', c_void_p),
    ('gather', c_void_p),
    ('context', c_void_p),
    ('sum', c_void_p),
    ('exchange', c_void_p),
    ('partition', c_void_p),
]
clast_mesh._fields_ = [
    ('n_vert', c_int32),
    ('n_tri', c_int32),
    ('vert', POINTER(c_double)),
    ('tri', POINTER(c_int32)),
]
clast_mass._fields_ = [
    ('volume', c_double),
    ('centroid', (c_double * 3)),
    ('inertia', ((c_double * 3) * 3)),
]
clast_hit._fields_ = [
    ('t', c_double),
    ('tri', c_int32),
    ('bary', (c_double * 3)),
]
clast_mesh_read_report._fields_ = [
    ('format', c_int),
    ('unit', (c_char * 16)),
    ('is_binary', c_bool),
    ('is_big_endian', c_bool),
    ('n_byte', c_int64),
    ('n_trailing', c_int64),
    ('n_part', c_int32),
    ('n_facet', c_int64),
    ('n_polygon', c_int32),
    ('n_concave', c_int32),
    ('n_crossing', c_int32),
    ('n_short', c_int32),
    ('n_repeated', c_int32),
    ('n_zero_normal', c_int32),
    ('n_wrong_normal', c_int32),
    ('n_ignored', c_int64),
    ('n_warning', c_int32),
    ('warning', ((c_char * 160) * 8)),
]
clast_mesh_write_options._fields_ = [
    ('format', c_int),
    ('unit', c_char_p),
    ('name', c_char_p),
]
clast_mesh_part._fields_ = [
    ('n_triangle', c_int32),
    ('n_open_edge', c_int32),
    ('closed', c_bool),
    ('oriented', c_bool),
    ('manifold', c_bool),
    ('inside_out', c_bool),
    ('genus', c_int32),
    ('depth', c_int32),
    ('outermost', c_int32),
    ('winding', c_int32),
    ('volume', c_double),
    ('area', c_double),
    ('low', (c_double * 3)),
    ('high', (c_double * 3)),
]
clast_mesh_fault._fields_ = [
    ('blocking', c_bool),
    ('code', (c_char * 24)),
    ('text', (c_char * 360)),
]
clast_mesh_check_result._fields_ = [
    ('n_vertex', c_int32),
    ('n_triangle', c_int32),
    ('closed', c_bool),
    ('oriented', c_bool),
    ('manifold', c_bool),
    ('n_edge', c_int32),
    ('n_part', c_int32),
    ('n_doubled', c_int32),
    ('part', POINTER(clast_mesh_part)),
    ('euler', c_int64),
    ('genus', c_int32),
    ('n_open_edge', c_int32),
    ('n_open_loop', c_int32),
    ('n_repeated', c_int32),
    ('largest_hole', c_double),
    ('n_nonmanifold_edge', c_int32),
    ('n_nonmanifold_vertex', c_int32),
    ('n_misoriented_edge', c_int32),
    ('n_inside_out', c_int32),
    ('n_nested', c_int32),
    ('n_flat', c_int32),
    ('n_degenerate', c_int32),
    ('n_duplicate', c_int32),
    ('n_unused_vertex', c_int32),
    ('n_intersection', c_int64),
    ('n_touch', c_int64),
    ('intersection_complete', c_bool),
    ('intersection', (c_int32 * 2)),
    ('n_body', c_int32),
    ('extent', c_double),
    ('volume', c_double),
    ('volume_divergence', c_double),
    ('volume_spread', c_double),
    ('area', c_double),
    ('area_heron', c_double),
    ('hull_volume', c_double),
    ('weld_tolerance', c_double),
    ('n_open_after_weld', c_int32),
    ('n_fault', c_int32),
    ('fault', (clast_mesh_fault * 16)),
]
clast_mesh_repair_config._fields_ = [
    ('weld', c_int32),
    ('weld_tolerance', c_double),
    ('drop', c_bool),
    ('split', c_bool),
    ('split_tolerance', c_double),
    ('loose', c_bool),
    ('orient', c_bool),
    ('fill', c_bool),
    ('fill_size', c_double),
    ('separate', c_bool),
    ('unite', c_bool),
    ('keep', c_int32),
]
clast_mesh_repair_report._fields_ = [
    ('n_merged', c_int32),
    ('weld_distance', c_double),
    ('n_collapsed', c_int32),
    ('n_degenerate', c_int32),
    ('n_duplicate', c_int32),
    ('n_split', c_int32),
    ('n_loose', c_int32),
    ('n_turned', c_int32),
    ('n_conflict', c_int32),
    ('n_hole_filled', c_int32),
    ('n_fill_triangle', c_int32),
    ('n_hole_left', c_int32),
    ('n_separated', c_int32),
    ('n_part_dropped', c_int32),
    ('n_triangle_before', c_int32),
    ('n_triangle_after', c_int32),
    ('volume_before', c_double),
    ('volume_after', c_double),
    ('area_before', c_double),
    ('area_after', c_double),
]
clast_mesh_deviation._fields_ = [
    ('forward', c_double),
    ('backward', c_double),
    ('hausdorff', c_double),
    ('mean', c_double),
    ('n_sample', c_int64),
]
clast_mesh_simplify_report._fields_ = [
    ('n_triangle_before', c_int32),
    ('n_triangle_after', c_int32),
    ('reached', c_bool),
    ('volume_before', c_double),
    ('volume_after', c_double),
    ('volume_drift', c_double),
    ('correction', c_double),
    ('area_before', c_double),
    ('area_after', c_double),
    ('deviation', clast_mesh_deviation),
]
clast_pack_config._fields_ = [
    ('dem', clast_dem_config),
    ('curve', c_char_p),
    ('spread', c_int32),
    ('count', c_int32),
    ('size_meaning', c_int32),
    ('shapes', clast_text_list),
    ('shape_weight', clast_f64_list),
    ('unit', c_char_p),
    ('hull', c_bool),
    ('faces', c_int32),
    ('ellipsoids', c_bool),
    ('form_law', c_bool),
    ('flatness_mean', c_double),
    ('flatness_deviation', c_double),
    ('elongation_mean', c_double),
    ('elongation_deviation', c_double),
    ('density', clast_f64_list),
    ('density_of', c_int32),
    ('density_weight', clast_f64_list),
    ('material', clast_text_list),
    ('contacts', clast_text_list),
    ('mass', c_double),
    ('seed', c_uint64),
    ('start', c_char_p),
    ('start_unit', c_char_p),
    ('start_columns', c_char_p),
    ('start_diameter', c_double),
    ('start_frame', c_int64),
    ('container', c_char_p),
    ('container_unit', c_char_p),
    ('generator', c_int32),
    ('spacing', c_double),
    ('fill_low', c_double),
    ('fill_high', c_double),
    ('first_low', c_double),
    ('first_high', c_double),
    ('initial_speed', c_double),
    ('random_turn', c_bool),
    ('shake_amplitude', c_double),
    ('shake_period', c_double),
    ('shaking_time', c_double),
    ('shake_from_start', c_bool),
    ('damping', c_double),
    ('rule', c_int32),
    ('height_change', c_double),
    ('check_time', c_double),
    ('still_speed', c_double),
    ('max_steps', c_int64),
    ('max_damping_time', c_double),
    ('wall', clast_text_list),
    ('outlet', clast_text_list),
    ('wall_forces', c_bool),
    ('stages', clast_text_list),
    ('load_rate', c_double),
    ('load_tolerance', c_double),
    ('load_rest', c_double),
    ('max_load_time', c_double),
    ('energy', c_bool),
    ('layer', c_double),
    ('cut', c_double),
    ('trim', c_double),
    ('series_time', c_double),
    ('frame_time', c_double),
    ('checkpoint_time', c_double),
    ('resume', c_char_p),
    ('force', c_bool),
]
clast_pack_wall._fields_ = [
    ('name', (c_char * 32)),
    ('number', c_int32),
    ('mesh', clast_mesh),
    ('motion', clast_dem_wall_motion),
    ('press', (c_double * 3)),
    ('area', c_double),
]
clast_pack_input._fields_ = [
    ('grading', c_void_p),
    ('curve', POINTER(clast_curve)),
    ('n_shape', c_int32),
    ('shape', POINTER(clast_shape)),
    ('start', POINTER(clast_assembly)),
    ('container', POINTER(clast_mesh)),
    ('container_closed', POINTER(clast_mesh)),
    ('n_wall', c_int32),
    ('wall', POINTER(clast_pack_wall)),
    ('start_snapshot', c_int64),
    ('n_start_snapshot', c_int64),
    ('start_step', c_int64),
    ('start_shift', c_double),
]
clast_pack_ranks._fields_ = [
    ('n', c_int32),
    ('n_idle', c_int32),
    ('n_balance', c_int64),
    ('n_migrated', c_int64),
    ('ghosts', c_double),
    ('messages', c_double),
    ('step_bytes', c_double),
    ('list_bytes', c_double),
    ('imbalance', c_double),
    ('is_zoltan', c_bool),
]
clast_pack_hull._fields_ = [
    ('shape', (c_char * 64)),
    ('n_triangle', c_int32),
    ('volume_added', c_double),
]
clast_pack_source._fields_ = [
    ('curve', clast_curve),
    ('grading', c_void_p),
    ('n_shape', c_int32),
    ('shape', POINTER(clast_shape)),
    ('n_hull', c_int32),
    ('hull', POINTER(clast_pack_hull)),
    ('container', clast_mesh),
    ('container_closed', clast_mesh),
    ('start', clast_assembly),
    ('n_wall', c_int32),
    ('wall', POINTER(clast_pack_wall)),
    ('input', clast_pack_input),
]
clast_pairs_config._fields_ = [
    ('radius', c_double),
    ('n_shell', c_int32),
    ('outside', c_int32),
]
clast_estimate._fields_ = [
    ('value', c_double),
    ('low', c_double),
    ('high', c_double),
    ('resolved', c_bool),
]
clast_pair_integral._fields_ = [
    ('estimate', clast_estimate),
    ('scale', c_double),
    ('window', c_double),
    ('n_pair', c_int64),
    ('n_needed', c_double),
    ('fit_p', c_double),
]
clast_bed._fields_ = [
    ('kind', c_int),
    ('is_part', c_bool),
    ('centre', (c_double * 2)),
    ('radius', c_double),
    ('low', (c_double * 2)),
    ('high', (c_double * 2)),
    ('floor', c_double),
    ('ceiling', c_double),
    ('shift', c_double),
    ('surface', POINTER(clast_mesh)),
]
clast_porosity_options._fields_ = [
    ('method', c_int),
    ('layer', c_double),
    ('cut', c_double),
    ('trim', c_double),
    ('at_slice', c_bool),
]
clast_porosity_bulk._fields_ = [
    ('porosity', c_double),
    ('z_low', c_double),
    ('z_high', c_double),
    ('solid', c_double),
    ('top', c_double),
]
clast_bed_walls._fields_ = [
    ('size', c_double),
    ('radius', c_double),
    ('ratio', c_double),
]
clast_bed_beyond._fields_ = [
    ('n', c_int32),
    ('depth', c_double),
    ('solid', c_double),
]
clast_porosity_core._fields_ = [
    ('depth', c_double),
    ('porosity', c_double),
    ('error', c_double),
    ('share', c_double),
]
clast_radial_options._fields_ = [
    ('method', c_int),
    ('n_ring', c_int32),
    ('n_point', c_int32),
]
clast_pore_options._fields_ = [
    ('n_point', c_int64),
    ('n_bin', c_int32),
    ('period', (c_double * 3)),
]
clast_mean._fields_ = [
    ('n', c_int32),
    ('mean', c_double),
    ('deviation', c_double),
    ('low', c_double),
    ('high', c_double),
]
clast_bed_known._fields_ = [
    ('bed', POINTER(clast_bed)),
    ('is_own', c_bool),
    ('own', POINTER(clast_bed)),
    ('contacts', POINTER(clast_table)),
    ('velocities', POINTER(clast_table)),
]
clast_bed_options._fields_ = [
    ('porosity', clast_porosity_options),
    ('floor', c_double),
    ('gap', c_double),
    ('core', c_double),
    ('local', c_bool),
    ('rings', c_int32),
    ('pores', c_int64),
    ('fields', c_double),
    ('chains', c_bool),
]
clast_form_inputs._fields_ = [
    ('n_grain', c_int64),
    ('has_deviation', c_bool),
    ('is_independent', c_bool),
    ('flatness_mean', c_double),
    ('flatness_deviation', c_double),
    ('elongation_mean', c_double),
    ('elongation_deviation', c_double),
    ('equancy_mean', c_double),
    ('equancy_deviation', c_double),
    ('single', (c_double * 26)),
    ('mixture', (c_double * 104)),
]
clast_model_term._fields_ = [
    ('feature', c_char_p),
    ('coefficient', c_double),
    ('unit', c_char_p),
]
clast_model_range._fields_ = [
    ('feature', c_char_p),
    ('low', c_double),
    ('high', c_double),
]
clast_porosity_model._fields_ = [
    ('name', c_char_p),
    ('source', c_char_p),
    ('kind', c_int),
    ('intercept', c_double),
    ('n_term', c_int32),
    ('term', POINTER(clast_model_term)),
    ('n_range', c_int32),
    ('range', POINTER(clast_model_range)),
    ('covariance', POINTER(c_double)),
    ('rounding', c_double),
    ('deviation', c_double),
    ('n_bed', c_int64),
    ('r2', c_double),
    ('cv_mean_error', c_double),
    ('cv_median_error', c_double),
    ('leverage_limit', c_double),
]
clast_prediction._fields_ = [
    ('porosity', c_double),
    ('standard_error', c_double),
    ('model_error', c_double),
    ('coefficient_error', c_double),
    ('sampling_error', c_double),
    ('in_range', c_bool),
    ('leverage', c_double),
    ('n_outside', c_int32),
    ('outside', (c_int32 * 16)),
]
clast_predict_given._fields_ = [
    ('model', c_char_p),
    ('has_table', c_bool),
    ('each', c_bool),
    ('takes_columns', c_bool),
]
clast_porosity_fit_config._fields_ = [
    ('target', c_char_p),
    ('columns', c_char_p),
    ('group', c_char_p),
    ('n_term', c_int32),
    ('use', c_char_p),
    ('correlation_limit', c_double),
    ('n_fold', c_int32),
    ('n_repeat', c_int32),
    ('score', c_int32),
    ('validation', c_int32),
    ('n_permutation', c_int32),
    ('seed', c_uint64),
]
clast_fit_note._fields_ = [
    ('is_of_table', c_bool),
    ('text', (c_char * 1024)),
]
clast_image._fields_ = [
    ('width', c_int32),
    ('height', c_int32),
    ('rgba', POINTER(c_uint8)),
    ('pixel_size', c_double),
]
clast_render_config._fields_ = [
    ('width', c_int32),
    ('height', c_int32),
    ('samples', c_int32),
    ('ambient_rays', c_int32),
    ('projection', c_int32),
    ('up', c_int32),
    ('azimuth', c_double),
    ('elevation', c_double),
    ('field_of_view', c_double),
    ('zoom', c_double),
    ('colour', c_int32),
    ('tint', c_char_p),
    ('scale', c_int32),
    ('shading', c_int32),
    ('background', c_int32),
    ('ground', c_bool),
    ('cut', c_int32),
    ('cut_position', c_double),
    ('colour_bar', c_bool),
    ('scale_bar', c_bool),
    ('unit', c_char_p),
    ('sun_azimuth', c_double),
    ('sun_elevation', c_double),
    ('sun_radius', c_double),
    ('ambient', c_double),
    ('seed', c_uint64),
]
clast_report_config._fields_ = [
    ('title', c_char_p),
    ('rows', c_int32),
    ('view', c_bool),
    ('triangles', c_int32),
    ('picture_mb', c_int32),
]
clast_fluid._fields_ = [
    ('density', c_double),
    ('viscosity', c_double),
    ('gravity', c_double),
]
clast_drag._fields_ = [
    ('stokes', c_double),
    ('newton', c_double),
]
clast_settling._fields_ = [
    ('velocity', c_double),
    ('reynolds', c_double),
    ('drag_coefficient', c_double),
    ('in_range', c_bool),
]
clast_porous._fields_ = [
    ('permeability', c_double),
    ('core', c_double),
]
clast_spheres._fields_ = [
    ('n', c_int32),
    ('centre', POINTER(c_double)),
    ('radius', POINTER(c_double)),
]
clast_part._fields_ = [
    ('kind', c_int),
    ('semi_axes', (c_double * 3)),
    ('position', (c_double * 3)),
    ('orientation', (c_double * 4)),
    ('vert', (c_int32 * 2)),
    ('tri', (c_int32 * 2)),
]
clast_parts._fields_ = [
    ('n', c_int32),
    ('part', POINTER(clast_part)),
]
clast_material._fields_ = [
    ('density', c_double),
    ('is_mixed', c_bool),
    ('centre', (c_double * 3)),
    ('inertia', ((c_double * 3) * 3)),
]
clast_shape._fields_ = [
    ('kind', c_int),
    ('name', c_char_p),
    ('semi_axes', (c_double * 3)),
    ('mesh', clast_mesh),
    ('spheres', clast_spheres),
    ('parts', clast_parts),
    ('volume', c_double),
    ('length', c_double),
    ('bounding_radius', c_double),
    ('inertia', ((c_double * 3) * 3)),
    ('own', clast_material),
    ('source_origin', (c_double * 3)),
]
clast_named_spheres._fields_ = [
    ('name', c_char_p),
    ('spheres', clast_spheres),
]
clast_state._fields_ = [
    ('assembly', POINTER(clast_assembly)),
    ('n_spheres', c_int32),
    ('spheres', POINTER(clast_named_spheres)),
    ('n_table', c_int32),
    ('table', POINTER(clast_table)),
    ('config', c_char_p),
    ('unit', (c_char * 16)),
    ('version', (c_char * 32)),
]
clast_packing_options._fields_ = [
    ('columns', c_char_p),
    ('diameter', c_double),
]
clast_packing_frame._fields_ = [
    ('step', c_int64),
    ('has_box', (c_bool * 3)),
    ('is_periodic', (c_bool * 3)),
    ('low', (c_double * 3)),
    ('high', (c_double * 3)),
    ('tilt', (c_double * 3)),
]
clast_packing_report._fields_ = [
    ('snapshot', c_int64),
    ('n_snapshot', c_int64),
    ('frame', clast_packing_frame),
]
clast_export_options._fields_ = [
    ('format', c_int),
    ('level', c_int),
    ('points', c_bool),
    ('colour', c_int),
    ('unit', c_char_p),
    ('values', POINTER(clast_table)),
    ('frame', POINTER(clast_packing_frame)),
]
clast_export_report._fields_ = [
    ('format', c_int),
    ('n_vertex', c_int64),
    ('n_triangle', c_int64),
    ('unit', c_char_p),
    ('facet_ratio', c_double),
    ('clump_ratio', c_double),
    ('ellipsoid_ratio', c_double),
    ('has_ids', c_bool),
    ('ids_kept', c_bool),
    ('id_offset', c_int32),
]
clast_export_given._fields_ = [
    ('format', c_int),
    ('has_table', c_bool),
    ('is_run', c_bool),
    ('points', c_bool),
    ('assembly', POINTER(clast_assembly)),
]
clast_bootstrap._fields_ = [
    ('n_resample', c_int32),
    ('level', c_double),
    ('seed', c_uint64),
]
clast_sample_summary._fields_ = [
    ('n', c_int64),
    ('n_left_out', c_int64),
    ('mean', c_double),
    ('deviation', c_double),
    ('deviation_ml', c_double),
    ('skewness', c_double),
    ('kurtosis', c_double),
    ('low', c_double),
    ('high', c_double),
    ('quantile', (c_double * 7)),
    ('mean_low', c_double),
    ('mean_high', c_double),
    ('deviation_low', c_double),
    ('deviation_high', c_double),
    ('shapiro_w', c_double),
    ('shapiro_p', c_double),
    ('is_constant', c_bool),
]
clast_statistics._fields_ = [
    ('n', c_int32),
    ('name', POINTER(c_char_p)),
    ('summary', POINTER(clast_sample_summary)),
    ('r', POINTER(c_double)),
    ('r_p', POINTER(c_double)),
    ('n_pca', c_int32),
    ('pca_column', POINTER(c_int32)),
    ('variance', POINTER(c_double)),
    ('explained', POINTER(c_double)),
    ('loading', POINTER(c_double)),
]
clast_histogram._fields_ = [
    ('n_bin', c_int32),
    ('edge', POINTER(c_double)),
    ('count', POINTER(c_int64)),
    ('density', POINTER(c_double)),
    ('mean', c_double),
    ('deviation_ml', c_double),
]
clast_grain_statistics._fields_ = [
    ('set', clast_form_set),
    ('statistics', clast_statistics),
    ('zingg', (c_int64 * 4)),
]
clast_monitor._fields_ = [
    ('report', c_void_p),
    ('stop', c_void_p),
    ('note', c_void_p),
    ('context', c_void_p),
    ('n_word', c_int32),
    ('word', POINTER(c_char_p)),
]
clast_study_config._fields_ = [
    ('run', c_char_p),
    ('config', c_char_p),
    ('argument', clast_text_list),
    ('set', clast_text_list),
    ('vary', clast_text_list),
    ('design', c_int32),
    ('table', c_char_p),
    ('seeds', c_int32),
    ('seed', c_int64),
    ('keep', clast_text_list),
    ('shard', c_char_p),
]
clast_study_item._fields_ = [
    ('row', c_int64),
    ('folder', c_char_p),
    ('n_argument', c_int32),
    ('argument', POINTER(c_char_p)),
]
clast_study_worker._fields_ = [
    ('has_folder', c_bool),
    ('has_seed', c_bool),
    ('has_resume', c_bool),
    ('start', c_void_p),
    ('wait', c_void_p),
    ('stop', c_void_p),
    ('context', c_void_p),
]
clast_study_report._fields_ = [
    ('n_run', c_int64),
    ('n_before', c_int64),
    ('n_done', c_int64),
    ('n_failed', c_int64),
    ('n_other', c_int64),
    ('first_failed', c_int64),
    ('n_unknown', c_int32),
    ('first_unknown', c_int32),
    ('n_unconverged', c_int64),
]
clast_study_outcomes._fields_ = [
    ('n_run', c_int64),
    ('n_done', c_int64),
    ('n_failed', c_int64),
    ('n_unconverged', c_int64),
]
clast_column._fields_ = [
    ('name', c_char_p),
    ('unit', c_char_p),
    ('number', POINTER(c_double)),
    ('text', POINTER(c_char_p)),
]
clast_table._fields_ = [
    ('name', c_char_p),
    ('n_column', c_int32),
    ('n_row', c_int64),
    ('column', POINTER(clast_column)),
]
clast_csv_options._fields_ = [
    ('separator', c_char),
    ('comment', c_char),
    ('no_comment', c_bool),
    ('header', c_int),
]
clast_csv_report._fields_ = [
    ('separator', c_char),
    ('has_header', c_bool),
    ('n_line', c_int64),
    ('n_comment', c_int64),
    ('n_blank', c_int64),
    ('n_missing', c_int64),
    ('n_renamed', c_int32),
]
clast_voxels._fields_ = [
    ('n', (c_int32 * 3)),
    ('edge', (c_double * 3)),
    ('label', POINTER(c_int32)),
    ('grey', POINTER(c_float)),
    ('threshold', c_double),
]
clast_voxel_label._fields_ = [
    ('label', c_int32),
    ('n_voxel', c_int64),
    ('low', (c_int32 * 3)),
    ('high', (c_int32 * 3)),
]
clast_volume._fields_ = [
    ('n', (c_int32 * 3)),
    ('edge', (c_double * 3)),
    ('unit_m', c_double),
    ('value', POINTER(c_float)),
]
clast_volume_options._fields_ = [
    ('n', (c_int32 * 3)),
    ('type', c_int),
    ('is_big_endian', c_bool),
    ('skip', c_int64),
    ('edge', (c_double * 3)),
]
clast_points._fields_ = [
    ('n', c_int64),
    ('dimension', c_int32),
    ('x', POINTER(c_double)),
    ('stride', c_int64),
    ('axis_stride', c_int64),
    ('weight', POINTER(c_double)),
    ('weight_stride', c_int64),
]
clast_workspace_policy._fields_ = [
    ('tests', c_int32),
    ('tests_every', c_int32),
    ('tests_moved', c_double),
    ('cells', c_int32),
    ('cells_every', c_int32),
    ('cells_level', c_double),
    ('pairs_every', c_int32),
    ('pairs_most', c_int32),
]
clast_workspace_calls._fields_ = [
    ('n_call', c_int64),
    ('n_test', c_int64),
    ('n_cut', c_int64),
    ('since_test', c_int64),
    ('since_cut', c_int64),
    ('moved', c_double),
    ('p_change', c_double),
    ('n_pairs', c_int64),
]
clast_workspace_step._fields_ = [
    ('dt', c_double),
    ('step', c_uint64),
]
clast_collide_config._fields_ = [
    ('kernel', c_uint32),
    ('medium', clast_medium),
    ('alpha', c_double),
    ('sticking', clast_sticking),
    ('out_of_range', c_int32),
    ('radius_law', c_int32),
    ('collisions', c_int32),
    ('monomer_radius', c_double),
    ('fractal_dimension', c_double),
    ('fractal_prefactor', c_double),
    ('leap', c_double),
    ('block', c_int32),
    ('self_collisions', c_bool),
    ('keep_positions', c_bool),
    ('seed', c_uint64),
    ('count_unit', c_double),
]
clast_spectrum._fields_ = [
    ('history', clast_table),
    ('spectrum', clast_table),
    ('gel_time', c_double),
    ('gel_size', c_double),
    ('n_gelled', c_int32),
    ('is_gelation', c_bool),
    ('exact_gel_time', c_double),
    ('volume_fraction', c_double),
    ('law_M1', c_double),
    ('law_M2', c_double),
    ('is_drawn', c_bool),
    ('mass_error', c_double),
    ('n_evaluation', c_int64),
    ('range', clast_range_report),
]
clast_agglomerate_config._fields_ = [
    ('decompose', clast_decompose_config),
    ('collide', clast_collide_config),
    ('kernel', c_char_p),
    ('duration', c_double),
    ('n_step', c_int32),
    ('repeats', c_int32),
    ('rebuild', c_int32),
    ('change_level', c_double),
    ('fixed', c_int32),
    ('depth', c_double),
]
clast_agglomeration._fields_ = [
    ('history', clast_table),
    ('particles', clast_table),
    ('members', clast_table),
    ('spectrum', clast_table),
    ('n_rebuilt', c_int32),
    ('n_snapshot', c_int32),
    ('n_unresolved', c_int32),
    ('n_repeated', c_int64),
    ('n_cell', c_int32),
    ('volume_fraction', c_double),
    ('has_exact', c_bool),
    ('has_fixed', c_bool),
    ('is_gelation', c_bool),
    ('n_gelled', c_int32),
    ('gel_time', c_double),
    ('range', clast_range_report),
]
clast_aggregate_params._fields_ = [
    ('mode', c_int32),
    ('core_size', c_double),
    ('core_meaning', c_int32),
    ('core_density', c_double),
    ('coat_weight', clast_f64_list),
    ('class_limit', clast_f64_list),
    ('coat_density', clast_f64_list),
    ('size', clast_f64_list),
    ('size_law', c_int32),
    ('size_mean', c_double),
    ('size_deviation', c_double),
    ('size_shape', c_double),
    ('size_low', c_double),
    ('size_high', c_double),
    ('n_particle', c_int32),
    ('size_draw', c_bool),
    ('size_by_mass', c_bool),
    ('replicate', c_int32),
    ('size_meaning', c_int32),
    ('order', c_int32),
    ('cone', c_double),
    ('rays', c_int32),
    ('orientations', c_int32),
    ('axis', c_char_p),
    ('origin', c_int32),
    ('target', c_int32),
    ('start', c_double),
    ('max_tries', c_int32),
    ('approach', c_int32),
    ('walk_step', c_double),
    ('contact', c_int32),
    ('flavour', c_int32),
    ('march_coarse', c_double),
    ('march_fine', c_double),
    ('march_steps', c_int32),
    ('march_vertices', c_int32),
    ('envelope', clast_text_list),
    ('envelope_every', c_int32),
    ('envelope_rays', c_int32),
    ('envelope_length', c_double),
    ('solid_union', c_bool),
    ('fall_speed', c_bool),
    ('permeability', c_int32),
    ('stop_mass', c_double),
    ('stop_size', c_double),
    ('stop_porosity', c_double),
    ('pick', c_int32),
    ('n_final', c_int32),
    ('seed', c_uint64),
]
clast_aggregate_result._fields_ = [
    ('n_particle', c_int32),
    ('n_grain', c_int32),
    ('n_contact', c_int32),
    ('n_cluster', c_int32),
    ('n_grain_all', c_int32),
    ('contact', c_int32),
    ('mass', c_double),
    ('solid_sum', c_double),
    ('solid_union', c_double),
    ('solid_union_error', c_double),
    ('n_envelope', c_int32),
    ('envelope', (clast_envelope * 7)),
    ('porosity', (c_double * 7)),
    ('d_agg', c_double),
    ('density', c_double),
    ('radius_of_gyration', c_double),
    ('settling_velocity', c_double),
    ('settling_velocity_permeable', c_double),
    ('permeable', c_int),
    ('coat_porosity', c_double),
    ('coat_grain', c_double),
    ('permeability', c_double),
    ('drag_permeable', c_double),
    ('max_overlap', c_double),
    ('max_overlap_relative', c_double),
    ('n_lost', c_int32),
    ('stop', c_int),
    ('contact_s', c_double),
    ('envelope_s', c_double),
    ('wall_s', c_double),
]
clast_aggregate_config._fields_ = [
    ('params', clast_aggregate_params),
    ('core', c_char_p),
    ('coat', clast_text_list),
    ('core_spheres', c_char_p),
    ('coat_spheres', clast_text_list),
    ('fill_spheres', c_int32),
    ('fill', c_int32),
    ('unit', c_char_p),
    ('accept_faults', c_bool),
    ('sizes', c_char_p),
    ('size_column', c_char_p),
    ('size_unit', c_char_p),
    ('fit', c_bool),
    ('observed_size', c_double),
    ('observed_size_error', c_double),
    ('observed_density', c_double),
    ('observed_density_error', c_double),
    ('observed_velocity', c_double),
    ('observed_velocity_error', c_double),
    ('fit_packing', clast_text_list),
    ('fit_repeats', c_int32),
    ('fit_replicate_max', c_int32),
    ('repeats', c_int32),
    ('confidence', c_double),
    ('checkpoint_every', c_int32),
    ('picture', c_bool),
    ('printable', c_bool),
    ('neck', c_double),
    ('spacing', c_double),
    ('force', c_bool),
    ('resume', c_char_p),
]
clast_aggregate_source._fields_ = [
    ('core', clast_assembly),
    ('coat', POINTER(clast_assembly)),
    ('n_coat', c_int32),
    ('sizes', clast_sizes),
    ('input', clast_aggregate_input),
]
clast_aggregate_report._fields_ = [
    ('n', c_int32),
    ('result', POINTER(clast_aggregate_result)),
    ('confidence', c_double),
    ('folder', c_char_p),
    ('is_printable', c_bool),
    ('printable', clast_printable_report),
]
clast_structure_options._fields_ = [
    ('envelope', clast_envelope_options),
    ('solid', clast_union_options),
    ('fluid', clast_fluid),
    ('n_line', c_int32),
    ('n_direction', c_int32),
    ('n_first', c_int32),
    ('alpha', c_bool),
]
clast_cloud_columns._fields_ = [
    ('columns', clast_text_list),
    ('velocity_columns', clast_text_list),
    ('radius_column', c_char_p),
    ('diameter_column', c_char_p),
    ('mass_column', c_char_p),
    ('weight_column', c_char_p),
    ('variable_column', c_char_p),
    ('unit', c_char_p),
]
clast_evolve_config._fields_ = [
    ('medium', clast_medium),
    ('kernel', c_char_p),
    ('alpha', c_double),
    ('sticking', clast_sticking),
    ('out_of_range', c_int32),
    ('shapes', clast_text_list),
    ('shape_weight', clast_f64_list),
    ('density', clast_f64_list),
    ('unit', c_char_p),
    ('accept_faults', c_bool),
    ('curve', c_char_p),
    ('particles', c_int32),
    ('weight', c_double),
    ('release', c_char_p),
    ('points', c_char_p),
    ('columns', clast_text_list),
    ('diameter_column', c_char_p),
    ('frame', c_int64),
    ('dataset', c_char_p),
    ('domain', c_char_p),
    ('floor', c_int32),
    ('sides', c_int32),
    ('open_top', c_bool),
    ('wind', c_char_p),
    ('field', c_char_p),
    ('field_columns', c_char_p),
    ('wind_shear', c_double),
    ('eddy_diffusivity', c_double),
    ('brownian', c_bool),
    ('fall', c_int32),
    ('structure', c_bool),
    ('collision_radius', c_int32),
    ('meeting', c_int32),
    ('walk_step', c_double),
    ('max_tries', c_int32),
    ('even', c_int32),
    ('change_level', c_double),
    ('duration', c_double),
    ('rows', c_int32),
    ('step_error', c_double),
    ('time_step', c_double),
    ('seed', c_uint64),
    ('keep', c_int32),
    ('bed_width', c_double),
    ('frames', c_int32),
    ('checkpoint_time', c_double),
    ('resume', c_char_p),
    ('force', c_bool),
]
clast_evolve_result._fields_ = [
    ('n_start', c_int64),
    ('n_particle', c_int64),
    ('n_event', c_int64),
    ('n_deposit', c_int64),
    ('n_out', c_int64),
    ('n_step', c_int64),
    ('time', c_double),
    ('mass_start', c_double),
    ('mass', c_double),
    ('mass_deposit', c_double),
    ('mass_out', c_double),
    ('n_wall', c_int64),
    ('mass_wall', c_double),
    ('gathered', c_double),
    ('gathered_top', c_double),
    ('weight_words', (c_char * 160)),
    ('points_words', (c_char * 256)),
    ('is_field_apart', c_bool),
    ('mass_balance', c_double),
    ('number_balance', c_int64),
    ('n_cut', c_int64),
    ('n_test', c_int64),
    ('n_unresolved', c_int64),
    ('grains_most', c_int64),
    ('deposit_diameter', c_double),
    ('deposit_porosity', c_double),
    ('deposit_speed', c_double),
    ('deposit_grains', c_double),
    ('volume_fraction', c_double),
    ('fall_reynolds', c_double),
    ('fall_reynolds_limit', c_double),
    ('fractal_dimension', c_double),
    ('fractal_error', c_double),
    ('range', clast_range_use),
    ('hash', c_uint64),
    ('wall_s', c_double),
    ('n_frame', c_int32),
    ('n_written', c_int32),
    ('bed_width', c_double),
    ('bed_height', c_double),
    ('is_bed_empty', c_bool),
    ('bed_mass', c_double),
    ('bed_least', c_double),
    ('folder', c_char_p),
]
clast_grains_options._fields_ = [
    ('kind', c_int),
    ('hull', c_bool),
    ('degree', c_int32),
    ('level', c_int32),
    ('spacing', c_double),
    ('volume', clast_volume_options),
    ('dataset', c_char_p),
    ('has_threshold', c_bool),
    ('threshold', c_double),
    ('least_voxels', c_int64),
    ('columns', c_char_p),
    ('folder', c_char_p),
    ('unit', c_char_p),
]
clast_pack_result._fields_ = [
    ('n_hull', c_int32),
    ('hull', POINTER(clast_pack_hull)),
    ('dem', clast_dem_measures),
    ('phase', c_int),
    ('converged', c_bool),
    ('hash', c_uint64),
    ('n_fill', c_int32),
    ('n_waited', c_int64),
    ('wall_s', c_double),
    ('step_s', c_double),
    ('clocked_steps', c_double),
    ('grain_steps', c_double),
    ('n_outside', c_int32),
    ('porosity_state', c_int),
    ('porosity', c_double),
    ('porosity_least', c_double),
    ('cut', c_double),
    ('z_low', c_double),
    ('z_high', c_double),
    ('top', c_double),
    ('untrimmed', c_double),
    ('trim', c_double),
    ('walls', clast_bed_walls),
    ('wall_share', c_double),
    ('mass_wanted', c_double),
    ('n_loose', c_int32),
    ('is_moving', c_bool),
    ('fell', c_bool),
    ('sank', c_double),
    ('still_diameters', c_double),
    ('own_density', c_double),
    ('given_density', c_double),
    ('flatness', (c_double * 2)),
    ('elongation', (c_double * 2)),
    ('n_frame', c_int64),
    ('frame_interval', c_double),
    ('n_overlap', c_int64),
    ('deepest_start', c_double),
    ('start_snapshot', c_int64),
    ('n_start_snapshot', c_int64),
    ('start_step', c_int64),
    ('n_stage', c_int32),
    ('n_left', c_int64),
    ('mass_left', c_double),
    ('cell', clast_dem_cell),
    ('load', clast_dem_load),
    ('energy', clast_dem_energy),
    ('ranks', clast_pack_ranks),
]
clast_pairs._fields_ = [
    ('n', c_int64),
    ('n_outside', c_int64),
    ('dimension', c_int32),
    ('n_shell', c_int32),
    ('volume', c_double),
    ('radius', c_double),
    ('n_pair', c_int64),
    ('n_repeated', c_int64),
    ('edge_error', c_double),
    ('shells', clast_table),
    ('integral', clast_pair_integral),
]
clast_pores._fields_ = [
    ('porosity', c_double),
    ('mean', c_double),
    ('sizes', clast_table),
]
clast_bed_findings._fields_ = [
    ('bed', clast_bed),
    ('options', clast_bed_options),
    ('bulk', clast_porosity_bulk),
    ('walls', clast_bed_walls),
    ('beyond', clast_bed_beyond),
    ('outside', c_double),
    ('core', clast_porosity_core),
    ('n_overlap', c_int32),
    ('max_overlap', c_double),
    ('max_overlap_share', c_double),
    ('mean_coordination', c_double),
    ('knows_contacts', c_bool),
    ('profile', clast_table),
    ('coordination', clast_table),
    ('fabric', clast_table),
    ('local', clast_table),
    ('radial', clast_table),
    ('stress', clast_table),
    ('stress_profile', clast_table),
    ('fields', clast_table),
    ('chains', clast_table),
    ('pores', clast_pores),
]
clast_fit_data._fields_ = [
    ('kind', c_int),
    ('beds', clast_table),
    ('left_out', clast_table),
    ('unread_count', (c_char * 64)),
    ('n_repeated', c_int64),
    ('n_without_bed', c_int64),
]
clast_porosity_fit._fields_ = [
    ('model', clast_porosity_model),
    ('ranking', clast_table),
    ('trials', clast_table),
    ('terms', clast_table),
    ('rows', clast_table),
    ('n_removed', c_int32),
    ('condition', c_double),
    ('r2_held_out', c_double),
    ('p_value', c_double),
]
clast_decomposition._fields_ = [
    ('n', c_int64),
    ('n_outside', c_int64),
    ('n_here', c_int64),
    ('n_test', c_int64),
    ('dimension', c_int32),
    ('n_capped', c_int32),
    ('before', clast_uniformity),
    ('n_pass', c_int32),
    ('pass', (clast_pass * 64)),
    ('stop', c_int),
    ('cells', clast_cells),
    ('events', c_double),
    ('events_low', c_double),
    ('events_high', c_double),
    ('points_needed', c_double),
    ('events_cross', c_double),
    ('points_per_bin', c_double),
    ('search', clast_table),
    ('cells_bias', c_double),
    ('bias_estimate', c_double),
    ('smoothing_bias', c_double),
    ('beta_dt', c_double),
    ('volume', c_double),
    ('seed', c_uint64),
    ('pairs', clast_pairs),
    ('events_by_cells', clast_estimate),
    ('events_by_pairs', clast_estimate),
    ('estimator', c_int),
    ('within', clast_within_cells),
    ('disagree', c_bool),
    ('resolved', c_bool),
    ('keeps_apart', c_bool),
    ('has_drawn', c_bool),
]

# sizeof, and offsetof and sizeof of each member, as C has them.
SIZES: dict[str, tuple[int, dict[str, tuple[int, int]]]] = {
    'clast_population': (80, {'n': (0, 8), 'dimension': (8, 4), 'x': (16, 8), 'monomers': (24, 8), 'radius': (32, 8), 'mass': (40, 8), 'velocity': (48, 8), 'speed_rms': (56, 8), 'owner': (64, 8), 'weight': (72, 8)}),
    'clast_collide_cells': (48, {'n': (0, 4), 'of_particle': (8, 8), 'volume': (16, 8), 'medium': (24, 8), 'events': (32, 8), 'range': (40, 8)}),
    'clast_spectrum_config': (144, {'solver': (0, 4), 'initial': (4, 4), 'concentration': (8, 8), 'initial_mean': (16, 8), 'initial_sd': (24, 8), 'particles': (32, 4), 'size_min': (40, 8), 'size_max': (48, 8), 'per_octave': (56, 4), 'breakage_rate': (64, 8), 'breakage_exponent': (72, 8), 'fragments': (80, 4), 'fragment_exponent': (88, 8), 'source': (96, 8), 'source_size': (104, 8), 'settling_depth': (112, 8), 'tolerance': (120, 8), 'duration': (128, 8), 'n_step': (136, 4), 'repeats': (140, 4)}),
    'clast_spectrum_start': (24, {'n': (0, 8), 'size': (8, 8), 'number': (16, 8)}),
    'clast_agglomerate_given': (12, {'n_snapshot': (0, 4), 'weight': (4, 1), 'radius': (5, 1), 'temperature': (6, 1), 'shear': (7, 1), 'dissipation': (8, 1)}),
    'clast_agglomerate_input': (80, {'snapshot': (0, 8), 'n_snapshot': (8, 8), 'monomers': (16, 8), 'speed_rms': (24, 8), 'temperature': (32, 8), 'shear': (40, 8), 'dissipation': (48, 8), 'fixed_cell': (56, 8), 'fixed_volume': (64, 8), 'domain': (72, 8)}),
    'clast_aggregate_input': (32, {'core': (0, 8), 'n_coat': (8, 4), 'coat': (16, 8), 'sizes': (24, 8)}),
    'clast_aggregate_saved': (32, {'repeat': (0, 4), 'placed': (8, 8), 'history': (16, 8), 'members': (24, 8)}),
    'clast_interval': (40, {'n': (0, 4), 'mean': (8, 8), 'deviation': (16, 8), 'low': (24, 8), 'high': (32, 8)}),
    'clast_fit_estimate': (40, {'best': (0, 8), 'mean': (8, 8), 'deviation': (16, 8), 'low': (24, 8), 'high': (32, 8)}),
    'clast_aggregate_fit': (1472, {'cone': (0, 8), 'rays': (8, 4), 'orientations': (12, 4), 'replicate': (16, 4), 'trials': (24, 40), 'n_replica': (64, 40), 'model': (104, 120), 'porosity': (224, 40), 'observed': (264, 24), 'error': (288, 24), 'pull': (312, 24), 'least': (336, 24), 'most': (360, 24), 'chi2': (384, 8), 'n_observed': (392, 4), 'n_choice': (396, 4), 'n_freedom': (400, 4), 'p_value': (408, 8), 'verdict': (416, 4), 'packing_edge': (420, 4), 'replicate_edge': (424, 4), 'n_level': (428, 4), 'cut_short': (432, 1), 'n_run': (436, 4), 'at_level': (440, 4), 'words': (444, 1024)}),
    'clast_assembly': (128, {'n_shape': (0, 4), 'shape': (8, 8), 'n_grain': (16, 4), 'shape_id': (24, 8), 'position': (32, 8), 'orientation': (40, 8), 'scale': (48, 8), 'density': (56, 8), 'id': (64, 8), 'n_contact': (72, 4), 'contact': (80, 8), 'contact_point': (88, 8), 'unit': (96, 16), 'grain_capacity': (112, 4), 'contact_capacity': (116, 4), 'no_density': (120, 1), 'has_ids': (121, 1)}),
    'clast_rigid_options': (8, {'hull': (0, 1), 'faces': (4, 4)}),
    'clast_union_options': (32, {'tolerance': (0, 8), 'n_sample': (8, 8), 'seed': (16, 8), 'find_depth': (24, 1)}),
    'clast_union': (48, {'volume': (0, 8), 'error': (8, 8), 'sum': (16, 8), 'is_exact': (24, 1), 'n_overlap': (28, 4), 'max_overlap': (32, 8), 'max_overlap_share': (40, 8)}),
    'clast_period': (48, {'low': (0, 24), 'length': (24, 24)}),
    'clast_overlaps': (24, {'n': (0, 4), 'depth': (8, 8), 'share': (16, 8)}),
    'clast_printable_config': (24, {'neck': (0, 8), 'spacing': (8, 8), 'keep_voids': (16, 1)}),
    'clast_printable_report': (88, {'neck': (0, 8), 'spacing': (8, 8), 'smallest_feature': (16, 8), 'resolved': (24, 1), 'n_part': (28, 4), 'n_void': (32, 4), 'void_volume': (40, 8), 'solid_volume': (48, 8), 'volume': (56, 8), 'n_triangle_expected': (64, 8), 'knows_walls': (72, 1), 'lost': (80, 8)}),
    'clast_envelope': (40, {'kind': (0, 4), 'volume': (8, 8), 'error': (16, 8), 'low': (24, 8), 'high': (32, 8)}),
    'clast_envelope_options': (40, {'tolerance': (0, 8), 'n_ray': (8, 4), 'seed': (16, 8), 'length': (24, 8), 'n_cell': (32, 4)}),
    'clast_fractal': (56, {'dimension': (0, 8), 'dimension_error': (8, 8), 'prefactor': (16, 8), 'prefactor_error': (24, 8), 'low': (32, 8), 'high': (40, 8), 'n': (48, 4)}),
    'clast_extent': (104, {'length': (0, 8), 'axis': (8, 72), 'width': (80, 24)}),
    'clast_series': (80, {'kind': (0, 4), 'label': (8, 8), 'x': (16, 8), 'y': (24, 8), 'low': (32, 8), 'high': (40, 8), 'value': (48, 8), 'n': (56, 8), 'colour': (64, 4), 'dashed': (68, 1), 'width': (72, 8)}),
    'clast_axis': (32, {'label': (0, 8), 'log': (8, 1), 'low': (16, 8), 'high': (24, 8)}),
    'clast_heat': (72, {'n_x': (0, 4), 'n_y': (4, 4), 'value': (8, 8), 'x_low': (16, 8), 'x_high': (24, 8), 'y_low': (32, 8), 'y_high': (40, 8), 'x_name': (48, 8), 'y_name': (56, 8), 'is_signed': (64, 1), 'has_text': (65, 1)}),
    'clast_note': (24, {'x': (0, 8), 'y': (8, 8), 'text': (16, 8)}),
    'clast_chart': (184, {'title': (0, 8), 'x': (8, 32), 'y': (40, 32), 'value_axis': (72, 32), 'series': (104, 8), 'n_series': (112, 4), 'heat': (120, 8), 'mark_y': (128, 8), 'mark_label': (136, 8), 'n_mark': (144, 4), 'note': (152, 8), 'n_note': (160, 4), 'equal': (164, 1), 'width': (168, 8), 'height': (176, 8)}),
    'clast_cloud': (128, {'n': (0, 8), 'dimension': (8, 4), 'x': (16, 8), 'radius': (24, 8), 'mass': (32, 8), 'weight': (40, 8), 'velocity': (48, 8), 'variable': (56, 8), 'unread_weight': (64, 64)}),
    'clast_points_snapshot': (24, {'number': (0, 8), 'n': (8, 8), 'step': (16, 8)}),
    'clast_points_options': (24, {'dataset': (0, 8), 'frame': (8, 8), 'snapshot': (16, 8)}),
    'clast_domain_map_functions': (40, {'dimension': (0, 4), 'volume': (8, 8), 'map': (16, 8), 'unmap': (24, 8), 'context': (32, 8)}),
    'clast_domain': (224, {'kind': (0, 4), 'dimension': (4, 4), 'low': (8, 24), 'high': (32, 24), 'radius': (56, 8), 'length': (64, 8), 'is_placed': (72, 1), 'centre': (80, 24), 'axes': (104, 72), 'user': (176, 40), 'surface': (216, 8)}),
    'clast_discrepancy': (112, {'U1': (0, 8), 'U2': (8, 8), 'D2': (16, 8), 'A': (24, 8), 'variance': (32, 8), 'A_standard': (40, 8), 'p': (48, 8), 'p_asymptotic': (56, 8), 'p_paper': (64, 8), 'T': (72, 8), 'p_T': (80, 8), 'M': (88, 8), 'xi': (96, 8), 'zeta2': (104, 8)}),
    'clast_henze_zirkler': (168, {'beta': (0, 8), 'HZ': (8, 8), 'mean': (16, 8), 'variance': (24, 8), 'log_mean': (32, 8), 'log_sd': (40, 8), 'z': (48, 8), 'p': (56, 8), 'p_paper': (64, 8), 'centre': (72, 24), 'covariance': (96, 72)}),
    'clast_pearson': (64, {'n_pair': (0, 4), 'r': (8, 24), 'p': (32, 24), 'p_bonferroni': (56, 8)}),
    'clast_spacing': (24, {'ratio': (0, 8), 'z': (8, 8), 'p': (16, 8)}),
    'clast_boundary_score': (56, {'score': (0, 8), 'ideal': (8, 8), 'trapezoid': (16, 8), 'projected': (24, 8), 'projected_axis': (32, 24)}),
    'clast_decompose_config': (152, {'domain': (0, 8), 'outside': (8, 4), 'variant': (12, 4), 'mesh': (16, 4), 'events': (20, 4), 'level': (24, 8), 'votes': (32, 4), 'tests': (40, 8), 'statistic': (48, 4), 'paper': (52, 1), 'ghost_samples': (56, 4), 'crossfit': (60, 1), 'max_pass': (64, 4), 'lower': (68, 4), 'strict': (72, 1), 'beta_dt': (80, 8), 'beta_dt_dimension': (88, 4), 'tree_level': (96, 8), 'tree_root_level': (104, 8), 'variable_tolerance': (112, 8), 'tree_least': (120, 4), 'tree_refine': (124, 1), 'extrapolate': (125, 1), 'pairs': (126, 1), 'pairs_radius': (128, 8), 'estimator': (136, 4), 'seed': (144, 8)}),
    'clast_vote': (40, {'name': (0, 8), 'statistic': (8, 8), 'p': (16, 8), 'reject': (24, 1), 'axis': (28, 8)}),
    'clast_uniformity': (232, {'n_test': (0, 4), 'vote': (8, 200), 'n_reject': (208, 4), 'reject': (212, 1), 'score': (216, 8), 'ideal': (224, 8)}),
    'clast_uniformity_config': (24, {'level': (0, 8), 'votes': (8, 4), 'left_out': (12, 4), 'liang': (16, 1), 'paper': (17, 1)}),
    'clast_pass': (72, {'nb': (0, 12), 'n_lambda': (12, 4), 'lambda_count': (16, 4), 'lambda': (24, 8), 'n_lower': (32, 4), 'lower': (40, 8), 'score': (48, 8), 'ideal': (56, 8), 'fallback': (64, 1)}),
    'clast_cells': (128, {'n': (0, 4), 'low': (8, 8), 'high': (16, 8), 'volume': (24, 8), 'count': (32, 8), 'label': (40, 8), 'pass': (48, 8), 'weight': (56, 8), 'events': (64, 8), 'of_point': (72, 8), 'is_box': (80, 1), 'nb': (84, 12), 'bin_count': (96, 8), 'of_bin': (104, 8), 'key': (112, 8), 'group': (120, 8)}),
    'clast_within_cells': (72, {'is_structured': (0, 1), 'cell': (8, 8), 'even': (16, 8), 'radius': (24, 8), 'n_pair': (32, 8), 'g': (40, 8), 'g_low': (48, 8), 'g_high': (56, 8), 'length': (64, 8)}),
    'clast_decompose_parts': (8, {'n_size': (0, 4), 'regular': (4, 4)}),
    'clast_dem_config': (208, {'law': (0, 4), 'contact_scheme': (4, 4), 'restitution': (8, 8), 'collision_time': (16, 8), 'poisson': (24, 8), 'young': (32, 8), 'friction': (40, 8), 'wall_friction': (48, 8), 'rolling_friction': (56, 8), 'rolling_model': (64, 4), 'cohesion': (68, 4), 'cohesion_energy': (72, 8), 'surface_energy': (80, 8), 'clip': (88, 1), 'normal_torque': (89, 1), 'gyroscopic': (90, 1), 'clump_contacts': (92, 4), 'time_step': (96, 8), 'gravity': (104, 8), 'fluid_density': (112, 8), 'fluid_viscosity': (120, 8), 'sphere_drag': (128, 4), 'hindrance': (132, 1), 'added_mass': (136, 8), 'wet_restitution': (144, 1), 'domain': (148, 4), 'width': (152, 8), 'depth': (160, 8), 'height': (168, 8), 'floor': (176, 1), 'lid': (177, 1), 'rounding': (184, 8), 'skin': (192, 8), 'verify': (200, 4)}),
    'clast_dem_grain': (128, {'shape': (0, 4), 'scale': (8, 8), 'density': (16, 8), 'position': (24, 24), 'orientation': (48, 32), 'velocity': (80, 24), 'angular_velocity': (104, 24)}),
    'clast_dem_drive': (24, {'shake_amplitude': (0, 8), 'shake_period': (8, 8), 'damping': (16, 8)}),
    'clast_dem_verification': (32, {'n': (0, 8), 'n_off': (8, 8), 'n_bad': (16, 8), 'worst': (24, 8)}),
    'clast_dem_measures': (184, {'step': (0, 8), 'time': (8, 8), 'n_grain': (16, 4), 'mass': (24, 8), 'mean_height': (32, 8), 'top': (40, 8), 'max_speed': (48, 8), 'kinetic_energy': (56, 8), 'potential_energy': (64, 8), 'elastic_energy': (72, 8), 'momentum': (80, 24), 'n_listed': (104, 8), 'n_contact': (112, 8), 'n_wall_contact': (120, 8), 'max_overlap': (128, 8), 'coordination': (136, 8), 'n_refresh': (144, 8), 'verified': (152, 32)}),
    'clast_dem_energy': (176, {'translation': (0, 8), 'rotation': (8, 8), 'normal_springs': (16, 8), 'tangential_springs': (24, 8), 'attraction': (32, 8), 'made': (40, 8), 'gravity': (48, 8), 'shaking': (56, 8), 'cell': (64, 8), 'walls': (72, 8), 'damping': (80, 16), 'friction': (96, 16), 'rolling': (112, 16), 'fluid': (128, 8), 'calming': (136, 8), 'left': (144, 8), 'scheme': (152, 8), 'put_in': (160, 8), 'rest': (168, 8)}),
    'clast_dem_wall_motion': (144, {'velocity': (0, 24), 'amplitude': (24, 24), 'period': (48, 8), 'axis': (56, 24), 'pivot': (80, 24), 'rate': (104, 8), 'swing': (112, 8), 'n': (120, 4), 'time': (128, 8), 'place': (136, 8)}),
    'clast_dem_wall': (200, {'is_open': (0, 1), 'offset': (8, 24), 'angle': (32, 8), 'velocity': (40, 24), 'omega': (64, 24), 'force': (88, 24), 'torque': (112, 24), 'impulse': (136, 24), 'moment': (160, 24), 'work': (184, 8), 'n_step': (192, 8)}),
    'clast_dem_contact': (64, {'friction': (0, 8), 'rolling_friction': (8, 8), 'restitution': (16, 8), 'collision_time': (24, 8), 'young': (32, 16), 'poisson': (48, 16)}),
    'clast_dem_cell': (96, {'side': (0, 24), 'rate': (24, 24), 'shift': (48, 8), 'shear_rate': (56, 8), 'strain': (64, 24), 'shear_strain': (88, 8)}),
    'clast_dem_load': (272, {'volume': (0, 8), 'solid': (8, 8), 'stress': (16, 48), 'kinetic_stress': (64, 48), 'modulus': (112, 24), 'shear_modulus': (136, 8), 'fabric': (144, 48), 'n_contact': (192, 8), 'n_force': (200, 8), 'coordination': (208, 8), 'n_rattler': (216, 4), 'coordination_held': (224, 8), 'unbalanced': (232, 8), 'force_mean': (240, 8), 'force_below': (248, 24)}),
    'clast_scene_bed': (24, {'n': (0, 4), 'n_vert': (4, 4), 'width': (8, 8), 'fall': (16, 8)}),
    'clast_evolve_input': (56, {'n_shape': (0, 4), 'shape': (8, 8), 'grading': (16, 8), 'domain': (24, 8), 'release': (32, 8), 'points': (40, 8), 'field': (48, 8)}),
    'clast_evolve_source': (1040, {'shape': (0, 8), 'n_shape': (8, 4), 'grading': (16, 8), 'domain': (24, 224), 'release': (248, 224), 'points': (472, 128), 'field': (600, 128), 'input': (728, 56), 'points_words': (784, 256)}),
    'clast_text_list': (16, {'n': (0, 4), 'item': (8, 8)}),
    'clast_f64_list': (16, {'n': (0, 4), 'item': (8, 8)}),
    'clast_field': (88, {'name': (0, 8), 'offset': (8, 8), 'type': (16, 4), 'value': (24, 8), 'low': (32, 8), 'high': (40, 8), 'unit': (48, 8), 'help': (56, 8), 'text': (64, 8), 'group': (72, 8), 'common': (80, 1)}),
    'clast_idle': (24, {'is_idle': (0, 1), 'names': (8, 8), 'why': (16, 8)}),
    'clast_fill_config': (144, {'spheres': (0, 4), 'strategy': (4, 4), 'filled': (8, 8), 'volume_error': (16, 8), 'centroid_error': (24, 8), 'inertia_error': (32, 8), 'min_radius': (40, 8), 'min_share': (48, 8), 'tolerance': (56, 8), 'candidates': (64, 4), 'first_at_centre': (68, 1), 'vertex_subset': (69, 1), 'max_tries': (72, 8), 'outer': (80, 1), 'shrink': (88, 8), 'overlap': (96, 1), 'protrusion': (104, 8), 'allow_open': (112, 1), 'seed': (120, 8), 'name': (128, 8), 'history': (136, 8)}),
    'clast_fill_report': (168, {'n_sphere': (0, 4), 'n_placed': (4, 4), 'end': (8, 4), 'n_open_edge': (12, 4), 'open_share': (16, 8), 'solid_volume': (24, 8), 'sphere_volume': (32, 8), 'filled_fraction': (40, 8), 'outside_fraction': (48, 8), 'volume_error': (56, 8), 'centroid_error': (64, 8), 'inertia_error': (72, 8), 'max_protrusion': (80, 8), 'n_protruding': (88, 4), 'max_overlap': (96, 8), 'deviation_mean': (104, 8), 'deviation_max': (112, 8), 'radius_min': (120, 8), 'radius_median': (128, 8), 'radius_max': (136, 8), 'bound': (144, 8), 'n_tested': (152, 8), 'wall_s': (160, 8)}),
    'clast_form_factor_entry': (64, {'name': (0, 8), 'inverse': (8, 8), 'symbol': (16, 8), 'label': (24, 8), 'formula': (32, 8), 'low': (40, 8), 'high': (48, 8), 'source': (56, 8)}),
    'clast_form_law': (48, {'flatness_mean': (0, 8), 'flatness_deviation': (8, 8), 'elongation_mean': (16, 8), 'elongation_deviation': (24, 8), 'low': (32, 8), 'high': (40, 8)}),
    'clast_form_law_moments': (32, {'flatness_mean': (0, 8), 'flatness_deviation': (8, 8), 'elongation_mean': (16, 8), 'elongation_deviation': (24, 8)}),
    'clast_left_out': (16, {'row': (0, 8), 'fault': (8, 4)}),
    'clast_form_set': (208, {'n': (0, 8), 'row': (8, 8), 'flatness': (16, 8), 'elongation': (24, 8), 'size': (32, 8), 'size_name': (40, 64), 'size_unit': (104, 16), 'is_sieve_size': (120, 1), 'unread_count': (121, 64), 'n_left_out': (192, 8), 'left_out': (200, 8)}),
    'clast_sizes': (40, {'n': (0, 8), 'low': (8, 8), 'high': (16, 8), 'count': (24, 8), 'density': (32, 8)}),
    'clast_curve': (24, {'n_class': (0, 4), 'sieve': (8, 8), 'mass': (16, 8)}),
    'clast_curve_case': (88, {'name': (0, 8), 'mass': (8, 56), 'porosity': (64, 8), 'deviation': (72, 8), 'spacing': (80, 8)}),
    'clast_grading_sample': (24, {'n': (0, 8), 'size': (8, 8), 'volume': (16, 8)}),
    'clast_grading_match': (80, {'n': (0, 8), 'distance_mass': (8, 8), 'distance_number': (16, 8), 'distance_curve': (24, 8), 'achieved_d10': (32, 8), 'achieved_d50': (40, 8), 'achieved_d90': (48, 8), 'wanted_d10': (56, 8), 'wanted_d50': (64, 8), 'wanted_d90': (72, 8)}),
    'clast_grading_list': (40, {'n_row': (0, 8), 'total': (8, 8), 'column': (16, 8), 'ignored': (24, 8), 'size': (32, 8)}),
    'clast_axes': (96, {'lis': (0, 24), 'direction': (24, 72)}),
    'clast_grain': (752, {'volume': (0, 8), 'area': (8, 8), 'pore_volume': (16, 8), 'pore_area': (24, 8), 'centroid': (32, 24), 'inertia': (56, 72), 'moments': (128, 24), 'axes': (152, 480), 'hull_volume': (632, 8), 'hull_area': (640, 8), 'longest': (648, 8), 'shortest': (656, 8), 'sphericity': (664, 8), 'convexity': (672, 8), 'roundness': (680, 8), 'roundness_deviation': (688, 8), 'n_outline': (696, 4), 'normal_roundness': (704, 8), 'angularity': (712, 8), 'projected_mean': (720, 8), 'projected_least': (728, 8), 'projected_greatest': (736, 8), 'hull_volume_added': (744, 8)}),
    'clast_grain_record': (816, {'name': (0, 8), 'kind': (8, 4), 'has_surface': (12, 1), 'has_size': (13, 1), 'n_voxel': (16, 8), 'is_smoothed': (24, 1), 'in_metres': (25, 1), 'mixes_units': (26, 1), 'unit_m': (32, 8), 'degree': (40, 4), 'power_last': (48, 8), 'power_cut': (56, 8), 'grain': (64, 752)}),
    'clast_grain_fault': (16, {'status': (0, 4), 'text': (8, 8)}),
    'clast_grains': (48, {'n': (0, 8), 'record': (8, 8), 'n_fault': (16, 8), 'fault': (24, 8), 'n_note': (32, 8), 'note': (40, 8)}),
    'clast_harmonics': (16, {'degree': (0, 4), 'coefficient': (8, 8)}),
    'clast_synthesize_config': (104, {'form': (0, 48), 'size': (48, 8), 'measure': (56, 4), 'rough': (64, 8), 'tolerance': (72, 8), 'decay': (80, 8), 'degrees': (88, 4), 'faces': (92, 4), 'seed': (96, 8)}),
    'clast_synthesize_report': (56, {'flatness': (0, 8), 'elongation': (8, 8), 'amplitude': (16, 8), 'normal_roundness': (24, 8), 'angularity': (32, 8), 'volume': (40, 8), 'n_triangle': (48, 4)}),
    'clast_collider': (64, {'monomers': (0, 8), 'radius': (8, 8), 'mass': (16, 8), 'velocity': (24, 24), 'speed_rms': (48, 8), 'settling_speed': (56, 8)}),
    'clast_medium': (136, {'temperature': (0, 8), 'viscosity': (8, 8), 'density': (16, 8), 'particle_density': (24, 8), 'mean_free_path': (32, 8), 'shear': (40, 8), 'dissipation': (48, 8), 'shear_constant': (56, 8), 'speed_rms': (64, 8), 'gravity': (72, 8), 'efficiency': (80, 8), 'constant': (88, 8), 'constant_d': (96, 4), 'additive': (104, 8), 'additive_d': (112, 4), 'product': (120, 8), 'product_d': (128, 4), 'settling_law': (132, 4)}),
    'clast_kernel_info': (40, {'name': (0, 8), 'formula': (8, 8), 'source': (16, 8), 'needs': (24, 4), 'mechanisms': (28, 4), 'is_model': (32, 1)}),
    'clast_kernel_range': (48, {'owner': (0, 8), 'quantity': (8, 8), 'low': (16, 8), 'high': (24, 8), 'source': (32, 8), 'instead': (40, 8)}),
    'clast_range_use': (40, {'n': (0, 8), 'outside': (8, 8), 'row': (16, 4), 'value': (24, 8), 'excess': (32, 8)}),
    'clast_range_report': (88, {'start': (0, 40), 'collisions': (40, 40), 'time': (80, 8)}),
    'clast_sticking': (80, {'law': (0, 4), 'film_viscosity': (8, 8), 'film_thickness': (16, 8), 'asperity': (24, 8), 'restitution': (32, 8), 'critical_stokes': (40, 8), 'stokes_exponent': (48, 8), 'adhesion': (56, 8), 'young': (64, 8), 'poisson': (72, 8)}),
    'clast_impact': (56, {'speed': (0, 8), 'radius': (8, 16), 'mass': (24, 16), 'curvature': (40, 16)}),
    'clast_site': (40, {'position': (0, 24), 'cost': (24, 8), 'number': (32, 4)}),
    'clast_comm': (80, {'rank': (0, 4), 'n_rank': (4, 4), 'send': (8, 8), 'take': (16, 8), 'least': (24, 8), 'broadcast': (32, 8), 'gather': (40, 8), 'context': (48, 8), 'sum': (56, 8), 'exchange': (64, 8), 'partition': (72, 8)}),
    'clast_mesh': (24, {'n_vert': (0, 4), 'n_tri': (4, 4), 'vert': (8, 8), 'tri': (16, 8)}),
    'clast_mass': (104, {'volume': (0, 8), 'centroid': (8, 24), 'inertia': (32, 72)}),
    'clast_hit': (40, {'t': (0, 8), 'tri': (8, 4), 'bary': (16, 24)}),
    'clast_mesh_read_report': (1384, {'format': (0, 4), 'unit': (4, 16), 'is_binary': (20, 1), 'is_big_endian': (21, 1), 'n_byte': (24, 8), 'n_trailing': (32, 8), 'n_part': (40, 4), 'n_facet': (48, 8), 'n_polygon': (56, 4), 'n_concave': (60, 4), 'n_crossing': (64, 4), 'n_short': (68, 4), 'n_repeated': (72, 4), 'n_zero_normal': (76, 4), 'n_wrong_normal': (80, 4), 'n_ignored': (88, 8), 'n_warning': (96, 4), 'warning': (100, 1280)}),
    'clast_mesh_write_options': (24, {'format': (0, 4), 'unit': (8, 8), 'name': (16, 8)}),
    'clast_mesh_part': (96, {'n_triangle': (0, 4), 'n_open_edge': (4, 4), 'closed': (8, 1), 'oriented': (9, 1), 'manifold': (10, 1), 'inside_out': (11, 1), 'genus': (12, 4), 'depth': (16, 4), 'outermost': (20, 4), 'winding': (24, 4), 'volume': (32, 8), 'area': (40, 8), 'low': (48, 24), 'high': (72, 24)}),
    'clast_mesh_fault': (385, {'blocking': (0, 1), 'code': (1, 24), 'text': (25, 360)}),
    'clast_mesh_check_result': (6368, {'n_vertex': (0, 4), 'n_triangle': (4, 4), 'closed': (8, 1), 'oriented': (9, 1), 'manifold': (10, 1), 'n_edge': (12, 4), 'n_part': (16, 4), 'n_doubled': (20, 4), 'part': (24, 8), 'euler': (32, 8), 'genus': (40, 4), 'n_open_edge': (44, 4), 'n_open_loop': (48, 4), 'n_repeated': (52, 4), 'largest_hole': (56, 8), 'n_nonmanifold_edge': (64, 4), 'n_nonmanifold_vertex': (68, 4), 'n_misoriented_edge': (72, 4), 'n_inside_out': (76, 4), 'n_nested': (80, 4), 'n_flat': (84, 4), 'n_degenerate': (88, 4), 'n_duplicate': (92, 4), 'n_unused_vertex': (96, 4), 'n_intersection': (104, 8), 'n_touch': (112, 8), 'intersection_complete': (120, 1), 'intersection': (124, 8), 'n_body': (132, 4), 'extent': (136, 8), 'volume': (144, 8), 'volume_divergence': (152, 8), 'volume_spread': (160, 8), 'area': (168, 8), 'area_heron': (176, 8), 'hull_volume': (184, 8), 'weld_tolerance': (192, 8), 'n_open_after_weld': (200, 4), 'n_fault': (204, 4), 'fault': (208, 6160)}),
    'clast_mesh_repair_config': (56, {'weld': (0, 4), 'weld_tolerance': (8, 8), 'drop': (16, 1), 'split': (17, 1), 'split_tolerance': (24, 8), 'loose': (32, 1), 'orient': (33, 1), 'fill': (34, 1), 'fill_size': (40, 8), 'separate': (48, 1), 'unite': (49, 1), 'keep': (52, 4)}),
    'clast_mesh_repair_report': (104, {'n_merged': (0, 4), 'weld_distance': (8, 8), 'n_collapsed': (16, 4), 'n_degenerate': (20, 4), 'n_duplicate': (24, 4), 'n_split': (28, 4), 'n_loose': (32, 4), 'n_turned': (36, 4), 'n_conflict': (40, 4), 'n_hole_filled': (44, 4), 'n_fill_triangle': (48, 4), 'n_hole_left': (52, 4), 'n_separated': (56, 4), 'n_part_dropped': (60, 4), 'n_triangle_before': (64, 4), 'n_triangle_after': (68, 4), 'volume_before': (72, 8), 'volume_after': (80, 8), 'area_before': (88, 8), 'area_after': (96, 8)}),
    'clast_mesh_deviation': (40, {'forward': (0, 8), 'backward': (8, 8), 'hausdorff': (16, 8), 'mean': (24, 8), 'n_sample': (32, 8)}),
    'clast_mesh_simplify_report': (104, {'n_triangle_before': (0, 4), 'n_triangle_after': (4, 4), 'reached': (8, 1), 'volume_before': (16, 8), 'volume_after': (24, 8), 'volume_drift': (32, 8), 'correction': (40, 8), 'area_before': (48, 8), 'area_after': (56, 8), 'deviation': (64, 40)}),
    'clast_pack_config': (776, {'dem': (0, 208), 'curve': (208, 8), 'spread': (216, 4), 'count': (220, 4), 'size_meaning': (224, 4), 'shapes': (232, 16), 'shape_weight': (248, 16), 'unit': (264, 8), 'hull': (272, 1), 'faces': (276, 4), 'ellipsoids': (280, 1), 'form_law': (281, 1), 'flatness_mean': (288, 8), 'flatness_deviation': (296, 8), 'elongation_mean': (304, 8), 'elongation_deviation': (312, 8), 'density': (320, 16), 'density_of': (336, 4), 'density_weight': (344, 16), 'material': (360, 16), 'contacts': (376, 16), 'mass': (392, 8), 'seed': (400, 8), 'start': (408, 8), 'start_unit': (416, 8), 'start_columns': (424, 8), 'start_diameter': (432, 8), 'start_frame': (440, 8), 'container': (448, 8), 'container_unit': (456, 8), 'generator': (464, 4), 'spacing': (472, 8), 'fill_low': (480, 8), 'fill_high': (488, 8), 'first_low': (496, 8), 'first_high': (504, 8), 'initial_speed': (512, 8), 'random_turn': (520, 1), 'shake_amplitude': (528, 8), 'shake_period': (536, 8), 'shaking_time': (544, 8), 'shake_from_start': (552, 1), 'damping': (560, 8), 'rule': (568, 4), 'height_change': (576, 8), 'check_time': (584, 8), 'still_speed': (592, 8), 'max_steps': (600, 8), 'max_damping_time': (608, 8), 'wall': (616, 16), 'outlet': (632, 16), 'wall_forces': (648, 1), 'stages': (656, 16), 'load_rate': (672, 8), 'load_tolerance': (680, 8), 'load_rest': (688, 8), 'max_load_time': (696, 8), 'energy': (704, 1), 'layer': (712, 8), 'cut': (720, 8), 'trim': (728, 8), 'series_time': (736, 8), 'frame_time': (744, 8), 'checkpoint_time': (752, 8), 'resume': (760, 8), 'force': (768, 1)}),
    'clast_pack_wall': (240, {'name': (0, 32), 'number': (32, 4), 'mesh': (40, 24), 'motion': (64, 144), 'press': (208, 24), 'area': (232, 8)}),
    'clast_pack_input': (104, {'grading': (0, 8), 'curve': (8, 8), 'n_shape': (16, 4), 'shape': (24, 8), 'start': (32, 8), 'container': (40, 8), 'container_closed': (48, 8), 'n_wall': (56, 4), 'wall': (64, 8), 'start_snapshot': (72, 8), 'n_start_snapshot': (80, 8), 'start_step': (88, 8), 'start_shift': (96, 8)}),
    'clast_pack_ranks': (72, {'n': (0, 4), 'n_idle': (4, 4), 'n_balance': (8, 8), 'n_migrated': (16, 8), 'ghosts': (24, 8), 'messages': (32, 8), 'step_bytes': (40, 8), 'list_bytes': (48, 8), 'imbalance': (56, 8), 'is_zoltan': (64, 1)}),
    'clast_pack_hull': (80, {'shape': (0, 64), 'n_triangle': (64, 4), 'volume_added': (72, 8)}),
    'clast_pack_source': (360, {'curve': (0, 24), 'grading': (24, 8), 'n_shape': (32, 4), 'shape': (40, 8), 'n_hull': (48, 4), 'hull': (56, 8), 'container': (64, 24), 'container_closed': (88, 24), 'start': (112, 128), 'n_wall': (240, 4), 'wall': (248, 8), 'input': (256, 104)}),
    'clast_pairs_config': (16, {'radius': (0, 8), 'n_shell': (8, 4), 'outside': (12, 4)}),
    'clast_estimate': (32, {'value': (0, 8), 'low': (8, 8), 'high': (16, 8), 'resolved': (24, 1)}),
    'clast_pair_integral': (72, {'estimate': (0, 32), 'scale': (32, 8), 'window': (40, 8), 'n_pair': (48, 8), 'n_needed': (56, 8), 'fit_p': (64, 8)}),
    'clast_bed': (96, {'kind': (0, 4), 'is_part': (4, 1), 'centre': (8, 16), 'radius': (24, 8), 'low': (32, 16), 'high': (48, 16), 'floor': (64, 8), 'ceiling': (72, 8), 'shift': (80, 8), 'surface': (88, 8)}),
    'clast_porosity_options': (40, {'method': (0, 4), 'layer': (8, 8), 'cut': (16, 8), 'trim': (24, 8), 'at_slice': (32, 1)}),
    'clast_porosity_bulk': (40, {'porosity': (0, 8), 'z_low': (8, 8), 'z_high': (16, 8), 'solid': (24, 8), 'top': (32, 8)}),
    'clast_bed_walls': (24, {'size': (0, 8), 'radius': (8, 8), 'ratio': (16, 8)}),
    'clast_bed_beyond': (24, {'n': (0, 4), 'depth': (8, 8), 'solid': (16, 8)}),
    'clast_porosity_core': (32, {'depth': (0, 8), 'porosity': (8, 8), 'error': (16, 8), 'share': (24, 8)}),
    'clast_radial_options': (12, {'method': (0, 4), 'n_ring': (4, 4), 'n_point': (8, 4)}),
    'clast_pore_options': (40, {'n_point': (0, 8), 'n_bin': (8, 4), 'period': (16, 24)}),
    'clast_mean': (40, {'n': (0, 4), 'mean': (8, 8), 'deviation': (16, 8), 'low': (24, 8), 'high': (32, 8)}),
    'clast_bed_known': (40, {'bed': (0, 8), 'is_own': (8, 1), 'own': (16, 8), 'contacts': (24, 8), 'velocities': (32, 8)}),
    'clast_bed_options': (96, {'porosity': (0, 40), 'floor': (40, 8), 'gap': (48, 8), 'core': (56, 8), 'local': (64, 1), 'rings': (68, 4), 'pores': (72, 8), 'fields': (80, 8), 'chains': (88, 1)}),
    'clast_form_inputs': (1104, {'n_grain': (0, 8), 'has_deviation': (8, 1), 'is_independent': (9, 1), 'flatness_mean': (16, 8), 'flatness_deviation': (24, 8), 'elongation_mean': (32, 8), 'elongation_deviation': (40, 8), 'equancy_mean': (48, 8), 'equancy_deviation': (56, 8), 'single': (64, 208), 'mixture': (272, 832)}),
    'clast_model_term': (24, {'feature': (0, 8), 'coefficient': (8, 8), 'unit': (16, 8)}),
    'clast_model_range': (24, {'feature': (0, 8), 'low': (8, 8), 'high': (16, 8)}),
    'clast_porosity_model': (128, {'name': (0, 8), 'source': (8, 8), 'kind': (16, 4), 'intercept': (24, 8), 'n_term': (32, 4), 'term': (40, 8), 'n_range': (48, 4), 'range': (56, 8), 'covariance': (64, 8), 'rounding': (72, 8), 'deviation': (80, 8), 'n_bed': (88, 8), 'r2': (96, 8), 'cv_mean_error': (104, 8), 'cv_median_error': (112, 8), 'leverage_limit': (120, 8)}),
    'clast_prediction': (128, {'porosity': (0, 8), 'standard_error': (8, 8), 'model_error': (16, 8), 'coefficient_error': (24, 8), 'sampling_error': (32, 8), 'in_range': (40, 1), 'leverage': (48, 8), 'n_outside': (56, 4), 'outside': (60, 64)}),
    'clast_predict_given': (16, {'model': (0, 8), 'has_table': (8, 1), 'each': (9, 1), 'takes_columns': (10, 1)}),
    'clast_porosity_fit_config': (80, {'target': (0, 8), 'columns': (8, 8), 'group': (16, 8), 'n_term': (24, 4), 'use': (32, 8), 'correlation_limit': (40, 8), 'n_fold': (48, 4), 'n_repeat': (52, 4), 'score': (56, 4), 'validation': (60, 4), 'n_permutation': (64, 4), 'seed': (72, 8)}),
    'clast_fit_note': (1025, {'is_of_table': (0, 1), 'text': (1, 1024)}),
    'clast_image': (24, {'width': (0, 4), 'height': (4, 4), 'rgba': (8, 8), 'pixel_size': (16, 8)}),
    'clast_render_config': (160, {'width': (0, 4), 'height': (4, 4), 'samples': (8, 4), 'ambient_rays': (12, 4), 'projection': (16, 4), 'up': (20, 4), 'azimuth': (24, 8), 'elevation': (32, 8), 'field_of_view': (40, 8), 'zoom': (48, 8), 'colour': (56, 4), 'tint': (64, 8), 'scale': (72, 4), 'shading': (76, 4), 'background': (80, 4), 'ground': (84, 1), 'cut': (88, 4), 'cut_position': (96, 8), 'colour_bar': (104, 1), 'scale_bar': (105, 1), 'unit': (112, 8), 'sun_azimuth': (120, 8), 'sun_elevation': (128, 8), 'sun_radius': (136, 8), 'ambient': (144, 8), 'seed': (152, 8)}),
    'clast_report_config': (24, {'title': (0, 8), 'rows': (8, 4), 'view': (12, 1), 'triangles': (16, 4), 'picture_mb': (20, 4)}),
    'clast_fluid': (24, {'density': (0, 8), 'viscosity': (8, 8), 'gravity': (16, 8)}),
    'clast_drag': (16, {'stokes': (0, 8), 'newton': (8, 8)}),
    'clast_settling': (32, {'velocity': (0, 8), 'reynolds': (8, 8), 'drag_coefficient': (16, 8), 'in_range': (24, 1)}),
    'clast_porous': (16, {'permeability': (0, 8), 'core': (8, 8)}),
    'clast_spheres': (24, {'n': (0, 4), 'centre': (8, 8), 'radius': (16, 8)}),
    'clast_part': (104, {'kind': (0, 4), 'semi_axes': (8, 24), 'position': (32, 24), 'orientation': (56, 32), 'vert': (88, 8), 'tri': (96, 8)}),
    'clast_parts': (16, {'n': (0, 4), 'part': (8, 8)}),
    'clast_material': (112, {'density': (0, 8), 'is_mixed': (8, 1), 'centre': (16, 24), 'inertia': (40, 72)}),
    'clast_shape': (336, {'kind': (0, 4), 'name': (8, 8), 'semi_axes': (16, 24), 'mesh': (40, 24), 'spheres': (64, 24), 'parts': (88, 16), 'volume': (104, 8), 'length': (112, 8), 'bounding_radius': (120, 8), 'inertia': (128, 72), 'own': (200, 112), 'source_origin': (312, 24)}),
    'clast_named_spheres': (32, {'name': (0, 8), 'spheres': (8, 24)}),
    'clast_state': (96, {'assembly': (0, 8), 'n_spheres': (8, 4), 'spheres': (16, 8), 'n_table': (24, 4), 'table': (32, 8), 'config': (40, 8), 'unit': (48, 16), 'version': (64, 32)}),
    'clast_packing_options': (16, {'columns': (0, 8), 'diameter': (8, 8)}),
    'clast_packing_frame': (88, {'step': (0, 8), 'has_box': (8, 3), 'is_periodic': (11, 3), 'low': (16, 24), 'high': (40, 24), 'tilt': (64, 24)}),
    'clast_packing_report': (104, {'snapshot': (0, 8), 'n_snapshot': (8, 8), 'frame': (16, 88)}),
    'clast_export_options': (40, {'format': (0, 4), 'level': (4, 4), 'points': (8, 1), 'colour': (12, 4), 'unit': (16, 8), 'values': (24, 8), 'frame': (32, 8)}),
    'clast_export_report': (64, {'format': (0, 4), 'n_vertex': (8, 8), 'n_triangle': (16, 8), 'unit': (24, 8), 'facet_ratio': (32, 8), 'clump_ratio': (40, 8), 'ellipsoid_ratio': (48, 8), 'has_ids': (56, 1), 'ids_kept': (57, 1), 'id_offset': (60, 4)}),
    'clast_export_given': (16, {'format': (0, 4), 'has_table': (4, 1), 'is_run': (5, 1), 'points': (6, 1), 'assembly': (8, 8)}),
    'clast_bootstrap': (24, {'n_resample': (0, 4), 'level': (8, 8), 'seed': (16, 8)}),
    'clast_sample_summary': (184, {'n': (0, 8), 'n_left_out': (8, 8), 'mean': (16, 8), 'deviation': (24, 8), 'deviation_ml': (32, 8), 'skewness': (40, 8), 'kurtosis': (48, 8), 'low': (56, 8), 'high': (64, 8), 'quantile': (72, 56), 'mean_low': (128, 8), 'mean_high': (136, 8), 'deviation_low': (144, 8), 'deviation_high': (152, 8), 'shapiro_w': (160, 8), 'shapiro_p': (168, 8), 'is_constant': (176, 1)}),
    'clast_statistics': (80, {'n': (0, 4), 'name': (8, 8), 'summary': (16, 8), 'r': (24, 8), 'r_p': (32, 8), 'n_pca': (40, 4), 'pca_column': (48, 8), 'variance': (56, 8), 'explained': (64, 8), 'loading': (72, 8)}),
    'clast_histogram': (48, {'n_bin': (0, 4), 'edge': (8, 8), 'count': (16, 8), 'density': (24, 8), 'mean': (32, 8), 'deviation_ml': (40, 8)}),
    'clast_grain_statistics': (320, {'set': (0, 208), 'statistics': (208, 80), 'zingg': (288, 32)}),
    'clast_monitor': (48, {'report': (0, 8), 'stop': (8, 8), 'note': (16, 8), 'context': (24, 8), 'n_word': (32, 4), 'word': (40, 8)}),
    'clast_study_config': (120, {'run': (0, 8), 'config': (8, 8), 'argument': (16, 16), 'set': (32, 16), 'vary': (48, 16), 'design': (64, 4), 'table': (72, 8), 'seeds': (80, 4), 'seed': (88, 8), 'keep': (96, 16), 'shard': (112, 8)}),
    'clast_study_item': (32, {'row': (0, 8), 'folder': (8, 8), 'n_argument': (16, 4), 'argument': (24, 8)}),
    'clast_study_worker': (40, {'has_folder': (0, 1), 'has_seed': (1, 1), 'has_resume': (2, 1), 'start': (8, 8), 'wait': (16, 8), 'stop': (24, 8), 'context': (32, 8)}),
    'clast_study_report': (64, {'n_run': (0, 8), 'n_before': (8, 8), 'n_done': (16, 8), 'n_failed': (24, 8), 'n_other': (32, 8), 'first_failed': (40, 8), 'n_unknown': (48, 4), 'first_unknown': (52, 4), 'n_unconverged': (56, 8)}),
    'clast_study_outcomes': (32, {'n_run': (0, 8), 'n_done': (8, 8), 'n_failed': (16, 8), 'n_unconverged': (24, 8)}),
    'clast_column': (32, {'name': (0, 8), 'unit': (8, 8), 'number': (16, 8), 'text': (24, 8)}),
    'clast_table': (32, {'name': (0, 8), 'n_column': (8, 4), 'n_row': (16, 8), 'column': (24, 8)}),
    'clast_csv_options': (8, {'separator': (0, 1), 'comment': (1, 1), 'no_comment': (2, 1), 'header': (4, 4)}),
    'clast_csv_report': (48, {'separator': (0, 1), 'has_header': (1, 1), 'n_line': (8, 8), 'n_comment': (16, 8), 'n_blank': (24, 8), 'n_missing': (32, 8), 'n_renamed': (40, 4)}),
    'clast_voxels': (64, {'n': (0, 12), 'edge': (16, 24), 'label': (40, 8), 'grey': (48, 8), 'threshold': (56, 8)}),
    'clast_voxel_label': (40, {'label': (0, 4), 'n_voxel': (8, 8), 'low': (16, 12), 'high': (28, 12)}),
    'clast_volume': (56, {'n': (0, 12), 'edge': (16, 24), 'unit_m': (40, 8), 'value': (48, 8)}),
    'clast_volume_options': (56, {'n': (0, 12), 'type': (12, 4), 'is_big_endian': (16, 1), 'skip': (24, 8), 'edge': (32, 24)}),
    'clast_points': (56, {'n': (0, 8), 'dimension': (8, 4), 'x': (16, 8), 'stride': (24, 8), 'axis_stride': (32, 8), 'weight': (40, 8), 'weight_stride': (48, 8)}),
    'clast_workspace_policy': (40, {'tests': (0, 4), 'tests_every': (4, 4), 'tests_moved': (8, 8), 'cells': (16, 4), 'cells_every': (20, 4), 'cells_level': (24, 8), 'pairs_every': (32, 4), 'pairs_most': (36, 4)}),
    'clast_workspace_calls': (64, {'n_call': (0, 8), 'n_test': (8, 8), 'n_cut': (16, 8), 'since_test': (24, 8), 'since_cut': (32, 8), 'moved': (40, 8), 'p_change': (48, 8), 'n_pairs': (56, 8)}),
    'clast_workspace_step': (16, {'dt': (0, 8), 'step': (8, 8)}),
    'clast_collide_config': (304, {'kernel': (0, 4), 'medium': (8, 136), 'alpha': (144, 8), 'sticking': (152, 80), 'out_of_range': (232, 4), 'radius_law': (236, 4), 'collisions': (240, 4), 'monomer_radius': (248, 8), 'fractal_dimension': (256, 8), 'fractal_prefactor': (264, 8), 'leap': (272, 8), 'block': (280, 4), 'self_collisions': (284, 1), 'keep_positions': (285, 1), 'seed': (288, 8), 'count_unit': (296, 8)}),
    'clast_spectrum': (232, {'history': (0, 32), 'spectrum': (32, 32), 'gel_time': (64, 8), 'gel_size': (72, 8), 'n_gelled': (80, 4), 'is_gelation': (84, 1), 'exact_gel_time': (88, 8), 'volume_fraction': (96, 8), 'law_M1': (104, 8), 'law_M2': (112, 8), 'is_drawn': (120, 1), 'mass_error': (128, 8), 'n_evaluation': (136, 8), 'range': (144, 88)}),
    'clast_agglomerate_config': (512, {'decompose': (0, 152), 'collide': (152, 304), 'kernel': (456, 8), 'duration': (464, 8), 'n_step': (472, 4), 'repeats': (476, 4), 'rebuild': (480, 4), 'change_level': (488, 8), 'fixed': (496, 4), 'depth': (504, 8)}),
    'clast_agglomeration': (272, {'history': (0, 32), 'particles': (32, 32), 'members': (64, 32), 'spectrum': (96, 32), 'n_rebuilt': (128, 4), 'n_snapshot': (132, 4), 'n_unresolved': (136, 4), 'n_repeated': (144, 8), 'n_cell': (152, 4), 'volume_fraction': (160, 8), 'has_exact': (168, 1), 'has_fixed': (169, 1), 'is_gelation': (170, 1), 'n_gelled': (172, 4), 'gel_time': (176, 8), 'range': (184, 88)}),
    'clast_aggregate_params': (336, {'mode': (0, 4), 'core_size': (8, 8), 'core_meaning': (16, 4), 'core_density': (24, 8), 'coat_weight': (32, 16), 'class_limit': (48, 16), 'coat_density': (64, 16), 'size': (80, 16), 'size_law': (96, 4), 'size_mean': (104, 8), 'size_deviation': (112, 8), 'size_shape': (120, 8), 'size_low': (128, 8), 'size_high': (136, 8), 'n_particle': (144, 4), 'size_draw': (148, 1), 'size_by_mass': (149, 1), 'replicate': (152, 4), 'size_meaning': (156, 4), 'order': (160, 4), 'cone': (168, 8), 'rays': (176, 4), 'orientations': (180, 4), 'axis': (184, 8), 'origin': (192, 4), 'target': (196, 4), 'start': (200, 8), 'max_tries': (208, 4), 'approach': (212, 4), 'walk_step': (216, 8), 'contact': (224, 4), 'flavour': (228, 4), 'march_coarse': (232, 8), 'march_fine': (240, 8), 'march_steps': (248, 4), 'march_vertices': (252, 4), 'envelope': (256, 16), 'envelope_every': (272, 4), 'envelope_rays': (276, 4), 'envelope_length': (280, 8), 'solid_union': (288, 1), 'fall_speed': (289, 1), 'permeability': (292, 4), 'stop_mass': (296, 8), 'stop_size': (304, 8), 'stop_porosity': (312, 8), 'pick': (320, 4), 'n_final': (324, 4), 'seed': (328, 8)}),
    'clast_aggregate_result': (528, {'n_particle': (0, 4), 'n_grain': (4, 4), 'n_contact': (8, 4), 'n_cluster': (12, 4), 'n_grain_all': (16, 4), 'contact': (20, 4), 'mass': (24, 8), 'solid_sum': (32, 8), 'solid_union': (40, 8), 'solid_union_error': (48, 8), 'n_envelope': (56, 4), 'envelope': (64, 280), 'porosity': (344, 56), 'd_agg': (400, 8), 'density': (408, 8), 'radius_of_gyration': (416, 8), 'settling_velocity': (424, 8), 'settling_velocity_permeable': (432, 8), 'permeable': (440, 4), 'coat_porosity': (448, 8), 'coat_grain': (456, 8), 'permeability': (464, 8), 'drag_permeable': (472, 8), 'max_overlap': (480, 8), 'max_overlap_relative': (488, 8), 'n_lost': (496, 4), 'stop': (500, 4), 'contact_s': (504, 8), 'envelope_s': (512, 8), 'wall_s': (520, 8)}),
    'clast_aggregate_config': (568, {'params': (0, 336), 'core': (336, 8), 'coat': (344, 16), 'core_spheres': (360, 8), 'coat_spheres': (368, 16), 'fill_spheres': (384, 4), 'fill': (388, 4), 'unit': (392, 8), 'accept_faults': (400, 1), 'sizes': (408, 8), 'size_column': (416, 8), 'size_unit': (424, 8), 'fit': (432, 1), 'observed_size': (440, 8), 'observed_size_error': (448, 8), 'observed_density': (456, 8), 'observed_density_error': (464, 8), 'observed_velocity': (472, 8), 'observed_velocity_error': (480, 8), 'fit_packing': (488, 16), 'fit_repeats': (504, 4), 'fit_replicate_max': (508, 4), 'repeats': (512, 4), 'confidence': (520, 8), 'checkpoint_every': (528, 4), 'picture': (532, 1), 'printable': (533, 1), 'neck': (536, 8), 'spacing': (544, 8), 'force': (552, 1), 'resume': (560, 8)}),
    'clast_aggregate_source': (216, {'core': (0, 128), 'coat': (128, 8), 'n_coat': (136, 4), 'sizes': (144, 40), 'input': (184, 32)}),
    'clast_aggregate_report': (128, {'n': (0, 4), 'result': (8, 8), 'confidence': (16, 8), 'folder': (24, 8), 'is_printable': (32, 1), 'printable': (40, 88)}),
    'clast_structure_options': (112, {'envelope': (0, 40), 'solid': (40, 32), 'fluid': (72, 24), 'n_line': (96, 4), 'n_direction': (100, 4), 'n_first': (104, 4), 'alpha': (108, 1)}),
    'clast_cloud_columns': (80, {'columns': (0, 16), 'velocity_columns': (16, 16), 'radius_column': (32, 8), 'diameter_column': (40, 8), 'mass_column': (48, 8), 'weight_column': (56, 8), 'variable_column': (64, 8), 'unit': (72, 8)}),
    'clast_evolve_config': (584, {'medium': (0, 136), 'kernel': (136, 8), 'alpha': (144, 8), 'sticking': (152, 80), 'out_of_range': (232, 4), 'shapes': (240, 16), 'shape_weight': (256, 16), 'density': (272, 16), 'unit': (288, 8), 'accept_faults': (296, 1), 'curve': (304, 8), 'particles': (312, 4), 'weight': (320, 8), 'release': (328, 8), 'points': (336, 8), 'columns': (344, 16), 'diameter_column': (360, 8), 'frame': (368, 8), 'dataset': (376, 8), 'domain': (384, 8), 'floor': (392, 4), 'sides': (396, 4), 'open_top': (400, 1), 'wind': (408, 8), 'field': (416, 8), 'field_columns': (424, 8), 'wind_shear': (432, 8), 'eddy_diffusivity': (440, 8), 'brownian': (448, 1), 'fall': (452, 4), 'structure': (456, 1), 'collision_radius': (460, 4), 'meeting': (464, 4), 'walk_step': (472, 8), 'max_tries': (480, 4), 'even': (484, 4), 'change_level': (488, 8), 'duration': (496, 8), 'rows': (504, 4), 'step_error': (512, 8), 'time_step': (520, 8), 'seed': (528, 8), 'keep': (536, 4), 'bed_width': (544, 8), 'frames': (552, 4), 'checkpoint_time': (560, 8), 'resume': (568, 8), 'force': (576, 1)}),
    'clast_evolve_result': (776, {'n_start': (0, 8), 'n_particle': (8, 8), 'n_event': (16, 8), 'n_deposit': (24, 8), 'n_out': (32, 8), 'n_step': (40, 8), 'time': (48, 8), 'mass_start': (56, 8), 'mass': (64, 8), 'mass_deposit': (72, 8), 'mass_out': (80, 8), 'n_wall': (88, 8), 'mass_wall': (96, 8), 'gathered': (104, 8), 'gathered_top': (112, 8), 'weight_words': (120, 160), 'points_words': (280, 256), 'is_field_apart': (536, 1), 'mass_balance': (544, 8), 'number_balance': (552, 8), 'n_cut': (560, 8), 'n_test': (568, 8), 'n_unresolved': (576, 8), 'grains_most': (584, 8), 'deposit_diameter': (592, 8), 'deposit_porosity': (600, 8), 'deposit_speed': (608, 8), 'deposit_grains': (616, 8), 'volume_fraction': (624, 8), 'fall_reynolds': (632, 8), 'fall_reynolds_limit': (640, 8), 'fractal_dimension': (648, 8), 'fractal_error': (656, 8), 'range': (664, 40), 'hash': (704, 8), 'wall_s': (712, 8), 'n_frame': (720, 4), 'n_written': (724, 4), 'bed_width': (728, 8), 'bed_height': (736, 8), 'is_bed_empty': (744, 1), 'bed_mass': (752, 8), 'bed_least': (760, 8), 'folder': (768, 8)}),
    'clast_grains_options': (136, {'kind': (0, 4), 'hull': (4, 1), 'degree': (8, 4), 'level': (12, 4), 'spacing': (16, 8), 'volume': (24, 56), 'dataset': (80, 8), 'has_threshold': (88, 1), 'threshold': (96, 8), 'least_voxels': (104, 8), 'columns': (112, 8), 'folder': (120, 8), 'unit': (128, 8)}),
    'clast_pack_result': (1144, {'n_hull': (0, 4), 'hull': (8, 8), 'dem': (16, 184), 'phase': (200, 4), 'converged': (204, 1), 'hash': (208, 8), 'n_fill': (216, 4), 'n_waited': (224, 8), 'wall_s': (232, 8), 'step_s': (240, 8), 'clocked_steps': (248, 8), 'grain_steps': (256, 8), 'n_outside': (264, 4), 'porosity_state': (268, 4), 'porosity': (272, 8), 'porosity_least': (280, 8), 'cut': (288, 8), 'z_low': (296, 8), 'z_high': (304, 8), 'top': (312, 8), 'untrimmed': (320, 8), 'trim': (328, 8), 'walls': (336, 24), 'wall_share': (360, 8), 'mass_wanted': (368, 8), 'n_loose': (376, 4), 'is_moving': (380, 1), 'fell': (381, 1), 'sank': (384, 8), 'still_diameters': (392, 8), 'own_density': (400, 8), 'given_density': (408, 8), 'flatness': (416, 16), 'elongation': (432, 16), 'n_frame': (448, 8), 'frame_interval': (456, 8), 'n_overlap': (464, 8), 'deepest_start': (472, 8), 'start_snapshot': (480, 8), 'n_start_snapshot': (488, 8), 'start_step': (496, 8), 'n_stage': (504, 4), 'n_left': (512, 8), 'mass_left': (520, 8), 'cell': (528, 96), 'load': (624, 272), 'energy': (896, 176), 'ranks': (1072, 72)}),
    'clast_pairs': (168, {'n': (0, 8), 'n_outside': (8, 8), 'dimension': (16, 4), 'n_shell': (20, 4), 'volume': (24, 8), 'radius': (32, 8), 'n_pair': (40, 8), 'n_repeated': (48, 8), 'edge_error': (56, 8), 'shells': (64, 32), 'integral': (96, 72)}),
    'clast_pores': (48, {'porosity': (0, 8), 'mean': (8, 8), 'sizes': (16, 32)}),
    'clast_bed_findings': (696, {'bed': (0, 96), 'options': (96, 96), 'bulk': (192, 40), 'walls': (232, 24), 'beyond': (256, 24), 'outside': (280, 8), 'core': (288, 32), 'n_overlap': (320, 4), 'max_overlap': (328, 8), 'max_overlap_share': (336, 8), 'mean_coordination': (344, 8), 'knows_contacts': (352, 1), 'profile': (360, 32), 'coordination': (392, 32), 'fabric': (424, 32), 'local': (456, 32), 'radial': (488, 32), 'stress': (520, 32), 'stress_profile': (552, 32), 'fields': (584, 32), 'chains': (616, 32), 'pores': (648, 48)}),
    'clast_fit_data': (152, {'kind': (0, 4), 'beds': (8, 32), 'left_out': (40, 32), 'unread_count': (72, 64), 'n_repeated': (136, 8), 'n_without_bed': (144, 8)}),
    'clast_porosity_fit': (288, {'model': (0, 128), 'ranking': (128, 32), 'trials': (160, 32), 'terms': (192, 32), 'rows': (224, 32), 'n_removed': (256, 4), 'condition': (264, 8), 'r2_held_out': (272, 8), 'p_value': (280, 8)}),
    'clast_decomposition': (5472, {'n': (0, 8), 'n_outside': (8, 8), 'n_here': (16, 8), 'n_test': (24, 8), 'dimension': (32, 4), 'n_capped': (36, 4), 'before': (40, 232), 'n_pass': (272, 4), 'pass': (280, 4608), 'stop': (4888, 4), 'cells': (4896, 128), 'events': (5024, 8), 'events_low': (5032, 8), 'events_high': (5040, 8), 'points_needed': (5048, 8), 'events_cross': (5056, 8), 'points_per_bin': (5064, 8), 'search': (5072, 32), 'cells_bias': (5104, 8), 'bias_estimate': (5112, 8), 'smoothing_bias': (5120, 8), 'beta_dt': (5128, 8), 'volume': (5136, 8), 'seed': (5144, 8), 'pairs': (5152, 168), 'events_by_cells': (5320, 32), 'events_by_pairs': (5352, 32), 'estimator': (5384, 4), 'within': (5392, 72), 'disagree': (5464, 1), 'resolved': (5465, 1), 'keeps_apart': (5466, 1), 'has_drawn': (5467, 1)}),
}

VALUES: dict[str, int] = {
    'CLAST_RADIUS_VOLUME': 0,
    'CLAST_RADIUS_FRACTAL_COLLISION': 1,
    'CLAST_RADIUS_FRACTAL_GYRATION': 2,
    'CLAST_COLLISIONS_NEXT': 0,
    'CLAST_COLLISIONS_POISSON': 1,
    'CLAST_OUT_OF_RANGE_ERROR': 0,
    'CLAST_OUT_OF_RANGE_EXTRAPOLATE': 1,
    'CLAST_SOLVER_MONTE_CARLO': 0,
    'CLAST_SOLVER_SECTIONAL': 1,
    'CLAST_INITIAL_MONO': 0,
    'CLAST_INITIAL_EXPONENTIAL': 1,
    'CLAST_INITIAL_LOGNORMAL': 2,
    'CLAST_INITIAL_TABLE': 3,
    'CLAST_FRAGMENTS_POWER': 0,
    'CLAST_FRAGMENTS_HALVES': 1,
    'CLAST_N_SPECTRUM_NOTE': 3,
    'CLAST_REBUILD_CHANGED': 0,
    'CLAST_REBUILD_ALWAYS': 1,
    'CLAST_REBUILD_NEVER': 2,
    'CLAST_N_AGGLOMERATION_NOTE': 4,
    'CLAST_AGGREGATE_CORE': 0,
    'CLAST_AGGREGATE_CLUSTER': 1,
    'CLAST_CONTACT_EXACT': 0,
    'CLAST_CONTACT_SPHERES': 1,
    'CLAST_CONTACT_MARCH': 2,
    'CLAST_MARCH_RELEASE': 0,
    'CLAST_MARCH_FIGURES': 1,
    'CLAST_SIZE_LENGTH': 0,
    'CLAST_SIZE_VOLUME': 1,
    'CLAST_SIZE_MEAN': 2,
    'CLAST_SIZE_LIST': 0,
    'CLAST_SIZE_UNIFORM': 1,
    'CLAST_SIZE_LOGUNIFORM': 2,
    'CLAST_SIZE_NORMAL': 3,
    'CLAST_SIZE_LOGNORMAL': 4,
    'CLAST_SIZE_WEIBULL': 5,
    'CLAST_ORDER_GIVEN': 0,
    'CLAST_ORDER_SHUFFLED': 1,
    'CLAST_ORDER_DESCENDING': 2,
    'CLAST_ORIGIN_AUTO': 0,
    'CLAST_ORIGIN_CORE': 1,
    'CLAST_ORIGIN_MASS': 2,
    'CLAST_ORIGIN_GRAIN': 3,
    'CLAST_ORIGIN_SPHERE': 4,
    'CLAST_TARGET_CORE': 0,
    'CLAST_TARGET_MASS': 1,
    'CLAST_APPROACH_CENTRAL': 0,
    'CLAST_APPROACH_BALLISTIC': 1,
    'CLAST_APPROACH_DIFFUSIVE': 2,
    'CLAST_PICK_RANDOM': 0,
    'CLAST_PICK_MASS': 1,
    'CLAST_PICK_BROWNIAN': 2,
    'CLAST_STOP_NOT': 0,
    'CLAST_STOP_LIST': 1,
    'CLAST_STOP_MASS': 2,
    'CLAST_STOP_SIZE': 3,
    'CLAST_STOP_POROSITY': 4,
    'CLAST_PERMEABLE_NO': 0,
    'CLAST_PERMEABLE_YES': 1,
    'CLAST_PERMEABLE_THIN': 2,
    'CLAST_PERMEABLE_POROSITY': 3,
    'CLAST_PERMEABLE_REYNOLDS': 4,
    'CLAST_FIT_SIZE': 0,
    'CLAST_FIT_DENSITY': 1,
    'CLAST_FIT_VELOCITY': 2,
    'CLAST_FIT_N_OBSERVABLE': 3,
    'CLAST_FIT_INSIDE': 0,
    'CLAST_FIT_EDGE': 1,
    'CLAST_FIT_NO': 2,
    'CLAST_ENVELOPE_SURFACE_HULL': 0,
    'CLAST_ENVELOPE_SPHERE_HULL': 1,
    'CLAST_ENVELOPE_SPHERE_RAYS': 2,
    'CLAST_ENVELOPE_WRAP': 3,
    'CLAST_ENVELOPE_ENCLOSING_SPHERE': 4,
    'CLAST_ENVELOPE_GYRATION_SPHERE': 5,
    'CLAST_ENVELOPE_ALPHA': 6,
    'CLAST_N_ENVELOPE': 7,
    'CLAST_SERIES_LINE': 0,
    'CLAST_SERIES_STEP': 1,
    'CLAST_SERIES_POINTS': 2,
    'CLAST_SERIES_BAND': 3,
    'CLAST_SERIES_BARS': 4,
    'CLAST_AGGREGATE_CHART_POROSITY': 0,
    'CLAST_AGGREGATE_CHART_DIAMETER': 1,
    'CLAST_AGGREGATE_CHART_DENSITY': 2,
    'CLAST_AGGREGATE_CHART_SIZES': 3,
    'CLAST_AGGREGATE_CHART_RADIAL': 4,
    'CLAST_N_AGGREGATE_CHART': 5,
    'CLAST_DECOMPOSE_CHART_POINTS': 0,
    'CLAST_DECOMPOSE_CHART_CDF': 1,
    'CLAST_DECOMPOSE_CHART_SCORE': 2,
    'CLAST_DECOMPOSE_CHART_EVENTS': 3,
    'CLAST_N_DECOMPOSE_CHART': 4,
    'CLAST_FIT_CHART_FEATURE': 0,
    'CLAST_FIT_CHART_PREDICTED': 1,
    'CLAST_FIT_CHART_RESIDUALS': 2,
    'CLAST_FIT_CHART_LEVERAGE': 3,
    'CLAST_N_FIT_CHART': 4,
    'CLAST_DOMAIN_BOX': 0,
    'CLAST_DOMAIN_CYLINDER': 1,
    'CLAST_DOMAIN_HALF_PIPE': 2,
    'CLAST_DOMAIN_SPHERE': 3,
    'CLAST_DOMAIN_MAP': 4,
    'CLAST_DOMAIN_MESH': 5,
    'CLAST_DOMAIN_TEXT': 256,
    'CLAST_DISCREPANCY_SYMMETRIC': 0,
    'CLAST_DISCREPANCY_CENTRED': 1,
    'CLAST_DISCREPANCY_STAR': 2,
    'CLAST_N_DISCREPANCY': 3,
    'CLAST_SUMS_AUTO': 0,
    'CLAST_SUMS_EXACT': 1,
    'CLAST_SUMS_BINNED': 2,
    'CLAST_VARIANT_FULL': 0,
    'CLAST_VARIANT_FIRST': 1,
    'CLAST_VARIANT_FAST': 2,
    'CLAST_VARIANT_TEST': 3,
    'CLAST_CELLS_BOXES': 0,
    'CLAST_CELLS_COMPONENTS': 1,
    'CLAST_CELLS_BINS': 2,
    'CLAST_CELLS_LABELS': 3,
    'CLAST_CELLS_TREE': 4,
    'CLAST_CELLS_AUTO': 5,
    'CLAST_EVENTS_PAIRS': 0,
    'CLAST_EVENTS_PAPER': 1,
    'CLAST_LOWER_Q20': 0,
    'CLAST_LOWER_SEARCH': 1,
    'CLAST_LOWER_JOINT': 2,
    'CLAST_STATISTIC_A': 0,
    'CLAST_STATISTIC_T': 1,
    'CLAST_OUTSIDE_ERROR': 0,
    'CLAST_OUTSIDE_DROP': 1,
    'CLAST_N_TEST': 5,
    'CLAST_MAX_PASS': 64,
    'CLAST_STOP_UNTESTED': 0,
    'CLAST_STOP_ACCEPTED': 1,
    'CLAST_STOP_TESTED': 2,
    'CLAST_STOP_UNIFORM': 3,
    'CLAST_STOP_NOTHING': 4,
    'CLAST_STOP_ONE_PASS': 5,
    'CLAST_STOP_MAX_PASS': 6,
    'CLAST_STOP_SPLIT': 7,
    'CLAST_STOP_TREE': 8,
    'CLAST_STOP_WHOLE': 9,
    'CLAST_STOP_DEPTH': 10,
    'CLAST_STOP_SPARED': 11,
    'CLAST_N_DECOMPOSITION_NOTE': 3,
    'CLAST_DEM_LINEAR': 0,
    'CLAST_DEM_HERTZ': 1,
    'CLAST_DEM_EXPLICIT': 0,
    'CLAST_DEM_EXACT': 1,
    'CLAST_DEM_DRY': 0,
    'CLAST_DEM_AREA': 1,
    'CLAST_DEM_DMT': 2,
    'CLAST_DEM_JKR': 3,
    'CLAST_DEM_DRAG_FORM': 0,
    'CLAST_DEM_DRAG_STANDARD': 1,
    'CLAST_DEM_ROLL_TORQUE': 0,
    'CLAST_DEM_ROLL_SPRING': 1,
    'CLAST_DEM_CYLINDER': 0,
    'CLAST_DEM_PERIODIC': 1,
    'CLAST_DEM_BOX': 2,
    'CLAST_DEM_OPEN': 3,
    'CLAST_DEM_CELL': 4,
    'CLAST_DEM_SHARED': 0,
    'CLAST_DEM_EACH': 1,
    'CLAST_BORDER_DEPOSIT': 0,
    'CLAST_BORDER_REFLECT': 1,
    'CLAST_BORDER_PERIODIC': 2,
    'CLAST_FALL_FORM': 0,
    'CLAST_FALL_SPHERE': 1,
    'CLAST_FALL_STOKES': 2,
    'CLAST_COLLISION_GYRATION': 0,
    'CLAST_COLLISION_ENCLOSING': 1,
    'CLAST_COLLISION_VOLUME': 2,
    'CLAST_MEETING_AUTO': 0,
    'CLAST_MEETING_BALLISTIC': 1,
    'CLAST_MEETING_DIFFUSIVE': 2,
    'CLAST_MEETING_CENTRAL': 3,
    'CLAST_MEETING_REACTION': 4,
    'CLAST_EVEN_TREE': 0,
    'CLAST_EVEN_BOXES': 1,
    'CLAST_EVEN_WHOLE': 2,
    'CLAST_POINTS_WORDS': 256,
    'CLAST_EVOLVE_BALANCE': 0,
    'CLAST_EVOLVE_SPECTRUM': 1,
    'CLAST_EVOLVE_EVENTS': 2,
    'CLAST_EVOLVE_DEPOSIT': 3,
    'CLAST_EVOLVE_PARTICLES': 4,
    'CLAST_N_EVOLVE_TABLE': 5,
    'CLAST_N_EVOLVE_SAVED': 7,
    'CLAST_FIELD_F64': 0,
    'CLAST_FIELD_I32': 1,
    'CLAST_FIELD_I64': 2,
    'CLAST_FIELD_U64': 3,
    'CLAST_FIELD_BOOL': 4,
    'CLAST_FIELD_CHOICE': 5,
    'CLAST_FIELD_TEXT': 6,
    'CLAST_FIELD_TEXT_LIST': 7,
    'CLAST_FIELD_F64_LIST': 8,
    'CLAST_N_IDLE': 16,
    'CLAST_FILL_LARGEST': 0,
    'CLAST_FILL_RANDOM': 1,
    'CLAST_FILL_PUBLISHED': 2,
    'CLAST_FILL_BY_COUNT': 0,
    'CLAST_FILL_BY_QUALITY': 1,
    'CLAST_FILL_BY_MIN_RADIUS': 2,
    'CLAST_FILL_BY_COVERAGE': 3,
    'CLAST_FORM_FLATNESS': 0,
    'CLAST_FORM_ELONGATION': 1,
    'CLAST_FORM_EQUANCY': 2,
    'CLAST_FORM_ASCHENBRENNER': 3,
    'CLAST_FORM_COREY': 4,
    'CLAST_FORM_DISC_ROD': 5,
    'CLAST_FORM_ILLENBERGER_FORM': 6,
    'CLAST_FORM_ILLENBERGER_ROD': 7,
    'CLAST_FORM_JANKE': 8,
    'CLAST_FORM_KRUMBEIN': 9,
    'CLAST_FORM_MAX_PROJECTION': 10,
    'CLAST_FORM_OBLATE_PROLATE': 11,
    'CLAST_FORM_WENTWORTH': 12,
    'CLAST_N_FORM_FACTOR': 13,
    'CLAST_N_FORM_FEATURE': 26,
    'CLAST_ZINGG_SPHERE': 0,
    'CLAST_ZINGG_DISC': 1,
    'CLAST_ZINGG_ROD': 2,
    'CLAST_ZINGG_BLADE': 3,
    'CLAST_N_ZINGG': 4,
    'CLAST_ROW_MISSING': 0,
    'CLAST_ROW_NOT_NUMBER': 1,
    'CLAST_ROW_INFINITE': 2,
    'CLAST_ROW_NOT_POSITIVE': 3,
    'CLAST_ROW_ABOVE_ONE': 4,
    'CLAST_ROW_NOT_ORDERED': 5,
    'CLAST_N_ROW_FAULT': 6,
    'CLAST_SPREAD_STEP': 0,
    'CLAST_SPREAD_LINEAR': 1,
    'CLAST_SPREAD_MEANS': 2,
    'CLAST_COUNT_MEAN': 0,
    'CLAST_COUNT_EXACT': 1,
    'CLAST_AXES_ELLIPSOID': 0,
    'CLAST_AXES_BOX': 1,
    'CLAST_AXES_FITTED': 2,
    'CLAST_AXES_FERET': 3,
    'CLAST_AXES_PRINCIPAL': 4,
    'CLAST_N_AXES': 5,
    'CLAST_ROUNDNESS_FACES': 1000,
    'CLAST_ROUNDNESS_EDGES': 60,
    'CLAST_ROUNDNESS_VOXELS': 300000,
    'CLAST_GRAINS_AUTO': 0,
    'CLAST_GRAINS_SURFACE': 1,
    'CLAST_GRAINS_SERIES': 2,
    'CLAST_GRAINS_VOXELS': 3,
    'CLAST_GRAINS_POINTS': 4,
    'CLAST_GRAINS_TABLE': 5,
    'CLAST_GRAINS_CLUMP': 6,
    'CLAST_HARMONICS_MAX_DEGREE': 256,
    'CLAST_ROUGH_AMPLITUDE': 0,
    'CLAST_ROUGH_ROUNDNESS': 1,
    'CLAST_ROUGH_ANGULARITY': 2,
    'CLAST_SETTLING_STANDARD': 0,
    'CLAST_SETTLING_STOKES': 1,
    'CLAST_NEEDS_RADIUS': 1,
    'CLAST_NEEDS_MASS': 2,
    'CLAST_NEEDS_VELOCITY': 4,
    'CLAST_NEEDS_TEMPERATURE': 8,
    'CLAST_NEEDS_VISCOSITY': 16,
    'CLAST_NEEDS_SHEAR': 32,
    'CLAST_NEEDS_DISSIPATION': 64,
    'CLAST_NEEDS_SPEED_RMS': 128,
    'CLAST_NEEDS_DENSITY': 256,
    'CLAST_NEEDS_SETTLING': 512,
    'CLAST_MECHANISM_BROWNIAN': 1,
    'CLAST_MECHANISM_SHEAR': 2,
    'CLAST_MECHANISM_TURBULENCE': 4,
    'CLAST_MECHANISM_SETTLING': 8,
    'CLAST_KERNEL_CONSTANT': 0,
    'CLAST_KERNEL_ADDITIVE': 1,
    'CLAST_KERNEL_PRODUCT': 2,
    'CLAST_KERNEL_BROWNIAN': 3,
    'CLAST_KERNEL_BROWNIAN_FREE': 4,
    'CLAST_KERNEL_BROWNIAN_TRANSITION': 5,
    'CLAST_KERNEL_SHEAR_LAMINAR': 6,
    'CLAST_KERNEL_SHEAR_TURBULENT': 7,
    'CLAST_KERNEL_SETTLING': 8,
    'CLAST_KERNEL_INERTIAL': 9,
    'CLAST_KERNEL_BALLISTIC': 10,
    'CLAST_KERNEL_CLOUD_TURBULENCE': 11,
    'CLAST_N_KERNEL': 12,
    'CLAST_N_KERNEL_RANGE': 26,
    'CLAST_STICKING_CONSTANT': 0,
    'CLAST_STICKING_VISCOUS': 1,
    'CLAST_STICKING_LIQUID': 2,
    'CLAST_STICKING_CONTACT': 3,
    'CLAST_COMM_WORDS': 3,
    'CLAST_MESH_ANY': 0,
    'CLAST_MESH_STL': 1,
    'CLAST_MESH_OBJ': 2,
    'CLAST_MESH_PLY': 3,
    'CLAST_MESH_OFF': 4,
    'CLAST_MESH_3MF': 5,
    'CLAST_MESH_N_WARNING': 8,
    'CLAST_MESH_WARNING_SIZE': 160,
    'CLAST_MESH_MAX_FAULT': 16,
    'CLAST_WELD_AUTO': 0,
    'CLAST_WELD_OFF': 1,
    'CLAST_WELD_WITHIN': 2,
    'CLAST_KEEP_ALL': 0,
    'CLAST_KEEP_LARGEST': 1,
    'CLAST_PACK_GENERATE': 0,
    'CLAST_PACK_SHAKE': 1,
    'CLAST_PACK_DAMP': 2,
    'CLAST_PACK_DONE': 3,
    'CLAST_PACK_LOAD': 4,
    'CLAST_PACK_CUBIC': 0,
    'CLAST_PACK_HCP': 1,
    'CLAST_PACK_SHELF': 2,
    'CLAST_PACK_BY_HEIGHT': 0,
    'CLAST_PACK_BY_SPEED': 1,
    'CLAST_PACK_BY_EITHER': 2,
    'CLAST_PACK_DENSITY_SHAPE': 0,
    'CLAST_PACK_DENSITY_CHANCE': 1,
    'CLAST_PACK_DENSITY_CLASS': 2,
    'CLAST_PACK_DENSITY_LIST': 3,
    'CLAST_PACK_POROUS': 0,
    'CLAST_PACK_NO_BED': 1,
    'CLAST_PACK_ABOVE_CUT': 2,
    'CLAST_PACK_TRIMMED': 3,
    'CLAST_PACK_FALLING': 4,
    'CLAST_MAX_SHELL': 64,
    'CLAST_ESTIMATOR_CELLS': 0,
    'CLAST_ESTIMATOR_PAIRS': 1,
    'CLAST_ESTIMATOR_AUTO': 2,
    'CLAST_BED_CYLINDER': 0,
    'CLAST_BED_BOX': 1,
    'CLAST_BED_PERIODIC': 2,
    'CLAST_BED_MESH': 3,
    'CLAST_BED_PERIODIC_3D': 4,
    'CLAST_POROSITY_EXACT': 0,
    'CLAST_POROSITY_SPHERES': 1,
    'CLAST_MODEL_SINGLE': 0,
    'CLAST_MODEL_MIXTURE': 1,
    'CLAST_MODEL_COLUMNS': 2,
    'CLAST_N_MIXTURE_FEATURE': 104,
    'CLAST_N_PUBLISHED_MODEL': 5,
    'CLAST_SCORE_MEAN': 0,
    'CLAST_SCORE_MEDIAN': 1,
    'CLAST_VALIDATION_NESTED': 0,
    'CLAST_VALIDATION_PUBLISHED': 1,
    'CLAST_RENDER_COLOUR_AUTO': 0,
    'CLAST_RENDER_COLOUR_SINGLE': 1,
    'CLAST_RENDER_COLOUR_SIZE': 2,
    'CLAST_RENDER_COLOUR_ORDER': 3,
    'CLAST_RENDER_COLOUR_SHAPE': 4,
    'CLAST_RENDER_SCALE_AUTO': 0,
    'CLAST_RENDER_SCALE_LINEAR': 1,
    'CLAST_RENDER_SCALE_LOG': 2,
    'CLAST_RENDER_ORTHOGRAPHIC': 0,
    'CLAST_RENDER_PERSPECTIVE': 1,
    'CLAST_RENDER_WHITE': 0,
    'CLAST_RENDER_TRANSPARENT': 1,
    'CLAST_RENDER_BLACK': 2,
    'CLAST_RENDER_SMOOTH': 0,
    'CLAST_RENDER_FLAT': 1,
    'CLAST_RENDER_CUT_NONE': 0,
    'CLAST_RENDER_CUT_X': 1,
    'CLAST_RENDER_CUT_Y': 2,
    'CLAST_RENDER_CUT_Z': 3,
    'CLAST_RENDER_CUT_VIEW': 4,
    'CLAST_RENDER_UP_X': 0,
    'CLAST_RENDER_UP_Y': 1,
    'CLAST_RENDER_UP_Z': 2,
    'CLAST_RUN_PATH': 4096,
    'CLAST_PERMEABILITY_HAPPEL': 0,
    'CLAST_PERMEABILITY_KOZENY_CARMAN': 1,
    'CLAST_SHAPE_SPHERE': 0,
    'CLAST_SHAPE_ELLIPSOID': 1,
    'CLAST_SHAPE_MESH': 2,
    'CLAST_SHAPE_CLUMP': 3,
    'CLAST_EXPORT_ANY': 0,
    'CLAST_EXPORT_VTU': 1,
    'CLAST_EXPORT_STL': 2,
    'CLAST_EXPORT_OBJ': 3,
    'CLAST_EXPORT_PLY': 4,
    'CLAST_EXPORT_3MF': 5,
    'CLAST_EXPORT_CSV': 6,
    'CLAST_EXPORT_DUMP': 7,
    'CLAST_EXPORT_JSON': 8,
    'CLAST_EXPORT_DATA': 9,
    'CLAST_EXPORT_TXT': 10,
    'CLAST_EXPORT_VORO': 11,
    'CLAST_EXPORT_XYZD': 12,
    'CLAST_EXPORT_CONF': 13,
    'CLAST_COLOUR_GRAIN': 0,
    'CLAST_COLOUR_ORDER': 1,
    'CLAST_COLOUR_SIZE': 2,
    'CLAST_COLOUR_SHAPE': 3,
    'CLAST_N_QUANTILE': 7,
    'CLAST_OK': 0,
    'CLAST_E_NO': 1,
    'CLAST_E_USAGE': 2,
    'CLAST_E_CONFIG': 3,
    'CLAST_E_ARGUMENT': 4,
    'CLAST_E_FORMAT': 5,
    'CLAST_E_GEOMETRY': 6,
    'CLAST_E_IO': 7,
    'CLAST_E_LIMIT': 8,
    'CLAST_E_MEMORY': 9,
    'CLAST_E_DISK': 10,
    'CLAST_E_CONVERGE': 11,
    'CLAST_E_STOPPED': 12,
    'CLAST_N_STATUS': 13,
    'CLAST_STUDY_GRID': 0,
    'CLAST_STUDY_ZIP': 1,
    'CLAST_VOLUME_U8': 0,
    'CLAST_VOLUME_I8': 1,
    'CLAST_VOLUME_U16': 2,
    'CLAST_VOLUME_I16': 3,
    'CLAST_VOLUME_U32': 4,
    'CLAST_VOLUME_I32': 5,
    'CLAST_VOLUME_F32': 6,
    'CLAST_VOLUME_F64': 7,
    'CLAST_N_VOLUME_TYPE': 8,
    'CLAST_TESTS_EACH': 0,
    'CLAST_TESTS_EVERY': 1,
    'CLAST_TESTS_MOVED': 2,
    'CLAST_TESTS_NEVER': 3,
    'CLAST_CUT_EACH': 0,
    'CLAST_CUT_EVERY': 1,
    'CLAST_CUT_CHANGED': 2,
}

# name: (result, arguments, what it does)
PROTOTYPES: dict[str, tuple[Any, list[Any], str]] = {
    'clast_collide_config_default': (c_int, [POINTER(clast_collide_config)], 'Every member as `clast agglomerate` starts from it, of the members without a field: no kernel (set it with clast_kernel_parse), seed 0, count_unit 0 and keep_positions false.'),
    'clast_collide': (c_int, [POINTER(clast_population), POINTER(clast_collide_cells), c_double, c_uint64, POINTER(clast_collide_config), POINTER(c_int64)], 'Lets the particles of each cell collide for a time dt.'),
    'clast_collide_idle': (c_char_p, [POINTER(clast_collide_config), c_char_p, c_bool], 'The key ("kernel", "sticking", "radius_law") by whose value another key of clast_agglomerate_fields changes nothing: one of the fluid that neither the kernels nor their ranges look at, one of another law of sticking, of fractal radii.'),
    'clast_spectrum_idle': (POINTER(clast_idle), [POINTER(clast_spectrum_config), POINTER(clast_idle)], 'The fields, and `leap`, `block` and `seed`, that a box by the others does not look at (clast_fields_idle).'),
    'clast_agglomerate_takes': (c_bool, [c_char_p, c_bool], 'Whether a key or option of `clast agglomerate` goes with a well-mixed box, or with the positions of a cloud; `kernel`, `duration`, `seed` and the like with both.'),
    'clast_spectrum_start_from_table': (c_int, [POINTER(clast_table), POINTER(clast_spectrum_start)], 'The start in a table: columns size and number, or size and n, as in spectrum.csv of a box, of whose rows (column time_s) those of the last time are taken, which move to the front of the two columns.'),
    'clast_spectrum_has_sectional': (c_bool, [], 'Whether this library was built with the time integrator of the sectional solver (SUNDIALS).'),
    'clast_spectrum_evolve': (c_int, [POINTER(clast_spectrum_start), POINTER(clast_spectrum_config), POINTER(clast_collide_config), POINTER(clast_monitor), POINTER(clast_spectrum)], 'Evolves the spectrum of a box; the same bytes for any number of threads.'),
    'clast_spectrum_free': (None, [POINTER(clast_spectrum)], '.'),
    'clast_spectrum_note': (c_char_p, [POINTER(clast_spectrum), c_int32, c_size_t, c_char_p], 'What to say of a box: 0, particles or collisions out of the range of their kernel; 1, particles that are too dense (clast_kernel_dense_words); 2, a drawn start whose M1 or M2 is over 1 % off that of its law.'),
    'clast_agglomerate_idle': (POINTER(clast_idle), [POINTER(clast_agglomerate_config), POINTER(clast_agglomerate_given), POINTER(clast_idle)], 'The fields that collisions by the others and of such particles do not look at (clast_fields_idle); those of the cells: clast_decompose_idle, of kernels, sticking and radii: clast_collide_idle.'),
    'clast_agglomerate': (c_int, [POINTER(clast_agglomerate_input), POINTER(clast_agglomerate_config), POINTER(clast_monitor), POINTER(clast_agglomeration)], 'Evolves the cloud; see docs/theory/agglomeration.md.'),
    'clast_agglomeration_free': (None, [POINTER(clast_agglomeration)], '.'),
    'clast_agglomeration_note': (c_char_p, [POINTER(clast_agglomeration), c_int32, c_size_t, c_char_p], 'What to say of a cloud that agglomerates: 0 and 1 as of a box (clast_spectrum_note); 2, snapshots that are not resolved; 3, duplicate points, which collide.'),
    'clast_agglomeration_change_test': (c_int, [POINTER(c_double), POINTER(c_double), c_int64, c_int32, POINTER(c_double)], 'Whether two samples of n points of the unit cube have the same density: chi-square of their counts on a regular grid that is chosen without looking at them (10 points a block or more).'),
    'clast_aggregate_params_default': (c_int, [POINTER(clast_aggregate_params)], 'Those that `clast aggregate` starts from (clast describe lists them).'),
    'clast_aggregate_params_free': (None, [POINTER(clast_aggregate_params)], 'may be called twice.'),
    'clast_permeable_range_text': (c_char_p, [c_int], 'What that means, for messages: "the coat is thinner than its mean grain", .'),
    'clast_aggregate_create': (c_int, [POINTER(clast_aggregate_params), POINTER(clast_aggregate_input), c_int32, POINTER(c_void_p)], 'The core alone, ready to grow.'),
    'clast_aggregate_destroy': (None, [c_void_p], 'NULL is allowed.'),
    'clast_aggregate_grow': (c_int, [c_void_p, c_int32, POINTER(clast_monitor)], 'Places up to n more particles, fewer when a stop criterion is met or the list ends.'),
    'clast_aggregate_is_done': (c_bool, [c_void_p], 'Whether a stop criterion is met or all particles of the list are placed.'),
    'clast_aggregate_n_particle': (c_int32, [c_void_p], 'All particles of the run, placed or not.'),
    'clast_aggregate_assembly': (POINTER(clast_assembly), [c_void_p], 'Grains so far; grain 0 (and those after it, if the core is a group) is the core.'),
    'clast_aggregate_history': (c_int, [c_void_p, POINTER(clast_table)], 'One row for the core and one for each particle.'),
    'clast_aggregate_measure': (c_int, [c_void_p, POINTER(clast_aggregate_result)], 'The numbers of what has grown so far, envelopes to a tighter bound than in the rows.'),
    'clast_aggregate_members': (c_int, [c_void_p, POINTER(clast_table)], 'Cluster mode: table with the cluster of every grain and its index in it, which restoring needs.'),
    'clast_aggregate_restore': (c_int, [POINTER(clast_aggregate_params), POINTER(clast_aggregate_input), POINTER(clast_aggregate_saved), POINTER(c_void_p)], 'Goes on from there: the same particles follow, to the last bit.'),
    'clast_interval_of': (clast_interval, [c_int32, POINTER(c_double), c_double], 'Mean of n values and its interval at this confidence, in the unit of the values.'),
    'clast_aggregate_band': (c_int, [POINTER(clast_table), c_double, POINTER(clast_table)], 'Mean and interval of porosity, density, size and radius of gyration after n = 0, 1, .'),
    'clast_aggregate_achieved': (c_int, [POINTER(clast_aggregate_params), POINTER(clast_sizes), POINTER(clast_table), POINTER(clast_table)], 'Sizes wanted beside those placed: a row for each distinct size or bin of the list (one for bins that overlap), or for each of 12 classes of a law over what it drew (one where that is one size).'),
    'clast_aggregate_config_check': (c_int, [POINTER(clast_aggregate_config)], "Combinations of options that a single field's range cannot see."),
    'clast_aggregate_load': (c_int, [POINTER(clast_aggregate_config), POINTER(clast_aggregate_source)], "@return the reader's status and line, with the option and the file's name before it."),
    'clast_aggregate_unload': (None, [POINTER(clast_aggregate_source)], 'may be called twice.'),
    'clast_aggregate_report_free': (None, [POINTER(clast_aggregate_report)], 'Frees what clast_aggregate_run filled; may be called twice.'),
    'clast_aggregate_report_json': (c_int, [POINTER(clast_aggregate_report), c_bool, POINTER(c_char_p)], 'The report as one JSON object: means over repeats under the names of DESIGN section 7, each repeat under `repeats`, intervals under `interval` when there are several, the printable body under `printable` when one was made.'),
    'clast_aggregate_report_scope': (c_char_p, [POINTER(clast_aggregate_report), c_size_t, c_char_p], 'What the numbers are of, where that is not all grains in their true surfaces, in `size` bytes: "largest of 10 clusters, 24 of 40 grains (...)", or that porosity is by the sum of the grains\' volumes, by how much these overlap, and which bodies max_overlap is of, or that an envelope is smaller than the solid; else "" .'),
    'clast_aggregate_run': (c_int, [POINTER(clast_aggregate_config), c_char_p, POINTER(clast_comm), POINTER(clast_monitor), POINTER(clast_aggregate_report)], 'Grows all repeats; with a folder writes state.h5, history.csv, radial.csv, sizes.csv, structure.csv, summary.json, aggregate.stl, charts, picture.png, report.html and manifest.json into it, and checkpoints on the way.'),
    'clast_aggregate_make_printable': (c_int, [c_char_p, POINTER(clast_printable_config), POINTER(clast_monitor), POINTER(clast_printable_report)], 'Makes the printable body of a whole run from its state.h5, anew or for the first time: printable.3mf, printable.stl (mm) and printable.json, which manifest.json then lists.'),
    'clast_aggregate_resume': (c_int, [c_char_p, POINTER(clast_comm), POINTER(clast_monitor), POINTER(clast_aggregate_report)], 'Goes on from the newest checkpoints of a folder, with any number of ranks; ends in the same bytes as an uninterrupted run.'),
    'clast_aggregate_fit_observable_name': (c_char_p, [c_int32], '"size", "density", "settling_velocity" and their SI units.'),
    'clast_aggregate_fit_observable_unit': (c_char_p, [c_int32], '.'),
    'clast_fit_verdict_name': (c_char_p, [c_int], '"inside", "edge", "no" .'),
    'clast_aggregate_fit_run': (c_int, [POINTER(clast_aggregate_config), POINTER(clast_aggregate_input), POINTER(clast_monitor), POINTER(clast_aggregate_fit), POINTER(clast_table)], 'Finds (cone, rays, orientations, N_A) that explain config->observed_size, observed_density, observed_velocity (0: not observed), each within its error.'),
    'clast_aggregate_fit_json': (c_int, [POINTER(clast_aggregate_fit), POINTER(c_char_p)], 'The outcome as one JSON object; free the text with clast_text_free.'),
    'clast_aggregate_fit_study': (c_int, [POINTER(clast_aggregate_config), c_char_p, POINTER(clast_monitor), POINTER(clast_aggregate_fit)], 'Loads what the configuration names and fits; with a folder writes fit.csv, fit.svg, summary.json and manifest.json into it (all but the last are the same bytes for equal runs).'),
    'clast_assembly_free': (None, [POINTER(clast_assembly)], 'Frees all arrays and shapes; may be called twice.'),
    'clast_assembly_copy': (c_int, [POINTER(clast_assembly), POINTER(clast_assembly)], 'Deep copy into an empty assembly.'),
    'clast_assembly_add_shape': (c_int, [POINTER(clast_assembly), POINTER(clast_shape), POINTER(c_int32)], 'Adds a copy of a shape; its number goes to *shape_id (may be NULL).'),
    'clast_assembly_add_grain': (c_int, [POINTER(clast_assembly), c_int32, POINTER(c_double), POINTER(c_double), c_double, c_double], 'Adds a grain with id = its index; amortised O(1).'),
    'clast_assembly_add_contact': (c_int, [POINTER(clast_assembly), c_int32, c_int32, POINTER(c_double)], 'Adds a contact between two grains at a world point; CLAST_E_USAGE unless both exist and differ.'),
    'clast_assembly_volume': (c_double, [POINTER(clast_assembly)], "Sum of the grains' own volumes (overlaps counted twice)."),
    'clast_assembly_mass': (c_double, [POINTER(clast_assembly)], 'Sum of volume times density [kg].'),
    'clast_assembly_centre': (None, [POINTER(clast_assembly), POINTER(c_double)], "Centre of mass by the grains' own volumes and densities; (0, 0, 0) without grains."),
    'clast_assembly_bounds': (None, [POINTER(clast_assembly), POINTER(c_double), POINTER(c_double)], "Box of all grains' true surfaces (exact for spheres, ellipsoids, clumps and meshes); low > high without grains."),
    'clast_assembly_grain_surface': (c_int, [POINTER(clast_assembly), c_int32, c_int, POINTER(clast_mesh)], 'Surface of grain i in world coordinates, appended to `mesh` (spheres and ellipsoids by an icosphere of `level`).'),
    'clast_assembly_rigid': (c_int, [POINTER(clast_assembly), c_char_p, POINTER(clast_rigid_options), POINTER(clast_shape), POINTER(c_double)], "One rigid grain of an assembly's grains: spheres, ellipsoids, clumps (sphere by sphere) and convex surfaces, which are its parts."),
    'clast_union_options_default': (clast_union_options, [], 'tolerance 1e-4, 2^24 points, seed 1, with depths.'),
    'clast_assembly_union': (c_int, [POINTER(clast_assembly), POINTER(clast_union_options), POINTER(clast_union)], "Volume of the union of all grains' true solids."),
    'clast_assembly_find_contacts': (c_int, [POINTER(clast_assembly), c_double], 'Fills assembly->contact with all pairs of grains that come within `gap` of each other, in rising order; the contact point lies halfway between the closest points.'),
    'clast_assembly_find_contacts_periodic': (c_int, [POINTER(clast_assembly), c_double, POINTER(clast_period)], 'The same across the borders of a periodic box too, wherever grains lie: each is taken by its image in the box.'),
    'clast_assembly_overlaps': (c_int, [POINTER(clast_assembly), POINTER(clast_period), POINTER(clast_overlaps)], '@param period NULL: none; else each grain is taken by its image in the box @note the same bytes for any thread count.'),
    'clast_assembly_printable_plan': (c_int, [POINTER(clast_assembly), POINTER(clast_printable_config), POINTER(clast_printable_report)], 'What clast_assembly_printable will make: neck, spacing, smallest_feature, resolved and n_triangle_expected (50 bytes each in an STL) of the report, at no cost.'),
    'clast_assembly_printable': (c_int, [POINTER(clast_assembly), POINTER(clast_printable_config), POINTER(clast_monitor), POINTER(clast_mesh), POINTER(clast_printable_report)], 'One closed, oriented surface in one piece around all grains and the necks at their contacts.'),
    'clast_envelope_options_default': (clast_envelope_options, [], 'tolerance 1e-3, 10000 rays, seed 1, no length, 128 cells.'),
    'clast_envelope_name': (c_char_p, [c_int], '"surface_hull" and so on.'),
    'clast_envelope_text': (c_char_p, [c_int], '"convex hull of the true surfaces" and so on.'),
    'clast_envelope_parse': (c_int, [c_char_p, POINTER(c_int)], 'The kind of this name; CLAST_E_CONFIG lists the names.'),
    'clast_assembly_envelope': (c_int, [POINTER(clast_assembly), c_int, POINTER(clast_envelope_options), POINTER(clast_envelope)], 'One envelope of an assembly.'),
    'clast_assembly_enclosing_sphere': (c_int, [POINTER(clast_assembly), POINTER(c_double), POINTER(c_double)], 'Smallest sphere about the true surfaces of all grains (exact for spheres, clumps and meshes; to 1e-12 for ellipsoids).'),
    'clast_assembly_radius_of_gyration': (c_double, [POINTER(clast_assembly)], "Radius of gyration: root mean square distance of the mass from its centre, each grain's own extent included."),
    'clast_fractal_growth': (c_int, [POINTER(clast_assembly), c_int32, POINTER(clast_fractal)], 'From growth: radius of gyration after each grain, in the order of the grains, from grain n_first (counted from 1) to the last, at up to 40 log-spaced counts.'),
    'clast_fractal_correlation': (c_int, [POINTER(clast_assembly), POINTER(clast_fractal)], "From the pair correlation: solid volume within r of a grain's centre, mean over the grains by volume, in units of the mean grain, between two mean diameters and the solid's radius of gyration."),
    'clast_assembly_radial_profile': (c_int, [POINTER(clast_assembly), POINTER(c_double), c_int32, POINTER(clast_table)], 'Solid volume in n_bin shells of equal thickness about a centre (NULL: centre of mass), out to the farthest grain.'),
    'clast_assembly_coordination': (c_int, [POINTER(clast_assembly), POINTER(clast_table)], 'Grains by number of contacts: columns coordination, n_grain, share.'),
    'clast_assembly_projected_area': (c_int, [POINTER(clast_assembly), POINTER(c_double), c_int32, POINTER(c_double), POINTER(c_double)], "Area of the shadow along a direction, by n_line scan lines on which the shadow's length is exact; the error is the difference to half as many lines, or between even and odd ones where that is more."),
    'clast_assembly_mean_projection': (c_int, [POINTER(clast_assembly), c_int32, c_int32, POINTER(c_double), POINTER(c_double)], 'Mean shadow over n_direction directions distributed uniformly over the half sphere; error: standard deviation over the root of their number (an upper bound for uniform directions).'),
    'clast_assembly_extent': (c_int, [POINTER(clast_assembly), POINTER(clast_extent)], 'Exact for polyhedra, to 1e-9 for smooth grains.'),
    'clast_structure_options_default': (clast_structure_options, [], 'Options of the parts, air, 512 lines, 24 directions.'),
    'clast_structure': (c_int, [POINTER(clast_assembly), POINTER(clast_structure_options), POINTER(clast_table)], 'Everything above in one table: columns name, value, error, unit, meaning.'),
    'clast_chart_write': (c_int, [POINTER(clast_chart), c_char_p], 'Draws the chart into a file: .svg, .pdf or .png (PNG at twice the resolution), atomically.'),
    'clast_chart_svg': (c_int, [POINTER(clast_chart), POINTER(POINTER(c_uint8)), POINTER(c_size_t)], 'The same in memory as SVG text, for a page; the caller frees *bytes with clast_chart_bytes_free.'),
    'clast_chart_bytes_free': (None, [POINTER(c_uint8)], '.'),
    'clast_aggregate_chart_name': (c_char_p, [c_int], 'File name without extension ("history", "diameter", ...).'),
    'clast_aggregate_chart_fits': (c_bool, [c_int, POINTER(clast_table)], 'True when the table has the columns and rows that the chart needs.'),
    'clast_aggregate_chart_write': (c_int, [c_int, POINTER(clast_table), POINTER(clast_table), c_char_p], 'Draws one chart into a file: .svg, .pdf or .png.'),
    'clast_aggregate_chart_svg': (c_int, [c_int, POINTER(clast_table), POINTER(clast_table), POINTER(POINTER(c_uint8)), POINTER(c_size_t)], 'The same as SVG text; free *bytes with clast_chart_bytes_free.'),
    'clast_aggregate_charts_write': (c_int, [POINTER(clast_table), POINTER(clast_table), c_char_p], 'All charts that fit as FOLDER/NAME.svg: history.svg, diameter.svg, density.svg, sizes.svg.'),
    'clast_decompose_chart_name': (c_char_p, [c_int, POINTER(clast_decomposition)], 'File name without extension: "points", "density", "score", "events" ("pair_integral" of a result without beta dt; NULL: of any).'),
    'clast_decompose_chart_fits': (c_bool, [c_int, POINTER(clast_decomposition)], 'True when there is something to draw: no thresholds and no bins in one cell or a tree.'),
    'clast_decompose_chart_write': (c_int, [c_int, POINTER(clast_cloud), POINTER(clast_decomposition), c_char_p], 'Draws one chart as .svg, .pdf or .png.'),
    'clast_chart_grading': (c_int, [POINTER(clast_table), c_char_p], 'Draws mass (and, where the table has it, number) passing over size, wanted and achieved, into a .svg, .pdf or .png.'),
    'clast_chart_pairs': (c_int, [POINTER(clast_pairs), c_char_p], 'Draws g over r (logarithmic) with its 95 % band and the line of a uniform cloud, as .svg, .pdf or .png.'),
    'clast_chart_porosity': (c_int, [POINTER(clast_table), POINTER(clast_porosity_bulk), c_char_p, c_char_p], 'Draws porosity over height with the evaluated interval and the bulk value, as Fig.'),
    'clast_chart_radial': (c_int, [POINTER(clast_table), c_char_p, c_char_p], "Draws porosity over the distance from a cylinder's axis, with error bars."),
    'clast_chart_pores': (c_int, [POINTER(clast_table), c_char_p, c_char_p], 'Draws the share of pore space nearer than delta to a grain.'),
    'clast_chart_porosity_band': (c_int, [POINTER(clast_table), c_char_p, c_char_p], 'Mean profile over height or radius of several runs with its interval, of clast_porosity_mean_profile.'),
    'clast_chart_stress': (c_int, [POINTER(clast_table), c_char_p, c_char_p], 'Normal stresses over height, of clast_stress_profile.'),
    'clast_chart_chains': (c_int, [POINTER(clast_table), c_char_p, c_char_p], 'Force chains of clast_bed_chains seen along y: lines as thick as their force, in four steps of the mean; contacts that are no link of a chain are grey.'),
    'clast_chart_zingg': (c_int, [POINTER(clast_form_set), c_char_p], 'Zingg diagram: elongation over flatness, with the class borders at 2/3, coloured by size if the set has sizes (log colour where they span more than a factor 5).'),
    'clast_chart_histogram': (c_int, [POINTER(c_double), c_int64, c_char_p, c_char_p, c_char_p], "Histogram of one column as a density, with the normal law of maximum likelihood and, in the legend, its mean and deviation; the title holds Shapiro and Wilk's W and p."),
    'clast_chart_correlation': (c_int, [POINTER(clast_statistics), c_char_p], 'Correlation matrix as a heat map; form factors go by their symbols.'),
    'clast_chart_pca': (c_int, [POINTER(clast_statistics), c_char_p], 'Share of the variance that each principal component explains, and the running sum.'),
    'clast_fit_chart_name': (c_char_p, [c_int], '"feature", "predicted", "residuals", "leverage" .'),
    'clast_chart_fit': (c_int, [c_int, POINTER(clast_fit_data), POINTER(clast_porosity_fit), c_char_p], '.'),
    'clast_cloud_alloc': (c_int, [c_int64, c_int32, POINTER(clast_cloud)], 'Allocates n points, zeroed; `cloud` must be empty.'),
    'clast_cloud_free': (None, [POINTER(clast_cloud)], 'Frees the arrays; may be called twice.'),
    'clast_cloud_column': (c_int, [POINTER(clast_table), c_char_p, POINTER(POINTER(c_double))], 'Numbers of the named column; *column is NULL for a name that is empty or NULL.'),
    'clast_cloud_column_si': (c_int, [POINTER(clast_table), c_char_p, c_char_p, POINTER(c_double)], 'Takes numbers of the named column to SI by the unit that its name gives: in brackets anywhere ("G (1/min) mean"), or behind "_" ("U_cm/s_x"); they stay what they are where it is empty or gives none.'),
    'clast_cloud_from_table': (c_int, [POINTER(clast_table), POINTER(clast_cloud_columns), POINTER(clast_cloud)], 'A table\'s rows as a cloud, in SI: a column whose name gives a unit (x_mm, "r (um)", "u_cm/s", radii and diameters also "d (phi)") is converted; see clast_cloud_column_si.'),
    'clast_cloud_weight_words': (c_char_p, [POINTER(clast_cloud), c_char_p, c_size_t, c_char_p], 'What to say of unread_weight: "points.csv: column \'weight\' is not looked at: each row is one particle (--weight-column weight)"; "" where nothing is.'),
    'clast_cloud_repeated': (c_int, [POINTER(clast_cloud), POINTER(c_int64)], 'Points that have the very coordinates of an earlier one; O(n).'),
    'clast_cloud_repeated_ranks': (c_int, [POINTER(clast_cloud), POINTER(clast_comm), POINTER(c_int64)], 'The same of the points that all ranks have together; called by all of them.'),
    'clast_cloud_read': (c_int, [c_char_p, POINTER(clast_points_options), POINTER(clast_table)], 'Reads delimited text, legacy VTK (ASCII, binary), VTP and VTU (ASCII, base64, appended, zlib), PLY (ASCII, both byte orders), XYZ (count, comment, rows "NAME x y z"), a LAMMPS or LIGGGHTS dump, or an HDF5 array: whatever the file\'s first bytes show.'),
    'clast_cloud_read_ranks': (c_int, [POINTER(clast_comm), c_char_p, POINTER(clast_cloud_columns), POINTER(clast_points_options), POINTER(clast_cloud)], 'The points of one file, a part on each rank in the order of the rows: delimited text by stretches of its bytes, HDF5 arrays by rows, some at a time, so that no rank holds the file.'),
    'clast_cloud_parse': (c_int, [c_char_p, c_void_p, c_size_t, POINTER(clast_points_options), POINTER(clast_table)], 'clast_cloud_read from memory, HDF5 excepted; `name` stands for the path.'),
    'clast_domain_parse': (c_int, [c_char_p, POINTER(clast_domain)], 'Parses "box:x0,y0,z0,x1,y1,z1" (2, 4 or 6 numbers), "cylinder:R,L" (base centre at the origin, along z), "cylinder:X,Y,Z,NX,NY,NZ,R,L" (base centre, direction of the axis, of any length), "half-pipe:R,L", "sphere:R" or "sphere:X,Y,Z,R" .'),
    'clast_domain_parse_in': (c_int, [c_char_p, c_double, POINTER(clast_domain)], 'The same where a bare length is in units of `factor` m.'),
    'clast_domain_format': (None, [POINTER(clast_domain), c_char_p], 'The domain as clast_domain_parse reads it, in m; "no domain" of another, "map" for a map, "mesh:" and the bounding box of a surface.'),
    'clast_domain_of_map': (c_int, [POINTER(clast_domain_map_functions), POINTER(clast_domain)], "A domain of the caller's: checks at 64 points that the maps undo each other (1e-8) and that the volume of the map's small cells is constant (1e-3)."),
    'clast_domain_of_mesh': (c_int, [POINTER(clast_mesh), c_double, POINTER(clast_domain)], 'The inside of a closed surface, which is copied, its coordinates times `scale`.'),
    'clast_domain_free': (None, [POINTER(clast_domain)], 'only a mesh holds memory.'),
    'clast_domain_volume': (c_double, [POINTER(clast_domain)], 'Volume [m^d].'),
    'clast_cloud_corner_words': (c_char_p, [POINTER(clast_cloud), POINTER(clast_comm), POINTER(clast_domain), c_size_t, c_char_p], 'What to say of points that all lie within a thousandth of the domain\'s width (V^(1/d)), as where one of the two is in another unit; "" of others.'),
    'clast_domain_map': (c_bool, [POINTER(clast_domain), POINTER(c_double), POINTER(c_double)], 'True when the point [dimension] is in the closed domain; u [dimension] is then its image in the unit cube.'),
    'clast_domain_unmap': (None, [POINTER(clast_domain), POINTER(c_double), POINTER(c_double)], 'The inverse map: the point x [dimension] whose image in the unit cube is u [dimension].'),
    'clast_domain_read': (c_int, [c_char_p, c_char_p, POINTER(clast_domain)], 'As clast_domain_parse, and "mesh:FILE": the inside of a closed surface (STL, OBJ, PLY, OFF).'),
    'clast_discrepancy_test': (c_int, [POINTER(c_double), c_int64, c_int32, c_int, POINTER(clast_discrepancy)], 'All three discrepancies of n >= 2 points.'),
    'clast_henze_zirkler_test': (c_int, [POINTER(c_double), c_int64, c_int32, c_int, POINTER(clast_henze_zirkler)], 'Scores are clamped to u in [2^-53, 1 - 2^-53].'),
    'clast_pearson_test': (c_int, [POINTER(c_double), c_int64, c_int32, POINTER(clast_pearson)], '@return CLAST_E_ARGUMENT for n < 3.'),
    'clast_spacing_test': (c_int, [POINTER(c_double), c_int64, c_int32, POINTER(clast_spacing)], '@return CLAST_E_ARGUMENT for n < 5 @note O(n log n); beyond 50,000 points the neighbours of a part of them are looked for, which their positions alone decide.'),
    'clast_spacing_ranks': (c_int, [POINTER(clast_comm), POINTER(c_double), c_int64, c_int32, POINTER(clast_spacing)], 'The same of the points that all ranks have together; called by all of them.'),
    'clast_boundary_score_test': (c_int, [POINTER(c_double), c_int64, c_int32, POINTER(c_double), POINTER(clast_boundary_score)], '@param side [d] side lengths of the box that the cube stands for, > 0.'),
    'clast_boundary_score_ideal': (c_double, [c_double, c_int32, POINTER(c_double)], 'Expected score of n uniform points in a box of these sides.'),
    'clast_decompose_takes_tree': (c_bool, [POINTER(clast_decompose_config)], 'Whether cells are those of the uniformity tree, which needs no vote, not joined bins; no of NULL.'),
    'clast_decompose_idle': (POINTER(clast_idle), [POINTER(clast_decompose_config), c_bool, c_int32, POINTER(clast_idle)], 'The fields, and the options `sizes`, `regular` and `variable_column` of `clast decompose`, that a decomposition by the others does not look at (clast_fields_idle).'),
    'clast_uniformity_choose': (c_int, [c_char_p, POINTER(c_uint32)], 'Bits of left_out for a list of the tests that shall vote, "centred,pearson" .'),
    'clast_uniformity_test': (c_int, [POINTER(c_double), c_int64, c_int32, POINTER(c_double), POINTER(clast_uniformity_config), POINTER(clast_uniformity)], '@param u [n][d] in the unit cube @param side [3] for the score.'),
    'clast_decompose_stop_text': (c_char_p, [c_int], 'A stop in words, "rejected by the tests and split" .'),
    'clast_decompose': (c_int, [POINTER(clast_cloud), POINTER(clast_decompose_config), POINTER(clast_decomposition)], "Splits the cloud's domain into cells of uniform concentration and counts events."),
    'clast_decompose_in': (c_int, [POINTER(clast_domain), POINTER(clast_cloud), POINTER(clast_decompose_config), POINTER(clast_decomposition)], "The same in a ready domain, which config->domain then only names in messages (may be NULL): the way for a closed surface or the caller's own map."),
    'clast_decompose_ranks': (c_int, [POINTER(clast_comm), POINTER(clast_domain), POINTER(clast_cloud), POINTER(clast_decompose_config), POINTER(clast_decomposition)], 'The same of one cloud of which each rank has a part; points stay where they are.'),
    'clast_decompose_sizes': (c_int, [POINTER(clast_comm), POINTER(clast_domain), POINTER(clast_cloud), POINTER(clast_decompose_parts), POINTER(clast_decompose_config), POINTER(clast_table)], 'Events against the number of points: random parts of n, n/2, n/4, .'),
    'clast_cells_are_labelled': (c_bool, [POINTER(clast_cells)], 'Whether label and pass mean something: of bins, not of a tree or a single cell.'),
    'clast_cells_locate': (c_int32, [POINTER(clast_cells), POINTER(clast_domain), POINTER(c_double)], 'Cell of a point, -1 outside the domain; O(1) in bins, O(log n) in a tree.'),
    'clast_decomposition_free': (None, [POINTER(clast_decomposition)], '.'),
    'clast_decomposition_note': (c_char_p, [POINTER(clast_decomposition), c_int64, c_int32, c_size_t, c_char_p], 'What to say of a decomposition (but for the tests alone, whose one cell says nothing of events): 0, pairs by distance that disagree with the cells or are those of no density; 1, why there is no number of events (events_low is NaN); 2, too few points a bin.'),
    'clast_cells_write_vtu': (c_int, [POINTER(clast_decomposition), POINTER(clast_domain), c_char_p], 'Cells as an unstructured grid (VTU): lines, quadrilaterals or hexahedra with cell, count, volume, density and events (pair_integral without beta dt), label and pass where cells have them; unit, domain, volume, beta_dt and seed (of what was drawn) as field data.'),
    'clast_decomposition_write_points': (c_int, [POINTER(clast_decomposition), POINTER(clast_cloud), POINTER(clast_domain), c_char_p], 'Points as polydata (VTP) with cell (label and pass) and the same field data, and radius, mass, weight and velocity where the cloud has them; -1 and 0 for points left out.'),
    'clast_dem_create': (c_int, [POINTER(clast_dem_config), POINTER(c_void_p)], '@return CLAST_E_CONFIG for a field out of its range (clast_dem_fields), or when the time step does not resolve the stiffest contact.'),
    'clast_dem_destroy': (None, [c_void_p], 'NULL is allowed.'),
    'clast_dem_add_container': (c_int, [c_void_p, POINTER(clast_mesh)], 'Fixed triangles that grains cannot pass, from either side: a container, closed or open, or any obstacle.'),
    'clast_dem_add_wall': (c_int, [c_void_p, POINTER(clast_mesh), POINTER(c_int32)], 'A surface as one more wall, closed or open, which may be moved, watched and opened; before the first grain.'),
    'clast_dem_watch_walls': (c_int, [c_void_p], 'Sums the forces on all walls from the next step on, those of the domain with them, and numbers them.'),
    'clast_dem_n_wall': (c_int32, [c_void_p], '0 while none are numbered.'),
    'clast_dem_set_wall_motion': (c_int, [c_void_p, c_int32, POINTER(clast_dem_wall_motion)], 'How a wall moves, before it does.'),
    'clast_dem_drive_wall': (c_int, [c_void_p, c_int32, c_bool, POINTER(c_double)], "From the next step on the wall's own motion runs, or stands; a velocity is added to it [m/s]."),
    'clast_dem_open_wall': (c_int, [c_void_p, c_int32], 'Takes a wall away: an orifice opens.'),
    'clast_dem_read_wall': (None, [c_void_p, c_int32, POINTER(clast_dem_wall)], 'A wall as it is now; untouched where there is no such wall.'),
    'clast_dem_remove_grains': (c_int, [c_void_p, POINTER(c_uint8)], 'Takes grains out; those after them move up in number.'),
    'clast_dem_add_shape': (c_int, [c_void_p, POINTER(clast_shape), POINTER(c_int32)], 'Adds a copy of a shape; its number goes to *id.'),
    'clast_dem_contact_of': (clast_dem_contact, [POINTER(clast_dem_config), c_bool], 'The contact of a configuration, between grains or at walls.'),
    'clast_dem_set_contacts': (c_int, [c_void_p, c_int32, POINTER(clast_dem_contact)], 'From now on contacts go by the materials of both sides, 0 .'),
    'clast_dem_set_material': (c_int, [c_void_p, c_int32, c_int32], 'Material of a shape, before its first grain; of a wall (numbered as clast_dem_wall says).'),
    'clast_dem_set_wall_material': (c_int, [c_void_p, c_int32, c_int32], '.'),
    'clast_dem_add_grains': (c_int, [c_void_p, c_int32, POINTER(clast_dem_grain)], 'Adds grains; all or none.'),
    'clast_dem_set_drive': (c_int, [c_void_p, POINTER(clast_dem_drive)], 'Sets what acts from the next step on.'),
    'clast_dem_step': (c_int, [c_void_p, c_int64], 'Goes on by n_step time steps.'),
    'clast_dem_begin_energy': (c_int, [c_void_p], 'From now on the work of all forces is booked, which changes no bit of the run; begins anew if it was.'),
    'clast_dem_energy_measure': (None, [c_void_p, POINTER(clast_dem_energy)], 'Where the energy has gone; untouched when none was booked.'),
    'clast_dem_load_measure': (c_int, [c_void_p, POINTER(clast_dem_load)], 'What the bed carries now.'),
    'clast_dem_set_cell_rate': (c_int, [c_void_p, POINTER(c_double), c_double], "Speeds of the cell's three sides, and of the upper images along x, from the next step on [m/s]."),
    'clast_dem_read_cell': (None, [c_void_p, POINTER(clast_dem_cell)], 'as it is now.'),
    'clast_dem_n_grain': (c_int32, [c_void_p], 'Grains so far.'),
    'clast_dem_n_step': (c_int64, [c_void_p], 'steps so far.'),
    'clast_dem_time': (c_double, [c_void_p], '[s].'),
    'clast_dem_read_grain': (None, [c_void_p, c_int32, POINTER(clast_dem_grain)], 'Grain i as it is now; position not wrapped into the period.'),
    'clast_dem_measure': (None, [c_void_p, POINTER(clast_dem_measures)], 'Energies, contacts and overlaps of the moment, SI.'),
    'clast_dem_mean_height': (c_double, [c_void_p, POINTER(c_double)], 'Mass-mean of z and the highest centre [m]: what the process asks often.'),
    'clast_dem_max_speed': (c_double, [c_void_p], "Largest speed of a grain's centre [m/s]."),
    'clast_dem_assembly': (c_int, [c_void_p, POINTER(clast_assembly)], 'All grains with their contacts, wrapped into the period.'),
    'clast_dem_hash': (c_uint64, [c_void_p], '64-bit digest of all positions, orientations, velocities and contact histories, bit by bit.'),
    'clast_dem_contact_table': (c_int, [c_void_p, POINTER(clast_table)], 'Forces of all contacts as they are now: columns a, b (grains; b -1: a wall), centre_z_m (of a), x_m, y_m, z_m (the point), branch_x_m .'),
    'clast_dem_scene_p1': (c_int, [POINTER(clast_scene_bed), POINTER(c_void_p)], 'Case P1 into *dem, which the caller destroys.'),
    'clast_dem_scene_e1': (c_int, [POINTER(clast_scene_bed), c_void_p, POINTER(c_void_p)], 'Case E1: the grains of a P1 as they are now, replaced by their mass-equivalent ellipsoids (axes times 0.985).'),
    'clast_dem_scene_s1': (c_int, [POINTER(c_void_p)], 'Case S1: 10,830 spheres of 6.7 mm on a simple-cubic lattice of 6.9 mm with random velocities, box of 0.134 m periodic in x and y; to be settled for 0.2 s.'),
    'clast_evolve_create': (c_int, [POINTER(clast_evolve_config), POINTER(clast_evolve_input), POINTER(c_void_p)], 'All particles at their positions at time 0.'),
    'clast_evolve_destroy': (None, [c_void_p], 'NULL is allowed.'),
    'clast_evolve_advance': (c_int, [c_void_p], 'A leg of at most 16 steps, to the next row of the tables at the farthest.'),
    'clast_evolve_is_over': (c_bool, [c_void_p], 'The duration has passed, or nothing is left in the fluid.'),
    'clast_evolve_time': (c_double, [c_void_p], 'Seconds that have passed in the cloud; NAN for NULL.'),
    'clast_evolve_n_row': (c_int32, [c_void_p], 'Rows of the tables written, the one at the start not counted; 0 for NULL.'),
    'clast_evolve_measure': (c_int, [c_void_p, POINTER(clast_evolve_result)], 'The numbers now.'),
    'clast_evolve_result_free': (None, [POINTER(clast_evolve_result)], 'may be called twice.'),
    'clast_evolve_result_json': (c_int, [POINTER(clast_evolve_result), c_bool, POINTER(c_char_p)], 'As one JSON object under the names of DESIGN section 7; free the text with clast_text_free.'),
    'clast_evolve_table': (c_int, [c_void_p, c_int, POINTER(clast_table)], 'One of the tables.'),
    'clast_evolve_aggregate': (c_int, [c_void_p, c_int64, POINTER(clast_assembly)], 'The grains of the body that is this node of the tree of events, about its centre of mass, with their contacts: particles at the start are nodes 0 .'),
    'clast_evolve_largest': (c_int, [c_void_p, POINTER(c_int32), POINTER(c_int64)], 'Nodes of the bodies of most grains first, of equal ones the older first: [*n] of at most *n.'),
    'clast_evolve_assembly': (c_int, [c_void_p, POINTER(clast_assembly), POINTER(clast_table)], 'All grains where they are, in the fluid and on the floor.'),
    'clast_evolve_save': (c_int, [c_void_p, POINTER(clast_table)], 'All that is needed to go on, as tables: clast_state keeps them.'),
    'clast_evolve_restore': (c_int, [POINTER(clast_table), c_void_p], 'Goes on from there to the same bits; `evolve` was just created from the same configuration.'),
    'clast_evolve_load': (c_int, [POINTER(clast_evolve_config), POINTER(clast_evolve_source)], "@return the reader's status and line, with the option before it."),
    'clast_evolve_unload': (None, [POINTER(clast_evolve_source)], 'may be called twice.'),
    'clast_evolve_run': (c_int, [POINTER(clast_evolve_config), c_char_p, POINTER(clast_monitor), POINTER(clast_evolve_result)], 'Follows the cloud to its end; with a folder writes tables, states, charts, manifest and summary into it, and checkpoints on the way.'),
    'clast_evolve_resume': (c_int, [c_char_p, POINTER(clast_monitor), POINTER(clast_evolve_result)], 'Goes on from the newest checkpoint of a folder; ends in the same bytes.'),
    'clast_fields_default': (c_int, [POINTER(clast_field), c_void_p], 'Sets every field to its default.'),
    'clast_fields_free': (None, [POINTER(clast_field), c_void_p], 'Frees owned texts and lists.'),
    'clast_fields_check': (c_int, [POINTER(clast_field), c_void_p], 'Whether each field holds what the table allows: numbers finite and in their range, choices of the list, texts and lists not NULL.'),
    'clast_fields_find': (POINTER(clast_field), [POINTER(clast_field), c_char_p], "The named field ('-' and '_' alike), or NULL."),
    'clast_fields_nearest': (c_char_p, [POINTER(clast_field), c_char_p], 'Known name nearest to a misspelt one (edit distance), or NULL when nothing is near.'),
    'clast_field_set': (c_int, [POINTER(clast_field), c_void_p, c_char_p, c_bool], 'Parses a text ("675 um", "50deg", "true", "exact") into a field.'),
    'clast_field_set_si': (c_int, [POINTER(clast_field), c_void_p, c_char_p, c_bool], 'The same of what clast_field_format and clast_fields_json write: every bare number is SI.'),
    'clast_field_clear': (None, [POINTER(clast_field), c_void_p], 'Empties a list field.'),
    'clast_field_format': (c_int, [POINTER(clast_field), c_void_p, c_int32, c_size_t, c_char_p], 'Value as text, as clast_field_set_si reads it (17 digits, SI, no unit).'),
    'clast_field_count': (c_int32, [POINTER(clast_field), c_void_p], 'Number of items: lists their length, all others 1.'),
    'clast_field_is_default': (c_bool, [POINTER(clast_field), c_void_p], 'Whether the field has its default.'),
    'clast_fields_idle': (POINTER(clast_field), [POINTER(clast_field), c_void_p, POINTER(clast_idle), POINTER(c_char_p)], 'The first field that is idle by a rule and has another value than its default: a parameter without effect is a mistake of the person who gives it.'),
    'clast_unit_parse': (c_int, [c_char_p, c_char_p, POINTER(c_double)], 'Parses a number with an optional unit of the given dimension ("2.8 mm" for "m"); plain numbers are SI.'),
    'clast_unit_parse_asked': (c_int, [c_char_p, c_char_p, POINTER(c_double)], 'The same where a unit is asked for: a bare length or angle other than 0 is refused, with its nearest correct spelling ("270um", "50deg").'),
    'clast_unit_parse_length': (c_int, [c_char_p, c_char_p, POINTER(c_double)], 'A length as typed, in a file\'s `own` unit ("mm"; "" or "model": it names none): one with a unit is converted, or refused where the file names none; a bare number is in the file\'s own, but for metres, of which it is refused as by clast_unit_parse_asked.'),
    'clast_unit_factor': (c_int, [c_char_p, c_char_p, POINTER(c_double)], 'Factor that turns one `unit` into SI `si_unit`; CLAST_E_CONFIG lists the known units.'),
    'clast_unit_for': (c_char_p, [c_double, c_char_p, POINTER(c_double)], 'The unit in which a person would write `value` of this SI unit: "um" of 3.75e-6 m.'),
    'clast_fields_read': (c_int, [c_char_p, POINTER(clast_field), c_void_p], 'Reads a YAML mapping of keys to scalars or lists of scalars over `config` (already defaulted).'),
    'clast_fields_parse': (c_int, [c_char_p, c_char_p, POINTER(clast_field), c_void_p], 'The same from a text, YAML or JSON (what clast_fields_json writes: every bare number is SI); `name` stands for the path.'),
    'clast_fill_idle': (POINTER(clast_idle), [POINTER(clast_fill_config), POINTER(clast_idle)], 'The fields that a filling by the others does not look at (clast_fields_idle).'),
    'clast_fill': (c_int, [POINTER(clast_mesh), POINTER(clast_fill_config), POINTER(clast_monitor), POINTER(clast_spheres), POINTER(clast_fill_report)], 'Fills the solid bounded by a mesh with spheres.'),
    'clast_fill_measure': (c_int, [POINTER(clast_mesh), POINTER(clast_spheres), POINTER(clast_fill_report)], 'Measures any sphere set against the solid bounded by a mesh: all of the report but end, bound and n_tested.'),
    'clast_fill_history': (c_int, [POINTER(clast_mesh), POINTER(clast_spheres), POINTER(clast_table)], 'How the errors fall with the number of spheres: a row for each of the first 1, 2, .'),
    'clast_form_factor_about': (POINTER(clast_form_factor_entry), [c_int32], 'The entry of a factor, or NULL when there is no such number.'),
    'clast_form_factor_find': (c_int32, [c_char_p], 'The factor of this name or symbol ("flatness", "FL"; case and \'-\' or \'_\' alike), or -1.'),
    'clast_form_factors': (None, [c_double, c_double, c_double, POINTER(c_double)], 'All 13 factors of L >= I >= S > 0 (any unit), in the order of the list.'),
    'clast_form_factor_value': (c_double, [c_int, c_double, c_double, c_double], 'One of them.'),
    'clast_form_features': (None, [c_double, c_double, c_double, POINTER(c_double)], 'The 13 factors and then their inverses 1/X; NaN where X has no value, is 0, or, of those two indices, within 1e-6 of it.'),
    'clast_form_feature_name': (c_char_p, [c_int32], 'Name of feature 0 .'),
    'clast_form_sieve_size': (c_double, [c_double, c_double], 'Sieve size D = sqrt((S^2 + I^2)/2): the edge of the square hole that an ellipse of height S and width I just passes.'),
    'clast_form_lengths': (None, [c_double, c_double, c_double, POINTER(c_double)], 'Lengths of a grain with this flatness S/I, elongation I/L and sieve size D.'),
    'clast_form_zingg': (c_int, [c_double, c_double], 'The class; CLAST_N_ZINGG where a ratio is not a number.'),
    'clast_zingg_name': (c_char_p, [c_int], '"sphere", "disc", "rod", "blade"; "-" for no class.'),
    'clast_form_law_rhine': (clast_form_law, [], "The paper's Rhine gravel: flatness 0.647 and 0.175, elongation 0.682 and 0.139, cut to 0.1 ."),
    'clast_form_law_check': (c_int, [POINTER(clast_form_law)], '@return CLAST_E_CONFIG for numbers that are not finite, deviations below 0, a range that is not 0 < low <= high <= 1, a mean outside of it with deviation 0, or a range that holds less than 1e-6 of a law.'),
    'clast_form_law_draw': (None, [POINTER(clast_form_law), c_uint64, c_uint64, POINTER(c_double), POINTER(c_double)], 'Flatness S/I and elongation I/L of grain `index`: a function of (law, seed, index) alone.'),
    'clast_form_law_cut': (clast_form_law_moments, [POINTER(clast_form_law)], 'Moments of the law as it is drawn from, cut to its range.'),
    'clast_row_fault_text': (c_char_p, [c_int], '"missing", "not a number", .'),
    'clast_form_columns_named': (c_bool, [c_char_p], 'Whether the names of a list "a,b" (flatness, elongation) or "a,b,c" (L, I, S) are a form\'s by their words, each that of its place: "flatness_mean,elongation_mean", "mean L,mean I,mean S" or "L_mm,I_mm,S_mm", not "sand,mu" or "length,width,time_s"; a letter counts at the beginning of a name, and as a capital at its end.'),
    'clast_form_set_named': (c_bool, [POINTER(clast_table)], 'Whether the columns of a table are named as those of forms, whatever is in them; false of NULL.'),
    'clast_form_set_of': (c_int, [POINTER(clast_table), c_char_p, POINTER(clast_form_set)], 'Takes the forms out of a table.'),
    'clast_form_set_free': (None, [POINTER(clast_form_set)], '.'),
    'clast_form_set_complaint': (None, [POINTER(clast_form_set), c_size_t, c_char_p], 'One line about the rows left out, "3 rows left out: 2 missing, 1 above 1 (first: row 7)"; empty if none was.'),
    'clast_form_set_count_words': (c_char_p, [POINTER(clast_form_set), c_size_t, c_char_p], 'What to say of unread_count: "column \'n\' is not looked at: each row is one grain"; "" where nothing is.'),
    'clast_form_set_factors': (c_int, [POINTER(clast_form_set), POINTER(clast_table)], "The 13 form factors of every grain, in Table 1's order, and its size if known: what clast_statistics_of takes."),
    'clast_form_set_left_out': (c_int, [POINTER(clast_form_set), POINTER(clast_table)], 'Rows left out, as columns row (from 1) and reason.'),
    'clast_reform_principal': (c_int, [POINTER(clast_mesh), POINTER(clast_mesh), POINTER(c_double)], 'The grain with its centroid at the origin, L along x, I along y and S along z, unstretched.'),
    'clast_reform_mesh': (c_int, [POINTER(clast_mesh), POINTER(c_double), POINTER(clast_mesh)], 'The same stretched to these lengths L >= I >= S > 0; measured ones agree within 1e-13 for grains of S/L > 0.03.'),
    'clast_reform_hull': (c_int, [POINTER(clast_mesh), c_int32, POINTER(clast_mesh)], 'Convex hull of at most this many triangles: the hull, simplified at constant volume where it has more, and the hull of that, for simplifying leaves faces that bend inwards by little.'),
    'clast_sizes_alloc': (c_int, [c_int64, POINTER(clast_sizes)], 'Allocates n rows, zeroed; `sizes` must be empty.'),
    'clast_sizes_free': (None, [POINTER(clast_sizes)], 'Frees the arrays; may be called twice.'),
    'clast_curve_make': (c_int, [c_int32, POINTER(c_double), POINTER(c_double), POINTER(clast_curve)], 'Curve from sieves [n_class + 1] m in ascending order and masses [n_class] of any unit.'),
    'clast_curve_free': (None, [POINTER(clast_curve)], 'may be called twice.'),
    'clast_curve_case_at': (POINTER(clast_curve_case), [c_int32], 'The i-th of the seven published curves U1, U3, U5, U7, B30, B50, B70; NULL after the last.'),
    'clast_curve_named': (c_int, [c_char_p, POINTER(clast_curve)], 'Curve of a published case.'),
    'clast_curve_passing': (c_double, [POINTER(clast_curve), c_double], 'Share of the mass that passes a sieve of this size; NaN for a curve of no class.'),
    'clast_curve_size': (c_double, [POINTER(clast_curve), c_double], 'Size that this share of the mass passes, 0 .'),
    'clast_curve_class_size': (c_double, [POINTER(clast_curve), c_int32], 'Geometric mean size of a class, sqrt(s_i s_i+1) [m].'),
    'clast_curve_count': (c_double, [POINTER(clast_curve), c_int32, c_double, c_double, c_double], 'Grains of a class in a mass [kg], n_i = m_i m_tot / (rho V d_i^3).'),
    'clast_phi_of_size': (c_double, [c_double], 'Sieve size in phi units, -log2(D / 1 mm), and back [m].'),
    'clast_phi_size': (c_double, [c_double], '.'),
    'clast_grading_destroy': (None, [c_void_p], 'NULL is allowed.'),
    'clast_grading_of_curve': (c_int, [POINTER(clast_curve), c_int, c_int, POINTER(c_void_p)], 'Distribution of a sieve curve.'),
    'clast_grading_of_sizes': (c_int, [POINTER(clast_sizes), c_bool, POINTER(c_void_p)], 'Distribution of a list: rows of one size or of a bin (constant over log size) with counts, or with masses.'),
    'clast_grading_uniform': (c_int, [c_double, c_double, POINTER(c_void_p)], 'Uniform over size, by number; low = high is one size.'),
    'clast_grading_lognormal': (c_int, [c_double, c_double, c_double, c_double, POINTER(c_void_p)], 'Log-normal by number with this mean and standard deviation of the size itself, cut off outside [low, high]; low = 0 and high = INFINITY cut nothing.'),
    'clast_grading_draw': (c_double, [c_void_p, c_uint64, c_uint64], 'Size of grain `index` [m]: a function of (seed, index) alone.'),
    'clast_grading_range': (None, [c_void_p, POINTER(c_double), POINTER(c_double)], 'Smallest and largest size that can be drawn; the largest is INFINITY for an uncut log-normal.'),
    'clast_grading_share': (c_double, [c_void_p, c_double], 'Share of the grains, and of their volume at equal shape, that is not larger than this size; NaN for NaN.'),
    'clast_grading_mass_share': (c_double, [c_void_p, c_double], '.'),
    'clast_grading_size': (c_double, [c_void_p, c_double], 'Size that this share of the grains, or of their volume, does not exceed [m]; the inverses of the two above, in closed form but for masses under `linear` (bisection to the last bits).'),
    'clast_grading_mass_size': (c_double, [c_void_p, c_double], '.'),
    'clast_grading_mean_cube': (c_double, [c_void_p], 'Mean of D^3 [m^3]: a mass M of grains of density rho holds M / (rho V mean_cube) grains on average, V the volume at size 1.'),
    'clast_grading_compare': (c_int, [c_void_p, POINTER(clast_curve), POINTER(clast_grading_sample), POINTER(clast_table), POINTER(clast_grading_match)], 'Grains against the curve that they were to follow: one row a class, below and above it.'),
    'clast_curve_read': (c_int, [c_char_p, POINTER(clast_curve)], 'Sieve curve from delimited text with a header, one row a sieve in any order.'),
    'clast_curve_parse': (c_int, [c_char_p, c_void_p, c_size_t, POINTER(clast_curve)], 'The same from memory; `name` stands for the path in messages.'),
    'clast_grading_load': (c_int, [c_char_p, c_int, c_int, POINTER(clast_curve), POINTER(c_void_p)], 'Sizes by one text, as in the option `curve`: a published case (U1 .'),
    'clast_grading_list_of': (clast_grading_list, [c_void_p], 'The list that clast_grading_load read, by "list:FILE" or "masses:FILE"; its texts live as long as the grading.'),
    'clast_grading_list_text': (c_char_p, [POINTER(clast_grading_list), c_bool, c_size_t, c_char_p], 'The same in words, in `size` bytes: "40 rows, counted by column \'number\': 820 in all; not looked at: id"; "" for no list.'),
    'clast_grading_idle': (POINTER(clast_idle), [POINTER(clast_curve), c_int, POINTER(clast_idle)], 'Which of the options `spread` and `count` such sizes do not look at (clast_fields_idle).'),
    'clast_sizes_read': (c_int, [c_char_p, c_char_p, c_char_p, POINTER(clast_sizes)], "Sizes, sizes with counts, or bins with counts, from delimited text (clast_table_parse_csv; a comment may stand behind a row's cells too, a separator behind the last of them is none, and a first row that begins with a number names no columns)."),
    'clast_sizes_parse': (c_int, [c_char_p, c_char_p, c_char_p, c_char_p, POINTER(clast_sizes)], 'The same from memory; `name` stands for the path in messages.'),
    'clast_grain_measure': (c_int, [POINTER(clast_mesh), POINTER(clast_grain)], 'Measures the solid bounded by a closed outward surface.'),
    'clast_grain_measure_hull': (c_int, [POINTER(clast_mesh), POINTER(clast_grain)], "The same for the convex hull of the surface's vertices, which may be open or have no triangles; hull_volume_added is that of the surface given where it is closed, else NaN."),
    'clast_grain_measure_clump': (c_int, [POINTER(clast_spheres), POINTER(clast_grain)], 'Measures of a union of spheres (a clump), overlaps counted once.'),
    'clast_axes_name': (c_char_p, [c_int32], 'Name ("ellipsoid"), definition and source of a definition of L, I, S; NULL beyond the last.'),
    'clast_axes_definition': (c_char_p, [c_int32], '.'),
    'clast_axes_source': (c_char_p, [c_int32], '.'),
    'clast_grain_scale': (None, [POINTER(clast_grain), c_double], 'Multiplies all lengths by a factor > 0: a grain measured in mm becomes one in metres with 1e-3.'),
    'clast_grains_read': (c_int, [c_int32, POINTER(c_char_p), POINTER(clast_grains_options), POINTER(clast_monitor), POINTER(clast_grains)], 'Measures every grain of n files, in parallel, whatever becomes of the others.'),
    'clast_grains_free': (None, [POINTER(clast_grains)], '.'),
    'clast_grains_idle': (POINTER(clast_idle), [POINTER(clast_grains_options), c_uint32, POINTER(clast_idle)], 'The options of `clast shape` (degree, level, spacing, voxels, voxel_type, ...) that files of these kinds do not look at (clast_fields_idle).'),
    'clast_grains_kind_name': (c_char_p, [c_int], '"surface", "series", "voxels", "points", "table", "clump" .'),
    'clast_grains_to_metres': (c_int, [POINTER(clast_grains), c_double, POINTER(c_bool)], "Brings all lengths to metres: by the file's own unit where it says one, else by `unit_m`."),
    'clast_grains_table': (c_int, [POINTER(clast_grains), c_int, c_bool, POINTER(clast_table)], 'Everything as a table: a row a grain; L, I, S, D and the form factors by one definition, then L, I, S by each.'),
    'clast_harmonics_alloc': (c_int, [c_int32, POINTER(clast_harmonics)], 'Allocates all terms up to a degree, zeroed; `series` must be empty.'),
    'clast_harmonics_free': (None, [POINTER(clast_harmonics)], '.'),
    'clast_harmonics_power': (c_double, [POINTER(clast_harmonics), c_int32, c_int32], 'Power of the degrees from low to high: the mean square over all directions of what they add to the radius, by 4 pi.'),
    'clast_harmonics_mesh': (c_int, [POINTER(clast_harmonics), c_int32, c_int, POINTER(clast_mesh)], 'Surface sampled on an icosahedron divided `level` times (0 to 8: 20 * 4^level triangles).'),
    'clast_harmonics_mass': (c_int, [POINTER(clast_harmonics), c_int32, POINTER(clast_mass), POINTER(c_double)], 'Volume, centroid, inertia and area of the series itself by Gauss-Legendre quadrature in cos theta and equal steps in phi.'),
    'clast_harmonics_measure': (c_int, [POINTER(clast_harmonics), c_int32, c_int, POINTER(clast_grain)], 'Measures the grain: volume, area, centroid, inertia and what follows from them (moments, ellipsoid, sphericity) from the series; calipers, boxes, shadows, convexity, roundness and angularity from its surface of this level.'),
    'clast_harmonics_read': (c_int, [c_char_p, POINTER(clast_harmonics)], "Reads a coefficient file: rows `n m Re(a) Im(a)` of a series sum a_nm Y_nm over -n <= m <= n, in any order; text after '#' is skipped."),
    'clast_harmonics_parse': (c_int, [c_void_p, c_size_t, POINTER(clast_harmonics)], 'The same from memory: a pure function of the bytes.'),
    'clast_synthesize_idle': (POINTER(clast_idle), [POINTER(clast_synthesize_config), POINTER(clast_idle)], 'The fields that a grain by the others does not look at (clast_fields_idle).'),
    'clast_synthesize_grain': (c_int, [POINTER(clast_synthesize_config), c_uint64, POINTER(clast_mesh), POINTER(clast_synthesize_report)], 'Grain `index`: a convex mesh in its principal frame (L along x, S along z), a function of (config, index) alone.'),
    'clast_kernel_table': (POINTER(clast_kernel_info), [], 'The table, [CLAST_N_KERNEL]; bit k of a kernel mask stands for row k.'),
    'clast_kernel_parse': (c_int, [c_char_p, POINTER(c_uint32)], 'Mask of "brownian" or a sum, "brownian+settling" .'),
    'clast_kernel_needs': (c_uint32, [c_uint32], 'Everything that the kernels of a mask need.'),
    'clast_kernel_check': (c_int, [c_uint32, POINTER(clast_medium)], 'Checks that the medium holds what the kernels need (> 0, finite), and that no two of the kernels count the same mechanism.'),
    'clast_kernel_value': (c_double, [c_uint32, POINTER(clast_medium), POINTER(clast_collider), POINTER(clast_collider)], 'Sum of the kernels in the mask.'),
    'clast_kernel_settling_speed': (c_double, [POINTER(clast_medium), POINTER(clast_collider)], 'Settling speed [m/s] of a particle, weight less buoyancy against the drag of a sphere of its radius; < 0 where the fluid is denser.'),
    'clast_kernel_collision_efficiency': (c_double, [POINTER(clast_medium), POINTER(clast_collider), POINTER(clast_collider)], "Share E of the particles in the swept cylinder pi (a1 + a2)^2 that a settling pair meets: the medium's constant, or where that is 0 E = 1 - (1 - E_i)(1 - E_c) each (viscous + potential Re/60) / (1 + Re/60) inertia (1 + 3/4 ln(2 St) / (St - 1.214))^-2, (St / (St + 1/2))^2 interception 1 - 3/2 (1 + p)^-1 + 1/2 (1 + p)^-3, 1 - (1 + p)^-3 with the ratio of radii p <= 1, St = tau_small |w1 - w2| / a_large, Re = 2 a_large |w1 - w2| / nu."),
    'clast_impact_speed': (c_double, [c_uint32, POINTER(clast_medium), POINTER(clast_collider), POINTER(clast_collider)], 'Speed [m/s] at which a pair meets by the kernels of a mask: the sum over them of kernel over pi (a1 + a2)^2, without collision efficiency and clustering (the mean relative speed of straight paths).'),
    'clast_kernel_range_row': (POINTER(clast_kernel_range), [c_int32], 'Row k of the table; NULL where there is none.'),
    'clast_range_use_words': (c_char_p, [POINTER(clast_range_use), c_size_t, c_char_p], 'One line: the owner, the quantity, the farthest value, its range and the source.'),
    'clast_range_report_use': (POINTER(clast_range_use), [POINTER(clast_range_report)], 'Of a run the use that tells more: collisions where some were outside, else particles at the start where some were; NULL of NULL.'),
    'clast_kernel_dense_words': (c_char_p, [c_double, c_size_t, c_char_p], 'What to say of particles that fill over a tenth of the volume, where kernels are of dilute suspensions; "" of fewer and of NaN.'),
    'clast_sticking_check': (c_int, [POINTER(clast_sticking)], 'Whether a law has what it needs.'),
    'clast_sticking_stokes': (c_double, [POINTER(clast_sticking), POINTER(clast_impact)], 'Impact Stokes number of the law: m~ u / (6 pi mu a~^2) of reduced mass and radius of curvature for a viscous film [Ennis1991 for two equal spheres, u = 2 u_0: 8 rho u_0 a / (9 mu)], 8 rho u / (9 mu) d1 d2 / (d1 + d2) with the mean density of both for wet ash [Costa2010]; NaN for the other laws.'),
    'clast_sticking_speed': (c_double, [POINTER(clast_sticking), POINTER(clast_impact)], 'Speed [m/s] up to which elastic spheres stick: the work that a JKR contact takes to part, 7.09 (Gamma^5 a~^4 / E*^2)^(1/3), against m~ v^2 / 2.'),
    'clast_sticking_share': (c_double, [POINTER(clast_sticking), POINTER(clast_impact)], 'Share of such impacts that stick.'),
    'clast_memory_set_limit': (c_int, [c_int64], 'Sets the limit in bytes; 0: none.'),
    'clast_memory_limit': (c_int64, [], 'The limit in bytes; 0: none.'),
    'clast_memory_taken': (c_int64, [], "Bytes that the library's blocks take now."),
    'clast_parallel_set_threads': (None, [c_int32], 'Threads for all later work of the calling thread; 0 means OMP_NUM_THREADS where it is set, else one per core that the process may use.'),
    'clast_parallel_threads': (c_int32, [], 'Threads in use.'),
    'clast_comm_one': (POINTER(clast_comm), [], 'The only rank of one.'),
    'clast_comm_agree': (c_int, [POINTER(clast_comm), c_int, c_char_p], 'Makes all ranks agree on how a step ended: OK when it was so for every one, else the status and text of the first rank that failed (one that was merely stopped only if none failed).'),
    'clast_mesh_free': (None, [POINTER(clast_mesh)], 'Frees the arrays; the mesh is then empty.'),
    'clast_mesh_alloc': (c_int, [c_int32, c_int32, POINTER(clast_mesh)], 'Allocates n_vert vertices and n_tri triangles, zeroed.'),
    'clast_mesh_copy': (c_int, [POINTER(clast_mesh), POINTER(clast_mesh)], 'Deep copy into an empty mesh.'),
    'clast_mesh_append': (c_int, [POINTER(clast_mesh), POINTER(clast_mesh)], 'Appends all parts of `other` (vertex numbers shifted).'),
    'clast_mesh_bounds': (None, [POINTER(clast_mesh), POINTER(c_double), POINTER(c_double)], 'Axis-aligned box of all vertices; an empty mesh gives low > high.'),
    'clast_mesh_area': (c_double, [POINTER(clast_mesh)], "Sum of the triangles' areas [m^2]."),
    'clast_mesh_mass': (c_int, [POINTER(clast_mesh), POINTER(clast_mass)], 'Volume, centroid and inertia of the solid bounded by a closed, outward mesh.'),
    'clast_mesh_volume': (c_double, [POINTER(clast_mesh)], 'Signed volume of any mesh about its own first vertex: < 0 when inside out, meaningless when open.'),
    'clast_mesh_length': (c_int, [POINTER(clast_mesh), POINTER(c_double)], "Greatest vertex-to-vertex distance, exact (farthest pair of the convex hull's vertices)."),
    'clast_mesh_box': (c_int, [c_double, c_double, c_double, POINTER(clast_mesh)], 'Box with one corner at the origin and these edges (above 0), 12 triangles.'),
    'clast_mesh_ellipsoid': (c_int, [POINTER(c_double), c_int, POINTER(clast_mesh)], 'Ellipsoid of these semi-axes (above 0): an icosahedron divided `level` times (20 * 4^level triangles), on the surface.'),
    'clast_mesh_transform': (None, [POINTER(clast_mesh), c_double, POINTER(c_double), POINTER(c_double)], 'x -> scale * R(orientation) x + position for every vertex; orientation is a unit quaternion w, x, y, z.'),
    'clast_bvh_create': (c_int, [POINTER(clast_mesh), POINTER(c_void_p)], 'Builds the hierarchy.'),
    'clast_bvh_destroy': (None, [c_void_p], 'NULL is allowed.'),
    'clast_bvh_inside': (c_bool, [c_void_p, POINTER(c_double)], 'True when the point is inside the surface, or exactly on a closed one.'),
    'clast_bvh_closest': (c_double, [c_void_p, POINTER(c_double), c_double, POINTER(c_double), POINTER(c_int32)], 'Distance to the nearest point of the surface if that is at most max_distance (INFINITY: any), else INFINITY, with closest and tri untouched.'),
    'clast_bvh_signed_distance': (c_double, [c_void_p, POINTER(c_double)], 'Distance to the surface, negative inside (clast_bvh_inside); NaN of a point with a NaN.'),
    'clast_bvh_ray': (c_bool, [c_void_p, POINTER(c_double), POINTER(c_double), c_double, c_double, POINTER(clast_hit)], 'First hit with t_low <= t <= t_high of the ray origin + t direction, from either side.'),
    'clast_mesh_hull': (c_int, [POINTER(clast_mesh), POINTER(clast_mesh)], "Convex hull of a mesh's vertices: a closed, outward triangle surface whose vertices are the mesh's own extreme points, unmoved."),
    'clast_mesh_format_name': (c_char_p, [c_int], 'Lower-case name of a format ("stl").'),
    'clast_mesh_format_of_path': (c_int, [c_char_p], "Format by a path's extension (any case), or CLAST_MESH_ANY when it is none of ours."),
    'clast_mesh_read': (c_int, [c_char_p, POINTER(clast_mesh), POINTER(clast_mesh_read_report)], 'Reads a surface: STL, OBJ, PLY or OFF, by content first, then by extension.'),
    'clast_mesh_parse': (c_int, [c_void_p, c_size_t, c_int, POINTER(clast_mesh), POINTER(clast_mesh_read_report)], 'As clast_mesh_read from memory: a pure function of the bytes.'),
    'clast_mesh_require_unit': (c_int, [c_char_p, POINTER(clast_mesh_read_report), c_char_p], 'Refuses a unit for a surface whose file says another.'),
    'clast_mesh_write': (c_int, [POINTER(clast_mesh), c_char_p, POINTER(clast_mesh_write_options)], 'Writes a surface.'),
    'clast_mesh_write_idle': (POINTER(clast_idle), [c_int, POINTER(clast_idle)], 'The option `name` where a file of this format names no part (clast_fields_idle).'),
    'clast_mesh_check': (c_int, [POINTER(clast_mesh), POINTER(clast_mesh_check_result)], 'What is this surface, and can it be trusted? The counts are exact for the mesh as it is: vertices are the same only when their numbers are.'),
    'clast_mesh_check_free': (None, [POINTER(clast_mesh_check_result)], 'Frees what clast_mesh_check found; may be called twice.'),
    'clast_mesh_check_doubles': (None, [POINTER(clast_mesh_check_result), c_size_t, c_char_p], 'What counts twice, or may, in the volume of a closed surface, or is no volume but counts in its area: "it cuts itself at 6 pairs of triangles; its volume counts overlaps twice", "" where nothing does.'),
    'clast_mesh_check_passed': (c_bool, [POINTER(clast_mesh_check_result)], 'Closed, oriented and manifold, and not flat: no blocking fault.'),
    'clast_mesh_weld': (c_int, [POINTER(clast_mesh), c_double, POINTER(clast_mesh), POINTER(c_int32)], 'Merges vertices nearer than `tolerance` times the extent (the diagonal of the box), drops triangles that collapse and vertices that nothing uses.'),
    'clast_mesh_repair_idle': (POINTER(clast_idle), [POINTER(clast_mesh_repair_config), POINTER(clast_idle)], 'The fields that a repair by the others does not look at (clast_fields_idle).'),
    'clast_mesh_repair': (c_int, [POINTER(clast_mesh), POINTER(clast_mesh_repair_config), POINTER(clast_mesh), POINTER(clast_mesh_repair_report)], 'Makes a surface closed, oriented and manifold where it can, step by step, and reports every change.'),
    'clast_mesh_weld_auto': (c_int, [POINTER(clast_mesh), POINTER(clast_mesh_repair_report)], 'The one weld that every command applies to a surface that it reads: vertices of open edges that rounding has parted become one (CLAST_WELD_AUTO).'),
    'clast_mesh_distance': (c_int, [POINTER(clast_mesh), POINTER(clast_mesh), POINTER(clast_mesh_deviation)], '@return CLAST_E_GEOMETRY if one has no triangles @note O((n + m) log), any thread count alike.'),
    'clast_mesh_simplify': (c_int, [POINTER(clast_mesh), c_int32, POINTER(clast_mesh), POINTER(clast_mesh_simplify_report)], 'Fewer triangles, same volume: edges collapse, cheapest first, each to the point that keeps the volume exactly and moves the surface least.'),
    'clast_mesh_round_float': (c_int, [POINTER(clast_mesh)], 'Rounds coordinates to the 24 bits that an STL keeps, the last bits chosen so that the volume stays: each coordinate is at most two float steps off, the volume by about 1e-11 (plain rounding of a few hundred vertices costs 1e-8).'),
    'clast_mesh_read_welded': (c_int, [c_char_p, POINTER(clast_mesh), POINTER(clast_mesh_repair_report)], 'Reads a surface as every command does that needs a solid: clast_mesh_read, then clast_mesh_weld_auto.'),
    'clast_mesh_require_solid': (c_int, [POINTER(clast_mesh), c_char_p, c_char_p], 'Whether a surface that was read from a file bounds a solid: closed and outward.'),
    'clast_mesh_cure': (c_int, [POINTER(clast_mesh), c_char_p, c_size_t, c_char_p], 'The shell command that makes a file\'s surface closed and outward, tried here in memory: "clast mesh repair grain.stl -o grain-closed.stl"; .ply where an STL could not keep it closed.'),
    'clast_pack_create': (c_int, [POINTER(clast_pack_config), POINTER(clast_pack_input), POINTER(c_void_p)], '@return CLAST_E_CONFIG for weights or densities that do not match the shapes, a mass that cannot fit under the region of generation, a lattice that holds no grain; what clast_dem_create and clast_dem_add_shape refuse.'),
    'clast_pack_destroy': (None, [c_void_p], 'NULL is allowed.'),
    'clast_pack_advance': (c_int, [c_void_p, c_int64], 'Goes on by at most n_step steps, or until done.'),
    'clast_pack_is_over': (c_bool, [c_void_p], 'done, or at max_steps.'),
    'clast_pack_phase_of': (c_int, [c_void_p], 'The phase that the process is in.'),
    'clast_pack_phase_name': (c_char_p, [c_int], '"generate" .'),
    'clast_pack_dem': (c_void_p, [c_void_p], 'The simulation inside.'),
    'clast_pack_mass': (c_double, [c_void_p], 'made so far [kg].'),
    'clast_pack_expected_steps': (c_int64, [c_void_p], 'Expected step of the end, as far as it can be determined; 0 when not.'),
    'clast_pack_measure': (c_int, [c_void_p, POINTER(clast_pack_result)], 'The numbers of the bed as it lies, SI; free them with clast_pack_result_free.'),
    'clast_pack_result_free': (None, [POINTER(clast_pack_result)], 'Frees what clast_pack_measure or clast_pack_run filled; may be called twice.'),
    'clast_pack_bed': (clast_bed, [c_void_p], 'Where the grains lie, for porosities.'),
    'clast_pack_porosity': (clast_porosity_options, [POINTER(clast_pack_config)], '.'),
    'clast_pack_series': (POINTER(clast_table), [c_void_p], 'Time series: step, time_s, phase, n_grain, mass_kg, mean_height_m, top_m, kinetic_energy_J, max_speed_m/s, n_contact, n_wall_contact, max_overlap_m.'),
    'clast_pack_load_table': (POINTER(clast_table), [c_void_p], 'What the bed carries and where its energy goes, rows as of the series and at the end of each stage: the table load.csv of docs/theory/load.md.'),
    'clast_pack_wall_table': (POINTER(clast_table), [c_void_p], 'Walls over time: where each is, force and torque of grains (means since the row before), work; grains that left: the table walls.csv of docs/theory/load.md.'),
    'clast_pack_achieved': (c_int, [c_void_p, POINTER(clast_table)], 'Sieve curve achieved beside the wanted one (columns as clast_grading_compare).'),
    'clast_pack_load': (c_int, [POINTER(clast_pack_config), POINTER(clast_pack_source)], "@return the reader's status, with the option and the file's name before its message."),
    'clast_pack_unload': (None, [POINTER(clast_pack_source)], 'may be called twice.'),
    'clast_pack_run': (c_int, [POINTER(clast_pack_config), c_char_p, POINTER(clast_comm), POINTER(clast_monitor), POINTER(clast_pack_result)], 'Runs a packing to its end; with a folder writes state.h5, series.csv, profile.csv, achieved.csv, summary.json, manifest.json, report.html, charts and frames into it, and checkpoints on the way.'),
    'clast_pack_resume': (c_int, [c_char_p, c_int64, POINTER(clast_comm), POINTER(clast_monitor), POINTER(clast_pack_result)], 'Goes on from the newest whole checkpoint of a folder, or from the end of a run that max_steps had ended early.'),
    'clast_pack_result_json': (c_int, [POINTER(clast_pack_result), c_bool, POINTER(c_char_p)], 'The result as one JSON object, names of DESIGN section 7.'),
    'clast_pairs_count': (c_int, [POINTER(clast_domain), POINTER(clast_cloud), POINTER(clast_pairs_config), POINTER(clast_pairs)], 'Counts the pairs of a cloud by their distance in shells of equal ratio, compares them with those of a uniform cloud in the same domain, and estimates the integral of the squared density.'),
    'clast_pairs_free': (None, [POINTER(clast_pairs)], '.'),
    'clast_pairs_uniform': (c_int, [POINTER(clast_domain), c_int32, POINTER(c_double), POINTER(c_double), POINTER(c_double)], 'Probability that two points, uniform in the domain, are closer than each radius: rises from 0 to 1, which it is from the diameter on.'),
    'clast_estimate_choose': (clast_estimate, [POINTER(clast_estimate), POINTER(clast_estimate), c_int, POINTER(c_bool)], 'One of two estimates of the same integral; NAN where one is NULL.'),
    'clast_bed_close': (c_int, [POINTER(clast_mesh), POINTER(clast_mesh)], 'The closed, outward surface of a container that may have holes: each is covered.'),
    'clast_bed_of_surface': (clast_bed, [POINTER(clast_mesh)], 'The inside of such a surface as a bed; its floor is the lowest point.'),
    'clast_bed_volumes': (None, [POINTER(clast_bed), c_int32, POINTER(c_double), POINTER(c_double)], 'Volume between the heights edge[k] and edge[k + 1] [m^3].'),
    'clast_bed_parse': (c_int, [c_char_p, POINTER(clast_bed)], 'Reads "cylinder:RADIUS", "cylinder:RADIUS,X,Y", "box:X0,Y0,X1,Y1", "periodic:X0,Y0,X1,Y1" or, in all three directions, "periodic:X0,Y0,Z0,X1,Y1,Z1[,SHIFT]", each number with an optional unit; the floor is at 0, or at Z0; a sheared cell\'s upper images lie farther along x by SHIFT.'),
    'clast_bed_format': (c_int, [POINTER(clast_bed), c_size_t, c_char_p], 'The text that clast_bed_parse reads, 17 digits; returns its length or -1 when it does not fit.'),
    'clast_bed_period': (c_bool, [POINTER(clast_bed), POINTER(c_double)], 'Periods in x, y and z [m], 0 for none; false for a bed that has none.'),
    'clast_bed_wrap': (None, [POINTER(clast_bed), POINTER(clast_assembly)], "Moves every grain's centroid into the bed's first image."),
    'clast_bed_table': (c_int, [POINTER(clast_bed), POINTER(clast_table)], 'The bed as a one-row table "bed" (text column bed, floor_m), which a run keeps in its state.'),
    'clast_bed_from_table': (c_int, [POINTER(clast_table), POINTER(clast_bed)], 'The bed of such a table; CLAST_E_FORMAT when it is none.'),
    'clast_bed_area': (c_double, [POINTER(clast_bed)], 'Horizontal area; of a surface its volume over its height [m^2].'),
    'clast_porosity_options_default': (clast_porosity_options, [], 'Exact shapes, 1 mm slices, cut at 0.5, nothing trimmed.'),
    'clast_porosity_grain_slabs': (c_int, [POINTER(clast_assembly), c_int32, c_int, c_int32, POINTER(c_double), POINTER(c_double)], 'Solid volume of grain i of an assembly below the heights edge[0] < edge[1] < ...: adds the part between edge[k] and edge[k + 1] to solid[k].'),
    'clast_porosity_profile': (c_int, [POINTER(clast_assembly), POINTER(clast_bed), POINTER(clast_porosity_options), POINTER(clast_table)], 'Porosity by height: columns z_low_m, z_high_m, solid_m3, porosity, from the floor to above the last grain.'),
    'clast_porosity_measure': (c_int, [POINTER(clast_assembly), POINTER(clast_bed), POINTER(clast_table), POINTER(clast_porosity_options), POINTER(clast_porosity_bulk)], 'Bulk porosity (16): solid volume between floor + trim and top - trim, not a mean of slices.'),
    'clast_bed_side_walls': (clast_bed_walls, [POINTER(clast_bed), POINTER(clast_assembly)], 'NAN throughout for beds or assemblies that do not hold together.'),
    'clast_bed_beyond_measure': (c_int, [POINTER(clast_bed), POINTER(clast_assembly), POINTER(clast_porosity_bulk), c_int, POINTER(clast_bed_beyond)], 'Between the heights of the bulk.'),
    'clast_bed_outside': (c_int, [POINTER(clast_bed), POINTER(clast_bed), POINTER(c_double), POINTER(c_double)], "Share of a bed's volume between two heights that lies outside another bed, by 20,000 quasi-random points: what a run's own bed does not hold has no grains, and would count as pores."),
    'clast_porosity_core_measure': (c_int, [POINTER(clast_assembly), POINTER(clast_bed), POINTER(clast_porosity_bulk), c_double, POINTER(clast_porosity_options), POINTER(clast_porosity_core)], 'Porosity of a cylinder or box away from its side walls, between the same heights as the bulk.'),
    'clast_bed_read': (c_int, [c_char_p, POINTER(clast_bed), POINTER(clast_mesh)], "The bed that a run's state file keeps."),
    'clast_bed_load': (c_int, [c_char_p, POINTER(clast_bed), POINTER(clast_mesh)], '"mesh:FILE,UNIT", the inside of a surface whose holes are covered (a file by clast_mesh_write that says its unit needs none here), or what clast_bed_parse takes.'),
    'clast_porosity_local': (c_int, [POINTER(clast_assembly), POINTER(clast_bed), c_double, c_double, POINTER(clast_table)], 'Porosity around each grain: its cell of the radical Voronoi diagram (power diagram) of the spheres of equal volume, inside the bed between two heights.'),
    'clast_porosity_radial': (c_int, [POINTER(clast_assembly), POINTER(clast_bed), POINTER(c_double), POINTER(clast_radial_options), POINTER(clast_table)], 'Porosity by distance from the axis of a cylindrical bed, between two heights.'),
    'clast_pores_free': (None, [POINTER(clast_pores)], 'Frees the table.'),
    'clast_pores_measure': (c_int, [POINTER(clast_assembly), POINTER(clast_bed), POINTER(c_double), POINTER(clast_pore_options), POINTER(clast_pores)], 'Sizes of the pores: delta(x), the distance of a point x of the pore space to the nearest grain.'),
    'clast_mean_of': (clast_mean, [c_int32, POINTER(c_double)], 'Mean of n values with its interval, in the unit of the values.'),
    'clast_porosity_mean_profile': (c_int, [c_int32, POINTER(clast_table), POINTER(clast_table)], "Mean porosity profile of n beds: z_low_m, z_high_m, porosity, deviation, low, high (95 % of the mean by Student's t; deviation 0 and no width for one bed), n."),
    'clast_fabric': (c_int, [POINTER(clast_assembly), POINTER(clast_table), POINTER(c_double), POINTER(clast_table)], "How an assembly's contacts and grains are directed: columns name, value, unit, meaning."),
    'clast_stress': (c_int, [POINTER(clast_table), POINTER(clast_bed), POINTER(c_double), POINTER(clast_table)], 'Mean stress between two heights, and what follows from it: columns name, value, unit, meaning.'),
    'clast_stress_profile': (c_int, [POINTER(clast_table), POINTER(clast_bed), POINTER(clast_table), POINTER(clast_table)], 'The same in the slices of a porosity profile: z_low_m, z_high_m, stress_xx_Pa, .'),
    'clast_bed_fields': (c_int, [POINTER(clast_bed), POINTER(clast_assembly), POINTER(clast_table), POINTER(clast_table), c_double, POINTER(clast_table)], 'Continuum fields from grains and contacts on a grid [Goldhirsch2010], exact at walls [Weinhart2012]: a row a cell, x fastest, with the mean of each field over the cell.'),
    'clast_bed_chains': (c_int, [POINTER(clast_bed), POINTER(clast_assembly), POINTER(clast_table), POINTER(clast_table)], "Contacts as lines from a's centre to b's, or to a wall, and which are links of a force chain: of three grains or more whose greatest principal pressure is above the mean of all, within 45 degrees of its direction."),
    'clast_bed_findings_free': (None, [POINTER(clast_bed_findings)], 'Frees the tables; may be called twice.'),
    'clast_bed_measure': (c_int, [POINTER(clast_assembly), POINTER(clast_bed_known), POINTER(clast_bed_options), POINTER(clast_bed_findings)], 'Everything that clast porosity measures of one bed.'),
    'clast_model_kind_name': (c_char_p, [c_int], '"single_form", "form_mixture", "columns" .'),
    'clast_mixture_feature_name': (c_bool, [c_int32, c_size_t, c_char_p], 'Name of feature 0 .'),
    'clast_mixture_feature_find': (c_int32, [c_char_p], 'Number of the named feature, or -1.'),
    'clast_form_feature_find': (c_int32, [c_char_p], '0 .'),
    'clast_form_inputs_of': (c_int, [POINTER(clast_form_set), POINTER(c_int64), c_int64, POINTER(clast_form_inputs)], 'Inputs from the grains of a set, all or those in `pick` (with repeats allowed).'),
    'clast_form_inputs_from_moments': (c_int, [POINTER(c_double), POINTER(c_double), c_int64, POINTER(clast_form_inputs)], 'Inputs from means and deviations, flatness and elongation taken as independent: mu_EQ = mu_EL mu_FL, s_EQ^2 = (mu_EL^2 + s_EL^2)(mu_FL^2 + s_FL^2) - mu_EL^2 mu_FL^2 [Rettinger2022 sec.'),
    'clast_porosity_model_free': (None, [POINTER(clast_porosity_model)], 'Frees all that a model owns; may be called twice.'),
    'clast_porosity_model_published': (c_int, [c_int32, POINTER(clast_porosity_model)], 'The published model of this number (0 .'),
    'clast_porosity_model_find': (c_int32, [c_char_p], 'Number of the published model of this name, or -1.'),
    'clast_porosity_model_by_grading': (c_bool, [c_char_p], 'Whether a grading chooses the model, "auto", "single" or "mixture": a name, a file or a model at hand (NULL) has its own.'),
    'clast_porosity_predict_set': (c_int, [POINTER(clast_porosity_model), POINTER(clast_form_set), POINTER(clast_bootstrap), POINTER(clast_form_inputs), POINTER(clast_prediction)], 'Porosity of a bed of these grains; with `bootstrap` the sampling error is the deviation of the porosity over resamples of the grains.'),
    'clast_porosity_predict_moments': (c_int, [POINTER(clast_porosity_model), POINTER(clast_form_inputs), POINTER(clast_prediction)], 'Porosity from means and deviations; inputs->n_grain > 1 gives the sampling error by the first derivatives, with variances s^2 / n of a mean and s^2 / (2 (n - 1)) of a deviation.'),
    'clast_porosity_predict_each': (c_int, [POINTER(clast_porosity_model), POINTER(clast_form_set), POINTER(clast_table)], "One row a grain: the single form of that grain as the only one of a bed; columns row (from 1, in the set's table), porosity, standard_error, in_range (1 or 0); porosity and standard_error are NaN where the model gives a porosity outside (0, 1)."),
    'clast_porosity_predict_columns': (c_int, [POINTER(clast_porosity_model), POINTER(clast_table), POINTER(clast_table)], 'One row a bed of a table with the columns that a model of kind CLAST_MODEL_COLUMNS names; columns as above.'),
    'clast_porosity_beds_words': (c_char_p, [POINTER(clast_porosity_model), POINTER(clast_table), c_size_t, c_char_p], 'How many of such beds have no porosity, and why; "" where all have one.'),
    'clast_porosity_model_check_units': (c_int, [POINTER(clast_porosity_model), POINTER(clast_table)], 'Whether a table that a person wrote has the units of such a model: of what the model has in metres plain numbers may be anything.'),
    'clast_porosity_predict_idle': (POINTER(clast_idle), [POINTER(clast_predict_given), POINTER(clast_idle)], 'The options of `clast predict` (grading, grains, columns, each, resamples, seed) that such a prediction does not look at (clast_fields_idle).'),
    'clast_porosity_prediction_table': (c_int, [POINTER(clast_porosity_model), POINTER(clast_form_inputs), POINTER(clast_prediction), POINTER(clast_table)], "One row: porosity, the errors, in_range and the inputs' means and deviations."),
    'clast_porosity_model_read': (c_int, [c_char_p, POINTER(clast_porosity_model)], 'Reads a model file, JSON as clast_porosity_model_write makes it.'),
    'clast_porosity_model_parse': (c_int, [c_char_p, c_void_p, c_size_t, POINTER(clast_porosity_model)], 'The same from memory; `name` stands for the path in messages.'),
    'clast_porosity_model_write': (c_int, [POINTER(clast_porosity_model), POINTER(c_char_p), c_int32, c_char_p], 'Writes the model as JSON that reads back as the same doubles; the file appears whole or not at all.'),
    'clast_porosity_fit_idle': (POINTER(clast_idle), [POINTER(clast_porosity_fit_config), c_bool, POINTER(clast_idle)], 'The fields that a fit by the others does not look at (clast_fields_idle).'),
    'clast_fit_data_single': (c_int, [POINTER(clast_table), POINTER(clast_porosity_fit_config), POINTER(clast_fit_data)], "Beds of one form each: 26 features from each row's flatness and elongation or L, I, S."),
    'clast_fit_data_mixture': (c_int, [POINTER(clast_table), POINTER(clast_table), POINTER(clast_porosity_fit_config), POINTER(clast_fit_data)], "Beds of mixtures: 104 features of the grains that carry the bed's name in the column `group`."),
    'clast_fit_data_columns': (c_int, [POINTER(clast_table), POINTER(clast_porosity_fit_config), POINTER(clast_fit_data)], 'Any other table: candidates are the columns of numbers that `columns` names; without names all but the target and `group`, and in the results of a study (columns run, ..., exit_code, ...) those between run and exit_code but the seed, that is what was varied, and those that `use` names.'),
    'clast_fit_data_free': (None, [POINTER(clast_fit_data)], '.'),
    'clast_porosity_fit_choose': (c_int, [POINTER(clast_table), c_bool, POINTER(clast_porosity_fit_config), POINTER(c_int), POINTER(clast_fit_note)], "The features of a fit that names none (`clast fit --features auto`): mixture with a second table, of the beds' grains; single form where the table's columns, or those of `columns`, are a form's by their names, whatever is in them; else the table's own columns."),
    'clast_porosity_fit_data': (c_int, [POINTER(clast_fit_data), c_char_p, c_char_p, POINTER(clast_porosity_fit_config), POINTER(clast_porosity_fit)], 'Fits a model.'),
    'clast_porosity_fit_free': (None, [POINTER(clast_porosity_fit)], '.'),
    'clast_porosity_fit_note': (c_bool, [POINTER(clast_porosity_fit), POINTER(clast_table), POINTER(clast_fit_data), c_int32, POINTER(clast_porosity_fit_config), POINTER(clast_fit_note)], 'What people should know of a fit, line by line: rows that were left out, columns of words that are no candidates, why a selection has fewer features than n_term, the column that names the beds, features that count the rows.'),
    'clast_image_alloc': (c_int, [c_int32, c_int32, POINTER(clast_image)], 'Allocates the pixels, zeroed; `image` must be empty.'),
    'clast_image_free': (None, [POINTER(clast_image)], 'Frees the pixels; may be called twice.'),
    'clast_image_write_png': (c_int, [POINTER(clast_image), c_char_p], 'Writes a PNG file, whole or not at all.'),
    'clast_render_idle': (POINTER(clast_idle), [POINTER(clast_render_config), POINTER(clast_idle)], 'The fields that a picture by the others does not look at (clast_fields_idle).'),
    'clast_render_assembly': (c_int, [POINTER(clast_assembly), POINTER(clast_render_config), POINTER(clast_monitor), POINTER(clast_image)], 'Draws the assembly into `image` (which must be empty).'),
    'clast_report_write': (c_int, [POINTER(c_char_p), c_int32, c_char_p, POINTER(clast_report_config)], 'Writes the page, whole or not at all.'),
    'clast_report_write_run': (c_int, [c_char_p, c_char_p], 'FOLDER/report.html of one run, as a command does at its end.'),
    'clast_report_write_view': (c_int, [POINTER(clast_assembly), c_char_p, POINTER(clast_report_config)], 'A page with nothing but the 3-D view of an assembly, whole or not at all: what a notebook shows in a frame.'),
    'clast_report_unit': (c_char_p, [c_char_p], 'SI unit of a number of a summary or of a table by its key, as the page shows it: "z_high" and "size_m" -> "m" .'),
    'clast_manifest_create': (c_int, [c_char_p, c_int, POINTER(c_char_p), POINTER(c_void_p)], 'Starts a manifest: the clocks run from here.'),
    'clast_manifest_destroy': (None, [c_void_p], 'NULL is allowed.'),
    'clast_manifest_config': (c_int, [c_void_p, POINTER(clast_field), c_void_p], 'Keeps the full resolved configuration, SI, as the field table has it.'),
    'clast_manifest_seed': (None, [c_void_p, c_uint64], 'Keeps the seed.'),
    'clast_manifest_input': (c_int, [c_void_p, c_char_p, c_char_p], 'Keeps an input file\'s role ("core"), path, size and SHA-256 (both null for a pipe, which is read only once).'),
    'clast_manifest_note': (c_int, [c_void_p, c_char_p, c_char_p], 'Keeps a text under a key of the caller\'s ("resumed_from").'),
    'clast_manifest_write': (c_int, [c_void_p, c_char_p, c_char_p], 'Writes the manifest, whole or not at all; may be called at the start and again at the end.'),
    'clast_fields_json': (c_int, [POINTER(clast_field), c_void_p, POINTER(c_char_p)], 'A configuration as one JSON object of SI values in table order; free it with clast_text_free.'),
    'clast_text_free': (None, [c_char_p], 'Frees a text that the library made; NULL is allowed.'),
    'clast_sha256_file': (c_int, [c_char_p, c_char_p, POINTER(c_int64)], 'SHA-256 of a file in 64 lower-case hexadecimal digits, or "" and 0 bytes for a pipe or a device, which is read only once.'),
    'clast_run_inputs_agree': (c_int, [POINTER(clast_comm), POINTER(clast_field), c_void_p, c_int32, POINTER(c_char_p)], 'Refuses ranks that read different things, as from copies on their own disks: options, or files by their SHA-256.'),
    'clast_run_folder_begin': (c_int, [c_char_p, c_bool, c_char_p, POINTER(clast_monitor), POINTER(c_void_p)], 'Takes a folder for a run and starts its clocks; nothing is written yet.'),
    'clast_run_folder_destroy': (None, [c_void_p], 'NULL is allowed.'),
    'clast_run_folder_manifest': (c_void_p, [c_void_p], "The run's manifest, borrowed: give it configuration and seed before open."),
    'clast_run_folder_input': (c_int, [c_void_p, c_char_p, c_char_p], 'As clast_manifest_input; CLAST_E_USAGE when the file is part of the run that is to be replaced.'),
    'clast_run_folder_open': (c_int, [c_void_p], 'Makes the folder and its manifest.json ("running").'),
    'clast_run_folder_path': (c_char_p, [c_void_p], "The folder that the run's files go to; borrowed."),
    'clast_run_folder_file': (c_int, [c_void_p, c_char_p, c_char_p], 'The path of a file in it.'),
    'clast_run_folder_summary': (c_int, [c_void_p, c_char_p], 'Writes its summary.json, whole or not at all: a text of JSON and a newline.'),
    'clast_run_folder_end': (c_int, [c_void_p, c_int], 'Ends the run with the status of its work, which is returned (CLAST_OK: or why the folder could not be closed).'),
    'clast_run_folder_check': (c_int, [c_char_p], 'For readers: CLAST_OK when the folder holds a whole run, or a study, else CLAST_E_IO with one line that says what it holds: "RUN: stopped at 49 %, go on with clast pack --resume RUN" .'),
    'clast_run_folder_check_output': (c_int, [c_char_p, c_char_p], 'Refuses an output that is there as part of a run: its folder, or one above it, holds the run that wrote it.'),
    'clast_run_folder_check_input': (c_int, [c_char_p, c_char_p, c_char_p], 'Refuses an output that is this input, or the folder that holds it, whatever the spelling or link.'),
    'clast_run_folder_is_same': (c_bool, [c_char_p, c_char_p], 'Whether two paths are one place, whatever their spelling and links, where nothing need be yet.'),
    'clast_run_folder_state': (c_int, [c_char_p, c_char_p], "The state file that a command's argument means: a run folder's state.h5, else the argument itself."),
    'clast_fluid_air': (clast_fluid, [], 'Air at sea level in the International Standard Atmosphere (15 C): 1.225 kg/m^3, 1.7894e-5 Pa s; standard gravity 9.80665 m/s^2.'),
    'clast_drag_of_form': (c_int, [c_double, c_double, c_double, c_double, c_double, POINTER(clast_drag)], 'Corrections from the form dimensions L >= I >= S and the volume-equivalent diameter d (all in one unit), and from the density of the body over that of the fluid, r.'),
    'clast_drag_coefficient': (c_double, [POINTER(clast_drag), c_double], 'Drag coefficient at a Reynolds number > 0 by volume-equivalent diameter and area pi d^2 / 4: C_D = 24 k_S / Re (1 + 0.125 (Re k_N / k_S)^(2/3)) + 0.46 k_N / (1 + 5330 / (Re k_N / k_S)) fitted for Re < 3e5.'),
    'clast_drag_sphere': (c_double, [c_double], 'Drag coefficient of a sphere: the standard curve of Clift and Gauvin, for Re < 3e5.'),
    'clast_drag_sphere_reynolds': (c_double, [c_double], 'Reynolds number at which clast_drag_sphere gives this Best number, C_D Re^2, to rounding.'),
    'clast_slip_correction': (c_double, [c_double], "Cunningham's slip correction C with Davies' constants, by which drag in a gas is less."),
    'clast_drag_hindrance': (c_double, [c_double, c_double], 'Factor on the drag of a body among others that settle at this local porosity, with no net flow: e^-(n + 1), n = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2 / 2) [DiFelice1994] Re by the speed relative to the vessel, which is the superficial slip there.'),
    'clast_terminal_velocity': (c_int, [c_double, c_double, POINTER(clast_drag), POINTER(clast_fluid), POINTER(clast_settling)], 'Terminal velocity of a body of this volume-equivalent diameter and mean density.'),
    'clast_permeability': (c_int, [c_int, c_double, c_double, POINTER(c_double)], "Permeability k [m^2] of grains of this size (6 times volume over surface, Sauter's mean) at this porosity e; with s = (1 - e)^(1/3) Happel k = d^2 / 18 (3 - 4.5 s + 4.5 s^5 - 3 s^6) / (s^3 (3 + 2 s^5)) [Happel1958] Kozeny, Carman k = d^2 e^3 / (180 (1 - e)^2) [Carman1937] @return CLAST_E_USAGE outside of the law's range of porosities, or for a size that is not > 0."),
    'clast_drag_permeable': (c_double, [c_double, c_double], "Stokes drag of a permeable sphere over that of a solid one: creeping flow outside, Brinkman's equation inside, beta the radius over the root of the permeability."),
    'clast_terminal_velocity_permeable': (c_int, [c_double, c_double, POINTER(clast_drag), POINTER(clast_fluid), POINTER(clast_porous), POINTER(clast_settling)], 'Terminal velocity with the whole drag law scaled by clast_drag_permeable.'),
    'clast_spheres_alloc': (c_int, [c_int32, POINTER(clast_spheres)], 'Allocates n spheres, zeroed; `spheres` must be empty.'),
    'clast_spheres_free': (None, [POINTER(clast_spheres)], 'Frees the arrays; may be called twice.'),
    'clast_spheres_copy': (c_int, [POINTER(clast_spheres), POINTER(clast_spheres)], 'Copy that owns all it has; `copy` must be empty.'),
    'clast_shape_free': (None, [POINTER(clast_shape)], 'Frees all that a shape owns; may be called twice.'),
    'clast_shape_copy': (c_int, [POINTER(clast_shape), POINTER(clast_shape)], 'Copy that owns all it has; `copy` must be empty.'),
    'clast_shape_sphere': (c_int, [c_char_p, c_double, POINTER(clast_shape)], 'Sphere of this radius; CLAST_E_GEOMETRY where its volume and moments are no numbers above 0.'),
    'clast_shape_ellipsoid': (c_int, [c_char_p, POINTER(c_double), POINTER(clast_shape)], 'Ellipsoid of these semi-axes (any order; sorted a >= b >= c).'),
    'clast_shape_mesh': (c_int, [c_char_p, POINTER(clast_mesh), POINTER(clast_shape)], 'Solid bounded by a closed outward mesh (copied, moved so that its centroid is the origin).'),
    'clast_shape_clump': (c_int, [c_char_p, POINTER(clast_spheres), POINTER(clast_shape)], "Union of spheres (copied, moved so that the union's centroid is the origin)."),
    'clast_shape_surface': (c_int, [POINTER(clast_shape), c_int, POINTER(clast_mesh)], "A surface for pictures and files: the shape's own mesh, or an icosphere of the given level (one for each sphere of a clump: closed surfaces that may pass through each other)."),
    'clast_spheres_read': (c_int, [c_char_p, c_char_p, POINTER(clast_spheres)], 'Reads a sphere set: a state file (.h5) or delimited text with columns x, y, z and radius.'),
    'clast_spheres_write': (c_int, [POINTER(clast_spheres), c_char_p, c_char_p, c_char_p], 'Writes a sphere set, whole or not at all: .csv (x,y,z,radius, digits that read back the same) or .h5.'),
    'clast_state_write': (c_int, [POINTER(clast_state), c_char_p], 'Writes a state file: built in memory, checked by CRC-32 when read, whole or not at all.'),
    'clast_state_read': (c_int, [c_char_p, POINTER(clast_state)], 'Reads all of a state file into an empty state.'),
    'clast_state_table': (POINTER(clast_table), [POINTER(clast_state), c_char_p], "The state's table of this name, or NULL."),
    'clast_state_free': (None, [POINTER(clast_state)], 'Frees what clast_state_read made, the assembly too; may be called twice.'),
    'clast_state_write_assembly': (c_int, [POINTER(clast_assembly), c_char_p, c_char_p], 'An assembly alone.'),
    'clast_state_read_assembly': (c_int, [c_char_p, POINTER(clast_assembly)], 'The assembly of a state file; CLAST_E_FORMAT if it has none.'),
    'clast_state_write_spheres': (c_int, [POINTER(clast_spheres), c_char_p, c_char_p, c_char_p], 'One set of spheres alone.'),
    'clast_state_read_spheres': (c_int, [c_char_p, c_char_p, POINTER(clast_spheres)], 'The named spheres of a state file; `name` NULL: the only ones.'),
    'clast_state_read_table': (c_int, [c_char_p, c_char_p, POINTER(clast_table)], 'The named table of a state file.'),
    'clast_packing_read': (c_int, [c_char_p, POINTER(clast_packing_options), POINTER(clast_assembly), POINTER(clast_packing_report)], 'Reads a packing that another program made; densities are 1 where the file does not give them, and assembly->no_density is set.'),
    'clast_state_read_frame': (c_int, [c_char_p, POINTER(clast_packing_frame)], 'Step of a run of clast pack, and the box of one that is periodic; of other states none.'),
    'clast_export_format_name': (c_char_p, [c_int], 'Lower-case name of a format ("vtu").'),
    'clast_export_format_of_path': (c_int, [c_char_p], "Format by a path's extension (any case), or CLAST_EXPORT_ANY when it is none of ours."),
    'clast_assembly_write': (c_int, [POINTER(clast_assembly), c_char_p, POINTER(clast_export_options), POINTER(clast_export_report)], 'Writes an assembly.'),
    'clast_export_given_idle': (POINTER(clast_idle), [POINTER(clast_export_given), POINTER(clast_idle)], 'The options of `clast export` (level, points, colour, unit, density, columns, diameter) that such an export does not look at (clast_fields_idle).'),
    'clast_assembly_table': (c_int, [POINTER(clast_assembly), POINTER(clast_table)], 'One row a grain, in the order of placing: id, shape, position, quaternion, scale, maximum length, volume, density (if known), mass (unless in model units), n_contact (if contacts are known).'),
    'clast_pvd_write': (c_int, [c_char_p, c_int64, POINTER(c_double), POINTER(c_char_p)], 'ParaView collection: n VTU files (paths relative to the collection) and their times.'),
    'clast_shapiro_wilk': (c_int, [POINTER(c_double), c_int64, POINTER(c_double), POINTER(c_double)], "Shapiro and Wilk's W of a sample and the probability of a smaller W under a normal law."),
    'clast_bootstrap_default': (clast_bootstrap, [], '2000 resamples, 0.95, seed 1.'),
    'clast_quantile_share': (c_double, [c_int32], 'Shares of the quantiles in a summary: 0.05, 0.10, 0.25, 0.50, 0.75, 0.90, 0.95.'),
    'clast_statistics_of': (c_int, [POINTER(clast_table), POINTER(clast_bootstrap), POINTER(clast_statistics)], 'Statistics of every number column of a table.'),
    'clast_statistics_free': (None, [POINTER(clast_statistics)], '.'),
    'clast_statistics_limit_pca': (c_int, [POINTER(clast_statistics), c_int32], 'Takes the principal components of the first n_column columns alone (form factors without sizes).'),
    'clast_statistics_summary_table': (c_int, [POINTER(clast_statistics), POINTER(clast_table)], 'One row a column: column, n, mean, mean_low, mean_high, deviation, .'),
    'clast_statistics_correlation_table': (c_int, [POINTER(clast_statistics), POINTER(clast_table)], 'One row a pair of columns: a, b, r, p.'),
    'clast_statistics_pca_table': (c_int, [POINTER(clast_statistics), POINTER(clast_table)], 'One row a component: component, variance, share, explained, then a loading per column.'),
    'clast_statistics_n_component': (c_int32, [POINTER(clast_statistics), c_double], 'Components needed to explain this share of the variance; 0 without components, or of NaN.'),
    'clast_histogram_of': (c_int, [POINTER(c_double), c_int64, POINTER(clast_histogram)], 'Bins of width 2 IQR n^(-1/3) [Freedman1981], rounded to the nearest of 1, 2 or 5 times a power of ten, with edges at its multiples; at most 200.'),
    'clast_histogram_free': (None, [POINTER(clast_histogram)], '.'),
    'clast_histogram_table': (c_int, [POINTER(clast_histogram), c_char_p, POINTER(clast_table)], 'Columns low, high, count, density, normal (mean density of the fitted normal over the bin).'),
    'clast_grain_statistics_of': (c_int, [POINTER(clast_table), c_char_p, POINTER(clast_bootstrap), POINTER(clast_grain_statistics)], 'Statistics of the grains of a table (columns as clast_form_set_of takes them).'),
    'clast_grain_statistics_free': (None, [POINTER(clast_grain_statistics)], '.'),
    'clast_grain_statistics_write': (c_int, [POINTER(clast_grain_statistics), c_char_p, c_char_p], 'Writes into an existing folder: factors.csv, statistics.csv, correlation.csv, pca.csv, left_out.csv (if any), histogram_<column>.csv, and as charts zingg, histogram_flatness, histogram_elongation, histogram_size, correlation and pca in the format of `extension` ("svg", "pdf", "png").'),
    'clast_status_text': (c_char_p, [c_int], 'Fixed text of a status ("unusable geometry").'),
    'clast_status_exit_code': (c_int, [c_int], 'Exit code of a command that ends with this status (0 to 5, 130); DESIGN section 3.'),
    'clast_error_detail': (c_char_p, [], "The calling thread's last error in one line: what, where, how many, what to do."),
    'clast_text_printable': (c_char_p, [c_char_p, c_size_t, c_char_p], 'A text as a terminal, a table or a picture may show it: control characters and bytes that are not UTF-8 become //xNN.'),
    'clast_version': (c_char_p, [], "The library's CLAST_VERSION_TEXT: MAJOR.MINOR.PATCH."),
    'clast_source': (c_char_p, [], 'The source\'s commit, "8b3581966463", with "-dirty" where files had changed since; "unknown" where there was neither a repository nor an archive\'s commit.'),
    'clast_outputs_abandon': (None, [], 'Removes the temporary files of all outputs under way, of every thread.'),
    'clast_study_plan': (c_int, [POINTER(clast_study_config), POINTER(clast_table)], 'The runs as a table: number column `run` (from 1), a text column for each varied key, number column `seed`.'),
    'clast_study_check': (c_int, [POINTER(clast_study_config), POINTER(clast_field), POINTER(c_int64)], 'Refuses before the first run what every run would refuse: keys in `vary`, `table` or `set` that the command does not have, one of a single value that `set` gives twice, and several seeds where it draws nothing at random.'),
    'clast_study_count': (c_int, [POINTER(clast_table), POINTER(clast_study_outcomes)], "Counts the runs of a study's results.csv; those without an exit code are open."),
    'clast_study_grains': (c_int, [c_char_p, POINTER(clast_table), c_char_p, POINTER(clast_table)], "The grains of a study's beds, from FOLDER/runs/NNNNNN/out/grains.csv of each run: columns `group`, the run's number, flatness and elongation, as clast_fit_data_mixture takes them."),
    'clast_study_run': (c_int, [POINTER(clast_study_config), c_char_p, POINTER(clast_study_worker), POINTER(clast_comm), POINTER(clast_monitor), POINTER(clast_study_report)], 'Does the runs of a plan that its folder does not hold yet, clast_parallel_threads() at a time.'),
    'clast_table_init': (c_int, [POINTER(clast_table), c_char_p, c_int64], 'Empty table of n_row rows with a name.'),
    'clast_table_free': (None, [POINTER(clast_table)], '.'),
    'clast_table_add_number': (c_int, [POINTER(clast_table), c_char_p, c_char_p, POINTER(POINTER(c_double))], 'Adds a column of zeros; *number points into the table until the next add.'),
    'clast_table_add_text': (c_int, [POINTER(clast_table), c_char_p], 'Adds a column of empty texts; fill it with clast_table_set_text.'),
    'clast_table_set_text': (c_int, [POINTER(clast_table), c_int32, c_int64, c_char_p], '.'),
    'clast_table_resize': (c_int, [POINTER(clast_table), c_int64], 'Makes the table n_row long: new rows are zeros and empty texts.'),
    'clast_table_find': (c_int32, [POINTER(clast_table), c_char_p], 'Index of the named column, or -1.'),
    'clast_table_numbers': (POINTER(c_double), [POINTER(clast_table), c_char_p], 'Numbers of the named column, or NULL.'),
    'clast_table_read_csv': (c_int, [c_char_p, POINTER(clast_csv_options), POINTER(clast_table), POINTER(clast_csv_report)], 'Reads delimited text into an empty table named after the file.'),
    'clast_table_parse_csv': (c_int, [c_char_p, c_void_p, c_size_t, POINTER(clast_csv_options), POINTER(clast_table), POINTER(clast_csv_report)], 'The same from memory; `name` stands for the path in messages and names the table.'),
    'clast_table_write_csv': (c_int, [POINTER(clast_table), c_char_p], "Writes RFC 4180 text: a header of the columns' names (which end in their units), ',', lines that end in LF, numbers in the fewest digits that read back as the same double, NaN (what does not exist) as empty cells, infinities as inf."),
    'clast_table_write_csv_note': (c_int, [POINTER(clast_table), c_char_p, c_char_p], 'The same below a line "# NOTE", which clast_table_read_csv passes over; the note is one line.'),
    'clast_table_write_json': (c_int, [POINTER(clast_table), c_char_p], 'Writes {"name", "n_row", "columns": [{"name", "unit", "values": []}]}; nan and inf, which JSON does not have, become null.'),
    'clast_table_write_vti': (c_int, [POINTER(clast_table), c_char_p], 'Writes rows that are cells of a uniform grid, x fastest, as a VTK image (.vti) for ParaView: columns x, y, z (middles) and dx, dy, dz (sides), each perhaps with a unit behind it (x_m); the other columns of numbers are its cell data, by their names.'),
    'clast_table_write_vtp': (c_int, [POINTER(clast_table), c_char_p], 'Writes rows that are lines as VTK polydata (.vtp): columns x0, y0, z0, x1, y1, z1, as above.'),
    'clast_voxels_alloc': (c_int, [POINTER(c_int32), c_double, POINTER(clast_voxels)], 'Allocates n[0] n[1] n[2] cubes of one edge, zeroed; `voxels` must be empty.'),
    'clast_voxels_free': (None, [POINTER(clast_voxels)], '.'),
    'clast_voxels_labels': (c_int, [POINTER(clast_voxels), POINTER(POINTER(clast_voxel_label)), POINTER(c_int32)], 'The labels other than 0, rising.'),
    'clast_voxels_labels_free': (None, [POINTER(clast_voxel_label)], '.'),
    'clast_voxels_surface': (c_int, [POINTER(clast_voxels), POINTER(clast_voxel_label), POINTER(clast_mesh)], "Surface of one label: the level 1/2 of its occupancy, which is first smoothed over the 27 neighbours with weights 1-2-1 along each axis, so that the facets follow the grain and not the cubes' faces."),
    'clast_voxels_points': (c_int, [POINTER(clast_voxels), POINTER(clast_voxel_label), POINTER(clast_mesh)], "Centres of a label's outermost cubes, those with a face to another label: a point cloud whose convex hull is that of all its cubes' centres."),
    'clast_voxels_of_points': (c_int, [POINTER(clast_mesh), c_double, POINTER(clast_voxels), POINTER(c_double)], 'A cloud of points on a regular grid of this spacing (CT samples inside a grain) as cubes about them, all of label 1.'),
    'clast_volume_type_size': (c_int32, [c_int], 'Bytes of one value.'),
    'clast_volume_alloc': (c_int, [POINTER(c_int32), POINTER(clast_volume)], 'Allocates the values, zeroed, edges 1; `volume` must be empty.'),
    'clast_volume_free': (None, [POINTER(clast_volume)], '.'),
    'clast_volume_fill': (None, [POINTER(clast_volume), c_int64, c_int64, c_int, c_bool, c_void_p], 'Values of `type` in bytes of either order into value[first .'),
    'clast_volume_labels': (c_int, [POINTER(clast_volume), POINTER(clast_voxels)], "The volume's values as labels: whole numbers from 0, 0 is outside."),
    'clast_volume_parts': (c_int, [POINTER(clast_volume), c_double, POINTER(clast_voxels)], 'Parts whose values are all above a threshold, joined across brick faces, as labels 1, 2, .'),
    'clast_volume_is_known': (c_bool, [c_void_p, c_size_t], 'True for the first bytes of a NRRD or TIFF file.'),
    'clast_volume_parse': (c_int, [c_void_p, c_size_t, POINTER(clast_volume_options), POINTER(clast_volume)], 'Reads a volume from memory: NRRD (attached data, raw or gzip), TIFF (a page a slice, by libtiff, where clast was built with it: CLAST_E_USAGE if not), or bare values whose sizes the options give.'),
    'clast_volume_read_h5': (c_int, [c_char_p, c_char_p, POINTER(clast_volume_options), POINTER(clast_volume)], 'Reads an array [z][y][x] of an HDF5 file; of the options only the edges count.'),
    'clast_voxels_read': (c_int, [c_char_p, POINTER(clast_voxels)], 'Reads a voxel text file: `Xsize: n`, `Ysize: n`, `Zsize: n`, one line with the edge of a cube (`Resolution: r` or `VoxelScale: r`), then one whole number a cube, x fastest, blanks or lines between them.'),
    'clast_voxels_parse': (c_int, [c_void_p, c_size_t, POINTER(clast_voxels)], 'The same from memory: a pure function of the bytes.'),
    'clast_workspace_create': (c_int, [POINTER(c_void_p)], 'An empty workspace, which the caller destroys; CLAST_E_MEMORY.'),
    'clast_workspace_destroy': (None, [c_void_p], 'NULL is allowed.'),
    'clast_workspace_set_policy': (c_int, [c_void_p, POINTER(clast_workspace_policy)], 'Sets the policy of the calls that follow.'),
    'clast_workspace_forget': (c_int, [c_void_p], 'The next call tests and cuts: for a domain whose map or surface the caller has changed.'),
    'clast_workspace_count': (c_int, [c_void_p, POINTER(clast_workspace_calls)], '.'),
    'clast_workspace_test': (c_int, [c_void_p, POINTER(clast_points), POINTER(clast_decompose_config), POINTER(clast_uniformity)], "Step 1 alone: the uniformity tests of config on points in config's domain, whatever the policy."),
    'clast_workspace_decompose': (c_int, [c_void_p, POINTER(clast_points), POINTER(clast_decompose_config), POINTER(POINTER(clast_decomposition))], 'Steps 1 to 3.'),
    'clast_workspace_decompose_in': (c_int, [c_void_p, POINTER(clast_domain), POINTER(clast_points), POINTER(clast_decompose_config), POINTER(POINTER(clast_decomposition))], "The same in a ready domain, which config->domain then only names in messages (may be NULL): the way for a closed surface or the caller's own map, and without parsing a text at each step."),
    'clast_workspace_cells': (c_int, [c_void_p, c_int64, POINTER(c_int32)], 'Cell of each point of the last decomposition, -1 for points left out, into cell[i * stride].'),
    'clast_workspace_events': (c_int, [c_void_p, c_int64, POINTER(c_double)], 'Expected events of the cell of each point, shared equally among its points, into events[i * stride]: what a solver that keeps its own cells adds up.'),
    'clast_workspace_collide': (c_int, [c_void_p, POINTER(clast_population), POINTER(clast_collide_cells), clast_workspace_step, POINTER(clast_collide_config), POINTER(c_int64)], 'clast_collide with the memory of the workspace.'),
}

# command: key: (type, default, unit, least, greatest, choices, what it is)
KEYS: dict[str, dict[str, tuple[str, Any, str, float | None, float | None, str | None, str]]] = {
    'mesh check': {
        'weld': ('choice', 'auto', '-', None, None, 'auto|off|within', 'merge near vertices first: those of open edges, as every command does that reads a surface; not at all; or all within weld_tolerance'),
        'weld_tolerance': ('number', 1e-06, '-', 0.0, 0.1, None, 'for weld within: times the extent'),
    },
    'mesh convert': {
        'unit': ('text', '', '-', None, None, None, "length unit of the input's coordinates; that of its header when clast wrote one"),
        'out_unit': ('text', '', '-', None, None, None, "unit of the output's coordinates; that of the input when not given"),
        'scale': ('number', 1.0, '-', 1e-100, 1e+100, None, 'factor on all lengths'),
        'name': ('text', '', '-', None, None, None, 'name of the part, written in an STL, OBJ or 3MF'),
    },
    'mesh repair': {
        'weld': ('choice', 'auto', '-', None, None, 'auto|off|within', 'merge near vertices: the smallest distance that closes the surface, not at all, or within weld_tolerance'),
        'weld_tolerance': ('number', 1e-06, '-', 0.0, 0.1, None, 'for weld within: times the extent'),
        'drop': ('flag', True, '-', None, None, None, 'drop triangles without area or that repeat others'),
        'split': ('flag', True, '-', None, None, None, 'split edges at vertices that lie on them (T-junctions)'),
        'split_tolerance': ('number', 1e-06, '-', 0.0, 0.01, None, 'how far from the edge such a vertex may lie, times the extent'),
        'loose': ('flag', True, '-', None, None, None, 'drop triangles that share no edge with others'),
        'orient': ('flag', True, '-', None, None, None, 'orient neighbours consistently and closed parts outward'),
        'fill': ('flag', True, '-', None, None, None, 'fill holes with the triangles of least area'),
        'fill_size': ('number', 1.0, '-', 0.0, 1.0, None, 'largest hole to fill, times the extent'),
        'separate': ('flag', True, '-', None, None, None, 'give surfaces that touch in an edge or vertex their own vertices'),
        'unite': ('flag', True, '-', None, None, None, 'drop nested parts that bound nothing: outward ones in a solid, inward ones outside of it'),
        'keep': ('choice', 'all', '-', None, None, 'all|largest', 'parts to keep: all, or the one of the largest volume with its cavities'),
    },
    'mesh hull': {
    },
    'mesh simplify': {
        'faces': ('integer', 300.0, '-', 4.0, 2000000000.0, None, 'number of triangles wanted'),
    },
    'mesh form': {
        'flatness': ('number', 0.0, '-', 0.0, 1.0, None, "wanted S/I; 0: the grain's own"),
        'elongation': ('number', 0.0, '-', 0.0, 1.0, None, "wanted I/L; 0: the grain's own"),
        'size': ('text', '0', '-', None, None, None, "wanted sieve size D = sqrt((S^2+I^2)/2) in the unit of the file, or with its own where the file has one; 0: the grain's own"),
        'unit_form': ('flag', False, '-', None, None, None, 'take all form off: L = I = S = 1'),
        'hull': ('integer', 0.0, '-', 0.0, 1000000.0, None, 'take the convex hull first, with at most so many triangles; 0: the surface itself'),
    },
    'mesh synthesize': {
        'count': ('integer', 1.0, '-', 1.0, 1000000.0, None, 'grains; more than one go into the folder -o, with grains.csv'),
        'force': ('flag', False, '-', None, None, None, "replace an earlier run in the results' folder, once the new one has succeeded"),
        'flatness': ('number', 0.647, '-', 0.001, 1.0, None, 'S/I of the mass-equivalent ellipsoid, the mean when a deviation is given'),
        'flatness_deviation': ('number', 0.0, '-', 0.0, 10.0, None, 'of a normal law cut to form_low .. form_high'),
        'elongation': ('number', 0.682, '-', 0.001, 1.0, None, 'I/L, likewise'),
        'elongation_deviation': ('number', 0.0, '-', 0.0, 10.0, None, 'likewise'),
        'form_low': ('number', 0.1, '-', 0.001, 1.0, None, 'least flatness and elongation'),
        'form_high': ('number', 1.0, '-', 0.001, 1.0, None, 'greatest'),
        'size': ('text', '1', '-', None, None, None, 'sieve size D = sqrt((S^2+I^2)/2), in --unit, or with its own where that is given'),
        'unit': ('text', '', '-', None, None, None, 'of lengths (mm, um, ..), which PLY, OBJ and OFF hand on; none: model units'),
        'measure': ('choice', 'angularity', '-', None, None, 'amplitude|normal_roundness|angularity', "what `rough` is: the amplitude of ln r, or the finished grain's measured normal roundness or angularity"),
        'rough': ('number', 0.075, '-', 0.0, 1.0, None, 'wanted roughness'),
        'tolerance': ('number', 0.001, '-', 1e-06, 1.0, None, 'of the measured one'),
        'decay': ('number', 3.0, '-', 0.0, 10.0, None, 'coefficients of degree n fall as n^-decay: larger is smoother'),
        'degrees': ('integer', 12.0, '-', 3.0, 64.0, None, 'greatest degree of the spherical harmonics'),
        'faces': ('integer', 300.0, '-', 8.0, 100000.0, None, 'at most so many triangles'),
        'seed': ('integer', 1.0, '-', 0.0, 1.8446744073709552e+19, None, 'seed of form and roughness'),
    },
    'shape': {
        'axes': ('choice', 'ellipsoid', '-', None, None, 'ellipsoid|box|fitted|feret|principal', 'definition of L, I and S behind D and the form factors'),
        'hull': ('flag', False, '-', None, None, None, 'measure the convex hull (as packings use it), not the surface'),
        'unit': ('text', '', '-', None, None, None, 'unit of coordinates (mm, um, ...) in files that do not say theirs: results are then SI; none: model units'),
        'kind': ('choice', 'auto', '-', None, None, 'auto|surface|series|voxels|points|table|clump', 'what files hold; auto: by name and content'),
        'degree': ('integer', -1.0, '-', -1.0, 256.0, None, 'series: terms up to this degree; -1: all'),
        'level': ('integer', 5.0, '-', 0.0, 8.0, None, 'series: surface of 20 x 4^level triangles for calipers and boxes'),
        'spacing': ('number', 0.0, '-', 0.0, 1e+300, None, 'points: grid they were sampled on, in their unit, for a surface; 0: their convex hull'),
        'voxels': ('text', '', '-', None, None, None, 'volume without a header: its sizes NX,NY,NZ, x fastest'),
        'voxel_type': ('choice', 'u8', '-', None, None, 'u8|i8|u16|i16|u32|i32|f32|f64', 'type of its values'),
        'big_endian': ('flag', False, '-', None, None, None, 'its values have their high byte first'),
        'skip': ('integer', 0.0, '-', 0.0, 2147483647.0, None, 'bytes before its values'),
        'voxel_edge': ('text', '', '-', None, None, None, "volume: edges of a voxel, A or A,B,C along x, y, z; none: the file's, or 1"),
        'dataset': ('text', '', '-', None, None, None, 'volume in an HDF5 file: name of the array [z][y][x]'),
        'threshold': ('text', '', '-', None, None, None, 'volume: grains are the connected parts above this grey value, their surfaces its level (of a mask of two values: smoothed, as of labels); none: values are labels, 0 outside'),
        'least_voxels': ('integer', 1.0, '-', 1.0, 2147483647.0, None, 'volume: grains of fewer voxels are left out'),
        'columns': ('text', '', '-', None, None, None, 'table: columns of flatness,elongation or of L,I,S; none: by their names'),
        'surfaces': ('text', '', 'output', None, None, None, "write each grain's surface (or hull) as PLY into this folder"),
        'statistics': ('text', '', 'output', None, None, None, 'write statistics of the set into this folder: tables, Zingg diagram, histograms, correlation, principal components'),
        'resamples': ('integer', 2000.0, '-', 0.0, 1000000.0, None, 'statistics: bootstrap resamples for the intervals'),
        'seed': ('integer', 1.0, '-', 0.0, 1.8446744073709552e+19, None, 'statistics: random numbers of the resamples'),
        'force': ('flag', False, '-', None, None, None, "replace an earlier run in the results' folder, once the new one has succeeded"),
    },
    'grading': {
        'spread': ('choice', 'step', '-', None, None, 'step|linear|means', 'sizes within a class: density constant over log size, linear between class means, or class means only'),
        'count': ('choice', 'mean', '-', None, None, 'mean|exact', 'grains per mass: each as large as its class mean (eq. 9), or so that masses come out exactly'),
        'sample': ('integer', 0.0, '-', 0.0, 100000000.0, None, 'sizes to draw; -o FILE.csv or .json keeps them'),
        'chart': ('text', '', 'output', None, None, None, 'draw mass and number passing, wanted and achieved, into this .svg, .pdf or .png'),
        'compare': ('text', '', '-', None, None, None, 'file of grain sizes to set beside the curve instead (column with its unit, diameter_m)'),
        'seed': ('integer', 1.0, '-', 0.0, 1.8446744073709552e+19, None, 'seed of the draws'),
        'mass': ('number', 0.0, 'kg', 0.0, 1000000000000.0, None, 'mass to count grains for; 0: shares only'),
        'density': ('number', 2650.0, 'kg/m^3', 0.001, 1000000.0, None, 'of the grains'),
        'grain_volume': ('number', 0.5235987755982988, '-', 1e-06, 100.0, None, "volume of a grain by the cube of its sieve size: pi/6 as the paper, or the shapes' mean"),
    },
    'fill': {
        'spheres': ('integer', 0.0, '-', 0.0, 10000000.0, None, 'most spheres; 0: 300, or 100000 when a bound is asked for'),
        'strategy': ('choice', 'largest', '-', None, None, 'largest|random|published', 'how the next sphere is found'),
        'filled': ('number', 0.0, '-', 0.0, 0.999999, None, 'stop at this share of the volume; 0: not asked'),
        'volume_error': ('number', 0.0, '-', 0.0, 1000000.0, None, 'stop at this error of the volume; 0: not asked'),
        'centroid_error': ('number', 0.0, '-', 0.0, 1000000.0, None, 'stop at this error of the centroid; 0: not asked'),
        'inertia_error': ('number', 0.0, '-', 0.0, 1000000.0, None, 'stop at this error of the inertia; 0: not asked'),
        'min_radius': ('number', 0.0, '-', 0.0, 1.7976931348623157e+308, None, 'no smaller spheres, model units; 0: any'),
        'min_share': ('number', 0.01, '-', 0.0001, 1.0, None, "largest, overlap: no sphere below this share of the first one's radius"),
        'tolerance': ('number', 0.03, '-', 1e-09, 1.0, None, 'largest: radius may be this share below the largest'),
        'candidates': ('integer', 10.0, '-', 1.0, 1000000000.0, None, 'random, published: candidates for each sphere (N_iter)'),
        'first_at_centre': ('flag', True, '-', None, None, None, 'random, published: first sphere at the mean of the corners'),
        'vertex_subset': ('flag', False, '-', None, None, None, "published: the released code's random third of the corners"),
        'max_tries': ('integer', 1000000.0, '-', 1.0, 1000000000000000.0, None, 'random, published: points tried in vain before giving up'),
        'outer': ('flag', False, '-', None, None, None, 'keep the outer spheres only (O_ext)'),
        'shrink': ('number', 0.5, '-', 0.0, 1.0, None, 'outer: 0 convex hull of the centres .. 1 tightest boundary'),
        'overlap': ('flag', False, '-', None, None, None, 'spheres may overlap: a clump'),
        'protrusion': ('number', 0.0, '-', 0.0, 0.9, None, 'overlap: share of its radius by which a sphere may poke out'),
        'allow_open': ('flag', False, '-', None, None, None, 'accept a surface with large holes; they are capped'),
        'seed': ('integer', 1.0, '-', 0.0, 1.8446744073709552e+19, None, 'seed of the random draws'),
        'name': ('text', '', '-', None, None, None, "name of the sphere set; none: the input file's"),
        'history': ('text', '', 'output', None, None, None, 'write the errors after each sphere to this CSV'),
    },
    'aggregate': {
        'mode': ('choice', 'core', '-', None, None, 'core|cluster', 'grow on a core, or merge a population of grains cluster by cluster'),
        'core': ('text', '', '-', None, None, None, 'core: surface file, state.h5, sphere, or ellipsoid:a,b,c'),
        'core_size': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'size of the core; 0: as its file says'),
        'core_meaning': ('choice', 'length', '-', None, None, 'length|volume|mean_diameter', 'what core_size measures, as size_meaning'),
        'core_density': ('number', 2500.0, 'kg/m^3', 1e-06, 1000000.0, None, 'density of the core'),
        'coat': ('texts', '', '-', None, None, None, 'coating shape: as core'),
        'coat_weight': ('numbers', '', '-', 0.0, 1.7976931348623157e+308, None, 'probability of each coating shape; none: all equal'),
        'class_limit': ('numbers', '', 'm', 0.0, 1000000.0, None, 'sizes up to the k-th limit take the k-th coating shape, larger ones the last'),
        'coat_density': ('numbers', '2500', 'kg/m^3', 1e-06, 1000000.0, None, 'density: one for all shapes, or one each'),
        'core_spheres': ('text', '', '-', None, None, None, 'sphere composite of the core (CSV x,y,z,r); none: filled'),
        'coat_spheres': ('texts', '', '-', None, None, None, 'sphere composite of each coating shape'),
        'fill_spheres': ('integer', 100.0, '-', 1.0, 1000000.0, None, 'spheres of each composite that is filled here'),
        'fill': ('choice', 'largest', '-', None, None, 'largest|random|published', 'how it is filled (see clast fill)'),
        'unit': ('text', '', '-', None, None, None, 'length unit of surface files that do not say theirs'),
        'accept_faults': ('flag', False, '-', None, None, None, 'use surfaces that are open, cross themselves or lie apart as they are'),
        'sizes': ('text', '', '-', None, None, None, 'CSV of sizes, of sizes with counts, or of bins low,high with counts'),
        'size_column': ('text', '', '-', None, None, None, 'its column; none: the one that is named a size, else the first that counts nothing'),
        'size_unit': ('text', '', '-', None, None, None, "its unit, um, mm, m or phi; none: from the column's name"),
        'size': ('numbers', '', 'm', 1e-12, 1000000.0, None, 'a size, instead of a file'),
        'size_law': ('choice', 'list', '-', None, None, 'list|uniform|loguniform|normal|lognormal|weibull', 'sizes from the list, or drawn from a law'),
        'size_mean': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'mean (normal), median (lognormal), scale (weibull)'),
        'size_deviation': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'standard deviation (normal); for lognormal and weibull see size_shape'),
        'size_shape': ('number', 0.0, '-', 0.0, 100.0, None, 'lognormal: standard deviation of ln size; weibull: exponent'),
        'size_low': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'smallest size of a law'),
        'size_high': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'greatest size of a law; 0: none'),
        'n_particle': ('integer', 0.0, '-', 0.0, 100000000.0, None, 'particles to place, 0: the whole list; from a law or with size_draw: how many are drawn, replicate times'),
        'size_draw': ('flag', False, '-', None, None, None, 'draw n_particle sizes from the histogram at random'),
        'size_by_mass': ('flag', False, '-', None, None, None, 'rows of the histogram hold masses (a column mass, mass_g, weight ..), not numbers'),
        'replicate': ('integer', 1.0, '-', 1.0, 1000000.0, None, 'how often the list is used, or n_particle sizes are drawn (N_A of the paper)'),
        'size_meaning': ('choice', 'length', '-', None, None, 'length|volume|mean_diameter', 'sizes are maximum lengths, volume-equivalent or (L I S)^(1/3) diameters, by the L, I, S that clast shape --axes fitted prints'),
        'order': ('choice', 'given', '-', None, None, 'given|shuffled|descending', 'order of placement'),
        'cone': ('number', 0.017453292519943295, 'rad', 0.0, 3.141592653589793, None, 'half-angle of the cone of rays'),
        'rays': ('integer', 1.0, '-', 1.0, 1000000.0, None, 'rays tried for each particle (N_r)'),
        'orientations': ('integer', 1.0, '-', 1.0, 1000000.0, None, 'orientations tried on each ray (N_o)'),
        'axis': ('text', 'random', '-', None, None, None, 'axis of the cone: random, or a fixed x,y,z'),
        'origin': ('choice', 'auto', '-', None, None, 'auto|core|mass|grain|sphere', "where rays start: core's centre, centre of mass, a random placed grain or sphere"),
        'target': ('choice', 'core', '-', None, None, 'core|mass', "the kept trial ends nearest to the core's centre, or to the centre of mass"),
        'start': ('number', 0.0, '-', 0.0, 1000000.0, None, "start, in particle sizes beyond the ray's last hit; 0: from outside of everything"),
        'max_tries': ('integer', 100.0, '-', 1.0, 1000000.0, None, 'new axes tried when every ray misses the aggregate (ballistic: 1000 lines for each)'),
        'approach': ('choice', 'central', '-', None, None, 'central|ballistic|diffusive', 'how particles come: along rays to the origin (published), on lines over the cross-section, by random walk'),
        'walk_step': ('number', 0.1, '-', 0.0001, 1.0, None, 'diffusive: least step of the walk, in radii of the smallest released particle'),
        'contact': ('choice', 'exact', '-', None, None, 'exact|spheres|march', 'first touch of: true surfaces, sphere composites, or the published march'),
        'flavour': ('choice', 'release', '-', None, None, 'release|figures', 'the published engine that march repeats'),
        'march_coarse': ('number', 0.0, '-', 0.0, 10.0, None, 'coarse step constant; 0: release 0.05, figures 0.01'),
        'march_fine': ('number', 0.0005, '-', 1e-09, 10.0, None, 'fine step constant'),
        'march_steps': ('integer', 1000.0, '-', 1.0, 1000000000.0, None, 'steps allowed to each move of the march'),
        'march_vertices': ('integer', 1000.0, '-', 2.0, 1000000000.0, None, 'vertices that the march measures a length from'),
        'envelope': ('texts', 'surface_hull', '-', None, None, None, 'envelopes, the first gives d_agg: surface_hull, sphere_hull, sphere_rays, wrap, alpha, enclosing_sphere, gyration_sphere'),
        'envelope_every': ('integer', 1.0, '-', 1.0, 1000000000.0, None, 'particles between two rows of porosity; alpha, wrap: seconds each'),
        'solid_union': ('flag', True, '-', None, None, None, 'measure the volume of the union too, which takes sampling where grains overlap'),
        'fall_speed': ('flag', False, '-', None, None, None, 'settling velocity in each row of porosity too, which takes the extent each time'),
        'envelope_rays': ('integer', 10000.0, '-', 10.0, 100000000.0, None, 'rays of the published envelope'),
        'envelope_length': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'radius of the ball of the wrap and alpha envelopes, which need it'),
        'permeability': ('choice', 'happel', '-', None, None, 'happel|kozeny_carman', 'permeability by porosity and grain size, for the settling velocity that it allows'),
        'stop_mass': ('number', 0.0, 'kg', 0.0, 1000000000000.0, None, 'stop when the aggregate weighs this; 0: never'),
        'stop_size': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'stop when d_agg reaches this; 0: never'),
        'stop_porosity': ('number', 0.0, '-', 0.0, 1.0, None, 'stop when the porosity reaches this; 0: never'),
        'fit': ('flag', False, '-', None, None, None, 'find packing and replicate that explain the observed size, density or velocity'),
        'observed_size': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'fit: observed D_agg; 0: not observed'),
        'observed_size_error': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'fit: its standard error'),
        'observed_density': ('number', 0.0, 'kg/m^3', 0.0, 1000000.0, None, 'fit: observed density; 0: not observed'),
        'observed_density_error': ('number', 0.0, 'kg/m^3', 0.0, 1000000.0, None, 'fit: its standard error'),
        'observed_velocity': ('number', 0.0, 'm/s', 0.0, 1000000.0, None, 'fit: observed settling velocity; 0: not observed'),
        'observed_velocity_error': ('number', 0.0, 'm/s', 0.0, 1000000.0, None, 'fit: its standard error'),
        'fit_packing': ('texts', '', '-', None, None, None, 'fit: a packing cone:rays:orientations to try; none: 1 to 64 trials'),
        'fit_repeats': ('integer', 3.0, '-', 2.0, 1000.0, None, 'fit: aggregates grown at each packing and replicate'),
        'fit_replicate_max': ('integer', 32.0, '-', 1.0, 1000000.0, None, 'fit: greatest replicate tried'),
        'pick': ('choice', 'random', '-', None, None, 'random|mass|brownian', 'cluster mode: how two clusters are chosen'),
        'n_final': ('integer', 1.0, '-', 1.0, 100000000.0, None, 'cluster mode: clusters left at the end'),
        'repeats': ('integer', 1.0, '-', 1.0, 1000000.0, None, 'independent aggregates'),
        'confidence': ('number', 0.95, '-', 0.5, 0.9999, None, 'level of the intervals over repeats'),
        'seed': ('integer', 1.0, '-', 0.0, 1.8446744073709552e+19, None, 'seed of every random number'),
        'checkpoint_every': ('integer', 200.0, '-', 1.0, 1000000000.0, None, 'particles between two checkpoints'),
        'picture': ('flag', True, '-', None, None, None, 'picture.png in the run folder'),
        'printable': ('flag', False, '-', None, None, None, 'printable.3mf, printable.stl (mm): one closed surface around all grains and their necks'),
        'neck': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'printable: thickness of the necks; 0: half the thinnest grain, 3 spacings at least'),
        'spacing': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'printable: spacing of the sampling grid; 0: a quarter neck, coarser where the file would pass 50 MB'),
        'force': ('flag', False, '-', None, None, None, 'replace an earlier run in the output folder, once the new one has succeeded'),
        'resume': ('text', '', '-', None, None, None, 'run folder to go on with; all other options come from it'),
    },
    'pack': {
        'curve': ('text', 'U1', '-', None, None, None, "sizes: a published case (U1 U3 U5 U7 B30 B50 B70), a sieve curve's file, list:FILE (sizes, counts), masses:FILE (sizes, masses), uniform:LOW,HIGH, lognormal:MEAN,DEVIATION[,LOW,HIGH], or one size"),
        'spread': ('choice', 'step', '-', None, None, 'step|linear|means', 'how sizes lie within a sieve class'),
        'count': ('choice', 'mean', '-', None, None, 'mean|exact', 'grains of a class by its mean size (eq. 9), or by its mass'),
        'size_meaning': ('choice', 'sieve', '-', None, None, 'sieve|volume', 'sizes are sieve sizes (eq. 1), or volume-equivalent'),
        'shapes': ('texts', 'sphere', '-', None, None, None, "shapes, drawn by weight: sphere, ellipsoid:a,b,c, a surface (its convex hull), spheres of a clump (CSV x,y,z,radius or state.h5), or an aggregate (state.h5); only their form counts, and with density 0 an aggregate's own density"),
        'shape_weight': ('numbers', '', '-', 0.0, 1.7976931348623157e+308, None, 'probability of each shape; none: all equal'),
        'unit': ('text', '', '-', None, None, None, 'length unit of surface files; may be left out, since sizes come from the curve'),
        'hull': ('flag', True, '-', None, None, None, 'take the convex hull of every surface and report the volume it adds; no: refuse surfaces that are not convex'),
        'faces': ('integer', 0.0, '-', 0.0, 1000000.0, None, 'take hulls of at most so many triangles; 0: as many as they have'),
        'ellipsoids': ('flag', False, '-', None, None, None, 'take the mass-equivalent ellipsoid of every surface and clump'),
        'form_law': ('flag', False, '-', None, None, None, 'stretch every grain to a form drawn from normal laws of S/I and I/L'),
        'flatness_mean': ('number', 0.647, '-', 0.001, 1.0, None, 'mean flatness S/I of form_law'),
        'flatness_deviation': ('number', 0.175, '-', 0.0, 10.0, None, 'its standard deviation'),
        'elongation_mean': ('number', 0.682, '-', 0.001, 1.0, None, 'mean elongation I/L of form_law'),
        'elongation_deviation': ('number', 0.139, '-', 0.0, 10.0, None, 'its standard deviation'),
        'density': ('numbers', '', 'kg/m^3', 0.0, 1000000.0, None, "density of the grains (rho_p), else 2650: one for all, or one for each shape (or as density_of says); 0: those of the aggregate's own parts, as its state.h5 has them; none beside a start, which has its own"),
        'density_of': ('choice', 'shape', '-', None, None, 'shape|chance|class|list', "density lists one for each shape, or several to draw from whatever a grain's shape, or one for each class of the sieve curve; list: column density of list:FILE or masses:FILE, in place of density"),
        'density_weight': ('numbers', '', '-', 0.0, 1.7976931348623157e+308, None, 'probability of each density (by number of grains) with density_of: chance; none: all equal'),
        'mass': ('number', 1.0, 'kg', 1e-15, 1000000000000000.0, None, 'mass of the packing (m_tot)'),
        'seed': ('integer', 1.0, '-', 0.0, 1.8446744073709552e+19, None, 'seed of sizes, forms, orientations, velocities'),
        'material': ('texts', '', '-', None, None, None, "name of the grains' material, one for all shapes or one for each, for contacts"),
        'contacts': ('texts', '', '-', None, None, None, "what differs where two sides touch, later ones over earlier: two of grains, walls, materials, walls' names (floor, lid, sides, ..., of wall); then friction 0.2, rolling_friction, restitution 0.5, poisson, collision_time 100us (law linear), young 5MPa,200GPa (law hertz; one number, or one of either side)"),
        'start': ('text', '', '-', None, None, None, "packing to begin with, in place of grains that are made: a run of clast (state.h5, or its export as CSV beside shapes), or spheres of another program (CSV, LAMMPS dump, YADE's x y z r, voro++, .xyz, .xyzd)"),
        'start_unit': ('text', '', '-', None, None, None, "length unit of the start, where it does not say (a dump's ITEM: UNITS)"),
        'start_columns': ('text', '', '-', None, None, None, 'columns of its spheres in their order, all of them, - to pass one over: id,x,y,z,d'),
        'start_diameter': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'of all its spheres; 0: as the file says'),
        'start_frame': ('integer', -1.0, '-', -9000000000000000.0, 9000000000000000.0, None, 'snapshot of a LAMMPS dump or .xyz, from 0; negative: from the end'),
        'container': ('text', '', '-', None, None, None, 'surface, closed or open, that holds the grains in place of domain, width, depth and height; grains are made inside of it'),
        'container_unit': ('text', '', '-', None, None, None, "length unit of its coordinates, where its header does not say (clast's does)"),
        'domain': ('choice', 'cylinder', '-', None, None, 'cylinder|periodic|box|open|cell', 'container, its sides; cell: periodic in x, y and z (height); open: container alone'),
        'width': ('number', 0.104, 'm', 1e-09, 1000000.0, None, 'inside diameter of the cylinder, or width in x (L)'),
        'depth': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'width in y; 0: as width'),
        'height': ('number', 1.0, 'm', 1e-09, 1000000.0, None, 'height of the lid and of generation (H)'),
        'floor': ('flag', True, '-', None, None, None, 'plane at z = 0'),
        'lid': ('flag', False, '-', None, None, None, 'plane at z = height'),
        'law': ('choice', 'linear', '-', None, None, 'linear|hertz', 'contact law'),
        'contact_scheme': ('choice', 'explicit', '-', None, None, 'explicit|exact', 'steps of spring and dashpot: explicit as published, or exact, which bear a twentieth of collision_time (and make beds denser by 0.004 there)'),
        'restitution': ('number', 0.1, '-', 0.001, 1.0, None, 'coefficient of restitution (e_n)'),
        'collision_time': ('number', 0.0002, 's', 1e-12, 1000.0, None, 'duration of a collision (T_c), linear law'),
        'young': ('number', 10000000.0, 'Pa', 1.0, 10000000000000.0, None, "Young's modulus, hertz law"),
        'poisson': ('number', 0.22, '-', 0.0, 0.5, None, "Poisson's ratio (nu_p)"),
        'friction': ('number', 0.5, '-', 0.0, 100.0, None, 'coefficient of friction between grains (mu_p)'),
        'wall_friction': ('number', -1.0, '-', -1.0, 100.0, None, 'the same at walls; -1: as between grains'),
        'rolling_friction': ('number', 0.0, '-', 0.0, 100.0, None, 'rolling torque over R* |F_n|'),
        'rolling_model': ('choice', 'torque', '-', None, None, 'torque|spring', 'rolling friction as a constant torque, or as a spring by which a grain rests on a slope'),
        'cohesion': ('choice', 'none', '-', None, None, 'none|area|dmt|jkr', "attraction of touching grains: none, with the contact area, DMT's pull-off, or JKR's (its neck with law hertz)"),
        'cohesion_energy': ('number', 0.0, 'J/m^3', 0.0, 1000000000000.0, None, 'attraction per contact area, cohesion: area'),
        'surface_energy': ('number', 0.0, 'J/m^2', 0.0, 1000000.0, None, 'work of adhesion, cohesion: dmt or jkr'),
        'clip': ('flag', False, '-', None, None, None, 'dashpots never pull (the reference program lets them)'),
        'normal_torque': ('flag', True, '-', None, None, None, 'normal forces exert torques on grains too; off: eq. 5 as printed'),
        'gyroscopic': ('flag', True, '-', None, None, None, 'keep angular momentum (eq. 3); off: as the reference program'),
        'clump_contacts': ('choice', 'shared', '-', None, None, 'shared|each', "spheres of two clumps that touch at once: share one contact's stiffness, or each its own"),
        'time_step': ('number', 5e-06, 's', 1e-15, 1000.0, None, 'time step'),
        'gravity': ('number', 9.81, 'm/s^2', 0.0, 1000000.0, None, 'gravity along -z'),
        'fluid_density': ('number', 1000.0, 'kg/m^3', 0.0, 1000000.0, None, 'density of the fluid around, for buoyancy (eq. 10)'),
        'fluid_viscosity': ('number', 0.0, 'Pa s', 0.0, 1000000.0, None, 'viscosity for drag and torque of a fluid at rest; 0: none, as published'),
        'sphere_drag': ('choice', 'form', '-', None, None, 'form|standard', 'drag of spheres: the law of all forms, or the standard curve of spheres'),
        'hindrance': ('flag', False, '-', None, None, None, 'drag grows with the grains around, by the porosity at its height (Di Felice)'),
        'added_mass': ('number', 0.0, '-', 0.0, 10.0, None, 'fluid that a grain moves along, over its volume; 0.5 of a sphere'),
        'wet_restitution': ('flag', False, '-', None, None, None, "restitution falls with the impact's Stokes number (Gondret)"),
        'rounding': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'radius that edges of surfaces get; the surface shrinks so that its volume stays'),
        'skin': ('number', 0.1, '-', 0.001, 10.0, None, "margin of neighbour lists over a grain's radius: speed only"),
        'verify': ('integer', 0.0, '-', 0.0, 1000000000.0, None, 'every so many steps contacts are compared with a search without warm start; 0: never'),
        'generator': ('choice', 'cubic', '-', None, None, 'cubic|hcp|shelf', 'grains begin on a cubic lattice (published), a close-packed one (reference program), or in rows as dense as their spheres allow'),
        'spacing': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'of that lattice (h_g); 0: the published one of the case, or what the grains need'),
        'fill_low': ('number', 0.6, '-', 0.0, 1.0, None, 'grains begin above this share of the height'),
        'fill_high': ('number', 1.0, '-', 0.0, 1.0, None, 'and below this'),
        'first_low': ('number', -1.0, '-', -1.0, 1.0, None, 'the same of the first fill; -1: as all (reference: 0.1)'),
        'first_high': ('number', -1.0, '-', -1.0, 1.0, None, 'and below this (reference: 0.9)'),
        'initial_speed': ('number', 1.0, 'm/s', 0.0, 1000.0, None, 'downwards (u_init); a tenth of it sideways at random'),
        'random_turn': ('flag', True, '-', None, None, None, 'grains begin with random orientations; off: as stored (reference program)'),
        'shake_amplitude': ('number', 0.0003, 'm', 0.0, 1000.0, None, 'of shaking in x (A_s); 0: none'),
        'shake_period': ('number', 0.025, 's', 1e-09, 1000000.0, None, 'of shaking (T_s)'),
        'shaking_time': ('number', 1.0, 's', 0.0, 1000000.0, None, 'of shaking after the last grain was made (t_s)'),
        'shake_from_start': ('flag', True, '-', None, None, None, 'shake while grains are made, too'),
        'damping': ('number', 0.001, '-', 1e-300, 1.0, None, 'velocities keep this share a second at the end (c_d)'),
        'rule': ('choice', 'height', '-', None, None, 'height|speed|either', 'when the bed is at rest'),
        'height_change': ('number', 1e-05, 'm', 0.0, 1000000.0, None, 'of the mean height in check_time; for grains below 1 mm a hundredth of their size'),
        'check_time': ('number', 0.01, 's', 1e-12, 1000000.0, None, 'between two checks of it'),
        'still_speed': ('number', 0.001, 'm/s', 0.0, 1000000.0, None, 'of the fastest grain; for grains below 1 mm their size a second or less'),
        'max_steps': ('integer', 0.0, '-', 0.0, 9000000000000000.0, None, 'stop after so many time steps, finished or not; 0: never'),
        'max_damping_time': ('number', 20.0, 's', 0.0, 1000000000.0, None, 'give up when the bed is not at rest by then'),
        'wall': ('texts', '', '-', None, None, None, 'walls that move, are pressed or open: NAME FILE UNIT (a surface), or floor, lid, sides, left, right, front, back of the domain; then move X,Y,Zmm/s, vibrate X,Y,Zmm 20ms, axis X,Y,Z, about X,Y,Zmm, rotate 30rpm, swing 5deg 1s, table FILE, press X,Y,Z, area 1m^2'),
        'outlet': ('texts', '', '-', None, None, None, 'half-spaces whose grains leave and are counted: z<-10mm'),
        'wall_forces': ('flag', False, '-', None, None, None, 'force and torque on all walls over time, also where none moves: walls.csv'),
        'stages': ('texts', '', '-', None, None, None, 'stages that load a bed, one after the other; between walls: NAME (its motion runs), NAME=10kPa, NAME=5N, NAME=1mm/s (where it presses), open NAME, hold; then until rest, time T, stress P, way D or mass M. In domain cell: isotropic P, oedometer P, triaxial P RATE, shear RATE [P], hold, or x=, y=, z=, xz= (10kPa a pressure, 0.1/s a rate, above 0 pressing); then until rest, strain E, stress P or time T'),
        'load_rate': ('number', 1.0, '1/s', 1e-09, 1000000000.0, None, 'rate of strain at which a pressure is approached, at most'),
        'load_tolerance': ('number', 0.01, '-', 1e-09, 1.0, None, 'share of a pressure within which it is reached'),
        'load_rest': ('number', 0.001, '-', 1e-12, 1.0, None, 'a loaded bed rests when the mean force on a grain over that of a contact is below this'),
        'max_load_time': ('number', 20.0, 's', 0.0, 1000000000.0, None, 'give up when a stage has not come to its end by then'),
        'energy': ('flag', False, '-', None, None, None, 'record the work of all forces by kind: load.csv, energy_book.svg'),
        'layer': ('number', 0.001, 'm', 1e-12, 1000000.0, None, 'slices of the porosity profile (h_p); for grains below 1 mm a tenth of their size'),
        'cut': ('number', 0.5, '-', 0.0, 1.0, None, 'the bed ends where the porosity is this (n cut-off)'),
        'trim': ('number', -1.0, 'm', -1.0, 1000000.0, None, 'left out at both ends of the bed (h_pd); -1: 31.5 mm in the periodic box, else 0'),
        'series_time': ('number', 0.01, 's', 1e-12, 1000000000.0, None, 'between rows of series.csv'),
        'frame_time': ('number', 0.0, 's', 0.0, 1000000000.0, None, 'between frames for ParaView; 0: none'),
        'checkpoint_time': ('number', 120.0, 's', 0.0, 1000000000.0, None, 'between checkpoints, by the clock'),
        'force': ('flag', False, '-', None, None, None, 'replace an earlier run in the output folder, once the new one has succeeded'),
        'resume': ('text', '', '-', None, None, None, 'go on with the run in this folder'),
    },
    'porosity': {
        'bed': ('text', '', '-', None, None, None, "container: cylinder:RADIUS[,X,Y], box:X0,Y0,X1,Y1, periodic:X0,Y0,X1,Y1 (x and y), periodic:X0,Y0,Z0,X1,Y1,Z1[,SHIFT] (all directions; images above lie farther along x by SHIFT) or mesh:FILE,UNIT (m where the grains' lengths have no unit); none: the run's"),
        'floor': ('text', '0', '-', None, None, None, 'height of the bottom, with --bed (as 5mm)'),
        'method': ('choice', 'exact', '-', None, None, 'exact|spheres', 'what a grain fills: its true shape, or the sphere of its volume (published)'),
        'layer': ('text', '0', '-', None, None, None, 'height of a slice (as 1mm); 0: 1 mm as published, or a tenth of the mean diameter where that is below 1 mm, or of a run without unit, whose lengths are bare numbers here too'),
        'cut': ('number', 0.5, '-', 0.0, 1.0, None, 'the bed ends where the porosity rises through this (n_cut)'),
        'trim': ('text', '0', '-', None, None, None, 'left out at both ends (h_pd; published for periodic beds: 31.5mm)'),
        'at_slice': ('flag', False, '-', None, None, None, 'end the bed with a slice, as the reference program; else between slices'),
        'core': ('number', 0.0, '-', 0.0, 1000000.0, None, "porosity without the side walls' share too: of what is farther from them than this many grain sizes (2 to 3 where the bed is wide enough); 0: not"),
        'gap': ('text', '0', '-', None, None, None, 'grains this close touch (as 10um), where the run does not know its contacts'),
        'local': ('flag', False, '-', None, None, None, 'porosity around each grain too, by radical Voronoi cells of equal-volume spheres'),
        'rings': ('integer', 0.0, '-', 0.0, 100000.0, None, 'porosity over the radius of a cylinder too, in this many rings'),
        'pores': ('integer', 0.0, '-', 0.0, 100000000.0, None, 'sizes of pores too, from this many quasi-random points of the bed'),
        'fields': ('text', '0', '-', None, None, None, 'coarse-grained density, velocity and stress too (fields.vti, .csv), by a Gaussian this wide (its standard deviation, as 3mm), in cells as wide; 0: not'),
        'chains': ('flag', False, '-', None, None, None, 'force chains too (chains.vtp, .csv, .svg), of runs that know their forces'),
        'columns': ('text', '', '-', None, None, None, "spheres: what the file's columns are, all of them, such as id,x,y,z,d (x, y, z, r or d; others and - are passed over); none: by their names"),
        'diameter': ('text', '0', '-', None, None, None, "spheres: diameter of all, instead of the file's; 0: the file's"),
        'force': ('flag', False, '-', None, None, None, "replace an earlier run in the results' folder, once the new one has succeeded"),
    },
    'fit': {
        'target': ('text', 'porosity', '-', None, None, None, 'column with the measured porosity'),
        'columns': ('text', '', '-', None, None, None, 'columns of the form: flatness,elongation or L,I,S (else known by their names); with features columns: the candidates'),
        'group': ('text', 'bed', '-', None, None, None, 'column that names the bed, in the table of beds and in that of the grains; it is no feature'),
        'n_term': ('integer', 2.0, '-', 1.0, 20.0, None, 'features of the model'),
        'use': ('text', '', '-', None, None, None, 'take these features (a,b,...) instead of selecting'),
        'correlation_limit': ('number', 0.8, '-', 0.0, 1.0, None, 'remove features whose |r| to a chosen one is greater'),
        'n_fold': ('integer', 10.0, '-', 2.0, 1000000.0, None, 'folds of the cross-validation'),
        'n_repeat': ('integer', 1.0, '-', 1.0, 10000.0, None, 'cross-validations with other folds to average'),
        'score': ('choice', 'mean', '-', None, None, 'mean|median', 'absolute error that decides: the mean (Tables 9, 10 of the paper) or the median'),
        'validation': ('choice', 'nested', '-', None, None, 'nested|published', 'features for a held-out bed: selected anew without it (nested), or with it, as in the paper (published), which makes the errors too small'),
        'n_permutation': ('integer', 199.0, '-', 0.0, 1000000.0, None, 'permutations of the porosities among the beds for p-values (0: none)'),
        'seed': ('integer', 1.0, '-', 0.0, 1.8446744073709552e+19, None, 'random numbers of folds and permutations'),
        'features': ('choice', 'auto', '-', None, None, 'auto|form|mixture|columns', "features to choose from; form: 26 of each bed's one form; mixture: 104 of --grains; columns: the table's own; auto: mixture with --grains, else form where columns are named as a form's, else columns"),
        'grains': ('text', '', '-', None, None, None, "study folder, or table of all beds' grains, with a column that names the bed (--group)"),
        'name': ('text', 'fitted', '-', None, None, None, 'name of the model'),
        'force': ('flag', False, '-', None, None, None, "replace an earlier run in the results' folder, once the new one has succeeded"),
    },
    'predict': {
        'model': ('text', 'auto', '-', None, None, None, 'auto, single, mixture, or a model file of clast fit; auto: mixture where the forms vary, else single'),
        'grading': ('choice', 'U1', '-', None, None, 'U1|U7|B50', "published size distribution that the bed's resembles, up to scale"),
        'flatness': ('text', '', '-', None, None, None, 'mean S/I, or mean and standard deviation as in 0.65+-0.17'),
        'elongation': ('text', '', '-', None, None, None, 'mean I/L, or mean and standard deviation'),
        'grains': ('integer', 0.0, '-', 0.0, 1000000000000.0, None, 'number of grains behind the means (0: unknown, no sampling error)'),
        'columns': ('text', '', '-', None, None, None, 'columns of the table: flatness,elongation or L,I,S (else known by their names)'),
        'each': ('flag', False, '-', None, None, None, 'every row is a bed of that single form: one prediction a row'),
        'resamples': ('integer', 500.0, '-', 0.0, 1000000.0, None, 'bootstrap resamples of the grains for the sampling error'),
        'seed': ('integer', 1.0, '-', 0.0, 1.8446744073709552e+19, None, 'random numbers'),
        'force': ('flag', False, '-', None, None, None, "replace an earlier run in the results' folder, once the new one has succeeded"),
    },
    'decompose': {
        'columns': ('texts', 'x,y,z', '-', None, None, None, 'columns of the coordinates, as many as dimensions; x,y,z are found as x_m, x_mm, ... too; without a header they are column_1, column_2, ...'),
        'unit': ('text', '', '-', None, None, None, 'unit of coordinates and --domain (mm, um); none: that of columns as x_mm, else m'),
        'radius_column': ('text', '', '-', None, None, None, 'column of radii [m]'),
        'diameter_column': ('text', '', '-', None, None, None, 'column of diameters [m], instead of radii'),
        'mass_column': ('text', '', '-', None, None, None, 'column of masses [kg]'),
        'velocity_columns': ('texts', '', '-', None, None, None, 'columns of velocities [m/s], as many as dimensions'),
        'weight_column': ('text', '', '-', None, None, None, 'column of weights: real particles that a parcel stands for'),
        'variable_column': ('text', '', '-', None, None, None, 'column of a variable (temperature) in which tree cells are uniform too'),
        'dataset': ('text', '', '-', None, None, None, 'array or folder of an HDF5 file'),
        'frame': ('integer', 0.0, '-', -1000000000000.0, 1000000000000.0, None, 'snapshot of a LAMMPS dump or .xyz, from 0; -1: the last'),
        'domain_unit': ('text', '', '-', None, None, None, 'unit of bare numbers in --domain and of mesh:FILE; none: --unit, else what the file says'),
        'test_only': ('flag', False, '-', None, None, None, 'run the uniformity tests alone, exit code 1 when not uniform, 0 with fewer than 5 points (not tested)'),
        'charts': ('choice', 'svg', '-', None, None, 'svg|png|pdf', 'format of charts'),
        'sizes': ('integer', 0.0, '-', 0.0, 40.0, None, 'events of random parts of n, n/2, n/4 .. points, so many sizes, as a table and a chart; 0: none'),
        'regular': ('integer', 0.0, '-', 0.0, 200.0, None, 'with --sizes: a regular mesh of so many cells an axis beside; 0: none'),
        'force': ('flag', False, '-', None, None, None, "replace an earlier run in the results' folder, once the new one has succeeded"),
        'domain': ('text', '', '-', None, None, None, 'known domain: box:LOW..,HIGH.., cylinder:R,L or X,Y,Z,NX,NY,NZ,R,L (base, axis), half-pipe:R,L, sphere:R or X,Y,Z,R, mesh:FILE [m, or as 1mm]'),
        'outside': ('choice', 'error', '-', None, None, 'error|drop', 'points outside the domain: refuse the file, or leave them out'),
        'variant': ('choice', 'full', '-', None, None, 'full|first|fast|test', 'how far to go: tests and passes, first test and one pass, one pass, tests alone'),
        'mesh': ('choice', 'auto', '-', None, None, 'boxes|components|bins|labels|tree|auto', 'what bins are joined into; tree splits by a chi-square test; auto: tree for the full variant, else boxes'),
        'events': ('choice', 'pairs', '-', None, None, 'pairs|paper', 'n (n - 1) / 2 pairs, or n^2 as printed'),
        'level': ('number', 0.05, '-', 1e-06, 0.5, None, 'level of each uniformity test'),
        'votes': ('integer', 2.0, '-', 1.0, 5.0, None, 'tests that must reject; where a single one votes, 2 is 1'),
        'tests': ('text', 'symmetric,centred,star,henze_zirkler,pearson', '-', None, None, None, 'tests that vote'),
        'statistic': ('choice', 'A', '-', None, None, 'A|T', "of the discrepancies: A_n as published, or Liang's stronger T"),
        'paper': ('flag', False, '-', None, None, None, 'p-values, score (trapezoids) and events (n^2 / V) as printed, errors included'),
        'ghost_samples': ('integer', 0.0, '-', 0.0, 65535.0, None, 'expected scores by so many ghost samples; 0: without sampling'),
        'crossfit': ('flag', False, '-', None, None, None, 'events by cross-fitting too: cells of one half of the points, counts of the other half'),
        'lower': ('choice', 'q20', '-', None, None, 'q20|search|joint', 'lower threshold: the 20th percentile, or searched in [Q20, Q40) like the upper one, after it or jointly'),
        'strict': ('flag', False, '-', None, None, None, 'bins exactly at a threshold are ambient (the prose; the printed algorithm takes them)'),
        'max_pass': ('integer', 10.0, '-', 1.0, 64.0, None, 'passes at the most'),
        'beta_dt': ('number', 0.0, 'm^d', 0.0, 1e+300, None, 'collision kernel times time step [m^d]; 0: pair integral per beta dt [1/m^d]'),
        'tree_level': ('number', 0.01, '-', 1e-09, 0.5, None, 'level of the test in each tree cell'),
        'tree_root_level': ('number', 0.0001, '-', 1e-12, 0.5, None, 'level of the test that splits the whole cloud into a tree: uniform clouds split by chance'),
        'variable_tolerance': ('number', 0.0, '-', 0.0, 1e+300, None, "standard deviation that a tree cell may keep of the variable (its column's unit)"),
        'tree_least': ('integer', 16.0, '-', 2.0, 1000000.0, None, 'points below which a tree cell is not split'),
        'tree_refine': ('flag', True, '-', None, None, None, 'give each cell of a tree that was split as the blocks its last test looked at'),
        'extrapolate': ('flag', True, '-', None, None, None, 'add the pairs that tree cells hide by being taken as uniform, from pairs at two sizes of cells'),
        'pairs': ('flag', False, '-', None, None, None, 'count pairs by distance: g(r), and events by pairs beside those by cells'),
        'pairs_radius': ('number', 0.0, 'm', 0.0, 1e+300, None, 'greatest distance of pairs (a bare number: m); 0: some 110 neighbours a point, three mean spacings in 3-D'),
        'estimator': ('choice', 'auto', '-', None, None, 'cells|pairs|auto', 'what events are counted by; auto: tree cells, and pairs by distance where cells do not resolve the cloud'),
        'seed': ('integer', 1.0, '-', 0.0, 1.8446744073709552e+19, None, 'seed of every draw (ghost points, samples, collisions)'),
    },
    'agglomerate': {
        'columns': ('texts', 'x,y,z', '-', None, None, None, 'columns of the coordinates, as many as dimensions; x,y,z are found as x_m, x_mm, ... too; without a header they are column_1, column_2, ...'),
        'unit': ('text', '', '-', None, None, None, 'unit of coordinates and --domain (mm, um); none: that of columns as x_mm, else m'),
        'radius_column': ('text', '', '-', None, None, None, 'column of radii [m]'),
        'diameter_column': ('text', '', '-', None, None, None, 'column of diameters [m], instead of radii'),
        'mass_column': ('text', '', '-', None, None, None, 'column of masses [kg]'),
        'velocity_columns': ('texts', '', '-', None, None, None, 'columns of velocities [m/s], as many as dimensions'),
        'weight_column': ('text', '', '-', None, None, None, 'column of weights: real particles that a parcel stands for'),
        'variable_column': ('text', '', '-', None, None, None, 'column of a variable (temperature) in which tree cells are uniform too'),
        'dataset': ('text', '', '-', None, None, None, 'array or folder of an HDF5 file'),
        'frame': ('integer', 0.0, '-', -1000000000000.0, 1000000000000.0, None, 'snapshot of a LAMMPS dump or .xyz, from 0; -1: the last'),
        'domain_unit': ('text', '', '-', None, None, None, 'unit of bare numbers in --domain and of mesh:FILE; none: --unit, else what the file says'),
        'monomers_column': ('text', '', '-', None, None, None, 'column of whole numbers of monomers; none: 1 each'),
        'speed_rms_column': ('text', '', '-', None, None, None, "column of the particles' turbulent velocities [m/s]"),
        'temperature_column': ('text', '', '-', None, None, None, 'column of fluid temperatures [K], in degrees Celsius if its name says so (T_C, T_degC); cells take the mean'),
        'shear_column': ('text', '', '-', None, None, None, 'column of shear rates [1/s]; cells take the mean'),
        'dissipation_column': ('text', '', '-', None, None, None, 'column of dissipation rates [m^2/s^3]; cells take the mean'),
        'fixed_column': ('text', '', '-', None, None, None, 'column of cell numbers of a mesh of yours, evolved beside'),
        'fixed_volume_column': ('text', '', '-', None, None, None, "column of those cells' volumes [m^3]"),
        'charts': ('choice', 'svg', '-', None, None, 'svg|png|pdf', 'format of charts'),
        'force': ('flag', False, '-', None, None, None, "replace an earlier run in the results' folder, once the new one has succeeded"),
        'kernel': ('text', 'constant', '-', None, None, None, 'collision kernel, or a sum: brownian+settling; see the table above'),
        'duration': ('number', 1.0, 's', 0.0, 1e+300, None, 'time that passes; of several snapshots after each, the last too: three take three times it'),
        'n_step': ('integer', 10.0, '-', 1.0, 1000000.0, None, 'steps of that time'),
        'repeats': ('integer', 1.0, '-', 1.0, 1000000.0, None, 'independent realisations, over which results are averaged'),
        'collisions': ('choice', 'next', '-', None, None, 'next|poisson', 'event by event, or a Poisson number of events a sub-step'),
        'leap': ('number', 0.01, '-', 1e-06, 1.0, None, 'collisions of the busiest particle in a sub-step of poisson'),
        'block': ('integer', 1024.0, '-', 0.0, 1000000.0, None, 'kinds of particles above which a cell is partitioned at random into blocks; 0: never'),
        'self_collisions': ('flag', False, '-', None, None, None, 'the particles of one weighted parcel collide with each other too'),
        'out_of_range': ('choice', 'error', '-', None, None, 'error|extrapolate', 'kernels and sticking beyond where they hold (the table above)'),
        'alpha': ('number', 1.0, '-', 0.0, 1.0, None, 'share of collisions that stick; with another law of sticking a factor on it'),
        'sticking': ('choice', 'constant', '-', None, None, 'constant|viscous|liquid|contact', 'share that sticks: alpha, or by the impact: a viscous film, wet ash, elastic contacts'),
        'film_viscosity': ('number', 0.0, 'Pa s', 0.0, 1000000000000.0, None, 'viscous, liquid: of the liquid on the particles'),
        'film_thickness': ('number', 0.0, 'm', 0.0, 1.0, None, 'viscous: h of the film'),
        'asperity': ('number', 0.0, 'm', 0.0, 1.0, None, 'viscous: height h_a of the roughness'),
        'restitution': ('number', 0.0, '-', 0.0, 1.0, None, 'viscous: e of the dry solids'),
        'critical_stokes': ('number', 1.3, '-', 0.0, 1000000000000.0, None, 'liquid: St_cr, where half of the collisions stick'),
        'stokes_exponent': ('number', 0.8, '-', 0.0, 100.0, None, 'liquid: q of 1 / (1 + (St / St_cr)^q)'),
        'adhesion': ('number', 0.0, 'J/m^2', 0.0, 1000000.0, None, 'contact: work of adhesion of the surfaces'),
        'young': ('number', 0.0, 'Pa', 0.0, 1000000000000000.0, None, "contact: Young's modulus of the particles"),
        'poisson': ('number', 0.25, '-', -0.999, 0.5, None, "contact: Poisson's ratio of the particles"),
        'radius_law': ('choice', 'volume', '-', None, None, 'volume|fractal-collision|fractal-gyration', 'collision radius of an aggregate: of the summed volume, a0 (i / k_f)^(1 / D_f), or from that law of the radius of gyration'),
        'monomer_radius': ('number', 0.0, 'm', 0.0, 1e+300, None, 'radius a0 of a monomer where no column gives radii'),
        'fractal_dimension': ('number', 1.8, '-', 1.0, 3.0, None, 'D_f'),
        'fractal_prefactor': ('number', 1.0, '-', 0.001, 1000.0, None, 'k_f'),
        'constant': ('number', 1e-06, 'm^d/s', 0.0, 1e+300, None, 'K of kernel constant [m^d/s]'),
        'additive': ('number', 1e-06, 'm^d/s', 0.0, 1e+300, None, 'b of kernel additive [m^d/s]'),
        'product': ('number', 1e-06, 'm^d/s', 0.0, 1e+300, None, 'c of kernel product [m^d/s]'),
        'temperature': ('number', 293.15, 'K', 0.0, 100000.0, None, 'of the fluid'),
        'viscosity': ('number', 0.001002, 'Pa s', 0.0, 1000000.0, None, 'dynamic viscosity of the fluid'),
        'density': ('number', 998.2, 'kg/m^3', 0.0, 100000.0, None, 'of the fluid'),
        'particle_density': ('number', 0.0, 'kg/m^3', 0.0, 100000.0, None, "of the particles' solid"),
        'mean_free_path': ('number', 0.0, 'm', 0.0, 1.0, None, 'of a gas, for the slip correction; 0: none'),
        'shear': ('number', 0.0, '1/s', 0.0, 1000000000000.0, None, 'shear rate G'),
        'shear_constant': ('number', 0.0, '-', 0.0, 100.0, None, 'constant of shear_turbulent, 1.3 as often printed; 0: sqrt(8 pi/15) = 1.2944'),
        'dissipation': ('number', 0.0, 'm^2/s^3', 0.0, 1000000000000.0, None, 'turbulent dissipation eps'),
        'speed_rms': ('number', 0.0, 'm/s', 0.0, 1000000.0, None, 'turbulent velocity of the fluid, one component'),
        'gravity': ('number', 9.80665, 'm/s^2', 0.0, 1000000.0, None, 'gravity g'),
        'efficiency': ('number', 0.0, '-', 0.0, 1.0, None, 'collision efficiency E of settling; 0: by Stokes number and ratio of radii'),
        'settling_law': ('choice', 'standard', '-', None, None, 'standard|stokes', "drag of settling spheres: the standard curve, or Stokes'"),
        'rebuild': ('choice', 'changed', '-', None, None, 'changed|always|never', 'when cells are made anew: at snapshots of a changed cloud, at all of them, never; but for never also when 3/4 of the particles are left'),
        'change_level': ('number', 0.01, '-', 1e-12, 0.5, None, 'false alarms of the test that finds the cloud changed'),
        'fixed': ('integer', 0.0, '-', 0.0, 1000.0, None, 'a regular mesh of this many cells an axis is evolved beside; 0: none'),
        'depth': ('number', 0.0, 'm', 0.0, 1e+300, None, 'extent of the missing dimensions: a length in 2-D (a bare number: m), m^2 in 1-D (bare)'),
        'box_model': ('flag', False, '-', None, None, None, 'a well-mixed box without POINTS: --concentration and a law of sizes'),
        'solver': ('choice', 'monte-carlo', '-', None, None, 'monte-carlo|sectional', 'of a box: draws, or a sectional population balance (needs SUNDIALS)'),
        'initial': ('choice', 'mono', '-', None, None, 'mono|exponential|lognormal|table', 'sizes at the start of a box'),
        'concentration': ('number', 0.0, '1/m^3', 0.0, 1e+300, None, 'particles a volume at the start of a box; of a table, whose numbers are then shares, or 0: their sum'),
        'initial_mean': ('number', 1.0, '-', 1e-100, 1e+100, None, 'mean size at the start [monomers]'),
        'initial_sd': ('number', 1.5, '-', 1.001, 100.0, None, 'geometric standard deviation of a lognormal start'),
        'particles': ('integer', 10000.0, '-', 2.0, 10000000.0, None, 'particles of a Monte Carlo box'),
        'size_min': ('number', 0.0, '-', 0.0, 1e+100, None, 'smallest size, which does not break [monomers]; 0: that of the start (which must then have others, or be single monomers, where particles break)'),
        'size_max': ('number', 0.0, '-', 0.0, 1e+100, None, 'largest size of the grid [monomers]; 0: 1e5 mean sizes of the start'),
        'per_octave': ('integer', 16.0, '-', 1.0, 1000.0, None, 'sections of the grid that double the size'),
        'breakage_rate': ('number', 0.0, '1/s', 0.0, 1e+300, None, 'S1: a particle of x monomers breaks at S1 x^p'),
        'breakage_exponent': ('number', 1.0, '-', -10.0, 10.0, None, 'p'),
        'fragments': ('choice', 'power', '-', None, None, 'power|halves', 'sizes v of the fragments of x: (c + 2)/x (v/x)^c, or two halves'),
        'fragment_exponent': ('number', 0.0, '-', -0.99, 100.0, None, 'c; 0: two fragments, uniform; monte-carlo: m fragments, 1/(m-1) - 1'),
        'source': ('number', 0.0, '1/(m^3 s)', 0.0, 1e+300, None, 'particles that come in, a volume and time'),
        'source_size': ('number', 1.0, '-', 1e-100, 1e+100, None, 'their size [monomers]'),
        'settling_depth': ('number', 0.0, 'm', 0.0, 1e+300, None, 'particles leave at settling speed / this depth; 0: they stay'),
        'tolerance': ('number', 1e-07, '-', 1e-12, 0.01, None, 'relative error of a step of the sectional solver'),
        'initial_file': ('text', '', '-', None, None, None, "table of --initial table: columns size (monomers) and number (1/m^3; shares, where --concentration is given), or a box's spectrum.csv, whose last time is taken"),
        'domain': ('text', '', '-', None, None, None, 'known domain: box:LOW..,HIGH.., cylinder:R,L or X,Y,Z,NX,NY,NZ,R,L (base, axis), half-pipe:R,L, sphere:R or X,Y,Z,R, mesh:FILE [m, or as 1mm]'),
        'outside': ('choice', 'error', '-', None, None, 'error|drop', 'points outside the domain: refuse the file, or leave them out'),
        'variant': ('choice', 'full', '-', None, None, 'full|first|fast|test', 'how far to go: tests and passes, first test and one pass, one pass, tests alone'),
        'mesh': ('choice', 'auto', '-', None, None, 'boxes|components|bins|labels|tree|auto', 'what bins are joined into; tree splits by a chi-square test; auto: tree for the full variant, else boxes'),
        'level': ('number', 0.05, '-', 1e-06, 0.5, None, 'level of each uniformity test'),
        'votes': ('integer', 2.0, '-', 1.0, 5.0, None, 'tests that must reject; where a single one votes, 2 is 1'),
        'tests': ('text', 'symmetric,centred,star,henze_zirkler,pearson', '-', None, None, None, 'tests that vote'),
        'statistic': ('choice', 'A', '-', None, None, 'A|T', "of the discrepancies: A_n as published, or Liang's stronger T"),
        'paper': ('flag', False, '-', None, None, None, 'p-values, score (trapezoids) and events (n^2 / V) as printed, errors included'),
        'ghost_samples': ('integer', 0.0, '-', 0.0, 65535.0, None, 'expected scores by so many ghost samples; 0: without sampling'),
        'lower': ('choice', 'q20', '-', None, None, 'q20|search|joint', 'lower threshold: the 20th percentile, or searched in [Q20, Q40) like the upper one, after it or jointly'),
        'strict': ('flag', False, '-', None, None, None, 'bins exactly at a threshold are ambient (the prose; the printed algorithm takes them)'),
        'max_pass': ('integer', 10.0, '-', 1.0, 64.0, None, 'passes at the most'),
        'tree_level': ('number', 0.01, '-', 1e-09, 0.5, None, 'level of the test in each tree cell'),
        'tree_root_level': ('number', 0.0001, '-', 1e-12, 0.5, None, 'level of the test that splits the whole cloud into a tree: uniform clouds split by chance'),
        'variable_tolerance': ('number', 0.0, '-', 0.0, 1e+300, None, "standard deviation that a tree cell may keep of the variable (its column's unit)"),
        'tree_least': ('integer', 16.0, '-', 2.0, 1000000.0, None, 'points below which a tree cell is not split'),
        'tree_refine': ('flag', True, '-', None, None, None, 'give each cell of a tree that was split as the blocks its last test looked at'),
        'extrapolate': ('flag', True, '-', None, None, None, 'add the pairs that tree cells hide by being taken as uniform, from pairs at two sizes of cells'),
        'estimator': ('choice', 'auto', '-', None, None, 'cells|pairs|auto', 'what events are counted by; auto: tree cells, and pairs by distance where cells do not resolve the cloud'),
        'seed': ('integer', 1.0, '-', 0.0, 1.8446744073709552e+19, None, 'seed of every draw (ghost points, samples, collisions)'),
    },
    'evolve': {
        'shapes': ('texts', 'sphere', '-', None, None, None, 'shapes, drawn by weight: sphere, ellipsoid:a,b,c, a closed surface, or an aggregate (state.h5)'),
        'shape_weight': ('numbers', '', '-', 0.0, 1.7976931348623157e+308, None, 'probability of each shape; none: all equal'),
        'density': ('numbers', '2500', 'kg/m^3', 1e-06, 1000000.0, None, 'of the solid: one for all shapes, or one each'),
        'unit': ('text', '', '-', None, None, None, 'length unit of surface files; may be left out: sizes come from the curve'),
        'accept_faults': ('flag', False, '-', None, None, None, 'use surfaces that are open, cross themselves or lie apart as they are'),
        'curve': ('text', '10um', '-', None, None, None, "diameters of equal volume: one size, uniform:LOW,HIGH, lognormal:MEAN,DEVIATION[,LOW,HIGH], list:FILE, masses:FILE, a sieve curve's file, or a published case"),
        'particles': ('integer', 0.0, '-', 0.0, 10000000.0, None, 'particles at the start; 0: the rows of points'),
        'weight': ('number', 1.0, '-', 1.0, 1000000000000000.0, None, 'real particles W that each stands for, a whole number: the number density is particles x W / volume; rows in time and the summary have masses of all of them, tables of bodies and events the mass of one'),
        'release': ('text', '', '-', None, None, None, 'domain in which they start uniformly distributed (as domain), as far as it lies in that; a box in a box lies in it all; none: all of the domain'),
        'points': ('text', '', '-', None, None, None, 'file of positions x, y, z to start from instead (CSV, VTK, PLY, dump, HDF5)'),
        'columns': ('texts', 'x,y,z', '-', None, None, None, 'its columns of coordinates, three; units in their names count (x_mm), else they are in m; x,y,z are found as x_m, y_m, z_m too'),
        'diameter_column': ('text', '', '-', None, None, None, 'its column of volume-equivalent diameters; none: the curve'),
        'frame': ('integer', 0.0, '-', -1000000000000.0, 1000000000000.0, None, 'its snapshot, of a LAMMPS dump or .xyz, from 0; -1: the last'),
        'dataset': ('text', '', '-', None, None, None, 'its array or folder, of an HDF5 file'),
        'domain': ('text', '', '-', None, None, None, 'box:LOW..,HIGH.., cylinder:X,Y,Z,NX,NY,NZ,R,L (base, axis), sphere:R, mesh:FILE; z is up'),
        'floor': ('choice', 'deposit', '-', None, None, 'deposit|reflect|periodic', 'what is below: it stays there, comes back, or enters at the top'),
        'sides': ('choice', 'periodic', '-', None, None, 'deposit|reflect|periodic', 'the same of the sides; periodic: a box alone'),
        'open_top': ('flag', False, '-', None, None, None, 'what passes the top of a box is gone; else it comes back'),
        'wind': ('text', '0,0,0', '-', None, None, None, 'velocity x,y,z of the fluid at z = 0 [m/s]'),
        'field': ('text', '', '-', None, None, None, 'file of velocities on a regular grid (CSV x,y,z,u,v,w in m and m/s, VTK, HDF5, ...), added to the wind; beyond the grid those at its edge'),
        'field_columns': ('text', 'u,v,w', '-', None, None, None, 'its columns of velocities'),
        'wind_shear': ('number', 0.0, '1/s', -1000000000.0, 1000000000.0, None, 'change of velocity x with z'),
        'eddy_diffusivity': ('number', 0.0, 'm^2/s', 0.0, 1000000.0, None, 'turbulent diffusivity, the same everywhere'),
        'brownian': ('flag', True, '-', None, None, None, "particles diffuse by Brownian motion, as their envelopes' drag says"),
        'fall': ('choice', 'form', '-', None, None, 'form|sphere|stokes', "drag: of each body's own form, of the sphere of its envelope, or of that in creeping flow"),
        'temperature': ('number', 288.15, 'K', 0.0, 100000.0, None, 'of the fluid'),
        'viscosity': ('number', 1.7894e-05, 'Pa s', 0.0, 1000000.0, None, 'of the fluid (default: air)'),
        'fluid_density': ('number', 1.225, 'kg/m^3', 0.0, 100000.0, None, 'of the fluid (default: air)'),
        'mean_free_path': ('number', 0.0, 'm', 0.0, 1.0, None, 'of a gas, for the slip correction; 0: none'),
        'gravity': ('number', 9.80665, 'm/s^2', 0.0, 1000000.0, None, '0: nothing falls'),
        'kernel': ('text', 'brownian+settling', '-', None, None, None, 'collision kernel, or a sum, as in clast agglomerate --help-all: constant, additive, product, brownian, shear_laminar, shear_turbulent, settling, inertial, ...'),
        'shear': ('number', 0.0, '1/s', 0.0, 1000000000000.0, None, 'shear rate that kernels use; 0: that of wind_shear'),
        'dissipation': ('number', 0.0, 'm^2/s^3', 0.0, 1000000000000.0, None, 'turbulent dissipation'),
        'speed_rms': ('number', 0.0, 'm/s', 0.0, 1000000.0, None, 'turbulent velocity, one component'),
        'efficiency': ('number', 0.0, '-', 0.0, 1.0, None, 'collision efficiency of settling; 0: by Stokes number and ratio of radii'),
        'constant': ('number', 1e-06, 'm^3/s', 0.0, 1e+300, None, 'K of kernel constant'),
        'additive': ('number', 1e-06, 'm^3/s', 0.0, 1e+300, None, 'b of kernel additive'),
        'product': ('number', 1e-06, 'm^3/s', 0.0, 1e+300, None, 'c of kernel product'),
        'out_of_range': ('choice', 'error', '-', None, None, 'error|extrapolate', 'kernels and sticking beyond where they hold'),
        'collision_radius': ('choice', 'gyration', '-', None, None, 'gyration|enclosing|volume', "radius that kernels use: sqrt(5/3) R_g, of the enclosing sphere, of the solid's sphere"),
        'even': ('choice', 'tree', '-', None, None, 'tree|boxes|whole', 'where bodies count as uniformly distributed: cells that a test splits, boxes of bins, or the whole domain'),
        'change_level': ('number', 0.01, '-', 1e-12, 0.5, None, 'false alarms of the test that finds the cells out of date'),
        'alpha': ('number', 1.0, '-', 0.0, 1.0, None, 'share of collisions that stick; with another law of sticking a factor on it'),
        'sticking': ('choice', 'constant', '-', None, None, 'constant|viscous|liquid|contact', 'share that sticks: alpha, or by the impact: a viscous film, wet ash, elastic contacts'),
        'film_viscosity': ('number', 0.0, 'Pa s', 0.0, 1000000000000.0, None, 'viscous, liquid: of the liquid on the particles'),
        'film_thickness': ('number', 0.0, 'm', 0.0, 1.0, None, 'viscous: h of the film'),
        'asperity': ('number', 0.0, 'm', 0.0, 1.0, None, 'viscous: height h_a of the roughness'),
        'restitution': ('number', 0.0, '-', 0.0, 1.0, None, 'viscous: e of the dry solids'),
        'critical_stokes': ('number', 1.3, '-', 0.0, 1000000000000.0, None, 'liquid: St_cr, where half of the collisions stick'),
        'stokes_exponent': ('number', 0.8, '-', 0.0, 100.0, None, 'liquid: q of 1 / (1 + (St / St_cr)^q)'),
        'adhesion': ('number', 0.0, '-', 0.0, 1000000.0, None, 'contact: work of adhesion of the surfaces [J/m^2]'),
        'young': ('number', 0.0, 'Pa', 0.0, 1000000000000000.0, None, "contact: Young's modulus of the particles"),
        'poisson': ('number', 0.25, '-', -0.999, 0.5, None, "contact: Poisson's ratio of the particles"),
        'structure': ('flag', True, '-', None, None, None, 'aggregates keep their grains as they touch; no: drops that merge'),
        'meeting': ('choice', 'auto', '-', None, None, 'auto|ballistic|diffusive|central|reaction', 'how the smaller of a pair comes: auto is diffusive for kernel brownian alone, else on lines over the cross-section; reaction: all contacts equally likely, as where few touches stick'),
        'walk_step': ('number', 0.1, '-', 0.0001, 1.0, None, 'diffusive: least step of the walk, in radii of the smallest released particle'),
        'max_tries': ('integer', 100.0, '-', 1.0, 1000000.0, None, 'paths or contacts tried before a pair is given up, in thousands; central lines: one by one'),
        'duration': ('number', 0.0, 's', 0.0, 1e+300, None, 'time that passes at most'),
        'rows': ('integer', 50.0, '-', 1.0, 1000000.0, None, 'rows of the tables over it'),
        'step_error': ('number', 0.05, '-', 1e-06, 0.5, None, "share of a meeting, of the height passed up or down (of the width too, where sides are not periodic) and of the density that a field changes, that a step may hold; and the most collisions of a pair's kind in a sub-step"),
        'time_step': ('number', 0.0, 's', 0.0, 1e+300, None, 'longest step; 0: by step_error'),
        'seed': ('integer', 1.0, '-', 0.0, 1.8446744073709552e+19, None, 'of every draw'),
        'keep': ('integer', 20.0, '-', 0.0, 1000000.0, None, 'aggregates of most grains, each written as a state.h5 for clast pack --shapes'),
        'bed_width': ('number', 0.0, 'm', 0.0, 1000000.0, None, 'width of the column in deposit.h5 (that of its widest body at least; a periodic bed asks for 2.25 of them), where all bodies of the floor wait for clast pack --start, each above its position (modulo the width) and those that came before; 0: none'),
        'frames': ('integer', 0.0, '-', 0.0, 1000000.0, None, 'a frame for ParaView at each so many rows; 0: none'),
        'checkpoint_time': ('number', 60.0, 's', 0.0, 1000000000.0, None, 'between checkpoints, of the clock'),
        'resume': ('text', '', '-', None, None, None, 'run folder to go on with'),
        'force': ('flag', False, '-', None, None, None, 'replace an earlier run in the output folder'),
    },
    'study': {
        'run': ('text', '', '-', None, None, None, 'command to run: aggregate, decompose, fill, ...'),
        'config': ('text', '', '-', None, None, None, 'YAML configuration that all runs share'),
        'argument': ('texts', '', '-', None, None, None, 'argument that all runs share, such as an input file'),
        'fix': ('texts', '', '-', None, None, None, 'key=value that all runs share'),
        'vary': ('texts', '', '-', None, None, None, 'key=a|b|c: values that the runs take'),
        'design': ('choice', 'grid', '-', None, None, 'grid|zip', 'values of several vary: all combinations, or first with first, second with second'),
        'table': ('text', '', '-', None, None, None, 'CSV with a run a row, a key a column'),
        'seeds': ('integer', 1.0, '-', 1.0, 1000000.0, None, 'realisations of each'),
        'seed': ('integer', -1.0, '-', -1.0, 9007199253740992.0, None, 'seed of the first realisation (-1: that of the configuration, or 1), then one more each'),
        'keep': ('texts', '', '-', None, None, None, 'result to tabulate, a.b for b within a; none: every number but those of longer lists'),
        'shard': ('text', '', '-', None, None, None, 'K/N: do every N-th run from the K-th, for job arrays'),
    },
    'render': {
        'width': ('integer', 1600.0, '-', 64.0, 16384.0, None, 'pixels'),
        'height': ('integer', 1200.0, '-', 64.0, 16384.0, None, 'pixels'),
        'samples': ('integer', 16.0, '-', 1.0, 4096.0, None, 'camera rays a pixel'),
        'ambient_rays': ('integer', 1.0, '-', 1.0, 256.0, None, 'sky rays a camera ray'),
        'projection': ('choice', 'orthographic', '-', None, None, 'orthographic|perspective', 'how depth is shown'),
        'up': ('choice', 'z', '-', None, None, 'x|y|z', 'axis that points up'),
        'azimuth': ('number', -0.9599310885968813, 'rad', -20.0, 20.0, None, 'of the viewer about the up axis'),
        'elevation': ('number', 0.4363323129985824, 'rad', -1.5707963267948966, 1.5707963267948966, None, 'of the viewer above the horizontal'),
        'field_of_view': ('number', 0.4363323129985824, 'rad', 0.01, 2.5, None, "perspective: angle of the picture's height"),
        'zoom': ('number', 1.0, '-', 0.001, 1000.0, None, '1: everything just fits'),
        'colour': ('choice', 'auto', '-', None, None, 'auto|single|size|order|shape', 'what colours mean; auto: size where sizes differ'),
        'tint': ('text', '#c9b79c', '-', None, None, None, 'single colour, #rrggbb'),
        'scale': ('choice', 'auto', '-', None, None, 'auto|linear|log', 'of the colour bar; auto: log for sizes over a factor 4'),
        'shading': ('choice', 'smooth', '-', None, None, 'smooth|flat', 'smooth rounds facets that meet below 50 degrees'),
        'background': ('choice', 'white', '-', None, None, 'white|transparent|black', 'behind the grains'),
        'ground': ('flag', False, '-', None, None, None, 'shadow on a plane under the grains'),
        'cut': ('choice', 'none', '-', None, None, 'none|x|y|z|view', 'cut away the half nearer to the viewer: by a plane across this axis'),
        'cut_position': ('number', 0.5, '-', 0.0, 1.0, None, 'position of the cut in the extent along its axis'),
        'colour_bar': ('flag', True, '-', None, None, None, 'legend of the colours'),
        'scale_bar': ('flag', True, '-', None, None, None, 'bar of a round length, in perspective at the centre'),
        'unit': ('text', '', '-', None, None, None, 'unit of the coordinates where the input has none (um, mm, m)'),
        'sun_azimuth': ('number', -0.6981317007977318, 'rad', -3.141592653589793, 3.141592653589793, None, 'of the sun, to the right of the viewer'),
        'sun_elevation': ('number', 0.7853981633974483, 'rad', -1.5707963267948966, 1.5707963267948966, None, 'of the sun above the line of sight'),
        'sun_radius': ('number', 0.05235987755982989, 'rad', 0.0, 1.0, None, "half-angle of the sun's disc: softness of shadows"),
        'ambient': ('number', 0.45, '-', 0.0, 1.0, None, 'share of the light from the sky'),
        'seed': ('integer', 1.0, '-', 0.0, 1e+18, None, "of the samples' shifts"),
    },
    'report': {
        'title': ('text', '', '-', None, None, None, "title of the page; made from the runs' names when not given"),
        'rows': ('integer', 12.0, '-', 1.0, 1000000.0, None, 'rows shown of each table'),
        'view': ('flag', True, '-', None, None, None, 'interactive 3-D view of each run with a state.h5'),
        'triangles': ('integer', 400000.0, '-', 1000.0, 100000000.0, None, 'triangles of one 3-D view; grains are simplified to fit'),
        'picture_mb': ('integer', 32.0, '-', 0.0, 10000.0, None, 'most megabytes of pictures of one run'),
    },
    'export': {
        'level': ('integer', 3.0, '-', 0.0, 7.0, None, 'fineness of spheres and ellipsoids: 20 * 4^level triangles'),
        'points': ('flag', False, '-', None, None, None, 'VTU of a point a grain, with quaternion and scale, instead of surfaces'),
        'colour': ('choice', 'grain', '-', None, None, 'grain|order|size|shape', 'what colours the grains of a PLY'),
        'table': ('text', '', '-', None, None, None, 'write this table of the run (.csv or .json) instead of its grains'),
        'unit': ('text', '', '-', None, None, None, 'length unit of the coordinates in .stl, .obj and .ply; none: mm, as 3MF has it'),
        'density': ('number', 0.0, 'kg/m^3', 0.0, 1000000.0, None, "of all grains of another program's file that gives none; 0: not known, left out"),
        'columns': ('text', '', '-', None, None, None, 'spheres of another program: what its columns are, all of them, such as id,x,y,z,d (- passes one over); none: by their names'),
        'diameter': ('text', '0', '-', None, None, None, "spheres of another program: diameter of all, instead of the file's; 0: the file's"),
    },
    'bench': {
        'data': ('text', 'data/scarlet', '-', None, None, None, "folder of SCARLET-1.0's shapes and sizes (stl/, *.csv)"),
        'repeats': ('integer', 3.0, '-', 1.0, 1000.0, None, 'times each scene runs; the least time counts'),
        'list': ('flag', False, '-', None, None, None, 'name the scenes and run none'),
    },
    'describe': {
    },
    'man': {
    },
    'completion': {
        'shell': ('choice', 'bash', '-', None, None, 'bash|zsh', 'which shell'),
    },
}

# Keys of the library's own tables.
TABLES: dict[str, tuple[str, ...]] = {
    'clast_spectrum_fields': ('solver', 'initial', 'concentration', 'initial_mean', 'initial_sd', 'particles', 'size_min', 'size_max', 'per_octave', 'breakage_rate', 'breakage_exponent', 'fragments', 'fragment_exponent', 'source', 'source_size', 'settling_depth', 'tolerance'),
    'clast_agglomerate_fields': ('kernel', 'duration', 'n_step', 'repeats', 'collisions', 'leap', 'block', 'self_collisions', 'out_of_range', 'alpha', 'sticking', 'film_viscosity', 'film_thickness', 'asperity', 'restitution', 'critical_stokes', 'stokes_exponent', 'adhesion', 'young', 'poisson', 'radius_law', 'monomer_radius', 'fractal_dimension', 'fractal_prefactor', 'constant', 'additive', 'product', 'temperature', 'viscosity', 'density', 'particle_density', 'mean_free_path', 'shear', 'shear_constant', 'dissipation', 'speed_rms', 'gravity', 'efficiency', 'settling_law', 'rebuild', 'change_level', 'fixed', 'depth'),
    'clast_aggregate_fields': ('mode', 'core', 'core_size', 'core_meaning', 'core_density', 'coat', 'coat_weight', 'class_limit', 'coat_density', 'core_spheres', 'coat_spheres', 'fill_spheres', 'fill', 'unit', 'accept_faults', 'sizes', 'size_column', 'size_unit', 'size', 'size_law', 'size_mean', 'size_deviation', 'size_shape', 'size_low', 'size_high', 'n_particle', 'size_draw', 'size_by_mass', 'replicate', 'size_meaning', 'order', 'cone', 'rays', 'orientations', 'axis', 'origin', 'target', 'start', 'max_tries', 'approach', 'walk_step', 'contact', 'flavour', 'march_coarse', 'march_fine', 'march_steps', 'march_vertices', 'envelope', 'envelope_every', 'solid_union', 'fall_speed', 'envelope_rays', 'envelope_length', 'permeability', 'stop_mass', 'stop_size', 'stop_porosity', 'fit', 'observed_size', 'observed_size_error', 'observed_density', 'observed_density_error', 'observed_velocity', 'observed_velocity_error', 'fit_packing', 'fit_repeats', 'fit_replicate_max', 'pick', 'n_final', 'repeats', 'confidence', 'seed', 'checkpoint_every', 'picture', 'printable', 'neck', 'spacing', 'force', 'resume'),
    'clast_decompose_fields': ('domain', 'outside', 'variant', 'mesh', 'events', 'level', 'votes', 'tests', 'statistic', 'paper', 'ghost_samples', 'crossfit', 'lower', 'strict', 'max_pass', 'beta_dt', 'tree_level', 'tree_root_level', 'variable_tolerance', 'tree_least', 'tree_refine', 'extrapolate', 'pairs', 'pairs_radius', 'estimator', 'seed'),
    'clast_dem_fields': ('domain', 'width', 'depth', 'height', 'floor', 'lid', 'law', 'contact_scheme', 'restitution', 'collision_time', 'young', 'poisson', 'friction', 'wall_friction', 'rolling_friction', 'rolling_model', 'cohesion', 'cohesion_energy', 'surface_energy', 'clip', 'normal_torque', 'gyroscopic', 'clump_contacts', 'time_step', 'gravity', 'fluid_density', 'fluid_viscosity', 'sphere_drag', 'hindrance', 'added_mass', 'wet_restitution', 'rounding', 'skin', 'verify'),
    'clast_evolve_fields': ('shapes', 'shape_weight', 'density', 'unit', 'accept_faults', 'curve', 'particles', 'weight', 'release', 'points', 'columns', 'diameter_column', 'frame', 'dataset', 'domain', 'floor', 'sides', 'open_top', 'wind', 'field', 'field_columns', 'wind_shear', 'eddy_diffusivity', 'brownian', 'fall', 'temperature', 'viscosity', 'fluid_density', 'mean_free_path', 'gravity', 'kernel', 'shear', 'dissipation', 'speed_rms', 'efficiency', 'constant', 'additive', 'product', 'out_of_range', 'collision_radius', 'even', 'change_level', 'alpha', 'sticking', 'film_viscosity', 'film_thickness', 'asperity', 'restitution', 'critical_stokes', 'stokes_exponent', 'adhesion', 'young', 'poisson', 'structure', 'meeting', 'walk_step', 'max_tries', 'duration', 'rows', 'step_error', 'time_step', 'seed', 'keep', 'bed_width', 'frames', 'checkpoint_time', 'resume', 'force'),
    'clast_fill_fields': ('spheres', 'strategy', 'filled', 'volume_error', 'centroid_error', 'inertia_error', 'min_radius', 'min_share', 'tolerance', 'candidates', 'first_at_centre', 'vertex_subset', 'max_tries', 'outer', 'shrink', 'overlap', 'protrusion', 'allow_open', 'seed', 'name', 'history'),
    'clast_synthesize_fields': ('flatness', 'flatness_deviation', 'elongation', 'elongation_deviation', 'form_low', 'form_high', 'size', 'measure', 'rough', 'tolerance', 'decay', 'degrees', 'faces', 'seed'),
    'clast_mesh_repair_fields': ('weld', 'weld_tolerance', 'drop', 'split', 'split_tolerance', 'loose', 'orient', 'fill', 'fill_size', 'separate', 'unite', 'keep'),
    'clast_pack_fields': ('curve', 'spread', 'count', 'size_meaning', 'shapes', 'shape_weight', 'unit', 'hull', 'faces', 'ellipsoids', 'form_law', 'flatness_mean', 'flatness_deviation', 'elongation_mean', 'elongation_deviation', 'density', 'density_of', 'density_weight', 'mass', 'seed', 'material', 'contacts', 'start', 'start_unit', 'start_columns', 'start_diameter', 'start_frame', 'container', 'container_unit', 'domain', 'width', 'depth', 'height', 'floor', 'lid', 'law', 'contact_scheme', 'restitution', 'collision_time', 'young', 'poisson', 'friction', 'wall_friction', 'rolling_friction', 'rolling_model', 'cohesion', 'cohesion_energy', 'surface_energy', 'clip', 'normal_torque', 'gyroscopic', 'clump_contacts', 'time_step', 'gravity', 'fluid_density', 'fluid_viscosity', 'sphere_drag', 'hindrance', 'added_mass', 'wet_restitution', 'rounding', 'skin', 'verify', 'generator', 'spacing', 'fill_low', 'fill_high', 'first_low', 'first_high', 'initial_speed', 'random_turn', 'shake_amplitude', 'shake_period', 'shaking_time', 'shake_from_start', 'damping', 'rule', 'height_change', 'check_time', 'still_speed', 'max_steps', 'max_damping_time', 'wall', 'outlet', 'wall_forces', 'stages', 'load_rate', 'load_tolerance', 'load_rest', 'max_load_time', 'energy', 'layer', 'cut', 'trim', 'series_time', 'frame_time', 'checkpoint_time', 'force', 'resume'),
    'clast_pairs_fields': ('pairs_radius', 'pairs_shells', 'outside'),
    'clast_porosity_fit_fields': ('target', 'columns', 'group', 'n_term', 'use', 'correlation_limit', 'n_fold', 'n_repeat', 'score', 'validation', 'n_permutation', 'seed'),
    'clast_render_fields': ('width', 'height', 'samples', 'ambient_rays', 'projection', 'up', 'azimuth', 'elevation', 'field_of_view', 'zoom', 'colour', 'tint', 'scale', 'shading', 'background', 'ground', 'cut', 'cut_position', 'colour_bar', 'scale_bar', 'unit', 'sun_azimuth', 'sun_elevation', 'sun_radius', 'ambient', 'seed'),
    'clast_report_fields': ('title', 'rows', 'view', 'triangles', 'picture_mb'),
    'clast_study_fields': ('run', 'config', 'argument', 'fix', 'vary', 'design', 'table', 'seeds', 'seed', 'keep', 'shard'),
    'clast_workspace_fields': ('tests', 'tests_every', 'tests_moved', 'cells', 'cells_every', 'cells_level', 'pairs_every', 'pairs_most'),
}

# Commands that write a run's folder.
FOLDERS: tuple[str, ...] = ('aggregate', 'pack', 'porosity', 'fit', 'predict', 'decompose', 'agglomerate', 'evolve', 'study')

# Commands that a study can run.
STUDIED: tuple[str, ...] = ('mesh check', 'shape', 'grading', 'fill', 'aggregate', 'pack', 'porosity', 'fit', 'predict', 'decompose', 'agglomerate', 'evolve', 'report', 'bench', 'describe')
