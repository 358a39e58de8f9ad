#pragma once
// Parts of a fit: packings, grown nodes, weights.
#include <clast/aggregate_run.h>

enum { CLX_FIT_N_MODEL = CLAST_FIT_N_OBSERVABLE + 1, CLX_FIT_POROSITY = CLAST_FIT_N_OBSERVABLE };

/// How hard particles search for a near place.
typedef struct clx_fit_packing {
    double cone;
    int32_t rays, orientations;
} clx_fit_packing;

/// One packing at one N_A.
typedef struct clx_fit_node {
    int32_t level, replicate;
    int32_t n_run; ///< aggregates grown; 0: interpolated
    double mean[CLX_FIT_N_MODEL];
    double deviation[CLX_FIT_N_MODEL];
    double chi2, weight;
    bool is_inside; ///< every observed quantity is met within its error
} clx_fit_node;

typedef struct clx_fit {
    const clast_aggregate_config *config;
    const clast_aggregate_input *input;
    const clast_monitor *monitor;
    int32_t n_level;
    clx_fit_packing *packing; ///< [n_level] loose to tight
    int32_t n_node;
    clx_fit_node *node; ///< [n_node] grown ones first come; sorted by level and N_A at the end
    int64_t node_capacity;
    double observed[CLAST_FIT_N_OBSERVABLE], error[CLAST_FIT_N_OBSERVABLE];
    int32_t n_run;
    int32_t n_run_before; ///< aggregates grown before the packing at hand
    int32_t n_tried;      ///< packings grown
} clx_fit;

void clx_fit_free(clx_fit *fit);

/// Packings of config->fit_packing, "cone:rays:orientations" each, or the built-in path.
clast_status clx_fit_packings(clx_fit *fit);

/// Grows all that the search asks for.
clast_status clx_fit_grow(clx_fit *fit);

/// Fills in between the grown nodes, weighs all, and says what came out.
clast_status clx_fit_weigh(clx_fit *fit, clast_aggregate_fit *result);

/// Verdict, p-value and the outcome in words, from what the result holds by then.
void clx_fit_judge(const clx_fit *fit, clast_aggregate_fit *result);

/// Sets chi2 of every node from the scatter of all grown so far.
void clx_fit_set_chi2(clx_fit *fit);
