/* The light of 8-bit codes: linear, 0 to 1. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "data/srgb_tables.h"

static inline float e3d_light_of(int32_t code, int srgb)
{
    return srgb ? (float)SRGB_TO_LINEAR16[code] * E3D_UNORM16 : (float)code * E3D_UNORM8;
}

static inline void e3d_light_of_codes(int srgb, float light[256])
{
    for (int32_t code = 0; code < 256; code++)
        light[code] = e3d_light_of(code, srgb);
}
