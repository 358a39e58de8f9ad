// Whether ranks read the same: machines may have copies of their own, one of them an old one, and
// what the ranks then make is the result of neither.
#include "run/run.h"

#include "base/alloc.h"
#include "base/comm.h"
#include "io/config_files.h"
#include <clast/field.h>
#include <clast/machine.h>
#include <jansson.h>
#include <string.h>
#include <sys/stat.h>

enum { DIGEST = 65 };

/// What a rank reads: the options as JSON, then each file's digest, "" of what is none.
typedef struct {
    int64_t n, n_text; ///< bytes of all, of the text
    char *bytes;       ///< a text, then [n_file][DIGEST]
} reading;

static clast_status read_all(const clast_field *fields, const void *config, int32_t n_file,
                             const char *const *file, reading *own)
{
    clast_status status = CLAST_OK;
    char *text = NULL;
    struct stat found;
    CLX_TRY(clast_fields_json(fields, config, &text));
    own->n_text = (int64_t)strlen(text) + 1;
    own->n = own->n_text + (int64_t)n_file * DIGEST;
    CLX_TRY(clx_alloc(&own->bytes, own->n, 1));
    memcpy(own->bytes, text, (size_t)own->n_text);
    char *digest = own->bytes + own->n_text;
    for (int32_t i = 0; i < n_file; ++i, digest += DIGEST) {
        if (stat(file[i], &found) == 0 && S_ISREG(found.st_mode)) { // who needs it says what lacks
            CLX_TRY(clast_sha256_file(file[i], digest, NULL));
        }
    }
done:
    clast_text_free(text);
    return status;
}

/// The first option that differs between two texts of JSON.
static clast_status name_option(const char *own, const char *first)
{
    const char *key = NULL;
    const char *name = "the seed"; // beyond what JSON's numbers tell apart
    json_t *value = NULL;
    json_t *here = json_loads(own, JSON_DECODE_INT_AS_REAL, NULL);
    json_t *there = json_loads(first, JSON_DECODE_INT_AS_REAL, NULL);
    json_object_foreach(here, key, value)
    {
        if (!json_equal(value, json_object_get(there, key))) {
            name = key;
            break;
        }
    }
    const clast_status status = clx_fail(
        CLAST_E_FORMAT,
        "reads another configuration than rank 0 (%s differs); put it on a disk that all ranks see",
        name);
    json_decref(here);
    json_decref(there);
    return status;
}

static clast_status compare(const reading *own, const clx_gathered *first, int32_t n_file,
                            const char *const *file)
{
    clast_status status = CLAST_OK;
    if (strcmp(own->bytes, first->bytes) != 0) {
        return name_option(own->bytes, first->bytes);
    }
    CLX_CHECK(own->n == first->n, CLAST_E_FORMAT, "reads another number of files than rank 0");
    for (int32_t i = 0; i < n_file; ++i) {
        const int64_t at = own->n_text + (int64_t)i * DIGEST;
        const char *here = own->bytes + at;
        const char *there = first->bytes + at;
        CLX_CHECK(here[0] == '\0' || there[0] == '\0' || strcmp(here, there) == 0, CLAST_E_FORMAT,
                  "reads another %s than rank 0; put it on a disk that all ranks see", file[i]);
    }
done:
    return status;
}

clast_status clast_run_inputs_agree(const clast_comm *comm, const clast_field *fields,
                                    const void *config, int32_t n_file, const char *const *file)
{
    CLX_ARGUMENTS(fields, config);
    CLX_ARRAY(file, n_file);
    for (int32_t i = 0; i < n_file; ++i) {
        CLX_ARGUMENTS(file[i]);
    }
    clast_status status = CLAST_OK;
    const clast_comm *all = clx_comm_or_one(comm);
    reading own = {0};
    clx_gathered first = {0};
    if (all->n_rank == 1) {
        return CLAST_OK;
    }
    CLX_TRY(clast_comm_agree(all, read_all(fields, config, n_file, file, &own), NULL));
    CLX_TRY(clx_comm_first(all, own.bytes, own.n, &first));
    if (own.bytes != NULL && first.bytes != NULL) { // always, once all have agreed
        status = compare(&own, &first, n_file, file);
    }
    CLX_TRY(clast_comm_agree(all, status, NULL));
done:
    clx_gathered_free(&first);
    clx_free(own.bytes);
    return status;
}

clast_status clx_run_check_ranks(const clast_comm *comm, const clx_run_inputs *inputs)
{
    clast_status status = CLAST_OK;
    const char **file = NULL;
    const char *role = NULL;
    int32_t n = 0;
    while (inputs->file(inputs->config, n, &role) != NULL) {
        ++n;
    }
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&file, n, sizeof *file), NULL));
    for (int32_t i = 0; i < n; ++i) {
        file[i] = inputs->file(inputs->config, i, &role);
    }
    CLX_TRY(clast_run_inputs_agree(comm, inputs->fields, inputs->config, n, file));
done:
    clx_free((void *)file);
    return status;
}
