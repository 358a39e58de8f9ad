// Names of units of length as programs of scanners write them.
#include "io/volume_io.h"

#include <clast/field.h>
#include <string.h>

double clx_volume_unit(const char *text)
{
    static const struct {
        const char *name, *unit;
    } names[] = {{"micron", "um"},     {"microns", "um"},    {"micrometer", "um"},
                 {"micrometre", "um"}, {"\\u00B5m", "um"},   {"\xb5m", "um"},
                 {"millimeter", "mm"}, {"millimetre", "mm"}, {"centimeter", "cm"},
                 {"meter", "m"},       {"nanometer", "nm"},  {"inch", "in"}};
    double metre = 0.0;
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        text = strcmp(text, names[k].name) == 0 ? names[k].unit : text;
    }
    return text[0] != '\0' && clast_unit_factor(text, "m", &metre) == CLAST_OK ? metre : 0.0;
}
