#pragma once
// The surfaces of an assembly's grains, one at a time.
#include <clast/assembly.h>
#include <clast/mesh.h>

typedef struct clx_parts {
    const clast_assembly *assembly; ///< borrowed
    clast_mesh *surface;            ///< [n_shape] in the shape's frame
    double (*vert)[3];              ///< [most vertices of a shape] of the grain at hand
    int64_t n_vert, n_tri;          ///< of all grains
    double factor;                  ///< written lengths per length of the assembly
} clx_parts;

/// Makes every used shape's surface once. `parts` must be {0}.
clast_status clx_parts_make(const clast_assembly *assembly, int level, clx_parts *parts);
void clx_parts_free(clx_parts *parts);

/// Grain i in world coordinates; the mesh borrows and lasts until the next call.
clast_mesh clx_parts_place(clx_parts *parts, int32_t i);
