#pragma once
// What clast predict found: as JSON, in words.
#include <clast/clast.h>
#include <jansson.h>

/// Everything of one run.
typedef struct cli_prediction {
    clast_porosity_model model;
    clast_table table, beds;
    clast_form_set set;
    clast_form_inputs inputs;
    clast_prediction prediction;
    bool has_table, has_one; ///< has_one: `prediction` is the answer for one bed
    bool knows_spread;       ///< deviations were given, or two grains or more
} cli_prediction;

/// Rows of the table that are in no prediction.
int64_t cli_prediction_left_out(const cli_prediction *prediction);

json_t *cli_prediction_json(const cli_prediction *prediction);

/// "d50 (m)" of a column whose cells have a unit; the name alone of plain numbers (unit "-" or
/// NULL).
void cli_feature_name(const char *name, const char *unit, size_t size, char *text);
void cli_prediction_print(const cli_prediction *prediction);
