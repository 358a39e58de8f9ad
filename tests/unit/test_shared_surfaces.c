/* Unit: every surface of the shared data has the triangles, vertices, volume and area that its
 * description states (measured by an independent program). */
#include "support.h"

#include <clast/mesh.h>

#include <stdio.h>

typedef struct {
    const char *file;
    int32_t n_vert, n_tri;
    double volume, area; ///< NAN where not stated, or the surface is open
} row;

static const row rows[] = {
    {"scarlet/stl/27sk21_shape_coarse.stl", 291, 578, 1.29208e+06, NAN},
    {"scarlet/stl/27sk21_shape_fine.stl", 327, 650, 3903.7, NAN},
    {"scarlet/stl/ellipse.stl", 5008, 9996, 4188.1, NAN},
    {"scarlet/stl/Ellissoide_coarse_ash.stl", 5008, 9996, 1.33598e+06, NAN},
    {"scarlet/stl/Ellissoide_fine_ash.stl", 5000, 9996, 4017.81, NAN},
    {"scarlet/stl/L_shaped.stl", 2600, 5168, 32.6777, NAN},
    {"scarlet/stl/Menger2.stl", 498, 1296, 0.5487, NAN},
    {"scarlet/stl/Menger3.stl", 7954, 21456, 0.406445, NAN},
    {"scarlet/stl/particle.stl", 16640, 33274, 1286.86, NAN},
    {"scarlet/stl/ParticleParticle1.stl", 5008, 9996, 8.17988, NAN},
    {"scarlet/stl/ParticleParticle13.stl", 5008, 9992, NAN, NAN},
    {"scarlet/stl/ParticleParticle4.stl", 5016, 9996, 130.878, NAN},
    {"scarlet/stl/ParticleParticle6.stl", 5016, 9996, 65.4391, NAN},
    {"scarlet/stl/pyramid.stl", 11000, 21780, 221.084, NAN},
    {"scarlet/stl/snowflake.stl", 4928, 9247, NAN, NAN},
    {"scarlet/stl/sphere.stl", 5016, 9992, NAN, NAN},
    {"scarlet/stl/t_rex.stl", 7753, 15169, NAN, NAN},
    {"scarlet/stl/toy.stl", 5277, 10360, NAN, NAN},
    {"shapes/platonic/Tetrahedron.stl", 130, 256, 0.333333231, 3.46410079},
    {"shapes/platonic/Dodecahedron.stl", 482, 960, 0.427051006, 3.01217123},
    {"shapes/ellipsoids/Sphere_R_1.stl", 10242, 20480, 4.18652505, 12.5626137},
    {"shapes/ellipsoids/Ellipsoid_R_1_2_3.stl", 10242, 20480, 25.1191503, 48.8675078},
    {"shapes/grains/sand.stl", 127, 250, 559820.969, 35912.3007},
    {"shapes/grains/sand_finer.stl", 2002, 4000, 559820.969, 35912.3007},
    {"shapes/grains/Pear.stl", 750, 1496, 299.11732, 237.082537},
    {"shapes/grains/stone_0.ply", 162, 320, 0.00166602032, 0.0868154101},
    {"shapes/asteroids/castalia.obj", 2048, 4092, 0.667816841, 4.25568489},
    {"shapes/asteroids/216Kleopatra.obj", 2048, 4092, 708868.123, 52186.4121},
    {"shapes/primitives/box.stl", 272, 540, 1, 6},
    {"shapes/primitives/torus.stl", 127, 254, 0.348328029, 3.82577962},
    {"shapes/rocks-cad/curiosity_rock1.obj", 42, 80, 0.455757665, 3.15290519},
    {"shapes/rocks-cad/curiosity_rock2.obj", 56, 108, 1.17583636, 5.68067873},
    {"shapes/rocks-cad/offroad_rock2.obj", 360, 716, 7.56781014, 22.9144327},
    {"shapes/rocks-cad/offroad_rock4.obj", 757, 1510, 10.2249626, 25.0861633},
    {"shapes/multiformat/convex_polyhedron.ply", 11, 18, 1, 5.55690024},
    {"shapes/multiformat/tsoulis.ply", 8, 12, 2000, 1000},
    {"shapes/sh-grains/derived-stl/fdot57-A-anm-00003-level4.stl", 2562, 5120, 1362.29, 780.735},
    {"shapes/sh-grains/derived-stl/fdot57-B-anm-00002-level4.stl", 2562, 5120, 1389.84, 752.555},
    {"shapes/sh-grains/derived-stl/fdot57-C-anm-00001-level4.stl", 2562, 5120, 1542.47, 816.035},
    {"shapes/sh-grains/derived-stl/fdot57-D-anm-00004-level4.stl", 2562, 5120, 952.381, 598.233},
    {"shapes/sh-grains/derived-stl/fdot57-E-anm-00002-level4.stl", 2562, 5120, 1943.44, 914.841},
    {"shapes/sh-grains/derived-stl/fdot57-F-anm-00003-level4.stl", 2562, 5120, 1788.46, 832.802},
    {"shapes/sh-grains/derived-stl/fdot57-G-anm-00005-level4.stl", 2562, 5120, 1779.38, 834.755},
    {"shapes/sh-grains/derived-stl/fdot57-H-anm-00001-level4.stl", 2562, 5120, 2536.76, 1163.54},
    {"shapes/sh-grains/derived-stl/fdot57-A-anm-00001-level5.stl", 10242, 20480, 3080, 1191.32},
    {"shapes/sh-grains/derived-stl/cement152-anm-00004-level4.stl", 2562, 5120, 4345.6, 1758.69},
    {"shapes/sh-grains/derived-stl/cement152-anm-00053-level4.stl", 2562, 5120, 3230.53, 1382.32},
    {"shapes/sh-grains/derived-stl/cement152-anm-00106-level4.stl", 2562, 5120, 5078.29, 1789.17},
    {"shapes/sh-grains/derived-stl/cement152-anm-00151-level4.stl", 2562, 5120, 3825.67, 1501.26},
    {"shapes/sh-grains/derived-stl/cement152-anm-00185-level4.stl", 2562, 5120, 1956.02, 1007.17},
    {"shapes/sh-grains/derived-stl/cement152-anm-00244-level4.stl", 2562, 5120, 1793.17, 852.062},
    {"shapes/sh-grains/derived-stl/cement152-anm-00295-level5.stl", 10242, 20480, 2583.57, 1172.17},
};

static void surface_is_as_described(void **state)
{
    const row *r = *state;
    clast_mesh mesh = {0};
    const char *path = support_shared(r->file);
    if (path == NULL) {
        skip();
    }
    CHECK_OK(clast_mesh_read(path, &mesh, NULL));
    assert_int_equal(mesh.n_vert, r->n_vert);
    assert_int_equal(mesh.n_tri, r->n_tri);
    if (!isnan(r->volume)) { // five digits or more are stated, six of the area
        CHECK_REL(clast_mesh_volume(&mesh), r->volume, 2e-5);
    }
    if (!isnan(r->area)) {
        CHECK_REL(clast_mesh_area(&mesh), r->area, 5e-6);
    }
    clast_mesh_free(&mesh);
}

int main(void)
{
    enum { N = sizeof rows / sizeof rows[0] };
    struct CMUnitTest tests[N];
    for (int i = 0; i < N; ++i) {
        tests[i] = (struct CMUnitTest){.name = rows[i].file,
                                       .test_func = surface_is_as_described,
                                       .initial_state = (void *)&rows[i]};
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
