// Tables of grains: rows to grains, and grains to one table.
#include "io/grains_file.h"

#include "base/alloc.h"
#include "shape/form_set.h"
#include <clast/field.h>
#include <clast/form.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/// A row's L, I, S follow from its size; where that is not there, its form alone is known.
static clast_status note_sizes(clx_grains_task *task, const clast_form_set *set)
{
    char text[128];
    int64_t n = 0;
    int64_t first = 0;
    for (int64_t i = set->n - 1; i >= 0; --i) {
        n += isnan(set->size[i]);
        first = isnan(set->size[i]) ? set->row[i] + 1 : first;
    }
    if (n == 0) {
        return CLAST_OK;
    }
    (void)snprintf(text, sizeof text,
                   "%lld of %lld sizes left out: missing, infinite or not positive (first: row "
                   "%lld)",
                   (long long)n, (long long)set->n, (long long)first);
    return clx_grains_note(task, text);
}

clast_status clx_grains_of_table(clx_grains_task *task, const clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_form_set set = {0};
    char text[512];
    CLX_TRY(clast_form_set_of(table, task->options->columns, &set));
    double unit = 0.0;
    if (set.is_sieve_size && set.size_unit[0] != '\0') {
        CLX_TRY(clast_unit_factor(set.size_unit, "m", &unit));
    }
    bool mixes_units = false;
    CLX_TRY(clx_form_set_mixes_units(table, task->options->columns, &mixes_units));
    for (int64_t i = 0; i < set.n; ++i) {
        clast_grain_record *record = NULL;
        (void)snprintf(text, sizeof text, ":%lld", (long long)set.row[i] + 1);
        CLX_TRY(clx_grains_add(task, text, &record));
        record->kind = CLAST_GRAINS_TABLE;
        record->has_surface = false;
        record->has_size = set.is_sieve_size && !isnan(set.size[i]);
        record->in_metres = mixes_units;
        record->mixes_units = mixes_units;
        record->unit_m = unit;
        for (int a = 0; a < CLAST_N_AXES; ++a) { // whatever they are, these are the L, I, S
            clast_form_lengths(set.flatness[i], set.elongation[i],
                               record->has_size ? set.size[i] : 1.0, record->grain.axes[a].lis);
        }
    }
    clast_form_set_complaint(&set, sizeof text, text);
    if (text[0] != '\0') {
        CLX_TRY(clx_grains_note(task, text));
    }
    if (set.is_sieve_size) {
        CLX_TRY(note_sizes(task, &set));
    }
    if (clast_form_set_count_words(&set, sizeof text, text)[0] != '\0') {
        CLX_TRY(clx_grains_note(task, text));
    }
done:
    clast_form_set_free(&set);
    return status;
}

/// Whether all lengths have a unit, the files' or the given one; which file comes first does not
/// matter.
static clast_status find_unit(const clast_grains *grains, double unit_m, bool *is_known)
{
    clast_status status = CLAST_OK;
    const clast_grain_record *none = NULL;  // says no unit
    const clast_grain_record *own = NULL;   // says one
    const clast_grain_record *other = NULL; // one that others do not share
    const clast_grain_record *against = NULL;
    for (const clast_grain_record *r = grains->record; r < grains->record + grains->n; ++r) {
        if (r->has_size && r->unit_m > 0.0) {
            own = own != NULL ? own : r;
            other = r->in_metres || r->unit_m != own->unit_m ? r : other;
            against = r->mixes_units || r->unit_m != unit_m ? r : against;
        } else if (r->has_size) {
            none = r;
        }
    }
    CLX_CHECK(unit_m > 0.0 || none == NULL || other == NULL, CLAST_E_CONFIG,
              "%s says a unit of length that others do not share, and %s says none: give that with "
              "--unit",
              other->name, none->name);
    CLX_CHECK(unit_m <= 0.0 || none != NULL || against == NULL || !against->mixes_units,
              CLAST_E_CONFIG,
              "%s says a unit of length for each column, and --unit another, %g m, that no file "
              "needs: leave out --unit",
              against->name, unit_m);
    CLX_CHECK(unit_m <= 0.0 || none != NULL || against == NULL, CLAST_E_CONFIG,
              "%s says its unit of length, %g m, and --unit another, %g m, that no file needs: "
              "leave out --unit",
              against->name, against->unit_m, unit_m);
    *is_known = unit_m > 0.0 || (own != NULL && none == NULL);
done:
    return status;
}

clast_status clast_grains_to_metres(clast_grains *grains, double unit_m, bool *in_metres)
{
    CLX_ARGUMENTS(grains, in_metres);
    CLX_ARRAY(grains->record, grains->n);
    for (int64_t i = 0; i < grains->n; ++i) {
        CLX_ARGUMENTS(grains->record[i].name);
    }
    clast_status status = CLAST_OK;
    bool is_known = false;
    CLX_CHECK(isfinite(unit_m) && unit_m >= 0.0, CLAST_E_ARGUMENT, "%s: a unit of %g m", __func__,
              unit_m);
    CLX_TRY(find_unit(grains, unit_m, &is_known));
    for (int64_t i = 0; i < grains->n && is_known; ++i) {
        clast_grain_record *record = &grains->record[i];
        if (record->has_size && !record->in_metres) {
            clast_grain_scale(&record->grain, record->unit_m > 0.0 ? record->unit_m : unit_m);
        }
        record->unit_m = 1.0;
    }
    *in_metres = is_known;
done:
    return status;
}

/// A number of the grain for the table: offset in clast_grain, power of length, name.
typedef struct {
    const char *name;
    size_t offset;
    int power;
} measure;

#define MEASURE(name, field, power)                                                                \
    {                                                                                              \
        name, offsetof(clast_grain, field), power                                                  \
    }
static const measure measures[] = {
    MEASURE("volume", volume, 3),
    MEASURE("area", area, 2),
    MEASURE("hull_volume", hull_volume, 3),
    MEASURE("hull_volume_added", hull_volume_added, 0),
    MEASURE("sphericity", sphericity, 0),
    MEASURE("convexity", convexity, 0),
    MEASURE("roundness", roundness, 0),
    MEASURE("roundness_deviation", roundness_deviation, 0),
    MEASURE("normal_roundness", normal_roundness, 0),
    MEASURE("angularity", angularity, 0),
    MEASURE("feret_max", longest, 1),
    MEASURE("feret_min", shortest, 1),
    MEASURE("projected_mean", projected_mean, 2),
    MEASURE("projected_min", projected_least, 2),
    MEASURE("projected_max", projected_greatest, 2),
    MEASURE("moment_1", moments[0], 5),
    MEASURE("moment_2", moments[1], 5),
    MEASURE("moment_3", moments[2], 5),
    MEASURE("centroid_x", centroid[0], 1),
    MEASURE("centroid_y", centroid[1], 1),
    MEASURE("centroid_z", centroid[2], 1),
    MEASURE("pore_volume", pore_volume, 3),
    MEASURE("pore_area", pore_area, 2),
};

static const char *const ending[] = {"", "_m", "_m2", "_m3", "_m4", "_m5"};
static const char *const unit[] = {"-", "m", "m^2", "m^3", "m^4", "m^5"};

static clast_status add_column(clast_table *table, const char *name, int power, bool in_metres,
                               double **number)
{
    char full[96];
    const bool has_unit = power > 0 && in_metres;
    (void)snprintf(full, sizeof full, "%s%s", name, has_unit ? ending[power] : "");
    return clast_table_add_number(table, full, has_unit ? unit[power] : "-", number);
}

static clast_status add_lengths(const clast_grains *grains, clast_axes_kind axes,
                                const char *prefix, bool in_metres, clast_table *table)
{
    static const char *const letters[3] = {"L", "I", "S"};
    clast_status status = CLAST_OK;
    for (int k = 0; k < 3; ++k) {
        char name[64];
        double *number = NULL;
        (void)snprintf(name, sizeof name, "%s%s", prefix, letters[k]);
        CLX_TRY(add_column(table, name, 1, in_metres, &number));
        for (int64_t i = 0; i < grains->n; ++i) {
            const clast_grain_record *r = &grains->record[i];
            const bool is_known = r->has_size && (r->has_surface || prefix[0] == '\0');
            number[i] = is_known ? r->grain.axes[axes].lis[k] : (double)NAN;
        }
    }
done:
    return status;
}

/// D and the features: 13 factors, 13 inverses.
static clast_status add_features(const clast_grains *grains, clast_axes_kind axes, bool in_metres,
                                 clast_table *table)
{
    clast_status status = CLAST_OK;
    double *number = NULL;
    CLX_TRY(add_column(table, "D", 1, in_metres, &number));
    for (int64_t i = 0; i < grains->n; ++i) {
        const double *lis = grains->record[i].grain.axes[axes].lis;
        number[i] =
            grains->record[i].has_size ? clast_form_sieve_size(lis[1], lis[2]) : (double)NAN;
    }
    for (int32_t f = 0; f < CLAST_N_FORM_FEATURE; ++f) {
        CLX_TRY(add_column(table, clast_form_feature_name(f), 0, in_metres, &number));
        for (int64_t i = 0; i < grains->n; ++i) {
            double value[CLAST_N_FORM_FEATURE];
            const double *lis = grains->record[i].grain.axes[axes].lis;
            clast_form_features(lis[0], lis[1], lis[2], value);
            number[i] = value[f];
        }
    }
done:
    return status;
}

static clast_status add_texts(const clast_grains *grains, clast_axes_kind axes, clast_table *table)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_table_add_text(table, "file"));
    CLX_TRY(clast_table_add_text(table, "kind"));
    CLX_TRY(clast_table_add_text(table, "zingg"));
    for (int64_t i = 0; i < grains->n; ++i) {
        const clast_grain_record *r = &grains->record[i];
        const double *lis = r->grain.axes[axes].lis;
        CLX_TRY(clast_table_set_text(table, 0, i, r->name));
        CLX_TRY(clast_table_set_text(table, 1, i, clast_grains_kind_name(r->kind)));
        CLX_TRY(clast_table_set_text(
            table, 2, i, clast_zingg_name(clast_form_zingg(lis[2] / lis[1], lis[1] / lis[0]))));
    }
done:
    return status;
}

clast_status clast_grains_table(const clast_grains *grains, clast_axes_kind axes, bool in_metres,
                                clast_table *table)
{
    CLX_ARGUMENTS(grains, table);
    CLX_ARRAY(grains->record, grains->n);
    for (int64_t i = 0; i < grains->n; ++i) {
        CLX_ARGUMENTS(grains->record[i].name);
    }
    clast_status status = CLAST_OK;
    clast_table made = {0};
    char prefix[32];
    CLX_CHECK(clast_axes_name(axes) != NULL, CLAST_E_ARGUMENT, "%s: axes %d are of no kind",
              __func__, (int)axes);
    CLX_TRY(clast_table_init(&made, "grains", grains->n));
    CLX_TRY(add_texts(grains, axes, &made));
    CLX_TRY(add_lengths(grains, axes, "", in_metres, &made));
    CLX_TRY(add_features(grains, axes, in_metres, &made));
    for (size_t m = 0; m < sizeof measures / sizeof measures[0]; ++m) {
        double *number = NULL;
        CLX_TRY(add_column(&made, measures[m].name, measures[m].power, in_metres, &number));
        for (int64_t i = 0; i < grains->n; ++i) {
            const clast_grain_record *r = &grains->record[i];
            number[i] = NAN;
            if (r->has_surface) {
                memcpy(&number[i], (const char *)&r->grain + measures[m].offset, sizeof number[i]);
            }
        }
    }
    for (int a = 0; a < CLAST_N_AXES; ++a) {
        (void)snprintf(prefix, sizeof prefix, "%s_", clast_axes_name(a));
        CLX_TRY(add_lengths(grains, (clast_axes_kind)a, prefix, in_metres, &made));
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}
