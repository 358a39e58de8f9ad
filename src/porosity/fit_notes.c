// What a fit takes as its features where nobody says, and what people should know of it, in words.
#include <clast/porosity_model.h>

#include "base/number.h"
#include "base/status.h"
#include "porosity/fit.h"
#include "porosity/whole.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static bool has_forms(const clast_table *beds, const char *columns)
{
    clast_form_set set = {0};
    const bool has = clast_form_set_of(beds, columns, &set) == CLAST_OK;
    clast_form_set_free(&set);
    return has;
}

/// Named columns of any table are its candidates, though two or three numbers could be a form. Of
/// columns that are a form's by their names the fit says what is wrong with them.
clast_status clast_porosity_fit_choose(const clast_table *beds, bool has_grains,
                                       const clast_porosity_fit_config *config,
                                       clast_model_kind *kind, clast_fit_note *note)
{
    CLX_ARGUMENTS(beds, config, kind, note);
    CLX_GUARD(clast_fields_check(clast_porosity_fit_fields, config));
    CLX_WHOLE(table, beds);
    const char *const columns = config->columns;
    const bool is_form = columns[0] == '\0' ? clast_form_set_named(beds) : has_forms(beds, columns);
    const bool is_named = clast_form_columns_named(columns);
    *note = (clast_fit_note){.is_of_table = true};
    *kind = has_grains            ? CLAST_MODEL_MIXTURE
            : is_form && is_named ? CLAST_MODEL_SINGLE
                                  : CLAST_MODEL_COLUMNS;
    if (!has_grains && is_form && !is_named) {
        (void)snprintf(note->text, sizeof note->text,
                       "columns %s are candidates; --features form takes them as a form", columns);
    }
    return CLAST_OK;
}

/// A text of a table, "" where there is none.
static const char *text_of(const clast_table *table, const char *column, int64_t row)
{
    const int32_t c = clast_table_find(table, column);
    const bool has = c >= 0 && table->column[c].text != NULL && table->column[c].text[row] != NULL;
    return has ? table->column[c].text[row] : "";
}

/// A fit, whole or under way, and which of its lines is asked for.
typedef struct {
    const clast_table *beds;
    const clast_fit_data *data;
    const clast_porosity_fit_config *config;
    int32_t n_before; ///< lines before it
    clast_fit_note *note;
} teller;

__attribute__((format(printf, 3, 4))) static void tell(teller *t, bool is_of_table,
                                                       const char *format, ...)
{
    va_list args;
    if (t->n_before-- == 0) {
        t->note->is_of_table = is_of_table;
        va_start(args, format);
        (void)clx_number_print_list(t->note->text, sizeof t->note->text, format, args);
        va_end(args);
    }
}

static void tell_left_out(teller *t)
{
    const clast_table *out = &t->data->left_out;
    const double *const row = clast_table_numbers(out, "row");
    if (out->n_row > 0 && row != NULL) {
        tell(t, true, "%lld of %lld rows left out (first: row %.0f, %s)", (long long)out->n_row,
             (long long)t->beds->n_row, row[0], text_of(out, "reason", 0));
    }
}

static void tell_count(teller *t)
{
    const char *const name = t->data->unread_count;
    if (name[0] != '\0') {
        tell(t, false, "grains: column '%s' is not looked at: each row is one grain", name);
    }
}

/// Beds and grains that do not find each other.
static void tell_beds(teller *t)
{
    const clast_fit_data *d = t->data;
    if (d->n_repeated > 0) {
        tell(t, true,
             "%lld of %lld rows name a bed in '%s' that a row before names: each counts, with the "
             "same grains",
             (long long)d->n_repeated, (long long)t->beds->n_row, t->config->group);
    }
    if (d->n_without_bed > 0) {
        tell(t, false, "grains: %lld of beds that are in no row do not count",
             (long long)d->n_without_bed);
    }
}

/// Whether candidates are all columns of a table, be it a study's: none was named.
static bool is_open(const teller *t)
{
    return t->data->kind == CLAST_MODEL_COLUMNS && t->config->columns[0] == '\0' &&
           t->config->use[0] == '\0';
}

/// Columns of words where a fit of columns looks for candidates: what they say is lost to it.
static void tell_words(teller *t)
{
    char names[512] = "";
    int n = 0;
    const int32_t end = clx_fit_end_of_varied(t->beds);
    for (int32_t k = 0; is_open(t) && k < (end > 0 ? end : t->beds->n_column); ++k) {
        const clast_column *column = &t->beds->column[k];
        if (column->text != NULL && clast_table_find(&t->data->beds, column->name) < 0) {
            const size_t used = strlen(names);
            (void)snprintf(names + used, sizeof names - used, "%s%s", n > 0 ? ", " : "",
                           column->name);
            ++n;
        }
    }
    if (n > 0) {
        tell(t, true, "%d %s: %s", n,
             n > 1 ? "columns of words are no candidates" : "column of words is no candidate",
             names);
    }
}

/// Why a selection has fewer features than it was asked for.
static void tell_few(teller *t, const clast_porosity_fit *fit)
{
    const int32_t n = fit->model.n_term;
    bool is_kept = false;
    if (t->config->use[0] != '\0' || n >= t->config->n_term) {
        return;
    }
    for (int64_t k = 0; k < fit->ranking.n_row && !is_kept; ++k) {
        is_kept = strcmp(text_of(&fit->ranking, "state", k), "kept") == 0;
    }
    if (is_kept) {
        tell(t, false,
             "%d of %d features: with one more no candidate can be fitted to each training set", n,
             t->config->n_term);
    } else {
        tell(t, false,
             "%d of %d features: no candidate is left of %d (%d like a chosen one, %d constant or "
             "not finite in some row)",
             n, t->config->n_term, (int)fit->ranking.n_row, fit->n_removed,
             (int)fit->ranking.n_row - n - fit->n_removed);
    }
}

/// Whether a column's numbers are those of the rows, from 1 or from 0.
static bool counts_rows(const clast_table *beds, const char *name)
{
    const double *const x = clast_table_numbers(beds, name);
    const double *const row = clast_table_numbers(beds, "row");
    bool counts =
        x != NULL && row != NULL && beds->n_row > 0 && (x[0] == row[0] || x[0] == row[0] - 1.0);
    for (int64_t i = 1; counts && i < beds->n_row; ++i) {
        counts = x[i] - row[i] == x[0] - row[0];
    }
    return counts;
}

/// The column that names the bed is no candidate; a feature that counts the rows fits well if they
/// are sorted.
static void tell_numbers(teller *t, const clast_porosity_model *m)
{
    if (!is_open(t) || clx_fit_end_of_varied(t->beds) > 0) {
        return;
    }
    if (clast_table_numbers(t->beds, t->config->group) != NULL) {
        tell(t, true, "column '%s' names the bed and is no candidate", t->config->group);
    }
    for (int32_t k = 0; k < m->n_term; ++k) {
        if (counts_rows(&t->data->beds, m->term[k].feature)) {
            tell(t, true,
                 "feature '%s' counts the rows; if it says nothing of a bed, name the candidates: "
                 "--features columns --columns a,b",
                 m->term[k].feature);
        }
    }
}

bool clast_porosity_fit_note(const clast_porosity_fit *fit, const clast_table *beds,
                             const clast_fit_data *data, int32_t number,
                             const clast_porosity_fit_config *config, clast_fit_note *note)
{
    if (data == NULL || note == NULL || number < 0 || clx_table_fault(beds) != NULL ||
        clx_table_fault(&data->beds) != NULL || clx_table_fault(&data->left_out) != NULL ||
        clast_fields_check(clast_porosity_fit_fields, config) != CLAST_OK ||
        (fit != NULL && (clx_porosity_model_fault(&fit->model) != NULL ||
                         clx_table_fault(&fit->ranking) != NULL))) {
        return false;
    }
    teller t = {beds, data, config, number, note};
    tell_left_out(&t);
    tell_count(&t);
    tell_beds(&t);
    tell_words(&t);
    if (fit != NULL) {
        tell_few(&t, fit);
        tell_numbers(&t, &fit->model);
    }
    return t.n_before < 0;
}
