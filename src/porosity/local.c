// Local porosity by radical Voronoi cells.
//
// Cells are cut by the nearest neighbours first, shell by shell of a grid, until no farther sphere
// can reach: a sphere at distance d cuts at (d^2 + r_i^2 - r_j^2) / (2 d), which is beyond the
// cell's farthest corner once d is large enough for the largest r_j.
#include <clast/porosity.h>

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/column_unit.h"
#include "base/parallel.h"
#include "base/status.h"
#include "geom/convex_cell.h"
#include "math/vec3.h"
#include "porosity/whole.h"
#include <clast/assembly.h>
#include <clast/shape.h>
#include <stdlib.h>

enum { SIDES = 96, BLOCK = 32, ROUND = -7 }; ///< mark of a cylinder's sides; a box's: -1 to -6

/// Spheres inside the bed on a grid, and what their cells are.
typedef struct {
    const clast_bed *bed;
    double z_low, z_high;
    int32_t n;
    int32_t *grain;      ///< [n] index in the assembly
    double (*centre)[3]; ///< [n]
    double *radius;      ///< [n]
    double largest;      ///< radius
    double low[3];       ///< corner of the grid
    double step[3];      ///< edges of a grid cell, whole numbers of them across the bed
    double least;        ///< of the edges
    int32_t size[3];
    int32_t *first; ///< [cells + 1]
    int32_t *item;  ///< [n] spheres by grid cell
    int n_period;   ///< directions that repeat: 0, 2 or 3
    double period[3];
    const double *own;                           ///< [n] volume of each grain
    double *volume, *porosity, *n_face, *border; ///< results [n]; volume of the cell
} diagram;

static void diagram_free(diagram *d)
{
    CLX_FREE(d->grain, d->centre, d->radius, d->first, d->item);
}

static bool is_inside(const diagram *d, const double x[3])
{
    if (x[2] < d->z_low || x[2] > d->z_high) {
        return false;
    }
    if (d->bed->kind == CLAST_BED_CYLINDER) {
        return hypot(x[0] - d->bed->centre[0], x[1] - d->bed->centre[1]) <= d->bed->radius;
    }
    return x[0] >= d->bed->low[0] && x[0] <= d->bed->high[0] && x[1] >= d->bed->low[1] &&
           x[1] <= d->bed->high[1];
}

/// Moves a centre into the period's first image: z first, which moves it along x in a sheared bed.
static void wrap(const diagram *d, double x[3])
{
    const double low[3] = {d->bed->low[0], d->bed->low[1], d->bed->floor};
    for (int k = d->n_period - 1; k >= 0; --k) {
        const double image = floor((x[k] - low[k]) / d->period[k]);
        x[k] = fmin(x[k] - d->period[k] * image, low[k] + d->period[k]);
        x[0] -= k == 2 ? image * d->bed->shift : 0.0;
    }
}

static clast_status copy_spheres(const clast_assembly *assembly, diagram *d)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&d->grain, assembly->n_grain, sizeof *d->grain));
    CLX_TRY(clx_alloc(&d->centre, assembly->n_grain, sizeof *d->centre));
    CLX_TRY(clx_alloc(&d->radius, assembly->n_grain, sizeof *d->radius));
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        double x[3];
        v3_copy(x, assembly->position[i]);
        wrap(d, x);
        if (is_inside(d, x)) {
            const double volume = assembly->shape[assembly->shape_id[i]].volume;
            d->grain[d->n] = i;
            d->radius[d->n] = assembly->scale[i] * cbrt(0.75 / CLAST_PI * volume);
            d->largest = fmax(d->largest, d->radius[d->n]);
            v3_copy(d->centre[d->n++], x);
        }
    }
    CLX_CHECK(d->n > 0, CLAST_E_USAGE, "no grain has its centre in the bed between %g and %g",
              d->z_low, d->z_high);
done:
    return status;
}

static void extent(const diagram *d, double low[3], double high[3])
{
    const clast_bed *bed = d->bed;
    for (int k = 0; k < 2; ++k) {
        const bool is_box = bed->kind != CLAST_BED_CYLINDER;
        low[k] = is_box ? bed->low[k] : bed->centre[k] - bed->radius;
        high[k] = is_box ? bed->high[k] : bed->centre[k] + bed->radius;
    }
    low[2] = d->z_low;
    high[2] = d->z_high;
}

static int32_t grid_index(const diagram *d, const double x[3], int axis)
{
    CLAST_ASSERT(axis >= 0 && axis < 3 && d->size[axis] > 0);
    const int32_t k = (int32_t)((x[axis] - d->low[axis]) / d->step[axis]);
    return k < 0 ? 0 : k >= d->size[axis] ? d->size[axis] - 1 : k;
}

static int64_t grid_cell(const diagram *d, int32_t i, int32_t j, int32_t k)
{
    CLAST_ASSERT(i >= 0 && i < d->size[0] && j >= 0 && j < d->size[1] && k >= 0 && k < d->size[2]);
    return ((int64_t)k * d->size[1] + j) * d->size[0] + i;
}

static int64_t cell_of(const diagram *d, const double x[3])
{
    return grid_cell(d, grid_index(d, x, 0), grid_index(d, x, 1), grid_index(d, x, 2));
}

static clast_status make_grid(diagram *d)
{
    clast_status status = CLAST_OK;
    double high[3];
    extent(d, d->low, high);
    double volume = 1.0;
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
        volume *= high[k] - d->low[k];
        longest = fmax(longest, high[k] - d->low[k]);
    }
    // About two spheres a cell; at most 1000 cells along an axis.
    const double wanted = fmax(cbrt(2.0 * volume / d->n), longest / 1000.0);
    int64_t n_cell = 1;
    d->least = HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
        d->size[k] = (int32_t)fmax(1.0, floor((high[k] - d->low[k]) / wanted));
        d->step[k] = (high[k] - d->low[k]) / d->size[k];
        d->least = fmin(d->least, d->step[k]);
        n_cell *= d->size[k];
    }
    CLX_TRY(clx_alloc(&d->first, n_cell + 1, sizeof *d->first));
    CLX_TRY(clx_alloc(&d->item, d->n, sizeof *d->item));
    for (int32_t i = 0; i < d->n; ++i) {
        ++d->first[cell_of(d, d->centre[i]) + 1];
    }
    for (int64_t c = 0; c < n_cell; ++c) {
        d->first[c + 1] += d->first[c];
    }
    for (int32_t i = d->n - 1; i >= 0; --i) { // downwards, so that each cell rises
        const int64_t c = cell_of(d, d->centre[i]);
        d->item[--d->first[c + 1]] = i;
    }
    // first[c + 1] is now where cell c begins; shift back
    for (int64_t c = 0; c < n_cell; ++c) {
        d->first[c] = d->first[c + 1];
    }
    d->first[n_cell] = d->n;
done:
    return status;
}

static bool is_sheared(const diagram *d)
{
    return d->n_period == 3 && d->bed->shift != 0.0;
}

/// The bed's flat walls around sphere i, relative to its centre.
static clast_status walls(const diagram *d, int32_t i, clx_cell *cell)
{
    double low[3];
    double high[3];
    const double *c = d->centre[i];
    extent(d, low, high);
    for (int k = 0; k < d->n_period; ++k) { // its own images cut it at half a period
        low[k] = c[k] - 0.5 * d->period[k];
        high[k] = c[k] + 0.5 * d->period[k];
    }
    if (is_sheared(d)) { // those above and below cut it aslant; no farther than this from it
        const double far =
            (d->period[2] * d->period[2] + d->period[0] * d->period[0]) / d->period[2];
        low[2] = c[2] - far;
        high[2] = c[2] + far;
    }
    v3_sub(low, low, c);
    v3_sub(high, high, c);
    if (d->bed->kind == CLAST_BED_CYLINDER) {
        for (int k = 0; k < 2; ++k) { // the prism reaches beyond the circle
            low[k] -= 0.01 * d->bed->radius;
            high[k] += 0.01 * d->bed->radius;
        }
    }
    return clx_cell_box(low, high, cell);
}

/// Cuts by the sides of the cylinder's prism; last, when few reach the cell.
static clast_status round_wall(const diagram *d, int32_t i, clx_cell *cell)
{
    clast_status status = CLAST_OK;
    // n tan(pi / n) a^2 = pi R^2
    const double a = d->bed->radius * sqrt(CLAST_PI / (SIDES * tan(CLAST_PI / SIDES)));
    for (int s = 0; s < SIDES && d->bed->kind == CLAST_BED_CYLINDER; ++s) {
        const double angle = 2.0 * CLAST_PI * s / SIDES;
        const double normal[3] = {cos(angle), sin(angle), 0.0};
        const double offset = a - normal[0] * (d->centre[i][0] - d->bed->centre[0]) -
                              normal[1] * (d->centre[i][1] - d->bed->centre[1]);
        CLX_TRY(clx_cell_cut(cell, normal, offset, ROUND));
    }
done:
    return status;
}

/// Cuts by the image of sphere j that lies in the grid cell's image.
static clast_status cut_by(const diagram *d, int32_t i, int32_t j, const double shift[3],
                           double reach2, clx_cell *cell)
{
    double u[3];
    v3_sub(u, d->centre[j], d->centre[i]);
    v3_add(u, u, shift);
    const double d2 = v3_norm2(u);
    const double offset = 0.5 * (d2 + d->radius[i] * d->radius[i] - d->radius[j] * d->radius[j]);
    if (d2 == 0.0 || (offset > 0.0 && offset * offset >= d2 * reach2)) {
        return CLAST_OK;
    }
    return clx_cell_cut(cell, u, offset, j);
}

/// A grid index as the grid has it, and the shift of its image; false outside.
static bool image(const diagram *d, int axis, int32_t index, int32_t *in_grid, double *shift)
{
    *shift = 0.0;
    *in_grid = index;
    if (axis < d->n_period) {
        const int32_t n = d->size[axis];
        const int32_t image = index >= 0 ? index / n : -((n - 1 - index) / n);
        *in_grid = index - image * n;
        *shift = image * d->period[axis];
        return true;
    }
    return index >= 0 && index < d->size[axis];
}

/// Cuts by all spheres of one grid cell, which may lie beyond the border of a periodic bed.
static clast_status cut_grid_cell(const diagram *d, int32_t i, const int32_t at[3], clx_cell *cell)
{
    clast_status status = CLAST_OK;
    int32_t g[3];
    double shift[3];
    double along =
        0.0; // of the images above or below in a sheared bed: whole cells, and less than one
    for (int k = 2; k >= 0; --k) {
        const int32_t index = k == 0 ? at[0] - (int32_t)floor(along / d->step[0]) : at[k];
        if (!image(d, k, index, &g[k], &shift[k])) {
            return CLAST_OK;
        }
        along = k == 2 && is_sheared(d) ? shift[2] / d->period[2] * d->bed->shift : along;
    }
    shift[0] += along;
    const int64_t c = grid_cell(d, g[0], g[1], g[2]);
    const double reach2 = clx_cell_reach2(cell);
    for (int32_t k = d->first[c]; k < d->first[c + 1]; ++k) {
        CLX_TRY(cut_by(d, i, d->item[k], shift, reach2, cell));
    }
done:
    return status;
}

/// Cuts by all spheres of the grid cells at `ring` cells' distance.
static clast_status cut_ring(const diagram *d, int32_t i, int32_t ring, clx_cell *cell)
{
    CLAST_ASSERT(ring >= 0);
    clast_status status = CLAST_OK;
    int32_t home[3];
    for (int k = 0; k < 3; ++k) {
        home[k] = grid_index(d, d->centre[i], k);
    }
    for (int32_t z = -ring; z <= ring; ++z) {
        for (int32_t y = -ring; y <= ring; ++y) {
            const bool is_face = abs(z) == ring || abs(y) == ring;
            for (int32_t x = -ring; x <= ring; x += is_face || ring == 0 ? 1 : 2 * ring) {
                const int32_t at[3] = {home[0] + x, home[1] + y, home[2] + z};
                CLX_TRY(cut_grid_cell(d, i, at, cell));
            }
        }
    }
done:
    return status;
}

static clast_status make_cell(const diagram *d, int32_t i, clx_cell *cell)
{
    clast_status status = CLAST_OK;
    int32_t most = 0;
    for (int k = 0; k < 3; ++k) {
        most = d->size[k] > most ? d->size[k] : most;
    }
    CLX_TRY(walls(d, i, cell));
    const double gain = d->largest * d->largest - d->radius[i] * d->radius[i];
    for (int32_t ring = 0; ring <= 2 * most; ++ring) {
        // Whatever lies in this ring and beyond is at least (ring - 1) steps away, or one less
        // where cells of images lie between those of the grid.
        const double away = (ring - (is_sheared(d) ? 2 : 1)) * d->least;
        const double radius = sqrt(clx_cell_reach2(cell));
        if (away > 0.0 && (away * away - gain) / (2.0 * away) > radius && away * away > gain) {
            break;
        }
        CLX_TRY(cut_ring(d, i, ring, cell));
    }
    CLX_TRY(round_wall(d, i, cell));
done:
    return status;
}

/// Whether a wall's mark is of a side that cuts the cell but not the grain.
static bool is_cut(const diagram *d, int32_t mark)
{
    return d->bed->is_part && (mark == ROUND || mark >= -4);
}

static clast_status make_cells(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_status status = CLAST_OK;
    diagram *d = context;
    clx_cell grown = {0};
    clx_cell *cell = &grown;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        CLX_TRY(make_cell(d, (int32_t)i, cell));
        d->volume[i] = clx_cell_volume(cell);
        d->porosity[i] = d->volume[i] > 0.0 ? 1.0 - d->own[i] / d->volume[i] : (double)NAN;
        d->n_face[i] = cell->n_face;
        d->border[i] = 0.0;
        for (int32_t f = 0; f < cell->n_face; ++f) {
            const int32_t mark = cell->face[f].mark;
            if (mark < -2 * d->n_period) {
                d->border[i] = 1.0;
                d->porosity[i] = is_cut(d, mark) ? (double)NAN : d->porosity[i];
            }
        }
    }
done:
    clx_cell_free(cell);
    return status;
}

/// Columns of the result; the diagram's results point into them.
static clast_status make_columns(const clast_assembly *assembly, diagram *d, clast_table *table)
{
    static const char *const column[][2] = {{"grain", "-"},       {"cell_m3", "m^3"},
                                            {"volume_m3", "m^3"}, {"porosity", "-"},
                                            {"n_face", "-"},      {"border", "-"}};
    clast_status status = CLAST_OK;
    CLX_TRY(CLX_ADD_COLUMNS(table, column));
    for (int32_t i = 0; i < d->n; ++i) {
        const int32_t grain = d->grain[i];
        const double s = assembly->scale[grain];
        table->column[0].number[i] = grain;
        table->column[2].number[i] = s * s * s * assembly->shape[assembly->shape_id[grain]].volume;
    }
    d->volume = table->column[1].number;
    d->own = table->column[2].number;
    d->porosity = table->column[3].number;
    d->n_face = table->column[4].number;
    d->border = table->column[5].number;
done:
    return status;
}

clast_status clast_porosity_local(const clast_assembly *assembly, const clast_bed *bed,
                                  double z_low, double z_high, clast_table *table)
{
    CLX_ARGUMENTS(assembly, bed, table);
    CLX_WHOLE(assembly, assembly);
    CLX_WHOLE(bed, bed);
    clast_status status = CLAST_OK;
    clast_table made = {0};
    diagram d = {.bed = bed, .z_low = z_low, .z_high = z_high};
    d.n_period = !clast_bed_period(bed, d.period) ? 0 : bed->kind == CLAST_BED_PERIODIC ? 2 : 3;
    CLX_CHECK(bed->kind != CLAST_BED_MESH, CLAST_E_USAGE,
              "local porosity knows cylinder, box and periodic beds, not the inside of a surface");
    CLX_CHECK(d.n_period < 3 || (z_low == bed->floor && z_high == bed->ceiling), CLAST_E_USAGE,
              "a bed that is periodic in all three directions is taken whole, from %g to %g",
              bed->floor, bed->ceiling);
    CLX_CHECK(z_high > z_low && clast_bed_area(bed) > 0.0, CLAST_E_USAGE,
              "a bed from %s to %s over %s holds nothing", clx_unit_text(z_low, "m"),
              clx_unit_text(z_high, "m"), clx_unit_text(clast_bed_area(bed), "m^2"));
    CLX_TRY(copy_spheres(assembly, &d));
    CLX_TRY(make_grid(&d));
    CLX_TRY(clast_table_init(&made, "local", d.n));
    CLX_TRY(make_columns(assembly, &d, &made));
    CLX_TRY(clx_parallel_try(d.n, BLOCK, make_cells, &d));
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    diagram_free(&d);
    return status;
}
