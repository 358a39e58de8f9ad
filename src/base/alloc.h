#pragma once
// All heap use of the library goes through here, so that tests can count live blocks and refuse the
// k-th.
#include "base/status.h"

/// Zeroed block of n items of `size` bytes into *block; n * size is checked for overflow.
///
/// @return CLAST_E_MEMORY with the wanted size in the message; *block is then NULL
/// @note n = 0 gives a valid block of one byte, so that NULL always means failure
CLX_SHARED clast_status clx_alloc(void *block, int64_t n, size_t size);

/// Grows *block to n items, contents kept, new items not zeroed; *block is untouched on failure.
CLX_SHARED clast_status clx_realloc(void *block, int64_t n, size_t size);

/// Copy of a text.
CLX_SHARED clast_status clx_alloc_text(char **copy, const char *text);

/// Ensures room for `need` items: *capacity grows by half, at least to 16.
CLX_SHARED clast_status clx_grow(void *block, int64_t *capacity, int64_t need, size_t size);

/// Frees; NULL is allowed.
CLX_SHARED void clx_free(void *block);

/// Frees several blocks: CLX_FREE(low, high, volume).
#define CLX_FREE(...)                                                                              \
    clx_free_blocks(sizeof((void *[]){__VA_ARGS__}) / sizeof(void *), (void *[]){__VA_ARGS__})
CLX_SHARED void clx_free_blocks(size_t n, void *const block[]);

/// Blocks that wait for the next call instead of going back to the system. Sizes are rounded up to
/// powers of two, so that the same sequence of calls takes nothing from the system the second time.
typedef struct clx_pool clx_pool;
clast_status clx_pool_create(clx_pool **pool);
void clx_pool_destroy(clx_pool *pool); ///< with all its blocks; NULL is allowed

/// From now on this thread's blocks come from the pool and go back to it; returns the pool before,
/// NULL for none, to be entered again at the end. A block of a pool must be freed inside it.
clx_pool *clx_pool_enter(clx_pool *pool);

/// Most bytes one block may have (default 64 GiB); protects against absurd header counts.
enum { CLX_ALLOC_LIMIT_GIB = 64 };

#ifdef CLAST_ALLOC_INJECT
/// Test hook: refuse the k-th allocation from now (k >= 1); 0 refuses none. Returns blocks live
/// now.
int64_t clx_alloc_refuse(int64_t k);
/// Test hook: blocks that are live now.
int64_t clx_alloc_live(void);
/// Test hook: blocks taken from the system so far, moved ones included.
int64_t clx_alloc_taken(void);
#endif
