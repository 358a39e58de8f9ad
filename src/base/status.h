#pragma once
// How library code fails: one `status`, one `done:`, a message for the person at the terminal.
#include <clast/status.h>

enum { CLX_DETAIL_SIZE = 1024 }; ///< bytes of the thread's error text, its end too

/// Sets the thread's error text (printf style, cut at 1023 bytes) and returns `status`.
clast_status clx_fail(clast_status status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// Puts "prefix: " before the thread's error text, to name a file or an item further out.
void clx_fail_prefix(const char *format, ...) __attribute__((format(printf, 1, 2)));

/// Text of errno, or of an errno kept from before, for messages; lives until the thread's next
/// call.
const char *clx_errno_text(void);
const char *clx_error_text(int error);

#define CLX_CHECK(condition, code, ...)                                                            \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            status = clx_fail(code, __VA_ARGS__);                                                  \
            goto done;                                                                             \
        }                                                                                          \
    } while (0)

/// An argument, or a member of one, that must not be NULL.
#define CLX_NEED(pointer)                                                                          \
    CLX_CHECK((pointer) != NULL, CLAST_E_ARGUMENT, "%s: %s is NULL", __func__, #pointer)

#define CLX_TRY(call)                                                                              \
    do {                                                                                           \
        status = (call);                                                                           \
        if (status != CLAST_OK) {                                                                  \
            goto done;                                                                             \
        }                                                                                          \
    } while (0)

/// The caller's bug: stops in debug builds, costs nothing in release builds.
#ifdef NDEBUG
#define CLAST_ASSERT(condition) ((void)0)
#else
#include <assert.h>
#define CLAST_ASSERT(condition) assert(condition)
#endif
