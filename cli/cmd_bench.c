// clast bench: what this machine gives.
#include "command.h"
#include "json.h"
#include "scene.h"

#include <clast/machine.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

typedef struct {
    char *data;
    int32_t repeats;
    bool list;
} config;

static const char usual_data[] = "data/scarlet";

static const clast_field fields[] = {
    {"data", .offset = offsetof(config, data), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "folder of SCARLET-1.0's shapes and sizes (stl/, *.csv)", usual_data},
    {"repeats", .offset = offsetof(config, repeats), CLAST_FIELD_I32, 3, 1, 1000, "-",
     "times each scene runs; the least time counts", NULL},
    {"list", .offset = offsetof(config, list), CLAST_FIELD_BOOL, 0, 0, 0, "-",
     "name the scenes and run none", NULL},
    {0},
};

#define SCENE(name, run, unit, reference, reference_is, is_slow, summary)                          \
    clast_status cli_scene_##run(cli_lap *b);
#include "scenes.def"
#undef SCENE

static const cli_scene scenes[] = {
#define SCENE(name, run, unit, reference, reference_is, is_slow, summary)                          \
    {name, unit, reference, reference_is, is_slow, summary, cli_scene_##run},
#include "scenes.def"
#undef SCENE
};
enum { N_SCENE = sizeof scenes / sizeof *scenes };

bool cli_lap_again(cli_lap *b)
{
    return b->left-- > 0;
}

void cli_lap_start(cli_lap *b)
{
    b->wall0 = cli_clock();
    b->cpu0 = cli_clock_cpu();
}

void cli_lap_stop(cli_lap *b)
{
    b->wall = fmin(b->wall, cli_clock() - b->wall0);
    b->cpu = fmin(b->cpu, cli_clock_cpu() - b->cpu0);
}

static const cli_scene *find(const char *name)
{
    for (int32_t i = 0; i < N_SCENE; ++i) {
        if (strcmp(scenes[i].name, name) == 0) {
            return &scenes[i];
        }
    }
    return NULL;
}

static bool is_rate(const cli_scene *scene)
{
    const size_t n = strlen(scene->unit);
    return n > 2 && strcmp(scene->unit + n - 2, "/s") == 0;
}

/// Most memory that the process has held so far [bytes].
static double peak_memory(void)
{
#ifdef __EMSCRIPTEN__ // whose getrusage makes its numbers up; its memory never shrinks
    return 65536.0 * (double)__builtin_wasm_memory_size(0);
#else
    struct rusage usage;
    (void)getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * (double)usage.ru_maxrss;
#endif
}

static double ratio_of(const cli_scene *scene, const cli_lap *b)
{
    return is_rate(scene) ? b->value / b->reference : b->reference / b->value;
}

static void add_json(json_t *list, const cli_scene *scene, const cli_lap *b)
{
    json_t *o = json_object();
    cli_json_text(o, "name", scene->name);
    cli_json_number(o, "value", b->value);
    cli_json_text(o, "unit", scene->unit);
    cli_json_number(o, "reference", b->reference);
    cli_json_text(o, "reference_is", scene->reference_is);
    cli_json_number(o, "ratio", ratio_of(scene, b));
    cli_json_count(o, "threads", clast_parallel_threads());
    cli_json_number(o, "cpu_s", b->cpu);
    cli_json_number(o, "peak_memory", peak_memory());
    (void)json_array_append_new(list, o);
}

static bool lacks_data(const config *c, clast_status status)
{
    return clast_status_exit_code(status) == 3 && !cli_is_folder(c->data);
}

static clast_status run_scene(const config *c, const cli_scene *scene, bool json, json_t *list)
{
    cli_lap b = {.data = c->data,
                 .repeats = c->repeats,
                 .left = c->repeats,
                 .wall = HUGE_VAL,
                 .cpu = HUGE_VAL,
                 .reference = scene->reference};
    const clast_status status = scene->run(&b);
    if (status != CLAST_OK) {
        return cli_fail(status, "scene %s: %s%s", scene->name, clast_error_detail(),
                        lacks_data(c, status) ? "; --data names SCARLET-1.0's folder" : "");
    }
    if (json) {
        add_json(list, scene, &b);
    } else {
        (void)printf("%-15s %10.4g %-12s %10.4g %8.3g %8.3g %8.0f  %s\n", scene->name, b.value,
                     scene->unit, b.reference, ratio_of(scene, &b), b.cpu, 1e-6 * peak_memory(),
                     scene->reference_is);
        (void)fflush(stdout);
    }
    return CLAST_OK;
}

static clast_status list_json(void)
{
    json_t *list = json_array();
    json_t *out = json_object();
    for (int32_t i = 0; i < N_SCENE; ++i) {
        json_t *o = json_object();
        cli_json_text(o, "name", scenes[i].name);
        cli_json_text(o, "unit", scenes[i].unit);
        cli_json_text(o, "summary", scenes[i].summary);
        cli_json_bool(o, "when_named", scenes[i].is_slow);
        (void)json_array_append_new(list, o);
    }
    (void)json_object_set_new(out, "scenes", list);
    return cli_print_json(out);
}

static clast_status print_list(void)
{
    for (int32_t i = 0; i < N_SCENE; ++i) {
        (void)printf("%-15s %-12s %s%s\n", scenes[i].name, scenes[i].unit, scenes[i].summary,
                     scenes[i].is_slow ? " (only when named)" : "");
    }
    return CLAST_OK;
}

/// All that take seconds. Without SCARLET-1.0's files, as beside an installed clast, those that
/// need none.
static clast_status run_quick(const cli_common *common, const config *c, json_t *list)
{
    const bool is_usual = strcmp(c->data, usual_data) == 0;
    int32_t n_absent = 0;
    for (int32_t i = 0; i < N_SCENE; ++i) {
        const clast_status status =
            scenes[i].is_slow ? CLAST_OK : run_scene(c, &scenes[i], common->json, list);
        const bool is_absent = is_usual && lacks_data(c, status);
        CLI_GUARD(is_absent ? CLAST_OK : status);
        n_absent += is_absent;
    }
    if (n_absent > 0 && !common->quiet) {
        (void)fprintf(stderr,
                      "clast bench: note: %d scenes left out: %s is not here; --data names the "
                      "folder of SCARLET-1.0's shapes and sizes\n",
                      n_absent, cli_name(c->data));
    }
    return CLAST_OK;
}

static clast_status run_named(const cli_common *common, const config *c, json_t *list)
{
    for (int32_t i = 0; i < common->n_argument; ++i) {
        CLI_GUARD(run_scene(c, find(common->argument[i]), common->json, list));
    }
    return CLAST_OK;
}

static clast_status run(const cli_common *common, void *context)
{
    const config *c = context;
    json_t *list = json_array();
    json_t *out = json_object();
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < common->n_argument; ++i) {
        CLI_CHECK(find(common->argument[i]) != NULL, CLAST_E_USAGE,
                  "no scene is called %s; see clast bench --list", common->argument[i]);
    }
    if (c->list) {
        status = common->json ? list_json() : print_list();
        goto done;
    }
    if (!common->json) {
        (void)printf("%-15s %10s %-12s %10s %8s %8s %8s  reference is\n", "scene", "value", "unit",
                     "reference", "ratio", "cpu s", "peak MB");
    }
    status = common->n_argument > 0 ? run_named(common, c, list) : run_quick(common, c, list);
    if (common->json && (status == CLAST_OK || json_array_size(list) > 0)) { // none is lost
        (void)json_object_set(out, "scenes", list);
        const clast_status printed = cli_print_json(json_incref(out));
        status = status != CLAST_OK ? status : printed;
    }
    if (!common->json && status == CLAST_OK) {
        (void)printf(
            "%d threads; value: wall time, or CPU time where --list says so, least of %d; "
            "ratio above 1: better than the\nreference; peak MB: most memory held so far\n",
            clast_parallel_threads(), c->repeats);
    }
done:
    json_decref(list);
    json_decref(out);
    return status;
}

const cli_command cli_bench = {
    .name = "bench",
    .arguments = "[SCENE...]",
    .summary = "what this machine gives, beside published figures and limits",
    .example = {"clast bench --list", "clast bench P1 --repeats 1", "clast bench --json"},
    .details =
        "Runs the named scenes, or all that take seconds, and prints the time (or rate) of each "
        "beside a\nreference: the published figure, the limit that was set, or a plain twin "
        "measured in the same run.\nAggregates and fillings need SCARLET-1.0's files, which come "
        "with clast's source: run in its folder\nor name the place with --data; without them the "
        "other scenes run.",
    .fields = fields,
    .config_size = sizeof(config),
    .n_min = 0,
    .n_max = 100,
    .writes_no_file = true,
    .run = run,
};
