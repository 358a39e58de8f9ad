// Contacts and overlaps of grains that repeat periodically: each grain's image within the box,
// those near the border once more as images on the other side, and of each pair that meets there
// only one of its two sights.
#include <clast/assembly.h>

#include "assembly/touch_set.h"
#include "assembly/union.h"
#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/status.h"
#include "math/vec3.h"
#include <clast/shape.h>

/// The grains, then images of those near the border.
typedef struct {
    clast_assembly all;
    int32_t n_own;
    int32_t *origin;    ///< [all.n_grain] the grain that each is
    double (*shift)[3]; ///< [n_own] from a grain to its image within the box
    int64_t capacity;
} imaged;

static void imaged_free(imaged *m)
{
    clast_assembly_free(&m->all);
    CLX_FREE(m->origin, m->shift);
    *m = (imaged){0};
}

static clast_status add_image(const clast_assembly *a, int32_t i, const double shift[3], imaged *m)
{
    CLAST_ASSERT(i >= 0 && i < a->n_grain);
    clast_status status = CLAST_OK;
    double at[3];
    v3_add(at, a->position[i], shift);
    CLX_TRY(clx_grow(&m->origin, &m->capacity, (int64_t)m->all.n_grain + 1, sizeof *m->origin));
    m->origin[m->all.n_grain] = i;
    CLX_TRY(clast_assembly_add_grain(&m->all, a->shape_id[i], at, a->orientation[i], a->scale[i],
                                     a->density[i]));
done:
    return status;
}

static double bounding_radius_of(const clast_assembly *a, int32_t i)
{
    return a->scale[i] * a->shape[a->shape_id[i]].bounding_radius;
}

/// From grain i to its image within the box: 0 for one that lies in it.
static void find_shift(const clast_assembly *a, int32_t i, const clast_period *period,
                       double shift[3])
{
    v3_set(shift, 0.0, 0.0, 0.0);
    for (int k = 0; k < 3 && period != NULL; ++k) {
        const double x = a->position[i][k] - period->low[k];
        const double length = period->length[k];
        if (length > 0.0 && (x < 0.0 || x > length)) {
            shift[k] = -length * floor(x / length);
        }
    }
}

/// Images of grain i, whose own is in `m`, that may come near a grain of the box.
static clast_status add_images(const clast_assembly *a, int32_t i, const clast_period *period,
                               double near, imaged *m)
{
    clast_status status = CLAST_OK;
    for (int image = 0; image < 27; ++image) {
        const int step[3] = {image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1};
        double shift[3];
        bool is_near = image != 13; // 13 is the grain itself
        for (int k = 0; k < 3 && is_near; ++k) {
            shift[k] = step[k] * period->length[k];
            const double x = m->all.position[i][k] + shift[k] - period->low[k];
            shift[k] += m->shift[i][k];
            const double bounding_radius = bounding_radius_of(a, i) + near;
            is_near = step[k] == 0 || (period->length[k] > 0.0 && x > -bounding_radius &&
                                       x < period->length[k] + bounding_radius);
        }
        if (is_near) {
            CLX_TRY(add_image(a, i, shift, m));
        }
    }
done:
    return status;
}

static clast_status make_images(const clast_assembly *a, const clast_period *period, double gap,
                                imaged *m)
{
    CLAST_ASSERT(m->all.n_grain == 0);
    clast_status status = CLAST_OK;
    double largest = 0.0;
    CLX_TRY(clx_alloc(&m->shift, a->n_grain, sizeof *m->shift));
    CLX_TRY(clx_assembly_add_shapes(&m->all, a->n_shape, a->shape, sizeof *a->shape));
    for (int32_t i = 0; i < a->n_grain; ++i) {
        largest = fmax(largest, bounding_radius_of(a, i));
        find_shift(a, i, period, m->shift[i]);
        CLX_TRY(add_image(a, i, m->shift[i], m));
    }
    m->n_own = a->n_grain;
    for (int32_t i = 0; i < a->n_grain && period != NULL; ++i) {
        CLX_TRY(add_images(a, i, period, largest + gap, m));
    }
done:
    return status;
}

/// Of a pair across the border, seen from both sides, the one whose own grain has the lower number.
/// Not a grain and its own image.
static bool counts(const imaged *m, const int32_t pair[2])
{
    return m->origin != NULL && pair[0] < m->n_own &&
           (pair[1] < m->n_own || m->origin[pair[0]] < m->origin[pair[1]]);
}

static void keep_counted(const imaged *m, clx_pairs *pairs)
{
    int32_t n = 0;
    for (int32_t p = 0; p < pairs->n; ++p) {
        if (counts(m, pairs->pair[p])) {
            pairs->pair[n][0] = pairs->pair[p][0];
            pairs->pair[n++][1] = pairs->pair[p][1];
        }
    }
    pairs->n = n;
}

static clast_status check_period(const clast_period *period)
{
    clast_status status = CLAST_OK;
    for (int k = 0; k < 3 && period != NULL; ++k) {
        CLX_CHECK(isfinite(period->low[k]) && isfinite(period->length[k]) &&
                      period->length[k] >= 0.0,
                  CLAST_E_ARGUMENT,
                  "the period along %c is %g m from %g m; both must be finite, 0: no period",
                  'x' + k, period->length[k], period->low[k]);
    }
done:
    return status;
}

clast_status clast_assembly_find_contacts_periodic(clast_assembly *assembly, double gap,
                                                   const clast_period *period)
{
    CLX_ARGUMENTS(assembly);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    imaged m = {0};
    clast_assembly made = {.n_grain = assembly->n_grain}; // carries the contacts only
    if (period == NULL) {
        return clast_assembly_find_contacts(assembly, gap);
    }
    CLX_CHECK(gap >= 0.0 && isfinite(gap), CLAST_E_USAGE,
              "contacts: gap %g must be finite and not negative", gap);
    CLX_TRY(check_period(period));
    CLX_TRY(make_images(assembly, period, gap, &m));
    CLX_TRY(clast_assembly_find_contacts(&m.all, gap));
    CLX_TRY(clx_alloc(&made.contact, m.all.n_contact + 1LL, sizeof *made.contact));
    CLX_TRY(clx_alloc(&made.contact_point, m.all.n_contact + 1LL, sizeof *made.contact_point));
    made.contact_capacity = m.all.n_contact + 1;
    for (int32_t c = 0; c < m.all.n_contact; ++c) {
        const int32_t *pair = m.all.contact[c];
        if (counts(&m, pair)) {
            double point[3]; // beside the grain of lower number, which is the pair's first
            v3_sub(point, m.all.contact_point[c], m.shift[pair[0]]);
            CLX_TRY(clast_assembly_add_contact(&made, m.origin[pair[0]], m.origin[pair[1]], point));
        }
    }
    clx_contacts_replace(assembly, &made);
done:
    CLX_FREE(made.contact, made.contact_point);
    imaged_free(&m);
    return status;
}

clast_status clast_assembly_overlaps(const clast_assembly *assembly, const clast_period *period,
                                     clast_overlaps *overlaps)
{
    CLX_ARGUMENTS(assembly, overlaps);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    imaged m = {0};
    clx_touch_set set = {0};
    clx_pairs pairs = {0};
    clast_union found = {0};
    CLX_TRY(check_period(period));
    CLX_TRY(make_images(assembly, period, 0.0, &m));
    CLX_TRY(clx_touch_set_init(&m.all, &set));
    CLX_TRY(clx_touch_set_near(&set, &pairs));
    keep_counted(&m, &pairs);
    CLX_TRY(clx_keep_overlaps(&m.all, &set, true, &pairs, &found));
    *overlaps = (clast_overlaps){
        .n = pairs.n, .depth = found.max_overlap, .share = found.max_overlap_share};
done:
    clx_pairs_free(&pairs);
    clx_touch_set_free(&set);
    imaged_free(&m);
    return status;
}
