// Turns samples into the convex functions that fill_lp.c bounds f by.
//
// A surface point p says f(x) <= |x - p|, which rises again behind the wall, where f is negative: a
// cube that the wall crosses cannot be bounded by it. A ball (q, r) outside the solid says
// f(x) <= |x - q| - r, which falls on across the wall, with a curvature of 1 / r only.
#include "shape/fill_witness.h"

#include "math/vec3.h"

void clx_fill_witnesses_clear(clx_fill_witnesses *w)
{
    w->planes.n = 0;
    w->n_known = 0;
    w->digest = 0;
}

/// Bound by one witness, a sphere of radius r (0: a surface point): |x - p| - r over the cube.
///
/// With d = |centre - p| and unit g = (centre - p) / d: |centre + e - p| = d + g . e + k, where
/// k is about (|e|^2 - (g . e)^2) / 2d, at most h^2 / d when the edges are along g. Where the plane
/// through p across g parts the cube, the chord over its width stands for the kink. Only a good
/// guess is needed here: fill_lp.c computes the bound from the distances themselves.
static void add_plane(clx_fill_planes *planes, const clx_fill_region *c, const double away[3],
                      double r)
{
    CLAST_ASSERT(planes->n >= 0 && planes->n <= CLX_FILL_WITNESSES && c->half > 0.0);
    const double h = c->half;
    const double d2 = v3_norm2(away);
    const double max_distance = c->upper + r + 1.7320508075688773 * h;
    if (planes->n < CLX_FILL_WITNESSES &&
        d2 <= max_distance * max_distance) { // else above all known in the cube
        const int j = planes->n++;
        const double d = sqrt(d2);
        // the cube's width along g, halved, is along / d
        const double along = h * (fabs(away[0]) + fabs(away[1]) + fabs(away[2]));
        const double most = along < d2 ? d : d > 0.0 ? along / d : h;
        v3_copy(planes->away[j], away);
        planes->radius[j] = r;
        planes->tri[j] = NULL;
        planes->value[j] = most - r + h * h / (d + h);
        const double per_most = 1.0 / most;
        for (int k = 0; k < 3; ++k) {
            planes->gradient[k][j] = per_most * away[k];
        }
    }
}

/// True, and noted, when a sphere or triangle is new and there is room for it.
static bool is_new(clx_fill_witnesses *w, int32_t name)
{
    CLAST_ASSERT(w->n_known >= 0 && w->n_known <= CLX_FILL_WITNESSES);
    const uint64_t bit = (uint64_t)1 << ((uint32_t)name * 0x9e3779b1u >> 26);
    bool is_known = w->n_known == CLX_FILL_WITNESSES;
    for (int j = 0; (w->digest & bit) != 0 && j < w->n_known; ++j) { // few names share a bit
        is_known = is_known || w->known[j] == name;
    }
    if (is_known) {
        return false;
    }
    w->digest |= bit;
    w->known[w->n_known++] = name;
    return true;
}

/// The triangle of a sample: as a whole when it is not small against the cube, else its point.
static void add_surface(const clx_fill *fill, clx_fill_witnesses *w, const clx_fill_region *c,
                        const clx_fill_sample *p)
{
    const clx_fill_field *field = &fill->field;
    double away[3];
    if (p->tri >= 0 && !is_new(w, -1 - p->tri)) {
        return;
    }
    const int j = w->planes.n;
    if (p->tri < 0 || (double)p->size < c->half) {
        v3_sub(away, c->centre, p->nearest);
        add_plane(&w->planes, c, away, 0.0);
        return;
    }
    double from_corner[3];
    v3_sub(from_corner, c->centre, field->tri[p->tri][0]);
    clx_fill_triangle_away(field->tri[p->tri], from_corner, away);
    add_plane(&w->planes, c, away, 0.0);
    if (w->planes.n > j) {
        const double h = c->half;
        const double size = (double)p->size;
        w->planes.tri[j] = field->tri[p->tri];
        v3_copy(w->planes.away[j], from_corner);
        w->planes.value[j] -= h * h / (v3_norm(away) + h) * size / (size + h);
    }
}

/// A placed sphere or an outer ball.
static void add_ball(clx_fill_witnesses *w, const clx_fill_region *c, const double centre[3],
                     double radius)
{
    CLAST_ASSERT(radius >= 0.0);
    double away[3];
    v3_sub(away, c->centre, centre);
    add_plane(&w->planes, c, away, radius);
}

void clx_fill_witnesses_add(const clx_fill *fill, const clx_fill_region *region,
                            const clx_fill_sample *sample, clx_fill_witnesses *w)
{
    if (!isnan(sample->surface)) {
        add_surface(fill, w, region, sample);
    }
    if (sample->ball >= 0 && is_new(w, sample->ball)) {
        const double *b = fill->balls.ball[sample->ball];
        add_ball(w, region, b, b[3]);
    }
    if (sample->outer_radius > 0.0) {
        add_ball(w, region, sample->outer, sample->outer_radius);
    }
}
