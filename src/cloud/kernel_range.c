// Ranges of kernels and laws of sticking: one table, one check. [docs/theory/agglomeration.md
// section 7]
#include "cloud/kernel_range.h"

#include "base/number.h"
#include "base/status.h"
#include "cloud/settling_pair.h"
#include "cloud/turbulent_kernel.h"
#include <assert.h>
#include <math.h>

static const double MOST_OUTSIDE = 1e-3;   ///< share that is let pass
static const double GAS_DENSITY = 100.0;   ///< below it a fluid is a gas [kg/m^3]
static const double AIR_MOLAR = 0.0289647; ///< of the gas where no mean free path says [kg/mol]
static const double GAS_CONSTANT = 8.314462618;
static const double TABOR_DISTANCE = 0.4e-9; ///< equilibrium distance of surfaces [m] [Tabor1977]

typedef struct {
    const clast_collide_config *config;
    const clast_medium *m;
    const clast_collider *a, *b;
} seen;

static double smaller(const seen *s)
{
    return s->a->radius < s->b->radius ? s->a->radius : s->b->radius;
}

static double larger(const seen *s)
{
    return s->a->radius > s->b->radius ? s->a->radius : s->b->radius;
}

static double contact(const seen *s)
{
    return s->a->radius + s->b->radius;
}

/// Whether masses are kilograms: else response times are not known.
static bool has_mass(const seen *s)
{
    return s->m->particle_density > 0.0 ||
           (clast_kernel_needs(s->config->kernel) & CLAST_NEEDS_MASS) != 0;
}

static double knudsen_high(const seen *s)
{
    return s->m->mean_free_path / smaller(s);
}

static double knudsen_low(const seen *s)
{
    return s->m->mean_free_path / larger(s);
}

/// Knudsen number by kinetic theory where the fluid is a gas and no mean free path is given.
static double knudsen_missing(const seen *s)
{
    const clast_medium *m = s->m;
    if (m->mean_free_path > 0.0 || !(m->density > 0.0) || m->density > GAS_DENSITY) {
        return (double)NAN;
    }
    const double t = m->temperature > 0.0 ? m->temperature : 293.15;
    return m->viscosity / m->density * sqrt(CLAST_PI * AIR_MOLAR / (2.0 * GAS_CONSTANT * t)) /
           smaller(s);
}

static double shear_reynolds(const seen *s)
{
    const double r = contact(s);
    return s->m->density > 0.0 && s->m->viscosity > 0.0
               ? s->m->shear * r * r * s->m->density / s->m->viscosity
               : (double)NAN;
}

static double slower_response(const seen *s)
{
    return has_mass(s) && s->m->viscosity > 0.0
               ? fmax(clx_response_time(s->m, s->a), clx_response_time(s->m, s->b))
               : (double)NAN;
}

static double shear_stokes(const seen *s)
{
    return s->m->shear * slower_response(s);
}

static double kolmogorov_ratio(const seen *s)
{
    return contact(s) / clx_kolmogorov_length(s->m);
}

static double kolmogorov_stokes(const seen *s)
{
    return slower_response(s) * sqrt(s->m->dissipation * s->m->density / s->m->viscosity);
}

static double stokes_reynolds(const seen *s)
{
    clast_medium creeping = *s->m;
    creeping.settling_law = CLAST_SETTLING_STOKES;
    const double a = s->a->radius * fabs(clast_kernel_settling_speed(&creeping, s->a));
    const double b = s->b->radius * fabs(clast_kernel_settling_speed(&creeping, s->b));
    return 2.0 * fmax(a, b) * s->m->density / s->m->viscosity;
}

static double settling_reynolds(const seen *s)
{
    const double most = stokes_reynolds(s); // quick to tell, and never less
    if (most <= 3e5) {
        return most;
    }
    const double a = s->a->radius * fabs(clx_settling_speed_of(s->m, s->a));
    const double b = s->b->radius * fabs(clx_settling_speed_of(s->m, s->b));
    return 2.0 * fmax(a, b) * s->m->density / s->m->viscosity;
}

static double ratio(const seen *s)
{
    return smaller(s) / larger(s);
}

/// tau eps / U^2 of the faster follower whose velocity is the medium's; without dissipation all
/// follow the fluid.
static double integral_stokes(const seen *s)
{
    double least = (double)NAN;
    for (int k = 0; k < 2; ++k) {
        const clast_collider *a = k == 0 ? s->a : s->b;
        if (a->speed_rms == 0.0) {
            least = fmin(least, clx_response_time(s->m, a) * s->m->dissipation /
                                    (s->m->speed_rms * s->m->speed_rms));
        }
    }
    return least;
}

static double fluctuation_reynolds(const seen *s)
{
    return s->a->speed_rms == 0.0 || s->b->speed_rms == 0.0
               ? 2.0 * larger(s) * s->m->speed_rms * s->m->density / s->m->viscosity
               : (double)NAN;
}

static double ballistic_stokes(const seen *s)
{
    double speed2 = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double v = s->a->velocity[k] - s->b->velocity[k];
        speed2 += v * v;
    }
    return has_mass(s) && s->m->viscosity > 0.0 ? clx_stokes_of_pair(s->m, s->a, s->b, sqrt(speed2))
                                                : (double)NAN;
}

static double least_radius(const seen *s)
{
    return smaller(s);
}

static double most_radius(const seen *s)
{
    return larger(s);
}

static double dissipation(const seen *s)
{
    return s->m->dissipation;
}

static double density_ratio(const seen *s)
{
    return s->m->particle_density / s->m->density;
}

/// A pair as a law of sticking sees it.
static clast_impact impact_of(const clast_collide_config *c, const clast_medium *medium,
                              const clast_collider *a, const clast_collider *b)
{
    const bool is_fractal = c->radius_law != CLAST_RADIUS_VOLUME;
    return (clast_impact){.speed = clast_impact_speed(c->kernel, medium, a, b),
                          .radius = {a->radius, b->radius},
                          .mass = {a->mass, b->mass},
                          .curvature = {is_fractal ? c->monomer_radius : a->radius,
                                        is_fractal ? c->monomer_radius : b->radius}};
}

static double impact_stokes(const seen *s)
{
    const clast_impact hit = impact_of(s->config, s->m, s->a, s->b);
    return clast_sticking_stokes(&s->config->sticking, &hit);
}

static double curvature(const seen *s)
{
    const clast_impact hit = impact_of(s->config, s->m, s->a, s->b);
    return hit.curvature[0] * hit.curvature[1] / (hit.curvature[0] + hit.curvature[1]);
}

static double film_ratio(const seen *s)
{
    return s->config->sticking.film_thickness / curvature(s);
}

static double tabor(const seen *s)
{
    const clast_sticking *k = &s->config->sticking;
    const double stiff = k->young / (2.0 * (1.0 - k->poisson * k->poisson));
    return cbrt(curvature(s) * k->adhesion * k->adhesion / (stiff * stiff)) / TABOR_DISTANCE;
}

#define INSTEAD_SLIP "give --mean-free-path (air at 20 C: 66nm)"
#define SLIP         "mean free path over radius where none is given"

/// The kernel's number, or this and the law of a sticking; or what lets particles leave a box.
enum { STICKING = CLAST_N_KERNEL, SINK = STICKING + 16 };

#define SINK_OWNER "sink of --settling-depth"

static bool by_standard_drag(const clast_collide_config *c)
{
    return c->medium.settling_law == CLAST_SETTLING_STANDARD;
}

static bool by_stokes_drag(const clast_collide_config *c)
{
    return c->medium.settling_law == CLAST_SETTLING_STOKES;
}

static bool by_efficiency_law(const clast_collide_config *c)
{
    return !(c->medium.efficiency > 0.0);
}

static const struct {
    clast_kernel_range text;
    double (*value)(const seen *s);
    bool (*is_chosen)(const clast_collide_config *config); ///< NULL: always
    int32_t owner;
    bool is_pair; ///< it takes two unlike particles
} row[CLAST_N_KERNEL_RANGE] = {
    {.text = {"kernel brownian", "mean free path over radius", 0.0, 0.1, "Seinfeld and Pandis 2016",
              "take brownian_transition"},
     .owner = CLAST_KERNEL_BROWNIAN,
     .value = knudsen_high},
    {.text = {"kernel brownian", SLIP, 0.0, 0.01, "Davies 1945", INSTEAD_SLIP},
     .owner = CLAST_KERNEL_BROWNIAN,
     .value = knudsen_missing},
    {.text = {"kernel brownian_free", "mean free path over radius", 10.0, (double)INFINITY,
              "Seinfeld and Pandis 2016", "take brownian_transition, with --mean-free-path"},
     .owner = CLAST_KERNEL_BROWNIAN_FREE,
     .value = knudsen_low},
    {.text = {"kernel brownian_transition", SLIP, 0.0, 0.01, "Davies 1945", INSTEAD_SLIP},
     .owner = CLAST_KERNEL_BROWNIAN_TRANSITION,
     .value = knudsen_missing},
    {.text = {"kernel shear_laminar", "shear Reynolds number G (a1 + a2)^2 / nu", 0.0, 1.0,
              "Smoluchowski 1917: creeping flow", "take smaller particles or a lower shear"},
     .owner = CLAST_KERNEL_SHEAR_LAMINAR,
     .value = shear_reynolds},
    {.text = {"kernel shear_laminar", "Stokes number tau G", 0.0, 0.1, "Saffman and Turner 1956",
              "take lighter particles: these cross the streamlines"},
     .owner = CLAST_KERNEL_SHEAR_LAMINAR,
     .value = shear_stokes},
    {.text = {"kernel shear_turbulent", "a1 + a2 over Kolmogorov's length", 0.0, 1.0,
              "Saffman and Turner 1956", "take inertial, if the particles are slow to respond"},
     .owner = CLAST_KERNEL_SHEAR_TURBULENT,
     .value = kolmogorov_ratio},
    {.text = {"kernel shear_turbulent", "Stokes number tau over Kolmogorov's time", 0.0, 0.1,
              "Saffman and Turner 1956", "take cloud_turbulence or inertial"},
     .owner = CLAST_KERNEL_SHEAR_TURBULENT,
     .value = kolmogorov_stokes},
    {.text = {"kernel settling", "Reynolds number of settling", 0.0, 3e5, "Clift and Gauvin 1971",
              "there is no law for such bodies"},
     .owner = CLAST_KERNEL_SETTLING,
     .value = settling_reynolds,
     .is_chosen = by_standard_drag},
    {.text = {"kernel settling", "Reynolds number of settling by Stokes' law", 0.0, 0.1,
              "Clift, Grace and Weber 1978",
              "take --settling-law standard (of clast evolve: --fall form or sphere)"},
     .owner = CLAST_KERNEL_SETTLING,
     .value = stokes_reynolds,
     .is_chosen = by_stokes_drag},
    {.text = {"kernel settling", SLIP, 0.0, 0.01, "Davies 1945", INSTEAD_SLIP},
     .owner = CLAST_KERNEL_SETTLING,
     .value = knudsen_missing},
    {.text = {"kernel settling", "ratio of radii of the efficiency law", 0.0, 0.5, "Langmuir 1948",
              "give a collision efficiency of your own with --efficiency"},
     .owner = CLAST_KERNEL_SETTLING,
     .value = ratio,
     .is_pair = true,
     .is_chosen = by_efficiency_law},
    {.text = {"kernel inertial", "response time over the integral time, tau eps / U^2", 5.0 / 6.0,
              (double)INFINITY, "Abrahamson 1975", "take shear_turbulent or cloud_turbulence"},
     .owner = CLAST_KERNEL_INERTIAL,
     .value = integral_stokes},
    {.text = {"kernel inertial", "Reynolds number 2 a U / nu of Stokes' response time", 0.0, 1.0,
              "Abrahamson 1975", "give a --speed-rms-column"},
     .owner = CLAST_KERNEL_INERTIAL,
     .value = fluctuation_reynolds},
    {.text = {"kernel ballistic", "Stokes number of the approach", 10.0, (double)INFINITY,
              "Langmuir 1948: nine of ten meet",
              "straight paths are for heavier or faster particles"},
     .owner = CLAST_KERNEL_BALLISTIC,
     .value = ballistic_stokes,
     .is_pair = true},
    {.text = {"kernel cloud_turbulence", "a1 + a2 over Kolmogorov's length", 0.0, 1.0,
              "Ayala, Rosa and Wang 2008", "there is no kernel for such bodies"},
     .owner = CLAST_KERNEL_CLOUD_TURBULENCE,
     .value = kolmogorov_ratio},
    {.text = {"kernel cloud_turbulence", "smaller radius [m]", 1e-5, (double)INFINITY,
              "Ayala, Rosa, Wang and Grabowski 2008", "take shear_turbulent+settling"},
     .owner = CLAST_KERNEL_CLOUD_TURBULENCE,
     .value = least_radius},
    {.text = {"kernel cloud_turbulence", "larger radius [m]", 0.0, 6e-5,
              "Ayala, Rosa, Wang and Grabowski 2008", "take settling"},
     .owner = CLAST_KERNEL_CLOUD_TURBULENCE,
     .value = most_radius},
    {.text = {"kernel cloud_turbulence", "dissipation [m^2/s^3]", 0.0, 0.04,
              "Ayala, Rosa, Wang and Grabowski 2008", "there is no kernel for such a flow"},
     .owner = CLAST_KERNEL_CLOUD_TURBULENCE,
     .value = dissipation},
    {.text = {"kernel cloud_turbulence", "density over the fluid's", 100.0, (double)INFINITY,
              "Ayala, Rosa and Wang 2008", "take shear_turbulent+settling"},
     .owner = CLAST_KERNEL_CLOUD_TURBULENCE,
     .value = density_ratio},
    {.text = {"sticking viscous", "film over the reduced radius", 0.0, 0.1, "Ennis et al. 1991",
              "lubrication is for thinner films"},
     .owner = STICKING + CLAST_STICKING_VISCOUS,
     .value = film_ratio},
    {.text = {"sticking liquid", "impact Stokes number", 0.0, 100.0,
              "fit of Costa et al. 2010; the limit is ours",
              "hardly any of these stick: take settling and shear as they are with --alpha"},
     .owner = STICKING + CLAST_STICKING_LIQUID,
     .value = impact_stokes},
    {.text = {"sticking contact", "Tabor's parameter", 5.0, (double)INFINITY,
              "Johnson and Greenwood 1997", "these are too hard or too small for JKR contacts"},
     .owner = STICKING + CLAST_STICKING_CONTACT,
     .value = tabor},
    {.text = {SINK_OWNER, "Reynolds number of settling", 0.0, 3e5, "Clift and Gauvin 1971",
              "there is no law for such bodies"},
     .owner = SINK,
     .value = settling_reynolds,
     .is_chosen = by_standard_drag},
    {.text = {SINK_OWNER, "Reynolds number of settling by Stokes' law", 0.0, 0.1,
              "Clift, Grace and Weber 1978", "take --settling-law standard"},
     .owner = SINK,
     .value = stokes_reynolds,
     .is_chosen = by_stokes_drag},
    {.text = {SINK_OWNER, SLIP, 0.0, 0.01, "Davies 1945", INSTEAD_SLIP},
     .owner = SINK,
     .value = knudsen_missing},
};

const clast_kernel_range *clast_kernel_range_row(int32_t k)
{
    return k >= 0 && k < CLAST_N_KERNEL_RANGE ? &row[k].text : NULL;
}

static bool is_chosen(const clast_collide_config *c, int k)
{
    return row[k].is_chosen == NULL || row[k].is_chosen(c);
}

uint32_t clx_ranges_of(const clast_collide_config *c)
{
    uint32_t rows = 0;
    for (int k = 0; k < CLAST_N_KERNEL_RANGE; ++k) {
        const bool is_owner = row[k].owner < STICKING ? (c->kernel >> row[k].owner & 1U) != 0
                                                      : row[k].owner == STICKING + c->sticking.law;
        rows |= is_owner && is_chosen(c, k) ? 1U << k : 0;
    }
    return rows;
}

uint32_t clx_ranges_of_one(uint32_t rows)
{
    for (int k = 0; k < CLAST_N_KERNEL_RANGE; ++k) {
        rows &= row[k].is_pair ? ~(1U << k) : ~0U;
    }
    return rows;
}

uint32_t clx_ranges_of_settling(const clast_collide_config *c)
{
    uint32_t rows = 0;
    const bool has_kernel = (c->kernel >> CLAST_KERNEL_SETTLING & 1U) != 0; // whose rows these are
    for (int k = 0; k < CLAST_N_KERNEL_RANGE && !has_kernel; ++k) {
        rows |= row[k].owner == SINK && is_chosen(c, k) ? 1U << k : 0;
    }
    return rows;
}

void clx_range_add(uint32_t rows, const clast_collide_config *config, const clast_medium *medium,
                   const clast_collider pair[2], double weight, clast_range_use *use)
{
    const seen s = {config, medium, &pair[0], &pair[1]};
    bool is_outside = false;
    use->n += weight;
    for (int k = 0; k < CLAST_N_KERNEL_RANGE && rows >> k != 0; ++k) {
        if ((rows >> k & 1U) == 0) {
            continue;
        }
        const double value = row[k].value(&s);
        if (value < row[k].text.low || value > row[k].text.high) { // not where it is NaN
            const double excess = fmax(value / row[k].text.high, row[k].text.low / value);
            is_outside = true;
            if (!(excess <= use->excess)) {
                use->row = k;
                use->value = value;
                use->excess = excess;
            }
        }
    }
    use->outside += is_outside ? weight : 0.0;
}

void clx_range_merge(clast_range_use *into, const clast_range_use *from)
{
    into->n += from->n;
    into->outside += from->outside;
    if (from->excess > into->excess) {
        into->row = from->row;
        into->value = from->value;
        into->excess = from->excess;
    }
}

clast_range_report clx_range_begin(void)
{
    return (clast_range_report){.time = (double)NAN};
}

static clast_status hold(const clast_collide_config *config, const clast_range_use *use,
                         const char *of, double time, clast_range_report *report)
{
    const bool is_beyond = use->outside > MOST_OUTSIDE * use->n;
    if (is_beyond && isnan(report->time)) {
        report->time = time;
    }
    return is_beyond && config->out_of_range == CLAST_OUT_OF_RANGE_ERROR ? clx_range_check(use, of)
                                                                         : CLAST_OK;
}

clast_status clx_range_start(const clast_collide_config *config, clast_range_report *report)
{
    return hold(config, &report->start, "of the particles at the start", 0.0, report);
}

clast_status clx_range_up_to(const clast_collide_config *config, double time,
                             clast_range_report *report)
{
    char of[64];
    (void)clx_number_print(of, sizeof of, "of the collisions up to t = %s",
                           clx_unit_text(time, "s"));
    return hold(config, &report->collisions, of, time, report);
}

const clast_range_use *clast_range_report_use(const clast_range_report *r)
{
    if (r == NULL) {
        return NULL;
    }
    return r->collisions.outside > 0.0 || !(r->start.outside > 0.0) ? &r->collisions : &r->start;
}

const char *clast_range_use_words(const clast_range_use *use, size_t size, char *words)
{
    if (use == NULL || words == NULL || size == 0) {
        return "";
    }
    words[0] = '\0';
    if (use->outside > 0.0 && use->row >= 0 && use->row < CLAST_N_KERNEL_RANGE) {
        const clast_kernel_range *r = &row[use->row].text;
        const bool is_high = use->value > r->high;
        (void)clx_number_print(words, size,
                               "%s: %s is %.3g at the farthest, where it holds %s %.3g [%s]",
                               r->owner, r->quantity, use->value, is_high ? "up to" : "from",
                               is_high ? r->high : r->low, r->source);
    }
    return words;
}

clast_status clx_range_check(const clast_range_use *use, const char *of)
{
    CLX_ARGUMENTS(use, of);
    char words[512];
    if (!(use->outside > MOST_OUTSIDE * use->n)) {
        return CLAST_OK;
    }
    (void)clast_range_use_words(use, sizeof words, words);
    return clx_fail(
        CLAST_E_CONFIG,
        "%s; %.3g %% %s lie beyond: %s, or take it as it is with --out-of-range extrapolate", words,
        100.0 * use->outside / use->n, of,
        use->row >= 0 && use->row < CLAST_N_KERNEL_RANGE ? row[use->row].text.instead : "");
}

double clx_sticking_of(const clast_collide_config *c, const clast_medium *medium,
                       const clast_collider *a, const clast_collider *b)
{
    const clast_impact hit = impact_of(c, medium, a, b);
    return clast_sticking_share(&c->sticking, &hit);
}

clast_status clx_medium_check_dimension(const clast_medium *medium, int32_t d)
{
    static_assert(
        offsetof(clast_medium, constant_d) == offsetof(clast_medium, constant) + sizeof(double) &&
            offsetof(clast_medium, additive_d) ==
                offsetof(clast_medium, additive) + sizeof(double) &&
            offsetof(clast_medium, product_d) == offsetof(clast_medium, product) + sizeof(double),
        "CLAST_KEEPS_DIMENSION");
    const struct {
        const char *name;
        int32_t d;
    } given[] = {{"constant", medium->constant_d},
                 {"additive", medium->additive_d},
                 {"product", medium->product_d}};
    for (size_t k = 0; k < sizeof given / sizeof given[0]; ++k) {
        if (given[k].d != 0 && given[k].d != d) {
            return clx_fail(CLAST_E_CONFIG, "%s: is in m^%d/s, in %d dimensions it is in m^%d/s",
                            given[k].name, given[k].d, d, d);
        }
    }
    return CLAST_OK;
}
