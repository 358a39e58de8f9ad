#pragma once
/* Plain twins of the caliper searches: every direction that can matter, every vertex. */
#include <clast/mesh.h>

/* Longest vertex distance and least width over all face normals and all cross products of two
 * edges: n^2 directions of n vertices each. */
void brute_caliper(const clast_mesh *hull, double *longest, double *shortest);
