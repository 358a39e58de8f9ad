// Cluster-cluster growth: two clusters are chosen, the smaller is thrown at the larger, and they
// stay together. [Meakin 1983, Kolb et al. 1983, with ballistic approach and the cone of rays]
//
// The larger keeps its place, so its scene only grows: N grains cost O(N log N) insertions.
#include "aggregate/cluster.h"

#include "aggregate/pick.h"
#include "aggregate/state.h"
#include "aggregate/trial.h"
#include "aggregate/walk.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "math/vec3.h"
#include <clast/shape.h>
#include <math.h>
#include <string.h>

static void free_cluster(clx_cluster *cluster)
{
    clx_touch_scene_destroy(cluster->scene);
    CLX_FREE(cluster->grain, cluster->contact);
    *cluster = (clx_cluster){0};
}

void clx_clusters_free(clx_clusters *clusters)
{
    for (int32_t i = 0; i < clusters->n; ++i) {
        free_cluster(&clusters->cluster[i]);
    }
    clx_free(clusters->cluster);
    *clusters = (clx_clusters){0};
}

/// Mass, centre and radius of gyration, summed in the order of the grains, so that a restored
/// cluster has the same bits.
static void sum_up(const clast_aggregate *a, clx_cluster *cluster)
{
    CLAST_ASSERT(cluster->n > 0);
    const clast_assembly *all = &a->assembly;
    double moment[3] = {0.0, 0.0, 0.0};
    double second = 0.0;
    cluster->mass = 0.0;
    cluster->volume = 0.0;
    for (int32_t i = 0; i < cluster->n; ++i) {
        const int32_t grain = cluster->grain[i];
        const double s = all->scale[grain];
        const clx_template_shape *shape =
            &a->templates.shape[a->template_shape[all->shape_id[grain]]];
        const double volume = shape->shape->volume * s * s * s;
        const double mass = volume * all->density[grain];
        const double own = shape->inertia_trace / shape->shape->volume * s * s;
        cluster->volume += volume;
        cluster->mass += mass;
        v3_axpy(moment, moment, mass, all->position[grain]);
        second += mass * (v3_norm2(all->position[grain]) + own);
    }
    v3_scale(cluster->centre, 1.0 / cluster->mass, moment);
    cluster->gyration = sqrt(fmax(0.0, second / cluster->mass - v3_norm2(cluster->centre)));
}

/// A cluster of n grains from `first` on, with the contacts made since `first_contact`.
static clast_status add_cluster(clast_aggregate *a, int32_t first, int32_t n, int32_t first_contact)
{
    CLAST_ASSERT(first >= 0 && n > 0 && first + n <= a->assembly.n_grain);
    clast_status status = CLAST_OK;
    clx_clusters *all = &a->clusters;
    CLX_TRY(clx_grow(&all->cluster, &all->capacity, all->n + 1, sizeof *all->cluster));
    all->cluster[all->n] = (clx_cluster){0};
    clx_cluster *cluster = &all->cluster[all->n++];
    CLX_TRY(clx_grow(&cluster->grain, &cluster->capacity, n, sizeof *cluster->grain));
    for (int32_t i = 0; i < n; ++i) {
        cluster->grain[i] = first + i;
    }
    cluster->n = n;
    cluster->n_contact = a->assembly.n_contact - first_contact;
    CLX_TRY(clx_grow(&cluster->contact, &cluster->contact_capacity, cluster->n_contact,
                     sizeof *cluster->contact));
    for (int32_t i = 0; i < cluster->n_contact; ++i) {
        cluster->contact[i] = first_contact + i;
    }
    sum_up(a, cluster);
done:
    return status;
}

/// Every particle a cluster of its own.
static clast_status begin(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    const double none[3] = {0.0, 0.0, 0.0};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    for (int32_t i = 0; i < a->n_particle; ++i) {
        const int32_t shape = clx_aggregate_shape(a, i);
        const int32_t first = a->assembly.n_grain;
        const int32_t first_contact = a->assembly.n_contact;
        CLX_TRY(clx_aggregate_add_group(a, 1 + shape, none, unturned,
                                        clx_aggregate_scale(a, i, shape)));
        CLX_TRY(add_cluster(a, first, a->assembly.n_grain - first, first_contact));
    }
done:
    return status;
}

/// Members sorted into their clusters, each in its order.
static clast_status read_members(clast_aggregate *a, const double *cluster, const double *place)
{
    clast_status status = CLAST_OK;
    clx_clusters *all = &a->clusters;
    const int32_t n = a->assembly.n_grain;
    for (int32_t g = 0; g < n; ++g) {
        CLX_CHECK(cluster[g] >= 0.0 && cluster[g] < all->n && place[g] >= 0.0 && place[g] < n,
                  CLAST_E_FORMAT, "the saved cluster or place of grain %d is out of range", g);
        ++all->cluster[(int32_t)cluster[g]].n;
    }
    for (int32_t c = 0; c < all->n; ++c) {
        clx_cluster *made = &all->cluster[c];
        CLX_CHECK(made->n > 0, CLAST_E_FORMAT, "the saved cluster %d has no grain", c);
        CLX_TRY(clx_grow(&made->grain, &made->capacity, made->n, sizeof *made->grain));
        memset(made->grain, -1, (size_t)made->n * sizeof *made->grain);
    }
    for (int32_t g = 0; g < n; ++g) {
        clx_cluster *made = &all->cluster[(int32_t)cluster[g]];
        const int32_t at = (int32_t)place[g];
        CLX_CHECK(at < made->n && made->grain[at] == -1, CLAST_E_FORMAT,
                  "the saved place of grain %d is taken or out of range", g);
        made->grain[at] = g;
    }
done:
    return status;
}

static clast_status add_contacts(clast_aggregate *a, const double *cluster)
{
    clast_status status = CLAST_OK;
    for (int32_t k = 0; k < a->assembly.n_contact; ++k) {
        clx_cluster *made = &a->clusters.cluster[(int32_t)cluster[a->assembly.contact[k][0]]];
        CLX_TRY(clx_grow(&made->contact, &made->contact_capacity, made->n_contact + 1,
                         sizeof *made->contact));
        made->contact[made->n_contact++] = k;
    }
done:
    return status;
}

/// The same clusters as an earlier run had, from its members table; the grains are in place.
static clast_status restore_members(clast_aggregate *a, const clast_table *members)
{
    clast_status status = CLAST_OK;
    clx_clusters *all = &a->clusters;
    const double *cluster = members != NULL ? clast_table_numbers(members, "cluster") : NULL;
    const double *place = members != NULL ? clast_table_numbers(members, "place") : NULL;
    const int32_t n = a->n_particle - a->n_placed;
    CLX_CHECK(cluster != NULL && place != NULL && members->n_row == a->assembly.n_grain,
              CLAST_E_FORMAT, "the saved members table does not fit %d grains",
              a->assembly.n_grain);
    CLX_TRY(clx_grow(&all->cluster, &all->capacity, n, sizeof *all->cluster));
    memset(all->cluster, 0, (size_t)n * sizeof *all->cluster);
    all->n = n;
    CLX_TRY(read_members(a, cluster, place));
    CLX_TRY(add_contacts(a, cluster));
    for (int32_t c = 0; c < n; ++c) {
        sum_up(a, &all->cluster[c]);
    }
done:
    return status;
}

/// A scene of the cluster's grains, made when it is first thrown at.
static clast_status ensure_scene(clast_aggregate *a, clx_cluster *cluster)
{
    clast_status status = CLAST_OK;
    clx_touch_scene *scene = NULL;
    if (cluster->scene != NULL) {
        return CLAST_OK;
    }
    CLX_TRY(clx_touch_scene_create(&scene));
    for (int32_t i = 0; i < cluster->n; ++i) {
        const clx_touch_body body = clx_aggregate_body(a, cluster->grain[i]);
        CLX_TRY(clx_touch_scene_insert(scene, &body));
    }
    cluster->scene = scene;
    scene = NULL;
done:
    clx_touch_scene_destroy(scene);
    return status;
}

/// The cluster as a group about its centre of mass.
static clast_status as_group(const clast_aggregate *a, const clx_cluster *cluster,
                             clx_template *group)
{
    CLAST_ASSERT(cluster->n > 0 && cluster->mass >= 0.0);
    const clast_assembly *all = &a->assembly;
    *group = (clx_template){.n_part = cluster->n};
    const clast_status status = clx_alloc(&group->part, cluster->n, sizeof *group->part);
    for (int32_t i = 0; i < cluster->n && status == CLAST_OK; ++i) {
        const int32_t grain = cluster->grain[i];
        clx_template_part *part = &group->part[i];
        part->shape = a->template_shape[all->shape_id[grain]];
        part->scale = all->scale[grain];
        part->density = all->density[grain];
        v3_sub(part->position, all->position[grain], cluster->centre);
        for (int k = 0; k < 4; ++k) {
            part->orientation[k] = all->orientation[grain][k];
        }
        group->radius =
            fmax(group->radius,
                 v3_norm(part->position) +
                     part->scale * a->templates.shape[part->shape].shape->bounding_radius);
    }
    return status;
}

static clast_status throw_cluster(clast_aggregate *a, clx_search *search, clx_placement *placement)
{
    clast_status status = CLAST_OK;
    const double begun = clx_clock();
    const int32_t tries = clx_search_tries(a->params);
    CLX_TRY(clx_walk_or_search(search, tries, placement));
    CLX_CHECK(placement->found || search->approach == CLAST_APPROACH_CENTRAL, CLAST_E_CONVERGE,
              "merger %d: all of %d %s miss the larger cluster; raise max_tries", a->n_placed + 1,
              tries, clx_search_paths(search));
    CLX_CHECK(placement->found, CLAST_E_CONVERGE,
              "merger %d: all rays of %d axes miss the larger cluster; let rays start at a grain "
              "(origin: grain)",
              a->n_placed + 1, tries);
done:
    a->contact_s += clx_clock() - begun;
    return status;
}

/// Contact points of the thrown cluster turn and move with it.
static void move_contacts(clast_aggregate *a, const clx_cluster *small,
                          const clx_placement *placement)
{
    for (int32_t i = 0; i < small->n_contact; ++i) {
        double *point = a->assembly.contact_point[small->contact[i]];
        double arm[3];
        v3_sub(arm, point, small->centre);
        q_rotate(arm, placement->orientation, arm);
        v3_add(point, placement->centre, arm);
    }
}

static clast_status join_contacts(clast_aggregate *a, clx_cluster *large, const clx_cluster *small,
                                  const clx_placement *placement)
{
    clast_status status = CLAST_OK;
    const int32_t n = large->n_contact + small->n_contact + 1;
    CLX_TRY(clx_grow(&large->contact, &large->contact_capacity, n, sizeof *large->contact));
    CLX_TRY(clast_assembly_add_contact(&a->assembly, large->grain[placement->touch.body],
                                       small->grain[placement->part], placement->touch.point));
    move_contacts(a, small, placement);
    for (int32_t i = 0; i < small->n_contact; ++i) {
        large->contact[large->n_contact + i] = small->contact[i];
    }
    large->contact[n - 1] = a->assembly.n_contact - 1;
    large->n_contact = n;
done:
    return status;
}

/// The thrown grains take their new poses and join the larger cluster.
static clast_status join(clast_aggregate *a, clx_cluster *large, const clx_cluster *small,
                         const clx_template *group, const clx_placement *placement)
{
    CLAST_ASSERT(large != small && large->n > 0 && small->n > 0);
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&large->grain, &large->capacity, large->n + small->n, sizeof *large->grain));
    CLX_TRY(join_contacts(a, large, small, placement));
    for (int32_t i = 0; i < small->n; ++i) {
        const int32_t grain = small->grain[i];
        clx_template_part placed;
        clx_template_pose(group, i, placement->centre, placement->orientation, 1.0, &placed);
        v3_copy(a->assembly.position[grain], placed.position);
        for (int k = 0; k < 4; ++k) {
            a->assembly.orientation[grain][k] = placed.orientation[k];
        }
        large->grain[large->n + i] = grain;
        const clx_touch_body body = clx_aggregate_body(a, grain);
        CLX_TRY(clx_touch_scene_insert(large->scene, &body));
    }
    large->n += small->n;
    sum_up(a, large);
done:
    return status;
}

static clast_status add_row(clast_aggregate *a, const clx_cluster *merged, const clx_search *search,
                            const clx_placement *placement, double overlap)
{
    clast_status status = CLAST_OK;
    double *row = NULL;
    CLX_TRY(clx_history_row(&a->history, &row));
    row[CLX_HISTORY_REPEAT] = a->repeat;
    row[CLX_HISTORY_N] = a->n_placed;
    row[CLX_HISTORY_CLUSTERS] = a->clusters.n;
    row[CLX_HISTORY_GRAINS] = merged->n;
    row[CLX_HISTORY_SHAPE] = -1.0;
    row[CLX_HISTORY_SIZE] = search->size;
    row[CLX_HISTORY_DISTANCE] = placement->distance;
    row[CLX_HISTORY_RAYS] = (double)search->aim.n_ray * (search->aim.attempt + 1);
    row[CLX_HISTORY_TOUCHED] = merged->grain[placement->touch.body];
    row[CLX_HISTORY_OVERLAP] = overlap;
    row[CLX_HISTORY_MASS] = merged->mass;
    row[CLX_HISTORY_SOLID] = merged->volume;
    row[CLX_HISTORY_GYRATION] = merged->gyration;
    CLX_TRY(clx_aggregate_measure_cluster(a, merged, row));
done:
    return status;
}

static double bounding_radius_of(const clast_aggregate *a, const clx_cluster *cluster)
{
    double bounding_radius = 0.0;
    for (int32_t i = 0; i < cluster->n; ++i) {
        const int32_t grain = cluster->grain[i];
        const clast_shape *shape = &a->assembly.shape[a->assembly.shape_id[grain]];
        bounding_radius =
            fmax(bounding_radius, v3_distance(a->assembly.position[grain], cluster->centre) +
                                      a->assembly.scale[grain] * shape->bounding_radius);
    }
    return bounding_radius;
}

static void prepare_search(const clast_aggregate *a, const clx_cluster *large,
                           const clx_template *group, clx_search *search)
{
    const clast_aggregate_params *c = a->params;
    *search = (clx_search){.templates = &a->templates,
                           .group = group,
                           .scale = 1.0,
                           .size = 2.0 * group->radius,
                           .scene = large->scene,
                           .n_body = clx_touch_scene_count(large->scene),
                           .origin = c->origin == CLAST_ORIGIN_GRAIN ? CLAST_ORIGIN_GRAIN
                                                                     : CLAST_ORIGIN_MASS,
                           .aim = clx_aggregate_aim(a),
                           .n_orientation = c->orientations,
                           .start = c->start,
                           .approach = c->approach,
                           .bounding_radius = bounding_radius_of(a, large),
                           .walk_step = c->walk_step};
    v3_copy(search->centre, large->centre);
    v3_copy(search->target, large->centre);
}

static clast_status merge(clast_aggregate *a, clx_cluster *large, clx_cluster *small)
{
    CLAST_ASSERT(large != small && large->n >= small->n);
    clast_status status = CLAST_OK;
    clx_template group = {0};
    clx_search search;
    clx_placement placement;
    CLX_TRY(ensure_scene(a, large));
    CLX_TRY(as_group(a, small, &group));
    prepare_search(a, large, &group, &search);
    CLX_TRY(throw_cluster(a, &search, &placement));
    const double overlap = clx_search_overlap(&search, &placement);
    a->is_torn = true;
    CLX_TRY(join(a, large, small, &group, &placement));
    ++a->n_placed;
    free_cluster(small);
    *small = a->clusters.cluster[--a->clusters.n];
    if (large == &a->clusters.cluster[a->clusters.n]) {
        large = small; // the last cluster took the freed place
    }
    CLX_TRY(add_row(a, large, &search, &placement, overlap));
    a->is_torn = false;
done:
    clx_free(group.part);
    return status;
}

static clast_status step(clast_aggregate *a)
{
    int32_t pair[2];
    clx_pick_pair(a, pair);
    clx_cluster *first = &a->clusters.cluster[pair[0]];
    clx_cluster *second = &a->clusters.cluster[pair[1]];
    return first->n >= second->n ? merge(a, first, second) : merge(a, second, first);
}

/// The one with most grains, the first of equals.
static const clx_cluster *largest_of(const clx_clusters *clusters)
{
    CLAST_ASSERT(clusters->n > 0);
    const clx_cluster *best = &clusters->cluster[0];
    for (int32_t i = 1; i < clusters->n; ++i) {
        best = clusters->cluster[i].n > best->n ? &clusters->cluster[i] : best;
    }
    return best;
}

/// Sets the clusters that are left side by side along x, so that they can be looked at.
static void spread(clast_aggregate *a)
{
    double x = 0.0;
    for (int32_t c = 0; c < a->clusters.n; ++c) {
        clx_cluster *cluster = &a->clusters.cluster[c];
        const double bounding_radius = bounding_radius_of(a, cluster);
        x += c > 0 ? 1.1 * bounding_radius : 0.0;
        const double move[3] = {x - cluster->centre[0], -cluster->centre[1], -cluster->centre[2]};
        for (int32_t i = 0; i < cluster->n; ++i) {
            double *at = a->assembly.position[cluster->grain[i]];
            v3_add(at, at, move);
        }
        for (int32_t i = 0; i < cluster->n_contact; ++i) {
            double *at = a->assembly.contact_point[cluster->contact[i]];
            v3_add(at, at, move);
        }
        sum_up(a, cluster);
        clx_touch_scene_destroy(cluster->scene);
        cluster->scene = NULL;
        x += 1.1 * bounding_radius;
    }
}

clast_status clx_clusters_members(const clast_aggregate *a, clast_table *members)
{
    clast_status status = CLAST_OK;
    clast_table made = {0};
    double *cluster = NULL;
    double *place = NULL;
    CLX_TRY(clast_table_init(&made, "members", a->assembly.n_grain));
    CLX_TRY(clast_table_add_number(&made, "cluster", "-", NULL));
    CLX_TRY(clast_table_add_number(&made, "place", "-", NULL));
    cluster = made.column[0].number;
    place = made.column[1].number;
    for (int32_t c = 0; c < a->clusters.n; ++c) {
        for (int32_t i = 0; i < a->clusters.cluster[c].n; ++i) {
            const int32_t grain = a->clusters.cluster[c].grain[i];
            cluster[grain] = c;
            place[grain] = i;
        }
    }
    *members = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

static clast_status plan(clast_aggregate *a)
{
    const int32_t n_final = a->params->n_final;
    if (n_final >= a->n_particle) {
        return clx_fail(CLAST_E_CONFIG, "n_final: %d clusters cannot be left of %d particles",
                        n_final, a->n_particle);
    }
    a->n_step = a->n_particle - n_final;
    return CLAST_OK;
}

static clx_measured measured(const clast_aggregate *a)
{
    const clx_cluster *largest = largest_of(&a->clusters);
    return (clx_measured){.cluster = largest,
                          .n_grain = largest->n,
                          .n_contact = largest->n_contact,
                          .n_cluster = a->clusters.n,
                          .mass = largest->mass,
                          .volume = largest->volume,
                          .gyration = largest->gyration};
}

static clast_status restore(clast_aggregate *a, const clast_aggregate_saved *saved)
{
    clast_status status = CLAST_OK;
    a->n_placed = (int32_t)a->history.n_row;
    CLX_CHECK(a->n_placed <= a->n_step, CLAST_E_FORMAT, "%d saved mergers of %d", a->n_placed,
              a->n_step);
    CLX_TRY(clx_aggregate_copy_grains(a, saved->placed));
    CLX_TRY(restore_members(a, saved->members));
done:
    return status;
}

const clx_aggregate_mode clx_aggregate_by_cluster = {.plan = plan,
                                                     .begin = begin,
                                                     .step = step,
                                                     .end = spread,
                                                     .measured = measured,
                                                     .restore = restore};
