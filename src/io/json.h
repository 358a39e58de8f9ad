#pragma once
// Pieces of JSON into an output file. Errors are the file's: sticky, seen by clx_file_commit.
#include "base/file.h"

/// A text in quotes, escaped; bytes that are not UTF-8 become U+FFFD.
void clx_json_text(clx_file *file, const char *text);

/// A number that reads back as the same double; null for nan and inf, which JSON does not have.
void clx_json_number(clx_file *file, double value);
