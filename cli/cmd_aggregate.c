// clast aggregate: grow virtual aggregates grain by grain.
#include "command.h"

#include "aggregate_report.h"
#include <stdlib.h>

/// Grows repeat `repeat` to its end.
static clast_status grow(const clast_aggregate_config *config, const clast_aggregate_input *input,
                         int32_t repeat, const clast_monitor *monitor, aggregate_report *report)
{
    clast_aggregate *aggregate = NULL;
    clast_status status = clast_aggregate_create(config, input, repeat, &aggregate);
    if (status == CLAST_OK) {
        status = clast_aggregate_grow(aggregate, INT32_MAX, monitor);
    }
    if (status == CLAST_OK) {
        status = aggregate_report_add(report, aggregate);
    }
    clast_aggregate_destroy(aggregate);
    return status;
}

static clast_status run(const cli_common *common, void *context)
{
    const clast_aggregate_config *config = context;
    clast_aggregate_source source = {0};
    aggregate_report report = {.config = config};
    const clast_monitor monitor = cli_monitor(common);
    clast_status status = clast_aggregate_load(config, &source);
    for (int32_t r = 0; r < config->repeats && status == CLAST_OK; ++r) {
        status = grow(config, &source.input, r, &monitor, &report);
    }
    if (status == CLAST_OK) {
        status = aggregate_report_print(&report, common);
    }
    aggregate_report_free(&report);
    clast_aggregate_unload(&source);
    return status;
}

static const char details[] =
    "The core lies at the origin. Each particle is tried along N_r rays in a cone about an axis,\n"
    "in N_o orientations on each ray, comes from outside to its first touch, and stays where its\n"
    "centre of mass ends nearest to the target. Nothing moves after that.\n"
    "Rossi and Bonadonna (2021), SCARLET-1.0; contact: march repeats their two programs.";

const cli_command cli_aggregate = {
    .name = "aggregate",
    .arguments = "",
    .summary = "grow virtual aggregates from shapes and grain sizes",
    .details = details,
    .fields = clast_aggregate_fields,
    .config_size = sizeof(clast_aggregate_config),
    .takes_config = true,
    .run = run,
};
