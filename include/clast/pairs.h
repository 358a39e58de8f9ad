#pragma once
#include <clast/field.h>
#include <clast/table.h>

CLAST_BEGIN

// Pairs of points by their distance: the pair correlation g(r), and from it the integral of the
// squared density that pair events are proportional to. [docs/theory/pairs.md]

typedef struct clast_pairs_config {
    double radius;   ///< greatest distance [m]; 0: three mean spacings, less in a dense cloud
    int32_t n_shell; ///< shells of distance, 1 to CLAST_MAX_SHELL
    int32_t outside; ///< clast_outside: points outside the domain
} clast_pairs_config;

enum { CLAST_MAX_SHELL = 64 };

/// Fields of the configuration of pairs: keys, defaults, ranges and units; ends with a row of
/// zeros.
extern CLAST_API const clast_field clast_pairs_fields[];

/// A number with its 95 % interval.
typedef struct clast_estimate {
    double value, low, high;
    bool resolved; ///< else `low` alone holds, and high is INFINITY
} clast_estimate;

/// Integral of f^2 over the domain, f the probability density of a point [1/m^d]: of n points
/// drawn from f, n (n - 1) / 2 times it is the expected number of pairs per volume of encounter.
typedef struct clast_pair_integral {
    clast_estimate estimate; ///< for the density f that the points were drawn from, n given; low is
                             ///< NAN where repeated points make up too many of the pairs
    double scale;    ///< narrowest structure that the pairs show, as a standard deviation [m]:
                     ///< INFINITY where they look uniform up to the greatest distance
    double window;   ///< greatest distance of the pairs that decide it [m]
    int64_t n_pair;  ///< pairs within that window
    double n_needed; ///< points that would resolve it; n where it is resolved
    double fit_p;    ///< chi-square p of the fitted shape: small where points avoid each other
} clast_pair_integral;

typedef struct clast_pairs {
    int64_t n, n_outside; ///< points used and left out
    int32_t dimension, n_shell;
    double volume;      ///< of the domain [m^d]
    double radius;      ///< greatest distance [m]
    int64_t n_pair;     ///< pairs closer than it
    int64_t n_repeated; ///< pairs at the distance 0
    double edge_error;  ///< greatest relative standard error of `expected`: 0 in closed form
    clast_table shells; ///< r_low_m, r_high_m, pairs, pairs_within, expected (of a uniform cloud),
                        ///< g, g_low, g_high (95 %); integral, integral_low, integral_high from
                        ///< the pairs within r_high_m as they are, 95 % of their sampling error
    clast_pair_integral integral;
} clast_pairs;

/// Counts the pairs of a cloud by their distance in shells of equal ratio, compares them with those
/// of a uniform cloud in the same domain, and estimates the integral of the squared density.
///
///     g(r) = pairs in the shell / (n (n - 1) / 2 * P(shell)),
///     P(shell) = integral over it of S_d r^(d-1) c(r) / V^2 dr
///
/// c is the domain's set covariance averaged over directions: closed form for boxes and spheres,
/// quadrature to 1e-12 for long distances in boxes and for cylinders, quasi-Monte Carlo chords for
/// half pipes and closed surfaces, pairs of points for far ones of slender bodies, points for a
/// caller's map (edge_error says how well).
///
/// @return CLAST_E_CONFIG for points with weights; CLAST_E_FORMAT for coordinates that are not
/// finite, or points outside with CLAST_OUTSIDE_ERROR; CLAST_E_LIMIT for fewer than 2 points
/// @note O(n + pairs); the same bytes for any number of threads
CLAST_API clast_status clast_pairs_count(const clast_domain *domain, const clast_cloud *cloud,
                                         const clast_pairs_config *config, clast_pairs *pairs);
CLAST_API void clast_pairs_free(clast_pairs *pairs);

/// Probability that two points, uniform in the domain, are closer than each radius: rises from 0 to
/// 1, which it is from the diameter on.
///
/// @param radius  [n] > 0, ascending [m]
/// @param share   [n] out
/// @param error   [n] out, its standard error (0 in closed form), or NULL
/// @return CLAST_E_ARGUMENT for radii that do not ascend from above 0, or a domain without a volume
CLAST_API clast_status clast_pairs_uniform(const clast_domain *domain, int32_t n,
                                           const double *radius, double *share, double *error);

/// Which estimate of the integral counts.
typedef enum {
    CLAST_ESTIMATOR_CELLS,
    CLAST_ESTIMATOR_PAIRS,
    CLAST_ESTIMATOR_AUTO ///< the cells' one where it is resolved, else the pairs' one
} clast_estimator;

/// One of two estimates of the same integral; NAN where one is NULL.
///
/// @param disagree  whether both are resolved and their intervals have no number in common, or
/// NULL
CLAST_API clast_estimate clast_estimate_choose(const clast_estimate *cells,
                                               const clast_estimate *pairs,
                                               clast_estimator estimator, bool *disagree);

CLAST_END
