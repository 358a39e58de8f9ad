// Which density a grain has: by shape, by chance, by its class of the sieve curve, or by its row of
// the list of sizes.
#include "math/rng.h"
#include "pack/pack.h"
#include "pack/start.h"
#include "shape/curve.h"
#include <clast/shape.h>
#include <math.h>

/// Of grains that are given none: quartz [kg/m^3].
static double usual[1] = {2650.0};

void clx_pack_set_density(clast_pack_config *config)
{
    if (config->density.n == 0) {
        config->density = (clast_f64_list){1, usual};
    }
}

/// The configured one, or that of the shape's own parts.
static double of_shape(const clast_pack *p, int32_t shape)
{
    CLAST_ASSERT(shape >= 0 && shape < p->input.n_shape);
    const clast_f64_list *d = &p->config.density;
    const double density = d->item[d->n > 1 ? shape : 0];
    return density > 0.0 ? density : p->input.shape[shape].own.density;
}

/// The second number of the stream that the shape is drawn from.
static double by_chance(const clast_pack *p, int64_t index)
{
    CLAST_ASSERT(index >= 0);
    const clast_f64_list *d = &p->config.density;
    const clast_f64_list *w = &p->config.density_weight;
    clx_rng rng = clx_rng_at(p->config.seed, CLX_STREAM_PACK_SHAPE, (uint64_t)index);
    (void)clx_rng_uniform(&rng);
    const double u = clx_rng_uniform(&rng);
    double sum = 0.0;
    double to = 0.0;
    int32_t k = 0;
    for (int32_t i = 0; i < d->n; ++i) {
        sum += w->n > 0 ? w->item[i] : 1.0;
    }
    for (to = w->n > 0 ? w->item[0] : 1.0; k < d->n - 1 && u * sum > to; ++k) {
        to += w->n > 0 ? w->item[k + 1] : 1.0;
    }
    return d->item[k];
}

static double of_class(const clast_pack *p, double size)
{
    const clast_curve *curve = p->input.curve;
    int32_t k = 0;
    while (k < curve->n_class - 1 && size >= curve->sieve[k + 1]) {
        ++k;
    }
    return p->config.density.item[k];
}

double clx_pack_density(const clast_pack *p, int64_t index, int32_t shape, double size)
{
    switch (p->config.density_of) {
    case CLAST_PACK_DENSITY_CHANCE:
        return by_chance(p, index);
    case CLAST_PACK_DENSITY_CLASS:
        return of_class(p, size);
    case CLAST_PACK_DENSITY_LIST:
        return clx_grading_draw_density(p->input.grading, p->config.seed, (uint64_t)index);
    default:
        return of_shape(p, shape);
    }
}

void clx_pack_densities(const clast_pack *p, double *low, double *high)
{
    const clast_f64_list *d = &p->config.density;
    const bool by_shape = p->config.density_of == CLAST_PACK_DENSITY_SHAPE;
    const int32_t n = by_shape ? p->input.n_shape : d->n;
    if (p->input.start != NULL) {
        clx_pack_start_densities(p, low, high);
        return;
    }
    if (p->config.density_of == CLAST_PACK_DENSITY_LIST) {
        clx_grading_densities(p->input.grading, low, high);
        return;
    }
    *low = INFINITY;
    *high = 0.0;
    for (int32_t i = 0; i < n; ++i) {
        const double density = by_shape ? of_shape(p, i) : d->item[i];
        *low = fmin(*low, density);
        *high = fmax(*high, density);
    }
}

void clx_pack_own_density(const clast_pack *p, double *own, double *given)
{
    const clast_f64_list *d = &p->config.density;
    const bool by_shape = p->config.density_of == CLAST_PACK_DENSITY_SHAPE;
    *own = *given = 0.0;
    for (int32_t i = 0; p->input.start == NULL && by_shape && i < p->input.n_shape; ++i) {
        const double its = p->input.shape[i].own.density;
        const double made = d->item[d->n > 1 ? i : 0];
        if (*own == 0.0 && its > 0.0 && made > 0.0 && fabs(made / its - 1.0) > 1e-6) {
            *own = its;
            *given = made;
        }
    }
}

static clast_status check_shapes(const clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_f64_list *d = &p->config.density;
    const bool by_shape = p->config.density_of == CLAST_PACK_DENSITY_SHAPE;
    CLX_CHECK(!by_shape || d->n == 1 || d->n == p->input.n_shape, CLAST_E_CONFIG,
              "%d densities for %d shapes (density); to draw from them, or to give one for each "
              "class of the curve, see density_of",
              d->n, p->input.n_shape);
    for (int32_t i = 0; i < p->input.n_shape; ++i) {
        const clast_shape *shape = &p->input.shape[i];
        const double given = by_shape ? d->item[d->n > 1 ? i : 0] : 1.0;
        CLX_CHECK(given > 0.0 || shape->own.density > 0.0, CLAST_E_CONFIG,
                  "shape %s has no density of its own (density 0); only an aggregate's state.h5 "
                  "has",
                  shape->name);
        CLX_CHECK(!shape->own.is_mixed || given == 0.0, CLAST_E_CONFIG,
                  "aggregate %s has parts of several densities, %g kg/m^3 in the mean: give it "
                  "density 0 to keep them (density, one for each shape)",
                  shape->name, shape->own.density);
    }
done:
    return status;
}

static clast_status check_chances(const clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_f64_list *d = &p->config.density;
    const clast_f64_list *w = &p->config.density_weight;
    double sum = 0.0;
    CLX_CHECK(w->n == 0 || w->n == d->n, CLAST_E_CONFIG,
              "%d weights for %d densities (density_weight)", w->n, d->n);
    for (int32_t i = 0; i < w->n; ++i) {
        sum += w->item[i];
    }
    CLX_CHECK(w->n == 0 || (sum > 0.0 && isfinite(sum)), CLAST_E_CONFIG,
              "the weights of densities sum to %g (density_weight)", sum);
done:
    return status;
}

clast_status clx_pack_check_densities(const clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_f64_list *d = &p->config.density;
    const int32_t of = p->config.density_of;
    double low = 0.0;
    double high = 0.0;
    CLX_CHECK(d->n > 0, CLAST_E_CONFIG, "a packing needs a density (density)");
    CLX_TRY(check_shapes(p));
    CLX_TRY(check_chances(p));
    if (of == CLAST_PACK_DENSITY_CLASS) {
        CLX_CHECK(p->input.curve != NULL, CLAST_E_CONFIG,
                  "density_of class needs a sieve curve (curve); this one has no classes");
        CLX_CHECK(d->n == p->input.curve->n_class, CLAST_E_CONFIG,
                  "%d densities for %d classes of the curve (density, density_of class)", d->n,
                  p->input.curve->n_class);
    }
    clx_pack_densities(p, &low, &high);
    CLX_CHECK(of != CLAST_PACK_DENSITY_LIST || low > 0.0, CLAST_E_CONFIG,
              "density_of list needs list:FILE or masses:FILE with a column density (curve)");
    CLX_CHECK(low > 0.0, CLAST_E_CONFIG, "a density of 0 (density) is for density_of shape alone");
done:
    return status;
}
