// Volume, centroid and inertia of a union of spheres, in closed form up to rounding.
//
// The divergence theorem turns each integral over the union into integrals of polynomials over the
// exposed parts of the spheres; spherical harmonics turn those into integrals over the exposed arcs
// of the circles where spheres cut each other, and only the bare area needs solid angles. See
// docs/theory/union-of-spheres.md, whose equations are numbered here.
//
// Arrangements such as clumps on a lattice are full of circles that touch or meet in one point, so
// each radius is first changed by up to 1e-12 of itself: the answer is that of the nearby general
// arrangement, 3e-12 off at most.
#include "shape/shape.h"

#include "base/alloc.h"
#include "math/sort.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <clast/shape.h>
#include <stdlib.h>

/// Overlaps shallower than this share of the smaller radius are taken as touches; what they hide is
/// below 1e-17 of a sphere.
#define TOUCH  1e-9
#define NUDGE  1e-12
#define UNSURE 1e-5

/// The part of the unit sphere that another sphere covers: n.axis > height.
typedef struct {
    double axis[3];
    double height;
} cap;

/// A covered stretch of a circle, from angle `begin` over `length`, with its end points.
typedef struct {
    double begin, length;
    double first[3], last[3];
} stretch;

/// Integrals over the exposed part of one unit sphere, n its normal.
typedef struct {
    double area;
    double n1[3];
    double n2[3][3];
    double n3[3][3][3];
} moments;

typedef struct {
    const clast_spheres *spheres;
    double origin[3]; ///< all coordinates are taken from here
    double *radius;   ///< [n] nudged
    cap *caps;        ///< [n] of the sphere at hand
    int32_t n_cap;
    stretch *hidden; ///< [n] of the circle at hand
    int32_t n_hidden;
} scratch;

/// A circle of the sphere at hand with its frame: n(t) = height axis + sine (cos t a + sin t b).
typedef struct {
    const cap *of;
    double sine;
    double a[3], b[3];
} circle;

static void circle_point(const circle *c, double t, double n[3])
{
    const double x = c->sine * cos(t);
    const double y = c->sine * sin(t);
    for (int k = 0; k < 3; ++k) {
        n[k] = c->of->height * c->of->axis[k] + x * c->a[k] + y * c->b[k];
    }
}

/// Solid angle of the geodesic triangle (p, q, r), signed.           [VanOosterom1983 eq. 8]
static double triangle_area(const double p[3], const double q[3], const double r[3])
{
    double cross[3];
    v3_cross(cross, q, r);
    return 2.0 * atan2(v3_dot(p, cross), 1.0 + v3_dot(p, q) + v3_dot(q, r) + v3_dot(r, p));
}

/// Adds the boundary integrand of eq. 4-6 at n with outward conormal times length v.
static void add_boundary(moments *m, const double n[3], const double v[3], double weight)
{
    for (int a = 0; a < 3; ++a) {
        m->n1[a] -= weight * v[a] / 2.0;
        for (int b = 0; b < 3; ++b) {
            m->n2[a][b] -= weight * (v[a] * n[b] + n[a] * v[b]) / 6.0;
            for (int c = 0; c < 3; ++c) {
                const double product = v[a] * n[b] * n[c] + n[a] * v[b] * n[c] + n[a] * n[b] * v[c];
                const double trace =
                    (a == b ? v[c] : 0.0) + (b == c ? v[a] : 0.0) + (a == c ? v[b] : 0.0);
                m->n3[a][b][c] -= weight * (product - trace / 5.0) / 12.0;
            }
        }
    }
}

/// Exposed arc of at most a quarter circle, from p at angle t to q at angle t + span: the area on
/// its covered side, and the boundary integrals by Gauss-Legendre of 10 points (trigonometric
/// polynomials of degree 3: exact to rounding).
static double add_piece(moments *m, const circle *c, double t, double span, const double p[3],
                        const double q[3])
{
    static const double node[5] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                   0.8650633666889845, 0.9739065285171717};
    static const double weight[5] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820,
                                     0.1494513491505806, 0.0666713443086881};
    static const double pole[3] = {0.2672612419124244, 0.5345224838248488, 0.8017837257372732};
    for (int i = -5; i < 5; ++i) {
        const int k = i < 0 ? -1 - i : i;
        double n[3];
        double v[3];
        circle_point(c, t + 0.5 * span * (1.0 + (i < 0 ? -node[k] : node[k])), n);
        v3_axpy(v, c->of->axis, -c->of->height, n); // conormal times ds / dt
        add_boundary(m, n, v, 0.5 * span * weight[k]);
    }
    return triangle_area(pole, p, q) + span * (1.0 - c->of->height) -
           triangle_area(c->of->axis, p, q);
}

static double add_arc(moments *m, const circle *c, double t, double span, const double first[3],
                      const double last[3])
{
    CLAST_ASSERT(span > 0.0);
    const int n_piece = (int)ceil(span / (0.5 * CLAST_PI));
    const double step = span / n_piece;
    double covered = 0.0;
    double p[3];
    double q[3];
    v3_copy(p, first);
    for (int i = 0; i < n_piece; ++i) {
        circle_point(c, t + (i + 1) * step, q);
        if (i + 1 == n_piece) {
            v3_copy(q, last);
        }
        covered += add_piece(m, c, t + i * step, step, p, q);
        v3_copy(p, q);
    }
    return covered;
}

/// Where circles k and l of a sphere meet: P = alpha u_k + beta u_l -+ gamma u_k x u_l, the same
/// numbers whichever is asked first. False when they do not meet.
static bool meet(const cap *k, const cap *l, double minus[3], double plus[3])
{
    const double g = v3_dot(k->axis, l->axis);
    double cross[3];
    v3_cross(cross, k->axis, l->axis);
    const double d = v3_norm2(cross);
    if (d < 1e-28) {
        return false;
    }
    const double alpha = (k->height - g * l->height) / d;
    const double beta = (l->height - g * k->height) / d;
    const double gamma2 = (1.0 - alpha * k->height - beta * l->height) / d;
    if (!(gamma2 > 0.0)) {
        return false;
    }
    for (int i = 0; i < 3; ++i) {
        const double middle = alpha * k->axis[i] + beta * l->axis[i];
        minus[i] = middle - sqrt(gamma2) * cross[i];
        plus[i] = middle + sqrt(gamma2) * cross[i];
    }
    return true;
}

static double angle_on(const circle *c, const double p[3])
{
    return atan2(v3_dot(p, c->b), v3_dot(p, c->a));
}

CLX_RISING(by_begin, stretch, begin)

/// Fills s->hidden with what the other caps hide of circle k; true when they hide all of it.
static bool hide(scratch *s, int32_t k, const circle *c)
{
    s->n_hidden = 0;
    for (int32_t l = 0; l < s->n_cap; ++l) {
        stretch *h = &s->hidden[s->n_hidden];
        const cap *other = &s->caps[l];
        if (l == k) {
            continue;
        }
        const bool meets =
            k < l ? meet(c->of, other, h->first, h->last) : meet(other, c->of, h->last, h->first);
        if (meets) {
            h->begin = angle_on(c, h->first);
            h->length = angle_on(c, h->last) - h->begin;
            h->length += h->length < 0.0 ? 2.0 * CLAST_PI : 0.0;
            ++s->n_hidden;
        } else if (c->of->height * v3_dot(c->of->axis, other->axis) > other->height) {
            return true;
        }
    }
    return false;
}

/// Adds the exposed arcs of circle k; returns the area on their covered side (modulo 4 pi).
static double add_circle(scratch *s, int32_t k, moments *m, bool *exposed)
{
    circle c = {.of = &s->caps[k]};
    double start[3];
    c.sine = sqrt((1.0 - c.of->height) * (1.0 + c.of->height));
    v3_frame(c.of->axis, c.a, c.b);
    if (hide(s, k, &c)) {
        return 0.0;
    }
    if (s->n_hidden == 0) {
        *exposed = true;
        circle_point(&c, 0.0, start);
        return add_arc(m, &c, 0.0, 2.0 * CLAST_PI, start, start);
    }
    qsort(s->hidden, (size_t)s->n_hidden, sizeof *s->hidden, by_begin);
    double covered = 0.0;
    double covered_to = -INFINITY; // how far stretches that began before have come
    const double *at = NULL;
    for (int pass = 0; pass < 2; ++pass) { // the first turn only finds what reaches over the start
        for (int32_t i = 0; i < s->n_hidden; ++i) {
            const stretch *h = &s->hidden[i];
            const double begin = h->begin + 2.0 * CLAST_PI * pass;
            if (pass == 1 && begin > covered_to) {
                *exposed = true;
                covered += add_arc(m, &c, covered_to, begin - covered_to, at, h->first);
            }
            if (begin + h->length > covered_to) {
                covered_to = begin + h->length;
                at = h->last;
            }
        }
    }
    return covered;
}

/// Whether most of the sphere at hand is covered, by 200 even directions.
static bool mostly_covered(const scratch *s)
{
    enum { N = 200 };
    int n_covered = 0;
    for (int i = 0; i < N; ++i) {
        const double z = (2.0 * i + 1.0) / N - 1.0;
        const double r = sqrt(1.0 - z * z);
        const double angle = 2.399963229728653 * i; // golden angle
        const double n[3] = {r * cos(angle), r * sin(angle), z};
        for (int32_t k = 0; k < s->n_cap; ++k) {
            if (v3_dot(n, s->caps[k].axis) > s->caps[k].height) {
                ++n_covered;
                break;
            }
        }
    }
    return 2 * n_covered > N;
}

/// Covered area from its value modulo 4 pi; next to 0 and 4 pi directions decide which it is.
static double settle_covered(const scratch *s, double covered)
{
    const double all = 4.0 * CLAST_PI;
    covered -= all * floor(covered / all);
    if (covered < UNSURE && mostly_covered(s)) {
        covered += all;
    } else if (covered > all - UNSURE && !mostly_covered(s)) {
        covered -= all;
    }
    return fmin(fmax(covered, 0.0), all);
}

/// Completes what add_boundary began by the terms of eq. 5 and 6 that hold lower moments.
static void complete(moments *m)
{
    for (int a = 0; a < 3; ++a) {
        m->n2[a][a] += m->area / 3.0;
        for (int b = 0; b < 3; ++b) {
            for (int c = 0; c < 3; ++c) {
                m->n3[a][b][c] += ((a == b ? m->n1[c] : 0.0) + (b == c ? m->n1[a] : 0.0) +
                                   (a == c ? m->n1[b] : 0.0)) /
                                  5.0;
            }
        }
    }
}

static void exposed_moments(scratch *s, moments *m)
{
    bool exposed = s->n_cap == 0;
    double covered = 0.0;
    *m = (moments){0};
    for (int32_t k = 0; k < s->n_cap; ++k) {
        covered += add_circle(s, k, m, &exposed);
    }
    if (exposed) {
        m->area = 4.0 * CLAST_PI - (s->n_cap > 0 ? settle_covered(s, covered) : 0.0);
        complete(m);
    }
}

/// Caps that the others cut from sphere i; false when one of them holds it whole.
static bool find_caps(scratch *s, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < s->spheres->n);
    const double r = s->radius[i];
    s->n_cap = 0;
    for (int32_t j = 0; j < s->spheres->n; ++j) {
        double apart[3];
        const double q = s->radius[j];
        v3_sub(apart, s->spheres->centre[j], s->spheres->centre[i]);
        const double d = v3_norm(apart);
        if (j == i || d >= r + q - TOUCH * fmin(r, q)) {
            continue;
        }
        if (q > d + r || (q == d + r && j < i)) {
            return false;
        }
        if (r > d + q) {
            continue; // inside
        }
        cap *c = &s->caps[s->n_cap++];
        v3_scale(c->axis, 1.0 / d, apart);
        c->height = (d * d + (r - q) * (r + q)) / (2.0 * d * r);
        c->height = fmin(fmax(c->height, -1.0), 1.0);
    }
    return true;
}

/// Integrals over the union of 1, x_k and x_j x_k, from s->origin.
typedef struct {
    double volume;
    double first[3];
    double second[3][3];
} integrals;

/// Adds a sphere's share of eq. 1-3: x = c + r n, x.n = c.n + r.
static void add_sphere(integrals *sum, const moments *m, const double c[3], double r)
{
    double flux1[3] = {0}; // of n_a (c.n + r)
    double flux2[3][3] = {{0}};
    const double flux = v3_dot(c, m->n1) + r * m->area;
    for (int a = 0; a < 3; ++a) {
        flux1[a] = v3_dot(c, m->n2[a]) + r * m->n1[a];
        for (int b = 0; b < 3; ++b) {
            flux2[a][b] = v3_dot(c, m->n3[a][b]) + r * m->n2[a][b];
        }
    }
    sum->volume += r * r * flux / 3.0;
    for (int a = 0; a < 3; ++a) {
        sum->first[a] += r * r * (c[a] * flux + r * flux1[a]) / 4.0;
        for (int b = 0; b < 3; ++b) {
            sum->second[a][b] += r * r *
                                 (c[a] * c[b] * flux + r * (c[a] * flux1[b] + c[b] * flux1[a]) +
                                  r * r * flux2[a][b]) /
                                 5.0;
        }
    }
}

static void mass_of(const integrals *sum, const double origin[3], clast_mass *mass)
{
    double mean[3];
    double c[3][3];
    v3_scale(mean, 1.0 / sum->volume, sum->first);
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            c[a][b] = sum->second[a][b] - sum->volume * mean[a] * mean[b];
        }
    }
    const double trace = c[0][0] + c[1][1] + c[2][2];
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            mass->inertia[a][b] = (a == b ? trace : 0.0) - 0.5 * (c[a][b] + c[b][a]);
        }
    }
    mass->volume = sum->volume;
    v3_add(mass->centroid, origin, mean);
}

static clast_status check_spheres(const clast_spheres *spheres)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(spheres->n > 0, CLAST_E_GEOMETRY, "a union of no spheres has no volume");
    for (int32_t i = 0; i < spheres->n; ++i) {
        const double *c = spheres->centre[i];
        CLX_CHECK(spheres->radius[i] > 0.0 && isfinite(spheres->radius[i]) &&
                      isfinite(c[0] + c[1] + c[2]),
                  CLAST_E_GEOMETRY, "sphere %d: centre %g, %g, %g, radius %g", i, c[0], c[1], c[2],
                  spheres->radius[i]);
    }
done:
    return status;
}

static bool any_overlap(const clast_spheres *s)
{
    for (int32_t i = 0; i < s->n; ++i) {
        for (int32_t j = i + 1; j < s->n; ++j) {
            const double contact_distance =
                s->radius[i] + s->radius[j] - TOUCH * fmin(s->radius[i], s->radius[j]);
            if (v3_distance2(s->centre[i], s->centre[j]) < contact_distance * contact_distance) {
                return true;
            }
        }
    }
    return false;
}

static clast_status prepare(const clast_spheres *spheres, scratch *s)
{
    clast_status status = CLAST_OK;
    const double nudge = any_overlap(spheres) ? NUDGE : 0.0;
    s->spheres = spheres;
    CLX_TRY(clx_alloc(&s->radius, spheres->n, sizeof *s->radius));
    CLX_TRY(clx_alloc(&s->caps, spheres->n, sizeof *s->caps));
    CLX_TRY(clx_alloc(&s->hidden, spheres->n, sizeof *s->hidden));
    for (int32_t i = 0; i < spheres->n; ++i) {
        const double share = (double)((uint32_t)i * 2654435761u >> 8) * 0x1p-23 - 1.0; // [-1, 1)
        s->radius[i] = spheres->radius[i] * (1.0 + nudge * share);
        v3_axpy(s->origin, s->origin, 1.0 / spheres->n, spheres->centre[i]);
    }
done:
    return status;
}

clast_status clx_spheres_union_measure(const clast_spheres *spheres, clast_mass *mass, double *area)
{
    clast_status status = CLAST_OK;
    scratch s = {0};
    integrals sum = {0};
    double exposed = 0.0;
    CLX_TRY(check_spheres(spheres));
    CLX_TRY(prepare(spheres, &s));
    for (int32_t i = 0; i < spheres->n; ++i) {
        if (find_caps(&s, i)) {
            moments m;
            double c[3];
            exposed_moments(&s, &m);
            v3_sub(c, spheres->centre[i], s.origin);
            add_sphere(&sum, &m, c, s.radius[i]);
            exposed += s.radius[i] * s.radius[i] * m.area;
        }
    }
    mass_of(&sum, s.origin, mass);
    *area = exposed;
done:
    CLX_FREE(s.radius, s.caps, s.hidden);
    return status;
}

clast_status clx_spheres_union_mass(const clast_spheres *spheres, clast_mass *mass)
{
    double area = 0.0;
    return clx_spheres_union_measure(spheres, mass, &area);
}

double clx_spheres_length(const clast_spheres *spheres)
{
    double longest = 0.0;
    for (int32_t i = 0; i < spheres->n; ++i) {
        longest = fmax(longest, 2.0 * spheres->radius[i]);
        for (int32_t j = i + 1; j < spheres->n; ++j) {
            longest = fmax(longest, v3_distance(spheres->centre[i], spheres->centre[j]) +
                                        spheres->radius[i] + spheres->radius[j]);
        }
    }
    return longest;
}
