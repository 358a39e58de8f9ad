// Frames of a run (frames.pvd, frames/*.vtu) as poses of the 3-D view's grains.
#include "report/frames.h"

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/number.h"
#include "base/path.h"
#include "io/points.h"
#include "math/sort.h"
#include "report/run.h"
#include <clast/shape.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { NAME_SIZE = 64, MOST_FRAMES = 240, BYTE_BUDGET = 12000000 };

/// Bytes a grain takes on the page; with its own number, shape and scale, which the end does not
/// tell.
enum { GRAIN_BYTES = 14, STRANGER_BYTES = 30 };
static const int64_t PVD_LIMIT = (int64_t)256 << 20;

typedef struct {
    double time;
    char name[NAME_SIZE];
} entry;

/// A grain's name and its place in the assembly.
typedef struct {
    int64_t id;
    int32_t place;
} named;

static void frame_free(clx_frame *frame)
{
    CLX_FREE(frame->grain, frame->shape, frame->position, frame->orientation, frame->scale);
    *frame = (clx_frame){0};
}

void clx_frames_free(clx_frames *frames)
{
    for (int32_t k = 0; frames->frame != NULL && k < frames->n; ++k) {
        frame_free(&frames->frame[k]);
    }
    clx_free(frames->frame);
    *frames = (clx_frames){0};
}

/// A frame's file as clast names it: frames/frame-000012.vtu, and nothing else.
static bool is_frame(const char *name, size_t n)
{
    static const char before[] = "frames/frame-";
    static const char after[] = ".vtu";
    const size_t least = sizeof before - 1 + 1 + sizeof after - 1;
    if (n < least || n >= NAME_SIZE || memcmp(name, before, sizeof before - 1) != 0 ||
        memcmp(name + n - (sizeof after - 1), after, sizeof after - 1) != 0) {
        return false;
    }
    const size_t n_digit = n - (sizeof before - 1) - (sizeof after - 1);
    return strspn(name + sizeof before - 1, "0123456789") == n_digit;
}

/// Entries of frames.pvd as clast writes them; those whose file is gone are left out.
static clast_status list_entries(const clx_run *run, entry **list, int64_t *n)
{
    static const char time_mark[] = "timestep=\"";
    static const char file_mark[] = "file=\"";
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char file[CLX_PATH_LIMIT];
    char *text = NULL;
    int64_t capacity = 0;
    int64_t n_entry = 0;
    int64_t n_byte = 0;
    CLX_TRY(clx_run_path(run, "frames.pvd", path, sizeof path));
    CLX_TRY(clx_file_read_all(path, PVD_LIMIT, &text, &n_byte));
    for (const char *at = text; (at = strstr(at, time_mark)) != NULL;) {
        at += sizeof time_mark - 1;
        ++n_entry;
        const char *name = strstr(at, file_mark);
        const double time = clx_number_read(at, NULL);
        if (name == NULL) {
            break;
        }
        name += sizeof file_mark - 1;
        const size_t length = strcspn(name, "\"");
        CLX_CHECK(is_frame(name, length) && isfinite(time), CLAST_E_FORMAT,
                  "%s: entry %lld is no frame of this run", path, (long long)n_entry);
        CLX_TRY(clx_grow(list, &capacity, *n + 1, sizeof **list));
        (*list)[*n].time = time;
        memcpy((*list)[*n].name, name, length);
        (*list)[*n].name[length] = '\0';
        CLX_TRY(clx_run_path(run, (*list)[*n].name, file, sizeof file));
        *n += access(file, R_OK) == 0 ? 1 : 0;
        at = name;
    }
done:
    clx_free(text);
    return status;
}

CLX_RISING(by_id, named, id)

static clast_status names_of(const clast_assembly *a, named **list)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(list, a->n_grain, sizeof **list));
    for (int32_t i = 0; i < a->n_grain; ++i) {
        (*list)[i] = (named){a->id[i], i};
    }
    qsort(*list, (size_t)a->n_grain, sizeof **list, by_id);
done:
    return status;
}

/// Columns of clx_vtu_grains.
typedef struct {
    const double *x[3], *rotation[4], *grain, *shape, *scale;
} columns;

/// False for a frame without poses.
static bool columns_of(const clast_table *table, columns *c)
{
    static const char *const name[10] = {"x",
                                         "y",
                                         "z",
                                         "orientation_wxyz_0",
                                         "orientation_wxyz_1",
                                         "orientation_wxyz_2",
                                         "orientation_wxyz_3",
                                         "grain",
                                         "shape",
                                         "scale"};
    const double *found[10];
    for (int k = 0; k < 10; ++k) {
        found[k] = clast_table_numbers(table, name[k]);
        if (found[k] == NULL) {
            return false;
        }
    }
    *c = (columns){{found[0], found[1], found[2]},
                   {found[3], found[4], found[5], found[6]},
                   found[7],
                   found[8],
                   found[9]};
    return true;
}

/// A shape's name and its place in the assembly.
typedef struct {
    const char *name;
    int32_t place;
} titled;

static int by_name(const void *a, const void *b)
{
    const titled *p = a;
    const titled *q = b;
    const int order = strcmp(p->name, q->name);
    return order != 0 ? order : (p->place > q->place) - (p->place < q->place);
}

static clast_status titles_of(const clast_assembly *a, titled **list)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(list, a->n_shape, sizeof **list));
    for (int32_t s = 0; s < a->n_shape; ++s) {
        (*list)[s] = (titled){a->shape[s].name, s};
    }
    qsort(*list, (size_t)a->n_shape, sizeof **list, by_name);
done:
    return status;
}

/// First shape of that name in a list by name, or -1.
static int32_t find_title(const titled *list, int32_t n, const char *name)
{
    int32_t low = 0;
    for (int32_t high = n; low < high;) {
        const int32_t middle = low + (high - low) / 2;
        if (strcmp(list[middle].name, name) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < n && strcmp(list[low].name, name) == 0 ? list[low].place : -1;
}

/// The assembly's shape of each of a frame's names, or -1: the one of the same number where it has
/// that name (two may share one), else the first that has it.
static clast_status match_shapes(const clast_assembly *a, const clast_table *names, int32_t **shape)
{
    clast_status status = CLAST_OK;
    titled *list = NULL;
    CLX_TRY(clx_alloc(shape, names->n_row, sizeof **shape));
    CLX_TRY(titles_of(a, &list));
    for (int64_t i = 0; i < names->n_row; ++i) {
        const char *name = names->column[0].text[i];
        (*shape)[i] = i < a->n_shape && strcmp(a->shape[i].name, name) == 0
                          ? (int32_t)i
                          : find_title(list, a->n_shape, name);
    }
done:
    clx_free(list);
    return status;
}

static clast_status frame_alloc(int64_t n, clx_frame *frame)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&frame->grain, n, sizeof *frame->grain));
    CLX_TRY(clx_alloc(&frame->shape, n, sizeof *frame->shape));
    CLX_TRY(clx_alloc(&frame->position, n, sizeof *frame->position));
    CLX_TRY(clx_alloc(&frame->orientation, n, sizeof *frame->orientation));
    CLX_TRY(clx_alloc(&frame->scale, n, sizeof *frame->scale));
done:
    return status;
}

/// Adds a row's grain; nothing where its shape is unknown or its pose is none.
static void add_grain(const columns *c, int64_t row, int32_t shape, int32_t place, clx_frame *frame)
{
    CLAST_ASSERT(row >= 0);
    double *x = frame->position[frame->n];
    double *q = frame->orientation[frame->n];
    double square = 0.0;
    for (int k = 0; k < 3; ++k) {
        x[k] = c->x[k][row];
    }
    for (int k = 0; k < 4; ++k) {
        q[k] = c->rotation[k][row];
        square += q[k] * q[k];
    }
    if (shape >= 0 && isfinite(x[0] + x[1] + x[2]) && fabs(square - 1.0) < 1e-6 &&
        c->scale[row] > 0.0 && isfinite(c->scale[row])) {
        frame->grain[frame->n] = place;
        frame->shape[frame->n] = shape;
        frame->scale[frame->n++] = c->scale[row];
    }
}

/// *has_poses is false, and the frame empty, for a file without poses.
static clast_status read_frame(const clx_run *run, const entry *e, const clast_assembly *a,
                               const named *list, clx_frame *frame, bool *has_poses)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clast_table table = {0};
    clast_table names = {0};
    int32_t *shape = NULL;
    columns c;
    clx_frame made = {.time = e->time};
    CLX_TRY(clx_run_path(run, e->name, path, sizeof path));
    CLX_TRY(clx_vtu_grains(path, &table, &names));
    *has_poses = names.n_row > 0 && columns_of(&table, &c);
    if (!*has_poses) {
        goto done;
    }
    CLX_TRY(frame_alloc(table.n_row, &made));
    CLX_TRY(match_shapes(a, &names, &shape));
    for (int64_t i = 0; i < table.n_row; ++i) {
        const double number = c.shape[i];
        const bool is_known = number >= 0.0 && number < (double)names.n_row;
        const bool is_named = list != NULL && fabs(c.grain[i]) < 0x1p63;
        const named key = {.id = is_named ? (int64_t)c.grain[i] : 0};
        const named *found =
            is_named ? bsearch(&key, list, (size_t)a->n_grain, sizeof *list, by_id) : NULL;
        add_grain(&c, i, is_known ? shape[(int64_t)number] : -1, found != NULL ? found->place : -1,
                  &made);
    }
    *frame = made;
    made = (clx_frame){0};
done:
    frame_free(&made);
    clx_free(shape);
    clast_table_free(&table);
    clast_table_free(&names);
    return status;
}

/// Whether a grain has one number in all frames and at the end: not where grains leave and others
/// move up, and not where bodies join.
static bool keeps_numbers(const clx_run *run)
{
    const char *command = json_string_value(json_object_get(run->manifest, "command"));
    return (command == NULL || strcmp(command, "evolve") != 0) &&
           !(json_number_value(json_object_get(run->summary, "n_left")) > 0.0);
}

/// How many frames a page has room for.
static int64_t most_frames(const clast_assembly *a, bool has_numbers)
{
    const int64_t n_byte = has_numbers ? GRAIN_BYTES : STRANGER_BYTES;
    const int64_t n = BYTE_BUDGET / (n_byte * ((int64_t)a->n_grain + 1));
    return n < 2 ? 2 : n > MOST_FRAMES ? MOST_FRAMES : n;
}

static clast_status read_frames(const clx_run *run, const clast_assembly *a, const entry *list,
                                int64_t n_file, clx_frames *frames)
{
    clast_status status = CLAST_OK;
    named *names = NULL;
    bool has_poses = true;
    const bool has_numbers = keeps_numbers(run);
    const int64_t most = most_frames(a, has_numbers);
    const int64_t n = n_file < most ? n_file : most;
    if (has_numbers) {
        CLX_TRY(names_of(a, &names));
    }
    CLX_TRY(clx_alloc(&frames->frame, n, sizeof *frames->frame));
    for (int64_t k = 0; k < n && has_poses; ++k) {
        const int64_t index = n == 1 ? 0 : (k * (n_file - 1) + (n - 1) / 2) / (n - 1);
        CLX_TRY(read_frame(run, &list[index], a, names, &frames->frame[k], &has_poses));
        frames->n += has_poses ? 1 : 0;
    }
    for (int32_t s = 0; s < a->n_shape; ++s) {
        frames->has_turns = frames->has_turns || a->shape[s].kind != CLAST_SHAPE_SPHERE;
    }
    frames->n_file = (int32_t)n_file;
    frames->lacks_poses = !has_poses;
done:
    clx_free(names);
    return status;
}

clast_status clx_frames_read(const clx_run *run, const clast_assembly *assembly, clx_frames *frames)
{
    clast_status status = CLAST_OK;
    entry *list = NULL;
    int64_t n = 0;
    clx_frames made = {.end = NAN};
    if (!clx_run_has(run, "frames.pvd")) {
        return CLAST_OK;
    }
    CLX_TRY(list_entries(run, &list, &n));
    CLX_CHECK(n <= INT32_MAX, CLAST_E_LIMIT, "%s: %lld frames", run->path, (long long)n);
    if (n > 0) {
        CLX_TRY(read_frames(run, assembly, list, n, &made));
    }
    const json_t *time = json_object_get(run->summary, "time");
    made.end = json_is_number(time) ? json_number_value(time) : made.end;
    *frames = made;
    made = (clx_frames){0};
done:
    clx_frames_free(&made);
    clx_free(list);
    return status;
}

clast_status clx_frames_last(const clx_run *run, const clast_assembly *from, clast_assembly *last)
{
    clast_status status = CLAST_OK;
    entry *list = NULL;
    int64_t n = 0;
    bool has_poses = false;
    clx_frame frame = {0};
    clast_assembly made = {.unit = "m"};
    if (!clx_run_has(run, "frames.pvd")) {
        return CLAST_OK;
    }
    CLX_TRY(list_entries(run, &list, &n));
    if (n > 0) {
        CLX_TRY(read_frame(run, &list[n - 1], from, NULL, &frame, &has_poses));
    }
    CLX_TRY(clx_assembly_add_shapes(&made, frame.n > 0 ? from->n_shape : 0, from->shape,
                                    sizeof *from->shape));
    for (int32_t i = 0; i < frame.n; ++i) {
        CLX_TRY(clast_assembly_add_grain(&made, frame.shape[i], frame.position[i],
                                         frame.orientation[i], frame.scale[i], 1.0));
        made.density[i] = 0.0; // which a frame does not tell
    }
    *last = made;
    made = (clast_assembly){0};
done:
    frame_free(&frame);
    clast_assembly_free(&made);
    clx_free(list);
    return status;
}
