/* Unit: each repair does its one thing and tells it; real files end as their READMEs say. */
#include "mesh_maker.h"

#include "geom/repair.h"
#include <clast/mesh_repair.h>
#include <string.h>

static clast_mesh_repair_config config_default(void)
{
    clast_mesh_repair_config config;
    CHECK_OK(clast_fields_default(clast_mesh_repair_fields, &config));
    return config;
}

/* Repairs, checks that the result is a solid of this volume in n_part parts (0: any number), and
   replaces the mesh by it. */
static clast_mesh_repair_report repair_parts_to(clast_mesh *mesh, int32_t n_part, double volume,
                                                double tolerance)
{
    clast_mesh out = {0};
    clast_mesh_repair_report report = {0};
    clast_mesh_check_result check = {0};
    CHECK_OK(clast_mesh_repair(mesh, NULL, &out, &report));
    CHECK_OK(clast_mesh_check(&out, &check));
    assert_true(clast_mesh_check_passed(&check));
    assert_int_equal(check.n_degenerate + check.n_duplicate + check.n_unused_vertex, 0);
    CHECK_REL(check.volume, volume, tolerance);
    CHECK_REL(report.volume_after, volume, tolerance);
    assert_int_equal(report.n_triangle_after, out.n_tri);
    assert_true(n_part == 0 || n_part == check.n_part);
    clast_mesh_check_free(&check);
    clast_mesh_free(mesh);
    *mesh = out;
    return report;
}

static clast_mesh_repair_report repair_to(clast_mesh *mesh, double volume, double tolerance)
{
    return repair_parts_to(mesh, 0, volume, tolerance);
}

static void sound_surface_comes_back_unchanged(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    clast_mesh_repair_report r = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){3.0, 2.0, 1.0}, 3, &mesh));
    mesh_tilt(&mesh);
    CHECK_OK(clast_mesh_repair(&mesh, NULL, &out, &r));
    assert_int_equal(out.n_vert, mesh.n_vert);
    assert_memory_equal(out.vert, mesh.vert, (size_t)mesh.n_vert * sizeof *mesh.vert);
    assert_memory_equal(out.tri, mesh.tri, (size_t)mesh.n_tri * sizeof *mesh.tri);
    assert_int_equal(r.n_merged + r.n_degenerate + r.n_duplicate + r.n_split + r.n_loose +
                         r.n_turned + r.n_hole_filled + r.n_separated + r.n_part_dropped,
                     0);
    assert_true(r.volume_before == r.volume_after);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
}

static void cracks_are_welded(void **state)
{
    (void)state;
    clast_mesh whole = {0};
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){1.0, 1.0, 1.0}, 2, &whole));
    mesh_explode(&whole, &mesh);
    for (int32_t c = 0; c < mesh.n_vert; ++c) {
        mesh.vert[c][c % 3] += 1e-7 * (c % 5 - 2);
    }
    const clast_mesh_repair_report r = repair_to(&mesh, clast_mesh_volume(&whole), 1e-6);
    assert_int_equal(r.n_merged, 3 * whole.n_tri - whole.n_vert);
    assert_int_equal(mesh.n_vert, whole.n_vert);
    assert_int_equal(mesh.n_tri, whole.n_tri);
    assert_true(r.weld_distance <= 5e-7);
    clast_mesh_free(&mesh);
    clast_mesh_free(&whole);
}

static void welding_respects_small_features(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    clast_mesh_repair_report r = {0};
    mesh_add_box(&mesh, 1e-4, 0.0, 0.0, 0.0); /* open, and small beside the extent */
    mesh_drop(&mesh, 0);
    mesh_add_box(&mesh, 1.0, 5.0, 5.0, 5.0);
    CHECK_OK(clast_mesh_repair(&mesh, NULL, &out, &r));
    assert_int_equal(r.n_merged, 0);
    assert_int_equal(r.n_hole_filled, 1);
    CHECK_REL(r.volume_after, 1.0 + 1e-12, 1e-13);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
}

static void holes_are_filled_to_the_solid(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 2.0, 0.0, 0.0, 0.0);
    mesh_drop(&mesh, 4); /* two neighbours: a square hole */
    mesh_drop(&mesh, 4);
    mesh_drop(&mesh, 9); /* and a triangle */
    mesh_tilt(&mesh);
    const clast_mesh_repair_report r = repair_to(&mesh, 8.0 * 1.7 * 1.7 * 1.7, 1e-14);
    assert_int_equal(r.n_hole_filled, 2);
    assert_int_equal(r.n_fill_triangle, 3);
    clast_mesh_free(&mesh);
}

/* An open cap of a sphere with a rim of 500: longer than one plan can take. */
static void long_planar_hole_is_filled_flat(void **state)
{
    (void)state;
    enum { N = 500 };
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_alloc(N + 1, N, &mesh));
    for (int32_t i = 0; i < N; ++i) {
        const double a = 2.0 * CLAST_PI * i / N;
        const double r = 1.0 + 0.3 * cos(7.0 * a); /* not convex */
        mesh.vert[i][0] = r * cos(a);
        mesh.vert[i][1] = r * sin(a);
        const int32_t tri[3] = {i, (i + 1) % N, N};
        memcpy(mesh.tri[i], tri, sizeof tri);
    }
    mesh.vert[N][2] = 1.0;
    double plane = 0.0; /* area of the rim's polygon */
    for (int32_t i = 0; i < N; ++i) {
        const double *p = mesh.vert[i];
        const double *q = mesh.vert[(i + 1) % N];
        plane += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
    const double sides = clast_mesh_area(&mesh);
    const clast_mesh_repair_report r = repair_to(&mesh, plane / 3.0, 1e-12);
    assert_int_equal(r.n_hole_filled, 1);
    assert_int_equal(r.n_fill_triangle, N - 2);
    CHECK_REL(r.area_after - sides, plane,
              2e-3); /* coarse first: stretches may fold over a little */
    clast_mesh_free(&mesh);
}

/* A rim of 500 that waves out of its plane: filled coarse first, then stretch by stretch. */
static void long_wavy_hole_is_closed(void **state)
{
    (void)state;
    enum { N = 500 };
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_alloc(N + 1, N, &mesh));
    for (int32_t i = 0; i < N; ++i) {
        const double a = 2.0 * CLAST_PI * i / N;
        const double p[3] = {cos(a), sin(a), 0.2 * cos(2.0 * a)};
        const int32_t tri[3] = {i, (i + 1) % N, N};
        memcpy(mesh.vert[i], p, sizeof p);
        memcpy(mesh.tri[i], tri, sizeof tri);
    }
    mesh.vert[N][2] = 3.0;
    const clast_mesh_repair_report r = repair_to(&mesh, CLAST_PI, 0.05); /* a cone, about */
    assert_int_equal(r.n_hole_filled, 1);
    assert_int_equal(r.n_fill_triangle, N - 2);
    clast_mesh_free(&mesh);
}

static void large_hole_stays_when_told(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    clast_mesh_repair_report r = {0};
    clast_mesh_repair_config config = config_default();
    config.fill_size = 0.1;
    mesh_add_box(&mesh, 2.0, 0.0, 0.0, 0.0);
    mesh_drop(&mesh, 4);
    CHECK_OK(clast_mesh_repair(&mesh, &config, &out, &r));
    assert_int_equal(r.n_hole_left, 1);
    assert_int_equal(out.n_tri, 11);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
}

static void mixed_windings_end_outward(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){1.0, 1.0, 1.0}, 2, &mesh));
    const double volume = clast_mesh_volume(&mesh);
    int32_t n = 0;
    for (int32_t t = 0; t < mesh.n_tri; t += 3) {
        mesh_flip(&mesh, t);
        ++n;
    }
    assert_int_equal(repair_to(&mesh, volume, 1e-14).n_turned, n);
    mesh_flip_all(&mesh);
    assert_int_equal(repair_to(&mesh, volume, 1e-14).n_turned, mesh.n_tri);
    clast_mesh_free(&mesh);
}

/* A body with a cavity, all inside out: the cavity turns with its body and stays a cavity. */
static void cavity_turns_with_its_body(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 1.0, 1.0, 1.0, 1.0);
    mesh_flip_all(&mesh);
    mesh_add_box(&mesh, 4.0, 0.0, 0.0, 0.0);
    assert_int_equal(repair_to(&mesh, 63.0, 1e-14).n_turned, 0);
    mesh_flip_all(&mesh);
    assert_int_equal(repair_to(&mesh, 63.0, 1e-14).n_turned, 24);
    clast_mesh_free(&mesh);
}

static void keeping_the_largest_keeps_its_cavities(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    clast_mesh_repair_report r = {0};
    clast_mesh_repair_config config = config_default();
    config.keep = CLAST_KEEP_LARGEST;
    mesh_add_box(&mesh, 1.0, 1.0, 1.0, 1.0);
    mesh_flip_all(&mesh);
    mesh_add_box(&mesh, 2.0, 9.0, 0.0, 0.0);
    mesh_add_box(&mesh, 4.0, 0.0, 0.0, 0.0);
    mesh_add_box(&mesh, 0.5, 3.0, 3.0, 3.0); /* a solid inside: not a cavity */
    CHECK_OK(clast_mesh_repair(&mesh, &config, &out, &r));
    assert_int_equal(r.n_part_dropped, 2);
    CHECK_REL(r.volume_after, 63.0, 1e-14);
    assert_int_equal(out.n_vert, 16);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
}

/* "Nothing had to be changed" of a box of volume 64 that was told to hold 72. */
static void parts_that_bound_nothing_go(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh_repair_config config = config_default();
    clast_mesh out = {0};
    clast_mesh_repair_report r = {0};
    mesh_add_box(&mesh, 1.0, 1.5, 1.5, 1.5);
    mesh_add_box(&mesh, 2.0, 1.0, 1.0, 1.0);
    mesh_add_box(&mesh, 4.0, 0.0, 0.0, 0.0);
    mesh_add_box(&mesh, 1.0, 9.0, 0.0, 0.0);
    config.unite = false;
    CHECK_OK(clast_mesh_repair(&mesh, &config, &out, &r));
    assert_int_equal(r.n_part_dropped, 0);
    CHECK_REL(r.volume_after, 74.0, 1e-14);
    clast_mesh_free(&out);
    config.unite = true;
    config.keep = CLAST_KEEP_LARGEST;
    CHECK_OK(clast_mesh_repair(&mesh, &config, &out, &r));
    assert_int_equal(r.n_part_dropped, 3); /* two within, one beside */
    CHECK_REL(r.volume_after, 64.0, 1e-14);
    clast_mesh_free(&out);
    mesh_flip_all(&mesh); /* turned outward first */
    const clast_mesh_repair_report turned = repair_parts_to(&mesh, 2, 65.0, 1e-14);
    assert_int_equal(turned.n_part_dropped, 2);
    assert_int_equal(mesh.n_vert, 16);
    clast_mesh_free(&mesh);
}

static void bad_triangles_go(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    const int32_t more[4][3] = {{0, 2, 1}, {2, 1, 0}, {3, 3, 5}, {0, 0, 0}};
    mesh_add_triangles(&mesh, more, 4);
    const clast_mesh_repair_report r = repair_to(&mesh, 1.0, 1e-14);
    assert_int_equal(r.n_degenerate, 2);
    assert_int_equal(r.n_duplicate, 2);
    assert_int_equal(mesh.n_tri, 12);
    clast_mesh_free(&mesh);
}

/* Two boxes that share the vertices of a common wall, which both have; n times. */
static void add_walled_boxes(clast_mesh *mesh, int n)
{
    clast_mesh boxes = {0};
    clast_mesh welded = {0};
    mesh_add_box(&boxes, 1.0, 0.0, 0.0, 0.0);
    mesh_add_box(&boxes, 1.0, 0.0, 0.0, 0.0);
    for (int32_t v = 8; v < 16; ++v) { /* the second is the first's mirror image in x = 1 */
        boxes.vert[v][0] = 2.0 - boxes.vert[v][0];
    }
    for (int32_t t = 12; t < 24; ++t) {
        mesh_flip(&boxes, t);
    }
    CHECK_OK(clast_mesh_weld(&boxes, 0.0, &welded, NULL));
    CHECK_OK(clast_mesh_alloc(welded.n_vert, 0, mesh));
    memcpy(mesh->vert, welded.vert, (size_t)welded.n_vert * sizeof *welded.vert);
    for (int k = 0; k < n; ++k) {
        mesh_add_triangles(mesh, (const int32_t(*)[3])welded.tri, welded.n_tri);
    }
    clast_mesh_free(&welded);
    clast_mesh_free(&boxes);
}

/* The wall goes, front and back; its two sides may run alike, of bodies that are wound apart. */
static void common_wall_goes(void **state)
{
    (void)state;
    for (int is_turned = 0; is_turned < 2; ++is_turned) {
        clast_mesh mesh = {0};
        add_walled_boxes(&mesh, 1);
        for (int32_t t = 12; t < 24 && is_turned; ++t) {
            mesh_flip(&mesh, t);
        }
        const clast_mesh_repair_report r = repair_to(&mesh, 2.0, 1e-14);
        assert_int_equal(r.n_duplicate, 4);
        CHECK_REL(r.area_after, 10.0, 1e-14);
        clast_mesh_free(&mesh);
    }
}

/* Both copies went where neighbours were written twice too: the patch of two scans was a hole that
   was filled flat, a body written twice was gone. */
static void facets_written_twice_stay_once(void **state)
{
    (void)state;
    for (int is_turned = 0; is_turned < 2; ++is_turned) {
        clast_mesh mesh = {0};
        int32_t n_patch = 0;
        CHECK_OK(clast_mesh_ellipsoid((double[3]){3.0, 2.0, 1.0}, 3, &mesh));
        const double volume = clast_mesh_volume(&mesh);
        const int32_t n_tri = mesh.n_tri;
        for (int32_t t = 0; t < n_tri; ++t) {
            if (mesh.vert[mesh.tri[t][0]][0] > 0.5) {
                const int32_t again[1][3] = {{mesh.tri[t][1], mesh.tri[t][2], mesh.tri[t][0]}};
                mesh_add_triangles(&mesh, again, 1);
                ++n_patch;
                if (is_turned) {
                    mesh_flip(&mesh, mesh.n_tri - 1);
                }
            }
        }
        const clast_mesh_repair_report r = repair_to(&mesh, volume, 1e-13);
        assert_int_equal(r.n_duplicate, n_patch);
        assert_int_equal(r.n_hole_filled, 0);
        assert_int_equal(mesh.n_tri, n_tri);
        clast_mesh_free(&mesh);
    }
}

static void bodies_written_twice_stay_once(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 2.0, 0.0, 0.0, 0.0);
    mesh_add_box(&mesh, 1.0, 9.0, 0.0, 0.0);
    int32_t first[12][3];
    memcpy(first, mesh.tri, sizeof first);
    mesh_add_triangles(&mesh, (const int32_t(*)[3])first, 12);
    mesh_add_triangles(&mesh, (const int32_t(*)[3])first, 12);
    mesh_flip(&mesh, 30); /* one facet of 36 runs backward */
    assert_int_equal(repair_parts_to(&mesh, 2, 9.0, 1e-14).n_duplicate, 24);
    clast_mesh_free(&mesh);
    add_walled_boxes(&mesh, 2);
    assert_int_equal(repair_parts_to(&mesh, 1, 2.0, 1e-14).n_duplicate, 28);
    clast_mesh_free(&mesh);
}

/* A sheet of two sides that touch is no solid. */
static void both_sides_of_a_sheet_go(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    const double corner[4][3] = {{5, 0, 0}, {6, 0, 0}, {6, 1, 1}, {5, 1, 0}};
    const int32_t sides[4][3] = {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}};
    clast_mesh sheet = {0};
    mesh_of(corner, 4, sides, 4, &sheet);
    CHECK_OK(clast_mesh_append(&mesh, &sheet));
    assert_int_equal(repair_parts_to(&mesh, 1, 1.0, 1e-14).n_duplicate, 4);
    clast_mesh_free(&sheet);
    clast_mesh_free(&mesh);
}

static void tjunctions_are_split(void **state)
{
    (void)state;
    /* A box whose edge 0-1 has two more vertices on one of its sides only. */
    clast_mesh box = {0};
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_box(3.0, 1.0, 1.0, &box));
    CHECK_OK(clast_mesh_alloc(10, 14, &mesh));
    memcpy(mesh.vert, box.vert, 8 * sizeof *box.vert);
    memcpy(mesh.tri, box.tri, 12 * sizeof *box.tri);
    mesh.vert[8][0] = 1.0;
    mesh.vert[9][0] = 2.0;
    const int32_t fan[3][3] = {{0, 8, 4}, {8, 9, 4}, {9, 1, 4}}; /* was {0, 1, 4} */
    memcpy(mesh.tri[4], fan[0], sizeof fan[0]);
    memcpy(mesh.tri[12], fan[1], 2 * sizeof fan[1]);
    mesh_tilt(&mesh);
    const clast_mesh_repair_report r = repair_to(&mesh, 3.0 * 1.7 * 1.7 * 1.7, 1e-13);
    assert_int_equal(r.n_split, 1);
    assert_int_equal(r.n_hole_filled, 0);
    assert_int_equal(mesh.n_tri, 16);
    clast_mesh_free(&mesh);
    clast_mesh_free(&box);
}

static void touching_bodies_are_parted(void **state)
{
    (void)state;
    for (int shared = 1; shared <= 2; ++shared) { /* a corner, an edge */
        clast_mesh mesh = {0};
        clast_mesh welded = {0};
        int32_t n_merged = 0;
        mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
        mesh_add_box(&mesh, 1.0, 1.0, 1.0, shared == 1 ? 1.0 : 0.0);
        CHECK_OK(clast_mesh_weld(&mesh, 1e-9, &welded, &n_merged));
        assert_int_equal(n_merged, shared);
        const clast_mesh_repair_report r = repair_to(&welded, 2.0, 1e-14);
        assert_int_equal(r.n_separated, shared);
        assert_int_equal(welded.n_vert, 16);
        clast_mesh_free(&welded);
        clast_mesh_free(&mesh);
    }
}

static void loose_triangles_go_and_nothing_left_is_an_error(void **state)
{
    (void)state;
    const double vert[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
    const int32_t tri[2][3] = {{0, 1, 2}, {3, 4, 5}};
    clast_mesh loose = {0};
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    mesh_of(vert, 6, tri, 2, &loose);
    CHECK_STATUS(clast_mesh_repair(&loose, NULL, &out, NULL), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "2 shared no edge"));
    assert_null(out.vert);
    mesh_add_box(&mesh, 1.0, 20.0, 20.0, 20.0);
    CHECK_OK(clast_mesh_append(&mesh, &loose));
    assert_int_equal(repair_to(&mesh, 1.0, 1e-13).n_loose, 2);
    clast_mesh_free(&mesh);
    clast_mesh_free(&loose);
}

static void every_step_can_be_left_out(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    clast_mesh_repair_report r = {0};
    const clast_mesh_repair_config off = {.weld = CLAST_WELD_OFF};
    if (!mesh_read_data("broken-meshes/trimesh/soup.stl", &mesh)) {
        return;
    }
    CHECK_OK(clast_mesh_repair(&mesh, &off, &out, &r));
    assert_int_equal(out.n_tri, mesh.n_tri);
    assert_memory_equal(out.tri, mesh.tri, (size_t)mesh.n_tri * sizeof *mesh.tri);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
}

typedef struct {
    const char *file;
    double volume, tolerance;
    int32_t n_part;
    const char *whose; /* where the volume comes from */
} fact;

static const fact facts[] = {
    {"broken-meshes/admesh-block/fill-holes-bad.stl", 61.023745, 1e-8, 1, "README"},
    {"broken-meshes/admesh-block/fill-holes-good.stl", 61.023745, 1e-8, 1, "README"},
    {"broken-meshes/admesh-block/normal-directions-bad.stl", 61.023745, 1e-8, 1, "README"},
    {"broken-meshes/admesh-block/normal-directions-good.stl", 61.023745, 1e-8, 1, "README"},
    {"broken-meshes/admesh-block/exact-bad.stl", 61.023746, 2e-8, 1, "README"},
    {"broken-meshes/admesh-block/nearby-bad.stl", 61.023746, 2e-8, 1, "README"},
    {"broken-meshes/admesh-block/exact-good.stl", 61.023746, 2e-8, 1, "README"},
    {"broken-meshes/admesh-block/nearby-good.stl", 61.023746, 2e-8, 1, "README"},
    {"broken-meshes/admesh-block/remove-unconnected-bad.stl", 122.0475, 1e-6, 2, "README"},
    {"broken-meshes/numpy-stl/triamid.stl", 10.666667, 1e-7, 1, "README, ADMesh"},
    {"broken-meshes/trimesh/angle_block.STL", 1.145522, 1e-6, 1, "README, facets"},
    {"broken-meshes/trimesh/shared.STL", 2.0, 1e-14, 2, "README"},
    {"broken-meshes/trimesh/multibody.stl", 0.0074232, 1e-5, 2, "bodies turned outward"},
    {"broken-meshes/assimp/Spider_binary.stl", 10.0446, 2e-4, 18, "ADMesh, other filling"},
    {"scarlet/stl/ellipse.stl", 4188.1, 1e-6, 1, "README"},
    {"scarlet/stl/Menger2.stl", 0.5487, 1e-6, 1, "README"},
    {"scarlet/stl/particle.stl", 1286.86, 2e-6, 1, "README"},
    {"scarlet/stl/sphere.stl", 523.513, 2e-6, 1, "README"},
    {"scarlet/stl/ParticleParticle13.stl", 32.7195, 2e-6, 1, "README"},
    {"scarlet/stl/snowflake.stl", 1717.94, 1e-4, 1, "README, open"},
    {"scarlet/stl/t_rex.stl", 1534227.375, 5e-5, 76, "ADMesh"},
    {"scarlet/stl/toy.stl", 8.608, 1e-3, 9, "ours: seams, no outside value"},
};

static void files_end_as_their_readmes_say(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof facts / sizeof facts[0]; ++i) {
        clast_mesh mesh = {0};
        if (mesh_read_data(facts[i].file, &mesh)) {
            print_message("%s (%s)\n", facts[i].file, facts[i].whose);
            (void)repair_parts_to(&mesh, facts[i].n_part, facts[i].volume, facts[i].tolerance);
        }
        clast_mesh_free(&mesh);
    }
}

/* 672 of 866 facets without area, bands in two layers: closed and oriented with ADMesh's volume,
   but two edges stay doubled, and the check says so, until the bands, which have no volume, go. */
static void hopeless_ring_ends_closed(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    clast_mesh_repair_report r = {0};
    clast_mesh_check_result check = {0};
    clast_mesh_repair_config config = config_default();
    config.split = false;
    config.unite = false;
    if (!mesh_read_data("broken-meshes/exadem/tore.stl", &mesh)) {
        return;
    }
    CHECK_OK(clast_mesh_repair(&mesh, &config, &out, &r));
    CHECK_OK(clast_mesh_check(&out, &check));
    assert_int_equal(r.n_degenerate, 672);
    assert_int_equal(out.n_tri, 256); /* as ADMesh keeps */
    assert_true(check.closed && check.oriented);
    CHECK_REL(check.volume, 4802.908691, 1e-6); /* ADMesh, inside out there */
    assert_false(clast_mesh_check_passed(&check));
    clast_mesh_check_free(&check);
    clast_mesh_free(&out);
    CHECK_OK(clast_mesh_repair(&mesh, NULL, &out, &r));
    CHECK_OK(clast_mesh_check(&out, &check));
    assert_true(clast_mesh_check_passed(&check));
    assert_int_equal(r.n_part_dropped, 31);
    CHECK_REL(check.volume, 4802.908691, 1e-6);
    clast_mesh_check_free(&check);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
}

static clast_status make_repair(void *context)
{
    clast_mesh out = {0};
    clast_mesh_repair_report r = {0};
    const clast_status status = clast_mesh_repair(context, NULL, &out, &r);
    clast_mesh_free(&out);
    return status;
}

static void repair_survives_refused_memory(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh cracked = {0};
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    mesh_add_box(&mesh, 1.0, 1.0, 1.0, 1.0);
    mesh_drop(&mesh, 20);
    mesh_flip(&mesh, 3);
    mesh_explode(&mesh, &cracked);
    support_refuse_each_allocation(make_repair, &cracked);
    clast_mesh nested = {0};
    mesh_add_box(&nested, 4.0, 0.0, 0.0, 0.0);
    mesh_add_box(&nested, 2.0, 1.0, 1.0, 1.0);
    support_refuse_each_allocation(make_repair, &nested);
    clast_mesh_free(&nested);
    add_walled_boxes(&nested, 2);
    support_refuse_each_allocation(make_repair, &nested);
    clast_mesh_free(&nested);
    clast_mesh_free(&cracked);
    clast_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sound_surface_comes_back_unchanged),
        cmocka_unit_test(cracks_are_welded),
        cmocka_unit_test(welding_respects_small_features),
        cmocka_unit_test(holes_are_filled_to_the_solid),
        cmocka_unit_test(long_planar_hole_is_filled_flat),
        cmocka_unit_test(long_wavy_hole_is_closed),
        cmocka_unit_test(large_hole_stays_when_told),
        cmocka_unit_test(mixed_windings_end_outward),
        cmocka_unit_test(cavity_turns_with_its_body),
        cmocka_unit_test(keeping_the_largest_keeps_its_cavities),
        cmocka_unit_test(parts_that_bound_nothing_go),
        cmocka_unit_test(bad_triangles_go),
        cmocka_unit_test(common_wall_goes),
        cmocka_unit_test(facets_written_twice_stay_once),
        cmocka_unit_test(bodies_written_twice_stay_once),
        cmocka_unit_test(both_sides_of_a_sheet_go),
        cmocka_unit_test(tjunctions_are_split),
        cmocka_unit_test(touching_bodies_are_parted),
        cmocka_unit_test(loose_triangles_go_and_nothing_left_is_an_error),
        cmocka_unit_test(every_step_can_be_left_out),
        cmocka_unit_test(files_end_as_their_readmes_say),
        cmocka_unit_test(hopeless_ring_ends_closed),
        cmocka_unit_test(repair_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
