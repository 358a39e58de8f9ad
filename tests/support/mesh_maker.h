#pragma once
// Small meshes with known faults, and the data files by name.
#include "support.h"

/// Mesh of these arrays.
void mesh_of(const double (*vert)[3], int32_t n_vert, const int32_t (*tri)[3], int32_t n_tri,
             clast_mesh *mesh);

/// Turns one triangle over.
void mesh_flip(clast_mesh *mesh, int32_t t);

/// Turns all triangles over.
void mesh_flip_all(clast_mesh *mesh);

/// Drops one triangle.
void mesh_drop(clast_mesh *mesh, int32_t t);

/// Appends triangles of the mesh's own vertices.
void mesh_add_triangles(clast_mesh *mesh, const int32_t (*tri)[3], int32_t n_tri);

/// Appends a box of these edges with its low corner at (x, y, z).
void mesh_add_box(clast_mesh *mesh, double edge, double x, double y, double z);

/// Gives every triangle its own three vertices.
void mesh_explode(const clast_mesh *mesh, clast_mesh *exploded);

/// Turns the mesh by the quaternion and moves it, to leave the axes.
void mesh_tilt(clast_mesh *mesh);

/// Reads data/NAME, or ../shared/data/NAME where it is not shipped; false (said loudly) when
/// neither is there.
bool mesh_read_data(const char *name, clast_mesh *mesh);
