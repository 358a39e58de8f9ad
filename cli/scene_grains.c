// Scene of measured grains: files in, every measure of each, one table out.
#include "scene.h"

#include <clast/grain.h>
#include <clast/mesh.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { N_FILE = 3000, PATH_SIZE = 4096 };

clast_status cli_scene_shape(cli_lap *b);

/// A grain of 320 facets, its form and its waves other for each number; nearly all of its vertices
/// lie on the convex hull.
static clast_status make_grain(int32_t number, clast_mesh *mesh)
{
    const double turn = 0.618034 * number; // golden ratio: no two alike
    const double axes[3] = {1.0, 0.45 + 0.5 * (turn - floor(turn)), 0.3 + 0.1 * (number % 7 / 7.0)};
    CLI_GUARD(clast_mesh_ellipsoid(axes, 2, mesh));
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        double *p = mesh->vert[i];
        const double f = 1.0 + 0.02 * sin(5.0 * p[0] + turn) * cos(4.0 * p[1] + 2.0 * turn);
        for (int k = 0; k < 3; ++k) {
            p[k] *= f;
        }
    }
    return CLAST_OK;
}

static clast_status write_grain(int32_t i, const char *path)
{
    clast_mesh mesh = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(make_grain(i, &mesh));
    CLI_TRY(clast_mesh_write(&mesh, path, NULL));
done:
    clast_mesh_free(&mesh);
    return status;
}

static clast_status write_grains(const char *folder, char *const path[])
{
    for (int32_t i = 0; i < N_FILE; ++i) {
        (void)snprintf(path[i], PATH_SIZE, "%s/%d.ply", folder, i);
        CLI_GUARD(write_grain(i, path[i]));
    }
    return CLAST_OK;
}

/// What `clast shape *.ply -o table.csv` does.
static clast_status measure_grains(char *const path[], const char *table_path)
{
    const clast_grains_options options = {.level = 5, .degree = -1};
    clast_grains grains = {0};
    clast_table table = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(clast_grains_read(N_FILE, (const char *const *)path, &options, NULL, &grains));
    CLI_CHECK(grains.n_fault <= 0, grains.fault[0].status, "%s", grains.fault[0].text);
    CLI_TRY(clast_grains_table(&grains, CLAST_AXES_ELLIPSOID, false, &table));
    CLI_TRY(clast_table_write_csv(&table, table_path));
done:
    clast_table_free(&table);
    clast_grains_free(&grains);
    return status;
}

/// Writes the grains, measures them as often as is wanted, takes the files away again.
static clast_status measure_in(cli_lap *b, const char *folder, char *const path[])
{
    char table[PATH_SIZE];
    (void)snprintf(table, sizeof table, "%s/grains.csv", folder);
    clast_status status = CLAST_OK;
    CLI_TRY(write_grains(folder, path));
    while (cli_lap_again(b)) {
        cli_lap_start(b);
        CLI_TRY(measure_grains(path, table));
        cli_lap_stop(b);
    }
done:
    for (int32_t i = 0; i < N_FILE; ++i) {
        (void)unlink(path[i]);
    }
    (void)unlink(table);
    (void)rmdir(folder);
    return status;
}

clast_status cli_scene_shape(cli_lap *b)
{
    const char *tmp = getenv("TMPDIR"); // NOLINT(concurrency-mt-unsafe): before any thread
    char folder[1024];
    clast_status status = CLAST_OK;
    char **path = calloc(N_FILE, sizeof *path);
    char *text = calloc(N_FILE, PATH_SIZE);
    (void)snprintf(folder, sizeof folder, "%.900s/clast-bench-XXXXXX", tmp != NULL ? tmp : "/tmp");
    if (path == NULL || text == NULL) {
        free(path);
        free(text);
        return cli_fail(CLAST_E_MEMORY, "out of memory for %d names", N_FILE);
    }
    for (int32_t i = 0; i < N_FILE; ++i) {
        path[i] = text + (size_t)i * PATH_SIZE;
    }
    if (mkdtemp(folder) == NULL) {
        status = cli_fail(CLAST_E_IO, "cannot make a folder like %s", folder);
    } else {
        status = measure_in(b, folder, path);
    }
    b->value = N_FILE / b->wall;
    free(path);
    free(text);
    return status;
}
