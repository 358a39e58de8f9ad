// Status texts and the thread's last error message.
#include "base/status.h"

#include "base/number.h"
#include "clast_source.h"
#include <clast/field.h>
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

const char *clast_source(void)
{
    return CLAST_SOURCE;
}

/// Bytes of the UTF-8 character that begins here, 0 where none does [RFC 3629].
static size_t utf8_length(const unsigned char *c)
{
    const size_t n = c[0] < 0x80                   ? 1
                     : c[0] >= 0xc2 && c[0] < 0xe0 ? 2
                     : c[0] >= 0xe0 && c[0] < 0xf0 ? 3
                     : c[0] >= 0xf0 && c[0] < 0xf5 ? 4
                                                   : 0;
    for (size_t k = 1; k < n; ++k) {
        if ((c[k] & 0xc0) != 0x80) {
            return 0;
        }
    }
    const bool is_wrong = (c[0] == 0xe0 && c[1] < 0xa0) || (c[0] == 0xed && c[1] > 0x9f) ||
                          (c[0] == 0xf0 && c[1] < 0x90) || (c[0] == 0xf4 && c[1] > 0x8f);
    return is_wrong ? 0 : n;
}

const char *clast_text_printable(const char *text, size_t size, char *out)
{
    if (text == NULL || out == NULL) {
        return NULL;
    }
    size_t used = 0;
    const unsigned char *c = (const unsigned char *)text;
    while (*c != '\0' && size > 0) {
        const size_t n = utf8_length(c);
        // C0, DEL and C1, which terminals obey
        const bool is_control = *c < 0x20 || *c == 0x7f || (n == 2 && c[0] == 0xc2 && c[1] < 0xa0);
        const bool is_shown = n > 0 && !is_control;
        if (used + (is_shown ? n : 4) >= size) {
            break;
        }
        if (is_shown) {
            memcpy(out + used, c, n);
            used += n;
            c += n;
        } else {
            (void)snprintf(out + used, 5, "\\x%02x", *c++);
            used += 4;
        }
    }
    if (size > 0) {
        out[used] = '\0';
    }
    return out;
}

clast_status clx_fail(clast_status status, const char *format, ...)
{
    char text[CLX_DETAIL_SIZE];
    va_list args;
    va_start(args, format);
    (void)clx_number_print_list(text, sizeof text, format, args);
    va_end(args);
    (void)clast_text_printable(text, sizeof detail, detail);
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
        (void)clast_text_printable(text, sizeof detail, detail);
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

clast_status clx_given(const char *function, const char *names, const void *const *pointer, int n)
{
    for (int i = 0; i < n; ++i) {
        const size_t length = strcspn(names, ",");
        if (pointer[i] == NULL) {
            return clx_fail(CLAST_E_ARGUMENT, "%s: %.*s is NULL", function, (int)length, names);
        }
        names += length;
        names += strspn(names, ", ");
    }
    return CLAST_OK;
}

clast_status clx_array_given(const char *function, const char *name, const void *array,
                             const char *count, int64_t n)
{
    return n < 0 ? clx_fail(CLAST_E_ARGUMENT, "%s: %s is %lld", function, count, (long long)n)
           : n > 0 && array == NULL ? clx_fail(CLAST_E_ARGUMENT, "%s: %s is NULL but %s is %lld",
                                               function, name, count, (long long)n)
                                    : CLAST_OK;
}

clast_status clx_fault_given(const char *function, const char *name, const char *fault)
{
    return fault == NULL ? CLAST_OK
                         : clx_fail(CLAST_E_ARGUMENT, "%s: %s: %s", function, name, fault);
}

clast_status clx_texts_given(const char *function, const char *name, const clast_text_list *list)
{
    bool is_whole = clx_has_array(list->item, list->n);
    for (int32_t i = 0; is_whole && i < list->n; ++i) {
        is_whole = list->item[i] != NULL;
    }
    return is_whole ? CLAST_OK
                    : clx_fail(CLAST_E_ARGUMENT, "%s: %s: a list of %d texts, one of them NULL",
                               function, name, list->n);
}
