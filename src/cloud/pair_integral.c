// Integral of the squared density as the value at r = 0 of the density's autocorrelation
//
//     A(r) = average over directions u of the integral of f(x) f(x + r u) dx,
//
// which the pairs in shells of distance show for r > 0. A is fitted as a mixture of Gaussians in r,
// A(r) = sum c_j exp(-r^2 / (4 s_j^2)), c_j >= 0: every function that is completely monotone in r^2
// [Schoenberg1938]. Blobs, sheets, lines, plumes, their sums on any background and, by exp(-r / L),
// densities with jumps are of this kind; by exp(-sqrt(r / L)) such with poles. The narrowest s is
// the widest one that fits as well as narrower ones; the interval is that of the profile likelihood
// of Poisson numbers with shapes of half that width allowed, widened by the projection term. A
// density with a pole shows narrower structure the more points there are: a width counts as seen
// where a part of the points would show it too. Where no shape goes with all pairs, as of compact
// clouds at the domain's edges and corners, the inner ones are fitted. [docs/theory/pairs.md
// section 4]
#include "cloud/pair_integral.h"

#include "base/alloc.h"
#include "cloud/pair_mixture.h"
#include "cloud/resolution.h"
#include "math/special.h"
#include <math.h>
#include <string.h>

enum {
    MOST_USED = 24,
    N_BISECT = 12,
    N_STRETCH = 7,    ///< widths tried between two levels
    FINER = 2,        ///< levels narrower than the chosen one that the interval allows
    STAYS = 1,        ///< levels that lie between a width and that of fewer points by chance
    MOST_MOVED = 3,   ///< the same in the family where more lie between
    SHELLS_A_CUT = 3, ///< sqrt(2) in distance
    LEAST_SHELLS = 6  ///< of a window that was cut: a factor of 2
};

/// Where the choices of the fit stand; all measured in docs/theory/pairs.md.
static const double step = 0.70710678118654752; ///< from one s to the next
static const double gain_needed = 4.0;  ///< twice the gain in log-likelihood that a narrower s asks
static const double stretch_loss = 0.5; ///< the same that a wider s between two levels may lose
static const double most_doubt = 0.3;   ///< half width of the profile's interval, as a logarithm,
                                        ///< with which a cloud is resolved
static const double fewer = 0.2;        ///< share of the points that must show the same width
static const double most_hidden = 0.05; ///< most that a pole may add to the value, as a logarithm,
                                        ///< where they do not
static const double most_unseen = 10.0; ///< the same where they do, over the sampling error
                                        ///< 2 / sqrt(n) of n^2
static const double most_between = 0.12; ///< of the families' values, as a logarithm
static const double most_poled = 0.08;   ///< of the value with poles over that without, the same
static const double most_size = 0.125;   ///< of the domain's: pairs closer than that and than the
                                         ///< narrowest s must be so many
static const double least_pairs = 500.0;
static const double least_spatial = 700.0; ///< points that resolve anything in three dimensions: of
                                           ///< fewer whether it is called so moves the value
static const double form_error = 0.01;    ///< half width that no number of pairs takes away: shapes
                                          ///< stand for jumps and frames to so much
static const double least_even = 1000.0;  ///< the same where nothing narrower than that size shows
static const double most_repeated = 0.05; ///< share of repeated points' pairs in the window
static const double joined = 10.0;        ///< expected pairs of joined shells
static const double least_p = 1e-3;       ///< of a fit, numbers divided by their overdispersion
static const double least_window = 1000.0; ///< pairs of a window that was cut
static const double enough_p = 0.1;        ///< of the fit of a window that was cut
static const double window_size = 0.3;     ///< of a cloud's size that pairs.c looks across
static const double chi2_95 = 3.841458820694124;
static const double normal_975 = 1.959963984540054;

/// Integral where twice the log-likelihood has fallen by the quantile: the most (up) or least one.
static double bound(const clx_mixture_fit *f, int32_t n_shape, const clx_mixture *top,
                    double factor, bool up)
{
    double least_total = INFINITY;
    for (int32_t j = 0; j < n_shape; ++j) {
        least_total = fmin(least_total, f->total[j]);
    }
    // the tilt as a share of the least total: -1 .. 0 up, 0 .. infinity down
    double low = 0.0;
    double high = 1.0;
    clx_mixture m = *top;
    const double wanted = top->likelihood - 0.5 * chi2_95 * factor;
    for (int b = 0; b < 60 && !up; ++b) {
        m = clx_mixture_best(f, n_shape, high * least_total);
        if (m.likelihood < wanted) {
            break;
        }
        high *= 4.0;
    }
    for (int b = 0; b < N_BISECT; ++b) {
        const double middle = 0.5 * (low + high);
        m = clx_mixture_best(f, n_shape, (up ? -middle : middle) * least_total);
        if (m.likelihood < wanted) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return m.integral;
}

/// Columns of weighted least squares: how the numbers of pairs change with each parameter.
typedef struct {
    const double *column[MOST_USED + 1];
    double wanted[MOST_USED + 1]; ///< what is asked for, as a sum over the parameters
    int32_t n;
} design;

static void add_column(design *d, const double *column, double wanted)
{
    CLAST_ASSERT(d->n <= MOST_USED);
    d->column[d->n] = column;
    d->wanted[d->n++] = wanted;
}

/// The shapes in use, narrow ones first, and the shape `more`.
static design design_of(const clx_mixture_fit *f, const clx_mixture *m, int32_t n_shape,
                        int32_t more)
{
    design d = {.n = 0};
    for (int32_t j = f->n_shape - 1; j >= 0 && d.n < MOST_USED; --j) {
        if (j == more || (j < n_shape && m->c[j] * f->total[j] > 1e-3)) {
            add_column(&d, f->mass[j], more < 0 || j == more ? 1.0 : 0.0);
        }
    }
    return d;
}

/// How the sum that is wanted answers to the numbers of pairs, whose means are `mean`: a row of
/// (M W M')^-1 M W.
static void respond(const design *d, int32_t n_shell, const double *mean, double *row)
{
    double a[(MOST_USED + 1) * (MOST_USED + 1)];
    double b[MOST_USED + 1];
    for (int32_t i = 0; i < d->n; ++i) {
        b[i] = d->wanted[i];
        for (int32_t j = 0; j < d->n; ++j) {
            double sum = 0.0;
            for (int32_t k = 0; k < n_shell; ++k) {
                sum += mean[k] > 0.0 ? d->column[i][k] * d->column[j][k] / mean[k] : 0.0;
            }
            a[i * d->n + j] = sum * (i == j ? 1.0 + 1e-9 : 1.0);
        }
    }
    clx_mixture_solve(a, d->n, b);
    for (int32_t k = 0; k < n_shell; ++k) {
        row[k] = 0.0;
        for (int32_t i = 0; i < d->n; ++i) {
            row[k] += mean[k] > 0.0 ? b[i] * d->column[i][k] / mean[k] : 0.0;
        }
    }
}

/// How the coefficient of a shape `more` that is added answers to the numbers of pairs.
static void response_of_shape(const clx_mixture_fit *f, const clx_mixture *m, int32_t n_shape,
                              int32_t more, double *row)
{
    double mean[CLAST_MAX_SHELL];
    const design d = design_of(f, m, n_shape, more);
    clx_mixture_expect(f, n_shape, m->c, mean);
    respond(&d, f->in->n_shell, mean, row);
}

/// How the integral answers to them: the coefficients move, and all widths together.
static void response_of_integral(const clx_mixture_fit *f, const clx_mixture *m, int32_t n_shape,
                                 bool moves_widths, double *row)
{
    double mean[CLAST_MAX_SHELL];
    double slope[CLAST_MAX_SHELL];
    design d = design_of(f, m, n_shape, -1);
    clx_mixture_expect(f, n_shape, m->c, mean);
    if (moves_widths) {
        clx_mixture_slope(f, n_shape, m->c, slope);
        add_column(&d, slope, 0.0);
    }
    respond(&d, f->in->n_shell, mean, row);
}

/// Variance of a linear form of the numbers of pairs, by their covariance and as if they were
/// Poisson numbers.
static void variances(const clx_mixture_fit *f, const clx_mixture *m, int32_t n_shape,
                      const double *row, double *full, double *poisson)
{
    double mean[CLAST_MAX_SHELL];
    const int32_t n = f->in->n_shell;
    clx_mixture_expect(f, n_shape, m->c, mean);
    *full = *poisson = 0.0;
    for (int32_t k = 0; k < n; ++k) {
        *poisson += row[k] * row[k] * mean[k];
        for (int32_t l = 0; l < n; ++l) {
            *full += row[k] * row[l] * f->in->covariance[k * n + l] / (f->scale * f->scale);
        }
    }
}

/// How a mixture agrees with the numbers of pairs that it was fitted to.
typedef struct {
    double p;    ///< of Pearson's statistic, by Poisson numbers
    bool misses; ///< beyond what clustered pairs vary by, and by more than a resolved value may err
} agreement;

/// @param factor  overdispersion of the numbers
static agreement agreement_of(const clx_mixture_fit *f, int32_t n_shape, const clx_mixture *m,
                              double factor)
{
    double mean[CLAST_MAX_SHELL];
    double chi2 = 0.0;
    double total = 0.0;
    double seen = 0.0;
    double expected = 0.0;
    int n = 0;
    clx_mixture_expect(f, n_shape, m->c, mean);
    for (int32_t k = 0; k < f->in->n_shell; ++k) {
        seen += f->pairs[k];
        expected += mean[k];
        if (expected >= joined) {
            chi2 += (seen - expected) * (seen - expected) / expected;
            total += expected;
            seen = expected = 0.0;
            ++n;
        }
    }
    if (n < 2) {
        return (agreement){.p = 1.0};
    }
    // mean square of the relative misfit beyond chance, each pair counted alike
    const double square = (chi2 - factor * n) / total;
    return (agreement){.p = clx_chi2_sf(chi2, n - 1),
                       .misses = clx_chi2_sf(chi2 / factor, n - 1) < least_p &&
                                 square > CLX_MOST_BIAS * CLX_MOST_BIAS};
}

/// Variance of the share of a shape two levels below over that of Poisson numbers: pairs of one
/// point with many neighbours do not count as so many numbers. At least 1.
static double overdispersion(const clx_mixture_fit *f, const clx_mixture *m, int32_t level)
{
    double row[CLAST_MAX_SHELL] = {0};
    double full = 0.0;
    double poisson = 0.0;
    const int32_t more = clx_mixture_shapes(f, level + FINER) - 1;
    if (level == f->n_level) {
        return 1.0;
    }
    response_of_shape(f, m, clx_mixture_shapes(f, level), more, row);
    variances(f, m, clx_mixture_shapes(f, level), row, &full, &poisson);
    return poisson > 0.0 ? fmax(1.0, full / poisson) : 1.0;
}

/// What one family of shapes says.
typedef struct {
    int32_t level, moved;      ///< levels from that of fewer points to it
    double likelihood, factor; ///< and the overdispersion that it is to be divided by
    double value, low, high, s;
    double least, most; ///< of the profile alone
    agreement fit;
} answer;

/// Twice the gain in log-likelihood that a narrower level asks for where a share of the points
/// shall show it: their pairs are share^2 as many, and have share as many neighbours.
static double gain_of(double share, double factor)
{
    return gain_needed * (1.0 + share * (factor - 1.0)) / (share * share);
}

/// The widest level that fits as well as all, and how far from it `fewer` points would stop: all
/// the way where they would show no structure at all.
static clx_mixture choose_level(const clx_mixture_fit *f, answer *a)
{
    const clx_mixture all = clx_mixture_best(f, f->n_shape, 0.0);
    clx_mixture m = clx_mixture_best(f, 1, 0.0);
    int32_t of_fewer = -1;
    for (*a = (answer){.level = 0};;
         m = clx_mixture_best(f, clx_mixture_shapes(f, ++a->level), 0.0)) {
        const double gain = 2.0 * (all.likelihood - m.likelihood);
        a->factor = overdispersion(f, &m, a->level);
        of_fewer = of_fewer < 0 && gain <= gain_of(fewer, a->factor) ? a->level : of_fewer;
        if (a->level == f->n_level || gain <= gain_of(1.0, a->factor)) {
            break;
        }
    }
    of_fewer = of_fewer < 0 ? a->level : of_fewer;
    a->moved = of_fewer == 0 && a->level > 0 ? f->n_level : a->level - of_fewer;
    return m;
}

/// The k-th of the factors between two levels, 1 the first.
static double stretch_of(int k)
{
    CLAST_ASSERT(k >= 0 && k <= N_STRETCH);
    return pow(step, -(double)k / (N_STRETCH + 1));
}

/// The greatest of N_STRETCH widths from the level to the one above that fits as well as the best
/// of them. Each is tried, for the likelihood does not fall steadily: a width between two levels is
/// fitted best where one of them meets it.
static double widest_stretch(clx_mixture_fit *f, const answer *a, double likelihood)
{
    double found[N_STRETCH + 1] = {likelihood};
    double most = likelihood;
    int k = a->level > 0 ? N_STRETCH : 0;
    for (int q = 1; q <= k; ++q) {
        clx_mixture_prepare(f->in, f->family, stretch_of(q), f);
        found[q] = clx_mixture_best(f, clx_mixture_shapes(f, a->level), 0.0).likelihood;
        most = fmax(most, found[q]);
    }
    while (k > 0 && 2.0 * (most - found[k]) > stretch_loss * a->factor) {
        --k;
    }
    return stretch_of(k);
}

/// Variance of the integral beyond that of Poisson numbers, with the widths held fast or not: the
/// greater of the two, for the profile may or may not have the Poisson part of the widths.
static double shared_variance(const clx_mixture_fit *f, const clx_mixture *m, int32_t n_shape)
{
    double most = 0.0;
    for (int moves = 0; moves < (n_shape > 1 ? 2 : 1); ++moves) {
        double row[CLAST_MAX_SHELL] = {0};
        double full = 0.0;
        double poisson = 0.0;
        response_of_integral(f, m, n_shape, moves == 1, row);
        variances(f, m, n_shape, row, &full, &poisson);
        most = fmax(most, full - poisson);
    }
    return most;
}

static answer ask(clx_mixture_fit *f)
{
    answer a;
    clx_mixture m = choose_level(f, &a);
    const double factor = a.factor;
    const double enough = widest_stretch(f, &a, m.likelihood);
    clx_mixture_prepare(f->in, f->family, enough, f);
    m = clx_mixture_best(f, clx_mixture_shapes(f, a.level), 0.0);
    const int32_t finer = a.level == 0 ? 1 : clx_mixture_shapes(f, a.level + FINER);
    const clx_mixture top = clx_mixture_best(f, finer, 0.0);
    const double low = bound(f, finer, &top, factor, false);
    const double high = bound(f, finer, &top, factor, true);
    const int32_t n_shape = clx_mixture_shapes(f, a.level);
    const double shared = normal_975 * sqrt(shared_variance(f, &m, n_shape)) / m.integral;
    a.value = m.integral;
    a.least = fmin(low, a.value);
    a.most = fmax(high, a.value);
    a.low = a.value * exp(-hypot(log(a.value / a.least), shared));
    a.high = a.value * exp(hypot(log(a.most / a.value), shared));
    a.s = f->s[a.level];
    a.likelihood = m.likelihood;
    a.fit = agreement_of(f, n_shape, &m, factor);
    return a;
}

/// Pairs that decide the integral: within three widths of the narrowest shape, nine tenths of its
/// own in 3-D.
static void set_window(const clx_pair_shells *in, clast_pair_integral *result)
{
    int32_t k = 0;
    double n_pair = in->pairs[0];
    while (k + 1 < in->n_shell && in->radius[k] < 3.0 * result->scale) {
        n_pair += in->pairs[++k];
    }
    result->window = in->radius[k];
    result->n_pair = (int64_t)llround(n_pair);
}

/// Pairs closer than r; beyond the last shell as in an even cloud.
static double pairs_within(const clx_pair_shells *in, double r)
{
    double sum = 0.0;
    double before = 0.0;
    for (int32_t k = 0; k < in->n_shell; ++k) {
        const double inner = pow(before, in->d);
        const double part = (pow(r, in->d) - inner) / (pow(in->radius[k], in->d) - inner);
        sum += fmin(1.0, fmax(0.0, part)) * in->pairs[k];
        before = in->radius[k];
    }
    return r > before ? sum * pow(r / before, in->d) : sum;
}

/// Whether a part of the points would show the same widths, or else a pole can add but little. With
/// many points it may not add much in any case: to fewer the limit is none. Where poles are asked
/// about, what they add to the value is one more error of the interval's upper end.
static bool is_steady(const clx_pair_shells *in, const answer *smooth, const answer *kinked,
                      clx_mixture_fit *f, clast_estimate *e)
{
    const int32_t least = smooth->moved < kinked->moved ? smooth->moved : kinked->moved;
    const int32_t most = smooth->moved > kinked->moved ? smooth->moved : kinked->moved;
    const bool is_near = least <= STAYS && most <= MOST_MOVED;
    const double limit = is_near ? most_unseen * 2.0 / sqrt(in->n) : most_hidden;
    if (limit > most_doubt) {
        return true;
    }
    clx_mixture_prepare(in, CLX_FAMILY_POLED, 1.0, f);
    const answer poled = ask(f);
    const double added = fmax(0.0, log(poled.value / e->value));
    e->high = e->value * exp(hypot(log(e->high / e->value), added));
    return log(poled.most / e->value) <= limit && added <= most_poled;
}

/// The families' mean by their likelihoods, and the hull of their intervals.
static clast_estimate average(const answer *smooth, const answer *kinked)
{
    const double factor = fmax(smooth->factor, kinked->factor);
    const double share = 1.0 / (1.0 + exp((smooth->likelihood - kinked->likelihood) / factor));
    return (clast_estimate){exp((1.0 - share) * log(smooth->value) + share * log(kinked->value)),
                            fmin(smooth->low, kinked->low), fmax(smooth->high, kinked->high),
                            false};
}

/// Layers as one family more, in the interval alone: theirs falls linearly to where it bends, as
/// that of an even layer does, and exp(-r / L) beside Gaussians does not.
static void add_layers(const clx_pair_shells *in, clx_mixture_fit *f, clast_estimate *e)
{
    clx_mixture_prepare(in, CLX_FAMILY_LAYERED, 1.0, f);
    const answer layered = ask(f);
    e->low = fmin(e->low, layered.low);
    e->high = fmax(e->high, layered.high);
}

/// Shells of the next smaller window; 0 where too few shells or pairs would be left.
static int32_t next_window(const clx_pair_shells *all, int32_t n_shell)
{
    const int32_t n = n_shell - SHELLS_A_CUT;
    const bool is_enough =
        n >= LEAST_SHELLS && pairs_within(all, all->radius[n - 1]) >= least_window;
    return is_enough ? n : 0;
}

/// The first n_shell shells of all; their covariance is left in [n_shell][n_shell].
static void take_window(const clx_pair_shells *all, int32_t n_shell, double *covariance,
                        clx_pair_shells *window)
{
    CLAST_ASSERT(n_shell > 0 && n_shell <= all->n_shell);
    *window = *all;
    window->n_shell = n_shell;
    window->covariance = covariance;
    for (int32_t k = 0; k < n_shell; ++k) {
        for (int32_t l = 0; l < n_shell; ++l) {
            covariance[k * n_shell + l] = all->covariance[k * all->n_shell + l];
        }
    }
}

/// Greatest lower bound (97.5 %) by all pairs within a radius, whatever f is: their mean falls
/// short of the integral by what f varies within that radius. 0 where pairs are few.
static double bound_of_shells(const clx_pair_shells *in)
{
    const double unit[3] = {2.0, CLAST_PI, 4.0 / 3.0 * CLAST_PI};
    double most = 0.0;
    double within = 0.0;
    double own = 0.0;
    double variance = 0.0;
    for (int32_t k = 0; k < in->n_shell; ++k) {
        const double ball =
            0.5 * in->n * (in->n - 1.0) * unit[in->d - 1] * pow(in->radius[k], in->d);
        within += in->pairs[k];
        own += in->spread[k];
        variance += in->covariance[k * in->n_shell + k];
        for (int32_t l = 0; l < k; ++l) {
            variance += 2.0 * in->covariance[k * in->n_shell + l];
        }
        if (within >= least_pairs) {
            const double error = sqrt(fmax(own, variance)) / within;
            most = fmax(most, within / ball * exp(-CLX_NORMAL_975 * error));
        }
    }
    return most;
}

/// What the two families say of a window.
typedef struct {
    clx_pair_shells window;
    bool is_cut; ///< some shells are left out
    bool fits;   ///< a shape goes with its pairs
    int32_t n_level;
    answer smooth, kinked;
} answers;

static void ask_both(clx_mixture_fit *f, answers *a)
{
    clx_mixture_prepare(&a->window, CLX_FAMILY_SMOOTH, 1.0, f);
    a->n_level = f->n_level;
    a->smooth = ask(f);
    clx_mixture_prepare(&a->window, CLX_FAMILY_KINKED, 1.0, f);
    a->kinked = ask(f);
    a->fits = !a->smooth.fit.misses || !a->kinked.fit.misses;
}

/// Better p of the two families.
static double fit_p(const answers *a)
{
    return fmax(a->smooth.fit.p, a->kinked.fit.p);
}

/// All shells where a shape goes with their pairs. A compact cloud at an edge or a corner of its
/// domain has, with its mirror images, an A(r) that bends down towards the cloud's size and ends
/// there, as no mixture does: fitted over all of it shapes are up to 50 % too high at r = 0. Else
/// the widest inner window that a shape goes with as if pairs were Poisson numbers, for a fit that
/// the overdispersion alone excuses is still bent; failing that the widest with which it goes at
/// all, and else all shells, for which `fits` is false. Points that keep apart are no sample of a
/// density at any distance.
static void find_window(const clx_pair_shells *all, clx_mixture_fit *f, double *covariance,
                        answers *a)
{
    *a = (answers){.window = *all};
    ask_both(f, a);
    if (a->fits || clx_resolution_of(all->levels).is_apart) {
        return;
    }
    answers next = {.is_cut = true};
    for (int32_t n = all->n_shell; (n = next_window(all, n)) > 0;) {
        take_window(all, n, covariance, &next.window);
        ask_both(f, &next);
        if (next.fits && !a->fits) {
            *a = next;
        }
        if (next.fits && fit_p(&next) >= enough_p) {
            *a = next;
            break;
        }
    }
    if (a->is_cut) { // narrower ones were put in the place of its covariance
        take_window(all, a->window.n_shell, covariance, &a->window);
    }
}

/// Next to no pairs.
static clast_pair_integral without_pairs(const clx_pair_shells *in)
{
    clast_pair_integral made = {
        .estimate = {NAN, 0.0, INFINITY, false}, .scale = INFINITY, .fit_p = 1.0};
    set_window(in, &made);
    made.n_needed = in->n * sqrt(10.0 * CLX_MIXTURE_PAIRS / fmax(1.0, (double)made.n_pair));
    return made;
}

/// The length of which pairs within most_size of it show whether anything narrower is there: the
/// domain's, or of a cut window that of the cloud whose default window it would be.
static double size_of(const answers *a)
{
    const clx_pair_shells *in = &a->window;
    const double size = pow(in->volume, 1.0 / (double)in->d);
    return a->is_cut ? fmin(size, in->radius[in->n_shell - 1] / window_size) : size;
}

/// Estimate, interval and whether it is resolved; what would do where it is not.
static void judge(const clx_pair_shells *all, const answers *a, clx_mixture_fit *f,
                  clast_pair_integral *made)
{
    const clx_pair_shells *in = &a->window;
    const answer *smooth = &a->smooth;
    const answer *kinked = &a->kinked;
    clast_estimate *e = &made->estimate;
    *e = average(smooth, kinked);
    const bool is_seen = smooth->level + 1 < a->n_level && kinked->level + 1 < a->n_level;
    const double doubt =
        0.5 * log(fmax(smooth->most, kinked->most) / fmin(smooth->least, kinked->least));
    const double size = most_size * size_of(a);
    const double least = smooth->s < size ? least_pairs : least_even;
    const double close = pairs_within(all, fmin(smooth->s, size));
    const bool is_allowed = clx_resolution_allows(in->levels, in->n * (in->n - 1.0) * e->value);
    const double least_points = in->d > 2 ? least_spatial : 0.0;
    const bool is_met = a->fits && is_seen && is_allowed && doubt <= most_doubt && close >= least;
    const bool is_chance = is_met && (fabs(log(kinked->value / smooth->value)) > most_between ||
                                      !is_steady(in, smooth, kinked, f, e));
    e->resolved = is_met && !is_chance && in->n >= least_points;
    made->n_needed = in->n;
    if (e->resolved) {
        add_layers(in, f, e);
        e->low = e->value * exp(-hypot(log(e->value / e->low), form_error));
        e->high = e->value * exp(hypot(log(e->high / e->value), form_error));
        return;
    }
    // the doubt falls as the root of the pairs
    const double more = fmax(doubt / most_doubt, sqrt(least / fmax(1.0, close)));
    const double steady = is_chance ? 1.0 / fewer : 1.1; // these are then the fewer points
    const double factor = fmax(steady, more);
    made->n_needed = a->fits && is_seen && is_allowed && factor <= CLX_MOST_FACTOR
                         ? fmax(least_points, in->n * factor)
                         : (double)INFINITY;
    // a few chance pairs may pass for a narrow structure: what all pairs within a radius show,
    // whatever the shape, is the bound, where they are enough to show anything
    const double least_shown = bound_of_shells(all);
    e->low = a->fits && least_shown == 0.0 ? e->low : fmin(e->low, least_shown);
    e->high = INFINITY;
}

clast_status clx_pair_integral(const clx_pair_shells *in, clast_pair_integral *result)
{
    clast_status status = CLAST_OK;
    clast_pair_integral made = {0};
    clx_mixture_fit *f = NULL;
    double *covariance = NULL;
    answers a;
    CLX_TRY(clx_alloc(&f, 1, sizeof *f));
    CLX_TRY(clx_alloc(&covariance, (int64_t)in->n_shell * in->n_shell, sizeof *covariance));
    clx_mixture_prepare(in, CLX_FAMILY_SMOOTH, 1.0, f);
    if (f->n_level == 0) {
        *result = without_pairs(in);
        goto done;
    }
    find_window(in, f, covariance, &a);
    judge(in, &a, f, &made);
    // of a cloud that ends within the window the cloud is the widest structure there is
    const double widest = a.is_cut ? a.window.radius[a.window.n_shell - 1] : (double)INFINITY;
    made.scale = fmin(a.smooth.s, widest);
    made.fit_p = fit_p(&a);
    set_window(&a.window, &made);
    if (in->levels->n_repeated > most_repeated * (double)made.n_pair) {
        made.estimate.low = (double)NAN; // there is no density at the places of repeated points
        made.estimate.high = INFINITY;
        made.estimate.resolved = false;
        made.n_needed = INFINITY;
    }
    *result = made;
done:
    CLX_FREE(covariance, f);
    return status;
}
