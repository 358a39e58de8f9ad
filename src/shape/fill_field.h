#pragma once
// Distances to the surface and its inside, for clast_fill.
#include "math/vec3.h"
#include "shape/fill_balls.h"
#include <clast/mesh.h>

/// Children of a node, triangles of a leaf.
enum { CLX_FILL_LANES = 8, CLX_FILL_DEPTH = 48 };

/// Eight children side by side, boxes as middle and half size, in floats of the field's frame.
typedef struct clx_fill_node {
    clx_float8 middle[3], half[3]; ///< an empty slot has middle = INFINITY
    int32_t child[CLX_FILL_LANES]; ///< node number; or -1 - leaf number
} clx_fill_node;

/// Up to eight triangles side by side: corner and edges; an empty slot is a point far away.
typedef struct clx_fill_leaf {
    clx_float8 a[3], ab[3], ac[3];
    int32_t first; ///< triangle
    int32_t count;
} clx_fill_leaf;

typedef struct clx_fill_field {
    const clast_mesh *mesh;  ///< borrowed: closed
    double middle[3], scale; ///< float frame: (x - middle) * scale, within [-1/2, 1/2]
    double error;            ///< a distance may be too large by this much
    clx_fill_node *node;     ///< [n_node] root first
    clx_fill_leaf *leaf;     ///< [n_leaf]
    int32_t *item; ///< [n] triangle of the mesh, in leaf order; without those that are an edge
    double (*tri)[3][3]; ///< [n] in leaf order: corner 0, edges to corners 1 and 2
    double *size;        ///< [n] radius of a sphere that holds the triangle
    int64_t n_node, n_leaf;
    int64_t node_capacity, leaf_capacity;
} clx_fill_field;

/// A float coordinate of the frame is off by at most 2^-24 of its size; three of them, and the
/// rounding of the distance itself, stay below this share of the frame's unit and of the distance.
static const double CLX_FILL_FRAME_ERROR = 1e-6;

/// Builds the tree of a closed surface.
///
/// @return CLAST_E_GEOMETRY for coordinates that are not finite or a surface without size
clast_status clx_fill_field_create(const clast_mesh *mesh, clx_fill_field *field);
void clx_fill_field_free(clx_fill_field *field);

/// Distance to the surface if at most max_distance, else INFINITY; closest and tri (its number in
/// the field) are then untouched. Never less than the distance, and more by field->error at most.
double clx_fill_field_distance(const clx_fill_field *field, const double point[3],
                               double max_distance, double closest[3], int32_t *tri);

/// The same to the last bit of a double, slivers and far points included; `closest` may be NULL.
double clx_fill_field_closest(const clx_fill_field *field, const double point[3],
                              double max_distance, double closest[3]);

/// True inside and on the closed surface: exact crossings, the bits of clast_bvh_inside.
bool clx_fill_field_inside(const clx_fill_field *field, const double point[3]);

/// Weights of the edges from corner 0 at the closest point; p is relative to that corner. The three
/// corners differ.
static inline void clx_fill_triangle_weights(const double ab[3], const double ac[3],
                                             const double p[3], double *v, double *w)
{
    const double aa = v3_norm2(ab);
    const double ab_ac = v3_dot(ab, ac);
    const double cc = v3_norm2(ac);
    const double d1 = v3_dot(ab, p);
    const double d2 = v3_dot(ac, p);
    const double d3 = d1 - aa;    // along ab, seen from b
    const double d4 = d2 - ab_ac; // along ac, seen from b
    const double d5 = d1 - ab_ac; // along ab, seen from c
    const double d6 = d2 - cc;    // along ac, seen from c
    const double va = d3 * d6 - d5 * d4;
    const double vb = d5 * d2 - d1 * d6;
    const double vc = d1 * d4 - d3 * d2;
    *v = 0.0;
    *w = 0.0;
    if (d1 <= 0.0 && d2 <= 0.0) {
        return;
    }
    if (d3 >= 0.0 && d4 <= d3) {
        *v = 1.0;
    } else if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        *v = d1 / (d1 - d3);
    } else if (d6 >= 0.0 && d5 <= d6) {
        *w = 1.0;
    } else if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        *w = d2 / (d2 - d6);
    } else if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
        *w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        *v = 1.0 - *w;
    } else {
        const double scale = 1.0 / (va + vb + vc);
        *v = vb * scale;
        *w = vc * scale;
    }
}

/// Vector from the closest point of a triangle to a point that is p away from its corner 0.
static inline void clx_fill_triangle_away(double tri[3][3], const double p[3], double away[3])
{
    double v;
    double w;
    clx_fill_triangle_weights(tri[1], tri[2], p, &v, &w);
    for (int k = 0; k < 3; ++k) {
        away[k] = p[k] - v * tri[1][k] - w * tri[2][k];
    }
}
