// manifest.json: version and commit, command line, configuration, seed, inputs' digests, host and
// times.
#include <clast/run_folder.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "base/file.h"
#include "base/lock.h"
#include "base/path.h"
#include "io/config_files.h"
#include "io/json.h"
#include "io/sha256.h"
#include "run/run.h"
#include <clast/field.h>
#include <clast/grading.h>
#include <clast/machine.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

typedef struct {
    char *role, *path;
    char sha256[65];
    int64_t n_byte;
} input_file;

typedef struct {
    char *key, *text;
} note;

struct clast_manifest {
    char *command;
    int argc;
    char **argv;  ///< [argc]
    char *config; ///< JSON, or NULL
    bool has_seed;
    uint64_t seed;
    int32_t n_input;
    input_file *input; ///< [n_input]
    int32_t n_note;
    note *notes; ///< [n_note]
    int32_t n_output;
    char **output; ///< [n_output]
    bool has_progress;
    double progress; ///< 0 to 1
    double begun;
    time_t started;
};

void clast_text_free(char *text)
{
    clx_free(text);
}

void clast_manifest_destroy(clast_manifest *manifest)
{
    if (manifest == NULL) {
        return;
    }
    for (int i = 0; i < manifest->argc; ++i) {
        clx_free(manifest->argv[i]);
    }
    for (int32_t i = 0; i < manifest->n_input; ++i) {
        CLX_FREE(manifest->input[i].role, manifest->input[i].path);
    }
    for (int32_t i = 0; i < manifest->n_note; ++i) {
        CLX_FREE(manifest->notes[i].key, manifest->notes[i].text);
    }
    for (int32_t i = 0; i < manifest->n_output; ++i) {
        clx_free(manifest->output[i]);
    }
    CLX_FREE(manifest->output, manifest->argv, manifest->input, manifest->notes, manifest->command,
             manifest->config, manifest);
}

clast_status clast_manifest_create(const char *command, int argc, char *const *argv,
                                   clast_manifest **manifest)
{
    CLX_ARGUMENTS(command, manifest);
    CLX_ARRAY(argv, argc);
    for (int i = 0; i < argc; ++i) {
        CLX_ARGUMENTS(argv[i]);
    }
    clast_status status = CLAST_OK;
    clast_manifest *made = NULL;
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    made->begun = clx_clock();
    made->started = time(NULL);
    CLX_TRY(clx_alloc_text(&made->command, command));
    CLX_TRY(clx_alloc(&made->argv, argc, sizeof *made->argv));
    for (; made->argc < argc; ++made->argc) {
        CLX_TRY(clx_alloc_text(&made->argv[made->argc], argv[made->argc]));
    }
    *manifest = made;
    made = NULL;
done:
    clast_manifest_destroy(made);
    return status;
}

clast_status clast_manifest_config(clast_manifest *manifest, const clast_field *fields,
                                   const void *config)
{
    CLX_ARGUMENTS(manifest, fields, config);
    char *text = NULL;
    const clast_status status = clast_fields_json(fields, config, &text);
    if (status == CLAST_OK) {
        clx_free(manifest->config);
        manifest->config = text;
    }
    return status;
}

void clast_manifest_seed(clast_manifest *manifest, uint64_t seed)
{
    if (manifest == NULL) {
        return;
    }
    manifest->has_seed = true;
    manifest->seed = seed;
}

clast_status clast_sha256_file(const char *path, char hex[65], int64_t *n_byte)
{
    CLX_ARGUMENTS(path, hex);
    enum { BLOCK = 1 << 16 };
    clast_status status = CLAST_OK;
    char *block = NULL;
    FILE *file = NULL;
    struct stat found;
    clx_sha256 sha = clx_sha256_begin();
    if (stat(path, &found) == 0 && (S_ISFIFO(found.st_mode) || S_ISCHR(found.st_mode))) {
        hex[0] = '\0'; // was read to its end: a second reader would wait for ever, or see nothing
        if (n_byte != NULL) {
            *n_byte = 0;
        }
        goto done;
    }
    file = fopen(path, "rb");
    CLX_CHECK(file != NULL, CLAST_E_IO, "cannot read %s: %s", path, clx_errno_text());
    CLX_TRY(clx_alloc(&block, BLOCK, 1));
    for (size_t n = fread(block, 1, BLOCK, file); n > 0; n = fread(block, 1, BLOCK, file)) {
        clx_sha256_add(&sha, block, n);
    }
    CLX_CHECK(ferror(file) == 0, CLAST_E_IO, "cannot read %s: %s", path, clx_errno_text());
    if (n_byte != NULL) {
        *n_byte = (int64_t)sha.n_byte;
    }
    clx_sha256_end(&sha, hex);
done:
    if (file != NULL) {
        (void)fclose(file);
    }
    clx_free(block);
    return status;
}

clast_status clast_manifest_input(clast_manifest *manifest, const char *role, const char *path)
{
    CLX_ARGUMENTS(manifest, role, path);
    clast_status status = CLAST_OK;
    input_file made = {0};
    CLX_TRY(clast_sha256_file(path, made.sha256, &made.n_byte));
    CLX_TRY(clx_alloc_text(&made.role, role));
    CLX_TRY(clx_alloc_text(&made.path, path));
    CLX_TRY(clx_realloc(&manifest->input, manifest->n_input + 1, sizeof *manifest->input));
    manifest->input[manifest->n_input++] = made;
    made = (input_file){0};
done:
    CLX_FREE(made.role, made.path);
    return status;
}

/// The digest that a manifest's list of inputs has for a file, or NULL.
static const char *digest_in(const json_t *inputs, const input_file *input)
{
    for (size_t i = 0; i < json_array_size(inputs); ++i) {
        const json_t *item = json_array_get(inputs, i);
        const char *role = json_string_value(json_object_get(item, "role"));
        const char *path = json_string_value(json_object_get(item, "path"));
        if (role != NULL && path != NULL && strcmp(role, input->role) == 0 &&
            strcmp(path, input->path) == 0) {
            return json_string_value(json_object_get(item, "sha256"));
        }
    }
    return NULL;
}

clast_status clx_manifest_check_input(const clast_manifest *manifest, const json_t *earlier)
{
    CLAST_ASSERT(manifest->n_input > 0);
    clast_status status = CLAST_OK;
    const input_file *input = &manifest->input[manifest->n_input - 1];
    const char *was = digest_in(earlier, input);
    CLX_CHECK(was == NULL || input->sha256[0] == '\0' || strcmp(was, input->sha256) == 0,
              CLAST_E_FORMAT,
              "%s (%s) is not the one that the checkpoint was made with: the file has changed; put "
              "the old one back, or begin anew",
              input->path, input->role);
done:
    return status;
}

clast_status clast_manifest_note(clast_manifest *manifest, const char *key, const char *text)
{
    CLX_ARGUMENTS(manifest, key, text);
    clast_status status = CLAST_OK;
    note made = {0};
    for (int32_t i = 0; i < manifest->n_note; ++i) {
        CLX_CHECK(strcmp(manifest->notes[i].key, key) != 0, CLAST_E_USAGE,
                  "the manifest has a note %s already", key);
    }
    CLX_TRY(clx_alloc_text(&made.key, key));
    CLX_TRY(clx_alloc_text(&made.text, text));
    CLX_TRY(clx_realloc(&manifest->notes, manifest->n_note + 1, sizeof *manifest->notes));
    manifest->notes[manifest->n_note++] = made;
    made = (note){0};
done:
    CLX_FREE(made.key, made.text);
    return status;
}

clast_status clx_manifest_output(clast_manifest *manifest, const char *name)
{
    CLX_ARGUMENTS(manifest, name);
    clast_status status = CLAST_OK;
    char *made = NULL;
    CLX_TRY(clx_alloc_text(&made, name));
    CLX_TRY(clx_realloc(&manifest->output, manifest->n_output + 1, sizeof *manifest->output));
    manifest->output[manifest->n_output++] = made;
    made = NULL;
done:
    clx_free(made);
    return status;
}

void clx_manifest_progress(clast_manifest *manifest, double share)
{
    if (manifest == NULL) {
        return;
    }
    manifest->has_progress = true;
    manifest->progress = share;
}

static void write_key(clx_file *file, const char *key)
{
    (void)clx_file_print(file, ",\n  ");
    clx_json_text(file, key);
    (void)clx_file_print(file, ": ");
}

static void write_text(clx_file *file, const char *key, const char *text)
{
    write_key(file, key);
    clx_json_text(file, text);
}

static void write_number(clx_file *file, const char *key, double value)
{
    write_key(file, key);
    clx_json_number(file, value);
}

/// First "model name" of /proc/cpuinfo, or "" where there is none.
static void find_processor(char *name, size_t size)
{
    char line[256];
    name[0] = '\0';
    FILE *info = fopen("/proc/cpuinfo", "r");
    while (info != NULL && fgets(line, sizeof line, info) != NULL) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon != NULL) {
            (void)snprintf(name, size, "%.*s", (int)strcspn(colon + 1, "\n") - 1, colon + 2);
            break;
        }
    }
    if (info != NULL) {
        (void)fclose(info);
    }
}

/// The class of machine, not its name.
static void write_host(clx_file *file)
{
    struct utsname system;
    char processor[256];
    const bool known = uname(&system) >= 0;
    find_processor(processor, sizeof processor);
    write_key(file, "host");
    (void)clx_file_print(file, "{\"system\": ");
    clx_json_text(file, known ? system.sysname : "");
    (void)clx_file_print(file, ", \"machine\": ");
    clx_json_text(file, known ? system.machine : "");
    (void)clx_file_print(file, ", \"processor\": ");
    clx_json_text(file, processor);
    (void)clx_file_print(file, ", \"cores\": %ld, \"compiler\": ", sysconf(_SC_NPROCESSORS_ONLN));
    clx_json_text(file, __VERSION__);
    (void)clx_file_print(file, "}");
}

static void write_time(clx_file *file, const char *key, time_t when)
{
    struct tm utc;
    char text[32] = "";
    if (gmtime_r(&when, &utc) != NULL) {
        (void)strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    }
    write_text(file, key, text);
}

static void write_use(clx_file *file)
{
#ifdef __EMSCRIPTEN__ // whose getrusage makes its numbers up; its memory never shrinks
    write_number(file, "peak_memory_bytes", 65536.0 * (double)__builtin_wasm_memory_size(0));
#else
    struct rusage used;
    if (getrusage(RUSAGE_SELF, &used) == 0) {
        write_number(file, "cpu_s",
                     (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                         1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec));
        write_number(file, "peak_memory_bytes", 1024.0 * (double)used.ru_maxrss);
    }
#endif
}

static void write_times(clx_file *file, const clast_manifest *m, bool is_over)
{
    write_time(file, "started", m->started);
    if (is_over) {
        write_time(file, "ended", time(NULL));
    }
    write_number(file, "wall_s", clx_clock() - m->begun);
    write_use(file);
}

static void write_inputs(clx_file *file, const clast_manifest *m)
{
    write_key(file, "inputs");
    (void)clx_file_print(file, "[");
    for (int32_t i = 0; i < m->n_input; ++i) {
        const input_file *input = &m->input[i];
        (void)clx_file_print(file, "%s\n    {\"role\": ", i > 0 ? "," : "");
        clx_json_text(file, input->role);
        (void)clx_file_print(file, ", \"path\": ");
        clx_json_text(file, input->path);
        if (input->sha256[0] != '\0') {
            (void)clx_file_print(file, ", \"bytes\": %" PRId64 ", \"sha256\": \"%s\"}",
                                 input->n_byte, input->sha256);
        } else {
            (void)clx_file_print(file, ", \"bytes\": null, \"sha256\": null}");
        }
    }
    (void)clx_file_print(file, "]");
}

static void write_texts(clx_file *file, const char *key, int32_t n, char *const *text)
{
    CLAST_ASSERT(n >= 0);
    write_key(file, key);
    (void)clx_file_print(file, "[");
    for (int32_t i = 0; i < n; ++i) {
        (void)clx_file_print(file, "%s", i > 0 ? ", " : "");
        clx_json_text(file, text[i]);
    }
    (void)clx_file_print(file, "]");
}

clast_status clast_manifest_write(const clast_manifest *manifest, const char *outcome,
                                  const char *path)
{
    CLX_ARGUMENTS(manifest, outcome, path);
    clast_status status = CLAST_OK;
    clx_file file = {0};
    CLX_TRY(clx_file_begin(path, &file));
    (void)clx_file_print(&file, "{\n  \"format\": \"clast manifest\"");
    write_text(&file, "clast_version", clast_version());
    write_text(&file, "clast_source", clast_source());
    write_text(&file, "command", manifest->command);
    write_texts(&file, "command_line", manifest->argc, manifest->argv);
    write_text(&file, "outcome", outcome);
    if (strcmp(outcome, "running") == 0) { // for the messages of whoever finds the folder locked
        char name[CLX_PROCESS_NAME];
        clx_process_name(name);
        write_text(&file, "process", name);
    }
    if (manifest->has_progress && strcmp(outcome, "done") != 0) {
        write_number(&file, "progress", manifest->progress);
    }
    if (manifest->n_output > 0) {
        write_texts(&file, "outputs", manifest->n_output, manifest->output);
    }
    if (manifest->has_seed) {
        write_key(&file, "seed");
        (void)clx_file_print(&file, "%" PRIu64, manifest->seed);
    }
    if (manifest->config != NULL) {
        write_key(&file, "config");
        (void)clx_file_write(&file, manifest->config, strlen(manifest->config));
    }
    write_inputs(&file, manifest);
    for (int32_t i = 0; i < manifest->n_note; ++i) {
        write_text(&file, manifest->notes[i].key, manifest->notes[i].text);
    }
    write_key(&file, "threads");
    (void)clx_file_print(&file, "%d", clast_parallel_threads());
    write_host(&file);
    write_times(&file, manifest, strcmp(outcome, "running") != 0);
    (void)clx_file_print(&file, "\n}\n");
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    return status;
}

clast_status clx_run_note_inputs(clast_run_folder *run, const clx_run_inputs *inputs)
{
    clast_status status = CLAST_OK;
    clast_manifest *manifest = clast_run_folder_manifest(run);
    const char *role = NULL;
    const char *path = NULL;
    CLX_TRY(clast_manifest_config(manifest, inputs->fields, inputs->config));
    clast_manifest_seed(manifest, inputs->seed);
    for (int32_t i = 0; (path = inputs->file(inputs->config, i, &role)) != NULL; ++i) {
        CLX_TRY(clast_run_folder_input(run, role, path));
    }
done:
    return status;
}

clast_status clx_run_tell_list(clast_run_folder *run, const clast_monitor *monitor,
                               const char *sizes, bool by_mass, const clast_grading_list *list)
{
    char words[1536];
    char text[sizeof words + CLX_PATH_LIMIT];
    if (list->column[0] == '\0' && list->ignored[0] == '\0') {
        return CLAST_OK;
    }
    (void)snprintf(text, sizeof text, "%s: %s", sizes,
                   clast_grading_list_text(list, by_mass, sizeof words, words));
    if (monitor != NULL && monitor->note != NULL) {
        monitor->note(monitor->context, text);
    }
    return run != NULL ? clast_manifest_note(clast_run_folder_manifest(run), "sizes", words)
                       : CLAST_OK;
}

void clx_run_tell_meaning(const clast_monitor *monitor, const char *file,
                          const clast_grading_list *list, const char *taken)
{
    char text[512];
    if (strncmp(list->size, "volume", 6) == 0 && monitor != NULL && monitor->note != NULL) {
        (void)snprintf(
            text, sizeof text,
            "%.127s: its sizes are column '%.127s', and are taken as %s; as diameters of "
            "equal volume: --size-meaning volume",
            file, list->size, taken);
        monitor->note(monitor->context, text);
    }
}

clast_status clx_run_tell_curve(clast_run_folder *run, const clast_monitor *monitor,
                                const char *curve, const clast_grading *grading)
{
    const clast_grading_list list = clast_grading_list_of(grading);
    return clx_run_tell_list(run, monitor, curve, strncmp(curve, "masses:", 7) == 0, &list);
}
