// Has the cloud changed since an earlier call, and the cells of that call with the points of this
// one. [docs/theory/decompose.md section 15]
#include "cloud/reuse.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/bins.h"
#include "cloud/uniformity_tree.h"
#include "math/morton.h"
#include "math/special.h"
#include <math.h>
#include <string.h>

enum { POINTS_A_BLOCK = 10, MOST_LEVELS = 6, POINTS_A_TASK = 8192, MOST_TABLE_BITS = 20 };

static double weight_of(const clast_cloud *cloud, int64_t i)
{
    return cloud->weight != NULL ? cloud->weight[i] : 1.0;
}

void clx_moments_of(const clast_cloud *cloud, const clx_sample *sample, clx_moments *moments)
{
    const int32_t d = sample->domain->dimension;
    double total = 0.0;
    double square = 0.0;
    double sum[3] = {0};
    double product[3][3] = {{0}};
    for (int64_t i = 0; i < sample->n; ++i) {
        if (sample->number[i] < 0) {
            continue;
        }
        const double w = weight_of(cloud, sample->number[i]);
        total += w;
        square += w * w;
        for (int32_t a = 0; a < d; ++a) {
            const double off = w * (sample->u[i * d + a] - 0.5);
            sum[a] += off;
            for (int32_t b = 0; b <= a; ++b) {
                product[a][b] += off * (sample->u[i * d + b] - 0.5);
            }
        }
    }
    *moments = (clx_moments){.n = square > 0.0 ? total * total / square : 0.0};
    for (int32_t a = 0; a < d && total > 0.0; ++a) {
        moments->mean[a] = sum[a] / total;
        for (int32_t b = 0; b <= a; ++b) {
            moments->covariance[a][b] = product[a][b] / total - moments->mean[a] * moments->mean[b];
        }
    }
}

/// |change| in standard errors; any change of a quantity without scatter is infinite.
static double in_errors(double change, double variance)
{
    return change == 0.0 ? 0.0 : variance > 0.0 ? fabs(change) / sqrt(variance) : (double)INFINITY;
}

double clx_moments_drift(const clx_moments *before, const clx_moments *now, int32_t d)
{
    double most = 0.0;
    for (int32_t a = 0; a < d; ++a) {
        const double own = before->covariance[a][a];
        most = fmax(most, in_errors(now->mean[a] - before->mean[a], own / before->n));
        for (int32_t b = 0; b <= a; ++b) {
            const double both = before->covariance[a][b];
            const double variance = (own * before->covariance[b][b] + both * both) / before->n;
            most = fmax(most, in_errors(now->covariance[a][b] - both, variance));
        }
    }
    return most;
}

int32_t clx_blocks_levels(int64_t n, int32_t d)
{
    CLAST_ASSERT(d >= 1 && d <= 3);
    int32_t levels = 1;
    while (levels < MOST_LEVELS && n >> (d * (levels + 1)) >= POINTS_A_BLOCK) {
        ++levels;
    }
    return levels;
}

clast_status clx_blocks_count(const clast_cloud *cloud, const clx_sample *sample, int32_t levels,
                              clx_blocks *blocks)
{
    clast_status status = CLAST_OK;
    const int32_t d = sample->domain->dimension;
    const int shift = d * (CLX_MORTON_LEVELS - levels);
    clx_blocks_free(blocks);
    blocks->d = d;
    blocks->levels = levels;
    blocks->n = INT64_C(1) << (d * levels);
    CLX_TRY(clx_alloc(&blocks->sum, blocks->n, sizeof *blocks->sum));
    CLX_TRY(clx_alloc(&blocks->square, blocks->n, sizeof *blocks->square));
    for (int64_t i = 0; i < sample->n; ++i) {
        if (sample->number[i] >= 0) {
            const double w = weight_of(cloud, sample->number[i]);
            const uint64_t b = clx_morton_of(sample->u + i * d, d) >> shift;
            blocks->sum[b] += w;
            blocks->square[b] += w * w;
            blocks->total += w;
        }
    }
done:
    return status;
}

void clx_blocks_free(clx_blocks *blocks)
{
    CLX_FREE(blocks->sum, blocks->square);
    *blocks = (clx_blocks){0};
}

/// Two-sample chi-square of the blocks `levels` halvings down: its upper probability.
static double change_at(const clx_blocks *a, const clx_blocks *b, int32_t levels)
{
    CLAST_ASSERT(levels >= 1 && a->d == b->d);
    const int64_t each = a->n >> (a->d * levels);
    double chi2 = 0.0;
    double n_filled = 0.0;
    for (int64_t begin = 0; begin < a->n; begin += each) {
        double off = 0.0;
        double variance = 0.0;
        for (int64_t i = begin; i < begin + each; ++i) {
            off += a->sum[i] / a->total - b->sum[i] / b->total;
            variance += a->square[i] / (a->total * a->total) + b->square[i] / (b->total * b->total);
        }
        chi2 += variance > 0.0 ? off * off / variance : 0.0;
        n_filled += variance > 0.0 ? 1.0 : 0.0;
    }
    return n_filled > 1.0 ? clx_chi2_sf(chi2, n_filled - 1.0) : 1.0;
}

double clx_blocks_change(const clx_blocks *before, const clx_blocks *now)
{
    double least = 1.0;
    if (!(before->total > 0.0 && now->total > 0.0)) {
        return before->total == now->total ? 1.0 : 0.0;
    }
    for (int32_t levels = 1; levels <= before->levels; ++levels) {
        least = fmin(least, before->levels * change_at(before, now, levels));
    }
    return least;
}

/// About 4 boxes a cell, so that few cells are left to search in each.
static clast_status make_table(const clast_cells *cells, int32_t d, clx_cell_cache *cache)
{
    clast_status status = CLAST_OK;
    while (d * (cache->levels + 1) <= MOST_TABLE_BITS &&
           INT64_C(1) << (d * cache->levels) < INT64_C(4) * cells->n) {
        ++cache->levels;
    }
    const int shift = d * (CLX_MORTON_LEVELS - cache->levels);
    cache->n_box = INT64_C(1) << (d * cache->levels);
    CLX_TRY(clx_alloc(&cache->first, cache->n_box + 1, sizeof *cache->first));
    int32_t c = 0;
    for (int64_t b = 0; b < cache->n_box; ++b) {
        while (c + 1 < cells->n && cells->key[c + 1] <= (uint64_t)b << shift) {
            ++c;
        }
        cache->first[b] = c;
    }
    cache->first[cache->n_box] = cells->n - 1;
done:
    return status;
}

static void cell_cache_free(clx_cell_cache *cache)
{
    CLX_FREE(cache->low, cache->high, cache->volume, cache->first);
    *cache = (clx_cell_cache){0};
}

clast_status clx_cell_cache_copy(const clast_cells *cells, int32_t d, clx_cell_cache *cache)
{
    clast_status status = CLAST_OK;
    const size_t n = (size_t)cells->n;
    clx_cell_cache made = {.n = cells->n};
    CLX_TRY(clx_alloc(&made.low, cells->n, sizeof *made.low));
    CLX_TRY(clx_alloc(&made.high, cells->n, sizeof *made.high));
    CLX_TRY(clx_alloc(&made.volume, cells->n, sizeof *made.volume));
    memcpy(made.low, cells->low, n * sizeof *made.low);
    memcpy(made.high, cells->high, n * sizeof *made.high);
    memcpy(made.volume, cells->volume, n * sizeof *made.volume);
    if (cells->key != NULL && cells->n > 0) {
        CLX_TRY(make_table(cells, d, &made));
    }
    cell_cache_free(cache);
    *cache = made;
    made = (clx_cell_cache){0};
done:
    cell_cache_free(&made);
    return status;
}

typedef struct {
    const clx_cell_cache *cache;
    const clx_sample *sample;
    clast_cells *cells;
} refill;

static int32_t cell_at(const refill *r, const double *u)
{
    const clast_cells *cells = r->cells;
    const clx_cell_cache *cache = r->cache;
    const int32_t d = r->sample->domain->dimension;
    if (cells->of_bin != NULL) {
        const clx_bins bins = {.d = d, .nb = {cells->nb[0], cells->nb[1], cells->nb[2]}};
        return cells->of_bin[clx_bins_of(&bins, u)];
    }
    if (cache->first == NULL) {
        return cells->n > 0 ? 0 : -1;
    }
    const uint64_t at = clx_morton_of(u, d);
    const uint64_t box = at >> (d * (CLX_MORTON_LEVELS - cache->levels));
    const int32_t c =
        clx_uniformity_tree_last(cells->key, cache->first[box], cache->first[box + 1] + 1, at);
    if (r->sample->domain->kind != CLAST_DOMAIN_MESH) {
        return c;
    }
    bool inside = true; // not so in a void of a mesh domain, whose cell was left out
    for (int32_t j = 0; j < d; ++j) {
        inside = inside && u[j] >= cache->low[c][j] && u[j] <= cache->high[c][j];
    }
    return inside ? c : -1;
}

static void locate(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const refill *r = context;
    const int32_t d = r->sample->domain->dimension;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        if (r->sample->number[i] >= 0) {
            r->cells->of_point[r->sample->number[i]] = cell_at(r, r->sample->u + i * d);
        }
    }
}

clast_status clx_cell_cache_refill(const clx_cell_cache *cache, const clx_sample *sample,
                                   int64_t n_point, clast_cells *cells, bool *has_all)
{
    clast_status status = CLAST_OK;
    refill r = {cache, sample, cells};
    const size_t n = (size_t)cache->n;
    clx_free(cells->of_point);
    cells->of_point = NULL;
    CLX_TRY(clx_alloc(&cells->of_point, n_point, sizeof *cells->of_point));
    memset(cells->of_point, 0xff, (size_t)n_point * sizeof *cells->of_point);
    clx_parallel_for(sample->n, POINTS_A_TASK, locate, &r);
    memset(cells->count, 0, n * sizeof *cells->count);
    *has_all = true;
    for (int64_t i = 0; i < sample->n; ++i) {
        const int32_t c = sample->number[i] >= 0 ? cells->of_point[sample->number[i]] : -1;
        *has_all = *has_all && (c >= 0 || sample->number[i] < 0);
        if (c >= 0) {
            ++cells->count[c];
        }
    }
    memcpy(cells->low, cache->low, n * sizeof *cells->low);
    memcpy(cells->high, cache->high, n * sizeof *cells->high);
    memcpy(cells->volume, cache->volume, n * sizeof *cells->volume);
done:
    return status;
}

/// Fowler, Noll and Vo's hash, 64 bits.
static void mix(uint64_t *hash, const void *bytes, size_t n)
{
    const unsigned char *at = bytes;
    for (size_t i = 0; i < n; ++i) {
        *hash = (*hash ^ at[i]) * UINT64_C(0x100000001b3);
    }
}

static size_t size_of(clast_field_type type)
{
    switch (type) {
    case CLAST_FIELD_F64:
        return sizeof(double);
    case CLAST_FIELD_I32:
    case CLAST_FIELD_CHOICE:
        return sizeof(int32_t);
    case CLAST_FIELD_I64:
    case CLAST_FIELD_U64:
        return sizeof(int64_t);
    case CLAST_FIELD_BOOL:
        return sizeof(bool);
    case CLAST_FIELD_TEXT:
    case CLAST_FIELD_TEXT_LIST:
    case CLAST_FIELD_F64_LIST:
        break;
    }
    return 0;
}

uint64_t clx_setup_of(const clast_domain *domain, const clast_decompose_config *config)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (const clast_field *f = clast_decompose_fields; f->name != NULL; ++f) {
        const char *slot = (const char *)config + f->offset;
        if (f->type == CLAST_FIELD_TEXT) {
            const char *text = NULL;
            memcpy(&text, slot, sizeof text);
            mix(&hash, text != NULL ? text : "", text != NULL ? strlen(text) + 1 : 1);
        } else {
            mix(&hash, slot, size_of(f->type));
        }
    }
    mix(&hash, &domain->kind, sizeof domain->kind);
    mix(&hash, &domain->dimension, sizeof domain->dimension);
    mix(&hash, domain->low, sizeof domain->low);
    mix(&hash, domain->high, sizeof domain->high);
    mix(&hash, &domain->radius, sizeof domain->radius);
    mix(&hash, &domain->length, sizeof domain->length);
    mix(&hash, &domain->user.volume, sizeof domain->user.volume);
    mix(&hash, &domain->user.map, sizeof domain->user.map);
    mix(&hash, &domain->user.context, sizeof domain->user.context);
    mix(&hash, &domain->surface, sizeof domain->surface);
    return hash;
}
