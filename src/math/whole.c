// Whether statistics that a caller has filled himself hold together.
#include "math/whole.h"
#include "base/status.h"
#include <clast/statistics.h>

const char *clx_statistics_fault(const clast_statistics *s)
{
    if (s == NULL) {
        return "is NULL";
    }
    if (!clx_has_array(s->name, s->n) || !clx_has_array(s->summary, s->n) ||
        !clx_has_array(s->r, s->n) || !clx_has_array(s->r_p, s->n)) {
        return "n is negative, or an array of the columns is NULL";
    }
    if (s->n_pca > s->n || !clx_has_array(s->pca_column, s->n_pca) ||
        !clx_has_array(s->variance, s->n_pca) || !clx_has_array(s->explained, s->n_pca) ||
        !clx_has_array(s->loading, s->n_pca)) {
        return "n_pca is not from 0 to n, or an array of the components is NULL";
    }
    for (int32_t k = 0; k < s->n_pca; ++k) {
        if (s->pca_column[k] < 0 || s->pca_column[k] >= s->n) {
            return "a component names no column";
        }
    }
    for (int32_t c = 0; c < s->n; ++c) {
        if (s->name[c] == NULL) {
            return "a column has no name";
        }
    }
    return NULL;
}

const char *clx_histogram_fault(const clast_histogram *h)
{
    if (h == NULL) {
        return "is NULL";
    }
    return !clx_has_array(h->edge, h->n_bin) || !clx_has_array(h->count, h->n_bin) ||
                   !clx_has_array(h->density, h->n_bin)
               ? "n_bin is negative, or edges, counts or densities are NULL"
               : NULL;
}
