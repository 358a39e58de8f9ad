// What the images of a periodic bed cover of its grains: nothing but contacts where the grains
// repeat so, and whole grains where the period is not theirs.
#include "porosity/slabs.h"

#include "assembly/grain_points.h"
#include "assembly/touch_set.h"
#include "base/alloc.h"
#include "base/parallel.h"
#include "base/status.h"
#include "math/vec3.h"
#include "touch/gap.h"
#include <clast/assembly.h>
#include <clast/shape.h>
#include <math.h>
#include <string.h>

enum { POINTS = 512, BLOCK = 32 };

static const double OVERLAP = 1e-2; ///< of the smaller grain's reach: so deep are contacts at most
static const double MOST_SOLID = 1.01; ///< of the volume: contacts overlap

typedef struct {
    const clast_assembly *grains; ///< in the first image, or as they lay
    const clast_bed *bed;
    const clx_touch_set *set; ///< of `grains`
    double (*moved)[3];       ///< [n_grain] from where they lay [m]
    double period[3];
    int32_t most[3]; ///< images to either side
    bool is_own;     ///< pairs as the grains lay, else those that the images make
    bool has_moved;  ///< any grain; else the first image has pairs of its own alone
    double *share;   ///< [n_grain] of its points in others, counted up to 1
} image_search;

/// A grain in the place of one of its images.
typedef struct {
    const image_search *search;
    clx_touch_body body;
    double offset[3]; ///< of the image, and of the grain by the wrapping [m]
    int32_t grain;
    double share; ///< under construction
} image_visit;

/// Share of a body's points that another holds.
static double share_within(const clx_touch_body *body, const clx_touch_body *other)
{
    double cube[3] = {0.5, 0.5, 0.5};
    double x[3];
    int32_t n = 0;
    int32_t n_held = 0;
    for (int32_t tried = 0; n < POINTS && tried < 1000 * POINTS; ++tried) {
        clx_lattice_step(cube);
        if (clx_body_draw(body, cube, x)) {
            ++n;
            n_held += clx_body_holds(other, x) ? 1 : 0;
        }
    }
    return n > 0 ? (double)n_held / n : 0.0;
}

static bool add_covered(int32_t other, const clx_gap *gap, void *context)
{
    image_visit *v = context;
    const image_search *s = v->search;
    const clx_touch_body *body = clx_touch_scene_body(s->set->scene, other);
    double apart[3]; // from where the pair lay
    (void)gap;
    v3_sub(apart, v->offset, s->moved[other]);
    const bool is_own = v3_norm(apart) < 1e-6 * fmin(s->period[0], s->period[1]);
    if (is_own == s->is_own && !(is_own && other == v->grain) &&
        clx_touch_overlap(&v->body, body, OVERLAP * fmin(v->body.radius, body->radius), NULL)) {
        v->share += share_within(&v->body, body);
    }
    return v->share < 1.0; // heaps in a bed far too small
}

static void find_covered(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const image_search *s = context;
    (void)worker;
    const int32_t side[3] = {2 * s->most[0] + 1, 2 * s->most[1] + 1, 2 * s->most[2] + 1};
    for (int64_t i = begin; i < end; ++i) {
        image_visit v = {.search = s, .grain = (int32_t)i};
        for (int32_t m = 0; m < side[0] * side[1] * side[2] && v.share < 1.0; ++m) {
            const int32_t up = m / (side[0] * side[1]) - s->most[2];
            const double image[3] = {(m % side[0] - s->most[0]) * s->period[0] + up * s->bed->shift,
                                     (m / side[0] % side[1] - s->most[1]) * s->period[1],
                                     up * s->period[2]};
            double place[3];
            if (v3_norm2(image) == 0.0 && !s->is_own && !s->has_moved) {
                continue;
            }
            v.body = *clx_touch_scene_body(s->set->scene, v.grain);
            v3_add(place, v.body.position, image);
            v3_add(v.offset, s->moved[i], image);
            clx_touch_body_move(&v.body, place);
            (void)clx_touch_scene_contacts(s->set->scene, &v.body, 0.0, add_covered, &v);
        }
        s->share[i] = v.share;
    }
}

/// Solid that pairs share, which counts twice, and of how many grains.
static clast_status measure_covered(image_search *s, clast_bed_beyond *covered)
{
    clast_status status = CLAST_OK;
    clx_touch_set set = {0};
    *covered = (clast_bed_beyond){0};
    CLX_TRY(clx_touch_set_init(s->grains, &set));
    s->set = &set;
    clx_parallel_for(s->grains->n_grain, BLOCK, find_covered, s);
    for (int32_t i = 0; i < s->grains->n_grain; ++i) {
        const double scale = s->grains->scale[i];
        const double volume =
            scale * scale * scale * s->grains->shape[s->grains->shape_id[i]].volume;
        covered->n += s->share[i] > 0.0 ? 1 : 0;
        covered->solid += 0.5 * s->share[i] * volume; // a pair is found from both sides
    }
done:
    s->set = NULL;
    clx_touch_set_free(&set);
    return status;
}

/// How many images to either side can reach a grain; of a bed far too small the first find it out.
static void count_images(image_search *s)
{
    const clast_assembly *a = s->grains;
    double bounding_radius = 0.0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        bounding_radius =
            fmax(bounding_radius, a->scale[i] * a->shape[a->shape_id[i]].bounding_radius);
    }
    for (int k = 0; k < 3; ++k) {
        s->most[k] =
            s->period[k] > 0.0 ? 1 + (int32_t)fmin(2.0 * bounding_radius / s->period[k], 2.0) : 0;
    }
    s->most[0] += s->bed->shift != 0.0 ? 1 : 0;
}

/// Grains that take more than the volume lie on a heap, whose pairs are those of all with all.
static clast_status check_volume(const clast_bed *bed, const clast_assembly *assembly)
{
    const char *unit = strcmp(assembly->unit, "m") == 0 ? "m" : "-";
    double low[3];
    double high[3];
    double volume = 0.0;
    clast_assembly_bounds(assembly, low, high);
    const bool is_endless = bed->kind == CLAST_BED_PERIODIC_3D;
    const double edge[2] = {is_endless ? bed->floor : fmin(bed->floor, low[2]),
                            is_endless ? bed->ceiling : high[2]};
    clast_bed_volumes(bed, 1, edge, &volume);
    const double solid = clast_assembly_volume(assembly);
    return solid <= MOST_SOLID * volume
               ? CLAST_OK
               : clx_fail(CLAST_E_GEOMETRY,
                          "grains take %.4g times the volume of one period between z = %s and %s: "
                          "the bed's period is not theirs, or in another unit",
                          solid / volume, clx_unit_text(edge[0], unit),
                          clx_unit_text(edge[1], unit));
}

clast_status clx_images_measure(const clast_bed *bed, const clast_assembly *assembly,
                                clast_bed_beyond *beyond)
{
    clast_status status = CLAST_OK;
    clast_assembly wrapped = *assembly;
    image_search s = {.grains = &wrapped, .bed = bed};
    clast_bed_beyond made = {0};
    clast_bed_beyond own = {0};
    const size_t row = sizeof *wrapped.position;
    wrapped.position = NULL;
    CLX_TRY(check_volume(bed, assembly));
    CLX_TRY(clx_alloc(&wrapped.position, assembly->n_grain, row));
    CLX_TRY(clx_alloc(&s.moved, assembly->n_grain, row));
    CLX_TRY(clx_alloc(&s.share, assembly->n_grain, sizeof *s.share));
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        v3_copy(wrapped.position[i], assembly->position[i]);
    }
    clast_bed_wrap(bed, &wrapped);
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        v3_sub(s.moved[i], wrapped.position[i], assembly->position[i]);
        s.has_moved = s.has_moved || v3_norm2(s.moved[i]) > 0.0;
    }
    (void)clast_bed_period(bed, s.period);
    count_images(&s);
    CLX_TRY(measure_covered(&s, &made));
    if (made.n > 0) {
        image_search lying = {.grains = assembly,
                              .bed = bed,
                              .moved = s.moved,
                              .period = {s.period[0], s.period[1], s.period[2]},
                              .is_own = true,
                              .share = s.share};
        memset(s.moved, 0, (size_t)assembly->n_grain * row);
        CLX_TRY(measure_covered(&lying, &own));
    }
    made.solid = fmax(made.solid - own.solid, 0.0);
    *beyond = made;
done:
    CLX_FREE(wrapped.position, s.moved, s.share);
    return status;
}
