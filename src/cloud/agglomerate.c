// Repeats of runs, their moments beside exact solutions, tables. [docs/theory/agglomeration.md]
#include "cloud/agglomerate.h"

#include "base/alloc.h"
#include "base/monitor.h"
#include "cloud/collide.h"
#include "cloud/contract.h"
#include "cloud/exact_counts.h"
#include "cloud/kernel_range.h"
#include "cloud/sectional.h"
#include "cloud/size_classes.h"
#include <math.h>
#include <string.h>

#define FIELD(type, name) #name, .offset = offsetof(clast_agglomerate_config, name), type
#define DEEP(type, name, member)                                                                   \
#name, .offset = offsetof(clast_agglomerate_config, collide.member), type
const clast_field clast_agglomerate_fields[] = {
    {FIELD(CLAST_FIELD_TEXT, kernel), 0, 0, 0, "-",
     "collision kernel, or a sum: brownian+settling; see the table above", "constant",
     .common = true, .group = "kernel and time"},
    {FIELD(CLAST_FIELD_F64, duration), 1.0, 0.0, 1e300, "s",
     "time that passes; of several snapshots after each, the last too: three take three times it",
     .common = true},
    {FIELD(CLAST_FIELD_I32, n_step), 10, 1, 1000000, "-", "steps of that time", .common = true},
    {FIELD(CLAST_FIELD_I32, repeats), 1, 1, 1000000, "-",
     "independent realisations, over which results are averaged", .common = true},
    {DEEP(CLAST_FIELD_CHOICE, collisions, collisions), 0, 0, 0, "-",
     "event by event, or a Poisson number of events a sub-step", "next|poisson"},
    {DEEP(CLAST_FIELD_F64, leap, leap), 0.01, 1e-6, 1.0, "-",
     "collisions of the busiest particle in a sub-step of poisson"},
    {DEEP(CLAST_FIELD_I32, block, block), 1024, 0, 1000000, "-",
     "kinds of particles above which a cell is partitioned at random into blocks; 0: never"},
    {DEEP(CLAST_FIELD_BOOL, self_collisions, self_collisions), 0, 0, 0, "-",
     "the particles of one weighted parcel collide with each other too"},
    {DEEP(CLAST_FIELD_CHOICE, out_of_range, out_of_range), 0, 0, 0, "-",
     "kernels and sticking beyond where they hold (the table above)", "error|extrapolate"},
    {DEEP(CLAST_FIELD_F64, alpha, alpha), 1.0, 0.0, 1.0, "-",
     "share of collisions that stick; with another law of sticking a factor on it",
     .group = "sticking"},
    {DEEP(CLAST_FIELD_CHOICE, sticking, sticking.law), 0, 0, 0, "-",
     "share that sticks: alpha, or by the impact: a viscous film, wet ash, elastic contacts",
     "constant|viscous|liquid|contact"},
    {DEEP(CLAST_FIELD_F64, film_viscosity, sticking.film_viscosity), 0.0, 0.0, 1e12, "Pa s",
     "viscous, liquid: of the liquid on the particles"},
    {DEEP(CLAST_FIELD_F64, film_thickness, sticking.film_thickness), 0.0, 0.0, 1.0, "m",
     "viscous: h of the film"},
    {DEEP(CLAST_FIELD_F64, asperity, sticking.asperity), 0.0, 0.0, 1.0, "m",
     "viscous: height h_a of the roughness"},
    {DEEP(CLAST_FIELD_F64, restitution, sticking.restitution), 0.0, 0.0, 1.0, "-",
     "viscous: e of the dry solids"},
    {DEEP(CLAST_FIELD_F64, critical_stokes, sticking.critical_stokes), 1.3, 0.0, 1e12, "-",
     "liquid: St_cr, where half of the collisions stick"},
    {DEEP(CLAST_FIELD_F64, stokes_exponent, sticking.stokes_exponent), 0.8, 0.0, 100.0, "-",
     "liquid: q of 1 / (1 + (St / St_cr)^q)"},
    {DEEP(CLAST_FIELD_F64, adhesion, sticking.adhesion), 0.0, 0.0, 1e6, "J/m^2",
     "contact: work of adhesion of the surfaces"},
    {DEEP(CLAST_FIELD_F64, young, sticking.young), 0.0, 0.0, 1e15, "Pa",
     "contact: Young's modulus of the particles"},
    {DEEP(CLAST_FIELD_F64, poisson, sticking.poisson), 0.25, -0.999, 0.5, "-",
     "contact: Poisson's ratio of the particles"},
    {DEEP(CLAST_FIELD_CHOICE, radius_law, radius_law), 0, 0, 0, "-",
     "collision radius of an aggregate: of the summed volume, a0 (i / k_f)^(1 / D_f), or from that "
     "law of the radius of gyration",
     "volume|fractal-collision|fractal-gyration", .group = "radii of aggregates"},
    {DEEP(CLAST_FIELD_F64, monomer_radius, monomer_radius), 0.0, 0.0, 1e300, "m",
     "radius a0 of a monomer where no column gives radii", .common = true},
    {DEEP(CLAST_FIELD_F64, fractal_dimension, fractal_dimension), 1.8, 1.0, 3.0, "-", "D_f"},
    {DEEP(CLAST_FIELD_F64, fractal_prefactor, fractal_prefactor), 1.0, 1e-3, 1e3, "-", "k_f"},
    {DEEP(CLAST_FIELD_F64, constant, medium.constant), 1e-6, 0.0, 1e300, "m^d/s",
     "K of kernel constant [m^d/s]", CLAST_KEEPS_DIMENSION, .common = true,
     .group = "kernels and fluid"},
    {DEEP(CLAST_FIELD_F64, additive, medium.additive), 1e-6, 0.0, 1e300, "m^d/s",
     "b of kernel additive [m^d/s]", CLAST_KEEPS_DIMENSION},
    {DEEP(CLAST_FIELD_F64, product, medium.product), 1e-6, 0.0, 1e300, "m^d/s",
     "c of kernel product [m^d/s]", CLAST_KEEPS_DIMENSION},
    {DEEP(CLAST_FIELD_F64, temperature, medium.temperature), 293.15, 0.0, 1e5, "K", "of the fluid"},
    {DEEP(CLAST_FIELD_F64, viscosity, medium.viscosity), 1.002e-3, 0.0, 1e6, "Pa s",
     "dynamic viscosity of the fluid"},
    {DEEP(CLAST_FIELD_F64, density, medium.density), 998.2, 0.0, 1e5, "kg/m^3", "of the fluid"},
    {DEEP(CLAST_FIELD_F64, particle_density, medium.particle_density), 0.0, 0.0, 1e5, "kg/m^3",
     "of the particles' solid"},
    {DEEP(CLAST_FIELD_F64, mean_free_path, medium.mean_free_path), 0.0, 0.0, 1.0, "m",
     "of a gas, for the slip correction; 0: none"},
    {DEEP(CLAST_FIELD_F64, shear, medium.shear), 0.0, 0.0, 1e12, "1/s", "shear rate G"},
    {DEEP(CLAST_FIELD_F64, shear_constant, medium.shear_constant), 0.0, 0.0, 100.0, "-",
     "constant of shear_turbulent, 1.3 as often printed; 0: sqrt(8 pi/15) = 1.2944"},
    {DEEP(CLAST_FIELD_F64, dissipation, medium.dissipation), 0.0, 0.0, 1e12, "m^2/s^3",
     "turbulent dissipation eps"},
    {DEEP(CLAST_FIELD_F64, speed_rms, medium.speed_rms), 0.0, 0.0, 1e6, "m/s",
     "turbulent velocity of the fluid, one component"},
    {DEEP(CLAST_FIELD_F64, gravity, medium.gravity), 9.80665, 0.0, 1e6, "m/s^2", "gravity g"},
    {DEEP(CLAST_FIELD_F64, efficiency, medium.efficiency), 0.0, 0.0, 1.0, "-",
     "collision efficiency E of settling; 0: by Stokes number and ratio of radii"},
    {DEEP(CLAST_FIELD_CHOICE, settling_law, medium.settling_law), 0, 0, 0, "-",
     "drag of settling spheres: the standard curve, or Stokes'", "standard|stokes"},
    {FIELD(CLAST_FIELD_CHOICE, rebuild), 0, 0, 0, "-",
     "when cells are made anew: at snapshots of a changed cloud, at all of them, never; but for "
     "never also when 3/4 of the particles are left",
     "changed|always|never", .group = "cells in time"},
    {FIELD(CLAST_FIELD_F64, change_level), 0.01, 1e-12, 0.5, "-",
     "false alarms of the test that finds the cloud changed"},
    {FIELD(CLAST_FIELD_I32, fixed), 0, 0, 1000, "-",
     "a regular mesh of this many cells an axis is evolved beside; 0: none"},
    {FIELD(CLAST_FIELD_F64, depth), 0.0, 0.0, 1e300, "m",
     "extent of the missing dimensions: a length in 2-D (a bare number: m), m^2 in 1-D (bare)",
     CLAST_BARE_SI},
    {0}};
#undef FIELD
#undef DEEP

clast_status clast_collide_config_default(clast_collide_config *config)
{
    CLX_ARGUMENTS(config);
    clast_agglomerate_config made = {0};
    CLX_GUARD(clast_fields_default(clast_agglomerate_fields, &made));
    *config = made.collide;
    clast_fields_free(clast_agglomerate_fields, &made);
    return CLAST_OK;
}

enum { M1, M2, M3, N_MOMENT };

/// Columns of the history, and how far it is.
typedef struct {
    const clast_monitor *monitor;
    int64_t n_done, n_to_do; ///< steps of all runs
    double *time, *n, *sd, *moment[N_MOMENT], *events, *n_cell, *rebuilt, *n_parcel;
    double *fixed_n, *fixed_events, *exact_n, *exact_m2, *gel, *gelled;
    int64_t gel_row;             ///< of this run, the first that has gelled; -1 before
    double gel_sum;              ///< of those times, over runs
    double *moment_sd[N_MOMENT]; ///< M1's is 0; sums of squares until the end
    clx_size_classes classes;
} columns;

void clast_agglomeration_free(clast_agglomeration *result)
{
    if (result == NULL) {
        return;
    }
    clast_table_free(&result->history);
    clast_table_free(&result->particles);
    clast_table_free(&result->members);
    clast_table_free(&result->spectrum);
    *result = (clast_agglomeration){0};
}

/// Columns are looked up after all are added: adding one may move the others.
static clast_status make_history(clast_agglomeration *r, int64_t n_row, bool is_weighted,
                                 columns *c)
{
    static const struct {
        const char *name, *unit;
        size_t offset;
        int when; ///< 1: fixed mesh only, 2: weights only
    } list[] = {{"time_s", "s", offsetof(columns, time), 0},
                {"n_particle", "-", offsetof(columns, n), 0},
                {"n_particle_sd", "-", offsetof(columns, sd), 0},
                {"M1", "-", offsetof(columns, moment[M1]), 0},
                {"M2", "-", offsetof(columns, moment[M2]), 0},
                {"M3", "-", offsetof(columns, moment[M3]), 0},
                {"M2_sd", "-", offsetof(columns, moment_sd[M2]), 0},
                {"M3_sd", "-", offsetof(columns, moment_sd[M3]), 0},
                {"events", "-", offsetof(columns, events), 0},
                {"n_cell", "-", offsetof(columns, n_cell), 0},
                {"is_rebuilt", "-", offsetof(columns, rebuilt), 0},
                {"gel_fraction", "-", offsetof(columns, gel), 0},
                {"gelled", "-", offsetof(columns, gelled), 0},
                {"n_parcel", "-", offsetof(columns, n_parcel), 2},
                {"fixed_n_particle", "-", offsetof(columns, fixed_n), 1},
                {"fixed_events", "-", offsetof(columns, fixed_events), 1}};
    clast_status status = CLAST_OK;
    CLX_TRY(clast_table_init(&r->history, "agglomeration", n_row));
    for (size_t k = 0; k < sizeof list / sizeof list[0]; ++k) {
        double *column = NULL;
        if (list[k].when == 0 || (list[k].when == 1 ? r->has_fixed : is_weighted)) {
            CLX_TRY(clast_table_add_number(&r->history, list[k].name, list[k].unit, &column));
        }
    }
    for (size_t k = 0; k < sizeof list / sizeof list[0]; ++k) {
        *(double **)(void *)((char *)c + list[k].offset) =
            clast_table_numbers(&r->history, list[k].name);
    }
done:
    return status;
}

/// Share of the monomers in parcels that hold more than n^(-1/3) of them each: as much as the
/// largest of a sample of n does when an infinite system gels [Aldous1999].
static double gel_of(const clast_population *p, double monomers)
{
    const double least = monomers / cbrt((double)p->n);
    double gel = 0.0;
    for (int64_t i = 0; i < p->n; ++i) {
        const double held = (double)p->monomers[i] * (p->weight != NULL ? p->weight[i] : 1.0);
        gel += held > least ? held : 0.0;
    }
    return monomers > 0.0 ? gel / monomers : 0.0;
}

static void record_gel(double share, columns *c, int64_t row)
{
    static const double GEL_SHARE = 1e-3; // as in a box
    c->gel[row] += share;
    if (c->gel_row < 0 && share >= GEL_SHARE) {
        c->gel_row = row;
    }
    c->gelled[row] += c->gel_row >= 0 ? 1.0 : 0.0;
}

/// Adds the state of a run to row `row`: sums over repeats, made means at the end.
static void record(const clx_evolution *run, columns *c, int64_t row)
{
    const clast_population *p = &run->population;
    double moment[N_MOMENT] = {0};
    double n = 0.0;
    double n_parcel = 0.0;
    for (int64_t i = 0; i < p->n; ++i) {
        const double m = (double)p->monomers[i];
        const double w = p->weight != NULL ? p->weight[i] : 1.0;
        n += m > 0.0 ? w : 0.0;
        moment[M1] += w * m;
        moment[M2] += w * m * m;
        moment[M3] += w * m * m * m;
        n_parcel += m > 0.0 ? 1.0 : 0.0;
    }
    if (run->is_fixed) {
        c->fixed_n[row] += n;
        c->fixed_events[row] += run->n_event;
        return;
    }
    c->n[row] += n;
    c->sd[row] += n * n;
    for (int k = 0; k < N_MOMENT; ++k) {
        c->moment[k][row] += moment[k];
        if (c->moment_sd[k] != NULL) {
            c->moment_sd[k][row] += moment[k] * moment[k];
        }
    }
    clx_size_classes_count(&c->classes, p, row);
    c->events[row] += run->n_event;
    if (c->n_parcel != NULL) {
        c->n_parcel[row] += n_parcel;
    }
    c->n_cell[row] += run->n_cell;
    c->rebuilt[row] += run->is_rebuilt ? 1.0 : 0.0;
    record_gel(gel_of(p, moment[M1]), c, row);
}

static clast_status one_run(clx_evolution *run, int32_t repeat, int64_t n_row, columns *c)
{
    clast_status status = CLAST_OK;
    const clast_agglomerate_config *config = run->config;
    int64_t row = 0;
    CLX_TRY(clx_evolution_begin(run));
    for (int64_t s = 0; s < run->input->n_snapshot; ++s) {
        CLX_TRY(clx_evolution_snapshot(run, s));
        if (s == 0) {
            record(run, c, row);
        }
        for (int32_t k = 0; k < config->n_step; ++k) {
            ++row;
            const uint64_t number =
                2 * ((uint64_t)repeat * (uint64_t)n_row + (uint64_t)row) + (run->is_fixed ? 1 : 0);
            CLX_CHECK(!clx_monitor_stops(c->monitor), CLAST_E_STOPPED,
                      "stopped after %lld of %lld steps; nothing is kept", (long long)c->n_done,
                      (long long)c->n_to_do);
            CLX_TRY(clx_evolution_step(run, config->duration / config->n_step, number));
            record(run, c, row);
            run->is_rebuilt = false;
            clx_monitor_report(c->monitor, "steps", ++c->n_done, c->n_to_do);
        }
    }
done:
    return status;
}

/// Standard deviation of n runs from their sum of squares and mean; 0 of one.
static double deviation(double squares, double mean, double n)
{
    return n > 1.0 ? sqrt(fmax(0.0, squares / n - mean * mean) * n / (n - 1.0)) : 0.0;
}

static void make_means(const clast_agglomerate_config *config, int64_t n_row, columns *c)
{
    const double n = config->repeats;
    double *const sums[] = {c->n,      c->moment[M1], c->moment[M2], c->moment[M3],   c->events,
                            c->n_cell, c->rebuilt,    c->fixed_n,    c->fixed_events, c->n_parcel,
                            c->gel,    c->gelled};
    for (int64_t row = 0; row < n_row; ++row) {
        c->time[row] = config->duration / config->n_step * (double)row;
        for (size_t k = 0; k < sizeof sums / sizeof sums[0]; ++k) {
            if (sums[k] != NULL) {
                sums[k][row] /= n;
            }
        }
        c->sd[row] = deviation(c->sd[row], c->n[row], n);
        for (int k = M2; k < N_MOMENT; ++k) {
            c->moment_sd[k][row] = deviation(c->moment_sd[k][row], c->moment[k][row], n);
        }
    }
}

/// Whether all parcels of a cloud stand for as many particles, for one where `is_one`.
static bool has_equal_weights(const clast_cloud *cloud, bool is_one)
{
    bool is_equal = true;
    for (int64_t i = 0; cloud->weight != NULL && i < cloud->n; ++i) {
        is_equal = is_equal && cloud->weight[i] == (is_one ? 1.0 : cloud->weight[0]);
    }
    return is_equal;
}

/// Adds the exact columns where they hold: one model kernel, one cell, single particles. Parcels
/// of more than one do not meet their own, and are fewer than what they stand for.
static clast_status add_exact(const clast_agglomerate_input *input, const clx_evolution *run,
                              clast_agglomeration *r)
{
    clast_status status = CLAST_OK;
    CLAST_ASSERT(run->mesh != NULL);
    const uint32_t kernel = run->collide.kernel;
    const clast_medium *m = &run->collide.medium;
    const double rate = kernel == 1U ? m->constant : kernel == 2U ? m->additive : m->product;
    double *column = NULL;
    const double n0 = clast_table_numbers(&r->history, "n_particle")[0];
    if (!clx_exact_counts_known(kernel, n0) || input->monomers != NULL || input->n_snapshot > 1 ||
        clast_table_numbers(&r->history, "n_cell")[0] != 1.0 || run->mesh->n_outside > 0 ||
        !has_equal_weights(&input->snapshot[0], true)) {
        return CLAST_OK;
    }
    CLX_TRY(clast_table_add_number(&r->history, "exact_n_particle", "-", &column));
    CLX_TRY(clast_table_add_number(&r->history, "exact_M2", "-", &column));
    const double *time = clast_table_numbers(&r->history, "time_s");
    double *n = clast_table_numbers(&r->history, "exact_n_particle");
    double *m2 = clast_table_numbers(&r->history, "exact_M2");
    for (int64_t row = 0; row < r->history.n_row; ++row) {
        clx_exact_counts(kernel, n0, run->collide.alpha * rate * time[row] / run->volume[0],
                         &n[row], &m2[row]);
    }
    r->has_exact = true;
done:
    return status;
}

/// Columns of the particles that are left.
enum {
    PARTICLE,
    PLACE,
    MONOMERS = PLACE + 3,
    RADIUS,
    DIAMETER,
    MASS,
    CELL,
    WEIGHT,
    VELOCITY,
    SPEED_RMS = VELOCITY + 3,
    N_COLUMN
};

static bool has_column(const clx_evolution *run, int column)
{
    const clast_population *p = &run->population;
    switch (column) {
    case PLACE + 1:
    case PLACE + 2:
        return column - PLACE < p->dimension;
    case RADIUS:
    case DIAMETER:
        return p->n > 0 && p->radius[0] > 0.0;
    case MASS:
        return run->input->snapshot[0].mass != NULL || run->collide.medium.particle_density > 0.0;
    case WEIGHT:
        return p->weight != NULL;
    case VELOCITY:
    case VELOCITY + 1:
    case VELOCITY + 2:
        return p->velocity != NULL && column - VELOCITY < p->dimension;
    case SPEED_RMS:
        return p->speed_rms != NULL;
    default:
        return true;
    }
}

/// Of a column that the run has.
static double value_of(const clx_evolution *run, int column, int64_t i)
{
    const clast_population *p = &run->population;
    const clast_collide_config *c = &run->collide;
    CLAST_ASSERT(i >= 0 && i < p->n);
    switch (column) {
    case PARTICLE:
        return (double)i;
    case MONOMERS:
        return (double)p->monomers[i];
    case RADIUS:
        return p->radius[i];
    case DIAMETER: // of equal volume: a fractal law's radius is that of its collisions
        return 2.0 * (c->radius_law == CLAST_RADIUS_VOLUME
                          ? p->radius[i]
                          : c->monomer_radius * cbrt((double)p->monomers[i]));
    case MASS:
        return p->mass[i];
    case CELL:
        return (double)run->cell[i];
    case WEIGHT:
        return p->weight[i];
    case SPEED_RMS:
        return p->speed_rms[i];
    default:
        return column < MONOMERS ? p->x[i * p->dimension + column - PLACE]
                                 : p->velocity[i * p->dimension + column - VELOCITY];
    }
}

/// What is left at the end, with all that a run needs to be gone on with.
static clast_status list_particles(const clx_evolution *run, clast_table *table)
{
    static const char *const title[N_COLUMN][2] = {{"particle", "-"},
                                                   {"x_m", "m"},
                                                   {"y_m", "m"},
                                                   {"z_m", "m"},
                                                   {"monomers", "-"},
                                                   {"radius_m", "m"},
                                                   {"diameter_m", "m"},
                                                   {"mass_kg", "kg"},
                                                   {"cell", "-"},
                                                   {"weight", "-"},
                                                   {"velocity_x_m/s", "m/s"},
                                                   {"velocity_y_m/s", "m/s"},
                                                   {"velocity_z_m/s", "m/s"},
                                                   {"speed_rms_m/s", "m/s"}};
    clast_status status = CLAST_OK;
    const clast_population *p = &run->population;
    double *column = NULL;
    int64_t n = 0;
    for (int64_t i = 0; i < p->n; ++i) {
        n += p->monomers[i] > 0 ? 1 : 0;
    }
    CLX_TRY(clast_table_init(table, "particles", n));
    for (int k = 0; k < N_COLUMN; ++k) {
        int64_t row = 0;
        if (!has_column(run, k)) {
            continue;
        }
        CLX_TRY(clast_table_add_number(table, title[k][0], title[k][1], &column));
        for (int64_t i = 0; i < p->n; ++i) {
            if (p->monomers[i] > 0) {
                column[row++] = value_of(run, k, i);
            }
        }
    }
done:
    return status;
}

/// Which of them each particle of the start is part of.
static clast_status list_members(const clast_population *p, clast_table *table)
{
    clast_status status = CLAST_OK;
    double *column = NULL;
    CLX_TRY(clast_table_init(table, "members", p->n));
    CLX_TRY(clast_table_add_number(table, "particle", "-", &column));
    for (int64_t i = 0; i < p->n; ++i) {
        column[i] = (double)i;
    }
    CLX_TRY(clast_table_add_number(table, "aggregate", "-", &column));
    for (int64_t i = 0; i < p->n; ++i) {
        column[i] = (double)clx_population_owner(p, i);
    }
done:
    return status;
}

static clast_status finish_first(const clx_evolution *run, const columns *c,
                                 clast_agglomeration *made)
{
    clast_status status = CLAST_OK;
    made->n_cell = run->n_cell;
    made->volume_fraction = run->volume_fraction;
    made->n_unresolved = run->n_unresolved;
    for (int64_t row = 0; row < made->history.n_row; ++row) {
        made->n_rebuilt += c->rebuilt[row] > 0.0 ? 1 : 0;
    }
    CLX_TRY(list_particles(run, &made->particles));
    if (has_equal_weights(&run->input->snapshot[0], false) && !run->collide.self_collisions) {
        CLX_TRY(list_members(&run->population, &made->members));
    }
done:
    return status;
}

/// The time at which a run had gelled, and whether its kernel does.
static void finish_gel(const clx_evolution *run, columns *c, clast_agglomeration *made)
{
    const clast_population *p = &run->population;
    clast_collide_config collide = run->collide;
    if (c->gel_row < 0) {
        return;
    }
    ++made->n_gelled;
    c->gel_sum += run->config->duration / run->config->n_step * (double)c->gel_row;
    int64_t at = 0; // a particle as large as any: monomers like its own are what it grows by
    for (int64_t i = 0; i < p->n; ++i) {
        at = p->monomers[i] > p->monomers[at] ? i : at;
    }
    const double monomers = (double)p->monomers[at];
    const double radius = p->radius[at];
    if (collide.radius_law == CLAST_RADIUS_VOLUME) {
        collide.monomer_radius = radius / cbrt(monomers);
    }
    if (radius > 0.0 && collide.radius_law == CLAST_RADIUS_VOLUME) {
        collide.medium.particle_density =
            p->mass[at] / (4.0 / 3.0 * CLAST_PI * radius * radius * radius);
    }
    if (run->medium != NULL && run->cell[at] >= 0) {
        const double density = collide.medium.particle_density;
        collide.medium = run->medium[run->cell[at]];
        collide.medium.particle_density = density;
    }
    made->is_gelation = made->is_gelation || clx_kernel_gels(&collide, monomers);
}

static clast_status all_runs(const clast_agglomerate_input *input,
                             const clast_agglomerate_config *config, columns *c, clx_evolution *run,
                             clast_agglomeration *made)
{
    clast_status status = CLAST_OK;
    clast_decomposition *const first = run->first;
    for (int32_t repeat = 0; repeat < config->repeats; ++repeat) {
        for (int fixed = made->has_fixed ? 1 : 0; fixed >= 0; --fixed) {
            clx_evolution_free(run);
            *run = (clx_evolution){.input = input,
                                   .config = config,
                                   .is_fixed = fixed == 1,
                                   .first = first,
                                   .range = fixed == 1 ? NULL : &made->range};
            c->gel_row = -1;
            CLX_TRY(one_run(run, repeat, made->history.n_row, c));
        }
        finish_gel(run, c, made);
        if (repeat == 0) {
            CLX_TRY(finish_first(run, c, made));
        }
    }
done:
    return status;
}

static clast_status check_arguments(const clast_agglomerate_input *input,
                                    const clast_agglomerate_config *config)
{
    clast_status status = CLAST_OK;
    static char nameless[] = "";
    clast_decompose_config decompose = config->decompose;
    if (input->domain != NULL && decompose.domain == NULL) {
        decompose.domain = nameless;
    }
    CLX_TRY(clast_fields_check(clast_agglomerate_fields, config));
    CLX_TRY(clast_fields_check(clast_decompose_fields, &decompose));
    CLX_CHECK(input->n_snapshot >= 1 && input->n_snapshot < INT32_MAX, CLAST_E_ARGUMENT,
              "%lld snapshots were given", (long long)input->n_snapshot);
    for (int64_t k = 0; k < input->n_snapshot; ++k) {
        CLX_TRY(clx_cloud_check(&input->snapshot[k]));
    }
    CLX_CHECK(input->fixed_cell == NULL || input->fixed_volume != NULL, CLAST_E_CONFIG,
              "a column of cells needs a column of their volumes");
done:
    return status;
}

/// Duplicates of an earlier particle, in the snapshot that has the most.
static clast_status count_repeated(const clast_agglomerate_input *input, int64_t *n_repeated)
{
    clast_status status = CLAST_OK;
    for (int64_t k = 0; k < input->n_snapshot; ++k) {
        int64_t n = 0;
        CLX_TRY(clast_cloud_repeated(&input->snapshot[k], &n));
        *n_repeated = n > *n_repeated ? n : *n_repeated;
    }
done:
    return status;
}

clast_status clast_agglomerate(const clast_agglomerate_input *input,
                               const clast_agglomerate_config *config, const clast_monitor *monitor,
                               clast_agglomeration *result)
{
    CLX_ARGUMENTS(input, config, result);
    CLX_FLOAT_ENVIRONMENT;
    CLX_ARRAY(input->snapshot, input->n_snapshot);
    clast_status status = CLAST_OK;
    clast_agglomeration made = {.n_snapshot = (int32_t)input->n_snapshot,
                                .range = clx_range_begin()};
    clast_decomposition first = {0};
    clx_evolution run = {.first = &first};
    columns c = {.monitor = monitor};
    CLX_TRY(check_arguments(input, config));
    const int64_t n_row = input->n_snapshot * config->n_step + 1;
    made.has_fixed = config->fixed > 0 || input->fixed_cell != NULL;
    CLX_CHECK((double)n_row * config->repeats < 0x1p31, CLAST_E_LIMIT,
              "%lld times in each of %d repeats are beyond 2^31", (long long)n_row,
              config->repeats);
    c.n_to_do = (n_row - 1) * config->repeats * (made.has_fixed ? 2 : 1);
    CLX_TRY(make_history(&made, n_row, input->snapshot[0].weight != NULL, &c));
    CLX_TRY(clx_size_classes_begin(n_row, &c.classes));
    CLX_TRY(all_runs(input, config, &c, &run, &made));
    make_means(config, n_row, &c);
    made.gel_time = made.n_gelled > 0 ? c.gel_sum / made.n_gelled : (double)NAN;
    CLX_TRY(clx_size_classes_table(&c.classes, config->repeats, c.time, &made.spectrum));
    CLX_TRY(clx_size_classes_columns(&c.classes, config->repeats, &made.history));
    CLX_TRY(add_exact(input, &run, &made));
    CLX_TRY(count_repeated(input, &made.n_repeated));
    *result = made;
    made = (clast_agglomeration){0};
done:
    clast_decomposition_free(&first);
    clx_size_classes_free(&c.classes);
    clx_evolution_free(&run);
    clast_agglomeration_free(&made);
    return status;
}
