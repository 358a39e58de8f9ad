// Which two clusters meet next: any two, heavy ones more often, or as Brownian motion has it.
#include "aggregate/pick.h"

#include "aggregate/state.h"
#include "math/rng.h"
#include <math.h>

static void two_of(clx_rng *rng, int32_t n, int32_t pair[2])
{
    CLAST_ASSERT(n >= 2);
    pair[0] = (int32_t)clx_rng_below(rng, n);
    pair[1] = (int32_t)clx_rng_below(rng, n - 1);
    pair[1] += pair[1] >= pair[0] ? 1 : 0;
}

static double total_mass(const clx_clusters *all)
{
    double sum = 0.0;
    for (int32_t i = 0; i < all->n; ++i) {
        sum += all->cluster[i].mass;
    }
    return sum;
}

/// Each of the two drawn in proportion to its mass, the second among the others.
static void by_mass(const clx_clusters *all, clx_rng *rng, int32_t pair[2])
{
    CLAST_ASSERT(all->n >= 2);
    double left = total_mass(all);
    for (int k = 0; k < 2; ++k) {
        const double u = clx_rng_uniform(rng) * left;
        double sum = 0.0;
        int32_t last = -1;
        for (int32_t i = 0; i < all->n && !(last >= 0 && u < sum); ++i) {
            if (k == 1 && i == pair[0]) {
                continue;
            }
            sum += all->cluster[i].mass;
            last = i;
        }
        pair[k] = last;
        left -= all->cluster[last].mass;
    }
}

/// Brownian kernel of Smoluchowski, (R_i + R_j) (1/R_i + 1/R_j), with the radius of the uniform
/// sphere of equal gyration for R; by rejection, so it costs no sum over pairs.
static void brownian(const clx_clusters *all, clx_rng *rng, int32_t pair[2])
{
    double low = HUGE_VAL;
    double high = 0.0;
    for (int32_t i = 0; i < all->n; ++i) {
        low = fmin(low, all->cluster[i].gyration);
        high = fmax(high, all->cluster[i].gyration);
    }
    const double greatest = 2.0 + high / low + low / high;
    double kernel = 0.0;
    do {
        two_of(rng, all->n, pair);
        const double ratio = all->cluster[pair[0]].gyration / all->cluster[pair[1]].gyration;
        kernel = 2.0 + ratio + 1.0 / ratio;
    } while (clx_rng_uniform(rng) * greatest > kernel);
}

void clx_pick_pair(const clast_aggregate *a, int32_t pair[2])
{
    clx_rng rng = clx_rng_at(a->seed, CLX_STREAM_CLUSTER, (uint64_t)a->n_placed);
    CLAST_ASSERT(a->clusters.n >= 2);
    if (a->params->pick == CLAST_PICK_MASS) {
        by_mass(&a->clusters, &rng, pair);
    } else if (a->params->pick == CLAST_PICK_BROWNIAN) {
        brownian(&a->clusters, &rng, pair);
    } else {
        two_of(&rng, a->clusters.n, pair);
    }
}
