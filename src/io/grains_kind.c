// What a file of grains holds, by its name and first bytes.
#include "io/grains_file.h"

#include "base/path.h"
#include "io/spheres_table.h"
#include "io/text.h"
#include <clast/mesh.h>
#include <clast/volume.h>

static bool has_dataset(const clx_grains_task *task)
{
    return task->options->dataset != NULL && task->options->dataset[0] != '\0';
}

static bool has_extension(const char *path, const char *const *list)
{
    for (; *list != NULL; ++list) {
        if (clx_path_is(path, *list)) {
            return true;
        }
    }
    return false;
}

/// What the first line with words is: a header of voxels, four numbers, three, or another.
static clast_grains_kind kind_of_text(const clx_grains_task *task)
{
    clx_text text = clx_text_begin(task->bytes, (size_t)task->n_byte, '#', false);
    clx_word word;
    double value;
    int n_number = 0;
    if (!clx_text_any_word(&text, &word)) {
        return CLAST_GRAINS_SURFACE;
    }
    if (clx_word_is(word, "xsize:")) {
        return CLAST_GRAINS_VOXELS;
    }
    do {
        if (!clx_word_number(word, &value)) {
            return CLAST_GRAINS_SURFACE;
        }
        ++n_number;
    } while (clx_text_word(&text, &word));
    if (n_number == 3) {
        return CLAST_GRAINS_POINTS;
    }
    return n_number == 4 ? CLAST_GRAINS_SERIES : CLAST_GRAINS_SURFACE;
}

clast_grains_kind clx_grains_kind_of(const clx_grains_task *task)
{
    if (has_dataset(task) || task->options->volume.n[0] > 0 ||
        clast_volume_is_known(task->bytes, (size_t)task->n_byte)) {
        return CLAST_GRAINS_VOXELS;
    }
    static const char *const delimited[] = {"csv", "tsv", "vtk", "vtp", "vtu", "dump", NULL};
    if (clast_mesh_format_of_path(task->path) != CLAST_MESH_ANY) {
        return CLAST_GRAINS_SURFACE;
    }
    if (has_extension(task->path, delimited)) {
        return CLAST_GRAINS_AUTO; // points or a table: by its columns
    }
    return kind_of_text(task);
}

clast_grains_kind clx_grains_kind_of_columns(const clx_grains_task *task, const clast_table *table)
{
    const char *columns = task->options->columns;
    if (columns != NULL && columns[0] != '\0') {
        return CLAST_GRAINS_TABLE;
    }
    if (clx_spheres_are_named(table)) {
        return CLAST_GRAINS_CLUMP;
    }
    return clx_points_are_named(table) ? CLAST_GRAINS_POINTS : CLAST_GRAINS_TABLE;
}
