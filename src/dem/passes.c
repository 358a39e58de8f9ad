// The work of a step: one sweep, or contacts and motion in two passes.
#include "dem/dem.h"
#include "dem/energy.h"

/// Contacts, then motion, of all grains.
static clast_status step_in_passes(clast_dem *dem, bool verifies, bool *is_fine)
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
    if (verifies) {
        clx_verify(dem);
    }
    if (dem->walls.is_watched) {
        CLX_TRY(clx_walls_add_forces(dem));
    }
    if (dem->energy != NULL) {
        clx_energy_forces(dem);
    }
    *is_fine = clx_move(dem);
    if (dem->energy != NULL) {
        clx_energy_after(dem);
    }
done:
    return status;
}

clast_status clx_contacts_and_motion(clast_dem *dem, bool *is_fine)
{
    const bool verifies = dem->config.verify > 0 && dem->step % dem->config.verify == 0;
    return verifies || dem->item != NULL || dem->container != NULL || dem->energy != NULL ||
                   dem->walls.is_watched
               ? step_in_passes(dem, verifies, is_fine)
               : clx_sweep(dem, is_fine);
}
