#pragma once
#include <clast/status.h>

CLAST_BEGIN

// How form varies from grain to grain: flatness and elongation as independent normal variables cut
// to a range.                                [docs/theory/grading.md; Rettinger2022 section 7.1]

typedef struct clast_form_law {
    double flatness_mean, flatness_deviation;     ///< of the normal law before it is cut
    double elongation_mean, elongation_deviation; ///< a deviation of 0: all grains alike
    double low, high;                             ///< both in (0, 1]; 0.1 and 1 in the paper
} clast_form_law;

/// The paper's Rhine gravel: flatness 0.647 and 0.175, elongation 0.682 and 0.139, cut to 0.1 .. 1.
///                                                                        [Rettinger2022 table 2]
CLAST_API clast_form_law clast_form_law_rhine(void);

/// @return CLAST_E_CONFIG for numbers that are not finite, deviations below 0, a range that is not
///         0 < low <= high <= 1, a mean outside of it with deviation 0, or a range that holds less
///         than 1e-6 of a law
CLAST_API clast_status clast_form_law_check(const clast_form_law *law);

/// Flatness S/I and elongation I/L of grain `index`: a function of (law, seed, index) alone.
///
/// Values outside the range are redrawn in the paper; here the cut law's inverse distribution is
/// taken, which is the same law by one number each.    @param law  passes clast_form_law_check
CLAST_API void clast_form_law_draw(const clast_form_law *law, uint64_t seed, uint64_t index,
                                   double *flatness, double *elongation);

/// Means and deviations after the cut, in closed form: what a packing really holds.
typedef struct clast_form_law_moments {
    double flatness_mean, flatness_deviation;
    double elongation_mean, elongation_deviation;
} clast_form_law_moments;

CLAST_API clast_form_law_moments clast_form_law_cut(const clast_form_law *law);

CLAST_END
