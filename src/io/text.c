// A cursor over a text in memory: lines, words, and errors that name the line.
#include "io/text.h"

#include "base/number.h"
#include <inttypes.h>
#include <math.h>
#include <string.h>

clx_text clx_text_begin(const void *bytes, size_t n, char comment, bool is_continued)
{
    static const char mark[3] = {(char)0xEF, (char)0xBB, (char)0xBF};
    const char *begin = bytes;
    const bool marked = n >= sizeof mark && memcmp(begin, mark, sizeof mark) == 0;
    return (clx_text){.at = marked ? begin + sizeof mark : begin,
                      .end = n > 0 ? begin + n : begin,
                      .line = 1,
                      .comment = comment,
                      .is_continued = is_continued};
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

static bool is_line_end(char c)
{
    return c == '\n' || c == '\r';
}

static const char *after_line_end(const char *p, const char *end)
{
    return p + (*p == '\r' && p + 1 < end && p[1] == '\n' ? 2 : 1);
}

/// A backslash that stands right before the end of its line.
static bool joins(const clx_text *t, const char *p)
{
    return t->is_continued && *p == '\\' && p + 1 < t->end && is_line_end(p[1]);
}

static void skip_blanks(clx_text *t)
{
    for (;;) {
        while (t->at < t->end && is_blank(*t->at)) {
            ++t->at;
        }
        if (t->at == t->end || !joins(t, t->at)) {
            return;
        }
        t->at = after_line_end(t->at + 1, t->end);
        ++t->line;
    }
}

bool clx_text_word(clx_text *t, clx_word *word)
{
    skip_blanks(t);
    const char *p = t->at;
    while (p < t->end && !is_blank(*p) && !is_line_end(*p) &&
           !(t->comment != '\0' && *p == t->comment) && !joins(t, p)) {
        ++p;
    }
    *word = (clx_word){t->at, p - t->at};
    t->at = p;
    return word->n > 0;
}

bool clx_text_next_line(clx_text *t)
{
    bool in_comment = false; // a backslash at the end of a comment joins nothing
    const char *p = t->at;
    while (p < t->end && !is_line_end(*p)) {
        in_comment = in_comment || (t->comment != '\0' && *p == t->comment);
        if (!in_comment && joins(t, p)) {
            p = after_line_end(p + 1, t->end);
            ++t->line;
        } else {
            ++p;
        }
    }
    if (p < t->end) {
        p = after_line_end(p, t->end);
        ++t->line;
    }
    t->at = p;
    return p < t->end;
}

bool clx_text_any_word(clx_text *t, clx_word *word)
{
    while (!clx_text_word(t, word)) {
        if (!clx_text_next_line(t)) {
            return false;
        }
    }
    return true;
}

bool clx_word_is(clx_word word, const char *lower)
{
    for (int64_t i = 0; i < word.n; ++i) {
        const char c = word.text[i];
        const char low = c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
        if (lower[i] == '\0' || lower[i] != low) {
            return false;
        }
    }
    return lower[word.n] == '\0';
}

const char *clx_word_show(clx_word word, char shown[CLX_WORD_SHOWN])
{
    const int64_t limit = CLX_WORD_SHOWN - 8;
    int64_t n = 0;
    for (; n < word.n && n < limit; ++n) {
        const char c = word.text[n];
        shown[n] = c;
        if (c < ' ' || c > '~') {
            shown[n] = '?';
        }
    }
    memcpy(shown + n, "...", 4);
    if (word.n <= limit) {
        shown[n] = '\0';
    }
    return shown;
}

bool clx_word_number(clx_word word, double *value)
{
    const char *end = word.text + word.n;
    return word.n > 0 && clx_number_parse(word.text, end, value) == end && isfinite(*value);
}

bool clx_word_integer(clx_word word, int64_t *value)
{
    const bool negative = word.n > 0 && word.text[0] == '-';
    int64_t i = word.n > 0 && (negative || word.text[0] == '+') ? 1 : 0;
    int64_t v = 0;
    if (i == word.n) {
        return false;
    }
    for (; i < word.n; ++i) {
        const char c = word.text[i];
        if (c < '0' || c > '9' || v > (INT64_MAX - 9) / 10) {
            return false;
        }
        v = 10 * v + (c - '0');
    }
    *value = negative ? -v : v;
    return true;
}

clast_status clx_text_number(clx_text *t, const char *what, double *value)
{
    clx_word word;
    char shown[CLX_WORD_SHOWN];
    if (!clx_text_word(t, &word)) {
        return clx_fail(CLAST_E_FORMAT, "line %" PRId64 ": %s is missing", t->line, what);
    }
    if (!clx_word_number(word, value)) {
        return clx_fail(CLAST_E_FORMAT, "line %" PRId64 ": %s '%s' is not a finite number%s",
                        t->line, what, clx_word_show(word, shown),
                        word.n > 0 && memchr(word.text, ',', (size_t)word.n) != NULL
                            ? "; write a decimal point"
                            : "");
    }
    return CLAST_OK;
}

clast_status clx_text_integer(clx_text *t, const char *what, int64_t low, int64_t high,
                              int64_t *value)
{
    clx_word word;
    char shown[CLX_WORD_SHOWN];
    if (!clx_text_word(t, &word)) {
        return clx_fail(CLAST_E_FORMAT, "line %" PRId64 ": %s is missing", t->line, what);
    }
    if (!clx_word_integer(word, value)) {
        return clx_fail(CLAST_E_FORMAT, "line %" PRId64 ": %s '%s' is not a whole number", t->line,
                        what, clx_word_show(word, shown));
    }
    if (*value < low || *value > high) {
        return clx_fail(CLAST_E_FORMAT,
                        "line %" PRId64 ": %s %" PRId64 " is outside %" PRId64 " .. %" PRId64,
                        t->line, what, *value, low, high);
    }
    return CLAST_OK;
}
