#pragma once
// Columns of clast_dem_contact_table, by their names.
#include <clast/table.h>

/// Borrowed from the table, [n] each.
typedef struct {
    int64_t n;
    const double *a, *b;     ///< grains; b -1: a wall
    const double *z_a;       ///< of a's centre [m]
    const double *point[3];  ///< [m]
    const double *branch[3]; ///< from a's centre to b's, or to the point at a wall [m]
    const double *force[3];  ///< of a on b [N]
} clx_contacts;

/// @return CLAST_E_FORMAT for a table that is none
clast_status clx_contacts_read(const clast_table *table, clx_contacts *contacts);
