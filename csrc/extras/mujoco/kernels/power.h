/* Powers with the same bits everywhere (R27). */
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>

static inline float muj_log2(float v)
{
    static const float TERMS[7] = {0x1.c5507p-2f, -0x1.1d270ep-2f, 0x1.99e72p-3f, -0x1.2cc076p-3f,
                                   0x1.823526p-4f, -0x1.5a65f6p-5f, 0x1.2b619ap-7f};
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    float exponent = (float)((int32_t)(bits >> 23) - 127), t, sum = TERMS[6];
    bits = (bits & 0x7FFFFFu) | 0x3F800000u;
    memcpy(&t, &bits, sizeof t);
    t -= 1.0f;
    for (int k = 5; k >= 0; k--)
        sum = sum * t + TERMS[k];
    return exponent + (t + (t * (1.0f - t)) * sum);
}

static inline float muj_exp2(float y)
{
    static const float TERMS[5] = {0x1.3a37acp-2f, 0x1.10e326p-4f, 0x1.6d1682p-7f, 0x1.7e244cp-10f, 0x1.cb1d4cp-13f};
    y = y > -126.0f ? y : -126.0f; /* NaN, too */
    y = y < 126.0f ? y : 126.0f;
    float whole = floorf(y), f = y - whole, sum = TERMS[4], power;
    for (int k = 3; k >= 0; k--)
        sum = sum * f + TERMS[k];
    uint32_t bits = (uint32_t)((int32_t)whole + 127) << 23;
    memcpy(&power, &bits, sizeof power);
    return ((1.0f + f) + (f * (f - 1.0f)) * sum) * power;
}

/* x to the power of n, for 0 <= x <= 1; 0 to the power of 0 is 1. */
static inline float muj_power(float x, float n)
{
    if (n == 0)
        return 1;
    return x >= 0x1p-100f ? muj_exp2(n * muj_log2(x)) : 0.0f;
}
