/* Unit: distribution functions against SciPy 1.10 (printed digits) and closed forms. */
#include "support.h"

#include "math/special.h"

static void normal_matches_scipy(void **state)
{
    (void)state;
    CHECK_REL(clx_normal_cdf(-8.0), 6.22096057427174e-16, 1e-13);
    CHECK_REL(clx_normal_cdf(-1.3), 0.09680048458561036, 1e-15);
    CHECK_REL(clx_normal_cdf(0.2), 0.579259709439103, 1e-15);
    CHECK_REL(clx_normal_quantile(1e-16), -8.222082216130435, 1e-14);
    CHECK_REL(clx_normal_quantile(0.001), -3.090232306167813, 1e-14);
    CHECK_REL(clx_normal_quantile(0.3), -0.5244005127080409, 1e-14);
    CHECK_ABS(clx_normal_quantile(0.5), 0.0, 1e-15);
    CHECK_REL(clx_normal_quantile(0.975), 1.959963984540054, 1e-14);
}

static void quantile_inverts_the_distribution(void **state)
{
    (void)state;
    for (double p = 1e-12; p < 1.0; p = p < 0.01 ? 10.0 * p : p + 0.01) {
        CHECK_REL(clx_normal_cdf(clx_normal_quantile(p)), p, 1e-13);
    }
}

static void gamma_and_beta_match_scipy(void **state)
{
    (void)state;
    CHECK_REL(clx_gamma_p(0.5, 0.1), 0.34527915398142317, 1e-13);
    CHECK_REL(clx_gamma_q(3.0, 10.0), 0.0027693957155115775, 1e-13);
    CHECK_REL(clx_gamma_p(50.0, 40.0), 0.07033506665939494, 1e-12);
    CHECK_REL(clx_beta_i(0.3, 2.0, 5.0), 0.5798250000000001, 1e-13);
    CHECK_REL(clx_beta_i(0.01, 10.0, 0.5), 1.7700349655285743e-21, 1e-12);
}

static void tails_match_scipy(void **state)
{
    (void)state;
    CHECK_REL(clx_student_two_sided(2.1, 7.0), 0.0738711962129226, 1e-13);
    /* SciPy's t.ppf(0.975, 9) gives ...7409915, at which its own t.sf is 4.7e-12 off; so the
     * inverse is checked. */
    CHECK_REL(clx_student_quantile_two_sided(0.05, 9.0), 2.2621571627409915, 1e-10);
    CHECK_REL(clx_student_two_sided(clx_student_quantile_two_sided(0.05, 9.0), 9.0), 0.05, 1e-13);
    CHECK_REL(clx_chi2_sf(7.3, 2.0), 0.02599112877875535, 1e-13);
    CHECK_REL(clx_chi2_sf(7.3, 2.0), exp(-3.65), 1e-14);
    CHECK_REL(clx_fisher_sf(3.2, 4.0, 19.0), 0.036182603146051234, 1e-12);
}

static void binomial_deviation_matches_the_sum(void **state)
{
    (void)state;
    CHECK_REL(clx_binomial_deviation(37.0, 0.23), 0.05567822134773851, 1e-13);
    CHECK_REL(clx_binomial_deviation(1e7, 0.3), sqrt(2.0 * 0.21 / (CLAST_PI * 1e7)), 1e-6);
    CHECK_REL(clx_log_gamma(0.5), 0.5 * log(CLAST_PI), 1e-14);
    CHECK_REL(clx_log_gamma(11.0), log(3628800.0), 1e-15);
    CHECK_REL(clx_binomial_deviation(1.0, 0.5), 0.5, 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normal_matches_scipy),
        cmocka_unit_test(quantile_inverts_the_distribution),
        cmocka_unit_test(gamma_and_beta_match_scipy),
        cmocka_unit_test(tails_match_scipy),
        cmocka_unit_test(binomial_deviation_matches_the_sum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
