// A run: population, mesh, fields of cells, steps. [docs/theory/agglomeration.md]
#include "cloud/agglomerate.h"

#include "base/alloc.h"
#include "cloud/collide.h"
#include "cloud/kernel_range.h"
#include "cloud/repeated.h"
#include "cloud/surface.h"
#include "geom/cut_volume.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

void clx_evolution_free(clx_evolution *r)
{
    CLX_FREE(r->population.x, r->population.monomers, r->population.radius, r->population.mass,
             r->population.velocity, r->population.speed_rms, r->population.owner,
             r->population.weight);
    clast_decomposition_free(&r->later);
    CLX_FREE(r->x_at_mesh, r->cell, r->volume, r->medium);
    *r = (clx_evolution){0};
}

/// Refuses values that no particle has; `column` [n_snapshot][n] may be NULL.
static clast_status check_column(const double *column, int64_t n_snapshot, int64_t n,
                                 const char *name, bool is_whole)
{
    clast_status status = CLAST_OK;
    char where[40] = "";
    for (int64_t i = 0; i < n_snapshot * n && column != NULL; ++i) {
        if (i >= n) {
            (void)snprintf(where, sizeof where, " in snapshot %lld", (long long)(i / n) + 1);
        }
        CLX_CHECK(column[i] > 0.0 && isfinite(column[i]) &&
                      (!is_whole || (column[i] == floor(column[i]) && column[i] < 0x1p52)),
                  CLAST_E_FORMAT, "the %s of particle %lld%s is %g; it must be a %s", name,
                  (long long)(i % n) + 1, where, column[i],
                  is_whole ? "whole number > 0 and below 2^52" : "number > 0");
    }
done:
    return status;
}

/// Positions and velocities of all snapshots; `number` counts them from 1.
static clast_status check_motion(const clast_cloud *cloud, long long number)
{
    clast_status status = CLAST_OK;
    const int64_t n = cloud->n * cloud->dimension;
    for (int64_t i = 0; i < n; ++i) {
        CLX_CHECK(isfinite(cloud->x[i]), CLAST_E_FORMAT,
                  "particle %lld has a coordinate that is not finite in snapshot %lld",
                  (long long)(i / cloud->dimension + 1), number);
        CLX_CHECK(cloud->velocity == NULL || isfinite(cloud->velocity[i]), CLAST_E_FORMAT,
                  "particle %lld has a velocity that is not finite in snapshot %lld",
                  (long long)(i / cloud->dimension + 1), number);
    }
done:
    return status;
}

static clast_status check_input(const clx_evolution *r)
{
    clast_status status = CLAST_OK;
    const clast_agglomerate_input *in = r->input;
    const clast_cloud *cloud = &in->snapshot[0];
    const int64_t n = cloud->n;
    for (int64_t k = 1; k < in->n_snapshot; ++k) {
        CLX_CHECK(in->snapshot[k].n == n && in->snapshot[k].dimension == cloud->dimension,
                  CLAST_E_FORMAT,
                  "snapshot %lld has %lld particles in %d dimensions, the first has %lld in %d; "
                  "every snapshot must list the same particles in the same order",
                  (long long)k + 1, (long long)in->snapshot[k].n, in->snapshot[k].dimension,
                  (long long)n, cloud->dimension);
    }
    for (int64_t k = 0; k < in->n_snapshot; ++k) {
        CLX_TRY(check_motion(&in->snapshot[k], (long long)k + 1));
    }
    CLX_TRY(check_column(cloud->radius, 1, n, "radius", false));
    CLX_TRY(check_column(cloud->mass, 1, n, "mass", false));
    CLX_TRY(check_column(in->monomers, 1, n, "number of monomers", true));
    CLX_TRY(check_column(in->speed_rms, in->n_snapshot, n, "speed_rms", false));
    CLX_TRY(check_column(in->temperature, in->n_snapshot, n, "temperature", false));
    CLX_TRY(check_column(in->shear, in->n_snapshot, n, "shear", false));
    CLX_TRY(check_column(in->dissipation, in->n_snapshot, n, "dissipation", false));
    CLX_TRY(check_column(cloud->weight, 1, n, "weight", false));
done:
    return status;
}

static clast_status check_needs(const clx_evolution *r)
{
    clast_status status = CLAST_OK;
    const clast_collide_config *c = &r->collide;
    const clast_cloud *cloud = &r->input->snapshot[0];
    const uint32_t needs = clx_collide_needs(c);
    const bool is_fractal = c->radius_law != CLAST_RADIUS_VOLUME;
    CLX_TRY(clx_medium_check_dimension(&c->medium, r->config->depth > 0.0 ? 3 : cloud->dimension));
    CLX_CHECK(!(is_fractal && cloud->radius != NULL), CLAST_E_CONFIG,
              "fractal radii follow from the numbers of monomers: leave the radius column out");
    CLX_CHECK((needs & CLAST_NEEDS_RADIUS) == 0 || cloud->radius != NULL || c->monomer_radius > 0.0,
              CLAST_E_CONFIG, "kernel %s needs radii: a radius column or --monomer-radius",
              r->config->kernel);
    CLX_CHECK(!is_fractal || c->monomer_radius > 0.0, CLAST_E_CONFIG,
              "fractal radii need --monomer-radius");
    CLX_CHECK((needs & CLAST_NEEDS_MASS) == 0 || cloud->mass != NULL ||
                  c->medium.particle_density > 0.0,
              CLAST_E_CONFIG, "kernel %s needs masses: a mass column or --particle-density",
              r->config->kernel);
    CLX_CHECK((needs & CLAST_NEEDS_SPEED_RMS) == 0 || r->input->speed_rms != NULL ||
                  c->medium.speed_rms > 0.0,
              CLAST_E_CONFIG, "kernel %s needs a speed_rms column or --speed-rms",
              r->config->kernel);
    CLX_CHECK((needs & CLAST_NEEDS_VELOCITY) == 0 || cloud->velocity != NULL, CLAST_E_CONFIG,
              "kernel %s needs velocity columns", r->config->kernel);
    for (int k = 0; k < CLAST_N_KERNEL; ++k) {
        CLX_CHECK((c->kernel >> k & 1U) == 0 || clast_kernel_table()[k].is_model ||
                      cloud->dimension == 3 || r->config->depth > 0.0,
                  CLAST_E_CONFIG,
                  "kernel %s is a volume per time, the cloud has %d dimensions: give the extent "
                  "of the missing ones with --depth",
                  clast_kernel_table()[k].name, cloud->dimension);
    }
done:
    return status;
}

static double first_radius(const clx_evolution *r, int64_t i)
{
    CLAST_ASSERT(i >= 0 && i < r->population.n);
    const clast_collide_config *c = &r->collide;
    const double n = (double)r->population.monomers[i];
    if (r->input->snapshot[0].radius != NULL) {
        return r->input->snapshot[0].radius[i];
    }
    return clx_aggregate_radius(c, n);
}

/// From a column, or solid volume times density; in monomers where no kernel looks at masses.
static double first_mass(const clx_evolution *r, int64_t i)
{
    const clast_collide_config *c = &r->collide;
    const double density = c->medium.particle_density;
    const double n = (double)r->population.monomers[i];
    if (r->input->snapshot[0].mass != NULL) {
        return r->input->snapshot[0].mass[i];
    }
    const double a = r->input->snapshot[0].radius != NULL ? r->input->snapshot[0].radius[i]
                                                          : c->monomer_radius * cbrt(n);
    return a > 0.0 && density > 0.0 ? 4.0 / 3.0 * CLAST_PI * a * a * a * density : n;
}

static clast_status make_population(clx_evolution *r)
{
    clast_status status = CLAST_OK;
    const clast_cloud *cloud = &r->input->snapshot[0];
    clast_population *p = &r->population;
    const int64_t n = cloud->n;
    const int32_t d = cloud->dimension;
    p->n = n;
    p->dimension = d;
    CLX_TRY(clx_alloc(&p->x, n * d, sizeof *p->x));
    CLX_TRY(clx_alloc(&p->monomers, n, sizeof *p->monomers));
    CLX_TRY(clx_alloc(&p->radius, n, sizeof *p->radius));
    CLX_TRY(clx_alloc(&p->mass, n, sizeof *p->mass));
    CLX_TRY(clx_alloc(&p->owner, n, sizeof *p->owner));
    if (cloud->velocity != NULL) {
        CLX_TRY(clx_alloc(&p->velocity, n * d, sizeof *p->velocity));
        memcpy(p->velocity, cloud->velocity, (size_t)(n * d) * sizeof *p->velocity);
    }
    if (cloud->weight != NULL) {
        CLX_TRY(clx_alloc(&p->weight, n, sizeof *p->weight));
        memcpy(p->weight, cloud->weight, (size_t)n * sizeof *p->weight);
    }
    if (r->input->speed_rms != NULL) {
        CLX_TRY(clx_alloc(&p->speed_rms, n, sizeof *p->speed_rms));
        memcpy(p->speed_rms, r->input->speed_rms, (size_t)n * sizeof *p->speed_rms);
    }
    memcpy(p->x, cloud->x, (size_t)(n * d) * sizeof *p->x);
    for (int64_t i = 0; i < n; ++i) {
        p->monomers[i] = r->input->monomers != NULL ? (int64_t)r->input->monomers[i] : 1;
        p->radius[i] = first_radius(r, i);
        p->mass[i] = first_mass(r, i);
        p->owner[i] = i;
    }
done:
    return status;
}

/// Share of the domain that spheres of the collision radii fill.
static double volume_fraction(const clx_evolution *r)
{
    const clast_population *p = &r->population;
    const double depth = p->dimension == 3 ? 1.0 : r->config->depth;
    double sum = 0.0;
    for (int64_t i = 0; i < p->n; ++i) {
        const double a = p->radius[i];
        sum += (p->weight != NULL ? p->weight[i] : 1.0) * 4.0 / 3.0 * CLAST_PI * a * a * a;
    }
    return sum > 0.0 && depth > 0.0 ? sum / (clast_domain_volume(&r->domain) * depth) : (double)NAN;
}

/// The particles of a cell at the start against the ranges.
static clast_status look_at_start(clx_evolution *r)
{
    const uint32_t rows = clx_ranges_of_one(clx_ranges_of(&r->collide));
    const clast_population *p = &r->population;
    for (int64_t i = 0; i < p->n && rows != 0; ++i) {
        const clast_medium *medium =
            r->medium != NULL && r->cell[i] >= 0 ? &r->medium[r->cell[i]] : &r->collide.medium;
        const clast_collider one = clx_population_collider(p, i);
        const clast_collider pair[2] = {one, one};
        if (r->cell[i] >= 0) {
            clx_range_add(rows, &r->collide, medium, pair, p->weight != NULL ? p->weight[i] : 1.0,
                          &r->range->start);
        }
    }
    return clx_range_start(&r->config->collide, r->range);
}

clast_status clx_evolution_begin(clx_evolution *r)
{
    clast_status status = CLAST_OK;
    const clast_cloud *cloud = &r->input->snapshot[0];
    r->collide = r->config->collide;
    r->collide.seed = r->config->decompose.seed;
    r->collide.count_unit = 0.0; // no key sets it
    r->collide.keep_positions = r->input->n_snapshot > 1;
    r->collide.out_of_range = CLAST_OUT_OF_RANGE_EXTRAPOLATE; // the run holds it against them
    CLX_TRY(clast_kernel_parse(r->config->kernel, &r->collide.kernel));
    if (r->input->domain != NULL) {
        r->domain = *r->input->domain;
    } else {
        CLX_TRY(clast_domain_parse(r->config->decompose.domain, &r->domain));
    }
    CLX_TRY(check_input(r));
    CLX_TRY(check_needs(r));
    CLX_TRY(make_population(r));
    r->volume_fraction = volume_fraction(r);
    CLX_TRY(clx_alloc(&r->cell, cloud->n, sizeof *r->cell));
    CLX_TRY(clx_alloc(&r->x_at_mesh, cloud->n * cloud->dimension, sizeof *r->x_at_mesh));
done:
    return status;
}

/// Live particles as a cloud of their own; number [cloud->n] tells which they are.
static clast_status gather_live(const clx_evolution *r, clast_cloud *cloud, int64_t *number)
{
    clast_status status = CLAST_OK;
    const clast_population *p = &r->population;
    const double *variable = r->input->snapshot[r->at].variable;
    int64_t n = 0;
    CLX_TRY(clast_cloud_alloc(p->n, p->dimension, cloud));
    if (variable != NULL) {
        CLX_TRY(clx_alloc(&cloud->variable, p->n, sizeof *variable));
    }
    if (p->weight != NULL) {
        CLX_TRY(clx_alloc(&cloud->weight, p->n, sizeof *p->weight));
    }
    for (int64_t i = 0; i < p->n; ++i) {
        if (p->monomers[i] > 0) {
            memcpy(cloud->x + n * p->dimension, p->x + i * p->dimension,
                   (size_t)p->dimension * sizeof *p->x);
            if (variable != NULL) {
                cloud->variable[n] = variable[i];
            }
            if (p->weight != NULL) {
                cloud->weight[n] = p->weight[i];
            }
            number[n++] = i;
        }
    }
    cloud->n = n;
done:
    return status;
}

static double count_real(const clast_population *p)
{
    double n = 0.0;
    for (int64_t i = 0; i < p->n; ++i) {
        n += p->monomers[i] == 0 ? 0.0 : p->weight != NULL ? p->weight[i] : 1.0;
    }
    return n;
}

static clast_status make_mesh(clx_evolution *r)
{
    clast_status status = CLAST_OK;
    const bool is_first = r->mesh == NULL;
    clast_decomposition *mesh = is_first ? r->first : &r->later;
    clast_cloud live = {0};
    int64_t *number = NULL;
    clast_decompose_config config = r->config->decompose;
    config.beta_dt = 0.0; // no cap binds
    CLX_TRY(clx_alloc(&number, r->population.n, sizeof *number));
    CLX_TRY(gather_live(r, &live, number));
    if (!is_first || mesh->cells.n == 0) {
        clast_decomposition_free(mesh);
        CLX_TRY(clast_decompose_in(&r->domain, &live, &config, mesh));
    }
    for (int64_t i = 0; i < r->population.n; ++i) {
        r->cell[i] = -1;
    }
    for (int64_t i = 0; i < live.n; ++i) {
        r->cell[number[i]] = mesh->cells.of_point[i];
    }
    r->n_at_mesh = count_real(&r->population);
    memcpy(r->x_at_mesh, r->population.x,
           (size_t)(r->population.n * r->population.dimension) * sizeof *r->x_at_mesh);
    r->mesh = mesh;
done:
    clast_cloud_free(&live);
    clx_free(number);
    return status;
}

/// Whether live particles lie otherwise than when the mesh was made.
static clast_status has_changed(const clx_evolution *r, bool *changed)
{
    clast_status status = CLAST_OK;
    const clast_population *p = &r->population;
    const int32_t d = p->dimension;
    double *u = NULL;
    int64_t n = 0;
    double chance = 1.0;
    CLX_TRY(clx_alloc(&u, 2 * p->n * d, sizeof *u));
    for (int64_t i = 0; i < p->n; ++i) {
        double was[3];
        double is[3];
        if (p->monomers[i] > 0 && clast_domain_map(&r->domain, r->x_at_mesh + i * d, was) &&
            clast_domain_map(&r->domain, p->x + i * d, is)) {
            memcpy(u + n * d, was, (size_t)d * sizeof *u);
            memcpy(u + (p->n + n) * d, is, (size_t)d * sizeof *u);
            ++n;
        }
    }
    CLX_TRY(clast_agglomeration_change_test(u, u + p->n * d, n, d, &chance));
    *changed = chance < r->config->change_level;
done:
    clx_free(u);
    return status;
}

static void locate(clx_evolution *r)
{
    const clast_population *p = &r->population;
    for (int64_t i = 0; i < p->n; ++i) {
        r->cell[i] = p->monomers[i] > 0
                         ? clast_cells_locate(&r->mesh->cells, &r->domain, p->x + i * p->dimension)
                         : -1;
    }
}

/// Of the missing dimensions too.
static void deepen(clx_evolution *r)
{
    const double depth = r->config->depth > 0.0 ? r->config->depth : 1.0;
    for (int32_t c = 0; c < r->n_cell; ++c) {
        r->volume[c] *= depth;
    }
}

/// Volumes of m bins an axis; of a mesh domain's bins the part inside, and any for those outside.
static clast_status regular_volumes(const clast_domain *domain, int32_t m, int32_t n_cell,
                                    double *volume)
{
    clast_status status = CLAST_OK;
    double bin = clast_domain_volume(domain) / n_cell;
    if (domain->kind == CLAST_DOMAIN_MESH) {
        clx_cut_grid grid = {.nb = {m, m, m}};
        memcpy(grid.low, domain->low, sizeof grid.low);
        memcpy(grid.high, domain->high, sizeof grid.high);
        CLX_TRY(clx_cut_grid_shares(&domain->surface->mesh, &grid, volume));
        bin = 1.0 / n_cell;
        for (int k = 0; k < 3; ++k) {
            bin *= domain->high[k] - domain->low[k];
        }
    }
    for (int32_t c = 0; c < n_cell; ++c) {
        const double share = domain->kind == CLAST_DOMAIN_MESH ? volume[c] : 1.0;
        volume[c] = share > 0.0 ? share * bin : bin;
    }
done:
    return status;
}

/// The user's regular mesh.
static clast_status fixed_regular(clx_evolution *r)
{
    clast_status status = CLAST_OK;
    const clast_population *p = &r->population;
    const int32_t m = r->config->fixed;
    int32_t n_cell = 1;
    for (int32_t j = 0; j < p->dimension; ++j) {
        n_cell *= m;
    }
    clx_free(r->volume);
    r->volume = NULL;
    CLX_TRY(clx_alloc(&r->volume, n_cell, sizeof *r->volume));
    CLX_TRY(regular_volumes(&r->domain, m, n_cell, r->volume));
    for (int64_t i = 0; i < p->n; ++i) {
        double u[3];
        int32_t cell = 0;
        if (!clast_domain_map(&r->domain, p->x + i * p->dimension, u)) {
            r->cell[i] = -1;
            continue;
        }
        for (int32_t j = 0; j < p->dimension; ++j) {
            const int32_t at = (int32_t)(u[j] * m);
            cell = cell * m + (at < m ? at : m - 1);
        }
        r->cell[i] = cell;
    }
    r->n_cell = n_cell;
    deepen(r);
done:
    return status;
}

/// The user's mesh by cell numbers and volumes of cells.
static clast_status fixed_columns(clx_evolution *r)
{
    clast_status status = CLAST_OK;
    const clast_agglomerate_input *in = r->input;
    double most = -1.0;
    for (int64_t i = 0; i < r->population.n; ++i) {
        CLX_CHECK(in->fixed_cell[i] == floor(in->fixed_cell[i]) && in->fixed_cell[i] < 0x1p30,
                  CLAST_E_FORMAT, "the cell of particle %lld is %g; it must be a whole number",
                  (long long)i + 1, in->fixed_cell[i]);
        most = fmax(most, in->fixed_cell[i]);
    }
    r->n_cell = (int32_t)most + 1;
    CLX_TRY(clx_alloc(&r->volume, r->n_cell, sizeof *r->volume));
    for (int64_t i = 0; i < r->population.n; ++i) {
        r->cell[i] = (int32_t)fmax(-1.0, in->fixed_cell[i]);
        double *volume = r->cell[i] >= 0 ? &r->volume[r->cell[i]] : NULL;
        CLX_CHECK(volume == NULL || *volume == 0.0 || *volume == in->fixed_volume[i],
                  CLAST_E_FORMAT, "cell %d has the volumes %g and %g", r->cell[i], *volume,
                  in->fixed_volume[i]);
        if (volume != NULL) {
            *volume = in->fixed_volume[i];
            CLX_CHECK(*volume > 0.0 && isfinite(*volume), CLAST_E_FORMAT,
                      "the cell volume of particle %lld is %g", (long long)i + 1, *volume);
        }
    }
    for (int32_t c = 0; c < r->n_cell; ++c) { // numbers that no particle has
        r->volume[c] = r->volume[c] > 0.0 ? r->volume[c] : 1.0;
    }
    deepen(r);
done:
    return status;
}

/// Volumes in which pairs meet as often as the extrapolated events say.
static clast_status take_volumes(clx_evolution *r)
{
    clast_status status = CLAST_OK;
    clx_free(r->volume);
    r->volume = NULL;
    r->n_cell = r->mesh->cells.n;
    CLX_TRY(clx_alloc(&r->volume, r->n_cell, sizeof *r->volume));
    const double share = 1.0 + r->mesh->smoothing_bias;
    for (int32_t c = 0; c < r->n_cell; ++c) {
        r->volume[c] = share * r->mesh->cells.volume[c];
    }
    deepen(r);
done:
    return status;
}

typedef struct {
    const double *column;
    size_t offset; ///< in clast_medium
} field_column;

/// This snapshot's values of a column.
static const double *at_snapshot(const clx_evolution *r, const double *column)
{
    return column != NULL ? column + r->at * r->population.n : NULL;
}

/// Mean of the field columns over the live particles of each cell.
static clast_status fill_media(clx_evolution *r)
{
    clast_status status = CLAST_OK;
    const clast_population *p = &r->population;
    const field_column columns[3] = {
        {at_snapshot(r, r->input->temperature), offsetof(clast_medium, temperature)},
        {at_snapshot(r, r->input->shear), offsetof(clast_medium, shear)},
        {at_snapshot(r, r->input->dissipation), offsetof(clast_medium, dissipation)}};
    double *sum = NULL;
    int64_t *n = NULL;
    if (columns[0].column == NULL && columns[1].column == NULL && columns[2].column == NULL) {
        return CLAST_OK;
    }
    clx_free(r->medium);
    r->medium = NULL;
    CLX_TRY(clx_alloc(&r->medium, r->n_cell, sizeof *r->medium));
    CLX_TRY(clx_alloc(&sum, 3 * (int64_t)r->n_cell, sizeof *sum));
    CLX_TRY(clx_alloc(&n, r->n_cell, sizeof *n));
    for (int64_t i = 0; i < p->n; ++i) {
        const int32_t c = r->cell[i];
        if (p->monomers[i] == 0 || c < 0) {
            continue;
        }
        ++n[c];
        for (int k = 0; k < 3; ++k) {
            sum[3 * c + k] += columns[k].column != NULL ? columns[k].column[i] : 0.0;
        }
    }
    for (int32_t c = 0; c < r->n_cell; ++c) {
        r->medium[c] = r->collide.medium;
        for (int k = 0; k < 3; ++k) {
            double *value = (double *)((char *)&r->medium[c] + columns[k].offset);
            if (columns[k].column != NULL) { // a cell without particles: any value that fits
                *value = n[c] > 0 ? sum[3 * c + k] / (double)n[c] : columns[k].column[0];
            }
        }
    }
done:
    CLX_FREE(sum, n);
    return status;
}

static void move_to(clx_evolution *r, const clast_cloud *snapshot)
{
    clast_population *p = &r->population;
    const size_t size = (size_t)p->dimension * sizeof *p->x;
    const double *speed_rms = at_snapshot(r, r->input->speed_rms);
    for (int64_t i = 0; i < p->n; ++i) {
        memcpy(p->x + i * p->dimension, snapshot->x + i * p->dimension, size);
        if (p->velocity != NULL && snapshot->velocity != NULL) {
            memcpy(p->velocity + i * p->dimension, snapshot->velocity + i * p->dimension, size);
        }
        if (speed_rms != NULL) {
            p->speed_rms[i] = speed_rms[i];
        }
    }
}

static clast_status bring_mesh(clx_evolution *r, bool is_new)
{
    clast_status status = CLAST_OK;
    r->is_rebuilt = is_new && r->mesh != NULL;
    if (is_new) {
        CLX_TRY(make_mesh(r));
    } else {
        locate(r);
    }
    CLX_TRY(take_volumes(r));
done:
    return status;
}

/// Whether three quarters of the particles are left that several cells were made of: cells empty at
/// their own pace, and what is alone in its cell meets nobody, for all that is near it in the next
/// one. Parcels keep their number while their weights shrink, so it is weights that count.
static bool is_thinned(const clx_evolution *r)
{
    return r->config->rebuild != CLAST_REBUILD_NEVER && r->mesh->cells.n > 1 &&
           4.0 * count_real(&r->population) <= 3.0 * r->n_at_mesh;
}

/// Refuses places that a file brings and no density has. Those of aggregates are not asked: on a
/// lattice two of them may well come to lie at one place.
static clast_status check_places(const clx_evolution *r)
{
    char of[40];
    (void)snprintf(of, sizeof of, "snapshot %lld", (long long)r->at + 1);
    return clx_repeated_check(r->mesh, &r->input->snapshot[r->at], of);
}

clast_status clx_evolution_snapshot(clx_evolution *r, int64_t snapshot)
{
    clast_status status = CLAST_OK;
    bool is_new = snapshot == 0 || r->config->rebuild == CLAST_REBUILD_ALWAYS;
    r->at = snapshot;
    if (snapshot > 0) {
        move_to(r, &r->input->snapshot[snapshot]);
    }
    if (!r->is_fixed) {
        if (!is_new && r->config->rebuild == CLAST_REBUILD_CHANGED) {
            CLX_TRY(has_changed(r, &is_new));
        }
        CLX_TRY(bring_mesh(r, is_new));
        if (is_new) {
            CLX_TRY(check_places(r));
        }
        r->n_unresolved += is_new && !r->mesh->resolved ? 1 : 0;
    } else if (r->config->fixed > 0) {
        CLX_TRY(fixed_regular(r));
    } else if (snapshot == 0) {
        CLX_TRY(fixed_columns(r));
    }
done:
    return status;
}

clast_status clx_evolution_step(clx_evolution *r, double dt, uint64_t number)
{
    clast_status status = CLAST_OK;
    double *events = NULL;
    if (!r->is_fixed && is_thinned(r)) {
        CLX_TRY(bring_mesh(r, true));
    }
    CLX_TRY(fill_media(r));
    if (r->range != NULL && r->time == 0.0) {
        CLX_TRY(look_at_start(r));
    }
    CLX_TRY(clx_alloc(&events, r->n_cell, sizeof *events));
    const clast_collide_cells cells = {.n = r->n_cell,
                                       .of_particle = r->cell,
                                       .volume = r->volume,
                                       .medium = r->medium,
                                       .events = events,
                                       .range = r->range != NULL ? &r->range->collisions : NULL};
    CLX_TRY(clast_collide(&r->population, &cells, dt, number, &r->collide, NULL));
    for (int32_t c = 0; c < r->n_cell; ++c) {
        r->n_event += events[c];
    }
    r->time += dt;
    if (r->range != NULL) {
        CLX_TRY(clx_range_up_to(&r->config->collide, r->time, r->range));
    }
done:
    clx_free(events);
    return status;
}
