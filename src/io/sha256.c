// SHA-256, as printed in FIPS 180-4: constants are the first 32 bits of the fractional parts of the
// square and cube roots of the first primes.
#include "io/sha256.h"

#include <stdio.h>
#include <string.h>

static const uint32_t constant[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

static uint32_t rotate_left(uint32_t x, int k)
{
    return (x >> k) | (x << (32 - k));
}

static void expand(const unsigned char block[64], uint32_t w[64])
{
    for (int t = 0; t < 16; ++t) {
        w[t] = (uint32_t)block[4 * t] << 24 | (uint32_t)block[4 * t + 1] << 16 |
               (uint32_t)block[4 * t + 2] << 8 | (uint32_t)block[4 * t + 3];
    }
    for (int t = 16; t < 64; ++t) {
        const uint32_t s0 =
            rotate_left(w[t - 15], 7) ^ rotate_left(w[t - 15], 18) ^ (w[t - 15] >> 3);
        const uint32_t s1 =
            rotate_left(w[t - 2], 17) ^ rotate_left(w[t - 2], 19) ^ (w[t - 2] >> 10);
        w[t] = w[t - 16] + s0 + w[t - 7] + s1;
    }
}

static void compress(uint32_t state[8], const unsigned char block[64])
{
    uint32_t w[64];
    uint32_t v[8];
    memcpy(v, state, sizeof v);
    expand(block, w);
    for (int t = 0; t < 64; ++t) {
        const uint32_t s1 = rotate_left(v[4], 6) ^ rotate_left(v[4], 11) ^ rotate_left(v[4], 25);
        const uint32_t choice = (v[4] & v[5]) ^ (~v[4] & v[6]);
        const uint32_t t1 = v[7] + s1 + choice + constant[t] + w[t];
        const uint32_t s0 = rotate_left(v[0], 2) ^ rotate_left(v[0], 13) ^ rotate_left(v[0], 22);
        const uint32_t majority = (v[0] & v[1]) ^ (v[0] & v[2]) ^ (v[1] & v[2]);
        memmove(v + 1, v, 7 * sizeof v[0]);
        v[4] += t1;
        v[0] = t1 + s0 + majority;
    }
    for (int i = 0; i < 8; ++i) {
        state[i] += v[i];
    }
}

clx_sha256 clx_sha256_begin(void)
{
    return (clx_sha256){.state = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f,
                                  0x9b05688c, 0x1f83d9ab, 0x5be0cd19}};
}

void clx_sha256_add(clx_sha256 *sha, const void *bytes, size_t n)
{
    const unsigned char *from = bytes;
    while (n > 0) {
        const size_t used = sha->n_byte % 64;
        const size_t part = n < 64 - used ? n : 64 - used;
        memcpy(sha->block + used, from, part);
        sha->n_byte += part;
        from += part;
        n -= part;
        if (sha->n_byte % 64 == 0) {
            compress(sha->state, sha->block);
        }
    }
}

void clx_sha256_end(clx_sha256 *sha, char hex[65])
{
    const uint64_t n_bit = sha->n_byte * 8;
    unsigned char tail[72] = {0x80};
    const size_t used = sha->n_byte % 64;
    const size_t n_pad = used < 56 ? 56 - used : 120 - used;
    for (int i = 0; i < 8; ++i) {
        tail[n_pad + (size_t)i] = (unsigned char)(n_bit >> (56 - 8 * i));
    }
    clx_sha256_add(sha, tail, n_pad + 8);
    for (int i = 0; i < 8; ++i) {
        (void)snprintf(hex + 8 * (ptrdiff_t)i, 9, "%08x", (unsigned)sha->state[i]);
    }
}
