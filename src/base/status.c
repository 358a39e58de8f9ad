// Status texts and the thread's last error message.
#include "base/status.h"

#include "base/number.h"
#include "clast_version.h"
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static _Thread_local char detail[CLX_DETAIL_SIZE];

const char *clast_status_text(clast_status status)
{
#define TEXT(name, code, text) text,
    static const char *const texts[] = {CLAST_STATUS_LIST(TEXT)};
#undef TEXT
    return (unsigned)status < CLAST_N_STATUS ? texts[status] : "unknown status";
}

int clast_status_exit_code(clast_status status)
{
#define CODE(name, code, text) code,
    static const int codes[] = {CLAST_STATUS_LIST(CODE)};
#undef CODE
    return (unsigned)status < CLAST_N_STATUS ? codes[status] : 2;
}

const char *clast_error_detail(void)
{
    return detail;
}

const char *clast_version(void)
{
    return CLAST_VERSION_TEXT;
}

clast_status clx_fail(clast_status status, const char *format, ...)
{
    char text[CLX_DETAIL_SIZE];
    va_list args;
    va_start(args, format);
    (void)clx_number_print_list(text, sizeof text, format, args);
    va_end(args);
    memcpy(detail, text, sizeof detail);
    return status;
}

void clx_fail_prefix(const char *format, ...)
{
    char text[CLX_DETAIL_SIZE];
    va_list args;
    va_start(args, format);
    const int n = clx_number_print_list(text, sizeof text, format, args);
    va_end(args);
    if (n >= 0 && n < CLX_DETAIL_SIZE - 1) {
        (void)snprintf(text + n, sizeof text - (size_t)n, ": %s", detail);
        memcpy(detail, text, sizeof detail);
    }
}

const char *clx_error_text(int error)
{
    static _Thread_local char text[128];
    if (strerror_r(error, text, sizeof text) != 0) {
        (void)snprintf(text, sizeof text, "error %d", error);
    }
    return text;
}

const char *clx_errno_text(void)
{
    return clx_error_text(errno);
}
