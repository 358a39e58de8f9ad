// Spheres of packing-generation's .xyzd: little-endian doubles x, y, z, diameter.
#include "io/packing.h"

#include "base/status.h"
#include "io/bytes.h"
#include <clast/table.h>

clast_status clx_xyzd(const char *path, const char *bytes, int64_t n, clast_table *table)
{
    static const char *const name[4] = {"x", "y", "z", "diameter"};
    enum { RECORD = 32 };
    clast_status status = CLAST_OK;
    clast_table made = {0};
    CLX_CHECK(n > 0 && n % RECORD == 0, CLAST_E_FORMAT,
              "%s: %lld bytes are no whole number of records of four doubles x, y, z, diameter",
              path, (long long)n);
    CLX_TRY(clast_table_init(&made, "packing", n / RECORD));
    for (int k = 0; k < 4; ++k) {
        double *value = NULL;
        CLX_TRY(clast_table_add_number(&made, name[k], "-", &value));
        for (int64_t i = 0; i < made.n_row; ++i) {
            value[i] = clx_load_f64((const uint8_t *)bytes + i * RECORD + 8 * k);
        }
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}
