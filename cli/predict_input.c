// Models by name and means with deviations, for clast predict.
#include "predict_input.h"

#include "command.h"
#include <clast/porosity_model.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

clast_status cli_choose_model(const char *name, int32_t grading, bool has_spread,
                              clast_porosity_model *model)
{
    static const char *const gradings[3] = {"U1", "U7", "B50"};
    char published[64];
    bool is_mixture = strcmp(name, "mixture") == 0;
    if (strcmp(name, "auto") == 0) {
        is_mixture = has_spread;
    } else if (!is_mixture && strcmp(name, "single") != 0) {
        const int32_t number = clast_porosity_model_find(name);
        return number >= 0 ? clast_porosity_model_published(number, model)
                           : clast_porosity_model_read(name, model);
    }
    (void)snprintf(published, sizeof published, "%s_%s",
                   is_mixture ? "form_mixture" : "single_form", gradings[grading]);
    const int32_t number = clast_porosity_model_find(published);
    if (number < 0) {
        return cli_fail(CLAST_E_USAGE,
                        "no form-mixture model was published for %s; take --model single, or U1 or "
                        "U7",
                        gradings[grading]);
    }
    return clast_porosity_model_published(number, model);
}

/// One "mean" or "mean+-deviation"; *deviation is -1 without one.
static clast_status parse_one(const char *name, const char *text, double *mean, double *deviation)
{
    char *end = NULL;
    *deviation = -1.0;
    *mean = strtod(text, &end);
    bool good = end != text;
    end += strspn(end, " ");
    const size_t sign = strncmp(end, "+-", 2) == 0         ? 2
                        : strncmp(end, "+/-", 3) == 0      ? 3
                        : strncmp(end, "\302\261", 2) == 0 ? 2
                                                           : 0;
    if (good && sign > 0) {
        const char *from = end + sign;
        *deviation = strtod(from, &end);
        good = end != from && *deviation >= 0.0;
    }
    end += strspn(end, " ");
    if (!good || *end != '\0') {
        return cli_fail(CLAST_E_USAGE,
                        "--%s '%s' is no mean, as 0.65, or mean and standard deviation, as "
                        "0.65+-0.17",
                        name, text);
    }
    return CLAST_OK;
}

clast_status cli_parse_moments(const char *flatness, const char *elongation, double mean[2],
                               double deviation[2], bool *has_deviation)
{
    if (flatness[0] == '\0' || elongation[0] == '\0') {
        return cli_fail(CLAST_E_USAGE, "--%s is missing: give both --flatness and --elongation",
                        flatness[0] == '\0' ? "flatness" : "elongation");
    }
    CLI_GUARD(parse_one("flatness", flatness, &mean[0], &deviation[0]));
    CLI_GUARD(parse_one("elongation", elongation, &mean[1], &deviation[1]));
    if ((deviation[0] < 0.0) != (deviation[1] < 0.0)) {
        return cli_fail(CLAST_E_USAGE, "--%s has a deviation and --%s has none: give both or none",
                        deviation[0] < 0.0 ? "elongation" : "flatness",
                        deviation[0] < 0.0 ? "flatness" : "elongation");
    }
    *has_deviation = deviation[0] >= 0.0;
    return CLAST_OK;
}
