#pragma once
// Correlation of points below the size of the cells.
#include <clast/decompose.h>

/// What the counted pairs show within the cells; nothing where no cell holds two points.
void clx_pair_within(clast_decomposition *result);
