// Planes and vertical cylinders: the deepest point is a support point, or a largest radius.
#include "convex/convex.h"
#include "convex/ellipsoid_pair.h"
#include "convex/hull_core.h"
#include "math/least.h"
#include "math/vec3.h"

static void scaled_to_world(const double t[9], double scale, const double x[3], double out[3])
{
    v3_set(out, scale * (t[0] * x[0] + t[1] * x[1] + t[2] * x[2]),
           scale * (t[3] * x[0] + t[4] * x[1] + t[5] * x[2]),
           scale * (t[6] * x[0] + t[7] * x[1] + t[8] * x[2]));
}

/// Whether the vertex kept is still the farthest along d (body axes): d has turned by less than the
/// least angle between the plane through the vertex and an edge at it.
static inline bool is_kept(const clx_warm_start *warm_start, const double d[3])
{
    double gone[3];
    for (int i = 0; i < 3; ++i) {
        gone[i] = d[i] - (double)warm_start->seen[0][i];
    }
    return v3_norm2(gone) < (double)warm_start->limit[0] * (double)warm_start->limit[0];
}

/// Keeps vertex v, the farthest along d.
static void keep_support(const clx_hull_core *core, int32_t v, const double d[3],
                         clx_warm_start *warm_start)
{
    CLAST_ASSERT(v >= 0 && v < core->n_vert);
    double arc = 1.0;
    for (int32_t i = core->near_first[v]; i < core->near_first[v + 1]; ++i) {
        const clx_core_near *near = &core->near[i];
        arc = lesser_of(arc, -v3_dot(near->along, d) * near->inverse);
    }
    warm_start->feature[0] = v;
    warm_start->limit[0] = (float)greater_of(arc - CLX_FLOAT_SLACK, 0.0);
    v3_copy(warm_start->data, core->vert[v]);
    for (int i = 0; i < 3; ++i) {
        warm_start->seen[0][i] = (float)d[i];
    }
}

/// The hull's vertex farthest along d (body axes).
static const double *farthest(const clx_hull_core *core, const double d[3],
                              clx_warm_start *warm_start)
{
    if (warm_start == NULL) {
        return core->vert[clx_core_climb(core, d, clx_core_start(core, d))];
    }
    if (!is_kept(warm_start, d)) {
        const int32_t last = warm_start->feature[0];
        const int32_t from = last >= 0 && last < core->n_vert ? last : clx_core_start(core, d);
        keep_support(core, clx_core_climb(core, d, from), d, warm_start);
    }
    return warm_start->data;
}

/// Deepest point of the shape without rounding against direction n, relative to the position.
static void deepest(const clx_placed *body, const double n[3], clx_warm_start *warm_start,
                    double tip[3])
{
    const clx_convex *shape = body->shape;
    if (shape->kind == CLX_CONVEX_HULL) {
        double own[3];
        const double d[3] = {-n[0], -n[1], -n[2]};
        rot_to_local(own, body->rotation, d);
        scaled_to_world(body->rotation, shape->scale, farthest(shape->core, own, warm_start), tip);
    } else {
        double matrix[6];
        clx_ellipsoid_matrix(body->rotation, shape->semi_axes, matrix);
        clx_ellipsoid_tip(matrix, n, tip);
        v3_scale(tip, -1.0, tip);
    }
}

void clx_plane_contact(const clx_placed *body, const double plane[4], clx_warm_start *warm_start,
                       clx_contact *contact)
{
    CLAST_ASSERT(v3_is_unit(plane, 1e-9));
    double tip[3];
    deepest(body, plane, warm_start, tip);
    contact->gap =
        v3_dot(plane, body->position) - plane[3] + v3_dot(plane, tip) - body->shape->round;
    v3_copy(contact->normal, plane);
    v3_axpy(contact->point, tip, -body->shape->round - 0.5 * contact->gap, plane);
}

/// Greatest u.c + h(u) over directions u of the plane, h the support of an ellipse with matrix
/// (xx, yy, xy): the farthest point of the ellipse about c from the origin. Climbs from angle t.
static double farthest_from(const double m[3], const double c[2], double *t)
{
    double best = -INFINITY;
    double angle = *t;
    for (int step = 0; step < 60; ++step) {
        const double u[2] = {cos(angle), sin(angle)};
        const double v[2] = {-u[1], u[0]};
        const double mu[2] = {m[0] * u[0] + m[2] * u[1], m[2] * u[0] + m[1] * u[1]};
        const double mv[2] = {m[0] * v[0] + m[2] * v[1], m[2] * v[0] + m[1] * v[1]};
        const double h = sqrt(fmax(u[0] * mu[0] + u[1] * mu[1], 0.0));
        const double f = u[0] * c[0] + u[1] * c[1] + h;
        const double inverse = h > 0.0 ? 1.0 / h : 0.0;
        const double hv = (v[0] * mu[0] + v[1] * mu[1]) * inverse; // h'
        const double first = v[0] * c[0] + v[1] * c[1] + hv;
        const double second =
            -f + h + ((v[0] * mv[0] + v[1] * mv[1]) - hv * hv) * inverse - h; // f'' = -u.c + h''
        if (f > best - 1e-15 * fabs(f)) { // of equals the later one: its angle has more digits
            best = f;
            *t = angle;
        }
        const double newton = second < 0.0 ? -first / second : copysign(0.3, first);
        const double move = fmin(fmax(newton, -0.3), 0.3);
        if (fabs(first) <= 1e-15 * fabs(f)) {
            break;
        }
        angle += move;
    }
    return best;
}

/// True if the distance from the origin has one maximum on the ellipse about c, because the origin
/// lies beyond its evolute, which reaches (a a - b b) / b from the centre.
static bool has_one_farthest(const double m[3], const double c[2])
{
    const double apart = m[0] - m[1];
    const double square = apart * apart + 4.0 * m[2] * m[2]; // (a a - b b)^2
    const double least = 0.5 * (m[0] + m[1] - sqrt(square)); // b b
    return least > 0.0 && (c[0] * c[0] + c[1] * c[1]) * least > square;
}

/// Newton from outward for the one maximum; false if it is not found within a few steps.
static bool climb_outward(const double m[3], const double c[2], double u[2])
{
    const double r = sqrt(c[0] * c[0] + c[1] * c[1]);
    u[0] = c[0] / r;
    u[1] = c[1] / r;
    for (int step = 0; step < 12; ++step) {
        const double v[2] = {-u[1], u[0]};
        const double mu[2] = {m[0] * u[0] + m[2] * u[1], m[2] * u[0] + m[1] * u[1]};
        const double mv[2] = {m[0] * v[0] + m[2] * v[1], m[2] * v[0] + m[1] * v[1]};
        const double h = sqrt(u[0] * mu[0] + u[1] * mu[1]);
        const double hv = (v[0] * mu[0] + v[1] * mu[1]) / h;
        const double first = v[0] * c[0] + v[1] * c[1] + hv;
        const double second =
            ((v[0] * mv[0] + v[1] * mv[1]) - hv * hv) / h - h - (u[0] * c[0] + u[1] * c[1]);
        if (!(second < 0.0)) {
            return false;
        }
        const double move = fmin(fmax(-first / second, -0.5), 0.5);
        const double x = u[0] + move * v[0];
        const double y = u[1] + move * v[1];
        const double inverse = 1.0 / sqrt(x * x + y * y);
        u[0] = x * inverse;
        u[1] = y * inverse;
        if (fabs(move) <= 1e-9) { // Newton doubles digits: the next step would be below rounding
            return true;
        }
    }
    return false;
}

/// Deepest point of a round shape in a cylinder, relative to the position; its distance from the
/// axis.
static double round_extent(const clx_placed *body, const double c[2], double u[2], double tip[3])
{
    double matrix[6];
    clx_ellipsoid_matrix(body->rotation, body->shape->semi_axes, matrix);
    const double flat[3] = {matrix[0], matrix[1], matrix[5]};
    if (!has_one_farthest(flat, c) || !climb_outward(flat, c, u)) {
        const double outward = atan2(c[1], c[0]);
        double best = -INFINITY;
        double at = 0.0;
        for (int k = 0; k < 8; ++k) {
            double t = outward + k * CLAST_PI / 4.0;
            const double f = farthest_from(flat, c, &t);
            if (f > best) {
                best = f;
                at = t;
            }
        }
        u[0] = cos(at);
        u[1] = sin(at);
    }
    clx_ellipsoid_tip(matrix, (const double[3]){u[0], u[1], 0.0}, tip);
    return u[0] * (c[0] + tip[0]) + u[1] * (c[1] + tip[1]);
}

static double hull_extent(const clx_placed *body, const double c[2], double u[2], double tip[3])
{
    const clx_hull_core *core = body->shape->core;
    const double *t = body->rotation;
    const double s = body->shape->scale;
    double best = -INFINITY;
    int32_t at = 0;
    for (int32_t i = 0; i < core->n_vert; ++i) {
        const double *v = core->vert[i];
        const double x = c[0] + s * (t[0] * v[0] + t[1] * v[1] + t[2] * v[2]);
        const double y = c[1] + s * (t[3] * v[0] + t[4] * v[1] + t[5] * v[2]);
        if (x * x + y * y > best) {
            best = x * x + y * y;
            at = i;
        }
    }
    scaled_to_world(t, s, core->vert[at], tip);
    best = sqrt(best);
    u[0] = best > 0.0 ? (c[0] + tip[0]) / best : 1.0;
    u[1] = best > 0.0 ? (c[1] + tip[1]) / best : 0.0;
    return best;
}

void clx_cylinder_contact(const clx_placed *body, const double axis[2], double radius,
                          clx_contact *contact)
{
    CLAST_ASSERT(radius >= 0.0);
    const double c[2] = {body->position[0] - axis[0], body->position[1] - axis[1]};
    double u[2], tip[3];
    const double extent = body->shape->kind == CLX_CONVEX_HULL ? hull_extent(body, c, u, tip)
                                                               : round_extent(body, c, u, tip);
    contact->gap = radius - extent - body->shape->round;
    v3_set(contact->normal, -u[0], -u[1], 0.0);
    v3_axpy(contact->point, tip, -body->shape->round - 0.5 * contact->gap, contact->normal);
}
