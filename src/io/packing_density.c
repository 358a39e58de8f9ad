// Densities of grains that another program placed: what its columns say, in SI.
#include "io/packing.h"

#include "base/column_unit.h"
#include "base/status.h"
#include <clast/assembly.h>
#include <clast/field.h>
#include <clast/shape.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/// [LAMMPS manual, command units]; Avogadro's number in g/mol, Bohr's radius and the atomic mass
/// are CODATA's of 2018, "electron" has no density; its time is LAMMPS's, 1.03275e-15 s.
static const clx_lammps_units known[] = {
    {"si", "m", 1.0, 1.0, 1.0, 1.0},
    {"cgs", "cm", 1e-2, 1e-3, 1e3, 1e-2},
    {"micro", "um", 1e-6, 1e-15, 1e3, 1.0},
    {"nano", "nm", 1e-9, 1e-21, 1e6, 1.0},
    {"real", "Angstrom", 1e-10, 1e-3 / 6.02214076e23, 1e3, 1e5},
    {"metal", "Angstrom", 1e-10, 1e-3 / 6.02214076e23, 1e3, 1e2},
    {"electron", "Bohr", 5.29177210903e-11, 1.66053906660e-27, 1.0,
     5.29177210903e-11 / 1.03275e-15},
};

const clx_lammps_units *clx_lammps_units_of(const char *word)
{
    for (size_t k = 0; k < sizeof known / sizeof known[0]; ++k) {
        if (strcmp(word, known[k].word) == 0) {
            return &known[k];
        }
    }
    return NULL;
}

/// A column that tells densities, or masses, and its SI factor.
typedef struct {
    const clast_column *column;
    double factor;
    bool is_mass;
} source;

/// Place of the first of two names in a list such as "x,y,z,d,density"; -1: none.
static int32_t place_in(const char *list, const char *one, const char *other)
{
    int32_t place = 0;
    for (const char *at = list; *at != '\0'; ++place) {
        const size_t length = strcspn(at, ",");
        if ((strlen(one) == length && strncasecmp(at, one, length) == 0) ||
            (strlen(other) == length && strncasecmp(at, other, length) == 0)) {
            return place;
        }
        at += length + (at[length] == ',');
    }
    return -1;
}

/// A column of numbers under one of these names, "density (g/cm3)" and "density_g/cm3" among them.
static const clast_column *find_column(const clast_table *table, const char *list, const char *one,
                                       const char *other, const char *si_unit)
{
    if (list != NULL && list[0] != '\0') {
        const int32_t at = place_in(list, one, other);
        return at >= 0 && at < table->n_column ? &table->column[at] : NULL;
    }
    for (int32_t c = 0; c < table->n_column; ++c) {
        const char *name = table->column[c].name;
        if (clx_column_is(name, one, si_unit) || clx_column_is(name, other, si_unit)) {
            return &table->column[c];
        }
    }
    return NULL;
}

/// SI units in that of a column; `bare` where it says none.
static clast_status find_factor(const clast_column *column, const char *si_unit, double bare,
                                double *factor)
{
    clast_status status = CLAST_OK;
    char unit[CLX_COLUMN_UNIT];
    CLX_CHECK(column->number != NULL, CLAST_E_FORMAT, "column %s holds texts", column->name);
    CLX_TRY(clx_column_factor(column, si_unit, unit, factor));
    *factor = *factor > 0.0 ? *factor : bare;
done:
    return status == CLAST_E_CONFIG ? CLAST_E_FORMAT : status;
}

/// What a table of any program tells.
static clast_status find_in_table(const clast_table *table, const clx_packing_wanted *wanted,
                                  source *from)
{
    clast_status status = CLAST_OK;
    const char *list = wanted->spheres.options.columns;
    from->column = find_column(table, list, "density", "rho", "kg/m^3");
    if (from->column != NULL) {
        return find_factor(from->column, "kg/m^3", 1.0, &from->factor);
    }
    from->column = find_column(table, list, "mass", "mass", "kg");
    from->is_mass = true;
    if (from->column != NULL) {
        CLX_TRY(find_factor(from->column, "kg", 0.0, &from->factor));
    }
done:
    return status;
}

/// What a dump or data file tells.
static void find_in_lammps(const clast_table *table, const clx_lammps_units *units, source *from)
{
    const int32_t density = clast_table_find(table, "density");
    const int32_t mass = units != NULL ? clast_table_find(table, "mass") : -1;
    if (density >= 0) {
        *from = (source){&table->column[density], units != NULL ? units->kg_per_m3 : 1.0, false};
    } else if (mass >= 0) {
        *from = (source){&table->column[mass], units->kilogram, true};
    }
}

clast_status clx_packing_densities(const clast_table *table, const clx_packing_wanted *wanted,
                                   bool is_lammps, const clx_lammps_units *units, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    source from = {NULL, 1.0, false};
    if (is_lammps) {
        find_in_lammps(table, units, &from);
    } else if (!wanted->is_old) {
        CLX_TRY(find_in_table(table, wanted, &from));
    }
    const bool is_known = from.column != NULL && from.column->number != NULL && from.factor > 0.0 &&
                          (!from.is_mass || strcmp(a->unit, "m") == 0);
    a->no_density = !is_known;
    for (int32_t i = 0; is_known && i < a->n_grain; ++i) {
        const double size = a->scale[i];
        const double volume = size * size * size * a->shape[a->shape_id[i]].volume;
        const double told = from.column->number[i];
        a->density[i] = from.factor * told / (from.is_mass ? volume : 1.0);
        CLX_CHECK(a->density[i] > 0.0 && isfinite(a->density[i]), CLAST_E_FORMAT, "row %d: %s %g",
                  i + 1, from.is_mass ? "mass" : "density", told);
    }
done:
    return status;
}
