#pragma once
// What clast porosity found in one bed: as JSON, as tables and charts, in words.
#include "command.h"
#include <jansson.h>

/// Everything that is measured.
typedef struct cli_porosity_findings {
    clast_table profile;
    clast_table coordination; ///< without columns where contacts are not known
    clast_table fabric;       ///< directions of contacts and grains
    clast_table local;        ///< without columns unless asked for, as the next
    clast_table radial;
    clast_pores pores;
    clast_table stress; ///< without columns where forces are not known, as the next
    clast_table stress_profile;
    clast_table fields; ///< without columns unless asked for, as the next
    clast_table chains;
    clast_porosity_bulk bulk;
    clast_bed_walls walls;
    clast_bed_beyond beyond;  ///< n -1: not looked for, or there are no side walls
    bool is_part;             ///< the bed is a part of the packing: what is beyond does not count
    double outside;           ///< share of a given bed outside the run's own; NAN: there is none
    clast_porosity_core core; ///< where asked for
    double mean_coordination; ///< NAN where contacts are not known
    bool knows_contacts;      ///< the run does, with their forces
    clast_overlaps overlaps;
    clast_porosity_method method;
    double cut;                  ///< the bed ends where its porosity rises through this
    double core_depth;           ///< asked for, in grain sizes, or 0
    clast_packing_report report; ///< of another program's file
} cli_porosity_findings;

void cli_porosity_free(cli_porosity_findings *f);

json_t *cli_porosity_json(const clast_assembly *assembly, const cli_porosity_findings *f);

/// Charts, then the tables that they are drawn from.
clast_status cli_porosity_files(const clast_run_folder *run, const clast_assembly *assembly,
                                cli_porosity_findings *f);

/// stdout, as JSON with the profile or in words.
clast_status cli_porosity_print(const cli_common *common, const clast_assembly *assembly,
                                const clast_bed *bed, const cli_porosity_findings *f);
