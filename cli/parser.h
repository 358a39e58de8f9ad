#pragma once
// The words of a command line: options from the field table, common options, arguments.
#include "command.h"
#include "configs.h"

typedef struct cli_parser {
    const cli_command *command;
    cli_configs configs;
    cli_common common;
    void *config;
    const clast_field **touched; ///< list fields that the command line has set already
    int32_t n_touched;
    bool help, help_all;
} cli_parser;

/// Options into the configuration, the rest into the arguments. CLAST_E_USAGE, CLAST_E_CONFIG.
clast_status cli_parse(cli_parser *p, int argc, char **argv);

/// Whether the command takes so many arguments.
clast_status cli_parse_arguments(const cli_parser *p);
