// Any bytes are a table or one line of complaint.
#include <clast/table.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    clast_table table = {0};
    clast_csv_report report;
    clast_csv_options options = {0};
    if (n > 0) { // the first byte picks the options
        static const char separators[] = {0, ',', ';', '\t', ' ', '|', 0, 0};
        options.separator = separators[bytes[0] & 7];
        options.header = (bytes[0] >> 3 & 3) - 1;
        options.no_comment = (bytes[0] & 32) != 0;
    }
    if (clast_table_parse_csv("fuzz", bytes + (n > 0), n > 0 ? n - 1 : 0, &options, &table,
                              &report) == CLAST_OK) {
        volatile double sum = 0.0; // touches every cell
        for (int32_t c = 0; c < table.n_column; ++c) {
            for (int64_t i = 0; i < table.n_row; ++i) {
                sum += table.column[c].number != NULL ? table.column[c].number[i]
                                                      : table.column[c].text[i][0];
            }
        }
        (void)sum;
    }
    clast_table_free(&table);
    return 0;
}
