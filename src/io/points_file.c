// Points from files: which format, then its reader.
#include "io/points.h"

#include "base/alloc.h"
#include "base/file.h"
#include <clast/cloud.h>
#include <clast/table.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define BYTE_LIMIT (INT64_C(16) << 30)
enum { LOOK = 1024 };

static bool begins(const void *bytes, size_t n, const char *mark)
{
    return n >= strlen(mark) && memcmp(bytes, mark, strlen(mark)) == 0;
}

/// The first word, with nothing else on its line.
static bool is_word(const char *bytes, size_t n, const char *mark)
{
    return n > strlen(mark) && begins(bytes, n, mark) &&
           strchr("\r\n", bytes[strlen(mark)]) != NULL;
}

/// The mark among the first bytes.
static bool has(const char *bytes, size_t n, const char *mark)
{
    const size_t last = n < LOOK ? n : LOOK;
    for (size_t i = 0; i + strlen(mark) <= last; ++i) {
        if (begins(bytes + i, last - i, mark)) {
            return true;
        }
    }
    return false;
}

static bool is_vtk_xml(const char *bytes, size_t n)
{
    return has(bytes, n, "<VTKFile");
}

clast_status clx_points_check_kind(const char *name, const char *bytes, size_t n)
{
    clast_status status = CLAST_OK;
    const bool is_ensight = begins(bytes, n, "C Binary") || begins(bytes, n, "Fortran Binary") ||
                            (has(bytes, n, "FORMAT") && has(bytes, n, "ensight"));
    CLX_CHECK(!is_ensight && !has(bytes, n, "FoamFile"), CLAST_E_FORMAT,
              "%s is a file of %s, which is not read: save its points as .vtp, .vtu or .csv "
              "(ParaView), or write a table x,y,z,... from the solver",
              name, is_ensight ? "EnSight" : "OpenFOAM");
done:
    return status;
}

bool clx_points_is_text(const char *bytes, size_t n)
{
    return !begins(bytes, n, "\x89HDF") && !begins(bytes, n, "# vtk DataFile") &&
           !begins(bytes, n, "ITEM:") && !is_vtk_xml(bytes, n) && !is_word(bytes, n, "ply") &&
           !clx_points_is_xyz(bytes, n);
}

clast_status clx_points_check_options(const char *name, const clast_points_options *options,
                                      bool has_frames, bool is_h5)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(options == NULL || options->frame == 0 || has_frames, CLAST_E_USAGE,
              "frame %lld: snapshots are those of a LAMMPS dump or .xyz, and %s is none",
              (long long)options->frame, name);
    CLX_CHECK(options == NULL || options->dataset == NULL || options->dataset[0] == '\0' || is_h5,
              CLAST_E_USAGE, "dataset %s: arrays are those of an HDF5 file, and %s is none",
              options->dataset, name);
done:
    return status;
}

static void tell_snapshot(const clast_points_options *options,
                          const clast_points_snapshot *snapshot)
{
    if (options != NULL && options->snapshot != NULL) {
        *options->snapshot = *snapshot;
    }
}

static const clast_points_snapshot only = {1, 1, -1};

clast_status clx_xyz_frame(const char *name, const char *bytes, int64_t n, int64_t frame,
                           clx_xyz_rows *found, clast_points_snapshot *snapshot)
{
    clast_status status = CLAST_OK;
    *found = (clx_xyz_rows){0, 0, 0, n};
    const int64_t n_snapshot = clx_xyz_find(bytes, n, INT64_MAX - 1, found);
    const int64_t k = frame < 0 ? n_snapshot + frame : frame;
    CLX_CHECK(k >= 0 && k < n_snapshot, CLAST_E_FORMAT,
              "%s: there is no snapshot %" PRId64 " among %" PRId64, name, frame, n_snapshot);
    (void)clx_xyz_find(bytes, n, k, found);
    *snapshot = (clast_points_snapshot){k + 1, n_snapshot, -1};
done:
    return status;
}

/// The wanted snapshot of a dump or XYZ.
static clast_status parse_frame(const char *name, const void *bytes, size_t n, bool is_dump,
                                const clast_points_options *options, clast_table *table)
{
    const int64_t frame = options != NULL ? options->frame : 0;
    clast_points_snapshot snapshot;
    clx_xyz_rows found;
    if (is_dump) {
        CLX_GUARD(clx_points_dump(name, bytes, n, frame, table, &snapshot));
    } else {
        CLX_GUARD(clx_xyz_frame(name, bytes, (int64_t)n, frame, &found, &snapshot));
        CLX_GUARD(clx_points_xyz(name, (const char *)bytes + found.count,
                                 (size_t)(found.end - found.count), table));
    }
    tell_snapshot(options, &snapshot);
    return CLAST_OK;
}

clast_status clx_points_parse(const char *name, const void *bytes, size_t n,
                              const clast_points_options *options, clast_table *table,
                              bool *has_faces)
{
    const bool is_dump = begins(bytes, n, "ITEM:");
    const bool has_frames = is_dump || clx_points_is_xyz(bytes, n);
    CLX_GUARD(clx_points_check_options(name, options, has_frames, false));
    if (has_frames) {
        return parse_frame(name, bytes, n, is_dump, options, table);
    }
    tell_snapshot(options, &only);
    if (begins(bytes, n, "# vtk DataFile")) {
        return clx_points_vtk(name, bytes, n, table, has_faces);
    }
    if (is_vtk_xml(bytes, n)) {
        return clx_points_vtx(name, bytes, n, table, has_faces);
    }
    if (is_word(bytes, n, "ply")) {
        return clx_points_ply(name, bytes, n, table, has_faces);
    }
    CLX_GUARD(clx_points_check_kind(name, bytes, n));
    return clast_table_parse_csv(name, bytes, n, NULL, table, NULL);
}

/// Vertices of a surface are no particles: a body of a frame has 42 of them.
static clast_status refuse_faces(const char *name, clast_table *table)
{
    clast_table_free(table);
    return clx_fail(CLAST_E_FORMAT,
                    "%s: faces join its points, so they are no particles but vertices of surfaces; "
                    "take the table of the bodies (particles.csv, deposit.csv), or write the "
                    "points alone",
                    name);
}

clast_status clast_cloud_parse(const char *name, const void *bytes, size_t n,
                               const clast_points_options *options, clast_table *table)
{
    CLX_ARGUMENTS(name, table);
    CLX_ARRAY(bytes, n);
    bool has_faces = false;
    const clast_status status = clx_points_parse(name, bytes, n, options, table, &has_faces);
    return status == CLAST_OK && has_faces ? refuse_faces(name, table) : status;
}

clast_status clast_cloud_read(const char *path, const clast_points_options *options,
                              clast_table *table)
{
    CLX_ARGUMENTS(path, table);
    bool has_faces = false;
    const clast_status status = clx_points_read(path, options, table, &has_faces);
    return status == CLAST_OK && has_faces ? refuse_faces(path, table) : status;
}

clast_status clx_points_read(const char *path, const clast_points_options *options,
                             clast_table *table, bool *has_faces)
{
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    int64_t n = 0;
    CLX_TRY(clx_file_read_all(path, BYTE_LIMIT, &bytes, &n));
    if (begins(bytes, (size_t)n, "\x89HDF")) {
        clx_free(bytes);
        bytes = NULL;
        CLX_TRY(clx_points_check_options(path, options, false, true));
        tell_snapshot(options, &only);
        CLX_TRY(clx_points_h5(path, options != NULL ? options->dataset : NULL, NULL, table));
    } else {
        CLX_TRY(clx_points_parse(path, bytes, (size_t)n, options, table, has_faces));
    }
done:
    clx_free(bytes);
    return status;
}
