// Numbers with the units in which people write them.
#include "quantity.h"

#include <clast/field.h>
#include <math.h>
#include <stdio.h>

const char *cli_quantity_as(double value, const char *si_unit, double like)
{
    static char shown[8][64];
    static unsigned next;
    char *out = shown[next++ % 8];
    double factor = 1.0;
    const char *unit = clast_unit_for(like, si_unit, &factor);
    const double size = fabs(value * factor);
    (void)snprintf(out, sizeof shown[0], size >= 1e4 && size < 1e6 ? "%.0f %s" : "%.4g %s",
                   value * factor, unit);
    return out;
}

const char *cli_quantity(double value, const char *si_unit)
{
    return cli_quantity_as(value, si_unit, value);
}
