#pragma once
// The points that are tested and cut into cells, in the unit cube.
#include <clast/cloud.h>
#include <clast/decompose.h>

typedef struct clx_part clx_part;
typedef struct clx_fixed_scale clx_fixed_scale;

/// Points in the order: tested and real, tested ghosts (outside a mesh domain), real but not tested
/// (thinned out for their weights). One rank keeps their images in the unit cube. Of several ranks
/// none does, but in a mesh, where an image costs an inside test: they are made of the cloud's
/// positions each time they are asked for, in a third of the memory.
typedef struct clx_sample {
    const clast_domain *domain; ///< borrowed
    const clast_comm *comm;     ///< ranks that have a part of the points each; borrowed
    int64_t n_test, n;          ///< tested, and all; here
    int64_t n_real;
    int64_t n_real_all, n_outside_all; ///< on all ranks
    double *u;                         ///< [n][d], or NULL
    const double *x;                   ///< of the cloud, where u is NULL; borrowed
    int64_t *number; ///< [n] which point of the cloud, -1: a ghost; with x NULL for all of them
} clx_sample;

static inline int64_t clx_sample_number(const clx_sample *sample, int64_t i)
{
    return sample->number != NULL ? sample->number[i] : i;
}

/// Place [d] of point i in the unit cube: one of u, or made in `held`.
const double *clx_sample_point(const clx_sample *sample, int64_t i, double held[3]);

/// The first n points, beside those of the other ranks; borrows the sample.
clx_part clx_sample_part(const clx_sample *sample, int64_t n);

/// What sums of all ranks' weights are counted in; called by all ranks.
///
/// @param weight  of all points of the cloud here, or NULL (1)
clx_fixed_scale clx_sample_scale(const clx_sample *sample, const double *weight);

/// Coordinates are finite, weights and radii are > 0; the numbers of points in messages follow
/// those of the ranks before.
clast_status clx_points_check(const clast_cloud *cloud, int64_t before);

/// Maps a cloud's points, the part of this rank; called by all ranks. With a mesh domain
/// round(n (V_box / V - 1)) uniform ghosts fill the rest of the box, a stretch of their numbers on
/// each rank; of weighted points one is tested with chance w / w_max, so that those tested are a
/// sample of the real particles. Place and weight decide, on any rank and in any row: points that
/// have both in common are tested together or not at all.
///
/// @return CLAST_E_FORMAT for coordinates that are not finite, weights that are not > 0, points
/// outside with CLAST_OUTSIDE_ERROR
clast_status clx_sample_make(const clast_comm *comm, const clast_cloud *cloud,
                             const clast_decompose_config *config, const clast_domain *domain,
                             clx_sample *sample);

/// clx_sample_make in two steps: every point of the cloud that lies in the domain, tested all; then
/// thinned out for weights, and filled up by ghosts.
clast_status clx_sample_map(const clast_comm *comm, const clast_cloud *cloud,
                            const clast_decompose_config *config, const clast_domain *domain,
                            clx_sample *sample);
clast_status clx_sample_complete(const clast_cloud *cloud, const clast_decompose_config *config,
                                 clx_sample *sample);
void clx_sample_free(clx_sample *sample);
