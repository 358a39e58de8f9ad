// One file of points, read by ranks together: each reads its stretch of the bytes of a text, or of
// the rows of an HDF5 file, some at a time, so that no rank ever holds the file.
#include "io/csv_read.h"
#include "io/points.h"

#include "base/alloc.h"
#include "base/comm.h"
#include "base/number.h"
#include "cloud/columns.h"
#include <clast/cloud.h>
#include <clast/table.h>

#include <clast/machine.h>
#include <clast/status.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { HEAD = 1 << 16, ROWS = 1 << 20 };
#define PIECE (INT64_C(1) << 24) ///< bytes of a text at a time

/// A cloud that grows.
typedef struct {
    clast_cloud cloud;
    int64_t capacity;
    clx_times times;
    int32_t weight; ///< number of the column cloud.unread_weight
} sink;

/// Appends n numbers to an array of the cloud, where the piece has it and the capacity is enough.
static clast_status append(double **array, int64_t at, int64_t capacity, const double *value,
                           int64_t n)
{
    clast_status status = CLAST_OK;
    if (value == NULL) {
        return CLAST_OK;
    }
    if (*array == NULL) {
        CLX_TRY(clx_alloc(array, capacity, sizeof **array));
    }
    if (n > 0) {
        memcpy(*array + at, value, (size_t)n * sizeof *value);
    }
done:
    return status;
}

/// Appends a table's rows; `capacity` holds for all that comes.
static clast_status read_rows(sink *s, const clast_table *table, const clast_cloud_columns *columns)
{
    clast_status status = CLAST_OK;
    clast_cloud piece = {0};
    clast_cloud *c = &s->cloud;
    CLX_TRY(clx_cloud_from_part(table, columns, &piece));
    clx_times_add(table, columns, &s->times);
    const int32_t d = piece.dimension;
    CLX_CHECK(piece.n <= s->capacity - c->n && (c->x == NULL || d == c->dimension), CLAST_E_IO,
              "%s holds more than was counted in it: it changed while it was read", table->name);
    c->dimension = d;
    CLX_TRY(append(&c->x, c->n * d, s->capacity * d, piece.x, piece.n * d));
    CLX_TRY(append(&c->radius, c->n, s->capacity, piece.radius, piece.n));
    CLX_TRY(append(&c->mass, c->n, s->capacity, piece.mass, piece.n));
    CLX_TRY(append(&c->weight, c->n, s->capacity, piece.weight, piece.n));
    CLX_TRY(append(&c->velocity, c->n * d, s->capacity * d, piece.velocity, piece.n * d));
    CLX_TRY(append(&c->variable, c->n, s->capacity, piece.variable, piece.n));
    c->n += piece.n;
    const int32_t weight = clast_table_find(table, piece.unread_weight);
    if (piece.unread_weight[0] != '\0' && (c->unread_weight[0] == '\0' || weight < s->weight)) {
        memcpy(c->unread_weight, piece.unread_weight, sizeof c->unread_weight);
        s->weight = weight;
    }
done:
    clast_cloud_free(&piece);
    return status;
}

/// A text and what its first lines show.
typedef struct {
    const char *path;
    FILE *file;
    int64_t size;
    char *head; ///< the line that names the columns, made where there is none
    int64_t n_head;
    int64_t begin;     ///< byte behind it
    int64_t head_line; ///< lines before `begin`
    clast_csv_options options;
    clast_table columns; ///< of the first rows
} text;

static clast_status cannot_read(const text *t)
{
    return clx_fail(CLAST_E_IO, "cannot read %s: %s", t->path, clx_errno_text());
}

/// Reads n bytes from a place on.
static clast_status read_at(const text *t, int64_t at, char *bytes, int64_t n)
{
    errno = EIO; // of a file that became shorter
    if (fseeko(t->file, (off_t)at, SEEK_SET) != 0 ||
        fread(bytes, 1, (size_t)n, t->file) != (size_t)n) {
        return cannot_read(t);
    }
    return CLAST_OK;
}

/// Splits the head into what stands before the first row and the rest; keeps the line of names,
/// behind a byte-order mark: the reader takes one away, which may be part of the first name.
static clast_status find_begin(text *t, const char *bytes, int64_t n, bool has_header)
{
    static const char mark[] = "\xef\xbb\xbf";
    const int64_t n_mark = (int64_t)sizeof mark - 1;
    clast_status status = CLAST_OK;
    clx_csv_row row = {.next =
                           n >= n_mark && memcmp(bytes, mark, (size_t)n_mark) == 0 ? n_mark : 0};
    (void)clx_csv_next_row(bytes, n, t->options.separator, &row);
    const int64_t names = has_header ? row.next - row.begin : 64 * (int64_t)t->columns.n_column;
    CLX_TRY(clx_alloc(&t->head, n_mark + names + 2, 1));
    memcpy(t->head, mark, (size_t)n_mark);
    t->n_head = n_mark;
    if (has_header) {
        memcpy(t->head + n_mark, bytes + row.begin, (size_t)names);
        t->n_head += names; // its own line end, where it has one, goes
        t->n_head -= t->n_head > n_mark && t->head[t->n_head - 1] == '\n';
        t->n_head -= t->n_head > n_mark && t->head[t->n_head - 1] == '\r';
    }
    for (int32_t k = 0; k < t->columns.n_column && !has_header; ++k) {
        t->n_head += snprintf(t->head + t->n_head, 64, "%scolumn_%d",
                              k > 0 ? (char[2]){t->options.separator, 0} : "", k + 1);
    }
    t->head[t->n_head++] = '\n';
    t->begin = has_header ? row.next : row.begin;
    t->head_line = has_header ? row.n_line : row.line;
done:
    return status;
}

/// Bytes of the lines that are whole.
static int64_t whole_lines(const char *bytes, int64_t n)
{
    int64_t whole = n;
    while (whole > 0 && !clx_csv_begins_line(bytes, whole, n)) {
        --whole;
    }
    return whole;
}

/// The first lines: separator, names of columns, where rows begin.
static clast_status read_head(text *t)
{
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    clast_csv_report report = {0};
    int64_t n = t->size < HEAD ? t->size : HEAD;
    CLX_TRY(clx_alloc(&bytes, n + 1, 1));
    CLX_TRY(read_at(t, 0, bytes, n));
    n = n < t->size ? whole_lines(bytes, n) : n;
    CLX_CHECK(n > 0 || t->size == 0, CLAST_E_LIMIT,
              "%s: the first line is longer than %d bytes; ranks read lines", t->path, HEAD);
    CLX_TRY(clast_table_parse_csv(t->path, bytes, (size_t)n, NULL, &t->columns, &report));
    t->options = (clast_csv_options){.separator = report.separator, .header = 1};
    CLX_TRY(find_begin(t, bytes, n, report.has_header));
done:
    clx_free(bytes);
    return status;
}

static clast_status open_text(const char *path, text *t)
{
    clast_status status = CLAST_OK;
    t->path = path;
    errno = 0;
    t->file = fopen(path, "rb");
    if (t->file == NULL || fseeko(t->file, 0, SEEK_END) != 0) {
        return cannot_read(t);
    }
    t->size = (int64_t)ftello(t->file);
    CLX_TRY(read_head(t));
done:
    return status;
}

static void close_text(text *t)
{
    if (t->file != NULL) {
        (void)fclose(t->file);
    }
    clx_free(t->head);
    clast_table_free(&t->columns);
    *t = (text){0};
}

/// First line that begins at `at` or behind it.
static clast_status line_from(const text *t, int64_t at, int64_t *begin)
{
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    CLX_TRY(clx_alloc(&bytes, HEAD, 1));
    *begin = at > t->begin ? t->size : t->begin;
    for (int64_t from = at - 1; at > t->begin && from < t->size - 1 && *begin == t->size;
         from += HEAD - 1) { // the last byte again: what follows it tells whether it ends a line
        const int64_t n = t->size - from < HEAD ? t->size - from : HEAD;
        CLX_TRY(read_at(t, from, bytes, n));
        for (int64_t k = 1; k <= n && *begin == t->size; ++k) {
            *begin = clx_csv_begins_line(bytes, k, n) ? from + k : t->size;
        }
    }
done:
    clx_free(bytes);
    return status;
}

/// Rank k's stretch of the bytes: whole lines.
static clast_status own_stretch(const text *t, const clast_comm *comm, int64_t stretch[2])
{
    clast_status status = CLAST_OK;
    const double share = (double)(t->size - t->begin) / comm->n_rank;
    for (int k = 0; k < 2; ++k) {
        const int32_t number = comm->rank + k;
        CLX_TRY(number == comm->n_rank
                    ? CLAST_OK
                    : line_from(t, t->begin + (int64_t)(share * number), &stretch[k]));
        stretch[k] = number == comm->n_rank ? t->size : stretch[k];
    }
done:
    return status;
}

/// As csv_read.c reads numbers.
static bool is_number(const char *cell)
{
    static const char *const words[] = {"",    "na",   "n/a",  "nan",      "-nan",
                                        "inf", "+inf", "-inf", "infinity", "-infinity"};
    double value = 0.0;
    const char *end = cell + strlen(cell);
    bool is = clx_number_parse(cell, end, &value) == end;
    for (size_t k = 0; k < sizeof words / sizeof words[0] && !is; ++k) {
        is = strcasecmp(cell, words[k]) == 0;
    }
    return is;
}

/// Line of a row among these lines, from 0.
static int64_t line_of_row(const text *t, const char *rows, int64_t n, int64_t row)
{
    clx_csv_row at = {0};
    while (clx_csv_next_row(rows, n, t->options.separator, &at) && row > 0) {
        --row;
    }
    return at.line;
}

/// Whether the points need the numbers of column k, which are texts in this piece.
static bool is_needed(const text *t, const clast_table *piece, int32_t k,
                      const clast_cloud_columns *columns)
{
    clast_cloud none = {0};
    clast_table head = t->columns; // its columns, k of which is lent for the question
    const clast_column own = head.column[k];
    head.n_row = 0;
    head.column[k] = piece->column[k];
    const bool is = clx_cloud_from_part(&head, columns, &none) == CLAST_E_FORMAT;
    head.column[k] = own;
    clast_cloud_free(&none);
    return is;
}

/// Refuses a column of the points that holds numbers in the first rows and a text in these.
static clast_status check_columns(const text *t, const clast_table *piece, const char *rows,
                                  int64_t n, int64_t first_line, const clast_cloud_columns *columns)
{
    clast_status status = CLAST_OK;
    for (int32_t k = 0; k < piece->n_column; ++k) {
        const clast_column *c = &piece->column[k];
        int64_t row = 0;
        if (c->text == NULL || t->columns.column[k].number == NULL ||
            !is_needed(t, piece, k, columns)) {
            continue;
        }
        while (row + 1 < piece->n_row && is_number(c->text[row])) {
            ++row;
        }
        CLX_CHECK(false, CLAST_E_FORMAT, "%s:%lld: '%.40s' in column '%s' is no number", t->path,
                  (long long)(first_line + line_of_row(t, rows, n, row)), c->text[row], c->name);
    }
done:
    return status;
}

/// Whole lines of the text, below the line of names, into the cloud.
static clast_status read_lines(const text *t, const char *bytes, int64_t n, int64_t first_line,
                               const clast_cloud_columns *columns, sink *s)
{
    clast_status status = CLAST_OK;
    clast_table piece = {0};
    const char *quote = memchr(bytes + t->n_head, '"', (size_t)(n - t->n_head));
    CLX_CHECK(quote == NULL, CLAST_E_FORMAT,
              "%s:%lld: ranks read no quoted cells; take the quotes out, or run one process",
              t->path,
              (long long)(first_line +
                          clx_csv_count_lines(bytes + t->n_head, quote - bytes - t->n_head, 0)));
    CLX_TRY(clx_csv_parse_part(t->path, bytes, (size_t)n, &t->options, first_line - 1, &piece));
    CLX_TRY(check_columns(t, &piece, bytes + t->n_head, n - t->n_head, first_line, columns));
    CLX_TRY(read_rows(s, &piece, columns));
done:
    clast_table_free(&piece);
    return status;
}

/// Room for the rows of the stretch, and the lines before it.
static clast_status count_stretch(const text *t, const int64_t stretch[2], char *bytes,
                                  int64_t *n_line)
{
    clast_status status = CLAST_OK;
    char before = 0;
    *n_line = 0;
    for (int64_t at = stretch[0]; at < stretch[1]; at += PIECE) {
        const int64_t n = stretch[1] - at < PIECE ? stretch[1] - at : PIECE;
        CLX_TRY(read_at(t, at, bytes, n));
        *n_line += clx_csv_count_lines(bytes, n, before);
        before = bytes[n - 1];
    }
done:
    return status;
}

/// The stretch piece by piece; `bytes` has room for the names and two pieces.
static clast_status read_stretch(const text *t, const int64_t stretch[2], int64_t line, char *bytes,
                                 const clast_cloud_columns *columns, sink *s)
{
    clast_status status = CLAST_OK;
    int64_t kept = 0; // bytes of a line that is not whole yet
    char *const rows = bytes + t->n_head;
    CLAST_ASSERT(bytes != NULL && t->head != NULL);
    memcpy(bytes, t->head, (size_t)t->n_head);
    for (int64_t at = stretch[0]; at < stretch[1]; at += PIECE) {
        const int64_t n = stretch[1] - at < PIECE ? stretch[1] - at : PIECE;
        CLX_TRY(read_at(t, at, rows + kept, n));
        const int64_t whole = at + n < stretch[1] ? whole_lines(rows, kept + n) : kept + n;
        CLX_CHECK(whole > 0 && kept + n - whole <= PIECE, CLAST_E_LIMIT,
                  "%s:%lld: a line of more than %lld bytes", t->path, (long long)line,
                  (long long)PIECE);
        CLX_TRY(read_lines(t, bytes, t->n_head + whole, line, columns, s));
        line += clx_csv_count_lines(rows, whole, 0);
        kept = kept + n - whole;
        memmove(rows, rows + whole, (size_t)kept);
    }
    if (stretch[0] >= stretch[1]) { // no row: the columns all the same
        CLX_TRY(read_lines(t, bytes, t->n_head, line, columns, s));
    }
done:
    return status;
}

static clast_status read_text(const clast_comm *comm, const char *path,
                              const clast_cloud_columns *columns, sink *s)
{
    clast_status status = CLAST_OK;
    text t = {0};
    clast_cloud first = {0};
    char *bytes = NULL;
    int64_t stretch[2] = {0, 0};
    int64_t n_line = 0;
    int64_t before = 0;
    int64_t total = 0;
    status = open_text(path, &t);
    if (status == CLAST_OK) { // missing columns, and texts that the first rows show already
        status = clx_cloud_from_part(&t.columns, columns, &first);
    }
    if (status == CLAST_OK) {
        status = clx_alloc(&bytes, t.n_head + (t.size < 2 * PIECE ? t.size : 2 * PIECE), 1);
    }
    if (status == CLAST_OK) {
        status = own_stretch(&t, comm, stretch);
    }
    if (status == CLAST_OK) {
        status = count_stretch(&t, stretch, bytes, &n_line);
    }
    CLX_TRY(clast_comm_agree(comm, status, NULL));
    CLX_TRY(clx_comm_before(comm, n_line, &before, &total));
    s->capacity = n_line + 1; // the last line may have no end
    status = read_stretch(&t, stretch, t.head_line + before + 1, bytes, columns, s);
    CLX_TRY(clast_comm_agree(comm, status, NULL));
done:
    clast_cloud_free(&first);
    clx_free(bytes);
    close_text(&t);
    return status;
}

/// This rank's rows of an HDF5 file.
static clast_status read_h5(const clast_comm *comm, const char *path, const char *dataset,
                            const clast_cloud_columns *columns, sink *s)
{
    clast_status status = CLAST_OK;
    clast_table piece = {0};
    int64_t n_row = 0;
    CLX_TRY(clx_points_h5_rows(path, dataset, &n_row));
    const int64_t first = n_row * comm->rank / comm->n_rank;
    const int64_t end = n_row * (comm->rank + 1) / comm->n_rank;
    s->capacity = end - first;
    for (int64_t at = first; at < end || at == first; at += ROWS) {
        const clx_rows rows = {at, end - at < ROWS ? end - at : ROWS};
        CLX_TRY(clx_points_h5(path, dataset, &rows, &piece));
        CLX_TRY(read_rows(s, &piece, columns));
        clast_table_free(&piece);
    }
done:
    clast_table_free(&piece);
    return status;
}

/// What the file is by its first bytes: text, HDF5, or something that ranks do not read.
static clast_status find_kind(const char *path, bool *is_text)
{
    clast_status status = CLAST_OK;
    char head[HEAD / 16];
    const text t = {.path = path};
    errno = 0;
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return cannot_read(&t);
    }
    errno = EIO;
    const size_t n = fread(head, 1, sizeof head, file);
    const bool is_read = ferror(file) == 0;
    (void)fclose(file);
    if (!is_read) {
        return cannot_read(&t);
    }
    *is_text = clx_points_is_text(head, n);
    CLX_TRY(clx_points_check_kind(path, head, n));
    CLX_CHECK(*is_text || (n >= 4 && memcmp(head, "\x89HDF", 4) == 0), CLAST_E_FORMAT,
              "%s: ranks read delimited text and HDF5 arrays together, no other format; run one "
              "process",
              path);
done:
    return status;
}

/// The column of weights that nothing names, the first that any rank has seen.
static void agree_weight(const clast_comm *comm, sink *s)
{
    const int64_t own = s->cloud.unread_weight[0] != '\0' ? s->weight : INT32_MAX;
    const int64_t least = comm->least(comm->context, own * comm->n_rank + comm->rank);
    comm->broadcast(comm->context, (int32_t)(least % comm->n_rank), s->cloud.unread_weight,
                    (int64_t)sizeof s->cloud.unread_weight);
}

clast_status clast_cloud_read_ranks(const clast_comm *comm, const char *path,
                                    const clast_cloud_columns *columns,
                                    const clast_points_options *options, clast_cloud *cloud)
{
    CLX_ARGUMENTS(path, columns, cloud);
    clast_status status = CLAST_OK;
    const clast_comm *all = clx_comm_or_one(comm);
    const clast_points_options chosen = options != NULL ? *options : (clast_points_options){0};
    sink s = {0};
    bool is_text = false;
    CLX_CHECK(clx_comm_has_sums(all), CLAST_E_ARGUMENT, "comm has no sum or no exchange");
    CLX_TRY(clast_comm_agree(all, find_kind(path, &is_text), NULL));
    CLX_TRY(clx_points_agree(all, path));
    CLX_TRY(clast_comm_agree(all, clx_points_check_options(path, options, false, !is_text), NULL));
    if (is_text) {
        CLX_TRY(read_text(all, path, columns, &s));
    } else {
        status = read_h5(all, path, chosen.dataset, columns, &s);
        CLX_TRY(clast_comm_agree(all, status, NULL));
    }
    CLX_TRY(clx_times_check(all, path, &s.times)); // the same on all
    agree_weight(all, &s);
    *cloud = s.cloud;
    s.cloud = (clast_cloud){0};
done:
    clast_cloud_free(&s.cloud);
    return status;
}
