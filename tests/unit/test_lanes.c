/* Unit: four contacts side by side give the bits of one by one. */
#include "support.h"

#include "convex/ellipsoid_lanes.h"
#include "convex/facet.h"
#include "convex/facet_lanes.h"
#include "dem/batch.h"
#include "dem_scenes.h"
#include "gravel.h"
#include "math/vec3.h"
#include <string.h>

/* A pair of hulls in touch, its warm start made at one place and used a little beside it. */
typedef struct {
    clx_convex a, b;
    double rotation[2][3][3];
    clx_pair pair;
    clx_warm_start warm_start;
} meeting;

static clx_hull_core *cores[3];

static int make_cores(void **state)
{
    (void)state;
    cores[0] = support_gravel_core(1, 0, 152);
    cores[1] = support_gravel_core(1, 1, 27);
    cores[2] = support_box_core(1.0, 0.8, 0.6);
    return 0;
}

static int free_cores(void **state)
{
    (void)state;
    for (int i = 0; i < 3; ++i) {
        clx_hull_core_destroy(cores[i]);
    }
    return 0;
}

static void make_meeting(clx_rng *rng, meeting *m)
{
    clx_contact c;
    double q[4], side[3];
    memset(m, 0, sizeof *m);
    m->a = clx_convex_hull(cores[clx_rng_below(rng, 3)], 1.0);
    m->b = clx_convex_hull(cores[clx_rng_below(rng, 3)], 0.7 + clx_rng_uniform(rng));
    m->pair = (clx_pair){&m->a, &m->b, m->rotation[0][0], m->rotation[1][0], {0.0, 0.0, 0.0}};
    for (int k = 0; k < 2; ++k) {
        clx_rng_orientation(rng, q);
        q_matrix(m->rotation[k], q);
    }
    clx_rng_direction(rng, m->pair.offset);
    (void)clx_pair_contact(&m->pair, INFINITY, &m->warm_start, &c);
    v3_axpy(m->pair.offset, m->pair.offset, c.gap + 1e-4, c.normal); /* overlap 1e-4 */
    (void)clx_pair_contact(&m->pair, INFINITY, &m->warm_start, &c);
    clx_rng_direction(rng, side);
    v3_axpy(m->pair.offset, m->pair.offset, pow(10.0, -1.0 - 5.0 * clx_rng_uniform(rng)), side);
}

static bool same(double a, double b)
{
    return a == b && !signbit(a) == !signbit(b);
}

static clast_dem *make_space(void)
{
    clast_dem *dem = NULL;
    const clast_dem_config config = scene_space();
    CHECK_OK(clast_dem_create(&config, &dem));
    return dem;
}

/* Compares the first n of these pairs side by side with them one by one: four go through lanes of
   four, eight through lanes of eight where the machine has them. How many are answered. */
static int compare_facets(const clast_dem *dem, meeting m[CLX_BATCH], bool edges, int n_pair)
{
    clx_grain grain[2 * CLX_BATCH] = {0};
    clx_dem_pair pair[CLX_BATCH] = {0};
    clx_batch p = {.n = n_pair};
    int n = 0;
    for (int k = 0; k < n_pair; ++k) {
        p.pair[k] = &pair[k];
        p.a[k] = &grain[2 * k];
        p.b[k] = &grain[2 * k + 1];
        v3_copy(grain[2 * k + 1].position, m[k].pair.offset);
        p.meet.rotation_a[k] = m[k].pair.rotation_a;
        p.meet.rotation_b[k] = m[k].pair.rotation_b;
        p.meet.warm_start[k] = &m[k].warm_start;
    }
    const int answered = edges ? clx_batch_edges(dem, &p) : clx_batch_faces(dem, &p);
    const clx_pair_batch *batch = &p.meet;
    for (int k = 0; k < n_pair; ++k) {
        clx_contact one;
        const bool is_answered = clx_facet_again(&m[k].pair, &m[k].warm_start, &one);
        assert_int_equal(is_answered, answered >> k & 1);
        if (is_answered) {
            assert_true(same(one.gap, batch->gap[k]));
            for (int c = 0; c < 3; ++c) {
                assert_true(same(one.normal[c], batch->normal[c][k]));
                assert_true(same(one.point[c], batch->point[c][k]));
            }
            ++n;
        }
    }
    return n;
}

static void facets_in_lanes_are_facets_alone(void **state)
{
    (void)state;
    meeting queue[2][CLX_BATCH];
    clast_dem *dem = make_space();
    int filled[2] = {0, 0};
    int n_answered[2] = {0, 0};
    int n_asked[2] = {0, 0};
    for (uint64_t i = 0; i < 1600; ++i) {
        clx_rng rng = clx_rng_at(40, CLX_STREAM_TEST, i);
        meeting m;
        make_meeting(&rng, &m);
        if (m.warm_start.kind == CLX_FACET_NONE) {
            continue;
        }
        const int kind = m.warm_start.kind == CLX_FACET_EDGE_EDGE ? 1 : 0;
        meeting *to = &queue[kind][filled[kind]++];
        *to = m;
        to->pair.a = &to->a;
        to->pair.b = &to->b;
        to->pair.rotation_a = to->rotation[0][0];
        to->pair.rotation_b = to->rotation[1][0];
        if (filled[kind] == CLX_BATCH) {
            n_answered[kind] += compare_facets(dem, queue[kind], kind == 1, CLX_BATCH);
            n_asked[kind] += CLX_BATCH;
            (void)compare_facets(dem, queue[kind], kind == 1, CLX_LANES);
            filled[kind] = 0;
        }
    }
    clast_dem_destroy(dem);
    for (int kind = 0; kind < 2; ++kind) { /* both answers occur, often */
        assert_true(n_answered[kind] > 50);
        assert_true(n_asked[kind] - n_answered[kind] > 50);
    }
}

/* A pair of eggs whose normal is known from a place nearby, now apart, in touch or deep. */
static void make_eggs(clx_rng *rng, meeting *m)
{
    clx_contact c;
    double q[4], side[3], axes[2][3];
    memset(m, 0, sizeof *m);
    for (int k = 0; k < 2; ++k) {
        v3_set(axes[k], 1.0, 0.4 + 0.6 * clx_rng_uniform(rng), 0.3 + 0.7 * clx_rng_uniform(rng));
        clx_rng_orientation(rng, q);
        q_matrix(m->rotation[k], q);
    }
    m->a = clx_convex_ellipsoid(axes[0]);
    m->b = clx_convex_ellipsoid(axes[1]);
    m->pair = (clx_pair){&m->a, &m->b, m->rotation[0][0], m->rotation[1][0], {0.0, 0.0, 0.0}};
    clx_rng_direction(rng, m->pair.offset);
    v3_scale(m->pair.offset, 2.5, m->pair.offset);
    (void)clx_pair_contact(&m->pair, INFINITY, &m->warm_start, &c);
    const double depth = clx_rng_below(rng, 5) == 0 ? 0.7 : 1e-4 * clx_rng_normal(rng);
    v3_axpy(m->pair.offset, m->pair.offset, c.gap + depth, c.normal);
    (void)clx_pair_contact(&m->pair, INFINITY, &m->warm_start, &c);
    clx_rng_direction(rng, side);
    v3_axpy(m->pair.offset, m->pair.offset, pow(10.0, -3.0 - 4.0 * clx_rng_uniform(rng)), side);
}

static void ellipsoids_in_lanes_are_ellipsoids_alone(void **state)
{
    (void)state;
    int n_answered = 0;
    int n_left = 0;
    for (uint64_t i = 0; i < 500; ++i) {
        clx_rng rng = clx_rng_at(43, CLX_STREAM_TEST, i);
        meeting m[CLX_LANES];
        clx_pair_batch batch;
        const clx_convex *a[CLX_LANES];
        const clx_convex *b[CLX_LANES];
        for (int k = 0; k < CLX_LANES; ++k) {
            make_eggs(&rng, &m[k]);
            a[k] = &m[k].a;
            b[k] = &m[k].b;
            batch.rotation_a[k] = m[k].rotation[0][0];
            batch.rotation_b[k] = m[k].rotation[1][0];
            batch.warm_start[k] = &m[k].warm_start;
            for (int c = 0; c < 3; ++c) {
                batch.offset[c][k] = m[k].pair.offset[c];
            }
        }
        const int answered = clx_ellipsoids_again(&batch, 0, a, b);
        for (int k = 0; k < CLX_LANES; ++k) {
            clx_contact one;
            (void)clx_pair_contact(&m[k].pair, INFINITY, &m[k].warm_start, &one);
            if ((answered >> k & 1) == 0) {
                ++n_left;
                continue;
            }
            ++n_answered;
            assert_true(same(one.gap, batch.gap[k]));
            for (int c = 0; c < 3; ++c) {
                assert_true(same(one.normal[c], batch.normal[c][k]));
                assert_true(same(one.point[c], batch.point[c][k]));
                assert_true((float)batch.normal[c][k] == m[k].warm_start.seen[0][c]);
            }
        }
    }
    assert_true(n_answered > 200);
    assert_true(n_left > 200);
}

static void fill3(clx_rng *rng, double size, double x[3])
{
    for (int c = 0; c < 3; ++c) {
        x[c] = size * clx_rng_normal(rng);
    }
}

static clx_grain random_grain(clx_rng *rng)
{
    clx_grain g = {.mass = 1e-4 * (1.0 + clx_rng_uniform(rng)), .radius = 4e-3};
    fill3(rng, 0.1, g.velocity);
    fill3(rng, 10.0, g.omega);
    g.round_radius = 3.5e-3 * (1.0 + clx_rng_uniform(rng));
    g.shape = (int32_t)clx_rng_below(rng, 2);
    g.held = 12.0 * clx_rng_uniform(rng);
    return g;
}

/* A law that lanes have, and the contacts that it is tried on. */
typedef struct {
    clast_dem_law law;
    clast_dem_scheme scheme;
    bool has_walls, by_materials;
    double rolling_friction;
    clast_dem_cohesion cohesion;
} law_in_lanes;

/* The law between the materials of two grains. */
static const clx_law *law_between(const clast_dem *dem, const clx_grain *a, const clx_grain *b)
{
    const clx_laws *laws = &dem->laws;
    return laws->n == 0
               ? &dem->law
               : &laws->law[dem->body[a->shape].material * laws->n + dem->body[b->shape].material];
}

/* The scalar law for lane k of a batch. */
static void force_of_pair(const clast_dem *dem, const clx_batch *p, int k, double slide[3],
                          clx_pair_force *out)
{
    const clx_grain *a = p->a[k];
    const clx_grain *b = p->b[k];
    const clx_law *law = law_between(dem, a, b);
    double n[3], arm_a[3], arm_b[3], u[3], w[3];
    clx_contact_force force;
    for (int c = 0; c < 3; ++c) {
        n[c] = -p->meet.normal[c][k];
        arm_a[c] = p->meet.point[c][k];
        arm_b[c] = p->arm_b[c][k];
    }
    clx_meeting m = {.overlap = -p->meet.gap[k],
                     .mass = p->pair[k]->b < 0 ? a->mass : a->mass * b->mass / (a->mass + b->mass),
                     .radius =
                         a->round_radius * b->round_radius / (a->round_radius + b->round_radius),
                     .friction = law->friction[p->pair[k]->b < 0]};
    v3_copy(m.normal, n);
    v3_cross(u, a->omega, arm_a);
    v3_add(u, u, a->velocity);
    v3_cross(w, b->omega, arm_b);
    v3_add(w, w, b->velocity);
    v3_sub(m.velocity, w, u);
    m.twirl = 0.5 * (v3_dot(a->omega, n) + v3_dot(b->omega, n));
    if (law->is_exact) {
        double load[2];
        clx_dem_touch t;
        v3_copy(t.normal, n);
        v3_copy(t.arm_a, arm_a);
        v3_copy(t.arm_b, arm_b);
        clx_hold_pair(law, a, b, &t, &m, load);
        out->torque_b[3] = load[1];
        out->torque_a[3] = -load[0];
    }
    clx_law_force(law, &m, dem->config.time_step, slide, &force);
    v3_set(force.rolling, 0.0, 0.0, 0.0);
    if (law->rolling > 0.0) {
        v3_sub(m.roll, b->omega, a->omega);
        clx_law_roll(law, &m, clx_reduced_inertia(a, b), dem->config.time_step, &force);
    }
    v3_axpy(out->force, force.tangential, force.normal, n);
    v3_cross(out->torque_b, arm_b, out->force);
    v3_cross(out->torque_a, arm_a, out->force);
    v3_add(out->torque_b, out->torque_b, force.rolling);
    v3_add(out->torque_a, out->torque_a, force.rolling);
}

/* Lane k has the bits of the scalar law; a pair that is apart waits for the path of its gap. */
static void check_lane(const clx_batch *p, int k, const double slide[3],
                       const clx_pair_force *alone)
{
    const clx_dem_pair *pair = p->pair[k];
    const bool is_apart = p->meet.gap[k] >= 0.0;
    assert_int_equal(pair->touches, is_apart ? 0 : 1);
    assert_true(pair->active_from == (is_apart ? p->travel[k] + p->meet.gap[k] : 0.0));
    for (int c = 0; c < 3; ++c) {
        assert_true(p->to[k]->force[c] == alone->force[c]);
        assert_true(p->to[k]->torque_a[c] == alone->torque_a[c]);
        assert_true(p->to[k]->torque_b[c] == alone->torque_b[c]);
        assert_true(same(pair->slide[c], is_apart ? 0.0 : slide[c]));
    }
    assert_true(p->to[k]->torque_a[3] == alone->torque_a[3]);
    assert_true(p->to[k]->torque_b[3] == alone->torque_b[3]);
}

/* Contact k of a batch: two grains, or one at a wall, in touch or just apart. */
static bool make_touch(clx_rng *rng, bool has_walls, clx_batch *p, int k, clx_grain grain[2],
                       clx_dem_pair *pair)
{
    double n[3];
    grain[0] = random_grain(rng);
    grain[1] = random_grain(rng);
    *pair = (clx_dem_pair){.b = has_walls && clx_rng_below(rng, 4) == 0 ? -1 : 1};
    clx_rng_direction(rng, n);
    fill3(rng, clx_rng_below(rng, 3) == 0 ? 0.0 : 1e-7, pair->slide);
    const bool is_apart = clx_rng_below(rng, 5) == 0;
    pair->touches = is_apart ? 1 : 0; /* as it was in the step before */
    p->pair[k] = pair;
    p->a[k] = &grain[0];
    p->b[k] = pair->b < 0 ? &clx_immovable : &grain[1];
    p->meet.gap[k] = (is_apart ? 1e-6 : -1e-6) * clx_rng_uniform(rng);
    p->travel[k] = clx_rng_uniform(rng);
    for (int c = 0; c < 3; ++c) {
        p->meet.normal[c][k] = -n[c];
        p->meet.point[c][k] = 4e-3 * n[c] + 1e-4 * clx_rng_normal(rng);
        p->arm_b[c][k] = pair->b < 0 ? 0.0 : -4e-3 * n[c] + 1e-4 * clx_rng_normal(rng);
    }
    return is_apart;
}

/* Two shapes of different materials; each pair of materials has friction, restitution, moduli and
 * T_c of its own. */
static void make_materials(clast_dem *dem)
{
    clast_shape shape = {0};
    clast_dem_contact contact[4];
    for (int k = 0; k < 4; ++k) {
        const int unlike = k / 2 + k % 2;
        contact[k] = clast_dem_contact_of(&dem->config, false);
        contact[k].friction = 0.1 + 0.2 * unlike;
        contact[k].restitution = 0.2 + 0.1 * unlike;
        contact[k].collision_time *= 1.0 + 0.1 * unlike;
        contact[k].young[0] *= 1.0 + unlike;
    }
    CHECK_OK(clast_dem_set_contacts(dem, 2, contact));
    for (int32_t k = 0, id = 0; k < 2; ++k) {
        CHECK_OK(clast_shape_sphere(k == 0 ? "first" : "second", 3e-3, &shape));
        CHECK_OK(clast_dem_add_shape(dem, &shape, &id));
        CHECK_OK(clast_dem_set_material(dem, id, k));
        clast_shape_free(&shape);
    }
}

static void check_law_in_lanes(const law_in_lanes *c)
{
    clast_dem *dem = NULL;
    clast_dem_config config;
    clx_pair_force written[CLX_BATCH] = {0};
    CHECK_OK(clast_fields_default(clast_dem_fields, &config));
    config.wall_friction = 0.2;
    config.law = (int32_t)c->law;
    config.contact_scheme = (int32_t)c->scheme;
    config.time_step *= c->scheme == CLAST_DEM_EXACT ? 2.0 : 1.0;
    config.rolling_friction = c->rolling_friction;
    config.cohesion = (int32_t)c->cohesion;
    config.cohesion_energy = c->cohesion == CLAST_DEM_AREA ? 1e4 : 0.0;
    config.surface_energy = c->cohesion > CLAST_DEM_AREA ? 0.05 : 0.0;
    CHECK_OK(clast_dem_create(&config, &dem));
    if (c->by_materials) {
        make_materials(dem);
    }
    const clx_batch_kind kind = c->has_walls ? CLX_BATCH_ANY : CLX_BATCH_SPHERES;
    assert_true(clx_batch_has_law(dem, kind));
    for (uint64_t i = 0; i < 500; ++i) {
        clx_rng rng = clx_rng_at(41, CLX_STREAM_TEST, i);
        clx_grain grain[2 * CLX_BATCH];
        clx_dem_pair pair[CLX_BATCH];
        const int n_pair = i % 2 == 0 ? CLX_BATCH : CLX_LANES; /* both widths */
        clx_batch p = {.n = n_pair};
        clx_pair_force alone[CLX_BATCH] = {0};
        double slide[CLX_BATCH][3];
        for (int k = 0; k < n_pair; ++k) {
            const bool is_apart = make_touch(&rng, c->has_walls, &p, k, &grain[2 * k], &pair[k]);
            p.to[k] = &written[k];
            v3_copy(slide[k], pair[k].slide);
            if (!is_apart) {
                force_of_pair(dem, &p, k, slide[k], &alone[k]);
            }
        }
        clx_batch_force(dem, &p, kind);
        for (int k = 0; k < n_pair; ++k) {
            check_lane(&p, k, slide[k], &alone[k]);
        }
    }
    clast_dem_destroy(dem);
}

static void law_in_lanes_is_the_law_alone(void **state)
{
    (void)state;
    const law_in_lanes laws[] = {
        {CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, true, false, 0.0, CLAST_DEM_DRY},
        {CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, false, false, 0.0, CLAST_DEM_DRY},
        {CLAST_DEM_LINEAR, CLAST_DEM_EXACT, true, false, 0.0, CLAST_DEM_DRY},
        {CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, false, true, 0.0, CLAST_DEM_DRY},
        {CLAST_DEM_HERTZ, CLAST_DEM_EXPLICIT, false, false, 0.0, CLAST_DEM_DRY},
        {CLAST_DEM_HERTZ, CLAST_DEM_EXPLICIT, false, true, 0.0, CLAST_DEM_DRY},
        {CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, false, false, 0.1, CLAST_DEM_DRY},
        {CLAST_DEM_LINEAR, CLAST_DEM_EXACT, false, false, 0.1, CLAST_DEM_DRY},
        {CLAST_DEM_HERTZ, CLAST_DEM_EXPLICIT, false, false, 1e-3, CLAST_DEM_AREA},
        {CLAST_DEM_HERTZ, CLAST_DEM_EXPLICIT, false, false, 0.0, CLAST_DEM_DMT},
        {CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, false, false, 0.1, CLAST_DEM_JKR},
    };
    for (size_t i = 0; i < sizeof laws / sizeof *laws; ++i) {
        check_law_in_lanes(&laws[i]);
    }
}

/* Where grains 0 .. n - 1 of these are after a while, alone or together; they never meet. */
static void fly(const clast_shape *shape, int32_t n, const clast_dem_grain *grain,
                clast_dem_grain *out)
{
    clast_dem_config config = scene_space();
    clast_dem *dem = NULL;
    int32_t id = 0;
    config.gravity = 9.81;
    CHECK_OK(clast_dem_create(&config, &dem));
    CHECK_OK(clast_dem_add_shape(dem, shape, &id));
    CHECK_OK(clast_dem_add_grains(dem, n, grain));
    clast_dem_set_drive(dem, &(clast_dem_drive){3e-4, 0.025, 0.5});
    CHECK_OK(clast_dem_step(dem, 300));
    for (int32_t i = 0; i < n; ++i) {
        clast_dem_read_grain(dem, i, &out[i]);
    }
    clast_dem_destroy(dem);
}

static void fly_both_ways(const clast_shape *shape, double spin)
{
    clast_dem_grain grain[CLX_LANES], together[CLX_LANES], alone;
    for (int i = 0; i < CLX_LANES; ++i) {
        clx_rng rng = clx_rng_at(42, CLX_STREAM_TEST, (uint64_t)i);
        grain[i] = (clast_dem_grain){.scale = 1.0 + 0.2 * i, .density = 2650.0};
        clx_rng_orientation(&rng, grain[i].orientation);
        fill3(&rng, 0.1, grain[i].velocity);
        fill3(&rng, spin, grain[i].angular_velocity);
        v3_set(grain[i].position, 0.1 * i, 0.3, 0.5);
    }
    fly(shape, CLX_LANES, grain, together); /* in lanes */
    for (int i = 0; i < CLX_LANES; ++i) {
        fly(shape, 1, &grain[i], &alone); /* fewer than four: one by one */
        for (int c = 0; c < 3; ++c) {
            assert_true(same(alone.position[c], together[i].position[c]));
            assert_true(same(alone.velocity[c], together[i].velocity[c]));
            assert_true(same(alone.angular_velocity[c], together[i].angular_velocity[c]));
        }
        for (int c = 0; c < 4; ++c) {
            assert_true(same(alone.orientation[c], together[i].orientation[c]));
        }
    }
}

static void grains_in_lanes_move_as_alone(void **state)
{
    (void)state;
    clast_shape shape = {0};
    CHECK_OK(clast_shape_ellipsoid("egg", (const double[3]){4e-3, 3e-3, 2e-3}, &shape));
    fly_both_ways(&shape, 3e3);
    fly_both_ways(&shape, 3e4); /* some turn too fast for the series: all four go one by one */
    clast_shape_free(&shape);
    CHECK_OK(clast_shape_sphere("ball", 3e-3, &shape));
    fly_both_ways(&shape, 3e3);
    clast_shape_free(&shape);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(facets_in_lanes_are_facets_alone, make_cores, free_cores),
        cmocka_unit_test(ellipsoids_in_lanes_are_ellipsoids_alone),
        cmocka_unit_test(law_in_lanes_is_the_law_alone),
        cmocka_unit_test(grains_in_lanes_move_as_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
