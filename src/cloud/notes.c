// What a person should hear of clouds and what was made of them: thresholds and words, for the
// command and for bindings.
#include <clast/agglomerate.h>
#include <clast/decompose.h>

#include "base/comm.h"
#include "base/number.h"
#include "cloud/columns.h"
#include "cloud/contract.h"
#include "cloud/repeated.h"
#include <math.h>
#include <stdio.h>

static const double SMALLEST_SHARE = 1e-3; ///< of a domain's width that a cloud should fill
static const double DENSE = 0.1;           ///< volume fraction beyond which nothing is dilute
static const double OFF = 0.01;            ///< a drawn start against its law, relative
static const double LEAST_P = 1e-3;        ///< of a fit to g(r)
static const double FEW_A_BIN = 10.0;

/// A length in the unit in which people write it: "3.75 um".
static const char *length_text(double metres, char text[32])
{
    double factor = 1.0;
    const char *const unit = clast_unit_for(metres, "m", &factor);
    const double size = metres * factor;
    (void)clx_number_print(text, 32, size >= 1e4 && size < 1e6 ? "%.0f %s" : "%.4g %s", size, unit);
    return text;
}

const char *clast_cloud_corner_words(const clast_cloud *cloud, const clast_comm *comm,
                                     const clast_domain *domain, size_t size, char *text)
{
    const clast_comm *all = clx_comm_or_one(comm);
    char within[32];
    char wide[32];
    double widest = 0.0;
    if (text == NULL || size == 0) {
        return "";
    }
    text[0] = '\0';
    if (!clx_comm_has_sums(all) || clx_domain_check(domain) != CLAST_OK ||
        clx_cloud_check(cloud) != CLAST_OK) {
        return text;
    }
    const double width = pow(clast_domain_volume(domain), 1.0 / cloud->dimension);
    for (int32_t axis = 0; axis < cloud->dimension; ++axis) {
        double low = (double)INFINITY;
        double high = (double)INFINITY; // with its sign turned
        for (int64_t i = 0; i < cloud->n; ++i) {
            const double x = cloud->x[i * cloud->dimension + axis];
            low = fmin(low, x);
            high = fmin(high, -x);
        }
        low = clx_comm_least(all, low);
        high = clx_comm_least(all, high);
        widest = fmax(widest, -high - low);
    }
    if (widest > 0.0 && widest < SMALLEST_SHARE * width) {
        (void)snprintf(
            text, size,
            "all points lie within %s, the domain is %s wide; are both in the same unit?",
            length_text(widest, within), length_text(width, wide));
    }
    return text;
}

const char *clx_cloud_weight_words(const clast_cloud *cloud, const char *name, const char *instead,
                                   size_t size, char *text)
{
    text[0] = '\0';
    if (cloud->unread_weight[0] != '\0') {
        (void)snprintf(text, size,
                       "%s: column '%s' is not looked at: each row is one particle (%s)", name,
                       cloud->unread_weight, instead);
    }
    return text;
}

const char *clast_cloud_weight_words(const clast_cloud *cloud, const char *name, size_t size,
                                     char *text)
{
    char instead[32 + sizeof cloud->unread_weight];
    if (cloud == NULL || name == NULL || text == NULL || size == 0) {
        return "";
    }
    (void)snprintf(instead, sizeof instead, "--weight-column %s", cloud->unread_weight);
    return clx_cloud_weight_words(cloud, name, instead, size, text);
}

const char *clast_kernel_dense_words(double volume_fraction, size_t size, char *text)
{
    if (text == NULL || size == 0) {
        return "";
    }
    text[0] = '\0';
    if (volume_fraction > DENSE) {
        (void)clx_number_print(text, size,
                               "the particles fill %.3g %% of the volume; kernels are of dilute "
                               "suspensions: look at the units",
                               100.0 * volume_fraction);
    }
    return text;
}

static double percent_of(const clast_range_use *use)
{
    return use->n > 0.0 ? 100.0 * use->outside / use->n : 0.0;
}

static void range_note(const clast_range_report *r, size_t size, char *text)
{
    char words[512];
    char when[64] = "";
    const clast_range_use *const use = clast_range_report_use(r);
    if (!(use->outside > 0.0)) {
        return;
    }
    if (isfinite(r->time)) {
        (void)clx_number_print(when, sizeof when, ", over 0.1 %% of them from t = %.4g s on",
                               r->time);
    }
    (void)clx_number_print(text, size,
                           "%s; beyond lie %.3g %% of the particles at the start and %.3g %% of "
                           "the collisions%s",
                           clast_range_use_words(use, sizeof words, words), percent_of(&r->start),
                           percent_of(&r->collisions), when);
}

/// A tail of few large particles is in few samples.
static void start_note(const clast_spectrum *r, size_t size, char *text)
{
    const double *const m1 = clast_table_numbers(&r->history, "M1");
    const double *const m2 = clast_table_numbers(&r->history, "M2");
    if (!r->is_drawn || m1 == NULL || m2 == NULL || r->history.n_row == 0) {
        return;
    }
    const double mass = m1[0] / r->law_M1;
    const double second = m2[0] / r->law_M2;
    if (fmax(fabs(mass - 1.0), fabs(second - 1.0)) > OFF) {
        (void)clx_number_print(text, size,
                               "the particles drawn hold %.4g %% of the mass and %.3g %% of M2 of "
                               "their law at the start: its tail is in few of so many; take more "
                               "--particles or --solver sectional",
                               100.0 * mass, 100.0 * second);
    }
}

/// Notes 0 and 1 of boxes and clouds alike.
static void kernel_note(const clast_range_report *range, double volume_fraction, int32_t k,
                        size_t size, char *text)
{
    text[0] = '\0';
    if (k == 0) {
        range_note(range, size, text);
    } else if (k == 1) {
        (void)clast_kernel_dense_words(volume_fraction, size, text);
    }
}

const char *clast_spectrum_note(const clast_spectrum *result, int32_t k, size_t size, char *text)
{
    if (result == NULL || text == NULL || size == 0) {
        return "";
    }
    kernel_note(&result->range, result->volume_fraction, k, size, text);
    if (k == 2) {
        start_note(result, size, text);
    }
    return text;
}

/// Copies collide: then there are too many collisions, else rather too few.
static void unresolved_note(const clast_agglomeration *r, size_t size, char *text)
{
    if (r->n_unresolved > 0) {
        (void)snprintf(text, size,
                       "in %d of %d snapshot%s the particles did not show their own structure "
                       "(clast decompose reports more): collisions there are a best guess%s",
                       r->n_unresolved, r->n_snapshot, r->n_snapshot == 1 ? "" : "s",
                       r->n_repeated > 0 ? "" : ", rather too few than too many");
    }
}

static void repeated_note(const clast_agglomeration *r, size_t size, char *text)
{
    const bool is_one = r->n_repeated == 1;
    if (r->n_repeated > 0) {
        (void)snprintf(text, size,
                       "%lld particle%s%s %s (coincident points); each such pair counts as two "
                       "particles that meet",
                       (long long)r->n_repeated, is_one ? "" : "s",
                       r->n_snapshot > 1 ? " of a snapshot" : "",
                       is_one ? "is a duplicate" : "are duplicates");
    }
}

const char *clast_agglomeration_note(const clast_agglomeration *result, int32_t k, size_t size,
                                     char *text)
{
    if (result == NULL || text == NULL || size == 0) {
        return "";
    }
    kernel_note(&result->range, result->volume_fraction, k, size, text);
    if (k == 2) {
        unresolved_note(result, size, text);
    } else if (k == 3) {
        repeated_note(result, size, text);
    }
    return text;
}

static void pairs_note(const clast_decomposition *r, size_t size, char *text)
{
    const double p = r->pairs.integral.fit_p;
    if (r->pairs.n > 0 && r->disagree) {
        (void)snprintf(text, size,
                       "events by pairs and by cells have no number in common; the cells hide "
                       "structure, or points keep apart: look at g(r)");
    } else if (r->pairs.n > 0 && p < LEAST_P) {
        char value[32] = "< 1e-300";
        if (p > 0.0) {
            (void)clx_number_print(value, sizeof value, "= %.4g", p);
        }
        (void)snprintf(text, size,
                       "g(r) is not that of points drawn from a density (p %s): it does not fall "
                       "smoothly from r = 0",
                       value);
    }
}

const char *clast_decomposition_note(const clast_decomposition *result, int64_t n_repeated,
                                     int32_t k, size_t size, char *text)
{
    if (result == NULL || text == NULL || size == 0) {
        return "";
    }
    text[0] = '\0';
    if (k == 0) {
        pairs_note(result, size, text);
    } else if (k == 1 && isnan(result->events_low)) {
        (void)snprintf(text, size, "no %s: %s",
                       result->beta_dt > 0.0 ? "number of events" : "pair integral",
                       clx_repeated_text(n_repeated));
    } else if (k == 2 && result->n_pass > 0 && result->points_per_bin < FEW_A_BIN) {
        (void)clx_number_print(text, size,
                               "%.2g points a bin (under 10): joining bins by their counts keeps "
                               "their noise; compare --mesh tree",
                               result->points_per_bin);
    }
    return text;
}
