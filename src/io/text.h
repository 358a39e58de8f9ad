#pragma once
// A cursor over a text in memory: lines, words, and errors that name the line.
#include "base/status.h"

typedef struct clx_text {
    const char *at, *end;
    int64_t line;      ///< of `at`, from 1
    char comment;      ///< starts a comment up to the line's end; 0: none
    bool is_continued; ///< a backslash before the line's end joins the next line
} clx_text;

typedef struct clx_word {
    const char *text;
    int64_t n;
} clx_word;

/// Cursor at the first byte; a UTF-8 byte-order mark is skipped.
clx_text clx_text_begin(const void *bytes, size_t n, char comment, bool is_continued);

/// Next word (between blanks) of this line; false at the line's end.
bool clx_text_word(clx_text *text, clx_word *word);

/// Goes to the start of the next line (after LF, CR LF or CR); false at the end of the text.
bool clx_text_next_line(clx_text *text);

/// Next word on this line or a later one; false at the end of the text.
bool clx_text_any_word(clx_text *text, clx_word *word);

/// Equal to a lower-case word, whatever the case of `word`.
bool clx_word_is(clx_word word, const char *lower);

enum { CLX_WORD_SHOWN = 48 };

/// Printable copy for messages: cut at 40 characters, strange bytes as '?'.
const char *clx_word_show(clx_word word, char shown[CLX_WORD_SHOWN]);

/// The word as a finite number.
bool clx_word_number(clx_word word, double *value);

/// The word as an integer; false for anything else or beyond 64 bits.
bool clx_word_integer(clx_word word, int64_t *value);

/// Next word of the line as a finite number; the error names line, `what` and the word.
clast_status clx_text_number(clx_text *text, const char *what, double *value);

/// Next word of the line as an integer of low .. high; the error names line, `what` and the word.
clast_status clx_text_integer(clx_text *text, const char *what, int64_t low, int64_t high,
                              int64_t *value);
