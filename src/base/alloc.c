// Heap blocks with checked sizes, from the system or from a pool of the calling thread; in test
// builds counted and refusable. The pool in use is thread-local, so that no function between the
// caller of a workspace and an allocation needs to know of it.
#ifdef __linux__
// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp): glibc's, for madvise
#define _DEFAULT_SOURCE 1
#endif
#include "base/alloc.h"

#include <clast/machine.h>

#include "base/lines.h"
#include "base/number.h"
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <sys/mman.h>
#endif
#ifdef __APPLE__
#include <malloc/malloc.h>
#define malloc_usable_size malloc_size
#else
#include <malloc.h>
#endif

#ifdef CLAST_ALLOC_INJECT
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

static _Atomic int64_t n_byte; ///< of all blocks
static _Atomic int64_t most;   ///< they may have; 0: any

clast_status clast_memory_set_limit(int64_t bytes)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(bytes >= 0, CLAST_E_ARGUMENT, "clast_memory_set_limit: %lld bytes are less than none",
              (long long)bytes);
    atomic_store(&most, bytes);
done:
    return status;
}

int64_t clast_memory_limit(void)
{
    return atomic_load(&most);
}

int64_t clast_memory_taken(void)
{
    const int64_t n = atomic_load_explicit(&n_byte, memory_order_relaxed);
    return n > 0 ? n : 0; // blocks of callers may go that never came
}

/// Notes that a block came (sign 1) or goes (-1).
static void count_bytes(void *block, int sign)
{
    const int64_t n = block != NULL ? (int64_t)malloc_usable_size(block) : 0;
    (void)atomic_fetch_add_explicit(&n_byte, sign * n, memory_order_relaxed);
}

/// Whether so many bytes more stay below the limit.
static bool fits(size_t bytes)
{
    const int64_t limit = atomic_load_explicit(&most, memory_order_relaxed);
    return limit == 0 || (int64_t)bytes <= limit - clast_memory_taken();
}

static bool bytes_of(int64_t n, size_t size, size_t *bytes)
{
    const uint64_t large = (uint64_t)CLX_ALLOC_LIMIT_GIB << 30;
    const uint64_t limit = large < SIZE_MAX / 2 ? large : SIZE_MAX / 2;
    if (n < 0 || (size != 0 && (uint64_t)n > limit / size)) {
        return false;
    }
    *bytes = (size_t)n * size;
    if (*bytes == 0) {
        *bytes = 1;
    }
    return true;
}

enum { SIZE_WORD = 24 };

/// "4.2 GB"
static const char *size_word(double bytes, char word[SIZE_WORD])
{
    static const char *const unit[] = {"B", "kB", "MB", "GB", "TB"};
    int k = 0;
    while (bytes >= 999.5 && k < 4) {
        bytes *= 1e-3;
        ++k;
    }
    (void)clx_number_print(word, SIZE_WORD, "%.3g %s", bytes, unit[k]);
    return word;
}

static clast_status fail(int64_t n, size_t size)
{
    size_t bytes = 0;
    char word[3][SIZE_WORD];
    if (bytes_of(n, size, &bytes) && !fits(bytes)) {
        return clx_fail(
            CLAST_E_MEMORY, "%s of memory more are wanted, %s are taken, the limit is %s",
            size_word((double)bytes, word[0]), size_word((double)clast_memory_taken(), word[1]),
            size_word((double)clast_memory_limit(), word[2]));
    }
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
    CLAST_ASSERT(pool->n <= pool->capacity && bytes > 0);
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
        count_bytes(at, 1);
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
    CLAST_ASSERT(old == NULL || (s != NULL && s->is_used));
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
        count_bytes(pool->slot[k].at, -1);
        free(pool->slot[k].at);
    }
    if (pool != NULL) {
        free(pool->slot);
    }
    clx_free(pool);
}

static void *allocate_bytes(size_t bytes)
{
    if (current != NULL) {
        void *got = pool_take(current, bytes);
        return got != NULL ? memset(got, 0, bytes) : NULL;
    }
    COUNT_TAKEN();
    void *got = calloc(1, bytes);
    count_bytes(got, 1);
    return got;
}

/// The size in bytes of n items, if it may be taken.
static bool may_take(int64_t n, size_t size, size_t *bytes)
{
    return bytes_of(n, size, bytes) && fits(*bytes) && !refused();
}

/// realloc of a block of the system, counted.
static void *move_block(void *old, size_t bytes)
{
    count_bytes(old, -1);
    void *got = realloc(old, bytes);
    count_bytes(got != NULL ? got : old, 1);
    return got;
}

clast_status clx_alloc(void *block, int64_t n, size_t size)
{
    void *got = NULL;
    size_t bytes = 0;
    memcpy(block, &got, sizeof got);
    if (!may_take(n, size, &bytes)) {
        return fail(n, size);
    }
    got = allocate_bytes(bytes);
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
    if (!may_take(n, size, &bytes)) {
        return fail(n, size);
    }
    void *got = current != NULL ? pool_grow(current, old, bytes) : move_block(old, bytes);
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
    CLAST_ASSERT(*capacity >= 0 && size > 0);
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
static void *allocate_lines(size_t bytes)
{
    const size_t unit = bytes >= 2 * (size_t)LARGE_PAGE ? LARGE_PAGE : LINE;
    const size_t whole = (bytes + unit - 1) / unit * unit;
    void *got = aligned_alloc(unit, whole);
    count_bytes(got, 1);
#ifdef MADV_HUGEPAGE
    if (got != NULL && unit == LARGE_PAGE) {
        (void)madvise(got, whole, MADV_HUGEPAGE); // an advice: speed only
    }
#endif
    return got;
}

clast_status clx_grow_lines(void *block, int64_t *capacity, int64_t need, size_t size)
{
    CLAST_ASSERT(*capacity >= 0 && size > 0);
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
    if (!may_take(next, size, &bytes)) {
        return fail(next, size);
    }
    void *got = allocate_lines(bytes);
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
            count_bytes(block, -1);
            free(block);
        }
    }
}

void clx_free_blocks(size_t n, void *const block[])
{
    for (size_t k = 0; k < n; ++k) {
        clx_free(block[k]);
    }
}
