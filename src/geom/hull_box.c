// Boxes around a convex hull: least volume, and fitted caliper by caliper.
//
// A box of least volume has two neighbouring sides that each hold an edge of the hull
// [ORourke1985]. A search over all pairs costs n^3; here each face is tried as a side (then the
// best box is the least rectangle around the shadow, which has a side along the outline
// [FreemanShapira1975]), a face being skipped when its width times its shadow, a lower bound, is no
// gain; the best few boxes and the principal frame are then turned about one axis at a time to that
// axis' least rectangle [Chang2011, the local step]. For few faces every pair of edges is tried as
// well (hull_box_edges.c). The result is a box that no such turn improves: an upper bound of the
// least volume; docs/theory/form.md has the measured gap.
//
// Few faces have their shadow cast: chords between vertices bound the hull's widths, and so the
// rectangle, from below, within a per cent.
#include "geom/hull_body.h"

#include "base/alloc.h"
#include "base/machine.h"
#include "math/vec3.h"

enum { CANDIDATES = 6, MOST_TURNS = 60, FEW_FACES = 48, MANY_FACES = 128 };
enum { GRID = 12, N_CELL = 3 * GRID * GRID, N_ARC = 16 };

static const double GAIN = 1e-13;

/// For cells of directions, the same of opposite ones, two vertices far apart along the cell's
/// middle: no width is less than the chord's part along it.
typedef struct {
    double chord[N_CELL][3];
    double turn[2 * N_ARC + 1]
               [2]; ///< cosine and sine of the ends and middles of arcs of a half turn
} chord_table;

static double box_volume(const clx_box *box)
{
    return box->edge[0] * box->edge[1] * box->edge[2];
}

/// The cell of a direction on the cube about it.
CLX_INLINE int32_t cell_of(const double d[3])
{
    static const int after[3][2] = {{1, 2}, {2, 0}, {0, 1}};
    int k = fabs(d[1]) > fabs(d[0]);
    k = fabs(d[2]) > fabs(d[k]) ? 2 : k;
    const double scale = 0.5 * GRID / d[k];
    const int32_t i = (int32_t)(0.5 * GRID + scale * d[after[k][0]]);
    const int32_t j = (int32_t)(0.5 * GRID + scale * d[after[k][1]]);
    return (k * GRID + (i < GRID ? i : GRID - 1)) * GRID + (j < GRID ? j : GRID - 1);
}

static void fill_chords(const clx_hull_body *body, chord_table *table)
{
    int32_t high = 0;
    int32_t low = 0;
    for (int32_t c = 0; c < N_CELL; ++c) {
        const int k = c / (GRID * GRID);
        const int row = c / GRID % GRID; // every other one backwards: the next cell is beside this
        const int32_t cell = row % 2 == 0 ? c : c - c % GRID + GRID - 1 - c % GRID;
        double d[3];
        double back[3];
        d[k] = 1.0;
        d[(k + 1) % 3] = (2 * row + 1.0) / GRID - 1.0;
        d[(k + 2) % 3] = (2 * (cell % GRID) + 1.0) / GRID - 1.0;
        v3_scale(back, -1.0, d);
        high = clx_hull_body_support(body, d, high);
        low = clx_hull_body_support(body, back, low);
        v3_sub(table->chord[cell], body->vert[high], body->vert[low]);
    }
    for (int k = 0; k <= 2 * N_ARC; ++k) {
        table->turn[k][0] = cos(0.5 * CLAST_PI * k / N_ARC);
        table->turn[k][1] = sin(0.5 * CLAST_PI * k / N_ARC);
    }
}

/// No rectangle around the shadow in the plane of u and v is less. Within each arc of a half turn
/// both widths are at least those of the chords of its middle: cosines, whose product is least at
/// an end.
static double least_rectangle(const chord_table *table, const double u[3], const double v[3])
{
    double width[N_ARC][2]; // at both ends of an arc
    double least = INFINITY;
    for (int a = 0; a < N_ARC; ++a) {
        const double(*turn)[2] = table->turn + 2 * a;
        double d[3];
        for (int k = 0; k < 3; ++k) {
            d[k] = turn[1][0] * u[k] + turn[1][1] * v[k];
        }
        const double *chord = table->chord[cell_of(d)];
        const double x = v3_dot(chord, u);
        const double y = v3_dot(chord, v);
        width[a][0] = x * turn[0][0] + y * turn[0][1];
        width[a][1] = x * turn[2][0] + y * turn[2][1];
    }
    for (int a = 0; a < N_ARC / 2; ++a) {
        const double *w = width[a];
        const double *across = width[a + N_ARC / 2];
        const bool is_bound = w[0] * w[1] > 0.0 && across[0] * across[1] > 0.0; // no change of sign
        const double one = fabs(w[0] * across[0]);
        const double other = fabs(w[1] * across[1]);
        const double area = is_bound ? (one < other ? one : other) : 0.0;
        least = area < least ? area : least;
    }
    return least;
}

/// The least box with one axis along the unit vector n, if it is not clearly larger than `limit`.
static bool box_along(const clx_hull_body *body, const double n[3], double width, double limit,
                      clx_shadow *shadow, clx_box *box)
{
    double side[2];
    double edge[2];
    clx_shadow_cast(body, n, shadow);
    if (!clx_shadow_rectangle(shadow, 1e-12 * width, limit / width, side, edge)) {
        return false;
    }
    v3_copy(box->axis[0], n);
    for (int k = 0; k < 3; ++k) {
        box->axis[1][k] = side[0] * shadow->u[k] + side[1] * shadow->v[k];
        box->axis[2][k] = side[0] * shadow->v[k] - side[1] * shadow->u[k];
    }
    box->edge[0] = width;
    box->edge[1] = edge[0];
    box->edge[2] = edge[1];
    return true;
}

static void box_in_frame(const clx_hull_body *body, double frame[3][3], clx_box *box)
{
    for (int k = 0; k < 3; ++k) {
        v3_copy(box->axis[k], frame[k]);
        box->edge[k] = clx_hull_body_width(body, frame[k]);
    }
}

/// Turns the box about each axis in turn until none of the three gains. `idle`: 1 where it is the
/// least about its first axis already, else 0.
static void turn_down(const clx_hull_body *body, int idle, clx_shadow *shadow, clx_box *box)
{
    int axis = idle;
    for (int turn = 0; turn < MOST_TURNS && idle < 3; ++turn) {
        clx_box next;
        const double limit = box_volume(box) * (1.0 - GAIN);
        if (box_along(body, box->axis[axis], box->edge[axis], limit, shadow, &next) &&
            box_volume(&next) < limit) {
            *box = next;
            idle = 1; // the axis just used is now axis 0
            axis = 1;
        } else {
            ++idle;
            axis = (axis + 1) % 3;
        }
    }
}

/// Inserts a box among the best few, in rising order; it is below the last when all are taken.
static void insert_box(clx_box candidate[CANDIDATES], int *n_candidate, const clx_box *box)
{
    CLAST_ASSERT(*n_candidate >= 0 && *n_candidate <= CANDIDATES);
    int at = *n_candidate < CANDIDATES ? (*n_candidate)++ : CANDIDATES - 1;
    for (; at > 0 && box_volume(&candidate[at - 1]) > box_volume(box); --at) {
        candidate[at] = candidate[at - 1];
    }
    candidate[at] = *box;
}

static void sort_edges(clx_box *box)
{
    CLAST_ASSERT(box->edge[0] >= 0.0 && box->edge[1] >= 0.0 && box->edge[2] >= 0.0);
    for (int i = 1; i < 3; ++i) {
        for (int j = i; j > 0 && box->edge[j] > box->edge[j - 1]; --j) {
            double axis[3];
            const double edge = box->edge[j];
            box->edge[j] = box->edge[j - 1];
            box->edge[j - 1] = edge;
            v3_copy(axis, box->axis[j]);
            v3_copy(box->axis[j], box->axis[j - 1]);
            v3_copy(box->axis[j - 1], axis);
        }
    }
}

/// Tries every face as a side, the most promising first; width times shadow bounds the volume from
/// below, so the rest need no look once that exceeds the last candidate. Neither do those whose
/// chords do (a table of them, or NULL).
static void boxes_on_faces(const clx_hull_body *body, const clx_face_views *views,
                           const chord_table *table, clx_shadow *shadow,
                           clx_box candidate[CANDIDATES], int *n_candidate)
{
    const double sure = 1.0 - 1e-9; // of a bound, in spite of rounding
    for (int32_t i = 0; i < views->n; ++i) {
        const clx_face_view *view = &views->view[i];
        const double limit =
            *n_candidate < CANDIDATES ? (double)INFINITY : box_volume(&candidate[CANDIDATES - 1]);
        const double *normal = body->normal[view->face];
        double u[3];
        double v[3];
        clx_box box;
        if (view->least >= limit) {
            break;
        }
        v3_frame(normal, u, v);
        if (table != NULL && *n_candidate == CANDIDATES &&
            sure * view->width * least_rectangle(table, u, v) > limit) {
            continue;
        }
        if (box_along(body, normal, view->width, limit, shadow, &box) && box_volume(&box) < limit) {
            insert_box(candidate, n_candidate, &box);
        }
    }
}

clast_status clx_hull_body_least_box(const clx_hull_body *body, const clx_face_views *views,
                                     double frame[3][3], clx_box *box)
{
    clast_status status = CLAST_OK;
    clx_shadow shadow = {0};
    clx_box candidate[CANDIDATES] = {{.edge = {0}}};
    clx_box best;
    int n_candidate = 0;
    chord_table *table = NULL;
    CLX_TRY(clx_shadow_alloc(body, &shadow));
    if (body->n_face > MANY_FACES) {
        CLX_TRY(clx_alloc(&table, 1, sizeof *table));
        fill_chords(body, table);
    }
    box_in_frame(body, frame, &best);
    turn_down(body, 0, &shadow, &best);
    boxes_on_faces(body, views, table, &shadow, candidate, &n_candidate);
    for (int k = 0; k < n_candidate; ++k) {
        turn_down(body, 1, &shadow, &candidate[k]);
        if (box_volume(&candidate[k]) < box_volume(&best)) {
            best = candidate[k];
        }
    }
    if (body->n_face <= FEW_FACES) {
        clx_hull_body_box_on_edges(body, &best);
        turn_down(body, 0, &shadow, &best);
    }
    for (int k = 0; k < 3; ++k) {
        best.edge[k] = clx_hull_body_width(body, best.axis[k]);
    }
    sort_edges(&best);
    *box = best;
done:
    clx_free(table);
    clx_shadow_free(&shadow);
    return status;
}

/// Width of an outline along the unit vector d.
static double outline_width(const clx_shadow *s, const double d[2])
{
    double low = INFINITY;
    double high = -INFINITY;
    for (int32_t i = 0; i < s->n; ++i) {
        const double r = s->point[i][0] * d[0] + s->point[i][1] * d[1];
        low = r < low ? r : low;
        high = r > high ? r : high;
    }
    return high - low;
}

/// Longest distance of two corners, its unit direction and the width across it; of several that are
/// equally long (regular bodies have them) the one with the least width, so that rounding does not
/// decide.
static double longest_pair(const clx_shadow *s, double direction[2], double *width)
{
    const double tie = 1.0 - 1e-12;
    double longest = 0.0;
    *width = INFINITY;
    for (int pass = 0; pass < 2; ++pass) { // first the length, then the width among the longest
        for (int32_t i = 0; i < s->n; ++i) {
            for (int32_t j = 0; j < i; ++j) {
                const double d[2] = {s->point[i][0] - s->point[j][0],
                                     s->point[i][1] - s->point[j][1]};
                const double length = sqrt(d[0] * d[0] + d[1] * d[1]);
                if (pass == 0) {
                    longest = fmax(longest, length);
                } else if (length >= tie * longest) {
                    const double across[2] = {-d[1] / length, d[0] / length};
                    const double w = outline_width(s, across);
                    if (w < *width) {
                        *width = w;
                        direction[0] = d[0] / length;
                        direction[1] = d[1] / length;
                    }
                }
            }
        }
    }
    return longest;
}

static void fit_to_axis(const clx_hull_body *body, const double axis[3], double length,
                        clx_shadow *shadow, clx_box *box)
{
    double d[2] = {1.0, 0.0};
    clx_shadow_cast(body, axis, shadow);
    box->edge[0] = length;
    box->edge[1] = longest_pair(shadow, d, &box->edge[2]);
    v3_copy(box->axis[0], axis);
    for (int k = 0; k < 3; ++k) {
        box->axis[1][k] = d[0] * shadow->u[k] + d[1] * shadow->v[k];
    }
    v3_cross(box->axis[2], box->axis[0], box->axis[1]);
}

clast_status clx_hull_body_fitted_box(const clx_hull_body *body, const clx_feret *feret,
                                      clx_box *box)
{
    clast_status status = CLAST_OK;
    clx_shadow shadow = {0};
    clx_box best = {.edge = {INFINITY, INFINITY, INFINITY}};
    CLX_TRY(clx_shadow_alloc(body, &shadow));
    for (int32_t i = 0; i < feret->n_longest; ++i) {
        clx_box next;
        fit_to_axis(body, feret->longest_axis[i], feret->longest, &shadow, &next);
        if (box_volume(&next) < box_volume(&best)) {
            best = next;
        }
    }
    *box = best;
done:
    clx_shadow_free(&shadow);
    return status;
}
