/* Property: scouting rays saves trials, never changes which one wins. */
#include "aggregates.h"
#include "mesh_maker.h"

#include "aggregate/trial.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <string.h>

static const double axes[2][3] = {{1.0, 0.7, 0.3}, {1.0, 0.6, 0.5}};

/* The second coating shape becomes a scanned surface. */
static void use_scan(support_aggregate *s)
{
    clast_mesh mesh = {0};
    clast_shape shape = {0};
    const double none[3] = {0.0, 0.0, 0.0};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    assert_true(mesh_read_data("scarlet/stl/27sk21_shape_fine.stl", &mesh));
    CHECK_OK(clast_shape_mesh("scan", &mesh, &shape));
    clast_assembly_free(&s->coat[1]);
    CHECK_OK(clast_assembly_add_shape(&s->coat[1], &shape, NULL));
    CHECK_OK(clast_assembly_add_grain(&s->coat[1], 0, none, unturned, 1.0, 2500.0));
    clast_shape_free(&shape);
    clast_mesh_free(&mesh);
}

static void insert(const clx_search *s, const double centre[3], const double orientation[4],
                   clx_touch_scene *scene)
{
    clx_template_part placed;
    clx_template_pose(s->group, 0, centre, orientation, s->scale, &placed);
    clx_touch_body body = s->templates->shape[placed.shape].body;
    clx_touch_body_place(&body, placed.position, placed.orientation, placed.scale);
    CHECK_OK(clx_touch_scene_insert(scene, &body));
}

static void same_landing(const clx_placement *a, const clx_placement *b)
{
    assert_int_equal(a->found, b->found);
    assert_int_equal(a->trial, b->trial);
    assert_memory_equal(a->centre, b->centre, sizeof a->centre);
    assert_memory_equal(a->orientation, b->orientation, sizeof a->orientation);
    assert_int_equal(a->touch.body, b->touch.body);
}

/* Grows an aggregate twice over: each particle is searched with and without a scout. */
static void grow_both_ways(int32_t contact, double start)
{
    support_aggregate s;
    clx_templates templates = {0};
    clx_touch_scene *scene = NULL;
    const double none[3] = {0.0, 0.0, 0.0};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    support_aggregate_make(&s, axes, 2, "size=1");
    s.config.params.contact = contact;
    if (contact == CLAST_CONTACT_EXACT) {
        use_scan(&s);
    }
    CHECK_OK(clx_templates_make(&s.config.params, &s.input, &templates));
    CHECK_OK(clx_touch_scene_create(&scene));
    for (int32_t i = 0; i < 40; ++i) {
        clx_placement plain;
        clx_placement scouted;
        clx_template group = templates.group[1 + i % 2];
        clx_search search = {.templates = &templates,
                             .group = &group,
                             .scene = scene,
                             .n_body = clx_touch_scene_count(scene),
                             .start = start,
                             .n_orientation = 1 + i % 5};
        clx_rng rng = clx_rng_at(5, CLX_STREAM_TEST, (uint64_t)i);
        search.scale = (0.3 + clx_rng_uniform(&rng)) / group.length;
        search.size = search.scale * group.length;
        search.aim = (clx_aim){.seed = 7,
                               .particle = i,
                               .n_ray = 2 + i % 20,
                               .random_axis = true,
                               .cone = 0.2 * (1 + i % 12)};
        if (i == 0) {
            insert(&search, none, unturned, scene);
            continue;
        }
        assert_true(group.inner > 0.0 && group.inner < 0.5 * group.length);
        CHECK_OK(clx_search_run(&search, &scouted));
        group.inner = 0.0;
        CHECK_OK(clx_search_run(&search, &plain));
        same_landing(&plain, &scouted);
        if (plain.found) {
            insert(&search, plain.centre, plain.orientation, scene);
        }
    }
    clx_touch_scene_destroy(scene);
    clx_templates_free(&templates);
    support_aggregate_free(&s);
}

static void a_scout_changes_no_landing(void **state)
{
    (void)state;
    grow_both_ways(CLAST_CONTACT_EXACT, 0.0);
    grow_both_ways(CLAST_CONTACT_EXACT, 0.3);
    grow_both_ways(CLAST_CONTACT_SPHERES, 0.0);
}

/* The inner ball of an ellipsoid has its least semi-axis; the scan's stays within the scan. */
static void the_inner_ball_lies_within(void **state)
{
    (void)state;
    support_aggregate s;
    clx_templates templates = {0};
    support_aggregate_make(&s, axes, 2, "size=1");
    use_scan(&s);
    CHECK_OK(clx_templates_make(&s.config.params, &s.input, &templates));
    CHECK_REL(templates.group[1].inner, 0.15, 1e-8);
    const clx_template *scan = &templates.group[2];
    const clast_mesh *mesh = &s.coat[1].shape[0].mesh;
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        assert_true(v3_norm(mesh->vert[v]) >= scan->inner);
    }
    assert_true(4.0 / 3.0 * CLAST_PI * pow(scan->inner, 3) > 0.05 * scan->volume);
    clx_templates_free(&templates);
    support_aggregate_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scout_changes_no_landing),
        cmocka_unit_test(the_inner_ball_lies_within),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
