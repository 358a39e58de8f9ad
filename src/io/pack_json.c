// A packing's results as JSON.
#include <clast/pack.h>

#include "base/alloc.h"
#include "base/status.h"
#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void put(json_t *object, const char *key, double value)
{
    (void)json_object_set_new(object, key, isfinite(value) ? json_real(value) : json_null());
}

static void put_count(json_t *object, const char *key, int64_t value)
{
    (void)json_object_set_new(object, key, json_integer((json_int_t)value));
}

/// What hulls add to their surfaces: per shape; null for an open surface.
static json_t *hulls(const clast_pack_result *r)
{
    json_t *list = json_array();
    for (int32_t i = 0; i < r->n_hull; ++i) {
        json_t *hull = json_object();
        (void)json_object_set_new(hull, "shape", json_string(r->hull[i].shape));
        put_count(hull, "n_triangle", r->hull[i].n_triangle);
        put(hull, "volume_added", r->hull[i].volume_added);
        (void)json_array_append_new(list, hull);
    }
    return list;
}

/// Remembered contacts beside cold ones.
static json_t *verified(const clast_dem_verification *v)
{
    json_t *o = json_object();
    put_count(o, "n", v->n);
    put_count(o, "n_off", v->n_off);
    put_count(o, "n_bad", v->n_bad);
    put(o, "worst", v->worst);
    return o;
}

/// What went between ranks.
static json_t *ranks(const clast_pack_ranks *r)
{
    json_t *o = json_object();
    put_count(o, "n", r->n);
    put_count(o, "n_idle", r->n_idle);
    put_count(o, "n_balance", r->n_balance);
    put_count(o, "n_migrated", r->n_migrated);
    put(o, "ghosts", r->ghosts);
    put(o, "step_bytes", r->step_bytes);
    put(o, "list_bytes", r->list_bytes);
    put(o, "imbalance", r->imbalance);
    (void)json_object_set_new(o, "is_zoltan", json_boolean(r->is_zoltan));
    return o;
}

static json_t *tensor(const double x[6])
{
    static const char *const name[6] = {"xx", "yy", "zz", "xy", "xz", "yz"};
    json_t *o = json_object();
    for (int e = 0; e < 6; ++e) {
        put(o, name[e], x[e]);
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
        put(o, side[k], r->cell.side[k]);
        put(o, strain[k], r->cell.strain[k]);
    }
    for (int e = 0; e < 6; ++e) {
        stress[e] = r->load.stress[e] + r->load.kinetic_stress[e];
    }
    put(o, "shear_strain", r->cell.shear_strain);
    (void)json_object_set_new(o, "stress", tensor(stress));
    put(o, "pressure", (stress[0] + stress[1] + stress[2]) / 3.0);
    (void)json_object_set_new(o, "fabric", tensor(r->load.fabric));
    put_count(o, "n_rattler", r->load.n_rattler);
    put(o, "coordination_held", r->load.coordination_held);
    put(o, "unbalanced", r->load.unbalanced);
    return o;
}

static json_t *energies(const clast_dem_energy *e)
{
    json_t *o = json_object();
    put(o, "put_in", e->put_in);
    put(o, "kinetic", e->translation + e->rotation);
    put(o, "springs", e->normal_springs + e->tangential_springs);
    put(o, "damping", e->damping[0] + e->damping[1]);
    put(o, "friction", e->friction[0] + e->friction[1]);
    put(o, "rolling", e->rolling[0] + e->rolling[1]);
    put(o, "fluid", e->fluid);
    put(o, "calming", e->calming);
    put(o, "scheme", e->scheme);
    put(o, "rest", e->rest);
    return o;
}

clast_status clast_pack_result_json(const clast_pack_result *r, bool times, char **text)
{
    CLX_ARGUMENTS(r, text);
    CLX_ARRAY(r->hull, r->n_hull);
    clast_status status = CLAST_OK;
    char hash[32];
    char *dumped = NULL;
    json_t *o = json_object();
    (void)snprintf(hash, sizeof hash, "%016" PRIx64, r->hash);
    (void)json_object_set_new(o, "state_hash", json_string(hash));
    put_count(o, "n_grain", r->dem.n_grain);
    put_count(o, "n_step", r->dem.step);
    put(o, "time", r->dem.time);
    (void)json_object_set_new(o, "phase", json_string(clast_pack_phase_name(r->phase)));
    (void)json_object_set_new(o, "converged", json_boolean(r->converged));
    put(o, "mass", r->dem.mass);
    put(o, "mass_wanted", r->mass_wanted);
    put_count(o, "n_outside", r->n_outside);
    put(o, "porosity_bulk", r->porosity);
    put(o, "z_low", r->z_low);
    put(o, "z_high", r->z_high);
    put(o, "bed_top", r->top);
    put(o, "porosity_untrimmed", r->untrimmed);
    put(o, "grain_size", r->walls.size);
    put(o, "wall_ratio", r->walls.ratio);
    put(o, "wall_share", r->wall_share);
    put(o, "flatness_mean", r->flatness[0]);
    put(o, "flatness_deviation", r->flatness[1]);
    put(o, "elongation_mean", r->elongation[0]);
    put(o, "elongation_deviation", r->elongation[1]);
    put(o, "coordination", r->dem.coordination);
    put_count(o, "n_contact", r->dem.n_contact);
    put_count(o, "n_wall_contact", r->dem.n_wall_contact);
    put(o, "mean_height", r->dem.mean_height);
    put(o, "max_overlap", r->dem.max_overlap);
    put(o, "max_speed", r->dem.max_speed);
    (void)json_object_set_new(o, "still_moving", json_boolean(r->is_moving));
    put_count(o, "n_loose", r->n_loose);
    put(o, "sank_after_shaking", r->sank);
    (void)json_object_set_new(o, "shaken_while_falling", json_boolean(r->fell));
    put(o, "kinetic_energy", r->dem.kinetic_energy);
    put_count(o, "n_fill", r->n_fill);
    put_count(o, "n_waited", r->n_waited);
    put_count(o, "n_frame", r->n_frame);
    (void)json_object_set_new(o, "hulls", hulls(r));
    put(o, "grain_steps", r->grain_steps);
    put_count(o, "n_refresh", r->dem.n_refresh);
    if (r->dem.verified.n > 0) {
        (void)json_object_set_new(o, "verified", verified(&r->dem.verified));
    }
    if (r->n_overlap > 0) {
        put_count(o, "n_overlap_start", r->n_overlap);
        put(o, "deepest_overlap_start", r->deepest_start);
    }
    if (r->load.volume > 0.0) {
        (void)json_object_set_new(o, "cell", loaded(r));
    }
    if (r->energy.put_in != 0.0) {
        (void)json_object_set_new(o, "energy", energies(&r->energy));
    }
    if (times) {
        put(o, "wall_s", r->wall_s);
        put(o, "ns_per_grain_step",
            r->clocked_steps > 0.0 ? 1e9 * r->step_s / r->clocked_steps : (double)NAN);
    }
    if (times && r->ranks.n > 1) { // like the clocks, no property of the bed
        (void)json_object_set_new(o, "ranks", ranks(&r->ranks));
    }
    dumped = json_dumps(o, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    CLX_CHECK(dumped != NULL, CLAST_E_MEMORY, "no memory for the result");
    CLX_TRY(clx_alloc_text(text, dumped));
done:
    free(dumped); // Jansson's own block
    json_decref(o);
    return status;
}
