// The five tests of step 1 and their vote.
#include "cloud/uniformity.h"

#include "base/alloc.h"
#include "cloud/boundary_score.h"

static void cast(clast_uniformity *r, const char *name, double statistic, double p, double level)
{
    r->vote[r->n_test] = (clast_vote){name, statistic, p, p < level};
    r->n_reject += p < level ? 1 : 0;
    ++r->n_test;
}

/// The discrepancies and the correlation, which cost little beside Henze and Zirkler's test.
static clast_status cast_cheap(const double *u, int64_t n, int32_t d, double level,
                               clast_uniformity *r, clast_vote *pearson_vote)
{
    clast_status status = CLAST_OK;
    clast_discrepancy discrepancy[CLAST_N_DISCREPANCY];
    clast_pearson pearson;
    CLX_TRY(clast_discrepancy_test(u, n, d, CLAST_SUMS_AUTO, discrepancy));
    CLX_TRY(clast_pearson_test(u, n, d, &pearson));
    cast(r, "symmetric", discrepancy[0].A_standard, discrepancy[0].p, level);
    cast(r, "centred", discrepancy[1].A_standard, discrepancy[1].p, level);
    cast(r, "star", discrepancy[2].A_standard, discrepancy[2].p, level);
    *pearson_vote = (clast_vote){"pearson", pearson.r[0], pearson.p_bonferroni,
                                 d > 1 && pearson.p_bonferroni < level};
done:
    return status;
}

clast_status clx_uniformity_decide(const double *u, int64_t n, int32_t d, double level,
                                   int32_t votes, bool *reject)
{
    clast_status status = CLAST_OK;
    clast_uniformity made = {0};
    clast_vote pearson = {0};
    int32_t n_reject = 0;
    if (n >= 5) {
        CLX_TRY(cast_cheap(u, n, d, level, &made, &pearson));
        n_reject = made.n_reject + (pearson.reject ? 1 : 0);
        if (n_reject == votes - 1) { // only now does the last test matter
            clast_henze_zirkler hz;
            CLX_TRY(clast_henze_zirkler_test(u, n, d, CLAST_SUMS_AUTO, &hz));
            n_reject += hz.p < level ? 1 : 0;
        }
    }
    *reject = n >= 5 && n_reject >= votes;
done:
    return status;
}

// The five arguments of a sample and the two of a decision stand in the published order.
// NOLINTNEXTLINE(readability-function-size)
clast_status clast_uniformity_test(const double *u, int64_t n, int32_t d, const double side[3],
                                   double level, int32_t votes, clast_uniformity *result)
{
    clast_status status = CLAST_OK;
    clast_uniformity made = {0};
    double *depth = NULL;
    if (n >= 1) {
        const clx_depth_law law = clx_depth_law_of_box(d, side);
        CLX_TRY(clx_boundary_depths(&law, u, n, &depth));
        made.score = clx_depth_distance(&law, depth, n);
        made.ideal = clx_depth_ideal(&law, (double)n);
        clx_free(depth);
        depth = NULL;
    }
    if (n >= 5) {
        clast_henze_zirkler hz;
        clast_vote pearson;
        CLX_TRY(cast_cheap(u, n, d, level, &made, &pearson));
        CLX_TRY(clast_henze_zirkler_test(u, n, d, CLAST_SUMS_AUTO, &hz));
        cast(&made, "henze_zirkler", hz.HZ, hz.p, level);
        if (d > 1) {
            cast(&made, pearson.name, pearson.statistic, pearson.p, level);
        }
        made.reject = made.n_reject >= votes;
    }
    *result = made;
done:
    clx_free(depth);
    return status;
}
