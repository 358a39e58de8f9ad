// A box's particles: how they settle, break and come in, and its books. [docs/theory/
// agglomeration.md section 6]
#include "cloud/box.h"

#include "base/alloc.h"
#include "cloud/kernel_range.h"
#include "cloud/sectional.h"
#include <math.h>
#include <string.h>

static const double GEL_SHARE = 1e-3; ///< of the mass at the start, as in the sectional solver
enum { MOST_PARTICLES = 20000000 };

static clast_status grow(clx_box *s, int64_t n)
{
    clast_status status = CLAST_OK;
    clast_population *p = &s->population;
    int64_t **const list[] = {&p->monomers, &p->owner,  &s->free_slot, &s->member,
                              &s->next,     &s->frozen, &s->n_kind};
    double **const value[] = {&p->radius, &p->mass, &s->born};
    CLX_CHECK(n <= MOST_PARTICLES, CLAST_E_LIMIT,
              "breakage and sources made more than %d particles by %s; take fewer --particles, a "
              "shorter --duration or a larger --size-min",
              MOST_PARTICLES, clx_unit_text(s->now, "s"));
    for (size_t k = 0; k < sizeof list / sizeof list[0]; ++k) {
        CLX_TRY(clx_realloc(list[k], n, sizeof **list[k]));
    }
    for (size_t k = 0; k < sizeof value / sizeof value[0]; ++k) {
        CLX_TRY(clx_realloc(value[k], n, sizeof **value[k]));
    }
    CLX_TRY(clx_realloc(&s->kind, n, sizeof *s->kind));
    s->capacity = n;
done:
    return status;
}

clast_status clx_box_begin(clx_box *s, int64_t n)
{
    const clast_spectrum_config *c = s->config;
    s->changes = c->breakage_rate > 0.0 || c->source > 0.0 || c->settling_depth > 0.0;
    s->n_fragment = c->breakage_rate > 0.0 ? clx_fragments_count(c) : 0;
    s->ranges = clx_ranges_of(&s->collide) |
                (c->settling_depth > 0.0 ? clx_ranges_of_settling(&s->collide) : 0);
    s->population.dimension = 3;
    return grow(s, s->changes ? n + n / 4 + CLX_MOST_FRAGMENTS : n);
}

void clx_box_end(clx_box *s)
{
    CLX_FREE(s->population.monomers, s->population.radius, s->population.mass, s->population.owner,
             s->free_slot, s->member, s->next, s->frozen, s->n_kind, s->kind, s->born);
    *s = (clx_box){0};
}

void clx_box_set(clx_box *s, int64_t i, int64_t m)
{
    const clast_collider seen = clx_collider_of_size(&s->collide, (double)m * s->unit);
    s->population.monomers[i] = m;
    s->population.radius[i] = seen.radius;
    s->population.mass[i] = seen.mass;
    s->population.owner[i] = i;
}

void clx_box_watch(clx_box *s, int64_t m, int sign)
{
    if ((double)m > s->gel_size) {
        s->above += sign * m;
        if (isnan(s->gel_time) && (double)s->above >= GEL_SHARE * (double)s->start) {
            s->gel_time = s->now;
        }
    }
}

void clx_box_restart(clx_box *s)
{
    const clast_population *p = &s->population;
    s->start = s->added = s->settled = s->above = 0;
    s->n_free = 0;
    s->time = s->now = 0.0;
    s->gel_time = (double)NAN;
    for (int64_t i = 0; i < p->n; ++i) {
        s->start += p->monomers[i];
    }
    for (int64_t i = 0; i < p->n; ++i) {
        clx_box_watch(s, p->monomers[i], 1);
    }
}

static double sink_of(const clx_box *s, int64_t m)
{
    if (!(s->config->settling_depth > 0.0)) {
        return 0.0;
    }
    const clast_collider seen = clx_collider_of_size(&s->collide, (double)m * s->unit);
    return fabs(clast_kernel_settling_speed(&s->collide.medium, &seen)) / s->config->settling_depth;
}

/// The smallest size does not break.
static double breakage_of(const clx_box *s, int64_t m)
{
    const clast_spectrum_config *c = s->config;
    return m > 1 && c->breakage_rate > 0.0
               ? c->breakage_rate * pow((double)m * s->unit, c->breakage_exponent)
               : 0.0;
}

double clx_box_rate(const clx_box *s, int64_t m)
{
    return sink_of(s, m) + breakage_of(s, m);
}

double clx_box_source(const clx_box *s)
{
    return s->config->source * s->volume;
}

void clx_box_fit(clx_block *b)
{
    b->member = b->box->member;
    b->next = b->box->next;
    b->frozen = b->box->frozen;
    b->kind = b->box->kind;
}

/// Room for `need` particles more; with may_reuse in the slots of all that are dead.
static bool reserve(clx_block *b, int64_t need, bool may_reuse)
{
    clx_box *s = b->box;
    const clast_population *p = &s->population;
    enum { LEAST_SHARE = 8 }; // reusing fewer would look for them too often
    if (s->status != CLAST_OK || s->n_free + s->capacity - p->n >= need) {
        return s->status == CLAST_OK;
    }
    s->n_free = may_reuse ? 0 : s->n_free;
    for (int64_t i = p->n - 1; i >= 0 && may_reuse; --i) {
        if (p->monomers[i] == 0) {
            s->free_slot[s->n_free++] = i;
        }
    }
    const int64_t used = p->n - s->n_free;
    const bool fits = s->n_free + s->capacity - p->n >= need;
    if (!fits || (s->n_free < s->capacity / LEAST_SHARE && s->capacity < MOST_PARTICLES)) {
        const int64_t wanted = s->capacity + s->capacity / 2 + need;
        s->status = grow(
            s, wanted > MOST_PARTICLES && used + need <= MOST_PARTICLES ? MOST_PARTICLES : wanted);
        clx_box_fit(b);
    }
    return s->status == CLAST_OK;
}

bool clx_box_reserve(clx_block *b)
{
    return reserve(b, CLX_MOST_FRAGMENTS, true);
}

static int64_t new_slot(clx_box *s)
{
    return s->n_free > 0 ? s->free_slot[--s->n_free] : s->population.n++;
}

int clx_box_enter(clx_box *s, clx_rng *rng, int64_t live[1])
{
    const double size = s->config->source_size / s->unit;
    const double whole = floor(size);
    const bool is_whole = size - whole < 1e-9 * size;
    const int64_t m = (int64_t)whole + (!is_whole && clx_rng_uniform(rng) < size - whole ? 1 : 0);
    if (m == 0) {
        return 0;
    }
    live[0] = new_slot(s);
    clx_box_set(s, live[0], m);
    s->added += m;
    clx_box_watch(s, m, 1);
    return 1;
}

int clx_box_change(clx_box *s, int64_t i, clx_rng *rng, int64_t live[CLX_MOST_FRAGMENTS])
{
    const int64_t m = s->population.monomers[i];
    const double sink = sink_of(s, m);
    int64_t part[CLX_MOST_FRAGMENTS];
    int n = 0;
    clx_box_watch(s, m, -1);
    if (clx_rng_uniform(rng) * (sink + breakage_of(s, m)) < sink) {
        s->settled += m;
        s->population.monomers[i] = 0;
        return 0;
    }
    clx_fragments_draw(s->config, s->n_fragment, m, rng, part);
    for (int32_t k = 0; k < s->n_fragment; ++k) {
        if (part[k] > 0) {
            live[n] = n == 0 ? i : new_slot(s);
            clx_box_set(s, live[n++], part[k]);
            clx_box_watch(s, part[k], 1);
        }
    }
    return n;
}

double clx_box_bound(const clx_block *b, double share)
{
    enum { LEAST_NUMBER = 100 }; // of a box that fills
    const clx_box *s = b->box;
    double number = 0.0;
    double mass = 0.0;
    double total = 0.0;
    for (int64_t m = 0; m < b->n; ++m) {
        const int64_t monomers = s->population.monomers[b->member[m]];
        const double rate = clx_box_rate(s, monomers);
        number += rate;
        mass += rate * (double)monomers;
        total += (double)monomers;
    }
    const double rate = fmax((number + clx_box_source(s)) / fmax((double)b->n, LEAST_NUMBER),
                             total > 0.0 ? mass / total : 0.0);
    return rate > 0.0 ? share / rate : (double)INFINITY;
}

static void append(clx_block *b, int64_t i, double born)
{
    b->member[b->n] = i;
    b->box->born[b->n++] = born;
}

static void let_in(clx_block *b, double dt)
{
    clx_box *s = b->box;
    const double rate = clx_box_source(s);
    double t = 0.0;
    while (rate > 0.0) {
        int64_t live[1];
        t -= log(clx_rng_uniform(b->rng)) / rate;
        if (t >= dt || !reserve(b, 1, false)) {
            return;
        }
        s->now = s->time + t;
        if (clx_box_enter(s, b->rng, live) > 0) {
            append(b, live[0], t);
        }
    }
}

/// The life of member m up to dt; its fragments are appended.
static void let_live(clx_block *b, int64_t m, double dt)
{
    clx_box *s = b->box;
    double t = s->born[m];
    for (;;) {
        int64_t live[CLX_MOST_FRAGMENTS];
        const double rate = clx_box_rate(s, s->population.monomers[b->member[m]]);
        t = rate > 0.0 ? t - log(clx_rng_uniform(b->rng)) / rate : dt;
        if (t >= dt || !reserve(b, CLX_MOST_FRAGMENTS, false)) {
            return;
        }
        s->now = s->time + t;
        const int n = clx_box_change(s, b->member[m], b->rng, live);
        for (int k = 1; k < n; ++k) {
            append(b, live[k], t);
        }
        if (n == 0) {
            return;
        }
    }
}

static void drop_dead(clx_block *b)
{
    int64_t n = 0;
    for (int64_t m = 0; m < b->n; ++m) {
        if (b->population->monomers[b->member[m]] > 0) {
            b->member[n++] = b->member[m];
        }
    }
    b->n = n;
}

void clx_box_flow(clx_block *b, double dt)
{
    clx_box *s = b->box;
    if (!reserve(b, b->n / 8 + CLX_MOST_FRAGMENTS, true)) {
        return;
    }
    memset(s->born, 0, (size_t)b->n * sizeof *s->born);
    let_in(b, dt);
    for (int64_t m = 0; m < b->n && s->status == CLAST_OK; ++m) {
        let_live(b, m, dt);
    }
    drop_dead(b);
}
