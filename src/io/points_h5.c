// An HDF5 array [n] or [n][k], or a folder of arrays [n], as columns; any type of number, plain,
// shuffled, deflated or with checksums.
#include "io/h5_inside.h"
#include "io/points.h"

#include "base/alloc.h"
#include "base/column_unit.h"
#include <clast/table.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { WIDTH_LIMIT = 4096, MOST_RATIO = 1032, MOST_PROPERTIES = 16 };

/// Sizes and storage of an open array; *n rows of *width numbers that the file can hold.
static clast_status check_array(const clx_h5 *h5, const char *name, hid_t set, int64_t *n,
                                int64_t *width)
{
    clast_status status = CLAST_OK;
    hsize_t size[2] = {0, 1};
    const hid_t space = H5Dget_space(set);
    const hid_t type = H5Dget_type(set);
    const hid_t create = H5Dget_create_plist(set);
    CLX_CHECK(space >= 0 && type >= 0 && create >= 0, CLAST_E_FORMAT, "%s: array %s is damaged",
              h5->label, name);
    const int rank = H5Sis_simple(space) > 0 ? H5Sget_simple_extent_ndims(space) : 0;
    const H5T_class_t kind = H5Tget_class(type);
    CLX_CHECK((rank == 1 || rank == 2) && (kind == H5T_FLOAT || kind == H5T_INTEGER),
              CLAST_E_FORMAT, "%s: %s is not an array [n] or [n][k] of numbers", h5->label, name);
    (void)H5Sget_simple_extent_dims(space, size, NULL);
    CLX_CHECK(size[1] <= MOST_PROPERTIES || size[0] >= size[1], CLAST_E_FORMAT,
              "%s: array %s has %" PRIu64 " rows of %" PRIu64
              " numbers, and a row is a point: give its transpose [%" PRIu64 "][%" PRIu64 "]",
              h5->label, name, (uint64_t)size[0], (uint64_t)size[1], (uint64_t)size[1],
              (uint64_t)size[0]);
    CLX_CHECK(size[1] >= 1 && size[1] <= WIDTH_LIMIT && size[0] < (hsize_t)1 << 40, CLAST_E_FORMAT,
              "%s: array %s has %" PRIu64 " x %" PRIu64 " numbers", h5->label, name,
              (uint64_t)size[0], (uint64_t)size[1]);
    const H5D_layout_t layout = H5Pget_layout(create);
    CLX_CHECK(layout >= H5D_COMPACT && layout <= H5D_CHUNKED && H5Pget_external_count(create) == 0,
              CLAST_E_FORMAT, "%s: array %s is kept outside the file", h5->label, name);
    const uint64_t stored =
        (uint64_t)H5Dget_storage_size(set) * (H5Pget_nfilters(create) > 0 ? MOST_RATIO : 1);
    CLX_CHECK(size[0] * size[1] <= stored, CLAST_E_FORMAT,
              "%s: array %s declares more numbers than are stored", h5->label, name);
    *n = (int64_t)size[0];
    *width = (int64_t)size[1];
done:
    (void)(space >= 0 && H5Sclose(space));
    (void)(type >= 0 && H5Tclose(type));
    (void)(create >= 0 && H5Pclose(create));
    return status;
}

/// "millimeters" as "mm".
static void to_symbol(char unit[CLX_COLUMN_UNIT])
{
    static const char *const metre[] = {"meter", "meters", "metre", "metres"};
    static const char *const prefix[][2] = {{"", ""},       {"kilo", "k"},  {"centi", "c"},
                                            {"milli", "m"}, {"micro", "u"}, {"nano", "n"}};
    for (size_t k = 0; k < sizeof prefix / sizeof prefix[0]; ++k) {
        const size_t n = strlen(prefix[k][0]);
        for (size_t j = 0; j < sizeof metre / sizeof metre[0]; ++j) {
            if (strncasecmp(unit, prefix[k][0], n) == 0 && strcasecmp(unit + n, metre[j]) == 0) {
                (void)snprintf(unit, CLX_COLUMN_UNIT, "%sm", prefix[k][1]);
                return;
            }
        }
    }
}

/// What the array's attribute "units" or "unit" says, "" for none.
static void read_unit(hid_t set, char unit[CLX_COLUMN_UNIT])
{
    static const char *const name[] = {"units", "unit"};
    unit[0] = '\0';
    for (size_t k = 0; k < sizeof name / sizeof name[0] && unit[0] == '\0'; ++k) {
        const bool is_there = H5Aexists(set, name[k]) > 0;
        const hid_t of = is_there ? H5Aopen(set, name[k], H5P_DEFAULT) : H5I_INVALID_HID;
        const hid_t type = of >= 0 ? H5Aget_type(of) : H5I_INVALID_HID;
        const hid_t space = of >= 0 ? H5Aget_space(of) : H5I_INVALID_HID;
        const bool is_text = type >= 0 && H5Tget_class(type) == H5T_STRING && space >= 0 &&
                             H5Sget_simple_extent_npoints(space) == 1;
        char *text = NULL;
        if (is_text && H5Tis_variable_str(type) > 0) {
            if (H5Aread(of, type, &text) >= 0 && text != NULL) {
                (void)snprintf(unit, CLX_COLUMN_UNIT, "%s", text);
                (void)H5free_memory(text);
            }
        } else if (is_text && H5Tget_size(type) < CLX_COLUMN_UNIT) {
            unit[H5Tget_size(type)] = '\0';
            unit[H5Aread(of, type, unit) >= 0 ? CLX_COLUMN_UNIT - 1 : 0] = '\0';
        }
        (void)(space >= 0 && H5Sclose(space));
        (void)(type >= 0 && H5Tclose(type));
        (void)(of >= 0 && H5Aclose(of));
    }
    to_symbol(unit);
}

/// Columns from `first` on are in a unit.
static clast_status tell_unit(clast_table *table, int32_t first, const char *unit)
{
    clast_status status = CLAST_OK;
    for (int32_t k = first; k < table->n_column && unit[0] != '\0'; ++k) {
        char *text = NULL;
        CLX_TRY(clx_alloc_text(&text, unit));
        clx_free(table->column[k].unit);
        table->column[k].unit = text;
    }
done:
    return status;
}

static clast_status add_values(clast_table *table, const char *name, int64_t width,
                               const double *value)
{
    static const char *const axis[3] = {"x", "y", "z"};
    clast_status status = CLAST_OK;
    for (int64_t k = 0; k < width && width > 3; ++k) { // x, y, z, c3, ...
        char column[32];
        double *number = NULL;
        if (k < 3) {
            (void)snprintf(column, sizeof column, "%s", axis[k]);
        } else {
            (void)snprintf(column, sizeof column, "c%" PRId64, k);
        }
        CLX_TRY(clast_table_add_number(table, column, "-", &number));
        for (int64_t i = 0; i < table->n_row; ++i) {
            number[i] = value[i * width + k];
        }
    }
    if (width <= 3) {
        CLX_TRY(clx_points_add(table, width > 1 ? "" : name, width, value));
    }
done:
    return status;
}

/// What is read of a file: some rows, or their number alone.
typedef struct {
    const clx_rows *rows; ///< NULL: all
    int64_t *n_row;       ///< NULL: the rows themselves
} wish;

/// Numbers [rows->n][width] of the array.
static bool read_rows(hid_t set, const clx_rows *rows, int64_t width, int rank, double *value)
{
    const hsize_t first[2] = {(hsize_t)rows->first, 0};
    const hsize_t size[2] = {(hsize_t)rows->n, (hsize_t)width};
    if (rows->n == 0) {
        return true;
    }
    const hid_t file = H5Dget_space(set);
    const hid_t memory = H5Screate_simple(rank, size, NULL);
    const bool is_read = file >= 0 && memory >= 0 &&
                         H5Sselect_hyperslab(file, H5S_SELECT_SET, first, NULL, size, NULL) >= 0 &&
                         H5Dread(set, H5T_NATIVE_DOUBLE, memory, file, H5P_DEFAULT, value) >= 0;
    (void)(file >= 0 && H5Sclose(file));
    (void)(memory >= 0 && H5Sclose(memory));
    return is_read;
}

static int rank_of(hid_t set)
{
    const hid_t space = H5Dget_space(set);
    const int rank = space >= 0 ? H5Sget_simple_extent_ndims(space) : 0;
    (void)(space >= 0 && H5Sclose(space));
    return rank;
}

/// One array into the table, which is made for the first one.
static clast_status add_array(const clx_h5 *h5, const char *path, const char *label,
                              const wish *asked, clast_table *table)
{
    clast_status status = CLAST_OK;
    double *value = NULL;
    char unit[CLX_COLUMN_UNIT];
    int64_t n = 0;
    int64_t width = 0;
    const hid_t set = H5Dopen2(h5->file, path, H5P_DEFAULT);
    CLX_CHECK(set >= 0, CLAST_E_FORMAT, "%s: %s is damaged or not an array", h5->label, path);
    CLX_TRY(check_array(h5, path, set, &n, &width));
    if (asked->n_row != NULL) {
        CLX_CHECK(*asked->n_row < 0 || n == *asked->n_row, CLAST_E_FORMAT,
                  "%s: array %s has %" PRId64 " rows, the others have %" PRId64, h5->label, path, n,
                  *asked->n_row);
        *asked->n_row = n;
        goto done;
    }
    const clx_rows rows = asked->rows != NULL ? *asked->rows : (clx_rows){0, n};
    CLX_CHECK(rows.first >= 0 && rows.n <= n - rows.first, CLAST_E_FORMAT,
              "%s: array %s has %" PRId64 " rows, not %" PRId64, h5->label, path, n,
              rows.first + rows.n);
    n = rows.n;
    if (table->n_column == 0) {
        clast_table_free(table);
        CLX_TRY(clast_table_init(table, h5->label, n));
    }
    CLX_CHECK(n == table->n_row, CLAST_E_FORMAT,
              "%s: array %s has %" PRId64 " rows, the others have %" PRId64, h5->label, path, n,
              table->n_row);
    CLX_TRY(clx_alloc(&value, n * width, sizeof *value));
    CLX_CHECK(read_rows(set, &rows, width, rank_of(set), value), CLAST_E_FORMAT,
              "%s: array %s is damaged or packed in a way that is not read", h5->label, path);
    const int32_t first = table->n_column;
    CLX_TRY(add_values(table, label, width, value));
    read_unit(set, unit);
    CLX_TRY(tell_unit(table, first, unit));
done:
    clx_free(value);
    if (set >= 0) {
        (void)H5Dclose(set);
    }
    return status;
}

static bool is_array(const clx_h5 *h5, const char *path)
{
    H5O_info_t info;
    return H5Oget_info_by_name(h5->file, path, &info, H5P_DEFAULT) >= 0 &&
           info.type == H5O_TYPE_DATASET;
}

/// All arrays [n] of a folder, in order of name; others are left out.
static clast_status add_folder(clx_h5 *h5, const char *path, int64_t n_member, const wish *asked,
                               clast_table *table)
{
    clast_status status = CLAST_OK;
    for (int64_t k = 0; k < n_member; ++k) {
        char label[CLX_H5_NAME_LIMIT];
        char whole[2 * CLX_H5_NAME_LIMIT];
        CLX_TRY(clx_h5_member(h5, path, k, label));
        (void)snprintf(whole, sizeof whole, "%s%s%s", path, strcmp(path, "/") == 0 ? "" : "/",
                       label);
        if (!clx_h5_has(h5, whole)) {
            continue;
        }
        const clx_h5_session session = clx_h5_enter();
        status = is_array(h5, whole) ? add_array(h5, whole, label, asked, table) : CLAST_OK;
        clx_h5_leave(&session);
        CLX_TRY(status);
    }
    CLX_CHECK(table->n_column > 0 || (asked->n_row != NULL && *asked->n_row >= 0), CLAST_E_FORMAT,
              "%s: %s holds no array of numbers", h5->label, path);
done:
    return status;
}

static clast_status read_points(const char *path, const char *dataset, const wish *asked,
                                clast_table *table)
{
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    clast_table made = {0};
    char name[CLX_H5_NAME_LIMIT];
    const char *wanted = dataset != NULL && dataset[0] != '\0' ? dataset : "/";
    CLX_CHECK(snprintf(name, sizeof name, "%s%s", wanted[0] == '/' ? "" : "/", wanted) <
                  (int)sizeof name,
              CLAST_E_USAGE, "the dataset's name is too long");
    CLX_TRY(clx_h5_open_foreign(path, &h5));
    CLX_CHECK(strcmp(name, "/") == 0 || clx_h5_has(h5, name), CLAST_E_FORMAT,
              "%s: there is no array or folder %s", path, name);
    const clx_h5_session session = clx_h5_enter();
    const bool array = strcmp(name, "/") != 0 && is_array(h5, name);
    if (array) {
        status = add_array(h5, name, strrchr(name, '/') + 1, asked, &made);
    }
    clx_h5_leave(&session);
    CLX_TRY(status);
    if (!array) {
        int64_t n_member = 0;
        CLX_TRY(clx_h5_count(h5, name, &n_member));
        CLX_TRY(add_folder(h5, name, n_member, asked, &made));
    }
    *table = made;
    made = (clast_table){0};
done:
    clx_h5_close(h5);
    clast_table_free(&made);
    return status;
}

clast_status clx_points_h5(const char *path, const char *dataset, const clx_rows *rows,
                           clast_table *table)
{
    const wish asked = {rows, NULL};
    return read_points(path, dataset, &asked, table);
}

clast_status clx_points_h5_rows(const char *path, const char *dataset, int64_t *n_row)
{
    const wish asked = {NULL, n_row};
    clast_table none = {0};
    *n_row = -1;
    const clast_status status = read_points(path, dataset, &asked, &none);
    clast_table_free(&none);
    return status;
}
