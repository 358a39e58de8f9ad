// Names of the surfaces that clast_grains_read writes: the file's, whatever its folder, and a
// label's number. Before anything is measured, none may take another's place.
#include "io/grains_file.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include "io/points.h"
#include "io/spheres_table.h"
#include <clast/table.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/// How a file's surfaces are named: not at all (tables), by the file, by the file and a label.
typedef enum { NAMES_UNKNOWN, NAMES_NONE, NAMES_FILE, NAMES_LABELS } surface_names;

/// A file's stem, and of "scan#3" the part that a volume's stem could be.
typedef struct {
    clx_grains_task *task;
    const char *stem;
    int n_stem, n_volume;
    int32_t order; ///< of the file
    surface_names names;
} surface_name;

static surface_names names_of_kind(clast_grains_kind kind)
{
    switch (kind) {
    case CLAST_GRAINS_SURFACE:
    case CLAST_GRAINS_SERIES:
    case CLAST_GRAINS_POINTS:
        return NAMES_FILE;
    case CLAST_GRAINS_VOXELS:
        return NAMES_LABELS;
    default:
        return NAMES_NONE;
    }
}

/// Points have a surface, their hull; rows of lengths and clumps have none.
static clast_status read_kind(clx_grains_task *task, surface_names *names)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    CLX_TRY(clx_file_read_all(task->path, INT64_C(1) << 34, &task->bytes, &task->n_byte));
    const clast_grains_kind kind = clx_grains_kind_of(task);
    *names = names_of_kind(kind);
    if (kind == CLAST_GRAINS_AUTO) { // files with faces are refused when they are read
        bool has_faces = false;
        CLX_TRY(clx_points_parse(task->path, task->bytes, (size_t)task->n_byte, NULL, &table,
                                 &has_faces));
        *names = names_of_kind(clx_grains_kind_of_columns(task, &table));
    }
done:
    clast_table_free(&table);
    clx_free(task->bytes);
    task->bytes = NULL;
    return status;
}

/// Looks into the file once, for what it is; one that cannot be read has its own fault later.
static clast_status find_names(surface_name *name)
{
    const clast_grains_kind kind = name->task->options->kind;
    if (name->names != NAMES_UNKNOWN) {
        return CLAST_OK;
    }
    name->names = names_of_kind(kind);
    const clast_status status =
        kind == CLAST_GRAINS_AUTO ? read_kind(name->task, &name->names) : CLAST_OK;
    return status == CLAST_E_MEMORY ? status : CLAST_OK;
}

static surface_name name_surface(clx_grains_task *task, int32_t order)
{
    surface_name s = {.task = task, .stem = clx_path_name(task->path), .order = order};
    s.n_stem = clx_path_stem_length(task->path);
    int n = s.n_stem;
    while (n > 0 && s.stem[n - 1] >= '0' && s.stem[n - 1] <= '9') {
        --n;
    }
    s.n_volume = n > 1 && n < s.n_stem && s.stem[n - 1] == '#' ? n - 1 : s.n_stem;
    return s;
}

static int compare_text(const char *a, int n_a, const char *b, int n_b)
{
    const int order = n_a != n_b ? 0 : strncmp(a, b, (size_t)n_a);
    return order != 0 ? order : (n_a > n_b) - (n_a < n_b);
}

/// By the volume's stem, in it by the whole stem (its own first), then as the files were given.
static int compare_names(const void *a, const void *b)
{
    const surface_name *p = a;
    const surface_name *q = b;
    int order = compare_text(p->stem, p->n_volume, q->stem, q->n_volume);
    order = order != 0 ? order : compare_text(p->stem, p->n_stem, q->stem, q->n_stem);
    return order != 0 ? order : (p->order > q->order) - (p->order < q->order);
}

/// Refuses two files of one stem, or a volume and a file named as a label of it.
static clast_status check_pair(surface_name *a, surface_name *b)
{
    clast_status status = CLAST_OK;
    const surface_name *first = a->order < b->order ? a : b;
    const surface_name *second = first == a ? b : a;
    CLX_TRY(find_names(a));
    CLX_TRY(find_names(b));
    const bool clash = a->n_stem < b->n_stem ? a->names == NAMES_LABELS && b->names == NAMES_FILE
                                             : a->names == b->names && a->names != NAMES_NONE;
    CLX_CHECK(!clash, CLAST_E_USAGE,
              "surfaces: %s and %s would both write %s/%.*s%s.ply; rename one, or write them into "
              "two folders",
              first->task->path, second->task->path, a->task->options->folder, b->n_stem, b->stem,
              b->names == NAMES_LABELS ? "#LABEL" : "");
done:
    return status;
}

/// Files of one volume's stem: the first n_own are called that, the others as labels of it.
static clast_status check_group(surface_name *name, int32_t n)
{
    clast_status status = CLAST_OK;
    int32_t n_own = 0;
    while (n_own < n && name[n_own].n_stem == name[n_own].n_volume) {
        ++n_own;
    }
    for (int32_t i = 1; i < n; ++i) {
        for (int32_t k = 0; k < i && k < n_own; ++k) {
            CLX_TRY(check_pair(&name[k], &name[i]));
        }
        for (int32_t k = i - 1; k >= n_own && compare_text(name[k].stem, name[k].n_stem,
                                                           name[i].stem, name[i].n_stem) == 0;
             --k) {
            CLX_TRY(check_pair(&name[k], &name[i]));
        }
    }
done:
    return status;
}

clast_status clx_grains_check_surfaces(clx_grains_task *task, int32_t n_task)
{
    clast_status status = CLAST_OK;
    surface_name *name = NULL;
    const char *folder = n_task > 0 ? task[0].options->folder : "."; // one for all
    char inside[CLX_PATH_LIMIT];
    CLX_TRY(clx_alloc(&name, n_task, sizeof *name));
    for (int32_t i = 0; i < n_task; ++i) {
        name[i] = name_surface(&task[i], i);
    }
    qsort(name, (size_t)n_task, sizeof *name, compare_names);
    for (int32_t i = 0, end = 0; i < n_task; i = end) {
        while (end < n_task && compare_text(name[i].stem, name[i].n_volume, name[end].stem,
                                            name[end].n_volume) == 0) {
            ++end;
        }
        CLX_TRY(check_group(&name[i], end - i));
    }
    CLX_TRY(clx_path_join(inside, folder, "."));
    CLX_CHECK(access(inside, W_OK | X_OK) == 0, CLAST_E_DISK, "cannot write surfaces into %s: %s",
              folder, clx_errno_text());
done:
    clx_free(name);
    return status;
}
