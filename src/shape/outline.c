// Outlines of shadows: cast, cut into equal pieces, smoothed; and the greatest circle inside.
#include "shape/outline.h"

#include "base/alloc.h"
#include "geom/topology.h"
#include "math/sort.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <stdlib.h>

enum { N_RAY = 2 * CLX_OUTLINE_POINTS, N_POINT = CLX_OUTLINE_POINTS };

/// A fan of rays about the centre of a shadow.
typedef struct {
    double ray[N_RAY][2];
    double farthest[N_RAY];
    int32_t edge[N_RAY]; ///< that it ends on
} fan;

static double cross2(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

static double dot2(const double a[2], const double b[2])
{
    return a[0] * b[0] + a[1] * b[1];
}

/// Lets the rays between the ends of an edge reach it.
static void cast_edge(fan *f, int32_t edge, const double a[2], const double b[2])
{
    CLAST_ASSERT(edge >= 0);
    const double step = 2.0 * CLAST_PI / N_RAY;
    const double d[2] = {b[0] - a[0], b[1] - a[1]};
    const double from = atan2(a[1], a[0]);
    double angle = atan2(b[1], b[0]) - from;
    angle -= 2.0 * CLAST_PI * floor(angle / (2.0 * CLAST_PI) + 0.5);
    const double low = angle < 0.0 ? from + angle : from;
    const int32_t first = (int32_t)ceil(low / step);
    const int32_t last = (int32_t)floor((low + fabs(angle)) / step);
    for (int32_t i = first; i <= last; ++i) {
        const int32_t j = (i + 2 * N_RAY) % N_RAY;
        const double *e = f->ray[j];
        const double slope = cross2(e, d);
        const double t = slope != 0.0 ? -cross2(e, a) / slope : 0.0;
        const double r = dot2(e, a) + fmin(fmax(t, 0.0), 1.0) * dot2(e, d);
        if (r > f->farthest[j]) {
            f->farthest[j] = r;
            f->edge[j] = edge;
        }
    }
}

static bool is_lit(const clast_mesh *mesh, int32_t t, const double direction[3])
{
    double u[3];
    double v[3];
    double n[3];
    const int32_t *corner = mesh->tri[t];
    v3_sub(u, mesh->vert[corner[1]], mesh->vert[corner[0]]);
    v3_sub(v, mesh->vert[corner[2]], mesh->vert[corner[0]]);
    v3_cross(n, u, v);
    return v3_dot(n, direction) > 0.0;
}

static void project(const clast_mesh *mesh, int32_t vertex, const double centre[3],
                    double axis[2][3], double out[2])
{
    double to[3];
    v3_sub(to, mesh->vert[vertex], centre);
    out[0] = v3_dot(to, axis[0]);
    out[1] = v3_dot(to, axis[1]);
}

/// True where facets on both sides of an edge are turned differently.
static bool is_rim_edge(const clx_topology *topology, int32_t edge, const bool *lit)
{
    const int32_t *half = topology->half + topology->begin[edge];
    for (int32_t i = 1; i < clx_edge_use(topology, edge); ++i) {
        if (lit[half[i] / 3] != lit[half[0] / 3]) {
            return true;
        }
    }
    return false;
}

clast_status clx_rim_find(const clast_mesh *mesh, const double direction[3], const double centre[3],
                          clx_rim *rim)
{
    CLAST_ASSERT(v3_is_unit(direction, 1e-9));
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    clx_rim made = {0};
    bool *lit = NULL;
    double axis[2][3];
    v3_frame(direction, axis[0], axis[1]);
    CLX_TRY(clx_topology_build(mesh, &topology));
    CLX_TRY(clx_alloc(&lit, mesh->n_tri, sizeof *lit));
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        lit[t] = is_lit(mesh, t, direction);
    }
    for (int32_t e = 0; e < topology.n_edge; ++e) {
        made.n += is_rim_edge(&topology, e, lit);
    }
    CLX_TRY(clx_alloc(&made.end, made.n, sizeof *made.end));
    for (int32_t e = 0, at = 0; e < topology.n_edge; ++e) {
        if (is_rim_edge(&topology, e, lit)) {
            project(mesh, topology.edge[e][0], centre, axis, made.end[at][0]);
            project(mesh, topology.edge[e][1], centre, axis, made.end[at++][1]);
        }
    }
    *rim = made;
    made = (clx_rim){0};
done:
    clx_rim_free(&made);
    clx_free(lit);
    clx_topology_free(&topology);
    return status;
}

void clx_rim_free(clx_rim *rim)
{
    clx_free(rim->end);
    *rim = (clx_rim){0};
}

/// Edges that the ends of the rays lie on, in turn; 0 when a ray ends nowhere.
static int32_t count_edges(const fan *f)
{
    int32_t n = 0;
    for (int i = 0; i < N_RAY; ++i) {
        if (!(f->farthest[i] > 0.0)) {
            return 0;
        }
        n += f->edge[i] != f->edge[(i + 1) % N_RAY];
    }
    return n;
}

static void end_of(const fan *f, int i, double out[2])
{
    out[0] = f->farthest[i % N_RAY] * f->ray[i % N_RAY][0];
    out[1] = f->farthest[i % N_RAY] * f->ray[i % N_RAY][1];
}

/// Cuts the polygon of the rays' ends into pieces of equal length.
static void cut(const fan *f, clx_outline *outline)
{
    double a[2];
    double b[2];
    outline->length = 0.0;
    for (int i = 0; i < N_RAY; ++i) {
        end_of(f, i, a);
        end_of(f, i + 1, b);
        outline->length += hypot(b[0] - a[0], b[1] - a[1]);
    }
    double passed = 0.0;
    int next = 0;
    for (int i = 0; i < N_RAY && next < N_POINT; ++i) {
        end_of(f, i, a);
        end_of(f, i + 1, b);
        const double piece = hypot(b[0] - a[0], b[1] - a[1]);
        for (; next < N_POINT && next * outline->length / N_POINT < passed + piece; ++next) {
            const double t = (next * outline->length / N_POINT - passed) / piece;
            outline->point[next][0] = a[0] + t * (b[0] - a[0]);
            outline->point[next][1] = a[1] + t * (b[1] - a[1]);
        }
        passed += piece;
    }
    for (; next < N_POINT; ++next) { // rounding of the length alone
        end_of(f, 0, outline->point[next]);
    }
}

/// A point of the rim as the rays see it.
static void turned(const double end[2], double c, double s, bool is_mirrored, double out[2])
{
    const double y = is_mirrored ? -end[1] : end[1];
    out[0] = c * end[0] + s * y;
    out[1] = c * y - s * end[0];
}

clast_status clx_outline_cast(const clx_rim *rim, double angle, bool is_mirrored,
                              clx_outline *outline)
{
    CLAST_ASSERT(rim->n == 0 || rim->end != NULL);
    clast_status status = CLAST_OK;
    fan *f = NULL;
    CLX_TRY(clx_alloc(&f, 1, sizeof *f));
    for (int i = 0; i < N_RAY; ++i) {
        f->ray[i][0] = cos(2.0 * CLAST_PI * i / N_RAY);
        f->ray[i][1] = sin(2.0 * CLAST_PI * i / N_RAY);
    }
    for (int32_t e = 0; e < rim->n; ++e) {
        double a[2];
        double b[2];
        turned(rim->end[e][0], cos(angle), sin(angle), is_mirrored, a);
        turned(rim->end[e][1], cos(angle), sin(angle), is_mirrored, b);
        cast_edge(f, e, a, b);
    }
    outline->n_edge = count_edges(f);
    if (outline->n_edge > 0) {
        cut(f, outline);
    }
done:
    clx_free(f);
    return status;
}

void clx_outline_smooth(clx_outline *outline, double window)
{
    CLAST_ASSERT(window >= 0.0);
    double weight[N_POINT / 2] = {0};
    double keep[N_POINT][2];
    const double piece = outline->length / N_POINT;
    const int wanted = (int)(0.5 * window / piece + 0.5);
    const int half = wanted < 2 ? 2 : wanted < N_POINT / 2 ? wanted : N_POINT / 2 - 1;
    double sum[3] = {0}; // of weight times x^0, x^2, x^4
    for (int i = -half; i <= half; ++i) {
        const double x = abs(i) / (half + 1.0);
        const double w = pow(1.0 - x * x * x, 3.0);
        weight[abs(i)] = w;
        sum[0] += w;
        sum[1] += w * x * x;
        sum[2] += w * x * x * x * x;
    }
    for (int i = 0; i <= half; ++i) { // the fitted quadratic's value in the middle
        const double x = i / (half + 1.0);
        weight[i] *= (sum[2] - sum[1] * x * x) / (sum[0] * sum[2] - sum[1] * sum[1]);
    }
    for (int i = 0; i < N_POINT; ++i) {
        keep[i][0] = outline->point[i][0];
        keep[i][1] = outline->point[i][1];
    }
    for (int i = 0; i < N_POINT; ++i) {
        for (int k = 0; k < 2; ++k) {
            double value = weight[0] * keep[i][k];
            for (int j = 1; j <= half; ++j) {
                value +=
                    weight[j] * (keep[(i + j) % N_POINT][k] + keep[(i - j + N_POINT) % N_POINT][k]);
            }
            outline->point[i][k] = value;
        }
    }
}

/// Distance to the nearest point, negative outside. [crossing number]
static double depth(const clx_outline *outline, const double c[2])
{
    double least = INFINITY;
    bool is_inside = false;
    for (int i = 0, j = N_POINT - 1; i < N_POINT; j = i++) {
        const double *p = outline->point[i];
        const double *q = outline->point[j];
        const double d2 = (p[0] - c[0]) * (p[0] - c[0]) + (p[1] - c[1]) * (p[1] - c[1]);
        least = d2 < least ? d2 : least;
        if ((p[1] > c[1]) != (q[1] > c[1]) &&
            c[0] < p[0] + (q[0] - p[0]) * (c[1] - p[1]) / (q[1] - p[1])) {
            is_inside = !is_inside;
        }
    }
    return is_inside ? sqrt(least) : -sqrt(least);
}

/// The direction that leads away from all points nearer than `limit`, as far as there is one: the
/// middle of the arc that the directions away from them span. False when they span a half turn.
static bool direction_out(const clx_outline *outline, const double c[2], double limit,
                          double direction[2])
{
    double angle[N_POINT];
    int n = 0;
    for (int i = 0; i < N_POINT; ++i) {
        const double d[2] = {c[0] - outline->point[i][0], c[1] - outline->point[i][1]};
        if (dot2(d, d) <= limit * limit) {
            angle[n++] = atan2(d[1], d[0]);
        }
    }
    if (n == 0) {
        return false;
    }
    qsort(angle, (size_t)n, sizeof *angle, clx_by_value);
    double gap = 2.0 * CLAST_PI - (angle[n - 1] - angle[0]);
    int after = 0; // the arc begins here
    for (int i = 1; i < n; ++i) {
        if (angle[i] - angle[i - 1] > gap) {
            gap = angle[i] - angle[i - 1];
            after = i;
        }
    }
    const double middle = angle[after] + 0.5 * (2.0 * CLAST_PI - gap);
    direction[0] = cos(middle);
    direction[1] = sin(middle);
    return gap > CLAST_PI;
}

/// Goes where the nearest points let go, with shorter and shorter steps.
static double ascend(const clx_outline *outline, double c[2])
{
    double best = depth(outline, c);
    for (double step = 0.25 * best; step > 1e-7 * best;) {
        double direction[2];
        bool better = false;
        if (direction_out(outline, c, best + step, direction)) {
            const double next[2] = {c[0] + step * direction[0], c[1] + step * direction[1]};
            const double there = depth(outline, next);
            better = there > best;
            if (better) {
                c[0] = next[0];
                c[1] = next[1];
                best = there;
            }
        }
        step *= better ? 1.0 : 0.5;
    }
    return best;
}

void clx_outline_inscribed(const clx_outline *outline, double centre[2], double *radius)
{
    double far2 = 0.0;
    int far = 0;
    for (int i = 0; i < N_POINT; ++i) {
        const double d2 = dot2(outline->point[i], outline->point[i]);
        if (d2 > far2) {
            far2 = d2;
            far = i;
        }
    }
    *radius = 0.0;
    for (int start = -1; start <= 1; ++start) { // the middle and both ends of a long grain
        double c[2] = {0.4 * start * outline->point[far][0], 0.4 * start * outline->point[far][1]};
        if (depth(outline, c) > 0.0) {
            const double r = ascend(outline, c);
            if (r > *radius) {
                *radius = r;
                centre[0] = c[0];
                centre[1] = c[1];
            }
        }
    }
}
