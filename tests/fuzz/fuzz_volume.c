// Any bytes are a volume (NRRD, TIFF, bare), which is cut into labels or parts, or one line.
#include <clast/mesh.h>
#include <clast/status.h>
#include <clast/volume.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    clast_volume volume = {0};
    clast_voxels voxels = {0};
    const clast_volume_options options = {.n = {3, 2, 4}, .type = (clast_volume_type)(n % 8)};
    if (clast_volume_parse(bytes, n, &options, &volume) != CLAST_OK) {
        if (volume.value != NULL || strchr(clast_error_detail(), '\n') != NULL) {
            abort();
        }
        return 0;
    }
    const int64_t n_voxel = (int64_t)volume.n[0] * volume.n[1] * volume.n[2];
    if (n_voxel < 100000) {
        if (clast_volume_labels(&volume, &voxels) == CLAST_OK) {
            clast_voxels_free(&voxels);
        }
        if (clast_volume_parts(&volume, 10.0, &voxels) == CLAST_OK) {
            clast_voxel_label *labels = NULL;
            int32_t n_label = 0;
            clast_mesh mesh = {0};
            if (clast_voxels_labels(&voxels, &labels, &n_label) == CLAST_OK && n_label > 0 &&
                clast_voxels_surface(&voxels, &labels[0], &mesh) == CLAST_OK && mesh.n_tri < 4) {
                abort();
            }
            clast_mesh_free(&mesh);
            clast_voxels_labels_free(labels);
        }
    }
    clast_voxels_free(&voxels);
    clast_volume_free(&volume);
    return 0;
}
