// The memory that a command may take: --max-memory, or a share of the machine's.
#include "command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double share = 0.8; // the rest is the system's and that of others

/// The limit that a container's or a batch system's control group sets, or `bytes`.
static double group_memory(double bytes)
{
    static const char *const path[] = {"/sys/fs/cgroup/memory.max",
                                       "/sys/fs/cgroup/memory/memory.limit_in_bytes"};
    for (int k = 0; k < 2; ++k) {
        char text[64] = "";
        FILE *const file = fopen(path[k], "r");
        if (file == NULL) {
            continue;
        }
        const double most =
            fgets(text, sizeof text, file) != NULL ? strtod(text, NULL) : 0.0; // "max": 0
        (void)fclose(file);
        if (most > 0.0 && most < bytes) {
            bytes = most;
        }
    }
    return bytes;
}

static double machine_memory(void)
{
    return group_memory((double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE));
}

/// Bytes of a text: 8GB, 50%, 0 for no limit.
static clast_status parse(const char *text, double *bytes)
{
    const size_t n = strlen(text);
    double part = 0.0;
    if (n == 0 || text[n - 1] != '%') {
        return clast_unit_parse_asked(text, "B", bytes);
    }
    const clast_status status = clast_unit_parse(text, "-", &part);
    *bytes = part * machine_memory();
    return status;
}

clast_status cli_memory_limit(const char *text)
{
    double bytes = share * machine_memory();
    const clast_status status = text != NULL ? parse(text, &bytes) : CLAST_OK;
    if (status != CLAST_OK) {
        return cli_fail(status, "--max-memory: %s", clast_error_detail());
    }
    if (!(bytes >= 0.0 && bytes < 0x1p62)) {
        return cli_fail(CLAST_E_USAGE, "--max-memory takes a size such as 8GB or 50%%, not '%s'",
                        text != NULL ? text : "");
    }
    return clast_memory_set_limit((int64_t)bytes);
}
