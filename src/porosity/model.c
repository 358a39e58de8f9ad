// Porosity models: the five published ones, and what all models share.
//
// Source: Rettinger, Ruede, Vollmer, Frings, Granular Matter 24 (2022) 118, eqs 17-19, 23, 24 and
// Tables 9, 10.
#include "porosity/model.h"

#include "base/alloc.h"
#include "base/status.h"
#include <clast/porosity_model.h>
#include <math.h>
#include <string.h>

enum { MAX_TERM = 4, N_SINGLE_RANGE = 3, N_MIXTURE_RANGE = 4 };

typedef struct {
    const char *feature;
    double low, high;
} range;

typedef struct {
    const char *name;
    clast_model_kind kind;
    double intercept;
    double coefficient[MAX_TERM];
    double mean_error; ///< cross-validated mean absolute error
    double r2;
} published;

static const char *const single_feature[] = {"inverse_equancy", "inverse_elongation"};
static const char *const mixture_feature[] = {"inverse_mean_equancy", "inverse_deviation_equancy",
                                              "inverse_mean_elongation",
                                              "inverse_deviation_elongation"};

// 0.647 -+ 2 * 0.175 and 0.682 -+ 2 * 0.139 (Fig. 2, Table 2), cut at 1. L/S: medians of the least
// and the greatest of 63 grains drawn from these two normal laws (4000 draws).
static const range single_range[N_SINGLE_RANGE] = {
    {"flatness", 0.297, 0.997}, {"elongation", 0.404, 0.960}, {"inverse_equancy", 1.28, 6.92}};
// Table 2's ranges as sec. 2.2 gives them ("for which we consider our model to be applicable", sec.
// 7.2), the mean flatness no less than the least of the set-ups of sec. 7.1.
static const range mixture_range[N_MIXTURE_RANGE] = {{"mean_flatness", 0.4, 0.8},
                                                     {"deviation_flatness", 0.13, 0.2},
                                                     {"mean_elongation", 0.68, 0.77},
                                                     {"deviation_elongation", 0.12, 0.17}};

static const published models[CLAST_N_PUBLISHED_MODEL] = {
    {"single_form_U1", CLAST_MODEL_SINGLE, 0.278, {0.019, 0.014}, 4.66e-3, NAN},   // eq. 17
    {"single_form_U7", CLAST_MODEL_SINGLE, 0.234, {0.014, 0.007}, 3.73e-3, NAN},   // eq. 18
    {"single_form_B50", CLAST_MODEL_SINGLE, 0.217, {0.014, -0.006}, 6.46e-3, NAN}, // eq. 19
    // eq. 23: the text keeps all four features, so the fourth is 0.000 to the printed digits
    {"form_mixture_U1", CLAST_MODEL_MIXTURE, 0.287, {0.032, -0.003, 0.011, 0.0}, 4.33e-3, 0.980},
    {"form_mixture_U7", CLAST_MODEL_MIXTURE, 0.239, {0.024, -0.003, 0.002, 0.001}, 5.33e-3, 0.914},
};
enum { N_BED_SINGLE = 63, N_BED_MIXTURE = 52 };

const char *clast_model_kind_name(clast_model_kind kind)
{
    static const char *const name[3] = {"single_form", "form_mixture", "columns"};
    return (unsigned)kind < 3 ? name[kind] : "unknown";
}

void clast_porosity_model_free(clast_porosity_model *model)
{
    if (model == NULL) {
        return;
    }
    for (int32_t k = 0; model->term != NULL && k < model->n_term; ++k) {
        CLX_FREE(model->term[k].feature, model->term[k].unit);
    }
    for (int32_t k = 0; model->range != NULL && k < model->n_range; ++k) {
        clx_free(model->range[k].feature);
    }
    CLX_FREE(model->name, model->source, model->term, model->range, model->covariance);
    *model = (clast_porosity_model){0};
}

clast_status clx_model_alloc(const char *name, const char *source, int32_t n_term, int32_t n_range,
                             bool has_covariance, clast_porosity_model *model)
{
    CLAST_ASSERT(n_term >= 0 && n_range >= 0);
    clast_status status = CLAST_OK;
    clast_porosity_model m = {.n_term = n_term,
                              .n_range = n_range,
                              .r2 = NAN,
                              .cv_mean_error = NAN,
                              .cv_median_error = NAN,
                              .leverage_limit = NAN};
    const int64_t p = (int64_t)n_term + 1;
    CLX_TRY(clx_alloc_text(&m.name, name));
    CLX_TRY(clx_alloc_text(&m.source, source));
    CLX_TRY(clx_alloc(&m.term, n_term, sizeof *m.term));
    CLX_TRY(clx_alloc(&m.range, n_range, sizeof *m.range));
    if (has_covariance) {
        CLX_TRY(clx_alloc(&m.covariance, p * p, sizeof *m.covariance));
    }
    *model = m;
    m = (clast_porosity_model){0};
done:
    clast_porosity_model_free(&m);
    return status;
}

int32_t clast_porosity_model_find(const char *name)
{
    if (name == NULL) {
        return -1;
    }
    for (int32_t k = 0; k < CLAST_N_PUBLISHED_MODEL; ++k) {
        if (strcmp(models[k].name, name) == 0) {
            return k;
        }
    }
    return -1;
}

clast_status clast_porosity_model_published(int32_t number, clast_porosity_model *model)
{
    CLX_ARGUMENTS(model);
    clast_status status = CLAST_OK;
    clast_porosity_model m = {0};
    CLX_CHECK(number >= 0 && number < CLAST_N_PUBLISHED_MODEL, CLAST_E_USAGE,
              "published model %d: 0 to %d are known", number, CLAST_N_PUBLISHED_MODEL - 1);
    const published *p = &models[number];
    const bool is_single = p->kind == CLAST_MODEL_SINGLE;
    const int32_t n_term = is_single ? 2 : 4;
    const int32_t n_range = is_single ? N_SINGLE_RANGE : N_MIXTURE_RANGE;
    CLX_TRY(clx_model_alloc(p->name, "Rettinger et al., Granular Matter 24 (2022) 118", n_term,
                            n_range, false, &m));
    for (int32_t k = 0; k < n_term; ++k) {
        CLX_TRY(
            clx_alloc_text(&m.term[k].feature, is_single ? single_feature[k] : mixture_feature[k]));
        m.term[k].coefficient = p->coefficient[k];
    }
    for (int32_t k = 0; k < n_range; ++k) {
        const range *r = is_single ? &single_range[k] : &mixture_range[k];
        CLX_TRY(clx_alloc_text(&m.range[k].feature, r->feature));
        m.range[k].low = r->low;
        m.range[k].high = r->high;
    }
    m.kind = p->kind;
    m.intercept = p->intercept;
    m.rounding = 0.0005;
    m.deviation = sqrt(0.5 * CLAST_PI) * p->mean_error;
    m.n_bed = is_single ? N_BED_SINGLE : N_BED_MIXTURE;
    m.r2 = p->r2;
    m.cv_mean_error = p->mean_error;
    *model = m;
    m = (clast_porosity_model){0};
done:
    clast_porosity_model_free(&m);
    return status;
}
