// Options that every command understands besides its own fields.
#include "common_options.h"

#include <stdio.h>
#include <string.h>

const cli_option cli_options[] = {
    {"output", "PATH", "where results go", "where results go", CLI_OPTION_OUTPUT, 'o'},
    {"threads", "N", "threads", "threads; 0: one per core; results do not depend on it",
     CLI_OPTION_THREADS, 'j'},
    {"max-memory", "SIZE", NULL,
     "most that it may take: 8GB, 50% of the machine's, 0: no limit (default 80%)",
     CLI_OPTION_MAX_MEMORY, 0},
    {"time-limit", "TIME", NULL,
     "stop by itself after so long (90min), as by SIGTERM: with a checkpoint where --resume can go "
     "on",
     CLI_OPTION_TIME_LIMIT, 0},
    {"set", "KEY=VALUE", NULL, "the same as --KEY VALUE", CLI_OPTION_SET, 0},
    {"json", NULL, "one object on stdout", "one JSON object on stdout", CLI_OPTION_JSON, 0},
    {"quiet", NULL, "quiet", "no progress on stderr", CLI_OPTION_QUIET, 'q'},
    {"help", NULL, NULL, "the first page of a command; --help-all: every option of it",
     CLI_OPTION_HELP, 'h'},
    {"help-all", NULL, NULL, NULL, CLI_OPTION_HELP_ALL, 0},
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
