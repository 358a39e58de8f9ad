#pragma once
// A convex hull laid out for questions about directions: calipers, boxes, shadows.
#include <clast/mesh.h>

/// An edge and the faces on both sides: face[0] runs from vert[0] to vert[1], face[1] back.
typedef struct clx_hull_body_edge {
    int32_t vert[2];
    int32_t face[2];
} clx_hull_body_edge;

/// Half-edge 4 f + k begins at corner k of face f.
static inline int32_t clx_half_of(int32_t face, int corner)
{
    return 4 * face + corner;
}

/// The half-edge that follows on the same face.
static inline int32_t clx_half_after(int32_t half)
{
    return (half & 3) == 2 ? half - 2 : half + 1;
}

struct clx_chords; // geom/chords.h

/// Convex hull of points, moved so that the middle of its box is the origin; {0} is empty.
typedef struct clx_hull_body {
    double middle[3]; ///< of the box, in the points' own coordinates
    int32_t n_vert, n_face, n_edge;
    double (*vert)[3];        ///< [n_vert]
    int32_t (*face)[3];       ///< [n_face] counter-clockwise from outside
    int32_t *twin;            ///< [4 n_face] the other half-edge of each half-edge's edge
    int32_t *half_at;         ///< [n_vert] one of the half-edges that begin at a vertex
    double (*normal)[3];      ///< [n_face] outward, unit; zero where a sliver has none
    double *area;             ///< [n_face]
    clx_hull_body_edge *edge; ///< [n_edge]
    int32_t *begin;           ///< [n_vert + 1] neighbours of v are neighbour[begin[v] ..]
    int32_t *neighbour;       ///< [2 n_edge]
    double volume, surface;
} clx_hull_body;

/// The hull of a mesh's vertices; its triangles are not looked at.
///
/// @return CLAST_E_GEOMETRY if a vertex is not finite or all lie within 1e-13 of their extent from
///         one plane
/// @note O(n log n)
clast_status clx_hull_body_make(const clast_mesh *mesh, clx_hull_body *body);
void clx_hull_body_free(clx_hull_body *body);

/// Vertex farthest along a direction, by climbing from `start` over neighbours.
int32_t clx_hull_body_support(const clx_hull_body *body, const double direction[3], int32_t start);

/// The same where that vertex is farther than all others by more than rounding, from wherever the
/// search starts; else -1.
int32_t clx_hull_body_clear_support(const clx_hull_body *body, const double direction[3],
                                    int32_t start);

/// Caliper width along a unit direction, over all vertices.
double clx_hull_body_width(const clx_hull_body *body, const double direction[3]);

enum { CLX_DIRECTIONS = 8 };

/// Widths along eight unit directions, and areas of the eight shadows: the same bits as one by one.
void clx_hull_body_widths(const clx_hull_body *body, const double direction[CLX_DIRECTIONS][3],
                          double width[CLX_DIRECTIONS]);
void clx_shadow_areas(const clx_hull_body *body, const double direction[CLX_DIRECTIONS][3],
                      double area[CLX_DIRECTIONS]);

/// Half the sum of the areas of faces, each along its normal or against it so that it is turned to
/// the direction, for eight directions: its component along that is the shadow's area, along any
/// other no greater than that one's.
void clx_shadow_sums(const clx_hull_body *body, const double direction[CLX_DIRECTIONS][3],
                     double sum[CLX_DIRECTIONS][3]);

enum { CLX_FERET_TIES = 16 };

/// Greatest and least distance of two parallel planes that touch the hull, exactly.
typedef struct clx_feret {
    double longest, shortest;
    int32_t n_longest; ///< axes of that length within 1e-12, up to CLX_FERET_TIES of them
    double longest_axis[CLX_FERET_TIES][3]; ///< [n_longest] unit
    double shortest_axis[3];                ///< unit
} clx_feret;

/// The longest caliper joins two vertices, the shortest stands on a face and a vertex or on two
/// edges; all antipodal pairs are met on a walk along the normals' arcs.  [docs/theory/form.md]
/// Edges that the chords (or NULL) show to have neither are passed over.
/// @note O(edges) expected
clast_status clx_hull_body_feret(const clx_hull_body *body, const struct clx_chords *chords,
                                 clx_feret *feret);

/// The outline of the shadow along a direction: a convex polygon, counter-clockwise in the plane
/// with axes u, v.
typedef struct clx_shadow {
    double u[3], v[3];
    int32_t start;      ///< a vertex of the last outline: where the next search begins
    int32_t n;          ///< corners
    double (*point)[2]; ///< [n], room [2 n_edge]
    int32_t *next;      ///< [n_vert] scratch
    unsigned char *up;  ///< [n_face] scratch: the face is turned to the light
    double (*spare)[2]; ///< [2 n_edge] scratch
} clx_shadow;

clast_status clx_shadow_alloc(const clx_hull_body *body, clx_shadow *shadow);
void clx_shadow_free(clx_shadow *shadow);

/// Area of the shadow alone: half the sum of face area times |normal . direction|.
double clx_shadow_area(const clx_hull_body *body, const double direction[3]);

/// Casts the shadow.
void clx_shadow_cast(const clx_hull_body *body, const double direction[3], clx_shadow *shadow);

/// Least rectangle around an outline: unit direction of one side and the edges along and across it.
/// One side lies on an edge of the outline longer than `tolerance`. False without such an edge, and
/// when the rectangle is clearly larger than `limit`. Edges outside `arcs` (geom/chords.h) may be
/// passed over: the caller knows that their rectangles are clearly larger.
bool clx_shadow_rectangle(const clx_shadow *shadow, double tolerance, double limit, uint32_t arcs,
                          double side[2], double edge[2]);

/// Areas of the shadows along the normals of faces (at most 2048 of them, evenly taken) in single
/// precision, which tells most from the least and the greatest.
typedef struct clx_face_shadows {
    int32_t n;
    int32_t *face; ///< [n]
    double *area;  ///< [n]
    double doubt;  ///< no area is farther from clx_shadow_area()
} clx_face_shadows;

clast_status clx_face_shadows_make(const clx_hull_body *body, clx_face_shadows *shadows);
void clx_face_shadows_free(clx_face_shadows *shadows);

enum { CLX_SINGLES = 16 };

/// Sums of |part . direction| over the parts, for sixteen directions, in single precision.
void clx_shadow_singles(int32_t n, const float (*part)[3], const float direction[3][CLX_SINGLES],
                        float sum[CLX_SINGLES]);

/// The hull seen along the normal of a face.
typedef struct clx_face_view {
    int32_t face;
    double width;  ///< of the hull along the face's normal
    double shadow; ///< area
    double least;  ///< width times shadow: no box along the normal is smaller
} clx_face_view;

typedef struct clx_face_views {
    int32_t n;
    clx_face_view *view; ///< [n] by rising width times shadow, the least volume of a box along it
} clx_face_views;

clast_status clx_face_views_make(const clx_hull_body *body, int32_t n, const int32_t face[],
                                 clx_face_views *views);
void clx_face_views_free(clx_face_views *views);

/// Greatest and least shadow over all directions: greatest and least over the faces and the given
/// axes, each then improved to a local optimum, and replaced where another is better by more than
/// 1e-4; of hulls of many hundred faces that is looked for in parts of the sphere of some degrees.
/// direction: of the greatest, unit
/// @note O(n_face), at most some 250 to 2300 times
clast_status clx_shadow_extremes(const clx_hull_body *body, const clx_face_shadows *faces,
                                 double axis[3][3], double *least, double *greatest,
                                 double direction[3]);

/// A box: edge lengths in falling order and their unit directions.
typedef struct clx_box {
    double edge[3];
    double axis[3][3];
} clx_box;

/// The box of least volume found: every face is tried as a side with the exact least rectangle
/// around the shadow, but for those whose box the chords (or NULL) show to be larger than six
/// others; the best few and the given frame are then turned about each of their axes in turn until
/// none gains; for few faces the boxes on edges alone too. [ORourke1985; Chang2011]
clast_status clx_hull_body_least_box(const clx_hull_body *body, const struct clx_chords *chords,
                                     const clx_face_shadows *faces, double frame[3][3],
                                     clx_box *box);

/// Replaces the box by the least one whose neighbouring sides hold an edge each, if that is clearly
/// less.
/// @note O(n_edge^2 n_vert)
void clx_hull_body_box_on_edges(const clx_hull_body *body, clx_box *best);

/// The fitted box: longest caliper, longest caliper at right angles to it, width across both. Where
/// several calipers are equally long (regular bodies), the box of least volume.
clast_status clx_hull_body_fitted_box(const clx_hull_body *body, const clx_feret *feret,
                                      clx_box *box);
