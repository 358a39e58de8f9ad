// Least-significant-digit radix sort of doubles, 16 bits a pass; the bits of a double order like
// integers once negative numbers are flipped.
#include "math/sort.h"

#include "base/alloc.h"
#include <stdlib.h>
#include <string.h>

enum { DIGIT_BITS = 16, N_DIGIT = 1 << DIGIT_BITS, N_PASS = 64 / DIGIT_BITS, SMALL = 4096 };

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static uint64_t key_of(double value)
{
    uint64_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    return (bits >> 63) != 0 ? ~bits : bits | (UINT64_C(1) << 63);
}

static double value_of(uint64_t key)
{
    const uint64_t bits = (key >> 63) != 0 ? key ^ (UINT64_C(1) << 63) : ~key;
    double value = 0.0;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void one_pass(const uint64_t *from, uint64_t *to, int64_t n, int shift, int64_t *count)
{
    memset(count, 0, N_DIGIT * sizeof *count);
    for (int64_t i = 0; i < n; ++i) {
        ++count[(from[i] >> shift) & (N_DIGIT - 1)];
    }
    int64_t before = 0;
    for (int digit = 0; digit < N_DIGIT; ++digit) {
        const int64_t here = count[digit];
        count[digit] = before;
        before += here;
    }
    for (int64_t i = 0; i < n; ++i) {
        to[count[(from[i] >> shift) & (N_DIGIT - 1)]++] = from[i];
    }
}

clast_status clx_sort_doubles(double *value, int64_t n)
{
    clast_status status = CLAST_OK;
    uint64_t *key = NULL;
    uint64_t *other = NULL;
    int64_t *count = NULL;
    if (n <= SMALL) {
        qsort(value, (size_t)n, sizeof *value, compare);
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&key, n, sizeof *key));
    CLX_TRY(clx_alloc(&other, n, sizeof *other));
    CLX_TRY(clx_alloc(&count, N_DIGIT, sizeof *count));
    for (int64_t i = 0; i < n; ++i) {
        key[i] = key_of(value[i]);
    }
    for (int pass = 0; pass < N_PASS; pass += 2) {
        one_pass(key, other, n, pass * DIGIT_BITS, count);
        one_pass(other, key, n, (pass + 1) * DIGIT_BITS, count);
    }
    for (int64_t i = 0; i < n; ++i) {
        value[i] = value_of(key[i]);
    }
done:
    clx_free(key);
    clx_free(other);
    clx_free(count);
    return status;
}
