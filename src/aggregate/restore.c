// An aggregate from what an earlier run had placed: the grains are entered again in their order, so
// that scene, sums and envelopes come out the same to the last bit.
#include "aggregate/state.h"

#include "assembly/whole.h"
#include "base/alloc.h"
#include <math.h>
#include <string.h>

static clast_status check_shapes(const clast_aggregate *a, const clast_assembly *placed)
{
    bool same = placed->n_shape == a->assembly.n_shape;
    for (int32_t i = 0; i < placed->n_shape && same; ++i) {
        const clast_shape *x = &placed->shape[i];
        const clast_shape *y = &a->assembly.shape[i];
        same = strcmp(x->name, y->name) == 0 && x->kind == y->kind && x->volume == y->volume &&
               x->length == y->length && x->spheres.n == y->spheres.n &&
               x->mesh.n_tri == y->mesh.n_tri;
    }
    return same ? CLAST_OK
                : clx_fail(CLAST_E_FORMAT,
                           "the saved grains have other shapes than the configuration names");
}

/// What a number of the saved run and its twin of these parameters may differ by, relative:
/// libraries of mathematics round differently. Other seeds and laws are far beyond.
static const double SAME = 1e-6;

static bool is_same(double x, double y)
{
    return x == y || (isnan(x) && isnan(y)) || fabs(x - y) <= SAME * fmax(fabs(x), fabs(y));
}

static double history_at(const clast_aggregate *a, int64_t row, int32_t column)
{
    CLAST_ASSERT(row >= 0 && row < a->history.n_row && column < a->history.n_column);
    return a->history.value[row * a->history.n_column + column];
}

static clast_status check_repeat(const clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    for (int64_t r = 0; r < a->history.n_row; ++r) {
        CLX_CHECK(history_at(a, r, CLX_HISTORY_REPEAT) == a->repeat, CLAST_E_FORMAT,
                  "row %lld of the saved history is of repeat %g, not of repeat %d", (long long)r,
                  history_at(a, r, CLX_HISTORY_REPEAT), a->repeat);
    }
done:
    return status;
}

/// Whether the grains from *grain on are those of a particle; *grain goes on to the next one's.
static bool has_grains(const clast_aggregate *a, int32_t particle, int32_t *grain)
{
    const clast_assembly *all = &a->assembly;
    const int32_t shape = clx_aggregate_shape(a, particle);
    const clx_template *group = &a->templates.group[1 + shape];
    const double scale = clx_aggregate_scale(a, particle, shape);
    static const double at[4] = {1.0, 0.0, 0.0, 0.0}; // anywhere: sizes alone are looked at
    bool is = group->n_part <= all->n_grain - *grain;
    for (int32_t k = 0; k < group->n_part && is; ++k, ++*grain) {
        clx_template_part part;
        clx_template_pose(group, k, at, at, scale, &part);
        is = all->shape_id[*grain] == a->shape_id[part.shape] &&
             is_same(all->scale[*grain], part.scale) && is_same(all->density[*grain], part.density);
    }
    return is;
}

/// Whether the last row is of the grains that are placed.
static bool has_sums(const clast_aggregate *a)
{
    const int64_t last = a->history.n_row - 1;
    return is_same(history_at(a, last, CLX_HISTORY_MASS), a->mass) &&
           is_same(history_at(a, last, CLX_HISTORY_GYRATION), clx_aggregate_gyration(a));
}

/// Shapes and sizes of the placed particles are those that these parameters draw. The march, which
/// scales by sampled lengths, has its sizes in the history.
static clast_status check_particles(const clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    const bool is_core = a->mode->is_one_body;
    const bool is_march = a->params->contact == CLAST_CONTACT_MARCH;
    const int32_t n = is_core ? a->n_placed : a->n_particle;
    int32_t grain = a->n_core;
    for (int32_t i = 0; i < n; ++i) {
        CLX_CHECK((is_march || has_grains(a, i, &grain)) &&
                      (!is_core || is_same(history_at(a, i + 1LL, CLX_HISTORY_SIZE), a->size[i])),
                  CLAST_E_FORMAT,
                  "the saved particle %d is not the one that the configuration draws, of %s: was "
                  "it another seed, list or law of sizes?",
                  i + 1, clx_unit_text(a->size[i], "m"));
    }
    CLX_CHECK(is_march || grain == a->assembly.n_grain, CLAST_E_FORMAT,
              "the saved run has %d grains, %d particles make %d", a->assembly.n_grain, n, grain);
    CLX_CHECK(!is_core || has_sums(a), CLAST_E_FORMAT,
              "the last row of the saved history is not of the saved grains, which weigh %s",
              clx_unit_text(a->mass, "kg"));
done:
    return status;
}

/// The first step made anew has the rows that were saved: with sizes that are all equal, nothing
/// else tells of another seed.
static clast_status check_first_step(const clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    clast_aggregate *anew = NULL;
    CLX_TRY(clast_aggregate_create(a->params, a->input, a->repeat, &anew));
    if (a->n_placed > 0) {
        const clast_status grown = clast_aggregate_grow(anew, 1, NULL);
        CLX_CHECK(grown != CLAST_E_CONVERGE, CLAST_E_FORMAT,
                  "the saved run has placed what cannot be placed with this configuration");
        CLX_TRY(grown);
    }
    for (int64_t r = 0; r < anew->history.n_row && r < a->history.n_row; ++r) {
        for (int32_t c = 0; c < CLX_HISTORY_FIXED; ++c) {
            CLX_CHECK(c == CLX_HISTORY_OVERLAP || // of rounding
                          is_same(history_at(anew, r, c), history_at(a, r, c)),
                      CLAST_E_FORMAT,
                      "row %lld of the saved history has %s %g, the configuration gives %g: was it "
                      "another seed, core or way to grow?",
                      (long long)r, a->history.name[c], history_at(a, r, c),
                      history_at(anew, r, c));
        }
    }
done:
    clast_aggregate_destroy(anew);
    return status;
}

clast_status clast_aggregate_restore(const clast_aggregate_params *params,
                                     const clast_aggregate_input *input,
                                     const clast_aggregate_saved *saved,
                                     clast_aggregate **aggregate)
{
    CLX_ARGUMENTS(params, input, saved, aggregate);
    CLX_WHOLE(assembly, saved->placed);
    CLX_WHOLE(table, saved->history);
    clast_status status = CLAST_OK;
    clast_aggregate *a = NULL;
    CLX_TRY(clx_alloc(&a, 1, sizeof *a));
    CLX_TRY(clx_aggregate_begin(params, input, saved->repeat, a));
    CLX_TRY(check_shapes(a, saved->placed));
    CLX_TRY(clx_history_read(&a->history, saved->history));
    CLX_TRY(check_repeat(a));
    CLX_TRY(a->mode->restore(a, saved));
    CLX_TRY(check_particles(a));
    CLX_TRY(check_first_step(a));
    a->stop = clx_aggregate_stop_now(a);
    *aggregate = a;
    a = NULL;
done:
    clast_aggregate_destroy(a);
    return status;
}
