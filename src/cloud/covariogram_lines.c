// Uniform lines through a body by their entries: a point uniform on the surface and a direction by
// the cosine law.
#include "cloud/covariogram_lines.h"

#include "base/alloc.h"
#include "cloud/surface.h"
#include "math/rng.h"
#include <math.h>

clx_sequence clx_sequence_at(int64_t number, int n)
{
    // roots of x^(n+1) = x + 1
    const double base = n == 3   ? 1.2207440846057596
                        : n == 4 ? 1.1673039782614187
                        : n == 5 ? 1.1347241384015194
                                 : 1.0969815577985598;
    clx_rng rng = clx_rng_at(0, CLX_STREAM_COVARIOGRAM, (uint64_t)number);
    clx_sequence q = {.n = n};
    CLAST_ASSERT(n >= 3 && n <= CLX_MOST_SEQUENCE && n != 6);
    double step = 1.0;
    for (int j = 0; j < n; ++j) {
        q.shift[j] = clx_rng_uniform(&rng);
        q.step[j] = step /= base;
    }
    return q;
}

void clx_sequence_point(const clx_sequence *q, int64_t k, double *u)
{
    for (int j = 0; j < q->n; ++j) {
        const double at = q->shift[j] + (double)k * q->step[j];
        u[j] = at - floor(at);
    }
}

/// Direction by the cosine law about a unit normal.
static void cosine_law(const double normal[3], double u, double v, double direction[3])
{
    const int least = fabs(normal[0]) < 0.6 ? 0 : 1;
    double e[2][3];
    double axis[3] = {least == 0, least == 1, 0.0};
    const double along = axis[0] * normal[0] + axis[1] * normal[1];
    double length = 0.0;
    for (int j = 0; j < 3; ++j) {
        e[0][j] = axis[j] - along * normal[j];
        length += e[0][j] * e[0][j];
    }
    for (int j = 0; j < 3; ++j) {
        e[0][j] /= sqrt(length);
    }
    for (int j = 0; j < 3; ++j) {
        e[1][j] = normal[(j + 1) % 3] * e[0][(j + 2) % 3] - normal[(j + 2) % 3] * e[0][(j + 1) % 3];
    }
    const double sine = sqrt(u);
    for (int j = 0; j < 3; ++j) {
        direction[j] =
            sine * (cos(2.0 * CLAST_PI * v) * e[0][j] + sin(2.0 * CLAST_PI * v) * e[1][j]) +
            sqrt(1.0 - u) * normal[j];
    }
}

static double triangle_area(const clast_mesh *m, int32_t t, double inward[3])
{
    const double *p = m->vert[m->tri[t][0]];
    const double *q = m->vert[m->tri[t][1]];
    const double *r = m->vert[m->tri[t][2]];
    double length = 0.0;
    for (int j = 0; j < 3; ++j) {
        const int k = (j + 1) % 3;
        const int l = (j + 2) % 3;
        inward[j] = -((q[k] - p[k]) * (r[l] - p[l]) - (q[l] - p[l]) * (r[k] - p[k]));
        length += inward[j] * inward[j];
    }
    length = sqrt(length);
    for (int j = 0; j < 3; ++j) {
        inward[j] /= length > 0.0 ? length : 1.0;
    }
    return 0.5 * length;
}

/// A uniform point of the mesh and the inward normal there.
static void on_mesh(const clx_lines *s, double u, double v, double x[3], double inward[3])
{
    const clast_mesh *m = &s->domain->surface->mesh;
    int32_t low = 0;
    int32_t high = m->n_tri - 1;
    const double wanted = u * s->area;
    while (low < high) {
        const int32_t middle = (low + high) / 2;
        if (s->area_to[middle] > wanted) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    const double before = low > 0 ? s->area_to[low - 1] : 0.0;
    const double share = fmin(1.0, fmax(0.0, (wanted - before) / (s->area_to[low] - before)));
    const double root = sqrt(share);
    for (int j = 0; j < 3; ++j) {
        x[j] = (1.0 - root) * m->vert[m->tri[low][0]][j] +
               root * (1.0 - v) * m->vert[m->tri[low][1]][j] +
               root * v * m->vert[m->tri[low][2]][j];
    }
    (void)triangle_area(m, low, inward);
}

/// The same of a half pipe: round wall, flat wall, two ends.
static void on_half_pipe(const clx_lines *s, double u, double v, double x[3], double inward[3])
{
    const clast_domain *d = s->domain;
    const double round_wall = CLAST_PI * d->radius * d->length;
    const double flat = 2.0 * d->radius * d->length;
    double at = u * s->area;
    for (int j = 0; j < 3; ++j) {
        inward[j] = 0.0;
    }
    if (at < round_wall) {
        const double angle = CLAST_PI * at / round_wall;
        x[0] = d->radius * cos(angle);
        x[1] = d->radius * sin(angle);
        x[2] = v * d->length;
        inward[0] = -cos(angle);
        inward[1] = -sin(angle);
        return;
    }
    at -= round_wall;
    if (at < flat) {
        x[0] = d->radius * (2.0 * at / flat - 1.0);
        x[1] = 0.0;
        x[2] = v * d->length;
        inward[1] = 1.0;
        return;
    }
    const double share = fmin(1.0, (at - flat) / (CLAST_PI * d->radius * d->radius));
    const bool is_top = share >= 0.5;
    const double rho = d->radius * sqrt(is_top ? 2.0 * share - 1.0 : 2.0 * share);
    x[0] = rho * cos(CLAST_PI * v);
    x[1] = rho * sin(CLAST_PI * v);
    x[2] = is_top ? d->length : 0.0;
    inward[2] = is_top ? -1.0 : 1.0;
}

/// Where a line that enters a half pipe leaves it.
static double half_pipe_chord(const clast_domain *d, const double x[3], const double u[3])
{
    const double a = u[0] * u[0] + u[1] * u[1];
    const double b = x[0] * u[0] + x[1] * u[1];
    const double c = fmax(0.0, d->radius * d->radius - x[0] * x[0] - x[1] * x[1]);
    double chord = a > 0.0 ? (sqrt(b * b + a * c) - b) / a : (double)INFINITY;
    if (u[1] < 0.0) {
        chord = fmin(chord, x[1] / -u[1]);
    }
    if (u[2] != 0.0) {
        chord = fmin(chord, (u[2] > 0.0 ? d->length - x[2] : x[2]) / fabs(u[2]));
    }
    return fmax(chord, 0.0);
}

/// Crossings of a line behind its entry, out, in, out ..: as far as pairs within `distance` need.
static int crossings(const clx_lines *s, const double x[3], const double u[3], double distance,
                     double *t)
{
    const clast_domain *d = s->domain;
    if (d->kind == CLAST_DOMAIN_HALF_PIPE) {
        t[0] = half_pipe_chord(d, x, u);
        return 1;
    }
    const clast_mesh *m = &d->surface->mesh;
    const double size =
        fmax(d->high[0] - d->low[0], fmax(d->high[1] - d->low[1], d->high[2] - d->low[2]));
    double from = 1e-9 * size;
    int n = 0;
    clast_hit hit;
    while (n < CLX_MOST_CROSSING && clast_bvh_ray(d->surface->bvh, x, u, from,
                                                  n == 0 ? 4.0 * size : t[0] + distance, &hit)) {
        double inward[3];
        (void)triangle_area(m, hit.tri, inward);
        const bool enters = u[0] * inward[0] + u[1] * inward[1] + u[2] * inward[2] > 0.0;
        if (enters == (n % 2 == 1)) { // a graze of the wrong side is none
            t[n++] = hit.t;
        }
        from = hit.t + 1e-9 * size;
    }
    return n;
}

void clx_line_at(const clx_lines *lines, const double u[4], double distance, clx_line *line)
{
    double inward[3];
    if (lines->domain->kind == CLAST_DOMAIN_MESH) {
        on_mesh(lines, u[0], u[1], line->x, inward);
    } else {
        on_half_pipe(lines, u[0], u[1], line->x, inward);
    }
    cosine_law(inward, u[2], u[3], line->direction);
    line->n = crossings(lines, line->x, line->direction, distance, line->t);
}

clast_status clx_lines_init(const clast_domain *d, clx_lines *lines)
{
    clast_status status = CLAST_OK;
    clx_lines made = {.domain = d};
    if (d->kind == CLAST_DOMAIN_HALF_PIPE) {
        made.area = (CLAST_PI + 2.0) * d->radius * d->length + CLAST_PI * d->radius * d->radius;
    }
    if (d->kind == CLAST_DOMAIN_MESH) {
        const clast_mesh *m = &d->surface->mesh;
        double inward[3];
        CLX_TRY(clx_alloc(&made.area_to, m->n_tri, sizeof *made.area_to));
        for (int32_t t = 0; t < m->n_tri; ++t) {
            made.area += triangle_area(m, t, inward);
            made.area_to[t] = made.area;
        }
    }
    *lines = made;
done:
    return status;
}

void clx_lines_free(clx_lines *lines)
{
    clx_free(lines->area_to);
    *lines = (clx_lines){0};
}
