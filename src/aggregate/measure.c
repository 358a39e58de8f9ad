// Envelopes of a growing aggregate: one tracker, a set of columns, and the numbers at the end.
#include "aggregate/state.h"

#include "assembly/union.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "base/parallel.h"
#include <clast/assembly.h>
#include <clast/settling.h>
#include <math.h>
#include <stdio.h>

/// Gap between the bounds of a smooth body's hull while it grows, and at the end.
static const double ROW_TOLERANCE = 2e-3;
static const double END_TOLERANCE = 1e-3;

/// Where grains overlap (the march, composites), the union is sampled to this standard error.
static const double SOLID_TOLERANCE = 1e-3;
enum { SOLID_SAMPLES = 1 << 16 };

static clast_envelope_options options_of(const clast_aggregate *a, double tolerance)
{
    clast_envelope_options options = clast_envelope_options_default();
    options.tolerance = tolerance;
    options.n_ray = a->params->envelope_rays;
    options.seed = a->seed;
    options.length = a->params->envelope_length;
    return options;
}

static clast_status add_columns(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    char name[CLX_HISTORY_NAME];
    CLX_TRY(clx_history_column(&a->history, "d_agg_m", "m"));
    CLX_TRY(clx_history_column(&a->history, "density_kg/m^3", "kg/m^3"));
    for (int32_t k = 0; k < a->n_kind; ++k) {
        (void)snprintf(name, sizeof name, "porosity_%s", clast_envelope_name(a->kind[k]));
        CLX_TRY(clx_history_column(&a->history, name, "-"));
    }
    for (int32_t k = 0; k < a->n_kind; ++k) {
        (void)snprintf(name, sizeof name, "%s_m3", clast_envelope_name(a->kind[k]));
        CLX_TRY(clx_history_column(&a->history, name, "m^3"));
    }
    if (a->params->fall_speed) {
        CLX_TRY(clx_history_column(&a->history, "settling_velocity_m/s", "m/s"));
    }
done:
    return status;
}

clast_status clx_aggregate_measure_begin(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    const clast_text_list *names = &a->params->envelope;
    const clast_envelope_options options = options_of(a, ROW_TOLERANCE);
    CLX_CHECK(names->n <= CLAST_N_ENVELOPE, CLAST_E_CONFIG, "envelope: %d names, %d envelopes",
              names->n, (int)CLAST_N_ENVELOPE);
    for (int32_t k = 0; k < names->n; ++k) {
        CLX_TRY(clast_envelope_parse(names->item[k], &a->kind[k]));
        for (int32_t j = 0; j < k; ++j) {
            CLX_CHECK(a->kind[j] != a->kind[k], CLAST_E_CONFIG, "envelope: %s is named twice",
                      names->item[k]);
        }
    }
    a->n_kind = names->n;
    if (a->mode->is_one_body) {
        CLX_TRY(clx_envelope_tracker_create(a->n_kind, a->kind, &options, &a->tracker));
    }
    CLX_TRY(add_columns(a));
done:
    return status;
}

static double equivalent_diameter(double volume)
{
    CLAST_ASSERT(!(volume < 0.0));
    return cbrt(6.0 * volume / CLAST_PI);
}

static void fill_row(const clast_aggregate *a, double mass, double solid,
                     const clast_envelope *envelope, double *row)
{
    double *at = &row[CLX_HISTORY_FIXED];
    at[0] = equivalent_diameter(envelope[0].volume);
    at[1] = mass / envelope[0].volume;
    for (int32_t k = 0; k < a->n_kind; ++k) {
        at[2 + k] = 1.0 - solid / envelope[k].volume;
        at[2 + a->n_kind + k] = envelope[k].volume;
    }
}

/// The settling velocity of these grains, into the row's last column.
static clast_status fill_speed(const clast_aggregate *a, const clast_assembly *grains, double *row)
{
    clast_status status = CLAST_OK;
    const double *at = &row[CLX_HISTORY_FIXED];
    clast_extent extent;
    clast_drag drag;
    if (!a->params->fall_speed) {
        return CLAST_OK;
    }
    CLX_TRY(clast_assembly_extent(grains, &extent));
    CLX_TRY(
        clx_aggregate_fall_speed(extent.width, at[0], at[1], &drag, &row[a->history.n_column - 1]));
done:
    return status;
}

/// Rows that are not asked for hold no envelope.
static bool is_measured(clast_aggregate *a, double *row)
{
    const bool wanted = a->n_placed % a->params->envelope_every == 0 || a->n_placed == a->n_step;
    for (int32_t c = CLX_HISTORY_FIXED; c < a->history.n_column && !wanted; ++c) {
        row[c] = (double)NAN;
    }
    return wanted;
}

clast_status clx_aggregate_measure_row(clast_aggregate *a, double *row)
{
    CLAST_ASSERT(a->history.n_column >= CLX_HISTORY_FIXED);
    clast_status status = CLAST_OK;
    clast_envelope envelope[CLAST_N_ENVELOPE];
    const double begun = clx_clock();
    if (is_measured(a, row)) {
        CLX_TRY(clx_envelope_tracker_now(a->tracker, &a->assembly, envelope));
        fill_row(a, a->mass, a->volume, envelope, row);
        CLX_TRY(fill_speed(a, &a->assembly, row));
    }
done:
    a->envelope_s += clx_clock() - begun;
    return status;
}

clast_status clx_aggregate_add_row(clast_aggregate *a, double **row)
{
    clast_status status = CLAST_OK;
    double *made = NULL;
    CLX_TRY(clx_aggregate_open_row(a, &made));
    CLX_TRY(clx_aggregate_measure_row(a, made));
    *row = made;
done:
    return status;
}

/// The grains of a cluster, as an assembly that borrows the shapes: free it with free_view.
static clast_status view(const clast_aggregate *a, const clx_cluster *cluster,
                         clast_assembly *grains)
{
    clast_status status = CLAST_OK;
    const clast_assembly *all = &a->assembly;
    clast_assembly made = {.n_shape = all->n_shape, .shape = all->shape};
    for (int32_t i = 0; i < cluster->n; ++i) {
        const int32_t g = cluster->grain[i];
        CLX_TRY(clast_assembly_add_grain(&made, all->shape_id[g], all->position[g],
                                         all->orientation[g], all->scale[g], all->density[g]));
    }
    *grains = made;
    made = (clast_assembly){0};
done:
    made.n_shape = 0;
    made.shape = NULL;
    clast_assembly_free(&made);
    return status;
}

static void free_view(clast_assembly *grains)
{
    grains->n_shape = 0;
    grains->shape = NULL;
    clast_assembly_free(grains);
}

static clast_status measure_envelope(const clast_aggregate *a, const clast_assembly *grains,
                                     double tolerance, clast_envelope *envelope)
{
    clast_status status = CLAST_OK;
    const clast_envelope_options options = options_of(a, tolerance);
    for (int32_t k = 0; k < a->n_kind; ++k) {
        CLX_TRY(clast_assembly_envelope(grains, a->kind[k], &options, &envelope[k]));
    }
done:
    return status;
}

clast_status clx_aggregate_measure_cluster(clast_aggregate *a, const clx_cluster *cluster,
                                           double *row)
{
    clast_status status = CLAST_OK;
    clast_envelope envelope[CLAST_N_ENVELOPE];
    clast_assembly grains = {0};
    const double begun = clx_clock();
    if (is_measured(a, row)) {
        CLX_TRY(view(a, cluster, &grains));
        CLX_TRY(measure_envelope(a, &grains, ROW_TOLERANCE, envelope));
        fill_row(a, cluster->mass, cluster->volume, envelope, row);
        CLX_TRY(fill_speed(a, &grains, row));
    }
done:
    free_view(&grains);
    a->envelope_s += clx_clock() - begun;
    return status;
}

static clast_status measure_solid(const clast_aggregate *a, const clast_assembly *grains,
                                  clast_aggregate_result *result)
{
    clast_status status = CLAST_OK;
    clast_union_options options = clast_union_options_default();
    clast_union solid;
    result->solid_union = (double)NAN;
    if (!a->params->solid_union) {
        return CLAST_OK;
    }
    options.seed = a->seed;
    options.tolerance = SOLID_TOLERANCE;
    options.n_sample = SOLID_SAMPLES;
    options.find_depth = false; // the rows know how far each particle must step back
    if (a->params->contact == CLAST_CONTACT_EXACT && a->mode->is_one_body) {
        CLX_TRY(clx_union_of_scene(grains, a->scene, &options, &solid));
    } else {
        CLX_TRY(clast_assembly_union(grains, &options, &solid));
    }
    result->solid_union = solid.volume;
    result->solid_union_error = solid.error;
done:
    return status;
}

enum { AT_END = 2 };

/// The measures at the end that run on one thread each and do not need each other.
typedef struct {
    const clast_aggregate *a;
    const clast_assembly *grains;
    clast_aggregate_result *result;
    clast_extent extent;
} end_measures;

static clast_status measure_one(end_measures *m, int64_t which)
{
    return which == 0 ? clast_assembly_extent(m->grains, &m->extent)
                      : measure_envelope(m->a, m->grains, END_TOLERANCE, m->result->envelope);
}

static clast_status measure_some(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_status status = CLAST_OK;
    end_measures *m = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        CLX_TRY(measure_one(m, i));
    }
done:
    return status;
}

/// The union shares its pairs among all threads; hulls run side by side, each on one; other
/// envelopes use all threads in their turn.
static clast_status measure_all(end_measures *m)
{
    clast_status status = CLAST_OK;
    bool all_hulls = true;
    for (int32_t k = 0; k < m->a->n_kind; ++k) {
        all_hulls = all_hulls && (m->a->kind[k] == CLAST_ENVELOPE_SURFACE_HULL ||
                                  m->a->kind[k] == CLAST_ENVELOPE_SPHERE_HULL);
    }
    CLX_TRY(measure_solid(m->a, m->grains, m->result));
    CLX_TRY(clx_parallel_try(AT_END, all_hulls ? 1 : AT_END, measure_some, m));
done:
    return status;
}

clast_status clx_aggregate_measure_end(const clast_aggregate *a, clast_aggregate_result *result)
{
    clast_status status = CLAST_OK;
    clast_assembly part = {0};
    const clast_assembly *grains = &a->assembly;
    end_measures m = {.a = a, .result = result};
    const clx_measured measured = a->mode->measured(a);
    if (measured.cluster != NULL) {
        CLX_TRY(view(a, measured.cluster, &part));
        grains = &part;
    }
    result->n_grain = measured.n_grain;
    result->n_contact = measured.n_contact;
    result->n_cluster = measured.n_cluster;
    result->n_grain_all = a->assembly.n_grain;
    result->contact = a->params->contact;
    result->mass = measured.mass;
    result->solid_sum = measured.volume;
    result->radius_of_gyration = measured.gyration;
    m.grains = grains;
    CLX_TRY(measure_all(&m));
    for (int32_t k = 0; k < a->n_kind; ++k) {
        result->porosity[k] = 1.0 - result->solid_sum / result->envelope[k].volume;
    }
    result->n_envelope = a->n_kind;
    result->d_agg = equivalent_diameter(result->envelope[0].volume);
    result->density = result->mass / result->envelope[0].volume;
    CLX_TRY(clx_aggregate_measure_settling(a, grains, m.extent.width, result));
done:
    free_view(&part);
    return status;
}
