/* Paper: dimensions of clusters by the way their parts come, from the growth of ln Rg with ln N
 * over repeats.
 *
 * Particle on cluster: 2.50 by diffusion [Tolman1989], 3 by ballistic lines [Ball1984]. Cluster on
 * cluster: 1.78 by diffusion, 1.91 to 1.95 by lines [Meakin1983, Jullien1987]. At these sizes the
 * ensembles of docs/theory/aggregation.md give 2.51, 2.93, 1.79 and 1.93. */
#include "aggregates.h"

enum { REPEATS = 12 };

/// Sums of a line through (x, y).
typedef struct line {
    double n, x, y, xx, xy;
} line;

static void add(line *l, double x, double y)
{
    l->n += 1.0;
    l->x += x;
    l->y += y;
    l->xx += x * x;
    l->xy += x * y;
}

/// D of ln Rg = (ln N) / D over grains `low` to all.
static double dimension(const char *options, double low)
{
    support_aggregate s;
    line l = {0};
    support_aggregate_make(&s, NULL, 1,
                           "size_law=uniform;size_low=1;size_high=1;envelope_every=100000;"
                           "envelope=enclosing_sphere");
    support_aggregate_options(&s.config, options);
    for (int32_t repeat = 0; repeat < REPEATS; ++repeat) {
        clast_table history = {0};
        clast_aggregate *a = support_aggregate_run(&s, repeat);
        CHECK_OK(clast_aggregate_history(a, &history));
        const double *n = clast_table_numbers(&history, "n_grain");
        const double *radius = clast_table_numbers(&history, "radius_of_gyration_m");
        double wanted = low;
        for (int64_t i = 0; i < history.n_row; ++i) {
            if (n[i] >= wanted) { /* as many points to each factor in N */
                add(&l, log(n[i]), log(radius[i]));
                wanted = s.config.params.mode == CLAST_AGGREGATE_CORE ? n[i] * 1.1 : low;
            }
        }
        clast_table_free(&history);
        clast_aggregate_destroy(a);
    }
    support_aggregate_free(&s);
    return (l.n * l.xx - l.x * l.x) / (l.n * l.xy - l.x * l.y);
}

static void particles_on_a_cluster(void **state)
{
    (void)state;
    /* four standard errors of an ensemble of 12 */
    CHECK_ABS(dimension("approach=diffusive;n_particle=2000", 200.0), 2.50, 0.16);
    CHECK_ABS(dimension("approach=ballistic;n_particle=2000", 200.0), 2.95, 0.16);
}

static void clusters_on_clusters(void **state)
{
    (void)state;
    CHECK_ABS(dimension("approach=diffusive;mode=cluster;n_particle=256", 10.0), 1.78, 0.1);
    CHECK_ABS(dimension("approach=ballistic;mode=cluster;n_particle=256", 10.0), 1.93, 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(particles_on_a_cluster),
        cmocka_unit_test(clusters_on_clusters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
