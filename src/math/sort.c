// Radix sort in two steps: all entries by the leading bits into at most 4096 buckets (chunk by
// chunk, so that threads share the work and the order is that of one thread), then each bucket by 8
// bits at a time within the cache. The bits of a double order like integers once negative numbers
// are flipped.
#include "math/sort.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include <string.h>

enum { BUCKET_BITS = 12, N_BUCKET = 1 << BUCKET_BITS, N_CHUNK = 16, LEAST_CHUNK = 8192 };
enum { DIGIT_BITS = 8, N_DIGIT = 1 << DIGIT_BITS, FEW = 48, SMALL = 4096 };

/// Entries of `words` 64-bit words each, the first of which is the key.
typedef struct {
    uint64_t *entry, *scratch; ///< [n][words]
    int64_t n;
    int n_chunk;  ///< shares of the entries, N_CHUNK of many: each has a table of all buckets
    int words;    ///< 1 or 2
    uint64_t low; ///< least key
    int shift;    ///< bucket = (key - low) >> shift
    uint64_t least[N_CHUNK], most[N_CHUNK];
    int64_t (*at)[N_BUCKET];     ///< [n_chunk] counts, then where each chunk writes next
    int64_t start[N_BUCKET + 1]; ///< of each bucket
} sorting;

static int64_t chunk_begin(const sorting *s, int64_t chunk)
{
    return s->n * chunk / s->n_chunk;
}

static void find_range(int64_t begin, int64_t end, int32_t worker, void *context)
{
    sorting *s = context;
    (void)worker;
    for (int64_t chunk = begin; chunk < end; ++chunk) {
        uint64_t least = UINT64_MAX;
        uint64_t most = 0;
        for (int64_t i = chunk_begin(s, chunk); i < chunk_begin(s, chunk + 1); ++i) {
            const uint64_t key = s->entry[i * s->words];
            least = key < least ? key : least;
            most = key > most ? key : most;
        }
        s->least[chunk] = least;
        s->most[chunk] = most;
    }
}

static void count_buckets(int64_t begin, int64_t end, int32_t worker, void *context)
{
    sorting *s = context;
    (void)worker;
    for (int64_t chunk = begin; chunk < end; ++chunk) {
        int64_t *count = s->at[chunk];
        memset(count, 0, N_BUCKET * sizeof *count);
        for (int64_t i = chunk_begin(s, chunk); i < chunk_begin(s, chunk + 1); ++i) {
            ++count[(s->entry[i * s->words] - s->low) >> s->shift];
        }
    }
}

/// Where each chunk's share of each bucket begins.
static void place_buckets(sorting *s)
{
    int64_t before = 0;
    for (int b = 0; b < N_BUCKET; ++b) {
        s->start[b] = before;
        for (int chunk = 0; chunk < s->n_chunk; ++chunk) {
            const int64_t here = s->at[chunk][b];
            s->at[chunk][b] = before;
            before += here;
        }
    }
    s->start[N_BUCKET] = before;
    CLAST_ASSERT(before == s->n);
}

static void scatter(int64_t begin, int64_t end, int32_t worker, void *context)
{
    sorting *s = context;
    const int words = s->words;
    (void)worker;
    for (int64_t chunk = begin; chunk < end; ++chunk) {
        int64_t *at = s->at[chunk];
        for (int64_t i = chunk_begin(s, chunk); i < chunk_begin(s, chunk + 1); ++i) {
            const uint64_t *from = s->entry + i * words;
            uint64_t *to = s->scratch + at[(from[0] - s->low) >> s->shift]++ * words;
            to[0] = from[0];
            if (words == 2) {
                to[1] = from[1];
            }
        }
    }
}

static void insertion_sort(uint64_t *entry, int64_t n, int words)
{
    CLAST_ASSERT(n < FEW && (words == 1 || words == 2));
    for (int64_t i = 1; i < n; ++i) {
        const uint64_t key = entry[i * words];
        const uint64_t item = entry[i * words + words - 1];
        int64_t k = i;
        for (; k > 0 && entry[(k - 1) * words] > key; --k) {
            entry[k * words + words - 1] = entry[k * words - 1];
            entry[k * words] = entry[(k - 1) * words];
        }
        entry[k * words + words - 1] = item;
        entry[k * words] = key;
    }
}

/// The entries of one bucket and what their keys have in common.
typedef struct {
    uint64_t *here, *there; ///< the entries, and room for as many
    int64_t n;
    int words;
    uint64_t low; ///< keys are low .. low + 2^bits - 1
    int bits;
} bucket;

/// One digit from `here` to `there`; false, and nothing done, when all entries have the same.
static bool sort_digit(const bucket *b, int shift)
{
    CLAST_ASSERT(b->n > 0 && shift >= 0 && shift < 64);
    int64_t count[N_DIGIT] = {0};
    int64_t before = 0;
    const int words = b->words;
    for (int64_t i = 0; i < b->n; ++i) {
        ++count[((b->here[i * words] - b->low) >> shift) & (N_DIGIT - 1)];
    }
    if (count[((b->here[0] - b->low) >> shift) & (N_DIGIT - 1)] == b->n) {
        return false;
    }
    for (int digit = 0; digit < N_DIGIT; ++digit) {
        const int64_t here = count[digit];
        count[digit] = before;
        before += here;
    }
    for (int64_t i = 0; i < b->n; ++i) {
        const uint64_t *from = b->here + i * words;
        uint64_t *to = b->there + count[((from[0] - b->low) >> shift) & (N_DIGIT - 1)]++ * words;
        to[0] = from[0];
        to[words - 1] = from[words - 1];
    }
    return true;
}

/// Sorts a bucket; the result ends in `home`, which is one of its two places.
static void sort_bucket(bucket b, uint64_t *home)
{
    CLAST_ASSERT(home == b.here || home == b.there);
    if (b.n < FEW) {
        insertion_sort(b.here, b.n, b.words);
    }
    for (int shift = 0; b.n >= FEW && shift < b.bits; shift += DIGIT_BITS) {
        if (sort_digit(&b, shift)) {
            uint64_t *swap = b.here;
            b.here = b.there;
            b.there = swap;
        }
    }
    if (b.here != home) {
        memcpy(home, b.here, (size_t)b.n * (size_t)b.words * sizeof *home);
    }
}

static void sort_buckets(int64_t begin, int64_t end, int32_t worker, void *context)
{
    sorting *s = context;
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        CLAST_ASSERT(s->start[k] <= s->start[k + 1] && s->start[k + 1] <= s->n);
        const int64_t at = s->start[k] * s->words;
        const bucket b = {.here = s->scratch + at,
                          .there = s->entry + at,
                          .n = s->start[k + 1] - s->start[k],
                          .words = s->words,
                          .low = s->low + ((uint64_t)k << s->shift),
                          .bits = s->shift};
        if (b.n > 0) {
            sort_bucket(b, s->entry + at);
        }
    }
}

static int bits_of(uint64_t x)
{
    int bits = 0;
    for (; x != 0; x >>= 1) {
        ++bits;
    }
    return bits;
}

static void sort_many(sorting *s)
{
    uint64_t most = 0;
    clx_parallel_for(s->n_chunk, 1, find_range, s);
    s->low = UINT64_MAX;
    for (int chunk = 0; chunk < s->n_chunk; ++chunk) {
        s->low = s->least[chunk] < s->low ? s->least[chunk] : s->low;
        most = s->most[chunk] > most ? s->most[chunk] : most;
    }
    const int bits = bits_of(most - s->low);
    s->shift = bits > BUCKET_BITS ? bits - BUCKET_BITS : 0;
    CLAST_ASSERT((most - s->low) >> s->shift < N_BUCKET);
    clx_parallel_for(s->n_chunk, 1, count_buckets, s);
    place_buckets(s);
    clx_parallel_for(s->n_chunk, 1, scatter, s);
    clx_parallel_for(N_BUCKET, 16, sort_buckets, s);
}

static clast_status sort_entries(uint64_t *entry, int64_t n, int words)
{
    CLAST_ASSERT(n >= 2 && (words == 1 || words == 2));
    clast_status status = CLAST_OK;
    sorting s = {.entry = entry, .n = n, .words = words};
    s.n_chunk = n < (int64_t)N_CHUNK * LEAST_CHUNK ? (int)(n / LEAST_CHUNK) + 1 : N_CHUNK;
    CLX_TRY(clx_alloc(&s.scratch, n * words, sizeof *s.scratch));
    if (n <= SMALL) {
        sort_bucket((bucket){entry, s.scratch, n, words, 0, 64}, entry);
    } else {
        CLX_TRY(clx_alloc(&s.at, s.n_chunk, sizeof *s.at));
        sort_many(&s);
    }
done:
    CLX_FREE(s.scratch, s.at);
    return status;
}

clast_status clx_sort_keys(uint64_t *key, int64_t n)
{
    return n < 2 ? CLAST_OK : sort_entries(key, n, 1);
}

clast_status clx_sort_keyed(clx_keyed *entry, int64_t n)
{
    return n < 2 ? CLAST_OK : sort_entries(&entry->key, n, 2);
}

typedef struct {
    double *value;
    uint64_t *key;
} conversion;

static void to_keys(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const conversion *c = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        uint64_t bits = 0;
        memcpy(&bits, c->value + i, sizeof bits);
        c->key[i] = (bits >> 63) != 0 ? ~bits : bits | (UINT64_C(1) << 63);
    }
}

static void to_values(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const conversion *c = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const uint64_t key = c->key[i];
        const uint64_t bits = (key >> 63) != 0 ? key ^ (UINT64_C(1) << 63) : ~key;
        memcpy(c->value + i, &bits, sizeof bits);
    }
}

clast_status clx_sort_doubles(double *value, int64_t n)
{
    enum { BLOCK = 65536 };
    clast_status status = CLAST_OK;
    conversion c = {value, NULL};
    if (n < 2) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&c.key, n, sizeof *c.key));
    clx_parallel_for(n, BLOCK, to_keys, &c);
    CLX_TRY(sort_entries(c.key, n, 1));
    clx_parallel_for(n, BLOCK, to_values, &c);
done:
    clx_free(c.key);
    return status;
}
