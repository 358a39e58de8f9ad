// Configurations that a caller has filled himself are held against the table that files and options
// go through.
#include "base/field.h"

#include "base/status.h"
#include <clast/field.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

static int32_t n_choice(const clast_field *f)
{
    int32_t n = 1;
    for (const char *bar = strchr(f->text, '|'); bar != NULL; bar = strchr(bar + 1, '|')) {
        ++n;
    }
    return n;
}

static clast_status check_number(const clast_field *f, double value)
{
    const bool is_inside = isfinite(value) && value >= f->low && value <= f->high;
    return is_inside || value == f->value
               ? CLAST_OK
               : clx_fail(CLAST_E_CONFIG, "%s: %s is outside [%s, %s]", f->name,
                          clx_unit_text(value, f->unit), clx_unit_text(f->low, f->unit),
                          clx_unit_text(f->high, f->unit));
}

static clast_status check_numbers(const clast_field *f, const clast_f64_list *list)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(list->n >= 0 && (list->n == 0 || list->item != NULL), CLAST_E_CONFIG,
              "%s: a list of %d numbers without memory", f->name, list->n);
    for (int32_t i = 0; i < list->n; ++i) {
        CLX_TRY(check_number(f, list->item[i]));
    }
done:
    return status;
}

static clast_status check_text(const clast_field *f, const char *text)
{
    return text != NULL ? CLAST_OK
                        : clx_fail(CLAST_E_CONFIG,
                                   "%s: NULL is no text; begin with clast_fields_default", f->name);
}

static clast_status check_texts(const clast_field *f, const clast_text_list *list)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(list->n >= 0 && (list->n == 0 || list->item != NULL), CLAST_E_CONFIG,
              "%s: a list of %d texts without memory", f->name, list->n);
    for (int32_t i = 0; i < list->n; ++i) {
        CLX_TRY(check_text(f, list->item[i]));
    }
done:
    return status;
}

static clast_status check_choice(const clast_field *f, int32_t index)
{
    return index >= 0 && index < n_choice(f)
               ? CLAST_OK
               : clx_fail(CLAST_E_CONFIG, "%s: %d is outside 0 to %d: %s", f->name, index,
                          n_choice(f) - 1, f->text);
}

clast_status clx_field_check(const clast_field *f, const void *slot)
{
    switch (f->type) {
    case CLAST_FIELD_F64:
        return check_number(f, *(const double *)slot);
    case CLAST_FIELD_I32:
        return check_number(f, *(const int32_t *)slot);
    case CLAST_FIELD_I64:
        return check_number(f, (double)*(const int64_t *)slot);
    case CLAST_FIELD_U64:
        return check_number(f, (double)*(const uint64_t *)slot);
    case CLAST_FIELD_BOOL: // read as a byte: a bool that is neither cannot be looked at
        return *(const unsigned char *)slot <= 1
                   ? CLAST_OK
                   : clx_fail(CLAST_E_CONFIG, "%s: the byte %d is neither false nor true", f->name,
                              *(const unsigned char *)slot);
    case CLAST_FIELD_CHOICE:
        return check_choice(f, *(const int32_t *)slot);
    case CLAST_FIELD_TEXT:
        return check_text(f, *(char *const *)slot);
    case CLAST_FIELD_TEXT_LIST:
        return check_texts(f, slot);
    case CLAST_FIELD_F64_LIST:
        return check_numbers(f, slot);
    }
    return clx_fail(CLAST_E_CONFIG, "%s: unknown field type", f->name);
}

clast_status clx_fields_check_part(const clast_field *fields, size_t begin, size_t end,
                                   const void *part)
{
    CLAST_ASSERT(begin < end);
    clast_status status = CLAST_OK;
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        if (f->offset >= begin && f->offset < end) {
            CLX_TRY(clx_field_check(f, (const char *)part + (f->offset - begin)));
        }
    }
done:
    return status;
}

clast_status clast_fields_check(const clast_field *fields, const void *config)
{
    clast_status status = CLAST_OK;
    CLX_NEED(fields);
    CLX_NEED(config);
    CLX_TRY(clx_fields_check_part(fields, 0, SIZE_MAX, config));
done:
    return status;
}
