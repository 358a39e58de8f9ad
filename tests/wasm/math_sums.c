// A checksum of each elementary function over many arguments, one a line: test_math.py compares
// those of glibc with those that clast.wasm is linked with. Results that are not a number count as
// one, whatever their sign.
#define _GNU_SOURCE
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { N_ARGUMENT = 400000 };

typedef struct {
    const char *name;
    double (*of)(double, double);
    double low, high; // half of the arguments are even between these, half have any magnitude
} function;

#define OF_ONE(f)                                                                                  \
    static double of_##f(double x, double y)                                                       \
    {                                                                                              \
        (void)y;                                                                                   \
        return f(x);                                                                               \
    }
#define OF_TWO(f)                                                                                  \
    static double of_##f(double x, double y)                                                       \
    {                                                                                              \
        return f(x, y);                                                                            \
    }
OF_ONE(acos)
OF_ONE(asin)
OF_ONE(atan)
OF_ONE(cbrt)
OF_ONE(cos)
OF_ONE(cosh)
OF_ONE(erf)
OF_ONE(erfc)
OF_ONE(exp)
OF_ONE(exp2)
OF_ONE(expm1)
OF_ONE(log)
OF_ONE(log10)
OF_ONE(log1p)
OF_ONE(log2)
OF_ONE(sin)
OF_ONE(tan)
OF_ONE(tanh)
OF_TWO(atan2)
OF_TWO(hypot)
OF_TWO(pow)

/// gcc makes one call of a sine and a cosine, WebAssembly has two.
static double of_sincos(double x, double y)
{
    double s = sin(x), c = cos(x);
#if defined(__GLIBC__)
    sincos(x, &s, &c);
#endif
    return y > 0.0 ? s : c;
}

static const function functions[] = {
    {"acos", of_acos, -1.0, 1.0},   {"asin", of_asin, -1.0, 1.0},
    {"atan", of_atan, -8.0, 8.0},   {"atan2", of_atan2, -4.0, 4.0},
    {"cbrt", of_cbrt, -9.0, 9.0},   {"cos", of_cos, -20.0, 20.0},
    {"cosh", of_cosh, -30.0, 30.0}, {"erf", of_erf, -7.0, 7.0},
    {"erfc", of_erfc, -7.0, 28.0},  {"exp", of_exp, -700.0, 700.0},
    {"exp2", of_exp2, -60.0, 60.0}, {"expm1", of_expm1, -40.0, 40.0},
    {"hypot", of_hypot, -9.0, 9.0}, {"log", of_log, 0.0, 4.0},
    {"log10", of_log10, 0.0, 4.0},  {"log1p", of_log1p, -1.0, 4.0},
    {"log2", of_log2, 0.0, 4.0},    {"pow", of_pow, 0.0, 20.0},
    {"sin", of_sin, -20.0, 20.0},   {"sincos", of_sincos, -20.0, 20.0},
    {"tan", of_tan, -20.0, 20.0},   {"tanh", of_tanh, -24.0, 24.0},
};

/// The next of a row of bits (splitmix64).
static uint64_t next_bits(uint64_t *row)
{
    uint64_t z = *row += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

static double argument(uint64_t *row, const function *f, int is_any)
{
    const uint64_t bits = next_bits(row);
    const double unit = (double)(bits >> 11) * 0x1p-53; // in [0, 1)
    if (!is_any)
        return f->low + unit * (f->high - f->low);
    const double magnitude = ldexp(1.0 + unit, (int)(next_bits(row) % 81) - 60);
    return bits & 1 ? -magnitude : magnitude;
}

static uint64_t checksum(const function *f)
{
    uint64_t row = 1, sum = 0;
    for (int k = 0; k < N_ARGUMENT; ++k) {
        const double x = argument(&row, f, k & 1), y = argument(&row, f, k & 2);
        double value = f->of(x, y);
        uint64_t bits = 0;
        memcpy(&bits, &value, sizeof bits);
        sum = (sum ^ (isnan(value) ? 1 : bits)) * 0x100000001b3u;
        sum ^= sum >> 29;
    }
    return sum;
}

int main(void)
{
    for (size_t k = 0; k < sizeof functions / sizeof *functions; ++k) {
        printf("%s %016llx\n", functions[k].name, (unsigned long long)checksum(&functions[k]));
    }
    return 0;
}
