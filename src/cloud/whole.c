// Whether a decomposition, as a caller hands it back, holds together.
#include "cloud/whole.h"

#include "base/status.h"
#include <clast/decompose.h>
#include <math.h>

/// Each of n numbers is below `limit`; -1 stands for none.
static bool are_below(const int32_t *number, int64_t n, int32_t limit)
{
    for (int64_t i = 0; i < n; ++i) {
        if (number[i] < -1 || number[i] >= limit) {
            return false;
        }
    }
    return true;
}

static const char *bins_fault(const clast_cells *cells)
{
    int64_t n = 1;
    for (int j = 0; j < 3; ++j) {
        if (cells->nb[j] < 1 || n > INT32_MAX / cells->nb[j]) {
            return "its bins along an axis are not 1 to 2^31 in all";
        }
        n *= cells->nb[j];
    }
    return cells->of_bin != NULL && !are_below(cells->of_bin, n, cells->n) ? "a bin names no cell"
                                                                           : NULL;
}

/// The same of the cells alone, in which `n_point` points lie.
static const char *cells_fault(const clast_cells *cells, int64_t n_point)
{
    if (cells == NULL) {
        return "is NULL";
    }
    const int32_t n = cells->n;
    if (!clx_has_array(cells->low, n) || !clx_has_array(cells->high, n) ||
        !clx_has_array(cells->volume, n) || !clx_has_array(cells->count, n) ||
        !clx_has_array(cells->label, n) || !clx_has_array(cells->pass, n) ||
        !clx_has_array(cells->weight, n) || !clx_has_array(cells->events, n)) {
        return "n is negative, or an array of the cells is NULL";
    }
    if (!clx_has_array(cells->of_point, n_point) || !are_below(cells->of_point, n_point, n)) {
        return "a point names no cell";
    }
    for (int32_t c = 0; c < n; ++c) {
        for (int j = 0; j < 3; ++j) {
            if (!isfinite(cells->low[c][j]) || !isfinite(cells->high[c][j])) {
                return "a cell's corner is not finite";
            }
        }
    }
    return cells->of_bin != NULL || cells->bin_count != NULL ? bins_fault(cells) : NULL;
}

const char *clx_decomposition_fault(const clast_decomposition *result)
{
    if (result == NULL) {
        return "is NULL";
    }
    if (result->n < 0 || result->n_outside < 0 || result->n_here < 0 || result->n > INT64_MAX / 2 ||
        result->n_outside > INT64_MAX / 2 || result->n_pass < 0 ||
        result->n_pass > CLAST_MAX_PASS || result->dimension < 1 || result->dimension > 3) {
        return "a number of points or passes, or the dimension, cannot be";
    }
    const char *fault = clx_table_fault(&result->search);
    return fault != NULL ? fault : cells_fault(&result->cells, result->n_here);
}
