// Grains from files: finds out what a file holds, makes its grains' surfaces, measures them.
//
// Each file is one task; a task keeps its grains and faults to itself, and the results are joined
// in the order of the files, so that they do not depend on the number of threads.
#include "io/grains_file.h"

#include "base/alloc.h"
#include "base/column_unit.h"
#include "base/field.h"
#include "base/file.h"
#include "base/monitor.h"
#include "base/parallel.h"
#include "base/path.h"
#include "geom/check.h"
#include "io/points.h"
#include "io/spheres_table.h"
#include <clast/cloud.h>
#include <clast/field.h>
#include <clast/form.h>
#include <clast/harmonics.h>
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <clast/table.h>
#include <clast/volume.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

static const int64_t LARGEST_FILE = INT64_C(1) << 34;

const char *clast_grains_kind_name(clast_grains_kind kind)
{
    static const char *const names[] = {"auto",   "surface", "series", "voxels",
                                        "points", "table",   "clump"};
    return (int)kind >= 0 && kind <= CLAST_GRAINS_CLUMP ? names[kind] : "?";
}

static void faults_free(clast_grain_fault *fault, int64_t n)
{
    for (int64_t i = 0; i < n; ++i) {
        clx_free(fault[i].text);
    }
    clx_free(fault);
}

void clast_grains_free(clast_grains *grains)
{
    if (grains == NULL) {
        return;
    }
    for (int64_t i = 0; i < grains->n; ++i) {
        clx_free(grains->record[i].name);
    }
    clx_free(grains->record);
    faults_free(grains->fault, grains->n_fault);
    faults_free(grains->note, grains->n_note);
    *grains = (clast_grains){0};
}

/// Keeps a line about a file in a list of faults or notes.
static clast_status add_line(clast_grain_fault **list, int64_t *n, int64_t *capacity,
                             clast_status about, const char *path, const char *text)
{
    clast_status status = CLAST_OK;
    char *copy = NULL;
    const size_t size = strlen(path) + strlen(text) + 3;
    const bool is_named = strncmp(text, path, strlen(path)) == 0;
    CLX_TRY(clx_grow(list, capacity, *n + 1, sizeof **list));
    CLX_TRY(clx_alloc(&copy, (int64_t)size, 1));
    (void)snprintf(copy, size, "%s%s%s", is_named ? "" : path, is_named ? "" : ": ", text);
    (*list)[(*n)++] = (clast_grain_fault){about, copy};
done:
    return status;
}

/// Keeps the thread's error text as a fault of the file; memory trouble is returned instead.
static clast_status note_fault(clx_grains_task *task, clast_status about)
{
    if (about == CLAST_E_MEMORY || about == CLAST_E_STOPPED) {
        return about;
    }
    return add_line(&task->grains.fault, &task->grains.n_fault, &task->fault_capacity, about,
                    task->path, clast_error_detail());
}

clast_status clx_grains_note(clx_grains_task *task, const char *text)
{
    return add_line(&task->grains.note, &task->grains.n_note, &task->note_capacity, CLAST_OK,
                    task->path, text);
}

clast_status clx_grains_add(clx_grains_task *task, const char *suffix, clast_grain_record **record)
{
    clast_status status = CLAST_OK;
    char *name = NULL;
    const size_t size = strlen(task->path) + strlen(suffix) + 1;
    CLX_TRY(clx_grow(&task->grains.record, &task->record_capacity, task->grains.n + 1,
                     sizeof *task->grains.record));
    CLX_TRY(clx_alloc(&name, (int64_t)size, 1));
    (void)snprintf(name, size, "%s%s", task->path, suffix);
    *record = &task->grains.record[task->grains.n++];
    **record = (clast_grain_record){.name = name, .has_surface = true, .has_size = true};
done:
    return status;
}

/// Writes a grain's surface into the folder, under the file's name without its extension.
static clast_status write_surface(const clx_grains_task *task, const char *suffix,
                                  const clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    clast_mesh hull = {0};
    char *path = NULL;
    const char *base = clx_path_name(task->path);
    const int n_base = clx_path_stem_length(task->path);
    const char *folder = task->options->folder;
    const size_t size = strlen(folder) + (size_t)n_base + strlen(suffix) + 7;
    CLX_TRY(clx_alloc(&path, (int64_t)size, 1));
    (void)snprintf(path, size, "%s/%.*s%s.ply", folder, n_base, base, suffix);
    if (task->options->hull || mesh->n_tri == 0) {
        CLX_TRY(clast_mesh_hull(mesh, &hull));
    }
    const char *unit = task->unit[0] != '\0' ? task->unit : task->options->unit;
    const clast_mesh_write_options options = {.unit =
                                                  unit != NULL && unit[0] != '\0' ? unit : NULL};
    CLX_TRY(clast_mesh_write(hull.n_tri > 0 ? &hull : mesh, path, &options));
done:
    clx_free(path);
    clast_mesh_free(&hull);
    return status;
}

/// Keeps a line about what a surface's measures mean.
static clast_status warn(clx_grains_task *task, const char *text)
{
    return add_line(&task->grains.note, &task->grains.n_note, &task->note_capacity,
                    CLAST_E_GEOMETRY, task->path, text);
}

/// Tells a surface of a file that is not one grain.
static clast_status note_bodies(clx_grains_task *task, const clx_doubles *found)
{
    char text[160];
    const bool is_known = found->n_intersection == 0 && found->intersection_complete;
    const int32_t n =
        is_known ? found->n_body : found->n_parted; // of cuts nobody knows what they join
    if (n < 2) {
        return CLAST_OK;
    }
    (void)snprintf(
        text, sizeof text,
        "%s%d bodies that do not hang together, measured as one grain; clast mesh repair "
        "--keep largest keeps one",
        is_known ? "" : "at least ", n);
    return warn(task, text);
}

/// Tells walls inside a surface: written once for each side they leave the volume right, but not
/// what follows from the area.
static clast_status note_walls(clx_grains_task *task, const clast_mesh *mesh,
                               const clx_doubles *found)
{
    clast_status status = CLAST_OK;
    char cure[400] = "";
    char text[640];
    if (found->n_wall == 0) {
        return CLAST_OK;
    }
    CLX_TRY(clast_mesh_cure(mesh, task->path, sizeof cure, cure));
    (void)snprintf(text, sizeof text,
                   "%d of its triangles %s a wall inside it, written once for each side: area, "
                   "sphericity and roundness count it; %s%s",
                   found->n_wall, found->n_wall == 1 ? "is" : "are",
                   cure[0] == '\0' ? "see clast mesh check" : "drop it: ", cure);
    CLX_TRY(warn(task, text));
done:
    return status;
}

/// Tells a surface of a file whose volume counts a region twice, or whose area a wall; those made
/// here count each once.
static clast_status note_doubles(clx_grains_task *task, clast_grains_kind kind,
                                 const clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    clx_doubles found = {0};
    char words[200];
    char cure[400] = "";
    char text[640];
    if (kind != CLAST_GRAINS_SURFACE || mesh->n_tri == 0) {
        return CLAST_OK;
    }
    CLX_TRY(clx_find_doubles(mesh, &found));
    CLX_TRY(note_bodies(task, &found));
    clx_doubles_words(&found, sizeof words, words);
    if (words[0] == '\0') {
        status = note_walls(task, mesh, &found);
        goto done;
    }
    if (found.n_flat > 0 || (found.n_intersection == 0 && found.intersection_complete)) {
        CLX_TRY(clast_mesh_cure(mesh, task->path, sizeof cure, cure));
    }
    (void)snprintf(text, sizeof text, "%s; %s%s", words,
                   cure[0] == '\0' ? "see clast mesh check"
                   : (found.n_flat > 0 ? found.n_flat : found.n_doubled + found.n_repeated) == 1
                       ? "drop it: "
                       : "drop them: ",
                   cure);
    CLX_TRY(warn(task, text));
done:
    return status;
}

/// Tells what a weld moved by more than a file's rounding.
static clast_status note_weld(clx_grains_task *task, const clast_mesh *welded,
                              const clast_mesh_repair_report *weld)
{
    char text[160];
    clx_weld_words(welded, weld, sizeof text, text);
    return text[0] != '\0' ? warn(task, text) : CLAST_OK;
}

static clast_status measure_grain(clx_grains_task *task, clast_grains_kind kind,
                                  const clast_mesh *mesh, clast_grain *grain)
{
    clast_status status = CLAST_OK;
    clast_mesh welded = {0};
    clast_mesh_repair_report weld = {0};
    if (task->options->hull || mesh->n_tri == 0) {
        CLX_TRY(clast_grain_measure_hull(mesh, grain));
        return isfinite(grain->hull_volume_added) ? note_doubles(task, kind, mesh) : CLAST_OK;
    }
    status = clast_grain_measure(mesh, grain);
    if (status == CLAST_E_GEOMETRY) { // perhaps only seams: vertices that rounding has parted
        CLX_TRY(clast_mesh_copy(mesh, &welded));
        CLX_TRY(clast_mesh_weld_auto(&welded, &weld));
        CLX_TRY(clast_mesh_require_solid(&welded, task->path, "measure its hull with --hull"));
        status = clast_grain_measure(&welded, grain);
    }
    CLX_TRY(status);
    CLX_TRY(note_weld(task, welded.n_tri > 0 ? &welded : mesh, &weld));
    CLX_TRY(note_doubles(task, kind, welded.n_tri > 0 ? &welded : mesh));
done:
    clast_mesh_free(&welded);
    return status;
}

/// Measures a surface (or the hull of points) and keeps it.
static clast_status read_mesh(clx_grains_task *task, clast_grains_kind kind, const char *suffix,
                              const clast_mesh *mesh, int64_t n_voxel)
{
    clast_status status = CLAST_OK;
    clast_grain grain;
    clast_grain_record *record = NULL;
    CLX_TRY(measure_grain(task, kind, mesh, &grain));
    if (task->options->folder != NULL) {
        CLX_TRY(write_surface(task, suffix, mesh));
    }
    CLX_TRY(clx_grains_add(task, suffix, &record));
    record->kind = kind;
    record->n_voxel = n_voxel;
    record->grain = grain;
done:
    return status;
}

/// How much of the form lies in the series' last degrees, and beyond those used.
static void read_power(const clast_harmonics *series, int32_t degree, clast_grain_record *record)
{
    const int32_t used = degree < 0 || degree > series->degree ? series->degree : degree;
    const double form = clast_harmonics_power(series, 1, series->degree);
    const int32_t last = used > 2 ? used - 1 : 1; // degree 0 is size, not form
    record->degree = used;
    record->power_last = form > 0.0 ? clast_harmonics_power(series, last, used) / form : 0.0;
    record->power_cut =
        form > 0.0 ? clast_harmonics_power(series, used + 1, series->degree) / form : 0.0;
}

static clast_status read_series(clx_grains_task *task)
{
    clast_status status = CLAST_OK;
    const clast_grains_options *o = task->options;
    clast_harmonics series = {0};
    clast_mesh mesh = {0};
    clast_grain grain;
    clast_grain_record *record = NULL;
    CLX_TRY(clast_harmonics_parse(task->bytes, (size_t)task->n_byte, &series));
    if (o->hull || o->folder != NULL) {
        CLX_TRY(clast_harmonics_mesh(&series, o->degree, o->level, &mesh));
    }
    if (o->hull) {
        CLX_TRY(read_mesh(task, CLAST_GRAINS_SERIES, "", &mesh, 0));
        read_power(&series, o->degree, &task->grains.record[task->grains.n - 1]);
        goto done;
    }
    CLX_TRY(clast_harmonics_measure(&series, o->degree, o->level, &grain));
    if (o->folder != NULL) {
        CLX_TRY(write_surface(task, "", &mesh));
    }
    CLX_TRY(clx_grains_add(task, "", &record));
    record->kind = CLAST_GRAINS_SERIES;
    record->grain = grain;
    read_power(&series, o->degree, record);
done:
    clast_mesh_free(&mesh);
    clast_harmonics_free(&series);
    return status;
}

static clast_status read_label(clx_grains_task *task, const clast_voxels *voxels,
                               const clast_voxel_label *label, clast_grains_kind kind,
                               const double offset[3], bool *is_parted)
{
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    char suffix[24] = "";
    if (kind == CLAST_GRAINS_VOXELS) {
        (void)snprintf(suffix, sizeof suffix, "#%d", label->label);
    }
    CLX_TRY(task->options->hull ? clast_voxels_points(voxels, label, &mesh)
                                : clast_voxels_surface(voxels, label, &mesh));
    clast_mesh_transform(&mesh, 1.0, (double[4]){1.0, 0.0, 0.0, 0.0}, offset);
    CLX_TRY(read_mesh(task, kind, suffix, &mesh, label->n_voxel));
    task->grains.record[task->grains.n - 1].is_smoothed =
        !task->options->hull && voxels->grey == NULL;
    CLX_TRY(clx_grains_find_parted(&mesh, is_parted));
    if (task->options->hull) { // of points; what it adds is told against the voxels
        clast_grain *grain = &task->grains.record[task->grains.n - 1].grain;
        const double *e = voxels->edge;
        grain->hull_volume_added =
            grain->volume / ((double)label->n_voxel * e[0] * e[1] * e[2]) - 1.0;
    }
done:
    clast_mesh_free(&mesh);
    return status;
}

/// A grain at the volume's border, which may cut it; a volume cropped to its one grain cuts
/// nothing.
static bool is_at_border(const clast_voxels *voxels, const clast_voxel_label *label)
{
    int n_side = 0;
    for (int k = 0; k < 3; ++k) {
        n_side += (label->low[k] == 0) + (label->high[k] == voxels->n[k] - 1);
    }
    return n_side > 0 && n_side < 6;
}

/// Labels that a line names, the first ten of them.
typedef struct {
    int32_t n;
    char names[128];
} label_list;

static void add_label(label_list *list, int32_t label)
{
    const size_t at = strlen(list->names);
    if (list->n < 10) {
        (void)snprintf(list->names + at, sizeof list->names - at, " #%d", label);
    } else if (list->n == 10) {
        (void)snprintf(list->names + at, sizeof list->names - at, " ...");
    }
    ++list->n;
}

/// "BEFORE 3 of 57 grains AFTER: #2 #5 #9", if there are any.
static clast_status warn_of(clx_grains_task *task, const label_list *list, int32_t n,
                            const char *before, const char *after)
{
    char text[320];
    if (list->n == 0) {
        return CLAST_OK;
    }
    (void)snprintf(text, sizeof text, "%s%d of %d grains%s:%s", before, list->n, n, after,
                   list->names);
    return warn(task, text);
}

static clast_status read_voxels(clx_grains_task *task, const clast_voxels *voxels,
                                clast_grains_kind kind, const double offset[3])
{
    clast_status status = CLAST_OK;
    clast_voxel_label *labels = NULL;
    int32_t n = 0;
    CLX_TRY(clast_voxels_labels(voxels, &labels, &n));
    CLX_CHECK(n > 0, CLAST_E_GEOMETRY, "all voxels are 0: there is no grain");
    int32_t n_small = 0;
    label_list cut = {0};
    label_list parted = {0};
    for (int32_t i = 0; i < n; ++i) {
        bool is_parted = false;
        if (labels[i].n_voxel < task->options->least_voxels) {
            ++n_small;
            continue;
        }
        const clast_status one = read_label(task, voxels, &labels[i], kind, offset, &is_parted);
        if (is_parted) {
            add_label(&parted, labels[i].label);
        }
        if (kind == CLAST_GRAINS_VOXELS && is_at_border(voxels, &labels[i])) {
            add_label(&cut, labels[i].label);
        }
        if (one != CLAST_OK) {
            CLX_TRY(note_fault(task, one)); // the other labels may do
        }
    }
    if (n_small > 0) {
        char text[128];
        (void)snprintf(text, sizeof text, "%d of %d grains left out: fewer than %lld voxels",
                       n_small, n, (long long)task->options->least_voxels);
        CLX_TRY(clx_grains_note(task, text));
    }
    CLX_TRY(warn_of(task, &cut, n, "the border of the volume may cut ", ""));
    CLX_TRY(warn_of(task, &parted, n, "",
                    " are several bodies that do not hang together, each measured as one"));
done:
    clast_voxels_labels_free(labels);
    return status;
}

static bool has_dataset(const clx_grains_task *task)
{
    return task->options->dataset != NULL && task->options->dataset[0] != '\0';
}

/// Keeps the name of a file's unit for the surfaces written; 0: it says none.
static void keep_unit(clx_grains_task *task, double unit_m)
{
    static const char *const names[] = {"m", "cm", "mm", "um", "nm", "km", "in"};
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        double metre = 0.0;
        if (clast_unit_factor(names[k], "m", &metre) == CLAST_OK && metre == unit_m) {
            (void)snprintf(task->unit, sizeof task->unit, "%s", names[k]);
        }
    }
}

/// A volume of the formats of scanners, as labels.
static clast_status read_volume(clx_grains_task *task, clast_voxels *voxels, double *unit_m)
{
    clast_status status = CLAST_OK;
    const clast_grains_options *o = task->options;
    clast_volume volume = {0};
    if (has_dataset(task)) {
        CLX_TRY(clast_volume_read_h5(task->path, o->dataset, &o->volume, &volume));
    } else {
        CLX_TRY(clast_volume_parse(task->bytes, (size_t)task->n_byte, &o->volume, &volume));
    }
    *unit_m = volume.unit_m;
    clx_free(task->bytes); // the values are as large
    task->bytes = NULL;
    CLX_TRY(o->has_threshold ? clast_volume_parts(&volume, o->threshold, voxels)
                             : clast_volume_labels(&volume, voxels));
done:
    clast_volume_free(&volume);
    return status;
}

/// True for voxels in words: `Name: value` lines, then a whole number a voxel.
static bool is_voxel_text(const clx_grains_task *task)
{
    return !has_dataset(task) && task->options->volume.n[0] == 0 &&
           !clast_volume_is_known(task->bytes, (size_t)task->n_byte);
}

static clast_status read_voxel_file(clx_grains_task *task)
{
    clast_status status = CLAST_OK;
    clast_voxels voxels = {0};
    double unit_m = 0.0;
    if (is_voxel_text(task)) {
        CLX_TRY(clast_voxels_parse(task->bytes, (size_t)task->n_byte, &voxels));
    } else {
        CLX_TRY(read_volume(task, &voxels, &unit_m));
    }
    const int64_t first = task->grains.n;
    keep_unit(task, unit_m);
    CLX_TRY(read_voxels(task, &voxels, CLAST_GRAINS_VOXELS, (double[3]){0}));
    for (int64_t i = first; i < task->grains.n; ++i) {
        task->grains.record[i].unit_m = unit_m;
    }
done:
    clast_voxels_free(&voxels);
    return status;
}

/// Points: the hull, or with a spacing the surface of the cubes about them.
static clast_status read_points(clx_grains_task *task, const clast_mesh *points)
{
    clast_status status = CLAST_OK;
    clast_voxels voxels = {0};
    double low[3];
    if (task->options->spacing > 0.0 && !task->options->hull) {
        CLX_TRY(clast_voxels_of_points(points, task->options->spacing, &voxels, low));
        CLX_TRY(read_voxels(task, &voxels, CLAST_GRAINS_POINTS, low));
    } else {
        CLX_TRY(read_mesh(task, CLAST_GRAINS_POINTS, "", points, 0));
    }
done:
    clast_voxels_free(&voxels);
    return status;
}

/// The points of a table in the unit of its column x, with the metres in it; 0 if it says none.
static clast_status points_of_table(const clast_table *table, clast_mesh *points, double *unit_m)
{
    static const char *const names[3] = {"x", "y", "z"};
    clast_status status = CLAST_OK;
    const clast_column *x[3];
    clx_length_unit length[3];
    int n_unit = 0;
    for (int k = 0; k < 3; ++k) {
        x[k] = clx_column_find(table, names[k]);
        if ((x[k] == NULL || x[k]->number == NULL) && table->n_column == 3) {
            x[k] = &table->column[k]; // three columns without names
        }
        CLX_CHECK(x[k] != NULL && x[k]->number != NULL, CLAST_E_FORMAT,
                  "no column of numbers is called '%s'; points need x, y and z", names[k]);
        CLX_TRY(clx_column_length(x[k], false, &length[k]));
        n_unit += length[k].metre > 0.0;
    }
    CLX_CHECK(n_unit == 0 || n_unit == 3, CLAST_E_FORMAT,
              "%d of the 3 columns x, y, z say their unit of length; give all of them one, or none",
              n_unit);
    CLX_CHECK(table->n_row < INT32_MAX, CLAST_E_LIMIT, "%lld points are beyond 2^31",
              (long long)table->n_row);
    CLX_TRY(clast_mesh_alloc((int32_t)table->n_row, 0, points));
    for (int k = 0; k < 3; ++k) {
        const double factor =
            length[k].metre == length[0].metre ? 1.0 : length[k].metre / length[0].metre;
        for (int32_t i = 0; i < points->n_vert; ++i) {
            points->vert[i][k] = factor * x[k]->number[i];
        }
    }
    *unit_m = length[0].metre;
done:
    return status;
}

/// One grain of spheres that may overlap.
static clast_status read_clump(clx_grains_task *task, const clast_table *table)
{
    static const clast_packing_options guess = {0};
    clast_status status = CLAST_OK;
    clast_spheres spheres = {0};
    clast_grain grain;
    clast_grain_record *record = NULL;
    double unit_m = 0.0;
    bool mixes_units = false;
    CLX_CHECK(!task->options->hull && task->options->folder == NULL, CLAST_E_USAGE,
              "a clump of spheres has no hull of facets and no surface to write: leave out --hull "
              "and --surfaces");
    CLX_TRY(clx_spheres_of_table(table, &guess, &spheres, &unit_m, &mixes_units));
    CLX_TRY(clast_grain_measure_clump(&spheres, &grain));
    CLX_TRY(clx_grains_add(task, "", &record));
    record->kind = CLAST_GRAINS_CLUMP;
    record->in_metres = unit_m > 0.0;
    record->mixes_units = mixes_units;
    record->unit_m = unit_m;
    record->grain = grain;
done:
    clast_spheres_free(&spheres);
    return status;
}

/// Points joined by faces are a surface, and its form is not that of their hull.
static clast_status refuse_faces(const clx_grains_task *task)
{
    clast_status status = CLAST_OK;
    const bool is_asked = task->options->hull || task->options->spacing > 0.0;
    CLX_CHECK(is_asked || task->options->kind == CLAST_GRAINS_POINTS, CLAST_E_FORMAT,
              "a VTK file with faces, of which only the points are read: write the surface as STL, "
              "OBJ, PLY or OFF, or measure the points' hull with --kind points");
done:
    return status;
}

static clast_status read_delimited(clx_grains_task *task, clast_grains_kind kind)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    clast_mesh points = {0};
    bool has_faces = false;
    CLX_TRY(
        clx_points_parse(task->path, task->bytes, (size_t)task->n_byte, NULL, &table, &has_faces));
    kind = kind == CLAST_GRAINS_AUTO ? clx_grains_kind_of_columns(task, &table) : kind;
    if (kind == CLAST_GRAINS_CLUMP) {
        CLX_TRY(read_clump(task, &table));
    } else if (kind == CLAST_GRAINS_POINTS) {
        CLX_TRY(has_faces ? refuse_faces(task) : CLAST_OK);
        double unit_m = 0.0;
        CLX_TRY(points_of_table(&table, &points, &unit_m));
        keep_unit(task, unit_m);
        CLX_TRY(read_points(task, &points));
        for (int64_t i = 0; i < task->grains.n; ++i) {
            task->grains.record[i].unit_m = unit_m;
        }
    } else {
        CLX_TRY(clx_grains_of_table(task, &table));
    }
done:
    clast_mesh_free(&points);
    clast_table_free(&table);
    return status;
}

static clast_status read_surface(clx_grains_task *task, clast_mesh_format format)
{
    clast_mesh mesh = {0};
    clast_mesh_read_report report = {0};
    const int64_t first = task->grains.n;
    clast_status status =
        clast_mesh_parse(task->bytes, (size_t)task->n_byte, format, &mesh, &report);
    (void)snprintf(task->unit, sizeof task->unit, "%s", report.unit);
    if (status == CLAST_OK && mesh.n_tri == 0 && mesh.n_vert > 0) {
        status = read_points(task, &mesh);
    } else if (status == CLAST_OK) {
        status = read_mesh(task, CLAST_GRAINS_SURFACE, "", &mesh, 0);
    }
    for (int64_t i = first; i < task->grains.n && task->unit[0] != '\0'; ++i) {
        (void)clast_unit_factor(task->unit, "m", &task->grains.record[i].unit_m);
    }
    clast_mesh_free(&mesh);
    return status;
}

static clast_status read_file(clx_grains_task *task)
{
    clast_status status = CLAST_OK;
    clast_grains_kind kind = task->options->kind;
    CLX_TRY(clx_file_read_all(task->path, LARGEST_FILE, &task->bytes, &task->n_byte));
    kind = kind == CLAST_GRAINS_AUTO ? clx_grains_kind_of(task) : kind;
    switch (kind) {
    case CLAST_GRAINS_SURFACE:
        CLX_TRY(read_surface(task, clast_mesh_format_of_path(task->path)));
        break;
    case CLAST_GRAINS_SERIES:
        CLX_TRY(read_series(task));
        break;
    case CLAST_GRAINS_VOXELS:
        CLX_TRY(read_voxel_file(task));
        break;
    default:
        CLX_TRY(read_delimited(task, kind));
    }
done:
    clx_free(task->bytes);
    task->bytes = NULL;
    return status;
}

typedef struct {
    clx_grains_task *task;
    int64_t n;
    const clast_monitor *monitor; ///< the caller's: of worker 0 alone
    _Atomic int64_t n_done;
} reading;

static clast_status read_files(int64_t begin, int64_t end, int32_t worker, void *context)
{
    reading *r = context;
    clast_status status = CLAST_OK;
    for (int64_t i = begin; i < end; ++i) {
        CLX_CHECK(worker != 0 || !clx_monitor_stops(r->monitor), CLAST_E_STOPPED,
                  "stopped after %lld of %lld files; nothing is kept",
                  (long long)atomic_load(&r->n_done), (long long)r->n);
        status = read_file(&r->task[i]);
        status = status != CLAST_OK ? note_fault(&r->task[i], status) : status;
        if (status != CLAST_OK) {
            char why[256];
            (void)snprintf(why, sizeof why, "%s", clast_error_detail());
            return clx_fail(status, "%s: %s", r->task[i].path, why);
        }
        const int64_t n_done = atomic_fetch_add(&r->n_done, 1) + 1;
        if (worker == 0) {
            clx_monitor_report(r->monitor, "files", n_done, r->n);
        }
    }
done:
    return status;
}

/// Moves the results of all tasks into one, in order.
static clast_status join(clx_grains_task *task, int32_t n_task, clast_grains *grains)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    int64_t n_fault = 0;
    int64_t n_note = 0;
    for (int32_t i = 0; i < n_task; ++i) {
        n += task[i].grains.n;
        n_fault += task[i].grains.n_fault;
        n_note += task[i].grains.n_note;
    }
    CLX_TRY(clx_alloc(&grains->record, n, sizeof *grains->record));
    CLX_TRY(clx_alloc(&grains->fault, n_fault, sizeof *grains->fault));
    CLX_TRY(clx_alloc(&grains->note, n_note, sizeof *grains->note));
    for (int32_t i = 0; i < n_task; ++i) {
        clast_grains *from = &task[i].grains;
        for (int64_t k = 0; k < from->n; ++k) {
            grains->record[grains->n++] = from->record[k];
        }
        for (int64_t k = 0; k < from->n_fault; ++k) {
            grains->fault[grains->n_fault++] = from->fault[k];
        }
        for (int64_t k = 0; k < from->n_note; ++k) {
            grains->note[grains->n_note++] = from->note[k];
        }
        from->n = 0; // names and texts have moved
        from->n_fault = 0;
        from->n_note = 0;
    }
done:
    return status;
}

clast_status clast_grains_read(int32_t n_file, const char *const *path,
                               const clast_grains_options *options, const clast_monitor *monitor,
                               clast_grains *grains)
{
    CLX_ARGUMENTS(options, grains);
    CLX_ARRAY(path, n_file);
    for (int32_t i = 0; i < n_file; ++i) {
        CLX_ARGUMENTS(path[i]);
    }
    clast_status status = CLAST_OK;
    clx_grains_task *task = NULL;
    clast_grains made = {0};
    CLX_TRY(clx_alloc(&task, n_file, sizeof *task));
    for (int32_t i = 0; i < n_file; ++i) {
        task[i].path = path[i];
        task[i].options = options;
    }
    if (options->folder != NULL) {
        CLX_TRY(clx_grains_check_surfaces(task, n_file));
    }
    reading r = {.task = task, .n = n_file, .monitor = monitor};
    CLX_TRY(clx_parallel_try(n_file, 1, read_files, &r));
    clx_monitor_report(monitor, "files", n_file, n_file); // the last may be another worker's
    CLX_TRY(join(task, n_file, &made));
    *grains = made;
    made = (clast_grains){0};
done:
    for (int32_t i = 0; i < n_file && task != NULL; ++i) {
        clast_grains_free(&task[i].grains);
    }
    clx_free(task);
    clast_grains_free(&made);
    return status;
}

/// What the files hold may be known before they are read, where the kind is named.
const clast_idle *clast_grains_idle(const clast_grains_options *o, uint32_t kinds,
                                    clast_idle *rules)
{
    if (o == NULL || rules == NULL) {
        return NULL;
    }
    const bool is_named = o->kind != CLAST_GRAINS_AUTO;
    const char *const why = is_named ? "with this --kind" : "with files of these kinds";
    const bool is_kind = o->kind >= 0 && o->kind <= CLAST_GRAINS_CLUMP; // else refused by who reads
    const uint32_t named = is_kind ? 1U << (uint32_t)o->kind : UINT32_MAX;
    const uint32_t may_be = is_named ? named : kinds != 0 ? kinds : UINT32_MAX;
    const clast_idle made[CLAST_N_IDLE] = {
        {(may_be & 1U << CLAST_GRAINS_SERIES) == 0, "degree|level", why},
        {(may_be & 1U << CLAST_GRAINS_POINTS) == 0, "spacing", why},
        {(may_be & 1U << CLAST_GRAINS_VOXELS) == 0,
         "voxels|voxel_edge|dataset|threshold|least_voxels", why},
        {(may_be & 1U << CLAST_GRAINS_TABLE) == 0, "columns", why},
        {may_be == 1U << CLAST_GRAINS_TABLE, "axes|hull|surfaces", why},
        {o->volume.n[0] == 0, "voxel_type|big_endian|skip",
         "without --voxels: other volumes have a header"}};
    return clx_idle_copy(made, rules);
}
