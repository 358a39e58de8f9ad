#pragma once
// Contact of two placed convex bodies, and of one with a wall: signed gap, normal, point.
//
// Bodies are shape + pose; a hull's mesh is shared by all grains of that form (hull_core.h). What
// is exact and to what digit: docs/theory/contact-convex.md.
#include "convex/hull_core.h"

typedef enum {
    CLX_CONVEX_SPHERE,    ///< `round` is the radius
    CLX_CONVEX_ELLIPSOID, ///< `semi_axes` along the body's x, y, z
    CLX_CONVEX_HULL       ///< scale * core
} clx_convex_kind;

/// A convex shape without a pose; plain value, `core` is borrowed.
typedef struct clx_convex {
    clx_convex_kind kind;
    const clx_hull_core *core; ///< hull
    double scale;              ///< hull: metres per core unit
    double semi_axes[3];       ///< ellipsoid [m]
    double round; ///< sphere: radius; others: margin by which the shape is grown (0: as is) [m]
    double bounding_radius; ///< everything lies within this distance of the position [m]
    double inner;           ///< this ball about the position is inside the shape; <= 0: none is [m]
} clx_convex;

clx_convex clx_convex_sphere(double radius);
clx_convex clx_convex_ellipsoid(const double semi_axes[3]);
clx_convex clx_convex_hull(const clx_hull_core *core, double scale);

/// Grows the shape by `margin` all around (a rounded hull, not a scaled one).
void clx_convex_grow(clx_convex *shape, double margin);

/// Two placed shapes. Rotations are row by row, world = R body.
typedef struct clx_pair {
    const clx_convex *a, *b;
    const double *rotation_a, *rotation_b; ///< [9] each
    double offset[3];                      ///< position of b minus position of a, nearest image [m]
} clx_pair;

/// Where two bodies are closest, or how they overlap least.
typedef struct clx_contact {
    double gap;       ///< > 0 apart, < 0 overlap: the least move that parts them [m]
    double normal[3]; ///< unit, from b (or the wall) towards a: the push on a
    double point[3];  ///< midway between the two witness points, relative to a's position [m]
} clx_contact;

/// What a pair's contact search begins from: the feature and normal of the last one; {0} is empty.
/// A warm start that no longer holds costs time, never accuracy. Belongs to these shapes a and b in
/// this order; results depend on nothing but the pair and these bytes. No padding; 144 bytes.
typedef struct clx_warm_start {
    int32_t feature[2]; ///< of a, of b, by `kind`
    uint16_t kind;      ///< clx_facet_kind
    uint16_t n;         ///< points of the simplex, 0 to 4
    float sure;         ///< margin wanted over overlap
    float seen[2][3];   ///< where it was stored: facet_warm_start.c; round bodies: last normal
    float limit[2];     ///< how far from there it holds
    union {
        double data[12];     ///< the facet's features, scaled, in their bodies' axes
        uint16_t vert[2][4]; ///< simplex: vertices of a, of b
    };
} clx_warm_start;

/// What a unit vector loses as floats (clx_warm_start.seen), and a point in units of its body.
#define CLX_FLOAT_SLACK 4e-7

/// Contact of a pair. False if the gap surely exceeds max_gap: contact->gap is then a lower bound
/// of the gap that exceeds max_gap, and the rest is undefined.
///
/// Error of gap: 1e-14 of the bodies' size; 1e-11 for a hull with an ellipsoid.
///
/// @param warm_start  of this pair, or NULL for none
/// @note no allocation, thread-safe, deterministic
bool clx_pair_contact(const clx_pair *pair, double max_gap, clx_warm_start *warm_start,
                      clx_contact *contact);

/// The same of two hulls where the warm start's facet is known not to do (clx_facet_again).
bool clx_hulls_contact_anew(const clx_pair *pair, double max_gap, clx_warm_start *warm_start,
                            clx_contact *contact);

/// A shape before a wall.
typedef struct clx_placed {
    const clx_convex *shape;
    const double *rotation; ///< [9]
    double position[3];
} clx_placed;

/// Contact with the half-space n.x <= offset (n unit, into the free side). The warm start is this
/// body's at this plane, 0 at first, and is renewed: a hull's vertex, which is the result while it
/// surely is the deepest; NULL is allowed. Exact; the point is relative to the body's position.
void clx_plane_contact(const clx_placed *body, const double plane[4], clx_warm_start *warm_start,
                       clx_contact *contact);

/// Contact with the inside of a circular cylinder about the z axis through (axis[0], axis[1]):
/// the deepest point, exact for every shape.
void clx_cylinder_contact(const clx_placed *body, const double axis[2], double radius,
                          clx_contact *contact);
