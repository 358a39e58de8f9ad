#pragma once
// Whether beds and models that a caller has filled himself hold together. Both say what is wrong,
// for people, or give NULL.
#include "base/status.h"

typedef struct clast_bed clast_bed;
typedef struct clast_porosity_model clast_porosity_model;

const char *clx_bed_fault(const clast_bed *bed);
CLX_SHARED const char *clx_porosity_model_fault(const clast_porosity_model *model);
