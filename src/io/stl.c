// STL, binary and ASCII.
//
// A binary file is 80 bytes of any text, a 32-bit count and 50 bytes a facet; many begin with
// "solid" as ASCII files do, so the count against the file's size decides, not the header. The
// stated normals are counted against the corners' but never used: writers get them wrong too often.
#include "io/mesh_io.h"

#include "base/alloc.h"
#include "geom/vertex_set.h"
#include "io/bytes.h"
#include "io/text.h"
#include "math/vec3.h"
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum { HEADER_SIZE = 80, BODY_START = 84, FACET_SIZE = 50 };

static double load_f32(const uint8_t *p)
{
    const uint32_t bits = clx_load_u32(p);
    float value = 0.0F;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

// ---- both forms: facets gathered into vertices and triangles

typedef struct {
    clx_vertex_set vertices;
    int32_t (*tri)[3];
    int64_t n_tri, capacity;
    clast_mesh_read_report *report;
} gather;

static void gather_free(gather *g)
{
    clx_vertex_set_free(&g->vertices);
    clx_free(g->tri);
}

/// Counts a stated normal that is zero, no number, or over 10 degrees off that of the corners.
static void judge_normal(gather *g, const double stated[3], double p[3][3])
{
    double u[3];
    double v[3];
    double n[3];
    const double length = v3_norm(stated);
    if (!(length > 0.0) || !isfinite(length)) {
        ++g->report->n_zero_normal;
        return;
    }
    v3_sub(u, p[1], p[0]);
    v3_sub(v, p[2], p[0]);
    v3_cross(n, u, v);
    const double cos_limit = 0.984807753012208; // cos 10 degrees
    if (v3_norm(n) > 0.0 && v3_dot(n, stated) < cos_limit * length * v3_norm(n)) {
        ++g->report->n_wrong_normal;
    }
}

static clast_status add_facet(gather *g, const double stated[3], double p[3][3])
{
    clast_status status = CLAST_OK;
    CLX_CHECK(g->n_tri < INT32_MAX, CLAST_E_LIMIT, "more than 2^31 triangles");
    CLX_TRY(clx_grow(&g->tri, &g->capacity, g->n_tri + 1, sizeof *g->tri));
    for (int k = 0; k < 3; ++k) {
        CLX_TRY(clx_vertex_set_add(&g->vertices, p[k], &g->tri[g->n_tri][k]));
    }
    judge_normal(g, stated, p);
    ++g->n_tri;
done:
    return status;
}

/// Hands the arrays over to the mesh, cut to size.
static clast_status finish(gather *g, clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_realloc(&g->vertices.vert, g->vertices.n, sizeof *g->vertices.vert));
    CLX_TRY(clx_realloc(&g->tri, g->n_tri, sizeof *g->tri));
    *mesh = (clast_mesh){.n_vert = (int32_t)g->vertices.n,
                         .n_tri = (int32_t)g->n_tri,
                         .vert = g->vertices.vert,
                         .tri = g->tri};
    g->vertices.vert = NULL;
    g->tri = NULL;
    g->report->n_facet = g->n_tri;
    if (g->report->n_wrong_normal > 0) {
        clx_report_warn(g->report,
                        "%d of %" PRId64
                        " stated normals disagree with the corners (normals are not used)",
                        g->report->n_wrong_normal, g->n_tri);
    }
done:
    return status;
}

// ---- binary

static int64_t binary_size(const uint8_t *bytes)
{
    return BODY_START + (int64_t)FACET_SIZE * clx_load_u32(bytes + HEADER_SIZE);
}

/// "solid" at the start, blanks before it allowed, in any case.
static bool says_solid(const void *bytes, size_t n)
{
    clx_text text = clx_text_begin(bytes, n, '\0', false);
    clx_word word;
    return clx_text_any_word(&text, &word) && clx_word_is(word, "solid");
}

/// Control characters that no text has, near the start.
static bool has_binary_bytes(const uint8_t *bytes, size_t n)
{
    for (size_t i = 0; i < n && i < 1024; ++i) {
        if (bytes[i] < 9 || (bytes[i] > 13 && bytes[i] < 32)) {
            return true;
        }
    }
    return false;
}

bool clx_stl_is_exact(const void *bytes, size_t n)
{
    return n >= BODY_START && binary_size(bytes) == (int64_t)n;
}

static bool is_binary(const void *bytes, size_t n)
{
    return clx_stl_is_exact(bytes, n) || !says_solid(bytes, n) || has_binary_bytes(bytes, n);
}

static clast_status check_finite(double p[3][3], int64_t facet, int64_t byte)
{
    for (int k = 0; k < 9; ++k) {
        const double x = p[k / 3][k % 3];
        if (!isfinite(x)) {
            return clx_fail(CLAST_E_FORMAT,
                            "byte %" PRId64 ": coordinate %c of corner %d of facet %" PRId64
                            " is %s, not a finite number",
                            byte + 12 + 4 * k, "xyz"[k % 3], k / 3 + 1, facet + 1,
                            isnan(x) ? "nan" : "infinite");
        }
    }
    return CLAST_OK;
}

static clast_status parse_facets(gather *g, const uint8_t *bytes, int64_t n_facet)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&g->tri, &g->capacity, n_facet, sizeof *g->tri));
    for (int64_t f = 0; f < n_facet; ++f) {
        const int64_t start = BODY_START + FACET_SIZE * f;
        double value[4][3];
        for (int k = 0; k < 12; ++k) {
            value[k / 3][k % 3] = load_f32(bytes + start + 4 * (ptrdiff_t)k);
        }
        CLX_TRY(check_finite(value + 1, f, start));
        CLX_TRY(add_facet(g, value[0], value + 1));
    }
done:
    return status;
}

static clast_status parse_binary(const uint8_t *bytes, size_t n, gather *g)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(n >= BODY_START, CLAST_E_FORMAT,
              "byte %zu: the file ends here; a binary STL has at least %d bytes (and an ASCII one "
              "begins with 'solid')",
              n, BODY_START);
    const int64_t n_facet = clx_load_u32(bytes + HEADER_SIZE);
    const int64_t size = binary_size(bytes);
    CLX_CHECK(size <= (int64_t)n, CLAST_E_FORMAT,
              "byte 80: the header promises %" PRId64 " facets (%" PRId64
              " bytes) but the file has %zu bytes, enough for %" PRId64
              "; it is cut off or not an STL",
              n_facet, size, n, ((int64_t)n - BODY_START) / FACET_SIZE);
    CLX_CHECK((int64_t)n - size < FACET_SIZE, CLAST_E_FORMAT,
              "byte 80: the header promises %" PRId64 " facets but %" PRId64
              " bytes follow them, enough for %" PRId64 " more: the count is wrong",
              n_facet, (int64_t)n - size, ((int64_t)n - size) / FACET_SIZE);
    CLX_CHECK(n_facet <= INT32_MAX / 3, CLAST_E_LIMIT,
              "%" PRId64 " facets are more than the %d that one mesh holds", n_facet,
              INT32_MAX / 3);
    g->report->is_binary = true;
    g->report->n_part = 1;
    g->report->n_trailing = (int64_t)n - size;
    CLX_TRY(parse_facets(g, bytes, n_facet));
    if (g->report->n_trailing > 0) {
        clx_report_warn(g->report,
                        "%" PRId64 " byte%s after the last of %" PRId64 " facets ignored",
                        g->report->n_trailing, g->report->n_trailing == 1 ? "" : "s", n_facet);
    }
done:
    return status;
}

// ---- ASCII

typedef struct {
    clx_text text;
    gather *gather;
    bool in_solid;
} ascii;

static clast_status expected(const ascii *a, clx_word got, const char *wanted)
{
    char shown[CLX_WORD_SHOWN];
    if (got.n == 0) {
        return clx_fail(CLAST_E_FORMAT,
                        "line %" PRId64 ": the file ends where '%s' was expected; it is cut off",
                        a->text.line, wanted);
    }
    return clx_fail(CLAST_E_FORMAT, "line %" PRId64 ": found '%s' where '%s' was expected",
                    a->text.line, clx_word_show(got, shown), wanted);
}

static clast_status expect(ascii *a, const char *wanted)
{
    clx_word word = {0};
    (void)clx_text_any_word(&a->text, &word);
    return clx_word_is(word, wanted) ? CLAST_OK : expected(a, word, wanted);
}

/// Three words after "normal"; any that is no number makes the normal zero, which is only counted.
static void parse_normal(ascii *a, double normal[3])
{
    bool good = true;
    v3_set(normal, 0.0, 0.0, 0.0);
    for (int k = 0; k < 3; ++k) {
        clx_word word;
        good = clx_text_word(&a->text, &word) && clx_word_number(word, &normal[k]) && good;
    }
    if (!good) {
        v3_set(normal, 0.0, 0.0, 0.0);
    }
}

static clast_status parse_vertex(ascii *a, double p[3])
{
    static const char *const what[3] = {"vertex coordinate x", "vertex coordinate y",
                                        "vertex coordinate z"};
    clast_status status = expect(a, "vertex");
    for (int c = 0; c < 3 && status == CLAST_OK; ++c) {
        status = clx_text_number(&a->text, what[c], &p[c]);
    }
    return status;
}

/// What follows "facet".
static clast_status parse_facet(ascii *a)
{
    clast_status status = CLAST_OK;
    double normal[3] = {0};
    double p[3][3];
    clx_word word = {0};
    (void)clx_text_any_word(&a->text, &word);
    if (clx_word_is(word, "normal")) {
        parse_normal(a, normal);
        (void)clx_text_any_word(&a->text, &word);
    }
    if (!clx_word_is(word, "outer")) {
        return expected(a, word, "outer loop");
    }
    CLX_TRY(expect(a, "loop"));
    for (int k = 0; k < 3; ++k) {
        CLX_TRY(parse_vertex(a, p[k]));
    }
    CLX_TRY(expect(a, "endloop"));
    CLX_TRY(expect(a, "endfacet"));
    CLX_TRY(add_facet(a->gather, normal, p));
done:
    return status;
}

static clast_status parse_item(ascii *a, clx_word word)
{
    if (clx_word_is(word, "facet") && a->in_solid) {
        return parse_facet(a);
    }
    if (clx_word_is(word, "endsolid")) {
        a->in_solid = false;
    } else if (clx_word_is(word, "solid") && !a->in_solid) {
        a->in_solid = true;
        ++a->gather->report->n_part;
    } else {
        return expected(a, word, a->in_solid ? "facet' or 'endsolid" : "solid");
    }
    (void)clx_text_next_line(&a->text); // the rest is a name
    return CLAST_OK;
}

static clast_status parse_ascii(const void *bytes, size_t n, gather *g)
{
    ascii a = {.text = clx_text_begin(bytes, n, '\0', false), .gather = g};
    clast_status status = CLAST_OK;
    clx_word word;
    while (status == CLAST_OK && clx_text_any_word(&a.text, &word)) {
        status = parse_item(&a, word);
    }
    if (status == CLAST_OK && g->report->n_part == 0) {
        status = expected(&a, (clx_word){0}, "solid");
    }
    if (a.in_solid) {
        clx_report_warn(g->report, "no 'endsolid' at the end: the file may be cut off");
    }
    return status;
}

clast_status clx_stl_parse(const void *bytes, size_t n, clast_mesh *mesh,
                           clast_mesh_read_report *report)
{
    gather g = {.report = report};
    clast_status status = CLAST_OK;
    CLX_TRY(is_binary(bytes, n) ? parse_binary(bytes, n, &g) : parse_ascii(bytes, n, &g));
    CLX_TRY(finish(&g, mesh));
done:
    gather_free(&g);
    return status;
}
