// Pairs by distance of clast decompose.
#include "decompose_pairs.h"

#include "command.h"
#include "quantity.h"
#include <clast/chart.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>

static void add_column(json_t *out, const char *key, const clast_pairs *p, const char *column)
{
    json_t *list = json_array();
    const double *number = clast_table_numbers(&p->shells, column);
    for (int64_t k = 0; k < p->shells.n_row; ++k) {
        (void)json_array_append_new(list, isfinite(number[k]) ? json_real(number[k]) : json_null());
    }
    (void)json_object_set_new(out, key, list);
}

/// Events with beta dt, else the pair integral: value, low and high.
static void add_estimate(json_t *out, const clast_decomposition *r, const char *by,
                         const clast_estimate *e)
{
    static const char *const end[3] = {"", "_low", "_high"};
    const double value[3] = {e->value, e->low, e->high};
    for (int k = 0; k < 3; ++k) {
        char key[64];
        (void)snprintf(key, sizeof key, "%s%s%s", r->beta_dt > 0.0 ? "events" : "pair_integral", by,
                       end[k]);
        cli_json_number(out, key, value[k]);
    }
}

static void add_within(json_t *out, const clast_within_cells *w)
{
    const bool seen = w->radius > 0.0;
    cli_json_bool(out, "structure_below_cells", w->is_structured);
    cli_json_number(out, "cell_size", w->even > 0.0 ? w->cell : (double)NAN);
    cli_json_number(out, "pair_integral_even_cells", w->even);
    cli_json_number(out, "r_within", seen ? w->radius : (double)NAN);
    cli_json_count(out, "n_within", w->n_pair);
    cli_json_number(out, "g_within", seen ? w->g : (double)NAN);
    cli_json_number(out, "g_within_low", seen ? w->g_low : (double)NAN);
    cli_json_number(out, "g_within_high", seen ? w->g_high : (double)NAN);
    cli_json_number(out, "structure_length", w->length > 0.0 ? w->length : (double)NAN);
}

json_t *cli_decompose_pairs_json(const clast_decomposition *r)
{
    const clast_pairs *p = &r->pairs;
    const clast_pair_integral *i = &p->integral;
    json_t *out = json_object();
    add_column(out, "r_low", p, "r_low_m");
    add_column(out, "r", p, "r_high_m");
    add_column(out, "count", p, "pairs");
    add_column(out, "g", p, "g");
    add_column(out, "g_low", p, "g_low");
    add_column(out, "g_high", p, "g_high");
    cli_json_number(out, "radius", p->radius);
    cli_json_count(out, "n_pair", p->n_pair);
    cli_json_count(out, "n_repeated", p->n_repeated);
    cli_json_number(out, "edge_error", p->edge_error);
    cli_json_number(out, "integral", i->estimate.value);
    cli_json_number(out, "integral_low", i->estimate.low);
    cli_json_number(out, "integral_high", i->estimate.high);
    cli_json_bool(out, "resolved", i->estimate.resolved);
    cli_json_number(out, "points_needed", i->n_needed);
    cli_json_number(out, "scale", i->scale);
    cli_json_number(out, "window", i->window);
    cli_json_count(out, "n_window", i->n_pair);
    cli_json_number(out, "fit_p", i->fit_p);
    add_within(out, &r->within);
    add_estimate(out, r, "", &r->events_by_pairs);
    add_estimate(out, r, "_by_cells", &r->events_by_cells);
    cli_json_bool(out, "disagree", r->disagree);
    return out;
}

void cli_points_needed_print(double n)
{
    const double unit = pow(10.0, floor(log10(n)) - 1.0); // two digits of it are reported
    if (!isfinite(n)) {
        (void)printf("how many points would do cannot be determined");
    } else if (n < 1e6) {
        (void)printf("about %.0f points would do", unit * round(n / unit));
    } else {
        (void)printf("about %.2g points would do", n);
    }
}

static void print_interval(const clast_estimate *e)
{
    if (e->resolved) {
        (void)printf("%.6g [%.6g, %.6g]", e->value, e->low, e->high);
    } else if (isnan(e->low)) {
        (void)printf("without bound: repeated points");
    } else {
        (void)printf("at least %.6g", e->low);
    }
}

/// Whether the cells hide structure, and what a kernel that brings its own g(r) may multiply.
static void print_within(const clast_decomposition *r)
{
    const clast_within_cells *w = &r->within;
    const int d = r->dimension;
    if (w->radius == 0.0) {
        (void)printf("fewer than 10 pairs lie closer than half a cell: the points do not show "
                     "whether structure lies below the cells\n");
        return;
    }
    (void)printf("%s below the cells (edge %s): %lld pairs within %s are %.3g [%.3g, %.3g] "
                 "times those of uniform cells",
                 w->is_structured ? "structure lies" : "no structure is seen",
                 cli_quantity(w->cell, "m"), (long long)w->n_pair, cli_quantity(w->radius, "m"),
                 w->g, w->g_low, w->g_high);
    if (!w->is_structured) {
        (void)printf("; a kernel with its own g(r) may multiply these events\n");
        return;
    }
    if (w->length > 0.0) {
        (void)printf(", up to a distance of %s", cli_quantity(w->length, "m"));
    }
    (void)printf(
        "\na kernel with its own g(r) (cloud_turbulence) may multiply the uniform cells' pair "
        "integral alone, %.6g 1/m^%d: with events by pairs this structure counts twice; a "
        "kernel without takes those by pairs\n",
        w->even, d);
}

void cli_decompose_pairs_print(const clast_decomposition *r)
{
    const clast_pairs *p = &r->pairs;
    const clast_pair_integral *i = &p->integral;
    char note[CLI_WORDS_SIZE];
    (void)clast_decomposition_note(r, 0, 0, sizeof note, note);
    (void)printf("%lld pairs within %s; ", (long long)p->n_pair, cli_quantity(p->radius, "m"));
    if (p->n_repeated > 0) {
        (void)printf("%lld of them coincident; ", (long long)p->n_repeated);
    }
    (void)printf("integral of the squared density ");
    print_interval(&i->estimate);
    (void)printf(" 1/m^%d", p->dimension);
    if (i->scale <= p->radius) {
        (void)printf(", narrowest structure of sd %s by %lld pairs within %s",
                     cli_quantity(i->scale, "m"), (long long)i->n_pair,
                     cli_quantity(i->window, "m"));
    }
    const char *what = r->beta_dt > 0.0 ? "events" : "pair integral";
    (void)printf("\n%s by pairs ", what);
    print_interval(&r->events_by_pairs);
    (void)printf(", by cells ");
    print_interval(&r->events_by_cells);
    // shared out to cells, of which some are at their cap, they are fewer than without cells
    const bool is_capped = r->n_capped > 0 && !(r->events >= r->events_by_pairs.value);
    (void)printf(
        "; %s by %s%s\n", r->beta_dt > 0.0 ? "events are those" : "the pair integral is that",
        r->estimator == CLAST_ESTIMATOR_PAIRS ? "pairs" : "cells",
        r->estimator == CLAST_ESTIMATOR_PAIRS && is_capped ? ", up to each cell's cap" : "");
    if (!i->estimate.resolved) {
        (void)printf("pairs do not resolve the cloud%s",
                     r->keeps_apart          ? ": the points keep apart"
                     : isfinite(i->n_needed) ? ""
                     : note[0] != '\0'       ? ": g(r) is that of no density"
                                             : ": g rises down to the nearest pairs there are");
        // what cells and pairs can resolve together stands above
        if (!r->keeps_apart && i->n_needed != r->points_needed) {
            (void)printf("; by pairs alone, ");
            cli_points_needed_print(i->n_needed);
        }
        (void)printf("\n");
    }
    print_within(r);
    if (note[0] != '\0') {
        (void)printf("warning: %s\n", note);
    }
}

clast_status cli_decompose_pairs_write(const cli_decompose_job *j, const char *folder)
{
    const clast_decomposition *r = j->result;
    char path[4096];
    char note[CLI_DECOMPOSE_NOTE];
    cli_decompose_note(j, note);
    (void)snprintf(path, sizeof path, "%s/pairs.csv", folder);
    CLI_GUARD(clast_table_write_csv_note(&r->pairs.shells, note, path));
    (void)snprintf(path, sizeof path, "%s/pairs.%s", folder, j->chart_end);
    return clast_chart_pairs(&r->pairs, path);
}
