// What a packing's options must be to one another.
#include "pack/pack.h"

#include <clast/porosity.h>
#include <math.h>
#include <string.h>

/// Several mean "as the other" by -1 alone.
static clast_status check_sentinel(const char *name, double value)
{
    return value >= 0.0 || value == -1.0
               ? CLAST_OK
               : clx_fail(CLAST_E_CONFIG, "%s %g: it is -1, or not below 0", name, value);
}

static clast_status check_fills(const clast_pack_config *c)
{
    clast_status status = CLAST_OK;
    const double low = c->first_low >= 0.0 ? c->first_low : c->fill_low;
    const double high = c->first_high >= 0.0 ? c->first_high : c->fill_high;
    CLX_TRY(check_sentinel("first_low", c->first_low));
    CLX_TRY(check_sentinel("first_high", c->first_high));
    CLX_CHECK(c->fill_low < c->fill_high, CLAST_E_CONFIG, "fill_low %g is not below fill_high %g",
              c->fill_low, c->fill_high);
    CLX_CHECK(low < high, CLAST_E_CONFIG,
              "the first fill begins at %g of the height (first_low), not below %g (first_high)",
              low, high);
done:
    return status;
}

static bool has_usual_fills(const clast_pack_config *c, const clast_pack_config *usual)
{
    return c->fill_low == usual->fill_low && c->fill_high == usual->fill_high &&
           c->first_low == usual->first_low && c->first_high == usual->first_high;
}

/// Options that act in domain cell alone, or on nothing there.
static clast_status check_cell(const clast_pack_config *c, const clast_pack_config *usual)
{
    clast_status status = CLAST_OK;
    const bool is_cell = c->dem.domain == CLAST_DEM_CELL;
    CLX_CHECK(!is_cell || (c->shaking_time == usual->shaking_time &&
                           c->shake_amplitude == usual->shake_amplitude &&
                           c->shake_period == usual->shake_period &&
                           c->shake_from_start == usual->shake_from_start &&
                           c->damping == usual->damping && has_usual_fills(c, usual)),
              CLAST_E_CONFIG,
              "domain cell is filled whole, and loaded by its stages: leave out shaking_time, "
              "shake_amplitude, shake_period, shake_from_start, damping, fill_low, fill_high, "
              "first_low and first_high");
    CLX_CHECK(
        !is_cell || (c->rule == usual->rule && c->height_change == usual->height_change &&
                     c->check_time == usual->check_time && c->still_speed == usual->still_speed &&
                     c->max_damping_time == usual->max_damping_time),
        CLAST_E_CONFIG,
        "stages of domain cell end by their until, load_rest and max_load_time: leave out rule, "
        "height_change, check_time, still_speed and max_damping_time");
    CLX_CHECK(
        !is_cell || (c->dem.wall_friction == usual->dem.wall_friction && c->layer == usual->layer &&
                     c->cut == usual->cut && c->trim == usual->trim),
        CLAST_E_CONFIG,
        "domain cell has no walls, no ends and no profile: leave out wall_friction, layer, cut and "
        "trim");
    CLX_CHECK(is_cell || c->stages.n > 0 ||
                  (c->load_rate == usual->load_rate && c->load_tolerance == usual->load_tolerance &&
                   c->load_rest == usual->load_rest && c->max_load_time == usual->max_load_time),
              CLAST_E_CONFIG,
              "load_rate, load_tolerance, load_rest and max_load_time act with stages alone");
done:
    return status;
}

/// Options that the law, the domain or the forms leave without effect.
static clast_status check_unused(const clast_pack_config *c, const clast_pack_config *usual)
{
    clast_status status = CLAST_OK;
    const clast_dem_config *d = &c->dem;
    const clast_dem_config *u = &usual->dem;
    const bool has_container = c->container != NULL && c->container[0] != '\0';
    CLX_CHECK(!has_container || (d->domain == u->domain && d->width == u->width &&
                                 d->depth == u->depth && d->height == u->height),
              CLAST_E_CONFIG,
              "container holds the grains in place of domain, width, depth and height: leave those "
              "out");
    CLX_CHECK(has_container || c->container_unit == NULL || c->container_unit[0] == '\0',
              CLAST_E_CONFIG, "container_unit %s without a container", c->container_unit);
    const bool has_start = c->start != NULL && c->start[0] != '\0';
    CLX_CHECK(!has_start ||
                  (strcmp(c->curve, usual->curve) == 0 && c->shape_weight.n == 0 &&
                   c->mass == usual->mass && !c->form_law && !c->ellipsoids &&
                   c->spacing == usual->spacing && c->generator == usual->generator &&
                   c->density_of == usual->density_of && c->initial_speed == usual->initial_speed &&
                   has_usual_fills(c, usual) && c->shake_from_start == usual->shake_from_start),
              CLAST_E_CONFIG,
              "start brings the grains: leave out curve, shape_weight, mass, form_law, "
              "ellipsoids, spacing, generator, density_of, initial_speed, fill_low, fill_high, "
              "first_low, first_high and shake_from_start");
    CLX_CHECK(has_start || ((c->start_unit == NULL || c->start_unit[0] == '\0') &&
                            (c->start_columns == NULL || c->start_columns[0] == '\0') &&
                            c->start_diameter == 0.0),
              CLAST_E_CONFIG, "start_unit, start_columns and start_diameter are of a start");
    CLX_TRY(check_cell(c, usual));
    CLX_CHECK(d->domain != CLAST_DEM_CYLINDER || d->depth == 0.0, CLAST_E_CONFIG,
              "depth %s: a cylinder has a width alone", clx_unit_text(d->depth, "m"));
    CLX_CHECK(d->law == CLAST_DEM_HERTZ || d->young == u->young, CLAST_E_CONFIG,
              "young %s acts with law hertz alone", clx_unit_text(d->young, "Pa"));
    CLX_CHECK(d->law == CLAST_DEM_LINEAR || d->collision_time == u->collision_time, CLAST_E_CONFIG,
              "collision_time %s acts with law linear alone",
              clx_unit_text(d->collision_time, "s"));
    CLX_CHECK(c->rule != CLAST_PACK_BY_SPEED || c->height_change == usual->height_change,
              CLAST_E_CONFIG, "height_change %s acts with rule height or either",
              clx_unit_text(c->height_change, "m"));
    CLX_CHECK(c->form_law || (c->flatness_mean == usual->flatness_mean &&
                              c->flatness_deviation == usual->flatness_deviation &&
                              c->elongation_mean == usual->elongation_mean &&
                              c->elongation_deviation == usual->elongation_deviation),
              CLAST_E_CONFIG, "means and deviations of flatness and elongation act with form_law");
done:
    return status;
}

clast_status clx_pack_check(const clast_pack_config *config)
{
    clast_pack_config usual = {0};
    clast_status status = CLAST_OK;
    CLX_TRY(clast_fields_default(clast_pack_fields, &usual));
    CLX_TRY(check_fills(config));
    CLX_TRY(check_sentinel("wall_friction", config->dem.wall_friction));
    CLX_TRY(check_sentinel("trim", config->trim));
    CLX_TRY(check_unused(config, &usual));
done:
    clast_fields_free(clast_pack_fields, &usual);
    return status;
}
