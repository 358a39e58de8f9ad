// Named arrays and attributes in one HDF5 file: life cycle and writing; h5_read.c reads.
//
// Built in memory (core driver) and written as one image: HDF5 cannot be left with an unwritable
// file, and the disk's refusals are clx_file's. The latest file format is used since only it has
// checksums on all of HDF5's own structures. Object times are off on every list.
#include "io/h5_inside.h"

#include "base/alloc.h"
#include "io/h5_trailer.h"
#include <inttypes.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

clx_h5_session clx_h5_enter(void)
{
    clx_h5_session session = {0};
    (void)pthread_mutex_lock(&lock);
    (void)H5Eget_auto2(H5E_DEFAULT, &session.report, &session.context);
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    return session;
}

void clx_h5_leave(const clx_h5_session *session)
{
    (void)H5Eset_auto2(H5E_DEFAULT, session->report, session->context);
    (void)pthread_mutex_unlock(&lock);
}

hid_t clx_h5_memory_type(clx_h5_type type)
{
    switch (type) {
    case CLX_H5_F64:
        return H5T_NATIVE_DOUBLE;
    case CLX_H5_I32:
        return H5T_NATIVE_INT32;
    case CLX_H5_I64:
        return H5T_NATIVE_INT64;
    case CLX_H5_U64:
        return H5T_NATIVE_UINT64;
    case CLX_H5_U8:
        return H5T_NATIVE_UINT8;
    }
    return H5I_INVALID_HID;
}

hid_t clx_h5_file_type(clx_h5_type type)
{
    switch (type) {
    case CLX_H5_F64:
        return H5T_IEEE_F64LE;
    case CLX_H5_I32:
        return H5T_STD_I32LE;
    case CLX_H5_I64:
        return H5T_STD_I64LE;
    case CLX_H5_U64:
        return H5T_STD_U64LE;
    case CLX_H5_U8:
        return H5T_STD_U8LE;
    }
    return H5I_INVALID_HID;
}

size_t clx_h5_type_size(clx_h5_type type)
{
    return type == CLX_H5_U8 ? 1 : type == CLX_H5_I32 ? 4 : 8;
}

static clast_status create_in_memory(clx_h5 *h5)
{
    clast_status status = CLAST_OK;
    const clx_h5_session session = clx_h5_enter();
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    const hid_t create = H5Pcreate(H5P_FILE_CREATE);
    CLX_CHECK(H5Pset_fapl_core(access, 1 << 20, false) >= 0 &&
                  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110) >= 0 &&
                  H5Pset_obj_track_times(create, false) >= 0,
              CLAST_E_MEMORY, "HDF5 cannot be set up");
    // the core driver never opens the name, but HDF5 wants it unlike that of any open file
    (void)snprintf(h5->label, sizeof h5->label, "clast-memory-%p", (void *)h5);
    h5->file = H5Fcreate(h5->label, H5F_ACC_TRUNC, create, access);
    CLX_CHECK(h5->file >= 0, CLAST_E_MEMORY, "HDF5 cannot make a file in memory");
done:
    (void)H5Pclose(access);
    (void)H5Pclose(create);
    clx_h5_leave(&session);
    return status;
}

clast_status clx_h5_available(void)
{
    return CLAST_OK;
}

clast_status clx_h5_create(clx_h5 **h5)
{
    clast_status status = CLAST_OK;
    clx_h5 *made = NULL;
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    made->is_writing = true;
    CLX_TRY(create_in_memory(made));
    *h5 = made;
    made = NULL;
done:
    clx_free(made);
    return status;
}

void clx_h5_close(clx_h5 *h5)
{
    if (h5 != NULL) {
        const clx_h5_session session = clx_h5_enter();
        (void)H5Fclose(h5->file);
        clx_h5_leave(&session);
        clx_free(h5);
    }
}

/// Link creation list that makes the folders above a new object, without times.
static hid_t link_list(void)
{
    const hid_t list = H5Pcreate(H5P_LINK_CREATE);
    (void)H5Pset_create_intermediate_group(list, 1);
    (void)H5Pset_char_encoding(list, H5T_CSET_UTF8);
    return list;
}

/// Folders are made one by one, since those that HDF5 makes on the way carry times.
static clast_status make_folders(clx_h5 *h5, const char *name, bool is_folder)
{
    clast_status status = CLAST_OK;
    char part[CLX_H5_NAME_LIMIT];
    const hid_t create = H5Pcreate(H5P_GROUP_CREATE);
    const hid_t link = link_list();
    (void)H5Pset_obj_track_times(create, false);
    for (size_t n = 1; name[0] != '\0' && name[n - 1] != '\0'; ++n) {
        const bool ends = name[n] == '\0';
        if ((name[n] == '/' || (ends && is_folder)) && n > 1) {
            (void)snprintf(part, sizeof part, "%.*s", (int)n, name);
            if (H5Lexists(h5->file, part, H5P_DEFAULT) <= 0) {
                const hid_t group = H5Gcreate2(h5->file, part, link, create, H5P_DEFAULT);
                CLX_CHECK(group >= 0, CLAST_E_MEMORY, "%s: folder %s cannot be made", h5->label,
                          part);
                (void)H5Gclose(group);
            }
        }
    }
done:
    (void)H5Pclose(create);
    (void)H5Pclose(link);
    return status;
}

clast_status clx_h5_write_folder(clx_h5 *h5, const char *name)
{
    clast_status status = clx_h5_check_name(h5->label, name);
    if (status == CLAST_OK) {
        const clx_h5_session session = clx_h5_enter();
        status = make_folders(h5, name, true);
        clx_h5_leave(&session);
    }
    return status;
}

/// Chunks of about a mebibyte along the first size, which Fletcher-32 needs.
static void set_layout(hid_t create, size_t item, int32_t rank, const hsize_t *size, hsize_t total)
{
    hsize_t chunk[CLX_H5_RANK_LIMIT];
    const hsize_t limit = 1 << 20;
    if (rank == 0 || total == 0) {
        return; // nothing to check: contiguous
    }
    for (int32_t d = 0; d < rank; ++d) {
        chunk[d] = size[d];
    }
    const hsize_t row = total / size[0] * item;
    if (total * item > limit) {
        chunk[0] = row >= limit ? 1 : limit / row;
    }
    (void)H5Pset_chunk(create, rank, chunk);
    (void)H5Pset_fletcher32(create);
}

static clast_status write_array(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                                const hsize_t *size, const void *data)
{
    clast_status status = CLAST_OK;
    const hid_t create = H5Pcreate(H5P_DATASET_CREATE);
    const hid_t link = link_list();
    const hid_t space = rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, size, NULL);
    hid_t set = H5I_INVALID_HID;
    hsize_t total = 1;
    for (int32_t d = 0; d < rank; ++d) {
        total *= size[d];
    }
    (void)H5Pset_obj_track_times(create, false);
    (void)H5Pset_fill_time(create, H5D_FILL_TIME_NEVER);
    (void)H5Pset_alloc_time(create, H5D_ALLOC_TIME_EARLY);
    set_layout(create, clx_h5_type_size(type), rank, size, total);
    CLX_TRY(make_folders(h5, name, false));
    CLX_CHECK(H5Lexists(h5->file, name, H5P_DEFAULT) <= 0, CLAST_E_USAGE, "%s is written twice",
              name);
    set = H5Dcreate2(h5->file, name, clx_h5_file_type(type), space, link, create, H5P_DEFAULT);
    CLX_CHECK(set >= 0, CLAST_E_MEMORY, "HDF5 cannot make array %s", name);
    CLX_CHECK(total == 0 ||
                  H5Dwrite(set, clx_h5_memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0,
              CLAST_E_MEMORY, "HDF5 cannot keep array %s of %llu items", name,
              (unsigned long long)total);
done:
    if (set >= 0 && H5Dclose(set) < 0 && status == CLAST_OK) {
        status = clx_fail(CLAST_E_MEMORY, "HDF5 cannot keep array %s", name);
    }
    (void)H5Sclose(space);
    (void)H5Pclose(link);
    (void)H5Pclose(create);
    return status;
}

clast_status clx_h5_write(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                          const int64_t *shape, const void *data)
{
    clast_status status = CLAST_OK;
    hsize_t size[CLX_H5_RANK_LIMIT] = {0};
    CLAST_ASSERT(h5->is_writing && rank >= 0 && rank <= CLX_H5_RANK_LIMIT);
    CLX_TRY(clx_h5_check_name(h5->label, name));
    for (int32_t d = 0; d < rank; ++d) {
        CLX_CHECK(shape[d] >= 0, CLAST_E_USAGE, "%s has a size of %" PRId64, name, shape[d]);
        size[d] = (hsize_t)shape[d];
    }
    const clx_h5_session session = clx_h5_enter();
    status = write_array(h5, name, type, rank, size, data);
    clx_h5_leave(&session);
done:
    return status;
}

static clast_status write_attribute(clx_h5 *h5, const char *object, const char *name,
                                    hid_t file_type, hid_t memory_type, const void *value)
{
    clast_status status = CLAST_OK;
    const clx_h5_session session = clx_h5_enter();
    const hid_t space = H5Screate(H5S_SCALAR);
    hid_t attribute = H5I_INVALID_HID;
    hid_t at = H5Oopen(h5->file, object, H5P_DEFAULT);
    CLX_CHECK(at >= 0, CLAST_E_USAGE, "attribute %s of %s, which does not exist", name, object);
    attribute = H5Acreate2(at, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT);
    CLX_CHECK(attribute >= 0, CLAST_E_USAGE,
              "attribute %s of %s cannot be made or is there already", name, object);
    CLX_CHECK(H5Awrite(attribute, memory_type, value) >= 0, CLAST_E_MEMORY,
              "HDF5 cannot keep attribute %s of %s", name, object);
done:
    if (attribute >= 0) {
        (void)H5Aclose(attribute);
    }
    if (at >= 0) {
        (void)H5Oclose(at);
    }
    (void)H5Sclose(space);
    clx_h5_leave(&session);
    return status;
}

clast_status clx_h5_write_text(clx_h5 *h5, const char *object, const char *name, const char *text)
{
    clx_h5_session session = clx_h5_enter();
    const hid_t type = H5Tcopy(H5T_C_S1);
    (void)H5Tset_size(type, strlen(text) + 1);
    (void)H5Tset_cset(type, H5T_CSET_UTF8);
    clx_h5_leave(&session);
    const clast_status status = write_attribute(h5, object, name, type, type, text);
    session = clx_h5_enter();
    (void)H5Tclose(type);
    clx_h5_leave(&session);
    return status;
}

clast_status clx_h5_write_number(clx_h5 *h5, const char *object, const char *name, clx_h5_type type,
                                 const void *value)
{
    return write_attribute(h5, object, name, clx_h5_file_type(type), clx_h5_memory_type(type),
                           value);
}

/// H5Fget_file_image of HDF5 before 2.0 clears the flag "open for writing" but leaves the
/// superblock's checksum of before (hdf5 issue 1915): sets the right one.
static void mend_superblock(char *image)
{
    const uint32_t sum = clx_h5_sum(image, 44);
    for (int i = 0; i < 4; ++i) {
        image[44 + i] = (char)(sum >> 8 * i & 0xff);
    }
}

/// The finished file as bytes, as H5Fclose would leave it.
static clast_status read_image(clx_h5 *h5, char **image, int64_t *n)
{
    clast_status status = CLAST_OK;
    const clx_h5_session session = clx_h5_enter();
    char *made = NULL;
    CLX_CHECK(H5Fflush(h5->file, H5F_SCOPE_GLOBAL) >= 0, CLAST_E_MEMORY, "HDF5 cannot flush");
    const ssize_t size = H5Fget_file_image(h5->file, NULL, 0);
    CLX_CHECK(size > 0, CLAST_E_MEMORY, "HDF5 gives no image of its file");
    CLX_TRY(clx_alloc(&made, (int64_t)size, 1));
    CLX_CHECK(H5Fget_file_image(h5->file, made, (size_t)size) == size, CLAST_E_MEMORY,
              "HDF5 gives no image of its file");
    CLX_CHECK(size >= 48 && made[8] == 3 && made[9] == 8 && made[10] == 8, CLAST_E_MEMORY,
              "HDF5's image has superblock version %d, expected 3", made[8]);
    mend_superblock(made);
    *image = made;
    *n = (int64_t)size;
    made = NULL;
done:
    clx_free(made);
    clx_h5_leave(&session);
    return status;
}

clast_status clx_h5_commit(clx_h5 *h5, const char *path)
{
    clast_status status = CLAST_OK;
    char *image = NULL;
    int64_t n = 0;
    CLAST_ASSERT(h5->is_writing);
    CLX_TRY(read_image(h5, &image, &n));
    CLX_TRY(clx_h5_write_image(path, image, n));
done:
    clx_free(image);
    return status;
}
