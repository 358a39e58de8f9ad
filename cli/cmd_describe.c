// clast describe: the library as data, from which the bindings of other languages are made.
#include "command.h"
#include "json.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    const char *name, *doc;
    size_t size;
    int first, n;
} described_struct;

typedef struct {
    const char *name, *declaration, *doc;
    size_t offset, size;
} described_member;

typedef struct {
    const char *name, *result, *doc;
    int first, n;
} described_function;

typedef struct {
    const char *name, *declaration;
} described_argument;

typedef struct {
    const char *type, *name;
    int64_t value;
} described_value;

typedef struct {
    const char *name;
    const clast_field *fields;
} described_table;

#include "describe.inc"

#define COUNT(array) (sizeof(array) / sizeof *(array))

static json_t *structs_json(void)
{
    json_t *const all = json_array();
    for (size_t i = 0; i < COUNT(structs); ++i) {
        json_t *const one = json_object(), *const list = json_array();
        cli_json_text(one, "name", structs[i].name);
        cli_json_text(one, "doc", structs[i].doc);
        cli_json_count(one, "size", (int64_t)structs[i].size);
        for (int k = 0; k < structs[i].n; ++k) {
            const described_member *const m = &members[structs[i].first + k];
            json_t *const item = json_object();
            cli_json_text(item, "name", m->name);
            cli_json_text(item, "declaration", m->declaration);
            cli_json_text(item, "doc", m->doc);
            cli_json_count(item, "offset", (int64_t)m->offset);
            cli_json_count(item, "size", (int64_t)m->size);
            (void)json_array_append_new(list, item);
        }
        (void)json_object_set_new(one, "fields", list);
        (void)json_array_append_new(all, one);
    }
    return all;
}

static json_t *functions_json(void)
{
    json_t *const all = json_array();
    for (size_t i = 0; i < COUNT(functions); ++i) {
        json_t *const one = json_object(), *const list = json_array();
        cli_json_text(one, "name", functions[i].name);
        cli_json_text(one, "returns", functions[i].result);
        cli_json_text(one, "doc", functions[i].doc);
        for (int k = 0; k < functions[i].n; ++k) {
            json_t *const item = json_object();
            cli_json_text(item, "name", arguments[functions[i].first + k].name);
            cli_json_text(item, "declaration", arguments[functions[i].first + k].declaration);
            (void)json_array_append_new(list, item);
        }
        (void)json_object_set_new(one, "arguments", list);
        (void)json_array_append_new(all, one);
    }
    return all;
}

static json_t *values_json(void)
{
    json_t *const all = json_array();
    for (size_t i = 0; i < COUNT(values); ++i) {
        json_t *const one = json_object();
        cli_json_text(one, "enum", values[i].type);
        cli_json_text(one, "name", values[i].name);
        cli_json_count(one, "value", values[i].value);
        (void)json_array_append_new(all, one);
    }
    return all;
}

/// The default as people type it: of a choice its word.
static void default_json(json_t *one, const clast_field *f)
{
    if (f->type == CLAST_FIELD_BOOL) {
        cli_json_bool(one, "default", f->value != 0.0);
    } else if (f->type == CLAST_FIELD_CHOICE) {
        char word[64];
        const char *at = f->text;
        for (int k = 0; k < (int)f->value; ++k) {
            at += strcspn(at, "|") + 1;
        }
        (void)snprintf(word, sizeof word, "%.*s", (int)strcspn(at, "|"), at);
        cli_json_text(one, "default", word);
    } else if (f->type == CLAST_FIELD_TEXT || f->type >= CLAST_FIELD_TEXT_LIST) {
        cli_json_text(one, "default", f->text != NULL ? f->text : "");
    } else {
        cli_json_number(one, "default", f->value);
    }
}

static json_t *fields_json(const clast_field *fields)
{
    static const char *const types[] = {"number", "integer", "integer", "integer", "flag",
                                        "choice", "text",    "texts",   "numbers"};
    json_t *const list = json_array();
    for (const clast_field *f = fields; f != NULL && f->name != NULL; ++f) {
        json_t *const one = json_object();
        const bool has_range = f->type < CLAST_FIELD_BOOL || f->type == CLAST_FIELD_F64_LIST;
        cli_json_text(one, "name", f->name);
        cli_json_text(one, "type", types[f->type]);
        cli_json_count(one, "offset", (int64_t)f->offset);
        cli_json_text(one, "unit", f->unit);
        cli_json_text(one, "doc", f->help);
        default_json(one, f);
        cli_json_text(one, "choices", f->type == CLAST_FIELD_CHOICE ? f->text : NULL);
        cli_json_number(one, "low", has_range ? f->low : (double)NAN);
        cli_json_number(one, "high", has_range ? f->high : (double)NAN);
        (void)json_array_append_new(list, one);
    }
    return list;
}

static json_t *commands_json(void)
{
    json_t *const all = json_array();
    for (int32_t i = 0; cli_command_at(i) != NULL; ++i) {
        const cli_command *const command = cli_command_at(i);
        json_t *const one = json_object();
        cli_json_text(one, "name", command->name);
        cli_json_text(one, "arguments", command->arguments);
        cli_json_text(one, "doc", command->summary);
        cli_json_bool(one, "writes_folder", command->writes_folder);
        cli_json_bool(one, "writes_no_file", command->writes_no_file);
        cli_json_bool(one, "runs_in_studies", cli_runs_in_studies(command));
        (void)json_object_set_new(one, "fields", fields_json(command->fields));
        (void)json_array_append_new(all, one);
    }
    return all;
}

static clast_status run(const cli_common *common, void *unused)
{
    (void)unused;
    if (!common->json) {
        (void)printf("%zu structs, %zu functions, %zu named values, %zu tables of keys\n"
                     "clast describe --json has all of it\n",
                     COUNT(structs), COUNT(functions), COUNT(values), COUNT(tables));
        return CLAST_OK;
    }
    json_t *const all = json_object(), *const configurations = json_object();
    for (size_t i = 0; i < COUNT(tables); ++i) {
        (void)json_object_set_new(configurations, tables[i].name, fields_json(tables[i].fields));
    }
    cli_json_text(all, "version", clast_version());
    (void)json_object_set_new(all, "structs", structs_json());
    (void)json_object_set_new(all, "enums", values_json());
    (void)json_object_set_new(all, "functions", functions_json());
    (void)json_object_set_new(all, "configurations", configurations);
    (void)json_object_set_new(all, "commands", commands_json());
    return cli_print_json(all);
}

const cli_command cli_describe = {
    .name = "describe",
    .arguments = "",
    .summary = "the library as data: structs, functions, keys, units",
    .details = "Sizes and offsets are those of this build. Bindings of other languages are made "
               "from it\n(tools/make_python.py).",
    .example = {"clast describe", "clast describe --json", "clast describe --json > library.json"},
    .writes_no_file = true,
    .run = run,
};
