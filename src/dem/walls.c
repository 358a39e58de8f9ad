// Walls that move, and what grains do to them.
//
// Poses are functions of a wall's own clock and of its offset, so a run that goes on from a
// checkpoint has them to the last bit. Contacts of a step see the wall where it is at the step's
// begin, and its surface's velocity there. What walls move is charged to all pairs with a wall
// (`path`), as a grain's own path is. [docs/theory/load.md "Walls"]
#include "dem/wall.h"

#include "base/alloc.h"
#include "dem/container.h"
#include "dem/pair_force.h"
#include "dem/ranks.h"
#include <math.h>
#include <string.h>

/// Share of the smallest item's radius that walls may move until all items search them anew.
static const double MARGIN = 0.5;

/// Steps that an inner list covers at the walls' present speed, and its least share of the margin.
static const double LOOK_AHEAD = 32.0;
static const double LEAST = 0.01;

void clx_walls_free(clx_walls *walls)
{
    for (int32_t i = 0; i < walls->n; ++i) {
        CLX_FREE(walls->body[i].motion.time, walls->body[i].motion.place);
        clx_wall_mesh_destroy(walls->body[i].mesh);
    }
    CLX_FREE(walls->body, walls->wall_force);
    *walls = (clx_walls){0};
}

static void identity(double m[3][3])
{
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            m[r][c] = r == c ? 1.0 : 0.0;
        }
    }
}

clast_status clx_walls_begin(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_walls *w = &dem->walls;
    if (w->body != NULL) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&w->body, dem->n_wall + 1, sizeof *w->body));
    w->n = dem->n_wall;
    for (int32_t i = 0; i < w->n; ++i) {
        w->body[i].rest = dem->wall[i];
        identity(w->body[i].rotation);
    }
done:
    return status;
}

bool clx_walls_move(const clast_dem *dem)
{
    return dem->walls.can_move;
}

const clx_wall_body *clx_wall_of(const clast_dem *dem, int32_t b)
{
    CLAST_ASSERT(b < 0 && dem->walls.body != NULL);
    return b >= -dem->n_wall
               ? &dem->walls.body[-1 - b]
               : &dem->walls.body[dem->n_wall + dem->container->owner[-1 - b - dem->n_wall]];
}

/// Rotation by an angle about a unit axis.
static void rotation(const double axis[3], double angle, double m[3][3])
{
    const double s = sin(angle);
    const double c = cos(angle);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        m[i][i] = c + (1.0 - c) * axis[i] * axis[i];
        m[i][j] = (1.0 - c) * axis[i] * axis[j] - s * axis[k];
        m[i][k] = (1.0 - c) * axis[i] * axis[k] + s * axis[j];
    }
}

/// Row of the table at or before a time; its slope to the next is in `slope`, 0 at both ends.
static void table_at(const clast_dem_wall_motion *m, double time, double value[4], double slope[4])
{
    int32_t low = 0;
    int32_t high = m->n - 1;
    memset(slope, 0, 4 * sizeof *slope);
    if (time < m->time[0] || time >= m->time[high]) {
        memcpy(value, m->place[time < m->time[0] ? 0 : high], 4 * sizeof *value);
        return;
    }
    while (high - low > 1) {
        const int32_t middle = low + (high - low) / 2;
        low = m->time[middle] <= time ? middle : low;
        high = m->time[middle] <= time ? high : middle;
    }
    const double length = m->time[high] - m->time[low];
    for (int k = 0; k < 4; ++k) {
        slope[k] = (m->place[high][k] - m->place[low][k]) / length;
        value[k] = m->place[low][k] + slope[k] * (time - m->time[low]);
    }
}

/// Offset and angle of a motion at its time, and their rates.
static void motion_at(const clast_dem_wall_motion *m, double time, double value[4], double rate[4])
{
    memset(value, 0, 4 * sizeof *value);
    memset(rate, 0, 4 * sizeof *rate);
    if (m->n > 0) {
        table_at(m, time, value, rate);
    }
    const double w = m->period > 0.0 ? 2.0 * CLAST_PI / m->period : 0.0;
    const double sine = sin(w * time);
    const double cosine = w * cos(w * time);
    for (int k = 0; k < 3; ++k) {
        value[k] += m->velocity[k] * time + m->amplitude[k] * sine;
        rate[k] += m->velocity[k] + m->amplitude[k] * cosine;
    }
    value[3] += m->rate * time + m->swing * sine;
    rate[3] += m->rate + m->swing * cosine;
}

/// Triangles of a surface where it is now.
static void place_triangles(clast_dem *dem, clx_wall_body *w)
{
    for (int32_t i = 0; i < w->mesh->n_tri; ++i) {
        const clx_wall_triangle *rest = &w->mesh->tri[i];
        clx_wall_triangle *now = &dem->container->tri[w->first + i];
        double x[3];
        for (int k = 0; k < 4; ++k) {
            const double *from = k < 3 ? rest->corner[k] : rest->centroid;
            double *to = k < 3 ? now->corner[k] : now->centroid;
            v3_sub(x, from, w->motion.pivot);
            m3_to_world(to, w->rotation, x);
            v3_add(to, to, w->pivot);
        }
        m3_to_world(now->normal, w->rotation, rest->normal);
        for (int k = 0; k < 3; ++k) {
            m3_to_world(now->out[k], w->rotation, rest->out[k]);
        }
    }
}

void clx_wall_place(clast_dem *dem, int32_t wall)
{
    clx_wall_body *w = &dem->walls.body[wall];
    double value[4];
    double rate[4];
    const bool is_at_rest = w->clock == 0 && w->motion.n == 0 && v3_norm2(w->offset) == 0.0;
    motion_at(&w->motion, (double)w->clock * dem->config.time_step, value, rate);
    v3_add(w->pivot, w->motion.pivot, w->offset);
    v3_add(w->pivot, w->pivot, value);
    w->angle = value[3];
    if (v3_norm2(w->motion.axis) > 0.0) {
        rotation(w->motion.axis, w->angle, w->rotation);
    }
    if (w->mesh != NULL && is_at_rest) { // to the last bit where it was given
        memcpy(dem->container->tri + w->first, w->mesh->tri,
               (size_t)w->mesh->n_tri * sizeof *w->mesh->tri);
    } else if (w->mesh != NULL) {
        place_triangles(dem, w);
    } else if (w->rest.kind == CLX_WALL_PLANE) {
        double moved[3];
        v3_sub(moved, w->pivot, w->motion.pivot);
        dem->wall[wall].offset = w->rest.offset + v3_dot(w->rest.normal, moved);
    }
}

void clx_walls_begin_step(clast_dem *dem)
{
    const double dt = dem->config.time_step;
    for (int32_t i = 0; i < dem->walls.n && dem->walls.can_move; ++i) {
        clx_wall_body *w = &dem->walls.body[i];
        double value[4];
        double rate[4] = {0.0, 0.0, 0.0, 0.0};
        if (w->runs) {
            motion_at(&w->motion, (double)w->clock * dt, value, rate);
        }
        v3_add(w->velocity, w->drift, rate);
        v3_scale(w->omega, rate[3], w->motion.axis);
    }
}

void clx_walls_end_step(clast_dem *dem)
{
    clx_walls *all = &dem->walls;
    double most = 0.0;
    for (int32_t i = 0; i < all->n && all->can_move; ++i) {
        clx_wall_body *w = &all->body[i];
        double before[3];
        double moved[3];
        const double angle = w->angle;
        if (!w->runs && v3_norm2(w->drift) == 0.0) {
            continue;
        }
        v3_copy(before, w->pivot);
        w->clock += w->runs ? 1 : 0;
        v3_axpy(w->offset, w->offset, dem->config.time_step, w->drift);
        clx_wall_place(dem, i);
        v3_sub(moved, w->pivot, before);
        const double path = w->mesh != NULL
                                ? v3_norm(moved) + fabs(w->angle - angle) * w->bounding_radius
                            : w->rest.kind == CLX_WALL_PLANE ? fabs(v3_dot(moved, w->rest.normal))
                                                             : 0.0;
        most = fmax(most, w->is_open ? 0.0 : path);
    }
    all->step = most;
    all->path += most;
    dem->inner.is_due = dem->inner.is_due || all->path > all->until;
    dem->list.is_due = dem->list.is_due || all->path - all->searched > all->margin;
}

void clx_walls_look_ahead(clast_dem *dem)
{
    clx_walls *all = &dem->walls;
    all->until = all->path + fmax(LOOK_AHEAD * all->step, LEAST * all->margin);
}

static void clear_forces(clx_walls *all)
{
    for (int32_t i = 0; i < all->n; ++i) {
        v3_set(all->body[i].force, 0.0, 0.0, 0.0);
        v3_set(all->body[i].torque, 0.0, 0.0, 0.0);
    }
}

static void add_wall_force(clx_walls *all, const clx_wall_force *wall_force)
{
    CLAST_ASSERT(wall_force->wall >= 0 && wall_force->wall < all->n);
    clx_wall_body *w = &all->body[wall_force->wall];
    v3_add(w->force, w->force, wall_force->force);
    v3_add(w->torque, w->torque, wall_force->torque);
}

/// Impulse, moment and work of a step whose forces are summed.
static void add_impulses(clast_dem *dem)
{
    const double dt = dem->config.time_step;
    for (int32_t i = 0; i < dem->walls.n; ++i) {
        clx_wall_body *w = &dem->walls.body[i];
        v3_axpy(w->impulse, w->impulse, dt, w->force);
        v3_axpy(w->moment, w->moment, dt, w->torque);
        w->work -= dt * (v3_dot(w->force, w->velocity) + v3_dot(w->torque, w->omega));
    }
}

/// Adds a contact's force; one of a rank waits for the sum over ranks.
static clast_status take_wall_force(clast_dem *dem, const clx_wall_force *wall_force)
{
    clast_status status = CLAST_OK;
    clx_walls *all = &dem->walls;
    if (dem->is_ghost == NULL) {
        add_wall_force(all, wall_force);
        return CLAST_OK;
    }
    CLX_TRY(clx_grow(&all->wall_force, &all->wall_force_capacity, all->n_wall_force + 1,
                     sizeof *all->wall_force));
    all->wall_force[all->n_wall_force] = *wall_force;
    all->wall_force[all->n_wall_force].order = all->n_wall_force;
    ++all->n_wall_force;
done:
    return status;
}

clast_status clx_walls_add_forces(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    const clx_inner_list *inner = &dem->inner;
    clear_forces(&dem->walls);
    dem->walls.n_wall_force = 0;
    for (int32_t i = 0; i < dem->n_item; ++i) {
        const int32_t g = clx_item_grain(dem, i);
        const double *x = dem->grain[g].position;
        for (int32_t k = inner->begin[i]; k < inner->begin[i + 1]; ++k) {
            const clx_dem_pair *pair = clx_inner_pair(dem, k);
            if (pair->b >= 0) {
                break; // walls come first
            }
            if (pair->touches != 0 && !clx_are_ghosts(dem, i, i)) {
                const clx_wall_body *w = clx_wall_of(dem, pair->b);
                clx_wall_force wall_force = {.number = clx_grain_number(dem, g),
                                             .wall = (int32_t)(w - dem->walls.body)};
                double arm[3];
                v3_sub(arm, x, w->pivot);
                v3_cross(wall_force.torque, arm, inner->force[k].force);
                v3_add(wall_force.torque, wall_force.torque, inner->force[k].torque_a);
                v3_copy(wall_force.force, inner->force[k].force);
                CLX_TRY(take_wall_force(dem, &wall_force));
            }
        }
    }
    if (dem->is_ghost == NULL) {
        add_impulses(dem);
    }
done:
    return status;
}

void clx_walls_add_gathered(clast_dem *dem, int64_t n, const clx_wall_force *wall_force)
{
    clear_forces(&dem->walls);
    for (int64_t k = 0; k < n; ++k) {
        add_wall_force(&dem->walls, &wall_force[k]);
    }
    add_impulses(dem);
}

double clx_wall_spring(const clast_dem *dem, const clx_dem_pair *pair, int32_t wall,
                       const double along[3])
{
    const clx_contact_history *own = clx_pair_history(dem, pair);
    clx_contact_history history = own != NULL ? *own : (clx_contact_history){0};
    clx_dem_touch t;
    clx_meeting m;
    if (pair->b >= 0 || pair->touches == 0 || clx_wall_of(dem, pair->b) != &dem->walls.body[wall] ||
        !clx_pair_holds(dem, pair, &t)) {
        return 0.0;
    }
    clx_meet_pair(dem, pair, &history, &t, &m);
    const double share =
        dem->config.clump_contacts == CLAST_DEM_SHARED ? 1.0 / clx_sub_contacts(dem, pair) : 1.0;
    const double n = v3_dot(t.normal, along);
    return share * clx_law_stiffness(clx_pair_law(dem, pair), &m) * n * n;
}

/// Lists are due, on all ranks.
static void search_anew(clast_dem *dem)
{
    dem->list.is_due = dem->n_grain > 0;
    if (dem->ranks != NULL) {
        dem->ranks->local->list.is_due = dem->list.is_due;
    }
}

clast_status clast_dem_watch_walls(clast_dem *dem)
{
    CLX_ARGUMENTS(dem);
    const clast_status status = clx_walls_begin(dem);
    dem->walls.is_watched = status == CLAST_OK;
    return status;
}

int32_t clast_dem_n_wall(const clast_dem *dem)
{
    return dem != NULL ? dem->walls.n : 0;
}

/// What a wall of the domain cannot do and stay one.
static clast_status check_motion(const clx_wall_body *w, const clast_dem_wall_motion *m)
{
    clast_status status = CLAST_OK;
    const bool is_plane = w->rest.kind == CLX_WALL_PLANE;
    const double turning = v3_norm2(m->axis);
    if (w->mesh != NULL) {
        return CLAST_OK;
    }
    if (is_plane && turning > 0.0) {
        CLX_CHECK(fabs(v3_dot(m->axis, w->rest.normal)) > 1.0 - 1e-12, CLAST_E_CONFIG,
                  "a plane of the domain rotates about its normal alone; give a surface instead");
    }
    if (!is_plane) {
        bool is_along = m->velocity[0] == 0.0 && m->velocity[1] == 0.0 && m->amplitude[0] == 0.0 &&
                        m->amplitude[1] == 0.0;
        for (int32_t i = 0; i < m->n; ++i) {
            is_along = is_along && m->place[i][0] == 0.0 && m->place[i][1] == 0.0;
        }
        is_along = is_along && (turning == 0.0 || (fabs(m->axis[2]) > 1.0 - 1e-12 &&
                                                   m->pivot[0] == 0.0 && m->pivot[1] == 0.0));
        CLX_CHECK(
            is_along, CLAST_E_CONFIG,
            "the domain's cylinder moves along z and rotates about its own axis alone; give a "
            "surface instead");
    }
done:
    return status;
}

static double bounding_radius_of(const clx_wall_mesh *mesh, const double pivot[3])
{
    double most = 0.0;
    for (int32_t i = 0; i < mesh->n_tri; ++i) {
        for (int k = 0; k < 3; ++k) {
            most = fmax(most, v3_distance(mesh->tri[i].corner[k], pivot));
        }
    }
    return most;
}

static bool is_finite_motion(const clast_dem_wall_motion *m)
{
    bool is_finite = v3_is_finite(m->velocity) && v3_is_finite(m->amplitude) &&
                     v3_is_finite(m->pivot) && isfinite(m->period) && isfinite(m->rate) &&
                     isfinite(m->swing);
    for (int32_t i = 0; i < m->n && is_finite; ++i) {
        is_finite = isfinite(m->time[i]) && v3_is_finite(m->place[i]) && isfinite(m->place[i][3]);
    }
    return is_finite;
}

/// A vibration or swing has a period, and speeds that are numbers.
static clast_status check_period(int32_t wall, const clast_dem_wall_motion *m)
{
    clast_status status = CLAST_OK;
    const double most = fmax(v3_norm(m->amplitude), fabs(m->swing));
    const double w = 2.0 * CLAST_PI / m->period;
    CLX_CHECK(m->period >= 0.0, CLAST_E_USAGE, "wall %d moves with a period of %g s; 0: none", wall,
              m->period);
    CLX_CHECK(most == 0.0 || isfinite(most * w * w), CLAST_E_USAGE,
              "wall %d vibrates by %g m and swings by %g rad with a period of %g s; give a longer "
              "one",
              wall, v3_norm(m->amplitude), fabs(m->swing), m->period);
done:
    return status;
}

clast_status clast_dem_set_wall_motion(clast_dem *dem, int32_t wall,
                                       const clast_dem_wall_motion *motion)
{
    CLX_ARGUMENTS(dem, motion);
    CLX_ARRAY(motion->time, motion->n);
    CLX_ARRAY(motion->place, motion->n);
    clast_status status = CLAST_OK;
    double *time = NULL;
    double(*place)[4] = NULL;
    CLX_CHECK(wall >= 0 && wall < dem->walls.n, CLAST_E_USAGE, "there is no wall %d of %d", wall,
              dem->walls.n);
    CLX_CHECK(dem->cell == NULL, CLAST_E_CONFIG, "domain cell has no walls");
    clx_wall_body *w = &dem->walls.body[wall];
    CLX_CHECK(w->clock == 0, CLAST_E_USAGE, "wall %d moves already", wall);
    CLX_CHECK(v3_norm2(motion->axis) == 0.0 || v3_is_unit(motion->axis, 1e-9), CLAST_E_USAGE,
              "the axis of wall %d has not length 1", wall);
    CLX_CHECK(is_finite_motion(motion), CLAST_E_USAGE, "the motion of wall %d is not finite", wall);
    CLX_TRY(check_period(wall, motion));
    for (int32_t i = 1; i < motion->n; ++i) {
        CLX_CHECK(motion->time[i] > motion->time[i - 1], CLAST_E_USAGE,
                  "times of wall %d do not rise in row %d", wall, i + 1);
    }
    CLX_TRY(check_motion(w, motion));
    CLX_TRY(clx_alloc(&time, motion->n, sizeof *time));
    CLX_TRY(clx_alloc(&place, motion->n, sizeof *place));
    if (motion->n > 0) {
        memcpy(time, motion->time, (size_t)motion->n * sizeof *time);
        memcpy(place, motion->place, (size_t)motion->n * sizeof *place);
    }
    CLX_FREE(w->motion.time, w->motion.place);
    w->motion = *motion;
    w->motion.time = time;
    w->motion.place = place;
    time = NULL;
    place = NULL;
    w->bounding_radius = w->mesh != NULL ? bounding_radius_of(w->mesh, motion->pivot) : 0.0;
    dem->walls.can_move = true;
    dem->walls.is_watched = true;
    search_anew(dem);
    clx_wall_place(dem, wall);
done:
    CLX_FREE(time, place);
    return status;
}

clast_status clast_dem_drive_wall(clast_dem *dem, int32_t wall, bool runs, const double velocity[3])
{
    CLX_ARGUMENTS(dem, velocity);
    clast_status status = CLAST_OK;
    CLX_CHECK(wall >= 0 && wall < dem->walls.n, CLAST_E_USAGE, "there is no wall %d of %d", wall,
              dem->walls.n);
    CLX_CHECK(v3_is_finite(velocity), CLAST_E_USAGE, "wall %d: a velocity that is not finite",
              wall);
    clx_wall_body *w = &dem->walls.body[wall];
    CLX_CHECK(w->mesh != NULL || w->rest.kind == CLX_WALL_PLANE ||
                  (velocity[0] == 0.0 && velocity[1] == 0.0),
              CLAST_E_CONFIG, "the domain's cylinder moves along z alone");
    w->runs = runs;
    v3_copy(w->drift, velocity);
    dem->walls.is_watched = true;
    if (!dem->walls.can_move && (runs || v3_norm2(velocity) > 0.0)) {
        dem->walls.can_move = true;
        search_anew(dem);
    }
done:
    return status;
}

clast_status clast_dem_open_wall(clast_dem *dem, int32_t wall)
{
    CLX_ARGUMENTS(dem);
    clast_status status = CLAST_OK;
    CLX_CHECK(wall >= 0 && wall < dem->walls.n, CLAST_E_USAGE, "there is no wall %d of %d", wall,
              dem->walls.n);
    dem->walls.body[wall].is_open = true;
    dem->walls.searched = -(double)INFINITY; // all items search their walls anew
    search_anew(dem);
done:
    return status;
}

void clast_dem_read_wall(const clast_dem *dem, int32_t wall, clast_dem_wall *out)
{
    if (dem == NULL || out == NULL || wall < 0 || wall >= dem->walls.n) {
        return;
    }
    const clx_wall_body *w = &dem->walls.body[wall];
    *out = (clast_dem_wall){
        .is_open = w->is_open, .angle = w->angle, .work = w->work, .n_step = w->clock};
    v3_sub(out->offset, w->pivot, w->motion.pivot);
    v3_copy(out->velocity, w->velocity);
    v3_copy(out->omega, w->omega);
    v3_copy(out->force, w->force);
    v3_copy(out->torque, w->torque);
    v3_copy(out->impulse, w->impulse);
    v3_copy(out->moment, w->moment);
}

double clx_walls_margin(const clast_dem *dem)
{
    double least = INFINITY;
    if (dem->is_ghost != NULL) {
        return dem->walls.least;
    }
    for (int32_t i = 0; i < dem->n_item && dem->walls.can_move; ++i) {
        least = fmin(least, clx_item_radius(dem, i));
    }
    return isfinite(least) ? MARGIN * least : 0.0;
}
