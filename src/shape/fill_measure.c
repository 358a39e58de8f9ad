// What a sphere set is worth: volume, centroid and inertia against the solid's, how far spheres
// poke out or overlap, how far the surface is from them.
#include "shape/fill.h"

#include "base/alloc.h"
#include "base/clock.h"
#include "base/status.h"
#include "geom/whole.h"
#include "math/sort.h"
#include "shape/shape.h"
#include "shape/whole.h"
#include <clast/table.h>
#include <stdlib.h>

/// Spheres that overlap by less than this share of the smaller radius count as apart.
static const double OVERLAP_LIMIT = 1e-9;
static const double PROTRUSION_LIMIT = 1e-6;
enum { SURFACE_POINTS = 4096 };
/// Points that tell how much of a shell is outside: so many in a volume as large as the solid's.
enum { SOLID_POINTS = 200000, LEAST_POINTS = 64, MOST_POINTS = 2000000 };

void clx_fill_sums_add(clx_fill_sums *sums, const double centre[3], double radius)
{
    CLAST_ASSERT(radius >= 0.0);
    const double volume = 4.0 / 3.0 * CLAST_PI * radius * radius * radius;
    double d[3];
    v3_sub(d, centre, sums->origin);
    sums->volume += volume;
    v3_axpy(sums->first, sums->first, volume, d);
    for (int k = 0; k < 3; ++k) {
        v3_axpy(sums->second[k], sums->second[k], volume * d[k], d);
        sums->second[k][k] += volume * radius * radius / 5.0;
    }
}

clast_mass clx_fill_sums_mass(const clx_fill_sums *sums)
{
    clast_mass mass = {.volume = sums->volume};
    double mean[3];
    double c[3][3];
    v3_scale(mean, sums->volume > 0.0 ? 1.0 / sums->volume : 0.0, sums->first);
    v3_add(mass.centroid, sums->origin, mean);
    for (int k = 0; k < 3; ++k) {
        v3_axpy(c[k], sums->second[k], -sums->volume * mean[k], mean);
    }
    const double trace = c[0][0] + c[1][1] + c[2][2];
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            mass.inertia[i][k] = (i == k ? trace : 0.0) - c[i][k];
        }
    }
    return mass;
}

void clx_fill_errors(const clast_mass *wanted, const clast_mass *made, double outside,
                     clast_fill_report *report)
{
    double difference = 0.0;
    double size = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            const double w = wanted->inertia[i][k] / wanted->volume;
            const double d = made->inertia[i][k] / made->volume - w;
            difference += d * d;
            size += w * w;
        }
    }
    report->solid_volume = wanted->volume;
    report->sphere_volume = made->volume;
    report->filled_fraction = fmax(0.0, made->volume - outside) / wanted->volume;
    report->outside_fraction = outside / wanted->volume;
    report->volume_error = fabs(made->volume / wanted->volume - 1.0);
    report->centroid_error =
        v3_distance(made->centroid, wanted->centroid) / cbrt(6.0 * wanted->volume / CLAST_PI);
    report->inertia_error = sqrt(difference / size);
}

typedef struct {
    double low; ///< x - r
    int32_t ball;
} extent;

CLX_RISING_BY_TWO(compare_extents, extent, low, ball)

/// Greatest overlap of two spheres as a share of the smaller radius, by a sweep along x.
static clast_status greatest_overlap(const clast_spheres *s, double *overlap)
{
    clast_status status = CLAST_OK;
    extent *sorted = NULL;
    double most = 0.0;
    CLX_TRY(clx_alloc(&sorted, s->n, sizeof *sorted));
    for (int32_t i = 0; i < s->n; ++i) {
        sorted[i] = (extent){s->centre[i][0] - s->radius[i], i};
    }
    qsort(sorted, (size_t)s->n, sizeof *sorted, compare_extents);
    for (int32_t i = 0; i < s->n; ++i) {
        const int32_t a = sorted[i].ball;
        const double high = s->centre[a][0] + s->radius[a];
        for (int32_t j = i + 1; j < s->n && sorted[j].low < high; ++j) {
            const int32_t b = sorted[j].ball;
            const double depth =
                s->radius[a] + s->radius[b] - v3_distance(s->centre[a], s->centre[b]);
            most = fmax(most, depth / fmin(s->radius[a], s->radius[b]));
        }
    }
    *overlap = most;
done:
    clx_free(sorted);
    return status;
}

/// Distance of a sphere's centre to the surface, at most the radius; negative outside.
static double depth_of(const clx_fill *fill, const double centre[3], double radius)
{
    const bool inside = clx_fill_field_inside(&fill->field, centre);
    // inside, only a surface nearer than the radius matters: a short search
    const double max_distance = inside ? radius : (double)INFINITY;
    const double d = clx_fill_field_closest(&fill->field, centre, max_distance, NULL);
    return inside ? fmin(d, radius) : -d;
}

/// The next one of points spread evenly in the unit ball: the R3 sequence [Roberts2018] in its
/// cube.
static double ball_point(int64_t *i, double point[3])
{
    static const double step[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    double r2 = 0.0;
    do {
        for (int k = 0; k < 3; ++k) {
            const double x = 0.5 + step[k] * (double)*i;
            point[k] = 2.0 * (x - floor(x)) - 1.0;
        }
        r2 = v3_norm2(point);
        ++*i;
    } while (r2 > 1.0 || r2 == 0.0);
    return sqrt(r2);
}

static bool holds(const clx_ball_set *set, const double point[3])
{
    int32_t nearest = -1;
    return set != NULL && clx_ball_set_distance(set, 0, point, 0.0, &nearest) < 0.0;
}

// The core, which reaches from the centre to the nearest surface, is on one side of it. Points in
// the shell around it find the share outside. A point in several spheres counts in their first.
double clx_fill_outside(const clx_fill *fill, const clx_ball_set *before, const double centre[3],
                        double radius)
{
    const double depth = depth_of(fill, centre, radius);
    if (radius - depth <= PROTRUSION_LIMIT * radius) {
        return 0.0;
    }
    const double volume = 4.0 / 3.0 * CLAST_PI * radius * radius * radius;
    const double edge = depth < 0.0 && before != NULL ? 0.0 : fmin(fabs(depth) / radius, 1.0);
    const double core = edge * edge * edge;
    const double share = (1.0 - core) * volume / fill->mass.volume;
    const int64_t n = LEAST_POINTS + (int64_t)fmin(SOLID_POINTS * share, MOST_POINTS);
    int64_t at = 0;
    int64_t n_out = 0;
    for (int64_t i = 0; i < n; ++i) {
        double point[3];
        const double r = ball_point(&at, point);
        const double stretch = cbrt(core + (1.0 - core) * r * r * r) / r; // ball to shell, evenly
        v3_axpy(point, centre, radius * stretch, point);
        n_out += !clx_fill_field_inside(&fill->field, point) && !holds(before, point);
    }
    return volume * ((depth < 0.0 ? core : 0.0) + (1.0 - core) * (double)n_out / (double)n);
}

/// How far spheres protrude, and their volume outside.
static clast_status measure_protrusion(const clx_fill *fill, const clast_spheres *s,
                                       clast_fill_report *report, double *outside)
{
    clast_status status = CLAST_OK;
    clx_ball_set before = {.scale = fill->field.scale};
    const bool apart = report->max_overlap <= OVERLAP_LIMIT;
    v3_copy(before.middle, fill->field.middle);
    *outside = 0.0;
    for (int32_t i = 0; i < s->n; ++i) {
        const double radius = s->radius[i];
        const double protrusion = (radius - depth_of(fill, s->centre[i], radius)) / radius;
        report->max_protrusion = fmax(report->max_protrusion, protrusion);
        if (protrusion > PROTRUSION_LIMIT) {
            ++report->n_protruding;
            *outside += clx_fill_outside(fill, apart ? NULL : &before, s->centre[i], radius);
        }
        CLX_TRY(clx_ball_set_add(&before, s->centre[i], radius));
    }
done:
    clx_ball_set_free(&before);
    return status;
}

void clx_fill_spread_free(clx_fill_spread *spread)
{
    clx_free(spread->area);
    *spread = (clx_fill_spread){0};
}

clast_status clx_fill_spread_create(const clast_mesh *mesh, clx_fill_spread *spread)
{
    clx_fill_spread made = {.mesh = mesh};
    const clast_status status = clx_alloc(&made.area, mesh->n_tri, sizeof *made.area);
    double sum = 0.0;
    for (int32_t t = 0; t < mesh->n_tri && status == CLAST_OK; ++t) {
        double u[3];
        double v[3];
        double n[3];
        v3_sub(u, mesh->vert[mesh->tri[t][1]], mesh->vert[mesh->tri[t][0]]);
        v3_sub(v, mesh->vert[mesh->tri[t][2]], mesh->vert[mesh->tri[t][0]]);
        v3_cross(n, u, v);
        sum += 0.5 * v3_norm(n);
        made.area[t] = sum;
    }
    if (status == CLAST_OK) {
        *spread = made;
    }
    return status;
}

/// First triangle whose running area exceeds `at`.
static int32_t triangle_at(const clx_fill_spread *spread, double at)
{
    CLAST_ASSERT(at >= 0.0);
    int32_t low = 0;
    int32_t high = spread->mesh->n_tri - 1;
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (spread->area[middle] > at) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

// Equal steps of the running area choose the triangles; the R2 sequence of the plastic number
// places the points in them [Roberts2018], folded into the triangle.
int32_t clx_fill_spread_point(const clx_fill_spread *spread, int64_t i, int64_t n, double point[3])
{
    CLAST_ASSERT(i >= 0 && i < n);
    const clast_mesh *m = spread->mesh;
    const double total = spread->area[m->n_tri - 1];
    const int32_t t = triangle_at(spread, ((double)i + 0.5) / (double)n * total);
    double u = 0.5 + 0.7548776662466927 * (double)i;
    double v = 0.5 + 0.5698402909980532 * (double)i;
    u -= floor(u);
    v -= floor(v);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    for (int k = 0; k < 3; ++k) {
        point[k] = (1.0 - u - v) * m->vert[m->tri[t][0]][k] + u * m->vert[m->tri[t][1]][k] +
                   v * m->vert[m->tri[t][2]][k];
    }
    return t;
}

/// Distance of surface points to the spheres (0 inside one).
static clast_status measure_deviation(const clx_fill *fill, const clast_spheres *s,
                                      clast_fill_report *report)
{
    clast_status status = CLAST_OK;
    clx_fill_spread spread = {0};
    clx_ball_set set = {.scale = fill->field.scale};
    double sum = 0.0;
    v3_copy(set.middle, fill->field.middle);
    for (int32_t i = 0; i < s->n; ++i) {
        CLX_TRY(clx_ball_set_add(&set, s->centre[i], s->radius[i]));
    }
    CLX_TRY(clx_fill_spread_create(fill->surface, &spread));
    for (int64_t i = 0; i < SURFACE_POINTS; ++i) {
        double point[3];
        int32_t nearest = -1;
        (void)clx_fill_spread_point(&spread, i, SURFACE_POINTS, point);
        const double d = fmax(0.0, clx_ball_set_distance(&set, 0, point, INFINITY, &nearest));
        sum += d;
        report->deviation_max = fmax(report->deviation_max, d);
    }
    report->deviation_mean = sum / SURFACE_POINTS;
done:
    clx_fill_spread_free(&spread);
    clx_ball_set_free(&set);
    return status;
}

static clast_status measure_radii(const clast_spheres *s, clast_fill_report *report)
{
    double *sorted = NULL;
    const clast_status status = clx_alloc(&sorted, s->n, sizeof *sorted);
    if (status == CLAST_OK) {
        for (int32_t i = 0; i < s->n; ++i) {
            sorted[i] = s->radius[i];
        }
        qsort(sorted, (size_t)s->n, sizeof *sorted, clx_by_value);
        report->radius_min = sorted[0];
        report->radius_max = sorted[s->n - 1];
        report->radius_median = 0.5 * (sorted[(s->n - 1) / 2] + sorted[s->n / 2]);
    }
    clx_free(sorted);
    return status;
}

/// Volume, centroid and inertia of the first n spheres.
static clast_status mass_of(const clx_fill *fill, const clast_spheres *s, bool apart,
                            clast_mass *mass)
{
    clx_fill_sums sums = {0};
    if (!apart) {
        return clx_spheres_union_mass(s, mass);
    }
    v3_copy(sums.origin, fill->mass.centroid);
    for (int32_t i = 0; i < s->n; ++i) {
        clx_fill_sums_add(&sums, s->centre[i], s->radius[i]);
    }
    *mass = clx_fill_sums_mass(&sums);
    return CLAST_OK;
}

static clast_status check_spheres(const clast_spheres *s)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(s->n > 0, CLAST_E_GEOMETRY, "no spheres to measure");
    for (int32_t i = 0; i < s->n; ++i) {
        CLX_CHECK(isfinite(s->centre[i][0]) && isfinite(s->centre[i][1]) &&
                      isfinite(s->centre[i][2]) && isfinite(s->radius[i]) && s->radius[i] > 0.0,
                  CLAST_E_GEOMETRY, "sphere %d of %d has radius %g or a centre that is not finite",
                  i + 1, s->n, s->radius[i]);
    }
done:
    return status;
}

clast_status clx_fill_measure(const clx_fill *fill, const clast_spheres *spheres,
                              clast_fill_report *report)
{
    clast_status status = CLAST_OK;
    clast_mass mass;
    double outside = 0.0;
    clast_fill_report made = {.n_sphere = spheres->n,
                              .n_placed = spheres->n,
                              .n_open_edge = fill->solid.n_open_edge,
                              .open_share = fill->solid.open_volume / fill->mass.volume};
    CLX_TRY(check_spheres(spheres));
    CLX_TRY(greatest_overlap(spheres, &made.max_overlap));
    CLX_TRY(mass_of(fill, spheres, made.max_overlap <= OVERLAP_LIMIT, &mass));
    CLX_TRY(measure_protrusion(fill, spheres, &made, &outside));
    clx_fill_errors(&fill->mass, &mass, outside, &made);
    CLX_TRY(measure_deviation(fill, spheres, &made));
    CLX_TRY(measure_radii(spheres, &made));
    *report = made;
done:
    return status;
}

clast_status clast_fill_measure(const clast_mesh *mesh, const clast_spheres *spheres,
                                clast_fill_report *report)
{
    CLX_ARGUMENTS(mesh, spheres, report);
    CLX_WHOLE(mesh, mesh);
    CLX_WHOLE(spheres, spheres);
    clast_status status = CLAST_OK;
    const double begun = clx_clock();
    clx_fill fill = {0};
    CLX_TRY(clx_fill_open(mesh, true, &fill));
    CLX_TRY(clx_fill_measure(&fill, spheres, report));
    report->wall_s = clx_clock() - begun;
done:
    clx_fill_free(&fill);
    return status;
}

clast_status clast_fill_history(const clast_mesh *mesh, const clast_spheres *spheres,
                                clast_table *table)
{
    CLX_ARGUMENTS(mesh, spheres, table);
    CLX_WHOLE(mesh, mesh);
    CLX_WHOLE(spheres, spheres);
    static const char *const names[6] = {"n_sphere",     "radius",         "filled_fraction",
                                         "volume_error", "centroid_error", "inertia_error"};
    clast_status status = CLAST_OK;
    clx_fill fill = {0};
    clx_fill_sums sums = {0};
    clx_ball_set before = {0};
    clast_table made = {0};
    double overlap = 0.0;
    CLX_TRY(check_spheres(spheres));
    CLX_TRY(clx_fill_open(mesh, true, &fill));
    CLX_TRY(greatest_overlap(spheres, &overlap));
    CLX_TRY(clast_table_init(&made, "fill_history", spheres->n));
    for (int k = 0; k < 6; ++k) {
        double *column = NULL;
        CLX_TRY(clast_table_add_number(&made, names[k], k == 1 ? "model" : "-", &column));
    }
    v3_copy(sums.origin, fill.mass.centroid);
    v3_copy(before.middle, fill.field.middle);
    before.scale = fill.field.scale;
    for (int32_t i = 0; i < spheres->n; ++i) {
        const clast_spheres part = {i + 1, spheres->centre, spheres->radius};
        clast_fill_report now;
        clx_fill_sums_add(&sums, spheres->centre[i], spheres->radius[i]);
        sums.outside += clx_fill_outside(&fill, overlap > OVERLAP_LIMIT ? &before : NULL,
                                         spheres->centre[i], spheres->radius[i]);
        CLX_TRY(clx_ball_set_add(&before, spheres->centre[i], spheres->radius[i]));
        clast_mass mass = clx_fill_sums_mass(&sums);
        if (overlap > OVERLAP_LIMIT) {
            CLX_TRY(clx_spheres_union_mass(&part, &mass));
        }
        clx_fill_errors(&fill.mass, &mass, sums.outside, &now);
        const double row[6] = {i + 1.0,          spheres->radius[i], now.filled_fraction,
                               now.volume_error, now.centroid_error, now.inertia_error};
        for (int k = 0; k < 6; ++k) {
            made.column[k].number[i] = row[k];
        }
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    clx_ball_set_free(&before);
    clx_fill_free(&fill);
    return status;
}
