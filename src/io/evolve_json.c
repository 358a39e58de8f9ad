// An evolution's results as JSON.
#include <clast/evolve.h>

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

/// What lies on the floor: means by mass.
static json_t *deposit(const clast_evolve_result *r)
{
    json_t *o = json_object();
    put_count(o, "n", r->n_deposit);
    put(o, "mass", r->mass_deposit);
    put(o, "envelope_diameter", r->deposit_diameter);
    put(o, "porosity", r->deposit_porosity);
    put(o, "speed", r->deposit_speed);
    put(o, "grains", r->deposit_grains);
    return o;
}

static json_t *range(const clast_range_use *use)
{
    char words[512];
    json_t *o = json_object();
    put(o, "collisions", use->n);
    put(o, "outside", use->outside);
    (void)json_object_set_new(o, "farthest",
                              json_string(clast_range_use_words(use, sizeof words, words)));
    return o;
}

clast_status clast_evolve_result_json(const clast_evolve_result *r, bool times, char **text)
{
    CLX_ARGUMENTS(r, text);
    clast_status status = CLAST_OK;
    char hash[32];
    char *dumped = NULL;
    json_t *o = json_object();
    (void)snprintf(hash, sizeof hash, "%016" PRIx64, r->hash);
    (void)json_object_set_new(o, "state_hash", json_string(hash));
    put_count(o, "n_start", r->n_start);
    put_count(o, "n_in_fluid", r->n_particle);
    put_count(o, "n_event", r->n_event);
    put_count(o, "n_deposit", r->n_deposit);
    put_count(o, "n_out", r->n_out);
    put_count(o, "number_balance", r->number_balance);
    put(o, "time", r->time);
    put_count(o, "n_step", r->n_step);
    put(o, "mass_start", r->mass_start);
    put(o, "mass_in_fluid", r->mass);
    put(o, "mass_out", r->mass_out);
    put(o, "mass_balance", r->mass_balance);
    put_count(o, "grains_most", r->grains_most);
    put(o, "fractal_dimension", r->fractal_dimension);
    put(o, "fractal_error", r->fractal_error);
    (void)json_object_set_new(o, "deposit", deposit(r));
    (void)json_object_set_new(o, "range", range(&r->range));
    put_count(o, "n_cut", r->n_cut);
    put_count(o, "n_test", r->n_test);
    put_count(o, "n_frame", r->n_frame);
    put_count(o, "n_kept", r->n_kept);
    if (times) {
        put(o, "wall_s", r->wall_s);
    }
    dumped = json_dumps(o, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    CLX_CHECK(dumped != NULL, CLAST_E_MEMORY, "no memory for the result");
    CLX_TRY(clx_alloc_text(text, dumped));
done:
    free(dumped); // Jansson's own block
    json_decref(o);
    return status;
}
