/* The driver's random numbers: the same on every machine, from a seed or from a fuzzer's bytes.
 *
 * One call an expression: C leaves the order of two calls open.
 * Method: splitmix64 (Steele, Lea, Flood 2014). Floats are integers times a power of two, and no
 * function of libm is used, since those differ between systems in the last bit.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef struct random_stream {
    uint64_t state;
    const uint8_t *bytes; /* taken first, two at a time; NULL or empty: the state alone */
    size_t byte_count;
} random_stream;

static inline uint64_t random_bits(random_stream *r)
{
    uint64_t taken = 0;
    if (r->byte_count > 0) {
        size_t count = r->byte_count < 2 ? r->byte_count : 2;
        memcpy(&taken, r->bytes, count);
        r->bytes += count;
        r->byte_count -= count;
    }
    uint64_t z = (r->state += 0x9E3779B97F4A7C15u) ^ taken;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/* 0 .. count - 1 */
static inline int32_t random_below(random_stream *r, int32_t count)
{
    return (int32_t)((random_bits(r) >> 33) % (uint32_t)count);
}

/* 1 in `odds` */
static inline int random_once_in(random_stream *r, int32_t odds)
{
    return random_below(r, odds) == 0;
}

/* [low, high), 24 random bits */
static inline float random_float(random_stream *r, float low, float high)
{
    return low + (high - low) * ((float)(random_bits(r) >> 40) * 0x1p-24f);
}
