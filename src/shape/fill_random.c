// Fillings by random points: the published method of SCARLET-1.0, and the same with the distance to
// the surface instead of its vertices.
//
// A point is drawn uniformly in the box of the surface until it is inside and in no sphere; its
// radius is the distance to the nearest wall point or sphere; the largest of some candidates is
// placed. [Rossi and Bonadonna, SCARLET-1.0, sec. 2.2.1; fromStlToSpheres of the release]
// The text names all vertices as wall points. The released code takes a random third of the
// triangles' corners, for the box and the mean too, and one candidate more for the first random
// sphere after one at the centre: option vertex_subset.
#include "shape/fill.h"

#include "base/alloc.h"
#include "geom/tree.h"
#include "math/rng.h"

/// Draws of the corners' subset stand in their own range of indices, far from those of the points.
static const uint64_t SUBSET_DRAWS = (uint64_t)1 << 62;

/// Wall points of the published method, in a tree.
typedef struct {
    int32_t n;
    double (*point)[3]; ///< [n]
    clx_tree tree;
} walls;

typedef struct {
    walls wall; ///< published only
    double low[3], high[3];
    double mean[3];  ///< of the corners
    uint64_t n_draw; ///< points drawn so far: the index of the next
    bool published;
} work;

static void destroy(void *state)
{
    work *w = state;
    if (w != NULL) {
        clx_free(w->wall.point);
        clx_tree_free(&w->wall.tree);
        clx_free(w);
    }
}

/// Takes n_tri of the 3 n_tri corners without replacement (Fisher-Yates).
static clast_status subset_corners(const clast_mesh *mesh, uint64_t seed, walls *wall)
{
    clast_status status = CLAST_OK;
    int64_t *corner = NULL;
    const int64_t n = 3 * (int64_t)mesh->n_tri;
    CLX_TRY(clx_alloc(&corner, n, sizeof *corner));
    for (int64_t i = 0; i < n; ++i) {
        corner[i] = i;
    }
    for (int64_t i = 0; i < mesh->n_tri; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_FILL, SUBSET_DRAWS + (uint64_t)i);
        const int64_t j = i + clx_rng_below(&rng, n - i);
        const int64_t taken = corner[j];
        corner[j] = corner[i];
        v3_copy(wall->point[i], mesh->vert[mesh->tri[taken / 3][taken % 3]]);
    }
    wall->n = mesh->n_tri;
done:
    clx_free(corner);
    return status;
}

static clast_status make_wall(const clx_fill *fill, walls *wall)
{
    clast_status status = CLAST_OK;
    clx_tree_box *box = NULL;
    const clast_mesh *mesh = fill->surface;
    CLX_TRY(clx_alloc(&wall->point, 3 * (int64_t)mesh->n_tri, sizeof *wall->point));
    if (fill->config->vertex_subset) {
        CLX_TRY(subset_corners(mesh, fill->config->seed, wall));
    } else {
        for (int32_t t = 0; t < mesh->n_tri; ++t) {
            for (int k = 0; k < 3; ++k) {
                v3_copy(wall->point[wall->n++], mesh->vert[mesh->tri[t][k]]);
            }
        }
    }
    CLX_TRY(clx_alloc(&box, wall->n, sizeof *box));
    for (int32_t i = 0; i < wall->n; ++i) {
        v3_copy(box[i].low, wall->point[i]);
        v3_copy(box[i].high, wall->point[i]);
        box[i].item = i;
    }
    CLX_TRY(clx_tree_build(box, wall->n, 4, &wall->tree));
done:
    clx_free(box);
    return status;
}

static double box_distance2(const clx_tree_node *node, const double point[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double out = fmax(0.0, fmax(node->low[k] - point[k], point[k] - node->high[k]));
        sum += out * out;
    }
    return sum;
}

/// Distance to the nearest wall point, or `limit` if none is nearer.
static double wall_distance(const walls *wall, const double point[3], double limit)
{
    CLAST_ASSERT(limit >= 0.0);
    int32_t stack[CLX_TREE_DEPTH + 1];
    int n = 1;
    double best = limit * limit;
    stack[0] = 0;
    while (n > 0) {
        const int32_t at = stack[--n];
        const clx_tree_node *node = &wall->tree.node[at];
        if (box_distance2(node, point) >= best) {
            continue;
        }
        if (node->right == 0) {
            for (int32_t i = node->first; i < node->first + node->count; ++i) {
                best = fmin(best, v3_distance2(point, wall->point[wall->tree.item[i]]));
            }
            continue;
        }
        const bool left_first =
            box_distance2(node + 1, point) < box_distance2(&wall->tree.node[node->right], point);
        stack[n++] = left_first ? node->right : at + 1;
        stack[n++] = left_first ? at + 1 : node->right;
    }
    return fmin(limit, sqrt(best));
}

/// Box and mean of the points that the method knows.
static void frame(const clx_fill *fill, work *w)
{
    const clast_mesh *mesh = fill->surface;
    const int64_t n = w->published ? w->wall.n : 3 * (int64_t)mesh->n_tri;
    v3_set(w->low, INFINITY, INFINITY, INFINITY);
    v3_set(w->high, -INFINITY, -INFINITY, -INFINITY);
    for (int64_t i = 0; i < n; ++i) {
        const double *p = w->published ? w->wall.point[i] : mesh->vert[mesh->tri[i / 3][i % 3]];
        for (int k = 0; k < 3; ++k) {
            w->low[k] = fmin(w->low[k], p[k]);
            w->high[k] = fmax(w->high[k], p[k]);
            w->mean[k] += (p[k] - fill->low[k]) / (double)n;
        }
    }
    v3_add(w->mean, w->mean, fill->low);
}

static clast_status create(clx_fill *fill, void **state)
{
    clast_status status = CLAST_OK;
    work *w = NULL;
    CLX_TRY(clx_alloc(&w, 1, sizeof *w));
    w->published = fill->config->strategy == CLAST_FILL_PUBLISHED;
    if (w->published) {
        CLX_TRY(make_wall(fill, &w->wall));
    }
    frame(fill, w);
    *state = w;
    w = NULL;
done:
    destroy(w);
    return status;
}

/// Radius of the sphere about a point that is in no sphere.
static double radius_at(clx_fill *fill, const work *w, const double point[3], double limit)
{
    double closest[3];
    if (w->published) {
        return wall_distance(&w->wall, point, limit);
    }
    return fmin(limit, clx_fill_field_closest(&fill->field, point, limit, closest));
}

/// Next random point that is inside the surface and in no sphere, with its radius.
static clast_status candidate(clx_fill *fill, work *w, double ball[4], bool *found)
{
    clast_status status = CLAST_OK;
    *found = false;
    for (int64_t i = 0; i < fill->config->max_tries; ++i) {
        clx_rng rng = clx_rng_at(fill->config->seed, CLX_STREAM_FILL, w->n_draw++);
        int32_t nearest = -1;
        ++fill->n_tested;
        if (i % 4096 == 4095) {
            CLX_TRY(clx_fill_poll(fill));
        }
        for (int k = 0; k < 3; ++k) {
            ball[k] = w->low[k] + (w->high[k] - w->low[k]) * clx_rng_uniform(&rng);
        }
        const double limit = clx_ball_set_distance(&fill->balls, 0, ball, INFINITY, &nearest);
        if (limit <= 0.0 || !clx_fill_field_inside(&fill->field, ball)) {
            continue;
        }
        ball[3] = radius_at(fill, w, ball, limit);
        if (ball[3] >= fill->floor) {
            *found = true;
            break;
        }
    }
done:
    return status;
}

/// Candidates to choose the next sphere from.
static int32_t n_candidate(const clx_fill *fill)
{
    const clast_fill_config *c = fill->config;
    if (fill->balls.n == 0) {
        return 1; // the first random sphere is taken as it comes
    }
    return c->candidates + (fill->balls.n == 1 && c->first_at_centre && c->vertex_subset ? 1 : 0);
}

static clast_status next(clx_fill *fill, void *state, double ball[4], bool *found)
{
    clast_status status = CLAST_OK;
    work *w = state;
    *found = false;
    if (fill->balls.n == 0 && fill->config->first_at_centre &&
        (w->published || clx_fill_field_inside(&fill->field, w->mean))) {
        v3_copy(ball, w->mean);
        ball[3] = radius_at(fill, w, ball, INFINITY);
        *found = ball[3] >= fill->floor;
        if (*found) {
            goto done;
        }
    }
    ball[3] = 0.0;
    for (int32_t i = 0; i < n_candidate(fill); ++i) {
        double trial[4];
        bool free_point = false;
        CLX_TRY(candidate(fill, w, trial, &free_point));
        CLX_CHECK(free_point || fill->config->min_radius > 0.0, CLAST_E_CONVERGE,
                  "no free point among %lld after %d spheres; ask for fewer --spheres or raise "
                  "--max-tries",
                  (long long)fill->config->max_tries, fill->balls.n);
        if (!free_point) {
            break; // no room for a sphere of min_radius was met: the filling ends here
        }
        if (trial[3] > ball[3]) {
            v3_copy(ball, trial);
            ball[3] = trial[3];
        }
    }
    *found = ball[3] > 0.0;
done:
    return status;
}

const clx_fill_strategy clx_fill_random = {create, next, destroy};
