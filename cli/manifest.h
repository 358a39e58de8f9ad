#pragma once
// manifest.json beside the results of a command that has no run of its own in the library.
#include "command.h"

/// An input file and its part in the command ("table"); path NULL or "": there is none.
typedef struct cli_input {
    const char *role, *path;
} cli_input;

/// Starts the clocks when results are kept (-o); *manifest is NULL otherwise.
clast_status cli_manifest_begin(const cli_common *common, clast_manifest **manifest);

/// Writes manifest.json into the output folder; does nothing without a manifest.
///
/// @param input  up to one without a role
clast_status cli_manifest_end(const cli_common *common, clast_manifest *manifest,
                              const clast_field *fields, const void *config, uint64_t seed,
                              const cli_input *input);
