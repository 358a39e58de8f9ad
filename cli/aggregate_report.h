#pragma once
// The numbers of `clast aggregate` as sentences.
#include "command.h"

/// A table of means, with intervals where there are several repeats.
void aggregate_report_print(const clast_aggregate_report *report);
