// Penetration by an expanding polytope.
//
// The polytope is the hull of support points of A - B. Its lowest facet (least signed distance of
// the plane from the origin) is a lower bound of the depth, the support in that facet's direction
// an upper one; the point found there is added until both agree. Slivers (facets without area) keep
// the surface closed but are never asked. All storage is here: no allocation.
#include "convex/gjk.h"

#include "math/vec3.h"

enum { MAX_POINT = 1024, MAX_FACE = 2 * MAX_POINT, MAX_HORIZON = MAX_FACE };

/// Upper minus lower bound that ends the search, in units of the larger body.
static const double TOLERANCE_FLAT = 4e-15;
static const double TOLERANCE_SMOOTH = 1e-13;

/// A new point must lie this far above a facet's plane for the facet to be replaced.
static const double VISIBLE = 1e-15;

typedef struct {
    double normal[3];
    int16_t vert[3];   ///< counter-clockwise from outside
    int16_t beside[3]; ///< facet across side k, from vert[k] to vert[k + 1]
} facet;

typedef struct {
    clx_mink p[MAX_POINT];
    facet face[MAX_FACE];
    double offset[MAX_FACE]; ///< signed distance of the plane; INFINITY: free slot or sliver
    bool is_dead[MAX_FACE];
    int16_t spare[MAX_FACE];         ///< free slots
    int16_t horizon[MAX_HORIZON][2]; ///< facet that stays, its side
    int16_t starts_at[MAX_POINT];    ///< new facet whose horizon side starts at this point
    int16_t stack[MAX_FACE];
    int n_point, n_face, n_spare, n_horizon;
} polytope;

static void set_plane(polytope *h, int f)
{
    double e[3], g[3], n[3];
    facet *face = &h->face[f];
    const double *p = h->p[face->vert[0]].w;
    v3_sub(e, h->p[face->vert[1]].w, p);
    v3_sub(g, h->p[face->vert[2]].w, p);
    v3_cross(n, e, g);
    h->is_dead[f] = false;
    h->offset[f] = INFINITY;
    v3_set(face->normal, 0.0, 0.0, 0.0);
    if (v3_norm2(n) > 1e-26 * v3_norm2(e) * v3_norm2(g) && v3_unit(face->normal, n)) {
        h->offset[f] = v3_dot(face->normal, p);
    }
}

static int new_face(polytope *h, int a, int b, int c)
{
    CLAST_ASSERT(a != b && b != c && c != a);
    const int f = h->n_spare > 0 ? h->spare[--h->n_spare] : h->n_face++;
    h->face[f].vert[0] = (int16_t)a;
    h->face[f].vert[1] = (int16_t)b;
    h->face[f].vert[2] = (int16_t)c;
    set_plane(h, f);
    return f;
}

/// Distance of w above facet f's plane; slivers are never below.
static double height(const polytope *h, int f, const double w[3])
{
    double d[3];
    v3_sub(d, w, h->p[h->face[f].vert[0]].w);
    return v3_dot(h->face[f].normal, d);
}

/// Finds the facets that see point w, from `seed` on, and the horizon around them. False if the
/// horizon does not fit.
static bool find_horizon(polytope *h, int seed, const double w[3])
{
    CLAST_ASSERT(seed >= 0 && seed < h->n_face);
    int n = 0;
    h->n_horizon = 0;
    h->stack[n++] = (int16_t)seed;
    h->is_dead[seed] = true;
    for (int i = 0; i < n; ++i) {
        const facet *face = &h->face[h->stack[i]];
        for (int k = 0; k < 3; ++k) {
            const int16_t g = face->beside[k];
            if (h->is_dead[g]) {
                continue;
            }
            if (height(h, g, w) > VISIBLE) {
                h->is_dead[g] = true;
                h->stack[n++] = g;
            }
        }
    }
    for (int i = 0; i < n; ++i) {
        const facet *face = &h->face[h->stack[i]];
        for (int k = 0; k < 3; ++k) {
            const int16_t g = face->beside[k];
            if (!h->is_dead[g]) {
                for (int16_t m = 0; m < 3; ++m) {
                    if (h->face[g].vert[m] == face->vert[(k + 1) % 3] &&
                        h->face[g].vert[(m + 1) % 3] == face->vert[k]) {
                        h->horizon[h->n_horizon][0] = g;
                        h->horizon[h->n_horizon++][1] = m;
                    }
                }
            }
        }
    }
    for (int i = 0; i < n; ++i) {
        h->offset[h->stack[i]] = INFINITY;
        h->spare[h->n_spare++] = h->stack[i];
    }
    return h->n_face + h->n_horizon < MAX_FACE;
}

/// Joins point `at` with the horizon; false if that is not one simple loop.
static bool close_horizon(polytope *h, int at)
{
    for (int i = 0; i < h->n_horizon; ++i) {
        const facet *kept = &h->face[h->horizon[i][0]];
        h->starts_at[kept->vert[(h->horizon[i][1] + 1) % 3]] = -1;
    }
    for (int i = 0; i < h->n_horizon; ++i) {
        const int g = h->horizon[i][0];
        const int m = h->horizon[i][1];
        const int from = h->face[g].vert[(m + 1) % 3];
        const int f = new_face(h, from, h->face[g].vert[m], at);
        h->face[f].beside[0] = (int16_t)g;
        h->face[g].beside[m] = (int16_t)f;
        if (h->starts_at[from] >= 0) {
            return false;
        }
        h->starts_at[from] = (int16_t)f;
    }
    for (int i = 0; i < h->n_horizon; ++i) {
        const int f = h->face[h->horizon[i][0]].beside[h->horizon[i][1]];
        const int next = h->starts_at[h->face[f].vert[1]];
        if (next < 0) {
            return false;
        }
        h->face[f].beside[1] = (int16_t)next; // side vert[1] -> at
        h->face[next].beside[2] = (int16_t)f; // side at -> vert[0]
    }
    return h->n_horizon >= 3;
}

/// Square of what point c adds to the span of `n` chosen points.
static double spread(const clx_mink *p, const int pick[4], int n, int c)
{
    CLAST_ASSERT(n >= 1 && n <= 3);
    double e[3], f[3], g[3], m[3];
    v3_sub(e, p[c].w, p[pick[0]].w);
    if (n == 1) {
        return v3_norm2(e);
    }
    v3_sub(f, p[pick[1]].w, p[pick[0]].w);
    v3_cross(m, f, e);
    if (n == 2) {
        return v3_norm2(m);
    }
    v3_sub(g, p[pick[2]].w, p[pick[0]].w);
    v3_cross(m, f, g);
    const double volume = v3_dot(m, e);
    return volume * volume;
}

/// The first polytope: GJK's tetrahedron if it has volume, else the widest of its points and the
/// supports along the axes.
static bool first_polytope(clx_gjk_pair *pair, const clx_simplex *simplex, polytope *h)
{
    CLAST_ASSERT(simplex->n >= 1 && simplex->n <= 4);
    static const int faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};
    static const int16_t beside[4][3] = {{1, 2, 3}, {3, 2, 0}, {1, 3, 0}, {0, 2, 1}};
    clx_mink p[10];
    int pick[4] = {0, 1, 2, 3};
    int n = 0;
    for (; n < simplex->n; ++n) {
        p[n] = simplex->p[n];
    }
    const double enough = 1e-6 * pair->size * pair->size * pair->size;
    if (n < 4 || !(spread(p, pick, 3, 3) > enough * enough)) {
        for (int k = 0; k < 6; ++k) {
            double d[3] = {0.0, 0.0, 0.0};
            d[k / 2] = k % 2 == 0 ? 1.0 : -1.0;
            clx_mink_support(pair, d, &p[n++]);
        }
        for (int have = 1; have < 4; ++have) {
            double best = -1.0;
            for (int c = 0; c < n; ++c) {
                const double s = spread(p, pick, have, c);
                if (s > best) {
                    best = s;
                    pick[have] = c;
                }
            }
            if (!(best > 0.0)) {
                return false;
            }
        }
    }
    for (int i = 0; i < 4; ++i) {
        h->p[i] = p[pick[i]];
    }
    double e[3], f[3], g[3], m[3];
    v3_sub(e, h->p[1].w, h->p[0].w);
    v3_sub(f, h->p[2].w, h->p[0].w);
    v3_sub(g, h->p[3].w, h->p[0].w);
    v3_cross(m, e, f);
    if (v3_dot(m, g) > 0.0) { // facet 0 1 2 must look away from point 3
        const clx_mink swap = h->p[1];
        h->p[1] = h->p[2];
        h->p[2] = swap;
    }
    h->n_point = 4;
    h->n_face = h->n_spare = 0;
    for (int i = 0; i < 4; ++i) {
        (void)new_face(h, faces[i][0], faces[i][1], faces[i][2]);
        for (int k = 0; k < 3; ++k) {
            h->face[i].beside[k] = beside[i][k];
        }
    }
    return true;
}

static int lowest(const polytope *h)
{
    CLAST_ASSERT(h->n_face >= 4);
    int best = 0;
    for (int f = 1; f < h->n_face; ++f) {
        best = h->offset[f] < h->offset[best] ? f : best;
    }
    return best;
}

/// From the lowest facet to the one in the same plane (within `tolerance`) that holds the origin's
/// projection; its corners and weights become the simplex.
static void facet_weights(const polytope *h, int f, double weight[3])
{
    const facet *face = &h->face[f];
    double foot[3];
    v3_scale(foot, h->offset[f], face->normal);
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        double e[3], g[3], c[3];
        v3_sub(e, h->p[face->vert[(k + 1) % 3]].w, foot);
        v3_sub(g, h->p[face->vert[(k + 2) % 3]].w, foot);
        v3_cross(c, e, g);
        weight[k] = v3_dot(c, face->normal);
        sum += weight[k];
    }
    for (int k = 0; k < 3; ++k) {
        weight[k] /= sum;
    }
}

static int facet_of_foot(const polytope *h, int f, double tolerance, double weight[3])
{
    for (int step = 0; step < 64; ++step) {
        facet_weights(h, f, weight);
        int k = 0;
        for (int m = 1; m < 3; ++m) {
            k = weight[m] < weight[k] ? m : k;
        }
        if (weight[k] >= 0.0) {
            return f;
        }
        const int g = h->face[f].beside[(k + 1) % 3]; // across the side opposite corner k
        if (!(h->offset[g] <= h->offset[f] + tolerance) ||
            v3_dot(h->face[f].normal, h->face[g].normal) < 1.0 - 1e-12) {
            break;
        }
        f = g;
    }
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) { // outside by rounding, or on a part not yet grown
        weight[k] = fmax(weight[k], 0.0);
        sum += weight[k];
    }
    for (int k = 0; k < 3; ++k) {
        weight[k] /= sum;
    }
    return f;
}

static void store(const polytope *h, int f, double tolerance, clx_simplex *simplex)
{
    double weight[3];
    f = facet_of_foot(h, f, tolerance, weight);
    simplex->n = 3;
    for (int k = 0; k < 3; ++k) {
        simplex->p[k] = h->p[h->face[f].vert[k]];
        simplex->weight[k] = weight[k];
    }
}

static bool is_known(const polytope *h, const clx_mink *p)
{
    for (int i = 0; i < h->n_point; ++i) {
        const double *w = h->p[i].w;
        if (w[0] == p->w[0] && w[1] == p->w[1] && w[2] == p->w[2]) {
            return true;
        }
    }
    return false;
}

double clx_epa(clx_gjk_pair *pair, clx_simplex *simplex, double normal[3], double *depth)
{
    CLAST_ASSERT(pair->size >= 0.0);
    polytope h;
    const double tolerance = pair->size * (pair->is_smooth ? TOLERANCE_SMOOTH : TOLERANCE_FLAT);
    double upper = INFINITY; // the least support met
    double lower = -INFINITY;
    if (!first_polytope(pair, simplex, &h)) {
        return INFINITY;
    }
    for (;;) {
        clx_mink p;
        const int f = lowest(&h);
        if (h.offset[f] >= (double)INFINITY) {
            break;
        }
        lower = h.offset[f];
        clx_mink_support(pair, h.face[f].normal, &p);
        const double bound = v3_dot(p.w, h.face[f].normal);
        if (bound < upper) {
            upper = bound;
            v3_copy(normal, h.face[f].normal);
            store(&h, f, 1e-12 * pair->size, simplex);
        }
        if (upper - lower <= tolerance) {
            break;
        }
        if (is_known(&h, &p)) { // the plane of a thin facet was off by rounding
            h.offset[f] = bound;
            continue;
        }
        if (h.n_point == MAX_POINT || !find_horizon(&h, f, p.w)) {
            break;
        }
        h.p[h.n_point] = p;
        if (!close_horizon(&h, h.n_point++)) {
            break;
        }
    }
    *depth = upper;
    return upper - lower;
}
