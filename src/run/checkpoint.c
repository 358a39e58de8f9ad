// Checkpoints: each a new file, written whole or not at all; the older ones go only afterwards, so
// that a good one is always there.
#include "run/checkpoint.h"

#include "base/alloc.h"
#include "base/comm.h"
#include "base/file.h"
#include "base/path.h"
#include "io/h5_trailer.h"
#include <clast/machine.h>
#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define NAME_FORMAT "checkpoint-%012" PRId64 ".h5"
#define STEP_LIMIT  INT64_C(1000000000000)
enum { NAME_SIZE = 32 };

typedef struct {
    int64_t n;
    int64_t capacity;
    int64_t *step; ///< [n] falling
} listing;

static bool parse_name(const char *name, int64_t *step)
{
    char again[NAME_SIZE];
    if (strncmp(name, "checkpoint-", 11) != 0) {
        return false;
    }
    *step = strtoll(name + 11, NULL, 10);
    (void)snprintf(again, sizeof again, NAME_FORMAT, *step);
    return *step >= 0 && *step < STEP_LIMIT && strcmp(name, again) == 0;
}

static int falling(const void *a, const void *b)
{
    const int64_t x = *(const int64_t *)a;
    const int64_t y = *(const int64_t *)b;
    return x < y ? 1 : x > y ? -1 : 0;
}

static clast_status list_steps(const char *folder, listing *list)
{
    clast_status status = CLAST_OK;
    DIR *open = opendir(folder);
    CLX_CHECK(open != NULL, CLAST_E_IO, "cannot read folder %s: %s", folder, clx_errno_text());
    // NOLINTNEXTLINE(concurrency-mt-unsafe): a stream of our own is safe in POSIX 2024 and in glibc
    for (const struct dirent *entry = readdir(open); entry != NULL; entry = readdir(open)) {
        int64_t step = 0;
        if (parse_name(entry->d_name, &step)) {
            CLX_TRY(clx_grow(&list->step, &list->capacity, list->n + 1, sizeof *list->step));
            list->step[list->n++] = step;
        }
    }
    if (list->n > 1) {
        qsort(list->step, (size_t)list->n, sizeof *list->step, falling);
    }
done:
    if (open != NULL) {
        (void)closedir(open);
    }
    return status;
}

static clast_status path_of(const char *folder, int64_t step, char **path)
{
    CLAST_ASSERT(step >= 0);
    const size_t size = strlen(folder) + 1 + NAME_SIZE;
    const clast_status status = clx_alloc(path, (int64_t)size, 1);
    if (status == CLAST_OK) {
        (void)snprintf(*path, size, "%s/" NAME_FORMAT, folder, step);
    }
    return status;
}

/// Removes the checkpoints after the first `keep` newest.
static clast_status prune(const char *folder, int64_t keep)
{
    CLAST_ASSERT(keep >= 0);
    clast_status status = CLAST_OK;
    listing list = {0};
    char *path = NULL;
    CLX_TRY(list_steps(folder, &list));
    for (int64_t i = keep; i < list.n; ++i) {
        CLX_TRY(path_of(folder, list.step[i], &path));
        CLX_CHECK(unlink(path) == 0 || errno == ENOENT, CLAST_E_DISK, "cannot remove %s: %s", path,
                  clx_errno_text());
        clx_free(path);
        path = NULL;
    }
done:
    CLX_FREE(path, list.step);
    return status;
}

clast_status clx_checkpoint_write(clx_h5 *h5, const char *folder, int64_t step)
{
    clast_status status = CLAST_OK;
    char *path = NULL;
    CLX_CHECK(step >= 0 && step < STEP_LIMIT, CLAST_E_USAGE, "checkpoint of step %" PRId64, step);
    CLX_TRY(clx_folder_make(folder));
    CLX_TRY(path_of(folder, step, &path));
    CLX_TRY(clx_h5_commit(h5, path));
    CLX_TRY(prune(folder, CLX_CHECKPOINT_KEEP));
done:
    clx_free(path);
    return status;
}

clast_status clx_checkpoint_newest(const char *folder, char **path, int64_t *step,
                                   int32_t *n_damaged)
{
    clast_status status = CLAST_OK;
    listing list = {0};
    char *found = NULL;
    if (n_damaged != NULL) {
        *n_damaged = 0;
    }
    CLX_TRY(list_steps(folder, &list));
    CLX_CHECK(list.n > 0, CLAST_E_IO, "%s holds no checkpoint (a run that has ended keeps none)",
              folder);
    for (int64_t i = 0; i < list.n; ++i) {
        CLX_TRY(path_of(folder, list.step[i], &found));
        status = clx_h5_verify(found);
        if (status == CLAST_OK) {
            *path = found;
            found = NULL;
            *step = list.step[i];
            goto done;
        }
        if (n_damaged != NULL) {
            ++*n_damaged;
        }
        if (status == CLAST_E_MEMORY) {
            goto done;
        }
        clx_free(found);
        found = NULL;
    }
    status =
        clx_fail(CLAST_E_IO, "%s holds %" PRId64 " checkpoints, all damaged: begin the run anew",
                 folder, list.n);
done:
    CLX_FREE(found, list.step);
    return status;
}

bool clx_checkpoint_exists(const char *folder)
{
    listing list = {0};
    const bool found = list_steps(folder, &list) == CLAST_OK && list.n > 0;
    clx_free(list.step);
    return found;
}

clast_status clx_checkpoint_clear(const char *folder)
{
    return prune(folder, 0);
}

/// A checkpoint's name and last line, which has the sum and the number of its bytes.
static clast_status describe_checkpoint(const char *path, char text[CLX_PATH_LIMIT])
{
    clast_status status = CLAST_OK;
    char line[CLX_H5_TRAILER_SIZE + 1] = "";
    FILE *file = fopen(path, "rb");
    CLX_CHECK(file != NULL && fseeko(file, -(off_t)CLX_H5_TRAILER_SIZE, SEEK_END) == 0 &&
                  fread(line, 1, CLX_H5_TRAILER_SIZE, file) == CLX_H5_TRAILER_SIZE,
              CLAST_E_IO, "cannot read %s: %s", path, clx_errno_text());
    (void)snprintf(text, CLX_PATH_LIMIT, "%s %s", clx_path_name(path), line);
done:
    if (file != NULL) {
        (void)fclose(file);
    }
    return status;
}

clast_status clx_checkpoint_agree(const clast_comm *comm, const char *path)
{
    clast_status status = CLAST_OK;
    char text[CLX_PATH_LIMIT] = "";
    clx_gathered first = {0};
    if (comm->n_rank == 1) {
        return CLAST_OK;
    }
    CLX_TRY(clast_comm_agree(comm, describe_checkpoint(path, text), NULL));
    CLX_TRY(clx_comm_first(comm, text, (int64_t)sizeof text, &first));
    if (strcmp(text, first.bytes) != 0) {
        status = clx_fail(CLAST_E_FORMAT,
                          "finds %s where rank 0 goes on from another checkpoint (%.*s); put the "
                          "run's folder on a disk that all ranks see",
                          path, (int)strcspn(first.bytes, " "), first.bytes);
    }
    CLX_TRY(clast_comm_agree(comm, status, NULL));
done:
    clx_gathered_free(&first);
    return status;
}
