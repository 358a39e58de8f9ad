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
#include "geom/chords.h"
#include "math/least.h"
#include "math/vec3.h"

enum { CANDIDATES = 6, MOST_TURNS = 60, FEW_FACES = 48 };

static const double GAIN = 1e-13;

/// What every box around a hull asks for.
typedef struct {
    const clx_hull_body *body;
    const clx_chords *chords; ///< or NULL
    clx_shadow shadow;        ///< scratch
} surroundings;

static double box_volume(const clx_box *box)
{
    return box->edge[0] * box->edge[1] * box->edge[2];
}

/// The least box with one axis along the unit vector n, if it is not clearly larger than `limit`.
static bool box_along(surroundings *s, const double n[3], double width, double limit, clx_box *box)
{
    double side[2];
    double edge[2];
    double u[3];
    double v[3];
    uint32_t arcs = CLX_ALL_ARCS;
    if (s->chords != NULL && limit < (double)INFINITY) {
        v3_frame(n, u, v);
        arcs = clx_chords_arcs(s->chords, u, v, limit / width);
    }
    if (arcs == 0) {
        return false;
    }
    clx_shadow_cast(s->body, n, &s->shadow);
    if (!clx_shadow_rectangle(&s->shadow, 1e-12 * width, limit / width, arcs, side, edge)) {
        return false;
    }
    v3_copy(box->axis[0], n);
    for (int k = 0; k < 3; ++k) {
        box->axis[1][k] = side[0] * s->shadow.u[k] + side[1] * s->shadow.v[k];
        box->axis[2][k] = side[0] * s->shadow.v[k] - side[1] * s->shadow.u[k];
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
static void turn_down(surroundings *s, int idle, clx_box *box)
{
    int axis = idle;
    for (int pass = 0; pass < MOST_TURNS && idle < 3; ++pass) {
        clx_box next;
        const double limit = box_volume(box) * (1.0 - GAIN);
        if (box_along(s, box->axis[axis], box->edge[axis], limit, &next) &&
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

/// A box on a face that may be among the least few.
typedef struct {
    int32_t face;
    clx_box box;
} face_box;

typedef struct {
    int32_t n;
    int64_t capacity;
    face_box *at;              ///< [n]
    double volume[CANDIDATES]; ///< of the least so far, rising
} face_boxes;

/// Above this no box is among the least few; widths are not yet those to the last bit.
static double most_volume(const face_boxes *boxes)
{
    return (1.0 + 1e-9) * boxes->volume[CANDIDATES - 1];
}

/// No box on the face is smaller.
static double least_volume(const surroundings *s, int32_t f, double least_shadow)
{
    const double *n = s->body->normal[f];
    return (1.0 - 1e-9) * fabs(v3_dot(s->chords->cell[clx_chord_cell(n)].d, n)) * least_shadow;
}

/// Casts the shadow along a face, if chords do not show its box to be too large.
static clast_status try_face(surroundings *s, int32_t f, face_boxes *boxes)
{
    clast_status status = CLAST_OK;
    const double *n = s->body->normal[f];
    const clx_chord *chord = &s->chords->cell[clx_chord_cell(n)];
    double back[3];
    double across[3];
    CLX_TRY(clx_grow(&boxes->at, &boxes->capacity, (int64_t)boxes->n + 1, sizeof *boxes->at));
    v3_scale(back, -1.0, n);
    const int32_t low =
        clx_hull_body_support(s->body, back, v3_dot(chord->d, n) > 0.0 ? chord->low : chord->high);
    v3_sub(across, s->body->vert[s->body->face[f][0]], s->body->vert[low]);
    clx_box *box = &boxes->at[boxes->n].box;
    if (box_along(s, n, v3_dot(across, n), most_volume(boxes), box)) {
        double volume = box_volume(box);
        boxes->at[boxes->n].face = f;
        boxes->n += volume <= most_volume(boxes);
        for (int k = 0; k < CANDIDATES; ++k) { // in its place among the least
            const double next = boxes->volume[k];
            boxes->volume[k] = lesser_of(volume, next);
            volume = greater_of(volume, next);
        }
    }
done:
    return status;
}

/// Tries the faces: first those of the least width times shadow, so that the others have a limit.
static clast_status find_face_boxes(surroundings *s, const clx_face_shadows *faces,
                                    face_boxes *boxes)
{
    clast_status status = CLAST_OK;
    double *least = NULL;
    CLX_TRY(clx_alloc(&least, faces->n, sizeof *least));
    for (int k = 0; k < CANDIDATES; ++k) {
        boxes->volume[k] = (double)INFINITY;
    }
    for (int32_t i = 0; i < faces->n; ++i) {
        least[i] = least_volume(s, faces->face[i], faces->area[i] - faces->doubt);
    }
    for (int k = 0; k < CANDIDATES; ++k) {
        int32_t first = 0;
        for (int32_t i = 1; i < faces->n; ++i) {
            first = least[i] < least[first] ? i : first;
        }
        least[first] = (double)INFINITY;
        CLX_TRY(try_face(s, faces->face[first], boxes));
    }
    for (int32_t i = 0; i < faces->n; ++i) {
        if (least[i] <= most_volume(boxes)) {
            CLX_TRY(try_face(s, faces->face[i], boxes));
        }
    }
done:
    clx_free(least);
    return status;
}

/// The views along the faces on which a box may be among the least few: of all, without chords.
static clast_status find_views(surroundings *s, const clx_face_shadows *faces, face_boxes *boxes,
                               clx_face_views *views)
{
    clast_status status = CLAST_OK;
    int32_t *face = NULL;
    int32_t n = 0;
    if (s->chords == NULL) {
        return clx_face_views_make(s->body, faces->n, faces->face, views);
    }
    CLX_TRY(find_face_boxes(s, faces, boxes));
    CLX_TRY(clx_alloc(&face, boxes->n, sizeof *face));
    for (int32_t i = 0; i < boxes->n; ++i) {
        if (box_volume(&boxes->at[i].box) <= most_volume(boxes)) {
            face[n++] = boxes->at[i].face;
        }
    }
    CLX_TRY(clx_face_views_make(s->body, n, face, views));
done:
    clx_free(face);
    return status;
}

/// The box along a view: the one found for its face, if there is one.
static bool box_of_view(surroundings *s, const clx_face_view *view, const face_boxes *boxes,
                        double limit, clx_box *box)
{
    for (int32_t i = 0; i < boxes->n; ++i) {
        if (boxes->at[i].face == view->face) {
            *box = boxes->at[i].box;
            box->edge[0] = view->width;
            return true;
        }
    }
    return box_along(s, s->body->normal[view->face], view->width, limit, box);
}

/// Takes each view's face as a side, the most promising first; width times shadow bounds the volume
/// from below, so the rest need no look once that exceeds the last candidate.
static void boxes_on_faces(surroundings *s, const clx_face_views *views, const face_boxes *boxes,
                           clx_box candidate[CANDIDATES], int *n_candidate)
{
    for (int32_t i = 0; i < views->n; ++i) {
        const clx_face_view *view = &views->view[i];
        const double limit =
            *n_candidate < CANDIDATES ? (double)INFINITY : box_volume(&candidate[CANDIDATES - 1]);
        clx_box box;
        if (view->least >= limit) {
            break;
        }
        if (box_of_view(s, view, boxes, limit, &box) && box_volume(&box) < limit) {
            insert_box(candidate, n_candidate, &box);
        }
    }
}

clast_status clx_hull_body_least_box(const clx_hull_body *body, const clx_chords *chords,
                                     const clx_face_shadows *faces, double frame[3][3],
                                     clx_box *box)
{
    clast_status status = CLAST_OK;
    surroundings s = {.body = body, .chords = chords};
    face_boxes boxes = {0};
    clx_face_views views = {0};
    clx_box candidate[CANDIDATES] = {{.edge = {0}}};
    clx_box best;
    int n_candidate = 0;
    CLX_TRY(clx_shadow_alloc(body, &s.shadow));
    box_in_frame(body, frame, &best);
    turn_down(&s, 0, &best);
    CLX_TRY(find_views(&s, faces, &boxes, &views));
    boxes_on_faces(&s, &views, &boxes, candidate, &n_candidate);
    for (int k = 0; k < n_candidate; ++k) {
        turn_down(&s, 1, &candidate[k]);
        if (box_volume(&candidate[k]) < box_volume(&best)) {
            best = candidate[k];
        }
    }
    if (body->n_face <= FEW_FACES) {
        clx_hull_body_box_on_edges(body, &best);
        turn_down(&s, 0, &best);
    }
    for (int k = 0; k < 3; ++k) {
        best.edge[k] = clx_hull_body_width(body, best.axis[k]);
    }
    CLAST_ASSERT(best.edge[0] >= 0.0 && best.edge[1] >= 0.0 && best.edge[2] >= 0.0);
    v3_sort_axes(best.edge, best.axis);
    *box = best;
done:
    clx_free(boxes.at);
    clx_face_views_free(&views);
    clx_shadow_free(&s.shadow);
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
