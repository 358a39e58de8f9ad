// The physics' option table, and what no single range can see.
#include "dem/dem.h"
#include "dem/fields.h"

#define NOTHING
const clast_field clast_dem_fields[] = {CLX_DEM_FIELDS(clast_dem_config, NOTHING), {0}};

/// Steps that a collision takes at least; by exact steps.
static const double RESOLUTION = 10.0;
static const double EXACT = 20.0;

/// Contacts of a grain at rest in a bed, at least: fewer, and it rolls on.
enum { HOLDING = 4 };

clast_status clx_dem_check_step(const clx_law *law, double time_step, double mass, double radius)
{
    const double shortest = clx_law_time(law, mass, radius);
    const bool is_linear = law->kind == CLAST_DEM_LINEAR;
    const double needs = !is_linear      ? RESOLUTION
                         : law->is_exact ? EXACT
                                         : fmax(RESOLUTION, clx_law_steps(law, HOLDING));
    if (time_step * needs <= shortest * (1.0 + 1e-12)) {
        return CLAST_OK;
    }
    if (needs > EXACT) {
        return clx_fail(CLAST_E_CONFIG,
                        "time_step %s is too long: a collision takes %s (collision_time), and with "
                        "this restitution explicit steps need %.1f of it where %d contacts hold a "
                        "grain; take %s or less, or contact_scheme exact (%s)",
                        clx_unit_text(time_step, "s"), clx_unit_text(shortest, "s"), needs, HOLDING,
                        clx_unit_text(shortest / needs, "s"), clx_unit_text(shortest / EXACT, "s"));
    }
    return is_linear
               ? clx_fail(CLAST_E_CONFIG,
                          "time_step %s is too long: a collision takes %s (collision_time), and "
                          "needs at least %g steps; take %s or less",
                          clx_unit_text(time_step, "s"), clx_unit_text(shortest, "s"), needs,
                          clx_unit_text(shortest / needs, "s"))
               : clx_fail(
                     CLAST_E_CONFIG,
                     "time_step %s is too long: a grain of %s swings on a contact of this young in "
                     "%s, and needs at least %g steps; take %s or less, or a smaller young",
                     clx_unit_text(time_step, "s"), clx_unit_text(mass, "kg"),
                     clx_unit_text(shortest, "s"), needs, clx_unit_text(shortest / needs, "s"));
}

/// An energy that no attraction takes would be ignored.
static clast_status check_cohesion(const clast_dem_config *config)
{
    clast_status status = CLAST_OK;
    const bool is_area = config->cohesion == CLAST_DEM_AREA;
    const bool is_surface = config->cohesion == CLAST_DEM_DMT || config->cohesion == CLAST_DEM_JKR;
    CLX_CHECK(is_area || config->cohesion_energy == 0.0, CLAST_E_CONFIG,
              "cohesion_energy %g J/m^3 acts with cohesion area alone", config->cohesion_energy);
    CLX_CHECK(is_surface || config->surface_energy == 0.0, CLAST_E_CONFIG,
              "surface_energy %g J/m^2 acts with cohesion dmt or jkr alone",
              config->surface_energy);
    CLX_CHECK(!is_area || config->cohesion_energy > 0.0, CLAST_E_CONFIG,
              "cohesion area attracts by cohesion_energy, which is 0");
    CLX_CHECK(!is_surface || config->surface_energy > 0.0, CLAST_E_CONFIG,
              "cohesion dmt or jkr attracts by surface_energy, which is 0");
done:
    return status;
}

/// Options of the fluid that something else has to be there for.
static clast_status check_fluid(const clast_dem_config *c)
{
    clast_status status = CLAST_OK;
    clast_dem_config soft = *c;
    const bool has_more =
        c->sphere_drag != CLAST_DEM_DRAG_FORM || c->hindrance || c->wet_restitution;
    CLX_CHECK(c->fluid_viscosity > 0.0 || !has_more, CLAST_E_CONFIG,
              "sphere_drag, hindrance and wet_restitution act with a fluid_viscosity alone (water: "
              "1e-3 Pa s)");
    CLX_CHECK(c->fluid_density > 0.0 || (c->added_mass == 0.0 && !c->hindrance), CLAST_E_CONFIG,
              "added_mass and hindrance act with a fluid_density alone");
    CLX_CHECK(!c->hindrance || c->domain != CLAST_DEM_OPEN, CLAST_E_CONFIG,
              "hindrance goes by the porosity at a height: it needs a cylinder, periodic or box");
    CLX_CHECK(!c->wet_restitution ||
                  (c->law == CLAST_DEM_LINEAR && c->contact_scheme == CLAST_DEM_EXPLICIT),
              CLAST_E_CONFIG, "wet_restitution is for law linear with contact_scheme explicit");
    if (c->wet_restitution) {
        soft.restitution = fmin(CLX_LAW_SOFT, c->restitution);
        const clx_law law = clx_law_make(&soft);
        CLX_TRY(clx_dem_check_step(&law, c->time_step, 0.0, 0.0));
    }
done:
    return status;
}

clast_status clx_dem_check(const clast_dem_config *config)
{
    clast_status status = CLAST_OK;
    const clx_law law = clx_law_make(config);
    CLX_CHECK(config->restitution > 0.0 && config->restitution <= 1.0, CLAST_E_CONFIG,
              "restitution %g: it lies above 0, and at most at 1", config->restitution);
    CLX_CHECK(config->time_step > 0.0 && isfinite(config->time_step), CLAST_E_CONFIG,
              "time_step %s", clx_unit_text(config->time_step, "s"));
    if (config->law == CLAST_DEM_LINEAR) {
        CLX_TRY(clx_dem_check_step(&law, config->time_step, 0.0, 0.0));
    }
    CLX_CHECK(config->domain == CLAST_DEM_OPEN || config->width > 0.0, CLAST_E_CONFIG, "width %s",
              clx_unit_text(config->width, "m"));
    CLX_CHECK(config->height > 0.0, CLAST_E_CONFIG, "height %s",
              clx_unit_text(config->height, "m"));
    CLX_CHECK(config->rolling_friction > 0.0 || config->rolling_model == CLAST_DEM_ROLL_TORQUE,
              CLAST_E_CONFIG, "rolling_model spring acts with rolling_friction above 0 alone");
    CLX_CHECK(
        config->law == CLAST_DEM_LINEAR || config->contact_scheme == CLAST_DEM_EXPLICIT,
        CLAST_E_CONFIG,
        "contact_scheme exact is for law linear: Hertz's spring stiffens within a step, which "
        "constants of a step do not follow; take contact_scheme explicit with law hertz");
    CLX_TRY(check_cohesion(config));
    CLX_TRY(check_fluid(config));
done:
    return status;
}
