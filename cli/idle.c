// Options that a run would not look at.
#include "idle.h"

#include <stdio.h>
#include <string.h>

bool cli_field_is_default(const clast_field *fields, const clast_field *field, const void *config)
{
    static _Alignas(16) char plain[16384]; // beyond every configuration
    char value[512] = "";
    char usual[512] = "";
    bool is_same = true;
    if (clast_fields_default(fields, plain) != CLAST_OK) {
        return true;
    }
    is_same = clast_field_count(field, config) == clast_field_count(field, plain);
    for (int32_t k = 0; k < clast_field_count(field, config) && is_same; ++k) {
        (void)clast_field_format(field, config, k, sizeof value, value);
        (void)clast_field_format(field, plain, k, sizeof usual, usual);
        is_same = strcmp(value, usual) == 0;
    }
    clast_fields_free(fields, plain);
    return is_same;
}

bool cli_is_among(const char *name, const char *const *list)
{
    while (*list != NULL && strcmp(*list, name) != 0) {
        ++list;
    }
    return *list != NULL;
}

const char *cli_idle_why(const cli_idle *rules, size_t n, const char *name)
{
    for (size_t k = 0; k < n; ++k) {
        if (rules[k].is_idle && cli_is_among(name, rules[k].names)) {
            return rules[k].why;
        }
    }
    return NULL;
}

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

clast_status cli_idle_check(const clast_field *fields, const void *config, const cli_idle *rules,
                            size_t n)
{
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        const char *const why = cli_idle_why(rules, n, f->name);
        char option[CLI_NAME_SIZE];
        if (why != NULL && !cli_field_is_default(fields, f, config)) {
            cli_option_name(f, option);
            return cli_fail(CLAST_E_USAGE, "--%s does nothing %s", option, why);
        }
    }
    return CLAST_OK;
}

clast_status cli_idle_cells(const cli_common *common, const clast_field *fields, const void *config,
                            const cli_points *points, const clast_decompose_config *c)
{
    static const char *const drawn[] = {"charts", NULL};
    static const char *const variable[] = {"variable_tolerance", NULL};
    static const char *const bins[] = {"lower", "strict", "max_pass", "ghost_samples", NULL};
    static const char *const tree[] = {"tree_level",  "tree_root_level", "tree_least",
                                       "tree_refine", "extrapolate",     NULL};
    static const char *const passes[] = {"max_pass", NULL};
    static const char *const radius[] = {"pairs_radius", NULL};
    const bool is_full = c->variant == CLAST_VARIANT_FULL;
    const bool is_tree = clast_decompose_takes_tree(c);
    const bool may_pair = c->pairs || c->estimator == CLAST_ESTIMATOR_PAIRS ||
                          (c->estimator == CLAST_ESTIMATOR_AUTO && is_tree && c->extrapolate &&
                           !c->paper && c->events == CLAST_EVENTS_PAIRS);
    const cli_idle rules[] = {
        {common->output == NULL, drawn, "without -o"},
        {points->columns.variable_column[0] == '\0', variable, "without --variable-column"},
        {is_tree, bins, "with cells of the tree: --mesh boxes joins bins"},
        {!is_tree, tree, "with cells of bins: --mesh tree splits by a test"},
        {!is_full, passes, "with this --variant: it makes one pass"},
        {!may_pair, radius, "without --pairs"},
    };
    return cli_idle_check(fields, config, rules, sizeof rules / sizeof rules[0]);
}
