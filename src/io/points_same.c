// Whether ranks that read one file of points together read the same one: a machine may have an old
// copy of its own, and lines of two files would make one cloud.
//
// A whole digest would have every rank read the whole file. Compared are its size, and the SHA-256
// of 64 blocks of 64 KiB, evenly over the file: all of a file of up to 4 MiB. Copies of one table
// at two times differ from the changed row on, or in size.
#include "io/points.h"

#include "base/alloc.h"
#include "base/comm.h"
#include "io/sha256.h"
#include <clast/machine.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum { BLOCK = 1 << 16, N_BLOCK = 64 };

typedef struct {
    int64_t size;
    char hex[65];
} identity;

static clast_status identify(const char *path, identity *own)
{
    clast_status status = CLAST_OK;
    char *block = NULL;
    clx_sha256 sha = clx_sha256_begin();
    FILE *file = fopen(path, "rb");
    CLX_CHECK(file != NULL && fseeko(file, 0, SEEK_END) == 0, CLAST_E_IO, "cannot read %s: %s",
              path, clx_errno_text());
    own->size = (int64_t)ftello(file);
    CLX_TRY(clx_alloc(&block, BLOCK, 1));
    for (int k = 0; k < N_BLOCK; ++k) {
        const int64_t n_left = own->size - (int64_t)N_BLOCK * BLOCK;
        const int64_t at =
            (int64_t)k * BLOCK + (n_left > 0 ? (int64_t)((double)n_left * k / (N_BLOCK - 1)) : 0);
        CLX_CHECK(fseeko(file, (off_t)at, SEEK_SET) == 0, CLAST_E_IO, "cannot read %s: %s", path,
                  clx_errno_text());
        clx_sha256_add(&sha, block, fread(block, 1, BLOCK, file));
    }
    CLX_CHECK(ferror(file) == 0, CLAST_E_IO, "cannot read %s: %s", path, clx_errno_text());
    clx_sha256_end(&sha, own->hex);
done:
    if (file != NULL) {
        (void)fclose(file);
    }
    clx_free(block);
    return status;
}

clast_status clx_points_agree(const clast_comm *comm, const char *path)
{
    clast_status status = CLAST_OK;
    identity own = {0};
    clx_gathered gathered = {0};
    identity first;
    if (comm->n_rank == 1) {
        return CLAST_OK;
    }
    CLX_TRY(clast_comm_agree(comm, identify(path, &own), NULL));
    CLX_TRY(clx_comm_first(comm, &own, (int64_t)sizeof own, &gathered));
    memcpy(&first, gathered.bytes, sizeof first);
    if (own.size != first.size || strcmp(own.hex, first.hex) != 0) {
        status = clx_fail(CLAST_E_FORMAT,
                          "reads another %s than rank 0 (%" PRId64 " bytes, rank 0: %" PRId64
                          "); put it on a disk that all ranks see",
                          path, own.size, first.size);
    }
    CLX_TRY(clast_comm_agree(comm, status, NULL));
done:
    clx_gathered_free(&gathered);
    return status;
}
