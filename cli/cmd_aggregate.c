// clast aggregate: grow virtual aggregates grain by grain.
#include "command.h"

#include <jansson.h>
#include <stdio.h>

static int print_json(json_t *object)
{
    const int failed = json_dumpf(object, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    (void)putchar('\n');
    json_decref(object);
    return failed;
}

static clast_status report(const cli_common *common, const clast_aggregate *a)
{
    const clast_aggregate_result r = clast_aggregate_now(a);
    if (common->json) {
        (void)print_json(json_pack("{s:i,s:f,s:f,s:f,s:f,s:f}", "n_grain", r.n_grain, "solid_sum",
                                   r.solid_sum, "radius_of_gyration", r.radius_of_gyration,
                                   "max_overlap", r.max_overlap, "wall_s", r.wall_s, "contact_s",
                                   r.contact_s));
    } else {
        (void)printf("%d grains\n", r.n_grain);
    }
    return CLAST_OK;
}

static clast_status run(const cli_common *common, void *context)
{
    clast_aggregate_config *config = context;
    clast_aggregate_source source = {0};
    clast_aggregate *aggregate = NULL;
    const clast_monitor monitor = cli_monitor(common);
    clast_status status = clast_aggregate_load(config, &source);
    if (status == CLAST_OK) {
        status = clast_aggregate_create(config, &source.input, 0, &aggregate);
    }
    if (status == CLAST_OK) {
        status = clast_aggregate_grow(aggregate, INT32_MAX, &monitor);
    }
    if (status == CLAST_OK) {
        status = report(common, aggregate);
    }
    clast_aggregate_destroy(aggregate);
    clast_aggregate_unload(&source);
    return status;
}

const cli_command cli_aggregate = {
    .name = "aggregate",
    .arguments = "",
    .summary = "grow virtual aggregates from shapes and grain sizes",
    .fields = clast_aggregate_fields,
    .config_size = sizeof(clast_aggregate_config),
    .takes_config = true,
    .run = run,
};
