// A packing's results as JSON.
#include <clast/pack.h>

#include "base/status.h"
#include "io/json.h"
#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>

/// What hulls add to their surfaces: per shape; null for an open surface.
static json_t *hulls(const clast_pack_result *r)
{
    json_t *list = json_array();
    for (int32_t i = 0; i < r->n_hull; ++i) {
        json_t *hull = json_object();
        (void)json_object_set_new(hull, "shape", json_string(r->hull[i].shape));
        clx_json_set_count(hull, "n_triangle", r->hull[i].n_triangle);
        clx_json_set_number(hull, "volume_added", r->hull[i].volume_added);
        (void)json_array_append_new(list, hull);
    }
    return list;
}

/// Remembered contacts beside cold ones.
static json_t *verified(const clast_dem_verification *v)
{
    json_t *o = json_object();
    clx_json_set_count(o, "n", v->n);
    clx_json_set_count(o, "n_off", v->n_off);
    clx_json_set_count(o, "n_bad", v->n_bad);
    clx_json_set_number(o, "worst", v->worst);
    return o;
}

/// What went between ranks.
static json_t *ranks(const clast_pack_ranks *r)
{
    json_t *o = json_object();
    clx_json_set_count(o, "n", r->n);
    clx_json_set_count(o, "n_idle", r->n_idle);
    clx_json_set_count(o, "n_balance", r->n_balance);
    clx_json_set_count(o, "n_migrated", r->n_migrated);
    clx_json_set_number(o, "ghosts", r->ghosts);
    clx_json_set_number(o, "messages", r->messages);
    clx_json_set_number(o, "step_bytes", r->step_bytes);
    clx_json_set_number(o, "list_bytes", r->list_bytes);
    clx_json_set_number(o, "imbalance", r->imbalance);
    (void)json_object_set_new(o, "is_zoltan", json_boolean(r->is_zoltan));
    return o;
}

static json_t *tensor(const double x[6])
{
    static const char *const name[6] = {"xx", "yy", "zz", "xy", "xz", "yz"};
    json_t *o = json_object();
    for (int e = 0; e < 6; ++e) {
        clx_json_set_number(o, name[e], x[e]);
    }
    return o;
}

/// A cell and what it carries.
static json_t *loaded(const clast_pack_result *r)
{
    static const char *const side[3] = {"width", "depth", "height"};
    static const char *const strain[3] = {"strain_x", "strain_y", "strain_z"};
    json_t *o = json_object();
    double stress[6];
    for (int k = 0; k < 3; ++k) {
        clx_json_set_number(o, side[k], r->cell.side[k]);
        clx_json_set_number(o, strain[k], r->cell.strain[k]);
    }
    for (int e = 0; e < 6; ++e) {
        stress[e] = r->load.stress[e] + r->load.kinetic_stress[e];
    }
    clx_json_set_number(o, "shear_strain", r->cell.shear_strain);
    (void)json_object_set_new(o, "stress", tensor(stress));
    clx_json_set_number(o, "pressure", (stress[0] + stress[1] + stress[2]) / 3.0);
    (void)json_object_set_new(o, "fabric", tensor(r->load.fabric));
    clx_json_set_count(o, "n_rattler", r->load.n_rattler);
    clx_json_set_number(o, "coordination_held", r->load.coordination_held);
    clx_json_set_number(o, "unbalanced", r->load.unbalanced);
    return o;
}

static json_t *energies(const clast_dem_energy *e)
{
    json_t *o = json_object();
    clx_json_set_number(o, "put_in", e->put_in);
    clx_json_set_number(o, "kinetic", e->translation + e->rotation);
    clx_json_set_number(o, "springs", e->normal_springs + e->tangential_springs);
    clx_json_set_number(o, "attraction", e->attraction);
    clx_json_set_number(o, "damping", e->damping[0] + e->damping[1]);
    clx_json_set_number(o, "friction", e->friction[0] + e->friction[1]);
    clx_json_set_number(o, "rolling", e->rolling[0] + e->rolling[1]);
    clx_json_set_number(o, "fluid", e->fluid);
    clx_json_set_number(o, "calming", e->calming);
    clx_json_set_number(o, "walls", e->walls);
    clx_json_set_number(o, "left", e->left);
    clx_json_set_number(o, "scheme", e->scheme);
    clx_json_set_number(o, "rest", e->rest);
    return o;
}

clast_status clast_pack_result_json(const clast_pack_result *r, bool times, char **text)
{
    CLX_ARGUMENTS(r, text);
    CLX_ARRAY(r->hull, r->n_hull);
    clast_status status = CLAST_OK;
    static const char *const why[] = {[CLAST_PACK_POROUS] = "",
                                      [CLAST_PACK_NO_BED] = "no bed yet",
                                      [CLAST_PACK_ABOVE_CUT] = "above cut",
                                      [CLAST_PACK_TRIMMED] = "trimmed away",
                                      [CLAST_PACK_FALLING] = "no bed yet"};
    char hash[32];
    json_t *o = json_object();
    (void)snprintf(hash, sizeof hash, "%016" PRIx64, r->hash);
    (void)json_object_set_new(o, "state_hash", json_string(hash));
    clx_json_set_count(o, "n_grain", r->dem.n_grain);
    clx_json_set_count(o, "n_step", r->dem.step);
    clx_json_set_number(o, "time", r->dem.time);
    (void)json_object_set_new(o, "phase", json_string(clast_pack_phase_name(r->phase)));
    (void)json_object_set_new(o, "converged", json_boolean(r->converged));
    clx_json_set_number(o, "mass", r->dem.mass);
    clx_json_set_number(o, "mass_wanted", r->mass_wanted);
    clx_json_set_count(o, "n_outside", r->n_outside);
    clx_json_set_number(o, "porosity_bulk", r->porosity);
    if (r->porosity_state > CLAST_PACK_POROUS && r->porosity_state <= CLAST_PACK_FALLING) {
        (void)json_object_set_new(o, "porosity_none", json_string(why[r->porosity_state]));
    }
    clx_json_set_number(o, "porosity_least", r->porosity_least);
    (void)json_object_set_new(o, "porosity_method", json_string("spheres"));
    clx_json_set_number(o, "z_low", r->z_low);
    clx_json_set_number(o, "z_high", r->z_high);
    clx_json_set_number(o, "bed_top", r->top);
    clx_json_set_number(o, "porosity_untrimmed", r->untrimmed);
    clx_json_set_number(o, "grain_size", r->walls.size);
    clx_json_set_number(o, "wall_ratio", r->walls.ratio);
    clx_json_set_number(o, "wall_share", r->wall_share);
    clx_json_set_number(o, "flatness_mean", r->flatness[0]);
    clx_json_set_number(o, "flatness_deviation", r->flatness[1]);
    clx_json_set_number(o, "elongation_mean", r->elongation[0]);
    clx_json_set_number(o, "elongation_deviation", r->elongation[1]);
    clx_json_set_number(o, "coordination", r->dem.coordination);
    clx_json_set_count(o, "n_contact", r->dem.n_contact);
    clx_json_set_count(o, "n_wall_contact", r->dem.n_wall_contact);
    clx_json_set_number(o, "mean_height", r->dem.mean_height);
    clx_json_set_number(o, "max_overlap", r->dem.max_overlap);
    clx_json_set_number(o, "max_speed", r->dem.max_speed);
    (void)json_object_set_new(o, "still_moving", json_boolean(r->is_moving));
    clx_json_set_number(o, "still_diameters", r->still_diameters);
    clx_json_set_count(o, "n_loose", r->n_loose);
    clx_json_set_number(o, "sank_after_shaking", r->sank);
    (void)json_object_set_new(o, "shaken_while_falling", json_boolean(r->fell));
    clx_json_set_number(o, "kinetic_energy", r->dem.kinetic_energy);
    clx_json_set_count(o, "n_fill", r->n_fill);
    clx_json_set_count(o, "n_waited", r->n_waited);
    clx_json_set_count(o, "n_frame", r->n_frame);
    (void)json_object_set_new(o, "hulls", hulls(r));
    clx_json_set_number(o, "grain_steps", r->grain_steps);
    clx_json_set_count(o, "n_refresh", r->dem.n_refresh);
    if (r->dem.verified.n > 0) {
        (void)json_object_set_new(o, "verified", verified(&r->dem.verified));
    }
    if (r->own_density > 0.0) {
        clx_json_set_number(o, "aggregate_density", r->own_density);
        clx_json_set_number(o, "given_density", r->given_density);
    }
    if (r->n_overlap > 0) {
        clx_json_set_count(o, "n_overlap_start", r->n_overlap);
        clx_json_set_number(o, "deepest_overlap_start", r->deepest_start);
    }
    if (r->n_start_snapshot > 1) {
        clx_json_set_count(o, "start_snapshot", r->start_snapshot);
        clx_json_set_count(o, "n_start_snapshot", r->n_start_snapshot);
    }
    if (r->n_start_snapshot > 1 && r->start_step >= 0) {
        clx_json_set_count(o, "start_step", r->start_step);
    }
    if (r->n_left > 0) {
        clx_json_set_count(o, "n_left", r->n_left);
        clx_json_set_number(o, "mass_left", r->mass_left);
    }
    if (r->load.volume > 0.0) {
        (void)json_object_set_new(o, "cell", loaded(r));
    }
    if (r->energy.put_in != 0.0) {
        (void)json_object_set_new(o, "energy", energies(&r->energy));
    }
    if (times) {
        clx_json_set_number(o, "wall_s", r->wall_s);
        clx_json_set_number(o, "ns_per_grain_step",
                            r->clocked_steps > 0.0 ? 1e9 * r->step_s / r->clocked_steps
                                                   : (double)NAN);
    }
    if (times && r->ranks.n > 1) { // like the clocks, no property of the bed
        (void)json_object_set_new(o, "ranks", ranks(&r->ranks));
    }
    CLX_TRY(clx_json_dump(o, text));
done:
    json_decref(o);
    return status;
}
