// clast grading: sieve curves and laws of size in numbers of grains, and sizes drawn from them.
#include "command.h"
#include "idle.h"
#include "json.h"
#include "quantity.h"
#include "table_file.h"

#include <clast/grading.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    int32_t spread;
    int32_t count;
    int32_t sample;
    char *compare, *chart;
    uint64_t seed;
    double mass, density, grain_volume;
} grading_config;

#define FIELD(name) #name, .offset = offsetof(grading_config, name)
static const clast_field grading_fields[] = {
    {FIELD(spread), CLAST_FIELD_CHOICE, CLAST_SPREAD_STEP, 0, 2, "-",
     "sizes within a class: density constant over log size, linear between class means, or class "
     "means only",
     "step|linear|means"},
    {FIELD(count), CLAST_FIELD_CHOICE, CLAST_COUNT_MEAN, 0, 1, "-",
     "grains per mass: each as large as its class mean (eq. 9), or so that masses come out exactly",
     "mean|exact"},
    {FIELD(sample), CLAST_FIELD_I32, 0, 0, 1e8, "-",
     "sizes to draw; -o FILE.csv or .json keeps them", NULL},
    {FIELD(chart), CLAST_FIELD_TEXT, 0, 0, 0, CLAST_UNIT_OUTPUT,
     "draw mass and number passing, wanted and achieved, into this .svg, .pdf or .png", ""},
    {FIELD(compare), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "file of grain sizes to set beside the curve instead (column with its unit, diameter_m)", ""},
    {FIELD(seed), CLAST_FIELD_U64, 1, 0, 1.8446744073709552e19, "-", "seed of the draws", NULL},
    {FIELD(mass), CLAST_FIELD_F64, 0.0, 0.0, 1e12, "kg", "mass to count grains for; 0: shares only",
     NULL},
    {FIELD(density), CLAST_FIELD_F64, 2650.0, 1e-3, 1e6, "kg/m^3", "of the grains", NULL},
    {FIELD(grain_volume), CLAST_FIELD_F64, CLAST_PI / 6.0, 1e-6, 100.0, "-",
     "volume of a grain by the cube of its sieve size: pi/6 as the paper, or the shapes' mean",
     NULL},
    {0}};
#undef FIELD

/// All that one call answers.
typedef struct {
    const grading_config *config;
    const char *text;
    clast_curve curve; ///< of no class when the text names a law
    clast_grading *grading;
    clast_table sizes; ///< drawn
    clast_table classes;
    clast_grading_match match;
} answer;

static void free_answer(answer *a)
{
    clast_curve_free(&a->curve);
    clast_grading_destroy(a->grading);
    clast_table_free(&a->sizes);
    clast_table_free(&a->classes);
}

static clast_status begin_sizes(int64_t n, clast_table *sizes)
{
    CLI_GUARD(clast_table_init(sizes, "sizes", n));
    CLI_GUARD(clast_table_add_number(sizes, "diameter_m", "m", NULL));
    return CLAST_OK;
}

static clast_status draw_sizes(answer *a)
{
    CLI_GUARD(begin_sizes(a->config->sample, &a->sizes));
    for (int32_t i = 0; i < a->config->sample; ++i) {
        a->sizes.column[0].number[i] = clast_grading_draw(a->grading, a->config->seed, (uint64_t)i);
    }
    return CLAST_OK;
}

/// Sizes that someone measured: single ones, not bins or counts.
static clast_status read_sizes(answer *a)
{
    const char *path = a->config->compare;
    clast_sizes list = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(clast_sizes_read(path, "", "", &list));
    CLI_TRY(begin_sizes(list.n, &a->sizes));
    for (int64_t i = 0; i < list.n; ++i) {
        a->sizes.column[0].number[i] = list.low[i];
        CLI_CHECK(list.low[i] >= list.high[i] && list.count[i] == 1.0, CLAST_E_FORMAT,
                  "%s: size %lld is a bin or counted; give one row for each grain", path,
                  (long long)i + 1);
    }
done:
    clast_sizes_free(&list);
    return status;
}

static clast_status take_sizes(answer *a)
{
    CLI_GUARD(a->config->compare[0] != '\0' ? read_sizes(a) : draw_sizes(a));
    if (a->curve.n_class > 0 && a->sizes.n_row > 0) {
        const clast_grading_sample sample = {a->sizes.n_row, a->sizes.column[0].number, NULL};
        CLI_GUARD(clast_grading_compare(a->grading, &a->curve, &sample, &a->classes, &a->match));
    }
    return CLAST_OK;
}

/// Grains that the mass holds on average under the law as it is drawn.
static double expected_count(const answer *a)
{
    const grading_config *c = a->config;
    return c->mass / (c->density * c->grain_volume * clast_grading_mean_cube(a->grading));
}

static double class_share(const answer *a, int32_t i)
{
    return clast_grading_share(a->grading, a->curve.sieve[i + 1]) -
           clast_grading_share(a->grading, a->curve.sieve[i]);
}

/// Grains of a class in the mass: by equation 9, or so that the masses come out exactly; by the law
/// where grains cross the sieves.
static double class_count(const answer *a, int32_t i)
{
    const grading_config *c = a->config;
    return c->count == CLAST_COUNT_EXACT || c->spread == CLAST_SPREAD_LINEAR
               ? class_share(a, i) * expected_count(a)
               : clast_curve_count(&a->curve, i, c->mass, c->density, c->grain_volume);
}

static void sizes_json(json_t *o, const char *name, double (*size)(const clast_grading *, double),
                       const clast_grading *grading)
{
    static const char *const key[] = {"d10", "d50", "d90"};
    static const double share[] = {0.1, 0.5, 0.9};
    json_t *set = json_object();
    for (int k = 0; k < 3; ++k) {
        cli_json_number(set, key[k], size(grading, share[k]));
    }
    (void)json_object_set_new(o, name, set);
}

static void curve_json(json_t *o, const clast_curve *curve)
{
    json_t *set = json_object();
    cli_json_number(set, "d10", clast_curve_size(curve, 0.1));
    cli_json_number(set, "d50", clast_curve_size(curve, 0.5));
    cli_json_number(set, "d90", clast_curve_size(curve, 0.9));
    (void)json_object_set_new(o, "curve_by_mass", set);
}

static void classes_json(json_t *o, const answer *a)
{
    json_t *list = json_array();
    for (int32_t i = 0; i < a->curve.n_class; ++i) {
        const double low = a->curve.sieve[i];
        const double high = a->curve.sieve[i + 1];
        json_t *row = json_object();
        cli_json_number(row, "low", low);
        cli_json_number(row, "high", high);
        cli_json_number(row, "mean", clast_curve_class_size(&a->curve, i));
        cli_json_number(row, "mass", a->curve.mass[i]);
        cli_json_number(row, "number", class_share(a, i));
        cli_json_number(row, "count", class_count(a, i));
        if (a->classes.n_row > 0) {
            cli_json_number(row, "achieved_mass",
                            clast_table_numbers(&a->classes, "achieved_mass")[i + 1]);
            cli_json_number(row, "achieved_number",
                            clast_table_numbers(&a->classes, "achieved_number")[i + 1]);
        }
        (void)json_array_append_new(list, row);
    }
    (void)json_object_set_new(o, "classes", list);
}

/// Grains below and above all classes.
typedef struct {
    double n_below, n_above;
    double mass; ///< share of both
} outside;

static outside outside_of(const answer *a)
{
    const int64_t last = a->classes.n_row - 1;
    const double *const count = clast_table_numbers(&a->classes, "count");
    const double *const mass = clast_table_numbers(&a->classes, "achieved_mass");
    return (outside){count[0], count[last], mass[0] + mass[last]};
}

static void match_json(json_t *o, const answer *a)
{
    const outside out = outside_of(a);
    cli_json_number(o, "distance_mass", a->match.distance_mass);
    cli_json_number(o, "distance_number", a->match.distance_number);
    cli_json_number(o, "distance_curve", a->match.distance_curve);
    cli_json_count(o, "n_below", (int64_t)out.n_below);
    cli_json_count(o, "n_above", (int64_t)out.n_above);
    cli_json_number(o, "mass_outside", out.mass);
    cli_json_number(o, "achieved_d10", a->match.achieved_d10);
    cli_json_number(o, "achieved_d50", a->match.achieved_d50);
    cli_json_number(o, "achieved_d90", a->match.achieved_d90);
}

/// What a list's rows count by, and what of it was not looked at.
static void list_json(json_t *o, const clast_grading_list *list)
{
    json_t *set = json_object();
    cli_json_count(set, "n_row", list->n_row);
    cli_json_text(set, "column", list->column);
    cli_json_number(set, "total", list->total);
    cli_json_text(set, "ignored", list->ignored);
    (void)json_object_set_new(o, "list", set);
}

static json_t *answer_json(const answer *a)
{
    json_t *o = json_object();
    double low = 0.0;
    double high = 0.0;
    const clast_grading_list list = clast_grading_list_of(a->grading);
    clast_grading_range(a->grading, &low, &high);
    cli_json_text(o, "curve", a->text);
    if (list.n_row > 0) {
        list_json(o, &list);
    }
    cli_json_number(o, "low", low);
    cli_json_number(o, "high", high);
    sizes_json(o, "drawn_by_mass", clast_grading_mass_size, a->grading);
    sizes_json(o, "drawn_by_number", clast_grading_size, a->grading);
    cli_json_number(o, "mean_cube", clast_grading_mean_cube(a->grading));
    cli_json_number(o, "n_expected", expected_count(a));
    cli_json_count(o, "n_sample", a->sizes.n_row);
    if (a->curve.n_class > 0) {
        curve_json(o, &a->curve);
        classes_json(o, a);
    }
    if (a->classes.n_row > 0) {
        match_json(o, a);
    }
    return o;
}

/// The size in phi units; 0.000, never -0.000.
static double phi_words(double size)
{
    const double phi = clast_phi_of_size(size);
    return fabs(phi) < 5e-4 ? 0.0 : phi;
}

static void size_words(const char *what, double d10, double d50, double d90)
{
    (void)printf("  %-18s D10 %9.4f mm (phi %6.3f)   D50 %9.4f mm (phi %6.3f)   D90 %9.4f mm (phi "
                 "%6.3f)\n",
                 what, 1e3 * d10, phi_words(d10), 1e3 * d50, phi_words(d50), 1e3 * d90,
                 phi_words(d90));
}

static void class_words(const answer *a)
{
    const bool achieved = a->classes.n_row > 0;
    const bool counted = a->config->mass > 0.0;
    (void)printf("  %10s %10s %10s %8s %10s%s%s\n", "low (mm)", "high (mm)", "mean (mm)", "mass",
                 "number", counted ? "     grains" : "", achieved ? "   mass got  number got" : "");
    for (int32_t i = 0; i < a->curve.n_class; ++i) {
        const double low = a->curve.sieve[i];
        const double high = a->curve.sieve[i + 1];
        (void)printf("  %10.4g %10.4g %10.4g %8.4f %10.6f", 1e3 * low, 1e3 * high,
                     1e3 * clast_curve_class_size(&a->curve, i), a->curve.mass[i],
                     class_share(a, i));
        if (counted) {
            (void)printf(" %10.1f", class_count(a, i));
        }
        if (achieved) {
            (void)printf(" %10.4f %11.6f", clast_table_numbers(&a->classes, "achieved_mass")[i + 1],
                         clast_table_numbers(&a->classes, "achieved_number")[i + 1]);
        }
        (void)printf("\n");
    }
}

static void match_words(const answer *a)
{
    const outside out = outside_of(a);
    const int64_t n = a->sizes.n_row;
    (void)printf(
        "  %lld %s: farthest from the law to draw by %.4f by mass, %.4f by number; from the "
        "curve by %.4f by mass\n",
        (long long)n, a->config->compare[0] != '\0' ? "grains compared" : "drawn",
        a->match.distance_mass, a->match.distance_number, a->match.distance_curve);
    if (out.n_below + out.n_above > 0.0) {
        (void)printf("  %.0f of %lld lie outside all classes: %.0f below, %.0f above, %.4f of the "
                     "mass\n",
                     out.n_below + out.n_above, (long long)n, out.n_below, out.n_above, out.mass);
    }
    size_words("achieved, by mass", a->match.achieved_d10, a->match.achieved_d50,
               a->match.achieved_d90);
}

static void answer_words(const answer *a)
{
    const clast_grading *g = a->grading;
    const clast_grading_list list = clast_grading_list_of(g);
    (void)printf("%s\n", cli_name(a->text));
    if (list.n_row > 0) {
        const bool by_mass = strncmp(a->text, "masses:", 7) == 0;
        char text[1536];
        (void)printf("  %s\n",
                     cli_name(clast_grading_list_text(&list, by_mass, sizeof text, text)));
    }
    if (a->curve.n_class > 0) {
        class_words(a);
        size_words("curve, by mass", clast_curve_size(&a->curve, 0.1),
                   clast_curve_size(&a->curve, 0.5), clast_curve_size(&a->curve, 0.9));
    }
    size_words("to draw, by mass", clast_grading_mass_size(g, 0.1), clast_grading_mass_size(g, 0.5),
               clast_grading_mass_size(g, 0.9));
    size_words("to draw, by number", clast_grading_size(g, 0.1), clast_grading_size(g, 0.5),
               clast_grading_size(g, 0.9));
    if (a->config->mass > 0.0) {
        (void)printf("  %s hold %.1f grains on average as drawn\n",
                     cli_quantity(a->config->mass, "kg"), expected_count(a));
    }
    if (a->classes.n_row > 0) {
        match_words(a);
    }
}

static clast_status check_spread(const grading_config *config, const clast_curve *curve)
{
    clast_idle rules[CLAST_N_IDLE];
    return cli_idle_check(grading_fields, config,
                          clast_grading_idle(curve, (clast_grading_spread)config->spread, rules));
}

static clast_status check_options(const cli_common *common, const grading_config *config)
{
    const bool compares = config->compare[0] != '\0';
    const clast_idle own[] = {{config->mass == 0.0, "density|grain_volume", "without --mass"},
                              {config->sample == 0, "seed", "without --sample"},
                              {0}};
    CLI_GUARD(cli_idle_check(grading_fields, config, own));
    CLI_GUARD(check_spread(config, NULL));
    CLI_GUARD(cli_table_check(common->output));
    if (common->output != NULL && config->sample == 0) {
        return cli_fail(CLAST_E_USAGE, "-o keeps drawn sizes; say how many with --sample");
    }
    if (config->chart[0] != '\0' && !compares && config->sample == 0) {
        return cli_fail(CLAST_E_USAGE,
                        "chart draws what was achieved: --sample N or --compare FILE");
    }
    CLI_GUARD(cli_check_writable(config->chart));
    if (compares && config->sample > 0) {
        return cli_fail(CLAST_E_USAGE, "sample draws sizes and compare reads them; take one");
    }
    return CLAST_OK;
}

static clast_status run(const cli_common *common, void *config_bytes)
{
    const grading_config *config = config_bytes;
    answer a = {.config = config, .text = common->argument[0]};
    clast_status status = CLAST_OK;
    CLI_TRY(check_options(common, config));
    CLI_TRY(clast_grading_load(a.text, (clast_grading_spread)config->spread,
                               (clast_grading_count)config->count, &a.curve, &a.grading));
    CLI_TRY(check_spread(config, &a.curve));
    CLI_TRY(take_sizes(&a));
    CLI_CHECK(config->compare[0] == '\0' || a.curve.n_class != 0, CLAST_E_USAGE,
              "'%s' is no sieve curve to compare with", a.text);
    if (config->chart[0] != '\0') {
        CLI_TRY(a.classes.n_row > 0
                    ? clast_chart_grading(&a.classes, config->chart)
                    : cli_fail(CLAST_E_USAGE, "chart: '%s' is no sieve curve", a.text));
    }
    if (common->output != NULL) {
        CLI_TRY(cli_table_write(&a.sizes, common->output));
    }
    if (common->json) {
        CLI_TRY(cli_print_json(answer_json(&a)));
    } else {
        answer_words(&a);
    }
done:
    free_answer(&a);
    return status;
}

const cli_command cli_grading = {
    .name = "grading",
    .arguments = "CURVE",
    .summary = "sieve curves and laws of size: numbers, D10 to D90, drawn sizes",
    .example = {"clast grading U3", "clast grading B50 --mass 1kg --density 2650kg/m^3",
                "clast grading lognormal:5mm,1mm --sample 100 -o sizes.csv"},
    .details =
        "CURVE is U1, U3, U5, U7, B30, B50 or B70 (Rettinger et al. 2022, table 3), the CSV file "
        "of a sieve\n"
        "curve, uniform:LOW,HIGH, lognormal:MEAN,DEVIATION[,LOW,HIGH], list:FILE (counts),\n"
        "masses:FILE or one size (\"11 mm\").\n"
        "A file has a column sieve, size, diameter or phi with its unit (sieve_mm) and a column "
        "retained (on\n"
        "this sieve), cumulative retained (on this and all coarser ones) or passing (% or share); "
        "% and\n"
        "shares are all of it, within 1 %.\n"
        "Numbers follow from masses by equations 8 and 9 of the paper; the curve is straight over "
        "log\n"
        "size between sieves. Definitions: docs/theory/grading.md.\n"
        "list:FILE has sizes and a column count, n or n_grains (none: one grain a row), "
        "masses:FILE a\n"
        "column mass, retained or mass_g; weight, frequency and fraction are either. Which column "
        "counts\n"
        "and which are ignored is reported.\n"
        "A draw depends on the seed and the grain's number alone.",
    .fields = grading_fields,
    .config_size = sizeof(grading_config),
    .n_min = 1,
    .n_max = 1,
    .run = run,
};
