// Composites as the published engines prepare them: moved to the r^3-weighted centroid of their
// spheres, their length taken among randomly chosen vertices of the triangle soup.
#include "aggregate/march.h"

#include "aggregate/sizes.h"
#include "base/alloc.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <math.h>

enum { SURFACE_LEVEL = 4 };

void clx_march_free(clx_march *march)
{
    for (int32_t i = 0; i < march->n_shape; ++i) {
        clast_spheres_free(&march->shape[i].spheres);
    }
    CLX_FREE(march->shape, march->grain, march->sphere);
    *march = (clx_march){0};
}

static clast_status take_spheres(const clast_shape *shape, clast_spheres *spheres)
{
    clast_status status = CLAST_OK;
    if (shape->spheres.n > 0) {
        return clast_spheres_copy(&shape->spheres, spheres);
    }
    CLX_CHECK(shape->kind == CLAST_SHAPE_SPHERE, CLAST_E_GEOMETRY,
              "shape %s has no sphere composite; give coat_spheres, or fill it", shape->name);
    CLX_TRY(clast_spheres_alloc(1, spheres));
    spheres->radius[0] = shape->semi_axes[0];
done:
    return status;
}

/// Moves the spheres to their centroid; their reach from there.
static void centre_spheres(clx_march_shape *made)
{
    CLAST_ASSERT(made->spheres.n > 0);
    clast_spheres *s = &made->spheres;
    double weight = 0.0;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int32_t i = 0; i < s->n; ++i) {
        const double w = s->radius[i] * s->radius[i] * s->radius[i];
        v3_axpy(sum, sum, w, s->centre[i]);
        weight += w;
    }
    v3_scale(made->centroid, 1.0 / weight, sum);
    for (int32_t i = 0; i < s->n; ++i) {
        v3_sub(s->centre[i], s->centre[i], made->centroid);
        made->radius = fmax(made->radius, v3_norm(s->centre[i]) + s->radius[i]);
    }
}

static const double *soup_vertex(const clast_mesh *mesh, int64_t entry)
{
    return mesh->vert[mesh->tri[entry / 3][entry % 3]];
}

/// Greatest distance among `wanted` entries of the soup, drawn without replacement (all, where the
/// soup is smaller: the engines stop there).
static clast_status sample_length(const clast_mesh *mesh, int32_t wanted, uint64_t seed,
                                  uint64_t number, double *length)
{
    CLAST_ASSERT(wanted > 0);
    clast_status status = CLAST_OK;
    const int64_t n = 3 * (int64_t)mesh->n_tri;
    const int64_t k = wanted < n ? wanted : n;
    int64_t *entry = NULL;
    double best = 0.0;
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_AGGREGATE_MARCH, number);
    CLX_TRY(clx_alloc(&entry, n, sizeof *entry));
    for (int64_t i = 0; i < n; ++i) {
        entry[i] = i;
    }
    for (int64_t i = 0; i < k; ++i) {
        const int64_t j = i + clx_rng_below(&rng, n - i);
        const int64_t kept = entry[i];
        entry[i] = entry[j];
        entry[j] = kept;
        for (int64_t m = 0; m < i; ++m) {
            best =
                fmax(best, v3_distance2(soup_vertex(mesh, entry[i]), soup_vertex(mesh, entry[m])));
        }
    }
    *length = sqrt(best);
done:
    clx_free(entry);
    return status;
}

static clast_status make_shape(const clast_aggregate_params *params, const clx_templates *templates,
                               int32_t number, uint64_t seed, clx_march_shape *made)
{
    clast_status status = CLAST_OK;
    const clx_template *group = &templates->group[number];
    clast_mesh surface = {0};
    CLX_CHECK(group->n_part == 1, CLAST_E_CONFIG,
              "contact: the published march moves single shapes, not aggregates; use exact");
    const clast_shape *shape = templates->shape[group->part[0].shape].shape;
    CLX_TRY(take_spheres(shape, &made->spheres));
    centre_spheres(made);
    CLX_TRY(clast_shape_surface(shape, SURFACE_LEVEL, &surface));
    CLX_TRY(sample_length(&surface, params->march_vertices, seed, (uint64_t)number, &made->length));
    made->ratio = group->length / clx_template_size(group, number == 0 ? params->core_meaning
                                                                       : params->size_meaning);
done:
    clast_mesh_free(&surface);
    return status;
}

clast_status clx_march_make(const clast_aggregate_params *params, const clx_templates *templates,
                            uint64_t seed, clx_march *march)
{
    clast_status status = CLAST_OK;
    const bool release = params->flavour == CLAST_MARCH_RELEASE;
    clx_march made = {.params = params,
                      .coarse = release ? 0.05 : 0.01,
                      .fine = params->march_fine,
                      .start = release ? 1.1 : 1.0,
                      .phi_range = release ? 2.0 * CLAST_PI : CLAST_PI,
                      .sphere_origin = release};
    made.coarse = params->march_coarse > 0.0 ? params->march_coarse : made.coarse;
    made.start = params->start > 0.0 ? params->start : made.start;
    if (params->origin != CLAST_ORIGIN_AUTO) {
        made.sphere_origin = params->origin == CLAST_ORIGIN_SPHERE;
    }
    CLX_TRY(clx_alloc(&made.shape, templates->n_group, sizeof *made.shape));
    for (int32_t i = 0; i < templates->n_group; ++i) {
        made.n_shape = i + 1;
        CLX_TRY(make_shape(params, templates, i, seed, &made.shape[i]));
    }
    *march = made;
    made = (clx_march){0};
done:
    clx_march_free(&made);
    return status;
}

double clx_march_length(const clx_march *march, double size, int32_t class_shape)
{
    return size * march->shape[1 + class_shape].ratio;
}

double clx_march_scale(const clx_march *march, double length, int32_t shape)
{
    CLAST_ASSERT(length >= 0.0 && shape >= 0 && shape + 1 < march->n_shape);
    return length / march->shape[1 + shape].length;
}

clast_status clx_march_add(clx_march *march, int32_t shape, const double centroid[3],
                           const double orientation[4], double scale)
{
    CLAST_ASSERT(shape >= 0 && shape < march->n_shape && scale > 0.0);
    clast_status status = CLAST_OK;
    const clx_march_shape *s = &march->shape[shape];
    double m[3][3];
    CLX_TRY(
        clx_grow(&march->grain, &march->grain_capacity, march->n_grain + 1, sizeof *march->grain));
    CLX_TRY(clx_grow(&march->sphere, &march->sphere_capacity, march->n_sphere + s->spheres.n,
                     sizeof *march->sphere));
    clx_march_grain *grain = &march->grain[march->n_grain++];
    *grain =
        (clx_march_grain){.radius = scale * s->radius, .first = march->n_sphere, .n = s->spheres.n};
    v3_copy(grain->centre, centroid);
    q_matrix(m, orientation);
    for (int32_t i = 0; i < s->spheres.n; ++i) {
        clx_march_sphere *sphere = &march->sphere[march->n_sphere++];
        double arm[3];
        m3_to_world(arm, m, s->spheres.centre[i]);
        v3_axpy(sphere->centre, centroid, scale, arm);
        sphere->radius = scale * s->spheres.radius[i];
    }
done:
    return status;
}
