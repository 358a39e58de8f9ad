// A packing in a container of triangles: its room, its walls, and who has left it.
#include "base/alloc.h"
#include "math/vec3.h"
#include "pack/pack.h"
#include "pack/walls.h"
#include <math.h>
#include <string.h>

static bool lies_in_floor(const clast_mesh *mesh, int32_t i, double extent)
{
    bool lies = true;
    for (int k = 0; k < 3; ++k) {
        lies = lies && fabs(mesh->vert[mesh->tri[i][k]][2]) <= 1e-9 * extent;
    }
    return lies;
}

/// Triangles but those that lie in the floor: the plane pushes there.
static clast_status walls_of(const clast_mesh *mesh, bool has_floor, double extent,
                             clast_mesh *walls)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_mesh_copy(mesh, walls));
    walls->n_tri = 0;
    for (int32_t i = 0; i < mesh->n_tri; ++i) {
        if (!has_floor || !lies_in_floor(mesh, i, extent)) {
            for (int k = 0; k < 3; ++k) {
                walls->tri[walls->n_tri][k] = mesh->tri[i][k];
            }
            ++walls->n_tri;
        }
    }
done:
    return status;
}

/// The first item that has this name among its first words, of which it looks at `most`; or -1.
static int32_t find_name(const clast_text_list *list, int most, const char *name)
{
    for (int32_t i = 0; i < list->n; ++i) {
        const char *at = list->item[i];
        char word[64];
        for (int k = 0; k < most && at != NULL; ++k) {
            at = clx_next_word(at, word, sizeof word);
            if (at != NULL && strcmp(word, name) == 0) {
                return i;
            }
        }
    }
    return -1;
}

static clast_status fail(const char *option, const clast_text_list *list, int32_t i,
                         const char *what)
{
    return clx_fail(CLAST_E_CONFIG,
                    "%s %d, '%s': the container's bottom lies in the floor, which pushes in its "
                    "place; give --no-floor, or %s",
                    option, i + 1, list->item[i], what);
}

/// Motions of two walls by their words.
static bool moves_alike(const clx_wall_words *a, const clx_wall_words *b)
{
    const clast_dem_wall_motion *m = &a->wall.motion;
    const clast_dem_wall_motion *n = &b->wall.motion;
    return v3_distance(m->velocity, n->velocity) == 0.0 &&
           v3_distance(m->amplitude, n->amplitude) == 0.0 && m->period == n->period &&
           v3_distance(m->axis, n->axis) == 0.0 && v3_distance(m->pivot, n->pivot) == 0.0 &&
           m->rate == n->rate && m->swing == n->swing && strcmp(a->table, b->table) == 0;
}

/// What a stage does with a wall: bits by clx_wall_drive_kind.
static uint32_t drives_of(const clx_wall_stage *s, int32_t wall)
{
    uint32_t drives = 0;
    for (int32_t k = 0; k < s->n; ++k) {
        drives |= s->drive[k].wall == wall ? 1U << s->drive[k].kind : 0U;
    }
    return drives;
}

/// Stages that do with one of the two what they do not with the other; a servo, or one direction
/// each, would part them.
static clast_status check_stages(const clast_pack_config *c, const clast_pack_input *input,
                                 int32_t container, int32_t floor)
{
    clast_status status = CLAST_OK;
    const uint32_t as_one = 1U << CLX_WALL_RUNS | 1U << CLX_WALL_OPENS;
    for (int32_t i = 0; i < c->stages.n && input->n_wall == c->wall.n; ++i) {
        clx_wall_stage s = {.n = 0};
        CLX_TRY(clx_wall_stage_read(c, i, input, &s));
        const uint32_t drives = drives_of(&s, container);
        const bool is_one = drives == drives_of(&s, floor) && (drives & ~as_one) == 0;
        CLX_TRY(is_one ? CLAST_OK
                       : fail("stage", &c->stages, i,
                              drives == 0 ? "let the container move or open with it"
                                          : "let the floor move or open with it"));
    }
done:
    return status;
}

/// A container with the floor in the place of its bottom and that floor move and open as one:
/// neither of the two at rest can hold what the other does.
static clast_status check_wall(const clast_pack_config *c, const clast_pack_input *input)
{
    clast_status status = CLAST_OK;
    const int32_t container = find_name(&c->wall, 1, "container");
    const int32_t floor = find_name(&c->wall, 1, "floor");
    clx_wall_words words[2] = {{.idle = NULL}, {.idle = NULL}}; // at rest
    if (container >= 0) {
        CLX_TRY(clx_wall_read(c, container, &words[0]));
    }
    if (floor >= 0) {
        CLX_TRY(clx_wall_read(c, floor, &words[1]));
    }
    if (container >= 0) { // whose forces are without the floor's
        CLX_TRY(floor >= 0 && moves_alike(&words[0], &words[1])
                    ? CLAST_OK
                    : fail("wall", &c->wall, container, "give the floor the same motion, too"));
    } else if (floor >= 0) {
        CLX_TRY(moves_alike(&words[0], &words[1])
                    ? CLAST_OK
                    : fail("wall", &c->wall, floor, "give the container the same motion, too"));
    }
    CLX_TRY(check_stages(c, input, container, floor));
done:
    return status;
}

/// Contacts of the container, but not of the floor in which its bottom lies.
static clast_status check_contacts(const clast_text_list *list)
{
    const int32_t i = find_name(list, 2, "container");
    return i < 0 || find_name(list, 2, "floor") >= 0
               ? CLAST_OK
               : fail("contacts", list, i, "name the floor, too");
}

clast_status clx_pack_check_bottom(const clast_pack_config *config, const clast_pack_input *input)
{
    clast_status status = CLAST_OK;
    const clast_mesh *mesh = input->container;
    double low[3];
    double high[3];
    int32_t i = 0;
    if (input->container_closed == NULL || !config->dem.floor) {
        return CLAST_OK;
    }
    clast_mesh_bounds(input->container_closed, low, high);
    while (i < mesh->n_tri && !lies_in_floor(mesh, i, high[2])) {
        ++i;
    }
    if (i < mesh->n_tri) {
        CLX_TRY(check_wall(config, input));
        CLX_TRY(check_contacts(&config->contacts));
    }
done:
    return status;
}

clast_status clx_pack_contain(clast_pack *p)
{
    clast_status status = CLAST_OK;
    clast_dem_config *d = &p->config.dem;
    const clast_mesh *mesh = p->input.container_closed;
    clast_mesh walls = {0};
    double low[3];
    double high[3];
    p->height = d->height;
    if (mesh == NULL) {
        return clast_dem_create(d, &p->dem);
    }
    clast_mesh_bounds(mesh, low, high);
    CLX_CHECK(!d->floor || low[2] >= -1e-9 * (high[2] - low[2]), CLAST_E_CONFIG,
              "the container reaches down to z = %s, below the floor at z = 0: move it, or give "
              "--no-floor",
              clx_unit_text(low[2], "m"));
    CLX_CHECK(!d->lid, CLAST_E_CONFIG, "a container has its own lid, or none: leave out lid");
    p->base = d->floor ? 0.0 : low[2];
    p->height = high[2] - p->base;
    d->domain = CLAST_DEM_OPEN;
    d->width = high[0] - low[0];
    d->depth = high[1] - low[1];
    d->height = p->height;
    for (int k = 0; k < 2; ++k) {
        p->middle[k] = 0.5 * (low[k] + high[k]);
    }
    p->is_held = mesh->n_tri == p->input.container->n_tri;
    CLX_TRY(clast_dem_create(d, &p->dem));
    CLX_TRY(walls_of(p->input.container, d->floor, p->height, &walls));
    CLX_TRY(clast_dem_add_container(p->dem, &walls));
    CLX_TRY(clast_bvh_create(mesh, &p->inside));
done:
    clast_mesh_free(&walls);
    return status;
}

bool clx_pack_holds(const clast_pack *p, const double x[3], double radius)
{
    CLAST_ASSERT(radius >= 0.0);
    return p->inside == NULL || (clast_bvh_inside(p->inside, x) &&
                                 clast_bvh_closest(p->inside, x, radius, NULL, NULL) >= radius);
}

int32_t clx_pack_n_outside(const clast_pack *p, int32_t *first)
{
    int32_t n = 0;
    *first = -1;
    for (int32_t i = 0; p->inside != NULL && i < clast_dem_n_grain(p->dem); ++i) {
        clast_dem_grain g;
        clast_dem_read_grain(p->dem, i, &g);
        if (!clast_bvh_inside(p->inside, g.position)) {
            *first = *first < 0 ? i : *first;
            ++n;
        }
    }
    return n;
}
