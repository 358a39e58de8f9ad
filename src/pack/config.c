// The option table of a packing.
#include "dem/fields.h"
#include <clast/pack.h>

#define FIELD(type, name) #name, .offset = offsetof(clast_pack_config, name), CLAST_FIELD_##type
#define TEXT(name, value, ...)                                                                     \
    {                                                                                              \
        FIELD(TEXT, name), 0, 0, 0, "-", .text = value, .help = __VA_ARGS__                        \
    }
#define NUMBER(name, value, low, high, unit, ...)                                                  \
    {                                                                                              \
        FIELD(F64, name), value, low, high, unit, __VA_ARGS__                                      \
    }
#define CHOICE(name, value, words, ...)                                                            \
    {                                                                                              \
        FIELD(CHOICE, name), value, 0, 0, "-", .text = words, .help = __VA_ARGS__                  \
    }
#define FLAG(name, value, ...)                                                                     \
    {                                                                                              \
        FIELD(BOOL, name), value, 0, 1, "-", __VA_ARGS__                                           \
    }

const clast_field clast_pack_fields[] = {
    TEXT(curve, "U1",
         "sizes: a published case (U1 U3 U5 U7 B30 B50 B70), a sieve curve's file, list:FILE "
         "(sizes, counts), masses:FILE (sizes, masses), "
         "uniform:LOW,HIGH, lognormal:MEAN,DEVIATION[,LOW,HIGH], or one size",
         .common = true, .group = "sizes"),
    CHOICE(spread, 0, "step|linear|means", "how sizes lie within a sieve class"),
    CHOICE(count, 0, "mean|exact", "grains of a class by its mean size (eq. 9), or by its mass"),
    CHOICE(size_meaning, 0, "sieve|volume", "sizes are sieve sizes (eq. 1), or volume-equivalent"),
    {FIELD(TEXT_LIST, shapes), 0, 0, 0, "-",
     "shapes, drawn by weight: sphere, ellipsoid:a,b,c, a surface (its convex hull), spheres of a "
     "clump (CSV x,y,z,radius or state.h5), or an aggregate (state.h5); only their form counts, "
     "and with density 0 an aggregate's own density",
     "sphere", .common = true, .group = "shapes"},
    {FIELD(F64_LIST, shape_weight), 0, 0, DBL_MAX, "-",
     "probability of each shape; none: all equal", ""},
    TEXT(unit, "", "length unit of surface files; may be left out, since sizes come from the curve",
         .common = true),
    FLAG(hull, 1,
         "take the convex hull of every surface and report the volume it adds; no: refuse surfaces "
         "that are not convex"),
    {FIELD(I32, faces), 0, 0, 1e6, "-",
     "take hulls of at most so many triangles; 0: as many as they have", NULL},
    FLAG(ellipsoids, 0, "take the mass-equivalent ellipsoid of every surface and clump"),
    FLAG(form_law, 0, "stretch every grain to a form drawn from normal laws of S/I and I/L"),
    NUMBER(flatness_mean, 0.647, 1e-3, 1, "-", "mean flatness S/I of form_law"),
    NUMBER(flatness_deviation, 0.175, 0, 10, "-", "its standard deviation"),
    NUMBER(elongation_mean, 0.682, 1e-3, 1, "-", "mean elongation I/L of form_law"),
    NUMBER(elongation_deviation, 0.139, 0, 10, "-", "its standard deviation"),
    {FIELD(F64_LIST, density), 0, 0, 1e6, "kg/m^3",
     "density of the grains (rho_p), else 2650: one for all, or one for each shape (or as "
     "density_of says); 0: those of the aggregate's own parts, as its state.h5 has them; none "
     "beside a start, which has its own",
     "", .common = true, .group = "density and mass"},
    CHOICE(density_of, 0, "shape|chance|class|list",
           "density lists one for each shape, or several to draw from whatever a grain's shape, or "
           "one for each class of the sieve curve; list: column density of list:FILE or "
           "masses:FILE, in place of density"),
    {FIELD(F64_LIST, density_weight), 0, 0, DBL_MAX, "-",
     "probability of each density (by number of grains) with density_of: chance; none: all equal",
     ""},
    NUMBER(mass, 1, 1e-15, 1e15, "kg", "mass of the packing (m_tot)", .common = true),
    {FIELD(U64, seed), 1, 0, 1.8446744073709552e19, "-",
     "seed of sizes, forms, orientations, velocities", NULL, .common = true},
    {FIELD(TEXT_LIST, material), 0, 0, 0, "-",
     "name of the grains' material, one for all shapes or one for each, for contacts", "",
     .group = "materials"},
    {FIELD(TEXT_LIST, contacts), 0, 0, 0, "-",
     "what differs where two sides touch, later ones over earlier: two of grains, walls, "
     "materials, "
     "walls' names (floor, lid, sides, ..., of wall); then friction 0.2, rolling_friction, "
     "restitution 0.5, poisson, collision_time 100us (law linear), young 5MPa,200GPa (law hertz; "
     "one number, or one of either side)",
     ""},
    TEXT(
        start, "",
        "packing to begin with, in place of grains that are made: a run of clast (state.h5, or its "
        "export as CSV beside shapes), or "
        "spheres of another program (CSV, LAMMPS dump, YADE's x y z r, voro++, .xyz, .xyzd)",
        .group = "a bed from elsewhere"),
    TEXT(start_unit, "", "length unit of the start, where it does not say (a dump's ITEM: UNITS)"),
    TEXT(start_columns, "",
         "columns of its spheres in their order, all of them, - to pass one over: id,x,y,z,d"),
    NUMBER(start_diameter, 0, 0, 1e6, "m", "of all its spheres; 0: as the file says"),
    {FIELD(I64, start_frame), -1, -9e15, 9e15, "-",
     "snapshot of a LAMMPS dump or .xyz, from 0; negative: from the end", NULL},
    TEXT(container, "",
         "surface, closed or open, that holds the grains in place of domain, width, depth and "
         "height; grains are made inside of it",
         .group = "container"),
    TEXT(container_unit, "",
         "length unit of its coordinates, where its header does not say (clast's does)"),

    CLX_DEM_FIELDS(clast_pack_config, dem.),

    CHOICE(
        generator, 0, "cubic|hcp|shelf",
        "grains begin on a cubic lattice (published), a close-packed one (reference program), or "
        "in rows as dense as their spheres allow",
        .group = "making grains"),
    NUMBER(spacing, 0, 0, 1e6, "m",
           "of that lattice (h_g); 0: the published one of the case, or what the grains need"),
    NUMBER(fill_low, 0.6, 0, 1, "-", "grains begin above this share of the height"),
    NUMBER(fill_high, 1.0, 0, 1, "-", "and below this"),
    NUMBER(first_low, -1, -1, 1, "-", "the same of the first fill; -1: as all (reference: 0.1)"),
    NUMBER(first_high, -1, -1, 1, "-", "and below this (reference: 0.9)"),
    NUMBER(initial_speed, 1, 0, 1e3, "m/s", "downwards (u_init); a tenth of it sideways at random"),
    FLAG(random_turn, 1,
         "grains begin with random orientations; off: as stored (reference program)"),

    NUMBER(shake_amplitude, 3e-4, 0, 1e3, "m", "of shaking in x (A_s); 0: none",
           .group = "shaking and damping"),
    NUMBER(shake_period, 0.025, 1e-9, 1e6, "s", "of shaking (T_s)"),
    NUMBER(shaking_time, 1, 0, 1e6, "s", "of shaking after the last grain was made (t_s)",
           .common = true),
    FLAG(shake_from_start, 1, "shake while grains are made, too"),
    NUMBER(damping, 1e-3, 1e-300, 1, "-", "velocities keep this share a second at the end (c_d)"),

    CHOICE(rule, 0, "height|speed|either", "when the bed is at rest",
           .group = "when the bed is at rest"),
    NUMBER(height_change, 1e-5, 0, 1e6, "m",
           "of the mean height in check_time; for grains below 1 mm a hundredth of their size"),
    NUMBER(check_time, 0.01, 1e-12, 1e6, "s", "between two checks of it"),
    NUMBER(still_speed, 1e-3, 0, 1e6, "m/s",
           "of the fastest grain; for grains below 1 mm their size a second or less"),
    {FIELD(I64, max_steps), 0, 0, 9e15, "-",
     "stop after so many time steps, finished or not; 0: never", NULL, .common = true},
    NUMBER(max_damping_time, 20, 0, 1e9, "s", "give up when the bed is not at rest by then"),

    {FIELD(TEXT_LIST, wall), 0, 0, 0, "-",
     "walls that move, are pressed or open: NAME FILE UNIT (a surface), or floor, lid, sides, "
     "left, "
     "right, front, back of the domain; then move X,Y,Zmm/s, vibrate X,Y,Zmm 20ms, axis X,Y,Z, "
     "about "
     "X,Y,Zmm, rotate 30rpm, swing 5deg 1s, table FILE, press X,Y,Z, area 1m^2",
     "", .group = "walls and outlets"},
    {FIELD(TEXT_LIST, outlet), 0, 0, 0, "-",
     "half-spaces whose grains leave and are counted: z<-10mm", ""},
    FLAG(wall_forces, 0,
         "force and torque on all walls over time, also where none moves: walls.csv"),

    {FIELD(TEXT_LIST, stages), 0, 0, 0, "-",
     "stages that load a bed, one after the other; between walls: NAME (its motion runs), "
     "NAME=10kPa, NAME=5N, NAME=1mm/s (where it presses), open NAME, hold; then until rest, time "
     "T, "
     "stress P, way D or mass M. In domain cell: isotropic P, oedometer P, "
     "triaxial P RATE, shear RATE [P], hold, or x=, y=, z=, xz= (10kPa a pressure, 0.1/s a rate, "
     "above 0 pressing); then until rest, strain E, stress P or time T",
     "", .group = "load"},
    NUMBER(load_rate, 1, 1e-9, 1e9, "1/s",
           "rate of strain at which a pressure is approached, at most"),
    NUMBER(load_tolerance, 0.01, 1e-9, 1, "-", "share of a pressure within which it is reached"),
    NUMBER(
        load_rest, 1e-3, 1e-12, 1, "-",
        "a loaded bed rests when the mean force on a grain over that of a contact is below this"),
    NUMBER(max_load_time, 20, 0, 1e9, "s", "give up when a stage has not come to its end by then"),
    FLAG(energy, 0, "record the work of all forces by kind: load.csv, energy_book.svg"),

    NUMBER(layer, 1e-3, 1e-12, 1e6, "m",
           "slices of the porosity profile (h_p); for grains below 1 mm a tenth of their size",
           .group = "measures"),
    NUMBER(cut, 0.5, 0, 1, "-", "the bed ends where the porosity is this (n cut-off)"),
    NUMBER(trim, -1, -1, 1e6, "m",
           "left out at both ends of the bed (h_pd); -1: 31.5 mm in the periodic box, else 0"),
    NUMBER(series_time, 0.01, 1e-12, 1e9, "s", "between rows of series.csv", .group = "output"),
    NUMBER(frame_time, 0, 0, 1e9, "s", "between frames for ParaView; 0: none", .common = true),
    NUMBER(checkpoint_time, 120, 0, 1e9, "s", "between checkpoints, by the clock"),
    FLAG(force, 0, "replace an earlier run in the output folder, once the new one has succeeded"),
    TEXT(resume, "", "go on with the run in this folder"),
    {0},
};
