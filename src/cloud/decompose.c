// D2SD from points to cells and events.
#include <clast/decompose.h>

#include "base/alloc.h"
#include "base/comm.h"
#include "cloud/boundary_score.h"
#include "cloud/cells.h"
#include "cloud/contract.h"
#include "cloud/cut_cells.h"
#include "cloud/decompose_steps.h"
#include "cloud/events.h"
#include "cloud/pair_events.h"
#include "cloud/part.h"
#include "cloud/passes.h"
#include "cloud/sample.h"
#include "cloud/shuffle.h"
#include "cloud/surface.h"
#include "cloud/uniformity.h"
#include "cloud/uniformity_tree.h"
#include "math/fixed_sum.h"
#include <assert.h>
#include <clast/machine.h>
#include <math.h>
#include <string.h>

#define FIELD(type, name) #name, .offset = offsetof(clast_decompose_config, name), type
const clast_field clast_decompose_fields[] = {
    {FIELD(CLAST_FIELD_TEXT, domain), 0, 0, 0, "-",
     "known domain: box:LOW..,HIGH.., cylinder:R,L or X,Y,Z,NX,NY,NZ,R,L (base, axis), "
     "half-pipe:R,L, sphere:R or X,Y,Z,R, mesh:FILE [m, or as 1mm]",
     "", .common = true, .group = "domain"},
    {FIELD(CLAST_FIELD_CHOICE, outside), 0, 0, 0, "-",
     "points outside the domain: refuse the file, or leave them out", "error|drop", .common = true},
    {FIELD(CLAST_FIELD_CHOICE, variant), 0, 0, 0, "-",
     "how far to go: tests and passes, first test and one pass, one pass, tests alone",
     "full|first|fast|test", .common = true, .group = "method"},
    {FIELD(CLAST_FIELD_CHOICE, mesh), CLAST_CELLS_AUTO, 0, 0, "-",
     "what bins are joined into; tree splits by a chi-square test; auto: tree for the full "
     "variant, else boxes",
     "boxes|components|bins|labels|tree|auto", .common = true},
    {FIELD(CLAST_FIELD_CHOICE, events), 0, 0, 0, "-", "n (n - 1) / 2 pairs, or n^2 as printed",
     "pairs|paper"},
    {FIELD(CLAST_FIELD_F64, level), 0.05, 1e-6, 0.5, "-", "level of each uniformity test"},
    {FIELD(CLAST_FIELD_I32, votes), 2, 1, 5, "-",
     "tests that must reject; where a single one votes, 2 is 1"},
    {FIELD(CLAST_FIELD_TEXT, tests), 0, 0, 0, "-", "tests that vote",
     "symmetric,centred,star,henze_zirkler,pearson"},
    {FIELD(CLAST_FIELD_CHOICE, statistic), 0, 0, 0, "-",
     "of the discrepancies: A_n as published, or Liang's stronger T", "A|T"},
    {FIELD(CLAST_FIELD_BOOL, paper), 0, 0, 0, "-",
     "p-values, score (trapezoids) and events (n^2 / V) as printed, errors included"},
    {FIELD(CLAST_FIELD_I32, ghost_samples), 0, 0, 65535, "-",
     "expected scores by so many ghost samples; 0: without sampling"},
    {FIELD(CLAST_FIELD_BOOL, crossfit), 0, 0, 0, "-",
     "events by cross-fitting too: cells of one half of the points, counts of the other half",
     .common = true},
    {FIELD(CLAST_FIELD_CHOICE, lower), 0, 0, 0, "-",
     "lower threshold: the 20th percentile, or searched in [Q20, Q40) like the upper one, after it "
     "or jointly",
     "q20|search|joint"},
    {FIELD(CLAST_FIELD_BOOL, strict), 0, 0, 0, "-",
     "bins exactly at a threshold are ambient (the prose; the printed algorithm takes them)"},
    {FIELD(CLAST_FIELD_I32, max_pass), 10, 1, CLAST_MAX_PASS, "-", "passes at the most"},
    {FIELD(CLAST_FIELD_F64, beta_dt), 0.0, 0.0, 1e300, "m^d",
     "collision kernel times time step [m^d]; 0: pair integral per beta dt [1/m^d]",
     CLAST_KEEPS_DIMENSION, .common = true},
    {FIELD(CLAST_FIELD_F64, tree_level), 0.01, 1e-9, 0.5, "-",
     "level of the test in each tree cell", .group = "tree"},
    {FIELD(CLAST_FIELD_F64, tree_root_level), 1e-4, 1e-12, 0.5, "-",
     "level of the test that splits the whole cloud into a tree: uniform clouds split by chance"},
    {FIELD(CLAST_FIELD_F64, variable_tolerance), 0.0, 0.0, 1e300, "-",
     "standard deviation that a tree cell may keep of the variable (its column's unit)"},
    {FIELD(CLAST_FIELD_I32, tree_least), 16, 2, 1000000, "-",
     "points below which a tree cell is not split"},
    {FIELD(CLAST_FIELD_BOOL, tree_refine), 1, 0, 0, "-",
     "give each cell of a tree that was split as the blocks its last test looked at"},
    {FIELD(CLAST_FIELD_BOOL, extrapolate), 1, 0, 0, "-",
     "add the pairs that tree cells hide by being taken as uniform, from pairs at two sizes of "
     "cells"},
    {FIELD(CLAST_FIELD_BOOL, pairs), 0, 0, 0, "-",
     "count pairs by distance: g(r), and events by pairs beside those by cells", .common = true,
     .group = "pairs"},
    {FIELD(CLAST_FIELD_F64, pairs_radius), 0, 0.0, 1e300, "m",
     "greatest distance of pairs (a bare number: m); 0: some 110 neighbours a point, three mean "
     "spacings in 3-D",
     CLAST_BARE_SI},
    {FIELD(CLAST_FIELD_CHOICE, estimator), CLAST_ESTIMATOR_AUTO, 0, 0, "-",
     "what events are counted by; auto: tree cells, and pairs by distance where cells do not "
     "resolve the cloud",
     "cells|pairs|auto"},
    {FIELD(CLAST_FIELD_U64, seed), 1, 0, 1.8446744073709552e19, "-",
     "seed of every draw (ghost points, samples, collisions)", .common = true,
     .group = "random numbers"},
    {0}};
#undef FIELD

const char *clast_decompose_stop_text(clast_decompose_stop stop)
{
    switch (stop) {
    case CLAST_STOP_UNTESTED:
        return "not tested: fewer than 5 points";
    case CLAST_STOP_ACCEPTED:
        return "accepted by the tests";
    case CLAST_STOP_TESTED:
        return "rejected by the tests; the variant does not split";
    case CLAST_STOP_UNIFORM:
        return "split; the tests then accept";
    case CLAST_STOP_NOTHING:
        return "no bin is left to select";
    case CLAST_STOP_ONE_PASS:
        return "split in the one pass of the variant";
    case CLAST_STOP_MAX_PASS:
        return "at the limit: the tests still reject after max_pass passes";
    case CLAST_STOP_SPLIT:
        return "rejected by the tests and split";
    case CLAST_STOP_TREE:
        return "accepted by the tests, split by the tree";
    case CLAST_STOP_WHOLE:
        return "rejected by the tests, not by the tree at tree_root_level: not split";
    case CLAST_STOP_DEPTH:
        return "at the limit: cells of 20 halvings are still non-uniform";
    case CLAST_STOP_SPARED:
        return "not tested: the workspace's policy spares the tests; the tree alone decides";
    }
    return "";
}

static void free_cells(clast_cells *cells)
{
    CLX_FREE(cells->low, cells->high, cells->volume, cells->count, cells->label, cells->pass,
             cells->weight, cells->events, cells->of_point, cells->of_bin, cells->bin_count,
             cells->key, cells->group);
    *cells = (clast_cells){0};
}

void clast_decomposition_free(clast_decomposition *result)
{
    if (result == NULL) {
        return;
    }
    free_cells(&result->cells);
    clast_table_free(&result->search);
    clast_pairs_free(&result->pairs);
    *result = (clast_decomposition){0};
}

static clast_status alloc_cells(clast_cells *cells, int32_t n)
{
    CLAST_ASSERT(n > 0);
    clast_status status = CLAST_OK;
    cells->n = n;
    cells->is_box = true;
    CLX_TRY(clx_alloc(&cells->low, n, sizeof *cells->low));
    CLX_TRY(clx_alloc(&cells->high, n, sizeof *cells->high));
    CLX_TRY(clx_alloc(&cells->volume, n, sizeof *cells->volume));
    CLX_TRY(clx_alloc(&cells->count, n, sizeof *cells->count));
    CLX_TRY(clx_alloc(&cells->label, n, sizeof *cells->label));
    CLX_TRY(clx_alloc(&cells->pass, n, sizeof *cells->pass));
    CLX_TRY(clx_alloc(&cells->weight, n, sizeof *cells->weight));
    CLX_TRY(clx_alloc(&cells->events, n, sizeof *cells->events));
done:
    return status;
}

/// The cell of every real point of the cloud, given that of each point of the sample; counts of all
/// ranks.
static void tell_points(const clx_sample *m, const int32_t *of_sample, clast_cells *cells)
{
    for (int64_t i = 0; i < m->n; ++i) {
        const int64_t number = clx_sample_number(m, i);
        if (number >= 0) {
            const int32_t c = of_sample != NULL ? of_sample[i] : 0;
            cells->of_point[number] = c;
            ++cells->count[c];
        }
    }
    clx_comm_sum(m->comm, cells->count, cells->n);
}

static clast_status one_cell(const clx_sample *m, clast_cells *cells)
{
    const clast_status status = clast_comm_agree(m->comm, alloc_cells(cells, 1), NULL);
    if (status == CLAST_OK) {
        for (int k = 0; k < 3; ++k) {
            cells->high[0][k] = 1.0;
        }
        cells->volume[0] = 1.0;
        tell_points(m, NULL, cells);
    }
    return status;
}

/// The cloud's variable in the order of the sample.
static clast_status take_variable(const clast_cloud *cloud, const clx_sample *m, double **variable)
{
    clast_status status = CLAST_OK;
    if (cloud->variable == NULL) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(variable, m->n, sizeof **variable));
    for (int64_t i = 0; i < m->n; ++i) {
        const int64_t number = clx_sample_number(m, i);
        (*variable)[i] = number >= 0 ? cloud->variable[number] : (double)NAN;
    }
done:
    return status;
}

/// Whether the tests of step 1 reject at the level of the tree's root too.
static bool is_uneven(const clast_uniformity *tests, const clast_decompose_config *config)
{
    int32_t n_reject = 0;
    for (int32_t k = 0; k < tests->n_test; ++k) {
        n_reject += tests->vote[k].p < config->tree_root_level ? 1 : 0;
    }
    return tests->n_test > 0 && n_reject >= clx_uniformity_votes(config->votes, tests->n_test);
}

static clast_decompose_stop tree_stop(const clast_uniformity *tests,
                                      const clx_uniformity_tree_cells *tree)
{
    if (tree->n_deepest > 0) {
        return CLAST_STOP_DEPTH;
    }
    if (tree->n > 1) {
        return tests->reject ? CLAST_STOP_SPLIT : CLAST_STOP_TREE;
    }
    return tests->reject ? CLAST_STOP_WHOLE : CLAST_STOP_ACCEPTED;
}

static clast_status tree_cells(const clast_cloud *cloud, const clx_sample *m,
                               const clast_decompose_config *config, clast_decomposition *result)
{
    clast_status status = CLAST_OK;
    clx_uniformity_tree_cells tree = {0};
    int32_t *of_sample = NULL;
    double *variable = NULL;
    clast_cells *cells = &result->cells;
    const int32_t d = m->domain->dimension;
    const clx_uniformity_tree_config limits = {config->tree_level, config->tree_root_level,
                                               config->tree_least, config->variable_tolerance,
                                               config->tree_refine};
    CLX_TRY(clast_comm_agree(m->comm, take_variable(cloud, m, &variable), NULL));
    const clx_part part = clx_sample_part(m, m->n);
    const clx_uniformity_tree_points points = {&part, m->n_test, variable,
                                               is_uneven(&result->before, config)};
    int32_t *of_point = cells->of_point; // of the sample too, where it is the cloud
    if (m->number != NULL) {
        status = clx_alloc(&of_sample, m->n, sizeof *of_sample);
        of_point = of_sample;
    }
    CLX_TRY(clast_comm_agree(m->comm, status, NULL));
    CLX_TRY(clx_uniformity_tree_split(&points, &limits, &tree, of_point));
    CLX_TRY(clast_comm_agree(m->comm, alloc_cells(cells, tree.n), NULL));
    for (int32_t c = 0; c < tree.n; ++c) {
        cells->volume[c] = 1.0;
        for (int32_t j = 0; j < d; ++j) {
            cells->low[c][j] = tree.low[c][j];
            cells->high[c][j] = tree.high[c][j];
            cells->volume[c] *= tree.high[c][j] - tree.low[c][j];
        }
    }
    tell_points(m, of_point, cells);
    result->stop = tree_stop(&result->before, &tree);
    cells->key = tree.key;
    cells->group = tree.group;
    tree.key = NULL;
    tree.group = NULL;
done:
    clx_uniformity_tree_free(&tree);
    CLX_FREE(of_sample, variable);
    return status;
}

static void gather_bins(const clx_passes *passes, const int32_t *cell, clast_cells *cells)
{
    const clx_bins *bins = &passes->bins;
    for (int32_t c = 0; c < cells->n; ++c) {
        for (int k = 0; k < 3; ++k) {
            cells->low[c][k] = 1.0;
        }
    }
    for (int64_t b = 0; b < bins->n_bin; ++b) {
        const int32_t c = cell[b];
        double low[3] = {0};
        double high[3] = {0};
        clx_bins_box(bins, b, low, high);
        cells->volume[c] += 1.0;
        cells->label[c] = (uint8_t)(passes->tag[b] % 8);
        cells->pass[c] = (uint8_t)(passes->tag[b] / 8);
        for (int k = 0; k < 3; ++k) {
            cells->low[c][k] = fmin(cells->low[c][k], low[k]);
            cells->high[c][k] = fmax(cells->high[c][k], high[k]);
        }
    }
    for (int32_t c = 0; c < cells->n; ++c) {
        cells->volume[c] /= (double)bins->n_bin;
    }
}

static clast_status bin_cells(const clx_sample *m, const clast_decompose_config *config,
                              clast_decomposition *result)
{
    clast_status status = CLAST_OK;
    clx_passes passes = {0};
    int32_t *cell = NULL;
    int32_t *of_sample = NULL;
    int32_t n_cell = 0;
    double held[3];
    const clx_part part = clx_sample_part(m, m->n_test);
    CLX_TRY(clx_passes_run(&part, m->domain, config, result, &passes));
    CLX_TRY(clast_comm_agree(m->comm, clx_alloc(&cell, passes.bins.n_bin, sizeof *cell), NULL));
    const int32_t kind = config->mesh == CLAST_CELLS_AUTO ? CLAST_CELLS_BOXES : config->mesh;
    status = clx_cells_make(&passes.bins, (clx_cells_kind)kind, passes.tag, cell, &n_cell);
    CLX_TRY(clast_comm_agree(m->comm, status, NULL));
    status = alloc_cells(&result->cells, n_cell);
    if (status == CLAST_OK) {
        status = clx_alloc(&of_sample, m->n, sizeof *of_sample);
    }
    CLX_TRY(clast_comm_agree(m->comm, status, NULL));
    CLAST_ASSERT(of_sample != NULL);
    gather_bins(&passes, cell, &result->cells);
    for (int64_t i = 0; i < m->n; ++i) {
        of_sample[i] = cell[clx_bins_of(&passes.bins, clx_sample_point(m, i, held))];
    }
    tell_points(m, of_sample, &result->cells);
    memcpy(result->cells.nb, passes.bins.nb, sizeof result->cells.nb);
    result->cells.is_box = kind == CLAST_CELLS_BOXES || kind == CLAST_CELLS_BINS;
    result->cells.of_bin = cell;
    cell = NULL;
    result->cells.bin_count = passes.bins.count;
    passes.bins.count = NULL;
done:
    clx_passes_free(&passes);
    CLX_FREE(cell, of_sample);
    return status;
}

bool clast_cells_are_labelled(const clast_cells *cells)
{
    return cells != NULL && cells->of_bin != NULL;
}

int32_t clast_cells_locate(const clast_cells *cells, const clast_domain *domain, const double *x)
{
    if (cells == NULL || x == NULL || clx_domain_check(domain) != CLAST_OK || cells->n < 1 ||
        cells->low == NULL || cells->high == NULL) {
        return -1;
    }
    double u[3] = {0};
    if (!clast_domain_map(domain, x, u)) {
        return -1;
    }
    if (cells->of_bin != NULL) {
        const clx_bins bins = {.d = domain->dimension,
                               .nb = {cells->nb[0], cells->nb[1], cells->nb[2]}};
        return cells->of_bin[clx_bins_of(&bins, u)];
    }
    const int32_t c = cells->key != NULL
                          ? clx_uniformity_tree_locate(cells->key, cells->n, u, domain->dimension)
                          : 0;
    if (domain->kind != CLAST_DOMAIN_MESH) {
        return c;
    }
    bool inside = true; // not so in a void, whose cell was left out
    for (int32_t j = 0; j < domain->dimension; ++j) {
        inside = inside && x[j] >= cells->low[c][j] && x[j] <= cells->high[c][j];
    }
    return inside ? c : -1;
}

/// From the unit cube to the domain: volumes, and corners of a box domain.
static void to_domain(const clast_domain *domain, clast_cells *cells)
{
    const double volume = domain->kind == CLAST_DOMAIN_MESH ? 1.0 : clast_domain_volume(domain);
    for (int32_t c = 0; c < cells->n; ++c) {
        cells->volume[c] *= volume;
        for (int32_t j = 0; j < domain->dimension && clx_domain_is_boxed(domain); ++j) {
            const double side = domain->high[j] - domain->low[j];
            cells->low[c][j] = domain->low[j] + side * cells->low[c][j];
            cells->high[c][j] = domain->low[j] + side * cells->high[c][j];
        }
    }
}

/// Weights [n] of all ranks' points in each of the cells, added without rounding.
static clast_status weigh_cells(const clast_comm *comm, const clast_domain *domain,
                                const clast_cloud *cloud, const clast_cells *cells, double *weight)
{
    clast_status status = CLAST_OK;
    clx_fixed_sum *sum = NULL;
    double most = cloud->weight != NULL ? 0.0 : 1.0;
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&sum, cells->n, sizeof *sum), NULL));
    for (int64_t i = 0; i < cloud->n && cloud->weight != NULL; ++i) {
        most = fmax(most, cloud->weight[i]);
    }
    most = -clx_comm_least(comm, -most);
    const clx_fixed_scale scale = clx_fixed_scale_of(most, clx_comm_total(comm, cloud->n));
    for (int64_t i = 0; i < cloud->n; ++i) {
        const int32_t c = clast_cells_locate(cells, domain, cloud->x + i * cloud->dimension);
        if (c >= 0) {
            clx_fixed_sum term;
            clx_fixed_powers(&scale, cloud->weight != NULL ? cloud->weight[i] : 1.0, 1, &term);
            clx_fixed_add(&sum[c], &term);
        }
    }
    clx_comm_sum(comm, sum->word, (int64_t)2 * cells->n);
    for (int32_t c = 0; c < cells->n; ++c) {
        weight[c] = clx_fixed_value(&scale, &sum[c], 1);
    }
done:
    clx_free(sum);
    return status;
}

/// Events with the cells of one half and the weights of both: 2 W_A W_B beta dt / V, whose mean is
/// that of W^2 / 2 without the bias of cells that were chosen by these points.
static clast_status cross_events(const clast_comm *comm, const clast_cloud half[2],
                                 const clast_decompose_config *config, const clast_domain *domain,
                                 double *events)
{
    clast_status status = CLAST_OK;
    clast_decomposition a = {0};
    double *weight = NULL;
    double sum = 0.0;
    CLX_TRY(clast_decompose_ranks(comm, domain, &half[0], config, &a));
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&weight, a.cells.n, sizeof *weight), NULL));
    CLX_TRY(weigh_cells(comm, domain, &half[1], &a.cells, weight));
    for (int32_t c = 0; c < a.cells.n; ++c) {
        const double both = a.cells.weight[c] + weight[c];
        const double pairs = 2.0 * a.cells.weight[c] * weight[c] / a.cells.volume[c];
        sum += config->beta_dt > 0.0 ? fmin(config->beta_dt * pairs, 0.5 * both) : pairs;
    }
    *events = sum / (1.0 + a.smoothing_bias);
done:
    clast_decomposition_free(&a);
    clx_free(weight);
    return status;
}

/// Points from number `begin` on, borrowed.
static clast_cloud points_from(const clast_cloud *cloud, int64_t begin)
{
    clast_cloud part = {.n = cloud->n - begin, .dimension = cloud->dimension};
    part.x = cloud->x + begin * cloud->dimension;
    part.weight = cloud->weight != NULL ? cloud->weight + begin : NULL;
    part.variable = cloud->variable != NULL ? cloud->variable + begin : NULL;
    return part;
}

/// Mean over the swap of two random halves.
static clast_status crossfit(const clast_comm *comm, const clast_cloud *cloud,
                             const clast_decompose_config *config, const clast_domain *domain,
                             double *events)
{
    clast_status status = CLAST_OK;
    clx_shuffled all = {0};
    double found[2] = {0};
    clast_decompose_config plain = *config;
    plain.crossfit = false;
    plain.pairs = false;
    plain.estimator = CLAST_ESTIMATOR_CELLS;
    CLX_TRY(clx_shuffle(comm, cloud, config->seed, &all));
    const int64_t n = clx_shuffled_first(&all, (all.n_all + 1) / 2);
    clast_cloud first = points_from(&all.cloud, 0);
    const clast_cloud second = points_from(&all.cloud, n);
    first.n = n;
    CLX_TRY(cross_events(comm, (const clast_cloud[2]){first, second}, &plain, domain, &found[0]));
    CLX_TRY(cross_events(comm, (const clast_cloud[2]){second, first}, &plain, domain, &found[1]));
    *events = 0.5 * (found[0] + found[1]);
done:
    clx_shuffled_free(&all);
    return status;
}

/// Boxes of bins are joined for their counts and keep the noise, and blobs narrower than a bin; the
/// tree does not.
bool clast_decompose_takes_tree(const clast_decompose_config *config)
{
    return config != NULL && (config->mesh == CLAST_CELLS_TREE ||
                              (config->mesh == CLAST_CELLS_AUTO && !config->paper &&
                               config->variant == CLAST_VARIANT_FULL));
}

static clast_status make_cells(const clast_cloud *cloud, const clx_sample *m,
                               const clast_decompose_config *config, clast_decomposition *result)
{
    const bool accepted = config->variant != CLAST_VARIANT_FAST && !result->before.reject;
    const bool is_tree = clast_decompose_takes_tree(config);
    if (result->n_test < 5 || config->variant == CLAST_VARIANT_TEST || (accepted && !is_tree)) {
        result->stop = result->n_test < 5      ? CLAST_STOP_UNTESTED
                       : result->before.reject ? CLAST_STOP_TESTED
                                               : CLAST_STOP_ACCEPTED;
        return one_cell(m, &result->cells);
    }
    result->has_drawn = result->has_drawn || (!is_tree && config->ghost_samples > 0);
    return is_tree ? tree_cells(cloud, m, config, result) : bin_cells(m, config, result);
}

/// The domain's name may be missing where the domain itself is given.
static clast_status check_config(const clast_decompose_config *config)
{
    static_assert(offsetof(clast_decompose_config, beta_dt_dimension) ==
                      offsetof(clast_decompose_config, beta_dt) + sizeof(double),
                  "CLAST_KEEPS_DIMENSION");
    clast_decompose_config named = *config;
    static char nameless[] = "";
    named.domain = config->domain != NULL ? config->domain : nameless;
    return clast_fields_check(clast_decompose_fields, &named);
}

clast_status clx_decompose_check(const clast_domain *domain, const clast_cloud *cloud,
                                 const clast_decompose_config *config)
{
    clast_status status = CLAST_OK;
    CLX_TRY(check_config(config));
    CLX_TRY(clx_domain_check(domain));
    CLX_CHECK(config->beta_dt_dimension == 0 || config->beta_dt_dimension == domain->dimension,
              CLAST_E_CONFIG, "beta_dt: is in m^%d, in %d dimensions it is in m^%d",
              config->beta_dt_dimension, domain->dimension, domain->dimension);
    CLX_TRY(clx_cloud_check(cloud));
    CLX_CHECK(cloud->variable == NULL || clast_decompose_takes_tree(config), CLAST_E_CONFIG,
              "cells uniform in a variable are cells of the tree: --mesh tree");
done:
    return status;
}

clast_status clx_decompose_test(const clx_sample *sample, const clast_decompose_config *config,
                                clast_uniformity *found)
{
    clast_status status = CLAST_OK;
    clast_uniformity_config vote;
    double side[3];
    const clx_part part = clx_sample_part(sample, sample->n_test);
    clx_domain_sides(sample->domain, side);
    CLX_TRY(clx_passes_vote(config, &vote));
    CLX_TRY(clx_uniformity_reachable(&vote, part.d));
    CLX_TRY(clx_uniformity_test(&part, side, &vote, found));
done:
    return status;
}

clast_status clx_decompose_cells(const clast_cloud *cloud, const clx_sample *sample,
                                 const clast_decompose_config *config, clast_decomposition *result)
{
    clast_status status = CLAST_OK;
    int32_t **of_point = &result->cells.of_point;
    result->dimension = cloud->dimension;
    result->n = sample->n_real_all;
    result->n_test = clx_comm_total(sample->comm, sample->n_test);
    result->n_outside = sample->n_outside_all;
    result->n_here = cloud->n;
    CLX_TRY(clast_comm_agree(sample->comm, clx_alloc(of_point, cloud->n, sizeof **of_point), NULL));
    memset(*of_point, 0xff, (size_t)cloud->n * sizeof **of_point);
    CLX_TRY(make_cells(cloud, sample, config, result));
    if (sample->domain->kind == CLAST_DOMAIN_MESH) {
        CLX_TRY(clx_cells_cut(sample, &result->cells));
    }
done:
    return status;
}

/// Whether so many points repeat the place of another that their density has no lower bound.
static bool is_repeated(const clx_shown *cached, const clx_pair_levels *levels)
{
    return cached != NULL && cached->is_known
               ? cached->cells.is_repeated
               : levels->n > 0 && clx_resolution_of(levels).is_repeated;
}

clast_status clx_decompose_events(const clast_cloud *cloud, const clx_sample *sample,
                                  const clast_decompose_config *config, clx_shown *cached,
                                  clast_decomposition *result)
{
    clast_status status = CLAST_OK;
    clx_pair_levels levels;
    result->beta_dt = config->beta_dt;
    result->volume = clast_domain_volume(sample->domain);
    result->seed = config->seed;
    result->has_drawn =
        result->has_drawn || cloud->weight != NULL || sample->domain->kind == CLAST_DOMAIN_MESH;
    CLX_TRY(clx_events_count(cloud, config, sample, cached, &levels, result));
    if (is_repeated(cached, &levels)) { // cells at their cap have no bound either
        result->events_low = (double)NAN;
    }
    to_domain(sample->domain, &result->cells); // pairs within the cells are of its volumes
    CLX_TRY(clx_pair_events(sample->comm, sample->domain, cloud, config, &levels, result));
    result->events_cross = (double)NAN;
    if (config->crossfit) {
        CLX_TRY(crossfit(sample->comm, cloud, config, sample->domain, &result->events_cross));
    }
done:
    return status;
}

/// Whether the points of all ranks have what `column` holds, weights or a variable; `none` stands
/// for that of a rank without points.
static clast_status agree_on(const clast_comm *comm, const char *what, int64_t n, double *none,
                             double **column)
{
    clast_status status = CLAST_OK;
    const int64_t n_all = clx_comm_total(comm, n);
    const int64_t n_with = clx_comm_total(comm, *column != NULL ? n : 0);
    CLX_CHECK(n_with == 0 || n_with == n_all, CLAST_E_ARGUMENT,
              "%lld of %lld points have %s: some ranks give them, others do not", (long long)n_with,
              (long long)n_all, what);
    if (comm->n_rank > 1) {
        *column = n_with == 0 ? NULL : *column != NULL ? *column : none;
    }
done:
    return status;
}

static clast_status check_call(const clast_comm *comm, const clast_domain *domain,
                               const clast_cloud *cloud, const clast_decompose_config *config)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(clx_comm_has_sums(comm), CLAST_E_ARGUMENT, "comm has no sum or no exchange");
    CLX_TRY(clx_decompose_check(domain, cloud, config));
done:
    return status;
}

clast_status clast_decompose_ranks(const clast_comm *comm, const clast_domain *domain,
                                   const clast_cloud *cloud, const clast_decompose_config *config,
                                   clast_decomposition *result)
{
    CLX_ARGUMENTS(domain, cloud, config, result);
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    const clast_comm *all = clx_comm_or_one(comm);
    clast_decomposition made = {0};
    clx_sample m = {0};
    clast_cloud own;
    double none = 1.0;
    CLX_TRY(clast_comm_agree(all, check_call(all, domain, cloud, config), NULL));
    own = *cloud;
    CLX_TRY(agree_on(all, "weights", own.n, &none, &own.weight));
    CLX_TRY(agree_on(all, "a variable", own.n, &none, &own.variable));
    CLX_TRY(clx_sample_make(all, &own, config, domain, &m));
    CLX_TRY(clx_decompose_test(&m, config, &made.before));
    CLX_TRY(clx_decompose_cells(&own, &m, config, &made));
    CLX_TRY(clx_decompose_events(&own, &m, config, NULL, &made));
    *result = made;
    made = (clast_decomposition){0};
done:
    clast_decomposition_free(&made);
    clx_sample_free(&m);
    return status;
}

clast_status clast_decompose_in(const clast_domain *domain, const clast_cloud *cloud,
                                const clast_decompose_config *config, clast_decomposition *result)
{
    CLX_ARGUMENTS(domain, cloud, config, result);
    CLX_FLOAT_ENVIRONMENT;
    return clast_decompose_ranks(NULL, domain, cloud, config, result);
}

clast_status clast_decompose(const clast_cloud *cloud, const clast_decompose_config *config,
                             clast_decomposition *result)
{
    CLX_ARGUMENTS(cloud, config, result);
    clast_status status = CLAST_OK;
    clast_domain domain = {0};
    CLX_TRY(clast_fields_check(clast_decompose_fields, config));
    CLX_TRY(clast_domain_parse(config->domain, &domain));
    CLX_TRY(clast_decompose_in(&domain, cloud, config, result));
done:
    return status;
}
