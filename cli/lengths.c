// Lengths as typed.
#include "lengths.h"

#include "command.h"
#include <clast/field.h>
#include <stdio.h>
#include <string.h>

/// A length as typed: with its unit for a run in metres, bare in the unit of any other.
static clast_status parse_length(const char *name, const char *text, const char *unit,
                                 double *value)
{
    const bool is_metre = strcmp(unit, "m") == 0;
    const clast_status status =
        is_metre ? clast_unit_parse_asked(text, "m", value) : clast_unit_parse(text, "-", value);
    return status == CLAST_OK
               ? CLAST_OK
               : cli_fail(status, "%s: %s%s", name, clast_error_detail(),
                          is_metre ? "" : "; the run has no unit, so a bare number in its own");
}

clast_status cli_read_length(const char *name, const char *text, const char *unit, double *value)
{
    const double low = strcmp(name, "floor") == 0 ? -1e9 : 0.0;
    CLI_GUARD(parse_length(name, text, unit, value));
    return *value >= low && *value <= 1e9
               ? CLAST_OK
               : cli_fail(CLAST_E_CONFIG, "%s: %s is outside [%g, 1e9]", name, text, low);
}

/// The lengths of --bed, in the unit in which read_length takes the others; what is no number is
/// left to clast_bed_load.
clast_status cli_check_bed_lengths(const char *bed, const char *unit)
{
    const char *at = strncmp(bed, "mesh:", 5) == 0 ? NULL : strchr(bed, ':');
    while (at != NULL) {
        char one[64];
        double value = 0.0;
        const size_t n = strcspn(++at, ",");
        (void)snprintf(one, sizeof one, "%.*s", (int)n, at);
        if (clast_unit_parse(one, "m", &value) == CLAST_OK) {
            CLI_GUARD(parse_length("bed", one, unit, &value));
        }
        at = at[n] == ',' ? at + n : NULL;
    }
    return CLAST_OK;
}
