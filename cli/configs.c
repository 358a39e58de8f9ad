// YAML configurations of a command: its field table, and one key more for its positional arguments.
#include "configs.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool cli_is_config(const char *word)
{
    const char *dot = strrchr(word, '.');
    return dot != NULL && (strcmp(dot, ".yaml") == 0 || strcmp(dot, ".yml") == 0);
}

void cli_configs_key(const cli_command *command, char key[CLI_NAME_SIZE])
{
    const char *at = command->arguments + (command->arguments[0] == '[' ? 1 : 0);
    int n = 0;
    while (command->n_max > 0 && n + 1 < CLI_NAME_SIZE && isupper((unsigned char)at[n])) {
        key[n] = (char)tolower((unsigned char)at[n]);
        ++n;
    }
    key[n] = '\0';
}

void cli_joined_append(cli_joined *joined, clast_field field, size_t offset)
{
    if (joined->n + 1 >= joined->size) {
        (void)fprintf(stderr, "clast: a table of %d rows has no row for %s\n", joined->size,
                      field.name);
        abort();
    }
    field.offset += offset;
    joined->field[joined->n++] = field;
}

void cli_joined_append_all(cli_joined *joined, const clast_field *fields, size_t offset)
{
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        cli_joined_append(joined, *f, offset);
    }
}

static size_t count_fields(const clast_field *fields)
{
    size_t n = 0;
    while (fields[n].name != NULL) {
        ++n;
    }
    return n;
}

bool cli_configs_init(const cli_command *command, cli_configs *configs)
{
    *configs = (cli_configs){.size = command->config_size + 1};
    if (command->fields == NULL) {
        return true;
    }
    const size_t n = count_fields(command->fields);
    configs->fields = calloc(n + 2, sizeof *configs->fields);
    if (configs->fields == NULL) {
        return false;
    }
    memcpy(configs->fields, command->fields, n * sizeof *configs->fields);
    cli_configs_key(command, configs->key);
    if (configs->key[0] != '\0' && clast_fields_find(command->fields, configs->key) == NULL) {
        const size_t align = sizeof(clast_text_list);
        configs->list = (command->config_size / align + 1) * align;
        configs->size = configs->list + sizeof(clast_text_list);
        configs->fields[n] = (clast_field){.name = configs->key,
                                           .offset = configs->list,
                                           .type = CLAST_FIELD_TEXT_LIST,
                                           .unit = "-",
                                           .help = "what stands before the options",
                                           .text = ""};
    }
    return true;
}

void cli_configs_free(cli_configs *configs)
{
    free(configs->fields);
    *configs = (cli_configs){0};
}

clast_text_list cli_configs_arguments(const cli_configs *configs, const void *values)
{
    clast_text_list list = {0};
    if (configs->list != 0) {
        memcpy(&list, (const char *)values + configs->list, sizeof list);
    }
    return list;
}
