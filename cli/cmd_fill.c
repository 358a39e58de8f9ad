// clast fill: spheres inside a surface.
#include "command.h"
#include "idle.h"
#include "json.h"
#include "mesh_words.h"

#include <clast/fill.h>
#include <clast/mesh_repair.h>
#include <clast/shape.h>
#include <clast/table.h>

#include <stdio.h>
#include <string.h>

static const char *const end_names[] = {"count", "quality", "min_radius", "coverage"};
static const char *const end_words[] = {"as many as asked for", "every bound asked for is met",
                                        "no sphere of the least radius fits any more",
                                        "no sphere would add volume"};

/// File name without folder and extension.
static void stem(const char *path, char *name, size_t size)
{
    const char *slash = strrchr(path, '/');
    (void)snprintf(name, size, "%s", slash != NULL ? slash + 1 : path);
    char *dot = strrchr(name, '.');
    if (dot != NULL && dot != name) {
        *dot = '\0';
    }
}

static json_t *report_json(const char *file, const char *name, const clast_mesh_check_result *found,
                           const char *unit, const clast_fill_report *r)
{
    json_t *o = json_object();
    cli_json_text(o, "file", file);
    cli_json_text(o, "name", name);
    cli_json_text(o, "unit", unit[0] != '\0' ? unit : "model");
    cli_json_count(o, "n_sphere", r->n_sphere);
    cli_json_count(o, "n_placed", r->n_placed);
    cli_json_text(o, "end", end_names[r->end]);
    cli_json_count(o, "n_open_edge", found->n_open_edge);
    cli_json_number(o, "open_share", r->open_share);
    cli_json_count(o, "n_intersection", found->n_intersection);
    cli_json_bool(o, "intersection_complete", found->intersection_complete);
    cli_json_count(o, "n_doubled", found->n_doubled);
    cli_json_count(o, "n_repeated", found->n_repeated);
    cli_json_number(o, "solid_volume", r->solid_volume);
    cli_json_number(o, "sphere_volume", r->sphere_volume);
    cli_json_number(o, "filled_fraction", r->filled_fraction);
    cli_json_number(o, "outside_fraction", r->outside_fraction);
    cli_json_number(o, "volume_error", r->volume_error);
    cli_json_number(o, "centroid_error", r->centroid_error);
    cli_json_number(o, "inertia_error", r->inertia_error);
    cli_json_number(o, "max_protrusion", r->max_protrusion);
    cli_json_count(o, "n_protruding", r->n_protruding);
    cli_json_number(o, "max_overlap", r->max_overlap);
    cli_json_number(o, "deviation_mean", r->deviation_mean);
    cli_json_number(o, "deviation_max", r->deviation_max);
    cli_json_number(o, "radius_min", r->radius_min);
    cli_json_number(o, "radius_median", r->radius_median);
    cli_json_number(o, "radius_max", r->radius_max);
    cli_json_number(o, "bound", r->bound);
    cli_json_count(o, "n_tested", r->n_tested);
    cli_json_number(o, "wall_s", r->wall_s);
    return o;
}

static void print_words(const char *file, const char *unit, const clast_fill_report *r)
{
    char words[32];
    cli_mesh_unit(unit, words);
    (void)printf("%s: %d sphere%s", cli_name(file), r->n_sphere, cli_plural(r->n_sphere));
    if (r->n_placed > r->n_sphere) {
        (void)printf(" (the outer ones of %d)", r->n_placed);
    }
    (void)printf(", %s; %s\n", end_words[r->end], words);
    (void)printf("  filled           %.6g of the volume %.8g\n", r->filled_fraction,
                 r->solid_volume);
    if (r->outside_fraction > 0.0) {
        (void)printf("  outside          %.3g of the volume, beside the solid: where spheres poke "
                     "out\n",
                     r->outside_fraction);
    }
    (void)printf("  volume error     %.4g\n", r->volume_error);
    (void)printf("  centroid error   %.4g of the equal-volume diameter\n", r->centroid_error);
    (void)printf("  inertia error    %.4g at equal mass\n", r->inertia_error);
    (void)printf("  protrusion       %.3g of the radius at most, %d sphere%s out\n",
                 r->max_protrusion, r->n_protruding, r->n_protruding == 1 ? " pokes" : "s poke");
    (void)printf("  overlap          %.3g of the smaller radius at most\n", r->max_overlap);
    (void)printf("  surface          %.4g from the spheres on average, %.4g at most\n",
                 r->deviation_mean, r->deviation_max);
    (void)printf("  radius           %.5g .. %.5g .. %.5g (least, median, greatest)\n",
                 r->radius_min, r->radius_median, r->radius_max);
    if (r->bound > 0.0) {
        (void)printf("  next radius      %.5g at most\n", r->bound);
    }
    (void)printf("  time             %.3f s, %lld points examined\n", r->wall_s,
                 (long long)r->n_tested);
}

static clast_status save(const cli_common *common, const clast_fill_config *config,
                         const char *name, const char *unit, const clast_mesh *mesh,
                         const clast_spheres *spheres)
{
    clast_table history = {0};
    clast_status status = CLAST_OK;
    if (common->output != NULL) {
        CLI_TRY(clast_spheres_write(spheres, common->output, name, unit));
    }
    if (config->history[0] != '\0') {
        CLI_TRY(clast_fill_history(mesh, spheres, &history));
        CLI_TRY(clast_table_write_csv(&history, config->history));
    }
done:
    clast_table_free(&history);
    return status;
}

static clast_status show(const cli_common *common, const char *name, const char *unit,
                         const clast_mesh_check_result *found, const clast_fill_report *report)
{
    const char *file = common->argument[0];
    cli_note_doubles(common, found, ", so shares of it come out low");
    if (report->open_share > 1e-6 && !common->quiet) {
        (void)fprintf(stderr,
                      "clast fill: note: %s has %d open edges; their holes were capped, which "
                      "leaves %.2g of the volume uncertain\n",
                      file, found->n_open_edge, report->open_share);
    }
    if (common->json) {
        return cli_print_json(report_json(file, name, found, unit, report));
    }
    print_words(file, unit, report);
    return CLAST_OK;
}

static clast_status run(const cli_common *common, void *context)
{
    const clast_fill_config *config = context;
    clast_idle rules[CLAST_N_IDLE];
    CLI_GUARD(cli_idle_check(clast_fill_fields, config, clast_fill_idle(config, rules)));
    CLI_GUARD(cli_check_writable(config->history));
    const clast_monitor monitor = cli_monitor(common);
    clast_mesh mesh = {0};
    clast_spheres spheres = {0};
    clast_fill_report report;
    clast_mesh_check_result found = {0};
    clast_mesh_read_report read = {0};
    char name[256];
    stem(common->argument[0], name, sizeof name);
    if (config->name[0] != '\0') {
        (void)snprintf(name, sizeof name, "%s", config->name);
    }
    clast_status status = CLAST_OK;
    CLI_TRY(cli_mesh_welded(common, &mesh, &read));
    status = clast_fill(&mesh, config, &monitor, &spheres, &report);
    CLI_TRY(
        cli_mesh_refused(common->argument[0], &mesh, "cap its holes with --allow-open", status));
    CLI_TRY(save(common, config, name, read.unit, &mesh, &spheres));
    CLI_TRY(clast_mesh_check(&mesh, &found));
    CLI_TRY(show(common, name, read.unit, &found, &report));
done:
    clast_mesh_check_free(&found);
    clast_spheres_free(&spheres);
    clast_mesh_free(&mesh);
    return status;
}

const cli_command cli_fill = {
    .name = "fill",
    .arguments = "FILE",
    .summary = "fill a surface with spheres",
    .example = {"clast fill data/scarlet/stl/ellipse.stl --spheres 20 -o spheres.csv",
                "clast fill data/scarlet/stl/ellipse.stl --overlap --spheres 20 -o clump.csv",
                "clast fill scan.stl --volume-error 0.05 -o spheres.csv"},
    .details =
        "Reads STL, OBJ, PLY or OFF and works in its unit. -o FILE.csv (x,y,z,radius; x_mm.. of a "
        "surface in mm) or\nFILE.h5 saves the spheres; a state file keeps several sets by name.\n"
        "Strategies: largest places the largest sphere that fits, again and again, inside the "
        "surface to\nrounding; random takes the best of random points; published is SCARLET-1.0's "
        "method, which knows\nthe mesh's vertices only. --overlap makes a clump of overlapping "
        "spheres that cover most volume.\nExit code 5 when a bound asked for cannot be met.",
    .fields = clast_fill_fields,
    .config_size = sizeof(clast_fill_config),
    .n_min = 1,
    .n_max = 1,
    .run = run,
};
