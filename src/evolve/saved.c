// An evolution as tables, to go on from. What follows from mass, moments and reach is found again,
// and comes out the same.
#include "evolve/state.h"

#include "base/alloc.h"
#include "math/vec3.h"
#include <math.h>
#include <string.h>

typedef enum { REAL, SMALL, LARGE } member_type; ///< double, int32_t, int64_t

/// A member of a struct as a column of a table; a whole one lies in [low, n_start * each + high].
typedef struct {
    const char *name, *unit;
    size_t offset;
    member_type type;
    double low, each, high;
} member;

typedef struct clast_evolve evolution;
typedef clx_evolve_grain grain;
typedef clx_evolve_body body;
typedef clx_evolve_event event;

#define WHOLE(of, name, unit, at, type, ...)                                                       \
    {                                                                                              \
        name, unit, offsetof(of, at), type, __VA_ARGS__                                            \
    }
#define NUMBER(of, name, unit, at) WHOLE(of, name, unit, at, REAL, 0.0, 0.0, 0.0)

static const member clock_member[] = {
    NUMBER(evolution, "time", "s", time),
    WHOLE(evolution, "step", "-", step, LARGE, 0, 0, 4294967295.0),
    WHOLE(evolution, "row", "-", row, SMALL, 0, 0, 1e6),
    NUMBER(evolution, "rate", "-", rate),
    WHOLE(evolution, "n_cut", "-", n_cut, LARGE, 0, 0, 1e15),
    WHOLE(evolution, "n_test", "-", n_test, LARGE, 0, 0, 1e15),
    WHOLE(evolution, "n_unresolved", "-", n_unresolved, LARGE, 0, 0, 1e15),
    NUMBER(evolution, "pair_share", "-", pair_share),
    WHOLE(evolution, "pair_resolved", "-", pair_resolved, SMALL, 0, 0, 1),
    WHOLE(evolution, "pair_n", "-", pair_n, SMALL, 0, 1, 0),
    WHOLE(evolution, "pair_step", "-", pair_step, LARGE, 0, 0, 4294967295.0),
    WHOLE(evolution, "leg_step", "-", leg_step, SMALL, 0, 0, CLX_LEG_STEPS - 1),
    WHOLE(evolution, "estimator", "-", decompose.estimator, SMALL, 0, 0, CLAST_ESTIMATOR_AUTO),
    WHOLE(evolution, "n_cell", "-", n_cell, SMALL, 0, 0, 2e9),
    NUMBER(evolution, "mass_error", "-", mass_error),
    WHOLE(evolution, "number_error", "-", number_error, LARGE, 0, 0, 1e15),
    NUMBER(evolution, "range_n", "-", range.n),
    NUMBER(evolution, "range_outside", "-", range.outside),
    WHOLE(evolution, "range_row", "-", range.row, SMALL, 0, 0, CLAST_N_KERNEL_RANGE),
    NUMBER(evolution, "range_value", "-", range.value),
    NUMBER(evolution, "range_excess", "-", range.excess),
    WHOLE(evolution, "n_start", "-", n_start, SMALL, 0, 1, 0),
};
static const member grain_member[] = {
    WHOLE(grain, "kind", "-", kind, SMALL, 0, 0, 2e9),
    WHOLE(grain, "next", "-", next, SMALL, -1, 1, -1),
    NUMBER(grain, "scale", "-", scale),
    NUMBER(grain, "x", "m", position[0]),
    NUMBER(grain, "y", "m", position[1]),
    NUMBER(grain, "z", "m", position[2]),
    NUMBER(grain, "qw", "-", orientation[0]),
    NUMBER(grain, "qx", "-", orientation[1]),
    NUMBER(grain, "qy", "-", orientation[2]),
    NUMBER(grain, "qz", "-", orientation[3]),
};
static const member body_member[] = {
    WHOLE(body, "first", "-", first, SMALL, 0, 1, -1),
    WHOLE(body, "last", "-", last, SMALL, 0, 1, -1),
    WHOLE(body, "n", "-", n, SMALL, 1, 1, 0),
    WHOLE(body, "state", "-", state, SMALL, 0, 0, CLX_BODY_MERGED),
    WHOLE(body, "node", "-", node, LARGE, 0, 2, 0),
    NUMBER(body, "x", "m", x[0]),
    NUMBER(body, "y", "m", x[1]),
    NUMBER(body, "z", "m", x[2]),
    NUMBER(body, "time", "s", time),
    NUMBER(body, "mass", "kg", mass),
    NUMBER(body, "volume", "m^3", volume),
    NUMBER(body, "xx", "m^2", second[0]),
    NUMBER(body, "yy", "m^2", second[1]),
    NUMBER(body, "zz", "m^2", second[2]),
    NUMBER(body, "yz", "m^2", second[3]),
    NUMBER(body, "xz", "m^2", second[4]),
    NUMBER(body, "xy", "m^2", second[5]),
    NUMBER(body, "reach", "m", bounding_radius),
};
static const member event_member[] = {
    NUMBER(event, "time", "s", time),
    WHOLE(event, "node_a", "-", node[0], LARGE, 0, 2, 0),
    WHOLE(event, "node_b", "-", node[1], LARGE, 0, 2, 0),
    WHOLE(event, "body", "-", body, SMALL, 0, 1, -1),
    WHOLE(event, "n", "-", n, SMALL, 2, 1, 0),
    WHOLE(event, "touched", "-", contact[0], SMALL, -1, 1, -1),
    WHOLE(event, "arriving", "-", contact[1], SMALL, -1, 1, -1),
    NUMBER(event, "px", "m", point[0]),
    NUMBER(event, "py", "m", point[1]),
    NUMBER(event, "pz", "m", point[2]),
    NUMBER(event, "x", "m", x[0]),
    NUMBER(event, "y", "m", x[1]),
    NUMBER(event, "z", "m", x[2]),
    NUMBER(event, "mass", "kg", mass),
    NUMBER(event, "gyration", "m", gyration),
    NUMBER(event, "envelope", "m^3", envelope),
    NUMBER(event, "speed", "m/s", speed),
};

/// A table of structs.
typedef struct {
    const char *name;
    int32_t n_member;
    const member *member; ///< [n_member]
    size_t size;          ///< of a struct
} layout;

#define LAYOUT(name, members, of)                                                                  \
    {                                                                                              \
        name, sizeof(members) / sizeof *(members), members, sizeof(of)                             \
    }

enum { CLOCK, GRAINS, BODIES, EVENTS, BALANCE, SPECTRUM, CUTS };

static const layout layouts[] = {
    [CLOCK] = LAYOUT("clock", clock_member, evolution),
    [GRAINS] = LAYOUT("grains", grain_member, grain),
    [BODIES] = LAYOUT("bodies", body_member, body),
    [EVENTS] = LAYOUT("events", event_member, event),
};

static double read_member(const member *m, const void *item)
{
    const char *at = (const char *)item + m->offset;
    switch (m->type) {
    case SMALL:
        return *(const int32_t *)(const void *)at;
    case LARGE:
        return (double)*(const int64_t *)(const void *)at;
    default:
        return *(const double *)(const void *)at;
    }
}

static void write_member(const member *m, double value, void *item)
{
    char *at = (char *)item + m->offset;
    if (m->type == SMALL) {
        *(int32_t *)(void *)at = (int32_t)value;
    } else if (m->type == LARGE) {
        *(int64_t *)(void *)at = (int64_t)value;
    } else {
        *(double *)(void *)at = value;
    }
}

static clast_status save(const layout *l, const void *item, int64_t n, clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_table made = {0};
    CLX_TRY(clast_table_init(&made, l->name, n));
    for (int32_t c = 0; c < l->n_member; ++c) {
        const member *m = &l->member[c];
        double *number = NULL;
        CLX_TRY(clast_table_add_number(&made, m->name, m->unit, &number));
        for (int64_t i = 0; i < n; ++i) {
            number[i] = read_member(m, (const char *)item + (size_t)i * l->size);
        }
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

clast_status clast_evolve_save(const clast_evolve *e, clast_table table[CLAST_N_EVOLVE_SAVED])
{
    CLX_ARGUMENTS(e, table);
    clast_status status = CLAST_OK;
    clast_table made[CLAST_N_EVOLVE_SAVED] = {{0}};
    CLX_TRY(save(&layouts[CLOCK], e, 1, &made[CLOCK]));
    CLX_TRY(save(&layouts[GRAINS], e->grain, e->n_start, &made[GRAINS]));
    CLX_TRY(save(&layouts[BODIES], e->body, e->n_start, &made[BODIES]));
    CLX_TRY(save(&layouts[EVENTS], e->event, e->n_event, &made[EVENTS]));
    CLX_TRY(clx_rows_table(&e->balance, "balance", &made[BALANCE]));
    CLX_TRY(clx_rows_table(&e->spectrum, "spectrum", &made[SPECTRUM]));
    CLX_TRY(clx_rows_table(&e->cuts, "cuts", &made[CUTS]));
    memcpy(table, made, sizeof made);
    memset(made, 0, sizeof made);
done:
    for (int k = 0; k < CLAST_N_EVOLVE_SAVED; ++k) {
        clast_table_free(&made[k]);
    }
    return status;
}

/// The rows of a table into n structs.
static clast_status load(const layout *l, const clast_table *table, int32_t n_start, int64_t n,
                         void *item)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(table->n_row == n, CLAST_E_FORMAT, "%lld saved %s of %lld", (long long)table->n_row,
              l->name, (long long)n);
    for (int32_t c = 0; c < l->n_member; ++c) {
        const member *m = &l->member[c];
        const double high = m->each * n_start + m->high;
        const double *number = clast_table_numbers(table, m->name);
        CLX_CHECK(number != NULL, CLAST_E_FORMAT, "the saved table %s has no column %s", l->name,
                  m->name);
        for (int64_t i = 0; i < n; ++i) {
            const double v = number[i];
            CLX_CHECK(m->type == REAL || (v == floor(v) && v >= m->low && v <= high),
                      CLAST_E_FORMAT, "the saved %s: %s %g of row %lld is out of range", l->name,
                      m->name, v, (long long)i + 1);
            write_member(m, v, (char *)item + (size_t)i * l->size);
        }
    }
done:
    return status;
}

static clast_status load_clock(const clast_table *table, clast_evolve *e)
{
    clast_status status = CLAST_OK;
    clast_evolve seen = *e;
    CLX_TRY(load(&layouts[CLOCK], table, e->n_start, 1, &seen));
    CLX_CHECK(seen.n_start == e->n_start && seen.row <= e->config->rows, CLAST_E_FORMAT,
              "saved row %d of %d particles does not belong to %d rows of %d", seen.row,
              seen.n_start, e->config->rows, e->n_start);
    CLX_CHECK(isfinite(seen.time) && seen.time >= 0.0 && isfinite(seen.rate) && seen.rate >= 0.0,
              CLAST_E_FORMAT, "the saved time %g or rate %g cannot be", seen.time, seen.rate);
    CLX_CHECK(isfinite(seen.pair_share) && seen.pair_share >= 0.0 && seen.pair_step <= seen.step,
              CLAST_E_FORMAT, "the saved share of volume %g or its step cannot be",
              seen.pair_share);
    *e = seen;
done:
    return status;
}

static clast_status load_grains(const clast_table *table, clast_evolve *e)
{
    clast_status status = CLAST_OK;
    grain *seen = NULL;
    CLX_TRY(clx_alloc(&seen, e->n_start, sizeof *seen));
    CLX_TRY(load(&layouts[GRAINS], table, e->n_start, e->n_start, seen));
    for (int32_t i = 0; i < e->n_start; ++i) {
        CLX_CHECK(seen[i].kind == e->grain[i].kind && seen[i].scale == e->grain[i].scale,
                  CLAST_E_FORMAT, "grain %d has another shape or size than saved", i + 1);
        e->grain[i] = seen[i];
    }
done:
    clx_free(seen);
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

static clast_status load_bodies(const clast_table *table, clast_evolve *e)
{
    clast_status status = CLAST_OK;
    CLX_TRY(load(&layouts[BODIES], table, e->n_start, e->n_start, e->body));
    for (int32_t i = 0; i < e->n_start; ++i) {
        body *b = &e->body[i];
        CLX_CHECK(b->mass > 0.0 && b->volume > 0.0 &&
                      isfinite(b->mass + b->volume + b->bounding_radius),
                  CLAST_E_FORMAT, "the saved body %d has no mass or volume", i + 1);
        CLX_CHECK(v3_is_finite(b->x) && isfinite(b->time) && b->bounding_radius >= 0.0 &&
                      v3_is_finite(b->second) && v3_is_finite(b->second + 3),
                  CLAST_E_FORMAT, "the saved body %d has no place, time or extent", i + 1);
        clx_evolve_update(e, b);
    }
    CLX_TRY(check_lists(e));
done:
    return status;
}

static clast_status load_events(const clast_table *table, clast_evolve *e)
{
    clast_status status = CLAST_OK;
    const int64_t n = table->n_row;
    CLX_CHECK(n < e->n_start, CLAST_E_FORMAT, "%lld saved events of %d particles", (long long)n,
              e->n_start);
    CLX_TRY(clx_grow(&e->event, &e->event_capacity, n, sizeof *e->event));
    CLX_TRY(load(&layouts[EVENTS], table, e->n_start, n, e->event));
    for (int64_t k = 0; k < n; ++k) {
        const event *v = &e->event[k];
        const int32_t least = e->config->structure ? 0 : -1;
        CLX_CHECK(v->node[0] < e->n_start + k && v->node[1] < e->n_start + k &&
                      v->contact[0] >= least && v->contact[1] >= least,
                  CLAST_E_FORMAT, "the saved event %lld joins nodes or grains that are none",
                  (long long)k + 1);
    }
    e->n_event = n;
done:
    return status;
}

/// Calls in their order, each of as many places as there are bodies at the most.
static clast_status load_cuts(const clast_table *table, clast_evolve *e)
{
    clast_status status = CLAST_OK;
    int64_t n = 0; // places of the call
    CLX_TRY(clx_rows_read(table, &e->cuts));
    for (int64_t i = 0; i < e->cuts.n; ++i) {
        const double *row = &e->cuts.value[i * CLX_N_CUTS_COLUMN];
        const bool is_next = i > 0 && row[0] == row[-CLX_N_CUTS_COLUMN];
        n = is_next ? n + 1 : 1;
        CLX_CHECK(row[0] >= 0.0 && row[0] < e->leg_step && n <= e->n_start &&
                      (i == 0 || row[0] >= row[-CLX_N_CUTS_COLUMN]) && v3_is_finite(row + 1),
                  CLAST_E_FORMAT, "the saved place %lld of cells belongs to no call of this leg",
                  (long long)i + 1);
    }
    e->is_in_leg = false;
done:
    return status;
}

clast_status clast_evolve_restore(const clast_table table[CLAST_N_EVOLVE_SAVED], clast_evolve *e)
{
    CLX_ARGUMENTS(table, e);
    clast_status status = CLAST_OK;
    CLX_TRY(load_clock(&table[CLOCK], e));
    CLX_TRY(load_grains(&table[GRAINS], e));
    CLX_TRY(load_bodies(&table[BODIES], e));
    CLX_TRY(load_events(&table[EVENTS], e));
    CLX_TRY(clx_rows_read(&table[BALANCE], &e->balance));
    CLX_TRY(clx_rows_read(&table[SPECTRUM], &e->spectrum));
    CLX_TRY(load_cuts(&table[CUTS], e));
    clx_evolve_list(e);
done:
    return status;
}
