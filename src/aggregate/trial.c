// One particle's search.
//
// A trial is a ray and an orientation; its outcome is a pure function of (seed, particle, trial).
// Trials run in any order on any number of threads. The best distance so far is shared only to cut
// short trials that are certainly worse: a trial is abandoned when it must end more than ROUNDING
// beyond the best, so the winner, with ties to the lower trial number, is always the same.
//
// Rays are scouted first: the largest sphere about the particle's centre that lies within it goes
// as far as any orientation can, so its placement bounds all trials of a ray from below. Rays are
// tried from the most promising on, and a ray that cannot win is skipped. EJ15 tight (30 rays of
// 10 orientations): 0.26 s instead of 0.62.
#include "aggregate/trial.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "math/rng.h"
#include "math/sort.h"
#include "math/vec3.h"
#include "touch/tree.h"
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

/// Margin of the bound, in units of the numbers it is made of.
static const double ROUNDING = 1e-9;

/// Lines over the cross-section, or walks from far away, for each of max_tries: most of them miss.
enum { LINES_A_TRY = 1000 };

typedef struct {
    int64_t number;
    double origin[3], direction[3];
    double t_low;
    double least; ///< distance to the target that no orientation on this ray falls below
    double rank;  ///< rays of low rank are tried first
} ray;

typedef struct {
    const clx_search *search;
    ray *rays;             ///< [aim.n_ray] in the order of trying
    int64_t n_orientation; ///< that differ
    atomic_flag lock;      ///< of best
    clx_placement best;
    _Atomic double bound; ///< best distance so far, readable without the lock
} race;

/// Centre of the k-th sphere of all composites, in the world.
static void sphere_centre(const clx_search *s, int64_t k, double centre[3])
{
    CLAST_ASSERT(k >= 0 && k < s->sphere_end[s->n_body - 1]);
    int32_t low = 0;
    int32_t high = s->n_body - 1;
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (s->sphere_end[middle] > k) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    const clx_touch_body *body = clx_touch_scene_body(s->scene, low);
    const int64_t local = k - (low > 0 ? s->sphere_end[low - 1] : 0);
    v3_copy(centre, body->position);
    if (body->tree != NULL) {
        for (int i = 0; i < 3; ++i) {
            centre[i] += body->scale * v3_dot(&body->rotation[3 * i], body->tree->ball[local]);
        }
    }
}

static void draw_origin(const clx_search *s, int64_t number, double origin[3])
{
    const int32_t n = s->n_body;
    clx_rng rng = clx_rng_at(s->aim.seed, CLX_STREAM_AGGREGATE_ORIGIN,
                             clx_aim_index(&s->aim, number, s->aim.n_ray));
    if (s->origin == CLAST_ORIGIN_GRAIN) {
        const int32_t pick = (int32_t)clx_rng_below(&rng, n);
        v3_copy(origin, clx_touch_scene_body(s->scene, pick)->position);
    } else if (s->origin == CLAST_ORIGIN_SPHERE) {
        sphere_centre(s, clx_rng_below(&rng, s->sphere_end[n - 1]), origin);
    } else {
        v3_copy(origin, s->centre);
    }
}

/// A point of the disc across the ray that holds everything there and half the particle around it:
/// impact parameters are even over the cross-section once lines that meet nothing are drawn again.
static void draw_impact(const clx_search *s, int64_t number, const double direction[3],
                        double origin[3])
{
    double side[2][3];
    clx_rng rng = clx_rng_at(s->aim.seed, CLX_STREAM_AGGREGATE_OFFSET,
                             clx_aim_index(&s->aim, number, s->aim.n_ray));
    const double bounding_radius = s->bounding_radius + s->scale * s->group->radius;
    const double b = bounding_radius * sqrt(clx_rng_uniform(&rng));
    const double angle = 2.0 * CLAST_PI * clx_rng_uniform(&rng);
    v3_frame(direction, side[0], side[1]);
    v3_axpy(origin, s->centre, b * cos(angle), side[0]);
    v3_axpy(origin, origin, b * sin(angle), side[1]);
}

/// Start of the move: at `start` sizes beyond the last hit of the ray, or from outside of all.
static double start_of(const clx_search *s, const clx_touch_path *path, const double origin[3])
{
    if (!(s->start > 0.0)) {
        return -HUGE_VAL;
    }
    clx_touch hit;
    clx_touch_body point = clx_touch_body_sphere(ROUNDING * s->size);
    clx_touch_body_place(&point, origin, (const double[4]){1.0, 0.0, 0.0, 0.0}, 1.0);
    return clx_touch_scene_first_among(s->scene, s->n_body, &point, path, &hit)
               ? hit.t - s->start * s->size
               : -HUGE_VAL;
}

/// The foot of the target on a ray: the distance to the target at s is sqrt(h2 + (s - b)^2).
static void foot_of(const clx_search *s, const ray *r, double *b, double *h2)
{
    double to[3];
    v3_sub(to, s->target, r->origin);
    *b = v3_dot(to, r->direction);
    *h2 = fmax(0.0, v3_norm2(to) - *b * *b);
}

/// How near the target the group's inner sphere comes on this ray.
static void scout(const clx_search *s, const clx_touch_path *path, ray *r)
{
    clx_touch hit;
    double b;
    double h2;
    clx_touch_body ball = clx_touch_body_sphere(s->scale * s->group->inner);
    clx_touch_body_place(&ball, r->origin, (const double[4]){1.0, 0.0, 0.0, 0.0}, 1.0);
    r->rank = HUGE_VAL;
    if (clx_touch_scene_first_among(s->scene, s->n_body, &ball, path, &hit)) {
        foot_of(s, r, &b, &h2);
        const double beyond = fmax(0.0, -hit.t - b);
        r->rank = sqrt(h2 + beyond * beyond);
        r->least = hit.overlap ? 0.0 : r->rank;
    }
}

/// A scout costs about as much as a trial of the same kind of body.
static bool is_scouted(const clx_search *s)
{
    return s->group->inner > 0.0 && !s->group->is_round && s->aim.n_ray > 1;
}

static void make_ray(const clx_search *s, int64_t number, ray *r)
{
    double back[3];
    *r = (ray){.number = number};
    clx_aim_direction(&s->aim, number, r->direction);
    if (s->approach == CLAST_APPROACH_BALLISTIC) {
        draw_impact(s, number, r->direction, r->origin);
    } else {
        draw_origin(s, number, r->origin);
    }
    v3_scale(back, -1.0, r->direction);
    clx_touch_path path = clx_touch_path_along(back);
    path.t_low = r->t_low = start_of(s, &path, r->origin);
    if (is_scouted(s)) {
        scout(s, &path, r);
    }
}

static void make_rays(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const race *all = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        make_ray(all->search, i, &all->rays[i]);
    }
}

CLX_RISING_BY_TWO(by_rank, ray, rank, number)

/// Margin that covers rounding in distances and places along a ray.
static double margin_of(const clx_search *s, double best)
{
    CLAST_ASSERT(best >= 0.0);
    return ROUNDING * (s->scale * s->group->radius + best);
}

/// Where along the ray the particle certainly loses: beyond b + sqrt(best^2 - h2).
static double losing_place(const clx_search *s, const ray *r, double best)
{
    CLAST_ASSERT(best >= 0.0);
    double b;
    double h2;
    foot_of(s, r, &b, &h2);
    const double margin = margin_of(s, best);
    const double bounding_radius = best + margin;
    return isfinite(best) ? b + sqrt(fmax(0.0, bounding_radius * bounding_radius - h2)) + margin
                          : HUGE_VAL;
}

bool clx_search_fly(const clx_search *s, const double origin[3], const double orientation[4],
                    const clx_touch_path *path, clx_placement *placement)
{
    CLAST_ASSERT(q_is_unit(orientation, 1e-9) && s->scale > 0.0 && s->group->n_part > 0);
    clx_touch_path rest = *path;
    bool found = false;
    for (int32_t i = 0; i < s->group->n_part; ++i) {
        clx_template_part placed;
        clx_touch touch;
        clx_template_pose(s->group, i, origin, orientation, s->scale, &placed);
        clx_touch_body body = s->templates->shape[placed.shape].body;
        clx_touch_body_place(&body, placed.position, placed.orientation, placed.scale);
        if (!clx_touch_scene_first_among(s->scene, s->n_body, &body, &rest, &touch)) {
            continue;
        }
        if (touch.beaten) {
            return false;
        }
        if (!found || touch.t < placement->touch.t) {
            found = true;
            placement->touch = touch;
            placement->part = i;
            rest.t_high = touch.t;
        }
    }
    return found;
}

static bool attempt_trial(const clx_search *s, const ray *r, int64_t trial, double bound,
                          clx_placement *placement)
{
    CLAST_ASSERT(trial >= 0);
    double back[3];
    v3_scale(back, -1.0, r->direction);
    clx_touch_path path = clx_touch_path_along(back);
    const int64_t n_trial = (int64_t)s->aim.n_ray * s->n_orientation;
    clx_rng rng = clx_rng_at(s->aim.seed, CLX_STREAM_AGGREGATE_ORIENTATION,
                             clx_aim_index(&s->aim, trial, n_trial));
    clx_rng_orientation(&rng, placement->orientation);
    q_unit(placement->orientation);
    path.t_low = r->t_low;
    path.t_enough = -losing_place(s, r, bound);
    bool found = clx_search_fly(s, r->origin, placement->orientation, &path, placement);
    if (found && placement->touch.overlap) {
        path.t_low = -HUGE_VAL; // the start lies inside a side branch: come from outside of all
        found = clx_search_fly(s, r->origin, placement->orientation, &path, placement);
    }
    placement->found = found;
    placement->trial = trial;
    if (found) {
        placement->along = -placement->touch.t;
        v3_copy(placement->origin, r->origin);
        v3_copy(placement->direction, r->direction);
        v3_axpy(placement->centre, r->origin, placement->along, r->direction);
        placement->distance = v3_distance(placement->centre, s->target);
    }
    return found;
}

static bool is_better(const clx_placement *a, const clx_placement *b)
{
    if (!a->found || !b->found) {
        return a->found;
    }
    return a->distance < b->distance || (a->distance == b->distance && a->trial < b->trial);
}

/// Keeps the better of two placements; a total order, so the last one standing is always the same.
static void keep_placement(race *all, const clx_placement *placement)
{
    while (atomic_flag_test_and_set_explicit(&all->lock, memory_order_acquire)) {
    }
    if (is_better(placement, &all->best)) {
        all->best = *placement;
        atomic_store_explicit(&all->bound, placement->distance, memory_order_relaxed);
    }
    atomic_flag_clear_explicit(&all->lock, memory_order_release);
}

static void run_trial(race *all, int64_t i)
{
    const clx_search *s = all->search;
    clx_placement placement = {0};
    const ray *r = &all->rays[i / all->n_orientation];
    const int64_t trial = r->number * s->n_orientation + i % all->n_orientation;
    const double bound = atomic_load_explicit(&all->bound, memory_order_relaxed);
    if (r->least <= bound + margin_of(s, bound) && attempt_trial(s, r, trial, bound, &placement) &&
        placement.distance <= bound) {
        keep_placement(all, &placement);
    }
}

/// What is done beside comes first: its pieces are long, and threads must not wait for the last.
static void run_trials(int64_t begin, int64_t end, int32_t worker, void *context)
{
    race *all = context;
    const clx_beside *beside = &all->search->beside;
    for (int64_t i = begin; i < end; ++i) {
        if (i < beside->n_piece) {
            beside->work(i, i + 1, worker, beside->context);
        } else {
            run_trial(all, i - beside->n_piece);
        }
    }
}

int32_t clx_search_tries(const clast_aggregate_params *params)
{
    return params->approach == CLAST_APPROACH_CENTRAL ? params->max_tries
                                                      : LINES_A_TRY * params->max_tries;
}

const char *clx_search_paths(const clx_search *search)
{
    return search->approach == CLAST_APPROACH_DIFFUSIVE   ? "walks"
           : search->approach == CLAST_APPROACH_BALLISTIC ? "lines over the cross-section"
                                                          : "axes";
}

clast_status clx_search_run(const clx_search *search, clx_placement *best)
{
    CLAST_ASSERT(search->aim.n_ray > 0 && search->n_orientation > 0);
    clast_status status = CLAST_OK;
    const int64_t n_ray = search->aim.n_ray;
    race all = {.search = search,
                .n_orientation = search->group->is_round ? 1 : search->n_orientation,
                .lock = ATOMIC_FLAG_INIT};
    atomic_init(&all.bound, HUGE_VAL);
    CLX_TRY(clx_alloc(&all.rays, n_ray, sizeof *all.rays));
    const int64_t n_item = search->beside.n_piece + n_ray * all.n_orientation;
    const bool alone = search->on_one_thread;
    clx_parallel_for(n_ray, is_scouted(search) && !alone ? 1 : n_ray, make_rays, &all);
    if (is_scouted(search)) {
        qsort(all.rays, (size_t)n_ray, sizeof *all.rays, by_rank);
    }
    clx_parallel_for(n_item, alone ? n_item : 1, run_trials, &all);
    *best = all.best;
done:
    clx_free(all.rays);
    return status;
}

double clx_search_overlap(const clx_search *search, const clx_placement *placement)
{
    double back[3];
    const double size = search->scale * search->group->radius;
    v3_scale(back, -1.0, placement->direction);
    clx_touch_path path = clx_touch_path_along(back);
    clx_placement again;
    double step = 0.0;
    while (step < 4.0 * size) {
        path.t_low = -(placement->along + step);
        path.t_high = path.t_low;
        if (!clx_search_fly(search, placement->origin, placement->orientation, &path, &again) ||
            !again.touch.overlap) {
            return step;
        }
        step = step > 0.0 ? 4.0 * step : 1e-15 * size;
    }
    return HUGE_VAL;
}
