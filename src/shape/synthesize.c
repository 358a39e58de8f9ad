// Synthetic grains: random bodies, their hulls, a wanted form exactly and a wanted roughness by
// search.                                                          [docs/theory/synthetic.md]
//
// The random field is evaluated once a grain; only the amplitude changes in the search. Roughness
// is measured on the finished mesh (hull, simplified, stretched), so what is matched is what the
// user gets. Simplifying makes the measure jump by little as the amplitude moves, hence bisection
// with a stated tolerance instead of a faster root finder.
#include <clast/harmonics.h>

#include "base/alloc.h"
#include "base/field.h"
#include "math/vec3.h"
#include "shape/random_field.h"
#include <clast/form.h>
#include <clast/grain.h>
#include <clast/mesh.h>
#include <stddef.h>

enum { LEAST_DEGREE = 3, N_HALVING = 40 }; // degree 1 moves a body, degree 2 is its form
#define AMPLITUDE_FIRST 0.01
#define AMPLITUDE_MAX   1.0

#define FIELD(name)     #name, .offset = offsetof(clast_synthesize_config, name)
#define FORM(key, name) key, .offset = offsetof(clast_synthesize_config, form.name)
const clast_field clast_synthesize_fields[] = {
    {FORM("flatness", flatness_mean), CLAST_FIELD_F64, 0.647, 1e-3, 1.0, "-",
     "S/I of the mass-equivalent ellipsoid, the mean when a deviation is given", NULL,
     .group = "form", .common = true},
    {FORM("flatness_deviation", flatness_deviation), CLAST_FIELD_F64, 0.0, 0.0, 10.0, "-",
     "of a normal law cut to form_low .. form_high", NULL, .common = true},
    {FORM("elongation", elongation_mean), CLAST_FIELD_F64, 0.682, 1e-3, 1.0, "-", "I/L, likewise",
     NULL, .common = true},
    {FORM("elongation_deviation", elongation_deviation), CLAST_FIELD_F64, 0.0, 0.0, 10.0, "-",
     "likewise", NULL, .common = true},
    {FORM("form_low", low), CLAST_FIELD_F64, 0.1, 1e-3, 1.0, "-", "least flatness and elongation",
     NULL},
    {FORM("form_high", high), CLAST_FIELD_F64, 1.0, 1e-3, 1.0, "-", "greatest", NULL},
    {FIELD(size), CLAST_FIELD_F64, 1.0, 1e-12, 1e12, "-",
     "sieve size D = sqrt((S^2+I^2)/2), in the unit of the file", .common = true, .group = "size"},
    {FIELD(measure), CLAST_FIELD_CHOICE, CLAST_ROUGH_ANGULARITY, 0, 2, "-",
     "what `rough` is: the amplitude of ln r, or the finished grain's measured normal roundness or "
     "angularity",
     "amplitude|normal_roundness|angularity", .common = true, .group = "roughness"},
    {FIELD(rough), CLAST_FIELD_F64, 0.075, 0.0, 1.0, "-", "wanted roughness", .common = true},
    {FIELD(tolerance), CLAST_FIELD_F64, 1e-3, 1e-6, 1.0, "-", "of the measured one"},
    {FIELD(decay), CLAST_FIELD_F64, 3.0, 0.0, 10.0, "-",
     "coefficients of degree n fall as n^-decay: larger is smoother"},
    {FIELD(degrees), CLAST_FIELD_I32, 12, LEAST_DEGREE, CLX_FIELD_DEGREES, "-",
     "greatest degree of the spherical harmonics"},
    {FIELD(faces), CLAST_FIELD_I32, 300, 8, 100000, "-", "at most so many triangles",
     .common = true},
    {FIELD(seed), CLAST_FIELD_U64, 1, 0, 1.8446744073709552e19, "-", "seed of form and roughness",
     .common = true},
    {0}};
#undef FIELD
#undef FORM

const clast_idle *clast_synthesize_idle(const clast_synthesize_config *c,
                                        clast_idle rules[CLAST_N_IDLE])
{
    if (c == NULL || rules == NULL) {
        return NULL;
    }
    const bool is_amplitude = c->measure == CLAST_ROUGH_AMPLITUDE;
    const clast_idle made[CLAST_N_IDLE] = {
        {is_amplitude, "tolerance", "with --measure amplitude, which is met as it is"},
        {is_amplitude && c->rough == 0.0, "decay", "with --rough 0"}};
    return clx_idle_copy(made, rules);
}

/// A grain being made.
typedef struct {
    const clast_synthesize_config *config;
    clast_mesh ball; ///< directions
    double *field;   ///< [n_vert] of g
    double lis[3];
    clast_mesh grain; ///< the last one tried
    clast_grain measured;
} maker;

static void free_maker(maker *m)
{
    clast_mesh_free(&m->ball);
    clast_mesh_free(&m->grain);
    clx_free(m->field);
}

/// Enough directions for twice the faces wanted, so that the hull is not short of vertices, and for
/// three to each coefficient of the field.
static int ball_level(const clast_synthesize_config *c)
{
    const int32_t field = 3 * (c->degrees + 1) * (c->degrees + 1);
    const int32_t need = 2 * c->faces > field ? 2 * c->faces : field;
    int level = 2;
    while (level < 8 && 10 * (1 << 2 * level) + 2 < need) {
        ++level;
    }
    return level;
}

static clast_status begin(const clast_synthesize_config *config, uint64_t index, maker *m)
{
    clast_status status = CLAST_OK;
    clx_random_field field = {0};
    const double one[3] = {1.0, 1.0, 1.0};
    CLX_TRY(clx_random_field_make(LEAST_DEGREE, config->degrees, config->decay, config->seed, index,
                                  &field));
    CLX_TRY(clast_mesh_ellipsoid(one, ball_level(config), &m->ball));
    CLX_TRY(clx_alloc(&m->field, m->ball.n_vert, sizeof *m->field));
    for (int32_t v = 0; v < m->ball.n_vert; ++v) {
        m->field[v] = clx_random_field_at(&field, m->ball.vert[v]);
    }
done:
    clx_random_field_free(&field);
    return status;
}

/// The grain of this amplitude, measured.
static clast_status make_grain(maker *m, double amplitude)
{
    clast_status status = CLAST_OK;
    clast_mesh body = {0};
    clast_mesh hull = {0};
    clast_mesh_free(&m->grain);
    CLX_TRY(clast_mesh_copy(&m->ball, &body));
    for (int32_t v = 0; v < body.n_vert; ++v) {
        v3_scale(body.vert[v], exp(amplitude * m->field[v]), body.vert[v]);
    }
    CLX_TRY(clast_reform_hull(&body, m->config->faces, &hull));
    CLX_TRY(clast_reform_mesh(&hull, m->lis, &m->grain));
    CLX_TRY(clast_grain_measure(&m->grain, &m->measured));
done:
    clast_mesh_free(&body);
    clast_mesh_free(&hull);
    return status;
}

/// How rough the last grain is in the measure asked for; grows with the amplitude.
static double roughness(const maker *m)
{
    return m->config->measure == CLAST_ROUGH_ROUNDNESS ? -m->measured.normal_roundness
                                                       : m->measured.angularity;
}

static double shown(const maker *m, double rough)
{
    return m->config->measure == CLAST_ROUGH_ROUNDNESS ? -rough : rough;
}

/// Doubles the amplitude from smooth until the grain is rough enough.
static clast_status bracket(maker *m, double wanted, double *low, double *high)
{
    clast_status status = CLAST_OK;
    *low = 0.0;
    *high = 0.0;
    CLX_TRY(make_grain(m, 0.0));
    const double smoothest = roughness(m);
    double now = smoothest;
    double roughest = smoothest;
    CLX_CHECK(smoothest <= wanted + m->config->tolerance, CLAST_E_CONVERGE,
              "grain of flatness %.4g and elongation %.4g: %.5g is smoother than its ellipsoid of "
              "%d faces, %.5g",
              m->lis[2] / m->lis[1], m->lis[1] / m->lis[0], shown(m, wanted), m->grain.n_tri,
              shown(m, smoothest));
    while (now < wanted && *high < AMPLITUDE_MAX) {
        *low = *high;
        *high = fmin(fmax(2.0 * *high, AMPLITUDE_FIRST), AMPLITUDE_MAX);
        CLX_TRY(make_grain(m, *high));
        now = roughness(m);
        roughest = fmax(roughest, now);
    }
    CLX_CHECK(now >= wanted, CLAST_E_CONVERGE,
              "grain of flatness %.4g and elongation %.4g: %.5g is rougher than a hull of this "
              "seed can be, %.5g",
              m->lis[2] / m->lis[1], m->lis[1] / m->lis[0], shown(m, wanted), shown(m, roughest));
done:
    return status;
}

static clast_status search(maker *m, double *amplitude)
{
    clast_status status = CLAST_OK;
    const double rough = m->config->rough;
    const double wanted = m->config->measure == CLAST_ROUGH_ROUNDNESS ? -rough : rough;
    double low = 0.0;
    double high = 0.0;
    CLX_TRY(bracket(m, wanted, &low, &high));
    *amplitude = high;
    for (int i = 0; i < N_HALVING && fabs(roughness(m) - wanted) > m->config->tolerance; ++i) {
        *amplitude = 0.5 * (low + high);
        CLX_TRY(make_grain(m, *amplitude));
        *(roughness(m) < wanted ? &low : &high) = *amplitude;
    }
    CLX_CHECK(fabs(roughness(m) - wanted) <= m->config->tolerance, CLAST_E_CONVERGE,
              "roughness jumps over %.6g near amplitude %.6g; take another seed or a tolerance "
              "above %.2g",
              rough, *amplitude, m->config->tolerance);
done:
    return status;
}

clast_status clast_synthesize_grain(const clast_synthesize_config *config, uint64_t index,
                                    clast_mesh *mesh, clast_synthesize_report *report)
{
    clast_status status = CLAST_OK;
    maker m = {.config = config};
    clast_synthesize_report r = {0};
    CLX_NEED(config);
    CLX_NEED(mesh);
    CLX_NEED(report);
    CLX_TRY(clast_fields_check(clast_synthesize_fields, config));
    r.amplitude = config->rough;
    CLX_TRY(clast_form_law_check(&config->form));
    clast_form_law_draw(&config->form, config->seed, index, &r.flatness, &r.elongation);
    clast_form_lengths(r.flatness, r.elongation, config->size, m.lis);
    CLX_TRY(begin(config, index, &m));
    CLX_TRY(config->measure == CLAST_ROUGH_AMPLITUDE ? make_grain(&m, config->rough)
                                                     : search(&m, &r.amplitude));
    r.normal_roundness = m.measured.normal_roundness;
    r.angularity = m.measured.angularity;
    r.volume = m.measured.volume;
    r.n_triangle = m.grain.n_tri;
    *report = r;
    *mesh = m.grain;
    m.grain = (clast_mesh){0};
done:
    free_maker(&m);
    return status;
}
