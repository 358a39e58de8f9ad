// Gauss-Legendre rule: the positive half of the roots of P12 and their weights on [-1, 1].
#include "math/quadrature.h"

#include "base/status.h"

static const double root[CLX_GAUSS_N / 2] = {0.1252334085114689, 0.3678314989981802,
                                             0.5873179542866175, 0.7699026741943047,
                                             0.9041172563704748, 0.9815606342467192};
static const double weight[CLX_GAUSS_N / 2] = {0.2491470458134027,  0.23349253653835464,
                                               0.20316742672306565, 0.1600783285433461,
                                               0.10693932599531888, 0.04717533638651202};

double clx_gauss_point(int q)
{
    CLAST_ASSERT(q >= 0 && q < CLX_GAUSS_N);
    const int half = CLX_GAUSS_N / 2;
    return 0.5 + 0.5 * (q < half ? -root[half - 1 - q] : root[q - half]);
}

double clx_gauss_weight(int q)
{
    CLAST_ASSERT(q >= 0 && q < CLX_GAUSS_N);
    const int half = CLX_GAUSS_N / 2;
    return 0.5 * (q < half ? weight[half - 1 - q] : weight[q - half]);
}
