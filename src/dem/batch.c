// Contacts in four SIMD lanes, or in eight where the machine has them (batch_avx512.c).
#include "dem/batch.h"

#include "dem/batch_avx512.h"
#include "dem/batch_lanes.h"

#if CLX_MAKES_WIDE
/// Whether the batch goes through eight lanes: with four pairs half of them would be idle.
static inline bool uses_eight(const clx_batch *p)
{
    return CLX_IS_WIDE && p->n > CLX_LANES;
}
#endif

CLX_FOR_EACH_MACHINE
void clx_batch_offsets(const clast_dem *dem, clx_batch *p)
{
    CLAST_ASSERT(p->n >= 1 && p->n <= CLX_BATCH);
    clx_lanes a[4], b[4], r[3];
    for (int from = 0; from < p->n; from += CLX_LANES) {
        offsets(dem, p, from, a, b, r);
        store3(p->meet.offset[0] + from, r);
    }
}

CLX_FOR_EACH_MACHINE
void clx_batch_arms(clx_batch *p)
{
    CLAST_ASSERT(p->n >= 1 && p->n <= CLX_BATCH);
    clx_lanes offset[3], arm[3];
    for (int from = 0; from < p->n; from += CLX_LANES) {
        load3(p->meet.offset[0] + from, offset);
        load3(p->meet.point[0] + from, arm);
        for (int c = 0; c < 3; ++c) {
            arm[c] = arm[c] - offset[c];
        }
        store3(p->arm_b[0] + from, arm);
    }
}

CLX_FOR_EACH_MACHINE
static void spheres(const clast_dem *dem, clx_batch *p, int from)
{
    contact_of_spheres(dem, p, from);
}

CLX_FOR_EACH_MACHINE
static int faces(const clast_dem *dem, clx_batch *p, int from)
{
    return contact_of_facets(dem, p, from, false);
}

CLX_FOR_EACH_MACHINE
static int edges(const clast_dem *dem, clx_batch *p, int from)
{
    return contact_of_facets(dem, p, from, true);
}

CLX_FOR_EACH_MACHINE
static void force(const clast_dem *dem, const clx_batch *p, clx_batch_kind kind)
{
    batch_force(dem, p, kind);
}

void clx_batch_spheres(const clast_dem *dem, clx_batch *p)
{
#if CLX_MAKES_WIDE
    if (uses_eight(p)) {
        clx_avx512_spheres(dem, p);
        return;
    }
#endif
    for (int from = 0; from < p->n; from += CLX_LANES) {
        spheres(dem, p, from);
    }
}

int clx_batch_faces(const clast_dem *dem, clx_batch *p)
{
#if CLX_MAKES_WIDE
    if (uses_eight(p)) {
        return clx_avx512_faces(dem, p);
    }
#endif
    const int first = faces(dem, p, 0);
    return p->n > CLX_LANES ? first | faces(dem, p, CLX_LANES) << CLX_LANES : first;
}

int clx_batch_edges(const clast_dem *dem, clx_batch *p)
{
#if CLX_MAKES_WIDE
    if (uses_eight(p)) {
        return clx_avx512_edges(dem, p);
    }
#endif
    const int first = edges(dem, p, 0);
    return p->n > CLX_LANES ? first | edges(dem, p, CLX_LANES) << CLX_LANES : first;
}

void clx_batch_force(const clast_dem *dem, const clx_batch *p, clx_batch_kind kind)
{
    CLAST_ASSERT(p->n >= 1 && p->n <= CLX_BATCH && clx_batch_has_law(dem, kind));
#if CLX_MAKES_WIDE
    if (uses_eight(p)) {
        clx_avx512_force(dem, p, kind);
        return;
    }
#endif
    force(dem, p, kind);
}
