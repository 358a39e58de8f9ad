// clast aggregate --fit, printed.
#include "aggregate_fit.h"

#include <clast/field.h>
#include <stdio.h>

static void print_estimate(const char *name, const clast_fit_estimate *e, const char *si_unit)
{
    double factor = 1.0;
    const char *unit = clast_unit_for(e->best, si_unit, &factor);
    (void)printf("%-18s %10.4g   %10.4g .. %-10.4g %s\n", name, e->best * factor, e->low * factor,
                 e->high * factor, unit);
}

static void print_fit(const clast_aggregate_fit *fit)
{
    (void)printf("%s\n\n", fit->words);
    (void)printf("%-18s %10s   %s\n", "", "best", "68 % of the weight between");
    print_estimate("rays x orient.", &fit->trials, "");
    print_estimate("replicate (N_A)", &fit->n_replica, "");
    print_estimate("D_agg", &fit->model[CLAST_FIT_SIZE], "m");
    print_estimate("density", &fit->model[CLAST_FIT_DENSITY], "kg/m^3");
    print_estimate("settling velocity", &fit->model[CLAST_FIT_VELOCITY], "m/s");
    print_estimate("porosity", &fit->porosity, "");
    (void)printf("\n%d aggregates grown at %d packings%s\n", fit->n_run, fit->n_level,
                 fit->cut_short ? ", tighter ones left out" : "");
}

clast_status aggregate_fit(const cli_common *common, const clast_aggregate_config *config)
{
    const clast_monitor monitor = cli_monitor(common);
    clast_status status = CLAST_OK;
    clast_aggregate_fit fit;
    char *text = NULL;
    if (config->resume[0] != '\0') {
        return cli_fail(CLAST_E_USAGE, "--fit cannot --resume: start it again");
    }
    CLI_TRY(clast_aggregate_fit_study(config, common->output, &monitor, &fit));
    if (common->json) {
        CLI_TRY(clast_aggregate_fit_json(&fit, &text));
        (void)puts(text);
    } else {
        print_fit(&fit);
    }
    CLI_CHECK(fit.verdict == CLAST_FIT_INSIDE, CLAST_E_NO,
              fit.verdict == CLAST_FIT_EDGE
                  ? "not explained: the best lies at the edge of what was tried"
                  : "not explained by what was tried");
done:
    clast_text_free(text);
    return status;
}
