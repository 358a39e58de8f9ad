// Numbers with the units in which people write them.
#include "quantity.h"

#include <clast/field.h>
#include <math.h>
#include <stdio.h>

enum { TEXT_SIZE = 64 };

static char *next_text(void)
{
    static char shown[8][TEXT_SIZE];
    static unsigned next;
    return shown[next++ % 8];
}

const char *cli_quantity_as(double value, const char *si_unit, double like)
{
    char *out = next_text();
    double factor = 1.0;
    const char *unit = clast_unit_for(like, si_unit, &factor);
    const double size = fabs(value * factor);
    (void)snprintf(out, TEXT_SIZE, size >= 1e4 && size < 1e6 ? "%.0f %s" : "%.4g %s",
                   value * factor, unit);
    return out;
}

const char *cli_quantity(double value, const char *si_unit)
{
    return cli_quantity_as(value, si_unit, value);
}

const char *cli_p_value(double p)
{
    char *out = next_text();
    (void)snprintf(out, TEXT_SIZE, p == 0.0 ? "< 1e-300" : "%.4g", p);
    return out;
}
