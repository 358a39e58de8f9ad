// clast predict: porosity of a bed from the forms of its grains.
#include "command.h"
#include "json.h"
#include "predict_input.h"
#include "results.h"

#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

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
     "auto (mixture where the forms vary, else single), single, mixture, or a model file of clast "
     "fit",
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
    {"seed", .offset = offsetof(config, seed), CLAST_FIELD_U64, 1, 0, 1.8e19, "-", "random numbers",
     NULL},
    CLI_FORCE(config),
    {0}};

/// Everything of one run.
typedef struct {
    clast_porosity_model model;
    clast_table table, beds;
    clast_form_set set;
    clast_form_inputs inputs;
    clast_prediction prediction;
    bool has_table, has_one; ///< has_one: `prediction` is the answer for one bed
} job;

static void free_job(job *j)
{
    clast_porosity_model_free(&j->model);
    clast_table_free(&j->table);
    clast_table_free(&j->beds);
    clast_form_set_free(&j->set);
}

/// A fitted model of table columns: every row is a bed.
static clast_status predict_columns(job *j)
{
    const clast_status status = clast_porosity_predict_columns(&j->model, &j->table, &j->beds);
    if (status == CLAST_OK && j->beds.n_row < j->table.n_row) {
        (void)fprintf(
            stderr, "clast predict: %s: %lld of %lld rows left out: missing or infinite\n",
            j->table.name, (long long)(j->table.n_row - j->beds.n_row), (long long)j->table.n_row);
    }
    return status;
}

static clast_status predict_table(const config *c, job *j)
{
    char complaint[512];
    clast_status status = cli_choose_model(c->model, c->grading, false, &j->model);
    if (status == CLAST_OK && j->model.kind == CLAST_MODEL_COLUMNS) {
        return predict_columns(j);
    }
    clast_porosity_model_free(&j->model);
    status = status == CLAST_OK ? clast_form_set_of(&j->table, c->columns, &j->set) : status;
    if (status != CLAST_OK) {
        return status;
    }
    clast_form_set_complaint(&j->set, complaint, sizeof complaint);
    if (complaint[0] != '\0') {
        (void)fprintf(stderr, "clast predict: %s: %s\n", j->table.name, complaint);
    }
    status = cli_choose_model(c->model, c->grading, !c->each && j->set.n > 1, &j->model);
    if (status == CLAST_OK && c->each) {
        return clast_porosity_predict_each(&j->model, &j->set, &j->beds);
    }
    const clast_bootstrap b = {.n_resample = c->resamples, .level = 0.95, .seed = c->seed};
    j->has_one = true;
    return status != CLAST_OK
               ? status
               : clast_porosity_predict_set(&j->model, &j->set, &b, &j->inputs, &j->prediction);
}

static clast_status predict_moments(const config *c, job *j)
{
    double mean[2];
    double deviation[2];
    bool has_spread = false;
    clast_status status =
        cli_parse_moments(c->flatness, c->elongation, mean, deviation, &has_spread);
    if (status == CLAST_OK) {
        status = cli_choose_model(c->model, c->grading, has_spread, &j->model);
    }
    if (status == CLAST_OK) {
        status = clast_form_inputs_from_moments(mean, has_spread ? deviation : NULL, c->grains,
                                                &j->inputs);
    }
    j->has_one = true;
    return status != CLAST_OK
               ? status
               : clast_porosity_predict_moments(&j->model, &j->inputs, &j->prediction);
}

static json_t *json_inputs(const job *j)
{
    json_t *in = json_object();
    const clast_form_inputs *v = &j->inputs;
    cli_json_text(in, "from", j->has_table ? "table" : "moments");
    if (j->has_table) {
        cli_json_count(in, "n_left_out", j->set.n_left_out);
    }
    if (!j->has_one) {
        return in;
    }
    cli_json_count(in, "n_grain", v->n_grain);
    cli_json_number(in, "flatness_mean", v->flatness_mean);
    cli_json_number(in, "flatness_deviation", v->flatness_deviation);
    cli_json_number(in, "elongation_mean", v->elongation_mean);
    cli_json_number(in, "elongation_deviation", v->elongation_deviation);
    cli_json_number(in, "equancy_mean", v->equancy_mean);
    cli_json_number(in, "equancy_deviation", v->equancy_deviation);
    cli_json_bool(in, "equancy_by_independence", v->is_independent);
    return in;
}

static json_t *json_outside(const job *j)
{
    json_t *list = json_array();
    const int32_t most = (int32_t)(sizeof j->prediction.outside / sizeof *j->prediction.outside);
    for (int32_t k = 0; k < j->prediction.n_outside && k < most; ++k) {
        const clast_model_range *r = &j->model.range[j->prediction.outside[k]];
        json_t *one = json_object();
        cli_json_text(one, "feature", r->feature);
        cli_json_number(one, "low", r->low);
        cli_json_number(one, "high", r->high);
        (void)json_array_append_new(list, one);
    }
    return list;
}

static json_t *json_beds(const clast_table *beds)
{
    json_t *list = json_array();
    for (int64_t i = 0; i < beds->n_row; ++i) {
        json_t *bed = json_object();
        for (int32_t c = 0; c < beds->n_column; ++c) {
            const clast_column *column = &beds->column[c];
            if (strcmp(column->name, "row") == 0) {
                cli_json_count(bed, column->name, (int64_t)column->number[i]);
            } else if (strcmp(column->name, "in_range") == 0) {
                cli_json_bool(bed, column->name, column->number[i] > 0.5);
            } else {
                cli_json_number(bed, column->name, column->number[i]);
            }
        }
        (void)json_array_append_new(list, bed);
    }
    return list;
}

static json_t *to_json(const job *j)
{
    json_t *out = json_object();
    json_t *error = json_object();
    const clast_prediction *p = &j->prediction;
    cli_json_text(out, "model", j->model.name);
    cli_json_text(out, "kind", clast_model_kind_name(j->model.kind));
    cli_json_text(out, "source", j->model.source);
    if (j->has_one) {
        cli_json_number(out, "porosity", p->porosity);
        cli_json_number(out, "standard_error", p->standard_error);
        cli_json_bool(out, "in_range", p->in_range);
        (void)json_object_set_new(out, "out_of_range", json_outside(j));
        if (isfinite(p->leverage)) { // else not known
            cli_json_number(out, "leverage", p->leverage);
            cli_json_number(out, "leverage_limit", j->model.leverage_limit);
        }
        cli_json_number(error, "model", p->model_error);
        cli_json_number(error, "coefficients", p->coefficient_error);
        if (p->sampling_error > 0.0) { // else not known
            cli_json_number(error, "sampling", p->sampling_error);
        }
        (void)json_object_set_new(out, "errors", error);
    } else {
        json_decref(error);
        (void)json_object_set_new(out, "beds", json_beds(&j->beds));
    }
    (void)json_object_set_new(out, "inputs", json_inputs(j));
    return out;
}

static void print_formula(const clast_porosity_model *m)
{
    (void)printf("model      %s (%s)\n           porosity = %.6g", m->name, m->source,
                 m->intercept);
    for (int32_t k = 0; k < m->n_term; ++k) {
        if (m->term[k].coefficient == 0.0) {
            continue; // of eq. 23, which has no fourth term
        }
        (void)printf(" %c %.6g %s", m->term[k].coefficient < 0.0 ? '-' : '+',
                     fabs(m->term[k].coefficient), m->term[k].feature);
    }
    (void)printf("\n");
}

static void print_one(const job *j)
{
    const clast_form_inputs *v = &j->inputs;
    const clast_prediction *p = &j->prediction;
    (void)printf("porosity   %.4f +- %.4f  (one standard error: model %.4f, coefficients %.4f, "
                 "sampling ",
                 p->porosity, p->standard_error, p->model_error, p->coefficient_error);
    (void)(p->sampling_error > 0.0 ? printf("%.4f)\n", p->sampling_error) : printf("not known)\n"));
    print_formula(&j->model);
    if (v->n_grain > 0) {
        (void)printf("grains     %lld\n", (long long)v->n_grain);
    }
    if (v->has_deviation) {
        (void)printf(
            "flatness   %.4f +- %.4f\nelongation %.4f +- %.4f\nequancy    %.4f +- %.4f%s\n",
            v->flatness_mean, v->flatness_deviation, v->elongation_mean, v->elongation_deviation,
            v->equancy_mean, v->equancy_deviation,
            v->is_independent ? " (flatness and elongation taken as independent)" : "");
    } else {
        (void)printf(
            "flatness   %.4f\nelongation %.4f\nequancy    %.4f (of the means: no deviations "
            "were given)\n",
            v->flatness_mean, v->elongation_mean, v->equancy_mean);
    }
    if (j->model.kind == CLAST_MODEL_SINGLE && v->has_deviation) {
        (void)printf("note       a single-form model at the mean form: it leaves the spread of the "
                     "forms out\n");
    }
    const int32_t most = (int32_t)(sizeof p->outside / sizeof *p->outside);
    for (int32_t k = 0; k < p->n_outside && k < most; ++k) {
        const clast_model_range *r = &j->model.range[p->outside[k]];
        (void)printf("outside    %s lies outside the model's range %.4g to %.4g\n", r->feature,
                     r->low, r->high);
    }
    if (p->leverage > j->model.leverage_limit * (1.0 + 1e-9)) {
        (void)printf("outside    these values together lie farther out than any of the model's "
                     "%lld beds (leverage %.3g, theirs up to %.3g)\n",
                     (long long)j->model.n_bed, p->leverage, j->model.leverage_limit);
    }
}

static void print_beds(const job *j)
{
    print_formula(&j->model);
    (void)printf("%8s %10s %14s  %s\n", "row", "porosity", "standard_error", "in range");
    const double *row = clast_table_numbers(&j->beds, "row");
    const double *porosity = clast_table_numbers(&j->beds, "porosity");
    const double *error = clast_table_numbers(&j->beds, "standard_error");
    const double *in_range = clast_table_numbers(&j->beds, "in_range");
    for (int64_t i = 0; i < j->beds.n_row; ++i) {
        (void)printf("%8.0f %10.4f %14.4f  %s\n", row[i], porosity[i], error[i],
                     in_range[i] > 0.5 ? "yes" : "no");
    }
}

static clast_status write_folder(const job *j, const char *folder)
{
    char path[4096];
    clast_table t = {0};
    clast_status status = CLAST_OK;
    (void)snprintf(path, sizeof path, "%s/prediction.csv", folder);
    if (j->has_one) {
        status = clast_porosity_prediction_table(&j->model, &j->inputs, &j->prediction, &t);
        status = status == CLAST_OK ? clast_table_write_csv(&t, path) : status;
    } else {
        status = clast_table_write_csv(&j->beds, path);
    }
    clast_table_free(&t);
    if (status == CLAST_OK && j->has_table && j->set.n_left_out > 0) {
        (void)snprintf(path, sizeof path, "%s/left_out.csv", folder);
        status = clast_form_set_left_out(&j->set, &t);
        status = status == CLAST_OK ? clast_table_write_csv(&t, path) : status;
        clast_table_free(&t);
    }
    return status;
}

static clast_status answer(const config *c, const cli_common *common, job *j)
{
    const bool has_moments = c->flatness[0] != '\0' || c->elongation[0] != '\0';
    j->has_table = common->n_argument == 1;
    if (j->has_table == has_moments) {
        return cli_fail(CLAST_E_USAGE, "give a table of grains, or --flatness and --elongation%s",
                        has_moments ? ", not both" : "");
    }
    if (!j->has_table) {
        return c->each ? cli_fail(CLAST_E_USAGE, "--each needs a table") : predict_moments(c, j);
    }
    const clast_status status = clast_table_read_csv(common->argument[0], NULL, &j->table, NULL);
    return status == CLAST_OK ? predict_table(c, j) : status;
}

static clast_status keep_results(const cli_common *common, const config *c, const job *j,
                                 clast_run_folder *folder)
{
    const bool is_file = strcmp(c->model, "auto") != 0 && strcmp(c->model, "single") != 0 &&
                         strcmp(c->model, "mixture") != 0;
    const cli_input inputs[] = {{"table", j->has_table ? common->argument[0] : NULL},
                                {"model", is_file ? c->model : NULL},
                                {NULL, NULL}};
    json_t *summary = to_json(j);
    clast_status status = cli_results_open(folder, fields, c, &c->seed, inputs);
    status = status == CLAST_OK ? write_folder(j, clast_run_folder_path(folder)) : status;
    status = status == CLAST_OK ? cli_results_summary(folder, summary) : status;
    json_decref(summary);
    return clast_run_folder_end(folder, status);
}

static clast_status run(const cli_common *common, void *values)
{
    config *c = values;
    job j = {0};
    clast_run_folder *folder = NULL;
    clast_status status = cli_results_begin(common, common->output, &c->force, &folder);
    if (status == CLAST_OK) {
        status = answer(c, common, &j);
    }
    if (status == CLAST_OK && folder != NULL) {
        status = keep_results(common, c, &j, folder);
    }
    if (status == CLAST_OK && common->json) {
        status = cli_print_json(to_json(&j));
    } else if (status == CLAST_OK) {
        (j.has_one ? print_one : print_beds)(&j);
    }
    clast_run_folder_destroy(folder);
    free_job(&j);
    return status;
}

const cli_command cli_predict = {
    .name = "predict",
    .arguments = "[TABLE]",
    .summary = "porosity of a bed from the flatness and elongation of its grains",
    .example = {"clast predict --flatness 0.65+-0.17 --elongation 0.68+-0.14",
                "clast predict grains.csv --grading B50",
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
