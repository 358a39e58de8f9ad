// Distance-to-boundary score: how far the distribution of depths is from that of uniform points.
//
// Depths of a uniform point in a box, over half the shortest side: H(z) = 1 - prod_j (1 - c_j z),
// c_j = shortest side / side j. Between two order statistics G_n is constant and crosses H at most
// once, and H is a polynomial: the integral of |G_n - H| is exact. Its expectation follows from de
// Moivre's E|Bin(n, p)/n - p|.     [docs/theory/uniformity.md]
#include "cloud/boundary_score.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/contract.h"
#include "math/quadrature.h"
#include "math/special.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <math.h>
#include <string.h>

clx_depth_law clx_depth_law_of_box(int32_t d, const double *side)
{
    CLAST_ASSERT(d >= 1 && d <= 3);
    clx_depth_law law = {.d = d};
    double shortest = side[0];
    for (int32_t j = 1; j < d; ++j) {
        shortest = fmin(shortest, side[j]);
    }
    for (int32_t j = 0; j < d; ++j) {
        law.c[j] = shortest / side[j];
    }
    return law;
}

double clx_depth_cdf(const clx_depth_law *law, double z)
{
    double outside = 1.0;
    for (int32_t j = 0; j < law->d; ++j) {
        outside *= 1.0 - law->c[j] * z;
    }
    return 1.0 - outside;
}

static double depth_density(const clx_depth_law *law, double z)
{
    double density = 0.0;
    for (int32_t j = 0; j < law->d; ++j) {
        double product = law->c[j];
        for (int32_t i = 0; i < law->d; ++i) {
            product *= i == j ? 1.0 : 1.0 - law->c[i] * z;
        }
        density += product;
    }
    return density;
}

/// Integral of H from 0 to z: H = z e1 - z^2 e2 + z^3 e3 with the elementary symmetric sums of c.
static double depth_integral(const clx_depth_law *law, double z)
{
    const double *c = law->c;
    const double e1 = c[0] + (law->d > 1 ? c[1] : 0.0) + (law->d > 2 ? c[2] : 0.0);
    const double e2 =
        law->d < 2 ? 0.0 : c[0] * c[1] + (law->d > 2 ? c[0] * c[2] + c[1] * c[2] : 0.0);
    const double e3 = law->d < 3 ? 0.0 : c[0] * c[1] * c[2];
    return z * z * (e1 / 2.0 - z * (e2 / 3.0 - z * e3 / 4.0));
}

static double depth_quantile(const clx_depth_law *law, double p)
{
    double low = 0.0;
    double high = 1.0;
    double z = p;
    if (p <= 0.0 || p >= 1.0) {
        return p <= 0.0 ? 0.0 : 1.0;
    }
    for (int i = 0; i < 100 && high - low > 1e-16; ++i) { // Newton inside a bracket
        const double f = clx_depth_cdf(law, z) - p;
        if (f > 0.0) {
            high = z;
        } else {
            low = z;
        }
        const double slope = depth_density(law, z);
        const double next = slope > 0.0 ? z - f / slope : low;
        if (fabs(next - z) <= 1e-16) {
            break;
        }
        z = next > low && next < high ? next : 0.5 * (low + high);
    }
    return z;
}

/// Integral of |g - H| over [a, b], g constant.
static double constant_part(const clx_depth_law *law, double g, double a, double b)
{
    const double cross = clx_depth_cdf(law, a) >= g   ? a // H is above g in all of [a, b]
                         : clx_depth_cdf(law, b) <= g ? b
                                                      : depth_quantile(law, g);
    const double below = g * (cross - a) - (depth_integral(law, cross) - depth_integral(law, a));
    const double above = depth_integral(law, b) - depth_integral(law, cross) - g * (b - cross);
    return below + above;
}

enum { POINTS_A_BLOCK = 16384 };

enum { KINK_LIMIT = 4096, KINK_EDGE = 512, N_PANEL = 64 };

/// Integral of E|Bin(n, H)/n - H| over z between H = low/n and H = high/n: Gauss-Legendre between
/// the kinks at k/n.
static double ideal_by_kinks(const clx_depth_law *law, int64_t n, int64_t low, int64_t high)
{
    double sum = 0.0;
    double a = depth_quantile(law, (double)low / (double)n);
    for (int64_t k = low + 1; k <= high; ++k) {
        const double b = depth_quantile(law, (double)k / (double)n);
        for (int q = 0; q < CLX_GAUSS_N; ++q) {
            const double z = a + (b - a) * clx_gauss_point(q);
            sum += (b - a) * clx_gauss_weight(q) *
                   clx_binomial_deviation((double)n, clx_depth_cdf(law, z));
        }
        a = b;
    }
    return sum;
}

/// E|Bin(n, p)/n - p| / sqrt(p (1 - p)), averaged over the kink that holds p: a smooth function of
/// p.
static double mean_ratio(double n, double p)
{
    const double first = floor(n * p);
    double sum = 0.0;
    for (int q = 0; q < CLX_GAUSS_N; ++q) {
        const double x = (first + clx_gauss_point(q)) / n;
        sum += clx_gauss_weight(q) * clx_binomial_deviation(n, x) / sqrt(x * (1.0 - x));
    }
    return sum;
}

/// s with s^2 (3 - 2 s) = z; this map flattens the square roots at both ends.
static double flat_parameter(double z)
{
    return 0.5 - sin(asin(1.0 - 2.0 * z) / 3.0);
}

/// The middle of the integral for many points, kinks averaged out.
static double ideal_smooth(const clx_depth_law *law, double n, double z_low, double z_high)
{
    const double s_low = flat_parameter(z_low);
    const double s_high = flat_parameter(z_high);
    double sum = 0.0;
    for (int i = 0; i < N_PANEL * CLX_GAUSS_N; ++i) {
        const int panel = i / CLX_GAUSS_N;
        const double t = (panel + clx_gauss_point(i % CLX_GAUSS_N)) / N_PANEL;
        const double s = s_low + (s_high - s_low) * t;
        const double h = clx_depth_cdf(law, s * s * (3.0 - 2.0 * s));
        sum += clx_gauss_weight(i % CLX_GAUSS_N) * 6.0 * s * (1.0 - s) * sqrt(h * (1.0 - h)) *
               mean_ratio(n, h);
    }
    return sum * (s_high - s_low) / N_PANEL;
}

double clx_depth_ideal(const clx_depth_law *law, double n_point)
{
    const int64_t n = (int64_t)fmax(1.0, floor(n_point + 0.5));
    if (n <= KINK_LIMIT) {
        return ideal_by_kinks(law, n, 0, n);
    }
    const double edge = (double)KINK_EDGE / (double)n;
    return ideal_by_kinks(law, n, 0, KINK_EDGE) + ideal_by_kinks(law, n, n - KINK_EDGE, n) +
           ideal_smooth(law, (double)n, depth_quantile(law, edge), depth_quantile(law, 1.0 - edge));
}

double clast_boundary_score_ideal(double n, int32_t d, const double *side)
{
    if (side == NULL || d < 1 || d > 3) {
        return (double)NAN;
    }
    const clx_depth_law law = clx_depth_law_of_box(d, side);
    return clx_depth_ideal(&law, n);
}

double clx_depth_of(const clx_depth_law *law, const double *u)
{
    double depth = 1.0;
    for (int32_t j = 0; j < law->d; ++j) {
        depth = fmin(depth, 2.0 * fmin(u[j], 1.0 - u[j]) / law->c[j]);
    }
    return depth;
}

typedef struct {
    const clx_depth_law *law;
    const clx_part *part;
    int32_t axis;
    uint64_t *key;
} key_context;

uint64_t clx_depth_key(double z)
{
    uint64_t key = 0;
    const double own = z + 0.0; // no -0
    CLAST_ASSERT(own >= 0.0 && own <= 1.0);
    memcpy(&key, &own, sizeof key);
    return key;
}

static void compute_keys(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const key_context *c = context;
    double held[3];
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const double *u = clx_part_point(c->part, i, held);
        c->key[i] = clx_depth_key(c->axis < 0 ? clx_depth_of(c->law, u) : u[c->axis]);
    }
}

/// The number before this rank's first: the last of the ranks before, 0 where there is none.
static clast_status find_before(const clast_comm *comm, clx_depths *depths)
{
    clast_status status = CLAST_OK;
    int64_t *last = NULL;
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&last, comm->n_rank, sizeof *last), NULL));
    const clx_ranked *r = &depths->ranked;
    last[comm->rank] = r->n > 0 ? (int64_t)r->key[r->n - 1] : 0;
    clx_comm_sum(comm, last, comm->n_rank);
    int64_t before = 0;
    for (int32_t k = 0; k < comm->rank; ++k) {
        before = last[k] > before ? last[k] : before;
    }
    memcpy(&depths->before, &before, sizeof before);
done:
    clx_free(last);
    return status;
}

clast_status clx_depths_of_keys(const clast_comm *comm, uint64_t **key, int64_t n,
                                clx_depths *depths)
{
    clast_status status = CLAST_OK;
    const uint64_t limit = UINT64_C(0x3ff0000000000001); // 1.0, and one more
    clx_depths made = {{0}, 0.0};
    CLX_TRY(clx_ranked_sort(comm, key, n, limit, &made.ranked));
    CLX_TRY(find_before(comm, &made));
    *depths = made;
    made = (clx_depths){{0}, 0.0};
done:
    clx_depths_free(&made);
    return status;
}

clast_status clx_depths_sort(const clx_depth_law *law, const clx_part *part, int32_t axis,
                             clx_depths *depths)
{
    clast_status status = CLAST_OK;
    key_context c = {law, part, axis, NULL};
    CLX_TRY(clast_comm_agree(part->comm, clx_alloc(&c.key, part->n, sizeof *c.key), NULL));
    clx_parallel_for(part->n, POINTS_A_BLOCK, compute_keys, &c);
    CLX_TRY(clx_depths_of_keys(part->comm, &c.key, part->n, depths));
done:
    clx_free(c.key);
    return status;
}

void clx_depths_free(clx_depths *depths)
{
    clx_ranked_free(&depths->ranked);
    *depths = (clx_depths){{0}, 0.0};
}

static double depth_at(const clx_depths *depths, int64_t i)
{
    double z = depths->before;
    if (i >= 0) {
        memcpy(&z, &depths->ranked.key[i], sizeof z);
    }
    return z;
}

/// What the step of G_n from depth number k - 1 to number k adds.
typedef double (*step_term)(const clx_depth_law *law, int64_t k, int64_t n, const double z[2]);

static double distance_term(const clx_depth_law *law, int64_t k, int64_t n, const double z[2])
{
    return z[1] > z[0] ? constant_part(law, (double)k / (double)n, z[0], z[1]) : 0.0;
}

static double trapezoid_term(const clx_depth_law *law, int64_t k, int64_t n, const double z[2])
{
    if (k == 0 || k == n) {
        return 0.0; // not before the first, nor after the last
    }
    const double before = fabs((double)k / (double)n - clx_depth_cdf(law, z[0]));
    const double here = fabs((double)(k + 1) / (double)n - clx_depth_cdf(law, z[1]));
    return 0.5 * (here + before) * (z[1] - z[0]);
}

typedef struct {
    const clx_depth_law *law;
    const clx_depths *depths;
    step_term term;
    clx_exact_sum *sum; ///< a worker each
} step_context;

static void sum_steps_here(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const step_context *c = context;
    const clx_ranked *r = &c->depths->ranked;
    for (int64_t i = begin; i < end; ++i) {
        const double z[2] = {depth_at(c->depths, i - 1), depth_at(c->depths, i)};
        clx_exact_add(&c->sum[worker], c->term(c->law, r->before + i, r->n_all, z));
    }
}

static clast_status sum_terms(const clx_depth_law *law, const clast_comm *comm,
                              const clx_depths *depths, step_term term, double *value)
{
    clast_status status = CLAST_OK;
    const clx_ranked *r = &depths->ranked;
    const int32_t n_worker = clx_parallel_workers();
    step_context c = {law, depths, term, NULL};
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&c.sum, n_worker, sizeof *c.sum), NULL));
    clx_parallel_for(r->n, POINTS_A_BLOCK, sum_steps_here, &c);
    if (r->n > 0 && r->before + r->n == r->n_all) {
        const double z[2] = {depth_at(depths, r->n - 1), 1.0};
        clx_exact_add(&c.sum[0], term(law, r->n_all, r->n_all, z));
    }
    for (int32_t w = 1; w < n_worker; ++w) {
        clx_exact_merge(&c.sum[0], &c.sum[w]);
    }
    clx_exact_over(comm, c.sum, 1);
    *value = clx_exact_value(&c.sum[0]);
done:
    clx_free(c.sum);
    return status;
}

clast_status clx_depths_distance(const clx_depth_law *law, const clast_comm *comm,
                                 const clx_depths *depths, double *distance)
{
    return sum_terms(law, comm, depths, distance_term, distance);
}

clast_status clx_depths_trapezoid(const clx_depth_law *law, const clast_comm *comm,
                                  const clx_depths *depths, double *distance)
{
    return sum_terms(law, comm, depths, trapezoid_term, distance);
}

clast_status clast_boundary_score_test(const double *u, int64_t n, int32_t d, const double *side,
                                       clast_boundary_score *result)
{
    CLX_ARGUMENTS(u, side, result);
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    clast_boundary_score made = {0};
    clx_depths depths = {{0}, 0.0};
    const clx_depth_law line = {.d = 1, .c = {1.0}};
    CLX_TRY(clx_cube_check(u, n, d, 1, "a boundary score"));
    for (int32_t j = 0; j < d; ++j) {
        CLX_CHECK(side[j] > 0.0 && isfinite(side[j]), CLAST_E_ARGUMENT,
                  "side %d of the domain is %g", j, side[j]);
    }
    const clx_part part = clx_part_whole(u, n, d);
    const clx_depth_law law = clx_depth_law_of_box(d, side);
    CLX_TRY(clx_depths_sort(&law, &part, -1, &depths));
    CLX_TRY(clx_depths_distance(&law, part.comm, &depths, &made.score));
    CLX_TRY(clx_depths_trapezoid(&law, part.comm, &depths, &made.trapezoid));
    made.ideal = clx_depth_ideal(&law, (double)n);
    for (int32_t j = 0; j < d; ++j) {
        clx_depths_free(&depths);
        CLX_TRY(clx_depths_sort(&line, &part, j, &depths));
        CLX_TRY(clx_depths_distance(&line, part.comm, &depths, &made.projected_axis[j]));
        made.projected += made.projected_axis[j];
    }
    *result = made;
done:
    clx_depths_free(&depths);
    return status;
}
