// Solid volume by distance from a centre: spheres cut by spheres in closed form, other grains by
// lattice points: in the grain, and for shells that are smaller than the grain (those about the
// centre of a core), where few of its points would lie, in the shell.
#include <clast/assembly.h>

#include "assembly/ball_cut.h"
#include "assembly/grain_points.h"
#include "assembly/touch_set.h"
#include "assembly/whole.h"
#include "base/status.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <clast/shape.h>
#include <clast/table.h>

enum { POINTS_A_GRAIN = 512 };

typedef struct profile {
    int32_t n_bin;
    double step;
    double *solid, *error, *mass; ///< [n_bin]; error is a variance until the end
    int32_t grain;                ///< at hand
} profile;

static void add_ball(profile *p, double r, double d, double density)
{
    CLAST_ASSERT(r >= 0.0 && d >= 0.0 && p->n_bin > 0);
    double inner = 0.0;
    for (int32_t k = 0; k < p->n_bin; ++k) {
        const double outer = clx_ball_within(r, d, (k + 1) * p->step);
        p->solid[k] += outer - inner;
        p->mass[k] += density * (outer - inner);
        inner = outer;
    }
}

static double shell_volume(const profile *p, int32_t k)
{
    CLAST_ASSERT(k >= 0 && k < p->n_bin);
    const double low = k * p->step;
    const double high = (k + 1) * p->step;
    return 4.0 / 3.0 * CLAST_PI * (high * high * high - low * low * low);
}

/// Volume of the grain in shell k by points even in the shell; the variance is at most that of
/// random points.
static double within_shell(const profile *p, int32_t k, const clx_touch_body *body,
                           const double centre[3], double *variance)
{
    const double low = pow(k * p->step, 3.0);
    const double high = pow((k + 1) * p->step, 3.0);
    const double shell = shell_volume(p, k);
    double c[3] = {0.5, 0.5, 0.5};
    int32_t hits = 0;
    for (int32_t i = 0; i < POINTS_A_GRAIN; ++i) {
        double x[3];
        clx_lattice_step(c);
        const double r = cbrt(low + c[0] * (high - low));
        const double z = 2.0 * c[1] - 1.0;
        const double across = sqrt(fmax(0.0, 1.0 - z * z));
        const double angle = 2.0 * CLAST_PI * c[2];
        const double u[3] = {across * cos(angle), across * sin(angle), z};
        v3_axpy(x, centre, r, u);
        hits += clx_body_holds(body, x);
    }
    const double share = (double)hits / POINTS_A_GRAIN;
    *variance = shell * shell * share * (1.0 - share) / POINTS_A_GRAIN;
    return shell * share;
}

static void add_share(profile *p, int32_t k, double volume, double variance, double density)
{
    CLAST_ASSERT(k >= 0 && k < p->n_bin);
    p->solid[k] += volume;
    p->mass[k] += density * volume;
    p->error[k] += variance;
}

/// Points even in the grain, other ones in each, or the errors of grains that lie alike add up; the
/// shells below `first` are known, the others share what is left (of a grain that ends within them
/// nothing is left but the error of their sum).
static void add_points(profile *p, const clx_touch_body *body, const double centre[3],
                       int32_t first, double left, double density)
{
    double c[3];
    int32_t bin[POINTS_A_GRAIN];
    int32_t n = 0;
    clx_lattice_begin((int64_t)POINTS_A_GRAIN * p->grain, c);
    for (int64_t tried = 0; n < POINTS_A_GRAIN && tried < 1000LL * POINTS_A_GRAIN; ++tried) {
        double x[3];
        clx_lattice_step(c);
        if (clx_body_draw(body, c, x)) {
            const int32_t k = (int32_t)(v3_distance(x, centre) / p->step);
            bin[n] = k < p->n_bin ? k : p->n_bin - 1;
            n += bin[n] >= first;
        }
    }
    for (int32_t k = 0; k < n; ++k) { // 1 / n each; variance at most that of random points
        add_share(p, bin[k], left / n, left / n * (left / n), density);
    }
}

static void add_grain(profile *p, const clx_touch_body *body, const double centre[3], double volume,
                      double density)
{
    double left = volume;
    int32_t k = 0;
    for (; k < p->n_bin && shell_volume(p, k) < volume && left > 0.0; ++k) {
        double variance = 0.0;
        if (v3_distance(body->position, centre) > (k + 1) * p->step + body->radius) {
            continue; // the shell ends before the grain begins
        }
        const double part = within_shell(p, k, body, centre, &variance);
        add_share(p, k, fmin(part, left), variance, density);
        left -= fmin(part, left);
    }
    if (left > 0.0) {
        add_points(p, body, centre, k, left, density);
    }
}

static void add_grains(const clast_assembly *a, const clx_touch_set *set, const double centre[3],
                       profile *p)
{
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const clast_shape *shape = &a->shape[a->shape_id[i]];
        const double s = a->scale[i];
        if (shape->kind == CLAST_SHAPE_SPHERE) {
            add_ball(p, s * shape->semi_axes[0], v3_distance(a->position[i], centre),
                     a->density[i]);
        } else {
            p->grain = i;
            add_grain(p, clx_touch_scene_body(set->scene, i), centre, s * s * s * shape->volume,
                      a->density[i]);
        }
    }
}

static double bounding_radius_of(const clast_assembly *a, const double centre[3])
{
    double bounding_radius = 0.0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        bounding_radius =
            fmax(bounding_radius, v3_distance(a->position[i], centre) +
                                      a->scale[i] * a->shape[a->shape_id[i]].bounding_radius);
    }
    return bounding_radius;
}

/// Adds the columns; pointers are asked for at the end, since adding moves none of them.
static clast_status make_columns(clast_table *table)
{
    static const char *const column[][2] = {{"radius_low_m", "m"},   {"radius_high_m", "m"},
                                            {"solid_m3", "m^3"},     {"solid_error_m3", "m^3"},
                                            {"solid_fraction", "-"}, {"density_kg/m^3", "kg/m^3"}};
    clast_status status = CLAST_OK;
    for (size_t k = 0; k < sizeof column / sizeof column[0]; ++k) {
        CLX_TRY(clast_table_add_number(table, column[k][0], column[k][1], NULL));
    }
done:
    return status;
}

clast_status clast_assembly_radial_profile(const clast_assembly *assembly, const double centre[3],
                                           int32_t n_bin, clast_table *table)
{
    CLX_ARGUMENTS(assembly, table);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clast_table made = {0};
    clx_touch_set set = {0};
    double c[3];
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to measure");
    CLX_CHECK(n_bin >= 1 && n_bin <= 1000000, CLAST_E_USAGE, "radial profile of %d shells", n_bin);
    clast_assembly_centre(assembly, c);
    if (centre != NULL) {
        v3_copy(c, centre);
    }
    CLX_TRY(clx_touch_set_init(assembly, &set));
    CLX_TRY(clast_table_init(&made, "radial_profile", n_bin));
    CLX_TRY(make_columns(&made));
    profile p = {.n_bin = n_bin,
                 .step = bounding_radius_of(assembly, c) / n_bin,
                 .solid = clast_table_numbers(&made, "solid_m3"),
                 .error = clast_table_numbers(&made, "solid_error_m3"),
                 .mass = clast_table_numbers(&made, "density_kg/m^3")};
    add_grains(assembly, &set, c, &p);
    for (int32_t k = 0; k < n_bin; ++k) {
        const double shell = shell_volume(&p, k);
        made.column[0].number[k] = k * p.step;
        made.column[1].number[k] = (k + 1) * p.step;
        p.error[k] = sqrt(p.error[k]);
        made.column[4].number[k] = p.solid[k] / shell;
        p.mass[k] /= shell;
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    clx_touch_set_free(&set);
    return status;
}
