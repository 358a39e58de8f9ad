// Contacts that differ by the materials of their two sides. [docs/theory/dem.md "Materials"]
#include "base/alloc.h"
#include "dem/dem.h"
#include <math.h>

clast_dem_contact clast_dem_contact_of(const clast_dem_config *c, bool at_wall)
{
    if (c == NULL) {
        return (clast_dem_contact){0};
    }
    return (clast_dem_contact){.friction = at_wall && c->wall_friction >= 0.0 ? c->wall_friction
                                                                              : c->friction,
                               .rolling_friction = c->rolling_friction,
                               .restitution = c->restitution,
                               .collision_time = c->collision_time,
                               .young = {c->young, c->young},
                               .poisson = {c->poisson, c->poisson}};
}

clast_status clx_dem_check_contact(const clast_dem_config *config, const clast_dem_contact *c)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(c->friction >= 0.0 && isfinite(c->friction), CLAST_E_CONFIG, "friction %g",
              c->friction);
    CLX_CHECK(c->rolling_friction >= 0.0 && isfinite(c->rolling_friction), CLAST_E_CONFIG,
              "rolling_friction %g", c->rolling_friction);
    CLX_CHECK(c->collision_time > 0.0 && isfinite(c->collision_time), CLAST_E_CONFIG,
              "collision_time %s", clx_unit_text(c->collision_time, "s"));
    for (int k = 0; k < 2; ++k) {
        CLX_CHECK(c->young[k] > 0.0 && isfinite(c->young[k]), CLAST_E_CONFIG, "young %s",
                  clx_unit_text(c->young[k], "Pa"));
        CLX_CHECK(c->poisson[k] >= 0.0 && c->poisson[k] <= 0.5, CLAST_E_CONFIG, "poisson %g",
                  c->poisson[k]);
    }
    const clast_dem_config own = clx_law_config(config, c);
    CLX_TRY(clx_dem_check(&own));
done:
    return status;
}

clast_status clast_dem_set_contacts(clast_dem *dem, int32_t n, const clast_dem_contact *contact)
{
    CLX_ARGUMENTS(dem, contact);
    clast_status status = CLAST_OK;
    clx_law *law = NULL;
    bool has_history = dem->law.has_history;
    bool are_plain = true;
    double adhesion = 0.0;
    CLX_CHECK(n >= 1 && n <= CLX_MOST_MATERIALS, CLAST_E_USAGE, "%d materials: 1 to %d", n,
              CLX_MOST_MATERIALS);
    CLX_CHECK(dem->n_grain == 0 && dem->laws.n == 0, CLAST_E_USAGE,
              "contacts by materials are given once, before the first grain");
    CLX_TRY(clx_walls_begin(dem));
    CLX_TRY(clx_alloc(&law, (int64_t)n * n, sizeof *law));
    for (int32_t a = 0; a < n; ++a) {
        for (int32_t b = a; b < n; ++b) {
            const clast_dem_contact *c = &contact[a * n + b];
            status = clx_dem_check_contact(&dem->config, c);
            if (status != CLAST_OK) {
                clx_fail_prefix("materials %d and %d", a, b);
                goto done;
            }
            law[a * n + b] = law[b * n + a] = clx_law_of_contact(&dem->config, c);
            has_history = has_history || law[a * n + b].has_history;
            are_plain = are_plain && clx_law_is_plain(&law[a * n + b]);
            adhesion = fmax(adhesion, law[a * n + b].adhesion);
        }
    }
    dem->laws = (clx_laws){n, law, are_plain, adhesion};
    dem->law.has_history = has_history;
    law = NULL;
done:
    clx_free(law);
    return status;
}

clast_status clast_dem_set_material(clast_dem *dem, int32_t shape, int32_t material)
{
    CLX_ARGUMENTS(dem);
    clast_status status = CLAST_OK;
    CLX_CHECK(shape >= 0 && shape < dem->n_body, CLAST_E_USAGE, "there is no shape %d of %d", shape,
              dem->n_body);
    CLX_CHECK(material >= 0 && material < dem->laws.n, CLAST_E_USAGE,
              "there is no material %d of %d", material, dem->laws.n);
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        CLX_CHECK(dem->grain[i].shape != shape, CLAST_E_USAGE,
                  "shape %d has grains already: its material is set before", shape);
    }
    dem->body[shape].material = material;
done:
    return status;
}

clast_status clast_dem_set_wall_material(clast_dem *dem, int32_t wall, int32_t material)
{
    CLX_ARGUMENTS(dem);
    clast_status status = CLAST_OK;
    CLX_CHECK(wall >= 0 && wall < dem->walls.n, CLAST_E_USAGE, "there is no wall %d of %d", wall,
              dem->walls.n);
    CLX_CHECK(material >= 0 && material < dem->laws.n, CLAST_E_USAGE,
              "there is no material %d of %d", material, dem->laws.n);
    dem->walls.body[wall].material = material;
done:
    return status;
}

bool clx_grains_rub(const clast_dem *dem)
{
    const int32_t n = dem->laws.n;
    bool is_used[CLX_MOST_MATERIALS] = {false};
    bool rub = n == 0 && dem->law.friction[0] > 0.0;
    for (int32_t i = 0; i < dem->n_body && n > 0; ++i) {
        is_used[dem->body[i].material] = true;
    }
    for (int32_t k = 0; k < n * n; ++k) {
        rub = rub || (is_used[k / n] && is_used[k % n] && dem->laws.law[k].friction[0] > 0.0);
    }
    return rub;
}
