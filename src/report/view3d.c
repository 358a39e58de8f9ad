// The 3-D view's data: shapes once, grains as poses.
#include "report/view3d.h"

#include "base/alloc.h"
#include "io/json.h"
#include "math/sort.h"
#include "math/vec3.h"
#include "render/legend.h"
#include "report/frames.h"
#include "report/page.h"
#include <clast/mesh_repair.h>
#include <clast/shape.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MIN_TRIANGLES = 20, MAX_LEVEL = 4, MAX_GRAINS = 200000, POSE = 10, COLLAPSE_LIMIT = 200000 };

typedef struct {
    const clast_assembly *assembly;
    int32_t n_shown; ///< grains in the data
    int32_t budget;  ///< triangles a grain
    double centre[3], length;
    const clx_frames *frames; ///< or NULL
    int32_t *order;           ///< [n_shown]: grains by shape, in their order
    int32_t *first;           ///< [n_shape + 1]: where in `order` each shape begins
    bool *is_used;            ///< [n_shape]: a grain of it is shown, now or at another moment
} view;

/// Text inside JSON inside <script>: '<' and '>' as \u003c, so that no tag can begin there.
static void write_text(clx_file *file, const char *text)
{
    (void)clx_file_print(file, "\"");
    while (*text != '\0') {
        char out[CLX_JSON_STEP];
        size_t n = 0;
        text = clx_json_next(text, out, &n);
        if (n == 1 && (out[0] == '<' || out[0] == '>' || out[0] == '&')) {
            (void)clx_file_print(file, "\\u%04x", (unsigned)out[0]);
        } else {
            (void)clx_file_write(file, out, n);
        }
    }
    (void)clx_file_print(file, "\"");
}

/// Little-endian, whatever the machine.
static void store32(unsigned char *at, uint32_t bits)
{
    for (int k = 0; k < 4; ++k) {
        at[k] = (unsigned char)(bits >> 8 * k);
    }
}

static void store_float(unsigned char *at, double value)
{
    const float single = (float)value;
    uint32_t bits = 0;
    memcpy(&bits, &single, sizeof bits);
    store32(at, bits);
}

typedef struct {
    int32_t cell; ///< number of the vertex's cell
    int32_t vertex;
} place;

CLX_RISING_BY_TWO(by_cell, place, cell, vertex)

/// New vertices, one for each occupied cell of an n^3 grid, and each old vertex's new number.
static clast_status join_vertices(const clast_mesh *mesh, int32_t n, clast_mesh *simple,
                                  int32_t *number)
{
    CLAST_ASSERT(n > 0);
    clast_status status = CLAST_OK;
    double low[3];
    double high[3];
    place *places = NULL;
    CLX_TRY(clx_alloc(&places, mesh->n_vert, sizeof *places));
    clast_mesh_bounds(mesh, low, high);
    const double edge = fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]) / n;
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        int32_t cell = 0;
        for (int k = 0; k < 3; ++k) {
            const int32_t at = edge > 0.0 ? (int32_t)((mesh->vert[i][k] - low[k]) / edge) : 0;
            cell = cell * n + (at < n ? at : n - 1);
        }
        places[i] = (place){cell, i};
    }
    qsort(places, (size_t)mesh->n_vert, sizeof *places, by_cell);
    simple->n_vert = 0;
    for (int32_t i = 0; i < mesh->n_vert;) {
        double *mean = simple->vert[simple->n_vert];
        int32_t end = i;
        memset(mean, 0, 3 * sizeof *mean);
        for (; end < mesh->n_vert && places[end].cell == places[i].cell; ++end) {
            number[places[end].vertex] = simple->n_vert;
            for (int k = 0; k < 3; ++k) {
                mean[k] += mesh->vert[places[end].vertex][k];
            }
        }
        for (int k = 0; k < 3; ++k) {
            mean[k] /= end - i;
        }
        ++simple->n_vert;
        i = end;
    }
done:
    clx_free(places);
    return status;
}

static void join_triangles(const clast_mesh *mesh, const int32_t *number, clast_mesh *simple)
{
    simple->n_tri = 0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        const int32_t a = number[mesh->tri[t][0]];
        const int32_t b = number[mesh->tri[t][1]];
        const int32_t c = number[mesh->tri[t][2]];
        if (a != b && b != c && c != a) {
            simple->tri[simple->n_tri][0] = a;
            simple->tri[simple->n_tri][1] = b;
            simple->tri[simple->n_tri++][2] = c;
        }
    }
}

clast_status clx_view3d_simplify(const clast_mesh *mesh, int32_t limit, clast_mesh *simple)
{
    clast_status status = CLAST_OK;
    clast_mesh made = {0};
    int32_t *number = NULL;
    CLX_TRY(clast_mesh_copy(mesh, &made));
    CLX_TRY(clx_alloc(&number, mesh->n_vert, sizeof *number));
    for (int32_t n = 256; made.n_tri > limit && n >= 3; n = n * 4 / 5) {
        CLX_TRY(join_vertices(mesh, n, &made, number));
        join_triangles(mesh, number, &made);
    }
    *simple = made;
    made = (clast_mesh){0};
done:
    clast_mesh_free(&made);
    clx_free(number);
    return status;
}

/// Finest icosphere whose triangles are within the budget.
static int level_for(int32_t n_ball, int32_t budget)
{
    CLAST_ASSERT(n_ball > 0);
    int level = MAX_LEVEL;
    while (level > 0 && (int64_t)n_ball * 20 * (1 << 2 * level) > budget) {
        --level;
    }
    return level;
}

/// A surface within the budget: edges of a solid collapse (its silhouette stays), all else, and
/// scans too large for that, are joined on a grid.
static clast_status surface_of(const view *v, const clast_shape *shape, clast_mesh *surface)
{
    clast_status status = CLAST_OK;
    clast_mesh full = {0};
    const int32_t n_ball = shape->kind == CLAST_SHAPE_CLUMP ? shape->spheres.n : 1;
    CLX_TRY(clast_shape_surface(shape, level_for(n_ball, v->budget), &full));
    if (full.n_tri > v->budget && full.n_tri <= COLLAPSE_LIMIT) {
        status = clast_mesh_simplify(&full, v->budget, surface, NULL);
        if (status != CLAST_E_GEOMETRY) {
            goto done; // CLAST_E_GEOMETRY: no single solid, which the grid below can do
        }
    }
    CLX_TRY(clx_view3d_simplify(&full, v->budget, surface));
done:
    clast_mesh_free(&full);
    return status;
}

static clast_status write_surface(clx_file *file, const clast_mesh *mesh, double length)
{
    clast_status status = CLAST_OK;
    unsigned char *bytes = NULL;
    const int64_t n = mesh->n_vert > mesh->n_tri ? mesh->n_vert : mesh->n_tri;
    CLX_TRY(clx_alloc(&bytes, n, 12));
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        for (int k = 0; k < 3; ++k) {
            store_float(bytes + 12 * (size_t)i + 4 * k, mesh->vert[i][k] / length);
        }
    }
    (void)clx_file_print(file, ", \"position\": \"");
    clx_page_base64(file, bytes, 12 * (size_t)mesh->n_vert);
    for (int32_t i = 0; i < mesh->n_tri; ++i) {
        for (int k = 0; k < 3; ++k) {
            store32(bytes + 12 * (size_t)i + 4 * k, (uint32_t)mesh->tri[i][k]);
        }
    }
    (void)clx_file_print(file, "\", \"index\": \"");
    clx_page_base64(file, bytes, 12 * (size_t)mesh->n_tri);
    (void)clx_file_print(file, "\"");
done:
    clx_free(bytes);
    return status;
}

/// Place, turn, scale, size (diameter of the sphere of equal volume) and density of grain i.
static void store_pose(const view *v, int32_t i, unsigned char *at)
{
    CLAST_ASSERT(i >= 0 && i < v->assembly->n_grain);
    const clast_assembly *a = v->assembly;
    const double volume = a->shape[a->shape_id[i]].volume;
    for (int k = 0; k < 3; ++k) {
        store_float(at + 4 * k, (a->position[i][k] - v->centre[k]) / v->length);
    }
    for (int k = 0; k < 4; ++k) {
        store_float(at + 12 + 4 * k, a->orientation[i][k]);
    }
    store_float(at + 28, a->scale[i]);
    store_float(at + 32, a->scale[i] * cbrt(6.0 * volume / CLAST_PI) / v->length);
    store_float(at + 36, a->density[i]);
}

static clast_status write_grains(clx_file *file, const view *v, int32_t shape)
{
    clast_status status = CLAST_OK;
    unsigned char *grain = NULL;
    unsigned char *pose = NULL;
    const int32_t *mine = v->order + v->first[shape];
    const size_t n = (size_t)(v->first[shape + 1] - v->first[shape]);
    CLX_TRY(clx_alloc(&grain, (int64_t)n, 4));
    CLX_TRY(clx_alloc(&pose, (int64_t)n, 4 * (size_t)POSE));
    for (size_t k = 0; k < n; ++k) {
        store32(grain + 4 * k, (uint32_t)mine[k]);
        store_pose(v, mine[k], pose + 4 * POSE * k);
    }
    (void)clx_file_print(file, ", \"grain\": \"");
    clx_page_base64(file, grain, 4 * n);
    (void)clx_file_print(file, "\", \"pose\": \"");
    clx_page_base64(file, pose, 4 * POSE * n);
    (void)clx_file_print(file, "\"");
done:
    CLX_FREE(grain, pose);
    return status;
}

/// A finer surface for grains near the camera, where the budget of all leaves each but a coarse
/// one.
static clast_status write_near(clx_file *file, const view *v, const clast_shape *shape,
                               int32_t n_tri)
{
    enum { MOST = 1280, GRAIN_BUDGET = 100000 };
    clast_status status = CLAST_OK;
    clast_mesh fine = {0};
    view near = *v;
    near.budget =
        GRAIN_BUDGET / v->assembly->n_shape < MOST ? GRAIN_BUDGET / v->assembly->n_shape : MOST;
    if (near.budget < 2 * n_tri) {
        return CLAST_OK;
    }
    CLX_TRY(surface_of(&near, shape, &fine));
    if (fine.n_tri > n_tri) {
        (void)clx_file_print(file, ", \"near\": {\"n\": %d", (int)fine.n_tri);
        CLX_TRY(write_surface(file, &fine, v->length));
        (void)clx_file_print(file, "}");
    }
done:
    clast_mesh_free(&fine);
    return status;
}

static clast_status write_shape(clx_file *file, const view *v, int32_t index)
{
    clast_status status = CLAST_OK;
    clast_mesh surface = {0};
    const clast_shape *shape = &v->assembly->shape[index];
    CLX_TRY(surface_of(v, shape, &surface));
    (void)clx_file_print(file, "\n{\"name\": ");
    write_text(file, shape->name);
    (void)clx_file_print(file, ", \"number\": %d, \"diameter\": %.9g", (int)index,
                         cbrt(6.0 * shape->volume / CLAST_PI) / v->length);
    (void)clx_file_print(file, ", \"smooth\": %s, \"colour\": %d",
                         shape->kind == CLAST_SHAPE_MESH ? "false" : "true",
                         (int)(index < CLX_LEGEND_SHAPES ? index : CLX_LEGEND_SHAPES - 1));
    CLX_TRY(write_surface(file, &surface, v->length));
    CLX_TRY(write_near(file, v, shape, surface.n_tri));
    CLX_TRY(write_grains(file, v, index));
    (void)clx_file_print(file, "}");
done:
    clast_mesh_free(&surface);
    return status;
}

static void view_free(view *v)
{
    CLX_FREE(v->order, v->first, v->is_used);
}

/// Sorts the grains by shape, and finds which shapes are shown at all.
static clast_status sort_grains(view *v)
{
    clast_status status = CLAST_OK;
    const clast_assembly *a = v->assembly;
    CLX_TRY(clx_alloc(&v->order, v->n_shown, sizeof *v->order));
    CLX_TRY(clx_alloc(&v->first, (int64_t)a->n_shape + 1, sizeof *v->first));
    CLX_TRY(clx_alloc(&v->is_used, a->n_shape, sizeof *v->is_used));
    memset(v->first, 0, ((size_t)a->n_shape + 1) * sizeof *v->first);
    memset(v->is_used, 0, (size_t)a->n_shape * sizeof *v->is_used);
    for (int32_t i = 0; i < v->n_shown; ++i) {
        v->is_used[a->shape_id[i]] = true;
        ++v->first[a->shape_id[i] + 1];
    }
    for (int32_t s = 0; s < a->n_shape; ++s) {
        v->first[s + 1] += v->first[s];
    }
    for (int32_t i = v->n_shown; i-- > 0;) { // from its end down to its begin
        v->order[--v->first[a->shape_id[i] + 1]] = i;
    }
    for (int32_t s = 0; s < a->n_shape; ++s) {
        v->first[s] = v->first[s + 1];
    }
    v->first[a->n_shape] = v->n_shown;
    for (int32_t k = 0; v->frames != NULL && k < v->frames->n; ++k) {
        const clx_frame *frame = &v->frames->frame[k];
        for (int32_t i = 0; i < frame->n; ++i) {
            v->is_used[frame->shape[i]] = true;
        }
    }
done:
    return status;
}

/// Colour bar of a picture of the same assembly; a pose's size times `unit` is on its scale. None
/// of sizes where a grain has no volume.
static clast_status write_bar(clx_file *file, const view *v, int32_t colour, const char *name)
{
    clast_render_config config = {.colour = colour, .scale = CLAST_RENDER_SCALE_AUTO};
    clx_legend legend = {0};
    const double metre = strcmp(v->assembly->unit, "m") == 0 ? 1.0 : 0.0;
    const clast_status status = clx_legend_make(v->assembly, &config, metre, NULL, &legend);
    if (status != CLAST_OK) {
        return status == CLAST_E_GEOMETRY ? CLAST_OK : status;
    }
    (void)clx_file_print(
        file,
        ", \"%s\": {\"title\": \"%s\", \"log\": %s, \"low\": %.9g, \"high\": %.9g, "
        "\"unit\": %.9g, \"ticks\": [",
        name, legend.title, legend.log ? "true" : "false", legend.low, legend.high,
        legend.factor * v->length);
    for (int k = 0; k < legend.n; ++k) {
        (void)clx_file_print(file, "%s[%.6g, \"%s\"]", k > 0 ? ", " : "", legend.place[k],
                             legend.text[k]);
    }
    (void)clx_file_print(file, "]}");
    return CLAST_OK;
}

static void write_colour(clx_file *file, bool is_first, const double rgb[3])
{
    (void)clx_file_print(file, "%s\"#", is_first ? "" : ", ");
    for (int k = 0; k < 3; ++k) {
        (void)clx_file_print(file, "%02x", (unsigned)lround(255.0 * fmin(fmax(rgb[k], 0.0), 1.0)));
    }
    (void)clx_file_print(file, "\"");
}

/// The colours of a picture of the same assembly, and what they mean.
static clast_status write_colours(clx_file *file, const view *v)
{
    enum { N_BAR = 17 };
    clast_status status = CLAST_OK;
    clast_render_config config = {.colour = CLAST_RENDER_COLOUR_SHAPE};
    clx_legend shapes = {0};
    (void)clx_file_print(file, ", \"bar\": [");
    for (int k = 0; k < N_BAR; ++k) {
        double rgb[3];
        clx_legend_colour((double)k / (N_BAR - 1), rgb);
        write_colour(file, k == 0, rgb);
    }
    (void)clx_file_print(file, "]");
    CLX_TRY(write_bar(file, v, CLAST_RENDER_COLOUR_SIZE, "size"));
    CLX_TRY(write_bar(file, v, CLAST_RENDER_COLOUR_ORDER, "order"));
    CLX_TRY(clx_legend_make(v->assembly, &config, 0.0, NULL, &shapes));
    (void)clx_file_print(file, ", \"shape\": [");
    for (int k = 0; k < shapes.n; ++k) {
        write_colour(file, k == 0, shapes.rgb[k]);
    }
    (void)clx_file_print(file, "], \"shape_name\": [");
    for (int k = 0; k < shapes.n; ++k) {
        (void)clx_file_print(file, "%s", k > 0 ? ", " : "");
        write_text(file, shapes.text[k]);
    }
    (void)clx_file_print(file, "]");
done:
    return status;
}

/// Names of the grains, where they are not their places.
static void write_ids(clx_file *file, const view *v)
{
    const int64_t *id = v->assembly->id;
    bool is_place = true;
    for (int32_t i = 0; i < v->n_shown; ++i) {
        is_place = is_place && id[i] == i;
    }
    for (int32_t i = 0; !is_place && i < v->n_shown; ++i) {
        (void)clx_file_print(file, "%s%lld", i == 0 ? ", \"id\": [" : ",", (long long)id[i]);
    }
    (void)clx_file_print(file, "%s", is_place ? "" : "]");
}

/// Contacts with both ends' numbers, as arrays of the page.
typedef struct {
    int32_t n;
    unsigned char *pair, *branch, *force;
} contacts;

static void contacts_free(contacts *c)
{
    CLX_FREE(c->pair, c->branch, c->force);
    *c = (contacts){0};
}

static clast_status contacts_alloc(int64_t n, contacts *c)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&c->pair, n, 8));
    CLX_TRY(clx_alloc(&c->branch, n, 12));
    CLX_TRY(clx_alloc(&c->force, n, 4));
done:
    return status;
}

static void add_contact(const view *v, int32_t a, int32_t b, const double branch[3], double force,
                        contacts *c)
{
    store32(c->pair + 8 * (size_t)c->n, (uint32_t)a);
    store32(c->pair + 8 * (size_t)c->n + 4, (uint32_t)b); // -1, a wall: 0xffffffff
    for (int k = 0; k < 3; ++k) {
        store_float(c->branch + 12 * (size_t)c->n + 4 * k, branch[k] / v->length);
    }
    store_float(c->force + 4 * (size_t)c->n, force);
    ++c->n;
}

/// Columns of clast_dem_contact_table; false where one is not there.
static bool force_columns(const clast_table *table, const double *column[8])
{
    static const char *const name[8] = {"a",          "b",         "branch_x_m", "branch_y_m",
                                        "branch_z_m", "force_x_N", "force_y_N",  "force_z_N"};
    for (int k = 0; k < 8; ++k) {
        column[k] = table != NULL ? clast_table_numbers(table, name[k]) : NULL;
        if (column[k] == NULL) {
            return false;
        }
    }
    return true;
}

static bool is_shown(const view *v, double grain)
{
    return grain >= 0.0 && grain < v->n_shown;
}

static clast_status read_forces(const view *v, const clast_table *table,
                                const double *const column[8], contacts *c)
{
    clast_status status = CLAST_OK;
    CLX_TRY(contacts_alloc(table->n_row, c));
    for (int64_t i = 0; i < table->n_row; ++i) {
        const double branch[3] = {column[2][i], column[3][i], column[4][i]};
        const double force = sqrt(column[5][i] * column[5][i] + column[6][i] * column[6][i] +
                                  column[7][i] * column[7][i]);
        const double b = column[1][i];
        if (is_shown(v, column[0][i]) && (b < 0.0 || is_shown(v, b)) && isfinite(force) &&
            isfinite(branch[0] + branch[1] + branch[2])) {
            add_contact(v, (int32_t)column[0][i], b < 0.0 ? -1 : (int32_t)b, branch, force, c);
        }
    }
done:
    return status;
}

static clast_status read_touches(const view *v, contacts *c)
{
    clast_status status = CLAST_OK;
    const clast_assembly *a = v->assembly;
    CLX_TRY(contacts_alloc(a->n_contact, c));
    for (int32_t i = 0; i < a->n_contact; ++i) {
        const int32_t first = a->contact[i][0];
        const int32_t second = a->contact[i][1];
        double branch[3];
        v3_sub(branch, a->position[second], a->position[first]);
        if (first < v->n_shown && second < v->n_shown) {
            add_contact(v, first, second, branch, 0.0, c);
        }
    }
done:
    return status;
}

/// Forces where they are known, else the pairs that touch, else nothing.
static clast_status write_contacts(clx_file *file, const view *v, const clast_table *table)
{
    clast_status status = CLAST_OK;
    const double *column[8];
    contacts c = {0};
    const bool has_force = force_columns(table, column);
    if (has_force) {
        CLX_TRY(read_forces(v, table, column, &c));
    } else if (v->assembly->contact != NULL) {
        CLX_TRY(read_touches(v, &c));
    }
    if (c.n > 0) {
        (void)clx_file_print(file, ", \"contact\": {\"pair\": \"");
        clx_page_base64(file, c.pair, 8 * (size_t)c.n);
        (void)clx_file_print(file, "\", \"branch\": \"");
        clx_page_base64(file, c.branch, 12 * (size_t)c.n);
        (void)clx_file_print(file, "\", \"force\": %s", has_force ? "\"" : "null}");
    }
    if (c.n > 0 && has_force) {
        clx_page_base64(file, c.force, 4 * (size_t)c.n);
        (void)clx_file_print(file, "\"}");
    }
done:
    contacts_free(&c);
    return status;
}

static view begin(const clast_assembly *assembly, int32_t limit)
{
    double low[3];
    double high[3];
    view v = {.assembly = assembly, .length = 0.0};
    v.n_shown = assembly->n_grain < MAX_GRAINS ? assembly->n_grain : MAX_GRAINS;
    v.budget = limit / v.n_shown > MIN_TRIANGLES ? limit / v.n_shown : MIN_TRIANGLES;
    clast_assembly_bounds(assembly, low, high);
    for (int k = 0; k < 3; ++k) {
        v.centre[k] = 0.5 * (low[k] + high[k]);
        v.length = fmax(v.length, 0.5 * (high[k] - low[k]));
    }
    return v;
}

clast_status clx_view3d_write(clx_file *file, const clast_assembly *assembly,
                              const clast_table *forces, const clx_frames *frames, int32_t limit)
{
    clast_status status = CLAST_OK;
    bool is_first = true;
    view v = {0};
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_GEOMETRY, "the state holds no grains");
    v = begin(assembly, limit);
    v.frames = frames;
    CLX_TRY(sort_grains(&v));
    CLX_CHECK(isfinite(v.length) && v.length > 0.0, CLAST_E_GEOMETRY,
              "the grains of the state have no finite extent");
    (void)clx_file_print(
        file, "<div class=\"view-box\"><div class=\"view\"><p class=\"view-wait\">The 3-D view "
              "needs a browser with WebGL and JavaScript; all else on this page does "
              "not.</p></div>\n<script type=\"application/json\" class=\"view-data\">{\"unit\": ");
    write_text(file, assembly->unit);
    (void)clx_file_print(file, ", \"length\": %.17g, \"n_grain\": %d, \"n_shown\": %d", v.length,
                         (int)assembly->n_grain, (int)v.n_shown);
    (void)clx_file_print(file, ", \"centre\": [%.17g, %.17g, %.17g]", v.centre[0], v.centre[1],
                         v.centre[2]);
    CLX_TRY(write_colours(file, &v));
    write_ids(file, &v);
    CLX_TRY(write_contacts(file, &v, forces));
    CLX_TRY(clx_frames_write(file, frames, assembly, v.n_shown, v.centre, v.length));
    (void)clx_file_print(file, ", \"shapes\": [");
    for (int32_t s = 0; s < assembly->n_shape; ++s) {
        if (v.is_used[s]) {
            (void)clx_file_print(file, "%s", is_first ? "" : ",");
            is_first = false;
            CLX_TRY(write_shape(file, &v, s));
        }
    }
    (void)clx_file_print(file, "]}</script></div>\n");
done:
    view_free(&v);
    return status;
}
