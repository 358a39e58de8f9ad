// Any bytes are a volume, whose labels have surfaces or are refused, or one line of complaint.
#include <clast/mesh.h>
#include <clast/volume.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    clast_voxels voxels = {0};
    clast_voxel_label *labels = NULL;
    int32_t n_label = 0;
    if (clast_voxels_parse(bytes, n, &voxels) == CLAST_OK &&
        clast_voxels_labels(&voxels, &labels, &n_label) == CLAST_OK && n_label > 0) {
        clast_mesh mesh = {0};
        clast_mesh points = {0};
        if (clast_voxels_surface(&voxels, &labels[n_label - 1], &mesh) == CLAST_OK &&
            mesh.n_tri < 4) {
            abort();
        }
        if (clast_voxels_points(&voxels, &labels[0], &points) == CLAST_OK &&
            points.n_vert > labels[0].n_voxel) {
            abort();
        }
        clast_mesh_free(&mesh);
        clast_mesh_free(&points);
    }
    clast_voxels_labels_free(labels);
    clast_voxels_free(&voxels);
    return 0;
}
