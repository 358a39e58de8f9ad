// Options that fits and predictions do not look at.
#include <clast/porosity_model.h>

#include "base/field.h"
#include <string.h>

const clast_idle *clast_porosity_fit_idle(const clast_porosity_fit_config *c, bool has_group,
                                          clast_idle rules[CLAST_N_IDLE])
{
    if (c == NULL || c->use == NULL || rules == NULL) {
        return NULL;
    }
    const clast_idle made[CLAST_N_IDLE] = {
        {c->use[0] != '\0', "n_term|score", "with --use: features are named, none is selected"},
        {!has_group, "group", "without --grains, where beds are of one form each"}};
    return clx_idle_copy(made, rules);
}

bool clast_porosity_model_by_grading(const char *model)
{
    return model != NULL && (strcmp(model, "auto") == 0 || strcmp(model, "single") == 0 ||
                             strcmp(model, "mixture") == 0);
}

const clast_idle *clast_porosity_predict_idle(const clast_predict_given *given,
                                              clast_idle rules[CLAST_N_IDLE])
{
    if (given == NULL || rules == NULL) {
        return NULL;
    }
    const clast_idle made[CLAST_N_IDLE] = {
        {!given->has_table, "each|columns|resamples|seed", "without a table"},
        {given->has_table, "grains", "with a table, whose rows are counted"},
        {given->each, "resamples|seed", "with --each: a form has no sampling error"},
        {!clast_porosity_model_by_grading(given->model), "grading",
         "with this --model, which has its own"},
        {given->takes_columns, "columns|resamples|seed", "with a model of a table's own columns"}};
    return clx_idle_copy(made, rules);
}
