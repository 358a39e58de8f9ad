// Scenes of points.
#include "scene.h"

#include <clast/decompose.h>
#include <clast/pairs.h>
#include <stdint.h>

clast_status cli_scene_d6(cli_lap *b);
clast_status cli_scene_d7(cli_lap *b);
clast_status cli_scene_d6_boxes(cli_lap *b);
clast_status cli_scene_d7_blob(cli_lap *b);
clast_status cli_scene_pairs6(cli_lap *b);

/// A number in [0, 1): splitmix64 [Steele2014].
static double draw(uint64_t *state)
{
    uint64_t x = (*state += 0x9e3779b97f4a7c15u);
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (double)((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

/// Half of the points uniform in the unit cube, half in a dense block of an eighth of it, or in a
/// blob: the mean of 8 uniform coordinates, nearly normal with sd 0.10.
static clast_status make_points(int64_t n, bool is_blob, clast_cloud *cloud)
{
    uint64_t state = 1;
    CLI_GUARD(clast_cloud_alloc(n, 3, cloud));
    for (int64_t i = 0; i < 3 * n; ++i) {
        const double x = draw(&state);
        cloud->x[i] = i / 3 % 2 == 0 ? x : 0.25 + 0.5 * x;
        for (int k = 1; k < 8 && is_blob && i / 3 % 2 == 1; ++k) {
            cloud->x[i] = (k == 1 ? x : cloud->x[i]) + draw(&state);
        }
        cloud->x[i] /= is_blob && i / 3 % 2 == 1 ? 8.0 : 1.0;
    }
    return CLAST_OK;
}

static clast_status decompose(cli_lap *b, int64_t n, bool is_blob, const char *mesh)
{
    clast_decompose_config config;
    clast_cloud cloud = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(clast_fields_default(clast_decompose_fields, &config));
    const clast_field *domain = clast_fields_find(clast_decompose_fields, "domain");
    CLI_TRY(clast_field_set(domain, &config, "box:0,0,0,1,1,1", false));
    CLI_TRY(
        clast_field_set(clast_fields_find(clast_decompose_fields, "mesh"), &config, mesh, false));
    CLI_TRY(make_points(n, is_blob, &cloud));
    while (cli_lap_again(b)) {
        clast_decomposition result = {0};
        cli_lap_start(b);
        CLI_TRY(clast_decompose(&cloud, &config, &result));
        cli_lap_stop(b);
        clast_decomposition_free(&result);
    }
done:
    b->value = b->wall;
    clast_cloud_free(&cloud);
    clast_fields_free(clast_decompose_fields, &config);
    return status;
}

clast_status cli_scene_d6(cli_lap *b)
{
    return decompose(b, 1000000, false, "auto");
}

clast_status cli_scene_d7(cli_lap *b)
{
    return decompose(b, 10000000, false, "auto");
}

clast_status cli_scene_d6_boxes(cli_lap *b)
{
    return decompose(b, 1000000, false, "boxes");
}

clast_status cli_scene_d7_blob(cli_lap *b)
{
    return decompose(b, 10000000, true, "auto");
}

clast_status cli_scene_pairs6(cli_lap *b)
{
    const clast_domain cube = {.kind = CLAST_DOMAIN_BOX, .dimension = 3, .high = {1.0, 1.0, 1.0}};
    uint64_t state = 1;
    clast_pairs_config config;
    clast_cloud cloud = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(clast_fields_default(clast_pairs_fields, &config));
    CLI_TRY(clast_cloud_alloc(1000000, 3, &cloud));
    for (int64_t i = 0; i < 3 * cloud.n; ++i) {
        cloud.x[i] = draw(&state);
    }
    while (cli_lap_again(b)) {
        clast_pairs pairs = {0};
        cli_lap_start(b);
        CLI_TRY(clast_pairs_count(&cube, &cloud, &config, &pairs));
        cli_lap_stop(b);
        clast_pairs_free(&pairs);
    }
done:
    b->value = b->wall;
    clast_cloud_free(&cloud);
    return status;
}
