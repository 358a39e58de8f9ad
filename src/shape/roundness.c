// Wadell's roundness after Zheng and Hryciw 2015: key points of the smoothed outline of the
// greatest shadow, circles fitted to its convex runs, their mean radius by that of the greatest
// circle inside.
//
// What is theirs: the greatest projection, local quadratic smoothing over 7 % of the outline, key
// points from the deviation of chords, the longest run of convex key points whose circle is smaller
// than the inscribed one and nowhere leaves the outline by more than 2 % of its radius, then the
// next run. What is ours: a corner too sharp for three key points counts with the radius of the
// nine points about it; lengths are taken from the inscribed circle instead of pixels (chords
// deviate by 0.003 R; their 0.3 pixels at 200 pixels across) and the window is 7 % of that circle's
// circumference, so that long grains lose no more of their corners than round ones; runs begin
// behind the longest gap.                                            [docs/theory/form.md]
#include "shape/roundness.h"

#include "base/alloc.h"
#include "shape/outline.h"
#include <clast/grain.h>
#include <clast/mesh.h>
#include <math.h>

enum { N_POINT = CLX_OUTLINE_POINTS, LEAST_RUN = 3, N_START = 8 };

static const double WINDOW = 0.07;  ///< of the inscribed circle's circumference
static const double CHORD = 0.003;  ///< greatest deviation of a chord, in inscribed radii
static const double INSIDE = 0.98;  ///< least distance of outline and circle's centre, in radii
static const double ALLOWED = 1.01; ///< radius of a corner, in inscribed radii
static const double SHARP = 0.15;   ///< corners below may have too few key points for a run
static const double GOLDEN = 0.61803398874989485; ///< of a turn from one start to the next

typedef struct {
    clx_outline outline;
    double radius;        ///< of the inscribed circle
    bool is_key[N_POINT]; ///< ends of chords
    int32_t n;            ///< convex key points
    int32_t at[N_POINT];  ///< their places on the outline
    double key[N_POINT][2];
} search;

/// Marks key points between two of them: where a chord deviates most, until none deviates by more
/// than the tolerance. `last` may be N_POINT, the first point again.
static void mark_between(search *s, int32_t first, int32_t last, int32_t stack[2 * N_POINT])
{
    CLAST_ASSERT(first >= 0 && first <= last && last < 2 * N_POINT);
    int32_t n = 0;
    stack[n++] = first;
    stack[n++] = last;
    while (n > 0) {
        const int32_t b = stack[--n];
        const int32_t a = stack[--n];
        const double *p = s->outline.point[a % N_POINT];
        const double *q = s->outline.point[b % N_POINT];
        const double d[2] = {q[0] - p[0], q[1] - p[1]};
        double most = CHORD * s->radius * hypot(d[0], d[1]);
        int32_t at = -1;
        for (int32_t i = a + 1; i < b; ++i) {
            const double *x = s->outline.point[i % N_POINT];
            const double off = fabs(d[0] * (x[1] - p[1]) - d[1] * (x[0] - p[0]));
            if (off > most) {
                most = off;
                at = i;
            }
        }
        if (at >= 0) {
            s->is_key[at % N_POINT] = true;
            stack[n++] = a;
            stack[n++] = at;
            stack[n++] = at;
            stack[n++] = b;
        }
    }
}

static int32_t farthest_from(const clx_outline *outline, const double c[2])
{
    double far2 = -1.0;
    int32_t far = 0;
    for (int32_t i = 0; i < N_POINT; ++i) {
        const double x = outline->point[i][0] - c[0];
        const double y = outline->point[i][1] - c[1];
        if (x * x + y * y > far2) {
            far2 = x * x + y * y;
            far = i;
        }
    }
    return far;
}

/// Key points around the outline, from two far apart on.
static void mark_keys(search *s)
{
    int32_t stack[4 * N_POINT];
    const int32_t a = farthest_from(&s->outline, (const double[2]){0.0, 0.0});
    const int32_t b = farthest_from(&s->outline, s->outline.point[a]);
    s->is_key[a] = true;
    s->is_key[b] = true;
    const int32_t low = a < b ? a : b;
    const int32_t high = a < b ? b : a;
    mark_between(s, low, high, stack);
    mark_between(s, high, low + N_POINT, stack);
}

/// Places of the key points where the outline turns left. Returns their number.
static int32_t find_convex(const search *s, int32_t *convex)
{
    int32_t all[N_POINT];
    int32_t n_all = 0;
    int32_t n = 0;
    for (int32_t i = 0; i < N_POINT; ++i) {
        if (s->is_key[i]) {
            all[n_all++] = i;
        }
    }
    for (int32_t i = 0; i < n_all; ++i) {
        const double *p = s->outline.point[all[(i + n_all - 1) % n_all]];
        const double *q = s->outline.point[all[i]];
        const double *r = s->outline.point[all[(i + 1) % n_all]];
        if ((q[0] - p[0]) * (r[1] - q[1]) - (q[1] - p[1]) * (r[0] - q[0]) > 0.0) {
            convex[n++] = all[i];
        }
    }
    return n;
}

/// Keeps the convex key points, beginning behind the longest gap between two of them.
static void keep_convex(search *s)
{
    int32_t convex[N_POINT];
    double longest = -1.0;
    int32_t begin = 0;
    s->n = find_convex(s, convex);
    for (int32_t i = 0; i < s->n; ++i) {
        const double *p = s->outline.point[convex[(i + s->n - 1) % s->n]];
        const double *q = s->outline.point[convex[i]];
        const double gap = hypot(q[0] - p[0], q[1] - p[1]);
        if (gap > longest) {
            longest = gap;
            begin = i;
        }
    }
    for (int32_t i = 0; i < s->n; ++i) {
        s->at[i] = convex[(begin + i) % s->n];
        s->key[i][0] = s->outline.point[s->at[i]][0];
        s->key[i][1] = s->outline.point[s->at[i]][1];
    }
}

/// Circle of least algebraic distance to n points [Kasa1976]; radius infinite for a line.
static double fit_circle(int32_t n, const double (*p)[2], double centre[2])
{
    CLAST_ASSERT(n >= 3);
    double middle[2] = {0};
    double m[5] = {0}; // xx, xy, yy, x times square, y times square
    double mean_square = 0.0;
    for (int32_t i = 0; i < n; ++i) {
        middle[0] += p[i][0] / n;
        middle[1] += p[i][1] / n;
    }
    for (int32_t i = 0; i < n; ++i) {
        const double x = p[i][0] - middle[0];
        const double y = p[i][1] - middle[1];
        const double square = x * x + y * y;
        m[0] += x * x;
        m[1] += x * y;
        m[2] += y * y;
        m[3] += x * square;
        m[4] += y * square;
        mean_square += square / n;
    }
    const double determinant = m[0] * m[2] - m[1] * m[1];
    if (!(determinant > 1e-12 * (m[0] + m[2]) * (m[0] + m[2]))) {
        return INFINITY;
    }
    const double x = 0.5 * (m[3] * m[2] - m[4] * m[1]) / determinant;
    const double y = 0.5 * (m[4] * m[0] - m[3] * m[1]) / determinant;
    centre[0] = middle[0] + x;
    centre[1] = middle[1] + y;
    return sqrt(x * x + y * y + mean_square);
}

static bool stays_inside(const clx_outline *outline, const double centre[2], double radius)
{
    const double least2 = INSIDE * INSIDE * radius * radius;
    for (int32_t i = 0; i < N_POINT; ++i) {
        const double x = outline->point[i][0] - centre[0];
        const double y = outline->point[i][1] - centre[1];
        if (x * x + y * y < least2) {
            return false;
        }
    }
    return true;
}

/// Key points from `first` on that share a corner, and its radius; 0 where no corner begins.
static int32_t longest_corner(const search *s, int32_t first, double *radius)
{
    CLAST_ASSERT(first >= 0 && first < s->n);
    for (int32_t n = s->n - first; n >= LEAST_RUN; --n) {
        double centre[2] = {0};
        *radius = fit_circle(n, (const double(*)[2])s->key + first, centre);
        if (*radius <= ALLOWED * s->radius && stays_inside(&s->outline, centre, *radius)) {
            return n;
        }
    }
    return 0;
}

/// Radius of the outline at a key point alone, from the points next to it.
static double own_radius(const search *s, int32_t key)
{
    enum { N_SIDE = 4 };
    double near[2 * N_SIDE + 1][2];
    double centre[2] = {0};
    for (int32_t i = -N_SIDE; i <= N_SIDE; ++i) {
        const double *p = s->outline.point[(s->at[key] + i + N_POINT) % N_POINT];
        near[i + N_SIDE][0] = p[0];
        near[i + N_SIDE][1] = p[1];
    }
    return fit_circle(2 * N_SIDE + 1, (const double(*)[2])near, centre);
}

static double mean_corner(const search *s)
{
    double sum = 0.0;
    int32_t n_corner = 0;
    for (int32_t first = 0; first < s->n;) {
        double radius = 0.0;
        int32_t n = longest_corner(s, first, &radius);
        if (n == 0) {
            radius = own_radius(s, first);
            n = 1;
        }
        if (n > 1 || radius < SHARP * s->radius) {
            sum += fmin(radius / s->radius, 1.0);
            ++n_corner;
        }
        first += n;
    }
    return n_corner > 0 ? sum / n_corner : (double)NAN;
}

/// Radii of the greatest circles inside the outline as it was cast and as it was smoothed: neither
/// hangs on where it starts.
typedef struct {
    double raw, smooth;
} circles;

/// Roundness by one start of the search, the first of which finds the circles; NAN where the
/// outline is too coarse.
static clast_status round_from(const clx_rim *rim, int start, search *s, circles *inside,
                               double *roundness)
{
    clast_status status = CLAST_OK;
    double middle[2];
    *s = (search){0};
    *roundness = NAN;
    CLX_TRY(clx_outline_cast(rim, 2.0 * CLAST_PI * GOLDEN * start, start % 2 != 0, &s->outline));
    if (s->outline.n_edge < (start == 0 ? CLAST_ROUNDNESS_EDGES : 1)) {
        goto done;
    }
    if (start == 0) {
        clx_outline_inscribed(&s->outline, middle, &inside->raw);
    }
    clx_outline_smooth(&s->outline, WINDOW * 2.0 * CLAST_PI * inside->raw);
    if (start == 0) {
        clx_outline_inscribed(&s->outline, middle, &inside->smooth);
    }
    s->radius = inside->smooth;
    mark_keys(s);
    keep_convex(s);
    *roundness = mean_corner(s);
done:
    return status;
}

/// Mean and standard deviation over the starts.
static clast_status round_from_all(const clx_rim *rim, search *s, clast_grain *grain)
{
    clast_status status = CLAST_OK;
    double value[N_START];
    circles inside = {0};
    double sum = 0.0;
    double square = 0.0;
    for (int k = 0; k < N_START; ++k) {
        CLX_TRY(round_from(rim, k, s, &inside, &value[k]));
        if (k == 0) {
            grain->n_outline = s->outline.n_edge;
        }
        if (isnan(value[k])) { // too coarse
            return CLAST_OK;
        }
        sum += value[k];
    }
    for (int k = 0; k < N_START; ++k) {
        const double off = value[k] - sum / N_START;
        square += off * off;
    }
    grain->roundness = sum / N_START;
    grain->roundness_deviation = sqrt(square / (N_START - 1));
done:
    return status;
}

clast_status clx_grain_roundness(const clast_mesh *mesh, const double direction[3],
                                 clast_grain *grain)
{
    clast_status status = CLAST_OK;
    search *s = NULL;
    clx_rim rim = {0};
    grain->roundness = NAN;
    grain->roundness_deviation = NAN;
    grain->n_outline = 0;
    if (mesh->n_tri < CLAST_ROUNDNESS_FACES) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&s, 1, sizeof *s));
    CLX_TRY(clx_rim_find(mesh, direction, grain->centroid, &rim));
    CLX_TRY(round_from_all(&rim, s, grain));
done:
    clx_rim_free(&rim);
    clx_free(s);
    return status;
}
