// A pair becomes one aggregate: the smaller comes to the larger by a path of the configured kind
// and stays where the true surfaces first touch, in the search of clast aggregate's cluster mode.
//
// Nothing turns on its way; the smaller has an orientation even over SO(3), and directions are even
// too. The aggregate then stands where one of the two was, with chances as their masses, so that
// the mass keeps its place in the mean. [docs/theory/evolve.md section 4]
#include "evolve/state.h"

#include "aggregate/trial.h"
#include "aggregate/walk.h"
#include "base/alloc.h"
#include "math/vec3.h"
#include "touch/scene.h"
#include <math.h>

/// A body of grains as a scene or a group: which grain each part is of.
typedef struct {
    int32_t n;
    clx_template_part *part;
    int32_t *grain;
} parts;

static void free_parts(parts *p)
{
    CLX_FREE(p->part, p->grain);
    *p = (parts){0};
}

static clast_status parts_of(const clast_evolve *e, const clx_evolve_body *body, parts *p)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    for (int32_t g = body->first; g >= 0; g = e->grain[g].next) {
        n += e->templates.group[1 + e->grain[g].kind].n_part;
    }
    CLX_TRY(clx_alloc(&p->part, n, sizeof *p->part));
    CLX_TRY(clx_alloc(&p->grain, n, sizeof *p->grain));
    for (int32_t g = body->first; g >= 0; g = e->grain[g].next) {
        const clx_evolve_grain *grain = &e->grain[g];
        const clx_template *group = &e->templates.group[1 + grain->kind];
        for (int32_t i = 0; i < group->n_part; ++i) {
            clx_template_pose(group, i, grain->position, grain->orientation, grain->scale,
                              &p->part[p->n]);
            p->grain[p->n++] = g;
        }
    }
done:
    return status;
}

static clast_status scene_of(const clast_evolve *e, const parts *p, clx_touch_scene **scene)
{
    clast_status status = CLAST_OK;
    clx_touch_scene *made = NULL;
    CLX_TRY(clx_touch_scene_create(&made));
    for (int32_t i = 0; i < p->n; ++i) {
        const clx_template_part *part = &p->part[i];
        clx_touch_body body = e->templates.shape[part->shape].body;
        clx_touch_body_place(&body, part->position, part->orientation, part->scale);
        CLX_TRY(clx_touch_scene_insert(made, &body));
    }
    *scene = made;
    made = NULL;
done:
    clx_touch_scene_destroy(made);
    return status;
}

/// Axes tried on central lines, lines over the cross-section, walks, or contacts.
static int32_t tries_of(const clast_evolve *e)
{
    enum { LINES_A_TRY = 1000 };
    return e->meeting == CLAST_MEETING_CENTRAL ? e->config->max_tries
                                               : LINES_A_TRY * e->config->max_tries;
}

static clast_status search(const clast_evolve *e, const clx_evolve_body *large,
                           const clx_touch_scene *scene, const clx_template *group,
                           clx_placement *placement)
{
    static const int32_t approach[] = {[CLAST_MEETING_BALLISTIC] = CLAST_APPROACH_BALLISTIC,
                                       [CLAST_MEETING_DIFFUSIVE] = CLAST_APPROACH_DIFFUSIVE,
                                       [CLAST_MEETING_CENTRAL] = CLAST_APPROACH_CENTRAL};
    CLAST_ASSERT(e->meeting != CLAST_MEETING_AUTO && e->n_event < UINT32_MAX);
    clast_status status = CLAST_OK;
    const int32_t tries = tries_of(e);
    if (e->meeting == CLAST_MEETING_REACTION) {
        return clx_evolve_react(e, scene, group, tries, placement);
    }
    clx_search s = {.templates = &e->templates,
                    .group = group,
                    .scale = 1.0,
                    .size = 2.0 * group->radius,
                    .scene = scene,
                    .n_body = clx_touch_scene_count(scene),
                    .origin = CLAST_ORIGIN_MASS,
                    .aim = {.seed = e->config->seed,
                            .particle = e->n_event,
                            .n_ray = 1,
                            .random_axis = true,
                            .cone = CLAST_PI},
                    .n_orientation = 1,
                    .approach = approach[e->meeting],
                    .bounding_radius = large->bounding_radius,
                    .walk_step = e->config->walk_step,
                    .on_one_thread = true};
    CLX_TRY(clx_walk_or_search(&s, tries, placement));
    CLX_CHECK(placement->found, CLAST_E_CONVERGE,
              "event %lld: all of %d %s miss the larger of the pair; raise max_tries%s",
              (long long)e->n_event + 1, tries, clx_search_paths(&s),
              e->meeting == CLAST_MEETING_CENTRAL ? ", or take meeting: ballistic" : "");
done:
    return status;
}

/// Second moments about the common centre; `apart` is from the larger's centre to the smaller's.
static void combine(const clx_evolve_body *small, const double orientation[4],
                    const double apart[3], clx_evolve_body *large)
{
    static const int row[6] = {0, 1, 2, 1, 0, 0};
    static const int column[6] = {0, 1, 2, 2, 2, 1};
    const double mass = large->mass + small->mass;
    const double share = small->mass / mass;
    const double *s = small->second;
    double m[3][3] = {{s[0], s[5], s[4]}, {s[5], s[1], s[3]}, {s[4], s[3], s[2]}};
    double r[3][3];
    q_matrix(r, orientation);
    for (int k = 0; k < 6; ++k) {
        double turned = 0.0;
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                turned += r[row[k]][a] * m[a][b] * r[column[k]][b];
            }
        }
        large->second[k] = (1.0 - share) * large->second[k] + share * turned +
                           share * (1.0 - share) * apart[row[k]] * apart[column[k]];
    }
}

/// Where the grains touch, in the frame of the first of them.
static void note_contact(const clast_evolve *e, const clx_placement *placement, int32_t touched,
                         int32_t arriving, clx_evolve_event *event)
{
    const clx_evolve_grain *grain = &e->grain[touched];
    const double *q = grain->orientation;
    const double back[4] = {q[0], -q[1], -q[2], -q[3]};
    v3_sub(event->point, placement->touch.point, grain->position);
    q_rotate(event->point, back, event->point);
    event->contact[0] = touched;
    event->contact[1] = arriving;
}

/// The smaller's grains take their poses about the larger, and all move to the common centre.
static void place_grains(clast_evolve *e, clx_evolve_body *large, const clx_evolve_body *small,
                         const clx_placement *placement)
{
    double shift[3];
    v3_scale(shift, small->mass / (large->mass + small->mass), placement->centre);
    for (int32_t g = small->first; g >= 0; g = e->grain[g].next) {
        clx_evolve_grain *grain = &e->grain[g];
        q_rotate(grain->position, placement->orientation, grain->position);
        v3_add(grain->position, placement->centre, grain->position);
        q_mul(grain->orientation, placement->orientation,
              (const double[4]){grain->orientation[0], grain->orientation[1], grain->orientation[2],
                                grain->orientation[3]});
        q_unit(grain->orientation);
    }
    e->grain[large->last].next = small->first;
    large->last = small->last;
    large->bounding_radius = 0.0;
    for (int32_t g = large->first; g >= 0; g = e->grain[g].next) {
        clx_evolve_grain *grain = &e->grain[g];
        v3_sub(grain->position, grain->position, shift);
        large->bounding_radius =
            fmax(large->bounding_radius,
                 v3_norm(grain->position) + grain->scale * e->kind[grain->kind].bounding_radius);
    }
}

static clast_status touch(clast_evolve *e, clx_evolve_body *large, clx_evolve_body *small,
                          clx_evolve_event *event)
{
    clast_status status = CLAST_OK;
    parts there = {0};
    parts coming = {0};
    clx_touch_scene *scene = NULL;
    clx_placement placement = {0};
    CLX_TRY(parts_of(e, large, &there));
    CLX_TRY(parts_of(e, small, &coming));
    CLX_TRY(scene_of(e, &there, &scene));
    const bool is_ball =
        coming.n == 1 && e->templates.shape[coming.part[0].shape].body.kind == CLX_TOUCH_SPHERE;
    const clx_template group = {.n_part = coming.n,
                                .part = coming.part,
                                .volume = small->volume,
                                .mass = small->mass,
                                .radius = small->bounding_radius,
                                .is_round = is_ball};
    CLX_TRY(search(e, large, scene, &group, &placement));
    note_contact(e, &placement, there.grain[placement.touch.body], coming.grain[placement.part],
                 event);
    combine(small, placement.orientation, placement.centre, large);
    place_grains(e, large, small, &placement);
done:
    clx_touch_scene_destroy(scene);
    free_parts(&there);
    free_parts(&coming);
    return status;
}

/// Two drops: one sphere of their volume.
static void merge_drops(clast_evolve *e, clx_evolve_body *large, const clx_evolve_body *small,
                        clx_evolve_event *event)
{
    const double radius = cbrt(0.75 * (large->volume + small->volume) / CLAST_PI);
    e->grain[large->last].next = small->first;
    large->last = small->last;
    large->bounding_radius = radius;
    for (int k = 0; k < 6; ++k) {
        large->second[k] = k < 3 ? 0.2 * radius * radius : 0.0;
    }
    event->contact[0] = event->contact[1] = -1;
}

/// Numbers of what has become of the pair.
static void finish(clast_evolve *e, clx_evolve_body *large, clx_evolve_body *small, bool at_small)
{
    large->mass += small->mass;
    large->volume += small->volume;
    large->n += small->n;
    if (at_small) {
        v3_copy(large->x, small->x);
    }
    small->state = CLX_BODY_MERGED;
    clx_evolve_update(e, large);
}

clast_status clx_evolve_join(clast_evolve *e, int32_t i, int32_t j, double time, clx_rng *rng)
{
    CLAST_ASSERT(i != j && e->body[i].state == CLX_BODY_IN_FLUID &&
                 e->body[j].state == CLX_BODY_IN_FLUID);
    clast_status status = CLAST_OK;
    const bool is_first = e->body[i].n > e->body[j].n || (e->body[i].n == e->body[j].n && i < j);
    clx_evolve_body *large = &e->body[is_first ? i : j];
    clx_evolve_body *small = &e->body[is_first ? j : i];
    const double chance = small->mass / (small->mass + large->mass);
    CLX_TRY(clx_grow(&e->event, &e->event_capacity, e->n_event + 1, sizeof *e->event));
    clx_evolve_event event = {
        .time = time, .node = {large->node, small->node}, .body = (int32_t)(large - e->body)};
    if (e->config->structure) {
        CLX_TRY(touch(e, large, small, &event));
    } else {
        merge_drops(e, large, small, &event);
    }
    finish(e, large, small, clx_rng_uniform(rng) < chance);
    large->node = e->n_start + e->n_event;
    large->time = time;
    small->time = time;
    event.n = large->n;
    event.mass = large->mass;
    event.gyration = large->gyration;
    event.envelope = large->envelope;
    event.speed = large->speed;
    v3_copy(event.x, large->x);
    e->event[e->n_event++] = event;
done:
    return status;
}
