#pragma once
// Numbers in little-endian byte order, whatever the machine's.
#include <stdint.h>
#include <string.h>

static inline uint32_t clx_load_u32(const uint8_t *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static inline void clx_store_u16(uint8_t *p, uint32_t v)
{
    p[0] = (uint8_t)v;
    p[1] = (uint8_t)(v >> 8);
}

static inline void clx_store_u32(uint8_t *p, uint32_t v)
{
    clx_store_u16(p, v);
    clx_store_u16(p + 2, v >> 16);
}

static inline double clx_load_f64(const uint8_t *p)
{
    const uint64_t bits = (uint64_t)clx_load_u32(p) | (uint64_t)clx_load_u32(p + 4) << 32;
    double value = 0.0;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline void clx_store_f64(uint8_t *p, double value)
{
    uint64_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    clx_store_u32(p, (uint32_t)bits);
    clx_store_u32(p + 4, (uint32_t)(bits >> 32));
}
