#pragma once
// Names in an output folder.
#include <clast/status.h>

enum { CLI_PATH = 4096 };

/// FOLDER/NAME. CLAST_E_DISK when it is longer than a path may be.
clast_status cli_folder_path(char path[CLI_PATH], const char *folder, const char *name);
