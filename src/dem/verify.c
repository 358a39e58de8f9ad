// Contacts of a run beside contacts found without warm start.
//
// Every so many steps the contact of each listed pair of bodies that are no spheres is found
// without its warm start, when the step's contacts have just been found and nothing has moved
// since. An active pair must have that gap; a skipped one must be as far apart as its `active_from`
// promises.
#include "dem/container.h"
#include "dem/dem.h"

/// Differences that count as off, and as bad [m].
static const double OFF = 1e-11;
static const double BAD = 1e-8;

static void count(clast_dem_verification *v, double error)
{
    ++v->n;
    v->n_off += !(error <= OFF) ? 1 : 0;
    v->n_bad += !(error <= BAD) ? 1 : 0;
    v->worst = error > v->worst ? error : v->worst;
}

static double cold_gap(const clast_dem *dem, const clx_dem_pair *pair)
{
    CLAST_ASSERT(pair->a >= 0 && pair->a < dem->n_item);
    clx_contact contact;
    clx_pair shapes = {.a = &dem->convex[pair->a],
                       .b = &dem->convex[pair->b],
                       .rotation_a = clx_item_rotation(dem, pair->a),
                       .rotation_b = clx_item_rotation(dem, pair->b)};
    clx_pair_offset(dem, pair, shapes.offset);
    (void)clx_pair_contact(&shapes, INFINITY, NULL, &contact);
    return contact.gap;
}

void clx_verify(clast_dem *dem)
{
    const clx_neighbour_list *l = &dem->list;
    for (int64_t k = 0; k < l->n_pair && !dem->all_round; ++k) {
        const clx_dem_pair *pair = &l->pair[k];
        if (pair->b < 0 || clx_pair_is_round(dem, pair) ||
            clx_are_ghosts(dem, pair->a, pair->a)) { // counted by the rank of a
            continue;
        }
        const double gap = cold_gap(dem, pair);
        const double travel =
            dem->travel[clx_item_grain(dem, pair->a)] + dem->travel[clx_item_grain(dem, pair->b)];
        if (pair->touches != 0) {
            clx_dem_touch t = {0};
            clx_find_again(dem, pair, &t);
            count(&dem->verified, fabs(t.distance - gap));
        } else { // what is promised may be less than the gap, never more
            count(&dem->verified, fmax(0.0, fmax(0.0, pair->active_from - travel) - gap));
        }
    }
}
