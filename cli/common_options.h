#pragma once
// Options that every command understands besides its own fields: one table for the parser, the help
// pages, the manual and the completion.
#include "command.h"

typedef enum cli_option_kind {
    CLI_OPTION_OUTPUT,
    CLI_OPTION_THREADS,
    CLI_OPTION_MAX_MEMORY,
    CLI_OPTION_TIME_LIMIT,
    CLI_OPTION_SET,
    CLI_OPTION_JSON,
    CLI_OPTION_QUIET,
    CLI_OPTION_HELP,
    CLI_OPTION_HELP_ALL
} cli_option_kind;

typedef struct cli_option {
    const char *name;  ///< "max-memory"; NULL after the last
    const char *value; ///< what stands behind it, "PATH", or NULL
    const char *first; ///< on the first page of a command, or NULL
    const char *help;  ///< in --help-all and the manual, or NULL: another's text names it
    cli_option_kind kind;
    char letter; ///< of -o; 0: none
} cli_option;

extern const cli_option cli_options[];

/// The option --NAME, or NULL when every command has none of that name.
const cli_option *cli_option_find(const char *name);

/// The option -c, or NULL.
const cli_option *cli_option_of_letter(char letter);

/// Whether this command takes it: -o where it writes files, --json where it prints data.
bool cli_option_is_of(const cli_option *option, const cli_command *command);

/// The option as it is listed: "-o, --output PATH".
void cli_option_words(const cli_option *option, char words[CLI_NAME_SIZE]);
