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
                            const cli_points *points, const clast_decompose_config *c,
                            int32_t n_size)
{
    const clast_idle charts[] = {{common->output == NULL, "charts", "without -o"}, {0}};
    const bool has_variable = points->columns.variable_column[0] != '\0';
    clast_idle rules[CLAST_N_IDLE];
    CLI_GUARD(cli_idle_check(fields, config, charts));
    return cli_idle_check(fields, config, clast_decompose_idle(c, has_variable, n_size, rules));
}
