// Names in an output folder.
#include "folder.h"

#include "command.h"

#include <stdio.h>

clast_status cli_folder_path(char path[CLI_PATH], const char *folder, const char *name)
{
    const int n = snprintf(path, CLI_PATH, "%s/%s", folder, name);
    return n > 0 && n < CLI_PATH ? CLAST_OK
                                 : cli_fail(CLAST_E_DISK, "%s: the path is too long", folder);
}
