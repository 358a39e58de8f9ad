#pragma once
// SHA-256. [FIPS 180-4 section 6.2]
#include "base/status.h"
#include <stddef.h>
#include <stdint.h>

typedef struct clx_sha256 {
    uint32_t state[8];
    uint64_t n_byte;
    unsigned char block[64];
} clx_sha256;

CLX_SHARED clx_sha256 clx_sha256_begin(void);
CLX_SHARED void clx_sha256_add(clx_sha256 *sha, const void *bytes, size_t n);
CLX_SHARED void clx_sha256_end(clx_sha256 *sha, char hex[65]);
