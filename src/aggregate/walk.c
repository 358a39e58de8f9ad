// Diffusion-limited aggregation, off any lattice [Witten1981; clusters: Meakin1983, Kolb1983].
//
// Far from everything Brownian motion is not followed step by step. A ball that holds nothing is
// left at a point even on its surface [Muller1956], so a step is as long as the gap to the nearest
// surface, and `walk_step` where that is less; only such short steps can end in a touch, whose
// place is exact. From outside the sphere about all that is there a walk comes back with the chance
// (radius / distance), at a point drawn from Poisson's kernel; else it is gone to infinity and
// another begins even on the sphere. So the sphere may lie close about the aggregate, and nothing
// is cut off.
//
// Nothing turns on its way: each walk has one orientation, even over SO(3).
#include "aggregate/walk.h"

#include "base/status.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <clast/shape.h>
#include <math.h>

typedef struct {
    const clx_search *search;
    clx_rng rng;
    double outer; ///< radius of the sphere where walks begin
    double least; ///< least step
    double x[3];  ///< centre of mass
    double orientation[4];
} walk;

/// Radius of the smallest part, by its bounding sphere.
static double smallest_part(const clx_search *s)
{
    CLAST_ASSERT(s->group->n_part > 0);
    double least = HUGE_VAL;
    for (int32_t i = 0; i < s->group->n_part; ++i) {
        const clx_template_part *part = &s->group->part[i];
        least = fmin(least, s->scale * part->scale *
                                s->templates->shape[part->shape].shape->bounding_radius);
    }
    return least;
}

static void begin(walk *w)
{
    double direction[3];
    clx_rng_direction(&w->rng, direction);
    v3_axpy(w->x, w->search->centre, w->outer, direction);
    clx_rng_orientation(&w->rng, w->orientation);
    q_unit(w->orientation);
}

/// From outside the sphere: back onto it, or (false) away for ever. Poisson's kernel of the
/// exterior, cos theta by its inverse distribution.
static bool come_back(walk *w)
{
    CLAST_ASSERT(w->outer >= 0.0);
    double out[3];
    double side[2][3];
    v3_sub(out, w->x, w->search->centre);
    const double distance = v3_norm(out);
    const double q = w->outer / distance;
    if (q >= 1.0) {
        return true;
    }
    if (clx_rng_uniform(&w->rng) > q) {
        return false;
    }
    const double u = clx_rng_uniform(&w->rng);
    const double angle = 2.0 * CLAST_PI * clx_rng_uniform(&w->rng);
    const double part = (1.0 - q * q) / (1.0 - q + 2.0 * q * u);
    const double c = fmax(-1.0, fmin(1.0, (1.0 + q * q - part * part) / (2.0 * q)));
    const double s = sqrt(1.0 - c * c);
    v3_scale(out, 1.0 / distance, out);
    v3_frame(out, side[0], side[1]);
    v3_axpy(w->x, w->search->centre, w->outer * c, out);
    v3_axpy(w->x, w->x, w->outer * s * cos(angle), side[0]);
    v3_axpy(w->x, w->x, w->outer * s * sin(angle), side[1]);
    return true;
}

/// A distance that the group may move in any direction without a touch; may be 0 or less.
static double clearance(const walk *w)
{
    const clx_search *s = w->search;
    const double radius = s->scale * s->group->radius;
    const double whole = clx_touch_scene_clearance(s->scene, w->x, HUGE_VAL) - radius;
    if (s->group->n_part == 1 || whole > 0.5 * radius) {
        return whole;
    }
    double least = HUGE_VAL;
    for (int32_t i = 0; i < s->group->n_part; ++i) {
        clx_template_part placed;
        clx_template_pose(s->group, i, w->x, w->orientation, s->scale, &placed);
        const double r = placed.scale * s->templates->shape[placed.shape].shape->bounding_radius;
        least = fmin(least, clx_touch_scene_clearance(s->scene, placed.position, least + r) - r);
        if (least < w->least) {
            break; // the step is the least one
        }
    }
    return fmax(least, whole);
}

/// One step; true when it ends in a touch.
static bool step(walk *w, clx_placement *placement)
{
    const clx_search *s = w->search;
    double u[3];
    const double gap = clearance(w);
    clx_rng_direction(&w->rng, u);
    if (gap > w->least) {
        v3_axpy(w->x, w->x, gap, u);
        return false;
    }
    clx_touch_path path = clx_touch_path_along(u);
    path.t_low = 0.0;
    path.t_high = w->least;
    if (!clx_search_fly(s, w->x, w->orientation, &path, placement)) {
        v3_axpy(w->x, w->x, w->least, u);
        return false;
    }
    placement->found = true;
    placement->along = -placement->touch.t;
    v3_copy(placement->origin, w->x);
    v3_scale(placement->direction, -1.0, u);
    v3_axpy(placement->centre, w->x, placement->touch.t, u);
    for (int k = 0; k < 4; ++k) {
        placement->orientation[k] = w->orientation[k];
    }
    placement->distance = v3_distance(placement->centre, s->target);
    return true;
}

/// The placement of one Brownian walk that came from infinity; walks that escape are begun again
/// and counted in aim.attempt. Not found: aim.attempt reached `tries`.
///
/// Follows from (seed, particle) alone. @note no allocation, one thread
static void run_walk(clx_search *search, int32_t tries, clx_placement *placement)
{
    CLAST_ASSERT(tries > 0 && search->walk_step > 0.0);
    walk w = {.search = search};
    w.least = search->walk_step * smallest_part(search);
    w.outer =
        (search->bounding_radius + search->scale * search->group->radius) * (1.0 + 1e-12) + w.least;
    w.rng = clx_rng_at(search->aim.seed, CLX_STREAM_AGGREGATE_WALK, (uint64_t)search->aim.particle);
    *placement = (clx_placement){0};
    for (search->aim.attempt = 0; search->aim.attempt < tries; ++search->aim.attempt) {
        begin(&w);
        while (come_back(&w)) {
            if (step(&w, placement)) {
                return;
            }
        }
    }
}

clast_status clx_walk_or_search(clx_search *search, int32_t tries, clx_placement *placement)
{
    clast_status status = CLAST_OK;
    if (search->approach == CLAST_APPROACH_DIFFUSIVE) {
        run_walk(search, tries, placement);
        return CLAST_OK;
    }
    do {
        CLX_TRY(clx_search_run(search, placement));
        search->beside = (clx_beside){0}; // done by the first search
    } while (!placement->found && ++search->aim.attempt < tries);
done:
    return status;
}
