// What clast porosity measures of one bed.
#include "porosity_measure.h"

#include "quantity.h"
#include <math.h>
#include <string.h>

enum { PORE_BINS = 50 };

static const double MOST_BEYOND = 0.01; ///< of the solid that counts
static const double SAME = 1e-3;        ///< share by which a typed period may differ

void cli_porosity_bed_free(cli_porosity_bed *s)
{
    clast_assembly_free(&s->assembly);
    clast_mesh_free(&s->surface);
    clast_mesh_free(&s->own_surface);
    clast_table_free(&s->contacts);
    clast_table_free(&s->velocities);
}

double cli_porosity_mean_diameter(const clast_assembly *a)
{
    return a->n_grain > 0 ? 2.0 * cbrt(0.75 / CLAST_PI * clast_assembly_volume(a) / a->n_grain)
                          : 1.0;
}

/// Fields and force chains, where they are asked for.
static clast_status measure_forces(const cli_porosity_bed *s, const cli_porosity_wanted *wanted,
                                   cli_porosity_findings *f)
{
    const bool has_forces = s->contacts.n_column > 0;
    if (wanted->fields > 0.0) {
        CLI_GUARD(clast_bed_fields(&s->bed, &s->assembly, has_forces ? &s->contacts : NULL,
                                   s->velocities.n_column > 0 ? &s->velocities : NULL,
                                   wanted->fields, &f->fields));
    }
    return wanted->chains ? clast_bed_chains(&s->bed, &s->assembly, &s->contacts, &f->chains)
                          : CLAST_OK;
}

/// Contacts, directions and overlaps. The contacts of a run of clast pack overlap by what their
/// forces need, which that run tells: they are not searched for anew.
static clast_status measure_contacts(cli_porosity_bed *s, double gap, cli_porosity_findings *f)
{
    clast_assembly *assembly = &s->assembly;
    const clast_bed *bed = &s->bed;
    clast_period period = {.low = {bed->low[0], bed->low[1], bed->floor}};
    const bool is_periodic = clast_bed_period(bed, period.length);
    f->overlaps = (clast_overlaps){-1, NAN, NAN};
    f->knows_contacts = s->contacts.n_column > 0;
    if (gap > 0.0 && bed->shift != 0.0) {
        return cli_fail(CLAST_E_USAGE,
                        "--bed: contacts across the borders of a sheared box are those of runs of "
                        "clast pack, which know them; this bed knows none: leave out --gap");
    }
    if (!f->knows_contacts && bed->shift == 0.0) {
        CLI_GUARD(clast_assembly_overlaps(assembly, is_periodic ? &period : NULL, &f->overlaps));
    }
    f->mean_coordination = NAN;
    if (gap > 0.0) {
        CLI_GUARD(
            clast_assembly_find_contacts_periodic(assembly, gap, is_periodic ? &period : NULL));
    }
    if (assembly->contact != NULL) {
        f->mean_coordination = 2.0 * assembly->n_contact / assembly->n_grain;
        CLI_GUARD(clast_assembly_coordination(assembly, &f->coordination));
    }
    return clast_fabric(assembly, f->knows_contacts ? &s->contacts : NULL,
                        is_periodic ? period.length : NULL, &f->fabric);
}

static const char *unit_of(const cli_porosity_bed *s)
{
    return strcmp(s->assembly.unit, "model") == 0 ? "model units" : s->assembly.unit;
}

/// A bed that holds more solid than room is not the one that the grains lie in.
static clast_status check_room(const cli_porosity_bed *s, const clast_porosity_bulk *bulk)
{
    return bulk->porosity >= -1e-2
               ? CLAST_OK
               : cli_fail(CLAST_E_GEOMETRY,
                          "grains take %.4g times the room of this bed between z = %s and %s: it "
                          "is smaller than what holds them (--pores measures a part of a "
                          "packing), or in another unit (--bed)",
                          1.0 - bulk->porosity,
                          cli_quantity_as(bulk->z_low, unit_of(s), bulk->z_high),
                          cli_quantity(bulk->z_high, unit_of(s)));
}

/// Nor is a periodic bed whose images lie on the grains, or not where the run's own do.
static clast_status check_images(const cli_porosity_bed *s, const cli_porosity_wanted *wanted)
{
    const clast_porosity_bulk none = {0};
    clast_bed_beyond covered;
    double period[3];
    double own[3] = {0};
    if (!wanted->is_given || s->assembly.n_grain == 0 || !clast_bed_period(&s->bed, period)) {
        return CLAST_OK;
    }
    if (s->has_own) {
        (void)clast_bed_period(&s->own, own);
    }
    for (int k = 0; k < 3; ++k) {
        if (own[k] > 0.0 && period[k] > 0.0 && fabs(period[k] - own[k]) > SAME * own[k]) {
            return cli_fail(CLAST_E_GEOMETRY,
                            "--bed: a period of %s along %c, where the run repeats after %s; leave "
                            "out --bed, or measure a part of the packing (box, with --pores)",
                            cli_quantity(period[k], unit_of(s)), 'x' + k,
                            cli_quantity(own[k], unit_of(s)));
        }
    }
    const double sheared =
        own[2] > 0.0 && period[2] > 0.0 ? (s->bed.shift - s->own.shift) / own[0] : 0.0;
    if (fabs(sheared - round(sheared)) > SAME) {
        return cli_fail(CLAST_E_GEOMETRY,
                        "--bed: its images above lie %s along x, those of the run %s (the seventh "
                        "number); leave out --bed",
                        cli_quantity(s->bed.shift, unit_of(s)),
                        cli_quantity(s->own.shift, unit_of(s)));
    }
    CLI_GUARD(
        clast_bed_beyond_measure(&s->bed, &s->assembly, &none, wanted->options.method, &covered));
    const double share = covered.solid / clast_assembly_volume(&s->assembly);
    return share <= MOST_BEYOND
               ? CLAST_OK
               : cli_fail(CLAST_E_GEOMETRY,
                          "--bed: its images lie on %d of %d grains, which share %.3g %% of the "
                          "solid: its period is not theirs; give what holds the grains, or "
                          "measure a part of the packing (box, with --pores)",
                          covered.n, s->assembly.n_grain, 100.0 * share);
}

/// Nor is one that grains reach out of, whose solid counts whole.
static clast_status refuse_sides(const cli_porosity_bed *s, const cli_porosity_findings *f)
{
    return cli_fail(CLAST_E_GEOMETRY,
                    "--bed: %d of %d grains reach beyond its sides, by up to %s, with %.3g %% of "
                    "the solid that would count as inside; give what holds the grains (--core "
                    "leaves out what is near its walls), or --pores for the porosity of this "
                    "part of the packing",
                    f->beyond.n, s->assembly.n_grain, cli_quantity(f->beyond.depth, unit_of(s)),
                    100.0 * f->beyond.solid / f->bulk.solid);
}

static clast_status measure_bulk(const cli_porosity_bed *s, const clast_porosity_options *options,
                                 bool has_sides, cli_porosity_findings *f)
{
    clast_table_free(&f->profile);
    f->beyond.n = -1;
    CLI_GUARD(clast_porosity_profile(&s->assembly, &s->bed, options, &f->profile));
    CLI_GUARD(clast_porosity_measure(&s->assembly, &s->bed, &f->profile, options, &f->bulk));
    return has_sides ? clast_bed_beyond_measure(&s->bed, &s->assembly, &f->bulk, options->method,
                                                &f->beyond)
                     : CLAST_OK;
}

/// Profile and bulk: of the bed, or with pores of a part of the packing.
static clast_status measure_slices(cli_porosity_bed *s, const cli_porosity_wanted *wanted,
                                   cli_porosity_findings *f)
{
    const clast_porosity_options *options = &wanted->options;
    double period[3];
    const bool has_sides = wanted->is_given && !clast_bed_period(&s->bed, period);
    CLI_GUARD(check_images(s, wanted));
    clast_bed_wrap(&s->bed, &s->assembly);
    CLI_GUARD(measure_bulk(s, options, has_sides, f));
    const bool is_within = !has_sides || f->beyond.solid <= MOST_BEYOND * f->bulk.solid;
    if (!is_within && wanted->pores > 0) {
        s->bed.is_part = true;
        f->is_part = true;
        CLI_GUARD(measure_bulk(s, options, has_sides, f));
    }
    CLI_GUARD(check_room(s, &f->bulk));
    if (!is_within && !f->is_part) {
        return refuse_sides(s, f);
    }
    const double z[2] = {f->bulk.z_low, f->bulk.z_high};
    f->outside = NAN;
    return has_sides && s->has_own ? clast_bed_outside(&s->bed, &s->own, z, &f->outside) : CLAST_OK;
}

clast_status cli_porosity_measure(cli_porosity_bed *s, const cli_porosity_wanted *wanted,
                                  cli_porosity_findings *f)
{
    clast_assembly *assembly = &s->assembly;
    const clast_bed *bed = &s->bed;
    const clast_porosity_options *options = &wanted->options;
    f->method = options->method;
    f->cut = options->cut;
    f->core_depth = wanted->core;
    f->report = s->report;
    if (wanted->chains && s->contacts.n_column == 0) {
        return cli_fail(CLAST_E_USAGE, "force chains (--chains) are of runs of clast pack, which "
                                       "know their contact forces; this bed knows none");
    }
    CLI_GUARD(measure_slices(s, wanted, f));
    f->walls = clast_bed_side_walls(bed, assembly);
    if (wanted->core > 0.0) {
        CLI_GUARD(
            clast_porosity_core_measure(assembly, bed, &f->bulk, wanted->core, options, &f->core));
    }
    CLI_GUARD(measure_contacts(s, wanted->gap, f));
    if (wanted->local) {
        CLI_GUARD(clast_porosity_local(assembly, bed, bed->floor, f->bulk.top, &f->local));
    }
    const double z[2] = {f->bulk.z_low, f->bulk.z_high};
    if (wanted->rings > 0) {
        const clast_radial_options rings = {options->method, wanted->rings, 0};
        CLI_GUARD(clast_porosity_radial(assembly, bed, z, &rings, &f->radial));
    }
    if (wanted->pores > 0) {
        clast_pore_options pores = {.n_point = wanted->pores, .n_bin = PORE_BINS};
        (void)clast_bed_period(bed, pores.period);
        CLI_GUARD(clast_pores_measure(assembly, bed, z, &pores, &f->pores));
    }
    if (s->contacts.n_row > 0 && !bed->is_part) {
        CLI_GUARD(clast_stress(&s->contacts, bed, z, &f->stress));
        CLI_GUARD(clast_stress_profile(&s->contacts, bed, &f->profile, &f->stress_profile));
    }
    return measure_forces(s, wanted, f);
}
