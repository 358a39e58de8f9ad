#pragma once
// Several beds of one kind: the mean of every number that clast porosity finds, and its interval.
#include <clast/run_folder.h>
#include <clast/table.h>
#include <jansson.h>
#include <stdint.h>

enum { CLI_MOST_RUNS = 64 };

/// {0} holds no run.
typedef struct cli_bed_runs {
    int32_t n;
    json_t *found[CLI_MOST_RUNS]; ///< what was found in each: numbers, objects of numbers, texts
    clast_table profile[CLI_MOST_RUNS]; ///< porosity over height
    clast_table radial[CLI_MOST_RUNS];  ///< over the radius, or without columns
    char unit[16];
} cli_bed_runs;

/// Takes the object and the tables over, also when it fails.
///
/// @param name  of the run    @param unit  CLAST_E_USAGE when it is not that of the others
clast_status cli_bed_runs_add(cli_bed_runs *runs, const char *name, const char *unit, json_t *found,
                              clast_table *profile, clast_table *radial);

/// n_run, runs (what was found in each), and for every number its mean, deviation, low and high.
json_t *cli_bed_runs_json(const cli_bed_runs *runs);

/// A line a number.
clast_status cli_bed_runs_print(const cli_bed_runs *runs);

/// means.csv, mean_profile.csv and .svg, mean_radial.csv and .svg where rings were asked for.
clast_status cli_bed_runs_write(const cli_bed_runs *runs, const clast_run_folder *run);

void cli_bed_runs_free(cli_bed_runs *runs);
