// clast predict: porosity of a bed from the forms of its grains.
#include "command.h"
#include "idle.h"
#include "json.h"
#include "predict_input.h"
#include "predict_words.h"
#include "results.h"

#include <clast/statistics.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>

typedef struct {
    char *model;
    int32_t grading;
    char *flatness, *elongation;
    int64_t grains;
    char *columns;
    bool each;
    int32_t resamples;
    uint64_t seed;
    bool force;
} config;

static const clast_field fields[] = {
    {"model", .offset = offsetof(config, model), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "auto, single, mixture, or a model file of clast fit; auto: mixture where the forms vary, "
     "else single",
     "auto"},
    {"grading", .offset = offsetof(config, grading), CLAST_FIELD_CHOICE, 0, 0, 0, "-",
     "published size distribution that the bed's resembles, up to scale", "U1|U7|B50"},
    {"flatness", .offset = offsetof(config, flatness), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "mean S/I, or mean and standard deviation as in 0.65+-0.17", ""},
    {"elongation", .offset = offsetof(config, elongation), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "mean I/L, or mean and standard deviation", ""},
    {"grains", .offset = offsetof(config, grains), CLAST_FIELD_I64, 0, 0, 1e12, "-",
     "number of grains behind the means (0: unknown, no sampling error)", NULL},
    {"columns", .offset = offsetof(config, columns), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "columns of the table: flatness,elongation or L,I,S (else known by their names)", ""},
    {"each", .offset = offsetof(config, each), CLAST_FIELD_BOOL, 0, 0, 0, "-",
     "every row is a bed of that single form: one prediction a row", NULL},
    {"resamples", .offset = offsetof(config, resamples), CLAST_FIELD_I32, 500, 0, 1e6, "-",
     "bootstrap resamples of the grains for the sampling error", NULL},
    {"seed", .offset = offsetof(config, seed), CLAST_FIELD_U64, 1, 0, 1.8446744073709552e19, "-",
     "random numbers", NULL},
    CLI_FORCE(config),
    {0}};

static void free_job(cli_prediction *j)
{
    clast_porosity_model_free(&j->model);
    clast_table_free(&j->table);
    clast_table_free(&j->beds);
    clast_form_set_free(&j->set);
}

static clast_status check_used(const config *c, bool has_table, bool takes_columns)
{
    const clast_predict_given given = {c->model, has_table, c->each, takes_columns};
    clast_idle rules[CLAST_N_IDLE];
    return cli_idle_check(fields, c, clast_porosity_predict_idle(&given, rules));
}

/// A fitted model of table columns: every row is a bed.
static clast_status predict_columns(const config *c, cli_prediction *j)
{
    CLI_GUARD(check_used(c, true, true));
    CLI_GUARD(clast_porosity_model_check_units(&j->model, &j->table));
    CLI_GUARD(clast_porosity_predict_columns(&j->model, &j->table, &j->beds));
    if (j->beds.n_row < j->table.n_row) {
        (void)fprintf(stderr,
                      "clast predict: %s: %lld of %lld rows left out: missing or infinite\n",
                      cli_name(j->table.name), (long long)(j->table.n_row - j->beds.n_row),
                      (long long)j->table.n_row);
    }
    return CLAST_OK;
}

/// Rows of the table that are no row of the beds.
static clast_status columns_left_out(const cli_prediction *j, clast_table *left_out)
{
    const double *row = clast_table_numbers(&j->beds, "row");
    double *number = NULL;
    int64_t n = 0;
    clast_status status = CLAST_OK;
    CLI_TRY(clast_table_init(left_out, "left_out", j->table.n_row - j->beds.n_row));
    CLI_TRY(clast_table_add_number(left_out, "row", "-", &number));
    CLI_TRY(clast_table_add_text(left_out, "reason"));
    for (int64_t i = 0; i < j->table.n_row; ++i) {
        const int64_t bed = i - n;
        if (bed < j->beds.n_row && row[bed] == (double)i + 1.0) {
            continue;
        }
        number[n] = (double)i + 1.0;
        CLI_TRY(clast_table_set_text(left_out, 1, n++, "a cell is missing or infinite"));
    }
done:
    return status;
}

static void tell_beds(const cli_prediction *j)
{
    char words[256];
    if (clast_porosity_beds_words(&j->model, &j->beds, sizeof words, words)[0] != '\0') {
        (void)fprintf(stderr, "clast predict: %s: %s\n", cli_name(j->table.name), cli_name(words));
    }
}

/// Every grain is a bed of its form.
static clast_status predict_each(const config *c, cli_prediction *j)
{
    CLI_GUARD(cli_choose_model(c->model, c->grading, false, &j->model));
    return clast_porosity_predict_each(&j->model, &j->set, &j->beds);
}

/// One bed of all grains: a mixture where their forms vary.
static clast_status predict_set(const config *c, cli_prediction *j)
{
    char words[128];
    const clast_bootstrap b = {.n_resample = c->resamples, .level = 0.95, .seed = c->seed};
    if (clast_form_set_count_words(&j->set, sizeof words, words)[0] != '\0') {
        (void)fprintf(stderr, "clast predict: %s: %s\n", j->table.name, cli_name(words));
    }
    CLI_GUARD(clast_form_inputs_of(&j->set, NULL, 0, &j->inputs));
    CLI_GUARD(cli_choose_model(c->model, c->grading, j->inputs.has_deviation, &j->model));
    j->has_one = true;
    j->knows_spread = j->set.n > 1;
    return clast_porosity_predict_set(&j->model, &j->set, &b, &j->inputs, &j->prediction);
}

static clast_status predict_table(const config *c, cli_prediction *j)
{
    char complaint[512];
    clast_status status = cli_choose_model(c->model, c->grading, false, &j->model);
    if (status == CLAST_OK && j->model.kind == CLAST_MODEL_COLUMNS) {
        return predict_columns(c, j);
    }
    clast_porosity_model_free(&j->model);
    status = status == CLAST_OK ? clast_form_set_of(&j->table, c->columns, &j->set) : status;
    if (status != CLAST_OK) {
        return status;
    }
    clast_form_set_complaint(&j->set, sizeof complaint, complaint);
    if (complaint[0] != '\0') {
        (void)fprintf(stderr, "clast predict: %s: %s\n", cli_name(j->table.name), complaint);
    }
    return c->each ? predict_each(c, j) : predict_set(c, j);
}

static clast_status predict_moments(const config *c, cli_prediction *j)
{
    double mean[2];
    double deviation[2];
    bool has_deviation = false;
    CLI_GUARD(cli_parse_moments(c->flatness, c->elongation, mean, deviation, &has_deviation));
    CLI_GUARD(clast_form_inputs_from_moments(mean, has_deviation ? deviation : NULL, c->grains,
                                             &j->inputs));
    CLI_GUARD(cli_choose_model(c->model, c->grading, j->inputs.has_deviation, &j->model));
    j->has_one = true;
    j->knows_spread = has_deviation;
    return clast_porosity_predict_moments(&j->model, &j->inputs, &j->prediction);
}

static clast_status write_folder(const cli_prediction *j, const char *folder)
{
    char path[4096];
    clast_table one = {0};
    clast_table left_out = {0};
    clast_status status = CLAST_OK;
    if (j->has_one) {
        CLI_TRY(clast_porosity_prediction_table(&j->model, &j->inputs, &j->prediction, &one));
    }
    (void)snprintf(path, sizeof path, "%s/prediction.csv", folder);
    CLI_TRY(clast_table_write_csv(j->has_one ? &one : &j->beds, path));
    if (cli_prediction_left_out(j) > 0) {
        (void)snprintf(path, sizeof path, "%s/left_out.csv", folder);
        CLI_TRY(j->model.kind == CLAST_MODEL_COLUMNS ? columns_left_out(j, &left_out)
                                                     : clast_form_set_left_out(&j->set, &left_out));
        CLI_TRY(clast_table_write_csv(&left_out, path));
    }
done:
    clast_table_free(&one);
    clast_table_free(&left_out);
    return status;
}

static clast_status answer(const config *c, const cli_common *common, cli_prediction *j)
{
    const bool has_moments = c->flatness[0] != '\0' || c->elongation[0] != '\0';
    j->has_table = common->n_argument == 1;
    if (j->has_table == has_moments) {
        return cli_fail(CLAST_E_USAGE, "give a table of grains, or --flatness and --elongation%s",
                        has_moments ? ", not both" : "");
    }
    CLI_GUARD(check_used(c, j->has_table, false));
    if (!j->has_table) {
        return predict_moments(c, j);
    }
    CLI_GUARD(clast_table_read_csv(common->argument[0], NULL, &j->table, NULL));
    return predict_table(c, j);
}

static clast_status write_results(const cli_common *common, const config *c,
                                  const cli_prediction *j, clast_run_folder *folder)
{
    const cli_input inputs[] = {
        {"table", j->has_table ? common->argument[0] : NULL},
        {"model", clast_porosity_model_by_grading(c->model) ? NULL : c->model},
        {NULL, NULL}};
    json_t *summary = cli_prediction_json(j);
    clast_status status = cli_results_open(folder, fields, c, &c->seed, inputs);
    status = status == CLAST_OK ? write_folder(j, clast_run_folder_path(folder)) : status;
    status = status == CLAST_OK ? cli_results_summary(folder, summary) : status;
    json_decref(summary);
    return clast_run_folder_end(folder, status);
}

static clast_status run(const cli_common *common, void *values)
{
    config *c = values;
    cli_prediction j = {0};
    clast_run_folder *folder = NULL;
    clast_status status = CLAST_OK;
    CLI_TRY(cli_results_begin(common, common->output, &c->force, &folder));
    CLI_TRY(answer(c, common, &j));
    tell_beds(&j);
    if (folder != NULL) {
        CLI_TRY(write_results(common, c, &j, folder));
    }
    if (common->json) {
        CLI_TRY(cli_print_json(cli_prediction_json(&j)));
    } else {
        cli_prediction_print(&j);
    }
done:
    clast_run_folder_destroy(folder);
    free_job(&j);
    return status;
}

const cli_command cli_predict = {
    .name = "predict",
    .arguments = "[TABLE]",
    .summary = "porosity of a bed from the flatness and elongation of its grains",
    .example = {"clast predict --flatness 0.65+-0.17 --elongation 0.68+-0.14",
                "clast predict grains.csv --grading U7",
                "clast predict beds.csv --model model/model.json --each"},
    .details =
        "From a table of grains (columns flatness and elongation, or L, I, S) or from means and\n"
        "deviations:\n"
        "  clast predict grains.csv --grading U1\n"
        "  clast predict --flatness 0.647+-0.175 --elongation 0.682+-0.139\n"
        "Published models: Rettinger et al., Granular Matter 24 (2022) 118, linear in the inverse\n"
        "equancy L/S and inverse elongation L/I of one form (eqs 17-19: U1, U7, B50) or of a\n"
        "mixture of forms, with the inverse deviations (eqs 23, 24: U1, U7). Dense, shaken beds "
        "of\n"
        "gravel without walls. Sizes count relative to each other: U1 is one sieve class (5.6-8\n"
        "mm), U7 seven classes, B50 two modes.\n"
        "The standard error joins the scatter of beds about the model (sqrt(pi/2) times the\n"
        "published cross-validation error), the coefficients' printed digits (or a fitted model's\n"
        "covariance) and the sampling of the grains. Inputs outside the range of the model's data\n"
        "are named and in_range is false. Theory: docs/theory/predict.md.\n"
        "-o FOLDER writes prediction.csv, left_out.csv, summary.json and manifest.json.",
    .fields = fields,
    .config_size = sizeof(config),
    .n_min = 0,
    .n_max = 1,
    .writes_folder = true,
    .run = run,
};
