// Packings of spheres from other programs' files.
#include <clast/state.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include "io/bytes.h"
#include "io/spheres_table.h"
#include "io/text.h"
#include <clast/assembly.h>
#include <clast/cloud.h>
#include <clast/table.h>
#include <stdio.h>

#define BYTE_LIMIT (INT64_C(16) << 30)

/// Little-endian doubles x, y, z, diameter.
static clast_status parse_xyzd(const char *path, const char *bytes, int64_t n, clast_table *table)
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

/// Where the atoms of an .xyz begin: after the count and a comment; 0 where there is no count.
static int64_t skip_count(const char *bytes, int64_t n)
{
    clx_text text = clx_text_begin(bytes, (size_t)n, 0, false);
    clx_word word;
    int64_t count = 0;
    if (!clx_text_word(&text, &word) || !clx_word_integer(word, &count) ||
        clx_text_word(&text, &word) || !clx_text_next_line(&text) || !clx_text_next_line(&text)) {
        return 0;
    }
    return text.at - bytes;
}

static clast_status parse(const char *path, const char *bytes, int64_t n, clast_table *table)
{
    static const clast_csv_options atoms = {.separator = ' ', .no_comment = true, .header = -1};
    if (clx_path_is(path, "xyzd")) {
        return parse_xyzd(path, bytes, n, table);
    }
    const int64_t begin = clx_path_is(path, "xyz") ? skip_count(bytes, n) : 0;
    return begin > 0 ? clast_table_parse_csv(path, bytes + begin, (size_t)(n - begin), &atoms,
                                             table, NULL)
                     : clast_cloud_parse(path, bytes, (size_t)n, NULL, table);
}

static clast_status add_spheres(const clast_spheres *spheres, bool in_metres,
                                clast_assembly *assembly)
{
    static const double upright[4] = {1.0, 0.0, 0.0, 0.0};
    clast_status status = CLAST_OK;
    clast_shape ball = {0};
    CLX_TRY(clast_shape_sphere("sphere", 1.0, &ball));
    CLX_TRY(clast_assembly_add_shape(assembly, &ball, NULL));
    (void)snprintf(assembly->unit, sizeof assembly->unit, "%s", in_metres ? "m" : "model");
    for (int32_t i = 0; i < spheres->n; ++i) {
        CLX_TRY(clast_assembly_add_grain(assembly, 0, spheres->centre[i], upright,
                                         spheres->radius[i], 1.0));
    }
done:
    clast_shape_free(&ball);
    return status;
}

clast_status clast_packing_read(const char *path, const clast_packing_options *options,
                                clast_assembly *assembly)
{
    CLX_ARGUMENTS(path, assembly);
    static const clast_packing_options guess = {0};
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    int64_t n = 0;
    double unit_m = 0.0;
    clast_table table = {0};
    clast_spheres spheres = {0};
    clast_assembly made = {0};
    CLX_TRY(clx_file_read_all(path, BYTE_LIMIT, &bytes, &n));
    CLX_TRY(parse(path, bytes, n, &table));
    CLX_TRY(clx_spheres_of_table(&table, options != NULL ? options : &guess, &spheres, &unit_m));
    CLX_TRY(add_spheres(&spheres, unit_m > 0.0, &made));
    *assembly = made;
    made = (clast_assembly){0};
done:
    if (status != CLAST_OK && table.n_column > 0) { // the readers name the file themselves
        clx_fail_prefix("%s", path);
    }
    clx_free(bytes);
    clast_table_free(&table);
    clast_spheres_free(&spheres);
    clast_assembly_free(&made);
    return status;
}
