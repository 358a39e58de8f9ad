#include "base/path.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

clast_status clx_path_join(char path[CLX_PATH_LIMIT], const char *folder, const char *name)
{
    const int n = snprintf(path, CLX_PATH_LIMIT, "%s/%s", folder, name);
    return n > 0 && n < CLX_PATH_LIMIT
               ? CLAST_OK
               : clx_fail(CLAST_E_DISK, "the path %.60s... is longer than %d bytes", folder,
                          CLX_PATH_LIMIT);
}

const char *clx_path_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

const char *clx_path_extension(const char *path)
{
    const char *name = clx_path_name(path);
    const char *dot = strrchr(name, '.');
    return dot != NULL && dot != name ? dot + 1 : name + strlen(name);
}

bool clx_path_is(const char *path, const char *extension)
{
    return strcasecmp(clx_path_extension(path), extension) == 0;
}

int clx_path_stem_length(const char *path)
{
    const char *name = clx_path_name(path);
    const char *dot = strrchr(name, '.');
    return dot != NULL && dot != name ? (int)(dot - name) : (int)strlen(name);
}
