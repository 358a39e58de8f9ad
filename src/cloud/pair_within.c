// Cells take their points as even, g(r) = 1 within. Pairs closer than half a cell tell whether they
// are: their number over what even cells of the same counts would hold. Whatever lies below the
// cells is missing from events by cells, is in events by pairs, and is what a kernel with a g(r) of
// its own brings along: so it must not be multiplied with both. [docs/theory/decompose.md]
#include "cloud/pair_within.h"

#include "math/special.h"
#include <math.h>

static const double least_pairs = 10.0; ///< for a ratio; fewer may be chance
static const double least_excess = 1.1; ///< of pairs over even cells
static const double by_chance = 1e-4;   ///< so many pairs in even cells, at most

/// Pairs in cells taken as even, and the edge that these pairs' cells have.
static void measure_cells(const clast_decomposition *r, clast_within_cells *w)
{
    double edges = 0.0;
    for (int32_t c = 0; c < r->cells.n; ++c) {
        const double n = (double)r->cells.count[c];
        if (n >= 2.0 && r->cells.volume[c] > 0.0) {
            const double pairs = 0.5 * n * (n - 1.0) / r->cells.volume[c];
            w->even += pairs;
            edges += pairs * pow(r->cells.volume[c], 1.0 / r->dimension);
        }
    }
    w->cell = w->even > 0.0 ? edges / w->even : 0.0;
}

/// The chance of `count` pairs or more where so many are expected.
static double tail(double count, double expected)
{
    return count > 0.0 ? clx_gamma_p(count, expected) : 1.0;
}

/// The cells' own upper end over even cells: what they know to lie below them is no news.
static double known_excess(const clast_decomposition *r, const clast_within_cells *w)
{
    const double rate = r->beta_dt > 0.0 ? r->beta_dt : 1.0;
    const clast_estimate *e = &r->events_by_cells;
    return e->resolved && r->n_capped == 0 ? fmax(least_excess, e->high / (rate * w->even))
                                           : least_excess;
}

/// Numbers of the table, by column.
typedef struct {
    const double *r, *pairs, *within, *expected, *g_low, *value, *low, *high;
} shells;

static shells columns(const clast_table *t)
{
    return (shells){.r = clast_table_numbers(t, "r_high_m"),
                    .pairs = clast_table_numbers(t, "pairs"),
                    .within = clast_table_numbers(t, "pairs_within"),
                    .expected = clast_table_numbers(t, "expected"),
                    .g_low = clast_table_numbers(t, "g_low"),
                    .value = clast_table_numbers(t, "integral"),
                    .low = clast_table_numbers(t, "integral_low"),
                    .high = clast_table_numbers(t, "integral_high")};
}

void clx_pair_within(clast_decomposition *r)
{
    clast_within_cells w = {0};
    double expected = 0.0;
    bool ended = false;
    measure_cells(r, &w);
    if (w.even > 0.0 && r->pairs.n > 1) {
        const shells s = columns(&r->pairs.shells);
        const double n = (double)r->pairs.n;
        const double even = 2.0 * w.even / (n * (n - 1.0)); // as an integral of f^2
        const double crowd = even * r->pairs.volume;        // over a uniform cloud
        const double most = known_excess(r, &w);
        for (int64_t k = 0; k < r->pairs.shells.n_row && s.r[k] <= 0.5 * w.cell; ++k) {
            const double own = crowd * s.expected[k];
            expected += own;
            if (s.within[k] >= least_pairs && w.radius == 0.0) {
                w.radius = s.r[k];
                w.n_pair = (int64_t)s.within[k];
                w.g = s.value[k] / even;
                w.g_low = s.low[k] / even;
                w.g_high = s.high[k] / even;
            }
            w.is_structured =
                w.is_structured || (s.within[k] >= least_pairs && s.low[k] > most * even &&
                                    tail(s.within[k], expected) < by_chance);
            if (s.g_low[k] > most * crowd && tail(s.pairs[k], own) < by_chance) {
                w.length = ended ? w.length : s.r[k];
            } else {
                ended = w.length > 0.0; // neighbours of close pairs come in pairs too, further out
            }
        }
    }
    w.length = w.is_structured ? w.length : 0.0;
    r->within = w;
}
