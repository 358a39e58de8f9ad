// First touch of two ellipsoids along a line: a bracketed secant in one variable.
//
// The bodies touch where the line c + t z of centre differences enters the sum M = A + B of the two
// ellipsoids. By Cauchy-Schwarz h_A + h_B = min over 0 < k < 1 of sqrt(h_A^2 / k + h_B^2 / (1 -
// k)), so M is the intersection of the ellipsoids C(k) = A / k + B / (1 - k), and the entry is the
// latest of their entries t(k). t(k) has one maximum, where k = h_A / (h_A + h_B) at the normal of
// the entry point [docs/theory/first-touch.md eq. 4-9]. Every k gives a lower bound, so what is
// left of the iteration's error (second order in k) can only make a gap, never an overlap; and
// one C(k) that the line misses proves that the bodies miss.
//
// Measured against Newton on the two free components of the normal: as fast, and it cannot diverge
// at grazing touches, where that normal runs to infinity.
#include "touch/ellipsoid.h"

#include "base/status.h"
#include "math/vec3.h"

enum { MAX_STEP = 100 };

bool clx_sphere_entry(double radius_sum, const double c[3], clx_entry *entry)
{
    CLAST_ASSERT(radius_sum >= 0.0);
    const double under = radius_sum * radius_sum - c[0] * c[0] - c[1] * c[1];
    if (!(under >= 0.0)) {
        return false;
    }
    const double half = sqrt(under);
    entry->t = -c[2] - half;
    v3_set(entry->normal, c[0] / radius_sum, c[1] / radius_sum, -half / radius_sum);
    return true;
}

/// Entry of the line into C(k): false if missed. `n` is the (unscaled) normal there.
static bool entry_of_bound(const double a[6], const double b[6], const double c[3], double k,
                           double *t, double n[3])
{
    CLAST_ASSERT(k > 0.0 && k < 1.0);
    const double p = 1.0 / k;
    const double q = 1.0 / (1.0 - k);
    double m[6];
    for (int i = 0; i < 6; ++i) {
        m[i] = p * a[i] + q * b[i];
    }
    const double inverse_det = 1.0 / (m[0] * m[1] - m[5] * m[5]);
    const double x = (m[1] * c[0] - m[5] * c[1]) * inverse_det; // (C_side)^-1 c_side
    const double y = (m[0] * c[1] - m[5] * c[0]) * inverse_det;
    const double rest = 1.0 - (c[0] * x + c[1] * y);
    if (!(rest >= 0.0)) {
        return false;
    }
    const double wx = (m[1] * m[4] - m[5] * m[3]) * inverse_det; // (C_side)^-1 (C z)_side
    const double wy = (m[0] * m[3] - m[5] * m[4]) * inverse_det;
    const double depth2 = m[2] - (m[4] * wx + m[3] * wy);
    const double depth = depth2 > 0.0 ? sqrt(depth2) : 0.0;
    const double root = sqrt(rest);
    *t = -c[2] + wx * c[0] + wy * c[1] - depth * root;
    v3_set(n, root * wx + depth * x, root * wy + depth * y, -root);
    return true;
}

static double support(const double s[6], const double n[3])
{
    const double form = s[0] * n[0] * n[0] + s[1] * n[1] * n[1] + s[2] * n[2] * n[2] +
                        2.0 * (s[3] * n[1] * n[2] + s[4] * n[0] * n[2] + s[5] * n[0] * n[1]);
    return form > 0.0 ? sqrt(form) : 0.0;
}

bool clx_ellipsoid_entry(const double a[6], const double b[6], const double c[3], double t_high,
                         clx_entry *entry)
{
    double low = 0.0; // the maximum of t(k) lies in (low, high)
    double high = 1.0;
    double before = 0.0; // the last but one k and its residual
    double residual_before = 0.0;
    const double radius_a = sqrt(a[0] + a[1] + a[2]);
    const double radius_sum = radius_a + sqrt(b[0] + b[1] + b[2]);
    const double give_up =
        t_high + 1e-12 * (radius_sum + fabs(c[2])); // beyond doubt later than t_high
    double k = radius_a / radius_sum;
    for (int step = 0; step < MAX_STEP; ++step) {
        if (!entry_of_bound(a, b, c, k, &entry->t, entry->normal) || entry->t > give_up) {
            return false; // entry->t is never beyond the true entry
        }
        const double h_a = support(a, entry->normal);
        const double share = h_a / (h_a + support(b, entry->normal));
        const double residual = share - k; // has the sign of dt/dk
        if (residual > 0.0) {
            low = k;
        } else {
            high = k;
        }
        if (fabs(residual) < 1e-10 || high - low < 1e-15) {
            break;
        }
        double next = share;
        if (step > 0 && residual != residual_before) {
            next = k - residual * (k - before) / (residual - residual_before);
        }
        before = k;
        residual_before = residual;
        k = next > low && next < high ? next : 0.5 * (low + high);
    }
    return v3_unit(entry->normal, entry->normal);
}
