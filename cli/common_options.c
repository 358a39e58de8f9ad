// Options that every command understands besides its own fields.
#include "common_options.h"

#include <stdio.h>
#include <string.h>

const cli_option cli_options[] = {
    {"output", 'o', "PATH", CLI_OPTION_OUTPUT, "where results go", "where results go"},
    {"threads", 'j', "N", CLI_OPTION_THREADS, "threads",
     "threads; 0: one per core; results do not depend on it"},
    {"max-memory", 0, "SIZE", CLI_OPTION_MAX_MEMORY, NULL,
     "most that it may take: 8GB, 50% of the machine's, 0: no limit (default 80%)"},
    {"time-limit", 0, "TIME", CLI_OPTION_TIME_LIMIT, NULL,
     "stop by itself after so long (90min), as by SIGTERM: with a checkpoint where --resume can go "
     "on"},
    {"set", 0, "KEY=VALUE", CLI_OPTION_SET, NULL, "the same as --KEY VALUE"},
    {"json", 0, NULL, CLI_OPTION_JSON, "one object on stdout", "one JSON object on stdout"},
    {"quiet", 'q', NULL, CLI_OPTION_QUIET, "quiet", "no progress on stderr"},
    {"help", 'h', NULL, CLI_OPTION_HELP, NULL,
     "the first page of a command; --help-all: every option of it"},
    {"help-all", 0, NULL, CLI_OPTION_HELP_ALL, NULL, NULL},
    {0}};

const cli_option *cli_option_find(const char *name)
{
    const cli_option *o = cli_options;
    while (o->name != NULL && strcmp(o->name, name) != 0) {
        ++o;
    }
    return o->name != NULL ? o : NULL;
}

const cli_option *cli_option_of_letter(char letter)
{
    const cli_option *o = cli_options;
    while (o->name != NULL && (letter == '\0' || o->letter != letter)) {
        ++o;
    }
    return o->name != NULL ? o : NULL;
}

bool cli_option_is_of(const cli_option *option, const cli_command *command)
{
    return !(option->kind == CLI_OPTION_OUTPUT && command->writes_no_file) &&
           !(option->kind == CLI_OPTION_JSON && command->writes_no_data);
}

void cli_option_words(const cli_option *option, char words[CLI_NAME_SIZE])
{
    const char letter[] = {'-', option->letter, ',', ' ', '\0'};
    (void)snprintf(words, CLI_NAME_SIZE, "%s--%s%s%s", option->letter != '\0' ? letter : "",
                   option->name, option->value != NULL ? " " : "",
                   option->value != NULL ? option->value : "");
}
