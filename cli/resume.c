// What may not stand beside --resume.
#include "resume.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/// The field's values differ; lists of unequal length do.
static bool differs(const clast_field *field, const void *a, const void *b)
{
    const int32_t n = clast_field_count(field, a);
    bool is_other = n != clast_field_count(field, b);
    for (int32_t i = 0; i < n && !is_other; ++i) {
        char text[2][512] = {"", ""};
        (void)clast_field_format(field, a, i, sizeof text[0], text[0]);
        (void)clast_field_format(field, b, i, sizeof text[1], text[1]);
        is_other = strcmp(text[0], text[1]) != 0;
    }
    return is_other;
}

clast_status cli_resume_check(const cli_common *common, const char *folder,
                              const clast_field *fields, const void *config, size_t size,
                              const char *free_option)
{
    const char *changed = NULL;
    clast_status status = CLAST_OK;
    void *fresh = calloc(1, size);
    CLI_TRY(fresh == NULL ? CLAST_E_MEMORY : clast_fields_default(fields, fresh));
    for (const clast_field *f = fields; f->name != NULL && changed == NULL; ++f) {
        const bool is_free = strcmp(f->name, "resume") == 0 ||
                             (free_option != NULL && strcmp(f->name, free_option) == 0);
        const bool is_other = !is_free && differs(f, config, fresh);
        changed = is_other ? f->name : NULL;
    }
    clast_fields_free(fields, fresh);
    if (access(folder, F_OK) != 0) { // whose reader says that it is not there
        changed = NULL;
    }
    CLI_CHECK(changed == NULL, CLAST_E_USAGE, "--resume takes every option from %s; drop %s",
              folder, changed);
    CLI_CHECK(common->output == NULL, CLAST_E_USAGE, "--resume writes into %s; drop -o", folder);
done:
    free(fresh);
    return status;
}
