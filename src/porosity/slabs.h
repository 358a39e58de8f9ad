#pragma once
#include <clast/porosity.h>

/// clast_porosity_grain_slabs of an assembly that holds together: for each grain of it in turn.
clast_status clx_grain_slabs(const clast_assembly *assembly, int32_t i,
                             clast_porosity_method method, int32_t n, const double *edge,
                             double *solid);

/// Adds the volume of a closed mesh between edge[k] and edge[k + 1] to solid[k].
void clx_mesh_slabs(const clast_mesh *mesh, int32_t n, const double *edge, double *solid);

/// Share of each grain's solid that lies beyond the sides of a bed, by even points [n_grain].
clast_status clx_bed_shares_beyond(const clast_bed *bed, const clast_assembly *assembly,
                                   clast_porosity_method method, double *share);

/// Solid that a periodic bed's images cover of grains as they lie, less what these cover of each
/// other, and how many grains have an image in them (clast_bed_beyond_measure).
clast_status clx_images_measure(const clast_bed *bed, const clast_assembly *assembly,
                                clast_bed_beyond *beyond);

/// First slice whose upper edge lies above z, of n between rising edges [n + 1]; n when none does.
int32_t clx_slice_of(int32_t n, const double *edge, double z);

/// Where the lowest slice of a bed begins: what dips into the floor by less than a slice counts to
/// it, what lies below (a hopper's grains) to none.
double clx_lowest_edge(const clast_assembly *assembly, const clast_bed *bed,
                       const clast_porosity_options *options);
