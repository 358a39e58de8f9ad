// Any well-formed file is a checkpoint that a packing goes on from, or one line of complaint; and
// what was accepted can be stepped, measured and saved again. The input is a script (h5_script.h);
// the packing's shapes are those of the file, so that the check of shapes lets it pass.
#include "h5_script.h"
#include "run/pack_state.h"
#include <clast/assembly.h>
#include <clast/grading.h>
#include <clast/machine.h>
#include <clast/pack.h>
#include <clast/state.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

enum { STEPS = 20, MOST_SHAPES = 8 };

static clast_pack_config config;
static clast_grading *grading;

static void free_fixed(void)
{
    clast_grading_destroy(grading);
    clast_fields_free(clast_pack_fields, &config);
}

static void prepare(void)
{
    if (grading == NULL) {
        clast_parallel_set_threads(1);
        if (clast_fields_default(clast_pack_fields, &config) != CLAST_OK ||
            clast_grading_uniform(5.6e-3, 8e-3, &grading) != CLAST_OK) {
            abort();
        }
        config.mass = 1e-3;
        config.dem.width = 0.05;
        config.dem.height = 0.1;
        config.series_time = 1e-5;
        (void)atexit(free_fixed);
    }
}

/// Steps of whatever was accepted may end in any status, but they end.
static void go_on(clast_pack *pack)
{
    clast_pack_result result = {0};
    (void)clast_pack_advance(pack, STEPS);
    if (clast_pack_measure(pack, &result) == CLAST_OK) {
        clast_pack_result_free(&result);
    }
    (void)clx_pack_state_write(path, "{}", pack);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    clast_state state = {0};
    clast_pack *pack = NULL;
    name_file();
    prepare();
    if (!build(bytes, n) || clast_state_read(path, &state) != CLAST_OK) {
        clast_state_free(&state);
        return 0;
    }
    if (state.assembly != NULL && state.assembly->n_shape > 0 &&
        state.assembly->n_shape <= MOST_SHAPES) {
        const clast_pack_input input = {
            .grading = grading, .n_shape = state.assembly->n_shape, .shape = state.assembly->shape};
        const clx_pack_checkpoint found = {.path = path, .config = NULL};
        if (clast_pack_create(&config, &input, &pack) == CLAST_OK &&
            clx_pack_checkpoint_read(&found, pack) == CLAST_OK) {
            go_on(pack);
        }
    }
    clast_pack_destroy(pack);
    clast_state_free(&state);
    return 0;
}
