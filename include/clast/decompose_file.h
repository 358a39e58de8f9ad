#pragma once
#include <clast/decompose.h>

CLAST_BEGIN

// A decomposition for ParaView.

/// Cells as an unstructured grid (VTU): lines, quadrilaterals or hexahedra with cell, count,
/// volume, density and events (pair_integral without beta dt), label and pass where cells have
/// them; unit, domain, volume, beta_dt and seed (of what was drawn) as field data. Cells that are
/// no boxes (components, labels) are written bin by bin; cells of mapped domains are cut at most
/// every 10 degrees.
///
/// @return CLAST_E_LIMIT beyond 2^31 corners; CLAST_E_DISK
CLAST_API clast_status clast_cells_write_vtu(const char *path, const clast_decomposition *result,
                                             const clast_domain *domain);

/// Points as polydata (VTP) with cell (label and pass) and the same field data, and radius, mass,
/// weight and velocity where the cloud has them; -1 and 0 for points left out.
CLAST_API clast_status clast_points_write_vtp(const char *path, const clast_cloud *cloud,
                                              const clast_decomposition *result,
                                              const clast_domain *domain);

CLAST_END
