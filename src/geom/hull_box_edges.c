// The least box of a convex hull with few faces, whose sides may lie on edges alone.
//
// Two neighbouring sides of a box of least volume each hold an edge of the hull [ORourke1985]. For
// a pair of edges such boxes form one family: the first side turns about its edge from one face to
// the other, the second is at right angles to it and along its own edge. Here every pair is
// sampled along that turn and its best sample refined, n^2 pairs at n each: for few faces only. An
// octahedron's least box, a cube of 8/27 of the diameter cubed, is found so, and not from its faces
// (9/27).
#include "geom/hull_body.h"

#include "base/status.h"
#include "math/vec3.h"

enum { N_SAMPLE = 24, N_REFINE = 80 };

/// Boxes whose first side turns about one edge, while the second holds another.
typedef struct {
    const clx_hull_body *body;
    double from[3],
        towards[3];  ///< unit normals at both ends of a quarter turn about the first edge
    double arc;      ///< angle between the edge's faces
    double along[3]; ///< the second edge
} family;

/// The box at this angle; its volume is INFINITY where the first side is at right angles to the
/// second edge.
static double box_at(const family *f, double angle, clx_box *box)
{
    double across[3];
    double volume = 1.0;
    for (int c = 0; c < 3; ++c) {
        box->axis[0][c] = cos(angle) * f->from[c] + sin(angle) * f->towards[c];
    }
    v3_cross(across, f->along, box->axis[0]);
    if (v3_dot(across, across) < 1e-12 || !v3_unit(box->axis[1], across)) {
        return INFINITY;
    }
    v3_cross(box->axis[2], box->axis[0], box->axis[1]);
    for (int k = 0; k < 3; ++k) {
        box->edge[k] = clx_hull_body_width(f->body, box->axis[k]);
        volume *= box->edge[k];
    }
    return volume;
}

/// The least box between two angles that enclose one minimum (golden section).
static double refine(const family *f, double low, double high, clx_box *box)
{
    CLAST_ASSERT(low <= high);
    const double ratio = 0.5 * (sqrt(5.0) - 1.0);
    double at[2] = {high - ratio * (high - low), low + ratio * (high - low)};
    double volume[2] = {box_at(f, at[0], box), box_at(f, at[1], box)};
    for (int i = 0; i < N_REFINE; ++i) {
        if (volume[0] <= volume[1]) {
            high = at[1];
            at[1] = at[0];
            volume[1] = volume[0];
            at[0] = high - ratio * (high - low);
            volume[0] = box_at(f, at[0], box);
        } else {
            low = at[0];
            at[0] = at[1];
            volume[0] = volume[1];
            at[1] = low + ratio * (high - low);
            volume[1] = box_at(f, at[1], box);
        }
    }
    return box_at(f, 0.5 * (low + high), box);
}

/// The least box of a family, if it is clearly less than `limit`: among equal ones rounding does
/// not decide.
static void try_family(const family *f, double *limit, clx_box *best)
{
    clx_box box;
    double least = INFINITY;
    int at = 0;
    for (int i = 0; i <= N_SAMPLE; ++i) {
        const double volume = box_at(f, f->arc * i / N_SAMPLE, &box);
        at = volume < least ? i : at;
        least = volume < least ? volume : least;
    }
    if (least > 1.2 * *limit) {
        return;
    }
    const double low = f->arc * (at > 0 ? at - 1 : at) / N_SAMPLE;
    const double high = f->arc * (at < N_SAMPLE ? at + 1 : at) / N_SAMPLE;
    const double volume = refine(f, low, high, &box);
    if (volume < (1.0 - 1e-9) * *limit) {
        *limit = volume;
        *best = box;
    }
}

/// The turn about an edge from one of its faces to the other; false where they lie in one plane.
static bool rotate_about(const clx_hull_body *body, const clx_hull_body_edge *edge, family *f)
{
    const double *a = body->normal[edge->face[0]];
    const double *b = body->normal[edge->face[1]];
    const double cosine = v3_dot(a, b);
    double rest[3];
    for (int c = 0; c < 3; ++c) {
        f->from[c] = a[c];
        rest[c] = b[c] - cosine * a[c];
    }
    f->arc = atan2(sqrt(v3_dot(rest, rest)), cosine);
    return v3_dot(a, a) > 0.0 && f->arc > 1e-9 && v3_unit(f->towards, rest);
}

void clx_hull_body_box_on_edges(const clx_hull_body *body, clx_box *best)
{
    double limit = best->edge[0] * best->edge[1] * best->edge[2];
    for (int32_t i = 0; i < body->n_edge; ++i) {
        family f = {.body = body};
        if (!rotate_about(body, &body->edge[i], &f)) {
            continue;
        }
        for (int32_t j = 0; j < body->n_edge; ++j) {
            double along[3];
            const clx_hull_body_edge *other = &body->edge[j];
            v3_sub(along, body->vert[other->vert[1]], body->vert[other->vert[0]]);
            if (j != i && v3_unit(f.along, along)) {
                try_family(&f, &limit, best);
            }
        }
    }
}
