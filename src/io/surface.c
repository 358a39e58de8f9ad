// Surfaces that must bound a solid: one weld, one count, and the command that closes the file.
#include "base/alloc.h"
#include "base/path.h"
#include "base/status.h"
#include "geom/check.h"
#include "geom/whole.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <stdio.h>
#include <string.h>

clast_status clast_mesh_read_welded(const char *path, clast_mesh *mesh,
                                    clast_mesh_repair_report *weld)
{
    CLX_ARGUMENTS(path, mesh);
    clast_status status = CLAST_OK;
    clast_mesh read = {0};
    clast_mesh made = {0};
    const clast_mesh_repair_config weld_only = {.weld = CLAST_WELD_AUTO};
    CLX_TRY(clast_mesh_read(path, &read, NULL));
    CLX_CHECK(read.n_tri > 0, CLAST_E_GEOMETRY, "%s has no triangles", path);
    status = clast_mesh_repair(&read, &weld_only, &made, weld);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", path);
        goto done;
    }
    *mesh = made;
done:
    clast_mesh_free(&read);
    return status;
}

/// A path as one word of a POSIX shell.
static void quote(const char *path, char *out, size_t size)
{
    static const char plain[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./+,:@%";
    const bool bare = path[0] != '\0' && strspn(path, plain) == strlen(path);
    size_t n = 0;
    if (!bare) {
        out[n++] = '\'';
    }
    for (; *path != '\0' && n + 6 < size; ++path) {
        n += (size_t)snprintf(out + n, size - n, *path == '\'' ? "'\\''" : "%c", *path);
    }
    (void)snprintf(out + n, size - n, "%s", bare ? "" : "'");
}

/// Whether the surface is a solid, in an STL too, which rounds and names vertices by their place.
static clast_status is_solid(const clast_mesh *mesh, bool in_stl, bool *solid)
{
    clast_status status = CLAST_OK;
    clast_mesh copy = {0};
    clast_mesh welded = {0};
    clast_mesh_check_result found = {0};
    CLX_TRY(clast_mesh_copy(mesh, &copy));
    if (in_stl) {
        for (int32_t i = 0; i < 3 * copy.n_vert; ++i) {
            copy.vert[i / 3][i % 3] = (double)(float)copy.vert[i / 3][i % 3];
        }
        CLX_TRY(clast_mesh_weld(&copy, 0.0, &welded, NULL));
    }
    CLX_TRY(clast_mesh_check(in_stl ? &welded : &copy, &found));
    *solid = clast_mesh_check_passed(&found);
done:
    clast_mesh_check_free(&found);
    clast_mesh_free(&welded);
    clast_mesh_free(&copy);
    return status;
}

/// STL when an STL was read and can keep the result, else PLY.
static clast_status choose_extension(const char *path, const clast_mesh *repaired,
                                     const clast_mesh_repair_report *report, const char **extension)
{
    bool solid = false;
    clast_status status = CLAST_OK;
    *extension = NULL;
    if (clx_path_is(path, "stl") && report->n_separated == 0) {
        CLX_TRY(is_solid(repaired, true, &solid));
        *extension = solid ? "stl" : NULL;
    }
    if (!solid) {
        CLX_TRY(is_solid(repaired, false, &solid));
        *extension = solid ? "ply" : NULL;
    }
done:
    return status;
}

clast_status clast_mesh_cure(const clast_mesh *mesh, const char *path, size_t size, char *command)
{
    CLX_ARGUMENTS(path, mesh, command);
    CLX_WHOLE(mesh, mesh);
    if (size == 0) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: a buffer of 0 bytes for a command", __func__);
    }
    enum { LONGEST = 4200 };
    clast_status status = CLAST_OK;
    clast_mesh repaired = {0};
    clast_mesh_repair_report report = {0};
    const char *extension = NULL;
    char from[LONGEST];
    char to[LONGEST];
    char name[LONGEST];
    command[0] = '\0';
    status = clast_mesh_repair(mesh, NULL, &repaired, &report);
    if (status == CLAST_E_GEOMETRY) { // nothing is left
        return CLAST_OK;
    }
    CLX_TRY(status);
    CLX_TRY(choose_extension(path, &repaired, &report, &extension));
    if (extension != NULL) {
        (void)snprintf(name, sizeof name, "%.*s-closed.%s", clx_path_stem_length(path),
                       clx_path_name(path), extension);
        quote(path, from, sizeof from);
        quote(name, to, sizeof to);
        (void)snprintf(command, size, "clast mesh repair %s -o %s", from, to);
    }
done:
    clast_mesh_free(&repaired);
    return status;
}

/// "76 open edges, 1 part inside out": what is there of these.
static void list_faults(const clast_mesh_check_result *found, int32_t n_flat, char *text,
                        size_t size)
{
    const struct {
        int32_t n;
        const char *one, *more;
    } fault[] = {{found->n_open_edge, "open edge", "open edges"},
                 {found->n_nonmanifold_edge, "edge of more than two triangles",
                  "edges of more than two triangles"},
                 {found->n_misoriented_edge, "edge between facets that face opposite ways",
                  "edges between facets that face opposite ways"},
                 {found->n_inside_out, "part inside out", "parts inside out"},
                 {n_flat, "part without volume", "parts without volume"}};
    size_t n = 0;
    text[0] = '\0';
    for (size_t i = 0; i < sizeof fault / sizeof fault[0] && n < size; ++i) {
        if (fault[i].n > 0) {
            n += (size_t)snprintf(text + n, size - n, "%s%d %s", n > 0 ? ", " : "", fault[i].n,
                                  fault[i].n == 1 ? fault[i].one : fault[i].more);
        }
    }
}

clast_status clast_mesh_require_unit(const char *path, const clast_mesh_read_report *report,
                                     const char *unit)
{
    CLX_ARGUMENTS(path, report);
    clast_status status = CLAST_OK;
    double own = 0.0;
    double asked = 0.0;
    if (report->unit[0] == '\0' || unit == NULL || unit[0] == '\0') {
        return CLAST_OK;
    }
    CLX_TRY(clast_unit_factor(report->unit, "m", &own));
    CLX_TRY(clast_unit_factor(unit, "m", &asked));
    CLX_CHECK(own == asked, CLAST_E_CONFIG,
              "%s says that it is in %s, not in %s: give %s, or no unit", path, report->unit, unit,
              report->unit);
done:
    return status;
}

clast_status clast_mesh_require_solid(const clast_mesh *mesh, const char *path,
                                      const char *otherwise)
{
    CLX_ARGUMENTS(path, mesh);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clast_mesh_check_result found = {0};
    char cure[400];
    char faults[200];
    CLX_TRY(clast_mesh_check(mesh, &found));
    const int32_t n_flat = found.n_flat;
    if (found.closed && found.oriented && n_flat == 0) {
        goto done;
    }
    CLX_CHECK(found.hull_volume > 0.0 || found.extent >= CLX_SMALLEST_EXTENT, CLAST_E_GEOMETRY,
              "%s: an extent of %.3g is too small for a volume; is the unit right?", path,
              found.extent);
    CLX_CHECK(found.hull_volume > 0.0, CLAST_E_GEOMETRY,
              "%s is flat: its %d vertices lie in one plane, and what has no thickness is no solid",
              path, found.n_vertex);
    list_faults(&found, n_flat, faults, sizeof faults);
    const char *aim = !found.closed     ? "close it: "
                      : !found.oriented ? "orient it outward: "
                                        : "drop what has no volume: ";
    CLX_TRY(clast_mesh_cure(mesh, path, sizeof cure, cure));
    status = clx_fail(CLAST_E_GEOMETRY, "%s is not a closed, outward surface: %s; %s%s%s%s", path,
                      faults, otherwise != NULL ? otherwise : "", otherwise != NULL ? ", or " : "",
                      cure[0] != '\0' ? aim : "draw it anew: clast mesh repair fails on it", cure);
done:
    clast_mesh_check_free(&found);
    return status;
}
