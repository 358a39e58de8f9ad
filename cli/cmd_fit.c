// clast fit: linear porosity models of a table of beds.
#include "command.h"
#include "configs.h"
#include "idle.h"
#include "json.h"
#include "predict_words.h"
#include "results.h"

#include <clast/chart.h>
#include <clast/porosity_model.h>
#include <clast/run_folder.h>
#include <clast/study.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    clast_porosity_fit_config fit; // first: the two tables share offsets
    int32_t features;
    char *grains;
    char *name;
    bool force;
} config;

enum { MAX_FIELD = 32 };
enum { AUTO }; ///< of the choices of features; the others are clast_model_kind and one

static clast_field fields[MAX_FIELD];

static const clast_field own[] = {
    {"features", .offset = offsetof(config, features), CLAST_FIELD_CHOICE, 0, 0, 0, "-",
     "features to choose from; form: 26 of each bed's one form; mixture: 104 of --grains; columns: "
     "the table's own; auto: "
     "mixture with --grains, else form where columns are named as a form's, else columns",
     "auto|form|mixture|columns", .common = true, .group = "features and grains"},
    {"grains", .offset = offsetof(config, grains), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "study folder, or table of all beds' grains, with a column that names the bed (--group)", "",
     .common = true},
    {"name", .offset = offsetof(config, name), CLAST_FIELD_TEXT, 0, 0, 0, "-", "name of the model",
     "fitted", .common = true},
    CLI_FORCE(config),
    {0}};

__attribute__((constructor)) static void join_fields(void)
{
    cli_joined joined = {fields, MAX_FIELD, 0};
    cli_joined_append_all(&joined, clast_porosity_fit_fields, 0);
    cli_joined_append_all(&joined, own, 0);
}

typedef struct {
    clast_table beds, grains;
    clast_fit_data data;
    clast_porosity_fit fit;
} job;

static void free_job(job *j)
{
    clast_table_free(&j->beds);
    clast_table_free(&j->grains);
    clast_fit_data_free(&j->data);
    clast_porosity_fit_free(&j->fit);
}

static void print_note(const clast_table *beds, const clast_fit_note *note)
{
    (void)fprintf(stderr, "clast fit: %s%s%s\n", note->is_of_table ? cli_name(beds->name) : "",
                  note->is_of_table ? ": " : "", cli_name(note->text));
}

static clast_status choose(const config *c, const clast_table *beds, clast_model_kind *kind)
{
    clast_fit_note note;
    if (c->features != AUTO) {
        *kind = (clast_model_kind)(c->features - 1);
        return CLAST_OK;
    }
    CLI_GUARD(clast_porosity_fit_choose(beds, c->grains[0] != '\0', &c->fit, kind, &note));
    if (note.text[0] != '\0') {
        print_note(beds, &note);
    }
    return CLAST_OK;
}

/// Rows of the grains that have no form.
static clast_status tell_grains(const clast_table *grains, const char *columns)
{
    char complaint[512];
    clast_form_set set = {0};
    CLI_GUARD(clast_form_set_of(grains, columns, &set));
    clast_form_set_complaint(&set, sizeof complaint, complaint);
    if (complaint[0] != '\0') {
        (void)fprintf(stderr, "clast fit: %s: %s\n", cli_name(grains->name), complaint);
    }
    clast_form_set_free(&set);
    return CLAST_OK;
}

static clast_status gather(const config *c, const char *path, job *j)
{
    clast_idle rules[CLAST_N_IDLE];
    clast_model_kind kind = CLAST_MODEL_COLUMNS;
    CLI_GUARD(clast_table_read_csv(path, NULL, &j->beds, NULL));
    CLI_GUARD(choose(c, &j->beds, &kind));
    CLI_GUARD(cli_idle_check(fields, c,
                             clast_porosity_fit_idle(&c->fit, kind != CLAST_MODEL_SINGLE, rules)));
    if ((kind == CLAST_MODEL_MIXTURE) != (c->grains[0] != '\0')) {
        return cli_fail(
            CLAST_E_USAGE,
            "--features mixture and --grains FILE belong together: the 104 features are "
            "means and deviations over the grains");
    }
    if (kind == CLAST_MODEL_SINGLE) {
        return clast_fit_data_single(&j->beds, &c->fit, &j->data);
    }
    if (kind == CLAST_MODEL_COLUMNS) {
        return clast_fit_data_columns(&j->beds, &c->fit, &j->data);
    }
    CLI_GUARD(cli_is_folder(c->grains)
                  ? clast_study_grains(c->grains, &j->beds, c->fit.group, &j->grains)
                  : clast_table_read_csv(c->grains, NULL, &j->grains, NULL));
    CLI_GUARD(clast_fit_data_mixture(&j->beds, &j->grains, &c->fit, &j->data));
    return tell_grains(&j->grains, c->fit.columns);
}

/// Rows of a table as JSON objects.
static json_t *json_rows(const clast_table *t)
{
    json_t *list = json_array();
    for (int64_t i = 0; i < t->n_row; ++i) {
        json_t *row = json_object();
        for (int32_t c = 0; c < t->n_column; ++c) {
            const clast_column *column = &t->column[c];
            if (column->text != NULL) {
                cli_json_text(row, column->name, column->text[i]);
            } else {
                cli_json_number(row, column->name, column->number[i]);
            }
        }
        (void)json_array_append_new(list, row);
    }
    return list;
}

static json_t *summary(const job *j)
{
    json_t *out = json_object();
    const clast_porosity_model *m = &j->fit.model;
    cli_json_text(out, "model", m->name);
    cli_json_text(out, "kind", clast_model_kind_name(m->kind));
    cli_json_count(out, "n_bed", m->n_bed);
    cli_json_count(out, "n_left_out", j->data.left_out.n_row);
    cli_json_count(out, "n_candidate", j->data.beds.n_column - 2);
    cli_json_count(out, "n_removed", j->fit.n_removed);
    cli_json_number(out, "r2", m->r2);
    cli_json_number(out, "cv_mean_error", m->cv_mean_error);
    cli_json_number(out, "cv_median_error", m->cv_median_error);
    cli_json_number(out, "r2_held_out", j->fit.r2_held_out);
    cli_json_number(out, "p_value", j->fit.p_value);
    cli_json_number(out, "residual_deviation", m->deviation);
    cli_json_number(out, "condition", j->fit.condition);
    (void)json_object_set_new(out, "terms", json_rows(&j->fit.terms));
    (void)json_object_set_new(out, "ranking", json_rows(&j->fit.ranking));
    (void)json_object_set_new(out, "trials", json_rows(&j->fit.trials));
    return out;
}

/// What held-out beds and permutations say of the model.
static void print_validity(const clast_porosity_fit_config *c, const clast_porosity_fit *fit)
{
    const bool is_selected = c->use[0] == '\0';
    const bool is_nested = c->validation == CLAST_VALIDATION_NESTED;
    (void)printf("held-out absolute error%s: mean %.4g, median %.4g",
                 !is_selected ? ""
                 : is_nested  ? ", features selected without the held-out beds"
                              : ", as published (held-out beds had their say in the selection: "
                                "too small)",
                 fit->model.cv_mean_error, fit->model.cv_median_error);
    (void)(is_nested ? printf("; R2 %.4f\n", fit->r2_held_out) : printf("\n"));
    if (fit->r2_held_out <= 0.0) {
        (void)printf("the model predicts held-out beds no better than the mean of the others\n");
    }
    if (c->n_permutation > 0) {
        (void)printf("p %.3g: of %d permutations of the porosities, this share is fitted as well "
                     "by %s\n",
                     fit->p_value, c->n_permutation,
                     is_selected ? "a selection of its own" : "these features");
    }
}

static void print_words(const config *chosen, const job *j)
{
    const clast_porosity_model *m = &j->fit.model;
    const clast_table *rank = &j->fit.ranking;
    const clast_table *terms = &j->fit.terms;
    const clast_column *const units = &terms->column[clast_table_find(terms, "unit")];
    const double *const c = clast_table_numbers(terms, "coefficient");
    const double *const e = clast_table_numbers(terms, "standard_error");
    const double *const vif = clast_table_numbers(terms, "vif");
    (void)printf(
        "%lld beds, %lld rows left out, %d candidate features, %d removed as like a chosen "
        "one\n\n",
        (long long)m->n_bed, (long long)j->data.left_out.n_row, j->data.beds.n_column - 2,
        j->fit.n_removed);
    (void)printf("%-44s %9s  %s\n", "correlation with the porosity", "r", "state");
    for (int64_t k = 0; k < rank->n_row && k < 10; ++k) {
        (void)printf("%-44s %9.4f  %s\n", rank->column[0].text[k], rank->column[1].number[k],
                     rank->column[3].text[k]);
    }
    (void)printf("\n%-44s %12s %12s %8s\n", "model", "coefficient", "std. error", "VIF");
    for (int64_t k = 0; k < terms->n_row; ++k) {
        char name[128];
        cli_feature_name(terms->column[0].text[k], units->text[k], sizeof name, name);
        (void)printf("%-44s %12.6g %12.3g", name, c[k], e[k]);
        (void)(k > 0 ? printf(" %8.3g\n", vif[k]) : printf("\n"));
    }
    (void)printf("\nR2 %.4f, residual deviation %.3g, condition %.3g\n", m->r2, m->deviation,
                 j->fit.condition);
    print_validity(&chosen->fit, &j->fit);
}

static clast_status write_model(const cli_common *common, const config *c, const job *j,
                                const char *folder)
{
    char path[4096];
    char hash[2][65] = {"", ""};
    char seed[32];
    int64_t n_byte = 0;
    CLI_GUARD(clast_sha256_file(common->argument[0], hash[0], &n_byte));
    if (c->grains[0] != '\0' && !cli_is_folder(c->grains)) {
        CLI_GUARD(clast_sha256_file(c->grains, hash[1], &n_byte));
    }
    (void)snprintf(seed, sizeof seed, "%llu", (unsigned long long)c->fit.seed);
    const char *const notes[][2] = {{"clast", clast_version()},
                                    {"table_sha256", hash[0]},
                                    {"grains_sha256", hash[1]},
                                    {"target", c->fit.target},
                                    {"seed", seed}};
    (void)snprintf(path, sizeof path, "%s/model.json", folder);
    return clast_porosity_model_write(&j->fit.model, notes,
                                      (int32_t)(sizeof notes / sizeof notes[0]), path);
}

static clast_status write_folder(const cli_common *common, const config *c, const job *j,
                                 const char *folder)
{
    char path[4096];
    const struct {
        const char *name;
        const clast_table *table;
    } tables[] = {{"ranking", &j->fit.ranking}, {"trials", &j->fit.trials},
                  {"terms", &j->fit.terms},     {"rows", &j->fit.rows},
                  {"features", &j->data.beds},  {"left_out", &j->data.left_out}};
    CLI_GUARD(write_model(common, c, j, folder));
    for (size_t k = 0; k < sizeof tables / sizeof tables[0]; ++k) {
        if (tables[k].table->n_row > 0) {
            (void)snprintf(path, sizeof path, "%s/%s.csv", folder, tables[k].name);
            CLI_GUARD(clast_table_write_csv(tables[k].table, path));
        }
    }
    return CLAST_OK;
}

static clast_status write_charts(const char *folder, const job *j)
{
    char path[4096];
    for (int k = 0; k < CLAST_N_FIT_CHART; ++k) {
        (void)snprintf(path, sizeof path, "%s/%s.svg", folder,
                       clast_fit_chart_name((clast_fit_chart)k));
        CLI_GUARD(clast_chart_fit((clast_fit_chart)k, &j->data, &j->fit, path));
    }
    return CLAST_OK;
}

/// Prints what people should know, from line n_told on; the number of lines.
static int32_t tell(const config *c, const job *j, const clast_porosity_fit *fit, int32_t n_told)
{
    clast_fit_note note;
    for (; clast_porosity_fit_note(fit, &j->beds, &j->data, n_told, &c->fit, &note); ++n_told) {
        print_note(&j->beds, &note);
    }
    return n_told;
}

static clast_status write_results(const cli_common *common, const config *c, const job *j,
                                  clast_run_folder *folder)
{
    const cli_input inputs[] = {{"table", common->argument[0]},
                                {"grains", cli_is_folder(c->grains) ? NULL : c->grains},
                                {NULL, NULL}};
    const char *path = clast_run_folder_path(folder);
    json_t *out = summary(j);
    clast_status status = CLAST_OK;
    CLI_TRY(cli_results_open(folder, fields, c, &c->fit.seed, inputs));
    CLI_TRY(write_folder(common, c, j, path));
    CLI_TRY(write_charts(path, j));
    CLI_TRY(cli_results_summary(folder, out));
done:
    json_decref(out);
    return clast_run_folder_end(folder, status);
}

static clast_status run(const cli_common *common, void *values)
{
    config *c = values;
    char source[256];
    int32_t n_told = 0;
    job j = {0};
    clast_run_folder *folder = NULL;
    clast_status status = CLAST_OK;
    CLI_TRY(cli_results_begin(common, common->output, &c->force, &folder));
    CLI_TRY(gather(c, common->argument[0], &j));
    n_told = tell(c, &j, NULL, 0);
    (void)snprintf(source, sizeof source, "fitted by clast %s to %s", clast_version(), j.beds.name);
    CLI_TRY(clast_porosity_fit_data(&j.data, c->name, source, &c->fit, &j.fit));
    (void)tell(c, &j, &j.fit, n_told);
    if (folder != NULL) {
        CLI_TRY(write_results(common, c, &j, folder));
    }
    if (common->json) {
        CLI_TRY(cli_print_json(summary(&j)));
    } else {
        print_words(c, &j);
    }
done:
    clast_run_folder_destroy(folder);
    free_job(&j);
    return status;
}

const cli_command cli_fit = {
    .name = "fit",
    .arguments = "TABLE",
    .summary = "fit a linear porosity model to a table of beds",
    .example = {"clast fit beds.csv -o model/",
                "clast fit beds.csv --target porosity --n-term 3 --json",
                "clast fit study/results.csv --grains study/ --group run --target porosity_bulk -o "
                "model/"},
    .details =
        "TABLE has a row a bed: its porosity and its form (flatness and elongation, or L, I, S), "
        "or\n"
        "other columns of numbers; with --grains a second table, or the folder of the study of "
        "clast\n"
        "pack that made them (--group run), holds the grains of all beds.\n"
        "1. Features are ranked by their correlation with the porosity; the first is taken.\n"
        "2. Features with |r| > 0.8 to a taken one are removed.\n"
        "3. Of the others the one with the least held-out error (10 folds) joins, until --n-term.\n"
        "The reported errors are of beds without which features were selected anew "
        "(--validation).\n"
        "Method: Rettinger et al., Granular Matter 24 (2022) 118, sec. 6.3 and 7.2.\n"
        "-o FOLDER writes model.json (for clast predict --model), ranking.csv, trials.csv, "
        "terms.csv,\n"
        "rows.csv (residual, held-out value, leverage, studentised residual, Cook's distance),\n"
        "features.csv, left_out.csv and the charts feature, predicted, residuals and leverage "
        "(SVG), summary.json, manifest.json.\n"
        "Theory: docs/theory/predict.md.",
    .fields = fields,
    .config_size = sizeof(config),
    .n_min = 1,
    .n_max = 1,
    .writes_folder = true,
    .run = run,
};
