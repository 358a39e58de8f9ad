#pragma once
// Names inside a file.
#include "io/h5.h"
#include <stdio.h>
#include <string.h>

/// A folder of a file.
typedef struct clx_place {
    clx_h5 *h5;
    const char *folder;
} clx_place;

/// folder/name into path; false if it does not fit.
static inline bool clx_join(char path[CLX_H5_NAME_LIMIT], const char *folder, const char *name)
{
    const int n = snprintf(path, CLX_H5_NAME_LIMIT, "%s/%s", folder, name);
    return n > 0 && n < CLX_H5_NAME_LIMIT;
}
