// Grain sizes that were wanted beside those that were placed.
#include <clast/aggregate.h>

#include "aggregate/config.h"
#include "aggregate/sizes.h"
#include "base/alloc.h"
#include "base/column_unit.h"
#include "base/field.h"
#include "base/status.h"
#include "math/sort.h"
#include "shape/whole.h"
#include <clast/table.h>
#include <math.h>
#include <stdlib.h>

enum { LAW_CLASSES = 12, LOW = 0, HIGH, WANTED, PLACED, WANTED_FINER, PLACED_FINER, N_COLUMN };

/// A class of sizes: one size, a bin of the histogram, or a stretch of a law.
typedef struct {
    double low, high;
    double wanted;       ///< particles of one aggregate
    double wanted_finer; ///< share of them up to `high`
    double placed;       ///< as wanted, mean over repeats
} size_class;

CLX_RISING_BY_TWO(by_size, size_class, low, high)

/// Share of the law's particles up to this size, before it is cut at size_low and size_high.
static double law_share(const clast_aggregate_params *c, double size)
{
    switch (c->size_law) {
    case CLAST_SIZE_UNIFORM:
        return fmin(1.0, fmax(0.0, (size - c->size_low) / (c->size_high - c->size_low)));
    case CLAST_SIZE_LOGUNIFORM:
        return fmin(1.0, fmax(0.0, log(size / c->size_low) / log(c->size_high / c->size_low)));
    case CLAST_SIZE_NORMAL:
        return 0.5 * erfc((c->size_mean - size) / (c->size_deviation * sqrt(2.0)));
    case CLAST_SIZE_LOGNORMAL:
        return size > 0.0 ? 0.5 * erfc(log(c->size_mean / size) / (c->size_shape * sqrt(2.0)))
                          : 0.0;
    default:
        return size > 0.0 ? -expm1(-pow(size / c->size_mean, c->size_shape)) : 0.0;
    }
}

/// The same of the law as it is cut.
static double law_finer(const clast_aggregate_params *c, double size)
{
    const double least = law_share(c, fmax(c->size_low, 0.0));
    const double most = c->size_high > 0.0 ? law_share(c, c->size_high) : 1.0;
    return most > least ? fmin(1.0, fmax(0.0, (law_share(c, size) - least) / (most - least))) : 1.0;
}

/// Classes even in the logarithm over what was placed; the first and the last are open, so that all
/// particles are wanted.
static clast_status law_classes(const clast_aggregate_params *c, const double range[2],
                                size_class **list, int64_t *n)
{
    clast_status status = CLAST_OK;
    const int n_class = range[0] < range[1] ? LAW_CLASSES : 1;
    double finer = 0.0; // than the class
    CLX_TRY(clx_alloc(list, n_class, sizeof **list));
    for (int k = 0; k < n_class; ++k) {
        size_class *one = &(*list)[k];
        one->low = range[0] * pow(range[1] / range[0], (double)k / n_class);
        one->high = range[0] * pow(range[1] / range[0], (k + 1.0) / n_class);
        one->wanted_finer = law_finer(c, one->high);
        const double up_to = k + 1 < n_class ? one->wanted_finer : 1.0;
        one->wanted = (double)c->n_particle * c->replicate * (up_to - finer);
        finer = up_to;
    }
    *n = n_class;
done:
    return status;
}

/// Whether two sizes or bins of a sorted list have sizes in common, beyond an edge: nothing tells
/// which of them such a size was drawn from.
static bool overlap(const size_class *finer, const size_class *coarser)
{
    return by_size(finer, coarser) == 0 || coarser->low < finer->high * (1.0 - 1e-9);
}

/// The distinct sizes or bins of a list; bins that overlap are one class.
static clast_status list_classes(const clast_aggregate_params *c, const clast_sizes *sizes,
                                 size_class **list, int64_t *n)
{
    clast_status status = CLAST_OK;
    double total = 0.0;
    int64_t kept = 0;
    CLX_TRY(clx_alloc(list, sizes->n, sizeof **list));
    for (int64_t i = 0; i < sizes->n; ++i) {
        (*list)[i] = (size_class){
            .low = sizes->low[i], .high = sizes->high[i], .wanted = clx_sizes_number(c, sizes, i)};
        total += (*list)[i].wanted;
    }
    qsort(*list, (size_t)sizes->n, sizeof **list, by_size);
    const double times =
        c->size_draw ? (double)c->n_particle * c->replicate / total : (double)c->replicate;
    for (int64_t i = 0; i < sizes->n; ++i) {
        const size_class one = (*list)[i];
        if (kept > 0 && overlap(&(*list)[kept - 1], &one)) {
            (*list)[kept - 1].wanted += times * one.wanted;
            (*list)[kept - 1].high = fmax((*list)[kept - 1].high, one.high);
        } else {
            (*list)[kept] = one;
            (*list)[kept++].wanted = times * one.wanted;
        }
    }
    *n = kept;
done:
    return status;
}

/// Shares of a list's particles up to each class.
static void cumulate(size_class *list, int64_t n)
{
    double sum = 0.0;
    double total = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        total += list[i].wanted;
    }
    for (int64_t i = 0; i < n; ++i) {
        sum += list[i].wanted;
        list[i].wanted_finer = sum / total;
    }
}

/// Class of a placed size: the first that holds it; the nearest where rounding leaves it outside of
/// all.
static int64_t class_of(const size_class *list, int64_t n, double size)
{
    CLAST_ASSERT(n > 0);
    int64_t nearest = 0;
    double least = HUGE_VAL;
    for (int64_t i = 0; i < n; ++i) {
        const double off = fmax(fmax(list[i].low - size, size - list[i].high), 0.0);
        if (off < least) {
            least = off;
            nearest = i;
        }
    }
    return nearest;
}

static clast_status make_table(const size_class *list, int64_t n, clast_table *table)
{
    static const char *const column[N_COLUMN][2] = {{"low_m", "m"},        {"high_m", "m"},
                                                    {"wanted", "-"},       {"placed", "-"},
                                                    {"wanted_finer", "-"}, {"placed_finer", "-"}};
    clast_status status = CLAST_OK;
    clast_table made = {0};
    double sum = 0.0;
    double total = 0.0;
    CLX_TRY(clast_table_init(&made, "sizes", n));
    CLX_TRY(CLX_ADD_COLUMNS(&made, column));
    for (int64_t i = 0; i < n; ++i) {
        total += list[i].placed;
    }
    for (int64_t i = 0; i < n; ++i) {
        sum += list[i].placed;
        made.column[LOW].number[i] = list[i].low;
        made.column[HIGH].number[i] = list[i].high;
        made.column[WANTED].number[i] = list[i].wanted;
        made.column[PLACED].number[i] = list[i].placed;
        made.column[WANTED_FINER].number[i] = list[i].wanted_finer;
        made.column[PLACED_FINER].number[i] = total > 0.0 ? sum / total : (double)NAN;
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

clast_status clast_aggregate_achieved(const clast_aggregate_params *params,
                                      const clast_sizes *sizes, const clast_table *history,
                                      clast_table *table)
{
    CLX_ARGUMENTS(params, history, table);
    CLX_GUARD(clx_fields_check_part(clast_aggregate_fields, 0, sizeof *params, params));
    CLX_WHOLE(table, history);
    if (sizes != NULL) {
        CLX_WHOLE(sizes, sizes);
    }
    clast_status status = CLAST_OK;
    const double *n = clast_table_numbers(history, "n");
    const double *size = clast_table_numbers(history, "size_m");
    size_class *list = NULL;
    int64_t n_class = 0;
    double range[2] = {HUGE_VAL, 0.0};
    int64_t n_run = 0;
    CLX_CHECK(n != NULL && size != NULL, CLAST_E_USAGE, "%s is no history: n or size_m is missing",
              history->name);
    for (int64_t i = 0; i < history->n_row; ++i) {
        n_run += n[i] == 0.0;
        range[0] = n[i] > 0.0 ? fmin(range[0], size[i]) : range[0];
        range[1] = n[i] > 0.0 ? fmax(range[1], size[i]) : range[1];
    }
    if (params->size_law != CLAST_SIZE_LIST) {
        CLX_CHECK(range[1] > 0.0, CLAST_E_USAGE, "%s has no particle", history->name);
        CLX_TRY(law_classes(params, range, &list, &n_class));
    } else {
        CLX_CHECK(sizes != NULL && sizes->n > 0, CLAST_E_USAGE, "the list of sizes is missing");
        CLX_TRY(list_classes(params, sizes, &list, &n_class));
        cumulate(list, n_class);
    }
    for (int64_t i = 0; i < history->n_row; ++i) {
        if (n[i] > 0.0) {
            list[class_of(list, n_class, size[i])].placed += 1.0 / (double)n_run;
        }
    }
    CLX_TRY(make_table(list, n_class, table));
done:
    clx_free(list);
    return status;
}
