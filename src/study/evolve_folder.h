#pragma once
// Files of an evolution's run folder.
#include "base/path.h"
#include <clast/evolve.h>

/// Everything that a finished run leaves: tables, states of the largest aggregates, charts,
/// summary.json; checkpoints go last. Sets result->n_written.
clast_status clx_evolve_write_results(const char *folder, const char *config,
                                      const clast_evolve_config *physics,
                                      const clast_domain *domain, const clast_evolve *evolve,
                                      clast_evolve_result *result);

/// deposit.h5: the bodies on the floor (not those on sides or a ceiling), one rigid grain each, by
/// the time when they came, in a column about z of this width, or as wide as the widest of them,
/// each above the place where it came down and free of those before: what clast pack --start
/// settles. Not written where nothing lies on the floor. Sets result->bed_width, bed_height,
/// bed_mass and bed_least.
clast_status clx_evolve_write_bed(const char *folder, double width, const clast_domain *domain,
                                  const clast_evolve *evolve, clast_evolve_result *result);

/// The state now as a checkpoint.
clast_status clx_evolve_write_checkpoint(const char *folder, const char *config, int64_t step,
                                         const clast_evolve *evolve);

/// Frame of a row for ParaView: surfaces of up to 5000 grains, else points.
clast_status clx_evolve_write_frame(const char *folder, int32_t row, const clast_evolve *evolve);

/// frames.pvd of the frames that are there, at the times of their rows.
clast_status clx_evolve_write_collection(const char *folder, const clast_evolve *evolve,
                                         int32_t *n_frame);

/// evolution.svg, spectrum.svg and deposit.svg.
clast_status clx_evolve_draw(const char *folder, const clast_evolve *evolve);
