// What grains are: a function of seed and number alone.
#include "base/alloc.h"
#include "dem/body.h"
#include "math/rng.h"
#include "math/vec3.h"
#include "pack/load.h"
#include "pack/pack.h"
#include <clast/form.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

double clx_pack_size_of(const clast_shape *shape, int32_t meaning)
{
    CLAST_ASSERT(shape->volume > 0.0);
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
        p->unit_size[i][0] = clx_pack_size_of(shape, c->size_meaning);
        p->unit_size[i][1] = shape->volume;
        CLX_CHECK(p->unit_size[i][0] > 0.0, CLAST_E_GEOMETRY, "shape %s has no size", shape->name);
        CLX_CHECK(!c->form_law || (shape->kind != CLAST_SHAPE_CLUMP && shape->parts.n == 0),
                  CLAST_E_CONFIG, "form_law cannot stretch clump or aggregate %s", shape->name);
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

/// Lengths L, I, S of a drawn form, I = 1.
static void draw_form(const clast_pack *p, int64_t index, double lis[3])
{
    const clast_form_law law = law_of(&p->config);
    double flatness = 1.0;
    double elongation = 1.0;
    clast_form_law_draw(&law, p->config.seed, (uint64_t)index, &flatness, &elongation);
    v3_set(lis, 1.0 / elongation, 1.0, flatness);
}

/// The drawn shape stretched to a drawn form, as a shape of the simulation of its own; `form` is
/// its number, or -1 before it is made.
static clast_status stretch(clast_pack *p, int64_t index, const clast_shape *shape, int32_t *form,
                            double size_volume[2])
{
    clast_status status = CLAST_OK;
    clast_shape made = {0};
    clast_mesh mesh = {0};
    char name[64];
    double lis[3];
    draw_form(p, index, lis);
    (void)snprintf(name, sizeof name, "form-%lld", (long long)index);
    if (shape->kind == CLAST_SHAPE_MESH) {
        CLX_TRY(clast_reform_mesh(&shape->mesh, lis, &mesh));
        CLX_TRY(clast_shape_mesh(name, &mesh, &made));
    } else {
        const double axes[3] = {0.5 * lis[0], 0.5 * lis[1], 0.5 * lis[2]};
        CLX_TRY(clast_shape_ellipsoid(name, axes, &made));
    }
    if (*form < 0) {
        CLX_TRY(clast_dem_add_shape(p->dem, &made, form));
    }
    size_volume[0] = clx_pack_size_of(&made, p->config.size_meaning);
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
    if (p->config.dem.domain == CLAST_DEM_CELL) { // has no down
        g->velocity[2] = 0.1 * u * (2.0 * clx_rng_uniform(&rng) - 1.0);
    }
    for (int k = 0; k < 3; ++k) {
        g->angular_velocity[k] = 0.1 * u * (2.0 * clx_rng_uniform(&rng) - 1.0) / size;
    }
    v3_set(&g->orientation[1], 0.0, 0.0, 0.0);
    g->orientation[0] = 1.0;
    if (p->config.random_turn) {
        rng = clx_rng_at(p->config.seed, CLX_STREAM_PACK_TURN, (uint64_t)index);
        clx_rng_orientation(&rng, g->orientation);
    }
}

static int32_t draw_shape(const clast_pack *p, int64_t index)
{
    clx_rng rng = clx_rng_at(p->config.seed, CLX_STREAM_PACK_SHAPE, (uint64_t)index);
    const double u = clx_rng_uniform(&rng);
    int32_t shape = 0;
    while (shape < p->input.n_shape - 1 && u > p->weight[shape]) {
        ++shape;
    }
    return shape;
}

clast_status clx_pack_draw(clast_pack *p, clx_pack_number *number, clast_dem_grain *g)
{
    CLAST_ASSERT(number->index >= 0);
    clast_status status = CLAST_OK;
    const int64_t index = number->index;
    const double size = clast_grading_draw(p->input.grading, p->config.seed, (uint64_t)index);
    const int32_t shape = draw_shape(p, index);
    double at[2] = {p->unit_size[shape][0], p->unit_size[shape][1]};
    *g = (clast_dem_grain){.shape = shape, .density = clx_pack_density(p, index, shape, size)};
    if (p->config.form_law) {
        CLX_TRY(stretch(p, index, &p->input.shape[shape], &number->form, at));
        g->shape = number->form;
    }
    g->scale = size / at[0];
    draw_motion(p, index, size, g);
done:
    return status;
}

/// Greatest reach from its centre that the domain's sides leave a grain.
static double largest_bounding_radius(const clast_dem_config *d)
{
    const double depth = d->depth > 0.0 ? d->depth : d->width;
    const double skin = clx_least_skin(d);
    return d->domain == CLAST_DEM_CELL
               ? 0.25 * fmin(fmin(d->width, depth), d->height) / (1.0 + skin)
           : d->domain == CLAST_DEM_PERIODIC ? 0.5 * fmin(d->width, depth) / (1.0 + skin)
           : d->domain == CLAST_DEM_CYLINDER ? 0.5 * d->width
           : d->domain == CLAST_DEM_BOX      ? 0.5 * fmin(d->width, depth)
                                             : (double)INFINITY;
}

/// Draws after which the number of all grains is estimated, and the most that are taken on.
static const int64_t SAMPLE = 1 << 20;
static const double MOST_GRAINS = 1e8;

/// Greatest distance from the origin once the axes are stretched by these factors.
static double stretched_bounding_radius(const clast_mesh *mesh, const double factor[3])
{
    double r2 = 0.0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            const double *x = mesh->vert[mesh->tri[t][k]];
            r2 = fmax(r2,
                      v3_norm2((double[3]){factor[0] * x[0], factor[1] * x[1], factor[2] * x[2]}));
        }
    }
    return sqrt(r2);
}

/// Grains as they are drawn, of a form law too, without making their shapes.
typedef struct {
    clast_mesh *principal; ///< [n_shape] in its principal frame, made when a grain needs it
    double limit;          ///< greatest bounding radius
    double bounding_radius,
        mass; ///< of the grain at hand; no less than it is, exact above limit
} draws;

/// A stretched shape has the axes of its form, and the volume follows them (see `stretch`).
static clast_status measure_form(const clast_pack *p, draws *all, int64_t index)
{
    clast_status status = CLAST_OK;
    const int32_t number = draw_shape(p, index);
    const clast_shape *shape = &p->input.shape[number];
    const bool is_mesh = shape->kind == CLAST_SHAPE_MESH;
    const double size = clast_grading_draw(p->input.grading, p->config.seed, (uint64_t)index);
    double lis[3];
    double was[3];
    double factor[3];
    draw_form(p, index, lis);
    clast_shape form = {.semi_axes = {0.5 * lis[0], 0.5 * lis[1], 0.5 * lis[2]}};
    for (int k = 0; k < 3; ++k) {
        factor[k] = form.semi_axes[k] / shape->semi_axes[k];
    }
    form.volume = is_mesh ? shape->volume * factor[0] * factor[1] * factor[2]
                          : CLAST_PI / 6.0 * lis[0] * lis[1] * lis[2];
    const double scale = size / clx_pack_size_of(&form, p->config.size_meaning);
    all->mass = clx_pack_density(p, index, number, size) * form.volume * scale * scale * scale;
    all->bounding_radius =
        scale * (is_mesh ? fmax(factor[0], fmax(factor[1], factor[2])) * shape->bounding_radius
                         : form.semi_axes[0]);
    if (is_mesh && all->bounding_radius > all->limit) {
        clast_mesh *principal = &all->principal[number];
        if (principal->n_tri == 0) {
            CLX_TRY(clast_reform_principal(&shape->mesh, principal, was));
        }
        all->bounding_radius = scale * stretched_bounding_radius(principal, factor);
    }
done:
    return status;
}

static clast_status measure_draw(clast_pack *p, draws *all, int64_t index)
{
    clast_status status = CLAST_OK;
    clast_dem_grain g;
    clx_pack_number number = {index, -1};
    double measures[2];
    if (p->config.form_law) {
        return measure_form(p, all, index);
    }
    CLX_TRY(clx_pack_draw(p, &number, &g));
    clx_dem_shape_measures(p->dem, g.shape, measures);
    all->bounding_radius = g.scale * measures[0];
    all->mass = g.density * measures[1] * g.scale * g.scale * g.scale;
done:
    return status;
}

/// Grains that begin faster than contacts of the smallest stop end the run in its first step; the
/// constants told are for a fall through the whole height.
static clast_status check_initial_speed(const clast_pack *p, double radius, double mass)
{
    const clast_dem_config *d = &p->config.dem;
    const double u = p->config.initial_speed;
    const double limit = clx_pack_stopped_speed(p, radius, mass);
    char stiffer[160] = "a larger young with a shorter time_step";
    if (d->domain == CLAST_DEM_CELL || u <= limit) {
        return CLAST_OK;
    }
    if (d->law == CLAST_DEM_LINEAR) {
        const double time = d->collision_time * limit / sqrt(u * u + 2.0 * d->gravity * d->height);
        const double digit = pow(10.0, floor(log10(time)));
        const double even = floor(time / digit) * digit;
        (void)snprintf(stiffer, sizeof stiffer,
                       "a shorter collision_time (%s suits a fall through the height) with "
                       "time_step %s",
                       clx_unit_text(even, "s"),
                       clx_unit_text(even / d->collision_time * d->time_step, "s"));
    }
    return clx_fail(CLAST_E_CONFIG,
                    "initial_speed %s: contacts of the smallest grain (%s) stop no more than %s "
                    "within half its radius; take a lower initial_speed, or %s",
                    clx_unit_text(u, "m/s"), clx_unit_text(2.0 * radius, "m"),
                    clx_unit_text(limit, "m/s"), stiffer);
}

clast_status clx_pack_check_draws(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_dem_config *d = &p->config.dem;
    draws all = {.limit = largest_bounding_radius(d)};
    double mass = 0.0;
    double least[2] = {INFINITY, 0.0}; // bounding radius and mass of the smallest grain
    CLX_TRY(clx_alloc(&all.principal, p->input.n_shape, sizeof *all.principal));
    for (int64_t i = 0; mass < p->config.mass; ++i) {
        CLX_TRY(measure_draw(p, &all, i));
        CLX_CHECK(all.bounding_radius <= all.limit, CLAST_E_GEOMETRY,
                  "grain %lld of this seed has a bounding diameter of %s, more than %s of %s; take "
                  "a wider "
                  "domain, or another seed if few grains are as large",
                  (long long)i, clx_unit_text(2.0 * all.bounding_radius, "m"),
                  d->domain == CLAST_DEM_CELL       ? "half the period, less the skin,"
                  : d->domain == CLAST_DEM_PERIODIC ? "the period, less the skin,"
                                                    : "the width",
                  clx_unit_text(fmin(d->width, d->depth > 0.0 ? d->depth : d->width), "m"));
        mass += all.mass;
        if (all.bounding_radius < least[0]) {
            least[0] = all.bounding_radius;
            least[1] = all.mass;
        }
        CLX_CHECK(i != SAMPLE || p->config.mass / mass * (double)i <= MOST_GRAINS, CLAST_E_CONFIG,
                  "%s of such grains are about %.2g, at most %g are packed; take less mass or "
                  "larger grains",
                  clx_unit_text(p->config.mass, "kg"), p->config.mass / mass * (double)i,
                  MOST_GRAINS);
    }
    CLX_TRY(check_initial_speed(p, least[0], least[1]));
done:
    for (int32_t i = 0; all.principal != NULL && i < p->input.n_shape; ++i) {
        clast_mesh_free(&all.principal[i]);
    }
    clx_free(all.principal);
    return status;
}
