// The inside of a container's surface as a bed.
#include <clast/porosity.h>

#include "base/status.h"
#include "geom/check.h"
#include "geom/whole.h"
#include "porosity/slabs.h"
#include "porosity/whole.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>

clast_status clast_bed_close(const clast_mesh *container, clast_mesh *closed)
{
    CLX_ARGUMENTS(container, closed);
    CLX_WHOLE(mesh, container);
    clast_status status = CLAST_OK;
    clast_mesh made = {0};
    clast_mesh_check_result found = {0};
    clast_mesh_repair_config repair;
    CLX_TRY(clast_fields_default(clast_mesh_repair_fields, &repair));
    repair.fill = true;
    repair.fill_size = 1.0; // any hole
    CLX_TRY(clast_mesh_repair(container, &repair, &made, NULL));
    CLX_TRY(clx_check_without_cuts(&made, &found));
    CLX_CHECK(found.closed && found.oriented && found.volume > 0.0, CLAST_E_GEOMETRY,
              "the container encloses nothing: with its holes covered it %s; run clast mesh check",
              !found.closed     ? "is still open"
              : !found.oriented ? "has no inside and outside"
                                : "has no volume");
    *closed = made;
    made = (clast_mesh){0};
done:
    clast_mesh_check_free(&found);
    clast_mesh_free(&made);
    return status;
}

clast_bed clast_bed_of_surface(const clast_mesh *closed)
{
    if (clx_mesh_fault(closed) != NULL) {
        return (clast_bed){0};
    }
    double low[3];
    double high[3];
    clast_mesh_bounds(closed, low, high);
    return (clast_bed){.kind = CLAST_BED_MESH,
                       .low = {low[0], low[1]},
                       .high = {high[0], high[1]},
                       .floor = low[2],
                       .surface = closed};
}

void clast_bed_volumes(const clast_bed *bed, int32_t n, const double *edge, double *volume)
{
    if (clx_bed_fault(bed) != NULL || edge == NULL || volume == NULL) {
        return;
    }
    for (int32_t k = 0; k < n; ++k) {
        volume[k] =
            bed->kind == CLAST_BED_MESH ? 0.0 : clast_bed_area(bed) * (edge[k + 1] - edge[k]);
    }
    if (bed->kind == CLAST_BED_MESH) {
        clx_mesh_slabs(bed->surface, n, edge, volume);
    }
}
