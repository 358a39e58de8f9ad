// Reaction-limited meeting: two bodies touch many times before they stick, so that of all the ways
// in which their surfaces can touch without overlap each is as likely [Brown1985].
//
// A pair of parts is drawn with a weight as the square of the sum of their radii, and a line that
// is even in direction and over the disc of that radius; where the two touch along it is then even
// over the surface of contact (of convex parts). A contact at which other parts overlap is dropped
// and another drawn. [docs/theory/evolve.md section 4]
#include "evolve/state.h"

#include "aggregate/trial.h"
#include "math/vec3.h"

static const double BACK = 1e-11; ///< of the parts' radii: from where overlap of others is asked

typedef struct {
    const clx_templates *templates;
    const clx_touch_scene *scene;
    const clx_template *group;
    clx_rng rng;
    double most; ///< greatest sum of the radii of a pair
} reaction;

/// Part i of the group with its centre there.
static clx_touch_body part_at(const reaction *r, int32_t i, const double centre[3],
                              const double orientation[4])
{
    clx_template_part placed;
    clx_template_pose(r->group, i, centre, orientation, 1.0, &placed);
    clx_touch_body body = r->templates->shape[placed.shape].body;
    clx_touch_body_place(&body, placed.position, placed.orientation, placed.scale);
    return body;
}

static double radius_of(const reaction *r, int32_t i)
{
    const clx_template_part *part = &r->group->part[i];
    return part->scale * r->templates->shape[part->shape].body.radius;
}

static double greatest_sum(const reaction *r)
{
    double lying = 0.0;
    double coming = 0.0;
    for (int32_t i = 0; i < clx_touch_scene_count(r->scene); ++i) {
        lying = fmax(lying, clx_touch_scene_body(r->scene, i)->radius);
    }
    for (int32_t i = 0; i < r->group->n_part; ++i) {
        coming = fmax(coming, radius_of(r, i));
    }
    return lying + coming;
}

/// A part of each, with a weight as the square of the sum of their radii.
static void draw_pair(reaction *r, int32_t *lying, int32_t *coming, double *sum)
{
    double share = 0.0;
    do {
        *lying = (int32_t)clx_rng_below(&r->rng, clx_touch_scene_count(r->scene));
        *coming = (int32_t)clx_rng_below(&r->rng, r->group->n_part);
        *sum = clx_touch_scene_body(r->scene, *lying)->radius + radius_of(r, *coming);
        share = *sum / r->most;
    } while (clx_rng_uniform(&r->rng) > share * share);
}

/// Whether no part of the group with its centre there overlaps anything.
static bool is_free(const reaction *r, const double centre[3], const double orientation[4],
                    clx_touch_path path)
{
    path.t_low = path.t_high = 0.0;
    for (int32_t i = 0; i < r->group->n_part; ++i) {
        clx_touch touch;
        const clx_touch_body body = part_at(r, i, centre, orientation);
        if (clx_touch_scene_first(r->scene, &body, &path, &touch)) {
            return false;
        }
    }
    return true;
}

/// One contact of a pair of parts; false where it is none, or others overlap.
static bool attempt(reaction *r, clx_placement *placement)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    double along[3];
    double place[3];
    double centre[3];
    double sum = 0.0;
    int32_t lying = 0;
    draw_pair(r, &lying, &placement->part, &sum);
    clx_rng_orientation(&r->rng, placement->orientation);
    q_unit(placement->orientation);
    clx_rng_direction(&r->rng, along);
    const double off = sum * sqrt(clx_rng_uniform(&r->rng));
    const double angle = 2.0 * CLAST_PI * clx_rng_uniform(&r->rng);
    const clx_touch_path path = clx_touch_path_along(along);
    const clx_touch_body *there = clx_touch_scene_body(r->scene, lying);
    clx_touch_body part = part_at(r, placement->part, origin, placement->orientation);
    v3_axpy(place, there->position, off * cos(angle), path.side[0]);
    v3_axpy(place, place, off * sin(angle), path.side[1]);
    v3_sub(centre, place, part.position);
    clx_touch_body_move(&part, place);
    if (!clx_first_touch(&part, there, &path, &placement->touch)) {
        return false;
    }
    placement->touch.body = lying;
    v3_axpy(placement->centre, centre, placement->touch.t, along);
    v3_axpy(centre, placement->centre, -BACK * sum, along);
    return is_free(r, centre, placement->orientation, path);
}

clast_status clx_evolve_react(const clast_evolve *e, const clx_touch_scene *scene,
                              const clx_template *group, int32_t tries, clx_placement *placement)
{
    CLAST_ASSERT(clx_touch_scene_count(scene) > 0 && group->n_part > 0);
    clast_status status = CLAST_OK;
    reaction r = {.templates = &e->templates,
                  .scene = scene,
                  .group = group,
                  .rng =
                      clx_rng_at(e->config->seed, CLX_STREAM_EVOLVE_REACT, (uint64_t)e->n_event)};
    r.most = greatest_sum(&r);
    for (int32_t k = 0; k < tries && !placement->found; ++k) {
        placement->found = attempt(&r, placement);
    }
    CLX_CHECK(placement->found, CLAST_E_CONVERGE,
              "event %lld: other grains overlap at all of %d contacts tried; raise max_tries, or "
              "take meeting: diffusive",
              (long long)e->n_event + 1, tries);
done:
    return status;
}
