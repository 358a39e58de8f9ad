// Lengths as typed.
#include "lengths.h"

#include "command.h"
#include <clast/field.h>
#include <stdio.h>
#include <string.h>

static clast_status parse_length(const char *name, const char *text, const char *unit,
                                 double *value)
{
    const clast_status status = clast_unit_parse_length(text, unit, value);
    return status == CLAST_OK ? CLAST_OK : cli_fail(status, "%s: %s", name, clast_error_detail());
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
