// Fuzz: model files. What is read must also be written and read back alike, and applied.
#include <clast/porosity_model.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const double mean[2] = {0.6, 0.7};
    const double deviation[2] = {0.1, 0.1};
    clast_porosity_model model = {0};
    clast_form_inputs in = {0};
    clast_prediction p = {0};
    if (clast_porosity_model_parse("fuzz", data, size, &model) == CLAST_OK) {
        if (clast_form_inputs_from_moments(mean, deviation, 10, &in) == CLAST_OK) {
            (void)clast_porosity_predict_moments(&model, &in, &p);
        }
        clast_porosity_model_free(&model);
    }
    return 0;
}
