/* Property: ranks read a text of points as one process does, whatever ends its lines.
 *
 * They found lines by LF alone, and the table's reader by CR too: of a header that ends in CR each
 * rank read the next row again, and rows that end in CR were written beyond the block. */
#include "support.h"

#include "../fuzz/points_parts.h"
#include "base/file.h"
#include "math/rng.h"

enum { N_TEXT = 300, MOST_RANKS = 8 };

typedef struct {
    char *bytes;
    size_t n, capacity;
} text;

static void add(text *t, const char *words)
{
    const size_t n = strlen(words);
    assert_true(t->n + n < t->capacity);
    memcpy(t->bytes + t->n, words, n);
    t->n += n;
}

static const char *pick(clx_rng *rng, const char *const *words, int n)
{
    return words[clx_rng_below(rng, n)];
}

/// Line ends of one text: all alike, or any.
static const char *line_end(clx_rng *rng, int kind)
{
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    return kind < 3 ? ends[kind] : pick(rng, ends, 3);
}

/// A row of three cells: numbers, or names where there is no number.
static void add_row(text *t, const char *separator, int64_t i, bool is_named)
{
    char row[100];
    if (i < 0) {
        (void)snprintf(row, sizeof row, "x%sy%sid", separator, separator);
    } else {
        (void)snprintf(row, sizeof row, "%.3f%s%d%s%s%d", 0.25 * (double)i, separator, (int)(7 * i),
                       separator, is_named ? "p" : "", (int)i);
    }
    add(t, row);
}

/// Some rows between remarks and blank lines, and now and then a cell or a row that is refused, or
/// texts from some row on in a column that nobody asks for.
static void make_text(clx_rng *rng, text *t)
{
    static const char *const between[] = {"", "", "", "", "# no row", "   ", "\t# neither", "\n\r"};
    static const char *const separators[] = {",", ";", "\t", " "};
    static const char *const wrong[] = {"zwei", "", "na", "\t", "1,2,3,4"};
    const char *separator = pick(rng, separators, 4);
    const int kind = (int)clx_rng_below(rng, 4);
    const int64_t n = clx_rng_below(rng, clx_rng_below(rng, 2) == 0 ? 8 : 6000);
    const int64_t names_from = clx_rng_below(rng, 2) == 0 ? n : clx_rng_below(rng, n + 1);
    const int64_t wrong_row = clx_rng_below(rng, 4) == 0 ? clx_rng_below(rng, n + 1) : n;
    t->n = 0;
    add(t, clx_rng_below(rng, 5) == 0 ? "\xef\xbb\xbf" : "");
    for (int64_t i = clx_rng_below(rng, 4) == 0 ? 0 : -1; i < n; ++i) {
        const char *other = pick(rng, i == wrong_row ? wrong : between, i == wrong_row ? 5 : 8);
        add(t, other);
        add(t, other[0] != '\0' ? line_end(rng, kind) : "");
        add_row(t, separator, i, i >= names_from);
        add(t, i + 1 < n || clx_rng_below(rng, 2) == 0 ? line_end(rng, kind) : "");
    }
}

static void write_text(const char *path, const text *t)
{
    CHECK_OK(clx_file_write_all(path, t->bytes, t->n));
}

static void any_text_reads_as_by_one_process(void **state)
{
    (void)state;
    text t = {.capacity = 1 << 20};
    const char *path = support_scratch_file("points.csv");
    t.bytes = test_malloc(t.capacity);
    for (uint64_t k = 0; k < N_TEXT; ++k) {
        clx_rng rng = clx_rng_at(21, CLX_STREAM_TEST, k);
        make_text(&rng, &t);
        write_text(path, &t);
        const int32_t n_rank = 1 + (int32_t)clx_rng_below(&rng, MOST_RANKS);
        if (!reads_alike(path, t.bytes, t.n, n_rank)) {
            fail_msg("text %d, %d ranks: %s", (int)k, (int)n_rank, clast_error_detail());
        }
    }
    test_free(t.bytes);
}

/* A text is read 16 MiB at a time: the line end at that place is one of every kind. */
static void line_ends_at_the_end_of_a_piece_are_seen_whole(void **state)
{
    (void)state;
    enum { PIECE = 1 << 24 };
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    text t = {.capacity = PIECE + 100};
    const char *path = support_scratch_file("long.csv");
    t.bytes = test_malloc(t.capacity);
    for (int k = 0; k < 9; ++k) {
        t.n = 0;
        add(&t, "x,y\n0,1\n");
        const size_t remark = PIECE + 4 - t.n - (size_t)(k / 3); // rows begin at byte 4
        memset(t.bytes + t.n, '#', remark);
        memset(t.bytes + t.n + remark / 2, '\n', 1); // a line is shorter than a piece
        t.n += remark;
        add(&t, ends[k % 3]);
        add(&t, "2,3\n4,5\n");
        write_text(path, &t);
        assert_true(reads_alike(path, t.bytes, t.n, 1));
    }
    test_free(t.bytes);
}

static char changing[512];
enum { ROWS = 100000 };

/// Between counting and reading the file gets ten times as many rows in as many bytes.
static void change_file(void *context, int64_t *value, int64_t n)
{
    replay_sum(context, value, n);
    FILE *file = fopen(changing, "r+b");
    for (int i = 0; file != NULL && i < 5 * ROWS; ++i) {
        (void)fputs(i == 0 ? "x\n" : "1\n", file);
    }
    if (file != NULL) {
        (void)fclose(file);
    }
}

/* The only bound was an assertion, which a release build leaves out. */
static void file_that_changes_meanwhile_is_refused(void **state)
{
    (void)state;
    static char x[] = "x";
    char *name = x;
    const clast_cloud_columns columns = {.columns = {.n = 1, .item = &name}};
    replay r = {0};
    clast_cloud cloud = {0};
    const clast_comm comm = {.n_rank = 2,
                             .least = replay_least,
                             .broadcast = replay_broadcast,
                             .sum = change_file,
                             .exchange = replay_exchange,
                             .context = &r};
    (void)snprintf(changing, sizeof changing, "%s", support_scratch_file("changing.csv"));
    FILE *file = fopen(changing, "wb");
    assert_non_null(file);
    for (int i = 0; i < ROWS; ++i) {
        (void)fputs(i == 0 ? "x\n" : "123456789\n", file);
    }
    (void)fclose(file);
    CHECK_STATUS(clast_cloud_read_ranks(&comm, changing, &columns, NULL, &cloud), CLAST_E_IO);
    assert_non_null(strstr(clast_error_detail(), "it changed while it was read"));
    assert_null(cloud.x);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_text_reads_as_by_one_process),
        cmocka_unit_test(line_ends_at_the_end_of_a_piece_are_seen_whole),
        cmocka_unit_test(file_that_changes_meanwhile_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
