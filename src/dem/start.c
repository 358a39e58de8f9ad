// Grains that begin inside of each other, or of a wall.
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
    dem->n_started = dem->n_grain;
    for (int64_t k = 0; first < dem->n_grain && k < dem->list.n_pair; ++k) {
        const clx_dem_pair *pair = &dem->list.pair[k];
        clx_dem_touch t = {0};
        if (clx_item_grain(dem, pair->a) < first) {
            continue;
        }
        if (pair->b < 0) {
            CLX_TRY(check_wall(dem, pair));
            continue;
        }
        if (clx_item_grain(dem, pair->b) < first) {
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
done:
    return status;
}
