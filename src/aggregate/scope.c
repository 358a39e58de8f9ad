// What the numbers of a run are of, where that is not all of its grains in their true surfaces.
#include <clast/aggregate_run.h>

#include "base/number.h"
#include <math.h>
#include <stdio.h>

/// Overlaps of less than this share of the solid are none.
static const double OVERLAP_SEEN = 1e-6;

/// "largest of 10 clusters, 24 of 40 grains", of several repeats "largest of 3 to 10 clusters of
/// each repeat"; "" where there is one.
static void tell_clusters(const clast_aggregate_report *report, char text[192])
{
    static const char all[] = "(surfaces and pictures show all, side by side)";
    const clast_aggregate_result *first = &report->result[0];
    int32_t least = first->n_cluster;
    int32_t most = first->n_cluster;
    for (int32_t i = 1; i < report->n; ++i) {
        const int32_t n = report->result[i].n_cluster;
        least = n < least ? n : least;
        most = n > most ? n : most;
    }
    text[0] = '\0';
    if (most > 1 && report->n == 1) {
        (void)snprintf(text, 192, "largest of %d clusters, %d of %d grains %s", most,
                       first->n_grain, first->n_grain_all, all);
    } else if (most > 1 && least == most) {
        (void)snprintf(text, 192, "largest of %d clusters of each repeat %s", most, all);
    } else if (most > 1) {
        (void)snprintf(text, 192, "largest of %d to %d clusters of each repeat %s", least, most,
                       all);
    }
}

/// The greatest share of the grains' volumes that lies in several of them; NAN where no repeat has
/// its union measured.
static double overlap_share(const clast_aggregate_report *report)
{
    double share = (double)NAN;
    for (int32_t i = 0; i < report->n; ++i) {
        const clast_aggregate_result *r = &report->result[i];
        share = fmax(share, 1.0 - r->solid_union / r->solid_sum);
    }
    return share;
}

/// Which solid porosity is by, and which bodies the overlap is of; "" where all are the same.
static void tell_solid(const clast_aggregate_report *report, char text[192])
{
    static const char *const bodies[] = {
        [CLAST_CONTACT_EXACT] = "true surfaces", [CLAST_CONTACT_SPHERES] = "sphere composites"};
    const double share = overlap_share(report);
    const int32_t contact = report->result[0].contact;
    const bool is_exact = contact == CLAST_CONTACT_EXACT;
    char of[64] = "is not looked for in the march";
    text[0] = '\0';
    if (share < OVERLAP_SEEN || (isnan(share) && is_exact)) {
        return;
    }
    if (contact == CLAST_CONTACT_EXACT || contact == CLAST_CONTACT_SPHERES) {
        (void)snprintf(of, sizeof of, "that of the %s", bodies[contact]);
    }
    char by[48] = "may overlap";
    if (!isnan(share)) {
        (void)clx_number_print(by, sizeof by, "overlap by %.2g %%", 100.0 * share);
    }
    (void)snprintf(text, 192,
                   "porosity by the sum of the grains' volumes, which %s; max_overlap %s", by, of);
}

/// The first envelope that holds less than the grains' volumes; "" where none does.
static void tell_envelope(const clast_aggregate_report *report, char text[192])
{
    text[0] = '\0';
    for (int32_t i = 0; i < report->n; ++i) {
        const clast_aggregate_result *r = &report->result[i];
        for (int32_t k = 0; k < r->n_envelope && k < CLAST_N_ENVELOPE; ++k) {
            if (r->porosity[k] < -1e-9) {
                (void)snprintf(text, 192,
                               "porosity below 0: %s is smaller than the solid and no envelope of "
                               "it; d_agg, density and settling velocity are by the first envelope",
                               clast_envelope_name(r->envelope[k].kind));
                return;
            }
        }
    }
}

const char *clast_aggregate_report_scope(const clast_aggregate_report *report, size_t size,
                                         char *text)
{
    if (size == 0 || text == NULL) {
        return "";
    }
    char clusters[192] = "";
    char solid[192] = "";
    char envelope[192] = "";
    text[0] = '\0';
    if (report == NULL || report->n < 1 || report->result == NULL) {
        return text;
    }
    tell_clusters(report, clusters);
    tell_solid(report, solid);
    tell_envelope(report, envelope);
    const bool solid_follows = clusters[0] != '\0' && solid[0] != '\0';
    const bool envelope_follows = (clusters[0] != '\0' || solid[0] != '\0') && envelope[0] != '\0';
    (void)snprintf(text, size, "%s%s%s%s%s", clusters, solid_follows ? "; " : "", solid,
                   envelope_follows ? "; " : "", envelope);
    return text;
}
