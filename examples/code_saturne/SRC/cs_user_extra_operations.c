// SPDX-License-Identifier: BSD-3-Clause
// A solver linked with it is under the GPL as a whole: README.md.

// clast in the solver's time loop: positions and weights are read where the solver keeps them, in
// records of `extents` bytes, on one rank; on several each gathers all of them and decomposes the
// same cloud, so that each can change its own parcels without a further message.
#include "balance.h"
#include "cs_headers.h"
#include "settings.h"
#include <clast/cloud.h>
#include <clast/machine.h>
#include <clast/workspace.h>
#include <errno.h>
#include <math.h>
#ifdef HAVE_CLAST_MPI
#include <clast/mpi.h>
#endif

balance balance_in;

enum { RECORD = 8 }; // doubles of a gathered parcel: position, velocity, weight, mass

static clast_workspace *workspace;
static clast_domain domain;
static clast_decompose_config config;
#ifdef HAVE_CLAST_MPI
static clast_comm comm; // of the solver's ranks, where there are several
#endif
static FILE *table;          // events.csv, of the first rank
static double *record, *all; // packed parcels of this rank and of all
static balance before;       // present after the last step, all ranks
static double balance_out;   // left since the start by the solver's own count, all ranks [kg]
static double call_time, since;
static int n_call;

static cs_lagr_particle_set_t *parcels(void)
{
    return cs_lagr_get_particle_set();
}

static double *attribute(cs_lnum_t k, cs_lagr_attribute_t name)
{
    return cs_lagr_particles_attr(parcels(), k, name);
}

static void check(clast_status status)
{
    if (status != CLAST_OK) {
        bft_error(__FILE__, __LINE__, 0, "clast: %s", clast_error_detail());
    }
}

static balance present(void)
{
    balance sum = {0};
    for (cs_lnum_t k = 0; k < parcels()->n_particles; ++k) {
        balance_add(&sum, parcels(), k);
    }
    cs_parall_sum(3, CS_DOUBLE, &sum);
    return sum;
}

/// What calls are spared: nothing, tests and cuts where the cloud has not changed, or all but each
/// 50th test and count of pairs and each 10th cut.
static void set_policy(void)
{
    clast_workspace_policy policy;
    check(clast_fields_default(clast_workspace_fields, &policy));
    if (settings()->spare == SPARE_UNCHANGED) {
        policy.tests = CLAST_TESTS_MOVED;
        policy.cells = CLAST_CUT_CHANGED;
        policy.pairs_every = 50;
    } else if (settings()->spare == SPARE_MOST) {
        policy.tests = CLAST_TESTS_EVERY;
        policy.cells = CLAST_CUT_EVERY;
        policy.tests_every = policy.pairs_every = 50;
        policy.cells_every = 10;
    }
    check(clast_workspace_set_policy(workspace, &policy));
}

void cs_user_extra_operations_initialize(cs_domain_t *unused)
{
    CS_UNUSED(unused);
    const run_settings *s = settings();
    check(clast_domain_parse(s->domain, &domain));
    check(clast_fields_default(clast_decompose_fields, &config));
    config.beta_dt = s->kernel * s->dt * (s->task == TASK_GROW ? s->every : 1);
    config.outside = CLAST_OUTSIDE_DROP; // a parcel on a wall may lie beyond it by a rounding error
    check(clast_workspace_create(&workspace));
#ifdef HAVE_CLAST_MPI
    if (cs_glob_n_ranks > 1) {
        check(clast_mpi_create((int32_t)MPI_Comm_c2f(cs_glob_mpi_comm), &comm));
    }
#endif
    set_policy();
    if (cs_glob_rank_id < 1) {
        table = fopen("events.csv", "w");
        if (table == NULL) {
            bft_error(__FILE__, __LINE__, errno, "events.csv");
        }
        fputs(
            "step,parcels,particles,events,events_low,events_high,n_cell,resolved,per_solver_cell,"
            "own_events,stuck,own_points,mass_in,mass_out,mass_present,call_ms,step_ms\n",
            table);
    }
    since = cs_timer_cpu_time();
}

/// Parcels of all ranks; *first: the first one of this rank among them.
static int64_t count_parcels(int64_t *first)
{
    double mine = parcels()->n_particles;
    double *of_rank;
    int64_t sum = 0;
    BFT_MALLOC(of_rank, cs_glob_n_ranks, double);
    cs_parall_allgather_r(1, cs_glob_n_ranks, &mine, of_rank);
    for (int rank = 0; rank < cs_glob_n_ranks; ++rank) {
        if (rank == CS_MAX(cs_glob_rank_id, 0)) {
            *first = sum;
        }
        sum += (int64_t)of_rank[rank];
    }
    BFT_FREE(of_rank);
    return sum;
}

/// Parcels without those that the solver's own agglomeration has just appended to the set, each at
/// the very place of one that it was taken from.
static cs_lnum_t count_originals(void)
{
    const double primary =
        settings()->particle_density * CLAST_PI / 6.0 * pow(settings()->diameter, 3);
    cs_lnum_t n = parcels()->n_particles;
    while (settings()->task == TASK_OWN && n > 0 &&
           *attribute(n - 1, CS_LAGR_MASS) > 1.5 * primary) {
        --n;
    }
    return n;
}

/// The parcels as clast reads them: in place on one rank, gathered on several. *first: the first
/// one of this rank.
static clast_points points_of_all_ranks(int64_t *first)
{
    const cs_lagr_particle_set_t *set = parcels();
    const int64_t stride = (int64_t)(set->p_am->extents / sizeof(double));
    *first = 0;
    if (cs_glob_n_ranks == 1 && settings()->task != TASK_GROW) {
        const double *x = attribute(0, CS_LAGR_COORDS);
        const double *weight = attribute(0, CS_LAGR_STAT_WEIGHT);
        return (clast_points){count_originals(), 3, x, stride, 1, weight, stride};
    }
    const cs_lnum_t n = set->n_particles;
    const int64_t n_all = count_parcels(first);
    BFT_REALLOC(record, RECORD * (size_t)n + 1, double);
    BFT_REALLOC(all, RECORD * (size_t)n_all + 1, double);
    for (cs_lnum_t k = 0; k < n; ++k) {
        double *r = record + RECORD * k;
        for (int j = 0; j < 3; ++j) {
            r[j] = attribute(k, CS_LAGR_COORDS)[j];
            r[3 + j] = attribute(k, CS_LAGR_VELOCITY)[j];
        }
        r[6] = *attribute(k, CS_LAGR_STAT_WEIGHT);
        r[7] = *attribute(k, CS_LAGR_MASS);
    }
    cs_parall_allgather_r((int)(RECORD * n), (int)(RECORD * n_all), record, all);
    return (clast_points){n_all, 3, all, RECORD, 1, all + 6, RECORD};
}

/// Events by the same law, beta dt W^2 / (2 V), with the solver's own cells, which are taken as
/// uniform whatever they hold.
static double events_per_solver_cell(void)
{
    const cs_lnum_t n_cell = cs_glob_mesh->n_cells;
    double sum = 0.0;
    double *weight;
    BFT_MALLOC(weight, n_cell, double);
    for (cs_lnum_t c = 0; c < n_cell; ++c) {
        weight[c] = 0.0;
    }
    for (cs_lnum_t k = 0; k < parcels()->n_particles; ++k) {
        const cs_lnum_t c = *(cs_lnum_t *)cs_lagr_particles_attr(parcels(), k, CS_LAGR_CELL_ID);
        weight[c] += *attribute(k, CS_LAGR_STAT_WEIGHT);
    }
    for (cs_lnum_t c = 0; c < n_cell; ++c) {
        sum +=
            config.beta_dt * weight[c] * weight[c] / (2.0 * cs_glob_mesh_quantities->cell_vol[c]);
    }
    BFT_FREE(weight);
    cs_parall_sum(1, CS_DOUBLE, &sum);
    return sum;
}

/// Parcels that have become part of others leave the solver's set; the others keep their order.
static void remove_gone(void)
{
    cs_lagr_particle_set_t *set = parcels();
    const size_t extents = set->p_am->extents;
    cs_lnum_t n = 0;
    for (cs_lnum_t k = 0; k < set->n_particles; ++k) {
        if (*attribute(k, CS_LAGR_STAT_WEIGHT) > 0.0) {
            if (n < k) {
                memcpy(set->p_buffer + extents * (size_t)n, set->p_buffer + extents * (size_t)k,
                       extents);
            }
            ++n;
        }
    }
    set->n_particles = n;
}

/// What collisions have made of this rank's parcels goes back into the solver's records.
static void write_back(const clast_population *p, int64_t first)
{
    for (cs_lnum_t k = 0; k < parcels()->n_particles; ++k) {
        const int64_t i = first + k;
        const bool is_gone = p->monomers[i] == 0;
        *attribute(k, CS_LAGR_STAT_WEIGHT) = is_gone ? 0.0 : p->weight[i];
        *attribute(k, CS_LAGR_MASS) = p->mass[i];
        *attribute(k, CS_LAGR_DIAMETER) = 2.0 * p->radius[i];
        for (int j = 0; j < 3; ++j) {
            attribute(k, CS_LAGR_VELOCITY)[j] = p->velocity[3 * i + j];
        }
    }
    remove_gone();
}

static clast_population population_alloc(int64_t n)
{
    clast_population p = {.n = n, .dimension = 3};
    BFT_MALLOC(p.x, 3 * n + 1, double);
    BFT_MALLOC(p.velocity, 3 * n + 1, double);
    BFT_MALLOC(p.monomers, n + 1, int64_t);
    BFT_MALLOC(p.owner, n + 1, int64_t);
    BFT_MALLOC(p.radius, n + 1, double);
    BFT_MALLOC(p.mass, n + 1, double);
    BFT_MALLOC(p.weight, n + 1, double);
    return p;
}

static void population_free(clast_population *p)
{
    BFT_FREE(p->x);
    BFT_FREE(p->velocity);
    BFT_FREE(p->monomers);
    BFT_FREE(p->owner);
    BFT_FREE(p->radius);
    BFT_FREE(p->mass);
    BFT_FREE(p->weight);
}

/// The gathered parcels as clast_collide wants them: primary particles counted by their mass.
static clast_population population_of_records(int64_t n)
{
    const run_settings *s = settings();
    const double primary = s->particle_density * CLAST_PI / 6.0 * pow(s->diameter, 3);
    clast_population p = population_alloc(n);
    for (int64_t i = 0; i < n; ++i) {
        const double *r = all + RECORD * i;
        for (int j = 0; j < 3; ++j) {
            p.x[3 * i + j] = r[j];
            p.velocity[3 * i + j] = r[3 + j];
        }
        p.weight[i] = r[6];
        p.mass[i] = r[7];
        p.monomers[i] = (int64_t)llround(r[7] / primary);
        p.radius[i] = s->diameter / 2.0 * cbrt((double)p.monomers[i]);
        p.owner[i] = i;
    }
    return p;
}

/// Events from each rank's own points, which stay where they are: nothing is gathered. Parcels of
/// one weight w are counted as points and stand for w^2 pairs each. -1 where libclast_mpi is not
/// linked.
static double events_of_own_points(void)
{
    double events = -1.0;
#ifdef HAVE_CLAST_MPI
    const cs_lnum_t n = parcels()->n_particles;
    const double weight = settings()->weight[0];
    clast_cloud cloud = {0};
    clast_decompose_config of_points = config;
    clast_decomposition result;
    of_points.beta_dt *= weight * weight;
    check(clast_cloud_alloc(n, 3, &cloud));
    for (cs_lnum_t k = 0; k < n; ++k) {
        memcpy(cloud.x + 3 * k, attribute(k, CS_LAGR_COORDS), 3 * sizeof(double));
    }
    check(clast_decompose_ranks(cs_glob_n_ranks > 1 ? &comm : NULL, &domain, &cloud, &of_points,
                                &result));
    events = result.events;
    clast_decomposition_free(&result);
    clast_cloud_free(&cloud);
#endif
    return events;
}

/// Collisions of the time since the last call in clast's cells, whose volumes are corrected for the
/// pairs that they hide by being taken as uniform. Returns the real particles that stuck to others.
static double grow(const clast_decomposition *cells, int64_t n, int64_t first)
{
    const run_settings *s = settings();
    const int32_t n_cell = cells->cells.n;
    clast_collide_config collide;
    check(clast_collide_config_default(&collide));
    check(clast_kernel_parse("constant", &collide.kernel));
    collide.medium.constant = s->kernel;
    collide.self_collisions = true;
    collide.keep_positions = true;
    collide.seed = 1;
    clast_population p = population_of_records(n);
    double *volume, *events, stuck = 0.0;
    BFT_MALLOC(volume, n_cell + 1, double);
    BFT_MALLOC(events, n_cell + 1, double);
    for (int32_t c = 0; c < n_cell; ++c) {
        volume[c] = cells->cells.volume[c] * (1.0 + cells->smoothing_bias);
    }
    const clast_collide_cells in = {
        .n = n_cell, .of_particle = cells->cells.of_point, .volume = volume, .events = events};
    const clast_workspace_step step = {s->dt * s->every, (uint64_t)cs_glob_time_step->nt_cur};
    check(clast_workspace_collide(workspace, &p, &in, step, &collide, NULL));
    for (int32_t c = 0; c < n_cell; ++c) {
        stuck += events[c];
    }
    write_back(&p, first);
    population_free(&p);
    BFT_FREE(volume);
    BFT_FREE(events);
    return stuck;
}

/// Real particles that the solver's own agglomeration has merged in this step: it counts them
/// nowhere, but each takes one from the sum of the weights.
static double own_events(const balance *now)
{
    const cs_lagr_particle_counter_t *counter = cs_lagr_update_particle_counter();
    return before.weight + counter->w_new - counter->w_exit - now->weight;
}

/// Mass that has left in this step, by the solver's own count at the outlet, where it is negative.
static double mass_that_left(void)
{
    const cs_lagr_zone_data_t *conditions = cs_lagr_get_boundary_conditions();
    double mass = conditions->particle_flow_rate[cs_boundary_zone_by_name("outlet")->id];
    cs_parall_sum(1, CS_DOUBLE, &mass);
    return -mass;
}

/// Decomposes, counts or lets collide, and writes a row of events.csv. Times are of this rank's
/// CPU.
static balance call_clast(double own, double step_time)
{
    int64_t first;
    const clast_decomposition *cells;
    const double per_cell = events_per_solver_cell();
    const double begin = cs_timer_cpu_time();
    const clast_points points = points_of_all_ranks(&first);
    check(clast_workspace_decompose_in(workspace, &domain, &points, &config, &cells));
    const double stuck = settings()->task == TASK_GROW ? grow(cells, points.n, first) : 0.0;
    const double took = cs_timer_cpu_time() - begin;
    const double own_points = settings()->task == TASK_RANKS ? events_of_own_points() : 0.0;
    const balance now = present();
    balance in = balance_in;
    cs_parall_sum(3, CS_DOUBLE, &in);
    call_time += took;
    n_call += 1;
    if (table != NULL) {
        fprintf(table,
                "%d,%.0f,%.17g,%.17g,%.17g,%.17g,%d,%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%."
                "3f,%.3f\n",
                cs_glob_time_step->nt_cur, now.parcels, now.weight, cells->events,
                cells->events_low, cells->events_high, cells->cells.n, cells->resolved, per_cell,
                own, stuck, own_points, in.mass, balance_out, now.mass, 1e3 * took,
                1e3 * step_time);
    }
    return now;
}

void cs_user_extra_operations(cs_domain_t *unused)
{
    CS_UNUSED(unused);
    const run_settings *s = settings();
    const double begin = cs_timer_cpu_time();
    const int step = cs_glob_time_step->nt_cur;
    balance now = present();
    const double own = s->task == TASK_OWN ? own_events(&now) : 0.0;
    balance_out += mass_that_left();
    if (step % s->every == 0 && now.parcels > 0.0 && s->task != TASK_SNAPSHOT) {
        now = call_clast(own, begin - since);
    }
    before = now;
    since = cs_timer_cpu_time();
}

/// The parcels of the last step: position, weight and the volume of the solver's cell.
static void write_snapshot(void)
{
    FILE *file = fopen("parcels.csv", "w");
    if (file == NULL) {
        bft_error(__FILE__, __LINE__, errno, "parcels.csv");
    }
    fputs("x_m,y_m,z_m,weight,cell,cell_volume\n", file);
    for (cs_lnum_t k = 0; k < parcels()->n_particles; ++k) {
        const double *x = attribute(k, CS_LAGR_COORDS);
        const cs_lnum_t c = *(cs_lnum_t *)cs_lagr_particles_attr(parcels(), k, CS_LAGR_CELL_ID);
        fprintf(file, "%.9g,%.9g,%.9g,%.9g,%d,%.9g\n", x[0], x[1], x[2],
                *attribute(k, CS_LAGR_STAT_WEIGHT), (int)c, cs_glob_mesh_quantities->cell_vol[c]);
    }
    fclose(file);
}

void cs_user_extra_operations_finalize(cs_domain_t *unused)
{
    CS_UNUSED(unused);
    if (settings()->task == TASK_SNAPSHOT) {
        write_snapshot();
    }
    if (table != NULL) {
        fclose(table);
    }
    bft_printf("clast: %d calls, %.3f ms each\n", n_call,
               n_call > 0 ? 1e3 * call_time / n_call : 0.0);
#ifdef HAVE_CLAST_MPI
    clast_mpi_destroy(&comm);
#endif
    clast_workspace_destroy(workspace);
    clast_fields_free(clast_decompose_fields, &config);
    BFT_FREE(record);
    BFT_FREE(all);
}
