// Grains that begin inside of each other, of a grain that is there, or of a wall. What is refused
// stays unchecked: the next step refuses it again.
#include "dem/touch.h"

/// Overlap that a contact's spring would throw apart, at d pi / T, faster than a run may go. 0.62
/// of the radius with the published constants.
static double deepest(const clast_dem *dem, const clx_dem_pair *pair, const clx_grain *g,
                      double radius)
{
    const double time = clx_law_time(clx_pair_law(dem, pair), g->mass, g->round_radius);
    return dem->stride * radius * time / (CLAST_PI * dem->config.time_step);
}

static clast_status check_wall(const clast_dem *dem, const clx_dem_pair *pair)
{
    clast_status status = CLAST_OK;
    const int32_t g = clx_item_grain(dem, pair->a);
    const double radius = clx_item_radius(dem, pair->a);
    clx_dem_touch t = {0};
    clx_find_again(dem, pair, &t);
    CLX_CHECK(-t.distance <= deepest(dem, pair, &dem->grain[g], radius), CLAST_E_GEOMETRY,
              "grain %d begins inside of a wall, by %.2g of its radius: place it within the domain",
              clx_grain_number(dem, g), -t.distance / radius);
done:
    return status;
}

clast_status clx_check_starts(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    const int32_t first = dem->n_started;
    for (int64_t k = 0; first < dem->n_grain && k < dem->list.n_pair; ++k) {
        const clx_dem_pair *pair = &dem->list.pair[k];
        clx_dem_touch t = {0};
        const bool is_wall = pair->b < 0;
        const bool is_old[2] = {clx_item_grain(dem, pair->a) < first,
                                !is_wall && clx_item_grain(dem, pair->b) < first};
        if (is_wall || dem->may_touch_old ? is_old[0] || is_old[1] : is_old[0] && is_old[1]) {
            continue;
        }
        if (is_wall) {
            CLX_TRY(check_wall(dem, pair));
            continue;
        }
        clx_find_again(dem, pair, &t);
        const double ra = clx_item_radius(dem, pair->a);
        const double rb = clx_item_radius(dem, pair->b);
        const double radius = ra < rb ? ra : rb;
        const clx_grain *g = &dem->grain[clx_item_grain(dem, ra < rb ? pair->a : pair->b)];
        CLX_CHECK(
            -t.distance <= deepest(dem, pair, g, radius), CLAST_E_GEOMETRY,
            "grains %d and %d begin inside of each other, by %.2g of the smaller one's radius: "
            "place them apart",
            clx_grain_number(dem, clx_item_grain(dem, pair->a)),
            clx_grain_number(dem, clx_item_grain(dem, pair->b)), -t.distance / radius);
    }
    dem->n_started = dem->n_grain;
done:
    return status;
}
