// Wavefront OBJ: vertices and polygons; all else (texture, normals, lines, curves) carries no
// surface and is passed over.
//
// Two passes over the text, vertices first, since a face may name vertices that come later. The
// fourth number of a vertex is a weight of rational curves, not a divisor; numbers after it are
// colours.
#include "io/mesh_build.h"
#include "io/mesh_io.h"
#include "io/text.h"
#include <inttypes.h>

typedef struct {
    clx_text text;
    clx_mesh_build *build;
    int64_t n_before; ///< vertices above the line at hand, for negative numbers
    int64_t n_object, n_group, n_other;
    int64_t other_line; ///< first line of a kind that is passed over
    clx_word other;
} obj;

/// Kinds of lines that are no surface and no loss.
static bool is_decoration(clx_word word)
{
    static const char *const known[] = {"vt", "vn", "vp", "s", "usemtl", "mtllib", "lod"};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; ++i) {
        if (clx_word_is(word, known[i])) {
            return true;
        }
    }
    return false;
}

static clast_status read_vertex(obj *o)
{
    static const char *const what[3] = {"vertex coordinate x", "vertex coordinate y",
                                        "vertex coordinate z"};
    double p[3];
    clast_status status = CLAST_OK;
    for (int k = 0; k < 3 && status == CLAST_OK; ++k) {
        status = clx_text_number(&o->text, what[k], &p[k]);
    }
    return status == CLAST_OK ? clx_build_vertex(o->build, p) : status;
}

static void note_other(obj *o, clx_word word)
{
    if (o->n_other++ == 0) {
        o->other = word;
        o->other_line = o->text.line;
    }
}

static clast_status vertex_line(obj *o, clx_word word)
{
    if (clx_word_is(word, "v")) {
        return read_vertex(o);
    }
    if (clx_word_is(word, "o")) {
        ++o->n_object;
    } else if (clx_word_is(word, "g")) {
        ++o->n_group;
    } else if (!clx_word_is(word, "f") && !is_decoration(word)) {
        note_other(o, word);
    }
    return CLAST_OK;
}

/// "7", "7/1", "7//3", "7/1/3" or "-1": the number before the slash, from 0.
static clast_status corner_index(const obj *o, clx_word word, int64_t *index)
{
    clast_status status = CLAST_OK;
    char shown[CLX_WORD_SHOWN];
    clx_word head = {word.text, 0};
    const int64_t n_vert = o->build->mesh.n_vert;
    int64_t number = 0;
    while (head.n < word.n && word.text[head.n] != '/') {
        ++head.n;
    }
    CLX_CHECK(clx_word_integer(head, &number), CLAST_E_FORMAT,
              "line %" PRId64 ": face corner '%s' is not a vertex number", o->text.line,
              clx_word_show(word, shown));
    CLX_CHECK(number != 0, CLAST_E_FORMAT,
              "line %" PRId64 ": face corner 0: OBJ counts vertices from 1", o->text.line);
    const int64_t known = number > 0 ? n_vert : o->n_before;
    const int64_t place = number > 0 ? number - 1 : known + number;
    CLX_CHECK(place >= 0, CLAST_E_FORMAT,
              "line %" PRId64 ": face corner %" PRId64 " with %" PRId64 " vertices above it",
              o->text.line, number, known);
    CLX_CHECK(place < known, CLAST_E_FORMAT,
              "line %" PRId64 ": face corner %" PRId64 " of %" PRId64 " vertices", o->text.line,
              number, known);
    *index = place;
done:
    return status;
}

static clast_status face_line(obj *o, clx_word word)
{
    clast_status status = CLAST_OK;
    int64_t index = 0;
    o->n_before += clx_word_is(word, "v");
    if (!clx_word_is(word, "f")) {
        return CLAST_OK;
    }
    const int64_t line = o->text.line;
    while (clx_text_word(&o->text, &word)) {
        CLX_TRY(corner_index(o, word, &index));
        CLX_TRY(clx_build_corner(o->build, index));
    }
    status = clx_build_polygon(o->build);
    if (status != CLAST_OK) {
        clx_fail_prefix("line %" PRId64, line);
    }
done:
    return status;
}

static clast_status each_line(obj *o, const void *bytes, size_t n,
                              clast_status (*visit)(obj *o, clx_word word))
{
    clast_status status = CLAST_OK;
    o->text = clx_text_begin(bytes, n, '#', true);
    do {
        clx_word word;
        if (clx_text_word(&o->text, &word)) {
            status = visit(o, word);
        }
    } while (status == CLAST_OK && clx_text_next_line(&o->text));
    return status;
}

clast_status clx_obj_parse(const void *bytes, size_t n, clast_mesh *mesh,
                           clast_mesh_read_report *report)
{
    clast_status status = CLAST_OK;
    char shown[CLX_WORD_SHOWN];
    clx_mesh_build build = {.report = report};
    obj o = {.build = &build};
    CLX_TRY(each_line(&o, bytes, n, vertex_line));
    CLX_CHECK(build.mesh.n_vert > 0, CLAST_E_FORMAT,
              "no line 'v x y z' in %" PRId64 " lines: no surface here, or not an OBJ",
              o.text.line);
    CLX_TRY(each_line(&o, bytes, n, face_line));
    report->n_part = (int32_t)(o.n_object > 0 ? o.n_object : o.n_group);
    report->n_part = report->n_part > 0 ? report->n_part : 1;
    report->n_ignored = o.n_other;
    CLX_TRY(clx_build_finish(&build, mesh));
    if (o.n_other > 0) {
        clx_report_warn(report,
                        "%" PRId64 " lines of other kinds passed over, first line %" PRId64 " '%s'",
                        o.n_other, o.other_line, clx_word_show(o.other, shown));
    }
done:
    clx_build_free(&build);
    return status;
}
