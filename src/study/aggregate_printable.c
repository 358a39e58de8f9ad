// The printable body of a run: the last of its results, which is not needed for it to be whole, and
// which a whole run can have made later.
#include "study/aggregate_folder.h"

#include "aggregate/config.h"
#include "assembly/pieces.h"
#include "base/alloc.h"
#include "base/file.h"
#include "base/lock.h"
#include "base/monitor.h"
#include "base/number.h"
#include "base/path.h"
#include "geom/check.h"
#include "run/run.h"
#include <clast/assembly.h>
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <clast/report.h>
#include <clast/table.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { STL, THREEMF, JSON, N_FILE };
static const char *const FILES[] = {
    [STL] = "printable.stl", [THREEMF] = "printable.3mf", [JSON] = "printable.json"};

/// Before the names of files that are not yet all there; a run sweeps such names.
#define STAGED ".clast-"

/// For as long as another process may take to write those of its body [s].
static const double PATIENCE = 60.0;

clast_status clx_folder_largest(const clast_assembly *all, const clast_table *members,
                                clast_assembly *largest, int32_t *n_cluster)
{
    clast_status status = CLAST_OK;
    const double *of = members != NULL ? clast_table_numbers(members, "cluster") : NULL;
    int32_t *cluster = NULL;
    int32_t *count = NULL;
    int32_t best = 0;
    int32_t n = 1;
    CLX_CHECK(of != NULL && members->n_row == all->n_grain, CLAST_E_FORMAT,
              "the members table does not fit %d grains", all->n_grain);
    CLX_TRY(clx_alloc(&cluster, all->n_grain, sizeof *cluster));
    CLX_TRY(clx_alloc(&count, all->n_grain, sizeof *count));
    for (int32_t i = 0; i < all->n_grain; ++i) {
        CLX_CHECK(of[i] >= 0.0 && of[i] < all->n_grain, CLAST_E_FORMAT,
                  "the cluster of grain %d is out of range", i);
        cluster[i] = (int32_t)of[i];
        ++count[cluster[i]];
        n = cluster[i] >= n ? cluster[i] + 1 : n;
    }
    for (int32_t c = 1; c < n; ++c) {
        best = count[c] > count[best] ? c : best;
    }
    if (n > 1) {
        CLX_TRY(clx_assembly_part(all, cluster, best, largest));
    }
    *n_cluster = n;
done:
    CLX_FREE(cluster, count);
    return status;
}

/// Reads back what was written: a printer takes nothing but one closed, outward surface.
static clast_status verify(const char *path)
{
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    clast_mesh_check_result found = {0};
    CLX_TRY(clast_mesh_read(path, &mesh, NULL));
    CLX_TRY(clx_check_without_cuts(&mesh, &found));
    CLX_CHECK(found.closed && found.oriented && found.manifold && found.n_part == 1,
              CLAST_E_GEOMETRY,
              "%s is not one closed, oriented surface (%d parts, %d open edges): choose a smaller "
              "spacing",
              path, found.n_part, found.n_open_edge);
done:
    clast_mesh_check_free(&found);
    clast_mesh_free(&mesh);
    return status;
}

/// printable.json: what the body can and cannot show.
static clast_status write_report(const char *path, const clast_printable_report *r,
                                 int64_t n_triangle)
{
    clast_status status = CLAST_OK;
    clx_file file = {0};
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_file_print(&file,
                           "{\n  \"smallest_feature\": %.17g,\n  \"resolved\": %s,\n"
                           "  \"walls_measured\": %s,\n  \"lost\": %.17g,\n"
                           "  \"neck\": %.17g,\n  \"spacing\": %.17g,\n",
                           r->smallest_feature, r->resolved ? "true" : "false",
                           r->knows_walls ? "true" : "false", r->lost, r->neck, r->spacing));
    CLX_TRY(clx_file_print(&file,
                           "  \"n_part\": %d,\n  \"n_void_filled\": %d,\n"
                           "  \"void_volume\": %.17g,\n  \"solid_volume\": %.17g,\n"
                           "  \"volume\": %.17g,\n  \"n_triangle\": %lld\n}\n",
                           r->n_part, r->n_void, r->void_volume, r->solid_volume, r->volume,
                           (long long)n_triangle));
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    return status;
}

static void note(const clast_monitor *monitor, const char *text)
{
    if (monitor != NULL && monitor->note != NULL) {
        monitor->note(monitor->context, text);
    }
}

/// Tells the size of the file before the work for it begins.
static clast_status announce(const clast_assembly *body, const clast_printable_config *config,
                             const clast_monitor *monitor)
{
    clast_status status = CLAST_OK;
    clast_printable_report plan = {0};
    double factor = 1.0;
    char text[200];
    CLX_TRY(clast_assembly_printable_plan(body, config, &plan));
    const char *unit = clast_unit_for(plan.spacing, "m", &factor);
    (void)clx_number_print(
        text, sizeof text,
        "printable.stl: about %.0f triangles, %.3g MB, at a spacing of %.3g %s (--spacing)",
        plan.n_triangle_expected, 50e-6 * plan.n_triangle_expected, factor * plan.spacing, unit);
    note(monitor, text);
done:
    return status;
}

/// FOLDER/.clast-printable.stl and so on.
static clast_status stage(char path[CLX_PATH_LIMIT], const char *folder, int file)
{
    char name[64];
    (void)snprintf(name, sizeof name, STAGED "%s", FILES[file]);
    return clx_path_join(path, folder, name);
}

/// All files of a body side by side with those of an earlier one.
static clast_status write_staged(const char *folder, const clast_printable_report *report,
                                 const clast_mesh *mesh, const clast_monitor *monitor)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    const clast_mesh_write_options options = {.unit = "mm", .name = "printable"};
    for (int k = 0; k < N_FILE; ++k) {
        CLX_CHECK(!clx_monitor_stops(monitor), CLAST_E_STOPPED, "stopped");
        CLX_TRY(stage(path, folder, k));
        CLX_TRY(k == JSON ? write_report(path, report, mesh->n_tri)
                          : clast_mesh_write(mesh, path, &options));
        if (k == STL) {
            CLX_CHECK(!clx_monitor_stops(monitor), CLAST_E_STOPPED, "stopped");
            CLX_TRY(verify(path));
        }
    }
done:
    return status;
}

/// Puts them in the place of the earlier ones.
static clast_status rename_staged(const char *folder)
{
    clast_status status = CLAST_OK;
    char from[CLX_PATH_LIMIT];
    char to[CLX_PATH_LIMIT];
    struct stat there;
    for (int k = 0; k < N_FILE; ++k) { // a folder of that name is all that could be in the way
        CLX_TRY(clx_path_join(to, folder, FILES[k]));
        CLX_CHECK(stat(to, &there) != 0 || !S_ISDIR(there.st_mode), CLAST_E_DISK,
                  "cannot write %s: it is a folder", to);
    }
    for (int k = 0; k < N_FILE; ++k) {
        CLX_TRY(stage(from, folder, k));
        CLX_TRY(clx_path_join(to, folder, FILES[k]));
        CLX_CHECK(rename(from, to) == 0, CLAST_E_DISK, "cannot write %s: %s", to, clx_errno_text());
    }
    CLX_TRY(clx_folder_sync(folder));
done:
    return status;
}

/// The files of a body, whose coordinates become millimetres, all or none: those of an earlier body
/// stay when one cannot be written, or is no printable surface.
static clast_status write_files(const char *folder, const clast_printable_report *report,
                                const clast_monitor *monitor, clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    const double none[3] = {0.0, 0.0, 0.0};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    clx_lock lock = {0};
    bool is_busy = false;
    CLX_TRY(clx_path_join(path, folder, STAGED "printable"));
    CLX_TRY(clx_lock_acquire(path, PATIENCE, &lock, &is_busy));
    clast_mesh_transform(mesh, 1e3, unturned, none);
    CLX_TRY(write_staged(folder, report, mesh, monitor));
    CLX_TRY(rename_staged(folder));
done:
    for (int k = 0; k < N_FILE && lock.path != NULL; ++k) {
        if (stage(path, folder, k) == CLAST_OK) {
            (void)unlink(path); // what was not renamed
        }
    }
    clx_lock_release(&lock);
    return status;
}

/// What the printed body does not show, in one line.
static void note_unresolved(const clast_monitor *monitor, const clast_printable_report *r)
{
    char text[200];
    double factor = 1.0;
    const char *unit = clast_unit_for(r->smallest_feature, "m", &factor);
    if (r->lost > 0.0) {
        (void)clx_number_print(text, sizeof text,
                               "printable.stl: not resolved: %.2g %% of the grains' volume is "
                               "lost, thin walls of them; take a finer --spacing",
                               100.0 * r->lost);
        note(monitor, text);
    } else if (!r->resolved) {
        (void)clx_number_print(text, sizeof text,
                               "printable.stl: not resolved: the smallest feature, %.4g %s, is "
                               "below two spacings and may be lost; take a finer --spacing",
                               factor * r->smallest_feature, unit);
        note(monitor, text);
    }
}

static clast_status write_body(const char *folder, const clast_assembly *body,
                               const clast_printable_config *config, const clast_monitor *monitor,
                               clast_printable_report *report)
{
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    CLX_TRY(announce(body, config, monitor));
    CLX_TRY(clast_assembly_printable(body, config, monitor, &mesh, report));
    CLX_TRY(write_files(folder, report, monitor, &mesh));
    note_unresolved(monitor, report);
done:
    clast_mesh_free(&mesh);
    return status;
}

/// A spacing as it is typed: "333nm".
static const char *typed(double length, char text[32])
{
    double factor = 1.0;
    const char *unit = clast_unit_for(length, "m", &factor);
    (void)clx_number_print(text, 32, "%.3g%s", factor * length, unit);
    return text;
}

/// What to type for a body that could not be made, after what went wrong: a finer spacing where it
/// is in pieces, the spacing of its own choice where the grid is too large, the same where it was
/// stopped or the disk full; "" where none helps.
static void find_cure(const char *name, const clast_assembly *body,
                      const clast_printable_config *config, clast_status why, char text[512])
{
    clast_printable_report plan = {0};
    const bool is_pieces = why == CLAST_E_GEOMETRY;
    const bool is_same = why == CLAST_E_STOPPED || why == CLAST_E_DISK;
    char neck[48] = "";
    char spacing[48] = "";
    char length[32];
    text[0] = '\0';
    if (why == CLAST_E_USAGE ||
        (is_pieces && clast_assembly_printable_plan(body, config, &plan) != CLAST_OK)) {
        return;
    }
    if (config->neck > 0.0) {
        (void)snprintf(neck, sizeof neck, " --neck %s", typed(config->neck, length));
    }
    if (is_pieces) { // a neck shows at a third of it
        const double third = plan.neck / 3.0;
        const double finer = third < plan.spacing ? third : 0.5 * plan.spacing;
        (void)snprintf(spacing, sizeof spacing, " --spacing %s", typed(finer, length));
    } else if (is_same && config->spacing > 0.0) {
        (void)snprintf(spacing, sizeof spacing, " --spacing %s", typed(config->spacing, length));
    }
    (void)snprintf(text, 512, "; clast aggregate --resume %.300s --printable%s%s %s", name, neck,
                   spacing, is_same ? "makes it" : "tries that");
}

/// Whether contacts join all grains, without which no spacing helps.
static bool is_one_group(const clast_assembly *body)
{
    int32_t *piece = NULL;
    int32_t n_piece = 0;
    clast_status status = clx_alloc(&piece, body->n_grain, sizeof *piece);
    status = status == CLAST_OK ? clx_assembly_pieces(body, piece, &n_piece) : status;
    clx_free(piece);
    return status == CLAST_OK && n_piece == 1;
}

clast_status clx_folder_write_printable(const char *folder, const clast_assembly *body,
                                        const clast_printable_config *config,
                                        const clast_monitor *monitor,
                                        clast_printable_report *report)
{
    char why[1024];
    char cure[512] = "";
    const clast_status status = write_body(folder, body, config, monitor, report);
    if (status == CLAST_OK) {
        return CLAST_OK;
    }
    (void)snprintf(why, sizeof why, "%s", clast_error_detail());
    if (is_one_group(body)) {
        find_cure(folder, body, config, status, cure);
    }
    return clx_fail(status, "%s%s", why, cure);
}

void clx_folder_note_largest(const clast_monitor *monitor, const clast_assembly *body,
                             int32_t n_all, int32_t n_cluster)
{
    char text[160];
    if (n_cluster > 1) {
        (void)snprintf(text, sizeof text,
                       "printable.stl: the largest of %d clusters, %d of %d grains", n_cluster,
                       body->n_grain, n_all);
        note(monitor, text);
    }
}

/// What a manifest says of a run under way becomes what it says of a whole one: earlier versions
/// left it so when they were ended within the body.
static void set_done(char *manifest)
{
    static const char running[] = "\"outcome\": \"running\"";
    static const char done[] = "\"outcome\": \"done\"";
    static const char *const passing[] = {"\n  \"process\": ", "\n  \"progress\": "};
    char *at = strstr(manifest, running);
    if (at == NULL) {
        return;
    }
    memcpy(at, done, sizeof done - 1);
    memmove(at + sizeof done - 1, at + sizeof running - 1, strlen(at + sizeof running - 1) + 1);
    for (size_t k = 0; k < sizeof passing / sizeof *passing; ++k) {
        char *line = strstr(manifest, passing[k]);
        const char *next = line != NULL ? strchr(line + 1, '\n') : NULL;
        if (next != NULL) {
            memmove(line, next, strlen(next) + 1);
        }
    }
}

clast_status clx_folder_list_printable(const char *folder)
{
    enum { LIMIT = 64 << 20 };
    static const char key[] = "\"outputs\": [";
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char *text = NULL;
    int64_t n = 0;
    clx_file file = {0};
    CLX_TRY(clx_path_join(path, folder, "manifest.json"));
    CLX_TRY(clx_file_read_all(path, LIMIT, &text, &n));
    set_done(text);
    const char *list = strstr(text, key);
    const char *end = list != NULL ? strchr(list, ']') : NULL;
    const char *at = end != NULL ? list + sizeof key - 1 : text;
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_file_write(&file, text, (size_t)(at - text)));
    for (int k = 0; k < N_FILE && end != NULL; ++k) {
        const char *listed = strstr(at, FILES[k]);
        if (listed == NULL || listed > end) {
            CLX_TRY(clx_file_print(&file, "\"%s\", ", FILES[k]));
        }
    }
    CLX_TRY(clx_file_write(&file, at, strlen(at)));
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    clx_free(text);
    return status;
}

/// The state of a whole aggregation.
static clast_status read_whole(const char *folder, clast_state *state)
{
    clast_status status = CLAST_OK;
    clx_run_state run = {0};
    CLX_TRY(clast_run_folder_check(folder));
    CLX_TRY(clx_run_state_read(folder, &run));
    CLX_CHECK(run.has_state && (run.command[0] == '\0' || strcmp(run.command, "aggregate") == 0),
              CLAST_E_USAGE, "%s is a run of clast %s, not of aggregate", folder, run.command);
    CLX_TRY(clx_folder_read_state(folder, 0, state));
done:
    clx_run_state_free(&run);
    return status;
}

/// A body that cannot be made is what it is at the end of a run: no fault of what was read.
static clast_status as_of_run(clast_status status)
{
    return status == CLAST_E_GEOMETRY ? CLAST_E_CONVERGE : status;
}

clast_status clast_aggregate_make_printable(const char *folder,
                                            const clast_printable_config *config,
                                            const clast_monitor *monitor,
                                            clast_printable_report *report)
{
    CLX_ARGUMENTS(folder, config);
    clast_status status = CLAST_OK;
    clast_state state = {0};
    clast_assembly largest = {0};
    clast_printable_report made = {0};
    int32_t n_cluster = 1;
    CLX_TRY(clx_aggregate_check_printable(
        &(clast_aggregate_config){.printable = true,
                                  .neck = config->neck,
                                  .spacing = config->spacing,
                                  .params = {.mode = CLAST_AGGREGATE_CORE}}));
    CLX_TRY(read_whole(folder, &state));
    const clast_assembly *all = state.assembly;
    CLX_CHECK(all != NULL, CLAST_E_FORMAT, "%s/state.h5 holds no grains", folder);
    const clast_table *members = clast_state_table(&state, "members");
    if (members != NULL) {
        CLX_TRY(clx_folder_largest(all, members, &largest, &n_cluster));
    }
    const clast_assembly *body = n_cluster > 1 ? &largest : all;
    clx_folder_note_largest(monitor, body, all->n_grain, n_cluster);
    CLX_TRY(as_of_run(clx_folder_write_printable(folder, body, config, monitor, &made)));
    CLX_TRY(clx_folder_list_printable(folder));
    CLX_TRY(clast_report_write_run(folder, NULL));
    if (report != NULL) {
        *report = made;
    }
done:
    clast_assembly_free(&largest);
    clast_state_free(&state);
    return status;
}
