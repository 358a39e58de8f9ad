// Simulations to plain arrays and back.
#include "dem/saved.h"

#include "base/alloc.h"
#include "base/lines.h"
#include "dem/container.h"
#include "dem/dem.h"
#include "dem/energy.h"
#include <string.h>

enum { WARM_START = sizeof(clx_warm_start) };

void clx_dem_saved_free(clx_dem_saved *s)
{
    CLX_FREE(s->shape, s->grain, s->anchor, s->limit, s->held, s->history, s->cell, s->energy,
             s->wall, s->id, s->pair, s->warm_start);
    *s = (clx_dem_saved){0};
}

static void write_grain(const clast_dem *dem, int64_t i, double *out)
{
    const clx_grain *g = &dem->grain[i];
    const clx_motion *m = &dem->motion[i];
    memcpy(out, g->position, 3 * sizeof *out);
    memcpy(out + 3, g->velocity, 3 * sizeof *out);
    memcpy(out + 6, g->omega, 3 * sizeof *out);
    memcpy(out + 9, m->orientation, 4 * sizeof *out);
    memcpy(out + 13, m->angular, 3 * sizeof *out);
    out[16] = g->scale;
    out[17] = m->density;
    out[18] = dem->travel[i];
}

static void write_pair(const clx_dem_pair *pair, int32_t *id, double *out)
{
    CLAST_ASSERT(pair->a >= 0 && (pair->b < 0 || pair->b > pair->a));
    id[0] = pair->a;
    id[1] = pair->b;
    id[2] = pair->period[0];
    id[3] = pair->period[1];
    id[4] = (int32_t)pair->touches;
    out[0] = pair->active_from;
    memcpy(out + 1, pair->slide, 3 * sizeof *out);
}

/// The periodic cell as plain numbers, and back.
static void write_cell(const clx_periodic_cell *cell, double x[CLX_SAVED_CELL])
{
    v3_copy(x, cell->side);
    v3_copy(x + 3, cell->rate);
    v3_copy(x + 6, cell->first);
    x[9] = cell->shift;
    x[10] = cell->shear;
    x[11] = cell->path;
    x[12] = cell->sheared;
}

static void read_cell(const double x[CLX_SAVED_CELL], clx_periodic_cell *cell)
{
    v3_copy(cell->side, x);
    v3_copy(cell->rate, x + 3);
    v3_copy(cell->first, x + 6);
    cell->shift = x[9];
    cell->shear = x[10];
    cell->path = x[11];
    cell->sheared = x[12];
    for (int c = 0; c < 3; ++c) {
        cell->inverse[c] = 1.0 / cell->side[c];
    }
}

/// Walls as plain numbers, and back.
static clast_status save_walls(const clast_dem *dem, clx_dem_saved *s)
{
    clast_status status = CLAST_OK;
    const clx_walls *all = &dem->walls;
    if (!all->is_watched) {
        return CLAST_OK;
    }
    s->n_wall = all->n + 1;
    CLX_TRY(clx_alloc(&s->wall, s->n_wall * CLX_SAVED_WALL, sizeof *s->wall));
    for (int32_t i = 0; i < all->n; ++i) {
        const clx_wall_body *w = &all->body[i];
        double *x = s->wall + (int64_t)i * CLX_SAVED_WALL;
        x[0] = (double)w->clock;
        x[1] = w->runs ? 1.0 : 0.0;
        x[2] = w->is_open ? 1.0 : 0.0;
        v3_copy(x + 3, w->offset);
        v3_copy(x + 6, w->drift);
        v3_copy(x + 9, w->force);
        v3_copy(x + 12, w->torque);
        v3_copy(x + 15, w->impulse);
        v3_copy(x + 18, w->moment);
        v3_copy(x + 21, w->velocity);
        v3_copy(x + 24, w->omega);
        x[27] = w->work;
    }
    double *last = s->wall + (int64_t)all->n * CLX_SAVED_WALL;
    last[0] = all->path;
    last[1] = isfinite(all->searched) ? all->searched : -1.0;
    last[2] = all->margin;
    last[3] = all->can_move ? 1.0 : 0.0;
done:
    return status;
}

static clast_status restore_walls(clast_dem *dem, const clx_dem_saved *s)
{
    clast_status status = CLAST_OK;
    clx_walls *all = &dem->walls;
    CLX_CHECK(all->is_watched == (s->wall != NULL) && (s->wall == NULL || s->n_wall == all->n + 1),
              CLAST_E_FORMAT, "the checkpoint's walls are of another configuration");
    for (int64_t k = 0; k < s->n_wall * CLX_SAVED_WALL; ++k) {
        CLX_CHECK(isfinite(s->wall[k]), CLAST_E_FORMAT, "wall %lld of the checkpoint is not finite",
                  (long long)(k / CLX_SAVED_WALL));
    }
    for (int32_t i = 0; s->wall != NULL && i < all->n; ++i) {
        clx_wall_body *w = &all->body[i];
        const double *x = s->wall + (int64_t)i * CLX_SAVED_WALL;
        CLX_CHECK(x[0] >= 0.0 && x[0] < 9e15, CLAST_E_FORMAT,
                  "wall %d of the checkpoint has no time", i);
        w->clock = (int64_t)x[0];
        w->runs = x[1] != 0.0;
        w->is_open = x[2] != 0.0;
        v3_copy(w->offset, x + 3);
        v3_copy(w->drift, x + 6);
        v3_copy(w->force, x + 9);
        v3_copy(w->torque, x + 12);
        v3_copy(w->impulse, x + 15);
        v3_copy(w->moment, x + 18);
        v3_copy(w->velocity, x + 21);
        v3_copy(w->omega, x + 24);
        w->work = x[27];
        clx_wall_place(dem, i);
    }
    if (s->wall != NULL) {
        const double *last = s->wall + (int64_t)all->n * CLX_SAVED_WALL;
        all->path = last[0];
        all->searched = last[1] >= 0.0 ? last[1] : -(double)INFINITY;
        all->margin = last[2];
        all->can_move = last[3] != 0.0;
    }
done:
    return status;
}

/// The digits of the book's sums, as numbers.
static clast_status save_energy(const clx_energy *energy, clx_dem_saved *s)
{
    clast_status status = CLAST_OK;
    clx_exact_sum sum[CLX_N_WORK];
    s->n_energy = (int64_t)CLX_N_WORK * CLX_EXACT_DIGITS;
    CLX_TRY(clx_alloc(&s->energy, s->n_energy, sizeof *s->energy));
    clx_energy_merge(energy, sum);
    for (int k = 0; k < CLX_N_WORK; ++k) {
        double *digit = s->energy + (int64_t)k * CLX_EXACT_DIGITS;
        clx_exact_carry(&sum[k]);
        for (int i = 0; i < CLX_EXACT_DIGITS; ++i) {
            digit[i] = (double)sum[k].digit[i];
        }
    }
done:
    return status;
}

static clast_status restore_energy(clx_energy *energy, const clx_dem_saved *s)
{
    clast_status status = CLAST_OK;
    clx_exact_sum sum[CLX_N_WORK] = {0};
    for (int64_t k = 0; k < s->n_energy; ++k) {
        const double x = s->energy[k];
        CLX_CHECK(fabs(x) <= 0xffffffff && x == floor(x), CLAST_E_FORMAT,
                  "the checkpoint's energy is none");
        sum[k / CLX_EXACT_DIGITS].digit[k % CLX_EXACT_DIGITS] = (int64_t)x;
    }
    clx_energy_set(energy, sum);
done:
    return status;
}

/// The cell and the energy book, which few simulations have.
static clast_status save_extras(const clast_dem *dem, clx_dem_saved *s)
{
    clast_status status = CLAST_OK;
    if (dem->cell != NULL) {
        CLX_TRY(clx_alloc(&s->cell, CLX_SAVED_CELL, sizeof *s->cell));
        write_cell(dem->cell, s->cell);
    }
    if (dem->energy != NULL) {
        CLX_TRY(save_energy(dem->energy, s));
    }
    CLX_TRY(save_walls(dem, s));
done:
    return status;
}

static clast_status restore_extras(clast_dem *dem, const clx_dem_saved *s)
{
    clast_status status = CLAST_OK;
    CLX_CHECK((dem->cell != NULL) == (s->cell != NULL) &&
                  (dem->energy != NULL) == (s->energy != NULL) &&
                  (s->energy == NULL || s->n_energy == (int64_t)CLX_N_WORK * CLX_EXACT_DIGITS),
              CLAST_E_FORMAT, "the checkpoint's cell or energy is of another configuration");
    for (int k = 0; s->cell != NULL && k < CLX_SAVED_CELL; ++k) {
        const bool is_side = k < 3 || (k >= 6 && k < 9);
        CLX_CHECK(isfinite(s->cell[k]) && (!is_side || s->cell[k] > 0.0), CLAST_E_FORMAT,
                  "the checkpoint's cell is none");
    }
    if (s->cell != NULL) {
        read_cell(s->cell, dem->cell);
    }
    if (s->energy != NULL) {
        CLX_TRY(restore_energy(dem->energy, s));
    }
    CLX_TRY(restore_walls(dem, s));
done:
    return status;
}

clast_status clx_dem_save(const clast_dem *dem, clx_dem_saved *saved)
{
    clast_status status = CLAST_OK;
    const clx_neighbour_list *l = &dem->list;
    clx_dem_saved s = {.step = dem->step,
                       .n_refresh = l->n_refresh,
                       .n_grain = dem->n_grain,
                       .n_known = l->n_known,
                       .n_pair = l->n_pair,
                       .warm_start_width = WARM_START,
                       .is_due = l->is_due,
                       .verified = {(double)dem->verified.n, (double)dem->verified.n_off,
                                    (double)dem->verified.n_bad, dem->verified.worst}};
    CLX_TRY(clx_alloc(&s.shape, s.n_grain, sizeof *s.shape));
    CLX_TRY(clx_alloc(&s.grain, s.n_grain * CLX_SAVED_GRAIN, sizeof *s.grain));
    CLX_TRY(clx_alloc(&s.anchor, s.n_known * CLX_SAVED_ANCHOR, sizeof *s.anchor));
    CLX_TRY(clx_alloc(&s.limit, s.n_known, sizeof *s.limit));
    CLX_TRY(clx_alloc(&s.id, s.n_pair * CLX_SAVED_ID, sizeof *s.id));
    CLX_TRY(clx_alloc(&s.pair, s.n_pair * CLX_SAVED_PAIR, sizeof *s.pair));
    for (int64_t i = 0; i < s.n_grain; ++i) {
        s.shape[i] = dem->grain[i].shape;
        write_grain(dem, i, &s.grain[i * CLX_SAVED_GRAIN]);
    }
    for (int64_t i = 0; i < s.n_known; ++i) {
        memcpy(&s.anchor[i * CLX_SAVED_ANCHOR], &l->anchor[i], CLX_SAVED_ANCHOR * sizeof(double));
        s.limit[i] = l->limit[i];
    }
    for (int64_t k = 0; k < s.n_pair; ++k) {
        write_pair(&l->pair[k], &s.id[k * CLX_SAVED_ID], &s.pair[k * CLX_SAVED_PAIR]);
    }
    if (!dem->all_round) {
        CLX_TRY(clx_alloc(&s.warm_start, s.n_pair * WARM_START, 1)); // zero for pairs without one
        for (int64_t k = 0; k < s.n_pair; ++k) {
            if (l->pair[k].slot != 0) {
                memcpy(s.warm_start + k * WARM_START, &l->warm_start[l->pair[k].slot].record,
                       WARM_START);
            }
        }
    }
    if (dem->law.is_exact) {
        CLX_TRY(clx_alloc(&s.held, s.n_grain, sizeof *s.held));
        for (int64_t i = 0; i < s.n_grain; ++i) {
            s.held[i] = dem->grain[i].held;
        }
    }
    if (dem->law.has_history) {
        CLX_TRY(clx_alloc(&s.history, CLX_SAVED_HISTORY * s.n_pair, sizeof *s.history));
        if (s.n_pair > 0) {
            memcpy(s.history, l->history, (size_t)s.n_pair * sizeof *l->history);
        }
    }
    CLX_TRY(save_extras(dem, &s));
    *saved = s;
    s = (clx_dem_saved){0};
done:
    clx_dem_saved_free(&s);
    return status;
}

static clast_status read_grains(clast_dem *dem, const clx_dem_saved *s)
{
    clast_status status = CLAST_OK;
    for (int64_t i = 0; i < s->n_grain; ++i) {
        const double *in = &s->grain[i * CLX_SAVED_GRAIN];
        clast_dem_grain g = {.shape = s->shape[i], .scale = in[16], .density = in[17]};
        v3_copy(g.position, in);
        v3_copy(g.velocity, in + 3);
        v3_copy(g.angular_velocity, in + 6);
        memcpy(g.orientation, in + 9, sizeof g.orientation);
        CLX_TRY(clast_dem_add_grains(dem, 1, &g));
        v3_copy(dem->motion[i].angular, in + 13);
        dem->travel[i] = in[18];
        CLX_CHECK(isfinite(in[13]) && isfinite(in[14]) && isfinite(in[15]) && in[18] >= 0.0 &&
                      isfinite(in[18]),
                  CLAST_E_FORMAT, "grain %lld of the checkpoint: momentum or path is not finite",
                  (long long)i);
    }
done:
    if (status == CLAST_E_USAGE || status == CLAST_E_GEOMETRY) {
        clx_fail_prefix("checkpoint");
        status = CLAST_E_FORMAT;
    }
    return status;
}

static clast_status read_pair(const clast_dem *dem, const clx_dem_saved *s, int64_t k)
{
    clast_status status = CLAST_OK;
    const int32_t *id = &s->id[k * CLX_SAVED_ID];
    const double *in = &s->pair[k * CLX_SAVED_PAIR];
    const int32_t n_wall = dem->n_wall + (dem->container != NULL ? dem->container->n_tri : 0);
    int same = 0; // of a, b and b's image, by which pairs are in order
    while (k > 0 && same < 4 && id[same] == id[same - CLX_SAVED_ID]) {
        ++same;
    }
    const bool is_next = k == 0 || (same < 4 && id[same] > id[same - CLX_SAVED_ID]);
    CLX_CHECK(id[0] >= 0 && id[0] < dem->n_item && id[1] < dem->n_item && id[1] >= -n_wall &&
                  (id[1] < 0 || id[1] > id[0]) && is_next,
              CLAST_E_FORMAT, "pair %lld of the checkpoint joins %d and %d", (long long)k, id[0],
              id[1]);
    CLX_CHECK(!isnan(in[0]) && isfinite(in[1]) && isfinite(in[2]) && isfinite(in[3]),
              CLAST_E_FORMAT, "pair %lld of the checkpoint is not finite", (long long)k);
    clx_dem_pair *pair = &dem->list.pair[k];
    *pair = (clx_dem_pair){.a = id[0],
                           .b = id[1],
                           .period = {(int16_t)id[2], (int16_t)id[3]},
                           .touches = id[4] != 0,
                           .active_from = in[0]};
    memcpy(pair->slide, in + 1, sizeof pair->slide);
done:
    return status;
}

static clast_status read_warm_starts(clx_neighbour_list *l, const clx_dem_saved *s)
{
    clast_status status = CLAST_OK;
    for (int64_t k = 0; k < s->n_pair; ++k) {
        const uint8_t *bytes = s->warm_start + k * WARM_START;
        bool is_empty = true;
        for (int i = 0; is_empty && i < WARM_START; ++i) {
            is_empty = bytes[i] == 0;
        }
        if (!is_empty) {
            CLX_TRY(clx_neighbour_list_assign_slot(l, &l->pair[k]));
            memcpy(&l->warm_start[l->pair[k].slot].record, bytes, WARM_START);
            l->pair[k].kind = l->warm_start[l->pair[k].slot].record.kind & 3U;
        }
    }
done:
    return status;
}

/// What only some laws need: stability loads of exact steps; contact histories of laws with rolling
/// springs or a fluid's restitution.
static clast_status read_histories(clast_dem *dem, const clx_dem_saved *s)
{
    clast_status status = CLAST_OK;
    clx_neighbour_list *l = &dem->list;
    CLX_CHECK(dem->law.is_exact == (s->held != NULL) &&
                  dem->law.has_history == (s->history != NULL),
              CLAST_E_FORMAT, "the checkpoint is of another contact law");
    for (int64_t i = 0; s->held != NULL && i < s->n_grain; ++i) {
        CLX_CHECK(s->held[i] >= 0.0 && isfinite(s->held[i]), CLAST_E_FORMAT,
                  "grain %lld of the checkpoint: its load is not a number", (long long)i);
        dem->grain[i].held = s->held[i];
    }
    if (s->history != NULL) {
        CLX_TRY(clx_grow(&l->history, &l->history_capacity, s->n_pair + 1, sizeof *l->history));
        memcpy(l->history, s->history, (size_t)s->n_pair * sizeof *l->history);
    }
    for (int64_t k = 0; s->history != NULL && k < CLX_SAVED_HISTORY * s->n_pair; ++k) {
        CLX_CHECK(isfinite(s->history[k]), CLAST_E_FORMAT,
                  "pair %lld of the checkpoint is not finite", (long long)(k / CLX_SAVED_HISTORY));
    }
done:
    return status;
}

static clast_status read_pairs(clast_dem *dem, const clx_dem_saved *s)
{
    clast_status status = CLAST_OK;
    clx_neighbour_list *l = &dem->list;
    CLX_TRY(clx_neighbour_list_reserve(l, dem->n_item));
    CLX_TRY(clx_grow_lines(&l->pair, &l->capacity, s->n_pair + 1, sizeof *l->pair));
    for (int64_t k = 0; k < s->n_pair; ++k) {
        CLX_TRY(read_pair(dem, s, k));
    }
    int64_t k = 0;
    for (int32_t i = 0; dem->n_item > 0 && i <= dem->n_item; ++i) {
        while (k < s->n_pair && l->pair[k].a < i) {
            ++k;
        }
        l->begin[i] = k;
    }
    l->n_pair = s->n_pair;
    if (s->warm_start != NULL) {
        CLX_CHECK(!dem->all_round && s->warm_start_width == WARM_START, CLAST_E_FORMAT,
                  "the checkpoint's warm starts are of another version, or of other shapes");
        CLX_TRY(read_warm_starts(l, s));
    }
    dem->inner.is_due = true;
done:
    return status;
}

clast_status clx_dem_restore(clast_dem *dem, const clx_dem_saved *s)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(dem->n_grain == 0 && s->n_grain <= INT32_MAX && s->step >= 0, CLAST_E_FORMAT,
              "the checkpoint does not fit");
    CLX_TRY(read_grains(dem, s));
    CLX_TRY(restore_extras(dem, s));
    CLX_CHECK(s->n_known >= 0 && s->n_known <= dem->n_item, CLAST_E_FORMAT,
              "the checkpoint knows %lld items of %d", (long long)s->n_known, dem->n_item);
    CLX_TRY(read_pairs(dem, s));
    CLX_TRY(read_histories(dem, s));
    for (int64_t i = 0; i < s->n_known; ++i) {
        memcpy(&dem->list.anchor[i], &s->anchor[i * CLX_SAVED_ANCHOR],
               CLX_SAVED_ANCHOR * sizeof(double));
        bool is_whole = true;
        for (int k = 0; k < CLX_SAVED_ANCHOR; ++k) { // a margin left is seen by a comparison
            is_whole = is_whole && isfinite(s->anchor[i * CLX_SAVED_ANCHOR + k]);
        }
        CLX_CHECK(is_whole, CLAST_E_FORMAT, "anchor %lld of the checkpoint is not finite",
                  (long long)i);
    }
    for (int64_t i = 0; i < s->n_known; ++i) {
        // checked in the first step where it is not known; the bound of a rotation is wider than
        // its path, so that checking earlier than the run that was not stopped may call for another
        // refresh
        dem->list.limit[i] = s->limit != NULL ? s->limit[i] : -(double)INFINITY;
        CLX_CHECK(!isnan(dem->list.limit[i]), CLAST_E_FORMAT,
                  "limit %lld of the checkpoint is not a number", (long long)i);
    }
    dem->list.n_known = (int32_t)s->n_known;
    dem->list.is_due = s->is_due;
    dem->list.n_refresh = s->n_refresh;
    dem->step = s->step;
    for (int k = 0; k < 4; ++k) {
        CLX_CHECK(s->verified[k] >= 0.0 && s->verified[k] < 9e15, CLAST_E_FORMAT,
                  "the checkpoint's compared contacts are not counted");
    }
    dem->verified = (clast_dem_verification){(int64_t)s->verified[0], (int64_t)s->verified[1],
                                             (int64_t)s->verified[2], s->verified[3]};
    dem->n_started = dem->n_grain;
done:
    return status;
}
