// Heap blocks with checked sizes; in test builds counted and refusable.
#include "base/alloc.h"

#include <stdlib.h>
#include <string.h>

#ifdef CLAST_ALLOC_INJECT
#include <stdatomic.h>
static _Atomic int64_t n_live;
static _Atomic int64_t countdown;

int64_t clx_alloc_refuse(int64_t k)
{
    atomic_store(&countdown, k);
    return atomic_load(&n_live);
}

int64_t clx_alloc_live(void)
{
    return atomic_load(&n_live);
}

static bool refused(void)
{
    return atomic_load(&countdown) > 0 && atomic_fetch_sub(&countdown, 1) == 1;
}
#define COUNT(change) ((void)atomic_fetch_add(&n_live, (change)))
#else
static bool refused(void)
{
    return false;
}
#define COUNT(change) ((void)0)
#endif

static bool bytes_of(int64_t n, size_t size, size_t *bytes)
{
    const size_t limit = (size_t)CLX_ALLOC_LIMIT_GIB << 30;
    if (n < 0 || (size != 0 && (uint64_t)n > limit / size)) {
        return false;
    }
    *bytes = (size_t)n * size;
    if (*bytes == 0) {
        *bytes = 1;
    }
    return true;
}

static clast_status fail(int64_t n, size_t size)
{
    return clx_fail(CLAST_E_MEMORY, "no memory for %lld items of %zu bytes", (long long)n, size);
}

clast_status clx_alloc(void *block, int64_t n, size_t size)
{
    void *got = NULL;
    size_t bytes = 0;
    memcpy(block, &got, sizeof got);
    if (!bytes_of(n, size, &bytes) || refused()) {
        return fail(n, size);
    }
    got = calloc(1, bytes);
    if (got == NULL) {
        return fail(n, size);
    }
    COUNT(1);
    memcpy(block, &got, sizeof got);
    return CLAST_OK;
}

clast_status clx_realloc(void *block, int64_t n, size_t size)
{
    void *old = NULL;
    size_t bytes = 0;
    memcpy(&old, block, sizeof old);
    if (!bytes_of(n, size, &bytes) || refused()) {
        return fail(n, size);
    }
    void *got = realloc(old, bytes);
    if (got == NULL) {
        return fail(n, size);
    }
    if (old == NULL) {
        COUNT(1);
    }
    memcpy(block, &got, sizeof got);
    return CLAST_OK;
}

clast_status clx_alloc_text(char **copy, const char *text)
{
    const size_t n = strlen(text) + 1;
    const clast_status status = clx_alloc(copy, (int64_t)n, 1);
    if (status == CLAST_OK) {
        memcpy(*copy, text, n);
    }
    return status;
}

clast_status clx_grow(void *block, int64_t *capacity, int64_t need, size_t size)
{
    if (need <= *capacity) {
        return CLAST_OK;
    }
    int64_t next = *capacity + *capacity / 2;
    if (next < need) {
        next = need;
    }
    if (next < 16) {
        next = 16;
    }
    const clast_status status = clx_realloc(block, next, size);
    if (status == CLAST_OK) {
        *capacity = next;
    }
    return status;
}

void clx_free(void *block)
{
    if (block != NULL) {
        COUNT(-1);
        free(block);
    }
}
