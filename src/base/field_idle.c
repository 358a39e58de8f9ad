// Fields that a run would not look at.
#include "base/field.h"

#include "base/status.h"
#include <clast/field.h>
#include <string.h>

/// Whether "a|b|c" has the word.
static bool has_word(const char *words, const char *word)
{
    const size_t n = strlen(word);
    for (const char *at = strstr(words, word); at != NULL; at = strstr(at + 1, word)) {
        if ((at == words || at[-1] == '|') && (at[n] == '\0' || at[n] == '|')) {
            return true;
        }
    }
    return false;
}

bool clast_field_is_default(const clast_field *field, const void *config)
{
    if (field == NULL || config == NULL) {
        return true;
    }
    union {
        int64_t number;
        double real;
        char *text;
        clast_text_list texts;
        clast_f64_list numbers;
    } usual = {0};
    clast_field alone[2] = {*field};
    char own[64];
    char other[64];
    alone->offset = 0;
    if (clast_fields_default(alone, &usual) != CLAST_OK) {
        return true;
    }
    const char *const slot = (const char *)config + field->offset;
    const int32_t n = clast_field_count(alone, slot);
    bool is_same = n == clast_field_count(alone, &usual);
    for (int32_t k = 0; k < n && is_same; ++k) {
        if (field->type == CLAST_FIELD_TEXT) {
            is_same = strcmp(*(char *const *)slot, usual.text) == 0;
        } else if (field->type == CLAST_FIELD_TEXT_LIST) {
            is_same = strcmp(((const clast_text_list *)slot)->item[k], usual.texts.item[k]) == 0;
        } else {
            (void)clast_field_format(alone, slot, k, sizeof own, own);
            (void)clast_field_format(alone, &usual, k, sizeof other, other);
            is_same = strcmp(own, other) == 0;
        }
    }
    clast_fields_free(alone, &usual);
    return is_same;
}

const clast_field *clast_fields_idle(const clast_field *fields, const void *config,
                                     const clast_idle *rules, const char **why)
{
    if (fields == NULL || config == NULL || rules == NULL || why == NULL) {
        return NULL;
    }
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        for (const clast_idle *r = rules; r->names != NULL; ++r) {
            if (r->is_idle && has_word(r->names, f->name) && !clast_field_is_default(f, config)) {
                *why = r->why;
                return f;
            }
        }
    }
    return NULL;
}

clast_status clx_fields_idle(const clast_field *fields, const void *config, const clast_idle *rules)
{
    const char *why = NULL;
    const clast_field *idle = clast_fields_idle(fields, config, rules, &why);
    return idle == NULL ? CLAST_OK
                        : clx_fail(CLAST_E_CONFIG, "%s does nothing %s", idle->name, why);
}

const clast_idle *clx_idle_copy(const clast_idle *made, clast_idle *rules)
{
    memcpy(rules, made, CLAST_N_IDLE * sizeof *made);
    return rules;
}
