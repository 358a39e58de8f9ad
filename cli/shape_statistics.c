// Statistics of a set of grains on the command line.
#include "shape_statistics.h"

#include "json.h"

#include <clast/table.h>
#include <math.h>
#include <stdio.h>

clast_status cli_shape_statistics(const char *command, const clast_table *grains,
                                  const clast_bootstrap *bootstrap,
                                  clast_grain_statistics *statistics)
{
    char complaint[512];
    // The ratios are there for every grain; lengths are not, for tables of ratios.
    clast_status status =
        clast_grain_statistics_of(grains, "flatness,elongation", bootstrap, statistics);
    if (status != CLAST_OK) {
        return status;
    }
    clast_form_set_complaint(&statistics->set, sizeof complaint, complaint);
    if (complaint[0] != '\0') {
        (void)fprintf(stderr, "clast %s: statistics: %s\n", command, complaint);
    }
    return CLAST_OK;
}

static json_t *interval(double value, double low, double high)
{
    json_t *object = json_object();
    cli_json_number(object, "value", value);
    cli_json_number(object, "low", low);
    cli_json_number(object, "high", high);
    return object;
}

static json_t *column_json(const char *name, const clast_sample_summary *s)
{
    json_t *column = json_object();
    json_t *quantiles = json_object();
    cli_json_text(column, "name", name);
    cli_json_count(column, "n", s->n);
    (void)json_object_set_new(column, "mean", interval(s->mean, s->mean_low, s->mean_high));
    (void)json_object_set_new(column, "deviation",
                              interval(s->deviation, s->deviation_low, s->deviation_high));
    cli_json_number(column, "deviation_ml", s->deviation_ml);
    cli_json_number(column, "skewness", s->skewness);
    cli_json_number(column, "kurtosis", s->kurtosis);
    cli_json_number(column, "low", s->low);
    cli_json_number(column, "high", s->high);
    for (int32_t k = 0; k < CLAST_N_QUANTILE; ++k) {
        char key[8];
        (void)snprintf(key, sizeof key, "q%02.0f", 100.0 * clast_quantile_share(k));
        cli_json_number(quantiles, key, s->quantile[k]);
    }
    (void)json_object_set_new(column, "quantiles", quantiles);
    cli_json_number(column, "shapiro_w", s->shapiro_w);
    cli_json_number(column, "shapiro_p", s->shapiro_p);
    cli_json_bool(column, "is_constant", s->is_constant);
    return column;
}

static json_t *correlation_json(const clast_statistics *s)
{
    json_t *object = json_object();
    json_t *rows = json_array();
    json_t *names = json_array();
    for (int32_t i = 0; i < s->n; ++i) {
        json_t *row = json_array();
        (void)json_array_append_new(names, json_string(s->name[i]));
        for (int32_t j = 0; j < s->n; ++j) {
            const double r = s->r[i * s->n + j];
            (void)json_array_append_new(row, isfinite(r) ? json_real(r) : json_null());
        }
        (void)json_array_append_new(rows, row);
    }
    (void)json_object_set_new(object, "columns", names);
    (void)json_object_set_new(object, "r", rows);
    return object;
}

json_t *cli_statistics_json(const clast_grain_statistics *statistics)
{
    const clast_statistics *s = &statistics->statistics;
    json_t *out = json_object();
    json_t *zingg = json_object();
    json_t *columns = json_array();
    json_t *pca = json_array();
    cli_json_count(out, "n", statistics->set.n);
    cli_json_count(out, "n_left_out", statistics->set.n_left_out);
    for (int k = 0; k < CLAST_N_ZINGG; ++k) {
        cli_json_count(zingg, clast_zingg_name((clast_zingg)k), statistics->zingg[k]);
    }
    for (int32_t k = 0; k < s->n; ++k) {
        (void)json_array_append_new(columns, column_json(s->name[k], &s->summary[k]));
    }
    for (int32_t k = 0; k < s->n_pca; ++k) {
        json_t *component = json_object();
        cli_json_number(component, "variance", s->variance[k]);
        cli_json_number(component, "explained", s->explained[k]);
        (void)json_array_append_new(pca, component);
    }
    (void)json_object_set_new(out, "zingg", zingg);
    (void)json_object_set_new(out, "columns", columns);
    (void)json_object_set_new(out, "correlation", correlation_json(s));
    (void)json_object_set_new(out, "pca", pca);
    return out;
}

/// A number with four digits, or a dash for what the sample is too small for.
static void cell(double value)
{
    if (isfinite(value)) {
        (void)printf(" %9.4g", value);
    } else {
        (void)printf("%10s", "-");
    }
}

void cli_statistics_words(const clast_grain_statistics *statistics)
{
    const clast_statistics *s = &statistics->statistics;
    (void)printf("\n%lld grain%s:", (long long)statistics->set.n,
                 statistics->set.n == 1 ? "" : "s");
    for (int k = 0; k < CLAST_N_ZINGG; ++k) {
        (void)printf("%s %lld %s", k > 0 ? "," : "", (long long)statistics->zingg[k],
                     clast_zingg_name((clast_zingg)k));
    }
    (void)printf(
        "\n\nfrom, to: 95 %% interval of the mean (bootstrap); W, p: Shapiro and Wilk's test "
        "of a normal law");
    if (statistics->set.size != NULL) {
        const bool has_unit = statistics->set.size_unit[0] != '\0';
        (void)printf("; size: %s%s%s%s", statistics->set.size_name, has_unit ? " (" : "",
                     statistics->set.size_unit, has_unit ? ")" : "");
    }
    (void)printf("\n%-30s%10s%10s%10s%10s%10s%10s%10s\n", "factor", "mean", "deviation", "from",
                 "to", "median", "W", "p");
    for (int32_t k = 0; k < s->n; ++k) {
        const clast_sample_summary *c = &s->summary[k];
        (void)printf("%-30s", s->name[k]);
        cell(c->mean);
        cell(c->deviation);
        cell(c->mean_low);
        cell(c->mean_high);
        cell(c->quantile[CLAST_N_QUANTILE / 2]);
        cell(c->shapiro_w);
        cell(c->shapiro_p);
        (void)printf("\n");
    }
    if (s->n_pca > 1) {
        (void)printf(
            "\n%.1f %% of the form factors' variance in one principal component, %.1f %% in "
            "two, %.1f %% in three\n",
            100.0 * s->explained[0], 100.0 * s->explained[1],
            100.0 * s->explained[s->n_pca > 2 ? 2 : 1]);
    }
    if (statistics->set.n > 5000) {
        (void)printf("note: Royston fitted p for n <= 5000; it is extrapolated here\n");
    }
}
