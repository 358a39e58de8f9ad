// A mesh that grows while a file is read.
#include "io/mesh_build.h"

#include "base/alloc.h"
#include "io/mesh_io.h"
#include <string.h>

clast_status clx_build_reserve(clx_mesh_build *b, int64_t n_vert, int64_t n_tri)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(n_vert <= INT32_MAX && n_tri <= INT32_MAX, CLAST_E_LIMIT,
              "%lld vertices and %lld faces are beyond the 2^31 of one mesh", (long long)n_vert,
              (long long)n_tri);
    CLX_TRY(clx_grow(&b->mesh.vert, &b->vert_capacity, n_vert, sizeof *b->mesh.vert));
    CLX_TRY(clx_grow(&b->mesh.tri, &b->tri_capacity, n_tri, sizeof *b->mesh.tri));
done:
    return status;
}

clast_status clx_build_vertex(clx_mesh_build *b, const double point[3])
{
    clast_status status = CLAST_OK;
    CLX_CHECK(b->mesh.n_vert < INT32_MAX, CLAST_E_LIMIT, "more than 2^31 vertices");
    CLX_TRY(clx_grow(&b->mesh.vert, &b->vert_capacity, (int64_t)b->mesh.n_vert + 1,
                     sizeof *b->mesh.vert));
    memcpy(b->mesh.vert[b->mesh.n_vert++], point, sizeof *b->mesh.vert);
done:
    return status;
}

clast_status clx_build_corner(clx_mesh_build *b, int64_t index)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(b->n_corner < INT32_MAX, CLAST_E_LIMIT, "more than 2^31 corners in one face");
    CLX_TRY(clx_grow(&b->corner, &b->corner_capacity, b->n_corner + 1, sizeof *b->corner));
    b->corner[b->n_corner++] = (int32_t)index;
done:
    return status;
}

clast_status clx_build_triangle(clx_mesh_build *b, const uint32_t corner[3])
{
    clast_status status = CLAST_OK;
    CLX_CHECK(b->mesh.n_tri < INT32_MAX, CLAST_E_LIMIT, "more than 2^31 triangles");
    CLX_TRY(
        clx_grow(&b->mesh.tri, &b->tri_capacity, (int64_t)b->mesh.n_tri + 1, sizeof *b->mesh.tri));
    memcpy(b->mesh.tri[b->mesh.n_tri++], corner, sizeof *b->mesh.tri);
    ++b->report->n_facet;
done:
    return status;
}

/// Corners equal to the one before (the first follows the last) go; triangles stay as they are.
static void drop_repeated(clx_mesh_build *b)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < b->n_corner; ++i) {
        const int32_t before = b->corner[i > 0 ? i - 1 : b->n_corner - 1];
        if (i == 0 || b->corner[i] != before) {
            b->corner[kept++] = b->corner[i];
        }
    }
    while (kept > 1 && b->corner[kept - 1] == b->corner[0]) {
        --kept;
    }
    b->report->n_repeated += (int32_t)(b->n_corner - kept);
    b->n_corner = kept;
}

static clast_status cut(clx_mesh_build *b)
{
    clast_status status = CLAST_OK;
    clx_polygon_kind kind = CLX_POLYGON_FAN;
    const int64_t n_tri = (int64_t)b->mesh.n_tri + b->n_corner - 2;
    CLX_CHECK(n_tri <= INT32_MAX, CLAST_E_LIMIT, "more than 2^31 triangles");
    CLX_TRY(clx_grow(&b->mesh.tri, &b->tri_capacity, n_tri, sizeof *b->mesh.tri));
    CLX_TRY(clx_polygon_cut(&b->cutter, (const double(*)[3])b->mesh.vert, (int32_t)b->n_corner,
                            b->corner, b->mesh.tri + b->mesh.n_tri, &kind));
    b->mesh.n_tri = (int32_t)n_tri;
    b->report->n_polygon += b->n_corner > 3;
    b->report->n_concave += kind != CLX_POLYGON_FAN;
    b->report->n_crossing += kind == CLX_POLYGON_CROSSING;
done:
    return status;
}

clast_status clx_build_polygon(clx_mesh_build *b)
{
    clast_status status = CLAST_OK;
    ++b->report->n_facet;
    if (b->n_corner > 3) {
        drop_repeated(b);
    }
    if (b->n_corner < 3) {
        ++b->report->n_short;
    } else {
        status = cut(b);
    }
    b->n_corner = 0;
    return status;
}

static void warn(clast_mesh_read_report *r)
{
    if (r->n_short > 0) {
        clx_report_warn(r, "%d of %lld faces have fewer than three corners; dropped", r->n_short,
                        (long long)r->n_facet);
    }
    if (r->n_crossing > 0) {
        clx_report_warn(r, "%d of %lld faces cross themselves; their triangles overlap",
                        r->n_crossing, (long long)r->n_facet);
    }
    if (r->n_repeated > 0) {
        clx_report_warn(r, "%d corners of polygons repeat the one before; dropped", r->n_repeated);
    }
    if (r->n_trailing > 0) {
        clx_report_warn(r, "%lld bytes after the end of the data ignored",
                        (long long)r->n_trailing);
    }
}

clast_status clx_build_finish(clx_mesh_build *b, clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_realloc(&b->mesh.vert, b->mesh.n_vert, sizeof *b->mesh.vert));
    CLX_TRY(clx_realloc(&b->mesh.tri, b->mesh.n_tri, sizeof *b->mesh.tri));
    *mesh = b->mesh;
    b->mesh = (clast_mesh){0};
    warn(b->report);
done:
    return status;
}

void clx_build_free(clx_mesh_build *b)
{
    clast_mesh_free(&b->mesh);
    clx_free(b->corner);
    clx_polygon_cutter_free(&b->cutter);
    *b = (clx_mesh_build){0};
}
