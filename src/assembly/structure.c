// All measures of an assembly in one table, each with its uncertainty.
#include <clast/assembly.h>

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/status.h"
#include <clast/settling.h>
#include <clast/shape.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>

clast_structure_options clast_structure_options_default(void)
{
    return (clast_structure_options){.envelope = clast_envelope_options_default(),
                                     .solid = clast_union_options_default(),
                                     .fluid = clast_fluid_air(),
                                     .n_line = 512,
                                     .n_direction = 24};
}

clast_status clast_assembly_coordination(const clast_assembly *assembly, clast_table *table)
{
    CLX_ARGUMENTS(assembly, table);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clast_table made = {0};
    int32_t *count = NULL;
    int32_t most = 0;
    double *grains = NULL;
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to measure");
    CLX_CHECK(assembly->contact != NULL, CLAST_E_USAGE,
              "the contacts of this assembly are not known: find them first");
    CLX_TRY(clx_alloc(&count, assembly->n_grain, sizeof *count));
    for (int32_t c = 0; c < assembly->n_contact; ++c) {
        for (int k = 0; k < 2; ++k) {
            const int32_t n = ++count[assembly->contact[c][k]];
            most = n > most ? n : most;
        }
    }
    CLX_TRY(clast_table_init(&made, "coordination", most + 1));
    CLX_TRY(clast_table_add_number(&made, "coordination", "-", NULL));
    CLX_TRY(clast_table_add_number(&made, "n_grain", "-", NULL));
    CLX_TRY(clast_table_add_number(&made, "share", "-", NULL));
    grains = made.column[1].number;
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        grains[count[i]] += 1.0;
    }
    for (int32_t k = 0; k <= most; ++k) {
        made.column[0].number[k] = k;
        made.column[2].number[k] = grains[k] / assembly->n_grain;
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    clx_free(count);
    return status;
}

/// A measure's row.
typedef struct row {
    const char *name;
    double value, error;
    const char *unit, *meaning;
} row;

static clast_status add_row(clast_table *table, const row *r)
{
    clast_status status = CLAST_OK;
    const int64_t at = table->n_row;
    CLX_TRY(clast_table_resize(table, at + 1));
    CLX_TRY(clast_table_set_text(table, 0, at, r->name));
    table->column[1].number[at] = r->value;
    table->column[2].number[at] = r->error;
    CLX_TRY(clast_table_set_text(table, 3, at, r->unit));
    CLX_TRY(clast_table_set_text(table, 4, at, r->meaning));
done:
    return status;
}

/// A row whose name ends in that of an envelope.
static clast_status add_envelope_row(clast_table *table, const char *stem, clast_envelope_kind kind,
                                     const row *r)
{
    char name[64];
    row named = *r;
    (void)snprintf(name, sizeof name, "%s_%s", stem, clast_envelope_name(kind));
    named.name = name;
    return add_row(table, &named);
}

static clast_status add_solid(const clast_assembly *a, const clast_structure_options *options,
                              clast_union *solid, clast_table *table)
{
    clast_status status = CLAST_OK;
    const double mass = clast_assembly_mass(a);
    CLX_TRY(clast_assembly_union(a, &options->solid, solid));
    const row rows[] = {
        {"n_grain", a->n_grain, 0.0, "-", "grains"},
        {"mass", mass, 1e-14 * mass, "kg", "sum of volume times density"},
        {"solid_sum", solid->sum, 1e-14 * solid->sum, "m^3", "sum of the grains' volumes"},
        {"solid_union", solid->volume, solid->error, "m^3", "space that the grains fill"},
        {"max_overlap_surfaces", solid->max_overlap, 1e-3 * solid->max_overlap, "m",
         "deepest overlap of two grains' true surfaces"},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        CLX_TRY(add_row(table, &rows[k]));
    }
    if (a->contact != NULL) {
        const row contact[] = {
            {"n_contact", a->n_contact, 0.0, "-", "touching pairs"},
            {"coordination", 2.0 * a->n_contact / a->n_grain, 0.0, "-", "mean contacts of a grain"},
        };
        CLX_TRY(add_row(table, &contact[0]));
        CLX_TRY(add_row(table, &contact[1]));
    }
done:
    return status;
}

static clast_status add_extent(const clast_assembly *a, clast_extent *e, clast_table *table)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_assembly_extent(a, e));
    const double gyration = clast_assembly_radius_of_gyration(a);
    const row rows[] = {
        {"radius_of_gyration", gyration, 1e-14 * gyration, "m",
         "of the mass, with the grains' own"},
        {"length", e->length, 1e-9 * e->length, "m", "greatest distance of two points"},
        {"width_1", e->width[0], 1e-9 * e->width[0], "m", "across the first principal axis, L"},
        {"width_2", e->width[1], 1e-9 * e->width[1], "m", "I"},
        {"width_3", e->width[2], 1e-9 * e->width[2], "m", "S"},
        {"elongation", e->width[1] / e->width[0], 2e-9, "-", "I / L"},
        {"flatness", e->width[2] / e->width[1], 2e-9, "-", "S / I"},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        CLX_TRY(add_row(table, &rows[k]));
    }
done:
    return status;
}

static clast_status add_projections(const clast_assembly *a, const clast_structure_options *options,
                                    clast_extent *e, clast_table *table)
{
    static const char *const name[3] = {"projected_area_1", "projected_area_2", "projected_area_3"};
    static const char *const meaning[3] = {"shadow along the first principal axis",
                                           "along the second", "along the third"};
    clast_status status = CLAST_OK;
    double area = 0.0;
    double error = 0.0;
    for (int k = 0; k < 3; ++k) {
        CLX_TRY(clast_assembly_projected_area(a, e->axis[k], options->n_line, &area, &error));
        CLX_TRY(add_row(table, &(row){name[k], area, error, "m^2", meaning[k]}));
    }
    CLX_TRY(
        clast_assembly_mean_projection(a, options->n_direction, options->n_line, &area, &error));
    CLX_TRY(add_row(table, &(row){"projected_area_mean", area, error, "m^2",
                                  "shadow averaged over directions"}));
done:
    return status;
}

/// How far above 3 the correlation dimension of a solid body may come out (docs/theory).
static const double CORRELATION_ERROR = 0.05;

/// What a fitted slope is: mass fills space at most with the third power of the radius.
static const char *say_slope(const clast_fractal *f, double error, const char *meaning)
{
    return f->dimension > 3.0 + error ? "fitted slope; above 3, so no fractal over this range"
                                      : meaning;
}

static clast_status add_fractal(const clast_assembly *a, const clast_structure_options *options,
                                clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_fractal f;
    const int32_t tenth = a->n_grain / 10;
    const int32_t first = options->n_first > 0 ? options->n_first : tenth > 5 ? tenth : 5;
    if (options->n_first >= 0 && first < a->n_grain &&
        clast_fractal_growth(a, first, &f) == CLAST_OK) {
        CLX_TRY(add_row(
            table, &(row){"fractal_growth", f.dimension, f.dimension_error, "-",
                          say_slope(&f, 0.0, "dimension by radius of gyration during growth")}));
        CLX_TRY(add_row(table, &(row){"fractal_growth_prefactor", f.prefactor, f.prefactor_error,
                                      "-", "k in N = k (R_g / a)^D"}));
    }
    if (clast_fractal_correlation(a, &f) == CLAST_OK) {
        CLX_TRY(add_row(table, &(row){"fractal_correlation", f.dimension, f.dimension_error, "-",
                                      say_slope(&f, CORRELATION_ERROR,
                                                "dimension by the solid about a grain")}));
        CLX_TRY(
            add_row(table, &(row){"fractal_correlation_prefactor", f.prefactor, f.prefactor_error,
                                  "-", "k in n(r) = k (r / a)^D, edges corrected"}));
    }
done:
    return status;
}

/// What follows from one envelope: porosity and packing by the sum of the grains' volumes, as
/// density is, porosity by their union, D_agg, terminal velocity.
static clast_status add_envelope(const clast_structure_options *options, const clast_union *solid,
                                 double mass, const clast_extent *e, const clast_envelope *envelope,
                                 clast_table *table)
{
    clast_status status = CLAST_OK;
    const double v = envelope->volume;
    const double share = envelope->error / v;
    const double packing = solid->sum / v;
    const double filled = solid->volume / v;
    const double filled_error = hypot(solid->error / v, filled * share);
    const double d = cbrt(6.0 * v / CLAST_PI);
    const double density = mass / v;
    clast_drag drag;
    clast_settling fall;
    const row rows[] = {
        {"envelope", v, envelope->error, "m^3", clast_envelope_text(envelope->kind)},
        {"porosity", 1.0 - packing, packing * share, "-", "1 - solid_sum / envelope"},
        {"packing", packing, packing * share, "-", "solid_sum / envelope"},
        {"porosity_union", 1.0 - filled, filled_error, "-", "1 - solid_union / envelope"},
        {"density", density, density * share, "kg/m^3", "mass / envelope"},
        {"d_agg", d, d * share / 3.0, "m", "diameter of the sphere of the envelope's volume"},
    };
    static const char *const stem[] = {"envelope",       "porosity", "packing",
                                       "porosity_union", "density",  "d_agg"};
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        CLX_TRY(add_envelope_row(table, stem[k], envelope->kind, &rows[k]));
    }
    CLX_TRY(clast_drag_of_form(e->width[0], e->width[1], e->width[2], d,
                               density / options->fluid.density, &drag));
    CLX_TRY(clast_terminal_velocity(d, density, &drag, &options->fluid, &fall));
    // mass is fixed, so the velocity feels the envelope through its diameter alone: about -1/2 to
    // -1
    CLX_TRY(add_envelope_row(table, "settling_velocity", envelope->kind,
                             &(row){NULL, fall.velocity, fall.velocity * share / 3.0, "m/s",
                                    "terminal velocity, Bagheri & Bonadonna 2016"}));
done:
    return status;
}

static bool has_spheres(const clast_assembly *a)
{
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const clast_shape *shape = &a->shape[a->shape_id[i]];
        if (shape->kind != CLAST_SHAPE_SPHERE && shape->spheres.n == 0) {
            return false;
        }
    }
    return true;
}

static clast_status fill_rows(const clast_assembly *a, const clast_structure_options *options,
                              clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_union solid;
    clast_extent extent;
    const bool spheres = has_spheres(a);
    CLX_TRY(add_solid(a, options, &solid, table));
    CLX_TRY(add_extent(a, &extent, table));
    for (int k = 0; k < CLAST_N_ENVELOPE; ++k) {
        const clast_envelope_kind kind = (clast_envelope_kind)k;
        clast_envelope envelope;
        const bool of_spheres =
            kind == CLAST_ENVELOPE_SPHERE_HULL || kind == CLAST_ENVELOPE_SPHERE_RAYS;
        if ((of_spheres && !spheres) || (kind == CLAST_ENVELOPE_ALPHA && !options->alpha) ||
            (kind == CLAST_ENVELOPE_WRAP && !(options->envelope.length > 0.0))) {
            continue;
        }
        CLX_TRY(clast_assembly_envelope(a, kind, &options->envelope, &envelope));
        CLX_TRY(add_envelope(options, &solid, clast_assembly_mass(a), &extent, &envelope, table));
    }
    CLX_TRY(add_projections(a, options, &extent, table));
    CLX_TRY(add_fractal(a, options, table));
done:
    return status;
}

clast_status clast_structure(const clast_assembly *assembly, const clast_structure_options *options,
                             clast_table *table)
{
    CLX_ARGUMENTS(assembly, options, table);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clast_table made = {0};
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to measure");
    CLX_TRY(clast_table_init(&made, "structure", 0));
    CLX_TRY(clast_table_add_text(&made, "name"));
    CLX_TRY(clast_table_add_number(&made, "value", "", NULL));
    CLX_TRY(clast_table_add_number(&made, "error", "", NULL));
    CLX_TRY(clast_table_add_text(&made, "unit"));
    CLX_TRY(clast_table_add_text(&made, "meaning"));
    CLX_TRY(fill_rows(assembly, options, &made));
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}
