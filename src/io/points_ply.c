// Vertices of a PLY file as points: every number of a vertex is a column. (ply*.c read surfaces.)
#include "io/points.h"

#include "base/alloc.h"
#include "io/ply.h"
#include <clast/table.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    const char *name;
    const clx_ply *ply;
    clx_text text;     ///< ASCII
    const uint8_t *at; ///< binary
    const uint8_t *end;
} reader;

static clast_status cut_off(const reader *r)
{
    return clx_fail(CLAST_E_FORMAT, "%s: the file ends before its last vertex", r->name);
}

static clast_status next_number(reader *r, clx_ply_type type, double *value)
{
    clast_status status = CLAST_OK;
    const int32_t size = clx_ply_size(type);
    clx_word word = {0};
    if (r->ply->is_ascii) {
        CLX_CHECK(clx_text_word(&r->text, &word), CLAST_E_FORMAT,
                  "%s:%" PRId64 ": fewer numbers than the header says", r->name, r->text.line);
        CLX_CHECK(clx_word_number(word, value), CLAST_E_FORMAT,
                  "%s:%" PRId64 ": '%.*s' is no number", r->name, r->text.line,
                  (int)(word.n < 40 ? word.n : 40), word.text);
        return CLAST_OK;
    }
    if (r->end - r->at < size) {
        return cut_off(r);
    }
    *value = clx_ply_decode(r->at, type, r->ply->is_big_endian);
    r->at += size;
done:
    return status;
}

static clast_status skip_list(reader *r, const clx_ply_property *p)
{
    clast_status status = CLAST_OK;
    double n = 0.0;
    double item = 0.0;
    CLX_TRY(next_number(r, p->count_type, &n));
    CLX_CHECK(n >= 0.0 && n < 0x1p32, CLAST_E_FORMAT, "%s: a list of %g items", r->name, n);
    for (int64_t k = 0; k < (int64_t)n; ++k) {
        CLX_TRY(next_number(r, p->type, &item));
    }
done:
    return status;
}

/// One row of an element; value [number of properties] or NULL.
static clast_status read_row(reader *r, const clx_ply_element *e, double *value)
{
    clast_status status = CLAST_OK;
    for (int32_t k = 0; k < e->n_property; ++k) {
        const clx_ply_property *p = &r->ply->property[e->first + k];
        double number = 0.0;
        CLX_TRY(p->is_list ? skip_list(r, p) : next_number(r, p->type, &number));
        if (value != NULL) {
            value[k] = number;
        }
    }
    if (r->ply->is_ascii) {
        (void)clx_text_next_line(&r->text);
    }
done:
    return status;
}

static clast_status add_columns(const clx_ply *ply, const clx_ply_element *e, double *const *value,
                                clast_table *table)
{
    clast_status status = CLAST_OK;
    for (int32_t k = 0; k < e->n_property; ++k) {
        const clx_ply_property *p = &ply->property[e->first + k];
        char shown[CLX_WORD_SHOWN];
        if (!p->is_list) {
            CLX_CHECK(clast_table_find(table, clx_word_show(p->name, shown)) < 0, CLAST_E_FORMAT,
                      "%s: two properties of a vertex are both called '%s'; give each a name of "
                      "its own",
                      table->name, shown);
            CLX_TRY(clx_points_add(table, shown, 1, value[k]));
        }
    }
done:
    return status;
}

static clast_status read_vertices(reader *r, const clx_ply_element *e, clast_table *table)
{
    clast_status status = CLAST_OK;
    double row[CLX_PLY_N_PROPERTY];
    double *value[CLX_PLY_N_PROPERTY] = {NULL};
    CLX_TRY(clast_table_init(table, r->name, e->n_row));
    for (int32_t k = 0; k < e->n_property; ++k) {
        CLX_TRY(clx_alloc(&value[k], e->n_row, sizeof *value[k]));
    }
    for (int64_t i = 0; i < e->n_row; ++i) {
        CLX_TRY(read_row(r, e, row));
        for (int32_t k = 0; k < e->n_property; ++k) {
            double *const column = value[k];
            if (column != NULL) {
                column[i] = row[k];
            }
        }
    }
    CLX_TRY(add_columns(r->ply, e, value, table));
done:
    for (int32_t k = 0; k < e->n_property; ++k) {
        clx_free(value[k]);
    }
    return status;
}

static bool joins_points(const clx_ply_element *e)
{
    return e->n_row > 0 && (clx_word_is(e->name, "face") || clx_word_is(e->name, "tristrips"));
}

clast_status clx_points_ply(const char *name, const void *bytes, size_t n, clast_table *table,
                            bool *has_faces)
{
    clast_status status = CLAST_OK;
    clx_ply ply = {0};
    clast_table made = {0};
    status = clx_ply_header(bytes, n, &ply);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", name);
        return status;
    }
    const char *end = (const char *)bytes + n;
    reader r = {.name = name,
                .ply = &ply,
                .at = (const uint8_t *)ply.body,
                .end = (const uint8_t *)end,
                .text = clx_text_begin(ply.body, (size_t)(end - ply.body), '\0', false)};
    r.text.line = ply.body_line;
    for (int32_t k = 0; k < ply.n_element && has_faces != NULL; ++k) {
        *has_faces = *has_faces || joins_points(&ply.element[k]);
    }
    for (int32_t k = 0; k < ply.n_element; ++k) {
        const clx_ply_element *e = &ply.element[k];
        if (clx_word_is(e->name, "vertex")) {
            CLX_TRY(read_vertices(&r, e, &made));
            *table = made;
            made = (clast_table){0};
            goto done;
        }
        for (int64_t i = 0; i < e->n_row; ++i) {
            CLX_TRY(read_row(&r, e, NULL));
        }
    }
    status = clx_fail(CLAST_E_FORMAT, "%s: the header has no element 'vertex'", name);
done:
    clast_table_free(&made);
    return status;
}
