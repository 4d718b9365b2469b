/* The ranges of depths that the comparisons of R93 may read, as numbers of 16 bits. */
#pragma once

#include <stdint.h>

/* A word of e3d_light_maps.ranges stands for a block of 2 x 2 texels. It has the codes of the least depth, in its lower half, and of the
 * greatest of all texels that may be compared where the first of them is in the block. The code of a depth is the integer part of
 * depth * SCALE within -LIMIT and LIMIT. It never falls as depths rise, so of two depths whose codes differ it tells which is the
 * greater; those whose codes are the same have to be compared. A NaN in a map has the code NONE, which is less than all others, since no
 * sample is lit by it. */
enum { E3D_SHADOW_BLOCK_SHIFT = 1,
       E3D_SHADOW_CODE_LIMIT = 32767,
       E3D_SHADOW_CODE_NONE = -32768 };
#define E3D_SHADOW_CODE_SCALE 32000.0f

/* The code of a depth; of a NaN the least, as of what hides no light. */
static inline int16_t e3d_shadow_code(float depth)
{
    float scaled = depth * E3D_SHADOW_CODE_SCALE, limit = E3D_SHADOW_CODE_LIMIT;
    scaled = scaled > -limit ? scaled : -limit;
    return (int16_t)(int32_t)(scaled < limit ? scaled : limit);
}
