// Sieve curves: mass between sieves, straight over log size, and the seven published mixtures.
//
// Shares by mass and sizes that pass are exact on the curve as drawn (no fit): the mass of a class
// is spread evenly over log size.                                       [docs/theory/grading.md]
#include <clast/grading.h>

#include "base/alloc.h"
#include "shape/curve.h"
#include "shape/whole.h"
#include <math.h>
#include <string.h>

// What a size may be: a molecule to a mountain. Keeps D^3 and its sums within double's range.
#define SIZE_MIN_M 1e-10
#define SIZE_MAX_M 1e6

const double clast_curve_case_sieve[8] = {2.8e-3,  4e-3,  5.6e-3,  8e-3,
                                          11.2e-3, 16e-3, 22.4e-3, 31.5e-3};

// Rettinger et al. 2022, table 3 (sieve analysis of Liang et al. 2015).
static const clast_curve_case cases[] = {
    {"U1", {0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0}, 0.371, 0.001, 16e-3},
    {"U3", {0.0, 0.0, 0.21, 0.58, 0.21, 0.0, 0.0}, 0.356, 0.003, 22e-3},
    {"U5", {0.0, 0.06, 0.24, 0.4, 0.24, 0.06, 0.0}, 0.344, 0.002, 26e-3},
    {"U7", {0.04, 0.11, 0.22, 0.26, 0.22, 0.11, 0.04}, 0.315, 0.002, 22e-3},
    {"B30", {0.08, 0.13, 0.08, 0.06, 0.18, 0.29, 0.18}, 0.270, 0.003, 20e-3},
    {"B50", {0.13, 0.21, 0.13, 0.06, 0.13, 0.21, 0.13}, 0.289, 0.005, 20e-3},
    {"B70", {0.18, 0.29, 0.18, 0.06, 0.08, 0.13, 0.08}, 0.299, 0.002, 18e-3},
};

enum { N_CASE = sizeof cases / sizeof cases[0], N_CASE_CLASS = 7 };

const clast_curve_case *clast_curve_case_at(int32_t i)
{
    return i >= 0 && i < N_CASE ? &cases[i] : NULL;
}

static clast_status check_sieves(int32_t n_class, const double *sieve)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(n_class >= 1, CLAST_E_CONFIG, "a sieve curve of %d classes", n_class);
    for (int32_t i = 0; i <= n_class; ++i) {
        CLX_CHECK(sieve[i] >= SIZE_MIN_M && sieve[i] <= SIZE_MAX_M, CLAST_E_CONFIG,
                  "sieve %d: a size of %s is not between %s and %s", i + 1,
                  clx_unit_text(sieve[i], "m"), clx_unit_text(SIZE_MIN_M, "m"),
                  clx_unit_text(SIZE_MAX_M, "m"));
        CLX_CHECK(i == 0 || sieve[i] > sieve[i - 1], CLAST_E_CONFIG,
                  "sieve %d: %s is not larger than the one before, %s; sieves must ascend", i + 1,
                  clx_unit_text(sieve[i], "m"), clx_unit_text(sieve[i - 1], "m"));
    }
done:
    return status;
}

static clast_status sum_masses(int32_t n_class, const double *mass, double *sum)
{
    clast_status status = CLAST_OK;
    double total = 0.0;
    for (int32_t i = 0; i < n_class; ++i) {
        CLX_CHECK(isfinite(mass[i]) && mass[i] >= 0.0, CLAST_E_CONFIG,
                  "class %d: a mass of %g is not a number from 0 up", i + 1, mass[i]);
        total += mass[i];
    }
    CLX_CHECK(total > 0.0 && isfinite(total), CLAST_E_CONFIG,
              "the masses of the %d classes sum to %g", n_class, total);
    *sum = total;
done:
    return status;
}

clast_status clx_curve_check(const clast_curve *curve)
{
    clast_status status = CLAST_OK;
    double sum = 0.0;
    CLX_TRY(check_sieves(curve->n_class, curve->sieve));
    CLX_TRY(sum_masses(curve->n_class, curve->mass, &sum));
done:
    return status;
}

clast_status clast_curve_make(int32_t n_class, const double *sieve, const double *mass,
                              clast_curve *curve)
{
    CLX_ARGUMENTS(curve);
    CLX_ARRAY(sieve, n_class);
    CLX_ARRAY(mass, n_class);
    clast_status status = CLAST_OK;
    clast_curve made = {.n_class = n_class};
    double sum = 0.0;
    CLX_TRY(check_sieves(n_class, sieve));
    CLX_TRY(sum_masses(n_class, mass, &sum));
    CLX_TRY(clx_alloc(&made.sieve, n_class + 1, sizeof *made.sieve));
    CLX_TRY(clx_alloc(&made.mass, n_class, sizeof *made.mass));
    memcpy(made.sieve, sieve, (size_t)(n_class + 1) * sizeof *sieve);
    for (int32_t i = 0; i < n_class; ++i) {
        made.mass[i] = mass[i] / sum;
    }
    *curve = made;
    made = (clast_curve){0};
done:
    clast_curve_free(&made);
    return status;
}

void clast_curve_free(clast_curve *curve)
{
    if (curve == NULL) {
        return;
    }
    CLX_FREE(curve->sieve, curve->mass);
    *curve = (clast_curve){0};
}

clast_status clast_curve_named(const char *name, clast_curve *curve)
{
    CLX_ARGUMENTS(name, curve);
    for (int32_t i = 0; i < N_CASE; ++i) {
        if (strcmp(name, cases[i].name) == 0) {
            return clast_curve_make(N_CASE_CLASS, clast_curve_case_sieve, cases[i].mass, curve);
        }
    }
    return clx_fail(CLAST_E_CONFIG,
                    "no published sieve curve is called '%s'; there are U1, U3, U5, U7, B30, B50 "
                    "and B70",
                    name);
}

double clast_curve_passing(const clast_curve *curve, double size)
{
    if (clx_curve_fault(curve) != NULL) {
        return (double)NAN;
    }
    double below = 0.0;
    if (curve->n_class < 1 || isnan(size)) {
        return NAN;
    }
    for (int32_t i = 0; i < curve->n_class; ++i) {
        const double low = curve->sieve[i];
        const double high = curve->sieve[i + 1];
        if (!(size > low)) {
            return below;
        }
        if (size < high) {
            return below + curve->mass[i] * log(size / low) / log(high / low);
        }
        below += curve->mass[i];
    }
    return 1.0;
}

double clast_curve_size(const clast_curve *curve, double share)
{
    if (clx_curve_fault(curve) != NULL || !(share >= 0.0 && share <= 1.0)) {
        return (double)NAN;
    }
    double below = 0.0;
    int32_t last = -1;
    for (int32_t i = 0; i < curve->n_class; ++i) {
        if (curve->mass[i] > 0.0) {
            if (share <= below + curve->mass[i]) {
                const double t = fmax(0.0, (share - below) / curve->mass[i]);
                return curve->sieve[i] * pow(curve->sieve[i + 1] / curve->sieve[i], t);
            }
            last = i;
        }
        below += curve->mass[i];
    }
    return last >= 0 ? curve->sieve[last + 1] : (double)NAN;
}

double clast_curve_class_size(const clast_curve *curve, int32_t i)
{
    if (clx_curve_fault(curve) != NULL || i < 0 || i >= curve->n_class) {
        return (double)NAN;
    }
    return sqrt(curve->sieve[i] * curve->sieve[i + 1]);
}

double clast_curve_count(const clast_curve *curve, int32_t i, double mass, double density,
                         double grain_volume)
{
    if (clx_curve_fault(curve) != NULL || i < 0 || i >= curve->n_class) {
        return (double)NAN;
    }
    const double d = clast_curve_class_size(curve, i);
    return curve->mass[i] * mass / (density * grain_volume * d * d * d);
}

double clast_phi_of_size(double size)
{
    return 0.0 - log2(size / 1e-3); // 1 mm: 0, not -0
}

double clast_phi_size(double phi)
{
    return 1e-3 * exp2(-phi);
}
