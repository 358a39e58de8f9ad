// Packings from other programs' files.
#include <clast/state.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include "io/packing.h"
#include "io/text.h"
#include <clast/assembly.h>
#include <clast/cloud.h>
#include <clast/table.h>
#include <stdio.h>
#include <string.h>

#define BYTE_LIMIT (INT64_C(16) << 30)

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
        return clx_xyzd(path, bytes, n, table);
    }
    if (clx_is_lammps_data(bytes, (size_t)n)) {
        return clx_lammps_data(path, bytes, (size_t)n, table);
    }
    const int64_t begin = clx_path_is(path, "xyz") ? skip_count(bytes, n) : 0;
    return begin > 0 ? clast_table_parse_csv(path, bytes + begin, (size_t)(n - begin), &atoms,
                                             table, NULL)
                     : clast_cloud_parse(path, bytes, (size_t)n, NULL, table);
}

/// A table of grains; its columns are the options', or those that YADE names.
static clast_status read_table(const char *path, const char *bytes, int64_t n,
                               const clast_packing_options *options, clast_assembly *assembly,
                               bool *has_density)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    clast_packing_options o = *options;
    char columns[CLX_YADE_COLUMNS];
    const bool is_lammps =
        clx_is_lammps_data(bytes, (size_t)n) || (n > 5 && memcmp(bytes, "ITEM:", 5) == 0);
    if ((o.columns == NULL || o.columns[0] == '\0') &&
        clx_yade_columns(bytes, (size_t)n, columns)) {
        o.columns = columns;
    }
    CLX_TRY(parse(path, bytes, n, &table));
    CLX_TRY(clx_packing_of_table(&table, &o, is_lammps, assembly, has_density));
done:
    if (status != CLAST_OK && table.n_column > 0) { // the readers name the file themselves
        clx_fail_prefix("%s", path);
    }
    clast_table_free(&table);
    return status;
}

/// A file that stands beside another one, unless its name begins at the root.
static clast_status beside(const char *path, const char *name, char out[8192])
{
    const char *slash = strrchr(path, '/');
    const int folder = name[0] == '/' || slash == NULL ? 0 : (int)(slash - path) + 1;
    const int n = snprintf(out, 8192, "%.*s%s", folder, path, name);
    return n > 0 && n < 8192
               ? CLAST_OK
               : clx_fail(CLAST_E_USAGE, "%s: the path of its shapes is too long", path);
}

static clast_status read_rockable(const char *path, const char *bytes, int64_t n,
                                  clast_assembly *assembly, bool *has_density)
{
    clast_status status = CLAST_OK;
    clx_rockable_files files = {.name = path, .bytes = bytes, .n = (size_t)n};
    char place[8192];
    char *shapes = NULL;
    int64_t n_shape = 0;
    CLX_TRY(clx_rockable_library(&files));
    CLX_TRY(beside(path, files.library, place));
    CLX_TRY(clx_file_read_all(place, BYTE_LIMIT, &shapes, &n_shape));
    files.shapes = shapes;
    files.n_shape = (size_t)n_shape;
    CLX_TRY(clx_rockable(&files, assembly, has_density));
done:
    clx_free(shapes);
    return status;
}

clast_status clx_packing_read(const char *path, const clast_packing_options *options,
                              clast_assembly *assembly, bool *has_density)
{
    static const clast_packing_options guess = {0};
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    int64_t n = 0;
    clast_assembly made = {0};
    const clast_packing_options *o = options != NULL ? options : &guess;
    CLX_TRY(clx_file_read_all(path, BYTE_LIMIT, &bytes, &n));
    CLX_TRY(clx_path_is(path, "conf") ? read_rockable(path, bytes, n, &made, has_density)
                                      : read_table(path, bytes, n, o, &made, has_density));
    *assembly = made;
    made = (clast_assembly){0};
done:
    clx_free(bytes);
    clast_assembly_free(&made);
    return status;
}

clast_status clast_packing_read(const char *path, const clast_packing_options *options,
                                clast_assembly *assembly)
{
    CLX_ARGUMENTS(path, assembly);
    bool has_density = false;
    return clx_packing_read(path, options, assembly, &has_density);
}
