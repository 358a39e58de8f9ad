#pragma once
// What clast porosity found in one bed: as JSON, as tables and charts, in words.
#include "command.h"
#include <jansson.h>

json_t *cli_porosity_json(const clast_assembly *assembly, const clast_bed_findings *f);

/// Charts, then the tables that they are drawn from.
clast_status cli_porosity_files(const clast_run_folder *run, const clast_assembly *assembly,
                                clast_bed_findings *f);

/// stdout, as JSON with the profile or in words.
///
/// @param report  of another program's file
clast_status cli_porosity_print(const cli_common *common, const clast_assembly *assembly,
                                const clast_bed_findings *f, const clast_packing_report *report);
