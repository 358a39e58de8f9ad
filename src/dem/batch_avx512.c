// Contacts in eight SIMD lanes, for machines with AVX-512. The whole file is compiled for those:
// nothing here may run elsewhere, and nothing else is in it.
#include "base/machine.h"
#include "base/status.h" // elsewhere the file would be empty, which ISO C forbids

#if CLX_MAKES_WIDE
#pragma GCC target("arch=x86-64-v4")
#define CLX_WIDE 1
#include "dem/batch_avx512.h"

#include "dem/batch_lanes.h"

void clx_avx512_spheres(const clast_dem *dem, clx_batch *p)
{
    contact_of_spheres(dem, p, 0);
}

int clx_avx512_faces(const clast_dem *dem, clx_batch *p)
{
    return contact_of_facets(dem, p, 0, false);
}

int clx_avx512_edges(const clast_dem *dem, clx_batch *p)
{
    return contact_of_facets(dem, p, 0, true);
}

void clx_avx512_force(const clast_dem *dem, const clx_batch *p, clx_batch_kind kind)
{
    batch_force(dem, p, kind);
}
#endif
