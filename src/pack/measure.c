// What a packing ends as: porosity, time series, sizes achieved.
#include "base/alloc.h"
#include "dem/body.h"
#include "dem/dem.h"
#include "dem/ranks.h"
#include "pack/pack.h"
#include <clast/assembly.h>
#include <math.h>
#include <string.h>

static const struct {
    const char *name, *unit;
} columns[] = {{"step", "-"},
               {"time_s", "s"},
               {"phase", "-"},
               {"n_grain", "-"},
               {"mass_kg", "kg"},
               {"mean_height_m", "m"},
               {"top_m", "m"},
               {"kinetic_energy_J", "J"},
               {"elastic_energy_J", "J"},
               {"potential_energy_J", "J"},
               {"max_speed_m/s", "m/s"},
               {"n_contact", "-"},
               {"n_wall_contact", "-"},
               {"max_overlap_m", "m"}};
enum { N_COLUMN = sizeof columns / sizeof columns[0] };

clast_status clx_pack_series_begin(clast_pack *p)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_table_init(&p->series, "series", 0));
    for (int c = 0; c < N_COLUMN; ++c) {
        double *number = NULL;
        CLX_TRY(clast_table_add_number(&p->series, columns[c].name, columns[c].unit, &number));
    }
done:
    return status;
}

clast_status clx_pack_series_row(clast_pack *p)
{
    clast_status status = CLAST_OK;
    clast_dem_measures m;
    int32_t lost = -1;
    const int64_t row = p->series.n_row;
    CLX_TRY(clx_dem_gather_grains(p->dem));
    if (p->is_held && clx_pack_n_outside(p, &lost) > 0) {
        return clx_fail(CLAST_E_CONVERGE,
                        "grain %d has passed the walls of the closed container by step %lld: it "
                        "was too fast, or pressed too hard, for walls without thickness; take a "
                        "shorter collision_time and time_step",
                        lost, (long long)clast_dem_n_step(p->dem));
    }
    CLX_TRY(clx_dem_gather_measures(p->dem, &m));
    const bool is_empty = m.n_grain == 0;
    const double value[N_COLUMN] = {(double)m.step,
                                    m.time,
                                    (double)p->phase,
                                    m.n_grain,
                                    m.mass,
                                    m.mean_height,
                                    is_empty ? 0.0 : m.top,
                                    m.kinetic_energy,
                                    m.elastic_energy,
                                    m.potential_energy,
                                    m.max_speed,
                                    (double)m.n_contact,
                                    (double)m.n_wall_contact,
                                    m.max_overlap};
    CLX_TRY(clast_table_resize(&p->series, row + 1));
    for (int c = 0; c < N_COLUMN; ++c) {
        p->series.column[c].number[row] = value[c];
    }
done:
    return status;
}

const clast_table *clast_pack_series(const clast_pack *pack)
{
    if (pack == NULL) {
        return NULL;
    }
    return &pack->series;
}

/// Ratio of neighbouring semi-axes k + 1 and k of grain i.
static double ratio_of(const clast_assembly *a, int32_t i, int k)
{
    CLAST_ASSERT(k >= 0 && k < 2 && i >= 0 && i < a->n_grain);
    const double *s = a->shape[a->shape_id[i]].semi_axes;
    return s[k + 1] / s[k];
}

/// Mean and standard deviation of a ratio over the grains.
static void measure_ratio(const clast_assembly *a, int k, double mean_deviation[2])
{
    double mean = 0.0;
    double square = 0.0;
    for (int32_t i = 0; i < a->n_grain; ++i) { // running mean: equal grains deviate by 0
        const double off = ratio_of(a, i, k) - mean;
        mean += off / (i + 1);
        square += off * (ratio_of(a, i, k) - mean);
    }
    mean_deviation[0] = mean;
    mean_deviation[1] = a->n_grain > 1 ? sqrt(square / (a->n_grain - 1)) : 0.0;
}

/// What the side walls make of the bulk porosity, where the bed is wide enough to have a core.
static clast_status measure_walls(const clast_assembly *a, const clast_bed *bed,
                                  const clast_porosity_options *options,
                                  const clast_porosity_bulk *bulk, clast_pack_result *r)
{
    clast_porosity_core core = {0};
    if (!(r->walls.ratio > CLAST_PACK_CORE + 0.5) || isinf(r->walls.ratio)) {
        return CLAST_OK;
    }
    const clast_status status =
        clast_porosity_core_measure(a, bed, bulk, CLAST_PACK_CORE, options, &core);
    r->wall_share = status == CLAST_OK ? core.share : r->wall_share;
    return status == CLAST_E_GEOMETRY ? CLAST_OK : status; // a long, narrow box
}

/// Least porosity of the profile's slices.
static double least_porosity(const clast_table *profile)
{
    const double *n = clast_table_numbers(profile, "porosity");
    double least = INFINITY;
    for (int64_t i = 0; n != NULL && i < profile->n_row; ++i) {
        least = fmin(least, n[i]);
    }
    return isinf(least) ? (double)NAN : least;
}

/// Whether the grains still fall, however dense a layer they fall in: most of them touch nothing. A
/// bed that its rule has ended is one all the same, and so is one that stages throw up.
static bool is_falling(const clast_pack *p, int32_t n_free)
{
    return p->phase < CLAST_PACK_DONE && p->config.stages.n == 0 &&
           2 * (int64_t)n_free > clast_dem_n_grain(p->dem);
}

/// Bulk porosity as published, and the forms; NAN while there is no bed.
static clast_status measure_bed(const clast_pack *p, int32_t n_free, clast_pack_result *r)
{
    clast_status status = CLAST_OK;
    clast_assembly a = {0};
    clast_table profile = {0};
    clast_porosity_bulk bulk = {0};
    const clast_bed bed = clast_pack_bed(p);
    const clast_porosity_options o = clast_pack_porosity(&p->config);
    clast_porosity_options whole = o;
    r->porosity = r->z_low = r->z_high = r->top = r->untrimmed = (double)NAN;
    r->porosity_least = (double)NAN;
    r->porosity_state = CLAST_PACK_NO_BED;
    r->trim = o.trim;
    r->cut = o.cut;
    r->walls = (clast_bed_walls){(double)NAN, (double)NAN, (double)NAN};
    r->wall_share = (double)NAN;
    r->mass_wanted = p->config.mass;
    for (int k = 0; k < 2; ++k) {
        r->flatness[k] = r->elongation[k] = (double)NAN;
    }
    if (clast_dem_n_grain(p->dem) == 0) {
        return CLAST_OK;
    }
    CLX_TRY(clast_dem_assembly(p->dem, &a));
    r->walls = clast_bed_side_walls(&bed, &a);
    measure_ratio(&a, 1, r->flatness);
    measure_ratio(&a, 0, r->elongation);
    if (p->dem->cell != NULL) { // all of it, without a floor or a top
        const double *side = p->dem->cell->side;
        r->porosity = 1.0 - r->load.solid / r->load.volume;
        r->z_low = 0.0;
        r->z_high = r->top = side[2];
        r->untrimmed = r->porosity;
        r->porosity_state = CLAST_PACK_POROUS;
        goto done;
    }
    if (p->phase == CLAST_PACK_GENERATE) { // a layer of the lattice may be as dense as a bed
        goto done;
    }
    if (is_falling(p, n_free)) {
        r->porosity_state = CLAST_PACK_FALLING;
        goto done;
    }
    CLX_TRY(clast_porosity_profile(&a, &bed, &o, &profile));
    r->porosity_least = least_porosity(&profile);
    r->porosity_state = p->phase >= CLAST_PACK_DAMP ? CLAST_PACK_ABOVE_CUT : CLAST_PACK_NO_BED;
    whole.trim = 0.0;
    if (clast_porosity_measure(&a, &bed, &profile, &whole, &bulk) == CLAST_OK) {
        r->top = bulk.top;
        r->untrimmed = bulk.porosity;
        r->porosity_state = CLAST_PACK_TRIMMED;
    }
    status = clast_porosity_measure(&a, &bed, &profile, &o, &bulk);
    if (status == CLAST_OK) {
        r->porosity = bulk.porosity;
        r->porosity_state = CLAST_PACK_POROUS;
        r->z_low = bulk.z_low;
        r->z_high = bulk.z_high;
        CLX_TRY(measure_walls(&a, &bed, &o, &bulk, r));
    }
    status = status == CLAST_E_GEOMETRY ? CLAST_OK : status; // no bed yet, or trimmed away
done:
    clast_table_free(&profile);
    clast_assembly_free(&a);
    return status;
}

/// Grains that four contacts do not hold, and those of them that touch nothing.
static clast_status count_loose(const clast_pack *p, int32_t *n_free, clast_pack_result *r)
{
    clast_status status = CLAST_OK;
    int32_t *count = NULL;
    CLX_TRY(clx_alloc(&count, r->dem.n_grain, sizeof *count));
    clx_count_contacts(p->dem, count);
    for (int32_t i = 0; i < r->dem.n_grain; ++i) {
        r->n_loose += count[i] < 4 ? 1 : 0;
        *n_free += count[i] == 0 ? 1 : 0;
    }
done:
    clx_free(count);
    return status;
}

/// What still moves at the end, and what still fell at the end of shaking.
static void measure_motion(const clast_pack *p, clast_pack_result *r)
{
    const double *phase = clast_table_numbers(&p->series, "phase");
    const double *top = clast_table_numbers(&p->series, "top_m");
    double volume = 0.0;
    double least = INFINITY;
    int64_t row = 0;
    for (int32_t i = 0; i < r->dem.n_grain; ++i) {
        volume += p->dem->motion[i].volume;
        least = fmin(least, p->dem->motion[i].volume);
    }
    r->still_diameters =
        r->dem.n_grain > 0 ? p->config.still_speed / cbrt(6.0 / CLAST_PI * least) : (double)NAN;
    r->is_moving = !p->load.has_rested && r->dem.max_speed >= p->config.still_speed;
    r->sank = (double)NAN;
    while (row < p->series.n_row && phase[row] < CLAST_PACK_DAMP) {
        ++row;
    }
    if (row == p->series.n_row || r->dem.n_grain == 0 || p->config.shaking_time == 0.0 ||
        p->config.stages.n > 0 || p->config.dem.domain == CLAST_DEM_CELL) {
        return;
    }
    r->sank = top[row] - r->dem.top;
    r->fell = r->sank > 2.0 * cbrt(6.0 / CLAST_PI * volume / r->dem.n_grain);
}

void clast_pack_result_free(clast_pack_result *result)
{
    if (result == NULL) {
        return;
    }
    clx_free(result->hull);
    *result = (clast_pack_result){0};
}

clast_status clast_pack_measure(const clast_pack *pack, clast_pack_result *result)
{
    CLX_ARGUMENTS(pack, result);
    clast_status status = CLAST_OK;
    clast_pack_result r = {.phase = pack->phase,
                           .converged = pack->converged,
                           .hash = clast_dem_hash(pack->dem),
                           .n_fill = pack->n_fill,
                           .n_waited = pack->n_waited,
                           .n_overlap = pack->n_overlap,
                           .deepest_start = pack->deepest,
                           .start_snapshot = pack->input.start_snapshot,
                           .n_start_snapshot = pack->input.n_start_snapshot,
                           .start_step = pack->input.start_step,
                           .n_stage = pack->phase == CLAST_PACK_DONE   ? pack->config.stages.n
                                      : pack->phase == CLAST_PACK_LOAD ? pack->load.stage
                                                                       : 0,
                           .n_left = pack->n_left,
                           .mass_left = pack->mass_left,
                           .wall_s = pack->wall_s,
                           .step_s = pack->step_s,
                           .clocked_steps = pack->clocked_steps,
                           .grain_steps = pack->grain_steps};
    int32_t first = -1;
    int32_t n_free = 0;
    clast_dem_measure(pack->dem, &r.dem);
    clast_dem_read_cell(pack->dem, &r.cell);
    CLX_TRY(clast_dem_load_measure(pack->dem, &r.load));
    clast_dem_energy_measure(pack->dem, &r.energy);
    r.n_outside = clx_pack_n_outside(pack, &first);
    measure_motion(pack, &r);
    clx_pack_own_density(pack, &r.own_density, &r.given_density);
    CLX_TRY(count_loose(pack, &n_free, &r));
    CLX_TRY(measure_bed(pack, n_free, &r));
    *result = r;
done:
    return status;
}

clast_status clast_pack_achieved(const clast_pack *p, clast_table *table)
{
    CLX_ARGUMENTS(p, table);
    clast_status status = CLAST_OK;
    const int32_t n = clast_dem_n_grain(p->dem);
    double *size = NULL;
    double *volume = NULL;
    double unit = 1.0;
    clast_grading_match match;
    CLX_CHECK(p->input.curve != NULL, CLAST_E_USAGE, "sizes follow no sieve curve");
    CLX_TRY(clx_alloc(&size, n, sizeof *size));
    CLX_TRY(clx_alloc(&volume, n, sizeof *volume));
    for (int32_t i = 0; i < n; ++i) {
        clast_dem_grain g;
        double measures[2];
        clast_dem_read_grain(p->dem, i, &g);
        clx_dem_shape_measures(p->dem, g.shape, measures);
        size[i] = g.scale * clx_pack_size_of(&p->dem->body[g.shape].shape, p->config.size_meaning);
        unit = i == 0 ? g.density : unit; // shares of mass: one density is none
        volume[i] = g.scale * g.scale * g.scale * measures[1] * (g.density / unit);
    }
    const clast_grading_sample sample = {.n = n, .size = size, .volume = volume};
    CLX_TRY(clast_grading_compare(p->input.grading, p->input.curve, &sample, table, &match));
done:
    CLX_FREE(size, volume);
    return status;
}
