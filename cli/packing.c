// Which of a file's snapshots was read.
#include "packing.h"

#include "json.h"
#include <stdio.h>

void cli_packing_note(const cli_common *common, const char *path,
                      const clast_packing_report *report)
{
    char step[48] = "";
    if (report->n_snapshot <= 1 || common->comm->rank > 0) {
        return;
    }
    if (report->frame.step >= 0) {
        (void)snprintf(step, sizeof step, ", TIMESTEP %lld", (long long)report->frame.step);
    }
    (void)fprintf(stderr, "clast %s: %s: snapshot %lld of %lld%s\n", common->command,
                  cli_name(path), (long long)report->snapshot, (long long)report->n_snapshot, step);
}

void cli_packing_json(json_t *object, const clast_packing_report *report)
{
    if (report->n_snapshot <= 1) {
        return;
    }
    cli_json_count(object, "snapshot", report->snapshot);
    cli_json_count(object, "n_snapshot", report->n_snapshot);
    if (report->frame.step >= 0) {
        cli_json_count(object, "step", report->frame.step);
    }
}
