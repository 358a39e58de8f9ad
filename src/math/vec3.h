#pragma once
// Vectors of three, 3x3 matrices and quaternions, inline; out comes first, inputs may alias it.
// A rotation takes from a body's own frame (local) to the world's: _to_world, and _to_local back.
// Matrices are read through plain (non-const) parameters: C17 cannot pass double[3][3] as const
// double[3][3].
#include <math.h>
#include <stdbool.h>

static inline void v3_set(double out[3], double x, double y, double z)
{
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

static inline void v3_copy(double out[3], const double a[3])
{
    v3_set(out, a[0], a[1], a[2]);
}

static inline void v3_add(double out[3], const double a[3], const double b[3])
{
    v3_set(out, a[0] + b[0], a[1] + b[1], a[2] + b[2]);
}

static inline void v3_sub(double out[3], const double a[3], const double b[3])
{
    v3_set(out, a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

static inline void v3_scale(double out[3], double s, const double a[3])
{
    v3_set(out, s * a[0], s * a[1], s * a[2]);
}

/// out = a + s b
static inline void v3_axpy(double out[3], const double a[3], double s, const double b[3])
{
    v3_set(out, a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]);
}

static inline double v3_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void v3_cross(double out[3], const double a[3], const double b[3])
{
    v3_set(out, a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

static inline double v3_norm2(const double a[3])
{
    return v3_dot(a, a);
}

static inline double v3_norm(const double a[3])
{
    return sqrt(v3_dot(a, a));
}

static inline double v3_distance2(const double a[3], const double b[3])
{
    double d[3];
    v3_sub(d, a, b);
    return v3_norm2(d);
}

static inline double v3_distance(const double a[3], const double b[3])
{
    return sqrt(v3_distance2(a, b));
}

static inline bool v3_is_finite(const double a[3])
{
    return isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]);
}

/// Length 1 within `tolerance`.
static inline bool v3_is_unit(const double a[3], double tolerance)
{
    return fabs(v3_norm2(a) - 1.0) <= 2.0 * tolerance;
}

/// Scales to unit length; false (and out = 0) for a zero vector.
static inline bool v3_unit(double out[3], const double a[3])
{
    const double n = v3_norm(a);
    v3_scale(out, n > 0.0 ? 1.0 / n : 0.0, a);
    return n > 0.0;
}

/// Two unit vectors that complete unit n to a right-handed frame (a, b, n); continuous but at n =
/// -z. [Duff2017]
static inline void v3_frame(const double n[3], double a[3], double b[3])
{
    const double sign = n[2] >= 0.0 ? 1.0 : -1.0;
    const double p = -1.0 / (sign + n[2]);
    const double q = n[0] * n[1] * p;
    v3_set(a, 1.0 + sign * n[0] * n[0] * p, sign * q, -sign * n[0]);
    v3_set(b, q, sign + n[1] * n[1] * p, -n[1]);
}

/// out = M a
static inline void m3_mul(double out[3], double m[3][3], const double a[3])
{
    v3_set(out, v3_dot(m[0], a), v3_dot(m[1], a), v3_dot(m[2], a));
}

/// out = M^T a
static inline void m3_mul_t(double out[3], double m[3][3], const double a[3])
{
    v3_set(out, m[0][0] * a[0] + m[1][0] * a[1] + m[2][0] * a[2],
           m[0][1] * a[0] + m[1][1] * a[1] + m[2][1] * a[2],
           m[0][2] * a[0] + m[1][2] * a[1] + m[2][2] * a[2]);
}

/// out = M a for a rotation matrix M of a body's axes: a in the body's frame, out in the world's.
static inline void m3_to_world(double out[3], double m[3][3], const double a[3])
{
    m3_mul(out, m, a);
}

/// out = M^T a: the inverse of m3_to_world.
static inline void m3_to_local(double out[3], double m[3][3], const double a[3])
{
    m3_mul_t(out, m, a);
}

/// The same for a rotation R given row by row, read only.
static inline void rot_to_world(double out[3], const double r[9], const double a[3])
{
    v3_set(out, r[0] * a[0] + r[1] * a[1] + r[2] * a[2], r[3] * a[0] + r[4] * a[1] + r[5] * a[2],
           r[6] * a[0] + r[7] * a[1] + r[8] * a[2]);
}

static inline void rot_to_local(double out[3], const double r[9], const double a[3])
{
    v3_set(out, r[0] * a[0] + r[3] * a[1] + r[6] * a[2], r[1] * a[0] + r[4] * a[1] + r[7] * a[2],
           r[2] * a[0] + r[5] * a[1] + r[8] * a[2]);
}

/// out = S a, S symmetric as xx, yy, zz, yz, xz, xy
static inline void sym_mul(double out[3], const double s[6], const double a[3])
{
    v3_set(out, s[0] * a[0] + s[5] * a[1] + s[4] * a[2], s[5] * a[0] + s[1] * a[1] + s[3] * a[2],
           s[4] * a[0] + s[3] * a[1] + s[2] * a[2]);
}

/// n^T S n
static inline double sym_form(const double s[6], const double n[3])
{
    return s[0] * n[0] * n[0] + s[1] * n[1] * n[1] + s[2] * n[2] * n[2] +
           2.0 * (s[3] * n[1] * n[2] + s[4] * n[0] * n[2] + s[5] * n[0] * n[1]);
}

/// Rotation matrix of a unit quaternion (w, x, y, z): world = M body.
static inline void q_matrix(double m[3][3], const double q[4])
{
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    v3_set(m[0], 1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y));
    v3_set(m[1], 2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x));
    v3_set(m[2], 2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y));
}

/// Unit quaternion of a rotation matrix, from its greatest component. [Shepperd1978]
static inline void q_from_matrix(double q[4], double m[3][3])
{
    const double square[4] = {1.0 + m[0][0] + m[1][1] + m[2][2], 1.0 + m[0][0] - m[1][1] - m[2][2],
                              1.0 - m[0][0] + m[1][1] - m[2][2], 1.0 - m[0][0] - m[1][1] + m[2][2]};
    const double cross[6] = {m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1],
                             m[0][1] + m[1][0], m[0][2] + m[2][0], m[1][2] + m[2][1]};
    // row i: 4 q[i] q[j] for all j
    const double row[4][4] = {{square[0], cross[0], cross[1], cross[2]},
                              {cross[0], square[1], cross[3], cross[4]},
                              {cross[1], cross[3], square[2], cross[5]},
                              {cross[2], cross[4], cross[5], square[3]}};
    int best = 0;
    for (int i = 1; i < 4; ++i) {
        best = square[i] > square[best] ? i : best;
    }
    const double scale = 0.5 / sqrt(square[best]);
    for (int j = 0; j < 4; ++j) {
        q[j] = scale * row[best][j];
    }
}

/// Three axes in the order of their lengths, greatest first; equal ones stay as they are.
static inline void v3_sort_axes(double length[3], double axis[3][3])
{
    for (int i = 1; i < 3; ++i) {
        for (int j = i; j > 0 && length[j] > length[j - 1]; --j) {
            double last[3];
            const double l = length[j];
            length[j] = length[j - 1];
            length[j - 1] = l;
            v3_copy(last, axis[j]);
            v3_copy(axis[j], axis[j - 1]);
            v3_copy(axis[j - 1], last);
        }
    }
}

/// out = a b: first b, then a.
static inline void q_mul(double out[4], const double a[4], const double b[4])
{
    const double w = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    const double x = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    const double y = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    const double z = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
    out[0] = w;
    out[1] = x;
    out[2] = y;
    out[3] = z;
}

/// Length 1 within `tolerance`.
static inline bool q_is_unit(const double q[4], double tolerance)
{
    const double n2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    return fabs(n2 - 1.0) <= 2.0 * tolerance;
}

static inline void q_unit(double q[4])
{
    const double n = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; ++i) {
        q[i] /= n;
    }
}

/// Rotates a vector by a unit quaternion.
static inline void q_rotate(double out[3], const double q[4], const double a[3])
{
    double m[3][3];
    double r[3];
    q_matrix(m, q);
    m3_mul(r, m, a);
    v3_copy(out, r);
}
