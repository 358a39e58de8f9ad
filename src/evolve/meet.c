// Who meets in a cell where bodies are evenly spread.
//
// In a sub-step the n bodies are partitioned into n / 2 pairs at random; each pair stands for
// (n (n - 1) / 2) / (n / 2) of all, so that it joins with the chance
//
//     1 - exp(-x),   x = W alpha beta (n (n - 1) / 2) / (n / 2) dt / V        [Shima2009 sec. 4.1]
//
// which is O(n) a sub-step for any kernel. The sub-step is such that no pair of the bodies that are
// extreme in radius and speed has x above step_error. [docs/theory/evolve.md section 3]
#include "evolve/state.h"

#include "base/monitor.h"
#include "cloud/kernel_range.h"
#include "cloud/settling_pair.h"
#include <math.h>

/// Whose velocity a pair is seen with: as drawn for the step, or for a bound on the rate.
typedef enum { AS_DRAWN, AT_MOST_UP, AT_MOST_DOWN } velocity_seen;

/// Velocity of a body against the fluid where it is: it falls, and of the turbulence takes what its
/// response time lets it, drawn anew for each step.
static void add_velocity(const clast_evolve *e, int32_t i, velocity_seen seen, clast_collider *c)
{
    static const double MOST = 3.0; ///< standard deviations
    const double sd = sqrt(clx_velocity_variance(&e->collide.medium, c));
    clx_rng rng = clx_rng_at(e->config->seed, CLX_STREAM_EVOLVE_VELOCITY,
                             (e->step << 32) | (uint64_t)(uint32_t)i);
    for (int k = 0; k < 3 && sd > 0.0 && seen == AS_DRAWN; ++k) {
        c->velocity[k] = sd * clx_rng_normal(&rng);
    }
    if (seen != AS_DRAWN) {
        c->velocity[2] = seen == AT_MOST_UP ? MOST * sd : -MOST * sd;
    }
    c->velocity[2] -= e->body[i].speed;
}

static clast_collider collider_of(const clast_evolve *e, int32_t i, velocity_seen seen)
{
    const clx_evolve_body *body = &e->body[i];
    clast_collider c = {.monomers = body->n,
                        .radius = body->radius,
                        .mass = body->mass,
                        .settling_speed = body->speed};
    if ((clast_kernel_needs(e->collide.kernel) & CLAST_NEEDS_VELOCITY) != 0) {
        add_velocity(e, i, seen, &c);
    }
    return c;
}

/// Volume swept per time that ends in a joint.
static double sticking_rate(const clast_evolve *e, const clast_collider pair[2])
{
    const clast_collide_config *c = &e->collide;
    const clast_collider a = pair[0];
    const clast_collider b = pair[1];
    const double beta = c->alpha * clast_kernel_value(c->kernel, &c->medium, &a, &b);
    return c->sticking.law == CLAST_STICKING_CONSTANT || !(beta > 0.0)
               ? beta
               : beta * clx_sticking_of(c, &c->medium, &a, &b);
}

/// Greatest rate among the bodies that are extreme in radius and in speed.
static double greatest_rate(const clast_evolve *e, const int32_t *member, int64_t n)
{
    enum { N_EXTREME = 5 };
    int32_t extreme[N_EXTREME] = {member[0], member[0], member[0], member[0], member[0]};
    double most = 0.0;
    for (int64_t m = 1; m < n; ++m) {
        const clx_evolve_body *b = &e->body[member[m]];
        extreme[0] = b->radius > e->body[extreme[0]].radius ? member[m] : extreme[0];
        extreme[1] = b->radius < e->body[extreme[1]].radius ? member[m] : extreme[1];
        extreme[2] = b->speed > e->body[extreme[2]].speed ? member[m] : extreme[2];
        extreme[3] = b->speed < e->body[extreme[3]].speed ? member[m] : extreme[3];
        extreme[4] = b->n > e->body[extreme[4]].n ? member[m] : extreme[4];
    }
    for (int a = 0; a < N_EXTREME; ++a) {
        for (int b = a; b < N_EXTREME; ++b) {
            const bool is_faster = e->body[extreme[a]].speed > e->body[extreme[b]].speed;
            const clast_collider pair[2] = {
                collider_of(e, extreme[a], is_faster ? AT_MOST_DOWN : AT_MOST_UP),
                collider_of(e, extreme[b], is_faster ? AT_MOST_UP : AT_MOST_DOWN)};
            most = fmax(most, sticking_rate(e, pair));
        }
    }
    return most;
}

static void shuffle(int32_t *member, int64_t n, clx_rng *rng)
{
    for (int64_t i = n - 1; i > 0; --i) {
        const int64_t k = clx_rng_below(rng, i + 1);
        const int32_t held = member[i];
        member[i] = member[k];
        member[k] = held;
    }
}

static void hold_to_ranges(clast_evolve *e, const clast_collider pair[2])
{
    if (e->ranges != 0) {
        clx_range_add(e->ranges, &e->collide, &e->collide.medium, pair, 1.0, &e->range);
    }
}

/// One partition into pairs; `scale` times the rate of a pair is its x. Members that merged are
/// dropped.
static clast_status meet_in_pairs(clast_evolve *e, int32_t *member, int64_t *n, double scale,
                                  double time, clx_rng *rng)
{
    clast_status status = CLAST_OK;
    int64_t left = 0;
    shuffle(member, *n, rng);
    for (int64_t m = 0; m + 1 < *n; m += 2) {
        const clast_collider pair[2] = {collider_of(e, member[m], AS_DRAWN),
                                        collider_of(e, member[m + 1], AS_DRAWN)};
        const double x = scale * sticking_rate(e, pair);
        if (clx_rng_uniform(rng) < -expm1(-x)) {
            hold_to_ranges(e, pair);
            (void)clx_monitor_stops(e->monitor); // the step comes to its end all the same
            CLX_TRY(clx_evolve_join(e, member[m], member[m + 1], time, rng));
        }
    }
    for (int64_t m = 0; m < *n; ++m) {
        if (e->body[member[m]].state == CLX_BODY_IN_FLUID) {
            member[left++] = member[m];
        }
    }
    *n = left;
done:
    return status;
}

double clx_evolve_joints(const clast_evolve *e, const int32_t *member, int64_t n, double volume,
                         clx_rng *rng)
{
    CLAST_ASSERT(volume > 0.0);
    double sum = 0.0;
    for (int64_t k = 0; n > 1 && k < n; ++k) {
        const int64_t i = clx_rng_below(rng, n);
        const int64_t j = clx_rng_below(rng, n - 1);
        const clast_collider pair[2] = {collider_of(e, member[i], AS_DRAWN),
                                        collider_of(e, member[j < i ? j : j + 1], AS_DRAWN)};
        sum += sticking_rate(e, pair);
    }
    return n > 1 ? 0.5 * e->config->weight * sum * (double)(n - 1) / volume : 0.0;
}

clast_status clx_evolve_meet(clast_evolve *e, int32_t *member, int64_t n, double volume, double dt,
                             clx_rng *rng)
{
    enum { MOST_SUB_STEPS = 1000000 };
    CLAST_ASSERT(volume > 0.0 && dt >= 0.0);
    clast_status status = CLAST_OK;
    double passed = 0.0;
    for (int64_t k = 0; passed < dt && n > 1; ++k) {
        const int64_t n_pair = n / 2;
        const double pairs = 0.5 * (double)n * (double)(n - 1) / (double)n_pair;
        const double each = e->config->weight * pairs / volume;
        const double most = each * greatest_rate(e, member, n);
        const double left = dt - passed;
        CLX_CHECK(k < MOST_SUB_STEPS && isfinite(most), CLAST_E_CONVERGE,
                  "a cell of %lld particles in %s collides %.3g times a second each: over %d "
                  "sub-steps; take a shorter time_step",
                  (long long)n, clx_unit_text(volume, "m^3"), most, MOST_SUB_STEPS);
        const double parts = fmax(1.0, ceil(left * most / e->config->step_error));
        const double sub = left / parts;
        passed = parts > 1.0 ? passed + sub : dt;
        if (most > 0.0) {
            CLX_TRY(meet_in_pairs(e, member, &n, each * sub, e->time + passed, rng));
        }
    }
done:
    return status;
}
