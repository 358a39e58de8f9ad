#pragma once
// YAML configurations of a command: its field table, and one key more for its positional arguments.
#include "command.h"

/// A command's keys. `fields` are the command's own and, where it takes positional arguments, their
/// key as a list: "points" of POINTS..., "file" of FILE.
typedef struct cli_configs {
    clast_field *fields; ///< NULL for a command without options
    size_t size;         ///< bytes of the configuration struct with the list behind it
    size_t list;         ///< offset of the list of arguments, 0: no key
    char key[CLI_NAME_SIZE];
} cli_configs;

/// A command's table made of parts before main(); the array is static, so that it ends with {0}.
typedef struct cli_joined {
    clast_field *field; ///< [size]
    int size, n;
} cli_joined;

/// Appends a field of a struct that lies `offset` bytes into the command's. A table that is full
/// ends the program: without the field its key would be unknown.
void cli_joined_append(cli_joined *joined, clast_field field, size_t offset);

/// The same of all fields of a table.
void cli_joined_append_all(cli_joined *joined, const clast_field *fields, size_t offset);

/// False when memory is short. A command without options reads no configuration.
bool cli_configs_init(const cli_command *command, cli_configs *configs);
void cli_configs_free(cli_configs *configs);

/// Whether this word names a configuration (.yaml, .yml).
bool cli_is_config(const char *word);

/// Positional arguments that the configurations named; n is 0 when they named none.
clast_text_list cli_configs_arguments(const cli_configs *configs, const void *values);

/// The key of a command's positional arguments, "" when it has none: lower-case first word of its
/// synopsis.
void cli_configs_key(const cli_command *command, char key[CLI_NAME_SIZE]);
