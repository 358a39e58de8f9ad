// Scene of a cloud from the fluid to the floor.
#include "scene.h"

#include <clast/evolve.h>
#include <stddef.h>

clast_status cli_scene_evolve5(cli_lap *b);

/// Clay in stirred water, 1e5 particles, as examples/evolve/flocs.yaml.
static const char *const option[][2] = {{"domain", "box:0,0,0,2mm,2mm,25mm"},
                                        {"shapes", "ellipsoid:1,0.9,0.3"},
                                        {"density", "2600"},
                                        {"curve", "lognormal:5um,1.5um,2um,12um"},
                                        {"particles", "100000"},
                                        {"eddy_diffusivity", "1e-10"},
                                        {"viscosity", "1.002e-3"},
                                        {"fluid_density", "998.2"},
                                        {"kernel", "brownian+shear_turbulent+settling"},
                                        {"dissipation", "0.01"},
                                        {"alpha", "0.5"},
                                        {"out_of_range", "extrapolate"},
                                        {"duration", "60s"},
                                        {"rows", "10"}};
enum { N_OPTION = sizeof option / sizeof *option, LEAST_EVENTS = 20000 };

static clast_status follow(const clast_evolve_config *config, const clast_evolve_input *input,
                           int64_t *n_event)
{
    clast_status status = CLAST_OK;
    clast_evolve *evolve = NULL;
    clast_evolve_result result = {0};
    CLI_TRY(clast_evolve_create(config, input, &evolve));
    while (!clast_evolve_is_over(evolve)) {
        CLI_TRY(clast_evolve_advance(evolve));
    }
    CLI_TRY(clast_evolve_measure(evolve, &result));
    *n_event = result.n_event;
done:
    clast_evolve_destroy(evolve);
    return status;
}

clast_status cli_scene_evolve5(cli_lap *b)
{
    clast_status status = CLAST_OK;
    clast_evolve_config config = {0};
    clast_evolve_source source = {0};
    int64_t n_event = 0;
    CLI_TRY(clast_fields_default(clast_evolve_fields, &config));
    for (size_t k = 0; k < N_OPTION; ++k) {
        const clast_field *field = clast_fields_find(clast_evolve_fields, option[k][0]);
        CLI_TRY(clast_field_set(field, &config, option[k][1], false));
    }
    CLI_TRY(clast_evolve_load(&config, &source));
    while (cli_lap_again(b)) {
        cli_lap_start(b);
        CLI_TRY(follow(&config, &source.input, &n_event));
        cli_lap_stop(b);
    }
    CLI_CHECK(n_event >= LEAST_EVENTS, CLAST_E_NO, "%lld events, fewer than the scene is of",
              (long long)n_event);
    b->value = b->cpu;
done:
    clast_evolve_unload(&source);
    clast_fields_free(clast_evolve_fields, &config);
    return status;
}
