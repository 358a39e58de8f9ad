#pragma once
// The few checks that cmocka lacks, and the data folders.
#include <clast/clast.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

// cmocka.h needs the standard headers before it.
#include <cmocka.h>

/// Fails with the library's message unless the call returns CLAST_OK.
#define CHECK_OK(call) support_check_status((call), CLAST_OK, #call, __FILE__, __LINE__)

/// Fails unless the call returns this status.
#define CHECK_STATUS(call, expected)                                                               \
    support_check_status((call), (expected), #call, __FILE__, __LINE__)

/// |a - b| <= tol * |b|
#define CHECK_REL(a, b, tol) support_check_rel((a), (b), (tol), #a, __FILE__, __LINE__)

/// |a - b| <= tol
#define CHECK_ABS(a, b, tol) support_check_abs((a), (b), (tol), #a, __FILE__, __LINE__)

void support_check_status(clast_status status, clast_status expected, const char *call,
                          const char *file, int line);
void support_check_rel(double a, double b, double tol, const char *what, const char *file,
                       int line);
void support_check_abs(double a, double b, double tol, const char *what, const char *file,
                       int line);

/// Path of a file under the project's data/ (tests run with the repository root as working
/// directory). The text is static and lives until the fourth next call.
const char *support_data(const char *name);

/// Path of a file under ../shared/data, or NULL after skip-worthy absence: say so loudly and call
/// skip().
const char *support_shared(const char *name);

/// Runs `make` with the k-th allocation refused, for every k until it succeeds, and checks each
/// time that the status is CLAST_E_MEMORY and no block is left. `make` must free what it made when
/// it succeeds. Needs CLAST_ALLOC_INJECT (otherwise the call returns at once).
void support_refuse_each_allocation(clast_status (*make)(void *context), void *context);

/// The same with the path of a scratch file as context.
void support_refuse_each_allocation_at(clast_status (*make)(void *context), const char *name);

/// Fails unless two files hold the same bytes.
void support_check_same_files(const char *a, const char *b);

/// A fresh folder for this test's files, removed by nobody: under the build's working folder
/// ($TMPDIR or /tmp).
const char *support_scratch(void);

/// Path of a file in it. The text is static and lives until the fourth next call.
const char *support_scratch_file(const char *name);
