/* Unit: form factors against values worked out by hand and the ranges of the paper's Table 1. */
#include "support.h"

#include "math/rng.h"
#include <string.h>

/* L, I, S = 4, 2, 1: every factor is a short closed form. */
static void factors_of_4_2_1_are_those_worked_by_hand(void **state)
{
    (void)state;
    const double by_hand[CLAST_N_FORM_FACTOR] = {
        0.5,             /* S/I */
        0.5,             /* I/L */
        0.25,            /* S/L */
        1.0,             /* 4 1 / 4 */
        1.0 / sqrt(8.0), /* S/sqrt(LI) */
        2.0 / 3.0,       /* 2/3 */
        2.5,             /* 5/2 */
        0.75,            /* 3/4 */
        1.0 / sqrt(7.0), /* sqrt(21/3) */
        0.5,             /* cbrt(2/16) */
        0.5,             /* cbrt(1/8) */
        20.0 / 3.0,      /* 10 (1/6) 4 */
        3.0,             /* 6/2 */
    };
    double value[CLAST_N_FORM_FACTOR];
    double feature[CLAST_N_FORM_FEATURE];
    clast_form_factors(4.0, 2.0, 1.0, value);
    clast_form_features(4.0, 2.0, 1.0, feature);
    for (int f = 0; f < CLAST_N_FORM_FACTOR; ++f) {
        CHECK_REL(value[f], by_hand[f], 1e-15);
        assert_true(feature[f] == value[f]);
        CHECK_REL(feature[CLAST_N_FORM_FACTOR + f], 1.0 / by_hand[f], 1e-15);
    }
}

static void a_sphere_has_the_ends_of_the_ranges(void **state)
{
    (void)state;
    const double expected[CLAST_N_FORM_FACTOR] = {1, 1, 1, 1, 1, NAN, 2, 2, 1, 1, 1, NAN, 1};
    double value[CLAST_N_FORM_FACTOR];
    clast_form_factors(3.0, 3.0, 3.0, value);
    for (int f = 0; f < CLAST_N_FORM_FACTOR; ++f) {
        if (isnan(expected[f])) {
            assert_true(isnan(value[f]));
        } else {
            CHECK_REL(value[f], expected[f], 1e-15);
        }
    }
}

static void factors_stay_in_their_ranges_and_forget_the_scale(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 2000; ++k) {
        clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, k);
        const double l = exp(4.0 * clx_rng_uniform(&rng));
        const double i = l * clx_rng_uniform(&rng);
        const double s = i * clx_rng_uniform(&rng);
        double value[CLAST_N_FORM_FACTOR];
        double scaled[CLAST_N_FORM_FACTOR];
        clast_form_factors(l, i, s, value);
        clast_form_factors(1e-6 * l, 1e-6 * i, 1e-6 * s, scaled);
        for (int f = 0; f < CLAST_N_FORM_FACTOR; ++f) {
            const clast_form_factor_entry *about = clast_form_factor_about(f);
            assert_true(value[f] >= about->low && value[f] <= about->high);
            /* L - I and L - S cancel; the index may also pass through zero */
            const double cancel = l / fmin(l - i, l - s);
            CHECK_ABS(scaled[f], value[f], 1e-15 * (4.0 + cancel) * (10.0 * l / s + 1.0));
        }
    }
}

static void lengths_out_of_order_have_no_form(void **state)
{
    (void)state;
    const double bad[][3] = {{1, 2, 1},
                             {2, 1, 1.5},
                             {1, 1, 0},
                             {1, 1, -1},
                             {INFINITY, 1, 1},
                             {NAN, 1, 1},
                             {INFINITY, INFINITY, INFINITY}};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        double value[CLAST_N_FORM_FACTOR];
        clast_form_factors(bad[k][0], bad[k][1], bad[k][2], value);
        for (int f = 0; f < CLAST_N_FORM_FACTOR; ++f) {
            assert_true(isnan(value[f]));
        }
    }
}

static void names_and_symbols_find_their_factor(void **state)
{
    (void)state;
    for (int f = 0; f < CLAST_N_FORM_FACTOR; ++f) {
        const clast_form_factor_entry *about = clast_form_factor_about(f);
        assert_int_equal(clast_form_factor_find(about->name), f);
        assert_int_equal(clast_form_factor_find(about->symbol), f);
        assert_string_equal(clast_form_feature_name(f), about->name);
        assert_string_equal(clast_form_feature_name(CLAST_N_FORM_FACTOR + f), about->inverse);
        assert_int_equal(strncmp(about->inverse, "inverse_", 8), 0);
    }
    assert_int_equal(clast_form_factor_find("Disc-Rod-Index"), CLAST_FORM_DISC_ROD);
    assert_int_equal(clast_form_factor_find("flat"), -1);
    assert_int_equal(clast_form_factor_find(""), -1);
    assert_null(clast_form_factor_about(-1));
    assert_null(clast_form_factor_about(CLAST_N_FORM_FACTOR));
    assert_null(clast_form_feature_name(CLAST_N_FORM_FEATURE));
}

/* The second of its documented lists was none, and names by one letter anywhere were one. */
static void columns_are_a_forms_by_the_word_of_their_place(void **state)
{
    (void)state;
    static const char *const forms[] = {"",
                                        "flatness_mean,elongation_mean",
                                        "mean FL, mean-EL",
                                        "S/I,I/L",
                                        "L,I,S",
                                        "mean L,mean I,mean S",
                                        "d_L,d_I,d_S",
                                        "d_L_mm,d_I_mm,d_S_mm",
                                        "L, I, S",
                                        "mean L (mm),mean I (mm),mean S (mm)",
                                        "l_mm,i_mm,s_mm",
                                        "Major Axis Length,Middle Axis Length,Minor Axis Length",
                                        "length,width,thickness"};
    static const char *const others[] = {"sand,mu",
                                         "sand,mu,moisture",
                                         "elongation,flatness",
                                         "flatness",
                                         "i_mean,s_total,l_organic",
                                         "short_term,long_term,intermediate_step",
                                         "length,width,time_s",
                                         "length,width,time s",
                                         "d_L,d_I,d_Sand",
                                         "L,L,L",
                                         "L,I,S,D"};
    assert_true(clast_form_columns_named(NULL));
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; ++i) {
        assert_true(clast_form_columns_named(forms[i]));
    }
    for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i) {
        assert_false(clast_form_columns_named(others[i]));
    }
}

/* The two Rhine scans are stored with D = 1 [data README of the scans]. */
static void sieve_size_of_the_rhine_scans_is_one(void **state)
{
    (void)state;
    CHECK_ABS(clast_form_sieve_size(1.291653, 0.575876), 1.0, 5e-7);
    CHECK_ABS(clast_form_sieve_size(1.074475, 0.919513), 1.0, 5e-7);
}

static void lengths_give_back_flatness_elongation_and_size(void **state)
{
    (void)state;
    double lis[3];
    clast_form_lengths(0.647, 0.682, 0.011, lis);
    CHECK_REL(lis[2] / lis[1], 0.647, 1e-15);
    CHECK_REL(lis[1] / lis[0], 0.682, 1e-15);
    CHECK_REL(clast_form_sieve_size(lis[1], lis[2]), 0.011, 1e-15);
}

/* (L - I) / (L - S) of a cube from a file of 24 bits is 0 / 0: missing, not what rounding left. */
static void differences_of_rounding_have_no_ratio(void **state)
{
    (void)state;
    double value[CLAST_N_FORM_FEATURE];
    const int32_t inverse = CLAST_N_FORM_FACTOR;
    clast_form_features(1.0 + 1e-7, 1.0 + 3e-8, 1.0, value);
    assert_true(isnan(value[CLAST_FORM_DISC_ROD]) && isnan(value[CLAST_FORM_OBLATE_PROLATE]));
    assert_true(isnan(value[inverse + CLAST_FORM_DISC_ROD]));
    clast_form_features(2.0 + 1e-7, 2.0, 1.0, value);
    CHECK_ABS(value[CLAST_FORM_DISC_ROD], 0.0, 1e-6);
    assert_true(isnan(value[inverse + CLAST_FORM_DISC_ROD])); // 1 / rounding
    clast_form_features(1.00001, 1.000005, 1.0, value);
    CHECK_REL(value[CLAST_FORM_DISC_ROD], 0.5, 1e-9);
    assert_int_equal(clast_form_zingg((double)NAN, 0.5), CLAST_N_ZINGG);
    assert_string_equal(clast_zingg_name(CLAST_N_ZINGG), "-");
}

static void zingg_has_four_corners(void **state)
{
    (void)state;
    assert_string_equal(clast_zingg_name(clast_form_zingg(0.9, 0.9)), "sphere");
    assert_string_equal(clast_zingg_name(clast_form_zingg(0.3, 0.9)), "disc");
    assert_string_equal(clast_zingg_name(clast_form_zingg(0.9, 0.3)), "rod");
    assert_string_equal(clast_zingg_name(clast_form_zingg(0.3, 0.3)), "blade");
    assert_int_equal(clast_form_zingg(2.0 / 3.0, 2.0 / 3.0), CLAST_ZINGG_SPHERE);
    assert_int_equal(clast_form_zingg(2.0 / 3.0 - 1e-4, 2.0 / 3.0 - 1e-4), CLAST_ZINGG_BLADE);
}

/* Measured on a box 3:2:1 a tenth as large: 1e-16 below 2/3, from an STL's 24 bits 1e-8. */
static void a_ratio_of_two_thirds_forgets_its_rounding(void **state)
{
    (void)state;
    const double below = 0.6666666666666665;
    assert_true(below < 2.0 / 3.0);
    assert_int_equal(clast_form_zingg(below, below), CLAST_ZINGG_SPHERE);
    assert_int_equal(clast_form_zingg(0.5, 2.0 / 3.0 - 2e-8), CLAST_ZINGG_DISC);
    assert_int_equal(clast_form_zingg(2.0 / 3.0 - 2e-8, 0.5), CLAST_ZINGG_ROD);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(factors_of_4_2_1_are_those_worked_by_hand),
        cmocka_unit_test(a_sphere_has_the_ends_of_the_ranges),
        cmocka_unit_test(factors_stay_in_their_ranges_and_forget_the_scale),
        cmocka_unit_test(lengths_out_of_order_have_no_form),
        cmocka_unit_test(names_and_symbols_find_their_factor),
        cmocka_unit_test(columns_are_a_forms_by_the_word_of_their_place),
        cmocka_unit_test(sieve_size_of_the_rhine_scans_is_one),
        cmocka_unit_test(lengths_give_back_flatness_elongation_and_size),
        cmocka_unit_test(differences_of_rounding_have_no_ratio),
        cmocka_unit_test(zingg_has_four_corners),
        cmocka_unit_test(a_ratio_of_two_thirds_forgets_its_rounding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
