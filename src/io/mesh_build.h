#pragma once
// A mesh that grows while a file is read: vertices, then polygons that are cut as they come.
#include <clast/mesh.h>

#include "geom/polygon.h"

typedef struct clx_mesh_build {
    clast_mesh mesh;
    int64_t vert_capacity, tri_capacity;
    int32_t *corner; ///< of the polygon in the making
    int64_t n_corner, corner_capacity;
    clx_polygon_cutter cutter;
    clast_mesh_read_report *report; ///< borrowed
} clx_mesh_build;

clast_status clx_build_vertex(clx_mesh_build *build, const double point[3]);

/// Adds a corner (a vertex number that the caller has checked) to the polygon in the making.
clast_status clx_build_corner(clx_mesh_build *build, int64_t index);

/// Ends the polygon: cuts it into triangles, counts it in the report.
clast_status clx_build_polygon(clx_mesh_build *build);

/// Adds a triangle of vertex numbers that the caller has checked, as a polygon of three corners.
clast_status clx_build_triangle(clx_mesh_build *build, const uint32_t corner[3]);

/// Room for what the file promises; the caller has held the counts against its size.
clast_status clx_build_reserve(clx_mesh_build *build, int64_t n_vert, int64_t n_tri);

/// Hands the arrays over, cut to size, and words the findings as warnings.
clast_status clx_build_finish(clx_mesh_build *build, clast_mesh *mesh);

void clx_build_free(clx_mesh_build *build);
