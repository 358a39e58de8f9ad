#include "base/path.h"

#include <string.h>
#include <strings.h>

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
