// Porosity by height and in bulk.                               [Rettinger et al. sec. 4.4, eq. 16]
#include <clast/porosity.h>

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/parallel.h"
#include "base/status.h"
#include "porosity/slabs.h"
#include "porosity/whole.h"
#include <clast/assembly.h>
#include <clast/mesh.h>
#include <clast/shape.h>
#include <math.h>
#include <string.h>

enum { SLICE_LIMIT = 10000000, BLOCK = 64 };

clast_porosity_options clast_porosity_options_default(void)
{
    return (clast_porosity_options){
        .method = CLAST_POROSITY_EXACT, .layer = 1e-3, .cut = 0.5, .trim = 0.0, .at_slice = false};
}

/// Slices that the grains of one block reach, each once, in the order of grains.
typedef struct {
    int64_t n;
    int32_t *slice; ///< [n]
    double *solid;  ///< [n] volume of the block's grains
} reached;

/// What one worker adds up in: a block's grains reach few slices of a tall bed.
typedef struct {
    double *solid;   ///< [n_slice] zero between blocks
    double *shifted; ///< [n_slice + 1] edges as an image sees them
    double *whole;   ///< [n_slice] a grain of which a part counts, zero between grains; else NULL
} bench;

/// Blocks of grains, added in block order afterwards.
typedef struct {
    const clast_assembly *assembly;
    clast_porosity_method method;
    int32_t n_slice;
    const double *edge;
    int64_t first, n_block; ///< blocks of this round
    double period;          ///< in height, 0: none; grains begin in the first image
    double *beyond;         ///< [n_grain] share of each that does not count, or NULL
    bench *bench;           ///< [workers]
    reached *block;         ///< [n_block]
} gathering;

/// Slices [range[0], range[1]) that grain i, moved up by `shift`, can reach.
static void range_of(const gathering *g, int32_t i, double shift, int32_t range[2])
{
    CLAST_ASSERT(i >= 0 && i < g->assembly->n_grain);
    const clast_shape *shape = &g->assembly->shape[g->assembly->shape_id[i]];
    const double equal = cbrt(0.75 / CLAST_PI * shape->volume); // radius of its volume's sphere
    const double z = g->assembly->position[i][2] + shift;
    const double bounding_radius = g->assembly->scale[i] * fmax(shape->bounding_radius, equal);
    const double rounding = 1e-12 * (fabs(z) + bounding_radius);
    range[0] = clx_slice_of(g->n_slice, g->edge, z - bounding_radius - rounding);
    range[1] = clx_slice_of(g->n_slice, g->edge, z + bounding_radius + rounding);
    range[1] += range[1] < g->n_slice ? 1 : 0;
}

/// Images of a grain: itself, or in a bed that repeats in height those above and below too.
static int n_image(const gathering *g)
{
    return g->period > 0.0 ? 3 : 1;
}

/// An image sees the edges the other way: the grain stays.
static double shift_of(const gathering *g, int image)
{
    CLAST_ASSERT(image >= 0 && image < 3);
    return g->period > 0.0 ? (image - 1) * g->period : 0.0;
}

static clast_status add_grain(const gathering *g, int32_t i, const bench *at)
{
    clast_status status = CLAST_OK;
    for (int image = 0; image < n_image(g); ++image) {
        int32_t range[2];
        const double shift = shift_of(g, image);
        range_of(g, i, -shift, range);
        for (int32_t k = range[0]; k <= range[1]; ++k) {
            at->shifted[k] = g->edge[k] + shift;
        }
        const bool is_part = g->beyond != NULL && g->beyond[i] > 0.0;
        CLX_TRY(clx_grain_slabs(g->assembly, i, g->method, range[1] - range[0],
                                at->shifted + range[0],
                                (is_part ? at->whole : at->solid) + range[0]));
        for (int32_t k = range[0]; k < range[1] && is_part; ++k) {
            at->solid[k] += (1.0 - g->beyond[i]) * at->whole[k];
            at->whole[k] = 0.0;
        }
    }
done:
    return status;
}

/// The block's slices from the worker's, which are zero again afterwards.
static clast_status collect(const gathering *g, int32_t from, int32_t to, const bench *at,
                            reached *block)
{
    CLAST_ASSERT(from <= to && to <= g->assembly->n_grain);
    clast_status status = CLAST_OK;
    int64_t most = 0;
    int32_t range[2];
    for (int32_t i = from; i < to; ++i) {
        for (int image = 0; image < n_image(g); ++image) {
            range_of(g, i, -shift_of(g, image), range);
            most += range[1] - range[0];
        }
    }
    most = most < g->n_slice ? most : g->n_slice;
    CLX_TRY(clx_alloc(&block->slice, most, sizeof *block->slice));
    CLX_TRY(clx_alloc(&block->solid, most, sizeof *block->solid));
    for (int32_t i = from; i < to; ++i) {
        for (int image = 0; image < n_image(g); ++image) {
            range_of(g, i, -shift_of(g, image), range);
            for (int32_t k = range[0]; k < range[1]; ++k) {
                if (at->solid[k] != 0.0) {
                    block->slice[block->n] = k;
                    block->solid[block->n++] = at->solid[k];
                    at->solid[k] = 0.0;
                }
            }
        }
    }
done:
    return status;
}

static clast_status gather(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_status status = CLAST_OK;
    gathering *g = context;
    for (int64_t b = begin; b < end; ++b) {
        const int64_t from = (g->first + b) * BLOCK;
        const int64_t to =
            from + BLOCK < g->assembly->n_grain ? from + BLOCK : g->assembly->n_grain;
        for (int64_t i = from; i < to; ++i) {
            CLX_TRY(add_grain(g, (int32_t)i, &g->bench[worker]));
        }
        CLX_TRY(collect(g, (int32_t)from, (int32_t)to, &g->bench[worker], &g->block[b]));
    }
done:
    return status;
}

static void add_blocks(gathering *g, double *solid)
{
    for (int64_t b = 0; b < g->n_block; ++b) {
        reached *block = &g->block[b];
        for (int64_t k = 0; k < block->n && solid != NULL; ++k) {
            solid[block->slice[k]] += block->solid[k];
        }
        CLX_FREE(block->slice, block->solid);
        *block = (reached){0};
    }
}

/// Solid volume of all grains in slices. Blocks go in rounds, so that memory stays bounded.
/// O(grains times the slices that one reaches + slices times workers).
static clast_status slabs(const clast_assembly *assembly, const clast_bed *bed,
                          const clast_porosity_options *options, int32_t n, const double *edge,
                          double *solid)
{
    clast_status status = CLAST_OK;
    const int64_t n_block = (assembly->n_grain + BLOCK - 1) / BLOCK;
    const int64_t most = 64;
    const int32_t n_bench = clx_parallel_workers();
    gathering g = {.assembly = assembly, .method = options->method, .n_slice = n, .edge = edge};
    double period[3];
    (void)clast_bed_period(bed, period);
    g.period = period[2];
    if (bed->is_part) {
        CLX_TRY(clx_alloc(&g.beyond, assembly->n_grain, sizeof *g.beyond));
        CLX_TRY(clx_bed_shares_beyond(bed, assembly, options->method, g.beyond));
    }
    CLX_TRY(clx_alloc(&g.block, most, sizeof *g.block));
    CLX_TRY(clx_alloc(&g.bench, n_bench, sizeof *g.bench));
    for (int32_t k = 0; k < n_bench; ++k) {
        CLX_TRY(clx_alloc(&g.bench[k].solid, n, sizeof *g.bench[k].solid));
        CLX_TRY(clx_alloc(&g.bench[k].shifted, n + 1LL, sizeof *g.bench[k].shifted));
        CLX_TRY(clx_alloc(&g.bench[k].whole, bed->is_part ? n : 0, sizeof *g.bench[k].whole));
    }
    for (g.first = 0; g.first < n_block; g.first += most) {
        g.n_block = n_block - g.first < most ? n_block - g.first : most;
        CLX_TRY(clx_parallel_try(g.n_block, 1, gather, &g));
        add_blocks(&g, solid);
    }
done:
    if (g.block != NULL) {
        add_blocks(&g, NULL);
    }
    for (int32_t k = 0; k < n_bench && g.bench != NULL; ++k) {
        CLX_FREE(g.bench[k].solid, g.bench[k].shifted, g.bench[k].whole);
    }
    CLX_FREE(g.beyond, g.bench, g.block);
    return status;
}

static clast_status fill_columns(const clast_assembly *assembly, const clast_bed *bed,
                                 const clast_porosity_options *options, clast_table *table)
{
    clast_status status = CLAST_OK;
    const int32_t n = (int32_t)table->n_row;
    double *volume = NULL;
    double *edge = NULL;
    double *low = NULL;
    double *high = NULL;
    double *solid = NULL;
    double *porosity = NULL;
    CLX_TRY(clast_table_add_number(table, "z_low_m", "m", &low));
    CLX_TRY(clast_table_add_number(table, "z_high_m", "m", &high));
    CLX_TRY(clast_table_add_number(table, "solid_m3", "m^3", &solid));
    CLX_TRY(clast_table_add_number(table, "porosity", "-", &porosity));
    CLX_TRY(clx_alloc(&edge, n + 1LL, sizeof *edge));
    for (int32_t k = 0; k <= n; ++k) {
        edge[k] = bed->floor + k * options->layer;
    }
    if (bed->kind == CLAST_BED_PERIODIC_3D) {
        edge[n] = bed->ceiling; // the last slice may be thinner
    }
    for (int32_t k = 0; k < n; ++k) {
        low[k] = edge[k];
        high[k] = edge[k + 1];
    }
    CLX_TRY(clx_alloc(&volume, n, sizeof *volume));
    clast_bed_volumes(bed, n, edge, volume);
    edge[0] = clx_lowest_edge(assembly, bed, options);
    if (bed->kind != CLAST_BED_MESH &&
        bed->kind != CLAST_BED_PERIODIC_3D) { // what lies above a container's rim lies outside
        edge[n] = HUGE_VAL;
    }
    CLX_TRY(slabs(assembly, bed, options, n, edge, solid));
    for (int32_t k = 0; k < n; ++k) {
        porosity[k] = volume[k] > 0.0 ? 1.0 - solid[k] / volume[k] : 1.0;
    }
done:
    CLX_FREE(volume, edge);
    return status;
}

/// Images are looked for one period away.
static clast_status check_images(const clast_assembly *assembly, const clast_bed *bed)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < assembly->n_grain && bed->kind == CLAST_BED_PERIODIC_3D; ++i) {
        const double z = assembly->position[i][2];
        const double bounding_radius =
            assembly->scale[i] * assembly->shape[assembly->shape_id[i]].bounding_radius;
        CLX_CHECK(z >= bed->floor && z <= bed->ceiling, CLAST_E_USAGE,
                  "grain %d lies at z = %g, outside of the first image: call clast_bed_wrap", i, z);
        CLX_CHECK(bounding_radius <= bed->ceiling - bed->floor, CLAST_E_GEOMETRY,
                  "grain %d has a bounding radius of %g, more than the period of %g", i,
                  bounding_radius, bed->ceiling - bed->floor);
    }
done:
    return status;
}

static clast_status check_options(const clast_porosity_options *o)
{
    clast_status status = CLAST_OK;
    CLX_CHECK((unsigned)o->method <= CLAST_POROSITY_SPHERES, CLAST_E_ARGUMENT,
              "porosity: there is no method %d", (int)o->method);
    CLX_CHECK(o->layer > 0.0 && isfinite(o->layer), CLAST_E_USAGE,
              "porosity: slices of %s; they must be finite and above 0",
              clx_unit_text(o->layer, "m"));
    CLX_CHECK(isfinite(o->cut) && o->trim >= 0.0 && isfinite(o->trim), CLAST_E_ARGUMENT,
              "porosity: a cut of %g and a trim of %s; both must be finite, the trim not negative",
              o->cut, clx_unit_text(o->trim, "m"));
done:
    return status;
}

/// Height up to which the bed may hold solid.
static double highest(const clast_assembly *assembly, const clast_bed *bed,
                      const clast_porosity_options *options)
{
    double low[3];
    double high[3];
    double rim[3] = {0.0, 0.0, HUGE_VAL};
    clast_assembly_bounds(assembly, low, high);
    for (int32_t i = 0; i < assembly->n_grain && options->method == CLAST_POROSITY_SPHERES; ++i) {
        const clast_shape *shape = &assembly->shape[assembly->shape_id[i]];
        high[2] = fmax(high[2], assembly->position[i][2] +
                                    assembly->scale[i] * cbrt(0.75 / CLAST_PI * shape->volume));
    }
    if (bed->kind == CLAST_BED_MESH) {
        clast_mesh_bounds(bed->surface, low, rim);
    }
    return fmin(high[2], rim[2]);
}

clast_status clast_porosity_profile(const clast_assembly *assembly, const clast_bed *bed,
                                    const clast_porosity_options *options, clast_table *table)
{
    CLX_ARGUMENTS(assembly, bed, options, table);
    CLX_WHOLE(assembly, assembly);
    CLX_WHOLE(bed, bed);
    clast_status status = CLAST_OK;
    clast_table made = {0};
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to measure");
    CLX_TRY(check_options(options));
    CLX_CHECK(clast_bed_area(bed) > 0.0, CLAST_E_USAGE, "slices of %s over %s hold nothing",
              clx_unit_text(options->layer, "m"), clx_unit_text(clast_bed_area(bed), "m^2"));
    const double n =
        bed->kind == CLAST_BED_PERIODIC_3D
            ? fmax(1.0, ceil((bed->ceiling - bed->floor) / options->layer * (1.0 - 1e-12)))
            : fmax(1.0,
                   ceil((highest(assembly, bed, options) - bed->floor) / options->layer) + 1.0);
    CLX_TRY(check_images(assembly, bed));
    CLX_CHECK(n <= SLICE_LIMIT, CLAST_E_LIMIT,
              "%g slices of %s; at most %d (coordinates in another unit?)", n,
              clx_unit_text(options->layer, "m"), SLICE_LIMIT);
    CLX_TRY(clast_table_init(&made, "profile", (int64_t)n));
    CLX_TRY(fill_columns(assembly, bed, options, &made));
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

/// Height where the porosity rises through the cut, searched from the top; with a cut of 1 that of
/// the highest solid.
static clast_status find_top(const clast_assembly *assembly, const clast_bed *bed,
                             const clast_porosity_options *options, const clast_table *profile,
                             double *top)
{
    clast_status status = CLAST_OK;
    const double *low = clast_table_numbers(profile, "z_low_m");
    const double *high = clast_table_numbers(profile, "z_high_m");
    const double *n = clast_table_numbers(profile, "porosity");
    const double *solid = clast_table_numbers(profile, "solid_m3");
    int64_t k = profile->n_row - 1;
    CLX_CHECK(low != NULL && high != NULL && n != NULL && solid != NULL, CLAST_E_USAGE,
              "the table is no porosity profile");
    while (k >= 0 && (n[k] > options->cut || solid[k] == 0.0)) {
        --k;
    }
    CLX_CHECK(k >= 0, CLAST_E_GEOMETRY,
              "no slice is denser than the cut: the least porosity of slices %s high is above %g; "
              "check the bed, a greater cut, or lower slices (layer)",
              clx_unit_text(profile->n_row > 0 ? high[0] - low[0] : 0.0,
                            strcmp(assembly->unit, "m") == 0 ? "m" : "-"),
              options->cut);
    *top = high[k];
    if (options->cut >= 1.0 && bed->is_part) {
        return CLAST_OK; // the highest grain may lie beyond the sides
    }
    if (!options->at_slice && options->cut >= 1.0) {
        *top = highest(assembly, bed, options);
    } else if (!options->at_slice && k + 1 < profile->n_row) {
        const double t = (options->cut - n[k]) / (n[k + 1] - n[k]);
        *top = 0.5 * (low[k] + high[k]) + t * (high[k] - low[k]);
    }
done:
    return status;
}

clast_status clast_porosity_measure(const clast_assembly *assembly, const clast_bed *bed,
                                    const clast_table *profile,
                                    const clast_porosity_options *options,
                                    clast_porosity_bulk *bulk)
{
    CLX_ARGUMENTS(assembly, bed, options, profile, bulk);
    CLX_WHOLE(assembly, assembly);
    CLX_WHOLE(bed, bed);
    CLX_WHOLE(table, profile);
    clast_status status = CLAST_OK;
    clast_porosity_bulk made = {0};
    const bool is_endless = bed->kind == CLAST_BED_PERIODIC_3D;
    CLX_TRY(check_options(options));
    CLX_CHECK(!is_endless || options->trim == 0.0, CLAST_E_USAGE,
              "a bed that is periodic in all three directions has no ends to trim (%g)",
              options->trim);
    made.top = bed->ceiling;
    if (!is_endless) {
        CLX_TRY(find_top(assembly, bed, options, profile, &made.top));
    }
    made.z_low = bed->floor + options->trim;
    made.z_high = made.top - options->trim;
    CLX_CHECK(made.z_high > made.z_low, CLAST_E_GEOMETRY,
              "the bed is %s high: trimming %s at both ends leaves nothing",
              clx_unit_text(made.top - bed->floor, "m"), clx_unit_text(options->trim, "m"));
    const bool cuts_low = options->trim > 0.0 || is_endless;
    const double edge[2] = {cuts_low ? made.z_low : clx_lowest_edge(assembly, bed, options),
                            made.z_high};
    double solid[1] = {0.0};
    CLX_TRY(slabs(assembly, bed, options, 1, edge, solid));
    made.solid = solid[0];
    const double whole[2] = {made.z_low, made.z_high};
    double volume = 0.0;
    clast_bed_volumes(bed, 1, whole, &volume);
    CLX_CHECK(volume > 0.0, CLAST_E_GEOMETRY, "the bed has no volume between %s and %s",
              clx_unit_text(made.z_low, "m"), clx_unit_text(made.z_high, "m"));
    made.porosity = 1.0 - made.solid / volume;
    *bulk = made;
done:
    return status;
}
