// JSON on stdout.
#include "json.h"

#include "command.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

clast_status cli_print_json(json_t *object)
{
    if (object == NULL) {
        return CLAST_E_MEMORY;
    }
    const int failed = json_dumpf(object, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    (void)putchar('\n');
    json_decref(object);
    return failed != 0 ? CLAST_E_DISK : CLAST_OK;
}

clast_status cli_write_summary(const json_t *object, const char *folder)
{
    char path[4096], part[4096 + 8];
    const int n = snprintf(path, sizeof path, "%s/summary.json", folder);
    if (object == NULL) {
        return CLAST_E_MEMORY;
    }
    (void)snprintf(part, sizeof part, "%s.part", path);
    FILE *const file = n > 0 && n < (int)sizeof path ? fopen(part, "w") : NULL;
    if (file != NULL) {
        const bool is_written =
            json_dumpf(object, file, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) == 0 &&
            fputc('\n', file) != EOF && fflush(file) == 0 && fsync(fileno(file)) == 0;
        if (fclose(file) == 0 && is_written && rename(part, path) == 0) {
            return CLAST_OK;
        }
    }
    (void)remove(part);
    return cli_fail(CLAST_E_DISK, "cannot write %s", path);
}

void cli_json_number(json_t *object, const char *key, double value)
{
    (void)json_object_set_new(object, key, isfinite(value) ? json_real(value) : json_null());
}

void cli_json_count(json_t *object, const char *key, int64_t value)
{
    (void)json_object_set_new(object, key, json_integer((json_int_t)value));
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
