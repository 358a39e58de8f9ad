#pragma once
#include <clast/assembly.h>
#include <clast/table.h>

CLAST_BEGIN

/// How an assembly's contacts and grains are directed: columns name, value, unit, meaning.
///
/// Contacts (absent where they are not known): mean coordination, shares of grains with none and
/// with fewer than four contacts, mean without the latter; eigenvalues and vertical entry of the
/// fabric tensor                 F = 1/N sum n n^T          [Satake1982]
/// of unit contact normals n between grains (rows normal_*; known from `contacts`, or where all
/// grains are spheres), and the same of unit branch vectors between the centroids of touching
/// grains (rows branch_*). In a periodic bed pass its period, so that branches take the short way.
///
/// Grains (absent for spheres): the same for Q = sum V a a^T / sum V over the longest and the
/// shortest principal axes a, by volume V, and the mean angle of the longest axis to the
/// horizontal. Random directions give eigenvalues of 1/3; a layered bed has a high vertical entry
/// of the shortest axis.
///
/// @param contacts  of clast_dem_contact_table, its columns b, normal_x, normal_y, normal_z; NULL
/// or
///                  without them: not known
/// @param period  x, y and z period [m], 0 for none; NULL: none
/// @param table   must be empty; written only on success
CLAST_API clast_status clast_fabric(const clast_assembly *assembly, const clast_table *contacts,
                                    const double period[3], clast_table *table);

CLAST_END
