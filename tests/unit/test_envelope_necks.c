/* Unit: alpha and wrap about two unequal balls that touch, against closed forms. The stated errors
 * were set on other bodies (equal balls, boxes, three balls by sampling); these are not theirs. */
#include "support.h"

#include <clast/assembly.h>

/* A ball of radius R that touches both balls, of radii 1 and b, sits with its centre at (x, rho):
 * the circles where it touches bound the neck. */
typedef struct {
    double b, ball;
    double x, rho;
    double at[2], radius[2]; /* the circles */
} neck;

static neck neck_of(double b, double ball)
{
    neck n = {.b = b, .ball = ball};
    const double d = 1.0 + b;
    n.x = ((1.0 + ball) * (1.0 + ball) - (b + ball) * (b + ball) + d * d) / (2.0 * d);
    n.rho = sqrt((1.0 + ball) * (1.0 + ball) - n.x * n.x);
    n.at[0] = n.x / (1.0 + ball);
    n.radius[0] = n.rho / (1.0 + ball);
    n.at[1] = d - b * (d - n.x) / (b + ball);
    n.radius[1] = b * n.rho / (b + ball);
    return n;
}

static double cap(double r, double h)
{
    return CLAST_PI * h * h * (r - h / 3.0);
}

/* Both balls without the caps inside the neck. */
static double ends(const neck *n)
{
    const double b = n->b;
    const double balls = 4.0 / 3.0 * CLAST_PI * (1.0 + b * b * b);
    return balls - cap(1.0, 1.0 - n->at[0]) - cap(b, b - (1.0 + b - n->at[1]));
}

/* Between the circles the alpha shape is a frustum. */
static double alpha_volume(const neck *n)
{
    const double p = n->radius[0];
    const double q = n->radius[1];
    return ends(n) + CLAST_PI / 3.0 * (n->at[1] - n->at[0]) * (p * p + p * q + q * q);
}

/* Between the circles the wrap is bounded by the ball's own arc: pi (rho - sqrt(R^2 - t^2))^2 over
 * t from the ball's centre, whose integral is elementary. */
static double wrap_volume(const neck *n)
{
    const double r = n->ball;
    double sum = 0.0;
    for (int k = 0; k < 2; ++k) {
        const double t = n->at[k] - n->x;
        const double root = sqrt(r * r - t * t);
        const double half = 0.5 * (t * root + r * r * asin(t / r));
        const double value =
            n->rho * n->rho * t - 2.0 * n->rho * half + r * r * t - t * t * t / 3.0;
        sum += (k == 0 ? -1.0 : 1.0) * CLAST_PI * value;
    }
    return ends(n) + sum;
}

static void two_balls(double b, clast_assembly *a)
{
    static const double no_turn[4] = {1.0, 0.0, 0.0, 0.0};
    clast_shape shape = {0};
    CHECK_OK(clast_shape_sphere("ball", 1.0, &shape));
    CHECK_OK(clast_assembly_add_shape(a, &shape, NULL));
    CHECK_OK(clast_assembly_add_grain(a, 0, (double[3]){7.0, -3.0, 2.0}, no_turn, 1.0, 1.0));
    const double d = 1.0 + b;
    CHECK_OK(clast_assembly_add_grain(
        a, 0, (double[3]){7.0 + 0.36 * d, -3.0 + 0.48 * d, 2.0 - 0.8 * d}, no_turn, b, 1.0));
    clast_shape_free(&shape);
}

enum { N_BALL = 2 };
static const double smaller[N_BALL] = {0.8, 0.3};
static const double balls[N_BALL] = {0.5, 1.5};

static void closed_forms_lie_in_order(void **state)
{
    (void)state;
    for (int i = 0; i < N_BALL; ++i) {
        for (int k = 0; k < N_BALL; ++k) {
            const neck n = neck_of(smaller[i], balls[k]);
            const double b = smaller[i];
            const double solid = 4.0 / 3.0 * CLAST_PI * (1.0 + b * b * b);
            const double q = 1.0 / b; /* tangent spheres: hull = solid / (1 - phi) */
            const double hull =
                solid / (1.0 - q * q / (1.0 + q + q * q + q * q * q + q * q * q * q));
            assert_true(solid < wrap_volume(&n) && wrap_volume(&n) < alpha_volume(&n));
            assert_true(alpha_volume(&n) < hull);
        }
    }
    const neck far = neck_of(0.5, 20.0); /* a great ball: both go to the hull, 8/7 + phi's */
    const double hull = 4.0 / 3.0 * CLAST_PI * 1.125 / (1.0 - 4.0 / 31.0);
    assert_true(alpha_volume(&far) > 0.99 * hull && wrap_volume(&far) > 0.99 * hull);
}

static void necks_lie_within_the_stated_errors(void **state)
{
    (void)state;
    for (int i = 0; i < N_BALL; ++i) {
        clast_assembly a = {0};
        two_balls(smaller[i], &a);
        for (int k = 0; k < N_BALL; ++k) {
            const neck n = neck_of(smaller[i], balls[k]);
            clast_envelope_options options = clast_envelope_options_default();
            clast_envelope e = {0};
            options.length = balls[k];
            options.n_cell = 36;
            CHECK_OK(clast_assembly_envelope(&a, CLAST_ENVELOPE_ALPHA, &options, &e));
            CHECK_ABS(e.volume, alpha_volume(&n), e.error);
            assert_true(e.error < 0.1 * e.volume);
            CHECK_OK(clast_assembly_envelope(&a, CLAST_ENVELOPE_WRAP, &options, &e));
            CHECK_ABS(e.volume, wrap_volume(&n), e.error);
            assert_true(e.error < 0.1 * e.volume);
        }
        clast_assembly_free(&a);
    }
}

static clast_status make_alpha(void *context)
{
    clast_envelope_options options = clast_envelope_options_default();
    clast_envelope e = {0};
    options.length = 2.0;
    return clast_assembly_envelope(context, CLAST_ENVELOPE_ALPHA, &options, &e);
}

static clast_status make_wrap(void *context)
{
    clast_envelope_options options = clast_envelope_options_default();
    clast_envelope e = {0};
    options.length = 1.0;
    options.n_cell = 12;
    return clast_assembly_envelope(context, CLAST_ENVELOPE_WRAP, &options, &e);
}

static void envelopes_survive_refused_memory(void **state)
{
    (void)state;
    clast_assembly a = {0};
    two_balls(0.5, &a);
    support_refuse_each_allocation(make_alpha, &a);
    support_refuse_each_allocation(make_wrap, &a);
    clast_assembly_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_forms_lie_in_order),
        cmocka_unit_test(necks_lie_within_the_stated_errors),
        cmocka_unit_test(envelopes_survive_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
