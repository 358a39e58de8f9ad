// Columns of a table of contacts.
#include "porosity/contact_columns.h"

#include "base/status.h"

clast_status clx_contacts_read(const clast_table *table, clx_contacts *contacts)
{
    clx_contacts made = {.n = table->n_row};
    const struct {
        const char *name;
        const double **column;
    } wanted[] = {{"a", &made.a},
                  {"b", &made.b},
                  {"centre_z_m", &made.z_a},
                  {"x_m", &made.point[0]},
                  {"y_m", &made.point[1]},
                  {"z_m", &made.point[2]},
                  {"branch_x_m", &made.branch[0]},
                  {"branch_y_m", &made.branch[1]},
                  {"branch_z_m", &made.branch[2]},
                  {"force_x_N", &made.force[0]},
                  {"force_y_N", &made.force[1]},
                  {"force_z_N", &made.force[2]}};
    clast_status status = CLAST_OK;
    for (size_t k = 0; k < sizeof wanted / sizeof wanted[0]; ++k) {
        *wanted[k].column = clast_table_numbers(table, wanted[k].name);
        CLX_CHECK(*wanted[k].column != NULL, CLAST_E_FORMAT,
                  "table '%s' holds no contact forces: no column %s", table->name, wanted[k].name);
    }
    *contacts = made;
done:
    return status;
}
