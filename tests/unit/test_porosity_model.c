/* Unit: porosity models, their inputs, errors and files. Expected numbers are worked out from the
 * printed equations in the comments. */
#include "support.h"

#include <clast/porosity_model.h>
#include <clast/statistics.h>
#include <clast/table.h>
#include <stdio.h>
#include <string.h>

static void read_text(const char *text, clast_table *t)
{
    CHECK_OK(clast_table_parse_csv("t.csv", text, strlen(text), NULL, t, NULL));
}

/* Table 11 of the paper: 0.356 and 0.285 with unrounded coefficients; the printed ones may move the
 * porosity by up to 0.0005 (1 + sum of features) = 0.0093. By hand, with
 * mu_EQ = 0.647 * 0.682 = 0.441254, s_EQ = sqrt(0.484445 * 0.449234 - 0.441254^2) = 0.151407:
 * U1: 0.032 / 0.441254 - 0.003 / 0.151407 + 0.011 / 0.682 + 0.287 = 0.355835. */
static void rhine_bed_is_that_of_table_11(void **state)
{
    (void)state;
    static const double published[2] = {0.356, 0.285};
    static const double by_hand[2] = {0.355835, 0.283702};
    static const char *const name[2] = {"form_mixture_U1", "form_mixture_U7"};
    const double mean[2] = {0.647, 0.682};
    const double deviation[2] = {0.175, 0.139};
    clast_form_inputs in = {0};
    CHECK_OK(clast_form_inputs_from_moments(mean, deviation, 0, &in));
    CHECK_ABS(in.equancy_mean, 0.441254, 1e-12);
    CHECK_ABS(in.equancy_deviation, 0.151407, 1e-6);
    for (int k = 0; k < 2; ++k) {
        clast_porosity_model m = {0};
        clast_prediction p = {0};
        CHECK_OK(clast_porosity_model_published(clast_porosity_model_find(name[k]), &m));
        CHECK_OK(clast_porosity_predict_moments(&m, &in, &p));
        CHECK_ABS(p.porosity, by_hand[k], 1.5e-6);
        CHECK_ABS(p.porosity, published[k], 0.0093 + 0.0005);
        assert_true(p.in_range);
        clast_porosity_model_free(&m);
    }
}

/* A sphere: eqs 17-19 at EQ = EL = 1. */
static void spheres_have_the_sum_of_the_coefficients(void **state)
{
    (void)state;
    static const double expected[3] = {0.019 + 0.014 + 0.278, 0.014 + 0.007 + 0.234,
                                       0.014 - 0.006 + 0.217};
    const double mean[2] = {1.0, 1.0};
    clast_form_inputs in = {0};
    CHECK_OK(clast_form_inputs_from_moments(mean, NULL, 0, &in));
    for (int k = 0; k < 3; ++k) {
        clast_porosity_model m = {0};
        clast_prediction p = {0};
        CHECK_OK(clast_porosity_model_published(k, &m));
        CHECK_OK(clast_porosity_predict_moments(&m, &in, &p));
        CHECK_REL(p.porosity, expected[k], 1e-14);
        /* rounding: three numbers of variance 0.0005^2 / 3 each, features 1 */
        CHECK_REL(p.coefficient_error, 0.0005, 1e-12);
        CHECK_REL(p.standard_error, hypot(m.deviation, 0.0005), 1e-12);
        assert_false(p.in_range);
        assert_int_equal(p.n_outside, 3); /* flatness, elongation and L/S */
        clast_porosity_model_free(&m);
    }
}

/* Grains whose flatness and elongation are independent by design (every pair of two lists): the
 * table and its moments give the same features. Population moments, hence n / (n - 1) on the
 * variance. */
static void table_and_moments_agree_for_independent_forms(void **state)
{
    (void)state;
    static const double fl[3] = {0.5, 0.65, 0.8};
    static const double el[3] = {0.55, 0.7, 0.85};
    char text[512] = "flatness,elongation\n";
    clast_table t = {0};
    clast_form_set s = {0};
    clast_form_inputs table = {0};
    clast_form_inputs moments = {0};
    for (int i = 0; i < 9; ++i) {
        const size_t n = strlen(text);
        (void)snprintf(text + n, sizeof text - n, "%.17g,%.17g\n", fl[i / 3], el[i % 3]);
    }
    read_text(text, &t);
    assert_true(clast_form_set_named(&t) && !clast_form_set_named(NULL));
    CHECK_OK(clast_form_set_of(&t, NULL, &s));
    CHECK_OK(clast_form_inputs_of(&s, NULL, 0, &table));
    const double mean[2] = {0.65, 0.7};
    const double deviation[2] = {sqrt(0.015), sqrt(0.015)};
    CHECK_OK(clast_form_inputs_from_moments(mean, deviation, 9, &moments));
    CHECK_REL(table.equancy_mean, moments.equancy_mean, 1e-14);
    CHECK_REL(table.equancy_deviation * sqrt(8.0 / 9.0), moments.equancy_deviation, 1e-13);
    const int32_t f = clast_mixture_feature_find("inverse_mean_equancy");
    CHECK_REL(table.mixture[f], 1.0 / (0.65 * 0.7), 1e-14);
    clast_form_set_free(&s);
    clast_table_free(&t);
}

static void features_have_104_names(void **state)
{
    (void)state;
    char name[96];
    for (int32_t k = 0; k < CLAST_N_MIXTURE_FEATURE; ++k) {
        assert_true(clast_mixture_feature_name(k, sizeof name, name));
        assert_int_equal(clast_mixture_feature_find(name), k);
    }
    assert_int_equal(CLAST_N_MIXTURE_FEATURE, 104);
    assert_false(clast_mixture_feature_name(104, sizeof name, name));
    assert_int_equal(clast_mixture_feature_find("mean_beauty"), -1);
    assert_int_equal(clast_form_feature_find("inverse_equancy"), 13 + CLAST_FORM_EQUANCY);
}

/* Lengths in any unit and case, ratios, both; what has no form is counted. */
static void tables_of_every_kind_are_understood(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int64_t n, n_left_out;
        double flatness, elongation, size; /* of the first grain; size 0: none */
    } rows[] = {
        {"flatness,elongation\n0.5,0.8\n", 1, 0, 0.5, 0.8, 0.0},
        {"FL,EL\n0.5,0.8\n,0.8\n0.5,inf\n-0.5,0.8\n0,0.8\n1.2,0.8\n", 1, 5, 0.5, 0.8, 0.0},
        {"id,L_mm,I_mm,S_mm\na,10,8,4\nb,8,10,4\n", 1, 1, 0.5, 0.8, 6.324555320336759},
        {"Major Axis Length (um),Middle Axis Length (um),Minor Axis Length (um)\n10,8,4\n", 1, 0,
         0.5, 0.8, 6.324555320336759},
        {"flatness,elongation,L,I,S\n0.50,0.80,10,8,4\n", 1, 0, 0.5, 0.8, 6.324555320336759},
        {"L_mm,I_cm,S (um)\n10,0.8,4000\n", 1, 0, 0.5, 0.8, 6.324555320336759e-3}, /* in metres */
        {"L (phi),I_phi,S (phi)\n0,1,2\n", 1, 0, 0.5, 0.5, 0.3952847075210474},    /* in mm */
        {"L_phi,I_um,S_phi\n0,500,2\n", 1, 0, 0.5, 0.5, 0.3952847075210474e-3},
        {"elongation,flatness,diameter\n0.8,0.5,3\n", 1, 0, 0.5, 0.8, 3.0},
        {"elongation,flatness,D_ft,D_phi\n0.8,0.5,3,-2\n", 1, 0, 0.5, 0.8, 4.0},
        {"flatness,elongation\n0.5,0.8\nbroken,0.8\nNA,0.7\n", 1, 2, 0.5, 0.8, 0.0},
        {"flatness,elongation\n1.0000000001,1\n", 1, 0, 1.0, 1.0, 0.0},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        clast_table t = {0};
        clast_form_set s = {0};
        read_text(rows[k].text, &t);
        CHECK_OK(clast_form_set_of(&t, NULL, &s));
        assert_int_equal(s.n, rows[k].n);
        assert_int_equal(s.n_left_out, rows[k].n_left_out);
        CHECK_REL(s.flatness[0], rows[k].flatness, 1e-15);
        CHECK_REL(s.elongation[0], rows[k].elongation, 1e-15);
        assert_int_equal(s.size != NULL, rows[k].size > 0.0);
        if (s.size != NULL) {
            CHECK_REL(s.size[0], rows[k].size, 1e-14);
        }
        clast_form_set_free(&s);
        clast_table_free(&t);
    }
}

static void tables_without_forms_are_refused(void **state)
{
    (void)state;
    static const char *const bad[] = {"a,b\n1,2\n",
                                      "flatness\n0.5\n",
                                      "flatness,elongation\n2,3\n",
                                      "flatness,elongation\n",
                                      "L_mm,I_mm,S\n10,8,4\n",
                                      "L_ft,I_ft,S_ft\n10,8,4\n",
                                      "L_g,I_g,S_g\n10,8,4\n",
                                      "flatness,elongation,size (ft)\n0.5,0.8,1\n",
                                      "flatness,elongation,L,I,S\n0.8,0.5,10,8,4\n"};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        clast_table t = {0};
        clast_form_set s = {0};
        read_text(bad[k], &t);
        CHECK_STATUS(clast_form_set_of(&t, NULL, &s), CLAST_E_FORMAT);
        assert_null(s.flatness);
        clast_table_free(&t);
    }
}

/* The label and the column of sizes in phi said phi, or no unit; the unit was sought in the label,
   and not found in square brackets or before others. */
static void sizes_have_the_unit_of_their_column(void **state)
{
    (void)state;
    static const struct {
        const char *column, *name, *unit, *factors;
        double size;
        bool is_sieve;
    } list[] = {{"D_phi", "sieve size", "mm", "size_mm", 0.5, true},
                {"size_phi", "size", "mm", "size_mm", 0.5, false},
                {"Diameter (phi)", "Diameter", "mm", "size_mm", 0.5, false},
                {"diameter_m", "diameter", "m", "size_m", 1.0, false},
                {"Equivalent diameter [um]", "Equivalent diameter", "um", "size_um", 1.0, false},
                {"size (mm) (mean)", "size", "mm", "size_mm", 1.0, false},
                {"sieve_size", "sieve size", "", "size", 1.0, true},
                {"Size", "Size", "", "size", 1.0, false}};
    for (size_t k = 0; k < sizeof list / sizeof list[0]; ++k) {
        char text[64];
        clast_table t = {0};
        clast_table factors = {0};
        clast_form_set s = {0};
        (void)snprintf(text, sizeof text, "FL,EL,%s\n0.5,0.8,1\n", list[k].column);
        read_text(text, &t);
        CHECK_OK(clast_form_set_of(&t, NULL, &s));
        assert_string_equal(s.size_name, list[k].name);
        assert_string_equal(s.size_unit, list[k].unit);
        assert_true(s.is_sieve_size == list[k].is_sieve);
        CHECK_OK(clast_form_set_factors(&s, &factors));
        const double *size = clast_table_numbers(&factors, list[k].factors);
        assert_non_null(size);
        CHECK_ABS(size[0], list[k].size, 0.0);
        clast_table_free(&factors);
        clast_form_set_free(&s);
        clast_table_free(&t);
    }
}

/* A unit longer than any, as a caller may set it, is none. */
static void a_unit_of_any_length_is_none(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_form_set s = {0};
    double *value = NULL;
    CHECK_OK(clast_table_init(&t, "t", 1));
    for (int k = 0; k < 3; ++k) {
        static const char *const names[] = {"L", "I", "S"};
        CHECK_OK(clast_table_add_number(
            &t, names[k], "pixels of the camera of the second microscope, binned", &value));
        value[0] = 3.0 - k;
    }
    CHECK_OK(clast_form_set_of(&t, NULL, &s));
    assert_string_equal(s.size_name, "sieve size");
    assert_string_equal(s.size_unit, "");
    clast_form_set_free(&s);
    clast_table_free(&t);
}

static void complaint_counts_by_reason(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_table out = {0};
    clast_form_set s = {0};
    char text[256];
    read_text("FL,EL\n0.5,0.8\n,0.8\n0.5,inf\n-0.5,0.8\n0,0.8\n", &t);
    CHECK_OK(clast_form_set_of(&t, NULL, &s));
    clast_form_set_complaint(&s, sizeof text, text);
    assert_string_equal(
        text, "4 of 5 rows left out: 1 missing, 1 infinite, 2 not positive (rows 2, 3, 4, 5)");
    CHECK_OK(clast_form_set_left_out(&s, &out));
    assert_string_equal(out.column[1].text[1], "infinite");
    clast_table_free(&out);
    clast_form_set_free(&s);
    clast_table_free(&t);
}

/* Equal grains have no spread: the mixture model must say so, the single-form model must answer. */
static void equal_grains_have_no_mixture(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_form_set s = {0};
    clast_form_inputs in = {0};
    clast_prediction p = {0};
    clast_porosity_model m = {0};
    read_text("FL,EL\n0.6,0.7\n0.6,0.7\n0.6,0.7\n", &t);
    CHECK_OK(clast_form_set_of(&t, NULL, &s));
    CHECK_OK(clast_porosity_model_published(3, &m));
    CHECK_STATUS(clast_porosity_predict_set(&m, &s, NULL, &in, &p), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "spread"));
    clast_porosity_model_free(&m);
    CHECK_OK(clast_porosity_model_published(0, &m));
    CHECK_OK(clast_porosity_predict_set(&m, &s, NULL, &in, &p));
    CHECK_REL(p.porosity, 0.278 + 0.019 / 0.42 + 0.014 / 0.7, 1e-14);
    clast_porosity_model_free(&m);
    clast_form_set_free(&s);
    clast_table_free(&t);
}

/* n grains of one form; with sizes its L, I and S are rounded anew at each size. */
static void set_of_one_form(int n, double fl, double el, bool has_sizes, clast_form_set *s)
{
    clast_table t = {0};
    double *column[3] = {NULL};
    CHECK_OK(clast_table_init(&t, "equal", n));
    for (int k = 0; k < (has_sizes ? 3 : 2); ++k) {
        static const char *const name[2][3] = {{"flatness", "elongation", ""}, {"L", "I", "S"}};
        CHECK_OK(clast_table_add_number(&t, name[has_sizes ? 1 : 0][k], "-", &column[k]));
    }
    for (int k = 0; k < t.n_column; ++k) {
        column[k] = t.column[k].number;
    }
    for (int i = 0; i < n; ++i) {
        const double size = 1.0 + 0.1 * (i % 37);
        column[0][i] = has_sizes ? size : fl;
        column[1][i] = has_sizes ? size * el : el;
        if (has_sizes) {
            column[2][i] = size * el * fl;
        }
    }
    CHECK_OK(clast_form_set_of(&t, NULL, s));
    assert_int_equal(s->n, n);
    clast_table_free(&t);
}

/* 67 grains 0.3, 0.9 had deviations of 1e-15 of the mean, of a rounded sum: features of 1e15 and
 * the porosity -8.9e12. The error of a sum grows with n, so n does. */
static void equal_grains_have_no_deviation(void **state)
{
    (void)state;
    static const int n[] = {2, 3, 10, 67, 100, 1000, 20000};
    static const double form[][2] = {{0.3, 0.9},   {0.65, 0.68}, {0.75, 0.8},
                                     {0.999, 0.7}, {0.5, 0.999}, {1.0, 1.0}};
    for (size_t k = 0; k < sizeof n / sizeof n[0] * 6; ++k) {
        for (int sizes = 0; sizes < 2; ++sizes) {
            clast_form_set s = {0};
            clast_form_inputs in = {0};
            set_of_one_form(n[k / 6], form[k % 6][0], form[k % 6][1], sizes == 1, &s);
            CHECK_OK(clast_form_inputs_of(&s, NULL, 0, &in));
            assert_false(in.has_deviation);
            for (int f = 0; f < CLAST_N_FORM_FEATURE; ++f) {
                const double deviation = in.mixture[CLAST_N_FORM_FEATURE + f];
                assert_true(deviation == 0.0 || isnan(in.mixture[f]));
                assert_true(isnan(in.mixture[3 * CLAST_N_FORM_FEATURE + f]));
            }
            CHECK_REL(in.flatness_mean, form[k % 6][0], 1e-15);
            clast_form_set_free(&s);
        }
    }
}

/* numpy.std of equal grains is 1e-16: no spread either. */
static void a_given_deviation_of_rounding_is_none(void **state)
{
    (void)state;
    const double mean[2] = {0.65, 0.7};
    const double rounding[2] = {1.1102230246251565e-16, 2.220446049250313e-16};
    const double small[2] = {1e-12, 0.0};
    clast_form_inputs in = {0};
    CHECK_OK(clast_form_inputs_from_moments(mean, rounding, 9, &in));
    assert_false(in.has_deviation);
    CHECK_ABS(in.flatness_deviation, 0.0, 0.0);
    assert_true(isnan(in.mixture[clast_mixture_feature_find("inverse_deviation_equancy")]));
    CHECK_OK(clast_form_inputs_from_moments(mean, small, 9, &in));
    assert_true(in.has_deviation);
}

/* I = (L + S) / 2 makes the oblate-prolate index 0 whatever the flatness: what rounding leaves of
 * it has no spread. */
static void an_index_that_vanishes_has_no_spread(void **state)
{
    (void)state;
    char text[2048] = "L,I,S\n";
    clast_table t = {0};
    clast_form_set s = {0};
    clast_form_inputs in = {0};
    for (int i = 0; i < 40; ++i) {
        const double ratio = 0.2 + 0.015 * i;
        const size_t n = strlen(text);
        (void)snprintf(text + n, sizeof text - n, "1,%.17g,%.17g\n", 0.5 * (1.0 + ratio), ratio);
    }
    read_text(text, &t);
    CHECK_OK(clast_form_set_of(&t, NULL, &s));
    CHECK_OK(clast_form_inputs_of(&s, NULL, 0, &in));
    assert_true(in.has_deviation);
    CHECK_ABS(in.mixture[CLAST_FORM_OBLATE_PROLATE], 0.0, 0.0);
    CHECK_ABS(in.mixture[CLAST_N_FORM_FEATURE + CLAST_FORM_OBLATE_PROLATE], 0.0, 0.0);
    CHECK_ABS(in.mixture[CLAST_N_FORM_FEATURE + CLAST_FORM_DISC_ROD], 0.0, 0.0);
    clast_form_set_free(&s);
    clast_table_free(&t);
}

/* Resamples of equal grains tell nothing of a sampling error: it was the rounding of their mean. */
static void equal_grains_have_no_sampling_error(void **state)
{
    (void)state;
    const clast_bootstrap b = {.n_resample = 100, .level = 0.95, .seed = 1};
    clast_porosity_model m = {0};
    CHECK_OK(clast_porosity_model_published(0, &m));
    for (int k = 0; k < 20; ++k) {
        clast_form_set s = {0};
        clast_form_inputs in = {0};
        clast_prediction p = {0};
        set_of_one_form(3 + 7 * k, 0.31 + 0.01 * k, 0.9 - 0.02 * k, k % 2 == 1, &s);
        CHECK_OK(clast_porosity_predict_set(&m, &s, &b, &in, &p));
        assert_true(isnan(p.sampling_error));
        clast_form_set_free(&s);
    }
    clast_porosity_model_free(&m);
}

/* One form far outside the model's range cost the predictions of all others. */
static void a_bed_without_a_porosity_is_nan(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_table beds = {0};
    clast_form_set s = {0};
    clast_porosity_model m = {0};
    char words[256];
    read_text("FL,EL\n0.6,0.7\n0.05,0.05\n", &t);
    CHECK_OK(clast_form_set_of(&t, NULL, &s));
    CHECK_OK(clast_porosity_model_published(0, &m));
    assert_string_equal(clast_porosity_beds_words(&m, &beds, sizeof words, words), "");
    CHECK_OK(clast_porosity_predict_each(&m, &s, &beds));
    assert_true(clast_table_numbers(&beds, "porosity")[0] > 0.0);
    for (int c = 1; c < 3; ++c) {
        assert_true(isnan(beds.column[c].number[1]) != 0);
    }
    assert_non_null(strstr(clast_porosity_beds_words(&m, &beds, sizeof words, words),
                           "1 of 2 beds have no porosity (first: row 2): model single_form_U1"));
    clast_table_free(&beds);
    clast_porosity_model_free(&m);
    clast_form_set_free(&s);
    clast_table_free(&t);
}

/* Needles: the model answers above 1, which is refused. */
static void impossible_porosities_are_refused(void **state)
{
    (void)state;
    const double mean[2] = {0.1, 0.1};
    clast_form_inputs in = {0};
    clast_prediction p = {.porosity = -7.0};
    clast_porosity_model m = {0};
    CHECK_OK(clast_form_inputs_from_moments(mean, NULL, 0, &in));
    CHECK_OK(clast_porosity_model_published(0, &m));
    CHECK_STATUS(clast_porosity_predict_moments(&m, &in, &p), CLAST_E_LIMIT);
    CHECK_ABS(p.porosity, -7.0, 0.0);
    clast_porosity_model_free(&m);
}

/* The derivatives' sampling error of one mean: d(0.019 / (FL EL)) / dFL = -0.019 / (FL^2 EL). */
static void sampling_error_is_the_first_derivative(void **state)
{
    (void)state;
    const double mean[2] = {0.6, 0.7};
    const double deviation[2] = {0.15, 0.0};
    clast_form_inputs in = {0};
    clast_prediction p = {0};
    clast_porosity_model m = {0};
    CHECK_OK(clast_form_inputs_from_moments(mean, deviation, 100, &in));
    CHECK_OK(clast_porosity_model_published(0, &m));
    CHECK_OK(clast_porosity_predict_moments(&m, &in, &p));
    CHECK_REL(p.sampling_error, 0.019 / (0.36 * 0.7) * 0.015, 1e-6);
    /* without a number of grains it is not known: it was 0, "no sampling error" to a script */
    CHECK_OK(clast_form_inputs_from_moments(mean, deviation, 0, &in));
    CHECK_OK(clast_porosity_predict_moments(&m, &in, &p));
    assert_true(isnan(p.sampling_error) && isfinite(p.standard_error));
    clast_porosity_model_free(&m);
}

/* Eq. 23 written out, for the next test. */
static double eq_23(const double v[4])
{
    const double eq = v[0] * v[1];
    const double s_eq = sqrt((v[1] * v[1] + v[3] * v[3]) * (v[0] * v[0] + v[2] * v[2]) - eq * eq);
    return 0.032 / eq - 0.003 / s_eq + 0.011 / v[1] + 0.287;
}

/* A mixture's error: means vary by s / sqrt(n), deviations by s / sqrt(2 (n - 1)); the slopes here
 * are central differences of eq. 23 (1e-6 relative for steps of 1e-4). */
static void sampling_error_of_a_mixture_counts_its_deviations(void **state)
{
    (void)state;
    const double v[4] = {0.647, 0.682, 0.175, 0.139};
    const double error[4] = {0.175 / sqrt(20.0), 0.139 / sqrt(20.0), 0.175 / sqrt(38.0),
                             0.139 / sqrt(38.0)};
    double sum = 0.0;
    clast_form_inputs in = {0};
    clast_prediction p = {0};
    clast_porosity_model m = {0};
    for (int k = 0; k < 4; ++k) {
        double low[4] = {v[0], v[1], v[2], v[3]};
        double high[4] = {v[0], v[1], v[2], v[3]};
        low[k] -= 1e-4;
        high[k] += 1e-4;
        const double slope = (eq_23(high) - eq_23(low)) / 2e-4;
        sum += slope * slope * error[k] * error[k];
    }
    CHECK_OK(clast_form_inputs_from_moments(v, v + 2, 20, &in));
    CHECK_OK(clast_porosity_model_published(3, &m));
    CHECK_OK(clast_porosity_predict_moments(&m, &in, &p));
    CHECK_REL(p.sampling_error, sqrt(sum), 1e-5);
    clast_porosity_model_free(&m);
}

/* The bootstrap knows the same error, from 400 grains, to its own 1000 resamples (2.2 %, one
 * deviation) and the sample's: 12 %. */
static void bootstrap_agrees_with_the_derivatives(void **state)
{
    (void)state;
    const clast_bootstrap b = {.n_resample = 1000, .level = 0.95, .seed = 1};
    static char text[32768] = "FL,EL\n";
    clast_table t = {0};
    clast_form_set s = {0};
    clast_form_inputs in = {0};
    clast_prediction boot = {0};
    clast_prediction linear = {0};
    clast_porosity_model m = {0};
    for (int i = 0; i < 400;
         ++i) { /* a 20 x 20 grid of normal quantiles, mean 0.6, deviation 0.1 */
        static const double z[10] = {0.0627, 0.189, 0.319, 0.454, 0.598,
                                     0.755,  0.935, 1.15,  1.44,  1.96};
        const int j = i / 20;
        const int k = i % 20;
        const size_t n = strlen(text);
        (void)snprintf(text + n, sizeof text - n, "%.6f,%.6f\n",
                       0.6 + 0.1 * (j < 10 ? -z[j] : z[j - 10]),
                       0.65 + 0.1 * (k < 10 ? -z[k] : z[k - 10]));
    }
    read_text(text, &t);
    CHECK_OK(clast_form_set_of(&t, NULL, &s));
    CHECK_OK(clast_porosity_model_published(0, &m));
    CHECK_OK(clast_porosity_predict_set(&m, &s, &b, &in, &boot));
    const double mean[2] = {in.flatness_mean, in.elongation_mean};
    const double deviation[2] = {in.flatness_deviation, in.elongation_deviation};
    clast_form_inputs moments = {0};
    CHECK_OK(clast_form_inputs_from_moments(mean, deviation, 400, &moments));
    CHECK_OK(clast_porosity_predict_moments(&m, &moments, &linear));
    CHECK_REL(boot.sampling_error, linear.sampling_error, 0.12);
    CHECK_REL(boot.porosity, linear.porosity, 1e-13);
    clast_porosity_model_free(&m);
    clast_form_set_free(&s);
    clast_table_free(&t);
}

static void model_files_come_back_bit_for_bit(void **state)
{
    (void)state;
    static const char *const note[1][2] = {{"table", "beds.csv"}};
    clast_porosity_model m = {0};
    clast_porosity_model back = {0};
    const char *path = support_scratch_file("model.json");
    CHECK_OK(clast_porosity_model_published(4, &m));
    CHECK_OK(clast_porosity_model_write(&m, note, 1, path));
    CHECK_OK(clast_porosity_model_read(path, &back));
    assert_string_equal(back.name, m.name);
    assert_int_equal(back.kind, m.kind);
    assert_int_equal(back.n_bed, 52);
    CHECK_ABS(back.deviation, m.deviation, 0.0);
    CHECK_ABS(back.r2, m.r2, 0.0);
    assert_true(isnan(back.cv_median_error));
    for (int32_t k = 0; k < m.n_term; ++k) {
        assert_string_equal(back.term[k].feature, m.term[k].feature);
        CHECK_ABS(back.term[k].coefficient, m.term[k].coefficient, 0.0);
        CHECK_ABS(back.range[k].high, m.range[k].high, 0.0);
    }
    clast_porosity_model_free(&back);
    clast_porosity_model_free(&m);
    CHECK_STATUS(clast_porosity_model_read("no/such.json", &m), CLAST_E_IO);
}

#define HEAD                                                                                       \
    "{\"format\": \"clast porosity model\", \"version\": 1, \"name\": \"n\", \"source\": \"s\", "
#define KIND  "\"kind\": \"single_form\", "
#define BODY  "\"intercept\": 0.3, \"deviation\": 0.01, "
#define TERM  "\"terms\": [{\"feature\": \"equancy\", \"coefficient\": -0.1}], "
#define RANGE "\"ranges\": [{\"feature\": \"equancy\", \"low\": 0.1, \"high\": 1}]"
#define GOOD  HEAD KIND BODY TERM RANGE "}"

static void damaged_model_files_are_refused(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "",
        "[]",
        "{}",
        "{\"format\": 3}",
        "nonsense",
        HEAD KIND BODY TERM RANGE ", \"colour\": 1}",
        HEAD "\"kind\": \"cubic\", " BODY TERM RANGE "}",
        HEAD KIND "\"intercept\": \"a\", \"deviation\": 0.01, " TERM RANGE "}",
        HEAD KIND "\"intercept\": 0.3, \"deviation\": -1, " TERM RANGE "}",
        HEAD KIND BODY "\"terms\": 3, " RANGE "}",
        HEAD KIND BODY "\"terms\": [3], " RANGE "}",
        HEAD KIND BODY "\"terms\": [{\"feature\": \"beauty\", \"coefficient\": 1}], " RANGE "}",
        HEAD KIND BODY "\"terms\": [{\"feature\": \"equancy\"}], " RANGE "}",
        HEAD KIND BODY
        "\"terms\": [{\"feature\": \"equancy\", \"coefficient\": 1, \"unit\": 3}], " RANGE "}",
        HEAD KIND BODY TERM "\"ranges\": [{\"feature\": \"equancy\", \"low\": 2, \"high\": 1}]}",
        HEAD KIND BODY TERM RANGE ", \"covariance\": [[1]]}",
        HEAD KIND BODY TERM RANGE ", \"covariance\": [[1, 2], [3, 4]]}",
        HEAD KIND BODY TERM RANGE ", \"covariance\": [[1, 0], [0, -4]]}",
        HEAD KIND BODY TERM RANGE ", \"version\": 2}",
    };
    clast_porosity_model m = {0};
    CHECK_OK(clast_porosity_model_parse("good", GOOD, strlen(GOOD), &m));
    CHECK_REL(m.term[0].coefficient, -0.1, 0.0);
    assert_null(m.term[0].unit); // a file of before
    clast_porosity_model_free(&m);
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        CHECK_STATUS(clast_porosity_model_parse("bad", bad[k], strlen(bad[k]), &m), CLAST_E_FORMAT);
        assert_null(m.term);
    }
    for (size_t n = 0; n < strlen(GOOD); ++n) { /* cut at every byte */
        CHECK_STATUS(clast_porosity_model_parse("cut", GOOD, n, &m), CLAST_E_FORMAT);
    }
}

static void each_row_may_be_a_bed(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_table beds = {0};
    clast_form_set s = {0};
    clast_porosity_model m = {0};
    read_text("FL,EL\n0.6,0.7\n,0.7\n0.9,0.8\n", &t);
    CHECK_OK(clast_form_set_of(&t, NULL, &s));
    CHECK_OK(clast_porosity_model_published(1, &m));
    CHECK_OK(clast_porosity_predict_each(&m, &s, &beds));
    assert_int_equal(beds.n_row, 2);
    CHECK_REL(clast_table_numbers(&beds, "row")[1], 3.0, 0.0);
    CHECK_REL(clast_table_numbers(&beds, "porosity")[1], 0.014 / 0.72 + 0.007 / 0.8 + 0.234, 1e-14);
    clast_table_free(&beds);
    clast_porosity_model_free(&m);
    CHECK_OK(clast_porosity_model_published(3, &m));
    CHECK_STATUS(clast_porosity_predict_each(&m, &s, &beds), CLAST_E_USAGE);
    clast_porosity_model_free(&m);
    clast_form_set_free(&s);
    clast_table_free(&t);
}

static clast_status predict_all(void *context)
{
    const clast_bootstrap b = {.n_resample = 5, .level = 0.95, .seed = 1};
    clast_form_set s = {0};
    clast_form_inputs in = {0};
    clast_prediction p = {0};
    clast_porosity_model m = {0};
    clast_table out = {0};
    clast_status status = clast_form_set_of(context, NULL, &s);
    status = status == CLAST_OK ? clast_porosity_model_published(3, &m) : status;
    status = status == CLAST_OK ? clast_porosity_predict_set(&m, &s, &b, &in, &p) : status;
    status = status == CLAST_OK ? clast_form_set_factors(&s, &out) : status;
    clast_table_free(&out);
    clast_porosity_model_free(&m);
    clast_form_set_free(&s);
    return status;
}

static void every_refused_allocation_is_told(void **state)
{
    (void)state;
    clast_table t = {0};
    read_text("FL,EL\n0.6,0.7\n0.5,0.8\n0.9,0.8\n", &t);
    support_refuse_each_allocation(predict_all, &t);
    clast_table_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rhine_bed_is_that_of_table_11),
        cmocka_unit_test(spheres_have_the_sum_of_the_coefficients),
        cmocka_unit_test(table_and_moments_agree_for_independent_forms),
        cmocka_unit_test(features_have_104_names),
        cmocka_unit_test(tables_of_every_kind_are_understood),
        cmocka_unit_test(tables_without_forms_are_refused),
        cmocka_unit_test(sizes_have_the_unit_of_their_column),
        cmocka_unit_test(a_unit_of_any_length_is_none),
        cmocka_unit_test(complaint_counts_by_reason),
        cmocka_unit_test(equal_grains_have_no_mixture),
        cmocka_unit_test(equal_grains_have_no_deviation),
        cmocka_unit_test(a_given_deviation_of_rounding_is_none),
        cmocka_unit_test(an_index_that_vanishes_has_no_spread),
        cmocka_unit_test(equal_grains_have_no_sampling_error),
        cmocka_unit_test(a_bed_without_a_porosity_is_nan),
        cmocka_unit_test(impossible_porosities_are_refused),
        cmocka_unit_test(sampling_error_is_the_first_derivative),
        cmocka_unit_test(sampling_error_of_a_mixture_counts_its_deviations),
        cmocka_unit_test(bootstrap_agrees_with_the_derivatives),
        cmocka_unit_test(model_files_come_back_bit_for_bit),
        cmocka_unit_test(damaged_model_files_are_refused),
        cmocka_unit_test(each_row_may_be_a_bed),
        cmocka_unit_test(every_refused_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
