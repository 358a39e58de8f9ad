#pragma once
// The spheres placed so far, laid out for scans.
#include "base/status.h"
#include <clast/shape.h>

/// Four floats that the compiler keeps in one register (GCC and Clang vectors; any machine).
typedef float clx_float4 __attribute__((vector_size(16)));

typedef int32_t clx_int4 __attribute__((vector_size(16)));

/// Eight: two SSE2 registers or one of AVX2; blocks of the heap are aligned to 16.
typedef float clx_float8 __attribute__((vector_size(32), aligned(16)));

typedef int32_t clx_int8 __attribute__((vector_size(32), aligned(16)));

enum { CLX_BALL_LANES = 8 };

/// Spheres side by side in the float frame (x - middle) * scale.
typedef struct clx_ball_group {
    clx_float8 x, y, z, radius; ///< an empty slot has x = INFINITY
} clx_ball_group;

typedef struct clx_ball_set {
    double middle[3], scale; ///< the float frame; sizes in it are about 1
    int32_t n;
    double (*ball)[4];     ///< [n] centre and radius
    clx_ball_group *group; ///< [ceil(n / CLX_BALL_LANES)]
    int64_t ball_capacity, group_capacity;
} clx_ball_set;

clast_status clx_ball_set_add(clx_ball_set *set, const double centre[3], double radius);
void clx_ball_set_free(clx_ball_set *set);

/// Least distance of a point to the surfaces of spheres [first, n), or `limit` when none is nearer;
/// *nearest is then untouched. Where spheres hold the point, that of one of them (negative).
double clx_ball_set_distance(const clx_ball_set *set, int32_t first, const double point[3],
                             double limit, int32_t *nearest);

/// Copies the spheres out, in the order of their adding.
clast_status clx_ball_set_spheres(const clx_ball_set *set, clast_spheres *spheres);
