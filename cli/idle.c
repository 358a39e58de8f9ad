// Options that a run would not look at.
#include "idle.h"

#include <stdio.h>
#include <string.h>

void cli_option_name(const clast_field *field, char name[CLI_NAME_SIZE])
{
    static const char either[] = "[no-]";
    const size_t n = sizeof either - 1;
    cli_field_name(field, name);
    if (strncmp(name, either, n) == 0) {
        memmove(name, "no-", 3);
        memmove(name + 3, name + n, strlen(name + n) + 1);
    }
}

clast_status cli_idle_check(const clast_field *fields, const void *config, const clast_idle *rules)
{
    const char *why = NULL;
    const clast_field *idle = clast_fields_idle(fields, config, rules, &why);
    char option[CLI_NAME_SIZE];
    if (idle == NULL) {
        return CLAST_OK;
    }
    cli_option_name(idle, option);
    return cli_fail(CLAST_E_USAGE, "--%s does nothing %s", option, why);
}

clast_status cli_idle_cells(const cli_common *common, const clast_field *fields, const void *config,
                            const cli_points *points, const clast_decompose_config *c)
{
    const bool is_full = c->variant == CLAST_VARIANT_FULL;
    const bool is_tree = clast_decompose_takes_tree(c);
    const bool may_pair = c->pairs || c->estimator == CLAST_ESTIMATOR_PAIRS ||
                          (c->estimator == CLAST_ESTIMATOR_AUTO && is_tree && c->extrapolate &&
                           !c->paper && c->events == CLAST_EVENTS_PAIRS);
    const clast_idle rules[] = {{common->output == NULL, "charts", "without -o"},
                                {points->columns.variable_column[0] == '\0', "variable_tolerance",
                                 "without --variable-column"},
                                {is_tree, "lower|strict|max_pass|ghost_samples",
                                 "with cells of the tree: --mesh boxes joins bins"},
                                {!is_tree,
                                 "tree_level|tree_root_level|tree_least|tree_refine|extrapolate",
                                 "with cells of bins: --mesh tree splits by a test"},
                                {!is_full, "max_pass", "with this --variant: it makes one pass"},
                                {!may_pair, "pairs_radius", "without --pairs"},
                                {0}};
    return cli_idle_check(fields, config, rules);
}
