// A volume from an HDF5 array [z][y][x] of numbers.
#include "io/h5_inside.h"
#include "io/volume_io.h"

#include <clast/volume.h>
#include <stdio.h>
#include <string.h>

/// Sizes of an open array, if it is a volume that the file can hold.
static clast_status check_array(const char *path, const char *name, hid_t set, int32_t n[3])
{
    clast_status status = CLAST_OK;
    hsize_t size[3] = {0};
    const hid_t space = H5Dget_space(set);
    const hid_t type = H5Dget_type(set);
    const hid_t create = H5Dget_create_plist(set);
    CLX_CHECK(space >= 0 && type >= 0 && create >= 0, CLAST_E_FORMAT, "%s: array %s is damaged",
              path, name);
    const H5T_class_t kind = H5Tget_class(type);
    CLX_CHECK(H5Sis_simple(space) > 0 && H5Sget_simple_extent_ndims(space) == 3 &&
                  (kind == H5T_FLOAT || kind == H5T_INTEGER),
              CLAST_E_FORMAT, "%s: %s is not an array [z][y][x] of numbers", path, name);
    (void)H5Sget_simple_extent_dims(space, size, NULL);
    for (int k = 0; k < 3; ++k) {
        CLX_CHECK(size[k] > 0 && size[k] < INT32_MAX, CLAST_E_FORMAT, "%s: array %s is empty", path,
                  name);
        n[k] = (int32_t)size[2 - k];
    }
    const H5D_layout_t layout = H5Pget_layout(create);
    CLX_CHECK(layout >= H5D_COMPACT && layout <= H5D_CHUNKED && H5Pget_external_count(create) == 0,
              CLAST_E_FORMAT, "%s: array %s is kept outside the file", path, name);
    const double stored =
        (double)H5Dget_storage_size(set) * (H5Pget_nfilters(create) > 0 ? CLX_MOST_RATIO : 1);
    CLX_CHECK((double)n[0] * n[1] * n[2] <= stored, CLAST_E_FORMAT,
              "%s: array %s declares more numbers than are stored", path, name);
done:
    (void)(space >= 0 && H5Sclose(space));
    (void)(type >= 0 && H5Tclose(type));
    (void)(create >= 0 && H5Pclose(create));
    return status;
}

static clast_status read_array(const clx_h5 *h5, const char *path, const char *name,
                               clast_volume *volume)
{
    clast_status status = CLAST_OK;
    int32_t n[3];
    const hid_t set = H5Dopen2(h5->file, name, H5P_DEFAULT);
    CLX_CHECK(set >= 0, CLAST_E_FORMAT, "%s: there is no array %s", path, name);
    CLX_TRY(check_array(path, name, set, n));
    CLX_TRY(clast_volume_alloc(n, volume));
    CLX_CHECK(H5Dread(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, volume->value) >= 0,
              CLAST_E_FORMAT, "%s: array %s is damaged or packed in a way that is not read", path,
              name);
done:
    if (set >= 0) {
        (void)H5Dclose(set);
    }
    return status;
}

clast_status clast_volume_read_h5(const char *path, const char *dataset,
                                  const clast_volume_options *options, clast_volume *volume)
{
    CLX_ARGUMENTS(path, dataset, options, volume);
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    clast_volume made = {0};
    char name[CLX_H5_NAME_LIMIT];
    CLX_CHECK(snprintf(name, sizeof name, "%s%s", dataset[0] == '/' ? "" : "/", dataset) <
                  (int)sizeof name,
              CLAST_E_USAGE, "the dataset's name is too long");
    CLX_TRY(clx_h5_open_foreign(path, &h5));
    CLX_CHECK(clx_h5_has(h5, name), CLAST_E_FORMAT, "%s: there is no array %s", path, name);
    const clx_h5_session session = clx_h5_enter();
    status = read_array(h5, path, name, &made);
    clx_h5_leave(&session);
    if (status != CLAST_OK) {
        goto done;
    }
    for (int k = 0; k < 3; ++k) {
        made.edge[k] = options->edge[k] > 0.0 ? options->edge[k] : made.edge[k];
    }
    *volume = made;
    made = (clast_volume){0};
done:
    clx_h5_close(h5);
    clast_volume_free(&made);
    return status;
}
