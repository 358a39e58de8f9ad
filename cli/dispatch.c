// Finds the subcommand and runs it.
#include "command.h"

#include "clast_source.h"
#include <signal.h>
#include <stdio.h>
#include <string.h>

#define COMMAND(identifier) extern const cli_command cli_##identifier;
#include "commands.def" // registry
#undef COMMAND

static const cli_command *const commands[] = {
#define COMMAND(identifier) &cli_##identifier,
#include "commands.def" // registry
#undef COMMAND
    NULL};

const cli_command *cli_command_at(int32_t index)
{
    const int32_t n = (int32_t)(sizeof commands / sizeof commands[0]) - 1;
    return index < n ? commands[index] : NULL;
}

static void print_usage(FILE *out)
{
    (void)fprintf(out, "usage: clast COMMAND [arguments] [options]\n\n"
                       "particles that stick, settle and cluster\n\ncommands:\n");
    for (const cli_command *const *c = commands; *c != NULL; ++c) {
        (void)fprintf(out, "  %-16s %s\n", (*c)->name, (*c)->summary);
    }
    (void)fprintf(out, "\nclast COMMAND --help explains one; clast --version names the build\n");
}

/// Words of argv (1 or 2) that the command's name takes, or 0 when it is another command.
static int words_matched(const cli_command *command, int argc, char **argv)
{
    const size_t n = strlen(argv[1]);
    if (strcmp(command->name, argv[1]) == 0) {
        return 1;
    }
    const bool first = strncmp(command->name, argv[1], n) == 0 && command->name[n] == ' ';
    return first && argc > 2 && strcmp(command->name + n + 1, argv[2]) == 0 ? 2 : 0;
}

static int unknown(char **argv)
{
    (void)fprintf(stderr, "clast: unknown command '%s'", cli_name(argv[1]));
    const size_t n = strlen(argv[1]);
    const char *separator = "; did you mean: ";
    for (const cli_command *const *c = commands; *c != NULL; ++c) {
        if (strncmp((*c)->name, argv[1], n < 3 ? n : 3) == 0) {
            (void)fprintf(stderr, "%sclast %s", separator, (*c)->name);
            separator = ", ";
        }
    }
    (void)fprintf(stderr, "; see clast --help\n");
    return 2;
}

/// Lists the commands whose first word is this one ("mesh"); false when there are none.
static bool print_group(FILE *out, const char *word)
{
    const size_t n = strlen(word);
    bool found = false;
    for (const cli_command *const *c = commands; *c != NULL; ++c) {
        if (strncmp((*c)->name, word, n) != 0 || (*c)->name[n] != ' ') {
            continue;
        }
        (void)fprintf(out, "%s  clast %-16s %s\n", found ? "" : "commands:\n", (*c)->name,
                      (*c)->summary);
        found = true;
    }
    return found;
}

/// The release, and which build of it: the source's commit and the optional parts.
static void print_version(void)
{
    static const char *const parts[2][2] = {{"with", CLAST_HAS}, {"without", CLAST_LACKS}};
    (void)printf("clast %s\nsource %s\n", clast_version(), clast_source());
    for (int k = 0; k < 2; ++k) {
        if (parts[k][1][0] != '\0') {
            (void)printf("%s %s\n", parts[k][0], parts[k][1]);
        }
    }
}

/// Everything that is not a command's own business.
static int answer(int argc, char **argv)
{
    if (argc < 2) {
        print_usage(stderr);
        return 2;
    }
    if (strcmp(argv[1], "--version") == 0) {
        print_version();
        return 0;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        print_usage(stdout);
        return 0;
    }
    const bool asked = argc > 2 && (strcmp(argv[2], "--help") == 0 || strcmp(argv[2], "-h") == 0);
    if ((argc == 2 || asked) && print_group(asked ? stdout : stderr, argv[1])) {
        return asked ? 0 : 2;
    }
    return unknown(argv);
}

int cli_main(int argc, char **argv, const clast_comm *comm)
{
#ifdef SIGXFSZ
    // a file above the limit (ulimit -f) is an error as a full disk is
    (void)signal(SIGXFSZ, SIG_IGN);
#endif
    for (const cli_command *const *c = commands; argc > 1 && *c != NULL; ++c) {
        const int words = words_matched(*c, argc, argv);
        if (words > 0) {
            return cli_run(*c, 1 + words, argc, argv, comm);
        }
    }
    return comm->rank == 0 ? cli_flush(answer(argc, argv)) : 0;
}
