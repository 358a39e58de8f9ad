// Points without doubles: a hash table with open addressing over the bits of the coordinates.
#include "geom/vertex_set.h"

#include "base/alloc.h"
#include <math.h>
#include <string.h>

static uint64_t mix(uint64_t h, double x)
{
    uint64_t bits = 0;
    memcpy(&bits, &x, sizeof bits);
    h = (h ^ bits) * 0x9e3779b97f4a7c15u; // splitmix64's finaliser, chained
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    return h ^ (h >> 31);
}

static int64_t home(const clx_vertex_set *set, const double p[3])
{
    return (int64_t)(mix(mix(mix(0, p[0]), p[1]), p[2]) & (uint64_t)(set->n_slot - 1));
}

static clast_status rehash(clx_vertex_set *set)
{
    CLAST_ASSERT(set->n <= set->n_slot);
    clast_status status = CLAST_OK;
    int32_t *slot = NULL;
    const int64_t n_slot = set->n_slot == 0 ? 64 : 2 * set->n_slot;
    CLX_TRY(clx_alloc(&slot, n_slot, sizeof *slot));
    clx_free(set->slot);
    set->slot = slot;
    set->n_slot = n_slot;
    for (int64_t i = 0; i < set->n; ++i) {
        int64_t h = home(set, set->vert[i]);
        while (set->slot[h] != 0) {
            h = (h + 1) & (n_slot - 1);
        }
        set->slot[h] = (int32_t)(i + 1);
    }
done:
    return status;
}

clast_status clx_vertex_set_add(clx_vertex_set *set, const double point[3], int32_t *index)
{
    CLAST_ASSERT(2 * set->n <= set->n_slot && !isnan(point[0] + point[1] + point[2]));
    clast_status status = CLAST_OK;
    const double p[3] = {point[0] + 0.0, point[1] + 0.0, point[2] + 0.0}; // -0 + 0 = +0
    if (2 * set->n >= set->n_slot) {
        CLX_TRY(rehash(set));
    }
    int64_t h = home(set, p);
    while (set->slot[h] != 0) {
        const double *q = set->vert[set->slot[h] - 1];
        if (q[0] == p[0] && q[1] == p[1] && q[2] == p[2]) { // no NaN comes here
            *index = set->slot[h] - 1;
            return CLAST_OK;
        }
        h = (h + 1) & (set->n_slot - 1);
    }
    CLX_CHECK(set->n < INT32_MAX - 1, CLAST_E_LIMIT, "more than 2^31 vertices");
    CLX_TRY(clx_grow(&set->vert, &set->capacity, set->n + 1, sizeof *set->vert));
    memcpy(set->vert[set->n], p, sizeof p);
    *index = (int32_t)set->n++;
    set->slot[h] = *index + 1;
done:
    return status;
}

void clx_vertex_set_free(clx_vertex_set *set)
{
    CLX_FREE(set->vert, set->slot);
    *set = (clx_vertex_set){0};
}
