// A well-mixed box of Monte Carlo in time. Where collisions go event by event, so does all else:
// the exact process. Where a box is partitioned into blocks or rates are frozen for a sub-step,
// particles settle, break and come in between them, each by its own clock.
// [docs/theory/agglomeration.md section 6]
#include "base/status.h"
#include "cloud/box.h"
#include "cloud/kernel_range.h"

enum { KIND_LIMIT = 50000 };

clast_status clx_box_step(clx_box *s, double end, uint64_t step, clast_range_use *use)
{
    clast_status status = CLAST_OK;
    const int32_t limit = s->collide.block;
    const double dt = end - s->time;
    clx_rng rng = clx_rng_at(s->collide.seed, CLX_STREAM_COLLISION, step << 32);
    clx_block b = {.config = &s->collide,
                   .medium = &s->collide.medium,
                   .population = &s->population,
                   .box = s,
                   .flows = s->changes,
                   .rate_factor = 1.0,
                   .scale = s->collide.alpha / s->volume,
                   .needs = clx_collide_needs(&s->collide),
                   .ranges = s->ranges,
                   .rng = &rng};
    clx_box_fit(&b);
    for (int64_t i = 0; i < s->population.n; ++i) {
        if (s->population.monomers[i] > 0) {
            b.member[b.n++] = i;
        }
    }
    clx_block_shuffle(b.member, b.n, &rng);
    if (clx_block_sort(&b, limit > 0 ? limit : KIND_LIMIT)) {
        (void)clx_block_rates(&b);
        clx_block_evolve(&b, dt);
    } else {
        CLX_CHECK(limit > 0, CLAST_E_LIMIT,
                  "the box has more than %d kinds of particles; let it be partitioned into blocks "
                  "(block > 0)",
                  KIND_LIMIT);
        clx_block_evolve_partitioned(&b, s->n_kind, dt);
    }
    s->time = s->now = end;
    s->n_event += b.n_event;
    clx_range_merge(use, &b.range);
    status = s->status;
done:
    return status;
}
