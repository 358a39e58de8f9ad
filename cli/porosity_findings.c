// What clast porosity found: as JSON, as tables and charts, in words.
#include "porosity_findings.h"

#include "json.h"
#include "packing.h"
#include "quantity.h"
#include "results.h"
#include <clast/chart.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double LEAST_OUTSIDE = 1e-3; ///< share of a given bed that is told

/// Mean and standard deviation of the local porosity of grains whose cell no wall cuts.
static int64_t local_moments(const clast_table *local, double *mean, double *deviation)
{
    const double *porosity = clast_table_numbers(local, "porosity");
    const double *border = clast_table_numbers(local, "border");
    int64_t n = 0;
    double sum = 0.0;
    double square = 0.0;
    for (int64_t i = 0; porosity != NULL && border != NULL && i < local->n_row; ++i) {
        if (border[i] == 0.0 && isfinite(porosity[i])) {
            ++n;
            sum += porosity[i];
        }
    }
    *mean = n > 0 ? sum / (double)n : (double)NAN;
    for (int64_t i = 0; porosity != NULL && border != NULL && i < local->n_row; ++i) {
        if (border[i] == 0.0 && isfinite(porosity[i])) {
            square += (porosity[i] - *mean) * (porosity[i] - *mean);
        }
    }
    *deviation = n > 1 ? sqrt(square / (double)(n - 1)) : (double)NAN;
    return n;
}

static json_t *profile_json(const clast_bed_findings *f)
{
    json_t *rows = json_array();
    const double *low = f->profile.column[0].number; // z_low, z_high, with _m where that is known
    const double *high = f->profile.column[1].number;
    const double *porosity = clast_table_numbers(&f->profile, "porosity");
    for (int64_t k = 0; k < f->profile.n_row; ++k) {
        json_t *row = json_object();
        cli_json_number(row, "z", 0.5 * (low[k] + high[k]));
        cli_json_number(row, "porosity", porosity[k]);
        (void)json_array_append_new(rows, row);
    }
    return rows;
}

/// How many contacts of a force chain there are, and how many chains.
static void count_chains(const clast_table *chains, int64_t *n_contact, int64_t *n_chain)
{
    const double *chain = clast_table_numbers(chains, "chain");
    *n_contact = 0;
    *n_chain = 0;
    for (int64_t k = 0; chain != NULL && k < chains->n_row; ++k) {
        *n_contact += chain[k] > 0.0 ? 1 : 0;
        *n_chain = chain[k] > (double)*n_chain ? (int64_t)chain[k] : *n_chain;
    }
}

/// Sum of density times volume over all cells.
static double mass_of(const clast_table *fields)
{
    const double *density = clast_table_numbers(fields, "density_kg/m^3");
    const double *side[3] = {clast_table_numbers(fields, "dx_m"),
                             clast_table_numbers(fields, "dy_m"),
                             clast_table_numbers(fields, "dz_m")};
    double sum = 0.0;
    for (int64_t k = 0; k < fields->n_row; ++k) {
        sum += density[k] * side[0][k] * side[1][k] * side[2][k];
    }
    return sum;
}

static void add_chains(json_t *object, const clast_bed_findings *f)
{
    int64_t n_contact = 0;
    int64_t n_chain = 0;
    if (f->chains.n_column > 0) {
        count_chains(&f->chains, &n_contact, &n_chain);
        cli_json_count(object, "n_chain", n_chain);
        cli_json_count(object, "n_chain_contact", n_contact);
    }
    if (f->fields.n_column > 0) {
        cli_json_count(object, "n_field_cell", f->fields.n_row);
        cli_json_number(object, "field_mass", mass_of(&f->fields));
    }
}

json_t *cli_porosity_json(const clast_assembly *assembly, const clast_bed_findings *f)
{
    json_t *object = json_object();
    cli_json_text(object, "method",
                  f->options.porosity.method == CLAST_POROSITY_EXACT ? "exact" : "spheres");
    cli_json_count(object, "n_grain", assembly->n_grain);
    cli_json_number(object, "bulk", f->bulk.porosity);
    cli_json_number(object, "z_low", f->bulk.z_low);
    cli_json_number(object, "z_high", f->bulk.z_high);
    cli_json_number(object, "top", f->bulk.top);
    cli_json_number(object, "solid", f->bulk.solid);
    cli_json_number(object, "grain_size", f->walls.size);
    if (isfinite(f->walls.ratio)) {
        cli_json_number(object, "wall_ratio", f->walls.ratio);
    }
    if (f->beyond.n >= 0) {
        cli_json_bool(object, "is_part", f->bed.is_part);
        cli_json_count(object, "n_beyond", f->beyond.n);
        cli_json_number(object, "max_beyond", f->beyond.depth);
        cli_json_number(object, "solid_beyond", f->beyond.solid);
    }
    if (isfinite(f->outside)) {
        cli_json_number(object, "bed_outside", f->outside);
    }
    if (f->options.core > 0.0) {
        cli_json_number(object, "core_depth", f->core.depth);
        cli_json_number(object, "core", f->core.porosity);
        cli_json_number(object, "core_error", f->core.error);
        cli_json_number(object, "wall_share", f->core.share);
    }
    cli_json_number(object, "coordination", f->mean_coordination);
    if (f->n_overlap >= 0) {
        cli_json_count(object, "n_overlap", f->n_overlap);
        cli_json_number(object, "max_overlap", f->max_overlap);
        cli_json_number(object, "max_overlap_share", f->max_overlap_share);
    }
    cli_json_text(object, "unit", assembly->unit);
    if (f->local.n_column > 0) {
        double mean = NAN;
        double deviation = NAN;
        cli_json_count(object, "n_local", local_moments(&f->local, &mean, &deviation));
        cli_json_number(object, "local_mean", mean);
        cli_json_number(object, "local_deviation", deviation);
    }
    if (f->pores.sizes.n_column > 0) {
        cli_json_number(object, "pore_mean", f->pores.mean);
        cli_json_number(object, "pore_porosity", f->pores.porosity);
    }
    add_chains(object, f);
    json_t *fabric = json_object();
    for (int64_t k = 0; k < f->fabric.n_row; ++k) {
        cli_json_number(fabric, f->fabric.column[0].text[k], f->fabric.column[1].number[k]);
    }
    (void)json_object_set_new(object, "fabric", fabric);
    if (f->stress.n_column > 0) {
        json_t *stress = json_object();
        for (int64_t k = 0; k < f->stress.n_row; ++k) {
            cli_json_number(stress, f->stress.column[0].text[k], f->stress.column[1].number[k]);
        }
        (void)json_object_set_new(object, "stress", stress);
    }
    return object;
}

static clast_status write_tables(const clast_run_folder *run, const clast_assembly *assembly,
                                 clast_bed_findings *f)
{
    char path[CLAST_RUN_PATH];
    const struct {
        const char *name;
        clast_table *table;
    } files[] = {{"profile.csv", &f->profile}, {"coordination.csv", &f->coordination},
                 {"fabric.csv", &f->fabric},   {"local.csv", &f->local},
                 {"radial.csv", &f->radial},   {"pores.csv", &f->pores.sizes},
                 {"stress.csv", &f->stress},   {"stress_profile.csv", &f->stress_profile},
                 {"fields.csv", &f->fields},   {"chains.csv", &f->chains}};
    for (size_t k = 0; k < sizeof files / sizeof files[0]; ++k) {
        if (files[k].table->n_column > 0) {
            if (strcmp(assembly->unit, "m") != 0) {
                cli_table_without_unit(files[k].table);
            }
            CLI_GUARD(clast_run_folder_file(run, files[k].name, path));
            CLI_GUARD(clast_table_write_csv(files[k].table, path));
        }
    }
    return CLAST_OK;
}

/// Force chains and fields for ParaView, and the picture of the chains.
static clast_status write_vtk(const clast_run_folder *run, const clast_bed_findings *f,
                              const char *unit)
{
    char path[CLAST_RUN_PATH];
    if (f->fields.n_column > 0) {
        CLI_GUARD(clast_run_folder_file(run, "fields.vti", path));
        CLI_GUARD(clast_table_write_vti(&f->fields, path));
    }
    if (f->chains.n_column > 0) {
        CLI_GUARD(clast_run_folder_file(run, "chains.vtp", path));
        CLI_GUARD(clast_table_write_vtp(&f->chains, path));
    }
    if (f->chains.n_row > 0) { // a chart of no line has no axes
        CLI_GUARD(clast_run_folder_file(run, "chains.svg", path));
        CLI_GUARD(clast_chart_chains(&f->chains, unit, path));
    }
    return CLAST_OK;
}

/// Charts, then the tables that they are drawn from.
clast_status cli_porosity_files(const clast_run_folder *run, const clast_assembly *assembly,
                                clast_bed_findings *f)
{
    char path[CLAST_RUN_PATH];
    CLI_GUARD(clast_run_folder_file(run, "profile.svg", path));
    CLI_GUARD(clast_chart_porosity(&f->profile, &f->bulk, assembly->unit, path));
    if (f->radial.n_column > 0) {
        CLI_GUARD(clast_run_folder_file(run, "radial.svg", path));
        CLI_GUARD(clast_chart_radial(&f->radial, assembly->unit, path));
    }
    if (f->stress_profile.n_column > 0) {
        CLI_GUARD(clast_run_folder_file(run, "stress.svg", path));
        CLI_GUARD(clast_chart_stress(&f->stress_profile, assembly->unit, path));
    }
    if (f->pores.sizes.n_column > 0) {
        CLI_GUARD(clast_run_folder_file(run, "pores.svg", path));
        CLI_GUARD(clast_chart_pores(&f->pores.sizes, assembly->unit, path));
    }
    CLI_GUARD(write_vtk(run, f, assembly->unit));
    return write_tables(run, assembly, f);
}

/// What the side walls do to the bulk porosity.
static void print_walls(const char *unit, const clast_bed_findings *f)
{
    if (f->bed.is_part) {
        (void)printf("side walls          none: the bed is a part of a packing\n");
    } else if (f->bed.kind == CLAST_BED_MESH) {
        (void)printf("side walls          a surface: its distance in grain sizes is not known\n");
    } else if (!isfinite(f->walls.ratio)) {
        (void)printf("side walls          none: the bed is periodic\n");
    } else {
        (void)printf("side walls          %.4g grain sizes (of %s, mean by volume) from the "
                     "axis%s\n",
                     f->walls.ratio, cli_quantity(f->walls.size, unit),
                     f->options.core > 0.0  ? ""
                     : f->walls.ratio > 2.5 ? ", which loosen the bed; --core 2 leaves them out"
                                            : ", which loosen the bed");
    }
    if (f->beyond.n > 0 && f->bed.is_part) {
        (void)printf("beyond the sides    %d grain%s, by up to %s: a part of a packing; bulk and "
                     "profile count what lies inside, contacts do not%s\n",
                     f->beyond.n, cli_plural(f->beyond.n), cli_quantity(f->beyond.depth, unit),
                     f->knows_contacts ? "; no stress (--fields has it by place)" : "");
    } else if (f->beyond.n > 0) {
        (void)printf("beyond the sides    %d grain%s, by up to %s: bulk and profile count them "
                     "whole, %.3g %% of this solid lies outside%s\n",
                     f->beyond.n, cli_plural(f->beyond.n), cli_quantity(f->beyond.depth, unit),
                     100.0 * f->beyond.solid / f->bulk.solid,
                     f->pores.sizes.n_column > 0 ? "; porosity by points (pores) does not" : "");
    }
    if (f->outside > LEAST_OUTSIDE) {
        (void)printf("outside             %.3g %% of the bed lies outside the run's own, where no "
                     "grain is: it counts as pores\n",
                     100.0 * f->outside);
    }
    if (f->options.core > 0.0) {
        (void)printf(
            "core                %.6f   +- %.2g, farther than %g grain sizes from the side "
            "walls; their share of the bulk porosity is %.4f\n",
            f->core.porosity, f->core.error, f->options.core, f->core.share);
    }
}

clast_status cli_porosity_print(const cli_common *common, const clast_assembly *assembly,
                                const clast_bed_findings *f, const clast_packing_report *report)
{
    const bool is_model = strcmp(assembly->unit, "model") == 0;
    const char *unit = is_model ? "model units" : assembly->unit;
    if (common->json) {
        json_t *object = cli_porosity_json(assembly, f);
        cli_packing_json(object, report);
        (void)json_object_set_new(object, "profile", profile_json(f));
        return cli_print_json(object);
    }
    (void)printf("%d grain%s, %s\n", assembly->n_grain, cli_plural(assembly->n_grain),
                 f->options.porosity.method == CLAST_POROSITY_EXACT ? "true shapes"
                                                                    : "spheres of equal volume");
    (void)printf("bulk porosity       %.6f   from z = %s to %s\n", f->bulk.porosity,
                 cli_quantity_as(f->bulk.z_low, unit, f->bulk.z_high),
                 cli_quantity(f->bulk.z_high, unit));
    if (f->bed.kind == CLAST_BED_PERIODIC_3D) {
        (void)printf("bed                 periodic in all three directions: the whole box\n");
    } else {
        (void)printf("top of the bed      %s   where the porosity rises through %g\n",
                     cli_quantity(f->bulk.top, unit), f->options.porosity.cut);
    }
    print_walls(unit, f);
    if (f->n_overlap > 0) {
        (void)printf(
            "overlaps            %d pair%s of grains, the deepest by %.3g %% of the smaller "
            "one's radius (of equal volume); the solid counts what they share twice\n",
            f->n_overlap, f->n_overlap == 1 ? "" : "s", 100.0 * f->max_overlap_share);
    } else if (f->n_overlap < 0 && !f->knows_contacts) {
        (void)printf("overlaps            not searched for across the borders of a sheared box\n");
    } else if (f->n_overlap < 0) {
        (void)printf("overlaps            those of the run's own contacts: max_overlap in its "
                     "summary.json\n");
    } else {
        (void)printf("overlaps            none\n");
    }
    if (isfinite(f->mean_coordination)) {
        (void)printf("mean coordination   %.4f   from %d contacts\n", f->mean_coordination,
                     assembly->n_contact);
    }
    if (f->local.n_column > 0) {
        double mean = NAN;
        double deviation = NAN;
        const int64_t n = local_moments(&f->local, &mean, &deviation);
        if (n > 1) {
            (void)printf(
                "local porosity      %.4f mean, %.4f standard deviation, of %lld grains whose "
                "cells reach no wall\n",
                mean, deviation, (long long)n);
        } else {
            (void)printf(
                "local porosity      every grain's cell but %lld reaches a wall: no mean\n",
                (long long)n);
        }
    }
    if (f->pores.sizes.n_column > 0) {
        (void)printf("pores               %s   mean distance to the nearest grain; porosity by "
                     "points %.4f\n",
                     cli_quantity(f->pores.mean, unit), f->pores.porosity);
    }
    for (int64_t k = 0; k < f->fabric.n_row; ++k) {
        if (strcmp(f->fabric.column[0].text[k], "coordination") != 0) { // told above
            (void)printf("%-20s %.4f   %s\n", f->fabric.column[0].text[k],
                         f->fabric.column[1].number[k], f->fabric.column[3].text[k]);
        }
    }
    for (int64_t k = 0; k < f->stress.n_row; ++k) {
        (void)printf("%-20s %s   %s\n", f->stress.column[0].text[k],
                     cli_quantity(f->stress.column[1].number[k], f->stress.column[2].text[k]),
                     f->stress.column[3].text[k]);
    }
    if (f->fields.n_column > 0) {
        (void)printf("fields              %lld cells, which hold %s\n", (long long)f->fields.n_row,
                     cli_quantity(mass_of(&f->fields), "kg"));
    }
    if (f->chains.n_column > 0 && f->chains.n_row == 0) {
        (void)printf("force chains        none: no grain touches another or a wall, so there is no "
                     "chains.svg; let the run settle (clast pack --resume)\n");
    } else if (f->chains.n_row > 0) {
        int64_t n_contact = 0;
        int64_t n_chain = 0;
        count_chains(&f->chains, &n_contact, &n_chain);
        (void)printf("force chains        %lld, of %lld of %lld contacts\n", (long long)n_chain,
                     (long long)n_contact, (long long)f->chains.n_row);
    }
    if (common->output != NULL) {
        (void)printf("tables and profile.svg are in %s\n", cli_name(common->output));
    }
    return CLAST_OK;
}
