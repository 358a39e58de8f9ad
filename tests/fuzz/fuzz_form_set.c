// Fuzz: tables of grains, from text to a prediction.
#include <clast/porosity_model.h>
#include <clast/statistics.h>
#include <clast/table.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void use(const clast_table *table)
{
    const clast_bootstrap few = {.n_resample = 3, .level = 0.9, .seed = 1};
    clast_form_set set = {0};
    clast_table factors = {0};
    clast_statistics statistics = {0};
    char text[256];
    if (clast_form_set_of(table, NULL, &set) != CLAST_OK) {
        return;
    }
    clast_form_set_complaint(&set, sizeof text, text);
    if (clast_form_set_factors(&set, &factors) == CLAST_OK &&
        clast_statistics_of(&factors, &few, &statistics) == CLAST_OK) {
        clast_statistics_free(&statistics);
    }
    for (int32_t k = 0; k < CLAST_N_PUBLISHED_MODEL; ++k) {
        clast_porosity_model model = {0};
        clast_form_inputs in = {0};
        clast_prediction p = {0};
        if (clast_porosity_model_published(k, &model) == CLAST_OK) {
            (void)clast_porosity_predict_set(&model, &set, &few, &in, &p);
            clast_porosity_model_free(&model);
        }
    }
    clast_table_free(&factors);
    clast_form_set_free(&set);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    clast_table table = {0};
    if (clast_table_parse_csv("fuzz", data, size, NULL, &table, NULL) == CLAST_OK) {
        use(&table);
        clast_table_free(&table);
    }
    return 0;
}
