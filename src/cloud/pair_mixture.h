#pragma once
// Mixtures of shapes of the autocorrelation A(r), fitted to edge-corrected numbers of pairs in
// shells of distance. [docs/theory/pairs.md section 4]
#include "cloud/pair_integral.h"

enum {
    CLX_MOST_SHAPE = 81,
    CLX_MIXTURE_PAIRS = 10 ///< within twice the narrowest width that is looked at
};

/// What stands beside each Gaussian exp(-r^2 / (4 s^2)): nothing, exp(-r / (2 s)),
/// exp(-sqrt(r / (3 s))), that of layers of thickness s in all directions.
typedef enum clx_shape_family {
    CLX_FAMILY_SMOOTH,
    CLX_FAMILY_KINKED,
    CLX_FAMILY_POLED,
    CLX_FAMILY_LAYERED
} clx_shape_family;

/// The shapes, in the order of levels: shape 0 is uniform, a level has its companion and its
/// Gaussian.
typedef struct clx_mixture_fit {
    const clx_pair_shells *in;
    clx_shape_family family;
    int32_t n_shape;                               ///< 1 + n_level, or 1 + 2 n_level
    int32_t n_level;                               ///< widths below the uniform shape
    bool has_sixths;                               ///< shells are sixths of an octave
    double s[CLX_MOST_SHAPE];                      ///< of each level, descending, first INFINITY
    double mass[CLX_MOST_SHAPE][CLAST_MAX_SHELL];  ///< pairs in each shell for c = 1
    double shell[CLAST_MAX_SHELL][CLX_MOST_SHAPE]; ///< the same, a shell's side by side
    double total[CLX_MOST_SHAPE];                  ///< pairs in all shells
    double scale;                                  ///< of edge-corrected pairs in Poisson numbers
    double pairs[CLAST_MAX_SHELL];                 ///< divided by it
} clx_mixture_fit;

/// Coefficients, the Poisson log-likelihood and A(0), their sum.
typedef struct clx_mixture {
    double c[CLX_MOST_SHAPE];
    double likelihood, integral;
} clx_mixture;

/// The shapes of all levels, from eight times the greatest distance down to half of that within
/// which CLX_MIXTURE_PAIRS lie, all widths times `stretch`.
void clx_mixture_prepare(const clx_pair_shells *in, clx_shape_family family, double stretch,
                         clx_mixture_fit *f);

/// Shapes of a level and all wider ones.
int32_t clx_mixture_shapes(const clx_mixture_fit *f, int32_t level);

/// Numbers of pairs that a mixture expects. mean [CLAST_MAX_SHELL]
void clx_mixture_expect(const clx_mixture_fit *f, int32_t n_shape, const double *c, double *mean);

/// How these numbers change with the logarithm of a factor on all widths. slope [CLAST_MAX_SHELL]
void clx_mixture_slope(const clx_mixture_fit *f, int32_t n_shape, const double *c, double *slope);

/// Greatest Poisson log-likelihood less tilt times the integral, c >= 0.
clx_mixture clx_mixture_best(const clx_mixture_fit *f, int32_t n_shape, double tilt);

/// Solves a x = b, a symmetric and positive definite [n][n], by Cholesky; a is lost, b becomes x.
void clx_mixture_solve(double *a, int32_t n, double *b);
