// The words of a command line: options from the field table, common options, arguments.
#include "parser.h"

#include "common_options.h"
#include <clast/field.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

__attribute__((format(printf, 2, 3))) static clast_status usage_error(const cli_parser *p,
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

static bool touch(cli_parser *p, const clast_field *f)
{
    for (int32_t i = 0; i < p->n_touched; ++i) {
        if (p->touched[i] == f) {
            return true;
        }
    }
    p->touched[p->n_touched++] = f;
    return false;
}

static clast_status set_field(cli_parser *p, const char *name, const char *value)
{
    const clast_field *f =
        p->command->fields != NULL ? clast_fields_find(p->command->fields, name) : NULL;
    if (f == NULL) {
        const char *near =
            p->command->fields != NULL ? clast_fields_nearest(p->command->fields, name) : NULL;
        char option[CLI_NAME_SIZE] = "";
        (void)snprintf(option, sizeof option, "%s", near != NULL ? near : "");
        for (char *c = option; *c != '\0'; ++c) { // as it is typed and as --help has it
            *c = *c == '_' ? '-' : *c;
        }
        return near != NULL
                   ? usage_error(p, "unknown option --%s (did you mean --%s?)", name, option)
                   : usage_error(p, "unknown option --%s", name);
    }
    if (value[0] == '\0') {
        const bool has_default = f->text == NULL || f->text[0] != '\0';
        return usage_error(p, "--%s has an empty value%s", name,
                           has_default ? "; leave it out for its default" : "; give one");
    }
    const bool append = is_list(f) && touch(p, f);
    return clast_field_set(f, p->config, value, append);
}

/// A bool option may stand without a value; --NAME=false and --no-NAME turn it off.
static bool takes_value(const cli_parser *p, const char *name)
{
    const clast_field *f =
        p->command->fields != NULL ? clast_fields_find(p->command->fields, name) : NULL;
    return f == NULL || f->type != CLAST_FIELD_BOOL;
}

static clast_status set_pair(cli_parser *p, const char *pair)
{
    char name[128];
    const char *equals = strchr(pair, '=');
    if (equals == NULL || (size_t)(equals - pair) >= sizeof name) {
        return usage_error(p, "--set takes key=value, not '%s'", pair);
    }
    (void)snprintf(name, sizeof name, "%.*s", (int)(equals - pair), pair);
    return set_field(p, name, equals + 1);
}

static clast_status set_threads(cli_parser *p, const char *value)
{
    char *end = NULL;
    const long n = strtol(value, &end, 10);
    if (end == value || *end != '\0' || n < 0 || n > 4096) {
        return usage_error(p, "-j takes 0 to 4096 threads, not '%s'", value);
    }
    p->common.threads = (int32_t)n;
    return CLAST_OK;
}

/// An option that every command has; `value` is NULL where none is left.
static clast_status common_option(cli_parser *p, const cli_option *option, const char *value)
{
    if (option->value != NULL && (value == NULL || value[0] == '\0')) {
        return usage_error(p, "--%s %s", option->name,
                           value == NULL ? "needs a value" : "has an empty value");
    }
    const char *text = value != NULL ? value : "";
    switch (option->kind) {
    case CLI_OPTION_OUTPUT:
        p->common.output = value;
        break;
    case CLI_OPTION_THREADS:
        return set_threads(p, text);
    case CLI_OPTION_MAX_MEMORY:
        p->common.max_memory = value;
        break;
    case CLI_OPTION_TIME_LIMIT:
        p->common.time_limit = value;
        break;
    case CLI_OPTION_SET:
        return set_pair(p, text);
    case CLI_OPTION_JSON:
        p->common.json = true;
        break;
    case CLI_OPTION_QUIET:
        p->common.quiet = true;
        break;
    case CLI_OPTION_HELP_ALL:
        p->help_all = true;
        p->help = true;
        break;
    case CLI_OPTION_HELP:
        p->help = true;
        break;
    }
    return CLAST_OK;
}

/// The switch that --no-NAME turns off, or NULL when the option is nothing of the kind.
static const clast_field *negated(const cli_parser *p, const char *name)
{
    const clast_field *fields = p->command->fields;
    if (fields == NULL || strncmp(name, "no-", 3) != 0 || clast_fields_find(fields, name) != NULL) {
        return NULL;
    }
    const clast_field *f = clast_fields_find(fields, name + 3);
    return f != NULL && f->type == CLAST_FIELD_BOOL ? f : NULL;
}

static clast_status long_option(cli_parser *p, int argc, char **argv, int *at)
{
    char name[128];
    const char *text = argv[*at] + 2;
    const char *equals = strchr(text, '=');
    (void)snprintf(name, sizeof name, "%.*s", (int)strcspn(text, "="), text);
    const char *next = *at + 1 < argc ? argv[*at + 1] : NULL;
    const char *value = equals != NULL ? equals + 1 : next;
    const cli_option *common = cli_option_find(name);
    if (common != NULL) {
        *at += common->value != NULL && equals == NULL ? 1 : 0;
        return common_option(p, common, value);
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

static clast_status short_option(cli_parser *p, int argc, char **argv, int *at)
{
    const char *text = argv[*at] + 1;
    const cli_option *option = cli_option_of_letter(text[0]);
    if (option == NULL) {
        return usage_error(p, "unknown option %s", argv[*at]);
    }
    const bool attached = text[1] != '\0';
    const char *value = attached ? text + 1 : (*at + 1 < argc ? argv[*at + 1] : NULL);
    *at += option->value != NULL && !attached ? 1 : 0;
    return common_option(p, option, value);
}

static bool looks_like_number(const char *text)
{
    return text[0] == '-' && ((text[1] >= '0' && text[1] <= '9') || text[1] == '.');
}

/// Whether the option `word` takes the next word as its value.
static bool uses_next(const cli_parser *p, const char *word)
{
    const char *name = word + 2;
    const cli_option *common =
        word[1] == '-' ? cli_option_find(name) : cli_option_of_letter(word[1]);
    if (common != NULL || word[1] != '-') {
        return common != NULL && common->value != NULL && (word[1] == '-' || word[2] == '\0');
    }
    return strchr(name, '=') == NULL && p->command->fields != NULL &&
           clast_fields_find(p->command->fields, name) != NULL && takes_value(p, name);
}

static bool is_option(const char *word)
{
    return word[0] == '-' && word[1] != '\0' && !looks_like_number(word);
}

/// Reads every YAML file among the arguments before any option, so that options win.
static clast_status read_configs(cli_parser *p, int argc, char **argv)
{
    bool options = true;
    for (int i = 0; i < argc && p->configs.fields != NULL; ++i) {
        if (options && strcmp(argv[i], "--") == 0) {
            options = false;
        } else if (options && is_option(argv[i])) {
            i += uses_next(p, argv[i]) ? 1 : 0;
        } else if (cli_is_config(argv[i])) {
            CLI_GUARD(clast_fields_read(argv[i], p->configs.fields, p->config));
        }
    }
    return CLAST_OK;
}

/// Positional arguments of the configurations, where the command line has none.
static void parse_arguments(cli_parser *p)
{
    const clast_text_list named = cli_configs_arguments(&p->configs, p->config);
    if (p->common.n_argument == 0 && named.n > 0) {
        p->common.n_argument = named.n;
        p->common.argument = named.item;
    }
}

clast_status cli_parse(cli_parser *p, int argc, char **argv)
{
    bool options = true;
    clast_status status = CLAST_OK;
    CLI_TRY(read_configs(p, argc, argv));
    for (int i = 0; i < argc; ++i) {
        const char *text = argv[i];
        if (options && strcmp(text, "--") == 0) {
            options = false;
        } else if (options && strncmp(text, "--", 2) == 0) {
            CLI_TRY(long_option(p, argc, argv, &i));
        } else if (options && is_option(text)) {
            CLI_TRY(short_option(p, argc, argv, &i));
        } else if (p->configs.fields == NULL || !cli_is_config(text)) {
            p->common.argument[p->common.n_argument++] = argv[i];
        }
    }
done:
    parse_arguments(p);
    return status;
}

clast_status cli_parse_arguments(const cli_parser *p)
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
