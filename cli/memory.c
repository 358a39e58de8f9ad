// The memory that a command may take: --max-memory, or a share of the machine's; its ranks on one
// machine share it.
#include "command.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double share = 0.8; // the rest is the system's and that of others

enum { PATH = 4096, WORDS = 8 }; // WORDS: of a machine's name

/// The least of `bytes` and the limit in a control group's file, where it is there and sets one.
static double file_limit(const char *path, double bytes)
{
    char text[64] = "";
    FILE *const file = fopen(path, "r");
    if (file == NULL) {
        return bytes;
    }
    const double most =
        fgets(text, sizeof text, file) != NULL ? strtod(text, NULL) : 0.0; // "max": 0
    (void)fclose(file);
    return most > 0.0 && most < bytes ? most : bytes;
}

/// The same of a group and all above it, whose limits hold for it too. In a container the path may
/// be that of another view of the tree: what is not there passes.
static double group_limit(const char *root, char *group, const char *name, double bytes)
{
    char path[PATH];
    for (;;) {
        if (snprintf(path, sizeof path, "%s%s/%s", root, group, name) < (int)sizeof path) {
            bytes = file_limit(path, bytes);
        }
        char *slash = strrchr(group, '/');
        if (slash == NULL) {
            return bytes;
        }
        *slash = '\0';
    }
}

/// The limit that a container, or a batch system by the job's control group, sets; or `bytes`.
static double group_memory(double bytes)
{
    char line[PATH] = "";
    FILE *const file = fopen("/proc/self/cgroup", "r");
    bytes = group_limit("/sys/fs/cgroup", line, "memory.max", bytes);
    bytes = group_limit("/sys/fs/cgroup/memory", line, "memory.limit_in_bytes", bytes);
    while (file != NULL && fgets(line, sizeof line, file) != NULL) { // "0::/job", "5:memory:/job"
        char *const kind = strchr(line, ':');
        char *const group = kind != NULL ? strchr(kind + 1, ':') : NULL;
        if (group == NULL) {
            continue;
        }
        group[strcspn(group, "\n")] = '\0';
        *group = '\0';
        if (kind[1] == '\0') {
            bytes = group_limit("/sys/fs/cgroup", group + 1, "memory.max", bytes);
        } else if (strstr(kind, "memory") != NULL) {
            bytes = group_limit("/sys/fs/cgroup/memory", group + 1, "memory.limit_in_bytes", bytes);
        }
    }
    if (file != NULL) {
        (void)fclose(file);
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

/// Ranks on this machine, by its name. Called by all ranks.
static clast_status count_ranks(const cli_common *common, int32_t *n)
{
    const clast_comm *comm = common->comm;
    clast_status status = CLAST_OK;
    int64_t(*name)[WORDS] = NULL;
    *n = 1;
    if (comm->n_rank == 1 || comm->sum == NULL) {
        return CLAST_OK;
    }
    name = calloc((size_t)comm->n_rank, sizeof *name);
    status = cli_agree(common, name != NULL ? CLAST_OK : CLAST_E_MEMORY);
    if (name == NULL || status != CLAST_OK) { // without a name it is not, on any rank
        goto done;
    }
    (void)gethostname((char *)name[comm->rank], sizeof *name - 1);
    comm->sum(comm->context, name[0], (int64_t)comm->n_rank * WORDS); // the others' are 0 here
    for (int32_t k = 0; k < comm->n_rank; ++k) {
        *n += k != comm->rank && memcmp(name[k], name[comm->rank], sizeof *name) == 0;
    }
done:
    free(name);
    return status;
}

clast_status cli_memory_limit(const cli_common *common)
{
    const char *text = common->max_memory;
    int32_t n_rank = 1;
    CLI_GUARD(count_ranks(common, &n_rank));
    double bytes = share * machine_memory();
    const clast_status status = text != NULL ? parse(text, &bytes) : CLAST_OK;
    if (status != CLAST_OK) {
        return cli_fail(status, "--max-memory: %s", clast_error_detail());
    }
    if (!(bytes >= 0.0 && bytes < 0x1p62)) {
        return cli_fail(CLAST_E_USAGE, "--max-memory takes a size such as 8GB or 50%%, not '%s'",
                        text != NULL ? text : "");
    }
    return clast_memory_set_limit((int64_t)ceil(bytes / n_rank));
}
