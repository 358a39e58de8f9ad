/* Unit: regressions against R 4.2.2's lm and closed forms.
 *
 *   i <- 0:39; a <- 1 + 0.1 * i; b <- sin(i); c <- a^2 + cos(2 * i)
 *   y <- 0.3 + 0.02 * a - 0.05 * b + 0.001 * c + 0.01 * sin(17 * i * i); m <- lm(y ~ a + b + c)
 *   coef(m); vcov(m); hatvalues(m); summary(m)$r.squared; summary(m)$sigma^2
 *   kappa(cbind(1, a, b, c) with columns of unit length, exact = TRUE)
 *   cross-validation: folds i %% 10, lm on the rest, predict
 */
#include "support.h"

#include "math/least_squares.h"
#include "math/rng.h"

enum { N = 40, P = 4 };

static void make_data(double *x, double *y)
{
    for (int i = 0; i < N; ++i) {
        const double a = 1.0 + 0.1 * i;
        const double b = sin(i);
        const double c = a * a + cos(2.0 * i);
        const double row[P] = {1.0, a, b, c};
        for (int j = 0; j < P; ++j) {
            x[i * P + j] = row[j];
        }
        y[i] = 0.3 + 0.02 * a - 0.05 * b + 0.001 * c + 0.01 * sin(17.0 * i * i);
    }
}

static void fit_matches_r(void **state)
{
    (void)state;
    static const double b[P] = {0.29355334582010156330, 0.02513200390752239749,
                                -0.04920544662158915505, 0.00025911204746158467};
    static const double covariance[P * P] = {
        4.4258131740071714e-05, -3.0743666189806967e-05, -8.4196641605706872e-07,
        4.7537502174656626e-06, -3.0743666189806967e-05, 2.3452980534183259e-05,
        5.3812186853140868e-07, -3.8301475565935347e-06, -8.4196641605706872e-07,
        5.3812186853140868e-07, 2.5771784826330379e-06,  -8.1644710405181977e-08,
        4.7537502174656626e-06, -3.8301475565935347e-06, -8.1644710405181977e-08,
        6.5208665571146919e-07};
    static const int row[4] = {0, 1, 20, 39};
    static const double leverage[4] = {0.24619993219396744, 0.14867231768377737,
                                       0.12176456350188548, 0.17515882977166225};
    double x[N * P];
    double y[N];
    clx_least_squares f = {0};
    make_data(x, y);
    CHECK_OK(clx_least_squares_fit(&(clx_regression){x, y, N, P}, &f));
    for (int j = 0; j < P; ++j) {
        CHECK_REL(f.b[j], b[j], 1e-10);
    }
    for (int k = 0; k < P * P; ++k) {
        CHECK_REL(f.covariance[k], covariance[k], 1e-10);
    }
    for (int k = 0; k < 4; ++k) {
        CHECK_REL(f.leverage[row[k]], leverage[k], 1e-12);
    }
    CHECK_REL(f.r2, 9.7984626459780355e-01, 1e-12);
    CHECK_REL(f.variance, 5.0879531319717774e-05, 1e-11);
    CHECK_REL(f.condition, 28.596100048758036, 1e-11);
    clx_least_squares_free(&f);
}

static void cross_validation_matches_r(void **state)
{
    (void)state;
    static const int row[4] = {0, 1, 20, 39};
    static const double predicted[4] = {0.31947950879475012, 0.28167119067604907,
                                        0.32545698518021582, 0.37378430780691552};
    double x[N * P];
    double y[N];
    double p[N];
    int32_t fold[N];
    double sum = 0.0;
    make_data(x, y);
    for (int i = 0; i < N; ++i) {
        fold[i] = i % 10;
    }
    CHECK_OK(clx_cross_validate(&(clx_regression){x, y, N, P}, fold, 10, p));
    for (int k = 0; k < 4; ++k) {
        CHECK_REL(p[row[k]], predicted[k], 1e-11);
    }
    for (int i = 0; i < N; ++i) {
        sum += fabs(p[i] - y[i]) / N;
    }
    CHECK_REL(sum, 0.0065827314947858942, 1e-10);
}

/* Data on a plane give back its coefficients, whatever the columns' scales. */
static void exact_planes_are_recovered(void **state)
{
    (void)state;
    const double b[P] = {0.278, 0.019, 0.014, -3e5};
    double x[N * P];
    double y[N];
    clx_least_squares f = {0};
    make_data(x, y);
    for (int i = 0; i < N; ++i) {
        x[i * P + 3] *= 1e-6;
        y[i] = b[0] + b[1] * x[i * P + 1] + b[2] * x[i * P + 2] + b[3] * x[i * P + 3];
    }
    CHECK_OK(clx_least_squares_fit(&(clx_regression){x, y, N, P}, &f));
    for (int j = 0; j < P; ++j) { /* rounding of y (5 here) enters the small coefficients */
        CHECK_ABS(f.b[j], b[j], j < 3 ? 1e-12 : 1e-12 * 3e5);
    }
    CHECK_REL(f.r2, 1.0, 1e-13);
    clx_least_squares_free(&f);
}

/* With noise of deviation s the coefficients scatter by s sqrt((X'X)^-1): 2000 repeats know a
 * variance to sqrt(2 / 2000) = 3.2 %, so 4 deviations are 13 %; and the mean of the estimated
 * covariance is the true one, to the same sampling error divided by sqrt(n - p). */
static void covariance_is_that_of_repeated_fits(void **state)
{
    (void)state;
    enum { N_REPEAT = 2000 };
    double x[N * P];
    double y[N];
    double sum[P] = {0.0};
    double square[P] = {0.0};
    double claimed[P] = {0.0};
    make_data(x, y);
    for (int k = 0; k < N_REPEAT; ++k) {
        clx_least_squares f = {0};
        for (int i = 0; i < N; ++i) {
            clx_rng rng = clx_rng_at(3, CLX_STREAM_TEST, (uint64_t)(k * N + i));
            y[i] = 0.3 + 0.02 * x[i * P + 1] + 0.005 * clx_rng_normal(&rng);
        }
        CHECK_OK(clx_least_squares_fit(&(clx_regression){x, y, N, P}, &f));
        for (int j = 0; j < P; ++j) {
            sum[j] += f.b[j] / N_REPEAT;
            square[j] += f.b[j] * f.b[j] / N_REPEAT;
            claimed[j] += f.covariance[j * P + j] / N_REPEAT;
        }
        clx_least_squares_free(&f);
    }
    CHECK_ABS(sum[1], 0.02, 4.0 * sqrt(claimed[1] / N_REPEAT));
    for (int j = 0; j < P; ++j) {
        CHECK_REL(square[j] - sum[j] * sum[j], claimed[j], 0.13);
    }
}

static void leverages_sum_to_the_number_of_columns(void **state)
{
    (void)state;
    double x[N * P];
    double y[N];
    double sum = 0.0;
    clx_least_squares f = {0};
    make_data(x, y);
    CHECK_OK(clx_least_squares_fit(&(clx_regression){x, y, N, P}, &f));
    for (int i = 0; i < N; ++i) {
        sum += f.leverage[i];
    }
    CHECK_REL(sum, (double)P, 1e-13);
    clx_least_squares_free(&f);
}

static void dependent_columns_are_refused(void **state)
{
    (void)state;
    double x[N * P];
    double y[N];
    clx_least_squares f = {0};
    make_data(x, y);
    CHECK_STATUS(clx_least_squares_fit(&(clx_regression){x, y, 3, P}, &f), CLAST_E_FORMAT);
    for (int i = 0; i < N; ++i) {
        x[i * P + 3] = 2.0 * x[i * P + 1] - 7.0;
    }
    CHECK_STATUS(clx_least_squares_fit(&(clx_regression){x, y, N, P}, &f), CLAST_E_FORMAT);
    assert_null(f.b);
    for (int i = 0; i < N; ++i) {
        x[i * P + 3] = 0.0;
    }
    CHECK_STATUS(clx_least_squares_fit(&(clx_regression){x, y, N, P}, &f), CLAST_E_FORMAT);
}

static void folds_are_even_and_follow_the_seed(void **state)
{
    (void)state;
    int32_t a[63];
    int32_t b[63];
    int count[10] = {0};
    CHECK_OK(clx_folds(1, 0, 63, 10, a));
    for (int i = 0; i < 63; ++i) {
        ++count[a[i]];
    }
    for (int k = 0; k < 10; ++k) {
        assert_true(count[k] == 6 || count[k] == 7);
    }
    CHECK_OK(clx_folds(1, 0, 63, 10, b));
    assert_memory_equal(a, b, sizeof a);
    CHECK_OK(clx_folds(2, 0, 63, 10, b));
    assert_memory_not_equal(a, b, sizeof a);
    CHECK_OK(clx_folds(1, 1, 63, 10, b));
    assert_memory_not_equal(a, b, sizeof a);
}

static clast_status fit_once(void *context)
{
    clx_least_squares f = {0};
    double y[N] = {0.0};
    const clast_status status = clx_least_squares_fit(&(clx_regression){context, y, N, P}, &f);
    clx_least_squares_free(&f);
    return status;
}

static void every_refused_allocation_is_told(void **state)
{
    (void)state;
    double x[N * P];
    double y[N];
    make_data(x, y);
    support_refuse_each_allocation(fit_once, x);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fit_matches_r),
        cmocka_unit_test(cross_validation_matches_r),
        cmocka_unit_test(exact_planes_are_recovered),
        cmocka_unit_test(covariance_is_that_of_repeated_fits),
        cmocka_unit_test(leverages_sum_to_the_number_of_columns),
        cmocka_unit_test(dependent_columns_are_refused),
        cmocka_unit_test(folds_are_even_and_follow_the_seed),
        cmocka_unit_test(every_refused_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
