#pragma once
// The parts of a file's path, as text.
#include "base/status.h"
#include <stdbool.h>

enum { CLX_PATH_LIMIT = 4096 };

/// FOLDER/NAME. CLAST_E_DISK when it is longer than a path may be.
CLX_SHARED clast_status clx_path_join(char path[CLX_PATH_LIMIT], const char *folder,
                                      const char *name);

/// The part behind the last slash.
const char *clx_path_name(const char *path);

/// What follows the name's last dot; "" without one, and for a name such as ".profile".
const char *clx_path_extension(const char *path);

/// Whether the extension is this one, upper or lower case.
CLX_SHARED bool clx_path_is(const char *path, const char *extension);

/// Length of the name without dot and extension.
int clx_path_stem_length(const char *path);
