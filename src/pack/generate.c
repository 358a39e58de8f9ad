// Grains of a fill: what they are (a function of seed and number alone) and where they begin.
#include "base/alloc.h"
#include "math/rng.h"
#include "math/vec3.h"
#include "pack/pack.h"
#include <clast/form_law.h>
#include <clast/reform.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/// Sieve size of eq. 1, or the volume-equivalent diameter.
static double size_of(const clast_shape *shape, int32_t meaning)
{
    const double *s = shape->semi_axes;
    return meaning == 0 ? sqrt(2.0 * (s[1] * s[1] + s[2] * s[2]))
                        : cbrt(6.0 * shape->volume / CLAST_PI);
}

static clast_status prepare_weights(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_f64_list *w = &p->config.shape_weight;
    double sum = 0.0;
    CLX_CHECK(p->input.n_shape > 0, CLAST_E_CONFIG, "a packing needs a shape");
    CLX_CHECK(w->n == 0 || w->n == p->input.n_shape, CLAST_E_CONFIG,
              "%d weights for %d shapes (shape_weight)", w->n, p->input.n_shape);
    CLX_TRY(clx_alloc(&p->weight, p->input.n_shape, sizeof *p->weight));
    for (int32_t i = 0; i < p->input.n_shape; ++i) {
        sum += w->n > 0 ? w->item[i] : 1.0;
        p->weight[i] = sum;
    }
    CLX_CHECK(sum > 0.0, CLAST_E_CONFIG, "all weights are 0 (shape_weight)");
    for (int32_t i = 0; i < p->input.n_shape; ++i) {
        p->weight[i] /= sum;
    }
done:
    return status;
}

static clast_form_law law_of(const clast_pack_config *c)
{
    return (clast_form_law){.flatness_mean = c->flatness_mean,
                            .flatness_deviation = c->flatness_deviation,
                            .elongation_mean = c->elongation_mean,
                            .elongation_deviation = c->elongation_deviation,
                            .low = 0.1,
                            .high = 1.0};
}

/// Spacing that the published case of this curve had, or 0.
static double published_spacing(const char *curve)
{
    for (int32_t i = 0; clast_curve_case_at(i) != NULL; ++i) {
        if (strcmp(clast_curve_case_at(i)->name, curve) == 0) {
            return clast_curve_case_at(i)->spacing;
        }
    }
    return 0.0;
}

clast_status clx_pack_prepare(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_pack_config *c = &p->config;
    double low = 0.0;
    double high = 0.0;
    const clast_form_law law = law_of(c);
    CLX_TRY(prepare_weights(p));
    CLX_TRY(clx_alloc(&p->unit_size, p->input.n_shape, sizeof *p->unit_size));
    for (int32_t i = 0; i < p->input.n_shape; ++i) {
        const clast_shape *shape = &p->input.shape[i];
        int32_t id = 0;
        CLX_TRY(clast_dem_add_shape(p->dem, shape, &id));
        p->unit_size[i][0] = size_of(shape, c->size_meaning);
        p->unit_size[i][1] = shape->volume;
        CLX_CHECK(p->unit_size[i][0] > 0.0, CLAST_E_GEOMETRY, "shape %s has no size", shape->name);
        CLX_CHECK(!c->form_law || shape->kind != CLAST_SHAPE_CLUMP, CLAST_E_CONFIG,
                  "form_law cannot stretch clump %s", shape->name);
        p->widest = fmax(p->widest, 2.0 * shape->bounding_radius / p->unit_size[i][0]);
    }
    if (c->form_law) {
        CLX_TRY(clast_form_law_check(&law));
        p->widest *= 2.0; // an estimate for the lattice; grains that need more are moved on
    }
    clast_grading_range(p->input.grading, &low, &high);
    if (!isfinite(high)) {
        high = clast_grading_mass_size(p->input.grading, 0.99);
    }
    p->spacing = c->spacing > 0.0 ? c->spacing : published_spacing(c->curve);
    if (p->spacing == 0.0) {
        p->spacing = 1.02 * high * p->widest;
    }
done:
    return status;
}

/// The drawn shape stretched to a drawn form, as a shape of the simulation of its own.
static clast_status stretch(clast_pack *p, int64_t index, const clast_shape *shape, int32_t *id,
                            double size_volume[2])
{
    clast_status status = CLAST_OK;
    const clast_form_law law = law_of(&p->config);
    clast_shape made = {0};
    clast_mesh mesh = {0};
    char name[64];
    double flatness = 1.0;
    double elongation = 1.0;
    clast_form_law_draw(&law, p->config.seed, (uint64_t)index, &flatness, &elongation);
    const double lis[3] = {1.0 / elongation, 1.0, flatness};
    (void)snprintf(name, sizeof name, "form-%lld", (long long)index);
    if (shape->kind == CLAST_SHAPE_MESH) {
        CLX_TRY(clast_reform_mesh(&shape->mesh, lis, &mesh));
        CLX_TRY(clast_shape_mesh(name, &mesh, &made));
    } else {
        const double axes[3] = {0.5 * lis[0], 0.5 * lis[1], 0.5 * lis[2]};
        CLX_TRY(clast_shape_ellipsoid(name, axes, &made));
    }
    if (p->pending_form == index) { // made for a fill that had no room left for it
        *id = p->pending_shape;
    } else {
        CLX_TRY(clast_dem_add_shape(p->dem, &made, id));
        p->pending_form = index;
        p->pending_shape = *id;
    }
    size_volume[0] = size_of(&made, p->config.size_meaning);
    size_volume[1] = made.volume;
done:
    clast_mesh_free(&mesh);
    clast_shape_free(&made);
    return status;
}

static void draw_motion(const clast_pack *p, int64_t index, double size, clast_dem_grain *g)
{
    const double u = p->config.initial_speed;
    clx_rng rng = clx_rng_at(p->config.seed, CLX_STREAM_PACK_VELOCITY, (uint64_t)index);
    g->velocity[0] = 0.1 * u * (2.0 * clx_rng_uniform(&rng) - 1.0);
    g->velocity[1] = 0.1 * u * (2.0 * clx_rng_uniform(&rng) - 1.0);
    g->velocity[2] = -u;
    for (int k = 0; k < 3; ++k) {
        g->spin[k] = 0.1 * u * (2.0 * clx_rng_uniform(&rng) - 1.0) / size;
    }
    v3_set(&g->orientation[1], 0.0, 0.0, 0.0);
    g->orientation[0] = 1.0;
    if (p->config.random_turn) {
        rng = clx_rng_at(p->config.seed, CLX_STREAM_PACK_TURN, (uint64_t)index);
        clx_rng_orientation(&rng, g->orientation);
    }
}

clast_status clx_pack_draw(clast_pack *p, int64_t index, clast_dem_grain *g)
{
    clast_status status = CLAST_OK;
    clx_rng rng = clx_rng_at(p->config.seed, CLX_STREAM_PACK_SHAPE, (uint64_t)index);
    const double u = clx_rng_uniform(&rng);
    const double size = clast_grading_draw(p->input.grading, p->config.seed, (uint64_t)index);
    int32_t shape = 0;
    while (shape < p->input.n_shape - 1 && u > p->weight[shape]) {
        ++shape;
    }
    double at[2] = {p->unit_size[shape][0], p->unit_size[shape][1]};
    *g = (clast_dem_grain){.shape = shape, .density = p->config.density};
    if (p->config.form_law) {
        CLX_TRY(stretch(p, index, &p->input.shape[shape], &g->shape, at));
    }
    g->scale = size / at[0];
    draw_motion(p, index, size, g);
done:
    return status;
}

/// Greatest reach from its centre that the domain's sides leave a grain.
static double reach_limit(const clast_dem_config *d)
{
    const double depth = d->depth > 0.0 ? d->depth : d->width;
    return d->domain == CLAST_DEM_PERIODIC   ? 0.25 * fmin(d->width, depth) / (1.0 + d->skin)
           : d->domain == CLAST_DEM_CYLINDER ? 0.5 * d->width
           : d->domain == CLAST_DEM_BOX      ? 0.5 * fmin(d->width, depth)
                                             : (double)INFINITY;
}

clast_status clx_pack_check_draws(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_dem_config *d = &p->config.dem;
    const double limit = reach_limit(d);
    double mass = 0.0;
    for (int64_t i = 0; mass < p->config.mass && !p->config.form_law; ++i) {
        clast_dem_grain g;
        double measures[2];
        CLX_TRY(clx_pack_draw(p, i, &g));
        clast_dem_shape_measures(p->dem, g.shape, measures);
        const double reach = g.scale * measures[0];
        CLX_CHECK(reach <= limit, CLAST_E_GEOMETRY,
                  "grain %lld of this seed reaches %g m across, more than %s of %g m; take a wider "
                  "domain, or another seed if few grains are as large",
                  (long long)i, 2.0 * reach,
                  d->domain == CLAST_DEM_PERIODIC ? "half the period" : "the width",
                  fmin(d->width, d->depth > 0.0 ? d->depth : d->width));
        mass += g.density * measures[1] * g.scale * g.scale * g.scale;
    }
done:
    return status;
}

double clx_pack_fill_low(const clast_pack *p)
{
    const clast_pack_config *c = &p->config;
    return p->base + p->tall * (p->n_fill == 0 && c->first_low >= 0.0 ? c->first_low : c->fill_low);
}

static double fill_high(const clast_pack *p)
{
    const clast_pack_config *c = &p->config;
    return p->base +
           p->tall * (p->n_fill == 0 && c->first_high >= 0.0 ? c->first_high : c->fill_high);
}

/// Where the next grain of a fill may go.
typedef struct {
    double low, high; ///< heights of the region
    uint8_t *taken;   ///< [n_point] lattice points that no grain can have any more
    int64_t first;    ///< all before it are taken
    double x, y, z;   ///< shelf: where the next sphere may begin
    double row, layer;
    int32_t n;
    int32_t n_wide; ///< spheres wider than the spacing
    int32_t n_old;  ///< the first of `grain`: of earlier fills, still reaching into the region
    clast_dem_grain *grain; ///< [n] of this fill
    double *radius;         ///< [n]
    int64_t capacity, radius_capacity;
} filling;

/// The k-th point of the lattice, layer by layer; false above the region.
static bool lattice_point(const clast_pack *p, const filling *f, int64_t k, double x[3])
{
    const clast_dem_config *d = &p->config.dem;
    const double h = p->spacing;
    const bool is_hcp = p->config.generator == CLAST_PACK_HCP;
    const double depth = d->depth > 0.0 ? d->depth : d->width;
    const double step[3] = {h, is_hcp ? h * sqrt(0.75) : h, is_hcp ? h * sqrt(2.0 / 3.0) : h};
    const int64_t nx = (int64_t)fmax(1.0, floor(d->width / step[0] + 1e-9));
    const int64_t ny = (int64_t)fmax(1.0, floor(depth / step[1] + 1e-9));
    const int64_t i = k % nx;
    const int64_t j = k / nx % ny;
    const int64_t l = k / (nx * ny);
    x[0] = p->middle[0] + ((double)i - 0.5 * (double)(nx - 1)) * step[0];
    x[1] = p->middle[1] + ((double)j - 0.5 * (double)(ny - 1)) * step[1];
    x[2] = f->low + 0.5 * h + (double)l * step[2];
    if (is_hcp) {
        x[0] += (j + l) % 2 != 0 ? 0.25 * h : -0.25 * h;
        x[1] += l % 2 != 0 ? h / sqrt(48.0) : -h / sqrt(48.0);
    }
    return x[2] <= f->high - 0.5 * h + 1e-9 * h;
}

/// Whether a sphere lies within the side walls, by half a spacing or its own radius.
static bool is_inside(const clast_pack *p, const double x[3], double radius)
{
    const clast_dem_config *d = &p->config.dem;
    const double depth = d->depth > 0.0 ? d->depth : d->width;
    if (p->inside != NULL) {
        return clx_pack_holds(p, x, radius);
    }
    if (d->domain == CLAST_DEM_CYLINDER) {
        return sqrt(x[0] * x[0] + x[1] * x[1]) + radius <= 0.5 * d->width;
    }
    return d->domain != CLAST_DEM_BOX ||
           (fabs(x[0]) + radius <= 0.5 * d->width && fabs(x[1]) + radius <= 0.5 * depth);
}

/// Whether a sphere is clear of all others of this fill, periodic images too.
static bool is_clear(const clast_pack *p, const filling *f, const double x[3], double radius)
{
    const clast_dem_config *d = &p->config.dem;
    const double period[2] = {d->width, d->depth > 0.0 ? d->depth : d->width};
    for (int32_t i = f->n - 1; i >= 0; --i) {
        const double reach = radius + f->radius[i];
        double r[3];
        v3_sub(r, x, f->grain[i].position);
        for (int k = 0; k < 2 && d->domain == CLAST_DEM_PERIODIC; ++k) {
            r[k] -= period[k] * floor(r[k] / period[k] + 0.5);
        }
        if (i < f->n_old && reach <= p->spacing) {
            continue; // the published lattice takes no notice
        }
        if (v3_norm2(r) < reach * reach) {
            return false;
        }
    }
    return true;
}

/// First lattice point that takes this sphere: points that a wide grain passed over are left to
/// those that follow.
static bool place_on_lattice(const clast_pack *p, filling *f, double radius, double x[3])
{
    const double room = fmax(radius, 0.5 * p->spacing);
    const bool may_overlap = 2.0 * radius > p->spacing || f->n_wide > 0 || f->n_old > 0;
    double spare[3];
    for (int64_t k = f->first; lattice_point(p, f, k, x); ++k) {
        if (f->taken[k] != 0) {
            continue;
        }
        if (!is_inside(p, x, room)) {
            f->taken[k] = room > 0.5 * p->spacing ? 0 : 1; // too near a side for any grain
            continue;
        }
        if (!may_overlap || is_clear(p, f, x, radius)) {
            f->taken[k] = 1;
            while (lattice_point(p, f, f->first, spare) && f->taken[f->first] != 0) {
                ++f->first;
            }
            f->n_wide += 2.0 * radius > p->spacing ? 1 : 0;
            return true;
        }
    }
    // a wide grain may fit between walls where the lattice has no point: on the axis
    v3_set(x, p->middle[0], p->middle[1], f->low + room);
    if (f->n == f->n_old && is_clear(p, f, x, radius) && is_inside(p, x, radius) &&
        x[2] + radius <= f->high) {
        f->n_wide = 1;
        return true;
    }
    return false;
}

/// Next place on the shelves: rows along x, rows side by side along y, layers above each other.
static bool place_on_shelf(const clast_pack *p, filling *f, double radius, double x[3])
{
    const clast_dem_config *d = &p->config.dem;
    const double low[2] = {p->middle[0] - 0.5 * d->width,
                           p->middle[1] - 0.5 * (d->depth > 0.0 ? d->depth : d->width)};
    const double high[2] = {2.0 * p->middle[0] - low[0], 2.0 * p->middle[1] - low[1]};
    const double size = 2.02 * radius;
    for (int tries = 0; tries < 100000; ++tries) {
        if (f->z + size > f->high) {
            return false;
        }
        if (f->y + size > high[1]) { // layer is full
            f->z += f->layer;
            f->y = low[1];
            f->x = low[0];
            f->row = f->layer = 0.0;
        } else if (f->x + size > high[0]) { // row is full
            f->y += f->row > 0.0 ? f->row : 0.25 * radius;
            f->x = low[0];
            f->row = 0.0;
        } else {
            v3_set(x, f->x + 0.5 * size, f->y + 0.5 * size, f->z + 0.5 * size);
            if (is_inside(p, x, radius)) {
                f->x += size;
                f->row = fmax(f->row, size);
                f->layer = fmax(f->layer, size);
                return true;
            }
            f->x += 0.25 * radius;
        }
    }
    return false;
}

static clast_status keep(filling *f, const clast_dem_grain *g, double radius)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&f->grain, &f->capacity, f->n + 1, sizeof *f->grain));
    CLX_TRY(clx_grow(&f->radius, &f->radius_capacity, f->n + 1, sizeof *f->radius));
    f->radius[f->n] = radius;
    f->grain[f->n++] = *g;
done:
    return status;
}

/// Grains of earlier fills that still reach into the region.
static clast_status keep_old(const clast_pack *p, filling *f)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < clast_dem_n_grain(p->dem); ++i) {
        clast_dem_grain g;
        double measures[2];
        clast_dem_read_grain(p->dem, i, &g);
        clast_dem_shape_measures(p->dem, g.shape, measures);
        if (g.position[2] + g.scale * measures[0] > f->low) {
            CLX_TRY(keep(f, &g, g.scale * measures[0]));
        }
    }
    f->n_old = f->n;
done:
    return status;
}

/// Draws grains and places them until the region or the mass is full.
static clast_status fill_region(clast_pack *p, filling *f)
{
    clast_status status = CLAST_OK;
    while (p->mass < p->config.mass) {
        clast_dem_grain g;
        double measures[2];
        CLX_TRY(clx_pack_draw(p, p->n_made, &g));
        clast_dem_shape_measures(p->dem, g.shape, measures);
        const double radius = g.scale * measures[0];
        const bool placed = p->config.generator == CLAST_PACK_SHELF
                                ? place_on_shelf(p, f, radius, g.position)
                                : place_on_lattice(p, f, radius, g.position);
        if (!placed) {
            break; // the same grain comes first in the next fill
        }
        CLX_TRY(keep(f, &g, radius));
        ++p->n_made;
        p->mass += p->config.density * measures[1] * g.scale * g.scale * g.scale;
    }
    CLX_CHECK(f->n > f->n_old || f->n_old > 0, CLAST_E_CONFIG,
              "no grain fits between %g and %g m: grain %lld needs more room than the domain has "
              "(spacing %g m)",
              f->low, f->high, (long long)p->n_made, p->spacing);
done:
    return status;
}

clast_status clx_pack_fill(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_dem_config *d = &p->config.dem;
    filling f = {.low = clx_pack_fill_low(p), .high = fill_high(p)};
    f.x = p->middle[0] - 0.5 * d->width;
    f.y = p->middle[1] - 0.5 * (d->depth > 0.0 ? d->depth : d->width);
    f.z = f.low;
    int64_t n_point = 0;
    double x[3];
    while (p->config.generator != CLAST_PACK_SHELF && lattice_point(p, &f, n_point, x)) {
        ++n_point;
    }
    CLX_TRY(clx_alloc(&f.taken, n_point + 1, sizeof *f.taken));
    CLX_TRY(keep_old(p, &f));
    CLX_TRY(fill_region(p, &f));
    CLX_TRY(clast_dem_add_grains(p->dem, f.n - f.n_old, f.grain + f.n_old));
    ++p->n_fill;
    p->fill_step = clast_dem_n_step(p->dem);
done:
    clx_free(f.grain);
    clx_free(f.radius);
    clx_free(f.taken);
    return status;
}
