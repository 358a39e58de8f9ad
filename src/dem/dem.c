// A simulation: made, filled with grains, stepped.
#include <clast/dem.h>

#include "base/alloc.h"
#include "dem/container.h"
#include "dem/dem.h"
#include "dem/energy.h"
#include "dem/fluid.h"
#include "dem/ranks.h"
#include <clast/settling.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

clast_status clast_dem_create(const clast_dem_config *config, clast_dem **dem)
{
    CLX_ARGUMENTS(config, dem);
    clast_status status = CLAST_OK;
    clast_dem *made = NULL;
    CLX_TRY(clast_fields_check(clast_dem_fields, config));
    CLX_TRY(clx_dem_check(config));
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    made->config = *config;
    made->drive = (clast_dem_drive){.shake_period = 1.0, .damping = 1.0};
    made->law = clx_law_make(config);
    made->all_round = true;
    clx_dem_build_walls(made);
    CLX_TRY(clx_cell_make(made));
    *dem = made;
    made = NULL;
done:
    clast_dem_destroy(made);
    return status;
}

void clast_dem_destroy(clast_dem *dem)
{
    if (dem == NULL) {
        return;
    }
    for (int32_t i = 0; i < dem->n_body; ++i) {
        clx_body_free(&dem->body[i]);
    }
    clx_ranks_destroy(dem->ranks);
    clx_neighbour_list_free(&dem->list);
    clx_container_destroy(dem->container);
    clx_walls_free(&dem->walls);
    clx_inner_free(&dem->inner);
    clx_sweeping_free(&dem->sweeping);
    CLX_FREE(dem->body, dem->grain, dem->motion, dem->travel, dem->item, dem->item_begin,
             dem->convex, dem->item_rotation, dem->block_flag, dem->slabs.solid, dem->cell);
    clx_energy_destroy(dem->energy);
    CLX_FREE(dem->laws.law, dem);
}

static bool all_finite(const double *x, int n)
{
    for (int k = 0; k < n; ++k) {
        if (!isfinite(x[k])) {
            return false;
        }
    }
    return true;
}

enum { BOUNDS_SIZE = 160 };

/// Where the walls of the domain stand, for people: "x within 52 mm of 0, y within 52 mm of 0, z
/// above 0".
static void tell_bounds(const clast_dem_config *c, char text[BOUNDS_SIZE])
{
    const double depth = c->depth > 0.0 ? c->depth : c->width;
    int n = 0;
    text[0] = '\0';
    if (c->domain == CLAST_DEM_CYLINDER) {
        n = snprintf(text, BOUNDS_SIZE, "x^2 + y^2 below (%s)^2",
                     clx_unit_text(0.5 * c->width, "m"));
    } else if (c->domain == CLAST_DEM_BOX) {
        n = snprintf(text, BOUNDS_SIZE, "x within %s of 0, y within %s of 0",
                     clx_unit_text(0.5 * c->width, "m"), clx_unit_text(0.5 * depth, "m"));
    }
    CLAST_ASSERT(n >= 0 && n < BOUNDS_SIZE);
    const char *comma = n > 0 && (c->floor || c->lid) ? ", " : "";
    const char *height = clx_unit_text(c->height, "m");
    (void)snprintf(text + n, (size_t)(BOUNDS_SIZE - n), "%s%s%s", comma,
                   c->floor && c->lid ? "z from 0 to "
                   : c->floor         ? "z above 0"
                   : c->lid           ? "z below "
                                      : "",
                   c->lid ? height : "");
}

/// Room that the side walls leave for a grain's centre.
static clast_status check_fit(const clast_dem *dem, const clast_dem_grain *g, double radius,
                              int64_t number)
{
    clast_status status = CLAST_OK;
    const clast_dem_config *c = &dem->config;
    const double depth = c->depth > 0.0 ? c->depth : c->width;
    const bool is_cell = c->domain == CLAST_DEM_CELL;
    const double narrow = c->domain == CLAST_DEM_CYLINDER ? c->width
                          : is_cell                       ? fmin(fmin(c->width, depth), c->height)
                                                          : fmin(c->width, depth);
    if (c->domain == CLAST_DEM_PERIODIC || is_cell) {
        const double across = 2.0 * radius * (1.0 + clx_least_skin(c));
        CLX_CHECK((is_cell ? 2.0 : 1.0) * across <= narrow, CLAST_E_GEOMETRY,
                  "grain %lld has a bounding diameter of %s, %s with its skin, more than %s of %s",
                  (long long)number, clx_unit_text(2.0 * radius, "m"), clx_unit_text(across, "m"),
                  is_cell ? "half the period" : "the period", clx_unit_text(narrow, "m"));
    } else if (c->domain != CLAST_DEM_OPEN) {
        CLX_CHECK(2.0 * radius <= narrow, CLAST_E_GEOMETRY,
                  "grain %lld has a bounding diameter of %s, the domain is only %s wide",
                  (long long)number, clx_unit_text(2.0 * radius, "m"), clx_unit_text(narrow, "m"));
    }
    for (int32_t w = 0; w < dem->n_wall; ++w) {
        char bounds[BOUNDS_SIZE];
        double normal[3];
        if (dem->walls.n > 0 && dem->walls.body[w].is_open) {
            continue;
        }
        const bool is_within = clx_wall_distance(&dem->wall[w], g->position, normal) > 0.0;
        if (!is_within) {
            tell_bounds(c, bounds);
        }
        CLX_CHECK(is_within, CLAST_E_GEOMETRY,
                  "grain %lld begins outside of the domain, at %s, %s, %s; its centre lies in %s",
                  (long long)number, clx_unit_text(g->position[0], "m"),
                  clx_unit_text(g->position[1], "m"), clx_unit_text(g->position[2], "m"), bounds);
    }
done:
    return status;
}

static clast_status check_grain(const clast_dem *dem, const clast_dem_grain *g, int64_t number)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(g->shape >= 0 && g->shape < dem->n_body, CLAST_E_USAGE,
              "grain %lld: there is no shape %d", (long long)number, g->shape);
    CLX_CHECK(all_finite(g->position, 3) && all_finite(g->velocity, 3) &&
                  all_finite(g->angular_velocity, 3) && all_finite(g->orientation, 4) &&
                  g->scale > 0.0 && isfinite(g->scale) && g->density > 0.0 && isfinite(g->density),
              CLAST_E_USAGE, "grain %lld: numbers that are not finite, or a size or density of 0",
              (long long)number);
    const double *q = g->orientation;
    const double n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    CLX_CHECK(fabs(n - 1.0) < 2e-9, CLAST_E_USAGE, "grain %lld: its quaternion has length %.12g",
              (long long)number, sqrt(n));
    const clast_shape *shape = &dem->body[g->shape].shape;
    const clx_hull_core *core = dem->body[g->shape].core;
    const double radius = g->scale * dem->body[g->shape].bounding_radius;
    CLX_TRY(check_fit(dem, g, radius, number));
    CLX_CHECK(core == NULL || dem->config.rounding == 0.0 ||
                  dem->config.rounding < 0.5 * g->scale * core->inner,
              CLAST_E_GEOMETRY,
              "grain %lld: edges rounded to %s (rounding) leave little of a grain with a ball of "
              "%s inside; take less than half of it",
              (long long)number, clx_unit_text(dem->config.rounding, "m"),
              clx_unit_text(core != NULL ? g->scale * core->inner : 0.0, "m"));
    const double volume = g->scale * g->scale * g->scale * shape->volume;
    for (int32_t k = 0; k < clx_n_law(dem); ++k) {
        CLX_TRY(clx_dem_check_step(clx_law_at(dem, g->shape, k), dem->config.time_step,
                                   g->density * volume, cbrt(3.0 * volume / (4.0 * CLAST_PI))));
    }
    CLX_TRY(clx_fluid_check(dem, g, number));
done:
    return status;
}

/// Grain i anew, as given; its slot exists.
static void set_grain(clast_dem *dem, int32_t i, const clast_dem_grain *from)
{
    CLAST_ASSERT(from->shape >= 0 && from->shape < dem->n_body);
    CLAST_ASSERT(from->scale > 0.0 && from->density > 0.0);
    CLAST_ASSERT(v3_is_finite(from->position) && q_is_unit(from->orientation, 1e-9 + 1e-12));
    clx_dem_body *body = &dem->body[from->shape];
    const double s = from->scale;
    const double volume = s * s * s * body->shape.volume;
    clx_grain *g = &dem->grain[i];
    clx_motion *m = &dem->motion[i];
    double in_body[3];
    double momentum[3];
    *g = (clx_grain){.mass = from->density * volume,
                     .radius = s * body->bounding_radius,
                     .round_radius = cbrt(3.0 * volume / (4.0 * CLAST_PI)),
                     .scale = s,
                     .shape = from->shape,
                     .kind = (int32_t)body->shape.kind};
    v3_copy(g->position, from->position);
    v3_copy(g->velocity, from->velocity);
    v3_copy(g->omega, from->angular_velocity);
    *m = (clx_motion){.inertia_factor = from->density * s * s * s * s * s,
                      .volume = volume,
                      .density = from->density};
    memcpy(m->orientation, from->orientation, sizeof m->orientation);
    q_matrix(g->rotation, m->orientation);
    m->inverse_factor = 1.0 / m->inertia_factor;
    m3_to_local(in_body, g->rotation, from->angular_velocity);
    m3_mul(momentum, body->inertia, in_body);
    v3_scale(momentum, m->inertia_factor, momentum);
    m3_to_world(m->angular, g->rotation, momentum);
    if (body->shape.kind == CLAST_SHAPE_SPHERE) { // never turned, so none may depend on it
        memset(g->rotation, 0, sizeof g->rotation);
        g->rotation[0][0] = g->rotation[1][1] = g->rotation[2][2] = 1.0;
    }
    const clast_drag drag = clx_fluid_form(dem, &body->shape, m->density);
    m->drag[0] = drag.stokes;
    m->drag[1] = drag.newton;
    double speed = INFINITY; // that the softest of its contacts stops
    for (int32_t k = 0; k < clx_n_law(dem); ++k) {
        const clx_law *law = clx_law_at(dem, g->shape, k);
        speed = fmin(speed, clx_law_speed(law, g->mass, g->round_radius, g->radius));
    }
    dem->stride = fmax(dem->stride, speed * dem->config.time_step / g->radius);
    dem->travel[i] = 0.0;
}

clast_status clast_dem_add_grains(clast_dem *dem, int32_t n, const clast_dem_grain *grain)
{
    CLX_ARGUMENTS(dem);
    CLX_ARRAY(grain, n);
    clast_status status = CLAST_OK;
    CLX_CHECK(n >= 0 && n <= INT32_MAX - dem->n_grain, CLAST_E_LIMIT, "%d more grains", n);
    for (int32_t i = 0; i < n; ++i) {
        CLX_TRY(check_grain(dem, &grain[i], (int64_t)dem->n_grain + i));
    }
    CLX_TRY(clx_grains_reserve(dem, (int64_t)dem->n_grain + n));
    CLX_TRY(clx_items_reserve(dem, n, grain));
    const int32_t first = dem->n_grain;
    for (int32_t i = 0; i < n; ++i) {
        set_grain(dem, dem->n_grain, &grain[i]);
        clx_items_add(dem, dem->n_grain++);
    }
    clx_energy_added(dem, first);
    dem->list.is_due = true;
done:
    return status;
}

clast_status clast_dem_set_drive(clast_dem *dem, const clast_dem_drive *drive)
{
    CLX_ARGUMENTS(dem, drive);
    clast_status status = CLAST_OK;
    const double w = 2.0 * CLAST_PI / drive->shake_period;
    CLX_CHECK(drive->shake_amplitude >= 0.0 && isfinite(drive->shake_amplitude) &&
                  drive->shake_period >= 0.0 && isfinite(drive->shake_period),
              CLAST_E_ARGUMENT,
              "drive: shaken by %g m with a period of %g s; both must be finite and not negative",
              drive->shake_amplitude, drive->shake_period);
    CLX_CHECK(drive->shake_amplitude == 0.0 || isfinite(drive->shake_amplitude * w * w),
              CLAST_E_ARGUMENT, "drive: shaken by %g m with a period of %g s; give a longer one",
              drive->shake_amplitude, drive->shake_period);
    CLX_CHECK(drive->damping >= 0.0 && drive->damping <= 1.0, CLAST_E_ARGUMENT,
              "drive: velocities keep %g a second; give 0 to 1, 1 for no damping", drive->damping);
    dem->drive = *drive;
done:
    return status;
}

// A step, in the order in which it happens:
//   1. neighbour list   items that have used up their margin search their neighbours anew
//   2. inner list       pairs of it that may touch before some grain's path is used up
//   3. starts           grains that were just added must not lie inside of each other
//   4. fluid            solids by height, where they hinder each other's settling
//   5. contacts         gap and normal of each active pair, its contact law, force and torques
//   6. motion           sums, then velocities, positions and orientations; who has used up what
// 5 and 6 are one sweep over the grains (sweep.c), or two passes where a clump's or rigid grain's
// contacts share their stiffness, walls have triangles or are watched, contacts are verified, or
// their energy is booked.
clast_status clx_dem_step_packed(clast_dem *dem, int64_t n_step)
{
    clast_status status = CLAST_OK;
    if (dem->ranks != NULL && dem->n_grain > 0) { // without grains only walls move, on all alike
        return clx_ranks_step(dem, n_step);
    }
    for (int64_t k = 0; k < n_step; ++k) {
        bool is_fine = true;
        if (dem->list.is_due) {
            clx_inner_unpack(dem);
            CLX_TRY(clx_neighbour_list_refresh(dem));
        }
        if (dem->cell != NULL) { // after the list, which holds from before its images move
            clx_cell_begin_step(dem);
        }
        if (dem->inner.is_due) {
            CLX_TRY(clx_inner_find(dem));
        }
        if (dem->n_started < dem->n_grain) {
            CLX_TRY(clx_check_starts(dem));
        }
        CLX_TRY(clx_fluid_update_slabs(dem));
        clx_walls_begin_step(dem);
        CLX_TRY(clx_contacts_and_motion(dem, &is_fine));
        clx_walls_end_step(dem);
        if (dem->cell != NULL) {
            clx_cell_end_step(dem);
        }
        ++dem->step;
        if (!is_fine) {
            clx_inner_unpack(dem);
            return clx_explain_explosion(dem);
        }
    }
done:
    return status;
}

clast_status clast_dem_step(clast_dem *dem, int64_t n_step)
{
    CLX_ARGUMENTS(dem);
    if (n_step < 0) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: %lld steps", __func__, (long long)n_step);
    }
    const clast_status status = clx_dem_step_packed(dem, n_step);
    clx_inner_unpack(dem);
    return status;
}

int32_t clast_dem_n_grain(const clast_dem *dem)
{
    if (dem == NULL) {
        return 0;
    }
    return dem->n_grain;
}

int64_t clast_dem_n_step(const clast_dem *dem)
{
    if (dem == NULL) {
        return 0;
    }
    return dem->step;
}

double clast_dem_time(const clast_dem *dem)
{
    if (dem == NULL) {
        return (double)NAN;
    }
    return clx_dem_time(dem);
}

void clast_dem_read_grain(const clast_dem *dem, int32_t i, clast_dem_grain *grain)
{
    if (dem == NULL || grain == NULL || i < 0 || i >= dem->n_grain) {
        return;
    }
    const clx_grain *g = &dem->grain[i];
    const clx_motion *m = &dem->motion[i];
    *grain = (clast_dem_grain){.shape = g->shape, .scale = g->scale, .density = m->density};
    v3_copy(grain->position, g->position);
    v3_copy(grain->velocity, g->velocity);
    v3_copy(grain->angular_velocity, g->omega);
    memcpy(grain->orientation, m->orientation, sizeof m->orientation);
}
