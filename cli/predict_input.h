#pragma once
// What clast predict is told on the command line.
#include <clast/porosity_model.h>

/// The model named "auto", "single", "mixture", as published (single_form_U1) or a file's path.
///
/// @param grading     0 U1, 1 U7, 2 B50: used by the first three names
/// @param has_spread  the forms vary: "auto" is then the mixture
clast_status cli_choose_model(const char *name, int32_t grading, bool has_spread,
                              clast_porosity_model *model);

/// "0.65+-0.17" and "0.68 +- 0.14": means and deviations of flatness and elongation; both have a
/// deviation or none has (*has_deviation).
clast_status cli_parse_moments(const char *flatness, const char *elongation, double mean[2],
                               double deviation[2], bool *has_deviation);
