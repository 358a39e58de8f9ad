// Points from files: which format, then its reader.
#include "io/points.h"

#include "base/alloc.h"
#include "base/file.h"
#include <clast/cloud.h>
#include <clast/table.h>
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
                                      bool is_dump, bool is_h5)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(options == NULL || options->frame == 0 || is_dump, CLAST_E_USAGE,
              "frame %lld: snapshots are those of a LAMMPS dump, and %s is none",
              (long long)options->frame, name);
    CLX_CHECK(options == NULL || options->dataset == NULL || options->dataset[0] == '\0' || is_h5,
              CLAST_E_USAGE, "dataset %s: arrays are those of an HDF5 file, and %s is none",
              options->dataset, name);
done:
    return status;
}

clast_status clx_points_parse(const char *name, const void *bytes, size_t n,
                              const clast_points_options *options, clast_table *table,
                              bool *has_faces)
{
    const bool is_dump = begins(bytes, n, "ITEM:");
    const clast_status status = clx_points_check_options(name, options, is_dump, false);
    if (status != CLAST_OK) {
        return status;
    }
    if (is_dump) {
        return clx_points_dump(name, bytes, n, options != NULL ? options->frame : 0, table);
    }
    if (begins(bytes, n, "# vtk DataFile")) {
        return clx_points_vtk(name, bytes, n, table, has_faces);
    }
    if (is_vtk_xml(bytes, n)) {
        return clx_points_vtx(name, bytes, n, table, has_faces);
    }
    if (is_word(bytes, n, "ply")) {
        return clx_points_ply(name, bytes, n, table, has_faces);
    }
    if (clx_points_is_xyz(bytes, n)) {
        return clx_points_xyz(name, bytes, n, table);
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
        CLX_TRY(clx_points_h5(path, options != NULL ? options->dataset : NULL, NULL, table));
    } else {
        CLX_TRY(clx_points_parse(path, bytes, (size_t)n, options, table, has_faces));
    }
done:
    clx_free(bytes);
    return status;
}
