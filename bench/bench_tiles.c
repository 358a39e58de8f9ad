// What does a grain-step of the same bed cost among more grains, and with more threads?
//
//     build/release/bench/bench_tiles [NX NY [THREADS]]      (without numbers: all, some minutes)
//     build/release/bench/bench_tiles threads     (one and two, alone and beside a busy process)
//
// The bed of case P1 (4000 grains, shaken and settled) stands beside itself NX times NY times in
// one periodic box, grain by grain of all copies in turn, as a fill would number them: so every
// size has the same contacts a grain, which no bed that is still falling has. Contacts are found
// afresh, 50 steps go by, then each bed is timed in turn, 25 times, for about two million
// grain-steps and 50 steps at least; the least counts. Windows are short, and about as long for
// every bed, because a shared machine is left alone for seconds only: where each window is half a
// second and one bed's are 25, the least of the latter is a mean. What two threads gain is given by
// medians as well: the least of either bed says who met the quieter window.
#include "gravel.h"
#include "support.h"

#include <clast/dem.h>
#include <clast/machine.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { N_FORM = 63, SETTLE = 155000, WARM = 50, WINDOW = 2000000, LEAST = 50, WINDOWS = 25 };

static const double WIDTH = 0.1;

static double wall(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static clast_dem *make_box(int nx, int ny)
{
    clast_dem *dem = NULL;
    clast_dem_config config;
    CHECK_OK(clast_fields_default(clast_dem_fields, &config));
    config.domain = CLAST_DEM_PERIODIC;
    config.width = WIDTH * nx;
    config.depth = WIDTH * ny;
    config.height = 2.0;
    CHECK_OK(clast_dem_create(&config, &dem));
    clast_shape form[N_FORM] = {0};
    support_gravel_forms(N_FORM, form);
    for (int k = 0; k < N_FORM; ++k) {
        int32_t id = 0;
        CHECK_OK(clast_dem_add_shape(dem, &form[k], &id));
        clast_shape_free(&form[k]);
    }
    clast_dem_set_drive(dem, &(clast_dem_drive){3e-4, 0.025, 1.0});
    return dem;
}

static clast_dem *tile(const clast_dem *bed, int nx, int ny)
{
    clast_dem *dem = make_box(nx, ny);
    const int32_t n = clast_dem_n_grain(bed);
    clast_dem_grain *grain = malloc((size_t)n * (size_t)(nx * ny) * sizeof *grain);
    int32_t k = 0;
    assert_non_null(grain);
    for (int32_t i = 0; i < n; ++i) {
        for (int copy = 0; copy < nx * ny; ++copy) {
            clast_dem_read_grain(bed, i, &grain[k]);
            const int row = copy / nx;
            grain[k].position[0] += WIDTH * (copy % nx);
            grain[k++].position[1] += WIDTH * row;
        }
    }
    CHECK_OK(clast_dem_add_grains(dem, k, grain));
    free(grain);
    return dem;
}

typedef struct {
    const char *name;
    int nx, ny, threads;
    clast_dem *dem;
    double ns[WINDOWS]; // wall, a grain-step; sorted at the end
} tiles;

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/// Every bed a window in turn: a machine's speed comes and goes, and the beds are to be compared.
static void time_in_turn(tiles *beds, int n_bed, const clast_dem *bed)
{
    for (int k = 0; k < n_bed; ++k) {
        clast_parallel_set_threads(beds[k].threads);
        beds[k].dem = tile(bed, beds[k].nx, beds[k].ny);
        CHECK_OK(clast_dem_step(beds[k].dem, WARM));
    }
    for (int turn = 0; turn < WINDOWS; ++turn) {
        for (int k = 0; k < n_bed; ++k) {
            clast_dem *dem = beds[k].dem;
            const int32_t n = clast_dem_n_grain(dem);
            const int32_t steps = WINDOW / n > LEAST ? WINDOW / n : LEAST;
            clast_parallel_set_threads(beds[k].threads);
            const double begun = wall();
            CHECK_OK(clast_dem_step(dem, steps));
            beds[k].ns[turn] = 1e9 * (wall() - begun) / steps / n;
        }
    }
    for (int k = 0; k < n_bed; ++k) {
        clast_dem_destroy(beds[k].dem);
        qsort(beds[k].ns, WINDOWS, sizeof beds[k].ns[0], by_size);
    }
}

static void report(const char *name, double ns, double reference)
{
    printf("%s,%.4g,ns/grain-step,%.4g,%.3g\n", name, ns, reference, reference / ns);
}

/// What a second thread brings, by medians: alone, then while another process wants a core.
static void compare_threads(const clast_dem *bed)
{
    static const char *const where[] = {"ALONE", "BESIDE_A_BUSY_PROCESS"};
    for (int busy = 0; busy < 2; ++busy) {
        pid_t other = busy == 1 ? fork() : 0;
        if (busy == 1 && other == 0) {
            for (volatile int i = 0;; ++i) {
            }
        }
        tiles all[] = {{.nx = 1, .ny = 1, .threads = 1},
                       {.nx = 1, .ny = 1, .threads = 2},
                       {.nx = 5, .ny = 1, .threads = 1},
                       {.nx = 5, .ny = 1, .threads = 2}};
        time_in_turn(all, 4, bed);
        for (int k = 1; k < 4; k += 2) {
            char name[64];
            (void)snprintf(name, sizeof name, "TILES_%d_2_THREADS_%s", 4000 * all[k].nx,
                           where[busy]);
            report(name, all[k].ns[WINDOWS / 2], all[k - 1].ns[WINDOWS / 2]);
        }
        if (other > 0) {
            (void)kill(other, SIGKILL);
            (void)waitpid(other, NULL, 0);
        }
    }
}

int main(int argc, char **argv)
{
    clast_dem *bed = NULL;
    clast_parallel_set_threads(1);
    CHECK_OK(clast_dem_scene_p1(&(clast_scene_bed){4000, 152, WIDTH, 0.0}, &bed));
    CHECK_OK(clast_dem_step(bed, SETTLE));
    printf("scene,value,unit,reference,ratio\n");
    if (argc == 2 && strcmp(argv[1], "threads") == 0) {
        compare_threads(bed);
    } else if (argc > 2) {
        int number[3] = {1, 1, 1};
        for (int i = 0; i < 3 && i + 1 < argc; ++i) {
            number[i] = (int)strtol(argv[i + 1], NULL, 10);
        }
        tiles one = {.name = "TILES", .nx = number[0], .ny = number[1], .threads = number[2]};
        time_in_turn(&one, 1, bed);
        report(one.name, one.ns[0], 250.0);
    } else {
        tiles all[] = {{.name = "TILES_4000", .nx = 1, .ny = 1, .threads = 1},
                       {.name = "TILES_196000", .nx = 7, .ny = 7, .threads = 1},
                       {.name = "TILES_20000", .nx = 5, .ny = 1, .threads = 1},
                       {.name = "TILES_20000_2_THREADS", .nx = 5, .ny = 1, .threads = 2}};
        time_in_turn(all, 4, bed);
        const int middle = WINDOWS / 2;
        report(all[0].name, all[0].ns[0], 250.0);
        report(all[1].name, all[1].ns[0], 1.5 * all[0].ns[0]);
        report(all[2].name, all[2].ns[0], 250.0);
        report(all[3].name, all[3].ns[0], all[2].ns[0] / 1.8);
        report("TILES_20000_2_THREADS_MEDIAN", all[3].ns[middle], all[2].ns[middle] / 1.8);
    }
    clast_dem_destroy(bed);
    return 0;
}
