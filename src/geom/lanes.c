// The loops that hulls spend most of their time in: balls against a plane, a point against planes.
#include "geom/lanes.h"

#include "base/status.h"

#include <math.h>

// Clang takes no vectors by value between a clone and what it inlines, and the thread sanitizer
// starts after the choice is made: those builds keep to SSE2.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) &&                        \
    !defined(__SANITIZE_THREAD__)
#define FOR_EACH_MACHINE __attribute__((target_clones("avx2", "default")))
#else
#define FOR_EACH_MACHINE
#endif

typedef double four __attribute__((vector_size(32), aligned(8), may_alias));
typedef int64_t marks __attribute__((vector_size(32)));

void clx_lanes_set(clx_lanes *lanes, int32_t i, const double v[3], double w)
{
    CLAST_ASSERT(i >= 0);
    clx_lanes *group = &lanes[i / 4];
    for (int k = i % 4; k < 4; ++k) {
        group->w[k] = k == i % 4 ? w : -HUGE_VAL;
        for (int j = 0; j < 3; ++j) {
            group->v[j][k] = v[j];
        }
    }
}

FOR_EACH_MACHINE
int32_t clx_lanes_next(const clx_lanes *lanes, int32_t group, int32_t n_group, const double n[3],
                       double beyond)
{
    CLAST_ASSERT(group >= 0 && n_group >= 0);
    for (; group < n_group; ++group) {
        const clx_lanes *b = &lanes[group];
        const four *x = (const four *)b->v[0];
        const four *y = (const four *)b->v[1];
        const four *z = (const four *)b->v[2];
        const four *w = (const four *)b->w;
        const marks far = n[0] * *x + n[1] * *y + n[2] * *z + *w > beyond;
        if ((far[0] | far[1] | far[2] | far[3]) != 0) {
            break;
        }
    }
    return group;
}
