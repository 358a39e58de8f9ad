// Walls of a packing: added, driven by their motion or by a servo, opened; the grains that leave.
//
// The servo looks every 25 steps at the mean force F since its last look and gives the wall a speed
// along the direction in which it presses,
//
//     v = e + integral of e / (5 tau),  e = (A - F) / (K tau),  |e|, |v| <= load_rate height
//
// A the wanted force, K the springs of the wall's contacts, which no bed behind it exceeds, tau =
// 50 steps; the integral begins anew where e changes its sign, as a bed many times softer than K
// would swing. [docs/theory/load.md "Walls"]
#include "pack/walls.h"

#include "base/alloc.h"
#include "dem/container.h"
#include "dem/dem.h"
#include "dem/ranks.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WALL_TIME = 2 * CLX_SERVO_STEPS };

/// Share of a look's speed that the servo keeps: Delta / (5 tau).
static const double SLOWLY = (double)CLX_SERVO_STEPS / (5.0 * WALL_TIME);

bool clx_pack_has_walls(const clast_pack_config *c)
{
    return c->wall.n > 0 || c->outlet.n > 0 || c->wall_forces;
}

/// Area of a surface seen along a direction; of a closed one, which has two sides, half of it.
static double area_along(const clast_mesh *mesh, const double direction[3], double top)
{
    double sum = 0.0;
    double flux[3] = {0.0, 0.0, 0.0};
    for (int32_t i = 0; i < mesh->n_tri; ++i) {
        const double *const x[3] = {mesh->vert[mesh->tri[i][0]], mesh->vert[mesh->tri[i][1]],
                                    mesh->vert[mesh->tri[i][2]]};
        double e[3];
        double f[3];
        double n[3];
        if (fmax(x[0][2], fmax(x[1][2], x[2][2])) > top) {
            continue;
        }
        v3_sub(e, x[1], x[0]);
        v3_sub(f, x[2], x[0]);
        v3_cross(n, e, f);
        v3_axpy(flux, flux, 0.5, n);
        sum += 0.5 * fabs(v3_dot(n, direction));
    }
    return v3_norm(flux) < 1e-6 * sum ? 0.5 * sum : sum;
}

/// A wall's surface, or NULL of a plane or cylinder of the domain.
static const clast_mesh *surface_of(const clast_pack *p, const clast_pack_wall *wall)
{
    return wall->number < 0                       ? &wall->mesh
           : strcmp(wall->name, "container") == 0 ? p->input.container
                                                  : NULL;
}

/// Area over which a wall's pressure acts, seen along its direction.
static double area_of(const clast_pack *p, const clast_pack_wall *wall)
{
    const clast_dem_config *c = &p->config.dem;
    const double depth = c->depth > 0.0 ? c->depth : c->width;
    const clast_mesh *surface = surface_of(p, wall);
    const clast_mesh *closed = p->input.container_closed;
    if (wall->area > 0.0) {
        return wall->area;
    }
    if (surface != NULL) {
        return area_along(surface, wall->press, INFINITY);
    }
    if (closed != NULL) { // the floor below a container: its bottom, or the hole there
        double low[3];
        double high[3];
        clast_mesh_bounds(closed, low, high);
        return area_along(closed, wall->press, low[2] + 1e-9 * (high[2] - low[2]));
    }
    return wall->press[2] == 0.0 ? c->height * (wall->press[0] != 0.0 ? depth : c->width)
           : c->domain == CLAST_DEM_CYLINDER ? 0.25 * CLAST_PI * c->width * c->width
                                             : c->width * depth;
}

/// Speed of a wall's fastest point by its own motion, at most.
static double speed_of(const clast_pack *p, const clast_pack_wall *wall)
{
    const clast_mesh *surface = surface_of(p, wall);
    const clast_dem_wall_motion *m = &wall->motion;
    double bounding_radius = 0.0;
    double slope[2] = {0.0, 0.0};
    for (int32_t i = 0; surface != NULL && i < surface->n_vert; ++i) {
        bounding_radius = fmax(bounding_radius, v3_distance(surface->vert[i], m->pivot));
    }
    for (int32_t i = 1; i < m->n; ++i) {
        const double time = m->time[i] - m->time[i - 1];
        slope[0] = fmax(slope[0], v3_distance(m->place[i], m->place[i - 1]) / time);
        slope[1] = fmax(slope[1], fabs(m->place[i][3] - m->place[i - 1][3]) / time);
    }
    const double w = m->period > 0.0 ? 2.0 * CLAST_PI / m->period : 0.0;
    return v3_norm(m->velocity) + w * v3_norm(m->amplitude) + slope[0] +
           bounding_radius * (fabs(m->rate) + w * fabs(m->swing) + slope[1]);
}

/// A pressure acts on what a wall shows in the direction in which it presses.
static clast_status check_areas(const clast_pack *p, int32_t number, const clx_wall_stage *s)
{
    clast_status status = CLAST_OK;
    for (int32_t d = 0; d < s->n; ++d) {
        const clast_pack_wall *wall = &p->input.wall[s->drive[d].wall];
        const bool is_asked = (s->drive[d].kind == CLX_WALL_PRESSED && !s->drive[d].is_force) ||
                              (s->end == CLX_UNTIL_STRESS && v3_norm2(wall->press) > 0.0);
        CLX_CHECK(!is_asked || area_of(p, wall) > 0.0, CLAST_E_CONFIG,
                  "stage %d, '%s': wall %s shows no area in the direction in which it presses; "
                  "turn that direction (press), or give the area (area 1cm^2)",
                  number + 1, p->config.stages.item[number], wall->name);
    }
done:
    return status;
}

clast_status clx_pack_walls_check(const clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_pack_config *c = &p->config;
    const double limit = clx_pack_speed_limit(p);
    for (int32_t i = 0; i < p->input.n_wall; ++i) {
        const double speed = speed_of(p, &p->input.wall[i]);
        CLX_CHECK(speed <= limit, CLAST_E_CONFIG,
                  "wall %d, '%s', would move at %s, faster than half of what contacts of the "
                  "smallest grains stop (%s); move it slower, or take stiffer contacts",
                  i + 1, c->wall.item[i], clx_unit_text(speed, "m/s"), clx_unit_text(limit, "m/s"));
    }
    for (int32_t k = 0; k < c->stages.n && c->dem.domain != CLAST_DEM_CELL; ++k) {
        clx_wall_stage s;
        CLX_TRY(clx_wall_stage_read(c, k, &p->input, &s));
        for (int32_t d = 0; d < s.n; ++d) {
            const double speed = s.drive[d].kind == CLX_WALL_SPEED     ? fabs(s.drive[d].aim)
                                 : s.drive[d].kind == CLX_WALL_PRESSED ? c->load_rate * p->height
                                                                       : 0.0;
            CLX_CHECK(
                speed <= limit, CLAST_E_CONFIG,
                "stage %d, '%s': a wall would move at %s, faster than half of what contacts of the "
                "smallest grains stop (%s); take a lower speed (load_rate), or stiffer contacts",
                k + 1, c->stages.item[k], clx_unit_text(speed, "m/s"), clx_unit_text(limit, "m/s"));
        }
        CLX_TRY(check_areas(p, k, &s));
    }
    if (c->dem.domain != CLAST_DEM_CELL) {
        CLX_TRY(clx_wall_stages_run_all(c, &p->input));
    }
done:
    return status;
}

/// z<-10mm: grains whose centre is there leave.
static clast_status read_outlet(const clast_pack_config *c, int32_t i, clx_pack_outlet *out)
{
    const char *text = c->outlet.item[i];
    *out = (clx_pack_outlet){.axis = text[0] - 'x',
                             .sign = text[0] != '\0' && text[1] == '<' ? 1.0 : -1.0};
    return text[0] >= 'x' && text[0] <= 'z' && (text[1] == '<' || text[1] == '>') &&
                   clast_unit_parse_asked(text + 2, "m", &out->at) == CLAST_OK
               ? CLAST_OK
               : clx_fail(CLAST_E_CONFIG, "outlet %d, '%s': expected a half-space, z<-10mm", i + 1,
                          text);
}

/// Names of all walls of the simulation, and the option that each is of.
static void name_walls(clast_pack *p)
{
    static const char *const of_domain[] = {"floor", "lid",   "sides", "left",
                                            "right", "front", "back"};
    double inward[3];
    for (int32_t i = 0; i < p->n_wall; ++i) {
        p->wall[i].option = -1;
        p->wall[i].name = "container";
    }
    for (size_t k = 0; k < sizeof of_domain / sizeof *of_domain; ++k) {
        const int32_t number = clx_wall_of_domain(&p->config.dem, of_domain[k], inward);
        if (number >= 0) {
            p->wall[number].name = of_domain[k];
        }
    }
}

static clast_status add_walls(clast_pack *p)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_dem_watch_walls(p->dem));
    for (int32_t i = 0; i < p->input.n_wall; ++i) {
        const clast_pack_wall *w = &p->input.wall[i];
        int32_t number = w->number;
        if (number < 0) {
            CLX_TRY(clast_dem_add_wall(p->dem, &w->mesh, &number));
        }
    }
    p->n_wall = clast_dem_n_wall(p->dem);
    CLX_TRY(clx_alloc(&p->wall, p->n_wall, sizeof *p->wall));
    name_walls(p);
    int32_t last = p->n_wall - 1;
    for (int32_t i = p->input.n_wall - 1; i >= 0; --i) {
        const clast_pack_wall *w = &p->input.wall[i];
        const int32_t number = w->number >= 0 ? w->number : last--;
        p->wall[number].option = i;
        p->wall[number].name = w->name;
        p->is_held = p->is_held && strcmp(w->name, "container") != 0;
        status = clast_dem_set_wall_motion(p->dem, number, &w->motion);
        if (status != CLAST_OK) {
            clx_fail_prefix("wall %d, '%s'", i + 1, p->config.wall.item[i]);
            goto done;
        }
        if (p->config.stages.n == 0) {
            const double none[3] = {0.0, 0.0, 0.0};
            CLX_TRY(clast_dem_drive_wall(p->dem, number, true, none));
        }
    }
done:
    return status;
}

clast_status clx_pack_walls_begin(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_pack_config *c = &p->config;
    const bool is_cell = c->dem.domain == CLAST_DEM_CELL;
    CLX_CHECK(is_cell || c->stages.n == 0 || p->input.n_wall > 0, CLAST_E_CONFIG,
              "stages move the sides of domain cell, or walls: there is neither (domain, wall)");
    if (!clx_pack_has_walls(c)) {
        return CLAST_OK;
    }
    CLX_CHECK(
        !is_cell, CLAST_E_CONFIG,
        "domain cell is periodic: it has no walls and no outlets (wall, outlet, wall_forces)");
    for (int32_t i = 0; i < p->input.n_wall; ++i) {
        CLX_CHECK(c->dem.domain != CLAST_DEM_PERIODIC || p->input.wall[i].number >= 0,
                  CLAST_E_CONFIG,
                  "wall %d, '%s': a surface does not repeat with a periodic domain; take its floor "
                  "and lid, or domain box",
                  i + 1, c->wall.item[i]);
    }
    CLX_TRY(add_walls(p));
    CLX_TRY(clx_alloc(&p->outlet, c->outlet.n, sizeof *p->outlet));
    p->n_outlet = c->outlet.n;
    for (int32_t i = 0; i < p->n_outlet; ++i) {
        CLX_TRY(read_outlet(c, i, &p->outlet[i]));
    }
done:
    return status;
}

/// The wall of the simulation that an option is.
static int32_t number_of(const clast_pack *p, int32_t option)
{
    int32_t number = 0;
    while (number < p->n_wall && p->wall[number].option != option) {
        ++number;
    }
    CLAST_ASSERT(number < p->n_wall);
    return number;
}

clast_status clx_pack_walls_stage(clast_pack *p, int32_t stage)
{
    clast_status status = CLAST_OK;
    clx_wall_stage s;
    p->load.stage = stage;
    p->load.begun = clast_dem_n_step(p->dem);
    CLX_TRY(clx_wall_stage_read(&p->config, stage, &p->input, &s));
    for (int32_t i = 0; i < p->n_wall; ++i) {
        clast_dem_wall now;
        const double none[3] = {0.0, 0.0, 0.0};
        clast_dem_read_wall(p->dem, i, &now);
        v3_copy(p->wall[i].begun, now.offset);
        v3_copy(p->wall[i].impulse, now.impulse);
        p->wall[i].steady = 0.0;
        CLX_TRY(clast_dem_drive_wall(p->dem, i, false, none));
    }
    p->walls_looked = p->load.begun;
    for (int32_t k = 0; k < s.n; ++k) {
        if (s.drive[k].kind == CLX_WALL_OPENS) {
            CLX_TRY(clast_dem_open_wall(p->dem, number_of(p, s.drive[k].wall)));
        }
    }
done:
    return status;
}

/// Mean force of grains against the direction in which a wall presses, since the last look; or that
/// of the last step, right after it [N].
static double force_on(const clast_pack *p, const clast_pack_wall *wall, int32_t number,
                       const clast_dem_wall *now)
{
    const double time =
        (double)(clast_dem_n_step(p->dem) - p->walls_looked) * p->config.dem.time_step;
    double change[3];
    v3_sub(change, now->impulse, p->wall[number].impulse);
    return time > 0.0 ? -v3_dot(change, wall->press) / time : -v3_dot(now->force, wall->press);
}

/// What a look finds: whether pressures are reached, one has come to `until`, the farthest way.
typedef struct {
    bool is_reached;
    bool has_come[2]; ///< of walls that are pressed, of those that move
    bool moves;       ///< one with a direction, by a speed or its motion
    double displacement;
    double pressure; ///< of the last wall that has a direction
} look;

/// Whether a stage drives the wall of its drive k in this other way, too.
static bool has_other(const clx_wall_stage *s, int32_t k, bool runs)
{
    for (int32_t m = 0; m < s->n; ++m) {
        if (m != k && s->drive[m].wall == s->drive[k].wall &&
            (s->drive[m].kind == CLX_WALL_RUNS) == runs) {
            return true;
        }
    }
    return false;
}

/// The servo: speed of a pressed wall until the next look.
static clast_status press(clast_pack *p, const clast_pack_wall *wall, int32_t number, double off,
                          double *speed)
{
    clast_status status = CLAST_OK;
    const double most = p->config.load_rate * p->height;
    double springs = 0.0;
    CLX_TRY(clx_wall_stiffness(p->dem, number, wall->press, &springs));
    const double stiff = springs * WALL_TIME * p->config.dem.time_step;
    const bool is_near = fabs(off) < most * stiff;
    const double wanted = is_near ? off / stiff : copysign(most, off);
    const double kept = p->wall[number].steady * off > 0.0 ? p->wall[number].steady : 0.0;
    const double steady = kept + SLOWLY * wanted;
    p->wall[number].steady = is_near ? fmin(fmax(steady, -most), most) : 0.0;
    *speed = fmin(fmax(wanted + p->wall[number].steady, -most), most);
done:
    return status;
}

/// Whether a wall's stress has come to `until`: from above where the wall moves away, or its own
/// pressure is lower.
static void look_at_stress(const clx_wall_stage *s, int32_t k, const clast_pack_wall *wall,
                           double now, double area, look *out)
{
    const clx_wall_drive *d = &s->drive[k];
    const bool is_pressed = d->kind == CLX_WALL_PRESSED;
    const bool runs = d->kind == CLX_WALL_RUNS || has_other(s, k, true);
    const bool moves = runs ? !is_pressed : d->kind == CLX_WALL_SPEED && d->aim != 0.0;
    const double speed = (d->kind == CLX_WALL_SPEED ? d->aim : 0.0) +
                         (runs ? v3_dot(wall->motion.velocity, wall->press) : 0.0);
    const double aim = d->is_force ? d->aim / area : d->aim;
    const bool falls = is_pressed ? aim < s->until : speed < 0.0;
    const bool has_come = falls ? now <= s->until : now >= s->until;
    out->moves = out->moves || moves;
    out->has_come[moves] = out->has_come[moves] || has_come;
}

static clast_status drive_one(clast_pack *p, const clx_wall_stage *s, int32_t k, look *out)
{
    clast_status status = CLAST_OK;
    const clx_wall_drive *d = &s->drive[k];
    const clast_pack_wall *wall = &p->input.wall[d->wall];
    const int32_t number = number_of(p, d->wall);
    clast_dem_wall now;
    double velocity[3];
    double speed = d->kind == CLX_WALL_SPEED ? d->aim : 0.0;
    clast_dem_read_wall(p->dem, number, &now);
    const double area = area_of(p, wall);
    const double force = force_on(p, wall, number, &now);
    const bool has_direction = v3_norm2(wall->press) > 0.0;
    out->displacement = fmax(out->displacement, v3_distance(now.offset, p->wall[number].begun));
    out->pressure = has_direction ? force / area : out->pressure;
    if (d->kind == CLX_WALL_PRESSED) {
        const double aim = d->is_force ? d->aim : d->aim * area;
        CLX_TRY(press(p, wall, number, aim - force, &speed));
        out->is_reached =
            out->is_reached && fabs(aim - force) <= p->config.load_tolerance * fabs(aim);
    }
    if (has_direction) {
        look_at_stress(s, k, wall, force / area, area, out);
    }
    v3_scale(velocity, speed, wall->press);
    CLX_TRY(clast_dem_drive_wall(p->dem, number, d->kind == CLX_WALL_RUNS || has_other(s, k, true),
                                 velocity));
done:
    return status;
}

static clast_status drive(clast_pack *p, const clx_wall_stage *s, look *out)
{
    clast_status status = CLAST_OK;
    *out = (look){.is_reached = true};
    for (int32_t k = 0; k < s->n; ++k) {
        const clx_wall_drive_kind kind = s->drive[k].kind;
        if (kind != CLX_WALL_OPENS && (kind != CLX_WALL_RUNS || !has_other(s, k, false))) {
            CLX_TRY(drive_one(p, s, k, out));
        }
    }
    for (int32_t i = 0; i < p->n_wall; ++i) {
        clast_dem_wall now;
        clast_dem_read_wall(p->dem, i, &now);
        v3_copy(p->wall[i].impulse, now.impulse);
    }
    p->walls_looked = clast_dem_n_step(p->dem);
done:
    return status;
}

/// Planes that have passed each other; corners of a surface beyond a plane; surfaces that cut.
static clast_status check_crossing(const clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_dem *dem = p->dem;
    for (int32_t i = 0; i < p->n_wall; ++i) {
        for (int32_t k = 0; k < i; ++k) {
            CLX_CHECK(!clx_walls_cross(dem, i, k), CLAST_E_CONVERGE,
                      "walls %s and %s cross by step %lld: give one of them less way, or end the "
                      "stage earlier",
                      p->wall[k].name, p->wall[i].name, (long long)clast_dem_n_step(dem));
        }
    }
done:
    return status;
}

static clast_status is_over(clast_pack *p, const clx_wall_stage *s, const look *l, bool *over)
{
    clast_status status = CLAST_OK;
    const double time =
        (double)(clast_dem_n_step(p->dem) - p->load.begun) * p->config.dem.time_step;
    *over = false;
    if (s->end == CLX_UNTIL_REST && l->is_reached && time > 0.0) {
        clast_dem_load load;
        clast_dem_energy energy;
        CLX_TRY(clx_dem_gather_load(p->dem, &load, &energy));
        // n_force counts places between grains; a lone one between plates has none
        *over = load.force_mean > 0.0 && load.unbalanced < p->config.load_rest;
    } else if (s->end == CLX_UNTIL_TIME) {
        *over = time >= s->until * (1.0 - 1e-12);
    } else if (s->end == CLX_UNTIL_STRESS) {
        *over = time > 0.0 && (s->until > 0.0 ? l->has_come[l->moves] : l->is_reached);
    } else if (s->end == CLX_UNTIL_WAY) {
        *over = l->displacement >= s->until * (1.0 - 1e-12);
    } else if (s->end == CLX_UNTIL_MASS) {
        *over = p->mass - p->mass_left <= s->until;
    }
    CLX_CHECK(*over || s->end == CLX_UNTIL_TIME || time < p->config.max_load_time, CLAST_E_CONVERGE,
              "stage %d, '%s', has not come to its end in %s (max_load_time): pressure of its wall "
              "%s, farthest way of a wall %s, %s of grains inside",
              p->load.stage + 1, p->config.stages.item[p->load.stage], clx_unit_text(time, "s"),
              clx_unit_text(l->pressure + 0.0, "Pa"), clx_unit_text(l->displacement, "m"),
              clx_unit_text(p->mass - p->mass_left, "kg"));
done:
    return status;
}

clast_status clx_pack_walls_look(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const int64_t step = clast_dem_n_step(p->dem);
    clx_wall_stage s;
    look l;
    bool over = false;
    if ((step - p->phase_step) % CLX_SERVO_STEPS != 0 ||
        (step == p->walls_looked && step > p->load.begun)) {
        return CLAST_OK;
    }
    CLX_TRY(clx_wall_stage_read(&p->config, p->load.stage, &p->input, &s));
    CLX_TRY(drive(p, &s, &l));
    CLX_TRY(is_over(p, &s, &l, &over));
    if (over) {
        CLX_TRY(clx_pack_load_row(p));
        CLX_TRY(clx_pack_walls_row(p));
        if (p->load.stage + 1 == p->config.stages.n) {
            p->converged = true;
            p->load.is_over = true;
            p->load.has_rested = s.end == CLX_UNTIL_REST;
            return CLAST_OK;
        }
        CLX_TRY(clx_pack_walls_stage(p, p->load.stage + 1));
        CLX_TRY(clx_wall_stage_read(&p->config, p->load.stage, &p->input, &s));
        CLX_TRY(drive(p, &s, &l));
    }
done:
    return status;
}

clast_status clx_pack_outlets(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const int32_t n = clast_dem_n_grain(p->dem);
    uint8_t *goes = NULL;
    int32_t n_gone = 0;
    bool is_any = false;
    if (p->n_outlet == 0 || clast_dem_n_step(p->dem) % CLX_SERVO_STEPS != 0) {
        return CLAST_OK;
    }
    for (int32_t k = 0; k < p->n_outlet && !is_any; ++k) {
        const clx_pack_outlet *o = &p->outlet[k];
        is_any = clx_dem_any_beyond(p->dem, o->axis, o->sign, o->at);
    }
    if (!is_any) {
        return CLAST_OK;
    }
    CLX_TRY(clx_dem_gather_grains(p->dem));
    CLX_TRY(clx_dem_agree(p->dem, clx_alloc(&goes, n, sizeof *goes)));
    for (int32_t i = 0; i < n; ++i) {
        const clx_grain *g = &p->dem->grain[i];
        for (int32_t k = 0; k < p->n_outlet && goes[i] == 0; ++k) {
            clx_pack_outlet *o = &p->outlet[k];
            if (o->sign * (g->position[o->axis] - o->at) < 0.0) {
                goes[i] = 1;
                ++n_gone;
                ++o->n;
                o->mass += g->mass;
                p->mass_left += g->mass;
            }
        }
    }
    p->n_left += n_gone;
    if (n_gone > 0) {
        CLX_TRY(clast_dem_remove_grains(p->dem, goes));
    }
done:
    clx_free(goes);
    return status;
}

static const char *const of_wall[][2] = {
    {"x_m", "m"},           {"y_m", "m"},           {"z_m", "m"},       {"angle_rad", "rad"},
    {"force_x_N", "N"},     {"force_y_N", "N"},     {"force_z_N", "N"}, {"torque_x_Nm", "N m"},
    {"torque_y_Nm", "N m"}, {"torque_z_Nm", "N m"}, {"work_J", "J"}};
enum { N_OF_WALL = sizeof of_wall / sizeof *of_wall };

clast_status clx_pack_walls_table(clast_pack *p)
{
    clast_status status = CLAST_OK;
    static const char *const first[][2] = {{"step", "-"},     {"time_s", "s"},
                                           {"stage", "-"},    {"n_grain", "-"},
                                           {"mass_kg", "kg"}, {"mass_left_kg", "kg"}};
    char name[64];
    if (!clx_pack_has_walls(&p->config)) {
        return CLAST_OK;
    }
    CLX_TRY(clast_table_init(&p->walls, "walls", 0));
    for (size_t k = 0; k < sizeof first / sizeof *first; ++k) {
        CLX_TRY(clast_table_add_number(&p->walls, first[k][0], first[k][1], NULL));
    }
    for (int32_t i = 0; i < p->n_outlet; ++i) {
        (void)snprintf(name, sizeof name, "outlet_%d_n", i + 1);
        CLX_TRY(clast_table_add_number(&p->walls, name, "-", NULL));
        (void)snprintf(name, sizeof name, "outlet_%d_kg", i + 1);
        CLX_TRY(clast_table_add_number(&p->walls, name, "kg", NULL));
    }
    for (int32_t i = 0; i < p->n_wall; ++i) {
        for (int k = 0; k < N_OF_WALL; ++k) {
            (void)snprintf(name, sizeof name, "%s_%s", p->wall[i].name, of_wall[k][0]);
            CLX_TRY(clast_table_add_number(&p->walls, name, of_wall[k][1], NULL));
        }
    }
done:
    return status;
}

/// A wall's numbers: where it is, mean force and torque since the last row, work.
static void measure_wall(const clast_pack *p, int32_t i, double time, double x[N_OF_WALL])
{
    clast_dem_wall now;
    const clx_pack_wall *w = &p->wall[i];
    clast_dem_read_wall(p->dem, i, &now);
    v3_copy(x, now.offset);
    x[3] = now.angle;
    for (int k = 0; k < 3; ++k) {
        x[4 + k] = time > 0.0 ? (now.impulse[k] - w->row[k]) / time : now.force[k];
        x[7 + k] = time > 0.0 ? (now.moment[k] - w->row[3 + k]) / time : now.torque[k];
    }
    x[10] = now.work;
}

/// The next row's means are since this step; not since an early end's, whose row is written anew
/// when the run goes on.
static void begin_row(clast_pack *p)
{
    const int64_t step = clast_dem_n_step(p->dem);
    const int64_t most = p->config.max_steps;
    if (p->phase != CLAST_PACK_DONE && most > 0 && step >= most) {
        return;
    }
    p->walls_row = step;
    for (int32_t i = 0; i < p->n_wall; ++i) {
        clast_dem_wall now;
        clast_dem_read_wall(p->dem, i, &now);
        v3_copy(p->wall[i].row, now.impulse);
        v3_copy(p->wall[i].row + 3, now.moment);
    }
}

clast_status clx_pack_walls_row(clast_pack *p)
{
    clast_status status = CLAST_OK;
    clast_table *table = &p->walls;
    const int64_t row = table->n_row;
    const int64_t step = clast_dem_n_step(p->dem);
    if (!clx_pack_has_walls(&p->config) ||
        (row > 0 && clast_table_numbers(table, "step")[row - 1] >= (double)step)) {
        return CLAST_OK;
    }
    CLX_TRY(check_crossing(p));
    CLX_TRY(clast_table_resize(table, row + 1));
    const double time = (double)(step - p->walls_row) * p->config.dem.time_step;
    int c = 0;
    table->column[c++].number[row] = (double)step;
    table->column[c++].number[row] = clast_dem_time(p->dem);
    table->column[c++].number[row] = p->phase == CLAST_PACK_LOAD ? p->load.stage + 1 : 0;
    table->column[c++].number[row] = clast_dem_n_grain(p->dem);
    table->column[c++].number[row] = p->mass - p->mass_left;
    table->column[c++].number[row] = p->mass_left;
    for (int32_t i = 0; i < p->n_outlet; ++i) {
        table->column[c++].number[row] = (double)p->outlet[i].n;
        table->column[c++].number[row] = p->outlet[i].mass;
    }
    for (int32_t i = 0; i < p->n_wall; ++i) {
        double x[N_OF_WALL];
        measure_wall(p, i, time, x);
        for (int k = 0; k < N_OF_WALL; ++k) {
            table->column[c++].number[row] = x[k];
        }
    }
    begin_row(p);
done:
    return status;
}

const clast_table *clast_pack_wall_table(const clast_pack *pack)
{
    return pack != NULL && clx_pack_has_walls(&pack->config) ? &pack->walls : NULL;
}
