// Area of a union of discs: Green's theorem over the arcs of each circle that no other disc holds.
//
//     area = 1/2 sum over arcs (a, b) of  r^2 (b - a) + r x0 (sin b - sin a) - r y0 (cos b - cos a)
#include "porosity/discs.h"

#include "base/alloc.h"
#include "math/sort.h"
#include <math.h>
#include <stdlib.h>

/// Part of a circle that another disc holds, 0 <= from <= to <= 2 pi.
typedef struct {
    double from, to;
} arc;

CLX_RISING(by_from, arc, from)

static double arc_area(const clx_disc *d, double a, double b)
{
    return 0.5 * d->r * (d->r * (b - a) + d->x * (sin(b) - sin(a)) - d->y * (cos(b) - cos(a)));
}

/// Adds the part of disc i's circle that disc j holds; true when that is all of it.
static bool hidden(const clx_disc *disc, int32_t i, int32_t j, arc *held, int32_t *n_held)
{
    CLAST_ASSERT(i != j);
    const double two_pi = 2.0 * CLAST_PI;
    const double dx = disc[j].x - disc[i].x;
    const double dy = disc[j].y - disc[i].y;
    const double d = sqrt(dx * dx + dy * dy);
    const double r = disc[i].r;
    const double other = disc[j].r;
    if (d + r <= other) { // within the other; of two equal ones the later stays
        return d + other > r || j > i;
    }
    if (d >= r + other || d + other <= r) {
        return false;
    }
    const double half =
        acos(fmin(1.0, fmax(-1.0, (d * d + r * r - other * other) / (2.0 * d * r))));
    double from = atan2(dy, dx) - half;
    double to = from + 2.0 * half;
    if (from < 0.0) {
        from += two_pi;
        to += two_pi;
    }
    held[(*n_held)++] = (arc){from, fmin(to, two_pi)};
    if (to > two_pi) {
        held[(*n_held)++] = (arc){0.0, to - two_pi};
    }
    return false;
}

clast_status clx_discs_area(int32_t n, const clx_disc *disc, double *area)
{
    CLAST_ASSERT(n >= 0);
    clast_status status = CLAST_OK;
    arc *held = NULL;
    double sum = 0.0;
    CLX_TRY(clx_alloc(&held, 2LL * n, sizeof *held));
    for (int32_t i = 0; i < n; ++i) {
        int32_t n_held = 0;
        double at = 0.0;
        bool none = false;
        for (int32_t j = 0; j < n && !none; ++j) {
            none = j != i && hidden(disc, i, j, held, &n_held);
        }
        if (none) {
            continue;
        }
        if (n_held > 0) {
            qsort(held, (size_t)n_held, sizeof *held, by_from);
        }
        for (int32_t k = 0; k < n_held; ++k) {
            sum += held[k].from > at ? arc_area(&disc[i], at, held[k].from) : 0.0;
            at = fmax(at, held[k].to);
        }
        sum += at < 2.0 * CLAST_PI ? arc_area(&disc[i], at, 2.0 * CLAST_PI) : 0.0;
    }
    *area = sum;
done:
    clx_free(held);
    return status;
}
