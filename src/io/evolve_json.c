// An evolution's results as JSON.
#include <clast/evolve.h>

#include "base/status.h"
#include "io/json.h"
#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>

/// What lies on the floor: means by mass.
static json_t *deposit(const clast_evolve_result *r)
{
    json_t *o = json_object();
    clx_json_set_count(o, "n", r->n_deposit);
    clx_json_set_number(o, "mass", r->mass_deposit);
    clx_json_set_count(o, "n_wall", r->n_wall);
    clx_json_set_number(o, "mass_wall", r->mass_wall);
    (void)json_object_set_new(o, "envelope_kind", json_string("ellipsoid of equal moments"));
    clx_json_set_number(o, "envelope_diameter", r->deposit_diameter);
    clx_json_set_number(o, "porosity", r->deposit_porosity);
    clx_json_set_number(o, "speed", r->deposit_speed);
    clx_json_set_number(o, "grains", r->deposit_grains);
    if (r->bed_width > 0.0) {
        clx_json_set_number(o, "bed_width", r->bed_width);
        clx_json_set_number(o, "bed_height", r->bed_height);
        clx_json_set_number(o, "bed_mass", r->bed_mass);
        clx_json_set_number(o, "bed_least", r->bed_least);
    }
    return o;
}

static json_t *range(const clast_range_use *use)
{
    char words[512];
    json_t *o = json_object();
    clx_json_set_number(o, "collisions", use->n);
    clx_json_set_number(o, "outside", use->outside);
    (void)json_object_set_new(o, "farthest",
                              json_string(clast_range_use_words(use, sizeof words, words)));
    return o;
}

clast_status clast_evolve_result_json(const clast_evolve_result *r, bool times, char **text)
{
    CLX_ARGUMENTS(r, text);
    clast_status status = CLAST_OK;
    char hash[32];
    json_t *o = json_object();
    (void)snprintf(hash, sizeof hash, "%016" PRIx64, r->hash);
    (void)json_object_set_new(o, "state_hash", json_string(hash));
    clx_json_set_count(o, "n_start", r->n_start);
    clx_json_set_count(o, "n_in_fluid", r->n_particle);
    clx_json_set_count(o, "n_event", r->n_event);
    clx_json_set_count(o, "n_deposit", r->n_deposit);
    clx_json_set_count(o, "n_out", r->n_out);
    clx_json_set_count(o, "number_balance", r->number_balance);
    clx_json_set_number(o, "time", r->time);
    clx_json_set_count(o, "n_step", r->n_step);
    clx_json_set_number(o, "mass_start", r->mass_start);
    clx_json_set_number(o, "mass_in_fluid", r->mass);
    clx_json_set_number(o, "mass_out", r->mass_out);
    clx_json_set_number(o, "mass_balance", r->mass_balance);
    clx_json_set_number(o, "gathered", r->gathered);
    clx_json_set_count(o, "grains_most", r->grains_most);
    clx_json_set_number(o, "volume_fraction", r->volume_fraction);
    clx_json_set_number(o, "fall_reynolds", r->fall_reynolds);
    clx_json_set_number(o, "fractal_dimension", r->fractal_dimension);
    clx_json_set_number(o, "fractal_error", r->fractal_error);
    (void)json_object_set_new(o, "deposit", deposit(r));
    (void)json_object_set_new(o, "range", range(&r->range));
    clx_json_set_count(o, "n_cut", r->n_cut);
    clx_json_set_count(o, "n_test", r->n_test);
    clx_json_set_count(o, "n_unresolved", r->n_unresolved);
    clx_json_set_count(o, "n_frame", r->n_frame);
    clx_json_set_count(o, "n_written", r->n_written);
    if (times) {
        clx_json_set_number(o, "wall_s", r->wall_s);
    }
    CLX_TRY(clx_json_dump(o, text));
done:
    json_decref(o);
    return status;
}
