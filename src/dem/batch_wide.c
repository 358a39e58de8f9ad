// Contacts eight at once, for machines that have AVX-512. The file is made for those from its first
// line on: nothing here may run elsewhere, and nothing else is in it.
#include "base/machine.h"
#include "base/status.h" // a file of other machines declares something, too

#if CLX_MAKES_WIDE
#pragma GCC target("arch=x86-64-v4")
#define CLX_WIDE 1
#include "dem/batch_wide.h"

#include "dem/batch_lanes.h"

void clx_wide_spheres(const clast_dem *dem, clx_batch *p)
{
    meet_spheres(dem, p, 0);
}

int clx_wide_faces(const clast_dem *dem, clx_batch *p)
{
    return meet_facets(dem, p, 0, false);
}

int clx_wide_edges(const clast_dem *dem, clx_batch *p)
{
    return meet_facets(dem, p, 0, true);
}

void clx_wide_force(const clast_dem *dem, const clx_batch *p, bool has_walls)
{
    batch_force(dem, p, has_walls);
}
#endif
