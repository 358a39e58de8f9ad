#pragma once
// Clouds of true shapes for the tests, from the texts of their options.
#include <clast/evolve.h>

/// Owns its members; ends with evolving_end.
typedef struct evolving {
    clast_evolve_config config;
    clast_evolve_source source;
    clast_evolve *evolve;
} evolving;

/// Sets "key=value".
void evolving_set(clast_evolve_config *config, const char *option);

/// Loads what the options name; NULL ends them. Nothing is made yet.
void evolving_open(evolving *cloud, const char *const *option);

/// The same, and all particles at their places.
void evolving_begin(evolving *cloud, const char *const *option);

/// To its end; the numbers then.
clast_evolve_result evolving_follow(evolving *cloud);
void evolving_end(evolving *cloud);
