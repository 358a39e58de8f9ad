// Names of columns that a user gives: those of a form, or of anything.
#include <clast/form.h>

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static bool is_letter(char c)
{
    return isalpha((unsigned char)c) || c == '/';
}

/// Whether it is a word of the name; a letter is one at its beginning, else a unit (time_s).
static bool has_word(const char *name, const char *word)
{
    const size_t n = strlen(word);
    for (const char *at = strstr(name, word); at != NULL; at = strstr(at + 1, word)) {
        if ((at == name || (n > 1 && !is_letter(at[-1]))) && !is_letter(at[n])) {
            return true;
        }
    }
    return false;
}

bool clast_form_columns_named(const char *columns)
{
    enum { N_WORD = 16 };
    static const char *const ratio[N_WORD] = {"flatness", "elongation", "fl", "el", "s/i", "i/l"};
    static const char *const length[N_WORD] = {
        "l",     "i",        "s",     "long",  "longest", "intermediate", "middle",
        "short", "shortest", "major", "minor", "length",  "width",        "thickness"};
    if (columns == NULL) {
        return true;
    }
    const char *const second = strchr(columns, ',');
    const char *const *word = second != NULL && strchr(second + 1, ',') != NULL ? length : ratio;
    bool has = true;
    for (const char *at = columns; *at != '\0' && has;) {
        char name[256];
        const size_t n = strcspn(at, ",");
        (void)snprintf(name, sizeof name, "%.*s", (int)n, at);
        for (char *x = name; *x != '\0'; ++x) {
            *x = (char)tolower((unsigned char)*x);
        }
        has = false;
        for (int k = 0; k < N_WORD && word[k] != NULL && !has; ++k) {
            has = has_word(name, word[k]);
        }
        at += n + (at[n] == ',' ? 1 : 0);
    }
    return has;
}
