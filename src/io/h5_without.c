// In place of points_h5.c and volume_h5.c where clast is built without HDF5: arrays of other
// programs are refused by a line; states and checkpoints are h5_plain.c's.
#include "base/status.h"
#include "io/points.h"
#include "io/volume_io.h"
#include <clast/table.h>
#include <clast/volume.h>

/// A file that this clast cannot read.
static clast_status refuse(const char *path)
{
    return clx_fail(CLAST_E_USAGE,
                    "%s: built without HDF5: arrays of other programs are not read "
                    "(CLAST_HDF5=ON; tools/setup.sh build installs it)",
                    path);
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
