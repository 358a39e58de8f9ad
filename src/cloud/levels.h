#pragma once
// Thresholds and labels of bins by their counts. [docs/theory/decompose.md]
#include "base/status.h"

enum { CLX_LABEL_AMBIENT = 0, CLX_LABEL_UNDER = 6, CLX_LABEL_VOID = 7, CLX_N_LABEL = 8 };

/// Percentiles of the counts of active bins and the thresholds to search.
typedef struct clx_levels {
    double q20;      ///< over all active bins
    double q60, q80; ///< over active bins that are not empty
    int32_t n_lambda;
    int32_t *lambda; ///< [n_lambda] ascending: the distinct counts in (q60, q80]
    bool fallback;   ///< no count there: the smallest count above q60 was taken, if any
    int32_t n_lower;
    int32_t *lower; ///< [n_lower] ascending: the distinct counts in [Q20, Q40) of the bins that are
                    ///< not empty, or else the greatest count below Q40, if any
} clx_levels;

/// What separates under, ambient and cluster bins.
typedef struct clx_label_cut {
    int32_t lambda;
    double under;   ///< Q20, or a lower threshold
    bool is_strict; ///< counts equal to a threshold are ambient
} clx_label_cut;

/// @param active  [n_bin] bins not selected in an earlier pass, or NULL for all
/// @note n_lambda = 0 when no active bin holds more than q60
clast_status clx_levels_find(const int32_t *count, const uint8_t *active, int64_t n_bin,
                             clx_levels *levels);
void clx_levels_free(clx_levels *levels);

/// label [n_bin]: 1..5 for counts >= lambda, cut at the distinct 20/40/60/80 % of those counts; 6
/// for 0 < count <= under; 7 for 0; 0 else, and for bins that are not active. Strict: > and <.
clast_status clx_levels_label(const int32_t *count, const uint8_t *active, int64_t n_bin,
                              const clx_label_cut *at, uint8_t *label);
