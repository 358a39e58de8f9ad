#pragma once
// How library code fails: one `status`, one `done:`, a message for the person at the terminal.
#include <clast/status.h>
#include <fenv.h>

// The library is built as two: libclast, the core, and libclast_view (src/plot, render, report and
// study), which needs cairo. libclast_mpi stands on the core as the view does.

/// Of the core, called by the view too: exported under a version name of the exact release
/// (cmake/Exports.cmake), so that a view never meets another core. Inside the core the call stays
/// direct, as for every clx_ function.
#ifdef CLX_VIEW
#define CLX_SHARED __attribute__((visibility("default")))
#else
#define CLX_SHARED __attribute__((visibility("protected")))
#endif

enum { CLX_DETAIL_SIZE = 1024 }; ///< bytes of the thread's error text, its end too

/// Sets the thread's error text (printf style, cut at 1023 bytes) and returns `status`.
CLX_SHARED clast_status clx_fail(clast_status status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// Puts "prefix: " before the thread's error text, to name a file or an item further out.
CLX_SHARED void clx_fail_prefix(const char *format, ...) __attribute__((format(printf, 1, 2)));

/// Text of errno, or of an errno kept from before, for messages; lives until the thread's next
/// call.
CLX_SHARED const char *clx_errno_text(void);
const char *clx_error_text(int error);

/// A number in a person's unit (clast_unit_for) for messages, "710.419 mg" of 7.10419e-4 kg: six
/// digits, as refusals compare numbers that lie close. NULL or "-": the number alone. Lives until
/// the thread's 8th call after it.
CLX_SHARED const char *clx_unit_text(double value, const char *si_unit);

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

/// Ends the function with the status of a call that fails: at its beginning only, where it holds
/// nothing yet.
#define CLX_GUARD(call)                                                                            \
    do {                                                                                           \
        const clast_status clx_guarded = (call);                                                   \
        if (clx_guarded != CLAST_OK) {                                                             \
            return clx_guarded;                                                                    \
        }                                                                                          \
    } while (0)

/// The pointers that a public function needs: its first statement.
#define CLX_ARGUMENTS(...)                                                                         \
    CLX_GUARD(clx_given(__func__, #__VA_ARGS__, (const void *const[]){__VA_ARGS__},                \
                        (int)(sizeof((const void *const[]){__VA_ARGS__}) / sizeof(void *))))

/// The same of an array of n items, n >= 0: NULL where n is 0 only.
#define CLX_ARRAY(array, n) CLX_GUARD(clx_array_given(__func__, #array, array, #n, (int64_t)(n)))

// The floating-point environment of a call. A flow solver may trap (OpenFOAM does by default,
// gfortran with -ffpe-trap), flush denormals to zero or round otherwise; here NAN is compared and
// divided by zero on purpose, and no bit shall depend on the caller's environment.

static inline fenv_t clx_float_environment_set(void)
{
    fenv_t of_caller;
    (void)fegetenv(&of_caller);
    (void)fesetenv(FE_DFL_ENV);
    return of_caller;
}

static inline void clx_float_environment_restore(const fenv_t *of_caller)
{
    (void)fesetenv(of_caller);
}

/// To the end of the function the default one of C (no traps, to nearest, with denormals); then the
/// caller's, with its flags, again. Below 1 us: for functions that compute longer.
#define CLX_FLOAT_ENVIRONMENT                                                                      \
    __attribute__((cleanup(clx_float_environment_restore))) const fenv_t clx_of_caller =           \
        clx_float_environment_set()

/// None of n pointers is NULL; `names` are theirs as one text, with commas.
CLX_SHARED clast_status clx_given(const char *function, const char *names,
                                  const void *const *pointer, int n);
CLX_SHARED clast_status clx_array_given(const char *function, const char *name, const void *array,
                                        const char *count, int64_t n);

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

// Whether what a caller has filled himself holds together: counts that are not negative, arrays
// where counts say so, numbers of items that exist. Each noun has one function for it, in its own
// folder's whole.h.

typedef struct clast_text_list clast_text_list;

/// Refuses the argument `object` of a public function where `noun`'s rules do not hold.
#define CLX_WHOLE(noun, object)                                                                    \
    CLX_GUARD(clx_fault_given(__func__, #object, clx_##noun##_fault(object)))

/// CLAST_E_ARGUMENT with the fault; CLAST_OK for none (NULL).
CLX_SHARED clast_status clx_fault_given(const char *function, const char *name, const char *fault);

/// What is wrong with a table, for people, or NULL.
CLX_SHARED const char *clx_table_fault(const clast_table *table);

/// CLAST_E_ARGUMENT for a list with a negative count, without items, or with one that is NULL.
clast_status clx_texts_given(const char *function, const char *name, const clast_text_list *list);

/// n >= 0 items have an array.
static inline bool clx_has_array(const void *array, int64_t n)
{
    return n >= 0 && (n == 0 || array != NULL);
}
