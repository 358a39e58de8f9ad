#include "study/frames.h"

#include "base/alloc.h"
#include "base/file.h"
#include <clast/state.h>
#include <stdio.h>
#include <unistd.h>

static void name_frame(char name[64], int64_t index)
{
    CLAST_ASSERT(index >= 0);
    (void)snprintf(name, 64, "frames/frame-%06lld.vtu", (long long)index);
}

clast_status clx_frame_path(const char *folder, int64_t index, char path[CLX_PATH_LIMIT])
{
    clast_status status = CLAST_OK;
    char name[64];
    CLX_TRY(clx_path_join(path, folder, "frames"));
    CLX_TRY(clx_folder_make(path));
    name_frame(name, index);
    CLX_TRY(clx_path_join(path, folder, name));
done:
    return status;
}

clast_status clx_frames_collect(const char *folder, int64_t first, int64_t n, const double *time,
                                int64_t *n_frame)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char **file = NULL;
    double *found = NULL; // times of frames that are there: none while there was no grain
    int64_t n_found = 0;
    CLX_TRY(clx_alloc(&file, n, sizeof *file));
    CLX_TRY(clx_alloc(&found, n, sizeof *found));
    for (int64_t k = 0; k < n; ++k) {
        char name[64];
        name_frame(name, first + k);
        CLX_TRY(clx_path_join(path, folder, name));
        if (access(path, F_OK) == 0) {
            CLX_TRY(clx_alloc_text(&file[n_found], name));
            found[n_found++] = time[k];
        }
    }
    if (n_found > 0) {
        CLX_TRY(clx_path_join(path, folder, "frames.pvd"));
        CLX_TRY(clast_pvd_write(path, n_found, found, (const char *const *)file));
    }
    *n_frame = n_found;
done:
    for (int64_t k = 0; file != NULL && k < n_found; ++k) {
        clx_free(file[k]);
    }
    CLX_FREE(file, found);
    return status;
}
