// What clast porosity measures of one bed.
#include "porosity_measure.h"

#include "quantity.h"
#include <math.h>
#include <string.h>

enum { PORE_BINS = 50 };

static const double MOST_BEYOND = 0.01; ///< of the solid that counts

void cli_porosity_bed_free(cli_porosity_bed *s)
{
    clast_assembly_free(&s->assembly);
    clast_mesh_free(&s->surface);
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
    if (wanted->chains && !has_forces) {
        return cli_fail(CLAST_E_USAGE, "force chains (--chains) are of runs of clast pack, which "
                                       "know their contact forces; this bed knows none");
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
    if (s->contacts.n_column == 0 && bed->shift != 0.0) {
        return cli_fail(CLAST_E_USAGE,
                        "--bed: contacts across the borders of a sheared box are those of runs of "
                        "clast pack, which know them; this bed knows none");
    }
    if (s->contacts.n_column == 0) {
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
    return clast_fabric(assembly, s->contacts.n_column > 0 ? &s->contacts : NULL,
                        is_periodic ? period.length : NULL, &f->fabric);
}

/// A bed that holds more solid than room is not the one that the grains lie in.
static clast_status check_bed(const clast_porosity_bulk *bulk)
{
    return bulk->porosity >= -1e-2 ? CLAST_OK
                                   : cli_fail(CLAST_E_GEOMETRY,
                                              "grains take %.4g times the room of this bed between "
                                              "z = %g and %g: it is smaller than what holds them, "
                                              "or in another unit (--bed)",
                                              1.0 - bulk->porosity, bulk->z_low, bulk->z_high);
}

/// Nor is one that grains reach out of, whose solid counts whole: points know better.
static clast_status check_sides(const cli_porosity_bed *s, const cli_porosity_wanted *wanted,
                                cli_porosity_findings *f)
{
    const char *unit = strcmp(s->assembly.unit, "model") == 0 ? "model units" : s->assembly.unit;
    double period[3];
    f->beyond.n = -1;
    if (!wanted->is_given || clast_bed_period(&s->bed, period)) {
        return CLAST_OK;
    }
    CLI_GUARD(clast_bed_beyond_measure(&s->bed, &s->assembly, &f->bulk, wanted->options.method,
                                       &f->beyond));
    return f->beyond.solid <= MOST_BEYOND * f->bulk.solid || wanted->pores > 0
               ? CLAST_OK
               : cli_fail(
                     CLAST_E_GEOMETRY,
                     "--bed: %d of %d grains reach beyond its sides, by up to %s, with %.3g %% of "
                     "the solid that would count as inside; give what holds the grains (--core "
                     "leaves out what is near its walls), or --pores for the porosity of this "
                     "bed by points",
                     f->beyond.n, s->assembly.n_grain, cli_quantity(f->beyond.depth, unit),
                     100.0 * f->beyond.solid / f->bulk.solid);
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
    clast_bed_wrap(bed, assembly);
    CLI_GUARD(clast_porosity_profile(assembly, bed, options, &f->profile));
    CLI_GUARD(clast_porosity_measure(assembly, bed, &f->profile, options, &f->bulk));
    CLI_GUARD(check_bed(&f->bulk));
    CLI_GUARD(check_sides(s, wanted, f));
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
    if (s->contacts.n_row > 0) {
        CLI_GUARD(clast_stress(&s->contacts, bed, z, &f->stress));
        CLI_GUARD(clast_stress_profile(&s->contacts, bed, &f->profile, &f->stress_profile));
    }
    return measure_forces(s, wanted, f);
}
