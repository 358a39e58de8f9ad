// Porosity by distance from the axis of a cylinder, by even points inside the grains.
#include <clast/porosity.h>

#include "assembly/grain_points.h"
#include "assembly/touch_set.h"
#include "assembly/whole.h"
#include "base/column_unit.h"
#include "base/status.h"
#include "porosity/whole.h"
#include <clast/shape.h>
#include <math.h>

enum { POINTS = 512, RING_LIMIT = 1000000 };

/// Rings under construction; error is a variance until the end.
typedef struct {
    const clast_bed *bed;
    double z_low, z_high, step;
    int32_t n_ring, n_point;
    double *solid, *error;
} rings;

/// Adds a point that stands for `volume`.
static void add_point(const rings *r, const double x[3], double volume)
{
    const double rho = hypot(x[0] - r->bed->centre[0], x[1] - r->bed->centre[1]);
    const double k = floor(rho / r->step);
    if (x[2] < r->z_low || x[2] > r->z_high || (r->bed->is_part && rho > r->bed->radius)) {
        return;
    }
    // What pokes through a wall counts in the last ring.
    const int32_t ring = k < r->n_ring ? (int32_t)k : r->n_ring - 1;
    r->solid[ring] += volume;
    r->error[ring] += volume * volume;
}

/// Each grain has other points, or the errors of grains that lie alike add up.
static void add_grain(const rings *r, int32_t i, const clx_touch_body *body, double volume)
{
    double c[3];
    double point[3];
    int32_t n = 0;
    // A surface fills at least a thousandth of its box, or its points are few.
    clx_lattice_begin((int64_t)r->n_point * i, c);
    for (int64_t tried = 0; n < r->n_point && tried < 1000LL * r->n_point; ++tried) {
        clx_lattice_step(c);
        n += clx_body_draw(body, c, point) ? 1 : 0;
    }
    const int32_t n_found = n;
    clx_lattice_begin((int64_t)r->n_point * i, c);
    for (n = 0; n < n_found;) { // the same points again, now that their number is known
        clx_lattice_step(c);
        if (clx_body_draw(body, c, point)) {
            add_point(r, point, volume / n_found);
            ++n;
        }
    }
}

static void add_grains(const clast_assembly *a, const clx_touch_set *set,
                       clast_porosity_method method, const rings *r)
{
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const double s = a->scale[i];
        const double volume = s * s * s * a->shape[a->shape_id[i]].volume;
        if (method == CLAST_POROSITY_SPHERES) {
            const double upright[4] = {1.0, 0.0, 0.0, 0.0};
            clx_touch_body ball = clx_touch_body_sphere(cbrt(0.75 / CLAST_PI * volume));
            clx_touch_body_place(&ball, a->position[i], upright, 1.0);
            add_grain(r, i, &ball, volume);
        } else {
            add_grain(r, i, clx_touch_scene_body(set->scene, i), volume);
        }
    }
}

clast_status clast_porosity_radial(const clast_assembly *assembly, const clast_bed *bed,
                                   const double z[2], const clast_radial_options *options,
                                   clast_table *table)
{
    CLX_ARGUMENTS(assembly, bed, z, options, table);
    CLX_WHOLE(assembly, assembly);
    CLX_WHOLE(bed, bed);
    static const char *const column[][2] = {{"r_low_m", "m"},    {"r_high_m", "m"},
                                            {"solid_m3", "m^3"}, {"solid_error_m3", "m^3"},
                                            {"porosity", "-"},   {"porosity_error", "-"}};
    clast_status status = CLAST_OK;
    clast_table made = {0};
    clx_touch_set set = {0};
    const int32_t n_ring = options->n_ring;
    CLX_CHECK(bed->kind == CLAST_BED_CYLINDER && bed->radius > 0.0, CLAST_E_USAGE,
              "a radial profile needs a cylindrical bed");
    CLX_CHECK((unsigned)options->method <= CLAST_POROSITY_SPHERES, CLAST_E_ARGUMENT,
              "radial profile: there is no method %d", (int)options->method);
    CLX_CHECK(assembly->n_grain > 0 && z[1] > z[0], CLAST_E_USAGE,
              "no grain to measure between %g and %g", z[0], z[1]);
    CLX_CHECK(n_ring >= 1 && n_ring <= RING_LIMIT && options->n_point >= 0, CLAST_E_USAGE,
              "radial profile of %d rings", n_ring);
    CLX_TRY(clx_touch_set_init(assembly, &set));
    CLX_TRY(clast_table_init(&made, "radial", n_ring));
    CLX_TRY(CLX_ADD_COLUMNS(&made, column));
    const rings r = {.bed = bed,
                     .z_low = z[0],
                     .z_high = z[1],
                     .step = bed->radius / n_ring,
                     .n_ring = n_ring,
                     .n_point = options->n_point > 0 ? options->n_point : POINTS,
                     .solid = made.column[2].number,
                     .error = made.column[3].number};
    add_grains(assembly, &set, options->method, &r);
    for (int32_t k = 0; k < n_ring; ++k) {
        const double low = k * r.step;
        const double high = (k + 1) * r.step;
        const double volume = CLAST_PI * (high * high - low * low) * (z[1] - z[0]);
        made.column[0].number[k] = low;
        made.column[1].number[k] = high;
        r.error[k] = sqrt(r.error[k]);
        made.column[4].number[k] = 1.0 - r.solid[k] / volume;
        made.column[5].number[k] = r.error[k] / volume;
    }
    *table = made;
    made = (clast_table){0};
done:
    clx_touch_set_free(&set);
    clast_table_free(&made);
    return status;
}
