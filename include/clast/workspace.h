#pragma once
#include <clast/collide.h>
#include <clast/decompose.h>

CLAST_BEGIN

// Decomposition inside the time loop of a flow solver: points stay in the caller's arrays, and
// memory is kept from call to call. One call for each step: test, decompose, cells, events,
// collide. [docs/theory/decompose.md section 15]

/// Points in the caller's arrays. Coordinate j of point i is x[i * stride + j * axis_stride]:
/// (3, 1) for xyzxyz.., (1, n) for three arrays behind each other, (8, 1) in records of 8 doubles.
typedef struct clast_points {
    int64_t n;
    int32_t dimension; ///< 1, 2 or 3
    const double *x;   ///< [m]
    int64_t stride, axis_stride;
    const double *weight;  ///< real particles each stands for, or NULL (1)
    int64_t weight_stride; ///< between weights
} clast_points;

/// Memory of decompositions and the last one made. Opaque; one thread at a time, any number of
/// them beside each other.
typedef struct clast_workspace clast_workspace;

CLAST_API clast_status clast_workspace_create(clast_workspace **workspace);
CLAST_API void clast_workspace_destroy(clast_workspace *workspace); ///< NULL is allowed

/// Step 1 alone: the uniformity tests of config on points in config's domain.
///
/// @return as clast_decompose
CLAST_API clast_status clast_workspace_test(clast_workspace *workspace, const clast_points *points,
                                            const clast_decompose_config *config,
                                            clast_uniformity *result);

/// Steps 1 to 3. *result is borrowed: it stands until the next call with this workspace and must
/// not be freed. It is NULL after a failure, but for a call that is refused for its arguments:
/// CLAST_E_ARGUMENT (NULL, strides not > 0 or such that points share coordinates) or a field out of
/// its range (CLAST_E_CONFIG) change nothing.
///
/// @note The first call takes memory from the system; a later one only for an array that has
/// outgrown twice the size of any before.
CLAST_API clast_status clast_workspace_decompose(clast_workspace *workspace,
                                                 const clast_points *points,
                                                 const clast_decompose_config *config,
                                                 const clast_decomposition **result);

/// Cell of each point of the last decomposition, -1 for points left out, into cell[i * stride].
///
/// @return CLAST_E_USAGE before the first decomposition
CLAST_API clast_status clast_workspace_cells(const clast_workspace *workspace, int32_t *cell,
                                             int64_t stride);

/// Expected events of the cell of each point, shared evenly among its points, into
/// events[i * stride]: what a solver that keeps its own cells adds up. 0 for points left out.
///
/// @return CLAST_E_USAGE before the first decomposition
CLAST_API clast_status clast_workspace_events(const clast_workspace *workspace, double *events,
                                              int64_t stride);

/// What one time step of collisions needs beside particles and cells.
typedef struct clast_workspace_step {
    double dt;     ///< [s]
    uint64_t step; ///< number of the step; keys the random draws
} clast_workspace_step;

/// clast_collide with the memory of the workspace.
CLAST_API clast_status clast_workspace_collide(
    clast_workspace *workspace, clast_population *particles, const clast_collide_cells *cells,
    clast_workspace_step step, const clast_collide_config *config, int64_t *n_event);

CLAST_END
