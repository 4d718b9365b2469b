/* The scalar operations that docs/exactness allows, and its log2, exp2 and pow (R27).
 *
 * Always: IEEE 754, round to nearest even, denormals kept (base/fpenv.h), nothing
 * contracted or reassociated. Conversions to integers are only given values that fit.
 */
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/limits.h"

/* Both return b if the comparison is false, as it is for NaN. */
static inline float ref_min(float a, float b) { return a < b ? a : b; }
static inline float ref_max(float a, float b) { return a > b ? a : b; }

/* A NaN becomes lo. */
static inline float ref_clamp(float v, float lo, float hi)
{
    float t = v > lo ? v : lo;
    return t < hi ? t : hi;
}

/* The number of a row or column, or that of the one at the edge beyond which it lies. */
static inline int32_t ref_within(int32_t i, int32_t side)
{
    if (i < 0)
        return 0;
    return i < side ? i : side - 1;
}

static inline int32_t ref_rint(float v) { return (int32_t)lrintf(v); }

static inline float ref_floor(float v)
{
    float i = (float)(int32_t)v;
    return i - (i > v ? 1.0f : 0.0f);
}

/* floor(n / 256), without shifting a negative number. */
static inline int32_t ref_floor_256(int32_t n) { return n >= 0 ? n / 256 : -((255 - n) / 256); }

static inline float ref_dot3(const float a[3], const float b[3])
{
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

static inline void ref_cross(const float a[3], const float b[3], float out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
}

/* Normalises a vector. If its length is zero, or too great for a float, it becomes zero (R22); if it has a NaN, it becomes
 * NaN. Returns 1 / length. */
static inline float ref_normalize(float v[3])
{
    float length2 = ref_dot3(v, v);
    float scale = 1.0f / sqrtf(E3D_LEAST_LENGTH2 > length2 ? E3D_LEAST_LENGTH2 : length2);
    for (int c = 0; c < 3; c++)
        v[c] = v[c] * scale;
    return scale;
}

/* R27; v is positive and normal. */
static inline float ref_log2(float v)
{
    static const float Q[7] = {0x1.c5507p-2f, -0x1.1d270ep-2f, 0x1.99e72p-3f, -0x1.2cc076p-3f,
                               0x1.823526p-4f, -0x1.5a65f6p-5f, 0x1.2b619ap-7f};
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    float exponent = (float)((int32_t)(bits >> 23) - 127);
    bits = (bits & 0x7FFFFFu) | 0x3F800000u;
    float t;
    memcpy(&t, &bits, sizeof t);
    t = t - 1.0f;
    float q = Q[6];
    for (int k = 5; k >= 0; k--)
        q = q * t + Q[k];
    return exponent + (t + (t * (1.0f - t)) * q);
}

static inline float ref_exp2(float y)
{
    static const float P[5] = {0x1.3a37acp-2f, 0x1.10e326p-4f, 0x1.6d1682p-7f, 0x1.7e244cp-10f,
                               0x1.cb1d4cp-13f};
    y = ref_clamp(y, -126.0f, 126.0f);
    float i = ref_floor(y);
    float f = y - i;
    float p = P[4];
    for (int k = 3; k >= 0; k--)
        p = p * f + P[k];
    uint32_t bits = (uint32_t)((int32_t)i + 127) << 23;
    float power;
    memcpy(&power, &bits, sizeof power);
    return ((1.0f + f) + (f * (f - 1.0f)) * p) * power;
}

static inline float ref_pow(float x, float n)
{
    return x >= 0x1p-100f ? ref_exp2(n * ref_log2(x)) : 0.0f;
}
