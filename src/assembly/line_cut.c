// Convex parts on lines along x: what several of them have in common.
#include "assembly/line_cut.h"

#include "base/alloc.h"
#include "base/status.h"
#include "math/vec3.h"

enum { LINES = 1 << 18 }; // across what parts share

/// Steps of an even lattice in the plane: 1 / g and 1 / g^2 with g^3 = g + 1 [Roberts2018].
static const double STEP[2] = {0.7548776662466927, 0.5698402909980532};

static const double FAR = 1e300;

clast_mesh clx_part_mesh(const clast_mesh *mesh, const clast_part *part)
{
    return (clast_mesh){.n_vert = part->vert[1],
                        .n_tri = part->tri[1] - part->tri[0],
                        .vert = mesh->vert,
                        .tri = &mesh->tri[part->tri[0]]};
}

/// Climbs to the farthest point about one direction: the support along where it is.
static double climb(double matrix[3][3], const double x[3], const double from[3])
{
    double y[3];
    double u[3];
    double bounding_radius = 0.0;
    v3_copy(y, from);
    for (int i = 0; i < 200 && v3_unit(u, y); ++i) {
        double m[3];
        m3_mul(m, matrix, u);
        v3_axpy(y, x, 1.0 / sqrt(v3_dot(u, m)), m);
        const double now = v3_norm(y);
        if (!(now > bounding_radius * (1.0 + 1e-15))) {
            break;
        }
        bounding_radius = now;
    }
    return bounding_radius;
}

double clx_part_bounding_radius(const clast_part *part)
{
    double rotation[3][3];
    double matrix[3][3];
    double bounding_radius = 0.0;
    q_matrix(rotation, part->orientation);
    for (int p = 0; p < 3; ++p) {
        for (int q = 0; q < 3; ++q) {
            matrix[p][q] = 0.0;
            for (int k = 0; k < 3; ++k) {
                const double a = part->semi_axes[k];
                matrix[p][q] += a * a * rotation[p][k] * rotation[q][k];
            }
        }
    }
    for (int k = 0; k < 6; ++k) {
        double from[3];
        const double sign = k % 2 == 0 ? 1.0 : -1.0;
        for (int p = 0; p < 3; ++p) {
            from[p] = part->position[p] + sign * part->semi_axes[k / 2] * rotation[p][k / 2];
        }
        bounding_radius = fmax(bounding_radius, climb(matrix, part->position, from));
    }
    return bounding_radius * (1.0 + 1e-12);
}

/// A part as lines meet it: planes n.x <= n[3], or (x - c).Q(x - c) <= 1.
typedef struct {
    double low[3], high[3];
    int32_t n_plane;
    double (*plane)[4];
    double centre[3];
    double q[3][3];
    bool is_shared; ///< its box meets another's
} body;

static void bound_mesh(const clast_mesh *mesh, const clast_part *part, body *b)
{
    v3_set(b->low, FAR, FAR, FAR);
    v3_set(b->high, -FAR, -FAR, -FAR);
    for (int32_t v = part->vert[0]; v < part->vert[1]; ++v) {
        for (int k = 0; k < 3; ++k) {
            b->low[k] = fmin(b->low[k], mesh->vert[v][k]);
            b->high[k] = fmax(b->high[k], mesh->vert[v][k]);
        }
    }
}

static void set_planes(const clast_mesh *mesh, const clast_part *part, double (*plane)[4], body *b)
{
    b->plane = plane;
    for (int32_t t = part->tri[0]; t < part->tri[1]; ++t) {
        const double *p = mesh->vert[mesh->tri[t][0]];
        double u[3];
        double v[3];
        double *n = plane[b->n_plane];
        v3_sub(u, mesh->vert[mesh->tri[t][1]], p);
        v3_sub(v, mesh->vert[mesh->tri[t][2]], p);
        v3_cross(n, u, v);
        if (v3_unit(n, n)) {
            n[3] = v3_dot(n, p);
            ++b->n_plane;
        }
    }
}

static void set_ellipsoid(const clast_part *part, body *b)
{
    double rotation[3][3];
    q_matrix(rotation, part->orientation);
    v3_copy(b->centre, part->position);
    for (int p = 0; p < 3; ++p) {
        double half = 0.0;
        for (int k = 0; k < 3; ++k) {
            half += rotation[p][k] * part->semi_axes[k] * (rotation[p][k] * part->semi_axes[k]);
            b->q[p][k] = 0.0;
            for (int i = 0; i < 3; ++i) {
                const double a = part->semi_axes[i];
                b->q[p][k] += rotation[p][i] * rotation[k][i] / (a * a);
            }
        }
        b->low[p] = part->position[p] - sqrt(half);
        b->high[p] = part->position[p] + sqrt(half);
    }
}

/// Where a body is on the line through y and z; false if it is not.
static bool cut(const body *b, double y, double z, double x[2])
{
    if (y < b->low[1] || y > b->high[1] || z < b->low[2] || z > b->high[2]) {
        return false;
    }
    if (b->plane == NULL) {
        const double u = y - b->centre[1];
        const double v = z - b->centre[2];
        const double half = (b->q[0][1] * u + b->q[0][2] * v) / b->q[0][0];
        const double rest =
            (b->q[1][1] * u * u + 2.0 * b->q[1][2] * u * v + b->q[2][2] * v * v - 1.0) / b->q[0][0];
        const double root = half * half - rest;
        x[0] = b->centre[0] - half - sqrt(fmax(0.0, root));
        x[1] = b->centre[0] - half + sqrt(fmax(0.0, root));
        return root > 0.0;
    }
    x[0] = b->low[0];
    x[1] = b->high[0];
    for (int32_t i = 0; i < b->n_plane; ++i) {
        const double *n = b->plane[i];
        const double rest = n[3] - n[1] * y - n[2] * z;
        if (n[0] > 0.0) {
            x[1] = fmin(x[1], rest / n[0]);
        } else if (n[0] < 0.0) {
            x[0] = fmax(x[0], rest / n[0]);
        } else if (rest < 0.0) {
            return false;
        }
    }
    return x[1] > x[0];
}

/// Adds an interval's length and first two moments.
static void add_interval(double m[3], double sign, const double x[2])
{
    const double a = x[0];
    const double b = x[1];
    m[0] += sign * (b - a);
    m[1] += sign * 0.5 * (b - a) * (b + a);
    m[2] += sign * (b - a) * (b * b + a * b + a * a) / 3.0;
}

/// Intervals less their union.
static void common(int32_t n, double (*x)[2], double m[3])
{
    CLAST_ASSERT(n >= 0);
    m[0] = m[1] = m[2] = 0.0;
    for (int32_t i = 1; i < n; ++i) { // by where they begin
        for (int32_t k = i; k > 0 && x[k][0] < x[k - 1][0]; --k) {
            const double swap[2] = {x[k][0], x[k][1]};
            x[k][0] = x[k - 1][0];
            x[k][1] = x[k - 1][1];
            x[k - 1][0] = swap[0];
            x[k - 1][1] = swap[1];
        }
    }
    double whole[2] = {0.0, 0.0};
    for (int32_t i = 0; i < n; ++i) {
        add_interval(m, 1.0, x[i]);
        if (i == 0 || x[i][0] > whole[1]) {
            add_interval(m, -1.0, whole);
            whole[0] = x[i][0];
            whole[1] = x[i][1];
        }
        whole[1] = fmax(whole[1], x[i][1]);
    }
    add_interval(m, -1.0, whole);
}

/// Mass of what each interval shares with those of earlier parts; `room` holds n intervals.
static void surplus_of(int32_t n, double (*x)[2], const double *density, double (*shared_span)[2],
                       double m[3])
{
    m[0] = m[1] = m[2] = 0.0;
    for (int32_t i = 1; i < n; ++i) {
        double shared[3];
        double twice[3];
        int32_t k = 0;
        for (int32_t j = 0; j < i; ++j) {
            shared_span[k][0] = fmax(x[i][0], x[j][0]);
            shared_span[k][1] = fmin(x[i][1], x[j][1]);
            k += shared_span[k][1] > shared_span[k][0] ? 1 : 0;
        }
        v3_set(shared, 0.0, 0.0, 0.0);
        for (int32_t j = 0; j < k; ++j) {
            add_interval(shared, 1.0, shared_span[j]);
        }
        common(k, shared_span, twice);
        v3_sub(shared, shared, twice);
        v3_axpy(m, m, density[i], shared);
    }
}

/// The box in y and z of what boxes share; marks those that share any. False: nothing.
static bool shared_box(int32_t n, body *b, double low[3], double high[3])
{
    CLAST_ASSERT(n >= 0);
    bool is_any = false;
    v3_set(low, FAR, FAR, FAR);
    v3_set(high, -FAR, -FAR, -FAR);
    for (int32_t i = 0; i < n; ++i) {
        for (int32_t j = 0; j < i; ++j) {
            bool meet = true;
            for (int k = 0; k < 3; ++k) {
                meet = meet && b[i].low[k] < b[j].high[k] && b[j].low[k] < b[i].high[k];
            }
            for (int k = 0; k < 3 && meet; ++k) {
                low[k] = fmin(low[k], fmax(b[i].low[k], b[j].low[k]));
                high[k] = fmax(high[k], fmin(b[i].high[k], b[j].high[k]));
            }
            b[i].is_shared = b[i].is_shared || meet;
            b[j].is_shared = b[j].is_shared || meet;
            is_any = is_any || meet;
        }
    }
    return is_any;
}

static void make_bodies(const clast_parts *parts, const clast_mesh *mesh, body *b,
                        double (*plane)[4])
{
    int64_t first = 0;
    for (int32_t i = 0; i < parts->n; ++i) {
        const clast_part *part = &parts->part[i];
        if (part->kind == CLAST_SHAPE_MESH) {
            bound_mesh(mesh, part, &b[i]);
            set_planes(mesh, part, plane + first, &b[i]);
            first += b[i].n_plane;
        } else {
            set_ellipsoid(part, &b[i]);
        }
    }
}

/// Adds one line's moments, m times its share of the section.
static void add_line(double moments[10], const double m[3], double y, double z, double area)
{
    moments[0] += area * m[0];
    moments[1] += area * m[1];
    moments[2] += area * m[0] * y;
    moments[3] += area * m[0] * z;
    moments[4] += area * m[2];
    moments[5] += area * m[0] * y * y;
    moments[6] += area * m[0] * z * z;
    moments[7] += area * m[1] * y;
    moments[8] += area * m[1] * z;
    moments[9] += area * m[0] * y * z;
}

/// What a line meets, in the order of parts.
typedef struct {
    double (*x)[2];           ///< [n_part] intervals
    double (*shared_span)[2]; ///< [n_part]
    double *density;          ///< [n_part] of these intervals
} met;

static void met_free(met *line)
{
    CLX_FREE(line->x, line->shared_span, line->density);
}

static clast_status met_alloc(int32_t n, met *line)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&line->x, n, sizeof *line->x));
    CLX_TRY(clx_alloc(&line->shared_span, n, sizeof *line->shared_span));
    CLX_TRY(clx_alloc(&line->density, n, sizeof *line->density));
done:
    return status;
}

/// Bodies on the line through y and z; how many.
static int32_t meet(int32_t n_body, const body *b, const double *density, const double at[2],
                    met *line)
{
    CLAST_ASSERT(n_body >= 0);
    int32_t n = 0;
    for (int32_t i = 0; i < n_body; ++i) {
        if (b[i].is_shared && cut(&b[i], at[0], at[1], line->x[n])) {
            line->density[n++] = density != NULL ? density[i] : 1.0;
        }
    }
    return n;
}

clast_status clx_common_moments(const clast_parts *parts, const clast_mesh *mesh,
                                const double *density, double moments[10], double surplus[10])
{
    clast_status status = CLAST_OK;
    body *b = NULL;
    double(*plane)[4] = NULL;
    met on = {0};
    double low[3];
    double high[3];
    for (int k = 0; k < 10; ++k) {
        moments[k] = 0.0;
        if (density != NULL) {
            surplus[k] = 0.0;
        }
    }
    CLX_TRY(clx_alloc(&b, parts->n, sizeof *b));
    CLX_TRY(clx_alloc(&plane, mesh->n_tri, sizeof *plane));
    CLX_TRY(met_alloc(parts->n, &on));
    make_bodies(parts, mesh, b, plane);
    if (!shared_box(parts->n, b, low, high)) {
        goto done;
    }
    const double wide[2] = {high[1] - low[1], high[2] - low[2]};
    const double area = wide[0] * wide[1] / LINES;
    for (int32_t line = 0; line < LINES; ++line) {
        const double u = (line + 0.5) * STEP[0];
        const double v = (line + 0.5) * STEP[1];
        const double at[2] = {low[1] + (u - floor(u)) * wide[0], low[2] + (v - floor(v)) * wide[1]};
        double m[3];
        const int32_t n = meet(parts->n, b, density, at, &on);
        if (n > 1 && density != NULL) { // before the intervals are sorted
            surplus_of(n, on.x, on.density, on.shared_span, m);
            add_line(surplus, m, at[0], at[1], area);
        }
        if (n > 1) {
            common(n, on.x, m);
            add_line(moments, m, at[0], at[1], area);
        }
    }
done:
    CLX_FREE(b, plane);
    met_free(&on);
    return status;
}
