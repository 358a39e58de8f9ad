// Remembered contacts beside cold ones, while a run goes on.
//
// Every so many steps each listed pair of bodies that are no spheres is asked without its memory,
// where the step's contacts have just been found and nothing has moved since. A pair that the step
// asked must have that gap; one that sleeps must be as far apart as its `wake` promises.
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

static double cold_gap(const clast_dem *dem, const clx_link *link)
{
    clx_contact contact;
    clx_pair pair = {.a = &dem->convex[link->a],
                     .b = &dem->convex[link->b],
                     .turn_a = clx_item_turn(dem, link->a),
                     .turn_b = clx_item_turn(dem, link->b)};
    clx_link_offset(dem, link, pair.offset);
    (void)clx_pair_contact(&pair, INFINITY, NULL, &contact);
    return contact.gap;
}

void clx_verify(clast_dem *dem)
{
    const clx_list *l = &dem->list;
    for (int64_t k = 0; k < l->n_link && !dem->all_round; ++k) {
        const clx_link *link = &l->link[k];
        if (link->b < 0 || clx_link_is_round(dem, link)) {
            continue;
        }
        const double gap = cold_gap(dem, link);
        const double travel =
            dem->travel[clx_item_grain(dem, link->a)] + dem->travel[clx_item_grain(dem, link->b)];
        if (link->touches != 0) {
            clx_dem_touch t = {0};
            clx_find_again(dem, link, &t);
            count(&dem->verified, fabs(t.distance - gap));
        } else { // what is promised may be less than the gap, never more
            count(&dem->verified, fmax(0.0, fmax(0.0, link->wake - travel) - gap));
        }
    }
}
