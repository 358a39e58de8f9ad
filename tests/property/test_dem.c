/* Property: beds of many spheres: lists miss nothing, threads and skins change no bit, energy never
 * rises by itself. */
#include "support.h"

#include "dem/dem.h"
#include "dem_scenes.h"
#include "math/rng.h"
#include <clast/dem.h>
#include <clast/machine.h>
#include <stdlib.h>

/// Where the grains of a simulation are.
static clast_assembly look(const clast_dem *dem)
{
    clast_assembly a = {0};
    CHECK_OK(clast_dem_assembly(dem, &a));
    return a;
}

static bool has_contact(const clast_assembly *a, int32_t i, int32_t j)
{
    for (int32_t k = 0; k < a->n_contact; ++k) {
        if (a->contact[k][0] == i && a->contact[k][1] == j) {
            return true;
        }
    }
    return false;
}

/* A step's contacts are those of the positions it began with: all pairs of these, each asked, must
 * be the pairs that the lists found, but for pairs within rounding (1e-12 m) of touching and those
 * that have parted by the step's end, which the assembly leaves out. Returns how many touch. */
static int32_t check_contacts(clast_dem *dem)
{
    int32_t n = 0;
    clast_assembly before = look(dem);
    CHECK_OK(clast_dem_step(dem, 1));
    clast_assembly after = look(dem);
    for (int32_t i = 0; i < before.n_grain; ++i) {
        for (int32_t j = i + 1; j < before.n_grain; ++j) {
            const double reach = 0.5 * (before.scale[i] + before.scale[j]);
            double d2[2] = {0.0, 0.0};
            for (int k = 0; k < 3; ++k) {
                const double d = before.position[j][k] - before.position[i][k];
                const double e = after.position[j][k] - after.position[i][k];
                d2[0] += d * d;
                d2[1] += e * e;
            }
            const bool touched = sqrt(d2[0]) < reach - 1e-12;
            const bool touches = sqrt(d2[1]) < reach - 1e-12;
            if (touched && touches) {
                assert_true(has_contact(&after, i, j));
                ++n;
            } else if (sqrt(d2[0]) > reach + 1e-12) {
                assert_false(has_contact(&after, i, j));
            }
        }
    }
    clast_assembly_free(&before);
    clast_assembly_free(&after);
    return n;
}

/* Grains start at most 1.05 diameters of the largest apart and fall at about 1 m/s: after 13 ms the
 * lowest layer stands and the next is on it, so from the third look (25 ms) there are touches. */
static void lists_miss_no_contact(void **state)
{
    (void)state;
    clast_dem *dem = scene_pour(120, 3e-3, 8e-3, 0.045);
    assert_non_null(dem);
    for (int k = 0; k < 8; ++k) {
        CHECK_OK(clast_dem_step(dem, 1600));
        const int32_t n = check_contacts(dem);
        assert_true(k < 2 || n > 0);
    }
    clast_dem_destroy(dem);
}

static uint64_t hash_after(int32_t threads, double skin, int32_t n, bool rolling)
{
    clast_parallel_set_threads(threads);
    clast_dem_config c = scene_physics();
    c.skin = skin;
    c.width = n > 1000 ? 0.12 : 0.06;
    c.rolling_friction = rolling ? 0.1 : 0.0;
    clast_dem *dem = scene_pour_with(&c, n, 4e-3, 8e-3);
    assert_non_null(dem);
    CHECK_OK(clast_dem_step(dem, n > 1000 ? 300 : 800));
    const uint64_t hash = clast_dem_hash(dem);
    clast_dem_measures m;
    clast_dem_measure(dem, &m);
    assert_true(m.n_contact + m.n_wall_contact > 0);
    clast_dem_destroy(dem);
    clast_parallel_set_threads(1);
    return hash;
}

static void skins_change_no_bit(void **state)
{
    (void)state;
    for (int rolling = 0; rolling < 2; ++rolling) {
        const uint64_t one = hash_after(1, 0.1, 140, rolling == 1);
        assert_true(hash_after(1, 0.4, 140, rolling == 1) == one);
        assert_true(hash_after(1, 0.03, 140, rolling == 1) == one);
    }
}

/* So many that threads are used at all. */
static void threads_change_no_bit(void **state)
{
    (void)state;
    const uint64_t one = hash_after(1, 0.1, 1600, true);
    assert_true(hash_after(2, 0.1, 1600, true) == one);
    assert_true(hash_after(4, 0.1, 1600, true) == one);
}

static uint64_t hull_hash_after(int32_t threads)
{
    clast_parallel_set_threads(threads);
    clast_dem *dem = NULL;
    clast_dem_measures m;
    CHECK_OK(clast_dem_scene_p1(&(clast_scene_bed){1600, 27, 0.14, 1.0}, &dem));
    CHECK_OK(clast_dem_step(dem, 200));
    clast_dem_measure(dem, &m);
    assert_true(m.n_contact + m.n_wall_contact > 0);
    const uint64_t hash = clast_dem_hash(dem);
    clast_dem_destroy(dem);
    clast_parallel_set_threads(1);
    return hash;
}

static void threads_change_no_bit_of_hulls(void **state)
{
    (void)state;
    const uint64_t one = hull_hash_after(1);
    assert_true(hull_hash_after(2) == one);
    assert_true(hull_hash_after(4) == one);
}

/* Without a drive the sum of kinetic, potential and elastic energy only falls; the scheme's own
 * wobble is of the order w dt = pi / 40 of what the springs hold. */
static void energy_never_rises_by_itself(void **state)
{
    (void)state;
    clast_dem *dem = scene_pour(80, 5.6e-3, 8e-3, 0.06);
    assert_non_null(dem);
    clast_dem_measures m;
    clast_dem_measure(dem, &m);
    double last = m.kinetic_energy + m.potential_energy;
    const double first = last;
    for (int k = 0; k < 40; ++k) {
        CHECK_OK(clast_dem_step(dem, 200));
        clast_dem_measure(dem, &m);
        const double now = m.kinetic_energy + m.potential_energy + m.elastic_energy;
        assert_true(now <= last + 0.1 * m.elastic_energy + 1e-6 * first);
        last = now;
    }
    assert_true(last < 0.9 * first);
    clast_dem_destroy(dem);
}

/* A pair that meets through the border of the period moves as one that meets in the middle. */
static void period_has_no_border(void **state)
{
    (void)state;
    double x[2][2];
    for (int shifted = 0; shifted < 2; ++shifted) {
        clast_dem_config c = scene_physics();
        c.domain = CLAST_DEM_PERIODIC;
        c.width = 0.125; /* a power of two: shifts are exact */
        c.gravity = 0.0;
        clast_dem *dem = scene_pour_with(&c, 0, 4e-3, 8e-3);
        clast_dem_grain pair[2] = {{.scale = 0.0078125, .density = 2650.0, .orientation = {1.0}},
                                   {.scale = 0.0078125, .density = 2650.0, .orientation = {1.0}}};
        pair[0].position[0] = shifted ? 0.0625 - 0.00390625 : -0.00390625;
        pair[1].position[0] = shifted ? -0.0625 + 0.00390625 : 0.00390625;
        pair[0].position[2] = pair[1].position[2] = 0.03125;
        pair[0].velocity[0] = 0.25;
        pair[1].velocity[1] = 0.125;
        CHECK_OK(clast_dem_add_grains(dem, 2, pair));
        CHECK_OK(clast_dem_step(dem, 300));
        for (int i = 0; i < 2; ++i) {
            clast_dem_read_grain(dem, i, &pair[i]);
            x[shifted][i] = pair[i].velocity[0];
        }
        clast_dem_destroy(dem);
    }
    assert_true(x[0][1] > 0.05);
    CHECK_REL(x[1][0], x[0][0], 1e-10);
    CHECK_REL(x[1][1], x[0][1], 1e-10);
}

enum { NARROW = 7, COPIES = 4 };

/// A bed in a period of `n` by `n` times the narrow one, each grain n^2 times.
static clast_dem *narrow_bed(scene_body_kind kind, int32_t n)
{
    static const double wide = 0.0094; // grains reach 8 mm across
    clast_dem_config c = scene_physics();
    clast_shape shape = {0};
    clast_dem_grain grain[NARROW * COPIES] = {{0}};
    c.domain = CLAST_DEM_PERIODIC;
    c.width = n * wide;
    c.height = 0.2;
    c.floor = true;
    c.gravity = 2000.0; // a bed within few steps
    CHECK_OK(scene_body(kind, &shape));
    for (int32_t k = 0; k < NARROW * n * n; ++k) {
        const int32_t i = k / (n * n);
        clx_rng rng = clx_rng_at(5, 0, (uint64_t)i);
        clast_dem_grain *g = &grain[k];
        *g = (clast_dem_grain){.scale = (i % 3 == 2 ? 0.0016 : 0.004) / shape.bounding_radius,
                               .density = 2650.0};
        g->position[0] = wide * (clx_rng_uniform(&rng) + k % n);
        g->position[1] = wide * (clx_rng_uniform(&rng) + k / n % n);
        g->position[2] = 0.0045 + 0.0085 * i;
        g->velocity[2] = -0.5;
        clx_rng_orientation(&rng, g->orientation);
    }
    clast_dem *dem = scene_bodies(&c, &shape, NARROW * n * n, grain);
    assert_non_null(dem);
    clast_shape_free(&shape);
    return dem;
}

/// Pairs of grains that touch in more than one image.
static int64_t count_double(const clast_dem *dem)
{
    const clx_dem_pair *pair = dem->list.pair;
    int64_t n = 0;
    for (int64_t k = 1; k < dem->list.n_pair; ++k) {
        n += pair[k].touches && pair[k - 1].touches && pair[k].b >= 0 &&
             pair[k].a == pair[k - 1].a && pair[k].b == pair[k - 1].b;
    }
    return n;
}

/* Grains wider than half the period touch each other in several images. Two by two of the period
 * side by side, wide enough for one image a pair, are the same bed. */
static void wide_grains_meet_in_every_image(void **state)
{
    (void)state;
    int64_t n_double = 0;
    for (int kind = 0; kind < N_SCENE_BODY; ++kind) {
        clast_dem *narrow = narrow_bed((scene_body_kind)kind, 1);
        clast_dem *wide = narrow_bed((scene_body_kind)kind, 2);
        clast_dem_measures m[2];
        clast_dem_grain a, b;
        for (int turn = 0; turn < 40; ++turn) {
            CHECK_OK(clast_dem_step(narrow, 50));
            CHECK_OK(clast_dem_step(wide, 50));
            clast_dem_measure(narrow, &m[0]);
            clast_dem_measure(wide, &m[1]);
            assert_int_equal(COPIES * m[0].n_contact, m[1].n_contact);
            n_double += count_double(narrow);
        }
        for (int32_t k = 0; k < NARROW * COPIES; ++k) {
            clast_dem_read_grain(narrow, k / COPIES, &a);
            clast_dem_read_grain(wide, k, &b);
            CHECK_ABS(b.position[2], a.position[2], 1e-9);
            CHECK_ABS(b.velocity[0], a.velocity[0], 1e-6);
            CHECK_ABS(b.velocity[1], a.velocity[1], 1e-6);
        }
        clast_dem_destroy(narrow);
        clast_dem_destroy(wide);
    }
    assert_true(n_double > 20);
}

/// Velocities of pairs that meet through the border, b moved by so many periods in x and y: the
/// same as without, but for the digits that its distance from the origin costs.
static void check_distant_pairs(scene_body_kind kind)
{
    static const double moved[] = {0,     1,     -2,    32767,  32768, -32767, -32768, 40000, -4e4,
                                   65535, 65536, 65537, -65536, 98304, 1e5,    -1e6,   1e6,   3e7};
    enum { N = sizeof moved / sizeof *moved };
    clast_dem_config c = scene_physics();
    c.domain = CLAST_DEM_PERIODIC;
    c.width = 0.125; /* a power of two: shifts are exact */
    c.gravity = 0.0;
    c.height = 1.0;
    clast_shape shape = {0};
    clast_dem_grain grain[2 * N] = {{0}};
    CHECK_OK(scene_body(kind, &shape));
    for (int k = 0; k < 2 * N; ++k) {
        const double far = c.width * moved[k / 2];
        grain[k] = (clast_dem_grain){.scale = 1.0, .density = 2650.0, .orientation = {1.0}};
        grain[k].position[0] = k % 2 ? 0.00390625 - 0.0625 + far : 0.0625 - 0.00390625 - 0.00025;
        grain[k].position[1] = k % 2 ? 0.0009765625 - 0.0625 + far : 0.0625;
        grain[k].position[2] = 0.03125 * (1 + k / 2);
        grain[k].velocity[0] = k % 2 ? 0.0 : 0.25;
    }
    clast_dem *dem = scene_bodies(&c, &shape, 2 * N, grain);
    assert_non_null(dem);
    CHECK_OK(clast_dem_step(dem, 1200));
    for (int k = 0; k < 2 * N; ++k) {
        clast_dem_read_grain(dem, k, &grain[k]);
        CHECK_ABS(grain[k].velocity[0], grain[k % 2].velocity[0], 0.25 * 1e-3);
    }
    assert_true(grain[1].velocity[0] > 0.02);
    clast_dem_destroy(dem);
    clast_shape_free(&shape);
}

/* Periods between two grains were counted in 16 bits: one that had crossed the border some 33,000
   times more often than its neighbour went through it without a contact, and nothing was said. */
static void crossings_are_counted_however_many(void **state)
{
    (void)state;
    check_distant_pairs(SCENE_BALL);
    check_distant_pairs(SCENE_EGG);
    check_distant_pairs(SCENE_OCTAHEDRON);
    check_distant_pairs(SCENE_CLUMP);
    check_distant_pairs(SCENE_EGGS);
}

int main(void)
{
    clast_parallel_set_threads(1); /* small scenes */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_miss_no_contact),
        cmocka_unit_test(skins_change_no_bit),
        cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test(threads_change_no_bit_of_hulls),
        cmocka_unit_test(energy_never_rises_by_itself),
        cmocka_unit_test(period_has_no_border),
        cmocka_unit_test(wide_grains_meet_in_every_image),
        cmocka_unit_test(crossings_are_counted_however_many),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
