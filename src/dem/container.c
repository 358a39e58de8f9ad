// Grains in a container of triangles.
#include "dem/container.h"

#include "base/alloc.h"
#include "base/status.h"
#include "dem/dem.h"
#include "dem/pair_force.h"
#include "geom/whole.h"
#include <string.h>

/// Contacts whose normals are closer than this cosine are one (25 degrees, as in
/// convex/wall_mesh.c).
static const double SAME_NORMAL = 0.9;

void clx_container_destroy(clx_container *container)
{
    if (container != NULL) {
        CLX_FREE(container->tri, container->owner, container);
    }
}

/// Takes a surface over as the last wall: its triangles follow those that are there.
static clast_status append(clast_dem *dem, clx_wall_mesh **mesh)
{
    clast_status status = CLAST_OK;
    clx_walls *walls = &dem->walls;
    clx_container *all = dem->container;
    const int64_t n = (int64_t)all->n_tri + (*mesh)->n_tri;
    CLX_CHECK(n < INT32_MAX - dem->n_wall - 1, CLAST_E_LIMIT, "walls of %lld triangles",
              (long long)n);
    CLX_TRY(clx_realloc(&all->tri, n, sizeof *all->tri));
    CLX_TRY(clx_realloc(&all->owner, n, sizeof *all->owner));
    CLX_TRY(clx_realloc(&walls->body, walls->n + 1, sizeof *walls->body));
    clx_wall_body *body = &walls->body[walls->n];
    *body = (clx_wall_body){.mesh = *mesh, .first = all->n_tri};
    for (int k = 0; k < 3; ++k) {
        body->rotation[k][k] = 1.0;
    }
    for (int32_t i = all->n_tri; i < n; ++i) {
        all->tri[i] = body->mesh->tri[i - body->first];
        all->owner[i] = walls->n - dem->n_wall;
    }
    all->n_tri = (int32_t)n;
    ++walls->n;
    *mesh = NULL;
done:
    return status;
}

clast_status clast_dem_add_wall(clast_dem *dem, const clast_mesh *mesh, int32_t *wall)
{
    CLX_ARGUMENTS(dem, mesh, wall);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clx_wall_mesh *made = NULL;
    CLX_CHECK(dem->n_grain == 0, CLAST_E_USAGE, "walls are added before the first grain");
    CLX_CHECK(dem->cell == NULL, CLAST_E_CONFIG, "domain cell has no walls");
    CLX_TRY(clx_walls_begin(dem));
    CLX_TRY(clx_wall_mesh_create(mesh, &made));
    if (dem->container == NULL) {
        CLX_TRY(clx_alloc(&dem->container, 1, sizeof *dem->container));
    }
    CLX_TRY(append(dem, &made));
    *wall = dem->walls.n - 1;
done:
    clx_wall_mesh_destroy(made);
    return status;
}

clast_status clast_dem_add_container(clast_dem *dem, const clast_mesh *mesh)
{
    CLX_ARGUMENTS(dem, mesh);
    int32_t wall = 0;
    return dem->container != NULL || dem->n_grain > 0
               ? clx_fail(CLAST_E_USAGE, "a container is given once, before the first grain")
               : clast_dem_add_wall(dem, mesh, &wall);
}

static clx_placed place(const clast_dem *dem, int32_t i, clx_convex *ball)
{
    CLAST_ASSERT(i >= 0 && i < dem->n_item);
    clx_placed body = {.rotation = clx_item_rotation(dem, i)};
    if (dem->convex != NULL) {
        body.shape = &dem->convex[i];
    } else {
        *ball = clx_convex_sphere(clx_item_radius(dem, i));
        body.shape = ball;
    }
    v3_copy(body.position, clx_item_position(dem, i));
    return body;
}

static void touch_from_contact(const clx_contact *c, clx_dem_touch *t)
{
    static const double nowhere[3] = {0.0, 0.0, 0.0};
    clx_touch_from_contact(c, nowhere, t);
    v3_set(t->arm_b, 0.0, 0.0, 0.0);
}

void clx_container_touch_again(const clast_dem *dem, const clx_dem_pair *pair,
                               clx_warm_start *warm_start, clx_dem_touch *touch)
{
    CLAST_ASSERT(clx_pair_is_container(dem, pair));
    clx_convex ball;
    clx_contact contact;
    const clx_placed body = place(dem, pair->a, &ball);
    const clx_wall_triangle *t = clx_pair_triangle(dem, pair);
    if (clx_triangle_contact(t, &body, 0.0, warm_start, &contact)) {
        if (pair->touches != 0 && !clx_triangle_owns(t, &body, &contact)) { // it was found to push
            clx_triangle_face_contact(t, &body, &contact);
        }
        touch_from_contact(&contact, touch);
    } else {
        touch->distance = contact.gap;
    }
}

/// Contacts of one item before those that repeat a deeper one are dropped.
typedef struct {
    clx_contact contact[CLX_CONTAINER_TOUCHES]; ///< deepest first
    int64_t pair[CLX_CONTAINER_TOUCHES];
    int32_t n;
    double normal[CLX_CONTAINER_TOUCHES][3]; ///< of pairs that touched before
    double slide[CLX_CONTAINER_TOUCHES][3];
    clx_contact_history history[CLX_CONTAINER_TOUCHES];
    int64_t old[CLX_CONTAINER_TOUCHES];
    int32_t n_old;
} candidates;

/// Inserts a contact in order of depth; none stays whose normal is that of a deeper one.
static void insert(candidates *p, const clx_contact *c, int64_t pair)
{
    CLAST_ASSERT(p->n >= 0 && p->n <= CLX_CONTAINER_TOUCHES);
    int32_t at = 0;
    while (at < p->n && p->contact[at].gap <= c->gap) {
        if (v3_dot(p->contact[at].normal, c->normal) > SAME_NORMAL) {
            return;
        }
        ++at;
    }
    int32_t kept = at;
    for (int32_t i = at; i < p->n; ++i) {
        if (v3_dot(p->contact[i].normal, c->normal) <= SAME_NORMAL) {
            p->contact[kept] = p->contact[i];
            p->pair[kept++] = p->pair[i];
        }
    }
    if (at >= CLX_CONTAINER_TOUCHES) {
        return;
    }
    p->n = kept < CLX_CONTAINER_TOUCHES ? kept + 1 : CLX_CONTAINER_TOUCHES;
    for (int32_t i = p->n - 1; i > at; --i) {
        p->contact[i] = p->contact[i - 1];
        p->pair[i] = p->pair[i - 1];
    }
    p->contact[at] = *c;
    p->pair[at] = pair;
}

/// History of a pair that touched a step ago, for the triangle whose force has this direction now.
static void remember(candidates *p, clx_dem_pair *pair, clx_contact_history *history,
                     const double normal[3], bool is_near, int64_t k)
{
    if (pair->touches != 0 && is_near && p->n_old < CLX_CONTAINER_TOUCHES) {
        v3_copy(p->normal[p->n_old], normal);
        v3_copy(p->slide[p->n_old], pair->slide);
        p->history[p->n_old] = history != NULL ? *history : (clx_contact_history){0};
        p->old[p->n_old++] = k;
    }
    pair->touches = 0;
    v3_set(pair->slide, 0.0, 0.0, 0.0);
    if (history != NULL) {
        *history = (clx_contact_history){0};
    }
}

static void inherit(const candidates *p, const clx_contact *c, int64_t k, double slide[3],
                    clx_contact_history *history)
{
    double best = SAME_NORMAL;
    int32_t from = -1;
    for (int32_t i = 0; i < p->n_old; ++i) {
        const double alike = p->old[i] == k ? 2.0 : v3_dot(p->normal[i], c->normal);
        if (alike > best) {
            best = alike;
            from = i;
        }
    }
    if (from >= 0) {
        v3_copy(slide, p->slide[from]);
    }
    if (from >= 0 && history != NULL) {
        *history = p->history[from];
    }
}

/// Pushes of triangles that own no least move, beside those that do.
static void add_faces(const clast_dem *dem, int32_t i, const clx_placed *body, candidates *p)
{
    clx_contact owner[CLX_CONTAINER_TOUCHES];
    const int32_t n_owner = p->n;
    memcpy(owner, p->contact, sizeof owner);
    for (int64_t k = dem->list.begin[i]; k < dem->list.begin[i + 1]; ++k) {
        const clx_dem_pair *pair = &dem->list.pair[k];
        clx_contact least;
        clx_contact face;
        if (!clx_pair_is_container(dem, pair)) {
            break;
        }
        const clx_wall_triangle *t = clx_pair_triangle(dem, pair);
        const clx_warm_start *known = clx_pair_warm_start(dem, pair);
        clx_warm_start start = known != NULL ? *known : (clx_warm_start){0};
        if (clx_triangle_contact(t, body, 0.0, known != NULL ? &start : NULL, &least) &&
            least.gap < 0.0 && !clx_triangle_owns(t, body, &least) &&
            clx_triangle_face_acts(t, body, &least, n_owner, owner, &face)) {
            insert(p, &face, k);
        }
    }
}

int32_t clx_container_meet(clast_dem *dem, int32_t i,
                           clx_container_touch touch[CLX_CONTAINER_TOUCHES])
{
    candidates p = {.n = 0};
    clx_convex ball;
    const clx_placed body = place(dem, i, &ball);
    const double travel = dem->travel[clx_item_grain(dem, i)] + dem->walls.path;
    const double near = 0.1 * clx_item_radius(dem, i);
    bool has_orphans = false;
    for (int64_t k = dem->list.begin[i]; k < dem->list.begin[i + 1]; ++k) {
        clx_dem_pair *pair = &dem->list.pair[k];
        clx_contact c;
        if (!clx_pair_is_container(dem, pair)) {
            break;
        }
        if (travel < pair->active_from) {
            continue;
        }
        const clx_wall_triangle *t = clx_pair_triangle(dem, pair);
        const bool is_near =
            clx_triangle_contact(t, &body, near, clx_pair_warm_start(dem, pair), &c);
        const bool matters = is_near && (c.gap < 0.0 || pair->touches != 0);
        const bool is_orphan = matters && !clx_triangle_owns(t, &body, &c);
        clx_contact felt = c;
        if (is_orphan && pair->touches != 0) { // its face acted
            clx_triangle_face_contact(t, &body, &felt);
        }
        remember(&p, pair, clx_pair_history(dem, pair), felt.normal, is_near, k);
        pair->active_from = travel + fmax(c.gap, 0.0);
        if (is_near && c.gap < 0.0 && !is_orphan) {
            insert(&p, &c, k);
        }
        has_orphans = has_orphans || (is_orphan && c.gap < 0.0);
    }
    if (has_orphans && body.shape->kind != CLX_CONVEX_SPHERE) {
        add_faces(dem, i, &body, &p);
    }
    for (int32_t m = 0; m < p.n; ++m) {
        clx_dem_pair *pair = &dem->list.pair[p.pair[m]];
        pair->touches = 1;
        inherit(&p, &p.contact[m], p.pair[m], pair->slide, clx_pair_history(dem, pair));
        touch[m] = (clx_container_touch){.pair = p.pair[m]};
        touch_from_contact(&p.contact[m], &touch[m].touch);
        if (dem->item != NULL) {
            clx_touch_lever(dem, pair, &touch[m].touch);
        }
    }
    return p.n;
}

clast_status clx_container_find(clast_dem *dem, int32_t i)
{
    CLAST_ASSERT(dem->container != NULL && dem->list.is_stale[i] != 0);
    clast_status status = CLAST_OK;
    clx_neighbour_list *l = &dem->list;
    const double cutoff = clx_item_radius(dem, i) + l->anchor[i].margin + dem->walls.margin;
    for (int32_t w = dem->n_wall; w < dem->walls.n; ++w) {
        const clx_wall_body *wall = &dem->walls.body[w];
        double x[3];
        double arm[3];
        v3_copy(x, l->anchor[i].position);
        if (wall->runs || wall->clock > 0 || v3_norm2(wall->offset) > 0.0 || wall->motion.n > 0) {
            double rotation[3][3];
            memcpy(rotation, wall->rotation, sizeof rotation);
            v3_sub(arm, x, wall->pivot);
            m3_to_local(x, rotation, arm);
            v3_add(x, x, wall->motion.pivot);
        }
        const int32_t n = wall->is_open ? 0 : clx_wall_mesh_near(wall->mesh, x, cutoff, 0, NULL);
        CLX_TRY(clx_grow(&l->triangle, &l->triangle_capacity, n, sizeof *l->triangle));
        (void)clx_wall_mesh_near(wall->mesh, x, cutoff, n, l->triangle);
        CLX_TRY(clx_grow(&l->found, &l->found_capacity, l->n_found + n, sizeof *l->found));
        for (int32_t k = 0; k < n; ++k) {
            l->found[l->n_found++] =
                (clx_found){.a = i, .b = -1 - dem->n_wall - wall->first - l->triangle[k]};
        }
    }
done:
    return status;
}
