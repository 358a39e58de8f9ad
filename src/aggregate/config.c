// The option table of an aggregation, and the combinations that no single range can see.
#include "aggregate/config.h"

#include "base/field.h"
#include "base/number.h"
#include "math/vec3.h"
#include <float.h>
#include <string.h>

// `of` is "params." or nothing: where in the configuration the field is.
#define FIELD(type, of, name)                                                                      \
#name, .offset = offsetof(clast_aggregate_config, of name), CLAST_FIELD_##type
#define TEXT(of, name, value, ...)                                                                 \
    {                                                                                              \
        FIELD(TEXT, of, name), 0, 0, 0, "-", .text = value, .help = __VA_ARGS__                    \
    }
#define NUMBER(of, name, value, low, high, unit, ...)                                              \
    {                                                                                              \
        FIELD(F64, of, name), value, low, high, unit, __VA_ARGS__                                  \
    }
#define COUNT(of, name, value, low, high, ...)                                                     \
    {                                                                                              \
        FIELD(I32, of, name), value, low, high, "-", __VA_ARGS__                                   \
    }
#define CHOICE(of, name, value, words, ...)                                                        \
    {                                                                                              \
        FIELD(CHOICE, of, name), value, 0, 0, "-", .text = words, .help = __VA_ARGS__              \
    }
#define LIST(of, name, low, high, unit, value, ...)                                                \
    {                                                                                              \
        FIELD(F64_LIST, of, name), 0, low, high, unit, .text = value, .help = __VA_ARGS__          \
    }
#define TEXTS(of, name, value, ...)                                                                \
    {                                                                                              \
        FIELD(TEXT_LIST, of, name), 0, 0, 0, "-", .text = value, .help = __VA_ARGS__               \
    }
#define FLAG(of, name, ...)                                                                        \
    {                                                                                              \
        FIELD(BOOL, of, name), 0, 0, 1, "-", __VA_ARGS__                                           \
    }

const clast_field clast_aggregate_fields[] = {
    CHOICE(params., mode, 0, "core|cluster",
           "grow on a core, or merge a population of grains cluster by cluster", .group = "shapes"),
    TEXT(, core, "", "core: surface file, state.h5, sphere, or ellipsoid:a,b,c", .common = true),
    NUMBER(params., core_size, 0, 0, 1e6, "m", "size of the core; 0: as its file says",
           .common = true),
    CHOICE(params., core_meaning, 0, "length|volume|mean_diameter",
           "what core_size measures, as size_meaning"),
    NUMBER(params., core_density, 2500, 1e-6, 1e6, "kg/m^3", "density of the core"),
    TEXTS(, coat, "", "coating shape: as core", .common = true),
    LIST(params., coat_weight, 0, DBL_MAX, "-", "",
         "probability of each coating shape; none: all equal"),
    LIST(params., class_limit, 0, 1e6, "m", "",
         "sizes up to the k-th limit take the k-th coating shape, larger ones the last"),
    LIST(params., coat_density, 1e-6, 1e6, "kg/m^3", "2500",
         "density: one for all shapes, or one each", .common = true),
    TEXT(, core_spheres, "", "sphere composite of the core (CSV x,y,z,r); none: filled"),
    TEXTS(, coat_spheres, "", "sphere composite of each coating shape"),
    COUNT(, fill_spheres, 100, 1, 1e6, "spheres of each composite that is filled here"),
    CHOICE(, fill, 0, "largest|random|published", "how it is filled (see clast fill)"),
    TEXT(, unit, "", "length unit of surface files that do not say theirs", .common = true),
    FLAG(, accept_faults, "use surfaces that are open, cross themselves or lie apart as they are"),

    TEXT(, sizes, "", "CSV of sizes, of sizes with counts, or of bins low,high with counts",
         .common = true, .group = "sizes"),
    TEXT(, size_column, "",
         "its column; none: the one that is named a size, else the first that counts nothing"),
    TEXT(, size_unit, "", "its unit, um, mm, m or phi; none: from the column's name",
         .common = true),
    LIST(params., size, 1e-12, 1e6, "m", "", "a size, instead of a file"),
    CHOICE(params., size_law, 0, "list|uniform|loguniform|normal|lognormal|weibull",
           "sizes from the list, or drawn from a law"),
    NUMBER(params., size_mean, 0, 0, 1e6, "m",
           "mean (normal), median (lognormal), scale (weibull)"),
    NUMBER(params., size_deviation, 0, 0, 1e6, "m",
           "standard deviation (normal); for lognormal and weibull see size_shape"),
    NUMBER(params., size_shape, 0, 0, 100, "-",
           "lognormal: standard deviation of ln size; weibull: exponent"),
    NUMBER(params., size_low, 0, 0, 1e6, "m", "smallest size of a law"),
    NUMBER(params., size_high, 0, 0, 1e6, "m", "greatest size of a law; 0: none"),
    COUNT(params., n_particle, 0, 0, 1e8,
          "particles to place, 0: the whole list; from a law or with size_draw: how many are "
          "drawn, replicate times"),
    FLAG(params., size_draw, "draw n_particle sizes from the histogram at random"),
    FLAG(params., size_by_mass,
         "rows of the histogram hold masses (a column mass, mass_g, weight ..), not numbers"),
    COUNT(params., replicate, 1, 1, 1e6,
          "how often the list is used, or n_particle sizes are drawn (N_A of the paper)",
          .common = true),
    CHOICE(params., size_meaning, 0, "length|volume|mean_diameter",
           "sizes are maximum lengths, volume-equivalent or (L I S)^(1/3) diameters, by the L, I, "
           "S that clast shape --axes fitted prints"),
    CHOICE(params., order, 0, "given|shuffled|descending", "order of placement"),

    NUMBER(params., cone, CLAST_PI / 180.0, 0, CLAST_PI, "rad", "half-angle of the cone of rays",
           .common = true, .group = "growth"),
    COUNT(params., rays, 1, 1, 1e6, "rays tried for each particle (N_r)", .common = true),
    COUNT(params., orientations, 1, 1, 1e6, "orientations tried on each ray (N_o)", .common = true),
    TEXT(params., axis, "random", "axis of the cone: random, or a fixed x,y,z"),
    CHOICE(params., origin, 0, "auto|core|mass|grain|sphere",
           "where rays start: core's centre, centre of mass, a random placed grain or sphere"),
    CHOICE(params., target, 0, "core|mass",
           "the kept trial ends nearest to the core's centre, or to the centre of mass"),
    NUMBER(params., start, 0, 0, 1e6, "-",
           "start, in particle sizes beyond the ray's last hit; 0: from outside of everything"),
    COUNT(params., max_tries, 100, 1, 1e6,
          "new axes tried when every ray misses the aggregate (ballistic: 1000 lines for each)"),
    CHOICE(params., approach, 0, "central|ballistic|diffusive",
           "how particles come: along rays to the origin (published), on lines over the "
           "cross-section, by random walk",
           .common = true),
    NUMBER(params., walk_step, 0.1, 1e-4, 1, "-",
           "diffusive: least step of the walk, in radii of the smallest released particle"),

    CHOICE(params., contact, 0, "exact|spheres|march",
           "first touch of: true surfaces, sphere composites, or the published march",
           .common = true, .group = "contact"),
    CHOICE(params., flavour, 0, "release|figures", "the published engine that march repeats"),
    NUMBER(params., march_coarse, 0, 0, 10, "-",
           "coarse step constant; 0: release 0.05, figures 0.01"),
    NUMBER(params., march_fine, 0.0005, 1e-9, 10, "-", "fine step constant"),
    COUNT(params., march_steps, 1000, 1, 1e9, "steps allowed to each move of the march"),
    COUNT(params., march_vertices, 1000, 2, 1e9, "vertices that the march measures a length from"),

    TEXTS(params., envelope, "surface_hull",
          "envelopes, the first gives d_agg: surface_hull, sphere_hull, sphere_rays, wrap, alpha, "
          "enclosing_sphere, gyration_sphere",
          .group = "envelopes and porosity"),
    COUNT(params., envelope_every, 1, 1, 1e9,
          "particles between two rows of porosity; alpha, wrap: seconds each"),
    {FIELD(BOOL, params., solid_union), 1, 0, 1, "-",
     "measure the volume of the union too, which takes sampling where grains overlap"},
    {FIELD(BOOL, params., fall_speed), 0, 0, 1, "-",
     "settling velocity in each row of porosity too, which takes the extent each time"},
    COUNT(params., envelope_rays, 10000, 10, 1e8, "rays of the published envelope"),
    NUMBER(params., envelope_length, 0, 0, 1e6, "m",
           "radius of the ball of the wrap and alpha envelopes, which need it"),
    CHOICE(params., permeability, 0, "happel|kozeny_carman",
           "permeability by porosity and grain size, for the settling velocity that it allows"),

    NUMBER(params., stop_mass, 0, 0, 1e12, "kg", "stop when the aggregate weighs this; 0: never",
           .group = "when to stop"),
    NUMBER(params., stop_size, 0, 0, 1e6, "m", "stop when d_agg reaches this; 0: never"),
    NUMBER(params., stop_porosity, 0, 0, 1, "-", "stop when the porosity reaches this; 0: never"),

    FLAG(, fit, "find packing and replicate that explain the observed size, density or velocity",
         .group = "fit to an observation"),
    NUMBER(, observed_size, 0, 0, 1e6, "m", "fit: observed D_agg; 0: not observed"),
    NUMBER(, observed_size_error, 0, 0, 1e6, "m", "fit: its standard error"),
    NUMBER(, observed_density, 0, 0, 1e6, "kg/m^3", "fit: observed density; 0: not observed"),
    NUMBER(, observed_density_error, 0, 0, 1e6, "kg/m^3", "fit: its standard error"),
    NUMBER(, observed_velocity, 0, 0, 1e6, "m/s",
           "fit: observed settling velocity; 0: not observed"),
    NUMBER(, observed_velocity_error, 0, 0, 1e6, "m/s", "fit: its standard error"),
    TEXTS(, fit_packing, "", "fit: a packing cone:rays:orientations to try; none: 1 to 64 trials"),
    COUNT(, fit_repeats, 3, 2, 1000, "fit: aggregates grown at each packing and replicate"),
    COUNT(, fit_replicate_max, 32, 1, 1e6, "fit: greatest replicate tried"),

    CHOICE(params., pick, 0, "random|mass|brownian", "cluster mode: how two clusters are chosen",
           .group = "clusters"),
    COUNT(params., n_final, 1, 1, 1e8, "cluster mode: clusters left at the end"),

    COUNT(, repeats, 1, 1, 1e6, "independent aggregates", .group = "repeats and random numbers"),
    NUMBER(, confidence, 0.95, 0.5, 0.9999, "-", "level of the intervals over repeats"),
    {FIELD(U64, params., seed), 1, 0, 1.8446744073709552e19, "-", "seed of every random number",
     .common = true},
    COUNT(, checkpoint_every, 200, 1, 1e9, "particles between two checkpoints", .group = "output"),
    {FIELD(BOOL, , picture), 1, 0, 1, "-", "picture.png in the run folder"},
    FLAG(, printable,
         "printable.3mf, printable.stl (mm): one closed surface around all grains and their necks"),
    NUMBER(, neck, 0, 0, 1e6, "m",
           "printable: thickness of the necks; 0: half the thinnest grain, 3 spacings at least"),
    NUMBER(, spacing, 0, 0, 1e6, "m",
           "printable: spacing of the sampling grid; 0: a quarter neck, coarser where the file "
           "would pass 50 MB"),
    FLAG(, force, "replace an earlier run in the output folder, once the new one has succeeded"),
    TEXT(, resume, "", "run folder to go on with; all other options come from it"),
    {0},
};

clast_status clast_aggregate_params_default(clast_aggregate_params *params)
{
    CLX_ARGUMENTS(params);
    clast_aggregate_config config;
    CLX_GUARD(clast_fields_default(clast_aggregate_fields, &config));
    *params = config.params;
    config.params = (clast_aggregate_params){0};
    clast_fields_free(clast_aggregate_fields, &config);
    return CLAST_OK;
}

void clast_aggregate_params_free(clast_aggregate_params *params)
{
    if (params == NULL) {
        return;
    }
    clast_aggregate_config config = {.params = *params};
    clast_fields_free(clast_aggregate_fields, &config);
    *params = (clast_aggregate_params){0};
}

clast_status clx_numbers_parse(const char *text, int32_t n, double *number)
{
    const char *at = text;
    for (int32_t k = 0; k < n; ++k) {
        char *end = NULL;
        number[k] = clx_number_read(at, &end);
        const char wanted = k + 1 < n ? ',' : '\0';
        if (end == at || *end != wanted || !isfinite(number[k])) {
            return clx_fail(CLAST_E_CONFIG, "'%s' is not %d numbers with commas between", text, n);
        }
        at = end + 1;
    }
    return CLAST_OK;
}

clast_status clx_aggregate_axis(const clast_aggregate_params *params, bool *is_random,
                                double axis[3])
{
    double given[3] = {0.0, 0.0, 0.0};
    *is_random = strcmp(params->axis, "random") == 0;
    if (*is_random) {
        return CLAST_OK;
    }
    if (clx_numbers_parse(params->axis, 3, given) != CLAST_OK || !v3_unit(axis, given)) {
        return clx_fail(CLAST_E_CONFIG,
                        "axis: '%s' is neither 'random' nor three numbers x,y,z that are not all 0",
                        params->axis);
    }
    return CLAST_OK;
}

/// One value, or as many as there are coating shapes.
static clast_status check_count(const char *name, int32_t n, int32_t n_coat)
{
    return n == n_coat
               ? CLAST_OK
               : clx_fail(CLAST_E_CONFIG, "%s: %d given for %d coating shapes", name, n, n_coat);
}

static clast_status check_weights(const clast_f64_list *weight)
{
    double sum = 0.0;
    for (int32_t i = 0; i < weight->n; ++i) {
        sum += weight->item[i];
    }
    return weight->n == 0 || sum > 0.0 ? CLAST_OK
                                       : clx_fail(CLAST_E_CONFIG, "coat_weight: all weights are 0");
}

static clast_status check_classes(const clast_aggregate_params *p, int32_t n_coat)
{
    const clast_f64_list *limit = &p->class_limit;
    if (limit->n > 0 && limit->n != n_coat - 1) {
        return clx_fail(CLAST_E_CONFIG, "class_limit: %d limits for %d coating shapes; give %d",
                        limit->n, n_coat, n_coat - 1);
    }
    if (limit->n > 0 && p->coat_weight.n > 0) {
        return clx_fail(CLAST_E_CONFIG,
                        "class_limit and coat_weight both choose the shape; keep one");
    }
    for (int32_t i = 1; i < limit->n; ++i) {
        if (limit->item[i] <= limit->item[i - 1]) {
            return clx_fail(CLAST_E_CONFIG, "class_limit: limit %d (%s) is not above limit %d (%s)",
                            i + 1, clx_unit_text(limit->item[i], "m"), i,
                            clx_unit_text(limit->item[i - 1], "m"));
        }
    }
    return CLAST_OK;
}

static clast_status check_counts(const clast_aggregate_params *p, int32_t n_coat)
{
    clast_status status = CLAST_OK;
    if (p->coat_weight.n > 0) {
        CLX_TRY(check_count("coat_weight", p->coat_weight.n, n_coat));
    }
    if (p->coat_density.n != 1) {
        CLX_TRY(check_count("coat_density", p->coat_density.n, n_coat));
    }
done:
    return status;
}

static clast_status check_shapes(const clast_aggregate_params *p, const clx_aggregate_given *given)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(given->n_coat >= 1, CLAST_E_CONFIG, "coat: name at least one coating shape");
    CLX_CHECK(p->mode != CLAST_AGGREGATE_CORE || given->core, CLAST_E_CONFIG,
              "core: name the core's shape");
    CLX_TRY(check_counts(p, given->n_coat));
    CLX_TRY(check_weights(&p->coat_weight));
    CLX_TRY(check_classes(p, given->n_coat));
done:
    return status;
}

static clast_status check_list(const clast_aggregate_params *p, bool has_sizes)
{
    if (!has_sizes) {
        return clx_fail(CLAST_E_CONFIG, "sizes: give a file of sizes, sizes, or a size_law");
    }
    if (p->size_draw && p->n_particle == 0) {
        return clx_fail(CLAST_E_CONFIG, "size_draw: say how many with n_particle");
    }
    return CLAST_OK;
}

static clast_status need(const char *name, double value)
{
    return value > 0.0 ? CLAST_OK
                       : clx_fail(CLAST_E_CONFIG, "%s: this size_law needs a value above 0", name);
}

/// What the chosen law is made of.
static clast_status check_moments(const clast_aggregate_params *p)
{
    clast_status status = CLAST_OK;
    const int32_t law = p->size_law;
    if (law == CLAST_SIZE_UNIFORM || law == CLAST_SIZE_LOGUNIFORM) {
        CLX_TRY(need("size_low", p->size_low));
        return need("size_high", p->size_high);
    }
    CLX_TRY(need("size_mean", p->size_mean));
    return law == CLAST_SIZE_NORMAL ? need("size_deviation", p->size_deviation)
                                    : need("size_shape", p->size_shape);
done:
    return status;
}

static clast_status check_law(const clast_aggregate_params *p, bool has_sizes)
{
    if (has_sizes) {
        return clx_fail(CLAST_E_CONFIG,
                        "size_law draws the sizes; drop sizes, or set size_law: list");
    }
    if (p->size_high != 0.0 && p->size_high < p->size_low) {
        return clx_fail(CLAST_E_CONFIG, "size_high: %s is below size_low, %s",
                        clx_unit_text(p->size_high, "m"), clx_unit_text(p->size_low, "m"));
    }
    const clast_status status = need("n_particle", p->n_particle);
    return status != CLAST_OK ? status : check_moments(p);
}

/// What an approach does not ask must stand at its default, so that no option is passed over.
static clast_status check_approach(const clast_aggregate_params *p)
{
    clast_status status = CLAST_OK;
    const bool walks = p->approach == CLAST_APPROACH_DIFFUSIVE;
    const char *name = walks ? "diffusive" : "ballistic";
    if (p->approach == CLAST_APPROACH_CENTRAL) {
        return CLAST_OK;
    }
    CLX_CHECK(p->contact != CLAST_CONTACT_MARCH, CLAST_E_CONFIG,
              "approach: the published march is central only; use contact: exact or spheres");
    CLX_CHECK(p->origin == CLAST_ORIGIN_AUTO && p->start == 0.0, CLAST_E_CONFIG,
              "approach: %s comes from outside of everything and aims at no origin; leave out "
              "origin and start",
              name);
    CLX_CHECK(!walks || (p->rays == 1 && p->orientations == 1 && strcmp(p->axis, "random") == 0 &&
                         p->cone == CLAST_PI / 180.0 && p->target == CLAST_TARGET_CORE),
              CLAST_E_CONFIG,
              "approach: diffusive makes one walk a particle; leave out rays, orientations, cone, "
              "axis and target");
done:
    return status;
}

static clast_status check_search(const clast_aggregate_params *p)
{
    clast_status status = CLAST_OK;
    bool is_random = false;
    double axis[3];
    CLX_TRY(clx_aggregate_axis(p, &is_random, axis));
    CLX_TRY(check_approach(p));
    CLX_CHECK((int64_t)p->rays * p->orientations <= 100000000, CLAST_E_CONFIG,
              "rays x orientations: %d x %d trials for each particle are more than 1e8", p->rays,
              p->orientations);
    CLX_CHECK(p->origin != CLAST_ORIGIN_SPHERE || p->contact != CLAST_CONTACT_EXACT, CLAST_E_CONFIG,
              "origin: sphere needs sphere composites; use grain, or contact: spheres");
    CLX_CHECK(p->mode == CLAST_AGGREGATE_CORE || p->contact != CLAST_CONTACT_MARCH, CLAST_E_CONFIG,
              "mode: the published march has no cluster mode; use contact: exact or spheres");
    CLX_CHECK(p->envelope.n >= 1, CLAST_E_CONFIG, "envelope: name at least one");
done:
    return status;
}

clast_status clx_aggregate_params_check(const clast_aggregate_params *params,
                                        const clx_aggregate_given *given)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_fields_check_part(clast_aggregate_fields, 0, sizeof *params, params));
    CLX_TRY(check_shapes(params, given));
    CLX_TRY(params->size_law == CLAST_SIZE_LIST ? check_list(params, given->sizes)
                                                : check_law(params, given->sizes));
    CLX_TRY(check_search(params));
done:
    return status;
}

clast_status clast_aggregate_config_check(const clast_aggregate_config *config)
{
    CLX_ARGUMENTS(config);
    CLX_GUARD(clast_fields_check(clast_aggregate_fields, config));
    clast_status status = CLAST_OK;
    const clx_aggregate_given given = {.core = config->core[0] != '\0',
                                       .n_coat = config->coat.n,
                                       .sizes =
                                           config->sizes[0] != '\0' || config->params.size.n > 0};
    CLX_TRY(clx_aggregate_params_check(&config->params, &given));
    if (config->coat_spheres.n > 0) {
        CLX_TRY(check_count("coat_spheres", config->coat_spheres.n, given.n_coat));
    }
    CLX_CHECK(config->sizes[0] == '\0' || config->params.size.n == 0, CLAST_E_CONFIG,
              "sizes and size both give sizes; keep one");
    CLX_CHECK(!config->fit || config->params.approach != CLAST_APPROACH_DIFFUSIVE, CLAST_E_CONFIG,
              "approach: diffusive has no packing to find; leave out fit");
done:
    return status;
}

clast_status clx_aggregate_check_printable(const clast_aggregate_config *config)
{
    clast_status status = CLAST_OK;
    const double neck = config->neck;
    const double spacing = config->spacing;
    const bool is_cluster = config->params.mode == CLAST_AGGREGATE_CLUSTER;
    if (!config->printable) {
        return CLAST_OK;
    }
    CLX_CHECK(
        !is_cluster || config->params.n_final == 1, CLAST_E_CONFIG,
        "printable: one body, and n_final leaves %d clusters apart; leave out n_final or printable",
        config->params.n_final);
    CLX_CHECK(!(neck > 0.0 && spacing > 0.0 && neck < 2.0 * spacing), CLAST_E_CONFIG,
              "neck: %s is below two spacings of %s, which do not show it; give a spacing of a "
              "third of the neck (%s), or a neck of three spacings (%s)",
              clx_unit_text(neck, "m"), clx_unit_text(spacing, "m"), clx_unit_text(neck / 3.0, "m"),
              clx_unit_text(3.0 * spacing, "m"));
done:
    return status;
}
