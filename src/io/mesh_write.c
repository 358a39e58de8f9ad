// Surfaces to OBJ, PLY and OFF: the same doubles come back from each.
#include "base/field.h"
#include "base/file.h"
#include "base/number.h"
#include "io/bytes.h"
#include "io/mesh_io.h"
#include <clast/field.h>
#include <stdio.h>

static const char *unit_of(const clast_mesh_write_options *options)
{
    return options->unit != NULL ? options->unit : "not stated";
}

clast_status clx_mesh_write_point(clx_file *file, const char *prefix, const double p[3])
{
    char line[4 * CLX_NUMBER_SIZE];
    int n = snprintf(line, CLX_NUMBER_SIZE, "%s", prefix);
    for (int k = 0; k < 3; ++k) {
        n += clx_number_format(p[k], line + n);
        line[n++] = k < 2 ? ' ' : '\n';
    }
    return clx_file_write(file, line, (size_t)n);
}

/// Names end at control characters, which would break the line they stand in.
static int name_length(const char *name)
{
    int n = 0;
    while (n < 200 && (unsigned char)name[n] >= ' ') {
        ++n;
    }
    return n;
}

clast_status clx_obj_write(const clast_mesh *mesh, const clast_mesh_write_options *options,
                           clx_file *file)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_file_print(file, "# clast %s, unit %s\n", clast_version(), unit_of(options)));
    if (options->name != NULL) {
        CLX_TRY(clx_file_print(file, "o %.*s\n", name_length(options->name), options->name));
    }
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        CLX_TRY(clx_mesh_write_point(file, "v ", mesh->vert[i]));
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        const int32_t *tri = mesh->tri[t];
        CLX_TRY(
            clx_file_print(file, "f %lld %lld %lld\n", tri[0] + 1LL, tri[1] + 1LL, tri[2] + 1LL));
    }
done:
    return status;
}

clast_status clx_off_write(const clast_mesh *mesh, const clast_mesh_write_options *options,
                           clx_file *file)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_file_print(file, "OFF\n# clast %s, unit %s\n%d %d 0\n", clast_version(),
                           unit_of(options), mesh->n_vert, mesh->n_tri));
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        CLX_TRY(clx_mesh_write_point(file, "", mesh->vert[i]));
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        const int32_t *tri = mesh->tri[t];
        CLX_TRY(clx_file_print(file, "3 %d %d %d\n", tri[0], tri[1], tri[2]));
    }
done:
    return status;
}

clast_status clx_ply_write(const clast_mesh *mesh, const clast_mesh_write_options *options,
                           clx_file *file)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_file_print(file,
                           "ply\nformat binary_little_endian 1.0\ncomment clast %s, unit %s\n"
                           "element vertex %d\nproperty double x\nproperty double y\n"
                           "property double z\nelement face %d\n"
                           "property list uchar int vertex_indices\nend_header\n",
                           clast_version(), unit_of(options), mesh->n_vert, mesh->n_tri));
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        uint8_t row[24];
        for (int k = 0; k < 3; ++k) {
            clx_store_f64(row + 8 * (ptrdiff_t)k, mesh->vert[i][k]);
        }
        CLX_TRY(clx_file_write(file, row, sizeof row));
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        uint8_t row[13] = {3};
        for (int k = 0; k < 3; ++k) {
            clx_store_u32(row + 1 + 4 * (ptrdiff_t)k, (uint32_t)mesh->tri[t][k]);
        }
        CLX_TRY(clx_file_write(file, row, sizeof row));
    }
done:
    return status;
}

const clast_idle *clast_mesh_write_idle(clast_mesh_format format, clast_idle *rules)
{
    if (rules == NULL) {
        return NULL;
    }
    const clast_idle made[CLAST_N_IDLE] = {
        {format == CLAST_MESH_PLY || format == CLAST_MESH_OFF, "name",
         "with .ply and .off: STL, OBJ and 3MF name their part"}};
    return clx_idle_copy(made, rules);
}
