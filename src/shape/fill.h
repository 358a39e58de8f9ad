#pragma once
// What the parts of clast_fill share: the task, the spheres placed so far, the interface of a
// strategy, the errors of a sphere set.
#include <clast/fill.h>

#include "base/status.h"
#include "shape/fill_balls.h"
#include "shape/fill_field.h"
#include "shape/fill_solid.h"

/// A filling under way.
typedef struct clx_fill {
    const clast_fill_config *config;
    const clast_monitor *monitor; ///< or NULL
    const clast_mesh *surface;    ///< as given
    clx_fill_solid solid;         ///< closed
    clx_fill_field field;         ///< its distances and its inside
    clast_mass mass;              ///< of the solid
    double low[3], high[3];
    double extent; ///< diagonal of the box
    clx_ball_set balls;
    double floor;     ///< smaller spheres are of no interest
    int64_t n_tested; ///< distances asked for
    double bound;     ///< radius that no further sphere exceeds, or 0
} clx_fill;

/// One way to find the next sphere. `next` sets *found to false when nothing is left to place.
typedef struct clx_fill_strategy {
    clast_status (*create)(clx_fill *fill, void **state);
    clast_status (*next)(clx_fill *fill, void *state, double ball[4], bool *found);
    void (*destroy)(void *state); ///< NULL is allowed
} clx_fill_strategy;

extern const clx_fill_strategy clx_fill_largest;
extern const clx_fill_strategy clx_fill_random; ///< and published
extern const clx_fill_strategy clx_fill_overlap;

/// CLAST_E_STOPPED when the monitor asks to stop.
clast_status clx_fill_poll(const clx_fill *fill);

/// Closes the surface, checks it, builds its tree: everything but the spheres. Free in any case.
clast_status clx_fill_open(const clast_mesh *mesh, bool allow_open, clx_fill *fill);
void clx_fill_free(clx_fill *fill);

/// Sums over spheres that do not overlap, about an origin: volume, first and second moments; and
/// what lies outside the solid.
typedef struct clx_fill_sums {
    double origin[3];
    double volume;
    double first[3];
    double second[3][3]; ///< integral of x x^T
    double outside;      ///< volume, by clx_fill_outside; of all spheres, overlap or not
} clx_fill_sums;

void clx_fill_sums_add(clx_fill_sums *sums, const double centre[3], double radius);
clast_mass clx_fill_sums_mass(const clx_fill_sums *sums);

/// Volume of a sphere outside the solid and in none of the spheres `before` it (NULL: apart from
/// all); 0 where it does not protrude.
double clx_fill_outside(const clx_fill *fill, const clx_ball_set *before, const double centre[3],
                        double radius);

/// The shares and errors of a body `made` that should be `wanted`, of which a volume is outside,
/// into the report.
void clx_fill_errors(const clast_mass *wanted, const clast_mass *made, double outside,
                     clast_fill_report *report);

/// All measures of a sphere set that the report holds.
clast_status clx_fill_measure(const clx_fill *fill, const clast_spheres *spheres,
                              clast_fill_report *report);

/// Point number i of n, evenly spread by area over a surface, and its triangle.
typedef struct clx_fill_spread {
    const clast_mesh *mesh;
    double *area; ///< [n_tri] running sum
} clx_fill_spread;

clast_status clx_fill_spread_create(const clast_mesh *mesh, clx_fill_spread *spread);
void clx_fill_spread_free(clx_fill_spread *spread);
int32_t clx_fill_spread_point(const clx_fill_spread *spread, int64_t i, int64_t n, double point[3]);

/// keep [n]: true for spheres whose centre is a corner of the boundary of all centres [O_ext].
///
/// The boundary is that of the alpha shape whose radius lies `shrink` of the way, by rank, from the
/// greatest circumradius of the Delaunay tetrahedra to the least that holds all centres in one
/// region; voids are filled.
clast_status clx_fill_outer(const clast_spheres *spheres, double shrink, bool *keep);

enum { CLX_FILL_WITNESSES = 24 };

/// Convex functions of x over the cube |x_k| <= h about the origin, distances to spheres or
/// triangles, and linear ones near them: value[j] + gradient[j] . x.
typedef struct clx_fill_planes {
    int n;
    double value[CLX_FILL_WITNESSES];
    double gradient[3][CLX_FILL_WITNESSES];
    double away[CLX_FILL_WITNESSES][3];   ///< from the sphere's centre, or the triangle's corner 0
    double radius[CLX_FILL_WITNESSES];    ///< of the sphere; 0 for a point or a triangle
    double (*tri[CLX_FILL_WITNESSES])[3]; ///< corner 0 and edges; NULL for a sphere
} clx_fill_planes;

/// Upper bound of the greatest, over the cube, least of the convex functions; at least one.
///
/// `step` is where the least of the linear ones is greatest. Fills the list up to a multiple of
/// four with functions that are nowhere the least.
double clx_fill_bound(clx_fill_planes *planes, double h, double step[3]);
