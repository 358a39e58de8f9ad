// Porosity models as JSON files.
//
//   {"format": "clast porosity model", "version": 1, "name": "...", "source": "...",
//    "kind": "single_form", "intercept": 0.28, "terms": [{"feature": "...", "coefficient": ...,
//    "unit": "m"}],
//    "ranges": [{"feature": "...", "low": ..., "high": ...}], "covariance": [[...]],
//    "rounding": 0, "deviation": 0.005, "n_bed": 63, "r2": ..., "cv_mean_error": ...,
//    "cv_median_error": ..., "leverage_limit": ..., "provenance": {...}}
//
// A file is checked against itself before it is used: known features, finite numbers, ordered
// ranges, a covariance that is symmetric with a diagonal >= 0. Unknown keys are refused, as a
// misspelt key would otherwise be ignored; provenance is free.
#include <clast/porosity_model.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/status.h"
#include "porosity/model.h"
#include "porosity/whole.h"
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const int64_t FILE_LIMIT = 1 << 20;
enum { MAX_TERM = 1000 };

typedef struct {
    const char *path;
    const json_t *root;
} reader;

static clast_status check_keys(const reader *r)
{
    static const char *const known[] = {
        "format",         "version",   "name",   "source",        "kind",
        "intercept",      "terms",     "ranges", "covariance",    "rounding",
        "deviation",      "n_bed",     "r2",     "cv_mean_error", "cv_median_error",
        "leverage_limit", "provenance"};
    clast_status status = CLAST_OK;
    for (void *at = json_object_iter((json_t *)r->root); at != NULL;
         at = json_object_iter_next((json_t *)r->root, at)) {
        bool found = false;
        const char *key = json_object_iter_key(at);
        for (size_t k = 0; k < sizeof known / sizeof known[0]; ++k) {
            found = found || strcmp(key, known[k]) == 0;
        }
        CLX_CHECK(found, CLAST_E_FORMAT, "%s: unknown key '%.60s'", r->path, key);
    }
    const json_t *value = json_object_get(r->root, "format");
    CLX_CHECK(json_is_string(value) &&
                  strcmp(json_string_value(value), "clast porosity model") == 0,
              CLAST_E_FORMAT,
              "%s is no model file: its key 'format' is not \"clast porosity model\"", r->path);
    value = json_object_get(r->root, "version");
    CLX_CHECK(json_is_integer(value) && json_integer_value(value) == 1, CLAST_E_FORMAT,
              "%s: model files of version 1 are read, this has another", r->path);
done:
    return status;
}

/// A finite number; `fallback` if the key is missing or null and may be (not NaN-checked).
static clast_status number(const reader *r, const json_t *object, const char *key, bool needed,
                           double fallback, double *value)
{
    clast_status status = CLAST_OK;
    const json_t *v = json_object_get(object, key);
    if (!needed && (v == NULL || json_is_null(v))) {
        *value = fallback;
        return CLAST_OK;
    }
    CLX_CHECK(json_is_number(v) && isfinite(json_number_value(v)), CLAST_E_FORMAT,
              "%s: '%s' is missing or no finite number", r->path, key);
    *value = json_number_value(v);
done:
    return status;
}

static clast_status text(const reader *r, const json_t *object, const char *key, const char **value)
{
    clast_status status = CLAST_OK;
    const json_t *v = json_object_get(object, key);
    const char *bytes = json_string_value(v);
    const size_t n = bytes != NULL ? strlen(bytes) : 0;
    CLX_CHECK(n > 0 && n < 1000 && n == json_string_length(v), CLAST_E_FORMAT,
              "%s: '%s' is missing or no text of 1 to 999 bytes", r->path, key);
    *value = bytes;
done:
    return status;
}

static clast_status list(const reader *r, const char *key, int32_t *n)
{
    clast_status status = CLAST_OK;
    const json_t *v = json_object_get(r->root, key);
    CLX_CHECK(json_is_array(v), CLAST_E_FORMAT, "%s: '%s' is missing or no list", r->path, key);
    CLX_CHECK(json_array_size(v) <= MAX_TERM, CLAST_E_LIMIT, "%s: '%s' has %zu entries, %d at most",
              r->path, key, json_array_size(v), MAX_TERM);
    *n = (int32_t)json_array_size(v);
done:
    return status;
}

static clast_status read_kind(const reader *r, clast_model_kind *kind)
{
    clast_status status = CLAST_OK;
    const char *name = "";
    CLX_TRY(text(r, r->root, "kind", &name));
    for (int k = 0; k <= CLAST_MODEL_COLUMNS; ++k) {
        if (strcmp(name, clast_model_kind_name((clast_model_kind)k)) == 0) {
            *kind = (clast_model_kind)k;
            return CLAST_OK;
        }
    }
    CLX_CHECK(false, CLAST_E_FORMAT,
              "%s: kind '%.40s' is none of single_form, form_mixture and columns", r->path, name);
done:
    return status;
}

/// The feature's name of entry k of a list, known to the model's kind.
static clast_status read_feature(const reader *r, clast_model_kind kind, const json_t *entry,
                                 char **feature)
{
    clast_status status = CLAST_OK;
    const char *name = "";
    CLX_TRY(text(r, entry, "feature", &name));
    CLX_CHECK(kind == CLAST_MODEL_COLUMNS ||
                  (kind == CLAST_MODEL_SINGLE ? clast_form_feature_find(name)
                                              : clast_mixture_feature_find(name)) >= 0,
              CLAST_E_FORMAT, "%s: '%.60s' is no feature of a %s model", r->path, name,
              clast_model_kind_name(kind));
    CLX_TRY(clx_alloc_text(feature, name));
done:
    return status;
}

/// Files of before have none.
static clast_status read_unit(const reader *r, const json_t *entry, char **unit)
{
    clast_status status = CLAST_OK;
    const char *name = "";
    if (json_object_get(entry, "unit") != NULL) {
        CLX_TRY(text(r, entry, "unit", &name));
        CLX_TRY(clx_alloc_text(unit, name));
    }
done:
    return status;
}

static clast_status read_terms(const reader *r, clast_porosity_model *m)
{
    clast_status status = CLAST_OK;
    const json_t *terms = json_object_get(r->root, "terms");
    const json_t *ranges = json_object_get(r->root, "ranges");
    for (int32_t k = 0; k < m->n_term; ++k) {
        const json_t *entry = json_array_get(terms, (size_t)k);
        CLX_TRY(read_feature(r, m->kind, entry, &m->term[k].feature));
        CLX_TRY(number(r, entry, "coefficient", true, 0.0, &m->term[k].coefficient));
        CLX_TRY(read_unit(r, entry, &m->term[k].unit));
    }
    for (int32_t k = 0; k < m->n_range; ++k) {
        const json_t *entry = json_array_get(ranges, (size_t)k);
        clast_model_range *range = &m->range[k];
        CLX_TRY(read_feature(r, m->kind, entry, &range->feature));
        CLX_TRY(number(r, entry, "low", true, 0.0, &range->low));
        CLX_TRY(number(r, entry, "high", true, 0.0, &range->high));
        CLX_CHECK(range->low <= range->high, CLAST_E_FORMAT, "%s: the range of '%.60s' is empty",
                  r->path, range->feature);
    }
done:
    return status;
}

static clast_status read_covariance(const reader *r, clast_porosity_model *m)
{
    clast_status status = CLAST_OK;
    const json_t *rows = json_object_get(r->root, "covariance");
    const int32_t p = m->n_term + 1;
    CLX_CHECK(json_is_array(rows) && json_array_size(rows) == (size_t)p, CLAST_E_FORMAT,
              "%s: 'covariance' is no list of %d rows (intercept, then terms)", r->path, p);
    for (int32_t k = 0; k < p * p; ++k) {
        const json_t *row = json_array_get(rows, (size_t)(k / p));
        const json_t *v = json_array_get(row, (size_t)(k % p));
        CLX_CHECK(json_array_size(row) == (size_t)p && json_is_number(v) &&
                      isfinite(json_number_value(v)),
                  CLAST_E_FORMAT, "%s: row %d of 'covariance' is no list of %d numbers", r->path,
                  k / p + 1, p);
        m->covariance[k] = json_number_value(v);
    }
    for (int32_t k = 0; k < p * p; ++k) {
        const double *c = m->covariance;
        const double a = c[k];
        const double b = c[(k % p) * p + k / p];
        CLX_CHECK(fabs(a - b) <= 1e-9 * (fabs(a) + fabs(b)) && c[(k % p) * (p + 1)] >= 0.0,
                  CLAST_E_FORMAT, "%s: 'covariance' is not symmetric with a diagonal of 0 or more",
                  r->path);
    }
done:
    return status;
}

static clast_status read_figures(const reader *r, clast_porosity_model *m)
{
    clast_status status = CLAST_OK;
    double n_bed = 0.0;
    CLX_TRY(number(r, r->root, "intercept", true, 0.0, &m->intercept));
    CLX_TRY(number(r, r->root, "deviation", true, 0.0, &m->deviation));
    CLX_TRY(number(r, r->root, "rounding", false, 0.0, &m->rounding));
    CLX_TRY(number(r, r->root, "n_bed", false, 0.0, &n_bed));
    CLX_TRY(number(r, r->root, "r2", false, NAN, &m->r2));
    CLX_TRY(number(r, r->root, "cv_mean_error", false, NAN, &m->cv_mean_error));
    CLX_TRY(number(r, r->root, "cv_median_error", false, NAN, &m->cv_median_error));
    CLX_TRY(number(r, r->root, "leverage_limit", false, NAN, &m->leverage_limit));
    CLX_CHECK(m->deviation >= 0.0 && m->rounding >= 0.0, CLAST_E_FORMAT,
              "%s: 'deviation' and 'rounding' must not be negative", r->path);
    CLX_CHECK(n_bed >= 0.0 && n_bed <= 1e15, CLAST_E_FORMAT, "%s: 'n_bed' is no count", r->path);
    m->n_bed = (int64_t)n_bed;
done:
    return status;
}

static clast_status read_model(const reader *r, clast_porosity_model *model)
{
    clast_status status = CLAST_OK;
    clast_porosity_model m = {0};
    const char *name = NULL;
    const char *source = NULL;
    int32_t n_term = 0;
    int32_t n_range = 0;
    const json_t *covariance = json_object_get(r->root, "covariance");
    const bool has_covariance = covariance != NULL && !json_is_null(covariance);
    CLX_TRY(check_keys(r));
    CLX_TRY(text(r, r->root, "name", &name));
    CLX_TRY(text(r, r->root, "source", &source));
    CLX_TRY(list(r, "terms", &n_term));
    CLX_TRY(list(r, "ranges", &n_range));
    CLX_TRY(clx_model_alloc(name, source, n_term, n_range, has_covariance, &m));
    CLX_TRY(read_kind(r, &m.kind));
    CLX_TRY(read_figures(r, &m));
    CLX_TRY(read_terms(r, &m));
    if (has_covariance) {
        CLX_TRY(read_covariance(r, &m));
    }
    *model = m;
    m = (clast_porosity_model){0};
done:
    clast_porosity_model_free(&m);
    return status;
}

clast_status clast_porosity_model_parse(const char *name, const void *bytes, size_t n,
                                        clast_porosity_model *model)
{
    CLX_ARGUMENTS(name, model);
    CLX_ARRAY(bytes, n);
    clast_status status = CLAST_OK;
    json_error_t error;
    json_t *root = NULL;
    CLX_CHECK((int64_t)n <= FILE_LIMIT, CLAST_E_LIMIT, "%s: a model file has 1 MiB at most", name);
    root = json_loadb(bytes, n, JSON_REJECT_DUPLICATES, &error);
    CLX_CHECK(root != NULL, CLAST_E_FORMAT, "%s, line %d: not JSON (%.100s)", name, error.line,
              error.text);
    CLX_CHECK(json_is_object(root), CLAST_E_FORMAT, "%s: no JSON object", name);
    const reader r = {.path = name, .root = root};
    CLX_TRY(read_model(&r, model));
done:
    json_decref(root);
    return status;
}

clast_status clast_porosity_model_read(const char *path, clast_porosity_model *model)
{
    CLX_ARGUMENTS(path, model);
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    int64_t n = 0;
    CLX_TRY(clx_file_read_all(path, FILE_LIMIT, &bytes, &n));
    CLX_TRY(clast_porosity_model_parse(path, bytes, (size_t)n, model));
done:
    clx_free(bytes);
    return status;
}

static json_t *real_or_null(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

/// Text as JSON; one that is not UTF-8 is told so, as JSON cannot hold it.
static json_t *plain(const char *text)
{
    json_t *value = json_string(text);
    return value != NULL ? value : json_string("(not UTF-8)");
}

static json_t *write_terms(const clast_porosity_model *m)
{
    json_t *terms = json_array();
    for (int32_t k = 0; k < m->n_term; ++k) {
        json_t *entry = json_object();
        (void)json_object_set_new(entry, "feature", json_string(m->term[k].feature));
        (void)json_object_set_new(entry, "coefficient", real_or_null(m->term[k].coefficient));
        if (m->term[k].unit != NULL) {
            (void)json_object_set_new(entry, "unit", plain(m->term[k].unit));
        }
        (void)json_array_append_new(terms, entry);
    }
    return terms;
}

static json_t *write_ranges(const clast_porosity_model *m)
{
    json_t *ranges = json_array();
    for (int32_t k = 0; k < m->n_range; ++k) {
        json_t *entry = json_object();
        (void)json_object_set_new(entry, "feature", json_string(m->range[k].feature));
        (void)json_object_set_new(entry, "low", real_or_null(m->range[k].low));
        (void)json_object_set_new(entry, "high", real_or_null(m->range[k].high));
        (void)json_array_append_new(ranges, entry);
    }
    return ranges;
}

static json_t *write_covariance(const clast_porosity_model *m)
{
    const int32_t p = m->n_term + 1;
    json_t *rows = json_array();
    for (int32_t i = 0; i < p; ++i) {
        json_t *row = json_array();
        for (int32_t j = 0; j < p; ++j) {
            (void)json_array_append_new(row, real_or_null(m->covariance[i * p + j]));
        }
        (void)json_array_append_new(rows, row);
    }
    return rows;
}

static json_t *model_json(const clast_porosity_model *m, const char *const (*provenance)[2],
                          int32_t n)
{
    json_t *root = json_object();
    json_t *notes = json_object();
    (void)json_object_set_new(root, "format", json_string("clast porosity model"));
    (void)json_object_set_new(root, "version", json_integer(1));
    (void)json_object_set_new(root, "name", plain(m->name));
    (void)json_object_set_new(root, "source", plain(m->source));
    (void)json_object_set_new(root, "kind", json_string(clast_model_kind_name(m->kind)));
    (void)json_object_set_new(root, "intercept", real_or_null(m->intercept));
    (void)json_object_set_new(root, "terms", write_terms(m));
    (void)json_object_set_new(root, "ranges", write_ranges(m));
    (void)json_object_set_new(root, "covariance",
                              m->covariance != NULL ? write_covariance(m) : json_null());
    (void)json_object_set_new(root, "rounding", real_or_null(m->rounding));
    (void)json_object_set_new(root, "deviation", real_or_null(m->deviation));
    (void)json_object_set_new(root, "n_bed", json_integer((json_int_t)m->n_bed));
    (void)json_object_set_new(root, "r2", real_or_null(m->r2));
    (void)json_object_set_new(root, "cv_mean_error", real_or_null(m->cv_mean_error));
    (void)json_object_set_new(root, "cv_median_error", real_or_null(m->cv_median_error));
    (void)json_object_set_new(root, "leverage_limit", real_or_null(m->leverage_limit));
    for (int32_t k = 0; k < n; ++k) {
        (void)json_object_set_new(notes, provenance[k][0], plain(provenance[k][1]));
    }
    (void)json_object_set_new(root, "provenance", notes);
    return root;
}

clast_status clast_porosity_model_write(const clast_porosity_model *model,
                                        const char *const (*provenance)[2], int32_t n,
                                        const char *path)
{
    CLX_ARGUMENTS(model, path);
    CLX_ARRAY(provenance, n);
    CLX_WHOLE(porosity_model, model);
    clast_status status = CLAST_OK;
    json_t *root = NULL;
    char *dump = NULL;
    clx_file file = {0};
    for (int32_t k = 0; k < model->n_term; ++k) {
        json_t *name = json_string(model->term[k].feature);
        const bool is_text = name != NULL;
        json_decref(name);
        CLX_CHECK(is_text, CLAST_E_FORMAT,
                  "model %s: the name of feature %d is not UTF-8; rename the column", model->name,
                  k + 1);
    }
    root = model_json(model, provenance, n);
    dump = json_dumps(root, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    CLX_CHECK(dump != NULL, CLAST_E_MEMORY, "no memory to write model %s", model->name);
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_file_write(&file, dump, strlen(dump)));
    CLX_TRY(clx_file_write(&file, "\n", 1));
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    free(dump);
    json_decref(root);
    return status;
}
