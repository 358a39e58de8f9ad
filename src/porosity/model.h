#pragma once
// Building porosity models.
#include <clast/porosity_model.h>

/// Room for terms, ranges and a covariance of an empty model, texts not yet set.
clast_status clx_model_room(const char *name, const char *source, int32_t n_term, int32_t n_range,
                            bool has_covariance, clast_porosity_model *model);
