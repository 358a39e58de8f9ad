/* Unit: real and broken files against the facts that came with them (measured by others: a numpy
   script, ADMesh, SolidWorks; see the data's README). */
#include "mesh_maker.h"

#include <clast/mesh_repair.h>

typedef struct {
    const char *file;
    int32_t n_open, n_over, n_turned; /* b, n, i of the README */
    int32_t n_part;                   /* 0: not stated */
    double volume, area;              /* NAN: not stated, or not defined for an open surface */
    double tolerance;
    bool passes;
    double hull_porosity; /* NAN: not stated */
} fact;

static const fact facts[] = {
    {"broken-meshes/numpy-stl/triamid.stl", 0, 0, 13, 1, NAN, NAN, 0, false, NAN},
    {"broken-meshes/numpy-stl/HalfDonut.stl", 0, 0, 0, 1, 2.343149, NAN, 1e-6, true, NAN},
    {"broken-meshes/trimesh/unit_cube.STL", 0, 0, 0, 1, 1.0, 6.0, 1e-12, true, 0.0},
    {"broken-meshes/trimesh/multibody.stl", 0, 0, 12, 2, NAN, NAN, 0, false, NAN},
    {"broken-meshes/trimesh/shared.STL", 0, 1, 0, 0, 2.0, 12.0, 1e-12, false, NAN},
    {"broken-meshes/trimesh/soup.stl", 300, 0, 0, 100, NAN, NAN, 0, false, NAN},
    {"broken-meshes/trimesh/angle_block.STL", 166, 0, 0, 0, 1.145522, 9.387338, 1e-6, false, NAN},
    {"broken-meshes/assimp/Spider_binary.stl", 72, 0, 10, 18, NAN, NAN, 0, false, NAN},
    {"broken-meshes/exadem/tore.stl", 68, 32, 0, 0, NAN, NAN, 0, false, NAN},
    {"broken-meshes/admesh-block/basic.stl", 0, 0, 0, 1, 61.023745, 93.000187, 1e-8, true, 0.0},
    {"broken-meshes/admesh-block/binary.stl", 0, 0, 0, 1, 61.023745, 93.000187, 1e-8, true, 0.0},
    {"broken-meshes/admesh-block/fill-holes-bad.stl", 3, 0, 0, 1, 55.938, NAN, 1e-5, false, NAN},
    {"broken-meshes/admesh-block/normal-directions-bad.stl", 0, 0, 3, 1, NAN, NAN, 0, false, NAN},
    {"broken-meshes/admesh-block/normal-directions-good.stl", 0, 0, 0, 1, -61.023745, NAN, 1e-8,
     false, NAN},
    {"broken-meshes/admesh-block/exact-bad.stl", 4, 0, 0, 1, NAN, NAN, 0, false, NAN},
    {"broken-meshes/admesh-block/nearby-bad.stl", 4, 0, 0, 1, NAN, NAN, 0, false, NAN},
    {"scarlet/stl/27sk21_shape_coarse.stl", 0, 0, 0, 1, 1.29208e6, NAN, 1e-5, true, 0.0004},
    {"scarlet/stl/27sk21_shape_fine.stl", 0, 0, 0, 1, 3903.7, NAN, 1e-5, true, 0.0003},
    {"scarlet/stl/ellipse.stl", 32, 0, 0, 1, 4188.1, NAN, 1e-5, false, 0.0},
    {"scarlet/stl/L_shaped.stl", 0, 0, 0, 8, 32.6777, NAN, 1e-5, true, 0.6330},
    {"scarlet/stl/Menger2.stl", 40, 0, 0, 1, 0.5487, NAN, 1e-6, false, 0.4513},
    {"scarlet/stl/Menger3.stl", 168, 0, 0, 1, 0.406445, NAN, 1e-5, false, 0.5936},
    {"scarlet/stl/particle.stl", 4, 0, 0, 1, 1286.86, NAN, 1e-5, false, 0.3527},
    {"scarlet/stl/pyramid.stl", 0, 0, 0, 55, 221.084, NAN, 1e-5, true, 0.3709},
    {"scarlet/stl/sphere.stl", 76, 0, 0, 1, 523.513, NAN, 1e-5, false, 0.0},
    {"scarlet/stl/ParticleParticle13.stl", 44, 0, 0, 1, 32.7195, NAN, 1e-5, false, 0.0},
    {"scarlet/stl/snowflake.stl", 1549, 0, 0, 1, 1717.94, NAN, 1e-4, false, 0.5248},
    {"scarlet/stl/t_rex.stl", 46, 1, 0, 76, 1.53627e6, NAN, 3e-3, false, NAN},
    {"scarlet/stl/toy.stl", 248, 0, 0, 9, NAN, NAN, 0, false, NAN},
    {"shapes/primitives/torus.stl", 0, 0, 0, 1, 0.348328029, 3.82577962, 1e-8, true, NAN},
    {"shapes/platonic/Dodecahedron.stl", 0, 0, 0, 1, 0.427051006, 3.01217123, 1e-8, true, 0.0},
    {"shapes/ellipsoids/Ellipsoid_R_1_2_3.stl", 0, 0, 0, 1, 25.1191503, 48.8675078, 1e-8, true,
     0.0},
    {"shapes/asteroids/216Kleopatra.obj", 0, 0, 0, 1, 708868.123, 52186.4121, 1e-8, true, 0.364020},
    {"shapes/grains/stone_0.ply", 0, 0, 0, 1, 0.00166602032, 0.0868154101, 1e-8, true, 0.099698},
};

static void check_fact(const fact *f)
{
    clast_mesh mesh = {0};
    clast_mesh_check_result r = {0};
    if (!mesh_read_data(f->file, &mesh)) {
        return;
    }
    print_message("%s\n", f->file);
    CHECK_OK(clast_mesh_check(&mesh, &r));
    assert_int_equal(r.n_open_edge, f->n_open);
    assert_int_equal(r.n_nonmanifold_edge, f->n_over);
    assert_int_equal(r.n_misoriented_edge, f->n_turned);
    assert_int_equal(clast_mesh_check_passed(&r), f->passes);
    if (f->n_part > 0) {
        assert_int_equal(r.n_part, f->n_part);
    }
    if (!isnan(f->volume)) {
        CHECK_REL(r.volume, f->volume, f->tolerance);
        CHECK_REL(r.volume_divergence, r.volume, f->tolerance);
    }
    if (!isnan(f->area)) {
        CHECK_REL(r.area, f->area, f->tolerance);
        CHECK_REL(r.area_heron, r.area, f->tolerance);
    }
    if (!isnan(f->hull_porosity)) {
        CHECK_ABS(1.0 - r.volume / r.hull_volume, f->hull_porosity, 6e-5);
    }
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
}

static void files_have_their_stated_facts(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof facts / sizeof facts[0]; ++i) {
        check_fact(&facts[i]);
    }
}

static void torus_has_a_handle(void **state)
{
    (void)state;
    static const char *const files[] = {"broken-meshes/numpy-stl/HalfDonut.stl",
                                        "shapes/primitives/torus.stl"};
    for (int i = 0; i < 2; ++i) {
        clast_mesh mesh = {0};
        clast_mesh_check_result r = {0};
        if (mesh_read_data(files[i], &mesh)) {
            CHECK_OK(clast_mesh_check(&mesh, &r));
            assert_int_equal(r.euler, 0);
            assert_int_equal(r.genus, 1);
        }
        clast_mesh_check_free(&r);
        clast_mesh_free(&mesh);
    }
}

static void spider_has_its_flat_triangles(void **state)
{
    (void)state;
    static const struct {
        const char *file;
        int32_t n;
    } flats[] = {{"broken-meshes/assimp/Spider_binary.stl", 56},
                 {"broken-meshes/exadem/tore.stl", 672}};
    for (int i = 0; i < 2; ++i) {
        clast_mesh mesh = {0};
        clast_mesh_check_result r = {0};
        if (mesh_read_data(flats[i].file, &mesh)) {
            CHECK_OK(clast_mesh_check(&mesh, &r));
            assert_int_equal(r.n_degenerate, flats[i].n);
        }
        clast_mesh_check_free(&r);
        clast_mesh_free(&mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_have_their_stated_facts),
        cmocka_unit_test(torus_has_a_handle),
        cmocka_unit_test(spider_has_its_flat_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
