// Any bytes are a series, whose surface is a solid or refused, or one line of complaint.
#include <clast/harmonics.h>
#include <clast/mesh.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    clast_harmonics series = {0};
    clast_mesh mesh = {0};
    if (clast_harmonics_parse(bytes, n, &series) == CLAST_OK &&
        clast_harmonics_mesh(&series, 8, 1, &mesh) == CLAST_OK && mesh.n_tri != 80) {
        abort();
    }
    clast_mesh_free(&mesh);
    clast_harmonics_free(&series);
    return 0;
}
