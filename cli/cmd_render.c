// clast render: a picture of surfaces or of a run's assembly.
#include "command.h"
#include "idle.h"
#include "json.h"

#include <clast/mesh.h>
#include <clast/render.h>
#include <clast/state.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Last part of a path without its extension, made unique among the assembly's shapes.
static void name_of(const char *path, const clast_assembly *assembly, char *name, size_t size)
{
    const char *slash = strrchr(path, '/');
    (void)snprintf(name, size - 12, "%s", slash != NULL ? slash + 1 : path);
    char *dot = strrchr(name, '.');
    if (dot != NULL && dot != name) {
        *dot = '\0';
    }
    const size_t n = strlen(name);
    int copy = 1;
    for (int32_t s = 0; s < assembly->n_shape; ++s) {
        if (strcmp(assembly->shape[s].name, name) == 0) {
            (void)snprintf(name + n, size - n, " %d", ++copy);
            s = -1;
        }
    }
}

/// A picture needs no volume: one without (flat, of mixed windings) counts as large as it is long.
static clast_status bare_shape(const char *path, char *name, clast_mesh *mesh, clast_shape *shape)
{
    static const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    double low[3];
    double high[3];
    double to_origin[3];
    clast_shape bare = {.kind = CLAST_SHAPE_MESH, .name = name};
    clast_mesh_bounds(mesh, low, high);
    for (int k = 0; k < 3; ++k) {
        bare.source_origin[k] = 0.5 * (low[k] + high[k]);
        to_origin[k] = -bare.source_origin[k];
    }
    CLI_GUARD(clast_mesh_length(mesh, &bare.length));
    if (!(bare.length > 0.0)) {
        return cli_fail(CLAST_E_GEOMETRY, "%s is one point: there is nothing to draw", path);
    }
    clast_mesh_transform(mesh, 1.0, unturned, to_origin);
    bare.mesh = *mesh;
    bare.volume = CLAST_PI / 6.0 * bare.length * bare.length * bare.length;
    return clast_shape_copy(&bare, shape);
}

/// The shape of a surface: measured where it has a volume, inside out or not, else bare.
static clast_status shape_of(const char *path, char *name, clast_mesh *mesh, clast_shape *shape)
{
    if (clast_mesh_volume(mesh) < 0.0) {
        for (int32_t t = 0; t < mesh->n_tri; ++t) {
            const int32_t swap = mesh->tri[t][1];
            mesh->tri[t][1] = mesh->tri[t][2];
            mesh->tri[t][2] = swap;
        }
    }
    const clast_status status = clast_shape_mesh(name, mesh, shape);
    return status == CLAST_E_GEOMETRY ? bare_shape(path, name, mesh, shape) : status;
}

/// Surfaces are drawn at the coordinates of their files, so those that say a unit say one and the
/// same, which the picture's is unless one is given.
static clast_status note_unit(const char *path, const clast_mesh_read_report *report,
                              clast_render_config *config, char own[16])
{
    if (own[0] != '\0' && report->unit[0] != '\0' && strcmp(own, report->unit) != 0) {
        return cli_fail(CLAST_E_CONFIG,
                        "%s says that it is in %s, a surface before it that it is in %s; make them "
                        "one: clast mesh convert %s --out-unit %s -o OTHER",
                        path, report->unit, own, path, own);
    }
    CLI_GUARD(clast_mesh_require_unit(path, report, config->unit));
    if (report->unit[0] != '\0' && config->unit[0] == '\0') {
        (void)snprintf(own, 16, "%s", report->unit);
        return clast_field_set(clast_fields_find(clast_render_fields, "unit"), config, own, false);
    }
    return CLAST_OK;
}

/// A surface at the place it has in its file.
static clast_status add_surface(const char *path, clast_render_config *config, char own[16],
                                clast_assembly *assembly)
{
    static const double upright[4] = {1.0, 0.0, 0.0, 0.0};
    char name[256];
    clast_mesh mesh = {0};
    clast_shape shape = {0};
    clast_mesh_read_report read = {0};
    int32_t id = 0;
    name_of(path, assembly, name, sizeof name);
    clast_status status = CLAST_OK;
    CLI_TRY(clast_mesh_read(path, &mesh, &read));
    CLI_TRY(note_unit(path, &read, config, own));
    CLI_CHECK(mesh.n_tri > 0, CLAST_E_GEOMETRY, "%s has no triangles: %d points are no surface",
              path, mesh.n_vert);
    CLI_TRY(shape_of(path, name, &mesh, &shape));
    CLI_TRY(clast_assembly_add_shape(assembly, &shape, &id));
    CLI_TRY(clast_assembly_add_grain(assembly, id, shape.source_origin, upright, 1.0, 1.0));
done:
    clast_shape_free(&shape);
    clast_mesh_free(&mesh);
    return status;
}

/// A filling without an assembly: each sphere is a grain.
static clast_status add_spheres(const clast_spheres *spheres, clast_assembly *assembly)
{
    static const double upright[4] = {1.0, 0.0, 0.0, 0.0};
    clast_shape ball = {0};
    int32_t id = 0;
    clast_status status = CLAST_OK;
    CLI_TRY(clast_shape_sphere("sphere", 1.0, &ball));
    CLI_TRY(clast_assembly_add_shape(assembly, &ball, &id));
    for (int32_t i = 0; i < spheres->n; ++i) {
        CLI_TRY(clast_assembly_add_grain(assembly, id, spheres->centre[i], upright,
                                         spheres->radius[i], 1.0));
    }
done:
    clast_shape_free(&ball);
    return status;
}

static clast_status load_state(const char *path, clast_assembly *assembly)
{
    clast_state state = {0};
    clast_status status = clast_state_read(path, &state);
    if (status != CLAST_OK) {
        return status;
    }
    if (state.assembly != NULL) {
        status = clast_assembly_copy(state.assembly, assembly);
    } else if (state.n_spheres > 0) {
        memcpy(assembly->unit, state.unit, sizeof assembly->unit);
        status = add_spheres(&state.spheres[0].spheres, assembly);
    } else {
        status = cli_fail(CLAST_E_FORMAT, "%s holds neither grains nor spheres", path);
    }
    clast_state_free(&state);
    return status;
}

static clast_status load(const cli_common *common, clast_render_config *config, char own[16],
                         clast_assembly *assembly)
{
    char path[CLAST_RUN_PATH];
    (void)snprintf(assembly->unit, sizeof assembly->unit, "model");
    for (int32_t i = 0; i < common->n_argument; ++i) {
        const char *input = common->argument[i];
        if (common->n_argument > 1 && cli_is_folder(input)) {
            return cli_fail(CLAST_E_USAGE, "%s is a run; draw it alone", input);
        }
        CLI_GUARD(clast_run_folder_state(input, path));
        const char *dot = strrchr(path, '.');
        if (dot == NULL || strcmp(dot, ".h5") != 0) {
            CLI_GUARD(add_surface(path, config, own, assembly));
        } else if (common->n_argument == 1) {
            CLI_GUARD(load_state(path, assembly));
        } else {
            return cli_fail(CLAST_E_USAGE, "%s is a run; draw it alone", path);
        }
    }
    return CLAST_OK;
}

static int64_t count_triangles(const clast_assembly *assembly)
{
    int64_t n = 0;
    for (int32_t g = 0; g < assembly->n_grain; ++g) {
        const clast_shape *shape = &assembly->shape[assembly->shape_id[g]];
        n += shape->kind == CLAST_SHAPE_MESH ? shape->mesh.n_tri : 0;
    }
    return n;
}

static clast_status report(const cli_common *common, const clast_assembly *assembly,
                           const char *unit, const clast_image *image, double wall)
{
    const int64_t n_triangle = count_triangles(assembly);
    if (!common->json) {
        (void)printf("%s: %d x %d pixels, %d grain%s, %lld triangles, %.2f s\n",
                     cli_name(common->output), image->width, image->height, assembly->n_grain,
                     cli_plural(assembly->n_grain), (long long)n_triangle, wall);
        return CLAST_OK;
    }
    json_t *o = json_object();
    cli_json_text(o, "output", common->output);
    cli_json_count(o, "width", image->width);
    cli_json_count(o, "height", image->height);
    cli_json_count(o, "n_grain", assembly->n_grain);
    cli_json_count(o, "n_triangle", n_triangle);
    cli_json_number(o, "pixel_size", image->pixel_size);
    cli_json_text(o, "unit", unit[0] != '\0' ? unit : assembly->unit);
    cli_json_number(o, "wall_s", wall);
    return cli_print_json(o);
}

static clast_status run(const cli_common *common, void *config)
{
    clast_idle rules[CLAST_N_IDLE];
    CLI_GUARD(cli_idle_check(clast_render_fields, config, clast_render_idle(config, rules)));
    clast_assembly assembly = {0};
    clast_image image = {0};
    char unit[16] = "";
    const double start = cli_clock();
    const clast_monitor monitor = cli_monitor(common);
    if (common->output == NULL) {
        return cli_fail(CLAST_E_USAGE, "name the picture with -o picture.png");
    }
    CLI_GUARD(cli_check_ending(common->output, "pictures", "png"));
    clast_status status = CLAST_OK;
    CLI_TRY(load(common, config, unit, &assembly));
    CLI_TRY(clast_render_assembly(&assembly, config, &monitor, &image));
    CLI_TRY(clast_image_write_png(&image, common->output));
    CLI_TRY(report(common, &assembly, ((const clast_render_config *)config)->unit, &image,
                   cli_clock() - start));
done:
    clast_image_free(&image);
    clast_assembly_free(&assembly);
    return status;
}

const cli_command cli_render = {
    .name = "render",
    .arguments = "INPUT [INPUT...]",
    .summary = "draw surfaces or a run's grains into a PNG picture",
    .example = {"clast render data/standin63/grain00.ply --width 400 --height 300 -o grain.png",
                "clast render run/ --colour size --ground -o run.png",
                "clast render run/ --cut x --azimuth 30deg -o cut.png"},
    .details =
        "INPUT is a surface (STL, OBJ, PLY, OFF; several are drawn together, each at the place\n"
        "that its file gives it), a run's folder, or a state.h5. The output is a PNG file.\n"
        "Colours by size mean the diameter of the sphere of equal volume (of a surface without\n"
        "volume, flat say, its length). The picture is framed so that nothing is cut off; with "
        "--cut\n"
        "the frame is still that of the whole body. Equal runs give equal bytes.",
    .fields = clast_render_fields,
    .config_size = sizeof(clast_render_config),
    .n_min = 1,
    .n_max = 64,
    .needs_file = true,
    .run = run,
};
