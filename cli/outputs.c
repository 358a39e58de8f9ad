// Outputs are no inputs, no files of runs and no two of them one.
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

bool cli_is_folder(const char *path)
{
    struct stat about;
    return stat(path, &about) == 0 && S_ISDIR(about.st_mode);
}

/// Refuses the outputs that are this input or would hold it.
static clast_status check_input(const outputs *o, const char *input)
{
    for (int32_t i = 0; i < o->n; ++i) {
        CLI_GUARD(clast_run_folder_check_input(o->option[i], o->path[i], input));
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
        if (i > 0 || !o->first_is_folder) {
            CLI_GUARD(clast_run_folder_check_output(o->option[i], o->path[i]));
        }
        for (int32_t j = 0; j < i; ++j) {
            if (clast_run_folder_is_same(o->path[i], o->path[j])) {
                return cli_fail(CLAST_E_USAGE, "%s and %s name the same file, %s", o->option[j],
                                o->option[i], o->path[i]);
            }
        }
    }
    return CLAST_OK;
}

clast_status cli_check_writable(const char *path)
{
    if (path == NULL || path[0] == '\0') {
        return CLAST_OK;
    }
    struct stat about;
    char folder[CLAST_RUN_PATH];
    const char *slash = strrchr(path, '/');
    const int n = slash == NULL ? 1 : (int)(slash - path) + 1;
    if (lstat(path, &about) == 0 && !S_ISREG(about.st_mode)) {
        return S_ISDIR(about.st_mode)
                   ? cli_fail(CLAST_E_DISK, "cannot write %s: it is a folder", path)
                   : CLAST_OK;
    }
    if (snprintf(folder, sizeof folder, "%.*s", n, slash != NULL ? path : ".") >=
        (int)sizeof folder) {
        return cli_fail(CLAST_E_DISK, "cannot write %.60s...: the path is too long", path);
    }
    if (stat(folder, &about) != 0) { // of a file with '/' behind it too
        return cli_fail(CLAST_E_DISK, "cannot write %s: there is no folder %s", path, folder);
    }
    return access(folder, W_OK | X_OK) == 0
               ? CLAST_OK
               : cli_fail(CLAST_E_DISK, "cannot write %s: the folder %s cannot be written into",
                          path, folder);
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
    const bool is_file = !command->writes_folder && !command->writes_either;
    return is_file ? cli_check_writable(common->output) : CLAST_OK;
}
