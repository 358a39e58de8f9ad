// What a fit's best choice means: inside the observation's interval, at the edge of what was tried
// (a border of the grid in packings and N_A), or no; and the outcome in words.
#include "aggregate/fit.h"
#include "base/number.h"

#include <clast/field.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char *clast_aggregate_fit_observable_name(int32_t observable)
{
    static const char *const name[] = {"size", "density", "settling_velocity"};
    return observable >= 0 && observable < CLAST_FIT_N_OBSERVABLE ? name[observable] : "unknown";
}

const char *clast_aggregate_fit_observable_unit(int32_t observable)
{
    static const char *const unit[] = {"m", "kg/m^3", "m/s"};
    return observable >= 0 && observable < CLAST_FIT_N_OBSERVABLE ? unit[observable] : "-";
}

const char *clast_fit_verdict_name(clast_fit_verdict verdict)
{
    static const char *const name[] = {"inside", "edge", "no"};
    return (unsigned)verdict < sizeof name / sizeof name[0] ? name[verdict] : "unknown";
}

/// Probability of a chi2 this great or greater with n = 1, 2 or 3 degrees of freedom.
static double p_value_of(double chi2, int32_t n)
{
    const double half = 0.5 * chi2;
    if (n == 2) {
        return exp(-half);
    }
    const double tail = erfc(sqrt(half));
    return n == 1 ? tail : tail + 2.0 * sqrt(half / CLAST_PI) * exp(-half);
}

static void append(clast_aggregate_fit *r, const char *more)
{
    const size_t n = strlen(r->words);
    (void)snprintf(r->words + n, sizeof r->words - n, "%s", more);
}

static void say_pulls(clast_aggregate_fit *r)
{
    char part[160];
    for (int k = 0; k < CLAST_FIT_N_OBSERVABLE; ++k) {
        double factor = 1.0;
        const char *unit =
            clast_unit_for(r->observed[k], clast_aggregate_fit_observable_unit(k), &factor);
        if (isfinite(r->observed[k])) {
            (void)clx_number_print(
                part, sizeof part, "%s %.4g %s against %.4g +- %.2g %s (%+.1f errors); ",
                clast_aggregate_fit_observable_name(k), factor * r->model[k].best, unit,
                factor * r->observed[k], factor * r->error[k], unit, r->pull[k]);
            append(r, part);
        }
    }
}

/// On which border of the grid the best choice lies, and how to widen it there.
static void say_edge(clast_aggregate_fit *r)
{
    if (r->packing_edge < 0 && r->rays * r->orientations == 1) {
        append(r, "; this is the loosest packing tried, and no core has a looser one than a single "
                  "trial: mode cluster grows looser aggregates");
    } else if (r->packing_edge < 0) {
        append(r, "; this is the loosest packing tried: add looser ones to fit_packing (fewer rays "
                  "x orientations)");
    } else if (r->packing_edge > 0) {
        append(r, "; this is the tightest packing tried: add tighter ones to fit_packing (more "
                  "rays x orientations)");
    }
    if (r->replicate_edge < 0) {
        append(r, "; replicate is at its least, 1: for fewer grains shorten the list of sizes");
    } else if (r->replicate_edge > 0) {
        append(r, "; replicate is the greatest tried: raise fit_replicate_max");
    }
}

static void say_freedom(clast_aggregate_fit *r)
{
    char part[160];
    if (r->n_freedom > 0) {
        (void)clx_number_print(part, sizeof part,
                               "; p-value %.2g (chi2 %.3g, degrees of freedom: %d)", r->p_value,
                               r->chi2, r->n_freedom);
    } else {
        (void)snprintf(part, sizeof part,
                       "; data: %d, fitted choices: %d, so no degree of freedom is left for a "
                       "p-value",
                       r->n_observed, r->n_choice);
    }
    append(r, part);
}

/// Which side of a packing that was tried alone the observation lies on: denser and faster than
/// observed is too tight, and no looser one was tried. A size tells none: N_A answers for it.
static int32_t edge_of_one(const clast_aggregate_fit *r)
{
    for (int k = CLAST_FIT_DENSITY; k < CLAST_FIT_N_OBSERVABLE; ++k) {
        if (isfinite(r->observed[k]) && fabs(r->pull[k]) > 1.0) {
            return r->pull[k] > 0.0 ? -1 : 1;
        }
    }
    return 0;
}

static void say(clast_aggregate_fit *r)
{
    static const char *const opening[] = {
        "yes, inside the observed interval: ",
        "not explained, and the best choice lies at the edge of what was tried: ",
        "no, outside the observed interval and within what was tried: "};
    char part[200];
    append(r, opening[r->verdict]);
    say_pulls(r);
    (void)clx_number_print(
        part, sizeof part,
        "porosity %.3f with cone %.3g deg, rays %d, orientations %d, replicate %d",
        r->porosity.best, r->cone * 180.0 / CLAST_PI, r->rays, r->orientations, r->replicate);
    append(r, part);
    say_edge(r);
    say_freedom(r);
}

void clx_fit_judge(const clx_fit *fit, clast_aggregate_fit *result)
{
    clast_aggregate_fit *r = result;
    const int32_t limit = fit->config->fit_replicate_max;
    bool is_inside = true;
    r->n_choice = (fit->n_level > 1) + (limit > 1);
    r->n_freedom = r->n_observed > r->n_choice ? r->n_observed - r->n_choice : 0;
    r->p_value = r->n_freedom > 0 ? p_value_of(r->chi2, r->n_freedom) : (double)NAN;
    // tighter packings that were left out were out of the question
    r->packing_edge = fit->n_level == 1                 ? edge_of_one(r)
                      : r->at_level == 0                ? -1
                      : r->at_level == fit->n_level - 1 ? 1
                                                        : 0;
    if (limit > 1) {
        r->replicate_edge = r->replicate == 1 ? -1 : r->replicate == limit;
    }
    for (int k = 0; k < CLAST_FIT_N_OBSERVABLE; ++k) {
        is_inside = is_inside && !(isfinite(r->observed[k]) && fabs(r->pull[k]) > 1.0);
    }
    r->verdict = is_inside                                        ? CLAST_FIT_INSIDE
                 : r->packing_edge != 0 || r->replicate_edge != 0 ? CLAST_FIT_EDGE
                                                                  : CLAST_FIT_NO;
    say(r);
}
