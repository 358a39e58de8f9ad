#pragma once
// What lies in a folder.
#include "base/status.h"

typedef struct clx_folder {
    int32_t n;
    char **name; ///< [n] of the entries, sorted by bytes; hidden ones left out
} clx_folder;

/// @return CLAST_E_IO if it cannot be read, CLAST_E_LIMIT beyond 65,536 entries
CLX_SHARED clast_status clx_folder_list(const char *path, clx_folder *folder);
CLX_SHARED void clx_folder_free(clx_folder *folder);
