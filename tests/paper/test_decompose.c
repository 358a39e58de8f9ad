/* Paper [Martinez2021 sec. 2.2]: bins, thresholds, labels and expected scores equal the reference.
 */
#include "support.h"

#include "cloud/bins.h"
#include "cloud/cells.h"
#include "cloud/ghosts.h"
#include "cloud/levels.h"
#include "oracle.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const sets[] = {"u2_n50", "u3_n50", "s2_n500", "f2_n500", "b3_n500", "h2_n5000"};
enum { N_SET = 6, N_GRID = 20000 };

static oracle_set points;

static void quartiles_and_bins_match(void **state)
{
    (void)state;
    static const double p[3] = {0.25, 0.5, 0.75};
    for (int s = 0; s < N_SET; ++s) {
        clx_bins bins = {0};
        double width[3];
        oracle_points(sets[s], &points);
        const clx_part part = clx_part_whole(points.u, points.n, points.d);
        CHECK_OK(clx_bins_choose(&part, width, &bins));
        for (int32_t j = 0; j < points.d; ++j) {
            double q[3];
            const clx_column column = {part.comm, part.u, part.n, part.n_all, part.d, j};
            CHECK_OK(clx_quantiles(&column, p, 3, q));
            for (int k = 0; k < 3; ++k) {
                char name[64];
                (void)snprintf(name, sizeof name, "quant.t5.q%.0f.x%d", 100.0 * p[k], j);
                CHECK_REL(q[k], oracle_value(sets[s], name), 1e-14);
            }
            char name[64];
            (void)snprintf(name, sizeof name, "fd.h%d", j);
            CHECK_REL(width[j], oracle_value(sets[s], name), 1e-12);
            (void)snprintf(name, sizeof name, "fd.nb%d", j);
            assert_int_equal(bins.nb[j], (int)oracle_value(sets[s], name));
        }
    }
}

/* Labels of every threshold, from bins_<set>.csv: header bin,count,label_lambda_count_8,... */
static void check_labels(const char *set, const clx_bins *bins, const clx_levels *levels)
{
    char path[128], line[512];
    (void)snprintf(path, sizeof path, "d2sd/bins_%s.csv", set);
    uint8_t *label = calloc((size_t)bins->n_bin, 1);
    for (int32_t t = 0; t < levels->n_lambda; ++t) {
        FILE *file = fopen(support_data(path), "r");
        int64_t bin = 0;
        assert_non_null(file);
        assert_non_null(fgets(line, sizeof line, file));
        CHECK_OK(clx_levels_label(bins->count, NULL, bins->n_bin,
                                  &(clx_label_cut){levels->lambda[t], levels->q20, false}, label));
        while (fgets(line, sizeof line, file) != NULL) {
            char *at = line;
            assert_int_equal(strtol(at, &at, 10), bin);
            assert_int_equal(strtol(at + 1, &at, 10), bins->count[bin]);
            for (int32_t k = 0; k < t; ++k) {
                (void)strtol(at + 1, &at, 10);
            }
            assert_int_equal(strtol(at + 1, &at, 10), label[bin]);
            ++bin;
        }
        assert_int_equal(bin, bins->n_bin);
        (void)fclose(file);
    }
    free(label);
}

static void check_scores(const char *set, const clx_bins *bins, const clx_levels *levels)
{
    const double side[3] = {1.0, 1.0, 1.0};
    const clx_depth_law law = clx_depth_law_of_box(points.d, side);
    uint8_t *label = calloc((size_t)bins->n_bin, 1);
    int64_t *depth = calloc(N_GRID + 1, sizeof *depth);
    for (int32_t t = 0; t < levels->n_lambda; ++t) {
        char name[96];
        double score = 0.0;
        CHECK_OK(clx_levels_label(bins->count, NULL, bins->n_bin,
                                  &(clx_label_cut){levels->lambda[t], levels->q20, false}, label));
        const clx_ghost_plan plan = clx_ghosts_plan(bins->count, label, bins->n_bin);
        (void)snprintf(name, sizeof name, "lambda%d.N_expected", t);
        CHECK_REL(plan.n_expected, oracle_value(set, name), 1e-13);
        (void)snprintf(name, sizeof name, "lambda%d.ambient_per_bin", t);
        CHECK_REL(plan.per_bin, oracle_value(set, name), 1e-13);
        memset(depth, 0, (N_GRID + 1) * sizeof *depth);
        for (int64_t i = 0; i < points.n; ++i) {
            const double *u = points.u + i * points.d;
            if (label[clx_bins_of(bins, u)] == 0) {
                ++depth[clx_ghosts_depth_class(&law, u, N_GRID)];
            }
        }
        const clx_ghost_sample sample = {bins, label, &law, plan, depth, N_GRID};
        CHECK_OK(clx_ghosts_expected_score(&sample, &score));
        (void)snprintf(name, sizeof name, "lambda%d.expected_score_semianalytic_6digits", t);
        CHECK_REL(score, oracle_value(set, name), 2e-5);
    }
    free(label);
    free(depth);
}

/* Cells of each kind: how many, and the sums that events are made of (domain volume 1). */
static void check_cells(const char *set, const clx_bins *bins, const clx_levels *levels)
{
    const char *const kind[] = {"rect", "comp", "bins", "labels"};
    uint8_t *label = calloc((size_t)bins->n_bin, 1);
    uint16_t *tag = calloc((size_t)bins->n_bin, sizeof *tag);
    int32_t *cell = calloc((size_t)bins->n_bin, sizeof *cell);
    for (int t = 0; t < levels->n_lambda * 4; ++t) {
        char name[96];
        int32_t n_cell = 0;
        CHECK_OK(clx_levels_label(bins->count, NULL, bins->n_bin,
                                  &(clx_label_cut){levels->lambda[t / 4], levels->q20, false},
                                  label));
        for (int64_t b = 0; b < bins->n_bin; ++b) {
            tag[b] = label[b];
        }
        CHECK_OK(clx_cells_make(bins, (clx_cells_kind)(t % 4), tag, cell, &n_cell));
        (void)snprintf(name, sizeof name, "lambda%d.%s.cells", t / 4, kind[t % 4]);
        assert_int_equal(n_cell, (int)oracle_value(set, name));
        double *n = calloc((size_t)n_cell, sizeof *n);
        double *v = calloc((size_t)n_cell, sizeof *v);
        for (int64_t b = 0; b < bins->n_bin; ++b) {
            n[cell[b]] += bins->count[b];
            v[cell[b]] += 1.0 / (double)bins->n_bin;
        }
        double squares = 0.0, pairs = 0.0;
        for (int32_t c = 0; c < n_cell; ++c) {
            squares += n[c] * n[c] / v[c];
            pairs += n[c] * (n[c] - 1.0) / v[c];
        }
        (void)snprintf(name, sizeof name, "lambda%d.%s.sum_n2_over_V", t / 4, kind[t % 4]);
        CHECK_REL(squares, oracle_value(set, name), 1e-12);
        (void)snprintf(name, sizeof name, "lambda%d.%s.sum_n_nm1_over_V", t / 4, kind[t % 4]);
        CHECK_REL(pairs, oracle_value(set, name), 1e-12);
        free(n);
        free(v);
    }
    free(label);
    free(tag);
    free(cell);
}

static void thresholds_labels_and_scores_match(void **state)
{
    (void)state;
    for (int s = 0; s < N_SET; ++s) {
        clx_bins bins = {0};
        clx_levels levels = {0};
        double width[3];
        oracle_points(sets[s], &points);
        const clx_part part = clx_part_whole(points.u, points.n, points.d);
        CHECK_OK(clx_bins_choose(&part, width, &bins));
        CHECK_OK(clx_bins_count(&bins, &part));
        CHECK_OK(clx_levels_find(bins.count, NULL, bins.n_bin, &levels));
        CHECK_REL(levels.q20, oracle_value(sets[s], "thr.Q20_counts_allbins"), 1e-15);
        CHECK_REL(levels.q60, oracle_value(sets[s], "thr.Q60_counts_nonempty"), 1e-15);
        CHECK_REL(levels.q80, oracle_value(sets[s], "thr.Q80_counts_nonempty"), 1e-15);
        assert_int_equal(levels.n_lambda, (int)oracle_value(sets[s], "thr.n_lambda"));
        assert_int_equal(levels.fallback, (int)oracle_value(sets[s], "thr.fallback_used"));
        check_labels(sets[s], &bins, &levels);
        check_cells(sets[s], &bins, &levels);
        check_scores(sets[s], &bins, &levels);
        clx_levels_free(&levels);
        clx_bins_free(&bins);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quartiles_and_bins_match),
        cmocka_unit_test(thresholds_labels_and_scores_match),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
