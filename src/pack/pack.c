// The process: generate, shake, damp, done. Each phase asks after every few steps whether it is
// over.
#include "pack/pack.h"

#include "base/alloc.h"
#include "base/clock.h"
#include "dem/dem.h"
#include "dem/ranks.h"
#include "pack/load.h"
#include "pack/start.h"
#include "pack/walls.h"
#include <clast/machine.h>
#include <clast/settling.h>
#include <clast/status.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

static const char *const names[] = {"generate", "shake", "damp", "done", "load"};

const char *clast_pack_phase_name(clast_pack_phase phase)
{
    return (unsigned)phase < sizeof names / sizeof names[0] ? names[phase] : "unknown";
}

/// Moves the bed's bottom and the sides of a box to where their walls are now.
static void follow_walls(const clast_pack *pack, clast_bed *bed)
{
    static const char *const side[4] = {"left", "right", "front", "back"};
    double *const place[4] = {&bed->low[0], &bed->high[0], &bed->low[1], &bed->high[1]};
    const clast_dem_config *d = &pack->config.dem;
    double inward[3];
    clast_dem_wall floor = {.offset = {0.0, 0.0, bed->floor}};
    clast_dem_read_wall(pack->dem, clx_wall_of_domain(d, "floor", inward), &floor);
    bed->floor = bed->kind == CLAST_BED_MESH ? fmax(bed->floor, floor.offset[2]) : floor.offset[2];
    for (int k = 0; k < 4 && bed->kind == CLAST_BED_BOX; ++k) {
        clast_dem_wall wall = {0};
        clast_dem_read_wall(pack->dem, clx_wall_of_domain(d, side[k], inward), &wall);
        *place[k] += wall.offset[k / 2];
    }
}

clast_bed clast_pack_bed(const clast_pack *pack)
{
    if (pack == NULL) {
        return (clast_bed){0};
    }
    const clast_dem_config *d = &pack->config.dem;
    if (pack->input.container_closed != NULL) {
        clast_bed bed = clast_bed_of_surface(pack->input.container_closed);
        bed.floor = pack->base;
        follow_walls(pack, &bed);
        return bed;
    }
    const double depth = d->depth > 0.0 ? d->depth : d->width;
    if (d->domain == CLAST_DEM_CELL) {
        clast_dem_cell cell;
        clast_dem_read_cell(pack->dem, &cell);
        return (clast_bed){.kind = CLAST_BED_PERIODIC_3D,
                           .ceiling = cell.side[2],
                           .shift = cell.shift,
                           .low = {-0.5 * cell.side[0], -0.5 * cell.side[1]},
                           .high = {0.5 * cell.side[0], 0.5 * cell.side[1]}};
    }
    clast_bed bed = {.kind = d->domain == CLAST_DEM_CYLINDER   ? CLAST_BED_CYLINDER
                             : d->domain == CLAST_DEM_PERIODIC ? CLAST_BED_PERIODIC
                                                               : CLAST_BED_BOX,
                     .radius = 0.5 * d->width,
                     .low = {-0.5 * d->width, -0.5 * depth},
                     .high = {0.5 * d->width, 0.5 * depth}};
    follow_walls(pack, &bed);
    return bed;
}

clast_porosity_options clast_pack_porosity(const clast_pack_config *config)
{
    if (config == NULL) {
        return (clast_porosity_options){0};
    }
    clast_porosity_options o = clast_porosity_options_default();
    o.method = CLAST_POROSITY_SPHERES;
    o.layer = config->layer;
    o.cut = config->cut;
    o.trim = config->trim >= 0.0                        ? config->trim
             : config->dem.domain == CLAST_DEM_PERIODIC ? 31.5e-3
                                                        : 0.0;
    return o;
}

/// The bed at a porosity of 0.5 must stay below the place where grains are made.
/// Rows that a profile may have: 1 km in slices of 1 mm.
static const double MOST_SLICES = 1e6;

static clast_status check_mass_fits(const clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_pack_config *c = &p->config;
    const clast_bed bed = clast_pack_bed(p);
    const bool is_cell = c->dem.domain == CLAST_DEM_CELL;
    const double edge[2] = {p->base, p->base + (is_cell ? 1.0 : c->fill_low) * p->height};
    double volume = 0.0;
    double min_density = 0.0;
    double max_density = 0.0;
    CLX_CHECK(is_cell || p->height / c->layer <= MOST_SLICES, CLAST_E_CONFIG,
              "a height of %s is %g slices of %s (layer), a row of the profile each; at most %g: "
              "take a lower domain or a greater layer",
              clx_unit_text(p->height, "m"), p->height / c->layer, clx_unit_text(c->layer, "m"),
              MOST_SLICES);
    if (p->input.start == NULL) {
        CLX_TRY(clx_pack_check_densities(p));
    }
    clx_pack_densities(p, &min_density, &max_density);
    CLX_CHECK(c->dem.domain != CLAST_DEM_OPEN || p->inside != NULL, CLAST_E_CONFIG,
              "a packing needs sides: domain cylinder, periodic, box or cell, or a container");
    CLX_CHECK(c->dem.floor || p->inside != NULL || is_cell || p->input.n_wall > 0, CLAST_E_CONFIG,
              "a packing needs a floor, or a wall instead of it");
    clast_bed_volumes(&bed, 1, edge, &volume);
    CLX_CHECK(
        0.5 * max_density * volume >= c->mass || p->input.start != NULL, CLAST_E_CONFIG,
        "%s cannot fit: at a porosity of 0.5 the volume below z = %s, where grains are made "
        "(fill_low of height), takes %s; take a taller or wider domain, or a greater fill_low",
        clx_unit_text(c->mass, "kg"), clx_unit_text(edge[1], "m"),
        clx_unit_text(0.5 * max_density * volume, "kg"));
    CLX_CHECK(min_density > c->dem.fluid_density || c->dem.gravity <= 0.0, CLAST_E_CONFIG,
              "grains of %g kg/m^3 do not sink in a fluid of %g kg/m^3", min_density,
              c->dem.fluid_density);
done:
    return status;
}

clast_status clx_pack_create_again(const clast_pack_config *config, const clast_pack_input *input,
                                   clast_pack **pack)
{
    clast_status status = CLAST_OK;
    clast_pack *made = NULL;
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    CLX_TRY(clx_pack_check(config));
    made->config = *config;
    made->input = *input;
    clx_pack_set_density(&made->config);
    if (input->start != NULL) {
        CLX_TRY(clx_pack_start_check(made));
    }
    CLX_TRY(clx_pack_contain(made));
    made->dem->may_touch_old = true; // shelves begin where grains of the last fill may still reach
    CLX_TRY(check_mass_fits(made));
    CLX_TRY(clx_pack_prepare(made));
    if (input->start == NULL) {
        CLX_TRY(clx_pack_check_draws(made));
    }
    CLX_TRY(clx_pack_walls_begin(made));
    CLX_TRY(clx_pack_materials_begin(made));
    CLX_TRY(clx_pack_load_check(made));
    CLX_TRY(clx_pack_walls_check(made));
    CLX_TRY(clx_pack_series_begin(made));
    CLX_TRY(clx_pack_load_table(made));
    CLX_TRY(clx_pack_walls_table(made));
    if (config->energy) {
        CLX_TRY(clast_dem_begin_energy(made->dem));
    }
    *pack = made;
    made = NULL;
done:
    clast_pack_destroy(made);
    return status;
}

clast_status clast_pack_create(const clast_pack_config *config, const clast_pack_input *input,
                               clast_pack **pack)
{
    CLX_ARGUMENTS(config, input, pack);
    CLX_GUARD(clast_fields_check(clast_pack_fields, config));
    if (input->n_wall != config->wall.n) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: %d walls of the input, %d of option wall", __func__,
                        input->n_wall, config->wall.n);
    }
    CLX_GUARD(clx_pack_check_idle(config, input));
    return clx_pack_create_again(config, input, pack);
}

clast_status clx_pack_share(clast_pack *pack, const clast_comm *comm)
{
    return clx_dem_share(pack->dem, comm);
}

clast_status clx_pack_gather(clast_pack *pack)
{
    return clx_dem_gather_all(pack->dem);
}

void clx_pack_count_ranks(const clast_pack *pack, clast_pack_ranks *ranks)
{
    clx_rank_counts c = {0};
    *ranks = (clast_pack_ranks){.n = 1};
    if (!clx_dem_rank_counts(pack->dem, &c)) {
        return;
    }
    const double steps = c.n_step > 0 ? (double)c.n_step : 1.0;
    *ranks = (clast_pack_ranks){.n = pack->dem->ranks->comm->n_rank,
                                .n_idle = c.n_idle,
                                .n_balance = c.n_balance,
                                .n_migrated = c.n_migrated,
                                .ghosts = (double)c.n_ghost / steps,
                                .messages = (double)c.n_message / steps,
                                .step_bytes = (double)c.step_bytes / steps,
                                .list_bytes = (double)c.list_bytes / steps,
                                .imbalance = c.imbalance,
                                .is_zoltan = c.is_zoltan};
}

void clast_pack_destroy(clast_pack *pack)
{
    if (pack == NULL) {
        return;
    }
    clast_dem_destroy(pack->dem);
    clast_bvh_destroy(pack->inside);
    clast_table_free(&pack->series);
    clast_table_free(&pack->load.table);
    clast_table_free(&pack->walls);
    CLX_FREE(pack->wall, pack->outlet, pack->unit_size, pack->weight, pack->waiting, pack);
}

static int64_t steps_of(const clast_pack *p, double time)
{
    CLAST_ASSERT(p->config.dem.time_step > 0.0);
    const double n = floor(time / p->config.dem.time_step + 0.5);
    return n < 1.0 ? 1 : (int64_t)n;
}

/// Sets what acts in the phase.
void clx_pack_drive(clast_pack *p)
{
    const clast_pack_config *c = &p->config;
    const bool shakes =
        p->phase == CLAST_PACK_SHAKE || (p->phase == CLAST_PACK_GENERATE && c->shake_from_start);
    const clast_dem_drive d = {.shake_amplitude = shakes ? c->shake_amplitude : 0.0,
                               .shake_period = c->shake_period,
                               .damping = p->phase == CLAST_PACK_DAMP ? c->damping : 1.0};
    (void)clast_dem_set_drive(p->dem, &d); // the fields' ranges are narrower
}

static clast_status begin_phase(clast_pack *p, clast_pack_phase phase)
{
    CLAST_ASSERT(phase >= p->phase || p->phase == CLAST_PACK_LOAD);
    clast_status status = CLAST_OK;
    CLX_TRY(clx_dem_gather_grains(p->dem));
    p->phase = phase;
    p->phase_step = clast_dem_n_step(p->dem);
    p->last_height = clast_dem_mean_height(p->dem, NULL);
    clx_pack_drive(p);
done:
    return status;
}

/// Longest time in which a grain that reaches above `low` sinks through the whole height [s]: its
/// free fall from rest, less buoyancy, and in a viscous fluid the way at its terminal velocity,
/// too. INFINITY: nothing draws it down.
static double sinking_time(const clast_pack *p, double low)
{
    const clast_dem_config *d = &p->config.dem;
    double longest = 0.0;
    for (int32_t i = 0; i < clast_dem_n_grain(p->dem); ++i) {
        const clx_motion *m = &p->dem->motion[i];
        const clast_drag drag = {m->drag[0], m->drag[1]};
        const double size = 2.0 * p->dem->grain[i].round_radius;
        const clast_fluid fluid = {.density = fmax(d->fluid_density, 1e-12 * m->density), // Stokes
                                   .viscosity = d->fluid_viscosity,
                                   .gravity = d->gravity};
        const double g = d->gravity * (1.0 - d->fluid_density / m->density);
        clast_settling settling;
        double time = g > 0.0 ? sqrt(2.0 * p->height / g) : p->height / p->config.initial_speed;
        if (p->dem->grain[i].position[2] + p->dem->grain[i].radius < low) {
            continue;
        }
        if (g > 0.0 && d->fluid_viscosity > 0.0 &&
            clast_terminal_velocity(size, m->density, &drag, &fluid, &settling) == CLAST_OK) {
            time += p->height / settling.velocity;
        }
        longest = fmax(longest, time);
    }
    return longest;
}

/// Sinking times after which a fill that is still there waits for ever: the bed has grown into it.
static const double PATIENCE = 50.0;

/// A bed that grew into the place of generation would wait for ever.
static clast_status check_waiting(clast_pack *p, double low)
{
    clast_status status = CLAST_OK;
    const double waited =
        (double)(clast_dem_n_step(p->dem) - p->fill_step) * p->config.dem.time_step;
    const double gravity = p->config.dem.gravity;
    if (waited == 0.0 || (gravity > 0.0 && waited <= PATIENCE * sqrt(2.0 * p->height / gravity))) {
        return CLAST_OK;
    }
    CLX_TRY(clx_dem_gather_grains(p->dem));
    const double sinking = sinking_time(p, low);
    CLX_CHECK(isfinite(sinking), CLAST_E_CONFIG,
              "nothing draws the grains of fill %d down from above %s (gravity %g m/s^2, "
              "initial_speed %s): no free space appears for the others",
              p->n_fill, clx_unit_text(low, "m"), gravity,
              clx_unit_text(p->config.initial_speed, "m/s"));
    CLX_CHECK(
        waited <= PATIENCE * sinking, CLAST_E_CONVERGE,
        "grains of fill %d still lie above %s after %s, %g times what sinking through the "
        "height takes: the bed has grown into the region where grains are made; take a taller "
        "or wider domain",
        p->n_fill, clx_unit_text(low, "m"), clx_unit_text(waited, "s"), PATIENCE);
done:
    return status;
}

clast_status clx_pack_fill_cell(clast_pack *p)
{
    clast_status status = CLAST_OK;
    if (p->config.dem.domain != CLAST_DEM_CELL || p->phase != CLAST_PACK_GENERATE) {
        return CLAST_OK;
    }
    CLX_TRY(
        clx_dem_agree(p->dem, p->input.start != NULL ? clx_pack_start_place(p) : clx_pack_fill(p)));
    CLX_CHECK(
        p->drawn_mass >= p->config.mass && p->n_waiting == 0, CLAST_E_CONFIG,
        "the cell holds %s of %s on this lattice without overlaps; take a larger cell (width, "
        "depth, height), or another generator or spacing: its stages press it together",
        clx_unit_text(p->mass, "kg"), clx_unit_text(p->config.mass, "kg"));
    CLX_TRY(begin_phase(p, CLAST_PACK_LOAD));
    CLX_TRY(clx_pack_load_begin(p));
done:
    return status;
}

/// A new fill once the last one has left the place where grains are made.
static clast_status generate(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const double top = p->n_fill > 0 ? clx_dem_highest(p->dem) : -(double)INFINITY;
    if (p->input.start != NULL) {
        CLX_TRY(clx_pack_start_place(p));
        return begin_phase(p, CLAST_PACK_SHAKE);
    }
    if (p->drawn_mass >= p->config.mass && p->n_waiting == 0) {
        return begin_phase(p, CLAST_PACK_SHAKE);
    }
    const double low = clx_pack_fill_low(p);
    if (p->n_fill == 0 || top < low) {
        CLX_TRY(clx_dem_gather_grains(p->dem));
        CLX_TRY(clx_dem_agree(p->dem, clx_pack_fill(p)));
        clx_pack_drive(p);
    }
    CLX_TRY(check_waiting(p, low));
done:
    return status;
}

/// One look at the bed while it calms down.
static clast_status look(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_pack_config *c = &p->config;
    const int64_t since = clast_dem_n_step(p->dem) - p->phase_step;
    if (since == 0 || since % steps_of(p, c->check_time) != 0) {
        return CLAST_OK;
    }
    CLX_TRY(clx_dem_gather_grains(p->dem));
    const double height = clast_dem_mean_height(p->dem, NULL);
    const double moved = fabs(height - p->last_height);
    const double speed = clast_dem_max_speed(p->dem);
    const bool is_level = moved < c->height_change;
    const bool is_slow = speed < c->still_speed;
    p->last_height = height;
    p->converged = c->rule == CLAST_PACK_BY_HEIGHT  ? is_level
                   : c->rule == CLAST_PACK_BY_SPEED ? is_slow
                                                    : is_level || is_slow;
    if (p->converged && c->stages.n > 0) { // at rest: now its walls load it
        p->converged = false;
        CLX_TRY(begin_phase(p, CLAST_PACK_LOAD));
        return clx_pack_walls_stage(p, 0);
    }
    if (p->converged) {
        return begin_phase(p, CLAST_PACK_DONE);
    }
    CLX_CHECK((double)since * c->dem.time_step < c->max_damping_time, CLAST_E_CONVERGE,
              "the bed is not at rest after %s of damping: its mean height has moved by %s in %s "
              "(height_change %s), its fastest grain moves at %s (still_speed %s)",
              clx_unit_text(c->max_damping_time, "s"), clx_unit_text(moved, "m"),
              clx_unit_text(c->check_time, "s"), clx_unit_text(c->height_change, "m"),
              clx_unit_text(speed, "m/s"), clx_unit_text(c->still_speed, "m/s"));
done:
    return status;
}

clast_status clx_pack_rows(clast_pack *p)
{
    const int64_t n = p->series.n_row;
    if (n > 0 &&
        clast_table_numbers(&p->series, "step")[n - 1] >= (double)clast_dem_n_step(p->dem)) {
        return CLAST_OK;
    }
    clx_inner_unpack(p->dem);
    clast_status status = clx_pack_series_row(p);
    if (status == CLAST_OK) {
        status = clx_pack_load_row(p);
    }
    if (status == CLAST_OK) {
        status = clx_pack_walls_row(p);
    }
    return clx_dem_agree(p->dem, status);
}

/// Drops the rows of this step, which only an early end (max_steps) leaves: what is decided at the
/// step comes before them. That of walls stays in states from before, whose means begin with it.
static clast_status drop_early_rows(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const int64_t step = clast_dem_n_step(p->dem);
    clast_table *const table[] = {&p->series, &p->load.table,
                                  p->walls_row < step ? &p->walls : NULL};
    for (size_t k = 0; k < sizeof table / sizeof table[0]; ++k) {
        const int64_t n = table[k] != NULL ? table[k]->n_row : 0;
        if (n > 0 && clast_table_numbers(table[k], "step")[n - 1] >= (double)step) {
            CLX_TRY(clast_table_resize(table[k], n - 1));
        }
    }
done:
    return status;
}

static clast_status series_row_due(clast_pack *p)
{
    const bool is_due = clast_dem_n_step(p->dem) % steps_of(p, p->config.series_time) == 0;
    return is_due ? clx_pack_rows(p) : CLAST_OK;
}

/// What is due at this step, before it is taken.
static clast_status decide(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const int64_t step = clast_dem_n_step(p->dem);
    CLX_TRY(drop_early_rows(p));
    CLX_TRY(clx_pack_fill_cell(p));
    CLX_TRY(clx_pack_outlets(p));
    if (p->phase == CLAST_PACK_LOAD) {
        CLX_TRY(p->config.dem.domain == CLAST_DEM_CELL ? clx_pack_load_look(p)
                                                       : clx_pack_walls_look(p));
        if (p->load.is_over) {
            CLX_TRY(begin_phase(p, CLAST_PACK_DONE));
        }
    }
    if (p->phase == CLAST_PACK_GENERATE && step % steps_of(p, 1e-3) == 0) {
        CLX_TRY(generate(p));
    }
    if (p->phase == CLAST_PACK_SHAKE &&
        (p->config.shaking_time == 0.0 ||
         step - p->phase_step >= steps_of(p, p->config.shaking_time))) {
        CLX_TRY(begin_phase(p, CLAST_PACK_DAMP));
    }
    if (p->phase == CLAST_PACK_DAMP) {
        CLX_TRY(look(p));
        if (p->phase == CLAST_PACK_LOAD) {
            CLX_TRY(clx_pack_walls_look(p));
        }
    }
    CLX_TRY(series_row_due(p));
done:
    return status;
}

/// Steps until something may have to be decided.
static int64_t quiet_steps(const clast_pack *p)
{
    const int64_t step = clast_dem_n_step(p->dem);
    const int64_t series = steps_of(p, p->config.series_time);
    const int64_t generation = steps_of(p, 1e-3);
    const int64_t check = steps_of(p, p->config.check_time);
    int64_t n = series - step % series;
    if (p->phase == CLAST_PACK_GENERATE) {
        const int64_t k = generation - step % generation;
        n = k < n ? k : n;
    } else if (p->phase == CLAST_PACK_SHAKE) {
        const int64_t k = p->phase_step + steps_of(p, p->config.shaking_time) - step;
        n = k < n ? k : n;
    } else if (p->phase == CLAST_PACK_LOAD) {
        const int64_t k = CLX_SERVO_STEPS - (step - p->phase_step) % CLX_SERVO_STEPS;
        n = k < n ? k : n;
    } else {
        const int64_t k = check - (step - p->phase_step) % check;
        n = k < n ? k : n;
    }
    if (p->n_outlet > 0) {
        const int64_t k = CLX_SERVO_STEPS - step % CLX_SERVO_STEPS;
        n = k < n ? k : n;
    }
    return n > 0 ? n : 1;
}

clast_status clast_pack_advance(clast_pack *pack, int64_t n_step)
{
    CLX_ARGUMENTS(pack);
    if (n_step < 0) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: %lld steps", __func__, (long long)n_step);
    }
    clast_status status = CLAST_OK;
    const double begun = clx_clock();
    const int64_t most = pack->config.max_steps;
    while (n_step > 0 && !clast_pack_is_over(pack)) {
        CLX_TRY(decide(pack));
        if (pack->phase == CLAST_PACK_DONE) {
            break;
        }
        const int64_t left = most > 0 ? most - clast_dem_n_step(pack->dem) : INT64_MAX;
        int64_t n = quiet_steps(pack);
        n = n < n_step ? n : n_step;
        n = n < left ? n : left;
        const double before = clx_clock();
        CLX_TRY(clx_dem_step_packed(pack->dem, n));
        pack->step_s += clx_clock() - before;
        pack->grain_steps += (double)n * clast_dem_n_grain(pack->dem);
        pack->clocked_steps += (double)n * clast_dem_n_grain(pack->dem);
        n_step -= n;
    }
    /* nothing is decided at the last step, however it was reached: only its row is written, which
     * a run that goes on writes anew */
    if (clast_pack_is_over(pack)) {
        CLX_TRY(series_row_due(pack));
    }
done:
    clx_inner_unpack(pack->dem);
    pack->wall_s += clx_clock() - begun;
    return status;
}

bool clast_pack_is_over(const clast_pack *pack)
{
    if (pack == NULL) {
        return true;
    }
    return pack->phase == CLAST_PACK_DONE ||
           (pack->config.max_steps > 0 && clast_dem_n_step(pack->dem) >= pack->config.max_steps);
}

clast_pack_phase clast_pack_phase_of(const clast_pack *pack)
{
    if (pack == NULL) {
        return (clast_pack_phase){0};
    }
    return pack->phase;
}

const clast_dem *clast_pack_dem(const clast_pack *pack)
{
    if (pack == NULL) {
        return NULL;
    }
    return pack->dem;
}

double clast_pack_mass(const clast_pack *pack)
{
    if (pack == NULL) {
        return (double)NAN;
    }
    return pack->mass;
}

int64_t clast_pack_expected_steps(const clast_pack *pack)
{
    if (pack == NULL) {
        return 0;
    }
    const clast_pack_config *c = &pack->config;
    const double dt = c->dem.time_step;
    double time = (double)clast_dem_n_step(pack->dem) * dt;
    if (c->dem.domain == CLAST_DEM_CELL ||
        pack->phase == CLAST_PACK_LOAD) { // stages tell no time: a fair guess of each
        const double left = (double)(c->stages.n - pack->load.stage) * 0.2;
        return c->max_steps > 0 ? c->max_steps : (int64_t)((time + left) / dt);
    }
    if (pack->n_fill == 0 || pack->mass <= 0.0) {
        return c->max_steps;
    }
    double min_density = 0.0;
    double max_density = 0.0;
    clx_pack_densities(pack, &min_density, &max_density);
    const double g = fmax(1e-9, c->dem.gravity * (1.0 - c->dem.fluid_density / min_density));
    const double drop = (c->fill_high - c->fill_low) * c->dem.height;
    const double u = c->initial_speed;
    const double fall = (sqrt(u * u + 2.0 * g * drop) - u) / g;
    if (pack->phase == CLAST_PACK_GENERATE) {
        time += fmax(0.0, c->mass / (pack->mass / pack->n_fill) - pack->n_fill) * fall;
    }
    const double shaken = pack->phase == CLAST_PACK_SHAKE
                              ? (double)(clast_dem_n_step(pack->dem) - pack->phase_step) * dt
                              : 0.0;
    time += pack->phase <= CLAST_PACK_SHAKE ? c->shaking_time - shaken : 0.0;
    time += pack->phase <= CLAST_PACK_DAMP ? 0.2 : 0.0; // a fair guess of damping
    const int64_t n = (int64_t)(time / dt);
    return c->max_steps > 0 && c->max_steps < n ? c->max_steps : n;
}
