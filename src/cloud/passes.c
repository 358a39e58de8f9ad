// Passes: histogram, thresholds, the best of them, ghosts in what it selects, test, again.
#include "cloud/passes.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/boundary_score.h"
#include "cloud/ghosts.h"
#include "cloud/levels.h"
#include "cloud/uniformity.h"
#include "math/rng.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <math.h>
#include <string.h>

enum { N_CHUNK = 8, POINTS_A_BLOCK = 16384 };
enum { GRID_MOST = 20000, GRID_LEAST = 1000, GRID_WORK = 20000000 };

typedef struct {
    const clast_decompose_config *config;
    const clast_comm *comm;
    clast_uniformity_config vote;
    clx_depth_law law;
    double side[3];
    clx_passes *passes;
    clast_table *search;        ///< the result's
    double *u;                  ///< synthetic sample [n][d]
    int64_t n, capacity;        ///< points of it here
    int64_t n_all;              ///< on all ranks
    uint8_t *active;            ///< [n_bin]
    uint8_t *label, *best;      ///< [n_bin]
    int32_t *bin_of, *depth_of; ///< [n] bin and depth class of each point
    int64_t *depth_count;       ///< [N_CHUNK][n_grid + 1]
    int32_t n_grid;
} work;

static void choose_grid(work *w)
{
    double cut = 0.0;
    for (int32_t j = 0; j < w->passes->bins.d; ++j) {
        cut = fmax(cut, 2.0 / (w->passes->bins.nb[j] * w->law.c[j]));
    }
    const double fits = GRID_WORK / ((double)w->passes->bins.n_bin * fmin(1.0, cut));
    w->n_grid = (int32_t)fmin(GRID_MOST, fmax(GRID_LEAST, fits));
}

static void classify_points(int64_t begin, int64_t end, int32_t worker, void *context)
{
    work *w = context;
    const int32_t d = w->passes->bins.d;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        w->bin_of[i] = (int32_t)clx_bins_of(&w->passes->bins, w->u + i * d);
        w->depth_of[i] = clx_ghosts_depth_class(&w->law, w->u + i * d, w->n_grid);
    }
}

static clast_status classify(work *w)
{
    clast_status status = CLAST_OK;
    clx_bins *bins = &w->passes->bins;
    CLX_FREE(w->bin_of, w->depth_of);
    w->bin_of = NULL;
    w->depth_of = NULL;
    status = clx_alloc(&w->bin_of, w->n, sizeof *w->bin_of);
    if (status == CLAST_OK) {
        status = clx_alloc(&w->depth_of, w->n, sizeof *w->depth_of);
    }
    if (status == CLAST_OK && bins->count == NULL) {
        status = clx_alloc(&bins->count, bins->n_bin, sizeof *bins->count);
    }
    CLX_TRY(clast_comm_agree(w->comm, status, NULL));
    clx_parallel_for(w->n, POINTS_A_BLOCK, classify_points, w);
    memset(bins->count, 0, (size_t)bins->n_bin * sizeof *bins->count);
    for (int64_t i = 0; i < w->n; ++i) {
        ++bins->count[w->bin_of[i]];
    }
    clx_bins_add_ranks(w->comm, bins);
done:
    return status;
}

typedef struct {
    const work *w;
    const uint8_t *label;
} depth_context;

/// Depth classes of the kept points, a histogram a chunk: integers add up alike in any order.
static void count_depths(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const depth_context *c = context;
    const work *w = c->w;
    (void)worker;
    for (int64_t chunk = begin; chunk < end; ++chunk) {
        int64_t *count = w->depth_count + chunk * (w->n_grid + 1);
        memset(count, 0, ((size_t)w->n_grid + 1) * sizeof *count);
        for (int64_t i = w->n * chunk / N_CHUNK; i < w->n * (chunk + 1) / N_CHUNK; ++i) {
            count[w->depth_of[i]] += c->label[w->bin_of[i]] == 0 ? 1 : 0;
        }
    }
}

static clast_status score_of(work *w, const uint8_t *label, clx_ghost_plan *plan, double *score)
{
    depth_context context = {w, label};
    clx_parallel_for(N_CHUNK, 1, count_depths, &context);
    for (int chunk = 1; chunk < N_CHUNK; ++chunk) {
        for (int32_t k = 0; k <= w->n_grid; ++k) {
            w->depth_count[k] += w->depth_count[(int64_t)chunk * (w->n_grid + 1) + k];
        }
    }
    clx_comm_sum(w->comm, w->depth_count, (int64_t)w->n_grid + 1);
    *plan = clx_ghosts_plan(w->passes->bins.count, label, w->passes->bins.n_bin);
    const clx_ghost_sample sample = {&w->passes->bins, label,    &w->law, *plan,
                                     w->depth_count,   w->n_grid};
    return clast_comm_agree(w->comm, clx_ghosts_expected_score(&sample, score), NULL);
}

/// Bins [range[0], range[1]) into which this rank draws ghosts.
static void own_bins(const work *w, int64_t range[2])
{
    const int64_t n_bin = w->passes->bins.n_bin;
    range[0] = n_bin * w->comm->rank / w->comm->n_rank;
    range[1] = n_bin * (w->comm->rank + 1) / w->comm->n_rank;
}

/// Keys of the depths of one ghost sample in this rank's bins that `label` selects, put into key
/// [capacity]; returns their number.
static int64_t draw_depths(const work *w, const uint8_t *label, double per_bin, uint64_t sample,
                           int64_t capacity, uint64_t *key)
{
    int64_t n = 0;
    int64_t range[2];
    const double whole = floor(per_bin);
    own_bins(w, range);
    for (int64_t b = range[0]; b < range[1]; ++b) {
        double low[3];
        double high[3];
        double u[3];
        if (label[b] == 0) {
            continue;
        }
        clx_rng rng = clx_rng_at(w->config->seed, CLX_STREAM_GHOST, sample | (uint64_t)b);
        clx_bins_box(&w->passes->bins, b, low, high);
        const int64_t here = (int64_t)whole + (clx_rng_uniform(&rng) < per_bin - whole ? 1 : 0);
        CLAST_ASSERT(n + here <= capacity);
        for (int64_t k = 0; k < here && n < capacity; ++k) {
            for (int32_t j = 0; j < w->passes->bins.d; ++j) {
                u[j] = low[j] + (high[j] - low[j]) * clx_rng_uniform(&rng);
            }
            key[n++] = clx_depth_key(clx_depth_of(&w->law, u));
        }
    }
    return n;
}

/// Distance from the law of the points that stay and the ghosts of one sample, of all ranks.
static clast_status one_sample(const work *w, const uint8_t *label, const clx_ghost_plan *plan,
                               uint64_t sample, double *distance)
{
    clast_status status = CLAST_OK;
    int64_t range[2];
    int64_t n = 0;
    int64_t n_ghost = 0;
    uint64_t *key = NULL;
    clx_depths depths = {{0}, 0.0};
    own_bins(w, range);
    for (int64_t b = range[0]; b < range[1]; ++b) {
        n_ghost += label[b] != 0 ? (int64_t)floor(plan->per_bin) + 1 : 0;
    }
    CLX_TRY(clast_comm_agree(w->comm, clx_alloc(&key, w->n + n_ghost, sizeof *key), NULL));
    for (int64_t i = 0; i < w->n; ++i) {
        if (label[w->bin_of[i]] == 0) {
            key[n++] = clx_depth_key(clx_depth_of(&w->law, w->u + i * w->passes->bins.d));
        }
    }
    n += draw_depths(w, label, plan->per_bin, sample, n_ghost, key + n);
    CLX_TRY(clx_depths_of_keys(w->comm, &key, n, &depths));
    *distance = 1.0;
    if (depths.ranked.n_all > 0) {
        CLX_TRY(clx_depths_distance(&w->law, w->comm, &depths, distance));
    }
done:
    clx_free(key);
    clx_depths_free(&depths);
    return status;
}

/// Mean score of config->ghost_samples synthetic samples; their draws are common to thresholds.
static clast_status sampled_score(const work *w, const uint8_t *label, const clx_ghost_plan *plan,
                                  int32_t pass, double *score)
{
    clast_status status = CLAST_OK;
    double sum = 0.0;
    for (int32_t m = 0; m < w->config->ghost_samples; ++m) {
        const uint64_t sample = (uint64_t)(m + 1) << 47 | (uint64_t)pass << 40;
        double distance = 0.0;
        CLX_TRY(one_sample(w, label, plan, sample, &distance));
        sum += distance;
    }
    *score = sum / w->config->ghost_samples;
done:
    return status;
}

/// A row of the table of thresholds searched.
static clast_status note_search(work *w, int32_t number, const clx_label_cut *cut, bool is_lower,
                                const double score[2])
{
    enum { N_COLUMN = 6 };
    static const char *const name[N_COLUMN] = {"pass",  "lambda",      "lower",
                                               "score", "ideal_score", "is_lower_search"};
    clast_status status = CLAST_OK;
    clast_table *table = w->search;
    const int64_t row = table->n_row;
    const double n_bin = (double)w->passes->bins.n_bin;
    const double n = (double)w->n_all;
    const double value[N_COLUMN] = {number,
                                    (double)cut->lambda * n_bin / n,
                                    cut->under * n_bin / n,
                                    score[0],
                                    score[1],
                                    is_lower ? 1.0 : 0.0};
    if (table->n_column == 0) {
        CLX_TRY(clast_table_init(table, "search", 0));
        for (int k = 0; k < N_COLUMN; ++k) {
            CLX_TRY(clast_table_add_number(table, name[k], "-", NULL));
        }
    }
    CLX_TRY(clast_table_resize(table, row + 1));
    for (int k = 0; k < N_COLUMN; ++k) {
        table->column[k].number[row] = value[k];
    }
done:
    return status;
}

/// The best cut so far.
typedef struct {
    clx_label_cut cut;
    clx_ghost_plan plan;
    double nearest; ///< |score / ideal - 1|
} best_cut;

/// Scores one cut; when it is the nearest to its ideal score, its labels go to w->best.
static clast_status try_cut(work *w, const clx_label_cut *cut, bool is_lower, int32_t number,
                            clast_pass *pass, best_cut *best)
{
    clast_status status = CLAST_OK;
    const int64_t n_bin = w->passes->bins.n_bin;
    clx_ghost_plan here;
    double score[2] = {0};
    status = clx_levels_label(w->passes->bins.count, w->active, n_bin, cut, w->label);
    CLX_TRY(clast_comm_agree(w->comm, status, NULL));
    CLX_TRY(score_of(w, w->label, &here, &score[0]));
    if (w->config->ghost_samples > 0) {
        CLX_TRY(sampled_score(w, w->label, &here, number, &score[0]));
    }
    score[1] = clx_depth_ideal(&w->law, fmax(1.0, here.n_expected));
    CLX_TRY(clast_comm_agree(w->comm, note_search(w, number, cut, is_lower, score), NULL));
    if (here.n_ambient > 0 && fabs(score[0] - score[1]) / score[1] < best->nearest) {
        best->nearest = fabs(score[0] - score[1]) / score[1];
        best->cut = *cut;
        best->plan = here;
        pass->score = score[0];
        pass->ideal = score[1];
        memcpy(w->best, w->label, (size_t)n_bin);
    }
done:
    return status;
}

/// The threshold whose expected score is nearest to the ideal one of its synthetic sample; then, if
/// wanted, lower thresholds in the same way: with that one, or with each (joint).
static clast_status search(work *w, const clx_levels *levels, int32_t number, clast_pass *pass,
                           clx_ghost_plan *plan)
{
    clast_status status = CLAST_OK;
    best_cut best = {.nearest = INFINITY};
    clx_label_cut cut = {.under = levels->q20, .is_strict = w->config->strict};
    const bool is_joint = w->config->lower == CLAST_LOWER_JOINT;
    for (int32_t t = 0; t < levels->n_lambda; ++t) {
        cut.lambda = levels->lambda[t];
        CLX_TRY(try_cut(w, &cut, false, number, pass, &best));
    }
    const int32_t found = best.cut.lambda;
    pass->n_lower = w->config->lower != CLAST_LOWER_Q20 && found > 0 ? levels->n_lower : 0;
    for (int32_t t = 0; t < levels->n_lambda * pass->n_lower; ++t) {
        cut.lambda = levels->lambda[t / pass->n_lower];
        cut.under = levels->lower[t % pass->n_lower];
        if (is_joint || cut.lambda == found) {
            CLX_TRY(try_cut(w, &cut, true, number, pass, &best));
        }
    }
    pass->lambda_count = best.plan.n_replaced > 0 ? best.cut.lambda : 0;
    pass->lower = best.cut.under * (double)w->passes->bins.n_bin / (double)w->n_all;
    *plan = best.plan;
done:
    return status;
}

static clast_status add_ghost(work *w, int64_t bin, clx_rng *rng)
{
    const int32_t d = w->passes->bins.d;
    double low[3];
    double high[3];
    clast_status status = clx_grow(&w->u, &w->capacity, w->n + 1, (size_t)d * sizeof *w->u);
    clx_bins_box(&w->passes->bins, bin, low, high);
    for (int32_t j = 0; j < d && status == CLAST_OK; ++j) {
        w->u[w->n * d + j] = low[j] + (high[j] - low[j]) * clx_rng_uniform(rng);
    }
    w->n += status == CLAST_OK ? 1 : 0;
    return status;
}

/// Keeps the points of ambient bins and puts floor(c) or ceil(c) ghosts into each selected one:
/// each rank into a stretch of the bins.
static clast_status replace_here(work *w, const clx_ghost_plan *plan, int32_t pass)
{
    clast_status status = CLAST_OK;
    const int32_t d = w->passes->bins.d;
    int64_t kept = 0;
    for (int64_t i = 0; i < w->n; ++i) {
        if (w->best[w->bin_of[i]] == 0) {
            memmove(w->u + kept * d, w->u + i * d, (size_t)d * sizeof *w->u);
            ++kept;
        }
    }
    w->n = kept;
    int64_t range[2];
    own_bins(w, range);
    for (int64_t b = range[0]; b < range[1]; ++b) {
        if (w->best[b] == 0) {
            continue;
        }
        clx_rng rng =
            clx_rng_at(w->config->seed, CLX_STREAM_GHOST, ((uint64_t)pass << 40) | (uint64_t)b);
        const double whole = floor(plan->per_bin);
        const int64_t n = (int64_t)whole + (clx_rng_uniform(&rng) < plan->per_bin - whole ? 1 : 0);
        for (int64_t k = 0; k < n; ++k) {
            CLX_TRY(add_ghost(w, b, &rng));
        }
    }
done:
    return status;
}

static clast_status replace(work *w, const clx_ghost_plan *plan, int32_t pass)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_comm_agree(w->comm, replace_here(w, plan, pass), NULL));
    for (int64_t b = 0; b < w->passes->bins.n_bin; ++b) {
        if (w->best[b] != 0) {
            w->passes->tag[b] = (uint16_t)(pass * 8 + w->best[b]);
            w->active[b] = 0;
        }
    }
    w->n_all = clx_comm_total(w->comm, w->n);
done:
    return status;
}

/// One pass; *selected is false when there was nothing to select.
static clast_status one_pass(work *w, int32_t number, clast_pass *pass, bool *selected)
{
    clast_status status = CLAST_OK;
    clx_levels levels = {0};
    clx_ghost_plan plan = {0};
    *selected = false;
    CLX_TRY(classify(w));
    status = clx_levels_find(w->passes->bins.count, w->active, w->passes->bins.n_bin, &levels);
    CLX_TRY(clast_comm_agree(w->comm, status, NULL));
    memcpy(pass->nb, w->passes->bins.nb, sizeof pass->nb);
    pass->n_lambda = levels.n_lambda;
    pass->fallback = levels.fallback;
    if (levels.n_lambda > 0) {
        CLX_TRY(search(w, &levels, number, pass, &plan));
    }
    if (pass->lambda_count > 0) {
        pass->lambda =
            (double)pass->lambda_count * (double)w->passes->bins.n_bin / (double)w->n_all;
        CLX_TRY(replace(w, &plan, number));
        *selected = true;
    }
done:
    clx_levels_free(&levels);
    return status;
}

static clast_status iterate(work *w, clast_decomposition *result)
{
    clast_status status = CLAST_OK;
    const bool again = w->config->variant == CLAST_VARIANT_FULL;
    const int32_t most = again ? w->config->max_pass : 1;
    result->stop = again ? CLAST_STOP_MAX_PASS : CLAST_STOP_ONE_PASS;
    for (int32_t k = 0; k < most; ++k) {
        bool reject = false;
        bool selected = false;
        clast_pass pass = {0};
        CLX_TRY(one_pass(w, k + 1, &pass, &selected));
        if (!selected) {
            result->stop = CLAST_STOP_NOTHING;
            break;
        }
        result->pass[result->n_pass++] = pass;
        if (again) {
            const clx_part part = clx_part_of(w->comm, w->u, w->n, w->passes->bins.d);
            CLX_TRY(clx_uniformity_decide(&part, &w->vote, &reject));
            if (!reject) {
                result->stop = CLAST_STOP_UNIFORM;
                break;
            }
        }
    }
done:
    return status;
}

static clast_status alloc_work(work *w)
{
    clast_status status = CLAST_OK;
    const int64_t n_bin = w->passes->bins.n_bin;
    CLX_TRY(clx_alloc(&w->passes->tag, n_bin, sizeof *w->passes->tag));
    CLX_TRY(clx_alloc(&w->active, n_bin, 1));
    CLX_TRY(clx_alloc(&w->label, n_bin, 1));
    CLX_TRY(clx_alloc(&w->best, n_bin, 1));
    CLX_TRY(clx_alloc(&w->depth_count, N_CHUNK * ((int64_t)w->n_grid + 1), sizeof *w->depth_count));
done:
    return status;
}

static clast_status prepare(work *w, const clx_part *part)
{
    clast_status status = CLAST_OK;
    double width[3];
    clx_part own = *part;
    status = clx_grow(&w->u, &w->capacity, part->n + 1, (size_t)part->d * sizeof *w->u);
    CLX_TRY(clast_comm_agree(w->comm, status, NULL));
    clx_part_copy(part, 0, part->n, w->u);
    own.u = w->u;
    CLX_TRY(clx_bins_choose(&own, width, &w->passes->bins));
    choose_grid(w);
    CLX_TRY(clast_comm_agree(w->comm, alloc_work(w), NULL));
    memset(w->active, 1, (size_t)w->passes->bins.n_bin);
    w->n = part->n;
    w->n_all = part->n_all;
done:
    return status;
}

clast_status clx_passes_vote(const clast_decompose_config *config, clast_uniformity_config *vote)
{
    *vote = (clast_uniformity_config){.level = config->level,
                                      .votes = config->votes,
                                      .liang = config->statistic == CLAST_STATISTIC_T,
                                      .paper = config->paper};
    return clast_uniformity_choose(config->tests, &vote->left_out);
}

clast_status clx_passes_run(const clx_part *part, const clast_domain *domain,
                            const clast_decompose_config *config, clast_decomposition *result,
                            clx_passes *passes)
{
    clast_status status = CLAST_OK;
    work w = {.config = config, .comm = part->comm, .passes = passes, .search = &result->search};
    clx_domain_sides(domain, w.side);
    w.law = clx_depth_law_of_box(domain->dimension, w.side);
    CLX_TRY(clx_passes_vote(config, &w.vote));
    CLX_TRY(prepare(&w, part));
    result->points_per_bin = (double)part->n_all / (double)passes->bins.n_bin;
    CLX_TRY(iterate(&w, result));
    CLX_TRY(clx_bins_count(&passes->bins, part)); // the real points again
done:
    CLX_FREE(w.u, w.active, w.label, w.best, w.bin_of, w.depth_of, w.depth_count);
    if (status != CLAST_OK) {
        clx_passes_free(passes);
    }
    return status;
}

void clx_passes_free(clx_passes *passes)
{
    clx_bins_free(&passes->bins);
    clx_free(passes->tag);
    *passes = (clx_passes){0};
}
