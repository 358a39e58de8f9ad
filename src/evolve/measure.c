// An evolution in a few numbers, and the hash of its state.
#include "evolve/state.h"

#include "base/alloc.h"
#include "cloud/columns.h"
#include "evolve/walls.h"
#include <math.h>
#include <string.h>

/// FNV-1a, eight bytes at a time.
static void mix(uint64_t *hash, const void *bytes, size_t n)
{
    const unsigned char *at = bytes;
    for (size_t k = 0; k + 8 <= n; k += 8) {
        uint64_t word;
        memcpy(&word, at + k, sizeof word);
        *hash = (*hash ^ word) * UINT64_C(1099511628211);
    }
}

static void mix_numbers(uint64_t *hash, int n, const double *value)
{
    mix(hash, value, (size_t)n * sizeof *value);
}

static uint64_t hash_of(const clast_evolve *e)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (int32_t i = 0; i < e->n_start; ++i) {
        const clx_evolve_grain *g = &e->grain[i];
        const clx_evolve_body *b = &e->body[i];
        const int64_t count[] = {g->kind, g->next, b->first, b->last, b->n, b->state, b->node};
        mix(&hash, count, sizeof count);
        mix_numbers(&hash, 1, &g->scale);
        mix_numbers(&hash, 3, g->position);
        mix_numbers(&hash, 4, g->orientation);
        mix_numbers(&hash, 3, b->x);
        mix_numbers(&hash, 1, &b->time);
        mix_numbers(&hash, 1, &b->mass);
        mix_numbers(&hash, 6, b->second);
        mix_numbers(&hash, 1, &b->speed);
    }
    for (int64_t k = 0; k < e->n_event; ++k) {
        const clx_evolve_event *event = &e->event[k];
        const int64_t count[] = {event->node[0], event->node[1], event->contact[0],
                                 event->contact[1]};
        mix(&hash, count, sizeof count);
        mix_numbers(&hash, 1, &event->time);
        mix_numbers(&hash, 3, event->point);
    }
    return hash;
}

/// What has come to the floor, by mass.
static void measure_deposit(const clast_evolve *e, clast_evolve_result *r)
{
    double mass = 0.0, diameter = 0.0, porosity = 0.0, speed = 0.0, grains = 0.0;
    for (int32_t i = 0; i < e->n_start; ++i) {
        const clx_evolve_body *b = &e->body[i];
        if (b->state == CLX_BODY_ON_FLOOR) {
            mass += b->mass;
            diameter += b->mass * cbrt(6.0 * b->envelope / CLAST_PI);
            porosity += b->mass * (1.0 - b->volume / b->envelope);
            speed += b->mass * b->speed;
            grains += b->mass * b->n;
        }
    }
    const double none = (double)NAN;
    r->deposit_diameter = mass > 0.0 ? diameter / mass : none;
    r->deposit_porosity = mass > 0.0 ? porosity / mass : none;
    r->deposit_speed = mass > 0.0 ? speed / mass : none;
    r->deposit_grains = mass > 0.0 ? grains / mass : none;
}

static void count(const clast_evolve *e, clast_evolve_result *r)
{
    clx_sum mass[CLX_BODY_MERGED + 1] = {{0}};
    clx_sum on_walls = {0};
    int64_t n[CLX_BODY_MERGED + 1] = {0};
    for (int32_t i = 0; i < e->n_start; ++i) {
        const clx_evolve_body *b = &e->body[i];
        clx_sum_add(&mass[b->state], b->mass);
        ++n[b->state];
        if (b->state == CLX_BODY_ON_FLOOR && !clx_walls_is_floor(e->input->domain, b->x)) {
            clx_sum_add(&on_walls, b->mass);
            ++r->n_wall;
        }
        r->grains_most =
            b->state != CLX_BODY_MERGED && b->n > r->grains_most ? b->n : r->grains_most;
    }
    r->n_particle = n[CLX_BODY_IN_FLUID];
    r->n_deposit = n[CLX_BODY_ON_FLOOR];
    r->n_out = n[CLX_BODY_OUT];
    r->mass = e->config->weight * clx_sum_of(&mass[CLX_BODY_IN_FLUID]);
    r->mass_deposit = e->config->weight * clx_sum_of(&mass[CLX_BODY_ON_FLOOR]);
    r->mass_out = e->config->weight * clx_sum_of(&mass[CLX_BODY_OUT]);
    r->mass_wall = e->config->weight * clx_sum_of(&on_walls);
}

/// The greatest Reynolds number at which a body falls, by its envelope's diameter.
static double fall_reynolds(const clast_evolve *e)
{
    const clast_medium *m = &e->collide.medium;
    double most = 0.0;
    for (int32_t i = 0; i < e->n_start; ++i) {
        const clx_evolve_body *b = &e->body[i];
        if (b->state != CLX_BODY_MERGED) {
            most = fmax(most, fabs(b->speed) * cbrt(6.0 * b->envelope / CLAST_PI));
        }
    }
    return most * m->density / m->viscosity;
}

/// Share of the domain that all bodies fill, wherever they are now.
static double volume_fraction(const clast_evolve *e)
{
    double sum = 0.0;
    for (int32_t i = 0; i < e->n_start; ++i) {
        sum += e->body[i].state != CLX_BODY_MERGED ? e->body[i].volume : 0.0;
    }
    return e->config->weight * sum / clast_domain_volume(e->input->domain);
}

clast_status clast_evolve_measure(const clast_evolve *e, clast_evolve_result *result)
{
    CLX_ARGUMENTS(e, result);
    clast_evolve_result r = {.n_start = e->n_start,
                             .n_event = e->n_event,
                             .n_step = (int64_t)e->step,
                             .time = e->time,
                             .mass_start = e->mass_start,
                             .gathered = e->gathered,
                             .gathered_top = e->gathered_top,
                             .is_field_apart = e->is_field_apart,
                             .mass_balance = e->mass_error,
                             .number_balance = e->number_error,
                             .n_cut = e->n_cut,
                             .n_test = e->n_test,
                             .n_unresolved = e->n_unresolved,
                             .volume_fraction = volume_fraction(e),
                             .fall_reynolds = fall_reynolds(e),
                             .fall_reynolds_limit =
                                 e->config->fall == CLAST_FALL_STOKES ? 0.1 : 3e5,
                             .range = e->range,
                             .hash = hash_of(e)};
    if (e->input->points != NULL) {
        (void)clx_cloud_weight_words(e->input->points, "points", "--weight: of all alike",
                                     sizeof r.weight_words, r.weight_words);
    }
    count(e, &r);
    measure_deposit(e, &r);
    clx_evolve_fractal(e, &r.fractal_dimension, &r.fractal_error);
    *result = r;
    return CLAST_OK;
}

void clast_evolve_result_free(clast_evolve_result *result)
{
    if (result != NULL) {
        clx_free(result->folder);
        result->folder = NULL;
    }
}
