// One particle's march.
//
// The engines test all pairs of spheres at every step. Here the places along the ray at which a
// pair counts as intersecting (|R - r| <= d <= R + r) are worked out once for each pair near the
// ray; the steps then only ask whether a place is among them. Same decisions, a thousandth of the
// work.
#include "aggregate/march.h"

#include "aggregate/sizes.h"
#include "base/alloc.h"
#include "base/parallel.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <math.h>

/// Places [low, high] along the ray where two spheres intersect.
typedef struct {
    double low, high;
} span;

typedef struct {
    span *item;
    int64_t n, capacity;
} span_list;

typedef struct {
    double origin[3], direction[3];
    double outermost; ///< P_e = origin + outermost * direction
    int32_t shape;
    double length; ///< requested of the particle; D_i of the paper
} march_ray;

typedef struct {
    const clx_march *march;
    const clx_aim *aim;
    double size;                    ///< of the particle, as the sizes mean it
    march_ray *ray;                 ///< [n_ray]
    clx_march_placement *placement; ///< [n_ray * n_orientation]
} marching;

/// Farthest hit of the line (both directions) through the ray's origin; false if it meets none.
static bool outermost_hit(const clx_march *march, march_ray *ray)
{
    double best = -HUGE_VAL;
    for (int32_t g = 0; g < march->n_grain; ++g) {
        const clx_march_grain *grain = &march->grain[g];
        double to[3];
        v3_sub(to, grain->centre, ray->origin);
        const double along = v3_dot(to, ray->direction);
        if (v3_norm2(to) - along * along > grain->radius * grain->radius * (1.0 + 1e-12) ||
            along + grain->radius < best) {
            continue;
        }
        for (int64_t i = grain->first; i < grain->first + grain->n; ++i) {
            const clx_march_sphere *s = &march->sphere[i];
            v3_sub(to, s->centre, ray->origin);
            const double b = v3_dot(to, ray->direction);
            const double c2 = s->radius * s->radius - (v3_norm2(to) - b * b);
            best = c2 >= 0.0 ? fmax(best, b + sqrt(c2)) : best;
        }
    }
    ray->outermost = best;
    return best > -HUGE_VAL;
}

static void nearest_centre(const clx_march *march, double origin[3])
{
    int64_t nearest = 0;
    double best = HUGE_VAL;
    for (int64_t i = 0; i < march->n_sphere; ++i) {
        const double d = v3_distance2(march->sphere[i].centre, origin);
        if (d < best) {
            best = d;
            nearest = i;
        }
    }
    v3_copy(origin, march->sphere[nearest].centre);
}

/// The coating shape of a ray and its requested length. Without classes the shape is drawn afresh
/// for each ray; with them it is the size's, but in the figures always the first (their test for
/// the others is never true), though scaled as the size's own class.
static void choose_shape(const marching *m, int64_t number, march_ray *ray)
{
    const clast_aggregate_params *c = m->march->params;
    const int64_t item = (int64_t)clx_aim_index(m->aim, number, m->aim->n_ray);
    const int32_t own = clx_sizes_shape(c, m->march->n_shape - 1, m->aim->seed, item, m->size);
    const bool fault = c->class_limit.n > 0 && c->flavour == CLAST_MARCH_FIGURES;
    ray->shape = fault ? 0 : own;
    ray->length = clx_march_length(m->march, m->size, own);
}

static void make_ray(const marching *m, int64_t number, march_ray *ray)
{
    const clx_march *march = m->march;
    clx_aim_direction(m->aim, number, ray->direction);
    v3_set(ray->origin, 0.0, 0.0, 0.0);
    if (march->sphere_origin) {
        clx_rng rng = clx_rng_at(m->aim->seed, CLX_STREAM_AGGREGATE_ORIGIN,
                                 clx_aim_index(m->aim, number, m->aim->n_ray));
        v3_copy(ray->origin, march->sphere[clx_rng_below(&rng, march->n_sphere)].centre);
    }
    if (!outermost_hit(march, ray)) {
        nearest_centre(march, ray->origin);
        (void)outermost_hit(march, ray);
    }
    choose_shape(m, number, ray);
}

/// Z-X-Z Euler angles in the passive x-convention, phi and psi about z, theta in [0, pi) drawn
/// evenly: not uniform over orientations, as in the engines.
static void draw_rotation(const marching *m, int64_t trial, double rotation[3][3])
{
    const int64_t n_trial = (int64_t)m->aim->n_ray * m->march->params->orientations;
    clx_rng rng = clx_rng_at(m->aim->seed, CLX_STREAM_AGGREGATE_ORIENTATION,
                             clx_aim_index(m->aim, trial, n_trial));
    const double phi = m->march->phi_range * clx_rng_uniform(&rng);
    const double theta = CLAST_PI * clx_rng_uniform(&rng);
    const double psi = 2.0 * CLAST_PI * clx_rng_uniform(&rng);
    const double cf = cos(phi), sf = sin(phi);
    const double ct = cos(theta), st = sin(theta);
    const double cp = cos(psi), sp = sin(psi);
    v3_set(rotation[0], cp * cf - ct * sf * sp, cp * sf + ct * cf * sp, sp * st);
    v3_set(rotation[1], -sp * cf - ct * sf * cp, -sp * sf + ct * cf * cp, cp * st);
    v3_set(rotation[2], st * sf, -st * cf, ct);
}

static clast_status add_span(span_list *list, double low, double high)
{
    const clast_status status =
        clx_grow(&list->item, &list->capacity, list->n + 1, sizeof *list->item);
    if (status == CLAST_OK) {
        list->item[list->n++] = (span){low, high};
    }
    return status;
}

/// Places where a sphere at `from` (s = 0) intersects a placed one: within the sum of the radii,
/// but not inside one another, which the engines do not count.
static clast_status add_pair(const march_ray *ray, const double from[3], double radius,
                             const clx_march_sphere *other, span_list *list)
{
    double to[3];
    v3_sub(to, other->centre, from);
    const double middle = v3_dot(to, ray->direction);
    const double off2 = v3_norm2(to) - middle * middle;
    const double sum = radius + other->radius;
    const double hole = radius - other->radius;
    if (off2 > sum * sum) {
        return CLAST_OK;
    }
    const double half = sqrt(sum * sum - fmax(0.0, off2));
    if (off2 >= hole * hole) {
        return add_span(list, middle - half, middle + half);
    }
    const double inner = sqrt(hole * hole - fmax(0.0, off2));
    const clast_status status = add_span(list, middle - half, middle - inner);
    return status != CLAST_OK ? status : add_span(list, middle + inner, middle + half);
}

/// Spheres of a particle at s = 0 (its centroid at P_e) against all that its ray can meet.
static clast_status find_spans(const marching *m, const march_ray *ray, double rotation[3][3],
                               double scale, span_list *list)
{
    CLAST_ASSERT(scale > 0.0 && ray->shape + 1 < m->march->n_shape);
    clast_status status = CLAST_OK;
    const clx_march *march = m->march;
    const clx_march_shape *shape = &march->shape[1 + ray->shape];
    double start[3];
    v3_axpy(start, ray->origin, ray->outermost, ray->direction);
    list->n = 0;
    for (int32_t g = 0; g < march->n_grain; ++g) {
        const clx_march_grain *grain = &march->grain[g];
        const double contact_distance = (grain->radius + scale * shape->radius) * (1.0 + 1e-12);
        double to[3];
        v3_sub(to, grain->centre, start);
        const double along = v3_dot(to, ray->direction);
        if (v3_norm2(to) - along * along > contact_distance * contact_distance) {
            continue;
        }
        for (int32_t i = 0; i < shape->spheres.n; ++i) {
            double from[3];
            m3_to_world(to, rotation, shape->spheres.centre[i]);
            v3_axpy(from, start, scale, to);
            for (int32_t k = 0; k < grain->n; ++k) {
                CLX_TRY(add_pair(ray, from, scale * shape->spheres.radius[i],
                                 &march->sphere[grain->first + k], list));
            }
        }
    }
done:
    return status;
}

static bool intersects(const span_list *list, double s)
{
    for (int64_t i = 0; i < list->n; ++i) {
        if (list->item[i].low <= s && s <= list->item[i].high) {
            return true;
        }
    }
    return false;
}

/// Inward while free, then outward while intersecting; the k-th step is k times the constant.
static double march_along(const clx_march *march, double length, const span_list *list, bool *lost)
{
    CLAST_ASSERT(length >= 0.0);
    const int32_t limit = march->params->march_steps;
    double s = march->start * length;
    int32_t k = 0;
    while (!intersects(list, s) && k < limit) {
        s -= march->coarse * length * ++k;
    }
    *lost = k == limit;
    k = 0;
    while (intersects(list, s) && k < limit) {
        s += march->fine * length * ++k;
    }
    *lost = *lost || k == limit;
    return s;
}

static clast_status run_trial(const marching *m, int64_t trial, span_list *list,
                              clx_march_placement *placement)
{
    const march_ray *ray = &m->ray[trial / m->march->params->orientations];
    const double scale = clx_march_scale(m->march, ray->length, ray->shape);
    double rotation[3][3];
    draw_rotation(m, trial, rotation);
    const clast_status status = find_spans(m, ray, rotation, scale, list);
    if (status == CLAST_OK) {
        *placement = (clx_march_placement){.trial = trial, .shape = ray->shape, .scale = scale};
        const double s = march_along(m->march, ray->length, list, &placement->lost);
        v3_axpy(placement->centroid, ray->origin, ray->outermost + s, ray->direction);
        placement->distance = v3_norm(placement->centroid);
        q_from_matrix(placement->orientation, rotation);
    }
    return status;
}

static clast_status run_trials(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_status status = CLAST_OK;
    (void)worker;
    marching *m = context;
    span_list list = {0};
    for (int64_t trial = begin; trial < end; ++trial) {
        CLX_TRY(run_trial(m, trial, &list, &m->placement[trial]));
    }
done:
    clx_free(list.item);
    return status;
}

/// Grain whose spheres come nearest to the placed particle's, and the point between them.
static void find_touched(const clx_march *march, clx_march_placement *placement)
{
    const clx_march_shape *shape = &march->shape[1 + placement->shape];
    double best = HUGE_VAL;
    double m[3][3];
    q_matrix(m, placement->orientation);
    for (int32_t g = 0; g < march->n_grain; ++g) {
        const clx_march_grain *grain = &march->grain[g];
        if (v3_distance(grain->centre, placement->centroid) - grain->radius -
                placement->scale * shape->radius >
            best) {
            continue;
        }
        for (int32_t i = 0; i < shape->spheres.n; ++i) {
            const double r = placement->scale * shape->spheres.radius[i];
            double c[3];
            m3_to_world(c, m, shape->spheres.centre[i]);
            v3_axpy(c, placement->centroid, placement->scale, c);
            for (int32_t k = 0; k < grain->n; ++k) {
                const clx_march_sphere *s = &march->sphere[grain->first + k];
                const double gap = v3_distance(c, s->centre) - r - s->radius;
                if (gap < best) {
                    double to[3];
                    best = gap;
                    placement->touched = g;
                    v3_sub(to, s->centre, c);
                    v3_axpy(placement->point, c, (r + 0.5 * gap) / (r + gap + s->radius), to);
                }
            }
        }
    }
}

clast_status clx_march_run(const clx_march *march, const clx_aim *aim, double size,
                           clx_march_placement *placement)
{
    CLAST_ASSERT(size > 0.0 && march->n_grain > 0);
    clast_status status = CLAST_OK;
    const clast_aggregate_params *c = march->params;
    const int64_t n_trial = (int64_t)c->rays * c->orientations;
    marching m = {.march = march, .aim = aim, .size = size};
    int64_t best = 0;
    CLX_TRY(clx_alloc(&m.ray, c->rays, sizeof *m.ray));
    CLX_TRY(clx_alloc(&m.placement, n_trial, sizeof *m.placement));
    for (int32_t i = 0; i < c->rays; ++i) {
        make_ray(&m, i, &m.ray[i]);
    }
    CLX_TRY(clx_parallel_try(n_trial, 4, run_trials, &m));
    for (int64_t i = 1; i < n_trial; ++i) {
        best = m.placement[i].distance < m.placement[best].distance ? i : best;
    }
    *placement = m.placement[best];
    find_touched(march, placement);
done:
    CLX_FREE(m.ray, m.placement);
    return status;
}
