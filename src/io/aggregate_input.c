// Loads what an aggregation's configuration names: shapes by name or file, composites, sizes.
#include <clast/aggregate_run.h>

#include "aggregate/config.h"
#include "base/alloc.h"
#include "base/path.h"
#include "geom/check.h"
#include "io/config_files.h"
#include "io/mesh_io.h"
#include "io/shape_word.h"
#include "io/sizes.h"
#include <clast/fill.h>
#include <clast/grading.h>
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <clast/shape.h>
#include <clast/state.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const double NOWHERE[3] = {0.0, 0.0, 0.0};
static const double UNTURNED[4] = {1.0, 0.0, 0.0, 0.0};

/// Whether the surface bounds a solid whose volume counts once; says what is wrong and what to run.
static clast_status check_surface(const char *path, const clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    clx_doubles found = {0};
    char words[200];
    char cure[400] = "";
    clast_mass mass = {0};
    const bool has_volume = clast_mesh_mass(mesh, &mass) == CLAST_OK && mass.volume > 0.0;
    CLX_TRY(clast_mesh_require_solid(mesh, path,
                                     has_volume ? "take it as it is with --accept-faults" : NULL));
    CLX_TRY(clx_find_doubles(mesh, &found));
    CLX_CHECK(found.n_intersection == 0, CLAST_E_GEOMETRY,
              "%s cuts itself: %s%lld pairs of triangles; see clast mesh check, or --accept-faults",
              path, found.intersection_complete ? "" : "at least ",
              (long long)found.n_intersection);
    clx_doubles_words(&found, sizeof words, words);
    CLX_CHECK(found.intersection_complete, CLAST_E_GEOMETRY, "%s: %s; or --accept-faults", path,
              words);
    CLX_CHECK(words[0] != '\0' || found.n_apart < 2, CLAST_E_GEOMETRY,
              "%s: %d bodies that do not hang together, no one rigid grain; keep one: clast mesh "
              "repair --keep largest, or --accept-faults",
              path, found.n_apart);
    if (words[0] != '\0') {
        CLX_TRY(clast_mesh_cure(mesh, path, sizeof cure, cure));
        status = clx_fail(CLAST_E_GEOMETRY, "%s: %s; drop %s: %s, or --accept-faults", path, words,
                          found.n_doubled + found.n_repeated == 1 ? "it" : "them",
                          cure[0] != '\0' ? cure : "see clast mesh check");
    }
done:
    return status;
}

/// In metres by the unit given or else the file's own; without either *metre is 0, and lengths stay
/// as they are.
static clast_status read_surface(const clast_aggregate_config *config, const char *path,
                                 double *metre, clast_shape *shape)
{
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    clast_mesh_read_report report = {0};
    char name[200];
    (void)snprintf(name, sizeof name, "%.*s", clx_path_stem_length(path), clx_path_name(path));
    CLX_TRY(clast_mesh_read(path, &mesh, &report));
    CLX_TRY(clast_mesh_require_unit(path, &report, config->unit));
    if (config->accept_faults) {
        CLX_CHECK(mesh.n_tri > 0, CLAST_E_GEOMETRY, "%s has no triangles", path);
    } else {
        CLX_TRY(clast_mesh_weld_auto(&mesh, NULL));
        CLX_TRY(check_surface(path, &mesh));
    }
    const char *unit = config->unit[0] != '\0' ? config->unit : report.unit;
    if (unit[0] != '\0') {
        CLX_TRY(clast_unit_factor(unit, "m", metre));
    }
    clast_mesh_transform(&mesh, *metre > 0.0 ? *metre : 1.0, UNTURNED, NOWHERE);
    CLX_TRY(clast_shape_mesh(name, &mesh, shape));
done:
    clast_mesh_free(&mesh);
    return status;
}

/// Spheres x, y, z, r in the coordinates of the shape's file.
static clast_status read_spheres(const char *path, double factor, clast_shape *shape)
{
    clast_status status = CLAST_OK;
    clast_spheres made = {0};
    CLX_TRY(clast_spheres_read(path, NULL, &made));
    for (int32_t i = 0; i < made.n; ++i) {
        for (int k = 0; k < 3; ++k) {
            made.centre[i][k] = factor * made.centre[i][k] - shape->source_origin[k];
        }
        made.radius[i] *= factor;
    }
    clast_spheres_free(&shape->spheres);
    shape->spheres = made;
done:
    return status;
}

/// Whether contacts or an envelope ask for composites.
static bool needs_spheres(const clast_aggregate_config *config)
{
    bool needed = config->params.contact != CLAST_CONTACT_EXACT;
    for (int32_t i = 0; i < config->params.envelope.n; ++i) {
        needed = needed || strncmp(config->params.envelope.item[i], "sphere_", 7) == 0;
    }
    return needed;
}

enum { FILL_LEVEL = 4 };

/// A composite of the shape's surface, made here; a sphere is its own.
static clast_status fill_shape(const clast_aggregate_config *config, clast_shape *shape)
{
    clast_status status = CLAST_OK;
    clast_mesh surface = {0};
    clast_fill_config fill;
    bool has_fill = false;
    if (shape->kind == CLAST_SHAPE_SPHERE || shape->spheres.n > 0) {
        return CLAST_OK;
    }
    CLX_TRY(clast_fields_default(clast_fill_fields, &fill));
    has_fill = true;
    fill.spheres = config->fill_spheres;
    fill.strategy = config->fill;
    fill.allow_open = config->accept_faults;
    fill.seed = config->params.seed;
    CLX_TRY(clast_shape_surface(shape, FILL_LEVEL, &surface));
    CLX_TRY(clast_fill(&surface, &fill, NULL, &shape->spheres, NULL));
done:
    if (has_fill) {
        clast_fields_free(clast_fill_fields, &fill);
    }
    clast_mesh_free(&surface);
    return status;
}

static bool is_file(const char *text)
{
    return text[0] != '\0' && strcmp(text, "sphere") != 0 && !clx_is_ellipsoid_word(text);
}

static clast_status read_shape(const clast_aggregate_config *config, const char *text,
                               double *metre, clast_shape *shape)
{
    if (strcmp(text, "sphere") == 0) {
        return clast_shape_sphere(text, 0.5, shape);
    }
    return clx_is_ellipsoid_word(text) ? clx_ellipsoid_word(text, text, shape)
                                       : read_surface(config, text, metre, shape);
}

static clast_status load_shape(const clast_aggregate_config *config, const char *text,
                               const char *spheres, double density, clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    clast_shape shape = {0};
    double metre = 0.0;
    CLX_TRY(read_shape(config, text, &metre, &shape));
    if (spheres[0] != '\0') {
        CLX_TRY(read_spheres(spheres, metre > 0.0 ? metre : 1.0, &shape));
    } else if (needs_spheres(config)) {
        CLX_TRY(fill_shape(config, &shape));
    }
    CLX_TRY(clast_assembly_add_shape(assembly, &shape, NULL));
    CLX_TRY(clast_assembly_add_grain(assembly, 0, NOWHERE, UNTURNED, 1.0, density));
    (void)snprintf(assembly->unit, sizeof assembly->unit, "%s", metre > 0.0 ? "m" : "model");
done:
    clast_shape_free(&shape);
    return status;
}

/// An earlier run's aggregate, with the densities that it has.
static clast_status load_state(const char *path, const char *spheres, clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(spheres[0] == '\0', CLAST_E_CONFIG, "%s keeps its own composites; drop %s", path,
              spheres);
    CLX_TRY(clast_state_read_assembly(path, assembly));
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_FORMAT, "%s holds no grains", path);
done:
    return status;
}

clast_status clx_load_named(const char *role, const clast_aggregate_config *config,
                            const char *text, const char *spheres, double density,
                            clast_assembly *assembly)
{
    const clast_status status = clx_path_is(text, "h5")
                                    ? load_state(text, spheres, assembly)
                                    : load_shape(config, text, spheres, density, assembly);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", role);
    }
    return status;
}

static clast_status read_sizes(const clast_aggregate_config *config, clx_sizes_columns *columns,
                               clast_sizes *sizes)
{
    const bool by_mass = config->params.size_by_mass;
    const clx_sizes_use use = {
        by_mass ? CLX_SIZE_COLUMN_MASS : CLX_SIZE_COLUMN_NUMBER,
        by_mass ? "leave size_by_mass out" : "set size_by_mass and size_draw",
        ", or give size_unit (um, mm, m or phi)", "give the ends of each class (low_mm, high_mm)"};
    return clx_sizes_read_for(&use, config->sizes, config->size_column, config->size_unit, columns,
                              sizes);
}

clast_status clx_aggregate_list(const clast_aggregate_config *config, clx_sizes_columns *columns,
                                clast_grading_list *list)
{
    clast_status status = CLAST_OK;
    clast_sizes sizes = {0};
    struct stat found;
    *list = (clast_grading_list){.column = "", .ignored = "", .size = ""};
    if (config->params.size_law == CLAST_SIZE_LIST && config->sizes[0] != '\0' &&
        stat(config->sizes, &found) == 0 && S_ISREG(found.st_mode)) {
        CLX_TRY(read_sizes(config, columns, &sizes));
        *list = clx_sizes_list(&sizes, columns);
    }
done:
    clast_sizes_free(&sizes);
    return status;
}

static clast_status load_sizes(const clast_aggregate_config *config, clast_sizes *sizes)
{
    clast_status status = CLAST_OK;
    if (config->sizes[0] != '\0') {
        return read_sizes(config, NULL, sizes);
    }
    CLX_TRY(clast_sizes_alloc(config->params.size.n, sizes));
    for (int32_t i = 0; i < config->params.size.n; ++i) {
        sizes->low[i] = config->params.size.item[i];
        sizes->high[i] = config->params.size.item[i];
        sizes->count[i] = 1.0;
    }
done:
    return status;
}

void clast_aggregate_unload(clast_aggregate_source *source)
{
    if (source == NULL) {
        return;
    }
    clast_assembly_free(&source->core);
    for (int32_t i = 0; i < source->n_coat; ++i) {
        clast_assembly_free(&source->coat[i]);
    }
    clx_free(source->coat);
    clast_sizes_free(&source->sizes);
    *source = (clast_aggregate_source){0};
}

static clast_status load_shapes(const clast_aggregate_config *config, clast_aggregate_source *made)
{
    clast_status status = CLAST_OK;
    if (config->core[0] != '\0') {
        CLX_TRY(clx_load_named("core", config, config->core, config->core_spheres,
                               config->params.core_density, &made->core));
    }
    CLX_TRY(clx_alloc(&made->coat, config->coat.n, sizeof *made->coat));
    made->n_coat = config->coat.n;
    for (int32_t i = 0; i < config->coat.n; ++i) {
        const int32_t k = config->params.coat_density.n > 1 ? i : 0;
        const char *spheres = config->coat_spheres.n > 0 ? config->coat_spheres.item[i] : "";
        CLX_TRY(clx_load_named("coat", config, config->coat.item[i], spheres,
                               config->params.coat_density.item[k], &made->coat[i]));
    }
done:
    return status;
}

clast_status clast_aggregate_load(const clast_aggregate_config *config,
                                  clast_aggregate_source *source)
{
    CLX_ARGUMENTS(config, source);
    clast_status status = CLAST_OK;
    clast_aggregate_source made = {0};
    CLX_TRY(clast_aggregate_config_check(config));
    CLX_TRY(load_shapes(config, &made));
    if (config->params.size_law == CLAST_SIZE_LIST) {
        CLX_TRY(load_sizes(config, &made.sizes));
    }
    *source = made;
    made = (clast_aggregate_source){0};
    source->input = (clast_aggregate_input){
        .core = config->core[0] != '\0' ? &source->core : NULL,
        .n_coat = source->n_coat,
        .coat = source->coat,
        .sizes = config->params.size_law == CLAST_SIZE_LIST ? &source->sizes : NULL};
done:
    clast_aggregate_unload(&made);
    return status;
}

static const char *file_of(const void *of, int32_t i, const char **role)
{
    const clast_aggregate_config *config = of;
    if (clast_fields_check(clast_aggregate_fields, config) != CLAST_OK) {
        return NULL;
    }
    const struct {
        const char *role;
        int32_t n;
        char *const *text;
    } lists[] = {{"core", 1, &config->core},
                 {"coat", config->coat.n, config->coat.item},
                 {"core_spheres", 1, &config->core_spheres},
                 {"coat_spheres", config->coat_spheres.n, config->coat_spheres.item},
                 {"sizes", 1, &config->sizes}};
    for (size_t k = 0; k < sizeof lists / sizeof lists[0]; ++k) {
        for (int32_t j = 0; j < lists[k].n; ++j) {
            if (is_file(lists[k].text[j]) && i-- == 0) {
                *role = lists[k].role;
                return lists[k].text[j];
            }
        }
    }
    return NULL;
}

clx_run_inputs clx_aggregate_inputs(const clast_aggregate_config *config)
{
    return (clx_run_inputs){clast_aggregate_fields, config, config->params.seed, file_of};
}
