#pragma once
#include "base/status.h"
#include <clast/grading.h>

/// The plain struct of a caller: what clast_curve_make would refuse, here too.
clast_status clx_curve_check(const clast_curve *curve);

/// Least and greatest density of a list's rows [kg/m^3]; 0 and 0 without.
void clx_grading_densities(const clast_grading *grading, double *low, double *high);

/// Notes what clast_grading_list_of tells; the texts are copied.
clast_status clx_grading_note_list(const clast_grading_list *list, clast_grading *grading);

/// Density of grain `index` [kg/m^3]: of the row of the list that its size is drawn from; 0 where
/// the list has none, or there is no list.
double clx_grading_draw_density(const clast_grading *grading, uint64_t seed, uint64_t index);
