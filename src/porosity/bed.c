// The container that a porosity refers to.
#include <clast/porosity.h>

#include "assembly/whole.h"
#include "base/number.h"
#include "base/status.h"
#include "porosity/whole.h"
#include <clast/assembly.h>
#include <clast/field.h>
#include <clast/mesh.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/// Comma-separated lengths; returns how many, -1 when one is wrong or there are too many.
static int lengths(const char *text, int most, double *out)
{
    int n = 0;
    while (true) {
        char one[64];
        const size_t length = strcspn(text, ",");
        if (n >= most || length >= sizeof one) {
            return -1;
        }
        memcpy(one, text, length);
        one[length] = '\0';
        if (clast_unit_parse(one, "m", &out[n]) != CLAST_OK || !isfinite(out[n])) {
            return -1;
        }
        ++n;
        if (text[length] == '\0') {
            return n;
        }
        text += length + 1;
    }
}

clast_status clast_bed_parse(const char *text, clast_bed *bed)
{
    CLX_ARGUMENTS(text, bed);
    clast_status status = CLAST_OK;
    clast_bed made = {0};
    double number[7] = {0};
    const char *colon = strchr(text, ':');
    const int n = colon != NULL ? lengths(colon + 1, 7, number) : -1;
    const size_t word = colon != NULL ? (size_t)(colon - text) : 0;
    if (word == 8 && strncmp(text, "cylinder", word) == 0 && (n == 1 || n == 3)) {
        made.kind = CLAST_BED_CYLINDER;
        made.radius = number[0];
        made.centre[0] = n == 3 ? number[1] : 0.0;
        made.centre[1] = n == 3 ? number[2] : 0.0;
    } else if (strcmp(text, "mesh") == 0) { // its surface is kept beside
        made.kind = CLAST_BED_MESH;
        *bed = made;
        return CLAST_OK;
    } else {
        const bool is_box = word == 3 && strncmp(text, "box", word) == 0;
        const bool is_periodic = word == 8 && strncmp(text, "periodic", word) == 0;
        CLX_CHECK(
            ((is_box || is_periodic) && n == 4) || (is_periodic && n >= 6), CLAST_E_CONFIG,
            "bed takes cylinder:RADIUS[,X,Y], box:X0,Y0,X1,Y1, periodic:X0,Y0,X1,Y1, in "
            "all three directions, periodic:X0,Y0,Z0,X1,Y1,Z1[,SHIFT], or mesh:FILE,UNIT, not '%s'",
            text);
        made.kind = is_box ? CLAST_BED_BOX : n >= 6 ? CLAST_BED_PERIODIC_3D : CLAST_BED_PERIODIC;
        for (int k = 0; k < 2; ++k) {
            made.low[k] = number[k];
            made.high[k] = number[k + (n == 4 ? 2 : 3)];
        }
        made.floor = n >= 6 ? number[2] : 0.0;
        made.ceiling = n >= 6 ? number[5] : 0.0;
        made.shift = number[6];
        CLX_CHECK(n == 4 || made.ceiling > made.floor, CLAST_E_CONFIG, "bed '%s' has no height",
                  text);
        CLX_CHECK(n < 7 || fabs(made.shift) <= made.high[0] - made.low[0], CLAST_E_CONFIG,
                  "bed '%s' is sheared by more than its width", text);
    }
    CLX_CHECK(clast_bed_area(&made) > 0.0, CLAST_E_CONFIG, "bed '%s' has no area", text);
    *bed = made;
done:
    return status;
}

int clast_bed_format(const clast_bed *bed, size_t size, char *text)
{
    if (clx_bed_fault(bed) != NULL || text == NULL) {
        return -1;
    }
    int n = 0;
    if (bed->kind == CLAST_BED_CYLINDER) {
        n = clx_number_print(text, size, "cylinder:%.17g,%.17g,%.17g", bed->radius, bed->centre[0],
                             bed->centre[1]);
    } else if (bed->kind == CLAST_BED_MESH) {
        n = snprintf(text, size, "mesh");
    } else if (bed->kind == CLAST_BED_PERIODIC_3D) {
        n = clx_number_print(text, size, "periodic:%.17g,%.17g,%.17g,%.17g,%.17g,%.17g",
                             bed->low[0], bed->low[1], bed->floor, bed->high[0], bed->high[1],
                             bed->ceiling);
        if (bed->shift != 0.0 && n >= 0 && (size_t)n < size) {
            n += clx_number_print(text + n, size - (size_t)n, ",%.17g", bed->shift);
        }
    } else {
        n = clx_number_print(text, size, "%s:%.17g,%.17g,%.17g,%.17g",
                             bed->kind == CLAST_BED_BOX ? "box" : "periodic", bed->low[0],
                             bed->low[1], bed->high[0], bed->high[1]);
    }
    return n >= 0 && (size_t)n < size ? n : -1;
}

bool clast_bed_period(const clast_bed *bed, double period[3])
{
    if (clx_bed_fault(bed) != NULL || period == NULL) {
        return false;
    }
    const bool is_3d = bed->kind == CLAST_BED_PERIODIC_3D;
    const bool is_periodic = is_3d || bed->kind == CLAST_BED_PERIODIC;
    period[0] = is_periodic ? bed->high[0] - bed->low[0] : 0.0;
    period[1] = is_periodic ? bed->high[1] - bed->low[1] : 0.0;
    period[2] = is_3d ? bed->ceiling - bed->floor : 0.0;
    return is_periodic;
}

void clast_bed_wrap(const clast_bed *bed, clast_assembly *assembly)
{
    if (clx_bed_fault(bed) != NULL || clx_assembly_fault(assembly) != NULL) {
        return;
    }
    const double low[3] = {bed->low[0], bed->low[1], bed->floor};
    double period[3] = {0};
    (void)clast_bed_period(bed, period);
    for (int k = 2; k >= 0; --k) { // z first: it moves a sheared bed's grains along x
        for (int32_t i = 0; i < assembly->n_grain && period[k] > 0.0; ++i) {
            double *x = &assembly->position[i][k];
            const double image = floor((*x - low[k]) / period[k]);
            *x = fmin(*x - period[k] * image, low[k] + period[k]);
            assembly->position[i][0] -= k == 2 ? image * bed->shift : 0.0;
        }
    }
}

double clast_bed_area(const clast_bed *bed)
{
    if (clx_bed_fault(bed) != NULL) {
        return (double)NAN;
    }
    if (bed->kind == CLAST_BED_CYLINDER) {
        return bed->radius > 0.0 ? CLAST_PI * bed->radius * bed->radius : 0.0;
    }
    if (bed->kind == CLAST_BED_MESH) {
        double low[3];
        double high[3];
        clast_mesh_bounds(bed->surface, low, high);
        return high[2] > low[2] ? clast_mesh_volume(bed->surface) / (high[2] - low[2]) : 0.0;
    }
    const double x = bed->high[0] - bed->low[0];
    const double y = bed->high[1] - bed->low[1];
    return x > 0.0 && y > 0.0 ? x * y : 0.0;
}

clast_status clast_bed_table(const clast_bed *bed, clast_table *table)
{
    CLX_ARGUMENTS(bed, table);
    CLX_WHOLE(bed, bed);
    clast_status status = CLAST_OK;
    clast_table made = {0};
    char text[256];
    double *floor_m = NULL;
    CLX_CHECK(clast_bed_format(bed, sizeof text, text) > 0, CLAST_E_LIMIT,
              "the bed's text is too long");
    CLX_TRY(clast_table_init(&made, "bed", 1));
    CLX_TRY(clast_table_add_text(&made, "bed"));
    CLX_TRY(clast_table_set_text(&made, 0, 0, text));
    CLX_TRY(clast_table_add_number(&made, "floor_m", "m", &floor_m));
    floor_m[0] = bed->floor;
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

clast_status clast_bed_from_table(const clast_table *table, clast_bed *bed)
{
    CLX_ARGUMENTS(table, bed);
    CLX_WHOLE(table, table);
    clast_status status = CLAST_OK;
    clast_bed made;
    const int32_t text = clast_table_find(table, "bed");
    const double *floor_m = clast_table_numbers(table, "floor_m");
    CLX_CHECK(table->n_row == 1 && text >= 0 && table->column[text].text != NULL &&
                  floor_m != NULL && isfinite(floor_m[0]),
              CLAST_E_FORMAT, "table '%s' describes no bed", table->name);
    CLX_TRY(clast_bed_parse(table->column[text].text[0], &made));
    made.floor = floor_m[0];
    *bed = made;
done:
    return status;
}
