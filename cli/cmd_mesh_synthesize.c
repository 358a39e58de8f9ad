// clast mesh synthesize: grains of a wanted form, size and roughness that nobody scanned.
#include "command.h"
#include "configs.h"
#include "idle.h"
#include "json.h"
#include "mesh_words.h"
#include "results.h"

#include <clast/form.h>
#include <clast/harmonics.h>
#include <clast/mesh.h>
#include <clast/table.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    clast_synthesize_config synthesize; // first: the two tables share offsets
    int32_t count;
    bool force;
    char *size; ///< as typed: the unit says how to read it
    char *unit;
} synthesize_config;

enum { MAX_FIELD = 32, COUNT_MAX = 1000000 };

/// The library's fields and the command's own, in one table.
static clast_field fields[MAX_FIELD];

#define OWN(name) #name, .offset = offsetof(synthesize_config, name)
static const clast_field own[] = {{OWN(count), CLAST_FIELD_I32, 1, 1, COUNT_MAX, "-",
                                   "grains; more than one go into the folder -o, with grains.csv",
                                   NULL, .group = "number", .common = true},
                                  CLI_FORCE(synthesize_config),
                                  {0}};

/// In the place of the library's number.
static const clast_field sizes[] = {
    {OWN(size), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "sieve size D = sqrt((S^2+I^2)/2), in --unit, or with its own where that is given", "1",
     .common = true, .group = "size"},
    {OWN(unit), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "of lengths (mm, um, ..), which PLY, OBJ and OFF hand on; none: model units", "",
     .common = true},
    {0}};
#undef OWN

__attribute__((constructor)) static void join_fields(void)
{
    cli_joined joined = {fields, MAX_FIELD, 0};
    cli_joined_append_all(&joined, own, 0);
    for (const clast_field *f = clast_synthesize_fields; f->name != NULL; ++f) {
        if (strcmp(f->name, "size") == 0) {
            cli_joined_append_all(&joined, sizes, 0);
        } else {
            cli_joined_append(&joined, *f, 0);
        }
    }
}

enum { VOLUME = 5, N_COLUMN = 7 };

static double value_at(const clast_synthesize_report *r, int column)
{
    const double value[N_COLUMN] = {r->flatness,          r->elongation, r->amplitude,
                                    r->normal_roundness,  r->angularity, r->volume,
                                    (double)r->n_triangle};
    return value[column];
}

static clast_status begin_table(int32_t n, clast_table *table)
{
    static const char *const name[N_COLUMN] = {"flatness",         "elongation", "amplitude",
                                               "normal_roundness", "angularity", "volume",
                                               "n_triangle"};
    CLI_GUARD(clast_table_init(table, "grains", n));
    CLI_GUARD(clast_table_add_text(table, "file"));
    for (int k = 0; k < N_COLUMN; ++k) {
        CLI_GUARD(clast_table_add_number(table, name[k], "-", NULL));
    }
    return CLAST_OK;
}

static clast_status save_row(clast_table *table, int32_t i, const char *file,
                             const clast_synthesize_report *r)
{
    for (int k = 0; k < N_COLUMN; ++k) {
        table->column[k + 1].number[i] = value_at(r, k);
    }
    return clast_table_set_text(table, 0, i, file);
}

/// Makes grain i and writes it, into the folder where there is one; the file's name into the table.
static clast_status make_one(const cli_common *common, const synthesize_config *c,
                             const clast_run_folder *folder, int32_t i, clast_table *table)
{
    clast_mesh mesh = {0};
    clast_synthesize_report report;
    char file[64];
    char path[CLAST_RUN_PATH];
    const clast_mesh_write_options options = {.unit = c->unit[0] != '\0' ? c->unit : NULL};
    (void)snprintf(file, sizeof file, "grain%0*d.ply", c->count > 10000 ? 6 : 4, i);
    clast_status status = CLAST_OK;
    CLI_TRY(clast_synthesize_grain(&c->synthesize, (uint64_t)i, &mesh, &report));
    if (folder != NULL) {
        CLI_TRY(clast_run_folder_file(folder, file, path));
    }
    CLI_TRY(clast_mesh_write(&mesh, folder != NULL ? path : common->output, &options));
    CLI_TRY(save_row(table, i, folder != NULL ? file : common->output, &report));
done:
    clast_mesh_free(&mesh);
    return status;
}

/// Mean and (n-1) deviation of a column; deviation 0 for one grain.
static void statistics(const clast_table *table, int column, double *mean, double *deviation)
{
    const double *x = table->column[column + 1].number;
    double sum = 0.0;
    double squares = 0.0;
    for (int64_t i = 0; i < table->n_row; ++i) {
        sum += x[i];
    }
    *mean = sum / (double)table->n_row;
    for (int64_t i = 0; i < table->n_row; ++i) {
        squares += (x[i] - *mean) * (x[i] - *mean);
    }
    *deviation = table->n_row > 1 ? sqrt(squares / (double)(table->n_row - 1)) : 0.0;
}

static json_t *table_json(const cli_common *common, const char *unit, const clast_table *table)
{
    json_t *o = json_object();
    json_t *list = json_array();
    json_t *mean_set = json_object();
    json_t *deviation_set = json_object();
    for (int64_t i = 0; i < table->n_row; ++i) {
        json_t *row = json_object();
        cli_json_text(row, "file", table->column[0].text[i]);
        for (int k = 0; k < N_COLUMN; ++k) {
            cli_json_number(row, table->column[k + 1].name, table->column[k + 1].number[i]);
        }
        (void)json_array_append_new(list, row);
    }
    for (int k = 0; k < N_COLUMN; ++k) {
        double mean = 0.0;
        double deviation = 0.0;
        statistics(table, k, &mean, &deviation);
        cli_json_number(mean_set, table->column[k + 1].name, mean);
        cli_json_number(deviation_set, table->column[k + 1].name, deviation);
    }
    cli_json_text(o, "output", common->output);
    cli_json_text(o, "unit", unit[0] != '\0' ? unit : "model");
    cli_json_count(o, "n_grain", table->n_row);
    (void)json_object_set_new(o, "grains", list);
    (void)json_object_set_new(o, "mean", mean_set);
    (void)json_object_set_new(o, "deviation", deviation_set);
    return o;
}

static clast_status table_words(const cli_common *common, const char *unit,
                                const clast_table *table)
{
    char words[32];
    cli_mesh_unit(unit, words);
    (void)printf("%s: %lld grain%s; %s\n", cli_name(common->output), (long long)table->n_row,
                 table->n_row > 1 ? "s" : "", words);
    for (int k = 0; k < N_COLUMN; ++k) {
        double mean = 0.0;
        double deviation = 0.0;
        statistics(table, k, &mean, &deviation);
        const bool has_unit = k == VOLUME && unit[0] != '\0';
        (void)printf("  %-12s %.6g%s%s%s", table->column[k + 1].name, mean, has_unit ? " " : "",
                     has_unit ? unit : "", has_unit ? "^3" : "");
        if (table->n_row > 1) {
            (void)printf(", deviation %.6g", deviation);
        }
        (void)printf("\n");
    }
    return CLAST_OK;
}

/// The size in the unit of the output.
static clast_status read_size(synthesize_config *c)
{
    double metre = 1.0;
    if (c->unit[0] != '\0' && clast_unit_factor(c->unit, "m", &metre) != CLAST_OK) {
        return cli_fail(CLAST_E_CONFIG, "unit: %s", clast_error_detail());
    }
    CLI_GUARD(cli_mesh_length("size", c->size, c->unit, &c->synthesize.size));
    return c->synthesize.size > 0.0
               ? CLAST_OK
               : cli_fail(CLAST_E_CONFIG, "size: %s is no size of a grain", c->size);
}

/// A folder by the name of a surface is a mistake: --count was not meant, or the name.
static clast_status check_folder(const cli_common *common)
{
    return clast_mesh_format_of_path(common->output) == CLAST_MESH_ANY
               ? CLAST_OK
               : cli_fail(CLAST_E_USAGE,
                          "%s: of several grains each is a PLY file in a folder, which is not "
                          "named like a surface",
                          common->output);
}

/// Takes the file, or the folder of several grains.
static clast_status begin_output(const cli_common *common, synthesize_config *c,
                                 clast_run_folder **folder)
{
    if (common->output == NULL) {
        return cli_fail(CLAST_E_USAGE,
                        "-o OUT is needed: a surface file, or a folder with --count");
    }
    clast_idle rules[CLAST_N_IDLE];
    const bool is_set = c->count > 1;
    CLI_GUARD(cli_idle_check(fields, c, clast_synthesize_idle(&c->synthesize, rules)));
    CLI_GUARD(read_size(c));
    CLI_GUARD(is_set ? check_folder(common) : cli_mesh_output(common));
    return cli_results_begin(common, is_set ? common->output : NULL, &c->force, folder);
}

/// All grains of the table, one after the other.
static clast_status make_all(const cli_common *common, const synthesize_config *c,
                             const clast_run_folder *folder, clast_table *table)
{
    const clast_monitor monitor = cli_monitor(common);
    for (int32_t i = 0; i < c->count; ++i) {
        CLI_GUARD(make_one(common, c, folder, i, table));
        if (monitor.stop != NULL && monitor.stop(monitor.context)) {
            return cli_fail(CLAST_E_STOPPED, "stopped after %d of %d grains", i + 1, c->count);
        }
    }
    return CLAST_OK;
}

/// Table and summary of the folder.
static clast_status describe(const cli_common *common, const char *unit,
                             const clast_run_folder *folder, const clast_table *table)
{
    clast_status status = CLAST_OK;
    char path[CLAST_RUN_PATH];
    json_t *summary = table_json(common, unit, table);
    CLI_TRY(clast_run_folder_file(folder, "grains.csv", path));
    CLI_TRY(clast_table_write_csv(table, path));
    (void)json_object_del(summary, "output");
    (void)json_object_del(summary, "grains"); // grains.csv
    CLI_TRY(cli_results_summary(folder, summary));
done:
    json_decref(summary);
    return status;
}

static clast_status make_grains(const cli_common *common, const synthesize_config *config,
                                clast_run_folder *folder, clast_table *table)
{
    CLI_GUARD(cli_results_open(folder, fields, config, &config->synthesize.seed,
                               &(cli_input){NULL, NULL}));
    CLI_GUARD(begin_table(config->count, table));
    CLI_GUARD(make_all(common, config, folder, table));
    return folder != NULL ? describe(common, config->unit, folder, table) : CLAST_OK;
}

static clast_status run(const cli_common *common, void *config_bytes)
{
    synthesize_config *config = config_bytes;
    clast_run_folder *folder = NULL;
    clast_table table = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(begin_output(common, config, &folder));
    CLI_TRY(clast_run_folder_end(folder, make_grains(common, config, folder, &table)));
    if (table.column != NULL) {
        CLI_TRY(common->json ? cli_print_json(table_json(common, config->unit, &table))
                             : table_words(common, config->unit, &table));
    }
done:
    clast_run_folder_destroy(folder);
    clast_table_free(&table);
    return status;
}

const cli_command cli_mesh_synthesize = {
    .name = "mesh synthesize",
    .arguments = "-o OUT",
    .summary = "grains of a wanted form, size and roughness that nobody scanned",
    .example = {"clast mesh synthesize --flatness 0.5 --elongation 0.8 -o grain.stl",
                "clast mesh synthesize --count 3 --flatness-deviation 0.1 -o grains/",
                "clast mesh synthesize --measure normal_roundness --rough 0.8 -o round.ply"},
    .details =
        "Convex hulls of random bodies (spherical harmonics with a power-law spectrum) of at most "
        "--faces\ntriangles, stretched so that flatness, elongation and sieve size of the "
        "mass-equivalent ellipsoid are met\nexactly. --measure normal_roundness or angularity "
        "searches "
        "the "
        "amplitude until the finished grain measures\n--rough within --tolerance (definitions as "
        "in "
        "clast shape; exit code 5 with the attainable range when\nit cannot be met). Grain i "
        "depends "
        "on the seed and i alone. The folder of several has manifest.json and summary.json, too. "
        "Each grain tried in the search is a whole one: 1000 faces take 0.2 s, 10000 7 s, 100000 "
        "minutes.\n"
        "docs/theory/synthetic.md.",
    .fields = fields,
    .config_size = sizeof(synthesize_config),
    .n_min = 0,
    .n_max = 0,
    .needs_file = true,
    .writes_either = true,
    .run = run,
};
