// A chart of force chains: contacts as lines between grains, seen along y.
#include <clast/chart.h>

#include "base/alloc.h"
#include "base/status.h"
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { N_STEP = 4, N_END = 4 };

/// Lines of one thickness: pairs of ends with a gap behind each.
typedef struct {
    double *x, *y;
    int64_t n;
} strokes;

static clast_status strokes_alloc(strokes *s, int64_t n_line)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&s->x, 3 * n_line, sizeof *s->x));
    CLX_TRY(clx_alloc(&s->y, 3 * n_line, sizeof *s->y));
done:
    return status;
}

static void add_line(strokes *s, double factor, const double end[N_END])
{
    for (int k = 0; k < 3; ++k) {
        s->x[s->n] = k < 2 ? factor * end[2 * k] : (double)NAN;
        s->y[s->n] = k < 2 ? factor * end[2 * k + 1] : (double)NAN;
        ++s->n;
    }
}

/// Which step of thickness a contact is drawn with; 0: it is no link of a chain.
static int step_of(double share, double chain)
{
    return chain > 0.0 ? 1 + (int)fmax(0.0, fmin(N_STEP - 1, floor(share))) : 0;
}

clast_status clast_chart_chains(const clast_table *chains, const char *unit, const char *path)
{
    CLX_ARGUMENTS(chains, unit, path);
    CLX_WHOLE(table, chains);
    static const char *const name[N_END] = {"x0_m", "z0_m", "x1_m", "z1_m"};
    static const int32_t colour[1 + N_STEP] = {-1, 5, 0, 4, 1};
    static const char *const label[1 + N_STEP] = {"in no chain", "below the mean force",
                                                  "1 to 2 times", "2 to 3 times", "above 3 times"};
    clast_status status = CLAST_OK;
    strokes all[1 + N_STEP] = {{0}};
    clast_series series[1 + N_STEP];
    const double *end[N_END];
    const double *share = clast_table_numbers(chains, "force_share");
    const double *chain = clast_table_numbers(chains, "chain");
    const double factor = strcmp(unit, "m") == 0 ? 1e3 : 1.0;
    const char *shown = factor != 1.0 ? "mm" : strcmp(unit, "model") == 0 ? "model units" : unit;
    char axis[2][64];
    for (int k = 0; k < N_END; ++k) {
        end[k] = clast_table_numbers(chains, name[k]);
        CLX_CHECK(end[k] != NULL, CLAST_E_USAGE, "the table holds no force chains");
    }
    CLX_CHECK(share != NULL && chain != NULL, CLAST_E_USAGE, "the table holds no force chains");
    for (int s = 0; s <= N_STEP; ++s) {
        CLX_TRY(strokes_alloc(&all[s], chains->n_row));
    }
    for (int64_t i = 0; i < chains->n_row; ++i) {
        const double at[N_END] = {end[0][i], end[1][i], end[2][i], end[3][i]};
        add_line(&all[step_of(share[i], chain[i])], factor, at);
    }
    for (int s = 0; s <= N_STEP; ++s) {
        series[s] = (clast_series){.kind = CLAST_SERIES_LINE,
                                   .label = label[s],
                                   .x = all[s].x,
                                   .y = all[s].y,
                                   .n = all[s].n,
                                   .colour = colour[s],
                                   .width = s == 0 ? 0.3 : 0.8 * s};
    }
    (void)snprintf(axis[0], sizeof axis[0], "x (%s)", shown);
    (void)snprintf(axis[1], sizeof axis[1], "z (%s)", shown);
    const clast_chart chart = {.title = "Force chains, seen along y",
                               .x = {.label = axis[0]},
                               .y = {.label = axis[1]},
                               .series = series,
                               .n_series = 1 + N_STEP,
                               .equal = true,
                               .width = 480,
                               .height = 520};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    for (int s = 0; s <= N_STEP; ++s) {
        CLX_FREE(all[s].x, all[s].y);
    }
    return status;
}
