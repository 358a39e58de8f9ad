#pragma once
// Pieces of an HTML page into an output file. Errors are the file's: sticky, seen by
// clx_file_commit.
#include <stdbool.h>
#include <stddef.h>

typedef struct clx_file clx_file;

/// Text with & < > " ' escaped; control characters and bytes that are not UTF-8 become U+FFFD.
/// Safe in elements and in quoted attributes.
void clx_page_text(clx_file *file, const char *text);

/// A path for href="": every byte but letters, digits and -._~/ as %XX.
void clx_page_href(clx_file *file, const char *path);

/// Bytes as base64.
void clx_page_base64(clx_file *file, const void *bytes, size_t n);

/// An SVG document as an inline element: prolog left out, each id and each reference to it begun
/// with `prefix`, since the ids of two drawings on one page would clash.
void clx_page_svg(clx_file *file, const char *svg, size_t n, const char *prefix);

/// Everything up to <main>: style, title, and the policy that allows only the page's own script.
void clx_page_begin(clx_file *file, const char *title);

/// From </main> on, with the script if `has_view`.
void clx_page_end(clx_file *file, bool has_view);
