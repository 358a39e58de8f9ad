/* Unit: signs of determinants that rounding gets wrong, against integers that cannot round. */
#include "support.h"

#include "math/predicates.h"
#include "math/rng.h"

static int sign(double x)
{
    return (x > 0.0) - (x < 0.0);
}

static void orientation_has_the_stated_sign(void **state)
{
    (void)state;
    const double a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0, 1, 0};
    const double above[3] = {0.2, 0.2, 1e-300}, below[3] = {0.2, 0.2, -1.0}, on[3] = {7, 9, 0};
    assert_true(clx_orient3d(a, b, c, above) < 0.0);
    assert_true(clx_orient3d(a, b, c, below) > 0.0);
    assert_true(clx_orient3d(a, b, c, on) == 0.0);
    assert_true(clx_orient2d(a, b, c) > 0.0);
    assert_true(clx_orient2d(a, c, b) < 0.0);
}

/* Points whose coordinates are small integers times one part of a double: the same determinant in
 * 128-bit integers has no rounding. */
static void orientation_agrees_with_integers(void **state)
{
    (void)state;
#ifndef __SIZEOF_INT128__
    skip();
#else
    clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, 7);
    int n_zero = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        /* Nearly coplanar on a big lattice: d = a + i (b - a) + j (c - a) + one step now and then.
         */
        int64_t p[4][3];
        double x[4][3];
        const int64_t i = clx_rng_below(&rng, 5) - 2;
        const int64_t j = clx_rng_below(&rng, 5) - 2;
        for (int k = 0; k < 3; ++k) {
            for (int v = 0; v < 3; ++v) {
                p[v][k] = clx_rng_below(&rng, (int64_t)1 << 35) - ((int64_t)1 << 34);
            }
            p[3][k] = p[0][k] + i * (p[1][k] - p[0][k]) + j * (p[2][k] - p[0][k]);
        }
        p[3][clx_rng_below(&rng, 3)] += clx_rng_below(&rng, 3) - 1;
        for (int v = 0; v < 4; ++v) {
            for (int k = 0; k < 3; ++k) {
                x[v][k] = (double)p[v][k] * 0x1p-60;
            }
        }
        __extension__ typedef __int128 wide;
        wide m[3][3];
        for (int v = 0; v < 3; ++v) {
            for (int k = 0; k < 3; ++k) {
                m[v][k] = p[v][k] - p[3][k];
            }
        }
        const wide det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
        assert_int_equal(sign(clx_orient3d(x[0], x[1], x[2], x[3])), (det > 0) - (det < 0));
        n_zero += det == 0;
    }
    assert_in_range(n_zero, 1000, 19000); /* both kinds were asked */
#endif
}

static void orientation_sees_the_last_bit(void **state)
{
    (void)state;
    const double a[3] = {0.1, 0.1, 0.1}, b[3] = {0.3, 0.3, 0.3}, c[3] = {0.7, 0.2, 0.9};
    double d[3] = {0.5, 0.5, 0.5};
    /* 0.1, 0.3, 0.5 times (1, 1, 1): collinear whatever their rounding. */
    assert_true(clx_orient3d(a, b, c, d) == 0.0);
    d[1] = nextafter(d[1], 1.0);
    const int up = sign(clx_orient3d(a, b, c, d));
    d[1] = nextafter(0.5, 0.0);
    assert_int_equal(up * up, 1);
    assert_int_equal(sign(clx_orient3d(a, b, c, d)), -up);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orientation_has_the_stated_sign),
        cmocka_unit_test(orientation_agrees_with_integers),
        cmocka_unit_test(orientation_sees_the_last_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
