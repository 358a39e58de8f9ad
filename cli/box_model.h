#pragma once
// clast agglomerate --box-model: a size spectrum without positions.
#include "configs.h"

/// The part of a configuration that cli_box_fields fills.
typedef struct cli_box {
    clast_spectrum_config spectrum;
    char *initial_file;
    bool box_model;
} cli_box;

/// Appends the options of a cli_box that lies `offset` bytes into a configuration struct.
void cli_box_fields(cli_joined *joined, size_t offset);

/// Whether the options go with one another and with the number of arguments: those of a box with
/// --box-model alone, those of clouds without, those of a kernel with that kernel. `fields` is the
/// whole table.
clast_status cli_box_check(const cli_common *common, const clast_field *fields, const void *config,
                           const cli_box *box, const clast_agglomerate_config *agglomerate);

/// A run: where results go, the whole configuration, and the parts of it that a box looks at.
typedef struct cli_box_job {
    const cli_common *common;
    const clast_field *fields;
    const void *config;
    const cli_box *box;
    const clast_agglomerate_config *agglomerate;
    const char *picture; ///< extension of charts
} cli_box_job;

/// Runs the box and writes or prints what it gives; clears `force`, as cli_results_begin.
clast_status cli_box_run(const cli_box_job *job, bool *force);
