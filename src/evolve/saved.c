// An evolution as tables, to go on from. What follows from mass, moments and reach is found again,
// and comes out the same.
#include "evolve/state.h"

#include "base/alloc.h"
#include <math.h>
#include <string.h>

static const char *const clock_column[][2] = {
    {"time", "s"},         {"step", "-"},         {"row", "-"},           {"rate", "-"},
    {"n_cut", "-"},        {"n_test", "-"},       {"n_cell", "-"},        {"mass_error", "-"},
    {"number_error", "-"}, {"range_n", "-"},      {"range_outside", "-"}, {"range_row", "-"},
    {"range_value", "-"},  {"range_excess", "-"}, {"n_start", "-"}};
static const char *const grain_column[][2] = {
    {"kind", "-"}, {"next", "-"}, {"scale", "-"}, {"x", "m"},  {"y", "m"},
    {"z", "m"},    {"qw", "-"},   {"qx", "-"},    {"qy", "-"}, {"qz", "-"}};
static const char *const body_column[][2] = {
    {"first", "-"},    {"last", "-"}, {"n", "-"},    {"state", "-"}, {"node", "-"},
    {"x", "m"},        {"y", "m"},    {"z", "m"},    {"time", "s"},  {"mass", "kg"},
    {"volume", "m^3"}, {"xx", "m^2"}, {"yy", "m^2"}, {"zz", "m^2"},  {"yz", "m^2"},
    {"xz", "m^2"},     {"xy", "m^2"}, {"reach", "m"}};
static const char *const event_column[][2] = {
    {"time", "s"},       {"node_a", "-"},   {"node_b", "-"}, {"body", "-"},  {"n", "-"},
    {"touched", "-"},    {"arriving", "-"}, {"px", "m"},     {"py", "m"},    {"pz", "m"},
    {"x", "m"},          {"y", "m"},        {"z", "m"},      {"mass", "kg"}, {"gyration", "m"},
    {"envelope", "m^3"}, {"speed", "m/s"}};

enum { CLOCK, GRAINS, BODIES, EVENTS, BALANCE, SPECTRUM };

#define ROWS(columns)                                                                              \
    (clx_rows)                                                                                     \
    {                                                                                              \
        .n_column = sizeof(columns) / sizeof *(columns), .column = (columns)                       \
    }

static clast_status append_row(clx_rows *rows, const double *value)
{
    double *row = NULL;
    const clast_status status = clx_rows_add(rows, &row);
    if (status == CLAST_OK) {
        memcpy(row, value, (size_t)rows->n_column * sizeof *value);
    }
    return status;
}

static clast_status save_clock(const clast_evolve *e, clast_table *table)
{
    clast_status status = CLAST_OK;
    clx_rows rows = ROWS(clock_column);
    const double value[] = {e->time,        (double)e->step,  e->row,
                            e->rate,        (double)e->n_cut, (double)e->n_test,
                            e->n_cell,      e->mass_error,    (double)e->number_error,
                            e->range.n,     e->range.outside, e->range.row,
                            e->range.value, e->range.excess,  e->n_start};
    CLX_TRY(append_row(&rows, value));
    CLX_TRY(clx_rows_table(&rows, "clock", table));
done:
    clx_rows_free(&rows);
    return status;
}

static clast_status save_grains(const clast_evolve *e, clast_table *table)
{
    clast_status status = CLAST_OK;
    clx_rows rows = ROWS(grain_column);
    for (int32_t i = 0; i < e->n_start; ++i) {
        const clx_evolve_grain *g = &e->grain[i];
        const double *x = g->position;
        const double *q = g->orientation;
        CLX_TRY(append_row(&rows, (const double[]){g->kind, g->next, g->scale, x[0], x[1], x[2],
                                                   q[0], q[1], q[2], q[3]}));
    }
    CLX_TRY(clx_rows_table(&rows, "grains", table));
done:
    clx_rows_free(&rows);
    return status;
}

static clast_status save_bodies(const clast_evolve *e, clast_table *table)
{
    clast_status status = CLAST_OK;
    clx_rows rows = ROWS(body_column);
    for (int32_t i = 0; i < e->n_start; ++i) {
        const clx_evolve_body *b = &e->body[i];
        const double *s = b->second;
        CLX_TRY(append_row(&rows,
                           (const double[]){b->first, b->last, b->n, b->state, (double)b->node,
                                            b->x[0], b->x[1], b->x[2], b->time, b->mass, b->volume,
                                            s[0], s[1], s[2], s[3], s[4], s[5], b->reach}));
    }
    CLX_TRY(clx_rows_table(&rows, "bodies", table));
done:
    clx_rows_free(&rows);
    return status;
}

static clast_status save_events(const clast_evolve *e, clast_table *table)
{
    clast_status status = CLAST_OK;
    clx_rows rows = ROWS(event_column);
    for (int64_t k = 0; k < e->n_event; ++k) {
        const clx_evolve_event *v = &e->event[k];
        CLX_TRY(append_row(&rows,
                           (const double[]){v->time, (double)v->node[0], (double)v->node[1],
                                            v->body, v->n, v->contact[0], v->contact[1],
                                            v->point[0], v->point[1], v->point[2], v->x[0], v->x[1],
                                            v->x[2], v->mass, v->gyration, v->envelope, v->speed}));
    }
    CLX_TRY(clx_rows_table(&rows, "events", table));
done:
    clx_rows_free(&rows);
    return status;
}

clast_status clast_evolve_save(const clast_evolve *e, clast_table table[CLAST_N_EVOLVE_SAVED])
{
    CLX_ARGUMENTS(e, table);
    clast_status status = CLAST_OK;
    clast_table made[CLAST_N_EVOLVE_SAVED] = {{0}};
    CLX_TRY(save_clock(e, &made[CLOCK]));
    CLX_TRY(save_grains(e, &made[GRAINS]));
    CLX_TRY(save_bodies(e, &made[BODIES]));
    CLX_TRY(save_events(e, &made[EVENTS]));
    CLX_TRY(clx_rows_table(&e->balance, "balance", &made[BALANCE]));
    CLX_TRY(clx_rows_table(&e->spectrum, "spectrum", &made[SPECTRUM]));
    memcpy(table, made, sizeof made);
    memset(made, 0, sizeof made);
done:
    for (int k = 0; k < CLAST_N_EVOLVE_SAVED; ++k) {
        clast_table_free(&made[k]);
    }
    return status;
}

/// A whole number of a saved table within [low, high].
static clast_status whole(double value, double low, double high, const char *what, int64_t *out)
{
    if (!(value == floor(value) && value >= low && value <= high)) {
        return clx_fail(CLAST_E_FORMAT, "the saved %s %g is out of range", what, value);
    }
    *out = (int64_t)value;
    return CLAST_OK;
}

static clast_status take_clock(const clx_rows *rows, clast_evolve *e)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(rows->n == 1, CLAST_E_FORMAT, "the saved clock has %lld rows", (long long)rows->n);
    const double *v = rows->value;
    int64_t n = 0;
    CLX_TRY(whole(v[14], e->n_start, e->n_start, "number of particles", &n));
    CLX_TRY(whole(v[1], 0.0, 4294967295.0, "step", &n));
    e->step = (uint64_t)n;
    CLX_TRY(whole(v[2], 0.0, e->config->rows, "row", &n));
    e->row = (int32_t)n;
    CLX_TRY(whole(v[4], 0.0, 1e15, "n_cut", &e->n_cut));
    CLX_TRY(whole(v[5], 0.0, 1e15, "n_test", &e->n_test));
    CLX_TRY(whole(v[6], 0.0, 2e9, "n_cell", &n));
    e->n_cell = (int32_t)n;
    CLX_TRY(whole(v[8], 0.0, 1e15, "number_error", &e->number_error));
    CLX_TRY(whole(v[11], 0.0, CLAST_N_KERNEL_RANGE, "range_row", &n));
    CLX_CHECK(isfinite(v[0]) && v[0] >= 0.0 && isfinite(v[3]) && v[3] >= 0.0, CLAST_E_FORMAT,
              "the saved time %g or rate %g cannot be", v[0], v[3]);
    e->time = v[0];
    e->rate = v[3];
    e->mass_error = v[7];
    e->range = (clast_range_use){
        .n = v[9], .outside = v[10], .row = (int32_t)n, .value = v[12], .excess = v[13]};
done:
    return status;
}

static clast_status take_grains(const clx_rows *rows, clast_evolve *e)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(rows->n == e->n_start, CLAST_E_FORMAT, "%lld saved grains of %d", (long long)rows->n,
              e->n_start);
    for (int32_t i = 0; i < e->n_start; ++i) {
        const double *v = &rows->value[(int64_t)i * rows->n_column];
        clx_evolve_grain *g = &e->grain[i];
        int64_t n = 0;
        CLX_TRY(whole(v[0], g->kind, g->kind, "kind of a grain", &n));
        CLX_TRY(whole(v[1], -1.0, e->n_start - 1, "grain after another", &n));
        CLX_CHECK(v[2] == g->scale, CLAST_E_FORMAT, "grain %d has another size than saved", i + 1);
        g->next = (int32_t)n;
        memcpy(g->position, &v[3], sizeof g->position);
        memcpy(g->orientation, &v[6], sizeof g->orientation);
    }
done:
    return status;
}

/// Every grain is in one body, and each body's list has as many as it says.
static clast_status check_lists(const clast_evolve *e)
{
    clast_status status = CLAST_OK;
    int64_t seen = 0;
    for (int32_t i = 0; i < e->n_start; ++i) {
        const clx_evolve_body *b = &e->body[i];
        int32_t n = 0;
        for (int32_t g = b->first; b->state != CLX_BODY_MERGED && g >= 0 && n <= b->n;
             g = e->grain[g].next) {
            ++n;
        }
        CLX_CHECK(b->state == CLX_BODY_MERGED || n == b->n, CLAST_E_FORMAT,
                  "the saved body %d has not the %d grains that it says", i + 1, b->n);
        seen += n;
    }
    CLX_CHECK(seen == e->n_start, CLAST_E_FORMAT, "%lld grains in saved bodies of %d",
              (long long)seen, e->n_start);
done:
    return status;
}

static clast_status take_bodies(const clx_rows *rows, clast_evolve *e)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(rows->n == e->n_start, CLAST_E_FORMAT, "%lld saved bodies of %d", (long long)rows->n,
              e->n_start);
    for (int32_t i = 0; i < e->n_start; ++i) {
        const double *v = &rows->value[(int64_t)i * rows->n_column];
        clx_evolve_body *b = &e->body[i];
        int64_t n[5] = {0};
        for (int k = 0; k < 4; ++k) {
            const double high[] = {e->n_start - 1, e->n_start - 1, e->n_start, CLX_BODY_MERGED};
            CLX_TRY(whole(v[k], k == 2 ? 1.0 : 0.0, high[k], body_column[k][0], &n[k]));
        }
        CLX_TRY(whole(v[4], 0.0, 2.0 * e->n_start, "node", &n[4]));
        b->first = (int32_t)n[0];
        b->last = (int32_t)n[1];
        b->n = (int32_t)n[2];
        b->state = (int32_t)n[3];
        b->node = n[4];
        memcpy(b->x, &v[5], sizeof b->x);
        b->time = v[8];
        b->mass = v[9];
        b->volume = v[10];
        memcpy(b->second, &v[11], sizeof b->second);
        b->reach = v[17];
        CLX_CHECK(b->mass > 0.0 && b->volume > 0.0 && isfinite(b->mass + b->volume + b->reach),
                  CLAST_E_FORMAT, "the saved body %d has no mass or volume", i + 1);
        clx_evolve_update(e, b);
    }
    CLX_TRY(check_lists(e));
done:
    return status;
}

static clast_status take_events(const clx_rows *rows, clast_evolve *e)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(rows->n < e->n_start, CLAST_E_FORMAT, "%lld saved events of %d particles",
              (long long)rows->n, e->n_start);
    CLX_TRY(clx_grow(&e->event, &e->event_room, rows->n, sizeof *e->event));
    for (int64_t k = 0; k < rows->n; ++k) {
        const double *v = &rows->value[k * rows->n_column];
        int64_t n[6] = {0};
        const double least = e->config->structure ? 0.0 : -1.0;
        CLX_TRY(whole(v[1], 0.0, (double)(e->n_start + k - 1), "node_a", &n[0]));
        CLX_TRY(whole(v[2], 0.0, (double)(e->n_start + k - 1), "node_b", &n[1]));
        CLX_TRY(whole(v[3], 0.0, e->n_start - 1, "body", &n[2]));
        CLX_TRY(whole(v[4], 2.0, e->n_start, "n", &n[3]));
        CLX_TRY(whole(v[5], least, e->n_start - 1, "touched", &n[4]));
        CLX_TRY(whole(v[6], least, e->n_start - 1, "arriving", &n[5]));
        e->event[k] = (clx_evolve_event){.time = v[0],
                                         .node = {n[0], n[1]},
                                         .body = (int32_t)n[2],
                                         .n = (int32_t)n[3],
                                         .contact = {(int32_t)n[4], (int32_t)n[5]},
                                         .point = {v[7], v[8], v[9]},
                                         .x = {v[10], v[11], v[12]},
                                         .mass = v[13],
                                         .gyration = v[14],
                                         .envelope = v[15],
                                         .speed = v[16]};
    }
    e->n_event = rows->n;
done:
    return status;
}

clast_status clast_evolve_restore(const clast_table table[CLAST_N_EVOLVE_SAVED], clast_evolve *e)
{
    CLX_ARGUMENTS(table, e);
    clast_status status = CLAST_OK;
    clx_rows rows[] = {ROWS(clock_column), ROWS(grain_column), ROWS(body_column),
                       ROWS(event_column)};
    for (int k = 0; k < BALANCE; ++k) {
        CLX_TRY(clx_rows_read(&table[k], &rows[k]));
    }
    CLX_TRY(take_clock(&rows[CLOCK], e));
    CLX_TRY(take_grains(&rows[GRAINS], e));
    CLX_TRY(take_bodies(&rows[BODIES], e));
    CLX_TRY(take_events(&rows[EVENTS], e));
    CLX_TRY(clx_rows_read(&table[BALANCE], &e->balance));
    CLX_TRY(clx_rows_read(&table[SPECTRUM], &e->spectrum));
    clx_evolve_list(e);
done:
    for (int k = 0; k < BALANCE; ++k) {
        clx_rows_free(&rows[k]);
    }
    return status;
}
