// Agglomeration inside the time loop of a flow: the caller owns all arrays, clast makes uniform
// cells and lets the particles of each collide. Here the flow is a steady vortex between walls, the
// particles lag behind it and gather at its rim, and the cells follow.
//
//     cc couple_flow.c $(pkg-config --cflags --libs clast) -lm && ./a.out
#include <clast/agglomerate.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 4000, N_STEP = 60, EVERY = 10 };

static double x[2 * N], velocity[2 * N], radius[N], mass[N], live_x[2 * N];
static int64_t monomers[N], owner[N], number[N];
static int32_t cell[N];

/// The flow solver's part: a vortex in the unit square drags the particles along (Stokes number 1).
static void move_particles(double dt)
{
    for (int i = 0; i < N; ++i) {
        const double a = CLAST_PI * x[2 * i];
        const double b = CLAST_PI * x[2 * i + 1];
        const double fluid[2] = {sin(a) * cos(b), -cos(a) * sin(b)};
        for (int j = 0; j < 2; ++j) {
            velocity[2 * i + j] += dt / 0.2 * (fluid[j] - velocity[2 * i + j]);
            x[2 * i + j] += dt * velocity[2 * i + j];
            if (x[2 * i + j] < 0.0 || x[2 * i + j] > 1.0) { // bounce off the wall
                x[2 * i + j] = x[2 * i + j] < 0.0 ? -x[2 * i + j] : 2.0 - x[2 * i + j];
                velocity[2 * i + j] = -velocity[2 * i + j];
            }
        }
    }
}

/// Cells for the particles that are still there; cell [N] tells each its own.
static clast_status make_cells(const clast_decompose_config *config, clast_decomposition *mesh)
{
    clast_cloud live = {.dimension = 2, .x = live_x};
    for (int64_t i = 0; i < N; ++i) {
        cell[i] = -1;
        if (monomers[i] > 0) {
            live_x[2 * live.n] = x[2 * i];
            live_x[2 * live.n + 1] = x[2 * i + 1];
            number[live.n++] = i;
        }
    }
    clast_decomposition_free(mesh);
    const clast_status status = clast_decompose(&live, config, mesh);
    for (int64_t k = 0; k < live.n && status == CLAST_OK; ++k) {
        cell[number[k]] = mesh->cells.of_point[k];
    }
    return status;
}

int main(void)
{
    clast_population particles = {N, 2, x, monomers, radius, mass, velocity, NULL, owner, NULL};
    clast_decompose_config mesh_config;
    clast_collide_config config = {.alpha = 1.0, .block = 1024, .seed = 1};
    clast_decomposition mesh = {0};
    const double dt = 0.02;
    config.medium.constant = 2e-5; // m^2/s in two dimensions
    clast_status status = clast_kernel_parse("constant", &config.kernel);
    if (status == CLAST_OK) {
        status = clast_fields_default(clast_decompose_fields, &mesh_config);
    }
    if (status == CLAST_OK) {
        status = clast_field_set(clast_fields_find(clast_decompose_fields, "domain"), &mesh_config,
                                 "box:0,0,1,1", false);
    }
    mesh_config.mesh = CLAST_CELLS_TREE;
    for (int64_t i = 0; i < N; ++i) {
        x[2 * i] = fmod(0.5 + 0.7548776662466927 * (double)i, 1.0); // evenly spread
        x[2 * i + 1] = fmod(0.5 + 0.5698402909980532 * (double)i, 1.0);
        monomers[i] = 1;
        mass[i] = radius[i] = 1.0;
        owner[i] = i;
    }
    for (int step = 0; step < N_STEP && status == CLAST_OK; ++step) {
        int64_t n_event = 0;
        move_particles(dt);
        status = make_cells(&mesh_config, &mesh);
        const clast_collide_cells cells = {
            .n = mesh.cells.n, .of_particle = cell, .volume = mesh.cells.volume};
        if (status == CLAST_OK) {
            status = clast_collide(&particles, &cells, dt, (uint64_t)step, &config, &n_event);
        }
        if (status == CLAST_OK && (step + 1) % EVERY == 0) {
            (void)printf("step %d: %lld particles, %d cells, %lld events\n", step + 1,
                         (long long)mesh.n - n_event, mesh.cells.n, (long long)n_event);
        }
    }
    if (status != CLAST_OK) {
        (void)fprintf(stderr, "%s\n", clast_error_detail());
    }
    clast_decomposition_free(&mesh);
    clast_fields_free(clast_decompose_fields, &mesh_config);
    return clast_status_exit_code(status);
}
