// Assemblies to the files that other programs read: which writer, and ParaView collections.
#include "io/export.h"

#include "assembly/whole.h"
#include "base/field.h"
#include "base/number.h"
#include "base/path.h"
#include "base/status.h"
#include <clast/field.h>
#include <clast/mesh.h>
#include <clast/state.h>
#include <clast/table.h>
#include <math.h>
#include <string.h>

static const char *const names[] = {"any",  "vtu",  "stl",  "obj", "ply",  "3mf",  "csv",
                                    "dump", "json", "data", "txt", "voro", "xyzd", "conf"};
enum { N_FORMAT = sizeof names / sizeof names[0] };

const char *clast_export_format_name(clast_export_format format)
{
    return (unsigned)format < N_FORMAT ? names[format] : "unknown";
}

clast_export_format clast_export_format_of_path(const char *path)
{
    if (path == NULL) {
        return (clast_export_format){0};
    }
    for (int f = 1; f < N_FORMAT; ++f) {
        if (clx_path_is(path, names[f])) {
            return (clast_export_format)f;
        }
    }
    return CLAST_EXPORT_ANY;
}

static bool has_surfaces(clast_export_format format, bool points)
{
    return format == CLAST_EXPORT_STL || format == CLAST_EXPORT_OBJ || format == CLAST_EXPORT_PLY ||
           (format == CLAST_EXPORT_VTU && !points);
}

static clast_status write_body(clx_export *e, clast_export_format format)
{
    switch (format) {
    case CLAST_EXPORT_VTU:
        return e->options->points ? clx_export_vtu_points(e) : clx_export_vtu_surfaces(e);
    case CLAST_EXPORT_STL:
        return clx_export_stl(e);
    case CLAST_EXPORT_OBJ:
        return clx_export_obj(e);
    case CLAST_EXPORT_PLY:
        return clx_export_ply(e);
    case CLAST_EXPORT_DATA:
        return clx_export_data(e);
    case CLAST_EXPORT_TXT:
        return clx_export_text(e);
    case CLAST_EXPORT_VORO:
        return clx_export_voro(e);
    case CLAST_EXPORT_XYZD:
        return clx_export_xyzd(e);
    default:
        return clx_export_dump(e);
    }
}

/// Written lengths per length of the assembly.
static clast_status find_factor(clx_export *e, const char *path)
{
    clast_status status = CLAST_OK;
    const char *own = clx_export_unit(e->assembly);
    double from = 1.0;
    double to = 1.0;
    if (strcmp(own, e->unit) == 0) {
        return CLAST_OK;
    }
    CLX_CHECK(strcmp(own, "model") != 0, CLAST_E_USAGE,
              "%s: coordinates in %s are asked for, and this assembly's unit is not known", path,
              e->unit);
    CLX_TRY(clast_unit_factor(own, "m", &from));
    CLX_TRY(clast_unit_factor(e->unit, "m", &to));
    e->parts.factor = from / to;
done:
    return status;
}

/// What facets hold of the clumps, whose balls are written whole, one within another; or of the
/// spheres and ellipsoids, whose vertices lie on them. NaN of none.
static double facet_ratio(const clx_export *e, bool of_clumps)
{
    double all = 0.0;
    double held = 0.0;
    for (int32_t i = 0; i < e->assembly->n_grain; ++i) {
        const int32_t s = e->assembly->shape_id[i];
        const clast_shape *shape = &e->assembly->shape[s];
        if (of_clumps ? shape->kind == CLAST_SHAPE_CLUMP : !clx_is_stood_for(shape)) {
            const double part = clast_mesh_volume(&e->parts.surface[s]);
            all += clx_grain_volume(e->assembly, i);
            held += clx_grain_volume(e->assembly, i) * part / shape->volume;
        }
    }
    return held / all;
}

static double ellipsoid_ratio(const clast_assembly *a)
{
    double all = 0.0;
    double held = 0.0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const clast_shape *shape = &a->shape[a->shape_id[i]];
        if (clx_is_stood_for(shape)) {
            all += clx_grain_volume(a, i);
            held += clx_grain_volume(a, i) * clx_ellipsoid_ratio(shape);
        }
    }
    return held / all;
}

static clast_status write_stream(clx_export *e, clast_export_format format, const char *path,
                                 clast_export_report *report)
{
    clast_status status = CLAST_OK;
    if (has_surfaces(format, e->options->points)) {
        CLX_TRY(clx_parts_make(e->assembly, e->options->level, &e->parts));
        CLX_TRY(find_factor(e, path));
        report->facet_ratio = facet_ratio(e, false);
        report->clump_ratio = facet_ratio(e, true);
    } else if (format == CLAST_EXPORT_DUMP || format == CLAST_EXPORT_DATA) {
        report->ellipsoid_ratio = ellipsoid_ratio(e->assembly);
    }
    CLX_TRY(clx_file_begin(path, &e->file));
    CLX_TRY(write_body(e, format));
    report->n_vertex = e->parts.n_vert;
    report->n_triangle = e->parts.n_tri;
    CLX_TRY(clx_file_commit(&e->file));
done:
    clx_file_abandon(&e->file);
    clx_parts_free(&e->parts);
    return status;
}

/// A format that needs densities is not given ones that are made up.
static clast_status check_density(const clx_export *e, clast_export_format format, const char *path)
{
    const bool is_data = format == CLAST_EXPORT_DATA;
    return e->has_density || (!is_data && format != CLAST_EXPORT_CONF)
               ? CLAST_OK
               : clx_fail(CLAST_E_USAGE,
                          "%s: %s a density of each grain, and theirs is not known; give it "
                          "(--density), or write .dump or .csv",
                          path, is_data ? "LAMMPS's data files need" : "Rockable needs");
}

/// What is told of the ids.
static void find_ids(const clast_assembly *a, clast_export_report *report)
{
    const clast_export_format f = report->format;
    const bool is_counted =
        f == CLAST_EXPORT_DUMP || f == CLAST_EXPORT_DATA || f == CLAST_EXPORT_VORO;
    report->has_ids = is_counted || f == CLAST_EXPORT_VTU || f == CLAST_EXPORT_OBJ ||
                      f == CLAST_EXPORT_CSV || f == CLAST_EXPORT_JSON;
    report->ids_kept = report->has_ids && a->has_ids;
    report->id_offset = is_counted ? clx_export_id_offset(a) : 0;
}

static clast_status write_table(const clast_assembly *assembly, clast_export_format format,
                                const char *path)
{
    clast_table table = {0};
    clast_status status = clast_assembly_table(assembly, &table);
    if (status == CLAST_OK) {
        status = format == CLAST_EXPORT_CSV ? clast_table_write_csv(&table, path)
                                            : clast_table_write_json(&table, path);
    }
    clast_table_free(&table);
    return status;
}

/// 3MF is small work for printers: one merged surface.
static clast_status write_threemf(const clast_assembly *assembly, int level, const char *path,
                                  clast_export_report *report)
{
    clast_status status = CLAST_OK;
    clast_mesh all = {0};
    clx_export e = {.assembly = assembly};
    const clast_mesh_write_options options = {
        .format = CLAST_MESH_3MF, .unit = clx_export_unit(assembly), .name = "grains"};
    CLX_CHECK(strcmp(options.unit, "model") != 0, CLAST_E_USAGE,
              "%s: 3MF is in millimetres, and this assembly's unit is not known", path);
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        CLX_TRY(clast_assembly_grain_surface(assembly, i, level, &all));
    }
    CLX_TRY(clx_parts_make(assembly, level, &e.parts));
    CLX_TRY(clast_mesh_write(&all, path, &options));
    report->n_vertex = all.n_vert;
    report->n_triangle = all.n_tri;
    report->facet_ratio = facet_ratio(&e, false);
    report->clump_ratio = facet_ratio(&e, true);
done:
    clx_parts_free(&e.parts);
    clast_mesh_free(&all);
    return status;
}

clast_status clast_assembly_write(const clast_assembly *assembly, const char *path,
                                  const clast_export_options *options, clast_export_report *report)
{
    CLX_ARGUMENTS(assembly, path);
    CLX_WHOLE(assembly, assembly);
    if (options != NULL && options->values != NULL) {
        CLX_WHOLE(table, options->values);
    }
    static const clast_export_options usual = {.level = 3};
    clast_status status = CLAST_OK;
    const clast_export_options *o = options != NULL ? options : &usual;
    const char *own = clx_export_unit(assembly);
    clx_export e = {.assembly = assembly,
                    .options = o,
                    .unit = o->unit != NULL ? o->unit : own,
                    .has_density = clx_has_density(assembly)};
    clast_export_report made = {.facet_ratio = NAN, .clump_ratio = NAN, .ellipsoid_ratio = NAN};
    made.format = o->format != CLAST_EXPORT_ANY ? o->format : clast_export_format_of_path(path);
    CLX_CHECK(made.format != CLAST_EXPORT_ANY, CLAST_E_USAGE,
              "%s: no export by that name; write .vtu, .stl, .obj, .ply, .3mf, .csv, .json, .dump, "
              ".data, "
              ".txt, .voro, .xyzd or .conf",
              path);
    CLX_CHECK(!o->points || made.format == CLAST_EXPORT_VTU, CLAST_E_USAGE,
              "%s: points are for .vtu only; .csv and .dump hold poses anyway", path);
    CLX_CHECK(o->unit == NULL || made.format == CLAST_EXPORT_STL ||
                  made.format == CLAST_EXPORT_OBJ || made.format == CLAST_EXPORT_PLY,
              CLAST_E_USAGE, "%s: its unit is %s; one can be chosen for .stl, .obj and .ply", path,
              made.format == CLAST_EXPORT_3MF ? "mm, as the format demands" : own);
    CLX_CHECK(o->values == NULL ||
                  (made.format == CLAST_EXPORT_VTU && o->values->n_row == assembly->n_grain),
              CLAST_E_USAGE, "%s: values are for .vtu, a row for each of its %d grains", path,
              assembly->n_grain);
    CLX_TRY(check_density(&e, made.format, path));
    find_ids(assembly, &made);
    made.unit = made.format == CLAST_EXPORT_3MF ? "mm" : e.unit;
    if (made.format == CLAST_EXPORT_CSV || made.format == CLAST_EXPORT_JSON) {
        CLX_TRY(write_table(assembly, made.format, path));
    } else if (made.format == CLAST_EXPORT_CONF) {
        CLX_TRY(clx_export_rockable(assembly, path));
    } else if (made.format == CLAST_EXPORT_3MF) {
        CLX_TRY(write_threemf(assembly, o->level, path, &made));
    } else {
        CLX_TRY(write_stream(&e, made.format, path, &made));
    }
    if (report != NULL) {
        *report = made;
    }
done:
    return status;
}

static void write_escaped(clx_file *file, const char *text)
{
    for (; *text != '\0'; ++text) {
        switch (*text) {
        case '&':
            (void)clx_file_print(file, "&amp;");
            break;
        case '<':
            (void)clx_file_print(file, "&lt;");
            break;
        case '"':
            (void)clx_file_print(file, "&quot;");
            break;
        default:
            (void)clx_file_write(file, text, 1);
        }
    }
}

clast_status clast_pvd_write(const char *path, int64_t n, const double *time,
                             const char *const *name)
{
    CLX_ARGUMENTS(path);
    CLX_ARRAY(time, n);
    CLX_ARRAY(name, n);
    for (int64_t i = 0; i < n; ++i) {
        CLX_ARGUMENTS(name[i]);
    }
    clast_status status = CLAST_OK;
    clx_file file = {0};
    CLX_TRY(clx_file_begin(path, &file));
    (void)clx_file_print(&file, "<?xml version=\"1.0\"?>\n"
                                "<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n");
    for (int64_t i = 0; i < n; ++i) {
        char text[CLX_NUMBER_SIZE];
        (void)clx_number_format(time[i], text);
        (void)clx_file_print(&file, "<DataSet timestep=\"%s\" part=\"0\" file=\"", text);
        write_escaped(&file, name[i]);
        (void)clx_file_print(&file, "\"/>\n");
    }
    (void)clx_file_print(&file, "</Collection>\n</VTKFile>\n");
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    return status;
}

/// Whether some surface is made from a formula, and shows how finely.
static bool has_round(const clast_assembly *assembly)
{
    bool has = assembly == NULL;
    for (int32_t i = 0; assembly != NULL && i < assembly->n_shape; ++i) {
        has = has || assembly->shape[i].mesh.n_tri == 0;
    }
    return has;
}

const clast_idle *clast_export_given_idle(const clast_export_given *given, clast_idle *rules)
{
    if (given == NULL || rules == NULL ||
        (given->assembly != NULL && clx_assembly_fault(given->assembly) != NULL)) {
        return NULL;
    }
    const clast_export_format format = given->format;
    const bool is_ply = format == CLAST_EXPORT_PLY;
    const bool is_surface = is_ply || format == CLAST_EXPORT_STL || format == CLAST_EXPORT_OBJ ||
                            format == CLAST_EXPORT_3MF;
    const bool is_bare = is_surface || format == CLAST_EXPORT_TXT || format == CLAST_EXPORT_VORO ||
                         format == CLAST_EXPORT_XYZD;
    const clast_idle made[CLAST_N_IDLE] = {
        {given->has_table, "level|points|colour|unit|density|columns|diameter", "with --table"},
        {is_bare, "density",
         "in a file without densities: .data, .dump, .conf, .csv, .json and .vtu have them"},
        {!is_surface && format != CLAST_EXPORT_VTU, "level",
         "in a file without surfaces: .stl, .obj, .ply, .3mf and .vtu have them"},
        {given->points, "level", "with --points: they have no surfaces"},
        {!is_ply, "colour", "but in a .ply"},
        {given->is_run, "columns|diameter", "with a run, which knows its grains"},
        {!has_round(given->assembly), "level", "without spheres and ellipsoids"}};
    return clx_idle_copy(made, rules);
}
