// The printable body of a run: the last of its results, which is not needed for it to be whole, and
// which a whole run can have made later.
#include "study/aggregate_folder.h"

#include "aggregate/config.h"
#include "assembly/pieces.h"
#include "base/alloc.h"
#include "base/file.h"
#include "base/number.h"
#include "base/path.h"
#include "geom/check.h"
#include "run/run.h"
#include <clast/assembly.h>
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <clast/table.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char *const FILES[] = {"printable.3mf", "printable.stl", "printable.json"};
enum { N_FILE = sizeof FILES / sizeof FILES[0] };

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
    clx_free(cluster);
    clx_free(count);
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
static clast_status write_report(const char *folder, const clast_printable_report *r,
                                 int64_t n_triangle)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clx_file file = {0};
    CLX_TRY(clx_path_join(path, folder, "printable.json"));
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_file_print(&file,
                           "{\n  \"smallest_feature\": %.17g,\n  \"resolved\": %s,\n"
                           "  \"neck\": %.17g,\n  \"spacing\": %.17g,\n",
                           r->smallest_feature, r->resolved ? "true" : "false", r->neck,
                           r->spacing));
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
    (void)clx_number_print(text, sizeof text,
                           "printable.stl: about %.0f triangles, %.3g MB, at a spacing of %.3g %s "
                           "(--spacing)",
                           plan.n_triangle_expected, 50e-6 * plan.n_triangle_expected,
                           factor * plan.spacing, unit);
    note(monitor, text);
done:
    return status;
}

static void remove_files(const char *folder)
{
    char path[CLX_PATH_LIMIT];
    for (int k = 0; k < N_FILE; ++k) {
        if (clx_path_join(path, folder, FILES[k]) == CLAST_OK) {
            (void)unlink(path);
        }
    }
}

/// The files of a body, whose coordinates become millimetres; none of them stays when one cannot be
/// written, or is no printable surface.
static clast_status write_files(const char *folder, const clast_printable_report *report,
                                clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    const clast_mesh_write_options options = {.unit = "mm", .name = "printable"};
    const double none[3] = {0.0, 0.0, 0.0};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    clast_mesh_transform(mesh, 1e3, unturned, none);
    CLX_TRY(clx_path_join(path, folder, "printable.stl"));
    CLX_TRY(clast_mesh_write(mesh, path, &options));
    CLX_TRY(verify(path));
    CLX_TRY(clx_path_join(path, folder, "printable.3mf"));
    CLX_TRY(clast_mesh_write(mesh, path, &options));
    CLX_TRY(write_report(folder, report, mesh->n_tri));
done:
    if (status != CLAST_OK) {
        remove_files(folder);
    }
    return status;
}

static clast_status write_body(const char *folder, const clast_assembly *body,
                               const clast_printable_config *config, const clast_monitor *monitor,
                               clast_printable_report *report)
{
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    CLX_TRY(announce(body, config, monitor));
    CLX_TRY(clast_assembly_printable(body, config, monitor, &mesh, report));
    CLX_TRY(write_files(folder, report, &mesh));
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
/// is in pieces, the spacing of its own choice where the grid is too large; "" where none helps.
static void find_cure(const char *name, const clast_assembly *body,
                      const clast_printable_config *config, clast_status why, char text[512])
{
    clast_printable_report plan = {0};
    const bool is_pieces = why == CLAST_E_GEOMETRY;
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
    }
    (void)snprintf(text, 512, "; clast aggregate --resume %.300s --printable%s%s %s", name, neck,
                   spacing, why == CLAST_E_DISK ? "makes it" : "tries that");
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

clast_status clx_folder_write_printable(const clx_folder_place *place, const clast_assembly *body,
                                        const clast_printable_config *config,
                                        const clast_monitor *monitor,
                                        clast_printable_report *report)
{
    char why[1024];
    char cure[512] = "";
    const clast_status status = write_body(place->folder, body, config, monitor, report);
    if (status == CLAST_OK) {
        return CLAST_OK;
    }
    (void)snprintf(why, sizeof why, "%s", clast_error_detail());
    if (is_one_group(body)) {
        find_cure(place->name, body, config, status, cure);
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

/// Adds the body's files to the list of outputs, which tells whose they are when the run is
/// replaced. All else in the manifest is about the run itself and stays as it is. A manifest
/// without a list (of older versions) needs none.
static clast_status list_outputs(const char *folder)
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
    const char *at = strstr(text, key);
    const char *end = at != NULL ? strchr(at, ']') : NULL;
    if (end == NULL) {
        goto done;
    }
    at += sizeof key - 1;
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_file_write(&file, text, (size_t)(at - text)));
    for (int k = 0; k < N_FILE; ++k) {
        const char *listed = strstr(at, FILES[k]);
        if (listed == NULL || listed > end) {
            CLX_TRY(clx_file_print(&file, "\"%s\", ", FILES[k]));
        }
    }
    CLX_TRY(clx_file_write(&file, at, (size_t)(text + n - at)));
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
    const clx_folder_place place = {folder, folder};
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
    CLX_TRY(clx_folder_write_printable(&place, body, config, monitor, &made));
    CLX_TRY(list_outputs(folder));
    if (report != NULL) {
        *report = made;
    }
done:
    clast_assembly_free(&largest);
    clast_state_free(&state);
    return status;
}
