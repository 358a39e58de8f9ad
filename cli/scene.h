#pragma once
// Scenes of `clast bench`: each does one job of the product and says how long it took.
#include "command.h"

/// A run of one scene; the scene fills in what it measures.
typedef struct cli_lap {
    const char *data; ///< folder of SCARLET-1.0's files: stl/, *.csv
    int32_t repeats;
    double wall, cpu;   ///< least of the repeats [s], by the stopwatch below
    double value;       ///< in the scene's unit
    double reference;   ///< from the table, or set by the scene where a plain twin is measured
    int32_t left;       ///< repeats still to do
    double wall0, cpu0; ///< stopwatch
} cli_lap;

/// True while a repeat is to be done: `while (cli_lap_again(b)) { start; work; stop; }`
bool cli_lap_again(cli_lap *b);
void cli_lap_start(cli_lap *b);
void cli_lap_stop(cli_lap *b);

typedef struct cli_scene {
    const char *name;
    const char *unit;         ///< of value and reference; a unit that ends in "/s" is a rate
    double reference;         ///< 0: measured in the same run
    const char *reference_is; ///< in words: whose figure, of what
    bool is_slow;             ///< run only when named
    const char *summary;
    clast_status (*run)(cli_lap *b);
} cli_scene;
