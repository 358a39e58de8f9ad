// Scenes of beds: nanoseconds a grain-step, everything included.
//
// P1, P1_27 and S1 settle first (minutes for P1) and are then timed over whole periods of shaking
// (5000 steps; S1 2000): within a period the number of touching pairs changes threefold, so a
// shorter window would say what phase it met. Beds are one run: repeats are windows that follow
// each other.
#include "scene.h"
#include <clast/dem.h>

#include <stdint.h>

clast_status cli_scene_p1(cli_lap *b);
clast_status cli_scene_p1_27(cli_lap *b);
clast_status cli_scene_p1_20k(cli_lap *b);
clast_status cli_scene_p1_200k(cli_lap *b);
clast_status cli_scene_p1_pour(cli_lap *b);
clast_status cli_scene_e1(cli_lap *b);
clast_status cli_scene_s1(cli_lap *b);

/// Times windows of n_step steps; the value is nanoseconds of wall time a grain-step.
static clast_status time_steps(cli_lap *b, clast_dem *dem, int64_t n_step)
{
    clast_status status = CLAST_OK;
    while (cli_lap_again(b)) {
        cli_lap_start(b);
        CLI_TRY(clast_dem_step(dem, n_step));
        cli_lap_stop(b);
    }
done:
    b->value = 1e9 * b->wall / ((double)n_step * clast_dem_n_grain(dem));
    return status;
}

static clast_status run_p1(cli_lap *b, clast_scene_bed bed, int64_t n_settle, int64_t n_step)
{
    clast_dem *dem = NULL;
    clast_status status = CLAST_OK;
    CLI_TRY(clast_dem_scene_p1(&bed, &dem));
    CLI_TRY(clast_dem_step(dem, n_settle));
    CLI_TRY(time_steps(b, dem, n_step));
done:
    clast_dem_destroy(dem);
    return status;
}

clast_status cli_scene_p1(cli_lap *b)
{
    return run_p1(b, (clast_scene_bed){4000, 152, 0.1, 0.0}, 155000, 5000);
}

clast_status cli_scene_p1_27(cli_lap *b)
{
    return run_p1(b, (clast_scene_bed){4000, 27, 0.1, 0.0}, 155000, 5000);
}

clast_status cli_scene_p1_20k(cli_lap *b)
{
    return run_p1(b, (clast_scene_bed){20000, 152, 0.224, 0.0}, 155000, 5000);
}

clast_status cli_scene_p1_200k(cli_lap *b)
{
    return run_p1(b, (clast_scene_bed){200000, 152, 0.708, 1.0}, 1000, 500);
}

clast_status cli_scene_p1_pour(cli_lap *b)
{
    return run_p1(b, (clast_scene_bed){4000, 152, 0.1, 0.0}, 15500, 5000);
}

clast_status cli_scene_e1(cli_lap *b)
{
    const clast_scene_bed bed = {4000, 152, 0.1, 0.0};
    clast_dem *p1 = NULL;
    clast_dem *dem = NULL;
    clast_status status = CLAST_OK;
    CLI_TRY(clast_dem_scene_p1(&bed, &p1));
    CLI_TRY(clast_dem_step(p1, 155000));
    CLI_TRY(clast_dem_scene_e1(&bed, p1, &dem));
    CLI_TRY(clast_dem_step(dem, 200));
    CLI_TRY(time_steps(b, dem, 400));
done:
    clast_dem_destroy(p1);
    clast_dem_destroy(dem);
    return status;
}

clast_status cli_scene_s1(cli_lap *b)
{
    clast_dem *dem = NULL;
    clast_status status = CLAST_OK;
    CLI_TRY(clast_dem_scene_s1(&dem));
    CLI_TRY(clast_dem_step(dem, 40000));
    CLI_TRY(time_steps(b, dem, 2000));
done:
    clast_dem_destroy(dem);
    return status;
}
