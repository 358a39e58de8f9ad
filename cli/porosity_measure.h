#pragma once
// One bed, and what clast porosity measures of it.
#include "porosity_findings.h"

/// A run that is measured.
typedef struct cli_porosity_bed {
    clast_assembly assembly;
    clast_bed bed, own;              ///< what is measured: the run's own, or given
    clast_mesh surface, own_surface; ///< of each, or empty
    clast_table contacts;            ///< forces, without columns where the run does not know them
    clast_table velocities;          ///< likewise
    clast_packing_report report;     ///< of another program's file
    bool has_own;                    ///< else `own` is nothing
} cli_porosity_bed;

/// What is asked for; lengths in the bed's unit, 0: not.
typedef struct cli_porosity_wanted {
    clast_porosity_options options;
    bool is_given; ///< the bed, which need not be what holds the grains
    double gap;    ///< grains this close touch
    double core;   ///< grain sizes from the side walls
    bool local;
    int32_t rings; ///< of radial porosity
    int64_t pores; ///< points
    double fields; ///< width of their kernel
    bool chains;
} cli_porosity_wanted;

void cli_porosity_bed_free(cli_porosity_bed *s);

/// Of the sphere of the grains' mean volume; 1 without grains.
double cli_porosity_mean_diameter(const clast_assembly *assembly);

/// Wraps the grains of a periodic bed into it, then measures. CLAST_E_GEOMETRY for a bed that holds
/// more solid than room, or a given one that is not what holds the grains; with pores it may be a
/// part of that.
clast_status cli_porosity_measure(cli_porosity_bed *s, const cli_porosity_wanted *wanted,
                                  cli_porosity_findings *f);
