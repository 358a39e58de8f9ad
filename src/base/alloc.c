// Heap blocks with checked sizes, from the system or from a pool of the calling thread; in test
// builds counted and refusable. The pool in use is thread-local, so that no function between the
// caller of a workspace and an allocation needs to know of it.
#ifdef __linux__
// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp): glibc's, for madvise
#define _DEFAULT_SOURCE 1
#endif
#include "base/alloc.h"

#include "base/lines.h"
#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <sys/mman.h>
#endif

#ifdef CLAST_ALLOC_INJECT
#include <stdatomic.h>
static _Atomic int64_t n_live;
static _Atomic int64_t countdown;
static _Atomic int64_t n_taken;

int64_t clx_alloc_refuse(int64_t k)
{
    atomic_store(&countdown, k);
    return atomic_load(&n_live);
}

int64_t clx_alloc_live(void)
{
    return atomic_load(&n_live);
}

int64_t clx_alloc_taken(void)
{
    return atomic_load(&n_taken);
}

static bool refused(void)
{
    return atomic_load(&countdown) > 0 && atomic_fetch_sub(&countdown, 1) == 1;
}
#define COUNT(change) ((void)atomic_fetch_add(&n_live, (change)))
#define COUNT_TAKEN() ((void)atomic_fetch_add(&n_taken, 1))
#else
static bool refused(void)
{
    return false;
}
#define COUNT(change) ((void)0)
#define COUNT_TAKEN() ((void)0)
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

/// A block of a pool; unused ones wait.
typedef struct {
    void *at;
    size_t bytes; ///< a power of two
    bool is_used;
} slot;

struct clx_pool {
    slot *slot;
    int64_t n, capacity;
};

static _Thread_local clx_pool *current;

clx_pool *clx_pool_enter(clx_pool *pool)
{
    clx_pool *before = current;
    current = pool;
    return before;
}

static size_t rounded(size_t bytes)
{
    size_t size = 64;
    while (size < bytes) {
        size *= 2;
    }
    return size;
}

static slot *new_slot(clx_pool *pool)
{
    if (pool->n == pool->capacity) {
        const int64_t capacity = 2 * pool->capacity + 32;
        slot *grown = realloc(pool->slot, (size_t)capacity * sizeof *grown);
        if (grown == NULL) {
            return NULL;
        }
        COUNT_TAKEN();
        pool->slot = grown;
        pool->capacity = capacity;
    }
    return &pool->slot[pool->n];
}

/// A block of at least `bytes`, its contents unset; NULL without memory.
static void *pool_take(clx_pool *pool, size_t bytes)
{
    const size_t size = rounded(bytes);
    for (int64_t k = 0; k < pool->n; ++k) {
        if (!pool->slot[k].is_used && pool->slot[k].bytes == size) {
            pool->slot[k].is_used = true;
            return pool->slot[k].at;
        }
    }
    slot *s = new_slot(pool);
    void *at = s != NULL ? malloc(size) : NULL;
    if (at != NULL) {
        COUNT_TAKEN();
        *s = (slot){at, size, true};
        ++pool->n;
    }
    return at;
}

static slot *pool_find(const clx_pool *pool, const void *at)
{
    for (int64_t k = 0; k < pool->n; ++k) {
        if (pool->slot[k].at == at) {
            return &pool->slot[k];
        }
    }
    return NULL;
}

/// realloc of a block of the pool, NULL for none.
static void *pool_grow(clx_pool *pool, void *old, size_t bytes)
{
    slot *s = old != NULL ? pool_find(pool, old) : NULL;
    if (s != NULL && s->bytes >= bytes) {
        return old;
    }
    const size_t kept = s != NULL ? s->bytes : 0;
    void *got = pool_take(pool, bytes); // may move the slots
    if (got != NULL && old != NULL) {
        memcpy(got, old, kept);
        pool_find(pool, old)->is_used = false;
    }
    return got;
}

clast_status clx_pool_create(clx_pool **pool)
{
    clx_pool *made = NULL;
    const clast_status status = clx_alloc(&made, 1, sizeof *made);
    if (status == CLAST_OK) {
        *pool = made;
    }
    return status;
}

void clx_pool_destroy(clx_pool *pool)
{
    for (int64_t k = 0; pool != NULL && k < pool->n; ++k) {
        COUNT(pool->slot[k].is_used ? -1 : 0);
        free(pool->slot[k].at);
    }
    if (pool != NULL) {
        free(pool->slot);
    }
    clx_free(pool);
}

static void *take(size_t bytes)
{
    if (current != NULL) {
        void *got = pool_take(current, bytes);
        return got != NULL ? memset(got, 0, bytes) : NULL;
    }
    COUNT_TAKEN();
    return calloc(1, bytes);
}

clast_status clx_alloc(void *block, int64_t n, size_t size)
{
    void *got = NULL;
    size_t bytes = 0;
    memcpy(block, &got, sizeof got);
    if (!bytes_of(n, size, &bytes) || refused()) {
        return fail(n, size);
    }
    got = take(bytes);
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
    void *got = current != NULL ? pool_grow(current, old, bytes) : realloc(old, bytes);
    if (got == NULL) {
        return fail(n, size);
    }
    if (current == NULL) {
        COUNT_TAKEN();
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

/// Half as many again, at least `need` and 16.
static int64_t grown(int64_t capacity, int64_t need)
{
    const int64_t next = capacity + capacity / 2;
    const int64_t least = need > 16 ? need : 16;
    return next > least ? next : least;
}

clast_status clx_grow(void *block, int64_t *capacity, int64_t need, size_t size)
{
    if (need <= *capacity) {
        return CLAST_OK;
    }
    const int64_t next = grown(*capacity, need);
    const clast_status status = clx_realloc(block, next, size);
    if (status == CLAST_OK) {
        *capacity = next;
    }
    return status;
}

enum { LINE = 64, LARGE_PAGE = 1 << 21 };

/// A block that begins with a cache line, or with a large page where there are several of them.
static void *take_lines(size_t bytes)
{
    const size_t unit = bytes >= 2 * (size_t)LARGE_PAGE ? LARGE_PAGE : LINE;
    const size_t whole = (bytes + unit - 1) / unit * unit;
    void *got = aligned_alloc(unit, whole);
#ifdef MADV_HUGEPAGE
    if (got != NULL && unit == LARGE_PAGE) {
        (void)madvise(got, whole, MADV_HUGEPAGE); // an advice: speed only
    }
#endif
    return got;
}

clast_status clx_grow_lines(void *block, int64_t *capacity, int64_t need, size_t size)
{
    void *old = NULL;
    size_t bytes = 0;
    if (need <= *capacity) {
        return CLAST_OK;
    }
    if (current != NULL) { // blocks of a pool are the pool's
        return clx_grow(block, capacity, need, size);
    }
    const int64_t next = grown(*capacity, need);
    memcpy(&old, block, sizeof old);
    if (!bytes_of(next, size, &bytes) || refused()) {
        return fail(next, size);
    }
    void *got = take_lines(bytes);
    if (got == NULL) {
        return fail(next, size);
    }
    COUNT(1);
    COUNT_TAKEN();
    if (old != NULL) {
        memcpy(got, old, (size_t)*capacity * size);
        clx_free(old);
    }
    memcpy(block, &got, sizeof got);
    *capacity = next;
    return CLAST_OK;
}

void clx_free(void *block)
{
    if (block != NULL) {
        slot *s = current != NULL ? pool_find(current, block) : NULL;
        COUNT(-1);
        if (s != NULL) {
            s->is_used = false;
        } else {
            free(block);
        }
    }
}
