#pragma once
// One body for the four surface readers: any bytes end in an error or in a mesh that can be used.
#include <clast/mesh.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void fuzz_require(bool condition)
{
    if (!condition) {
        abort();
    }
}

static void fuzz_check(const clast_mesh *mesh)
{
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        fuzz_require(isfinite(mesh->vert[i][0]) && isfinite(mesh->vert[i][1]) &&
                     isfinite(mesh->vert[i][2]));
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            fuzz_require(mesh->tri[t][k] >= 0 && mesh->tri[t][k] < mesh->n_vert);
        }
    }
}

static int fuzz_mesh(const uint8_t *data, size_t size, clast_mesh_format format)
{
    clast_mesh mesh = {0};
    clast_mesh_read_report report = {0};
    const clast_status status = clast_mesh_parse(data, size, format, &mesh, &report);
    if (status == CLAST_OK) {
        fuzz_check(&mesh);
        fuzz_require(report.n_warning >= 0 && report.n_warning <= CLAST_MESH_N_WARNING);
        // twelve bytes of memory at most for one of the file
        fuzz_require((size_t)mesh.n_vert <= size && (size_t)mesh.n_tri <= size);
    } else {
        fuzz_require(mesh.vert == NULL && mesh.tri == NULL);
        fuzz_require(status == CLAST_E_FORMAT || status == CLAST_E_LIMIT);
        fuzz_require(strchr(clast_error_detail(), '\n') == NULL);
    }
    clast_mesh_free(&mesh);
    return 0;
}
