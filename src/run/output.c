// Outputs are no inputs and no files of runs: compared by the file itself, so that links and other
// spellings count.
#include "run/run.h"

#include "base/path.h"
#include <clast/run_folder.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

bool clast_run_folder_is_same(const char *path, const char *other)
{
    if (path == NULL || other == NULL) {
        return false;
    }
    char end[2][CLAST_RUN_PATH];
    const char *name[2];
    const char *folder[2];
    follow(path, end[0]);
    follow(other, end[1]);
    for (int k = 0; k < 2; ++k) {
        char *slash = strrchr(end[k], '/');
        name[k] = slash != NULL ? slash + 1 : end[k];
        folder[k] = slash == NULL ? "." : slash == end[k] ? "/" : end[k];
        if (slash != NULL) {
            *slash = '\0';
        }
    }
    return strcmp(path, other) == 0 || is_same(path, other) ||
           (strcmp(name[0], name[1]) == 0 && is_same(folder[0], folder[1]));
}

/// Whether a file that a run could write lies in this folder; a configuration (YAML) none does.
static bool is_in(const char *file, const char *folder)
{
    char parent[CLX_PATH_LIMIT];
    struct stat info;
    const char *extension = clx_path_extension(file);
    const int n = (int)(clx_path_name(file) - file);
    if (stat(file, &info) != 0 || !S_ISREG(info.st_mode) || n >= (int)sizeof parent ||
        strcmp(extension, "yaml") == 0 || strcmp(extension, "yml") == 0) {
        return false;
    }
    (void)snprintf(parent, sizeof parent, "%.*s", n, n > 0 ? file : ".");
    return is_same(n > 0 ? parent : ".", folder);
}

clast_status clast_run_folder_check_output(const char *option, const char *path)
{
    CLX_ARGUMENTS(option, path);
    return !clx_run_folder_owns(path)
               ? CLAST_OK
               : clx_fail(CLAST_E_USAGE,
                          "%s %s is part of a run; give another name, or export what you need",
                          option, path);
}

clast_status clast_run_folder_check_input(const char *option, const char *path, const char *input)
{
    CLX_ARGUMENTS(option, path, input);
    clast_status status = CLAST_OK;
    const char *const colon = strchr(input, ':');
    const char *const spelling[2] = {input, colon != NULL ? colon + 1 : NULL};
    for (int k = 0; k < 2 && spelling[k] != NULL; ++k) {
        CLX_CHECK(!is_same(path, spelling[k]), CLAST_E_USAGE,
                  "%s %s is the input %s; an output takes no input's place, give it another name",
                  option, path, spelling[k]);
        CLX_CHECK(!is_in(spelling[k], path), CLAST_E_USAGE,
                  "%s %s is the folder of the input %s, whose place a file of the run could take; "
                  "give a folder of its own",
                  option, path, spelling[k]);
    }
done:
    return status;
}
