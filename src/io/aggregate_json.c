// An aggregation's results as JSON.
#include <clast/aggregate_run.h>
#include <clast/settling.h>

#include "base/alloc.h"
#include "io/json.h"
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void clast_aggregate_report_free(clast_aggregate_report *report)
{
    if (report == NULL) {
        return;
    }
    CLX_FREE(report->result, report->folder);
    *report = (clast_aggregate_report){0};
}

typedef double (*reader)(const clast_aggregate_result *result, int32_t index);

#define READER(name, field)                                                                        \
    static double name(const clast_aggregate_result *r, int32_t k)                                 \
    {                                                                                              \
        (void)k;                                                                                   \
        return r->field;                                                                           \
    }
READER(read_n_grain, n_grain)
READER(read_mass, mass)
READER(read_solid, solid_sum)
READER(read_union, solid_union)
READER(read_d_agg, d_agg)
READER(read_density, density)
READER(read_gyration, radius_of_gyration)
READER(read_settling, settling_velocity)
READER(read_permeable, settling_velocity_permeable)
READER(read_coat_porosity, coat_porosity)
READER(read_coat_grain, coat_grain)
READER(read_permeability, permeability)
READER(read_drag, drag_permeable)
READER(read_porosity, porosity[k])
READER(read_envelope, envelope[k].volume)

/// Of the fall in air, by d_agg; the drag law holds up to 3e5.
static double read_reynolds(const clast_aggregate_result *r, int32_t k)
{
    const clast_fluid air = clast_fluid_air();
    (void)k;
    return r->settling_velocity * r->d_agg * air.density / air.viscosity;
}

static const struct {
    const char *name;
    reader read;
} numbers[] = {
    {"n_grain", read_n_grain},
    {"mass", read_mass},
    {"solid_sum", read_solid},
    {"solid_union", read_union},
    {"d_agg", read_d_agg},
    {"density", read_density},
    {"radius_of_gyration", read_gyration},
    {"settling_velocity", read_settling},
    {"settling_reynolds", read_reynolds},
    {"settling_velocity_permeable", read_permeable},
    {"coat_porosity", read_coat_porosity},
    {"coat_grain", read_coat_grain},
    {"permeability", read_permeability},
    {"drag_permeable", read_drag},
};
enum { N_NUMBER = sizeof numbers / sizeof numbers[0] };

static void set_number(json_t *object, const char *key, double value)
{
    if (value == floor(value) && fabs(value) < 1e15 && key[0] == 'n' && key[1] == '_') {
        (void)json_object_set_new(object, key, json_integer((json_int_t)value));
        return;
    }
    (void)json_object_set_new(object, key, isfinite(value) ? json_real(value) : json_null());
}

/// Interval of one quantity over the repeats; `value` is scratch of n numbers.
static clast_interval interval(const clast_aggregate_report *report, reader read, int32_t k,
                               double *value)
{
    for (int32_t i = 0; i < report->n; ++i) {
        value[i] = read(&report->result[i], k);
    }
    return clast_interval_of(report->n, value, report->confidence);
}

static json_t *interval_json(clast_interval i)
{
    json_t *object = json_object();
    set_number(object, "mean", i.mean);
    set_number(object, "deviation", i.deviation);
    set_number(object, "low", i.low);
    set_number(object, "high", i.high);
    return object;
}

static const char *envelope_name(const clast_aggregate_report *report, int32_t k)
{
    return clast_envelope_name(report->result[0].envelope[k].kind);
}

static json_t *means_by_envelope(const clast_aggregate_report *report, reader read, double *value)
{
    json_t *object = json_object();
    for (int32_t k = 0; k < report->result[0].n_envelope; ++k) {
        set_number(object, envelope_name(report, k), interval(report, read, k, value).mean);
    }
    return object;
}

static json_t *intervals(const clast_aggregate_report *report, double *value)
{
    CLAST_ASSERT(report->n >= 2);
    json_t *object = json_object();
    json_t *porosity = json_object();
    set_number(object, "confidence", report->confidence);
    for (int32_t k = 0; k < report->result[0].n_envelope; ++k) {
        (void)json_object_set_new(porosity, envelope_name(report, k),
                                  interval_json(interval(report, read_porosity, k, value)));
    }
    (void)json_object_set_new(object, "porosity", porosity);
    for (int i = 0; i < N_NUMBER; ++i) {
        (void)json_object_set_new(object, numbers[i].name,
                                  interval_json(interval(report, numbers[i].read, 0, value)));
    }
    return object;
}

static const char *stop_name(clast_aggregate_stop stop)
{
    static const char *const names[] = {"not", "list", "mass", "size", "porosity"};
    return (unsigned)stop < sizeof names / sizeof names[0] ? names[stop] : "unknown";
}

static json_t *one_repeat(const clast_aggregate_result *r)
{
    json_t *object = json_object();
    json_t *envelope = json_object();
    json_t *error = json_object();
    json_t *porosity = json_object();
    for (int32_t k = 0; k < r->n_envelope; ++k) {
        const char *name = clast_envelope_name(r->envelope[k].kind);
        set_number(envelope, name, r->envelope[k].volume);
        set_number(error, name, r->envelope[k].error);
        set_number(porosity, name, r->porosity[k]);
    }
    (void)json_object_set_new(object, "n_grain", json_integer(r->n_grain));
    (void)json_object_set_new(object, "n_particle", json_integer(r->n_particle));
    (void)json_object_set_new(object, "n_contact", json_integer(r->n_contact));
    (void)json_object_set_new(object, "n_cluster", json_integer(r->n_cluster));
    (void)json_object_set_new(object, "n_grain_all", json_integer(r->n_grain_all));
    (void)json_object_set_new(object, "n_lost", json_integer(r->n_lost));
    (void)json_object_set_new(object, "permeable",
                              json_string(clast_permeable_range_text(r->permeable)));
    (void)json_object_set_new(object, "stopped_by", json_string(stop_name(r->stop)));
    for (int i = 1; i < N_NUMBER; ++i) {
        set_number(object, numbers[i].name, numbers[i].read(r, 0));
    }
    set_number(object, "solid_union_error", r->solid_union_error);
    (void)json_object_set_new(object, "envelope", envelope);
    (void)json_object_set_new(object, "envelope_error", error);
    (void)json_object_set_new(object, "porosity", porosity);
    set_number(object, "max_overlap", r->max_overlap);
    set_number(object, "max_overlap_relative", r->max_overlap_relative);
    return object;
}

/// Sums of the clocks, the worst overlap and the lost ones of all repeats.
static void add_totals(const clast_aggregate_report *report, bool times, json_t *object)
{
    clast_aggregate_result sum = {0};
    for (int32_t i = 0; i < report->n; ++i) {
        const clast_aggregate_result *r = &report->result[i];
        sum.max_overlap =
            isnan(r->max_overlap) ? (double)NAN : fmax(sum.max_overlap, r->max_overlap);
        sum.n_lost += r->n_lost;
        sum.wall_s += r->wall_s;
        sum.contact_s += r->contact_s;
        sum.envelope_s += r->envelope_s;
    }
    set_number(object, "max_overlap", sum.max_overlap);
    (void)json_object_set_new(object, "n_lost", json_integer(sum.n_lost));
    if (times) {
        set_number(object, "wall_s", sum.wall_s);
        set_number(object, "contact_s", sum.contact_s);
        set_number(object, "envelope_s", sum.envelope_s);
    }
}

static json_t *printable_json(const clast_printable_report *r)
{
    json_t *object = json_object();
    set_number(object, "neck", r->neck);
    set_number(object, "spacing", r->spacing);
    set_number(object, "smallest_feature", r->smallest_feature);
    (void)json_object_set_new(object, "resolved", json_boolean(r->resolved));
    (void)json_object_set_new(object, "walls_measured", json_boolean(r->knows_walls));
    set_number(object, "lost", r->lost);
    (void)json_object_set_new(object, "n_void_filled", json_integer(r->n_void));
    set_number(object, "solid_volume", r->solid_volume);
    set_number(object, "volume", r->volume);
    return object;
}

static json_t *whole(const clast_aggregate_report *report, bool times, double *value)
{
    json_t *object = json_object();
    json_t *repeats = json_array();
    char scope[512];
    (void)json_object_set_new(object, "n_repeat", json_integer(report->n));
    if (clast_aggregate_report_scope(report, sizeof scope, scope)[0] != '\0') {
        (void)json_object_set_new(object, "scope", json_string(scope));
    }
    for (int i = 0; i < N_NUMBER; ++i) {
        set_number(object, numbers[i].name, interval(report, numbers[i].read, 0, value).mean);
    }
    (void)json_object_set_new(object, "envelope", means_by_envelope(report, read_envelope, value));
    (void)json_object_set_new(object, "porosity", means_by_envelope(report, read_porosity, value));
    add_totals(report, times, object);
    for (int32_t i = 0; i < report->n; ++i) {
        (void)json_array_append_new(repeats, one_repeat(&report->result[i]));
    }
    if (report->n > 1) {
        (void)json_object_set_new(object, "interval", intervals(report, value));
    }
    (void)json_object_set_new(object, "repeats", repeats);
    if (report->is_printable) {
        (void)json_object_set_new(object, "printable", printable_json(&report->printable));
    }
    return object;
}

clast_status clast_aggregate_report_json(const clast_aggregate_report *report, bool times,
                                         char **text)
{
    CLX_ARGUMENTS(report, text);
    CLX_ARRAY(report->result, report->n);
    for (int32_t i = 0; i < report->n; ++i) {
        if (report->result[i].n_envelope < 0 || report->result[i].n_envelope > CLAST_N_ENVELOPE) {
            return clx_fail(CLAST_E_ARGUMENT, "%s: result %d has %d envelopes", __func__, i,
                            report->result[i].n_envelope);
        }
    }
    clast_status status = CLAST_OK;
    double *value = NULL;
    json_t *object = NULL;
    CLX_CHECK(report->n > 0, CLAST_E_USAGE, "a report of no aggregates");
    CLX_TRY(clx_alloc(&value, report->n, sizeof *value));
    object = whole(report, times, value);
    CLX_TRY(clx_json_dump(object, text));
done:
    json_decref(object);
    clx_free(value);
    return status;
}
