// manifest.json as tables: what ran, on what, where, when.
#include "report/provenance.h"

#include "base/file.h"
#include "report/page.h"
#include "report/quantity.h"
#include "report/run.h"
#include <clast/agglomerate.h>
#include <clast/aggregate_run.h>
#include <clast/decompose.h>
#include <clast/evolve.h>
#include <clast/pack.h>
#include <clast/porosity_model.h>
#include <stdlib.h>
#include <string.h>

/// Any value as text: strings plain, lists with commas, the rest as JSON.
static void write_plain(clx_file *file, const json_t *value)
{
    if (json_is_string(value)) {
        clx_page_text(file, json_string_value(value));
    } else if (json_is_array(value)) {
        for (size_t i = 0; i < json_array_size(value); ++i) {
            (void)clx_file_print(file, "%s", i > 0 ? ", " : "");
            write_plain(file, json_array_get(value, i));
        }
    } else if (json_is_real(value)) {
        (void)clx_file_print(file, "%.9g", json_real_value(value));
    } else {
        char *text = json_dumps(value, JSON_ENCODE_ANY | JSON_REAL_PRECISION(6));
        clx_page_text(file, text != NULL ? text : "");
        free(text); // Jansson's, not ours
    }
}

static void write_command_line(clx_file *file, const json_t *words)
{
    (void)clx_file_print(file, "<code>");
    for (size_t i = 0; i < json_array_size(words); ++i) {
        const char *word = json_string_value(json_array_get(words, i));
        const bool is_plain =
            word != NULL && word[0] != '\0' && strpbrk(word, " \t\n'\"\\$*?;&|<>()") == NULL;
        (void)clx_file_print(file, "%s%s", i > 0 ? " " : "", is_plain ? "" : "&#39;");
        clx_page_text(file, word != NULL ? word : "");
        (void)clx_file_print(file, "%s", is_plain ? "" : "&#39;");
    }
    (void)clx_file_print(file, "</code>");
}

static void write_host(clx_file *file, const json_t *host)
{
    const char *key = NULL;
    json_t *value = NULL;
    bool is_first = true;
    json_object_foreach((json_t *)host, key, value)
    {
        (void)clx_file_print(file, "%s", is_first ? "" : " \302\267 ");
        (void)clx_file_print(file, "%s", strcmp(key, "compiler") == 0 ? "compiler " : "");
        write_plain(file, value);
        (void)clx_file_print(file, "%s", strcmp(key, "cores") == 0 ? " cores" : "");
        is_first = false;
    }
}

static void write_facts(clx_file *file, const json_t *manifest)
{
    const char *key = NULL;
    json_t *value = NULL;
    (void)clx_file_print(
        file, "<div class=\"card wide\"><h4>Provenance</h4><table class=\"pairs narrow\">\n");
    json_object_foreach((json_t *)manifest, key, value)
    {
        if (strcmp(key, "config") == 0 || strcmp(key, "inputs") == 0 ||
            strcmp(key, "format") == 0 || (json_is_array(value) && json_array_size(value) == 0)) {
            continue;
        }
        (void)clx_file_print(file, "<tr><th>");
        clx_quantity_write_label(file, key, NULL);
        (void)clx_file_print(file, "</th><td>");
        if (strcmp(key, "command_line") == 0) {
            write_command_line(file, value);
        } else if (strcmp(key, "host") == 0) {
            write_host(file, value);
        } else if (strcmp(key, "peak_memory_bytes") == 0) {
            (void)clx_file_print(file, "%.1f\302\240MiB", json_number_value(value) / 1048576.0);
        } else if (json_is_real(value) && strcmp(key, "seed") != 0) {
            clx_quantity_write(file, json_number_value(value), clx_quantity_of(key, NULL).unit);
        } else {
            write_plain(file, value);
        }
        (void)clx_file_print(file, "</td></tr>\n");
    }
    (void)clx_file_print(file, "</table></div>\n");
}

static void write_inputs(clx_file *file, const json_t *inputs)
{
    (void)clx_file_print(
        file, "<div class=\"card wide\"><h4>Inputs</h4><div class=\"scroll\" tabindex=\"0\"><table "
              "class=\"inputs\">\n"
              "<tr><th>Role</th><th>File</th><th class=\"n\">Bytes</th><th>SHA-256</th></tr>\n");
    for (size_t i = 0; i < json_array_size(inputs); ++i) {
        const json_t *input = json_array_get(inputs, i);
        (void)clx_file_print(file, "<tr><td>");
        write_plain(file, json_object_get(input, "role"));
        (void)clx_file_print(file, "</td><td>");
        write_plain(file, json_object_get(input, "path"));
        (void)clx_file_print(file, "</td><td class=\"n\">");
        write_plain(file, json_object_get(input, "bytes"));
        (void)clx_file_print(file, "</td><td><code class=\"hash\">");
        write_plain(file, json_object_get(input, "sha256"));
        (void)clx_file_print(file, "</code></td></tr>\n");
    }
    (void)clx_file_print(file, "</table></div></div>\n");
}

/// The field of a configuration key of that command, for its unit and meaning, or NULL.
static const clast_field *field_of(const char *command, const char *key)
{
    static const struct {
        const char *command;
        const clast_field *fields;
    } known[] = {{"aggregate", clast_aggregate_fields},   {"pack", clast_pack_fields},
                 {"decompose", clast_decompose_fields},   {"agglomerate", clast_agglomerate_fields},
                 {"agglomerate", clast_decompose_fields}, {"fit", clast_porosity_fit_fields},
                 {"evolve", clast_evolve_fields}};
    const clast_field *field = NULL;
    for (size_t k = 0; k < sizeof known / sizeof *known && field == NULL; ++k) {
        if (command != NULL && strcmp(known[k].command, command) == 0) {
            field = clast_fields_find(known[k].fields, key);
        }
    }
    return field;
}

/// Numbers with their unit, all else as it is written in a configuration.
static void write_setting(clx_file *file, const clast_field *field, const json_t *value)
{
    const bool has_unit = field != NULL && strcmp(field->unit, "-") != 0;
    if (has_unit && json_is_number(value)) {
        clx_quantity_write(file, json_number_value(value), field->unit);
        return;
    }
    if (!has_unit || !json_is_array(value)) {
        write_plain(file, value);
        return;
    }
    for (size_t i = 0; i < json_array_size(value); ++i) {
        (void)clx_file_print(file, "%s", i > 0 ? ", " : "");
        write_setting(file, field, json_array_get(value, i));
    }
}

static void write_config(clx_file *file, const json_t *manifest, const json_t *config)
{
    const char *command = json_string_value(json_object_get(manifest, "command"));
    const char *key = NULL;
    json_t *value = NULL;
    (void)clx_file_print(
        file,
        "<details class=\"card wide\"><summary>Configuration <small>%zu keys</small></summary><div "
        "class=\"scroll\" tabindex=\"0\"><table class=\"keys\">\n"
        "<tr><th>Key</th><th>Value</th><th>Meaning</th></tr>\n",
        json_object_size(config));
    json_object_foreach((json_t *)config, key, value)
    {
        const clast_field *field = field_of(command, key);
        (void)clx_file_print(file, "<tr><td><code>");
        clx_page_text(file, key);
        (void)clx_file_print(file, "</code></td><td>");
        write_setting(file, field, value);
        (void)clx_file_print(file, "</td><td>");
        clx_page_text(file, field != NULL ? field->help : "");
        (void)clx_file_print(file, "</td></tr>\n");
    }
    (void)clx_file_print(file, "</table></div></details>\n");
}

void clx_provenance_write(clx_file *file, const clx_run *run)
{
    const json_t *manifest = run->manifest;
    const json_t *inputs = json_object_get(manifest, "inputs");
    const json_t *config = json_object_get(manifest, "config");
    if (manifest == NULL) {
        (void)clx_file_print(
            file, "<p class=\"note\">The folder has no manifest.json: origin unknown.</p>\n");
        return;
    }
    (void)clx_file_print(file, "<div class=\"cards\">\n");
    write_facts(file, manifest);
    if (json_array_size(inputs) > 0) {
        write_inputs(file, inputs);
    }
    if (json_is_object(config)) {
        write_config(file, manifest, config);
    }
    (void)clx_file_print(file, "</div>\n");
}
