// Additive recurrences of the plastic-number family (Roberts 2018), shifted for each pixel by a
// dither square made from the seed, so a pixel's samples depend on nothing but its place.
#include "render/samples.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "math/vec3.h"

enum { N_PLACE = CLX_DITHER * CLX_DITHER, BLOCK = 64 };
/// Pixels for each place in the square from which on samples are kept, and bytes of all.
static const int64_t LEAST_PIXELS = 16 * (int64_t)N_PLACE;
static const int64_t MOST_BYTES = 16 << 20;

/// Powers of 1 / (real root of x^5 = x + 1): the four-dimensional recurrence.
static const double step4[4] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
                                0.5385972572236101};
/// Powers of 1 / plastic number (x^3 = x + 1): the two-dimensional one.
static const double step2[2] = {0.7548776662466927, 0.5698402909980532};

static double fraction(double x)
{
    return x - floor(x);
}

/// Offset in [-1, 1] with the density of a tent: soft edges without a blur.
static double tent(double u)
{
    CLAST_ASSERT(u >= 0.0 && u <= 1.0);
    return u < 0.5 ? sqrt(2.0 * u) - 1.0 : 1.0 - sqrt(2.0 - 2.0 * u);
}

/// Direction to a point of the sun's disc; u, v in [0, 1).
static void sun_direction(const clx_samples *s, double u, double v, double direction[3])
{
    const double r = s->sun_tangent * sqrt(u);
    const double angle = 2.0 * CLAST_PI * v;
    v3_axpy(direction, s->sun, r * cos(angle), s->sun_a);
    v3_axpy(direction, direction, r * sin(angle), s->sun_b);
    (void)v3_unit(direction, direction);
}

static clx_sample sample_of(const clx_samples *s, int32_t x, int32_t y, int32_t number)
{
    clx_sample sample;
    double u[4]; // 0 and 1: place in the pixel; 2 and 3: on the sun's disc
    for (int k = 0; k < 4; ++k) {
        u[k] = fraction(clx_dither_at(&s->dither, x, y, k) + (number + 1) * step4[k]);
    }
    sample.offset[0] = 0.75 * tent(u[0]);
    sample.offset[1] = 0.75 * tent(u[1]);
    sun_direction(s, u[2], u[3], sample.sun);
    return sample;
}

/// With density cosine / pi.
static clx_sky_ray sky_ray_of(const clx_samples *s, int32_t x, int32_t y, int32_t number, int32_t i)
{
    const double index = 1.0 + (double)number * s->n_sky + i;
    const double u = fraction(clx_dither_at(&s->dither, x, y, 4) + index * step2[0]);
    const double v = fraction(clx_dither_at(&s->dither, x, y, 5) + index * step2[1]);
    const double r = sqrt(u);
    const double angle = 2.0 * CLAST_PI * v;
    return (clx_sky_ray){sqrt(1.0 - u), {r * cos(angle), r * sin(angle)}};
}

static ptrdiff_t place_of(int32_t x, int32_t y)
{
    return (ptrdiff_t)(y % CLX_DITHER) * CLX_DITHER + x % CLX_DITHER;
}

static void fill(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clx_samples *s = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const int32_t x = (int32_t)(i % CLX_DITHER);
        const int32_t y = (int32_t)(i / CLX_DITHER);
        for (int32_t n = 0; n < s->n; ++n) {
            s->kept[i * s->n + n] = sample_of(s, x, y, n);
            for (int32_t k = 0; k < s->n_sky; ++k) {
                s->kept_sky[(i * s->n + n) * s->n_sky + k] = sky_ray_of(s, x, y, n, k);
            }
        }
    }
}

clast_status clx_samples_allocate(clx_samples *samples, int64_t n_pixel)
{
    clast_status status = CLAST_OK;
    const int64_t bytes =
        N_PLACE * (int64_t)samples->n *
        ((int64_t)sizeof(clx_sample) + samples->n_sky * (int64_t)sizeof(clx_sky_ray));
    CLAST_ASSERT(samples->kept == NULL && samples->n > 0 && samples->n_sky > 0);
    if (n_pixel >= LEAST_PIXELS && bytes <= MOST_BYTES) {
        const int64_t n = N_PLACE * (int64_t)samples->n;
        CLX_TRY(clx_alloc(&samples->kept, n, sizeof *samples->kept));
        CLX_TRY(clx_alloc(&samples->kept_sky, n * samples->n_sky, sizeof *samples->kept_sky));
        clx_parallel_for(N_PLACE, BLOCK, fill, samples);
    }
done:
    return status;
}

void clx_samples_free(clx_samples *samples)
{
    CLX_FREE(samples->kept, samples->kept_sky);
    samples->kept = NULL;
    samples->kept_sky = NULL;
}

clx_sample clx_sample_at(const clx_samples *samples, int32_t x, int32_t y, int32_t number)
{
    CLAST_ASSERT(x >= 0 && y >= 0 && number >= 0 && number < samples->n);
    return samples->kept != NULL ? samples->kept[place_of(x, y) * samples->n + number]
                                 : sample_of(samples, x, y, number);
}

clx_sky_ray clx_sky_ray_at(const clx_samples *samples, int32_t x, int32_t y, int32_t number,
                           int32_t i)
{
    CLAST_ASSERT(x >= 0 && y >= 0 && i >= 0 && i < samples->n_sky);
    return samples->kept_sky != NULL
               ? samples->kept_sky[(place_of(x, y) * samples->n + number) * samples->n_sky + i]
               : sky_ray_of(samples, x, y, number, i);
}
