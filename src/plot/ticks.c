// Axis ticks: round numbers, few enough to read.
#include "plot/ticks.h"

#include "base/number.h"
#include "base/status.h"

#include <math.h>
#include <string.h>

static double round_step(double rough)
{
    const double power = pow(10.0, floor(log10(rough)));
    const double lead = rough / power;
    return power * (lead < 1.5 ? 1.0 : lead < 3.5 ? 2.0 : lead < 7.5 ? 5.0 : 10.0);
}

static void label_number(double value, double step, double largest, char *text, size_t size)
{
    if (largest >= 1e6 || step < 1e-4) {
        (void)clx_number_print(text, size, "%.4g", value);
        return;
    }
    const int decimals = step >= 1.0 ? 0 : (int)ceil(-log10(step) - 1e-9);
    (void)clx_number_print(text, size, "%.*f", decimals, value);
}

static void linear(double low, double high, bool widen, int wanted, clx_ticks *t)
{
    const double step = round_step((high - low) / wanted);
    if (widen) {
        low = step * floor(low / step + 1e-9);
        high = step * ceil(high / step - 1e-9);
    }
    t->low = low;
    t->high = high;
    const double first = ceil(low / step - 1e-9);
    for (t->n = 0; t->n < CLX_MAX_TICK; ++t->n) {
        const double value = (first + t->n) * step;
        if (value > high + 1e-9 * step) {
            break;
        }
        t->at[t->n] = fabs(value) < 1e-9 * step ? 0.0 : value;
        label_number(t->at[t->n], step, fmax(fabs(low), fabs(high)), t->label[t->n],
                     sizeof t->label[0]);
    }
}

static void add_tick(clx_ticks *t, double value)
{
    CLAST_ASSERT(t->n >= 0 && t->n <= CLX_MAX_TICK);
    if (t->n == CLX_MAX_TICK) {
        return;
    }
    t->at[t->n] = value;
    (void)clx_number_print(t->label[t->n], sizeof t->label[0],
                           value >= 0.999e-3 && value < 1.001e5 ? "%g" : "%.0e", value);
    ++t->n;
}

static void add_minor(clx_ticks *t, int first, int last)
{
    for (int k = first; k <= last; ++k) {
        for (int m = 2; m <= 9 && t->n_minor < CLX_MAX_MINOR; ++m) {
            const double value = m * pow(10.0, k);
            if (value >= t->low * (1.0 - 1e-9) && value <= t->high * (1.0 + 1e-9)) {
                t->minor[t->n_minor++] = value;
            }
        }
    }
}

/// True for digit times a power of ten.
static bool is_lead(double value, double digit)
{
    return fabs(value / pow(10.0, floor(log10(value) + 1e-9)) - digit) < 1e-6;
}

static void logarithmic(double low, double high, bool widen, int wanted, clx_ticks *t)
{
    double a = log10(low);
    double b = log10(high);
    if (widen && b - a > 0.8) {
        a = floor(a + 1e-9);
        b = ceil(b - 1e-9);
    } else if (widen) { // or the first and the last point would lie on the frame
        const double margin = 0.04 * (b - a);
        a -= margin;
        b += margin;
    }
    t->low = pow(10.0, a);
    t->high = pow(10.0, b);
    const int first = (int)ceil(a - 1e-9);
    const int last = (int)floor(b + 1e-9);
    const int stride = (last - first) / (wanted > 1 ? wanted : 1) + 1;
    for (int k = first; k <= last; k += stride) {
        add_tick(t, pow(10.0, k));
    }
    if (stride == 1) {
        add_minor(t, first - 1, last);
    }
    const bool few = t->n < 2; // under two powers in sight: label 2 and 5 as well
    for (int i = 0; few && i < t->n_minor; ++i) {
        if (is_lead(t->minor[i], 2.0) || is_lead(t->minor[i], 5.0)) {
            add_tick(t, t->minor[i]);
        }
    }
    if (t->n < 2) { // a short piece of a decade: evenly spaced numbers
        const double step = round_step((t->high - t->low) / wanted);
        t->n = 0;
        const double begin = ceil(t->low / step);
        for (int k = 0; (begin + k) * step <= t->high && t->n < CLX_MAX_TICK; ++k) {
            add_tick(t, (begin + k) * step);
        }
    }
}

void clx_ticks_make(double low, double high, bool log, bool widen, int wanted, clx_ticks *ticks)
{
    CLAST_ASSERT(low < high && (!log || low > 0.0) && wanted > 0);
    memset(ticks, 0, sizeof *ticks);
    ticks->log = log;
    if (log) {
        logarithmic(low, high, widen, wanted, ticks);
    } else {
        linear(low, high, widen, wanted, ticks);
    }
}

double clx_ticks_place(const clx_ticks *ticks, double value)
{
    if (ticks->log) {
        return value > 0.0 ? log(value / ticks->low) / log(ticks->high / ticks->low) : -1.0;
    }
    return (value - ticks->low) / (ticks->high - ticks->low);
}
