/* Unit: symmetric 3x3 eigen-problems with known answers, the equal and nearly equal ones among
 * them. */
#include "support.h"

#include "math/rng.h"
#include "math/sym3.h"
#include "math/vec3.h"

/* R diag(d) R^T of a random rotation. */
static void compose(const double d[3], uint64_t index, double a[3][3])
{
    double q[4];
    double m[3][3];
    clx_rng rng = clx_rng_at(5, CLX_STREAM_TEST, index);
    clx_rng_orientation(&rng, q);
    q_matrix(m, q);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            a[i][j] =
                m[i][0] * d[0] * m[j][0] + m[i][1] * d[1] * m[j][1] + m[i][2] * d[2] * m[j][2];
        }
    }
}

/* Every claim of the header for one matrix, relative to its greatest eigenvalue. */
static void check(double a[3][3], const double expected[3])
{
    double value[3];
    double vector[3][3];
    double cross[3];
    const double size = fmax(fabs(expected[0]), fabs(expected[2]));
    clx_sym3_eigen(a, value, vector);
    for (int k = 0; k < 3; ++k) {
        double image[3];
        CHECK_ABS(value[k], expected[k], 4e-15 * size);
        CHECK_ABS(v3_norm(vector[k]), 1.0, 2e-15);
        m3_mul(image, a, vector[k]);
        v3_axpy(image, image, -value[k], vector[k]);
        CHECK_ABS(v3_norm(image), 0.0, 6e-15 * size);
    }
    v3_cross(cross, vector[0], vector[1]);
    CHECK_ABS(v3_dot(cross, vector[2]), 1.0, 4e-15);
}

static void random_frames_give_their_eigenvalues_back(void **state)
{
    (void)state;
    static const double cases[][3] = {
        {3.0, 2.0, 1.0},         {1.0, 1.0, 1.0},        {2.0, 2.0, 1.0},
        {2.0, 1.0, 1.0},         {1.0 + 1e-8, 1.0, 1.0}, {1.0 + 1e-15, 1.0, 1.0 - 1e-15},
        {1.0, 1e-8, 1e-16},      {1.0, 0.0, 0.0},        {5.0, 0.0, -5.0},
        {-1.0, -2.0, -3.0},      {1e-30, 5e-31, 1e-31},  {1e140, 1e139, 1e138},
        {1e-140, 2e-141, 1e-141}};
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; ++c) {
        for (uint64_t trial = 0; trial < 200; ++trial) {
            double a[3][3];
            compose(cases[c], 1000 * c + trial, a);
            check(a, cases[c]);
        }
    }
}

static void textbook_matrix_has_textbook_eigenvalues(void **state)
{
    (void)state;
    /* Second differences: 2 + sqrt 2, 2, 2 - sqrt 2. */
    double a[3][3] = {{2, -1, 0}, {-1, 2, -1}, {0, -1, 2}};
    check(a, (double[3]){2.0 + sqrt(2.0), 2.0, 2.0 - sqrt(2.0)});
    double diagonal[3][3] = {{1, 0, 0}, {0, 3, 0}, {0, 0, 2}};
    check(diagonal, (double[3]){3.0, 2.0, 1.0});
    double zero[3][3] = {{0}};
    check(zero, (double[3]){0.0, 0.0, 0.0});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_frames_give_their_eigenvalues_back),
        cmocka_unit_test(textbook_matrix_has_textbook_eigenvalues),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
