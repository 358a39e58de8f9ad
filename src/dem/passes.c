// The work of a step: one sweep, or contacts and motion in two passes.
#include "dem/dem.h"
#include "dem/energy.h"

static bool verifies(const clast_dem *dem)
{
    return dem->config.verify > 0 && dem->step % dem->config.verify == 0;
}

clast_status clx_pass_contacts(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_inner_list *inner = &dem->inner;
    clx_inner_unpack(dem);
    if (!inner->is_gathered) {
        CLX_TRY(clx_inner_gather(dem));
    }
    if (dem->energy != NULL) {
        CLX_TRY(clx_energy_before(dem));
    }
    clx_contacts(dem);
    if (verifies(dem)) {
        clx_verify(dem);
    }
    if (dem->walls.is_watched) {
        CLX_TRY(clx_walls_add_forces(dem));
    }
    if (dem->energy != NULL) {
        clx_energy_grains(dem);
    }
done:
    return status;
}

bool clx_pass_motion(clast_dem *dem)
{
    if (dem->energy != NULL) {
        clx_energy_contacts(dem);
    }
    const bool is_fine = clx_move(dem);
    if (dem->energy != NULL) {
        clx_energy_after(dem);
    }
    return is_fine;
}

clast_status clx_contacts_and_motion(clast_dem *dem, bool *is_fine)
{
    if (!verifies(dem) && dem->item == NULL && dem->container == NULL && dem->energy == NULL &&
        !dem->walls.is_watched) {
        return clx_sweep(dem, is_fine);
    }
    const clast_status status = clx_pass_contacts(dem);
    *is_fine = status != CLAST_OK || clx_pass_motion(dem);
    return status;
}
