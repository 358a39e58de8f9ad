#pragma once
#include <clast/status.h>

CLAST_BEGIN

// How much memory the library's blocks may take together, over all threads of the process. What
// would go beyond ends with CLAST_E_MEMORY before it is taken, so that a file that declares more
// than the machine has costs a message and nothing else. There is no limit until one is set; the
// command sets one (`clast COMMAND --max-memory`).

/// Sets the limit in bytes; 0: none. Blocks that are taken already stay.
///
/// @return CLAST_E_ARGUMENT for a negative number
CLAST_API clast_status clast_memory_set_limit(int64_t bytes);

/// The limit in bytes; 0: none.
CLAST_API int64_t clast_memory_limit(void);

/// Bytes that the library's blocks take now.
CLAST_API int64_t clast_memory_taken(void);

CLAST_END
