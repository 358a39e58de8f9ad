// All that is measured of one bed, and which beds are not what holds the grains.
#include <clast/porosity.h>

#include "assembly/whole.h"
#include "base/status.h"
#include "porosity/whole.h"
#include <clast/assembly.h>
#include <math.h>
#include <string.h>

enum { PORE_BINS = 50 };

static const double MOST_BEYOND = 0.01; ///< of the solid that counts
static const double LEAST = -1e-2;      ///< porosity: overlaps of grains count twice
static const double SAME = 1e-3;        ///< share by which a given period may differ
static const double LAYER = 0.1; ///< of the grains' mean diameter, where it has no unit or is small

typedef struct {
    clast_assembly *assembly;
    const clast_bed_known *known;
    const clast_table *contacts; ///< NULL where they are not known
    clast_bed_findings *f;       ///< its bed and options are those that are measured
} measurement;

void clast_bed_findings_free(clast_bed_findings *f)
{
    if (f == NULL) {
        return;
    }
    clast_table *const tables[] = {&f->profile, &f->coordination, &f->fabric,
                                   &f->local,   &f->radial,       &f->stress,
                                   &f->fields,  &f->chains,       &f->stress_profile};
    for (size_t k = 0; k < sizeof tables / sizeof tables[0]; ++k) {
        clast_table_free(tables[k]);
    }
    clast_pores_free(&f->pores);
}

/// The table, or NULL where it has no columns.
static const clast_table *filled(const clast_table *table)
{
    return table != NULL && table->n_column > 0 ? table : NULL;
}

static const char *length(const measurement *m, double value)
{
    const char *unit = m->assembly->unit;
    return clx_unit_text(value, strcmp(unit, "model") == 0 ? "model units" : unit);
}

/// What cannot be measured of this bed is refused before the work.
static clast_status check_options(const measurement *m)
{
    clast_status status = CLAST_OK;
    const clast_bed_options *o = &m->f->options;
    const clast_bed *bed = &m->f->bed;
    const bool has_floor = bed->kind == CLAST_BED_MESH || bed->kind == CLAST_BED_PERIODIC_3D;
    CLX_CHECK(isfinite(o->floor) && isfinite(o->gap) && isfinite(o->core) && isfinite(o->fields) &&
                  fmin(fmin(o->gap, o->core), o->fields) >= 0.0 && o->rings >= 0 && o->pores >= 0,
              CLAST_E_ARGUMENT,
              "porosity: a floor of %g, gap of %g, core of %g, fields of %g, %d rings, %lld pores; "
              "all must be finite, and not negative but for the floor",
              o->floor, o->gap, o->core, o->fields, o->rings, (long long)o->pores);
    CLX_CHECK(!(o->gap > 0.0) || m->contacts == NULL, CLAST_E_USAGE,
              "--gap: this is a run, which knows its contacts: leave out --gap");
    CLX_CHECK(!(o->gap > 0.0) || bed->shift == 0.0, CLAST_E_USAGE,
              "--bed: contacts across the borders of a sheared box are those of runs of clast "
              "pack, which know them; this bed knows none: leave out --gap");
    CLX_CHECK(o->floor == 0.0 || !m->known->is_own, CLAST_E_USAGE,
              "--floor: a run knows its bed and its floor: leave out --floor, or give --bed too");
    CLX_CHECK(o->floor == 0.0 || !has_floor, CLAST_E_USAGE,
              "--floor: this bed has a bottom of its own: leave out --floor");
    CLX_CHECK(!o->chains || m->contacts != NULL, CLAST_E_USAGE,
              "--chains: force chains are of runs of clast pack, which know their contact forces; "
              "this bed knows none");
done:
    return status;
}

/// A bed that holds more solid than its volume is not the one that the grains lie in.
static clast_status check_volume(const measurement *m)
{
    const clast_porosity_bulk *bulk = &m->f->bulk;
    return bulk->porosity >= LEAST
               ? CLAST_OK
               : clx_fail(CLAST_E_GEOMETRY,
                          "--bed: grains take %.4g times the volume of this bed between z = %s and "
                          "%s: it is smaller than what holds them (--pores measures a part of a "
                          "packing), or in another unit",
                          1.0 - bulk->porosity, length(m, bulk->z_low), length(m, bulk->z_high));
}

/// Nor is a periodic bed whose images do not lie where the run's own do,
static clast_status check_period(const measurement *m, const double period[3])
{
    clast_status status = CLAST_OK;
    double own[3] = {0};
    if (m->known->own == NULL || !clast_bed_period(m->known->own, own)) {
        return CLAST_OK;
    }
    for (int k = 0; k < 3; ++k) {
        CLX_CHECK(!(own[k] > 0.0 && period[k] > 0.0 && fabs(period[k] - own[k]) > SAME * own[k]),
                  CLAST_E_GEOMETRY,
                  "--bed: a period of %s along %c, where the run repeats after %s; leave out "
                  "--bed, or measure a part of the packing (box, with --pores)",
                  length(m, period[k]), 'x' + k, length(m, own[k]));
    }
    const double shift[2] = {m->f->bed.shift, m->known->own->shift};
    const double sheared = own[2] > 0.0 && period[2] > 0.0 ? (shift[0] - shift[1]) / own[0] : 0.0;
    CLX_CHECK(fabs(sheared - round(sheared)) <= SAME, CLAST_E_GEOMETRY,
              "--bed: its images above lie %s along x, those of the run %s (the seventh number); "
              "leave out --bed",
              length(m, shift[0]), length(m, shift[1]));
done:
    return status;
}

/// or on the grains.
static clast_status check_images(const measurement *m)
{
    clast_status status = CLAST_OK;
    const clast_assembly *assembly = m->assembly;
    const clast_porosity_bulk none = {0};
    clast_bed_beyond covered;
    double period[3];
    if (m->known->is_own || assembly->n_grain == 0 || !clast_bed_period(&m->f->bed, period)) {
        return CLAST_OK;
    }
    CLX_TRY(check_period(m, period));
    CLX_TRY(clast_bed_beyond_measure(&m->f->bed, assembly, &none, m->f->options.porosity.method,
                                     &covered));
    const double share = covered.solid / clast_assembly_volume(assembly);
    CLX_CHECK(share <= MOST_BEYOND, CLAST_E_GEOMETRY,
              "--bed: its images lie on %d of %d grains, which share %.3g %% of the solid: its "
              "period is not theirs; give what holds the grains, or measure a part of the packing "
              "(box, with --pores)",
              covered.n, assembly->n_grain, 100.0 * share);
done:
    return status;
}

static clast_status measure_bulk(const measurement *m, bool has_sides)
{
    clast_bed_findings *f = m->f;
    const clast_porosity_options *options = &f->options.porosity;
    clast_table_free(&f->profile);
    CLX_GUARD(clast_porosity_profile(m->assembly, &f->bed, options, &f->profile));
    CLX_GUARD(clast_porosity_measure(m->assembly, &f->bed, &f->profile, options, &f->bulk));
    return has_sides ? clast_bed_beyond_measure(&f->bed, m->assembly, &f->bulk, options->method,
                                                &f->beyond)
                     : CLAST_OK;
}

/// Profile and bulk: of the bed, or with pores of a part of the packing.
static clast_status measure_slices(const measurement *m)
{
    clast_status status = CLAST_OK;
    clast_bed_findings *f = m->f;
    double period[3];
    const bool has_sides = !m->known->is_own && !clast_bed_period(&f->bed, period);
    CLX_TRY(check_images(m));
    clast_bed_wrap(&f->bed, m->assembly);
    CLX_TRY(measure_bulk(m, has_sides));
    const bool is_within = !has_sides || f->beyond.solid <= MOST_BEYOND * f->bulk.solid;
    if (!is_within && f->options.pores > 0) {
        f->bed.is_part = true;
        CLX_TRY(measure_bulk(m, has_sides));
    }
    CLX_TRY(check_volume(m));
    CLX_CHECK(is_within || f->bed.is_part, CLAST_E_GEOMETRY,
              "--bed: %d of %d grains reach beyond its sides, by up to %s, with %.3g %% of the "
              "solid that would count as inside; give what holds the grains (--core leaves out "
              "what is near its walls), or --pores for the porosity of this part of the packing",
              f->beyond.n, m->assembly->n_grain, length(m, f->beyond.depth),
              100.0 * f->beyond.solid / f->bulk.solid);
    if (has_sides && m->known->own != NULL) {
        const double z[2] = {f->bulk.z_low, f->bulk.z_high};
        CLX_TRY(clast_bed_outside(&f->bed, m->known->own, z, &f->outside));
    }
done:
    return status;
}

/// Contacts, directions and overlaps. The contacts of a run of clast pack overlap by what their
/// forces need, which that run tells: they are not searched for anew.
static clast_status measure_contacts(const measurement *m)
{
    clast_assembly *assembly = m->assembly;
    clast_bed_findings *f = m->f;
    clast_period box = {.low = {f->bed.low[0], f->bed.low[1], f->bed.floor}};
    const clast_period *period = clast_bed_period(&f->bed, box.length) ? &box : NULL;
    f->knows_contacts = m->contacts != NULL;
    if (!f->knows_contacts && f->bed.shift == 0.0) {
        clast_overlaps found;
        CLX_GUARD(clast_assembly_overlaps(assembly, period, &found));
        f->n_overlap = found.n;
        f->max_overlap = found.depth;
        f->max_overlap_share = found.share;
    }
    if (f->options.gap > 0.0) {
        CLX_GUARD(clast_assembly_find_contacts_periodic(assembly, f->options.gap, period));
    }
    if (assembly->contact != NULL) {
        f->mean_coordination = 2.0 * assembly->n_contact / assembly->n_grain;
        CLX_GUARD(clast_assembly_coordination(assembly, &f->coordination));
    }
    return clast_fabric(assembly, m->contacts, period != NULL ? box.length : NULL, &f->fabric);
}

/// What is asked for beside them, and the stress of a run that knows its forces.
static clast_status measure_more(const measurement *m)
{
    clast_bed_findings *f = m->f;
    const clast_bed_options *options = &f->options;
    const clast_bed *bed = &f->bed;
    const double z[2] = {f->bulk.z_low, f->bulk.z_high};
    if (options->local) {
        CLX_GUARD(clast_porosity_local(m->assembly, bed, bed->floor, f->bulk.top, &f->local));
    }
    if (options->rings > 0) {
        const clast_radial_options rings = {options->porosity.method, options->rings, 0};
        CLX_GUARD(clast_porosity_radial(m->assembly, bed, z, &rings, &f->radial));
    }
    if (options->pores > 0) {
        clast_pore_options pores = {.n_point = options->pores, .n_bin = PORE_BINS};
        (void)clast_bed_period(bed, pores.period);
        CLX_GUARD(clast_pores_measure(m->assembly, bed, z, &pores, &f->pores));
    }
    if (m->contacts != NULL && m->contacts->n_row > 0 && !bed->is_part) {
        CLX_GUARD(clast_stress(m->contacts, bed, z, &f->stress));
        CLX_GUARD(clast_stress_profile(m->contacts, bed, &f->profile, &f->stress_profile));
    }
    if (options->fields > 0.0) {
        CLX_GUARD(clast_bed_fields(bed, m->assembly, m->contacts, filled(m->known->velocities),
                                   options->fields, &f->fields));
    }
    return options->chains ? clast_bed_chains(bed, m->assembly, m->contacts, &f->chains) : CLAST_OK;
}

/// Height of a slice where none is given: as published, or for finer grains a tenth of one.
static double usual_layer(const clast_assembly *assembly)
{
    const double published = clast_porosity_options_default().layer;
    if (assembly->n_grain == 0) {
        return published;
    }
    const double mean = clast_assembly_volume(assembly) / assembly->n_grain;
    const double diameter = cbrt(6.0 / CLAST_PI * mean);
    const bool is_coarse = strcmp(assembly->unit, "m") == 0 && diameter >= published;
    return is_coarse ? published : LAYER * diameter;
}

clast_status clast_bed_measure(clast_assembly *assembly, const clast_bed_known *known,
                               const clast_bed_options *options, clast_bed_findings *findings)
{
    CLX_ARGUMENTS(assembly, known, options, findings);
    CLX_WHOLE(assembly, assembly);
    CLX_WHOLE(bed, known->bed);
    clast_status status = CLAST_OK;
    clast_bed_findings made = {.bed = *known->bed,
                               .options = *options,
                               .beyond = {-1, NAN, NAN},
                               .outside = NAN,
                               .core = {NAN, NAN, NAN, NAN},
                               .mean_coordination = NAN,
                               .n_overlap = -1,
                               .max_overlap = NAN,
                               .max_overlap_share = NAN};
    const measurement m = {assembly, known, filled(known->contacts), &made};
    clast_porosity_options *slices = &made.options.porosity;
    CLX_TRY(check_options(&m));
    made.bed.floor = options->floor != 0.0 ? options->floor : made.bed.floor;
    slices->layer = slices->layer == 0.0 ? usual_layer(assembly) : slices->layer;
    CLX_TRY(measure_slices(&m));
    made.walls = clast_bed_side_walls(&made.bed, assembly);
    if (options->core > 0.0) {
        CLX_TRY(clast_porosity_core_measure(assembly, &made.bed, &made.bulk, options->core, slices,
                                            &made.core));
    }
    CLX_TRY(measure_contacts(&m));
    CLX_TRY(measure_more(&m));
    *findings = made;
    made = (clast_bed_findings){0};
done:
    clast_bed_findings_free(&made);
    return status;
}
