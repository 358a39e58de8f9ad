#pragma once
// The grains of all beds of a study, from its folder.
#include "command.h"

/// True when the path is a folder.
bool cli_is_folder(const char *path);

/// Reads runs/NNNNNN/out/grains.csv of every run named in the column `group` of `beds` into one
/// table: that column, flatness and elongation.
clast_status cli_study_grains(const char *folder, const clast_table *beds, const char *group,
                              clast_table *grains);
