// OFF (Object File Format): counts, one vertex a line, one polygon a line; '#' starts a comment.
//
// COFF, NOFF, CNOFF, STOFF and so on carry more numbers behind the coordinates; these are passed
// over, as are colours behind a polygon.
#include "io/mesh_build.h"
#include "io/mesh_io.h"
#include "io/text.h"
#include <inttypes.h>
#include <string.h>

bool clx_off_is_magic(const char *text, size_t n)
{
    static const char *const prefix[] = {"ST", "C", "N"};
    clx_text t = clx_text_begin(text, n, '#', false);
    clx_word word;
    if (!clx_text_any_word(&t, &word)) {
        return false;
    }
    for (int i = 0; i < 3; ++i) {
        const int64_t length = (int64_t)strlen(prefix[i]);
        if (word.n > length && memcmp(word.text, prefix[i], (size_t)length) == 0) {
            word.text += length;
            word.n -= length;
        }
    }
    return word.n == 3 && memcmp(word.text, "OFF", 3) == 0;
}

static clast_status read_magic(clx_text *text)
{
    clast_status status = CLAST_OK;
    char shown[CLX_WORD_SHOWN];
    clx_word word = {0};
    const bool found = clx_off_is_magic(text->at, (size_t)(text->end - text->at));
    (void)clx_text_any_word(text, &word);
    CLX_CHECK(found, CLAST_E_FORMAT,
              "line %" PRId64 ": found '%s' where 'OFF' (or COFF, NOFF, STOFF) was expected",
              text->line, clx_word_show(word, shown));
    if (clx_text_word(text, &word)) {
        CLX_CHECK(!clx_word_is(word, "binary"), CLAST_E_FORMAT,
                  "line %" PRId64 ": binary OFF is not read; save it as text", text->line);
        text->at = word.text; // the counts stand on the same line
    }
done:
    return status;
}

/// Goes to the next line that holds a word.
static clast_status find_row(clx_text *text, const char *what, int64_t row, int64_t n_row)
{
    clx_word word;
    if (!clx_text_any_word(text, &word)) {
        return clx_fail(CLAST_E_FORMAT,
                        "line %" PRId64 ": the file ends at %s %" PRId64 " of %" PRId64
                        "; it is cut off",
                        text->line, what, row + 1, n_row);
    }
    text->at = word.text;
    return CLAST_OK;
}

/// Three counts, each of them no more than the rest of the file can hold.
static clast_status read_counts(clx_text *text, int64_t *n_vert, int64_t *n_face)
{
    clast_status status = CLAST_OK;
    int64_t n_edge = 0;
    clx_word word;
    CLX_CHECK(clx_text_any_word(text, &word), CLAST_E_FORMAT,
              "line %" PRId64 ": the file ends before its counts", text->line);
    text->at = word.text;
    CLX_TRY(clx_text_integer(text, "vertex count", 0, INT64_MAX, n_vert));
    CLX_TRY(clx_text_integer(text, "face count", 0, INT64_MAX, n_face));
    CLX_TRY(clx_text_integer(text, "edge count", INT64_MIN, INT64_MAX, &n_edge));
    const int64_t n_left = text->end - text->at;
    CLX_CHECK(*n_vert <= n_left / 6 + 1 && *n_face <= n_left / 2 + 1, CLAST_E_FORMAT,
              "line %" PRId64 ": %" PRId64 " vertices and %" PRId64
              " faces are promised but only %" PRId64 " bytes follow",
              text->line, *n_vert, *n_face, n_left);
    (void)clx_text_next_line(text);
done:
    return status;
}

static clast_status read_vertices(clx_text *text, int64_t n_vert, clx_mesh_build *build)
{
    static const char *const what[3] = {"vertex coordinate x", "vertex coordinate y",
                                        "vertex coordinate z"};
    clast_status status = CLAST_OK;
    for (int64_t i = 0; i < n_vert; ++i) {
        double p[3] = {0};
        CLX_TRY(find_row(text, "vertex", i, n_vert));
        for (int k = 0; k < 3; ++k) {
            CLX_TRY(clx_text_number(text, what[k], &p[k]));
        }
        CLX_TRY(clx_build_vertex(build, p));
        (void)clx_text_next_line(text);
    }
done:
    return status;
}

static clast_status read_face(clx_text *text, int64_t n_vert, clx_mesh_build *build)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    int64_t index = 0;
    const int64_t line = text->line;
    CLX_TRY(clx_text_integer(text, "number of corners", 0, INT32_MAX, &n));
    for (int64_t k = 0; k < n; ++k) {
        CLX_TRY(clx_text_integer(text, "vertex number", 0, n_vert - 1, &index));
        CLX_TRY(clx_build_corner(build, index));
    }
    status = clx_build_polygon(build);
    if (status != CLAST_OK) {
        clx_fail_prefix("line %" PRId64, line);
    }
done:
    return status;
}

static clast_status read_faces(clx_text *text, int64_t n_face, clx_mesh_build *build)
{
    clast_status status = CLAST_OK;
    for (int64_t i = 0; i < n_face; ++i) {
        CLX_TRY(find_row(text, "face", i, n_face));
        CLX_TRY(read_face(text, build->mesh.n_vert, build));
        (void)clx_text_next_line(text);
    }
done:
    return status;
}

clast_status clx_off_parse(const void *bytes, size_t n, clast_mesh *mesh,
                           clast_mesh_read_report *report)
{
    clast_status status = CLAST_OK;
    clx_mesh_build build = {.report = report};
    clx_text text = clx_text_begin(bytes, n, '#', false);
    clx_word word;
    char shown[CLX_WORD_SHOWN];
    int64_t n_vert = 0;
    int64_t n_face = 0;
    CLX_TRY(read_magic(&text));
    CLX_TRY(read_counts(&text, &n_vert, &n_face));
    CLX_TRY(clx_build_reserve(&build, n_vert, n_face));
    CLX_TRY(read_vertices(&text, n_vert, &build));
    CLX_TRY(read_faces(&text, n_face, &build));
    CLX_CHECK(!clx_text_any_word(&text, &word), CLAST_E_FORMAT,
              "line %" PRId64 ": '%s' follows the last of %" PRId64 " faces: the counts are wrong",
              text.line, clx_word_show(word, shown), n_face);
    report->n_part = 1;
    CLX_TRY(clx_build_finish(&build, mesh));
done:
    clx_build_free(&build);
    return status;
}
