#pragma once
// An assembly made ready for rays: one hierarchy per shape, one over the grains.
#include "geom/bvh.h"
#include "render/wide.h"
#include <clast/render.h>
#include <clast/shape.h>

/// Corners of a leaf's triangles in single precision, times block_unit.
typedef struct clx_scene_block {
    float corner[3][3][CLX_WIDE_LANES]; ///< [corner][axis][triangle]
} clx_scene_block;

/// A shape in its own frame; what is not of its kind is empty.
typedef struct clx_scene_shape {
    clast_shape_kind kind;
    double semi_axes[3];
    double per_axis[3]; ///< 1 / semi_axes of spheres and ellipsoids
    clast_bvh *bvh;
    float (*normal)[3][3]; ///< [n_tri] unit normals at the corners, in leaf order; NULL: flat
    const clast_spheres *spheres; ///< borrowed
    clx_tree tree;                ///< over the spheres of a clump
    clx_wide wide;                ///< over bvh->tree or tree
    clx_scene_block *block;       ///< of a mesh, for each leaf of wide
    double block_unit;            ///< power of two: the blocks' coordinates are below 2
} clx_scene_shape;

typedef struct clx_scene_grain {
    int32_t shape;
    double rotation[3][3]; ///< world = position + scale rotation local
    double inverse[3][3];  ///< local = inverse (world - position)
    double position[3];
    double scale;
    double albedo[3]; ///< linear light, 0 to 1
} clx_scene_grain;

/// The kept half-space: normal . x <= offset.
typedef struct clx_scene_cut {
    bool is_on;
    double normal[3];
    double offset;
} clx_scene_cut;

typedef struct clx_scene {
    int32_t n_shape;
    clx_scene_shape *shape;
    int32_t n_grain;
    clx_scene_grain *grain;
    clx_tree tree; ///< over the grains
    clx_wide wide;
    double centre[3]; ///< of the box of everything
    double radius;    ///< half its diagonal
    double low[3], high[3];
    clx_scene_cut cut;
    uint64_t lane_order[1 << CLX_WIDE_LANES]; ///< of floats_pack
} clx_scene;

/// A point of a surface, seen along a ray.
typedef struct clx_scene_hit {
    double t;
    int32_t grain;
    int32_t item;     ///< triangle or sphere, in leaf order
    double bary[3];   ///< triangles
    double point[3];  ///< world; where to start further rays (lifted off coarse facets)
    double face[3];   ///< unit normal of the true surface, towards the viewer
    bool is_lifted;   ///< point lies above the true surface, on the smooth one meant
    double normal[3]; ///< unit normal for shading, towards the viewer
} clx_scene_hit;

/// The assembly is borrowed and must outlive the scene.
clast_status clx_scene_build(const clast_assembly *assembly, clast_render_shading shading,
                             clx_scene *scene);
void clx_scene_free(clx_scene *scene);

/// First surfaces that at most CLX_BUNDLE (render/travel.h) rays meet from t_low >= 0 on, on the
/// kept side; directions are unit vectors. Bits of the rays that meet one: their hits are filled.
uint32_t clx_scene_hit_first(const clx_scene *scene, int n, double (*origin)[3],
                             double (*direction)[3], double t_low, clx_scene_hit *hit);

/// Bits of those of n rays that meet anything on the kept side from t_low >= 0 on.
uint32_t clx_scene_blocked(const clx_scene *scene, int n, double (*origin)[3],
                           double (*direction)[3], double t_low);

/// The grain that holds a point, the lowest-numbered, or -1.
int32_t clx_scene_holder(const clx_scene *scene, const double point[3]);

/// Greatest x . direction over all surfaces, exact.
double clx_scene_support(const clx_scene *scene, const double direction[3]);

/// Interval of the ray on the kept side of the cut, within [*t_low, *t_high]; false when empty.
/// *is_entered: the interval starts on the cut.
bool clx_scene_clip(const clx_scene *scene, const double origin[3], const double direction[3],
                    double *t_low, double *t_high, bool *is_entered);

/// Normals at the corners of a mesh in leaf order: mean of the faces around a vertex that turn less
/// than 50 degrees from the corner's own, weighted by their angle.
clast_status clx_corner_normals(const clast_bvh *bvh, float (**normal)[3][3]);
