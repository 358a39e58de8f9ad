/* Unit: states come back bit for bit, equal states give equal bytes, and nothing is believed. */
#include "states.h"
#include "support.h"

#include "base/alloc.h"
#include "base/file.h"
#include "io/state.h"
#include "math/rng.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static clast_status add_shapes(clast_assembly *a)
{
    clast_status status = CLAST_OK;
    clast_mesh box = {0};
    clast_spheres pair = {0};
    clast_shape s[4] = {0};
    CLX_TRY(clast_mesh_box(1.0, 2.0, 3.0, &box));
    CLX_TRY(clast_spheres_alloc(2, &pair));
    pair.centre[1][0] = 1.0;
    pair.radius[0] = pair.radius[1] = 0.75;
    CLX_TRY(clast_shape_sphere("ball/with a slash", 0.1, &s[0]));
    CLX_TRY(clast_shape_ellipsoid("\xc3\xa9gg", (double[3]){3.0, 2.0, 1.0}, &s[1]));
    CLX_TRY(clast_shape_mesh("box", &box, &s[2]));
    CLX_TRY(clast_spheres_copy(&pair, &s[2].spheres)); /* its composite */
    CLX_TRY(clast_shape_clump("clump", &pair, &s[3]));
    for (int i = 0; i < 4; ++i) {
        CLX_TRY(clast_assembly_add_shape(a, &s[i], NULL));
    }
done:
    for (int i = 0; i < 4; ++i) {
        clast_shape_free(&s[i]);
    }
    clast_mesh_free(&box);
    clast_spheres_free(&pair);
    return status;
}

static clast_status make_assembly(clast_assembly *a)
{
    clast_status status = CLAST_OK;
    CLX_TRY(add_shapes(a));
    for (int i = 0; i < 40; ++i) {
        clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, (uint64_t)i);
        double x[3];
        double q[4];
        for (int k = 0; k < 3; ++k) {
            x[k] = clx_rng_normal(&rng) / 3.0;
        }
        clx_rng_orientation(&rng, q);
        CLX_TRY(clast_assembly_add_grain(a, i % 4, x, q, clx_rng_uniform(&rng), 2650.0));
        a->id[i] = INT64_MAX - i;
        if (i > 0) {
            CLX_TRY(clast_assembly_add_contact(a, i - 1, i, x));
        }
    }
    memcpy(a->unit, "um", 3);
done:
    return status;
}

static void check_same_assembly(const clast_assembly *a, const clast_assembly *b)
{
    const size_t n = (size_t)a->n_grain;
    assert_int_equal(a->n_grain, b->n_grain);
    assert_int_equal(a->n_shape, b->n_shape);
    assert_int_equal(a->n_contact, b->n_contact);
    assert_int_equal(a->contact != NULL, b->contact != NULL);
    assert_string_equal(a->unit, b->unit);
    assert_memory_equal(a->shape_id, b->shape_id, n * sizeof *a->shape_id);
    assert_memory_equal(a->position, b->position, n * sizeof *a->position);
    assert_memory_equal(a->orientation, b->orientation, n * sizeof *a->orientation);
    assert_memory_equal(a->scale, b->scale, n * sizeof *a->scale);
    assert_memory_equal(a->density, b->density, n * sizeof *a->density);
    assert_memory_equal(a->id, b->id, n * sizeof *a->id);
    if (a->n_contact > 0) {
        const size_t m = (size_t)a->n_contact;
        assert_memory_equal(a->contact, b->contact, m * sizeof *a->contact);
        assert_memory_equal(a->contact_point, b->contact_point, m * sizeof *a->contact_point);
    }
    for (int32_t i = 0; i < a->n_shape; ++i) {
        const clast_shape *s = &a->shape[i];
        const clast_shape *t = &b->shape[i];
        assert_int_equal(s->kind, t->kind);
        assert_string_equal(s->name, t->name);
        assert_true(s->volume == t->volume && s->length == t->length &&
                    s->bounding_radius == t->bounding_radius);
        assert_memory_equal(s->semi_axes, t->semi_axes, sizeof s->semi_axes);
        assert_memory_equal(s->inertia, t->inertia, sizeof s->inertia);
        assert_memory_equal(s->source_origin, t->source_origin, sizeof s->source_origin);
        assert_int_equal(s->mesh.n_vert, t->mesh.n_vert);
        assert_int_equal(s->mesh.n_tri, t->mesh.n_tri);
        assert_int_equal(s->spheres.n, t->spheres.n);
        if (s->mesh.n_vert > 0) {
            assert_memory_equal(s->mesh.vert, t->mesh.vert,
                                (size_t)s->mesh.n_vert * sizeof *s->mesh.vert);
            assert_memory_equal(s->mesh.tri, t->mesh.tri,
                                (size_t)s->mesh.n_tri * sizeof *s->mesh.tri);
        }
        if (s->spheres.n > 0) {
            assert_memory_equal(s->spheres.centre, t->spheres.centre,
                                (size_t)s->spheres.n * sizeof *s->spheres.centre);
        }
    }
}

static void assembly_comes_back_bit_for_bit(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_assembly b = {0};
    CHECK_OK(make_assembly(&a));
    CHECK_OK(clast_state_write_assembly(&a, support_scratch_file("a.h5"), NULL));
    CHECK_OK(clast_state_read_assembly(support_scratch_file("a.h5"), &b));
    check_same_assembly(&a, &b);
    CHECK_OK(clast_assembly_add_grain(&b, 0, a.position[0], a.orientation[0], 1.0, 1.0));
    clast_assembly_free(&b);
    clast_assembly_free(&a);
    CHECK_OK(clast_state_write_assembly(&a, support_scratch_file("none.h5"), NULL));
    CHECK_OK(clast_state_read_assembly(support_scratch_file("none.h5"), &b));
    assert_int_equal(b.n_grain + b.n_shape, 0);
    clast_assembly_free(&b);
}

static clast_status make_table(clast_table *t)
{
    clast_status status = CLAST_OK;
    double *x = NULL;
    CLX_TRY(clast_table_init(t, "history", 3));
    CLX_TRY(clast_table_add_number(t, "porosity/odd", "-", &x));
    x[0] = NAN;
    x[2] = 1.0 / 3.0;
    CLX_TRY(clast_table_add_text(t, "shape"));
    CLX_TRY(clast_table_set_text(t, 1, 1, "\xc3\xa9gg, \"quoted\"\n"));
    CLX_TRY(clast_table_add_number(t, "d_m", "m", &x));
    x[1] = 5e-324;
done:
    return status;
}

/* Everything at once, filled by the caller's parts. */
static clast_status write_all(const char *path)
{
    clast_status status = CLAST_OK;
    clast_assembly a = {0};
    clast_table t[2] = {0};
    clast_spheres fill = {0};
    char name_a[] = "core 300";
    char name_b[] = "core 50";
    char config[] = "{\"seed\": 1}";
    CLX_TRY(make_assembly(&a));
    CLX_TRY(make_table(&t[0]));
    CLX_TRY(clast_table_init(&t[1], "empty", 0));
    CLX_TRY(clast_table_add_text(&t[1], "word"));
    CLX_TRY(clast_table_add_number(&t[1], "number", "-", NULL));
    CLX_TRY(clast_spheres_alloc(300, &fill));
    for (int i = 0; i < 300; ++i) {
        fill.radius[i] = 1.0 / (1.0 + i);
        fill.centre[i][2] = -1.0 / (1.0 + i);
    }
    clast_named_spheres named[2] = {{name_a, fill}, {name_b, fill}};
    named[1].spheres.n = 50;
    const clast_state s = {.assembly = &a,
                           .n_spheres = 2,
                           .spheres = named,
                           .n_table = 2,
                           .table = t,
                           .config = config};
    CLX_TRY(clast_state_write(&s, path));
done:
    clast_assembly_free(&a);
    clast_table_free(&t[0]);
    clast_table_free(&t[1]);
    clast_spheres_free(&fill);
    return status;
}

static void whole_state_comes_back(void **state)
{
    (void)state;
    clast_state s = {0};
    clast_assembly a = {0};
    CHECK_OK(write_all(support_scratch_file("all.h5")));
    CHECK_OK(clast_state_read(support_scratch_file("all.h5"), &s));
    CHECK_OK(make_assembly(&a));
    check_same_assembly(&a, s.assembly);
    assert_string_equal(s.config, "{\"seed\": 1}");
    assert_string_equal(s.unit, "um");
    assert_string_equal(s.version, clast_version());
    assert_int_equal(s.n_spheres, 2);
    assert_string_equal(s.spheres[0].name, "core 300");
    assert_int_equal(s.spheres[1].spheres.n, 50);
    assert_true(s.spheres[0].spheres.centre[299][2] == -1.0 / 300.0);
    assert_int_equal(s.n_table, 2);
    assert_int_equal(s.table[0].n_row, 0);
    assert_non_null(s.table[0].column[0].text);
    const clast_table *t = &s.table[1];
    assert_string_equal(t->name, "history");
    assert_ptr_equal(clast_state_table(&s, "history"), t);
    assert_null(clast_state_table(&s, "History"));
    assert_string_equal(t->column[0].name, "porosity/odd");
    assert_string_equal(t->column[2].unit, "m");
    assert_true(isnan(t->column[0].number[0]) && t->column[0].number[2] == 1.0 / 3.0);
    assert_true(t->column[2].number[1] == 5e-324);
    assert_string_equal(t->column[1].text[1], "\xc3\xa9gg, \"quoted\"\n");
    assert_string_equal(t->column[1].text[2], "");
    clast_state_free(&s);
    clast_state_free(&s);
    clast_assembly_free(&a);
}

static void parts_are_read_by_name(void **state)
{
    (void)state;
    clast_spheres s = {0};
    clast_table t = {0};
    clast_assembly a = {0};
    CHECK_OK(write_all(support_scratch_file("all.h5")));
    CHECK_OK(clast_state_read_spheres(support_scratch_file("all.h5"), "core 50", &s));
    assert_int_equal(s.n, 50);
    clast_spheres_free(&s);
    CHECK_OK(clast_state_read_table(support_scratch_file("all.h5"), "history", &t));
    assert_int_equal(t.n_column, 3);
    clast_table_free(&t);
    CHECK_STATUS(clast_state_read_spheres(support_scratch_file("all.h5"), "none", &s),
                 CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "all.h5: it has no spheres called none; it has "
                                                 "core 300, core 50"));
    CHECK_STATUS(clast_state_read_spheres(support_scratch_file("all.h5"), NULL, &s),
                 CLAST_E_FORMAT);
    CHECK_OK(clast_spheres_alloc(1, &s));
    s.radius[0] = 1.0;
    CHECK_OK(clast_state_write_spheres(&s, support_scratch_file("one.h5"), "only", "mm"));
    clast_spheres_free(&s);
    CHECK_OK(clast_state_read_spheres(support_scratch_file("one.h5"), NULL, &s));
    assert_int_equal(s.n, 1);
    clast_spheres_free(&s);
    CHECK_STATUS(clast_state_read_assembly(support_scratch_file("one.h5"), &a), CLAST_E_FORMAT);
    CHECK_STATUS(clast_state_read_assembly(support_scratch_file("absent.h5"), &a), CLAST_E_IO);
}

static void names_that_cannot_be_are_refused(void **state)
{
    (void)state;
    clast_spheres s = {0};
    CHECK_OK(clast_spheres_alloc(1, &s));
    s.radius[0] = 1.0;
    static const char *const wrong[] = {"", "a/b", "."};
    for (size_t i = 0; i < 3; ++i) {
        CHECK_STATUS(clast_state_write_spheres(&s, support_scratch_file("w.h5"), wrong[i], "m"),
                     CLAST_E_USAGE);
    }
    char name[] = "twice";
    clast_named_spheres named[2] = {{name, s}, {name, s}};
    const clast_state twice = {.n_spheres = 2, .spheres = named};
    CHECK_STATUS(clast_state_write(&twice, support_scratch_file("w.h5")), CLAST_E_USAGE);
    assert_int_not_equal(access(support_scratch_file("w.h5"), F_OK), 0);
    clast_spheres_free(&s);
}

static void equal_states_give_equal_bytes(void **state)
{
    (void)state;
    CHECK_OK(write_all(support_scratch_file("first.h5")));
    (void)sleep(1);
    CHECK_OK(write_all(support_scratch_file("second.h5")));
    support_check_same_files(support_scratch_file("first.h5"), support_scratch_file("second.h5"));
}

/* A file that is whole but says what cannot be: each lie is found. */
static void inconsistent_assemblies_are_refused(void **state)
{
    (void)state;
    for (int lie = 0; lie <= 13; ++lie) {
        clast_assembly a = {0};
        clast_assembly back = {0};
        CHECK_OK(make_assembly(&a));
        switch (lie) {
        case 1:
            a.shape_id[3] = 4;
            break;
        case 2:
            a.shape_id[3] = -1;
            break;
        case 3:
            a.position[39][2] = NAN;
            break;
        case 4:
            a.orientation[5][0] += 0.1;
            break;
        case 5:
            a.scale[0] = 0.0;
            break;
        case 6:
            a.density[0] = -1.0;
            break;
        case 7:
            a.contact[7][1] = 40;
            break;
        case 8:
            a.shape[2].mesh.tri[0][1] = 8;
            break;
        case 9:
            a.shape[2].mesh.vert[0][1] = INFINITY;
            break;
        case 10:
            a.shape[3].spheres.radius[1] = 0.0;
            break;
        case 11:
            a.shape[1].semi_axes[2] = 4.0;
            break;
        case 12:
            a.shape[0].volume = NAN;
            break;
        case 13:
            a.shape[0].name[0] = '\0';
            break;
        default:
            break;
        }
        CHECK_OK(clast_state_write_assembly(&a, support_scratch_file("lie.h5"), NULL));
        CHECK_STATUS(clast_state_read_assembly(support_scratch_file("lie.h5"), &back),
                     lie == 0 ? CLAST_OK : CLAST_E_FORMAT);
        assert_true(lie == 0 || (back.shape == NULL && back.position == NULL));
        clast_assembly_free(&back);
        clast_assembly_free(&a);
    }
}

static void other_files_are_refused(void **state)
{
    (void)state;
    clx_h5 *h5 = NULL;
    clast_assembly a = {0};
    const int32_t schema = 99;
    CHECK_OK(clx_h5_create(&h5));
    CHECK_OK(clx_h5_commit(h5, support_scratch_file("bare.h5")));
    CHECK_OK(clx_h5_write_text(h5, "/", "format", "clast state"));
    CHECK_OK(clx_h5_write_number(h5, "/", "schema", CLX_H5_I32, &schema));
    CHECK_OK(clx_h5_commit(h5, support_scratch_file("later.h5")));
    clx_h5_close(h5);
    CHECK_STATUS(clast_state_read_assembly(support_scratch_file("bare.h5"), &a), CLAST_E_FORMAT);
    CHECK_STATUS(clast_state_read_assembly(support_scratch_file("later.h5"), &a), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "schema 99"));
}

/* Tables whose texts lie outside, and counts that lie. */
static void inconsistent_tables_are_refused(void **state)
{
    (void)state;
    for (int lie = 0; lie <= 4; ++lie) {
        clx_h5 *h5 = NULL;
        clast_table t = {0};
        const int32_t n_column = lie == 1 ? 3 : 1;
        const int64_t n_row = lie == 2 ? 3 : 2;
        const int64_t begin[3] = {0, lie == 3 ? 9 : 1, lie == 4 ? 3 : 2};
        CHECK_OK(clx_h5_create(&h5));
        CHECK_OK(clx_state_write_head(h5, "m"));
        CHECK_OK(clx_h5_write_folder(h5, "/table/t"));
        CHECK_OK(clx_h5_write_text(h5, "/table/t", "name", "t"));
        CHECK_OK(clx_h5_write_number(h5, "/table/t", "n_column", CLX_H5_I32, &n_column));
        CHECK_OK(clx_h5_write_number(h5, "/table/t", "n_row", CLX_H5_I64, &n_row));
        CHECK_OK(clx_h5_write(h5, "/table/t/000000", CLX_H5_U8, 1, (int64_t[]){2}, "ab"));
        CHECK_OK(clx_h5_write(h5, "/table/t/000000_begin", CLX_H5_I64, 1, (int64_t[]){3}, begin));
        CHECK_OK(clx_h5_write_text(h5, "/table/t/000000", "name", "word"));
        CHECK_OK(clx_h5_write_text(h5, "/table/t/000000", "unit", ""));
        CHECK_OK(clx_h5_commit(h5, support_scratch_file("table.h5")));
        clx_h5_close(h5);
        CHECK_STATUS(clast_state_read_table(support_scratch_file("table.h5"), "t", &t),
                     lie == 0 ? CLAST_OK : CLAST_E_FORMAT);
        clast_table_free(&t);
    }
}

/* A file of clast 0.1.0 with HDF5 1.10.8, kept: later programs read it still. */
static void kept_file_of_schema_1_still_reads(void **state)
{
    (void)state;
    clast_state kept = {0};
    clast_state now = {0};
    CHECK_OK(support_state(&now));
    CHECK_OK(clast_state_read(support_data("state/schema1.h5"), &kept));
    check_same_assembly(kept.assembly, now.assembly);
    assert_string_equal(kept.config, now.config);
    assert_string_equal(kept.version, "0.1.0");
    assert_int_equal(kept.n_spheres, 1);
    assert_string_equal(kept.spheres[0].name, "fill");
    assert_memory_equal(kept.spheres[0].spheres.radius, now.spheres[0].spheres.radius,
                        2 * sizeof(double));
    assert_int_equal(kept.n_table, 1);
    assert_true(kept.table[0].column[0].number[2] == 0.5);
    assert_string_equal(kept.table[0].column[1].text[2], "box, turned");
    clast_state_free(&kept);
    clast_state_free(&now);
}

static clast_status write_and_read(void *context)
{
    clast_state s = {0};
    clast_status status = write_all(context);
    if (status == CLAST_OK) {
        status = clast_state_read(context, &s);
    }
    clast_state_free(&s);
    return status;
}

static void states_survive_refused_memory(void **state)
{
    (void)state;
    support_refuse_each_allocation_at(write_and_read, "memory.h5");
}

static void full_disk_keeps_the_old_state(void **state)
{
    (void)state;
#ifdef CLAST_ALLOC_INJECT
    clast_assembly none = {0};
    clast_assembly back = {0};
    CHECK_OK(clast_state_write_assembly(&none, support_scratch_file("full.h5"), NULL));
    for (int k = 1; k <= 4; ++k) {
        (void)clx_file_refuse(k, ENOSPC);
        const clast_status status = write_all(support_scratch_file("full.h5"));
        (void)clx_file_refuse(0, 0);
        assert_int_equal(status, CLAST_E_DISK);
        CHECK_OK(clast_state_read_assembly(support_scratch_file("full.h5"), &back));
        assert_int_equal(back.n_grain, 0);
        clast_assembly_free(&back);
    }
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(assembly_comes_back_bit_for_bit),
        cmocka_unit_test(whole_state_comes_back),
        cmocka_unit_test(parts_are_read_by_name),
        cmocka_unit_test(names_that_cannot_be_are_refused),
        cmocka_unit_test(equal_states_give_equal_bytes),
        cmocka_unit_test(inconsistent_assemblies_are_refused),
        cmocka_unit_test(other_files_are_refused),
        cmocka_unit_test(inconsistent_tables_are_refused),
        cmocka_unit_test(kept_file_of_schema_1_still_reads),
        cmocka_unit_test(states_survive_refused_memory),
        cmocka_unit_test(full_disk_keeps_the_old_state),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
