// Growth on a core: each particle is thrown, lands at its best trial, and stays.
//
// The state is the placed grains and their rows; everything else (trees, sums, envelopes) follows
// from them in the order of placement. That is why a restored run ends in the same bytes.
#include "aggregate/grow.h"

#include "aggregate/config.h"
#include "aggregate/sizes.h"
#include "aggregate/trial.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <clast/bvh.h>
#include <stdio.h>
#include <string.h>

/// The smallest core that a particle may meet, by length.
static const double CORE_SMALLEST = 1e-6;

void clast_aggregate_destroy(clast_aggregate *a)
{
    if (a == NULL) {
        return;
    }
    clx_touch_scene_destroy(a->scene);
    clx_kit_free(&a->kit);
    clast_assembly_free(&a->assembly);
    clx_history_free(&a->history);
    clx_free(a->shape_id);
    clx_free(a->size);
    clx_free(a->sphere_end);
    clx_free(a);
}

static uint64_t seed_of(const clast_aggregate_config *config, int32_t repeat)
{
    if (repeat == 0) {
        return config->seed;
    }
    clx_rng rng = clx_rng_at(config->seed, CLX_STREAM_AGGREGATE_REPEAT, (uint64_t)repeat);
    const uint64_t high = clx_rng_u32(&rng);
    return (high << 32) | clx_rng_u32(&rng);
}

int32_t clx_aggregate_shape(const clast_aggregate *a, int32_t particle)
{
    return clx_sizes_shape(a->config, a->seed, particle, a->size[particle]);
}

double clx_aggregate_scale(const clast_aggregate *a, int32_t particle, int32_t shape)
{
    return a->size[particle] / clx_kit_size(&a->kit.group[1 + shape], a->config->size_meaning);
}

/// The kit's shapes under names of their own: a name that is taken gets a number.
static clast_status add_shapes(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    clast_shape copy = {0};
    CLX_TRY(clx_alloc(&a->shape_id, a->kit.n_shape, sizeof *a->shape_id));
    for (int32_t i = 0; i < a->kit.n_shape; ++i) {
        const clast_shape *shape = a->kit.shape[i].shape;
        char name[256];
        (void)snprintf(name, sizeof name, "%s", shape->name);
        int32_t same = 1;
        for (int32_t k = 0; k < a->assembly.n_shape; ++k) {
            if (strcmp(a->assembly.shape[k].name, name) == 0) {
                (void)snprintf(name, sizeof name, "%.200s-%d", shape->name, ++same);
                k = -1;
            }
        }
        CLX_TRY(clast_shape_copy(shape, &copy));
        clx_free(copy.name);
        copy.name = NULL;
        CLX_TRY(clx_alloc_text(&copy.name, name));
        CLX_TRY(clast_assembly_add_shape(&a->assembly, &copy, &a->shape_id[i]));
        clast_shape_free(&copy);
    }
done:
    clast_shape_free(&copy);
    return status;
}

static int64_t spheres_of(const clast_shape *shape)
{
    return shape->spheres.n > 0 ? shape->spheres.n : 1;
}

/// Everything that follows from one more placed grain.
static clast_status account(clast_aggregate *a, int32_t grain, int32_t kit_shape)
{
    clast_status status = CLAST_OK;
    const clast_assembly *all = &a->assembly;
    const clx_kit_shape *shape = &a->kit.shape[kit_shape];
    const double s = all->scale[grain];
    const double volume = shape->shape->volume * s * s * s;
    const double mass = volume * all->density[grain];
    const double own = shape->inertia_trace / shape->shape->volume * s * s;
    clx_touch_body body = shape->body;
    clx_touch_body_place(&body, all->position[grain], all->orientation[grain], s);
    CLX_TRY(clx_grow(&a->sphere_end, &a->sphere_room, grain + 1, sizeof *a->sphere_end));
    CLX_TRY(clx_touch_scene_insert(a->scene, &body));
    a->sphere_end[grain] = (grain > 0 ? a->sphere_end[grain - 1] : 0) + spheres_of(shape->shape);
    a->volume += volume;
    a->mass += mass;
    a->second += mass * (v3_norm2(all->position[grain]) + own);
    v3_axpy(a->moment, a->moment, mass, all->position[grain]);
done:
    return status;
}

static clast_status add_part(clast_aggregate *a, const clx_kit_part *placed)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_assembly_add_grain(&a->assembly, a->shape_id[placed->shape], placed->position,
                                     placed->orientation, placed->scale, placed->density));
    CLX_TRY(account(a, a->assembly.n_grain - 1, placed->shape));
done:
    return status;
}

static clast_status add_group(clast_aggregate *a, int32_t group, const double centre[3],
                              const double orientation[4], double scale)
{
    clast_status status = CLAST_OK;
    const clx_kit_group *g = &a->kit.group[group];
    for (int32_t i = 0; i < g->n_part; ++i) {
        clx_kit_part placed;
        clx_kit_pose(g, i, centre, orientation, scale, &placed);
        CLX_TRY(add_part(a, &placed));
    }
done:
    return status;
}

static double radius_of_gyration(const clast_aggregate *a)
{
    double centre[3];
    v3_scale(centre, 1.0 / a->mass, a->moment);
    return sqrt(fmax(0.0, a->second / a->mass - v3_norm2(centre)));
}

static clast_status add_row(clast_aggregate *a, double **row)
{
    const clast_status status = clx_history_row(&a->history, row);
    if (status == CLAST_OK) {
        (*row)[CLX_HISTORY_REPEAT] = a->repeat;
        (*row)[CLX_HISTORY_N] = a->n_placed;
        (*row)[CLX_HISTORY_GRAIN] = a->assembly.n_grain - 1;
        (*row)[CLX_HISTORY_TOUCHED] = -1.0;
        (*row)[CLX_HISTORY_SHAPE] = -1.0;
        (*row)[CLX_HISTORY_MASS] = a->mass;
        (*row)[CLX_HISTORY_SOLID] = a->volume;
        (*row)[CLX_HISTORY_GYRATION] = radius_of_gyration(a);
    }
    return status;
}

/// Does the point lie in the solid of this shape (its own frame)?
static clast_status shape_holds(const clast_shape *shape, const double point[3], bool *holds)
{
    clast_status status = CLAST_OK;
    clast_bvh *bvh = NULL;
    *holds = false;
    if (shape->kind == CLAST_SHAPE_MESH) {
        CLX_TRY(clast_bvh_create(&shape->mesh, &bvh));
        *holds = clast_bvh_inside(bvh, point);
    } else if (shape->kind == CLAST_SHAPE_CLUMP) {
        for (int32_t i = 0; i < shape->spheres.n && !*holds; ++i) {
            *holds = v3_distance(point, shape->spheres.centre[i]) <= shape->spheres.radius[i];
        }
    } else {
        double sum = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double x = point[k] / shape->semi_axes[shape->kind == CLAST_SHAPE_SPHERE ? 0 : k];
            sum += x * x;
        }
        *holds = sum <= 1.0;
    }
done:
    clast_bvh_destroy(bvh);
    return status;
}

/// AUTO: from the core's centre, or from random grains when that lies outside the core.
static clast_status resolve_origin(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    bool holds = false;
    a->origin = a->config->origin;
    if (a->origin != CLAST_ORIGIN_AUTO) {
        return CLAST_OK;
    }
    for (int32_t i = 0; i < a->n_core && !holds; ++i) {
        double m[3][3], to[3], point[3];
        q_matrix(m, a->assembly.orientation[i]);
        v3_scale(to, -1.0 / a->assembly.scale[i], a->assembly.position[i]);
        m3_mul_t(point, m, to);
        CLX_TRY(shape_holds(&a->assembly.shape[a->assembly.shape_id[i]], point, &holds));
    }
    a->origin = holds ? CLAST_ORIGIN_CORE : CLAST_ORIGIN_GRAIN;
done:
    return status;
}

static clast_status place_core(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    const double none[3] = {0.0, 0.0, 0.0};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    const clast_aggregate_config *c = a->config;
    double *row = NULL;
    const double own = clx_kit_size(&a->kit.group[0], c->core_meaning);
    const double scale = c->core_size > 0.0 ? c->core_size / own : 1.0;
    CLX_CHECK(c->core_size > 0.0 || strcmp(a->input->core->unit, "m") == 0, CLAST_E_CONFIG,
              "core_size: the core's file has no unit; give core_size, or unit");
    CLX_TRY(add_group(a, 0, none, unturned, scale));
    a->n_core = a->assembly.n_grain;
    CLX_TRY(add_row(a, &row));
    row[CLX_HISTORY_SIZE] = own * scale;
    CLX_TRY(resolve_origin(a));
done:
    return status;
}

static clast_status check_sizes(const clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    const double core_length =
        a->kit.group[0].length * a->assembly.scale[0] / a->kit.group[0].part[0].scale;
    double mass = a->mass;
    for (int32_t i = 0; i < a->n_particle; ++i) {
        const int32_t shape = clx_aggregate_shape(a, i);
        const clx_kit_group *group = &a->kit.group[1 + shape];
        const double scale = clx_aggregate_scale(a, i, shape);
        const double length = scale * group->length;
        CLX_CHECK(core_length >= CORE_SMALLEST * length, CLAST_E_CONFIG,
                  "core_size: the core's length %g m is below 1e-6 of particle %d, %g m long; are "
                  "the units right?",
                  core_length, i + 1, length);
        mass += group->mass * scale * scale * scale;
    }
    CLX_CHECK(a->config->stop_mass <= mass, CLAST_E_CONFIG,
              "stop_mass: %g kg is more than core and all %d particles weigh, %g kg; raise "
              "replicate or lower stop_mass",
              a->config->stop_mass, a->n_particle, mass);
    CLX_CHECK(a->config->stop_mass == 0.0 || a->config->stop_mass > a->mass, CLAST_E_CONFIG,
              "stop_mass: the core alone weighs %g kg, not below %g kg", a->mass,
              a->config->stop_mass);
done:
    return status;
}

/// Kit, sizes and an empty scene: all that is known before the first grain.
static clast_status prepare(const clast_aggregate_config *config,
                            const clast_aggregate_input *input, int32_t repeat, clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    a->config = config;
    a->input = input;
    a->repeat = repeat;
    a->seed = seed_of(config, repeat);
    CLAST_ASSERT(input->n_coat == config->coat.n);
    CLX_TRY(clast_aggregate_config_check(config));
    CLX_TRY(clx_aggregate_axis(config, &a->random_axis, a->axis));
    CLX_TRY(clx_kit_make(config, input, &a->kit));
    CLX_TRY(clx_sizes_plan(config, input->sizes, a->seed, &a->size, &a->n_particle));
    CLX_TRY(clx_touch_scene_create(&a->scene));
    CLX_TRY(clx_history_init(&a->history));
    (void)snprintf(a->assembly.unit, sizeof a->assembly.unit, "m");
    CLX_TRY(add_shapes(a));
done:
    return status;
}

clast_status clast_aggregate_create(const clast_aggregate_config *config,
                                    const clast_aggregate_input *input, int32_t repeat,
                                    clast_aggregate **aggregate)
{
    clast_status status = CLAST_OK;
    clast_aggregate *a = NULL;
    CLX_TRY(clx_alloc(&a, 1, sizeof *a));
    CLX_TRY(prepare(config, input, repeat, a));
    CLX_TRY(place_core(a));
    CLX_TRY(check_sizes(a));
    *aggregate = a;
    a = NULL;
done:
    clast_aggregate_destroy(a);
    return status;
}

static void aim(const clast_aggregate *a, int32_t shape, clx_search *search)
{
    const clast_aggregate_config *c = a->config;
    const int32_t particle = a->n_placed;
    *search = (clx_search){.kit = &a->kit,
                           .group = &a->kit.group[1 + shape],
                           .scale = clx_aggregate_scale(a, particle, shape),
                           .size = a->size[particle],
                           .scene = a->scene,
                           .assembly = &a->assembly,
                           .sphere_end = a->sphere_end,
                           .origin = a->origin,
                           .seed = a->seed,
                           .particle = particle,
                           .random_axis = a->random_axis,
                           .cone = c->cone,
                           .n_ray = c->rays,
                           .n_orientation = c->orientations,
                           .start = c->start};
    v3_copy(search->axis, a->axis);
    if (a->origin == CLAST_ORIGIN_MASS) {
        v3_scale(search->centre, 1.0 / a->mass, a->moment);
    }
    if (c->target == CLAST_TARGET_MASS) {
        v3_scale(search->target, 1.0 / a->mass, a->moment);
    }
}

/// The landing, with new axes as long as every ray misses.
static clast_status throw_particle(clast_aggregate *a, clx_search *search, clx_landing *landing)
{
    clast_status status = CLAST_OK;
    const double begun = clx_clock();
    do {
        clx_search_run(search, landing);
    } while (!landing->found && ++search->attempt < a->config->max_tries);
    a->contact_s += clx_clock() - begun;
    CLX_CHECK(landing->found, CLAST_E_CONVERGE,
              "particle %d of %d: all rays of %d axes miss the aggregate; widen the cone or let "
              "rays start at a grain (origin: grain)",
              a->n_placed + 1, a->n_particle, a->config->max_tries);
done:
    return status;
}

static clast_status place_particle(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    clx_search search;
    clx_landing landing;
    double *row = NULL;
    const int32_t shape = clx_aggregate_shape(a, a->n_placed);
    aim(a, shape, &search);
    CLX_TRY(throw_particle(a, &search, &landing));
    const double overlap = clx_search_overlap(&search, &landing);
    const int32_t first = a->assembly.n_grain;
    CLX_TRY(add_group(a, 1 + shape, landing.centre, landing.orientation, search.scale));
    CLX_TRY(clast_assembly_add_contact(&a->assembly, landing.touch.body, first + landing.part,
                                       landing.touch.point));
    ++a->n_placed;
    CLX_TRY(add_row(a, &row));
    row[CLX_HISTORY_SHAPE] = shape;
    row[CLX_HISTORY_SIZE] = search.size;
    row[CLX_HISTORY_DISTANCE] = landing.distance;
    row[CLX_HISTORY_RAYS] = (double)search.n_ray * (search.attempt + 1);
    row[CLX_HISTORY_TOUCHED] = landing.touch.body;
    row[CLX_HISTORY_OVERLAP] = overlap;
    a->max_overlap = fmax(a->max_overlap, overlap);
    a->max_overlap_relative =
        fmax(a->max_overlap_relative, overlap / (search.scale * search.group->radius));
done:
    return status;
}

static clast_aggregate_stop stop_now(const clast_aggregate *a)
{
    const clast_aggregate_config *c = a->config;
    if (c->stop_mass > 0.0 && a->mass >= c->stop_mass) {
        return CLAST_STOP_MASS;
    }
    return a->n_placed == a->n_particle ? CLAST_STOP_LIST : CLAST_STOP_NOT;
}

clast_status clast_aggregate_grow(clast_aggregate *a, int32_t n, const clast_monitor *monitor)
{
    clast_status status = CLAST_OK;
    const double begun = clx_clock();
    for (int32_t i = 0; i < n && a->stop == CLAST_STOP_NOT; ++i) {
        CLX_CHECK(monitor == NULL || monitor->stop == NULL || !monitor->stop(monitor->context),
                  CLAST_E_STOPPED, "stopped after %d of %d particles", a->n_placed, a->n_particle);
        CLX_TRY(place_particle(a));
        a->stop = stop_now(a);
        if (monitor != NULL && monitor->report != NULL) {
            monitor->report(monitor->context, "grow", a->n_placed, a->n_particle);
        }
    }
done:
    a->wall_s += clx_clock() - begun;
    return status;
}

bool clast_aggregate_is_done(const clast_aggregate *a)
{
    return a->stop != CLAST_STOP_NOT;
}

int32_t clast_aggregate_n_particle(const clast_aggregate *a)
{
    return a->n_particle;
}

const clast_assembly *clast_aggregate_assembly(const clast_aggregate *a)
{
    return &a->assembly;
}

clast_status clast_aggregate_history(const clast_aggregate *a, clast_table *history)
{
    return clx_history_table(&a->history, history);
}

clast_aggregate_result clast_aggregate_now(const clast_aggregate *a)
{
    return (clast_aggregate_result){.n_particle = a->n_placed,
                                    .n_grain = a->assembly.n_grain,
                                    .n_contact = a->assembly.n_contact,
                                    .mass = a->mass,
                                    .solid_sum = a->volume,
                                    .radius_of_gyration = radius_of_gyration(a),
                                    .max_overlap = a->max_overlap,
                                    .max_overlap_relative = a->max_overlap_relative,
                                    .stop = a->stop,
                                    .contact_s = a->contact_s,
                                    .envelope_s = a->envelope_s,
                                    .wall_s = a->wall_s};
}
