/* Unit: sums without rounding, against closed forms and against any order of the same terms. */
#include "ranks.h"
#include "support.h"

#include "math/exact_sum.h"
#include "math/fixed_sum.h"
#include "math/rng.h"
#include <float.h>
#include <math.h>

static double sum_of(const double *term, int n)
{
    clx_exact_sum s = {{0}, 0};
    for (int i = 0; i < n; ++i) {
        clx_exact_add(&s, term[i]);
    }
    return clx_exact_value(&s);
}

/* What plain addition loses: 1 between +-1e300, the least number beside the largest. */
static void nothing_is_lost(void **state)
{
    (void)state;
    const double cancel[] = {1e300, 1.0, -1e300, 0x1p-1074, -0x1p-1074};
    const double least[] = {DBL_MAX, 0x1p-1074, -DBL_MAX};
    const double third[] = {0.1, 0.2, -0.3};
    assert_true(sum_of(cancel, 5) == 1.0);
    assert_true(sum_of(least, 3) == 0x1p-1074);
    assert_true(sum_of(third, 3) == 0x1p-55); // by the three numbers' own bits; plainly 2^-54
    assert_true(sum_of(NULL, 0) == 0.0);
    const double far[] = {DBL_MAX, DBL_MAX};
    assert_true(isinf(sum_of(far, 2)));
}

/* Ties go to the even number, and any bit below decides. */
static void the_value_is_rounded_once(void **state)
{
    (void)state;
    const double tie[] = {1.0, 0x1p-53};
    const double above[] = {1.0, 0x1p-53, 0x1p-1000};
    const double odd[] = {1.0, 0x1p-52, 0x1p-53};
    const double below[] = {-1.0, -0x1p-53, 0x1p-900};
    assert_true(sum_of(tie, 2) == 1.0);
    assert_true(sum_of(above, 3) == 1.0 + 0x1p-52);
    assert_true(sum_of(odd, 3) == 1.0 + 0x1p-51);
    assert_true(sum_of(below, 3) == -1.0);
    for (int e = -1070; e <= 1020; ++e) { // every shift within a digit
        const double x[] = {ldexp(1.0, e), ldexp(3.0, e), -ldexp(1.0, e + 1)};
        assert_true(sum_of(x, 3) == ldexp(1.0, e + 1));
    }
}

static double term_of(uint64_t i)
{
    clx_rng rng = clx_rng_at(9, CLX_STREAM_TEST, i);
    const double u = clx_rng_uniform(&rng) - 0.5;
    return u * pow(10.0, 40.0 * clx_rng_uniform(&rng) - 20.0);
}

enum { MANY = 20000 };

/// Each rank adds every n-th term, from the last on.
static int add_own(const clast_comm *comm, void *context)
{
    clx_exact_sum s[2] = {{{0}, 0}, {{0}, 0}};
    for (int64_t i = MANY - 1 - comm->rank; i >= 0; i -= comm->n_rank) {
        clx_exact_add(&s[i % 2], term_of((uint64_t)i));
    }
    clx_exact_over(comm, s, 2);
    clx_exact_merge(&s[0], &s[1]);
    RANK_CHECK(clx_exact_value(&s[0]) == *(const double *)context);
    return 0;
}

static void any_order_on_any_ranks_is_the_same_sum(void **state)
{
    (void)state;
    clx_exact_sum s = {{0}, 0};
    for (uint64_t i = 0; i < MANY; ++i) {
        clx_exact_add(&s, term_of(i));
    }
    double value = clx_exact_value(&s);
    for (int32_t n = 1; n <= 4; ++n) {
        support_run_ranks(n, add_own, &value);
    }
}

/* Powers of weights over twelve decades: in any order the same two words, whose value is the exact
   sum's to rounding. */
static void fixed_sums_know_no_order(void **state)
{
    (void)state;
    enum { N = 1000 };
    static clx_fixed_sum forth[4];
    static clx_fixed_sum back[4];
    clx_exact_sum exact[4] = {{{0}, 0}};
    const clx_fixed_scale scale = clx_fixed_scale_of(1e6, N);
    for (int i = 0; i < N; ++i) {
        clx_fixed_sum power[4];
        const double w = pow(10.0, 6.0 - 12.0 * i / N);
        clx_fixed_powers(&scale, w, 4, power);
        for (int k = 0; k < 4; ++k) {
            clx_fixed_add(&forth[k], &power[k]);
            clx_exact_add(&exact[k], pow(w, k + 1));
        }
        clx_fixed_powers(&scale, pow(10.0, 6.0 - 12.0 * (N - 1 - i) / N), 4, power);
        for (int k = 0; k < 4; ++k) {
            clx_fixed_add(&back[k], &power[k]);
        }
    }
    for (int k = 0; k < 4; ++k) {
        assert_true(forth[k].word[0] == back[k].word[0] && forth[k].word[1] == back[k].word[1]);
        CHECK_REL(clx_fixed_value(&scale, &forth[k], k + 1), clx_exact_value(&exact[k]), 1e-15);
    }
}

/* Parcels below one unit of the first word, 2^-52 of the heaviest one's power, are carried by the
   second word alone; those below one of its units, 2^-104, are lost: the sum is low by less than
   one unit of it a parcel. */
static void the_lightest_parcels_count_in_the_second_word(void **state)
{
    (void)state;
    enum { N = 1000 };
    const clx_fixed_scale scale = clx_fixed_scale_of(1.0, N);
    assert_int_equal(scale.bits, 52);
    const double light = ldexp(1.0, -60);
    const double dust = ldexp(1.0, -104); // half a unit: the heaviest is half of what fits
    clx_fixed_sum power[2];
    clx_fixed_sum own[2] = {{{0}}};
    for (int i = 0; i < N; ++i) {
        clx_fixed_powers(&scale, light, 2, power);
        assert_true(power[0].word[0] == 0 && power[0].word[1] == INT64_C(1) << 43);
        assert_true(power[1].word[0] == 0 && power[1].word[1] == 0); // its square, 2^-120
        clx_fixed_add(&own[0], &power[0]);
        clx_fixed_add(&own[1], &power[1]);
    }
    assert_true(clx_fixed_value(&scale, &own[0], 1) == N * light);
    assert_true(clx_fixed_value(&scale, &own[1], 2) == 0.0);
    clx_fixed_powers(&scale, dust, 1, power);
    assert_true(power[0].word[0] == 0 && power[0].word[1] == 0);
    clx_fixed_powers(&scale, 2.0 * dust, 1, power);
    assert_true(power[0].word[0] == 0 && power[0].word[1] == 1);
    clx_fixed_powers(&scale, 1.0, 1, power); // the heaviest beside them: all of the light ones stay
    clx_fixed_add(&own[0], &power[0]);
    assert_true(own[0].word[0] == INT64_C(1) << 51);
    assert_true(own[0].word[1] == N * (INT64_C(1) << 43));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_lost),
        cmocka_unit_test(the_value_is_rounded_once),
        cmocka_unit_test(any_order_on_any_ranks_is_the_same_sum),
        cmocka_unit_test(fixed_sums_know_no_order),
        cmocka_unit_test(the_lightest_parcels_count_in_the_second_word),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
