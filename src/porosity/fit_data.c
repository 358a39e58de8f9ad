// Beds with their candidate features, from tables.
#include <clast/porosity_model.h>

#include "base/alloc.h"
#include "base/number.h"
#include "base/status.h"
#include "porosity/fit.h"
#include "porosity/form_inputs.h"
#include "porosity/unit_columns.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define FIELD(type, name) #name, .offset = offsetof(clast_porosity_fit_config, name), type
const clast_field clast_porosity_fit_fields[] = {
    {FIELD(CLAST_FIELD_TEXT, target), 0, 0, 0, "-", "column with the measured porosity", "porosity",
     .common = true, .group = "columns"},
    {FIELD(CLAST_FIELD_TEXT, columns), 0, 0, 0, "-",
     "columns of the form: flatness,elongation or L,I,S (else known by their names); with features "
     "columns: the candidates",
     "", .common = true},
    {FIELD(CLAST_FIELD_TEXT, group), 0, 0, 0, "-",
     "column that names the bed, in the table of beds and in that of the grains; it is no feature",
     "bed", .common = true},
    {FIELD(CLAST_FIELD_I32, n_term), 2, 1, 20, "-", "features of the model", NULL, .common = true,
     .group = "model"},
    {FIELD(CLAST_FIELD_TEXT, use), 0, 0, 0, "-",
     "take these features (a,b,...) instead of selecting", "", .common = true},
    {FIELD(CLAST_FIELD_F64, correlation_limit), 0.8, 0.0, 1.0, "-",
     "remove features whose |r| to a chosen one is greater", NULL, .common = true,
     .group = "selection and cross-validation"},
    {FIELD(CLAST_FIELD_I32, n_fold), 10, 2, 1e6, "-", "folds of the cross-validation", NULL,
     .common = true},
    {FIELD(CLAST_FIELD_I32, n_repeat), 1, 1, 10000, "-",
     "cross-validations with other folds to average", NULL},
    {FIELD(CLAST_FIELD_CHOICE, score), 0, 0, 0, "-",
     "absolute error that decides: the mean (Tables 9, 10 of the paper) or the median",
     "mean|median", .common = true},
    {FIELD(CLAST_FIELD_CHOICE, validation), 0, 0, 0, "-",
     "features for a held-out bed: selected anew without it (nested), or with it, as in the paper "
     "(published), which makes the errors too small",
     "nested|published", .common = true},
    {FIELD(CLAST_FIELD_I32, n_permutation), 199, 0, 1e6, "-",
     "permutations of the porosities among the beds for p-values (0: none)", NULL},
    {FIELD(CLAST_FIELD_U64, seed), 1, 0, 1.8446744073709552e19, "-",
     "random numbers of folds and permutations", NULL, .common = true},
    {0}};

void clast_fit_data_free(clast_fit_data *data)
{
    if (data == NULL) {
        return;
    }
    clast_table_free(&data->beds);
    clast_table_free(&data->left_out);
    *data = (clast_fit_data){0};
}

/// Starts the tables: beds with columns row and porosity, nothing left out.
static clast_status begin(clast_model_kind kind, int64_t n_row, clast_fit_data *d)
{
    clast_status status = CLAST_OK;
    double *column = NULL;
    d->kind = kind;
    CLX_TRY(clast_table_init(&d->beds, "beds", n_row));
    CLX_TRY(clast_table_add_number(&d->beds, "row", "-", &column));
    CLX_TRY(clast_table_add_number(&d->beds, "porosity", "-", &column));
    CLX_TRY(clast_table_init(&d->left_out, "left_out", 0));
    CLX_TRY(clast_table_add_number(&d->left_out, "row", "-", &column));
    CLX_TRY(clast_table_add_text(&d->left_out, "reason"));
done:
    return status;
}

static clast_status leave_out(int64_t row, const char *reason, clast_fit_data *d)
{
    clast_status status = CLAST_OK;
    const int64_t n = d->left_out.n_row;
    CLX_TRY(clast_table_resize(&d->left_out, n + 1));
    d->left_out.column[0].number[n] = (double)row + 1.0;
    CLX_TRY(clast_table_set_text(&d->left_out, 1, n, reason));
done:
    return status;
}

static clast_status target_of(const clast_table *beds, const char *name, const double **porosity)
{
    clast_status status = CLAST_OK;
    *porosity = clast_table_numbers(beds, name);
    CLX_CHECK(*porosity != NULL || clast_table_find(beds, name) < 0, CLAST_E_FORMAT,
              "table %s: column '%s' holds words", beds->name, name);
    CLX_CHECK(*porosity != NULL, CLAST_E_FORMAT,
              "table %s has no column '%s'; name the measured porosity with --target", beds->name,
              name);
done:
    return status;
}

static const char *porosity_fault(double porosity)
{
    return isnan(porosity)                       ? "porosity missing"
           : !(porosity > 0.0 && porosity < 1.0) ? "porosity not between 0 and 1"
                                                 : NULL;
}

/// Sets row and porosity of bed k.
static void set_bed(clast_fit_data *d, int64_t k, int64_t row, double porosity)
{
    d->beds.column[0].number[k] = (double)row + 1.0;
    d->beds.column[1].number[k] = porosity;
}

static clast_status finish(clast_fit_data *d, int64_t n, const clast_table *source)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(n > 0, CLAST_E_FORMAT, "table %s: none of its %lld rows is a bed to fit%s%s",
              source->name, (long long)source->n_row, d->left_out.n_row > 0 ? "; row 1: " : "",
              d->left_out.n_row > 0 ? d->left_out.column[1].text[0] : "");
    CLX_TRY(clast_table_resize(&d->beds, n));
done:
    return status;
}

static clast_status single_rows(const clast_table *beds, const clast_form_set *set,
                                const double *porosity, clast_fit_data *d)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    int64_t k = 0;
    for (int64_t row = 0, at = 0; row < beds->n_row; ++row) {
        if (at < set->n_left_out && set->left_out[at].row == row) {
            CLX_TRY(leave_out(row, clast_row_fault_text(set->left_out[at].fault), d));
            ++at;
            continue;
        }
        const char *fault = porosity_fault(porosity[row]);
        if (fault != NULL) {
            CLX_TRY(leave_out(row, fault, d));
        } else {
            double feature[CLAST_N_FORM_FEATURE];
            clx_form_features_of(set->flatness[k], set->elongation[k], feature);
            set_bed(d, n, row, porosity[row]);
            for (int32_t f = 0; f < CLAST_N_FORM_FEATURE; ++f) {
                d->beds.column[2 + f].number[n] = feature[f];
            }
            ++n;
        }
        ++k;
    }
    CLX_TRY(finish(d, n, beds));
done:
    return status;
}

clast_status clast_fit_data_single(const clast_table *beds, const clast_porosity_fit_config *config,
                                   clast_fit_data *data)
{
    CLX_ARGUMENTS(beds, config, data);
    CLX_GUARD(clast_fields_check(clast_porosity_fit_fields, config));
    CLX_WHOLE(table, beds);
    clast_status status = CLAST_OK;
    clast_fit_data d = {0};
    clast_form_set set = {0};
    const double *porosity = NULL;
    double *unused = NULL;
    CLX_TRY(target_of(beds, config->target, &porosity));
    CLX_TRY(clast_form_set_of(beds, config->columns, &set));
    CLX_TRY(begin(CLAST_MODEL_SINGLE, beds->n_row, &d));
    for (int32_t f = 0; f < CLAST_N_FORM_FEATURE; ++f) {
        CLX_TRY(clast_table_add_number(&d.beds, clast_form_feature_name(f), "-", &unused));
    }
    CLX_TRY(single_rows(beds, &set, porosity, &d));
    *data = d;
    d = (clast_fit_data){0};
done:
    clast_form_set_free(&set);
    clast_fit_data_free(&d);
    return status;
}

/// A cell as text: words as they are, numbers in full.
static void cell_text(const clast_column *column, int64_t row, char *text, size_t size)
{
    if (column->number != NULL) {
        (void)clx_number_print(text, size, "%.17g", column->number[row]);
    } else {
        (void)snprintf(text, size, "%s", column->text[row]);
    }
}

static bool same_cell(const clast_column *a, int64_t i, const clast_column *b, int64_t j)
{
    char one[256];
    char two[256];
    if (a->number != NULL && b->number != NULL) {
        return a->number[i] == b->number[j];
    }
    cell_text(a, i, one, sizeof one);
    cell_text(b, j, two, sizeof two);
    return strcmp(one, two) == 0;
}

typedef struct {
    const clast_table *beds, *grains;
    const clast_column *bed_name, *grain_name;
    const double *porosity;
    clast_form_set set;
    int64_t *pick; ///< [set.n] grains of one bed
    bool *has_bed; ///< [set.n]
} mixture;

static clast_status mixture_row(mixture *m, int64_t row, clast_fit_data *d, int64_t *n)
{
    clast_status status = CLAST_OK;
    clast_form_inputs in = {0};
    int64_t n_pick = 0;
    const char *fault = porosity_fault(m->porosity[row]);
    for (int64_t k = 0; k < m->set.n; ++k) {
        if (same_cell(m->bed_name, row, m->grain_name, m->set.row[k])) {
            m->pick[n_pick++] = k;
        }
    }
    d->n_repeated += n_pick > 0 && m->has_bed[m->pick[0]] ? 1 : 0;
    for (int64_t k = 0; k < n_pick; ++k) {
        m->has_bed[m->pick[k]] = true;
    }
    fault = fault != NULL ? fault : n_pick < 2 ? "fewer than two grains" : NULL;
    if (fault != NULL) {
        return leave_out(row, fault, d);
    }
    CLX_TRY(clast_form_inputs_of(&m->set, m->pick, n_pick, &in));
    set_bed(d, *n, row, m->porosity[row]);
    for (int32_t f = 0; f < CLAST_N_MIXTURE_FEATURE; ++f) {
        d->beds.column[2 + f].number[*n] = in.mixture[f];
    }
    ++*n;
done:
    return status;
}

static clast_status group_column(const clast_table *table, const char *name,
                                 const clast_column **column)
{
    clast_status status = CLAST_OK;
    const int32_t c = clast_table_find(table, name);
    CLX_CHECK(c >= 0, CLAST_E_FORMAT, "table %s has no column '%s' that names the bed; see --group",
              table->name, name);
    *column = &table->column[c];
done:
    return status;
}

clast_status clast_fit_data_mixture(const clast_table *beds, const clast_table *grains,
                                    const clast_porosity_fit_config *config, clast_fit_data *data)
{
    CLX_ARGUMENTS(beds, grains, config, data);
    CLX_GUARD(clast_fields_check(clast_porosity_fit_fields, config));
    CLX_WHOLE(table, beds);
    CLX_WHOLE(table, grains);
    clast_status status = CLAST_OK;
    clast_fit_data d = {0};
    mixture m = {.beds = beds, .grains = grains};
    int64_t n = 0;
    double *unused = NULL;
    CLX_TRY(target_of(beds, config->target, &m.porosity));
    CLX_TRY(group_column(beds, config->group, &m.bed_name));
    CLX_TRY(group_column(grains, config->group, &m.grain_name));
    CLX_TRY(clast_form_set_of(grains, config->columns, &m.set));
    CLX_TRY(clx_alloc(&m.pick, m.set.n, sizeof *m.pick));
    CLX_TRY(clx_alloc(&m.has_bed, m.set.n, sizeof *m.has_bed));
    CLX_TRY(begin(CLAST_MODEL_MIXTURE, beds->n_row, &d));
    for (int32_t f = 0; f < CLAST_N_MIXTURE_FEATURE; ++f) {
        char name[96];
        (void)clast_mixture_feature_name(f, sizeof name, name);
        CLX_TRY(clast_table_add_number(&d.beds, name, "-", &unused));
    }
    if (strcmp(m.set.unread_count, config->group) != 0) {
        (void)snprintf(d.unread_count, sizeof d.unread_count, "%s", m.set.unread_count);
    }
    for (int64_t row = 0; row < beds->n_row; ++row) {
        CLX_TRY(mixture_row(&m, row, &d, &n));
    }
    for (int64_t k = 0; k < m.set.n; ++k) {
        d.n_without_bed += m.has_bed[k] ? 0 : 1;
    }
    CLX_TRY(finish(&d, n, beds));
    *data = d;
    d = (clast_fit_data){0};
done:
    CLX_FREE(m.pick, m.has_bed);
    clast_form_set_free(&m.set);
    clast_fit_data_free(&d);
    return status;
}

/// A column of numbers with at least one finite value; one without any must not cost every row.
static bool has_numbers(const clast_column *column, int64_t n_row)
{
    for (int64_t i = 0; column->number != NULL && i < n_row; ++i) {
        if (isfinite(column->number[i])) {
            return true;
        }
    }
    return false;
}

/// Whether a name is one of a,b,...
static bool is_listed(const char *list, const char *name)
{
    const size_t n = strlen(name);
    const char *at = list;
    while (at != NULL) {
        at += *at == ',' ? 1 : 0;
        at += strspn(at, " ");
        const char *next = strchr(at, ',');
        const size_t length = next != NULL ? (size_t)(next - at) : strlen(at);
        if (length == n && strncmp(at, name, n) == 0) {
            return true;
        }
        at = next;
    }
    return false;
}

/// Names of a list that are no columns of numbers.
static clast_status check_list(const clast_table *beds, const char *list)
{
    clast_status status = CLAST_OK;
    for (const char *at = list; at != NULL && *at != '\0';) {
        char name[256];
        at += strspn(at, " ");
        const char *next = strchr(at, ',');
        (void)snprintf(name, sizeof name, "%.*s", next != NULL ? (int)(next - at) : (int)strlen(at),
                       at);
        CLX_CHECK(clast_table_numbers(beds, name) != NULL, CLAST_E_FORMAT,
                  "table %s has no column of numbers '%s' (columns)", beds->name, name);
        at = next != NULL ? next + 1 : NULL;
    }
done:
    return status;
}

int32_t clx_fit_end_of_varied(const clast_table *beds)
{
    const int32_t code = clast_table_find(beds, "exit_code");
    return clast_table_find(beds, "run") == 0 && code > 0 ? code : 0;
}

/// Candidates: those of `columns`; else those of `use` with all but the target and the column that
/// names the bed, in a study's table with what was varied: its runs' other results, from exit_code
/// on, are measured with the porosity, not known before, and the seed of random numbers says
/// nothing of a bed.
static bool is_candidate(const clast_table *beds, int32_t c,
                         const clast_porosity_fit_config *config)
{
    const clast_column *column = &beds->column[c];
    const int32_t end = clx_fit_end_of_varied(beds);
    if (column->number == NULL || strcmp(column->name, config->target) == 0) {
        return false;
    }
    if (config->columns[0] != '\0') {
        return is_listed(config->columns, column->name);
    }
    if (is_listed(config->use, column->name)) {
        return true;
    }
    return end > 0 ? c > 0 && c < end && strcmp(column->name, "seed") != 0
                   : strcmp(column->name, config->group) != 0;
}

/// Whether a row without a value in this column is left out: with features named, theirs alone.
static bool is_needed(const clast_table *beds, int32_t c, const clast_porosity_fit_config *config)
{
    const bool is_used = config->use[0] == '\0' || is_listed(config->use, beds->column[c].name);
    return is_used && is_candidate(beds, c, config) && has_numbers(&beds->column[c], beds->n_row);
}

/// Rows with a porosity and all cells that are needed; the others are told in left_out.
static clast_status column_rows(const clast_table *beds, const double *porosity,
                                const clast_porosity_fit_config *config, clast_fit_data *d)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    for (int64_t row = 0; row < beds->n_row; ++row) {
        const char *fault = porosity_fault(porosity[row]);
        for (int32_t c = 0; c < beds->n_column && fault == NULL; ++c) {
            if (is_needed(beds, c, config) && !isfinite(beds->column[c].number[row])) {
                fault = "a cell is missing or infinite";
            }
        }
        if (fault != NULL) {
            CLX_TRY(leave_out(row, fault, d));
        } else {
            set_bed(d, n++, row, porosity[row]);
        }
    }
    CLX_TRY(finish(d, n, beds));
done:
    return status;
}

/// Adds the candidates' values of the rows that are kept.
static clast_status add_candidates(const clast_table *beds, const clast_porosity_fit_config *config,
                                   clast_fit_data *d)
{
    clast_status status = CLAST_OK;
    for (int32_t c = 0; c < beds->n_column; ++c) {
        const clast_column *from = &beds->column[c];
        const bool is_taken = clast_table_find(&d->beds, from->name) >= 0;
        double *to = NULL;
        if (!is_candidate(beds, c, config)) {
            continue;
        }
        CLX_CHECK(!is_taken, CLAST_E_FORMAT,
                  "table %s: a feature may not be called '%s'; rename the column", beds->name,
                  from->name);
        CLX_TRY(clast_table_add_number(&d->beds, from->name, from->unit, &to));
        for (int64_t k = 0; k < d->beds.n_row; ++k) {
            to[k] = from->number[(int64_t)d->beds.column[0].number[k] - 1];
        }
    }
    CLX_CHECK(d->beds.n_column > 2, CLAST_E_FORMAT,
              "table %s: no column of numbers is a candidate; name some with --columns",
              beds->name);
done:
    return status;
}

/// A table of columns need not name its beds, but has the column that was asked for.
static clast_status check_group(const clast_table *beds, const char *name)
{
    const clast_column *unused = NULL;
    return strcmp(name, "bed") == 0 ? CLAST_OK : group_column(beds, name, &unused);
}

clast_status clast_fit_data_columns(const clast_table *beds,
                                    const clast_porosity_fit_config *config, clast_fit_data *data)
{
    CLX_ARGUMENTS(beds, config, data);
    CLX_GUARD(clast_fields_check(clast_porosity_fit_fields, config));
    CLX_WHOLE(table, beds);
    clast_status status = CLAST_OK;
    clast_fit_data d = {0};
    clx_unit_columns columns = {0};
    const double *porosity = NULL;
    CLX_TRY(target_of(beds, config->target, &porosity));
    CLX_TRY(check_group(beds, config->group));
    CLX_TRY(clx_unit_columns_read(beds, &columns));
    CLX_TRY(check_list(&columns.table, config->columns));
    CLX_TRY(begin(CLAST_MODEL_COLUMNS, beds->n_row, &d));
    CLX_TRY(column_rows(&columns.table, porosity, config, &d));
    CLX_TRY(add_candidates(&columns.table, config, &d));
    *data = d;
    d = (clast_fit_data){0};
done:
    clx_unit_columns_free(&columns);
    clast_fit_data_free(&d);
    return status;
}
