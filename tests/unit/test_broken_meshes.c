/* Unit: files that other projects keep because readers fail on them. Each is read as it stands or
 * refused in one line; the numbers are those of the data's own description (measured with an
 * independent program and with ADMesh), not of this reader. */
#include "support.h"

#include "geom/vertex_set.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *file;
    int32_t n_vert, n_tri;
    double area, volume; ///< NAN: not stated for this file
    double tolerance;
    const char *warning; ///< text that one of the warnings must hold, or NULL for no warning at all
    int32_t n_part;
} sound;

static const sound sounds[] = {
    {"trimesh/unit_cube.STL", 8, 12, 6.0, 1.0, 1e-12, NULL, 1},
    {"numpy-stl/CubeInvalidUnicode.stl", 8, 12, NAN, 8.0, 1e-12, NULL, 1},
    {"numpy-stl/HalfDonut.stl", 144, 288, NAN, 2.343149, 1e-6, "1 byte after the last", 1},
    {"numpy-stl/Moon_Chinese.stl", 60, 116, NAN, 0.8887226, 1e-6, NULL, 1},
    {"numpy-stl/triamid.stl", 7, 10, NAN, NAN, 0.0, NULL, 1},
    {"trimesh/empty.stl", 0, 0, 0.0, NAN, 0.0, NULL, 1},
    {"trimesh/stl_empty_bin.stl", 0, 0, 0.0, NAN, 0.0, NULL, 1},
    {"assimp/triangle_with_empty_solid.stl", 3, 1, 2.0, NAN, 1e-12, NULL, 2},
    {"trimesh/two_objects_mixed_case_names.stl", 16, 24, NAN, 2.0, 1e-12, NULL, 2},
    {"trimesh/multibody.stl", 20, 32, NAN, NAN, 0.0, NULL, 2},
    {"trimesh/shared.STL", 14, 24, 12.0, 2.0, 1e-12, NULL, 1},
    {"trimesh/soup.stl", 300, 100, NAN, NAN, 0.0, NULL, 1},
    {"trimesh/angle_block.STL", 398, 704, 9.387338, 1.145522, 1e-6, NULL, 1},
    {"assimp/Spider_binary.stl", 722, 1368, NAN, NAN, 0.0, "normals disagree", 1},
    {"exadem/tore.stl", 132, 866, NAN, NAN, 0.0, NULL, 1},
    {"happly/platonic_shelf_ascii.ply", 50, 80, 43.0602082, 9.76105097, 1e-8, NULL, 1},
    {"happly/platonic_shelf_big_endian.ply", 50, 80, 43.0602082, 9.76105097, 1e-8, NULL, 1},
    {"assimp/cube_binary_header_with_RN_newline.ply", 8, 12, NAN, 1.0, 1e-12, NULL, 1},
    {"assimp/cube.ply", 8, 12, NAN, 1.0, 1e-12, NULL, 1},
    {"draco/cube_quads.ply", 8, 12, NAN, 1.0, 1e-12, NULL, 1},
    {"trimesh/cube_blender_uv.ply", 24, 12, NAN, 1.0, 1e-12, NULL, 1},
    {"draco/delim_test.ply", 24, 12, 928.122895, NAN, 1e-8, "1 rows of other elements", 1},
    {"trimesh/metadata.ply", 4, 2, 64.0, NAN, 1e-12, NULL, 1},
    {"trimesh/multi.ply", 4, 2, 4.0, NAN, 1e-12, NULL, 1},
    {"trimesh/points_ascii_with_lists.ply", 5, 0, NAN, NAN, 0.0, "2 rows of other elements", 1},
    {"trimesh/ply_empty_header.ply", 0, 0, NAN, NAN, 0.0, "nothing to read", 1},
    {"trimesh/negative_indices.obj", 8, 12, NAN, 8.0, 1e-12, NULL, 1},
    {"trimesh/jacked.obj", 8, 12, NAN, 1.0, 1e-12, NULL, 1},
    {"trimesh/cubevt.obj", 24, 12, NAN, 1.0, 1e-12, NULL, 1},
    {"trimesh/nancolor.obj", 8, 12, NAN, 1.0, 1e-12, NULL, 1},
    {"trimesh/polygonfaces.obj", 5, 3, NAN, NAN, 0.0, NULL, 1},
    {"trimesh/notenoughindices.obj", 3, 1, 250000.0, NAN, 1e-12, "fewer than three corners", 1},
    {"trimesh/wallhole.obj", 92, 66, 721.421356, 1066.666667, 1e-9, NULL, 1},
    {"trimesh/obj_points.obj", 8, 0, NAN, NAN, 0.0, NULL, 1},
    {"assimp/point_cloud.obj", 3, 0, NAN, NAN, 0.0, NULL, 1},
    {"tinyobjloader/cube-vertex-w-component.obj", 8, 12, NAN, 8.0, 1e-12, NULL, 6},
    {"tinyobjloader/leading-decimal-dot-issue-201.obj", 3, 1, NAN, NAN, 0.0, NULL, 1},
    {"tinyobjloader/issue-295-trianguation-failure.obj", 16, 28, 14.0, 3.0, 1e-12, NULL, 1},
    {"tinyobjloader/invalid-face-definition.obj", 8, 0, NAN, NAN, 0.0, "2 of 2 faces", 2},
    {"assimp/box_longline.obj", 8, 944, NAN, NAN, 0.0, "cross themselves", 1},
    {"assimp/concave_polygon.obj", 64, 64, 0.245497, NAN, 2e-6, NULL, 1},
    {"assimp/multiple_spaces.obj", 4, 1, 2.598076, NAN, 1e-6, NULL, 1},
    {"draco/deg_faces.obj", 6, 4, NAN, NAN, 0.0, NULL, 1},
    {"draco/eof_test.obj", 3, 1, 0.095, NAN, 1e-9, NULL, 1},
    {"draco/non_manifold_wrap.obj", 10, 12, NAN, NAN, 0.0, NULL, 1},
    {"draco/multiple_tetrahedrons.obj", 20, 20, NAN, 0.000833333, 1e-6, NULL, 1},
    {"draco/test_nm.obj", 114, 170, 9.96049141, NAN, 1e-9, NULL, 1},
    {"trimesh/comments.off", 8, 12, NAN, 12.3168, 1e-6, NULL, 1},
};

typedef struct {
    const char *file;
    const char *words; ///< what the one line must say
} refused;

static const refused refusals[] = {
    {"assimp/issue623.ply", "line 14: row 1 of 24 of 'vertex' has fewer numbers"},
    {"assimp/empty.ply", "empty (0 bytes)"},
    {"assimp/empty.obj", "empty (0 bytes)"},
    {"tinyobjloader/issue-140-zero-face-idx.obj", "line 16: face corner 0: OBJ counts"},
    {"assimp/malformed.obj", "line 23: face corner 12 of 8 vertices"},
    {"assimp/box_UTF16BE.obj", "UTF-16"},
    {"draco/inf_nan.obj", "line 1: vertex coordinate x 'inf' is not a finite number"},
    {"assimp/OutOfMemory.off", "line 2: 353535235358 vertices"},
    {"assimp/invalid.off", "line 2: edge count is missing"},
    {"coxeter/convex_polyhedron.off", "line 4: face count 'f11' is not a whole number"},
};

enum {
    N_SOUND = sizeof sounds / sizeof sounds[0],
    N_REFUSED = sizeof refusals / sizeof refusals[0]
};

static const char *broken(const char *file)
{
    char name[256];
    (void)snprintf(name, sizeof name, "broken-meshes/%s", file);
    return support_data(name);
}

static void check_sound(const sound *s)
{
    clast_mesh mesh = {0};
    clast_mesh_read_report report;
    bool said = s->warning == NULL;
    print_message("%s\n", s->file);
    CHECK_OK(clast_mesh_read(broken(s->file), &mesh, &report));
    assert_int_equal(mesh.n_vert, s->n_vert);
    assert_int_equal(mesh.n_tri, s->n_tri);
    assert_int_equal(report.n_part, s->n_part);
    if (!isnan(s->area)) {
        CHECK_REL(clast_mesh_area(&mesh), s->area, s->tolerance);
    }
    if (!isnan(s->volume)) {
        CHECK_REL(clast_mesh_volume(&mesh), s->volume, s->tolerance);
    }
    for (int32_t i = 0; i < report.n_warning; ++i) {
        said = said || strstr(report.warning[i], s->warning) != NULL;
    }
    assert_true(said);
    assert_true(s->warning != NULL || report.n_warning == 0);
    clast_mesh_free(&mesh);
}

static void each_sound_file_is_read_as_stated(void **state)
{
    (void)state;
    for (int i = 0; i < N_SOUND; ++i) {
        check_sound(&sounds[i]);
    }
}

static void each_hopeless_file_is_refused_in_one_line(void **state)
{
    (void)state;
    for (int i = 0; i < N_REFUSED; ++i) {
        clast_mesh mesh = {0};
        print_message("%s\n", refusals[i].file);
        CHECK_STATUS(clast_mesh_read(broken(refusals[i].file), &mesh, NULL), CLAST_E_FORMAT);
        assert_null(mesh.vert);
        assert_non_null(strstr(clast_error_detail(), refusals[i].file));
        assert_non_null(strstr(clast_error_detail(), refusals[i].words));
        assert_null(strchr(clast_error_detail(), '\n'));
    }
}

// ---- borders, after merging bit-equal vertices only

typedef struct {
    int32_t a, b; ///< a < b
    int32_t up;   ///< 1 when the triangle runs a to b
} edge;

static int by_ends(const void *x, const void *y)
{
    const edge *p = x;
    const edge *q = y;
    return p->a != q->a ? (p->a < q->a ? -1 : 1) : (p->b > q->b) - (p->b < q->b);
}

/// Edges with one face, with more than two, and with two that run the same way; facets that name a
/// vertex twice have no edges.
static void count_edges(const clast_mesh *mesh, int *b, int *n, int *i)
{
    int32_t n_edge = 0;
    clx_vertex_set set = {0};
    edge *edges = calloc(3 * (size_t)mesh->n_tri + 1, sizeof *edges);
    assert_non_null(edges);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        int32_t c[3];
        for (int k = 0; k < 3; ++k) {
            CHECK_OK(clx_vertex_set_add(&set, mesh->vert[mesh->tri[t][k]], &c[k]));
        }
        for (int k = 0; k < 3 && c[0] != c[1] && c[1] != c[2] && c[2] != c[0]; ++k) {
            const int32_t p = c[k];
            const int32_t q = c[(k + 1) % 3];
            edges[n_edge++] = (edge){p < q ? p : q, p < q ? q : p, p < q};
        }
    }
    clx_vertex_set_free(&set);
    qsort(edges, (size_t)n_edge, sizeof *edges, by_ends);
    *b = *n = *i = 0;
    for (int32_t first = 0, last = 0; first < n_edge; first = last) {
        int32_t up = 0;
        for (last = first; last < n_edge && by_ends(&edges[first], &edges[last]) == 0; ++last) {
            up += edges[last].up;
        }
        *b += last - first == 1;
        *n += last - first > 2;
        *i += last - first == 2 && up != 1;
    }
    free(edges);
}

static void borders_are_those_of_vertices_merged_bit_by_bit(void **state)
{
    static const struct {
        const char *file;
        int b, n, i;
    } cases[] = {
        {"trimesh/unit_cube.STL", 0, 0, 0},
        {"numpy-stl/HalfDonut.stl", 0, 0, 0},
        {"numpy-stl/Moon_Chinese.stl", 0, 0, 0},
        {"numpy-stl/triamid.stl", -1, -1, 13},
        {"trimesh/multibody.stl", -1, -1, 12},
        {"trimesh/shared.STL", 0, 1, 0},
        {"trimesh/soup.stl", 300, 0, 0},
        {"trimesh/angle_block.STL", 166, -1, -1},
        {"assimp/Spider_binary.stl", 72, -1, 10},
        {"exadem/tore.stl", 68, 32, -1},
        {"draco/delim_test.ply", 4, -1, -1},
        {"draco/non_manifold_wrap.obj", 8, 1, -1},
        {"draco/multiple_tetrahedrons.obj", 0, 0, 0},
        {"draco/test_nm.obj", 30, -1, -1},
        {"happly/platonic_shelf_big_endian.ply", 0, 0, 0},
    };
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        clast_mesh mesh = {0};
        int got[3];
        const int wanted[3] = {cases[k].b, cases[k].n, cases[k].i};
        CHECK_OK(clast_mesh_read(broken(cases[k].file), &mesh, NULL));
        count_edges(&mesh, &got[0], &got[1], &got[2]);
        print_message("%s b%d n%d i%d\n", cases[k].file, got[0], got[1], got[2]);
        for (int e = 0; e < 3; ++e) {
            assert_true(wanted[e] < 0 || got[e] == wanted[e]);
        }
        clast_mesh_free(&mesh);
    }
}

static void particular_findings_are_reported(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh_read_report r;
    CHECK_OK(clast_mesh_read(broken("numpy-stl/HalfDonut.stl"), &mesh, &r));
    assert_int_equal(r.n_trailing, 1);
    clast_mesh_free(&mesh);
    CHECK_OK(clast_mesh_read(broken("assimp/Spider_binary.stl"), &mesh, &r));
    assert_int_equal(r.n_zero_normal, 56);
    clast_mesh_free(&mesh);
    CHECK_OK(clast_mesh_read(broken("exadem/tore.stl"), &mesh, &r));
    assert_int_equal(r.n_zero_normal, 672);
    clast_mesh_free(&mesh);
    CHECK_OK(clast_mesh_read(broken("trimesh/wallhole.obj"), &mesh, &r));
    assert_int_equal(r.n_facet, 13);
    assert_true(r.n_concave > 0);
    clast_mesh_free(&mesh);
    CHECK_OK(clast_mesh_read(broken("assimp/box_longline.obj"), &mesh, &r));
    assert_int_equal(r.n_facet, 6);
    clast_mesh_free(&mesh);
    CHECK_OK(clast_mesh_read(broken("tinyobjloader/leading-decimal-dot-issue-201.obj"), &mesh, &r));
    assert_true(mesh.vert[0][0] == 0.08 && mesh.vert[0][1] == -70.0 &&
                mesh.vert[0][2] == -5.532511);
    clast_mesh_free(&mesh);
    CHECK_OK(clast_mesh_read(broken("happly/platonic_shelf_big_endian.ply"), &mesh, &r));
    assert_true(r.is_binary && r.is_big_endian);
    clast_mesh_free(&mesh);
}

static void one_body_is_the_same_in_three_formats(void **state)
{
    static const char *const names[] = {"obj", "ply", "stl"};
    (void)state;
    for (int i = 0; i < 3; ++i) {
        char name[64];
        clast_mesh mesh = {0};
        (void)snprintf(name, sizeof name, "shapes/multiformat/convex_polyhedron.%s", names[i]);
        CHECK_OK(clast_mesh_read(support_data(name), &mesh, NULL));
        assert_int_equal(mesh.n_vert, 11);
        assert_int_equal(mesh.n_tri, 18);
        CHECK_REL(clast_mesh_volume(&mesh), 1.0, 1e-7);
        CHECK_REL(clast_mesh_area(&mesh), 5.55690024, 1e-8);
        clast_mesh_free(&mesh);
    }
}

static void block_of_admesh_is_read_as_stated(void **state)
{
    static const struct {
        const char *file;
        int32_t n_tri, b, i;
        double volume; ///< NAN where the surface is open or mixed
    } cases[] = {
        {"basic.stl", 12, 0, 0, 61.023745},
        {"binary.stl", 12, 0, 0, 61.023745},
        {"fill-holes-bad.stl", 11, 3, 0, NAN},
        {"normal-directions-bad.stl", 12, 0, 3, NAN},
        {"exact-bad.stl", 12, 4, 0, NAN},
        {"nearby-bad.stl", 12, 4, 0, NAN},
        {"exact-good.stl", 12, 4, 0, NAN},
        {"nearby-good.stl", 12, 4, 0, NAN},
        {"normal-directions-good.stl", 12, 0, 0, -61.023745},
        {"remove-unconnected-good.stl", 24, 0, 0, 122.0475},
    };
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        char name[128];
        clast_mesh mesh = {0};
        int b = 0;
        int n = 0;
        int i = 0;
        (void)snprintf(name, sizeof name, "broken-meshes/admesh-block/%s", cases[k].file);
        const char *path = support_shared(name);
        if (path == NULL) {
            skip();
        }
        CHECK_OK(clast_mesh_read(path, &mesh, NULL));
        count_edges(&mesh, &b, &n, &i);
        print_message("%s b%d i%d V=%.9g\n", cases[k].file, b, i, clast_mesh_volume(&mesh));
        assert_int_equal(mesh.n_tri, cases[k].n_tri);
        assert_int_equal(b, cases[k].b);
        assert_int_equal(i, cases[k].i);
        if (!isnan(cases[k].volume)) {
            CHECK_REL(clast_mesh_volume(&mesh), cases[k].volume, 1e-6);
        }
        clast_mesh_free(&mesh);
    }
}

static void prism_is_the_same_in_three_formats(void **state)
{
    static const char *const names[] = {"off", "ply", "stl"};
    (void)state;
    for (int i = 0; i < 3; ++i) {
        char name[64];
        clast_mesh mesh = {0};
        (void)snprintf(name, sizeof name, "shapes/multiformat/tsoulis.%s", names[i]);
        const char *path = support_shared(name);
        if (path == NULL) {
            skip();
        }
        CHECK_OK(clast_mesh_read(path, &mesh, NULL));
        CHECK_REL(clast_mesh_volume(&mesh), 2000.0, 1e-12);
        CHECK_REL(clast_mesh_area(&mesh), 1000.0, 1e-12);
        clast_mesh_free(&mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_sound_file_is_read_as_stated),
        cmocka_unit_test(each_hopeless_file_is_refused_in_one_line),
        cmocka_unit_test(borders_are_those_of_vertices_merged_bit_by_bit),
        cmocka_unit_test(particular_findings_are_reported),
        cmocka_unit_test(one_body_is_the_same_in_three_formats),
        cmocka_unit_test(block_of_admesh_is_read_as_stated),
        cmocka_unit_test(prism_is_the_same_in_three_formats),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
