// Side walls: how far a bed reaches in grain sizes, what reaches beyond them, and the porosity away
// from them.
//
// Grains stand in layers at a wall, so the solid beyond a sharp cut swings with the cut's place by
// a hundredth. What counts therefore rises from 0 to 1 over one grain size: the mean over such
// cuts.
#include <clast/porosity.h>

#include "assembly/grain_points.h"
#include "assembly/touch_set.h"
#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/parallel.h"
#include "base/status.h"
#include "porosity/slabs.h"
#include "porosity/whole.h"
#include <clast/mesh.h>
#include <clast/shape.h>
#include <math.h>

enum { POINTS = 512, BLOCK = 32, BED_POINTS = 20000 };

static const double TOUCH = 1e-3; ///< of a grain's reach: so far it passes a wall unseen

clast_bed_walls clast_bed_side_walls(const clast_bed *bed, const clast_assembly *assembly)
{
    clast_bed_walls walls = {(double)NAN, (double)NAN, (double)NAN};
    if (clx_bed_fault(bed) != NULL || clx_assembly_fault(assembly) != NULL) {
        return walls;
    }
    double volume = 0.0;
    double size = 0.0;
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        const double v = clx_grain_volume(assembly, i);
        volume += v;
        size += v * cbrt(6.0 / CLAST_PI * v);
    }
    walls.size = size / volume;
    double period[3];
    if (bed->is_part || clast_bed_period(bed, period)) {
        walls.radius = HUGE_VAL;
    } else if (bed->kind == CLAST_BED_CYLINDER) {
        walls.radius = bed->radius;
    } else if (bed->kind == CLAST_BED_BOX) {
        const double x = bed->high[0] - bed->low[0];
        const double y = bed->high[1] - bed->low[1];
        walls.radius = x * y / (x + y);
    }
    walls.ratio = walls.radius / walls.size;
    return walls;
}

/// Distance of a point from the nearest side wall [m], below 0 outside.
static double distance(const clast_bed *bed, const double x[3])
{
    if (bed->kind == CLAST_BED_CYLINDER) {
        return bed->radius - hypot(x[0] - bed->centre[0], x[1] - bed->centre[1]);
    }
    double least = HUGE_VAL;
    for (int k = 0; k < 2; ++k) {
        least = fmin(least, fmin(x[k] - bed->low[k], bed->high[k] - x[k]));
    }
    return least;
}

/// A grain as the method has it.
static clx_touch_body body_of(const clast_assembly *a, const clx_touch_set *set,
                              clast_porosity_method method, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < a->n_grain);
    if (method != CLAST_POROSITY_SPHERES) {
        return *clx_touch_scene_body(set->scene, i);
    }
    const double upright[4] = {1.0, 0.0, 0.0, 0.0};
    clx_touch_body ball = clx_touch_body_sphere(cbrt(0.75 / CLAST_PI * clx_grain_volume(a, i)));
    clx_touch_body_place(&ball, a->position[i], upright, 1.0);
    return ball;
}

typedef struct {
    const clast_assembly *assembly;
    const clast_bed *bed;
    const clx_touch_set *set;
    clast_bvh *surface; ///< of a bed within one, else NULL
    clast_porosity_method method;
    double z[2];
    double *share, *depth; ///< [n_grain] of its points beyond the sides; of the farthest [m]
} beyond_search;

/// Distance of a point from the nearest side [m], below 0 outside.
static double inside_by(const clast_bed *bed, clast_bvh *surface, const double x[3])
{
    return surface != NULL ? -clast_bvh_signed_distance(surface, x) : distance(bed, x);
}

static void find_beyond(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const beyond_search *s = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const clx_touch_body body = body_of(s->assembly, s->set, s->method, (int32_t)i);
        const double inside = inside_by(s->bed, s->surface, body.position);
        double cube[3];
        double x[3];
        int32_t n = 0;
        int32_t n_beyond = 0;
        // Grains that a part's side cuts alike have other points each, or their errors add up. A
        // contact's overlap with a wall has none of the same ones.
        clx_lattice_begin(s->bed->is_part ? POINTS * i : 0, cube);
        for (int32_t tried = 0;
             inside < (1.0 - TOUCH) * body.radius && n < POINTS && tried < 1000 * POINTS; ++tried) {
            clx_lattice_step(cube);
            if (clx_body_draw(&body, cube, x)) {
                ++n;
                const double by =
                    x[2] >= s->z[0] && x[2] <= s->z[1] ? -inside_by(s->bed, s->surface, x) : 0.0;
                n_beyond += by > 0.0 ? 1 : 0;
                s->depth[i] = fmax(s->depth[i], by);
            }
        }
        s->share[i] = n > 0 ? (double)n_beyond / n : 0.0;
        if (n_beyond > 0 && body.kind == CLX_TOUCH_SPHERE) {
            s->depth[i] = body.radius - inside;
        }
    }
}

/// What of each grain lies beyond the sides, between two heights.
static clast_status measure_beyond(beyond_search *s)
{
    clast_status status = CLAST_OK;
    clx_touch_set set = {0};
    if (s->bed->kind == CLAST_BED_MESH) {
        CLX_TRY(clast_bvh_create(s->bed->surface, &s->surface));
    }
    CLX_TRY(clx_touch_set_init(s->assembly, &set));
    s->set = &set;
    clx_parallel_for(s->assembly->n_grain, BLOCK, find_beyond, s);
done:
    s->set = NULL;
    clast_bvh_destroy(s->surface);
    s->surface = NULL;
    clx_touch_set_free(&set);
    return status;
}

clast_status clx_bed_shares_beyond(const clast_bed *bed, const clast_assembly *assembly,
                                   clast_porosity_method method, double *share)
{
    clast_status status = CLAST_OK;
    beyond_search s = {.assembly = assembly,
                       .bed = bed,
                       .method = method,
                       .z = {-HUGE_VAL, HUGE_VAL},
                       .share = share};
    if (bed->kind == CLAST_BED_MESH) { // slices end at its rim
        double low[3];
        double high[3];
        clast_mesh_bounds(bed->surface, low, high);
        s.z[0] = low[2];
        s.z[1] = high[2];
    }
    CLX_TRY(clx_alloc(&s.depth, assembly->n_grain, sizeof *s.depth));
    CLX_TRY(measure_beyond(&s));
done:
    clx_free(s.depth);
    return status;
}

clast_status clast_bed_beyond_measure(const clast_bed *bed, const clast_assembly *assembly,
                                      const clast_porosity_bulk *bulk, clast_porosity_method method,
                                      clast_bed_beyond *beyond)
{
    CLX_ARGUMENTS(assembly, bed, bulk, beyond);
    CLX_WHOLE(assembly, assembly);
    CLX_WHOLE(bed, bed);
    clast_status status = CLAST_OK;
    clast_bed_beyond made = {0};
    double period[3];
    beyond_search s = {
        .assembly = assembly, .bed = bed, .method = method, .z = {bulk->z_low, bulk->z_high}};
    CLX_CHECK((unsigned)method <= CLAST_POROSITY_SPHERES, CLAST_E_ARGUMENT,
              "porosity: there is no method %d", (int)method);
    if (clast_bed_period(bed, period)) {
        return clx_images_measure(bed, assembly, beyond);
    }
    CLX_TRY(clx_alloc(&s.share, assembly->n_grain, sizeof *s.share));
    CLX_TRY(clx_alloc(&s.depth, assembly->n_grain, sizeof *s.depth));
    CLX_TRY(measure_beyond(&s));
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        made.n += s.share[i] > 0.0 ? 1 : 0;
        made.depth = fmax(made.depth, s.depth[i]);
        made.solid += s.share[i] * clx_grain_volume(assembly, i);
    }
    *beyond = made;
done:
    CLX_FREE(s.share, s.depth);
    return status;
}

/// Bounds of a bed between two heights; a surface's are its own, too.
static void bed_bounds(const clast_bed *bed, const double z[2], double low[3], double high[3])
{
    for (int k = 0; k < 2; ++k) {
        const bool is_round = bed->kind == CLAST_BED_CYLINDER;
        low[k] = is_round ? bed->centre[k] - bed->radius : bed->low[k];
        high[k] = is_round ? bed->centre[k] + bed->radius : bed->high[k];
    }
    low[2] = z[0];
    high[2] = z[1];
    if (bed->kind == CLAST_BED_MESH) {
        double least[3];
        double most[3];
        clast_mesh_bounds(bed->surface, least, most);
        low[2] = fmax(low[2], least[2]);
        high[2] = fmin(high[2], most[2]);
    }
}

clast_status clast_bed_outside(const clast_bed *bed, const clast_bed *own, const double z[2],
                               double *share)
{
    CLX_ARGUMENTS(bed, own, z, share);
    CLX_WHOLE(bed, bed);
    CLX_WHOLE(bed, own);
    clast_status status = CLAST_OK;
    const clast_bed *beds[2] = {bed, own};
    clast_bvh *surface[2] = {NULL, NULL};
    double low[2][3];
    double high[2][3];
    double cube[3];
    int32_t n = 0;
    int32_t n_outside = 0;
    CLX_CHECK(z[1] > z[0], CLAST_E_USAGE, "no height between %s and %s", clx_unit_text(z[0], "m"),
              clx_unit_text(z[1], "m"));
    for (int b = 0; b < 2; ++b) {
        bed_bounds(beds[b], z, low[b], high[b]);
        if (beds[b]->kind == CLAST_BED_MESH) {
            CLX_TRY(clast_bvh_create(beds[b]->surface, &surface[b]));
        }
    }
    low[0][2] = fmax(low[0][2], low[1][2]);
    high[0][2] = fmin(high[0][2], high[1][2]);
    clx_lattice_begin(0, cube);
    for (int32_t k = 0; k < BED_POINTS && high[0][2] > low[0][2]; ++k) {
        double x[3];
        clx_lattice_step(cube);
        for (int i = 0; i < 3; ++i) {
            x[i] = low[0][i] + cube[i] * (high[0][i] - low[0][i]);
        }
        if (inside_by(bed, surface[0], x) >= 0.0) {
            ++n;
            n_outside += inside_by(own, surface[1], x) < 0.0 ? 1 : 0;
        }
    }
    *share = n > 0 ? (double)n_outside / n : 0.0;
done:
    clast_bvh_destroy(surface[0]);
    clast_bvh_destroy(surface[1]);
    return status;
}

typedef struct {
    const clast_assembly *assembly;
    const clast_bed *bed;
    const clx_touch_set *set;
    clast_porosity_method method;
    double depth, ramp; ///< middle and width of the ramp [m]
    double edge[2];
    double solid, variance; ///< under construction
} core_sum;

/// How much a place counts: 0 near the side walls, 1 beyond the ramp.
static double weight_at(const core_sum *c, const double x[3])
{
    if (x[2] < c->edge[0] || x[2] > c->edge[1]) {
        return 0.0;
    }
    return fmin(fmax((distance(c->bed, x) - c->depth) / c->ramp + 0.5, 0.0), 1.0);
}

/// Mean weight over even points of the body, and the variance of that mean, as of random points.
static double mean_weight(const core_sum *c, const clx_touch_body *body, double *variance)
{
    double cube[3] = {0.5, 0.5, 0.5};
    double point[3];
    double sum = 0.0;
    double square = 0.0;
    int32_t n = 0;
    // A surface fills at least a thousandth of its box, or its points are few.
    for (int32_t tried = 0; n < POINTS && tried < 1000 * POINTS; ++tried) {
        clx_lattice_step(cube);
        if (clx_body_draw(body, cube, point)) {
            const double w = weight_at(c, point);
            ++n;
            sum += w;
            square += w * w;
        }
    }
    const double mean = n > 0 ? sum / n : 0.5;
    *variance = n > 0 ? fmax(square / n - mean * mean, 0.0) / n : 1.0;
    return mean;
}

/// A grain that the core's side cuts, by points.
static void add_cut(core_sum *c, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < c->assembly->n_grain);
    const clast_assembly *a = c->assembly;
    const double volume = clx_grain_volume(a, i);
    double variance = 0.0;
    const clx_touch_body body = body_of(a, c->set, c->method, i);
    c->solid += mean_weight(c, &body, &variance) * volume;
    c->variance += volume * volume * variance;
}

static clast_status add_grain(core_sum *c, int32_t i)
{
    const clast_assembly *a = c->assembly;
    const double radius = c->method == CLAST_POROSITY_SPHERES
                              ? cbrt(0.75 / CLAST_PI * clx_grain_volume(a, i))
                              : a->scale[i] * a->shape[a->shape_id[i]].bounding_radius;
    const double inside = distance(c->bed, a->position[i]) - c->depth;
    const double outer_radius = radius + 0.5 * c->ramp;
    const double z = a->position[i][2];
    if (inside <= -outer_radius || z + radius <= c->edge[0] || z - radius >= c->edge[1]) {
        return CLAST_OK;
    }
    if (inside >= outer_radius) { // cut by the heights at most
        return clx_grain_slabs(a, i, c->method, 1, c->edge, &c->solid);
    }
    add_cut(c, i);
    return CLAST_OK;
}

/// Horizontal area that is farther than `depth` from the side walls; 0 where that is nothing.
static double area_within(const clast_bed *bed, double depth)
{
    if (bed->kind == CLAST_BED_CYLINDER) {
        const double r = fmax(bed->radius - depth, 0.0);
        return CLAST_PI * r * r;
    }
    return fmax(bed->high[0] - bed->low[0] - 2.0 * depth, 0.0) *
           fmax(bed->high[1] - bed->low[1] - 2.0 * depth, 0.0);
}

/// The area by weight: the mean of area_within over the ramp, a quadratic (Simpson's rule is
/// exact).
static double core_area(const clast_bed *bed, double depth, double ramp)
{
    const double last = area_within(bed, depth + 0.5 * ramp);
    return last > 0.0
               ? (area_within(bed, depth - 0.5 * ramp) + 4.0 * area_within(bed, depth) + last) / 6.0
               : 0.0;
}

clast_status clast_porosity_core_measure(const clast_assembly *assembly, const clast_bed *bed,
                                         const clast_porosity_bulk *bulk, double n_size,
                                         const clast_porosity_options *options,
                                         clast_porosity_core *core)
{
    CLX_ARGUMENTS(assembly, bed, options, bulk, core);
    CLX_WHOLE(assembly, assembly);
    CLX_WHOLE(bed, bed);
    clast_status status = CLAST_OK;
    clx_touch_set set = {0};
    double period[3];
    CLX_CHECK(bed->kind != CLAST_BED_MESH, CLAST_E_USAGE,
              "the core of a container given as a surface is not measured: it has no one distance "
              "from its side (cylinder and box have)");
    CLX_CHECK(!clast_bed_period(bed, period), CLAST_E_USAGE,
              "a bed that is periodic in x and y has no side walls, so no core apart from them");
    CLX_CHECK(!bed->is_part, CLAST_E_USAGE,
              "a part of a packing has no side walls, so no core apart from them");
    CLX_CHECK(assembly->n_grain > 0 && bulk->z_high > bulk->z_low, CLAST_E_USAGE,
              "no grain to measure between %g and %g", bulk->z_low, bulk->z_high);
    const clast_bed_walls walls = clast_bed_side_walls(bed, assembly);
    const double depth = n_size * walls.size;
    const double volume = core_area(bed, depth, walls.size) * (bulk->z_high - bulk->z_low);
    CLX_CHECK(n_size >= 0.5, CLAST_E_USAGE,
              "a core begins at least half a grain size from the side walls, not %g", n_size);
    CLX_CHECK(volume > 0.0, CLAST_E_GEOMETRY,
              "core %g: it counts in full from half a grain size farther on, %g, and the side "
              "walls are %.3g grain sizes from the bed's axis",
              n_size, n_size + 0.5, walls.ratio);
    CLX_TRY(clx_touch_set_init(assembly, &set));
    core_sum c = {
        .assembly = assembly,
        .bed = bed,
        .set = &set,
        .method = options->method,
        .depth = depth,
        .ramp = walls.size,
        .edge = {options->trim > 0.0 ? bulk->z_low : clx_lowest_edge(assembly, bed, options),
                 bulk->z_high}};
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        CLX_TRY(add_grain(&c, i));
    }
    *core = (clast_porosity_core){depth, 1.0 - c.solid / volume, sqrt(c.variance) / volume,
                                  bulk->porosity - (1.0 - c.solid / volume)};
done:
    clx_touch_set_free(&set);
    return status;
}
