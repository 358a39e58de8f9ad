#pragma once
// What clast decompose found: as JSON, in words.
#include "decompose_files.h"
#include "evenness.h"
#include "points.h"
#include <jansson.h>

/// What the command finds beside the decomposition.
typedef struct cli_decompose_found {
    const char *typed;            ///< the domain as it was
    char domain[CLI_DOMAIN_NAME]; ///< as typed for a mesh, else in m
    clast_packing_report read;    ///< which snapshot of the file
    int64_t n_repeated;
    cli_evenness evenness;
    double begun;
} cli_decompose_found;

/// The summary.
json_t *cli_decompose_json(const cli_decompose_job *job, const cli_decompose_found *found);

/// The same on stdout; of the tests alone where nothing else was asked for.
void cli_decompose_print(const cli_decompose_job *job, const cli_decompose_found *found);
