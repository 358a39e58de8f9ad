// A configuration as JSON text, from its field table: for manifests and state files.
#include <clast/run_folder.h>

#include "base/alloc.h"
#include "base/number.h"
#include "io/json.h"
#include <clast/field.h>
#include <math.h>
#include <string.h>

typedef struct {
    char *text;
    int64_t n, capacity;
} growing_text;

static clast_status append(growing_text *t, const char *bytes, size_t n)
{
    const clast_status status = clx_grow(&t->text, &t->capacity, t->n + (int64_t)n + 1, 1);
    if (status == CLAST_OK) {
        memcpy(t->text + t->n, bytes, n);
        t->n += (int64_t)n;
        t->text[t->n] = '\0';
    }
    return status;
}

static clast_status append_quoted(growing_text *t, const char *text)
{
    clast_status status = CLAST_OK;
    CLX_TRY(append(t, "\"", 1));
    while (*text != '\0') {
        char out[CLX_JSON_STEP];
        size_t n = 0;
        text = clx_json_next(text, out, &n);
        CLX_TRY(append(t, out, n));
    }
    CLX_TRY(append(t, "\"", 1));
done:
    return status;
}

static clast_status append_f64(growing_text *t, double value)
{
    char text[CLX_NUMBER_SIZE];
    if (!isfinite(value)) {
        return append(t, "null", 4);
    }
    return append(t, text, (size_t)clx_number_format(value, text));
}

/// Value of a field that is no list, or item `index` of one.
static clast_status append_value(growing_text *t, const clast_field *f, const void *config,
                                 int32_t index)
{
    CLAST_ASSERT(index >= 0);
    const char *slot = (const char *)config + f->offset;
    char text[64];
    int n = 0;
    switch (f->type) {
    case CLAST_FIELD_F64:
        return append_f64(t, *(const double *)(const void *)slot);
    case CLAST_FIELD_F64_LIST:
        return append_f64(t, ((const clast_f64_list *)(const void *)slot)->item[index]);
    case CLAST_FIELD_TEXT:
        return append_quoted(t, *(char *const *)(const void *)slot);
    case CLAST_FIELD_TEXT_LIST:
        return append_quoted(t, ((const clast_text_list *)(const void *)slot)->item[index]);
    case CLAST_FIELD_CHOICE:
        (void)clast_field_format(f, config, 0, sizeof text, text);
        return append_quoted(t, text);
    default: // whole numbers and true or false print alike in any locale
        n = clast_field_format(f, config, 0, sizeof text, text);
        return append(t, text, (size_t)n);
    }
}

static clast_status append_field(growing_text *t, const clast_field *f, const void *config)
{
    clast_status status = CLAST_OK;
    const bool is_list = f->type == CLAST_FIELD_TEXT_LIST || f->type == CLAST_FIELD_F64_LIST;
    const int32_t n = clast_field_count(f, config);
    CLX_TRY(append_quoted(t, f->name));
    CLX_TRY(append(t, is_list ? ": [" : ": ", is_list ? 3 : 2));
    for (int32_t i = 0; i < n; ++i) {
        CLX_TRY(append(t, ", ", i > 0 ? 2 : 0));
        CLX_TRY(append_value(t, f, config, i));
    }
    CLX_TRY(append(t, "]", is_list ? 1 : 0));
done:
    return status;
}

clast_status clast_fields_json(const clast_field *fields, const void *config, char **text)
{
    CLX_ARGUMENTS(fields, config, text);
    clast_status status = CLAST_OK;
    growing_text t = {0};
    CLX_TRY(append(&t, "{", 1));
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        CLX_TRY(append(&t, ", ", f > fields ? 2 : 0));
        CLX_TRY(append_field(&t, f, config));
    }
    CLX_TRY(append(&t, "}", 1));
    *text = t.text;
    t.text = NULL;
done:
    clx_free(t.text);
    return status;
}
