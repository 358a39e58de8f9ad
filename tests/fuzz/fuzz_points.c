// Any bytes are points in one of the formats or one line of complaint.
#include <clast/cloud.h>

#include <clast/status.h>
#include <clast/table.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    clast_table table = {0};
    const clast_points_options last = {.frame = -1};
    if (clast_cloud_parse("fuzz", bytes, n, n % 2 == 0 ? NULL : &last, &table) == CLAST_OK) {
        volatile double sum = 0.0; // touches every cell
        for (int32_t c = 0; c < table.n_column; ++c) {
            for (int64_t i = 0; i < table.n_row; ++i) {
                sum += table.column[c].number != NULL ? table.column[c].number[i]
                                                      : table.column[c].text[i][0];
            }
        }
        (void)sum;
    } else if (table.column != NULL || strchr(clast_error_detail(), '\n') != NULL) {
        abort();
    }
    clast_table_free(&table);
    return 0;
}
