#pragma once
// Four children a node in single precision: what pictures walk. Boxes are rounded outwards, so
// nothing is missed; what a leaf holds is tested in double by the caller.
#include "geom/tree.h"

#include <math.h>
#include <stdbool.h>

enum { CLX_WIDE = 4, CLX_WIDE_STACK = 3 * CLX_TREE_DEPTH + 4 };

/// Four floats that one instruction handles (GCC and Clang vector types, portable to any target).
typedef float clx_float4 __attribute__((vector_size(16)));
typedef int32_t clx_mask4 __attribute__((vector_size(16)));

/// 128 bytes, two cache lines. An empty lane has low > high.
typedef struct clx_wide_node {
    clx_float4 bound[2][3];  ///< low and high ends along the axes
    int32_t child[CLX_WIDE]; ///< node, or first item of a leaf
    int32_t count[CLX_WIDE]; ///< items of a leaf; 0 for an inner child
} clx_wide_node;

typedef struct clx_wide {
    int32_t n_node;
    clx_wide_node *node;
    double reach; ///< largest absolute coordinate of the root's box
} clx_wide;

/// Merges pairs of levels of a binary tree. Coordinates must be below 1e30 in size.
clast_status clx_wide_build(const clx_tree *tree, clx_wide *wide);
void clx_wide_free(clx_wide *wide);

typedef struct clx_wide_ray {
    float near[3]; ///< origin, shifted so that boxes seem wider than they are
    float far[3];
    float inverse[3];
    bool is_negative[3];
} clx_wide_ray;

static inline clx_wide_ray clx_wide_ray_of(const clx_wide *wide, const double origin[3],
                                           const double direction[3])
{
    clx_wide_ray ray;
    double reach = wide->reach;
    for (int k = 0; k < 3; ++k) {
        const double size = fabs(origin[k]);
        reach = size > reach ? size : reach;
    }
    const double widen = 0x1p-21 * reach; // 4 ulp of a float
    for (int k = 0; k < 3; ++k) {
        const bool is_negative = signbit(direction[k]);
        ray.is_negative[k] = is_negative;
        ray.near[k] = (float)(is_negative ? origin[k] - widen : origin[k] + widen);
        ray.far[k] = (float)(is_negative ? origin[k] + widen : origin[k] - widen);
        ray.inverse[k] = (float)(1.0 / direction[k]);
    }
    return ray;
}

/// a > b ? a : b in each lane: b where either is no number.
static inline clx_float4 clx_max4(clx_float4 a, clx_float4 b)
{
#ifdef __SSE__
    return __builtin_ia32_maxps(a, b);
#else
    const clx_mask4 m = a > b;
    return (clx_float4)((m & (clx_mask4)a) | (~m & (clx_mask4)b));
#endif
}

static inline clx_float4 clx_min4(clx_float4 a, clx_float4 b)
{
#ifdef __SSE__
    return __builtin_ia32_minps(a, b);
#else
    const clx_mask4 m = a < b;
    return (clx_float4)((m & (clx_mask4)a) | (~m & (clx_mask4)b));
#endif
}

/// Where the ray enters the four boxes, and a mask of those it meets at all. NaN (0 * infinity)
/// never wins a comparison and so leaves the interval as it is, which is the safe side.
static inline clx_mask4 clx_wide_enter(const clx_wide_node *node, const clx_wide_ray *ray,
                                       float t_low, float t_high, clx_float4 *t)
{
    clx_float4 in = {t_low, t_low, t_low, t_low};
    clx_float4 out = {t_high, t_high, t_high, t_high};
    for (int k = 0; k < 3; ++k) {
        const int side = ray->is_negative[k];
        in = clx_max4((node->bound[side][k] - ray->near[k]) * ray->inverse[k], in);
        out = clx_min4((node->bound[1 - side][k] - ray->far[k]) * ray->inverse[k], out);
    }
    *t = in;
    return in <= out * (1.0F + 0x1p-20F);
}

/// Asks a leaf's items: returns the new end of the ray (t_high when nothing was hit; -INFINITY to
/// end the walk).
typedef double (*clx_wide_visit)(void *context, int32_t first, int32_t count, double t_high);

/// Visits the leaves that the ray meets between t_low >= 0 and t_high, nearer boxes first; the
/// ray's new end.
static inline double clx_wide_walk(const clx_wide *wide, const clx_wide_ray *ray, double t_low,
                                   double t_high, clx_wide_visit visit, void *context)
{
    struct {
        int32_t node;
        float t;
    } stack[CLX_WIDE_STACK];
    int n_stack = 1;
    stack[0].node = 0;
    stack[0].t = 0.0F;
    while (n_stack > 0) {
        --n_stack;
        // Slack for the rounding of float distances.
        if ((double)stack[n_stack].t * (1.0 - 0x1p-20) > t_high) {
            continue;
        }
        const clx_wide_node *node = &wide->node[stack[n_stack].node];
        clx_float4 t;
        const clx_mask4 meets = clx_wide_enter(node, ray, (float)t_low, (float)t_high, &t);
        int order[CLX_WIDE];
        int n = 0;
        for (int i = 0; i < CLX_WIDE; ++i) {
            if (meets[i] != 0) {
                int j = n++;
                for (; j > 0 && t[order[j - 1]] > t[i]; --j) {
                    order[j] = order[j - 1];
                }
                order[j] = i;
            }
        }
        // Leaves at once, nearest first; inner children onto the stack, nearest on top.
        for (int j = 0; j < n; ++j) {
            const int i = order[j];
            if (node->count[i] > 0 && (double)t[i] * (1.0 - 0x1p-20) <= t_high) {
                t_high = visit(context, node->child[i], node->count[i], t_high);
            }
        }
        for (int j = n - 1; j >= 0; --j) {
            const int i = order[j];
            if (node->count[i] == 0) {
                stack[n_stack].node = node->child[i];
                stack[n_stack++].t = t[i];
            }
        }
    }
    return t_high;
}
