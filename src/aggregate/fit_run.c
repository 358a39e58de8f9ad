// A fit from its checks to its table of nodes.
#include "aggregate/fit.h"

#include "base/status.h"
#include <clast/table.h>
#include <math.h>

static clast_status check_observed(clx_fit *fit)
{
    clast_status status = CLAST_OK;
    const clast_aggregate_config *c = fit->config;
    const double value[] = {c->observed_size, c->observed_density, c->observed_velocity};
    const double error[] = {c->observed_size_error, c->observed_density_error,
                            c->observed_velocity_error};
    int32_t n = 0;
    for (int k = 0; k < CLAST_FIT_N_OBSERVABLE; ++k) {
        CLX_CHECK((value[k] > 0.0) == (error[k] > 0.0), CLAST_E_CONFIG,
                  "fit: observed %s %g %s with error %g: give both or neither",
                  clast_aggregate_fit_observable_name(k), value[k],
                  clast_aggregate_fit_observable_unit(k), error[k]);
        fit->observed[k] = value[k] > 0.0 ? value[k] : (double)NAN;
        fit->error[k] = error[k];
        n += value[k] > 0.0;
    }
    CLX_CHECK(n > 0, CLAST_E_CONFIG,
              "fit: give observed_size, observed_density or observed_velocity with their errors");
done:
    return status;
}

/// Options that the fit is to find, or that would end growth before it is measured.
static clast_status check_options(const clast_aggregate_config *c)
{
    clast_status status = CLAST_OK;
    clast_aggregate_config fresh;
    CLX_TRY(clast_fields_default(clast_aggregate_fields, &fresh));
    CLX_CHECK(c->params.cone == fresh.params.cone && c->params.rays == fresh.params.rays &&
                  c->params.orientations == fresh.params.orientations,
              CLAST_E_CONFIG,
              "fit finds cone, rays and orientations: drop them, or give packings by fit_packing");
    CLX_CHECK(c->params.replicate == fresh.params.replicate, CLAST_E_CONFIG,
              "fit finds replicate: drop it, or bound it by fit_replicate_max");
    CLX_CHECK(c->params.mode == CLAST_AGGREGATE_CORE, CLAST_E_CONFIG,
              "fit grows on a core; mode: cluster has no packing to find");
    CLX_CHECK(c->params.size_law == CLAST_SIZE_LIST && c->params.n_particle == 0, CLAST_E_CONFIG,
              "fit takes a whole list of sizes, N_A times: drop size_law and n_particle");
    CLX_CHECK(
        !(c->params.stop_mass > 0.0 || c->params.stop_size > 0.0 || c->params.stop_porosity > 0.0),
        CLAST_E_CONFIG,
        "fit grows to the end of the list: drop stop_mass, stop_size, stop_porosity");
done:
    clast_fields_free(clast_aggregate_fields, &fresh);
    return status;
}

static clast_status make_table(const clx_fit *fit, clast_table *table)
{
    static const char *const column[][2] = {{"cone_rad", "rad"},
                                            {"rays", "-"},
                                            {"orientations", "-"},
                                            {"replicate", "-"},
                                            {"n_run", "-"},
                                            {"d_agg_m", "m"},
                                            {"d_agg_deviation_m", "m"},
                                            {"density_kg/m^3", "kg/m^3"},
                                            {"density_deviation_kg/m^3", "kg/m^3"},
                                            {"settling_velocity_m/s", "m/s"},
                                            {"settling_velocity_deviation_m/s", "m/s"},
                                            {"porosity", "-"},
                                            {"porosity_deviation", "-"},
                                            {"chi2", "-"},
                                            {"inside", "-"},
                                            {"weight", "-"}};
    clast_status status = CLAST_OK;
    clast_table made = {0};
    CLX_TRY(clast_table_init(&made, "fit", fit->n_node));
    for (size_t k = 0; k < sizeof column / sizeof column[0]; ++k) {
        CLX_TRY(clast_table_add_number(&made, column[k][0], column[k][1], NULL));
    }
    for (int32_t i = 0; i < fit->n_node; ++i) {
        const clx_fit_node *node = &fit->node[i];
        const clx_fit_packing *p = &fit->packing[node->level];
        const double first[] = {p->cone, p->rays, p->orientations, node->replicate, node->n_run};
        int c = 0;
        for (; c < 5; ++c) {
            made.column[c].number[i] = first[c];
        }
        for (int k = 0; k < CLX_FIT_N_MODEL; ++k) {
            made.column[c++].number[i] = node->mean[k];
            made.column[c++].number[i] = node->deviation[k];
        }
        made.column[c++].number[i] = node->chi2;
        made.column[c++].number[i] = node->is_inside;
        made.column[c].number[i] = node->weight;
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

clast_status clast_aggregate_fit_run(const clast_aggregate_config *config,
                                     const clast_aggregate_input *input,
                                     const clast_monitor *monitor, clast_aggregate_fit *fit,
                                     clast_table *nodes)
{
    CLX_ARGUMENTS(config, input, fit, nodes);
    CLX_GUARD(clast_fields_check(clast_aggregate_fields, config));
    clast_status status = CLAST_OK;
    clx_fit f = {.config = config, .input = input, .monitor = monitor};
    clast_aggregate_fit made;
    CLX_TRY(check_observed(&f));
    CLX_TRY(check_options(config));
    CLX_TRY(clx_fit_packings(&f));
    CLX_TRY(clx_fit_grow(&f));
    CLX_TRY(clx_fit_weigh(&f, &made));
    CLX_TRY(make_table(&f, nodes));
    *fit = made;
done:
    clx_fit_free(&f);
    return status;
}
