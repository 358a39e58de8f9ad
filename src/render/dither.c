// Void-and-cluster dither [Ulichney1993], its void half: each next number goes to the place
// farthest from all that are set, measured by a sum of Gaussians on the torus.
#include "render/dither.h"

#include "base/status.h"
#include "math/rng.h"
#include <math.h>

enum { REACH = 8, N = CLX_DITHER * CLX_DITHER };

typedef struct {
    float energy[CLX_DITHER][CLX_DITHER]; ///< infinite where a number is set
    int emptiest[CLX_DITHER];             ///< of each row
    float weight[2 * REACH + 1][2 * REACH + 1];
} voids;

static void find_emptiest(voids *v, int y)
{
    int best = 0;
    for (int x = 1; x < CLX_DITHER; ++x) {
        best = v->energy[y][x] < v->energy[y][best] ? x : best;
    }
    v->emptiest[y] = best;
}

static void rank_pixel(voids *v, int at, float value, clx_dither *dither)
{
    CLAST_ASSERT(at >= 0);
    const int x = at % CLX_DITHER;
    const int y = at / CLX_DITHER;
    dither->value[y][x] = value;
    v->energy[y][x] = INFINITY;
    for (int j = -REACH; j <= REACH; ++j) {
        const int row = (y + j + CLX_DITHER) % CLX_DITHER;
        for (int i = -REACH; i <= REACH; ++i) {
            v->energy[row][(x + i + CLX_DITHER) % CLX_DITHER] += v->weight[j + REACH][i + REACH];
        }
        find_emptiest(v, row);
    }
}

static int largest_void(const voids *v)
{
    int best = 0;
    for (int y = 1; y < CLX_DITHER; ++y) {
        best = v->energy[y][v->emptiest[y]] < v->energy[best][v->emptiest[best]] ? y : best;
    }
    return best * CLX_DITHER + v->emptiest[best];
}

void clx_dither_fill(uint64_t seed, clx_dither *dither)
{
    const double width =
        1.9; // pixels; Ulichney's 1.5 leaves clumps when numbers are taken as values
    voids v = {0};
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_RENDER, 0);
    for (int j = -REACH; j <= REACH; ++j) {
        for (int i = -REACH; i <= REACH; ++i) {
            v.weight[j + REACH][i + REACH] = (float)exp(-(i * i + j * j) / (2.0 * width * width));
        }
    }
    int at = (int)clx_rng_below(&rng, N);
    for (int rank = 0; rank < N; ++rank) {
        rank_pixel(&v, at, (float)rank / (float)N, dither);
        at = largest_void(&v);
    }
}
