// One offline page for one or more run folders.
#include <clast/report.h>

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/file.h"
#include "base/lock.h"
#include "base/path.h"
#include "base/status.h"
#include "report/figures.h"
#include "report/frames.h"
#include "report/page.h"
#include "report/provenance.h"
#include "report/run.h"
#include "report/summary.h"
#include "report/tables.h"
#include "report/view3d.h"
#include "run/run.h"
#include <clast/state.h>
#include <clast/study.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define FIELD(type, name) #name, .offset = offsetof(clast_report_config, name), type
const clast_field clast_report_fields[] = {
    {FIELD(CLAST_FIELD_TEXT, title), 0, 0, 0, "-",
     "title of the page; made from the runs' names when not given", ""},
    {FIELD(CLAST_FIELD_I32, rows), 12, 1, 1e6, "-", "rows shown of each table", NULL},
    {FIELD(CLAST_FIELD_BOOL, view), 1, 0, 1, "-",
     "interactive 3-D view of each run with a state.h5", NULL},
    {FIELD(CLAST_FIELD_I32, triangles), 400000, 1000, 1e8, "-",
     "triangles of one 3-D view; grains are simplified to fit", NULL},
    {FIELD(CLAST_FIELD_I32, picture_mb), 32, 0, 1e4, "-", "most megabytes of pictures of one run",
     NULL},
    {0},
};
#undef FIELD

enum { TITLE_SIZE = 512 };

static bool has_view(const clx_run *run, const clast_report_config *config)
{
    return config->view && clx_run_has(run, "state.h5");
}

static int32_t count_states(const clx_run *run)
{
    int32_t n = 0;
    for (int32_t i = 0; i < run->files.n; ++i) {
        const char *name = run->files.name[i];
        n += strncmp(name, "state", 5) == 0 && clx_path_is(name, "h5") ? 1 : 0;
    }
    return n;
}

/// What the view's slider can show of a run, told below it.
static void write_frames_note(clx_file *file, const clx_frames *frames)
{
    if (frames->lacks_poses) {
        (void)clx_file_print(file, "<p class=\"note\">The frames are of a version before 0.2, "
                                   "which held no poses: no time slider.</p>\n");
    } else if (frames->n < frames->n_file) {
        (void)clx_file_print(file,
                             "<p class=\"note\">%d of the run's %d frames are on this page.</p>\n",
                             (int)frames->n, (int)frames->n_file);
    }
}

static clast_status write_assembly(clx_file *file, const clx_run *run,
                                   const clast_assembly *assembly, const clast_table *contacts,
                                   const clast_report_config *config)
{
    clast_status status = CLAST_OK;
    clx_frames frames = {0};
    CLX_TRY(clx_frames_read(run, assembly, &frames));
    CLX_TRY(clx_view3d_write(file, assembly, contacts, &frames, config->triangles));
    write_frames_note(file, &frames);
done:
    clx_frames_free(&frames);
    return status;
}

/// All bodies in time, of a run whose state is one of them.
static clast_status write_bodies(clx_file *file, const clx_run *run, const clast_assembly *largest,
                                 const clast_report_config *config)
{
    clast_status status = CLAST_OK;
    clast_assembly last = {0};
    CLX_TRY(clx_frames_last(run, largest, &last));
    if (last.n_grain > 0) {
        (void)clx_file_print(file, "<h3>All bodies <small>frames.pvd</small></h3>\n");
        CLX_TRY(write_assembly(file, run, &last, NULL, config));
    }
done:
    clast_assembly_free(&last);
    return status;
}

static const char *word_of(const clx_run *run, const char *key)
{
    const char *word = json_string_value(json_object_get(run->manifest, key));
    return word != NULL ? word : "";
}

static clast_status append_view(clx_file *file, const clx_run *run,
                                const clast_report_config *config)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clast_state state = {0};
    const bool is_part = strcmp(word_of(run, "command"), "evolve") == 0;
    CLX_TRY(clx_run_path(run, "state.h5", path, sizeof path));
    CLX_TRY(clast_state_read(path, &state));
    CLX_CHECK(state.assembly != NULL, CLAST_E_FORMAT, "%s: holds no assembly", path);
    (void)clx_file_print(file, "<h3>%s <small>state.h5%s</small></h3>\n",
                         is_part ? "Largest body" : "Assembly",
                         count_states(run) > 1 ? ", the first of the folder's states" : "");
    if (is_part) {
        CLX_TRY(clx_view3d_write(file, state.assembly, NULL, NULL, config->triangles));
        CLX_TRY(write_bodies(file, run, state.assembly, config));
    } else {
        CLX_TRY(write_assembly(file, run, state.assembly, clast_state_table(&state, "contacts"),
                               config));
    }
done:
    if (status == CLAST_E_GEOMETRY) {
        clx_fail_prefix("%s", path);
    }
    clast_state_free(&state);
    return status;
}

enum { MAX_CODE = 8 };

/// What became of a study's runs.
typedef struct {
    clast_study_outcomes n;
    double code[MAX_CODE]; ///< [n_code] of runs that failed, the first few that differ
    int n_code;
    bool is_under_way; ///< a process is at one of them, now
} outcomes;

static const double *codes_of(const clast_table *results)
{
    return clast_table_numbers(results, "exit_code"); // NULL: none has ended
}

static bool is_failure(double code)
{
    return isfinite(code) && !(fabs(code) < 256.0 && clx_run_is_answer((int)code));
}

clast_status clast_study_count(const clast_table *results, clast_study_outcomes *count)
{
    CLX_ARGUMENTS(results, count);
    CLX_WHOLE(table, results);
    const double *code = codes_of(results);
    clast_study_outcomes n = {.n_run = results->n_row};
    for (int64_t i = 0; code != NULL && i < n.n_run; ++i) {
        n.n_failed += is_failure(code[i]);
        n.n_done += isfinite(code[i]) && !is_failure(code[i]);
        n.n_unconverged += code[i] == 5.0;
    }
    *count = n;
    return CLAST_OK;
}

static void note_code(outcomes *o, double code)
{
    int k = 0;
    while (k < o->n_code && o->code[k] != code) {
        ++k;
    }
    if (k == o->n_code && k < MAX_CODE) {
        o->code[o->n_code++] = code;
    }
}

/// Whether a clast study holds the lock of the run in this row.
static bool is_taken(const clx_run *run, int64_t row)
{
    char name[48];
    char path[CLX_PATH_LIMIT];
    (void)snprintf(name, sizeof name, "runs/%06" PRId64, row + 1);
    return clx_run_path(run, name, path, sizeof path) == CLAST_OK && clx_lock_is_held(path);
}

static outcomes count_outcomes(const clx_run *run, const clast_table *results)
{
    outcomes o = {0};
    (void)clast_study_count(results, &o.n);
    for (int64_t i = 0; o.n.n_failed > 0 && i < o.n.n_run; ++i) {
        if (is_failure(codes_of(results)[i])) {
            note_code(&o, codes_of(results)[i]);
        }
    }
    for (int64_t i = 0; o.n.n_done < o.n.n_run && !o.is_under_way && i < o.n.n_run; ++i) {
        o.is_under_way = is_taken(run, i);
    }
    return o;
}

static void write_failed(clx_file *file, const outcomes *o)
{
    (void)clx_file_print(file,
                         "<p class=\"note\">%" PRId64 " of %" PRId64 " runs failed (exit code%s",
                         o->n.n_failed, o->n.n_run, o->n_code > 1 ? "s" : "");
    for (int k = 0; k < o->n_code; ++k) {
        (void)clx_file_print(file, "%s %g", k > 0 ? "," : "", o->code[k]);
    }
    (void)clx_file_print(file, ")%s</p>\n",
                         o->is_under_way ? "" : "; the same clast study command tries them again");
}

/// What became of a study's runs, where not all are done.
static void write_outcomes(clx_file *file, const clx_run *run)
{
    const clast_table *results = clx_run_table(run, "results");
    if (!clx_run_has(run, "study.json") || results == NULL) {
        return;
    }
    const outcomes o = count_outcomes(run, results);
    const clast_study_outcomes n = o.n;
    const bool is_open = n.n_done + n.n_failed < n.n_run;
    if (n.n_failed > 0) {
        write_failed(file, &o);
    }
    if (n.n_unconverged > 0) {
        (void)clx_file_print(file,
                             "<p class=\"note\">%" PRId64 " of %" PRId64
                             " runs ended without converging (exit code 5)</p>\n",
                             n.n_unconverged, n.n_run);
    }
    if (is_open || o.is_under_way) {
        (void)clx_file_print(
            file, "<p class=\"note\">%s: %" PRId64 " of %" PRId64 " runs %s</p>\n",
            o.is_under_way ? "under way" : "stopped", n.n_done - n.n_unconverged, n.n_run,
            o.is_under_way ? "were done when results.csv was written"
                           : "are done; the same clast study command goes on with the rest");
    }
}

/// Name, command and outcome of the run; index -1: the only run, whose name is above already.
static void write_run_head(clx_file *file, const clx_run *run, int32_t index)
{
    static const struct {
        const char *before, *key;
    } words[] = {
        {"clast ", "command"}, {"version ", "clast_version"}, {"", "outcome"}, {"", "started"}};
    if (index >= 0) {
        (void)clx_file_print(file, "<section class=\"run\" id=\"run-%d\">\n<h2>", (int)index + 1);
        clx_page_text(file, run->name);
        (void)clx_file_print(file, "</h2>\n");
    } else {
        (void)clx_file_print(file, "<section>\n");
    }
    (void)clx_file_print(file, "<p class=\"sub\">");
    for (size_t k = 0; k < sizeof words / sizeof *words; ++k) {
        const char *word = word_of(run, words[k].key);
        if (word[0] != '\0') {
            (void)clx_file_print(file, "%s", words[k].before);
            clx_page_text(file, word);
            (void)clx_file_print(file, " \302\267 ");
        }
    }
    (void)clx_file_print(file, "<code>");
    clx_page_text(file, run->place);
    (void)clx_file_print(file, "</code></p>\n");
    write_outcomes(file, run);
}

static clast_status write_run(clx_file *file, const clx_run *run, int32_t index,
                              const clast_report_config *config)
{
    clast_status status = CLAST_OK;
    write_run_head(file, run, index);
    clx_summary_headline(file, run);
    if (has_view(run, config)) {
        CLX_TRY(append_view(file, run, config));
    }
    if (json_object_size(run->summary) > 0) {
        (void)clx_file_print(file, "<h3>Numbers</h3>\n");
        clx_summary_tables(file, run, config->rows);
    }
    (void)clx_file_print(file, "<h3>Charts and tables</h3>\n");
    CLX_TRY(clx_figures_charts(file, run, index));
    CLX_TRY(clx_tables_write(file, run, config->rows));
    CLX_TRY(clx_figures_pictures(file, run, (int64_t)config->picture_mb * 1000000));
    (void)clx_file_print(file, "<h3>Origin</h3>\n");
    clx_provenance_write(file, run);
    (void)clx_file_print(file, "</section>\n");
done:
    return status;
}

static void make_title(const clx_run *run, int32_t n_run, const clast_report_config *config,
                       char title[TITLE_SIZE])
{
    if (config->title[0] != '\0') {
        (void)snprintf(title, TITLE_SIZE, "%s", config->title);
    } else if (n_run == 1) {
        (void)snprintf(title, TITLE_SIZE, "%s", run[0].name);
    } else {
        (void)snprintf(title, TITLE_SIZE, "%d runs: %s to %s", (int)n_run, run[0].name,
                       run[n_run - 1].name);
    }
}

static clast_status append_page(clx_file *file, const clx_run *run, int32_t n_run,
                                const clast_report_config *config)
{
    clast_status status = CLAST_OK;
    char title[TITLE_SIZE];
    bool any_view = false;
    make_title(run, n_run, config, title);
    clx_page_begin(file, title);
    (void)clx_file_print(file, "<header><p class=\"brand\">clast report</p>\n<h1>");
    clx_page_text(file, title);
    (void)clx_file_print(file, "</h1></header>\n");
    if (n_run > 1) {
        (void)clx_file_print(file, "<section><h2>Side by side</h2>\n");
        clx_summary_compare(file, run, n_run);
        CLX_TRY(clx_figures_compare(file, run, n_run));
        (void)clx_file_print(file, "</section>\n");
    }
    for (int32_t i = 0; i < n_run; ++i) {
        any_view = any_view || has_view(&run[i], config);
        CLX_TRY(write_run(file, &run[i], n_run > 1 ? i : -1, config));
    }
    clx_page_end(file, any_view);
done:
    return status;
}

static clast_status write_page(const char *const *runs, int32_t n_run, const char *place,
                               const clast_report_config *config, const char *path)
{
    clast_status status = CLAST_OK;
    clx_run *run = NULL;
    clx_file file = {0};
    CLX_CHECK(n_run >= 1, CLAST_E_USAGE, "a report needs a run folder");
    CLX_TRY(clx_alloc(&run, n_run, sizeof *run));
    for (int32_t i = 0; i < n_run; ++i) {
        CLX_TRY(clx_run_read(runs[i], place, path, &run[i]));
    }
    clx_runs_tell_apart(run, n_run);
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(append_page(&file, run, n_run, config));
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    for (int32_t i = 0; i < n_run && run != NULL; ++i) {
        clx_run_free(&run[i]);
    }
    clx_free(run);
    return status;
}

clast_status clast_report_write(const char *const *runs, int32_t n_run, const char *path,
                                const clast_report_config *config)
{
    CLX_ARGUMENTS(path);
    CLX_ARRAY(runs, n_run);
    for (int32_t i = 0; i < n_run; ++i) {
        CLX_ARGUMENTS(runs[i]);
    }
    clast_status status = CLAST_OK;
    clast_report_config own = {0};
    if (config != NULL) {
        CLX_GUARD(clast_fields_check(clast_report_fields, config));
        return write_page(runs, n_run, NULL, config, path);
    }
    CLX_TRY(clast_fields_default(clast_report_fields, &own));
    CLX_TRY(write_page(runs, n_run, NULL, &own, path));
done:
    clast_fields_free(clast_report_fields, &own);
    return status;
}

static clast_status write_view(const clast_assembly *assembly, const clast_report_config *config,
                               const char *path)
{
    clast_status status = CLAST_OK;
    clx_file file = {0};
    CLX_TRY(clx_file_begin(path, &file));
    clx_page_begin(&file, config->title[0] != '\0' ? config->title : "clast");
    CLX_TRY(clx_view3d_write(&file, assembly, NULL, NULL, config->triangles));
    clx_page_end(&file, true);
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    return status;
}

clast_status clast_report_write_view(const clast_assembly *assembly, const char *path,
                                     const clast_report_config *config)
{
    CLX_ARGUMENTS(assembly, path);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clast_report_config own = {0};
    if (config != NULL) {
        CLX_GUARD(clast_fields_check(clast_report_fields, config));
        return write_view(assembly, config, path);
    }
    CLX_TRY(clast_fields_default(clast_report_fields, &own));
    CLX_TRY(write_view(assembly, &own, path));
done:
    clast_fields_free(clast_report_fields, &own);
    return status;
}

clast_status clast_report_write_run(const char *folder, const char *place)
{
    CLX_ARGUMENTS(folder);
    clast_status status = CLAST_OK;
    clast_report_config config = {0};
    char path[CLX_PATH_LIMIT];
    const int n = snprintf(path, sizeof path, "%s/report.html", folder);
    if (n < 0 || n >= (int)sizeof path) {
        return clx_fail(CLAST_E_DISK, "the path of folder %.40s... is too long", folder);
    }
    CLX_TRY(clast_fields_default(clast_report_fields, &config));
    CLX_TRY(write_page(&folder, 1, place, &config, path));
done:
    clast_fields_free(clast_report_fields, &config);
    return status;
}
