/* The light of 8-bit codes, 0 to 1 (R122, R124, R161). */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "data/srgb_tables.h"

static inline float ref_decode(int32_t code, int is_srgb)
{
    return is_srgb ? (float)SRGB_TO_LINEAR16[code] * E3D_UNORM16 : (float)code * E3D_UNORM8;
}
