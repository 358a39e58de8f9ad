// clast man: the manual page in roff, from the same tables as --help.
#include "command.h"
#include "common_options.h"

#include <stdio.h>

/// roff text: hyphens and backslashes escaped, a leading dot made harmless.
static void print_text(const char *text)
{
    for (const char *c = text; *c != '\0'; ++c) {
        if (*c == '-') {
            (void)fputs("\\-", stdout);
        } else if (*c == '\\') {
            (void)fputs("\\e", stdout);
        } else if ((*c == '.' || *c == '\'') && (c == text || c[-1] == '\n')) {
            (void)printf("\\&%c", *c);
        } else {
            (void)putchar(*c);
        }
    }
}

static void print_option(const clast_field *f)
{
    char words[CLI_WORDS_SIZE];
    cli_field_name(f, words);
    (void)printf(".TP\n.B \\-\\-");
    print_text(words);
    (void)putchar('\n');
    print_text(f->help);
    cli_field_values(f, words);
    print_text(words);
    (void)putchar('\n');
}

static void print_common(const cli_option *option)
{
    char words[CLI_NAME_SIZE];
    cli_option_words(option, words);
    (void)printf(".TP\n.B ");
    print_text(words);
    (void)putchar('\n');
    print_text(option->help);
    (void)putchar('\n');
}

static void print_command(const cli_command *command)
{
    (void)printf(".SS clast ");
    print_text(command->name);
    (void)putchar(' ');
    print_text(command->arguments);
    (void)printf("\n");
    print_text(command->summary);
    (void)printf("\n");
    if (command->details != NULL) {
        (void)printf(".PP\n");
        print_text(command->details);
        (void)printf("\n");
    }
    (void)printf(".PP\nExamples:\n.nf\n");
    for (int k = 0; k < 3 && command->example[k] != NULL; ++k) {
        print_text(command->example[k]);
        (void)printf("\n");
    }
    (void)printf(".fi\n");
    for (const clast_field *f = command->fields; f != NULL && f->name != NULL; ++f) {
        if (cli_field_group(command->fields, f) != NULL) {
            (void)printf(".PP\n.I ");
            print_text(cli_field_group(command->fields, f));
            (void)printf("\n");
        }
        print_option(f);
    }
}

static clast_status run(const cli_common *common, void *values)
{
    (void)common;
    (void)values;
    (void)printf(".TH CLAST 1 \"\" \"clast %s\" \"User Commands\"\n"
                 ".SH NAME\nclast \\- particles that stick, settle and cluster\n"
                 ".SH SYNOPSIS\n.B clast\nCOMMAND [arguments] [options]\n.SH COMMANDS\n",
                 clast_version());
    for (int32_t i = 0; cli_command_at(i) != NULL; ++i) {
        print_command(cli_command_at(i));
    }
    (void)printf(".SH COMMON OPTIONS\n");
    for (const cli_option *o = cli_options; o->name != NULL; ++o) {
        if (o->help != NULL) {
            print_common(o);
        }
    }
    (void)printf(
        ".PP\nEvery option of a command is a key of a YAML file among its arguments, with '_' for "
        "'\\-', and what "
        "stands "
        "before the options is one too: points for POINTS, file for FILE. The command line wins.\n"
        ".PP\nA length or an angle needs its unit (270um, 50deg; 0 needs none); other bare numbers "
        "are SI.\n"
        ".SH EXIT STATUS\n0 done; 1 a check answered no; 2 usage; 3 bad input; 4 not enough memory "
        "or disk; 5 did not converge; 129, 130 or 143 stopped by SIGHUP, SIGINT or SIGTERM (and "
        "--time-limit), with a checkpoint where it has one.\n");
    return CLAST_OK;
}

const cli_command cli_man = {
    .name = "man",
    .arguments = "",
    .summary = "print the manual page: clast man | man -l -",
    .example = {"clast man | man -l -", "clast man > clast.1", "clast man | grep -- cone"},
    .config_size = 1,
    .writes_no_file = true,
    .writes_no_data = true,
    .run = run,
};
