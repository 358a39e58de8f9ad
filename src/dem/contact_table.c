// Forces of contacts as a table.
#include "base/alloc.h"
#include "dem/dem.h"
#include "dem/pair_force.h"
#include <clast/table.h>

static const struct {
    const char *name, *unit;
} columns[] = {{"a", "-"},          {"b", "-"},         {"centre_z_m", "m"}, {"x_m", "m"},
               {"y_m", "m"},        {"z_m", "m"},       {"branch_x_m", "m"}, {"branch_y_m", "m"},
               {"branch_z_m", "m"}, {"force_x_N", "N"}, {"force_y_N", "N"},  {"force_z_N", "N"},
               {"normal_x", "-"},   {"normal_y", "-"},  {"normal_z", "-"}};
enum { N_COLUMN = sizeof columns / sizeof columns[0] };

/// Numbers of one contact, from copies, so that its history stays; false if it is none.
static bool measure_contact(const clast_dem *dem, const clx_dem_pair *pair, double out[N_COLUMN])
{
    clx_dem_pair copy = *pair;
    const clx_contact_history *own = clx_pair_history(dem, pair);
    clx_contact_history history = own != NULL ? *own : (clx_contact_history){0};
    clx_dem_touch t;
    clx_force_torque on_a = {0};
    clx_force_torque on_b = {0};
    const int32_t a = clx_item_grain(dem, pair->a);
    if (!clx_pair_holds(dem, pair, &t)) {
        return false;
    }
    clx_add_pair_force(dem, &copy, &history, &t, &on_a, &on_b);
    if (dem->config.clump_contacts == CLAST_DEM_SHARED) {
        v3_scale(on_a.force, 1.0 / clx_sub_contacts(dem, pair), on_a.force);
    }
    out[0] = a;
    out[1] = pair->b >= 0 ? clx_item_grain(dem, pair->b) : -1;
    out[2] = dem->grain[a].position[2];
    for (int k = 0; k < 3; ++k) {
        out[3 + k] = dem->grain[a].position[k] + t.arm_a[k];
        out[6 + k] = pair->b >= 0 ? t.arm_a[k] - t.arm_b[k] : t.arm_a[k];
        out[9 + k] = -on_a.force[k];
        out[12 + k] = t.normal[k];
    }
    return true;
}

clast_status clast_dem_contact_table(const clast_dem *dem, clast_table *table)
{
    CLX_ARGUMENTS(dem, table);
    clast_status status = CLAST_OK;
    clast_table made = {0};
    int64_t n = 0;
    for (int64_t k = 0; k < dem->list.n_pair; ++k) {
        n += dem->list.pair[k].touches != 0 ? 1 : 0;
    }
    CLX_TRY(clast_table_init(&made, "contacts", n));
    for (int c = 0; c < N_COLUMN; ++c) {
        CLX_TRY(clast_table_add_number(&made, columns[c].name, columns[c].unit, NULL));
    }
    int64_t row = 0;
    for (int64_t k = 0; k < dem->list.n_pair; ++k) {
        double value[N_COLUMN];
        if (measure_contact(dem, &dem->list.pair[k], value)) {
            for (int c = 0; c < N_COLUMN; ++c) {
                made.column[c].number[row] = value[c];
            }
            ++row;
        }
    }
    CLX_TRY(clast_table_resize(&made, row));
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}
