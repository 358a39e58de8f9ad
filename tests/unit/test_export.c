/* Unit: exported files hold the assembly: read back by the mesh and table readers, and by words. */
#include "states.h"
#include "support.h"

#include "base/alloc.h"
#include "base/file.h"
#include "io/export.h"
#include "io/points.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <clast/table.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { N = 6, LEVEL = 1, N_TRI = 3 * 80 + 2 * 12 + 2 * 80 };

/* Three ellipsoids, two boxes and a clump of two balls. */
static clast_status make_assembly(clast_assembly *a)
{
    clast_state s = {0};
    const clast_status status = support_state(&s);
    if (status == CLAST_OK) {
        *a = *s.assembly;
        *s.assembly = (clast_assembly){0};
    }
    clast_state_free(&s);
    return status;
}

/* All surfaces in one mesh, by the assembly's own function. */
static void expected_surface(const clast_assembly *a, clast_mesh *all)
{
    for (int32_t i = 0; i < a->n_grain; ++i) {
        CHECK_OK(clast_assembly_grain_surface(a, i, LEVEL, all));
    }
    assert_int_equal(all->n_tri, N_TRI);
}

static void surfaces_come_back(void **state)
{
    (void)state;
    static const char *const files[] = {"a.obj", "a.ply", "a.stl", "a.3mf"};
    const clast_export_options options = {.level = LEVEL};
    clast_assembly a = {0};
    clast_mesh all = {0};
    CHECK_OK(make_assembly(&a));
    expected_surface(&a, &all);
    for (int f = 0; f < 4; ++f) {
        clast_mesh back = {0};
        clast_export_report report;
        CHECK_OK(clast_assembly_write(&a, support_scratch_file(files[f]), &options, &report));
        assert_int_equal(report.n_triangle, N_TRI);
        if (f == 3) {
            continue; /* 3MF is not read */
        }
        CHECK_OK(clast_mesh_read(support_scratch_file(files[f]), &back, NULL));
        assert_int_equal(back.n_tri, N_TRI);
        for (int32_t t = 0; t < N_TRI; ++t) {
            for (int k = 0; k < 3; ++k) {
                const double *p = back.vert[back.tri[t][k]];
                const double *q = all.vert[all.tri[t][k]];
                CHECK_ABS(v3_distance(p, q), 0.0, f < 2 ? 0.0 : 1e-5); /* STL: 24 bits */
            }
        }
        clast_mesh_free(&back);
    }
    clast_mesh_free(&all);
    clast_assembly_free(&a);
}

static char *text_of(const char *path)
{
    static char *text; /* static: gcc 12 takes what is returned for the local's address */
    int64_t n = 0;
    text = NULL;
    CHECK_OK(clx_file_read_all(path, 1 << 26, &text, &n));
    return text;
}

static int count(const char *text, const char *word)
{
    int n = 0;
    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word)) {
        ++n;
    }
    return n;
}

static void obj_has_a_group_a_grain(void **state)
{
    (void)state;
    clast_assembly a = {0};
    CHECK_OK(make_assembly(&a));
    CHECK_OK(clast_assembly_write(&a, support_scratch_file("g.obj"), NULL, NULL));
    char *text = text_of(support_scratch_file("g.obj"));
    assert_int_equal(count(text, "\ng grain_"), N);
    assert_non_null(strstr(text, "\ng grain_100 shape_egg___the___first_\n"));
    assert_non_null(strstr(text, "\ng grain_105 shape_box\n"));
    assert_non_null(strstr(text, "unit mm\n"));
    clx_free(text);
    clast_assembly_free(&a);
}

/* Face rows of the PLY: grain and colour. Colours differ between grains and follow the choice. */
static void ply_faces_tell_grain_and_colour(void **state)
{
    (void)state;
    enum { FACE = 20 };
    clast_assembly a = {0};
    CHECK_OK(make_assembly(&a));
    for (int colour = 0; colour < 4; ++colour) {
        const clast_export_options options = {.level = LEVEL, .colour = (clast_colour)colour};
        char *bytes = NULL;
        int64_t n = 0;
        uint8_t first[N][3];
        int32_t n_of[N] = {0};
        CHECK_OK(clast_assembly_write(&a, support_scratch_file("c.ply"), &options, NULL));
        CHECK_OK(clx_file_read_all(support_scratch_file("c.ply"), 1 << 26, &bytes, &n));
        const char *faces = bytes + n - (ptrdiff_t)N_TRI * FACE;
        for (int t = 0; t < N_TRI; ++t) {
            int32_t grain = -1;
            memcpy(&grain, faces + (ptrdiff_t)t * FACE + 13, sizeof grain);
            assert_in_range(grain, 0, N - 1);
            memcpy(first[grain], faces + (ptrdiff_t)t * FACE + 17, 3);
            ++n_of[grain];
        }
        assert_int_equal(n_of[0], 80);
        assert_int_equal(n_of[1], 12);
        assert_int_equal(n_of[3], 160);
        const bool same = memcmp(first[1], first[5], 3) == 0; /* two boxes */
        assert_int_equal(same, colour == CLAST_COLOUR_SHAPE);
        assert_true(memcmp(first[0], first[1], 3) != 0);
        clx_free(bytes);
    }
    clast_assembly_free(&a);
}

static void csv_has_a_row_a_grain(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_table t = {0};
    CHECK_OK(make_assembly(&a));
    CHECK_OK(clast_assembly_write(&a, support_scratch_file("a.csv"), NULL, NULL));
    CHECK_OK(clast_table_read_csv(support_scratch_file("a.csv"), NULL, &t, NULL));
    assert_int_equal(t.n_row, N);
    assert_string_equal(t.column[clast_table_find(&t, "shape")].text[0], "egg, \"the\" <first>");
    for (int i = 0; i < N; ++i) {
        const clast_shape *s = &a.shape[a.shape_id[i]];
        const double scale = a.scale[i];
        assert_true(clast_table_numbers(&t, "id")[i] == 100.0 + i);
        assert_true(clast_table_numbers(&t, "x_mm")[i] == a.position[i][0]);
        assert_true(clast_table_numbers(&t, "qz")[i] == a.orientation[i][3]);
        assert_true(clast_table_numbers(&t, "scale")[i] == scale);
        assert_true(clast_table_numbers(&t, "length_mm")[i] == scale * s->length);
        CHECK_REL(clast_table_numbers(&t, "volume_mm3")[i], pow(scale, 3) * s->volume, 1e-15);
        CHECK_REL(clast_table_numbers(&t, "mass_kg")[i],
                  1e-9 * pow(scale, 3) * s->volume * a.density[i], 1e-14);
    }
    assert_true(clast_table_numbers(&t, "n_contact")[1] == 2.0);
    assert_true(clast_table_numbers(&t, "n_contact")[2] == 0.0);
    clast_table_free(&t);
    memcpy(a.unit, "model", 6);
    CHECK_OK(clast_assembly_table(&a, &t));
    assert_true(clast_table_find(&t, "mass_kg") < 0 && clast_table_find(&t, "x_model") > 0);
    clast_table_free(&t);
    clast_assembly_free(&a);
}

/* The dump's ellipsoid has the grain's mass and, turned, its second moments. */
static void dump_has_the_grains_moments(void **state)
{
    (void)state;
    clast_assembly a = {0};
    CHECK_OK(make_assembly(&a));
    CHECK_OK(clast_assembly_write(&a, support_scratch_file("a.dump"), NULL, NULL));
    char *text = text_of(support_scratch_file("a.dump"));
    const char *line = strstr(text, "radius density\n");
    assert_non_null(line);
    assert_non_null(strstr(text, "NUMBER OF ATOMS\n6\n"));
    line = strchr(line, '\n') + 1;
    for (int i = 0; i < N; ++i) {
        double v[14];
        char *end = NULL;
        for (int k = 0; k < 14; ++k) {
            v[k] = strtod(line, &end);
            line = end;
        }
        const clast_shape *s = &a.shape[a.shape_id[i]];
        const double scale = a.scale[i];
        double turn[3][3];
        double grain[3][3];
        assert_true(v[0] == 101.0 + i && v[1] == 1.0 + a.shape_id[i]);
        assert_true(s->kind != CLAST_SHAPE_ELLIPSOID || v[13] == 2000.0 + i);
        CHECK_REL(v[12], 0.5 * cbrt(v[9] * v[10] * v[11]), 1e-14);
        q_matrix(turn, v + 5);
        q_matrix(grain, a.orientation[i]);
        const double volume = CLAST_PI / 6.0 * v[9] * v[10] * v[11];
        CHECK_REL(volume * v[13], pow(scale, 3) * s->volume * (2000.0 + i), 1e-13); /* its mass */
        if (s->kind == CLAST_SHAPE_ELLIPSOID) {
            CHECK_REL(volume, pow(scale, 3) * s->volume, 1e-14);
        }
        for (int j = 0; j < 3; ++j) {
            for (int k = 0; k < 3; ++k) {
                double of_dump = 0.0; /* world second moments per volume: R diag(a2/5) R^T */
                double of_grain = 0.0;
                const double half = 0.5 * (s->inertia[0][0] + s->inertia[1][1] + s->inertia[2][2]);
                for (int m = 0; m < 3; ++m) {
                    of_dump += turn[j][m] * v[9 + m] * v[9 + m] / 20.0 * turn[k][m];
                    for (int l = 0; l < 3; ++l) {
                        const double c = (m == l ? half : 0.0) - s->inertia[m][l];
                        of_grain += grain[j][m] * c * grain[k][l];
                    }
                }
                CHECK_ABS(of_dump, scale * scale * of_grain / s->volume, 1e-13 * scale * scale);
            }
        }
    }
    clx_free(text);
    clast_assembly_free(&a);
}

static void equal_assemblies_give_equal_bytes(void **state)
{
    (void)state;
    static const char *const ends[] = {"vtu", "stl", "obj", "ply", "3mf", "csv", "json", "dump"};
    clast_assembly a = {0};
    CHECK_OK(make_assembly(&a));
    for (size_t f = 0; f < sizeof ends / sizeof ends[0]; ++f) {
        char *bytes[2] = {0};
        int64_t n[2];
        for (int i = 0; i < 2; ++i) {
            char path[600];
            (void)snprintf(path, sizeof path, "%s.%s", support_scratch_file(i == 0 ? "one" : "two"),
                           ends[f]);
            CHECK_OK(clast_assembly_write(&a, path, NULL, NULL));
            CHECK_OK(clx_file_read_all(path, 1 << 26, &bytes[i], &n[i]));
        }
        assert_int_equal(n[0], n[1]);
        assert_memory_equal(bytes[0], bytes[1], (size_t)n[0]);
        clx_free(bytes[0]);
        clx_free(bytes[1]);
    }
    clast_assembly_free(&a);
}

static void wrong_wishes_are_refused(void **state)
{
    (void)state;
    const clast_export_options points = {.points = true};
    clast_assembly a = {0};
    CHECK_OK(make_assembly(&a));
    CHECK_STATUS(clast_assembly_write(&a, support_scratch_file("a.xyz"), NULL, NULL),
                 CLAST_E_USAGE);
    CHECK_STATUS(clast_assembly_write(&a, support_scratch_file("p.stl"), &points, NULL),
                 CLAST_E_USAGE);
    memcpy(a.unit, "model", 6);
    CHECK_STATUS(clast_assembly_write(&a, support_scratch_file("m.3mf"), NULL, NULL),
                 CLAST_E_USAGE);
    CHECK_STATUS(clast_assembly_write(&a, "/dev/full/a.stl", NULL, NULL), CLAST_E_DISK);
    a.position[0][0] = 1e39;
    CHECK_STATUS(clast_assembly_write(&a, support_scratch_file("far.stl"), NULL, NULL),
                 CLAST_E_GEOMETRY);
    assert_int_not_equal(access(support_scratch_file("far.stl"), F_OK), 0);
    clast_assembly_free(&a);
}

static void nothing_is_exported_as_nothing(void **state)
{
    (void)state;
    static const char *const ends[] = {"vtu", "stl", "obj", "ply", "csv", "json", "dump"};
    clast_assembly none = {0};
    for (size_t f = 0; f < sizeof ends / sizeof ends[0]; ++f) {
        char path[600];
        (void)snprintf(path, sizeof path, "%s.%s", support_scratch_file("none"), ends[f]);
        CHECK_OK(clast_assembly_write(&none, path, NULL, NULL));
    }
}

static clast_status write_all(void *context)
{
    static const char *const ends[] = {"vtu", "stl", "obj", "ply", "3mf", "csv", "json", "dump"};
    const clast_export_options options = {0};
    const clast_export_options points = {.points = true};
    clast_assembly a = {0};
    clast_status status = make_assembly(&a);
    for (size_t f = 0; f < sizeof ends / sizeof ends[0] && status == CLAST_OK; ++f) {
        char path[600];
        (void)snprintf(path, sizeof path, "%s.%s", (const char *)context, ends[f]);
        status = clast_assembly_write(&a, path, f == 0 ? &points : &options, NULL);
    }
    clast_assembly_free(&a);
    return status;
}

static void exports_survive_refused_memory(void **state)
{
    (void)state;
    support_refuse_each_allocation_at(write_all, "memory");
}

/* The k-th disk operation of all eight exports is refused, for every k. */
static void full_disk_leaves_no_part_of_a_file(void **state)
{
    (void)state;
#ifdef CLAST_ALLOC_INJECT
    char path[512];
    CHECK_OK(clx_folder_make(support_scratch_file("full")));
    clast_status status = CLAST_E_DISK;
    (void)snprintf(path, sizeof path, "%s", support_scratch_file("full/f"));
    for (int k = 1; status != CLAST_OK; k += 5) {
        (void)clx_file_refuse(k, ENOSPC);
        status = write_all(path);
        (void)clx_file_refuse(0, 0);
        assert_true(status == CLAST_OK || status == CLAST_E_DISK);
        char temporary[600];
        (void)snprintf(temporary, sizeof temporary, "%s/.clast-%ld-0.tmp",
                       support_scratch_file("full"), (long)getpid());
        assert_int_not_equal(access(temporary, F_OK), 0);
        assert_true(k < 200);
    }
#endif
}

static void vtu_tells_how_grains_are_placed(void **state)
{
    (void)state;
    clast_assembly a = {0};
    CHECK_OK(make_assembly(&a));
    for (int points = 0; points < 2; ++points) {
        const clast_export_options options = {.level = 1, .points = points == 1};
        clast_table grains = {0};
        clast_table names = {0};
        const char *path = support_scratch_file(points == 1 ? "points.vtu" : "surfaces.vtu");
        CHECK_OK(clast_assembly_write(&a, path, &options, NULL));
        CHECK_OK(clx_vtu_grains(path, &grains, &names));
        assert_int_equal(grains.n_row, a.n_grain);
        assert_int_equal(names.n_row, a.n_shape);
        for (int32_t i = 0; i < a.n_grain; ++i) {
            const int32_t s = (int32_t)clast_table_numbers(&grains, "shape")[i];
            assert_int_equal(s, a.shape_id[i]);
            assert_string_equal(names.column[0].text[s], a.shape[s].name);
            assert_true(clast_table_numbers(&grains, "grain")[i] == (double)a.id[i]);
            assert_true(clast_table_numbers(&grains, "scale")[i] == a.scale[i]);
            assert_true(clast_table_numbers(&grains, "density")[i] == a.density[i]);
            for (int k = 0; k < 4; ++k) {
                static const char *const turn[4] = {"orientation_wxyz_0", "orientation_wxyz_1",
                                                    "orientation_wxyz_2", "orientation_wxyz_3"};
                static const char *const axis[3] = {"x", "y", "z"};
                assert_true(clast_table_numbers(&grains, turn[k])[i] == a.orientation[i][k]);
                assert_true(k == 3 || clast_table_numbers(&grains, axis[k])[i] == a.position[i][k]);
            }
        }
        clast_table_free(&grains);
        clast_table_free(&names);
    }
    clast_assembly_free(&a);
}

static void collection_names_its_files(void **state)
{
    (void)state;
    static const double time[2] = {0.0, 0.1};
    static const char *const names[2] = {"a.vtu", "b&\"c<.vtu"};
    CHECK_OK(clast_pvd_write(support_scratch_file("all.pvd"), 2, time, names));
    char *text = text_of(support_scratch_file("all.pvd"));
    assert_non_null(strstr(text, "<DataSet timestep=\"0.1\" part=\"0\" "
                                 "file=\"b&amp;&quot;c&lt;.vtu\"/>"));
    assert_int_equal(count(text, "<DataSet"), 2);
    clx_free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_come_back),
        cmocka_unit_test(vtu_tells_how_grains_are_placed),
        cmocka_unit_test(obj_has_a_group_a_grain),
        cmocka_unit_test(ply_faces_tell_grain_and_colour),
        cmocka_unit_test(csv_has_a_row_a_grain),
        cmocka_unit_test(dump_has_the_grains_moments),
        cmocka_unit_test(equal_assemblies_give_equal_bytes),
        cmocka_unit_test(wrong_wishes_are_refused),
        cmocka_unit_test(nothing_is_exported_as_nothing),
        cmocka_unit_test(exports_survive_refused_memory),
        cmocka_unit_test(full_disk_leaves_no_part_of_a_file),
        cmocka_unit_test(collection_names_its_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
