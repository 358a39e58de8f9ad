// Void-and-cluster dither [Ulichney1993], its void half: each next number goes to the place
// farthest from all that are set, measured by a sum of Gaussians on the torus.
#include "render/dither.h"

#include "math/rng.h"
#include <math.h>
#include <stdbool.h>

enum { REACH = 8, N = CLX_DITHER * CLX_DITHER };

typedef struct {
    float energy[CLX_DITHER][CLX_DITHER];
    bool set[CLX_DITHER][CLX_DITHER];
    float weight[2 * REACH + 1][2 * REACH + 1];
} voids;

static void put(voids *v, int at, float value, clx_dither *dither)
{
    const int x = at % CLX_DITHER;
    const int y = at / CLX_DITHER;
    v->set[y][x] = true;
    dither->value[y][x] = value;
    for (int j = -REACH; j <= REACH; ++j) {
        for (int i = -REACH; i <= REACH; ++i) {
            v->energy[(y + j + CLX_DITHER) % CLX_DITHER][(x + i + CLX_DITHER) % CLX_DITHER] +=
                v->weight[j + REACH][i + REACH];
        }
    }
}

static int largest_void(const voids *v)
{
    int best = -1;
    float least = INFINITY;
    for (int at = 0; at < N; ++at) {
        const float e = v->energy[at / CLX_DITHER][at % CLX_DITHER];
        if (!v->set[at / CLX_DITHER][at % CLX_DITHER] && e < least) {
            least = e;
            best = at;
        }
    }
    return best;
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
        put(&v, at, (float)rank / (float)N, dither);
        at = largest_void(&v);
    }
}
