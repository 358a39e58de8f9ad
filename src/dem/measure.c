// Sums over a simulation, its grains as an assembly, its digest, and what exploded.
#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/number.h"
#include "dem/dem.h"
#include "dem/pair_force.h"
#include "dem/touch.h"
#include <clast/assembly.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

double clast_dem_mean_height(const clast_dem *dem, double *top)
{
    if (dem == NULL) {
        return (double)NAN;
    }
    double mass = 0.0;
    double moment = 0.0;
    double highest = -INFINITY;
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        const clx_grain *g = &dem->grain[i];
        mass += g->mass;
        moment += g->mass * g->position[2];
        highest = fmax(highest, g->position[2]);
    }
    if (top != NULL) {
        *top = highest;
    }
    return mass > 0.0 ? moment / mass : 0.0;
}

double clast_dem_max_speed(const clast_dem *dem)
{
    if (dem == NULL) {
        return (double)NAN;
    }
    double most = 0.0;
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        most = fmax(most, v3_norm2(dem->grain[i].velocity));
    }
    return sqrt(most);
}

static void add_grain(const clast_dem *dem, int32_t i, clast_dem_measures *m)
{
    const clx_grain *g = &dem->grain[i];
    const clx_motion *motion = &dem->motion[i];
    double momentum[3];
    v3_copy(momentum, motion->angular);
    if (g->kind == CLAST_SHAPE_SPHERE) {
        v3_scale(momentum, 0.4 * g->mass * g->radius * g->radius, g->omega);
    } else if (!dem->config.gyroscopic) {
        double in_body[3];
        double l[3];
        m3_to_local(in_body, dem->grain[i].rotation, g->omega);
        m3_mul(l, dem->body[g->shape].inertia, in_body);
        v3_scale(l, motion->inertia_factor, l);
        m3_to_world(momentum, dem->grain[i].rotation, l);
    }
    m->mass += g->mass;
    m->mean_height += g->mass * g->position[2];
    m->top = fmax(m->top, g->position[2]);
    m->max_speed = fmax(m->max_speed, v3_norm(g->velocity));
    m->kinetic_energy += 0.5 * g->mass * clx_heavier(dem, motion) * v3_norm2(g->velocity) +
                         0.5 * v3_dot(momentum, g->omega);
    m->potential_energy += dem->config.gravity *
                           (g->mass - dem->config.fluid_density * motion->volume) * g->position[2];
    if (dem->body[g->shape].shape.own.is_mixed) {
        double arm[3];
        clx_dem_arm(dem, g, arm);
        m->potential_energy -=
            dem->config.gravity * dem->config.fluid_density * motion->volume * arm[2];
    }
    v3_axpy(m->momentum, m->momentum, g->mass, g->velocity);
}

/// A contact's part; its overlap is worked out afresh.
static void add_pair(const clast_dem *dem, const clx_dem_pair *pair, clast_dem_measures *m)
{
    clx_dem_touch t;
    const clx_grain *a = &dem->grain[clx_item_grain(dem, pair->a)];
    double mass = a->mass;
    double radius = a->round_radius;
    if (!clx_pair_holds(dem, pair, &t)) {
        return;
    }
    const int is_first = clx_is_first_contact(dem, pair) ? 1 : 0;
    if (pair->b >= 0) {
        const clx_grain *b = &dem->grain[clx_item_grain(dem, pair->b)];
        mass = a->mass * b->mass / (a->mass + b->mass);
        radius = a->round_radius * b->round_radius / (a->round_radius + b->round_radius);
        m->n_contact += is_first;
    } else {
        m->n_wall_contact += is_first;
    }
    const double share =
        dem->config.clump_contacts == CLAST_DEM_SHARED ? 1.0 / clx_sub_contacts(dem, pair) : 1.0;
    const double overlap = fmax(0.0, -t.distance);
    m->max_overlap = fmax(m->max_overlap, overlap);
    if (overlap > 0.0) {
        m->elastic_energy += share * clx_law_energy(clx_pair_law(dem, pair), overlap,
                                                    v3_norm(pair->slide), mass, radius);
    }
}

void clast_dem_measure(const clast_dem *dem, clast_dem_measures *measures)
{
    if (dem == NULL || measures == NULL) {
        return;
    }
    clast_dem_measures m = {.step = dem->step,
                            .time = clx_dem_time(dem),
                            .n_grain = dem->n_grain,
                            .top = -INFINITY,
                            .n_listed = dem->list.n_pair,
                            .n_refresh = dem->list.n_refresh,
                            .verified = dem->verified};
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        add_grain(dem, i, &m);
    }
    for (int64_t k = 0; k < dem->list.n_pair; ++k) {
        add_pair(dem, &dem->list.pair[k], &m);
    }
    if (m.mass > 0.0) {
        m.mean_height /= m.mass;
        m.coordination = 2.0 * (double)m.n_contact / m.n_grain;
    }
    *measures = m;
}

void clx_count_contacts(const clast_dem *dem, int32_t *count)
{
    clx_dem_touch t;
    for (int64_t k = 0; k < dem->list.n_pair; ++k) {
        const clx_dem_pair *pair = &dem->list.pair[k];
        if (clx_pair_holds(dem, pair, &t) && clx_is_first_contact(dem, pair)) {
            ++count[clx_item_grain(dem, pair->a)];
            if (pair->b >= 0) {
                ++count[clx_item_grain(dem, pair->b)];
            }
        }
    }
}

/// Position moved into the period about the origin.
static void wrap(const clast_dem *dem, double x[3])
{
    if (dem->cell != NULL) {
        clx_cell_wrap(dem->cell, x);
        return;
    }
    for (int c = 0; c < 2; ++c) {
        if (dem->period[c] > 0.0) {
            x[c] -= dem->period[c] * floor(x[c] / dem->period[c] + 0.5);
        }
    }
}

static clast_status add_contacts(const clast_dem *dem, clast_assembly *out)
{
    clast_status status = CLAST_OK;
    for (int64_t k = 0; k < dem->list.n_pair; ++k) {
        const clx_dem_pair *pair = &dem->list.pair[k];
        clx_dem_touch t;
        double point[3];
        if (pair->b >= 0 && clx_pair_holds(dem, pair, &t) && clx_is_first_contact(dem, pair)) {
            const int32_t a = clx_item_grain(dem, pair->a);
            v3_add(point, dem->grain[a].position, t.arm_a);
            wrap(dem, point);
            CLX_TRY(clast_assembly_add_contact(out, a, clx_item_grain(dem, pair->b), point));
        }
    }
done:
    return status;
}

clast_status clast_dem_assembly(const clast_dem *dem, clast_assembly *out)
{
    CLX_ARGUMENTS(dem, out);
    clast_status status = CLAST_OK;
    clast_assembly made = {.unit = "m"};
    CLX_TRY(clx_assembly_add_shapes(&made, dem->n_body, dem->n_body > 0 ? &dem->body->shape : NULL,
                                    sizeof *dem->body));
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        const clx_grain *g = &dem->grain[i];
        const clx_motion *m = &dem->motion[i];
        double x[3];
        double q[4];
        v3_copy(x, g->position);
        if (dem->body[g->shape].shape.own.is_mixed) {
            double arm[3];
            clx_dem_arm(dem, g, arm);
            v3_add(x, x, arm);
        }
        wrap(dem, x);
        memcpy(q, m->orientation, sizeof q);
        q_unit(q);
        CLX_TRY(clast_assembly_add_grain(&made, g->shape, x, q, g->scale, m->density));
    }
    CLX_TRY(add_contacts(dem, &made));
    *out = made;
    made = (clast_assembly){0};
done:
    clast_assembly_free(&made);
    return status;
}

/// FNV-1a, eight bytes at a time.
static uint64_t mix(uint64_t h, const double *x, int n)
{
    for (int k = 0; k < n; ++k) {
        uint64_t bits = 0;
        memcpy(&bits, &x[k], sizeof bits);
        h = (h ^ bits) * UINT64_C(0x100000001B3);
        h ^= h >> 29;
    }
    return h;
}

uint64_t clast_dem_hash(const clast_dem *dem)
{
    if (dem == NULL) {
        return 0;
    }
    uint64_t h = UINT64_C(0xCBF29CE484222325) ^ (uint64_t)dem->step;
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        h = mix(h, dem->grain[i].position, 3);
        h = mix(h, dem->grain[i].velocity, 3);
        h = mix(h, dem->grain[i].omega, 3);
        h = mix(h, dem->motion[i].orientation, 4);
    }
    for (int64_t k = 0; k < dem->list.n_pair; ++k) {
        if (dem->list.pair[k].touches != 0) {
            const double who[2] = {dem->list.pair[k].a, dem->list.pair[k].b};
            h = mix(h, who, 2);
            h = mix(h, dem->list.pair[k].slide, 3);
            h = dem->law.has_history ? mix(h, dem->list.history[k].roll, 4) : h;
        }
    }
    for (int32_t i = 0; i < dem->walls.n && dem->walls.is_watched; ++i) {
        const clx_wall_body *w = &dem->walls.body[i];
        h = mix(h, w->pivot, 3);
        h = mix(h, &w->angle, 1);
        h = mix(h, w->impulse, 3);
        h = mix(h, w->moment, 3);
    }
    return h;
}

/// The grain that moved most, and its deepest contact.
clast_status clx_explain_explosion(const clast_dem *dem)
{
    int32_t worst = 0;
    double share = 0.0;
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        const clx_grain *g = &dem->grain[i];
        const double s = v3_norm(g->velocity) / g->radius;
        if (!(s <= share)) {
            worst = i;
            share = isnan(s) ? HUGE_VAL : s;
        }
    }
    double depth = 0.0;
    int32_t other = -1;
    for (int64_t k = 0; k < dem->list.n_pair; ++k) {
        const clx_dem_pair *pair = &dem->list.pair[k];
        const int32_t a = clx_item_grain(dem, pair->a);
        const int32_t b = pair->b >= 0 ? clx_item_grain(dem, pair->b) : pair->b;
        clx_dem_touch t = {0};
        if ((a == worst || b == worst) && pair->touches != 0) {
            clx_find_again(dem, pair, &t);
            if (-t.distance > depth) {
                depth = -t.distance;
                other = a == worst ? b : a;
            }
        }
    }
    const clx_grain *g = &dem->grain[worst];
    char where[96] = "nothing";
    if (other < 0 && depth > 0.0) {
        (void)clx_number_print(where, sizeof where, "a wall by %.2g of its radius",
                               depth / g->radius);
    } else if (depth > 0.0) {
        (void)clx_number_print(where, sizeof where, "grain %d by %.2g of its radius", other,
                               depth / g->radius);
    }
    const bool is_deep = depth > 0.2 * g->radius;
    return clx_fail(
        CLAST_E_CONVERGE,
        "the run explodes in step %lld: grain %d moves at %s, more than the %s that its contact "
        "can stop within half its radius; it overlaps %s; likely cause: %s",
        (long long)dem->step, worst, clx_unit_text(v3_norm(g->velocity), "m/s"),
        clx_unit_text(dem->stride * g->radius / dem->config.time_step, "m/s"), where,
        is_deep ? "grains that overlapped from the start, or an initial packing too dense"
                : "contacts too soft for this speed (collision_time or young), or a time step too "
                  "long for them");
}
