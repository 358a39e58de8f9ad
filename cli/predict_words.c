// What clast predict found: as JSON, in words.
#include "predict_words.h"

#include "command.h"
#include "json.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

int64_t cli_prediction_left_out(const cli_prediction *j)
{
    return j->model.kind == CLAST_MODEL_COLUMNS ? j->table.n_row - j->beds.n_row
                                                : j->set.n_left_out;
}

static json_t *json_inputs(const cli_prediction *j)
{
    json_t *in = json_object();
    const clast_form_inputs *v = &j->inputs;
    cli_json_text(in, "from", j->has_table ? "table" : "moments");
    if (j->has_table) {
        cli_json_count(in, "n_left_out", cli_prediction_left_out(j));
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

static json_t *json_outside(const cli_prediction *j)
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

json_t *cli_prediction_json(const cli_prediction *j)
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
        if (isfinite(p->sampling_error)) { // else not known
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

void cli_feature_name(const char *name, const char *unit, size_t size, char *text)
{
    (void)(unit == NULL || strcmp(unit, "-") == 0 ? snprintf(text, size, "%s", name)
                                                  : snprintf(text, size, "%s (%s)", name, unit));
}

static void print_formula(const clast_porosity_model *m)
{
    (void)printf("model      %s (%s)\n           porosity = %.6g", m->name, m->source,
                 m->intercept);
    for (int32_t k = 0; k < m->n_term; ++k) {
        if (m->term[k].coefficient == 0.0) {
            continue; // of eq. 23, which has no fourth term
        }
        char name[256];
        cli_feature_name(m->term[k].feature, m->term[k].unit, sizeof name, name);
        (void)printf(" %c %.6g %s", m->term[k].coefficient < 0.0 ? '-' : '+',
                     fabs(m->term[k].coefficient), name);
    }
    (void)printf("\n");
}

/// Means of the form, with deviations where they are known, be they 0.
static void print_form(const cli_prediction *j)
{
    const clast_form_inputs *v = &j->inputs;
    if (j->knows_spread) {
        (void)printf(
            "flatness   %.4f +- %.4f\nelongation %.4f +- %.4f\nequancy    %.4f +- %.4f%s\n",
            v->flatness_mean, v->flatness_deviation, v->elongation_mean, v->elongation_deviation,
            v->equancy_mean, v->equancy_deviation,
            v->is_independent ? " (flatness and elongation taken as independent)" : "");
    } else {
        (void)printf("flatness   %.4f\nelongation %.4f\nequancy    %.4f (%s)\n", v->flatness_mean,
                     v->elongation_mean, v->equancy_mean,
                     j->has_table ? "of one grain" : "of the means: no deviations were given");
    }
}

static void print_one(const cli_prediction *j)
{
    const clast_form_inputs *v = &j->inputs;
    const clast_prediction *p = &j->prediction;
    (void)printf("porosity   %.4f +- %.4f  (one standard error: model %.4f, coefficients %.4f, "
                 "sampling ",
                 p->porosity, p->standard_error, p->model_error, p->coefficient_error);
    (void)(isfinite(p->sampling_error) ? printf("%.4f)\n", p->sampling_error)
                                       : printf("not known)\n"));
    print_formula(&j->model);
    if (v->n_grain > 0) {
        (void)printf("grains     %lld\n", (long long)v->n_grain);
    }
    print_form(j);
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

static void print_beds(const cli_prediction *j)
{
    print_formula(&j->model);
    (void)printf("%8s %10s %14s  %s\n", "row", "porosity", "standard_error", "in range");
    const double *row = clast_table_numbers(&j->beds, "row");
    const double *porosity = clast_table_numbers(&j->beds, "porosity");
    const double *error = clast_table_numbers(&j->beds, "standard_error");
    const double *in_range = clast_table_numbers(&j->beds, "in_range");
    for (int64_t i = 0; i < j->beds.n_row; ++i) {
        (void)(isnan(porosity[i]) ? printf("%8.0f %10s %14s", row[i], "-", "-")
                                  : printf("%8.0f %10.4f %14.4f", row[i], porosity[i], error[i]));
        (void)printf("  %s\n", in_range[i] > 0.5 ? "yes" : "no");
    }
}

void cli_prediction_print(const cli_prediction *j)
{
    (j->has_one ? print_one : print_beds)(j);
}
