// The rows of a growing aggregate, as a table.
#include "aggregate/history.h"

#include "base/alloc.h"
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name, *unit;
} fixed[CLX_HISTORY_FIXED] = {
    [CLX_HISTORY_REPEAT] = {"repeat", "-"},
    [CLX_HISTORY_N] = {"n", "-"},
    [CLX_HISTORY_CLUSTERS] = {"n_cluster", "-"},
    [CLX_HISTORY_GRAINS] = {"n_grain", "-"},
    [CLX_HISTORY_SHAPE] = {"shape", "-"},
    [CLX_HISTORY_SIZE] = {"size_m", "m"},
    [CLX_HISTORY_DISTANCE] = {"distance_m", "m"},
    [CLX_HISTORY_RAYS] = {"rays", "-"},
    [CLX_HISTORY_TOUCHED] = {"touched", "-"},
    [CLX_HISTORY_OVERLAP] = {"overlap_m", "m"},
    [CLX_HISTORY_LOST] = {"lost", "-"},
    [CLX_HISTORY_MASS] = {"mass_kg", "kg"},
    [CLX_HISTORY_SOLID] = {"solid_m3", "m^3"},
    [CLX_HISTORY_GYRATION] = {"radius_of_gyration_m", "m"},
};

void clx_history_free(clx_history *history)
{
    CLX_FREE(history->name, history->unit, history->value);
    *history = (clx_history){0};
}

clast_status clx_history_column(clx_history *history, const char *name, const char *unit)
{
    clast_status status = CLAST_OK;
    const int32_t n = history->n_column;
    CLAST_ASSERT(history->n_row == 0);
    CLX_TRY(clx_realloc(&history->name, n + 1, sizeof *history->name));
    CLX_TRY(clx_realloc(&history->unit, n + 1, sizeof *history->unit));
    (void)snprintf(history->name[n], sizeof history->name[n], "%s", name);
    (void)snprintf(history->unit[n], sizeof history->unit[n], "%s", unit);
    history->n_column = n + 1;
done:
    return status;
}

clast_status clx_history_init(clx_history *history)
{
    clast_status status = CLAST_OK;
    clx_history made = {0};
    for (int32_t i = 0; i < CLX_HISTORY_FIXED; ++i) {
        CLX_TRY(clx_history_column(&made, fixed[i].name, fixed[i].unit));
    }
    *history = made;
    made = (clx_history){0};
done:
    clx_history_free(&made);
    return status;
}

clast_status clx_history_row(clx_history *history, double **row)
{
    CLAST_ASSERT(history->n_column >= CLX_HISTORY_FIXED);
    const int64_t n = history->n_column;
    const clast_status status = clx_grow(&history->value, &history->row_capacity,
                                         history->n_row + 1, (size_t)n * sizeof *history->value);
    if (status == CLAST_OK) {
        *row = &history->value[history->n_row++ * n];
        memset(*row, 0, (size_t)n * sizeof **row);
    }
    return status;
}

clast_status clx_history_table(const clx_history *history, clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_table made = {0};
    CLX_TRY(clast_table_init(&made, "history", history->n_row));
    for (int32_t c = 0; c < history->n_column; ++c) {
        double *number = NULL;
        CLX_TRY(clast_table_add_number(&made, history->name[c], history->unit[c], &number));
        for (int64_t r = 0; r < history->n_row; ++r) {
            number[r] = history->value[r * history->n_column + c];
        }
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

clast_status clx_history_read(clx_history *history, const clast_table *table)
{
    clast_status status = CLAST_OK;
    for (int64_t r = 0; r < table->n_row; ++r) {
        double *row = NULL;
        CLX_TRY(clx_history_row(history, &row));
    }
    for (int32_t c = 0; c < history->n_column; ++c) {
        const double *number = clast_table_numbers(table, history->name[c]);
        CLX_CHECK(number != NULL, CLAST_E_FORMAT, "the saved history has no column %s",
                  history->name[c]);
        for (int64_t r = 0; r < table->n_row; ++r) {
            history->value[r * history->n_column + c] = number[r];
        }
    }
done:
    return status;
}
