#pragma once
// What to say of a table's columns: one that is missing, one of times.
#include <clast/cloud.h>
#include <clast/table.h>

/// CLAST_E_FORMAT with the columns that the table has, or the first row that holds no number, and a
/// guess: decimal comma, wrong delimiter, no header, other case.
clast_status clx_cloud_no_column(const clast_table *table, const char *name);

enum { CLX_MOST_TIMES = 1000 };

/// The different numbers in a table's column of times, or in that of all its parts; {0} is empty.
typedef struct clx_times {
    char column[64];
    int32_t n;
    double value[CLX_MOST_TIMES]; ///< [n] ascending
} clx_times;

/// Adds the times of a table's rows: of a column "time", "t", "timestep", "step", "iteration" or
/// "frame" with a unit of time or none, which nothing in `columns` names. "T" without a unit is a
/// temperature, and bodies of clast evolve ("node", "time_s") have the time at which each came to
/// be.
void clx_times_add(const clast_table *table, const clast_cloud_columns *columns, clx_times *times);

/// CLAST_E_FORMAT where all ranks' times together are more than one. Called by all ranks.
clast_status clx_times_check(const clast_comm *comm, const char *name, const clx_times *times);

/// Finds the column of cloud->unread_weight.
void clx_cloud_find_weight(const clast_table *table, const clast_cloud_columns *columns,
                           clast_cloud *cloud);

/// clast_cloud_weight_words with what would take the weights, for a command without columns of
/// them.
const char *clx_cloud_weight_words(const clast_cloud *cloud, const char *name, const char *instead,
                                   size_t size, char *text);

/// clast_cloud_from_table of a part of a file, whose times are checked together.
clast_status clx_cloud_from_part(const clast_table *table, const clast_cloud_columns *columns,
                                 clast_cloud *cloud);
