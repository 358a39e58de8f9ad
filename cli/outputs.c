// Outputs are no inputs: compared by the file itself, so that links and other spellings count.
#include "command.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_OUTPUTS = 16 };

/// What a command line writes.
typedef struct {
    const char *option[MOST_OUTPUTS], *path[MOST_OUTPUTS];
    int32_t n;
    bool first_is_folder; ///< -o names a run's folder, which has rules of its own
} outputs;

static bool is_output(const clast_field *f)
{
    return f->type == CLAST_FIELD_TEXT && f->unit != NULL &&
           strcmp(f->unit, CLAST_UNIT_OUTPUT) == 0;
}

static const char *text_of(const clast_field *f, const void *config)
{
    const char *text = NULL;
    memcpy((void *)&text, (const char *)config + f->offset, sizeof text);
    return text != NULL ? text : "";
}

static void find_outputs(const cli_command *command, const cli_common *common, const void *config,
                         outputs *o)
{
    if (common->output != NULL) {
        o->option[o->n] = "-o";
        o->path[o->n++] = common->output;
        o->first_is_folder = command->writes_folder;
    }
    for (const clast_field *f = command->fields; f != NULL && f->name != NULL; ++f) {
        if (is_output(f) && text_of(f, config)[0] != '\0' && o->n < MOST_OUTPUTS) {
            o->option[o->n] = f->name; // as messages of the fields name it
            o->path[o->n++] = text_of(f, config);
        }
    }
}

static bool is_same(const char *a, const char *b)
{
    struct stat of_a;
    struct stat of_b;
    return stat(a, &of_a) == 0 && stat(b, &of_b) == 0 && of_a.st_dev == of_b.st_dev &&
           of_a.st_ino == of_b.st_ino && (S_ISREG(of_a.st_mode) || S_ISDIR(of_a.st_mode));
}

/// Follows the links at the end of a path, at most 40, also where the last one dangles.
static void follow(const char *path, char end[CLAST_RUN_PATH])
{
    char next[CLAST_RUN_PATH];
    (void)snprintf(end, CLAST_RUN_PATH, "%s", path);
    for (int k = 0; k < 40; ++k) {
        const ssize_t n = readlink(end, next, sizeof next - 1);
        if (n < 0) {
            return;
        }
        next[n] = '\0';
        char *slash = strrchr(end, '/');
        const size_t kept = next[0] == '/' || slash == NULL ? 0 : (size_t)(slash - end) + 1;
        (void)snprintf(end + kept, CLAST_RUN_PATH - kept, "%s", next);
    }
}

/// Whether two paths are one place, where nothing need be yet.
static bool is_same_place(const char *a, const char *b)
{
    char end[2][CLAST_RUN_PATH];
    const char *name[2];
    const char *folder[2];
    follow(a, end[0]);
    follow(b, end[1]);
    for (int k = 0; k < 2; ++k) {
        char *slash = strrchr(end[k], '/');
        name[k] = slash != NULL ? slash + 1 : end[k];
        folder[k] = slash == NULL ? "." : slash == end[k] ? "/" : end[k];
        if (slash != NULL) {
            *slash = '\0';
        }
    }
    return is_same(a, b) || (strcmp(name[0], name[1]) == 0 && is_same(folder[0], folder[1]));
}

/// Whether a file that a run could write lies in this folder; a configuration (YAML) none does.
static bool is_in(const char *file, const char *folder)
{
    char parent[4096];
    struct stat info;
    const char *slash = strrchr(file, '/');
    const char *dot = strrchr(file, '.');
    const int n = slash != NULL ? (int)(slash - file) + 1 : 0;
    if (stat(file, &info) != 0 || !S_ISREG(info.st_mode) || n >= (int)sizeof parent ||
        (dot != NULL && (strcmp(dot, ".yaml") == 0 || strcmp(dot, ".yml") == 0))) {
        return false;
    }
    (void)snprintf(parent, sizeof parent, "%.*s", n, n > 0 ? file : ".");
    return is_same(n > 0 ? parent : ".", folder);
}

/// Refuses the outputs that are this input or would hold it; "list:FILE" names one as FILE does.
static clast_status check_input(const outputs *o, const char *input)
{
    const char *const colon = strchr(input, ':');
    const char *const spelling[2] = {input, colon != NULL ? colon + 1 : NULL};
    for (int32_t i = 0; i < o->n; ++i) {
        for (int k = 0; k < 2 && spelling[k] != NULL; ++k) {
            if (is_same(o->path[i], spelling[k])) {
                return cli_fail(CLAST_E_USAGE,
                                "%s %s is the input %s; an output takes no input's place, give it "
                                "another name",
                                o->option[i], o->path[i], spelling[k]);
            }
            if (is_in(spelling[k], o->path[i])) {
                return cli_fail(
                    CLAST_E_USAGE,
                    "%s %s is the folder of the input %s, whose place a file of the run "
                    "could take; give a folder of its own",
                    o->option[i], o->path[i], spelling[k]);
            }
        }
    }
    return CLAST_OK;
}

static clast_status check_field(const outputs *o, const clast_field *f, const void *config)
{
    if (f->type == CLAST_FIELD_TEXT && !is_output(f)) {
        return check_input(o, text_of(f, config));
    }
    if (f->type == CLAST_FIELD_TEXT_LIST) {
        clast_text_list list;
        memcpy(&list, (const char *)config + f->offset, sizeof list);
        for (int32_t i = 0; i < list.n; ++i) {
            CLI_GUARD(check_input(o, list.item[i]));
        }
    }
    return CLAST_OK;
}

/// Each output against the runs on this disk and the outputs before it.
static clast_status check_each(const outputs *o)
{
    for (int32_t i = 0; i < o->n; ++i) {
        if (!(i == 0 && o->first_is_folder) && clast_run_folder_owns(o->path[i])) {
            return cli_fail(CLAST_E_USAGE,
                            "%s %s is part of a run; give another name, or export what you need",
                            o->option[i], o->path[i]);
        }
        for (int32_t j = 0; j < i; ++j) {
            if (strcmp(o->path[i], o->path[j]) == 0 || is_same_place(o->path[i], o->path[j])) {
                return cli_fail(CLAST_E_USAGE, "%s and %s name the same file, %s", o->option[j],
                                o->option[i], o->path[i]);
            }
        }
    }
    return CLAST_OK;
}

clast_status cli_check_ending(const char *path, const char *what, const char *ending)
{
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash != NULL ? slash : path, '.');
    return dot != NULL && strcasecmp(dot + 1, ending) == 0
               ? CLAST_OK
               : cli_fail(CLAST_E_USAGE, "%s: %s are written as .%s", path, what, ending);
}

clast_status cli_check_outputs(const cli_command *command, const cli_common *common,
                               const void *config)
{
    outputs o = {0};
    find_outputs(command, common, config, &o);
    CLI_GUARD(o.n > 0 ? check_each(&o) : CLAST_OK);
    // every word: YAML configurations are no arguments any more
    for (int32_t i = 1; i < common->n_word && o.n > 0; ++i) {
        const bool is_value = i > 1 && common->word[i - 1][0] == '-';
        CLI_GUARD(is_value ? CLAST_OK : check_input(&o, common->word[i]));
    }
    for (int32_t i = 0; i < common->n_argument && o.n > 0; ++i) {
        CLI_GUARD(check_input(&o, common->argument[i]));
    }
    for (const clast_field *f = command->fields; f != NULL && f->name != NULL && o.n > 0; ++f) {
        CLI_GUARD(check_field(&o, f, config));
    }
    return CLAST_OK;
}
