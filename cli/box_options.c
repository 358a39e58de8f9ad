// Options of clast agglomerate, and which of them go with one another: of clouds, of a box, of
// kernels.
#include "box_model.h"
#include "idle.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void cli_box_fields(cli_joined *joined, size_t offset)
{
    cli_joined_append(
        joined,
        (clast_field){"box_model", offsetof(cli_box, box_model), CLAST_FIELD_BOOL, 0, 0, 1, "-",
                      "a well-mixed box without POINTS: --concentration and a law of sizes", NULL,
                      "box without positions", false},
        offset);
    for (const clast_field *f = clast_spectrum_fields; f->name != NULL; ++f) {
        clast_field field = *f;
        field.group = NULL;
        cli_joined_append(joined, field, offset + offsetof(cli_box, spectrum));
    }
    cli_joined_append(joined,
                      (clast_field){.name = "initial_file",
                                    .offset = offsetof(cli_box, initial_file),
                                    .type = CLAST_FIELD_TEXT,
                                    .unit = "-",
                                    .text = "",
                                    .help =
                                        "table of --initial table: columns size (monomers) and "
                                        "number (1/m^3; shares, where --concentration is given), "
                                        "or a box's spectrum.csv, whose last time is taken"},
                      offset);
}

/// Refuses what kernels, sticking, radii and settling in a box do not look at, be it a number or a
/// column: "--shear does nothing with --kernel brownian".
static clast_status check_used(const clast_agglomerate_config *c, bool settles, const char *option,
                               const char *name)
{
    char key[64];
    char word[512] = "";
    (void)snprintf(key, sizeof key, "%s", name);
    char *const end = strstr(key, "_column");
    if (end != NULL) {
        *end = '\0';
    }
    const char *const by = clast_collide_idle(&c->collide, key, settles);
    if (by == NULL) {
        return CLAST_OK;
    }
    (void)clast_field_format(clast_fields_find(clast_agglomerate_fields, by), c, 0, sizeof word,
                             word);
    return cli_fail(CLAST_E_USAGE, "--%s does nothing with --%s %s", option,
                    strcmp(by, "radius_law") == 0 ? "radius-law" : by, word);
}

clast_status cli_box_check(const cli_common *common, const clast_field *fields, const void *config,
                           const cli_box *box, const clast_agglomerate_config *agglomerate)
{
    clast_agglomerate_config c = *agglomerate; // with its kernel as a mask; borrows its texts
    const bool settles = box->box_model && box->spectrum.settling_depth > 0.0;
    clast_idle rules[CLAST_N_IDLE];
    if (!box->box_model && common->n_argument == 0) {
        return cli_fail(CLAST_E_USAGE,
                        "missing POINTS... (or --box-model: a box without positions)");
    }
    if (box->box_model && common->n_argument > 0) {
        return cli_fail(CLAST_E_USAGE, "a box has no positions: leave '%s' or --box-model out",
                        cli_name(common->argument[0]));
    }
    CLI_GUARD(clast_kernel_parse(agglomerate->kernel, &c.collide.kernel));
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        char option[CLI_NAME_SIZE];
        if (clast_field_is_default(f, config)) {
            continue;
        }
        cli_option_name(f, option);
        if (!clast_agglomerate_takes(f->name, box->box_model)) {
            return cli_fail(CLAST_E_USAGE, "--%s is an option of %s", option,
                            box->box_model ? "clouds: a box has no positions"
                                           : "a box: it needs --box-model");
        }
        CLI_GUARD(check_used(&c, settles, option, f->name));
    }
    if (box->box_model) {
        CLI_GUARD(cli_idle_check(fields, config, clast_spectrum_idle(&box->spectrum, rules)));
    }
    if (box->box_model &&
        (box->spectrum.initial == CLAST_INITIAL_TABLE) != (box->initial_file[0] != '\0')) {
        return cli_fail(CLAST_E_USAGE, "--initial table and --initial-file go together");
    }
    return CLAST_OK;
}
