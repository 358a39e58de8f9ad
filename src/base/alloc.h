#pragma once
// All heap use of the library goes through here, so that tests can count live blocks and refuse the
// k-th.
#include "base/status.h"

/// Zeroed block of n items of `size` bytes into *block; n * size is checked for overflow.
///
/// @return CLAST_E_MEMORY with the wanted size in the message; *block is then NULL
/// @note n = 0 gives a valid block of one byte, so that NULL always means failure
clast_status clx_alloc(void *block, int64_t n, size_t size);

/// Grows *block to n items, contents kept, new items not zeroed; *block is untouched on failure.
clast_status clx_realloc(void *block, int64_t n, size_t size);

/// Copy of a text.
clast_status clx_alloc_text(char **copy, const char *text);

/// Ensures room for `need` items: *capacity grows by half, at least to 16.
clast_status clx_grow(void *block, int64_t *capacity, int64_t need, size_t size);

/// Frees; NULL is allowed.
void clx_free(void *block);

/// Most bytes one block may have (default 64 GiB); protects against absurd header counts.
enum { CLX_ALLOC_LIMIT_GIB = 64 };

#ifdef CLAST_ALLOC_INJECT
/// Test hook: refuse the k-th allocation from now (k >= 1); 0 refuses none. Returns blocks live
/// now.
int64_t clx_alloc_refuse(int64_t k);
/// Test hook: blocks that are live now.
int64_t clx_alloc_live(void);
#endif
