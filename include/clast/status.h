#pragma once
// Status codes, the last error's text, and the marks that every public header needs.
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __FAST_MATH__
#error "clast needs IEEE arithmetic: build without -ffast-math"
#endif

/// Around the declarations of each header, so that C and C++ may include it anywhere.
#ifdef __cplusplus
#define CLAST_BEGIN extern "C" {
#define CLAST_END   }
#else
#define CLAST_BEGIN
#define CLAST_END
#endif

/// The release of these headers. Until 1.0 each minor one may change the interface, so a program
/// and its library agree in both numbers; clast_version() returns the library's.
#define CLAST_VERSION_MAJOR 0
#define CLAST_VERSION_MINOR 2
#define CLAST_VERSION_TEXT  "0.2.0"

#define CLAST_API __attribute__((visibility("default")))
#define CLAST_PI  3.14159265358979323846

/// Every status: name, exit code of the command that ends with it, text.
#define CLAST_STATUS_LIST(X)                                                                       \
    X(OK, 0, "done")                                                                               \
    X(E_NO, 1, "the check answered no")                                                            \
    X(E_USAGE, 2, "wrong use")                                                                     \
    X(E_CONFIG, 2, "wrong configuration")                                                          \
    X(E_ARGUMENT, 2, "wrong argument of a call")                                                   \
    X(E_FORMAT, 3, "malformed input")                                                              \
    X(E_GEOMETRY, 3, "unusable geometry")                                                          \
    X(E_IO, 3, "cannot read")                                                                      \
    X(E_LIMIT, 3, "beyond a stated limit")                                                         \
    X(E_MEMORY, 4, "not enough memory")                                                            \
    X(E_DISK, 4, "cannot write")                                                                   \
    X(E_CONVERGE, 5, "did not converge")                                                           \
    X(E_STOPPED, 130, "stopped with a checkpoint")

CLAST_BEGIN

// What the stages hand on to one another; the header of each name defines it.
typedef struct clast_assembly clast_assembly;
typedef struct clast_bootstrap clast_bootstrap;
typedef struct clast_cloud clast_cloud;
typedef struct clast_comm clast_comm;
typedef struct clast_domain clast_domain;
typedef struct clast_idle clast_idle;
typedef struct clast_mesh clast_mesh;
typedef struct clast_shape clast_shape;
typedef struct clast_spheres clast_spheres;
typedef struct clast_table clast_table;

#define CLAST_STATUS_ENUM(name, code, text) CLAST_##name,
typedef enum { CLAST_STATUS_LIST(CLAST_STATUS_ENUM) CLAST_N_STATUS } clast_status;
#undef CLAST_STATUS_ENUM

/// Fixed text of a status ("unusable geometry").
CLAST_API const char *clast_status_text(clast_status status);

/// Exit code of a command that ends with this status (0 to 5, 130); DESIGN section 3.
CLAST_API int clast_status_exit_code(clast_status status);

/// The calling thread's last error in one line: what, where, how many, what to do. Never NULL.
CLAST_API const char *clast_error_detail(void);

/// A text as a terminal, a table or a picture may show it: control characters and bytes that are
/// not UTF-8 become \\xNN. Cut at `size` bytes with the end, never inside a character.
///
/// @return out
CLAST_API const char *clast_text_printable(const char *text, size_t size, char *out);

/// The library's CLAST_VERSION_TEXT: MAJOR.MINOR.PATCH.
CLAST_API const char *clast_version(void);

/// The source's commit, "8b3581966463", with "-dirty" where files had changed since; "unknown"
/// where there was neither a repository nor an archive's commit.
CLAST_API const char *clast_source(void);

/// How long work talks to its caller: NULL, or callbacks. Called from the calling thread only.
typedef struct clast_monitor {
    /// done of total units in the named phase; total <= 0 when unknown. May be NULL.
    void (*report)(void *context, const char *phase, int64_t done, int64_t total);
    /// True asks the work to write its checkpoint and return CLAST_E_STOPPED. May be NULL.
    bool (*stop)(void *context);
    /// One line on what comes next ("printable.stl: about 48 MB"). May be NULL.
    void (*note)(void *context, const char *text);
    void *context;
    int32_t n_word;    ///< the command line, for manifests; 0: none
    char *const *word; ///< [n_word] borrowed
} clast_monitor;

/// Removes the temporary files of all outputs under way, of every thread. For a signal handler that
/// then ends the process (it calls nothing but unlink); outputs that were whole stay.
CLAST_API void clast_outputs_abandon(void);

CLAST_END
