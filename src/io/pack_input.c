// Loads what a packing's configuration names: sizes and shapes.
#include <clast/pack.h>

#include "aggregate/config.h"
#include "base/alloc.h"
#include "base/path.h"
#include "geom/check.h"
#include "io/bed_tables.h"
#include "io/config_files.h"
#include "io/rigid_grain.h"
#include "io/shape_word.h"
#include "io/start_file.h"
#include "io/wall_file.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/form.h>
#include <clast/grading.h>
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <clast/shape.h>
#include <clast/state.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

void clast_pack_unload(clast_pack_source *source)
{
    if (source == NULL) {
        return;
    }
    for (int32_t i = 0; i < source->n_shape; ++i) {
        clast_shape_free(&source->shape[i]);
    }
    CLX_FREE(source->shape, source->hull);
    clast_mesh_free(&source->container);
    clast_mesh_free(&source->container_closed);
    clast_assembly_free(&source->start);
    clx_walls_unload(source->n_wall, source->wall);
    clast_grading_destroy(source->grading);
    clast_curve_free(&source->curve);
    *source = (clast_pack_source){0};
}

/// Keeps what the hull adds to the surface it was taken of.
static clast_status note_hull(const char *name, const clast_mesh *mesh, const clast_mesh *hull,
                              clast_pack_hull *note)
{
    clast_status status = CLAST_OK;
    clast_mesh_check_result found = {0};
    clast_mesh welded = {0};
    CLX_TRY(clast_mesh_copy(mesh, &welded));
    CLX_TRY(clast_mesh_weld_auto(&welded, NULL));
    CLX_TRY(clx_check_without_cuts(&welded, &found));
    (void)snprintf(note->shape, sizeof note->shape, "%s", name);
    note->n_triangle = hull->n_tri;
    note->volume_added = found.closed && found.oriented && found.volume != 0.0
                             ? clast_mesh_volume(hull) / fabs(found.volume) - 1.0
                             : (double)NAN;
done:
    clast_mesh_check_free(&found);
    clast_mesh_free(&welded);
    return status;
}

static clast_status read_surface(const clast_pack_config *config, const char *path,
                                 const char *name, clast_shape *shape, clast_pack_hull *note)
{
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    clast_mesh hull = {0};
    clast_mesh_read_report report = {0};
    CLX_TRY(clast_mesh_read(path, &mesh, &report));
    CLX_TRY(clast_mesh_require_unit(path, &report, config->unit));
    CLX_CHECK(mesh.n_tri > 0, CLAST_E_GEOMETRY, "%s has no triangles", path);
    if (config->faces > 0) {
        status = clast_reform_hull(&mesh, config->faces, &hull);
    } else if (config->hull) {
        status = clast_mesh_hull(&mesh, &hull);
    }
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", path);
        goto done;
    }
    if (hull.n_tri > 0) {
        CLX_TRY(note_hull(name, &mesh, &hull, note));
    } else {
        CLX_TRY(clast_mesh_weld_auto(&mesh, NULL));
        CLX_TRY(clast_mesh_require_solid(&mesh, path, "take its hull (hull: yes)"));
    }
    CLX_TRY(clast_shape_mesh(name, hull.n_tri > 0 ? &hull : &mesh, shape));
done:
    clast_mesh_free(&mesh);
    clast_mesh_free(&hull);
    return status;
}

/// The rigid grain that an aggregate's state is.
static clast_status read_aggregate(const clast_pack_config *config, const clast_assembly *a,
                                   const char *name, clast_shape *shape, clast_pack_hull *note)
{
    const clast_rigid_options options = {.hull = config->hull, .faces = config->faces};
    double added = 0.0;
    const clast_status status = clx_rigid_grain(a, name, &options, shape, &added);
    if (status == CLAST_OK && isfinite(added) && (config->hull || config->faces > 0)) {
        (void)snprintf(note->shape, sizeof note->shape, "%s", name);
        note->n_triangle = shape->mesh.n_tri;
        note->volume_added = added;
    }
    return status;
}

/// Spheres of a file, or the rigid grain that an aggregate's state is.
static clast_status read_clump(const clast_pack_config *config, const char *path, const char *name,
                               clast_shape *shape, clast_pack_hull *note)
{
    clast_status status = CLAST_OK;
    clast_spheres spheres = {0};
    clast_state state = {0};
    if (clx_path_is(path, "h5")) {
        CLX_TRY(clast_state_read(path, &state));
    }
    if (state.n_spheres == 0 && state.assembly != NULL) {
        CLX_TRY(read_aggregate(config, state.assembly, name, shape, note));
    } else {
        CLX_TRY(clast_spheres_read(path, NULL, &spheres));
        CLX_TRY(clast_shape_clump(name, &spheres, shape));
    }
done:
    clast_spheres_free(&spheres);
    clast_state_free(&state);
    return status;
}

/// The mass-equivalent ellipsoid instead of a surface or clump.
static clast_status make_ellipsoid(clast_shape *shape)
{
    clast_shape made = {0};
    if (shape->kind != CLAST_SHAPE_MESH && shape->kind != CLAST_SHAPE_CLUMP) {
        return CLAST_OK;
    }
    const clast_status status = clast_shape_ellipsoid(shape->name, shape->semi_axes, &made);
    if (status == CLAST_OK) {
        made.own.density = shape->own.density;
        clast_shape_free(shape);
        *shape = made;
    }
    return status;
}

static clast_status read_shape(const clast_pack_config *config, const char *text, const char *name,
                               clast_shape *shape, clast_pack_hull *note)
{
    if (strcmp(text, "sphere") == 0) {
        return clast_shape_sphere(name, 0.5, shape);
    }
    if (clx_is_ellipsoid_word(text)) {
        return clx_ellipsoid_word(text, name, shape);
    }
    if (clx_path_is(text, "csv") || clx_path_is(text, "h5")) {
        return read_clump(config, text, name, shape, note);
    }
    return read_surface(config, text, name, shape, note);
}

static clast_status load_shape(const clast_pack_config *config, int32_t i, clast_shape *shape,
                               clast_pack_hull *note)
{
    clast_status status = CLAST_OK;
    clast_shape made = {0};
    char name[256];
    const char *text = config->shapes.item[i];
    (void)snprintf(name, sizeof name, "%d-%.200s", i + 1, clx_path_name(text));
    CLX_TRY(read_shape(config, text, name, &made, note));
    if (config->ellipsoids) {
        CLX_TRY(make_ellipsoid(&made));
    }
    *shape = made;
    made = (clast_shape){0};
done:
    clast_shape_free(&made);
    return status;
}

static clast_status read_container(const clast_pack_config *config, clast_pack_source *made)
{
    clast_status status = CLAST_OK;
    if (config->container[0] == '\0') {
        return CLAST_OK;
    }
    CLX_TRY(clx_container_read(config->container, config->container_unit, &made->container));
    CLX_TRY(clast_bed_close(&made->container, &made->container_closed));
done:
    if (status != CLAST_OK) {
        clx_fail_prefix("container");
    }
    return status;
}

/// Sizes and their curve. Where classes differ in density, the curve's shares of mass are divided
/// by it: numbers of grains follow volumes.
static clast_status load_sizes(const clast_pack_config *config, clast_pack_source *made)
{
    clast_status status = CLAST_OK;
    const clast_grading_spread spread = (clast_grading_spread)config->spread;
    const clast_grading_count count = (clast_grading_count)config->count;
    clast_curve volumes = {0};
    double *share = NULL;
    CLX_TRY(clast_grading_load(config->curve, spread, count, &made->curve, &made->grading));
    const int32_t n = made->curve.n_class;
    if (config->density_of != CLAST_PACK_DENSITY_CLASS || config->density.n != n) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&share, n, sizeof *share));
    for (int32_t i = 0; i < n; ++i) {
        CLX_CHECK(config->density.item[i] > 0.0, CLAST_E_CONFIG,
                  "a density of 0 (density) is for density_of shape alone");
        share[i] = made->curve.mass[i] / config->density.item[i];
    }
    CLX_TRY(clast_curve_make(n, made->curve.sieve, share, &volumes));
    clast_grading_destroy(made->grading);
    made->grading = NULL;
    CLX_TRY(clast_grading_of_curve(&volumes, spread, count, &made->grading));
done:
    clx_free(share);
    clast_curve_free(&volumes);
    return status;
}

/// `made` will be moved to `source`, from where its input borrows.
static clast_status load_container(const clast_pack_config *config, const clast_pack_source *source,
                                   clast_pack_source *made)
{
    clast_status status = CLAST_OK;
    CLX_TRY(read_container(config, made));
    if (made->container.n_tri > 0) {
        made->input.container = &source->container;
        made->input.container_closed = &source->container_closed;
    }
done:
    return status;
}

static clast_status load_shapes(const clast_pack_config *config, clast_pack_source *made)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&made->shape, config->shapes.n, sizeof *made->shape));
    CLX_TRY(clx_alloc(&made->hull, config->shapes.n, sizeof *made->hull));
    for (int32_t i = 0; i < config->shapes.n; ++i) {
        status = load_shape(config, i, &made->shape[i], &made->hull[made->n_hull]);
        if (status != CLAST_OK) {
            clx_fail_prefix("shapes");
            goto done;
        }
        ++made->n_shape;
        made->n_hull += made->hull[made->n_hull].n_triangle > 0 ? 1 : 0;
    }
done:
    return status;
}

/// Grains of a start: rows with poses name the configuration's shapes, other files have their own.
static clast_status read_start(const clast_pack_config *config, clast_pack_source *made,
                               clast_packing_report *report)
{
    clast_status status = CLAST_OK;
    clast_table poses = {0};
    CLX_TRY(clx_start_poses(config, &poses));
    if (poses.n_column > 0) {
        CLX_TRY(load_shapes(config, made));
        CLX_TRY(clx_start_of_poses(config, &poses, made->n_shape, made->shape, &made->start));
    } else {
        CLX_CHECK(config->shapes.n == 1 && strcmp(config->shapes.item[0], "sphere") == 0,
                  CLAST_E_CONFIG, "start brings its shapes: leave out shapes");
        CLX_TRY(clx_start_read(config, &made->start, report));
        const clast_assembly *a = &made->start;
        CLX_TRY(clx_alloc(&made->shape, a->n_shape, sizeof *made->shape));
        for (; made->n_shape < a->n_shape; ++made->n_shape) {
            CLX_TRY(clast_shape_copy(&a->shape[made->n_shape], &made->shape[made->n_shape]));
        }
    }
done:
    clast_table_free(&poses);
    return status;
}

/// A bed from elsewhere: its shapes, and sizes between the least and the greatest of its grains.
static clast_status load_start(const clast_pack_config *config, clast_pack_source *made)
{
    clast_status status = CLAST_OK;
    double low = INFINITY;
    double high = 0.0;
    clast_packing_report report = {.frame = {.step = -1}};
    CLX_TRY(read_start(config, made, &report));
    const clast_assembly *a = &made->start;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const double size = 2.0 * a->scale[i] * a->shape[a->shape_id[i]].semi_axes[1];
        low = fmin(low, size);
        high = fmax(high, size);
    }
    CLX_TRY(clast_grading_uniform(low, high, &made->grading));
    made->input = (clast_pack_input){.grading = made->grading,
                                     .n_shape = made->n_shape,
                                     .shape = made->shape,
                                     .start_snapshot = report.snapshot,
                                     .n_start_snapshot = report.n_snapshot,
                                     .start_step = report.frame.step,
                                     .start_shift = clx_start_shift(&config->dem, &report.frame)};
done:
    return status;
}

/// Sizes and shapes that grains are made of.
static clast_status load_grains(const clast_pack_config *config, clast_pack_source *made)
{
    clast_status status = CLAST_OK;
    CLX_TRY(load_sizes(config, made));
    CLX_TRY(load_shapes(config, made));
    made->input = (clast_pack_input){
        .grading = made->grading, .n_shape = made->n_shape, .shape = made->shape};
done:
    return status;
}

clast_status clast_pack_load(const clast_pack_config *config, clast_pack_source *source)
{
    CLX_ARGUMENTS(config, source);
    CLX_GUARD(clast_fields_check(clast_pack_fields, config));
    clast_status status = CLAST_OK;
    clast_pack_source made = {0};
    double factor = 1.0;
    CLX_CHECK(config->shapes.n > 0, CLAST_E_CONFIG, "a packing needs a shape (shapes)");
    if (config->unit[0] != '\0') {
        CLX_TRY(clast_unit_factor(config->unit, "m", &factor));
    }
    if (config->start[0] != '\0') {
        CLX_TRY(load_start(config, &made));
        made.input.start = &source->start;
    } else {
        CLX_TRY(load_grains(config, &made));
        made.input.curve = made.curve.n_class > 0 ? &source->curve : NULL;
    }
    CLX_TRY(load_container(config, source, &made));
    CLX_TRY(clx_walls_load(config, &made.n_wall, &made.wall));
    made.input.n_wall = made.n_wall;
    made.input.wall = made.wall;
    *source = made;
    made = (clast_pack_source){0};
done:
    clast_pack_unload(&made);
    return status;
}

static bool is_shape_file(const char *text)
{
    return strcmp(text, "sphere") != 0 && strncmp(text, "ellipsoid:", 10) != 0;
}

/// The file of sizes within the option curve, or NULL.
static const char *curve_file(const char *text)
{
    static const char *const lists[] = {"list:", "masses:"};
    for (int k = 0; k < 2; ++k) {
        if (strncmp(text, lists[k], strlen(lists[k])) == 0) {
            return text + strlen(lists[k]);
        }
    }
    return clx_path_is(text, "csv") || clx_path_is(text, "txt") || clx_path_is(text, "tsv") ? text
                                                                                            : NULL;
}

static const char *file_of(const void *of, int32_t i, const char **role)
{
    const clast_pack_config *config = of;
    if (clast_fields_check(clast_pack_fields, config) != CLAST_OK) {
        return NULL;
    }
    *role = "shapes";
    for (int32_t k = 0; k < config->shapes.n; ++k) {
        if (is_shape_file(config->shapes.item[k]) && i-- == 0) {
            return config->shapes.item[k];
        }
    }
    *role = "container";
    if (config->container[0] != '\0' && i-- == 0) {
        return config->container;
    }
    *role = "start";
    if (config->start[0] != '\0' && i-- == 0) {
        return config->start;
    }
    *role = "curve";
    if (curve_file(config->curve) != NULL && i-- == 0) {
        return curve_file(config->curve);
    }
    *role = "wall";
    return clx_walls_file(config, i);
}

clx_run_inputs clx_pack_inputs(const clast_pack_config *config)
{
    return (clx_run_inputs){clast_pack_fields, config, config->seed, file_of};
}
