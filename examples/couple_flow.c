// Agglomeration inside the time loop of a flow: the caller owns all arrays, clast makes uniform
// cells and lets the particles of each collide, in memory that the workspace keeps. Here the flow
// is a steady vortex between walls, the particles lag behind it and gather at its rim, and the
// cells follow: points are tested when their moments move, cut anew when their density changes.
//
//     cc couple_flow.c $(pkg-config --cflags --libs clast) -lm && ./a.out
#include <clast/agglomerate.h>
#include <clast/cloud.h>
#include <clast/decompose.h>
#include <clast/kernel.h>
#include <clast/workspace.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 4000, N_STEP = 60, EVERY = 10 };

static double x[2 * N], velocity[2 * N], radius[N], mass[N], live_x[2 * N];
static int64_t monomers[N], owner[N];
static int32_t cell[N];
static double *volume; // of each cell
static double hidden;  // pairs that cells hide, as the last ones knew that were resolved

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

/// Cells for the particles that are still there; cell [N] tells each its own. Volumes are corrected
/// for the pairs that cells hide by being taken as uniform (docs/theory/agglomeration.md section
/// 2), so that the collisions that are expected are the `events` of the decomposition. Particles
/// that do not show their own structure know nothing of such pairs: the last that did are asked.
static clast_status make_cells(clast_workspace *workspace, const clast_domain *domain,
                               const clast_decompose_config *config,
                               const clast_decomposition **mesh)
{
    clast_points live = {.dimension = 2, .x = live_x, .stride = 2, .axis_stride = 1};
    for (int64_t i = 0; i < N; ++i) {
        if (monomers[i] > 0) {
            live_x[2 * live.n] = x[2 * i];
            live_x[2 * live.n++ + 1] = x[2 * i + 1];
        }
    }
    const clast_status status =
        clast_workspace_decompose_in(workspace, domain, &live, config, mesh);
    for (int64_t i = 0, k = 0; i < N && status == CLAST_OK; ++i) {
        cell[i] = monomers[i] > 0 ? (*mesh)->cells.of_point[k++] : -1;
    }
    const int32_t n_cell = status == CLAST_OK ? (*mesh)->cells.n : 0;
    hidden = n_cell > 0 && (*mesh)->resolved ? (*mesh)->smoothing_bias : hidden;
    volume = realloc(volume, ((size_t)n_cell + 1) * sizeof *volume);
    for (int32_t c = 0; c < n_cell && volume != NULL; ++c) {
        volume[c] = (*mesh)->cells.volume[c] * (1.0 + hidden);
    }
    return volume != NULL ? status : CLAST_E_MEMORY;
}

int main(void)
{
    clast_population particles = {N, 2, x, monomers, radius, mass, velocity, NULL, owner, NULL};
    clast_collide_config config;
    clast_decompose_config mesh_config = {0};
    clast_workspace_policy policy;
    clast_domain square;
    const clast_decomposition *mesh = NULL;
    clast_workspace *workspace = NULL;
    const double dt = 0.02;
    clast_status status = clast_collide_config_default(&config);
    config.medium.constant = 2e-5;
    config.seed = 1;
    status = status ? status : clast_kernel_parse("constant", &config.kernel);
    status = status ? status : clast_domain_parse("box:0,0,1,1", &square);
    status = status ? status : clast_workspace_create(&workspace);
    status = status ? status : clast_fields_default(clast_workspace_fields, &policy);
    status = status ? status : clast_fields_default(clast_decompose_fields, &mesh_config);
    if (status == CLAST_OK) {
        mesh_config.mesh = CLAST_CELLS_TREE;
        policy.tests = CLAST_TESTS_MOVED;
        policy.cells = CLAST_CUT_CHANGED;
        status = clast_workspace_set_policy(workspace, &policy);
    }
    // independent of each other: evenly seeded ones keep apart for long, and pairs of those tell
    // nothing of their density
    uint64_t dice = 1;
    for (int64_t i = 0; i < N; ++i) {
        for (int j = 0; j < 2; ++j) {
            dice = dice * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            x[2 * i + j] = (double)(dice >> 11) * 0x1p-53;
        }
        monomers[i] = 1;
        mass[i] = radius[i] = 1.0;
        owner[i] = i;
    }
    for (int step = 1; step <= N_STEP && status == CLAST_OK; ++step) {
        int64_t n_event = 0;
        move_particles(dt);
        status = make_cells(workspace, &square, &mesh_config, &mesh);
        if (status == CLAST_OK) {
            const clast_workspace_step now = {dt, (uint64_t)step};
            const clast_collide_cells cells = {
                .n = mesh->cells.n, .of_particle = cell, .volume = volume};
            status = clast_workspace_collide(workspace, &particles, &cells, now, &config, &n_event);
        }
        if (status == CLAST_OK && step % EVERY == 0) {
            (void)printf(
                "step %d: %lld particles, %d cells, pairs corrected by %+.1f %%, %lld events\n",
                step, (long long)mesh->n - n_event, mesh->cells.n, 100.0 / (1.0 + hidden) - 100.0,
                (long long)n_event);
        }
    }
    (void)fputs(status == CLAST_OK ? "" : clast_error_detail(), stderr);
    free(volume);
    clast_workspace_destroy(workspace);
    clast_fields_free(clast_decompose_fields, &mesh_config);
    return clast_status_exit_code(status);
}
