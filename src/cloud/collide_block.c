// Events in one well-mixed block, kind by kind. [docs/theory/agglomeration.md section 2]
#include "cloud/collide.h"

#include "base/status.h"
#include "cloud/box.h"
#include "cloud/kernel_range.h"
#include "cloud/settling_pair.h"
#include <math.h>

/// The kind of a particle, without members and settling speed.
static clx_kind kind_of(const clx_block *b, int64_t i)
{
    const clast_population *p = b->population;
    const double weight = p->weight != NULL ? p->weight[i] : 1.0;
    clx_kind kind = {.as.monomers = (double)p->monomers[i], .weight = weight};
    clast_collider *seen = &kind.as;
    if ((b->needs & CLAST_NEEDS_RADIUS) != 0) {
        seen->radius = p->radius[i];
    }
    if ((b->needs & CLAST_NEEDS_MASS) != 0) {
        seen->mass = p->mass[i];
    }
    for (int32_t k = 0; k < p->dimension && (b->needs & CLAST_NEEDS_VELOCITY) != 0; ++k) {
        seen->velocity[k] = p->velocity[i * p->dimension + k];
    }
    if ((b->needs & CLAST_NEEDS_SPEED_RMS) != 0 && p->speed_rms != NULL) {
        seen->speed_rms = p->speed_rms[i];
    }
    return kind;
}

static void let_settle(const clx_block *b, clx_kind *kind)
{
    if ((b->needs & CLAST_NEEDS_SETTLING) != 0) {
        kind->as.settling_speed = clast_kernel_settling_speed(b->medium, &kind->as);
    }
    if (b->flows) {
        kind->change = clx_box_rate(b->box, (int64_t)kind->as.monomers);
    }
}

clx_kind clx_block_as_seen(const clx_block *b, int64_t i)
{
    clx_kind kind = kind_of(b, i);
    let_settle(b, &kind);
    return kind;
}

static bool is_same(const clx_kind *kind, const clx_kind *other)
{
    const clast_collider *a = &kind->as;
    const clast_collider *b = &other->as;
    return kind->weight == other->weight && a->monomers == b->monomers && a->radius == b->radius &&
           a->mass == b->mass && a->velocity[0] == b->velocity[0] &&
           a->velocity[1] == b->velocity[1] && a->velocity[2] == b->velocity[2] &&
           a->speed_rms == b->speed_rms;
}

/// Number of the kind that equals `seen`; n_kind when there is none.
static int64_t find_kind(const clx_block *b, const clx_kind *seen)
{
    int64_t k = 0;
    while (k < b->n_kind && !is_same(&b->kind[k], seen)) {
        ++k;
    }
    return k;
}

static void append_particle(clx_block *b, int64_t kind, int64_t particle)
{
    CLAST_ASSERT(kind >= 0 && particle >= 0);
    b->next[particle] = b->kind[kind].n > 0 ? b->kind[kind].head : -1;
    b->kind[kind].head = particle;
    ++b->kind[kind].n;
}

static int64_t draw_particle(clx_block *b, int64_t kind)
{
    CLAST_ASSERT(b->kind[kind].n > 0 && b->kind[kind].head >= 0);
    const int64_t particle = b->kind[kind].head;
    b->kind[kind].head = b->next[particle];
    --b->kind[kind].n;
    return particle;
}

bool clx_block_sort(clx_block *b, int64_t limit)
{
    b->n_kind = 0;
    for (int64_t m = 0; m < b->n; ++m) {
        const clx_kind seen = kind_of(b, b->member[m]);
        const int64_t k = find_kind(b, &seen);
        if (k == b->n_kind) {
            if (k == limit) {
                return false;
            }
            b->kind[b->n_kind++] = seen;
        }
        append_particle(b, k, b->member[m]);
    }
    for (int64_t k = 0; k < b->n_kind; ++k) {
        let_settle(b, &b->kind[k]);
    }
    return true;
}

static double pair_rate(const clx_block *b, const clast_collider *x, const clast_collider *y)
{
    const clast_collide_config *c = b->config;
    const double value = clx_kernel_sum(c->kernel, b->medium, x, y);
    return c->sticking.law == CLAST_STICKING_CONSTANT ? value
                                                      : value * clx_sticking_of(c, b->medium, x, y);
}

/// Rate of a pair over scale.
double clx_block_kernel(const clx_block *b, const clx_kind *x, const clx_kind *y)
{
    const double most = x->weight > y->weight ? x->weight : y->weight; // fmax is a call
    return most * pair_rate(b, &x->as, &y->as);
}

/// Twice the rate, over scale, at which the particles of one parcel collide: rows count pairs
/// twice. A parcel is always in its own block, so its rate has no share of rate_factor.
double clx_block_self_rate(const clx_block *b, const clx_kind *kind)
{
    if (!b->config->self_collisions || kind->weight <= 1.0) {
        return 0.0;
    }
    return 2.0 * (kind->weight - 1.0) / b->rate_factor * pair_rate(b, &kind->as, &kind->as);
}

int clx_block_stick(clx_block *b, int64_t i, int64_t j, int64_t live[2])
{
    const double before = b->n_real;
    clast_collider pair[2];
    int n_live = 1;
    if (b->box != NULL) {
        clx_box_watch(b->box, b->population->monomers[i], -1);
        clx_box_watch(b->box, b->population->monomers[j], -1);
    }
    if (b->ranges != 0) { // as they are before they stick
        pair[0] = clx_population_collider(b->population, i);
        pair[1] = clx_population_collider(b->population, j);
    }
    if (i == j) {
        clx_population_pair_up(b->population, b->config, i, &b->n_real);
        live[0] = i;
    } else {
        n_live = clx_population_stick(b->population, b->config, i, j, live, &b->n_real);
    }
    if (b->box != NULL) {
        clx_box_watch(b->box, b->population->monomers[live[0]], 1);
    }
    if (b->box != NULL && b->box->changes) { // equal sizes are equal to the last bit: one kind
        clx_box_set(b->box, live[0], b->population->monomers[live[0]]);
    }
    if (b->ranges != 0) {
        clx_range_add(b->ranges, b->config, b->medium, pair, b->n_real - before, &b->range);
    }
    return n_live;
}

static double row_of(const clx_block *b, int64_t k)
{
    CLAST_ASSERT(k >= 0 && k < b->n_kind);
    double row = clx_block_self_rate(b, &b->kind[k]);
    for (int64_t l = 0; l < b->n_kind; ++l) {
        row += clx_block_kernel(b, &b->kind[k], &b->kind[l]) *
               (double)(b->kind[l].n - (l == k ? 1 : 0));
    }
    return row;
}

static double total_of(const clx_block *b)
{
    double total = 0.0;
    for (int64_t k = 0; k < b->n_kind; ++k) {
        total += (double)b->kind[k].n * b->kind[k].row;
    }
    return total;
}

double clx_block_rates(clx_block *b)
{
    for (int64_t k = 0; k < b->n_kind; ++k) {
        b->kind[k].row = row_of(b, k);
    }
    return total_of(b);
}

/// The kind at `at` of the sum of n rate, their row or their change. Rounding may pass the end:
/// then the last one with a chance; -1 without any.
static int64_t pick_kind(const clx_block *b, bool by_change, double at)
{
    int64_t last = -1;
    for (int64_t k = 0; k < b->n_kind; ++k) {
        const clx_kind *kind = &b->kind[k];
        const double chance = (double)kind->n * (by_change ? kind->change : kind->row);
        if (chance > 0.0) {
            last = k;
            at -= chance;
            if (at < 0.0) {
                break;
            }
        }
    }
    return last;
}

/// First kind of a colliding pair.
static int64_t pick_first(clx_block *b, double total)
{
    return pick_kind(b, false, clx_rng_uniform(b->rng) * total);
}

enum { WITHIN = -2 }; ///< in place of a second kind: the parcel's own particles

/// Second kind: chance kernel x number of other particles of that kind.
static int64_t pick_second(clx_block *b, int64_t first)
{
    const double within = clx_block_self_rate(b, &b->kind[first]);
    double at = clx_rng_uniform(b->rng) * b->kind[first].row - within;
    int64_t last = within > 0.0 ? WITHIN : -1;
    if (at < 0.0) {
        return last;
    }
    for (int64_t k = 0; k < b->n_kind; ++k) {
        const int64_t n = b->kind[k].n - (k == first ? 1 : 0);
        const double chance =
            n > 0 ? (double)n * clx_block_kernel(b, &b->kind[first], &b->kind[k]) : 0.0;
        if (chance > 0.0) {
            last = k;
            at -= chance;
            if (at < 0.0) {
                break;
            }
        }
    }
    return last;
}

/// Takes one particle of a kind out of all rows.
static void unload(clx_block *b, const clx_kind *gone)
{
    for (int64_t k = 0; k < b->n_kind; ++k) {
        b->kind[k].row = fmax(0.0, b->kind[k].row - clx_block_kernel(b, &b->kind[k], gone));
    }
}

static void drop_if_empty(clx_block *b, int64_t kind)
{
    CLAST_ASSERT(kind >= 0 && kind < b->n_kind);
    if (b->kind[kind].n == 0) {
        b->kind[kind] = b->kind[--b->n_kind];
    }
}

/// Puts a new aggregate into the block's kinds and rows.
static void load(clx_block *b, int64_t particle)
{
    const clx_kind seen = clx_block_as_seen(b, particle);
    for (int64_t k = 0; k < b->n_kind; ++k) {
        b->kind[k].row += clx_block_kernel(b, &b->kind[k], &seen);
    }
    const int64_t kind = find_kind(b, &seen);
    if (kind == b->n_kind) {
        b->kind[b->n_kind++] = seen;
        append_particle(b, kind, particle);
        b->kind[kind].row = row_of(b, kind);
    } else { // its row already counts the others of its kind, not itself: the loop above added one
        append_particle(b, kind, particle);
    }
}

static void one_self_event(clx_block *b, int64_t kind)
{
    const clx_kind gone = b->kind[kind];
    const int64_t i = draw_particle(b, kind);
    drop_if_empty(b, kind);
    unload(b, &gone);
    int64_t live[2];
    (void)clx_block_stick(b, i, i, live);
    load(b, i);
    ++b->n_event;
}

static bool one_event(clx_block *b, double total)
{
    const int64_t first = pick_first(b, total);
    const int64_t second = first >= 0 ? pick_second(b, first) : -1;
    if (second == WITHIN) {
        one_self_event(b, first);
        return true;
    }
    if (second < 0) {
        return false;
    }
    const clx_kind gone[2] = {b->kind[first], b->kind[second]};
    const int64_t i = draw_particle(b, first);
    const int64_t j = draw_particle(b, second);
    drop_if_empty(b, first > second ? first : second); // the higher number first: the lower stays
    if (first != second) {
        drop_if_empty(b, first > second ? second : first);
    }
    unload(b, &gone[0]);
    unload(b, &gone[1]);
    int64_t live[2];
    const int n_live = clx_block_stick(b, i, j, live);
    for (int k = 0; k < n_live; ++k) {
        load(b, live[k]);
    }
    ++b->n_event;
    return true;
}

/// Rate at which particles settle, break and come in here.
static double changes_of(const clx_block *b)
{
    double rate = b->flows ? clx_box_source(b->box) : 0.0;
    for (int64_t k = 0; k < b->n_kind && b->flows; ++k) {
        rate += (double)b->kind[k].n * b->kind[k].change;
    }
    return rate;
}

/// A particle settles, breaks or comes in.
static void one_change(clx_block *b, double total)
{
    int64_t live[CLX_MOST_FRAGMENTS];
    int n_live = 0;
    const double at = clx_rng_uniform(b->rng) * total - clx_box_source(b->box);
    const int64_t kind = at < 0.0 ? -1 : pick_kind(b, true, at);
    if (kind < 0) {
        n_live = clx_box_source(b->box) > 0.0 ? clx_box_enter(b->box, b->rng, live) : 0;
    } else {
        const clx_kind gone = b->kind[kind];
        const int64_t i = draw_particle(b, kind);
        drop_if_empty(b, kind);
        unload(b, &gone);
        n_live = clx_box_change(b->box, i, b->rng, live);
    }
    for (int k = 0; k < n_live; ++k) {
        load(b, live[k]);
    }
}

/// One event at a time after the block began; false where none is left.
static bool one_of_both(clx_block *b, double total, double change, double time)
{
    const double both = 0.5 * b->scale * total + change;
    if (b->box != NULL) {
        b->box->now = b->box->time + time;
    }
    if (change > 0.0 && clx_rng_uniform(b->rng) * both < change) {
        one_change(b, change);
        return true;
    }
    return one_event(b, total) || change > 0.0;
}

static void next_events(clx_block *b, double dt)
{
    enum { LEAST_REFRESH = 64 };
    double total = total_of(b);
    double change = changes_of(b);
    double time = 0.0;
    int64_t since = 0;
    while (total > 0.0 || change > 0.0) {
        time -= log(clx_rng_uniform(b->rng)) / (0.5 * b->scale * total + change);
        if (time > dt || (b->flows && !clx_box_reserve(b)) ||
            !one_of_both(b, total, change, time)) {
            return;
        }
        change = changes_of(b);
        // rows drift by rounding as events go; summing them anew costs as much as a few events
        if (++since >= b->n_kind + LEAST_REFRESH) {
            total = clx_block_rates(b);
            since = 0;
        } else {
            total = total_of(b);
        }
    }
}

/// Lists the particles of each kind; start [n_kind] are the ends of the lists after this, kept in
/// kind.head.
static void freeze(clx_block *b)
{
    int64_t at = 0;
    for (int64_t k = 0; k < b->n_kind; ++k) {
        const int64_t begin = at;
        for (int64_t i = b->kind[k].head; at - begin < b->kind[k].n; i = b->next[i]) {
            b->frozen[at++] = i;
        }
        b->kind[k].head = begin;
    }
}

int64_t clx_population_owner(const clast_population *p, int64_t i)
{
    CLAST_ASSERT(i >= 0 && i < p->n);
    while (p->owner[i] != i) {
        i = p->owner[i];
    }
    return i;
}

static int64_t pick_frozen(clx_block *b, int64_t kind)
{
    CLAST_ASSERT(kind >= 0 && kind < b->n_kind && b->kind[kind].n > 0);
    const int64_t at = b->kind[kind].head + clx_rng_below(b->rng, b->kind[kind].n);
    return clx_population_owner(b->population, b->frozen[at]);
}

/// One event of the frozen rates; a particle that has merged meanwhile stands for its aggregate.
static bool frozen_event(clx_block *b, double total)
{
    enum { MOST_TRIES = 1000 };
    for (int tries = 0; tries < MOST_TRIES; ++tries) {
        int64_t live[2];
        const int64_t first = pick_first(b, total);
        const int64_t second = first >= 0 ? pick_second(b, first) : -1;
        if (second < 0 && second != WITHIN) {
            return false;
        }
        const int64_t i = pick_frozen(b, first);
        const int64_t j = second != WITHIN ? pick_frozen(b, second) : i;
        if (second == WITHIN || i != j) {
            (void)clx_block_stick(b, i, j, live);
            ++b->n_event;
            return true;
        }
    }
    return false;
}

void clx_block_drop_dead(clx_block *b)
{
    int64_t n = 0;
    for (int64_t m = 0; m < b->n; ++m) {
        const int64_t i = b->member[m];
        if (b->population->monomers[i] > 0) { // the dead go behind: the cell's list keeps each once
            b->member[m] = b->member[n];
            b->member[n++] = i;
        }
    }
    b->n = n;
}

/// Poisson number of collisions of a sub-step.
static void poisson_events(clx_block *b, double total, double delta)
{
    const int64_t n_event = clx_rng_poisson(b->rng, 0.5 * b->scale * total * delta);
    if (n_event > 0) {
        freeze(b);
        for (int64_t e = 0; e < n_event && frozen_event(b, total); ++e) {
        }
        clx_block_drop_dead(b);
        (void)clx_block_sort(b, b->n);
    }
}

/// The particles of a box settle, break and come in for a sub-step that begins `time` after dt did.
static void poisson_flow(clx_block *b, clx_box *box, double time, double delta)
{
    box->time += time;
    clx_box_flow(b, delta);
    box->time -= time;
    (void)clx_block_sort(b, b->n);
}

static void poisson(clx_block *b, double dt)
{
    clx_box *flowing = b->flows ? b->box : NULL;
    double left = dt;
    while (left > 0.0 && (b->n > 0 || flowing != NULL)) {
        const double total = clx_block_rates(b);
        double busiest = 0.0;
        for (int64_t k = 0; k < b->n_kind; ++k) {
            busiest = fmax(busiest, b->kind[k].row);
        }
        double delta = total > 0.0 ? fmin(left, b->config->leap / (b->scale * busiest)) : left;
        if (flowing != NULL) {
            delta = fmin(delta, clx_box_bound(b, b->config->leap));
        }
        if (b->box != NULL) {
            b->box->now = b->box->time + dt - left;
        }
        if (total > 0.0) {
            poisson_events(b, total, delta);
        }
        if (flowing != NULL) {
            poisson_flow(b, flowing, dt - left, delta);
            delta = flowing->status == CLAST_OK ? delta : left;
        }
        left -= delta;
    }
}

void clx_block_evolve(clx_block *block, double dt)
{
    if (block->config->collisions == CLAST_COLLISIONS_POISSON) {
        poisson(block, dt);
    } else {
        next_events(block, dt);
    }
}
