// Where the results of a command came from.
#include "manifest.h"

#include <stdio.h>

clast_status cli_manifest_begin(const cli_common *common, clast_manifest **manifest)
{
    *manifest = NULL;
    return common->output == NULL
               ? CLAST_OK
               : clast_manifest_create(common->command, common->n_word, common->word, manifest);
}

clast_status cli_manifest_end(const cli_common *common, clast_manifest *manifest,
                              const clast_field *fields, const void *config, uint64_t seed,
                              const cli_input *input)
{
    char path[4096];
    if (manifest == NULL) {
        return CLAST_OK;
    }
    clast_manifest_seed(manifest, seed);
    clast_status status = clast_manifest_config(manifest, fields, config);
    for (; input->role != NULL && status == CLAST_OK; ++input) {
        if (input->path != NULL && input->path[0] != '\0') {
            status = clast_manifest_input(manifest, input->role, input->path);
        }
    }
    (void)snprintf(path, sizeof path, "%s/manifest.json", common->output);
    return status == CLAST_OK ? clast_manifest_write(manifest, "done", path) : status;
}
