// Whether the files that a study's runs have read are still what they were, and the same on all
// ranks: tables are of one set of inputs, also when the work is shared out or gone on with.
#include "study/study.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include <clast/run_folder.h>
#include <clast/table.h>
#include <jansson.h>
#include <string.h>
#include <sys/stat.h>

enum { MANIFEST_LIMIT = 64 << 20 };

/// The digest of a file, kept in `known` by its path; "" of what is no longer a file.
static clast_status digest_now(json_t *known, const char *path, const char **digest)
{
    clast_status status = CLAST_OK;
    char hex[65] = "";
    struct stat found;
    if (json_object_get(known, path) == NULL) {
        if (stat(path, &found) == 0 && S_ISREG(found.st_mode)) {
            CLX_TRY(clast_sha256_file(path, hex, NULL));
        }
        CLX_CHECK(json_object_set_new(known, path, json_string(hex)) == 0, CLAST_E_MEMORY,
                  "out of memory");
    }
    *digest = json_string_value(json_object_get(known, path));
done:
    return status;
}

static clast_status check_file(const json_t *input, int64_t number, json_t *known)
{
    clast_status status = CLAST_OK;
    const char *path = json_string_value(json_object_get(input, "path"));
    const char *was = json_string_value(json_object_get(input, "sha256"));
    const char *is = "";
    if (path != NULL && was != NULL) {
        CLX_TRY(digest_now(known, path, &is));
        CLX_CHECK(is[0] == '\0' || strcmp(is, was) == 0, CLAST_E_USAGE,
                  "%s is not the file that run %lld of this study was made with; put the old one "
                  "back, or give another folder by -o",
                  path, (long long)number);
    }
done:
    return status;
}

/// A run whose command keeps no folder has no manifest, and nothing to check.
static clast_status check_run(const char *folder, int64_t row, json_t *known)
{
    clast_status status = CLAST_OK;
    char run[CLX_PATH_LIMIT];
    char path[CLX_PATH_LIMIT];
    char *text = NULL;
    int64_t n = 0;
    json_t *manifest = NULL;
    struct stat found;
    CLX_TRY(clx_study_run_folder(folder, row, "", run));
    CLX_TRY(clx_path_join(path, run, "out/manifest.json"));
    if (stat(path, &found) != 0) {
        goto done;
    }
    CLX_TRY(clx_file_read_all(path, MANIFEST_LIMIT, &text, &n));
    manifest = json_loadb(text, (size_t)n, JSON_DECODE_INT_AS_REAL, NULL); // seeds pass 2^63
    const json_t *inputs = json_object_get(manifest, "inputs");
    for (size_t i = 0; i < json_array_size(inputs); ++i) {
        CLX_TRY(check_file(json_array_get(inputs, i), row + 1, known));
    }
done:
    json_decref(manifest);
    clx_free(text);
    return status;
}

clast_status clx_study_check_inputs(const char *folder, const clast_table *plan)
{
    clast_status status = CLAST_OK;
    json_t *known = json_object();
    CLX_CHECK(known != NULL, CLAST_E_MEMORY, "out of memory");
    for (int64_t row = 0; row < plan->n_row; ++row) {
        if (clx_study_is_done(folder, row)) {
            CLX_TRY(check_run(folder, row, known));
        }
    }
done:
    json_decref(known);
    return status;
}
