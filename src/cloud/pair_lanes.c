// The count of pair_lanes.h for several machines. Eight lanes (AVX-512) gained nothing over four on
// a machine that does them in two halves.
#include "cloud/pair_lanes.h"

#include "math/lanes.h"

/// Squared distances from the point k on; of points beyond the end no number.
CLX_INLINE clx_lanes distances(const clx_pair_lanes *p, int32_t d, int32_t k, int32_t end)
{
    clx_lanes sum = lanes_all(0.0);
    for (int32_t j = 0; j < d; ++j) {
        const clx_lanes apart = lanes_load(p->x[j] + k) - p->at[j];
        sum = j == 0 ? apart * apart : sum + apart * apart;
    }
    if (end - k < CLX_LANES) {
        const clx_marks lane = {0, 1, 2, 3};
        sum = (clx_lanes)((clx_marks)sum | (lane >= (int64_t)(end - k)));
    }
    return sum;
}

CLX_INLINE void append(clx_pair_found *found, int32_t k, int bits, clx_lanes r2)
{
    double own[CLX_LANES];
    if (bits == 0) {
        return;
    }
    lanes_store(own, r2);
    for (; bits != 0; bits &= bits - 1) {
        const int i = __builtin_ctz((unsigned)bits);
        found->item[found->n] = k + i;
        found->r2[found->n++] = own[i];
    }
}

CLX_INLINE void walk(clx_pair_lanes *p, int32_t d, clx_pair_piece piece)
{
    clx_marks within[CLX_PAIR_OUTER] = {{0}}; // less the numbers
    p->close.n = p->unsafe.n = 0;
    for (int32_t k = piece.begin; k < piece.end; k += CLX_LANES) {
        const clx_lanes r2 = distances(p, d, k, piece.end);
        for (int j = 0; j < CLX_PAIR_OUTER; ++j) {
            within[j] += r2 < p->outer[j];
        }
        if (piece.any_close) {
            append(&p->close, k, lanes_bits(r2 < p->outer[CLX_PAIR_OUTER - 1]), r2);
        }
        if (piece.any_unsafe) {
            const clx_marks unsafe =
                (r2 < p->outer[0]) & ((r2 >= p->own_safe2) | (r2 >= lanes_load(p->safe2 + k)));
            append(&p->unsafe, k, lanes_bits(unsafe), r2);
        }
    }
    for (int j = 0; j < CLX_PAIR_OUTER; ++j) {
        p->within[j] -= within[j][0] + within[j][1] + within[j][2] + within[j][3];
    }
}

CLX_FOR_EACH_MACHINE
void clx_pair_lanes_count(clx_pair_lanes *p, clx_pair_piece piece)
{
    const clx_pair_piece close = {piece.begin, piece.end, true, false};
    const clx_pair_piece plain = {piece.begin, piece.end, false, false};
    if (p->d == 3 && !piece.any_unsafe && !piece.any_close) {
        walk(p, 3, plain);
    } else if (p->d == 3 && !piece.any_unsafe) {
        walk(p, 3, close);
    } else if (p->d == 3) {
        walk(p, 3, piece);
    } else if (p->d == 2 && !piece.any_unsafe) {
        walk(p, 2, close);
    } else {
        walk(p, p->d, piece);
    }
}
