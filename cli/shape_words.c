// Output of clast shape.
#include "shape_words.h"

#include <math.h>
#include <stdio.h>

static json_t *triple(const double value[3])
{
    json_t *list = json_array();
    for (int k = 0; k < 3; ++k) {
        (void)json_array_append_new(list, isfinite(value[k]) ? json_real(value[k]) : json_null());
    }
    return list;
}

static void set_triple(json_t *object, const char *key, const double value[3])
{
    (void)json_object_set_new(object, key, triple(value));
}

/// The class by the lengths; null where they are not known.
static void set_zingg(json_t *object, const double lis[3])
{
    const clast_zingg zingg = clast_form_zingg(lis[2] / lis[1], lis[1] / lis[0]);
    if (zingg < CLAST_N_ZINGG) {
        cli_json_text(object, "zingg", clast_zingg_name(zingg));
    } else {
        (void)json_object_set_new(object, "zingg", json_null());
    }
}

/// L, I, S, or nulls.
static void set_lengths(json_t *object, const clast_grain_record *r, const double lis[3])
{
    static const char *const letters[3] = {"L", "I", "S"};
    for (int k = 0; k < 3; ++k) {
        cli_json_number(object, letters[k], r->has_size ? lis[k] : (double)NAN);
    }
}

static void set_factors(json_t *object, const double lis[3])
{
    double value[CLAST_N_FORM_FEATURE];
    json_t *inverses = json_object();
    clast_form_features(lis[0], lis[1], lis[2], value);
    for (int32_t f = 0; f < CLAST_N_FORM_FACTOR; ++f) {
        const clast_form_factor_entry *about = clast_form_factor_about(f);
        cli_json_number(object, about->name, value[f]);
        cli_json_number(inverses, about->name, value[CLAST_N_FORM_FACTOR + f]);
    }
    (void)json_object_set_new(object, "inverse", inverses);
    set_zingg(object, lis);
}

static void set_surface(json_t *object, const clast_grain_record *r)
{
    const clast_grain *g = &r->grain;
    json_t *axes = json_object();
    cli_json_number(object, "sphericity", g->sphericity);
    cli_json_number(object, "convexity", g->convexity);
    set_triple(object, "moments", g->moments);
    set_triple(object, "centroid", g->centroid);
    cli_json_number(object, "roundness", g->roundness);
    cli_json_number(object, "roundness_deviation", g->roundness_deviation);
    cli_json_count(object, "n_outline", g->n_outline);
    cli_json_number(object, "normal_roundness", g->normal_roundness);
    cli_json_number(object, "angularity", g->angularity);
    cli_json_number(object, "hull_volume", g->hull_volume);
    cli_json_number(object, "hull_area", g->hull_area);
    cli_json_number(object, "hull_volume_added", g->hull_volume_added);
    cli_json_number(object, "feret_max", g->longest);
    cli_json_number(object, "feret_min", g->shortest);
    cli_json_number(object, "projected_mean", g->projected_mean);
    cli_json_number(object, "projected_min", g->projected_least);
    cli_json_number(object, "projected_max", g->projected_greatest);
    if (r->kind == CLAST_GRAINS_SERIES) {
        cli_json_count(object, "degree", r->degree);
        cli_json_number(object, "power_last", r->power_last);
        cli_json_number(object, "power_cut", r->power_cut);
    }
    if (r->n_voxel > 0) {
        cli_json_count(object, "n_voxel", r->n_voxel);
        cli_json_bool(object, "is_smoothed", r->is_smoothed);
    }
    for (int a = 0; a < CLAST_N_AXES; ++a) {
        json_t *one = json_object();
        json_t *direction = json_array();
        set_lengths(one, r, g->axes[a].lis);
        for (int k = 0; k < 3; ++k) {
            (void)json_array_append_new(direction, triple(g->axes[a].direction[k]));
        }
        (void)json_object_set_new(one, "direction", direction);
        (void)json_object_set_new(axes, clast_axes_name(a), one);
    }
    (void)json_object_set_new(object, "by_definition", axes);
}

static json_t *grain_json(const cli_shape_result *shape, const clast_grain_record *r)
{
    json_t *object = json_object();
    const double *lis = r->grain.axes[shape->axes].lis;
    cli_json_text(object, "file", r->name);
    cli_json_text(object, "kind", clast_grains_kind_name(r->kind));
    cli_json_number(object, "volume", r->has_surface ? r->grain.volume : (double)NAN);
    cli_json_number(object, "area", r->has_surface ? r->grain.area : (double)NAN);
    cli_json_number(object, "pore_volume", r->has_surface ? r->grain.pore_volume : (double)NAN);
    cli_json_number(object, "pore_area", r->has_surface ? r->grain.pore_area : (double)NAN);
    set_lengths(object, r, lis);
    cli_json_number(object, "D", r->has_size ? clast_form_sieve_size(lis[1], lis[2]) : (double)NAN);
    set_factors(object, lis);
    if (r->has_surface) {
        set_surface(object, r);
    }
    return object;
}

static int64_t count_surfaces(const cli_shape_result *shape)
{
    int64_t n = 0;
    for (int64_t i = 0; i < shape->grains.n; ++i) {
        n += shape->grains.record[i].has_surface;
    }
    return n;
}

/// The definition behind L, I and S: rows of tables have their own.
static const char *axes_name(const cli_shape_result *shape)
{
    return shape->grains.n > 0 && count_surfaces(shape) == 0
               ? "table"
               : clast_axes_name((int32_t)shape->axes);
}

/// The lines of rows left out (status OK), or the others.
static json_t *lines_json(const clast_grain_fault *line, int64_t n, bool left_out)
{
    json_t *list = json_array();
    for (int64_t i = 0; i < n; ++i) {
        if ((line[i].status == CLAST_OK) != left_out) {
            continue;
        }
        json_t *object = json_object();
        cli_json_text(object, "text", line[i].text);
        (void)json_array_append_new(list, object);
    }
    return list;
}

json_t *cli_shape_json(const cli_shape_result *shape)
{
    json_t *object = json_object();
    json_t *grains = json_array();
    for (int64_t i = 0; i < shape->grains.n; ++i) {
        (void)json_array_append_new(grains, grain_json(shape, &shape->grains.record[i]));
    }
    cli_json_text(object, "unit", shape->in_metres ? "m" : "model");
    cli_json_text(object, "axes", axes_name(shape));
    cli_json_bool(object, "hull", shape->is_hull);
    cli_json_count(object, "n_grain", shape->grains.n);
    (void)json_object_set_new(object, "grains", grains);
    (void)json_object_set_new(object, "faults",
                              lines_json(shape->grains.fault, shape->grains.n_fault, false));
    (void)json_object_set_new(object, "left_out",
                              lines_json(shape->grains.note, shape->grains.n_note, true));
    (void)json_object_set_new(object, "warnings",
                              lines_json(shape->grains.note, shape->grains.n_note, false));
    return object;
}

static const char *unit(const cli_shape_result *shape, int power)
{
    static const char *const metres[] = {"", " m", " m^2", " m^3", " m^4", " m^5"};
    return shape->in_metres ? metres[power] : "";
}

static void number_text(int digits, double value, char text[32])
{
    (void)snprintf(text, 32, "-");
    if (isfinite(value)) {
        (void)snprintf(text, 32, "%.*g", digits, value);
    }
}

/// A line of n numbers with their unit, "-" for what this kind of grain has no number of.
static void line_words(const char *name, int n, const double *value, const char *unit_words,
                       const char *note)
{
    (void)printf("%-18s ", name);
    for (int k = 0; k < n; ++k) {
        char text[32];
        number_text(9, value[k], text);
        (void)printf("%s%s", k > 0 ? ", " : "", text);
    }
    (void)printf("%s%s\n", unit_words, note);
}

/// Wadell's roundness, or why there is none.
static void roundness_words(const clast_grain_record *r)
{
    const clast_grain *g = &r->grain;
    if (isfinite(g->roundness)) {
        const bool is_low = r->is_smoothed && r->n_voxel < CLAST_ROUNDNESS_VOXELS;
        (void)printf("roundness          %.3f +- %.3f (Wadell; by the start of the search; outline "
                     "of %d edges%s)\n",
                     g->roundness, g->roundness_deviation, g->n_outline,
                     is_low ? "; labels below 80 voxels across read up to 0.3 low" : "");
    } else if (r->kind == CLAST_GRAINS_CLUMP) {
        line_words("roundness", 1, &g->roundness, "", "");
    } else {
        (void)printf("roundness          none (Wadell's needs %d triangles and an outline of %d "
                     "edges)\n",
                     CLAST_ROUNDNESS_FACES, CLAST_ROUNDNESS_EDGES);
    }
}

static void hull_words(const cli_shape_result *shape, const clast_grain_record *r)
{
    const clast_grain *g = &r->grain;
    char added[64] = "";
    if (isfinite(g->hull_volume_added)) {
        const double percent = 100.0 * g->hull_volume_added;
        (void)snprintf(added, sizeof added, ", %.3f %% more than the %s",
                       fabs(percent) < 5e-4 ? 0.0 : percent,
                       r->kind == CLAST_GRAINS_CLUMP ? "spheres' union" : "surface");
    }
    line_words("convex hull", 1, &g->hull_volume, unit(shape, 3), added);
}

static void surface_words(const cli_shape_result *shape, const clast_grain_record *r)
{
    const clast_grain *g = &r->grain;
    const double feret[2] = {g->longest, g->shortest};
    const double shadow[3] = {g->projected_mean, g->projected_least, g->projected_greatest};
    line_words("volume", 1, &g->volume, unit(shape, 3), shape->is_hull ? " (convex hull)" : "");
    line_words("area", 1, &g->area, unit(shape, 2), "");
    if (g->pore_volume > 0.0) {
        const double pore[2] = {g->pore_volume, g->pore_area};
        line_words("closed pores", 2, pore, "",
                   " (volume, area of their walls; not in those above)");
    }
    line_words("centroid", 3, g->centroid, unit(shape, 1), "");
    line_words("moments of inertia", 3, g->moments, unit(shape, 5), " (density 1)");
    hull_words(shape, r);
    line_words("sphericity", 1, &g->sphericity, "", "");
    line_words("convexity", 1, &g->convexity, "", "");
    roundness_words(r);
    line_words("normal roundness", 1, &g->normal_roundness, "", "");
    line_words("angularity", 1, &g->angularity, "", "");
    line_words("Feret", 2, feret, unit(shape, 1), " (greatest, least)");
    line_words("projected area", 3, shadow, unit(shape, 2), " (mean, least, greatest)");
    if (r->kind == CLAST_GRAINS_SERIES) {
        (void)printf("series             degrees 1 to %d; the last two hold %.2g %% of the form's "
                     "power, those above (not used) %.2g %%\n",
                     r->degree, 100.0 * r->power_last, 100.0 * r->power_cut);
    }
    if (r->n_voxel > 0) {
        (void)printf("voxels             %lld%s\n", (long long)r->n_voxel,
                     r->is_smoothed ? " (steps between them smoothed)" : "");
    }
    for (int a = 0; a < CLAST_N_AXES; ++a) {
        char name[32];
        (void)snprintf(name, sizeof name, "L, I, S %s", clast_axes_name(a));
        line_words(name, 3, g->axes[a].lis, unit(shape, 1), "");
    }
    if (r->kind == CLAST_GRAINS_CLUMP) {
        (void)printf("-: needs a surface; of a union of spheres the rest is in closed form\n");
    }
}

static void grain_words(const cli_shape_result *shape, const clast_grain_record *r)
{
    double value[CLAST_N_FORM_FACTOR];
    char text[32];
    const double *lis = r->grain.axes[shape->axes].lis;
    (void)printf("%s (%s)%s\n", cli_name(r->name), clast_grains_kind_name(r->kind),
                 shape->in_metres ? "" : ", lengths in the file's unit");
    if (r->has_surface) {
        surface_words(shape, r);
    }
    if (r->has_size) {
        const double sieve = clast_form_sieve_size(lis[1], lis[2]);
        line_words("sieve size D", 1, &sieve, unit(shape, 1), "");
    }
    (void)printf("Zingg class        %s\nform factors of L, I, S by %s:\n",
                 clast_zingg_name(clast_form_zingg(lis[2] / lis[1], lis[1] / lis[0])),
                 r->has_surface ? clast_axes_name((int32_t)shape->axes) : "the table");
    clast_form_factors(lis[0], lis[1], lis[2], value);
    for (int32_t f = 0; f < CLAST_N_FORM_FACTOR; ++f) {
        const clast_form_factor_entry *about = clast_form_factor_about(f);
        number_text(6, value[f], text);
        (void)printf("  %-4s %-29s %-28s %s\n", about->symbol, about->label, about->formula, text);
    }
}

/// A number in a column, '-' where there is none.
static void cell(int width, const char *form, bool is_known, double value)
{
    char text[32] = "-";
    if (is_known && isfinite(value)) {
        (void)snprintf(text, sizeof text, form[0] == 'f' ? "%.3f" : "%.5g", value);
    }
    (void)printf("%*s ", width, text);
}

static void row_words(const cli_shape_result *shape, const clast_grain_record *r)
{
    const clast_grain *g = &r->grain;
    const double *lis = g->axes[shape->axes].lis;
    cell(11, "g", r->has_surface, g->volume);
    cell(11, "g", r->has_surface, g->area);
    for (int k = 0; k < 3; ++k) {
        cell(10, "g", r->has_size, lis[k]);
    }
    cell(10, "g", r->has_size, clast_form_sieve_size(lis[1], lis[2]));
    cell(6, "f", true, lis[2] / lis[1]);
    cell(6, "f", true, lis[1] / lis[0]);
    cell(6, "f", r->has_surface, g->sphericity);
    cell(6, "f", r->has_surface, g->convexity);
    cell(6, "f", r->has_surface, g->roundness);
    (void)printf("%-6s %s\n", clast_zingg_name(clast_form_zingg(lis[2] / lis[1], lis[1] / lis[0])),
                 cli_name(r->name));
}

void cli_shape_words(const cli_shape_result *shape)
{
    if (shape->grains.n == 1) {
        grain_words(shape, &shape->grains.record[0]);
        return;
    }
    const int64_t n_surface = count_surfaces(shape);
    (void)printf("%lld grains; L, I, S by %s%s%s; %s\n", (long long)shape->grains.n,
                 n_surface > 0 ? "" : "the ", axes_name(shape),
                 n_surface > 0 && n_surface < shape->grains.n ? ", of rows by their table" : "",
                 shape->in_metres ? "volume in m^3, area in m^2, lengths in m"
                                  : "the files' units (give --unit for SI)");
    (void)printf("%11s %11s %10s %10s %10s %10s %6s %6s %6s %6s %6s %-6s %s\n", "volume", "area",
                 "L", "I", "S", "D", "S/I", "I/L", "spher.", "convex", "round.", "Zingg", "file");
    for (int64_t i = 0; i < shape->grains.n; ++i) {
        row_words(shape, &shape->grains.record[i]);
    }
}
