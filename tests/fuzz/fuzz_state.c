// Any well-formed HDF5 file with any names, types, sizes and numbers is a state or one line of
// complaint.
//
// Mutated bytes would not do: a state ends in its CRC-32, and behind that check stands the HDF5
// library with its own leaks and hangs on damaged files. So the input is a script (h5_script.h),
// and what is tested is everything that clast itself decides about the file. An input that does not
// begin with a line of the script is given to the reader as it is: it must fall to the CRC-32.
#include "h5_script.h"
#include <clast/assembly.h>
#include <clast/state.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

static bool keep(const uint8_t *bytes, size_t n)
{
    FILE *file = fopen(path, "wb");
    const bool is_written = file != NULL && fwrite(bytes, 1, n, file) == n;
    return file != NULL && fclose(file) == 0 && is_written;
}

/// Every index of an accepted state points to something.
static void use(const clast_state *state)
{
    volatile double sum = 0.0;
    const clast_assembly *a = state->assembly;
    for (int32_t i = 0; a != NULL && i < a->n_grain; ++i) {
        sum += a->shape[a->shape_id[i]].volume * a->scale[i];
    }
    for (int32_t i = 0; a != NULL && i < a->n_contact; ++i) {
        sum += a->scale[a->contact[i][0]] + a->scale[a->contact[i][1]];
    }
    for (int32_t s = 0; a != NULL && s < a->n_shape; ++s) {
        const clast_mesh *mesh = &a->shape[s].mesh;
        for (int32_t t = 0; t < 3 * mesh->n_tri; ++t) {
            sum += mesh->vert[mesh->tri[t / 3][t % 3]][0];
        }
    }
    (void)sum;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    clast_state state = {0};
    name_file();
    const bool is_script = n > 1 && memchr("tna", bytes[0], 3) != NULL && bytes[1] == ' ';
    if (is_script ? build(bytes, n) : keep(bytes, n)) {
        if (clast_state_read(path, &state) == CLAST_OK) {
            if (!is_script) {
                abort(); // no 4 kB of noise carry the CRC-32 of a state
            }
            use(&state);
        }
        clast_state_free(&state);
    }
    return 0;
}
