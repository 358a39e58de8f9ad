/* Unit: one bed over ranks is the bed of one rank, bit by bit. */
#include "dem_scenes.h"
#include "ranks.h"
#include "support.h"

#include "base/alloc.h"
#include "dem/dem.h"
#include "dem/load.h"
#include "dem/ranks.h"
#include "dem/saved.h"
#include "math/rng.h"
#include <string.h>

typedef struct {
    const char *name;
    scene_body_kind kind;
    int32_t domain;
    bool has_spheres; ///< beside, some of them larger than a rank's part of the bed
    void (*change)(clast_dem_config *config);
    bool has_energy; ///< with an energy book
    double boulder;  ///< radius of its one large sphere [m]; 0: 9 mm
} bed_case;

static void roll(clast_dem_config *c)
{
    c->rolling_friction = 0.2;
    c->rolling_model = CLAST_DEM_ROLL_SPRING;
}

static void hold(clast_dem_config *c)
{
    c->contact_scheme = CLAST_DEM_EXACT;
}

static void wet(clast_dem_config *c)
{
    c->fluid_viscosity = 1e-3;
    c->wet_restitution = true;
    c->added_mass = 0.5;
}

static void verify(clast_dem_config *c)
{
    c->verify = 50;
}

static void stick(clast_dem_config *c)
{
    wet(c);
    c->cohesion = CLAST_DEM_AREA;
    c->cohesion_energy = 1e4;
    c->rolling_friction = 0.1;
}

static const bed_case cases[] = {
    {"balls in a cylinder", SCENE_BALL, CLAST_DEM_CYLINDER, true, NULL, false, 0.0},
    {"balls in a periodic box, rolling springs", SCENE_BALL, CLAST_DEM_PERIODIC, false, roll, false,
     0.0},
    {"cubes in a periodic box", SCENE_CUBE, CLAST_DEM_PERIODIC, true, NULL, false, 0.0},
    {"octahedra in a box, exact steps, compared", SCENE_OCTAHEDRON, CLAST_DEM_BOX, false, hold,
     false, 0.0},
    {"eggs in a cylinder, in water", SCENE_EGG, CLAST_DEM_CYLINDER, true, wet, false, 0.0},
    {"clumps in a periodic box", SCENE_CLUMP, CLAST_DEM_PERIODIC, true, NULL, true, 0.0},
    {"bricks in a box, compared", SCENE_BRICKS, CLAST_DEM_BOX, false, verify, true, 0.0},
    {"gems in a cylinder", SCENE_GEMS, CLAST_DEM_CYLINDER, true, NULL, true, 0.0},
    {"balls in a cell, rolling springs", SCENE_BALL, CLAST_DEM_CELL, false, roll, true, 0.0},
    {"octahedra in a cell", SCENE_OCTAHEDRON, CLAST_DEM_CELL, true, NULL, false, 0.0},
    {"clumps in a cell", SCENE_CLUMP, CLAST_DEM_CELL, true, NULL, true, 0.0},
    {"eggs that stick, in water", SCENE_EGG, CLAST_DEM_PERIODIC, true, stick, true, 0.0},
    {"cubes below a boulder that touches them in two images", SCENE_CUBE, CLAST_DEM_PERIODIC, true,
     NULL, true, 0.0195},
};

enum {
    N_CASE = sizeof cases / sizeof cases[0],
    SIDE = 5,
    LAYER = SIDE * SIDE,
    MARKS = 6,
    STEPS = 200
};

/// The layer that is one sphere larger than any rank's part of the bed.
enum { BOULDER = 5 };

/// Grains of a layer: on a loose lattice, thrown down at random.
static clast_status add_layer(const bed_case *c, clast_dem *dem, int32_t layer, double z)
{
    clast_dem_grain grain[LAYER];
    const int32_t n = layer == BOULDER ? 1 : LAYER;
    const double large = c->boulder > 0.0 ? c->boulder : 0.009;
    for (int32_t i = 0; i < n; ++i) {
        clx_rng rng = clx_rng_at(7, 0, (uint64_t)(layer * LAYER + i));
        clast_dem_grain *g = &grain[i];
        const bool is_ball = layer == BOULDER || (c->has_spheres && i % 5 == 2);
        double measures[2];
        clx_dem_shape_measures(dem, is_ball ? 1 : 0, measures);
        *g = (clast_dem_grain){.shape = is_ball ? 1 : 0,
                               .scale = (layer == BOULDER ? large : 0.0043) / measures[0],
                               .density = 2650.0};
        g->position[0] = n == 1 ? 0.0 : 0.0088 * (i % SIDE - 2.0);
        g->position[1] = n == 1 ? 0.0 : 0.0088 * (i / SIDE - 2.0);
        g->position[2] = z;
        for (int k = 0; k < 3; ++k) {
            g->velocity[k] = 1.2 * (clx_rng_uniform(&rng) - 0.5) - (k == 2 ? 0.2 : 0.0);
            g->angular_velocity[k] = 40.0 * (clx_rng_uniform(&rng) - 0.5);
        }
        clx_rng_orientation(&rng, g->orientation);
    }
    return clast_dem_add_grains(dem, n, grain);
}

static clast_status make(const bed_case *c, clast_dem **dem)
{
    clast_dem_config config = scene_physics();
    clast_shape body = {0};
    clast_shape ball = {0};
    int32_t id = 0;
    config.domain = c->domain;
    config.width = c->domain == CLAST_DEM_CYLINDER ? 0.068 : 0.046;
    config.height = 0.2;
    config.floor = true;
    config.gravity = 2000.0; // a bed within few steps
    if (c->domain == CLAST_DEM_CELL) {
        config.height = 0.076;
        config.floor = false;
        config.gravity = 0.0;
    }
    if (c->change != NULL) {
        c->change(&config);
    }
    clast_status status = clast_dem_create(&config, dem);
    status = status == CLAST_OK ? scene_body(c->kind, &body) : status;
    status = status == CLAST_OK ? scene_body(SCENE_BALL, &ball) : status;
    status = status == CLAST_OK ? clast_dem_add_shape(*dem, &body, &id) : status;
    status = status == CLAST_OK ? clast_dem_add_shape(*dem, &ball, &id) : status;
    for (int32_t k = 0; k < 4 && status == CLAST_OK; ++k) {
        status = add_layer(c, *dem, k, 0.005 + 0.0088 * k);
    }
    status = status == CLAST_OK && c->has_energy ? clast_dem_begin_energy(*dem) : status;
    clast_shape_free(&body);
    clast_shape_free(&ball);
    return status;
}

/// A cell that is pressed and sheared, the faster the more stress it has: a bit that differs shows.
static clast_status strain(clast_dem *dem)
{
    enum { LOOKS = 8 };
    const double time = STEPS * dem->config.time_step;
    clast_status status = CLAST_OK;
    for (int k = 0; k < LOOKS && status == CLAST_OK; ++k) {
        clast_dem_load load = {0};
        clast_dem_cell cell;
        status = clx_dem_gather_grains(dem);
        status = status == CLAST_OK ? clx_dem_stress(dem, true, &load) : status;
        clast_dem_read_cell(dem, &cell);
        double rate[3];
        for (int i = 0; i < 3; ++i) {
            const double pressure = load.stress[i] + load.kinetic_stress[i];
            rate[i] = -cell.side[i] * (i < 2 ? 0.01 : 0.05) * (1.0 - 1e-7 * pressure) / time;
        }
        status = status == CLAST_OK
                     ? clast_dem_set_cell_rate(dem, rate, 0.008 * (1.0 + load.unbalanced) / time)
                     : status;
        status = status == CLAST_OK ? clast_dem_step(dem, STEPS / LOOKS) : status;
    }
    return status;
}

/// Goes to a mark: a boulder falls on the bed, and shaking sets in.
static clast_status go(const bed_case *c, clast_dem *dem, int mark)
{
    const clast_dem_drive drive = {.shake_amplitude = 1e-3, .shake_period = 5e-3, .damping = 1.0};
    const clast_dem_drive damp = {.shake_period = 1.0, .damping = 1e-200};
    clast_status status = CLAST_OK;
    if (mark == 2) {
        status = add_layer(c, dem, BOULDER, 0.06);
    }
    if (c->domain == CLAST_DEM_CELL) {
        return status == CLAST_OK ? strain(dem) : status;
    }
    clast_dem_set_drive(dem, mark < 3 ? &damp : &drive);
    return status == CLAST_OK ? clast_dem_step(dem, STEPS) : status;
}

/// Digest of all that a checkpoint holds.
static uint64_t digest(const clast_dem *dem)
{
    clx_dem_saved s = {0};
    uint64_t h = 14695981039346656037u;
    if (clx_dem_save(dem, &s) != CLAST_OK) {
        return 0;
    }
    const struct {
        const void *bytes;
        int64_t n;
    } part[] = {{s.grain, 8 * CLX_SAVED_GRAIN * s.n_grain},
                {s.anchor, 8 * CLX_SAVED_ANCHOR * s.n_known},
                {s.limit, 8 * s.n_known},
                {s.held, s.held != NULL ? 8 * s.n_grain : 0},
                {s.history, s.history != NULL ? 8 * CLX_SAVED_HISTORY * s.n_pair : 0},
                {s.id, 4 * CLX_SAVED_ID * s.n_pair},
                {s.pair, 8 * CLX_SAVED_PAIR * s.n_pair},
                {s.warm_start, s.warm_start != NULL ? s.warm_start_width * s.n_pair : 0},
                {s.cell, s.cell != NULL ? 8 * CLX_SAVED_CELL : 0},
                {s.energy, 8 * s.n_energy},
                {&s.n_refresh, 8},
                {&s.is_due, 1},
                {s.verified, sizeof s.verified}};
    for (size_t p = 0; p < sizeof part / sizeof part[0]; ++p) {
        for (int64_t i = 0; i < part[p].n; ++i) {
            h = (h ^ ((const uint8_t *)part[p].bytes)[i]) * 1099511628211u;
        }
    }
    clx_dem_saved_free(&s);
    return h;
}

typedef struct {
    const bed_case *one;
    uint64_t hash[MARKS], digest[MARKS];
    clast_dem_energy energy[MARKS];
} expected;

/// The bed at a mark: the energy of what it holds now, and of what its book has summed up.
static clast_dem_energy energy_of(const clast_dem *dem)
{
    clast_dem_energy e = {0};
    clast_dem_energy_measure(dem, &e);
    return e;
}

static int run_rank(const clast_comm *comm, void *context)
{
    const expected *e = context;
    clast_dem *dem = NULL;
    RANK_CHECK(make(e->one, &dem) == CLAST_OK);
    RANK_CHECK(clx_dem_share(dem, comm) == CLAST_OK);
    for (int mark = 0; mark < MARKS; ++mark) {
        RANK_CHECK(go(e->one, dem, mark) == CLAST_OK);
        const double highest = clx_dem_highest(dem);
        RANK_CHECK(clx_dem_gather_all(dem) == CLAST_OK);
        double top = 0.0;
        (void)clast_dem_mean_height(dem, &top);
        RANK_CHECK(top == highest);
        if (comm->rank == 0) {
            RANK_CHECK(clast_dem_hash(dem) == e->hash[mark]);
            RANK_CHECK(digest(dem) == e->digest[mark]);
            const clast_dem_energy energy = energy_of(dem);
            RANK_CHECK(memcmp(&energy, &e->energy[mark], sizeof energy) == 0);
        }
    }
    clast_dem_destroy(dem);
    return 0;
}

static void bed_is_the_same_on_ranks(void **state)
{
    (void)state;
    for (int c = 0; c < N_CASE; ++c) {
        expected e = {.one = &cases[c]};
        clast_dem *dem = NULL;
        CHECK_OK(make(e.one, &dem));
        for (int mark = 0; mark < MARKS; ++mark) {
            CHECK_OK(go(e.one, dem, mark));
            e.hash[mark] = clast_dem_hash(dem);
            e.digest[mark] = digest(dem);
            e.energy[mark] = energy_of(dem);
        }
        clast_dem_measures m;
        clast_dem_measure(dem, &m);
        print_message("%s: %d contacts, %d at walls, %d refreshes\n", e.one->name, (int)m.n_contact,
                      (int)m.n_wall_contact, (int)m.n_refresh);
        assert_true(m.n_contact > 10);
        const clast_dem_energy *last = &e.energy[MARKS - 1];
        assert_true(!cases[c].has_energy || fabs(last->rest) < 1e-10 * last->put_in);
        clast_dem_destroy(dem);
        support_run_ranks(2 + c % 3, run_rank, &e);
    }
}

#ifdef CLAST_ALLOC_INJECT
/// Rank 1 is refused its k-th block from the first step on; without that, all goes well.
static int run_refused(const clast_comm *comm, void *context)
{
    const bed_case *c = &cases[5];
    const int64_t k = *(const int64_t *)context;
    clast_dem *dem = NULL;
    RANK_CHECK(make(c, &dem) == CLAST_OK);
    RANK_CHECK(clx_dem_share(dem, comm) == CLAST_OK);
    (void)clx_alloc_refuse(comm->rank == 1 ? k : 0);
    clast_status status = clast_dem_step(dem, 60);
    status = status == CLAST_OK ? clx_dem_gather_all(dem) : status;
    const bool was_used = clx_alloc_refuse(0) >= 0;
    RANK_CHECK(was_used && (status == CLAST_OK || status == CLAST_E_MEMORY));
    RANK_CHECK(comm->least(comm->context, status) == -comm->least(comm->context, -(int64_t)status));
    RANK_CHECK((status == CLAST_E_MEMORY) == (k < 1000));
    clast_dem_destroy(dem);
    return 0;
}

static void memory_refused_on_one_rank_ends_all(void **state)
{
    (void)state;
    for (int64_t k = 1; k <= 64; k += k < 40 ? 3 : 7) {
        support_run_ranks(2, run_refused, &k);
    }
    int64_t never = 1000000;
    support_run_ranks(2, run_refused, &never);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bed_is_the_same_on_ranks),
#ifdef CLAST_ALLOC_INJECT
        cmocka_unit_test(memory_refused_on_one_rank_ends_all),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
