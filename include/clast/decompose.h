#pragma once
#include <clast/field.h>
#include <clast/pairs.h>
#include <clast/status.h>
#include <clast/table.h>

CLAST_BEGIN

// Is a set of points uniform in the unit interval, square or cube? Five tests, each callable alone.
// Points are u [n][d], d = 1, 2 or 3, every coordinate in [0, 1]; a domain is mapped to the cube
// first (clast/cloud.h). [Martinez2021 sec. 2; docs/theory/uniformity.md]

typedef enum {
    CLAST_DISCREPANCY_SYMMETRIC,
    CLAST_DISCREPANCY_CENTRED,
    CLAST_DISCREPANCY_STAR, ///< Hickernell's modified L2, all projections; not the classical
                            ///< L2-star
    CLAST_N_DISCREPANCY
} clast_discrepancy_kind;

/// How pair sums are computed; both are deterministic for any thread count.
typedef enum {
    CLAST_SUMS_AUTO,  ///< exact up to 20000 points, binned above
    CLAST_SUMS_EXACT, ///< to rounding, O(n log n) in 1-D and 2-D, O(n log^2 n) in 3-D
    CLAST_SUMS_BINNED ///< O(n), A_n within 5e-4, HZ within 2e-4
} clast_sums;

/// Statistics of one discrepancy.                                         [Liang2001; Martinez2021
/// eq. 7]
typedef struct clast_discrepancy {
    double U1;           ///< mean of the product over coordinates of the one-point factor
    double U2;           ///< mean over ordered pairs k != l of the product of pair factors
    double D2;           ///< squared discrepancy
    double A;            ///< sqrt(n) [(U1 - M^d) + 2 (U2 - M^d)] / (5 sqrt(xi))
    double variance;     ///< of A under uniformity at this n, exact
    double A_standard;   ///< A / sqrt(variance)
    double p;            ///< two-sided normal p of A_standard
    double p_asymptotic; ///< two-sided normal p of A
    double p_paper;      ///< 1 - Phi(|A|) as printed: rejects twice as often as it says
    double T, p_T;       ///< Liang's chi-square statistic with 2 degrees and its p
    double M, xi, zeta2; ///< constants of the kernel in this dimension
} clast_discrepancy;

/// All three discrepancies of n >= 2 points.
///
/// @param u  [n][d] in [0, 1]    @param result  [CLAST_N_DISCREPANCY]
/// @return CLAST_E_ARGUMENT for n < 2, d outside 1..3, points outside the cube
CLAST_API clast_status clast_discrepancy_test(const double *u, int64_t n, int32_t d,
                                              clast_sums sums, clast_discrepancy *result);

/// Henze and Zirkler's test of normality of the probit scores Phi^-1(u). [HenzeZirkler1990]
typedef struct clast_henze_zirkler {
    double beta, HZ;
    double mean, variance;   ///< of HZ under normality
    double log_mean, log_sd; ///< of log HZ, approximately normal
    double z, p;             ///< upper tail of the standardised log
    double p_paper;          ///< 1 - Phi(log HZ) as printed: not a p-value
    double centre[3];        ///< mean of the scores
    double covariance[3][3]; ///< of the scores, divisor n
} clast_henze_zirkler;

/// Scores are clamped to u in [2^-53, 1 - 2^-53]. A singular covariance gives HZ = 4 n and p = 0.
CLAST_API clast_status clast_henze_zirkler_test(const double *u, int64_t n, int32_t d,
                                                clast_sums sums, clast_henze_zirkler *result);

/// Correlation of each pair of coordinates (01, 02, 12), Student's t, Bonferroni over the pairs.
typedef struct clast_pearson {
    int32_t n_pair;
    double r[3], p[3];
    double p_bonferroni; ///< min(1, n_pair min p); 1 in one dimension
} clast_pearson;

/// @return CLAST_E_ARGUMENT for n < 3. A coordinate without spread has r = 0, p = 1.
CLAST_API clast_status clast_pearson_test(const double *u, int64_t n, int32_t d,
                                          clast_pearson *result);

/// Mean distance to the nearest neighbour, across periodic faces, over that of uniform points: > 1
/// is regular (a lattice: 2 in 2-D, 1.8 in 3-D), < 1 clustered or varying. [ClarkEvans1954]
typedef struct clast_spacing {
    double ratio;
    double z, p; ///< of a uniform cloud's ratio, normal; two-sided p
} clast_spacing;

/// @return CLAST_E_ARGUMENT for n < 5
/// @note O(n log n); beyond 50,000 points the neighbours of a part of them are looked for, which
/// their positions alone decide
CLAST_API clast_status clast_spacing_test(const double *u, int64_t n, int32_t d,
                                          clast_spacing *result);

/// The same of the points that all ranks have together; called by all of them.
///
/// @param comm  NULL: the only rank
CLAST_API clast_status clast_spacing_ranks(const clast_comm *comm, const double *u, int64_t n,
                                           int32_t d, clast_spacing *result);

/// Distance-to-boundary score: mean absolute difference between the distribution of depths and its
/// law.
typedef struct clast_boundary_score {
    double score; ///< integral over [0, 1] of |G_n - H|, exact piecewise     [Martinez2021 eq. 12]
    double ideal; ///< its expectation for n uniform points, closed form
    double trapezoid; ///< over the sorted sample only: the published habit, loses the tails
    double projected; ///< sum over coordinates of the same score with H(x) = x
    double projected_axis[3];
} clast_boundary_score;

/// @param side  [d] side lengths of the box that the cube stands for, > 0
CLAST_API clast_status clast_boundary_score_test(const double *u, int64_t n, int32_t d,
                                                 const double *side, clast_boundary_score *result);

/// Expected score of n uniform points in a box of these sides.             [de Moivre;
/// docs/theory/uniformity.md]
CLAST_API double clast_boundary_score_ideal(double n, int32_t d, const double *side);

// D2SD: cells in which particles are uniform, and agglomeration events that do not depend on a
// mesh. [Martinez2021; docs/theory/decompose.md]

typedef enum {
    CLAST_VARIANT_FULL,  ///< tests before and after every pass
    CLAST_VARIANT_FIRST, ///< "1+2": test first, one pass
    CLAST_VARIANT_FAST,  ///< one pass, no test
    CLAST_VARIANT_TEST ///< the tests alone: one cell, whose events take it as uniform whatever they
                       ///< say
} clast_decompose_variant;

typedef enum {
    CLAST_CELLS_BOXES,
    CLAST_CELLS_COMPONENTS,
    CLAST_CELLS_BINS,
    CLAST_CELLS_LABELS,
    CLAST_CELLS_TREE,
    CLAST_CELLS_AUTO ///< tree for the full variant, boxes for the others and with paper
} clast_cell_kind;

typedef enum {
    CLAST_EVENTS_PAIRS, ///< beta dt n (n - 1) / (2 V): unbiased in a uniform cell
    CLAST_EVENTS_PAPER  ///< beta dt n^2 / V as printed in eq. 14
} clast_event_law;

/// Where bins count as under-populated.
typedef enum {
    CLAST_LOWER_Q20,    ///< up to the 20th percentile, as published
    CLAST_LOWER_SEARCH, ///< up to a threshold in [Q20, Q40) that is searched like the upper one,
                        ///< with that one found
    CLAST_LOWER_JOINT   ///< both thresholds at once: every pair of them is tried
} clast_lower;

/// Which statistic of the discrepancies votes.
typedef enum { CLAST_STATISTIC_A, CLAST_STATISTIC_T } clast_statistic;

typedef enum { CLAST_OUTSIDE_ERROR, CLAST_OUTSIDE_DROP } clast_outside;

typedef struct clast_decompose_config {
    char *domain;    ///< see clast_domain_parse
    int32_t outside; ///< points outside the domain
    int32_t variant, mesh, events;
    double level;          ///< of each test
    int32_t votes;         ///< tests that must reject
    char *tests;           ///< those that vote, by name
    int32_t statistic;     ///< of the discrepancies: A or T
    bool paper;            ///< p-values, score and events as printed, errors included
    int32_t ghost_samples; ///< expected score by so many ghost samples; 0: semi-analytic
    bool crossfit;         ///< events with the cells of one half and the points of the other
    int32_t max_pass;
    int32_t lower;  ///< clast_lower
    bool strict;    ///< bins at a threshold are ambient: > lambda and < lower, as the prose has it
    double beta_dt; ///< kernel times time step [m^d]; 0: not known, events are then the pair
                    ///< integral: events per beta dt [1/m^d], without a cap
    int32_t beta_dt_dimension; ///< d of the unit that it was given in, which shall be that of the
                               ///< points; 0: of a bare number, [m^d] of any
    double tree_level;         ///< of the chi-square test of a tree cell
    double tree_root_level;    ///< of the test of the whole cloud: one cell, or a tree
    double variable_tolerance; ///< standard deviation of cloud->variable that a tree cell may keep
    int32_t tree_least;
    bool tree_refine;    ///< cells below the root are given as the blocks that their last test saw
    bool extrapolate;    ///< add the pairs that tree cells hide by being taken as uniform
    bool pairs;          ///< count pairs by distance too
    double pairs_radius; ///< greatest distance [m]; 0: see clast_pairs_config
    int32_t estimator;   ///< clast_estimator: which estimate `events` is
    uint64_t seed;
} clast_decompose_config;

/// Fields of clast_decompose_config: keys, defaults, ranges and units; ends with a row of zeros.
extern CLAST_API const clast_field clast_decompose_fields[];

/// Whether cells are those of the uniformity tree, which needs no vote, not joined bins; no of
/// NULL.
CLAST_API bool clast_decompose_takes_tree(const clast_decompose_config *config);

/// The fields, and the options `sizes`, `regular` and `variable_column` of `clast decompose`, that
/// a decomposition by the others does not look at (clast_fields_idle). NULL of a NULL.
///
/// @param has_variable  whether the points carry one
/// @param n_size        of clast_decompose_sizes, 0: no such table
CLAST_API const clast_idle *clast_decompose_idle(const clast_decompose_config *config,
                                                 bool has_variable, int32_t n_size,
                                                 clast_idle rules[CLAST_N_IDLE]);

enum { CLAST_N_TEST = 5, CLAST_MAX_PASS = 64 };

/// One of the five tests.
typedef struct clast_vote {
    const char *name;    ///< "symmetric", "centred", "star", "henze_zirkler", "pearson"
    double statistic, p; ///< pearson: r of the pair of axes with the least p, and that p, corrected
                         ///< for the number of pairs
    bool reject;
    int32_t axis[2]; ///< that pair; {-1, -1} for the other tests
} clast_vote;

/// All five, with the vote. n < 5: nothing is tested and nothing rejects.
typedef struct clast_uniformity {
    int32_t n_test; ///< 5; 4 in one dimension (no pair to correlate); 0 for n < 5
    clast_vote vote[CLAST_N_TEST];
    int32_t n_reject;
    bool reject;
    double score, ideal; ///< score by trapezoids over the sample with paper
} clast_uniformity;

/// How the tests vote. {0} with level and votes set: all five, standardised.
typedef struct clast_uniformity_config {
    double level;
    int32_t votes;
    uint32_t left_out; ///< bit k: test k of the list of clast_vote neither runs nor votes
    bool liang;        ///< discrepancies vote with Liang's T instead of A
    bool paper;        ///< p as printed: 1 - Phi(|A|), 1 - Phi(log HZ), no correction for pairs
} clast_uniformity_config;

/// Bits of left_out for a list of the tests that shall vote, "centred,pearson".
///
/// @return CLAST_E_CONFIG names the unknown test and the known ones
CLAST_API clast_status clast_uniformity_choose(const char *tests, uint32_t *left_out);

/// @param u  [n][d] in the unit cube    @param side  [3] for the score
CLAST_API clast_status clast_uniformity_test(const double *u, int64_t n, int32_t d,
                                             const double side[3],
                                             const clast_uniformity_config *config,
                                             clast_uniformity *result);

typedef struct clast_pass {
    int32_t nb[3];
    int32_t n_lambda;     ///< thresholds searched
    int32_t lambda_count; ///< best threshold as a count
    double lambda;        ///< as a density: count * bins / n
    int32_t n_lower;      ///< lower thresholds searched
    double lower;         ///< lower threshold as a density
    double score;         ///< expected over ghosts
    double ideal;         ///< for the size of the synthetic sample
    bool fallback;
} clast_pass;

/// How a decomposition ended.
typedef enum {
    CLAST_STOP_UNTESTED, ///< fewer than 5 points: one cell
    CLAST_STOP_ACCEPTED, ///< the vote accepts the cloud: one cell
    CLAST_STOP_TESTED,   ///< the vote rejects, and the variant is the tests alone: one cell
    CLAST_STOP_UNIFORM,  ///< the vote accepts what the passes left
    CLAST_STOP_NOTHING,  ///< no threshold is left, or nothing new is selected
    CLAST_STOP_ONE_PASS, ///< the variant makes one
    CLAST_STOP_MAX_PASS, ///< the vote still rejects after max_pass
    CLAST_STOP_SPLIT,    ///< the vote rejects; tree cells are uniform or too small to be tested
    CLAST_STOP_TREE,     ///< the vote accepts; the tree's own test or the variable split the cloud
    CLAST_STOP_WHOLE,    ///< the vote rejects at level, the tree does not at tree_root_level
    CLAST_STOP_DEPTH,    ///< a tree cell is non-uniform at the limit of 20 halvings
    CLAST_STOP_SPARED    ///< a workspace's policy spares the tests: the tree alone decided
} clast_decompose_stop;

/// A stop in words, "rejected by the tests and split".
CLAST_API const char *clast_decompose_stop_text(clast_decompose_stop stop);

/// Cells. A box [low, high] is in the domain's coordinates for a box or a mesh domain (there not
/// cut), in the unit cube for mapped domains; components and labels give their bounding box. In a
/// mesh domain cells without volume inside are left out.
typedef struct clast_cells {
    int32_t n;
    double (*low)[3];      ///< [n][3]
    double (*high)[3];     ///< [n][3]
    double *volume;        ///< [n] m^d
    int64_t *count;        ///< [n] real points
    uint8_t *label, *pass; ///< [n] 0..7 and 1.. (0: ambient); 0 without meaning where nothing is
                           ///< labelled: clast_cells_are_labelled
    double *weight;        ///< [n] sum of the points' weights: count without weights
    double *events;        ///< [n] after the cap; with extrapolate all by one factor [1/m^d without
                           ///< beta_dt]
    int32_t *of_point;     ///< [n_point] cell of each point, -1 for points left out
    bool is_box;           ///< cells are boxes low .. high, not unions of bins
    int32_t nb[3];         ///< bins an axis
    int32_t *bin_count;    ///< [nb[0] nb[1] nb[2]] tested points, or NULL
    int32_t *of_bin;       ///< [nb[0] nb[1] nb[2]] cell of each bin of the unit cube, -1 outside a
                           ///< mesh domain; NULL: no bins
    uint64_t *key;         ///< [n] Morton code of a tree cell's low corner, ascending, or NULL
    int32_t *group;        ///< [n] of tree cells, or NULL: >= 0 halves of one box share a number;
                           ///< -1 found uniform; -2, -3 .. too few points to be tested
} clast_cells;

/// What pairs show within the cells, whose points the cells take as uniform.
typedef struct clast_within_cells {
    bool is_structured; ///< pairs closer than half a cell are more than uniform cells would hold
    double cell;        ///< edge of a cell, V^(1/d), mean over the pairs in cells [m]
    double even;        ///< pair integral of uniform cells, sum n (n - 1) / (2 V), no cap, nothing
                        ///< extrapolated: what a kernel with a g(r) of its own multiplies [1/m^d]
    double radius;  ///< least distance with 10 pairs within it: below, the points say nothing [m]
    int64_t n_pair; ///< closer than that
    double g, g_low, g_high; ///< those over what uniform cells would hold, with the 95 % interval
    double length;           ///< structure is seen up to there [m]; 0: none
} clast_within_cells;

typedef struct clast_decomposition {
    int64_t n, n_outside; ///< points used and left out
    int64_t n_here; ///< of cells.of_point: n + n_outside, with several ranks the points of this one
    int64_t n_test; ///< points tested: n, fewer when weights thin them out, more by the ghosts that
                    ///< fill the box of a mesh domain
    int32_t dimension;
    int32_t n_capped; ///< cells at n/2
    clast_uniformity before;
    int32_t n_pass;
    clast_pass pass[CLAST_MAX_PASS];
    clast_decompose_stop stop;
    clast_cells cells;
    double events, events_low,
        events_high;       ///< with the 95 % interval of Poisson points, which ends at the cap; not
                           ///< resolved: events_low alone holds (NAN where repeated points leave no
                           ///< bound), and events_high is INFINITY
    double points_needed;  ///< so many would resolve it, about; n where it is resolved; INFINITY
                           ///< where that cannot be determined
    double events_cross;   ///< with crossfit: free of the bias of choosing cells by their counts;
                           ///< else NAN
    double points_per_bin; ///< below 10 the published estimate is biased
    clast_table search;    ///< every threshold searched: pass, lambda, lower, score, ideal_score,
                           ///< is_lower_search
    double cells_bias;     ///< relative bias of the pairs counted in these cells against those that
                           ///< all sizes of cells show together; NAN where not resolved
    double bias_estimate;  ///< cells / n: relative bias of n^2 against n (n - 1); NAN of n (n - 1)
    double
        smoothing_bias; ///< relative bias of pairs in cells taken as uniform, as estimated; taken
                        ///< off events and all cells' events. 0 where nothing is extrapolated
    double beta_dt;     ///< as asked for; 0: events are the pair integral [1/m^d]
    double volume;      ///< of the domain [m^d]
    uint64_t seed;      ///< of what was drawn
    clast_pairs pairs;  ///< with config->pairs or the estimator pairs, else {0}
    clast_estimate events_by_cells, events_by_pairs; ///< the same of both, beta dt n (n - 1) / 2
                                                     ///< times the integral; with pairs
    clast_estimator estimator;                       ///< of the two: which one `events` is
    clast_within_cells within;                       ///< with pairs, else {0}
    bool disagree; ///< both are resolved and their intervals have no number in common
    bool resolved; ///< the points show all of their own structure that counts: the bias of events
                   ///< is at most 2 %
    bool keeps_apart; ///< points keep apart (seeded, stratified, a lattice), so that small cells
                      ///< say nothing of their density: not resolved by any number of them
    bool has_drawn;   ///< ghosts, or the part of weighted points that is tested
} clast_decomposition;

/// Splits the cloud's domain into cells of uniform concentration and counts events.
///
/// @return CLAST_E_FORMAT when points are not finite, or lie outside (with their number) unless
/// config->outside is CLAST_OUTSIDE_DROP
/// @note O(n log n); bytes do not depend on threads
CLAST_API clast_status clast_decompose(const clast_cloud *cloud,
                                       const clast_decompose_config *config,
                                       clast_decomposition *result);

/// The same in a ready domain, which config->domain then only names in messages (may be NULL): the
/// way for a closed surface or the caller's own map.
CLAST_API clast_status clast_decompose_in(const clast_domain *domain, const clast_cloud *cloud,
                                          const clast_decompose_config *config,
                                          clast_decomposition *result);

/// The same of one cloud of which each rank has a part; points stay where they are. Called by all
/// ranks with the same domain and configuration. Cells, tests, events and all numbers are those of
/// all points together, on every rank, and the same bytes for any number of ranks, any first
/// distribution and any order of the points; cells.of_point [cloud->n] is of the points here. A
/// rank may have none. [docs/theory/cloud-ranks.md]
///
/// @param comm   of clast_mpi_create; NULL: the only rank
/// @param cloud  the points of this rank
/// @return CLAST_E_ARGUMENT where points of some ranks have weights, or a variable, and of others
/// none. The status is the same on every rank, and an error names the rank; a point's number in it
/// counts the points of all ranks, those of rank 0 first
/// @note of 10^7 points on two ranks some 200 bytes a point of its own, on rank 0 twice that
CLAST_API clast_status clast_decompose_ranks(const clast_comm *comm, const clast_domain *domain,
                                             const clast_cloud *cloud,
                                             const clast_decompose_config *config,
                                             clast_decomposition *result);

/// What clast_decompose_sizes makes.
typedef struct clast_decompose_parts {
    int32_t n_size;  ///< parts, 1 to 40; the smallest has 5 points at least
    int32_t regular; ///< a regular mesh of so many cells an axis beside, to 200; 0: none
} clast_decompose_parts;

/// Events against the number of points: random parts of n, n/2, n/4, ... points of a cloud without
/// weights and variable, decomposed each by itself. Of several ranks each gives its points, as to
/// clast_decompose_ranks; a hash of the seed and of the positions draws the parts, so they are the
/// same for any ranks and any order of the points.
///
/// @param comm   of clast_mpi_create; NULL: the only rank
/// @param table  out, a row a part, smallest first: n, events, events_low, events_high, n_cell,
/// and the events scaled to the pairs of all points, scaled_...; with a regular mesh regular_events
/// and scaled_regular. Without beta dt they are pair_integral, ... [1/m^d]
/// @return CLAST_E_CONFIG for counts out of range, weights or a variable, a regular mesh in a mesh
/// domain; what clast_decompose_ranks returns
/// @note on each rank some 70 bytes a point, and 8 a cell of the regular mesh, beside the
/// decomposition
CLAST_API clast_status clast_decompose_sizes(const clast_comm *comm, const clast_domain *domain,
                                             const clast_cloud *cloud,
                                             const clast_decompose_parts *sizes,
                                             const clast_decompose_config *config,
                                             clast_table *table);

/// Whether label and pass mean something: of bins, not of a tree or a single cell.
CLAST_API bool clast_cells_are_labelled(const clast_cells *cells);

/// Cell of a point, -1 outside the domain; O(1) in bins, O(log n) in a tree.
CLAST_API int32_t clast_cells_locate(const clast_cells *cells, const clast_domain *domain,
                                     const double *x);
CLAST_API void clast_decomposition_free(clast_decomposition *result);

enum { CLAST_N_DECOMPOSITION_NOTE = 3 };

/// What to say of a decomposition (but for the tests alone, whose one cell says nothing of events):
/// 0, pairs by distance that disagree with the cells or are those of no density; 1, why there is no
/// number of events (events_low is NaN); 2, too few points a bin.
///
/// @param n_repeated  duplicate (coincident) points (clast_cloud_repeated)
/// @param k           of CLAST_N_DECOMPOSITION_NOTE    @param text  [size], 256 suffice
/// @return text; "" where there is nothing to say
CLAST_API const char *clast_decomposition_note(const clast_decomposition *result,
                                               int64_t n_repeated, int32_t k, size_t size,
                                               char *text);

// A decomposition for ParaView.

/// Cells as an unstructured grid (VTU): lines, quadrilaterals or hexahedra with cell, count,
/// volume, density and events (pair_integral without beta dt), label and pass where cells have
/// them; unit, domain, volume, beta_dt and seed (of what was drawn) as field data. Cells that are
/// no boxes (components, labels) are written bin by bin; cells of mapped domains are cut at most
/// every 10 degrees.
///
/// @return CLAST_E_LIMIT beyond 2^31 corners; CLAST_E_DISK
CLAST_API clast_status clast_cells_write_vtu(const clast_decomposition *result,
                                             const clast_domain *domain, const char *path);

/// Points as polydata (VTP) with cell (label and pass) and the same field data, and radius, mass,
/// weight and velocity where the cloud has them; -1 and 0 for points left out.
CLAST_API clast_status clast_decomposition_write_points(const clast_decomposition *result,
                                                        const clast_cloud *cloud,
                                                        const clast_domain *domain,
                                                        const char *path);

CLAST_END
