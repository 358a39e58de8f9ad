#pragma once
// Bodies for tests and timings of first touch: shapes as trees, random poses.
#include "math/rng.h"
#include "touch/tree.h"

typedef enum {
    BODY_ELLIPSOID_MESH, ///< icosphere, stretched, 20 * 4^level triangles
    BODY_BUMPY_MESH,     ///< icosphere with hills and hollows, not convex
    BODY_BOX,
    BODY_PLATE,   ///< a box 1000 times as wide as thick
    BODY_L,       ///< two boxes that overlap: a concave outline
    BODY_SPHERES, ///< 30 overlapping spheres
    N_BODY_KIND
} body_kind;

/// Tree of a test shape of size about 1; `level` divides the icospheres. NULL on failure.
clx_touch_tree *make_tree(body_kind kind, int level, clx_rng *rng);

/// Random pose within a cube of half-width `spread`.
void place_at_random(clx_touch_body *body, double spread, double scale, clx_rng *rng);

/// A tree of each kind at level 1, drawn from the number `draw`; 0, or -1 on failure.
int make_trees(clx_touch_tree *tree[N_BODY_KIND], uint64_t draw);
void destroy_trees(clx_touch_tree *tree[N_BODY_KIND]);
