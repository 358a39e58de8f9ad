// Builds the tree of clx_fill_field: nodes of eight boxes, leaves of up to eight triangles.
//
// Top down by the surface-area heuristic over bins, with a side's cost counted in leaves that it
// fills, so that leaves come out full. Boxes are floats in a frame scaled to the surface, one
// vector each: for a scan of 33,000 triangles a quarter of the instructions of geom/tree.c, which
// keeps doubles and ends in leaves of two.                       [MacDonald1990, Wald2007]
#include "shape/fill_field.h"

#include "base/alloc.h"
#include <string.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

enum { LANES = CLX_FILL_LANES, BINS = 16, FEW_BINS = 8, FEW = 64, HEURISTIC_DEPTH = 32 };

// Where an unused slot's corner stands, in the frame: far from everything, but finite when squared.
static const float NOWHERE = 1e18F;

// A triangle whose sine of an angle is below this is a sliver: floats may miss its inside.
static const double SLIVER = 3e-3;

/// Box of one triangle, in the frame; the fourth number of `low` holds the triangle's number.
typedef struct {
    clx_float4 low, high;
} item;

typedef struct {
    clx_float4 low, high;
    int32_t count;
} bin;

/// A range of items.
typedef struct {
    item *items;
    int32_t first, n;
    clx_float4 low, high;               ///< hull of the boxes
    clx_float4 middle_low, middle_high; ///< hull of their doubled middles
} part;

typedef struct {
    int axis; ///< -1: none found
    int32_t bin;
    float cost;
} choice;

typedef struct {
    int32_t n;
    clx_float4 origin, per_length;
    bin bins[3][BINS];
} bin_grid;

static inline clx_float4 least4(clx_float4 a, clx_float4 b)
{
#ifdef __SSE2__
    return (clx_float4)_mm_min_ps((__m128)a, (__m128)b);
#else
    const clx_int4 m = a < b;
    return (clx_float4)((m & (clx_int4)a) | (~m & (clx_int4)b));
#endif
}

static inline clx_float4 most4(clx_float4 a, clx_float4 b)
{
#ifdef __SSE2__
    return (clx_float4)_mm_max_ps((__m128)a, (__m128)b);
#else
    const clx_int4 m = a > b;
    return (clx_float4)((m & (clx_int4)a) | (~m & (clx_int4)b));
#endif
}

static clx_float4 all4(float x)
{
    return (clx_float4){x, x, x, x};
}

static int32_t number_of(const item *x)
{
    int32_t bits;
    const float w = x->low[3];
    memcpy(&bits, &w, sizeof bits);
    return bits & 0x3fffffff;
}

/// The number as a float between 2 and 4: no denormal, which would slow down sums of boxes.
static float name_of(int32_t number)
{
    float w;
    const int32_t bits = number | 0x40000000;
    memcpy(&w, &bits, sizeof w);
    return w;
}

static void measure_part(part *p)
{
    clx_float4 low = all4(INFINITY);
    clx_float4 high = all4(-INFINITY);
    clx_float4 middle_low = low;
    clx_float4 middle_high = high;
    for (int32_t i = p->first; i < p->first + p->n; ++i) {
        const item *x = &p->items[i];
        const clx_float4 middle = x->low + x->high;
        low = least4(x->low, low);
        high = most4(x->high, high);
        middle_low = least4(middle, middle_low);
        middle_high = most4(middle, middle_high);
    }
    p->low = low;
    p->high = high;
    p->middle_low = middle_low;
    p->middle_high = middle_high;
}

/// Half the surface of a box times the leaves that its items fill.
static float cost_of(const bin *b)
{
    const int32_t n_leaf = (b->count + LANES - 1) / LANES;
    const clx_float4 d = b->high - b->low;
    return (d[0] * d[1] + d[1] * d[2] + d[2] * d[0]) * (float)n_leaf;
}

static void bin_add(bin *b, clx_float4 low, clx_float4 high, int32_t count)
{
    CLAST_ASSERT(count >= 0);
    b->low = least4(low, b->low);
    b->high = most4(high, b->high);
    b->count += count;
}

static bin empty_bin(void)
{
    return (bin){.low = all4(INFINITY), .high = all4(-INFINITY)};
}

static void fill_bins(const part *p, bin_grid *grid)
{
    const clx_float4 length = p->middle_high - p->middle_low;
    grid->n = p->n < FEW ? FEW_BINS : BINS;
    grid->origin = p->middle_low;
    grid->per_length = all4(0.0F);
    for (int k = 0; k < 3; ++k) {
        const float per_length = (float)grid->n * (1.0F - 1e-5F) / length[k];
        grid->per_length[k] = per_length < 1e30F ? per_length : 0.0F;
        for (int32_t i = 0; i < grid->n; ++i) {
            grid->bins[k][i] = empty_bin();
        }
    }
    for (int32_t i = p->first; i < p->first + p->n; ++i) {
        const item *x = &p->items[i];
        const clx_float4 at = (x->low + x->high - grid->origin) * grid->per_length;
        for (int k = 0; k < 3; ++k) {
            bin_add(&grid->bins[k][(int32_t)at[k]], x->low, x->high, 1);
        }
    }
}

static void best_plane(const bin_grid *grid, int axis, choice *best)
{
    const bin *bins = grid->bins[axis];
    float right_cost[BINS];
    bin side = empty_bin();
    for (int32_t i = grid->n - 1; i > 0; --i) {
        bin_add(&side, bins[i].low, bins[i].high, bins[i].count);
        right_cost[i] = side.count > 0 ? cost_of(&side) : INFINITY;
    }
    side = empty_bin();
    for (int32_t i = 0; i < grid->n - 1; ++i) {
        bin_add(&side, bins[i].low, bins[i].high, bins[i].count);
        const float cost = side.count > 0 ? cost_of(&side) + right_cost[i + 1] : INFINITY;
        if (cost < best->cost) {
            *best = (choice){axis, i, cost};
        }
    }
}

/// Parts a range in place; how many items went left.
static int32_t sort_sides(const part *p, const bin_grid *grid, const choice *best)
{
    const int k = best->axis;
    const float origin = grid->origin[k];
    const float per_length = grid->per_length[k];
    item *x = p->items + p->first;
    int32_t i = 0;
    int32_t j = p->n;
    while (i < j) {
        const float at = (x[i].low[k] + x[i].high[k] - origin) * per_length;
        if ((int32_t)at <= best->bin) {
            ++i;
        } else {
            const item swap = x[--j];
            x[j] = x[i];
            x[i] = swap;
        }
    }
    return i;
}

/// Divides a part: by the heuristic, or in halves where it finds no plane or the tree gets deep.
static void divide(part *p, int depth, part *rest)
{
    CLAST_ASSERT(p->n > LANES && depth >= 0);
    choice best = {-1, 0, INFINITY};
    int32_t n_left = p->n / 2;
    if (depth < HEURISTIC_DEPTH) {
        bin_grid grid;
        fill_bins(p, &grid);
        for (int k = 0; k < 3; ++k) {
            best_plane(&grid, k, &best);
        }
        n_left = best.axis >= 0 ? sort_sides(p, &grid, &best) : n_left;
    }
    *rest = (part){.items = p->items, .first = p->first + n_left, .n = p->n - n_left};
    p->n = n_left;
    measure_part(p);
    measure_part(rest);
}

/// What floats may be wrong by at a triangle, in units of the surface.
static double float_error(double tri[3][3], double size)
{
    double normal[3];
    v3_cross(normal, tri[1], tri[2]);
    const double sine2 = v3_norm2(normal);
    const double full2 = v3_norm2(tri[1]) * v3_norm2(tri[2]);
    return sine2 < SLIVER * SLIVER * full2 ? fmin(size, sqrt(sine2) / (size + 1e-300)) : 0.0;
}

/// Radius of the sphere about the centroid, or about the middle of an edge when that is smaller:
/// within 16 % of the least one.
static double bounding_radius(double tri[3][3])
{
    double bc[3];
    double far[3];
    v3_sub(bc, tri[2], tri[1]);
    const double bb = v3_norm2(tri[1]);
    const double cc = v3_norm2(tri[2]);
    const double aa = v3_norm2(bc);
    // medians by Apollonius: the centroid is two thirds of one away from its corner
    const double median[3] = {0.5 * (bb + cc) - 0.25 * aa, 0.5 * (aa + bb) - 0.25 * cc,
                              0.5 * (aa + cc) - 0.25 * bb};
    const double edge[3] = {aa, cc, bb}; // opposite to the medians' corners
    double about_centroid = 0.0;
    double about_edge = INFINITY;
    for (int k = 0; k < 3; ++k) {
        far[k] = median[k] > 0.25 * edge[k] ? median[k] : 0.25 * edge[k];
        about_centroid = median[k] > about_centroid ? median[k] : about_centroid;
        about_edge = far[k] < about_edge ? far[k] : about_edge;
    }
    about_centroid *= 4.0 / 9.0;
    return sqrt(about_edge < about_centroid ? about_edge : about_centroid) * (1.0 + 1e-12);
}

/// Puts a triangle into a slot of a leaf and into the lists in leaf order.
static void add_triangle(clx_fill_field *field, clx_fill_leaf *leaf, int slot, int32_t number)
{
    CLAST_ASSERT(slot >= 0 && slot < LANES);
    const clast_mesh *mesh = field->mesh;
    const int32_t at = leaf->first + slot;
    const double *a = mesh->vert[mesh->tri[number][0]];
    double(*tri)[3] = field->tri[at];
    field->item[at] = number;
    v3_copy(tri[0], a);
    v3_sub(tri[1], mesh->vert[mesh->tri[number][1]], a);
    v3_sub(tri[2], mesh->vert[mesh->tri[number][2]], a);
    field->size[at] = bounding_radius(tri);
    field->error = fmax(field->error, float_error(tri, field->size[at]));
    for (int k = 0; k < 3; ++k) {
        leaf->a[k][slot] = (float)((tri[0][k] - field->middle[k]) * field->scale);
        leaf->ab[k][slot] = (float)(tri[1][k] * field->scale);
        leaf->ac[k][slot] = (float)(tri[2][k] * field->scale);
    }
}

static clast_status add_leaf(const part *p, clx_fill_field *field, int32_t *child)
{
    CLAST_ASSERT(p->n >= 1 && p->n <= LANES);
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&field->leaf, &field->leaf_capacity, field->n_leaf + 1, sizeof *field->leaf));
    clx_fill_leaf *leaf = &field->leaf[field->n_leaf];
    *leaf = (clx_fill_leaf){.first = p->first, .count = p->n};
    for (int i = 0; i < LANES; ++i) {
        leaf->a[0][i] = NOWHERE;
    }
    for (int32_t i = 0; i < p->n; ++i) {
        add_triangle(field, leaf, i, number_of(&p->items[p->first + i]));
    }
    *child = (int32_t)(-1 - field->n_leaf++);
done:
    return status;
}

static void set_box(const part *p, clx_fill_node *node, int slot)
{
    CLAST_ASSERT(slot >= 0 && slot < LANES);
    for (int k = 0; k < 3; ++k) {
        node->middle[k][slot] = 0.5F * (p->low[k] + p->high[k]);
        node->half[k][slot] = 0.5F * (p->high[k] - p->low[k]);
    }
}

/// Makes the node of a part, and all below it.
static clast_status make_node(const part *whole, int depth, clx_fill_field *field, int32_t *number)
{
    CLAST_ASSERT(depth >= 0 && depth <= CLX_FILL_DEPTH && whole->n > 0);
    clast_status status = CLAST_OK;
    part p[LANES] = {*whole};
    int n = 1;
    while (n < LANES) {
        int largest = 0;
        for (int i = 1; i < n; ++i) {
            largest = p[i].n > p[largest].n ? i : largest;
        }
        if (p[largest].n <= LANES) {
            break;
        }
        divide(&p[largest], depth, &p[n++]);
    }
    CLX_TRY(clx_grow(&field->node, &field->node_capacity, field->n_node + 1, sizeof *field->node));
    const int64_t self = field->n_node++;
    clx_fill_node made = {0};
    for (int i = 0; i < LANES; ++i) {
        made.middle[0][i] = INFINITY;
        if (i < n) {
            set_box(&p[i], &made, i);
            if (p[i].n <= LANES) {
                CLX_TRY(add_leaf(&p[i], field, &made.child[i]));
            } else {
                CLX_TRY(make_node(&p[i], depth + 1, field, &made.child[i]));
            }
        }
    }
    field->node[self] = made;
    *number = (int32_t)self;
done:
    return status;
}

static clast_status set_frame(const clast_mesh *mesh, clx_fill_field *field)
{
    clast_status status = CLAST_OK;
    double low[3];
    double high[3];
    double size = 0.0;
    for (int64_t i = 0; i < 3 * (int64_t)mesh->n_tri; ++i) {
        const int32_t v = mesh->tri[i / 3][i % 3];
        for (int k = 0; k < 3; ++k) {
            CLX_CHECK(fabs(mesh->vert[v][k]) <= 1e100, CLAST_E_GEOMETRY,
                      "vertex %d has coordinate %g; it must be finite and below 1e100", v,
                      mesh->vert[v][k]);
        }
    }
    clast_mesh_bounds(mesh, low, high);
    for (int k = 0; k < 3; ++k) {
        field->middle[k] = 0.5 * low[k] + 0.5 * high[k];
        size = fmax(size, high[k] - low[k]);
    }
    CLX_CHECK(size > 0.0 && isfinite(1.0 / size), CLAST_E_GEOMETRY, "the surface has no size");
    field->scale = 1.0 / size;
    field->error = CLX_FILL_FRAME_ERROR * size;
done:
    return status;
}

/// Two corners in one place: an edge of other triangles, if it bounds anything.
static bool is_edge(const clast_mesh *mesh, int32_t t)
{
    for (int i = 0; i < 3; ++i) {
        const double *a = mesh->vert[mesh->tri[t][i]];
        const double *b = mesh->vert[mesh->tri[t][(i + 1) % 3]];
        if (v3_distance2(a, b) <= 0.0) {
            return true;
        }
    }
    return false;
}

/// Boxes of the triangles in the frame; rounding is covered by CLX_FILL_FRAME_ERROR.
///
/// @return their number
static int32_t make_items(const clx_fill_field *field, item *items)
{
    const clast_mesh *mesh = field->mesh;
    int32_t n = 0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        if (is_edge(mesh, t)) {
            continue;
        }
        clx_float4 low = all4(INFINITY);
        clx_float4 high = all4(-INFINITY);
        for (int i = 0; i < 3; ++i) {
            const double *v = mesh->vert[mesh->tri[t][i]];
            const clx_float4 f = {(float)((v[0] - field->middle[0]) * field->scale),
                                  (float)((v[1] - field->middle[1]) * field->scale),
                                  (float)((v[2] - field->middle[2]) * field->scale), 0.0F};
            low = least4(f, low);
            high = most4(f, high);
        }
        low[3] = name_of(t);
        items[n++] = (item){low, high};
    }
    return n;
}

clast_status clx_fill_field_create(const clast_mesh *mesh, clx_fill_field *field)
{
    clast_status status = CLAST_OK;
    clx_fill_field made = {.mesh = mesh};
    int32_t n = mesh->n_tri;
    item *items = NULL;
    int32_t root = 0;
    CLX_CHECK(n >= 1 && n < 0x3f000000, CLAST_E_LIMIT, "a surface of %d triangles", n);
    CLX_TRY(set_frame(mesh, &made));
    CLX_TRY(clx_alloc(&items, n, sizeof *items));
    CLX_TRY(clx_alloc(&made.item, n, sizeof *made.item));
    CLX_TRY(clx_alloc(&made.tri, n, sizeof *made.tri));
    CLX_TRY(clx_alloc(&made.size, n, sizeof *made.size));
    CLX_TRY(clx_grow(&made.leaf, &made.leaf_capacity, n / 4 + 1, sizeof *made.leaf));
    n = make_items(&made, items);
    CLX_CHECK(n > 0, CLAST_E_GEOMETRY, "the surface has no size");
    part whole = {.items = items, .n = n};
    measure_part(&whole);
    CLX_TRY(make_node(&whole, 0, &made, &root));
    *field = made;
    made = (clx_fill_field){0};
done:
    clx_free(items);
    clx_fill_field_free(&made);
    return status;
}

void clx_fill_field_free(clx_fill_field *field)
{
    CLX_FREE(field->node, field->leaf, field->item, field->tri, field->size);
    *field = (clx_fill_field){0};
}
