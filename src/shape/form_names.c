// Names of columns that a user gives: those of a form, or of anything.
#include <clast/form.h>

#include "base/field.h"
#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

static bool is_letter(char c)
{
    return isalpha((unsigned char)c) || c == '/';
}

/// Whether only a unit follows, if anything: "", " (mm)", "_mm".
static bool is_last(const char *after)
{
    const char next = after[strspn(after, " _")];
    return next == '\0' || next == '(' || next == '[' ||
           (after[0] == '_' && clx_unit_is_known(after + 1));
}

/// Whether it is a word of the name, in whatever case; a letter is one at the beginning, and as a
/// capital at the end (mean L), where a small one is a unit (time_s).
static bool has_word(const char *name, const char *word)
{
    const size_t n = strlen(word);
    for (const char *at = name; *at != '\0'; ++at) {
        const bool begins =
            at == name || (n > 1 ? !is_letter(at[-1])
                                 : isupper((unsigned char)*at) && strchr(" _-.", at[-1]) != NULL &&
                                       is_last(at + 1));
        if (begins && strncasecmp(at, word, n) == 0 && !is_letter(at[n])) {
            return true;
        }
    }
    return false;
}

/// Whether the name, which ends at a comma or with the text, has a word of the role.
static bool has_role(const char *name, const char *const words[])
{
    char text[256];
    name += strspn(name, " ");
    (void)snprintf(text, sizeof text, "%.*s", (int)strcspn(name, ","), name);
    bool has = false;
    for (; *words != NULL && !has; ++words) {
        has = has_word(text, *words);
    }
    return has;
}

bool clast_form_columns_named(const char *columns)
{
    static const char *const ratio[][4] = {{"flatness", "fl", "s/i"}, {"elongation", "el", "i/l"}};
    static const char *const length[][6] = {{"l", "long", "longest", "major", "length"},
                                            {"i", "intermediate", "middle", "width"},
                                            {"s", "short", "shortest", "minor", "thickness"}};
    int n = 1;
    if (columns == NULL || columns[0] == '\0') {
        return true;
    }
    for (const char *at = columns; *at != '\0'; ++at) {
        n += *at == ',' ? 1 : 0;
    }
    bool has = n == 2 || n == 3;
    const char *at = columns;
    for (int k = 0; k < n && has; ++k) {
        has = has_role(at, n == 2 ? ratio[k] : length[k]);
        at += strcspn(at, ",") + 1;
    }
    return has;
}
