// Fuzz: YAML configurations over the largest field table.
#include <clast/aggregate_run.h>
#include <clast/field.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    clast_aggregate_config config;
    char *text = malloc(size + 1);
    if (text != NULL && clast_fields_default(clast_aggregate_fields, &config) == CLAST_OK) {
        memcpy(text, data, size);
        text[size] = '\0';
        (void)clast_fields_parse("fuzz", text, clast_aggregate_fields, &config);
        clast_fields_free(clast_aggregate_fields, &config);
    }
    free(text);
    return 0;
}
