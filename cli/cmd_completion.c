// clast completion: bash and zsh completion from the same field tables that parse the options.
#include "command.h"
#include "common_options.h"

#include <stdio.h>
#include <string.h>

typedef struct {
    int32_t shell;
} config;

static const clast_field fields[] = {{"shell", .offset = offsetof(config, shell),
                                      CLAST_FIELD_CHOICE, 0, 0, 0, "-", "which shell", "bash|zsh"},
                                     {0}};

static void print_options(const cli_command *command)
{
    const char *between = "";
    for (const cli_option *o = cli_options; o->name != NULL; ++o) {
        if (cli_option_is_of(o, command)) {
            (void)printf("%s--%s", between, o->name);
            between = " ";
        }
    }
    for (const clast_field *f = command->fields; f != NULL && f->name != NULL; ++f) {
        const bool is_on = f->type == CLAST_FIELD_BOOL && f->value != 0.0;
        (void)printf(is_on ? " --no-" : " --");
        for (const char *c = f->name; *c != '\0'; ++c) {
            (void)putchar(*c == '_' ? '-' : *c);
        }
    }
}

static void print_first_words(void)
{
    const char *previous = "";
    for (int32_t i = 0; cli_command_at(i) != NULL; ++i) {
        const char *name = cli_command_at(i)->name;
        const size_t n = strcspn(name, " ");
        if (strncmp(previous, name, n) != 0 || (previous[n] != ' ' && previous[n] != '\0')) {
            (void)printf("%s%.*s", i > 0 ? " " : "", (int)n, name);
        }
        previous = name;
    }
}

static void print_second_words(void)
{
    for (int32_t i = 0; cli_command_at(i) != NULL; ++i) {
        const char *name = cli_command_at(i)->name;
        const char *space = strchr(name, ' ');
        if (space != NULL) {
            (void)printf("        [ \"${COMP_WORDS[1]}\" != %.*s ] || words=\"$words %s\"\n",
                         (int)(space - name), name, space + 1);
        }
    }
}

static void print_bash(void)
{
    (void)printf("# bash completion for clast, made by `clast completion`\n"
                 "_clast() {\n"
                 "    local current=\"${COMP_WORDS[COMP_CWORD]}\" words=\"\"\n"
                 "    case \"${COMP_WORDS[1]} ${COMP_WORDS[2]}\" in\n");
    for (int32_t i = 0; cli_command_at(i) != NULL; ++i) {
        const cli_command *command = cli_command_at(i);
        (void)printf("        \"%s\"%s) words=\"", command->name,
                     strchr(command->name, ' ') != NULL ? "*" : "\\ *");
        print_options(command);
        (void)printf("\" ;;\n");
    }
    (void)printf("    esac\n    if [ \"$COMP_CWORD\" -eq 1 ]; then\n        words=\"");
    print_first_words();
    (void)printf("\"\n    elif [ \"$COMP_CWORD\" -eq 2 ]; then\n");
    print_second_words();
    (void)printf("    fi\n"
                 "    if [[ $current == -* || $COMP_CWORD -le 2 ]]; then\n"
                 "        COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
                 "    fi\n"
                 "}\n"
                 "complete -o default -F _clast clast\n");
}

static clast_status run(const cli_common *common, void *values)
{
    const config *c = values;
    (void)common;
    if (c->shell == 1) {
        (void)printf("#compdef clast\nautoload -U +X bashcompinit && bashcompinit\n");
    }
    print_bash();
    if (c->shell == 1) { // as a file of fpath it is that function: its first call completes too
        (void)printf("[ \"${funcstack[1]}\" != _clast ] || _bash_complete -o default -F _clast\n");
    }
    return CLAST_OK;
}

const cli_command cli_completion = {
    .name = "completion",
    .arguments = "",
    .summary = "print shell completion: source <(clast completion)",
    .example = {"source <(clast completion)", "source <(clast completion --shell zsh)",
                "clast completion > ~/.local/share/bash-completion/completions/clast"},
    .fields = fields,
    .config_size = sizeof(config),
    .writes_no_file = true,
    .writes_no_data = true,
    .run = run,
};
