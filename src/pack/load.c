// A bed under load: stages of a periodic cell whose sides follow a rate or a stress.
//
// The servo looks every 25 steps. A side's strain rate is
//
//     e' = e + integral of e / (20 tau),  e = (p - sigma) / (C tau),  |e|, |e'| <= load_rate
//
// with sigma its stress (contacts and motion), C the modulus of all normal springs at even strain,
// which no bed exceeds, and tau = 250 steps: the stress comes near its aim p by 1/e in tau, or
// later. [docs/theory/load.md "Servo"]
#include "pack/load.h"

#include "base/alloc.h"
#include "dem/cell.h"
#include "dem/dem.h"
#include "dem/load.h"
#include "dem/ranks.h"
#include <math.h>
#include <string.h>

/// Share of a look's rate that the servo keeps: Delta / (20 tau).
static const double SLOWLY = (double)CLX_SERVO_STEPS / (20.0 * CLX_SERVO_TIME);

/// Share of the speed at which a run explodes that the cell's motion may have.
static const double FASTEST = 0.5;

/// Speed that the stage gives grains at the cell's sides, at most.
static double fastest_of(const clast_pack_config *c, const clx_stage *s)
{
    const clast_dem_config *d = &c->dem;
    const double side[3] = {d->width, d->depth > 0.0 ? d->depth : d->width, d->height};
    double square = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double rate = s->kind[k] == CLX_DRIVE_NONE   ? 0.0
                            : s->kind[k] == CLX_DRIVE_RATE ? s->aim[k]
                                                           : c->load_rate;
        square += rate * side[k] * rate * side[k];
    }
    const double shear = s->shear_kind == CLX_DRIVE_STRESS ? c->load_rate : fabs(s->shear);
    return sqrt(square) + shear * side[2];
}

double clx_pack_stopped_speed(const clast_pack *p, double radius, double mass)
{
    double least = INFINITY;
    for (int32_t i = 0; i < p->dem->n_body; ++i) {
        for (int32_t k = 0; k < clx_n_law(p->dem); ++k) {
            least = fmin(least, clx_law_speed(clx_law_at(p->dem, i, k), mass, radius, radius));
        }
    }
    return least;
}

double clx_pack_speed_limit(const clast_pack *p)
{
    double low = 0.0;
    double high = 0.0;
    double min_density = 0.0;
    double max_density = 0.0;
    clast_grading_range(p->input.grading, &low, &high);
    clx_pack_densities(p, &min_density, &max_density);
    const double r = 0.5 * low;
    const double mass = max_density * 4.0 / 3.0 * CLAST_PI * r * r * r;
    return FASTEST * clx_pack_stopped_speed(p, r, mass);
}

static bool moves_at_rate(const clx_stage *s, int k)
{
    return s->kind[k] == CLX_DRIVE_RATE && s->aim[k] != 0.0;
}

static bool has_rate(const clx_stage *s)
{
    return moves_at_rate(s, 0) || moves_at_rate(s, 1) || moves_at_rate(s, 2);
}

/// Whether a stress has come to `until`: the shear stress where it shears; else that of a side that
/// moves at a rate, or, where none does, is held at a pressure. From above where the side extends,
/// or its own pressure is lower.
static bool has_come(const clx_stage *s, const clast_dem_load *load)
{
    const double shear = fabs(load->stress[4] + load->kinetic_stress[4]);
    if (s->shear_kind != CLX_DRIVE_NONE && s->shear != 0.0) {
        return s->shear_kind == CLX_DRIVE_STRESS && fabs(s->shear) < s->until ? shear <= s->until
                                                                              : shear >= s->until;
    }
    const bool is_at_rate = has_rate(s);
    for (int k = 0; k < 3; ++k) {
        const double now = load->stress[k] + load->kinetic_stress[k];
        const bool is_held = !is_at_rate && s->kind[k] == CLX_DRIVE_STRESS;
        const bool falls = is_held ? s->aim[k] < s->until : s->aim[k] < 0.0;
        if ((is_held || moves_at_rate(s, k)) && (falls ? now <= s->until : now >= s->until)) {
            return true;
        }
    }
    return false;
}

clast_status clx_pack_load_check(const clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_pack_config *c = &p->config;
    const bool is_cell = c->dem.domain == CLAST_DEM_CELL;
    CLX_CHECK(!is_cell || c->stages.n > 0, CLAST_E_CONFIG,
              "domain cell without stages: its grains would float for ever; give one "
              "(isotropic 10kPa)");
    const double limit = clx_pack_speed_limit(p);
    for (int32_t i = 0; is_cell && i < c->stages.n; ++i) {
        clx_stage s;
        CLX_TRY(clx_stage_read(c, i, &s));
        const double speed = fastest_of(c, &s);
        CLX_CHECK(speed <= limit, CLAST_E_CONFIG,
                  "stage %d, '%s': the cell's sides would move at %s, faster than half of what "
                  "contacts of the smallest grains stop (%s); take lower rates (load_rate), a "
                  "smaller cell, or stiffer contacts",
                  i + 1, c->stages.item[i], clx_unit_text(speed, "m/s"),
                  clx_unit_text(limit, "m/s"));
        const bool is_loose = i == 0 && p->input.start == NULL;
        CLX_CHECK(!is_loose || s.end != CLX_END_STRESS || s.until == 0.0 ||
                      !has_come(&s, &(clast_dem_load){0}),
                  CLAST_E_CONFIG,
                  "stage 1, '%s': it comes to %s from above, and grains on a lattice carry nothing",
                  c->stages.item[i], clx_unit_text(s.until, "Pa"));
    }
done:
    return status;
}

static clast_status begin_stage(clast_pack *p, int32_t stage)
{
    clast_dem_cell cell;
    clast_dem_read_cell(p->dem, &cell);
    p->load.stage = stage;
    p->load.begun = clast_dem_n_step(p->dem);
    v3_copy(p->load.strain, cell.strain);
    p->load.sheared = cell.shear_strain;
    memset(p->load.steady, 0, sizeof p->load.steady);
    return CLAST_OK;
}

clast_status clx_pack_load_begin(clast_pack *p)
{
    return begin_stage(p, 0);
}

static bool shears_at_rate(const clx_stage *s)
{
    return s->shear_kind == CLX_DRIVE_RATE && s->shear != 0.0;
}

/// Strain since the stage began: the greatest of the sides that move at a rate, or of all.
static double strain_of(const clast_pack *p, const clx_stage *s, const clast_dem_cell *cell)
{
    double most = fabs(cell->shear_strain - p->load.sheared);
    const bool is_at_rate = shears_at_rate(s) || has_rate(s);
    for (int k = 0; k < 3; ++k) {
        if (!is_at_rate || moves_at_rate(s, k)) {
            most = fmax(most, fabs(cell->strain[k] - p->load.strain[k]));
        }
    }
    return most;
}

/// Whether every side that has a stress to reach is within the tolerance of it.
static bool is_reached(const clast_pack *p, const clx_stage *s, const clast_dem_load *load)
{
    const double shear = -(load->stress[4] + load->kinetic_stress[4]);
    if (s->shear_kind == CLX_DRIVE_STRESS &&
        !(fabs(shear - s->shear) <= p->config.load_tolerance * fabs(s->shear))) {
        return false;
    }
    for (int k = 0; k < 3; ++k) {
        const double now = load->stress[k] + load->kinetic_stress[k];
        if (s->kind[k] == CLX_DRIVE_STRESS &&
            !(fabs(now - s->aim[k]) <= p->config.load_tolerance * fabs(s->aim[k]))) {
            return false;
        }
    }
    return true;
}

/// Since the stage began [s].
static double stage_time(const clast_pack *p)
{
    return (double)(clast_dem_n_step(p->dem) - p->load.begun) * p->config.dem.time_step;
}

static bool is_over(const clast_pack *p, const clx_stage *s, const clast_dem_load *load,
                    const clast_dem_cell *cell)
{
    const double time = stage_time(p);
    switch (s->end) {
    case CLX_END_TIME:
        return time >= s->until * (1.0 - 1e-12);
    case CLX_END_STRAIN:
        return strain_of(p, s, cell) >= s->until;
    case CLX_END_STRESS:
        return s->until > 0.0 ? has_come(s, load) : is_reached(p, s, load);
    default:
        return is_reached(p, s, load) && load->n_contact > 0 &&
               load->unbalanced < p->config.load_rest;
    }
}

static clast_status check_time(const clast_pack *p, const clx_stage *s, const clast_dem_load *load)
{
    clast_status status = CLAST_OK;
    const double time = stage_time(p);
    const double *c = load->stress;
    const double *k = load->kinetic_stress;
    CLX_CHECK(
        s->end == CLX_END_TIME || time < p->config.max_load_time, CLAST_E_CONVERGE,
        "stage %d, '%s', has not come to its end in %s (max_load_time): stresses of x, y, z and xz "
        "are %s, %s, %s and %s, force on a grain over that of a contact %.2g (load_rest %g)",
        p->load.stage + 1, p->config.stages.item[p->load.stage], clx_unit_text(time, "s"),
        clx_unit_text(c[0] + k[0], "Pa"), clx_unit_text(c[1] + k[1], "Pa"),
        clx_unit_text(c[2] + k[2], "Pa"), clx_unit_text(c[4] + k[4], "Pa"), load->unbalanced,
        p->config.load_rest);
done:
    return status;
}

/// Strain rate until the next look of what is `off` its aim; k counts x, y, z and shear.
static double servo(clast_pack *p, int k, double off, double modulus)
{
    const double most = p->config.load_rate;
    const double stiff = modulus * CLX_SERVO_TIME * p->config.dem.time_step;
    const bool is_near = fabs(off) < most * stiff;
    const double wanted = is_near ? off / stiff : copysign(most, off);
    const double steady = p->load.steady[k] + SLOWLY * wanted;
    p->load.steady[k] = is_near ? fmin(fmax(steady, -most), most) : 0.0;
    return fmin(fmax(wanted + p->load.steady[k], -most), most);
}

/// Rates of the sides until the next look.
static clast_status drive(clast_pack *p, const clx_stage *s, const clast_dem_load *load,
                          const clast_dem_cell *cell)
{
    double rate[3];
    for (int k = 0; k < 3; ++k) {
        const double now = load->stress[k] + load->kinetic_stress[k];
        const double strain = s->kind[k] == CLX_DRIVE_RATE ? s->aim[k]
                              : s->kind[k] == CLX_DRIVE_STRESS
                                  ? servo(p, k, s->aim[k] - now, load->modulus[k])
                                  : 0.0;
        rate[k] = -strain * cell->side[k];
    }
    const double now = -(load->stress[4] + load->kinetic_stress[4]);
    const double shear = s->shear_kind == CLX_DRIVE_RATE ? s->shear
                         : s->shear_kind == CLX_DRIVE_STRESS
                             ? servo(p, 3, s->shear - now, load->shear_modulus)
                             : 0.0;
    // the upper images go along with the strain of x, which is no shear
    const double along = rate[0] * (cell->shift / cell->side[0]);
    return clast_dem_set_cell_rate(p->dem, rate, shear * cell->side[2] + along);
}

clast_status clx_pack_load_look(clast_pack *p)
{
    clast_status status = CLAST_OK;
    clast_dem_load load;
    clast_dem_cell cell;
    clx_stage s;
    if ((clast_dem_n_step(p->dem) - p->phase_step) % CLX_SERVO_STEPS != 0) {
        return CLAST_OK;
    }
    if (!clx_dem_stress_is_fast(p->dem)) {
        clx_inner_unpack(p->dem);
    }
    CLX_TRY(clx_dem_gather_grains(p->dem));
    CLX_TRY(clx_stage_read(&p->config, p->load.stage, &s));
    const bool is_balanced = s.end == CLX_END_REST || stage_time(p) >= p->config.max_load_time;
    CLX_TRY(clx_dem_stress(p->dem, is_balanced, &load));
    clast_dem_read_cell(p->dem, &cell);
    if (is_over(p, &s, &load, &cell)) {
        clx_inner_unpack(p->dem);
        CLX_TRY(clx_pack_load_row(p));
        if (p->load.stage + 1 == p->config.stages.n) {
            p->converged = true;
            p->load.is_over = true;
            p->load.has_rested = s.end == CLX_END_REST;
            return CLAST_OK;
        }
        CLX_TRY(begin_stage(p, p->load.stage + 1));
        CLX_TRY(clx_stage_read(&p->config, p->load.stage, &s));
    }
    CLX_TRY(check_time(p, &s, &load));
    CLX_TRY(drive(p, &s, &load, &cell));
done:
    return status;
}
