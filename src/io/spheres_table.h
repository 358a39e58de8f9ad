#pragma once
// Spheres in tables.
#include <clast/state.h>
#include <clast/table.h>

/// True when the table's columns are named as those of spheres: x, y, z and a radius or diameter,
/// and none as forms: those are of grains that lie there.
bool clx_spheres_are_named(const clast_table *table);

/// True for "x", "x_um", "x (um)", "x [um]" when the wanted name is "x" and the SI unit m; "d_agg"
/// is no "d".
bool clx_column_is(const char *column, const char *wanted, const char *si_unit);

/// The column "x" of a table, bare or else with a unit of length: "x_mm", "x (um)"; NULL if none.
const clast_column *clx_column_find(const clast_table *table, const char *name);

/// True when the table's columns are named as those of points, x, y and z, and none as forms.
bool clx_points_are_named(const clast_table *table);

/// The spheres of a table: by the options, by the columns' names, or by place.
///
/// @param options  NULL: the first four columns are x, y, z, radius when none has such a name
/// @param unit_m   metres in the columns' unit when all of them say one (1: in several, of which
///                 `mixes` tells): the lengths are then in metres; 0 when they are as in the table;
///                 NULL, as `mixes`: as in the table whatever their unit
clast_status clx_spheres_of_table(const clast_table *table, const clast_packing_options *options,
                                  clast_spheres *spheres, double *unit_m, bool *mixes);

/// What is asked of a table of spheres, and by whom.
typedef struct clx_spheres_wanted {
    clast_packing_options options;
    double metre;       ///< above 0: metres in a length of columns that say no unit, where a given
                        ///< diameter is in metres
    const char *prefix; ///< of the names of options in messages: "--", "--start-"; NULL: none can
                        ///< be given
    bool takes_few; ///< columns behind those that the options name are passed over: of a file that
                    ///< names them itself, and as clast read until 0.1.0
} clx_spheres_wanted;

/// The spheres' ids [n_row], or NULL: the column that the list calls id, else the one named so,
/// else without names the first that counts the rows.
const double *clx_spheres_ids(const clast_table *table, const clx_spheres_wanted *wanted);

/// Whether columns are named by place.
bool clx_spheres_has_list(const clx_spheres_wanted *wanted);

/// Refuses (CLAST_E_CONFIG) a list, where there is one, that does not name x, y, z and each of the
/// table's columns, '-' for one that is passed over, or gives one another name of these and id than
/// its own.
clast_status clx_spheres_check_list(const clast_table *table, const clx_spheres_wanted *wanted);

/// clx_spheres_of_table so.
///
/// @param unit  of the columns' lengths as x says it, "" for none
clast_status clx_spheres_of_columns(const clast_table *table, const clx_spheres_wanted *wanted,
                                    clast_spheres *spheres, char unit[16]);
