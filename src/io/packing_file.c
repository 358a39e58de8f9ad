// Packings from other programs' files.
#include <clast/state.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include "base/status.h"
#include "io/packing.h"
#include "io/points.h"
#include "io/text.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/cloud.h>
#include <clast/field.h>
#include <clast/table.h>
#include <stdio.h>
#include <string.h>

#define BYTE_LIMIT (INT64_C(16) << 30)

/// The rows of the wanted snapshot as a table without names.
static clast_status parse_xyz(const char *path, const char *bytes, int64_t n,
                              const clx_packing_wanted *wanted, clast_packing_report *report,
                              clast_table *table)
{
    static const clast_csv_options atoms = {.separator = ' ', .no_comment = true, .header = -1};
    clast_status status = CLAST_OK;
    clx_xyz_rows found;
    clast_points_snapshot snapshot;
    CLX_TRY(clx_xyz_frame(path, bytes, n, wanted->frame, &found, &snapshot));
    if (!wanted->is_old) {
        clx_xyz_lattice(bytes + found.comment, (size_t)(found.begin - found.comment),
                        &report->frame);
    }
    report->snapshot = snapshot.number;
    report->n_snapshot = snapshot.n;
    if (!wanted->is_old &&
        clx_xyz_has_properties(bytes + found.comment, (size_t)(found.begin - found.comment))) {
        return clx_points_xyz(path, bytes + found.count, (size_t)(found.end - found.count), table);
    }
    CLX_TRY(clast_table_parse_csv(path, bytes + found.begin, (size_t)(found.end - found.begin),
                                  &atoms, table, NULL));
done:
    return status;
}

static clast_status parse_dump(const char *path, const char *bytes, int64_t n,
                               const clx_packing_wanted *wanted, clx_packing_told *told,
                               clast_table *table)
{
    clast_status status = CLAST_OK;
    clx_dump_head head = {0};
    clast_packing_frame *frame = &told->report.frame;
    CLX_TRY(clx_dump_read(path, bytes, (size_t)n, wanted->frame, table, &head));
    told->report.snapshot = head.snapshot + 1;
    told->report.n_snapshot = head.n_snapshot;
    told->units = wanted->is_old ? NULL : clx_lammps_units_of(head.units);
    frame->step = head.step;
    for (int k = 0; k < 3; ++k) {
        frame->has_box[k] = head.has_box;
        frame->is_periodic[k] = head.is_periodic[k];
        frame->low[k] = head.low[k];
        frame->high[k] = head.high[k];
        frame->tilt[k] = head.tilt[k];
    }
done:
    return status;
}

/// Whether the format knows one packing a file.
static clast_status refuse_frame(const char *path, const clx_packing_wanted *wanted)
{
    const char *prefix = wanted->spheres.prefix != NULL ? wanted->spheres.prefix : "";
    return !wanted->has_frame
               ? CLAST_OK
               : clx_fail(CLAST_E_CONFIG,
                          "%sframe %lld: snapshots are those of a LAMMPS dump or .xyz, and %s is "
                          "none",
                          prefix, (long long)wanted->frame, path);
}

static clast_status parse(const char *path, const char *bytes, int64_t n,
                          const clx_packing_wanted *wanted, clx_packing_told *told,
                          clast_table *table)
{
    clx_xyz_rows found;
    if (n > 5 && memcmp(bytes, "ITEM:", 5) == 0) {
        return parse_dump(path, bytes, n, wanted, told, table);
    }
    if (clx_path_is(path, "xyz") && clx_xyz_find(bytes, n, 0, &found) > 0) {
        return parse_xyz(path, bytes, n, wanted, &told->report, table);
    }
    CLX_GUARD(refuse_frame(path, wanted));
    if (clx_path_is(path, "xyzd")) {
        return clx_xyzd(path, bytes, n, table);
    }
    return clx_is_lammps_data(bytes, (size_t)n)
               ? clx_lammps_data(path, bytes, (size_t)n, table, &told->report.frame)
               : clast_cloud_parse(path, bytes, (size_t)n, NULL, table);
}

/// Metres in a length of the file, as it says them or who asks does; 0: not known.
static clast_status find_metre(const clx_packing_wanted *wanted, const clx_packing_told *told,
                               double *metre)
{
    clast_status status = CLAST_OK;
    *metre = told->units != NULL ? told->units->metre : 0.0;
    if (told->units == NULL && wanted->unit != NULL && wanted->unit[0] != '\0') {
        CLX_TRY(clast_unit_factor(wanted->unit, "m", metre));
    }
done:
    return status;
}

/// Places, scales and the box in metres, unless the columns have told theirs already.
static void to_metres(double metre, clast_assembly *a, clast_packing_frame *frame)
{
    if (metre <= 0.0 || strcmp(a->unit, "model") != 0) {
        return;
    }
    (void)snprintf(a->unit, sizeof a->unit, "m");
    for (int32_t i = 0; i < a->n_grain; ++i) {
        a->scale[i] *= metre;
        v3_scale(a->position[i], metre, a->position[i]);
    }
    v3_scale(frame->low, metre, frame->low);
    v3_scale(frame->high, metre, frame->high);
    v3_scale(frame->tilt, metre, frame->tilt);
}

/// A table of grains; its columns are the options', or those that YADE names.
static clast_status read_table(const char *path, const char *bytes, int64_t n,
                               const clx_packing_wanted *wanted, clast_assembly *assembly,
                               clx_packing_told *told)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    clx_packing_wanted own = *wanted;
    clast_packing_options *o = &own.spheres.options;
    double metre = 0.0;
    char columns[CLX_YADE_COLUMNS];
    const bool is_lammps =
        clx_is_lammps_data(bytes, (size_t)n) || (n > 5 && memcmp(bytes, "ITEM:", 5) == 0);
    if ((o->columns == NULL || o->columns[0] == '\0') &&
        clx_yade_columns(bytes, (size_t)n, columns)) {
        o->columns = columns;
        own.spheres.takes_few = true;
    }
    CLX_TRY(parse(path, bytes, n, wanted, told, &table));
    CLX_TRY(find_metre(wanted, told, &metre));
    own.spheres.metre = wanted->is_old ? 0.0 : metre;
    own.spheres.takes_few = own.spheres.takes_few || wanted->is_old;
    CLX_TRY(clx_packing_of_table(&table, &own.spheres, is_lammps, assembly, told->unit));
    to_metres(metre, assembly, &told->report.frame);
    if (clx_yade_clump_column(o->columns) < 0) {
        CLX_TRY(wanted->is_old ? CLAST_OK
                               : clx_packing_ids(&table, &own.spheres, is_lammps, assembly));
        CLX_TRY(clx_packing_densities(&table, &own, is_lammps, told->units, assembly));
    } else {
        assembly->no_density = true;
    }
done:
    if (status != CLAST_OK && table.n_column > 0) { // the readers name the file themselves
        clx_fail_prefix("%s", path);
    }
    clast_table_free(&table);
    return status;
}

/// A file that stands beside another one, unless its name begins at the root.
static clast_status beside(const char *path, const char *name, char out[8192])
{
    const char *slash = strrchr(path, '/');
    const int folder = name[0] == '/' || slash == NULL ? 0 : (int)(slash - path) + 1;
    const int n = snprintf(out, 8192, "%.*s%s", folder, path, name);
    return n > 0 && n < 8192
               ? CLAST_OK
               : clx_fail(CLAST_E_USAGE, "%s: the path of its shapes is too long", path);
}

static clast_status read_rockable(const char *path, const char *bytes, int64_t n,
                                  const clx_packing_wanted *wanted, clast_assembly *assembly,
                                  clx_packing_told *told)
{
    clast_status status = CLAST_OK;
    double metre = 0.0;
    clx_rockable_files files = {.name = path, .bytes = bytes, .n = (size_t)n};
    char place[8192];
    char *shapes = NULL;
    int64_t n_shape = 0;
    CLX_TRY(refuse_frame(path, wanted));
    CLX_TRY(clx_rockable_library(&files));
    CLX_TRY(beside(path, files.library, place));
    CLX_TRY(clx_file_read_all(place, BYTE_LIMIT, &shapes, &n_shape));
    files.shapes = shapes;
    files.n_shape = (size_t)n_shape;
    CLX_TRY(clx_rockable(&files, assembly));
    CLX_TRY(find_metre(wanted, told, &metre));
    to_metres(metre, assembly, &told->report.frame);
done:
    clx_free(shapes);
    return status;
}

clast_status clx_packing_read(const char *path, const clx_packing_wanted *wanted,
                              clast_assembly *assembly, clx_packing_told *told)
{
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    int64_t n = 0;
    clast_assembly made = {0};
    *told = (clx_packing_told){.report = {.snapshot = 1, .n_snapshot = 1, .frame = {.step = -1}}};
    CLX_TRY(clx_file_read_all(path, BYTE_LIMIT, &bytes, &n));
    CLX_TRY(clx_path_is(path, "conf") ? read_rockable(path, bytes, n, wanted, &made, told)
                                      : read_table(path, bytes, n, wanted, &made, told));
    *assembly = made;
    made = (clast_assembly){0};
done:
    clx_free(bytes);
    clast_assembly_free(&made);
    return status;
}

clast_status clast_packing_read(const char *path, const clast_packing_options *options,
                                clast_assembly *assembly, clast_packing_report *report)
{
    CLX_ARGUMENTS(path, assembly);
    clast_status status = CLAST_OK;
    const clx_packing_wanted wanted = {
        .spheres = {.options = options != NULL ? *options : (clast_packing_options){0},
                    .prefix = "--"},
        .frame = -1};
    clx_packing_told told;
    CLX_TRY(clx_packing_read(path, &wanted, assembly, &told));
    if (report != NULL) {
        *report = told.report;
    }
done:
    return status;
}
