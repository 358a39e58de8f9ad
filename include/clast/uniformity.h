#pragma once
#include <clast/machine.h>

CLAST_BEGIN

// Is a set of points uniform in the unit interval, square or cube? Five tests, each callable alone.
// Points are u [n][d], d = 1, 2 or 3, every coordinate in [0, 1]; a domain is mapped to the cube
// first (clast/domain.h). [Martinez2021 sec. 2; docs/theory/uniformity.md]

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
/// is more even than uniform (a lattice: 2 in 2-D, 1.8 in 3-D), < 1 less even. [ClarkEvans1954]
typedef struct clast_spacing {
    double ratio;
    double z, p; ///< of a uniform cloud's ratio, normal; two-sided p
} clast_spacing;

/// @return CLAST_E_ARGUMENT for n < 5
/// @note O(n log n); beyond 50,000 points the neighbours of a part of them are looked for, which
/// their places alone decide
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

CLAST_END
