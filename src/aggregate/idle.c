// Options that a run by these others would not look at.
#include "aggregate/config.h"

#include "base/field.h"
#include "base/path.h"
#include <clast/aggregate_run.h>
#include <stdio.h>
#include <string.h>

/// Whether an envelope's name begins so.
static bool has_envelope(const clast_text_list *envelope, const char *prefix)
{
    bool has = false;
    for (int32_t i = 0; i < envelope->n; ++i) {
        has = has || strncmp(envelope->item[i], prefix, strlen(prefix)) == 0;
    }
    return has;
}

/// Whether a shape is filled with spheres where composites are needed: an earlier aggregate has its
/// own.
static bool is_filled(const char *shape, const char *spheres)
{
    return spheres[0] == '\0' && !clx_path_is(shape, "h5");
}

/// How many coating shapes come with their own densities.
static int32_t n_coat_dense(const clast_aggregate_config *c)
{
    int32_t n = 0;
    for (int32_t i = 0; i < c->coat.n; ++i) {
        n += clx_path_is(c->coat.item[i], "h5") ? 1 : 0;
    }
    return n;
}

static bool fills_some(const clast_aggregate_config *c)
{
    const bool has_core = c->params.mode == CLAST_AGGREGATE_CORE;
    bool fills = has_core && is_filled(c->core, c->core_spheres);
    for (int32_t i = 0; i < c->coat.n; ++i) {
        fills = fills ||
                is_filled(c->coat.item[i], c->coat_spheres.n > i ? c->coat_spheres.item[i] : "");
    }
    return fills;
}

static clast_status check_shapes(const clast_aggregate_config *c)
{
    const clast_idle rules[] = {{c->params.mode == CLAST_AGGREGATE_CLUSTER,
                                 "core|core_size|core_meaning|core_density|core_spheres",
                                 "in mode cluster"},
                                {clx_path_is(c->core, "h5"), "core_density",
                                 "with an aggregate (state.h5), whose grains have their own"},
                                {c->coat.n > 0 && n_coat_dense(c) == c->coat.n, "coat_density",
                                 "with aggregates (state.h5), whose grains have their own"},
                                {c->coat.n == 1, "coat_weight", "with one coating shape"},
                                {0}};
    return clx_fields_idle(clast_aggregate_fields, c, rules);
}

static clast_status check_sizes(const clast_aggregate_config *c)
{
    const int32_t law = c->params.size_law;
    const bool is_flat = law == CLAST_SIZE_UNIFORM || law == CLAST_SIZE_LOGUNIFORM;
    const clast_idle rules[] = {
        {c->sizes[0] == '\0', "size_column|size_unit", "without sizes"},
        {law == CLAST_SIZE_LIST, "size_mean|size_deviation|size_shape|size_low|size_high",
         "without a size_law"},
        {law != CLAST_SIZE_LIST, "size_draw|size_by_mass", "with a size_law, which draws"},
        {is_flat, "size_mean|size_deviation|size_shape",
         "with this size_law: it goes from size_low to size_high"},
        {law == CLAST_SIZE_NORMAL, "size_shape", "with this size_law: its width is size_deviation"},
        {law == CLAST_SIZE_LOGNORMAL || law == CLAST_SIZE_WEIBULL, "size_deviation",
         "with this size_law: its width is size_shape"},
        {0}};
    return clx_fields_idle(clast_aggregate_fields, c, rules);
}

static clast_status check_growth(const clast_aggregate_config *c)
{
    const clast_aggregate_params *p = &c->params;
    const bool is_core = p->mode == CLAST_AGGREGATE_CORE;
    const bool is_march = p->contact == CLAST_CONTACT_MARCH;
    const bool at_mass = p->origin == CLAST_ORIGIN_MASS;
    const bool at_grain = p->origin == CLAST_ORIGIN_GRAIN;
    const clast_idle rules[] = {
        {!is_core && !at_mass && !at_grain, "origin",
         "in mode cluster: rays start at the centre of mass, or with grain at a grain"},
        {!is_core, "target", "in mode cluster: it is the centre of mass"},
        {is_core, "pick|n_final", "without mode cluster"},
        {p->approach != CLAST_APPROACH_DIFFUSIVE, "walk_step", "without approach diffusive"},
        {!is_march, "march_coarse|march_fine|march_steps|march_vertices", "without contact march"},
        {is_march, "target|max_tries", "with contact march"},
        {is_march && (at_mass || at_grain), "origin",
         "with contact march: rays start at the core's centre, or with sphere at a sphere"},
        {!has_envelope(&p->envelope, "sphere_rays"), "envelope_rays",
         "without envelope sphere_rays"},
        {!has_envelope(&p->envelope, "wrap") && !has_envelope(&p->envelope, "alpha"),
         "envelope_length", "without envelope wrap or alpha"},
        {0}};
    return clx_fields_idle(clast_aggregate_fields, c, rules);
}

static clast_status check_results(const clast_aggregate_config *c)
{
    const clast_idle rules[] = {
        {!c->fit,
         "observed_size|observed_size_error|observed_density|observed_density_error|"
         "observed_velocity|observed_velocity_error|fit_packing|fit_repeats|fit_replicate_max",
         "without fit"},
        {c->fit, "repeats", "with fit: it grows fit_repeats"},
        {c->fit,
         "envelope_every|fall_speed|permeability|confidence|checkpoint_every|picture|printable",
         "with fit"},
        {!c->printable, "neck|spacing", "without printable"},
        {0}};
    return clx_fields_idle(clast_aggregate_fields, c, rules);
}

static bool has_composites(const clast_aggregate_params *p)
{
    return p->contact != CLAST_CONTACT_EXACT || has_envelope(&p->envelope, "sphere_");
}

/// What is for the folder of a run, where there is none.
static clast_status check_folder(const clast_aggregate_config *c, bool has_folder)
{
    const clast_idle rules[] = {{!has_folder, "fall_speed|printable|neck|spacing", "without -o"},
                                {!has_folder && !has_composites(&c->params),
                                 "core_spheres|coat_spheres",
                                 "without -o, contact spheres or march, or an envelope of spheres"},
                                {0}};
    return clx_fields_idle(clast_aggregate_fields, c, rules);
}

/// What a file for march, composites or many repeats brings to a run of true surfaces or of one
/// aggregate is told, not refused: one file serves both.
static void note_idle(const clast_aggregate_config *c, const clast_monitor *monitor)
{
    const clast_idle rules[] = {
        {c->params.contact != CLAST_CONTACT_MARCH, "flavour", "without contact march"},
        {!has_composites(&c->params), "fill|fill_spheres",
         "without contact spheres or march, or an envelope of spheres"},
        {!fills_some(c), "fill|fill_spheres", "where every shape comes with its spheres"},
        {c->repeats == 1, "confidence", "without repeats"},
        {0}};
    for (const clast_idle *r = rules; r->names != NULL; ++r) {
        const clast_idle one[] = {*r, {0}};
        const char *why = NULL;
        const clast_field *f = clast_fields_idle(clast_aggregate_fields, c, one, &why);
        char text[160];
        if (f != NULL && monitor != NULL && monitor->note != NULL) {
            (void)snprintf(text, sizeof text, "%s does nothing %s", f->name, why);
            monitor->note(monitor->context, text);
        }
    }
}

clast_status clx_aggregate_idle(const clast_aggregate_config *config, bool has_folder,
                                const clast_monitor *monitor)
{
    clast_status status = CLAST_OK;
    CLX_TRY(check_shapes(config));
    CLX_TRY(check_sizes(config));
    CLX_TRY(check_growth(config));
    CLX_TRY(check_results(config));
    CLX_TRY(check_folder(config, has_folder));
    note_idle(config, monitor);
done:
    return status;
}
