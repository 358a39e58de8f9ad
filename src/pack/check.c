// What a packing's options must be to one another, and which of them a run would not look at.
#include "base/field.h"
#include "base/path.h"
#include "pack/walls.h"
#include <clast/shape.h>
#include <string.h>

/// Several mean "as the other" by -1 alone.
static clast_status check_sentinel(const char *name, double value)
{
    return value >= 0.0 || value == -1.0
               ? CLAST_OK
               : clx_fail(CLAST_E_CONFIG, "%s %g: it is -1, or not below 0", name, value);
}

clast_status clx_pack_check(const clast_pack_config *c)
{
    clast_status status = CLAST_OK;
    const double low = c->first_low >= 0.0 ? c->first_low : c->fill_low;
    const double high = c->first_high >= 0.0 ? c->first_high : c->fill_high;
    CLX_TRY(check_sentinel("first_low", c->first_low));
    CLX_TRY(check_sentinel("first_high", c->first_high));
    CLX_CHECK(c->fill_low < c->fill_high, CLAST_E_CONFIG, "fill_low %g is not below fill_high %g",
              c->fill_low, c->fill_high);
    CLX_CHECK(low < high, CLAST_E_CONFIG,
              "the first fill begins at %g of the height (first_low), not below %g (first_high)",
              low, high);
    CLX_TRY(check_sentinel("wall_friction", c->dem.wall_friction));
    CLX_TRY(check_sentinel("trim", c->trim));
done:
    return status;
}

/// What the grains are, as far as an option asks.
typedef struct {
    bool has_sphere;   ///< one that stays one: no form law stretches it
    bool has_other;    ///< than spheres
    bool has_surface;  ///< or a part that is one
    bool has_many;     ///< clumps and aggregates, which touch in several places
    bool has_warm;     ///< bodies whose contacts are found from those of the step before
    bool may_be_hull;  ///< files that a hull may be taken of
    bool has_file;     ///< surfaces and clumps
    bool has_own_unit; ///< files of surfaces
} grains;

static void note_shape(const clast_shape *shape, grains *g)
{
    const bool is_mesh = shape->kind == CLAST_SHAPE_MESH && shape->parts.n == 0;
    g->has_sphere = g->has_sphere || shape->kind == CLAST_SHAPE_SPHERE;
    g->has_other = g->has_other || shape->kind != CLAST_SHAPE_SPHERE;
    g->has_surface = g->has_surface || is_mesh;
    g->has_many = g->has_many || shape->kind == CLAST_SHAPE_CLUMP || shape->parts.n > 0;
    g->has_warm = g->has_warm || is_mesh || shape->kind == CLAST_SHAPE_ELLIPSOID;
    for (int32_t k = 0; shape->parts.part != NULL && k < shape->parts.n; ++k) {
        const clast_shape_kind kind = shape->parts.part[k].kind;
        g->has_surface = g->has_surface || kind == CLAST_SHAPE_MESH;
        g->has_warm = g->has_warm || kind != CLAST_SHAPE_SPHERE;
    }
}

static grains note_grains(const clast_pack_config *c, const clast_pack_input *input)
{
    grains g = {0};
    for (int32_t i = 0; i < input->n_shape; ++i) {
        note_shape(&input->shape[i], &g);
    }
    if (c->form_law) {
        g.has_sphere = false;
        g.has_other = g.has_warm = true;
    }
    for (int32_t i = 0; i < c->shapes.n; ++i) { // those of a start that has its own are not here
        const char *text = c->shapes.item[i];
        if (strcmp(text, "sphere") != 0 && strncmp(text, "ellipsoid:", 10) != 0) {
            const bool is_state = clx_path_is(text, "h5");
            const bool is_surface = !is_state && !clx_path_is(text, "csv");
            g.has_file = true;
            g.has_own_unit = g.has_own_unit || is_surface;
            g.may_be_hull = g.may_be_hull || is_surface || is_state;
        }
    }
    g.may_be_hull = g.may_be_hull && (g.has_surface || c->ellipsoids);
    return g;
}

/// What the stages ask for.
typedef struct {
    bool presses; ///< a pressure, force or stress
    bool reaches; ///< an end at it
    bool rests;   ///< an end at rest
    bool waits;   ///< an end that may not come
} load;

/// One stage; false where it cannot be read, which is said later.
static bool note_stage(const clast_pack_config *c, const clast_pack_input *input, int32_t number,
                       load *l)
{
    bool presses = false;
    bool rests = false;
    bool is_level = false; // ends as soon as its own stresses are reached
    bool is_timed = false;
    if (c->dem.domain == CLAST_DEM_CELL) {
        clx_stage s;
        if (clx_stage_read(c, number, &s) != CLAST_OK) {
            return false;
        }
        presses = s.shear_kind == CLX_DRIVE_STRESS || s.kind[0] == CLX_DRIVE_STRESS ||
                  s.kind[1] == CLX_DRIVE_STRESS || s.kind[2] == CLX_DRIVE_STRESS;
        rests = s.end == CLX_END_REST;
        is_level = s.end == CLX_END_STRESS && s.until == 0.0;
        is_timed = s.end == CLX_END_TIME;
    } else {
        clx_wall_stage s;
        if (clx_wall_stage_read(c, number, input, &s) != CLAST_OK) {
            return false;
        }
        for (int32_t k = 0; k < s.n; ++k) {
            presses = presses || s.drive[k].kind == CLX_WALL_PRESSED;
        }
        rests = s.end == CLX_UNTIL_REST;
        is_level = s.end == CLX_UNTIL_STRESS && s.until == 0.0;
        is_timed = s.end == CLX_UNTIL_TIME;
    }
    l->presses = l->presses || presses;
    l->reaches = l->reaches || (presses && (rests || is_level));
    l->rests = l->rests || rests;
    l->waits = l->waits || !is_timed;
    return true;
}

static load note_load(const clast_pack_config *c, const clast_pack_input *input)
{
    load l = {0};
    for (int32_t k = 0; k < c->stages.n; ++k) {
        if (!note_stage(c, input, k, &l)) {
            return (load){true, true, true, true};
        }
    }
    return l;
}

/// Options that the domain, its container or the stages leave without effect.
static clast_status check_domain(const clast_pack_config *c, const clast_pack_input *input)
{
    const bool has_container = c->container[0] != '\0';
    const bool is_cell = c->dem.domain == CLAST_DEM_CELL;
    const bool has_stages = c->stages.n > 0;
    const load l = note_load(c, input);
    const clast_idle rules[] = {
        {has_container && c->dem.domain != CLAST_DEM_OPEN, "domain",
         "with container, which holds the grains in its place"},
        {has_container, "width|depth|height",
         "with container, which holds the grains in their place"},
        {!has_container, "container_unit", "without container"},
        {c->dem.domain == CLAST_DEM_CYLINDER, "depth",
         "in domain cylinder, which has a width alone"},
        {is_cell, "shaking_time|shake_amplitude|shake_period|shake_from_start|damping",
         "in domain cell, which its stages load"},
        {is_cell, "fill_low|fill_high|first_low|first_high",
         "in domain cell, which is filled whole"},
        {is_cell, "rule|height_change|check_time|still_speed|max_damping_time",
         "in domain cell, whose stages end by their until, load_rest and max_load_time"},
        {is_cell, "wall_friction|layer|cut|trim",
         "in domain cell, which has no walls, no ends and no profile"},
        {!is_cell && !has_stages, "load_rate|load_tolerance|load_rest|max_load_time",
         "without stages"},
        {has_stages && !l.presses, "load_rate", "without a stage that presses (10kPa)"},
        {has_stages && !l.reaches, "load_tolerance",
         "without a stage that ends when its pressure is reached (until rest, until stress)"},
        {has_stages && !l.rests, "load_rest", "without a stage until rest"},
        {has_stages && !l.waits, "max_load_time", "with stages that all end by a time"},
        {0}};
    return clx_fields_idle(clast_pack_fields, c, rules);
}

/// Options that the kinds of grains leave without effect.
static clast_status check_grains(const clast_pack_config *c, const clast_pack_input *input)
{
    const grains g = note_grains(c, input);
    const clast_idle rules[] = {
        {!g.has_own_unit, "unit", "without a surface among shapes"},
        {!g.may_be_hull, "hull|faces", "without a surface among shapes"},
        {c->faces > 0, "hull", "with faces, which take hulls"},
        {!g.has_file, "ellipsoids", "without a surface or clump among shapes"},
        {!c->form_law, "flatness_mean|flatness_deviation|elongation_mean|elongation_deviation",
         "without form_law"},
        {input->n_shape == 1 && c->shape_weight.n == 1, "shape_weight", "with one shape"},
        {!g.has_other, "size_meaning|gyroscopic", "with spheres, whose sizes and moments are one"},
        {!g.has_surface, "rounding", "without surfaces, whose edges it rounds"},
        {!g.has_many, "clump_contacts", "without clumps and aggregates"},
        {!g.has_sphere, "sphere_drag", "without spheres"},
        {!g.has_warm, "verify", "with spheres, whose contacts have no warm start"},
        {0}};
    return clx_fields_idle(clast_pack_fields, c, rules);
}

/// Whether a density was given: of runs that make their grains, the usual one is filled in.
static bool has_density(const clast_pack_config *c)
{
    clast_pack_config usual = {0};
    clx_pack_set_density(&usual);
    return c->density.n > 1 || (c->density.n == 1 && c->density.item[0] != usual.density.item[0]);
}

/// Options that others leave without effect.
static clast_status check_others(const clast_pack_config *c, const clast_pack_input *input)
{
    const bool has_start = c->start[0] != '\0';
    const bool shakes = c->shaking_time > 0.0 || (c->shake_from_start && !has_start);
    const clast_idle rules[] = {
        {has_start,
         "curve|spread|count|size_meaning|shape_weight|form_law|density_of|density_weight|mass|"
         "seed|generator|spacing|fill_low|fill_high|first_low|first_high|initial_speed|random_turn|"
         "shake_from_start",
         "with start, which brings the grains"},
        {!has_start, "start_unit|start_columns|start_diameter|start_frame", "without start"},
        {input->curve == NULL, "spread|count", "without a sieve curve"},
        {c->density_of == CLAST_PACK_DENSITY_LIST && has_density(c), "density",
         "with density_of list, whose column it is"},
        {c->density_of == CLAST_PACK_DENSITY_CHANCE && c->density.n <= 1, "density_of",
         "with one density to draw from"},
        {c->density_of != CLAST_PACK_DENSITY_CHANCE, "density_weight", "without density_of chance"},
        {c->contacts.n == 0, "material", "without contacts, which say how materials touch"},
        {c->dem.law != CLAST_DEM_HERTZ, "young", "without law hertz"},
        {c->dem.law != CLAST_DEM_LINEAR, "collision_time", "without law linear"},
        {c->generator == CLAST_PACK_SHELF, "spacing", "with generator shelf, which has no lattice"},
        {c->shake_amplitude == 0.0, "shake_period|shake_from_start", "with shake_amplitude 0"},
        {!shakes && c->shake_amplitude > 0.0, "shake_amplitude|shake_period",
         "without a time of shaking (shaking_time, shake_from_start)"},
        {c->rule == CLAST_PACK_BY_SPEED, "height_change", "with rule speed"},
        {0}};
    return clx_fields_idle(clast_pack_fields, c, rules);
}

clast_status clx_pack_check_idle(const clast_pack_config *config, const clast_pack_input *input)
{
    clast_status status = CLAST_OK;
    CLX_TRY(check_domain(config, input));
    CLX_TRY(check_others(config, input));
    CLX_TRY(check_grains(config, input));
    CLX_TRY(clx_pack_check_bottom(config, input));
    CLX_TRY(clx_walls_check_idle(config, input));
done:
    return status;
}

clast_status clx_pack_check_lone(const clast_pack_config *config)
{
    const clast_idle rules[] = {
        {true, "frame_time|checkpoint_time", "without an output folder (-o)"}, {0}};
    return clx_fields_idle(clast_pack_fields, config, rules);
}
