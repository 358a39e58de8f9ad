// The runs of a study: rows of a table, lists of values, realisations.
//
// A design is a list of axes, each a list of rows that give values to some keys. The CSV is one
// axis; a grid makes an axis of each `vary` entry, a zip makes one of them all; seeds are the last.
#include "study/study.h"

#include "base/alloc.h"
#include "base/field.h"
#include "base/number.h"
#include "io/csv_read.h"
#include <clast/table.h>
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const clast_field clast_study_fields[] = {
    {"run", .offset = offsetof(clast_study_config, run), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "command to run: aggregate, decompose, fill, ...", ""},
    {"config", .offset = offsetof(clast_study_config, config), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "YAML configuration that all runs share", ""},
    {"argument", .offset = offsetof(clast_study_config, argument), CLAST_FIELD_TEXT_LIST, 0, 0, 0,
     "-", "argument that all runs share, such as an input file", ""},
    {"fix", .offset = offsetof(clast_study_config, set), CLAST_FIELD_TEXT_LIST, 0, 0, 0, "-",
     "key=value that all runs share", ""},
    {"vary", .offset = offsetof(clast_study_config, vary), CLAST_FIELD_TEXT_LIST, 0, 0, 0, "-",
     "key=a|b|c: values that the runs take", ""},
    {"design", .offset = offsetof(clast_study_config, design), CLAST_FIELD_CHOICE, 0, 0, 0, "-",
     "values of several vary: all combinations, or first with first, second with second",
     "grid|zip"},
    {"table", .offset = offsetof(clast_study_config, table), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "CSV with a run a row, a key a column", ""},
    {"seeds", .offset = offsetof(clast_study_config, seeds), CLAST_FIELD_I32, 1, 1, 1e6, "-",
     "realisations of each", NULL},
    {"seed", .offset = offsetof(clast_study_config, seed), CLAST_FIELD_I64, -1, -1,
     9007199253740992.0, "-",
     "seed of the first realisation (-1: that of the configuration, or 1), then one more each",
     NULL},
    {"keep", .offset = offsetof(clast_study_config, keep), CLAST_FIELD_TEXT_LIST, 0, 0, 0, "-",
     "result to tabulate, a.b for b within a; none: every number but those of longer lists", ""},
    {"shard", .offset = offsetof(clast_study_config, shard), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "K/N: do every N-th run from the K-th, for job arrays", ""},
    {0}};

enum { RUN_LIMIT = 1000000, KEY_LIMIT = 256 };

clast_status clx_study_find_seed(clast_study_config *config)
{
    clast_field seed[2] = {*clast_fields_find(clast_study_fields, "seed"), {0}};
    if (config->seed >= 0) {
        return CLAST_OK;
    }
    config->seed = 1; // as of each command
    seed[0].low = 0.0;
    return config->config[0] == '\0' ? CLAST_OK
                                     : clx_fields_read_part(config->config, seed, config);
}

/// Values of some keys: columns of a text table.
typedef struct {
    clast_table values;
} axis;

typedef struct {
    int32_t n;
    axis *item;
} axes;

static void axes_free(axes *all)
{
    for (int32_t i = 0; i < all->n; ++i) {
        clast_table_free(&all->item[i].values);
    }
    clx_free(all->item);
    *all = (axes){0};
}

/// Without blanks at both ends: moves *begin and *end.
static void trim(const char **begin, const char **end)
{
    while (*begin < *end && isspace((unsigned char)**begin)) {
        ++*begin;
    }
    while (*end > *begin && isspace((unsigned char)(*end)[-1])) {
        --*end;
    }
}

static clast_status copy_trimmed(const char *begin, const char *end, char out[KEY_LIMIT])
{
    clast_status status = CLAST_OK;
    trim(&begin, &end);
    CLX_CHECK(end > begin, CLAST_E_CONFIG, "vary: an empty key or value");
    CLX_CHECK(end - begin < KEY_LIMIT, CLAST_E_CONFIG, "vary: '%.40s...' is too long", begin);
    memcpy(out, begin, (size_t)(end - begin));
    out[end - begin] = '\0';
done:
    return status;
}

/// Whether two keys are one, '-' being '_'; the first ends at '=' at the latest.
static bool is_same_key(const char *pair, const char *key)
{
    while (*pair != '\0' && *pair != '=' &&
           (*pair == '-' ? '_' : *pair) == (*key == '-' ? '_' : *key)) {
        ++pair;
        ++key;
    }
    return (*pair == '\0' || *pair == '=') && *key == '\0';
}

/// The key of an axis that is the same, as it is spelled there, or NULL.
static const char *find_key(const axes *all, const char *key)
{
    for (int32_t i = 0; i < all->n; ++i) {
        const clast_table *values = &all->item[i].values;
        for (int32_t c = 0; c < values->n_column; ++c) {
            if (is_same_key(values->column[c].name, key)) {
                return values->column[c].name;
            }
        }
    }
    return NULL;
}

static clast_status check_new_key(const axes *all, const char *key)
{
    const char *before = find_key(all, key);
    return before == NULL ? CLAST_OK
                          : clx_fail(CLAST_E_CONFIG,
                                     "key '%s' varies twice: there is '%s' already; take it out of "
                                     "one of the two",
                                     key, before);
}

/// "key = a | b" as a column of an axis: a new one, or the one that is there (zip).
static clast_status add_vary(axes *all, const char *text, bool join)
{
    clast_status status = CLAST_OK;
    const char *equals = strchr(text, '=');
    char word[KEY_LIMIT];
    int64_t n = 1;
    CLX_CHECK(equals != NULL, CLAST_E_CONFIG, "vary takes 'key = a | b | c', not '%s'", text);
    CLX_TRY(copy_trimmed(text, equals, word));
    CLX_TRY(check_new_key(all, word));
    for (const char *c = equals; *c != '\0'; ++c) {
        n += *c == '|';
    }
    axis *to = &all->item[all->n - (join ? 1 : 0)];
    if (!join) {
        CLX_TRY(clast_table_init(&to->values, "vary", n));
        ++all->n;
    }
    CLX_CHECK(to->values.n_row == n, CLAST_E_CONFIG,
              "design zip needs lists of one length: '%s' has %lld values, the one before %lld",
              word, (long long)n, (long long)to->values.n_row);
    CLX_TRY(clast_table_add_text(&to->values, word));
    const char *begin = equals + 1;
    for (int64_t i = 0; i < n; ++i) {
        const char *end = begin + strcspn(begin, "|");
        CLX_TRY(copy_trimmed(begin, end, word));
        CLX_TRY(clast_table_set_text(&to->values, to->values.n_column - 1, i, word));
        begin = end + 1;
    }
done:
    return status;
}

/// Whether it is a whole number of more digits than a double always keeps.
static bool is_long_integer(const char *text)
{
    const size_t n = strspn(text, "0123456789");
    return n > 15 && text[n] == '\0';
}

/// A cell as the text that a command reads; numbers in the fewest digits that keep them, but those
/// that a double does not keep, such as seeds, as they are `written`.
static clast_status cell_text(const clast_column *column, int64_t row, const char *written,
                              char out[KEY_LIMIT])
{
    clast_status status = CLAST_OK;
    CLX_CHECK(strlen(written) < KEY_LIMIT, CLAST_E_CONFIG,
              "column '%s', row %lld: the text is too long", column->name, (long long)row + 1);
    if (column->number == NULL || is_long_integer(written)) {
        (void)snprintf(out, KEY_LIMIT, "%s", written);
    } else {
        CLX_CHECK(!isnan(column->number[row]), CLAST_E_CONFIG, "column '%s', row %lld: no value",
                  column->name, (long long)row + 1);
        (void)clx_number_format(column->number[row], out);
    }
done:
    return status;
}

static clast_status add_table(axes *all, const char *path)
{
    clast_status status = CLAST_OK;
    clast_table read = {0};
    clast_table texts = {0};
    char text[KEY_LIMIT];
    axis *to = &all->item[all->n];
    CLX_TRY(clx_csv_read_texts(path, &read, &texts));
    CLX_CHECK(read.n_row > 0, CLAST_E_FORMAT,
              "%s: a header and no rows; the table of a study has a row for each run", path);
    CLX_TRY(clast_table_init(&to->values, "table", read.n_row));
    ++all->n;
    for (int32_t c = 0; c < read.n_column; ++c) {
        CLX_TRY(check_new_key(all, read.column[c].name));
        CLX_TRY(clast_table_add_text(&to->values, read.column[c].name));
        for (int64_t r = 0; r < read.n_row; ++r) {
            CLX_TRY(cell_text(&read.column[c], r, texts.column[c].text[r], text));
            CLX_TRY(clast_table_set_text(&to->values, c, r, text));
        }
    }
done:
    clast_table_free(&texts);
    clast_table_free(&read);
    return status;
}

/// A row's values as one text, to be compared: 1g, 1000mg and 0.001 are one, as are yes and true.
typedef struct {
    char *text;
    int64_t row;
} row_key;

static int by_text(const void *a, const void *b)
{
    const row_key *x = a;
    const row_key *y = b;
    const int order = strcmp(x->text, y->text);
    return order != 0 ? order : (x->row > y->row) - (x->row < y->row);
}

/// A value as it is compared: numbers by their digits in SI, in `number`.
static const char *value_key(const char *text, char number[KEY_LIMIT])
{
    static const char *const same[][2] = {{"true", "1"},  {"yes", "1"}, {"on", "1"},
                                          {"false", "0"}, {"no", "0"},  {"off", "0"}};
    double value = 0.0;
    if (is_long_integer(text)) {
        return text + strspn(text, "0");
    }
    if (clx_unit_is_number(text, &value, NULL)) {
        // 15 digits: 0.3mm and 3e-4 may differ in the last
        (void)clx_number_print(number, KEY_LIMIT, "%.15g", value + 0.0);
        return number;
    }
    for (size_t k = 0; k < sizeof same / sizeof *same; ++k) {
        if (strcmp(text, same[k][0]) == 0) {
            return same[k][1];
        }
    }
    return text;
}

static clast_status make_key(const clast_table *values, int64_t row, row_key *key)
{
    clast_status status = CLAST_OK;
    char number[KEY_LIMIT];
    size_t size = 1;
    size_t n = 0;
    for (int32_t c = 0; c < values->n_column; ++c) {
        size += strlen(value_key(values->column[c].text[row], number)) + 1;
    }
    CLX_TRY(clx_alloc(&key->text, (int64_t)size, 1));
    for (int32_t c = 0; c < values->n_column; ++c) {
        n += (size_t)snprintf(key->text + n, size - n, "%s\x1f",
                              value_key(values->column[c].text[row], number));
    }
    key->row = row;
done:
    return status;
}

/// Two rows of an axis that are the same, counted from 1.
static clast_status refuse_rows(const clast_table *values, int64_t a, int64_t b)
{
    static const char *const why = "the same runs; option seeds repeats them with other random "
                                   "numbers";
    const clast_column *first = &values->column[0];
    return strcmp(values->name, "table") == 0
               ? clx_fail(CLAST_E_CONFIG, "table: rows %lld and %lld are the same: %s",
                          (long long)a + 1, (long long)b + 1, why)
               : clx_fail(CLAST_E_CONFIG,
                          "vary: values %lld and %lld of '%s'%s are the same ('%s', '%s'): %s",
                          (long long)a + 1, (long long)b + 1, first->name,
                          values->n_column > 1 ? " and of the others" : "", first->text[a],
                          first->text[b], why);
}

/// Refuses rows that would be run twice.
static clast_status check_rows(const clast_table *values)
{
    clast_status status = CLAST_OK;
    const int64_t n = values->n_row;
    row_key *key = NULL;
    CLX_TRY(clx_alloc(&key, n, sizeof *key));
    for (int64_t i = 0; i < n; ++i) {
        CLX_TRY(make_key(values, i, &key[i]));
    }
    qsort(key, (size_t)n, sizeof *key, by_text);
    for (int64_t i = 1; i < n; ++i) {
        if (strcmp(key[i - 1].text, key[i].text) == 0) {
            CLX_TRY(refuse_rows(values, key[i - 1].row, key[i].row));
        }
    }
done:
    for (int64_t i = 0; key != NULL && i < n; ++i) {
        clx_free(key[i].text);
    }
    clx_free(key);
    return status;
}

static clast_status find_axes(const clast_study_config *config, axes *all)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&all->item, config->vary.n + 1, sizeof *all->item));
    if (config->table[0] != '\0') {
        CLX_TRY(add_table(all, config->table));
    }
    for (int32_t i = 0; i < config->vary.n; ++i) {
        const bool is_zip = config->design == CLAST_STUDY_ZIP;
        CLX_TRY(add_vary(all, config->vary.item[i], is_zip && i > 0));
    }
    for (int32_t i = 0; i < all->n; ++i) {
        CLX_TRY(check_rows(&all->item[i].values));
    }
    const bool has_run = find_key(all, "run") != NULL;
    CLX_CHECK(!has_run && (config->seeds == 1 || find_key(all, "seed") == NULL), CLAST_E_CONFIG,
              "'%s' cannot vary: it names the %s", has_run ? "run" : "seed",
              has_run ? "run's number" : "realisation (option seeds)");
done:
    return status;
}

/// Refuses what is fixed and varies: the runs would take one of the two without a word.
static clast_status check_fixed(const clast_study_config *config, const axes *all)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < config->set.n; ++i) {
        const char *pair = config->set.item[i];
        CLX_CHECK(!is_same_key(pair, "seed"), CLAST_E_CONFIG,
                  "fix: '%s': the seed names the realisation; give it as option seed", pair);
        for (int32_t a = 0; a < all->n; ++a) {
            const clast_table *values = &all->item[a].values;
            for (int32_t c = 0; c < values->n_column; ++c) {
                CLX_CHECK(!is_same_key(pair, values->column[c].name), CLAST_E_CONFIG,
                          "fix: '%s': this key varies; take it out of one of the two", pair);
            }
        }
    }
done:
    return status;
}

static clast_status fill_plan(const clast_study_config *config, const axes *all, clast_table *plan)
{
    clast_status status = CLAST_OK;
    double *seed = NULL;
    double *number = NULL;
    int32_t at = 1;
    int64_t inner = plan->n_row;
    CLX_TRY(clast_table_add_number(plan, "run", "-", &number));
    for (int64_t r = 0; r < plan->n_row; ++r) {
        number[r] = (double)(r + 1);
    }
    for (int32_t a = 0; a < all->n; ++a) {
        const clast_table *values = &all->item[a].values;
        CLAST_ASSERT(values->n_row > 0);
        inner /= values->n_row;
        for (int32_t c = 0; c < values->n_column; ++c) {
            CLX_TRY(clast_table_add_text(plan, values->column[c].name));
            for (int64_t r = 0; r < plan->n_row; ++r) {
                const int64_t from = r / inner % values->n_row;
                CLX_TRY(clast_table_set_text(plan, at, r, values->column[c].text[from]));
            }
            ++at;
        }
    }
    if (find_key(all, "seed") == NULL) {
        CLX_TRY(clast_table_add_number(plan, "seed", "-", &seed));
        for (int64_t r = 0; r < plan->n_row; ++r) {
            seed[r] = (double)(config->seed + r % config->seeds);
        }
    }
done:
    return status;
}

clast_status clast_study_plan(const clast_study_config *config, clast_table *plan)
{
    CLX_ARGUMENTS(config, plan);
    CLX_GUARD(clast_fields_check(clast_study_fields, config));
    clast_status status = CLAST_OK;
    axes all = {0};
    clast_table made = {0};
    int64_t n_run = config->seeds;
    clast_study_config seeded = *config;
    CLX_TRY(clx_study_find_seed(&seeded));
    CLX_CHECK(config->run[0] != '\0', CLAST_E_CONFIG,
              "run is not set: name the command, such as run: aggregate");
    CLX_TRY(find_axes(config, &all));
    CLX_TRY(check_fixed(config, &all));
    for (int32_t a = 0; a < all.n; ++a) {
        n_run *= all.item[a].values.n_row;
        CLX_CHECK(n_run <= RUN_LIMIT, CLAST_E_LIMIT, "more than %d runs", RUN_LIMIT);
    }
    CLX_TRY(clast_table_init(&made, "plan", n_run));
    CLX_TRY(fill_plan(&seeded, &all, &made));
    *plan = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    axes_free(&all);
    return status;
}

/// The field of a "key=value".
static const clast_field *find_fixed(const clast_field *fields, const char *pair)
{
    char name[KEY_LIMIT];
    (void)snprintf(name, sizeof name, "%.*s", (int)strcspn(pair, "="), pair);
    return clast_fields_find(fields, name);
}

/// Refuses a key of n bytes that the command does not have.
static clast_status check_key(const char *command, const clast_field *fields, const char *key,
                              size_t n)
{
    clast_status status = CLAST_OK;
    char name[KEY_LIMIT];
    (void)snprintf(name, sizeof name, "%.*s", (int)n, key);
    const char *near = clast_fields_nearest(fields, name);
    CLX_CHECK(clast_fields_find(fields, name) != NULL, CLAST_E_CONFIG,
              "clast %s has no key '%s'%s%s%s", command, name,
              near != NULL ? " (did you mean '" : "", near != NULL ? near : "",
              near != NULL ? "'?)" : "");
done:
    return status;
}

/// Refuses a key of one value that is fixed twice: the runs would take the last without a word.
static clast_status check_fixed_once(const clast_field *fields, const clast_text_list *set)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < set->n; ++i) {
        const clast_field *field = find_fixed(fields, set->item[i]);
        const bool is_list =
            field->type == CLAST_FIELD_TEXT_LIST || field->type == CLAST_FIELD_F64_LIST;
        for (int32_t k = 0; k < i && !is_list; ++k) {
            CLX_CHECK(find_fixed(fields, set->item[k]) != field, CLAST_E_CONFIG,
                      "fix: '%s' and '%s': %s takes one value", set->item[k], set->item[i],
                      field->name);
        }
    }
done:
    return status;
}

clast_status clast_study_check(const clast_study_config *config, const clast_field *fields,
                               int64_t *n_run)
{
    CLX_ARGUMENTS(config);
    clast_status status = CLAST_OK;
    clast_table plan = {0};
    CLX_TRY(clast_study_plan(config, &plan));
    for (int32_t c = 0; c < plan.n_column; ++c) {
        const clast_column *key = &plan.column[c]; // of texts: run and seed are numbers
        if (key->text != NULL) {
            CLX_TRY(check_key(config->run, fields, key->name, strlen(key->name)));
        }
    }
    for (int32_t i = 0; i < config->set.n; ++i) {
        const char *pair = config->set.item[i];
        CLX_CHECK(strchr(pair, '=') != NULL, CLAST_E_CONFIG, "fix takes key=value, not '%s'", pair);
        CLX_TRY(check_key(config->run, fields, pair, strcspn(pair, "=")));
    }
    CLX_TRY(check_fixed_once(fields, &config->set));
    CLX_CHECK(config->seeds == 1 || clast_fields_find(fields, "seed") != NULL, CLAST_E_CONFIG,
              "clast %s draws nothing at random: seeds must be 1", config->run);
    if (n_run != NULL) {
        *n_run = plan.n_row;
    }
done:
    clast_table_free(&plan);
    return status;
}
