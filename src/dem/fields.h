#pragma once
// Rows of the physics in an option table: FIELDS(TYPE, PREFIX) for a configuration struct TYPE
// whose clast_dem_config is reached by PREFIX ("dem." or nothing).
#include <clast/dem.h>
#include <float.h>

#define CLX_DEM_AT(TYPE, member, name, kind)                                                       \
#name, .offset = offsetof(TYPE, member name), CLAST_FIELD_##kind
#define CLX_DEM_FIELDS(TYPE, IN)                                                                   \
    {CLX_DEM_AT(TYPE, IN, domain, CHOICE),                                                         \
     0,                                                                                            \
     0,                                                                                            \
     0,                                                                                            \
     "-",                                                                                          \
     "container, its sides; cell: periodic in x, y and z (height); open: container alone",         \
     "cylinder|periodic|box|open|cell",                                                            \
     .common = true},                                                                              \
        {CLX_DEM_AT(TYPE, IN, width, F64),                                                         \
         0.104,                                                                                    \
         1e-9,                                                                                     \
         1e6,                                                                                      \
         "m",                                                                                      \
         "inside diameter of the cylinder, or width in x (L)",                                     \
         NULL,                                                                                     \
         .common = true},                                                                          \
        {CLX_DEM_AT(TYPE, IN, depth, F64), 0, 0, 1e6, "m", "width in y; 0: as width", NULL},       \
        {CLX_DEM_AT(TYPE, IN, height, F64),         1.0,  1e-9,          1e6, "m",                 \
         "height of the lid and of generation (H)", NULL, .common = true},                         \
        {CLX_DEM_AT(TYPE, IN, floor, BOOL), 1, 0, 1, "-", "plane at z = 0", NULL},                 \
        {CLX_DEM_AT(TYPE, IN, lid, BOOL), 0, 0, 1, "-", "plane at z = height", NULL},              \
        {CLX_DEM_AT(TYPE, IN, law, CHOICE),                                                        \
         0,                                                                                        \
         0,                                                                                        \
         0,                                                                                        \
         "-",                                                                                      \
         "contact law",                                                                            \
         "linear|hertz",                                                                           \
         .group = "contacts"},                                                                     \
        {CLX_DEM_AT(TYPE, IN, contact_scheme, CHOICE),                                             \
         0,                                                                                        \
         0,                                                                                        \
         0,                                                                                        \
         "-",                                                                                      \
         "steps of spring and dashpot: explicit as published, or exact, which bear a twentieth "   \
         "of collision_time (and make beds denser by 0.004 there)",                                \
         "explicit|exact"},                                                                        \
        {CLX_DEM_AT(TYPE, IN, restitution, F64), 0.1,  1e-3,          1.0, "-",                    \
         "coefficient of restitution (e_n)",     NULL, .common = true},                            \
        {CLX_DEM_AT(TYPE, IN, collision_time, F64),   2e-4, 1e-12, 1e3, "s",                       \
         "duration of a collision (T_c), linear law", NULL},                                       \
        {CLX_DEM_AT(TYPE, IN, young, F64), 1e7, 1.0, 1e13, "Pa",                                   \
         "Young's modulus, hertz law",     NULL},                                                  \
        {CLX_DEM_AT(TYPE, IN, poisson, F64), 0.22, 0.0, 0.5, "-", "Poisson's ratio (nu_p)", NULL}, \
        {CLX_DEM_AT(TYPE, IN, friction, F64),                                                      \
         0.5,                                                                                      \
         0.0,                                                                                      \
         100.0,                                                                                    \
         "-",                                                                                      \
         "coefficient of friction between grains (mu_p)",                                          \
         NULL,                                                                                     \
         .common = true},                                                                          \
        {CLX_DEM_AT(TYPE, IN, wall_friction, F64),   -1,  -1, 100.0, "-",                          \
         "the same at walls; -1: as between grains", NULL},                                        \
        {CLX_DEM_AT(TYPE, IN, rolling_friction, F64),                                              \
         0,                                                                                        \
         0,                                                                                        \
         100.0,                                                                                    \
         "-",                                                                                      \
         "rolling torque over R* |F_n|",                                                           \
         NULL},                                                                                    \
        {CLX_DEM_AT(TYPE, IN, rolling_model, CHOICE),                                              \
         0,                                                                                        \
         0,                                                                                        \
         0,                                                                                        \
         "-",                                                                                      \
         "rolling friction as a constant torque, or as a spring by which a grain rests on a "      \
         "slope",                                                                                  \
         "torque|spring"},                                                                         \
        {CLX_DEM_AT(TYPE, IN, cohesion, CHOICE),                                                   \
         0,                                                                                        \
         0,                                                                                        \
         0,                                                                                        \
         "-",                                                                                      \
         "attraction of touching grains: none, with the contact area, DMT's pull-off, or JKR's "   \
         "(its neck with law hertz)",                                                              \
         "none|area|dmt|jkr"},                                                                     \
        {CLX_DEM_AT(TYPE, IN, cohesion_energy, F64),    0,   0, 1e12, "J/m^3",                     \
         "attraction per contact area, cohesion: area", NULL},                                     \
        {CLX_DEM_AT(TYPE, IN, surface_energy, F64), 0,   0, 1e6, "J/m^2",                          \
         "work of adhesion, cohesion: dmt or jkr",  NULL},                                         \
        {CLX_DEM_AT(TYPE, IN, clip, BOOL),                                                         \
         0,                                                                                        \
         0,                                                                                        \
         1,                                                                                        \
         "-",                                                                                      \
         "dashpots never pull (the reference program lets them)",                                  \
         NULL},                                                                                    \
        {CLX_DEM_AT(TYPE, IN, normal_torque, BOOL),                                                \
         1,                                                                                        \
         0,                                                                                        \
         1,                                                                                        \
         "-",                                                                                      \
         "normal forces exert torques on grains too; off: eq. 5 as printed",                       \
         NULL},                                                                                    \
        {CLX_DEM_AT(TYPE, IN, gyroscopic, BOOL),                                                   \
         1,                                                                                        \
         0,                                                                                        \
         1,                                                                                        \
         "-",                                                                                      \
         "keep angular momentum (eq. 3); off: as the reference program",                           \
         NULL},                                                                                    \
        {CLX_DEM_AT(TYPE, IN, clump_contacts, CHOICE),                                             \
         0,                                                                                        \
         0,                                                                                        \
         0,                                                                                        \
         "-",                                                                                      \
         "spheres of two clumps that touch at once: share one contact's stiffness, or each its "   \
         "own",                                                                                    \
         "shared|each"},                                                                           \
        {CLX_DEM_AT(TYPE, IN, time_step, F64), 5e-6, 1e-15, 1e3, "s", "time step", NULL,           \
         .group = "time, gravity and fluid"},                                                      \
        {CLX_DEM_AT(TYPE, IN, gravity, F64), 9.81, 0, 1e6, "m/s^2", "gravity along -z", NULL},     \
        {CLX_DEM_AT(TYPE, IN, fluid_density, F64),                                                 \
         1000,                                                                                     \
         0,                                                                                        \
         1e6,                                                                                      \
         "kg/m^3",                                                                                 \
         "density of the fluid around, for buoyancy (eq. 10)",                                     \
         NULL},                                                                                    \
        {CLX_DEM_AT(TYPE, IN, fluid_viscosity, F64),                                               \
         0,                                                                                        \
         0,                                                                                        \
         1e6,                                                                                      \
         "Pa s",                                                                                   \
         "viscosity for drag and torque of a fluid at rest; 0: none, as published",                \
         NULL},                                                                                    \
        {CLX_DEM_AT(TYPE, IN, sphere_drag, CHOICE),                                                \
         0,                                                                                        \
         0,                                                                                        \
         0,                                                                                        \
         "-",                                                                                      \
         "drag of spheres: the law of all forms, or the standard curve of spheres",                \
         "form|standard"},                                                                         \
        {CLX_DEM_AT(TYPE, IN, hindrance, BOOL),                                                    \
         0,                                                                                        \
         0,                                                                                        \
         1,                                                                                        \
         "-",                                                                                      \
         "drag grows with the grains around, by the porosity at its height (Di Felice)",           \
         NULL},                                                                                    \
        {CLX_DEM_AT(TYPE, IN, added_mass, F64),                                                    \
         0,                                                                                        \
         0,                                                                                        \
         10.0,                                                                                     \
         "-",                                                                                      \
         "fluid that a grain moves along, over its volume; 0.5 of a sphere",                       \
         NULL},                                                                                    \
        {CLX_DEM_AT(TYPE, IN, wet_restitution, BOOL),                                              \
         0,                                                                                        \
         0,                                                                                        \
         1,                                                                                        \
         "-",                                                                                      \
         "restitution falls with the impact's Stokes number (Gondret)",                            \
         NULL},                                                                                    \
        {CLX_DEM_AT(TYPE, IN, rounding, F64),                                                      \
         0,                                                                                        \
         0,                                                                                        \
         1e6,                                                                                      \
         "m",                                                                                      \
         "radius that edges of surfaces get; the surface shrinks so that its volume stays",        \
         NULL,                                                                                     \
         .group = "surfaces and neighbour lists"},                                                 \
        {CLX_DEM_AT(TYPE, IN, skin, F64),                                                          \
         0.1,                                                                                      \
         1e-3,                                                                                     \
         10.0,                                                                                     \
         "-",                                                                                      \
         "margin of neighbour lists over a grain's radius: speed only",                            \
         NULL},                                                                                    \
    {                                                                                              \
        CLX_DEM_AT(TYPE, IN, verify, I32), 0, 0, 1e9, "-",                                         \
            "every so many steps contacts are compared with a search without warm start; 0: "      \
            "never",                                                                               \
            NULL                                                                                   \
    }
