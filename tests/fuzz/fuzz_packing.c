// Any bytes are a LAMMPS data file, YADE's text or a configuration of Rockable with its shapes
// behind a zero byte, or one line of complaint.
#include "io/packing.h"
#include <clast/assembly.h>
#include <clast/state.h>
#include <clast/status.h>
#include <clast/table.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

/// A grain is there with a size and a turn, or nothing is.
static void check(clast_status status, const clast_assembly *a)
{
    if (status != CLAST_OK && strchr(clast_error_detail(), '\n') != NULL) {
        abort();
    }
    for (int32_t i = 0; status == CLAST_OK && i < a->n_grain; ++i) {
        if (!(a->scale[i] > 0.0) || !(a->density[i] > 0.0) || a->shape_id[i] >= a->n_shape) {
            abort();
        }
    }
}

static void read_data(const uint8_t *bytes, size_t n)
{
    const clx_packing_wanted wanted = {.frame = -1};
    clast_packing_frame frame;
    clast_table table = {0};
    clast_assembly a = {0};
    char unit[16];
    clast_status status = clx_lammps_data("fuzz", bytes, n, &table, &frame);
    if (status == CLAST_OK) {
        status = clx_packing_of_table(&table, &wanted.spheres, true, &a, unit);
    }
    if (status == CLAST_OK) {
        status = clx_packing_densities(&table, &wanted, true, NULL, &a);
    }
    check(status, &a);
    clast_table_free(&table);
    clast_assembly_free(&a);
}

static void read_yade(const uint8_t *bytes, size_t n)
{
    char columns[CLX_YADE_COLUMNS];
    clast_table table = {0};
    clast_assembly a = {0};
    char unit[16];
    if (!clx_yade_columns(bytes, n, columns)) {
        return;
    }
    const clx_spheres_wanted wanted = {.options = {.columns = columns}};
    clast_status status = clast_table_parse_csv("fuzz", bytes, n, NULL, &table, NULL);
    if (status == CLAST_OK && table.n_row < 1000) {
        status = clx_packing_of_table(&table, &wanted, false, &a, unit);
    }
    check(status, &a);
    clast_table_free(&table);
    clast_assembly_free(&a);
}

static void read_rockable(const uint8_t *bytes, size_t n)
{
    clast_assembly a = {0};
    const char *text = (const char *)bytes;
    const char *zero = memchr(text, 0, n);
    const char *shapes = zero != NULL ? zero + 1 : text + n;
    clx_rockable_files files = {.name = "fuzz",
                                .bytes = text,
                                .n = (size_t)((zero != NULL ? zero : text + n) - text),
                                .shapes = shapes,
                                .n_shape = (size_t)(text + n - shapes)};
    clast_status status = clx_rockable_library(&files);
    if (status == CLAST_OK) {
        status = clx_rockable(&files, &a);
    }
    check(status, &a);
    clast_assembly_free(&a);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    if (n == 0) {
        return 0;
    }
    if (clx_is_lammps_data(bytes, n)) {
        read_data(bytes, n);
    }
    read_yade(bytes, n);
    read_rockable(bytes, n);
    return 0;
}
