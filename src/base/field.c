// Configuration fields: defaults, parsing with ranges, formatting; one table serves files, options
// and manifests.
#include "base/field.h"

#include "base/alloc.h"
#include "base/number.h"
#include <clast/field.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *member(const clast_field *field, void *config)
{
    return (char *)config + field->offset;
}

static const void *member_const(const clast_field *field, const void *config)
{
    return (const char *)config + field->offset;
}

static char canonical(char c)
{
    return c == '-' ? '_' : c;
}

static bool same_name(const char *a, const char *b)
{
    for (; *a != '\0' && *b != '\0'; ++a, ++b) {
        if (canonical(*a) != canonical(*b)) {
            return false;
        }
    }
    return *a == *b;
}

const clast_field *clast_fields_find(const clast_field *fields, const char *name)
{
    if (fields == NULL || name == NULL) {
        return NULL;
    }
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        if (same_name(f->name, name)) {
            return f;
        }
    }
    return NULL;
}

enum { NAME_LIMIT = 64 };

static int edit_distance(const char *a, const char *b)
{
    const int n = (int)strlen(b);
    int row[NAME_LIMIT + 1];
    if (n > NAME_LIMIT || strlen(a) > NAME_LIMIT) {
        return NAME_LIMIT;
    }
    for (int j = 0; j <= n; ++j) {
        row[j] = j;
    }
    for (int i = 1; a[i - 1] != '\0'; ++i) {
        int diagonal = row[0];
        row[0] = i;
        for (int j = 1; j <= n; ++j) {
            const int above = row[j];
            int best = diagonal + (canonical(a[i - 1]) == canonical(b[j - 1]) ? 0 : 1);
            best = above + 1 < best ? above + 1 : best;
            best = row[j - 1] + 1 < best ? row[j - 1] + 1 : best;
            diagonal = above;
            row[j] = best;
        }
    }
    return row[n];
}

const char *clast_fields_nearest(const clast_field *fields, const char *name)
{
    if (fields == NULL || name == NULL) {
        return NULL;
    }
    const char *nearest = NULL;
    int best = (int)strlen(name) / 2 + 1;
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        const int distance = edit_distance(name, f->name);
        if (distance < best) {
            best = distance;
            nearest = f->name;
        }
    }
    return nearest;
}

static void free_list(clast_text_list *list)
{
    for (int32_t i = 0; i < list->n; ++i) {
        clx_free(list->item[i]);
    }
    clx_free(list->item);
    *list = (clast_text_list){0};
}

void clast_field_clear(const clast_field *field, void *config)
{
    if (field == NULL || config == NULL) {
        return;
    }
    if (field->type == CLAST_FIELD_TEXT_LIST) {
        free_list(member(field, config));
    } else if (field->type == CLAST_FIELD_F64_LIST) {
        clast_f64_list *list = member(field, config);
        clx_free(list->item);
        *list = (clast_f64_list){0};
    }
}

void clast_fields_free(const clast_field *fields, void *config)
{
    if (fields == NULL || config == NULL) {
        return;
    }
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        if (f->type == CLAST_FIELD_TEXT) {
            char **text = member(f, config);
            clx_free(*text);
            *text = NULL;
        } else {
            clast_field_clear(f, config);
        }
    }
}

static clast_status set_text(char **slot, const char *text)
{
    char *copy = NULL;
    const clast_status status = clx_alloc_text(&copy, text);
    if (status == CLAST_OK) {
        clx_free(*slot);
        *slot = copy;
    }
    return status;
}

static clast_status append_text(clast_text_list *list, const char *text)
{
    clast_status status = CLAST_OK;
    char *copy = NULL;
    CLX_TRY(clx_alloc_text(&copy, text));
    CLX_TRY(clx_realloc(&list->item, list->n + 1, sizeof *list->item));
    list->item[list->n++] = copy;
    copy = NULL;
done:
    clx_free(copy);
    return status;
}

/// A bare number is told with its unit: "30 is outside [-90 deg, 90 deg]" tells nobody that it was
/// taken as radians.
static clast_status bad_range(const clast_field *f, const char *text)
{
    char *end = NULL;
    const double degrees = clx_number_read(text, &end) * CLAST_PI / 180.0;
    const bool is_bare = f->unit != NULL && strcmp(f->unit, "-") != 0 && *end == '\0';
    const bool means_degrees =
        is_bare && strcmp(f->unit, "rad") == 0 && degrees >= f->low && degrees <= f->high;
    return clx_fail(CLAST_E_CONFIG, "%s: %s%s%s is outside [%s, %s]%s%s%s", f->name, text,
                    is_bare ? " " : "", is_bare ? f->unit : "", clx_unit_text(f->low, f->unit),
                    clx_unit_text(f->high, f->unit), means_degrees ? "; write " : "",
                    means_degrees ? text : "", means_degrees ? "deg" : "");
}

/// A number of the field; `is_si`: bare ones are SI, else lengths and angles need a unit.
static clast_status parse_number(const clast_field *f, const char *text, bool is_si, double *value)
{
    const bool may_be_bare =
        (f->low == -1.0 && strcmp(text, "-1") == 0) ||
        (f->type == CLAST_FIELD_F64 && f->text != NULL && strcmp(f->text, CLAST_BARE_SI) == 0);
    const char *unit = f->unit != NULL ? f->unit : "-";
    const clast_status status = is_si || may_be_bare
                                    ? clast_unit_parse(text, unit, value)
                                    : clx_unit_parse_asked(text, unit, f->value, value);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", f->name);
        return status;
    }
    return *value < f->low || *value > f->high ? bad_range(f, text) : CLAST_OK;
}

/// Keeps the dimension of a number of m^d behind it (CLAST_KEEPS_DIMENSION).
static void keep_dimension(const clast_field *f, void *slot, int32_t dimension)
{
    if (f->text != NULL && strcmp(f->text, CLAST_KEEPS_DIMENSION) == 0) {
        memcpy((char *)slot + sizeof(double), &dimension, sizeof dimension);
    }
}

static clast_status append_f64(const clast_field *f, clast_f64_list *list, const char *text,
                               bool is_si)
{
    double value = 0.0;
    clast_status status = parse_number(f, text, is_si, &value);
    if (status == CLAST_OK) {
        status = clx_realloc(&list->item, list->n + 1, sizeof *list->item);
    }
    if (status == CLAST_OK) {
        list->item[list->n++] = value;
    }
    return status;
}

/// Base 16 after 0x alone: 010 is ten.
static int base_of(const char *text)
{
    text += *text == '-' || *text == '+';
    return text[0] == '0' && (text[1] == 'x' || text[1] == 'X') ? 16 : 10;
}

/// A whole number that is not written as one, such as 1e6.
static clast_status parse_whole(const clast_field *f, const char *text, double *value)
{
    const clast_status status = parse_number(f, text, true, value);
    return status != CLAST_OK || (*value == floor(*value) && fabs(*value) <= 9e15)
               ? status
               : clx_fail(CLAST_E_CONFIG, "%s: '%s' is not a whole number", f->name, text);
}

static clast_status set_integer(const clast_field *f, void *slot, const char *text)
{
    char *end = NULL;
    errno = 0;
    long long wide = strtoll(text, &end, base_of(text));
    if (end == text || *end != '\0' || errno != 0) {
        double value = 0.0;
        const clast_status status = parse_whole(f, text, &value);
        if (status != CLAST_OK) {
            return status;
        }
        wide = (long long)value;
    }
    if ((double)wide < f->low || (double)wide > f->high) {
        return bad_range(f, text);
    }
    if (f->type == CLAST_FIELD_I32) {
        *(int32_t *)slot = (int32_t)wide;
    } else {
        *(int64_t *)slot = wide;
    }
    return CLAST_OK;
}

static clast_status set_u64(const clast_field *f, uint64_t *slot, const char *text)
{
    char *end = NULL;
    errno = 0;
    uint64_t wide = strtoull(text, &end, base_of(text));
    if (errno == ERANGE) {
        return bad_range(f, text);
    }
    if (end == text || *end != '\0' || strchr(text, '-') != NULL) {
        double value = 0.0;
        const clast_status status = parse_whole(f, text, &value);
        if (status != CLAST_OK) {
            return status;
        }
        wide = (uint64_t)value;
    }
    if ((double)wide < f->low || (double)wide > f->high) {
        return bad_range(f, text);
    }
    *slot = wide;
    return CLAST_OK;
}

static bool any_of(const char *text, const char *const *words)
{
    for (; *words != NULL; ++words) {
        if (strcmp(text, *words) == 0) {
            return true;
        }
    }
    return false;
}

static clast_status set_bool(const clast_field *f, bool *slot, const char *text)
{
    static const char *const yes[] = {"true", "yes", "on", "1", NULL};
    static const char *const no[] = {"false", "no", "off", "0", NULL};
    if (!any_of(text, yes) && !any_of(text, no)) {
        return clx_fail(CLAST_E_CONFIG, "%s: '%s' is neither true nor false", f->name, text);
    }
    *slot = any_of(text, yes);
    return CLAST_OK;
}

static clast_status set_choice(const clast_field *f, int32_t *slot, const char *text)
{
    const size_t n = strlen(text);
    int32_t index = 0;
    for (const char *word = f->text; word != NULL; ++index) {
        const char *bar = strchr(word, '|');
        const size_t length = bar != NULL ? (size_t)(bar - word) : strlen(word);
        if (length == n && strncmp(word, text, n) == 0) {
            *slot = index;
            return CLAST_OK;
        }
        word = bar != NULL ? bar + 1 : NULL;
    }
    return clx_fail(CLAST_E_CONFIG, "%s: '%s' is none of %s", f->name, text, f->text);
}

static clast_status set_value(const clast_field *f, void *config, const char *text, bool append,
                              bool is_si)
{
    void *slot = member(f, config);
    double value = 0.0;
    clast_status status = CLAST_OK;
    switch (f->type) {
    case CLAST_FIELD_F64:
        status = parse_number(f, text, is_si, &value);
        if (status == CLAST_OK) {
            *(double *)slot = value;
            keep_dimension(f, slot, clx_unit_dimension(text));
        }
        return status;
    case CLAST_FIELD_I32:
    case CLAST_FIELD_I64:
        return set_integer(f, slot, text);
    case CLAST_FIELD_U64:
        return set_u64(f, slot, text);
    case CLAST_FIELD_BOOL:
        return set_bool(f, slot, text);
    case CLAST_FIELD_CHOICE:
        return set_choice(f, slot, text);
    case CLAST_FIELD_TEXT:
        return set_text(slot, text);
    case CLAST_FIELD_TEXT_LIST:
        if (!append) {
            clast_field_clear(f, config);
        }
        return append_text(slot, text);
    case CLAST_FIELD_F64_LIST:
        if (!append) {
            clast_field_clear(f, config);
        }
        return append_f64(f, slot, text, is_si);
    }
    return clx_fail(CLAST_E_CONFIG, "%s: unknown field type", f->name);
}

clast_status clast_field_set(const clast_field *f, void *config, const char *text, bool append)
{
    CLX_ARGUMENTS(f, config, text);
    return set_value(f, config, text, append, false);
}

clast_status clast_field_set_si(const clast_field *f, void *config, const char *text, bool append)
{
    CLX_ARGUMENTS(f, config, text);
    return set_value(f, config, text, append, true);
}

static clast_status default_list(const clast_field *f, void *config)
{
    clast_status status = CLAST_OK;
    const char *at = f->text;
    while (at != NULL && *at != '\0' && status == CLAST_OK) {
        char item[256];
        const size_t n = strcspn(at, ",");
        (void)snprintf(item, sizeof item, "%.*s", (int)n, at);
        status = clast_field_set_si(f, config, item, true);
        at += n + (at[n] == ',' ? 1 : 0);
    }
    return status;
}

static clast_status set_default(const clast_field *f, void *config)
{
    void *slot = member(f, config);
    switch (f->type) {
    case CLAST_FIELD_F64:
        *(double *)slot = f->value;
        keep_dimension(f, slot, 0);
        break;
    case CLAST_FIELD_I32:
    case CLAST_FIELD_CHOICE:
        *(int32_t *)slot = (int32_t)f->value;
        break;
    case CLAST_FIELD_I64:
        *(int64_t *)slot = (int64_t)f->value;
        break;
    case CLAST_FIELD_U64:
        *(uint64_t *)slot = (uint64_t)f->value;
        break;
    case CLAST_FIELD_BOOL:
        *(bool *)slot = f->value != 0.0;
        break;
    case CLAST_FIELD_TEXT:
        *(char **)slot = NULL;
        return set_text(slot, f->text != NULL ? f->text : "");
    case CLAST_FIELD_TEXT_LIST:
        *(clast_text_list *)slot = (clast_text_list){0};
        return default_list(f, config);
    case CLAST_FIELD_F64_LIST:
        *(clast_f64_list *)slot = (clast_f64_list){0};
        return default_list(f, config);
    }
    return CLAST_OK;
}

static void blank(const clast_field *f, void *config)
{
    if (f->type == CLAST_FIELD_TEXT) {
        *(char **)member(f, config) = NULL;
    } else if (f->type == CLAST_FIELD_TEXT_LIST) {
        *(clast_text_list *)member(f, config) = (clast_text_list){0};
    } else if (f->type == CLAST_FIELD_F64_LIST) {
        *(clast_f64_list *)member(f, config) = (clast_f64_list){0};
    }
}

clast_status clast_fields_default(const clast_field *fields, void *config)
{
    CLX_ARGUMENTS(fields, config);
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        blank(f, config);
    }
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        const clast_status status = set_default(f, config);
        if (status != CLAST_OK) {
            clast_fields_free(fields, config);
            return status;
        }
    }
    return CLAST_OK;
}

int32_t clast_field_count(const clast_field *f, const void *config)
{
    if (f == NULL || config == NULL) {
        return 0;
    }
    const void *slot = member_const(f, config);
    if (f->type == CLAST_FIELD_TEXT_LIST) {
        return ((const clast_text_list *)slot)->n;
    }
    return f->type == CLAST_FIELD_F64_LIST ? ((const clast_f64_list *)slot)->n : 1;
}

static int format_choice(const clast_field *f, int32_t index, char *text, size_t size)
{
    const char *word = index >= 0 ? f->text : NULL;
    for (int32_t i = 0; i < index && word != NULL; ++i) {
        word = strchr(word, '|');
        word = word != NULL ? word + 1 : NULL;
    }
    return word == NULL ? -1 : snprintf(text, size, "%.*s", (int)strcspn(word, "|"), word);
}

static int format_text(const char *from, char *text, size_t size)
{
    return from == NULL ? -1 : snprintf(text, size, "%s", from);
}

/// Item `index` of a list field.
static int format_item(const clast_field *f, const void *slot, int32_t index, char *text,
                       size_t size)
{
    const clast_text_list *texts = slot;
    const clast_f64_list *numbers = slot;
    const bool is_text = f->type == CLAST_FIELD_TEXT_LIST;
    const int32_t n = is_text ? texts->n : numbers->n;
    if (index < 0 || index >= n || (is_text ? texts->item == NULL : numbers->item == NULL)) {
        return -1;
    }
    return is_text ? format_text(texts->item[index], text, size)
                   : clx_number_print(text, size, "%.17g", numbers->item[index]);
}

int clast_field_format(const clast_field *f, const void *config, int32_t index, size_t size,
                       char *text)
{
    if (f == NULL || config == NULL || text == NULL) {
        return -1;
    }
    const void *slot = member_const(f, config);
    switch (f->type) {
    case CLAST_FIELD_F64:
        return clx_number_print(text, size, "%.17g", *(const double *)slot);
    case CLAST_FIELD_I32:
        return snprintf(text, size, "%" PRId32, *(const int32_t *)slot);
    case CLAST_FIELD_I64:
        return snprintf(text, size, "%" PRId64, *(const int64_t *)slot);
    case CLAST_FIELD_U64:
        return snprintf(text, size, "%" PRIu64, *(const uint64_t *)slot);
    case CLAST_FIELD_BOOL:
        return snprintf(text, size, "%s", *(const bool *)slot ? "true" : "false");
    case CLAST_FIELD_CHOICE:
        return format_choice(f, *(const int32_t *)slot, text, size);
    case CLAST_FIELD_TEXT:
        return format_text(*(char *const *)slot, text, size);
    case CLAST_FIELD_TEXT_LIST:
    case CLAST_FIELD_F64_LIST:
        return format_item(f, slot, index, text, size);
    }
    return -1;
}
