// Eigenvalues and vectors of symmetric 3x3 matrices by cyclic Jacobi rotations.
//
// Closed forms (cubic by cosines) are faster but lose half of the digits where eigenvalues meet,
// which is where grains of revolution and cubes live. Jacobi needs 4 to 6 sweeps and keeps all.
#include "math/sym3.h"

#include "base/status.h"
#include "math/vec3.h"

enum { SWEEP_LIMIT = 50 };

/// A tenth of the scaled matrix's rounding: below it, equal eigenvalues would be turned for ever.
#define NEGLIGIBLE 1e-17

/// One rotation in the plane (p, q) that makes m[p][q] zero; v gathers the rotations in its rows.
static void rotate(double m[3][3], double v[3][3], int p, int q)
{
    CLAST_ASSERT(p >= 0 && p < q && q < 3 && m[p][q] != 0.0);
    const int r = 3 - p - q;
    const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    const double t = copysign(1.0, theta) / (fabs(theta) + hypot(1.0, theta));
    const double c = 1.0 / sqrt(1.0 + t * t);
    const double s = t * c;
    const double rp = m[r][p];
    const double rq = m[r][q];
    m[p][p] -= t * m[p][q];
    m[q][q] += t * m[p][q];
    m[p][q] = m[q][p] = 0.0;
    m[r][p] = m[p][r] = c * rp - s * rq;
    m[r][q] = m[q][r] = s * rp + c * rq;
    for (int k = 0; k < 3; ++k) {
        const double vp = v[p][k];
        const double vq = v[q][k];
        v[p][k] = c * vp - s * vq;
        v[q][k] = s * vp + c * vq;
    }
}

static double greatest_entry(double a[3][3])
{
    double greatest = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            greatest = fmax(greatest, fabs(a[i][j]));
        }
    }
    return greatest;
}

static void diagonalise(double m[3][3], double v[3][3])
{
    for (int sweep = 0; sweep < SWEEP_LIMIT; ++sweep) {
        bool done = true;
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                if (fabs(m[p][q]) > NEGLIGIBLE) {
                    rotate(m, v, p, q);
                    done = false;
                }
            }
        }
        if (done) {
            return;
        }
    }
}

void clx_sym3_eigen(double a[3][3], double value[3], double vector[3][3])
{
    double m[3][3] = {{0}};
    double v[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    int order[3] = {0, 1, 2};
    const double scale = greatest_entry(a);
    for (int i = 0; i < 3 && scale > 0.0; ++i) {
        for (int j = i; j < 3; ++j) {
            m[i][j] = m[j][i] = a[i][j] / scale;
        }
    }
    diagonalise(m, v);
    for (int i = 1; i < 3; ++i) { // insertion sort, stable
        for (int j = i; j > 0 && m[order[j]][order[j]] > m[order[j - 1]][order[j - 1]]; --j) {
            const int swap = order[j];
            order[j] = order[j - 1];
            order[j - 1] = swap;
        }
    }
    for (int k = 0; k < 3; ++k) {
        value[k] = scale * m[order[k]][order[k]];
        (void)v3_unit(vector[k], v[order[k]]);
    }
    double third[3];
    v3_cross(third, vector[0], vector[1]);
    if (v3_dot(third, vector[2]) < 0.0) {
        v3_scale(vector[2], -1.0, vector[2]);
    }
}
