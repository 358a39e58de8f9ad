// Slow oracles of first-touch search.
#include "ref_touch.h"
#include "touch/body.h"

#include <math.h>

typedef long double real;

/// c^T (A / k + B / (1 - k))^-1 c by elimination.
static real form_at(const clx_touch_body *a, const clx_touch_body *b, const real c[3], real k)
{
    static const int at[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
    real m[3][4];
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            m[i][j] = (real)a->matrix[at[i][j]] / k + (real)b->matrix[at[i][j]] / (1.0L - k);
        }
        m[i][3] = c[i];
    }
    for (int i = 0; i < 3; ++i) { // positive definite: no pivoting needed
        for (int j = i + 1; j < 3; ++j) {
            const real f = m[j][i] / m[i][i];
            for (int col = i; col < 4; ++col) {
                m[j][col] -= f * m[i][col];
            }
        }
    }
    real x[3];
    for (int i = 2; i >= 0; --i) {
        x[i] = m[i][3];
        for (int j = i + 1; j < 3; ++j) {
            x[i] -= m[i][j] * x[j];
        }
        x[i] /= m[i][i];
    }
    return c[0] * x[0] + c[1] * x[1] + c[2] * x[2];
}

static real contact_function(const clx_touch_body *moving, const clx_touch_body *lying,
                             const double direction[3], real t)
{
    const real golden = 0.61803398874989484820L;
    real c[3];
    real low = 0.0L;
    real high = 1.0L;
    for (int i = 0; i < 3; ++i) {
        c[i] = (real)moving->position[i] + t * (real)direction[i] - (real)lying->position[i];
    }
    real x = high - golden * (high - low);
    real y = low + golden * (high - low);
    real fx = form_at(lying, moving, c, x);
    real fy = form_at(lying, moving, c, y);
    for (int step = 0; step < 60; ++step) {
        if (fx > fy) {
            high = y;
            y = x;
            fy = fx;
            x = high - golden * (high - low);
            fx = form_at(lying, moving, c, x);
        } else {
            low = x;
            x = y;
            fx = fy;
            y = low + golden * (high - low);
            fy = form_at(lying, moving, c, y);
        }
    }
    return fx > fy ? fx : fy;
}

double ref_contact_function(const clx_touch_body *moving, const clx_touch_body *lying,
                            const double direction[3], double t)
{
    return (double)contact_function(moving, lying, direction, t);
}

bool ref_touch_ellipsoids(const clx_touch_body *moving, const clx_touch_body *lying,
                          const double direction[3], double *t)
{
    enum { SAMPLES = 400 };
    const real reach = (real)moving->radius + (real)lying->radius;
    real middle = 0.0L;
    for (int i = 0; i < 3; ++i) {
        middle += ((real)lying->position[i] - (real)moving->position[i]) * (real)direction[i];
    }
    for (int s = 0; s <= SAMPLES; ++s) {
        real high = middle + reach * (2.0L * s / SAMPLES - 1.0L);
        if (contact_function(moving, lying, direction, high) < 1.0L) {
            real low = middle - 1.01L * reach;
            for (int step = 0; step < 64; ++step) {
                const real half = 0.5L * (low + high);
                if (contact_function(moving, lying, direction, half) < 1.0L) {
                    high = half;
                } else {
                    low = half;
                }
            }
            *t = (double)high;
            return true;
        }
    }
    return false;
}
