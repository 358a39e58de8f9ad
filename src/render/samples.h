#pragma once
// Where a pixel's camera rays go, and those to sun and sky from what they meet.
#include "base/status.h"
#include "render/dither.h"

typedef struct clx_sample {
    double offset[2]; ///< from the pixel's middle
    double sun[3];    ///< unit vector to a point of the sun's disc
} clx_sample;

/// Direction about a unit normal: its parts along the normal and two vectors across it.
typedef struct clx_sky_ray {
    double up, across[2];
} clx_sky_ray;

typedef struct clx_samples {
    int32_t n;     ///< of a pixel
    int32_t n_sky; ///< sky rays of a sample
    double sun[3]; ///< unit vector to the middle of the sun's disc
    double sun_a[3], sun_b[3];
    double sun_tangent; ///< radius of the disc at distance 1
    clx_dither dither;  ///< shifts of the pixels' samples
    // Pixels a dither square apart have the same: kept for pictures of many squares, else NULL.
    clx_sample *kept;      ///< [CLX_DITHER][CLX_DITHER][n]
    clx_sky_ray *kept_sky; ///< [CLX_DITHER][CLX_DITHER][n][n_sky]
} clx_samples;

/// Fills what is kept for a picture of so many pixels; the other members are set.
clast_status clx_samples_allocate(clx_samples *samples, int64_t n_pixel);
void clx_samples_free(clx_samples *samples);

clx_sample clx_sample_at(const clx_samples *samples, int32_t x, int32_t y, int32_t number);
clx_sky_ray clx_sky_ray_at(const clx_samples *samples, int32_t x, int32_t y, int32_t number,
                           int32_t i);
