// The option table of an evolution, and the combinations that no single range can see.
#include "evolve/config.h"

#include "aggregate/config.h"
#include "assembly/whole.h"
#include "base/field.h"
#include "base/path.h"
#include "base/status.h"
#include "cloud/contract.h"
#include <clast/agglomerate.h>
#include <float.h>
#include <math.h>
#include <string.h>

static const double ROUNDING = 1e-9; ///< of the domain: borders that differ by less are one

#define FIELD(type, name) #name, .offset = offsetof(clast_evolve_config, name), CLAST_FIELD_##type
#define DEEP(type, name, member)                                                                   \
#name, .offset = offsetof(clast_evolve_config, member), CLAST_FIELD_##type
#define TEXT(name, value, ...)                                                                     \
    {                                                                                              \
        FIELD(TEXT, name), 0, 0, 0, "-", .text = value, .help = __VA_ARGS__                        \
    }
#define NUMBER(name, value, low, high, unit, ...)                                                  \
    {                                                                                              \
        FIELD(F64, name), value, low, high, unit, __VA_ARGS__                                      \
    }
#define COUNT(name, value, low, high, ...)                                                         \
    {                                                                                              \
        FIELD(I32, name), value, low, high, "-", __VA_ARGS__                                       \
    }
#define CHOICE(name, value, words, ...)                                                            \
    {                                                                                              \
        FIELD(CHOICE, name), value, 0, 0, "-", .text = words, .help = __VA_ARGS__                  \
    }
#define FLAG(name, value, ...)                                                                     \
    {                                                                                              \
        FIELD(BOOL, name), value, 0, 1, "-", __VA_ARGS__                                           \
    }
#define LIST(name, low, high, unit, value, ...)                                                    \
    {                                                                                              \
        FIELD(F64_LIST, name), 0, low, high, unit, .text = value, .help = __VA_ARGS__              \
    }
#define MEDIUM(name, member, value, high, unit, ...)                                               \
    {                                                                                              \
        DEEP(F64, name, member), value, 0, high, unit, __VA_ARGS__                                 \
    }

const clast_field clast_evolve_fields[] = {
    {FIELD(TEXT_LIST, shapes), 0, 0, 0, "-",
     "shapes, drawn by weight: sphere, ellipsoid:a,b,c, a closed surface, or an aggregate "
     "(state.h5)",
     "sphere", .common = true, .group = "particles"},
    LIST(shape_weight, 0, DBL_MAX, "-", "", "probability of each shape; none: all equal"),
    LIST(density, 1e-6, 1e6, "kg/m^3", "2500", "of the solid: one for all shapes, or one each",
         .common = true),
    TEXT(unit, "", "length unit of surface files; may be left out: sizes come from the curve"),
    FLAG(accept_faults, false,
         "use surfaces that are open, cross themselves or lie apart as they are"),
    TEXT(curve, "10um",
         "diameters of equal volume: one size, uniform:LOW,HIGH, "
         "lognormal:MEAN,DEVIATION[,LOW,HIGH], list:FILE, masses:FILE, a sieve curve's file, or a "
         "published case",
         .common = true),
    COUNT(particles, 0, 0, 1e7, "particles at the start; 0: the rows of points", .common = true),
    NUMBER(weight, 1, 1, 1e15, "-",
           "real particles W that each stands for, a whole number: the number density is particles "
           "x W / volume; rows in time and the summary have masses of all of them, tables of "
           "bodies and events the mass of one",
           .common = true),
    TEXT(release, "",
         "domain in which they start uniformly distributed (as domain), as far as it lies in that; "
         "a box in a box "
         "lies in it all; none: all of the domain"),
    TEXT(points, "", "file of positions x, y, z to start from instead (CSV, VTK, PLY, dump, HDF5)"),
    {FIELD(TEXT_LIST, columns), 0, 0, 0, "-",
     "its columns of coordinates, three; units in their names count (x_mm), else they are in m; "
     "x,y,z are found as x_m, y_m, z_m too",
     "x,y,z"},
    TEXT(diameter_column, "", "its column of volume-equivalent diameters; none: the curve"),
    {FIELD(I64, frame), 0, -1e12, 1e12, "-",
     "its snapshot, of a LAMMPS dump or .xyz, from 0; -1: the last", NULL},
    TEXT(dataset, "", "its array or folder, of an HDF5 file"),

    TEXT(domain, "",
         "box:LOW..,HIGH.., cylinder:X,Y,Z,NX,NY,NZ,R,L (base, axis), sphere:R, mesh:FILE; z is up",
         .common = true, .group = "space"),
    CHOICE(floor, 0, "deposit|reflect|periodic",
           "what is below: it stays there, comes back, or enters at the top", .common = true),
    CHOICE(sides, 2, "deposit|reflect|periodic", "the same of the sides; periodic: a box alone"),
    FLAG(open_top, 0, "what passes the top of a box is gone; else it comes back"),

    TEXT(wind, "0,0,0", "velocity x,y,z of the fluid at z = 0 [m/s]", .group = "fluid"),
    TEXT(field, "",
         "file of velocities on a regular grid (CSV x,y,z,u,v,w in m and m/s, VTK, HDF5, ...), "
         "added "
         "to the wind; beyond the grid those at its edge"),
    TEXT(field_columns, "u,v,w", "its columns of velocities"),
    NUMBER(wind_shear, 0, -1e9, 1e9, "1/s", "change of velocity x with z"),
    NUMBER(eddy_diffusivity, 0, 0, 1e6, "m^2/s", "turbulent diffusivity, the same everywhere"),
    FLAG(brownian, 1, "particles diffuse by Brownian motion, as their envelopes' drag says"),
    CHOICE(fall, 0, "form|sphere|stokes",
           "drag: of each body's own form, of the sphere of its envelope, or of that in creeping "
           "flow",
           .common = true),
    MEDIUM(temperature, medium.temperature, 288.15, 1e5, "K", "of the fluid"),
    MEDIUM(viscosity, medium.viscosity, 1.7894e-5, 1e6, "Pa s", "of the fluid (default: air)",
           .common = true),
    MEDIUM(fluid_density, medium.density, 1.225, 1e5, "kg/m^3", "of the fluid (default: air)",
           .common = true),
    MEDIUM(mean_free_path, medium.mean_free_path, 0, 1, "m",
           "of a gas, for the slip correction; 0: none"),
    MEDIUM(gravity, medium.gravity, 9.80665, 1e6, "m/s^2", "0: nothing falls"),

    TEXT(kernel, "brownian+settling",
         "collision kernel, or a sum, as in clast agglomerate --help-all: constant, additive, "
         "product, brownian, shear_laminar, shear_turbulent, settling, inertial, ...",
         .common = true, .group = "encounters"),
    MEDIUM(shear, medium.shear, 0, 1e12, "1/s",
           "shear rate that kernels use; 0: that of wind_shear"),
    MEDIUM(dissipation, medium.dissipation, 0, 1e12, "m^2/s^3", "turbulent dissipation"),
    MEDIUM(speed_rms, medium.speed_rms, 0, 1e6, "m/s", "turbulent velocity, one component"),
    MEDIUM(efficiency, medium.efficiency, 0, 1, "-",
           "collision efficiency of settling; 0: by Stokes number and ratio of radii"),
    MEDIUM(constant, medium.constant, 1e-6, 1e300, "m^3/s", "K of kernel constant"),
    MEDIUM(additive, medium.additive, 1e-6, 1e300, "m^3/s", "b of kernel additive"),
    MEDIUM(product, medium.product, 1e-6, 1e300, "m^3/s", "c of kernel product"),
    {DEEP(CHOICE, out_of_range, out_of_range), 0, 0, 0, "-",
     "kernels and sticking beyond where they hold", "error|extrapolate"},
    CHOICE(
        collision_radius, 0, "gyration|enclosing|volume",
        "radius that kernels use: sqrt(5/3) R_g, of the enclosing sphere, of the solid's sphere"),
    CHOICE(even, 0, "tree|boxes|whole",
           "where bodies count as uniformly distributed: cells that a test splits, boxes of bins, "
           "or the "
           "whole domain"),
    NUMBER(change_level, 0.01, 1e-12, 0.5, "-",
           "false alarms of the test that finds the cells out of date"),

    {DEEP(F64, alpha, alpha), 1, 0, 1, "-",
     "share of collisions that stick; with another law of sticking a factor on it",
     .group = "sticking"},
    {DEEP(CHOICE, sticking, sticking.law), 0, 0, 0, "-",
     "share that sticks: alpha, or by the impact: a viscous film, wet ash, elastic contacts",
     "constant|viscous|liquid|contact"},
    MEDIUM(film_viscosity, sticking.film_viscosity, 0, 1e12, "Pa s",
           "viscous, liquid: of the liquid on the particles"),
    MEDIUM(film_thickness, sticking.film_thickness, 0, 1, "m", "viscous: h of the film"),
    MEDIUM(asperity, sticking.asperity, 0, 1, "m", "viscous: height h_a of the roughness"),
    MEDIUM(restitution, sticking.restitution, 0, 1, "-", "viscous: e of the dry solids"),
    MEDIUM(critical_stokes, sticking.critical_stokes, 1.3, 1e12, "-",
           "liquid: St_cr, where half of the collisions stick"),
    MEDIUM(stokes_exponent, sticking.stokes_exponent, 0.8, 100, "-",
           "liquid: q of 1 / (1 + (St / St_cr)^q)"),
    MEDIUM(adhesion, sticking.adhesion, 0, 1e6, "-",
           "contact: work of adhesion of the surfaces [J/m^2]"),
    MEDIUM(young, sticking.young, 0, 1e15, "Pa", "contact: Young's modulus of the particles"),
    {DEEP(F64, poisson, sticking.poisson), 0.25, -0.999, 0.5, "-",
     "contact: Poisson's ratio of the particles"},

    FLAG(structure, 1, "aggregates keep their grains as they touch; no: drops that merge",
         .group = "aggregates"),
    CHOICE(meeting, 0, "auto|ballistic|diffusive|central|reaction",
           "how the smaller of a pair comes: auto is diffusive for kernel brownian alone, else on "
           "lines over the cross-section; reaction: all contacts equally likely, as where few "
           "touches stick"),
    NUMBER(walk_step, 0.1, 1e-4, 1, "-",
           "diffusive: least step of the walk, in radii of the smallest released particle"),
    COUNT(max_tries, 100, 1, 1e6,
          "paths or contacts tried before a pair is given up, in thousands; central lines: one by "
          "one"),

    NUMBER(duration, 0, 0, 1e300, "s", "time that passes at most", .common = true, .group = "time"),
    COUNT(rows, 50, 1, 1e6, "rows of the tables over it"),
    NUMBER(step_error, 0.05, 1e-6, 0.5, "-",
           "share of a meeting, of the height passed up or down (of the width too, where sides are "
           "not periodic) and of the density that a field changes, that a step may hold; and the "
           "most collisions of a pair's kind in a sub-step"),
    NUMBER(time_step, 0, 0, 1e300, "s", "longest step; 0: by step_error"),
    {FIELD(U64, seed), 1, 0, 1.8446744073709552e19, "-", "of every draw", .common = true},

    COUNT(keep, 20, 0, 1e6,
          "aggregates of most grains, each written as a state.h5 for clast pack --shapes",
          .group = "files"),
    NUMBER(bed_width, 0, 0, 1e6, "m",
           "width of the column in deposit.h5 (that of its widest body at least; a periodic bed "
           "asks for 2.25 of them), where all bodies of the floor wait for clast pack --start, "
           "each above its position (modulo the width) and those that came before; 0: none"),
    COUNT(frames, 0, 0, 1e6, "a frame for ParaView at each so many rows; 0: none"),
    NUMBER(checkpoint_time, 60, 0, 1e9, "s", "between checkpoints, of the clock"),
    TEXT(resume, "", "run folder to go on with"),
    FLAG(force, 0, "replace an earlier run in the output folder"),
    {0}};

clast_status clx_evolve_wind_read(const clast_evolve_config *c, double wind[3])
{
    const clast_status status = clx_numbers_parse(c->wind, 3, wind);
    if (status != CLAST_OK) {
        return clx_fail(CLAST_E_CONFIG, "wind: '%s' is not x,y,z in m/s", c->wind);
    }
    return CLAST_OK;
}

clast_status clx_evolve_collide(const clast_evolve_config *c, clast_collide_config *collide)
{
    clast_status status = CLAST_OK;
    *collide = (clast_collide_config){.medium = c->medium,
                                      .alpha = c->alpha,
                                      .sticking = c->sticking,
                                      .out_of_range = c->out_of_range,
                                      .seed = c->seed};
    collide->medium.particle_density = 0.0; // that of the particles, once they are there
    collide->medium.shear_constant = 0.0;
    CLX_TRY(clast_kernel_parse(c->kernel, &collide->kernel));
    CLX_CHECK((collide->kernel >> CLAST_KERNEL_BALLISTIC & 1U) == 0 || c->medium.gravity > 0.0 ||
                  c->medium.speed_rms > 0.0,
              CLAST_E_CONFIG,
              "kernel ballistic: no body has a velocity of its own (gravity 0, speed_rms 0)");
    CLX_CHECK((collide->kernel >> CLAST_KERNEL_INERTIAL & 1U) == 0 || c->medium.speed_rms > 0.0,
              CLAST_E_CONFIG, "kernel inertial needs speed_rms above 0");
    if (!(collide->medium.shear > 0.0)) {
        collide->medium.shear = fabs(c->wind_shear);
    }
    collide->medium.settling_law =
        c->fall == CLAST_FALL_STOKES ? CLAST_SETTLING_STOKES : CLAST_SETTLING_STANDARD;
done:
    return status;
}

int32_t clx_evolve_meeting(const clast_evolve_config *c, uint32_t kernel)
{
    const uint32_t slow = 1U << CLAST_KERNEL_BROWNIAN | 1U << CLAST_KERNEL_BROWNIAN_TRANSITION;
    if (c->meeting != CLAST_MEETING_AUTO) {
        return c->meeting;
    }
    return (kernel & ~slow) == 0 ? CLAST_MEETING_DIFFUSIVE : CLAST_MEETING_BALLISTIC;
}

/// What the motion of the bodies looks at, whatever the kernel.
typedef struct {
    const char *key;
    bool is_used;
    const char *without; ///< why not
} motion_use;

static motion_use motion_of(const clast_evolve_config *c, const char *key)
{
    const bool falls = c->medium.gravity > 0.0;
    const motion_use use[] = {
        {"temperature", c->brownian, " and without brownian"},
        {"density", falls, " and without gravity"},
        {"viscosity", falls || c->brownian, " and without gravity and brownian"},
        {"mean_free_path", falls || c->brownian, " and without gravity and brownian"},
        {"gravity", true, ""}};
    for (size_t k = 0; k < sizeof use / sizeof use[0]; ++k) {
        if (strcmp(use[k].key, key) == 0) {
            return use[k];
        }
    }
    return (motion_use){.without = ""};
}

/// Refuses a number of kernels or sticking that neither looks at, nor the motion.
static clast_status check_used(const clast_evolve_config *c, const clast_collide_config *collide)
{
    clast_status status = CLAST_OK;
    clast_collide_config seen = *collide;
    if ((collide->kernel >> CLAST_KERNEL_BALLISTIC & 1U) != 0 && c->medium.speed_rms > 0.0) {
        seen.kernel |= 1U << CLAST_KERNEL_INERTIAL; // bodies take their velocities from turbulence
    }
    for (const clast_field *f = clast_evolve_fields; f->name != NULL; ++f) {
        const char *const key = strcmp(f->name, "fluid_density") == 0 ? "density" : f->name;
        const char *const by = clast_collide_idle(&seen, key, false);
        const motion_use motion = motion_of(c, key);
        char word[256] = "";
        if (f->type != CLAST_FIELD_F64 || by == NULL || motion.is_used ||
            clast_field_is_default(f, c)) {
            continue;
        }
        (void)clast_field_format(clast_fields_find(clast_evolve_fields, by), c, 0, sizeof word,
                                 word);
        CLX_CHECK(false, CLAST_E_CONFIG, "%s does nothing with %s %s%s", f->name, by, word,
                  motion.without);
    }
done:
    return status;
}

/// Whether all shapes are earlier aggregates, whose grains have their own densities.
static bool are_aggregates(const clast_text_list *shapes)
{
    bool are = shapes->n > 0;
    for (int32_t i = 0; i < shapes->n; ++i) {
        are = are && clx_path_is(shapes->item[i], "h5");
    }
    return are;
}

/// Whether a shape is read from a surface file: no word, and no earlier aggregate.
static bool has_surface_file(const clast_text_list *shapes)
{
    bool has = false;
    for (int32_t i = 0; i < shapes->n; ++i) {
        const char *shape = shapes->item[i];
        has = has || (strcmp(shape, "sphere") != 0 && strncmp(shape, "ellipsoid:", 10) != 0 &&
                      !clx_path_is(shape, "h5"));
    }
    return has;
}

clast_status clx_evolve_release_check(const clast_evolve_input *input)
{
    clast_status status = CLAST_OK;
    const clast_domain *d = input->domain;
    const clast_domain *r = input->release;
    const bool are_boxes = r != NULL && d->kind == CLAST_DOMAIN_BOX && r->kind == CLAST_DOMAIN_BOX;
    for (int k = 0; are_boxes && k < 3; ++k) {
        const double slack = ROUNDING * (d->high[k] - d->low[k]);
        CLX_CHECK(r->low[k] >= d->low[k] - slack && r->high[k] <= d->high[k] + slack,
                  CLAST_E_CONFIG,
                  "release: it reaches from %s to %s along %c, beyond the domain (%s to %s)",
                  clx_unit_text(r->low[k], "m"), clx_unit_text(r->high[k], "m"), "xyz"[k],
                  clx_unit_text(d->low[k], "m"), clx_unit_text(d->high[k], "m"));
    }
done:
    return status;
}

clast_status clx_evolve_idle_check(const clast_evolve_config *c, const clast_evolve_input *input)
{
    clast_status status = CLAST_OK;
    clast_collide_config collide;
    CLX_TRY(clx_evolve_collide(c, &collide));
    const bool sees_radius =
        collide.kernel != 1U << CLAST_KERNEL_CONSTANT || c->sticking.law != CLAST_STICKING_CONSTANT;
    const clast_idle rules[] = {
        {c->medium.gravity == 0.0 && !c->brownian, "fall", "without gravity and brownian"},
        {!sees_radius, "collision_radius", "with kernel constant"},
        {are_aggregates(&c->shapes), "density",
         "with aggregates (state.h5), whose grains have their own"},
        {!has_surface_file(&c->shapes), "unit|accept_faults",
         "without a surface file among the shapes"},
        {c->shapes.n == 1, "shape_weight", "with one shape"},
        {input->points != NULL && input->points->radius != NULL, "curve", "with diameter_column"},
        {c->even == CLAST_EVEN_WHOLE, "change_level", "with even whole"},
        {!c->structure, "meeting|walk_step|max_tries|keep", "without structure: drops merge"},
        {clx_evolve_meeting(c, collide.kernel) != CLAST_MEETING_DIFFUSIVE, "walk_step",
         "without meeting diffusive"},
        {c->floor != CLAST_BORDER_DEPOSIT, "bed_width",
         "without a floor that is deposit: nothing lies there"},
        {input->points == NULL, "columns|frame|dataset", "without points"},
        {input->field == NULL, "field_columns", "without field"},
        {0}};
    CLX_TRY(check_used(c, &collide));
    CLX_TRY(clx_fields_idle(clast_evolve_fields, c, rules));
done:
    return status;
}

/// Whether anything goes down at all.
static bool can_reach_floor(const clast_evolve_config *c, const double wind[3])
{
    return c->medium.gravity > 0.0 || c->eddy_diffusivity > 0.0 || c->brownian || wind[2] < 0.0;
}

static clast_status check_borders(const clast_evolve_config *c, const clast_evolve_input *input)
{
    const clast_domain *domain = input->domain;
    clast_status status = CLAST_OK;
    const bool is_box = domain->kind == CLAST_DOMAIN_BOX;
    double wind[3];
    CLX_TRY(clx_evolve_wind_read(c, wind));
    CLX_CHECK(domain->dimension == 3, CLAST_E_CONFIG,
              "domain: %s has %d dimensions; particles of true shapes need 3", c->domain,
              domain->dimension);
    CLX_CHECK(is_box || (c->floor != CLAST_BORDER_PERIODIC && c->sides != CLAST_BORDER_PERIODIC),
              CLAST_E_CONFIG,
              "domain: only a box can be periodic; give sides and floor of %s: deposit or reflect",
              c->domain);
    CLX_CHECK(is_box || !c->open_top, CLAST_E_CONFIG, "open_top: only a box has a top");
    CLX_CHECK(c->floor != CLAST_BORDER_PERIODIC || !c->open_top, CLAST_E_CONFIG,
              "open_top: with floor: periodic what passes the top enters below");
    CLX_CHECK(c->floor != CLAST_BORDER_DEPOSIT || input->field != NULL || can_reach_floor(c, wind),
              CLAST_E_CONFIG,
              "floor: nothing reaches it (gravity 0, no diffusion, no wind down); take floor: "
              "reflect or periodic");
done:
    return status;
}

/// Whether what the caller of clast_evolve_create gave holds together.
static clast_status check_input(const clast_evolve_input *input)
{
    static const char caller[] = "clast_evolve_create";
    const void *const domain[] = {input->domain};
    CLX_GUARD(clx_given(caller, "input->domain", domain, 1));
    CLX_GUARD(
        clx_array_given(caller, "input->shape", input->shape, "input->n_shape", input->n_shape));
    for (int32_t i = 0; i < input->n_shape; ++i) {
        CLX_GUARD(clx_fault_given(caller, "input->shape", clx_assembly_fault(&input->shape[i])));
    }
    CLX_GUARD(clx_domain_check(input->domain));
    CLX_GUARD(input->release != NULL ? clx_domain_check(input->release) : CLAST_OK);
    CLX_GUARD(input->field != NULL ? clx_cloud_check(input->field) : CLAST_OK);
    return input->points != NULL ? clx_cloud_check(input->points) : CLAST_OK;
}

static clast_status check_counts(const clast_evolve_config *c, const clast_evolve_input *input)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(input->n_shape > 0 && input->shape != NULL, CLAST_E_CONFIG,
              "a cloud needs a shape (shapes)");
    CLX_CHECK(c->shape_weight.n == 0 || c->shape_weight.n == input->n_shape, CLAST_E_CONFIG,
              "shape_weight: %d weights of %d shapes", c->shape_weight.n, input->n_shape);
    CLX_CHECK(input->points != NULL || c->particles > 0, CLAST_E_CONFIG,
              "particles: give their number, or their points");
    CLX_CHECK(input->points == NULL || c->particles == 0, CLAST_E_CONFIG,
              "particles: the %lld rows of points are the number; leave it out",
              (long long)input->points->n);
    CLX_CHECK(input->points == NULL || (input->points->dimension == 3 && input->points->n > 0 &&
                                        input->points->n <= 10000000 && input->points->x != NULL),
              CLAST_E_CONFIG, "points: 1 to 10000000 rows of x, y, z are needed");
    CLX_CHECK(input->grading != NULL || (input->points != NULL && input->points->radius != NULL),
              CLAST_E_CONFIG, "curve: the particles have no sizes");
done:
    return status;
}

clast_status clx_evolve_config_check(const clast_evolve_config *c, const clast_evolve_input *input)
{
    clast_status status = CLAST_OK;
    double weights = 0.0;
    CLX_TRY(clast_fields_check(clast_evolve_fields, c));
    CLX_TRY(check_input(input));
    CLX_TRY(check_counts(c, input));
    CLX_TRY(check_borders(c, input));
    for (int32_t k = 0; k < c->shape_weight.n; ++k) {
        weights += c->shape_weight.item[k];
    }
    CLX_CHECK(c->shape_weight.n == 0 || weights > 0.0, CLAST_E_CONFIG,
              "shape_weight: all weights are 0");
    CLX_CHECK(c->weight == floor(c->weight), CLAST_E_CONFIG,
              "weight: %g is no whole number of particles", c->weight);
    CLX_CHECK(c->duration > 0.0, CLAST_E_CONFIG, "duration: give the time that passes, as 10s");
    CLX_CHECK(c->medium.viscosity > 0.0 && c->medium.density > 0.0, CLAST_E_CONFIG,
              "viscosity and fluid_density must be above 0");
    CLX_CHECK(!c->brownian || c->medium.temperature > 0.0, CLAST_E_CONFIG,
              "temperature: Brownian motion needs one above 0");
done:
    return status;
}
