// Tables, files for ParaView and charts of a decomposition.
#include "decompose_files.h"

#include "command.h"
#include <clast/chart.h>
#include <clast/decompose.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>

void cli_decompose_note(const cli_decompose_job *j, char note[CLI_DECOMPOSE_NOTE])
{
    const clast_decomposition *r = j->result;
    int used = snprintf(note, CLI_DECOMPOSE_NOTE, "domain %s (m), volume %.9g m^%d", j->name,
                        r->volume, r->dimension);
    if (r->beta_dt > 0.0) {
        used += snprintf(note + used, (size_t)(CLI_DECOMPOSE_NOTE - used), ", beta_dt %.9g m^%d",
                         r->beta_dt, r->dimension);
    } else {
        used += snprintf(note + used, (size_t)(CLI_DECOMPOSE_NOTE - used),
                         ", no beta_dt: pair integral in 1/m^%d", r->dimension);
    }
    if (j->has_drawn) {
        (void)snprintf(note + used, (size_t)(CLI_DECOMPOSE_NOTE - used), ", seed %llu",
                       (unsigned long long)r->seed);
    }
}

/// Corners of a mapped domain's cells are coordinates of the unit cube, which have no unit.
static clast_status cell_table(const clast_decomposition *r, bool is_mapped, clast_table *table)
{
    static const char *const name_of[2][2][3] = {
        {{"x_low_m", "y_low_m", "z_low_m"}, {"x_high_m", "y_high_m", "z_high_m"}},
        {{"u_low", "v_low", "w_low"}, {"u_high", "v_high", "w_high"}}};
    const char *const *low = name_of[is_mapped ? 1 : 0][0];
    const char *const *high = name_of[is_mapped ? 1 : 0][1];
    const clast_cells *cells = &r->cells;
    CLI_GUARD(clast_table_init(table, "cells", cells->n));
    for (int32_t j = 0; j < 2 * r->dimension; ++j) {
        double *column = NULL;
        const int32_t axis = j / 2;
        CLI_GUARD(clast_table_add_number(table, j % 2 == 0 ? low[axis] : high[axis],
                                         is_mapped ? "-" : "m", &column));
        for (int32_t c = 0; c < cells->n; ++c) {
            column[c] = j % 2 == 0 ? cells->low[c][axis] : cells->high[c][axis];
        }
    }
    const bool is_pairs = r->beta_dt == 0.0;
    const char *const name[7] = {
        "volume", "count", "density", is_pairs ? "pair_integral" : "events",
        "weight", "label", "pass"};
    char unit[2][8];
    (void)snprintf(unit[0], sizeof unit[0], "m^%d", r->dimension);
    (void)snprintf(unit[1], sizeof unit[1], "1/m^%d", r->dimension);
    const char *const unit_of[7] = {unit[0], "-", unit[1], is_pairs ? unit[1] : "-", "-", "-", "-"};
    for (int k = 0; k < (clast_cells_are_labelled(cells) ? 7 : 5); ++k) {
        double *column = NULL;
        CLI_GUARD(clast_table_add_number(table, name[k], unit_of[k], &column));
        for (int32_t c = 0; c < cells->n; ++c) {
            const double value[7] = {cells->volume[c],
                                     (double)cells->count[c],
                                     (double)cells->count[c] / cells->volume[c],
                                     cells->events[c],
                                     cells->weight[c],
                                     (double)cells->label[c],
                                     (double)cells->pass[c]};
            column[c] = value[k];
        }
    }
    return CLAST_OK;
}

/// A row a point: cell, and label and pass where cells have them.
static clast_status label_table(const cli_decompose_job *j, clast_table *table)
{
    static const char *const name[3] = {"cell", "label", "pass"};
    const clast_cells *cells = &j->result->cells;
    CLI_GUARD(clast_table_init(table, "points", j->n_point));
    for (int k = 0; k < (clast_cells_are_labelled(cells) ? 3 : 1); ++k) {
        double *column = NULL;
        CLI_GUARD(clast_table_add_number(table, name[k], "-", &column));
        for (int64_t i = 0; i < j->n_point; ++i) {
            const int32_t c = j->of_point[i];
            column[i] = k == 0   ? c
                        : c < 0  ? (double)NAN // outside of the domain
                        : k == 1 ? cells->label[c]
                                 : cells->pass[c];
        }
    }
    return CLAST_OK;
}

static clast_status write_tables(const cli_decompose_job *j, const char *folder)
{
    const clast_decomposition *r = j->result;
    const bool is_mapped =
        j->domain->kind != CLAST_DOMAIN_BOX && j->domain->kind != CLAST_DOMAIN_MESH;
    char path[4096];
    char note[CLI_DECOMPOSE_NOTE];
    cli_decompose_note(j, note);
    clast_table cells = {0};
    clast_table points = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(cell_table(r, is_mapped, &cells));
    (void)snprintf(path, sizeof path, "%s/cells.csv", folder);
    CLI_TRY(clast_table_write_csv_note(&cells, note, path));
    CLI_TRY(label_table(j, &points));
    (void)snprintf(path, sizeof path, "%s/point_cells.csv", folder);
    CLI_TRY(clast_table_write_csv_note(&points, note, path));
    if (r->search.n_row > 0) {
        (void)snprintf(path, sizeof path, "%s/thresholds.csv", folder);
        CLI_TRY(clast_table_write_csv_note(&r->search, note, path));
    }
done:
    clast_table_free(&cells);
    clast_table_free(&points);
    return status;
}

static clast_status write_pictures(const cli_decompose_job *j, const char *folder)
{
    const clast_decomposition *r = j->result;
    char path[4096];
    (void)snprintf(path, sizeof path, "%s/cells.vtu", folder);
    CLI_GUARD(clast_cells_write_vtu(r, j->domain, path));
    if (!j->is_part) { // no rank has all points
        (void)snprintf(path, sizeof path, "%s/points.vtp", folder);
        CLI_GUARD(clast_decomposition_write_points(r, j->cloud, j->domain, path));
    }
    for (int k = 0; k < CLAST_N_DECOMPOSE_CHART; ++k) {
        const bool shows_points = k == CLAST_DECOMPOSE_CHART_POINTS;
        if (!(j->is_part && shows_points) &&
            clast_decompose_chart_fits((clast_decompose_chart)k, r)) {
            (void)snprintf(path, sizeof path, "%s/%s.%s", folder,
                           clast_decompose_chart_name((clast_decompose_chart)k, r), j->chart_end);
            CLI_GUARD(clast_decompose_chart_write((clast_decompose_chart)k, j->cloud, r, path));
        }
    }
    return CLAST_OK;
}

/// What the bars are: an unresolved estimate has no upper end.
static const char *bar_label(const double *high, int64_t n)
{
    int64_t n_bound = 0;
    for (int64_t i = 0; i < n; ++i) {
        n_bound += isfinite(high[i]) ? 0 : 1;
    }
    return n_bound == 0  ? "cells of clast, 95 % interval"
           : n_bound < n ? "cells of clast, 95 % interval; arrow: lower bound alone"
                         : "cells of clast, lower bound";
}

/// Scaled events over n.
static clast_status draw_sizes(const clast_table *table, int32_t dimension, const char *path)
{
    const double *events = clast_table_numbers(table, "scaled_events");
    char label[64] = "events times (N / n)^2 (-)";
    if (events == NULL) {
        events = clast_table_numbers(table, "scaled_pair_integral");
        (void)snprintf(label, sizeof label, "pair integral times (N / n)^2 (1/m^%d)", dimension);
    }
    const double *n = clast_table_numbers(table, "n");
    const double *regular = clast_table_numbers(table, "scaled_regular");
    const double *high = clast_table_numbers(table, "scaled_high");
    const clast_series series[2] = {{.kind = CLAST_SERIES_POINTS,
                                     .label = bar_label(high, table->n_row),
                                     .x = n,
                                     .y = events,
                                     .low = clast_table_numbers(table, "scaled_low"),
                                     .high = high,
                                     .n = table->n_row},
                                    {.kind = CLAST_SERIES_LINE,
                                     .label = "regular mesh",
                                     .x = n,
                                     .y = regular,
                                     .n = table->n_row,
                                     .colour = 1,
                                     .dashed = true}};
    const clast_chart chart = {.x = {.label = "points used, n (-)", .log = true},
                               .y = {.label = label},
                               .series = series,
                               .n_series = regular != NULL ? 2 : 1};
    return clast_chart_write(&chart, path);
}

/// events_by_n.csv and its chart.
static clast_status write_sizes(const cli_decompose_job *j, const char *folder)
{
    char path[4096];
    char note[CLI_DECOMPOSE_NOTE];
    cli_decompose_note(j, note);
    (void)snprintf(path, sizeof path, "%s/events_by_n.csv", folder);
    CLI_GUARD(clast_table_write_csv_note(j->sizes, note, path));
    (void)snprintf(path, sizeof path, "%s/events_by_n.%s", folder, j->chart_end);
    return draw_sizes(j->sizes, j->result->dimension, path);
}

clast_status cli_decompose_files(const cli_decompose_job *j, const char *folder)
{
    if (j->sizes->n_column > 0) {
        CLI_GUARD(write_sizes(j, folder));
    }
    CLI_GUARD(write_tables(j, folder));
    return write_pictures(j, folder);
}
