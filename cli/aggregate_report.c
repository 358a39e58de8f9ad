// Plain text of an aggregation's results.
#include "aggregate_report.h"

#include <clast/field.h>
#include <clast/settling.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef double (*reader)(const clast_aggregate_result *result, int32_t index);

static double read_n_grain(const clast_aggregate_result *r, int32_t k)
{
    (void)k;
    return r->n_grain;
}

static double read_d_agg(const clast_aggregate_result *r, int32_t k)
{
    (void)k;
    return r->d_agg;
}

static double read_density(const clast_aggregate_result *r, int32_t k)
{
    (void)k;
    return r->density;
}

static double read_gyration(const clast_aggregate_result *r, int32_t k)
{
    (void)k;
    return r->radius_of_gyration;
}

static double read_settling(const clast_aggregate_result *r, int32_t k)
{
    (void)k;
    return r->settling_velocity;
}

static double read_permeable(const clast_aggregate_result *r, int32_t k)
{
    (void)k;
    return r->settling_velocity_permeable;
}

static double read_porosity(const clast_aggregate_result *r, int32_t k)
{
    return r->porosity[k];
}

/// With the union of the grains for their sum; NAN where that is not measured.
static double read_porosity_union(const clast_aggregate_result *r, int32_t k)
{
    return 1.0 - r->solid_union / r->envelope[k].volume;
}

typedef struct {
    const char *name, *unit;
    reader read;
    int32_t index;
} line;

/// The greatest Reynolds number of settling, where the drag law does not hold.
static void print_reynolds(const clast_aggregate_report *report)
{
    static const double limit = 3e5; // clast_drag_coefficient
    const clast_fluid air = clast_fluid_air();
    double most = 0.0;
    for (int32_t i = 0; i < report->n; ++i) {
        const clast_aggregate_result *r = &report->result[i];
        most = fmax(most, r->settling_velocity * r->d_agg * air.density / air.viscosity);
    }
    if (most >= limit) {
        (void)printf(" (Re %.2g, beyond the drag law's %.0e)", most, limit);
    }
}

static void print_line(const clast_aggregate_report *report, const line *l)
{
    double *value = report->n > 0 ? calloc((size_t)report->n, sizeof *value) : NULL;
    if (value == NULL) {
        return;
    }
    for (int32_t i = 0; i < report->n; ++i) {
        value[i] = l->read(&report->result[i], l->index);
    }
    const clast_interval i = clast_interval_of(report->n, value, report->confidence);
    double factor = 1.0;
    const char *unit = clast_unit_for(i.mean, l->unit, &factor);
    (void)printf("%-28s %12.6g %-7s", l->name, factor * i.mean, unit);
    if (report->n > 1) {
        (void)printf(" sd %.3g, mean within %.6g .. %.6g", factor * i.deviation, factor * i.low,
                     factor * i.high);
    }
    if (l->read == read_settling) {
        print_reynolds(report);
    }
    (void)putchar('\n');
    free(value);
}

/// The permeable velocity, or why it has none: of the first aggregate that has none.
static void print_permeable(const clast_aggregate_report *report)
{
    static const line l = {"settling, permeable coat", "m/s", read_permeable, 0};
    for (int32_t i = 0; i < report->n; ++i) {
        if (report->result[i].permeable != CLAST_PERMEABLE_YES) {
            (void)printf("%-28s %12s (%s)\n", l.name, "-",
                         clast_permeable_range_text(report->result[i].permeable));
            return;
        }
    }
    print_line(report, &l);
}

/// Porosity by each envelope; of the union too, where grains overlap.
static void print_porosity(const clast_aggregate_report *report)
{
    char name[64];
    bool overlap = false;
    for (int32_t i = 0; i < report->n; ++i) {
        const clast_aggregate_result *r = &report->result[i];
        overlap = overlap || r->solid_union < (1.0 - 1e-6) * r->solid_sum;
    }
    for (int32_t k = 0; k < report->result[0].n_envelope; ++k) {
        const char *envelope = clast_envelope_name(report->result[0].envelope[k].kind);
        (void)snprintf(name, sizeof name, "porosity, %s", envelope);
        print_line(report, &(line){name, "", read_porosity, k});
        (void)snprintf(name, sizeof name, "porosity_union, %s", envelope);
        if (overlap) {
            print_line(report, &(line){name, "", read_porosity_union, k});
        }
    }
}

void aggregate_report_print(const clast_aggregate_report *report)
{
    const line lines[] = {{"grains", "", read_n_grain, 0},
                          {"d_agg", "m", read_d_agg, 0},
                          {"density", "kg/m^3", read_density, 0},
                          {"radius of gyration", "m", read_gyration, 0},
                          {"settling velocity in air", "m/s", read_settling, 0}};
    char scope[512];
    if (report->n > 1) {
        (void)printf("%d aggregates, intervals of the mean at level %g\n", report->n,
                     report->confidence);
    }
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; ++i) {
        print_line(report, &lines[i]);
    }
    print_permeable(report);
    print_porosity(report);
    if (clast_aggregate_report_scope(report, sizeof scope, scope)[0] != '\0') {
        (void)printf("%s\n", scope);
    }
}
