#pragma once
// The numbers of `clast aggregate`, as one JSON object or as sentences.
#include "command.h"

/// Results of the repeats so far; {0} but for the configuration is empty.
typedef struct aggregate_report {
    const clast_aggregate_config *config; ///< borrowed
    int32_t n;
    clast_aggregate_result *result; ///< [n]
} aggregate_report;

clast_status aggregate_report_add(aggregate_report *report, const clast_aggregate *aggregate);
void aggregate_report_free(aggregate_report *report);

/// On stdout, by --json or not.
clast_status aggregate_report_print(const aggregate_report *report, const cli_common *common);
