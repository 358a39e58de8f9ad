// Unit: one cloud over ranks is the same bytes as on one, however the points are dealt and ordered.
#include "ranks.h"
#include "support.h"

#include "base/alloc.h"
#include "base/comm.h"
#include "math/rng.h"
#include <clast/decompose.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MANY = 24000, N_DEAL = 5, MOST_RANKS = 4 }; // more than what is summed pair by pair

/// How points are dealt: in turn, in stretches, all to the last rank, by place, backwards in turn.
static int32_t dealt_to(int deal, int64_t i, const double *x, int32_t n_rank)
{
    switch (deal) {
    case 0:
    case 4:
        return (int32_t)(i % n_rank);
    case 1:
        return (int32_t)(i * n_rank / MANY);
    case 2:
        return n_rank - 1;
    default:
        return (int32_t)(x[1] * n_rank < n_rank ? x[1] * n_rank : n_rank - 1);
    }
}

/// Half of the points in a blob; some repeat a place, some share a coordinate.
static void place(int64_t i, int32_t d, double *x)
{
    const int64_t own = i % 50 == 7 && i > 0 ? i - 1 : i;
    clx_rng rng = clx_rng_at(11, CLX_STREAM_TEST, (uint64_t)own);
    for (int32_t j = 0; j < d; ++j) {
        x[j] = clx_rng_uniform(&rng);
        if (own % 2 == 0) {
            x[j] = 0.3 + 0.1 * (x[j] + clx_rng_uniform(&rng) + clx_rng_uniform(&rng));
        }
    }
    x[0] = own % 20 == 3 ? 0.5 : x[0];
}

/// A narrow plume, and one point in a hundred anywhere: more than a spline grid holds.
static void place_in_plume(int64_t i, int32_t d, double *x)
{
    clx_rng rng = clx_rng_at(11, CLX_STREAM_TEST, (uint64_t)i);
    for (int32_t j = 0; j < d; ++j) {
        x[j] = i % 100 == 0 ? clx_rng_uniform(&rng) : 0.5 + 0.01 * clx_rng_normal(&rng);
    }
}

typedef struct {
    int32_t d;
    int deal;
    clast_decompose_config config;
    const clast_domain *domain;
    const clast_cloud *whole;
    const clast_decomposition *expected;
} job;

/// This rank's points and their numbers in the whole.
static clast_cloud deal_points(const job *j, const clast_comm *comm, int64_t *number)
{
    clast_cloud part = {.dimension = j->d};
    part.x = malloc(MANY * 3 * sizeof *part.x);
    double *weight = j->whole->weight != NULL ? malloc(MANY * sizeof *weight) : NULL;
    double *variable = j->whole->variable != NULL ? malloc(MANY * sizeof *variable) : NULL;
    for (int64_t k = 0; k < MANY; ++k) {
        const int64_t i = j->deal == 4 ? MANY - 1 - k : k;
        const double *x = j->whole->x + i * j->d;
        if (dealt_to(j->deal, i, x, comm->n_rank) == comm->rank) {
            memcpy(part.x + part.n * j->d, x, (size_t)j->d * sizeof *x);
            if (weight != NULL) {
                weight[part.n] = j->whole->weight[i];
            }
            if (variable != NULL) {
                variable[part.n] = j->whole->variable[i];
            }
            number[part.n++] = i;
        }
    }
    part.weight = part.n > 0 ? weight : NULL; // a rank without points need not know of weights
    part.variable = part.n > 0 ? variable : NULL;
    if (part.n == 0) {
        free(weight);
        free(variable);
    }
    return part;
}

static bool are_same(const void *a, const void *b, int64_t n, size_t size)
{
    return (a == NULL) == (b == NULL) && (a == NULL || memcmp(a, b, (size_t)n * size) == 0);
}

static int compare_cells(const clast_cells *a, const clast_cells *b)
{
    RANK_CHECK(a->n == b->n);
    RANK_CHECK(are_same(a->low, b->low, a->n, sizeof *a->low));
    RANK_CHECK(are_same(a->high, b->high, a->n, sizeof *a->high));
    RANK_CHECK(are_same(a->volume, b->volume, a->n, sizeof *a->volume));
    RANK_CHECK(are_same(a->count, b->count, a->n, sizeof *a->count));
    RANK_CHECK(are_same(a->weight, b->weight, a->n, sizeof *a->weight));
    RANK_CHECK(are_same(a->events, b->events, a->n, sizeof *a->events));
    RANK_CHECK(are_same(a->key, b->key, a->n, sizeof *a->key));
    RANK_CHECK(are_same(a->group, b->group, a->n, sizeof *a->group));
    return 0;
}

static int compare_numbers(const clast_decomposition *a, const clast_decomposition *b)
{
    RANK_CHECK(a->n == b->n && a->n_outside == b->n_outside && a->n_test == b->n_test);
    RANK_CHECK(a->stop == b->stop && a->resolved == b->resolved && a->estimator == b->estimator);
    RANK_CHECK(a->before.n_test == b->before.n_test && a->before.n_reject == b->before.n_reject);
    for (int32_t k = 0; k < a->before.n_test; ++k) {
        RANK_CHECK(a->before.vote[k].statistic == b->before.vote[k].statistic);
        RANK_CHECK(a->before.vote[k].p == b->before.vote[k].p);
    }
    const double x[] = {a->before.score, a->before.ideal, a->events,        a->events_low,
                        a->events_high,  a->cells_bias,   a->points_needed, a->events_cross};
    const double y[] = {b->before.score, b->before.ideal, b->events,        b->events_low,
                        b->events_high,  b->cells_bias,   b->points_needed, b->events_cross};
    return memcmp(x, y, sizeof x) == 0 ? 0 : __LINE__;
}

static int compare_tables(const clast_table *a, const clast_table *b)
{
    RANK_CHECK(a->n_row == b->n_row && a->n_column == b->n_column);
    for (int32_t k = 0; k < a->n_column; ++k) {
        RANK_CHECK(are_same(a->column[k].number, b->column[k].number, a->n_row, sizeof(double)));
    }
    return 0;
}

static int compare_pairs(const clast_pairs *a, const clast_pairs *b)
{
    RANK_CHECK(a->n == b->n && a->n_outside == b->n_outside && a->n_pair == b->n_pair);
    RANK_CHECK(a->n_repeated == b->n_repeated && a->radius == b->radius);
    RANK_CHECK(compare_tables(&a->shells, &b->shells) == 0);
    RANK_CHECK(
        are_same(&a->integral.estimate.value, &b->integral.estimate.value, 3, sizeof(double)));
    return 0;
}

static int decompose_part(const clast_comm *comm, void *context)
{
    const job *j = context;
    clast_decomposition found = {0};
    int64_t *number = malloc(MANY * sizeof *number);
    clast_cloud part = deal_points(j, comm, number);
    RANK_CHECK(clast_decompose_ranks(comm, j->domain, &part, &j->config, &found) == CLAST_OK);
    RANK_CHECK(found.n_here == part.n);
    int line = compare_numbers(&found, j->expected);
    line = line != 0 ? line : compare_cells(&found.cells, &j->expected->cells);
    line = line != 0 ? line : compare_pairs(&found.pairs, &j->expected->pairs);
    line = line != 0 ? line : compare_tables(&found.search, &j->expected->search);
    RANK_CHECK(line == 0);
    for (int64_t i = 0; i < part.n; ++i) {
        RANK_CHECK(found.cells.of_point[i] == j->expected->cells.of_point[number[i]]);
    }
    clast_decomposition_free(&found);
    free(part.x);
    free(part.weight);
    free(part.variable);
    free(number);
    return 0;
}

/// A domain by its text, or an octahedron about the middle of the unit cube for NULL.
static void make_domain(const char *text, clast_domain *domain)
{
    double vert[6][3];
    int32_t tri[8][3];
    const clast_mesh mesh = {6, 8, vert, tri};
    for (int k = 0; k < 6; ++k) {
        for (int j = 0; j < 3; ++j) {
            vert[k][j] = j == k / 2 ? k % 2 : 0.5;
        }
    }
    for (int k = 0; k < 8; ++k) {
        const bool is_odd = ((k ^ k >> 1 ^ k >> 2) & 1) != 0;
        tri[k][0] = k & 1;
        tri[k][is_odd ? 1 : 2] = 2 + (k >> 1 & 1);
        tri[k][is_odd ? 2 : 1] = 4 + (k >> 2 & 1);
    }
    if (text != NULL) {
        CHECK_OK(clast_domain_parse(text, domain));
    } else {
        CHECK_OK(clast_domain_of_mesh(&mesh, 1.0, domain));
    }
}

typedef struct {
    const char *domain; ///< NULL: the octahedron
    int32_t d;
    bool is_weighted, has_pairs;
    int32_t cells; ///< clast_cell_kind
    bool is_crossed, is_varied;
    int32_t n_ghost_sample;
    bool is_plume;
} scene;

static const char cube[] = "box:0,0,0,1,1,1";

static void compare(const scene *s)
{
    const int32_t d = s->d;
    clast_cloud whole = {0};
    clast_domain space = {0};
    clast_decomposition expected = {0};
    job j = {.d = d, .domain = &space, .whole = &whole, .expected = &expected};
    CHECK_OK(clast_fields_default(clast_decompose_fields, &j.config));
    j.config.estimator = CLAST_ESTIMATOR_CELLS;
    j.config.outside = CLAST_OUTSIDE_DROP;
    j.config.mesh = s->cells;
    j.config.pairs = s->has_pairs;
    j.config.crossfit = s->is_crossed;
    j.config.ghost_samples = s->n_ghost_sample;
    CHECK_OK(clast_cloud_alloc(MANY, d, &whole));
    whole.weight = s->is_weighted ? calloc(MANY, sizeof *whole.weight) : NULL;
    whole.variable = s->is_varied ? calloc(MANY, sizeof *whole.variable) : NULL;
    for (int64_t i = 0; i < MANY; ++i) {
        clx_rng rng = clx_rng_at(12, CLX_STREAM_TEST, (uint64_t)i);
        (s->is_plume ? place_in_plume : place)(i, d, whole.x + i * d);
        if (s->is_weighted) {
            whole.weight[i] = exp(0.7 * clx_rng_normal(&rng));
        }
        if (s->is_varied) { // not known of some
            const double front = 200.0 * tanh(8.0 * (whole.x[i * d] - 0.6));
            whole.variable[i] = i % 97 == 5 ? (double)NAN : 900.0 + front + clx_rng_normal(&rng);
        }
    }
    make_domain(s->domain, &space);
    CHECK_OK(clast_decompose_in(&space, &whole, &j.config, &expected));
    assert_in_range(expected.cells.n, 8, MANY);
    static int n_scene = 0; // all deals of the first, one in turn of each other
    const int first = n_scene++;
    for (j.deal = first % N_DEAL; j.deal < N_DEAL; j.deal += first == 0 ? 1 : N_DEAL) {
        support_run_ranks(2 + (first + j.deal) % (MOST_RANKS - 1), decompose_part, &j);
    }
    clast_decomposition_free(&expected);
    free(whole.weight);
    free(whole.variable);
    whole.weight = NULL;
    whole.variable = NULL;
    clast_cloud_free(&whole);
    clast_domain_free(&space);
    clast_fields_free(clast_decompose_fields, &j.config);
}

static void a_cube_is_the_same_bytes(void **state)
{
    (void)state;
    compare(&(scene){cube, 3, false, true, .cells = CLAST_CELLS_AUTO});
}

static void a_plume_is_the_same_bytes(void **state)
{
    (void)state;
    compare(&(scene){cube, 3, .cells = CLAST_CELLS_TREE, .is_plume = true});
}

static void a_square_is_the_same_bytes(void **state)
{
    (void)state;
    compare(&(scene){"box:0,0,1,1", 2, false, true, .cells = CLAST_CELLS_AUTO});
}

/// Parcels whose weights spread over two decades: those tested, the sums of weights and of pairs.
static void weights_are_the_same_bytes(void **state)
{
    (void)state;
    compare(&(scene){cube, 3, true, false, .cells = CLAST_CELLS_TREE});
    compare(&(scene){"box:0,0,1,1", 2, true, false, .cells = CLAST_CELLS_BOXES});
}

/// Ghosts fill the box around it; cells are cut, and points on its faces find one.
static void a_closed_surface_is_the_same_bytes(void **state)
{
    (void)state;
    compare(&(scene){NULL, 3, false, true, .cells = CLAST_CELLS_TREE});
    compare(&(scene){NULL, 3, true, false, .cells = CLAST_CELLS_BOXES});
}

/// Edge weights of pairs that are no halves, in the axes of a domain that stands askew.
static void pairs_in_round_domains_are_the_same_bytes(void **state)
{
    (void)state;
    compare(&(scene){"sphere:0.5,0.5,0.5,0.6", 3, false, true, .cells = CLAST_CELLS_TREE});
    compare(
        &(scene){"cylinder:0.2,0.2,0.2,1,1,1,0.4,1.2", 3, false, true, .cells = CLAST_CELLS_TREE});
}

/// Halves are drawn by place and weight, and the weights of both are added without rounding.
static void cross_fitting_is_the_same_bytes(void **state)
{
    (void)state;
    compare(&(scene){cube, 3, false, false, .cells = CLAST_CELLS_TREE, .is_crossed = true});
    compare(
        &(scene){"box:0,0,1,1", 2, true, false, .cells = CLAST_CELLS_BOXES, .is_crossed = true});
}

/// Tree cells that are split for a temperature that is not known of all points.
static void a_variable_is_the_same_bytes(void **state)
{
    (void)state;
    compare(&(scene){"box:0,0,1,1", 2, true, false, .cells = CLAST_CELLS_TREE, .is_crossed = true,
                     .is_varied = true});
    compare(&(scene){NULL, 3, false, false, .cells = CLAST_CELLS_TREE, .is_varied = true});
}

/// Expected scores by sampling: depths of kept points and ghosts are sorted over the ranks.
static void ghost_samples_are_the_same_bytes(void **state)
{
    (void)state;
    compare(
        &(scene){"box:0,0,1,1", 2, false, false, .cells = CLAST_CELLS_BOXES, .n_ghost_sample = 2});
}

typedef struct {
    job own;
    const clast_table *table;
} sizes_job;

static const clast_decompose_parts three_sizes = {.n_size = 3, .regular = 9};

static int decompose_sizes(const clast_comm *comm, void *context)
{
    const sizes_job *j = context;
    clast_table table = {0};
    int64_t *number = malloc(MANY * sizeof *number);
    clast_cloud part = deal_points(&j->own, comm, number);
    RANK_CHECK(clast_decompose_sizes(comm, j->own.domain, &part, &three_sizes, &j->own.config,
                                     &table) == CLAST_OK);
    RANK_CHECK(compare_tables(&table, j->table) == 0);
    clast_table_free(&table);
    free(part.x);
    free(number);
    return 0;
}

/// Random parts of a cloud some of whose points repeat a place, beside a regular mesh.
static void events_by_number_are_the_same_bytes(void **state)
{
    (void)state;
    clast_cloud whole = {0};
    clast_domain space = {0};
    clast_table table = {0};
    sizes_job j = {{.d = 2, .deal = 3, .domain = &space, .whole = &whole}, &table};
    CHECK_OK(clast_fields_default(clast_decompose_fields, &j.own.config));
    j.own.config.outside = CLAST_OUTSIDE_DROP;
    CHECK_OK(clast_cloud_alloc(MANY, 2, &whole));
    for (int64_t i = 0; i < MANY; ++i) {
        place(i, 2, whole.x + i * 2);
    }
    make_domain("box:0,0,1,1", &space);
    CHECK_OK(clast_decompose_sizes(NULL, &space, &whole, &three_sizes, &j.own.config, &table));
    const double *n = clast_table_numbers(&table, "n");
    assert_true(n[0] == MANY / 4 && n[1] == MANY / 2 && n[2] == MANY);
    support_run_ranks(3, decompose_sizes, &j);
    clast_table_free(&table);
    clast_cloud_free(&whole);
    clast_domain_free(&space);
    clast_fields_free(clast_decompose_fields, &j.own.config);
}

/// What one rank fails with is what all say.
static int fail_together(const clast_comm *comm, void *context)
{
    clast_decompose_config *config = context;
    clast_domain domain = {0};
    clast_decomposition found = {0};
    double x[3] = {0.5, 0.5, 0.5};
    double weight = 2.0;
    clast_cloud part = {.n = comm->rank, .dimension = 3, .x = x}; // 0, 1: rank 0 has none
    RANK_CHECK(clast_domain_parse("box:0,0,0,1,1,1", &domain) == CLAST_OK);
    RANK_CHECK(clast_decompose_ranks(comm, &domain, &part, config, &found) == CLAST_OK);
    RANK_CHECK(found.n == 1 && found.cells.n == 1 && found.stop == CLAST_STOP_UNTESTED);
    clast_decomposition_free(&found);
    x[1] = comm->rank == 1 ? (double)NAN : 0.5;
    RANK_CHECK(clast_decompose_ranks(comm, &domain, &part, config, &found) == CLAST_E_FORMAT);
    RANK_CHECK(
        strcmp(clast_error_detail(), "rank 1: point 1 has a coordinate that is not finite") == 0);
    x[1] = 0.5;
    part.n = 1;
    part.weight = comm->rank == 1 ? &weight : NULL;
    RANK_CHECK(clast_decompose_ranks(comm, &domain, &part, config, &found) == CLAST_E_ARGUMENT);
    RANK_CHECK(strstr(clast_error_detail(), "1 of 2 points have weights") != NULL);
    part.weight = NULL;
    clast_comm poor = *comm;
    poor.sum = NULL;
    RANK_CHECK(clast_decompose_ranks(&poor, &domain, &part, config, &found) == CLAST_E_ARGUMENT);
    return 0;
}

static void what_fails_on_one_rank_fails_on_all(void **state)
{
    (void)state;
    clast_decompose_config config;
    CHECK_OK(clast_fields_default(clast_decompose_fields, &config));
    support_run_ranks(2, fail_together, &config);
    clast_fields_free(clast_decompose_fields, &config);
}

#ifdef CLAST_ALLOC_INJECT
enum { FEW = 30 };

typedef struct {
    const clast_domain *domain;
    const clast_decompose_config *config;
    bool is_weighted, is_sizes;
} refused_job;

static clast_status decompose_few(const clast_comm *comm, const refused_job *j)
{
    double x[2 * FEW];
    double weight[FEW];
    clast_cloud part = {.dimension = 2, .x = x, .weight = j->is_weighted ? weight : NULL};
    clast_decomposition found = {0};
    clast_table table = {0};
    clast_status status = CLAST_OK;
    for (int64_t i = 0; i < FEW; ++i) {
        if (i % comm->n_rank == comm->rank) {
            place(i, 2, x + 2 * part.n);
            weight[part.n++] = 1.0 + (double)(i % 3);
        }
    }
    if (j->is_sizes) {
        const clast_decompose_parts two = {.n_size = 2, .regular = 3};
        status = clast_decompose_sizes(comm, j->domain, &part, &two, j->config, &table);
    } else {
        status = clast_decompose_ranks(comm, j->domain, &part, j->config, &found);
    }
    clast_decomposition_free(&found);
    clast_table_free(&table);
    return status;
}

/// Rank 1 alone is refused its k-th block: each of the first, then ever sparser ones.
static int refuse_on_one(const clast_comm *comm, void *context)
{
    const refused_job *j = context;
    const int64_t before = clx_alloc_live();
    clast_status status = CLAST_E_MEMORY;
    for (int64_t k = 1; status != CLAST_OK; k += 1 + k / 24) {
        (void)clx_alloc_refuse(comm->rank == 1 ? k : 0);
        status = decompose_few(comm, j);
        (void)clx_alloc_refuse(0);
        RANK_CHECK(status == CLAST_OK || status == CLAST_E_MEMORY);
        RANK_CHECK(clx_comm_is_same(comm, status));
        RANK_CHECK(clx_alloc_live() == before);
    }
    return 0;
}

/// No rank waits for one that gave up, and none goes on without it.
static void memory_refused_to_one_rank_fails_on_all(void **state)
{
    (void)state;
    clast_decompose_config c;
    clast_domain domain = {0};
    refused_job j = {.domain = &domain, .config = &c};
    CHECK_OK(clast_fields_default(clast_decompose_fields, &c));
    CHECK_OK(clast_domain_parse("box:0,0,1,1", &domain));
    support_run_ranks(2, refuse_on_one, &j); // a tree, and pairs
    j.is_weighted = true;
    c.crossfit = true;
    support_run_ranks(2, refuse_on_one, &j);
    c.crossfit = false;
    c.mesh = CLAST_CELLS_COMPONENTS;
    c.variant = CLAST_VARIANT_FAST;
    c.ghost_samples = 1;
    support_run_ranks(2, refuse_on_one, &j);
    j.is_weighted = false;
    j.is_sizes = true;
    c.variant = CLAST_VARIANT_TEST;
    support_run_ranks(2, refuse_on_one, &j);
    clast_fields_free(clast_decompose_fields, &c);
}
#endif

/// Each rank has every n-th of 600 points, 100 of which repeat the place of another.
static int count_together(const clast_comm *comm, void *context)
{
    (void)context;
    double x[600];
    clast_cloud part = {.dimension = 1, .x = x};
    int64_t n_repeated = 0;
    clast_spacing alone = {0};
    clast_spacing together = {0};
    double all[600];
    for (int64_t i = 0; i < 600; ++i) {
        clx_rng rng = clx_rng_at(3, CLX_STREAM_TEST, (uint64_t)(i % 500));
        all[i] = clx_rng_uniform(&rng);
        if (i % comm->n_rank == comm->rank) {
            x[part.n++] = all[i];
        }
    }
    RANK_CHECK(clast_cloud_repeated_ranks(&part, comm, &n_repeated) == CLAST_OK);
    RANK_CHECK(n_repeated == 100);
    RANK_CHECK(clast_spacing_test(all, 600, 1, &alone) == CLAST_OK);
    RANK_CHECK(clast_spacing_ranks(comm, x, part.n, 1, &together) == CLAST_OK);
    RANK_CHECK(alone.ratio == together.ratio && alone.p == together.p && alone.z == together.z);
    return 0;
}

static void neighbours_and_copies_are_found_over_ranks(void **state)
{
    (void)state;
    for (int32_t n = 1; n <= 4; ++n) {
        support_run_ranks(n, count_together, NULL);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_is_the_same_bytes),
        cmocka_unit_test(a_plume_is_the_same_bytes),
        cmocka_unit_test(a_square_is_the_same_bytes),
        cmocka_unit_test(weights_are_the_same_bytes),
        cmocka_unit_test(a_closed_surface_is_the_same_bytes),
        cmocka_unit_test(pairs_in_round_domains_are_the_same_bytes),
        cmocka_unit_test(cross_fitting_is_the_same_bytes),
        cmocka_unit_test(a_variable_is_the_same_bytes),
        cmocka_unit_test(ghost_samples_are_the_same_bytes),
        cmocka_unit_test(events_by_number_are_the_same_bytes),
        cmocka_unit_test(what_fails_on_one_rank_fails_on_all),
#ifdef CLAST_ALLOC_INJECT
        cmocka_unit_test(memory_refused_to_one_rank_fails_on_all),
#endif
        cmocka_unit_test(neighbours_and_copies_are_found_over_ranks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
