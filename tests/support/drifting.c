// Clouds that drift from step to step, as a flow solver's do.
#include "drifting.h"

#include "base/alloc.h"
#include "math/rng.h"
#include <math.h>

const char *const drifting_name[N_DRIFTING] = {"mixed", "moving", "gathered", "vortex"};

static const double share = 0.3;

/// Back into [0, 1] by reflection.
static double reflected(double x)
{
    const double y = fabs(fmod(x, 2.0));
    return y > 1.0 ? 2.0 - y : y;
}

static double sd_of(const drifting *c)
{
    const double phase = fmod((double)c->step, 400.0) / 200.0;
    return c->kind == DRIFTING_GATHERED ? 0.12 - 0.08 * (phase > 1.0 ? 2.0 - phase : phase) : 0.06;
}

/// Points of the blob, the first 30 %, by their offsets.
static void place_blob(drifting *c)
{
    const double phase = fmod((double)c->step * 0.06 / 50.0, 0.6); // there and back
    const double at = c->kind == DRIFTING_MOVING ? 0.35 + (phase > 0.3 ? 0.6 - phase : phase) : 0.5;
    for (int64_t i = 0; i < (int64_t)(share * (double)c->n); ++i) {
        for (int j = 0; j < 3; ++j) {
            c->x[3 * i + j] = reflected((j == 0 ? at : 0.5) + sd_of(c) * c->other[3 * i + j]);
        }
    }
}

clast_status drifting_start(drifting_kind kind, int64_t n, uint64_t seed, drifting *cloud)
{
    clast_status status = CLAST_OK;
    drifting made = {.kind = kind, .n = n, .seed = seed};
    CLX_TRY(clx_alloc(&made.x, n, 3 * sizeof *made.x));
    CLX_TRY(clx_alloc(&made.other, n, 3 * sizeof *made.other));
    for (int64_t i = 0; i < 3 * n; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, (uint64_t)i);
        made.x[i] = clx_rng_uniform(&rng);
        made.other[i] =
            kind == DRIFTING_MOVING || kind == DRIFTING_GATHERED ? clx_rng_normal(&rng) : 0.0;
    }
    if (kind == DRIFTING_MOVING || kind == DRIFTING_GATHERED) {
        place_blob(&made);
    }
    *cloud = made;
    made = (drifting){0};
done:
    drifting_free(&made);
    return status;
}

static void walk(drifting *c)
{
    for (int64_t i = 0; i < 3 * c->n; ++i) {
        clx_rng rng = clx_rng_at(c->seed + c->step, CLX_STREAM_TEST, (uint64_t)i);
        c->x[i] = reflected(c->x[i] + 0.01 * clx_rng_normal(&rng));
    }
}

/// Drag of response time 0.2 in a vortex between walls, 0.02 a step.
static void turn(drifting *c)
{
    const double dt = 0.02;
    for (int64_t i = 0; i < c->n; ++i) {
        double *x = c->x + 3 * i;
        double *v = c->other + 3 * i;
        const double a = CLAST_PI * x[0];
        const double b = CLAST_PI * x[1];
        const double fluid[3] = {sin(a) * cos(b), -cos(a) * sin(b),
                                 0.1 * sin(2.0 * CLAST_PI * x[2])};
        for (int j = 0; j < 3; ++j) {
            v[j] += dt / 0.2 * (fluid[j] - v[j]);
            x[j] += dt * v[j];
            if (x[j] < 0.0 || x[j] > 1.0) {
                x[j] = reflected(x[j]);
                v[j] = -v[j];
            }
        }
    }
}

void drifting_advance(drifting *cloud)
{
    ++cloud->step;
    switch (cloud->kind) {
    case DRIFTING_MIXED:
        walk(cloud);
        return;
    case DRIFTING_MOVING:
    case DRIFTING_GATHERED:
        place_blob(cloud);
        return;
    case DRIFTING_VORTEX:
    case N_DRIFTING:
        break;
    }
    turn(cloud);
}

double drifting_integral(const drifting *cloud)
{
    const double axis = 1.0 / (2.0 * sd_of(cloud) * sqrt(CLAST_PI));
    switch (cloud->kind) {
    case DRIFTING_MIXED:
        return 1.0;
    case DRIFTING_MOVING:
    case DRIFTING_GATHERED: // of the blob less than 1e-4 lies outside
        return (1.0 - share) * (1.0 - share) + 2.0 * share * (1.0 - share) +
               share * share * axis * axis * axis;
    case DRIFTING_VORTEX:
    case N_DRIFTING:
        break;
    }
    return 0.0;
}

void drifting_free(drifting *cloud)
{
    clx_free(cloud->x);
    clx_free(cloud->other);
    *cloud = (drifting){0};
}
