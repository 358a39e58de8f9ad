/* Unit: whether a cloud has changed, and events of drifting clouds in cells that are kept. */
#include "drifting.h"
#include "support.h"

#include "math/rng.h"
#include <clast/agglomerate.h>
#include <clast/workspace.h>
#include <math.h>

enum { STEPS = 50 };

static clast_workspace *workspace_that_cuts(clast_cut_when cells)
{
    clast_workspace *workspace = NULL;
    clast_workspace_policy policy;
    CHECK_OK(clast_fields_default(clast_workspace_fields, &policy));
    policy.tests = CLAST_TESTS_NEVER;
    policy.cells = cells;
    CHECK_OK(clast_workspace_create(&workspace));
    CHECK_OK(clast_workspace_set_policy(workspace, &policy));
    return workspace;
}

/// Sum over steps of the squared error of events with cells that are kept, of one drifting cloud.
static double kept_square(drifting_kind kind, uint64_t seed, const clast_decompose_config *c)
{
    clast_domain domain = {0};
    drifting cloud = {0};
    double square = 0.0;
    clast_workspace_calls calls;
    clast_workspace *fresh = workspace_that_cuts(CLAST_CUT_EACH);
    clast_workspace *kept = workspace_that_cuts(CLAST_CUT_CHANGED);
    CHECK_OK(clast_domain_parse("box:0,0,0,1,1,1", &domain));
    CHECK_OK(drifting_start(kind, 4000, seed, &cloud));
    for (int k = 0; k < STEPS; ++k) {
        const clast_decomposition *a = NULL;
        const clast_decomposition *b = NULL;
        const clast_points points = {
            .n = cloud.n, .dimension = 3, .x = cloud.x, .stride = 3, .axis_stride = 1};
        CHECK_OK(clast_workspace_decompose_in(fresh, &domain, &points, c, &a));
        CHECK_OK(clast_workspace_decompose_in(kept, &domain, &points, c, &b));
        square += pow(b->events / a->events - 1.0, 2.0);
        drifting_advance(&cloud);
    }
    CHECK_OK(clast_workspace_count(kept, &calls));
    assert_true(calls.n_cut <= STEPS / 2);
    clast_workspace_destroy(fresh);
    clast_workspace_destroy(kept);
    drifting_free(&cloud);
    return square;
}

/* The errors that docs/theory/decompose.md section 15 tells, with seeds of their own: about 2 % in
 * clouds that move slowly, 12 to 15 % in a vortex that turns from uniform to steep, over three
 * clouds: one alone has 9 to 15 %. */
static void events_of_a_drifting_cloud_are_within_the_told_error(void **state)
{
    (void)state;
    clast_decompose_config c;
    CHECK_OK(clast_fields_default(clast_decompose_fields, &c));
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "mesh"), &c, "tree", false));
    c.beta_dt = 1e-18;
    for (int kind = 0; kind < N_DRIFTING; ++kind) {
        const int n_cloud = kind == DRIFTING_VORTEX ? 3 : 1;
        double square = 0.0;
        for (int k = 0; k < n_cloud; ++k) {
            square += kept_square((drifting_kind)kind, 777 + (uint64_t)k, &c);
        }
        const double error = sqrt(square / n_cloud / STEPS);
        assert_true(error < (kind == DRIFTING_VORTEX ? 0.15 : 0.05));
    }
    clast_fields_free(clast_decompose_fields, &c);
}

/* Independent uniform samples are called changed at the stated rate, 5 % of 1000: 4 standard
 * deviations are 2.8 %. A moved sample is found. */
static void change_test_has_its_level(void **state)
{
    (void)state;
    enum { N = 500, R = 1000 };
    static double u[2 * N * 2];
    int n_alarm = 0;
    double p = 0.0;
    clx_rng rng = clx_rng_at(11, CLX_STREAM_TEST, 0);
    for (int r = 0; r < R; ++r) {
        for (int i = 0; i < 4 * N; ++i) {
            u[i] = clx_rng_uniform(&rng);
        }
        CHECK_OK(clast_agglomeration_change_test(u, u + 2 * N, N, 2, &p));
        n_alarm += p < 0.05 ? 1 : 0;
    }
    CHECK_ABS((double)n_alarm / R, 0.05, 0.028);
    for (int i = 0; i < 2 * N; ++i) {
        u[2 * N + i] = u[i] * u[i];
    }
    CHECK_OK(clast_agglomeration_change_test(u, u + 2 * N, N, 2, &p));
    assert_true(p < 1e-6);
    CHECK_OK(clast_agglomeration_change_test(u, u, N, 2, &p));
    CHECK_REL(p, 1.0, 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(change_test_has_its_level),
        cmocka_unit_test(events_of_a_drifting_cloud_are_within_the_told_error)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
