#pragma once
// Repeats of an aggregation where they were grown, and their way to rank 0.
#include "base/comm.h"
#include <clast/aggregate_run.h>
#include <clast/table.h>

/// One finished repeat in numbers.
typedef struct clx_repeat {
    int32_t index;
    clast_aggregate_result result;
    clast_table history;
} clx_repeat;

/// {0} is empty.
typedef struct clx_repeats {
    int32_t n;
    clx_repeat *item; ///< [n]
} clx_repeats;

void clx_repeats_free(clx_repeats *repeats);

/// Adds a finished aggregate as repeat `index`.
clast_status clx_repeats_add(clx_repeats *repeats, int32_t index, clast_aggregate *aggregate);

/// All ranks' repeats onto rank 0, which must hold one of its own; called by all ranks.
clast_status clx_repeats_gather(const clast_comm *comm, clx_repeats *repeats);

/// Results and histories in the order of repeats, which become empty.
///
/// @param report   must be empty; its confidence stays
/// @param history  must be empty: rows of all repeats one below the other
clast_status clx_repeats_merge(clx_repeats *repeats, clast_aggregate_report *report,
                               clast_table *history);
