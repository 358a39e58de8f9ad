// Options that decompositions, collisions and boxes do not look at, and which are whose.
#include <clast/agglomerate.h>

#include "base/field.h"
#include <string.h>

/// Whether pairs are counted by distance, or may be once the cells are known.
static bool may_pair(const clast_decompose_config *c)
{
    return c->pairs || c->estimator == CLAST_ESTIMATOR_PAIRS ||
           (c->estimator == CLAST_ESTIMATOR_AUTO && clast_decompose_takes_tree(c) &&
            c->extrapolate && !c->paper && c->events == CLAST_EVENTS_PAIRS);
}

const clast_idle *clast_decompose_idle(const clast_decompose_config *c, bool has_variable,
                                       int32_t n_size, clast_idle rules[CLAST_N_IDLE])
{
    if (c == NULL || rules == NULL) {
        return NULL;
    }
    const bool is_tree = clast_decompose_takes_tree(c);
    const clast_idle made[CLAST_N_IDLE] = {
        {c->variant == CLAST_VARIANT_TEST,
         "mesh|events|crossfit|beta_dt|pairs|pairs_radius|estimator|sizes|lower|strict|max_pass|"
         "tree_level|tree_root_level|tree_least|tree_refine|extrapolate|ghost_samples|"
         "variable_column",
         "with --test-only or --variant test"},
        {n_size == 0, "regular", "without --sizes"},
        {!has_variable, "variable_tolerance", "without --variable-column"},
        {is_tree, "lower|strict|max_pass|ghost_samples",
         "with cells of the tree: --mesh boxes joins bins"},
        {!is_tree, "tree_level|tree_root_level|tree_least|tree_refine|extrapolate",
         "with cells of bins: --mesh tree splits by a test"},
        {c->variant != CLAST_VARIANT_FULL, "max_pass", "with this --variant: it makes one pass"},
        {!may_pair(c), "pairs_radius", "without --pairs"}};
    return clx_idle_copy(made, rules);
}

const clast_idle *clast_agglomerate_idle(const clast_agglomerate_config *c,
                                         const clast_agglomerate_given *given,
                                         clast_idle rules[CLAST_N_IDLE])
{
    if (c == NULL || given == NULL || rules == NULL) {
        return NULL;
    }
    const bool is_one = given->n_snapshot == 1;
    const clast_idle made[CLAST_N_IDLE] = {
        {c->collide.collisions == CLAST_COLLISIONS_NEXT, "leap", "without --collisions poisson"},
        {!given->weight, "self_collisions", "without --weight-column"},
        {is_one, "change_level", "with one snapshot"},
        {is_one && c->rebuild == CLAST_REBUILD_ALWAYS, "rebuild",
         "with one snapshot, which gets its cells whatever it says"},
        {c->rebuild != CLAST_REBUILD_CHANGED, "change_level", "with this --rebuild"},
        {given->temperature, "temperature", "with --temperature-column"},
        {given->shear, "shear", "with --shear-column"},
        {given->dissipation, "dissipation", "with --dissipation-column"},
        {given->radius && c->collide.radius_law == CLAST_RADIUS_VOLUME, "monomer_radius",
         "with a column of radii"}};
    return clx_idle_copy(made, rules);
}

const clast_idle *clast_spectrum_idle(const clast_spectrum_config *c,
                                      clast_idle rules[CLAST_N_IDLE])
{
    if (c == NULL || rules == NULL) {
        return NULL;
    }
    const clast_idle made[CLAST_N_IDLE] = {
        {c->solver == CLAST_SOLVER_SECTIONAL, "particles|collisions|leap|block|seed",
         "with this --solver"},
        {c->solver == CLAST_SOLVER_MONTE_CARLO, "tolerance", "with this --solver"},
        {c->breakage_rate == 0.0, "breakage_exponent|fragments|fragment_exponent",
         "without --breakage-rate"},
        {c->fragments == CLAST_FRAGMENTS_HALVES, "fragment_exponent", "with --fragments halves"},
        {c->source == 0.0, "source_size", "without --source"},
        {c->initial == CLAST_INITIAL_TABLE, "initial_mean|initial_sd", "with --initial table"},
        {c->initial != CLAST_INITIAL_LOGNORMAL, "initial_sd", "without --initial lognormal"}};
    return clx_idle_copy(made, rules);
}

bool clast_agglomerate_takes(const char *key, bool is_box)
{
    static const clast_field both[] = {
        {.name = "box_model"}, {.name = "charts"}, {.name = "force"}, {.name = "seed"}, {0}};
    static const clast_field cloud[] = {{.name = "rebuild"},         {.name = "change_level"},
                                        {.name = "fixed"},           {.name = "depth"},
                                        {.name = "self_collisions"}, {0}};
    if (key == NULL) {
        return false;
    }
    if (strcmp(key, "initial_file") == 0 || clast_fields_find(clast_spectrum_fields, key) != NULL) {
        return is_box;
    }
    return !is_box || clast_fields_find(both, key) != NULL ||
           (clast_fields_find(clast_agglomerate_fields, key) != NULL &&
            clast_fields_find(cloud, key) == NULL);
}
