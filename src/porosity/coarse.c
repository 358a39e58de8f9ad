// Continuum fields of a bed from its grains and contacts, on a grid. [docs/theory/load.md
// "Coarse-grained fields"]
//
// Goldhirsch's fields [Goldhirsch2010] with Weinhart's contribution of walls [Weinhart2012]:
//
//     density   rho(r) = sum m_i phi(r - r_i)              momentum  sum m_i v_i phi(r - r_i)
//     stress    sum f l int_0^1 phi(r - r_a - s l) ds + sum m v v phi - rho V V
//     walls     t(r) = - sum f phi(r - c),  f of a grain on a wall at c
//
// phi is a Gaussian in x, y and z, cut off at five standard deviations and normed to 1. Each cell
// of the grid has the mean of a field over it, by differences of error functions, so that sums over
// cells are those over grains to rounding: mass, momentum, virial. At a wall the branch ends in the
// contact, and div stress = rho g + t holds up to it and beyond.
#include <clast/porosity.h>

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/status.h"
#include "math/quadrature.h"
#include "math/vec3.h"
#include "porosity/contact_columns.h"
#include "porosity/whole.h"
#include <clast/assembly.h>
#include <clast/shape.h>
#include <math.h>
#include <string.h>

/// Cut-off in standard deviations, and what a Gaussian holds within it.
static const double CUT = 5.0;
static const double HELD = 0.99999942669685624;

static const double MOST_WIDTHS = 1e5; ///< of a branch

enum { MOST_CELLS = 50000000, REACH = 32 };

enum { DENSITY, SOLID, MOMENTUM, STRESS = 5, MOTION = 11, WALL = 17, N_FIELD = 20 };

static const int ENTRY[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

typedef struct {
    double width; ///< of the Gaussian
    double low[3], step[3];
    int64_t n[3];
    bool is_periodic[3];
    double shift;                    ///< along x of the images above
    bool has_forces, has_velocities; ///< else what comes from them is NAN
    double (*cell)[N_FIELD];
} grid;

/// Shares of a Gaussian about x that cells `first` to `first + n - 1` of an axis hold; how many.
static int shares(const grid *g, int axis, double x, int64_t *first, double share[REACH])
{
    const double from = (x - CUT * g->width - g->low[axis]) / g->step[axis];
    const double to = (x + CUT * g->width - g->low[axis]) / g->step[axis];
    const int n = (int)(floor(to) - floor(from)) + 1;
    double below = 0.0;
    CLAST_ASSERT(n >= 1 && n <= REACH);
    *first = (int64_t)floor(from);
    for (int k = 0; k < n; ++k) {
        const double edge = g->low[axis] + (double)(*first + k + 1) * g->step[axis];
        const double u = fmax(-CUT, fmin(CUT, (edge - x) / g->width));
        const double up = k + 1 == n ? 1.0 : 0.5 + 0.5 * erf(u * 0.70710678118654752440) / HELD;
        share[k] = up - below;
        below = up;
    }
    return n;
}

static int64_t wrapped(const grid *g, int axis, int64_t k)
{
    const int64_t n = g->n[axis];
    CLAST_ASSERT(g->is_periodic[axis] || (k >= 0 && k < n));
    return g->is_periodic[axis] ? ((k % n) + n) % n : k;
}

/// Periods above the first image that row k of the grid lies.
static double image_of(const grid *g, int64_t k)
{
    return g->is_periodic[2] ? floor((double)k / (double)g->n[2]) : 0.0;
}

/// Spreads values at a place into the fields from `first` on.
static void spread(grid *g, const double x[3], int first, int n_value, const double *value)
{
    int64_t begin[3];
    double share[3][REACH];
    int n[3];
    for (int axis = 0; axis < 3; ++axis) {
        n[axis] = shares(g, axis, x[axis], &begin[axis], share[axis]);
    }
    for (int k = 0; k < n[2]; ++k) {
        const int64_t at_z = wrapped(g, 2, begin[2] + k);
        const double image = image_of(g, begin[2] + k);
        if (g->shift != 0.0 && (k == 0 || image != image_of(g, begin[2] + k - 1))) {
            n[0] = shares(g, 0, x[0] - image * g->shift, &begin[0], share[0]);
        }
        for (int j = 0; j < n[1]; ++j) {
            const int64_t row = (at_z * g->n[1] + wrapped(g, 1, begin[1] + j)) * g->n[0];
            const double both = share[2][k] * share[1][j];
            for (int i = 0; i < n[0]; ++i) {
                double *into = g->cell[row + wrapped(g, 0, begin[0] + i)] + first;
                const double all = both * share[0][i];
                for (int v = 0; v < n_value; ++v) {
                    into[v] += all * value[v];
                }
            }
        }
    }
}

/// velocity [3] columns, or NULL: at rest.
static void spread_grains(grid *g, const clast_assembly *a, const double *const *velocity)
{
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const double s = a->scale[i];
        const double volume = s * s * s * a->shape[a->shape_id[i]].volume;
        const double mass = volume * a->density[i];
        double v[3] = {0.0, 0.0, 0.0};
        double motion[6];
        for (int k = 0; k < 3 && velocity != NULL && velocity[k] != NULL; ++k) {
            v[k] = velocity[k][i];
        }
        for (int e = 0; e < 6; ++e) {
            motion[e] = mass * v[ENTRY[e][0]] * v[ENTRY[e][1]];
        }
        const double value[5] = {mass, volume, mass * v[0], mass * v[1], mass * v[2]};
        spread(g, a->position[i], DENSITY, 5, value);
        spread(g, a->position[i], MOTION, 6, motion);
    }
}

/// A contact's stress, evenly along its branch: pieces of at most two widths, 12 points each.
static void spread_branch(grid *g, const double from[3], const double branch[3],
                          const double force[3])
{
    const int n_piece = 1 + (int)(0.5 * v3_norm(branch) / g->width);
    double value[6];
    for (int piece = 0; piece < n_piece; ++piece) {
        for (int q = 0; q < CLX_GAUSS_N; ++q) {
            const double s = (piece + clx_gauss_point(q)) / n_piece;
            const double w = clx_gauss_weight(q) / n_piece;
            double x[3];
            v3_axpy(x, from, s, branch);
            for (int e = 0; e < 6; ++e) {
                const int i = ENTRY[e][0];
                const int j = ENTRY[e][1];
                value[e] = 0.5 * w * (force[i] * branch[j] + force[j] * branch[i]);
            }
            spread(g, x, STRESS, 6, value);
        }
    }
}

static clast_status spread_contacts(grid *g, const clast_assembly *a, const clx_contacts *c)
{
    clast_status status = CLAST_OK;
    for (int64_t k = 0; k < c->n; ++k) {
        double branch[3];
        double force[3];
        double end[3];
        CLX_CHECK(c->a[k] >= 0.0 && c->a[k] < a->n_grain, CLAST_E_FORMAT,
                  "contact %lld is one of grain %g of %d", (long long)k + 1, c->a[k], a->n_grain);
        const double *from = a->position[(int32_t)c->a[k]];
        for (int i = 0; i < 3; ++i) {
            branch[i] = c->branch[i][k];
            force[i] = c->force[i][k];
        }
        CLX_CHECK(v3_is_finite(branch) && v3_is_finite(force), CLAST_E_FORMAT,
                  "contact %lld has no finite force and branch", (long long)k + 1);
        CLX_CHECK(v3_norm(branch) <= MOST_WIDTHS * g->width, CLAST_E_FORMAT,
                  "contact %lld has a branch of %s, above %g widths of %s", (long long)k + 1,
                  clx_unit_text(v3_norm(branch), "m"), MOST_WIDTHS, clx_unit_text(g->width, "m"));
        spread_branch(g, from, branch, force);
        if (c->b[k] < 0.0) {
            v3_add(end, from, branch);
            v3_scale(force, -1.0, force);
            spread(g, end, WALL, 3, force);
        }
    }
done:
    return status;
}

/// What of all places lies farthest out along an axis.
static void extend(const clast_assembly *a, const clx_contacts *c, int axis, double *low,
                   double *high)
{
    for (int32_t i = 0; i < a->n_grain; ++i) {
        *low = fmin(*low, a->position[i][axis]);
        *high = fmax(*high, a->position[i][axis]);
    }
    for (int64_t k = 0; k < c->n; ++k) {
        if (c->a[k] >= 0.0 && c->a[k] < a->n_grain) {
            const double end = a->position[(int32_t)c->a[k]][axis] + c->branch[axis][k];
            *low = fmin(*low, end);
            *high = fmax(*high, end);
        }
    }
}

/// Cells as wide as the Gaussian or less: periodic sides are divided evenly, others have borders at
/// the bed's own and reach out until nothing is cut off.
static clast_status make_grid(const clast_bed *bed, const clast_assembly *a, const clx_contacts *c,
                              double width, grid *g)
{
    clast_status status = CLAST_OK;
    double period[3];
    double n_cell = 1.0;
    (void)clast_bed_period(bed, period);
    g->width = width;
    g->shift = period[2] > 0.0 ? bed->shift : 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double from = axis == 2                         ? bed->floor
                            : bed->kind == CLAST_BED_CYLINDER ? bed->centre[axis] - bed->radius
                                                              : bed->low[axis];
        double low = from;
        double high = from;
        g->is_periodic[axis] = period[axis] > 0.0;
        if (g->is_periodic[axis]) {
            CLX_CHECK(width <= period[axis], CLAST_E_USAGE,
                      "fields of width %g in a bed that repeats after %g: take less", width,
                      period[axis]);
            const double n = ceil(period[axis] / width * (1.0 - 1e-12));
            g->low[axis] = from;
            g->step[axis] = period[axis] / n;
            g->n[axis] = (int64_t)fmin(n, 1e9);
        } else {
            extend(a, c, axis, &low, &high);
            const double below = ceil((from - low) / width + CUT);
            const double above = ceil((high - from) / width + CUT) + 1.0;
            g->low[axis] = from - below * width;
            g->step[axis] = width;
            g->n[axis] = (int64_t)fmin(below + above, 1e9);
        }
        n_cell *= (double)g->n[axis];
    }
    CLX_CHECK(n_cell <= MOST_CELLS, CLAST_E_LIMIT,
              "fields of width %g have %g cells, at most %d: take a greater width", width, n_cell,
              MOST_CELLS);
    CLX_TRY(clx_alloc(&g->cell, g->n[0] * g->n[1] * g->n[2], sizeof *g->cell));
done:
    return status;
}

static const struct {
    const char *name, *unit;
} columns[] = {{"x_m", "m"},
               {"y_m", "m"},
               {"z_m", "m"},
               {"dx_m", "m"},
               {"dy_m", "m"},
               {"dz_m", "m"},
               {"density_kg/m^3", "kg/m^3"},
               {"solid", "-"},
               {"velocity_x_m/s", "m/s"},
               {"velocity_y_m/s", "m/s"},
               {"velocity_z_m/s", "m/s"},
               {"stress_xx_Pa", "Pa"},
               {"stress_yy_Pa", "Pa"},
               {"stress_zz_Pa", "Pa"},
               {"stress_xy_Pa", "Pa"},
               {"stress_xz_Pa", "Pa"},
               {"stress_yz_Pa", "Pa"},
               {"kinetic_stress_xx_Pa", "Pa"},
               {"kinetic_stress_yy_Pa", "Pa"},
               {"kinetic_stress_zz_Pa", "Pa"},
               {"kinetic_stress_xy_Pa", "Pa"},
               {"kinetic_stress_xz_Pa", "Pa"},
               {"kinetic_stress_yz_Pa", "Pa"},
               {"wall_force_x_N/m^3", "N/m^3"},
               {"wall_force_y_N/m^3", "N/m^3"},
               {"wall_force_z_N/m^3", "N/m^3"}};
enum { N_COLUMN = sizeof columns / sizeof columns[0], PLACES = 6 };
_Static_assert((int)N_COLUMN == (int)N_FIELD + PLACES, "a column a field behind the places");

/// Sums of a cell become fields: densities, mean velocity, kinetic stress beside it.
static void finish_cell(double volume, double f[N_FIELD])
{
    for (int k = 0; k < N_FIELD; ++k) {
        f[k] /= volume;
    }
    const double rho = f[DENSITY];
    for (int e = 0; e < 6; ++e) {
        const double *p = f + MOMENTUM;
        f[MOTION + e] -= rho > 0.0 ? p[ENTRY[e][0]] * p[ENTRY[e][1]] / rho : 0.0;
    }
    for (int k = 0; k < 3; ++k) {
        f[MOMENTUM + k] = rho > 0.0 ? f[MOMENTUM + k] / rho : (double)NAN;
    }
}

static clast_status make_table(grid *g, clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_table made = {0};
    const int64_t n = g->n[0] * g->n[1] * g->n[2];
    const double volume = g->step[0] * g->step[1] * g->step[2];
    CLX_TRY(clast_table_init(&made, "fields", n));
    for (int c = 0; c < N_COLUMN; ++c) {
        CLX_TRY(clast_table_add_number(&made, columns[c].name, columns[c].unit, NULL));
    }
    for (int64_t row = 0; row < n; ++row) {
        const int64_t at[3] = {row % g->n[0], row / g->n[0] % g->n[1], row / (g->n[0] * g->n[1])};
        finish_cell(volume, g->cell[row]);
        for (int axis = 0; axis < 3; ++axis) {
            made.column[axis].number[row] = g->low[axis] + ((double)at[axis] + 0.5) * g->step[axis];
            made.column[3 + axis].number[row] = g->step[axis];
        }
        for (int f = 0; f < N_FIELD; ++f) {
            const bool is_force = (f >= STRESS && f < MOTION) || f >= WALL;
            const bool is_known = f < MOMENTUM || (is_force ? g->has_forces : g->has_velocities);
            made.column[PLACES + f].number[row] = is_known ? g->cell[row][f] : (double)NAN;
        }
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

static clast_status find_velocities(const clast_table *table, const clast_assembly *a,
                                    const double *velocity[3])
{
    static const char *const name[3] = {"velocity_x_m/s", "velocity_y_m/s", "velocity_z_m/s"};
    clast_status status = CLAST_OK;
    for (int k = 0; k < 3; ++k) {
        velocity[k] = table != NULL ? clast_table_numbers(table, name[k]) : NULL;
        CLX_CHECK(table == NULL || (velocity[k] != NULL && table->n_row == a->n_grain),
                  CLAST_E_FORMAT, "table '%s' holds no velocities of %d grains", table->name,
                  a->n_grain);
    }
done:
    return status;
}

clast_status clast_bed_fields(const clast_bed *bed, const clast_assembly *assembly,
                              const clast_table *contacts, const clast_table *velocities,
                              double width, clast_table *table)
{
    CLX_ARGUMENTS(bed, assembly, table);
    CLX_WHOLE(bed, bed);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clx_contacts c = {0};
    const double *velocity[3] = {NULL};
    grid g = {0};
    CLX_CHECK(width > 0.0 && isfinite(width), CLAST_E_USAGE, "fields of width %g: above 0", width);
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain has no field");
    if (contacts != NULL) {
        CLX_WHOLE(table, contacts);
        CLX_TRY(clx_contacts_read(contacts, &c));
    }
    CLX_TRY(find_velocities(velocities, assembly, velocity));
    CLX_TRY(make_grid(bed, assembly, &c, width, &g));
    g.has_forces = contacts != NULL;
    g.has_velocities = velocities != NULL;
    spread_grains(&g, assembly, velocities != NULL ? velocity : NULL);
    CLX_TRY(spread_contacts(&g, assembly, &c));
    CLX_TRY(make_table(&g, table));
done:
    clx_free(g.cell);
    return status;
}
