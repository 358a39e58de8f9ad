#pragma once
// Tables, files for ParaView and charts of a decomposition.
#include <clast/clast.h>

/// What a decomposition is of and found.
typedef struct cli_decompose_job {
    const clast_domain *domain;
    const clast_cloud *cloud;
    const clast_decomposition *result;
    const int32_t *of_point; ///< [n_point] cell of every point, of all ranks
    int64_t n_point;
    bool is_part;             ///< the cloud is a rank's part of all
    const clast_table *sizes; ///< without columns unless asked for
    const char *name;         ///< of the domain, in m
    const char *chart_end;    ///< "svg"
    double pairs_radius;      ///< greatest distance of pairs that was asked for [m]; 0: none
    bool has_drawn;           ///< the seed mattered
    bool tests_alone;         ///< no cells and no events were asked for
} cli_decompose_job;

enum { CLI_DECOMPOSE_NOTE = 1024 };

/// What the numbers depend on, a line: domain, volume, beta dt, seed.
void cli_decompose_note(const cli_decompose_job *job, char note[CLI_DECOMPOSE_NOTE]);

/// cells.csv, point_cells.csv, thresholds.csv, cells.vtu; of a whole cloud points.vtp and charts
/// too.
clast_status cli_decompose_files(const cli_decompose_job *job, const char *folder);
