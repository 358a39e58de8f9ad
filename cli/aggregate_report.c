// JSON and plain text of an aggregation's results.
#include "aggregate_report.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>

clast_status aggregate_report_add(aggregate_report *report, const clast_aggregate *aggregate)
{
    clast_aggregate_result *grown =
        realloc(report->result, (size_t)(report->n + 1) * sizeof *report->result);
    if (grown == NULL) {
        return CLAST_E_MEMORY;
    }
    report->result = grown;
    const clast_status status = clast_aggregate_measure(aggregate, &grown[report->n]);
    report->n += status == CLAST_OK ? 1 : 0;
    return status;
}

void aggregate_report_free(aggregate_report *report)
{
    free(report->result);
    *report = (aggregate_report){0};
}

typedef double (*reader)(const clast_aggregate_result *result, int32_t index);

static double read_n_grain(const clast_aggregate_result *r, int32_t k)
{
    (void)k;
    return r->n_grain;
}

static double read_mass(const clast_aggregate_result *r, int32_t k)
{
    (void)k;
    return r->mass;
}

static double read_solid(const clast_aggregate_result *r, int32_t k)
{
    (void)k;
    return r->solid_sum;
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

static double read_porosity(const clast_aggregate_result *r, int32_t k)
{
    return r->porosity[k];
}

static double read_envelope(const clast_aggregate_result *r, int32_t k)
{
    return r->envelope[k].volume;
}

static clast_interval interval(const aggregate_report *report, reader read, int32_t k)
{
    clast_interval made = {0};
    double *value = calloc((size_t)report->n, sizeof *value);
    for (int32_t i = 0; i < report->n && value != NULL; ++i) {
        value[i] = read(&report->result[i], k);
    }
    if (value != NULL) {
        made = clast_interval_of(report->n, value, report->config->confidence);
    }
    free(value);
    return made;
}

static json_t *interval_json(const aggregate_report *report, reader read, int32_t k)
{
    const clast_interval i = interval(report, read, k);
    return report->n > 1 ? json_pack("{s:f,s:f,s:f,s:f}", "mean", i.mean, "deviation", i.deviation,
                                     "low", i.low, "high", i.high)
                         : json_pack("{s:f}", "mean", i.mean);
}

static const char *envelope_name(const aggregate_report *report, int32_t k)
{
    return clast_envelope_name(report->result[0].envelope[k].kind);
}

static json_t *by_envelope(const aggregate_report *report, reader read)
{
    json_t *object = json_object();
    for (int32_t k = 0; k < report->result[0].n_envelope; ++k) {
        (void)json_object_set_new(object, envelope_name(report, k),
                                  json_real(interval(report, read, k).mean));
    }
    return object;
}

static json_t *intervals(const aggregate_report *report)
{
    json_t *porosity = json_object();
    for (int32_t k = 0; k < report->result[0].n_envelope; ++k) {
        (void)json_object_set_new(porosity, envelope_name(report, k),
                                  interval_json(report, read_porosity, k));
    }
    return json_pack("{s:f,s:o,s:o,s:o,s:o}", "confidence", report->config->confidence, "porosity",
                     porosity, "d_agg", interval_json(report, read_d_agg, 0), "density",
                     interval_json(report, read_density, 0), "radius_of_gyration",
                     interval_json(report, read_gyration, 0));
}

static const char *stop_name(clast_aggregate_stop stop)
{
    static const char *const names[] = {"not", "list", "mass", "size", "porosity"};
    return names[stop];
}

static json_t *one_repeat(const clast_aggregate_result *r)
{
    json_t *envelope = json_object();
    json_t *error = json_object();
    json_t *porosity = json_object();
    for (int32_t k = 0; k < r->n_envelope; ++k) {
        const char *name = clast_envelope_name(r->envelope[k].kind);
        (void)json_object_set_new(envelope, name, json_real(r->envelope[k].volume));
        (void)json_object_set_new(error, name, json_real(r->envelope[k].error));
        (void)json_object_set_new(porosity, name, json_real(r->porosity[k]));
    }
    return json_pack("{s:i,s:i,s:i,s:i,s:f,s:f,s:o,s:o,s:o,s:f,s:f,s:f,s:f,s:f,s:i,s:s}", "n_grain",
                     r->n_grain, "n_particle", r->n_particle, "n_contact", r->n_contact,
                     "n_cluster", r->n_cluster, "mass", r->mass, "solid_sum", r->solid_sum,
                     "envelope", envelope, "envelope_error", error, "porosity", porosity, "d_agg",
                     r->d_agg, "density", r->density, "radius_of_gyration", r->radius_of_gyration,
                     "max_overlap", r->max_overlap, "max_overlap_relative", r->max_overlap_relative,
                     "n_lost", r->n_lost, "stopped_by", stop_name(r->stop));
}

/// Sums of the three clocks and the worst overlap over the repeats.
static void add_totals(const aggregate_report *report, json_t *object)
{
    clast_aggregate_result sum = {0};
    for (int32_t i = 0; i < report->n; ++i) {
        const clast_aggregate_result *r = &report->result[i];
        sum.max_overlap = r->max_overlap > sum.max_overlap ? r->max_overlap : sum.max_overlap;
        sum.n_lost += r->n_lost;
        sum.wall_s += r->wall_s;
        sum.contact_s += r->contact_s;
        sum.envelope_s += r->envelope_s;
    }
    (void)json_object_set_new(object, "max_overlap", json_real(sum.max_overlap));
    (void)json_object_set_new(object, "n_lost", json_integer(sum.n_lost));
    (void)json_object_set_new(object, "wall_s", json_real(sum.wall_s));
    (void)json_object_set_new(object, "contact_s", json_real(sum.contact_s));
    (void)json_object_set_new(object, "envelope_s", json_real(sum.envelope_s));
}

static json_t *report_json(const aggregate_report *report)
{
    json_t *object = json_pack(
        "{s:f,s:f,s:f,s:o,s:o,s:f,s:f,s:f}", "n_grain", interval(report, read_n_grain, 0).mean,
        "mass", interval(report, read_mass, 0).mean, "solid_sum",
        interval(report, read_solid, 0).mean, "envelope", by_envelope(report, read_envelope),
        "porosity", by_envelope(report, read_porosity), "d_agg",
        interval(report, read_d_agg, 0).mean, "density", interval(report, read_density, 0).mean,
        "radius_of_gyration", interval(report, read_gyration, 0).mean);
    json_t *repeats = json_array();
    add_totals(report, object);
    for (int32_t i = 0; i < report->n; ++i) {
        (void)json_array_append_new(repeats, one_repeat(&report->result[i]));
    }
    (void)json_object_set_new(object, "repeats", repeats);
    if (report->n > 1) {
        (void)json_object_set_new(object, "interval", intervals(report));
    }
    return object;
}

static void print_value(const aggregate_report *report, const char *name, const char *unit,
                        double scale, reader read, int32_t k)
{
    const clast_interval i = interval(report, read, k);
    (void)printf("%-28s %12.6g %-8s", name, scale * i.mean, unit);
    if (report->n > 1) {
        (void)printf("  sd %.3g, mean within %.6g .. %.6g", scale * i.deviation, scale * i.low,
                     scale * i.high);
    }
    (void)putchar('\n');
}

static void print_text(const aggregate_report *report)
{
    char name[64];
    if (report->n > 1) {
        (void)printf("%d aggregates, intervals of the mean at level %g\n", report->n,
                     report->config->confidence);
    }
    print_value(report, "grains", "", 1.0, read_n_grain, 0);
    print_value(report, "d_agg", "um", 1e6, read_d_agg, 0);
    print_value(report, "density", "kg/m^3", 1.0, read_density, 0);
    print_value(report, "radius of gyration", "um", 1e6, read_gyration, 0);
    for (int32_t k = 0; k < report->result[0].n_envelope; ++k) {
        (void)snprintf(name, sizeof name, "porosity, %s", envelope_name(report, k));
        print_value(report, name, "", 1.0, read_porosity, k);
    }
}

clast_status aggregate_report_print(const aggregate_report *report, const cli_common *common)
{
    if (common->json) {
        json_t *object = report_json(report);
        (void)json_dumpf(object, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
        (void)putchar('\n');
        json_decref(object);
    } else {
        print_text(report);
    }
    return CLAST_OK;
}
