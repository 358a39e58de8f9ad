// The periodic cell in motion. Grains keep their velocities in the lab; when the rate of the cell
// changes, each gets the change that belongs to its place, so that a bed is strained evenly and no
// wave runs from the sides:
//
//     x = h s,  dv = dh' s,  h = ((Lx, 0, s), (0, Ly, 0), (0, 0, Lz)). [docs/theory/load.md "Cell"]
#include "dem/cell.h"

#include "base/alloc.h"
#include "dem/energy.h"
#include "dem/pair_force.h"
#include "dem/ranks.h"
#include "math/lanes.h"
#include <assert.h>
#include <math.h>
#include <stddef.h>

enum { ALL_INSIDE = (1 << CLX_LANES) - 1 };

clast_status clx_cell_make(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    const clast_dem_config *c = &dem->config;
    clx_periodic_cell *cell = NULL;
    if (c->domain != CLAST_DEM_CELL) {
        return CLAST_OK;
    }
    CLX_CHECK(!c->floor && !c->lid, CLAST_E_CONFIG,
              "domain cell is periodic in z, too: it has no floor and no lid (floor: no, lid: no)");
    CLX_CHECK(c->gravity == 0.0, CLAST_E_CONFIG,
              "gravity %g m/s^2: in domain cell, which has no floor, grains would fall for ever; "
              "take gravity 0",
              c->gravity);
    CLX_CHECK(c->fluid_viscosity == 0.0, CLAST_E_CONFIG,
              "fluid_viscosity %s: in domain cell, where no fluid moves with the sides, drag would "
              "hold the grains back; take fluid_viscosity 0",
              clx_unit_text(c->fluid_viscosity, "Pa s"));
    CLX_CHECK(!c->hindrance, CLAST_E_CONFIG, "hindrance by height: domain cell has no height");
    CLX_TRY(clx_alloc(&cell, 1, sizeof *cell));
    cell->side[0] = c->width;
    cell->side[1] = c->depth > 0.0 ? c->depth : c->width;
    cell->side[2] = c->height;
    for (int k = 0; k < 3; ++k) {
        cell->first[k] = cell->side[k];
        cell->inverse[k] = 1.0 / cell->side[k];
    }
    dem->cell = cell;
done:
    return status;
}

/// How far an image may move in a second: one period along each axis, two along x where it shears.
static double image_speed(const clx_periodic_cell *cell)
{
    const bool shears = cell->shift != 0.0 || cell->shear != 0.0;
    return (shears ? 2.0 : 1.0) * fabs(cell->rate[0]) + fabs(cell->rate[1]) + fabs(cell->rate[2]) +
           fabs(cell->shear);
}

/// Velocity at a place of the affine motion with these rates.
static void affine(const clx_periodic_cell *cell, const double x[3], const double rate[3],
                   double shear, double v[3])
{
    const double z = x[2] * cell->inverse[2];
    v[0] = rate[0] * ((x[0] - cell->shift * z) * cell->inverse[0]) + shear * z;
    v[1] = rate[1] * (x[1] * cell->inverse[1]);
    v[2] = rate[2] * z;
}

void clx_cell_affine(const clx_periodic_cell *cell, const double x[3], double v[3])
{
    affine(cell, x, cell->rate, cell->shear, v);
}

/// Gives every grain the change that belongs to its place.
static void kick(clast_dem *dem, const clx_periodic_cell *cell, const double rate[3], double shear)
{
    // of those that were distributed each rank books its own
    const int32_t first = dem->ranks != NULL && dem->ranks->has_begun ? dem->ranks->n_synced : 0;
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        clx_grain *g = &dem->grain[i];
        double change[3];
        const double before = v3_norm2(g->velocity);
        affine(cell, g->position, rate, shear, change);
        v3_add(g->velocity, g->velocity, change);
        if (i >= first) {
            clx_energy_pushed(dem, i, v3_norm2(g->velocity) - before);
        }
    }
}

clast_status clast_dem_set_cell_rate(clast_dem *dem, const double rate[3], double shear)
{
    CLX_ARGUMENTS(dem, rate);
    clast_status status = CLAST_OK;
    clx_periodic_cell *cell = dem->cell;
    CLX_CHECK(cell != NULL, CLAST_E_USAGE, "only domain cell has sides that move");
    CLX_CHECK(v3_is_finite(rate) && isfinite(shear), CLAST_E_USAGE,
              "rates of the cell that are not finite");
    double change[3];
    v3_sub(change, rate, cell->rate);
    const double shear_change = shear - cell->shear;
    v3_copy(cell->rate, rate);
    cell->shear = shear;
    if (v3_norm2(change) != 0.0 || shear_change != 0.0) {
        kick(dem, cell, change, shear_change);
        if (dem->ranks != NULL && dem->ranks->has_begun) { // the grains that are stepped
            kick(dem->ranks->local, cell, change, shear_change);
        }
    }
done:
    return status;
}

void clast_dem_read_cell(const clast_dem *dem, clast_dem_cell *cell)
{
    if (dem == NULL || cell == NULL) {
        return;
    }
    *cell = (clast_dem_cell){0};
    if (dem->cell != NULL) {
        v3_copy(cell->side, dem->cell->side);
        v3_copy(cell->rate, dem->cell->rate);
        cell->shift = dem->cell->shift;
        cell->shear_rate = dem->cell->shear;
        for (int k = 0; k < 3; ++k) {
            cell->strain[k] = log(dem->cell->first[k] / dem->cell->side[k]);
        }
        cell->shear_strain = dem->cell->sheared;
    }
}

void clx_cell_begin_step(clast_dem *dem)
{
    const double dt = dem->config.time_step;
    const double path = dt * image_speed(dem->cell);
    int n_due = 0;
    dem->cell->path += path;
    for (int32_t i = 0; i < dem->n_grain && path > 0.0; ++i) {
        dem->travel[i] += 0.5 * path;
        n_due += !dem->inner.is_due && dem->travel[i] > dem->inner.until[i] ? 1 : 0;
    }
    dem->inner.is_due = dem->inner.is_due || n_due > 0;
}

/// Shifts a grain, its items and where their neighbours were searched.
static void shift_grain(clast_dem *dem, int32_t i, const double by[3], const double velocity[3])
{
    clx_grain *g = &dem->grain[i];
    const int32_t first = dem->item_begin != NULL ? dem->item_begin[i] : i;
    const int32_t last = dem->item_begin != NULL ? dem->item_begin[i + 1] : i + 1;
    v3_add(g->position, g->position, by);
    double work = -v3_norm2(g->velocity);
    v3_add(g->velocity, g->velocity, velocity);
    work += v3_norm2(g->velocity);
    for (int32_t k = first; k < last && k < dem->list.n_known; ++k) {
        double *at = dem->list.anchor[k].position;
        v3_add(at, at, by);
    }
    if (dem->item != NULL) {
        clx_items_place(dem, i);
    }
    clx_energy_pushed(dem, i, work);
}

/// Back into the cell; the image there moves with its side.
static void wrap_grain(clast_dem *dem, int32_t i)
{
    const clx_periodic_cell *cell = dem->cell;
    const double *x = dem->grain[i].position;
    double by[3] = {0.0, 0.0, 0.0};
    double velocity[3] = {0.0, 0.0, 0.0};
    const double z = -floor(x[2] * cell->inverse[2]);
    const double n[2] = {-floor((x[0] + z * cell->shift) * cell->inverse[0] + 0.5),
                         -floor(x[1] * cell->inverse[1] + 0.5)};
    if (z == 0.0 && n[0] == 0.0 && n[1] == 0.0) {
        return;
    }
    for (int c = 0; c < 2; ++c) {
        by[c] = n[c] * cell->side[c];
        velocity[c] = n[c] * cell->rate[c];
    }
    by[0] += z * cell->shift;
    by[2] = z * cell->side[2];
    velocity[0] += z * cell->shear;
    velocity[2] = z * cell->rate[2];
    shift_grain(dem, i, by, velocity);
}

void clx_cell_wrap(const clx_periodic_cell *cell, double x[3])
{
    const double z = -floor(x[2] * cell->inverse[2]);
    x[2] += z * cell->side[2];
    x[0] += z * cell->shift;
    for (int c = 0; c < 2; ++c) {
        x[c] -= floor(x[c] * cell->inverse[c] + 0.5) * cell->side[c];
    }
}

/// Grains that have left come back: most have not, which one comparison of a row tells.
CLX_FOR_EACH_MACHINE
static void wrap_grains(clast_dem *dem)
{
    const clx_periodic_cell *cell = dem->cell;
    const clx_lanes inverse = {cell->inverse[0], cell->inverse[1], cell->inverse[2], 0.0};
    const clx_lanes middle = {0.5, 0.5, 0.0, 0.5}; // the fourth, of a radius, is inside
    static_assert(offsetof(clx_grain, position) == 0 && offsetof(clx_grain, radius) == 24, "a row");
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        const clx_lanes at =
            lanes_load((const double *)(const void *)&dem->grain[i]) * inverse + middle;
        if (lanes_bits((at >= 0.0) & (at < 1.0)) != ALL_INSIDE) {
            wrap_grain(dem, i);
        }
    }
}

void clx_cell_end_step(clast_dem *dem)
{
    clx_periodic_cell *cell = dem->cell;
    const double dt = dem->config.time_step;
    for (int c = 0; c < 3; ++c) {
        cell->side[c] += dt * cell->rate[c];
        cell->inverse[c] = 1.0 / cell->side[c];
    }
    // of the shift's speed, what strains x alone is no shear
    cell->sheared +=
        dt * (cell->shear - cell->rate[0] * (cell->shift * cell->inverse[0])) * cell->inverse[2];
    cell->shift += dt * cell->shear;
    if (fabs(cell->shift) > 0.5 * cell->side[0]) { // the same images, counted anew
        cell->shear -= copysign(1.0, cell->shift) * cell->rate[0];
        cell->shift -= copysign(cell->side[0], cell->shift);
    }
    wrap_grains(dem);
}
