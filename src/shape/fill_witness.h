#pragma once
// What is known of the free radius f at sampled points, and what it says about a cube.
#include "shape/fill.h"

/// f at a point, and what bounds it there.
typedef struct clx_fill_sample {
    double at[3];
    double nearest[3];   ///< surface point, when `surface` is a number
    double value;        ///< f(at), as far as the first `seen` spheres go
    double surface;      ///< signed distance to the surface; NAN when a sphere is nearer
    double outer[3];     ///< centre of a ball outside the solid
    double outer_radius; ///< 0: none is known
    int32_t ball;        ///< the nearer sphere, or -1
    int32_t tri;         ///< nearest triangle of the field, with a known `surface`; -1: not known
    int32_t seen;
    float size; ///< of that triangle, the radius of a sphere that holds it
} clx_fill_sample;

/// A cube, and what is known to bound f inside.
typedef struct clx_fill_region {
    double centre[3];
    double half;  ///< half an edge
    double upper; ///< f is no greater: farther witnesses are of no use
} clx_fill_region;

typedef struct clx_fill_witnesses {
    clx_fill_planes planes;
    uint64_t digest;                   ///< a bit for each name that is known, by its hash
    int32_t known[CLX_FILL_WITNESSES]; ///< spheres, and -1 - triangles, taken already
    int n_known;
} clx_fill_witnesses;

void clx_fill_witnesses_clear(clx_fill_witnesses *w);

/// Adds what one sample saw: its triangle or point of the surface, its sphere, its outer ball.
void clx_fill_witnesses_add(const clx_fill *fill, const clx_fill_region *region,
                            const clx_fill_sample *sample, clx_fill_witnesses *w);
