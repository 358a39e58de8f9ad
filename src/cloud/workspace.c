// Decompositions on the caller's arrays with memory that is kept.
#include <clast/workspace.h>

#include "base/alloc.h"
#include "cloud/passes.h"
#include "cloud/uniformity.h"
#include <math.h>
#include <string.h>

struct clast_workspace {
    clx_pool *pool;
    clast_decomposition last; ///< in the pool
    int64_t n_point;          ///< of the last call; -1: there is none
};

clast_status clast_workspace_create(clast_workspace **workspace)
{
    clast_status status = CLAST_OK;
    clast_workspace *made = NULL;
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    CLX_TRY(clx_pool_create(&made->pool));
    made->n_point = -1;
    *workspace = made;
    made = NULL;
done:
    clx_free(made);
    return status;
}

void clast_workspace_destroy(clast_workspace *workspace)
{
    if (workspace != NULL) {
        clx_pool_destroy(workspace->pool);
        clx_free(workspace);
    }
}

/// The caller's points one behind the other; x and weight are the pool's, or borrowed when they lie
/// so already.
static clast_status gather(const clast_points *points, clast_cloud *cloud)
{
    clast_status status = CLAST_OK;
    const int32_t d = points->dimension;
    CLX_CHECK(d >= 1 && d <= 3, CLAST_E_USAGE, "points have 1, 2 or 3 dimensions, not %d", d);
    CLX_CHECK(points->n >= 0, CLAST_E_USAGE, "%lld points", (long long)points->n);
    cloud->n = points->n;
    cloud->dimension = d;
    CLX_TRY(clx_alloc(&cloud->x, points->n, (size_t)d * sizeof *cloud->x));
    for (int64_t i = 0; i < points->n; ++i) {
        for (int32_t j = 0; j < d; ++j) {
            cloud->x[i * d + j] = points->x[i * points->stride + j * points->axis_stride];
        }
    }
    if (points->weight != NULL) {
        CLX_TRY(clx_alloc(&cloud->weight, points->n, sizeof *cloud->weight));
        for (int64_t i = 0; i < points->n; ++i) {
            cloud->weight[i] = points->weight[i * points->weight_stride];
        }
    }
done:
    return status;
}

clast_status clast_workspace_decompose(clast_workspace *workspace, const clast_points *points,
                                       const clast_decompose_config *config,
                                       const clast_decomposition **result)
{
    clast_status status = CLAST_OK;
    clast_cloud cloud = {0};
    clx_pool *const before = clx_pool_enter(workspace->pool);
    *result = NULL;
    workspace->n_point = -1;
    clast_decomposition_free(&workspace->last);
    CLX_TRY(gather(points, &cloud));
    CLX_TRY(clast_decompose(&cloud, config, &workspace->last));
    workspace->n_point = points->n;
    *result = &workspace->last;
done:
    clast_cloud_free(&cloud);
    (void)clx_pool_enter(before);
    return status;
}

clast_status clast_workspace_test(clast_workspace *workspace, const clast_points *points,
                                  const clast_decompose_config *config, clast_uniformity *result)
{
    clast_decompose_config alone = *config;
    const clast_decomposition *made = NULL;
    alone.variant = CLAST_VARIANT_TEST;
    alone.crossfit = false;
    const clast_status status = clast_workspace_decompose(workspace, points, &alone, &made);
    if (status == CLAST_OK) {
        *result = made->before;
    }
    return status;
}

clast_status clast_workspace_cells(const clast_workspace *workspace, int32_t *cell, int64_t stride)
{
    if (workspace->n_point < 0) {
        return clx_fail(CLAST_E_USAGE, "the workspace holds no decomposition yet");
    }
    for (int64_t i = 0; i < workspace->n_point; ++i) {
        cell[i * stride] = workspace->last.cells.of_point[i];
    }
    return CLAST_OK;
}

clast_status clast_workspace_events(const clast_workspace *workspace, double *events,
                                    int64_t stride)
{
    const clast_cells *cells = &workspace->last.cells;
    if (workspace->n_point < 0) {
        return clx_fail(CLAST_E_USAGE, "the workspace holds no decomposition yet");
    }
    for (int64_t i = 0; i < workspace->n_point; ++i) {
        const int32_t c = cells->of_point[i];
        events[i * stride] = c >= 0 ? cells->events[c] / (double)cells->count[c] : 0.0;
    }
    return CLAST_OK;
}

clast_status clast_workspace_collide(clast_workspace *workspace, clast_population *particles,
                                     const clast_collide_cells *cells, clast_workspace_step step,
                                     const clast_collide_config *config, int64_t *n_event)
{
    clx_pool *const before = clx_pool_enter(workspace->pool);
    const clast_status status =
        clast_collide(particles, cells, step.dt, step.step, config, n_event);
    (void)clx_pool_enter(before);
    return status;
}
