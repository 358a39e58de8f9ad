// Binary STL from surfaces.
//
// The format keeps 24 bits of a coordinate. Facets are judged as they are written: normals are
// those of the rounded corners, and a facet of which rounding makes two corners one is left out.
#include "io/mesh_io.h"

#include "base/file.h"
#include "base/status.h"
#include "io/bytes.h"
#include "math/vec3.h"
#include <stdio.h>
#include <string.h>

enum { HEADER_SIZE = 80, BODY_START = 84, FACET_SIZE = 50 };

static void store_f32(uint8_t *p, double value)
{
    const float single = (float)value;
    uint32_t bits = 0;
    memcpy(&bits, &single, sizeof bits);
    clx_store_u32(p, bits);
}

static clast_status check_single(const clast_mesh *mesh)
{
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        for (int k = 0; k < 3; ++k) {
            if (!isfinite((float)mesh->vert[i][k])) {
                return clx_fail(CLAST_E_GEOMETRY,
                                "vertex %d: %c = %g does not fit the 32-bit numbers of STL; scale "
                                "it or write PLY",
                                i, "xyz"[k], mesh -> vert[i][k]);
            }
        }
    }
    return CLAST_OK;
}

/// The header must not begin with "solid", or naive readers take the file for text.
clast_status clx_stl_begin(const clast_mesh_write_options *options, uint32_t n, clx_file *file)
{
    char header[BODY_START] = {0};
    (void)snprintf(header, HEADER_SIZE, "clast %s binary STL, unit %.15s%s%.30s", clast_version(),
                   options->unit != NULL ? options->unit : "not stated",
                   options->name != NULL ? ", " : "", options->name != NULL ? options->name : "");
    clx_store_u32((uint8_t *)header + HEADER_SIZE, n);
    return clx_file_write(file, header, sizeof header);
}

/// Corners of a triangle as the file keeps them.
static void round_corners(const clast_mesh *mesh, int32_t t, double p[3][3])
{
    for (int k = 0; k < 9; ++k) {
        p[k / 3][k % 3] = (double)(float)mesh->vert[mesh->tri[t][k / 3]][k % 3];
    }
}

static bool is_same(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/// Whether rounding makes two corners one. Both triangles of such an edge go, so what was closed
/// stays closed.
static bool is_collapsed(const clast_mesh *mesh, int32_t t, double p[3][3])
{
    bool collapsed = false;
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        collapsed =
            collapsed || (is_same(p[k], p[next]) &&
                          !is_same(mesh->vert[mesh->tri[t][k]], mesh->vert[mesh->tri[t][next]]));
    }
    return collapsed;
}

/// The normal is that of the corners as written.
static void store_facet(double p[3][3], uint8_t out[FACET_SIZE])
{
    double u[3];
    double v[3];
    double n[3];
    v3_sub(u, p[1], p[0]);
    v3_sub(v, p[2], p[0]);
    v3_cross(n, u, v);
    (void)v3_unit(n, n);
    for (int k = 0; k < 3; ++k) {
        store_f32(out + 4 * (ptrdiff_t)k, n[k]);
        for (int c = 0; c < 3; ++c) {
            store_f32(out + 12 + 12 * (ptrdiff_t)k + 4 * (ptrdiff_t)c, p[k][c]);
        }
    }
}

int64_t clx_stl_count(const clast_mesh *mesh)
{
    int64_t n = 0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        double p[3][3];
        round_corners(mesh, t, p);
        n += !is_collapsed(mesh, t, p);
    }
    return n;
}

clast_status clx_stl_append(const clast_mesh *mesh, clx_file *file)
{
    clast_status status = CLAST_OK;
    uint8_t facet[FACET_SIZE] = {0};
    CLX_TRY(check_single(mesh));
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        double p[3][3];
        round_corners(mesh, t, p);
        if (!is_collapsed(mesh, t, p)) {
            store_facet(p, facet);
            CLX_TRY(clx_file_write(file, facet, sizeof facet));
        }
    }
done:
    return status;
}

clast_status clx_stl_write(const clast_mesh *mesh, const clast_mesh_write_options *options,
                           clx_file *file)
{
    clast_status status = CLAST_OK;
    CLX_TRY(check_single(mesh));
    const int64_t n = clx_stl_count(mesh);
    CLX_CHECK(n > 0 || mesh->n_tri == 0, CLAST_E_GEOMETRY,
              "all %d triangles have two corners that are one in the 24 bits of STL; scale the "
              "surface or write PLY",
              mesh->n_tri);
    CLX_TRY(clx_stl_begin(options, (uint32_t)n, file));
    CLX_TRY(clx_stl_append(mesh, file));
done:
    return status;
}
