// Smallest enclosing sphere of points: move-to-front search over boundary sets of at most four
// points [Welzl1991], entered with the farthest point each time [Gaertner1999].
#include "geom/miniball.h"

#include "base/status.h"
#include "math/vec3.h"

enum { MAX_PIVOTS = 200 };
static const double inside_share = 1.0 + 1e-14;

typedef struct search {
    const double (*point)[3];
    int32_t *order;
    int32_t n_bound;
    double bound[4][3];
    double centre[3];
    double radius2; ///< < 0: the empty sphere
} search;

/// Solves the k x k system by elimination with pivoting; false when it is singular.
static bool solve(int k, double m[3][4], double x[3])
{
    CLAST_ASSERT(k >= 0 && k <= 3);
    for (int c = 0; c < k; ++c) {
        int best = c;
        for (int r = c + 1; r < k; ++r) {
            best = fabs(m[r][c]) > fabs(m[best][c]) ? r : best;
        }
        for (int j = 0; j <= k; ++j) {
            const double swap = m[c][j];
            m[c][j] = m[best][j];
            m[best][j] = swap;
        }
        if (!(fabs(m[c][c]) > 0.0)) {
            return false;
        }
        for (int r = c + 1; r < k; ++r) {
            const double f = m[r][c] / m[c][c];
            for (int j = c; j <= k; ++j) {
                m[r][j] -= f * m[c][j];
            }
        }
    }
    for (int c = k - 1; c >= 0; --c) {
        x[c] = m[c][k];
        for (int j = c + 1; j < k; ++j) {
            x[c] -= m[c][j] * x[j];
        }
        x[c] /= m[c][c];
    }
    return true;
}

/// Smallest sphere through the bound points: centre p0 + sum x_i d_i with d_i.(sum x_j d_j) =
/// d_i^2 / 2. False when they are affinely dependent.
static bool through_bound(search *s)
{
    CLAST_ASSERT(s->n_bound >= 1 && s->n_bound <= 4);
    double d[3][3];
    double m[3][4];
    double x[3];
    const int k = s->n_bound - 1;
    double offset[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < k; ++i) {
        v3_sub(d[i], s->bound[i + 1], s->bound[0]);
    }
    for (int i = 0; i < k; ++i) {
        for (int j = 0; j < k; ++j) {
            m[i][j] = v3_dot(d[i], d[j]);
        }
        m[i][k] = 0.5 * m[i][i];
    }
    if (!solve(k, m, x)) {
        return false;
    }
    for (int i = 0; i < k; ++i) {
        v3_axpy(offset, offset, x[i], d[i]);
    }
    v3_add(s->centre, s->bound[0], offset);
    s->radius2 = v3_norm2(offset);
    return isfinite(s->radius2);
}

static bool is_outside(const search *s, const double p[3])
{
    return s->radius2 < 0.0 || v3_distance2(p, s->centre) > s->radius2 * inside_share;
}

/// Smallest sphere about order[0..n) with the bound points on it.
static void move_to_front(search *s, int32_t n)
{
    if (s->n_bound == 4) {
        return;
    }
    for (int32_t i = 0; i < n; ++i) {
        const int32_t p = s->order[i];
        if (!is_outside(s, s->point[p])) {
            continue;
        }
        const search before = *s;
        v3_copy(s->bound[s->n_bound++], s->point[p]);
        if (through_bound(s)) {
            move_to_front(s, i);
            s->n_bound = before.n_bound;
            for (int32_t j = i; j > 0; --j) {
                s->order[j] = s->order[j - 1];
            }
            s->order[0] = p;
        } else {
            *s = before; // dependent: the sphere through the others already carries it
        }
    }
}

void clx_miniball(int32_t n, const double (*point)[3], int32_t *order, double centre[3],
                  double *radius)
{
    CLAST_ASSERT(n >= 1);
    search s = {.point = point, .order = order, .radius2 = -1.0};
    int32_t n_front = 0;
    for (int32_t i = 0; i < n; ++i) {
        order[i] = i;
    }
    v3_copy(s.centre, point[0]);
    s.radius2 = 0.0;
    for (int pass = 0; pass < MAX_PIVOTS; ++pass) {
        int32_t far = -1;
        double most = s.radius2 * inside_share;
        for (int32_t i = 0; i < n; ++i) {
            const double d2 = v3_distance2(point[order[i]], s.centre);
            if (d2 > most) {
                most = d2;
                far = i;
            }
        }
        if (far < 0) {
            break;
        }
        const int32_t p = order[far];
        for (int32_t j = far; j > 0; --j) {
            order[j] = order[j - 1];
        }
        order[0] = p;
        n_front = far < n_front ? n_front : n_front + 1;
        s.n_bound = 0;
        s.radius2 = -1.0;
        move_to_front(&s, n_front);
    }
    v3_copy(centre, s.centre);
    *radius = sqrt(fmax(s.radius2, 0.0));
}
