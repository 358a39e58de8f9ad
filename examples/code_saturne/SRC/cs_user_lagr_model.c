// SPDX-License-Identifier: BSD-3-Clause
// A solver linked with it is under the GPL as a whole: README.md.

// The particles: sets of parcels from the source, carried and dispersed by the flow, one way.
#include "balance.h"
#include "cs_headers.h"
#include "settings.h"
#include <string.h>

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
        cs_glob_lagr_agglomeration_model->scalar_kernel = 0.0;
        cs_glob_lagr_agglomeration_model->base_diameter = s->diameter;
    }
}

/// The solver's agglomeration appends parcels without asking whether there is room, and takes the
/// density in a cell from the parcel whose number is the cell's: so there is room for as many
/// parcels as there are cells, and what is free is filled with primary particles.
static void make_room(void)
{
    const run_settings *s = settings();
    cs_lagr_particle_set_t *set = cs_lagr_get_particle_set();
    const double d = s->diameter;
    const cs_lnum_t wanted = 2 * (set->n_particles + (cs_lnum_t)s->parcels[0]) + 1000;
    cs_lagr_particle_set_resize(CS_MAX(wanted, cs_glob_mesh->n_cells));
    for (cs_lnum_t k = set->n_particles; k < set->n_particles_max; ++k) {
        memset(set->p_buffer + set->p_am->extents * (size_t)k, 0, set->p_am->extents);
        *(double *)cs_lagr_particles_attr(set, k, CS_LAGR_DIAMETER) = d;
        *(double *)cs_lagr_particles_attr(set, k, CS_LAGR_MASS) =
            s->particle_density * cs_math_pi / 6.0 * d * d * d;
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
    } type[] = {{"inlet", CS_LAGR_REBOUND},
                {"outlet", CS_LAGR_OUTLET},
                {"wall", CS_LAGR_REBOUND},
                {"symmetry", CS_LAGR_SYM},
                {"source", CS_LAGR_INLET}};
    cs_lagr_zone_data_t *conditions = cs_lagr_get_boundary_conditions();
    for (int k = 0; k < 5; ++k) {
        conditions->zone_type[cs_boundary_zone_by_name(type[k].zone)->id] = type[k].type;
    }
    for (int k = 0; k < settings()->n_set; ++k) {
        set_injection(cs_boundary_zone_by_name("source")->id, k);
    }
    if (settings()->task == TASK_OWN) { // called at each step, before particles are injected
        const bool is_last = cs_glob_time_step->nt_cur == settings()->n_step;
        cs_glob_lagr_agglomeration_model->scalar_kernel = is_last ? settings()->kernel : 0.0;
        make_room();
    }
}

void cs_user_lagr_in(cs_lagr_particle_set_t *particles, const cs_lagr_injection_set_t *set,
                     const cs_lnum_t range[2], const cs_lnum_t face[],
                     const cs_real_t visc_length[])
{
    CS_UNUSED(set);
    CS_UNUSED(face);
    CS_UNUSED(visc_length);
    for (cs_lnum_t k = range[0]; k < range[1]; ++k) {
        balance_add(&balance_in, particles, k);
    }
}
