// Envelopes while an aggregate grows: one growing hull per hull kind, the rest on demand.
#include "aggregate/envelope.h"

#include "assembly/hull_part.h"
#include "base/alloc.h"
#include "base/status.h"

typedef struct tracked {
    clast_envelope_kind kind;
    clx_hull_parts parts; ///< of the hull kinds
    clx_smooth_hull hull;
} tracked;

struct clx_envelope_tracker {
    clast_envelope_options options;
    int32_t n;
    tracked *item; ///< [n]
};

static bool is_hull(clast_envelope_kind kind)
{
    return kind == CLAST_ENVELOPE_SURFACE_HULL || kind == CLAST_ENVELOPE_SPHERE_HULL;
}

void clx_envelope_tracker_destroy(clx_envelope_tracker *tracker)
{
    if (tracker == NULL) {
        return;
    }
    for (int32_t k = 0; k < tracker->n; ++k) {
        clx_hull_parts_free(&tracker->item[k].parts);
        clx_smooth_hull_free(&tracker->item[k].hull);
    }
    CLX_FREE(tracker->item, tracker);
}

clast_status clx_envelope_tracker_create(int32_t n_kind, const clast_envelope_kind *kind,
                                         const clast_envelope_options *options,
                                         clx_envelope_tracker **tracker)
{
    CLAST_ASSERT(n_kind >= 0 && n_kind <= CLAST_N_ENVELOPE);
    clast_status status = CLAST_OK;
    clx_envelope_tracker *made = NULL;
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    CLX_TRY(clx_alloc(&made->item, n_kind, sizeof *made->item));
    made->options = *options;
    made->n = n_kind;
    for (int32_t k = 0; k < n_kind; ++k) {
        made->item[k].kind = kind[k];
        made->item[k].parts.of_spheres = kind[k] == CLAST_ENVELOPE_SPHERE_HULL;
    }
    *tracker = made;
    made = NULL;
done:
    clx_envelope_tracker_destroy(made);
    return status;
}

clast_status clx_envelope_tracker_add(clx_envelope_tracker *tracker, const clast_assembly *assembly,
                                      int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < assembly->n_grain);
    clast_status status = CLAST_OK;
    for (int32_t k = 0; k < tracker->n; ++k) {
        tracked *item = &tracker->item[k];
        if (is_hull(item->kind)) {
            CLX_TRY(clx_hull_parts_add(&item->parts, assembly, i, &item->hull));
            CLX_TRY(clx_smooth_hull_refine(&item->hull, tracker->options.tolerance));
        }
    }
done:
    return status;
}

clast_status clx_envelope_tracker_now(clx_envelope_tracker *tracker, const clast_assembly *assembly,
                                      clast_envelope *envelope)
{
    clast_status status = CLAST_OK;
    for (int32_t k = 0; k < tracker->n; ++k) {
        const tracked *item = &tracker->item[k];
        if (is_hull(item->kind)) {
            clx_hull_volume volume;
            clx_smooth_hull_volume(&item->hull, &volume);
            envelope[k] = clx_envelope_of_hull(item->kind, &volume);
        } else {
            CLX_TRY(clast_assembly_envelope(assembly, item->kind, &tracker->options, &envelope[k]));
        }
    }
done:
    return status;
}
