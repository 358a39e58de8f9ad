// SPDX-License-Identifier: BSD-3-Clause
// A solver linked with it is under the GPL as a whole: README.md.

// The flow: k-epsilon turbulence of one fluid in a mesh whose groups are 1 inlet, 2 outlet, 3 wall,
// 4 symmetry, 5 the part of the inlet that particles come from.
#include "cs_headers.h"
#include "cs_turbulence_bc.h"
#include "settings.h"

void cs_user_model(void)
{
    cs_get_glob_turb_model()->iturb = CS_TURB_K_EPSILON;
}

void cs_user_zones(void)
{
    cs_boundary_zone_define("inlet", "1", 0);
    cs_boundary_zone_define("outlet", "2", 0);
    cs_boundary_zone_define("wall", "3", 0);
    cs_boundary_zone_define("symmetry", "4", 0);
    cs_boundary_zone_define("source", "5", 0);
}

void cs_user_parameters(cs_domain_t *domain)
{
    CS_UNUSED(domain);
    const run_settings *s = settings();
    cs_fluid_properties_t *fluid = cs_get_glob_fluid_properties();
    fluid->ro0 = s->density;
    fluid->viscl0 = s->viscosity;
    cs_get_glob_time_step()->dt_ref = s->dt;
    cs_time_step_define_nt_max(s->n_step);
    cs_get_glob_turb_ref_values()->uref = cs_math_3_norm(s->velocity);
}

void cs_user_initialization(cs_domain_t *domain)
{
    CS_UNUSED(domain);
    cs_real_3_t *u = (cs_real_3_t *)CS_F_(vel)->val;
    for (cs_lnum_t cell = 0; cell < cs_glob_mesh->n_cells; ++cell) {
        for (int j = 0; j < 3; ++j) {
            u[cell][j] = settings()->velocity[j];
        }
    }
}

static void set_inlet(const char *name, int bc_type[], cs_real_t rcodcl[])
{
    const run_settings *s = settings();
    const cs_zone_t *zone = cs_boundary_zone_by_name(name);
    const cs_lnum_t n_face = cs_glob_mesh->n_b_faces;
    const int u = cs_field_get_key_int(CS_F_(vel), cs_field_key_id("variable_id")) - 1;
    const double u2 = cs_math_3_square_norm(s->velocity);
    for (cs_lnum_t k = 0; k < zone->n_elts; ++k) {
        const cs_lnum_t face = zone->elt_ids[k];
        bc_type[face] = CS_INLET;
        for (int j = 0; j < 3; ++j) {
            rcodcl[(u + j) * n_face + face] = s->velocity[j];
        }
        cs_turbulence_bc_inlet_hyd_diam(face, u2, s->hydraulic_diameter, s->density, s->viscosity,
                                        rcodcl);
    }
}

/// Without a GUI file the solver stops in the empty Fortran routine of this name, which it calls
/// before the one in C: this one takes its place.
void cs_f_user_boundary_conditions_(void);
void cs_f_user_boundary_conditions_(void) {}

/// cs_prototypes.h has the second and third argument the other way round; this is what is passed.
void cs_user_boundary_conditions(int nvar, int bc_type[], int icodcl[], cs_real_t rcodcl[])
{
    CS_UNUSED(nvar);
    CS_UNUSED(icodcl);
    static const struct {
        const char *zone;
        int type;
    } plain[] = {{"outlet", CS_OUTLET}, {"wall", CS_SMOOTHWALL}, {"symmetry", CS_SYMMETRY}};
    for (int p = 0; p < 3; ++p) {
        const cs_zone_t *zone = cs_boundary_zone_by_name(plain[p].zone);
        for (cs_lnum_t k = 0; k < zone->n_elts; ++k) {
            bc_type[zone->elt_ids[k]] = plain[p].type;
        }
    }
    set_inlet("inlet", bc_type, rcodcl);
    set_inlet("source", bc_type, rcodcl);
}
