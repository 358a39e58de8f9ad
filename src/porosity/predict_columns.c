// Porosities of beds from the columns that a fitted model names.
#include <clast/porosity_model.h>

#include "base/alloc.h"
#include "base/status.h"
#include "porosity/model.h"
#include "porosity/unit_columns.h"
#include "porosity/whole.h"
#include <math.h>
#include <string.h>

static clast_status find_columns(const clast_porosity_model *model, const clast_table *table,
                                 const double **column)
{
    clast_status status = CLAST_OK;
    for (int32_t k = 0; k < model->n_term + model->n_range; ++k) {
        const char *name =
            k < model->n_term ? model->term[k].feature : model->range[k - model->n_term].feature;
        column[k] = clast_table_numbers(table, name);
        CLX_CHECK(column[k] != NULL, CLAST_E_FORMAT,
                  "table %s has no column of numbers '%s', which model %s needs", table->name, name,
                  model->name);
    }
done:
    return status;
}

/// A column of another unit than the model's is refused; plain numbers too, unless they are SI.
static clast_status check_units(const clast_porosity_model *model, const clast_table *table,
                                bool plain_is_si)
{
    clast_status status = CLAST_OK;
    for (int32_t k = 0; k < model->n_term; ++k) {
        const char *name = model->term[k].feature;
        const char *wanted = model->term[k].unit;
        const int32_t c = clast_table_find(table, name);
        if (wanted == NULL || c < 0 || table->column[c].number == NULL) {
            continue;
        }
        const char *unit = clx_own_unit(&table->column[c]);
        const bool is_plain = strcmp(unit, "-") == 0;
        CLX_CHECK(strcmp(unit, wanted) == 0 || is_plain, CLAST_E_FORMAT,
                  "table %s: column '%s' is in %s, model %s takes %s", table->name, name, unit,
                  model->name, strcmp(wanted, "-") == 0 ? "plain numbers" : wanted);
        CLX_CHECK(strcmp(unit, wanted) == 0 || plain_is_si, CLAST_E_FORMAT,
                  "table %s: column '%s' has no unit, model %s takes it in %s; write it with each "
                  "number, as in 1%s",
                  table->name, name, model->name, wanted, wanted);
    }
done:
    return status;
}

clast_status clast_porosity_model_check_units(const clast_porosity_model *model,
                                              const clast_table *table)
{
    CLX_ARGUMENTS(model, table);
    CLX_WHOLE(porosity_model, model);
    CLX_WHOLE(table, table);
    clast_status status = CLAST_OK;
    clx_unit_columns columns = {0};
    CLX_TRY(clx_unit_columns_read(table, &columns));
    CLX_TRY(check_units(model, &columns.table, false));
done:
    clx_unit_columns_free(&columns);
    return status;
}

clast_status clast_porosity_predict_columns(const clast_porosity_model *model,
                                            const clast_table *table, clast_table *beds)
{
    CLX_ARGUMENTS(model, table, beds);
    CLX_WHOLE(porosity_model, model);
    CLX_WHOLE(table, table);
    clast_status status = CLAST_OK;
    clast_table t = {0};
    clx_unit_columns columns = {0};
    const double **column = NULL;
    double *value = NULL;
    const int32_t m = model->n_term + model->n_range;
    int64_t n = 0;
    CLX_CHECK(model->kind == CLAST_MODEL_COLUMNS, CLAST_E_USAGE,
              "model %s takes forms, not columns of a table", model->name);
    CLX_TRY(clx_alloc(&column, m, sizeof *column));
    CLX_TRY(clx_alloc(&value, m, sizeof *value));
    CLX_TRY(clx_unit_columns_read(table, &columns));
    CLX_TRY(find_columns(model, &columns.table, column));
    CLX_TRY(check_units(model, &columns.table, true));
    CLX_TRY(clx_predicted_beds_init(table->n_row, &t));
    for (int64_t i = 0; i < table->n_row; ++i) {
        clast_prediction p = {0};
        bool is_finite = true;
        for (int32_t k = 0; k < m; ++k) {
            value[k] = column[k][i];
            is_finite = is_finite && isfinite(value[k]);
        }
        if (!is_finite) {
            continue;
        }
        CLX_TRY(clx_predicted_bed(clx_porosity_model_apply(model, value, value + model->n_term, &p),
                                  &p, i, n++, &t));
    }
    CLX_CHECK(n > 0, CLAST_E_FORMAT, "table %s: none of its %lld rows has all that model %s needs",
              table->name, (long long)table->n_row, model->name);
    CLX_TRY(clast_table_resize(&t, n));
    *beds = t;
    t = (clast_table){0};
done:
    clast_table_free(&t);
    clx_unit_columns_free(&columns);
    CLX_FREE((void *)column, value);
    return status;
}
