// Collision kernels in one table: name, formula, needs, source. [docs/theory/agglomeration.md]
#include <clast/kernel.h>

#include "base/status.h"
#include "cloud/settling_pair.h"
#include "cloud/turbulent_kernel.h"
#include <clast/settling.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double BOLTZMANN = 1.380649e-23; // [J/K], exact since 2019

typedef double (*rate)(const clast_medium *m, const clast_collider *a, const clast_collider *b);

static double constant(const clast_medium *m, const clast_collider *a, const clast_collider *b)
{
    (void)a;
    (void)b;
    return m->constant;
}

static double additive(const clast_medium *m, const clast_collider *a, const clast_collider *b)
{
    return m->additive * (a->monomers + b->monomers);
}

static double product(const clast_medium *m, const clast_collider *a, const clast_collider *b)
{
    return m->product * a->monomers * b->monomers;
}

static double contact(const clast_collider *a, const clast_collider *b)
{
    return a->radius + b->radius;
}

static double slip(const clast_medium *m, const clast_collider *a)
{
    return m->mean_free_path > 0.0 ? clast_slip_correction(m->mean_free_path / a->radius) : 1.0;
}

static double diffusion(const clast_medium *m, const clast_collider *a)
{
    return BOLTZMANN * m->temperature * slip(m, a) / (6.0 * CLAST_PI * m->viscosity * a->radius);
}

static double brownian(const clast_medium *m, const clast_collider *a, const clast_collider *b)
{
    return 4.0 * CLAST_PI * (diffusion(m, a) + diffusion(m, b)) * contact(a, b);
}

static double brownian_free(const clast_medium *m, const clast_collider *a, const clast_collider *b)
{
    const double r = contact(a, b);
    return r * r *
           sqrt(8.0 * CLAST_PI * BOLTZMANN * m->temperature * (1.0 / a->mass + 1.0 / b->mass));
}

/// Dahneke's bridge: Kn = 2 D / (c R), continuum (1 + Kn) / (1 + 2 Kn (1 + Kn)).
static double brownian_transition(const clast_medium *m, const clast_collider *a,
                                  const clast_collider *b)
{
    const double slow = brownian(m, a, b);
    const double kn = 0.5 * slow / brownian_free(m, a, b); // 4 pi D R / (2 pi R^2 c)
    return slow * (1.0 + kn) / (1.0 + 2.0 * kn * (1.0 + kn));
}

static double shear_laminar(const clast_medium *m, const clast_collider *a, const clast_collider *b)
{
    const double r = contact(a, b);
    return 4.0 / 3.0 * m->shear * r * r * r;
}

static double shear_turbulent(const clast_medium *m, const clast_collider *a,
                              const clast_collider *b)
{
    const double r = contact(a, b);
    if (m->shear_constant > 0.0) {
        return m->shear_constant * sqrt(m->dissipation * m->density / m->viscosity) * r * r * r;
    }
    return sqrt(8.0 * CLAST_PI / 15.0 * m->dissipation * m->density / m->viscosity) * r * r * r;
}

static double settling(const clast_medium *m, const clast_collider *a, const clast_collider *b)
{
    const double r = contact(a, b);
    return CLAST_PI * r * r * clast_kernel_collision_efficiency(m, a, b) *
           fabs(clx_settling_speed_of(m, a) - clx_settling_speed_of(m, b));
}

static double inertial(const clast_medium *m, const clast_collider *a, const clast_collider *b)
{
    const double r = contact(a, b);
    return sqrt(8.0 * CLAST_PI * (clx_velocity_variance(m, a) + clx_velocity_variance(m, b))) * r *
           r;
}

static double ballistic(const clast_medium *m, const clast_collider *a, const clast_collider *b)
{
    const double r = contact(a, b);
    double speed2 = 0.0;
    (void)m;
    for (int k = 0; k < 3; ++k) {
        const double v = a->velocity[k] - b->velocity[k];
        speed2 += v * v;
    }
    return CLAST_PI * r * r * sqrt(speed2);
}

#define SOLID      (CLAST_NEEDS_RADIUS | CLAST_NEEDS_MASS)
#define FALLS      (SOLID | CLAST_NEEDS_VISCOSITY | CLAST_NEEDS_DENSITY | CLAST_NEEDS_SETTLING)
#define TURBULENCE CLAST_MECHANISM_TURBULENCE
static const clast_kernel_info info[CLAST_N_KERNEL] = {
    [CLAST_KERNEL_CONSTANT] = {"constant", "K", "Smoluchowski 1916", 0, 0, true},
    [CLAST_KERNEL_ADDITIVE] = {"additive", "b (i + j)", "Golovin 1963", 0, 0, true},
    [CLAST_KERNEL_PRODUCT] = {"product", "c i j", "McLeod 1962", 0, 0, true},
    [CLAST_KERNEL_BROWNIAN] =
        {"brownian",
         "4 pi (D1 + D2) (a1 + a2), D = k T C / (6 pi mu a), C slip (1 without a mean free path)",
         "Smoluchowski 1917; slip Davies 1945",
         CLAST_NEEDS_RADIUS | CLAST_NEEDS_TEMPERATURE | CLAST_NEEDS_VISCOSITY,
         CLAST_MECHANISM_BROWNIAN, false},
    [CLAST_KERNEL_BROWNIAN_FREE] = {"brownian_free", "(a1 + a2)^2 sqrt(8 pi k T (1/m1 + 1/m2))",
                                    "kinetic theory", SOLID | CLAST_NEEDS_TEMPERATURE,
                                    CLAST_MECHANISM_BROWNIAN, false},
    [CLAST_KERNEL_BROWNIAN_TRANSITION] =
        {"brownian_transition",
         "brownian (1 + Kn) / (1 + 2 Kn (1 + Kn)), Kn = brownian / (2 brownian_free)",
         "Dahneke 1983", SOLID | CLAST_NEEDS_TEMPERATURE | CLAST_NEEDS_VISCOSITY,
         CLAST_MECHANISM_BROWNIAN, false},
    [CLAST_KERNEL_SHEAR_LAMINAR] = {"shear_laminar", "4/3 G (a1 + a2)^3", "Smoluchowski 1917",
                                    CLAST_NEEDS_RADIUS | CLAST_NEEDS_SHEAR, CLAST_MECHANISM_SHEAR,
                                    false},
    [CLAST_KERNEL_SHEAR_TURBULENT] = {"shear_turbulent", "sqrt(8 pi/15) sqrt(eps/nu) (a1 + a2)^3",
                                      "Saffman and Turner 1956",
                                      CLAST_NEEDS_RADIUS | CLAST_NEEDS_DISSIPATION |
                                          CLAST_NEEDS_VISCOSITY | CLAST_NEEDS_DENSITY,
                                      TURBULENCE, false},
    [CLAST_KERNEL_SETTLING] =
        {"settling",
         "pi (a1 + a2)^2 |w1 - w2| E, w by drag and slip, E --efficiency or by St and a1/a2",
         "Clift and Gauvin 1971, Davies 1945; E Langmuir 1948", FALLS, CLAST_MECHANISM_SETTLING,
         false},
    [CLAST_KERNEL_INERTIAL] =
        {"inertial",
         "sqrt(8 pi) (a1 + a2)^2 sqrt(u1'^2 + u2'^2), u'^2 own or U^2 / (1 + 1.5 tau eps / U^2)",
         "Abrahamson 1975", SOLID | CLAST_NEEDS_SPEED_RMS | CLAST_NEEDS_VISCOSITY, TURBULENCE,
         false},
    [CLAST_KERNEL_BALLISTIC] = {"ballistic", "pi (a1 + a2)^2 |u1 - u2|", "O'Rourke 1981",
                                CLAST_NEEDS_RADIUS | CLAST_NEEDS_VELOCITY,
                                CLAST_MECHANISM_SHEAR | TURBULENCE | CLAST_MECHANISM_SETTLING,
                                false},
    [CLAST_KERNEL_CLOUD_TURBULENCE] = {"cloud_turbulence", "2 pi (a1 + a2)^2 <|w_r|> g12",
                                       "Ayala, Rosa and Wang 2008",
                                       FALLS | CLAST_NEEDS_DISSIPATION | CLAST_NEEDS_SPEED_RMS,
                                       TURBULENCE | CLAST_MECHANISM_SETTLING, false}};

static const rate value[CLAST_N_KERNEL] = {
    [CLAST_KERNEL_CONSTANT] = constant,
    [CLAST_KERNEL_ADDITIVE] = additive,
    [CLAST_KERNEL_PRODUCT] = product,
    [CLAST_KERNEL_BROWNIAN] = brownian,
    [CLAST_KERNEL_BROWNIAN_FREE] = brownian_free,
    [CLAST_KERNEL_BROWNIAN_TRANSITION] = brownian_transition,
    [CLAST_KERNEL_SHEAR_LAMINAR] = shear_laminar,
    [CLAST_KERNEL_SHEAR_TURBULENT] = shear_turbulent,
    [CLAST_KERNEL_SETTLING] = settling,
    [CLAST_KERNEL_INERTIAL] = inertial,
    [CLAST_KERNEL_BALLISTIC] = ballistic,
    [CLAST_KERNEL_CLOUD_TURBULENCE] = clx_turbulent_kernel,
};

const clast_kernel_info *clast_kernel_table(void)
{
    return info;
}

static int32_t find(const char *name, size_t length)
{
    for (int32_t k = 0; k < CLAST_N_KERNEL; ++k) {
        if (strlen(info[k].name) == length && strncmp(info[k].name, name, length) == 0) {
            return k;
        }
    }
    return -1;
}

clast_status clast_kernel_parse(const char *text, uint32_t *mask)
{
    CLX_ARGUMENTS(text, mask);
    uint32_t made = 0;
    const char *at = text;
    for (;;) {
        const size_t length = strcspn(at, "+,");
        const int32_t k = find(at, length);
        if (k < 0) {
            char known[512] = "";
            for (int32_t i = 0; i < CLAST_N_KERNEL; ++i) {
                const size_t used = strlen(known);
                (void)snprintf(known + used, sizeof known - used, "%s%s", i > 0 ? ", " : "",
                               info[i].name);
            }
            return clx_fail(CLAST_E_CONFIG, "kernel '%.*s' is not known; there are %s, joined by +",
                            (int)length, at, known);
        }
        made |= 1U << k;
        if (at[length] == '\0') {
            *mask = made;
            return CLAST_OK;
        }
        at += length + 1;
    }
}

uint32_t clast_kernel_needs(uint32_t mask)
{
    uint32_t needs = 0;
    for (int k = 0; k < CLAST_N_KERNEL; ++k) {
        needs |= (mask >> k & 1U) != 0 ? info[k].needs : 0;
    }
    return needs;
}

/// Names the first two kernels of a sum that count the same mechanism.
static clast_status check_mechanisms(uint32_t mask)
{
    for (int k = 0; k < CLAST_N_KERNEL; ++k) {
        for (int l = 0; l < k && (mask >> k & 1U) != 0; ++l) {
            if ((mask >> l & 1U) != 0 && (info[k].mechanisms & info[l].mechanisms) != 0) {
                static const char *const name[] = {"Brownian motion", "shear", "turbulence",
                                                   "settling"};
                int both = 0;
                while ((info[k].mechanisms & info[l].mechanisms & 1U << both) == 0) {
                    ++both;
                }
                return clx_fail(CLAST_E_CONFIG,
                                "kernel %s+%s counts %s twice: both hold it; take one of them",
                                info[l].name, info[k].name, name[both]);
            }
        }
    }
    return CLAST_OK;
}

clast_status clast_kernel_check(uint32_t mask, const clast_medium *m)
{
    CLX_ARGUMENTS(m);
    if (m == NULL || mask == 0 || mask >> CLAST_N_KERNEL != 0) {
        return clx_fail(CLAST_E_ARGUMENT, "clast_kernel_check: mask %#x, medium %s", (unsigned)mask,
                        m == NULL ? "NULL" : "given");
    }
    const struct {
        uint32_t need;
        double value;
        const char *name;
    } parts[] = {{CLAST_NEEDS_TEMPERATURE, m->temperature, "temperature"},
                 {CLAST_NEEDS_VISCOSITY, m->viscosity, "viscosity"},
                 {CLAST_NEEDS_DENSITY, m->density, "density"},
                 {CLAST_NEEDS_SHEAR, m->shear, "shear"},
                 {CLAST_NEEDS_DISSIPATION, m->dissipation, "dissipation"}};
    for (int k = 0; k < CLAST_N_KERNEL; ++k) {
        for (size_t i = 0; i < sizeof parts / sizeof parts[0] && (mask >> k & 1U) != 0; ++i) {
            if ((info[k].needs & parts[i].need) != 0 &&
                !(parts[i].value > 0.0 && isfinite(parts[i].value))) {
                return clx_fail(CLAST_E_CONFIG, "kernel %s needs a %s > 0, not %g", info[k].name,
                                parts[i].name, parts[i].value);
            }
        }
    }
    if ((mask >> CLAST_KERNEL_CLOUD_TURBULENCE & 1U) != 0 &&
        !(m->speed_rms > 0.0 && m->gravity > 0.0 && m->particle_density > m->density &&
          clx_turbulent_kernel_fits(m))) {
        return clx_fail(CLAST_E_CONFIG,
                        "kernel cloud_turbulence needs speed_rms > 0, particles denser than the "
                        "fluid and a Taylor-scale Reynolds number above 60, not speed_rms %g at "
                        "dissipation %g",
                        m->speed_rms, m->dissipation);
    }
    return check_mechanisms(mask);
}

double clx_kernel_sum(uint32_t mask, const clast_medium *medium, const clast_collider *a,
                      const clast_collider *b)
{
    double sum = 0.0;
    for (int k = 0; mask != 0; ++k, mask >>= 1) {
        sum += (mask & 1U) != 0 ? value[k](medium, a, b) : 0.0;
    }
    return sum;
}

double clast_kernel_value(uint32_t mask, const clast_medium *medium, const clast_collider *a,
                          const clast_collider *b)
{
    if (medium == NULL || a == NULL || b == NULL || mask >> CLAST_N_KERNEL != 0) {
        return (double)NAN; // a kernel that there is not
    }
    return clx_kernel_sum(mask, medium, a, b);
}

double clast_impact_speed(uint32_t mask, const clast_medium *medium, const clast_collider *a,
                          const clast_collider *b)
{
    if (medium == NULL || a == NULL || b == NULL || mask >> CLAST_N_KERNEL != 0) {
        return (double)NAN;
    }
    const double section = CLAST_PI * contact(a, b) * contact(a, b);
    double sum = 0.0;
    for (int k = 0; k < CLAST_N_KERNEL; ++k) {
        if ((mask >> k & 1U) == 0 || info[k].is_model) {
            continue;
        }
        sum += k == CLAST_KERNEL_SETTLING
                   ? fabs(clx_settling_speed_of(medium, a) - clx_settling_speed_of(medium, b))
               : k == CLAST_KERNEL_CLOUD_TURBULENCE ? clx_turbulent_speed(medium, a, b)
                                                    : value[k](medium, a, b) / section;
    }
    return sum;
}
