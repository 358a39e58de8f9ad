// Output of clast shape.
#include "shape_words.h"

#include <math.h>
#include <stdio.h>

static void put_triple(json_t *object, const char *key, const double value[3])
{
    json_t *list = json_array();
    for (int k = 0; k < 3; ++k) {
        (void)json_array_append_new(list, isfinite(value[k]) ? json_real(value[k]) : json_null());
    }
    (void)json_object_set_new(object, key, list);
}

/// L, I, S, or nulls.
static void put_lengths(json_t *object, const clast_grain_record *r, const double lis[3])
{
    static const char *const letters[3] = {"L", "I", "S"};
    for (int k = 0; k < 3; ++k) {
        cli_json_number(object, letters[k], r->has_size ? lis[k] : (double)NAN);
    }
}

static void put_factors(json_t *object, const double lis[3])
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
    cli_json_text(object, "zingg",
                  clast_zingg_name(clast_form_zingg(lis[2] / lis[1], lis[1] / lis[0])));
}

static void put_surface(json_t *object, const clast_grain_record *r)
{
    const clast_grain *g = &r->grain;
    json_t *axes = json_object();
    cli_json_number(object, "sphericity", g->sphericity);
    cli_json_number(object, "convexity", g->convexity);
    put_triple(object, "moments", g->moments);
    put_triple(object, "centroid", g->centroid);
    cli_json_number(object, "roundness", g->roundness);
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
    if (r->n_voxel > 0) {
        cli_json_count(object, "n_voxel", r->n_voxel);
    }
    for (int a = 0; a < CLAST_N_AXES; ++a) {
        json_t *one = json_object();
        json_t *direction = json_array();
        put_lengths(one, r, g->axes[a].lis);
        for (int k = 0; k < 3; ++k) {
            const double *d = g->axes[a].direction[k];
            (void)json_array_append_new(direction, json_pack("[fff]", d[0], d[1], d[2]));
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
    put_lengths(object, r, lis);
    cli_json_number(object, "D", r->has_size ? clast_form_sieve_size(lis[1], lis[2]) : (double)NAN);
    put_factors(object, lis);
    if (r->has_surface) {
        put_surface(object, r);
    }
    return object;
}

static json_t *lines_json(const clast_grain_fault *line, int64_t n)
{
    json_t *list = json_array();
    for (int64_t i = 0; i < n; ++i) {
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
    cli_json_text(object, "axes", clast_axes_name((int32_t)shape->axes));
    cli_json_bool(object, "hull", shape->is_hull);
    cli_json_count(object, "n_grain", shape->grains.n);
    (void)json_object_set_new(object, "grains", grains);
    (void)json_object_set_new(object, "faults",
                              lines_json(shape->grains.fault, shape->grains.n_fault));
    (void)json_object_set_new(object, "left_out",
                              lines_json(shape->grains.note, shape->grains.n_note));
    return object;
}

static const char *unit(const cli_shape_result *shape, int power)
{
    static const char *const metres[] = {"", " m", " m2", " m3", " m4", " m5"};
    return shape->in_metres ? metres[power] : "";
}

/// Wadell's roundness, or why there is none.
static void roundness_words(const clast_grain *g)
{
    if (isfinite(g->roundness)) {
        (void)printf("roundness          %.3f (Wadell; outline of %d edges)\n", g->roundness,
                     g->n_outline);
    } else {
        (void)printf("roundness          none (Wadell's needs %d triangles and an outline of %d "
                     "edges)\n",
                     CLAST_ROUNDNESS_FACES, CLAST_ROUNDNESS_EDGES);
    }
}

static void surface_words(const cli_shape_result *shape, const clast_grain_record *r)
{
    const clast_grain *g = &r->grain;
    (void)printf("volume             %.9g%s%s\n", g->volume, unit(shape, 3),
                 shape->is_hull ? " (convex hull)" : "");
    (void)printf("area               %.9g%s\n", g->area, unit(shape, 2));
    (void)printf("centroid           %.9g, %.9g, %.9g%s\n", g->centroid[0], g->centroid[1],
                 g->centroid[2], unit(shape, 1));
    (void)printf("moments of inertia %.9g, %.9g, %.9g%s (density 1)\n", g->moments[0],
                 g->moments[1], g->moments[2], unit(shape, 5));
    (void)printf("convex hull        %.9g%s", g->hull_volume, unit(shape, 3));
    if (isfinite(g->hull_volume_added)) {
        const double added = 100.0 * g->hull_volume_added;
        (void)printf(", %.3f %% more than the surface", fabs(added) < 5e-4 ? 0.0 : added);
    }
    (void)putchar('\n');
    (void)printf("sphericity         %.6f\nconvexity          %.6f\n", g->sphericity, g->convexity);
    roundness_words(g);
    (void)printf("normal roundness   %.6f\nangularity         %.6f\n", g->normal_roundness,
                 g->angularity);
    (void)printf("Feret              %.9g greatest, %.9g least%s\n", g->longest, g->shortest,
                 unit(shape, 1));
    (void)printf("projected area     %.9g mean, %.9g least, %.9g greatest%s\n", g->projected_mean,
                 g->projected_least, g->projected_greatest, unit(shape, 2));
    if (r->n_voxel > 0) {
        (void)printf("voxels             %lld\n", (long long)r->n_voxel);
    }
    for (int a = 0; a < CLAST_N_AXES; ++a) {
        const double *lis = g->axes[a].lis;
        (void)printf("L, I, S %-10s %.9g, %.9g, %.9g%s\n", clast_axes_name(a), lis[0], lis[1],
                     lis[2], unit(shape, 1));
    }
}

static void grain_words(const cli_shape_result *shape, const clast_grain_record *r)
{
    double value[CLAST_N_FORM_FACTOR];
    const double *lis = r->grain.axes[shape->axes].lis;
    (void)printf("%s (%s)%s\n", r->name, clast_grains_kind_name(r->kind),
                 shape->in_metres ? "" : ", lengths in the file's unit");
    if (r->has_surface) {
        surface_words(shape, r);
    }
    if (r->has_size) {
        (void)printf("sieve size D       %.9g%s\n", clast_form_sieve_size(lis[1], lis[2]),
                     unit(shape, 1));
    }
    (void)printf("Zingg class        %s\nform factors of L, I, S by %s:\n",
                 clast_zingg_name(clast_form_zingg(lis[2] / lis[1], lis[1] / lis[0])),
                 r->has_surface ? clast_axes_name((int32_t)shape->axes) : "the table");
    clast_form_factors(lis[0], lis[1], lis[2], value);
    for (int32_t f = 0; f < CLAST_N_FORM_FACTOR; ++f) {
        const clast_form_factor_entry *about = clast_form_factor_about(f);
        (void)printf("  %-4s %-29s %-28s %.6g\n", about->symbol, about->label, about->formula,
                     value[f]);
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
                 r->name);
}

void cli_shape_words(const cli_shape_result *shape)
{
    if (shape->grains.n == 1) {
        grain_words(shape, &shape->grains.record[0]);
        return;
    }
    (void)printf("%lld grains; L, I, S by %s; %s\n", (long long)shape->grains.n,
                 clast_axes_name((int32_t)shape->axes),
                 shape->in_metres ? "SI units" : "the files' units (give --unit for SI)");
    (void)printf("%11s %11s %10s %10s %10s %10s %6s %6s %6s %6s %6s %-6s %s\n", "volume", "area",
                 "L", "I", "S", "D", "S/I", "I/L", "spher.", "convex", "round.", "Zingg", "file");
    for (int64_t i = 0; i < shape->grains.n; ++i) {
        row_words(shape, &shape->grains.record[i]);
    }
}
