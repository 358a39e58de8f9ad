// YAML configuration files: one mapping of keys to scalars or lists, typed by the field table.
#include <clast/field.h>

#include "base/alloc.h"
#include "base/field.h"
#include "base/file.h"
#include <string.h>
#include <yaml.h>

enum { CONFIG_LIMIT = 16 << 20 };

typedef struct {
    const char *path;
    const clast_field *fields;
    void *config;
    bool is_si;   ///< bare numbers are SI; else lengths and angles need a unit
    bool is_part; ///< keys that the table does not have are passed over
    bool *seen;   ///< [number of fields]
} reader;

static clast_status fail_at(const reader *r, const yaml_node_t *node, const char *what,
                            const char *detail)
{
    return clx_fail(CLAST_E_CONFIG, "%s:%zu:%zu: %s%s", r->path, node->start_mark.line + 1,
                    node->start_mark.column + 1, what, detail);
}

static clast_status set_scalar(const reader *r, const clast_field *f, const yaml_node_t *value,
                               bool append)
{
    if (value->type != YAML_SCALAR_NODE) {
        return fail_at(r, value, f->name, ": expected a plain value");
    }
    const char *text = (const char *)value->data.scalar.value;
    if (strlen(text) != value->data.scalar.length) { // "4mm\0x" would be read as 4mm
        return fail_at(r, value, f->name, ": a NUL (\\0) ends no value; leave it out");
    }
    const clast_status status = r->is_si ? clast_field_set_si(f, r->config, text, append)
                                         : clast_field_set(f, r->config, text, append);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s:%zu", r->path, value->start_mark.line + 1);
    }
    return status;
}

static clast_status set_sequence(const reader *r, yaml_document_t *document, const clast_field *f,
                                 const yaml_node_t *value)
{
    if (f->type != CLAST_FIELD_TEXT_LIST && f->type != CLAST_FIELD_F64_LIST) {
        return fail_at(r, value, f->name, " takes one value, not a list");
    }
    clast_field_clear(f, r->config);
    clast_status status = CLAST_OK;
    for (yaml_node_item_t *item = value->data.sequence.items.start;
         item < value->data.sequence.items.top && status == CLAST_OK; ++item) {
        status = set_scalar(r, f, yaml_document_get_node(document, *item), true);
    }
    return status;
}

static clast_status set_key(const reader *r, yaml_document_t *document, const yaml_node_t *key,
                            const yaml_node_t *value)
{
    const char *name = (const char *)key->data.scalar.value;
    if (key->type != YAML_SCALAR_NODE || strlen(name) != key->data.scalar.length) { // a NUL in it
        return fail_at(r, key, "a key must be a plain word", "");
    }
    const clast_field *f = clast_fields_find(r->fields, name);
    if (f == NULL && r->is_part) {
        return CLAST_OK;
    }
    if (f == NULL) {
        const char *near = clast_fields_nearest(r->fields, name);
        return clx_fail(CLAST_E_CONFIG, "%s:%zu: unknown key '%s'%s%s%s", r->path,
                        key->start_mark.line + 1, name, near != NULL ? "; did you mean '" : "",
                        near != NULL ? near : "", near != NULL ? "'?" : "");
    }
    if (r->seen[f - r->fields]) {
        return fail_at(r, key, f->name, " is given twice");
    }
    r->seen[f - r->fields] = true;
    return value->type == YAML_SEQUENCE_NODE ? set_sequence(r, document, f, value)
                                             : set_scalar(r, f, value, false);
}

static clast_status read_document(const reader *r, yaml_document_t *document)
{
    const yaml_node_t *root = yaml_document_get_root_node(document);
    if (root == NULL) { // a file that was never written is no wish for the defaults
        return clx_fail(CLAST_E_CONFIG, "%s: empty; expected lines of the form 'key: value'",
                        r->path);
    }
    if (root->type != YAML_MAPPING_NODE) {
        return fail_at(r, root, "expected lines of the form 'key: value'", "");
    }
    clast_status status = CLAST_OK;
    for (yaml_node_pair_t *pair = root->data.mapping.pairs.start;
         pair < root->data.mapping.pairs.top && status == CLAST_OK; ++pair) {
        status = set_key(r, document, yaml_document_get_node(document, pair->key),
                         yaml_document_get_node(document, pair->value));
    }
    return status;
}

/// The next document of the input; after the last one, one without a root.
static clast_status load(yaml_parser_t *parser, const reader *r, yaml_document_t *document)
{
    return yaml_parser_load(parser, document) == 1
               ? CLAST_OK
               : clx_fail(CLAST_E_CONFIG, "%s:%zu: %s", r->path, parser->problem_mark.line + 1,
                          parser->problem != NULL ? parser->problem : "not YAML");
}

/// Refuses what follows the first document: it would not be read. An empty one (a lone ---) may.
static clast_status check_last(yaml_parser_t *parser, const reader *r)
{
    clast_status status = CLAST_OK;
    bool is_last = false;
    while (!is_last && status == CLAST_OK) {
        yaml_document_t document;
        CLX_TRY(load(parser, r, &document));
        const yaml_node_t *root = yaml_document_get_root_node(&document);
        is_last = root == NULL;
        if (!is_last && (root->type != YAML_SCALAR_NODE || root->data.scalar.length > 0)) {
            status = fail_at(r, root, "a second document; a file is one configuration", "");
        }
        yaml_document_delete(&document);
    }
done:
    return status;
}

/// Reads the document that the parser's input holds.
static clast_status read_input(yaml_parser_t *parser, reader *r)
{
    clast_status status = CLAST_OK;
    yaml_document_t document;
    bool has_document = false;
    int64_t n = 0;
    while (r->fields[n].name != NULL) {
        ++n;
    }
    CLX_TRY(clx_alloc(&r->seen, n, sizeof *r->seen));
    CLX_TRY(load(parser, r, &document));
    has_document = true;
    CLX_TRY(read_document(r, &document));
    CLX_TRY(check_last(parser, r));
done:
    if (has_document) {
        yaml_document_delete(&document);
    }
    clx_free(r->seen);
    return status;
}

/// Refuses what is nested deeper than any configuration, before libyaml builds it: its time grows
/// with the square of the depth (100,000 brackets: 42 s). What is no YAML is left to read_input.
static clast_status check_depth(const char *path, const char *text, size_t n)
{
    enum { DEEPEST = 8 };
    clast_status status = CLAST_OK;
    yaml_parser_t parser;
    yaml_event_t event;
    int depth = 0;
    bool is_done = false;
    CLX_CHECK(yaml_parser_initialize(&parser) == 1, CLAST_E_MEMORY, "no memory to read %s", path);
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, n);
    while (!is_done && depth <= DEEPEST && yaml_parser_parse(&parser, &event) == 1) {
        const yaml_event_type_t type = event.type;
        depth += type == YAML_SEQUENCE_START_EVENT || type == YAML_MAPPING_START_EVENT;
        depth -= type == YAML_SEQUENCE_END_EVENT || type == YAML_MAPPING_END_EVENT;
        is_done = type == YAML_STREAM_END_EVENT;
        if (depth > DEEPEST) {
            status =
                clx_fail(CLAST_E_CONFIG,
                         "%s:%zu:%zu: nested more than %d deep; a configuration is lines of "
                         "'key: value' or 'key: [value, value]'",
                         path, event.start_mark.line + 1, event.start_mark.column + 1, DEEPEST);
        }
        yaml_event_delete(&event);
    }
    yaml_parser_delete(&parser);
done:
    return status;
}

static clast_status parse(const char *name, const char *text, size_t n, reader *r)
{
    clast_status status = CLAST_OK;
    yaml_parser_t parser;
    bool has_parser = false;
    r->path = name;
    CLX_TRY(check_depth(name, text, n));
    CLX_CHECK(yaml_parser_initialize(&parser) == 1, CLAST_E_MEMORY, "no memory to read %s", name);
    has_parser = true;
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, n);
    CLX_TRY(read_input(&parser, r));
done:
    if (has_parser) {
        yaml_parser_delete(&parser);
    }
    return status;
}

static clast_status read_file(const char *path, reader r)
{
    clast_status status = CLAST_OK;
    char *text = NULL;
    int64_t n = 0;
    CLX_TRY(clx_file_read_all(path, CONFIG_LIMIT, &text, &n));
    CLX_TRY(parse(path, text, (size_t)n, &r));
done:
    clx_free(text);
    return status;
}

clast_status clast_fields_read(const char *path, const clast_field *fields, void *config)
{
    CLX_ARGUMENTS(path, fields, config);
    return read_file(path, (reader){.fields = fields, .config = config});
}

clast_status clx_fields_read_part(const char *path, const clast_field *fields, void *config)
{
    return read_file(path, (reader){.is_part = true, .fields = fields, .config = config});
}

clast_status clast_fields_parse(const char *name, const char *text, const clast_field *fields,
                                void *config)
{
    CLX_ARGUMENTS(name, text, fields, config);
    return parse(name, text, strlen(text),
                 &(reader){.is_si = true, .fields = fields, .config = config});
}
