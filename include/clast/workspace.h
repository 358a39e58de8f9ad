#pragma once
#include <clast/agglomerate.h>
#include <clast/decompose.h>
#include <clast/field.h>
#include <clast/status.h>

CLAST_BEGIN

// Decomposition inside the time loop of a flow solver: points stay in the caller's arrays, and
// memory is kept from call to call. One call for each step: test, decompose, cells, events,
// collide. What a call is spared is a policy. [docs/theory/decompose.md section 15]

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

/// When the uniformity tests are made.
typedef enum {
    CLAST_TESTS_EACH,  ///< at each call
    CLAST_TESTS_EVERY, ///< at each tests_every-th call
    CLAST_TESTS_MOVED, ///< when a mean or covariance has moved by tests_moved since the last ones
    CLAST_TESTS_NEVER  ///< never: the tree alone decides (other cells need the variant "fast")
} clast_tests_when;

/// When points are cut into cells anew. Otherwise the cells stay, with their points, counts and
/// events counted anew at each call, O(n).
typedef enum {
    CLAST_CUT_EACH,   ///< at each call
    CLAST_CUT_EVERY,  ///< at each cells_every-th call
    CLAST_CUT_CHANGED ///< when counts since the last cut reject one density at cells_level
} clast_cut_when;

/// What calls are spared; by default nothing: each call gives what clast_decompose gives.
///
/// Between tests the last vote stands. Whatever the policy says, points are tested and cut at the
/// first call, after clast_workspace_forget, and when configuration, domain or dimension are not
/// those of the call before; and cut when the vote turns, or when the number of points has changed
/// by half since the cut. Between counts of pairs (estimator auto) the last estimate follows what
/// cells show; they are counted before their time where that has changed by a factor of two, or
/// contradicts it. The error of each policy is measured in docs/theory/decompose.md.
typedef struct clast_workspace_policy {
    int32_t tests;       ///< clast_tests_when
    int32_t tests_every; ///< calls
    double tests_moved;  ///< standard errors, times those that the vote is from turning (> 1)
    int32_t cells;       ///< clast_cut_when
    int32_t cells_every; ///< calls
    double cells_level;  ///< of the chi-square test that finds the cloud changed
    int32_t pairs_every; ///< calls at least between two counts of the pairs of a cloud that cells
                         ///< do not resolve; 0: at each cut
    int32_t pairs_most;  ///< points that such a count takes at the most, of a greater cloud a part
                         ///< chosen by their positions; 0: all, else at least 1000
} clast_workspace_policy;

/// Fields of clast_workspace_policy: keys, defaults, ranges and units; ends with a row of zeros.
extern CLAST_API const clast_field clast_workspace_fields[];

/// What the calls did since the workspace was made.
typedef struct clast_workspace_calls {
    int64_t n_call, n_test, n_cut; ///< calls that succeeded; those that tested, those that cut
    int64_t since_test, since_cut; ///< calls since: 0 the last one did, -1 none has
    double moved;    ///< by the last call: standard errors since the tests, NAN where not measured
    double p_change; ///< by the last call: of its counts, NAN where not measured
    int64_t n_pairs; ///< calls that counted the pairs of a cloud that cells do not resolve
} clast_workspace_calls;

/// An empty workspace, which the caller destroys; CLAST_E_MEMORY.
CLAST_API clast_status clast_workspace_create(clast_workspace **workspace);
CLAST_API void clast_workspace_destroy(clast_workspace *workspace); ///< NULL is allowed

/// Sets the policy of the calls that follow. Begin with clast_fields_default of
/// clast_workspace_fields.
///
/// @return CLAST_E_CONFIG for a field out of its range; the policy is then unchanged
CLAST_API clast_status clast_workspace_set_policy(clast_workspace *workspace,
                                                  const clast_workspace_policy *policy);

/// The next call tests and cuts: for a domain whose map or surface the caller has changed.
CLAST_API clast_status clast_workspace_forget(clast_workspace *workspace);
CLAST_API clast_status clast_workspace_count(const clast_workspace *workspace,
                                             clast_workspace_calls *calls);

/// Step 1 alone: the uniformity tests of config on points in config's domain, whatever the policy.
/// The last decomposition is then gone, and its cells are not kept.
///
/// @return as clast_decompose
CLAST_API clast_status clast_workspace_test(clast_workspace *workspace, const clast_points *points,
                                            const clast_decompose_config *config,
                                            clast_uniformity *result);

/// Steps 1 to 3. *result is borrowed: it stands until the next call with this workspace and must
/// not be freed. It is NULL after a failure, but for a call that is refused for its arguments:
/// CLAST_E_ARGUMENT (NULL, strides not > 0 or such that points share coordinates) or a field out of
/// its range (CLAST_E_CONFIG) change nothing. After any other failure, CLAST_E_MEMORY too, the next
/// call tests and cuts, whatever the policy.
///
/// `before` are the tests last made (with CLAST_TESTS_NEVER none: n_test 0, score and ideal NAN),
/// n_pass, pass and search belong to the last cut.
///
/// @return as clast_decompose; CLAST_E_CONFIG also for crossfit with a policy that spares anything,
/// and for CLAST_TESTS_NEVER with cells that need a vote
/// @note The first call takes memory from the system; a later one only for an array that has
/// outgrown twice the size of any before.
CLAST_API clast_status clast_workspace_decompose(clast_workspace *workspace,
                                                 const clast_points *points,
                                                 const clast_decompose_config *config,
                                                 const clast_decomposition **result);

/// The same in a ready domain, which config->domain then only names in messages (may be NULL): the
/// way for a closed surface or the caller's own map, and without parsing a text at each step. The
/// domain is borrowed for the call; the next one may have another.
CLAST_API clast_status clast_workspace_decompose_in(clast_workspace *workspace,
                                                    const clast_domain *domain,
                                                    const clast_points *points,
                                                    const clast_decompose_config *config,
                                                    const clast_decomposition **result);

/// Cell of each point of the last decomposition, -1 for points left out, into cell[i * stride].
///
/// @return CLAST_E_USAGE before the first decomposition
CLAST_API clast_status clast_workspace_cells(const clast_workspace *workspace, int64_t stride,
                                             int32_t *cell);

/// Expected events of the cell of each point, shared equally among its points, into
/// events[i * stride]: what a solver that keeps its own cells adds up. Without beta_dt its share of
/// the pair integral [1/m^d]. 0 for points left out.
///
/// @return CLAST_E_USAGE before the first decomposition
CLAST_API clast_status clast_workspace_events(const clast_workspace *workspace, int64_t stride,
                                              double *events);

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
