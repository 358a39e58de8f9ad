#pragma once
// Series of a chart in one line each. Colours: 0..7, -1 is grey; a label of NULL has no entry in
// the legend.
#include <clast/chart.h>

/// Values y over x.
static inline clast_series clx_series(clast_series_kind kind, const char *label, const double *x,
                                      const double *y, int64_t n, int32_t colour)
{
    return (clast_series){.kind = kind, .label = label, .x = x, .y = y, .n = n, .colour = colour};
}

static inline clast_series clx_dashed_line(const char *label, const double *x, const double *y,
                                           int64_t n, int32_t colour)
{
    clast_series line = clx_series(CLAST_SERIES_LINE, label, x, y, n, colour);
    line.dashed = true;
    return line;
}

/// What lies between two lines.
static inline clast_series clx_band(const char *label, const double *x, const double *low,
                                    const double *high, int64_t n, int32_t colour)
{
    clast_series band = clx_series(CLAST_SERIES_BAND, label, x, NULL, n, colour);
    band.low = low;
    band.high = high;
    return band;
}
