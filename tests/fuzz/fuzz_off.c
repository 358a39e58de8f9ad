// libFuzzer target of the OFF reader.
#include "fuzz_mesh.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    return fuzz_mesh(data, size, CLAST_MESH_OFF);
}
