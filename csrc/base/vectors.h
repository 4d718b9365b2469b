/* Four floats at a time, in the compiler's own vectors: on every processor, with the same bits. */
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

typedef float float4 __attribute__((vector_size(16)));
typedef int32_t int4 __attribute__((vector_size(16)));

static inline float4 splat(float v) { return (float4){v, v, v, v}; }
/* a where the mask's lane is all ones, b where it is 0. */
static inline int4 choose_bits(int4 mask, int4 a, int4 b) { return (mask & a) | (~mask & b); }
static inline float4 choose(int4 mask, float4 a, float4 b) { return (float4)choose_bits(mask, (int4)a, (int4)b); }
/* a < b ? a : b and a > b ? a : b. SSE's minimum and maximum are exactly these, NaNs included. */
#if defined(__SSE2__)
static inline float4 less_of(float4 a, float4 b) { return (float4)_mm_min_ps((__m128)a, (__m128)b); }
static inline float4 more_of(float4 a, float4 b) { return (float4)_mm_max_ps((__m128)a, (__m128)b); }
#else
static inline float4 less_of(float4 a, float4 b) { return choose(a < b, a, b); }
static inline float4 more_of(float4 a, float4 b) { return choose(a > b, a, b); }
#endif
/* A bit for each lane of a mask (movemask). */
#if defined(__SSE2__)
static inline int lanes_of(int4 mask) { return _mm_movemask_ps((__m128)mask); }
#else
static inline int lanes_of(int4 mask) { return (mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8); }
#endif
static inline float4 size_of(float4 a) { return more_of(a, -a); }
static inline float4 load4(const float *p)
{
    float4 v;
    memcpy(&v, p, sizeof v);
    return v;
}
static inline float4 root_of(float4 v) { return (float4){sqrtf(v[0]), sqrtf(v[1]), sqrtf(v[2]), sqrtf(v[3])}; }
/* Picks lanes of a and b by number; those of b count from 4. */
#if defined(__clang__)
#define LANES(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#else
#define LANES(a, b, ...) __builtin_shuffle(a, b, (int4){__VA_ARGS__})
#endif
/* The first three columns of four rows. */
static inline void columns_of(const float4 row[4], float4 column[3])
{
    float4 low = LANES(row[0], row[1], 0, 4, 1, 5), low2 = LANES(row[2], row[3], 0, 4, 1, 5);
    float4 high = LANES(row[0], row[1], 2, 6, 3, 7), high2 = LANES(row[2], row[3], 2, 6, 3, 7);
    column[0] = LANES(low, low2, 0, 1, 4, 5);
    column[1] = LANES(low, low2, 2, 3, 6, 7);
    column[2] = LANES(high, high2, 0, 1, 4, 5);
}
static inline void store4(float *p, float4 v) { memcpy(p, &v, sizeof v); }
