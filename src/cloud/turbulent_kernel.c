// The cloud-turbulence kernel: radial relative velocity by bi-exponential correlations of the fluid
// seen by settling particles, radial distribution function by a fit to simulations. [Ayala2008b,
// sections 3 and 4; docs/theory/agglomeration.md section 1.2]
#include "cloud/turbulent_kernel.h"

#include "cloud/settling_pair.h"
#include <math.h>

/// Scales of the flow: the fluid's velocity correlation is
/// [b1 exp(-t/c1) - b2 exp(-t/c2)] [d1 exp(-r/e1) - d2 exp(-r/e2)].
typedef struct {
    double b[2], c[2], d[2], e[2];
    double variance;            ///< u'^2
    double re_lambda;           ///< Taylor-scale Reynolds number
    double a0;                  ///< normalised variance of acceleration
    double time, length, speed; ///< Kolmogorov's
} scales;

static scales scales_of(const clast_medium *m)
{
    const double nu = m->viscosity / m->density;
    const double u2 = m->speed_rms * m->speed_rms;
    const double eps = m->dissipation;
    scales s = {.variance = u2, .re_lambda = u2 * sqrt(15.0 / (eps * nu))};
    s.time = sqrt(nu / eps);
    s.length = pow(nu * nu * nu / eps, 0.25);
    s.speed = s.length / s.time;
    s.a0 = (11.0 + 7.0 * s.re_lambda) / (205.0 + s.re_lambda);
    const double integral_time = u2 / eps;
    const double integral_length = 0.5 * u2 * m->speed_rms / eps;
    const double taylor_time = s.time * sqrt(2.0 * s.re_lambda / (sqrt(15.0) * s.a0));
    const double taylor_length = m->speed_rms * sqrt(15.0 * nu / eps);
    const double z = taylor_time / integral_time;
    const double beta = sqrt(2.0) * taylor_length / integral_length;
    const double root_z = sqrt(1.0 - 2.0 * z * z);
    const double root_beta = sqrt(1.0 - 2.0 * beta * beta);
    for (int k = 0; k < 2; ++k) {
        const double sign = k == 0 ? 1.0 : -1.0;
        s.b[k] = 0.5 * (1.0 + sign * root_z) / root_z;
        s.c[k] = 0.5 * (1.0 + sign * root_z) * integral_time;
        s.d[k] = 0.5 * (1.0 + sign * root_beta) / root_beta;
        s.e[k] = 0.5 * (1.0 + sign * root_beta) * integral_length;
    }
    return s;
}

bool clx_turbulent_kernel_fits(const clast_medium *medium)
{
    const scales s = scales_of(medium);
    return isfinite(s.b[0]) && isfinite(s.d[0]) && isfinite(s.a0);
}

/// One particle's velocity variance for one pair of exponentials.
static double phi(double time, double length, double v, double tau)
{
    const double a = 1.0 / tau + 1.0 / time + v / length;
    return 1.0 / a - 0.5 * v / (length * a * a);
}

/// Covariance of two particles (1 settles at least as fast as 2) for one pair of exponentials.
static double psi(double time, double length, const double v[2], const double tau[2])
{
    const double w1 = v[0] / length;
    const double w2 = v[1] / length;
    const double r1 = 1.0 / tau[0] + 1.0 / time;
    const double r2 = 1.0 / tau[1] + 1.0 / time;
    const double a1 = w2 - r2;
    const double a2 = w1 + r1;
    const double a3 = w1 - w2 + 1.0 / tau[0] + 1.0 / tau[1];
    const double a5 = w2 + r2;
    const double a4 = w2 * w2 - r2 * r2;
    const double a6 = 1.0 / tau[0] - 1.0 / time + r2 * v[0] / v[1];
    return (1.0 / a1 - 1.0 / a2) * 0.5 * (w1 - w2) / (a3 * a3) +
           (4.0 / a4 - 1.0 / (a5 * a5) - 1.0 / (a1 * a1)) * 0.5 * w2 / a6 +
           (2.0 / a2 - 2.0 / a1 - w1 / (a2 * a2) + w2 / (a1 * a1)) * 0.5 / a3;
}

/// Sum over the four pairs of exponentials with signs.
static double single(const scales *s, double v, double tau)
{
    double sum = 0.0;
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            sum += (i == j ? 1.0 : -1.0) * s->b[i] * s->d[j] * phi(s->c[i], s->e[j], v, tau);
        }
    }
    return fmax(0.0, sum) * s->variance / tau;
}

static double joint(const scales *s, const double v[2], const double tau[2])
{
    double sum = 0.0;
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            sum += (i == j ? 1.0 : -1.0) * s->b[i] * s->d[j] * psi(s->c[i], s->e[j], v, tau);
        }
    }
    return sum * s->variance / (tau[0] * tau[1]);
}

/// Radial distribution function at contact. [Ayala2008b section 4]
static double clustering(const scales *s, double gravity, double contact, const double tau[2])
{
    const double st0 = tau[0] / s->time;
    const double st1 = tau[1] / s->time;
    const double st = fmax(st0, st1);
    const double g = gravity * s->time / s->speed; // over Kolmogorov's acceleration
    const double rise = st * (5.3406 + st * (-4.2942 + st * (1.5275 - 0.1988 * st)));
    const double power = fmax(0.0, rise) / pow(g, 0.1886 * exp(20.306 / s->re_lambda));
    const double drift = 20.115 * sqrt((s->a0 + CLAST_PI / 8.0 * g * g) / s->re_lambda);
    const double reach2 = drift * fabs(st1 - st0) * s->length * s->length;
    const double ratio = (s->length * s->length + reach2) / (contact * contact + reach2);
    return fmax(1.0, pow(ratio, 0.5 * power));
}

double clx_kolmogorov_length(const clast_medium *m)
{
    const double nu = m->viscosity / m->density;
    return pow(nu * nu * nu / m->dissipation, 0.25);
}

/// Settling speeds, the faster first, and response times.
static void order(const clast_medium *m, const clast_collider *a, const clast_collider *b,
                  double v[2], double tau[2])
{
    const double va = clx_settling_speed_of(m, a);
    const double vb = clx_settling_speed_of(m, b);
    const bool a_first = va >= vb;
    v[0] = a_first ? va : vb;
    v[1] = a_first ? vb : va;
    tau[0] = v[0] / m->gravity;
    tau[1] = v[1] / m->gravity;
}

/// <|w_r|>.
static double radial_speed(const scales *s, double contact, const double v[2], const double tau[2])
{
    const double along = s->d[0] * exp(-contact / s->e[0]) - s->d[1] * exp(-contact / s->e[1]);
    const double turbulent =
        single(s, v[0], tau[0]) + single(s, v[1], tau[1]) - 2.0 * along * joint(s, v, tau);
    const double settling = CLAST_PI / 8.0 * (v[0] - v[1]) * (v[0] - v[1]);
    return sqrt(2.0 / CLAST_PI * (fmax(0.0, turbulent) + settling));
}

double clx_turbulent_speed(const clast_medium *m, const clast_collider *a, const clast_collider *b)
{
    const scales s = scales_of(m);
    double v[2];
    double tau[2];
    order(m, a, b, v, tau);
    return 2.0 * radial_speed(&s, a->radius + b->radius, v, tau);
}

double clx_turbulent_kernel(const clast_medium *m, const clast_collider *a, const clast_collider *b)
{
    const scales s = scales_of(m);
    const double contact = a->radius + b->radius;
    double v[2];
    double tau[2];
    order(m, a, b, v, tau);
    const double speed = radial_speed(&s, contact, v, tau);
    return 2.0 * CLAST_PI * contact * contact * speed * clustering(&s, m->gravity, contact, tau);
}
