/* Unit: domains bounded by a surface and by the caller's own map. */
#include "support.h"

#include "base/alloc.h"
#include "geom/cut_volume.h"
#include "math/rng.h"
#include <clast/cloud.h>
#include <clast/decompose.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 20000 };
static double position[3 * MOST], weight[MOST], temperature[MOST];

static clast_decompose_config config_of(const char *mesh)
{
    clast_decompose_config c;
    CHECK_OK(clast_fields_default(clast_decompose_fields, &c));
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "mesh"), &c, mesh, false));
    c.beta_dt = 1e-6;
    return c;
}

/* The prism over a polygon of n corners that lie on a circle of radius R over the angles 0 .. full,
 * from z = 0 to L; half a circle is closed by its diameter. */
static clast_mesh prism(int32_t n, double full, double r, double length)
{
    clast_mesh m = {0};
    CHECK_OK(clast_mesh_alloc(2 * n, 4 * n - 4, &m));
    const double step = full / (full < 4.0 ? n - 1 : n);
    for (int32_t i = 0; i < n; ++i) {
        for (int32_t top = 0; top < 2; ++top) {
            double *v = m.vert[i + top * n];
            v[0] = r * cos(step * i);
            v[1] = fmax(r * sin(step * i), full < 4.0 ? 0.0 : -r);
            v[2] = top * length;
        }
    }
    int32_t t = 0;
    for (int32_t i = 0; i < n; ++i) {
        const int32_t j = (i + 1) % n;
        const int32_t side[2][3] = {{i, j, j + n}, {i, j + n, i + n}};
        memcpy(m.tri[t], side, sizeof side);
        t += 2;
    }
    for (int32_t i = 1; i + 1 < n; ++i) {
        const int32_t lids[2][3] = {{0, i + 1, i}, {n, n + i, n + i + 1}};
        memcpy(m.tri[t], lids, sizeof lids);
        t += 2;
    }
    assert_int_equal(t, m.n_tri);
    return m;
}

static clast_mesh ball(double r, int level)
{
    clast_mesh m = {0};
    const double axes[3] = {r, r, r};
    CHECK_OK(clast_mesh_ellipsoid(axes, level, &m));
    return m;
}

static clast_domain domain_of(clast_mesh *mesh)
{
    clast_domain domain = {0};
    CHECK_OK(clast_domain_of_mesh(mesh, 1.0, &domain));
    clast_mesh_free(mesh);
    return domain;
}

/* x + y + z < 1 cut into 2 x 2 x 2: the corner bin keeps 1 - 1/6, its three neighbours 1/6. */
static void cut_bins_of_a_corner_are_sixths(void **state)
{
    (void)state;
    double v[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    int32_t t[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const clast_mesh corner = {4, 4, v, t};
    const clx_cut_grid grid = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    double share[8];
    CHECK_OK(clx_cut_grid_shares(&corner, &grid, share));
    for (int b = 0; b < 8; ++b) {
        const int n_high = (b & 1) + (b >> 1 & 1) + (b >> 2);
        CHECK_ABS(share[b], n_high == 0 ? 5.0 / 6 : n_high == 1 ? 1.0 / 6 : 0.0, 1e-15);
    }
    for (int k = 0; k < 4; ++k) { // turned inside out
        const int32_t held = t[k][0];
        t[k][0] = t[k][1];
        t[k][1] = held;
    }
    CHECK_STATUS(clx_cut_grid_shares(&corner, &grid, share), CLAST_E_GEOMETRY);
}

/* Bins of a hollow ball: each equals the box function, which walks another way; a tenth of them is
 * counted with 1000 points by the exact inside test (4 standard errors of 1/2); the sum is the
 * mesh's volume. */
static void cut_bins_agree_with_boxes_points_and_the_whole(void **state)
{
    (void)state;
    enum { NB = 9, N = 1000 };
    static double share[NB * NB * NB];
    clast_mesh mesh = ball(1.0, 3);
    clast_mesh hole = ball(0.3, 2);
    for (int32_t t = 0; t < hole.n_tri; ++t) {
        const int32_t held = hole.tri[t][0];
        hole.tri[t][0] = hole.tri[t][1];
        hole.tri[t][1] = held;
    }
    CHECK_OK(clast_mesh_append(&mesh, &hole));
    clast_mesh_free(&hole);
    clast_bvh *bvh = NULL;
    clast_mass mass;
    clx_cut_grid grid = {.nb = {NB, NB - 2, NB - 4}};
    clast_mesh_bounds(&mesh, grid.low, grid.high);
    CHECK_OK(clast_bvh_create(&mesh, &bvh));
    CHECK_OK(clast_mesh_mass(&mesh, &mass));
    CHECK_OK(clx_cut_grid_shares(&mesh, &grid, share));
    const int64_t n_bin = (int64_t)NB * (NB - 2) * (NB - 4);
    double sum = 0.0;
    double bin = 1.0;
    int n_full = 0;
    for (int k = 0; k < 3; ++k) {
        bin *= (grid.high[k] - grid.low[k]) / grid.nb[k];
    }
    for (int64_t b = 0; b < n_bin; ++b) {
        const int64_t at[3] = {b / ((NB - 2) * (NB - 4)), b / (NB - 4) % (NB - 2), b % (NB - 4)};
        double low[3], high[3];
        for (int k = 0; k < 3; ++k) {
            const double side = (grid.high[k] - grid.low[k]) / grid.nb[k];
            low[k] = grid.low[k] + side * (double)at[k];
            high[k] = grid.low[k] + side * (double)(at[k] + 1);
        }
        CHECK_ABS(share[b], clx_cut_box_share(bvh, low, high), 1e-12);
        sum += share[b] * bin;
        n_full += share[b] == 1.0 ? 1 : 0;
        int n_inside = 0;
        for (int i = 0; i < N && b % 10 == 0; ++i) {
            clx_rng rng = clx_rng_at(4, CLX_STREAM_TEST, (uint64_t)(b * N + i));
            double x[3];
            for (int k = 0; k < 3; ++k) {
                x[k] = low[k] + (high[k] - low[k]) * clx_rng_uniform(&rng);
            }
            n_inside += clast_bvh_inside(bvh, x) ? 1 : 0;
        }
        if (b % 10 == 0) {
            CHECK_ABS((double)n_inside / N, share[b], 4.0 * 0.5 / sqrt(N));
        }
    }
    CHECK_REL(sum, mass.volume, 1e-12);
    assert_true(n_full > 10);
    clast_bvh_destroy(bvh);
    clast_mesh_free(&mesh);
}

/* Half of the points uniform in the body, half in a plume along z. */
static int64_t plume(const clast_domain *domain, int64_t n, uint64_t seed)
{
    double *x = position;
    int64_t kept = 0;
    for (uint64_t i = 0; kept < n; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, i);
        double u[3];
        x[3 * kept + 2] = clx_rng_uniform(&rng);
        x[3 * kept] = 0.1 * (2.0 * clx_rng_uniform(&rng) - 1.0);
        x[3 * kept + 1] = 0.1 * (2.0 * clx_rng_uniform(&rng) - 1.0);
        if (kept % 2 == 0) {
            x[3 * kept] = 0.02 * clx_rng_normal(&rng);
            x[3 * kept + 1] = 0.05 + 0.02 * clx_rng_normal(&rng);
        }
        kept += clast_domain_map(domain, x + 3 * kept, u) ? 1 : 0;
    }
    return kept;
}

static double sum_of(const double *value, int32_t n)
{
    double sum = 0.0;
    for (int32_t c = 0; c < n; ++c) {
        sum += value[c];
    }
    return sum;
}

/* A half pipe as a surface of 200 flat faces and as a map: every cell kind holds all points and the
 * whole volume. The two estimates share their points, so they differ by the cells alone. In tree
 * cells and bins, which are not joined by their counts, by less than the half width of the stated
 * interval (a twentieth or more here). */
static void a_half_pipe_of_triangles_is_the_half_pipe(void **state)
{
    (void)state;
    static const char *const kind[5] = {"boxes", "components", "bins", "labels", "tree"};
    clast_mesh mesh = prism(201, CLAST_PI, 0.1, 1.0);
    clast_domain pipe = {0};
    const clast_domain surface = domain_of(&mesh);
    CHECK_OK(clast_domain_parse("half-pipe:0.1,1", &pipe));
    CHECK_REL(clast_domain_volume(&surface), clast_domain_volume(&pipe), 5e-5); // pi^2 / 6 n^2
    const clast_cloud cloud = {.n = plume(&surface, 3000, 1), .dimension = 3, .x = position};
    for (int k = 0; k < 5; ++k) {
        clast_decompose_config c = config_of(kind[k]);
        clast_decomposition a = {0};
        clast_decomposition b = {0};
        CHECK_OK(clast_decompose_in(&surface, &cloud, &c, &a));
        CHECK_OK(clast_decompose_in(&pipe, &cloud, &c, &b));
        assert_true(a.before.reject && b.before.reject && a.cells.n > 4);
        CHECK_REL(sum_of(a.cells.volume, a.cells.n), clast_domain_volume(&surface), 1e-12);
        int64_t n = 0;
        for (int32_t i = 0; i < a.cells.n; ++i) {
            assert_true(a.cells.volume[i] > 0.0);
            n += a.cells.count[i];
        }
        assert_int_equal(n, cloud.n);
        assert_int_equal(a.n, cloud.n);
        CHECK_REL((double)a.n_test, (double)cloud.n * 4.0 / CLAST_PI, 1e-3);
        for (int64_t i = 0; i < cloud.n; i += 7) { // rounding on edges aside, a cell is where it is
            assert_int_equal(clast_cells_locate(&a.cells, &surface, position + 3 * i),
                             a.cells.of_point[i]);
        }
        if (k == 2 || k == 4) {
            CHECK_ABS(a.events, b.events, a.events_high - a.events);
        }
        clast_decomposition_free(&a);
        clast_decomposition_free(&b);
        clast_fields_free(clast_decompose_fields, &c);
    }
    clast_domain held = surface;
    clast_domain_free(&held);
}

/* Uniform points of a ball and of a cylinder stay one cell in 95 % of 20 samples or more (4 sd of a
 * binomial: at least 15), as surface and as map. */
static void uniform_points_of_a_body_stay_uniform(void **state)
{
    (void)state;
    enum { R = 20, N = 300 };
    static const char *const text[2] = {"sphere:0.1", "cylinder:0.1,1"};
    clast_mesh mesh[2] = {ball(0.1, 4), prism(200, 2.0 * CLAST_PI, 0.1, 1.0)};
    for (int body = 0; body < 2; ++body) {
        clast_domain map = {0};
        clast_domain surface = domain_of(&mesh[body]);
        clast_decompose_config c = config_of("boxes");
        int n_one[2] = {0};
        CHECK_OK(clast_domain_parse(text[body], &map));
        for (int r = 0; r < R; ++r) {
            for (int i = 0; i < N;) {
                clx_rng rng = clx_rng_at((uint64_t)r, CLX_STREAM_TEST, (uint64_t)i);
                double u[3];
                do {
                    for (int k = 0; k < 3; ++k) {
                        u[k] = clx_rng_uniform(&rng);
                    }
                    clast_domain_unmap(&surface, u, position + 3 * i);
                } while (!clast_domain_map(&surface, position + 3 * i, u));
                ++i;
            }
            const clast_cloud cloud = {.n = N, .dimension = 3, .x = position};
            const clast_domain *domain[2] = {&surface, &map};
            for (int k = 0; k < 2; ++k) {
                clast_decomposition d = {0};
                CHECK_OK(clast_decompose_in(domain[k], &cloud, &c, &d));
                n_one[k] += d.cells.n == 1 ? 1 : 0;
                CHECK_REL(d.cells.n > 1 ? 1.0 : d.events * clast_domain_volume(domain[k]),
                          d.cells.n > 1 ? 1.0 : 0.5e-6 * N * (N - 1), 1e-12);
                clast_decomposition_free(&d);
            }
        }
        assert_in_range(n_one[0], 15, R);
        assert_in_range(n_one[1], 15, R);
        clast_domain_free(&surface);
        clast_fields_free(clast_decompose_fields, &c);
    }
}

/* An L: two cubes side by side and one above; a point on an inner face belongs to a cell with
 * volume. */
static void points_on_faces_are_in_a_cell(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    double v[12][3];
    static const double corner[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    static const int32_t lid[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
    int32_t t[20][3];
    for (int i = 0; i < 6; ++i) {
        for (int top = 0; top < 2; ++top) {
            v[i + 6 * top][0] = corner[i][0];
            v[i + 6 * top][1] = corner[i][1];
            v[i + 6 * top][2] = top;
        }
        const int j = (i + 1) % 6;
        const int32_t side[2][3] = {{i, j, j + 6}, {i, j + 6, i + 6}};
        memcpy(t[2 * i], side, sizeof side);
    }
    for (int i = 0; i < 4; ++i) {
        const int32_t both[2][3] = {{lid[i][0], lid[i][2], lid[i][1]},
                                    {lid[i][0] + 6, lid[i][1] + 6, lid[i][2] + 6}};
        memcpy(t[12 + 2 * i], both, sizeof both);
    }
    const clast_mesh outline = {12, 20, v, t};
    CHECK_OK(clast_mesh_copy(&outline, &mesh));
    clast_domain domain = domain_of(&mesh);
    CHECK_REL(clast_domain_volume(&domain), 3.0, 1e-15);
    for (int i = 0; i < 900; ++i) { // dense in one arm, and 100 points on the inner faces
        clx_rng rng = clx_rng_at(2, CLX_STREAM_TEST, (uint64_t)i);
        position[3 * i] = i < 700 ? clx_rng_uniform(&rng) : 2.0 * clx_rng_uniform(&rng);
        position[3 * i + 1] = i < 700 ? 2.0 * clx_rng_uniform(&rng) : clx_rng_uniform(&rng);
        position[3 * i + 2] = clx_rng_uniform(&rng);
        if (i >= 800) {
            position[3 * i] = i % 2 == 0 ? 1.0 : 1.0 + clx_rng_uniform(&rng);
            position[3 * i + 1] = i % 2 == 1 ? 1.0 : 1.0 + clx_rng_uniform(&rng);
        }
    }
    const clast_cloud cloud = {.n = 900, .dimension = 3, .x = position};
    static const char *const kind[2] = {"bins", "tree"};
    for (int k = 0; k < 2; ++k) {
        clast_decompose_config c = config_of(kind[k]);
        clast_decomposition r = {0};
        CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "variant"), &c, "fast",
                                 false));
        CHECK_OK(clast_decompose_in(&domain, &cloud, &c, &r));
        CHECK_REL(sum_of(r.cells.volume, r.cells.n), 3.0, 1e-12);
        CHECK_REL(sum_of(r.cells.weight, r.cells.n), 900.0, 0.0);
        for (int i = 0; i < 900; ++i) {
            assert_in_range(r.cells.of_point[i], 0, r.cells.n - 1);
        }
        clast_decomposition_free(&r);
        clast_fields_free(clast_decompose_fields, &c);
    }
    position[0] = position[1] = 1.5; // in the notch
    clast_decompose_config c = config_of("boxes");
    clast_decomposition r = {0};
    CHECK_STATUS(clast_decompose_in(&domain, &cloud, &c, &r), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "1 of 900 points lie outside"));
    clast_fields_free(clast_decompose_fields, &c);
    clast_domain_free(&domain);
}

static void surfaces_that_bound_nothing_are_refused(void **state)
{
    (void)state;
    clast_domain domain = {0};
    clast_mesh mesh = ball(1.0, 1);
    clast_mesh other = ball(0.5, 1);
    --mesh.n_tri;
    CHECK_STATUS(clast_domain_of_mesh(&mesh, 1.0, &domain), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "open: 3 open edges"));
    ++mesh.n_tri;
    for (int32_t i = 0; i < other.n_vert; ++i) {
        other.vert[i][0] += 0.9;
    }
    clast_mesh both = {0};
    CHECK_OK(clast_mesh_copy(&mesh, &both));
    CHECK_OK(clast_mesh_append(&both, &other));
    CHECK_STATUS(clast_domain_of_mesh(&both, 1.0, &domain), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "cuts itself"));
    for (int32_t i = 0; i < other.n_vert; ++i) {
        both.vert[mesh.n_vert + i][0] -= 0.9; // inside, and turned outward
    }
    CHECK_STATUS(clast_domain_of_mesh(&both, 1.0, &domain), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "lies in 1 others"));
    for (int32_t t = 0; t < mesh.n_tri; ++t) {
        const int32_t held = mesh.tri[t][0];
        mesh.tri[t][0] = mesh.tri[t][1];
        mesh.tri[t][1] = held;
    }
    CHECK_STATUS(clast_domain_of_mesh(&mesh, 1.0, &domain), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "not oriented outward"));
    assert_null(domain.surface);
    CHECK_STATUS(clast_domain_parse("mesh:a.stl", &domain), CLAST_E_CONFIG);
    CHECK_STATUS(clast_domain_read("mesh:", NULL, &domain), CLAST_E_IO);
    CHECK_STATUS(clast_domain_read("box:0,1", "kg", &domain), CLAST_E_CONFIG);
    clast_mesh_free(&mesh);
    clast_mesh_free(&other);
    clast_mesh_free(&both);
}

/* Names in any unit, read back as they are written in m; a body that lies anywhere holds the points
 * of the one about the origin, moved and turned. */
static void names_have_units_and_places(void **state)
{
    (void)state;
    static const char *const name[][3] = {
        {"box:0,0,0,1mm,2mm,3cm", "", "box:0,0,0,0.001,0.002,0.03"},
        {"box:0,0,10,2cm", "mm", "box:0,0,0.01,0.02"},
        {"cylinder:5,2 m", "mm", "cylinder:0.005,2"},
        {"half-pipe:0.1,1", "", "half-pipe:0.1,1"},
        {"sphere:1,2,3,4", "mm", "sphere:0.001,0.002,0.003,0.004"},
        {"cylinder:1,2,3,0,0,5,4,6", "mm", "cylinder:0.001,0.002,0.003,0,0,1,0.004,0.006"}};
    char text[CLAST_DOMAIN_TEXT];
    clast_domain domain = {0};
    for (size_t k = 0; k < sizeof name / sizeof name[0]; ++k) {
        CHECK_OK(clast_domain_read(name[k][0], name[k][1], &domain));
        clast_domain_format(&domain, text);
        assert_string_equal(text, name[k][2]);
        CHECK_OK(clast_domain_parse(text, &domain));
    }
    CHECK_OK(clast_domain_parse("cylinder:1,2,3,1,2,2,0.5,4", &domain));
    CHECK_REL(clast_domain_volume(&domain), CLAST_PI, 1e-15);
    for (uint64_t i = 0; i < 1000; ++i) {
        clx_rng rng = clx_rng_at(2, CLX_STREAM_TEST, i);
        const double u[3] = {clx_rng_uniform(&rng), clx_rng_uniform(&rng), clx_rng_uniform(&rng)};
        double x[3];
        double back[3];
        clast_domain_unmap(&domain, u, x);
        const double from[3] = {x[0] - 1.0, x[1] - 2.0, x[2] - 3.0};
        const double along = (from[0] + 2.0 * from[1] + 2.0 * from[2]) / 3.0;
        const double square = from[0] * from[0] + from[1] * from[1] + from[2] * from[2];
        CHECK_ABS(along, 4.0 * u[2], 1e-13);
        CHECK_ABS(square - along * along, 0.25 * u[0], 1e-13);
        assert_true(clast_domain_map(&domain, x, back));
        CHECK_ABS(back[1], u[1], 1e-12);
    }
    CHECK_STATUS(clast_domain_parse_in("box:0,1", 0.0, &domain), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_domain_parse("box:0,0,,1", &domain), CLAST_E_CONFIG);
}

/* Before, volumes of 0 and INFINITY went through, and shares and events were 0, NaN or INFINITY. */
static void domains_without_a_volume_are_refused(void **state)
{
    (void)state;
    static const char *const bad[] = {"sphere:1e-120",
                                      "sphere:1e120",
                                      "cylinder:1e-200,1",
                                      "half-pipe:1,1e300",
                                      "box:-1e300,-1e300,-1e300,1e300,1e300,1e300",
                                      "box:-1e308,1e308",
                                      "box:0,0,1e-160,1"};
    static const char *const fine[] = {"sphere:1e-40", "sphere:1e40", "box:0,0,1e-100,1e100"};
    const double radius = 1.0;
    double share = -7.0;
    clast_domain domain = {0};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        CHECK_STATUS(clast_domain_parse(bad[k], &domain), CLAST_E_CONFIG);
        assert_non_null(strstr(clast_error_detail(), "volume"));
    }
    for (size_t k = 0; k < sizeof fine / sizeof fine[0]; ++k) {
        CHECK_OK(clast_domain_parse(fine[k], &domain));
    }
    domain = (clast_domain){
        .kind = CLAST_DOMAIN_SPHERE, .dimension = 3, .radius = 1e-120, .length = 1.0};
    CHECK_STATUS(clast_pairs_uniform(&domain, 1, &radius, &share, NULL), CLAST_E_ARGUMENT);
    assert_non_null(strstr(clast_error_detail(), "volume"));
    assert_true(share == -7.0);
}

/* The ellipse x^2/9 + y^2 < 1 by (r^2, angle), area 3 pi. */
static bool to_square(const void *context, const double *x, double *u)
{
    const double *power = context;
    u[0] = pow(x[0] * x[0] / 9.0 + x[1] * x[1], *power);
    u[1] = 0.5 + 0.5 * atan2(x[1], x[0] / 3.0) / CLAST_PI;
    return u[0] <= 1.0;
}

static void to_ellipse(const void *context, const double *u, double *x)
{
    const double *power = context;
    const double r = pow(u[0], 0.5 / *power);
    x[0] = 3.0 * r * cos((2.0 * u[1] - 1.0) * CLAST_PI);
    x[1] = r * sin((2.0 * u[1] - 1.0) * CLAST_PI);
}

static void a_map_of_the_caller_is_a_domain(void **state)
{
    (void)state;
    double power = 1.0;
    clast_domain_map_functions f = {2, 3.0 * CLAST_PI, to_square, to_ellipse, &power};
    clast_domain domain = {0};
    CHECK_OK(clast_domain_of_map(&f, &domain));
    CHECK_REL(clast_domain_volume(&domain), 3.0 * CLAST_PI, 0.0);
    for (int i = 0; i < 1000; ++i) {
        clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, (uint64_t)i);
        const double u[2] = {clx_rng_uniform(&rng), clx_rng_uniform(&rng)};
        to_ellipse(&power, u, position + 2 * i);
    }
    clast_decompose_config c = config_of("boxes");
    clast_decomposition r = {0};
    clast_cloud cloud = {.n = 1000, .dimension = 2, .x = position};
    CHECK_OK(clast_decompose_in(&domain, &cloud, &c, &r));
    assert_int_equal(r.cells.n, 1);
    CHECK_REL(r.events, 0.5e-6 * 1000 * 999 / (3.0 * CLAST_PI), 1e-12);
    clast_decomposition_free(&r);
    position[0] = 3.1;
    position[1] = 0.0;
    CHECK_STATUS(clast_decompose_in(&domain, &cloud, &c, &r), CLAST_E_FORMAT);
    power = 0.5; // (r, angle): uniform points would crowd at the rim
    CHECK_STATUS(clast_domain_of_map(&f, &domain), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "keep uniform points uniform"));
    power = 1.0;
    f.volume = 3.0;
    CHECK_STATUS(clast_domain_of_map(&f, &domain), CLAST_E_CONFIG);
    f.volume = -1.0;
    CHECK_STATUS(clast_domain_of_map(&f, &domain), CLAST_E_CONFIG);
    clast_fields_free(clast_decompose_fields, &c);
}

/* Parcels twice as dense on the left, each of half the weight: real particles are uniform there.
 * The tests see it (one cell, all pairs), without weights they do not. */
static void weighted_parcels_are_tested_as_real_particles(void **state)
{
    (void)state;
    enum { N = 3000 };
    double pairs = 0.0;
    double sum = 0.0;
    for (int i = 0; i < N; ++i) {
        clx_rng rng = clx_rng_at(8, CLX_STREAM_TEST, (uint64_t)i);
        const bool is_left = clx_rng_uniform(&rng) < 2.0 / 3.0;
        position[2 * i] = 0.5 * clx_rng_uniform(&rng) + (is_left ? 0.0 : 0.5);
        position[2 * i + 1] = clx_rng_uniform(&rng);
        weight[i] = is_left ? 1.0 : 2.0;
        sum += weight[i];
        pairs -= weight[i] * weight[i];
    }
    pairs += sum * sum;
    clast_cloud cloud = {.n = N, .dimension = 2, .x = position};
    clast_decompose_config c = config_of("boxes");
    clast_decomposition r = {0};
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "domain"), &c, "box:0,0,1,1",
                             false));
    CHECK_OK(clast_decompose(&cloud, &c, &r));
    assert_true(r.before.reject && r.cells.n > 1);
    clast_decomposition_free(&r);
    cloud.weight = weight;
    CHECK_OK(clast_decompose(&cloud, &c, &r));
    assert_true(!r.before.reject && r.cells.n == 1);
    assert_in_range(r.n_test, 1800, 2200); // 2/3 of the parcels with 1/2, 1/3 with 1
    assert_int_equal(r.n, N);
    CHECK_REL(r.events, 0.5e-6 * pairs, 1e-12);
    clast_decomposition_free(&r);
    clast_fields_free(clast_decompose_fields, &c);
}

/* Uniform points, but hot where x < 1/4: the tree parts hot from cold and nothing else (16 cells of
 * 4 x 4 at the most, given the split at 1/2 and 1/4), and a tolerance above the spread stops it. */
static void tree_cells_are_uniform_in_a_variable(void **state)
{
    (void)state;
    enum { N = 4000 };
    for (int i = 0; i < N; ++i) {
        clx_rng rng = clx_rng_at(12, CLX_STREAM_TEST, (uint64_t)i);
        position[2 * i] = clx_rng_uniform(&rng);
        position[2 * i + 1] = clx_rng_uniform(&rng);
        temperature[i] = (position[2 * i] < 0.25 ? 320.0 : 300.0) + clx_rng_normal(&rng);
    }
    clast_cloud cloud = {.n = N, .dimension = 2, .x = position, .variable = temperature};
    clast_decompose_config c = config_of("tree");
    clast_decomposition r = {0};
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "domain"), &c, "box:0,0,1,1",
                             false));
    CHECK_OK(clast_decompose(&cloud, &c, &r));
    assert_in_range(r.cells.n, 7, 16);
    for (int32_t k = 0; k < r.cells.n; ++k) {
        assert_true(r.cells.low[k][0] >= 0.25 || r.cells.high[k][0] <= 0.25);
    }
    clast_decomposition_free(&r);
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "variable_tolerance"), &c,
                             "10", false));
    CHECK_OK(clast_decompose(&cloud, &c, &r));
    assert_int_equal(r.cells.n, 1);
    clast_decomposition_free(&r);
    c.mesh = CLAST_CELLS_BOXES;
    CHECK_STATUS(clast_decompose(&cloud, &c, &r), CLAST_E_CONFIG);
    clast_fields_free(clast_decompose_fields, &c);
}

static clast_status decompose_once(void *context)
{
    clast_decompose_config *c = context;
    clast_domain domain = {0};
    clast_decomposition r = {0};
    clast_mesh mesh = {0};
    clast_status status = clast_mesh_box(1.0, 2.0, 3.0, &mesh);
    if (status == CLAST_OK) {
        mesh.vert[0][0] -= 0.5; // not its bounding box
        status = clast_domain_of_mesh(&mesh, 1.0, &domain);
    }
    if (status == CLAST_OK) {
        const clast_cloud cloud = {
            .n = 12, .dimension = 3, .x = position, .weight = weight, .variable = temperature};
        status = clast_decompose_in(&domain, &cloud, c, &r);
    }
    clast_decomposition_free(&r);
    clast_domain_free(&domain);
    clast_mesh_free(&mesh);
    return status;
}

static void every_refused_allocation_is_told(void **state)
{
    (void)state;
    clast_decompose_config c = config_of("tree");
    c.variant = CLAST_VARIANT_FAST;
    c.tree_least = 2;
    for (int i = 0; i < 36; ++i) {
        position[i] = 0.1 * (i % 5) * (i % 3 == 0 ? 0.5 : 1.0);
        weight[i] = 1.0 + i % 2;
    }
    c.outside = CLAST_OUTSIDE_DROP;
    support_refuse_each_allocation(decompose_once, &c);
    clast_fields_free(clast_decompose_fields, &c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_have_units_and_places),
        cmocka_unit_test(domains_without_a_volume_are_refused),
        cmocka_unit_test(cut_bins_of_a_corner_are_sixths),
        cmocka_unit_test(cut_bins_agree_with_boxes_points_and_the_whole),
        cmocka_unit_test(a_half_pipe_of_triangles_is_the_half_pipe),
        cmocka_unit_test(uniform_points_of_a_body_stay_uniform),
        cmocka_unit_test(points_on_faces_are_in_a_cell),
        cmocka_unit_test(surfaces_that_bound_nothing_are_refused),
        cmocka_unit_test(a_map_of_the_caller_is_a_domain),
        cmocka_unit_test(weighted_parcels_are_tested_as_real_particles),
        cmocka_unit_test(tree_cells_are_uniform_in_a_variable),
        cmocka_unit_test(every_refused_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
