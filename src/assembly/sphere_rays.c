// The published envelope, ray for ray [Rossi & Bonadonna; SCARLET_v1]: isotropic directions from
// the r^3-weighted centroid C of all spheres; each line through C is met with all spheres and the
// hit with the greatest coordinate along the direction is kept (it may lie behind C); a line that
// meets none is moved to the centre of the sphere nearest to C; the envelope is the hull of the
// hits.
//
// A sphere at distance D from C covers the directions within asin(r / D) of its own, so each sphere
// visits only the directions of its cap, found in a grid over the direction sphere; lines that no
// cap covers ahead of C are rare and are met with all spheres.
#include "assembly/sphere_rays.h"

#include "base/alloc.h"
#include "base/status.h"
#include "geom/hull_inc.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/shape.h>

typedef struct rays {
    int32_t n_sphere;
    double (*at)[3]; ///< [n_sphere] from C
    double *radius;
    double centre[3];
    int32_t n_ray;
    double (*direction)[3]; ///< [n_ray] sorted by cell, then by number
    double *farthest;       ///< [n_ray] farthest hit so far
    double (*hit)[3];       ///< [n_ray]
    int32_t *number;        ///< [n_ray] number of the draw
    int32_t *tag;
    int32_t n_belt, n_slot; ///< cells: belts of equal height, slots of equal longitude
    int32_t *first;         ///< [n_belt * n_slot + 1]
} rays;

static void rays_free(rays *r)
{
    CLX_FREE(r->at, r->radius, r->direction, r->farthest, r->hit, r->number, r->tag, r->first);
    *r = (rays){0};
}

/// The spheres of a shape: its composite, or the sphere it is; n = 0 when it has none.
static clast_spheres spheres_of(const clast_shape *shape, double (*origin)[3], double *radius)
{
    if (shape->spheres.n > 0) {
        return shape->spheres;
    }
    if (shape->kind == CLAST_SHAPE_SPHERE) {
        v3_set(origin[0], 0.0, 0.0, 0.0);
        *radius = shape->semi_axes[0];
        return (clast_spheres){.n = 1, .centre = origin, .radius = radius};
    }
    return (clast_spheres){0};
}

static clast_status count_spheres(const clast_assembly *assembly, int64_t *count)
{
    clast_status status = CLAST_OK;
    double origin[1][3];
    double radius = 0.0;
    int64_t n = 0;
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        const clast_shape *shape = &assembly->shape[assembly->shape_id[i]];
        const int32_t own = spheres_of(shape, origin, &radius).n;
        CLX_CHECK(own > 0, CLAST_E_USAGE,
                  "shape %s has no spheres: fill it first, or choose an envelope of the true "
                  "surfaces",
                  shape->name);
        n += own;
    }
    CLX_CHECK(n > 0, CLAST_E_USAGE, "no grain to enclose");
    CLX_CHECK(n <= INT32_MAX, CLAST_E_LIMIT, "rays over more than 2^31 - 1 spheres");
    *count = n;
done:
    return status;
}

/// Places all spheres about their r^3-weighted centroid.
static void place_spheres(const clast_assembly *assembly, rays *r)
{
    double sum[3] = {0.0, 0.0, 0.0};
    double weight = 0.0;
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        double origin[1][3];
        double radius = 0.0;
        double rotation[3][3];
        const double scale = assembly->scale[i];
        const clast_spheres own =
            spheres_of(&assembly->shape[assembly->shape_id[i]], origin, &radius);
        q_matrix(rotation, assembly->orientation[i]);
        for (int32_t k = 0; k < own.n; ++k) {
            double *at = r->at[r->n_sphere];
            m3_to_world(at, rotation, own.centre[k]);
            v3_axpy(at, assembly->position[i], scale, at);
            const double radius_k = scale * own.radius[k];
            const double w = radius_k * radius_k * radius_k;
            r->radius[r->n_sphere++] = radius_k;
            v3_axpy(sum, sum, w, at);
            weight += w;
        }
    }
    v3_scale(r->centre, 1.0 / weight, sum);
    for (int32_t s = 0; s < r->n_sphere; ++s) {
        v3_sub(r->at[s], r->at[s], r->centre);
    }
}

static int32_t belt_of(const rays *r, double z)
{
    CLAST_ASSERT(r->n_belt > 0);
    const int32_t belt = (int32_t)(0.5 * (z + 1.0) * r->n_belt);
    return belt < 0 ? 0 : belt >= r->n_belt ? r->n_belt - 1 : belt;
}

static int32_t slot_of(const rays *r, const double d[3])
{
    CLAST_ASSERT(r->n_slot > 0);
    const double share = 0.5 + atan2(d[1], d[0]) / (2.0 * CLAST_PI);
    const int32_t slot = (int32_t)(share * r->n_slot);
    return slot >= r->n_slot ? 0 : slot;
}

/// Draws the directions and sorts them into cells by counting.
static clast_status draw_directions(uint64_t seed, rays *r)
{
    clast_status status = CLAST_OK;
    int32_t *cell = NULL;
    double(*drawn)[3] = NULL;
    const int32_t n_cell = r->n_belt * r->n_slot;
    CLX_TRY(clx_alloc(&cell, r->n_ray, sizeof *cell));
    CLX_TRY(clx_alloc(&drawn, r->n_ray, sizeof *drawn));
    for (int32_t i = 0; i < r->n_ray; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_ENVELOPE, (uint64_t)i);
        clx_rng_direction(&rng, drawn[i]);
        cell[i] = belt_of(r, drawn[i][2]) * r->n_slot + slot_of(r, drawn[i]);
        ++r->first[cell[i] + 1];
    }
    for (int32_t c = 0; c < n_cell; ++c) {
        r->first[c + 1] += r->first[c];
    }
    for (int32_t i = r->n_ray - 1; i >= 0; --i) { // from the back: first[c + 1] falls to its start
        const int32_t at = --r->first[cell[i] + 1];
        v3_copy(r->direction[at], drawn[i]);
        r->number[at] = i;
    }
    for (int32_t c = 0; c < n_cell; ++c) {
        r->first[c] = r->first[c + 1];
    }
    r->first[n_cell] = r->n_ray;
done:
    CLX_FREE(cell, drawn);
    return status;
}

/// Meets the rays of some cells of one belt with one sphere.
static void meet_cells(rays *r, int32_t begin, int32_t end, int32_t s)
{
    CLAST_ASSERT(begin >= 0 && begin <= end && s >= 0 && s < r->n_sphere);
    const double *at = r->at[s];
    const double beyond = v3_norm2(at) - r->radius[s] * r->radius[s];
    for (int32_t i = r->first[begin]; i < r->first[end]; ++i) {
        const double along = v3_dot(at, r->direction[i]);
        const double under = along * along - beyond;
        if (under >= 0.0) {
            r->farthest[i] = fmax(r->farthest[i], along + sqrt(under));
        }
    }
}

/// Meets one sphere with all rays whose forward half it covers (and some that miss it).
static void meet_sphere(rays *r, int32_t s)
{
    const double *at = r->at[s];
    const double distance = v3_norm(at);
    const double margin = 1e-9;
    if (distance <= r->radius[s] * (1.0 + margin)) {
        meet_cells(r, 0, r->n_belt * r->n_slot, s);
        return;
    }
    const double cap = asin(r->radius[s] / distance) + margin;
    const double height = asin(fmax(-1.0, fmin(1.0, at[2] / distance)));
    const double top = height + cap >= 0.5 * CLAST_PI ? 1.0 : sin(height + cap);
    const double bottom = height - cap <= -0.5 * CLAST_PI ? -1.0 : sin(height - cap);
    // half-width in longitude of a cap that holds no pole: asin(sin cap / cos height)
    const double share = sin(cap) / fmax(cos(height), 1e-300);
    const double half = top >= 1.0 || bottom <= -1.0 || share >= 1.0 ? CLAST_PI : asin(share);
    const double longitude = 0.5 + atan2(at[1], at[0]) / (2.0 * CLAST_PI);
    const int32_t west = (int32_t)floor((longitude - half / (2.0 * CLAST_PI)) * r->n_slot - margin);
    const int32_t east = (int32_t)floor((longitude + half / (2.0 * CLAST_PI)) * r->n_slot + margin);
    const int32_t n = east - west + 1 < r->n_slot ? east - west + 1 : r->n_slot;
    for (int32_t belt = belt_of(r, bottom); belt <= belt_of(r, top); ++belt) {
        for (int32_t k = 0; k < n; ++k) {
            const int32_t slot = ((west + k) % r->n_slot + r->n_slot) % r->n_slot;
            meet_cells(r, belt * r->n_slot + slot, belt * r->n_slot + slot + 1, s);
        }
    }
}

static void meet_one(rays *r, int32_t i, int32_t s, const double start[3])
{
    double at[3];
    v3_sub(at, r->at[s], start);
    const double along = v3_dot(at, r->direction[i]);
    const double under = along * along - v3_norm2(at) + r->radius[s] * r->radius[s];
    if (under >= 0.0) {
        r->farthest[i] = fmax(r->farthest[i], along + sqrt(under));
    }
}

/// A line that no cap covers: all spheres, also behind; then the line through the nearest sphere.
static void meet_line(rays *r, int32_t i, double start[3])
{
    int32_t nearest = 0;
    v3_set(start, 0.0, 0.0, 0.0);
    for (int32_t s = 0; s < r->n_sphere; ++s) {
        meet_one(r, i, s, start);
        nearest = v3_norm2(r->at[s]) < v3_norm2(r->at[nearest]) ? s : nearest;
    }
    if (!isfinite(r->farthest[i])) {
        v3_copy(start, r->at[nearest]);
        for (int32_t s = 0; s < r->n_sphere; ++s) {
            meet_one(r, i, s, start);
        }
    }
}

static clast_status rays_alloc(const clast_assembly *assembly,
                               const clast_envelope_options *options, rays *r)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    CLX_CHECK(options->n_ray >= 4, CLAST_E_USAGE, "sphere_rays needs 4 rays or more, not %d",
              options->n_ray);
    CLX_TRY(count_spheres(assembly, &n));
    CLX_TRY(clx_alloc(&r->at, n, sizeof *r->at));
    CLX_TRY(clx_alloc(&r->radius, n, sizeof *r->radius));
    r->n_ray = options->n_ray;
    r->n_belt = (int32_t)fmax(2.0, fmin(0.4 * sqrt(r->n_ray), 512.0));
    r->n_slot = 2 * r->n_belt;
    CLX_TRY(clx_alloc(&r->direction, r->n_ray, sizeof *r->direction));
    CLX_TRY(clx_alloc(&r->farthest, r->n_ray, sizeof *r->farthest));
    CLX_TRY(clx_alloc(&r->hit, r->n_ray, sizeof *r->hit));
    CLX_TRY(clx_alloc(&r->number, r->n_ray, sizeof *r->number));
    CLX_TRY(clx_alloc(&r->tag, r->n_ray, sizeof *r->tag));
    CLX_TRY(clx_alloc(&r->first, (int64_t)r->n_belt * r->n_slot + 1, sizeof *r->first));
done:
    return status;
}

/// Hull volume of the hits whose number is k modulo n, or of all with n = 1.
static clast_status hull_of_hits(rays *r, int32_t k, int32_t n, double *volume)
{
    clast_status status = CLAST_OK;
    clx_hull_inc hull = {0};
    double(*hit)[3] = NULL;
    int32_t n_hit = 0;
    CLX_TRY(clx_alloc(&hit, r->n_ray, sizeof *hit));
    for (int32_t i = 0; i < r->n_ray; ++i) {
        if (r->number[i] % n == k) {
            v3_copy(hit[n_hit++], r->hit[i]);
        }
    }
    CLX_TRY(clx_hull_inc_add(&hull, n_hit, (const double(*)[3])hit, r->tag));
    *volume = clx_hull_inc_volume(&hull);
done:
    clx_hull_inc_free(&hull);
    clx_free(hit);
    return status;
}

clast_status clx_envelope_sphere_rays(const clast_assembly *assembly,
                                      const clast_envelope_options *options,
                                      clast_envelope *envelope)
{
    clast_status status = CLAST_OK;
    rays r = {0};
    double start[3];
    double volume = 0.0;
    double half[2] = {0.0, 0.0};
    CLX_TRY(rays_alloc(assembly, options, &r));
    CLAST_ASSERT(r.first != NULL && r.direction != NULL && r.at != NULL);
    place_spheres(assembly, &r);
    CLX_TRY(draw_directions(options->seed, &r));
    for (int32_t i = 0; i < r.n_ray; ++i) {
        r.farthest[i] = -INFINITY;
    }
    for (int32_t s = 0; s < r.n_sphere; ++s) {
        meet_sphere(&r, s);
    }
    for (int32_t i = 0; i < r.n_ray; ++i) {
        v3_set(start, 0.0, 0.0, 0.0);
        if (!isfinite(r.farthest[i])) {
            meet_line(&r, i, start);
        }
        v3_axpy(r.hit[i], start, r.farthest[i], r.direction[i]);
    }
    CLX_TRY(hull_of_hits(&r, 0, 1, &volume));
    CLX_TRY(hull_of_hits(&r, 0, 2, &half[0]));
    CLX_TRY(hull_of_hits(&r, 1, 2, &half[1]));
    // Half the rays scatter by about sqrt(2) more than all of them, and the halves' difference by
    // sqrt(2) more than one half.
    *envelope = (clast_envelope){.kind = CLAST_ENVELOPE_SPHERE_RAYS,
                                 .volume = volume,
                                 .error = 0.5 * fabs(half[0] - half[1])};
    envelope->low = volume - envelope->error;
    envelope->high = volume + envelope->error;
done:
    rays_free(&r);
    return status;
}
