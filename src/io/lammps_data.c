// LAMMPS and LIGGGHTS data files: a line of comment, counts, a box, sections "Atoms", "Ellipsoids",
// "Velocities", ... [LAMMPS manual, read_data command]
//
// Atoms of styles sphere (LIGGGHTS: granular, sphere) and ellipsoid become a table with the columns
// of a dump: id, type, diameter, density, x, y, z, then shapex, shapey, shapez, quatw, quati,
// quatj, quatk, 0 for atoms that are no ellipsoid.
#include "io/packing.h"

#include "base/alloc.h"
#include "base/status.h"
#include "io/text.h"
#include <clast/table.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ID, TYPE, DIAMETER, DENSITY, X, SHAPE = 7, QUATERNION = 10, N_COLUMN = 14 };

static const char *const column_names[N_COLUMN] = {
    "id",     "type",   "diameter", "density", "x",     "y",     "z",
    "shapex", "shapey", "shapez",   "quatw",   "quati", "quatj", "quatk"};

/// Sections whose rows are passed over, and by what they are counted.
static const char *const known_sections[] = {"Masses", "Velocities", "Pair", "PairIJ"};

typedef struct {
    clx_text text;
    const char *name;
    int64_t n_atom, n_type, n_ellipsoid;
    clast_table table;
    int64_t *order; ///< [2 n_atom] ids and rows, once the atoms are there, sorted by id
    bool is_ellipsoid, has_atoms;
    clast_packing_frame frame;
} data;

/// Words of the current line, which the cursor stays on.
static int split(clx_text text, int most, clx_word *word)
{
    int n = 0;
    while (n < most && clx_text_word(&text, &word[n])) {
        ++n;
    }
    return n;
}

bool clx_is_lammps_data(const void *bytes, size_t n)
{
    clx_text text = clx_text_begin(bytes, n, '#', false);
    for (int line = 0; line < 64 && clx_text_next_line(&text); ++line) {
        clx_word word[3];
        int64_t count = 0;
        if (split(text, 3, word) == 2 && clx_word_integer(word[0], &count) &&
            clx_word_is(word[1], "atoms")) {
            return true;
        }
    }
    return false;
}

static clast_status fail(const data *d, const char *what)
{
    return clx_fail(CLAST_E_FORMAT, "%s:%" PRId64 ": %s", d->name, d->text.line, what);
}

/// Goes to the next line that says something; its words. 0 at the end of the file.
static int next_words(data *d, int most, clx_word *word)
{
    while (clx_text_next_line(&d->text)) {
        const int n = split(d->text, most, word);
        if (n > 0) {
            return n;
        }
    }
    return 0;
}

/// "low high xlo xhi" and the like, or "xy xz yz".
static void read_box(data *d, int n, const clx_word *word)
{
    static const char *const bound[3] = {"xhi", "yhi", "zhi"};
    double value[3];
    for (int k = 0; k < 3 && n == 4; ++k) {
        if (clx_word_is(word[3], bound[k]) && clx_word_number(word[0], &value[0]) &&
            clx_word_number(word[1], &value[1])) {
            d->frame.low[k] = value[0];
            d->frame.high[k] = value[1];
            d->frame.has_box[k] = true;
        }
    }
    if (n == 6 && clx_word_is(word[5], "yz") && clx_word_number(word[0], &value[0]) &&
        clx_word_number(word[1], &value[1]) && clx_word_number(word[2], &value[2])) {
        memcpy(d->frame.tilt, value, sizeof value);
    }
}

/// "boundary p p f" in the first line, as clast writes it.
static void read_title(data *d)
{
    clx_text line = d->text;
    clx_word word;
    line.comment = 0;
    while (clx_text_word(&line, &word) && !clx_word_is(word, "boundary")) {
    }
    for (int k = 0; k < 3 && clx_text_word(&line, &word); ++k) {
        d->frame.is_periodic[k] = clx_word_is(word, "p");
    }
}

/// A line of the header; *is_header is false at the first section.
static clast_status read_header_line(data *d, int n, const clx_word *word, bool *is_header)
{
    clast_status status = CLAST_OK;
    int64_t count = 0;
    double tilt = 0.0;
    const bool is_count = clx_word_integer(word[0], &count);
    const clx_word last = word[n - 1];
    *is_header = is_count || clx_word_number(word[0], &tilt);
    if (is_count && n == 2 && clx_word_is(last, "atoms")) {
        CLX_CHECK(count >= 0 && count <= d->text.end - d->text.at, CLAST_E_FORMAT,
                  "%s:%" PRId64 ": %" PRId64 " atoms are announced, the file holds fewer", d->name,
                  d->text.line, count);
        d->n_atom = count;
    } else if (is_count && n == 2 && clx_word_is(last, "ellipsoids")) {
        d->n_ellipsoid = count;
    } else if (is_count && n == 3 && clx_word_is(last, "types")) {
        d->n_type = clx_word_is(word[1], "atom") ? count : d->n_type;
    } else if (*is_header && n == 4 &&
               (clx_word_is(last, "avec") || clx_word_is(last, "bvec") ||
                clx_word_is(last, "cvec"))) {
        return fail(d,
                    "the box is a general triclinic one; clast reads orthogonal and tilted boxes");
    } else if (*is_header && n == 2 &&
               (clx_word_is(last, "bodies") || clx_word_is(last, "lines") ||
                clx_word_is(last, "triangles")) &&
               count > 0) {
        return fail(d, "bodies, lines and triangles are no grains that clast reads");
    }
    read_box(d, n, word);
done:
    return status;
}

/// Style of "Atoms # sphere", where it says one.
static clast_status read_style(data *d)
{
    clx_text line = d->text;
    clx_word word;
    char shown[CLX_WORD_SHOWN];
    line.comment = 0;
    (void)clx_text_word(&line, &word);
    if (!clx_text_word(&line, &word)) {
        d->is_ellipsoid = d->n_ellipsoid > 0;
        return CLAST_OK;
    }
    if (word.n == 1 && word.text[0] == '#' && !clx_text_word(&line, &word)) {
        d->is_ellipsoid = d->n_ellipsoid > 0;
        return CLAST_OK;
    }
    d->is_ellipsoid = clx_word_is(word, "ellipsoid");
    return d->is_ellipsoid || clx_word_is(word, "sphere") || clx_word_is(word, "granular")
               ? CLAST_OK
               : clx_fail(CLAST_E_FORMAT,
                          "%s:%" PRId64 ": atoms of style '%s'; clast reads sphere, granular and "
                          "ellipsoid, which have a size",
                          d->name, d->text.line, clx_word_show(word, shown));
}

/// The next row of a section as numbers; which word is none is told.
static clast_status read_row(data *d, const char *section, int least, int most, double *value)
{
    clast_status status = CLAST_OK;
    clx_word word[16];
    char shown[CLX_WORD_SHOWN];
    const int n = next_words(d, 16, word);
    CLX_CHECK(n > 0, CLAST_E_FORMAT, "%s: the file ends within section %s", d->name, section);
    CLX_CHECK(n >= least && n <= most, CLAST_E_FORMAT,
              "%s:%" PRId64 ": %d words, a row of %s has %d", d->name, d->text.line, n, section,
              least);
    for (int k = 0; k < n; ++k) {
        CLX_CHECK(clx_word_number(word[k], &value[k]), CLAST_E_FORMAT,
                  "%s:%" PRId64 ": word %d, '%s', is no number", d->name, d->text.line, k + 1,
                  clx_word_show(word[k], shown));
    }
done:
    return status;
}

static int by_id(const void *a, const void *b)
{
    const int64_t x = *(const int64_t *)a;
    const int64_t y = *(const int64_t *)b;
    return x < y ? -1 : x > y ? 1 : 0;
}

static clast_status sort_ids(data *d)
{
    clast_status status = CLAST_OK;
    const double *id = d->table.column[ID].number;
    CLX_TRY(clx_alloc(&d->order, 2 * d->n_atom, sizeof *d->order));
    for (int64_t i = 0; i < d->n_atom; ++i) {
        CLX_CHECK(id[i] >= 0.0 && id[i] < 9e15 && id[i] == (double)(int64_t)id[i], CLAST_E_FORMAT,
                  "%s: atom %" PRId64 " has the id %g", d->name, i + 1, id[i]);
        d->order[2 * i] = (int64_t)id[i];
        d->order[2 * i + 1] = i;
    }
    qsort(d->order, (size_t)d->n_atom, 2 * sizeof *d->order, by_id);
    for (int64_t i = 1; i < d->n_atom; ++i) {
        CLX_CHECK(d->order[2 * i] != d->order[2 * (i - 1)], CLAST_E_FORMAT,
                  "%s: two atoms have the id %" PRId64, d->name, d->order[2 * i]);
    }
done:
    return status;
}

/// Row of an id, or -1.
static int64_t row_of(const data *d, double id)
{
    const int64_t wanted[2] = {(int64_t)fmax(-1.0, fmin(id, 9e15)), 0};
    const int64_t *found =
        d->n_atom > 0 && id == floor(id)
            ? bsearch(wanted, d->order, (size_t)d->n_atom, 2 * sizeof *d->order, by_id)
            : NULL;
    return found != NULL ? found[1] : -1;
}

/// id type diameter density x y z, or id type flag density x y z; then perhaps three images.
static clast_status read_atoms(data *d)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(!d->has_atoms, CLAST_E_FORMAT, "%s:%" PRId64 ": a second section Atoms", d->name,
              d->text.line);
    CLX_TRY(read_style(d));
    for (int k = 0; k < (d->is_ellipsoid ? N_COLUMN : SHAPE); ++k) {
        CLX_TRY(clast_table_add_number(&d->table, column_names[k], "-", NULL));
    }
    for (int64_t i = 0; i < d->n_atom; ++i) {
        double value[16] = {0.0};
        CLX_TRY(read_row(d, "Atoms", 7, 10, value));
        for (int k = 0; k < SHAPE; ++k) {
            d->table.column[k].number[i] = value[k];
        }
    }
    CLX_TRY(sort_ids(d));
    d->has_atoms = true;
done:
    return status;
}

/// id shapex shapey shapez quatw quati quatj quatk
static clast_status read_ellipsoids(data *d)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(d->has_atoms && d->is_ellipsoid, CLAST_E_FORMAT,
              "%s:%" PRId64 ": Ellipsoids stand behind Atoms of style ellipsoid", d->name,
              d->text.line);
    for (int64_t i = 0; i < d->n_ellipsoid; ++i) {
        double value[16] = {0.0};
        CLX_TRY(read_row(d, "Ellipsoids", 8, 8, value));
        const int64_t row = row_of(d, value[0]);
        CLX_CHECK(row >= 0, CLAST_E_FORMAT, "%s:%" PRId64 ": there is no atom %g", d->name,
                  d->text.line, value[0]);
        for (int k = SHAPE; k < N_COLUMN; ++k) {
            d->table.column[k].number[row] = value[k - SHAPE + 1];
        }
    }
done:
    return status;
}

/// Goes over the rows of a section whose contents are not needed.
static clast_status skip_section(data *d, clx_word section)
{
    clx_word word[16];
    char shown[CLX_WORD_SHOWN];
    int64_t n_row = -1;
    for (size_t k = 0; k < sizeof known_sections / sizeof *known_sections; ++k) {
        const size_t length = strlen(known_sections[k]);
        if (section.n == (int64_t)length && memcmp(section.text, known_sections[k], length) == 0) {
            n_row = k == 1 ? d->n_atom : d->n_type;
        }
    }
    if (n_row < 0) {
        return clx_fail(CLAST_E_FORMAT,
                        "%s:%" PRId64 ": section '%s' is none that clast reads (Atoms, "
                        "Ellipsoids, Velocities, Masses)",
                        d->name, d->text.line, clx_word_show(section, shown));
    }
    for (int64_t i = 0; i < n_row; ++i) {
        if (next_words(d, 16, word) == 0) {
            return clx_fail(CLAST_E_FORMAT, "%s: the file ends within section %s", d->name,
                            clx_word_show(section, shown));
        }
    }
    return CLAST_OK;
}

static clast_status read_sections(data *d)
{
    clast_status status = CLAST_OK;
    clx_word word[16];
    bool is_header = true;
    read_title(d);
    for (int n = next_words(d, 16, word); n > 0; n = next_words(d, 16, word)) {
        if (is_header) {
            CLX_TRY(read_header_line(d, n, word, &is_header));
        }
        if (is_header) {
            continue;
        }
        if (d->table.name == NULL) {
            CLX_CHECK(d->n_atom > 0, CLAST_E_FORMAT, "%s: no atoms are announced", d->name);
            CLX_TRY(clast_table_init(&d->table, "packing", d->n_atom));
        }
        if (clx_word_is(word[0], "atoms")) {
            CLX_TRY(read_atoms(d));
        } else if (clx_word_is(word[0], "ellipsoids")) {
            CLX_TRY(read_ellipsoids(d));
        } else {
            CLX_TRY(skip_section(d, word[0]));
        }
    }
    CLX_CHECK(d->has_atoms, CLAST_E_FORMAT, "%s: there is no section Atoms", d->name);
done:
    return status;
}

clast_status clx_lammps_data(const char *name, const void *bytes, size_t n, clast_table *table,
                             clast_packing_frame *frame)
{
    data d = {.text = clx_text_begin(bytes, n, '#', false), .name = name, .frame = {.step = -1}};
    const clast_status status = read_sections(&d);
    if (status == CLAST_OK) {
        *table = d.table;
        d.table = (clast_table){0};
        *frame = d.frame;
    }
    clx_free(d.order);
    clast_table_free(&d.table);
    return status;
}
