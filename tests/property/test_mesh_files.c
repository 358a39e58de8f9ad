/* Property: what is written comes back; what is cut short or changed never harms. */
#include "support.h"

#include "base/alloc.h"
#include "base/file.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Coordinates of all sizes and signs, triangles of any vertices.
static void random_mesh(uint64_t k, clast_mesh *mesh)
{
    clx_rng rng = clx_rng_at(11, CLX_STREAM_TEST, k);
    const int32_t n = 4 + (int32_t)clx_rng_below(&rng, 40);
    CHECK_OK(clast_mesh_alloc(n, 2 * n, mesh));
    for (int32_t i = 0; i < n; ++i) {
        for (int c = 0; c < 3; ++c) {
            mesh->vert[i][c] =
                clx_rng_normal(&rng) * pow(10.0, (double)clx_rng_below(&rng, 60) - 30);
        }
    }
    mesh->vert[0][0] = -0.0;
    mesh->vert[1][1] = 4.9406564584124654e-324;
    mesh->vert[2][2] = 1.7976931348623157e308;
    for (int32_t t = 0; t < 2 * n; ++t) {
        const int32_t first = (int32_t)clx_rng_below(&rng, n);
        for (int c = 0; c < 3; ++c) {
            mesh->tri[t][c] = (first + c) % n;
        }
    }
}

static void same_doubles_come_back(void **state)
{
    static const char *const names[] = {"a.ply", "a.obj", "a.off"};
    (void)state;
    for (uint64_t k = 0; k < 60; ++k) {
        const char *path = support_scratch_file(names[k % 3]);
        clast_mesh mesh = {0};
        clast_mesh back = {0};
        clast_mesh_read_report r;
        random_mesh(k, &mesh);
        CHECK_OK(clast_mesh_write(&mesh, path,
                                  &(clast_mesh_write_options){.unit = "um", .name = "a\nf 1 2 3"}));
        CHECK_OK(clast_mesh_read(path, &back, &r));
        assert_int_equal(back.n_vert, mesh.n_vert);
        assert_int_equal(back.n_tri, mesh.n_tri);
        assert_memory_equal(back.vert, mesh.vert, (size_t)mesh.n_vert * sizeof *mesh.vert);
        assert_memory_equal(back.tri, mesh.tri, (size_t)mesh.n_tri * sizeof *mesh.tri);
        assert_int_equal(r.n_warning, 0);
        clast_mesh_free(&mesh);
        clast_mesh_free(&back);
    }
}

static void stl_gives_back_the_nearest_singles_and_the_same_triangles(void **state)
{
    (void)state;
    const double axes[3] = {1.0, 2.0, 3.0};
    const double turn[4] = {0.5, 0.5, 0.5, 0.5};
    const double place[3] = {0.1, -7.3, 11.9};
    clast_mesh mesh = {0};
    clast_mesh back = {0};
    CHECK_OK(clast_mesh_ellipsoid(axes, 3, &mesh));
    clast_mesh_transform(&mesh, 1.7, turn, place);
    CHECK_OK(clast_mesh_write(&mesh, support_scratch_file("a.stl"), NULL));
    CHECK_OK(clast_mesh_read(support_scratch_file("a.stl"), &back, NULL));
    assert_int_equal(back.n_vert, mesh.n_vert);
    assert_int_equal(back.n_tri, mesh.n_tri);
    for (int32_t t = 0; t < mesh.n_tri; ++t) {
        for (int c = 0; c < 9; ++c) {
            const double wanted = mesh.vert[mesh.tri[t][c / 3]][c % 3];
            const double got = back.vert[back.tri[t][c / 3]][c % 3];
            assert_true(got == (double)(float)wanted);
        }
    }
    clast_mesh_free(&mesh);
    clast_mesh_free(&back);
}

static void equal_meshes_give_equal_files(void **state)
{
    static const char *const names[] = {"s.stl", "s.ply", "s.obj", "s.off", "s.3mf"};
    (void)state;
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &mesh));
    for (int i = 0; i < 5; ++i) {
        char *first = NULL;
        char *second = NULL;
        int64_t n = 0;
        int64_t m = 0;
        const clast_mesh_write_options options = {.unit = "mm", .name = "a <b> & \"c\""};
        CHECK_OK(clast_mesh_write(&mesh, support_scratch_file(names[i]), &options));
        CHECK_OK(clx_file_read_all(support_scratch_file(names[i]), 1 << 20, &first, &n));
        CHECK_OK(clast_mesh_write(&mesh, support_scratch_file(names[i]), &options));
        CHECK_OK(clx_file_read_all(support_scratch_file(names[i]), 1 << 20, &second, &m));
        assert_true(n == m && memcmp(first, second, (size_t)n) == 0);
        clx_free(first);
        clx_free(second);
    }
    clast_mesh_free(&mesh);
}

// ---- cut and changed files

static void check_outcome(clast_status status, clast_mesh *mesh)
{
    if (status != CLAST_OK) {
        assert_true(status == CLAST_E_FORMAT || status == CLAST_E_LIMIT);
        assert_true(mesh->vert == NULL && mesh->tri == NULL);
        return;
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            assert_true(mesh->tri[t][k] >= 0 && mesh->tri[t][k] < mesh->n_vert);
        }
    }
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        assert_true(isfinite(mesh->vert[i][0]) && isfinite(mesh->vert[i][1]) &&
                    isfinite(mesh->vert[i][2]));
    }
    clast_mesh_free(mesh);
}

/// Every length from nothing to the whole; the bytes stand at the end of their own heap block so
/// that the sanitizer sees one byte too many.
static void cut_everywhere(const char *path, clast_mesh_format format)
{
    char *bytes = NULL;
    int64_t n = 0;
    CHECK_OK(clx_file_read_all(path, 1 << 20, &bytes, &n));
    const int64_t step = n > 2000 ? 7 : 1;
    for (int64_t m = 0; m <= n; m += step) {
        clast_mesh mesh = {0};
        char *part = malloc((size_t)m + (m == 0));
        assert_non_null(part);
        memcpy(part, bytes, (size_t)m);
        check_outcome(clast_mesh_parse(part, (size_t)m, format, &mesh, NULL), &mesh);
        free(part);
    }
    clx_free(bytes);
}

/// One byte set to each of several values, at every place.
static void change_everywhere(const char *path, clast_mesh_format format)
{
    static const char values[] = {0, '\n', '-', '9', '\x7f', '\xff'};
    char *bytes = NULL;
    int64_t n = 0;
    CHECK_OK(clx_file_read_all(path, 1 << 20, &bytes, &n));
    for (int64_t i = 0; i < n; ++i) {
        const char before = bytes[i];
        clast_mesh mesh = {0};
        bytes[i] = values[i % (int64_t)sizeof values];
        check_outcome(clast_mesh_parse(bytes, (size_t)n, format, &mesh, NULL), &mesh);
        bytes[i] = before;
    }
    clx_free(bytes);
}

static const char *const small_files[] = {
    "trimesh/unit_cube.STL",
    "assimp/triangle_with_empty_solid.stl",
    "trimesh/two_objects_mixed_case_names.stl",
    "trimesh/negative_indices.obj",
    "trimesh/notenoughindices.obj",
    "assimp/concave_polygon.obj",
    "happly/platonic_shelf_big_endian.ply",
    "assimp/cube_binary_header_with_RN_newline.ply",
    "draco/delim_test.ply",
    "trimesh/points_ascii_with_lists.ply",
    "trimesh/cube_blender_uv.ply",
    "trimesh/comments.off",
};

static void any_cut_or_change_ends_in_an_error_or_a_mesh(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof small_files / sizeof small_files[0]; ++i) {
        char name[128];
        (void)snprintf(name, sizeof name, "broken-meshes/%s", small_files[i]);
        const clast_mesh_format format = clast_mesh_format_of_path(name);
        cut_everywhere(support_data(name), format);
        change_everywhere(support_data(name), format);
        cut_everywhere(support_data(name), CLAST_MESH_ANY);
    }
}

// ---- refused memory, refused disk

static clast_status read_file(void *context)
{
    clast_mesh mesh = {0};
    const clast_status status = clast_mesh_read(context, &mesh, NULL);
    clast_mesh_free(&mesh);
    return status;
}

static void readers_survive_refused_memory(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof small_files / sizeof small_files[0]; ++i) {
        char name[128];
        char path[256];
        (void)snprintf(name, sizeof name, "broken-meshes/%s", small_files[i]);
        (void)snprintf(path, sizeof path, "%s", support_data(name));
        support_refuse_each_allocation(read_file, path);
    }
}

static const char *const written[] = {"w.stl", "w.ply", "w.obj", "w.off", "w.3mf"};

static clast_status write_file(void *context)
{
    clast_mesh mesh = {0};
    clast_status status = clast_mesh_box(1.0, 1.0, 1.0, &mesh);
    if (status == CLAST_OK) {
        status = clast_mesh_write(&mesh, support_scratch_file(context),
                                  &(clast_mesh_write_options){.unit = "m"});
    }
    clast_mesh_free(&mesh);
    return status;
}

static int count_files(const char *folder)
{
    int n = 0;
    DIR *d = opendir(folder);
    assert_non_null(d);
    while (readdir(d) != NULL) {
        ++n;
    }
    assert_int_equal(closedir(d), 0);
    return n;
}

static void writers_survive_refused_memory(void **state)
{
    (void)state;
    for (int i = 0; i < 5; ++i) {
        char name[16];
        (void)snprintf(name, sizeof name, "%s", written[i]);
        support_refuse_each_allocation(write_file, name);
    }
}

static void full_disk_leaves_what_was_there(void **state)
{
    (void)state;
#ifdef CLAST_ALLOC_INJECT
    for (int i = 0; i < 5; ++i) {
        char name[16];
        char *before = NULL;
        int64_t n = 0;
        (void)snprintf(name, sizeof name, "%s", written[i]);
        CHECK_OK(write_file(name));
        CHECK_OK(clx_file_read_all(support_scratch_file(name), 1 << 20, &before, &n));
        const int n_file = count_files(support_scratch());
        int64_t struck = 0;
        for (int64_t k = 1; struck <= 0; ++k) {
            char *after = NULL;
            int64_t m = 0;
            (void)clx_file_refuse(k, ENOSPC);
            const clast_status status = write_file(name);
            struck = clx_file_refuse(0, 0);
            assert_int_equal(status, struck <= 0 ? CLAST_E_DISK : CLAST_OK);
            CHECK_OK(clx_file_read_all(support_scratch_file(name), 1 << 20, &after, &m));
            assert_true(n == m && memcmp(before, after, (size_t)n) == 0);
            assert_int_equal(count_files(support_scratch()), n_file);
            clx_free(after);
        }
        clx_free(before);
    }
#endif
}

static void what_cannot_be_written_is_refused(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &mesh));
    const int n_file = count_files(support_scratch());
    CHECK_STATUS(clast_mesh_write(&mesh, support_scratch_file("x.step"), NULL), CLAST_E_USAGE);
    CHECK_STATUS(clast_mesh_write(&mesh, support_scratch_file("x.3mf"), NULL), CLAST_E_USAGE);
    CHECK_STATUS(clast_mesh_write(&mesh, support_scratch_file("x.stl"),
                                  &(clast_mesh_write_options){.unit = "ell"}),
                 CLAST_E_USAGE);
    mesh.vert[3][1] = 1e39;
    CHECK_STATUS(clast_mesh_write(&mesh, support_scratch_file("x.stl"), NULL), CLAST_E_GEOMETRY);
    mesh.vert[3][1] = (double)NAN;
    CHECK_STATUS(clast_mesh_write(&mesh, support_scratch_file("x.ply"), NULL), CLAST_E_GEOMETRY);
    mesh.vert[3][1] = 0.0;
    mesh.tri[0][0] = mesh.tri[0][1];
    CHECK_STATUS(clast_mesh_write(&mesh, support_scratch_file("x.3mf"),
                                  &(clast_mesh_write_options){.unit = "m"}),
                 CLAST_E_GEOMETRY);
    assert_int_equal(count_files(support_scratch()), n_file);
    clast_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_doubles_come_back),
        cmocka_unit_test(stl_gives_back_the_nearest_singles_and_the_same_triangles),
        cmocka_unit_test(equal_meshes_give_equal_files),
        cmocka_unit_test(any_cut_or_change_ends_in_an_error_or_a_mesh),
        cmocka_unit_test(readers_survive_refused_memory),
        cmocka_unit_test(writers_survive_refused_memory),
        cmocka_unit_test(full_disk_leaves_what_was_there),
        cmocka_unit_test(what_cannot_be_written_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
