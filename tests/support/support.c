#include "support.h"

#include "base/alloc.h"
#include "base/file.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void support_check_status(clast_status status, clast_status expected, const char *call,
                          const char *file, int line)
{
    if (status != expected) {
        print_error("%s gives '%s' (%s), expected '%s'\n", call, clast_status_text(status),
                    clast_error_detail(), clast_status_text(expected));
        _fail(file, line);
    }
}

void support_check_rel(double a, double b, double tol, const char *what, const char *file, int line)
{
    if (!(fabs(a - b) <= tol * fabs(b))) {
        print_error("%s = %.17g, expected %.17g, relative error %.3g > %.3g\n", what, a, b,
                    fabs(a - b) / fabs(b), tol);
        _fail(file, line);
    }
}

void support_check_abs(double a, double b, double tol, const char *what, const char *file, int line)
{
    if (!(fabs(a - b) <= tol)) {
        print_error("%s = %.17g, expected %.17g, error %.3g > %.3g\n", what, a, b, fabs(a - b),
                    tol);
        _fail(file, line);
    }
}

static const char *path_of(const char *folder, const char *name)
{
    static char paths[4][512];
    static int next;
    char *path = paths[next];
    next = (next + 1) % 4;
    (void)snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

const char *support_data(const char *name)
{
    return path_of("data", name);
}

const char *support_shared(const char *name)
{
    const char *path = path_of("../shared/data", name);
    if (access(path, R_OK) != 0) {
        print_message("SKIPPED LOUDLY: %s is not here; this check did not run\n", path);
        return NULL;
    }
    return path;
}

void support_refuse_each_allocation(clast_status (*make)(void *context), void *context)
{
#ifdef CLAST_ALLOC_INJECT
    static const char earlier[] = "the message of an earlier call";
    const int64_t before = clx_alloc_live();
    clast_status status = CLAST_E_MEMORY;
    for (int64_t k = 1; status != CLAST_OK; ++k) {
        (void)clx_fail(CLAST_OK, "%s", earlier);
        (void)clx_alloc_refuse(k);
        status = make(context);
        (void)clx_alloc_refuse(0);
        if (status != CLAST_OK && status != CLAST_E_MEMORY) {
            fail_msg("allocation %lld refused: got '%s' (%s)", (long long)k,
                     clast_status_text(status), clast_error_detail());
        }
        if (status != CLAST_OK && strcmp(clast_error_detail(), earlier) == 0) {
            fail_msg("allocation %lld refused: no message of its own", (long long)k);
        }
        if (clx_alloc_live() != before) {
            fail_msg("allocation %lld refused: %lld blocks left", (long long)k,
                     (long long)(clx_alloc_live() - before));
        }
        if (k > 100000) {
            fail_msg("more than 100000 allocations");
        }
    }
#else
    (void)make;
    (void)context;
#endif
}

const char *support_scratch(void)
{
    static char folder[256];
    if (folder[0] == '\0') {
        const char *base = getenv("TMPDIR");
        (void)snprintf(folder, sizeof folder, "%s/clast-test-XXXXXX", base != NULL ? base : "/tmp");
        if (mkdtemp(folder) == NULL) {
            fail_msg("cannot make a scratch folder");
        }
    }
    return folder;
}

const char *support_scratch_file(const char *name)
{
    return path_of(support_scratch(), name);
}

void support_refuse_each_allocation_at(clast_status (*make)(void *context), const char *name)
{
    char path[512]; // the static text may be used up meanwhile
    (void)snprintf(path, sizeof path, "%s", support_scratch_file(name));
    support_refuse_each_allocation(make, path);
}

void support_check_same_files(const char *a, const char *b)
{
    char *text[2] = {NULL, NULL};
    int64_t n[2] = {0, 0};
    CHECK_OK(clx_file_read_all(a, 1 << 30, &text[0], &n[0]));
    CHECK_OK(clx_file_read_all(b, 1 << 30, &text[1], &n[1]));
    assert_int_equal(n[0], n[1]);
    assert_memory_equal(text[0], text[1], (size_t)n[0]);
    clx_free(text[0]);
    clx_free(text[1]);
}
