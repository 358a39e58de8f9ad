// HTML: escaping, base64, inline SVG, the frame of the page.
//
// Nothing that comes from a file reaches the page unescaped, and the page's Content-Security-Policy
// allows no script but the one with our digest and no connection at all, so that a hostile name in
// a run folder can neither run code nor call home.                                 [CSP level 3]
#include "report/page.h"

#include "base/file.h"
#include "io/sha256.h"
#include "report/web.h"
#include <clast/status.h>
#include <string.h>

static const char replacement[] = "\357\277\275";

/// Bytes of the UTF-8 character at `at`, or 0 if it is none.                    [RFC 3629]
static int utf8_length(const unsigned char *at)
{
    const int n = at[0] < 0x80                    ? 1
                  : at[0] >= 0xC2 && at[0] < 0xE0 ? 2
                  : at[0] >= 0xE0 && at[0] < 0xF0 ? 3
                  : at[0] >= 0xF0 && at[0] < 0xF5 ? 4
                                                  : 0;
    for (int i = 1; i < n; ++i) {
        if ((at[i] & 0xC0) != 0x80) {
            return 0;
        }
    }
    const bool is_overlong = (at[0] == 0xE0 && at[1] < 0xA0) || (at[0] == 0xF0 && at[1] < 0x90);
    const bool is_surrogate = at[0] == 0xED && at[1] >= 0xA0;
    const bool is_beyond = at[0] == 0xF4 && at[1] >= 0x90;
    return is_overlong || is_surrogate || is_beyond ? 0 : n;
}

static const char *entity(unsigned char c)
{
    switch (c) {
    case '&':
        return "&amp;";
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '"':
        return "&quot;";
    case '\'':
        return "&#39;";
    default:
        return (c < 0x20 && c != '\n' && c != '\t') || c == 0x7F ? replacement : NULL;
    }
}

void clx_page_text(clx_file *file, const char *text)
{
    const unsigned char *at = (const unsigned char *)text;
    while (*at != '\0') {
        const int n = utf8_length(at);
        const char *other = n == 0 ? replacement : n == 1 ? entity(*at) : NULL;
        if (other != NULL) {
            (void)clx_file_write(file, other, strlen(other));
        } else {
            (void)clx_file_write(file, at, (size_t)n);
        }
        at += n > 0 ? n : 1;
    }
}

void clx_page_href(clx_file *file, const char *path)
{
    static const char plain[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    for (const char *c = path; *c != '\0'; ++c) {
        if (strchr(plain, *c) != NULL) {
            (void)clx_file_write(file, c, 1);
        } else {
            (void)clx_file_print(file, "%%%02X", (unsigned)(unsigned char)*c);
        }
    }
}

static void encode3(const unsigned char *in, size_t n, char out[4])
{
    CLAST_ASSERT(n >= 1);
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned v = (unsigned)in[0] << 16 | (n > 1 ? (unsigned)in[1] << 8 : 0U) |
                       (n > 2 ? (unsigned)in[2] : 0U);
    out[0] = digit[v >> 18 & 63];
    out[1] = digit[v >> 12 & 63];
    out[2] = n > 1 ? digit[v >> 6 & 63] : '=';
    out[3] = n > 2 ? digit[v & 63] : '=';
}

void clx_page_base64(clx_file *file, const void *bytes, size_t n)
{
    enum { BLOCK = 3 * 256 };
    const unsigned char *in = bytes;
    char out[BLOCK / 3 * 4];
    while (n > 0) {
        const size_t part = n < BLOCK ? n : BLOCK;
        size_t used = 0;
        for (size_t i = 0; i < part; i += 3) {
            encode3(in + i, part - i, out + used);
            used += 4;
        }
        (void)clx_file_write(file, out, used);
        in += part;
        n -= part;
    }
}

/// Length of id=", href="# or url(# at `at`, or 0.
static size_t reference_at(const char *at, size_t n)
{
    static const char *const marks[] = {" id=\"", "href=\"#", "url(#"};
    for (size_t k = 0; k < sizeof marks / sizeof *marks; ++k) {
        const size_t length = strlen(marks[k]);
        if (n >= length && memcmp(at, marks[k], length) == 0) {
            return length;
        }
    }
    return 0;
}

void clx_page_svg(clx_file *file, const char *svg, size_t n, const char *prefix)
{
    size_t begin = 0;
    while (begin + 4 <= n && memcmp(svg + begin, "<svg", 4) != 0) {
        ++begin;
    }
    size_t copied = begin;
    for (size_t i = begin; i < n; ++i) {
        const size_t length = reference_at(svg + i, n - i);
        if (length > 0) {
            (void)clx_file_write(file, svg + copied, i + length - copied);
            (void)clx_file_write(file, prefix, strlen(prefix));
            i += length - 1;
            copied = i + 1;
        }
    }
    if (copied < n) {
        (void)clx_file_write(file, svg + copied, n - copied);
    }
}

/// Digest of our script as the policy wants it.
static void write_script_digest(clx_file *file)
{
    char hex[65];
    unsigned char digest[32];
    clx_sha256 sha = clx_sha256_begin();
    clx_sha256_add(&sha, clx_web_view_js, clx_web_view_js_size);
    clx_sha256_end(&sha, hex);
    for (int i = 0; i < 32; ++i) {
        const char *digits = "0123456789abcdef";
        digest[i] = (unsigned char)((strchr(digits, hex[2 * i]) - digits) << 4 |
                                    (strchr(digits, hex[2 * i + 1]) - digits));
    }
    clx_page_base64(file, digest, sizeof digest);
}

void clx_page_begin(clx_file *file, const char *title)
{
    (void)clx_file_print(
        file, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
              "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
              "img-src data:; style-src 'unsafe-inline'; script-src 'sha256-");
    write_script_digest(file);
    (void)clx_file_print(file,
                         "'; base-uri 'none'; form-action 'none'\">\n"
                         "<meta name=\"viewport\" content=\"width=device-width, "
                         "initial-scale=1\">\n<meta name=\"generator\" content=\"clast %s\">\n"
                         "<title>",
                         clast_version());
    clx_page_text(file, title);
    (void)clx_file_print(file, "</title>\n<style>\n");
    (void)clx_file_write(file, clx_web_page_css, clx_web_page_css_size);
    (void)clx_file_print(file, "</style>\n</head>\n<body>\n<main>\n");
}

void clx_page_end(clx_file *file, bool has_view)
{
    (void)clx_file_print(file, "<footer>Written by clast %s.", clast_version());
    if (has_view) {
        (void)clx_file_print(file, " The 3-D view uses three.js (MIT licence, \302\251 three.js "
                                   "authors).");
    }
    (void)clx_file_print(file, "</footer>\n</main>\n");
    if (has_view) {
        (void)clx_file_print(file, "<script>");
        (void)clx_file_write(file, clx_web_view_js, clx_web_view_js_size);
        (void)clx_file_print(file, "</script>\n");
    }
    (void)clx_file_print(file, "</body>\n</html>\n");
}
