// A fit from a configuration to a folder of results.
#include <clast/aggregate_run.h>

#include "aggregate/config.h"
#include "base/alloc.h"
#include "io/config_files.h"
#include "io/json.h"
#include "run/run.h"
#include "study/aggregate_fit_chart.h"
#include <clast/run_folder.h>
#include <clast/table.h>
#include <jansson.h>
#include <math.h>
#include <string.h>

static json_t *estimate_json(const clast_fit_estimate *e)
{
    json_t *object = json_object();
    clx_json_set_number(object, "best", e->best);
    clx_json_set_number(object, "mean", e->mean);
    clx_json_set_number(object, "deviation", e->deviation);
    clx_json_set_number(object, "low", e->low);
    clx_json_set_number(object, "high", e->high);
    return object;
}

static json_t *observed_json(const clast_aggregate_fit *fit)
{
    json_t *object = json_object();
    for (int k = 0; k < CLAST_FIT_N_OBSERVABLE; ++k) {
        if (isfinite(fit->observed[k])) {
            json_t *one = json_object();
            clx_json_set_number(one, "observed", fit->observed[k]);
            clx_json_set_number(one, "error", fit->error[k]);
            clx_json_set_number(one, "model", fit->model[k].best);
            clx_json_set_number(one, "pull", fit->pull[k]);
            clx_json_set_number(one, "least_model", fit->least[k]);
            clx_json_set_number(one, "most_model", fit->most[k]);
            (void)json_object_set_new(object, clast_aggregate_fit_observable_name(k), one);
        }
    }
    return object;
}

/// Borders of the grid that the best choice lies on; null: on none.
static json_t *edge_json(const clast_aggregate_fit *fit)
{
    static const char *const packing[] = {"loosest", NULL, "tightest"};
    static const char *const replicate[] = {"least", NULL, "greatest"};
    json_t *object = json_object();
    const char *name = packing[fit->packing_edge + 1];
    (void)json_object_set_new(object, "packing", name != NULL ? json_string(name) : json_null());
    name = replicate[fit->replicate_edge + 1];
    (void)json_object_set_new(object, "replicate", name != NULL ? json_string(name) : json_null());
    return object;
}

clast_status clast_aggregate_fit_json(const clast_aggregate_fit *fit, char **text)
{
    CLX_ARGUMENTS(fit, text);
    if (fit->packing_edge < -1 || fit->packing_edge > 1 || fit->replicate_edge < -1 ||
        fit->replicate_edge > 1 || memchr(fit->words, '\0', sizeof fit->words) == NULL) {
        return clx_fail(CLAST_E_ARGUMENT,
                        "%s: fit: an edge is not -1, 0 or 1, or its words do not end", __func__);
    }
    clast_status status = CLAST_OK;
    json_t *root = json_object();
    json_t *best = json_object();
    json_t *spread = json_object();
    (void)json_object_set_new(root, "verdict", json_string(clast_fit_verdict_name(fit->verdict)));
    (void)json_object_set_new(root, "words", json_string(fit->words));
    clx_json_set_number(root, "chi2", fit->chi2);
    clx_json_set_number(root, "p_value", fit->p_value);
    (void)json_object_set_new(root, "n_observed", json_integer(fit->n_observed));
    (void)json_object_set_new(root, "n_choice", json_integer(fit->n_choice));
    (void)json_object_set_new(root, "degrees_of_freedom", json_integer(fit->n_freedom));
    (void)json_object_set_new(root, "edge", edge_json(fit));
    (void)json_object_set_new(root, "n_run", json_integer(fit->n_run));
    clx_json_set_number(best, "cone_deg", fit->cone * 180.0 / CLAST_PI);
    (void)json_object_set_new(best, "rays", json_integer(fit->rays));
    (void)json_object_set_new(best, "orientations", json_integer(fit->orientations));
    (void)json_object_set_new(best, "replicate", json_integer(fit->replicate));
    (void)json_object_set_new(root, "best", best);
    (void)json_object_set_new(root, "observables", observed_json(fit));
    (void)json_object_set_new(spread, "trials", estimate_json(&fit->trials));
    (void)json_object_set_new(spread, "replicate", estimate_json(&fit->n_replica));
    for (int k = 0; k < CLAST_FIT_N_OBSERVABLE; ++k) {
        (void)json_object_set_new(spread, clast_aggregate_fit_observable_name(k),
                                  estimate_json(&fit->model[k]));
    }
    (void)json_object_set_new(spread, "porosity", estimate_json(&fit->porosity));
    (void)json_object_set_new(root, "spread", spread);
    CLX_TRY(clx_json_dump(root, text));
done:
    json_decref(root);
    return status;
}

static clast_status write_results(const char *folder, const clast_aggregate_fit *fit,
                                  const clast_table *nodes)
{
    clast_status status = CLAST_OK;
    char *text = NULL;
    CLX_TRY(clx_run_write_table(folder, "fit.csv", nodes));
    CLX_TRY(clx_fit_chart_write(folder, fit, nodes));
    status = clast_aggregate_fit_json(fit, &text);
    CLX_TRY(clx_run_write_summary(folder, status, text));
done:
    return status;
}

clast_status clast_aggregate_fit_study(const clast_aggregate_config *config, const char *folder,
                                       const clast_monitor *monitor, clast_aggregate_fit *fit)
{
    CLX_ARGUMENTS(config, fit);
    CLX_GUARD(clast_fields_check(clast_aggregate_fields, config));
    CLX_GUARD(clx_aggregate_idle(config, folder != NULL, monitor));
    clast_status status = CLAST_OK;
    clast_aggregate_source source = {0};
    clast_run_folder *run = NULL;
    clast_table nodes = {0};
    if (folder != NULL) {
        CLX_TRY(clast_run_folder_begin(folder, config->force, "aggregate", monitor, &run));
    }
    CLX_TRY(clast_aggregate_load(config, &source));
    if (folder != NULL) {
        const clx_run_inputs inputs = clx_aggregate_inputs(config);
        CLX_TRY(clx_run_note_inputs(run, &inputs));
    }
    CLX_TRY(clast_aggregate_fit_run(config, &source.input, monitor, fit, &nodes));
    if (folder != NULL) {
        CLX_TRY(clast_run_folder_open(run));
        status = write_results(clast_run_folder_path(run), fit, &nodes);
    }
done:
    status = clast_run_folder_end(run, status);
    clast_table_free(&nodes);
    clast_run_folder_destroy(run);
    clast_aggregate_unload(&source);
    return status;
}
