// The versions of clast that made the runs of a study: those of the runs' manifests, or, of
// commands that write none, those that study.json says have worked on it.
#include "report/study_origin.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include "report/run.h"
#include <clast/table.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { TEXT_SIZE = 512, MANIFEST_LIMIT = 64 << 20 };

/// Digits, letters and signs as in "0.1.0-rc1": what is shown of files from strangers.
static bool is_version(const char *text)
{
    static const char allowed[] =
        "0123456789.+-_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    return text != NULL && strlen(text) < 32 && text[0] != '\0' &&
           text[strspn(text, allowed)] == '\0';
}

/// Adds 1 to the version of a run that has a manifest; a damaged one tells none.
static clast_status count_version(const clx_run *run, int64_t number, json_t *versions)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char *text = NULL;
    int64_t n = 0;
    json_t *manifest = NULL;
    struct stat found;
    const int length = snprintf(path, sizeof path, "%s/runs/%06lld/out/manifest.json", run->path,
                                (long long)number);
    if (length < 0 || length >= CLX_PATH_LIMIT || stat(path, &found) != 0) {
        return CLAST_OK;
    }
    CLX_TRY(clx_file_read_all(path, MANIFEST_LIMIT, &text, &n));
    manifest = json_loadb(text, (size_t)n, JSON_DECODE_INT_AS_REAL, NULL); // seeds pass 2^63
    const char *version = json_string_value(json_object_get(manifest, "clast_version"));
    if (is_version(version)) {
        const json_int_t before = json_integer_value(json_object_get(versions, version));
        CLX_CHECK(json_object_set_new(versions, version, json_integer(before + 1)) == 0,
                  CLAST_E_MEMORY, "out of memory");
    }
done:
    json_decref(manifest);
    clx_free(text);
    return status;
}

static void append(char text[TEXT_SIZE], const char *version, int64_t n_run)
{
    const size_t used = strlen(text);
    char *at = text + used;
    const size_t left = TEXT_SIZE - used;
    const char *comma = used > 0 ? ", " : "";
    if (n_run > 0) {
        (void)snprintf(at, left, "%s%s (%lld run%s)", comma, version, (long long)n_run,
                       n_run == 1 ? "" : "s");
    } else {
        (void)snprintf(at, left, "%s%s", comma, version);
    }
}

/// "0.1.0", of several "0.1.0 (2 runs), 0.2.0 (1 run)"; "" when no run has a manifest.
static clast_status versions_of_runs(const clx_run *run, char text[TEXT_SIZE])
{
    clast_status status = CLAST_OK;
    const clast_table *plan = clx_run_table(run, "plan");
    const char *version = NULL;
    json_t *count = NULL;
    json_t *versions = json_object();
    CLX_CHECK(versions != NULL, CLAST_E_MEMORY, "out of memory");
    for (int64_t i = 0; plan != NULL && i < plan->n_row; ++i) {
        CLX_TRY(count_version(run, i + 1, versions));
    }
    const bool is_one = json_object_size(versions) == 1;
    json_object_foreach(versions, version, count)
    {
        append(text, version, is_one ? 0 : json_integer_value(count));
    }
done:
    json_decref(versions);
    return status;
}

/// "0.1.0, 0.2.0": the versions that have worked on it; "not recorded" by an older clast.
static void versions_of_study(const json_t *study, char text[TEXT_SIZE])
{
    const json_t *versions = json_object_get(study, "clast_versions");
    for (size_t i = 0; i < json_array_size(versions); ++i) {
        const char *version = json_string_value(json_array_get(versions, i));
        append(text, is_version(version) ? version : "?", 0);
    }
    if (text[0] == '\0') {
        append(text, "not recorded", 0);
    }
}

clast_status clx_study_origin(const clx_run *run, const json_t *study, json_t **manifest)
{
    clast_status status = CLAST_OK;
    char text[TEXT_SIZE] = "";
    CLX_TRY(versions_of_runs(run, text));
    if (text[0] == '\0') {
        versions_of_study(study, text);
    }
    *manifest =
        json_pack("{s:s, s:s, s:O*, s:O*}", "command", "study", "clast_version", text, "config",
                  json_object_get(study, "study"), "inputs", json_object_get(study, "inputs"));
    CLX_CHECK(*manifest != NULL, CLAST_E_MEMORY, "not enough memory for %s", run->path);
done:
    return status;
}
