#pragma once
// Stress of a bed from the forces of its contacts.                     [docs/theory/porosity.md]
#include <clast/porosity.h>

CLAST_BEGIN

/// Mean stress between two heights, and what follows from it: columns name, value, unit, meaning.
///
///     sigma_ij = 1/V sum f_i l_j                            [Love1927, Weber1966; pressure > 0]
///
/// over contacts, f the force of a on b and l the branch from a to b; of a branch that is partly
/// outside the heights, that part is left out. Rows: the six entries of the symmetric part, mean
/// pressure, deviator q, ratio of horizontal to vertical stress.
///
/// @param contacts  of clast_dem_contact_table    @param z  heights [m]
/// @return CLAST_E_FORMAT when the table is no such, CLAST_E_GEOMETRY where there is no volume
CLAST_API clast_status clast_stress(const clast_table *contacts, const clast_bed *bed,
                                    const double z[2], clast_table *table);

/// The same in the slices of a porosity profile: z_low_m, z_high_m, stress_xx_Pa, .. yy, zz, xy,
/// xz, yz. At rest stress_zz is the weight less buoyancy of the grains whose centres lie above,
/// over the area, averaged over the slice: branches are shared out by their length in each slice.
CLAST_API clast_status clast_stress_profile(const clast_table *contacts, const clast_bed *bed,
                                            const clast_table *profile, clast_table *table);

CLAST_END
