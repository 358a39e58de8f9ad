// Reading of HDF5 files that may be damaged or hostile: every size, type, filter and link is
// checked before memory is taken or a byte is read.
#include "io/h5_inside.h"

#include "base/alloc.h"
#include "base/file.h"
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

clast_status clx_h5_open_foreign(const char *path, clx_h5 **h5)
{
    clast_status status = CLAST_OK;
    clx_h5 *made = NULL;
    CLX_CHECK(access(path, R_OK) == 0, CLAST_E_IO, "cannot read %s: %s", path, clx_errno_text());
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    (void)snprintf(made->label, sizeof made->label, "%s", path);
    const clx_h5_session session = clx_h5_enter();
    made->file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    clx_h5_leave(&session);
    CLX_CHECK(made->file >= 0, CLAST_E_FORMAT, "%s is damaged or not an HDF5 file", path);
    *h5 = made;
    made = NULL;
done:
    clx_free(made);
    return status;
}

clast_status clx_h5_open(const char *path, clx_h5 **h5)
{
    const clast_status status = clx_h5_verify(path);
    return status != CLAST_OK ? status : clx_h5_open_foreign(path, h5);
}

/// Every part of the name is a hard link, so nothing outside the file is ever touched.
static bool is_inside(const clx_h5 *h5, const char *name)
{
    char part[CLX_H5_NAME_LIMIT];
    const size_t length = strlen(name);
    if (name[0] != '/' || length >= CLX_H5_NAME_LIMIT) {
        return false;
    }
    for (size_t n = 2; n <= length; ++n) {
        if (name[n] == '/' || name[n] == '\0') {
            H5L_info_t info;
            (void)snprintf(part, sizeof part, "%.*s", (int)n, name);
            if (H5Lexists(h5->file, part, H5P_DEFAULT) <= 0 ||
                H5Lget_info(h5->file, part, &info, H5P_DEFAULT) < 0 || info.type != H5L_TYPE_HARD) {
                return false;
            }
        }
    }
    return true;
}

bool clx_h5_has(clx_h5 *h5, const char *name)
{
    const clx_h5_session session = clx_h5_enter();
    const bool has = is_inside(h5, name);
    clx_h5_leave(&session);
    return has;
}

bool clx_h5_has_attribute(clx_h5 *h5, const char *object, const char *name)
{
    const clx_h5_session session = clx_h5_enter();
    const bool has = (strcmp(object, "/") == 0 || is_inside(h5, object)) &&
                     H5Aexists_by_name(h5->file, object, name, H5P_DEFAULT) > 0;
    clx_h5_leave(&session);
    return has;
}

static bool same_type(hid_t type, clx_h5_type wanted)
{
    return H5Tequal(type, clx_h5_file_type(wanted)) > 0;
}

/// Plain or Fletcher-32 alone, kept in this file, and as many bytes stored as declared.
static clast_status check_storage(const clx_h5 *h5, const char *name, hid_t set, uint64_t bytes)
{
    clast_status status = CLAST_OK;
    const hid_t create = H5Dget_create_plist(set);
    CLX_CHECK(create >= 0, CLAST_E_FORMAT, "%s: array %s is damaged", h5->label, name);
    const H5D_layout_t layout = H5Pget_layout(create);
    CLX_CHECK(layout >= H5D_COMPACT && layout <= H5D_CHUNKED && H5Pget_external_count(create) == 0,
              CLAST_E_FORMAT, "%s: array %s is kept outside the file", h5->label, name);
    const int n_filter = H5Pget_nfilters(create);
    for (int i = 0; i < n_filter; ++i) {
        unsigned flags = 0;
        unsigned config = 0;
        size_t n_value = 0;
        const H5Z_filter_t filter =
            H5Pget_filter2(create, (unsigned)i, &flags, &n_value, NULL, 0, NULL, &config);
        CLX_CHECK(filter == H5Z_FILTER_FLETCHER32, CLAST_E_FORMAT,
                  "%s: array %s uses filter %d; only plain and Fletcher-32 arrays are read",
                  h5->label, name, (int)filter);
    }
    CLX_CHECK(H5Dget_storage_size(set) >= bytes, CLAST_E_FORMAT,
              "%s: array %s declares %" PRIu64 " bytes and holds %" PRIu64, h5->label, name, bytes,
              (uint64_t)H5Dget_storage_size(set));
done:
    if (create >= 0) {
        (void)H5Pclose(create);
    }
    return status;
}

/// Sizes into shape [rank]; *bytes holds the bytes of one number before and of all after.
static clast_status check_sizes(const clx_h5 *h5, const char *name, hid_t space, int32_t rank,
                                int64_t *shape, uint64_t *bytes)
{
    clast_status status = CLAST_OK;
    hsize_t size[CLX_H5_RANK_LIMIT] = {0};
    const uint64_t limit = UINT64_C(1) << 40;
    CLX_CHECK(H5Sis_simple(space) > 0 && H5Sget_simple_extent_ndims(space) == rank, CLAST_E_FORMAT,
              "%s: array %s does not have %d dimensions", h5->label, name, rank);
    (void)H5Sget_simple_extent_dims(space, size, NULL);
    for (int32_t d = 0; d < rank; ++d) {
        CLX_CHECK(size[d] == 0 || *bytes <= limit / size[d], CLAST_E_LIMIT,
                  "%s: array %s is too large", h5->label, name);
        *bytes *= size[d];
        shape[d] = (int64_t)size[d];
    }
done:
    return status;
}

/// Opens an array and checks everything about it; shape [rank] is filled.
static clast_status open_array(const clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                               int64_t *shape, hid_t *set)
{
    clast_status status = CLAST_OK;
    hid_t file_type = H5I_INVALID_HID;
    hid_t space = H5I_INVALID_HID;
    uint64_t bytes = clx_h5_type_size(type);
    *set = H5I_INVALID_HID;
    CLX_CHECK(is_inside(h5, name), CLAST_E_FORMAT, "%s: there is no array %s", h5->label, name);
    *set = H5Dopen2(h5->file, name, H5P_DEFAULT);
    CLX_CHECK(*set >= 0, CLAST_E_FORMAT, "%s: %s is damaged or not an array", h5->label, name);
    file_type = H5Dget_type(*set);
    space = H5Dget_space(*set);
    CLX_CHECK(file_type >= 0 && space >= 0 && same_type(file_type, type), CLAST_E_FORMAT,
              "%s: array %s holds another type of number", h5->label, name);
    CLX_TRY(check_sizes(h5, name, space, rank, shape, &bytes));
    CLX_TRY(check_storage(h5, name, *set, bytes));
done:
    if (file_type >= 0) {
        (void)H5Tclose(file_type);
    }
    if (space >= 0) {
        (void)H5Sclose(space);
    }
    if (status != CLAST_OK && *set >= 0) {
        (void)H5Dclose(*set);
        *set = H5I_INVALID_HID;
    }
    return status;
}

clast_status clx_h5_shape(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                          int64_t *shape)
{
    hid_t set = H5I_INVALID_HID;
    int64_t found[CLX_H5_RANK_LIMIT] = {0};
    CLAST_ASSERT(rank >= 0 && rank <= CLX_H5_RANK_LIMIT);
    const clx_h5_session session = clx_h5_enter();
    const clast_status status = open_array(h5, name, type, rank, found, &set);
    if (status == CLAST_OK) {
        (void)H5Dclose(set);
        memcpy(shape, found, (size_t)rank * sizeof *shape);
    }
    clx_h5_leave(&session);
    return status;
}

static clast_status read_array(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                               const int64_t *shape, void *data)
{
    clast_status status = CLAST_OK;
    hid_t set = H5I_INVALID_HID;
    int64_t found[CLX_H5_RANK_LIMIT] = {0};
    int64_t total = 1;
    CLX_TRY(open_array(h5, name, type, rank, found, &set));
    for (int32_t d = 0; d < rank; ++d) {
        CLX_CHECK(found[d] == shape[d], CLAST_E_FORMAT,
                  "%s: size %d of array %s is %" PRId64 ", expected %" PRId64, h5->label, d, name,
                  found[d], shape[d]);
        total *= found[d];
    }
    CLX_CHECK(total == 0 ||
                  H5Dread(set, clx_h5_memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0,
              CLAST_E_FORMAT, "%s: array %s is damaged", h5->label, name);
done:
    if (set >= 0) {
        (void)H5Dclose(set);
    }
    return status;
}

clast_status clx_h5_read(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                         const int64_t *shape, void *data)
{
    CLAST_ASSERT(rank >= 0 && rank <= CLX_H5_RANK_LIMIT);
    const clx_h5_session session = clx_h5_enter();
    const clast_status status = read_array(h5, name, type, rank, shape, data);
    clx_h5_leave(&session);
    return status;
}

clast_status clx_h5_read_new(clx_h5 *h5, const char *name, clx_h5_type type, int32_t width,
                             int64_t *n, void *data)
{
    clast_status status = CLAST_OK;
    const int32_t rank = width == 1 ? 1 : 2;
    int64_t shape[2] = {0, 1};
    void *block = NULL;
    CLX_TRY(clx_h5_shape(h5, name, type, rank, shape));
    CLX_CHECK(width == 1 || shape[1] == width, CLAST_E_FORMAT,
              "%s: array %s has %" PRId64 " numbers an item, expected %d", h5->label, name,
              shape[1], width);
    CLX_TRY(clx_alloc(&block, shape[0], (size_t)width * clx_h5_type_size(type)));
    CLX_TRY(clx_h5_read(h5, name, type, rank, shape, block));
    *n = shape[0];
    memcpy(data, &block, sizeof block);
    block = NULL;
done:
    clx_free(block);
    return status;
}

static clast_status open_attribute(const clx_h5 *h5, const char *object, const char *name,
                                   hid_t *attribute, hid_t *type)
{
    clast_status status = CLAST_OK;
    *attribute = H5I_INVALID_HID;
    *type = H5I_INVALID_HID;
    CLX_CHECK(strcmp(object, "/") == 0 || is_inside(h5, object), CLAST_E_FORMAT,
              "%s: there is no %s", h5->label, object);
    CLX_CHECK(H5Aexists_by_name(h5->file, object, name, H5P_DEFAULT) > 0, CLAST_E_FORMAT,
              "%s: %s has no attribute %s", h5->label, object, name);
    *attribute = H5Aopen_by_name(h5->file, object, name, H5P_DEFAULT, H5P_DEFAULT);
    CLX_CHECK(*attribute >= 0, CLAST_E_FORMAT, "%s: attribute %s of %s is damaged", h5->label, name,
              object);
    *type = H5Aget_type(*attribute);
    const hid_t space = H5Aget_space(*attribute);
    const bool is_one = space >= 0 && H5Sget_simple_extent_npoints(space) == 1;
    if (space >= 0) {
        (void)H5Sclose(space);
    }
    CLX_CHECK(*type >= 0 && is_one, CLAST_E_FORMAT, "%s: attribute %s of %s is not one value",
              h5->label, name, object);
done:
    return status;
}

static void close_attribute(hid_t attribute, hid_t type)
{
    if (type >= 0) {
        (void)H5Tclose(type);
    }
    if (attribute >= 0) {
        (void)H5Aclose(attribute);
    }
}

clast_status clx_h5_read_text(clx_h5 *h5, const char *object, const char *name, char **text)
{
    clast_status status = CLAST_OK;
    const clx_h5_session session = clx_h5_enter();
    hid_t attribute;
    hid_t type;
    char *made = NULL;
    CLX_TRY(open_attribute(h5, object, name, &attribute, &type));
    const size_t size = H5Tget_size(type);
    CLX_CHECK(H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 && size > 0 &&
                  size <= (size_t)1 << 30,
              CLAST_E_FORMAT, "%s: attribute %s of %s is not a text of fixed length", h5->label,
              name, object);
    CLX_TRY(clx_alloc(&made, (int64_t)size + 1, 1));
    CLX_CHECK(H5Aread(attribute, type, made) >= 0, CLAST_E_FORMAT,
              "%s: attribute %s of %s is damaged", h5->label, name, object);
    *text = made;
    made = NULL;
done:
    clx_free(made);
    close_attribute(attribute, type);
    clx_h5_leave(&session);
    return status;
}

clast_status clx_h5_read_number(clx_h5 *h5, const char *object, const char *name, clx_h5_type type,
                                void *value)
{
    clast_status status = CLAST_OK;
    const clx_h5_session session = clx_h5_enter();
    hid_t attribute;
    hid_t file_type;
    uint64_t bits = 0;
    CLX_TRY(open_attribute(h5, object, name, &attribute, &file_type));
    CLX_CHECK(same_type(file_type, type) &&
                  H5Aread(attribute, clx_h5_memory_type(type), &bits) >= 0,
              CLAST_E_FORMAT, "%s: attribute %s of %s is damaged or of another type", h5->label,
              name, object);
    memcpy(value, &bits, clx_h5_type_size(type));
done:
    close_attribute(attribute, file_type);
    clx_h5_leave(&session);
    return status;
}

clast_status clx_h5_count(clx_h5 *h5, const char *folder, int64_t *n)
{
    clast_status status = CLAST_OK;
    const clx_h5_session session = clx_h5_enter();
    hid_t group = H5I_INVALID_HID;
    H5G_info_t info;
    CLX_CHECK(strcmp(folder, "/") == 0 || is_inside(h5, folder), CLAST_E_FORMAT,
              "%s: there is no folder %s", h5->label, folder);
    group = H5Gopen2(h5->file, folder, H5P_DEFAULT);
    CLX_CHECK(group >= 0 && H5Gget_info(group, &info) >= 0 && info.nlinks <= (hsize_t)1 << 30,
              CLAST_E_FORMAT, "%s: %s is damaged or not a folder", h5->label, folder);
    *n = (int64_t)info.nlinks;
done:
    if (group >= 0) {
        (void)H5Gclose(group);
    }
    clx_h5_leave(&session);
    return status;
}

clast_status clx_h5_member(clx_h5 *h5, const char *folder, int64_t index,
                           char name[CLX_H5_NAME_LIMIT])
{
    clast_status status = CLAST_OK;
    const clx_h5_session session = clx_h5_enter();
    char found[CLX_H5_NAME_LIMIT] = "";
    CLX_CHECK(strcmp(folder, "/") == 0 || is_inside(h5, folder), CLAST_E_FORMAT,
              "%s: there is no folder %s", h5->label, folder);
    const ssize_t n = H5Lget_name_by_idx(h5->file, folder, H5_INDEX_NAME, H5_ITER_INC,
                                         (hsize_t)index, found, sizeof found, H5P_DEFAULT);
    CLX_CHECK(n > 0 && n < CLX_H5_NAME_LIMIT, CLAST_E_FORMAT,
              "%s: member %" PRId64 " of %s has no usable name", h5->label, index, folder);
    memcpy(name, found, sizeof found);
done:
    clx_h5_leave(&session);
    return status;
}
