// A bed to begin with: a run's state, or spheres of another program.
#include "io/start_file.h"

#include "base/alloc.h"
#include "base/path.h"
#include <clast/field.h>
#include <clast/state.h>
#include <string.h>
#include <sys/stat.h>

static bool is_folder(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && S_ISDIR(s.st_mode);
}

/// Lengths to metres.
static void scale_all(clast_assembly *a, double factor)
{
    for (int32_t i = 0; i < a->n_grain; ++i) {
        a->scale[i] *= factor;
        for (int k = 0; k < 3; ++k) {
            a->position[i][k] *= factor;
        }
    }
}

static clast_status to_metres(const clast_pack_config *c, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    const bool is_model = a->unit[0] == '\0' || strcmp(a->unit, "model") == 0;
    double factor = 1.0;
    CLX_CHECK(!is_model || c->start_unit[0] != '\0', CLAST_E_CONFIG,
              "the unit of its lengths is not known; give it (start_unit: mm)");
    CLX_CHECK(is_model || c->start_unit[0] == '\0' || strcmp(c->start_unit, a->unit) == 0,
              CLAST_E_CONFIG, "its lengths are in %s, not in %s (start_unit)", a->unit,
              c->start_unit);
    CLX_TRY(clast_unit_factor(is_model ? c->start_unit : a->unit, "m", &factor));
    scale_all(a, factor);
done:
    return status;
}

static clast_status read_state(const clast_pack_config *c, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(c->start_columns[0] == '\0' && c->start_diameter == 0.0, CLAST_E_CONFIG,
              "start_columns and start_diameter are for packings of spheres from other programs");
    CLX_CHECK(c->density.n == 1 && c->density.item[0] == 2650.0, CLAST_E_CONFIG,
              "density is the state's own; leave it out");
    CLX_TRY(clast_state_read_assembly(c->start, a));
done:
    return status;
}

static clast_status read_spheres(const clast_pack_config *c, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    const clast_packing_options o = {.columns = c->start_columns, .diameter = c->start_diameter};
    CLX_CHECK(c->density.n == 1 && c->density.item[0] > 0.0, CLAST_E_CONFIG,
              "spheres of another program have one density, above 0 (density)");
    CLX_TRY(clast_packing_read(c->start, &o, a));
    for (int32_t i = 0; i < a->n_grain; ++i) {
        a->density[i] = c->density.item[0];
    }
done:
    return status;
}

clast_status clx_start_read(const clast_pack_config *config, clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    clast_assembly made = {0};
    const bool is_state = clx_path_is(config->start, "h5");
    CLX_CHECK(!is_folder(config->start), CLAST_E_CONFIG, "%s is a folder; give the state.h5 in it",
              config->start);
    CLX_TRY(is_state ? read_state(config, &made) : read_spheres(config, &made));
    CLX_CHECK(made.n_grain > 0, CLAST_E_GEOMETRY, "%s holds no grain", config->start);
    CLX_TRY(to_metres(config, &made));
    *assembly = made;
    made = (clast_assembly){0};
done:
    if (status != CLAST_OK) {
        clx_fail_prefix("start");
    }
    clast_assembly_free(&made);
    return status;
}
