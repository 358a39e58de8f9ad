// The five tests of step 1 and their vote.
#include "cloud/uniformity.h"

#include "base/alloc.h"
#include "base/field.h"
#include "cloud/boundary_score.h"
#include "cloud/contract.h"

#include <math.h>
#include <string.h>

enum { HENZE_ZIRKLER = 3, PEARSON = 4 };
static const char *const names[CLAST_N_TEST] = {"symmetric", "centred", "star", "henze_zirkler",
                                                "pearson"};

clast_status clast_uniformity_choose(const char *tests, uint32_t *left_out)
{
    CLX_ARGUMENTS(tests, left_out);
    uint32_t chosen = 0;
    const char *at = tests;
    if (tests == NULL || left_out == NULL) {
        return clx_fail(CLAST_E_ARGUMENT, "clast_uniformity_choose: %s is NULL",
                        tests == NULL ? "tests" : "left_out");
    }
    while (*at != '\0') {
        const size_t length = strcspn(at, ",");
        int k = 0;
        while (k < CLAST_N_TEST &&
               (strlen(names[k]) != length || strncmp(names[k], at, length) != 0)) {
            ++k;
        }
        if (k == CLAST_N_TEST) {
            return clx_fail(CLAST_E_CONFIG,
                            "test '%.*s' is not known; there are symmetric, centred, star, "
                            "henze_zirkler, pearson",
                            (int)length, at);
        }
        chosen |= 1U << k;
        at += at[length] == ',' ? length + 1 : length;
    }
    if (chosen == 0) {
        return clx_fail(CLAST_E_CONFIG, "no test is left to vote");
    }
    *left_out = ~chosen & ((1U << CLAST_N_TEST) - 1U);
    return CLAST_OK;
}

static bool votes(const clast_uniformity_config *config, int test)
{
    return (config->left_out >> test & 1U) == 0;
}

int32_t clx_uniformity_votes(int32_t asked, int32_t n_test)
{
    return asked == 2 && n_test == 1 ? 1 : asked;
}

/// Tests that vote on points of dimension d: Pearson's needs a pair of axes.
static int32_t count_tests(const clast_uniformity_config *config, int32_t d)
{
    int32_t n = 0;
    for (int k = 0; k < CLAST_N_TEST; ++k) {
        n += votes(config, k) && (k != PEARSON || d > 1) ? 1 : 0;
    }
    return n;
}

static int32_t needed_votes(const clast_uniformity_config *config, int32_t d)
{
    return clx_uniformity_votes(config->votes, count_tests(config, d));
}

clast_status clx_uniformity_reachable(const clast_uniformity_config *config, int32_t d)
{
    clast_status status = CLAST_OK;
    const int32_t n = count_tests(config, d);
    CLX_CHECK(n > 0, CLAST_E_CONFIG, "tests: none of those chosen looks at one dimension");
    CLX_CHECK(needed_votes(config, d) <= n, CLAST_E_CONFIG,
              "votes: %d tests must reject, but %d vote%s: they never could; lower votes or choose "
              "more tests",
              config->votes, n, n == 1 ? "s" : "");
done:
    return status;
}

static void cast(clast_uniformity *r, int test, double statistic, double p,
                 const clast_uniformity_config *config)
{
    if (votes(config, test)) {
        r->vote[r->n_test] = (clast_vote){names[test], statistic, p, p < config->level, {-1, -1}};
        r->n_reject += p < config->level ? 1 : 0;
        ++r->n_test;
    }
}

static clast_status cast_discrepancies(const clx_part *part, const clast_uniformity_config *config,
                                       clast_uniformity *r)
{
    clast_status status = CLAST_OK;
    clast_discrepancy found[CLAST_N_DISCREPANCY];
    if (!votes(config, 0) && !votes(config, 1) && !votes(config, 2)) {
        return CLAST_OK;
    }
    CLX_TRY(clx_discrepancy_test(part, CLAST_SUMS_AUTO, found));
    for (int k = 0; k < CLAST_N_DISCREPANCY; ++k) {
        const double p = config->liang   ? found[k].p_T
                         : config->paper ? found[k].p_paper
                                         : found[k].p;
        const double statistic = config->liang   ? found[k].T
                                 : config->paper ? found[k].A
                                                 : found[k].A_standard;
        cast(r, k, statistic, p, config);
    }
done:
    return status;
}

static clast_status cast_henze_zirkler(const clx_part *part, const clast_uniformity_config *config,
                                       clast_uniformity *r)
{
    clast_status status = CLAST_OK;
    clast_henze_zirkler found;
    if (votes(config, HENZE_ZIRKLER)) {
        CLX_TRY(clx_henze_zirkler_test(part, CLAST_SUMS_AUTO, &found));
        cast(r, HENZE_ZIRKLER, found.HZ, config->paper ? found.p_paper : found.p, config);
    }
done:
    return status;
}

static clast_status cast_pearson(const clx_part *part, const clast_uniformity_config *config,
                                 clast_uniformity *r)
{
    clast_status status = CLAST_OK;
    static const int32_t pair[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    clast_pearson found;
    if (votes(config, PEARSON) && part->d > 1) {
        CLX_TRY(clx_pearson_test(part, &found));
        int least = 0;
        for (int k = 1; k < found.n_pair && k < 3; ++k) {
            least = found.p[k] < found.p[least] ? k : least;
        }
        cast(r, PEARSON, found.r[least], config->paper ? found.p[least] : found.p_bonferroni,
             config);
        r->vote[r->n_test - 1].axis[0] = pair[least][0];
        r->vote[r->n_test - 1].axis[1] = pair[least][1];
    }
done:
    return status;
}

clast_status clx_uniformity_decide(const clx_part *part, const clast_uniformity_config *config,
                                   bool *reject)
{
    clast_status status = CLAST_OK;
    clast_uniformity made = {0};
    if (part->n_all >= 5) {
        CLX_TRY(cast_discrepancies(part, config, &made));
        CLX_TRY(cast_pearson(part, config, &made));
        if (made.n_reject ==
            needed_votes(config, part->d) - 1) { // only now does the last test matter
            CLX_TRY(cast_henze_zirkler(part, config, &made));
        }
    }
    *reject = part->n_all >= 5 && made.n_reject >= needed_votes(config, part->d);
done:
    return status;
}

static clast_status measure_score(const clx_part *part, const double side[3], bool paper,
                                  clast_uniformity *r)
{
    clast_status status = CLAST_OK;
    clx_depths depths = {{0}, 0.0};
    const clx_depth_law law = clx_depth_law_of_box(part->d, side);
    CLX_TRY(clx_depths_sort(&law, part, -1, &depths));
    CLX_TRY(paper ? clx_depths_trapezoid(&law, part->comm, &depths, &r->score)
                  : clx_depths_distance(&law, part->comm, &depths, &r->score));
    r->ideal = clx_depth_ideal(&law, (double)part->n_all);
done:
    clx_depths_free(&depths);
    return status;
}

/// Level and votes as clast_decompose_fields has them.
static clast_status check_config(const clast_uniformity_config *config)
{
    clast_status status = CLAST_OK;
    const clast_field *fields = clast_decompose_fields;
    CLX_TRY(clx_field_check(clast_fields_find(fields, "level"), &config->level));
    CLX_TRY(clx_field_check(clast_fields_find(fields, "votes"), &config->votes));
    CLX_CHECK(config->left_out < (1U << CLAST_N_TEST) - 1U, CLAST_E_CONFIG,
              "left_out: %#x leaves no test to vote, or names tests that there are not",
              (unsigned)config->left_out);
done:
    return status;
}

static clast_status check_sides(const double side[3], int32_t d)
{
    clast_status status = CLAST_OK;
    for (int32_t j = 0; j < d; ++j) {
        CLX_CHECK(side[j] > 0.0 && isfinite(side[j]), CLAST_E_ARGUMENT,
                  "side %d of the domain is %g", j, side[j]);
    }
done:
    return status;
}

clast_status clx_uniformity_test(const clx_part *part, const double side[3],
                                 const clast_uniformity_config *config, clast_uniformity *result)
{
    clast_status status = CLAST_OK;
    clast_uniformity made = {0};
    if (part->n_all >= 1) {
        CLX_TRY(measure_score(part, side, config->paper, &made));
    }
    if (part->n_all >= 5) {
        CLX_TRY(cast_discrepancies(part, config, &made));
        CLX_TRY(cast_henze_zirkler(part, config, &made));
        CLX_TRY(cast_pearson(part, config, &made));
        made.reject = made.n_reject >= needed_votes(config, part->d);
    }
    *result = made;
done:
    return status;
}

// The four arguments of a sample stand in the published order.
// NOLINTNEXTLINE(readability-function-size)
clast_status clast_uniformity_test(const double *u, int64_t n, int32_t d, const double side[3],
                                   const clast_uniformity_config *config, clast_uniformity *result)
{
    CLX_ARGUMENTS(u, side, config, result);
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    CLX_TRY(check_config(config));
    CLX_TRY(clx_cube_check(u, n, d, 0, "a test of uniformity"));
    CLX_TRY(clx_uniformity_reachable(config, d));
    CLX_TRY(check_sides(side, d));
    const clx_part part = clx_part_whole(u, n, d);
    CLX_TRY(clx_uniformity_test(&part, side, config, result));
done:
    return status;
}
