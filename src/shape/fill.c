// Sphere fillings: settings, the surface's preparation, the loop over spheres, stop rules.
#include "shape/fill.h"

#include "base/alloc.h"
#include "base/clock.h"
#include "base/field.h"
#include "base/monitor.h"
#include "base/number.h"
#include "base/status.h"
#include "geom/whole.h"
#include "shape/shape.h"
#include <float.h>

#define FIELD(type, name) #name, .offset = offsetof(clast_fill_config, name), CLAST_FIELD_##type
#define COUNT(type, name, value, low, high, ...)                                                   \
    {                                                                                              \
        FIELD(type, name), value, low, high, "-", __VA_ARGS__                                      \
    }
#define NUMBER(name, value, low, high, ...)                                                        \
    {                                                                                              \
        FIELD(F64, name), value, low, high, "-", __VA_ARGS__                                       \
    }
#define FLAG(name, value, ...)                                                                     \
    {                                                                                              \
        FIELD(BOOL, name), value, 0, 1, "-", __VA_ARGS__                                           \
    }

const clast_field clast_fill_fields[] = {
    COUNT(I32, spheres, 0, 0, 1e7, "most spheres; 0: 300, or 100000 when a bound is asked for",
          .group = "when to stop", .common = true),
    {FIELD(CHOICE, strategy), 0, 0, 0, "-", "how the next sphere is found",
     "largest|random|published", .common = true},
    NUMBER(filled, 0, 0, 0.999999, "stop at this share of the volume; 0: not asked",
           .common = true),
    NUMBER(volume_error, 0, 0, 1e6, "stop at this error of the volume; 0: not asked",
           .common = true),
    NUMBER(centroid_error, 0, 0, 1e6, "stop at this error of the centroid; 0: not asked"),
    NUMBER(inertia_error, 0, 0, 1e6, "stop at this error of the inertia; 0: not asked",
           .common = true),
    NUMBER(min_radius, 0, 0, DBL_MAX, "no smaller spheres, model units; 0: any",
           .group = "how spheres are found"),
    NUMBER(min_share, 0.01, 1e-4, 1,
           "largest, overlap: no sphere below this share of the first one's radius"),
    NUMBER(tolerance, 0.03, 1e-9, 1, "largest: radius may be this share below the largest"),
    COUNT(I32, candidates, 10, 1, 1e9, "random, published: candidates for each sphere (N_iter)"),
    FLAG(first_at_centre, 1, "random, published: first sphere at the mean of the corners"),
    FLAG(vertex_subset, 0, "published: the released code's random third of the corners"),
    COUNT(I64, max_tries, 1e6, 1, 1e15, "random, published: points tried in vain before giving up"),
    FLAG(outer, 0, "keep the outer spheres only (O_ext)", .common = true,
         .group = "outer spheres and clumps"),
    NUMBER(shrink, 0.5, 0, 1, "outer: 0 convex hull of the centres .. 1 tightest boundary"),
    FLAG(overlap, 0, "spheres may overlap: a clump", .common = true),
    NUMBER(protrusion, 0, 0, 0.9, "overlap: share of its radius by which a sphere may poke out",
           .common = true),
    FLAG(allow_open, 0, "accept a surface with large holes; they are capped", .common = true,
         .group = "input, random numbers and output"),
    COUNT(U64, seed, 1, 0, 1.8446744073709552e19, "seed of the random draws", .common = true),
    {FIELD(TEXT, name), 0, 0, 0, "-", "name of the sphere set; none: the input file's", ""},
    {FIELD(TEXT, history), 0, 0, 0, CLAST_UNIT_OUTPUT,
     "write the errors after each sphere to this CSV", "", .common = true},
    {0}};

/// Of the strategies each has options of its own.
const clast_idle *clast_fill_idle(const clast_fill_config *c, clast_idle rules[CLAST_N_IDLE])
{
    if (c == NULL || rules == NULL) {
        return NULL;
    }
    const bool is_largest = c->strategy == CLAST_FILL_LARGEST;
    const clast_idle made[CLAST_N_IDLE] = {
        {c->overlap, "tolerance", "with --overlap"},
        {is_largest, "candidates|first_at_centre|max_tries|seed", "with --strategy largest"},
        {!is_largest, "tolerance|min_share", "without --strategy largest"},
        {!c->outer, "shrink", "without --outer"}};
    return clx_idle_copy(made, rules);
}

enum { DEFAULT_SPHERES = 300, BOUNDED_SPHERES = 100000 };

static bool asks_quality(const clast_fill_config *c)
{
    return c->filled > 0.0 || c->volume_error > 0.0 || c->centroid_error > 0.0 ||
           c->inertia_error > 0.0;
}

static clast_status check_config(const clast_fill_config *c)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(!c->overlap || c->strategy == CLAST_FILL_LARGEST, CLAST_E_CONFIG,
              "overlap goes with strategy largest only: the others place spheres apart");
    CLX_CHECK(c->overlap || c->protrusion == 0.0, CLAST_E_CONFIG,
              "protrusion %g needs overlap: spheres apart stay inside", c->protrusion);
    CLX_CHECK(!c->vertex_subset || c->strategy == CLAST_FILL_PUBLISHED, CLAST_E_CONFIG,
              "vertex_subset goes with strategy published only");
done:
    return status;
}

/// Which of the bounds asked for are not met yet, in words; empty when all are.
static void missing(const clast_fill_config *c, const clast_fill_report *now, char *text,
                    size_t size)
{
    const struct {
        const char *name;
        double is, wanted;
        bool missed;
    } bounds[] = {
        {"filled", now->filled_fraction, c->filled, now->filled_fraction < c->filled},
        {"volume error", now->volume_error, c->volume_error, now->volume_error > c->volume_error},
        {"centroid error", now->centroid_error, c->centroid_error,
         now->centroid_error > c->centroid_error},
        {"inertia error", now->inertia_error, c->inertia_error,
         now->inertia_error > c->inertia_error},
    };
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < sizeof bounds / sizeof bounds[0]; ++i) {
        if (bounds[i].wanted > 0.0 && bounds[i].missed && used < size) {
            used += (size_t)clx_number_print(text + used, size - used, "%s%s is %.4g, wanted %.4g",
                                             used > 0 ? ", " : "", bounds[i].name, bounds[i].is,
                                             bounds[i].wanted);
        }
    }
}

/// Errors of the spheres placed so far; those of no sphere are infinite.
static clast_status errors_now(const clx_fill *fill, const clx_fill_sums *sums,
                               clast_fill_report *now)
{
    clast_status status = CLAST_OK;
    clast_spheres spheres = {0};
    clast_mass mass = clx_fill_sums_mass(sums);
    *now = (clast_fill_report){
        .volume_error = 1.0, .centroid_error = INFINITY, .inertia_error = INFINITY};
    if (fill->balls.n == 0) {
        goto done;
    }
    if (fill->config->overlap) {
        CLX_TRY(clx_ball_set_spheres(&fill->balls, &spheres));
        CLX_TRY(clx_spheres_union_mass(&spheres, &mass));
    }
    clx_fill_errors(&fill->mass, &mass, sums->outside, now);
done:
    clast_spheres_free(&spheres);
    return status;
}

static const clx_fill_strategy *strategy_of(const clast_fill_config *c)
{
    if (c->overlap) {
        return &clx_fill_overlap;
    }
    return c->strategy == CLAST_FILL_LARGEST ? &clx_fill_largest : &clx_fill_random;
}

static clast_status place(clx_fill *fill, const double ball[4], clx_fill_sums *sums)
{
    const clast_fill_config *c = fill->config;
    if (c->filled > 0.0 && (c->protrusion > 0.0 || c->strategy == CLAST_FILL_PUBLISHED)) {
        sums->outside += clx_fill_outside(fill, c->overlap ? &fill->balls : NULL, ball, ball[3]);
    }
    clx_fill_sums_add(sums, ball, ball[3]);
    clx_monitor_report(fill->monitor, "fill", fill->balls.n + 1, c->spheres);
    return clx_ball_set_add(&fill->balls, ball, ball[3]);
}

/// Places spheres until a stop rule holds; says which.
static clast_status place_all(clx_fill *fill, const clx_fill_strategy *strategy, void *state,
                              clast_fill_end *end)
{
    clast_status status = CLAST_OK;
    const clast_fill_config *c = fill->config;
    const bool quality = asks_quality(c);
    const int32_t most = c->spheres > 0 ? c->spheres : quality ? BOUNDED_SPHERES : DEFAULT_SPHERES;
    clx_fill_sums sums = {0};
    char missed[256] = "";
    v3_copy(sums.origin, fill->mass.centroid);
    *end = CLAST_FILL_BY_COUNT;
    while (true) {
        clast_fill_report now;
        double ball[4];
        bool found = false;
        if (quality) {
            CLX_TRY(errors_now(fill, &sums, &now));
            missing(c, &now, missed, sizeof missed);
        }
        if (quality && missed[0] == '\0') {
            *end = CLAST_FILL_BY_QUALITY;
            break;
        }
        if (fill->balls.n == most) {
            break;
        }
        CLX_TRY(clx_fill_poll(fill));
        CLX_TRY(strategy->next(fill, state, ball, &found));
        if (!found) {
            *end = c->overlap ? CLAST_FILL_BY_COVERAGE : CLAST_FILL_BY_MIN_RADIUS;
            break;
        }
        CLX_TRY(place(fill, ball, &sums));
    }
    CLX_CHECK(missed[0] == '\0', CLAST_E_CONVERGE, "%s after %d spheres%s", missed, fill->balls.n,
              *end == CLAST_FILL_BY_COUNT ? "; allow more with --spheres"
                                          : ", and no further sphere fits; lower --min-share or "
                                            "--min-radius, or ask for less");
    CLX_CHECK(fill->balls.n > 0, CLAST_E_CONVERGE,
              "no sphere of radius %g fits into the surface; lower --min-radius", c->min_radius);
done:
    return status;
}

static clast_status reduce(const clast_fill_config *config, clast_spheres *spheres)
{
    clast_status status = CLAST_OK;
    bool *keep = NULL;
    int32_t n = 0;
    CLX_TRY(clx_alloc(&keep, spheres->n, sizeof *keep));
    CLX_TRY(clx_fill_outer(spheres, config->shrink, keep));
    for (int32_t i = 0; i < spheres->n; ++i) {
        if (keep[i]) {
            v3_copy(spheres->centre[n], spheres->centre[i]);
            spheres->radius[n++] = spheres->radius[i];
        }
    }
    spheres->n = n;
done:
    clx_free(keep);
    return status;
}

static clast_status fill_solid(const clast_mesh *mesh, const clast_fill_config *config,
                               const clast_monitor *monitor, clast_spheres *spheres,
                               clast_fill_report *report)
{
    clast_status status = CLAST_OK;
    const double begun = clx_clock();
    clx_fill fill = {.config = config, .monitor = monitor};
    const clx_fill_strategy *strategy = strategy_of(config);
    void *state = NULL;
    clast_spheres made = {0};
    clast_fill_report found = {0};
    clast_fill_end end = CLAST_FILL_BY_COUNT;
    CLX_TRY(check_config(config));
    CLX_TRY(clx_fill_open(mesh, config->allow_open, &fill));
    fill.floor = fmax(config->min_radius, 1e-9 * fill.extent);
    CLX_TRY(strategy->create(&fill, &state));
    CLX_TRY(place_all(&fill, strategy, state, &end));
    CLX_TRY(clx_ball_set_spheres(&fill.balls, &made));
    if (config->outer) {
        CLX_TRY(reduce(config, &made));
    }
    if (report != NULL) {
        CLX_TRY(clx_fill_measure(&fill, &made, &found));
        found.n_placed = fill.balls.n;
        found.end = end;
        found.bound = fill.bound;
        found.n_tested = fill.n_tested;
        found.wall_s = clx_clock() - begun;
        *report = found;
    }
    *spheres = made;
    made = (clast_spheres){0};
done:
    strategy->destroy(state);
    clast_spheres_free(&made);
    clx_fill_free(&fill);
    return status;
}

clast_status clast_fill(const clast_mesh *mesh, const clast_fill_config *config,
                        const clast_monitor *monitor, clast_spheres *spheres,
                        clast_fill_report *report)
{
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    CLX_NEED(mesh);
    CLX_NEED(config);
    CLX_NEED(spheres);
    CLX_TRY(clast_fields_check(clast_fill_fields, config));
    CLX_TRY(fill_solid(mesh, config, monitor, spheres, report));
done:
    return status;
}
