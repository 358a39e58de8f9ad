// Sizes of pores: distances of even points of the pore space to the nearest grain.
#include <clast/porosity.h>

#include "assembly/grain_points.h"
#include "assembly/touch_set.h"
#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/column_unit.h"
#include "base/parallel.h"
#include "base/status.h"
#include "math/sort.h"
#include "math/vec3.h"
#include "porosity/whole.h"
#include "touch/gap.h"
#include <clast/mesh.h>

enum { BLOCK = 256, POINT_LIMIT = 100000000 };

/// Points and their distances; -1 in a grain, -2 outside the bed.
typedef struct {
    const clast_bed *bed;
    const clx_touch_set *set;
    double z_low, z_high, period[3];
    double first;      ///< radius of the first search
    clast_bvh *inside; ///< of a bed within a surface, else NULL
    double *delta;
} search;

/// Point k of the lattice of irrational steps (plastic number's powers), in the bed's box.
static void point_of(const search *s, int64_t k, double x[3])
{
    static const double step[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    const clast_bed *b = s->bed;
    for (int i = 0; i < 3; ++i) {
        const double u = fmod(0.5 + step[i] * (double)(k + 1), 1.0);
        const bool is_round = b->kind == CLAST_BED_CYLINDER;
        const double low = i == 2 ? s->z_low : is_round ? b->centre[i] - b->radius : b->low[i];
        const double high = i == 2 ? s->z_high : is_round ? b->centre[i] + b->radius : b->high[i];
        x[i] = low + u * (high - low);
    }
}

/// The nearest surface found so far.
typedef struct {
    const clx_touch_set *set;
    double x[3];
    double nearest;
    bool held;
} nearest_visit;

static bool visit(int32_t body, const clx_gap *gap, void *context)
{
    nearest_visit *v = context;
    v->held = v->held || clx_body_holds(clx_touch_scene_body(v->set->scene, body), v->x);
    v->nearest = fmin(v->nearest, fmax(gap->distance, 0.0));
    return !v->held;
}

/// A point's x as it is k periods up, in the first image: a sheared bed's is another.
static double along_x(const search *s, double x, int k)
{
    const double at = x + k * s->bed->shift;
    return at == x || !(s->period[0] > 0.0)
               ? x
               : at - s->period[0] * floor((at - s->bed->low[0]) / s->period[0]);
}

/// Distance of a point to the nearest grain or image of one within `reach`, or HUGE_VAL; -1 inside.
static double nearest_within(const search *s, const double x[3], double max_distance, double dust)
{
    CLAST_ASSERT(dust >= 0.0 && max_distance >= 0.0);
    const double upright[4] = {1.0, 0.0, 0.0, 0.0};
    nearest_visit v = {.set = s->set, .nearest = HUGE_VAL};
    clx_touch_body probe = clx_touch_body_sphere(dust);
    const int nx = s->period[0] > 0.0 ? 1 : 0;
    const int ny = s->period[1] > 0.0 ? 1 : 0;
    const int nz = s->period[2] > 0.0 ? 1 : 0;
    const int n_image = (2 * nx + 1) * (2 * ny + 1) * (2 * nz + 1);
    for (int m = 0; m < n_image && !v.held; ++m) { // z fastest, then y
        const int k = m % (2 * nz + 1) - nz;
        const int j = m / (2 * nz + 1) % (2 * ny + 1) - ny;
        const int i = m / ((2 * nz + 1) * (2 * ny + 1)) - nx;
        v3_set(v.x, along_x(s, x[0], k) + i * s->period[0], x[1] + j * s->period[1],
               x[2] + k * s->period[2]);
        clx_touch_body_place(&probe, v.x, upright, 1.0);
        (void)clx_touch_scene_contacts(s->set->scene, &probe, max_distance, visit, &v);
    }
    return v.held ? -1.0 : v.nearest + dust;
}

static void measure_range(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const search *s = context;
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        double x[3];
        point_of(s, k, x);
        if ((s->bed->kind == CLAST_BED_CYLINDER &&
             hypot(x[0] - s->bed->centre[0], x[1] - s->bed->centre[1]) > s->bed->radius) ||
            (s->inside != NULL && !clast_bvh_inside(s->inside, x))) {
            s->delta[k] = -2.0;
            continue;
        }
        double found = HUGE_VAL;
        double max_distance = s->first;
        for (int tries = 0; tries < 20 && found > max_distance; ++tries) {
            max_distance *= tries > 0 ? 2.0 : 1.0;
            found = nearest_within(s, x, max_distance, 1e-9 * s->first);
        }
        s->delta[k] = found;
    }
}

/// Pore points' distances to the front, rising; counts points in the bed.
static clast_status keep_pores(double *delta, int64_t n, int64_t *n_pore, int64_t *n_bed)
{
    clast_status status = CLAST_OK;
    *n_pore = 0;
    *n_bed = 0;
    for (int64_t k = 0; k < n; ++k) {
        const double d = delta[k];
        *n_bed += d > -1.5;
        if (d >= 0.0 && isfinite(d)) {
            delta[(*n_pore)++] = d;
        }
    }
    CLX_CHECK(*n_pore > 0, CLAST_E_GEOMETRY, "none of %lld points lies in a pore", (long long)n);
    CLX_TRY(clx_sort_doubles(delta, *n_pore));
done:
    return status;
}

static clast_status histogram(const double *delta, int64_t n, int32_t n_bin, clast_table *table)
{
    static const char *const column[][2] = {{"delta_low_m", "m"},
                                            {"delta_high_m", "m"},
                                            {"density_1/m", "1/m"},
                                            {"share_smaller", "-"},
                                            {"share_error", "-"}};
    clast_status status = CLAST_OK;
    const double step = delta[n - 1] > 0.0 ? delta[n - 1] / n_bin : 1.0;
    int64_t below = 0;
    CLX_TRY(CLX_ADD_COLUMNS(table, column));
    for (int32_t k = 0; k < n_bin; ++k) {
        const int64_t before = below;
        while (below < n && (delta[below] <= (k + 1) * step || k + 1 == n_bin)) {
            ++below;
        }
        const double share = (double)below / (double)n;
        table->column[0].number[k] = k * step;
        table->column[1].number[k] = (k + 1) * step;
        table->column[2].number[k] = (double)(below - before) / (double)n / step;
        table->column[3].number[k] = share;
        table->column[4].number[k] = sqrt(share * (1.0 - share) / (double)n);
    }
done:
    return status;
}

void clast_pores_free(clast_pores *pores)
{
    if (pores == NULL) {
        return;
    }
    clast_table_free(&pores->sizes);
    *pores = (clast_pores){0};
}

static clast_status check_period(const double period[3])
{
    clast_status status = CLAST_OK;
    for (int k = 0; k < 3; ++k) {
        CLX_CHECK(period[k] >= 0.0 && isfinite(period[k]), CLAST_E_ARGUMENT,
                  "pores: the period along %c is %g m; it must be finite and not negative", 'x' + k,
                  period[k]);
    }
done:
    return status;
}

clast_status clast_pores_measure(const clast_assembly *assembly, const clast_bed *bed,
                                 const double z[2], const clast_pore_options *options,
                                 clast_pores *pores)
{
    CLX_ARGUMENTS(assembly, bed, z, options, pores);
    CLX_WHOLE(assembly, assembly);
    CLX_WHOLE(bed, bed);
    clast_status status = CLAST_OK;
    clast_pores made = {0};
    clx_touch_set set = {0};
    search s = {.bed = bed,
                .set = &set,
                .z_low = z[0],
                .z_high = z[1],
                .period = {options->period[0], options->period[1], options->period[2]}};
    const int64_t n = options->n_point;
    int64_t n_pore = 0;
    int64_t n_bed = 0;
    CLX_TRY(check_period(options->period));
    CLX_CHECK(assembly->n_grain > 0 && z[1] > z[0] && isfinite(z[1] - z[0]), CLAST_E_USAGE,
              "no grain to measure between %g and %g", z[0], z[1]);
    CLX_CHECK(n >= 1 && n <= POINT_LIMIT && options->n_bin >= 1, CLAST_E_USAGE,
              "pores by %lld points in %d bins", (long long)n, options->n_bin);
    if (bed->kind == CLAST_BED_MESH) {
        CLX_TRY(clast_bvh_create(bed->surface, &s.inside));
    }
    CLX_TRY(clx_touch_set_init(assembly, &set));
    s.first = 0.25 * cbrt(clast_assembly_volume(assembly) / assembly->n_grain);
    CLX_TRY(clx_alloc(&s.delta, n, sizeof *s.delta));
    clx_parallel_for(n, BLOCK, measure_range, &s);
    CLX_TRY(keep_pores(s.delta, n, &n_pore, &n_bed));
    CLX_TRY(clast_table_init(&made.sizes, "pores", options->n_bin));
    CLX_TRY(histogram(s.delta, n_pore, options->n_bin, &made.sizes));
    for (int64_t k = 0; k < n_pore; ++k) {
        made.mean += s.delta[k] / (double)n_pore;
    }
    made.porosity = (double)n_pore / (double)n_bed;
    *pores = made;
    made = (clast_pores){0};
done:
    clx_free(s.delta);
    clast_bvh_destroy(s.inside);
    clx_touch_set_free(&set);
    clast_pores_free(&made);
    return status;
}
