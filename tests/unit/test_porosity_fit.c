/* Unit: fitted porosity models against R 4.2.2 and closed forms.
 *
 *   i <- 0:39; a <- 1 + 0.1 * i; b <- sin(i); c <- a^2 + cos(2 * i)
 *   y <- 0.3 + 0.02 * a - 0.05 * b + 0.001 * c + 0.01 * sin(17 * i * i); m <- lm(y ~ a + b + c)
 *   cooks.distance(m); rstudent(m); summary(m)$coefficients[, 4]
 *   1 / (1 - summary(lm(a ~ b + c))$r.squared)                            (variance inflation of a)
 */
#include "support.h"

#include "math/rng.h"
#include <clast/porosity_model.h>
#include <clast/table.h>
#include <stdio.h>
#include <string.h>

enum { N = 40 };

static clast_porosity_fit_config usual(void)
{
    clast_porosity_fit_config c;
    CHECK_OK(clast_fields_default(clast_porosity_fit_fields, &c));
    return c;
}

static void set_use(clast_porosity_fit_config *c, const char *use)
{
    CHECK_OK(clast_field_set(clast_fields_find(clast_porosity_fit_fields, "use"), c, use, false));
}

static void add_column(clast_table *t, const char *name, double (*value)(int i))
{
    double *v = NULL;
    CHECK_OK(clast_table_add_number(t, name, "-", &v));
    for (int64_t i = 0; i < t->n_row; ++i) {
        v[i] = value((int)i);
    }
}

static double col_a(int i)
{
    return 1.0 + 0.1 * i;
}

static double col_b(int i)
{
    return sin(i);
}

static double col_c(int i)
{
    return col_a(i) * col_a(i) + cos(2.0 * i);
}

static double col_y(int i)
{
    return 0.3 + 0.02 * col_a(i) - 0.05 * col_b(i) + 0.001 * col_c(i) + 0.01 * sin(17.0 * i * i);
}

static double col_same(int i)
{
    (void)i;
    return 7.0;
}

static double col_gap(int i)
{
    return i == 4 ? (double)NAN : cos(i);
}

static double col_share(int i)
{
    return 0.4 + 0.05 * sin(i) + 0.01 * sin(17.0 * i * i);
}

static double col_tenth(int i)
{
    (void)i;
    return 0.1;
}

static double col_ulp(int i)
{
    return 0.1 * (1.0 + (i % 3) * 0x1p-52);
}

/* S / L of a form whose I is (L + S) / 2. */
static double middle_ratio(int i)
{
    return 0.2 + 0.01 * i + 0.1 * sin(i);
}

static double col_middle_flatness(int i)
{
    return middle_ratio(i) / (0.5 * (1.0 + middle_ratio(i)));
}

static double col_middle_elongation(int i)
{
    return 0.5 * (1.0 + middle_ratio(i));
}

static void make_beds(clast_table *t)
{
    CHECK_OK(clast_table_init(t, "beds", N));
    add_column(t, "porosity", col_y);
    add_column(t, "a", col_a);
    add_column(t, "b", col_b);
    add_column(t, "c", col_c);
}

static void diagnostics_match_r(void **state)
{
    (void)state;
    static const int row[4] = {0, 1, 20, 39};
    static const double cook[4] = {0.016648657117721496, 0.079712498217128447, 0.032738676388355897,
                                   0.073322203845526457};
    static const double studentised[4] = {0.44649835147171513, -1.36744972261344699,
                                          0.97109481984004931, 1.18166524163340969};
    static const double vif[4] = {0.0, 24.5686984539405096, 1.0053876808100404,
                                  24.5483626526112495};
    static const double p[4] = {6.1081652902493993e-33, 8.4091937048367101e-06,
                                2.1682766434338329e-27, 7.5016100832753874e-01};
    clast_porosity_fit_config c = usual();
    clast_table t = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    make_beds(&t);
    set_use(&c, "a,b,c");
    CHECK_OK(clast_fit_data_columns(&t, &c, &d));
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    for (int k = 0; k < 4; ++k) {
        CHECK_REL(clast_table_numbers(&f.rows, "cook")[row[k]], cook[k], 1e-10);
        CHECK_REL(clast_table_numbers(&f.rows, "studentised")[row[k]], studentised[k], 1e-10);
        CHECK_REL(clast_table_numbers(&f.terms, "p")[k], p[k], 1e-8);
        if (k > 0) {
            CHECK_REL(clast_table_numbers(&f.terms, "vif")[k], vif[k], 1e-10);
        }
    }
    CHECK_REL(f.model.r2, 9.7984626459780355e-01, 1e-12);
    CHECK_REL(f.model.deviation, sqrt(5.0879531319717774e-05), 1e-11);
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

/* By the rule: c has r = 0.71.. with y? whichever leads, a and c are alike (r > 0.97), so the
 * second feature must be b, and the third cannot be had at a limit of 0.8. */
static void like_features_are_removed(void **state)
{
    (void)state;
    clast_porosity_fit_config c = usual();
    clast_table t = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    make_beds(&t);
    add_column(&t, "same", col_same);
    c.n_term = 3;
    CHECK_OK(clast_fit_data_columns(&t, &c, &d));
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    assert_int_equal(f.model.n_term, 2);
    assert_int_equal(f.n_removed, 1);
    int found = 0;
    for (int64_t k = 0; k < f.ranking.n_row; ++k) {
        const char *name = f.ranking.column[0].text[k];
        const char *is = f.ranking.column[3].text[k];
        found += strcmp(name, "same") == 0 && strcmp(is, "constant") == 0 ? 1 : 0;
        found += strncmp(is, "removed: like ", 14) == 0 ? 1 : 0;
        found += strcmp(name, "b") == 0 && strcmp(is, "chosen") == 0 ? 1 : 0;
    }
    assert_int_equal(found, 3);
    clast_porosity_fit_free(&f);
    c.correlation_limit = 1.0; /* nothing is removed: all three join */
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    assert_int_equal(f.model.n_term, 3);
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

/* Flatness and elongation of 63 beds, seeded, in the paper's ranges. */
static void make_forms(clast_table *t, double noise)
{
    double *fl = NULL;
    double *el = NULL;
    double *y = NULL;
    CHECK_OK(clast_table_init(t, "forms", 63));
    CHECK_OK(clast_table_add_number(t, "flatness", "-", &fl));
    CHECK_OK(clast_table_add_number(t, "elongation", "-", &el));
    CHECK_OK(clast_table_add_number(t, "porosity", "-", &y));
    fl = clast_table_numbers(t, "flatness");
    el = clast_table_numbers(t, "elongation");
    for (int i = 0; i < 63; ++i) {
        clx_rng rng = clx_rng_at(17, CLX_STREAM_TEST, (uint64_t)i);
        fl[i] = 0.3 + 0.65 * clx_rng_uniform(&rng);
        el[i] = 0.45 + 0.5 * clx_rng_uniform(&rng);
        y[i] = 0.278 + 0.019 / (fl[i] * el[i]) + 0.014 / el[i] + noise * clx_rng_normal(&rng);
    }
}

/* Data made by eq. 17 without noise: features and coefficients come back. */
static void equation_17_is_found(void **state)
{
    (void)state;
    clast_porosity_fit_config c = usual();
    clast_table t = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    make_forms(&t, 0.0);
    CHECK_OK(clast_fit_data_single(&t, &c, &d));
    assert_int_equal(d.beds.n_column, 2 + 26);
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    assert_string_equal(f.model.term[0].feature, "inverse_equancy");
    assert_string_equal(f.model.term[1].feature, "inverse_elongation");
    CHECK_ABS(f.model.intercept, 0.278, 1e-12);
    CHECK_ABS(f.model.term[0].coefficient, 0.019, 1e-12);
    CHECK_ABS(f.model.term[1].coefficient, 0.014, 1e-12);
    CHECK_ABS(f.model.cv_mean_error, 0.0, 1e-12);
    assert_int_equal(f.model.n_range, 4); /* both terms, flatness, elongation */
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

/* With noise of 0.005 the coefficients stay within 4 of their standard errors, and 63 residuals
 * know the noise to 1 / sqrt(2 * 60) = 9 %, 4 deviations 37 %. */
static void noise_is_measured(void **state)
{
    (void)state;
    clast_porosity_fit_config c = usual();
    clast_table t = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    make_forms(&t, 0.005);
    set_use(&c, "inverse_equancy,inverse_elongation");
    CHECK_OK(clast_fit_data_single(&t, &c, &d));
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    const double *e = clast_table_numbers(&f.terms, "standard_error");
    CHECK_ABS(f.model.term[0].coefficient, 0.019, 4.0 * e[1]);
    CHECK_ABS(f.model.term[1].coefficient, 0.014, 4.0 * e[2]);
    CHECK_REL(f.model.deviation, 0.005, 0.37);
    /* mean |error| of a normal is sqrt(2 / pi) s; held out it is a little more */
    CHECK_REL(f.model.cv_mean_error, sqrt(2.0 / CLAST_PI) * 0.005, 0.40);
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

/* Ten beds of five grains, porosity linear in two mixture features: they are found exactly. */
static void mixtures_are_grouped_by_bed(void **state)
{
    (void)state;
    clast_porosity_fit_config c = usual();
    clast_table beds = {0};
    clast_table grains = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    static char text[2][16384];
    int n[2] = {0};
    n[0] = snprintf(text[0], sizeof text[0], "bed,porosity\nlonely,0.3\n");
    n[1] = snprintf(text[1], sizeof text[1], "bed,flatness,elongation\nlonely,0.5,0.5\n");
    for (int b = 0; b < 30; ++b) {
        double sum = 0.0;
        for (int g = 0; g < 5; ++g) {
            const double fl = 0.45 + 0.01 * b + 0.08 * sin(3.0 * g + b);
            const double el = 0.6 + 0.05 * sin(1.7 * b) + 0.07 * cos(2.0 * g + b);
            sum += fl * el / 5.0;
            n[1] += snprintf(text[1] + n[1], sizeof text[1] - (size_t)n[1], "b%d,%.17g,%.17g\n", b,
                             fl, el);
        }
        n[0] += snprintf(text[0] + n[0], sizeof text[0] - (size_t)n[0], "b%d,%.17g\n", b,
                         0.25 + 0.03 / sum);
    }
    CHECK_OK(clast_table_parse_csv("beds", text[0], (size_t)n[0], NULL, &beds, NULL));
    CHECK_OK(clast_table_parse_csv("grains", text[1], (size_t)n[1], NULL, &grains, NULL));
    CHECK_OK(clast_fit_data_mixture(&beds, &grains, &c, &d));
    assert_int_equal(d.beds.n_column, 2 + 104);
    assert_int_equal(d.beds.n_row, 30);
    assert_int_equal(d.left_out.n_row, 1);
    assert_string_equal(d.left_out.column[1].text[0], "fewer than two grains");
    c.n_term = 1;
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    assert_string_equal(f.model.term[0].feature, "inverse_mean_equancy");
    CHECK_ABS(f.model.term[0].coefficient, 0.03, 1e-12);
    CHECK_ABS(f.model.intercept, 0.25, 1e-12);
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&beds);
    clast_table_free(&grains);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

/* Bad porosities, gaps and forms: the rows are told, the fit is that of the rest. */
static void bad_rows_change_nothing(void **state)
{
    (void)state;
    static const char text[] = "porosity,a\n0.30,1\n0.31,2\n0.32,3.1\n0.33,4\n1.5,5\n,6\n0.35,\n"
                               "0.34,5\n0.36,inf\n-0.1,3\n";
    clast_porosity_fit_config c = usual();
    clast_table t = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    c.n_fold = 5;
    CHECK_OK(clast_table_parse_csv("beds", text, sizeof text - 1, NULL, &t, NULL));
    CHECK_OK(clast_fit_data_columns(&t, &c, &d));
    assert_int_equal(d.beds.n_row, 5);
    assert_int_equal(d.left_out.n_row, 5);
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    for (int64_t i = 0; i < 5; ++i) {
        assert_true(isfinite(clast_table_numbers(&f.rows, "held_out")[i]));
    }
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

static void hopeless_tables_are_refused(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "porosity\n0.3\n0.31\n0.32\n0.33\n0.34\n",                /* nothing to fit with */
        "a,b\n1,2\n",                                             /* no porosity */
        "porosity,a\n0.3,1\n0.31,2\n",                            /* too few beds */
        "porosity,a\n0.3,1\n0.3,2\n0.3,3\n0.3,4\n0.3,5\n0.3,6\n", /* the same porosity */
        "porosity,a\n0.3,7\n0.31,7\n0.32,7\n0.33,7\n0.34,7\n",    /* a constant column alone */
        "porosity,a\nx,7\n0.31,8\n",                              /* words */
    };
    clast_porosity_fit_config c = usual();
    c.n_fold = 5;
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        clast_table t = {0};
        clast_fit_data d = {0};
        clast_porosity_fit f = {0};
        CHECK_OK(clast_table_parse_csv("beds", bad[k], strlen(bad[k]), NULL, &t, NULL));
        clast_status status = clast_fit_data_columns(&t, &c, &d);
        if (status == CLAST_OK) {
            status = clast_porosity_fit_data(&d, "m", "test", &c, &f);
        }
        CHECK_STATUS(status, CLAST_E_FORMAT);
        assert_null(f.rows.column);
        clast_fit_data_free(&d);
        clast_table_free(&t);
    }
    clast_fields_free(clast_porosity_fit_fields, &c);
}

static void columns_with_gaps_are_no_candidates(void **state)
{
    (void)state;
    clast_porosity_fit_config c = usual();
    clast_table t = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    CHECK_OK(clast_table_init(&t, "beds", N));
    add_column(&t, "porosity", col_y);
    add_column(&t, "a", col_a);
    add_column(&t, "b", col_b);
    CHECK_OK(clast_fit_data_columns(&t, &c, &d));
    add_column(&d.beds, "gap", col_gap); /* as an undefined form factor would be */
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    int found = 0;
    for (int64_t k = 0; k < f.ranking.n_row; ++k) {
        found += strcmp(f.ranking.column[3].text[k], "not finite in some row") == 0 ? 1 : 0;
    }
    assert_int_equal(found, 1);
    set_use(&c, "gap");
    clast_porosity_fit g = {0};
    CHECK_STATUS(clast_porosity_fit_data(&d, "m", "test", &c, &g), CLAST_E_FORMAT);
    set_use(&c, "nothing");
    CHECK_STATUS(clast_porosity_fit_data(&d, "m", "test", &c, &g), CLAST_E_FORMAT);
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

/* 40 columns of noise on 30 beds: two of them, selected with the held-out beds, gave R2 0.47 and
 * terms at p 0.003. */
static void noise_is_no_model(void **state)
{
    (void)state;
    clast_porosity_fit_config c = usual();
    int n_significant = 0;
    int n_claimed = 0;
    double held_out = 0.0;
    double published = 0.0;
    for (int set = 0; set < 20; ++set) {
        clast_table t = {0};
        clast_fit_data d = {0};
        clast_porosity_fit f = {0};
        CHECK_OK(clast_table_init(&t, "noise", 30));
        for (int col = 0; col <= 40; ++col) {
            char name[16];
            double *v = NULL;
            (void)snprintf(name, sizeof name, col == 0 ? "porosity" : "x%d", col);
            CHECK_OK(clast_table_add_number(&t, name, "-", &v));
            for (int i = 0; i < 30; ++i) {
                clx_rng rng =
                    clx_rng_at((uint64_t)(100 + set), CLX_STREAM_TEST, (uint64_t)(col * 30 + i));
                v[i] = 0.4 + 0.02 * clx_rng_normal(&rng);
            }
        }
        c.n_permutation = 39;
        CHECK_OK(clast_fit_data_columns(&t, &c, &d));
        CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
        n_significant += f.p_value <= 0.05 ? 1 : 0;
        held_out += f.r2_held_out / 20.0;
        assert_true(isnan(clast_table_numbers(&f.terms, "p")[1]));
        clast_porosity_fit_free(&f);
        c.n_permutation = 0;
        c.validation = CLAST_VALIDATION_PUBLISHED;
        CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
        published += f.model.r2 / 20.0;
        assert_true(isnan(f.p_value));
        n_claimed += clast_table_numbers(&f.terms, "p")[1] < 0.05 ? 1 : 0;
        clast_porosity_fit_free(&f);
        c.validation = CLAST_VALIDATION_NESTED;
        clast_fit_data_free(&d);
        clast_table_free(&t);
    }
    assert_true(n_significant <= 4); /* 1 expected; more than 4 of 20 has a chance of 0.3 % */
    assert_true(held_out < 0.0);
    assert_true(published > 0.3);
    assert_true(n_claimed >= 15);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

static int count_states(const clast_porosity_fit *f, const char *name, const char *is)
{
    int n = 0;
    for (int64_t k = 0; k < f->ranking.n_row; ++k) {
        const char *feature = f->ranking.column[0].text[k];
        n += strncmp(feature, name, strlen(name)) == 0 &&
             strcmp(f->ranking.column[3].text[k], is) == 0;
    }
    return n;
}

/* Beds of 67 equal grains each: rounding of their means was a deviation of 1e-15, features with
 * coefficients of 1e12 and among the chosen. */
static void beds_of_one_form_have_no_deviation(void **state)
{
    (void)state;
    enum { N_BED = 12, N_GRAIN = 67 };
    clast_porosity_fit_config c = usual();
    clast_table beds = {0};
    clast_table grains = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    double *column[5] = {NULL};
    CHECK_OK(clast_table_init(&beds, "beds", N_BED));
    CHECK_OK(clast_table_add_number(&beds, "bed", "-", &column[0]));
    CHECK_OK(clast_table_add_number(&beds, "porosity", "-", &column[1]));
    CHECK_OK(clast_table_init(&grains, "grains", N_BED * N_GRAIN));
    CHECK_OK(clast_table_add_number(&grains, "bed", "-", &column[2]));
    CHECK_OK(clast_table_add_number(&grains, "flatness", "-", &column[3]));
    CHECK_OK(clast_table_add_number(&grains, "elongation", "-", &column[4]));
    for (int b = 0; b < N_BED; ++b) {
        column[0][b] = b;
        column[1][b] = 0.35 + 0.01 * sin(3.7 * b);
        for (int i = b * N_GRAIN; i < (b + 1) * N_GRAIN; ++i) {
            column[2][i] = b;
            column[3][i] = 0.3 + 0.05 * b;
            column[4][i] = 0.9 - 0.03 * ((5 * b) % 7);
        }
    }
    c.n_permutation = 0;
    CHECK_OK(clast_fit_data_mixture(&beds, &grains, &c, &d));
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    assert_int_equal(count_states(&f, "deviation_", "constant"), CLAST_N_FORM_FEATURE);
    assert_int_equal(count_states(&f, "inverse_deviation_", "not finite in some row"),
                     CLAST_N_FORM_FEATURE);
    for (int32_t k = 0; k < f.model.n_term; ++k) {
        assert_null(strstr(f.model.term[k].feature, "deviation_"));
    }
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&beds);
    clast_table_free(&grains);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

/* The rounding of a sum of 20000 equal numbers exceeds 64 eps of them; so does a spread of it. */
static void columns_of_rounding_are_constant(void **state)
{
    (void)state;
    enum { MANY = 20000 };
    clast_porosity_fit_config c = usual();
    clast_table t = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    CHECK_OK(clast_table_init(&t, "beds", MANY));
    add_column(&t, "porosity", col_share);
    add_column(&t, "a", col_b);
    add_column(&t, "equal", col_tenth);
    add_column(&t, "ulp", col_ulp);
    c.n_fold = 2;
    c.n_permutation = 0;
    c.validation = CLAST_VALIDATION_PUBLISHED;
    CHECK_OK(clast_fit_data_columns(&t, &c, &d));
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    assert_int_equal(count_states(&f, "equal", "constant"), 1);
    assert_int_equal(count_states(&f, "ulp", "constant"), 1);
    assert_int_equal(f.model.n_term, 1);
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

/* Forms with I = (L + S) / 2: their oblate-prolate index is 0, rounding besides. */
static void an_index_of_rounding_is_constant(void **state)
{
    (void)state;
    clast_porosity_fit_config c = usual();
    clast_table t = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    CHECK_OK(clast_table_init(&t, "beds", N));
    add_column(&t, "porosity", col_y);
    add_column(&t, "flatness", col_middle_flatness);
    add_column(&t, "elongation", col_middle_elongation);
    c.n_permutation = 0;
    CHECK_OK(clast_fit_data_single(&t, &c, &d));
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    assert_int_equal(count_states(&f, "oblate_prolate_index", "constant"), 1);
    assert_int_equal(count_states(&f, "disc_rod_index", "constant"), 1);
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

static const double *candidate(const clast_fit_data *d, const char *name)
{
    return clast_table_numbers(&d->beds, name);
}

/* A study's table: the seed was the feature of most correlation, and a varied size, a text with a
 * unit, was no candidate without a word. */
static void candidates_of_a_study_are_what_was_varied(void **state)
{
    (void)state;
    static const char text[] = "run,size,share,domain,mixed,bare,seed,exit_code,mass,porosity\n"
                               "1,100um,5 %,box,1mm,1mm,1,0,1,0.30\n"
                               "2,0.2mm,10%,box,2s,2,2,0,2,0.31\n"
                               "3,0,2.5%,cylinder,3mm,3mm,3,0,3,0.33\n";
    static const double size[3] = {100e-6, 200e-6, 0.0};
    static const double share[3] = {0.05, 0.1, 0.025};
    clast_porosity_fit_config c = usual();
    clast_table t = {0};
    clast_fit_data d = {0};
    CHECK_OK(clast_table_parse_csv("results", text, sizeof text - 1, NULL, &t, NULL));
    CHECK_OK(clast_fit_data_columns(&t, &c, &d));
    assert_int_equal(d.beds.n_column, 2 + 2);
    assert_string_equal(d.beds.column[2].unit, "m");
    for (int i = 0; i < 3; ++i) {
        CHECK_REL(candidate(&d, "size")[i], size[i], 1e-15);
        CHECK_REL(candidate(&d, "share")[i], share[i], 1e-15);
    }
    clast_fit_data_free(&d);
    set_use(&c, "mass"); /* what is named joins, what was varied stays */
    CHECK_OK(clast_fit_data_columns(&t, &c, &d));
    assert_int_equal(d.beds.n_column, 2 + 3);
    assert_null(candidate(&d, "seed"));
    clast_fit_data_free(&d);
    set_use(&c, "");
    CHECK_OK(clast_field_set(clast_fields_find(clast_porosity_fit_fields, "columns"), &c,
                             "size,seed", false));
    CHECK_OK(clast_fit_data_columns(&t, &c, &d)); /* named, even a seed is one */
    assert_int_equal(d.beds.n_column, 2 + 2);
    clast_fit_data_free(&d);
    assert_non_null(t.column[1].text); /* the table itself is as it was */
    assert_null(t.column[1].number);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

/* The command and Python held each of these rules for itself. */
static void features_are_chosen_by_the_columns(void **state)
{
    (void)state;
    static const struct {
        const char *header, *columns;
        bool has_grains;
        clast_model_kind kind;
        const char *says;
    } row[] = {
        {"flatness,elongation,porosity", "", false, CLAST_MODEL_SINGLE, ""},
        {"flatness,elongation,porosity", "", true, CLAST_MODEL_MIXTURE, ""},
        {"mu,sand,porosity", "", false, CLAST_MODEL_COLUMNS, ""},
        {"mean FL,mean EL,porosity", "mean FL,mean EL", false, CLAST_MODEL_SINGLE, ""},
        {"mu,sand,porosity", "mu", false, CLAST_MODEL_COLUMNS, ""},
        {"mu,sand,porosity", "mu,sand", false, CLAST_MODEL_COLUMNS,
         "columns mu,sand are candidates; --features form takes them as a form"},
        {"mu,sand,porosity", "mu,sand", true, CLAST_MODEL_MIXTURE, ""},
    };
    for (size_t k = 0; k < sizeof row / sizeof *row; ++k) {
        char text[128];
        const int n = snprintf(text, sizeof text, "%s\n0.5,0.6,0.3\n", row[k].header);
        clast_porosity_fit_config c = usual();
        clast_table t = {0};
        clast_fit_note note;
        clast_model_kind kind = CLAST_MODEL_COLUMNS;
        CHECK_OK(clast_field_set(clast_fields_find(clast_porosity_fit_fields, "columns"), &c,
                                 row[k].columns, false));
        CHECK_OK(clast_table_parse_csv("beds", text, (size_t)n, NULL, &t, NULL));
        CHECK_OK(clast_porosity_fit_choose(&t, row[k].has_grains, &c, &kind, &note));
        assert_int_equal(kind, row[k].kind);
        assert_string_equal(note.text, row[k].says);
        clast_table_free(&t);
        clast_fields_free(clast_porosity_fit_fields, &c);
    }
}

/* With features named, a gap in another column cost the row (periodic beds have no wall_ratio). */
static void only_features_in_use_cost_a_row(void **state)
{
    (void)state;
    static const char text[] = "porosity,a,wall_ratio\n0.30,1,\n0.31,2,7\n0.32,3,\n0.33,,8\n"
                               "0.34,5.5,9\n,6,4\n0.36,7,\n";
    clast_porosity_fit_config c = usual();
    clast_table t = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    CHECK_OK(clast_table_parse_csv("beds", text, sizeof text - 1, NULL, &t, NULL));
    CHECK_OK(clast_fit_data_columns(&t, &c, &d));
    assert_int_equal(d.beds.n_row, 2);
    clast_fit_data_free(&d);
    set_use(&c, "a");
    c.n_fold = 2;
    c.n_permutation = 0;
    c.validation = CLAST_VALIDATION_PUBLISHED;
    CHECK_OK(clast_fit_data_columns(&t, &c, &d));
    assert_int_equal(d.beds.n_row, 5);
    assert_int_equal(d.left_out.n_row, 2);
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    assert_int_equal(count_states(&f, "wall_ratio", "not finite in some row"), 1);
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

/* Five beds are too few to select anew without one of two folds, and enough without doing so. */
static void the_published_validation_selects_once(void **state)
{
    (void)state;
    static const char text[] = "porosity,a\n0.3,1\n0.35,2\n0.41,3\n0.43,4\n0.5,5\n";
    clast_porosity_fit_config c = usual();
    clast_table t = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    c.n_term = 1;
    c.n_fold = 2;
    c.n_permutation = 3;
    CHECK_OK(clast_table_parse_csv("beds", text, sizeof text - 1, NULL, &t, NULL));
    CHECK_OK(clast_fit_data_columns(&t, &c, &d));
    CHECK_STATUS(clast_porosity_fit_data(&d, "m", "test", &c, &f), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "leaves it out): fit: "));
    c.validation = CLAST_VALIDATION_PUBLISHED;
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    assert_true(isnan(f.r2_held_out) && isfinite(f.p_value) && f.model.cv_mean_error > 0.0);
    assert_true(isfinite(clast_table_numbers(&f.rows, "held_out")[4]));
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

/* A model of a size takes new sizes as they were written in the study. */
static void columns_with_units_predict(void **state)
{
    (void)state;
    static const char text[] =
        "porosity,size\n0.31,1mm\n0.322,2mm\n0.33,3mm\n0.341,4mm\n0.35,5mm\n";
    static const char fresh[] = "size\n2500um\n0.25 cm\n";
    static const char plain[] = "size\n0.0025\n";
    clast_porosity_fit_config c = usual();
    clast_table t[5] = {{0}};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    c.n_term = 1;
    c.n_fold = 5;
    c.n_permutation = 0;
    CHECK_OK(clast_table_parse_csv("beds", text, sizeof text - 1, NULL, &t[0], NULL));
    CHECK_OK(clast_table_parse_csv("new", fresh, sizeof fresh - 1, NULL, &t[1], NULL));
    CHECK_OK(clast_fit_data_columns(&t[0], &c, &d));
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    CHECK_OK(clast_porosity_predict_columns(&f.model, &t[1], &t[2]));
    const double expected = f.model.intercept + 2.5e-3 * f.model.term[0].coefficient;
    CHECK_REL(clast_table_numbers(&t[2], "porosity")[0], expected, 1e-14);
    CHECK_REL(clast_table_numbers(&t[2], "porosity")[1], expected, 1e-14);
    // numbers of a caller are SI; of those that a person wrote nobody knows
    assert_string_equal(f.model.term[0].unit, "m");
    assert_string_equal(f.terms.column[8].text[1], "m");
    CHECK_OK(clast_table_parse_csv("plain", plain, sizeof plain - 1, NULL, &t[3], NULL));
    CHECK_OK(clast_porosity_predict_columns(&f.model, &t[3], &t[4]));
    CHECK_REL(clast_table_numbers(&t[4], "porosity")[0], expected, 1e-14);
    CHECK_OK(clast_porosity_model_check_units(&f.model, &t[1]));
    CHECK_STATUS(clast_porosity_model_check_units(&f.model, &t[3]), CLAST_E_FORMAT);
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    for (int k = 0; k < 5; ++k) {
        clast_table_free(&t[k]);
    }
    clast_fields_free(clast_porosity_fit_fields, &c);
}

typedef struct {
    clast_table beds;
    clast_porosity_fit_config config;
} job;

static clast_status fit_all(void *context)
{
    job *j = context;
    clast_table predicted = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    clast_status status = clast_fit_data_columns(&j->beds, &j->config, &d);
    if (status == CLAST_OK) {
        status = clast_porosity_fit_data(&d, "m", "test", &j->config, &f);
    }
    if (status == CLAST_OK) {
        status = clast_porosity_model_check_units(&f.model, &j->beds);
    }
    if (status == CLAST_OK) {
        status = clast_porosity_predict_columns(&f.model, &j->beds, &predicted);
    }
    clast_table_free(&predicted);
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    return status;
}

static void every_refused_allocation_is_told(void **state)
{
    (void)state;
    job j = {.config = usual()};
    make_beds(&j.beds);
    CHECK_OK(clast_table_add_text(&j.beds, "size"));
    for (int64_t i = 0; i < N; ++i) {
        CHECK_OK(clast_table_set_text(&j.beds, 4, i, i % 3 == 0 ? "1mm" : "2mm"));
    }
    j.config.n_fold = 3;
    j.config.n_permutation = 2;
    support_refuse_each_allocation(fit_all, &j);
    clast_table_free(&j.beds);
    clast_fields_free(clast_porosity_fit_fields, &j.config);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(diagnostics_match_r),
        cmocka_unit_test(like_features_are_removed),
        cmocka_unit_test(equation_17_is_found),
        cmocka_unit_test(noise_is_measured),
        cmocka_unit_test(mixtures_are_grouped_by_bed),
        cmocka_unit_test(bad_rows_change_nothing),
        cmocka_unit_test(hopeless_tables_are_refused),
        cmocka_unit_test(columns_with_gaps_are_no_candidates),
        cmocka_unit_test(noise_is_no_model),
        cmocka_unit_test(beds_of_one_form_have_no_deviation),
        cmocka_unit_test(columns_of_rounding_are_constant),
        cmocka_unit_test(an_index_of_rounding_is_constant),
        cmocka_unit_test(candidates_of_a_study_are_what_was_varied),
        cmocka_unit_test(features_are_chosen_by_the_columns),
        cmocka_unit_test(only_features_in_use_cost_a_row),
        cmocka_unit_test(the_published_validation_selects_once),
        cmocka_unit_test(columns_with_units_predict),
        cmocka_unit_test(every_refused_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
