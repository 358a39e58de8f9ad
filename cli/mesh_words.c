// Words and JSON of a surface check.
#include "mesh_words.h"

#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <math.h>
#include <stdio.h>

static json_t *fault_list(const clast_mesh_check_result *r)
{
    json_t *list = json_array();
    for (int32_t i = 0; i < r->n_fault; ++i) {
        json_t *fault = json_object();
        cli_json_text(fault, "code", r->fault[i].code);
        cli_json_text(fault, "text", r->fault[i].text);
        cli_json_bool(fault, "blocking", r->fault[i].blocking);
        (void)json_array_append_new(list, fault);
    }
    return list;
}

static json_t *part_list(const clast_mesh_check_result *r)
{
    json_t *list = json_array();
    for (int32_t i = 0; i < r->n_part; ++i) {
        const clast_mesh_part *p = &r->part[i];
        json_t *part = json_object();
        cli_json_count(part, "n_triangle", p->n_triangle);
        cli_json_bool(part, "closed", p->closed);
        cli_json_bool(part, "oriented", p->oriented && !p->inside_out);
        cli_json_bool(part, "manifold", p->manifold);
        cli_json_count(part, "genus", p->genus);
        cli_json_count(part, "depth", p->depth);
        cli_json_count(part, "winding", p->winding);
        cli_json_number(part, "volume", p->volume);
        cli_json_number(part, "area", p->area);
        (void)json_array_append_new(list, part);
    }
    return list;
}

json_t *cli_check_json(const char *file, const char *unit, const clast_mesh_check_result *r)
{
    json_t *o = json_object();
    cli_json_text(o, "file", file);
    cli_json_text(o, "unit", unit[0] != '\0' ? unit : "model");
    cli_json_count(o, "n_vertex", r->n_vertex);
    cli_json_count(o, "n_triangle", r->n_triangle);
    cli_json_bool(o, "closed", r->closed);
    cli_json_bool(o, "oriented", r->oriented);
    cli_json_bool(o, "manifold", r->manifold);
    cli_json_count(o, "n_part", r->n_part);
    cli_json_count(o, "euler", r->euler);
    cli_json_count(o, "genus", r->genus);
    cli_json_number(o, "volume", r->volume);
    cli_json_number(o, "volume_divergence", r->volume_divergence);
    cli_json_number(o, "volume_spread", r->volume_spread);
    cli_json_number(o, "area", r->area);
    cli_json_number(o, "area_heron", r->area_heron);
    cli_json_number(o, "hull_volume", r->hull_volume);
    cli_json_number(o, "extent", r->extent);
    cli_json_count(o, "n_edge", r->n_edge);
    cli_json_count(o, "n_open_edge", r->n_open_edge);
    cli_json_count(o, "n_open_loop", r->n_open_loop);
    cli_json_number(o, "largest_hole", r->largest_hole);
    cli_json_number(o, "weld_tolerance", r->weld_tolerance);
    cli_json_count(o, "n_open_edge_after_weld", r->n_open_after_weld);
    cli_json_count(o, "n_nonmanifold_edge", r->n_nonmanifold_edge);
    cli_json_count(o, "n_nonmanifold_vertex", r->n_nonmanifold_vertex);
    cli_json_count(o, "n_misoriented_edge", r->n_misoriented_edge);
    cli_json_count(o, "n_inside_out", r->n_inside_out);
    cli_json_count(o, "n_nested", r->n_nested);
    cli_json_count(o, "n_doubled", r->n_doubled);
    cli_json_count(o, "n_body", r->n_body);
    cli_json_count(o, "n_repeated", r->n_repeated);
    cli_json_count(o, "n_degenerate", r->n_degenerate);
    cli_json_count(o, "n_duplicate", r->n_duplicate);
    cli_json_count(o, "n_unused_vertex", r->n_unused_vertex);
    cli_json_count(o, "n_intersection", r->n_intersection);
    cli_json_count(o, "n_touch", r->n_touch);
    cli_json_bool(o, "intersection_complete", r->intersection_complete);
    (void)json_object_set_new(o, "parts", part_list(r));
    (void)json_object_set_new(o, "faults", fault_list(r));
    return o;
}

static const char *yes(bool is)
{
    return is ? "yes" : "NO";
}

void cli_check_words(const char *file, const char *unit, const clast_mesh_check_result *r)
{
    char words[32];
    cli_mesh_unit(unit, words);
    (void)printf("%s: %s\n", cli_name(file),
                 clast_mesh_check_passed(r) ? "a solid: closed, oriented and manifold"
                                            : "NOT a solid that can be measured");
    (void)printf("  vertices %d, triangles %d, edges %d, parts %d, Euler number %lld, genus %d\n",
                 r->n_vertex, r->n_triangle, r->n_edge, r->n_part, (long long)r->euler, r->genus);
    (void)printf("  closed %s, oriented %s, manifold %s\n", yes(r->closed), yes(r->oriented),
                 yes(r->manifold));
    (void)printf("  extent       %.10g (%s%s)\n", r->extent, words,
                 unit[0] != '\0' ? "" : ": the file's own");
    (void)printf("  volume       %.10g (four sums differ by %.2g)\n", r->volume, r->volume_spread);
    (void)printf("  area         %.10g (two sums differ by %.2g)\n", r->area,
                 fabs(r->area - r->area_heron));
    (void)printf("  hull volume  %.10g", r->hull_volume);
    if (r->hull_volume > 0.0) {
        (void)printf(" (volume / hull volume %.6g)", r->volume / r->hull_volume);
    }
    (void)printf("\n");
    for (int32_t i = 0; i < r->n_fault; ++i) {
        (void)printf("  %s %s: %s\n", r->fault[i].blocking ? "FAULT" : "note ", r->fault[i].code,
                     r->fault[i].text);
    }
}

clast_status cli_mesh_output(const cli_common *common)
{
    if (common->output == NULL) {
        return cli_fail(CLAST_E_USAGE, "where to? give -o NAME.stl (or .obj, .ply, .off)");
    }
    if (clast_mesh_format_of_path(common->output) == CLAST_MESH_ANY) {
        return cli_fail(CLAST_E_USAGE,
                        "%s: no surface format by that name; write .stl, .obj, .ply or .off",
                        common->output);
    }
    if (clast_mesh_format_of_path(common->output) == CLAST_MESH_3MF) {
        return cli_fail(CLAST_E_USAGE,
                        "%s: 3MF is in mm and this surface's unit is not known; write .stl, then "
                        "clast mesh convert --unit",
                        common->output);
    }
    return CLAST_OK;
}

/// Says on stderr what the weld joined.
static void note_weld(const cli_common *common, const clast_mesh_repair_report *weld,
                      const char *unit)
{
    char words[32];
    cli_mesh_unit(unit, words);
    if (weld->n_merged > 0 && !common->quiet) {
        (void)fprintf(stderr,
                      "clast %s: note: %s: %d vert%s of open edges merged with others within %.3g "
                      "(%s)\n",
                      common->command, cli_name(common->argument[0]), weld->n_merged,
                      weld->n_merged == 1 ? "ex" : "ices", weld->weld_distance, words);
    }
}

clast_status cli_mesh_welded(const cli_common *common, clast_mesh *mesh,
                             clast_mesh_read_report *report)
{
    clast_mesh_repair_report weld = {0};
    clast_mesh_read_report own = {0};
    clast_mesh_read_report *r = report != NULL ? report : &own;
    CLI_GUARD(cli_mesh_input(common, mesh, r));
    CLI_GUARD(clast_mesh_weld_auto(mesh, &weld));
    note_weld(common, &weld, r->unit);
    return CLAST_OK;
}

bool cli_counts_twice(const clast_mesh_check_result *found)
{
    char words[200];
    clast_mesh_check_doubles(found, sizeof words, words);
    return words[0] != '\0';
}

void cli_note_doubles(const cli_common *common, const clast_mesh_check_result *found,
                      const char *effect)
{
    char words[200];
    clast_mesh_check_doubles(found, sizeof words, words);
    if (words[0] == '\0' || common->quiet) {
        return;
    }
    const bool is_cut = found->n_intersection > 0 || !found->intersection_complete;
    const int32_t n = found->n_flat > 0      ? found->n_flat
                      : found->n_doubled > 0 ? found->n_doubled
                                             : found->n_repeated;
    (void)fprintf(stderr, "clast %s: note: %s: %s%s; %s\n", common->command,
                  cli_name(common->argument[0]), words, found->n_flat > 0 ? "" : effect,
                  found->n_flat == 0 && is_cut ? "see clast mesh check"
                  : n == 1                     ? "clast mesh repair drops it"
                                               : "clast mesh repair drops them");
}

clast_status cli_mesh_refused(const char *path, const clast_mesh *mesh, const char *otherwise,
                              clast_status status)
{
    if (status != CLAST_E_GEOMETRY) {
        return status;
    }
    const clast_status solid = clast_mesh_require_solid(mesh, path, otherwise);
    return solid != CLAST_OK ? solid : status;
}

clast_status cli_mesh_input(const cli_common *common, clast_mesh *mesh,
                            clast_mesh_read_report *report)
{
    clast_mesh_read_report own = {0};
    clast_mesh_read_report *r = report != NULL ? report : &own;
    CLI_GUARD(clast_mesh_read(common->argument[0], mesh, r));
    for (int32_t i = 0; i < r->n_warning && !common->quiet; ++i) {
        (void)fprintf(stderr, "clast %s: %s: %s\n", common->command, cli_name(common->argument[0]),
                      r->warning[i]);
    }
    return CLAST_OK;
}

clast_status cli_solid_volume(const clast_mesh *mesh, double *volume, const char **why)
{
    clast_mesh welded = {0};
    clast_mesh_check_result found = {0};
    clast_status status = CLAST_OK;
    *volume = (double)NAN;
    CLI_TRY(clast_mesh_copy(mesh, &welded));
    CLI_TRY(clast_mesh_weld_auto(&welded, NULL));
    if (welded.n_tri > 0) {
        CLI_TRY(clast_mesh_check(&welded, &found));
    }
    if (!found.closed || !found.oriented) {
        *why = mesh->n_tri > 0 ? "is not closed (clast mesh check)" : "is points";
    } else if (cli_counts_twice(&found)) {
        *why = found.intersection_complete ? "counts volume twice (clast mesh check)"
                                           : "may count volume twice (clast mesh check)";
    } else {
        *volume = found.volume;
    }
done:
    clast_mesh_check_free(&found);
    clast_mesh_free(&welded);
    return status;
}

void cli_hull_words(const clast_mesh *mesh, double hull_volume, double volume, const char *why)
{
    if (isnan(volume)) {
        (void)printf("  what it adds is not known: the input %s\n", why);
        return;
    }
    (void)printf(
        "  surface volume %.10g, area %.10g: the hull adds %.10g (%.4g of its own volume)\n",
        volume, clast_mesh_area(mesh), hull_volume - volume, 1.0 - volume / hull_volume);
}

void cli_mesh_unit(const char *unit, char words[32])
{
    (void)snprintf(words, 32, "%s%s", unit[0] != '\0' ? "lengths in " : "model units", unit);
}

clast_status cli_mesh_length(const char *name, const char *text, const char *unit, double *value)
{
    const clast_status status = clast_unit_parse_length(text, unit, value);
    if (status != CLAST_OK) {
        return cli_fail(status, "%s: %s", name, clast_error_detail());
    }
    return *value >= 0.0 && *value <= 1e12
               ? CLAST_OK
               : cli_fail(CLAST_E_CONFIG, "%s: %s is outside [0, 1e12]", name, text);
}

clast_status cli_mesh_save(const cli_common *common, const clast_mesh *mesh,
                           const clast_mesh_read_report *read)
{
    const clast_mesh_write_options options = {.unit = read->unit[0] != '\0' ? read->unit : NULL};
    return clast_mesh_write(mesh, common->output, &options);
}
