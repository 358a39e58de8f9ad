#pragma once
// What the mesh commands say about a surface, shared by them.
#include "command.h"
#include "json.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>

/// Everything of a check as a JSON object (DESIGN section 7); `unit` as the file says it, ""
/// without.
json_t *cli_check_json(const char *file, const char *unit, const clast_mesh_check_result *result);

/// The same in words on stdout.
void cli_check_words(const char *file, const char *unit, const clast_mesh_check_result *result);

/// Refuses a missing or unknown output name before any work is done.
clast_status cli_mesh_output(const cli_common *common);

/// Reads the first argument; the reader's warnings go to stderr. `report` may be NULL.
clast_status cli_mesh_input(const cli_common *common, clast_mesh *mesh,
                            clast_mesh_read_report *report);

/// The same, then the weld that every command applies to a surface; what it joined goes to stderr.
clast_status cli_mesh_welded(const cli_common *common, clast_mesh *mesh,
                             clast_mesh_read_report *report);

/// Writes a surface in the unit of the one that was read, under the name of the output.
clast_status cli_mesh_save(const cli_common *common, const clast_mesh *mesh,
                           const clast_mesh_read_report *read);

/// Volume of the surface that a hull was taken of; NaN, and why, where it has none.
clast_status cli_solid_volume(const clast_mesh *mesh, double *volume, const char **why);

/// Says on stdout what the hull adds to it.
void cli_hull_words(const clast_mesh *mesh, double hull_volume, double volume, const char *why);

/// "lengths in mm", or "model units" of a surface that names no unit.
void cli_mesh_unit(const char *unit, char words[32]);

/// An option's length as typed, in the unit of a surface (clast_unit_parse_length), 0 to 1e12.
clast_status cli_mesh_length(const char *name, const char *text, const char *unit, double *value);

/// Whether its volume counts a region twice, or may, or a sheet is in it
/// (clast_mesh_check_doubles).
bool cli_counts_twice(const clast_mesh_check_result *found);

/// Says so on stderr, and what to run; `effect` (", so shares of it come out low") may be "".
void cli_note_doubles(const cli_common *common, const clast_mesh_check_result *found,
                      const char *effect);

/// What a command answers that could not use a surface: when it is no solid, that, and the command
/// that closes it; else the command's own status and message.
clast_status cli_mesh_refused(const char *path, const clast_mesh *mesh, const char *otherwise,
                              clast_status status);
