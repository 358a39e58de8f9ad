// Shadows of assemblies by scan lines: on each line the covered length is exact (spheres and
// ellipsoids in closed form, surfaces by their triangles), between lines the midpoint rule. Its
// error is seen in half as many lines.
#include <clast/assembly.h>

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/parallel.h"
#include "base/status.h"
#include "math/vec3.h"
#include <clast/shape.h>
#include <stdlib.h>

/// Something that covers an interval of each line it meets: an ellipse or a triangle.
typedef struct shade {
    double low, high; ///< extent across the lines
    bool is_triangle;
    double x[3], y[3]; ///< corners; of an ellipse x[0], y[0] the centre and
    double slope;      ///< its axis: how x moves with y
    double half;       ///< half length on the line through the centre
} shade;

typedef struct span {
    double begin, end;
    int32_t line;
} span;

typedef struct shadow {
    double a[3], b[3], d[3]; ///< lines along a, stacked along b, seen along d
    double low, step;        ///< line k is at low + (k + 1/2) step
    int32_t n_line;
    int64_t n, capacity;
    shade *shade; ///< of the present grain
    int64_t n_own, own_capacity;
    span *own; ///< spans of the present grain
    int64_t n_span, span_capacity;
    span *span; ///< what each grain covers of each line, its own spans joined
} shadow;

static void shadow_free(shadow *s)
{
    CLX_FREE(s->shade, s->own, s->span);
    *s = (shadow){0};
}

static clast_status add_shade(shadow *s, const shade *item)
{
    const clast_status status = clx_grow(&s->shade, &s->capacity, s->n + 1, sizeof *s->shade);
    if (status == CLAST_OK) {
        s->shade[s->n++] = *item;
    }
    return status;
}

/// Shadow of centre + half y, |y| <= 1: the ellipse of matrix P = (a b)^T half half^T (a b).
static clast_status add_ellipse(shadow *s, const double centre[3], double half[3][3])
{
    double pa[3];
    double pb[3];
    m3_mul_t(pa, half, s->a);
    m3_mul_t(pb, half, s->b);
    const double aa = v3_norm2(pa);
    const double ab = v3_dot(pa, pb);
    const double bb = v3_norm2(pb);
    shade item = {.x = {v3_dot(centre, s->a)}, .y = {v3_dot(centre, s->b)}};
    item.slope = ab / bb;
    item.half = sqrt(fmax(0.0, aa - ab * ab / bb));
    item.low = item.y[0] - sqrt(bb);
    item.high = item.y[0] + sqrt(bb);
    return add_shade(s, &item);
}

static clast_status add_ball(shadow *s, const double centre[3], double radius)
{
    CLAST_ASSERT(radius >= 0.0);
    double half[3][3] = {{radius, 0.0, 0.0}, {0.0, radius, 0.0}, {0.0, 0.0, radius}};
    return add_ellipse(s, centre, half);
}

/// A closed surface's shadow is that of the triangles that face the viewer.
static clast_status add_triangle(shadow *s, double corner[3][3])
{
    shade item = {.is_triangle = true};
    for (int k = 0; k < 3; ++k) {
        item.x[k] = v3_dot(corner[k], s->a);
        item.y[k] = v3_dot(corner[k], s->b);
    }
    if ((item.x[1] - item.x[0]) * (item.y[2] - item.y[0]) <=
        (item.x[2] - item.x[0]) * (item.y[1] - item.y[0])) {
        return CLAST_OK;
    }
    item.low = fmin(item.y[0], fmin(item.y[1], item.y[2]));
    item.high = fmax(item.y[0], fmax(item.y[1], item.y[2]));
    return add_shade(s, &item);
}

static clast_status add_grain(const clast_assembly *assembly, int32_t i, shadow *s)
{
    clast_status status = CLAST_OK;
    const clast_shape *shape = &assembly->shape[assembly->shape_id[i]];
    const double scale = assembly->scale[i];
    const double *position = assembly->position[i];
    double rotation[3][3];
    q_matrix(rotation, assembly->orientation[i]);
    if (shape->kind == CLAST_SHAPE_SPHERE) {
        CLX_TRY(add_ball(s, position, scale * shape->semi_axes[0]));
    } else if (shape->kind == CLAST_SHAPE_ELLIPSOID) {
        double half[3][3];
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) {
                half[r][c] = rotation[r][c] * scale * shape->semi_axes[c];
            }
        }
        CLX_TRY(add_ellipse(s, position, half));
    } else if (shape->kind == CLAST_SHAPE_CLUMP) {
        for (int32_t k = 0; k < shape->spheres.n; ++k) {
            double at[3];
            m3_to_world(at, rotation, shape->spheres.centre[k]);
            v3_axpy(at, position, scale, at);
            CLX_TRY(add_ball(s, at, scale * shape->spheres.radius[k]));
        }
    } else {
        for (int32_t t = 0; t < shape->mesh.n_tri; ++t) {
            double corner[3][3];
            for (int k = 0; k < 3; ++k) {
                m3_to_world(corner[k], rotation, shape->mesh.vert[shape->mesh.tri[t][k]]);
                v3_axpy(corner[k], position, scale, corner[k]);
            }
            CLX_TRY(add_triangle(s, corner));
        }
    }
done:
    return status;
}

static bool cover(const shade *item, double y, span *out)
{
    if (!item->is_triangle) {
        const double t = (y - item->y[0]) / (item->high - item->y[0]);
        const double half = item->half * sqrt(fmax(0.0, 1.0 - t * t));
        const double middle = item->x[0] + item->slope * (y - item->y[0]);
        out->begin = middle - half;
        out->end = middle + half;
        return half > 0.0;
    }
    out->begin = INFINITY;
    out->end = -INFINITY;
    for (int k = 0; k < 3; ++k) {
        const int m = (k + 1) % 3;
        if ((item->y[k] <= y) != (item->y[m] <= y)) {
            const double x = item->x[k] + (item->x[m] - item->x[k]) * (y - item->y[k]) /
                                              (item->y[m] - item->y[k]);
            out->begin = fmin(out->begin, x);
            out->end = fmax(out->end, x);
        }
    }
    return out->end > out->begin;
}

static int by_line(const void *p, const void *q)
{
    const span *a = p;
    const span *b = q;
    if (a->line != b->line) {
        return a->line < b->line ? -1 : 1;
    }
    return (a->begin > b->begin) - (a->begin < b->begin);
}

/// Sorts spans and joins those that overlap, in place; returns their new number.
static int64_t join_spans(span *spans, int64_t n)
{
    CLAST_ASSERT(n >= 0);
    int64_t kept = 0;
    if (n > 1) {
        qsort(spans, (size_t)n, sizeof *spans, by_line);
    }
    for (int64_t i = 0; i < n; ++i) {
        span *last = kept > 0 ? &spans[kept - 1] : NULL;
        if (last != NULL && last->line == spans[i].line && spans[i].begin <= last->end) {
            last->end = fmax(last->end, spans[i].end);
        } else {
            spans[kept++] = spans[i];
        }
    }
    return kept;
}

/// Spans of one shade on all lines that it meets.
static clast_status scan_shade(shadow *s, const shade *item)
{
    clast_status status = CLAST_OK;
    const double first = fmax(0.0, ceil((item->low - s->low) / s->step - 0.5));
    for (int32_t line = first < s->n_line ? (int32_t)first : s->n_line; line < s->n_line; ++line) {
        const double y = s->low + (line + 0.5) * s->step;
        span found = {.line = line};
        if (y >= item->high) {
            break;
        }
        if (cover(item, y, &found)) {
            CLX_TRY(clx_grow(&s->own, &s->own_capacity, s->n_own + 1, sizeof *s->own));
            s->own[s->n_own++] = found;
        }
    }
done:
    return status;
}

/// Adds what one grain covers, its own spans joined first: most of them are its triangles'.
static clast_status scan_grain(const clast_assembly *assembly, int32_t i, shadow *s)
{
    clast_status status = CLAST_OK;
    s->n = 0;
    s->n_own = 0;
    CLX_TRY(add_grain(assembly, i, s));
    for (int64_t k = 0; k < s->n; ++k) {
        CLX_TRY(scan_shade(s, &s->shade[k]));
    }
    s->n_own = join_spans(s->own, s->n_own);
    CLX_TRY(clx_grow(&s->span, &s->span_capacity, s->n_span + s->n_own, sizeof *s->span));
    for (int64_t k = 0; k < s->n_own; ++k) {
        s->span[s->n_span++] = s->own[k];
    }
done:
    return status;
}

/// Extent of a shape along a direction of its own frame.
static void shape_extent(const clast_shape *shape, const double u[3], double *low, double *high)
{
    if (shape->kind == CLAST_SHAPE_SPHERE || shape->kind == CLAST_SHAPE_ELLIPSOID) {
        double w[3];
        for (int k = 0; k < 3; ++k) {
            w[k] = shape->semi_axes[k] * u[k];
        }
        *high = v3_norm(w);
        *low = -*high;
        return;
    }
    *low = INFINITY;
    *high = -INFINITY;
    for (int32_t v = 0; v < shape->mesh.n_vert && shape->kind == CLAST_SHAPE_MESH; ++v) {
        const double h = v3_dot(u, shape->mesh.vert[v]);
        *low = fmin(*low, h);
        *high = fmax(*high, h);
    }
    for (int32_t k = 0; k < shape->spheres.n && shape->kind == CLAST_SHAPE_CLUMP; ++k) {
        const double h = v3_dot(u, shape->spheres.centre[k]);
        *low = fmin(*low, h - shape->spheres.radius[k]);
        *high = fmax(*high, h + shape->spheres.radius[k]);
    }
}

/// Places the lines evenly over the shadow.
static void set_lines(const clast_assembly *assembly, shadow *s, int32_t n_line)
{
    double low = INFINITY;
    double high = -INFINITY;
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        const double at = v3_dot(assembly->position[i], s->b);
        double rotation[3][3];
        double u[3];
        double l;
        double h;
        q_matrix(rotation, assembly->orientation[i]);
        m3_to_local(u, rotation, s->b);
        shape_extent(&assembly->shape[assembly->shape_id[i]], u, &l, &h);
        low = fmin(low, at + assembly->scale[i] * l);
        high = fmax(high, at + assembly->scale[i] * h);
    }
    s->low = low;
    s->step = (high - low) / n_line;
    s->n_line = n_line;
}

/// Area by n_line lines, and how far those of even number and of odd number lie apart.
static clast_status project_lines(const clast_assembly *assembly, const double direction[3],
                                  int32_t n_line, double *area, double *apart)
{
    clast_status status = CLAST_OK;
    shadow s = {0};
    double half[2] = {0.0, 0.0};
    CLX_CHECK(v3_is_finite(direction), CLAST_E_USAGE,
              "projection: the direction %g, %g, %g is not finite", direction[0], direction[1],
              direction[2]);
    CLX_CHECK(v3_unit(s.d, direction), CLAST_E_USAGE, "projection: the direction is zero");
    v3_frame(s.d, s.a, s.b);
    set_lines(assembly, &s, n_line);
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        CLX_TRY(scan_grain(assembly, i, &s));
    }
    s.n_span = join_spans(s.span, s.n_span);
    for (int64_t k = 0; k < s.n_span; ++k) {
        half[s.span[k].line % 2] += s.span[k].end - s.span[k].begin;
    }
    *area = (half[0] + half[1]) * s.step;
    *apart = fabs(half[0] - half[1]) * s.step;
done:
    shadow_free(&s);
    return status;
}

clast_status clast_assembly_projected_area(const clast_assembly *assembly,
                                           const double direction[3], int32_t n_line, double *area,
                                           double *error)
{
    CLX_ARGUMENTS(assembly, direction, area, error);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    double fine = 0.0;
    double coarse = 0.0;
    double apart = 0.0;
    double unused = 0.0;
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to project");
    CLX_CHECK(n_line >= 2, CLAST_E_USAGE, "projection: %d scan lines, 2 at least", n_line);
    CLX_TRY(project_lines(assembly, direction, n_line, &fine, &apart));
    CLX_TRY(project_lines(assembly, direction, n_line / 2, &coarse, &unused));
    // Half as many lines stand elsewhere, unlike every other line of a shadow that is like its
    // mirror image: there even and odd lines have the same length, and their difference is 0.
    *area = fine;
    *error = fmax(fabs(fine - coarse), apart);
done:
    return status;
}

typedef struct many {
    const clast_assembly *assembly;
    int32_t n, n_line;
    double *area; ///< [n]
} many;

/// Directions on the half sphere: equal heights, golden turns.
static clast_status project_some(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_status status = CLAST_OK;
    const many *m = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const double z = ((double)i + 0.5) / m->n;
        const double angle = 2.0 * CLAST_PI * 0.61803398874989484820 * (double)i;
        const double r = sqrt(1.0 - z * z);
        const double direction[3] = {r * cos(angle), r * sin(angle), z};
        double apart = 0.0;
        CLX_TRY(project_lines(m->assembly, direction, m->n_line, &m->area[i], &apart));
    }
done:
    return status;
}

clast_status clast_assembly_mean_projection(const clast_assembly *assembly, int32_t n_direction,
                                            int32_t n_line, double *area, double *error)
{
    CLX_ARGUMENTS(assembly, area, error);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    many m = {.assembly = assembly, .n = n_direction, .n_line = n_line};
    double sum = 0.0;
    double squares = 0.0;
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to project");
    CLX_CHECK(n_direction >= 2 && n_line >= 2, CLAST_E_USAGE,
              "projection: %d directions and %d lines, 2 of each at least", n_direction, n_line);
    CLX_TRY(clx_alloc(&m.area, n_direction, sizeof *m.area));
    CLX_TRY(clx_parallel_try(n_direction, 1, project_some, &m));
    for (int32_t i = 0; i < n_direction; ++i) {
        sum += m.area[i];
        squares += m.area[i] * m.area[i];
    }
    const double mean = sum / n_direction;
    *area = mean;
    *error = sqrt(fmax(0.0, squares / n_direction - mean * mean) / (n_direction - 1));
done:
    clx_free(m.area);
    return status;
}
