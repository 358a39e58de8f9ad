#pragma once
// Where an axis puts its ticks and how it writes them.
#include <stdbool.h>

enum { CLX_MAX_TICK = 24, CLX_MAX_MINOR = 216, CLX_AXIS_SIZE = 256 };

typedef struct clx_ticks {
    bool log;
    double low, high; ///< range of the axis; ticks lie inside
    char title[CLX_AXIS_SIZE];
    int n;
    double at[CLX_MAX_TICK];
    char label[CLX_MAX_TICK][16];
    int n_minor;
    double minor[CLX_MAX_MINOR];
} clx_ticks;

/// Ticks at 1, 2 or 5 times a power of ten (linear) or at powers of ten (log); the range is widened
/// to ticks when `widen`. low < high, and low > 0 for log.
void clx_ticks_make(double low, double high, bool log, bool widen, int wanted, clx_ticks *ticks);

/// Place of a value on the axis, 0 at low and 1 at high.
double clx_ticks_place(const clx_ticks *ticks, double value);
