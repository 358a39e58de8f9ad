// One subcommand from its words to its exit code.
#include "command.h"

#include "parser.h"
#include <clast/field.h>

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static char refusal[1024];

clast_status cli_fail(clast_status status, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char text[sizeof refusal];
    (void)vsnprintf(text, sizeof text, format, args);
    va_end(args);
    (void)clast_text_printable(text, sizeof refusal, refusal);
    return status;
}

const char *cli_name(const char *text)
{
    static char shown[8][1024];
    static unsigned next;
    char *out = shown[next++ % 8];
    return clast_text_printable(text, sizeof shown[0], out);
}

int cli_flush(int code)
{
    // A failed write in between leaves nothing to flush, only the mark.
    const bool is_lost = fflush(stdout) != 0 || ferror(stdout) != 0;
    if (is_lost && code == 0) {
        (void)fputs("clast: cannot write to standard output\n", stderr);
        return 4;
    }
    return code;
}

bool cli_runs_in_studies(const cli_command *command)
{
    return !command->needs_file && !command->writes_no_data && strcmp(command->name, "study") != 0;
}

/// The line that says why: the command's own, else the library's, else the status in words.
static const char *reason(clast_status status)
{
    if (refusal[0] != '\0') {
        return refusal;
    }
    return clast_error_detail()[0] != '\0' ? clast_error_detail() : clast_status_text(status);
}

clast_status cli_agree(const cli_common *common, clast_status status)
{
    if (common->comm->n_rank == 1) {
        return status;
    }
    status = clast_comm_agree(common->comm, status, reason(status));
    return status == CLAST_OK ? status : cli_fail(status, "%s", clast_error_detail());
}

/// The input that a message about one does not name: "point 2 has ..." of the only argument; ""
/// when it names one.
static const char *unnamed_input(const cli_parser *p, clast_status status)
{
    struct stat info;
    if (clast_status_exit_code(status) != 3 || p->common.n_argument != 1 ||
        stat(p->common.argument[0], &info) != 0) {
        return "";
    }
    for (int i = 1; i < p->common.n_word; ++i) {
        const char *colon = strchr(p->common.word[i], ':');
        const char *file =
            colon != NULL && stat(p->common.word[i], &info) != 0 ? colon + 1 : p->common.word[i];
        if (stat(file, &info) == 0 && strstr(reason(status), cli_name(file)) != NULL) {
            return "";
        }
    }
    return p->common.argument[0];
}

/// The one line of what went wrong, from rank 0.
static void complain(const cli_parser *p, clast_status status)
{
    if (status != CLAST_OK && status != CLAST_E_NO && p->common.comm->rank == 0) {
        const char *input = unnamed_input(p, status);
        (void)fprintf(stderr, "clast %s: %s%s%s%s\n", p->command->name, cli_name(input),
                      input[0] != '\0' ? ": " : "", reason(status),
                      status == CLAST_E_MEMORY ? "; see --max-memory" : "");
    }
}

/// An option that would be read and left.
static clast_status check_common(const cli_parser *p)
{
    if (p->command->writes_no_file && p->common.output != NULL) {
        return cli_fail(CLAST_E_USAGE,
                        "it writes no file: leave out -o (what it has is on stdout)");
    }
    if (p->command->writes_no_data && p->common.json) {
        return cli_fail(CLAST_E_USAGE, "what it prints is no data: leave out --json");
    }
    return CLAST_OK;
}

/// What a command that was asked for needs before it runs, then the command.
static clast_status run_command(cli_parser *p)
{
    const bool is_shared = p->common.comm->n_rank > 1; // a rank is a core, unless -j says more
    clast_parallel_set_threads(is_shared && p->common.threads == 0 ? 1 : p->common.threads);
    CLI_GUARD(check_common(p));
    CLI_GUARD(cli_memory_limit(&p->common));
    CLI_GUARD(cli_time_limit(p->common.time_limit));
    CLI_GUARD(cli_check_outputs(p->command, &p->common, p->config));
    return p->command->run(&p->common, p->config);
}

/// Parses and runs. Every rank agrees on what was asked for before one begins.
static clast_status perform(cli_parser *p, int argc, char **argv)
{
    clast_status status = cli_parse(p, argc, argv);
    const bool is_run = status == CLAST_OK && !p->help;
    CLI_TRY(cli_agree(&p->common, is_run ? cli_parse_arguments(p) : status));
    if (!p->help) {
        CLI_TRY(run_command(p));
    } else if (p->common.comm->rank == 0) {
        (p->help_all ? cli_help_all : cli_help)(p->command);
    }
done:
    complain(p, status);
    return status;
}

/// Of a stopped command that of the signal, also on ranks that got none: what came first of mpirun
/// is the job's.
static int exit_code(clast_status status, const clast_comm *comm)
{
    int64_t code = cli_signal_code();
    if (status != CLAST_E_STOPPED) {
        return clast_status_exit_code(status);
    }
    if (comm->n_rank > 1) {
        code = -comm->least(comm->context, -code);
    }
    return code != 0 ? (int)code : clast_status_exit_code(status);
}

int cli_run(const cli_command *command, int n_skip, int argc, char **argv, const clast_comm *comm)
{
    cli_parser p = {
        .command = command,
        .common = {.command = command->name, .n_word = argc, .word = argv, .comm = comm}};
    int code = 4;
    int32_t n_field = 1;
    char **argument = calloc((size_t)argc + 1, sizeof *argument);
    for (const clast_field *f = command->fields; f != NULL && f->name != NULL; ++f) {
        ++n_field;
    }
    const bool is_made = cli_configs_init(command, &p.configs);
    p.common.argument = argument;
    p.config = calloc(1, p.configs.size);
    p.touched = calloc((size_t)n_field, sizeof *p.touched);
    if (!is_made || argument == NULL || p.config == NULL || p.touched == NULL ||
        (p.configs.fields != NULL &&
         clast_fields_default(p.configs.fields, p.config) != CLAST_OK)) {
        (void)fputs("clast: not enough memory\n", stderr);
        goto done;
    }
    if (command->prepare != NULL) {
        command->prepare(p.config);
    }
    cli_signals_begin(command->name, comm);
    code = exit_code(perform(&p, argc - n_skip, argv + n_skip), comm);
    if (p.configs.fields != NULL) {
        clast_fields_free(p.configs.fields, p.config);
    }
done:
    free((void *)p.touched);
    free(p.config);
    free(argument);
    cli_configs_free(&p.configs);
    return cli_flush(code);
}
