// Reads a run's folder: summary.json, manifest.json and the tables.
#include "report/run.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include "report/study_origin.h"
#include <clast/run_folder.h>
#include <clast/table.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { MAX_TABLE = 24 };
static const int64_t JSON_LIMIT = (int64_t)64 << 20;

void clx_run_free(clx_run *run)
{
    json_decref(run->summary);
    json_decref(run->manifest);
    clx_folder_free(&run->files);
    for (int32_t i = 0; i < run->n_table; ++i) {
        clast_table_free(&run->table[i]);
    }
    CLX_FREE(run->table, run->path, run->place);
    *run = (clx_run){0};
}

bool clx_run_has(const clx_run *run, const char *file)
{
    for (int32_t i = 0; i < run->files.n; ++i) {
        if (strcmp(run->files.name[i], file) == 0) {
            return true;
        }
    }
    return false;
}

bool clx_run_is_without_unit(const clx_run *run)
{
    const char *unit = json_string_value(json_object_get(run->summary, "unit"));
    return unit != NULL && strcmp(unit, "model") == 0;
}

/// True for a box without positions, whose numbers are of a volume.
static bool is_box_model(const clx_run *run)
{
    const char *unit = json_string_value(json_object_get(run->summary, "unit_n"));
    return unit != NULL && strcmp(unit, "1/m^3") == 0;
}

void clx_run_place(const clx_run *run, const char *part, char place[CLX_QUANTITY_SIZE])
{
    const char *command = json_string_value(json_object_get(run->manifest, "command"));
    const char *name = part != NULL ? part : command != NULL ? command : "";
    (void)snprintf(place, CLX_QUANTITY_SIZE, "%s%s",
                   clx_run_is_without_unit(run) ? CLX_MODEL_UNITS : "",
                   is_box_model(run) ? "box model" : name);
}

const clast_table *clx_run_table(const clx_run *run, const char *name)
{
    for (int32_t i = 0; i < run->n_table; ++i) {
        if (strcmp(run->table[i].name, name) == 0) {
            return &run->table[i];
        }
    }
    return NULL;
}

clast_status clx_run_path(const clx_run *run, const char *file, char *path, size_t size)
{
    const int n = snprintf(path, size, "%s/%s", run->path, file);
    return n >= 0 && (size_t)n < size
               ? CLAST_OK
               : clx_fail(CLAST_E_IO, "%.40s...: the path is too long", run->path);
}

/// Seeds go up to 2^64 - 1, Jansson's integers to 2^63 - 1: such a seed is kept as its digits.
static void keep_seed(const char *text, json_t *object)
{
    static const char mark[] = "\"seed\": ";
    const char *seed = strstr(text, mark);
    const char *digits = seed != NULL ? seed + sizeof mark - 1 : "";
    const size_t n = strspn(digits, "0123456789");
    if (n > 0 && json_is_real(json_object_get(object, "seed"))) {
        (void)json_object_set_new(object, "seed", json_stringn(digits, n));
    }
}

/// A JSON object from a file.
static clast_status read_object(const clx_run *run, const char *file, json_t **object)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char *text = NULL;
    int64_t n = 0;
    json_error_t error;
    json_t *made = NULL;
    CLX_TRY(clx_run_path(run, file, path, sizeof path));
    CLX_TRY(clx_file_read_all(path, JSON_LIMIT, &text, &n));
    made = json_loadb(text, (size_t)n, 0, &error);
    if (made == NULL && json_error_code(&error) == json_error_numeric_overflow) {
        made = json_loadb(text, (size_t)n, JSON_DECODE_INT_AS_REAL, &error);
        keep_seed(text, made);
    }
    CLX_CHECK(made != NULL || json_error_code(&error) != json_error_out_of_memory, CLAST_E_MEMORY,
              "not enough memory for %s", path);
    CLX_CHECK(made != NULL, CLAST_E_FORMAT, "%s:%d:%d: %s", path, error.line, error.column,
              error.text);
    CLX_CHECK(json_is_object(made), CLAST_E_FORMAT, "%s: not a JSON object", path);
    *object = made;
    made = NULL;
done:
    json_decref(made);
    clx_free(text);
    return status;
}

static clast_status read_tables(clx_run *run)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    for (int32_t i = 0; i < run->files.n && run->n_table < MAX_TABLE; ++i) {
        const char *file = run->files.name[i];
        if (!clx_path_is(file, "csv")) {
            continue;
        }
        CLX_TRY(clx_run_path(run, file, path, sizeof path));
        CLX_TRY(clx_realloc(&run->table, run->n_table + 1, sizeof *run->table));
        clast_table *table = &run->table[run->n_table];
        *table = (clast_table){0};
        CLX_TRY(clast_table_read_csv(path, NULL, table, NULL));
        ++run->n_table;
        clx_free(table->name);
        table->name = NULL;
        CLX_TRY(clx_alloc_text(&table->name, file));
        table->name[strlen(file) - 4] = '\0';
    }
done:
    return status;
}

/// The path without '/' at its end.
static clast_status copy_path(const char *path, char **copy)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc_text(copy, path));
    size_t n = strlen(*copy);
    while (n > 1 && (*copy)[n - 1] == '/') {
        (*copy)[--n] = '\0';
    }
done:
    return status;
}

static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL && slash[1] != '\0' ? slash + 1 : path;
}

static clast_status set_path(const char *folder, const char *place, clx_run *run)
{
    clast_status status = CLAST_OK;
    CLX_TRY(copy_path(folder, &run->path));
    CLX_TRY(copy_path(place != NULL ? place : folder, &run->place));
    run->name = last_part(run->place);
done:
    return status;
}

/// Length of the folders that both paths begin with, each with its '/'.
static size_t shared_length(const char *a, const char *b)
{
    size_t n = 0;
    for (size_t i = 0; a[i] != '\0' && a[i] == b[i]; ++i) {
        n = a[i] == '/' ? i + 1 : n;
    }
    return n;
}

void clx_runs_tell_apart(clx_run *run, int32_t n_run)
{
    for (int32_t i = 0; i < n_run; ++i) {
        const char *last = last_part(run[i].place);
        size_t n = (size_t)(last - run[i].place);
        for (int32_t k = 0; k < n_run; ++k) {
            const size_t shared = strcmp(last, last_part(run[k].place)) == 0
                                      ? shared_length(run[i].place, run[k].place)
                                      : n;
            n = shared < n ? shared : n;
        }
        run[i].name = run[i].place + n;
    }
}

/// The way from the page's folder to the run's, where their texts tell it.
static void set_link(const char *page, clx_run *run)
{
    const char *slash = strrchr(page, '/');
    const size_t n = slash != NULL ? (size_t)(slash - page) : 0;
    const size_t length = strlen(run->path);
    int used = 0;
    if (slash != NULL && length == n && strncmp(run->path, page, n) == 0) {
        run->link[0] = '\0';
    } else if (slash != NULL && length > n && strncmp(run->path, page, n) == 0 &&
               run->path[n] == '/') {
        used = snprintf(run->link, sizeof run->link, "%s/", run->path + n + 1);
    } else if (slash == NULL && run->path[0] != '/') {
        used = snprintf(run->link, sizeof run->link, "%s/", run->path);
    } else {
        return;
    }
    run->can_link = used >= 0 && used < (int)sizeof run->link;
}

/// manifest.json; of a study, which has none, what its study.json and its runs tell.
static clast_status read_manifest(clx_run *run)
{
    clast_status status = CLAST_OK;
    json_t *study = NULL;
    if (clx_run_has(run, "manifest.json")) {
        return read_object(run, "manifest.json", &run->manifest);
    }
    if (!clx_run_has(run, "study.json")) {
        return CLAST_OK;
    }
    CLX_TRY(read_object(run, "study.json", &study));
    CLX_TRY(clx_study_origin(run, study, &run->manifest));
done:
    json_decref(study);
    return status;
}

/// A study has none. The body for printers, which may be made later, has a file of its own.
static clast_status read_summary(clx_run *run)
{
    if (clx_run_has(run, "summary.json")) {
        json_t *body = NULL;
        clast_status status = read_object(run, "summary.json", &run->summary);
        if (status == CLAST_OK && clx_run_has(run, "printable.json")) {
            status = read_object(run, "printable.json", &body);
            (void)json_object_set_new(run->summary, "printable", body);
        }
        return status;
    }
    run->summary = json_object();
    return run->summary != NULL ? CLAST_OK : clx_fail(CLAST_E_MEMORY, "not enough memory");
}

clast_status clx_run_read(const char *folder, const char *place, const char *page, clx_run *run)
{
    clast_status status = CLAST_OK;
    clx_run made = {0};
    CLX_TRY(set_path(folder, place, &made));
    set_link(page, &made);
    if (place == NULL) {
        CLX_TRY(clast_run_folder_check(made.path));
    }
    CLX_TRY(clx_folder_list(made.path, &made.files));
    CLX_TRY(read_tables(&made)); // a study's runs are those of its plan
    CLX_TRY(read_manifest(&made));
    CLX_TRY(read_summary(&made));
    *run = made;
    made = (clx_run){0};
done:
    clx_run_free(&made);
    return status;
}
