#pragma once
// Pieces of JSON into an output file. Errors are the file's: sticky, seen by clx_file_commit.
#include "base/status.h"

typedef struct clx_file clx_file;

enum { CLX_JSON_STEP = 8 };

/// Escapes the next character of a text into out [*n bytes]; returns the place after it.
CLX_SHARED const char *clx_json_next(const char *text, char out[CLX_JSON_STEP], size_t *n);

/// A text in quotes, escaped; bytes that are not UTF-8 become U+FFFD.
void clx_json_text(clx_file *file, const char *text);

/// A number that reads back as the same double; null for nan and inf, which JSON does not have.
void clx_json_number(clx_file *file, double value);
