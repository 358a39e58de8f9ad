// Contacts of pairs that are not of spheres alone, by src/convex.
#include "dem/touch.h"

/// Gaps beyond this share of the smaller radius need no digits: a lower bound serves as budget.
static const double FAR = 0.1;

/// @param is_new  the warm start's facet, of hulls, is known not to do
static void touch(const clast_dem *dem, const clx_dem_pair *pair, bool is_new,
                  clx_warm_start *warm_start, clx_dem_touch *t)
{
    CLAST_ASSERT(pair->a >= 0 && pair->b > pair->a && pair->b < dem->n_item);
    clx_contact contact;
    clx_pair shapes = {.a = &dem->convex[pair->a],
                       .b = &dem->convex[pair->b],
                       .rotation_a = clx_item_rotation(dem, pair->a),
                       .rotation_b = clx_item_rotation(dem, pair->b)};
    clx_pair_offset(dem, pair, shapes.offset);
    const double ra = clx_item_radius(dem, pair->a);
    const double rb = clx_item_radius(dem, pair->b);
    const double far = FAR * (ra < rb ? ra : rb);
    if (is_new ? clx_hulls_contact_anew(&shapes, far, warm_start, &contact)
               : clx_pair_contact(&shapes, far, warm_start, &contact)) {
        clx_touch_from_contact(&contact, shapes.offset, t);
    } else {
        t->distance = contact.gap;
    }
}

void clx_touch_convex(const clast_dem *dem, const clx_dem_pair *pair, clx_warm_start *warm_start,
                      clx_dem_touch *t)
{
    touch(dem, pair, false, warm_start, t);
}

void clx_touch_hulls_anew(const clast_dem *dem, const clx_dem_pair *pair,
                          clx_warm_start *warm_start, clx_dem_touch *t)
{
    touch(dem, pair, true, warm_start, t);
}

void clx_touch_convex_wall(const clast_dem *dem, const clx_dem_pair *pair,
                           clx_warm_start *warm_start, clx_dem_touch *t)
{
    CLAST_ASSERT(pair->b < 0 && pair->b >= -dem->n_wall);
    static const double axis[2] = {0.0, 0.0};
    static const double nowhere[3] = {0.0, 0.0, 0.0};
    const clx_wall *wall = &dem->wall[-1 - pair->b];
    clx_placed body = {.shape = &dem->convex[pair->a], .rotation = clx_item_rotation(dem, pair->a)};
    clx_contact contact;
    v3_copy(body.position, clx_item_position(dem, pair->a));
    if (wall->kind == CLX_WALL_PLANE) {
        const double plane[4] = {wall->normal[0], wall->normal[1], wall->normal[2], wall->offset};
        clx_plane_contact(&body, plane, warm_start, &contact);
    } else {
        clx_cylinder_contact(&body, axis, wall->radius, &contact);
    }
    clx_touch_from_contact(&contact, nowhere, t);
}
