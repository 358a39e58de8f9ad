// The five tests of step 1 and their vote.
#include <clast/decompose.h>

#include "base/status.h"

static void cast(clast_uniformity *r, const char *name, double statistic, double p, double level)
{
    r->vote[r->n_test] = (clast_vote){name, statistic, p, p < level};
    r->n_reject += p < level ? 1 : 0;
    ++r->n_test;
}

// The five arguments of a sample and the two of a decision stand in the published order.
// NOLINTNEXTLINE(readability-function-size)
clast_status clast_uniformity_test(const double *u, int64_t n, int32_t d, const double side[3],
                                   double level, int32_t votes, clast_uniformity *result)
{
    clast_status status = CLAST_OK;
    clast_uniformity made = {0};
    clast_boundary_score score = {0};
    if (n >= 1) {
        CLX_TRY(clast_boundary_score_test(u, n, d, side, &score));
    }
    made.score = score.score;
    made.ideal = score.ideal;
    if (n >= 5) {
        clast_discrepancy discrepancy[CLAST_N_DISCREPANCY];
        clast_henze_zirkler hz;
        clast_pearson pearson;
        CLX_TRY(clast_discrepancy_test(u, n, d, CLAST_SUMS_AUTO, discrepancy));
        CLX_TRY(clast_henze_zirkler_test(u, n, d, CLAST_SUMS_AUTO, &hz));
        CLX_TRY(clast_pearson_test(u, n, d, &pearson));
        cast(&made, "symmetric", discrepancy[0].A_standard, discrepancy[0].p, level);
        cast(&made, "centred", discrepancy[1].A_standard, discrepancy[1].p, level);
        cast(&made, "star", discrepancy[2].A_standard, discrepancy[2].p, level);
        cast(&made, "henze_zirkler", hz.HZ, hz.p, level);
        if (d > 1) {
            cast(&made, "pearson", pearson.r[0], pearson.p_bonferroni, level);
        }
        made.reject = made.n_reject >= votes;
    }
    *result = made;
done:
    return status;
}
