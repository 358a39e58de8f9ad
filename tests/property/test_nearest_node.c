/* Property: the transform finds a nearest marked node, as looking at all of them does. */
#include "support.h"

#include "geom/nearest_node.h"
#include "math/rng.h"
#include <stdlib.h>

static int32_t distance2(const int32_t n[3], int32_t p, int32_t q)
{
    const int32_t dx = p % n[0] - q % n[0];
    const int32_t dy = p / n[0] % n[1] - q / n[0] % n[1];
    const int32_t dz = p / n[0] / n[1] - q / n[0] / n[1];
    return dx * dx + dy * dy + dz * dz;
}

static void finds_a_nearest_node(void **state)
{
    (void)state;
    static const int32_t size[4][3] = {{7, 9, 11}, {1, 5, 8}, {20, 1, 1}, {6, 6, 6}};
    for (int trial = 0; trial < 24; ++trial) {
        const int32_t *n = size[trial % 4];
        const int32_t total = n[0] * n[1] * n[2];
        uint8_t *marked = calloc((size_t)total, 1);
        int32_t *nearest = calloc((size_t)total, sizeof *nearest);
        clx_rng rng = clx_rng_at(8, CLX_STREAM_TEST, (uint64_t)trial);
        for (int k = 0; k < trial / 4 * 3; ++k) {
            marked[clx_rng_below(&rng, total)] = 1;
        }
        CHECK_OK(clx_nearest_node(n, marked, nearest));
        for (int32_t p = 0; p < total; ++p) {
            int32_t best = INT32_MAX;
            for (int32_t q = 0; q < total; ++q) {
                if (marked[q] != 0 && distance2(n, p, q) < best) {
                    best = distance2(n, p, q);
                }
            }
            if (best == INT32_MAX) {
                assert_int_equal(nearest[p], -1);
            } else {
                assert_int_equal(marked[nearest[p]], 1);
                assert_int_equal(distance2(n, p, nearest[p]), best);
            }
        }
        free(marked);
        free(nearest);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(finds_a_nearest_node)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
