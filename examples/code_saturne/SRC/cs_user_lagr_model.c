// The particles: sets of parcels from the source, carried and dispersed by the flow, one way.
#include "balance.h"
#include "cs_headers.h"
#include "settings.h"

void cs_user_lagr_model(void)
{
    const run_settings *s = settings();
    cs_lagr_time_scheme_t *scheme = cs_glob_lagr_time_scheme;
    scheme->iilagr = CS_LAGR_ONEWAY_COUPLING;
    scheme->isttio = 0;
    scheme->t_order = 1;
    scheme->idistu = 1;
    if (s->task == TASK_OWN) {
        cs_glob_lagr_model->agglomeration = 1;
        cs_glob_lagr_model->n_particle_aggregates = 1;
        cs_glob_lagr_agglomeration_model->scalar_kernel = 0.0; // in the first step
        cs_glob_lagr_agglomeration_model->base_diameter = s->diameter;
    }
}

static void set_injection(int zone_id, int k)
{
    const run_settings *s = settings();
    cs_lagr_injection_set_t *set =
        cs_lagr_get_injection_set(cs_lagr_get_boundary_conditions(), zone_id, k);
    set->n_inject = (cs_gnum_t)s->parcels[k];
    set->injection_frequency = (int)s->period[k];
    set->velocity_profile = -1; // the fluid's
    set->stat_weight = s->weight[k];
    set->flow_rate = 0.0;
    set->diameter = s->diameter;
    set->diameter_variance = 0.0;
    set->density = s->particle_density;
    if (s->task == TASK_OWN) {
        set->particle_aggregate = 1;
    }
}

void cs_user_lagr_boundary_conditions(const int bc_type[])
{
    CS_UNUSED(bc_type);
    static const struct {
        const char *zone;
        int type;
    } type[] = {{"inlet", CS_LAGR_REBOUND},  {"outlet", CS_LAGR_OUTLET}, {"wall", CS_LAGR_REBOUND},
                {"symmetry", CS_LAGR_SYM}, {"source", CS_LAGR_INLET}};
    cs_lagr_zone_data_t *conditions = cs_lagr_get_boundary_conditions();
    for (int k = 0; k < 5; ++k) {
        conditions->zone_type[cs_boundary_zone_by_name(type[k].zone)->id] = type[k].type;
    }
    for (int k = 0; k < settings()->n_set; ++k) {
        set_injection(cs_boundary_zone_by_name("source")->id, k);
    }
}

void cs_user_lagr_in(cs_lagr_particle_set_t *particles, const cs_lagr_injection_set_t *set,
                     const cs_lnum_t range[2], const cs_lnum_t face[], const cs_real_t visc_length[])
{
    CS_UNUSED(set);
    CS_UNUSED(face);
    CS_UNUSED(visc_length);
    for (cs_lnum_t k = range[0]; k < range[1]; ++k) {
        balance_add(&balance_in, particles, k);
    }
}
