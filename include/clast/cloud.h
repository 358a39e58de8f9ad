#pragma once
#include <clast/field.h>
#include <clast/table.h>

CLAST_BEGIN

/// Points in one, two or three dimensions, with optional properties; arrays may be borrowed by the
/// functions that read them.
typedef struct clast_cloud {
    int64_t n;
    int32_t dimension; ///< 1, 2 or 3
    double *x;         ///< [n][dimension] m
    double *radius;    ///< [n] m, or NULL
    double *mass;      ///< [n] kg, or NULL
    double *weight;    ///< [n] real particles a parcel stands for, or NULL (1)
    double *velocity;  ///< [n][dimension] m/s, or NULL
    double *variable;  ///< [n] temperature or the like: cells shall be uniform in it too; or NULL
} clast_cloud;

CLAST_API clast_status clast_cloud_alloc(int64_t n, int32_t dimension, clast_cloud *cloud);
CLAST_API void clast_cloud_free(clast_cloud *cloud);

/// Which columns of a table hold what; an empty list, an empty text or NULL: nothing does.
typedef struct clast_cloud_columns {
    clast_text_list columns;          ///< coordinates; an item may be a list itself, "x,y,z"
    clast_text_list velocity_columns; ///< as many as coordinates
    char *radius_column, *diameter_column, *mass_column, *weight_column, *variable_column;
    char *unit; ///< of coordinates whose columns name none ("mm"); NULL or "": metres
} clast_cloud_columns;

/// Numbers of the named column; *column is NULL for a name that is empty or NULL.
///
/// @return CLAST_E_FORMAT when the table has no such column of numbers: the columns it has, or the
/// first row without a number, with a guess
CLAST_API clast_status clast_cloud_column(const clast_table *table, const char *name,
                                          double **column);

/// A table's rows as a cloud, in SI: a column whose name tells a unit (x_mm, "r (um)") is
/// converted. Of the default coordinates "x,y,z" missing trailing ones end the list.
///
/// @return CLAST_E_FORMAT names the missing column; CLAST_E_CONFIG for radii and diameters at once,
/// and for a unit beside columns that name another
CLAST_API clast_status clast_cloud_from_table(const clast_table *table,
                                              const clast_cloud_columns *columns,
                                              clast_cloud *cloud);

/// Points that have the very coordinates of an earlier one; O(n).
CLAST_API clast_status clast_cloud_repeated(const clast_cloud *cloud, int64_t *n_repeated);

CLAST_END
