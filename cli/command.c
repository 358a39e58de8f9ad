// Command line of one subcommand: options from the field table, common options, help.
#include "command.h"

#include "configs.h"
#include <clast/field.h>

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct {
    const cli_command *command;
    cli_configs configs;
    cli_common common;
    void *config;
    const clast_field **touched; ///< list fields that the command line has set already
    int32_t n_touched;
    bool help, help_all;
} parser;

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

__attribute__((format(printf, 2, 3))) static clast_status usage_error(const parser *p,
                                                                      const char *format, ...)
{
    char text[800];
    va_list args;
    va_start(args, format);
    (void)vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return cli_fail(CLAST_E_USAGE, "%s; see clast %s --help", text, p->command->name);
}

static bool is_list(const clast_field *f)
{
    return f->type == CLAST_FIELD_TEXT_LIST || f->type == CLAST_FIELD_F64_LIST;
}

static bool touch(parser *p, const clast_field *f)
{
    for (int32_t i = 0; i < p->n_touched; ++i) {
        if (p->touched[i] == f) {
            return true;
        }
    }
    p->touched[p->n_touched++] = f;
    return false;
}

static clast_status set_field(parser *p, const char *name, const char *value)
{
    const clast_field *f =
        p->command->fields != NULL ? clast_fields_find(p->command->fields, name) : NULL;
    if (f == NULL) {
        const char *near =
            p->command->fields != NULL ? clast_fields_nearest(p->command->fields, name) : NULL;
        return near != NULL ? usage_error(p, "unknown option --%s (did you mean --%s?)", name, near)
                            : usage_error(p, "unknown option --%s", name);
    }
    if (value[0] == '\0') {
        return usage_error(p, "--%s has an empty value; leave it out for its default", name);
    }
    const bool append = is_list(f) && touch(p, f);
    return clast_field_set(f, p->config, value, append);
}

/// A bool option may stand without a value; --NAME=false and --no-NAME turn it off.
static bool takes_value(const parser *p, const char *name)
{
    const clast_field *f =
        p->command->fields != NULL ? clast_fields_find(p->command->fields, name) : NULL;
    return f == NULL || f->type != CLAST_FIELD_BOOL;
}

static clast_status set_pair(parser *p, const char *pair)
{
    char name[128];
    const char *equals = strchr(pair, '=');
    if (equals == NULL || (size_t)(equals - pair) >= sizeof name) {
        return usage_error(p, "--set takes key=value, not '%s'", pair);
    }
    (void)snprintf(name, sizeof name, "%.*s", (int)(equals - pair), pair);
    return set_field(p, name, equals + 1);
}

static clast_status set_threads(parser *p, const char *value)
{
    char *end = NULL;
    const long n = strtol(value, &end, 10);
    if (end == value || *end != '\0' || n < 0 || n > 4096) {
        return usage_error(p, "-j takes 0 to 4096 threads, not '%s'", value);
    }
    p->common.threads = (int32_t)n;
    return CLAST_OK;
}

/// Options that every command has; false when it is none of them.
static bool common_option(parser *p, const char *name, const char *value, bool *used_value,
                          clast_status *status)
{
    *used_value = false;
    *status = CLAST_OK;
    if (strcmp(name, "json") == 0) {
        p->common.json = true;
    } else if (strcmp(name, "quiet") == 0) {
        p->common.quiet = true;
    } else if (strcmp(name, "help") == 0 || strcmp(name, "help-all") == 0) {
        p->help = true;
        p->help_all = p->help_all || name[4] == '-';
    } else if (strcmp(name, "output") == 0 || strcmp(name, "threads") == 0 ||
               strcmp(name, "max-memory") == 0 || strcmp(name, "set") == 0) {
        *used_value = true;
        if (value == NULL) {
            *status = usage_error(p, "--%s needs a value", name);
        } else if (value[0] == '\0') {
            *status = usage_error(p, "--%s has an empty value; leave it out for its default", name);
        } else if (name[0] == 'o') {
            p->common.output = value;
        } else if (name[0] == 'm') {
            p->common.max_memory = value;
        } else {
            *status = name[0] == 's' ? set_pair(p, value) : set_threads(p, value);
        }
    } else {
        return false;
    }
    return true;
}

/// The switch that --no-NAME turns off, or NULL when the option is nothing of the kind.
static const clast_field *negated(const parser *p, const char *name)
{
    const clast_field *fields = p->command->fields;
    if (fields == NULL || strncmp(name, "no-", 3) != 0 || clast_fields_find(fields, name) != NULL) {
        return NULL;
    }
    const clast_field *f = clast_fields_find(fields, name + 3);
    return f != NULL && f->type == CLAST_FIELD_BOOL ? f : NULL;
}

static clast_status long_option(parser *p, int argc, char **argv, int *at)
{
    char name[128];
    const char *text = argv[*at] + 2;
    const char *equals = strchr(text, '=');
    (void)snprintf(name, sizeof name, "%.*s", (int)strcspn(text, "="), text);
    const char *next = *at + 1 < argc ? argv[*at + 1] : NULL;
    const char *value = equals != NULL ? equals + 1 : next;
    bool used = false;
    clast_status status = CLAST_OK;
    if (common_option(p, name, value, &used, &status)) {
        *at += used && equals == NULL ? 1 : 0;
        return status;
    }
    if (negated(p, name) != NULL) {
        return equals == NULL
                   ? set_field(p, name + 3, "false")
                   : usage_error(p, "--%s takes no value; see --%s=true", name, name + 3);
    }
    if (!takes_value(p, name)) {
        return set_field(p, name, equals != NULL ? equals + 1 : "true");
    }
    if (clast_fields_find(p->command->fields != NULL ? p->command->fields : &(clast_field){0},
                          name) == NULL) {
        return set_field(p, name, ""); // reports the unknown name
    }
    if (value == NULL) {
        return usage_error(p, "--%s needs a value", name);
    }
    *at += equals == NULL ? 1 : 0;
    return set_field(p, name, value);
}

static clast_status short_option(parser *p, int argc, char **argv, int *at)
{
    static const struct {
        char letter;
        const char *name;
    } letters[] = {{'o', "output"}, {'j', "threads"}, {'q', "quiet"}, {'h', "help"}};
    const char *text = argv[*at] + 1;
    for (size_t i = 0; i < sizeof letters / sizeof letters[0]; ++i) {
        if (text[0] == letters[i].letter) {
            const bool attached = text[1] != '\0';
            const char *value = attached ? text + 1 : (*at + 1 < argc ? argv[*at + 1] : NULL);
            bool used = false;
            clast_status status = CLAST_OK;
            (void)common_option(p, letters[i].name, value, &used, &status);
            *at += used && !attached ? 1 : 0;
            return status;
        }
    }
    return usage_error(p, "unknown option %s", argv[*at]);
}

static bool looks_like_number(const char *text)
{
    return text[0] == '-' && ((text[1] >= '0' && text[1] <= '9') || text[1] == '.');
}

/// Whether the option `word` takes the next word as its value.
static bool uses_next(const parser *p, const char *word)
{
    static const char *const common[] = {"output", "threads", "max-memory", "set"};
    const char *name = word + 2;
    if (word[1] != '-') {
        return (word[1] == 'o' || word[1] == 'j') && word[2] == '\0';
    }
    for (size_t k = 0; k < sizeof common / sizeof common[0]; ++k) {
        if (strcmp(name, common[k]) == 0) {
            return true;
        }
    }
    return strchr(name, '=') == NULL && p->command->fields != NULL &&
           clast_fields_find(p->command->fields, name) != NULL && takes_value(p, name);
}

static bool is_option(const char *word)
{
    return word[0] == '-' && word[1] != '\0' && !looks_like_number(word);
}

/// Reads every YAML file among the arguments before any option, so that options win.
static clast_status read_configs(parser *p, int argc, char **argv)
{
    clast_status status = CLAST_OK;
    bool options = true;
    for (int i = 0; i < argc && p->configs.fields != NULL && status == CLAST_OK; ++i) {
        if (options && strcmp(argv[i], "--") == 0) {
            options = false;
        } else if (options && is_option(argv[i])) {
            i += uses_next(p, argv[i]) ? 1 : 0;
        } else if (cli_is_config(argv[i])) {
            status = clast_config_read(argv[i], p->configs.fields, p->config);
        }
    }
    return status;
}

/// Positional arguments of the configurations, where the command line has none.
static void take_arguments(parser *p)
{
    const clast_text_list named = cli_configs_arguments(&p->configs, p->config);
    if (p->common.n_argument == 0 && named.n > 0) {
        p->common.n_argument = named.n;
        p->common.argument = named.item;
    }
}

static clast_status parse(parser *p, int argc, char **argv)
{
    bool options = true;
    clast_status status = read_configs(p, argc, argv);
    for (int i = 0; i < argc && status == CLAST_OK; ++i) {
        const char *text = argv[i];
        if (options && strcmp(text, "--") == 0) {
            options = false;
        } else if (options && strncmp(text, "--", 2) == 0) {
            status = long_option(p, argc, argv, &i);
        } else if (options && is_option(text)) {
            status = short_option(p, argc, argv, &i);
        } else if (p->configs.fields == NULL || !cli_is_config(text)) {
            p->common.argument[p->common.n_argument++] = argv[i];
        }
    }
    take_arguments(p);
    return status;
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

static clast_status check_arguments(const parser *p)
{
    const cli_command *c = p->command;
    if (p->common.n_argument < c->n_min) {
        return usage_error(p, "missing %s", c->arguments);
    }
    if (p->common.n_argument > c->n_max) {
        return usage_error(p, "too many arguments: '%s'", p->common.argument[c->n_max]);
    }
    if (p->common.comm->n_rank > 1 && !c->shares_ranks) {
        return usage_error(p, "runs on one rank, not %d; start it without mpirun",
                           p->common.comm->n_rank);
    }
    return CLAST_OK;
}

/// The input that a message about one does not name: "point 2 has ..." of the only argument; ""
/// when it names one.
static const char *unnamed_input(const parser *p, clast_status status)
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
static void complain(const parser *p, clast_status status)
{
    if (status != CLAST_OK && status != CLAST_E_NO && p->common.comm->rank == 0) {
        const char *input = unnamed_input(p, status);
        (void)fprintf(stderr, "clast %s: %s%s%s%s\n", p->command->name, cli_name(input),
                      input[0] != '\0' ? ": " : "", reason(status),
                      status == CLAST_E_MEMORY ? "; see --max-memory" : "");
    }
}

/// Parses and runs.
/// An option that would be read and left.
static clast_status check_common(const parser *p)
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

static clast_status perform(parser *p, int argc, char **argv)
{
    clast_status status = parse(p, argc, argv);
    const bool is_run = status == CLAST_OK && !p->help;
    status = cli_agree(&p->common, is_run ? check_arguments(p) : status);
    if (status == CLAST_OK && p->help && p->common.comm->rank == 0) {
        (p->help_all ? cli_help_all : cli_help)(p->command);
    } else if (status == CLAST_OK && !p->help) {
        const bool is_shared = p->common.comm->n_rank > 1; // a rank is a core, unless -j says more
        clast_parallel_set_threads(is_shared && p->common.threads == 0 ? 1 : p->common.threads);
        status = check_common(p);
        status = status == CLAST_OK ? cli_memory_limit(p->common.max_memory) : status;
        if (status == CLAST_OK) {
            status = cli_check_outputs(p->command, &p->common, p->config);
        }
        status = status == CLAST_OK ? p->command->run(&p->common, p->config) : status;
    }
    complain(p, status);
    return status;
}

static int exit_code(clast_status status)
{
    return status == CLAST_E_STOPPED && cli_signal_code() != 0 ? cli_signal_code()
                                                               : clast_status_exit_code(status);
}

int cli_run(const cli_command *command, int n_skip, int argc, char **argv, const clast_comm *comm)
{
    parser p = {.command = command,
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
    cli_signals_begin(command->name, comm);
    code = exit_code(perform(&p, argc - n_skip, argv + n_skip));
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
