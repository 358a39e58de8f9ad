// What clast decompose found: as JSON, in words.
#include "decompose_words.h"

#include "command.h"
#include "decompose_pairs.h"
#include "json.h"
#include "packing.h"
#include "quantity.h"
#include <clast/decompose.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double least_told = 1e-9; ///< relative; beneath, a bias is rounding

/// Axes of the unit cube that a mapped domain is tested in have names of their own.
static const char *axis_name(const clast_domain *domain, int32_t axis)
{
    static const char *const name[2][3] = {{"x", "y", "z"}, {"u", "v", "w"}};
    const bool is_boxed = domain->kind == CLAST_DOMAIN_BOX || domain->kind == CLAST_DOMAIN_MESH;
    return name[is_boxed ? 0 : 1][axis];
}

static json_t *json_tests(const clast_uniformity *u, const clast_domain *domain)
{
    json_t *list = json_array();
    for (int32_t k = 0; k < u->n_test; ++k) {
        json_t *test = json_object();
        cli_json_text(test, "name", u->vote[k].name);
        cli_json_number(test, "statistic", u->vote[k].statistic);
        cli_json_number(test, "p", u->vote[k].p);
        cli_json_bool(test, "reject", u->vote[k].reject);
        (void)json_object_set_new(test, "axes",
                                  u->vote[k].axis[0] < 0
                                      ? json_null()
                                      : json_pack("[s,s]", axis_name(domain, u->vote[k].axis[0]),
                                                  axis_name(domain, u->vote[k].axis[1])));
        (void)json_array_append_new(list, test);
    }
    return list;
}

static json_t *json_passes(const clast_decomposition *r)
{
    json_t *list = json_array();
    for (int32_t k = 0; k < r->n_pass; ++k) {
        json_t *pass = json_object();
        json_t *bins = json_array();
        for (int32_t j = 0; j < r->dimension; ++j) {
            (void)json_array_append_new(bins, json_integer(r->pass[k].nb[j]));
        }
        (void)json_object_set_new(pass, "bins", bins);
        cli_json_number(pass, "lambda", r->pass[k].lambda);
        cli_json_count(pass, "lambda_count", r->pass[k].lambda_count);
        cli_json_count(pass, "n_lambda", r->pass[k].n_lambda);
        cli_json_number(pass, "lower", r->pass[k].lower);
        cli_json_count(pass, "n_lower", r->pass[k].n_lower);
        cli_json_number(pass, "score", r->pass[k].score);
        cli_json_number(pass, "ideal_score", r->pass[k].ideal);
        (void)json_array_append_new(list, pass);
    }
    return list;
}

static json_t *json_labels(const clast_decomposition *r)
{
    static const char *const name[8] = {"ambient",   "cluster_1", "cluster_2", "cluster_3",
                                        "cluster_4", "cluster_5", "under",     "void"};
    int64_t n[8] = {0};
    if (!clast_cells_are_labelled(&r->cells)) {
        return json_null();
    }
    json_t *labels = json_object();
    for (int32_t c = 0; c < r->cells.n; ++c) {
        ++n[r->cells.label[c] % 8];
    }
    for (int k = 0; k < 8; ++k) {
        cli_json_count(labels, name[k], n[k]);
    }
    return labels;
}

/// Events with beta dt, else the pair integral; the other is null.
static void json_events(json_t *out, const clast_decomposition *r)
{
    static const char *const key[2][4] = {
        {"events", "events_low", "events_high", "events_cross"},
        {"pair_integral", "pair_integral_low", "pair_integral_high", "pair_integral_cross"}};
    const bool is_bound = !isnan(r->events_low); // not of repeated points
    const double value[4] = {is_bound ? r->events : (double)NAN, r->events_low,
                             is_bound ? r->events_high : (double)NAN, r->events_cross};
    const int given = r->beta_dt > 0.0 ? 0 : 1;
    for (int k = 0; k < 4; ++k) {
        cli_json_number(out, key[given][k], value[k]);
        cli_json_number(out, key[1 - given][k], (double)NAN);
    }
    char unit[16];
    (void)snprintf(unit, sizeof unit, "1/m^%d", r->dimension);
    cli_json_text(out, "pair_integral_unit", unit);
    cli_json_number(out, "n_capped", (double)NAN);
    if (given == 0 && is_bound) {
        cli_json_count(out, "n_capped", r->n_capped);
    }
}

/// What the numbers depend on.
static void json_settings(json_t *out, const cli_decompose_job *j, const char *text)
{
    const clast_decomposition *r = j->result;
    cli_domain_json(out, text, j->domain);
    cli_json_number(out, "beta_dt", r->beta_dt > 0.0 ? r->beta_dt : (double)NAN);
    (void)json_object_set_new(out, "seed", json_null());
    if (j->has_drawn) {
        cli_json_seed(out, "seed", r->seed);
    }
}

json_t *cli_decompose_json(const cli_decompose_job *j, const cli_decompose_found *f)
{
    const clast_decomposition *r = j->result;
    json_t *out = json_object();
    cli_json_count(out, "n", r->n);
    cli_json_count(out, "n_outside", r->n_outside);
    cli_json_count(out, "n_repeated", f->n_repeated);
    cli_packing_json(out, &f->read);
    cli_json_count(out, "n_test", r->n_test);
    cli_json_count(out, "dimension", r->dimension);
    (void)json_object_set_new(out, "tests", json_tests(&r->before, j->domain));
    (void)json_object_set_new(out, "reject",
                              f->evenness.is_tested ? json_boolean(r->before.reject) : json_null());
    cli_evenness_json(out, &f->evenness);
    cli_json_number(out, "score", r->before.score);
    cli_json_number(out, "ideal_score", r->before.ideal);
    (void)json_object_set_new(out, "passes", json_passes(r));
    cli_json_text(out, "stop", clast_decompose_stop_text(r->stop));
    (void)json_object_set_new(out, "n_cell",
                              j->tests_alone ? json_null() : json_integer(r->cells.n));
    (void)json_object_set_new(out, "labels", json_labels(r));
    json_events(out, r);
    (void)json_object_set_new(out, "resolved",
                              j->tests_alone ? json_null() : json_boolean(r->resolved));
    (void)json_object_set_new(out, "keeps_apart",
                              j->tests_alone ? json_null() : json_boolean(r->keeps_apart));
    cli_json_number(out, "points_needed", r->points_needed);
    cli_json_number(out, "cells_bias", r->cells_bias);
    cli_json_number(out, "points_per_bin",
                    r->points_per_bin > 0.0 ? r->points_per_bin : (double)NAN);
    cli_json_number(out, "bias_estimate", r->bias_estimate);
    cli_json_number(out, "smoothing_bias", isnan(r->events_low) ? (double)NAN : r->smoothing_bias);
    cli_json_text(out, "estimator",
                  j->tests_alone                          ? NULL
                  : r->estimator == CLAST_ESTIMATOR_PAIRS ? "pairs"
                                                          : "cells");
    if (r->pairs.n > 0) {
        (void)json_object_set_new(out, "pairs", cli_decompose_pairs_json(r));
    }
    json_settings(out, j, f->typed);
    return out;
}

/// Whether the number may be trusted; what would do where it may not.
static void print_resolved(const clast_decomposition *r, double pairs_radius)
{
    if (r->resolved) {
        return;
    }
    if (r->keeps_apart) {
        (void)printf(
            "not resolved: the points keep apart (seeded regularly, stratified or repelling), so "
            "pairs in small cells say nothing of their density; the lower bound, of large "
            "cells, alone holds\n");
        return;
    }
    (void)printf("not resolved: the points do not show their own structure, the lower bound alone "
                 "holds (97.5 %%)");
    if (isfinite(r->cells_bias)) {
        (void)printf("; pairs in these cells are off by %+.2g %%, --mesh tree resolves them",
                     100.0 * r->cells_bias);
    } else {
        (void)printf("; ");
        cli_points_needed_print(r->points_needed);
    }
    (void)printf("\n");
    if (pairs_radius > 0.0 && !isfinite(r->cells_bias)) {
        (void)printf("pairs are those within --pairs-radius %s; the distance that is taken without "
                     "it may resolve more\n",
                     cli_quantity(pairs_radius, "m"));
    }
}

static void print_tests(const clast_uniformity *u, const clast_domain *domain,
                        const cli_decompose_found *f)
{
    if (u->n_test == 0) {
        (void)printf("\n\nnot tested: fewer than 5 points, nothing is rejected\n");
        return;
    }
    (void)printf("\n\n%-16s %12s %12s\n", "test", "statistic", "p");
    for (int32_t k = 0; k < u->n_test; ++k) {
        const clast_vote *v = &u->vote[k];
        char name[32];
        (void)snprintf(name, sizeof name, "%s", v->name);
        if (v->axis[0] >= 0) {
            (void)snprintf(name, sizeof name, "%s %s,%s", v->name, axis_name(domain, v->axis[0]),
                           axis_name(domain, v->axis[1]));
        }
        (void)printf("%-16s %12.6g %12s%s\n", name, v->statistic, cli_p_value(v->p),
                     v->reject ? "  rejects" : "");
    }
    cli_evenness_print(&f->evenness);
    (void)printf("score %.6g, expected for uniform points %.6g: %s\n", u->score, u->ideal,
                 cli_evenness_text(&f->evenness));
}

static void print_passes(const clast_decomposition *r)
{
    for (int32_t k = 0; k < r->n_pass; ++k) {
        const clast_pass *p = &r->pass[k];
        (void)printf("pass %d: %d", k + 1, p->nb[0]);
        for (int32_t j = 1; j < r->dimension; ++j) {
            (void)printf(" x %d", p->nb[j]);
        }
        (void)printf(" bins, threshold %.4g of the mean density (%d point%s a bin; best of %d), "
                     "score %.4g, ideal %.4g\n",
                     p->lambda, p->lambda_count, cli_plural(p->lambda_count), p->n_lambda, p->score,
                     p->ideal);
    }
}

static void print_events(const cli_decompose_job *j, int64_t n_repeated)
{
    const clast_decomposition *const r = j->result;
    if (isnan(r->events_low)) {
        char note[CLI_WORDS_SIZE];
        (void)printf("%d cell%s, %s\n", r->cells.n, cli_plural(r->cells.n),
                     clast_decomposition_note(r, n_repeated, 1, sizeof note, note));
        return;
    }
    char high[32] = "-";
    if (r->resolved) {
        (void)snprintf(high, sizeof high, "%.6g", r->events_high);
    }
    (void)printf("%d cell%s, ", r->cells.n, cli_plural(r->cells.n));
    if (r->beta_dt > 0.0) {
        (void)printf("events %.6g [%.6g, %s] with beta dt %.6g m^%d, %d cell%s at the cap\n",
                     r->events, r->events_low, high, r->beta_dt, r->dimension, r->n_capped,
                     cli_plural(r->n_capped));
    } else {
        (void)printf("pair integral %.6g [%.6g, %s] 1/m^%d, events per beta dt (none is given: "
                     "--beta-dt)\n",
                     r->events, r->events_low, high, r->dimension);
    }
    print_resolved(r, j->pairs_radius);
    if (r->estimator == CLAST_ESTIMATOR_PAIRS && r->pairs.n == 0) {
        (void)printf("counted by pairs of all distances (--pairs shows them): cells of no size "
                     "resolve the cloud\n");
    }
    if (fabs(r->smoothing_bias) >= least_told && r->resolved &&
        r->estimator == CLAST_ESTIMATOR_CELLS) {
        (void)printf("pairs in cells taken as uniform are estimated to be off by %+.2g %%; this is "
                     "taken off\n",
                     100.0 * r->smoothing_bias);
    }
    if (r->pairs.n > 0) {
        cli_decompose_pairs_print(r);
    }
    if (isfinite(r->events_cross) && r->beta_dt > 0.0) {
        (void)printf("events by cross-fitting %.6g\n", r->events_cross);
    } else if (isfinite(r->events_cross)) {
        (void)printf("pair integral by cross-fitting %.6g 1/m^%d\n", r->events_cross, r->dimension);
    }
}

void cli_decompose_print(const cli_decompose_job *j, const cli_decompose_found *f)
{
    const clast_decomposition *r = j->result;
    (void)printf("%lld point%s in %d dimension%s", (long long)r->n, cli_plural(r->n), r->dimension,
                 cli_plural(r->dimension));
    if (r->n_outside > 0) {
        (void)printf(", %lld outside the domain left out", (long long)r->n_outside);
    }
    if (r->n_test != r->n) {
        (void)printf(", %lld tested", (long long)r->n_test);
    }
    if (f->n_repeated > 0) {
        (void)printf(", %lld duplicates (coincident points; each such pair counts as two "
                     "particles that meet)",
                     (long long)f->n_repeated);
    }
    print_tests(&r->before, j->domain, f);
    if (j->tests_alone) {
        return;
    }
    print_passes(r);
    (void)printf("stop: %s\n", clast_decompose_stop_text(r->stop));
    print_events(j, f->n_repeated);
    char note[CLI_WORDS_SIZE];
    if (clast_decomposition_note(r, f->n_repeated, 2, sizeof note, note)[0] != '\0') {
        (void)printf("warning: %s\n", note);
    }
}
