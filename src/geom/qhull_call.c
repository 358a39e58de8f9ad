// qhull's result lives until it is freed here; what it would print goes to memory, and its first
// line into the message.
#include "geom/qhull_call.h"

#include "base/alloc.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static clast_status explain(const char *what, int code, const char *text, int n)
{
    const char *start = text != NULL ? text : "";
    while (*start == '\n') {
        ++start;
    }
    if (code == qh_ERRmem) {
        return clx_fail(CLAST_E_MEMORY, "no memory for the %s of %d points", what, n);
    }
    return clx_fail(CLAST_E_GEOMETRY, "%s of %d points: qhull says %.*s", what, n,
                    (int)strcspn(start, "\n"), start);
}

clast_status clx_qhull(const char *what, const char *options, int n, double *point,
                       clast_status (*use)(qhT *qh, void *context), void *context)
{
    clast_status status = CLAST_OK;
    qhT *qh = NULL;
    char *text = NULL;
    size_t text_size = 0;
    FILE *report = NULL;
    char writable[64]; // qhull's interface is not const
    (void)snprintf(writable, sizeof writable, "qhull %s", options);
    CLX_TRY(clx_alloc(&qh, 1, sizeof *qh));
    report = open_memstream(&text, &text_size);
    CLX_CHECK(report != NULL, CLAST_E_MEMORY, "no memory for qhull's messages");
    const int code = qh_new_qhull(qh, 3, n, point, False, writable, NULL, report);
    (void)fflush(report);
    status = code == 0 ? use(qh, context) : explain(what, code, text, n);
done:
    if (report != NULL) {
        int long_blocks = 0;
        int long_bytes = 0;
        qh_freeqhull(qh, !qh_ALL);
        qh_memfreeshort(qh, &long_blocks, &long_bytes);
        (void)fclose(report);
    }
    free(text); // by open_memstream, not ours
    clx_free(qh);
    return status;
}
