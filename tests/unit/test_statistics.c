/* Unit: statistics against R 4.2.2 (shapiro.test, double precision) and SciPy 1.10.1 / NumPy.
 *
 * The reference scripts, with q(n, f) = f((i - 1/2) / n), i = 1..n:
 *   R:      shapiro.test(q(n, function(p) -log(1 - p)))$statistic, $p.value       ("expo")
 *           q(63, p^2) "square", q(63, log(p / (1 - p))) "logit", sin(i) + 0.3 sin(7 i), i = 0..199
 *   NumPy:  x = sin(i) + 0.3 sin(7 i); y = cos(1.3 i) + 0.5 sin(i); z = sin(0.5 i)^3 + 0.2 cos(1.3
 * i) scipy.stats.skew, kurtosis, pearsonr; numpy.quantile; numpy.linalg.eigh(numpy.corrcoef)
 */
#include "support.h"

#include "math/pca.h"
#include "math/rng.h"
#include "math/sample.h"
#include "math/special.h"
#include <clast/statistics.h>
#include <string.h>

enum { N = 200, MOST = 3000 };

static double expo(double p)
{
    return -log(1.0 - p);
}

static double square(double p)
{
    return p * p;
}

static double logit(double p)
{
    return log(p / (1.0 - p));
}

/* Reference W and p by R. */
static void check_shapiro(const double *x, int64_t n, double w, double p)
{
    double our_w = 0.0;
    double our_p = 0.0;
    CHECK_OK(clast_shapiro_wilk(x, n, &our_w, &our_p));
    CHECK_REL(our_w, w, 1e-11);
    CHECK_REL(our_p, p, 1e-8); /* p amplifies 1 - W's rounding by up to n^2 */
}

static void shapiro_matches_r(void **state)
{
    (void)state;
    static const struct {
        double (*quantile)(double p);
        int n;
        double w, p;
    } rows[] = {
        {expo, 4, 0.93270307793572693, 0.61037593563688619},
        {expo, 5, 0.91663710424811051, 0.50848195492923876},
        {expo, 6, 0.90521713946567484, 0.40568533025320264},
        {expo, 10, 0.87975735069901628, 0.12965887456545599},
        {expo, 11, 0.87588976633851678, 0.09223251629106155},
        {expo, 12, 0.8725624881616304, 0.070434830210159893},
        {expo, 20, 0.85635745672567087, 0.0068248092524668715},
        {square, 63, 0.89551131877090484, 6.1757387945277423e-05},
        {logit, 63, 0.99717941247955577, 0.99996387347119331},
    };
    static double x[MOST];
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        for (int i = 0; i < rows[k].n; ++i) {
            x[i] = rows[k].quantile((i + 0.5) / rows[k].n);
        }
        check_shapiro(x, rows[k].n, rows[k].w, rows[k].p);
    }
}

static void shapiro_matches_r_on_long_samples(void **state)
{
    (void)state;
    static double x[MOST];
    static const double weights[11] = {148, 154, 158, 160, 161, 162, 166, 170, 182, 195, 236};
    for (int i = 0; i < N; ++i) {
        x[i] = sin(i) + 0.3 * sin(7.0 * i);
    }
    check_shapiro(x, N, 0.93959890498331422, 2.115126501845265e-07);
    for (int i = 0; i < MOST; ++i) {
        x[i] = sin(i) + 0.9 * sin(7 * i * 1.01) + 0.8 * sin(0.37 * i);
    }
    check_shapiro(x, MOST, 0.99434342389092478, 2.3058134953759386e-09);
    check_shapiro(weights, 11, 0.78881469483538735,
                  0.0067038140565029254); /* Shapiro and Wilk's example */
}

/* Any order, any scale and origin, either sign: W belongs to the form of the sample. */
static void shapiro_ignores_scale_and_order(void **state)
{
    (void)state;
    double x[40];
    double y[40];
    double w[2];
    double p[2];
    for (int i = 0; i < 40; ++i) {
        clx_rng rng = clx_rng_at(7, CLX_STREAM_TEST, (uint64_t)i);
        x[i] = clx_rng_uniform(&rng);
        y[39 - i] = 1e6 - 1e3 * x[i];
    }
    CHECK_OK(clast_shapiro_wilk(x, 40, &w[0], &p[0]));
    CHECK_OK(clast_shapiro_wilk(y, 40, &w[1], &p[1]));
    CHECK_REL(w[1], w[0], 1e-10);
}

/* The p values of normal samples are uniform: Kolmogorov's distance of 2000 of them stays below its
 * 0.1 % point, 1.95 / sqrt(2000) = 0.0436, plus 0.01 for Royston's approximation of p. */
static void shapiro_p_is_uniform_for_normal_samples(void **state)
{
    (void)state;
    enum { N_SAMPLE = 2000, SIZE = 30, N_STEP = 20 };
    int count[N_STEP] = {0};
    for (int k = 0; k < N_SAMPLE; ++k) {
        double x[SIZE];
        double w = 0.0;
        double p = 0.0;
        for (int i = 0; i < SIZE; ++i) {
            clx_rng rng = clx_rng_at(11, CLX_STREAM_TEST, (uint64_t)(k * SIZE + i));
            x[i] = clx_rng_normal(&rng);
        }
        CHECK_OK(clast_shapiro_wilk(x, SIZE, &w, &p));
        ++count[(int)fmin(p * N_STEP, N_STEP - 1)];
    }
    double sum = 0.0;
    for (int k = 0; k < N_STEP; ++k) {
        sum += (double)count[k] / N_SAMPLE;
        CHECK_ABS(sum, (k + 1.0) / N_STEP, 0.0536);
    }
}

static void shapiro_refuses_what_has_no_answer(void **state)
{
    (void)state;
    const double two[2] = {1.0, 2.0};
    const double same[4] = {3.0, 3.0, 3.0, 3.0};
    const double bad[4] = {1.0, NAN, 2.0, 3.0};
    double w = -1.0;
    double p = -1.0;
    CHECK_STATUS(clast_shapiro_wilk(two, 2, &w, &p), CLAST_E_FORMAT);
    CHECK_STATUS(clast_shapiro_wilk(same, 4, &w, &p), CLAST_E_FORMAT);
    CHECK_STATUS(clast_shapiro_wilk(bad, 4, &w, &p), CLAST_E_FORMAT);
    CHECK_ABS(w, -1.0, 0.0);
}

/* Three columns of 200 rows: x, y, z of the head comment. */
static void make_columns(clast_table *t)
{
    static const char *const name[3] = {"x", "y", "z"};
    CHECK_OK(clast_table_init(t, "waves", N));
    for (int c = 0; c < 3; ++c) {
        double *v = NULL;
        CHECK_OK(clast_table_add_number(t, name[c], "-", &v));
        for (int i = 0; i < N; ++i) {
            const double value[3] = {sin(i) + 0.3 * sin(7.0 * i), cos(1.3 * i) + 0.5 * sin(i),
                                     pow(sin(0.5 * i), 3) + 0.2 * cos(1.3 * i)};
            v[i] = value[c];
        }
    }
}

static void summary_matches_numpy(void **state)
{
    (void)state;
    static const double quantile[CLAST_N_QUANTILE] = {
        -1.1610765101366671, -1.0134261960605158, -0.55323359443909681, 0.027391417952723728,
        0.55095195006720465, 1.0276065568005377,  1.1591101652892803};
    clast_table t = {0};
    clast_statistics s = {0};
    make_columns(&t);
    CHECK_OK(clast_statistics_of(&t, NULL, &s));
    const clast_sample_summary *x = &s.summary[0];
    CHECK_REL(x->mean, 0.0063995819484967244, 1e-12);
    CHECK_REL(x->deviation, 0.73902810247249928, 1e-13);
    CHECK_REL(x->deviation_ml, 0.73717821696173469, 1e-13);
    CHECK_REL(x->skewness, -0.0058670589401704628, 1e-11);
    CHECK_REL(x->kurtosis, -1.2681600814642529, 1e-12);
    for (int k = 0; k < CLAST_N_QUANTILE; ++k) {
        CHECK_REL(x->quantile[k], quantile[k], 1e-12);
    }
    CHECK_REL(s.r[1], 0.39873520895422537, 1e-13);
    CHECK_REL(s.r_p[1], 4.9760393915761013e-09, 1e-9);
    CHECK_REL(s.r[3], s.r[1], 0.0);
    clast_statistics_free(&s);
    clast_table_free(&t);
}

static void components_match_numpy(void **state)
{
    (void)state;
    static const double value[3] = {1.4404091276768418, 1.0107433831641068, 0.54884748915905146};
    static const double vector[3][3] = {
        {0.63470973682420584, 0.71123445817342001, 0.30214085372108884},
        {-0.44624912398324068, 0.018145564585781086, 0.89472479446478581},
        {-0.63087658803028768, 0.70272063011742025, -0.32890492042935121}};
    clast_table t = {0};
    clast_statistics s = {0};
    make_columns(&t);
    CHECK_OK(clast_statistics_of(&t, NULL, &s));
    assert_int_equal(s.n_pca, 3);
    for (int k = 0; k < 3; ++k) {
        CHECK_REL(s.variance[k], value[k], 1e-13);
        for (int j = 0; j < 3; ++j) {
            CHECK_ABS(s.loading[3 * k + j], vector[k][j], 1e-12);
        }
    }
    CHECK_REL(s.explained[2], 1.0, 1e-14);
    assert_int_equal(clast_statistics_n_component(&s, 0.8), 2);
    clast_statistics_free(&s);
    clast_table_free(&t);
}

/* Columns that depend on two numbers have two components. */
static void two_numbers_need_two_components(void **state)
{
    (void)state;
    static const double mix[4][2] = {{1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {2.0, -1.0}};
    static const char *const name[4] = {"a", "b", "c", "d"};
    clast_table t = {0};
    clast_statistics s = {0};
    CHECK_OK(clast_table_init(&t, "two", 50));
    for (int c = 0; c < 4; ++c) {
        double *v = NULL;
        CHECK_OK(clast_table_add_number(&t, name[c], "-", &v));
        for (int i = 0; i < 50; ++i) {
            v[i] = mix[c][0] * sin(i) + mix[c][1] * cos(1.7 * i);
        }
    }
    CHECK_OK(clast_statistics_of(&t, NULL, &s));
    assert_int_equal(clast_statistics_n_component(&s, 1.0 - 1e-12), 2);
    CHECK_ABS(s.variance[2], 0.0, 1e-14 * 4);
    const double r = s.r[1]; /* two columns: 1 + |r| and 1 - |r| */
    CHECK_OK(clast_statistics_limit_pca(&s, 2));
    assert_int_equal(s.n_pca, 2);
    CHECK_REL(s.variance[0], 1.0 + fabs(r), 1e-14);
    CHECK_REL(s.variance[1], 1.0 - fabs(r), 1e-14);
    clast_statistics_free(&s);
    clast_table_free(&t);
}

/* A constant column, a gap, an infinite cell: every other figure stays what it was. */
static void bad_cells_stay_in_their_column(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_statistics clean = {0};
    clast_statistics s = {0};
    double *v = NULL;
    make_columns(&t);
    CHECK_OK(clast_statistics_of(&t, NULL, &clean));
    CHECK_OK(clast_table_add_number(&t, "same", "-", &v));
    for (int i = 0; i < N; ++i) {
        v[i] = 0.1;
    }
    CHECK_OK(clast_table_add_number(&t, "gaps", "-", &v));
    for (int i = 0; i < N; ++i) {
        v[i] = i == 3 ? (double)NAN : i == 5 ? (double)INFINITY : cos(i);
    }
    CHECK_OK(clast_statistics_of(&t, NULL, &s));
    assert_true(s.summary[3].is_constant);
    assert_true(isnan(s.r[5 * 3 + 0]));
    assert_true(isnan(s.summary[3].shapiro_w));
    CHECK_REL(s.summary[3].mean, 0.1, 1e-15);
    assert_int_equal(s.summary[4].n, N - 2);
    assert_int_equal(s.summary[4].n_left_out, 2);
    assert_true(isfinite(s.r[5 * 4 + 0]) && isfinite(s.summary[4].deviation));
    assert_int_equal(s.n_pca, 3);
    CHECK_REL(s.variance[0], clean.variance[0], 1e-13);
    CHECK_REL(s.summary[0].mean_low, clean.summary[0].mean_low, 0.0);
    clast_statistics_free(&s);
    clast_statistics_free(&clean);
    clast_table_free(&t);
}

static void one_row_has_a_mean_and_no_spread(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_statistics s = {0};
    double *v = NULL;
    CHECK_OK(clast_table_init(&t, "one", 1));
    CHECK_STATUS(clast_statistics_of(&t, NULL, &s), CLAST_E_FORMAT);
    CHECK_OK(clast_table_add_number(&t, "a", "-", &v));
    v[0] = 0.7;
    CHECK_OK(clast_statistics_of(&t, NULL, &s));
    CHECK_REL(s.summary[0].mean, 0.7, 1e-15);
    assert_true(isnan(s.summary[0].deviation) && isnan(s.summary[0].shapiro_p));
    assert_int_equal(s.n_pca, 0);
    clast_statistics_free(&s);
    clast_table_free(&t);
}

/* The bootstrap interval of a mean is the normal one, mean +- 1.96 s / sqrt(n), to the sampling
 * error of a 2.5 % quantile of 2000 draws (2.7 % of s / sqrt(n), one deviation) and the interval's
 * skewness: 12 %. */
static void bootstrap_of_a_mean_is_the_normal_interval(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_statistics s = {0};
    make_columns(&t);
    CHECK_OK(clast_statistics_of(&t, NULL, &s));
    for (int k = 0; k < 3; ++k) {
        const clast_sample_summary *m = &s.summary[k];
        const double error = m->deviation_ml / sqrt((double)N);
        CHECK_ABS(m->mean_low, m->mean - 1.959964 * error, 0.12 * error);
        CHECK_ABS(m->mean_high, m->mean + 1.959964 * error, 0.12 * error);
        assert_true(m->deviation_low < m->deviation && m->deviation < m->deviation_high);
    }
    clast_statistics_free(&s);
    clast_table_free(&t);
}

static void threads_do_not_move_an_interval(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_statistics s[2] = {{0}, {0}};
    make_columns(&t);
    for (int k = 0; k < 2; ++k) {
        clast_parallel_set_threads(k + 1);
        CHECK_OK(clast_statistics_of(&t, NULL, &s[k]));
    }
    clast_parallel_set_threads(0);
    assert_memory_equal(s[0].summary, s[1].summary, 3 * sizeof *s[0].summary);
    clast_statistics_free(&s[0]);
    clast_statistics_free(&s[1]);
    clast_table_free(&t);
}

static void histogram_counts_everything_once(void **state)
{
    (void)state;
    double x[63];
    clast_histogram h = {0};
    clast_table t = {0};
    for (int i = 0; i < 63; ++i) {
        x[i] = 0.65 + 0.17 * clx_normal_quantile((i + 0.5) / 63.0);
    }
    x[62] = INFINITY;
    CHECK_OK(clast_histogram_of(x, 63, &h));
    CHECK_REL(h.edge[1] - h.edge[0], 0.1, 1e-12); /* 2 IQR / cbrt(62) = 0.115 -> 0.1 */
    int64_t count = 0;
    double area = 0.0;
    for (int32_t k = 0; k < h.n_bin; ++k) {
        count += h.count[k];
        area += h.density[k] * (h.edge[k + 1] - h.edge[k]);
    }
    assert_int_equal(count, 62);
    CHECK_REL(area, 1.0, 1e-14);
    CHECK_OK(clast_histogram_table(&h, "flatness", &t));
    assert_int_equal(t.n_column, 5);
    clast_table_free(&t);
    clast_histogram_free(&h);
    for (int i = 0; i < 63; ++i) {
        x[i] = 0.5;
    }
    CHECK_OK(clast_histogram_of(x, 63, &h));
    assert_int_equal(h.n_bin, 1);
    assert_int_equal(h.count[0], 63);
    clast_histogram_free(&h);
    x[0] = NAN;
    CHECK_STATUS(clast_histogram_of(x, 1, &h), CLAST_E_FORMAT);
}

static void tables_name_every_column(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_table out = {0};
    clast_statistics s = {0};
    make_columns(&t);
    CHECK_OK(clast_statistics_of(&t, NULL, &s));
    CHECK_OK(clast_statistics_summary_table(&s, &out));
    CHECK_REL(clast_table_numbers(&out, "q50")[0], s.summary[0].quantile[3], 0.0);
    CHECK_REL(clast_table_numbers(&out, "shapiro_p")[2], s.summary[2].shapiro_p, 0.0);
    clast_table_free(&out);
    CHECK_OK(clast_statistics_correlation_table(&s, &out));
    assert_int_equal(out.n_row, 3);
    assert_string_equal(out.column[1].text[2], "z");
    clast_table_free(&out);
    CHECK_OK(clast_statistics_pca_table(&s, &out));
    CHECK_REL(clast_table_numbers(&out, "loading_y")[0], s.loading[1], 0.0);
    clast_table_free(&out);
    clast_statistics_free(&s);
    clast_table_free(&t);
}

static clast_status make_all(void *context)
{
    clast_statistics s = {0};
    clast_table out = {0};
    const clast_bootstrap few = {.n_resample = 20, .level = 0.9, .seed = 1};
    clast_status status = clast_statistics_of(context, &few, &s);
    if (status == CLAST_OK) {
        status = clast_statistics_summary_table(&s, &out);
        clast_table_free(&out);
    }
    if (status == CLAST_OK) {
        status = clast_statistics_pca_table(&s, &out);
        clast_table_free(&out);
    }
    clast_statistics_free(&s);
    return status;
}

/* Before, a level of NaN, -1 or 2 and -1 resamples went through: intervals were NaN or turned. */
static void levels_that_cannot_be_are_refused(void **state)
{
    (void)state;
    const clast_bootstrap bad[] = {{100, (double)NAN, 1}, {100, -1.0, 1},      {100, 0.0, 1},
                                   {100, 1.0, 1},         {100, 2.0, 1},       {100, 95.0, 1},
                                   {-1, 0.95, 1},         {INT32_MIN, 0.95, 1}};
    clast_table t = {0};
    clast_statistics s = {0};
    make_columns(&t);
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        CHECK_STATUS(clast_statistics_of(&t, &bad[k], &s), CLAST_E_ARGUMENT);
        assert_true(s.n == 0 && s.summary == NULL);
        assert_non_null(strstr(clast_error_detail(), "bootstrap"));
    }
    CHECK_OK(clast_statistics_of(&t, &(clast_bootstrap){0}, &s)); /* no intervals: no level */
    assert_true(isnan(s.summary[0].mean_low));
    CHECK_STATUS(clast_statistics_limit_pca(&s, -1), CLAST_E_ARGUMENT);
    assert_true(s.n_pca > 1);
    assert_int_equal(clast_statistics_n_component(&s, (double)NAN), 0);
    CHECK_OK(clast_statistics_limit_pca(&s, 1));
    assert_int_equal(s.n_pca, 0); /* one column has no components */
    clast_statistics_free(&s);
    clast_table_free(&t);
}

/* Before, the edges were NaN. */
static void histograms_beyond_a_double_are_refused(void **state)
{
    (void)state;
    const double far[] = {1e308, -1e308, 0.0, 1.0};
    const double large[] = {1.7e308, 1.6e308, 1.5e308};
    const double even[] = {1.0, 1.0 + 0x1p-52, 1.0 + 0x1p-51};
    const double least[] = {0.0, 5e-324, 1e-323};
    clast_histogram h = {0};
    CHECK_STATUS(clast_histogram_of(far, 4, &h), CLAST_E_FORMAT);
    CHECK_STATUS(clast_histogram_of(large, 3, &h), CLAST_E_FORMAT);
    assert_null(h.edge);
    const double *const narrow[] = {even, least};
    for (int k = 0; k < 2; ++k) {
        CHECK_OK(clast_histogram_of(narrow[k], 3, &h));
        assert_int_equal(h.n_bin, 1);
        assert_true(h.edge[0] < narrow[k][0] && narrow[k][2] < h.edge[1] && h.count[0] == 3);
        assert_true(isfinite(h.density[0]));
        clast_histogram_free(&h);
    }
}

static void every_refused_allocation_is_told(void **state)
{
    (void)state;
    clast_table t = {0};
    make_columns(&t);
    support_refuse_each_allocation(make_all, &t);
    clast_table_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapiro_matches_r),
        cmocka_unit_test(shapiro_matches_r_on_long_samples),
        cmocka_unit_test(shapiro_ignores_scale_and_order),
        cmocka_unit_test(shapiro_p_is_uniform_for_normal_samples),
        cmocka_unit_test(shapiro_refuses_what_has_no_answer),
        cmocka_unit_test(summary_matches_numpy),
        cmocka_unit_test(components_match_numpy),
        cmocka_unit_test(two_numbers_need_two_components),
        cmocka_unit_test(bad_cells_stay_in_their_column),
        cmocka_unit_test(one_row_has_a_mean_and_no_spread),
        cmocka_unit_test(bootstrap_of_a_mean_is_the_normal_interval),
        cmocka_unit_test(threads_do_not_move_an_interval),
        cmocka_unit_test(histogram_counts_everything_once),
        cmocka_unit_test(levels_that_cannot_be_are_refused),
        cmocka_unit_test(histograms_beyond_a_double_are_refused),
        cmocka_unit_test(tables_name_every_column),
        cmocka_unit_test(every_refused_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
