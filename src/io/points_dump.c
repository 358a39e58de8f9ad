// LAMMPS and LIGGGHTS text dumps: snapshots of "ITEM:" sections. [LAMMPS manual, dump command]
#include "io/points.h"

#include "base/alloc.h"
#include "base/column_unit.h"
#include "io/packing.h"
#include "io/text.h"
#include <clast/cloud.h>
#include <clast/field.h>
#include <clast/table.h>
#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    clx_text text;
    const char *name;
    clx_dump_head head;
    int64_t n_atom;
    clx_word header; ///< names of the columns, the rest of the ATOMS line
    clx_text rows;   ///< cursor at the first row
} dump;

/// The rest of the current line as one word.
static clx_word rest_of_line(const clx_text *text)
{
    const char *end = text->at;
    while (end < text->end && *end != '\n' && *end != '\r') {
        ++end;
    }
    return (clx_word){text->at, end - text->at};
}

static clast_status next_line(dump *d, const char *what)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(clx_text_next_line(&d->text), CLAST_E_FORMAT, "%s: the file ends before %s", d->name,
              what);
done:
    return status;
}

/// "pp pp ff" behind BOX, after BOUNDS and perhaps "xy xz yz".
static clast_status read_boundary(dump *d)
{
    clast_status status = CLAST_OK;
    clx_word word;
    int k = 0;
    while (k < 3 && clx_text_word(&d->text, &word)) {
        CLX_CHECK(!clx_word_is(word, "abc"), CLAST_E_FORMAT,
                  "%s:%" PRId64 ": the box is a general triclinic one; clast reads orthogonal and "
                  "tilted boxes",
                  d->name, d->text.line);
        if (!clx_word_is(word, "bounds") && !clx_word_is(word, "xy") && !clx_word_is(word, "xz") &&
            !clx_word_is(word, "yz")) {
            d->head.is_periodic[k++] = word.text[0] == 'p';
        }
    }
done:
    return status;
}

/// Takes off what a tilt adds to the bounds.                      [LAMMPS manual, Howto_triclinic]
static void untilt(clx_dump_head *h)
{
    const double *t = h->tilt;
    h->low[0] -= fmin(fmin(0.0, t[0] + t[1]), fmin(t[0], t[1]));
    h->high[0] -= fmax(fmax(0.0, t[0] + t[1]), fmax(t[0], t[1]));
    h->low[1] -= fmin(0.0, t[2]);
    h->high[1] -= fmax(0.0, t[2]);
}

/// Three lines "low high [tilt]"; bounds of a tilted box hold the tilt.
static clast_status read_bounds(dump *d)
{
    clast_status status = CLAST_OK;
    clx_dump_head *h = &d->head;
    memset(h->tilt, 0, sizeof h->tilt);
    CLX_TRY(read_boundary(d));
    for (int k = 0; k < 3; ++k) {
        clx_word word;
        CLX_TRY(next_line(d, "the box's bounds"));
        CLX_TRY(clx_text_number(&d->text, "bound", &h->low[k]));
        CLX_TRY(clx_text_number(&d->text, "bound", &h->high[k]));
        if (clx_text_word(&d->text, &word)) {
            CLX_CHECK(clx_word_number(word, &h->tilt[k]), CLAST_E_FORMAT,
                      "%s:%" PRId64 ": the tilt of the box is no number", d->name, d->text.line);
        }
    }
    untilt(h);
    h->has_box = true;
done:
    return status;
}

/// The word of ITEM: UNITS, or the number of ITEM: TIMESTEP; another item's line is passed over.
static clast_status read_line(dump *d, clx_word item)
{
    clast_status status = CLAST_OK;
    clx_word word;
    CLX_TRY(next_line(d, "the end of a section"));
    if (clx_word_is(item, "timestep") &&
        (!clx_text_word(&d->text, &word) || !clx_word_integer(word, &d->head.step))) {
        d->head.step = -1;
    } else if (clx_word_is(item, "units") && clx_text_word(&d->text, &word)) {
        for (size_t i = 0; i < sizeof d->head.units; ++i) {
            const bool is_in = i + 1 < sizeof d->head.units && (int64_t)i < word.n;
            d->head.units[i] = (char)(is_in ? tolower((unsigned char)word.text[i]) : '\0');
        }
    }
done:
    return status;
}

static clast_status skip_rows(dump *d)
{
    clast_status status = CLAST_OK;
    d->header = rest_of_line(&d->text);
    CLX_CHECK(d->n_atom >= 0, CLAST_E_FORMAT, "%s:%" PRId64 ": ATOMS before NUMBER OF ATOMS",
              d->name, d->text.line);
    for (int64_t i = 0; i <= d->n_atom; ++i) {
        const bool more = clx_text_next_line(&d->text);
        if (i == 0) {
            d->rows = d->text;
        }
        CLX_CHECK(more || i == d->n_atom, CLAST_E_FORMAT,
                  "%s: %" PRId64 " atoms are declared, the file ends after %" PRId64, d->name,
                  d->n_atom, i);
    }
done:
    return status;
}

/// Goes over one snapshot; *found is false at the end of the file.
static clast_status read_frame(dump *d, bool *found)
{
    clast_status status = CLAST_OK;
    clx_word word;
    clx_word item;
    *found = false;
    d->n_atom = -1;
    d->head.step = -1;
    d->head.has_box = false;
    while (clx_text_any_word(&d->text, &word)) {
        CLX_CHECK(word.n == 5 && memcmp(word.text, "ITEM:", 5) == 0, CLAST_E_FORMAT,
                  "%s:%" PRId64 ": expected ITEM:", d->name, d->text.line);
        CLX_CHECK(clx_text_word(&d->text, &item), CLAST_E_FORMAT,
                  "%s:%" PRId64 ": empty ITEM:", d->name, d->text.line);
        if (clx_word_is(item, "atoms")) {
            CLX_TRY(skip_rows(d));
            *found = true;
            break;
        }
        if (clx_word_is(item, "number")) {
            CLX_TRY(next_line(d, "the number of atoms"));
            CLX_TRY(clx_text_integer(&d->text, "number of atoms", 0, d->text.end - d->text.at,
                                     &d->n_atom));
        } else if (clx_word_is(item, "box")) {
            CLX_TRY(read_bounds(d));
        } else { // TIMESTEP, TIME, UNITS: one line
            CLX_TRY(read_line(d, item));
        }
        CLX_TRY(next_line(d, "ITEM: ATOMS"));
    }
done:
    return status;
}

/// Columns by the names of the ATOMS line; all their cells must be numbers, texts become NaN-free
/// refusals, except "element" and "typelabel", which are left out.
static clast_status fill_rows(dump *d, clast_table *table, const bool *is_text)
{
    clast_status status = CLAST_OK;
    for (int64_t i = 0; i < d->n_atom; ++i) {
        int32_t number = 0;
        clx_word word;
        int32_t column = 0;
        for (; clx_text_word(&d->rows, &word); ++column) {
            CLX_CHECK(column < 1024, CLAST_E_FORMAT, "%s:%" PRId64 ": more than 1024 cells",
                      d->name, d->rows.line);
            if (is_text[column]) {
                continue;
            }
            CLX_CHECK(number < table->n_column &&
                          clx_word_number(word, &table->column[number].number[i]),
                      CLAST_E_FORMAT, "%s:%" PRId64 ": cell %d is no number of a known column",
                      d->name, d->rows.line, column + 1);
            ++number;
        }
        CLX_CHECK(number == table->n_column, CLAST_E_FORMAT,
                  "%s:%" PRId64 ": %d numbers for %d columns", d->name, d->rows.line, number,
                  table->n_column);
        (void)clx_text_next_line(&d->rows);
    }
done:
    return status;
}

/// Scaled coordinates xs, ys, zs as x, y, z: shares of the box's sides, of which the second and the
/// third may lean along x and y.                                  [LAMMPS manual, Howto_triclinic]
static clast_status unscale(const dump *d, clast_table *table)
{
    static const char *const scaled[3] = {"xs", "ys", "zs"};
    static const char *const plain[3] = {"x", "y", "z"};
    clast_status status = CLAST_OK;
    const clx_dump_head *h = &d->head;
    const double side[3][3] = {{h->high[0] - h->low[0], h->tilt[0], h->tilt[1]},
                               {0.0, h->high[1] - h->low[1], h->tilt[2]},
                               {0.0, 0.0, h->high[2] - h->low[2]}};
    for (int k = 0; k < 3; ++k) {
        double *column = NULL;
        if (clast_table_numbers(table, scaled[k]) == NULL ||
            clast_table_find(table, plain[k]) >= 0) {
            continue;
        }
        CLX_CHECK(h->has_box, CLAST_E_FORMAT, "%s: %s is a share of a box, which is not there",
                  d->name, scaled[k]);
        CLX_TRY(clast_table_add_number(table, plain[k], "-", &column));
        for (int64_t i = 0; i < table->n_row; ++i) {
            column[i] = h->low[k];
        }
        for (int j = k; j < 3; ++j) {
            const double *from = clast_table_numbers(table, scaled[j]);
            CLX_CHECK(from != NULL || side[k][j] == 0.0, CLAST_E_FORMAT,
                      "%s: the box is tilted, and %s without %s is no position there", d->name,
                      scaled[k], scaled[j]);
            for (int64_t i = 0; i < table->n_row && from != NULL; ++i) {
                column[i] += from[i] * side[k][j];
            }
        }
    }
done:
    return status;
}

static clast_status add_columns(const dump *d, clast_table *table, bool is_text[1024])
{
    clast_status status = CLAST_OK;
    clx_text names = clx_text_begin(d->header.text, (size_t)d->header.n, '\0', false);
    clx_word word;
    int32_t n = 0;
    while (clx_text_word(&names, &word)) {
        char name[128];
        double *column = NULL;
        CLX_CHECK(n < 1024 && word.n + 8 < (int64_t)sizeof name, CLAST_E_FORMAT,
                  "%s: column %d of ITEM: ATOMS is not a name", d->name, n + 1);
        memcpy(name, word.text, (size_t)word.n);
        name[word.n] = '\0';
        is_text[n] = strcmp(name, "element") == 0 || strcmp(name, "typelabel") == 0;
        CLX_CHECK(memchr(name, '\0', (size_t)word.n) == NULL, CLAST_E_FORMAT,
                  "%s: column %d of ITEM: ATOMS is not a name", d->name, n + 1);
        if (!is_text[n++]) {
            // a cell takes two bytes at least, so that a long header cannot claim memory
            CLX_CHECK(d->n_atom * n <= d->rows.end - d->rows.at + 1, CLAST_E_FORMAT,
                      "%s: %" PRId64 " atoms of %d columns do not fit into the file", d->name,
                      d->n_atom, n);
            for (int k = 2; clast_table_find(table, name) >= 0; ++k) { // LIGGGHTS: "id type type"
                (void)snprintf(name + word.n, sizeof name - (size_t)word.n, "_%d", k);
            }
            CLX_TRY(clx_table_add_said(table, name, name, &column));
        }
    }
done:
    return status;
}

/// The wanted snapshot; counts them first when it is named from the end.
static clast_status find_frame(dump *d, int64_t frame)
{
    clast_status status = CLAST_OK;
    const clx_text begin = d->text;
    int64_t n = 0;
    bool found = true;
    for (; found && frame < 0; n += found ? 1 : 0) {
        CLX_TRY(read_frame(d, &found));
    }
    const int64_t wanted = frame < 0 ? n + frame : frame;
    d->text = begin;
    found = wanted >= 0;
    for (int64_t k = 0; k <= wanted && found; ++k) {
        CLX_TRY(read_frame(d, &found));
        n = frame < 0 ? n : k + (found ? 1 : 0);
    }
    CLX_CHECK(found, CLAST_E_FORMAT, "%s: there is no snapshot %" PRId64 " among %" PRId64, d->name,
              frame, n);
    d->head.snapshot = wanted;
done:
    return status;
}

/// Snapshots up to the end, or to one that is cut short, from the one that was found on.
static int64_t count_snapshots(const dump *d)
{
    dump rest = *d;
    int64_t n = d->head.snapshot + 1;
    for (bool found = true; found && read_frame(&rest, &found) == CLAST_OK;) {
        n += found ? 1 : 0;
    }
    return n;
}

static clast_status read_dump(dump *d, clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_table made = {0};
    bool is_text[1024] = {false};
    CLX_TRY(clast_table_init(&made, d->name, d->n_atom));
    CLX_TRY(add_columns(d, &made, is_text));
    CLX_TRY(fill_rows(d, &made, is_text));
    CLX_TRY(unscale(d, &made));
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

clast_status clx_dump_read(const char *name, const void *bytes, size_t n, int64_t frame,
                           clast_table *table, clx_dump_head *head)
{
    clast_status status = CLAST_OK;
    dump d = {.text = clx_text_begin(bytes, n, '\0', false), .name = name, .head = {.step = -1}};
    CLX_TRY(find_frame(&d, frame));
    CLX_TRY(read_dump(&d, table));
    *head = d.head;
    head->n_snapshot = count_snapshots(&d);
done:
    return status;
}

/// Unit of a column of LAMMPS, and what takes it there: the file's own of lengths, so that it may
/// be asked for, where clast knows it, else SI; NULL: of none that is converted.
static const char *unit_of(const char *name, const clx_lammps_units *units, double *factor)
{
    static const char *const lengths[] = {"x", "y", "z", "xu", "yu", "zu", "radius", "diameter"};
    static const char *const speeds[] = {"vx", "vy", "vz"};
    for (size_t k = 0; k < sizeof lengths / sizeof lengths[0]; ++k) {
        if (strcmp(name, lengths[k]) == 0) {
            const bool is_known = clast_unit_factor(units->length, "m", factor) == CLAST_OK;
            *factor = is_known ? 1.0 : units->metre;
            return is_known ? units->length : "m";
        }
    }
    for (size_t k = 0; k < sizeof speeds / sizeof speeds[0]; ++k) {
        if (strcmp(name, speeds[k]) == 0) {
            *factor = units->metre_per_s;
            return "m/s";
        }
    }
    *factor = units->kilogram;
    return strcmp(name, "mass") == 0 ? "kg" : NULL;
}

/// Lengths, speeds and masses in units that their columns then say.
static clast_status tell_units(const clx_lammps_units *units, clast_table *table)
{
    clast_status status = CLAST_OK;
    for (int32_t c = 0; c < table->n_column; ++c) {
        clast_column *column = &table->column[c];
        double factor = 1.0;
        const char *unit = unit_of(column->name, units, &factor);
        if (unit == NULL) {
            continue;
        }
        clx_free(column->unit);
        column->unit = NULL;
        CLX_TRY(clx_alloc_text(&column->unit, unit));
        for (int64_t i = 0; i < table->n_row; ++i) {
            column->number[i] *= factor;
        }
    }
done:
    return status;
}

clast_status clx_points_dump(const char *name, const void *bytes, size_t n, int64_t frame,
                             clast_table *table, clast_points_snapshot *snapshot)
{
    clast_status status = CLAST_OK;
    clast_table made = {0};
    clx_dump_head head = {0};
    CLX_TRY(clx_dump_read(name, bytes, n, frame, &made, &head));
    const clx_lammps_units *units = clx_lammps_units_of(head.units);
    CLX_TRY(units != NULL ? tell_units(units, &made) : CLAST_OK);
    *snapshot = (clast_points_snapshot){head.snapshot + 1, head.n_snapshot, head.step};
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}
