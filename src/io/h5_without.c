// In place of h5.c, h5_read.c, points_h5.c and volume_h5.c where clast is built without HDF5:
// whatever would make or open a file says so, and nothing else can be reached without one.
#include "io/h5.h"

#include "io/points.h"
#include "io/volume_io.h"
#include <clast/table.h>
#include <clast/volume.h>

clast_status clx_h5_available(void)
{
    return clx_fail(CLAST_E_USAGE, "built without HDF5: states, checkpoints and the run folders "
                                   "that hold them are neither read nor written "
                                   "(CLAST_HDF5=ON; tools/setup.sh build installs it)");
}

/// A file that this clast cannot read.
static clast_status refuse(const char *path)
{
    const clast_status status = clx_h5_available();
    clx_fail_prefix("%s", path);
    return status;
}

clast_status clx_h5_create(clx_h5 **h5)
{
    (void)h5;
    return clx_h5_available();
}

clast_status clx_h5_open(const char *path, clx_h5 **h5)
{
    (void)h5;
    return refuse(path);
}

clast_status clx_points_h5(const char *path, const char *dataset, const clx_rows *rows,
                           clast_table *table)
{
    (void)dataset;
    (void)rows;
    (void)table;
    return refuse(path);
}

clast_status clx_points_h5_rows(const char *path, const char *dataset, int64_t *n_row)
{
    (void)dataset;
    (void)n_row;
    return refuse(path);
}

clast_status clast_volume_read_h5(const char *path, const char *dataset,
                                  const clast_volume_options *options, clast_volume *volume)
{
    CLX_ARGUMENTS(path, dataset, options, volume);
    return refuse(path);
}

void clx_h5_close(clx_h5 *h5)
{
    CLAST_ASSERT(h5 == NULL);
    (void)h5;
}

bool clx_h5_has(clx_h5 *h5, const char *name)
{
    (void)h5;
    (void)name;
    return false;
}

bool clx_h5_has_attribute(clx_h5 *h5, const char *object, const char *name)
{
    (void)h5;
    (void)object;
    (void)name;
    return false;
}

clast_status clx_h5_write(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                          const int64_t *shape, const void *data)
{
    (void)h5;
    (void)name;
    (void)type;
    (void)rank;
    (void)shape;
    (void)data;
    return clx_h5_available();
}

clast_status clx_h5_write_text(clx_h5 *h5, const char *object, const char *name, const char *text)
{
    (void)h5;
    (void)object;
    (void)name;
    (void)text;
    return clx_h5_available();
}

clast_status clx_h5_write_number(clx_h5 *h5, const char *object, const char *name, clx_h5_type type,
                                 const void *value)
{
    (void)h5;
    (void)object;
    (void)name;
    (void)type;
    (void)value;
    return clx_h5_available();
}

clast_status clx_h5_write_folder(clx_h5 *h5, const char *name)
{
    (void)h5;
    (void)name;
    return clx_h5_available();
}

clast_status clx_h5_commit(clx_h5 *h5, const char *path)
{
    (void)h5;
    (void)path;
    return clx_h5_available();
}

clast_status clx_h5_shape(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                          int64_t *shape)
{
    (void)h5;
    (void)name;
    (void)type;
    (void)rank;
    (void)shape;
    return clx_h5_available();
}

clast_status clx_h5_read(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                         const int64_t *shape, void *data)
{
    (void)h5;
    (void)name;
    (void)type;
    (void)rank;
    (void)shape;
    (void)data;
    return clx_h5_available();
}

clast_status clx_h5_read_new(clx_h5 *h5, const char *name, clx_h5_type type, int32_t width,
                             int64_t *n, void *data)
{
    (void)h5;
    (void)name;
    (void)type;
    (void)width;
    (void)n;
    (void)data;
    return clx_h5_available();
}

clast_status clx_h5_read_text(clx_h5 *h5, const char *object, const char *name, char **text)
{
    (void)h5;
    (void)object;
    (void)name;
    (void)text;
    return clx_h5_available();
}

clast_status clx_h5_read_number(clx_h5 *h5, const char *object, const char *name, clx_h5_type type,
                                void *value)
{
    (void)h5;
    (void)object;
    (void)name;
    (void)type;
    (void)value;
    return clx_h5_available();
}

clast_status clx_h5_count(clx_h5 *h5, const char *folder, int64_t *n)
{
    (void)h5;
    (void)folder;
    (void)n;
    return clx_h5_available();
}

clast_status clx_h5_member(clx_h5 *h5, const char *folder, int64_t index,
                           char name[CLX_H5_NAME_LIMIT])
{
    (void)h5;
    (void)folder;
    (void)index;
    (void)name;
    return clx_h5_available();
}
