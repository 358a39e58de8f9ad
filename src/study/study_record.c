// study.json: what a study is, the versions of clast that have worked on it, and digests of the
// files that its runs read.
//
// A study of an older clast has neither versions nor digests. Its study.json stays as it is, byte
// for byte, so that the older one can go on with it, too.
#include "study/study.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/lock.h"
#include "base/path.h"
#include <clast/run_folder.h>
#include <clast/table.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { RECORD_LIMIT = 1 << 28 };

static const char *text_in(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text != NULL ? text : "";
}

/// The record that is there, NULL for none; what is no JSON is another study's.
static clast_status read_record(const char *path, json_t **record)
{
    clast_status status = CLAST_OK;
    char *text = NULL;
    int64_t n = 0;
    if (access(path, F_OK) != 0) {
        return CLAST_OK;
    }
    CLX_TRY(clx_file_read_all(path, RECORD_LIMIT, &text, &n));
    *record = json_loadb(text, (size_t)n, 0, NULL);
    *record = *record != NULL ? *record : json_object();
    CLX_CHECK(*record != NULL, CLAST_E_MEMORY, "out of memory");
done:
    clx_free(text);
    return status;
}

/// What the study is, as one text and as an object; who works, and what is tabulated, may change.
static clast_status describe(const clast_study_config *config, char **text, json_t **study)
{
    clast_status status = CLAST_OK;
    clast_study_config same = *config;
    same.shard = "";
    same.keep = (clast_text_list){0};
    CLX_TRY(clast_fields_json(clast_study_fields, &same, text));
    *study = json_loads(*text, 0, NULL);
    CLX_CHECK(*study != NULL, CLAST_E_MEMORY, "out of memory");
done:
    return status;
}

/// Whether two values of a key make the same study. A configuration is compared by its digest, a
/// table by the plan that follows, whatever the spelling of their paths.
static bool is_alike(const json_t *record, const char *key, const json_t *now, const json_t *was)
{
    const bool is_path = strcmp(key, "table") == 0 || (strcmp(key, "config") == 0 &&
                                                       text_in(record, "config_sha256")[0] != '\0');
    return json_equal(now, was) ||
           (is_path && json_string_length(now) > 0 && json_string_length(was) > 0);
}

static clast_status check_study(const char *folder, const json_t *record, const json_t *study)
{
    clast_status status = CLAST_OK;
    const json_t *was = json_object_get(record, "study");
    const char *key = NULL;
    json_t *value = NULL;
    json_object_foreach((json_t *)study, key, value)
    {
        CLX_CHECK(is_alike(record, key, value, json_object_get(was, key)), CLAST_E_USAGE,
                  "%s holds another study (%s differs); give another folder by -o", folder, key);
    }
    CLX_CHECK(json_object_size(was) == json_object_size(study), CLAST_E_USAGE,
              "%s holds another study (study.json has other keys); give another folder by -o",
              folder);
done:
    return status;
}

static bool is_file(const char *path)
{
    struct stat found;
    return stat(path, &found) == 0 && S_ISREG(found.st_mode);
}

const char *clx_study_file_of(const char *argument)
{
    const char *colon = strchr(argument, ':');
    const char *behind = colon != NULL ? colon + 1 : "";
    return is_file(argument) ? argument : is_file(behind) ? behind : NULL;
}

/// Adds a file's role, path, size and digest; one whose name is not UTF-8 cannot be told in JSON.
static clast_status add_input(json_t *inputs, const char *role, const char *path)
{
    clast_status status = CLAST_OK;
    char hex[65] = "";
    int64_t n_byte = 0;
    json_t *name = path != NULL && is_file(path) ? json_string(path) : NULL;
    if (name != NULL) {
        CLX_TRY(clast_sha256_file(path, hex, &n_byte));
        CLX_CHECK(json_array_append_new(inputs, json_pack("{s:s, s:O, s:I, s:s}", "role", role,
                                                          "path", name, "bytes", (json_int_t)n_byte,
                                                          "sha256", hex)) == 0,
                  CLAST_E_MEMORY, "out of memory");
    }
done:
    json_decref(name);
    return status;
}

/// The files that all runs read, as they are now.
static clast_status find_inputs(const clast_study_config *config, json_t *inputs)
{
    clast_status status = CLAST_OK;
    CLX_TRY(add_input(inputs, "config", config->config));
    CLX_TRY(add_input(inputs, "table", config->table));
    for (int32_t i = 0; i < config->argument.n; ++i) {
        CLX_TRY(add_input(inputs, "argument", clx_study_file_of(config->argument.item[i])));
    }
done:
    return status;
}

/// The entry of a file in a list of inputs, or NULL.
static const json_t *find_input(const json_t *inputs, const json_t *like)
{
    for (size_t i = 0; i < json_array_size(inputs); ++i) {
        const json_t *input = json_array_get(inputs, i);
        if (strcmp(text_in(input, "role"), text_in(like, "role")) == 0 &&
            strcmp(text_in(input, "path"), text_in(like, "path")) == 0) {
            return input;
        }
    }
    return NULL;
}

/// Whether a run has an answer, or is under way: a process holds its lock.
static bool is_begun(const char *folder, int64_t row)
{
    char part[CLX_PATH_LIMIT];
    char whole[CLX_PATH_LIMIT];
    struct stat found;
    clx_lock lock = {0};
    bool is_busy = false;
    if (clx_study_is_done(folder, row)) {
        return true;
    }
    if (clx_study_run_folder(folder, row, ".part", part) != CLAST_OK ||
        clx_study_run_folder(folder, row, "", whole) != CLAST_OK || stat(part, &found) != 0) {
        return false;
    }
    (void)clx_lock_acquire(whole, 0.0, &lock, &is_busy);
    clx_lock_release(&lock);
    return is_busy;
}

/// Number of the first run that has an answer or is under way; 0 for none: then all are done with
/// what is there now.
static int64_t first_begun(const char *folder, const clast_table *plan)
{
    for (int64_t row = 0; row < plan->n_row; ++row) {
        if (is_begun(folder, row)) {
            return row + 1;
        }
    }
    return 0;
}

/// Refuses an argument whose file is another than that of a run. The configuration is compared for
/// itself, the table by the plan. Files that are gone, or that are new, pass.
static clast_status check_arguments(const char *folder, const clast_table *plan,
                                    const json_t *before, const json_t *now)
{
    clast_status status = CLAST_OK;
    for (size_t i = 0; i < json_array_size(now); ++i) {
        const json_t *input = json_array_get(now, i);
        const json_t *was = find_input(before, input);
        if (was == NULL || strcmp(text_in(input, "role"), "argument") != 0 ||
            strcmp(text_in(input, "sha256"), text_in(was, "sha256")) == 0) {
            continue;
        }
        const int64_t number = first_begun(folder, plan);
        CLX_CHECK(number == 0, CLAST_E_USAGE,
                  "%s is not the file that run %lld of this study was made with; put the old one "
                  "back, or give another folder by -o",
                  text_in(input, "path"), (long long)number);
    }
done:
    return status;
}

/// Adds what is recorded of files that are gone.
static clast_status add_missing(json_t *inputs, const json_t *before)
{
    for (size_t i = 0; i < json_array_size(before); ++i) {
        json_t *was = json_array_get(before, i);
        if (find_input(inputs, was) == NULL && json_array_append(inputs, was) != 0) {
            return clx_fail(CLAST_E_MEMORY, "out of memory");
        }
    }
    return CLAST_OK;
}

/// Adds this version unless it is there, or has nothing left to do.
static clast_status add_version(const char *folder, const clast_table *plan, json_t *versions)
{
    bool is_there = false;
    bool has_open = false;
    for (size_t i = 0; i < json_array_size(versions); ++i) {
        const char *one = json_string_value(json_array_get(versions, i));
        is_there = is_there || (one != NULL && strcmp(one, clast_version()) == 0);
    }
    for (int64_t row = 0; row < plan->n_row && !is_there && !has_open; ++row) {
        has_open = !clx_study_is_done(folder, row);
    }
    return !has_open || json_array_append_new(versions, json_string(clast_version())) == 0
               ? CLAST_OK
               : clx_fail(CLAST_E_MEMORY, "out of memory");
}

static clast_status write_record(const char *path, const clx_study_record *record,
                                 const json_t *versions, const json_t *inputs)
{
    clast_status status = CLAST_OK;
    clx_file file = {0};
    char *version = json_dumps(versions, 0);
    char *input = json_dumps(inputs, 0);
    CLX_CHECK(version != NULL && input != NULL, CLAST_E_MEMORY, "out of memory");
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_file_print(&file,
                           "{\"study\": %s,\n\"config_sha256\": \"%s\",\n\"clast_versions\": %s,\n"
                           "\"inputs\": %s}\n",
                           record->text, record->config_hex, version, input));
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    free(version); // Jansson's, not ours
    free(input);
    return status;
}

static clast_status check_config(const clast_study_config *config, const json_t *record,
                                 const char *hex)
{
    return strcmp(text_in(record, "config_sha256"), hex) == 0
               ? CLAST_OK
               : clx_fail(CLAST_E_USAGE,
                          "%s is not the configuration that this study was begun with; put the old "
                          "one back, or give another folder by -o",
                          config->config);
}

void clx_study_record_free(clx_study_record *record)
{
    clast_text_free(record->text);
    json_decref(record->study);
    json_decref(record->before);
    *record = (clx_study_record){0};
}

clast_status clx_study_record_read(const clast_study_config *config, const char *folder,
                                   clx_study_record *record)
{
    clast_status status = CLAST_OK;
    int64_t n_byte = 0;
    char path[CLX_PATH_LIMIT];
    CLX_TRY(clx_path_join(path, folder, "study.json"));
    CLX_TRY(describe(config, &record->text, &record->study));
    CLX_TRY(read_record(path, &record->before));
    if (record->before != NULL) {
        CLX_TRY(check_study(folder, record->before, record->study));
    }
    if (config->config[0] != '\0') {
        CLX_TRY(clast_sha256_file(config->config, record->config_hex, &n_byte));
    }
    if (record->before != NULL) {
        CLX_TRY(check_config(config, record->before, record->config_hex));
    }
done:
    return status;
}

clast_status clx_study_record_update(const clast_study_config *config, const char *folder,
                                     const clast_table *plan, const clx_study_record *record)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    const json_t *had_inputs = json_object_get(record->before, "inputs");
    const json_t *had_versions = json_object_get(record->before, "clast_versions");
    json_t *inputs = json_array();
    json_t *versions = json_array();
    CLX_CHECK(inputs != NULL && versions != NULL, CLAST_E_MEMORY, "out of memory");
    if (record->before != NULL && !json_is_array(had_versions)) {
        goto done; // of an older clast
    }
    CLX_TRY(find_inputs(config, inputs));
    CLX_TRY(check_arguments(folder, plan, had_inputs, inputs));
    CLX_TRY(add_missing(inputs, had_inputs));
    CLX_CHECK(had_versions == NULL || json_array_extend(versions, (json_t *)had_versions) == 0,
              CLAST_E_MEMORY, "out of memory");
    CLX_TRY(add_version(folder, plan, versions));
    if (!json_equal(inputs, had_inputs) || !json_equal(versions, had_versions)) {
        CLX_TRY(clx_path_join(path, folder, "study.json"));
        CLX_TRY(write_record(path, record, versions, inputs));
    }
done:
    json_decref(inputs);
    json_decref(versions);
    return status;
}
