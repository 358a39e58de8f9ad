#pragma once
#include <clast/porosity.h>

/// clast_porosity_grain_slabs of an assembly that holds together: for each grain of it in turn.
clast_status clx_grain_slabs(const clast_assembly *assembly, int32_t i,
                             clast_porosity_method method, int32_t n, const double *edge,
                             double *solid);

/// Adds the volume of a closed mesh between edge[k] and edge[k + 1] to solid[k].
void clx_mesh_slabs(const clast_mesh *mesh, int32_t n, const double *edge, double *solid);

/// First slice whose upper edge lies above z, of n between rising edges [n + 1]; n when none does.
int32_t clx_slice_of(int32_t n, const double *edge, double z);

/// Where the lowest slice of a bed begins: what dips into the floor by less than a slice counts to
/// it, what lies below (a hopper's grains) to none.
double clx_lowest_edge(const clast_assembly *assembly, const clast_bed *bed,
                       const clast_porosity_options *options);
