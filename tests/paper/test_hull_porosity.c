/* Paper [Rossi & Bonadonna, Fig. 9; spec section 5.4]: porosity of bodies against their hulls.
 *
 * The exact values follow from the surfaces alone (1 - volume / hull volume); SCARLET's rays and
 * spheres give 0.593, 0.554, 0.561 and 0.257 with 100 spheres. Hulls by qhull are the second
 * opinion. Where a file is too large for this repository it is looked for beside it. */
#include "support.h"

#include <unistd.h>

static const double no_turn[4] = {1.0, 0.0, 0.0, 0.0};

/* File under data/, else beside the repository; skips loudly when in neither. */
static void read_shape(const char *name, clast_mesh *mesh)
{
    const char *path = support_data(name);
    if (access(path, R_OK) != 0) {
        path = support_shared(name);
    }
    if (path == NULL) {
        skip();
    }
    CHECK_OK(clast_mesh_read(path, mesh, NULL));
}

static void check_porosity(const char *name, double wanted)
{
    clast_mesh mesh = {0};
    clast_mesh hull = {0};
    clast_shape shape = {0};
    clast_assembly a = {0};
    clast_envelope e = {0};
    const clast_envelope_options options = clast_envelope_options_default();
    read_shape(name, &mesh);
    CHECK_OK(clast_shape_mesh("body", &mesh, &shape));
    CHECK_OK(clast_assembly_add_shape(&a, &shape, NULL));
    CHECK_OK(clast_assembly_add_grain(&a, 0, (double[3]){1, 2, 3}, no_turn, 1.0, 2500.0));
    CHECK_OK(clast_assembly_envelope(&a, CLAST_ENVELOPE_SURFACE_HULL, &options, &e));
    CHECK_OK(clast_mesh_hull(&mesh, &hull));
    CHECK_REL(e.volume, clast_mesh_volume(&hull), 1e-10);
    CHECK_ABS(1.0 - clast_assembly_volume(&a) / e.volume, wanted, 5.1e-6);
    clast_mesh_free(&mesh);
    clast_mesh_free(&hull);
    clast_shape_free(&shape);
    clast_assembly_free(&a);
}

static void menger_2(void **state)
{
    (void)state;
    check_porosity("scarlet/stl/Menger2.stl", 0.45130);
    CHECK_ABS(1.0 - pow(20.0 / 27.0, 2.0), 0.45130, 5e-6); /* the body's own closed form */
}

static void menger_3(void **state)
{
    (void)state;
    check_porosity("scarlet/stl/Menger3.stl", 0.59356);
    CHECK_ABS(1.0 - pow(20.0 / 27.0, 3.0), 0.59356, 5e-6);
}

static void l_shaped(void **state)
{
    (void)state;
    check_porosity("scarlet/stl/L_shaped.stl", 0.63303);
}

static void pyramid(void **state)
{
    (void)state;
    check_porosity("scarlet/stl/pyramid.stl", 0.37091);
}

/* Radius of the smallest sphere about published grains, from another program [shapes README]. */
static void enclosing_spheres_of_published_grains(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double radius;
    } grain[] = {
        {"shapes/platonic/Tetrahedron.stl", 0.866025301},
        {"shapes/platonic/Dodecahedron.stl", 0.535233149},
        {"shapes/grains/sand.stl", 72.3747887},
        {"shapes/grains/Pear.stl", 6.37158158},
        {"shapes/grains/stone_0.ply", 0.11924172},
        {"shapes/asteroids/castalia.obj", 0.817501351},
        {"shapes/asteroids/216Kleopatra.obj", 110.165786},
        {"shapes/rocks-cad/curiosity_rock1.obj", 0.644679033},
        {"shapes/rocks-cad/offroad_rock4.obj", 2.00679227},
    };
    int n_checked = 0;
    for (size_t i = 0; i < sizeof grain / sizeof grain[0]; ++i) {
        const char *path = support_data(grain[i].name);
        if (access(path, R_OK) != 0) {
            path = support_shared(grain[i].name);
        }
        if (path == NULL) {
            continue;
        }
        clast_mesh mesh = {0};
        clast_shape shape = {0};
        clast_assembly a = {0};
        double centre[3];
        double radius = 0.0;
        CHECK_OK(clast_mesh_read(path, &mesh, NULL));
        CHECK_OK(clast_shape_mesh("grain", &mesh, &shape));
        CHECK_OK(clast_assembly_add_shape(&a, &shape, NULL));
        CHECK_OK(clast_assembly_add_grain(&a, 0, (double[3]){0, 0, 0}, no_turn, 1.0, 1.0));
        CHECK_OK(clast_assembly_enclosing_sphere(&a, centre, &radius));
        CHECK_REL(radius, grain[i].radius, 5e-7); /* float32 files, nine digits printed */
        clast_mesh_free(&mesh);
        clast_shape_free(&shape);
        clast_assembly_free(&a);
        ++n_checked;
    }
    if (n_checked == 0) {
        skip();
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(menger_2),
        cmocka_unit_test(menger_3),
        cmocka_unit_test(l_shaped),
        cmocka_unit_test(pyramid),
        cmocka_unit_test(enclosing_spheres_of_published_grains),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
