/* Property: an aggregate goes on with the parameters that it was grown by, and with no others.
 * Before, shapes alone were compared: another repeat, seed, law or list of sizes was taken, and
 * what followed was of neither. */
#include "aggregates.h"
#include "support.h"

#include <stdlib.h>
#include <string.h>

static const double axes[2][3] = {{1.4, 0.9, 0.7}, {2.0, 1.0, 0.5}};

/// Options of an aggregate; those that begin with "@0.5;" have a list of nine particles, all of
/// that size.
static void make(const char *options, support_aggregate *s)
{
    static double size[1];
    static double count[1] = {9.0};
    static clast_sizes sizes = {1, size, size, count, NULL};
    char *end = NULL;
    size[0] = options[0] == '@' ? strtod(options + 1, &end) : 0.0;
    support_aggregate_make(s, axes, 2, end != NULL ? end + 1 : options);
    s->input.sizes = end != NULL ? &sizes : NULL;
}

/// A run of `grown` steps, with all that a checkpoint keeps of it.
typedef struct {
    support_aggregate run;
    clast_aggregate *aggregate;
    clast_table history, members;
    clast_aggregate_saved saved;
} kept;

static void grow(const char *options, int32_t grown, kept *k)
{
    *k = (kept){0};
    make(options, &k->run);
    CHECK_OK(clast_aggregate_create(&k->run.config.params, &k->run.input, 1, &k->aggregate));
    CHECK_OK(clast_aggregate_grow(k->aggregate, grown, NULL));
    CHECK_OK(clast_aggregate_history(k->aggregate, &k->history));
    CHECK_OK(clast_aggregate_members(k->aggregate, &k->members));
    k->saved = (clast_aggregate_saved){.repeat = 1,
                                       .placed = clast_aggregate_assembly(k->aggregate),
                                       .history = &k->history,
                                       .members = &k->members};
}

static void drop(kept *k)
{
    clast_table_free(&k->history);
    clast_table_free(&k->members);
    clast_aggregate_destroy(k->aggregate);
    support_aggregate_free(&k->run);
}

/// Restores what was kept with these options in place of its own.
static clast_status restore(kept *k, const char *options)
{
    support_aggregate other;
    clast_aggregate *made = NULL;
    make(options, &other);
    const clast_status status =
        clast_aggregate_restore(&other.config.params, &other.input, &k->saved, &made);
    assert_true((made != NULL) == (status == CLAST_OK));
    clast_aggregate_destroy(made);
    support_aggregate_free(&other);
    return status;
}

#define LAW   "n_particle=6;size_law=uniform;size_low=0.5;size_high=1;envelope=enclosing_sphere;"
#define EQUAL "@0.5;n_particle=6;envelope=enclosing_sphere;"

static void other_parameters_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *own, *other;
    } pairs[] = {
        {LAW, LAW "seed=2"},
        {LAW, LAW "size_high=1.1"},
        {LAW, LAW "size_law=loguniform"},
        {LAW, LAW "order=descending"},
        {LAW, LAW "coat_weight=1;coat_weight=9"},
        {LAW, LAW "core_size=2.5"},
        {LAW, LAW "size_meaning=volume"},
        {EQUAL, EQUAL "seed=2"}, /* all sizes are the same: the first step tells */
        {EQUAL, EQUAL "approach=ballistic"},
        {EQUAL, "@0.6;n_particle=6;envelope=enclosing_sphere"},
        {LAW "contact=march;march_vertices=10;", LAW "contact=march;march_vertices=10;seed=2"},
        {LAW "mode=cluster;", LAW "mode=cluster;seed=2"},
        {LAW "mode=cluster;", LAW "mode=cluster;size_high=1.1"},
        {EQUAL "mode=cluster;", EQUAL "mode=cluster;seed=2"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; ++i) {
        kept k;
        grow(pairs[i].own, 3, &k);
        CHECK_OK(restore(&k, pairs[i].own));
        const clast_status status = restore(&k, pairs[i].other);
        if (status != CLAST_E_FORMAT) {
            fail_msg("%s of %s ends with %s: %s", pairs[i].other, pairs[i].own,
                     clast_status_text(status), clast_error_detail());
        }
        drop(&k);
    }
}

static void other_repeats_are_refused(void **state)
{
    (void)state;
    kept k;
    grow(LAW, 3, &k);
    k.saved.repeat = 0;
    CHECK_STATUS(restore(&k, LAW), CLAST_E_FORMAT);
    k.saved.repeat = 2;
    CHECK_STATUS(restore(&k, LAW), CLAST_E_FORMAT);
    k.saved.repeat = -1;
    CHECK_STATUS(restore(&k, LAW), CLAST_E_ARGUMENT);
    k.saved.repeat = 1;
    clast_table_numbers(&k.history, "repeat")[2] = 5.0;
    CHECK_STATUS(restore(&k, LAW), CLAST_E_FORMAT);
    drop(&k);
}

static void other_densities_are_refused(void **state)
{
    (void)state;
    kept k;
    clast_aggregate *made = NULL;
    grow(LAW, 3, &k);
    const int first = (int)clast_table_numbers(&k.history, "shape")[1];
    double *const density[] = {k.run.coat[first].density, k.run.core.density};
    for (int i = 0; i < 2; ++i) {
        const double own = density[i][0];
        density[i][0] = 1234.0;
        CHECK_STATUS(clast_aggregate_restore(&k.run.config.params, &k.run.input, &k.saved, &made),
                     CLAST_E_FORMAT);
        density[i][0] = own;
    }
    drop(&k);
}

/* Rows of one run with the grains of another, and parts that are missing. */
static void parts_of_two_runs_are_refused(void **state)
{
    (void)state;
    kept a;
    kept b;
    grow(EQUAL, 3, &a);
    grow(EQUAL "seed=2", 3, &b);
    const clast_aggregate_saved own = a.saved;
    a.saved.placed = b.saved.placed;
    CHECK_STATUS(restore(&a, EQUAL), CLAST_E_FORMAT);
    a.saved = own;
    a.saved.history = b.saved.history;
    CHECK_STATUS(restore(&a, EQUAL), CLAST_E_FORMAT);
    a.saved = own;
    a.saved.placed = NULL;
    CHECK_STATUS(restore(&a, EQUAL), CLAST_E_ARGUMENT);
    a.saved = own;
    a.saved.history = NULL;
    CHECK_STATUS(restore(&a, EQUAL), CLAST_E_ARGUMENT);
    drop(&a);
    drop(&b);
}

/* What changes nothing of what stands may change: more particles, another stop. */
static void what_is_still_to_come_may_be_other(void **state)
{
    (void)state;
    kept k;
    grow(EQUAL, 3, &k);
    CHECK_OK(restore(&k, EQUAL "n_particle=9"));
    CHECK_OK(restore(&k, EQUAL "stop_porosity=0.9"));
    drop(&k);
}

static void counts_below_none_are_refused(void **state)
{
    (void)state;
    kept k;
    clast_aggregate *made = NULL;
    grow(LAW, 0, &k);
    CHECK_OK(restore(&k, LAW)); /* the core alone */
    CHECK_STATUS(clast_aggregate_grow(k.aggregate, -1, NULL), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_aggregate_create(&k.run.config.params, &k.run.input, -1, &made),
                 CLAST_E_ARGUMENT);
    assert_null(made);
    drop(&k);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(other_parameters_are_refused),
        cmocka_unit_test(other_repeats_are_refused),
        cmocka_unit_test(other_densities_are_refused),
        cmocka_unit_test(parts_of_two_runs_are_refused),
        cmocka_unit_test(what_is_still_to_come_may_be_other),
        cmocka_unit_test(counts_below_none_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
