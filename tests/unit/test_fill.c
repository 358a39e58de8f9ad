/* Unit: fillings of textbook bodies; the measures against closed forms; every refusal. */
#include "brute_mesh.h"
#include "mesh_maker.h"
#include "support.h"

#include <clast/fill.h>
#include <string.h>

static clast_fill_config settings(int32_t spheres)
{
    clast_fill_config config;
    CHECK_OK(clast_fields_default(clast_fill_fields, &config));
    config.spheres = spheres;
    config.tolerance = 1e-3;
    return config;
}

static void done_with(clast_fill_config *config)
{
    clast_fields_free(clast_fill_fields, config);
}

/* Fills and frees nothing but the settings. */
static void fill(const clast_mesh *mesh, clast_fill_config *config, clast_spheres *spheres,
                 clast_fill_report *report)
{
    CHECK_OK(clast_fill(mesh, config, NULL, spheres, report));
    done_with(config);
}

/* Cone of n sides: apex at (0, 0, height), base of circumradius r in z = 0. */
static void make_cone(int n, double r, double height, clast_mesh *mesh)
{
    CHECK_OK(clast_mesh_alloc(n + 2, 2 * n, mesh));
    mesh->vert[n][2] = height;
    for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * CLAST_PI * i / n;
        const int next = (i + 1) % n;
        mesh->vert[i][0] = r * cos(angle);
        mesh->vert[i][1] = r * sin(angle);
        const int32_t tri[2][3] = {{i, next, n}, {next, i, n + 1}};
        memcpy(mesh->tri[2 * i], tri, sizeof tri);
    }
}

/* A scan with one vertex far out (a unit slip, a stray digit): the search for spheres took
 * gigabytes and crashed. */
static void solid_with_a_far_vertex_is_refused(void **state)
{
    (void)state;
    static const double far[] = {1e5, 1e6, 1e15, 1e150};
    for (size_t i = 0; i < sizeof far / sizeof far[0]; ++i) {
        clast_mesh box = {0};
        clast_spheres s = {0};
        clast_fill_report report = {0};
        clast_fill_config config = settings(20);
        CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &box));
        box.vert[box.n_vert - 1][2] *= far[i];
        CHECK_STATUS(clast_fill(&box, &config, NULL, &s, &report), CLAST_E_GEOMETRY);
        assert_int_equal(s.n, 0);
        done_with(&config);
        clast_mesh_free(&box);
    }
}

/* Two corners of a triangle in one place: the distance to it was 0 / 0, the search read a triangle
 * that was never set, and its spheres were 4 % too small. */
static void solid_with_an_empty_triangle_is_filled(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_mesh with = {0};
    clast_spheres s[2] = {{0}, {0}};
    clast_fill_report report;
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &box));
    for (int turn = 0; turn < 3; ++turn) {
        CHECK_OK(clast_mesh_alloc(box.n_vert, box.n_tri + 2, &with));
        memcpy(with.vert, box.vert, (size_t)box.n_vert * sizeof *box.vert);
        memcpy(with.tri, box.tri, (size_t)box.n_tri * sizeof *box.tri);
        const int32_t a = box.tri[0][0];
        const int32_t b = box.tri[0][1];
        const int32_t empty[2][3] = {{a, a, b}, {a, b, b}};
        for (int i = 0; i < 2; ++i) {
            for (int k = 0; k < 3; ++k) {
                with.tri[box.n_tri + i][k] = empty[i][(k + turn) % 3];
            }
        }
        clast_fill_config config[2] = {settings(10), settings(10)};
        fill(&with, &config[1], &s[1], &report);
        fill(&box, &config[0], &s[0], &report);
        assert_int_equal(s[1].n, s[0].n);
        assert_memory_equal(s[1].radius, s[0].radius, (size_t)s[0].n * sizeof *s[0].radius);
        clast_spheres_free(&s[0]);
        clast_spheres_free(&s[1]);
        clast_mesh_free(&with);
    }
    clast_mesh_free(&box);
}

/* A cube's inscribed sphere, then eight in the corners: their centres lie on the diagonals, where
 * sqrt(3) (1/2 - r) = 1/2 + r. The published method needs a remeshed cube for this. */
static void cube_takes_its_inscribed_sphere_then_the_corners(void **state)
{
    (void)state;
    clast_mesh cube = {0};
    clast_spheres s = {0};
    clast_fill_report report;
    clast_fill_config config = settings(9);
    config.tolerance = 1e-6;
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &cube));
    fill(&cube, &config, &s, &report);
    assert_int_equal(s.n, 9);
    CHECK_ABS(s.radius[0], 0.5, 0.0);
    for (int k = 0; k < 3; ++k) {
        CHECK_ABS(s.centre[0][k], 0.5, 0.0);
    }
    const double corner = 0.5 * (sqrt(3.0) - 1.0) / (sqrt(3.0) + 1.0);
    for (int i = 1; i < 9; ++i) {
        CHECK_REL(s.radius[i], corner, 2e-6);
    }
    assert_int_equal(report.end, CLAST_FILL_BY_COUNT);
    assert_true(report.max_protrusion <= 1e-14);
    assert_true(report.max_overlap <= 1e-14);
    clast_spheres_free(&s);
    clast_mesh_free(&cube);
}

static void tetrahedron_and_cone_take_their_inscribed_spheres(void **state)
{
    (void)state;
    const double vert[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    const int32_t tri[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    clast_mesh mesh = {0};
    clast_spheres s = {0};
    clast_fill_config config = settings(1);
    config.tolerance = 1e-9;
    mesh_of(vert, 4, tri, 4, &mesh);
    fill(&mesh, &config, &s, NULL);
    CHECK_REL(s.radius[0], 2.0 * sqrt(2.0) / sqrt(24.0), 2e-9); /* edge / sqrt(24) */
    clast_spheres_free(&s);
    clast_mesh_free(&mesh);

    config = settings(1);
    config.tolerance = 1e-9;
    make_cone(7, 2.0, 3.0, &mesh);
    fill(&mesh, &config, &s, NULL);
    const double apothem = 2.0 * cos(CLAST_PI / 7);
    CHECK_REL(s.radius[0], 3.0 * apothem / (apothem + hypot(3.0, apothem)), 2e-9);
    clast_spheres_free(&s);
    clast_mesh_free(&mesh);
}

/* A slab has a whole plane of greatest spheres: no single summit to close in on. */
static void slab_with_a_plane_of_summits_is_filled(void **state)
{
    (void)state;
    clast_mesh slab = {0};
    clast_spheres s = {0};
    clast_fill_report report;
    clast_fill_config config = settings(64);
    CHECK_OK(clast_mesh_box(8.0, 8.0, 1.0, &slab));
    fill(&slab, &config, &s, &report);
    CHECK_REL(s.radius[0], 0.5, 1e-3);
    CHECK_REL(s.radius[20], 0.5, 1e-3); /* room for many of the same size */
    assert_true(report.n_tested < 20000);
    clast_spheres_free(&s);
    clast_mesh_free(&slab);
}

static void two_bodies_are_filled_by_size(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_spheres s = {0};
    clast_fill_config config = settings(2);
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    mesh_add_box(&mesh, 2.0, 5.0, 0.0, 0.0);
    fill(&mesh, &config, &s, NULL);
    CHECK_REL(s.radius[0], 1.0, 1e-3);
    CHECK_REL(s.radius[1], 0.5, 1e-3);
    clast_spheres_free(&s);
    clast_mesh_free(&mesh);
}

/* Bodies that overlap are a union for the inside, but every triangle counts as wall. */
static void hollow_body_is_filled_between_its_walls(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh hole = {0};
    clast_spheres s = {0};
    clast_fill_report report;
    clast_fill_config config = settings(40);
    mesh_add_box(&mesh, 4.0, -2.0, -2.0, -2.0);
    mesh_add_box(&hole, 2.0, -1.0, -1.0, -1.0);
    mesh_flip_all(&hole);
    CHECK_OK(clast_mesh_append(&mesh, &hole));
    fill(&mesh, &config, &s, &report);
    CHECK_REL(report.solid_volume, 64.0 - 8.0, 1e-14);
    /* the largest sits in an outer corner and touches the corner of the hole at (1, 1, 1) */
    CHECK_REL(s.radius[0], sqrt(3.0) / (1.0 + sqrt(3.0)), 1e-3);
    for (int32_t i = 0; i < s.n; ++i) {
        assert_true(fabs(s.centre[i][0]) > 1.0 || fabs(s.centre[i][1]) > 1.0 ||
                    fabs(s.centre[i][2]) > 1.0);
    }
    assert_true(report.max_protrusion <= 1e-14);
    clast_spheres_free(&s);
    clast_mesh_free(&hole);
    clast_mesh_free(&mesh);
}

static void ball_is_one_sphere(void **state)
{
    (void)state;
    const double axes[3] = {1.0, 1.0, 1.0};
    clast_mesh ball = {0};
    clast_spheres s = {0};
    clast_fill_report report;
    clast_fill_config config = settings(0);
    config.filled = 0.98;
    CHECK_OK(clast_mesh_ellipsoid(axes, 4, &ball));
    fill(&ball, &config, &s, &report);
    assert_int_equal(s.n, 1);
    assert_int_equal(report.end, CLAST_FILL_BY_QUALITY);
    assert_true(report.filled_fraction > 0.98);
    CHECK_ABS(report.centroid_error, 0.0, 1e-12);
    CHECK_REL(report.bound, s.radius[0], 0.01); /* nothing was asked after the first */
    clast_spheres_free(&s);
    clast_mesh_free(&ball);
}

/* One sphere of radius 1/2 in a unit cube: I/V is 2 r^2 / 5 = 0.1 against 1/6 on the diagonal. */
static void measures_of_one_sphere_are_closed_forms(void **state)
{
    (void)state;
    double centre[1][3] = {{0.5, 0.5, 0.5}};
    double radius[1] = {0.5};
    const clast_spheres s = {1, centre, radius};
    clast_mesh cube = {0};
    clast_fill_report r;
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &cube));
    CHECK_OK(clast_fill_measure(&cube, &s, &r));
    CHECK_REL(r.filled_fraction, CLAST_PI / 6.0, 1e-14);
    CHECK_REL(r.volume_error, 1.0 - CLAST_PI / 6.0, 1e-14);
    CHECK_ABS(r.centroid_error, 0.0, 1e-15);
    CHECK_REL(r.inertia_error, 0.4, 1e-13);
    CHECK_ABS(r.max_protrusion, 0.0, 1e-15);
    /* mean over a face of the distance to the sphere: integral of sqrt(x^2 + y^2 + 1/4) - 1/2 */
    CHECK_REL(r.deviation_mean, 0.6402 - 0.5, 0.01);
    CHECK_REL(r.deviation_max, sqrt(0.75) - 0.5, 0.05);
    centre[0][0] = 0.7;
    CHECK_OK(clast_fill_measure(&cube, &s, &r));
    CHECK_REL(r.max_protrusion, 0.4, 1e-12); /* 0.2 of 0.5 beyond x = 1 */
    CHECK_REL(r.centroid_error, 0.2 / cbrt(6.0 / CLAST_PI), 1e-13);
    centre[0][0] = 1.25;
    CHECK_OK(clast_fill_measure(&cube, &s, &r));
    CHECK_REL(r.max_protrusion, 1.5, 1e-12); /* a centre outside */
    assert_int_equal(r.n_protruding, 1);
    clast_mesh_free(&cube);
}

static void measures_of_overlapping_spheres_count_the_union(void **state)
{
    (void)state;
    double centre[2][3] = {{0.5, 0.5, 0.5}, {1.0, 0.5, 0.5}};
    double radius[2] = {0.5, 0.5};
    const clast_spheres s = {2, centre, radius};
    clast_mesh box = {0};
    clast_fill_report r;
    CHECK_OK(clast_mesh_box(1.5, 1.0, 1.0, &box));
    CHECK_OK(clast_fill_measure(&box, &s, &r));
    /* two spheres of radius R at distance R: the lens is 5 pi R^3 / 12 */
    const double lens = 5.0 * CLAST_PI * 0.125 / 12.0;
    CHECK_REL(r.sphere_volume, CLAST_PI / 3.0 - lens, 1e-9);
    CHECK_REL(r.max_overlap, 1.0, 1e-14);
    CHECK_ABS(r.centroid_error, 0.0, 1e-9);
    clast_mesh_free(&box);
}

/* Of a ball about a face's middle one half is in the box, of two about one point no more; of one
 * about a corner an eighth; one outside is all outside. filled was their volume by the box's. */
static void filled_counts_what_is_in_the_solid(void **state)
{
    (void)state;
    double centre[4][3] = {{2.0, 1.0, 1.0}, {2.0, 1.0, 1.0}, {0.0, 0.0, 2.0}, {9.0, 0.0, 0.0}};
    double radius[4] = {0.8, 0.4, 0.5, 1.0};
    const double unit = 4.0 / 3.0 * CLAST_PI;
    const double in = unit * (0.5 * 0.512 + 0.125 * 0.125) / 8.0;
    const double all = unit * (0.512 + 0.125 + 1.0) / 8.0;
    clast_spheres s = {4, centre, radius};
    clast_mesh box = {0};
    clast_table table = {0};
    clast_fill_report r;
    CHECK_OK(clast_mesh_box(2.0, 2.0, 2.0, &box));
    CHECK_OK(clast_fill_measure(&box, &s, &r));
    CHECK_REL(r.sphere_volume / r.solid_volume, all, 1e-12);
    CHECK_ABS(r.filled_fraction, in, 1e-3);
    CHECK_ABS(r.filled_fraction + r.outside_fraction, all, 1e-12);
    CHECK_ABS(r.volume_error, fabs(all - 1.0), 1e-12);
    CHECK_OK(clast_fill_history(&box, &s, &table));
    CHECK_ABS(clast_table_numbers(&table, "filled_fraction")[3], r.filled_fraction, 1e-12);
    clast_table_free(&table);
    s.n = 1; /* apart from all: its core is known to be in the box or out of it */
    centre[0][0] = 2.2;
    CHECK_OK(clast_fill_measure(&box, &s, &r));
    const double cap = CLAST_PI * 0.36 * (2.4 - 0.6) / 3.0; /* 0.6 high */
    CHECK_ABS(r.filled_fraction, cap / 8.0, 5e-4);
    clast_mesh_free(&box);
}

static void history_ends_in_the_report(void **state)
{
    (void)state;
    clast_mesh cube = {0};
    clast_spheres s = {0};
    clast_table table = {0};
    clast_fill_report r;
    clast_fill_config config = settings(30);
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &cube));
    fill(&cube, &config, &s, &r);
    CHECK_OK(clast_fill_history(&cube, &s, &table));
    assert_int_equal(table.n_row, 30);
    const double *filled = clast_table_numbers(&table, "filled_fraction");
    for (int i = 1; i < 30; ++i) {
        assert_true(filled[i] > filled[i - 1]);
    }
    CHECK_REL(filled[29], r.filled_fraction, 1e-13);
    CHECK_REL(clast_table_numbers(&table, "inertia_error")[29], r.inertia_error, 1e-12);
    CHECK_REL(clast_table_numbers(&table, "centroid_error")[29], r.centroid_error, 1e-9);
    CHECK_ABS(clast_table_numbers(&table, "radius")[0], 0.5, 0.0);
    clast_table_free(&table);
    clast_spheres_free(&s);
    clast_mesh_free(&cube);
}

static void bounds_stop_the_filling_when_met(void **state)
{
    (void)state;
    clast_mesh cube = {0};
    clast_spheres s = {0};
    clast_fill_report r;
    clast_fill_config config = settings(0);
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &cube));
    config.filled = 0.7;
    config.inertia_error = 0.08;
    fill(&cube, &config, &s, &r);
    assert_int_equal(r.end, CLAST_FILL_BY_QUALITY);
    assert_true(r.filled_fraction >= 0.7 && r.inertia_error <= 0.08);
    const clast_spheres fewer = {s.n - 1, s.centre, s.radius};
    CHECK_OK(clast_fill_measure(&cube, &fewer, &r));
    assert_true(r.filled_fraction < 0.7 || r.inertia_error > 0.08);
    clast_spheres_free(&s);

    config = settings(1000);
    config.min_radius = 0.12; /* between the corner spheres of 0.134 and what follows */
    fill(&cube, &config, &s, &r);
    assert_int_equal(r.end, CLAST_FILL_BY_MIN_RADIUS);
    assert_int_equal(s.n, 9);
    clast_spheres_free(&s);
    clast_mesh_free(&cube);
}

static void impossible_bounds_do_not_converge(void **state)
{
    (void)state;
    clast_mesh cube = {0};
    clast_spheres s = {0};
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &cube));
    clast_fill_config config = settings(5);
    config.filled = 0.9;
    CHECK_STATUS(clast_fill(&cube, &config, NULL, &s, NULL), CLAST_E_CONVERGE);
    assert_non_null(strstr(clast_error_detail(), "wanted 0.9 after 5 spheres"));
    config.spheres = 0;
    config.min_radius = 0.3;
    CHECK_STATUS(clast_fill(&cube, &config, NULL, &s, NULL), CLAST_E_CONVERGE);
    assert_non_null(strstr(clast_error_detail(), "no further sphere fits"));
    config.filled = 0.0;
    config.min_radius = 0.6;
    CHECK_STATUS(clast_fill(&cube, &config, NULL, &s, NULL), CLAST_E_CONVERGE);
    assert_null(s.centre);
    clast_mesh_free(&cube);
    done_with(&config);
}

static void random_filling_without_room_ends(void **state)
{
    (void)state;
    const double axes[3] = {1.0, 1.0, 1.0};
    clast_mesh ball = {0};
    clast_spheres s = {0};
    clast_fill_config config = settings(200);
    CHECK_OK(clast_mesh_ellipsoid(axes, 4, &ball));
    config.strategy = CLAST_FILL_PUBLISHED;
    config.max_tries = 2000;
    CHECK_STATUS(clast_fill(&ball, &config, NULL, &s, NULL), CLAST_E_CONVERGE);
    assert_non_null(strstr(clast_error_detail(), "no free point among 2000"));
    config.min_radius = 1e-3; /* now "no room" is an answer */
    clast_fill_report r;
    CHECK_OK(clast_fill(&ball, &config, NULL, &s, &r));
    assert_int_equal(r.end, CLAST_FILL_BY_MIN_RADIUS);
    assert_true(s.n < 200);
    clast_spheres_free(&s);
    done_with(&config);
    clast_mesh_free(&ball);
}

static void open_and_inside_out_surfaces_are_refused(void **state)
{
    (void)state;
    clast_mesh cube = {0};
    clast_spheres s = {0};
    clast_fill_report r;
    clast_fill_config config = settings(1);
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &cube));
    mesh_drop(&cube, 3);
    CHECK_STATUS(clast_fill(&cube, &config, NULL, &s, NULL), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "3 edges in 1 loops are open"));
    assert_non_null(strstr(clast_error_detail(), "clast mesh repair"));
    config.allow_open = true;
    CHECK_OK(clast_fill(&cube, &config, NULL, &s, &r));
    assert_int_equal(r.n_open_edge, 3);
    CHECK_REL(r.solid_volume, 1.0, 1e-14); /* the cap is the lost half face */
    CHECK_ABS(s.radius[0], 0.5, 0.0);
    clast_spheres_free(&s);
    clast_mesh_free(&cube);

    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &cube));
    mesh_flip_all(&cube);
    CHECK_STATUS(clast_fill(&cube, &config, NULL, &s, NULL), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "inside out"));
    mesh_flip_all(&cube);
    mesh_flip(&cube, 0);
    config.allow_open = false;
    CHECK_STATUS(clast_fill(&cube, &config, NULL, &s, NULL), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "face opposite ways"));
    clast_mesh_free(&cube);
    clast_mesh empty = {0};
    CHECK_STATUS(clast_fill(&empty, &config, NULL, &s, NULL), CLAST_E_GEOMETRY);
    done_with(&config);
}

/* One corner of one facet off by one ulp: what scans in floats have. */
static void slit_of_rounding_is_closed(void **state)
{
    (void)state;
    clast_mesh cube = {0};
    clast_mesh slit = {0};
    clast_spheres s = {0};
    clast_fill_report r;
    clast_fill_config config = settings(2);
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &cube));
    CHECK_OK(clast_mesh_alloc(cube.n_vert + 1, cube.n_tri, &slit));
    memcpy(slit.vert, cube.vert, (size_t)cube.n_vert * sizeof *cube.vert);
    memcpy(slit.tri, cube.tri, (size_t)cube.n_tri * sizeof *cube.tri);
    memcpy(slit.vert[cube.n_vert], cube.vert[slit.tri[0][0]], sizeof *cube.vert);
    slit.vert[cube.n_vert][0] += 1e-15;
    slit.tri[0][0] = cube.n_vert;
    fill(&slit, &config, &s, &r);
    assert_int_equal(r.n_open_edge, 0);
    CHECK_REL(r.solid_volume, 1.0, 1e-13);
    CHECK_REL(s.radius[0], 0.5, 1e-13);
    clast_spheres_free(&s);
    clast_mesh_free(&slit);
    clast_mesh_free(&cube);
}

static void options_that_exclude_each_other_are_refused(void **state)
{
    (void)state;
    clast_mesh cube = {0};
    clast_spheres s = {0};
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &cube));
    clast_fill_config config = settings(5);
    config.overlap = true;
    config.strategy = CLAST_FILL_RANDOM;
    CHECK_STATUS(clast_fill(&cube, &config, NULL, &s, NULL), CLAST_E_CONFIG);
    config.overlap = false;
    config.vertex_subset = true;
    CHECK_STATUS(clast_fill(&cube, &config, NULL, &s, NULL), CLAST_E_CONFIG);
    config.vertex_subset = false;
    config.protrusion = 0.1;
    CHECK_STATUS(clast_fill(&cube, &config, NULL, &s, NULL), CLAST_E_CONFIG);
    clast_mesh_free(&cube);
    done_with(&config);
}

/* Shrink 0 keeps the corners of the hull, here eight of nine centres. */
static void outer_spheres_of_a_cube_are_its_corners(void **state)
{
    (void)state;
    clast_mesh cube = {0};
    clast_spheres s = {0};
    clast_fill_report r;
    clast_fill_config config = settings(9);
    config.outer = true;
    config.shrink = 0.0;
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &cube));
    fill(&cube, &config, &s, &r);
    assert_int_equal(s.n, 8);
    assert_int_equal(r.n_placed, 9);
    assert_int_equal(r.n_sphere, 8);
    for (int i = 0; i < 8; ++i) {
        assert_true(s.radius[i] < 0.2);
    }
    clast_spheres_free(&s);
    config = settings(3); /* three centres have no inside */
    config.outer = true;
    fill(&cube, &config, &s, &r);
    assert_int_equal(s.n, 3);
    clast_spheres_free(&s);
    clast_mesh_free(&cube);
}

/* Two balls that overlap, as one surface of two shells, are covered by two spheres. */
static void clump_finds_the_two_balls(void **state)
{
    (void)state;
    const double axes[3] = {1.0, 1.0, 1.0};
    const double still[4] = {1.0, 0.0, 0.0, 0.0};
    const double apart[3] = {3.0, 0.0, 0.0};
    clast_mesh balls = {0};
    clast_mesh other = {0};
    clast_spheres s = {0};
    clast_fill_report r;
    clast_fill_config config = settings(2);
    config.overlap = true;
    CHECK_OK(clast_mesh_ellipsoid(axes, 3, &balls));
    CHECK_OK(clast_mesh_copy(&balls, &other));
    clast_mesh_transform(&other, 0.7, still, apart);
    CHECK_OK(clast_mesh_append(&balls, &other));
    fill(&balls, &config, &s, &r);
    CHECK_REL(s.radius[0], 1.0, 0.02);
    CHECK_REL(s.radius[1], 0.7, 0.02);
    assert_true(r.filled_fraction > 0.95);
    assert_true(r.max_protrusion <= 1e-12);
    clast_spheres_free(&s);
    clast_mesh_free(&balls);
    clast_mesh_free(&other);
}

static void clump_keeps_its_bound_of_protrusion(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_spheres s = {0};
    clast_fill_report in;
    clast_fill_report out;
    CHECK_OK(clast_mesh_box(3.0, 2.0, 1.0, &box));
    clast_fill_config config = settings(20);
    config.overlap = true;
    fill(&box, &config, &s, &in);
    assert_int_equal(s.n, 20);
    assert_true(in.max_protrusion <= 1e-12);
    assert_true(in.max_overlap > 0.1);
    clast_spheres_free(&s);
    config = settings(20);
    config.overlap = true;
    config.protrusion = 0.2;
    fill(&box, &config, &s, &out);
    assert_true(out.max_protrusion <= 0.2 + 1e-12 && out.max_protrusion > 0.19);
    assert_true(out.deviation_mean < in.deviation_mean);
    clast_spheres_free(&s);
    config = settings(0);
    config.overlap = true;
    config.filled = 0.85;
    fill(&box, &config, &s, &in);
    assert_true(in.filled_fraction >= 0.85 && in.end == CLAST_FILL_BY_QUALITY);
    clast_spheres_free(&s);
    clast_mesh_free(&box);
}

typedef struct {
    int32_t calls;
} patience;

static bool stop_at_third(void *context)
{
    patience *p = context;
    return ++p->calls > 3;
}

static void stop_is_heard(void **state)
{
    (void)state;
    patience p = {0};
    const clast_monitor monitor = {.stop = stop_at_third, .context = &p};
    clast_mesh cube = {0};
    clast_spheres s = {0};
    clast_fill_config config = settings(50);
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &cube));
    CHECK_STATUS(clast_fill(&cube, &config, &monitor, &s, NULL), CLAST_E_STOPPED);
    assert_null(s.centre);
    clast_mesh_free(&cube);
    done_with(&config);
}

typedef struct {
    clast_mesh mesh;
    clast_fill_config config;
} refusal;

static clast_status make(void *context)
{
    const refusal *r = context;
    clast_spheres s = {0};
    clast_table table = {0};
    clast_fill_report report;
    clast_status status = clast_fill(&r->mesh, &r->config, NULL, &s, &report);
    if (status == CLAST_OK) {
        status = clast_fill_history(&r->mesh, &s, &table);
    }
    clast_table_free(&table);
    clast_spheres_free(&s);
    return status;
}

static void every_strategy_survives_refused_memory(void **state)
{
    (void)state;
    refusal r = {.config = settings(6)};
    mesh_add_box(&r.mesh, 1.0, 0.0, 0.0, 0.0);
    r.config.outer = true;
    support_refuse_each_allocation(make, &r);
    r.config.strategy = CLAST_FILL_PUBLISHED;
    r.config.vertex_subset = true;
    support_refuse_each_allocation(make, &r);
    r.config.vertex_subset = false;
    r.config.strategy = CLAST_FILL_RANDOM;
    support_refuse_each_allocation(make, &r);
    r.config.strategy = CLAST_FILL_LARGEST;
    r.config.allow_open = true;
    mesh_drop(&r.mesh, 0);
    support_refuse_each_allocation(make, &r);
    clast_mesh_free(&r.mesh);
    done_with(&r.config);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cube_takes_its_inscribed_sphere_then_the_corners),
        cmocka_unit_test(solid_with_a_far_vertex_is_refused),
        cmocka_unit_test(solid_with_an_empty_triangle_is_filled),
        cmocka_unit_test(tetrahedron_and_cone_take_their_inscribed_spheres),
        cmocka_unit_test(slab_with_a_plane_of_summits_is_filled),
        cmocka_unit_test(two_bodies_are_filled_by_size),
        cmocka_unit_test(hollow_body_is_filled_between_its_walls),
        cmocka_unit_test(ball_is_one_sphere),
        cmocka_unit_test(measures_of_one_sphere_are_closed_forms),
        cmocka_unit_test(measures_of_overlapping_spheres_count_the_union),
        cmocka_unit_test(filled_counts_what_is_in_the_solid),
        cmocka_unit_test(history_ends_in_the_report),
        cmocka_unit_test(bounds_stop_the_filling_when_met),
        cmocka_unit_test(impossible_bounds_do_not_converge),
        cmocka_unit_test(random_filling_without_room_ends),
        cmocka_unit_test(open_and_inside_out_surfaces_are_refused),
        cmocka_unit_test(slit_of_rounding_is_closed),
        cmocka_unit_test(options_that_exclude_each_other_are_refused),
        cmocka_unit_test(outer_spheres_of_a_cube_are_its_corners),
        cmocka_unit_test(clump_finds_the_two_balls),
        cmocka_unit_test(clump_keeps_its_bound_of_protrusion),
        cmocka_unit_test(stop_is_heard),
        cmocka_unit_test(every_strategy_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
