#pragma once
// Small aggregates for tests, from built-in shapes.
#include "support.h"

/// A core and coating shapes with their sizes and options; one for each test.
typedef struct support_aggregate {
    clast_aggregate_config config;
    clast_assembly core;
    clast_assembly coat[4];
    clast_aggregate_input input;
} support_aggregate;

/// Core and n coating shapes: unit spheres (axes NULL), or ellipsoids of these full axes [n][3],
/// with three spheres each as composites, the core like the first. Options are
/// "key=value;key=value"; lists grow by repeating the key.
void support_aggregate_make(support_aggregate *s, const double (*axes)[3], int32_t n_coat,
                            const char *options);
/// Sets "key=value;key=value"; a list's first value here replaces what it had.
void support_aggregate_options(clast_aggregate_config *config, const char *options);
void support_aggregate_free(support_aggregate *s);

/// Runs repeat `repeat` to its end.
clast_aggregate *support_aggregate_run(support_aggregate *s, int32_t repeat);
