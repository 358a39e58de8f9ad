// Timings of first touch: pairs of each kind beside their plain twins, and aggregates grown by the
// plainest loop that uses a scene (core at the origin, best of rays x orientations).
//
//     build/release/bench/bench_touch [scene...]     CSV: scene,value,unit,reference,ratio
//
// CPU time of one thread, least of several runs. The reference of a pair is the closed form over
// all pairs of items; of a query in a scene, asking every body.
#include "support.h"

#include "math/rng.h"
#include "math/vec3.h"
#include "ref_touch.h"
#include "touch/scene.h"
#include "touch/tree.h"
#include "touch_bodies.h"
#include <clast/mesh.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static int n_wanted;
static char **wanted;

static bool is_wanted(const char *scene)
{
    for (int i = 0; i < n_wanted; ++i) {
        if (strstr(scene, wanted[i]) != NULL) {
            return true;
        }
    }
    return n_wanted == 0;
}

static double cpu(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void row(const char *scene, double value, const char *unit, double reference)
{
    if (reference > 0.0) {
        printf("%s,%.4g,%s,%.4g,%.1f\n", scene, value, unit, reference, reference / value);
    } else {
        printf("%s,%.4g,%s,,\n", scene, value, unit);
    }
    (void)fflush(stdout);
}

typedef struct {
    clx_touch_body lying, moving;
    clx_touch_path path;
} pair;

/// Two bodies near each other on a random line towards the lying one.
static pair random_pair(clx_touch_body lying, clx_touch_body moving, uint64_t index)
{
    clx_rng rng = clx_rng_at(21, CLX_STREAM_TEST, index);
    pair p = {.lying = lying, .moving = moving};
    double u[3];
    place_at_random(&p.lying, 0.2, 1.0, &rng);
    place_at_random(&p.moving, 0.2, 1.0, &rng);
    clx_rng_direction(&rng, u);
    p.path = clx_touch_path_along(u);
    return p;
}

/// Mean time of a pair's query, least of five rounds; every pair is asked `repeat` times.
static double time_pairs(const pair *pairs, int n, int repeat)
{
    double best = INFINITY;
    for (int round = 0; round < 5; ++round) {
        double sum = 0.0;
        const double begun = cpu();
        for (int i = 0; i < n * repeat; ++i) {
            clx_touch touch;
            const pair *p = &pairs[i % n];
            sum += clx_first_touch(&p->moving, &p->lying, &p->path, &touch) ? touch.t : 0.0;
        }
        const double taken = (cpu() - begun) / (n * repeat);
        best = taken < best && isfinite(sum) ? taken : best;
    }
    return best;
}

static void bench_round(const char *scene, bool is_sphere)
{
    enum { N = 2000 };
    pair *pairs = malloc(N * sizeof *pairs);
    if (!is_wanted(scene) || pairs == NULL) {
        free(pairs);
        return;
    }
    for (int i = 0; i < N; ++i) {
        clx_rng rng = clx_rng_at(22, CLX_STREAM_TEST, (uint64_t)i);
        clx_touch_body body[2];
        for (int k = 0; k < 2; ++k) {
            double axes[3];
            for (int j = 0; j < 3; ++j) {
                axes[j] = pow(10.0, -clx_rng_uniform(&rng));
            }
            body[k] = is_sphere ? clx_touch_body_sphere(axes[0]) : clx_touch_body_ellipsoid(axes);
        }
        pairs[i] = random_pair(body[0], body[1], (uint64_t)i);
    }
    double reference = 0.0;
    if (!is_sphere) {
        const double begun = cpu();
        for (int i = 0; i < 10; ++i) {
            double t = 0.0;
            (void)ref_touch_ellipsoids(&pairs[i].moving, &pairs[i].lying, pairs[i].path.direction,
                                       &t);
        }
        reference = (cpu() - begun) / 10.0 * 1e9;
    }
    row(scene, time_pairs(pairs, N, 10) * 1e9, "ns/pair", reference);
    free(pairs);
}

static void bench_trees(const char *scene, const clx_touch_tree *a, const clx_touch_tree *b,
                        bool has_reference)
{
    enum { N = 200 };
    static pair pairs[N];
    if (!is_wanted(scene) || a == NULL || b == NULL) {
        return;
    }
    for (int i = 0; i < N; ++i) {
        pairs[i] = random_pair(clx_touch_body_tree(a), clx_touch_body_tree(b), (uint64_t)i);
        place_at_random(&pairs[i].lying, 0.2, 1.0 / a->radius,
                        &(clx_rng){.seed = 5, .index = (uint64_t)i, .used = 4});
        place_at_random(&pairs[i].moving, 0.2, 1.0 / b->radius,
                        &(clx_rng){.seed = 6, .index = (uint64_t)i, .used = 4});
    }
    double reference = 0.0;
    if (has_reference) {
        const double begun = cpu();
        const double t =
            ref_touch_trees(&pairs[0].moving, &pairs[0].lying, pairs[0].path.direction);
        reference = (cpu() - begun) * 1e6;
        clx_touch touch = {0};
        if (clx_first_touch(&pairs[0].moving, &pairs[0].lying, &pairs[0].path, &touch) !=
                isfinite(t) ||
            (isfinite(t) && fabs(touch.t - t) > 1e-12)) {
            printf("%s disagrees with its reference\n", scene);
        }
    }
    row(scene, time_pairs(pairs, N, 5) * 1e6, "us/pair", reference);
}

/// How a particle is thrown, and what.
typedef struct {
    const clx_touch_body *shape; ///< [n_shape] at scale 1, of radius about 1
    int n_shape;
    double core_scale;
    const double *scale; ///< [n] or NULL: 1
    int n;
    double cone;
    int n_ray, n_orientation;
} plan;

/// Throws particle i; the best place is inserted.
static void throw_one(clx_touch_scene *scene, const plan *p, int i)
{
    clx_rng rng = clx_rng_at(23, CLX_STREAM_TEST, (uint64_t)i);
    const double scale = p->scale != NULL ? p->scale[i] : 1.0;
    const double origin[3] = {0.0, 0.0, 0.0};
    const clx_touch_body *shape = &p->shape[clx_rng_below(&rng, p->n_shape)];
    clx_touch_body best = *shape;
    double best_t = -INFINITY;
    double axis[3];
    clx_rng_direction(&rng, axis);
    for (int ray = 0; ray < p->n_ray; ++ray) {
        double u[3];
        clx_rng_cone(&rng, axis, p->cone, u);
        v3_scale(u, -1.0, u);
        clx_touch_path path = clx_touch_path_along(u);
        for (int k = 0; k < p->n_orientation; ++k) {
            double turn[4];
            clx_touch touch;
            clx_touch_body body = *shape;
            clx_rng_orientation(&rng, turn);
            clx_touch_body_place(&body, origin, turn, scale);
            path.t_enough = best_t;
            if (clx_touch_scene_first(scene, &body, &path, &touch) && touch.t > best_t) {
                best_t = touch.t;
                best = body;
                v3_scale(best.position, touch.t, u);
            }
        }
    }
    (void)clx_touch_scene_insert(scene, &best);
}

/// Grows an aggregate; seconds, and microseconds of a trial.
static void bench_growth(const char *scene_name, const plan *p, int n_run)
{
    char name[128];
    double best = INFINITY;
    if (!is_wanted(scene_name)) {
        return;
    }
    for (int run = 0; run < n_run; ++run) {
        clx_touch_scene *scene = NULL;
        const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
        clx_touch_body core = p->shape[0];
        clx_touch_body_place(&core, (double[3]){0.0, 0.0, 0.0}, unturned, p->core_scale);
        const double begun = cpu();
        if (clx_touch_scene_create(&scene) == CLAST_OK) {
            (void)clx_touch_scene_insert(scene, &core);
            for (int i = 0; i < p->n; ++i) {
                throw_one(scene, p, i);
            }
        }
        clx_touch_scene_destroy(scene);
        best = fmin(best, cpu() - begun);
    }
    row(scene_name, best, "s", 0.0);
    (void)snprintf(name, sizeof name, "%s_trial", scene_name);
    row(name, best / ((double)p->n * p->n_ray * p->n_orientation) * 1e6, "us/trial", 0.0);
}

/// Cost of a trial when the aggregate has n bodies, grown quickly with few rays.
static void bench_scaling(void)
{
    const clx_touch_body sphere = clx_touch_body_sphere(1.0);
    const clx_touch_body ellipsoid = clx_touch_body_ellipsoid((double[3]){1.0, 0.8, 0.6});
    const clx_touch_body *shape[2] = {&sphere, &ellipsoid};
    static const char *const names[2] = {"scaling_spheres", "scaling_ellipsoids"};
    for (int kind = 0; kind < 2; ++kind) {
        if (!is_wanted(names[kind])) {
            continue;
        }
        clx_touch_scene *scene = NULL;
        plan p = {shape[kind], 1, 1.0, NULL, 0, CLAST_PI / 2.0, 10, 1};
        if (clx_touch_scene_create(&scene) != CLAST_OK ||
            clx_touch_scene_insert(scene, shape[kind]) != CLAST_OK) {
            return;
        }
        int done = 0;
        for (int n = 100; n <= 100000; n *= 10) {
            const double begun = cpu();
            const int from = done;
            for (; done < n; ++done) {
                throw_one(scene, &p, done);
            }
            char name[64];
            (void)snprintf(name, sizeof name, "%s_%d", names[kind], n);
            const double grown = cpu() - begun;
            double all = 0.0;
            const double plain = cpu();
            const clx_touch_path path = clx_touch_path_along((double[3]){0.6, 0.0, 0.8});
            for (int32_t i = 0; i < clx_touch_scene_count(scene); ++i) {
                clx_touch touch;
                all += clx_first_touch(shape[kind], clx_touch_scene_body(scene, i), &path, &touch);
            }
            row(name, grown / (10.0 * (n - from)) * 1e6, "us/trial",
                all > 0.0 ? (cpu() - plain) * 1e6 : 0.0);
        }
        clx_touch_scene_destroy(scene);
    }
}

static clx_touch_tree *tree_of_file(const char *name)
{
    clx_touch_tree *tree = NULL;
    clast_mesh mesh = {0};
    const char *path = support_shared(name);
    if (path != NULL && clast_mesh_read(path, &mesh, NULL) == CLAST_OK) {
        double low[3], high[3];
        clast_mesh_bounds(&mesh, low, high);
        for (int32_t i = 0; i < mesh.n_vert; ++i) {
            for (int k = 0; k < 3; ++k) {
                mesh.vert[i][k] -= 0.5 * (low[k] + high[k]);
            }
        }
        (void)clx_touch_tree_mesh(&mesh, &tree);
    }
    clast_mesh_free(&mesh);
    return tree;
}

/// Sizes like EJ15's and 27Sk21's: log-uniform between the ends of the published lists.
static void draw_sizes(int n, double low, double high, double *size)
{
    clx_rng rng = clx_rng_at(24, CLX_STREAM_TEST, 0);
    for (int i = 0; i < n; ++i) {
        size[i] = low * pow(high / low, clx_rng_uniform(&rng));
    }
}

static void bench_published(void)
{
    enum { N = 750 };
    double size[N];
    clx_touch_tree *coarse = tree_of_file("scarlet/stl/27sk21_shape_coarse.stl");
    clx_touch_tree *fine = tree_of_file("scarlet/stl/27sk21_shape_fine.stl");
    const clx_touch_body round[2] = {clx_touch_body_ellipsoid((double[3]){78.5, 69.0, 58.0}),
                                     clx_touch_body_ellipsoid((double[3]){14.4, 12.0, 5.5})};
    draw_sizes(N, 2.0, 9.0, size); // fine shape: 28.7 um at scale 1
    plan p = {round + 1, 1, 9.4, size, N, CLAST_PI / 180.0, 1, 1};
    bench_growth("27sk21_ellipsoids", &p, 5);
    draw_sizes(100, 0.25, 1.65, size);
    plan q = {round + 1, 1, 1.4, size, 100, 50.0 * CLAST_PI / 180.0, 30, 10};
    bench_growth("ej15t_ellipsoids", &q, 3);
    if (coarse != NULL && fine != NULL) {
        const clx_touch_body surface = clx_touch_body_tree(fine);
        bench_trees("mesh_578_650", coarse, fine, true);
        draw_sizes(N, 2.0, 9.0, size);
        p.shape = &surface;
        bench_growth("27sk21_surfaces", &p, 3);
        draw_sizes(100, 0.25, 1.65, size);
        q.shape = &surface;
        bench_growth("ej15t_surfaces", &q, 3);
    }
    clx_touch_tree_destroy(coarse);
    clx_touch_tree_destroy(fine);
}

static void bench_scans(void)
{
    clx_touch_tree *scan = tree_of_file("scarlet/stl/particle.stl");
    if (scan == NULL) {
        return;
    }
    const clx_touch_body body = clx_touch_body_tree(scan);
    bench_trees("mesh_scan_33k", scan, scan, false);
    plan p = {&body, 1, 1.0, NULL, 1000, CLAST_PI / 180.0, 1, 1};
    bench_growth("scan_1000_loose", &p, 1);
    p.n = 100;
    p.cone = 50.0 * CLAST_PI / 180.0;
    p.n_ray = 30;
    p.n_orientation = 10;
    bench_growth("scan_100_tight", &p, 1);
    clx_touch_tree_destroy(scan);
}

static void bench_composites(void)
{
    enum { N = 300 };
    static double centre[N][3];
    static double radius[N];
    clx_touch_tree *tree = NULL;
    clx_rng rng = clx_rng_at(25, CLX_STREAM_TEST, 0);
    for (int i = 0; i < N; ++i) { // inscribed in an ellipsoid, touching its surface
        const double axes[3] = {1.0, 0.8, 0.6};
        double u[3];
        clx_rng_direction(&rng, u);
        radius[i] = 0.03 + 0.12 * clx_rng_uniform(&rng);
        for (int k = 0; k < 3; ++k) {
            centre[i][k] = (axes[k] - radius[i]) * u[k];
        }
    }
    if (clx_touch_tree_spheres(N, centre, radius, &tree) == CLAST_OK) {
        const clx_touch_body body = clx_touch_body_tree(tree);
        bench_trees("composite_300", tree, tree, true);
        const plan p = {&body, 1, 3.0, NULL, 300, CLAST_PI / 2.0, 60, 30};
        bench_growth("composite_300_tight", &p, 1);
    }
    clx_touch_tree_destroy(tree);
}

int main(int argc, char **argv)
{
    n_wanted = argc - 1;
    wanted = argv + 1;
    printf("scene,value,unit,reference,ratio\n");
    bench_round("sphere_pair", true);
    bench_round("ellipsoid_pair", false);
    const clx_touch_body sphere = clx_touch_body_sphere(1.0);
    const plan spheres = {&sphere, 1, 1.0, NULL, 1000, CLAST_PI / 2.0, 100, 1};
    bench_growth("spheres_1000", &spheres, 3);
    bench_published();
    bench_composites();
    bench_scaling();
    bench_scans();
    return 0;
}
