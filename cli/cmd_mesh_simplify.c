// clast mesh simplify and clast mesh hull: fewer triangles with the same volume, and the convex
// hull.
#include "command.h"
#include "mesh_words.h"

#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <math.h>

#include <stdio.h>

typedef struct {
    int32_t faces;
} simplify_config;

static const clast_field simplify_fields[] = {{"faces", .offset = offsetof(simplify_config, faces),
                                               CLAST_FIELD_I32, 300, 4, 2e9, "-",
                                               "number of triangles wanted", NULL},
                                              {0}};

static json_t *simplify_json(const cli_common *common, const clast_mesh_simplify_report *r,
                             const clast_mesh_check_result *found)
{
    json_t *o = json_object();
    cli_json_text(o, "file", common->argument[0]);
    cli_json_text(o, "output", common->output);
    cli_json_count(o, "n_triangle_before", r->n_triangle_before);
    cli_json_count(o, "n_triangle", r->n_triangle_after);
    cli_json_bool(o, "reached", r->reached);
    cli_json_number(o, "volume_before", r->volume_before);
    cli_json_number(o, "volume", r->volume_after);
    cli_json_number(o, "volume_change", r->volume_after / r->volume_before - 1.0);
    cli_json_number(o, "volume_drift", r->volume_drift);
    cli_json_number(o, "correction", r->correction);
    cli_json_number(o, "area_before", r->area_before);
    cli_json_number(o, "area", r->area_after);
    cli_json_number(o, "hausdorff", r->deviation.hausdorff);
    cli_json_number(o, "hausdorff_forward", r->deviation.forward);
    cli_json_number(o, "hausdorff_backward", r->deviation.backward);
    cli_json_number(o, "mean_distance", r->deviation.mean);
    cli_json_count(o, "n_sample", r->deviation.n_sample);
    cli_json_bool(o, "is_solid", clast_mesh_check_passed(found));
    cli_json_count(o, "n_intersection", found->n_intersection);
    cli_json_bool(o, "intersection_complete", found->intersection_complete);
    cli_json_count(o, "n_doubled", found->n_doubled);
    return o;
}

static void simplify_words(const cli_common *common, const clast_mesh_simplify_report *r,
                           const char *unit)
{
    char words[32];
    cli_mesh_unit(unit, words);
    (void)printf("%s: %d triangles -> %s: %d triangles; %s\n", cli_name(common->argument[0]),
                 r->n_triangle_before, cli_name(common->output), r->n_triangle_after, words);
    (void)printf("  volume %.12g -> %.12g (relative change %.2g; rounding of %.2g taken back)\n",
                 r->volume_before, r->volume_after, r->volume_after / r->volume_before - 1.0,
                 r->volume_drift);
    (void)printf("  area   %.10g -> %.10g\n", r->area_before, r->area_after);
    (void)printf("  farthest apart %.6g (there %.6g, back %.6g), mean %.3g, by %lld samples\n",
                 r->deviation.hausdorff, r->deviation.forward, r->deviation.backward,
                 r->deviation.mean, (long long)r->deviation.n_sample);
}

/// Edges collapse one by one and do not see other walls: whether the surface is still what it was.
static clast_status check_simplified(const cli_common *common, const clast_mesh *mesh,
                                     const clast_mesh *out, clast_mesh_check_result *found,
                                     bool *is_lost)
{
    clast_mesh_check_result before = {0};
    CLI_GUARD(clast_mesh_check(out, found));
    const bool passed = clast_mesh_check_passed(found);
    *is_lost = false;
    if (passed && !cli_counts_twice(found)) {
        return CLAST_OK;
    }
    CLI_GUARD(clast_mesh_check(mesh, &before));
    *is_lost = !passed && clast_mesh_check_passed(&before);
    const bool was_simple = !cli_counts_twice(&before);
    clast_mesh_check_free(&before);
    if (common->quiet || (!*is_lost && !was_simple)) {
        return CLAST_OK;
    }
    if (*is_lost) {
        (void)fprintf(stderr,
                      "clast mesh simplify: %s is no solid any more: %d part%s inside out, %lld "
                      "pair%s of triangles that cut each other; ask for more --faces\n",
                      cli_name(common->output), found->n_inside_out,
                      cli_plural(found->n_inside_out), (long long)found->n_intersection,
                      cli_plural(found->n_intersection));
    } else {
        char words[200];
        clast_mesh_check_doubles(found, sizeof words, words);
        (void)fprintf(stderr, "clast mesh simplify: note: %s: now %s; ask for more --faces\n",
                      cli_name(common->output), words);
    }
    return CLAST_OK;
}

static clast_status run_simplify(const cli_common *common, void *config_bytes)
{
    const simplify_config *config = config_bytes;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    clast_mesh_simplify_report report = {0};
    clast_mesh_read_report read = {0};
    clast_mesh_check_result found = {0};
    bool is_lost = false;
    clast_status status = CLAST_OK;
    CLI_TRY(cli_mesh_output(common));
    CLI_TRY(cli_mesh_welded(common, &mesh, &read));
    status = clast_mesh_simplify(&mesh, config->faces, &out, &report);
    CLI_TRY(cli_mesh_refused(common->argument[0], &mesh, NULL, status));
    if (clast_mesh_format_of_path(common->output) == CLAST_MESH_STL) {
        CLI_TRY(clast_mesh_round_float(&out));
        report.volume_after = clast_mesh_volume(&out);
    }
    CLI_TRY(cli_mesh_save(common, &out, &read));
    CLI_TRY(check_simplified(common, &mesh, &out, &found, &is_lost));
    if (common->json) {
        CLI_TRY(cli_print_json(simplify_json(common, &report, &found)));
    } else {
        simplify_words(common, &report, read.unit);
    }
    CLI_CHECK(report.reached, CLAST_E_CONVERGE,
              "%s has %d triangles, not %d: no further edge can go without changing "
              "the topology or folding over",
              common->output, report.n_triangle_after, config->faces);
    status = is_lost ? CLAST_E_NO : CLAST_OK;
done:
    clast_mesh_check_free(&found);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
    return status;
}

static void hull_words(const cli_common *common, const clast_mesh *mesh, const clast_mesh *hull,
                       const char *unit, double volume, const char *why)
{
    char words[32];
    cli_mesh_unit(unit, words);
    (void)printf("%s: %d vertices -> %s: hull of %d vertices, %d triangles; %s\n",
                 cli_name(common->argument[0]), mesh->n_vert, cli_name(common->output),
                 hull->n_vert, hull->n_tri, words);
    (void)printf("  hull volume %.10g, area %.10g\n", clast_mesh_volume(hull),
                 clast_mesh_area(hull));
    cli_hull_words(mesh, clast_mesh_volume(hull), volume, why);
}

static json_t *hull_json(const cli_common *common, const clast_mesh *mesh, const clast_mesh *hull,
                         const char *unit, double volume)
{
    json_t *o = json_object();
    cli_json_text(o, "file", common->argument[0]);
    cli_json_text(o, "output", common->output);
    cli_json_text(o, "unit", unit[0] != '\0' ? unit : "model");
    cli_json_count(o, "n_vertex", hull->n_vert);
    cli_json_count(o, "n_triangle", hull->n_tri);
    cli_json_number(o, "volume", volume);
    cli_json_number(o, "area", clast_mesh_area(mesh));
    cli_json_number(o, "hull_volume", clast_mesh_volume(hull));
    cli_json_number(o, "hull_area", clast_mesh_area(hull));
    cli_json_number(o, "added_volume", clast_mesh_volume(hull) - volume);
    return o;
}

static clast_status run_hull(const cli_common *common, void *config)
{
    clast_mesh mesh = {0};
    clast_mesh hull = {0};
    clast_mesh_read_report read = {0};
    double volume = 0.0;
    const char *why = "";
    (void)config;
    clast_status status = CLAST_OK;
    CLI_TRY(cli_mesh_output(common));
    CLI_TRY(cli_mesh_input(common, &mesh, &read));
    CLI_TRY(clast_mesh_hull(&mesh, &hull));
    CLI_CHECK(clast_mesh_volume(&hull) > 0.0, CLAST_E_GEOMETRY,
              "%s: the lengths are too small for a volume of the hull; is the unit right?",
              common->argument[0]);
    CLI_TRY(cli_solid_volume(&mesh, &volume, &why));
    CLI_TRY(cli_mesh_save(common, &hull, &read));
    if (common->json) {
        CLI_TRY(cli_print_json(hull_json(common, &mesh, &hull, read.unit, volume)));
    } else {
        hull_words(common, &mesh, &hull, read.unit, volume, why);
    }
done:
    clast_mesh_free(&hull);
    clast_mesh_free(&mesh);
    return status;
}

const cli_command cli_mesh_simplify = {
    .name = "mesh simplify",
    .arguments = "FILE --faces N -o OUT",
    .summary = "fewer triangles, same volume",
    .example = {"clast mesh simplify data/standin63/grain00.ply --faces 100 -o small.stl",
                "clast mesh simplify data/standin63/grain01.ply --faces 50 -o smaller.ply",
                "clast mesh simplify scan.stl --faces 5000 -o small.obj --json"},
    .details =
        "Edges collapse, cheapest first, each to the point that keeps the volume and moves "
        "the surface\nleast (Lindstrom and Turk 1998). Topology stays; no triangle folds "
        "over. Reports how far the two\nsurfaces are apart. The volume is kept to 1e-12; in "
        "an STL, which has "
        "24 bits\nfor each coordinate, to about 1e-10. Walls do not see each other: the result "
        "is checked as by\nclast mesh check.\nExit code 1 when it is no solid any more, 5 "
        "when the number cannot be reached (the result is written all the same).",
    .fields = simplify_fields,
    .config_size = sizeof(simplify_config),
    .n_min = 1,
    .n_max = 1,
    .needs_file = true,
    .run = run_simplify,
};

const cli_command cli_mesh_hull = {
    .name = "mesh hull",
    .arguments = "FILE -o OUT",
    .summary = "convex hull of a surface, or of the vertices of a file without faces",
    .example = {"clast mesh hull data/scarlet/stl/particle.stl -o hull.stl",
                "clast mesh hull data/scarlet/stl/t_rex.stl -o hull.ply",
                "clast mesh hull scan.stl -o hull.obj --json"},
    .details =
        "Quickhull by qhull_r; reports the volume that the hull adds. Points are the vertices of a "
        "PLY or OBJ;\nof a CSV of points (x, y, z), clast shape measures the hull and --surfaces "
        "writes it.",
    .fields = NULL,
    .config_size = 0,
    .n_min = 1,
    .n_max = 1,
    .needs_file = true,
    .run = run_hull,
};
