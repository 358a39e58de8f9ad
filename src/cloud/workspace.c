// Decompositions on the caller's arrays with memory that is kept.
#include <clast/workspace.h>

#include "base/alloc.h"
#include "cloud/contract.h"
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
    CLX_NEED(workspace);
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

/// Whether two coordinates are the same double: (di, dj) of them lie di stride = dj axis_stride
/// apart.
static bool overlap(const clast_points *p)
{
    bool is = false;
    for (int64_t j = 1; j < p->dimension; ++j) {
        is = is || (j * p->axis_stride % p->stride == 0 && j * p->axis_stride / p->stride < p->n);
    }
    return is;
}

static clast_status check_points(const clast_points *p)
{
    clast_status status = CLAST_OK;
    const int64_t most = INT64_C(1) << 40; // doubles between two points, or two coordinates
    CLX_NEED(p);
    CLX_CHECK(p->dimension >= 1 && p->dimension <= 3, CLAST_E_ARGUMENT,
              "points have 1, 2 or 3 dimensions, not %d", p->dimension);
    CLX_CHECK(p->n >= 0, CLAST_E_ARGUMENT, "%lld points", (long long)p->n);
    CLX_CHECK(p->n == 0 || p->x != NULL, CLAST_E_ARGUMENT, "%lld points, and x is NULL",
              (long long)p->n);
    CLX_CHECK(p->stride > 0 && p->stride <= most, CLAST_E_ARGUMENT,
              "the stride between points is %lld; 3 for xyzxyz..", (long long)p->stride);
    CLX_CHECK(p->dimension == 1 || (p->axis_stride > 0 && p->axis_stride <= most), CLAST_E_ARGUMENT,
              "the stride between coordinates is %lld; 1 for xyzxyz..", (long long)p->axis_stride);
    CLX_CHECK(!overlap(p), CLAST_E_ARGUMENT,
              "the strides %lld and %lld let points share coordinates", (long long)p->stride,
              (long long)p->axis_stride);
    CLX_CHECK(p->weight == NULL || (p->weight_stride > 0 && p->weight_stride <= most),
              CLAST_E_ARGUMENT, "the stride between weights is %lld", (long long)p->weight_stride);
done:
    return status;
}

/// The caller's points one behind the other; x and weight are the pool's, or borrowed when they lie
/// so already.
static clast_status gather(const clast_points *points, clast_cloud *cloud)
{
    clast_status status = CLAST_OK;
    const int32_t d = points->dimension;
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

static clast_status decompose(clast_workspace *workspace, const clast_points *points,
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

clast_status clast_workspace_decompose(clast_workspace *workspace, const clast_points *points,
                                       const clast_decompose_config *config,
                                       const clast_decomposition **result)
{
    CLX_ARGUMENTS(workspace, points, config, result);
    clast_status status = CLAST_OK;
    CLX_TRY(clast_fields_check(clast_decompose_fields, config));
    CLX_TRY(check_points(points));
    CLX_TRY(decompose(workspace, points, config, result));
done:
    return status;
}

clast_status clast_workspace_test(clast_workspace *workspace, const clast_points *points,
                                  const clast_decompose_config *config, clast_uniformity *result)
{
    CLX_ARGUMENTS(workspace, points, config, result);
    clast_status status = CLAST_OK;
    const clast_decomposition *made = NULL;
    CLX_TRY(clast_fields_check(clast_decompose_fields, config)); // before two are set
    clast_decompose_config alone = *config;
    alone.variant = CLAST_VARIANT_TEST;
    alone.crossfit = false;
    CLX_TRY(clast_workspace_decompose(workspace, points, &alone, &made));
    *result = workspace->last.before;
done:
    return status;
}

static clast_status check_output(const clast_workspace *workspace, const void *output,
                                 int64_t stride)
{
    clast_status status = CLAST_OK;
    CLX_NEED(workspace);
    CLX_CHECK(workspace->n_point >= 0, CLAST_E_USAGE, "the workspace holds no decomposition yet");
    CLX_CHECK(workspace->n_point == 0 || output != NULL, CLAST_E_ARGUMENT,
              "%lld points, and the array to write is NULL", (long long)workspace->n_point);
    CLX_CHECK(stride > 0, CLAST_E_ARGUMENT, "the stride is %lld; 1 for an array without gaps",
              (long long)stride);
done:
    return status;
}

clast_status clast_workspace_cells(const clast_workspace *workspace, int32_t *cell, int64_t stride)
{
    CLX_ARGUMENTS(workspace, cell);
    const clast_status status = check_output(workspace, cell, stride);
    for (int64_t i = 0; status == CLAST_OK && i < workspace->n_point; ++i) {
        cell[i * stride] = workspace->last.cells.of_point[i];
    }
    return status;
}

clast_status clast_workspace_events(const clast_workspace *workspace, double *events,
                                    int64_t stride)
{
    CLX_ARGUMENTS(workspace, events);
    const clast_status status = check_output(workspace, events, stride);
    for (int64_t i = 0; status == CLAST_OK && i < workspace->n_point; ++i) {
        const clast_cells *cells = &workspace->last.cells;
        const int32_t c = cells->of_point[i];
        events[i * stride] = c >= 0 ? cells->events[c] / (double)cells->count[c] : 0.0;
    }
    return status;
}

clast_status clast_workspace_collide(clast_workspace *workspace, clast_population *particles,
                                     const clast_collide_cells *cells, clast_workspace_step step,
                                     const clast_collide_config *config, int64_t *n_event)
{
    CLX_ARGUMENTS(workspace, particles, cells, config);
    clx_pool *const before = clx_pool_enter(workspace->pool);
    const clast_status status =
        clast_collide(particles, cells, step.dt, step.step, config, n_event);
    (void)clx_pool_enter(before);
    return status;
}
