/* Unit: how a sweep is divided: every grain once whoever is fast, shares by pace, what is deferred.
 */
#include "support.h"

#include "dem/chunk.h"
#include "dem_scenes.h"
#include <clast/machine.h>
#include <string.h>

enum { N = 4000, WORKERS = 3 };

/* A bed that has moved, with its inner list. */
static clast_dem *make(void)
{
    clast_parallel_set_threads(1); // which learns no pace
    clast_dem *dem = scene_pour(N, 3e-3, 8e-3, 0.15);
    assert_non_null(dem);
    CHECK_OK(clast_dem_step(dem, 40));
    if (dem->inner.is_due || dem->list.is_due) {
        CHECK_OK(clast_dem_step(dem, 1));
    }
    CHECK_OK(clx_chunks_weigh(dem, WORKERS));
    return dem;
}

/* Notes grains [begin, end), each of which must be new. */
static void see(uint8_t *is_seen, int64_t begin, int64_t end)
{
    assert_true(begin >= 0 && begin < end && end <= N);
    for (int64_t g = begin; g < end; ++g) {
        assert_int_equal(is_seen[g], 0);
        is_seen[g] = 1;
    }
}

/* The chunk's next blocks, at most n times. */
static void go_on(clx_chunk *chunk, int n, uint8_t *is_seen)
{
    int64_t g[2];
    for (int k = 0; k < n && clx_chunk_next(chunk, &g[0], &g[1]); ++k) {
        see(is_seen, g[0], g[1]);
    }
}

/* Worker 1 does its chunk, then that of worker 2, who never comes, then takes what it can of worker
 * 0, who is slow; both go on in turn. */
static void every_grain_is_swept_once(void **state)
{
    (void)state;
    static uint8_t is_seen[N];
    clast_dem *dem = make();
    clx_sweeping *s = &dem->sweeping;
    int n_claimed = 0;
    memset(is_seen, 0, sizeof is_seen);
    clx_chunks_begin(dem);
    clx_chunk *slow = clx_chunk_claim(s, 0);
    assert_non_null(slow);
    assert_int_equal(slow->begin, 0);
    go_on(slow, 1, is_seen);
    for (clx_chunk *c = clx_chunk_claim(s, 1); c != NULL; c = clx_chunk_claim(s, 1)) {
        ++n_claimed;
        go_on(slow, 1, is_seen);
        go_on(c, N, is_seen);
    }
    assert_true(n_claimed > 2); // its own, worker 2's, and a part of worker 0's
    go_on(slow, N, is_seen);
    assert_null(clx_chunk_claim(s, 0));
    assert_null(clx_chunk_claim(s, 2));
    for (int g = 0; g < N; ++g) {
        assert_int_equal(is_seen[g], 1);
    }
    clx_chunks_end(dem);
    for (int32_t c = 1; c < s->n_chunk; ++c) {
        assert_true(s->chunk[c].begin >= s->chunk[c - 1].begin);
    }
    clast_dem_destroy(dem);
}

/* A thread that was three times as fast begins with three times the work. */
static void shares_follow_paces(void **state)
{
    (void)state;
    clast_dem *dem = make();
    clx_sweeping *s = &dem->sweeping;
    const double seconds[WORKERS] = {1.0, 3.0, 1.0};
    clx_chunks_begin(dem);
    const double all = (double)s->before[(N + CLX_SWEEP_BLOCK - 1) / CLX_SWEEP_BLOCK];
    for (int32_t w = 0; w < WORKERS; ++w) {
        const double work = (double)s->before[s->chunk[w].begin / CLX_SWEEP_BLOCK];
        CHECK_ABS(work / all, w / 3.0, 0.03); // as long as no pace is known
        clx_chunk_pace(s, w, 1000, seconds[w]);
    }
    clx_chunks_end(dem);
    clx_chunks_begin(dem);
    CHECK_ABS((double)s->before[s->chunk[1].begin / CLX_SWEEP_BLOCK] / all, 3.0 / 7.0, 0.03);
    CHECK_ABS((double)s->before[s->chunk[2].begin / CLX_SWEEP_BLOCK] / all, 4.0 / 7.0, 0.03);
    clast_dem_destroy(dem);
}

/* A grain is deferred where a pair leads to it, or to one of its four, from before the border. */
static void grains_with_pairs_of_earlier_chunks_are_deferred(void **state)
{
    (void)state;
    static int32_t lowest[N];
    clast_dem *dem = make();
    int n_deferred = 0;
    for (int g = 0; g < N; ++g) {
        lowest[g] = INT32_MAX;
    }
    for (int32_t k = 0; k < dem->inner.n; ++k) {
        const clx_dem_pair *pair = clx_inner_pair(dem, k);
        for (int32_t g = pair->b / CLX_LANES * CLX_LANES;
             pair->b >= 0 && g < N && g / CLX_LANES == pair->b / CLX_LANES; ++g) {
            lowest[g] = pair->a < lowest[g] ? pair->a : lowest[g];
        }
    }
    for (int32_t border = 0; border < N; border += 10 * CLX_SWEEP_BLOCK) {
        for (int32_t g = border; g < N; ++g) {
            assert_int_equal(clx_is_deferred(&dem->sweeping, g, border), lowest[g] < border);
            n_deferred += lowest[g] < border ? 1 : 0;
        }
    }
    assert_true(n_deferred > 0);
    clast_dem_destroy(dem);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_grain_is_swept_once),
        cmocka_unit_test(shares_follow_paces),
        cmocka_unit_test(grains_with_pairs_of_earlier_chunks_are_deferred),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
