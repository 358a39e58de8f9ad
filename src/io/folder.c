// Lists a folder in an order that does not depend on the disk.
#include "io/folder.h"

#include "base/alloc.h"
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { LIMIT = 65536 };

static int by_bytes(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

void clx_folder_free(clx_folder *folder)
{
    for (int32_t i = 0; i < folder->n; ++i) {
        clx_free(folder->name[i]);
    }
    clx_free(folder->name);
    *folder = (clx_folder){0};
}

clast_status clx_folder_list(const char *path, clx_folder *folder)
{
    clast_status status = CLAST_OK;
    clx_folder made = {0};
    int64_t capacity = 0;
    DIR *open = opendir(path);
    CLX_CHECK(open != NULL, CLAST_E_IO, "cannot read the folder %s: %s", path, clx_errno_text());
    // NOLINTNEXTLINE(concurrency-mt-unsafe): one stream, used by this thread alone
    for (struct dirent *entry = readdir(open); entry != NULL; entry = readdir(open)) {
        if (entry->d_name[0] == '.') {
            continue;
        }
        CLX_CHECK(made.n < LIMIT, CLAST_E_LIMIT, "%s holds more than %d files", path, LIMIT);
        CLX_TRY(clx_grow(&made.name, &capacity, made.n + 1, sizeof *made.name));
        CLX_TRY(clx_alloc_text(&made.name[made.n], entry->d_name));
        ++made.n;
    }
    if (made.n > 0) {
        qsort(made.name, (size_t)made.n, sizeof *made.name, by_bytes);
    }
    *folder = made;
    made = (clx_folder){0};
done:
    if (open != NULL) {
        (void)closedir(open);
    }
    clx_folder_free(&made);
    return status;
}
