// Ranges of a chart's axes, from its data.
#include "plot/figure.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    double low, high;
    bool log;
} span;

static void widen(span *s, double value)
{
    if (isfinite(value) && (!s->log || value > 0.0)) {
        s->low = fmin(s->low, value);
        s->high = fmax(s->high, value);
    }
}

static void widen_all(span *s, const double *values, int64_t n)
{
    for (int64_t i = 0; values != NULL && i < n; ++i) {
        widen(s, values[i]);
    }
}

static double most_of(const span *s, const clast_axis *axis)
{
    return axis->low < axis->high ? fmax(fabs(axis->low), fabs(axis->high))
                                  : fmax(fabs(s->low), fabs(s->high));
}

/// Writes the title of an axis "... (m)" with the prefix that a person would write for values up to
/// `most`, none from 0.01 to 10^4; returns what the values are divided by for it.
static double use_prefix(const char *label, double most, char title[CLX_AXIS_SIZE])
{
    static const struct {
        const char *unit, *stem;
        double size; ///< of the stem, in the unit
        bool is_large_too;
    } units[] = {{" (m)", "m", 1.0, false}, {" (s)", "s", 1.0, false}, {" (kg)", "g", 1e-3, false},
                 {" (N)", "N", 1.0, true},  {" (J)", "J", 1.0, true},  {" (Pa)", "Pa", 1.0, true}};
    static const struct {
        double size;
        const char *name;
    } prefixes[] = {{1e9, "G"},  {1e6, "M"},         {1e3, "k"},  {1.0, ""},
                    {1e-3, "m"}, {1e-6, "\302\265"}, {1e-9, "n"}, {1e-12, "p"}};
    const size_t n_unit = sizeof units / sizeof *units;
    const size_t n_prefix = sizeof prefixes / sizeof *prefixes;
    const size_t n = label != NULL ? strlen(label) : 0;
    size_t u = 0;
    size_t p = 0;
    (void)snprintf(title, CLX_AXIS_SIZE, "%s", n > 0 ? label : "");
    while (u < n_unit && !(n > strlen(units[u].unit) &&
                           strcmp(label + n - strlen(units[u].unit), units[u].unit) == 0)) {
        ++u;
    }
    if (u == n_unit || !(most > 0.0) || !isfinite(most) ||
        (most >= 0.01 && (most < 1e4 || !units[u].is_large_too))) {
        return 1.0;
    }
    while (p + 1 < n_prefix && most < 0.999999 * units[u].size * prefixes[p].size) {
        ++p;
    }
    (void)snprintf(title, CLX_AXIS_SIZE, "%.*s (%s%s)", (int)(n - strlen(units[u].unit)), label,
                   prefixes[p].name, units[u].stem);
    return units[u].size * prefixes[p].size;
}

/// Ticks at round values of the unit with its prefix.
static void make_ticks(const span *s, bool pad, int wanted, double unit, clx_ticks *t)
{
    clx_ticks_make(s->low / unit, s->high / unit, s->log, pad, wanted, t);
    for (int i = 0; i < t->n && unit != 1.0; ++i) {
        t->at[i] *= unit;
    }
    for (int i = 0; i < t->n_minor && unit != 1.0; ++i) {
        t->minor[i] *= unit;
    }
    t->low *= unit;
    t->high *= unit;
}

static clast_status settle(span *s, const clast_axis *axis, bool pad, int wanted, double most,
                           clx_ticks *ticks)
{
    const bool given = axis->low < axis->high;
    if (given) {
        s->low = axis->low;
        s->high = axis->high;
    }
    if (!(s->low <= s->high) || (s->log && s->low <= 0.0)) {
        return clx_fail(CLAST_E_USAGE, "chart axis '%s' has no finite%s value to show",
                        axis->label != NULL ? axis->label : "", s->log ? " positive" : "");
    }
    if (s->low == s->high) {
        const double more = s->low == 0.0 ? 1.0 : 0.1 * fabs(s->low);
        s->low -= more;
        s->high += more;
    }
    char title[CLX_AXIS_SIZE];
    const double unit = use_prefix(axis->label, most, title);
    make_ticks(s, pad && !given, wanted, unit, ticks);
    memcpy(ticks->title, title, sizeof title);
    return CLAST_OK;
}

static void widen_series(span *x, span *y, span *value, const clast_series *e)
{
    widen_all(x, e->x, e->n + (e->kind == CLAST_SERIES_BARS ? 1 : 0));
    widen_all(y, e->y, e->n);
    widen_all(y, e->low, e->n);
    widen_all(y, e->high, e->n);
    widen_all(value, e->value, e->n);
    if (e->kind == CLAST_SERIES_BARS) {
        widen(y, 0.0);
    }
}

static void widen_heat(span *x, span *y, span *value, const clast_heat *h)
{
    widen(x, h->x_low);
    widen(x, h->x_high);
    widen(y, h->y_low);
    widen(y, h->y_high);
    widen_all(value, h->value, (int64_t)h->n_x * h->n_y);
}

static bool is_at(double value, double limit)
{
    return fabs(value - limit) <= 1e-9 * fabs(limit);
}

/// Whether a line has a stretch at `limit`: along it lies a, across it b. A step goes level from
/// (x, y) of a point to the next x, then up or down.
static bool stays_at(const double *a, const double *b, int64_t n, double limit, bool once)
{
    for (int64_t i = 1; i < n; ++i) {
        if (is_at(a[i], limit) && (once || is_at(a[i - 1], limit)) && b[i] != b[i - 1]) {
            return true;
        }
    }
    return false;
}

/// Goes on beyond ends of the axis along which a line runs: on the frame it would not be seen.
static void clear_frame(const clast_chart *c, bool of_x, clx_ticks *t)
{
    const double share = 0.03;
    const double range = t->high - t->low;
    const double end[2] = {t->low, t->high};
    for (int k = 0; k < 2; ++k) {
        bool is_hidden = false;
        for (int32_t i = 0; i < c->n_series; ++i) {
            const clast_series *e = &c->series[i];
            const bool is_step = e->kind == CLAST_SERIES_STEP;
            if (e->kind == CLAST_SERIES_LINE || is_step) {
                is_hidden = is_hidden || stays_at(of_x ? e->x : e->y, of_x ? e->y : e->x, e->n,
                                                  end[k], of_x && is_step);
            }
        }
        const double factor = pow(t->high / t->low, share);
        const double beyond = t->log ? end[k] * (k == 0 ? 1.0 / factor : factor)
                                     : end[k] + (k == 0 ? -share : share) * range;
        *(k == 0 ? &t->low : &t->high) = is_hidden ? beyond : end[k];
    }
}

clast_status clx_figure_measure(clx_figure *figure)
{
    const clast_chart *c = figure->chart;
    clast_status status = CLAST_OK;
    span x = {INFINITY, -INFINITY, c->x.log};
    span y = {INFINITY, -INFINITY, c->y.log};
    span value = {INFINITY, -INFINITY, c->value_axis.log};
    for (int32_t i = 0; i < c->n_series; ++i) {
        widen_series(&x, &y, &value, &c->series[i]);
    }
    widen_all(&y, c->mark_y, c->n_mark);
    if (c->heat != NULL) {
        widen_heat(&x, &y, &value, c->heat);
    }
    figure->has_value = c->value_axis.label != NULL;
    const double most_x = most_of(&x, &c->x);
    const double most_y = most_of(&y, &c->y);
    const double most = fmax(most_x, most_y);
    CLX_TRY(settle(&x, &c->x, c->heat == NULL, 6, c->equal ? most : most_x, &figure->x));
    CLX_TRY(settle(&y, &c->y, c->heat == NULL, 5, c->equal ? most : most_y, &figure->y));
    if (c->heat == NULL && !(c->x.low < c->x.high)) {
        clear_frame(c, true, &figure->x);
    }
    if (c->heat == NULL && !(c->y.low < c->y.high)) {
        clear_frame(c, false, &figure->y);
    }
    if (figure->has_value) {
        CLX_TRY(settle(&value, &c->value_axis, false, 5, most_of(&value, &c->value_axis),
                       &figure->value));
    }
done:
    return status;
}
