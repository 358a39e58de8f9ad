// JSON on stdout.
#include "json.h"

#include <clast/clast.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const size_t LAYOUT = JSON_INDENT(2) | JSON_REAL_PRECISION(17);

clast_status cli_print_json(json_t *object)
{
    if (object == NULL) {
        return CLAST_E_MEMORY;
    }
    const int failed = json_dumpf(object, stdout, LAYOUT);
    (void)putchar('\n');
    json_decref(object);
    return failed != 0 ? CLAST_E_DISK : CLAST_OK;
}

clast_status cli_write_summary(const json_t *object, const clast_run_folder *run)
{
    char *text = object != NULL ? json_dumps(object, LAYOUT) : NULL;
    const clast_status status = text != NULL ? clast_run_folder_summary(run, text) : CLAST_E_MEMORY;
    free(text); // jansson's
    return status;
}

void cli_json_number(json_t *object, const char *key, double value)
{
    (void)json_object_set_new(object, key, isfinite(value) ? json_real(value) : json_null());
}

void cli_json_count(json_t *object, const char *key, int64_t value)
{
    (void)json_object_set_new(object, key, json_integer((json_int_t)value));
}

void cli_json_seed(json_t *object, const char *key, uint64_t seed)
{
    (void)json_object_set_new(object, key,
                              seed <= INT64_MAX ? json_integer((json_int_t)seed)
                                                : json_sprintf("%" PRIu64, seed));
}

void cli_json_bool(json_t *object, const char *key, bool value)
{
    (void)json_object_set_new(object, key, json_boolean(value));
}

/// JSON is UTF-8; a file's name may be any bytes, and those that are not then become \xNN.
static json_t *plain_text(const char *value)
{
    char plain[4096];
    return json_string(clast_text_printable(value, sizeof plain, plain));
}

void cli_json_text(json_t *object, const char *key, const char *value)
{
    json_t *text = value != NULL ? json_string(value) : json_null();
    (void)json_object_set_new(object, key, text != NULL ? text : plain_text(value));
}
