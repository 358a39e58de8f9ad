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

// Results as objects of Jansson's.

typedef struct json_t json_t;

/// A number, or null for nan and inf.
CLX_SHARED void clx_json_set_number(json_t *object, const char *key, double value);
void clx_json_set_count(json_t *object, const char *key, int64_t value);

/// The object as a text, of clx_alloc_text.
CLX_SHARED clast_status clx_json_dump(const json_t *object, char **text);
