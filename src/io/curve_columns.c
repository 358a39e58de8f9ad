// Which columns of a sieve curve's file hold sizes and values, and what the values are: by the
// words of their names, all of which have to be known.
#include "io/curve_columns.h"

#include "cloud/columns.h"
#include <clast/table.h>
#include <ctype.h>
#include <string.h>

/// Whether a column's name is this word, alone or followed by its unit ("sieve_mm", "Size (um)").
static bool is_called(const char *name, const char *word)
{
    size_t i = 0;
    for (; word[i] != '\0'; ++i) {
        if (tolower((unsigned char)name[i]) != word[i]) {
            return false;
        }
    }
    return !isalnum((unsigned char)name[i]);
}

static int32_t find_called(const clast_table *table, const char *const *words, int32_t *n_found)
{
    int32_t found = -1;
    *n_found = 0;
    for (int32_t c = 0; c < table->n_column; ++c) {
        for (const char *const *word = words; *word != NULL; ++word) {
            if (is_called(table->column[c].name, *word)) {
                found = c;
                ++*n_found;
                break;
            }
        }
    }
    return found;
}

static const char *const size_words[] = {"sieve", "size", "diameter", "opening", "d", "phi", NULL};
static const char *const retained_words[] = {"retained", "mass", "weight", "fraction", NULL};
static const char *const passing_words[] = {"passing", "finer", "undersize", NULL};
static const char *const percent_words[] = {"pct", "percent", "percentage", NULL};
static const char *const share_words[] = {"share", "fraction", NULL};
static const char *const cumulative_words[] = {"cumulative", "cum",         "cumul",
                                               "cumulated",  "accumulated", NULL};
/// Say nothing of what the values are: that is the words above, and the unit.
static const char *const other_words[] = {
    "on",    "sieve", "sieves", "this",   "each",  "the",        "of",      "per",
    "by",    "in",    "and",    "dry",    "net",   "individual", "partial", "single",
    "class", "grain", "grains", "sample", "share", "pct",        "percent", "percentage",
    "wt",    "vol",   "kg",     "g",      "mg",    "t",          NULL};

enum { WORD_SIZE = 64 };

static bool is_one_of(const char *word, const char *const *words)
{
    bool is_found = false;
    for (; *words != NULL; ++words) {
        is_found = is_found || strcmp(word, *words) == 0;
    }
    return is_found;
}

/// The next word of a column's name in lower case, "" at its end; returns the place after it.
static const char *next_word(const char *at, char word[WORD_SIZE])
{
    size_t n = 0;
    while (*at != '\0' && !isalnum((unsigned char)*at)) {
        ++at;
    }
    for (; isalnum((unsigned char)*at); ++at) {
        if (n + 1 < WORD_SIZE) {
            word[n++] = (char)tolower((unsigned char)*at);
        }
    }
    word[n] = '\0';
    return at;
}

static bool is_number(const char *word)
{
    return word[strspn(word, "0123456789")] == '\0';
}

static bool has_word(const char *name, const char *const *words)
{
    char word[WORD_SIZE];
    bool is_found = false;
    for (name = next_word(name, word); word[0] != '\0'; name = next_word(name, word)) {
        is_found = is_found || is_one_of(word, words);
    }
    return is_found;
}

/// What the values of a column are, by all words of its name: one that is not known may turn the
/// meaning of the others round.
static clast_status kind_of(const char *file, const char *name, clx_curve_kind *kind)
{
    clast_status status = CLAST_OK;
    char word[WORD_SIZE];
    const char *at = name;
    const bool is_passing = has_word(name, passing_words);
    for (at = next_word(at, word); word[0] != '\0'; at = next_word(at, word)) {
        CLX_CHECK(is_one_of(word, retained_words) || is_one_of(word, passing_words) ||
                      is_one_of(word, cumulative_words) || is_one_of(word, other_words) ||
                      is_number(word),
                  CLAST_E_FORMAT,
                  "%s: column '%s': '%s' is not understood; call it retained (on this sieve), "
                  "cumulative retained (on this and all coarser ones) or passing, with its unit",
                  file, name, word);
        CLX_CHECK(!is_passing || strcmp(word, "retained") != 0, CLAST_E_FORMAT,
                  "%s: column '%s' is called both retained and passing", file, name);
    }
    *kind = is_passing                         ? CLX_CURVE_PASSING
            : has_word(name, cumulative_words) ? CLX_CURVE_CUMULATIVE
                                               : CLX_CURVE_RETAINED;
done:
    return status;
}

/// "retained (%)", "pct retained", "mass_fraction", but no "fraction (g)".
static double whole_of(const clast_column *column)
{
    const bool is_plain = strcmp(column->unit, "-") == 0;
    if (strcmp(column->unit, "%") == 0 || (is_plain && (strchr(column->name, '%') != NULL ||
                                                        has_word(column->name, percent_words)))) {
        return 100.0;
    }
    return is_plain && has_word(column->name, share_words) ? 1.0 : 0.0;
}

/// Columns with one of the words anywhere in their name, where none begins with one: "% passing".
static int32_t find_inside(const clast_table *table, int32_t size, const char *const *words,
                           int32_t *n_found)
{
    int32_t found = -1;
    *n_found = 0;
    for (int32_t c = 0; c < table->n_column; ++c) {
        if (c != size && has_word(table->column[c].name, words)) {
            found = c;
            ++*n_found;
        }
    }
    return found;
}

static clast_status find_value(const char *file, const clast_table *table,
                               clx_curve_columns *columns)
{
    clast_status status = CLAST_OK;
    int32_t n_retained = 0;
    int32_t n_passing = 0;
    int32_t retained = find_called(table, retained_words, &n_retained);
    int32_t passing = find_called(table, passing_words, &n_passing);
    if (n_retained + n_passing == 0) {
        passing = find_inside(table, columns->size, passing_words, &n_passing);
        retained = find_inside(table, columns->size, retained_words, &n_retained);
        n_retained -= retained >= 0 && retained == passing; // "% mass passing"
    }
    CLX_CHECK(n_retained + n_passing == 1, CLAST_E_FORMAT,
              "%s: %d columns are called retained, mass, weight or fraction and %d passing, finer "
              "or undersize; a sieve curve has one of them",
              file, n_retained, n_passing);
    columns->value = n_passing == 1 ? passing : retained;
    columns->whole = whole_of(&table->column[columns->value]);
    CLX_TRY(kind_of(file, table->column[columns->value].name, &columns->kind));
done:
    return status;
}

clast_status clx_curve_columns_find(const char *file, const clast_table *table,
                                    clx_curve_columns *columns)
{
    clast_status status = CLAST_OK;
    int32_t n_size = 0;
    columns->size = find_called(table, size_words, &n_size);
    CLX_CHECK(n_size == 1, CLAST_E_FORMAT,
              "%s: %d columns are called sieve, size, diameter, opening, d or phi; a sieve curve "
              "has one, with its unit (sieve_mm)",
              file, n_size);
    CLX_TRY(find_value(file, table, columns));
    for (int k = 0; k < 2; ++k) {
        const clast_column *column = &table->column[k == 0 ? columns->size : columns->value];
        if (column->number == NULL) {
            CLX_TRY(clx_cloud_no_column(table, column->name));
        }
    }
done:
    return status;
}
