#pragma once
// What clast shape says about grains, as JSON and as tables.
#include "command.h"
#include "json.h"
#include <clast/grain.h>

typedef struct cli_shape_result {
    clast_grains grains;
    clast_axes_kind axes; ///< behind L, I, S, D and the factors
    bool in_metres;       ///< else the files' own unit
    bool is_hull;
} cli_shape_result;

json_t *cli_shape_json(const cli_shape_result *shape);

/// One grain: everything, line by line; several: a row each.
void cli_shape_words(const cli_shape_result *shape);
