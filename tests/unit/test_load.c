/* Unit: the energy book and the periodic cell, against closed forms; what they leave as it was. */
#include "support.h"

#include "dem/dem.h"
#include "dem_scenes.h"
#include "math/rng.h"
#include <clast/pack.h>

static const double RADIUS = 0.0035;
static const double DENSITY = 2650.0;

static clast_dem_grain at(double x, double y, double z)
{
    return (clast_dem_grain){.scale = RADIUS,
                             .density = DENSITY,
                             .position = {x, y, z},
                             .orientation = {1.0, 0.0, 0.0, 0.0}};
}

static clast_dem *balls(const clast_dem_config *config, int32_t n, const clast_dem_grain *grain)
{
    clast_shape sphere = {0};
    CHECK_OK(clast_shape_sphere("sphere", 1.0, &sphere));
    clast_dem *dem = scene_bodies(config, &sphere, n, grain);
    assert_non_null(dem);
    clast_shape_free(&sphere);
    return dem;
}

static double gross(const clast_dem_energy *e)
{
    return fabs(e->made) + fabs(e->gravity) + fabs(e->shaking) + fabs(e->cell);
}

/* m_eff v^2 (1 - e_n^2) / 2 goes into the dashpot of a central collision; what finite steps make of
 * its begin and end is a millionth, and falls with them. */
static void collision_loses_what_restitution_says(void **state)
{
    (void)state;
    double steps[2];
    for (int k = 0; k < 2; ++k) {
        clast_dem_config c = scene_space();
        c.restitution = 0.5;
        c.time_step = c.collision_time / (k == 0 ? 500.0 : 2000.0);
        clast_dem_grain pair[2] = {at(-1.0001 * RADIUS, 0.0, 0.0), at(1.0001 * RADIUS, 0.0, 0.0)};
        pair[0].velocity[0] = 0.3;
        clast_dem *dem = balls(&c, 2, pair);
        CHECK_OK(clast_dem_begin_energy(dem));
        (void)scene_collide(dem, c.time_step);
        clast_dem_energy e = {0};
        clast_dem_energy_measure(dem, &e);
        const double mass = 0.5 * DENSITY * 4.0 / 3.0 * CLAST_PI * RADIUS * RADIUS * RADIUS;
        CHECK_REL(e.put_in, mass * 0.09, 1e-14);
        CHECK_REL(e.damping[0], 0.5 * mass * 0.09 * 0.75, k == 0 ? 5e-3 : 2e-3);
        assert_true(e.friction[0] == 0.0 && e.damping[1] == 0.0 && e.normal_springs == 0.0);
        assert_true(fabs(e.rest) < 1e-12 * e.put_in);
        steps[k] = fabs(e.scheme) / e.put_in;
        clast_dem_destroy(dem);
    }
    assert_true(steps[0] < 1e-5 && steps[1] < steps[0] / 4.0);
}

/* A ball that may not turn by itself slides to rest on a floor: friction takes m v^2 / 2 less what
 * rolling keeps, 2/7 of it. */
static void sliding_ball_loses_two_sevenths(void **state)
{
    (void)state;
    clast_dem_config c = scene_physics();
    c.domain = CLAST_DEM_OPEN;
    c.fluid_density = 0.0;
    c.time_step = c.collision_time / 200.0;
    const double ln = log(c.restitution);
    const double rest =
        9.81 * c.collision_time * c.collision_time / (CLAST_PI * CLAST_PI + ln * ln);
    clast_dem_grain ball = at(0.0, 0.0, RADIUS - rest);
    ball.velocity[0] = 0.2;
    clast_dem *dem = balls(&c, 1, &ball);
    CHECK_OK(clast_dem_begin_energy(dem));
    CHECK_OK(clast_dem_step(dem, 20000));
    clast_dem_energy e = {0};
    clast_dem_energy_measure(dem, &e);
    const double whole = 0.5 * DENSITY * 4.0 / 3.0 * CLAST_PI * RADIUS * RADIUS * RADIUS * 0.04;
    CHECK_REL(e.friction[1] + e.damping[1], 2.0 / 7.0 * whole, 1e-3);
    CHECK_REL(e.friction[1], 2.0 / 7.0 * whole, 2e-3);
    CHECK_REL(e.translation, 25.0 / 49.0 * whole, 1e-3);
    CHECK_REL(e.rotation, 10.0 / 49.0 * whole, 1e-3);
    assert_true(fabs(e.rest) < 1e-10 * gross(&e));
    clast_dem_destroy(dem);
}

/* What a bed is made of, and the laws that hold it. */
typedef struct {
    const char *name;
    scene_body_kind kind;
    clast_dem_law law;
    clast_dem_scheme scheme;
    clast_dem_cohesion cohesion;
    double rolling, viscosity, added_mass, damping;
    bool plain;  ///< off: gyroscopic and normal_torque as the reference program has them
    bool smooth; ///< without friction
} bed;

static const bed beds[] = {
    {"balls", SCENE_BALL, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0, 0, 0, 1, false,
     false},
    {"exact", SCENE_OCTAHEDRON, CLAST_DEM_LINEAR, CLAST_DEM_EXACT, CLAST_DEM_DRY, 0, 0, 0, 1, false,
     false},
    {"cubes", SCENE_CUBE, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0, 0, 0, 0.1, false,
     false},
    {"eggs", SCENE_EGG, CLAST_DEM_HERTZ, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0, 0, 0, 1, false,
     false},
    {"clumps", SCENE_CLUMP, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0, 0, 0, 1, false,
     false},
    {"gems", SCENE_GEMS, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0, 0, 0, 1, false,
     false},
    {"sticky", SCENE_BALL, CLAST_DEM_HERTZ, CLAST_DEM_EXPLICIT, CLAST_DEM_JKR, 0, 0, 0, 1, false,
     false},
    {"rolling", SCENE_EGG, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DMT, 0.2, 0, 0, 1, false,
     false},
    {"wet", SCENE_CUBE, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0, 1e-2, 0.5, 0.1,
     false, false},
    {"printed", SCENE_CUBE, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0.1, 0, 0, 1, true,
     false},
    {"smooth", SCENE_BALL, CLAST_DEM_LINEAR, CLAST_DEM_EXACT, CLAST_DEM_DRY, 0, 0, 0, 1, false,
     true},
};

static clast_dem *pour(const bed *b)
{
    enum { N = 60 };
    clast_dem_grain grain[N];
    clast_shape shape = {0};
    clast_dem_config c = scene_physics();
    c.width = 0.03;
    c.law = b->law;
    c.contact_scheme = b->scheme;
    c.cohesion = b->cohesion;
    c.surface_energy = b->cohesion == CLAST_DEM_DRY ? 0.0 : 0.05;
    c.rolling_friction = b->rolling;
    c.rolling_model = b->rolling > 0.15 ? CLAST_DEM_ROLL_SPRING : CLAST_DEM_ROLL_TORQUE;
    c.fluid_viscosity = b->viscosity;
    c.added_mass = b->added_mass;
    c.normal_torque = !b->plain;
    c.gyroscopic = !b->plain;
    c.friction = b->smooth ? 0.0 : c.friction;
    for (int i = 0; i < N; ++i) {
        clx_rng rng = clx_rng_at(5, CLX_STREAM_TEST, (uint64_t)i);
        grain[i] =
            at(0.009 * (i % 2) - 0.0045, 0.009 * (i / 2 % 2) - 0.0045, 0.006 + 0.009 * (i / 4));
        grain[i].scale = 1.0;
        for (int k = 0; k < 3; ++k) {
            grain[i].velocity[k] = 0.3 * (2.0 * clx_rng_uniform(&rng) - 1.0);
            grain[i].angular_velocity[k] = 30.0 * (2.0 * clx_rng_uniform(&rng) - 1.0);
        }
        grain[i].velocity[2] -= 1.0;
    }
    CHECK_OK(scene_body(b->kind, &shape));
    clast_dem *dem = scene_bodies(&c, &shape, N, grain);
    assert_non_null(dem);
    clast_shape_free(&shape);
    const clast_dem_drive drive = {3e-4, 0.025, b->damping};
    clast_dem_set_drive(dem, &drive);
    return dem;
}

/* Every kind of body and law: no force is missed, and the run goes its old way bit by bit. */
static void book_closes_on_every_scene(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof beds / sizeof *beds; ++k) {
        clast_dem *plain = pour(&beds[k]);
        clast_dem *booked = pour(&beds[k]);
        CHECK_OK(clast_dem_begin_energy(booked));
        CHECK_OK(clast_dem_step(plain, 6000));
        CHECK_OK(clast_dem_step(booked, 6000));
        assert_true(clast_dem_hash(plain) == clast_dem_hash(booked));
        clast_dem_energy e = {0};
        clast_dem_energy_measure(booked, &e);
        assert_true(fabs(e.rest) < 1e-10 * gross(&e));
        assert_true(e.damping[0] > 0.0);
        if (beds[k].smooth) { // nothing holds across, whatever the law's displacement there
            assert_true(e.tangential_springs == 0.0 && e.friction[0] == 0.0 &&
                        e.friction[1] == 0.0);
        } else {
            assert_true(e.friction[0] > 0.0 && e.friction[1] > 0.0);
        }
        clast_dem_destroy(plain);
        clast_dem_destroy(booked);
    }
}

/* Domain cell without weight or fluid. */
static clast_dem_config in_cell(double width, double depth, double height)
{
    clast_dem_config c = scene_space();
    c.domain = CLAST_DEM_CELL;
    c.width = width;
    c.depth = depth;
    c.height = height;
    c.fluid_density = 0.0;
    c.friction = 0.0;
    return c;
}

enum { MOST_SITES = 64, MOST_LINKS = 12 };

/* A lattice: its sites in a cell of three by three by three, and the ways to half of the
 * neighbours. */
typedef struct {
    int n, n_link;
    double side;
    double site[MOST_SITES * 2][3];
    double link[MOST_LINKS][3];
} lattice;

static lattice make_lattice(bool is_fcc, double diameter)
{
    static const double base[4][3] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
    static const double fcc[6][3] = {{0.5, 0.5, 0},  {0.5, 0, 0.5},  {0, 0.5, 0.5},
                                     {0.5, -0.5, 0}, {0.5, 0, -0.5}, {0, 0.5, -0.5}};
    const double a = is_fcc ? sqrt(2.0) * diameter : diameter;
    const int each = is_fcc ? 3 : 4;
    lattice l = {.side = each * a, .n_link = is_fcc ? 6 : 3};
    for (int i = 0; i < each * each * each; ++i) {
        for (int b = 0; b < (is_fcc ? 4 : 1); ++b, ++l.n) {
            const int at[3] = {i % each, i / each % each, i / each / each};
            for (int k = 0; k < 3; ++k) {
                l.site[l.n][k] = (at[k] + base[b][k] + 0.25) * a - (k < 2 ? 0.5 * l.side : 0.0);
            }
        }
    }
    for (int i = 0; i < l.n_link; ++i) {
        for (int k = 0; k < 3; ++k) {
            l.link[i][k] = a * (is_fcc ? fcc[i][k] : k == i ? 1.0 : 0.0);
        }
    }
    return l;
}

/* Stress of the strained lattice, by its definition: sum k (d - l) l_i l_j / l over half of the
 * ways, N sites in V. */
static void lattice_stress(const lattice *l, const clast_dem_cell *cell, double stiffness,
                           double diameter, double s[6])
{
    static const int entry[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    const double volume = cell->side[0] * cell->side[1] * cell->side[2];
    for (int e = 0; e < 6; ++e) {
        s[e] = 0.0;
    }
    for (int i = 0; i < l->n_link; ++i) {
        double r[3];
        for (int k = 0; k < 3; ++k) {
            r[k] = l->link[i][k] * cell->side[k] / l->side;
        }
        r[0] += l->link[i][2] * cell->shift / l->side;
        const double length = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
        const double force = stiffness * fmax(diameter - length, 0.0);
        for (int e = 0; e < 6; ++e) {
            s[e] += l->n * force * r[entry[e][0]] * r[entry[e][1]] / length / volume;
        }
    }
}

/* Simple cubic and face-centred cubic lattices, pressed by 1 % and sheared: the springs' exact
 * stress; and at small strains the moduli sqrt(2) k / d (C11), half of that (C12, C44) of fcc, k /
 * d of cubic. */
static void lattices_have_their_stiffness(void **state)
{
    (void)state;
    const double d = 2.0 * RADIUS;
    const double ln = log(0.1);
    const double mass = DENSITY * 4.0 / 3.0 * CLAST_PI * RADIUS * RADIUS * RADIUS;
    const double k = 0.5 * mass * (CLAST_PI * CLAST_PI + ln * ln) / 4e-8;
    for (int is_fcc = 0; is_fcc < 2; ++is_fcc) {
        const lattice l = make_lattice(is_fcc != 0, d);
        clast_dem_config c = in_cell(l.side, l.side, l.side);
        clast_dem_grain grain[MOST_SITES * 2];
        for (int i = 0; i < l.n; ++i) {
            grain[i] = at(l.site[i][0], l.site[i][1], l.site[i][2]);
        }
        clast_dem *dem = balls(&c, l.n, grain);
        const double rates[3][4] = {
            {-0.2, -0.3, -0.4, 0.0}, {0.0, 0.0, 0.0, is_fcc ? 0.5 : 0.0}, {0}};
        clast_dem_load load;
        clast_dem_cell cell;
        double wanted[6];
        for (int stage = 0; stage < 3; ++stage) {
            double rate[3];
            for (int e = 0; e < 3; ++e) {
                rate[e] = rates[stage][e] * l.side;
            }
            CHECK_OK(clast_dem_set_cell_rate(dem, rate, rates[stage][3] * l.side));
            CHECK_OK(clast_dem_step(dem, stage == 2 ? 1 : 5000));
        }
        CHECK_OK(clast_dem_load_measure(dem, &load));
        clast_dem_read_cell(dem, &cell);
        CHECK_REL(cell.side[2], l.side * 0.99, 1e-12);
        lattice_stress(&l, &cell, k, d, wanted);
        for (int e = 0; e < 6; ++e) {
            CHECK_ABS(load.stress[e], wanted[e], 1e-9 * wanted[2]);
            CHECK_ABS(load.kinetic_stress[e], 0.0, 1e-9 * wanted[2]);
        }
        CHECK_REL(load.coordination, is_fcc ? 12.0 : 6.0, 1e-15);
        assert_true(load.n_rattler == 0 && load.unbalanced < 1e-9);
        /* moduli by a small further strain along z */
        const double along[3] = {0.0, 0.0, -1e-3 * l.side};
        const double still[3] = {0.0, 0.0, 0.0};
        clast_dem_load more;
        CHECK_OK(clast_dem_set_cell_rate(dem, along, 0.0));
        CHECK_OK(clast_dem_step(dem, 2000));
        CHECK_OK(clast_dem_set_cell_rate(dem, still, 0.0));
        CHECK_OK(clast_dem_load_measure(dem, &more));
        const double strain = 1e-5;
        const double c11 = is_fcc ? sqrt(2.0) * k / d : k / d;
        CHECK_REL((more.stress[2] - load.stress[2]) / strain, c11, 0.05);
        CHECK_ABS((more.stress[0] - load.stress[0]) / strain, is_fcc ? 0.5 * c11 : 0.0, 0.05 * c11);
        CHECK_REL(load.modulus[2], c11, 0.05);
        clast_dem_destroy(dem);
    }
}

/* Contacts by all pairs and all images around, beside those that the lists found. */
static int64_t count_contacts(const clast_dem *dem, double deeper)
{
    clast_dem_cell cell;
    int64_t n = 0;
    clast_dem_read_cell(dem, &cell);
    for (int32_t i = 0; i < clast_dem_n_grain(dem); ++i) {
        for (int32_t j = 0; j < i; ++j) {
            clast_dem_grain a;
            clast_dem_grain b;
            clast_dem_read_grain(dem, i, &a);
            clast_dem_read_grain(dem, j, &b);
            for (int m = 0; m < 75; ++m) {
                const int at[3] = {m % 5 - 2, m / 5 % 5 - 2, m / 25 - 1};
                double r[3];
                for (int k = 0; k < 3; ++k) {
                    r[k] = b.position[k] - a.position[k] + at[k] * cell.side[k];
                }
                r[0] += at[2] * cell.shift;
                n += sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) < a.scale + b.scale - deeper ? 1
                                                                                                : 0;
            }
        }
    }
    return n;
}

/* A bed pressed and sheared until its images have passed each other: no contact is missed, the book
 * closes with the cell's work, and threads change nothing. */
static void sheared_bed_misses_no_contact(void **state)
{
    (void)state;
    enum { N = 125 };
    clast_dem_config c = in_cell(0.04, 0.042, 0.044);
    c.friction = 0.5;
    c.restitution = 0.7;
    clast_dem_grain grain[N];
    for (int i = 0; i < N; ++i) {
        clx_rng rng = clx_rng_at(7, CLX_STREAM_TEST, (uint64_t)i);
        const int k[3] = {i % 5, i / 5 % 5, i / 25};
        grain[i] = at(0.008 * k[0] - 0.016, 0.0084 * k[1] - 0.0168, 0.0088 * (k[2] + 0.5));
        grain[i].scale = RADIUS * (0.7 + 0.4 * clx_rng_uniform(&rng));
        for (int a = 0; a < 3; ++a) {
            grain[i].velocity[a] = 0.2 * clx_rng_uniform(&rng) - 0.1;
        }
    }
    clast_dem *dem = balls(&c, N, grain);
    CHECK_OK(clast_dem_begin_energy(dem));
    const double press[3] = {-0.1, -0.1, -0.1};
    const double still[3] = {0.0, 0.0, 0.0};
    CHECK_OK(clast_dem_set_cell_rate(dem, press, 0.0));
    CHECK_OK(clast_dem_step(dem, 24000));
    CHECK_OK(clast_dem_set_cell_rate(dem, still, 0.5));
    double most = 0.0;
    for (int k = 0; k < 20; ++k) {
        clast_dem_load load;
        CHECK_OK(clast_dem_step(dem, 1000));
        CHECK_OK(clast_dem_load_measure(dem, &load));
        /* what has come into touch by this step's motion alone is none yet */
        assert_true(load.n_contact <= count_contacts(dem, 0.0) &&
                    load.n_contact >= count_contacts(dem, 3e-6));
        most = fmax(most, load.coordination);
    }
    clast_dem_cell cell;
    clast_dem_energy e = {0};
    clast_dem_read_cell(dem, &cell);
    clast_dem_energy_measure(dem, &e);
    assert_true(most > 3.0 && cell.shear_strain > 1.2 && fabs(cell.shift) <= 0.5 * cell.side[0]);
    assert_true(e.cell > 0.0 && e.friction[0] > 0.0);
    assert_true(fabs(e.rest) < 1e-10 * gross(&e));
    clast_dem_destroy(dem);
}

/* The servo's stress, which lanes find, is that of the contacts that scalar code finds, bit by bit.
 */
static void stress_is_that_of_the_contacts(void **state)
{
    (void)state;
    enum { N = 64 };
    static const scene_body_kind kinds[] = {SCENE_BALL, SCENE_OCTAHEDRON, SCENE_CUBE, SCENE_EGG};
    static const char *const name[2][3] = {{"force_x_N", "force_y_N", "force_z_N"},
                                           {"branch_x_m", "branch_y_m", "branch_z_m"}};
    static const int entry[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k) {
        clast_dem_config c = in_cell(0.048, 0.048, 0.048);
        clast_dem_grain grain[N];
        clast_shape shape = {0};
        c.friction = 0.5;
        CHECK_OK(scene_body(kinds[k], &shape));
        for (int i = 0; i < N; ++i) {
            clx_rng rng = clx_rng_at(9, CLX_STREAM_TEST, (uint64_t)i);
            grain[i] =
                at(0.012 * (i % 4) - 0.018, 0.012 * (i / 4 % 4) - 0.018, 0.012 * (i / 16 + 0.5));
            grain[i].scale = cbrt(2.5e-7 / shape.volume);
            clx_rng_orientation(&rng, grain[i].orientation);
        }
        clast_dem *dem = scene_bodies(&c, &shape, N, grain);
        const double press[3] = {-0.2, -0.2, -0.2};
        CHECK_OK(clast_dem_set_cell_rate(dem, press, 0.02));
        CHECK_OK(clx_dem_step_packed(dem, (int64_t)(0.018 / 0.2 / c.time_step)));
        clast_dem_load load;
        clast_dem_load packed; /* as a run's servo looks, between its steps */
        clast_table t = {0};
        double sum[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
        assert_true(dem->inner.is_packed == (kinds[k] != SCENE_BALL));
        CHECK_OK(clast_dem_load_measure(dem, &packed));
        clx_inner_unpack(dem);
        CHECK_OK(clast_dem_load_measure(dem, &load));
        assert_memory_equal(packed.stress, load.stress, sizeof load.stress);
        assert_true(packed.n_contact == load.n_contact);
        CHECK_OK(clast_dem_contact_table(dem, &t));
        for (int64_t i = 0; i < t.n_row; ++i) {
            double f[3];
            double l[3];
            for (int a = 0; a < 3; ++a) {
                f[a] = clast_table_numbers(&t, name[0][a])[i];
                l[a] = clast_table_numbers(&t, name[1][a])[i];
            }
            for (int e = 0; e < 6; ++e) {
                const int a = entry[e][0];
                const int b = entry[e][1];
                sum[e] += 0.5 * (f[a] * l[b] + f[b] * l[a]);
            }
        }
        assert_true(t.n_row > N / 2 && load.n_contact == t.n_row);
        for (int e = 0; e < 6; ++e) {
            assert_true(load.stress[e] == sum[e] / load.volume);
        }
        clast_table_free(&t);
        clast_dem_destroy(dem);
        clast_shape_free(&shape);
    }
}

/* What a cell cannot be is said. */
static void cells_refuse_what_they_cannot(void **state)
{
    (void)state;
    clast_dem *dem = NULL;
    clast_dem_config c = in_cell(0.03, 0.03, 0.03);
    const double rate[3] = {-0.1, -0.1, -0.1};
    c.gravity = 9.81;
    assert_int_equal(clast_dem_create(&c, &dem), CLAST_E_CONFIG);
    c.gravity = 0.0;
    c.floor = true;
    assert_int_equal(clast_dem_create(&c, &dem), CLAST_E_CONFIG);
    c.floor = false;
    c.fluid_viscosity = 1e-3;
    assert_int_equal(clast_dem_create(&c, &dem), CLAST_E_CONFIG);
    c.fluid_viscosity = 0.0;
    const clast_dem_grain grain = at(0.0, 0.0, 0.015);
    dem = balls(&c, 1, &grain);
    CHECK_OK(clast_dem_set_cell_rate(dem, rate, 0.0));
    assert_int_equal(clast_dem_step(dem, 100000), CLAST_E_GEOMETRY);
    clast_dem_destroy(dem);
    c = scene_space();
    CHECK_OK(clast_dem_create(&c, &dem));
    assert_int_equal(clast_dem_set_cell_rate(dem, rate, 0.0), CLAST_E_USAGE);
    clast_dem_destroy(dem);
}

/* Side x moves while the images shear past half of it: grains that go with the cell still do, and
 * the strain of x is no shear. */
static void sheared_cell_is_pressed_along_x(void **state)
{
    (void)state;
    clast_dem_config c = scene_space();
    c.domain = CLAST_DEM_CELL;
    c.width = c.depth = c.height = 0.06;
    clast_dem_grain grain[3];
    for (int i = 0; i < 3; ++i) {
        grain[i] = at(0.02 * (i - 1), 0.018 * (i - 1), 0.009 + 0.02 * i);
    }
    clast_dem *dem = balls(&c, 3, grain);
    const double rate[3] = {-0.05, 0.02, 0.01};
    clast_dem_cell cell;
    CHECK_OK(clast_dem_set_cell_rate(dem, rate, 0.3));
    double turns = 0.0;
    double last = 0.0;
    for (int k = 0; k < 400; ++k) {
        CHECK_OK(clast_dem_step(dem, 100));
        clast_dem_read_cell(dem, &cell);
        turns += cell.shift < last ? 1.0 : 0.0;
        last = cell.shift;
        for (int i = 0; i < 3; ++i) {
            clast_dem_grain g;
            clast_dem_read_grain(dem, i, &g);
            const double z = g.position[2] / cell.side[2];
            const double x = (g.position[0] - cell.shift * z) / cell.side[0];
            CHECK_ABS(g.velocity[0], cell.rate[0] * x + cell.shear_rate * z, 1e-10);
            CHECK_ABS(g.velocity[1], cell.rate[1] * g.position[1] / cell.side[1], 1e-10);
            CHECK_ABS(g.velocity[2], cell.rate[2] * z, 1e-10);
        }
    }
    assert_true(turns >= 1.0);
    clast_dem_destroy(dem);
}

/* A packing of its defaults, in a cell of 20 mm, with these stages. */
static clast_pack_config packing(int32_t n_stage, char **stage)
{
    clast_pack_config c = {0};
    CHECK_OK(clast_fields_default(clast_pack_fields, &c));
    c.dem.domain = CLAST_DEM_CELL;
    c.dem.width = c.dem.height = 0.02;
    c.dem.floor = false;
    c.dem.gravity = c.dem.fluid_density = 0.0;
    c.mass = 0.003;
    c.load_rate = 4.0;
    c.spacing = 0.0045;
    c.stages = (clast_text_list){n_stage, stage};
    return c;
}

static clast_pack *start(const clast_pack_config *c, const clast_grading *grading,
                         const clast_shape *shape, clast_status wanted)
{
    clast_pack *pack = NULL;
    const clast_pack_input input = {.grading = grading, .n_shape = 1, .shape = shape};
    CHECK_STATUS(clast_pack_create(c, &input, &pack), wanted);
    return pack;
}

/* The servo comes to its pressure and holds it in a triaxial test; rows end where stages do. */
static void servo_holds_its_pressure(void **state)
{
    (void)state;
    char *stages[] = {"isotropic 20kPa until rest", "triaxial 20kPa 1/s until strain 0.05",
                      "hold until time 1ms"};
    clast_pack_config c = packing(3, stages);
    const double size = 0.004;
    clast_grading *grading = NULL;
    clast_shape sphere = {0};
    CHECK_OK(clast_grading_uniform(size, size, &grading));
    CHECK_OK(clast_shape_sphere("sphere", 0.5, &sphere));
    clast_pack *pack = start(&c, grading, &sphere, CLAST_OK);
    CHECK_OK(clast_pack_advance(pack, 1000000));
    assert_true(clast_pack_is_over(pack));
    assert_null(clast_pack_wall_table(pack)); // a cell has no walls
    const clast_table *t = clast_pack_load_table(pack);
    const double *stage = clast_table_numbers(t, "stage");
    int64_t end[3] = {0, 0, 0};
    for (int64_t i = 0; i < t->n_row; ++i) {
        end[(int)stage[i] - 1] = i;
    }
    for (int k = 0; k < 3; ++k) {
        static const char *const name[3] = {"stress_xx_Pa", "stress_yy_Pa", "stress_zz_Pa"};
        CHECK_REL(clast_table_numbers(t, name[k])[end[0]], 2e4, 0.01);
        CHECK_REL(clast_table_numbers(t, name[k])[end[1]], 2e4, k < 2 ? 0.1 : 10.0);
    }
    assert_true(clast_table_numbers(t, "unbalanced")[end[0]] < 1e-3);
    assert_true(clast_table_numbers(t, "stress_zz_Pa")[end[1]] > 3e4);
    const double *strain = clast_table_numbers(t, "strain_z");
    CHECK_ABS(strain[end[1]] - strain[end[0]], 0.05, 2e-4);
    assert_true(clast_table_numbers(t, "porosity")[end[0]] < 0.45);
    clast_pack_destroy(pack);
    clast_grading_destroy(grading);
    clast_shape_free(&sphere);
    c.stages = (clast_text_list){0};
    clast_fields_free(clast_pack_fields, &c);
}

/* Stages end where the stress of what drives them is, from above where it falls: not at the held
 * pressure of other sides, and not at once. */
static void stages_end_at_the_driven_stress(void **state)
{
    (void)state;
    enum { N = 6 };
    char *stages[N] = {"isotropic 10kPa until rest",
                       "triaxial 10kPa 1/s until stress 20kPa",
                       "triaxial 10kPa -1/s until stress 12kPa",
                       "shear 1/s 10kPa until stress 3kPa",
                       "oedometer 4kPa until stress 6kPa",
                       "x=6kPa y=6kPa z=0/s until strain 1e-3"};
    clast_pack_config c = packing(N, stages);
    const double size = 0.004;
    clast_grading *grading = NULL;
    clast_shape sphere = {0};
    CHECK_OK(clast_grading_uniform(size, size, &grading));
    CHECK_OK(clast_shape_sphere("sphere", 0.5, &sphere));
    clast_pack *pack = start(&c, grading, &sphere, CLAST_OK);
    CHECK_OK(clast_pack_advance(pack, 1000000));
    assert_true(clast_pack_is_over(pack));
    const clast_table *t = clast_pack_load_table(pack);
    const double *stage = clast_table_numbers(t, "stage");
    const double *step = clast_table_numbers(t, "step");
    const double *z = clast_table_numbers(t, "stress_zz_Pa");
    int64_t end[N] = {0};
    for (int64_t i = 0; i < t->n_row; ++i) {
        end[(int)stage[i] - 1] = i;
    }
    for (int k = 1; k < N; ++k) {
        assert_true(step[end[k]] > step[end[k - 1]] + 25.0);
    }
    assert_true(z[end[1]] >= 2e4 && z[end[1]] < 2.2e4);
    assert_true(z[end[2]] <= 1.2e4 && z[end[2]] > 1e4);
    const double xz = fabs(clast_table_numbers(t, "stress_xz_Pa")[end[3]]);
    assert_true(xz >= 3e3 && xz < 4e3 && z[end[3]] > 5e3);
    assert_true(z[end[4]] <= 6e3 && z[end[4]] > 4e3);
    clast_pack_destroy(pack);
    clast_grading_destroy(grading);
    clast_shape_free(&sphere);
    c.stages = (clast_text_list){0};
    clast_fields_free(clast_pack_fields, &c);
}

/* Words that are no stage, and stages that cannot be. */
static void stages_refuse_what_they_cannot(void **state)
{
    (void)state;
    char *wrong[] = {"",
                     "squeeze 10kPa",
                     "isotropic",
                     "isotropic 10",
                     "isotropic -1kPa",
                     "isotropic 1/s",
                     "isotropic 10kPa until dawn",
                     "isotropic 10kPa until strain",
                     "triaxial 10kPa",
                     "shear 0Pa until strain 1",
                     "hold until strain 1",
                     "hold until stress",
                     "hold until stress 1kPa",
                     "z=0/s until stress 1kPa",
                     "z=0/s until strain 0.1",
                     "isotropic 0Pa",
                     "xz=1 until strain 0.1",
                     "shear 1kPa until mass 1g",
                     "isotropic 1000000/s until strain 0.1",
                     "hold until time 1s until time 2s"};
    const double size = 0.004;
    clast_grading *grading = NULL;
    clast_shape sphere = {0};
    CHECK_OK(clast_grading_uniform(size, size, &grading));
    CHECK_OK(clast_shape_sphere("sphere", 0.5, &sphere));
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        clast_pack_config c = packing(1, &wrong[k]);
        c.load_rate = 1.0; // its default, as some of them press nothing
        assert_null(start(&c, grading, &sphere, CLAST_E_CONFIG));
        c.stages = (clast_text_list){0};
        clast_fields_free(clast_pack_fields, &c);
    }
    clast_grading_destroy(grading);
    clast_shape_free(&sphere);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(collision_loses_what_restitution_says),
        cmocka_unit_test(sliding_ball_loses_two_sevenths),
        cmocka_unit_test(book_closes_on_every_scene),
        cmocka_unit_test(lattices_have_their_stiffness),
        cmocka_unit_test(sheared_bed_misses_no_contact),
        cmocka_unit_test(stress_is_that_of_the_contacts),
        cmocka_unit_test(cells_refuse_what_they_cannot),
        cmocka_unit_test(sheared_cell_is_pressed_along_x),
        cmocka_unit_test(servo_holds_its_pressure),
        cmocka_unit_test(stages_end_at_the_driven_stress),
        cmocka_unit_test(stages_refuse_what_they_cannot),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
