// Columns of a cloud of points under names of their own.
#include "io/points.h"

#include "base/column_unit.h"
#include <clast/table.h>
#include <stdio.h>

enum { NAME_SIZE = 256 };

/// The name without control characters, with a number when it is taken.
static void free_name(const clast_table *table, char *wanted, char name[NAME_SIZE])
{
    for (char *c = wanted; *c != '\0'; ++c) {
        *c = (unsigned char)*c < ' ' || *c == 0x7F ? '_' : *c;
    }
    (void)snprintf(name, NAME_SIZE, "%.200s", wanted[0] != '\0' ? wanted : "unnamed");
    for (int k = 2; clast_table_find(table, name) >= 0; ++k) {
        (void)snprintf(name, NAME_SIZE, "%.200s_%d", wanted[0] != '\0' ? wanted : "unnamed", k);
    }
}

clast_status clx_points_add(clast_table *table, const char *name, int64_t width,
                            const double *value)
{
    static const char *const axis[3] = {"x", "y", "z"};
    clast_status status = CLAST_OK;
    for (int64_t k = 0; k < width; ++k) {
        char wanted[NAME_SIZE];
        char taken[NAME_SIZE];
        double *column = NULL;
        if (width == 1) {
            (void)snprintf(wanted, sizeof wanted, "%.200s", name);
        } else if (width <= 3) {
            (void)snprintf(wanted, sizeof wanted, "%.200s%s%s", name, name[0] != '\0' ? "_" : "",
                           axis[k]);
        } else {
            (void)snprintf(wanted, sizeof wanted, "%.200s_%lld", name, (long long)k);
        }
        free_name(table, wanted, taken);
        CLX_TRY(clx_table_add_said(table, taken, name, &column));
        for (int64_t i = 0; i < table->n_row; ++i) {
            column[i] = value[i * width + k];
        }
    }
done:
    return status;
}
