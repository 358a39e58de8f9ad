/* Property: the same bytes with 1, 2 and 4 threads. 30,000 points take every parallel path but the
 * fuller chunks of a million; CLAST_POINTS=1200000 takes those too (a minute under sanitizers, so
 * `make paper-d2sd` asks for it). */
#include "support.h"

#include "math/rng.h"
#include <clast/decompose.h>
#include <clast/machine.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 2000000 };
static double x[3 * MOST];
static int64_t n_point = 30000;

/// FNV-1a over 8 bytes at a time.
static uint64_t hash(uint64_t h, const void *data, size_t size)
{
    const unsigned char *at = data;
    for (; size >= 8; size -= 8, at += 8) {
        uint64_t word = 0;
        memcpy(&word, at, 8);
        h = (h ^ word) * 1099511628211u;
    }
    for (; size > 0; --size) {
        h = (h ^ *at++) * 1099511628211u;
    }
    return h;
}

static uint64_t digest(const clast_decomposition *r)
{
    const size_t n = (size_t)r->cells.n;
    uint64_t h = 14695981039346656037u;
    h = hash(h, r->cells.of_point, (size_t)n_point * sizeof *r->cells.of_point);
    h = hash(h, r->cells.low, n * sizeof *r->cells.low);
    h = hash(h, r->cells.volume, n * sizeof *r->cells.volume);
    h = hash(h, r->cells.count, n * sizeof *r->cells.count);
    h = hash(h, r->cells.events, n * sizeof *r->cells.events);
    h = hash(h, &r->events_low, sizeof r->events_low);
    h = hash(h, &r->before.score, sizeof r->before.score);
    for (int k = 0; k < r->before.n_test; ++k) {
        h = hash(h, &r->before.vote[k].statistic, sizeof(double));
        h = hash(h, &r->before.vote[k].p, sizeof(double));
    }
    for (int k = 0; k < r->n_pass; ++k) {
        h = hash(h, &r->pass[k].score, sizeof(double));
        h = hash(h, &r->pass[k].lambda, sizeof(double));
    }
    return h;
}

static uint64_t run(const char *mesh, int32_t threads)
{
    const clast_cloud cloud = {.n = n_point, .dimension = 3, .x = x};
    clast_decompose_config c;
    clast_decomposition r = {0};
    CHECK_OK(clast_fields_default(clast_decompose_fields, &c));
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "domain"), &c,
                             "box:0,0,0,1,1,1", false));
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "mesh"), &c, mesh, false));
    c.max_pass = 1;
    clast_parallel_set_threads(threads);
    CHECK_OK(clast_decompose(&cloud, &c, &r));
    assert_true(r.before.reject && r.cells.n > 1000);
    const uint64_t h = digest(&r);
    clast_decomposition_free(&r);
    clast_fields_free(clast_decompose_fields, &c);
    return h;
}

static void check_threads(const char *mesh)
{
    const int32_t before = clast_parallel_threads();
    const uint64_t one = run(mesh, 1);
    assert_true(run(mesh, 2) == one);
    assert_true(run(mesh, 4) == one);
    clast_parallel_set_threads(before);
}

static int draw_points(void **state)
{
    (void)state;
    const char *wanted = getenv("CLAST_POINTS"); // NOLINT(concurrency-mt-unsafe): before threads
    if (wanted != NULL) {
        n_point = strtoll(wanted, NULL, 10);
        assert_in_range(n_point, 5000, MOST);
    }
    for (uint64_t i = 0; i < 3 * (uint64_t)n_point;
         ++i) { // half of the points in an eighth of the cube
        clx_rng rng = clx_rng_at(8, CLX_STREAM_TEST, i);
        const double at = clx_rng_uniform(&rng);
        x[i] = i / 3 % 2 == 0 ? at : 0.25 + 0.5 * at;
    }
    return 0;
}

static void tree_and_tests_have_the_same_bytes(void **state)
{
    (void)state;
    check_threads("auto");
}

static void boxes_have_the_same_bytes(void **state)
{
    (void)state;
    check_threads("boxes");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tree_and_tests_have_the_same_bytes),
        cmocka_unit_test(boxes_have_the_same_bytes),
    };
    return cmocka_run_group_tests(tests, draw_points, NULL);
}
